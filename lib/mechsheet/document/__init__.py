"""How a document is written, whoever writes it: formulas, numbers, layout of charts and drawings.

Stands on the recording and the worksheet rooms.
"""
