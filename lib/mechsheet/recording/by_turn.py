"""Loops that set elements of arrays from former ones, as a step of time does: ``y[i + 1] = y[i] + h * f(y[i])``.

Or append them to lists: ``y.append(y[-1] + h * f(y[-1]))``. Where the inputs say how many turns such a loop has, each
turn gives the arrays anew, and the lists as arrays with room for what all turns append.
"""

import ast
import copy
from collections import Counter
from collections.abc import Iterable

from mechsheet.recording.forms import TURNS, call, index, is_counted


def by_turn(node: ast.For) -> list[ast.stmt] | None:
    """The loop as one that gives its arrays anew, where there are `Turns`, else as it is; None of any other loop."""
    if hasattr(node, "by_turn") or not is_counted(node.iter):
        return None
    arrays, lists = dict[str, None](), _appended_to(node.body)
    body = _anew(_Appending(lists).body(copy.deepcopy(node.body)), arrays)
    if not arrays:
        return None
    node.by_turn = True  # type: ignore[attr-defined]  # it is looked at no more
    turns = ast.Name(f"{TURNS} {node.lineno}", ast.Load())
    ask = ast.Assign([ast.Name(turns.id, ast.Store())], call("counted", node, *copy.deepcopy(node.iter).args))  # type: ignore[attr-defined]
    begun = [
        line
        for name, each in lists.items()
        for line in (
            ast.Assign([_stored(_count(name))], ast.Call(_loaded("len"), [_loaded(name)], [])),
            ast.Assign([_stored(name)], call("room", node, _loaded(name), turns, ast.Constant(each))),
        )
    ]
    loop = ast.For(node.target, turns, body, [])
    listed = [ast.Assign([_stored(name)], call("in_list", node, _loaded(name))) for name in lists]
    local, former = ast.Call(_loaded("locals"), [], []), f"recorded former {node.lineno}"
    known = [
        call("known", node, local, *map(ast.Constant, names))
        for names in (lists, [name for name in arrays if name not in lists])
    ]
    begun.append(ast.Assign([_stored(former)], call("former", node, known[1])))
    left = ast.Expr(call("left", node, _loaded(former)))
    either = ast.If(call("setting", node, turns, *known), [*begun, loop, left, *listed], [node])
    return [ast.fix_missing_locations(ast.copy_location(line, node)) for line in (ask, either)]


def _loaded(name: str) -> ast.expr:
    return ast.Name(name, ast.Load())


def _stored(name: str) -> ast.expr:
    return ast.Name(name, ast.Store())


def _count(of: str) -> str:
    """The name of how many elements a list has so far."""
    return f"recorded count {of}"


def _appended_to(body: list[ast.stmt]) -> Counter[str]:
    """How many elements each turn appends to which lists; of none where a list is looked at but for its elements."""
    added = _added(body)
    if added is None or not added or any(isinstance(part, _ENDS) for line in body for part in ast.walk(line)):
        return Counter()
    uses, read = Counter[str](), Counter[str]()
    for part in (part for line in body for part in ast.walk(line)):
        match part:
            case ast.Name(name) if name in added:
                uses[name] += 1
            case ast.Call(ast.Attribute(ast.Name(name), "append"), [_], []):
                read[name] += 1
            case ast.Call(ast.Name("len"), [ast.Name(name)], []):
                read[name] += 1
            case ast.Subscript(ast.Name(name), key) if not isinstance(key, ast.Slice | ast.Tuple):
                read[name] += 1
    return added if all(uses[name] == read[name] for name in added) else Counter()


_ENDS = ast.Break, ast.Continue, ast.Return


def _added(body: Iterable[ast.stmt]) -> Counter[str] | None:
    """How many elements some lines append to which lists; None where that depends on what they compute."""
    found = Counter[str]()
    for line in body:
        match line:
            case ast.Expr(ast.Call(ast.Attribute(ast.Name(name), "append"), [_], [])):
                found[name] += 1
            case ast.If(_, then, otherwise):
                ways = _added(then), _added(otherwise)
                if ways[0] is None or ways[0] != ways[1]:
                    return None
                found += ways[0]
            case ast.For() | ast.While():
                if _added(line.body):
                    return None
    return found


class _Appending(ast.NodeTransformer):
    """What is appended to some lists is set behind what these have so far, and their places are counted by that."""

    def __init__(self, lists: Counter[str]) -> None:
        self.lists = lists

    def body(self, lines: list[ast.stmt]) -> list[ast.stmt]:
        return self.visit(ast.Module(lines, [])).body if self.lists else lines

    def visit_Expr(self, node: ast.Expr) -> ast.stmt | list[ast.stmt]:
        self.generic_visit(node)
        match node.value:
            case ast.Call(ast.Attribute(ast.Name(name), "append"), [value], []) if name in self.lists:
                put = ast.Assign([ast.Subscript(_loaded(name), _loaded(_count(name)), ast.Store())], value)
                further = ast.BinOp(_loaded(_count(name)), ast.Add(), ast.Constant(1))
                return [ast.copy_location(line, node) for line in (put, ast.Assign([_stored(_count(name))], further))]
        return node

    def visit_Subscript(self, node: ast.Subscript) -> ast.expr:
        self.generic_visit(node)
        match node.value:
            case ast.Name(name) if name in self.lists:
                node.slice = call("place_of", node, node.slice, _loaded(_count(name)))
        return node

    def visit_Call(self, node: ast.Call) -> ast.expr:
        match node:
            case ast.Call(ast.Name("len"), [ast.Name(name)], []) if name in self.lists:
                return ast.copy_location(_loaded(_count(name)), node)
        self.generic_visit(node)
        return node


def _anew(body: list[ast.stmt], arrays: dict[str, None]) -> list[ast.stmt]:
    """The lines of a turn; the names of the arrays of which they set elements are gathered."""
    return [_line(line, arrays) for line in body]


def _line(line: ast.stmt, arrays: dict[str, None]) -> ast.stmt:
    match line:
        case ast.If(test, then, otherwise):
            return ast.copy_location(ast.If(test, _anew(then, arrays), _anew(otherwise, arrays)), line)
        case ast.For(target, items, inner, []):
            return ast.copy_location(ast.For(target, items, _anew(inner, arrays), []), line)
        case ast.While(test, inner, []):
            return ast.copy_location(ast.While(test, _anew(inner, arrays), []), line)
        case ast.Assign([ast.Subscript(ast.Name(name), key)], value):
            new = value
        case ast.AugAssign(ast.Subscript(ast.Name(name), key), operation, value):
            new = ast.BinOp(ast.Subscript(_loaded(name), copy.deepcopy(key), ast.Load()), operation, value)
        case _:
            return line
    arrays[name] = None
    put = call("placed", line, _loaded(name), index(key), new)
    return ast.copy_location(ast.Assign([_stored(name)], put), line)
