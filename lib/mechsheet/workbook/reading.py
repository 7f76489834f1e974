"""An exported workbook read back: the sheet of its inputs, edited in Excel or LibreOffice, is a scene."""

import difflib
import warnings
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from itertools import islice
from pathlib import Path
from typing import Any

from openpyxl import load_workbook  # type: ignore[import-untyped]
from openpyxl.utils import get_column_letter  # type: ignore[import-untyped]

from mechsheet.units import shown
from mechsheet.worksheet.errors import SheetError, cut
from mechsheet.worksheet.kinds import Choice, Input
from mechsheet.worksheet.lists import Rows

_SHEET = "Inputs"
_HEADS = ("Symbol", "Value", "Unit")
_NAME = 60  # characters by which the nearest input is looked for
_COLUMNS = 100  # among which the headings are looked for: a sheet may have 16384
_EMPTY = 10_000  # empty rows, one after the other, that are passed over: a sheet may have a million

_Row = tuple[int, tuple[Any, ...]]  # number of a row and the values of its cells


def inputs(path: Path, declared: Sequence[Input]) -> dict[str, object]:
    """Inputs by name, in display units, of the sheet Inputs; a row that was taken out keeps the worksheet's value.

    The columns Symbol, Value and Unit are found by their headings; a value may be a number, a text such as
    ``0,415``, or a formula that the spreadsheet program has computed. Rows are read up to the first empty one behind
    the last input.

    Raises SheetError naming the file, the cell and what it holds where that cannot be used.
    """
    fields, found = {field.name: field for field in declared if not isinstance(field, Rows)}, dict[str, object]()
    columns_of = {column.name: column for f in declared if isinstance(f, Rows) for column in f.columns}
    named, several = set(fields), dict[str, dict[str, object]]()
    places = dict[str, str]()
    properties = {f"{f.name}.{p.name}" for f in declared if isinstance(f, Choice) for p in f.properties}
    with _rows(path, values=True) as rows:
        columns = _columns(path, rows)
        for number, row in rows:
            symbol, value, unit = (row[column] for column in columns)
            at = [f"{get_column_letter(column + 1)}{number}" for column in columns]
            name = _text(symbol)
            if value is None and (not name or (name not in fields and not _text(unit))):
                if len(found) == len(fields) and not name and not columns_of:  # rows may be added to a list
                    break
                continue  # an empty row, or the heading of a section
            if name.rpartition(" (")[0] in properties:
                continue
            if field := columns_of.get(name.rpartition(" (")[0]):
                fields.setdefault(name, field)
            if name not in fields:
                near = difflib.get_close_matches(name[:_NAME], fields, n=3, cutoff=0.5)
                hint = f"; nearest: {', '.join(near)}" if near else ""
                raise SheetError(f"{_at(path, at[0])}: {cut(name) or 'an empty cell'} is no input{hint}")
            if name in places:
                raise SheetError(f"{_at(path, at[0])}: {name} stands in {places[name]} already")
            places[name] = at[0]
            number_of = found if name in named else several.setdefault(fields[name].name, dict[str, object]())
            number_of[name] = _checked(path, fields[name], value, number, columns[1])
            if (_text(unit) or "-") not in (fields[name].unit, shown(fields[name].unit)):
                number_of[name] = _converted(fields[name], value, _text(unit), _at(path, at[2]))
    for field in (f for f in declared if isinstance(f, Rows)):
        lists = {column.name: list(several[column.name].values()) for column in field.columns if column.name in several}
        if lists:
            found[field.name] = lists
            try:
                field.read(lists)
            except SheetError as error:
                raise SheetError(f"workbook {path}, sheet {_SHEET}: {error}") from None
    return found


def _checked(path: Path, field: Input, value: object, row: int, column: int) -> object:
    """The value of an input as it stands in its cell."""
    place = _at(path, f"{get_column_letter(column + 1)}{row}")
    if value is None:
        formula = _formula(path, row, column)
        holds = f"the formula {cut(formula)} has no value; open and save the file in the spreadsheet program"
        raise SheetError(f"{place}: {field.name}: {holds if formula else 'the value is missing'}")
    try:
        field.read(value)
    except SheetError as error:
        raise SheetError(f"{place}: {error}") from None
    return value


def _converted(field: Input, value: object, unit: str, place: str) -> str:
    """The value of an input with the other unit that somebody has typed beside it."""
    wrong = f"{place}: {cut(unit) or 'an empty cell'} is not the unit of {field.name}, which is {shown(field.unit)}"
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
def _rows(path: Path, values: bool) -> Iterator[Iterator[_Row]]:
    """Rows of the sheet of inputs, read as they are asked for, with the values of its formulas or the formulas."""
    try:
        with path.open("rb") as file, warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of parts of the file that openpyxl does not keep; nothing is written back
            book = load_workbook(file, read_only=True, data_only=values)
            if _SHEET not in book.sheetnames:
                raise SheetError(f"workbook {path} has no sheet {_SHEET}; it has {cut(', '.join(book.sheetnames))}")
            sheet = book[_SHEET]
            sheet.reset_dimensions()  # a file may tell others than it has
            yield _to_the_end(path, sheet.iter_rows(max_col=_COLUMNS, values_only=True))
    except SheetError:
        raise
    except OSError as error:
        raise SheetError(f"workbook {path} cannot be read: {error.strerror or error}") from None
    except Exception as error:  # of a file that is damaged, in as many ways as it can be
        words = " ".join(str(error).split()) or type(error).__name__
        raise SheetError(f"workbook {path} is no Excel workbook, or damaged: {cut(words)}") from None


def _to_the_end(path: Path, rows: Iterator[tuple[Any, ...]]) -> Iterator[_Row]:
    last = 0
    for number, row in enumerate(rows, 1):
        if any(value is not None for value in row):
            last = number
        elif number - last > _EMPTY:
            raise SheetError(
                f"workbook {path}, sheet {_SHEET}: over {_EMPTY} empty rows from row {last + 1}; delete them"
            )
        yield number, row


def _formula(path: Path, row: int, column: int) -> str:
    with _rows(path, values=False) as rows:
        return next((str(cells[column] or "") for _, cells in islice(rows, row - 1, row)), "")


def _text(value: object) -> str:
    return "" if value is None else str(value).strip()


def _at(path: Path, coordinate: str) -> str:
    return f"workbook {path}, cell {coordinate}"
