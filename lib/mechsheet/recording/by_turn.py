"""Loops that set elements of arrays from former ones, as a step of time does: ``y[i + 1] = y[i] + h * f(y[i])``.

Where the inputs say how many turns such a loop has, each turn gives the arrays anew.
"""

import ast
import copy

from mechsheet.recording.forms import TURNS, call, index, is_counted


def by_turn(node: ast.For) -> list[ast.stmt] | None:
    """The loop as one that gives its arrays anew, where there are `Turns`, else as it is; None of any other loop."""
    if hasattr(node, "by_turn") or not is_counted(node.iter):
        return None
    arrays = dict[str, None]()
    body = _anew(copy.deepcopy(node.body), arrays)
    if not arrays:
        return None
    node.by_turn = True  # type: ignore[attr-defined]  # it is looked at no more
    turns = ast.Name(f"{TURNS} {node.lineno}", ast.Load())
    ask = ast.Assign([ast.Name(turns.id, ast.Store())], call("counted", node, *copy.deepcopy(node.iter).args))  # type: ignore[attr-defined]
    loop = ast.For(node.target, turns, body, [])
    settled = [ast.Expr(ast.Call(ast.Name("locals", ast.Load()), [], []))]  # what it has told of a function, it keeps
    settled += [ast.Expr(call("settled", node, ast.Name(name, ast.Load()))) for name in arrays]
    known = call("known", node, ast.Call(ast.Name("locals", ast.Load()), [], []), *map(ast.Constant, arrays))
    either = ast.If(call("setting", node, turns, ast.Starred(known, ast.Load())), [loop, *settled], [node])
    return [ast.fix_missing_locations(ast.copy_location(line, node)) for line in (ask, either)]


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
            new = ast.BinOp(ast.Subscript(ast.Name(name, ast.Load()), copy.deepcopy(key), ast.Load()), operation, value)
        case _:
            return line
    arrays[name] = None
    put = call("placed", line, ast.Name(name, ast.Load()), index(key), new)
    return ast.copy_location(ast.Assign([ast.Name(name, ast.Store())], put), line)
