"""The workbook of a worksheet: inputs, found values, tables with their charts, and checks as an Excel file."""

import math
import os
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from datetime import datetime
from functools import cache
from io import BytesIO
from itertools import groupby
from pathlib import Path
from typing import Any, NamedTuple
from uuid import uuid4

import numpy as np
from numpy.typing import NDArray

from mechsheet.recording.live import Line, Recording
from mechsheet.units import parse, shown, si
from mechsheet.workbook.cells import Home, letters
from mechsheet.workbook.twin import Section, Twin
from mechsheet.worksheet.checks import Check
from mechsheet.worksheet.errors import SheetError
from mechsheet.worksheet.table import Column, Figure, Table


class Live(NamedTuple):
    """Content of a cell: a formula, and the value that the worksheet has for it."""

    formula: str
    value: float | str


_Content = str | float | Live


@dataclass(frozen=True)
class Row:
    """One input: ``value`` is in ``unit``; neighbours of one ``section`` stand under its heading."""

    symbol: str
    value: float | int | str
    unit: str
    meaning: str
    section: str = ""


@dataclass(frozen=True)
class FoundRow:
    """One solved value in ``unit``, searched for in ``lower..upper``, and the ``residual`` that it leaves.

    ``unknown`` is what the solve block calls it, ``target`` the value that its equation must have.
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


def workbook(
    title: str,
    *,
    inputs: Sequence[Row],
    found: Sequence[FoundRow],
    tables: Sequence[Table],
    figures: Sequence[Figure],
    checks: Sequence[Check],
    recording: Recording | None = None,
) -> bytes:
    """Bytes of an .xlsx file; on one machine, with the same versions, the same input gives the same bytes.

    Elsewhere numbers may differ in their last bits, for numpy takes other code paths on other processors.

    Sheets: Inputs, Find where there are found values, one for each table named by its number and title, Checks.
    With a ``recording`` of the worksheet the cells hold formulas beside their values, and what stands behind the tables
    is listed by sections on sheets of its own, in SI units.
    A table's sheet has its title in row 1, its note in row 2, symbols in row 3, units in row 4, then the numbers
    to their last bit; pandas reads it by ``read_excel(file, sheet_name=name, header=2, skiprows=[3])``. NaN is
    the error value #N/A and an infinite number #NUM!: pandas reads both as NaN, charts leave a gap.

    A figure is a chart on the first table's sheet that holds all its columns, else on a sheet of its own
    data; the lines of its marks are drawn from the sheet Marks.
    """
    import xlsxwriter  # type: ignore[import-untyped]  # imported on use: a run that writes nothing starts without it

    buffer = BytesIO()
    book = _Book(xlsxwriter.Workbook(buffer, _options()), _text(title))
    if recording and recording.every > 1:
        figures = [_listed_points(figure, recording.every) for figure in figures]
    holders = [_holder(figure, tables) for figure in figures]
    alone = [figure for figure, holder in zip(figures, holders, strict=True) if holder is None]
    data = [Table(f"Fig {f.number}", f"Data of {_heading('figure', f)}", (f.x, *f.lines)) for f in alone]
    names = [book.name(f"{table.number} {table.title}") for table in tables]
    names_of_data = [book.name(f"{table.number} data") for table in data]
    if recording:
        rows = {row.symbol: n for n, row in _listed(inputs) if isinstance(row, Row)}
        solved = {row.symbol: n for n, row in enumerate(found, 2)}
        sheets = [*names, *names_of_data]
        book.twin = Twin(recording, [*tables, *data], sheets, rows, solved, _FIRST, book.name)
        for name, meaning in book.twin.defined:
            book.file.define_name(name, meaning)
    book.inputs(inputs)
    if found:
        book.found(found)
    for table, name in zip(tables, names, strict=True):
        held = [figure for figure, holder in zip(figures, holders, strict=True) if holder is table]
        contents = book.contents(table)
        book.table(name, _heading("Table", table), f"{table.note} {_plain(contents)}".strip(), contents, held)
    for figure, table, name in zip(alone, data, names_of_data, strict=True):
        book.table(name, table.title, "", book.contents(table), [figure])
    if book.twin:
        for section in book.twin.sections:
            book.section(section)
    book.checks(checks)
    book.marks()
    book.file.close()
    return buffer.getvalue()


def comparison(
    title: str, names: Sequence[str], rows: Sequence[Sequence[str | float]], tables: Sequence[Table]
) -> bytes:
    """Bytes of an .xlsx file with scenes side by side on the sheet Scenes, then a sheet for each table.

    A row is a symbol, its unit, its meaning and a number, verdict or text for each of the ``names``; a row of
    one text heads a section. A table's sheet is named by its title.
    """
    import xlsxwriter

    buffer = BytesIO()
    book = _Book(xlsxwriter.Workbook(buffer, _options()), _text(title))
    fields = [("Symbol", _TEXT), ("Unit", _TEXT), ("Meaning", _TEXT), *((name, _NUMBER) for name in names)]
    sheet = book.listing("Scenes", f"{title} - scenes side by side", fields, rows)
    sheet.set_column_pixels(3, 2 + len(names), _CHAR * 17 + _PAD)  # a number with all its digits
    book.verdicts(sheet, len(rows), 3, 2 + len(names))
    for table in tables:
        book.table(book.name(table.title), table.title, table.note, book.contents(table), ())
    book.file.close()
    return buffer.getvalue()


def save(data: bytes, path: Path) -> None:
    """Write a file whole or not at all.

    Raises SheetError where the folder or the disk refuses; an older file at ``path`` then stays as it was.
    """
    temporary = path.with_name(f".{path.name}.{uuid4().hex}")
    try:
        try:
            with temporary.open("xb") as file:
                file.write(data)
                file.flush()
                os.fsync(file.fileno())
            os.replace(temporary, path)
        finally:
            temporary.unlink(missing_ok=True)
    except OSError as error:
        raise SheetError(f"workbook {path} cannot be written: {error.strerror or error}") from error


@cache
def _sheet_class() -> Any:
    """XlsxWriter's worksheet, which otherwise looks for thirty new functions of Excel in every formula."""
    from xlsxwriter.worksheet import Worksheet  # type: ignore[import-untyped]

    class Sheet(Worksheet):  # type: ignore[misc]
        def write_live(self, row: int, col: int, formula: str, style: Any, value: float | str) -> None:
            self._write_formula(row, col, formula, style, value)

        def _prepare_formula(self, formula: str, expand_future_functions: bool = False) -> str:
            return formula.removeprefix("=")

    return Sheet


def _options() -> dict[str, object]:
    return {
        "in_memory": True,  # stamps the parts of the file with a fixed date
        "default_format_properties": {"font_name": "Arial", "font_size": 10, "font_scheme": False},
        "strings_to_formulas": False,
        "strings_to_urls": False,
        "strings_to_numbers": False,
    }


_PROPERTIES = {"author": "mechsheet", "created": datetime(2000, 1, 1)}
_SHEETS = ("Inputs", "Find", "Checks", "Marks", "Scenes")

_Look = Mapping[str, object]
_INK, _RULE = "#1F3864", "#7F7F7F"
_HEAD: _Look = {"bold": True, "font_color": _INK, "bg_color": "#E9EDF4"}
_TOP: _Look = {"top": 1, "top_color": _RULE}
_BOTTOM: _Look = {"bottom": 1, "bottom_color": _RULE}
_SECTION: _Look = {"bold": True, "font_color": _INK, "valign": "bottom", "indent": 1}
_NOTE: _Look = {"italic": True, "font_size": 9}
_KEY: _Look = {"font_color": _INK}
_CELL: _Look = {"bottom": 4, "bottom_color": "#C8C8C8"}
_TEXT: _Look = {"align": "left", "indent": 1, "text_wrap": True}
_NUMBER: _Look = {"align": "right"}
_FIELD: _Look = {**_NUMBER, "bg_color": "#FFF8D6", "border": 4, "border_color": _RULE}
_VALUE: _Look = {**_NUMBER, "num_format": "0.000000"}
_SMALL: _Look = {**_NUMBER, "num_format": "0.0E+00;-0.0E+00;0"}
_SI: _Look = {**_NUMBER, "num_format": "General", "font_color": "#595959"}
_SI_DECIMALS = 6
_VERDICT: _Look = {"align": "center", "bold": True}
_PASS: _Look = {"font_color": "#2F6B2F"}
_FAIL: _Look = {"font_color": "#FFFFFF", "bg_color": "#A61C1C"}  # stands out on black-and-white paper too

# Pixels at 96 dpi: a character, a cell's padding, a row; the printable part of A4 upright and on its side.
_CHAR, _PAD, _ROW = 7, 18, 21
_UPRIGHT, _SIDEWAYS = (680, 980), (1000, 650)
_WIDEST, _WRAP = 48, 58  # digits that the widest column holds, letters that fill a line of it
_FIRST = 4  # rows over the numbers of a table: title, note, symbols, units
_EMPTY = 64  # a column of no width of its own, in the last of which a chart may end
_LONG = 40  # rows; a longer table has its charts beside it, not below
_ONE, _MANY, _GAP = (590, 330), (455, 300), 14  # a chart alone, a chart among others, between charts

_LARGEST = 1e307  # Excel's numbers end at 9.99e307
_CHART = {"name": "Arial", "size": 9, "color": "#262626"}
_COLORS = ("#1F4E79", "#C55A11", "#548235", "#7030A0", "#000000", "#A61C1C", "#2E8B8B", "#806000")
_MARKERS = ("circle", "square", "triangle", "diamond", "x", "plus", "star", "short_dash")
_DASHES = ("solid", "dash", "long_dash_dot", "round_dot")


class _Exact(float):
    """A float stored to its last bit, for XlsxWriter formats numbers with 16 digits, one too few."""

    def __format__(self, spec: str) -> str:
        return float.__repr__(self)


class _Book:
    """The workbook while it is written; XlsxWriter has no types, so its objects are Any."""

    def __init__(self, file: Any, title: str) -> None:
        self.file, self.title = file, title
        self.names = {name.lower() for name in _SHEETS}
        self.styles: dict[str, Any] = {}
        self.marked: list[tuple[_Content, ...]] = []
        self.twin: Twin | None = None
        file.set_properties({**_PROPERTIES, "title": title})

    def style(self, *looks: _Look) -> Any:
        """The cell format of these looks, later ones prevailing."""
        look: dict[str, object] = {"valign": "vcenter"}
        for part in looks:
            look |= part
        key = repr(look)
        if key not in self.styles:
            self.styles[key] = self.file.add_format(look)
        return self.styles[key]

    def name(self, text: str) -> str:
        """A sheet name that Excel accepts: up to 31 UTF-16 units, none of ``[]:*?/\\``, not yet taken."""
        # _x0041_ in a sheet's name is an A to Excel.
        plain = re.sub(r"[\[\]:*?/\\\s]+|_(?=x[0-9a-fA-F]{4}_)", " ", _text(text)).strip("' ") or "Table"
        name, number = _cut(plain, 31), 1
        if name != plain and len(whole := name.rpartition(" ")[0]) > 15:
            name = whole
        while name.lower() in self.names:
            number += 1
            name = f"{_cut(plain, 31 - len(f' ({number})'))} ({number})"
        self.names.add(name.lower())
        return name

    def sheet(self, name: str, heading: str, widths: Sequence[int], top: int, size: tuple[int, int]) -> Any:
        """An empty sheet with its title line, ``top`` frozen rows and print setup for ``size`` in pixels."""
        sheet = self.file.add_worksheet(name, _sheet_class())
        sheet.hide_gridlines(2)
        sheet.set_default_row(_ROW * 0.75)
        sheet.set_row(0, 24)
        for col, width in enumerate(widths):
            sheet.set_column_pixels(col, col, width)
        sheet.freeze_panes(top, 1)
        _put(sheet, 0, 0, heading, self.style({"bold": True, "font_size": 13, "font_color": _INK}))
        sheet.set_paper(9)
        page = _page(size[0])
        if page is _SIDEWAYS:
            sheet.set_landscape()
        # Up to a half too large is scaled down to one page; what is larger goes on over several.
        wide = 1 if size[0] < 1.5 * page[0] else math.ceil(size[0] / page[0])
        sheet.fit_to_pages(wide, 1 if size[1] < 1.5 * page[1] else 0)
        sheet.set_margins(left=0.6, right=0.6, top=0.8, bottom=0.7)
        sheet.repeat_rows(0, top - 1)
        sheet.repeat_columns(0)
        # && is an ampersand, &G and &[ ask for a picture even behind another one.
        title = re.sub(r"&(?=[G\[])", "& ", _cut(self.title, 100)).replace("&", "&&")
        sheet.set_header(f"&L&8 {title}&R&8 &A")
        sheet.set_footer("&C&8 &P / &N")
        return sheet

    def listing(
        self,
        name: str,
        heading: str,
        fields: Sequence[tuple[str, _Look]],
        rows: Sequence[Sequence[_Content]],
    ) -> Any:
        """A sheet of rows under (heading, look) fields; a row of one text heads a section."""
        texts = [[head for head, _ in fields], *(row for row in rows if len(row) > 1)]
        widths = [_CHAR * min(_WIDEST, max(map(_length, column))) + 2 * _PAD for column in zip(*texts, strict=True)]
        sheet = self.sheet(name, heading, widths, 2, (sum(widths), _ROW * (len(rows) + 3)))
        for col, (head, look) in enumerate(fields):
            _put(sheet, 1, col, head, self.style(_HEAD, _TOP, _BOTTOM, _side(look)))
        styles = [self.style(_CELL, look) for _, look in fields]
        for n, row in enumerate(rows, 2):
            if len(row) == 1:
                sheet.set_row_pixels(n, _ROW + 10)
                _put(sheet, n, 0, row[0], self.style(_SECTION))
                continue
            lines = math.ceil(max(map(_length, row)) / _WRAP)
            sheet.set_row_pixels(n, _ROW + (lines - 1) * (_ROW - 5))
            for col, (value, style) in enumerate(zip(row, styles, strict=True)):
                _put(sheet, n, col, value, style)
        return sheet

    def contents(self, table: Table) -> list[tuple[Column, Sequence[_Content]]]:
        """Columns of a table with what stands in their cells."""
        columns: list[tuple[Column, Sequence[_Content]]] = []
        for n, column in enumerate(table.columns):
            formulas = self.twin.column(table, n) if self.twin else None
            columns.append((column, _live(formulas, column.values.tolist())))
        return columns

    def inputs(self, rows: Sequence[Row]) -> None:
        fields = (("Symbol", _TEXT), ("Value", _FIELD), ("Unit", _TEXT), ("Meaning", _TEXT))
        live = (("in SI units", _SI), ("Unit", _TEXT), ("Name", _TEXT)) if self.twin else ()
        listed: list[tuple[_Content, ...]] = []
        for n, row in _listed(rows):
            if not isinstance(row, Row):
                listed.append((row,))
                continue
            line: tuple[_Content, ...] = (row.symbol, row.value, shown(row.unit), row.meaning)
            if self.twin:
                node = self.twin.recording.inputs[row.symbol]
                value = Live(_taken(f"B{n + 1}", parse(row.unit).factor), float(node.value))
                line += (value, shown(si(row.unit)), node.home.name)
            listed.append(line)
        self.listing("Inputs", f"{self.title} - inputs", (*fields, *live), listed)

    def found(self, rows: Sequence[FoundRow]) -> None:
        fields = (
            *(("Symbol", _TEXT), ("Value", _VALUE), ("Unit", _TEXT), ("Meaning", _TEXT)),
            *(("Residual", _SMALL), ("Unit", _TEXT), ("From", _VALUE), ("To", _VALUE)),
            *(("Other roots", _TEXT), ("Value is", _TEXT)),
        )
        listed: list[tuple[_Content, ...]] = []
        for row in rows:
            numbers = (row.value, row.residual, row.lower, row.upper)
            formulas = self.twin.found(row.unknown, row.unit, row.residual_unit) if self.twin else (None,) * 4
            value, residual, lower, upper = (Live(f, x) if f else x for f, x in zip(formulas, numbers, strict=True))
            kind = "its closed form" if self.twin and self.twin.closed(row.unknown) else "found"
            line = (row.symbol, value, shown(row.unit), row.meaning, residual, shown(row.residual_unit), lower, upper)
            listed.append((*line, row.other_roots, kind))
        title = "Found values, the residuals that they leave and the intervals searched"
        sheet = self.listing("Find", title, fields, listed)
        for n, row in enumerate(rows, 2):
            rule = {"type": "formula", "format": self.file.add_format(_FAIL)}
            limit = 1e-9 * max(1.0, abs(row.target))
            sheet.conditional_format(n, 4, n, 4, {**rule, "criteria": f"=NOT(ABS($E${n + 1})<={limit!r})"})

    def section(self, section: Section) -> None:
        """Sheets of what stands behind the tables of a section, in SI units."""
        fields = (("Name", _TEXT), ("Value", _SI), ("Unit", _TEXT), ("Meaning", _TEXT), ("Line", _TEXT))
        listed: list[tuple[_Content, ...]] = [
            (line.node.home.name, self.value(line)[0], shown(si(line.unit)), line.meaning, line.text)
            for line in section.single
        ]
        listed += [
            (line.node.home.name, f"column {letters(n)}", shown(si(line.unit)), line.meaning, line.text)
            for n, line in enumerate(section.fields)
        ]
        title = f"{section.title} - lines behind the tables, in SI units"
        self.listing(section.listing, title, fields, listed)
        if section.fields:
            columns: list[tuple[Column, Sequence[_Content]]] = []
            for line in section.fields:
                values = np.asarray(line.node.value, float).reshape(-1)
                columns.append((Column(line.node.home.name, si(line.unit), "", _SI_DECIMALS, values), self.value(line)))
            self.table(section.sheet, f"{section.title} - fields, in SI units", "", columns, [], _SI)

    def value(self, line: Line) -> Sequence[_Content]:
        formulas = self.twin.line(line) if self.twin else None
        return _live(formulas, np.asarray(line.node.value, float).reshape(-1).tolist())

    def checks(self, checks: Sequence[Check]) -> None:
        fields = (
            *(("Check", _TEXT), ("Residual", _SMALL), ("Limit", _SMALL), ("Unit", _TEXT)),
            *(("Verdict", _VERDICT), ("Reason", _TEXT)),
        )
        listed: list[tuple[_Content, ...]] = []
        for n, c in enumerate(checks, 3):
            live = self.twin and self.twin.check(c.name)
            known = "PASS" if c.passed else "FAIL"
            verdict: _Content = known
            residual: _Content = c.residual
            limit: _Content = c.limit
            if live:
                residual = Live(live.residual, c.residual)
                if math.isclose(live.bound, c.limit, rel_tol=1e-9):  # a scene may have set another
                    limit = Live(live.limit, c.limit)
                verdict = Live(f'=IF(IFERROR(B{n}<=C{n},FALSE),"PASS","FAIL")', known)
            listed.append((c.name, residual, limit, shown(c.unit), verdict, c.reason))
        if self.twin and (guard := self.twin.guard()):
            n = len(checks) + 3
            what = "made for these inputs: where this fails, export the worksheet again"
            verdict = Live(f'=IF(IFERROR(B{n}<=C{n},FALSE),"PASS","FAIL")', "PASS")
            listed.append((what, Live(guard, 0.0), 0.0, "-", verdict, ""))
        passed = sum(check.passed for check in checks)
        sheet = self.listing("Checks", f"Checks: {passed} of {len(checks)} passed", fields, listed)
        self.verdicts(sheet, len(listed), 4, 4)

    def verdicts(self, sheet: Any, rows: int, first: int, last: int) -> None:
        """Colour the verdicts in some columns of a listing."""
        for verdict, look in (("PASS", _PASS), ("FAIL", _FAIL)):
            rule = {"type": "cell", "criteria": "==", "value": f'"{verdict}"', "format": self.file.add_format(look)}
            sheet.conditional_format(2, first, rows + 2, last, rule)

    def marks(self) -> None:
        fields = (
            ("Figure", _TEXT),
            ("Mark", _TEXT),
            ("x", _VALUE),
            ("x", _VALUE),
            ("y from", _NUMBER),
            ("y to", _NUMBER),
        )
        if self.marked:
            self.listing("Marks", "Ends of the vertical lines in the figures", fields, self.marked)

    def table(
        self,
        name: str,
        heading: str,
        note: str,
        contents: Sequence[tuple[Column, Sequence[_Content]]],
        figures: Sequence[Figure],
        numbers: _Look | None = None,
    ) -> None:
        """A sheet of numbers under their symbols and units, with the charts of ``figures``."""
        columns = [column for column, _ in contents]
        rows, count = max(len(column.values) for column in columns), len(figures)
        widths = [_CHAR * (13 if numbers else min(_WIDEST, _digits(column))) + _PAD for column in columns]
        width, height = _ONE if count == 1 else _MANY
        # Charts stand clear of the frozen rows and column, which would cut them when the sheet is scrolled.
        if rows <= _LONG:
            high = (_FIRST + rows + 2) * _ROW + math.ceil(count / 2) * (height + _GAP)
            wide = max(sum(widths), widths[0] + min(count, 2) * (width + _GAP))
            sheet = self.sheet(name, heading, widths, _FIRST, (wide, high))
            places = [(_FIRST + rows + 1, 1, n % 2 * (width + _GAP), n // 2 * (height + _GAP)) for n in range(count)]
        else:
            wide = sum(widths) + min(count, 1) * (width + _GAP + _EMPTY)
            sheet = self.sheet(name, heading, widths, _FIRST, (wide, rows * _ROW))
            held = _break(sheet, wide, rows)
            fitting = round(held * _ROW / height)
            pitch = held // fitting
            height = pitch * _ROW - _GAP
            places = [(_FIRST + n // fitting * held + n % fitting * pitch, len(columns), _GAP, 0) for n in range(count)]
        sheet.set_row_pixels(1, _ROW if note else _ROW // 3)
        _put(sheet, 1, 0, note, self.style(_NOTE))
        for col, (column, cells) in enumerate(contents):
            side = _side(_NUMBER if column.unit or numbers else _TEXT)
            _put(sheet, 2, col, column.symbol, self.style(_HEAD, side, _TOP))
            _put(sheet, 3, col, shown(column.unit), self.style(_HEAD, side, _BOTTOM, {"bold": False}))
            if column.meaning:
                sheet.write_comment(2, col, _text(column.meaning), {"font_name": "Arial", "font_size": 9})
            power = "E+00" if column.power else ""
            look = {**side, **({} if col else _KEY), "num_format": f"{0:.{column.decimals}f}{power}", **(numbers or {})}
            style, last = self.style(look, _CELL), self.style(look, _BOTTOM)
            for row, value in enumerate(cells, _FIRST):
                _put(sheet, row, col, value, style if row < _FIRST + rows - 1 else last)
        for figure, (row, col, right, down) in zip(figures, places, strict=True):
            chart = self.chart(figure, name, columns)
            chart.set_size({"width": width, "height": height})
            place = {"x_offset": right, "y_offset": down, "object_position": 2}
            sheet.insert_chart(row, col, chart, {**place, "description": _heading("Figure", figure)})

    def chart(self, figure: Figure, name: str, columns: Sequence[Column]) -> Any:
        """A chart of the cells of sheet ``name``; positions to mark are noted for the sheet Marks."""
        chart = self.file.add_chart({"type": "scatter", "subtype": "straight_with_markers"})

        def cells(column: Column, part: slice) -> list[str | int]:
            col = next(col for col, other in enumerate(columns) if _same(column, other))
            return [name, _FIRST + part.start, col, _FIRST + part.stop - 1, col]

        for n, (line, part, called) in enumerate(figure.series()):
            color = _COLORS[n % len(_COLORS)]
            marker = {"type": _MARKERS[n % len(_MARKERS)], "size": 5, "border": {"color": color}}
            chart.add_series(
                {
                    "name": called or [name, 2, cells(line, part)[2]],
                    "categories": cells(figure.x, part),
                    "values": cells(line, part),
                    # What a viewer draws that reads no cells; without it #N/A would be a zero there.
                    "categories_data": _drawn(figure.x.values[part]),
                    "values_data": _drawn(line.values[part]),
                    "line": {"color": color, "width": 1.75, "dash_type": _DASHES[n // 2 % len(_DASHES)]},
                    "marker": {**marker, "fill": {"color": color}}
                    if part.stop - part.start <= _LONG
                    else {"type": "none"},
                    "smooth": False,
                }
            )

        def range_of(place: list[str | int]) -> str:
            sheet, top, col, bottom, _ = place
            return Home("", str(sheet), int(top), int(col)).range(0, int(bottom) - int(top))

        axis = _decades if figure.logarithmic else _axis
        x = axis(np.append(figure.x.values, [at for _, at in figure.marks]))
        y = axis(np.concatenate([line.values for line in figure.lines]))
        for label, at in figure.marks:
            row = len(self.marked) + 2
            place: _Content = at
            ends: list[_Content] = [y["min"], y["max"]]
            if formula := self.twin and self.twin.mark(figure.number, label, figure.x.unit):
                place = Live(formula, at)
                numbers = np.concatenate([line.values for line in figure.lines])
                ranges = ",".join(range_of(cells(line, part)) for line, part, _ in figure.series())
                ends = [Live(f"={f}({ranges})", float(g(numbers))) for f, g in (("MIN", np.min), ("MAX", np.max))]
            self.marked.append((_heading("Figure", figure), label, place, place, *ends))
            chart.add_series(
                {
                    "name": ["Marks", row, 1],
                    "categories": ["Marks", row, 2, row, 3],
                    "values": ["Marks", row, 4, row, 5],
                    "line": {"color": "#404040", "width": 1, "dash_type": "dash"},
                    "marker": {"type": "none"},
                    "data_labels": {
                        "series_name": True,
                        "position": "right",
                        "font": _CHART,
                        "custom": [{"delete": True}],
                    },
                    "smooth": False,
                }
            )
        chart.set_title({"name": _label(_heading("Figure", figure)), "name_font": {**_CHART, "size": 11, "bold": True}})
        look = {
            "name_font": {**_CHART, "bold": False},
            "num_font": _CHART,
            "label_position": "low",
            "line": {"color": _RULE},
            "major_gridlines": {"visible": True, "line": {"color": "#D9D9D9", "width": 0.5}},
        }
        if self.twin and not figure.logarithmic:  # axes follow the numbers
            x = y = {}
        chart.set_x_axis({**look, **x, "name": _label(_quantity([figure.x]))})
        chart.set_y_axis({**look, **y, "name": _label(_quantity(figure.lines))})
        lines = len(figure.series())
        several = lines > 1
        marks = list(range(lines, lines + len(figure.marks)))
        chart.set_legend({"position": "bottom" if several else "none", "font": _CHART, "delete_series": marks})
        chart.set_chartarea({"border": {"color": "#BFBFBF"}})
        chart.show_na_as_empty_cell()
        return chart


def _listed(rows: Sequence[Row]) -> Iterator[tuple[int, Row | str]]:
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


def _plain(contents: Sequence[tuple[Column, Sequence[_Content]]]) -> str:
    """Note of the columns without formulas, labels of the rows apart, in a table that has some with them."""
    live = [any(isinstance(value, Live) for value in cells) for _, cells in contents]
    plain = [c.symbol for (c, _), has in zip(contents, live, strict=True) if not has and c.unit and c.decimals]
    if not plain or not any(live):
        return ""
    return f"Numbers, not formulas: {', '.join(plain)}; the checks tell whether they still hold."


def _live(formulas: Sequence[str] | None, values: Sequence[float]) -> Sequence[_Content]:
    return [Live(*pair) for pair in zip(formulas, values, strict=True)] if formulas else values


def _put(sheet: Any, row: int, col: int, value: _Content, style: Any) -> None:
    """A text as a text, a number as a number, NaN as #N/A; a text of nothing leaves the cell empty."""
    if isinstance(value, Live):
        known = value.value
        if isinstance(known, float) and not _fits(known):
            known = "#N/A"
        sheet.write_live(row, col, value.formula, style, known)
    elif value == "":
        sheet.write_blank(row, col, None, style)
    elif isinstance(value, str):
        sheet.write_string(row, col, _text(value), style)
    elif _fits(value):
        sheet.write_number(row, col, value if isinstance(value, int) else _Exact(value), style)
    else:
        # XlsxWriter has no cell of an error alone; the formula that is this error keeps it as its value.
        error = "#N/A" if math.isnan(value) else "#NUM!"
        sheet.write_formula(row, col, f"={error}", style, error)


def _page(wide: int) -> tuple[int, int]:
    return _UPRIGHT if wide <= _UPRIGHT[0] else _SIDEWAYS


def _break(sheet: Any, wide: int, rows: int) -> int:
    """Break a long table into pages one page wide; the rows of a page.

    Breaks are ignored where a sheet is fitted to pages, and a page's end might cut a chart: so the scale is set.
    """
    page = _page(wide)
    scale = max(0.1, min(1.0, 0.97 * page[0] / wide))
    held = int(page[1] / scale / _ROW) - 5
    sheet.set_print_scale(int(100 * scale))
    sheet.set_h_pagebreaks(range(_FIRST + held, _FIRST + rows, held))
    return held


def _fits(value: float) -> bool:
    """Whether Excel can hold the number; it has no NaN."""
    return abs(value) < _LARGEST


def _text(text: str) -> str:
    """Text that a cell can hold: characters that XML forbids are shown as �.

    XlsxWriter takes ``<r>..</r>`` for markup of its own, so a space is put before it.
    """
    if text.isprintable() and not text.startswith("<r>"):
        return text
    text = re.sub("[\x00-\x08\x0b-\x1f\x7f\ud800-\udfff\ufffe\uffff]", "�", text)
    return f" {text}" if text.startswith("<r>") else text


def _label(text: str) -> str:
    """Text of a chart, which XlsxWriter would take for a reference where it holds one such as ``!A1``."""
    return _text(text).replace("!", "! ")


def _cut(text: str, units: int) -> str:
    """The beginning of a text that has at most so many UTF-16 units, as Excel counts them."""
    return text.encode("utf-16-le")[: 2 * units].decode("utf-16-le", "ignore").rstrip("' ")


def _side(look: _Look) -> _Look:
    return {key: look[key] for key in ("align", "indent") if key in look}


def _length(value: _Content) -> int:
    return len(value) if isinstance(value, str) else 12


def _digits(column: Column) -> int:
    """Characters of the widest cell."""
    return max(6, len(column.symbol), len(column.unit), *map(len, column.texts()))


def _heading(kind: str, numbered: Table | Figure) -> str:
    return _text(f"{kind} {numbered.number} - {numbered.title}")


def _quantity(columns: Sequence[Column]) -> str:
    """Symbols and units of what an axis shows: ``S [m]``, ``G56, GS6 [N]``, ``R56 .. R01 [N]``."""
    parts = []
    for unit, members in groupby(columns, key=lambda column: column.unit):
        symbols = [column.symbol for column in members]
        names = ", ".join(symbols) if len(symbols) <= 4 else f"{symbols[0]} .. {symbols[-1]}"
        parts.append(f"{names} [{shown(unit)}]")
    return ", ".join(parts)


def _same(a: Column, b: Column) -> bool:
    return a is b or ((a.symbol, a.unit) == (b.symbol, b.unit) and np.array_equal(a.values, b.values, equal_nan=True))


def _holder(figure: Figure, tables: Sequence[Table]) -> Table | None:
    """The first table that has every column of the figure."""
    wanted = (figure.x, *figure.lines)
    held = (t for t in tables if all(any(_same(column, other) for other in t.columns) for column in wanted))
    return next(held, None)


def _listed_points(figure: Figure, every: int) -> Figure:
    """The figure over the positions that the tables list, whose cells are live."""

    def thinned(column: Column) -> Column:
        return replace(column, values=column.values[::every])

    return replace(figure, x=thinned(figure.x), lines=tuple(map(thinned, figure.lines)))


def _drawn(values: NDArray[np.float64]) -> list[float | None]:
    return [float(value) if _fits(value) else None for value in values]


def _axis(values: NDArray[np.float64]) -> dict[str, Any]:
    """Limits, step and number format of an axis in round numbers; Excel's own often start at zero."""
    values = values[np.abs(values) < _LARGEST]
    low, high = (float(values.min()), float(values.max())) if values.size else (0.0, 1.0)
    if high - low <= max(1e-9 * abs(low), 1e-9 * abs(high), 1e-300):
        low, high = low - (abs(low) / 2 or 0.5), high + (abs(high) / 2 or 0.5)
    fifth = (high - low) / 5
    power = math.floor(math.log10(fifth))
    steps = ((1, 0), (2, 0), (2.5, 1), (5, 0), (10, -1))
    step, more = next((m * 10.0**power, more) for m, more in steps if m * 10.0**power >= 0.999 * fifth)
    low, high = (round(end(edge / step) * step, 1 - power) for end, edge in ((math.floor, low), (math.ceil, high)))
    decimals = max(0, more - power)
    plain = decimals < 6 and max(abs(low), abs(high)) < 1e7
    return {"min": low, "max": high, "major_unit": step, "num_format": f"{0:.{decimals}f}" if plain else "0.0E+00"}


def _decades(values: NDArray[np.float64]) -> dict[str, Any]:
    """Limits and number format of a logarithmic axis in whole decades, the other axis at its low end."""
    low, high = (float(10.0 ** end(np.log10(v))) for end, v in ((np.floor, values.min()), (np.ceil, values.max())))
    return {"log_base": 10, "min": low, "max": max(high, 10 * low), "crossing": low, "num_format": "0E+00"}
