"""Excel workbooks: written from a document and its recording, and read back.

`writing` makes a workbook and `reading` takes the inputs from an edited one; `save` writes a file whole. A `book` has
sheets and formats, with the `looks` of a document and the `content` of their cells; each kind of sheet has a file, and
a `chart` its `axis`. For formulas an `arrangement` gives each recorded quantity its `place`, `cell_formula` has the
text of one, `column_rows` tells how it means cells of other columns, and `sheet_formulas` has those of the sheets.
Stands on the document room and those below.
"""
