"""What the shared names of a worksheet mean while it is recorded: functions that take quantities, in their own names.

Functions of the mechanics are recorded by running themselves: their own code, in which numpy takes quantities. Those
for which `elementary` has a shorter form are recorded by that one; tests compare it with what it stands for.
Nothing of the running program is exchanged: pages that are served at the same time are threads of one process.
"""

import builtins
import sys
from collections import Counter, OrderedDict, defaultdict, deque
from collections.abc import Callable, Mapping
from contextvars import ContextVar
from copy import copy
from functools import _lru_cache_wrapper, cache, lru_cache, partial
from inspect import unwrap
from types import BuiltinFunctionType, FunctionType, GeneratorType, GenericAlias, ModuleType, SimpleNamespace
from typing import Any

import numpy as np

from mechsheet import units
from mechsheet.quantities import linear_rules
from mechsheet.quantities.elementary import in_steps
from mechsheet.quantities.graph import NotRecorded, current
from mechsheet.quantities.node import Node
from mechsheet.quantities.numpy_rules import arange, filled, linspace, simpson, trapezoid_so_far
from mechsheet.quantities.once import once
from mechsheet.quantities.polynomial_rules import polynomial
from mechsheet.quantities.put_together import PutTogether
from mechsheet.quantities.quantity import FUNCTIONS, Quantity, has_quantity, lift, quantities
from mechsheet.quantities.refused import compared, of_library, of_numpy, of_python
from mechsheet.quantities.sketch import Sketch, drawing
from mechsheet.quantities.text_column import chosen_among
from mechsheet.quantities.unrepeatable import instead_of_chance
from mechsheet.quantities.written import looked_at, seen
from mechsheet.recording import exactly, scipy_rules, spline_rules
from mechsheet.recording.choices import total
from mechsheet.recording.conditions import every, some
from mechsheet.recording.inspected import ASKING, OF_OBJECTS
from mechsheet.recording.math_rules import MATH, STATISTICS
from mechsheet.recording.own_modules import followed, is_own
from mechsheet.recording.per_row import of_rows
from mechsheet.recording.rewritten import NAMES, rebuilt
from mechsheet.recording.unspoken import opened, unsaid, unspoken
from mechsheet.worksheet import check, find, system, title
from mechsheet.worksheet.drawing import Drawing
from mechsheet.worksheet.marimo_on_use import Marimo

_STATING = check.__name__, "mechsheet.worksheet.balance"  # modules whose texts are looked at where they are used
_ASKING = *_STATING, find.__name__, system.__name__  # modules that hand on what they are given, to be shown
_ROOMS = ("mechsheet.mechanics.", "mechsheet.worksheet.force_diagram")
_WRITTEN = {"__post_init__"}  # the only special method of a group that is not made by `dataclass`
_GONE_THROUGH = (GeneratorType, map, filter)  # once, to whoever asks
_CHOOSING = (np.where, np.select)  # among numbers which all are computed before
_HOLDING = (list, dict, set, deque, defaultdict, OrderedDict, Counter, SimpleNamespace)
_ARRAYS = (np.array, np.asarray, np.asanyarray, np.ascontiguousarray, np.fromiter)


staged: ContextVar[Mapping[str, Any]] = ContextVar("staged")  # what those of `SHOWING` do in the cell that is run
SHOWING = frozenset({"table", "figure", "sought", "solve", "closed_form", "check_slope", "judged", "Check", "meanings"})
_NAME, _WORDS = (0, "name"), (1, "title", "note")  # of a check, a table or a figure, which may follow
_UNSAID = {  # names of no number
    "table": (*_WORDS, "show"), "figure": (*_WORDS, "show"), "judged": (*_NAME, 3, "unit"), "check_slope": _NAME,
    "Check": (*_NAME, 3, 4, "unit", "reason"),
}  # fmt: skip
_NOWHERE = frozenset({"require", "refuse", "summary", "export", "typeset"})  # of no use in a workbook


def shared(common: Mapping[str, Any]) -> dict[str, Any]:
    """The shared names of a worksheet, with what takes recorded quantities in place of what does not."""
    own: dict[str, Any] = {**_NAMES, "__builtins__": BUILTINS}
    copies = dict[int, Any]()

    def copied(value: Any) -> Any:
        """What holds others for a recording alone, which may put quantities into it; anything else is itself."""
        if type(value) not in _HOLDING:
            return value
        if id(value) not in copies:
            copies[id(value)] = new = copy(value)
            held: Any = vars(new) if isinstance(new, SimpleNamespace) else new
            for key in held if isinstance(held, dict) else range(0 if isinstance(held, set) else len(held)):
                held[key] = copied(held[key])
        return copies[id(value)]

    def meant(value: Any) -> Any:
        match value:
            case _lru_cache_wrapper() if isinstance(value.__wrapped__, FunctionType):
                return meant(value.__wrapped__)  # it would give one recording what it kept of another
            case FunctionType() if value.__globals__ is common:
                return rebuilt(value, own, current.get().unmoved is not None)
            case dict() if type(value) is dict and any(map(callable, value.values())):
                return {key: meant(each) for key, each in value.items()}
            case list() if type(value) is list and any(map(callable, value)):
                return list(map(meant, value))
        return instead(value) if copied(value) is value else copied(value)

    own |= {name: meant(value) for name, value in common.items() if name != "__builtins__"}
    return own


def instead(value: Any) -> Any:
    """What takes quantities in place of a function, class or module; anything else is itself."""
    if isinstance(value, Marimo) or value is sys.modules.get("marimo"):
        return _PAGE
    if isinstance(value, ModuleType):
        return _module(value)
    if value is cache or value is lru_cache:
        return _caching
    if isinstance(value, units.Constant):
        return lift(current.get(), value)
    if value is units.celsius:
        return lambda degrees: (degrees + units.celsius(0)) * lift(current.get(), units.constant("K"))
    if (refusing := instead_of_chance(value)) is not None:
        return refusing
    if isinstance(value, BuiltinFunctionType) and value in MATH:
        return _takes(MATH[value], value)
    if str(getattr(value, "__module__", "")).startswith("numpy.polynomial"):
        from mechsheet.quantities import lowest_first  # on use: numpy loads these on use too

        if (powers := lowest_first.instead(value)) is not value:
            return powers
    if isinstance(value, np.ufunc) or (callable(value) and _of_numpy(value)):
        return _takes(value)
    if value is np.vectorize:
        return _each
    if value is np.poly1d:
        return polynomial
    if value is np.r_ or value is np.c_:
        return PutTogether(value)
    if value is Drawing:
        return drawing
    if isinstance(value, Drawing) and current.get().refuses:
        return Sketch.of(value)
    if isinstance(value, FunctionType) and value in OF_OBJECTS:
        return OF_OBJECTS[value]
    room = str(getattr(value, "__module__", ""))
    if (quiet := unspoken(value, room)) is not None:
        return quiet
    if isinstance(value, FunctionType | type) and room.startswith("mechsheet."):
        return _of_package(value, room)
    if room == "statistics" and value.__name__ in STATISTICS:
        function, options = STATISTICS[value.__name__]
        return partial(_takes(function), **options)
    if spline_rules.is_spline(value):
        return spline_rules.spline(value)
    if scipy_rules.is_table(value):
        return scipy_rules.table(value)
    if isinstance(value, FunctionType) and room.startswith("scipy."):
        return scipy_rules.solved(value, _on_stage("rooted"), _integrated) or _of_scipy(value)
    if isinstance(value, _lru_cache_wrapper) and not room.startswith("mechsheet."):
        return instead(value.__wrapped__)
    if is_own(value):
        return followed(value, shared)
    if (
        current.get().unmoved is not None
        and isinstance(value, BuiltinFunctionType | FunctionType)
        and room != "builtins"
    ):
        return value if room.startswith("mechsheet.") else exactly.of_others(value)
    return value


def _each(f: Any = None, *given: Any, **named: Any) -> Any:
    """numpy's vectorize: a function of numbers for arrays of them, one by one."""
    if given[1:] or named.keys() - {"otypes", "doc", "cache"}:
        raise NotRecorded("numpy's vectorize but of whole numbers of one argument each")
    if f is None:
        return _each

    def function(*args: Any) -> Any:
        graph = current.get()
        values = [lift(graph, x) for x in args]
        shape = np.broadcast_shapes(*(x.extent for x in values))
        if not shape:
            return instead(f)(*values)
        flat = [x.like(*values).ravel() for x in values]

        def one_by_one(*_: Any) -> Any:
            return lift(graph, [instead(f)(*each) for each in zip(*flat, strict=True)]).reshape(shape)

        return of_rows("array", instead(f), one_by_one, *flat) if len(shape) == 1 else one_by_one()

    return function


_PRINTING = frozenset({"leastsq", "curve_fit"})  # what a function of the worksheet raises in them


@cache
def _of_scipy(f: Callable[..., Any]) -> Callable[..., Any]:
    """A function of scipy, by the rule of its own or of numpy's of the same name."""
    rules: dict[str, Callable[..., Any]] = {
        "cumulative_trapezoid": trapezoid_so_far, "simpson": simpson, "trapezoid": FUNCTIONS[np.trapezoid],
        "eigh": linear_rules.eigen_over, "eigvalsh": linear_rules.eigenvalues_over, "block_diag": linear_rules.blocks,
        "cholesky": lambda graph, A, lower=False: linear_rules.cholesky(graph, A, upper=not lower),
    }  # fmt: skip
    alike = getattr(np.linalg, f.__name__, None) if f.__module__.startswith("scipy.linalg.") else None
    rule = rules.get(f.__name__) or FUNCTIONS.get(alike)

    def function(*args: Any, **kwargs: Any) -> Any:
        if f.__name__ in _PRINTING and args and isinstance(args[0], FunctionType):
            raise NotRecorded(f"scipy's {f.__name__}")
        if not has_quantity([*args, *kwargs.values()]):
            try:
                return exactly.computed(f, function, args, kwargs)
            except Exception as error:  # of a function of the worksheet, which may give quantities
                raise NotRecorded(f"scipy's {f.__name__}") from error
        if rule is None:
            raise NotRecorded(f"scipy's {f.__name__}")
        return rule(current.get(), *args, **kwargs)

    return function


def _of_package(value: Any, room: str) -> Any:
    """A function or class of this package."""
    if value.__name__ in SHOWING and room.startswith("mechsheet.worksheet."):
        return _on_stage(value.__name__)
    if value is check.require and current.get().bodies:
        return _requires
    if value.__name__ in _NOWHERE:
        return _NOTHING
    if value is title.slider:
        return _laid_out
    if isinstance(value, type):
        return _group(value) if room.startswith(_ROOMS) and hasattr(value, "__dataclass_fields__") else value
    if room.startswith((*_ROOMS, *_ASKING)):
        return _itself(value)
    return _refused(value.__name__) if room.startswith("mechsheet.studies.") else value


def _caching(f: Any = None, *_: Any, **__: Any) -> Any:
    """In place of what lets a function keep its values: the function itself."""
    return f if callable(f) else _caching


def _laid_out(start: Any, stop: Any, *args: Any, **kwargs: Any) -> Any:
    """A slider where the worksheet has it: what of it rests on inputs is what it is now, its end where none follows."""
    end = stop if current.get().draws else seen(stop)
    return title.slider(seen(start), end, *map(seen, args), **{key: seen(value) for key, value in kwargs.items()})


def _requires(point: Any, *_: Any) -> None:
    """What `require` does where the group closes somewhere; otherwise it is the worksheet that refuses."""
    if np.isnan(lift(current.get(), point)).all():
        raise NotRecorded("the cell stops here")


def _integrated(whole: Node, error: Node | None) -> None:
    staged.get()["integrated"](whole, error)


@cache
def _on_stage(name: str) -> Callable[..., Any]:
    def function(*args: Any, **kwargs: Any) -> Any:
        if current.get().supposed:
            raise NotRecorded("it is shown on a way that is not taken")
        beside = (*_UNSAID.get(name, ()), *(range(2, len(args)) if name == "table" else ()))  # columns of texts follow
        kwargs = {key: value if key in beside else looked_at(value) for key, value in kwargs.items()}
        return staged.get()[name](*(x if n in beside else looked_at(x) for n, x in enumerate(args)), **kwargs)

    return function


def _refused(name: str) -> Callable[..., Any]:
    def function(*_: Any, **__: Any) -> Any:
        raise NotRecorded(f"{name} computes worksheets many times")

    return function


def _of_numpy(value: Any) -> bool:
    of_numpy = (getattr(value, "__module__", None) or "").partition(".")[0] == "numpy"
    return of_numpy and not isinstance(value, type | GenericAlias)


class Module:
    """A module whose functions take recorded quantities; the units are such."""

    def __init__(self, module: Any) -> None:
        self._module = module

    def __getattr__(self, name: str) -> Any:
        return instead(getattr(self._module, name))


_module = cache(Module)


def _imported(name: str, *args: Any, **kwargs: Any) -> Any:
    return instead(__import__(name, *args, **kwargs))


def _in_memory(*_: Any) -> None:
    """In place of `memoryview`, through which an array is changed that knows nothing of it."""
    raise NotRecorded("a view of memory")


# An import inside a cell is one of what takes quantities too.
BUILTINS = {
    **vars(builtins),
    **ASKING,
    "__import__": _imported,
    "sum": total,
    "any": some,
    "all": every,
    "print": unsaid,
    "open": opened,
    "memoryview": _in_memory,
}


@cache
def _takes(f: Callable[..., Any], plainly: Callable[..., Any] | None = None) -> Callable[..., Any]:
    """Function of numpy that also takes lists of recorded quantities, and of plain numbers is another one."""
    mark = of_python if plainly else of_numpy

    def function(*args: Any, **kwargs: Any) -> Any:
        args = tuple(list(a) if isinstance(a, _GONE_THROUGH) else a for a in args)
        if f in (np.arange, np.linspace) and not kwargs.keys() - {"endpoint", "num"}:
            graph, args = current.get(), exactly.given(current.get(), args)
            if f is np.linspace:
                return linspace(graph, *args, **{"count" if k == "num" else k: v for k, v in kwargs.items()})
            if not kwargs:
                return arange(graph, *args)
        if not has_quantity([*args, *kwargs.values()]):
            return exactly.computed(plainly or f, function, args, kwargs)
        if f in _CHOOSING and not of_library(sys._getframe(1)):
            compared(*quantities(args))
        if f in _ARRAYS:
            array = _array(*args, **kwargs)
            if isinstance(args[0], list | tuple) and isinstance(array, Quantity):
                array.graph.of_lists.update(array.parts)
            if f is np.ascontiguousarray and array.ndim > 1:  # which may be a copy
                array, array.base = copy(array), array
            return copy(array) if f is np.array and kwargs.get("copy", True) else array
        if f in (np.zeros, np.ones, np.empty, np.full):
            shape, *value = args
            if not has_quantity(value):
                return filled(current.get(), shape, f((), *value, **kwargs))
            dtype = kwargs.get("dtype", value[1] if len(value) > 1 else float)
            return filled(current.get(), shape, value[0].astype(dtype))
        if f is np.frexp:  # a scale to divide by and to multiply with again: any will do
            return args[0], 0
        if isinstance(f, np.ufunc):
            return mark(f(*(lift(current.get(), a) for a in args), **kwargs))
        if f not in FUNCTIONS and hasattr(f, "_implementation"):  # it would look into lists of quantities
            raise NotRecorded(f"numpy's {f.__name__}")
        return mark(FUNCTIONS[f](current.get(), *args, **kwargs) if f in FUNCTIONS else f(*args, **kwargs))

    for name in ("reduce", "accumulate", "outer"):
        if isinstance(f, np.ufunc):
            setattr(function, name, getattr(f, name))
    return function


def _array(values: Any, dtype: Any = None, *, copy: Any = None, ndmin: int = 0) -> Any:
    if dtype in (None, str, object) and ndmin < 2 and (texts := chosen_among(current.get(), values)) is not None:
        return texts
    array = lift(current.get(), values)
    array = array if dtype is None else array.astype(dtype, copy=False)
    return array[(None,) * (ndmin - array.ndim)] if ndmin > array.ndim else array


# --- functions of the mechanics ----------------------------------------------------------------------------------


@cache
def body(f: Any) -> Callable[..., Any]:
    """A function of the mechanics whose own code takes recorded quantities."""
    raw = unwrap(f)
    return rebuilt(raw, _space(raw.__module__))


@cache
def _itself(f: Any) -> Callable[..., Any]:
    """A function that is recorded by running itself, or its short form."""
    always = f.__module__ in _ASKING

    def function(*args: Any, **kwargs: Any) -> Any:
        if not (always or has_quantity((args, kwargs))):
            return exactly.computed(f, function, args, kwargs)
        if always and f.__module__ not in _STATING:
            args, kwargs = tuple(map(looked_at, args)), {key: looked_at(value) for key, value in kwargs.items()}
        graph = current.get()
        short = None if graph.bodies else in_steps(f)
        return once(graph, short or body(f), args, kwargs) if not always else body(f)(*args, **kwargs)

    return function


@cache
def _space(module: str) -> dict[str, Any]:
    """The names of a module of this package, with what takes quantities."""
    names: dict[str, Any] = {"__builtins__": builtins, **_NAMES}
    for name, value in vars(sys.modules[module]).items():
        if not name.startswith("__"):
            kept = isinstance(value, type) and value is not Drawing and value.__name__ not in SHOWING
            names[name] = value if kept else instead(value)
    return names


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


class _Nothing:
    """Stands for what a workbook does not show; every use of it gives it again."""

    def __call__(self, *args: Any, **kwargs: Any) -> "_Nothing":
        return self

    def __getattr__(self, name: str) -> "_Nothing":
        if name.startswith("__"):
            raise AttributeError(name)
        return self


class _Page(_Nothing):
    """Stands for marimo, which may stop a cell."""

    def stop(self, predicate: Any, output: Any = None) -> None:
        if predicate:
            raise NotRecorded("the cell stops here")


_NOTHING, _PAGE = _Nothing(), _Page()
_NAMES = {**NAMES, "recorded imported": instead}
