"""A list with an element for each row of a table, or for those that a condition keeps, whatever their number."""

import weakref
from collections.abc import Callable, Sequence
from types import FunctionType
from typing import Any

import numpy as np

from mechsheet.quantities.arithmetic import as_count
from mechsheet.quantities.arithmetic import choice as where
from mechsheet.quantities.array_rules import SORTED
from mechsheet.quantities.graph import NotRecorded, current
from mechsheet.quantities.numpy_rules import as_many
from mechsheet.quantities.quantity import Listed, Quantity, has_quantity, is_any_length, lift, owner
from mechsheet.quantities.refused import pointed, refused
from mechsheet.quantities.selected import Selected
from mechsheet.quantities.text_column import Texts
from mechsheet.quantities.ufunc_rules import finite
from mechsheet.recording import loops, ordered, per_row
from mechsheet.recording.among import of_all
from mechsheet.recording.by_size import decide
from mechsheet.recording.choices import merged, part_of, way_may_change
from mechsheet.recording.loops import Turns
from mechsheet.recording.per_row import Together, columns
from mechsheet.recording.sifted import Sifted
from mechsheet.worksheet.lists import Whole


def each_row(f: Callable[..., Any], *sources: Any) -> "EachRow | None":
    """The second of what ``f`` gives for those rows for which the first holds; None where they are not followed."""
    if not current.get().draws:
        return None
    every = [_unselected(source) for source in sources]
    if len({holds.re for _, holds in every if holds is not None}) > 1 or len({holds is None for _, holds in every}) > 1:
        return None
    found = columns(f, *(source for source, _ in every))
    if found is None or not isinstance(holds := found.parts[0], Quantity):
        return None
    holds = holds if holds.dtype == bool else holds != 0
    return EachRow(found.parts[1], holds if every[0][1] is None else holds & every[0][1])


def listed(f: FunctionType, plainly: Callable[..., Any], *sources: Any) -> Any:
    """A list of what ``f`` gives for each row, of a table or of those rows of one for which a condition holds."""
    every = [_unselected(source) for source in sources]
    if not current.get().draws:
        return plainly(*sources)
    if any(holds is not None for _, holds in every):
        rows = None if way_may_change(f) else each_row(lambda *row: (True, f(*row)), *sources)
    else:
        found = columns(f, *(source for source, _ in every))
        rows = None if found is None else _all(found, *(source for source, _ in every))
    return plainly(*sources) if rows is None else rows


def of_rows(kind: str, f: FunctionType, plainly: Callable[..., Any], *sources: Any) -> Any:
    """What ``f`` gives for each row in all, of a table or of those rows of one for which a condition holds."""
    made = _of_rows(kind, f, plainly, *sources)
    if kind == "array" and isinstance(made, Quantity):
        made.graph.of_lists.update(made.parts)
    return made


def _of_rows(kind: str, f: FunctionType, plainly: Callable[..., Any], *sources: Any) -> Any:
    if kind in ("sum", "prod") and isinstance(sources[0], Turns) and not (sources[1:] or way_may_change(f)):
        return loops.over_all(kind, f, sources[0])
    every = [_unselected(source) for source in sources]
    if any(holds is not None for _, holds in every):
        rows = None if way_may_change(f) else each_row(lambda *row: (True, f(*row)), *sources)
        found = None if rows is None else rows.column() if kind == "array" else rows.followed(kind)
        return plainly(*sources) if found is None else found
    return per_row.of_rows(kind, f, lambda *_: plainly(*sources), *(source for source, _ in every))


def sums(kinds: str, f: FunctionType, held: Sequence[Any], *sources: Any) -> list[Any] | None:
    """Sums of each of the values that ``f`` gives for a row, or lists or arrays of them, and whether there are rows.

    None where they are not followed. The lists and arrays were ``held`` before: empty, or of as many elements, of which
    each is set.
    """
    every = [_unselected(source) for source in sources]
    each, whole = kinds.split(), iter(held)
    before = [None if kind == "sum" else next(whole) for kind in each]
    if any(kind == "list" and (type(x) is not list or x) for kind, x in zip(each, before, strict=True)):
        return None
    if all(holds is None for _, holds in every):
        found = per_row.each_of(f, *(source for source, _ in every))
        made = None if found is None else [*map(_made, each, found, before)]
        if made is None or any(x is None for x in made):
            return None
        count = per_row.first_of(every[0][0]).count(0)
        return [*made, count > 0 if isinstance(count, Quantity) else True]
    rows = None if way_may_change(f) or held else each_row(lambda *row: (True, f(*row)), *sources)
    if rows is None or not rows.some.value:  # the names of the loop are bound to its last row
        return None
    return [*(EachRow(part, rows.holds).of("sum") for part in rows.parts.parts), rows.some]


def _made(kind: str, column: Quantity, before: Any) -> Any:
    """What a loop makes of a value for each row; None of an array that is of another length or kind."""
    if kind == "sum":
        return column.reduced("sum")
    if kind == "list":
        return _all(column, column)
    graph = column.graph
    same = isinstance(before, Quantity) and not isinstance(before, Selected) and before.ndim == 1
    if (
        not same
        or before.im is not column.im
        or before.dtype.kind != "f"
        or graph.size(before.re) != graph.size(column.re)
    ):
        return None
    graph.meant.gone.append(weakref.ref(owner(before)))
    return column


def paired(*sources: Any, **named: Any) -> Any:
    """Python's zip."""
    every = [_unselected(source)[0] for source in sources if _unselected(source)[1] is None]
    if current.get().draws and len(every) == len(sources) > 0 and per_row.are_rows(every):
        return _all(Together(tuple(every)), *every)
    return zip(*sources, **named)  # noqa: B905


def numbered(source: Any, start: Any = 0) -> Any:
    """Python's enumerate."""
    values, holds = _unselected(source)
    if current.get().draws and holds is None and type(start) is int and per_row.are_rows([values]):
        column = per_row.first_of(values)
        rows = per_row.Numbers(Quantity(column.graph, column.graph.rows(column.count(0).re)), lambda row: row + start)
        return _all(Together((rows, values)), values)
    return enumerate(source, start)


def counted(*ends: Any) -> Any:
    """Python's range; of so many numbers as the inputs say one by one."""
    turns = loops.counted(*ends)
    if current.get().draws and isinstance(turns, Turns):
        rows = Quantity(current.get(), current.get().rows(as_many(turns.count).re))
        if is_any_length(rows):
            return _all(per_row.Numbers(rows, turns.of), rows)
    return turns


def placed(values: Any, value: Any) -> Any:
    """``values.index(value)``: the first place of a number in a list."""
    column = values.column() if isinstance(values, EachRow) else None
    if column is None or not isinstance(value, Quantity | int | float) or isinstance(column, Selected):
        return ordered.placed(values, value)
    hit: Quantity = column == value
    if not (some := hit.reduced("any")).value:
        return list(values).index(value)
    return refused(where(column.graph, some, np.argmax(hit), np.nan))


def _all(parts: Any, *sources: Any) -> "EachRow":
    """A list of all rows of some columns."""
    true = lift(current.get(), True).like(per_row.first_of(sources[0]))
    return EachRow(parts, true, every=True)


def every_row(values: Any) -> "EachRow | None":
    """All rows of a table or a column that may have any number of them; None of anything else."""
    if isinstance(values, EachRow):
        return values if values.pairs else None
    values, holds = _unselected(values)
    if not per_row.are_rows([values]) or not current.get().draws:
        return None
    return _all(values, values) if holds is None else EachRow(values, holds)


def _unselected(source: Any) -> tuple[Any, Quantity | None]:
    """All rows of a column or a table, and for which of them a condition holds where only these are meant."""
    match source:
        case EachRow(pairs=[_, *_]):
            return source.parts, None if source.every else source.holds
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

    def __new__(cls, *given: Any, **_: Any) -> Any:
        """One that is made of the elements of another one is a list as any."""
        return list.__new__(cls) if given[1:] else list(*given)

    def __init__(self, parts: Any, holds: Quantity, every: bool = False) -> None:
        """``parts`` are columns of what the elements are, whether kept or not; ``every`` one may be."""
        list.__init__(self)
        self.parts, self.holds, self.every = parts, holds, every
        self.pairs = [(holds, parts)]

    def of(self, kind: str, *otherwise: Any) -> Any:
        found = self.followed(kind, *otherwise)
        if found is not None:
            return found
        each = range(len(self.holds))  # so many rows as there are
        name, _, by = kind.partition(" ")
        if self.every and name in ("min", "max"):
            named = {"key" if by else "default": one for one in otherwise}
            return ordered.CALLS[name]([self.parts[k] for k in each], **named)
        return of_all(kind, [(self.holds[k], lambda k=k: self.parts[k]) for k in each], otherwise)

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
        elif kind in ("sum", "min", "max") and isinstance(self.parts, Quantity):
            found = as_count(lift(graph, found), self.parts)
        return found

    def _by(self, kind: str, key: Any) -> Any:
        """The first element whose key is the greatest or the least; of tuples by the first part that differs."""
        end, best = kind.removesuffix(" by"), self.holds
        keys = self.parts if key is None else columns(key, self.parts)
        for part in keys.parts if isinstance(keys, Together) else [keys]:
            each = self._keys(part)
            closer: Quantity = best & (each == Selected(each, best).filled(end).reduced(end))
            decide(_of_some(best, each, np.argmax(closer)), None, f"arg{end}")
            best = closer
        return self._at(np.argmax(best), self.some)

    def _followed(self, kind: str, *given: Any) -> Any:
        graph, some = current.get(), self.some
        if kind in ("first", "last"):
            return self._first(0 if kind == "first" else -1, *given)
        if kind == "len":
            return self._count.reduced("sum")
        if kind in ("min", "max") and isinstance(self.parts, Together) and not given:
            return self._by(kind, None)
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
        return merged(some, least, given[0]) if given else refused(where(graph, some, least, np.nan))

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
        return pointed(self.parts[where(current.get(), exists, row, np.nan)], self.parts)

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

    def _keys(self, keys: Any) -> Quantity:
        """A number of each row, by which rows are compared; of what is none nobody knows the order."""
        graph = current.get()
        if not isinstance(keys, Quantity) or keys.im is not None:
            raise NotRecorded("what is compared is no number")
        each: Quantity = where(graph, keys, 1, 0) if keys.dtype == bool else keys
        known = (finite(each) | ~self.holds).reduced("all")
        if not known.value:
            raise NotRecorded("what is compared is no number")
        if each.re not in graph.always:
            graph.see(known.re)
        return each

    def in_order(self, key: Any, reverse: bool) -> "EachRow | None":
        """The same by their size, equal ones as they stand; None where Python has to look."""
        if len(self.holds.value) > SORTED:
            return None
        graph = current.get()
        looked = dict(graph.looked)
        try:
            keys = self._keys(self.parts if key is None else columns(key, self.parts))
            keys = _of_some(self.holds, -keys if reverse else keys, np.argmax(self.holds))
            decide(keys, None, "argsort")
            order: Any = np.argsort(keys, kind="stable")
            return EachRow(self.parts[order], self.holds[order], self.every)
        except (Exception, NotRecorded):
            graph.looked = looked
            return None

    def column(self) -> Quantity | None:
        parts = self.parts.of(self.parts.column) if isinstance(self.parts, per_row.Numbers) else self.parts
        if not self.pairs or not isinstance(parts, Quantity):
            return None
        return parts if self.every else Selected(parts, self.holds)

    def each(self) -> list[tuple[Any, Any]]:
        """As many as there are rows now."""
        rows = range(len(self.holds)) if self.pairs else ()
        return [(True if self.every else self.holds[k], self.parts[k]) for k in rows]

    def held(self) -> list[Any]:
        return [self.holds, *per_row.held_by(self.parts)] if self.pairs else [*list.__iter__(self)]

    def __getitem__(self, key: Any) -> Any:
        if self.pairs and (isinstance(key, int | np.integer) or (isinstance(key, Quantity) and key.single)):
            found = self._first(key)
            if found is None:
                raise IndexError("list index out of range")
            return found
        whole = self.every and isinstance(self.parts, Quantity)  # several columns are told no more to be of one length
        if self.pairs and whole and isinstance(key, slice) and not has_quantity([key.start, key.stop, key.step]):
            return EachRow(self.parts[key], self.holds[key], every=True)
        if self.pairs and isinstance(key, slice) and key.step is None and _from_start(key.start, key.stop):
            so_far: Any = self._count.cumsum()
            holds = self.holds & (so_far > (key.start or 0))
            return EachRow(self.parts, holds if key.stop is None else holds & (so_far <= key.stop))
        self._look()
        return list.__getitem__(self, key)

    def _look(self) -> None:
        if self.pairs:
            rows = range(len(self.holds)) if self.every else np.flatnonzero(self.holds.seen())
            if not list.__len__(self):
                list.extend(self, [self.parts[int(k)] for k in rows])


def _of_some(holds: Quantity, keys: Quantity, row: Any) -> Quantity:
    """Numbers of the rows for which a condition holds, and for all others that of the ``row``."""
    return lift(keys.graph, where(keys.graph, holds, keys, keys[row]))


def _from_start(*ends: Any) -> bool:
    return all(end is None or (type(end) is int and end >= 0) for end in ends)


CALLS: dict[str, Any] = {
    "sums": sums, "zip": paired, "enumerate": numbered, "range": counted, "place": placed,
}  # fmt: skip
