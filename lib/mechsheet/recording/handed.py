"""Arrays that functions change for who calls them, as what these functions give back.

``def step(s, h): s[0] += h * s[1]`` with ``step(state, 0.1)`` is ``def step(s, h): ...; return s`` of a copy with
``state[...] = step(state, 0.1)``: the same where nobody in the function knows the array by another name.
"""

import ast
from collections import Counter
from collections.abc import Mapping, Sequence, Set
from copy import deepcopy
from functools import lru_cache
from types import FunctionType
from typing import Any, NamedTuple

from mechsheet.quantities.graph import NotRecorded
from mechsheet.quantities.quantity import owner
from mechsheet.recording.changed_rows import rows_changed
from mechsheet.recording.forms import call, changed_in_place
from mechsheet.recording.in_place import NOT_SET, OTHER_NAME, is_array, unshared
from mechsheet.recording.memory import Memory, either_of
from mechsheet.recording.own_arrays import ARRAYS, is_new
from mechsheet.recording.ways import read_later
from mechsheet.worksheet import source
from mechsheet.worksheet.cells import Cell, Worksheet


class _Changing(NamedTuple):
    """A function that changes some of its arguments in place where these are arrays, and calls others giving back."""

    function: ast.FunctionDef
    changed: tuple[str, ...]
    surely: bool  # and not by ``+=`` alone, which binds a number anew
    beside: tuple[str, ...] = ()  # of them arrays of the worksheet, which it is not handed

    @property
    def giving(self) -> str:
        """Name of the function that gives them back."""
        return f"_{self.function.name} giving back"


def given_back(cell: Cell, sheet: Worksheet) -> Sequence[ast.stmt]:
    """The statements of a cell, in which functions give back the arrays that they change."""
    if not (known := _changing(sheet)):
        return cell.lines
    found, made = list[ast.stmt](), set[str]()
    for line in cell.lines:
        lines = _handing([line], known)
        needed = [*_called(lines, known)]
        for each in needed:
            needed += [other for other in _called([each.function], known) if other not in needed]
        new = (_as_giving(each) for each in needed if each.giving not in made)
        found += (ast.fix_missing_locations(ast.copy_location(each, line)) for each in new)
        made.update(each.giving for each in needed)
        found += lines
    return found


def _called(lines: Sequence[ast.stmt], known: Mapping[str, _Changing]) -> list[_Changing]:
    """Functions that statements call to have arrays back."""
    names = {part.id for line in lines for part in ast.walk(line) if isinstance(part, ast.Name)}
    return [each for each in known.values() if each.giving in names]


@lru_cache(maxsize=64)
def _changing(sheet: Worksheet) -> Mapping[str, _Changing]:
    """The functions of a worksheet that change their arguments, or hand them to one that does, by their names."""
    every = (*sheet.whole, *(line for cell in sheet.cells for line in cell.lines))
    given = Counter(name for line in every for name in source.bound(line))
    functions = [line for line in every if isinstance(line, ast.FunctionDef) and given[line.name] == 1]
    arrays = {name for name in filter(None, map(_of_array, every)) if given[name] == 1}
    known = dict[str, _Changing]()
    while True:
        found = {each.function.name: each for f in functions if (each := _as_changing(f, known, arrays)).changed}
        if {name: each[1:] for name, each in found.items()} == {name: each[1:] for name, each in known.items()}:
            return found
        known = found


def _of_array(line: ast.stmt) -> str:
    """Name that a statement gives to a new array."""
    match line:
        case ast.Assign([ast.Name(name)], ast.Call(ast.Name(of) | ast.Attribute(_, of))) if of in ARRAYS:
            return name
    return ""


def _as_changing(function: ast.FunctionDef, known: Mapping[str, _Changing], arrays: Set[str]) -> _Changing:
    """A function with the arguments that it changes in place and never binds to anything else, where that is told."""
    new: Any = _handing([function], known)[0]
    given, parts = function.args, [part for line in function.body for part in ast.walk(line)]
    untold = ast.FunctionDef | ast.ClassDef | ast.Yield | ast.YieldFrom | ast.Global | ast.Nonlocal
    defaults = (*given.defaults, *filter(None, given.kw_defaults))
    if function.decorator_list or any(isinstance(part, untold) for part in parts):
        return _Changing(new, (), False)
    if not all(isinstance(value, ast.Constant) for value in defaults):  # it would have another one as its own
        return _Changing(new, (), False)
    changed, added = changed_in_place(new.body)
    bound = {part.id for part in parts if isinstance(part, ast.Name) and not isinstance(part.ctx, ast.Load)}
    changed |= {of.id for part in parts if isinstance(part, ast.For) for _, of in rows_changed(part)} - bound
    names = [each.arg for each in (*given.posonlyargs, *given.args)]
    later = read_later(function)
    beside = tuple(sorted((changed & arrays) - source.local(function) - later))
    found = (*(name for name in names if name in (changed | added) - later), *beside)
    return _Changing(new, found, not changed.isdisjoint(found), beside)


def _handing(lines: Sequence[ast.stmt], known: Mapping[str, _Changing], own: Set[str] | None = None) -> list[ast.stmt]:
    """Statements in which functions give back what they change, among the names of a function's ``own``."""
    found = list[ast.stmt]()
    for line in lines:
        if known.keys().isdisjoint(part.id for part in ast.walk(line) if isinstance(part, ast.Name)):
            found.append(line)
        elif isinstance(line, ast.ClassDef) or (own is not None and isinstance(line, ast.FunctionDef)):
            found.append(line)  # whose names are others
        elif new := _handed_back(line, known, own):
            found += (ast.fix_missing_locations(ast.copy_location(each, line)) for each in new)
        elif new := _before(line, known):
            found += _handing(new, known, own)
        else:
            line, names = deepcopy(line), source.local(line) if isinstance(line, ast.FunctionDef) else own
            for part in (line, *getattr(line, "handlers", ()), *getattr(line, "cases", ())):
                for field in ("body", "orelse", "finalbody"):
                    if isinstance(inner := getattr(part, field, None), list):
                        setattr(part, field, _handing(inner, known, names))
            found.append(line)
    return found


def _handed_back(line: ast.stmt, known: Mapping[str, _Changing], own: Set[str] | None) -> list[ast.stmt]:
    """The statements for one that calls such a function; none where it does not, or hands on what has no name here."""
    match line:
        case ast.Expr(ast.Call(ast.Name(name)) as node) if name in known:
            targets = list[ast.expr]()
        case ast.Assign(targets, ast.Call(ast.Name(name)) as node) if name in known and known[name].surely:
            pass
        case _:
            return []
    beside: dict[str, ast.expr] = {each: ast.Name(each, ast.Load()) for each in known[name].beside}
    given = _arguments(node, known[name].function.args) | beside
    arrays = [given.get(each) for each in known[name].changed]
    names = [array.id for array in arrays if isinstance(array, ast.Name)]
    if not names or len({*names}) < len(names):
        return []
    if own is not None and (name in own or not own >= {*names} - beside.keys() or not own.isdisjoint(beside)):
        return []
    if not all(isinstance(array, ast.Name) or (array and is_new(array)) for array in arrays):
        return []
    new = [f"_new {line.lineno} {k}" for k, _ in enumerate(arrays)]
    pairs = [(x, array.id) for x, array in zip(new, arrays, strict=True) if isinstance(array, ast.Name)]
    result = f"_given {line.lineno}"
    nothing: list[ast.expr] = [ast.Constant(None) for _ in (*new, result)]
    keywords = [*node.keywords, *(ast.keyword(each, value) for each, value in beside.items())]
    giving = ast.Call(ast.Name(known[name].giving, ast.Load()), node.args, keywords)
    lines: list[ast.stmt] = [ast.Assign([_stored(*new, result)], giving)]
    for x, array in pairs:
        whole = ast.Subscript(ast.Name(array, ast.Load()), ast.Constant(...), ast.Store())
        lines.append(ast.Assign([whole], ast.Name(x, ast.Load())))
    if targets:
        sides = [ast.Tuple([ast.Name(pair[k], ast.Load()) for pair in pairs], ast.Load()) for k in (0, 1)]
        lines.append(ast.Assign(targets, call("of_caller", node, ast.Name(result, ast.Load()), *sides)))
    return [*lines, ast.Assign([_stored(*new, result)], ast.Tuple(nothing, ast.Load()))]


def _before(line: ast.stmt, known: Mapping[str, _Changing]) -> list[ast.stmt]:
    """A statement with a call of such a function within an expression as one with the call before it.

    None of one where something else is computed before, or looks at the arrays.
    """
    if not isinstance(line, ast.Expr | ast.Assign | ast.AugAssign | ast.AnnAssign | ast.Return | ast.If):
        return []
    value = line.test if isinstance(line, ast.If) else line.value or ast.Constant(None)
    calls = [node for node in ast.walk(value) if isinstance(node, ast.Call) and _name_of(node.func) in known]
    if len(calls) != 1 or not known[_name_of(calls[0].func)].surely:
        return []
    if calls[0] is value and isinstance(line, ast.Expr | ast.Assign):
        return []
    (node,), name = calls, f"_before {line.lineno}"
    around = [part for part in ast.walk(value) if part is not node and any(each is node for each in ast.walk(part))]
    if any(isinstance(part, _LATER) or (isinstance(part, ast.Compare) and len(part.ops) > 1) for part in around):
        return []
    earlier = [part for part in ast.walk(value) if isinstance(part, ast.expr) and _place(part) < _place(node)]
    if isinstance(line, ast.AugAssign):
        earlier += (part for part in ast.walk(line.target) if isinstance(part, ast.expr))
    called = {id(part.func) for part in around if isinstance(part, ast.Call)}
    arrays = {
        *known[_name_of(node.func)].beside,
        *map(_name_of, node.args),
        *(_name_of(x.value) for x in node.keywords),
    }
    for part in earlier:
        computed = isinstance(part, ast.Call) or (isinstance(part, ast.Attribute) and id(part) not in called)
        if part not in around and (_name_of(part) in arrays - {""} or (computed and not _is_input(part))):
            return []
    rest: Any = _Put(node, name).visit(deepcopy(line))
    lines = [ast.Assign([ast.Name(name, ast.Store())], node), rest]
    if not isinstance(line, ast.Return | ast.If):
        lines.append(ast.Assign([ast.Name(name, ast.Store())], ast.Constant(None)))
    return [ast.fix_missing_locations(ast.copy_location(each, line)) for each in lines]


# What computes its parts later, or not all of them.
_LATER = ast.Lambda, ast.IfExp, ast.BoolOp, ast.NamedExpr, ast.ListComp, ast.SetComp, ast.DictComp, ast.GeneratorExp


def _is_input(part: ast.expr) -> bool:
    return isinstance(part, ast.Attribute) and _name_of(part.value) == "g"


def _name_of(part: ast.AST) -> str:
    return part.id if isinstance(part, ast.Name) else ""


def _place(part: ast.expr) -> tuple[int, int]:
    return part.lineno, part.col_offset


class _Put(ast.NodeTransformer):
    """A name in the place of a call."""

    def __init__(self, node: ast.Call, name: str) -> None:
        self.place, self.name = (_place(node), node.end_lineno, node.end_col_offset), name

    def visit_Call(self, node: ast.Call) -> ast.expr:
        if (_place(node), node.end_lineno, node.end_col_offset) == self.place:
            return ast.copy_location(ast.Name(self.name, ast.Load()), node)
        self.generic_visit(node)
        return node


def _stored(*names: str) -> ast.Tuple:
    return ast.Tuple([ast.Name(name, ast.Store()) for name in names], ast.Store())


def _arguments(node: ast.Call, given: ast.arguments) -> dict[str, ast.expr]:
    """What is handed as each argument; nothing where it is not told."""
    if any(isinstance(x, ast.Starred) for x in node.args) or any(x.arg is None for x in node.keywords):
        return {}
    names = [each.arg for each in (*given.posonlyargs, *given.args)]
    return {**dict(zip(names, node.args, strict=False)), **{x.arg: x.value for x in node.keywords if x.arg}}


def _as_giving(each: _Changing) -> ast.FunctionDef:
    """The function that gives back the arrays which it changes, copies of those that it is handed."""
    function = deepcopy(each.function)
    function.name, args = each.giving, function.args
    args.kwonlyargs += map(ast.arg, each.beside)
    args.kw_defaults += [None] * len(each.beside)
    others = [arg.arg for arg in (*args.posonlyargs, *args.args, *args.kwonlyargs)]
    others += [arg.arg for arg in (args.vararg, args.kwarg) if arg]
    begun = list[ast.stmt]()
    for name in each.changed:
        beside: list[ast.expr] = [ast.Name(other, ast.Load()) for other in others if other != name]
        copied = call("handed", function, *(ast.Name(x, ast.Load()) for x in (name, each.giving)), *beside)
        begun.append(ast.Assign([ast.Name(name, ast.Store())], copied))
    returning = _Returning(each.changed)
    body = [*map(returning.visit, function.body), returning.visit_Return(ast.Return(None))]
    function.body = [*begun, *body]
    return function


class _Returning(ast.NodeTransformer):
    """What a function gives, behind the arrays that it has changed."""

    def __init__(self, changed: Sequence[str]) -> None:
        self.changed = changed

    def visit_Return(self, node: ast.Return) -> ast.Return:
        changed = (ast.List([ast.Name(x, ast.Load())], ast.Load()) for x in self.changed)
        back = [ast.Call(ast.Name("recorded back", ast.Load()), [each], []) for each in changed]
        node.value = ast.Tuple([*back, node.value or ast.Constant(None)], ast.Load())
        return node


# --- what the calls do -----------------------------------------------------------------------------------------------


def handed(array: Any, function: FunctionType, *others: Any) -> Any:
    """A copy of an array, in its place in a function that nothing else hands it to; what is none itself."""
    if not is_array(array):
        return array
    memory = Memory([function, *others], function.__globals__)
    memory.follow()
    if not memory.arrays.isdisjoint(map(id, (owner(array), array, *either_of(array)))):
        raise NotRecorded(OTHER_NAME)
    return array.copy()


def back(values: list[Any]) -> Any:
    """The one array that a function has changed, and of which it has told nobody; an element that is not set else."""
    if not is_array(values[0]):
        return NOT_SET
    unshared(values)
    return values[0]


def copied(value: Any) -> Any:
    """A copy of an array; what is none itself."""
    return value.copy() if is_array(value) else value


def of_caller(result: Any, new: tuple[Any, ...], arrays: tuple[Any, ...]) -> Any:
    """What a function gives, which may be the arrays that it was handed, as the caller knows these."""
    for one, array in zip(new, arrays, strict=True):
        if result is one and one is not NOT_SET:
            return array
    if isinstance(result, tuple) and type(result) is tuple:
        return tuple(of_caller(each, new, arrays) for each in result)
    if not Memory([result], {}).arrays.isdisjoint(map(id, new)):
        raise NotRecorded(OTHER_NAME)
    return result


CALLS: dict[str, Any] = {
    "handed": handed, "back": back, "of_caller": of_caller, "unshared": unshared, "copied": copied,
}  # fmt: skip
