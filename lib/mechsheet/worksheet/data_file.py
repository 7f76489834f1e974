"""Columns of numbers in a file beside a worksheet: CSV as spreadsheet programs write it, or a workbook's first sheet.

The first row has the names of the columns, each with its unit behind it: ``phi [deg]; p [MPa]``. CSV is apart by
``;``, tabs or commas, whichever the first row has; lines that begin with # and empty ones are passed over. A number of
which it cannot be told whether its sign stands before decimals or between thousands is refused.
"""

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

from mechsheet.units import conversion
from mechsheet.worksheet import numbers
from mechsheet.worksheet.errors import SheetError, cut
from mechsheet.worksheet.kinds import number

ENDINGS = (".csv", ".tsv", ".txt", ".xlsx")
OTHER_SPREADSHEETS = (".ods", ".xls", ".xlsm", ".xlsb", ".numbers")  # of which none is read
MISSING = frozenset(["", "nan", "na", "n/a", "#n/a", "none", "null", "-"])  # as programs write what was not measured
HEAD = r"\s*(\w+)\s*(?:\[([^\]]*)\])?\s*"
_NAME = re.compile(rf"""["']([^"'\n]+(?:{"|".join(map(re.escape, ENDINGS))}))["']""", re.IGNORECASE)
_EMPTY = ' \t;,"'  # all that a row of empty cells has, as spreadsheet programs write those below the last number
_APART = re.compile(r"sep=.?", re.IGNORECASE)  # a first line that tells Excel the sign between cells
_ERROR = re.compile(r"#(?:N/A|NV|Н/Д|\S+[!?])")  # as spreadsheet programs write it: no remark
_SIGNED = re.compile(r"\W?(\d+)([.,])(\d+)(?![\d.,])")
_MOST = 100_000  # rows that are looked at


@dataclass(frozen=True)
class DataFile:
    """A file whose columns are the first value of an input; its name is that of a file beside the worksheet."""

    name: str


def from_file(name: str) -> Any:
    """The numbers of a file beside the worksheet as the value of a list or a table of its inputs.

    ``gas: list[Gas] = from_file("gas.csv")  # pressure over the stroke`` takes the columns that the class ``Gas``
    declares, by their names; a scene or an argument may name another file.
    """
    return DataFile(name)


def named(text: str, folder: Path) -> Iterator[Path]:
    """Files of numbers that the text of a worksheet names, in the current folder and beside it."""
    for name in dict.fromkeys(_NAME.findall(text)):
        yield from (Path(name), folder / name)


def state(path: Path) -> object:
    """What is another one once a file has changed, is there or is gone."""
    try:
        found = path.stat()
    except OSError:
        return None
    return found.st_mtime_ns, found.st_size


class Columns(NamedTuple):
    """Cells by column, as they are given, each with its unit behind it, and where the rows stand in the file."""

    path: Path
    cells: dict[str, list[Any]]
    rows: tuple[int, ...]


def columns(path: Path, wanted: Mapping[str, str | None]) -> Columns:
    """The wanted columns of a file, each of numbers with its unit, of texts with none; others are passed over.

    Raises SheetError naming the file, and the row and column of what cannot be used.
    """
    if path.suffix.lower() in OTHER_SPREADSHEETS:
        raise SheetError(f"file {path} cannot be read: save it as .csv or .xlsx")
    rows, apart = (_book(path), "") if path.suffix.lower() == ".xlsx" else _text(path)
    if not rows:
        raise SheetError(f"file {path} is empty")
    (first, heads), *body = rows
    units, at = dict[str, str](), dict[str, int]()
    for n, head in enumerate(heads):
        match = re.fullmatch(HEAD, str(head))
        if match and match[1] in at:
            raise SheetError(f"file {path}, row {first}: column {match[1]} stands there twice")
        if match:
            at[match[1]], units[match[1]] = n, match[2] or ""
    for name in wanted:
        if name not in at:
            has = cut(", ".join(at)) or f"no names such as {name} [unit], but {cut(', '.join(map(str, heads)))}"
            raise SheetError(f"file {path}, row {first}: no column {name}; it has {has}")
    for n, cells in body:
        if len(cells) > len(heads) and any(str(cell).strip() for cell in cells[len(heads) :]):
            raise SheetError(f"file {path}, row {n}: {len(cells)} values under {len(heads)} names of columns")
    given = {name: [cells[at[name]] if at[name] < len(cells) else "" for _, cells in body] for name in wanted}
    numbers_of = {name: cells for name, cells in given.items() if wanted[name] is not None}
    _of_one_sign(path, numbers_of, [n for n, _ in body], apart)
    for name, cells in numbers_of.items():
        try:
            pure = units[name] == "-" != wanted[name] and conversion("-", wanted[name] or "-")
        except ValueError as error:
            raise SheetError(f"file {path}, row {first}, column {name}: {error}") from None
        given[name] = [_scaled(cell, pure) if pure else _with_unit(cell, units[name]) for cell in cells]
    return Columns(path, given, tuple(n for n, _ in body))


def _of_one_sign(path: Path, given: Mapping[str, list[Any]], rows: list[int], apart: str) -> None:
    """Refuse 12.500 in a file of decimal commas, and "1,234" among numbers apart by commas: it may be thousands."""
    decimal, unsure = set[str](), dict[str, tuple[int, str, str]]()
    for name, cells in given.items():
        for row, cell in zip(rows, cells, strict=True):
            if not isinstance(cell, str) or not (match := _SIGNED.match(cell.strip())):
                continue
            if len(match[3]) == 3 and len(match[1]) <= 3 and match[1][0] != "0":
                unsure.setdefault(match[2], (row, name, cell.strip()))
            else:
                decimal.add(match[2])
    for sign, (row, name, cell) in unsure.items():
        if sign not in decimal and (decimal or len(unsure) > 1 or sign == apart):
            readings = f"{cell.replace(sign, '')} or {cell.replace(sign, '.')}"
            remedy = "write it without a sign between thousands"
            raise SheetError(f"file {path}, row {row}, column {name}: {cell} may be {readings}: {remedy}")


def _with_unit(cell: Any, unit: str) -> Any:
    own = re.search(r"[^\W\d_]|[%°]", re.sub(r"[eE][+-]?\d", "", str(cell)))
    return f"{cell} {unit}" if unit not in ("", "-") and not own and str(cell).strip() else cell


def _scaled(cell: Any, ratio: float) -> Any:
    """A number without a unit in that of its column, as 0.85 in per cent; what is no such number as it is."""
    try:
        return float(numbers.significant(number(cell) * ratio, 15))
    except ValueError:
        return cell


def _text(path: Path) -> tuple[list[tuple[int, list[Any]]], str]:
    import csv  # on use: most worksheets read no file

    try:
        text = path.read_text(encoding="utf-8-sig")
    except OSError as error:
        raise SheetError(f"file {path} cannot be read: {error.strerror or error}") from None
    except UnicodeDecodeError:
        raise SheetError(f"file {path} is no text in UTF-8") from None
    numbered = enumerate(text.splitlines(), 1)
    lines = [
        (n, line)
        for n, line in numbered
        if line.strip(_EMPTY) and (not line.startswith("#") or _ERROR.match(line)) and not _APART.fullmatch(line)
    ]
    apart = next((mark for mark in ";\t" if lines and mark in lines[0][1]), ",")
    return [(n, next(csv.reader([line], delimiter=apart))) for n, line in lines[:_MOST]], apart


def _book(path: Path) -> list[tuple[int, list[Any]]]:
    from openpyxl import load_workbook  # type: ignore[import-untyped]  # on use: takes a third of a second

    try:
        with path.open("rb") as file:
            book = load_workbook(file, read_only=True, data_only=True)
            sheet = book.worksheets[0]
            sheet.reset_dimensions()
            rows = enumerate(sheet.iter_rows(max_row=_MOST, max_col=100), 1)
            kept = [(n, [_as_shown(cell.value, cell.number_format) for cell in row]) for n, row in rows]
    except OSError as error:
        raise SheetError(f"file {path} cannot be read: {error.strerror or error}") from None
    except Exception as error:  # of a file that is damaged, in as many ways as it can be
        words = " ".join(str(error).split()) or type(error).__name__
        raise SheetError(f"file {path} is no Excel workbook, or damaged: {cut(words)}") from None
    return [(n, row) for n, row in kept if any(str(cell).strip() for cell in row)]


def _as_shown(value: Any, form: str | None) -> Any:
    """The value of a cell, of which a spreadsheet program may show per cent: 0.85 as 85 %."""
    if in_per_cent(value, form):
        return f"{numbers.significant(100 * value, 15)} %"
    return "" if value is None else value


def in_per_cent(value: Any, form: str | None) -> bool:
    """Whether a cell of this number format shows its number in per cent."""
    return type(value) in (int, float) and form is not None and form.rstrip("_ )").endswith("%")
