"""The sheet of the found values, the residuals that they leave and the intervals searched."""

from collections.abc import Sequence
from itertools import product
from typing import NamedTuple

from mechsheet.units import shown
from mechsheet.workbook import looks
from mechsheet.workbook.book import Book
from mechsheet.workbook.content import Content, Live, holding
from mechsheet.workbook.sheet_formulas import SheetFormulas
from mechsheet.workbook.sizes import Sizes

_ROOM = 13  # characters for which a number's cell has room, in any program's font


class FoundRow(NamedTuple):
    """One solved value in ``unit``, searched for in ``lower..upper``, and the ``residual`` that it leaves.

    ``unknown`` is what the solve block calls it, behind the name of its verdict, ``kind`` what it is, ``target`` the
    value that the equation of one unknown must have.
    """

    symbol: str
    value: float
    unit: str
    meaning: str
    residual: float
    residual_unit: str
    lower: float
    upper: float
    other_roots: str = ""
    unknown: str = ""
    target: float | None = None
    kind: str = "found"


def write(book: Book, rows: Sequence[FoundRow], formulas: SheetFormulas | None) -> None:
    """The sheet Find; a residual that no longer is nothing is coloured."""
    fields = (
        *(("Symbol", looks.TEXT), ("Value", looks.VALUE), ("Unit", looks.TEXT), ("Meaning", looks.TEXT)),
        *(("Residual", looks.SMALL), ("Unit", looks.TEXT), ("From", looks.VALUE), ("To", looks.VALUE)),
        *(("Other roots", looks.TEXT), ("Value is", looks.TEXT), ("Target", looks.VALUE)),
    )
    listed: list[tuple[Content, ...]] = []
    for row in rows:
        numbers = (row.value, row.residual, row.lower, row.upper)
        *texts, must = formulas.found(row.unknown, row.unit, row.residual_unit) if formulas else (None,) * 5
        value, residual, lower, upper = (_known(f, x, formulas) for f, x in zip(texts, numbers, strict=True))
        target: Content = "" if row.target is None else _known(must, row.target, formulas)
        others: Content = formulas.as_exported(row.other_roots, "not followed") if formulas else row.other_roots
        kind = formulas.kind(row.unknown, row.kind) if formulas else row.kind
        line = (row.symbol, value, shown(row.unit), row.meaning, residual, shown(row.residual_unit), lower, upper)
        listed.append((*line, others, kind, target))
    title = "Found values, the residuals that they leave and the intervals searched"
    sheet = book.listing("Find", title, fields, listed)
    sizes = Sizes(book, sheet)
    for n, (column, (_, look)) in product(range(2, len(rows) + 2), enumerate(fields)):
        if look is looks.VALUE:
            sizes.alone(n, column, looks.VALUE_DECIMALS, _ROOM)
    sizes.write()
    for n in (n for n, row in enumerate(rows, 2) if row.kind == "found"):
        off = holding(f"NOT(IFERROR(ABS($E${n + 1})<=1E-9*MAX(1,ABS($K${n + 1})),FALSE))")
        coloured = {"type": "formula", "criteria": off, "format": book.file.add_format(looks.FAIL)}
        sheet.conditional_format(n, 4, n, 4, coloured)


def _known(formula: str | None, value: float, formulas: SheetFormulas | None) -> Content:
    return Live(formula, value) if formula else formulas.as_exported(value) if formulas else value
