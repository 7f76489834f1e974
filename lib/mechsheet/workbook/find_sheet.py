"""The sheet of the found values, the residuals that they leave and the intervals searched."""

from collections.abc import Sequence
from dataclasses import dataclass

from mechsheet.units import shown
from mechsheet.workbook import looks
from mechsheet.workbook.book import Book
from mechsheet.workbook.content import Content, Live
from mechsheet.workbook.sheet_formulas import SheetFormulas


@dataclass(frozen=True)
class FoundRow:
    """One solved value in ``unit``, searched for in ``lower..upper``, and the ``residual`` that it leaves.

    ``unknown`` is what the solve block calls it, ``target`` the value that its equation must have, ``kind`` what it is.
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
    target: float = 0.0
    kind: str = "found"


def write(book: Book, rows: Sequence[FoundRow], formulas: SheetFormulas | None) -> None:
    """The sheet Find; a residual that no longer is nothing is coloured."""
    fields = (
        *(("Symbol", looks.TEXT), ("Value", looks.VALUE), ("Unit", looks.TEXT), ("Meaning", looks.TEXT)),
        *(("Residual", looks.SMALL), ("Unit", looks.TEXT), ("From", looks.VALUE), ("To", looks.VALUE)),
        *(("Other roots", looks.TEXT), ("Value is", looks.TEXT)),
    )
    listed: list[tuple[Content, ...]] = []
    for row in rows:
        numbers = (row.value, row.residual, row.lower, row.upper)
        texts = formulas.found(row.unknown, row.unit, row.residual_unit) if formulas else (None,) * 4
        value, residual, lower, upper = (_known(f, x, formulas) for f, x in zip(texts, numbers, strict=True))
        others: Content = formulas.as_exported(row.other_roots) if formulas and row.other_roots else row.other_roots
        kind = "its closed form" if formulas and formulas.closed(row.unknown) else row.kind
        line = (row.symbol, value, shown(row.unit), row.meaning, residual, shown(row.residual_unit), lower, upper)
        listed.append((*line, others, kind))
    title = "Found values, the residuals that they leave and the intervals searched"
    sheet = book.listing("Find", title, fields, listed)
    for n, row in ((n, row) for n, row in enumerate(rows, 2) if row.kind == "found"):
        rule = {"type": "formula", "format": book.file.add_format(looks.FAIL)}
        limit = 1e-9 * max(1.0, abs(row.target))
        sheet.conditional_format(n, 4, n, 4, {**rule, "criteria": f"=NOT(IFERROR(ABS($E${n + 1})<={limit!r},FALSE))"})


def _known(formula: str | None, value: float, formulas: SheetFormulas | None) -> Content:
    return Live(formula, value) if formula else formulas.as_exported(value) if formulas else value
