"""Solve blocks in formulas: what is found of an unknown."""

import ast
from copy import deepcopy
from functools import lru_cache

from mechsheet.document import names
from mechsheet.document.formula import Apply, Binary, Brackets, Function, Node
from mechsheet.document.functions import Reader


def found(reader: Reader, f: ast.expr, target: ast.expr) -> Node:
    """What a block finds that has no name, with the equation that it solves."""
    match f:
        case ast.Lambda(ast.arguments(args=[ast.arg(name), *_]), body):
            inside = reader.without([name])
            parts: tuple[Node, ...] = names.symbol(name), Binary(inside.read(body), "=", inside.read(target))
        case _:
            parts = (Binary(reader.read(f), "=", reader.read(target)),)
    return Apply(Function("Find"), Brackets(parts))


@lru_cache(maxsize=4096)
def by_unknowns(part: ast.expr, solved: tuple[tuple[str, str], ...]) -> ast.expr:
    """An expression in which solve blocks have names that tell their unknowns."""
    known, new = dict(solved), deepcopy(part)
    for node in ast.walk(new):
        match node:
            case ast.Attribute(ast.Name(name) as block, "value") if name in known:
                block.id = known[name]
    return new
