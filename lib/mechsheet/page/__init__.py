"""The marimo page: title, fields, players, what it shows of each value, the editor's notes.

Stands on the document room and those below.
"""
