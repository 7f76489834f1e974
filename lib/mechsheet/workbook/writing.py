"""Workbooks as the bytes of a file: that of a worksheet, and that of scenes side by side."""

import math
from collections.abc import Callable, Container, Mapping, Sequence
from dataclasses import replace
from itertools import count
from typing import Any

from mechsheet.quantities.lines import Recording
from mechsheet.workbook import (
    checks_sheet,
    find_sheet,
    front_sheet,
    index_sheet,
    inputs_sheet,
    looks,
    section_sheets,
    table_sheet,
)
from mechsheet.workbook.arrangement import Arrangement
from mechsheet.workbook.book import Book
from mechsheet.workbook.chart import Charts, Listed, same_column
from mechsheet.workbook.content import caption
from mechsheet.workbook.find_sheet import FoundRow
from mechsheet.workbook.inputs_sheet import Item
from mechsheet.workbook.place import Place
from mechsheet.workbook.sheet_formulas import SheetFormulas
from mechsheet.worksheet.check import Check
from mechsheet.worksheet.index import Index
from mechsheet.worksheet.table import Column, Figure, Table

_DIGITS, _TEXT = 17, 30  # characters of a number with all its digits, and of a line of a long text
_PACKED = 4  # times as long as putting the cells takes the whole file


def workbook(
    title: str,
    *,
    inputs: Sequence[Item],
    found: Sequence[FoundRow],
    tables: Sequence[Table],
    figures: Sequence[Figure],
    checks: Sequence[Check],
    recording: Recording | None = None,
    fixed: Container[str] = (),
    index: Index | None = None,
    proved: Mapping[str, float] | None = None,
    done: Callable[[int, int], object] = lambda behind, count: None,
) -> bytes:
    """Bytes of an .xlsx file; on one machine, with the same versions, the same input gives the same bytes.

    Elsewhere numbers may differ in their last bits, for numpy takes other code paths on other processors.

    Sheets: Front, Inputs, Input tables where there are lists or tables among them, Find where there are found values,
    one for each table named by its number and title, Checks, Index where the ``index`` has numbers of printed formulas
    or errata.
    With a ``recording`` of the worksheet the cells hold formulas beside their values, and its lines, with the steps
    that need a cell, are listed by sections on sheets of their own at the end, in SI units, which are not printed; of
    the ``fixed`` checks a scene has set the limit, and those of a proof have the digits ``proved``, by their names.
    ``done`` is called with how many of how many parts of the work are behind.
    A table's sheet has its title in row 1, its note in row 2, symbols in row 3, units in row 4, then the numbers
    to their last bit; pandas reads it by ``read_excel(file, sheet_name=name, header=2, skiprows=[3])``. NaN is
    the error value #N/A and an infinite number #NUM!: pandas reads both as NaN, charts leave a gap.

    A figure is a chart on the first table's sheet that holds all its columns, else on a sheet of its own
    data; the lines of its marks are drawn from the sheet Marks.
    """
    book = Book(title)
    if recording and recording.every > 1:
        figures = [_listed_points(figure, recording.every) for figure in figures]
    holders = [_holder(figure, tables) for figure in figures]
    alone = [figure for figure, holder in zip(figures, holders, strict=True) if holder is None]
    data = [Table(f"Fig {f.number}", f"Data of {caption('figure', f)}", (f.x, *f.lines)) for f in alone]
    names = [book.name(_tab(table, recording)) for table in tables]
    names_of_data = [book.name(f"{table.number} data") for table in data]
    formulas = None
    if recording:
        formulas = _formulas(book, recording, [*tables, *data], [*names, *names_of_data], inputs, found)
    charts = Charts(book, formulas)
    front = front_sheet.add(book)
    inputs_sheet.write(book, inputs, formulas)
    if found:
        find_sheet.write(book, found, formulas)
    greys = [formulas.exported(table) if formulas else () for table in tables]
    sections = formulas.arrangement.sections if formulas else ()
    put, all_parts = count(1), _PACKED * (len(tables) + len(alone) + len(sections))
    for table, name, grey in zip(tables, names, greys, strict=True):
        held = [figure for figure, holder in zip(figures, holders, strict=True) if holder is table]
        columns = table_sheet.contents(table, formulas)
        of_columns = table_sheet.not_followed(table.columns, grey)
        words = formulas.words if formulas else lambda _, text, __: text
        heading = words(f"table {table.number} title", caption("Table", table), f"Table {table.number}")
        note = words(f"table {table.number} note", f"{table.note} {of_columns}".strip(), of_columns)
        sheet, spots = table_sheet.write(book, name, heading, note, columns, len(held), grey=grey)
        for figure, spot in zip(held, spots, strict=True):
            charts.insert(sheet, spot, figure, name, table.columns, grey)
        done(next(put), all_parts)
    for figure, table, name in zip(alone, data, names_of_data, strict=True):
        columns = table_sheet.contents(table, formulas)
        grey = formulas.exported(table) if formulas else ()
        note = table_sheet.not_followed(table.columns, grey)
        of = f"Data of figure {figure.number}"
        heading = formulas.words(f"figure {figure.number} title", table.title, of) if formulas else table.title
        sheet, (spot,) = table_sheet.write(book, name, heading, note, columns, 1, grey=grey)
        charts.insert(sheet, spot, figure, name, table.columns, grey)
        done(next(put), all_parts)
    checks_sheet.write(book, checks, formulas, fixed, proved)
    if index and (index.formulas or index.errata):
        sheets = {("table", table.number): name for table, name in zip(tables, names, strict=True)}
        holding = dict(zip(map(id, tables), names, strict=True))
        sheets |= {("figure", f.number): holding[id(t)] for f, t in zip(figures, holders, strict=True) if t is not None}
        sheets |= {("figure", f.number): name for f, name in zip(alone, names_of_data, strict=True)}
        index_sheet.write(book, index, sheets, formulas)
    if formulas:
        for section in sections:
            section_sheets.write(book, section, formulas)
            done(next(put), all_parts)
    charts.marks()
    listed = charts.drawn or [_listed(*each) for each in zip(tables, names, greys, strict=True)]
    results = front_sheet.results(found, listed, formulas)
    front_sheet.write(book, front, checks, found, results, recording)
    return book.close()


def _tab(table: Table, recording: Recording | None) -> str:
    """What a table's sheet is called, whose name cannot follow a title that inputs change."""
    key = f"table {table.number} title"
    said = recording.worded.get(key) if recording and key not in recording.said else None
    follows = recording and (key in recording.said or (said is not None and said.op != "constant"))
    return f"Table {table.number}" if follows else f"{table.number} {table.title}"


def _listed(table: Table, sheet: str, grey: Sequence[int]) -> Listed:
    """The columns of a table that measure something."""
    at = {id(column): Place("", sheet, looks.FIRST, n) for n, column in enumerate(table.columns)}
    measuring = [column for column in table.columns if column.unit not in ("", "-") and len(column.values)]
    return Listed(measuring, f"table {table.number}", lambda column: at[id(column)], grey)


def comparison(
    title: str, names: Sequence[str], rows: Sequence[Sequence[str | float]], tables: Sequence[Table]
) -> bytes:
    """Bytes of an .xlsx file with scenes side by side on the sheet Scenes, then a sheet for each table.

    A row is a symbol, its unit, its meaning and a number, verdict or text for each of the ``names``; a row of
    one text heads a section. A table's sheet is named by its title.
    """
    book = Book(title)
    texts = [(head, looks.TEXT) for head in ("Symbol", "Unit", "Meaning")]
    fields = [*texts, *((name, {**looks.NUMBER, "text_wrap": True}) for name in names)]
    sheet = book.listing("Scenes", f"{book.title} - scenes side by side", fields, rows)
    _give_room(sheet, rows, 3)
    checks_sheet.verdicts(book, sheet, len(rows), 3, 2 + len(names))
    for table in tables:
        table_sheet.write(book, book.name(table.title), table.title, table.note, table_sheet.contents(table, None))
    return book.close()


def _give_room(sheet: Any, rows: Sequence[Sequence[str | float]], first: int) -> None:
    """Width for a number with all its digits in the columns from the ``first`` one on, and for longer texts lines."""
    lengths = [[len(x) if isinstance(x, str) else 0 for x in row[first:]] for row in rows]
    columns = zip(*(each for each in lengths if each), strict=True)
    widths = [max(_DIGITS, min(_TEXT, max(column) // 3)) for column in columns]
    for at, width in enumerate(widths, first):
        sheet.set_column_pixels(at, at, looks.CHAR * width + looks.PAD)
    for n, each in enumerate(lengths, 2):
        lines = max((math.ceil(length / (w - 2)) for length, w in zip(each, widths, strict=False)), default=1)
        if lines > 1:
            sheet.set_row_pixels(n, looks.ROW + (lines - 1) * (looks.ROW - 5))


def _formulas(
    book: Book,
    recording: Recording,
    tables: Sequence[Table],
    sheets: Sequence[str],
    inputs: Sequence[Item],
    found: Sequence[FoundRow],
) -> SheetFormulas:
    """Formulas of a recording, the names in them defined."""
    places, changed = inputs_sheet.places(inputs), inputs_sheet.changed(inputs)
    solved = {row.symbol: n for n, row in enumerate(found, 2)}
    arrangement = Arrangement(recording, tables, sheets, places, changed, solved, looks.FIRST, book.name)
    for name, meaning in arrangement.defined:
        book.file.define_name(name, meaning)
    return SheetFormulas(arrangement)


def _holder(figure: Figure, tables: Sequence[Table]) -> Table | None:
    """The first table that has every column of the figure."""
    wanted = (figure.x, *figure.lines)
    held = (t for t in tables if all(any(same_column(column, other) for other in t.columns) for column in wanted))
    return next(held, None)


def _listed_points(figure: Figure, every: int) -> Figure:
    """The figure over the positions that the tables list, whose cells are live."""

    def thinned(column: Column) -> Column:
        return replace(column, values=column.values[::every])

    return replace(figure, x=thinned(figure.x), lines=tuple(map(thinned, figure.lines)))
