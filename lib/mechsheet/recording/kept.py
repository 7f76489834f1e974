"""What Python takes of those elements for which a condition holds: the first, the least, their sum, how many."""

from collections.abc import Callable, Iterable
from itertools import islice
from types import FunctionType
from typing import Any

from mechsheet.quantities.graph import NotRecorded, current
from mechsheet.quantities.quantity import Quantity
from mechsheet.recording import ordered
from mechsheet.recording.among import Pair, of_all, plainly
from mechsheet.recording.choices import is_condition, way_may_change
from mechsheet.recording.each_row import EachRow, each_row, every_row
from mechsheet.recording.sifted import Sifted

_FURTHER = 200  # elements behind the first one that is kept now: an iterator may have no end


def kept_rows(f: FunctionType, one_by_one: Callable[..., Iterable[Pair]], *sources: Any) -> Iterable[Pair] | EachRow:
    """The elements that are kept of the rows of a table, however many these are, else the pairs of all of them."""
    rows = each_row(f, *sources)
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


def _extreme(name: str) -> Callable[..., Any]:
    otherwise = ordered.CALLS[name]

    def function(*given: Any, **named: Any) -> Any:
        rows = every_row(given[0]) if len(given) == 1 and [*named] == ["key"] else None
        found = None if rows is None else rows.followed(f"{name} by", named["key"])
        return otherwise(*given, **named) if found is None else found

    return function


def ranked(values: Iterable[Any], *, key: Any = None, reverse: Any = False) -> Any:
    """Python's sorted, of the rows of a table however many these are."""
    rows = None if isinstance(reverse, Quantity) else every_row(values)
    found = None if rows is None else rows.in_order(key, bool(reverse))
    return ordered.ranked(values, key=key, reverse=reverse) if found is None else found


CALLS: dict[str, Any] = {
    "of_kept": of_kept, "sifted": sifted, "kept_rows": kept_rows, "max": _extreme("max"), "min": _extreme("min"),
    "sorted": ranked,
}  # fmt: skip
