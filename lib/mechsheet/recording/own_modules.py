"""The modules of the user's own that a worksheet imports: for a proof they run again as its setup does."""

import ast
import inspect
from collections.abc import Callable, Mapping
from contextlib import suppress
from sys import modules
from types import BuiltinFunctionType, FunctionType
from typing import Any

import numpy as np

from mechsheet.quantities.graph import NotRecorded, current
from mechsheet.recording.exactly import Unmoved
from mechsheet.recording.rewritten import compiled
from mechsheet.worksheet.source import bound
from mechsheet.worksheet.users import is_users

Shared = Callable[[Mapping[str, Any]], dict[str, Any]]


def is_own(value: Any) -> bool:
    """Whether a function, a class or a number is of a module that is no installed one and none of the library's."""
    if current.get().unmoved is None:
        return False
    if isinstance(value, float | complex | np.ndarray):
        return id(value) in _numbers()
    if isinstance(value, type) and (hasattr(value, "__inputs__") or hasattr(value, "__properties__")):
        return False  # inputs are of this very class
    return isinstance(value, FunctionType | type) and is_users(value.__module__)


def _numbers() -> dict[int, tuple[str, str]]:
    """Where the numbers of such modules are from: what is imported of them is the very same object."""
    unmoved: Unmoved = current.get().unmoved
    if unmoved.imported is None:
        own = [name for name in [*modules] if name != "mechsheet" and is_users(name)]
        held = ((module, name, value) for module in own for name, value in [*vars(modules[module]).items()])
        kinds = float | complex | np.ndarray
        unmoved.imported = {id(x): (module, name) for module, name, x in held if isinstance(x, kinds)}
    return unmoved.imported


def followed(value: Any, shared: Shared) -> Any:
    """A function, a class or a number as its module makes it where numbers alone are followed too."""
    if isinstance(value, float | complex | np.ndarray):
        module, name = _numbers()[id(value)]
        return _names(module, shared).get(name, value)
    if isinstance(value, type):
        return _names(value.__module__, shared).get(value.__qualname__, value)

    def function(*args: Any, **named: Any) -> Any:
        own = _names(value.__module__, shared).get(value.__qualname__)
        if not isinstance(own, FunctionType | BuiltinFunctionType):
            raise NotRecorded(f"{value.__name__} of the module {value.__module__}")
        return own(*args, **named)

    return function


def _names(module: str, shared: Shared) -> dict[str, Any]:
    """What a module defines, once for each recording: a module that it imports may import it too."""
    graph = current.get()
    known: dict[str, dict[str, Any]] = graph.unmoved.modules
    if module not in known:
        known[module] = dict[str, Any]()
        held, names = vars(modules[module]), known[module]
        names.update({k: v for k, v in held.items() if isinstance(v, float | complex | np.ndarray)})
        names.update(shared({k: v for k, v in held.items() if k not in names}))
        for line in ast.parse(inspect.getsource(modules[module])).body:
            if isinstance(line, ast.Import | ast.ImportFrom | ast.Expr):
                continue
            with suppress(Exception, NotRecorded):
                if isinstance(line, ast.Assign | ast.AnnAssign | ast.AugAssign | ast.FunctionDef | ast.ClassDef):
                    exec(compiled(line, held["__file__"], exact=True), names)
                    continue
            names |= {name: graph.unmoved.unknown(graph, held[name], module) for name in bound(line) if name in held}
    return known[module]
