"""What Python takes of those elements for which a condition holds: the first, the least, their sum, how many."""

import builtins
import operator
from collections.abc import Callable, Iterable
from functools import reduce
from itertools import islice
from types import FunctionType
from typing import Any

import numpy as np

from mechsheet.quantities.arithmetic import choice as where
from mechsheet.quantities.graph import NotRecorded, current
from mechsheet.quantities.quantity import Quantity, lift
from mechsheet.recording import choices
from mechsheet.recording.choices import UNBOUND, _missing, is_condition, part_of, way_may_change
from mechsheet.recording.each_row import EachRow, each_row, every_row
from mechsheet.recording.sifted import Sifted

_FURTHER = 200  # elements behind the first one that is kept now: an iterator may have no end
_Pair = tuple[Any, FunctionType]  # whether an element is kept, and what gives its value


def kept_rows(f: FunctionType, one_by_one: Callable[..., Iterable[_Pair]], *sources: Any) -> Iterable[_Pair] | EachRow:
    """The elements that are kept of the rows of a table, however many these are, else the pairs of all of them."""
    rows = each_row(f, _of_all, *sources)
    return one_by_one(*sources) if rows is None else rows


def of_kept(kind: str, pairs: Iterable[_Pair] | EachRow, *otherwise: Any) -> Any:
    """What ``min``, ``max``, ``sum``, ``len`` or ``next`` gives for the elements of the ``pairs`` that are kept."""
    if isinstance(pairs, EachRow):
        return pairs.of(kind, *otherwise)
    if kind != "first":
        return _of_all(kind, list(pairs), otherwise)
    source, met = iter(pairs), list[_Pair]()
    for holds, value in source:
        met.append((holds, value))
        if bool(holds.value) if is_condition(holds) else holds:
            break
    if not any(is_condition(holds) for holds, _ in met):
        return _plainly(kind, met, otherwise)
    further = [] if not is_condition(met[-1][0]) and met[-1][0] else [*islice(source, _FURTHER)]
    if len(further) == _FURTHER:  # what follows is not known
        return _of_all(kind, [*met, *further], otherwise, ends=False)
    return _of_all(kind, [*met, *further], otherwise)


def _of_all(kind: str, pairs: list[_Pair], otherwise: tuple[Any, ...], ends: bool = True) -> Any:
    if not any(is_condition(holds) for holds, _ in pairs):
        return _plainly(kind, pairs, otherwise)
    graph = current.get()
    looked, found = dict(graph.looked), None
    try:
        kept = [(holds, value()) for holds, value in _decided(pairs)]
        found = _KINDS[kind](kept, otherwise if ends else (UNBOUND,))
    except (Exception, NotRecorded):
        found = None
    if found is None or found is UNBOUND:
        graph.looked = looked
        return _plainly(kind, pairs, otherwise)
    return found


def sifted(pairs: Iterable[_Pair] | EachRow) -> list[Any]:
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
        return Sifted(every, _of_all)
    return [value for holds, value in every if holds]


def _decided(pairs: Iterable[_Pair]) -> Iterable[_Pair]:
    for holds, value in pairs:
        if is_condition(holds):
            if way_may_change(value):
                raise NotRecorded("what is kept changes something")
            yield holds, value
        elif holds:
            yield True, value


def _plainly(kind: str, pairs: Iterable[_Pair], otherwise: tuple[Any, ...]) -> Any:
    """What Python gives, who sees of each element whether it is kept."""
    values = (value() for holds, value in pairs if holds)
    match kind:
        case "first":
            return next(values, *otherwise)
        case "last":
            return list(values)[-1]
        case "len":
            return len(list(values))
        case "sum":
            return sum(values, *otherwise)
    kind, _, by = kind.partition(" ")
    named = {"key" if by else "default": otherwise[0]} if otherwise else {}
    return getattr(builtins, kind)(values, **named)


def _first(kept: Iterable[tuple[Any, Any]], otherwise: tuple[Any, ...]) -> Any:
    every = [*kept]
    none = not any(holds if holds is True else holds.value for holds, _ in every)
    if not otherwise and none and not current.get().supposed:
        return UNBOUND
    result = otherwise[0] if otherwise else _missing(every[-1][1])
    for holds, value in reversed(every):
        result = value if holds is True else part_of(holds, value, result)
        if result is None:
            return None
    return result


def _last(kept: Iterable[tuple[Any, Any]], otherwise: tuple[Any, ...]) -> Any:
    return _first(reversed([*kept]), otherwise)


def _least(fold: Callable[[Any, Any], Any]) -> Callable[..., Any]:
    def function(kept: Iterable[tuple[Any, Any]], otherwise: tuple[Any, ...]) -> Any:
        graph, some, result = current.get(), lift(current.get(), False), lift(current.get(), np.nan)
        for holds, value in kept:
            result = where(graph, holds, where(graph, some, fold(result, value), value), result)
            some = some | holds
        if otherwise:
            return where(graph, some, result, otherwise[0])
        return result if some.value or graph.supposed else None

    return function


def _least_by(wins: Callable[[Any, Any], Any]) -> Callable[..., Any]:
    """The first of those whose keys are the least or the greatest."""

    def function(kept: Iterable[tuple[Any, Any]], given: tuple[Any, ...]) -> Any:
        (key,), every = given, [*kept]
        some, best = lift(current.get(), False), lift(current.get(), 0.0)  # no NaN: a cell could not compare it
        result = _missing(every[0][1])
        for holds, value in every:
            own = key(value)
            taken = holds & (~some | wins(own, best))
            result, best = part_of(taken, value, result), where(current.get(), taken, own, best)
            some = some | holds
        return result if some.value or current.get().supposed else None

    return function


def _sum(kept: Iterable[tuple[Any, Any]], otherwise: tuple[Any, ...]) -> Any:
    graph = current.get()
    return reduce(operator.add, (where(graph, holds, value, 0) for holds, value in kept), *(otherwise or (0,)))


def _count(kept: Iterable[tuple[Any, Any]], _: tuple[Any, ...]) -> Any:
    return _sum(((holds, 1) for holds, _ in kept), ())


_KINDS: dict[str, Callable[..., Any]] = {
    "first": _first, "last": _last, "min": _least(np.minimum), "max": _least(np.maximum), "sum": _sum, "len": _count,
    "min by": _least_by(operator.lt), "max by": _least_by(operator.gt),
}  # fmt: skip


def _extreme(name: str) -> Callable[..., Any]:
    plainly = choices.CALLS[name]

    def function(*given: Any, **named: Any) -> Any:
        rows = every_row(given[0], _of_all) if len(given) == 1 and [*named] == ["key"] else None
        found = None if rows is None else rows.followed(f"{name} by", named["key"])
        return plainly(*given, **named) if found is None else found

    return function


def ranked(values: Iterable[Any], *, key: Any = None, reverse: Any = False) -> Any:
    """Python's sorted, of the rows of a table however many these are."""
    rows = None if isinstance(reverse, Quantity) else every_row(values, _of_all)
    found = None if rows is None else rows.in_order(key, bool(reverse))
    return choices.ranked(values, key=key, reverse=reverse) if found is None else found


CALLS: dict[str, Any] = {
    "of_kept": of_kept, "sifted": sifted, "kept_rows": kept_rows, "max": _extreme("max"), "min": _extreme("min"),
    "sorted": ranked,
}  # fmt: skip
