"""The sheet of the inputs, which the user of a workbook edits."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import groupby

from mechsheet.units import parse, shown, si
from mechsheet.workbook import looks
from mechsheet.workbook.book import Book
from mechsheet.workbook.content import Content, Live
from mechsheet.workbook.sheet_formulas import SheetFormulas


@dataclass(frozen=True)
class InputRow:
    """One input: ``value`` is in ``unit``; neighbours of one ``section`` stand under its heading."""

    symbol: str
    value: float | int | str
    unit: str
    meaning: str
    section: str = ""


def write(book: Book, rows: Sequence[InputRow], formulas: SheetFormulas | None) -> None:
    """The sheet Inputs; with ``formulas`` each input also in SI units, under the name that formulas use."""
    fields = (("Symbol", looks.TEXT), ("Value", looks.FIELD), ("Unit", looks.TEXT), ("Meaning", looks.TEXT))
    live = (("in SI units", looks.SI), ("Unit", looks.TEXT), ("Name", looks.TEXT)) if formulas else ()
    listed: list[tuple[Content, ...]] = []
    for n, row in listed_rows(rows):
        if not isinstance(row, InputRow):
            listed.append((row,))
            continue
        line: tuple[Content, ...] = (row.symbol, row.value, shown(row.unit), row.meaning)
        if formulas:
            node = formulas.recording.inputs[row.symbol]
            value = Live(_taken(f"B{n + 1}", parse(row.unit).factor), float(node.value))
            line += (value, shown(si(row.unit)), formulas.name(node))
        listed.append(line)
    book.listing("Inputs", f"{book.title} - inputs", (*fields, *live), listed)


def listed_rows(rows: Sequence[InputRow]) -> Iterator[tuple[int, InputRow | str]]:
    """Inputs and the headings of their sections, with the rows of the sheet in which they stand."""
    n = 2
    for section, members in groupby(rows, key=lambda row: row.section):
        for item in [section, *members] if section else members:
            yield n, item
            n += 1


def _taken(cell: str, factor: float) -> str:
    """Formula of an input in SI units: of a number, or of a text with a decimal comma or point."""
    text = f'_xlfn.NUMBERVALUE(SUBSTITUTE({cell},",","."),".")'
    number = f"IF(ISNUMBER({cell}),{cell},IF(LEN({cell})=0,NA(),IFERROR({text},NA())))"
    return f"={number}" if factor == 1 else f"={number}*" + ("PI()/180" if factor == math.pi / 180 else repr(factor))
