"""Choices that append to the same lists whatever way they take: ``if v > w: T.append(v)``, ``else: T.append(w)``."""

import ast

from mechsheet.recording.forms import appended
from mechsheet.recording.ways import only_bind


def appended_alike(node: ast.If) -> list[ast.stmt] | None:
    """The statement with names for what it appends in the end of its ways, and lines behind it that append them.

    None where the ways append to other lists, or nothing, or do more than bind names before.
    """
    (then, first), (otherwise, second) = (_parted(way, node.lineno) for way in (node.body, node.orelse))
    if not first or first != second or not (only_bind(then, ast.Raise) and only_bind(otherwise, ast.Raise)):
        return None
    choice = ast.copy_location(ast.If(node.test, then, otherwise), node)
    appends = (
        ast.Expr(ast.Call(ast.Attribute(ast.Name(name, ast.Load()), "append", ast.Load()), [_item(node.lineno, n)], []))
        for n, name in enumerate(first)
    )
    return [choice, *(ast.copy_location(line, node) for line in appends)]


def _parted(way: list[ast.stmt], line: int) -> tuple[list[ast.stmt], list[str]]:
    """What a way does before it appends, with names for what it then appends, and to which lists it does."""
    way = [new for each in way for new in (isinstance(each, ast.If) and appended_alike(each)) or [each]]
    last = list[tuple[str, ast.expr]]()
    while len(last) < len(way) and (found := appended(way[-1 - len(last)])):
        last.insert(0, found)
    lists = [name for name, _ in last]
    if any(isinstance(part, ast.Name) and part.id in lists for _, value in last[1:] for part in ast.walk(value)):
        return way, []
    named = (ast.Assign([_item(line, n, ast.Store())], value) for n, (_, value) in enumerate(last))
    kept = way[: len(way) - len(last)]
    return [*kept, *(ast.copy_location(new, old) for new, old in zip(named, way[len(kept) :], strict=True))], lists


def _item(line: int, number: int, use: ast.expr_context | None = None) -> ast.Name:
    return ast.Name(f"recorded item {number} of {line}", use or ast.Load())
