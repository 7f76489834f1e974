"""Ways of statements: whether they only bind names or end, and loops that tell whether they were left."""

import ast
from collections.abc import Iterator

from mechsheet.recording.forms import SCOPED


def only_binds(line: ast.stmt) -> bool:
    """Whether a statement does nothing but give names values."""
    match line:
        case ast.If(test, body, orelse):
            return not any(map(is_of_the_whole, ast.walk(test))) and all(map(only_binds, [*body, *orelse]))
        case ast.Assign(targets, value):
            names = all(isinstance(p, ast.Name | ast.Tuple | ast.Store) for t in targets for p in ast.walk(t))
        case ast.AugAssign(target, _, value) | ast.AnnAssign(target, _, ast.expr() as value):
            names = isinstance(target, ast.Name)
        case ast.Pass():
            return True
        case _:
            return False
    return names and not any(map(is_of_the_whole, ast.walk(value)))


def only_binds_or_raises(line: ast.stmt) -> bool:
    """Whether a statement does nothing but give names values or raise an error."""
    match line:
        case ast.If(test, body, orelse):
            whole = any(map(is_of_the_whole, ast.walk(test)))
            return not whole and all(map(only_binds_or_raises, [*body, *orelse]))
        case ast.Raise():
            return not any(map(is_of_the_whole, ast.walk(line)))
    return only_binds(line)


def only_binds_or_ends(line: ast.stmt) -> bool:
    """Whether a statement of a loop's turn does nothing but give names values, or end the turn or the loop."""
    match line:
        case ast.If(test, body, orelse):
            return not is_of_the_whole(test) and all(map(only_binds_or_ends, [*body, *orelse]))
        case ast.Break() | ast.Continue():
            return True
    return only_binds(line)


def unbound_left(node: ast.For) -> ast.stmt:
    return ast.copy_location(ast.Delete([ast.Name(f"recorded left {node.lineno}", ast.Del())]), node)


def looking(node: ast.For, otherwise: list[ast.stmt]) -> Iterator[ast.stmt]:
    """A loop that may be left, as one that tells whether it was, and what is done ``otherwise``."""
    left = f"recorded left {node.lineno}"
    yield ast.copy_location(ast.Assign([ast.Name(left, ast.Store())], ast.Constant(0.0)), node)
    body = [each for line in node.body for each in _telling(line, left)]
    yield ast.copy_location(ast.For(node.target, node.iter, body, []), node)
    never = ast.Compare(ast.Name(left, ast.Load()), [ast.Eq()], [ast.Constant(0.0)])
    yield ast.copy_location(ast.If(never, otherwise, []), node)


def _telling(line: ast.stmt, left: str) -> Iterator[ast.stmt]:
    if isinstance(line, ast.Break):
        yield ast.copy_location(ast.Assign([ast.Name(left, ast.Store())], ast.Constant(1.0)), line)
    if isinstance(line, ast.If):
        line.body, line.orelse = (
            [new for one in way for new in _telling(one, left)] for way in (line.body, line.orelse)
        )
    yield line


def returning(line: ast.stmt, names: list[str]) -> list[ast.stmt]:
    """A statement of a turn, which returns whether the loop ends, and what the names are."""
    match line:
        case ast.Break() | ast.Continue():
            values = [ast.Constant(isinstance(line, ast.Break)), *(ast.Name(name, ast.Load()) for name in names)]
            return [ast.copy_location(ast.Return(ast.Tuple(values, ast.Load())), line)]
        case ast.If(test, body, orelse):
            ways = ([new for one in way for new in returning(one, names)] for way in (body, orelse))
            return [ast.copy_location(ast.If(test, *ways), line)]
    return [line]


def is_of_the_whole(part: ast.AST) -> bool:
    """Whether a part of a function is not what it is in a function of its own."""
    return isinstance(part, (*SCOPED, ast.Global, ast.Nonlocal)) or (
        isinstance(part, ast.Name) and part.id in ("super", "locals", "__class__")
    )


def ends(way: list[ast.stmt]) -> bool:
    """Whether a way leaves the function, whatever is decided in it."""
    match way:
        case [*_, ast.Return() | ast.Raise()]:
            return True
        case [*_, ast.If(_, body, orelse)]:
            return ends(body) and ends(orelse)
    return False
