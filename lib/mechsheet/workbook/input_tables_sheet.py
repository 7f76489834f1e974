"""The sheet of the lists and tables among the inputs: each a grid that is edited, or pasted over, row by row."""

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, NamedTuple

from mechsheet.units import shown, si
from mechsheet.workbook import input_formulas, looks
from mechsheet.workbook.book import Book
from mechsheet.workbook.content import Content, Live, allowed, cut, holding, put
from mechsheet.workbook.place import Place, letters, quoted
from mechsheet.workbook.sheet_formulas import SheetFormulas
from mechsheet.worksheet import numbers
from mechsheet.worksheet.lists import MOST_ROWS

SHEET = "Input tables"
_FIRST = 7  # rows over the numbers: title, note, name of the table, meanings, limits, symbols, units
_WIDTH = 12  # characters of a column, at least
_HELD = 4  # columns of what is held of each column that is edited: in SI units, as read, as exported, differs
_NOTED = 480  # pixels in which the title and, in two lines, the note find room
_NOTE = "Rows may be added below or taken out. The cells of this workbook are made for as many as there are: run the "
_NOTE += "worksheet with it as a scene."


class GridColumn(NamedTuple):
    """A column of numbers in its ``unit``, or of texts, under its full name, such as ``bolts.x``."""

    symbol: str
    values: tuple[Any, ...]
    unit: str
    meaning: str
    limits: tuple[tuple[str, str], ...] = ()
    whole: bool = False
    is_text: bool = False

    @property
    def allowed(self) -> str:
        """The limits in words, columns of the same table by their own name."""
        own = (f"{sign} {other.rpartition('.')[2] if '.' in self.symbol else other}" for sign, other in self.limits)
        return ", ".join(["whole number"] * self.whole + [*own])


class Grid(NamedTuple):
    """A table, or a list of one column, with its place among the inputs."""

    symbol: str
    meaning: str
    section: str
    columns: tuple[GridColumn, ...]

    @property
    def told(self) -> str:
        """Where its numbers are, in words."""
        return f"{len(self.columns[0].values)} rows on the sheet {SHEET}"


class _Spot(NamedTuple):
    """Where a column stands: itself, and the first column of what is held of it."""

    column: GridColumn
    edited: int
    held: int

    def cell(self, row: int, held: int | None = None) -> str:
        """Address of the number of a row, or of what is held of it, in the same row of another formula."""
        return f"${letters(self.edited if held is None else self.held + held)}{row + 1}"

    def range(self, held: int) -> str:
        """Address of what is held of all rows."""
        column = letters(self.held + held)
        return f"${column}${_FIRST + 1}:${column}${_FIRST + len(self.column.values)}"


def _spots(grids: Sequence[Grid]) -> list[_Spot]:
    """The columns of all grids side by side, an empty one between two grids; then what is held of them."""
    edited, at = list[tuple[GridColumn, int]](), 1
    for grid in grids:
        edited += [(column, at + n) for n, column in enumerate(grid.columns)]
        at += len(grid.columns) + 1
    return [_Spot(column, own, at + _HELD * n) for n, (column, own) in enumerate(edited)]


def places(grids: Sequence[Grid]) -> dict[str, Place]:
    """Where the numbers in SI units stand, by symbol."""
    spots = _spots(grids)
    return {s.column.symbol: Place("", SHEET, _FIRST, s.held, differs=3, typed=s.edited - s.held) for s in spots}


def as_read(grids: Sequence[Grid]) -> dict[str, str]:
    """Addresses of the numbers as they are read, by symbol."""
    return {s.column.symbol: f"{quoted(SHEET)}!{s.range(1)}" for s in _spots(grids)}


def differing(grids: Sequence[Grid]) -> Iterator[str]:
    """Addresses of what tells of each number whether it differs from the exported one."""
    yield from (f"{quoted(SHEET)}!{spot.range(3)}" for spot in _spots(grids))


def write(book: Book, grids: Sequence[Grid], others: Mapping[str, str], formulas: SheetFormulas | None) -> None:
    """The sheet of all grids; with ``formulas`` their numbers also in SI units, under the names that formulas use.

    ``others`` are the addresses of the inputs on the sheet Inputs, as they are read.
    """
    spots, rows = _spots(grids), max(len(grid.columns[0].values) for grid in grids)
    characters = {s.edited: _characters(s.column) for s in spots}
    end = max(characters) + 1
    widths = [looks.CHAR * characters.get(n, 4) + looks.PAD for n in range(end)]
    if sum(widths) < _NOTED:  # paper ends where the grids do: the empty column behind them takes what is over them
        widths, end = [*widths, _NOTED - sum(widths)], end + 1
    widths += [looks.CHAR * _WIDTH + looks.PAD] * (_HELD * len(spots) if formulas else 0)
    size = sum(widths[:end]), looks.ROW * (rows + _FIRST + 3)
    sheet = book.sheet(SHEET, f"{book.title} - tables of the inputs", widths, _FIRST, size)
    sheet.print_area(0, 0, _FIRST + rows - 1, end - 1)
    sheet.merge_range(1, 0, 1, end - 1, _NOTE, book.style(looks.NOTE, {"text_wrap": True}))
    sheet.set_row_pixels(1, looks.ROW * 2)
    for k in range(rows):
        put(sheet, _FIRST + k, 0, k + 1, book.style(looks.CELL, looks.NUMBER, looks.KEY))
    at, text = 1, book.style(looks.SECTION, {"text_wrap": True, "indent": 0})
    for grid in grids:
        if grid.columns[0].symbol != grid.symbol:
            heading, last = allowed(f"{grid.symbol}: {grid.meaning}"), at + len(grid.columns) - 1
            sheet.merge_range(2, at, 2, last, heading, text) if last > at else put(sheet, 2, at, heading, text)
        at += len(grid.columns) + 1
    lines = [max(math.ceil(len(_words(s.column)[n]) / (characters[s.edited] - 1)) for s in spots) for n in (0, 1)]
    for row, count in zip((3, 4), lines, strict=True):
        sheet.set_row_pixels(row, looks.ROW + max(count - 1, 0) * (looks.ROW - 5))
    sheet.set_row_pixels(2, looks.ROW * 2)
    by_symbol = {spot.column.symbol: spot for spot in spots}
    counted = {column.symbol: by_symbol[_counted(column, grid).symbol] for grid in grids for column in grid.columns}
    for spot in spots:
        _heads(book, sheet, spot)
        _column(book, sheet, spot, formulas)
        if formulas:
            _held(book, sheet, spot, by_symbol, counted[spot.column.symbol], others, formulas)


def _counted(column: GridColumn, grid: Grid) -> GridColumn:
    """The column by which rows are counted: itself, of texts, which may be empty, one of numbers where there is one."""
    return next((each for each in grid.columns if not each.is_text), column) if column.is_text else column


def _words(column: GridColumn) -> tuple[str, str]:
    return column.meaning, column.allowed


def _characters(column: GridColumn) -> int:
    """Characters of a column's width."""
    texts = (x if isinstance(x, str) else numbers.significant(x, 15) for x in column.values)
    least = looks.TYPED_ROOM if column.is_text else _WIDTH
    return max(least, len(column.symbol), *(min(len(text), looks.WIDEST) for text in texts))


def _heads(book: Book, sheet: Any, spot: _Spot) -> None:
    column, head = spot.column, looks.TEXT if spot.column.is_text else looks.NUMBER
    side = {**looks.side(head), "text_wrap": True, "valign": "bottom"}
    put(sheet, 3, spot.edited, column.meaning, book.style(looks.NOTE, side))
    put(sheet, 4, spot.edited, column.allowed, book.style(looks.NOTE, side))
    unit = "" if column.is_text else shown(column.unit)
    put(sheet, 5, spot.edited, column.symbol, book.style(looks.HEAD, head, looks.TOP))
    put(sheet, 6, spot.edited, unit, book.style(looks.HEAD, head, looks.BOTTOM, {"bold": False}))


def _column(book: Book, sheet: Any, spot: _Spot, formulas: SheetFormulas | None) -> None:
    followed = not formulas or spot.column.symbol in formulas.arrangement.followed
    text = {**looks.TEXT, **looks.TYPED} if spot.column.is_text else {}
    style = book.style(looks.CELL, looks.FIELD if followed else looks.NUMBER, text)
    for k, value in enumerate(spot.column.values):
        put(sheet, _FIRST + k, spot.edited, value, style)


def _held(
    book: Book,
    sheet: Any,
    spot: _Spot,
    by_symbol: Mapping[str, _Spot],
    counting: _Spot,
    others: Mapping[str, str],
    formulas: SheetFormulas,
) -> None:
    """What is held of a column, and what may be typed into it, in rows that are added too."""
    column, node = spot.column, formulas.recording.inputs[spot.column.symbol]
    first, head = _FIRST, book.style(looks.HEAD, looks.NUMBER, looks.TOP)
    small, below = book.style(looks.CELL, looks.SI), book.style(looks.HEAD, looks.NUMBER, looks.BOTTOM, {"bold": False})
    heads = ("differs" if column.is_text else "in SI units", "as read", "as exported", "differs")
    filled = sum(value != "" for value in counting.column.values)
    count = Live(f"=COUNTA({counting.cell(first)}:{counting.cell(first + MOST_ROWS - 1)})", float(filled))
    under: tuple[Content, ...] = ("" if column.is_text else shown(si(column.unit)), count, "", "")
    for n, (name, beneath) in enumerate(zip(heads, under, strict=True)):
        put(sheet, 5, spot.held + n, name, head)
        put(sheet, 6, spot.held + n, beneath, below)
    put(sheet, 4, spot.held, f"name: {formulas.name(node)}", book.style(looks.NOTE, {"align": "right"}))
    counted = f"${letters(spot.held + 1)}${first}"
    for k, value in enumerate(column.values):
        row, limiting = first + k, dict(others)
        limiting |= {name: other.cell(row, 1) for name, other in by_symbol.items()}
        rules = [
            *input_formulas.limits(column.limits, column.whole, spot.cell(row, 1), limiting),
            f"{counted}={filled}",
        ]
        unit = f"${letters(spot.edited)}${first}"
        read, exported = spot.cell(row, 1), node.value.reshape(-1)[k].item()
        held: tuple[str, float] = (
            (input_formulas.differing(spot.cell(row), value), 0.0)
            if isinstance(value, str)
            else (input_formulas.read(spot.cell(row)), value)
        )
        cells: tuple[Content, ...] = (
            Live(input_formulas.in_si(read, unit, column.unit, rules), exported),
            Live(*held),
            held[1],
            Live(input_formulas.differs(spot.cell(row, 0), read, spot.cell(row, 2)), 0.0),
        )
        for n, cell in enumerate(cells):
            put(sheet, row, spot.held + n, cell, small)
    sheet.data_validation(first, spot.edited, first + MOST_ROWS - 1, spot.edited, _validation(spot, by_symbol, others))


def _validation(spot: _Spot, by_symbol: Mapping[str, _Spot], others: Mapping[str, str]) -> dict[str, object]:
    """What a spreadsheet program takes into the cells of a column; a text is judged by its value in SI units."""
    column, cell = spot.column, spot.cell(_FIRST)
    if column.is_text:
        return {"validate": "any", **_told(column, column.meaning)}
    rules = [f"ISNUMBER({cell})", *input_formulas.limits([], column.whole, cell, {})]
    for pair in column.limits:
        beside = by_symbol.get(pair[1])
        limiting = {**others, **({pair[1]: beside.cell(_FIRST)} if beside else {})}
        (rule,) = input_formulas.limits([pair], False, cell, limiting)
        rules.append(f"OR(ISTEXT({beside.cell(_FIRST)}),{rule})" if beside else rule)
    limits = f"Limits: {column.allowed}. " if column.allowed else ""
    return {
        "validate": "custom",
        "value": holding(f"IF(ISTEXT({cell}),TRUE,AND({','.join(rules)}))"),
        "ignore_blank": True,  # rows may be taken out
        **_told(column, f"{column.meaning} [{shown(column.unit)}]. {limits}Decimal point, or comma as text."),
        "error_title": "Outside the limits",
        "error_message": cut(allowed(f"{column.symbol}: {column.allowed or 'a number'}"), 255),
        "error_type": "stop",
    }


def _told(column: GridColumn, message: str) -> dict[str, object]:
    """What a spreadsheet program shows beside a cell that is edited."""
    return {"input_title": cut(allowed(column.symbol), 32), "input_message": cut(allowed(message), 255)}
