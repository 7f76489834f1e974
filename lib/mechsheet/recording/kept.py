"""What Python takes of those elements for which a condition holds: the first, the least, their sum, how many."""

from collections.abc import Callable, Iterable
from itertools import islice
from types import FunctionType
from typing import Any, TypeGuard

from mechsheet.quantities.graph import NotRecorded, current
from mechsheet.quantities.quantity import Quantity, has_quantity
from mechsheet.recording import each_row, ordered
from mechsheet.recording.among import Pair, of_all, plainly
from mechsheet.recording.choices import is_condition, way_may_change
from mechsheet.recording.each_row import EachRow, every_row
from mechsheet.recording.sifted import Sifted

_FURTHER = 200  # elements behind the first one that is kept now: an iterator may have no end


def kept_rows(f: FunctionType, one_by_one: Callable[..., Iterable[Pair]], *sources: Any) -> Iterable[Pair] | EachRow:
    """The elements that are kept of the rows of a table, however many these are, else the pairs of all of them."""
    if len(sources) == 1 and is_kept(sources[0]):
        return _of_those(sources[0], one_by_one)
    rows = each_row.each_row(f, *sources)
    return one_by_one(*sources) if rows is None else rows


def of_kept(kind: str, pairs: Iterable[Pair] | EachRow, *otherwise: Any) -> Any:
    """What ``min``, ``max``, ``sum``, ``len`` or ``next`` gives for the elements of the ``pairs`` that are kept."""
    if isinstance(pairs, EachRow):
        return pairs.of(kind, *otherwise)
    if kind != "first":
        return of_all(kind, list(pairs), otherwise)
    source, met = iter(pairs), list[Pair]()
    for holds, value in source:
        met.append((holds, value))
        if bool(holds.value) if is_condition(holds) else holds:
            break
    if not any(is_condition(holds) for holds, _ in met):
        return plainly(kind, met, otherwise)
    further = [] if not is_condition(met[-1][0]) and met[-1][0] else [*islice(source, _FURTHER)]
    if len(further) == _FURTHER:  # what follows is not known
        return of_all(kind, [*met, *further], otherwise, ends=False)
    return of_all(kind, [*met, *further], otherwise)


def sifted(pairs: Iterable[Pair] | EachRow) -> list[Any]:
    """A list of the elements that are kept; their values are those of now, whatever reads them later."""
    if isinstance(pairs, EachRow):
        return pairs
    graph, every, sure = current.get(), list[tuple[Any, Any]](), True
    for holds, value in pairs:
        if not is_condition(holds):
            if holds:
                every.append((True, value()))
            continue
        sure = sure and not way_may_change(value)
        if holds.value:
            every.append((holds if holds.dtype == bool else holds != 0, value()))
        elif sure:
            graph.supposed += 1
            try:
                every.append((holds if holds.dtype == bool else holds != 0, value()))
            except (Exception, NotRecorded):  # there is no such element
                sure = False
            finally:
                graph.supposed -= 1
        if not sure:
            bool(holds)
    if sure and len(every) <= _FURTHER and any(holds is not True for holds, _ in every):
        return Sifted(every, of_all)
    return [value for holds, value in every if holds]


def is_kept(items: Any) -> TypeGuard[Sifted]:
    """Whether a list of some elements of which each is kept by a condition."""
    return type(items) is Sifted and bool(items.pairs)


def _of_those(items: Sifted, one_by_one: Callable[..., Iterable[Pair]]) -> Iterable[Pair]:
    """The pairs of what is kept already: an element is kept where both conditions hold."""
    for holds, element in items.pairs:
        if not is_condition(holds):
            yield from one_by_one([element])
            continue
        graph = current.get()
        graph.supposed += not holds.value
        try:
            pairs = [*one_by_one([element])]
        except (Exception, NotRecorded):  # there is no such element
            bool(holds)
            pairs = []
        finally:
            graph.supposed -= not holds.value
        for own, value in pairs:
            yield (holds & (own if own.dtype == bool else own != 0) if is_condition(own) else own and holds), value


def listed(f: FunctionType, plainly: Callable[..., Any], *sources: Any) -> Any:
    """A list of what ``f`` gives for each row, of those that are kept too."""
    if len(sources) == 1 and is_kept(sources[0]):
        return sifted((holds, lambda element=element: f(element)) for holds, element in sources[0].pairs)
    return each_row.listed(f, plainly, *sources)


def of_rows(kind: str, f: FunctionType, plainly: Callable[..., Any], *sources: Any) -> Any:
    """What ``f`` gives for each row in all, for those that are kept too."""
    if len(sources) == 1 and is_kept(sources[0]) and kind in ("sum", "min", "max"):
        return of_all(kind, [(holds, lambda element=element: f(element)) for holds, element in sources[0].pairs], ())
    return each_row.of_rows(kind, f, plainly, *sources)


def _extreme(name: str) -> Callable[..., Any]:
    otherwise = ordered.CALLS[name]

    def function(*given: Any, **named: Any) -> Any:
        rows = every_row(given[0]) if len(given) == 1 and [*named] == ["key"] else None
        found = None if rows is None else rows.followed(f"{name} by", named["key"])
        return otherwise(*given, **named) if found is None else found

    return function


class Ranked(Sifted):
    """Elements in the order of their keys, of which the first and the last one hold for other inputs too."""

    def __init__(self, pairs: list[tuple[Any, Any]], key: Any, reverse: bool) -> None:
        super().__init__(pairs, of_all)
        self._key, self._reverse = key, reverse
        graph = current.get()
        looked = dict(graph.looked)
        list.sort(self, key=key, reverse=reverse)
        graph.looked = looked

    def __getitem__(self, place: Any) -> Any:
        if not self.pairs or type(place) is not int or place not in (0, -1):
            return super().__getitem__(place)
        kind = "min" if (place == 0) is not self._reverse else "max"
        pairs = self.pairs if place == 0 else self.pairs[::-1]  # of equal ones the last
        if any(holds is not True for holds, _ in pairs):
            return Sifted(pairs, of_all).of(f"{kind} by", self._key or (lambda value: value))
        return ordered.CALLS[kind]([value for _, value in pairs], key=self._key)

    def each(self) -> list[tuple[Any, Any]]:
        """None of which it is known at which place they are."""
        return []

    def _look(self) -> None:
        super()._look()
        if self.pairs:
            sorted(list.__iter__(self), key=self._key, reverse=self._reverse)


def ranked(values: Iterable[Any], *, key: Any = None, reverse: Any = False) -> Any:
    """Python's sorted, of the rows of a table however many these are."""
    rows = None if isinstance(reverse, Quantity) else every_row(values)
    found = None if rows is None else rows.in_order(key, bool(reverse))
    if found is not None:
        return found
    if isinstance(reverse, Quantity):
        return ordered.ranked(values, key=key, reverse=reverse)
    if is_kept(values):
        return Ranked(values.pairs, key, bool(reverse))
    each = list(values)
    if key is not None and len(each) > ordered.SORTED and not way_may_change(key) and has_quantity([*map(key, each)]):
        return Ranked([(True, value) for value in each], key, bool(reverse))
    return ordered.ranked(each, key=key, reverse=reverse)


CALLS: dict[str, Any] = {
    "of_kept": of_kept, "sifted": sifted, "kept_rows": kept_rows, "max": _extreme("max"), "min": _extreme("min"),
    "sorted": ranked, "is_kept": is_kept, "each_kept": Sifted.each, "listed": listed, "of_rows": of_rows,
}  # fmt: skip
