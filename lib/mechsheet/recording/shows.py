"""Values whose elements a statement changes under names that it gives itself: ``if F > 2: w = A[0]; w *= F``."""

import ast
import builtins
from collections import deque
from collections.abc import Iterable, Iterator, Mapping, Sequence, Set
from types import ModuleType
from typing import Any

import numpy as np

from mechsheet.quantities.quantity import Quantity
from mechsheet.worksheet.altered import SAME, altered, pairs

_OF_SEVERAL = ast.If, ast.For, ast.While, ast.With, ast.Try, ast.TryStar, ast.Match
_GOING_THROUGH = {  # of Python's functions those that give what they take, or a part of it
    "list", "tuple", "iter", "next", "zip", "enumerate", "reversed", "map", "filter", "sorted", "min", "max",
}  # fmt: skip
_NO_ARRAY = 99  # axes


def shows(statement: ast.stmt, nodes: Sequence[ast.AST]) -> Iterator[tuple[str, int]]:
    """Names whose elements a statement may change by names of its own, with the axes that arrays of them then have."""
    changed = {array.id for array in altered(nodes) if isinstance(array, ast.Name)}
    if not (changed and isinstance(statement, _OF_SEVERAL)):
        return
    bound, known = [*_bound(nodes)], -1
    found = dict[tuple[str, int], None]()
    while known < len(changed):
        known = len(changed)
        for target, value in bound:
            if any(isinstance(part, ast.Name) and part.id in changed for part in ast.walk(target)):
                found |= dict.fromkeys(_shown_by(value))
        changed.update(name for name, _ in found)
    yield from found


def _bound(nodes: Sequence[ast.AST]) -> Iterator[tuple[ast.expr, ast.expr]]:
    """What some nodes bind, each with the value of which it is one or a part."""
    for node in nodes:
        match node:
            case ast.Assign(targets, value):
                yield from ((target, value) for target in targets)
            case ast.AnnAssign(target, value=ast.expr() as value) | ast.NamedExpr(target, value):
                yield target, value
            case ast.withitem(value, ast.expr() as target):
                yield target, value
            case ast.For(target, items):
                for each, of in pairs(target, items):
                    yield each, ast.Subscript(of, ast.Constant(0), ast.Load())


def _shown_by(value: ast.expr, axes: int = 1) -> Iterator[tuple[str, int]]:
    """Names of the values whose elements an expression of so many axes may show, with the axes of these."""
    match value:
        case ast.Name(name):
            yield name, axes
        case ast.Subscript(of, key):
            keys = key.elts if isinstance(key, ast.Tuple) else [key]
            yield from _shown_by(of, axes + sum(not isinstance(each, ast.Slice) for each in keys))
        case ast.Attribute(of) | ast.Starred(of) | ast.NamedExpr(_, of):
            yield from _shown_by(of, axes)
        case ast.IfExp(_, then, otherwise):
            for part in (then, otherwise):
                yield from _shown_by(part, axes)
        case ast.BoolOp(values=several) | ast.Tuple(several) | ast.List(several):
            for part in several:
                yield from _shown_by(part, max(axes - 1, 1) if isinstance(value, ast.Tuple | ast.List) else axes)
        case ast.Lambda(body=part):
            yield from _shown_by(part, max(axes - 1, 1))
        case ast.GeneratorExp(part, each) | ast.ListComp(part, each):
            yield from _shown_by(part, max(axes - 1, 1))
            for one in each:
                yield from _shown_by(one.iter, axes)
        case ast.Call(ast.Attribute(of, function), args) if function in SAME:
            for part in (of, *args[:1]):
                yield from _shown_by(part, axes)
        case ast.Call(ast.Attribute(of)):
            yield from ((name, _NO_ARRAY) for name, _ in _shown_by(of))
        case ast.Call(ast.Name(name), args) if name in _GOING_THROUGH:
            for part in args:
                yield from _shown_by(part, axes)
        case ast.Call(ast.Name(name)) if not hasattr(builtins, name):
            yield name, _NO_ARRAY


def under_others(found: Sequence[tuple[str, int]], names: Mapping[str, Any], under: Set[str]) -> Set[str]:
    """Those of the names, among values, that are of arrays or may hold some; of others all that is ``under`` these."""
    values = [(name, axes, names.get(name)) for name, axes in found]
    if any(hasattr(value, "__dict__") and not isinstance(value, _NOT_OWN) for *_, value in values):
        return under
    return {name for name, axes, value in values if not isinstance(value, np.ndarray | Quantity) or value.ndim >= axes}


def changes_held(found: Sequence[tuple[str, int]], in_place: Set[str], names: Mapping[str, Any]) -> bool:
    """Whether a statement may change lists, or what else holds values, by ``+=`` or the like."""
    parts = [names.get(name) for name in in_place]
    for name, axes in found:
        value = names.get(name)
        parts += [value] if axes < 2 else value.values() if isinstance(value, dict) else _elements(value)
    return any(isinstance(part, _CONTAINERS) for part in parts)


def _elements(value: Any) -> Iterable[Any]:
    return value if isinstance(value, _CONTAINERS | tuple) else ()


_CONTAINERS: Any = list | dict | set | deque
_NOT_OWN = ModuleType | type | np.ndarray | Quantity
