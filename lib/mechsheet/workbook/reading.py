"""An exported workbook read back: the sheet of its inputs, edited in Excel or LibreOffice, is a scene."""

import math
import re
import warnings
from collections.abc import Collection, Container, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from itertools import chain, islice
from pathlib import Path
from typing import Any
from zipfile import ZipFile

from openpyxl import load_workbook  # type: ignore[import-untyped]
from openpyxl.utils import get_column_letter  # type: ignore[import-untyped]

from mechsheet.units import shown
from mechsheet.worksheet.data_file import in_per_cent
from mechsheet.worksheet.errors import SheetError, cut, nearest
from mechsheet.worksheet.kinds import Choice, Input
from mechsheet.worksheet.lists import Rows
from mechsheet.worksheet.numbers import significant

_SHEET = "Inputs"
_TABLES = "Input tables"
_HEADS = ("Symbol", "Value", "Unit")
_COLUMNS = {_SHEET: 100, _TABLES: 400}  # among which the headings are looked for: a sheet may have 16384
_WHOLE = ("xl/workbook.xml", "xl/sharedStrings.xml", "xl/styles.xml")  # parts of the file that are read as a whole
_LARGEST = 10_000_000  # bytes of each, unpacked
_RANGE = r"(?<![!\w$])\$?([A-Z]+)\$?(\d+):\$?([A-Z]+)\$?(\d+)"  # of cells of the same sheet
_EMPTY = 10_000  # empty rows, one after the other, that are passed over: a sheet may have a million

_Row = tuple[int, tuple[Any, ...]]  # number of a row and the values of its cells


class _PerCent(float):
    """A number that its cell shows in per cent: 0.85 as 85%."""


def inputs(path: Path, declared: Sequence[Input]) -> dict[str, object]:
    """Inputs by name, in display units, of the sheets Inputs and Input tables.

    A row or a table that was taken out keeps the worksheet's value. Columns are found by their headings; a value may be
    a number, a text such as ``0,415``, or a formula that the spreadsheet program has computed. Rows of Inputs are read
    up to the first empty one behind the last input, those of a table as far as it has some.

    Raises SheetError naming the file, the cell and what it holds where that cannot be used, and the list or table that
    Inputs has a row for and that is not there.
    """
    tables = [field for field in declared if isinstance(field, Rows)]
    fields = {field.name: field for field in declared if not isinstance(field, Rows)}
    with _book(path, values=True) as book:
        told = dict.fromkeys((table.name for table in tables), False)
        found = _listed(path, _rows(path, book, _SHEET), fields, told, _properties(declared))
        if tables and _TABLES in book.sheetnames:
            found |= _of_tables(path, _rows(path, book, _TABLES), tables)
        missing = next((name for name, is_told in told.items() if is_told and name not in found), None)
        if missing is not None:
            at, named = (
                (f", sheet {_TABLES}", f"column {missing}") if _TABLES in book.sheetnames else ("", f"sheet {_TABLES}")
            )
            remedy = f"give it its name back, or delete the row of {missing} on the sheet {_SHEET}"
            raise SheetError(f"workbook {path}{at} has no {named}: {remedy} to keep what the worksheet has")
    return found


def _properties(declared: Sequence[Input]) -> dict[str, tuple[Input, Any]]:
    """Properties of options by their names on the sheet Inputs, with what the worksheet has for each, in its unit."""
    choices = (field for field in declared if isinstance(field, Choice))
    columns = ((field, *column) for field in choices for column in field.columns())
    named = (
        (replace(each, name=f"{field.name}.{each.name} ({option})"), own)
        for field, each, values in columns
        for option, own in zip(field.options, values, strict=True)
    )
    return {each.name: (each, each.display(own)) for each, own in named}


def _listed(
    path: Path,
    rows: Iterator[_Row],
    fields: Mapping[str, Input],
    tables: dict[str, bool],
    properties: Mapping[str, tuple[Input, Any]],
) -> dict[str, object]:
    """Inputs of the sheet Inputs, one a row; the ``properties`` of options must be those of the worksheet.

    Which of the ``tables`` have a row there is put down.
    """
    found, places = dict[str, object](), dict[str, str]()
    columns = _columns(path, rows)
    for number, row in rows:
        symbol, value, unit = (row[column] for column in columns)
        at = [f"{get_column_letter(column + 1)}{number}" for column in columns]
        name = _text(symbol)
        if value is None and name in tables:
            tables[name] = True
        if value is None and (not name or (name not in fields and not _text(unit))):
            if len(found) == len(fields) and not name:
                break
            continue  # an empty row, the heading of a section, or the line of a table
        cell, unit_cell = (_Cell(path, _SHEET, number, column) for column in columns[1:])
        if name in properties:
            each, own = properties[name]
            given = each.read(_read(each, value, _text(unit), cell, unit_cell))
            if not (given == own if each.is_text else math.isclose(given, own, rel_tol=1e-14)):
                raise SheetError(
                    f"{cell}: {each.says(given)}, which the worksheet has as {own}: properties of options are changed "
                    "there; a row that is taken out keeps them"
                )
            continue
        if name in tables:
            raise SheetError(f"{_at(path, at[1])}: the rows of {name} stand on the sheet {_TABLES}")
        if name not in fields:
            near = nearest(name, fields, 3, cutoff=0.5)
            hint = f"; nearest: {', '.join(near)}" if near else ""
            raise SheetError(f"{_at(path, at[0])}: {cut(name) or 'an empty cell'} is no input{hint}")
        if name in places:
            raise SheetError(f"{_at(path, at[0])}: {name} stands in {places[name]} already")
        places[name] = at[0]
        found[name] = _read(fields[name], value, _text(unit), cell, unit_cell)
    return found


def _of_tables(path: Path, rows: Iterator[_Row], tables: Sequence[Rows]) -> dict[str, object]:
    """Lists and tables of the sheet Input tables, the numbers of each column under its name and its unit."""
    known = {column.name: column for field in tables for column in field.columns}
    top, at, units, rows = _heads(path, rows, known)
    elements: dict[str, list[object]] = {name: [] for name in at}
    formulas = _formulas(path, at.values())
    below = set[str]()  # lists of which an empty row has been passed over
    for number, row in rows:
        for field in tables:
            names = [column.name for column in field.columns if column.name in at]
            if all(row[at[name]] is None and (number, at[name]) not in formulas for name in names):
                below |= {name for name in names if name == field.name and elements[name]}
                continue
            cells = {name: _Cell(path, _TABLES, number, at[name]) for name in names}
            for cell in cells.values():
                formula = formulas.get((number, cell.column), "")
                if field.name in below and "(" in formula:  # such as the sum of the list
                    remedy = f"fill the rows of {field.name} above"
                    raise SheetError(f"{cell}: {cut(formula)} stands below an empty row: take it out, or {remedy}")
                if cell.is_of_those_above(formula):
                    raise SheetError(f"{cell}: {cut(formula)} is of the rows above: take it out, or give its number")
            for name, cell in cells.items():
                column = replace(known[name], name=f"{name} ({len(elements[name]) + 1})")
                unit = _Cell(path, _TABLES, top + 1, cell.column)
                elements[name].append(_read(column, row[cell.column], _text(units[cell.column]), cell, unit))
            below.discard(field.name)
    found = dict[str, object]()
    for field in tables:
        lists = {column.name: elements[column.name] for column in field.columns if column.name in elements}
        if lists:
            try:
                field.read(lists)
            except SheetError as error:
                raise SheetError(f"workbook {path}, sheet {_TABLES}: {error}") from None
            found[field.name] = lists
    return found


def _formulas(path: Path, columns: Collection[int]) -> dict[tuple[int, int], str]:
    """Formulas in some columns of the sheet Input tables, by row and column: not every one has a value."""
    with _book(path, values=False) as book:
        cells = ((number, column, row[column]) for number, row in _rows(path, book, _TABLES) for column in columns)
        return {(number, column): x for number, column, x in cells if isinstance(x, str) and x.startswith("=")}


def _heads(
    path: Path, rows: Iterator[_Row], known: Container[str]
) -> tuple[int, dict[str, int], tuple[Any, ...], Iterator[_Row]]:
    """The row that has names of columns, where each stands, the units under them, and the rows behind these."""
    for row in rows:
        if not _named(row, known):
            continue
        units, below = next(rows, (0, ())), next(rows, (0, ()))
        if _named(row, known).keys() <= _named(below, known).keys():  # a list was meant as it is called
            row, units, below = below, next(rows, (0, ())), next(rows, (0, ()))
        at = _named(row, known)
        texts = [_text(value) for value in row[1]]
        twice = next((column for column, text in enumerate(texts) if text in known and at[text] != column), None)
        if twice is not None:
            place, first = (_Cell(path, _TABLES, row[0], column) for column in (twice, at[texts[twice]]))
            raise SheetError(f"{place}: {texts[twice]} stands in {first.coordinate} already")
        return row[0], at, units[1], chain([below] if below[1] else [], rows)
    return 0, {}, (), rows


def _named(row: _Row, known: Container[str]) -> dict[str, int]:
    """The first column of each known name in a row."""
    texts = [_text(value) for value in row[1]]
    return {text: column for column, text in reversed([*enumerate(texts)]) if text in known}


@dataclass(frozen=True)
class _Cell:
    """A cell, the row counted from 1 and the column from 0."""

    path: Path
    sheet: str
    row: int
    column: int

    @property
    def coordinate(self) -> str:
        return f"{get_column_letter(self.column + 1)}{self.row}"

    def __str__(self) -> str:
        return _at(self.path, self.coordinate, self.sheet)

    def is_of_those_above(self, formula: str) -> bool:
        """Whether a formula of it takes several cells of its column above it, as a total does."""
        column = get_column_letter(self.column + 1)
        ranges = re.findall(_RANGE, formula)
        return any(a == b == column and first != last and int(last) < self.row for a, first, b, last in ranges)

    def formula(self) -> str:
        """The formula that it holds."""
        with _book(self.path, values=False) as book:
            rows = _rows(self.path, book, self.sheet)
            return next((str(cells[self.column] or "") for _, cells in islice(rows, self.row - 1, self.row)), "")


def _read(field: Input, value: object, unit: str, cell: _Cell, unit_cell: _Cell) -> object:
    """The value of an input as it stands in its cell, with the other unit that somebody has typed beside it."""
    if value is None and field.is_text and not cell.formula():
        return ""
    if value is None:
        formula = cell.formula()
        holds = f"the formula {cut(formula)} has no value; open and save the file in the spreadsheet program"
        raise SheetError(f"{cell}: {field.name}: {holds if formula else 'the value is missing'}")
    if isinstance(value, _PerCent) and field.unit != "-" and not field.is_text:
        x = significant(100 * value, 15)
        raise SheetError(
            f"{cell}: {field.says(significant(value, 15))} is shown as {x} %: type {x}, for its unit stands beside it"
        )
    try:
        field.read(value)
    except SheetError as error:
        raise SheetError(f"{cell}: {error}") from None
    if (unit or "-") in (field.unit, shown(field.unit)):
        return value
    wrong = f"{unit_cell}: {cut(unit) or 'an empty cell'} is not the unit of {field.name}, which is {shown(field.unit)}"
    if not unit:
        raise SheetError(wrong)
    text = f"{value} {unit}"
    try:
        field.read(text)
    except SheetError as error:
        raise SheetError(f"{wrong}: {error}") from None
    return text


def _columns(path: Path, rows: Iterator[_Row]) -> list[int]:
    """Columns of the headings, in the first row that has them all."""
    for _, row in rows:
        texts = [_text(value) for value in row]
        if set(_HEADS) <= set(texts):
            return [texts.index(head) for head in _HEADS]
    raise SheetError(f"workbook {path}, sheet {_SHEET}: no row has the headings {', '.join(_HEADS)}")


@contextmanager
def _book(path: Path, values: bool) -> Iterator[Any]:
    """The workbook, read as it is asked for, with the values of its formulas or the formulas."""
    try:
        with path.open("rb") as file, warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of parts of the file that openpyxl does not keep; nothing is written back
            for part in ZipFile(file).infolist():
                if part.filename in _WHOLE and part.file_size > _LARGEST:
                    size = f"over {_LARGEST // 10**6} MB"
                    raise SheetError(f"workbook {path}: its {part.filename} has {size}: delete sheets of your own")
            book = load_workbook(file, read_only=True, data_only=values)
            if _SHEET not in book.sheetnames:
                raise SheetError(f"workbook {path} has no sheet {_SHEET}; it has {cut(', '.join(book.sheetnames))}")
            yield book
    except SheetError:
        raise
    except OSError as error:
        raise SheetError(f"workbook {path} cannot be read: {error.strerror or error}") from None
    except Exception as error:  # of a file that is damaged, in as many ways as it can be
        words = " ".join(str(error).split()) or type(error).__name__
        raise SheetError(f"workbook {path} is no Excel workbook, or damaged: {cut(words)}") from None


def _rows(path: Path, book: Any, name: str) -> Iterator[_Row]:
    """Rows of a sheet that hold something, and the empty ones between them."""
    sheet, last = book[name], 0
    sheet.reset_dimensions()  # a file may tell others than it has
    for number, cells in enumerate(sheet.iter_rows(max_col=_COLUMNS[name]), 1):
        row = tuple(map(_held, cells))
        if any(value is not None for value in row):
            last = number
        elif number - last > _EMPTY:
            raise SheetError(
                f"workbook {path}, sheet {name}: over {_EMPTY} empty rows from row {last + 1}; delete them"
            )
        yield number, row


def _held(cell: Any) -> Any:
    """The value of a cell; a number that is shown in per cent is marked."""
    value, form = cell.value, cell.number_format
    return _PerCent(value) if in_per_cent(value, form) else value


def _text(value: object) -> str:
    return "" if value is None else str(value).strip()


def _at(path: Path, coordinate: str, sheet: str = _SHEET) -> str:
    on = "" if sheet == _SHEET else f"sheet {sheet}, "
    return f"workbook {path}, {on}cell {coordinate}"
