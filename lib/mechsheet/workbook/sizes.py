"""Numbers of another size than the exported ones: what a cell has no room or no digits for is written otherwise."""

from typing import Any

from mechsheet.workbook.book import Book
from mechsheet.workbook.cell_formula import AGGREGATE, written
from mechsheet.workbook.place import letters
from mechsheet.worksheet.table import Column

_SHORT, _LONG = "0.0E+00", "0.00E+00"
_SEEN = 10  # characters of a small number that all programs show as it is
_ROOM = 9  # characters of a cell, from which on the long form has room in any program's font

Cells = tuple[int, int, int, int]  # first row and column, last row and column


def follow(book: Book, sheet: Any, cells: Cells, column: Column, room: int) -> None:
    """Let the numbers of a column in some cells, each with room for so many characters, be legible at any size.

    Small are those of cells none of which shows two digits in the decimals of the column, where it has such now.
    """
    sizes = [abs(x) for x in column.values.tolist() if isinstance(x, float | int)]
    if column.power or column.unlike or not sizes:
        return
    top, left, bottom, right = cells
    at, least, small = f"{letters(left)}{top + 1}", _least(column.decimals), "FALSE"
    if max(sizes) >= least:
        every = f"${letters(left)}${top + 1}:${letters(right)}${bottom + 1}"
        greatest = f"MAX({AGGREGATE}(4,6,{every}),-{AGGREGATE}(5,6,{every}))"
        small = f"IF(AND({at}<>0,ABS({at})<{written(least)}),{greatest}<{written(least)})"
    _legible(book, sheet, cells, column.decimals, room, small)


def alone(book: Book, sheet: Any, row: int, column: int, decimals: int, room: int) -> None:
    """Let a number of so many decimals be legible at any size; it is small where it shows no three digits itself."""
    at = f"{letters(column)}{row + 1}"
    small = f"AND({at}<>0,ABS({at})<{written(_least(decimals - 1))})"
    _legible(book, sheet, (row, column, row, column), decimals, room, small)


def of_any(book: Book, sheet: Any, row: int, column: int, sign: str = "") -> None:
    """Let a number in the form for quantities of any size be legible where it is negative, very large or small."""
    at = f"{letters(column)}{row + 1}"
    long = f'OR(ABS({at})>=1E10,AND(ABS({at})<0.01,LEN({at}&"")>{_SEEN}))'
    for holds, form in ((long, _LONG), (f"{at}<=-100", "0"), (f"{at}<=-0.01", "0.000")):
        _formed(book, sheet, (row, column, row, column), holds, f"{sign}{form}")


def _least(decimals: int) -> float:
    return float(10.0 ** (1 - decimals))


def _legible(book: Book, sheet: Any, cells: Cells, decimals: int, room: int, small: str) -> None:
    """What is too long loses its decimals, or is a power of ten, as is what is ``small``."""
    at, power = f"{letters(cells[1])}{cells[0] + 1}", _LONG if room >= _ROOM else _SHORT
    long, whole = (f"LEN(FIXED({at},{places},TRUE))>{room}" for places in (decimals, 0))
    _formed(book, sheet, cells, f"IF({whole},TRUE,{small})", power)
    if decimals:
        _formed(book, sheet, cells, long, "0")


def _formed(book: Book, sheet: Any, cells: Cells, holds: str, form: str) -> None:
    look = book.file.add_format({"num_format": form})
    rule = {"type": "formula", "criteria": f"={holds}", "format": look, "stop_if_true": True}
    sheet.conditional_format(*cells, rule)
