"""The sheet of a table: its numbers under their symbols and units, and the places of the charts on it."""

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

from mechsheet.units import shown
from mechsheet.workbook import looks
from mechsheet.workbook.book import Book, page_of
from mechsheet.workbook.content import Content, Live, allowed, computed, put
from mechsheet.workbook.looks import CHAR, EMPTY, FIRST, GAP, LONG, PAD, ROW
from mechsheet.workbook.sheet_formulas import SheetFormulas
from mechsheet.workbook.sizes import Sizes
from mechsheet.worksheet.table import Column, Table

Contents = Sequence[tuple[Column, Sequence[Content]]]


class Spot(NamedTuple):
    """Where a chart stands: the cell of its corner, pixels right of it and below, and its size."""

    row: int
    column: int
    right: int
    down: int
    width: int
    height: int


def contents(table: Table, formulas: SheetFormulas | None) -> Contents:
    """Columns of a table with what stands in their cells."""
    texts = [formulas.column(table, n) if formulas else None for n in range(len(table.columns))]
    return [(column, computed(t, column.values.tolist())) for column, t in zip(table.columns, texts, strict=True)]


def not_followed(columns: Sequence[Column], grey: Sequence[int]) -> str:
    """Note of the columns that hold for the exported inputs alone, and of a table without rows, which has no cells."""
    if not len(columns[0].values):
        return "No rows for the exported inputs; for others the cells tell none."
    symbols = ", ".join(columns[n].symbol for n in grey)
    return f"As exported, #N/A for other inputs: {symbols}." if grey else ""


def write(
    book: Book,
    name: str,
    heading: Content,
    note: Content,
    columns: Contents,
    charts: int = 0,
    numbers: looks.Look | None = None,
    grey: Sequence[int] = (),
    behind: bool = False,
) -> tuple[Any, list[Spot]]:
    """A sheet of numbers under their symbols and units, ``grey`` columns apart, and the places of charts on it."""
    rows = max(len(column.values) for column, _ in columns)
    live = [bool(cells) and isinstance(cells[0], Live) for _, cells in columns]
    rooms = [13 if numbers else _room(column, typed) for (column, _), typed in zip(columns, live, strict=True)]
    widths = [CHAR * room + PAD for room in rooms]
    sheet, spots = (_short if rows <= LONG else _long)(book, name, heading, widths, rows, charts, behind)
    sheet.set_row_pixels(1, ROW if note else ROW // 3)
    put(sheet, 1, 0, note, book.style(looks.NOTE))
    sizes = Sizes(book, sheet)
    for col, (column, cells) in enumerate(columns):
        side = looks.side(looks.NUMBER if column.unit or numbers else looks.TEXT)
        put(sheet, 2, col, column.symbol, book.style(looks.HEAD, side, looks.TOP))
        put(sheet, 3, col, shown(column.unit), book.style(looks.HEAD, side, looks.BOTTOM, {"bold": False}))
        if column.meaning:
            sheet.write_comment(2, col, allowed(column.meaning), {"font_name": "Arial", "font_size": 9})
        look = {**side, **({} if col else looks.KEY), "num_format": column.number_format, **(numbers or {})}
        look |= {} if column.unit or numbers else {"shrink": True}  # a text that is typed may be longer
        look |= looks.EXPORTED if col in grey else {}
        style, last = book.style(look, looks.CELL), book.style(look, looks.BOTTOM)
        for row, value in enumerate(cells, FIRST):
            put(sheet, row, col, value, style if row < FIRST + rows - 1 else last)
        if numbers is None and live[col]:
            sizes.follow((FIRST, col, FIRST + rows - 1, col), column, rooms[col])
    sizes.write()
    return sheet, spots


# Charts stand clear of the frozen rows and column, which would cut them when the sheet is scrolled.


def _short(
    book: Book, name: str, heading: Content, widths: Sequence[int], rows: int, charts: int, behind: bool
) -> tuple[Any, list[Spot]]:
    """An empty sheet with its charts below the numbers, two side by side."""
    width, height = looks.ONE if charts == 1 else looks.MANY
    high = (FIRST + rows + 2) * ROW + math.ceil(charts / 2) * (height + GAP)
    wide = max(sum(widths), widths[0] + min(charts, 2) * (width + GAP))
    sheet = book.sheet(name, heading, widths, FIRST, (wide, high), behind)
    corners = [(n % 2 * (width + GAP), n // 2 * (height + GAP)) for n in range(charts)]
    return sheet, [Spot(FIRST + rows + 1, 1, right, down, width, height) for right, down in corners]


def _long(
    book: Book, name: str, heading: Content, widths: Sequence[int], rows: int, charts: int, behind: bool
) -> tuple[Any, list[Spot]]:
    """An empty sheet with its charts beside the numbers, as many to a page as go into its height."""
    width, height = looks.ONE if charts == 1 else looks.MANY
    wide = sum(widths) + min(charts, 1) * (width + GAP + EMPTY)
    sheet = book.sheet(name, heading, widths, FIRST, (wide, rows * ROW), behind)
    held = _break(sheet, wide, rows)
    if not behind:
        sheet.repeat_rows(0, FIRST - 1)
    fitting = round(held * ROW / height)
    pitch = held // fitting
    tops = [FIRST + n // fitting * held + n % fitting * pitch for n in range(charts)]
    return sheet, [Spot(top, len(widths), GAP, 0, width, pitch * ROW - GAP) for top in tops]


def _break(sheet: Any, wide: int, rows: int) -> int:
    """Break a long table into pages one page wide; the rows of a page.

    Breaks are ignored where a sheet is fitted to pages, and a page's end might cut a chart: so the scale is set.
    """
    page = page_of(wide)
    scale = max(0.1, min(1.0, 0.85 * page[0] / wide))  # columns are wider in LibreOffice than in Excel
    held = int(page[1] / scale / ROW) - 5
    sheet.set_print_scale(int(100 * scale))
    sheet.set_h_pagebreaks(range(FIRST + held, FIRST + rows, held))
    return held


def _room(column: Column, live: bool) -> int:
    """Characters for which its cells have room; a text that follows what is typed may be longer than it is now."""
    least = looks.TYPED_ROOM if live and not column.unit else 7
    return min(looks.WIDEST, max(least, len(column.symbol), len(column.unit), *map(len, column.texts())))
