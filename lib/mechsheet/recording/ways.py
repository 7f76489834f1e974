"""Ways of statements: whether they only bind names or end, and loops that tell whether they were left."""

import ast
from collections.abc import Iterable, Iterator

from mechsheet.recording.forms import SCOPED, call, changed_in_place
from mechsheet.worksheet.source import bound


def only_bind(lines: Iterable[ast.stmt], *others: type[ast.stmt]) -> bool:
    """Whether statements do nothing but give names values, or are of some ``others``, such as the end of a turn.

    Of a loop among those neither does what stands in it.
    """
    return all(_only_binds(line, others) for line in lines)


def _only_binds(line: ast.stmt, others: tuple[type[ast.stmt], ...]) -> bool:
    match line:
        case ast.For() | ast.While():
            named = isinstance(line, ast.While) or _are_names(line.target)
            alone = type(line) in others and named and not line.orelse and not _has_of_the_whole(line)
            return alone and only_bind(line.body, *others)
        case ast.If(test, body, orelse):
            return not _has_of_the_whole(test) and only_bind([*body, *orelse], *others)
        case ast.Assign(targets, value):
            return all(map(_are_names, targets)) and not _has_of_the_whole(value)
        case ast.AugAssign(target, _, value) | ast.AnnAssign(target, _, ast.expr() as value):
            return isinstance(target, ast.Name) and not _has_of_the_whole(value)
    return isinstance(line, (ast.Pass, *others)) and not _has_of_the_whole(line)


def _are_names(target: ast.expr) -> bool:
    return all(isinstance(part, ast.Name | ast.Tuple | ast.Store) for part in ast.walk(target))


def turned(lines: Iterable[ast.AST]) -> set[str]:
    """Names that loops bind anew at each of their turns, and that nothing beside those reads."""
    targets, inside, loaded = set[str](), set[int](), list[ast.Name]()
    for node in (node for line in lines for node in ast.walk(line)):
        if isinstance(node, ast.For):
            own = {part.id for part in ast.walk(node.target) if isinstance(part, ast.Name)}
            targets |= own
            parts = (part for line in node.body for part in ast.walk(line) if isinstance(part, ast.Name))
            inside |= {id(part) for part in parts if part.id in own}
        elif isinstance(node, ast.Name) and isinstance(node.ctx, ast.Load):
            loaded.append(node)
    return targets.difference(part.id for part in loaded if id(part) not in inside)


def former(line: ast.stmt) -> set[str]:
    """Names that may be what they were before a statement, or are made of that: bound by some ways, or added to."""
    match line:
        case ast.AugAssign(ast.Name(name)):
            return {name}
        case ast.If() | ast.For() | ast.While() | ast.Try() | ast.TryStar() | ast.Match() | ast.With():
            inner = [each for each in ast.iter_child_nodes(line) if isinstance(each, ast.stmt)]
            inner += [each for case in getattr(line, "cases", ()) for each in case.body]
            inner += [each for handler in getattr(line, "handlers", ()) for each in handler.body]
            made = set[str]().union(*map(former, inner))
            return made | ({*bound(line)} - _always(line))
    return set()


def _always(line: ast.stmt) -> set[str]:
    """Names that a statement binds whatever way it takes."""
    match line:
        case ast.If(_, body, orelse):
            return _by_all(body) & _by_all(orelse)
        case ast.With():
            return {*bound(line)}
        case ast.For() | ast.While() | ast.Try() | ast.TryStar() | ast.Match() | ast.AugAssign():
            return set()
    return {*bound(line)}


def _by_all(lines: list[ast.stmt]) -> set[str]:
    return set[str]().union(*map(_always, lines))


def bound_in(function: ast.FunctionDef) -> set[str]:
    """The arguments of a function, and what it binds."""
    given = {node.arg for node in ast.walk(function.args) if isinstance(node, ast.arg)}
    return given.union(*map(bound, function.body))


def unbound_left(node: ast.For) -> ast.stmt:
    return ast.copy_location(ast.Delete([ast.Name(f"recorded left {node.lineno}", ast.Del())]), node)


def deleted(name: str, node: ast.stmt) -> ast.stmt:
    """A name that no way has bound is none."""
    test = ast.Compare(ast.Name(name, ast.Load()), [ast.Is()], [ast.Name("recorded unbound", ast.Load())])
    return ast.copy_location(ast.If(test, [ast.Delete([ast.Name(name, ast.Del())])], []), node)


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


def ended(function: ast.FunctionDef) -> list[ast.stmt]:
    """What a function does, which gives None in the end where it gives something before."""
    gives = any(isinstance(part, ast.Return) and part.value for line in function.body for part in ast.walk(line))
    if not gives or ends(function.body):
        return function.body
    return [*function.body, ast.copy_location(ast.Return(ast.Constant(None)), function.body[-1])]


def read_later(function: ast.FunctionDef) -> set[str]:
    """Names that a function has somebody read, who may do so once they are others, or once it has ended."""
    parts = [part for line in function.body for part in ast.walk(line)]
    calls = [(part.func, part.args) for part in parts if isinstance(part, ast.Call)]
    at_once = {id(x) for of, args in calls if isinstance(of, ast.Name) and of.id in _AT_ONCE for x in args}
    later: list[ast.AST] = [x for x in parts if isinstance(x, ast.Lambda | ast.GeneratorExp) and id(x) not in at_once]
    later += [x for x in parts if isinstance(x, ast.FunctionDef) and not x.name.startswith("recorded ")]
    return {name.id for each in later for name in ast.walk(each) if isinstance(name, ast.Name)}


# Functions that go through all of what they are given before they end.
_AT_ONCE = {"sum", "max", "min", "any", "all", "list", "tuple", "set", "sorted"}


def on_copies(
    function: ast.FunctionDef, node: ast.If, rest: list[ast.stmt]
) -> tuple[list[list[ast.stmt]], list[ast.stmt]]:
    """The ways of a function that a condition and the ``rest`` are, on copies of the arrays that these change in place.

    And, before them, a look at whether somebody else knows one of these arrays.
    """
    ways = [way if ends(way) else [*way, *rest] for way in (node.body, node.orelse)]
    own = bound_in(function) - read_later(function)
    changed = sorted(own.intersection(set[str]().union(*changed_in_place([line for way in ways for line in way]))))
    if not changed:
        return ways, []
    local = ast.Call(ast.Name("locals", ast.Load()), [], [])
    alone = ast.Expr(call("unshared", node, call("known", node, local, *map(ast.Constant, changed))))
    copies = [
        ast.Assign([ast.Name(name, ast.Store())], call("copied", node, ast.Name(name, ast.Load()))) for name in changed
    ]
    lines = [ast.fix_missing_locations(ast.copy_location(line, node)) for line in (alone, *copies)]
    return [[*lines[1:], *way] for way in ways], lines[:1]


def ends(way: list[ast.stmt]) -> bool:
    """Whether a way leaves the function, whatever is decided in it."""
    match way:
        case [*_, ast.Return() | ast.Raise()]:
            return True
        case [*_, ast.If(_, body, orelse)]:
            return ends(body) and ends(orelse)
    return False
