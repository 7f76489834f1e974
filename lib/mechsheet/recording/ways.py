"""Ways of statements: whether they only bind names or end, and loops that tell whether they were left."""

import ast
from collections.abc import Iterable, Iterator

from mechsheet.recording.forms import SCOPED


def only_bind(lines: Iterable[ast.stmt], *others: type[ast.stmt]) -> bool:
    """Whether statements do nothing but give names values, or are of some ``others``, such as the end of a turn."""
    return all(_only_binds(line, others) for line in lines)


def _only_binds(line: ast.stmt, others: tuple[type[ast.stmt], ...]) -> bool:
    match line:
        case ast.If(test, body, orelse):
            return not _has_of_the_whole(test) and only_bind([*body, *orelse], *others)
        case ast.Assign(targets, value):
            names = all(isinstance(p, ast.Name | ast.Tuple | ast.Store) for t in targets for p in ast.walk(t))
            return names and not _has_of_the_whole(value)
        case ast.AugAssign(target, _, value) | ast.AnnAssign(target, _, ast.expr() as value):
            return isinstance(target, ast.Name) and not _has_of_the_whole(value)
    return isinstance(line, (ast.Pass, *others)) and not _has_of_the_whole(line)


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


def _has_of_the_whole(part: ast.AST) -> bool:
    return any(map(is_of_the_whole, ast.walk(part)))


def ends(way: list[ast.stmt]) -> bool:
    """Whether a way leaves the function, whatever is decided in it."""
    match way:
        case [*_, ast.Return() | ast.Raise()]:
            return True
        case [*_, ast.If(_, body, orelse)]:
            return ends(body) and ends(orelse)
    return False
