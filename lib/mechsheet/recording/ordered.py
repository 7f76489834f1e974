"""What Python puts in order, of recorded quantities: the greater of some, where one stands, and all of them."""

import builtins
import operator
from collections.abc import Callable, Iterable
from functools import reduce
from typing import Any

import numpy as np

from mechsheet.quantities.arithmetic import choice as where
from mechsheet.quantities.graph import current
from mechsheet.quantities.quantity import Quantity, has_quantity, lift
from mechsheet.quantities.refused import refused
from mechsheet.recording.choices import NUMBERS, is_whole, merged, part_of
from mechsheet.recording.sifted import Sifted

SORTED = 10  # rows that are put in order: each may stand at each place


def _extreme(name: str) -> Callable[..., Any]:
    fold = {"max": np.maximum, "min": np.minimum}[name]

    def function(*args: Any, **kwargs: Any) -> Any:
        if len(args) == 1 and not kwargs and is_whole(args[0]):
            return args[0].reduced(name)
        if len(args) == 1 and len(kwargs) <= 1 and isinstance(args[0], Sifted) and args[0].pairs:
            return args[0].of(f"{name} by" if "key" in kwargs else name, *kwargs.values())
        values = list(args[0]) if len(args) == 1 and isinstance(args[0], Iterable) else list(args)
        key = kwargs.get("key") or (lambda value: value)
        keys = [key(value) for value in values]
        if not values or kwargs.keys() - {"key", "default"} or not has_quantity(keys):
            return getattr(builtins, name)(*args if len(args) > 1 else [values], **kwargs)
        if "key" not in kwargs and not any(isinstance(value, tuple | list) for value in values):
            return reduce(fold, values)
        result, best = values[0], keys[0]
        for value, own in zip(values[1:], keys[1:], strict=True):
            wins = _is_above(own, best) if name == "max" else _is_above(best, own)
            result, best = merged(wins, value, result), merged(wins, own, best)
            if result is None or best is None:
                return getattr(builtins, name)(values, **kwargs)
        return result

    return function


def _is_above(x: Any, y: Any) -> Any:
    """``x > y``, of rows of numbers by the first one that differs."""
    if not isinstance(x, tuple | list):
        return lift(current.get(), x) > y
    if not x:
        return lift(current.get(), False)
    first = lift(current.get(), x[0])
    return (first > y[0]) | ((first == y[0]) & _is_above(x[1:], y[1:]))


def placed(values: Any, value: Any) -> Any:
    """``values.index(value)``: the first place of a number in a list."""
    if not isinstance(values, list | tuple) or not has_quantity([values, value]):
        return values.index(str(value) if isinstance(values, str) else value)
    if not all(isinstance(v, NUMBERS) for v in (*values, value)):
        return values.index(value)
    hit = lift(current.get(), values) == value
    some = hit.reduced("any")
    if not some.value:
        raise ValueError("it is not in the list")
    place: Quantity = refused(where(current.get(), some, np.argmax(hit), np.nan))
    return place


def ranked(values: Iterable[Any], *, key: Any = None, reverse: Any = False) -> Any:
    """Python's sorted: numbers by their size, a few rows by numbers of theirs, all else as it is sorted now."""
    each = list(values)
    if key is None and has_quantity(each) and all(isinstance(v, NUMBERS) for v in each):
        found: Any = np.sort(lift(current.get(), each))
        return list(found)[::-1] if reverse else list(found)
    keys = [key(value) for value in each] if key is not None and 1 < len(each) <= SORTED else []
    follows = has_quantity(keys) and all(isinstance(k, NUMBERS) for k in keys) and not isinstance(reverse, Quantity)
    return (follows and _by_rank(each, keys, bool(reverse))) or sorted(each, key=key, reverse=reverse)


def _by_rank(each: list[Any], keys: list[Any], reverse: bool) -> list[Any] | None:
    """The rows in the order of their keys, those of equal ones as they stand; None of what is no row."""
    graph, later = current.get(), operator.gt if reverse else operator.lt
    own = [lift(graph, key) for key in keys]
    if not all(key.single and key.im is None for key in own):
        return None
    ranks = [
        sum(later(b, a) | (b == a) if n < k else later(b, a) for n, b in enumerate(own) if n != k)
        for k, a in enumerate(own)
    ]
    finite: Any = np.isfinite(lift(graph, own))
    if not (exist := finite.reduced("all")).value:
        return None
    result = list[Any]()
    for place in range(len(each)):
        (now,) = (row for row, rank in zip(each, ranks, strict=True) if rank.value == place)
        for row, rank in zip(each, ranks, strict=True):
            now = now if now is None else part_of(rank == place, row, now)
        result.append(now)
    if any(row is None for row in result):
        return None
    if exist.re not in graph.fixed and any(key.re not in graph.always for key in own):
        bool(exist)  # of what is no number nobody knows the order
    return result


CALLS: dict[str, Any] = {"max": _extreme("max"), "min": _extreme("min"), "sorted": ranked, "place": placed}
