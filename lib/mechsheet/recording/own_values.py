"""Values of a worksheet's own run, as far as a recording can take them for what it does not follow."""

import sys
from collections.abc import Container, Iterable, Mapping
from dataclasses import fields, is_dataclass
from functools import partial
from types import FunctionType, MethodType, SimpleNamespace
from typing import Any

import numpy as np

from mechsheet.quantities.node import Node, bottom_up
from mechsheet.quantities.quantity import quantities
from mechsheet.recording.memory import may_change
from mechsheet.worksheet.check import Check
from mechsheet.worksheet.shown import Shown
from mechsheet.worksheet.table import Figure, Table
from mechsheet.worksheet.verdict import Verdict


def shown(own: Any) -> bool:
    """Whether a value of a worksheet is what a writer shows."""
    group = own if isinstance(own, tuple | list) else [own]
    return any(isinstance(v, Table | Figure | Check | Verdict) for v in group)


def changed_as(names: Iterable[str], later: Iterable[str], namespace: Mapping[str, Any]) -> str:
    """That an array is changed further below under another name, and under which one; "" where it is not."""
    for array in (x for x in map(namespace.get, names) if isinstance(x, np.ndarray)):
        for other in sorted(later):
            if isinstance(known := namespace.get(other), np.ndarray) and np.may_share_memory(array, known):
                return f" is changed below, where it is called {other}"
    return ""


def held(own: Any) -> bool:
    """Whether a value of a worksheet is one that a recording holds."""
    if isinstance(own, tuple | list):
        return any(held(v) for v in own)
    if isinstance(own, dict):
        return any(held(v) for v in own.values())
    if isinstance(own, Table | Figure | Check | Verdict):
        return True
    return isinstance(own, int | float | complex | np.ndarray | np.generic) or bool(named_parts(own))


def named_parts(own: Any) -> list[str]:
    """Names under which an object holds its parts."""
    if is_dataclass(own):
        return [] if isinstance(own, type | Shown) else [f.name for f in fields(own)]
    return [*vars(own)] if _of_worksheet(own) else []


def is_array(own: Any) -> bool:
    """Whether a value of a worksheet is an array of real numbers."""
    return isinstance(own, np.ndarray) and own.dtype.kind in "iuf"


def is_number(own: Any) -> bool:
    """The same, or one such number."""
    return isinstance(own, float | np.floating) or is_array(own)


def _of_worksheet(value: Any) -> bool:
    """Whether an object holds its parts under names, and is of a class that the worksheet has made itself."""
    made = type(value).__module__ not in sys.modules or isinstance(value, SimpleNamespace)
    return made and hasattr(value, "__dict__") and not isinstance(value, type | FunctionType)


def may_be_kept(name: str, namespace: Mapping[str, Any]) -> bool:
    """Whether the worksheet has a value for a name that changes nothing else there when it is called."""
    return name in namespace and not _changes_others(namespace[name])


def _changes_others(value: Any) -> bool:
    """Whether a function of the worksheet's own run, or what holds one, may change something that it did not make."""
    match value:
        case FunctionType():
            return may_change([value.__code__], value.__globals__)
        case MethodType():
            return _changes_others(value.__func__)
        case partial():
            return any(map(_changes_others, (value.func, *value.args, *value.keywords.values())))
        case list() | tuple():
            return any(map(_changes_others, value))
        case dict():
            return any(map(_changes_others, value.values()))
    return False


def resting_on(nodes: Container[Node], names: Mapping[str, Any]) -> tuple[str, ...]:
    """Names of what rests on any of some quantities, in order."""
    parts = {name: [part for each in quantities(value) for part in each.parts] for name, value in names.items()}
    return tuple(sorted(name for name, own in parts.items() if any(part in nodes for part in bottom_up(own, ()))))
