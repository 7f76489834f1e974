"""What a document holds and how it is written, whoever writes it: its parts in order, formulas as trees, rounded axes,
layout of charts and drawings.

Stands on the recording and the worksheet rooms; a notation, MathML or SVG, is a file of its own that reads these data.
"""
