"""Numbers of another size than the exported ones: what a cell has no room or no digits for is written otherwise."""

from typing import Any

from mechsheet.workbook.book import Book
from mechsheet.workbook.cell_formula import AGGREGATE, written
from mechsheet.workbook.content import holding
from mechsheet.workbook.place import letters
from mechsheet.worksheet.table import Column

_SHORT, _LONG = "0.0E+00", "0.00E+00"
_SEEN = 10  # characters of a small number that all programs show as it is
_ROOM = 9  # characters of a cell, from which on the long form has room in any program's font

Cells = tuple[int, int, int, int]  # first row and column, last row and column


class Sizes:
    """How the numbers of a sheet are legible at any size: cells that ask the same have one rule in common."""

    def __init__(self, book: Book, sheet: Any) -> None:
        self._book, self._sheet = book, sheet
        self._rules: dict[tuple[str, str], list[Cells]] = {}  # by what it asks of ``{at}``, and the form where it holds

    def follow(self, cells: Cells, column: Column, room: int) -> None:
        """Numbers of a column in some of its cells, or in a row, each with room for so many characters.

        Small are those of cells none of which shows two digits in the decimals of the column, where it has such now.
        """
        sizes = [abs(x) for x in column.values.tolist() if isinstance(x, float | int)]
        if column.power or column.unlike or not sizes:
            return
        top, left, bottom, right = cells
        least, small = _least(column.decimals), "FALSE"
        if max(sizes) >= least:
            in_row = f"${letters(left)}{{row}}:${letters(right)}{{row}}"
            every = in_row if top == bottom else f"{{column}}${top + 1}:{{column}}${bottom + 1}"
            greatest = f"MAX({AGGREGATE}(4,6,{every}),-{AGGREGATE}(5,6,{every}))"
            small = f"IF(AND({{at}}<>0,ABS({{at}})<{written(least)}),{greatest}<{written(least)})"
        self._legible(cells, column.decimals, room, small)

    def alone(self, row: int, column: int, decimals: int, room: int) -> None:
        """A number of so many decimals; it is small where it shows no three digits itself."""
        small = f"AND({{at}}<>0,ABS({{at}})<{written(_least(decimals - 1))})"
        self._legible((row, column, row, column), decimals, room, small)

    def of_any(self, row: int, column: int, sign: str = "") -> None:
        """A number in the form for quantities of any size, where it is negative, very large or small."""
        long = f'OR(ABS({{at}})>=1E10,AND(ABS({{at}})<0.01,LEN({{at}}&"")>{_SEEN}))'
        for holds, form in ((long, _LONG), ("{at}<=-100", "0"), ("{at}<=-0.01", "0.000")):
            self._formed((row, column, row, column), holds, f"{sign}{form}")

    def write(self) -> None:
        """Write the rules, of which the first cells stand above and left of all that have them in common."""
        for (holds, form), every in self._rules.items():
            top, left, *_ = every[0]
            formed = {
                "type": "formula",
                "criteria": holding(holds.format(at=f"{letters(left)}{top + 1}", column=letters(left), row=top + 1)),
                "format": self._book.file.add_format({"num_format": form}),
                "multi_range": " ".join(map(_at, every)),
                "stop_if_true": True,
            }
            self._sheet.conditional_format(*every[0], formed)

    def _legible(self, cells: Cells, decimals: int, room: int, small: str) -> None:
        """What is too long loses its decimals, or is a power of ten, as is what is ``small``."""
        long, whole = (f"LEN(FIXED({{at}},{places},TRUE))>{room}" for places in (decimals, 0))
        self._formed(cells, f"IF({whole},TRUE,{small})", _LONG if room >= _ROOM else _SHORT)
        if decimals:
            self._formed(cells, long, "0")

    def _formed(self, cells: Cells, holds: str, form: str) -> None:
        self._rules.setdefault((holds, form), []).append(cells)


def _at(cells: Cells) -> str:
    top, left, bottom, right = cells
    return f"{letters(left)}{top + 1}:{letters(right)}{bottom + 1}"


def _least(decimals: int) -> float:
    return float(10.0 ** (1 - decimals))
