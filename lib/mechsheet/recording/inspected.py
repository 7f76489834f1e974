"""What code asks of the type of a value: told of the number, array or text that the worksheet has in its place."""

import ast
import dataclasses
import sys
from collections.abc import Callable
from copy import copy
from typing import Any

import numpy as np

from mechsheet.quantities.arithmetic import is_count
from mechsheet.quantities.graph import Graph, NotRecorded
from mechsheet.quantities.options import Thing, every
from mechsheet.quantities.perhaps import Row, settled
from mechsheet.quantities.quantity import FUNCTIONS, Quantity, has_quantity
from mechsheet.quantities.refused import is_pythons, of_library
from mechsheet.quantities.text_column import Texts
from mechsheet.quantities.written import Written
from mechsheet.worksheet.chosen import Chosen, first

_TYPES = {"bool", "complex", "float", "int", "str", "np.ndarray"}  # which a pattern may name


def _told(ask: Callable[..., Any], x: Any, *of: Any) -> Any:
    """What is asked of a value; not of a number that is Python's own or one of numpy's, where these differ in it."""
    several = every(settled(x))
    first, *others = (ask(each, *of) for one in several for each in _alike(one))
    if any(answer != first for answer in others):
        which = (
            "one of several of other kinds" if len(several) > 1 else "a number that is Python's own or one of numpy's"
        )
        raise NotRecorded(f"{ask.__name__} of {which}")
    return first


def _alike(x: Any) -> tuple[Any, ...]:
    """Values of each type that the worksheet's own may have."""
    if isinstance(x, Chosen):
        return (first(x),)
    if isinstance(x, Written | Texts):
        return ("" if isinstance(x, Written) else np.array([""]),)
    if not isinstance(x, Quantity):
        return (x,)
    if x.ndim:
        return (np.zeros((1,) * x.ndim, x.dtype),)
    kind = x.dtype.kind
    own = True if kind == "b" else 1j if kind == "c" else 1 if is_count(x) else 1.0
    if all(is_pythons(x.graph, part) for part in x.parts):
        return (own,)
    arrays = (np.array(own),) if any(part.op == "where" for part in x.parts) else ()
    return own, np.array(own)[()], *arrays


def _kind(*given: Any) -> Any:
    if len(given) > 1 or of_library(sys._getframe(1)):
        return type(*given)
    return _told(type, *given)


def matching(node: ast.Match) -> str:
    """The name of the call for what a statement compares with its patterns."""
    parts = [part for case in node.cases for part in ast.walk(case.pattern)]
    by_type = any(isinstance(part, ast.MatchClass) and ast.unparse(part.cls) in _TYPES for part in parts)
    return "matched by type" if by_type else "matched"


def _matched(value: Any) -> Any:
    """A value of which patterns such as ``float()`` tell the type."""
    if has_quantity(value) or isinstance(value, Written | Chosen):
        raise NotRecorded("a pattern that tells the type of a number or a text")
    return value


def _of_numpy(ask: Callable[..., Any]) -> Callable[..., Any]:
    def rule(_: Graph, x: Any) -> Any:
        return _told(ask, x)

    return rule


def _of_object(f: Callable[..., Any]) -> Callable[..., Any]:
    """A function that looks at an object's class, for one of several objects too: of an object with the parts of it."""
    return lambda one, *given, **named: f(copy(one) if isinstance(one, Thing | Row) else one, *given, **named)


OF_OBJECTS = {f: _of_object(f) for f in (dataclasses.replace, dataclasses.asdict, dataclasses.astuple)}
FUNCTIONS |= {ask: _of_numpy(ask) for ask in (np.isscalar, np.iterable)}
ASKING = {ask.__name__: lambda x, *of, _ask=ask: _told(_ask, x, *of) for ask in (isinstance, hasattr, callable)}
CALLS: dict[str, Any] = {"type": _kind, "matched by type": _matched}
