"""What the shared names of a worksheet mean while it is recorded: functions that take quantities, in their own names.

Functions of the mechanics are recorded by running themselves: their own code, in which numpy takes quantities. Those
for which `elementary` has a shorter form are recorded by that one; tests compare it with what it stands for.
Nothing of the running program is exchanged: pages that are served at the same time are threads of one process.
"""

import builtins
import math
import sys
from collections.abc import Callable, Mapping
from contextvars import ContextVar
from functools import cache
from inspect import unwrap
from types import BuiltinFunctionType, FunctionType, GenericAlias
from typing import Any

import numpy as np

from mechsheet import units
from mechsheet.recording.graph import Graph, NotRecorded
from mechsheet.recording.numpy_rules import arange, linspace, trapezoid_so_far
from mechsheet.recording.quantity import FUNCTIONS, Quantity, has_quantity, lift, plain
from mechsheet.recording.rewritten import NAMES, rebuilt

current: ContextVar[Graph] = ContextVar("current")  # the graph of the recording that is made here

_ROOMS = ("mechsheet.mechanics.", "mechsheet.worksheet.force_diagram")
_WRITTEN = {"__post_init__"}  # the only special method of a group that is not made by `dataclass`
_ARRAYS = (np.array, np.asarray, np.asanyarray, np.ascontiguousarray)


def shared(common: Mapping[str, Any]) -> dict[str, Any]:
    """The shared names of a worksheet, with what takes recorded quantities in place of what does not."""
    own: dict[str, Any] = {**NAMES}
    for name, value in common.items():
        of_sheet = isinstance(value, FunctionType) and value.__globals__ is common
        own[name] = rebuilt(value, own) if of_sheet else instead(value)
    return own


_SAME = (
    "sqrt", "exp", "log", "log10", "log2", "log1p", "expm1", "sin", "cos", "tan", "sinh", "cosh", "tanh", "hypot",
    "degrees", "radians", "floor", "ceil", "trunc", "copysign", "isnan", "isfinite", "isinf", "fmod", "cbrt",
    "isclose", "prod",
)  # fmt: skip
_OTHER = {"asin": "arcsin", "acos": "arccos", "atan": "arctan", "atan2": "arctan2", "asinh": "arcsinh"}
_OTHER |= {"acosh": "arccosh", "atanh": "arctanh", "fabs": "abs", "pow": "power", "fsum": "sum"}
_MATH = {getattr(math, name): getattr(np, _OTHER.get(name, name)) for name in [*_SAME, *_OTHER]}


def instead(value: Any) -> Any:
    """What takes quantities in place of a function, class or module; anything else is itself."""
    if value is np or value is math or value is units:
        return _module(value)
    if isinstance(value, units.Constant):
        return lift(current.get(), value)
    if value is units.celsius:
        return lambda degrees: (degrees + units.celsius(0)) * lift(current.get(), units.constant("K"))
    if isinstance(value, BuiltinFunctionType) and value in _MATH:
        return _takes(_MATH[value])
    if isinstance(value, np.ufunc) or (callable(value) and _of_numpy(value)):
        return _takes(value)
    if isinstance(value, FunctionType) and value.__module__.startswith(_ROOMS):
        return _of_mechanics(value)
    if isinstance(value, type) and value.__module__.startswith(_ROOMS) and hasattr(value, "__dataclass_fields__"):
        return _group(value)
    if callable(value) and str(getattr(value, "__module__", "")).startswith("mechsheet.studies."):
        return _refused(value.__name__)
    if callable(value) and getattr(value, "__name__", "") == "cumulative_trapezoid":
        return lambda y, *args, **rest: trapezoid_so_far(current.get(), y, *args, **rest)
    return value


def _refused(name: str) -> Callable[..., Any]:
    def function(*_: Any, **__: Any) -> Any:
        raise NotRecorded(f"{name} computes worksheets many times")

    return function


def _of_numpy(value: Any) -> bool:
    of_numpy = (getattr(value, "__module__", None) or "").partition(".")[0] == "numpy"
    return of_numpy and not isinstance(value, type | GenericAlias)


class _Module:
    """numpy or math, whose functions take recorded quantities, or the units, which are such."""

    def __init__(self, module: Any) -> None:
        self._module = module

    def __getattr__(self, name: str) -> Any:
        value = getattr(self._module, name)
        if getattr(value, "__name__", "") == "numpy.linalg":
            return _module(value)
        return instead(value)


_module = cache(_Module)


@cache
def _takes(f: Callable[..., Any]) -> Callable[..., Any]:
    """Function of numpy that also takes lists of recorded quantities."""

    def function(*args: Any, **kwargs: Any) -> Any:
        if f is np.arange and not kwargs:
            return arange(current.get(), *args)
        if f is np.linspace and not kwargs.keys() - {"endpoint", "num"}:
            return linspace(current.get(), *args, **{"count" if k == "num" else k: v for k, v in kwargs.items()})
        if not has_quantity([*args, *kwargs.values()]):
            return f(*args, **kwargs)
        if f in _ARRAYS:
            return lift(current.get(), args[0])
        if f in (np.zeros, np.ones, np.empty, np.full):
            shape, *rest = args
            shape = plain(shape)
            if not has_quantity(rest):
                return f(shape, *rest, **kwargs)
            return lift(current.get(), rest[0]).broadcast(np.broadcast_shapes(shape))
        if f is np.frexp:  # a scale to divide by and to multiply with again: any will do
            return args[0], 0
        if isinstance(f, np.ufunc):
            return f(*(lift(current.get(), a) for a in args), **kwargs)
        return FUNCTIONS[f](current.get(), *args, **kwargs) if f in FUNCTIONS else f(*args, **kwargs)

    for name in ("reduce", "accumulate"):
        if isinstance(f, np.ufunc):
            setattr(function, name, getattr(f, name))
    return function


# --- functions of the mechanics ----------------------------------------------------------------------------------


@cache
def _short() -> Mapping[Any, Callable[..., Any]]:
    from mechsheet.recording.elementary import STEPS  # on use: needs all of the mechanics

    return STEPS


@cache
def body(f: Any) -> Callable[..., Any]:
    """A function of the mechanics whose own code takes recorded quantities."""
    raw = unwrap(f)
    return rebuilt(raw, _space(raw.__module__))


@cache
def _of_mechanics(f: Any) -> Callable[..., Any]:
    own = _short().get(f) or body(f)

    def function(*args: Any, **kwargs: Any) -> Any:
        return own(*args, **kwargs) if any_quantity((args, kwargs)) else f(*args, **kwargs)

    return function


@cache
def _space(module: str) -> dict[str, Any]:
    """The names of a module of the mechanics, with what takes quantities."""
    names: dict[str, Any] = {"__builtins__": builtins, **NAMES}
    for name, value in vars(sys.modules[module]).items():
        if not name.startswith("__"):
            late = isinstance(value, FunctionType) and value.__module__.startswith(_ROOMS)
            names[name] = _Late(value) if late else value if isinstance(value, type) else instead(value)
    return names


class _Late:
    """A function of the mechanics, exchanged when it is called: the functions of a module need each other."""

    def __init__(self, value: Any) -> None:
        self.value = value

    def __call__(self, *args: Any, **kwargs: Any) -> Any:
        return instead(self.value)(*args, **kwargs)


@cache
def _group(kind: type) -> type:
    """A group of the mechanics whose methods call what takes recorded quantities."""
    names = _space(kind.__module__)

    def own(method: Any) -> Any:
        if isinstance(method, property):
            return property(own(method.fget))
        return rebuilt(method, names)

    written = {name: value for name, value in vars(kind).items() if not name.startswith("__") or name in _WRITTEN}
    methods = {name: own(value) for name, value in written.items() if isinstance(value, FunctionType | property)}
    return type(kind.__name__, (kind,), methods)


def any_quantity(value: Any) -> bool:
    """Whether there is a quantity somewhere in a value."""
    if isinstance(value, Quantity):
        return True
    if isinstance(value, dict):
        return any(any_quantity(v) for v in value.values())
    if isinstance(value, list | tuple):
        return any(any_quantity(v) for v in value)
    return hasattr(value, "__dataclass_fields__") and any(any_quantity(v) for v in vars(value).values())
