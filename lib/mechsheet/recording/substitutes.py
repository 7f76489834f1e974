"""The shared names of a worksheet while it is recorded: functions of numpy and of the library that take quantities."""

import sys
from collections.abc import Callable, Mapping
from functools import cache
from types import FunctionType
from typing import Any

import numpy as np

from mechsheet.recording.graph import Graph
from mechsheet.recording.numpy_rules import takes
from mechsheet.recording.quantity import Quantity

_WRITTEN = {"__post_init__"}  # the only special method of a group that is not made by `dataclass`


def substituted(common: Mapping[str, Any], graph: Graph) -> dict[str, Any]:
    """Shared names with the library's and numpy's functions exchanged for those that take recorded quantities."""
    steps = _steps()

    def instead(value: Any) -> Any:
        original = getattr(value, "__recorded__", value)
        if value is np or isinstance(value, _Numpy):
            return _Numpy(graph)
        if isinstance(original, np.ufunc) or (callable(original) and _of_numpy(original)):
            function = takes(original, graph)
            function.__recorded__ = original  # type: ignore[attr-defined]
            return function
        if callable(original) and original in steps:
            function = _either(original, steps[original])
            function.__recorded__ = original  # type: ignore[attr-defined]
            return function
        if isinstance(original, type) and original in _groups():
            return _group(original, instead)
        return value

    for name, value in common.items():
        if not name.startswith("__"):
            common[name] = instead(value)  # type: ignore[index]
    return {**common, "float": lambda x: x if isinstance(x, Quantity) else float(x)}


def _of_numpy(value: Any) -> bool:
    return (getattr(value, "__module__", None) or "").partition(".")[0] == "numpy" and not isinstance(value, type)


@cache
def _steps() -> Mapping[Any, Callable[..., Any]]:
    from mechsheet.recording.elementary import STEPS  # imported on use: needs all of the mechanics

    return STEPS


@cache
def _groups() -> frozenset[type]:
    from mechsheet.recording.elementary import GROUPS  # as above

    return GROUPS


def _group(kind: type, instead: Callable[[Any], Any]) -> type:
    """A group of the mechanics whose methods call what takes recorded quantities."""
    module = vars(sys.modules[kind.__module__])
    names = {name: value if isinstance(value, type) else instead(value) for name, value in module.items()}

    def own(method: Any) -> Any:
        if isinstance(method, property):
            return property(own(method.fget))
        return FunctionType(method.__code__, names, method.__name__, method.__defaults__, method.__closure__)

    written = {name: value for name, value in vars(kind).items() if not name.startswith("__") or name in _WRITTEN}
    methods = {name: own(value) for name, value in written.items() if isinstance(value, FunctionType | property)}
    return type(kind.__name__, (kind,), {**methods, "__recorded__": kind})


def _either(original: Callable[..., Any], steps: Callable[..., Any]) -> Callable[..., Any]:
    known: dict[Any, Any] = {}

    def function(*args: Any, **kwargs: Any) -> Any:
        if not _any_quantity((args, kwargs)):
            return original(*args, **kwargs)
        if kwargs or any(isinstance(a, list | tuple | np.ndarray) for a in args):
            return steps(*args, **kwargs)
        key = tuple((a.re, a.im) if isinstance(a, Quantity) else a for a in args)
        if key not in known:
            known[key] = steps(*args)
        return known[key]

    return function


def _any_quantity(value: Any) -> bool:
    if isinstance(value, Quantity):
        return True
    if isinstance(value, dict):
        return any(_any_quantity(v) for v in value.values())
    if isinstance(value, list | tuple):
        return any(_any_quantity(v) for v in value)
    return hasattr(value, "__dataclass_fields__") and any(_any_quantity(v) for v in vars(value).values())


class _Numpy:
    """numpy, whose functions also take lists of recorded quantities."""

    def __init__(self, graph: Graph) -> None:
        self._graph = graph

    def __getattr__(self, name: str) -> Any:
        value = getattr(np, name)
        return takes(value, self._graph) if callable(value) and not isinstance(value, type) else value
