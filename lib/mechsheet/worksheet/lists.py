"""Lists and tables as inputs: each column a declared number or text, each element read and converted as one."""

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from mechsheet.worksheet import data_file, errors, limits
from mechsheet.worksheet.count import Count
from mechsheet.worksheet.errors import SheetError
from mechsheet.worksheet.kinds import Input
from mechsheet.worksheet.numbers import significant

MOST_ROWS = 10_000
_BRIEF = 12  # rows that stand in full where all inputs are listed


@dataclass(frozen=True)
class Rows(Input):
    """A list, whose one column has its name, or a table of columns such as ``bolts.x``, which ``row`` declares.

    It is held as an array, or as an object of the class ``row`` whose attributes are arrays, and whose rows can be gone
    through: `Whole`. Shown it is a dictionary of arrays by column.
    """

    columns: tuple[Input, ...] = ()
    row: type | None = None
    folder: str = ""  # of the worksheet

    def display(self, value: Any) -> Any:
        return {name: c.array(map(c.display, xs.tolist())) for name, (c, xs) in self.held_by(value).items()}

    def read(self, value: object) -> Any:
        """Columns from a text of rows, a list of rows, or a mapping of columns.

        A row of a text ends with its line or with ``|``, its cells are apart by ``;`` or a tab; a text that ends
        as the name of a file does is one, in the current folder or beside the worksheet.
        """
        if isinstance(value, str) and value.strip().lower().endswith(data_file.ENDINGS + data_file.OTHER_SPREADSHEETS):
            return self.of_file(Path(value.strip()))
        given = self._columns(value)
        count = {len(xs) for xs in given.values()}
        if len(count) > 1:
            lengths = ", ".join(f"{len(xs)} of {name}" for name, xs in given.items())
            must = "columns must be as long as each other"
            raise SheetError(f"{self.meaning} {self.name}: {must}, not {lengths}", self.name)
        self._counted(max(count))
        try:
            return self._read(given)
        except SheetError as error:
            alone = isinstance(value, str) and len(given[self.columns[0].name]) == 1
            if alone and str(error).endswith("no number") and re.search(r"\d[\s,]+\S*\d", str(value)):
                raise SheetError(f"{error}; those of a list stand apart by ;", error.of) from None
            raise

    def _read(self, given: Mapping[str, list[Any]]) -> Any:
        return {c.name: c.array(_of_row(c, k).read(x) for k, x in enumerate(given[c.name])) for c in self.columns}

    def of_file(self, path: Path) -> Any:
        """Columns of a file, by their names in it."""
        beside = Path(self.folder) / path
        short = {c.name.rpartition(".")[2]: c for c in self.columns}
        wanted = {name: None if column.is_text else column.unit for name, column in short.items()}
        file = data_file.columns(path if path.is_file() else beside, wanted)
        found = dict[str, NDArray[Any]]()
        for name, column in short.items():
            for k, cell in enumerate(file.cells[name]):
                try:
                    _of_row(column, k).read(cell)
                except SheetError as error:
                    place = f"file {file.path}, row {file.rows[k]}, column {name}"
                    remedy = ": fill it or leave out the row" * (str(cell).strip().lower() in data_file.MISSING)
                    raise SheetError(f"{place}: {error}{remedy}", self.name) from None
            found[column.name] = xs = column.array(map(column.read, file.cells[name]))
            if column.is_text:
                continue
            own = tuple(limit for limit in column.limits if not re.match(r"[^\W\d]", limit[1]))
            for holds, refusal in limits.rules([replace(column, limits=own)], {column.name: xs}):
                for k in np.flatnonzero(~np.broadcast_to(holds, xs.shape))[:1]:
                    raise SheetError(f"file {file.path}, row {file.rows[k]}, column {name}: {refusal(k)}", self.name)
        return self.read(found)

    def si(self, value: Any, default: Any) -> Any:
        return self.held(self._si(value, default))

    def _si(self, value: Any, default: Any) -> dict[str, NDArray[Any]]:
        found = dict[str, NDArray[Any]]()
        for name, (column, own) in self.held_by(default).items():
            known = {column.display(x): x for x in own.tolist()}
            found[name] = column.array(known[x] if x in known else column.si(x, np.nan) for x in value[name].tolist())
        return found

    def written(self, value: Any, default: Any) -> Any:
        shown = self.display(value)
        read = self._si(shown, default)
        return {
            name: c.array(
                s if r == x else c.written(x, np.nan) for s, r, x in zip(shown[name], read[name], xs, strict=True)
            )
            for name, (c, xs) in self.held_by(value).items()
        }

    def text(self, value: Any) -> str:
        columns = [map(c.text, xs.tolist()) for c, xs in self.held_by(value).values()]
        rows = ("; ".join(row) or ";" for row in zip(*columns, strict=True))  # a row of one empty text is one too
        return ("; " if self.row is None else "\n").join(rows)

    def brief(self, value: Any) -> str:
        columns = [map(c.brief, xs.tolist()) for c, xs in self.held_by(value).values()]
        rows = list(map("; ".join, zip(*columns, strict=True)))
        count = f" ({len(rows)} rows)" if len(rows) > _BRIEF else ""
        shown = [*rows[:3], "..", rows[-1]] if count else rows
        return ("; " if self.row is None else " | ").join(shown) + count

    def readings(self, value: object) -> Iterator[str]:
        if isinstance(value, str) and value.strip().lower().endswith(data_file.ENDINGS):
            return
        for name, xs in self._columns(value).items():
            column = next(c for c in self.columns if c.name == name)
            for k, x in enumerate(xs):
                yield from _of_row(column, k).readings(x)

    def first(self, value: Any) -> Any:
        if isinstance(value, data_file.DataFile):
            none = self.held({column.name: column.array(()) for column in self.columns})
            return self.si(self.of_file(Path(self.folder) / value.name), none)
        return self.taken(value)

    def taken(self, value: Any) -> Any:
        """Arrays of what code gives in SI: numbers, or objects of the class of the rows.

        Raises SheetError where it is no such list, or has none or too many rows.
        """
        if self.row is None:
            return self._numbers(value)
        own = {column.name: column.name.rpartition(".")[2] for column in self.columns}
        if all(np.ndim(getattr(value, name, 0.0)) == 1 for name in own.values()):
            return value
        if not isinstance(value, list | tuple) or not all(hasattr(row, n) for row in value for n in own.values()):
            must = f"must be a list of rows such as {self.row.__name__}({', '.join(own.values())})"
            raise SheetError(f"{self.name} = {errors.as_given(value)} {must}", self.name)
        given = {column: [getattr(row, own[column.name]) for row in value] for column in self.columns}
        return self.held({c.name: self._texts(c, xs) if c.is_text else self._numbers(xs) for c, xs in given.items()})

    def _texts(self, column: Input, given: Sequence[Any]) -> NDArray[Any]:
        """An array of its own of the texts of a column."""
        self._counted(len(given))
        return _fixed(column.array(_of_row(column, k).read(x) for k, x in enumerate(given)))

    def _numbers(self, value: Any) -> NDArray[np.float64]:
        """An array of its own of a list of numbers."""
        try:
            numbers = np.array(value)
        except ValueError:  # of rows that differ in length
            numbers = np.array("")
        if numbers.size and (numbers.ndim != 1 or numbers.dtype.kind not in "iuf"):
            raise SheetError(f"{self.name} = {errors.as_given(value)} must be a list of numbers", self.name)
        self._counted(numbers.size)
        return _fixed(numbers.astype(float))

    def _counted(self, count: int) -> None:
        if not 0 < count <= MOST_ROWS:
            must = f"must have 1 to {MOST_ROWS} rows"
            raise SheetError(f"{self.meaning} {self.name} {must}, not {count}", self.name)

    def leaves(self, value: Any) -> dict[str, tuple[Input, Any]]:
        return {name: (c, np.zeros(len(xs)) if c.is_text else xs) for name, (c, xs) in self.held_by(value).items()}

    def texts(self, value: Any) -> tuple[str, ...]:
        return tuple(text for column, xs in self.held_by(value).values() if column.is_text for text in xs)

    def held_by(self, value: Any) -> dict[str, tuple[Input, NDArray[Any]]]:
        """The columns of a value by name, each with its declaration: of numbers and of texts."""
        if self.row is None:
            return {self.name: (self.columns[0], value)}
        return {c.name: (c, getattr(value, c.name.rpartition(".")[2])) for c in self.columns}

    def leaf(self, column: Any, default: Any) -> Any:
        found = np.empty(len(column), dtype=object)
        for i, shown in enumerate(column):
            found[i] = self._si(shown, default) if isinstance(shown, dict) else None
        return found

    def held(self, leaves: Mapping[str, Any]) -> Any:
        own = leaves.get(self.name)
        leaves = own if isinstance(own, dict) else leaves  # of one of several variants
        if self.row is None:
            return leaves[self.name]
        table: Any = object.__new__(_unchecked(self.row))
        for column in self.columns:
            object.__setattr__(table, column.name.rpartition(".")[2], leaves[column.name])
        return table

    def same(self, a: Any, b: Any) -> bool:
        pairs = zip(self.held_by(a).values(), self.held_by(b).values(), strict=True)
        return all(np.array_equal(x, y) for (_, x), (_, y) in pairs)

    def _columns(self, value: Any) -> dict[str, list[Any]]:
        """What is given of each column, not read yet."""
        short = {c.name.rpartition(".")[2]: c.name for c in self.columns}
        apart = " apart by ;, rows by |" if isinstance(value, str) and ";" not in value else ""
        if isinstance(value, str):
            cells = _cells(value, len(short))
            if len(short) == 1:  # whose rows may stand apart by ; too
                cells = [[cell] for row in cells for cell in row]
            value = cells if self.row else [cell for (cell,) in cells]
        if hasattr(value, "items"):
            given = {str(name): np.ravel(np.asarray(xs, dtype=object)).tolist() for name, xs in value.items()}
            given = {short.get(name, name): xs for name, xs in given.items()}
            self._named(given, "")
            return given
        if not isinstance(value, list | tuple | np.ndarray):
            raise SheetError(f"{self.says(errors.as_given(value))} must be {self._form()}", self.name)
        if self.row is None:
            return {self.name: list(value)}
        rows = list[dict[str, Any]]()
        for k, row in enumerate(value, 1):
            if isinstance(row, Mapping):
                named = {short.get(str(name), str(name)): x for name, x in row.items()}
                self._named(named, f" ({k})")
                rows.append(named)
            elif isinstance(row, list | tuple | np.ndarray) and len(row) == len(short):
                rows.append(dict(zip(short.values(), row, strict=True)))
            else:
                told = errors.as_given("; ".join(map(str, row)) if isinstance(row, list) else row)
                at = f"{self.name} ({k})"
                raise SheetError(f"{self.meaning} {at} = {told} must have the columns {', '.join(short)}{apart}", at)
        return {name: [row[name] for row in rows] for name in short.values()}

    def _named(self, given: Iterable[str], where: str) -> None:
        """Refuse columns that there are not, and that are missing."""
        own = [column.name for column in self.columns]
        if set(given) != set(own):
            names = ", ".join(name.rpartition(".")[2] for name in own)
            has = ", ".join(given) or "none"
            at = f"{self.name}{where}"
            raise SheetError(f"{self.meaning} {at} must have the columns {names}; it has {errors.cut(has)}", at)

    def _form(self) -> str:
        return 'a list such as "1; 2,5; 3"' if self.row is None else "rows, or columns by name"


def as_text(columns: Mapping[str, NDArray[Any]]) -> str:
    """The text of a list, or of the rows of a table, which is read as these columns."""
    each = ([significant(x, 15) if isinstance(x, float) else str(x) for x in xs.tolist()] for xs in columns.values())
    rows = map("; ".join, zip(*each, strict=True))
    return ("; " if len(columns) == 1 else " | ").join(rows)


def _cells(text: str, width: int) -> list[list[str]]:
    """Cells of the rows of a text; a row of that width may end in one more sign between them."""
    rows = [re.split(r"[;\t]", row) for row in re.split(r"[\n|]", text) if row.strip()]
    return [[cell.strip() for cell in (row[:-1] if len(row) > width and not row[-1].strip() else row)] for row in rows]


def _of_row(column: Input, k: int) -> Input:
    """A column as an error names the element of one of its rows, which are counted from 1."""
    return replace(column, name=f"{column.name} ({k + 1})")


def _fixed(array: NDArray[Any]) -> NDArray[Any]:
    array.flags.writeable = False
    return array


class Whole:
    """All rows of a table: its columns by their names, ``bolts.x``, its rows as ``bolts[0]`` or ``for bolt in bolts``.

    A slice, or whatever else takes several rows of an array, gives a table of these. It has no other name of its own
    than Python's, for columns may have any.
    """

    __row__: ClassVar[type]
    __counted__: ClassVar[tuple[str, ...]]  # columns of whole numbers

    def __len__(self) -> int:
        return len(first_column(self))

    def __getitem__(self, key: Any) -> Any:
        parts = {name: column[key] for name, column in vars(self).items()}
        alone = not any(getattr(part, "ndim", 0) for part in parts.values())  # a text has none
        found: Any = object.__new__(self.__row__ if alone else type(self))
        for name in self.__counted__ if alone else ():
            if isinstance(parts[name], float):  # teeth of a row, ``range(stage.z)``
                parts[name] = Count(parts[name])
        for name, part in parts.items():
            object.__setattr__(found, name, part)
        return found

    def __iter__(self) -> Iterator[Any]:
        return (self[k] for k in range(len(self)))


def first_column(table: Whole) -> Any:
    """The first column of a table, of numbers where it has some."""
    columns = list(vars(table).values())
    return next((column for column in columns if column.dtype != object), columns[0])


@cache
def _unchecked(row: Any) -> type:
    """The class of the rows for whole columns, whose numbers are checked with those of the other inputs."""
    counted = tuple(field.name for field in row.__properties__ if field.counted)
    return type(row.__name__, (Whole, row), {"__post_init__": lambda _: None, "__row__": row, "__counted__": counted})
