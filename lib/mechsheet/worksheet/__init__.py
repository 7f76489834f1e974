"""What a worksheet is made of, as data: file and cells, lines, inputs, found values, checks, tables, scenes, results.

Stands on the mechanics and the units. Nothing here writes a page or a workbook.
"""
