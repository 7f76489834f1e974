"""What is taken of elements of which each is kept by a condition: the first, the least, their sum, how many."""

import builtins
import operator
from collections.abc import Callable, Iterable
from functools import reduce
from typing import Any

import numpy as np

from mechsheet.quantities.arithmetic import choice as where
from mechsheet.quantities.graph import NotRecorded, current
from mechsheet.quantities.quantity import lift
from mechsheet.quantities.refused import refused
from mechsheet.recording.choices import UNBOUND, _missing, is_condition, merged, part_of, way_may_change

Pair = tuple[Any, Callable[..., Any]]  # whether an element is kept, and what gives its value


def of_all(kind: str, pairs: list[Pair], otherwise: tuple[Any, ...], ends: bool = True) -> Any:
    if not any(is_condition(holds) for holds, _ in pairs):
        return plainly(kind, pairs, otherwise)
    graph = current.get()
    looked, found = dict(graph.looked), None
    try:
        kept = [(holds, value()) for holds, value in _decided(pairs)]
        found = _KINDS[kind](kept, otherwise if ends else (UNBOUND,))
    except (Exception, NotRecorded):
        found = None
    if found is None or found is UNBOUND:
        graph.looked = looked
        return plainly(kind, pairs, otherwise)
    return found


def _decided(pairs: Iterable[Pair]) -> Iterable[Pair]:
    for holds, value in pairs:
        if is_condition(holds):
            if way_may_change(value):
                raise NotRecorded("what is kept changes something")
            yield holds, value
        elif holds:
            yield True, value


def plainly(kind: str, pairs: Iterable[Pair], otherwise: tuple[Any, ...]) -> Any:
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
    return result if otherwise else refused(result)


def _last(kept: Iterable[tuple[Any, Any]], otherwise: tuple[Any, ...]) -> Any:
    return _first(reversed([*kept]), otherwise)


def _least(fold: Callable[[Any, Any], Any]) -> Callable[..., Any]:
    def function(kept: Iterable[tuple[Any, Any]], otherwise: tuple[Any, ...]) -> Any:
        graph, some, result = current.get(), lift(current.get(), False), lift(current.get(), np.nan)
        for holds, value in kept:
            if isinstance(value, tuple | list):  # which are compared part by part
                return None
            result = where(graph, holds, where(graph, some, fold(result, value), value), result)
            some = some | holds
        if otherwise:
            return merged(some, result, otherwise[0])
        return refused(result) if some.value or graph.supposed else None

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
        return refused(result) if some.value or current.get().supposed else None

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
