"""A list with an element for each row of a table, or for those that a condition keeps, whatever their number."""

from collections.abc import Callable
from types import FunctionType
from typing import Any

import numpy as np

from mechsheet.quantities.arithmetic import choice as where
from mechsheet.quantities.array_rules import SORTED
from mechsheet.quantities.graph import NotRecorded, current
from mechsheet.quantities.quantity import Listed, Quantity, is_any_length, lift
from mechsheet.quantities.selected import Selected
from mechsheet.quantities.text_column import Texts
from mechsheet.quantities.ufunc_rules import finite
from mechsheet.recording import per_row
from mechsheet.recording.by_size import decide
from mechsheet.recording.choices import part_of, way_may_change
from mechsheet.recording.per_row import columns
from mechsheet.recording.sifted import Sifted
from mechsheet.worksheet.lists import Whole, first_column


def each_row(f: Callable[..., Any], plainly: Callable[..., Any], *sources: Any) -> "EachRow | None":
    """Those rows for which the first of what ``f`` gives holds, each with the second; None where they are not followed.

    ``plainly`` is what Python makes of pairs of elements, of so many rows as there are now.
    """
    if not current.get().draws:
        return None
    every = [_unselected(source) for source in sources]
    if len({holds.re for _, holds in every if holds is not None}) > 1 or len({holds is None for _, holds in every}) > 1:
        return None
    found = columns(f, *(source for source, _ in every))
    if found is None or not isinstance(holds := found.parts[0], Quantity):
        return None
    holds = holds if holds.dtype == bool else holds != 0
    return EachRow(found.parts[1], holds if every[0][1] is None else holds & every[0][1], plainly)


def of_rows(kind: str, f: FunctionType, plainly: Callable[..., Any], *sources: Any) -> Any:
    """What ``f`` gives for each row in all, of a table or of those rows of one for which a condition holds."""
    if any(_unselected(source)[1] is not None for source in sources):
        rows = each_row(lambda *row: (True, f(*row)), lambda *_: None, *sources) if not way_may_change(f) else None
        found = None if rows is None else rows.column() if kind == "array" else rows.followed(kind)
        return plainly(*sources) if found is None else found
    return per_row.of_rows(kind, f, plainly, *sources)


def every_row(values: Any, plainly: Callable[..., Any]) -> "EachRow | None":
    """All rows of a table or a column that may have any number of them; None of anything else."""
    if isinstance(values, EachRow):
        return values if values.pairs else None
    values, holds = _unselected(values)
    column = first_column(values) if isinstance(values, Whole) else values
    if not is_any_length(column):
        return None
    return EachRow(values, lift(current.get(), True).like(column) if holds is None else holds, plainly)


def _unselected(source: Any) -> tuple[Any, Quantity | None]:
    """All rows of a column or a table, and for which of them a condition holds where only these are meant."""
    match source:
        case EachRow(pairs=[_, *_]):
            return source.parts, source.holds
        case Selected(of=of, holds=holds):
            return of, holds
        case Texts(at=Selected(of=of, holds=holds)):
            return Texts(source.name, source.column, source.texts, of), holds
        case Whole():
            each = {name: _unselected(column) for name, column in vars(source).items()}
            if all(holds is not None for _, holds in each.values()):
                whole: Any = object.__new__(type(source))
                for name, (column, _) in each.items():
                    object.__setattr__(whole, name, column)
                return whole, next(holds for _, holds in each.values())
    return source, None


class EachRow(Sifted, Listed):
    """The elements that are kept now; how many, the first, the least, their sum and order hold for others too.

    Whatever else reads the list sees how many rows there are, and which of them are kept.
    """

    def __init__(self, parts: Any, holds: Quantity, plainly: Callable[..., Any]) -> None:
        """``parts`` are columns of what the elements are, whether kept or not, by its number."""
        list.__init__(self)
        self.parts, self.holds, self._plainly = parts, holds, plainly
        self.pairs = [(holds, parts)]

    def of(self, kind: str, *otherwise: Any) -> Any:
        found = self.followed(kind, *otherwise)
        if found is not None:
            return found
        each = range(len(self.holds))  # so many rows as there are
        return self._plainly(kind, [(self.holds[k], lambda k=k: self.parts[k]) for k in each], otherwise)

    def followed(self, kind: str, *otherwise: Any) -> Any:
        """What it is for any number of rows; None where Python has to look."""
        graph = current.get()
        looked = dict(graph.looked)
        try:
            found = self._by(kind, *otherwise) if kind.endswith(" by") else self._followed(kind, *otherwise)
        except (Exception, NotRecorded):
            found = None
        if found is None:
            graph.looked = looked
        return found

    def _by(self, kind: str, key: Any) -> Any:
        """The first element whose key is the greatest or the least."""
        keys, end = self._keys(key), kind.removesuffix(" by")
        row: Any = np.argmax(self.holds & (keys == Selected(keys, self.holds).filled(end).reduced(end)))
        decide(self._kept_of(keys, row), None, f"arg{end}")
        return self._at(row, self.some)

    def _kept_of(self, keys: Quantity, row: Any) -> Quantity:
        """Numbers of the rows that are kept, and for all others that of the ``row``."""
        return lift(keys.graph, where(keys.graph, self.holds, keys, keys[row]))

    def _followed(self, kind: str, *given: Any) -> Any:
        graph, some = current.get(), self.some
        if kind in ("first", "last"):
            return self._first(0 if kind == "first" else -1, *given)
        if kind == "len":
            return self._count.reduced("sum")
        if not isinstance(self.parts, Quantity):
            return None
        if kind in ("any", "all"):
            true = self.parts if self.parts.dtype == bool else self.parts != 0
            return (self.holds & true if kind == "any" else ~self.holds | true).reduced(kind)
        if kind == "sum":
            total = where(graph, self.holds, self.parts, 0).reduced("sum")
            return total + given[0] if given else total
        if not (some.value or given or graph.supposed):
            return None
        least = Selected(self.parts, self.holds).filled(kind).reduced(kind)
        return where(graph, some, least, *(given or (np.nan,)))

    @property
    def some(self) -> Quantity:
        return self.holds.reduced("any")

    @property
    def _count(self) -> Quantity:
        counted: Quantity = where(current.get(), self.holds, 1, 0)
        return counted

    def _at(self, row: Any, exists: Quantity) -> Any:
        """The element of a row, where there is one; None where there is none now."""
        if not exists.value and not current.get().supposed:
            return None
        return self.parts[where(current.get(), exists, row, np.nan)]

    def _first(self, number: Any, *otherwise: Any) -> Any:
        """The element of that number among those that are kept."""
        so_far: Any = self._count.cumsum()
        from_end = so_far[-1] + number + 1
        pointed = isinstance(number, Quantity)
        wanted = np.where(number < 0, from_end, number + 1) if pointed else from_end if number < 0 else number + 1
        hit = self.holds & (so_far == wanted)
        exists, row = hit.reduced("any"), np.argmax(hit)
        if not otherwise:
            return self._at(row, exists)
        return part_of(exists, self.parts[where(current.get(), exists, row, np.nan)], otherwise[0])

    def _keys(self, key: Any) -> Quantity:
        """A number of each row, by which rows are compared; of what is none nobody knows the order."""
        graph, keys = current.get(), self.parts if key is None else columns(key, self.parts)
        if not isinstance(keys, Quantity) or keys.im is not None:
            raise NotRecorded("what is compared is no number")
        keys = where(graph, keys, 1, 0) if keys.dtype == bool else keys
        known = (finite(keys) | ~self.holds).reduced("all")
        if not known.value:
            raise NotRecorded("what is compared is no number")
        if keys.re not in graph.always:
            graph.see(known.re)
        return keys

    def in_order(self, key: Any, reverse: bool) -> "EachRow | None":
        """The same by their size, equal ones as they stand; None where Python has to look."""
        if len(self.holds.value) > SORTED:
            return None
        graph = current.get()
        looked = dict(graph.looked)
        try:
            keys = self._keys(key)
            keys = self._kept_of(-keys if reverse else keys, np.argmax(self.holds))
            decide(keys, None, "argsort")
            order: Any = np.argsort(keys)
            return EachRow(self.parts[order], self.holds[order], self._plainly)
        except (Exception, NotRecorded):
            graph.looked = looked
            return None

    def column(self) -> Quantity | None:
        return Selected(self.parts, self.holds) if self.pairs and isinstance(self.parts, Quantity) else None

    def held(self) -> list[Any]:
        return [*self.pairs[0]] if self.pairs else [*list.__iter__(self)]

    def __getitem__(self, key: Any) -> Any:
        if self.pairs and (isinstance(key, int | np.integer) or (isinstance(key, Quantity) and key.single)):
            found = self._first(key)
            if found is None:
                raise IndexError("list index out of range")
            return found
        if self.pairs and isinstance(key, slice) and key.step is None and _from_start(key.start, key.stop):
            so_far: Any = self._count.cumsum()
            holds = self.holds & (so_far > (key.start or 0))
            return EachRow(self.parts, holds if key.stop is None else holds & (so_far <= key.stop), self._plainly)
        self._look()
        return list.__getitem__(self, key)

    def _look(self) -> None:
        if self.pairs:
            rows = np.flatnonzero(self.holds.seen())
            if not list.__len__(self):
                list.extend(self, [self.parts[int(k)] for k in rows])


def _from_start(*ends: Any) -> bool:
    return all(end is None or (type(end) is int and end >= 0) for end in ends)


CALLS: dict[str, Any] = {"of_rows": of_rows}
