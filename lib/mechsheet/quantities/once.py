"""Functions of the mechanics, recorded once for the same quantities: a document's chain asks for them many times."""

from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from copy import copy
from dataclasses import fields, is_dataclass
from typing import Any

from mechsheet.quantities import perhaps
from mechsheet.quantities.graph import Graph
from mechsheet.quantities.quantity import Quantity

_PLAIN = (bool, int, float, complex, str)


def once(graph: Graph, f: Callable[..., Any], args: Sequence[Any], kwargs: Mapping[str, Any]) -> Any:
    """What ``f`` gives; what Python sees of quantities in it is noted at each call."""
    try:
        key = f, *map(_known, args), *((name, _known(value)) for name, value in kwargs.items())
    except _New:
        return f(*args, **kwargs)
    if key not in graph.called:
        looked, numbered = graph.looked, graph.numbered
        graph.looked, graph.numbered = {}, {}
        try:
            given = f(*args, **kwargs)
        finally:
            seen, graph.looked, graph.numbered = (graph.looked, graph.numbered), looked, numbered
            _note(graph, *seen)
        with suppress(_New):
            graph.called[key] = _copied(given), *seen
        return given
    given, looked, numbered = graph.called[key]
    _note(graph, looked, numbered)
    return _copied(given)


class _New(Exception):
    """What nobody knows again, or cannot be copied."""


def _note(graph: Graph, looked: Mapping[Any, Any], numbered: Mapping[Any, Any]) -> None:
    for kept, seen in ((graph.looked, looked), (graph.numbered, numbered)):
        for holds, guard in seen.items():
            kept.setdefault(holds, guard._replace(line=graph.line))


def _known(value: Any) -> Any:
    if isinstance(value, Quantity) and not isinstance(value, perhaps.Number):
        return Quantity, value.re, value.im
    if isinstance(value, _PLAIN):
        return type(value), repr(value)  # tells -0.0 from 0.0
    raise _New


def _copied(given: Any) -> Any:
    """The same quantities in objects of their own, in which a worksheet may put others."""
    if isinstance(given, _PLAIN):
        return given
    if isinstance(given, Quantity) and not isinstance(given, perhaps.Number):
        copied = Quantity(given.graph, given.re, given.im)
        copied.base = given.base
        return copied
    if isinstance(given, tuple) and hasattr(given, "_fields"):
        return type(given)(*map(_copied, given))
    if is_dataclass(given) and not isinstance(given, type):
        group = copy(given)
        for field in fields(given):
            object.__setattr__(group, field.name, _copied(getattr(given, field.name)))
        return group
    raise _New
