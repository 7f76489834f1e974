"""Forms of statements and expressions in others that are recorded: elements set one by one, elements that are kept."""

import ast
import copy
import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from itertools import count
from string import Formatter

from mechsheet.worksheet.altered import filled
from mechsheet.worksheet.source import bound

SCOPED = ast.NamedExpr, ast.Yield, ast.YieldFrom, ast.Await  # are not what they are inside a lambda


def set_parts(node: ast.If) -> Sequence[tuple[ast.Subscript, ast.expr]]:
    """Elements that a statement sets, and their values by its conditions; none where it does anything else.

    Of several elements the conditions and values must not read what is set.
    """
    ways = [_parts_of_way(way) for way in (node.body, node.orelse)]
    if any(way is None for way in ways) or any(isinstance(part, SCOPED) for part in ast.walk(node)):
        return []
    then, otherwise = (dict(way or ()) for way in ways)
    targets = {key: target for way in (then, otherwise) for key, (target, _) in way.items()}
    if len(targets) > 1:
        arrays = {target.value.id for target in targets.values() if isinstance(target.value, ast.Name)}
        read = [part for part in ast.walk(node) if isinstance(part, ast.Name) and isinstance(part.ctx, ast.Load)]
        if sum(part.id in arrays for part in read) > sum(len(way) for way in (then, otherwise)):
            return []
    values = []
    for key, target in targets.items():
        a, b = (
            way[key][1] if key in way else call("part_of", target, target.value, later(index(target.slice)))
            for way in (then, otherwise)
        )
        values.append((target, ast.copy_location(ast.IfExp(node.test, a, b), node)))
    return values


def _parts_of_way(way: list[ast.stmt]) -> dict[str, tuple[ast.Subscript, ast.expr]] | None:
    """The elements that a way of a statement sets, each once, with their values."""
    known: dict[str, tuple[ast.Subscript, ast.expr]] = {}
    for line in way:
        match line:
            case ast.Assign([ast.Subscript(ast.Name()) as target], value):
                new: Sequence[tuple[ast.Subscript, ast.expr]] = [(target, value)]
            case ast.AugAssign(ast.Subscript(ast.Name()) as target, operation, value):
                old = ast.Subscript(target.value, target.slice, ast.Load())
                new = [(target, ast.copy_location(ast.BinOp(ast.copy_location(old, line), operation, value), line))]
            case ast.If():
                new = set_parts(line)
            case ast.Pass():
                continue
            case _:
                return None
        if not new or any(ast.dump(target) in known for target, _ in new):
            return None
        known |= {ast.dump(target): (target, value) for target, value in new}
    return known


def sets_beside(node: ast.Assign) -> bool:
    """Whether an element is set beside other targets: ``K[i, j] = K[j, i] = k`` or ``K[0], r[0] = k, F``."""
    several = len(node.targets) > 1 or isinstance(node.targets[0], ast.Tuple | ast.List)
    stored = [part for target in node.targets for part in ast.walk(target) if isinstance(part, _STORED)]
    set_parts = any(isinstance(part.ctx, ast.Store) and not isinstance(part, ast.Name) for part in stored)
    return several and set_parts and not any(isinstance(part, ast.Starred) for part in stored)


_STORED = ast.Name, ast.Subscript, ast.Attribute, ast.Starred


def one_by_one(targets: list[ast.expr], value: ast.expr, depth: int = 0) -> Iterator[ast.stmt]:
    """Each target of an assignment by itself, in Python's order; the value has a name meanwhile."""
    own = f"recorded value {depth}"
    yield ast.Assign([ast.Name(own, ast.Store())], value)
    for target in targets:
        if isinstance(target, ast.Tuple | ast.List):
            names = [f"{own}.{n}" for n in range(len(target.elts))]
            yield ast.Assign(
                [ast.Tuple([ast.Name(n, ast.Store()) for n in names], ast.Store())], ast.Name(own, ast.Load())
            )
            for part, name in zip(target.elts, names, strict=True):
                yield from one_by_one([part], ast.Name(name, ast.Load()), depth + 1)
            yield ast.Delete([ast.Name(name, ast.Del()) for name in names])
        else:
            yield ast.Assign([target], ast.Name(own, ast.Load()))
    yield ast.Delete([ast.Name(own, ast.Del())])


def as_choice(node: ast.Match) -> ast.If | None:
    """A ``match`` that compares a name with values as the choice that it is; None of any other."""
    rest: list[ast.stmt] = []
    if not isinstance(node.subject, ast.Name | ast.Attribute):
        return None
    for case in reversed(node.cases):
        match case.pattern:
            case ast.MatchValue(value):
                tests = [value]
            case ast.MatchOr(patterns) if all(isinstance(p, ast.MatchValue) for p in patterns):
                tests = [p.value for p in patterns if isinstance(p, ast.MatchValue)]
            case ast.MatchAs(None, None) if not case.guard:
                rest = case.body
                continue
            case _:
                return None
        if case.guard:
            return None
        each: list[ast.expr] = [ast.Compare(node.subject, [ast.Eq()], [test]) for test in tests]
        rest = [ast.If(ast.BoolOp(ast.Or(), each) if len(each) > 1 else each[0], case.body, rest)]
    (choice,) = rest if len(rest) == 1 else [None]
    return ast.fix_missing_locations(ast.copy_location(choice, node)) if isinstance(choice, ast.If) else None


TURNS = "recorded turns"  # name of what a loop goes through that is known to be counted


def is_counted(items: ast.expr) -> bool:
    """Whether a loop has so many turns as something says."""
    match items:
        case ast.Call(ast.Name("range"), [_, *_] as ends, []):
            return not all(isinstance(end, ast.Constant) for end in ends)
        case ast.Name(name):
            return name.startswith(TURNS)
    return False


def gone_through(items: ast.expr) -> ast.expr:
    """What a loop goes through, where it numbers or pairs other values as a list: any of its turns can be looked at."""
    if is_counted(items) and isinstance(items, ast.Call):
        return call("counted", items, *items.args)
    match items:
        case ast.Call(ast.Name("enumerate" | "zip") as function, parts, keywords):
            return ast.copy_location(ast.Call(call("all_of", items).func, [function, *parts], keywords), items)
    return items


def asked(node: ast.Compare) -> ast.expr:
    """``x is y``, ``x in several`` and what is the opposite of them as calls; any other comparison as it is."""
    match node:
        case ast.Compare(x, [ast.Is()], [y]):
            return call("same", node, x, y)
        case ast.Compare(x, [ast.IsNot()], [y]):
            return call("not", node, call("same", node, x, y))
        case ast.Compare(x, [ast.In()], several):
            return call("member", node, x, *several)
        case ast.Compare(x, [ast.NotIn()], several):
            return call("not", node, call("member", node, x, *several))
    return node


def appended(line: ast.stmt) -> tuple[str, ast.expr] | None:
    """The list to which a statement appends something, and what; None of any other."""
    match line:
        case ast.Expr(ast.Call(ast.Attribute(ast.Name(name), "append"), [value], [])):
            return name, value
    return None


def formatted(node: ast.Call) -> ast.JoinedStr | None:
    """``"{:.2f} N".format(F)`` as ``f"{F:.2f} N"``, ``str(F)`` too; None of any other call, and of another format."""
    match node:
        case ast.Call(ast.Name("str"), [told], []) if not isinstance(told, ast.Starred):
            piece = ast.FormattedValue(copy.deepcopy(told), -1, None)
            return ast.fix_missing_locations(ast.copy_location(ast.JoinedStr([piece]), node))
        case ast.Call(ast.Attribute(ast.Constant(str(text)), "format"), args, keywords):
            known = {str(n): value for n, value in enumerate(args)} | {part.arg: part.value for part in keywords}
        case _:
            return None
    pieces, numbers = list[ast.expr](), count()
    for literal, field, spec, conversion in Formatter().parse(text):
        pieces.append(ast.Constant(literal))
        if field is None:
            continue
        value = known.get(field or str(next(numbers)))
        if value is None or isinstance(value, ast.Starred) or conversion or "{" in str(spec):
            return None
        form = ast.JoinedStr([ast.Constant(spec)]) if spec else None
        pieces.append(ast.FormattedValue(copy.deepcopy(value), -1, form))
    return ast.fix_missing_locations(ast.copy_location(ast.JoinedStr(pieces), node))


_PERCENT = r"%(?:(\.\d{1,2})?([efgds])|%)"


def by_percent(node: ast.BinOp) -> ast.JoinedStr | None:
    """``"%.2f N" % F`` as ``f"{F:.2f} N"``; None of anything else, and of another format."""
    match node:
        case ast.BinOp(ast.Constant(str(text)), ast.Mod(), ast.Tuple(given)):
            values = iter(given)
        case ast.BinOp(ast.Constant(str(text)), ast.Mod(), ast.Name() | ast.Attribute() | ast.BinOp() as alone):
            if "%s" in text and isinstance(alone, ast.Name):  # which may be a tuple of one
                return None
            values = iter([alone])
        case _:
            return None
    pieces, end = list[ast.expr](), 0
    for found in re.finditer(_PERCENT, text):
        pieces.append(ast.Constant(text[end : found.start()]))
        end, (digits, kind) = found.end(), found.groups()
        if not kind:
            pieces.append(ast.Constant("%"))
        elif (value := next(values, None)) is None or isinstance(value, ast.Starred) or (digits and kind in "ds"):
            return None
        else:
            whole = ast.Call(ast.Name("int", ast.Load()), [value], [])
            form = None if kind in "ds" else ast.JoinedStr([ast.Constant(f"{digits or '.6'}{kind}")])
            pieces.append(ast.FormattedValue(copy.deepcopy(whole if kind == "d" else value), -1, form))
    pieces.append(ast.Constant(text[end:]))
    if next(values, None) is not None or "%" in re.sub(_PERCENT, "", text):
        return None
    return ast.fix_missing_locations(ast.copy_location(ast.JoinedStr(pieces), node))


OF_KEPT = {"next": "first", "min": "min", "max": "max", "sum": "sum", "len": "len"}


def keeps(some: ast.ListComp | ast.GeneratorExp) -> bool:
    """Whether a comprehension keeps some of the elements of its innermost loop, and says so there alone."""
    *outer, inner = some.generators
    whole = any(isinstance(part, SCOPED) for part in ast.walk(some)) or any(each.is_async for each in some.generators)
    return bool(inner.ifs) and not any(each.ifs for each in outer) and not whole


def of_kept(node: ast.expr, kind: str, some: ast.ListComp | ast.GeneratorExp, *rest: ast.expr) -> ast.Call:
    """A call with all elements, each with the condition under which it is kept and a function that gives its value."""
    return call("of_kept", node, ast.Constant(kind), _every(some), *rest)


def sifted(node: ast.ListComp) -> ast.Call:
    """A list of those that are kept, as a call with all elements."""
    return call("sifted", node, _every(node))


def listed(node: ast.ListComp) -> ast.expr:
    """A list with an element for each row, as a call with a function of a row; any other as it is."""
    each, *inner = node.generators
    if inner or each.ifs or each.is_async or hasattr(node, "of_rows") or any(map(changes, ast.walk(node))):
        return node
    if (rows := _sources(each)) is None:
        return node
    node.of_rows = True  # type: ignore[attr-defined]  # it is looked at no more
    row = rows[0](copy.deepcopy(node.elt))
    each.iter = rows[2]
    named = node.elt.func if isinstance(node.elt, ast.Call) else None
    kind = "checked" if isinstance(named, ast.Name) and named.id == "check" else "listed"
    return call(kind, node, row, taking(rows[3], node), *rows[1])


def _every(some: ast.ListComp | ast.GeneratorExp) -> ast.expr:
    inner = some.generators[-1]
    names = dict.fromkeys(n.id for each in some.generators for n in ast.walk(each.target) if isinstance(n, ast.Name))
    given = ast.arguments(
        [], [ast.arg(name) for name in names], None, [], [], None, [ast.Name(n, ast.Load()) for n in names]
    )
    holds = ast.BoolOp(ast.And(), inner.ifs) if len(inner.ifs) > 1 else inner.ifs[0]
    pair = ast.Tuple([holds, ast.Lambda(given, some.elt)], ast.Load())
    rows = None if some.generators[1:] or any(map(changes, ast.walk(some))) else _sources(inner)
    through = rows[2] if rows else inner.iter
    every = [*some.generators[:-1], ast.comprehension(inner.target, through, [], 0)]
    one_by_one = ast.copy_location(ast.GeneratorExp(pair, every), some)
    if rows is None:
        return one_by_one
    each = rows[0](copy.deepcopy(ast.copy_location(ast.Tuple([holds, some.elt], ast.Load()), some)))
    return call("kept_rows", some, each, taking(rows[3], one_by_one), *rows[1])


_Of = Callable[[ast.expr], ast.expr]  # a function of a row for an expression


def _sources(each: ast.comprehension) -> tuple[_Of, list[ast.expr], ast.expr, list[str]] | None:
    """What makes functions of a row, what gives the columns or tables, and these gone through by names of their own."""
    targets, sources, paired = [each.target], [each.iter], None
    match each.target, each.iter:
        case ast.Tuple(parts), ast.Call(ast.Name("zip"), columns, keywords) if len(parts) == len(columns):
            targets, sources, paired = parts, columns, keywords
    named = [target.elts if isinstance(target, ast.Tuple) else [target] for target in targets]
    names = [part.id for parts in named for part in parts if isinstance(part, ast.Name)]
    bound = any(isinstance(part, (ast.Starred, *SCOPED)) for source in sources for part in ast.walk(source))
    if bound or len(names) != sum(map(len, named)):
        return None
    names = [f"recorded unused {n}" if name in names[n + 1 :] else name for n, name in enumerate(names)]  # as for _, _

    def of_row(value: ast.expr) -> ast.expr:
        if all(isinstance(target, ast.Name) for target in targets):
            return taking(names, value)
        rows = [f"recorded row {n}" for n, _ in enumerate(targets)]
        given: list[ast.expr] = [ast.Name(row, ast.Load()) for row in rows]
        parts = [
            ast.Starred(row, ast.Load()) if isinstance(target, ast.Tuple) else row
            for row, target in zip(given, targets, strict=True)
        ]
        return taking(rows, ast.copy_location(ast.Call(taking(names, value), parts, []), value))

    own = [f"recorded source {n}" for n, _ in enumerate(sources)]  # each is made once
    known: list[ast.expr] = [ast.Name(name, ast.Load()) for name in own]
    through = known[0] if paired is None else ast.Call(ast.Name("zip", ast.Load()), known, paired)
    return of_row, sources, ast.copy_location(through, each.iter), own


_OF_ROWS = {
    **{kind: kind for kind in ("sum", "min", "max", "any", "all", "prod", "array")}, "asarray": "array", "fsum": "sum",
}  # fmt: skip
_PARTS = ast.Name, ast.Attribute, ast.BinOp, ast.UnaryOp, ast.Subscript, ast.Slice, ast.Constant, ast.Tuple
_SIGNS = ast.operator, ast.unaryop, ast.expr_context


def changes(part: ast.AST) -> bool:
    """Whether a part of an expression may change something, as a list that is added to."""
    of_list = "append", "extend", "insert", "update", "add", "sort", "pop", "remove", "clear", "setdefault"
    return isinstance(part, SCOPED) or (isinstance(part, ast.Attribute) and part.attr in of_list)


def rows_of(target: ast.expr, items: ast.expr) -> tuple[list[str], list[ast.expr]] | None:
    """The names that rows have one after the other, and the columns or tables that give them; None of anything else."""
    targets, sources = [target], [items]
    match target, items:
        case ast.Tuple(parts), ast.Call(ast.Name("zip"), columns, []) if len(parts) == len(columns):
            targets, sources = parts, columns
    names = [each.id for each in targets if isinstance(each, ast.Name)]
    known = all(_is_plain(part) for source in sources for part in ast.walk(source))
    return (names, sources) if known and len(names) == len(targets) else None


def _is_plain(part: ast.AST) -> bool:
    """Whether a part of what rows are made of may be made twice, as the number of each."""
    match part:
        case ast.Call(ast.Name("len"), [_], []) | ast.Call(ast.Name("range" | "arange" | "linspace"), [_, *_], []):
            return True
        case ast.Call(ast.Attribute(ast.Name("np" | "numpy"), "arange" | "linspace"), [_, *_], []):
            return True
    return isinstance(part, (*_PARTS, *_SIGNS))


def of_rows(node: ast.Call) -> ast.Call | None:
    """A call with a value for each row, as one with a function of a row, and the call itself; None of any other."""
    match node:
        case ast.Call(
            ast.Name(name) | ast.Attribute(ast.Name("np" | "numpy" | "math"), name),
            [ast.ListComp(value, [each]) | ast.GeneratorExp(value, [each]) as some],
            [],
        ) if name in _OF_ROWS and not each.ifs and not each.is_async and not hasattr(some, "of_rows"):
            rows = _sources(each)
            if rows is None or any(map(changes, ast.walk(value))):
                return None
            some.of_rows = True  # type: ignore[union-attr]  # it is looked at no more
            row = rows[0](copy.deepcopy(value))
            each.iter = rows[2]
            return call("of_rows", node, ast.Constant(_OF_ROWS[name]), row, taking(rows[3], node), *rows[1])
    return None


def left_for(node: ast.For) -> ast.stmt | None:
    """Let a loop that only looks for what the function returns be left with it; what returns it then. Else None."""
    ends = [part for line in node.body for part in ast.walk(line) if isinstance(part, ast.Return | ast.Break)]
    whole = any(
        isinstance(part, ast.For | ast.While | ast.FunctionDef) for line in node.body for part in ast.walk(line)
    )
    if node.orelse or whole or not ends or not all(isinstance(end, ast.Return) and end.value for end in ends):
        return None
    found = f"recorded found {node.lineno}"
    node.body = [each for line in node.body for each in _leaving(line, found)]
    return ast.copy_location(ast.Return(ast.Name(found, ast.Load())), node)


def _leaving(line: ast.stmt, found: str) -> Iterator[ast.stmt]:
    if isinstance(line, ast.Return) and line.value:
        yield ast.copy_location(ast.Assign([ast.Name(found, ast.Store())], line.value), line)
        line = ast.copy_location(ast.Break(), line)
    if isinstance(line, ast.If):
        line.body, line.orelse = (
            [new for one in way for new in _leaving(one, found)] for way in (line.body, line.orelse)
        )
    yield line


def index(key: ast.expr) -> ast.expr:
    """An index as a value: slices are calls of ``slice`` outside of brackets."""
    if isinstance(key, ast.Slice):
        ends = [end or ast.Constant(None) for end in (key.lower, key.upper, key.step)]
        return ast.Call(ast.Name("slice", ast.Load()), ends, [])
    return ast.Tuple([index(k) for k in key.elts], ast.Load()) if isinstance(key, ast.Tuple) else key


def tried(node: ast.Try | ast.TryStar | ast.With) -> None:
    """Let lines in which errors are handled say what they make, and that one is handled: of recorded quantities alone.

    Where something in them is no number Python may have gone another way.
    """
    if isinstance(node, ast.With):
        named = {n.attr if isinstance(n, ast.Attribute) else getattr(n, "id", "") for n in _called(node)}
        if "suppress" not in named:
            return
        handlers = [ast.ExceptHandler(ast.Name("Exception", ast.Load()), None, [])]  # else nobody sees what it handles
        inner = ast.copy_location(ast.Try(node.body, handlers, [], []), node)
        node.body, node = [inner], inner
    for handler in node.handlers:
        handler.name = handler.name or "_error"
        handler.body.insert(0, ast.Expr(call("handled", handler, ast.Name(handler.name, ast.Load()))))
    for part in (part for line in node.body for part in ast.walk(line)):
        if isinstance(part, ast.Return) and part.value:
            part.value = call("tried", part, part.value)
    names = dict.fromkeys(name for line in node.body for name in bound(line))
    if not isinstance(last := node.body[-1], ast.Return):
        made = call("tried", last, *(ast.Name(name, ast.Load()) for name in names))
        node.body.append(ast.copy_location(ast.Expr(made), last))


def _called(node: ast.With) -> Iterator[ast.expr]:
    return (item.context_expr.func for item in node.items if isinstance(item.context_expr, ast.Call))


def later(value: ast.expr) -> ast.expr:
    return taking((), value)


def taking(names: Iterable[str], value: ast.expr) -> ast.expr:
    """A function of some names."""
    given = ast.arguments([], [ast.arg(name) for name in names], None, [], [], None, [])
    return ast.copy_location(ast.Lambda(given, value), value)


def call(name: str, at: ast.AST, *args: ast.expr) -> ast.Call:
    call = ast.Call(ast.Name(f"recorded {name}", ast.Load()), list(args), [])
    return ast.copy_location(call, at)


def changed_in_place(body: Iterable[ast.stmt]) -> tuple[set[str], set[str]]:
    """Names of what statements change in place, and of what they add to; not those that they bind to anything else."""
    changed, added, others = set[str](), set[str](), set[str]()
    parts = [part for line in body for part in ast.walk(line)]
    kept = {id(part.target) for part in parts if isinstance(part, ast.AugAssign)}
    for part in parts:
        match part:
            case ast.Subscript(ast.Name(name), ctx=ast.Store()):
                changed.add(name)
            case ast.Expr(ast.Call(ast.Attribute(ast.Name(name), "sort" | "fill"))):
                changed.add(name)
            case ast.Expr(value) if name := filled(value):
                changed.add(name)
            case ast.AugAssign(ast.Name(name)):
                added.add(name)
            case ast.Name(name, ast.Store() | ast.Del()) if id(part) not in kept:
                others.add(name)
    return changed - others, added - others
