"""The file of a workbook while it is written: its formats, sheets and listings."""

import math
import re
from collections.abc import Container, Sequence
from datetime import datetime
from functools import cache
from io import BytesIO
from typing import Any

from mechsheet.workbook import looks
from mechsheet.workbook.content import Content, Live, allowed, cut, put

_PROPERTIES = {"author": "mechsheet", "created": datetime(2000, 1, 1)}
_SHEETS = ("Front", "Inputs", "Input tables", "Find", "Checks", "Index", "Marks", "Scenes")
_OPTIONS: dict[str, object] = {
    "in_memory": True,  # stamps the parts of the file with a fixed date
    "default_format_properties": {"font_name": "Arial", "font_size": 10, "font_scheme": False},
    "strings_to_formulas": False,
    "strings_to_urls": False,
    "strings_to_numbers": False,
}


class Book:
    """The workbook while it is written; XlsxWriter has no types, so its objects are Any."""

    def __init__(self, title: str) -> None:
        import xlsxwriter  # type: ignore[import-untyped]  # on use: a run that writes nothing starts without it

        self.title = allowed(title)
        self._buffer = BytesIO()
        self.file = xlsxwriter.Workbook(self._buffer, _OPTIONS)
        self.file.set_properties({**_PROPERTIES, "title": self.title})
        self._names = {name.lower() for name in _SHEETS}
        self._styles: dict[Any, Any] = {}
        self.contents: list[tuple[str, str]] = []  # sheets and their titles

    def close(self) -> bytes:
        """The bytes of the file, to which nothing can be added then."""
        self.file.close()
        return self._buffer.getvalue()

    def style(self, *layers: looks.Look) -> Any:
        """The cell format of these looks, later ones prevailing."""
        look: dict[str, object] = {"valign": "vcenter"}
        for part in layers:
            look |= part
        key = (*look.items(),)
        if key not in self._styles:
            self._styles[key] = self.file.add_format(look)
        return self._styles[key]

    def name(self, text: str, ending: str = "") -> str:
        """A sheet name that Excel accepts: up to 31 UTF-16 units, none of ``[]:*?/\\``, not yet taken.

        It is cut behind a word, without an open bracket and short words at its end; only a single word loses its end.
        """
        # _x0041_ in a sheet's name is an A to Excel.
        plain = re.sub(r"[\[\]:*?/\\\s]+|_(?=x[0-9a-fA-F]{4}_)", " ", allowed(text)).strip("' ") or "Table"
        name, number = _whole_words(plain, 31 - len(ending)) + ending, 1
        while name.lower() in self._names:
            number += 1
            last = f"{ending} ({number})"
            name = _whole_words(plain, 31 - len(last)) + last
        self._names.add(name.lower())
        return name

    def sheet(
        self, name: str, heading: Content, widths: Sequence[int], top: int, size: tuple[int, int], behind: bool = False
    ) -> Any:
        """An empty sheet with its title line, ``top`` frozen rows and print setup for ``size`` in pixels.

        One that stands ``behind`` the tables has a grey tab, and nothing of it is printed.
        """
        sheet = self.file.add_worksheet(name, _sheet_class())
        self.contents.append((name, str(heading.value if isinstance(heading, Live) else heading)))
        sheet.hide_gridlines(2)
        sheet.set_default_row(looks.ROW * 0.75)
        sheet.set_row(0, 24)
        for col, width in enumerate(widths):
            sheet.set_column_pixels(col, col, width)
        sheet.freeze_panes(top, 1)
        put(sheet, 0, 0, heading, self.style({"bold": True, "font_size": 13, "font_color": looks.INK}))
        sheet.set_paper(9)
        if behind:
            sheet.set_tab_color(looks.BEHIND)
            sheet.print_area(1, len(widths), 1, len(widths))  # one cell, which is empty
            return sheet
        page = page_of(size[0])
        if page is looks.SIDEWAYS:
            sheet.set_landscape()
        # Up to a half too large is scaled down to one page; what is larger goes on over several.
        wide = 1 if size[0] < 1.5 * page[0] else math.ceil(size[0] / page[0])
        high = 1 if size[1] < 1.5 * page[1] else 0
        sheet.fit_to_pages(wide, high)
        sheet.set_margins(left=0.6, right=0.6, top=0.8, bottom=0.7)
        # Only where there is another page: to read what is repeated, LibreOffice takes a tenth of a second a sheet.
        if not high:
            sheet.repeat_rows(0, top - 1)
        if wide > 1:
            sheet.repeat_columns(0)
        # && is an ampersand, &G and &[ ask for a picture even behind another one.
        title = re.sub(r"&(?=[G\[])", "& ", cut(self.title, 100)).replace("&", "&&")
        sheet.set_header(f"&L&8 {title}&R&8 &A")
        sheet.set_footer("&C&8 &P / &N")
        return sheet

    def listing(
        self,
        name: str,
        heading: Content,
        fields: Sequence[tuple[str, looks.Look]],
        rows: Sequence[Sequence[Content]],
        *,
        behind: bool = False,
        grey: Container[int] = (),
        printed: int | None = None,
    ) -> Any:
        """A sheet of rows under (heading, look) fields, ``grey`` ones apart; a row of one text heads a section.

        Only so many of the fields are ``printed``, all of them by default.
        """
        lengths = [[*map(_length, row)] for row in rows]
        listed = [[len(head) for head, _ in fields], *(each for each in lengths if len(each) > 1)]
        longest = [*map(max, zip(*listed, strict=True))]
        widths = [looks.CHAR * min(looks.WIDEST, length) + 2 * looks.PAD for length in longest]
        sheet = self.sheet(name, heading, widths, 2, (sum(widths[:printed]), looks.ROW * (len(rows) + 3)), behind)
        if printed:
            sheet.print_area(0, 0, len(rows) + 1, printed - 1)
        for col, (head, look) in enumerate(fields):
            put(sheet, 1, col, head, self.style(looks.HEAD, looks.TOP, looks.BOTTOM, looks.side(look)))
        styles = [self.style(looks.CELL, look) for _, look in fields]
        apart = [self.style(looks.CELL, look, looks.EXPORTED) for _, look in fields]
        for n, (row, long) in enumerate(zip(rows, lengths, strict=True), 2):
            if len(row) == 1:
                sheet.set_row_pixels(n, looks.ROW + 10)
                put(sheet, n, 0, row[0], self.style(looks.SECTION))
                continue
            lines = math.ceil(max(long) / looks.WRAP)
            sheet.set_row_pixels(n, looks.ROW + (lines - 1) * (looks.ROW - 5))
            for col, (value, style) in enumerate(zip(row, apart if n - 2 in grey else styles, strict=True)):
                put(sheet, n, col, value, style)
        return sheet


@cache
def _sheet_class() -> Any:
    """XlsxWriter's worksheet with cells that are written as they are.

    Its own functions look in each formula for 150 new functions, where ours have their names, and for what else a cell
    may be: ten times as long for a workbook of long formulas.
    """
    from xlsxwriter.worksheet import (  # type: ignore[import-untyped]  # on use: as above
        CellFormulaTuple,
        CellNumberTuple,
        Worksheet,
    )

    class Sheet(Worksheet):  # type: ignore[misc]
        write_text, write_empty = Worksheet._write_string, Worksheet._write_blank

        def write_live(self, row: int, col: int, formula: str, style: Any, value: float | str) -> None:
            self._check_dimensions(row, col)  # which also notes how far the sheet goes
            self.table[row][col] = CellFormulaTuple(formula.removeprefix("="), style, value)

        def write_exact(self, row: int, col: int, value: float, style: Any) -> None:
            self._check_dimensions(row, col)
            self.table[row][col] = CellNumberTuple(value, style)

    return Sheet


def page_of(wide: int) -> tuple[int, int]:
    """The printable part of the page, upright or on its side, for what is so many pixels wide."""
    return looks.UPRIGHT if wide <= looks.UPRIGHT[0] else looks.SIDEWAYS


def _whole_words(text: str, most: int) -> str:
    """The first words of a text, up to so many UTF-16 units."""
    begun = cut(text, most)
    if begun == text:
        return text
    words = begun if text[len(begun)] == " " else begun.rpartition(" ")[0]
    while words.count("(") > words.count(")"):
        words = words.rpartition("(")[0]
    words = re.sub(r"([\s,;-]+[a-z]{0,3})+$", "", words)
    return words.rstrip("' ") or begun


def _length(value: Content) -> int:
    text = value.value if isinstance(value, Live) else value
    return max(len(text), 13 * isinstance(value, Live)) if isinstance(text, str) else 12
