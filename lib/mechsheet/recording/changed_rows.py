"""Loops that change the rows of a matrix, or the arrays in a list: ``for r in A: r /= r.sum()``, or ``r = A[i]`` first.

A row is taken out for its turn, and what it is then is put back.
"""

import ast
from collections.abc import Callable, Iterable
from itertools import chain
from types import FunctionType
from typing import Any

import numpy as np

from mechsheet.quantities.graph import NotRecorded
from mechsheet.quantities.quantity import Quantity
from mechsheet.recording.choices import UNBOUND, element
from mechsheet.recording.forms import call, later
from mechsheet.recording.in_place import is_array, put, settled, unshared
from mechsheet.recording.memory import content, names_of
from mechsheet.recording.own_arrays import bound_anew
from mechsheet.recording.ways import bound_in, deleted
from mechsheet.worksheet.altered import ARRANGING, pairs

_OUT = object()  # stands in a list for the array that is taken out of it
_OTHERWISE = ast.Break, ast.Continue, ast.Return, ast.Yield, ast.YieldFrom, ast.Lambda, ast.FunctionDef, ast.Delete


class _Exchanged(ast.NodeTransformer):
    """Parts of an expression, by their identity, for others."""

    def __init__(self, others: dict[int, ast.expr]) -> None:
        self.others = others

    def visit(self, node: ast.AST) -> Any:
        other = self.others.get(id(node))
        return self.generic_visit(node) if other is None else other


def rows_changed(node: ast.For) -> list[tuple[ast.Name, ast.Name]]:
    """What a loop calls the rows that it changes, and what it takes each of them out of; nothing where that is read."""
    parts = [part for line in node.body for part in ast.walk(line)]
    names, bound = _named(parts)
    rows = [
        (row, of)
        for row, of in pairs(node.target, node.iter)
        if isinstance(row, ast.Name) and isinstance(of, ast.Name) and _changes(parts, row.id)
    ]
    sources, own = [of.id for _, of in rows], {row.id for row, _ in rows}
    if not rows or node.orelse or len({*sources}) < len(sources) or not names.isdisjoint(sources):
        return []
    if not own.isdisjoint(bound) or any(isinstance(part, _OTHERWISE) for part in parts):
        return []
    return rows


def through_rows(node: ast.For, function: ast.FunctionDef | None) -> list[ast.stmt]:
    """The loop as one that puts its rows back; nothing of one that does not change them.

    Behind it the name of a row is that of a part of what it went through; in a ``function`` nobody asks for it.
    """
    rows = rows_changed(node)
    if not rows:
        return _through_taken(node, function)
    if function and not bound_in(function).issuperset(of.id for _, of in rows):
        return []
    others, begin, end, last = dict[int, ast.expr](), list[ast.stmt](), list[ast.stmt](), list[ast.stmt]()
    for row, of in rows:
        place, known = f"recorded place {of.id}", ast.Name(of.id, ast.Load())
        own_row = ast.List([ast.Name(row.id, ast.Load())], ast.Load())
        others |= {id(row): ast.Name(place, ast.Store()), id(of): call("places", node, later(known))}
        out = call("row_out", node, known, ast.Name(place, ast.Load()), *_used(node.body, row.id, of.id))
        begin.append(ast.Assign([ast.Name(row.id, ast.Store())], out))
        end += bound_anew(node, of.id, "put_back", ast.Name(place, ast.Load()), own_row)
        left: ast.expr = ast.Name("recorded unbound", ast.Load())
        if not function:
            now = call("known", node, ast.Call(ast.Name("locals", ast.Load()), [], []), ast.Constant(row.id))
            left = call("last_row", node, known, ast.Starred(now, ast.Load()))
        last.append(ast.Assign([ast.Name(row.id, ast.Store())], left))
        last += [] if function else [deleted(row.id, node)]
    target, items = map(_Exchanged(others).visit, (node.target, node.iter))
    loop = ast.For(target, items, [*begin, *node.body, *end], [])
    return [ast.fix_missing_locations(ast.copy_location(line, node)) for line in (loop, *last)]


def _through_taken(node: ast.For, function: ast.FunctionDef | None) -> list[ast.stmt]:
    """The same of a loop that takes a row of an array at the beginning of each turn, ``row = A[i]``, and changes it."""
    match node.body:
        case [ast.Assign([ast.Name(row)], ast.Subscript(ast.Name(of), ast.Name(i) as place)), *rest]:
            parts = [part for line in rest for part in ast.walk(line)]
        case _:
            return []
    names, bound = _named(parts)
    alone = {row, of, i}.isdisjoint(bound) and of not in names and len({row, of, i}) == 3
    if not alone or node.orelse or not _changes(parts, row) or any(isinstance(part, _OTHERWISE) for part in parts):
        return []
    if any(isinstance(part, ast.Name) and part.id in (row, of) for part in ast.walk(node.target)):
        return []
    if function and of not in bound_in(function):
        return []
    array, own_row = ast.Name(of, ast.Load()), ast.List([ast.Name(row, ast.Load())], ast.Load())
    out = call("row_out", node, array, place, *_used(rest, row, of))
    begin = ast.Assign([ast.Name(row, ast.Store())], out)
    loop = ast.For(node.target, node.iter, [begin, *rest, *bound_anew(node, of, "put_back", place, own_row)], [])
    left: ast.expr = ast.Name("recorded unbound", ast.Load())
    if not function:
        now = call("known", node, ast.Call(ast.Name("locals", ast.Load()), [], []), ast.Constant(row))
        left = call("row_again", node, array, later(place), ast.Starred(now, ast.Load()))
    last = [ast.Assign([ast.Name(row, ast.Store())], left), *([] if function else [deleted(row, node)])]
    return [ast.fix_missing_locations(ast.copy_location(line, node)) for line in (loop, *last)]


def _named(parts: list[ast.AST]) -> tuple[set[str], set[str]]:
    """Names in some nodes, and those that are bound to something else there."""
    added = {id(part.target) for part in parts if isinstance(part, ast.AugAssign)}
    names = [part for part in parts if isinstance(part, ast.Name)]
    stored = {part.id for part in names if not isinstance(part.ctx, ast.Load) and id(part) not in added}
    return {part.id for part in names}, stored


def _used(lines: list[ast.stmt], row: str, of: str) -> list[ast.expr]:
    """The name of what a row is out of, and all that its turn may call."""
    names, bound = _named([part for line in lines for part in ast.walk(line)])
    return [ast.Constant(of), *(ast.Name(name, ast.Load()) for name in sorted(names - bound - {row, of}))]


def _reads(f: Any, name: str, seen: set[FunctionType]) -> bool:
    """Whether a function of the worksheet's, or one that it calls, reads a name."""
    if not isinstance(f, FunctionType) or f in seen:
        return False
    seen.add(f)
    named = {*names_of(f.__code__), *f.__code__.co_freevars}
    held = chain.from_iterable(map(content, f.__closure__ or ()))
    return name in named or any(_reads(g, name, seen) for g in (*map(f.__globals__.get, named), *held))


def _is_view(place: Any) -> bool:
    """Whether what an index takes is a part of the array itself; of a list, an array or a condition it is a copy."""
    if isinstance(place, tuple):
        return all(map(_is_view, place))
    is_condition = getattr(place, "dtype", np.dtype(float)).kind == "b"
    return not isinstance(place, list | bool) and not is_condition and not np.ndim(place)


def _changes(parts: list[ast.AST], row: str) -> bool:
    for part in parts:
        match part:
            case ast.AugAssign(ast.Name(name)) | ast.Subscript(ast.Name(name), ctx=ast.Store()) if name == row:
                return True
            case ast.Expr(ast.Call(ast.Attribute(ast.Name(name), method))) if name == row and method in ARRANGING:
                return True
    return False


class _Itself:
    """An element of what has no places for them, in the place of one."""

    def __init__(self, element: Any) -> None:
        self.element = element


def places(now: Callable[[], Any]) -> Iterable[Any]:
    """The place of each element."""
    several = now()
    return range(len(several)) if type(several) in (np.ndarray, Quantity, list) else map(_Itself, several)


def row_out(items: Any, place: Any, of: str, *used: Any) -> Any:
    """An element, which is a row by itself, or out of its list; no function that is ``used`` may read that."""
    seen = set[FunctionType]()
    if any(_reads(f, of, seen) for f in used):
        raise NotRecorded(f"{of} is read by a function while a row of it is changed")
    if isinstance(place, _Itself):
        return place.element
    if is_array(items):
        return items[place].copy() if items.ndim > 1 else items[place]
    if type(items) is not list or type(place) is not int:
        return element(items, place)
    each = items[place]
    if is_array(each):
        items[place] = _OUT
    return each


def put_back(items: Any, place: Any, rows: list[Any]) -> Any:
    """What the loop goes through, once a turn has changed a row or an array of it, the one of ``rows``."""
    if type(items) is list and type(place) is int and items[place] is _OUT:
        items[place] = rows[0]
        settled(rows[0])
    if isinstance(place, _Itself) or not is_array(items) or items.ndim == 1:
        return items
    if not (_is_view(place) and np.ndim(items[place])):
        return items
    unshared(rows)
    return put(items, place, rows[0])


def last_row(items: Any, row: Any) -> Any:
    """What the name of the rows stands for behind the loop: a part of what it went through."""
    return element(items, -1) if row is not UNBOUND and is_array(items) and items.ndim > 1 else row


def row_again(items: Any, place: Callable[[], Any], row: Any) -> Any:
    """What the name of a row that was taken out stands for behind the loop: that row of the array, or its copy."""
    is_part = row is not UNBOUND and is_array(items) and items.ndim > 1 and _is_view(at := place()) and np.ndim(row)
    return element(items, at) if is_part else row


CALLS: dict[str, Any] = {
    "places": places,
    "row_out": row_out,
    "put_back": put_back,
    "own put_back": put_back,
    "last_row": last_row,
    "row_again": row_again,
}
