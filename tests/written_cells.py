"""What is written in the cells of a workbook, in a quarter of the time of openpyxl, which makes an object of each."""

from __future__ import annotations

import io
import re
from collections.abc import Callable, Iterator
from functools import cached_property, partial
from html import unescape
from pathlib import Path
from typing import Any, NamedTuple
from zipfile import ZipFile

from openpyxl.utils import column_index_from_string, get_column_letter, range_boundaries

Content = str | float | None
Sheet = dict[tuple[int, int], tuple[str, Content]]  # formulas, empty where there is none, and values by row and column
# Address, kind, formula and value of a cell that holds something.
CELL = re.compile(
    r'<c r="([A-Z]+)(\d+)"(?: s="\d+")?(?: t="(\w+)")?>(?:<f(?: [^>]*)?>(.*?)</f>)?(?:<v>(.*?)</v>)?</c>', re.DOTALL
)


def read(file: Path | io.BytesIO) -> dict[str, Sheet]:
    """The cells of all sheets."""
    with ZipFile(file) as book:
        texts = _texts(book)
        return {title: _cells(text, texts) for title, text in sheets(book)}


class Value(NamedTuple):
    """A cell as openpyxl has one."""

    row: int
    column: int
    value: Content

    @property
    def column_letter(self) -> str:
        return get_column_letter(self.column)

    @property
    def coordinate(self) -> str:
        return f"{self.column_letter}{self.row}"


class Values:
    """The values of a workbook, asked for as of openpyxl; a sheet is read when it is first looked at."""

    def __init__(self, file: Path | io.BytesIO) -> None:
        with ZipFile(file) as book:
            texts = _texts(book)
            self._sheets = {title: SheetOfValues(title, text, partial(_stored, texts)) for title, text in sheets(book)}

    @classmethod
    def of_texts(cls, book: Path, at: Callable[[str], Path]) -> Values:
        """Those of a workbook whose sheets have been written as texts, of which ``at`` gives the place."""
        values = cls.__new__(cls)
        with ZipFile(book) as parts:
            titles = _titles(parts)
        values._sheets = {title: SheetOfValues(title, at(title).read_text("utf-8"), _listed) for title in titles}
        return values

    def __getitem__(self, title: str) -> SheetOfValues:
        return self._sheets[title]

    def __contains__(self, title: str) -> bool:
        return title in self._sheets

    def __iter__(self) -> Iterator[SheetOfValues]:
        return iter(self._sheets.values())

    @property
    def sheetnames(self) -> list[str]:
        return [*self._sheets]

    @property
    def worksheets(self) -> list[SheetOfValues]:
        return [*self]


class SheetOfValues:
    """The values of a sheet."""

    def __init__(self, title: str, text: str, read: Callable[[str], dict[tuple[int, int], Content]]) -> None:
        self.title, self._text, self._read = title, text, read

    @cached_property
    def _values(self) -> dict[tuple[int, int], Content]:
        values = self._read(self._text)
        del self._text
        return values

    @property
    def max_row(self) -> int:
        return max((row for row, _ in self._values), default=1)

    @property
    def max_column(self) -> int:
        return max((column for _, column in self._values), default=1)

    def cell(self, row: int, column: int) -> Value:
        return Value(row, column, self._values.get((row, column)))

    def __getitem__(self, key: str | int) -> Any:
        if isinstance(key, int):
            return next(self.iter_rows(key, key))
        left, top, right, bottom = range_boundaries(key)
        if ":" in key:
            return tuple(self.iter_rows(top, bottom, left, right))
        if top is None:
            return tuple(row[0] for row in self.iter_rows(min_col=left, max_col=right))
        return self.cell(top, left)

    def iter_rows(
        self,
        min_row: int | None = None,
        max_row: int | None = None,
        min_col: int | None = None,
        max_col: int | None = None,
        values_only: bool = False,
    ) -> Iterator[tuple[Any, ...]]:
        columns, get = range(min_col or 1, (max_col or self.max_column) + 1), self._values.get
        for row in range(min_row or 1, (max_row or self.max_row) + 1):
            if values_only:
                yield tuple(get((row, column)) for column in columns)
            else:
                yield tuple(Value(row, column, get((row, column))) for column in columns)


def _stored(texts: list[str], text: str) -> dict[tuple[int, int], Content]:
    return {at: value for at, (_, value) in _cells(text, texts).items() if value is not None}


def _listed(text: str) -> dict[tuple[int, int], Content]:
    """Values by row and column of a sheet that is written as text, with quotes about what is no number."""
    found, row, column = dict[tuple[int, int], Content](), 1, 1
    for field, end in re.findall(r'("(?:[^"]|"")*"|[^,\n]*)(,|\n)', text):
        if field not in ("", '""'):
            found[row, column] = field[1:-1].replace('""', '"') if field[0] == '"' else _number(field)
        row, column = (row, column + 1) if end == "," else (row + 1, 1)
    return found


def _number(text: str) -> Content:
    """A number, a whole one as such; an error as it is written."""
    if text.startswith("#"):
        return text
    value = float(text)
    return int(value) if value.is_integer() and abs(value) < 1e15 else value


def _texts(book: ZipFile) -> list[str]:
    strings = re.findall("<si>(.*?)</si>|<si/>", part(book, "sharedStrings.xml"), re.DOTALL)
    return ["".join(map(unescape, re.findall("<t.*?>(.*?)</t>", text, re.DOTALL))) for text in strings]


def part(book: ZipFile, name: str) -> str:
    return book.read(f"xl/{name}").decode()


def sheets(book: ZipFile) -> Iterator[tuple[str, str]]:
    """The title of each sheet and how it is stored."""
    files = dict(re.findall(r'<Relationship Id="(\w+)".*?Target="(.*?)"', part(book, "_rels/workbook.xml.rels")))
    for title, key in _titles(book).items():
        yield title, part(book, files[key])


def _titles(book: ZipFile) -> dict[str, str]:
    """The titles of all sheets, and by what each is known."""
    listed = re.findall(r'<sheet name="(.*?)" .*?r:id="(\w+)"', part(book, "workbook.xml"))
    return {unescape(title): key for title, key in listed}


def _cells(text: str, texts: list[str]) -> Sheet:
    cells = CELL.findall(text)
    assert len(cells) == text.count("</c>"), "not all cells are read"
    return {
        (int(row), column_index_from_string(column)): (
            formula and f"={unescape(formula)}",
            _content(kind, value, texts),
        )
        for column, row, kind, formula, value in cells
    }


def _content(kind: str, value: str, texts: list[str]) -> Content:
    match kind:
        case _ if not value:
            return None
        case "s":
            return texts[int(value)]
        case "b":
            return value == "1"
        case "str" | "e":
            return unescape(value)
    return int(value) if value.lstrip("-").isdecimal() else float(value)
