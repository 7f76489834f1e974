"""The marimo page: title, fields, players, what it shows of each value, the editor's notes, proofs and bands.

Stands on the document room and those below.
"""
