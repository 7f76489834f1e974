"""What goes through elements one by one as the comprehension that it is: its conditions hold for other inputs as well.

``fits = []`` and ``for d in D: if d >= w: fits.append(d)`` behind it are ``fits = [d for d in D if d >= w]``.
"""

import ast
from collections.abc import Sequence, Set
from copy import deepcopy
from functools import lru_cache
from typing import Any

from mechsheet.recording.changed_rows import through_rows
from mechsheet.recording.forms import SCOPED, appended, call, changed_in_place, later, taking
from mechsheet.recording.handed import given_back
from mechsheet.recording.ways import only_bind
from mechsheet.worksheet import source
from mechsheet.worksheet.cells import Cell, Worksheet


class Comprehended(ast.NodeTransformer):
    """``map(f, xs)`` and ``filter(f, xs)`` as the generators that give the same, a ``list`` of one in brackets.

    Lists that loops of functions fill too.
    """

    within: ast.FunctionDef | None = None

    def visit_FunctionDef(self, node: ast.FunctionDef) -> ast.AST:
        outside, self.within = self.within, node
        self.generic_visit(node)
        self.within = outside
        node.body = kept_in_loops(node.body)
        return node

    def visit_For(self, node: ast.For) -> Any:
        if not any(isinstance(part, ast.Break) for part in ast.walk(node)):
            node.body = unskipped(node.body)
        if rows := through_rows(node, self.within):
            return [self.visit(line) for line in rows]
        self.generic_visit(node)
        node.iter = _live(node.iter, set[str]().union(*changed_in_place(node.body)))
        return node

    def visit_Call(self, node: ast.Call) -> ast.AST:
        self.generic_visit(node)
        match node:
            case ast.Call(ast.Name("map"), [f, first, *others], []) if not _is_made(f):
                found = _gone_through(f, [first, *others])
            case ast.Call(ast.Name("filter"), [f, first], []) if not _is_made(f):
                found = _gone_through(f, [first], kept=True)
            case ast.Call(ast.Name("list"), [ast.GeneratorExp(value, each)], []):
                found = ast.ListComp(value, each)
            case _:
                return node
        if any(isinstance(part, (*SCOPED, ast.Starred)) for part in ast.walk(node)):
            return node
        return ast.fix_missing_locations(ast.copy_location(found, node))


def unskipped(body: list[ast.stmt]) -> list[ast.stmt]:
    """Statements of a turn in which those that ``continue`` passes over are the other way of its condition."""
    for n, line in enumerate(body):
        match line:
            case ast.If(test, [*way, ast.Continue()], orelse):
                rest = unskipped([*orelse, *body[n + 1 :]])
                if not (way or rest):
                    return [*body[:n], ast.copy_location(ast.Expr(test), line)]
                ways = (test, way, rest) if way else (ast.UnaryOp(ast.Not(), test), rest, [])
                return [*body[:n], ast.fix_missing_locations(ast.copy_location(ast.If(*ways), line))]
    return body


def _live(items: ast.expr, changed: Set[str]) -> ast.expr:
    """What a loop goes through, arrays that are ``changed`` in it as they are when it comes to each element."""
    match items:
        case ast.Call(ast.Name("enumerate" | "zip") as function, sources, named):
            return ast.copy_location(ast.Call(function, [_live(each, changed) for each in sources], named), items)
        case ast.Name(name) | ast.Subscript(ast.Name(name), ast.Slice()) if name in changed:
            return call("live", items, later(items))
    return items


def through_kept(node: ast.For) -> ast.stmt:
    """A loop as one that goes through all elements of a list of those that are kept, each where it is one of them.

    Where it is no such list, or does more than bind names, the loop itself.
    """
    if not isinstance(node.iter, ast.Name) or node.orelse or hasattr(node, "through_kept") or not only_bind(node.body):
        return node
    node.through_kept = True  # type: ignore[attr-defined]  # it is looked at no more
    holds, kept = f"recorded holds {node.lineno}", f"recorded kept {node.lineno}"
    target = ast.Tuple([ast.Name(holds, ast.Store()), ast.Name(kept, ast.Store())], ast.Store())
    turn = [ast.Assign([node.target], ast.Name(kept, ast.Load())), *node.body]
    loop = ast.For(target, call("each_kept", node, node.iter), [ast.If(ast.Name(holds, ast.Load()), turn, [])], [])
    loop.as_sums = loop.through_kept = True  # type: ignore[attr-defined]
    either = ast.If(call("is_kept", node, node.iter), [loop], [node])
    return ast.fix_missing_locations(ast.copy_location(deepcopy(either), node))


def _is_made(f: ast.expr) -> bool:
    """Whether a function is made where it is handed on, and that once: ``partial(f, 2)``."""
    return not isinstance(f, ast.Lambda) and any(isinstance(part, ast.Call) for part in ast.walk(f))


def _gone_through(f: ast.expr, sources: list[ast.expr], kept: bool = False) -> ast.GeneratorExp | ast.ListComp:
    """What a function gives of each, or those that it is true for; None is whether they are it themselves."""
    names = [f"recorded each {n}" for n in range(len(sources))]
    each: list[ast.expr] = [ast.Name(name, ast.Load()) for name in names]
    targets: list[ast.expr] = [ast.Name(name, ast.Store()) for name in names]
    target, items = targets[0], sources[0]
    if sources[1:]:
        target, items = ast.Tuple(targets, ast.Store()), ast.Call(ast.Name("zip", ast.Load()), sources, [])
    value: ast.expr = each[0] if isinstance(f, ast.Constant) else ast.Call(f, each, [])
    ifs, value = ([value], ast.Name(names[0], ast.Load())) if kept else ([], value)
    return ast.GeneratorExp(value, [ast.comprehension(target, items, ifs, 0)])


def kept_in_loops(lines: Sequence[ast.stmt], read: frozenset[str] = frozenset()) -> list[ast.stmt]:
    """Statements with comprehensions for such lists; not where the others, or who else has ``read`` them, need the
    names that the loop leaves.
    """
    found, empty = list[ast.stmt](), list[str]()  # lists that nothing was put into, by the statements before
    for n, line in enumerate(lines):
        kept = _kept(empty, line, _read_of(lines, n, read)) if empty and isinstance(line, ast.For) else []
        if kept:
            found = [each for each in found if _empty(each) not in [name for name, _ in kept]]
        new = (ast.Assign([ast.Name(name, ast.Store())], some) for name, some in kept)
        found += [ast.fix_missing_locations(ast.copy_location(each, line)) for each in new] or [line]
        name = _empty(line)
        empty = [*empty, name] if name else []
    return found


def _read_of(lines: Sequence[ast.stmt], n: int, read: frozenset[str]) -> set[str]:
    """Names of which somebody reads what the statement number ``n`` leaves, and not what a later one binds."""
    needed = {*read}
    for line in reversed(lines[n + 1 :]):
        if isinstance(line, ast.Assign | ast.AnnAssign) and getattr(line, "value", None):
            needed -= {*source.bound(line)}
        needed |= _loaded(line)
    return needed.union(*map(_loaded, lines[:n]))  # a function may be called later


def _empty(line: ast.stmt) -> str:
    """The name of a new list with nothing in it."""
    match line:
        case ast.Assign([ast.Name(name)], ast.List([])) | ast.AnnAssign(ast.Name(name), value=ast.List([])):
            return name
    return ""


@lru_cache(maxsize=512)
def of_cell(cell: Cell, sheet: Worksheet) -> list[ast.stmt]:
    """The statements of a cell, which are looked at once for each of them."""
    return kept_in_loops(given_back(cell, sheet), frozenset[str]().union(*(each.needs for each in sheet.cells)))


def _kept(lists: Sequence[str], loop: ast.For, read: set[str]) -> list[tuple[str, ast.ListComp]]:
    """What a loop puts into some lists of what meets a condition; nothing where it does anything else."""
    each, ifs, body = [ast.comprehension(loop.target, loop.iter, [], 0)], list[ast.expr](), loop.body
    later = list[tuple[ast.expr, ast.expr]]()  # what names are bound to once a condition holds
    while True:
        match body:
            case [ast.Assign([ast.Name() | ast.Tuple() as own], made), *rest] if _names_alone(own):
                if ifs:
                    later.append((own, made))
                else:
                    each.append(ast.comprehension(own, ast.List([made], ast.Load()), [], 0))
            case [ast.If(test, [ast.Continue()], []), *rest]:
                ifs.append(_where_bound(later, ast.UnaryOp(ast.Not(), test)))
            case [ast.If(test, rest, [])]:
                ifs.append(_where_bound(later, test))
            case _:
                break
        body = rest
    each[-1].ifs = ifs
    kept = [
        (name, ast.ListComp(_where_bound(later, value), deepcopy(each)))
        for name, value in filter(None, map(appended, body))
    ]
    names = [name for name, _ in kept]
    left = set[str]().union(*(_named(own.target) for own in each), *(_named(own) for own, _ in later))
    if not (ifs and kept) or loop.orelse or left & read or len({*names} & {*lists}) < len(body):
        return []
    parts = [part for _, some in kept for part in ast.walk(some)]
    read_or_bound = (isinstance(part, SCOPED) or (isinstance(part, ast.Name) and part.id in names) for part in parts)
    return [] if any(read_or_bound) else kept


def _names_alone(target: ast.expr) -> bool:
    return all(isinstance(part, ast.Name) for part in getattr(target, "elts", [target]))


def _where_bound(bound: Sequence[tuple[ast.expr, ast.expr]], value: ast.expr) -> ast.expr:
    """An expression in which names are bound, one after the other."""
    for own, made in reversed(bound):
        names = [part.id for part in getattr(own, "elts", [own])]
        given = ast.Starred(deepcopy(made), ast.Load()) if isinstance(own, ast.Tuple) else deepcopy(made)
        value = ast.Call(taking(names, value), [given], [])
    return value


def _loaded(of: ast.stmt) -> set[str]:
    """Names that are read or deleted, but for what a loop there calls its own elements."""
    parts = [*ast.walk(of)]
    read = {name.id for name in source.read(of)}
    read |= {part.id for part in parts if isinstance(part, ast.Name) and isinstance(part.ctx, ast.Del)}
    read |= {part.target.id for part in parts if isinstance(part, ast.AugAssign) and isinstance(part.target, ast.Name)}
    read |= {name for part in parts if isinstance(part, ast.Global | ast.Nonlocal) for name in part.names}
    return read.difference(*(_named(part.target) for part in parts if isinstance(part, ast.For)))


def _named(target: ast.expr) -> set[str]:
    return {part.id for part in ast.walk(target) if isinstance(part, ast.Name)}
