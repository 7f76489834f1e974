"""Code of a worksheet or of the mechanics, rewritten so that what Python decides by itself can be recorded.

A choice between two numbers, an element that a quantity points at, an element that is set and Python's own functions of
numbers are calls then, which `choices` answers. So are ``if`` statements whose ways only bind names or end a function.
Others stay, as loops do: which way they went is a guard.
"""

import ast
import inspect
import pickle
import textwrap
from types import CodeType, FunctionType
from typing import Any

from mechsheet.recording import (
    appended,
    changed_rows,
    choices,
    conditions,
    each_row,
    exactly,
    handed,
    in_place,
    inspected,
    kept,
    loops,
    named,
    ordered,
    own_arrays,
    raised,
    rows_checked,
)
from mechsheet.recording.appended_alike import appended_alike
from mechsheet.recording.by_turn import by_turn
from mechsheet.recording.comprehended import Comprehended, through_kept
from mechsheet.recording.forms import (
    OF_KEPT,
    SCOPED,
    as_choice,
    asked,
    by_percent,
    call,
    formatted,
    gone_through,
    index,
    is_counted,
    keeps,
    later,
    left_for,
    listed,
    of_kept,
    of_rows,
    one_by_one,
    set_parts,
    sets_beside,
    sifted,
    tried,
)
from mechsheet.recording.summed import as_sums
from mechsheet.recording.ways import (
    bound_in,
    deleted,
    ended,
    ends,
    is_of_the_whole,
    looking,
    on_copies,
    only_bind,
    returning,
    turned,
    unbound_left,
)
from mechsheet.worksheet import source
from mechsheet.worksheet.altered import filled
from mechsheet.worksheet.source import bound

CALLS = choices.CALLS | ordered.CALLS | conditions.CALLS | in_place.CALLS | kept.CALLS | loops.CALLS
CALLS |= raised.CALLS | each_row.CALLS | rows_checked.CALLS | appended.CALLS | exactly.CALLS | named.CALLS
CALLS |= inspected.CALLS | handed.CALLS | changed_rows.CALLS
_ENDS = ast.Break, ast.Continue
_NAMES = {
    *("float", "int", "complex", "len", "max", "min", "pow", "round"),
    *("sorted", "zip", "enumerate", "range", "getattr", "type"),
}
_KINDS = (
    *(ast.Import, ast.ImportFrom, ast.JoinedStr, ast.Subscript, ast.IfExp, ast.BoolOp, ast.Compare, ast.Match, ast.Not),
    *(ast.AugAssign, ast.If, ast.While, ast.For, ast.FunctionDef, ast.Try, ast.TryStar, ast.With, ast.Raise),
    *(ast.ListComp, ast.GeneratorExp),
)


class _Rewriting(ast.NodeTransformer):
    turns = 0  # of loops, one in another, that are rewritten as functions
    within: ast.FunctionDef | None = None  # the function of the worksheet's that is rewritten
    inside: ast.FunctionDef | None = None  # that of its own functions in which the present line stands

    def visit_Import(self, node: ast.Import | ast.ImportFrom) -> list[ast.stmt]:
        """What an import statement binds is exchanged at once."""
        names = [name for name in bound(node) if name != "*"]
        exchanged = [
            ast.Assign([ast.Name(name, ast.Store())], call("imported", node, ast.Name(name, ast.Load())))
            for name in names
        ]
        return [node, *(ast.copy_location(line, node) for line in exchanged)]

    visit_ImportFrom = visit_Import

    def visit_Call(self, node: ast.Call) -> ast.AST:
        """What Python decides by itself; the reason of a check, which only the worksheet's own run tells, is none."""
        if rows := of_rows(node):
            return self.generic_visit(rows)
        if (text := formatted(node)) is not None:
            return self.visit_JoinedStr(text)
        match node:
            case ast.Call(ast.Name("sorted") | ast.Attribute(_, "join"), [ast.GeneratorExp() as some], _):
                node.args = [ast.copy_location(ast.ListComp(some.elt, some.generators), some)]  # of which they read all
            case ast.Call(ast.Name("Check"), [name, residual, limit, unit, _, *rest]):
                node.args = [name, residual, limit, unit, ast.Constant(""), *rest]
            case ast.Call(ast.Name("Check"), _, keywords):
                node.keywords = [keyword for keyword in keywords if keyword.arg != "reason"]
            case ast.Call(ast.Name(name), [ast.ListComp() | ast.GeneratorExp() as some, *rest], keywords):
                if name in ("min", "max") and [keyword.arg for keyword in keywords] == ["key"] and keeps(some):
                    return self.generic_visit(of_kept(node, f"{name} by", some, keywords[0].value))
                rest += [keyword.value for keyword in keywords if keyword.arg == "default" and name in ("min", "max")]
                if name in OF_KEPT and keeps(some) and len(rest) == len(node.args) - 1 + len(keywords):
                    return self.generic_visit(of_kept(node, OF_KEPT[name], some, *rest))
            case ast.Call(ast.Attribute(ast.Subscript(held, key) as part, "append" | "extend" | "add") as method):
                if not isinstance(key, ast.Slice | ast.Tuple | ast.Constant):
                    method.value = call("held", part, held, key)
        self.generic_visit(node)
        if isinstance(node.func, ast.Name) and node.func.id in _NAMES:
            node.func = ast.copy_location(ast.Name(f"recorded {node.func.id}", ast.Load()), node.func)
        own_arrays.outside(node)
        match node:
            case ast.Call(ast.Attribute(container, "get"), [_, *_], []):
                return call("get", node, container, *node.args)
            case ast.Call(ast.Attribute(values, "index"), [value], []):
                return call("place", node, values, value)
            case ast.Call(ast.Attribute(between, "join"), [parts], []):
                return call("join", node, between, parts)
        return node

    def visit_BinOp(self, node: ast.BinOp) -> ast.AST:
        """A text with numbers put in by ``%``."""
        if (text := by_percent(node)) is not None:
            return self.visit_JoinedStr(text)
        return self.generic_visit(node)

    def visit_JoinedStr(self, node: ast.JoinedStr) -> ast.AST:
        """A text with numbers in it as a call with its pieces, but for what is not simply formatted."""
        if any(isinstance(part, ast.FormattedValue) and part.conversion != -1 for part in node.values):
            self.generic_visit(node)
            return node
        return call("text", node, *map(self._piece, node.values))

    def _piece(self, part: ast.expr) -> ast.expr:
        if not isinstance(part, ast.FormattedValue):
            return part
        if isinstance(part.value, ast.IfExp):  # of two texts Python sees none
            ways = part.value.body, part.value.orelse
            part.value.body, part.value.orelse = (call("said", way, way) for way in ways)
        spec, value = part.format_spec or ast.Constant(""), self.visit(part.value)
        return ast.copy_location(ast.Tuple([value, spec], ast.Load()), part)

    def visit_Subscript(self, node: ast.Subscript) -> ast.AST:
        match node:
            case ast.Subscript(ast.ListComp() as some, ast.Constant(0)) if keeps(some):
                return self.generic_visit(of_kept(node, "first", some))
            case ast.Subscript(ast.ListComp() as some, ast.UnaryOp(ast.USub(), ast.Constant(1))) if keeps(some):
                return self.generic_visit(of_kept(node, "last", some))
        self.generic_visit(node)
        keys = node.slice.elts if isinstance(node.slice, ast.Tuple) else [node.slice]
        known = (ast.Slice, ast.Constant, ast.Starred)
        if not isinstance(node.ctx, ast.Load) or all(isinstance(key, known) for key in keys):
            return node
        return call("element", node, node.value, index(node.slice))

    def visit_ListComp(self, node: ast.ListComp) -> ast.AST:
        """A list of some elements is asked how many these are, or for the first or the least of them, elsewhere."""
        return self.generic_visit(sifted(node) if keeps(node) else listed(node))

    def visit_IfExp(self, node: ast.IfExp) -> ast.AST:
        self.generic_visit(node)
        if any(isinstance(n, SCOPED) for n in ast.walk(node)):
            return node
        return call("choice", node, node.test, later(node.body), later(node.orelse))

    def visit_BoolOp(self, node: ast.BoolOp) -> ast.AST:
        self.generic_visit(node)
        if any(isinstance(n, SCOPED) for n in ast.walk(node)):
            return node
        return call("and" if isinstance(node.op, ast.And) else "or", node, *map(later, node.values))

    def visit_Compare(self, node: ast.Compare) -> ast.AST:
        self.generic_visit(node)
        if len(node.ops) == 1:
            return asked(node)
        sides = [node.left, *node.comparators]
        pairs = zip(sides, node.ops, sides[1:], strict=False)
        parts = [ast.copy_location(ast.Compare(a, [op], [b]), node) for a, op, b in pairs]
        return call("and", node, *map(later, parts))

    def visit_Match(self, node: ast.Match) -> Any:
        if (choice := as_choice(node)) is not None:
            return self.visit_If(choice)
        self.generic_visit(node)
        node.subject = call(inspected.matching(node), node, node.subject)
        return node

    def visit_UnaryOp(self, node: ast.UnaryOp) -> ast.AST:
        self.generic_visit(node)
        return call("not", node, node.operand) if isinstance(node.op, ast.Not) else node

    def visit_Assign(self, node: ast.Assign) -> Any:
        if sets_beside(node):
            lines = [ast.copy_location(line, node) for line in one_by_one(node.targets, node.value)]
            return [new for line in lines for new in _lines(self.visit(line))]
        self.generic_visit(node)
        match node.targets:
            case [ast.Subscript(ast.Name(name), key)] if self.binds(name):
                return own_arrays.put(node, name, key, node.value)
            case [ast.Attribute(ast.Name(name), ("real" | "imag") as part)] if self.binds(name):
                return own_arrays.bound_anew(node, name, "part", ast.Constant(part), node.value)
        return own_arrays.put_held(node)

    def visit_Expr(self, node: ast.Expr) -> Any:
        """What is put in order in place, or filled; not where its name is of those outside of a function."""
        match node.value:
            case ast.Call(ast.Attribute(ast.Name(name), "sort" | "fill" as method), args, by) if self.binds(name):
                named = ast.Call(ast.Name("dict", ast.Load()), [], [*map(self.visit, by)])
                return own_arrays.bound_anew(
                    node, name, "arranged", ast.Constant(method), named, *map(self.visit, args)
                )
        if (name := filled(node.value)) and self.binds(name):
            return own_arrays.filled_anew(node, name, self.visit)
        return self.generic_visit(node)

    def visit_AugAssign(self, node: ast.AugAssign) -> Any:
        self.generic_visit(node)
        match node.target:
            case ast.Subscript(ast.Name(name), key) if self.binds(name):
                old = call("element", node, ast.Name(name, ast.Load()), key)
                return own_arrays.put(node, name, key, ast.BinOp(old, node.op, node.value))
            case ast.Name(name):
                operation = ast.Constant(exactly.OPERATIONS[type(node.op)])
                bind, end = own_arrays.bound_anew(node, name, "changed", operation, node.value)
                settled = ast.Assign([ast.Name("recorded nothing", ast.Store())], end.value)  # no sign of a change
                return [bind, ast.copy_location(settled, node)]
        return own_arrays.added_held(node)

    def visit_If(self, node: ast.If) -> Any:
        """A statement whose ways only bind names gives the names the values of both ways."""
        if (parts := set_parts(node)) and all(self.binds(ast.unparse(part.value)) for part, _ in parts):
            return [line for part in parts for line in self._put_where(node, *part)]
        if lines := appended_alike(node):
            return [new for line in lines for new in _lines(self.visit(line))]
        ways = node.body, node.orelse
        if not all(only_bind(way, ast.Raise) for way in ways):
            self.generic_visit(node)
            return node
        then, otherwise = ({name for line in way for name in bound(line)} for way in ways)
        names = sorted(then | otherwise)
        targets: list[ast.expr] = [ast.Name(name, ast.Store()) for name in names]
        result = ast.Return(ast.Tuple([ast.Name(name, ast.Load()) for name in names], ast.Load()))
        defined, chosen = _both_ways(node, [*node.body, result], [*node.orelse, result], names)
        lines = [*defined, ast.copy_location(ast.Assign([ast.Tuple(targets, ast.Store())], chosen), node)]
        self.turns += 1  # the ways give back what stands for a name that they do not bind
        lines = [self.visit(line) for line in lines]
        self.turns -= 1
        return [*lines, *self._unbound(names, node)]

    def _put_where(self, node: ast.If, target: ast.Subscript, value: ast.expr) -> tuple[ast.stmt, ast.Expr]:
        """The element is looked for only where the statement sets it."""
        key = later(index(target.slice))
        name: Any = target.value
        return own_arrays.bound_anew(node, name.id, "put_where", self.visit(key), self.visit(value))

    def visit_While(self, node: ast.While) -> Any:
        ended = ast.If(ast.UnaryOp(ast.Not(), node.test), [ast.Break()], [])
        return self._repeated(node, None, ast.Constant(None), [ast.copy_location(ended, node), *node.body])

    def visit_For(self, node: ast.For) -> Any:
        ends = any(isinstance(part, ast.Break) for line in node.body for part in ast.walk(line))
        if ends and isinstance(node.target, ast.Tuple):
            row = f"recorded row {node.lineno}"
            parts = ast.copy_location(ast.Assign([node.target], ast.Name(row, ast.Load())), node)
            if only_bind(body := [parts, *node.body], *_ENDS):
                node.target, node.body = ast.Name(row, ast.Store()), body
        if not (ends and isinstance(node.target, ast.Name)):
            sums = None if ends or hasattr(node, "as_sums") else as_sums(node)
            node.as_sums = True  # type: ignore[attr-defined]  # it is looked at no more
            if sums or not (isinstance(node.target, ast.Name) and is_counted(node.iter)):
                return [self.generic_visit(line) for line in sums or [through_kept(node)]]
        if node.orelse and only_bind(node.body, *_ENDS):
            left = [*looking(node, node.orelse), unbound_left(node)]
            return [new for line in left for new in _lines(self.visit(line))]
        return self._repeated(node, node.target.id, gone_through(node.iter), node.body)

    def _repeated(self, node: ast.While | ast.For, item: str | None, items: ast.expr, body: list[ast.stmt]) -> Any:
        """A loop that may end by what it computes, and does nothing but give names values, as a function of a turn."""
        if node.orelse or is_of_the_whole(items) or not only_bind(body, *_ENDS, ast.For, ast.While):
            if isinstance(node, ast.For) and not node.orelse and (either := by_turn(node)):
                return [new for line in either for new in _lines(self.visit(line))]
            self.generic_visit(node)
            return node
        names = sorted({name for line in body for name in bound(line)} | ({item} if item else set()))
        turn = [*body, ast.Continue()]
        given = ast.arguments([], [ast.arg(name) for name in names], None, [], [], None, [])
        ways = [way for line in turn for way in returning(line, names)]
        function = ast.copy_location(ast.FunctionDef("recorded turn", given, ways, []), node)
        inner = turned(body)  # what these were before nobody asks
        asked = ("" if name in inner else name for name in names)
        known = call("known", node, _call_of("locals"), *map(ast.Constant, asked))
        place = ast.Constant(names.index(item) if item else None)
        now: list[ast.expr] = [ast.Name("recorded turn", ast.Load()), items, place]
        ended = call("iterated", node, *now, ast.Starred(known, ast.Load()))
        targets: list[ast.expr] = [ast.Name(name, ast.Store()) for name in names]
        bind = ast.copy_location(ast.Assign([ast.Tuple(targets, ast.Store())], ended), node)
        self.turns += 1
        lines = [self.visit(function)]
        self.turns -= 1
        return [*lines, self.visit(bind), *self._unbound(names, node)]

    def _unbound(self, names: list[str], node: ast.stmt) -> list[ast.stmt]:
        """Delete names that are not bound; a turn of a loop gives back what they stand for."""
        return [] if self.turns else [deleted(name, node) for name in names]

    def visit_FunctionDef(self, node: ast.FunctionDef) -> ast.AST:
        """Where a way of a function ends early, the rest of the function is the other way."""
        own = set[str]() if self.within else own_arrays.of_its_own(node)
        if not any(is_of_the_whole(part) for part in ast.walk(node)):
            node.body = [as_choice(line) or line if isinstance(line, ast.Match) else line for line in ended(node)]
            for n, line in enumerate(node.body):
                if isinstance(line, ast.For) and ends(node.body[n + 1 :]) and (left := left_for(line)):
                    node.body[n:] = [*looking(line, node.body[n + 1 :]), left]
                    break
            for n, line in enumerate(node.body):
                if isinstance(line, ast.If) and any(isinstance(part, ast.Return) for part in ast.walk(line)):
                    rest = node.body[n + 1 :]
                    if ends(line.body) or ends(line.orelse):
                        ways, alone = on_copies(node, line, rest)
                        names = sorted({name for way in ways for part in way for name in bound(part)})
                        defined, chosen = _both_ways(line, ways[0], ways[1], names)
                        node.body = [*node.body[:n], *alone, *defined, ast.copy_location(ast.Return(chosen), line)]
                    break
        outside, self.within = self.within, self.within or node
        around, self.inside = self.inside, self.inside if node.name.startswith("recorded ") else node
        self.generic_visit(node)
        self.within, self.inside = outside, around
        if not outside:
            own_arrays.marked(node, own, CALLS.keys())
        return node

    def binds(self, name: str) -> bool:
        """Whether a name is bound where the present line stands, in a function or in the cell."""
        return self.inside is None or name in bound_in(self.inside)

    def visit_Raise(self, node: ast.Raise) -> ast.AST:
        self.generic_visit(node)
        if node.exc and not any(isinstance(part, SCOPED) for part in ast.walk(node.exc)):
            node.exc = call("raised", node, later(node.exc))
        return node

    def visit_Try(self, node: ast.Try | ast.TryStar | ast.With) -> ast.AST:
        self.generic_visit(node)
        tried(node)
        return node

    visit_TryStar = visit_With = visit_Try


def _lines(lines: Any) -> list[ast.stmt]:
    return [*lines] if isinstance(lines, list | tuple) else [lines]


def _may_be_rewritten(part: ast.AST) -> bool:
    """Whether a part of a statement is of a kind that is rewritten, as it is in few formulas."""
    if isinstance(part, ast.Call):
        match part.func:
            case ast.Attribute(attr=name):
                return name in ("get", "index", "join", "format") or own_arrays.is_outside(part)
            case ast.Name(name):
                return name in _NAMES or name in OF_KEPT or name in ("Check", "str", "map", "filter", "list")
        return False
    if isinstance(part, ast.BinOp):
        return by_percent(part) is not None
    return isinstance(part, _KINDS) or (isinstance(part, ast.Attribute) and isinstance(part.ctx, ast.Store))


def _both_ways(
    node: ast.If, then: list[ast.stmt], otherwise: list[ast.stmt], names: list[str]
) -> tuple[list[ast.stmt], ast.Call]:
    """The ways of a statement as functions of what some names are bound to, and the choice between what these give."""
    ways, defined = ("recorded then", "recorded otherwise"), list[ast.stmt]()
    for way, body in zip(ways, (then, otherwise), strict=True):
        given = ast.arguments([], [ast.arg(name) for name in names], None, [], [], None, [])
        defined.append(ast.copy_location(ast.FunctionDef(way, given, body or [ast.Pass()], []), node))
    now = call("known", node, _call_of("locals"), *map(ast.Constant, names))
    functions = [ast.Name(way, ast.Load()) for way in ways]
    return defined, call("choice", node, node.test, *functions, ast.Starred(now, ast.Load()))


def _call_of(name: str) -> ast.Call:
    return ast.Call(ast.Name(name, ast.Load()), [], [])


def compiled(statement: ast.stmt, path: str, exact: bool = False) -> CodeType:
    """Code of a statement, to be run among the names of `CALLS`; the statement itself is not changed.

    In what is ``exact`` operations on numbers alone are calls too.
    """
    if not (exact or any(map(_may_be_rewritten, source.nodes(statement)))):
        return compile(ast.Module([statement], []), path, "exec")
    tree: Any = _Rewriting().visit(Comprehended().visit(pickle.loads(pickle.dumps(ast.Module([statement], [])))))
    return compile(ast.fix_missing_locations(exactly.Following().visit(tree) if exact else tree), path, "exec")


def rebuilt(f: FunctionType, names: dict[str, Any], exact: bool = False) -> FunctionType:
    """A function among other names, rewritten; a function of a class or inside another one is not rewritten."""
    if not f.__closure__ and "." not in f.__qualname__:
        lines, start = inspect.getsourcelines(f)
        tree = ast.parse(textwrap.dedent("".join(lines)))
        ast.increment_lineno(tree, start - 1)
        match tree.body:
            case [ast.FunctionDef() as written]:
                written.decorator_list, written.returns = [], None
                given = written.args
                for argument in (*given.args, *given.kwonlyargs, *given.posonlyargs, given.vararg, given.kwarg):
                    if argument:
                        argument.annotation = None
                given.defaults, given.kw_defaults = [], [None] * len(given.kw_defaults)
                own = names | {}
                exec(compiled(written, f.__code__.co_filename, exact), own)
                code = own[f.__name__].__code__
                return _with(code, names, f)
    return _with(f.__code__, names, f)


def _with(code: CodeType, names: dict[str, Any], f: FunctionType) -> FunctionType:
    new = FunctionType(code, names, f.__name__, f.__defaults__, f.__closure__)
    new.__kwdefaults__ = f.__kwdefaults__
    return new


NAMES = {f"recorded {name}": function for name, function in CALLS.items()}
