"""Columns of numbers in a file beside a worksheet: CSV as spreadsheet programs write it, or a workbook's first sheet.

The first row has the names of the columns, each with its unit behind it: ``phi [deg]; p [MPa]``. CSV is apart by
``;``, tabs or commas, whichever the first row has; lines that begin with # and empty ones are passed over.
"""

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

from mechsheet.worksheet.errors import SheetError, cut

ENDINGS = (".csv", ".tsv", ".txt", ".xlsx")
MISSING = frozenset(["", "nan", "na", "n/a", "#n/a", "none", "null", "-"])  # as programs write what was not measured
_HEAD = r"\s*(\w+)\s*(?:\[([^\]]*)\])?\s*"
_NAME = re.compile(rf"""["']([^"'\n]+(?:{"|".join(map(re.escape, ENDINGS))}))["']""", re.IGNORECASE)
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


def columns(path: Path, wanted: Iterable[str]) -> Columns:
    """The wanted columns of a file; others are passed over.

    Raises SheetError naming the file, and the row and column of what cannot be used.
    """
    rows = _book(path) if path.suffix.lower() == ".xlsx" else _text(path)
    if not rows:
        raise SheetError(f"file {path} is empty")
    (first, heads), *body = rows
    units, at = dict[str, str](), dict[str, int]()
    for n, head in enumerate(heads):
        match = re.fullmatch(_HEAD, str(head))
        if match and match[1] in at:
            raise SheetError(f"file {path}, row {first}: column {match[1]} stands there twice")
        if match:
            at[match[1]], units[match[1]] = n, match[2] or ""
    for name in wanted:
        if name not in at:
            raise SheetError(f"file {path}, row {first}: no column {name}; it has {cut(', '.join(at)) or 'no names'}")
    for number, cells in body:
        if len(cells) > len(heads) and any(str(cell).strip() for cell in cells[len(heads) :]):
            raise SheetError(f"file {path}, row {number}: {len(cells)} values under {len(heads)} names of columns")
    found = {
        name: [_with_unit(cells[at[name]] if at[name] < len(cells) else "", units[name]) for _, cells in body]
        for name in wanted
    }
    return Columns(path, found, tuple(number for number, _ in body))


def _with_unit(cell: Any, unit: str) -> Any:
    own = re.search(r"[^\W\d_]", re.sub(r"[eE][+-]?\d", "", str(cell)))
    return f"{cell} {unit}" if unit not in ("", "-") and not own and str(cell).strip() else cell


def _text(path: Path) -> list[tuple[int, list[Any]]]:
    import csv  # on use: most worksheets read no file

    try:
        text = path.read_text(encoding="utf-8-sig")
    except OSError as error:
        raise SheetError(f"file {path} cannot be read: {error.strerror or error}") from None
    except UnicodeDecodeError:
        raise SheetError(f"file {path} is no text in UTF-8") from None
    lines = [(n, line) for n, line in enumerate(text.splitlines(), 1) if line.strip() and not line.startswith("#")]
    apart = next((mark for mark in ";\t" if lines and mark in lines[0][1]), ",")
    return [(n, next(csv.reader([line], delimiter=apart))) for n, line in lines[:_MOST]]


def _book(path: Path) -> list[tuple[int, list[Any]]]:
    from openpyxl import load_workbook  # type: ignore[import-untyped]  # on use: takes a third of a second

    try:
        with path.open("rb") as file:
            book = load_workbook(file, read_only=True, data_only=True)
            sheet = book.worksheets[0]
            sheet.reset_dimensions()
            rows = enumerate(sheet.iter_rows(max_row=_MOST, max_col=100, values_only=True), 1)
            kept = [(n, ["" if cell is None else cell for cell in row]) for n, row in rows]
    except OSError as error:
        raise SheetError(f"file {path} cannot be read: {error.strerror or error}") from None
    except Exception as error:  # of a file that is damaged, in as many ways as it can be
        words = " ".join(str(error).split()) or type(error).__name__
        raise SheetError(f"file {path} is no Excel workbook, or damaged: {cut(words)}") from None
    return [(n, row) for n, row in kept if any(str(cell).strip() for cell in row)]
