"""What a document holds and how it is written, whoever writes it: its parts in order, formulas, numbers, layout.

Stands on the recording and the worksheet rooms.
"""
