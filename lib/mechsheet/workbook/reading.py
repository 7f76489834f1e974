"""An exported workbook read back: the sheet of its inputs, edited in Excel or LibreOffice, is a scene."""

import difflib
import warnings
from collections.abc import Sequence
from pathlib import Path
from typing import Any
from zipfile import BadZipFile

from openpyxl import load_workbook  # type: ignore[import-untyped]

from mechsheet.units import shown
from mechsheet.worksheet.errors import SheetError
from mechsheet.worksheet.inputs import Input, number

_SHEET = "Inputs"
_HEADS = ("Symbol", "Value", "Unit")


def inputs(path: Path, declared: Sequence[Input]) -> dict[str, object]:
    """Inputs by name, in display units, of the sheet Inputs; a row that was taken out keeps the worksheet's value.

    The columns Symbol, Value and Unit are found by their headings; a value may be a number, a text such as
    ``0,415``, or a formula that the spreadsheet program has computed.

    Raises SheetError naming the file, the cell and what it holds where that cannot be used.
    """
    fields, found = {field.name: field for field in declared}, dict[str, object]()
    header, *rows = _rows(path)
    places = dict[str, str]()
    for row in rows:
        symbol, value, unit = (row[header.index(head)] for head in _HEADS)
        name = _text(symbol)
        if value.value is None and (not name or (name not in fields and not _text(unit))):
            continue  # an empty row, or the heading of a section
        if name not in fields:
            near = difflib.get_close_matches(name, fields, n=3, cutoff=0.5)
            hint = f"; nearest: {', '.join(near)}" if near else ""
            raise SheetError(f"{_at(path, symbol)}: {name or 'an empty cell'} is no input{hint}")
        if name in places:
            raise SheetError(f"{_at(path, symbol)}: {name} stands in {places[name]} already")
        places[name] = symbol.coordinate
        found[name] = _number(path, fields[name], value)
        if (_text(unit) or "-") not in (fields[name].unit, shown(fields[name].unit)):
            wrong = _text(unit) or "an empty cell"
            raise SheetError(f"{_at(path, unit)}: {wrong} is not the unit of {name}, which is {fields[name].unit}")
    return found


def _number(path: Path, field: Input, cell: Any) -> float:
    if cell.value is None:
        formula = _formula(path, cell.coordinate)
        holds = f"the formula {formula} has no value; open and save the file in the spreadsheet program"
        raise SheetError(f"{_at(path, cell)}: {field.name}: {holds if formula else 'the value is missing'}")
    try:
        return number(cell.value)
    except ValueError:
        raise SheetError(f"{_at(path, cell)}: {field.name} = {cell.value} is no number") from None


def _rows(path: Path) -> list[list[Any]]:
    """The row of headings as texts, then the rows below as cells, with the values that formulas have given."""
    cells = [list(row) for row in _open(path, values=True).iter_rows()]
    for i, row in enumerate(cells):
        texts = [_text(cell) for cell in row]
        if set(_HEADS) <= set(texts):
            return [texts, *cells[i + 1 :]]
    raise SheetError(f"workbook {path}, sheet {_SHEET}: no row has the headings {', '.join(_HEADS)}")


def _open(path: Path, values: bool) -> Any:
    """The sheet of inputs, its formulas as values or as formulas."""
    try:
        with path.open("rb") as file, warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of parts of the file that openpyxl does not keep; nothing is written back
            book = load_workbook(file, data_only=values)
    except OSError as error:
        raise SheetError(f"workbook {path} cannot be read: {error.strerror}") from None
    except (BadZipFile, KeyError, ValueError) as error:
        raise SheetError(f"workbook {path} is no Excel workbook: {error}") from None
    if _SHEET not in book.sheetnames:
        raise SheetError(f"workbook {path} has no sheet {_SHEET}; it has {', '.join(book.sheetnames)}")
    return book[_SHEET]


def _formula(path: Path, coordinate: str) -> str:
    return str(_open(path, values=False)[coordinate].value or "")


def _text(cell: Any) -> str:
    return "" if cell.value is None else str(cell.value).strip()


def _at(path: Path, cell: Any) -> str:
    return f"workbook {path}, cell {cell.coordinate}"
