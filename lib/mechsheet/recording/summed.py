"""Loops that only add something for each row, as sums: ``for row in rows: D += row.n / N(row.S)``.

Or append it to a list, or set the element of that number: ``for i in range(n): x[i] = f(i)``.
"""

import ast
import copy
from collections.abc import Iterator

from mechsheet.recording.forms import call, changes, rows_of, taking
from mechsheet.worksheet.source import bound

_SCOPES = ast.Lambda, ast.ListComp, ast.SetComp, ast.DictComp, ast.GeneratorExp
_NONE = ""  # the name of what is no step
_Added = tuple[str, ast.operator | str, ast.expr]  # what is added to a name, or taken away, appended or set


def as_sums(node: ast.For) -> list[ast.stmt] | None:
    """A loop over rows as the sums that it makes, where they are followed, else as it is; None of any other loop.

    What is named in it beside, and the row, have the values of the last one in the end, where there is one.
    """
    rows = rows_of(node.target, node.iter)
    if rows is None or node.orelse or any(isinstance(part, _SCOPES) for part in ast.walk(node)):
        return None
    steps = dict[str, ast.expr]()
    added = [*_added(node.body, [], steps)]
    totals, own = {name for name, *_ in added}, {*rows[0]}
    values = [*steps.values(), *(value for *_, value in added)]
    if any(changes(part) for value in values for part in ast.walk(value)):
        return None
    read = {part.id for value in values for part in ast.walk(value) if isinstance(part, ast.Name)}
    if not added or _NONE in steps or totals & own or steps.keys() & (own | totals) or read & (steps.keys() | totals):
        return None
    whole = [name for name, kind, _ in added if isinstance(kind, str)]
    if len({*whole}) < len(whole) or (any(kind == "set" for _, kind, _ in added) and not _is_numbered(node)):
        return None
    known = ast.Name(f"recorded sums {node.lineno}", ast.Load())
    each = taking(rows[0], ast.Tuple([value for *_, value in added], ast.Load()))
    kinds = ast.Constant(" ".join(kind if isinstance(kind, str) else "sum" for _, kind, _ in added))
    held = ast.Tuple([ast.Name(name, ast.Load()) for name in whole], ast.Load())
    asked = ast.Assign(
        [ast.Name(known.id, ast.Store())], call("sums", node, kinds, each, held, *copy.deepcopy(rows[1]))
    )
    lines: list[ast.stmt] = []
    for n, (name, operation, _) in enumerate(added):
        total = ast.Subscript(known, ast.Constant(n), ast.Load())
        if not isinstance(operation, str):
            lines.append(ast.AugAssign(ast.Name(name, ast.Store()), operation, total))
            continue
        lines.append(ast.Assign([ast.Name(name, ast.Store())], total))
    lines += [ast.Expr(call("settled", node, ast.Name(name, ast.Load()))) for name in whole]
    last = [ast.Subscript(copy.deepcopy(source), ast.Constant(-1), ast.Load()) for source in rows[1]]
    bind = [ast.Assign([ast.Name(name, ast.Store())], value) for name, value in zip(rows[0], last, strict=True)]
    done = (line for line in copy.deepcopy(node.body) if isinstance(line, ast.Assign))
    some = ast.Subscript(known, ast.Constant(-1), ast.Load())
    lines.append(ast.If(some, [*bind, *(line for line in done if not steps.keys().isdisjoint(bound(line)))], []))
    either = ast.If(known, [ast.copy_location(line, node) for line in lines], [node])
    return [ast.fix_missing_locations(ast.copy_location(line, node)) for line in (asked, either)]


def _is_numbered(node: ast.For) -> bool:
    """Whether a turn sets the elements of its own number, counted from 0."""
    match node:
        case ast.For(ast.Name(number), ast.Call(ast.Name("range"), [_], [])):
            places = (part for line in node.body for part in ast.walk(line) if isinstance(part, ast.Subscript))
            set_at = [part.slice for part in places if isinstance(part.ctx, ast.Store)]
            return all(isinstance(at, ast.Name) and at.id == number for at in set_at)
    return False


def _added(body: list[ast.stmt], tests: list[ast.expr], steps: dict[str, ast.expr]) -> Iterator[_Added]:
    """What the lines of a turn add, with the formulas of its ``steps``, among them one for a line that does more."""
    for line in body:
        match line:
            case ast.AugAssign(ast.Name(name), ast.Add() | ast.Sub() as operation, value):
                yield name, operation, _with(steps, _where(tests, value))
            case ast.Assign([ast.Name(name)], ast.BinOp(ast.Name(same), ast.Add() | ast.Sub() as operation, value)) if (
                name == same
            ):
                yield name, operation, _with(steps, _where(tests, value))
            case ast.Expr(ast.Call(ast.Attribute(ast.Name(name), "append"), [value], [])) if not tests:
                yield name, "list", _with(steps, value)
            case ast.Assign([ast.Subscript(ast.Name(name), ast.Name())], value) if not tests:
                yield name, "set", _with(steps, value)
            case ast.Assign([ast.Name(name)], value) if not tests and name not in steps:
                steps[name] = _with(steps, value)
            case ast.If(test, then, otherwise):
                yield from _added(then, [*tests, test], steps)
                yield from _added(otherwise, [*tests, ast.UnaryOp(ast.Not(), test)], steps)
            case _:
                steps[_NONE] = ast.Constant(None)


def _where(tests: list[ast.expr], value: ast.expr) -> ast.expr:
    if not tests:
        return value
    return ast.IfExp(ast.BoolOp(ast.And(), tests) if len(tests) > 1 else tests[0], value, ast.Constant(0.0))


def _with(steps: dict[str, ast.expr], value: ast.expr) -> ast.expr:
    """An expression with those of the steps in place of their names."""
    named: ast.expr = _Named(steps).visit(copy.deepcopy(value))
    return named


class _Named(ast.NodeTransformer):
    def __init__(self, values: dict[str, ast.expr]) -> None:
        self.values = values

    def visit_Name(self, node: ast.Name) -> ast.expr:
        return copy.deepcopy(self.values.get(node.id, node))
