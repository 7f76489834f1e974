"""Excel workbooks: written from a document and its recording, and read back.

Stands on the document room and those below.
"""
