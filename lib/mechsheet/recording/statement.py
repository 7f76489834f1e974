"""A statement of a worksheet before it is recorded: its code, what it binds, changes and reads."""

import ast
import builtins
import dis
import sys
from collections.abc import Iterable, Iterator, Mapping, Sequence, Set
from functools import lru_cache
from inspect import signature
from itertools import chain
from traceback import walk_tb
from types import CodeType, FunctionType
from typing import Any, NamedTuple

import numpy as np

from mechsheet.recording.forms import as_choice, changed_in_place
from mechsheet.recording.memory import operations
from mechsheet.recording.rewritten import compiled
from mechsheet.recording.shows import shows
from mechsheet.recording.ways import former, turned
from mechsheet.worksheet import source
from mechsheet.worksheet.altered import altered, held_by, turned_through
from mechsheet.worksheet.check import Check, check, check_slope
from mechsheet.worksheet.find import find
from mechsheet.worksheet.source import bound
from mechsheet.worksheet.system import minerr
from mechsheet.worksheet.table import figure, table

_TEXTS = {"typeset", "print"}  # calls whose result stands on the page alone
_ARGUMENTS = {
    f.__name__: list(signature(f).parameters) for f in (Check, check, check_slope, find, minerr, table, figure)
}
_SCOPES = ast.Lambda, ast.FunctionDef, ast.ListComp, ast.SetComp, ast.DictComp, ast.GeneratorExp
_OWN = "mechsheet", "numpy", "contextlib", "__main__"  # which hand on what they are given
_BUILT_IN = frozenset(vars(builtins))
_BINDING = {"STORE_GLOBAL", "DELETE_GLOBAL"}
_BESIDE = {"unit", "unknown_unit", "show", "reason"}  # arguments that no writer shows beside numbers of other inputs


class Statement(NamedTuple):
    """What there is to know of a statement before it is run."""

    code: CodeType
    touched: tuple[str, ...]  # names that it binds, or whose value it changes
    loaded: frozenset[str]
    heard: frozenset[str]  # of these what it takes for more than the units and the reasons of what it shows
    parts: frozenset[str]  # attributes that it reads, of whatever
    whole: bool  # whether it hands on the inputs as a whole
    in_place: frozenset[str]  # names whose values it changes in place where these are arrays
    changed: frozenset[str]  # of these names those that it binds to nothing else
    at_once: bool  # whether it changes them once all that it reads is read
    within: frozenset[str]  # names of what holds arrays that it changes in place
    shows: tuple[tuple[str, int], ...]  # names whose elements it may change by names of its own
    former: frozenset[str]  # names that may be what they were before, or are made of that
    calls: frozenset[str]  # functions that it calls by a name of Python's own ones
    renamed: frozenset[str]  # of these names those that functions in it have for their own
    columns: tuple[frozenset[str], ...]  # of each column of a table or a figure, what it takes of ``heard``


@lru_cache(maxsize=4096)
def facts(statement: ast.stmt, path: str, exact: bool = False) -> Statement:
    nodes = source.nodes(statement)
    attributes = [n for n in nodes if isinstance(n, ast.Attribute)]
    names = [n for n in nodes if isinstance(n, ast.Name) and isinstance(n.ctx, ast.Load)]
    if any(isinstance(n, _SCOPES) for n in nodes):  # else all of them are the worksheet's
        names = [*source.read(statement)]
    own = frozenset(turned([statement]) if isinstance(statement, ast.For | ast.While) else ())
    names = [n for n in names if n.id not in own]
    of_parts = {id(n.value) for n in attributes}
    functions = (n for n in nodes if isinstance(n, ast.Lambda | ast.FunctionDef))
    calls = _BUILT_IN.intersection(n.func.id for n in nodes if isinstance(n, ast.Call) and isinstance(n.func, ast.Name))
    beside = {id(n) for argument in _beside(nodes) for n in source.nodes(argument)}
    return Statement(
        compiled(statement, path, exact),
        touched(statement),
        frozenset(n.id for n in names),
        frozenset(n.id for n in names if id(n) not in beside),
        frozenset(n.attr for n in attributes),
        any(n.id == "g" and id(n) not in of_parts for n in names),
        frozenset(_of_worksheet(nodes, _in_place(nodes))),
        frozenset[str]().union(*changed_in_place([statement])),
        isinstance(statement, ast.Assign | ast.AugAssign) and len(getattr(statement, "targets", [0])) == 1,
        frozenset(_of_worksheet(nodes, _within(nodes))),
        tuple(shows(statement, nodes)),
        frozenset(former(statement)),
        calls,
        calls.intersection(chain.from_iterable(map(source.local, functions)) if calls else ()),
        tuple(_columns(statement)),
    )


def is_own(name: str, recorded: Mapping[str, Any], computed: Mapping[str, Any]) -> bool:
    """Whether a name of one of Python's functions is that of another one among the names of a worksheet."""
    value = computed.get(name, recorded.get(name))
    if isinstance(value, type):
        return value is not getattr(builtins, name)
    if isinstance(recorded.get(name), FunctionType) and recorded[name].__globals__ is recorded:
        return True
    return callable(value) and getattr(value, "__name__", name) != name and value is not getattr(np, name, None)


def _of_worksheet(nodes: Iterable[ast.AST], found: Iterable[ast.Name]) -> Iterator[str]:
    """Those of the names that are found among some nodes that are not a function's own."""
    own = set[int]()
    for function in nodes:
        if isinstance(function, ast.Lambda | ast.FunctionDef):
            local = source.local(function)
            own.update(id(n) for n in source.nodes(function) if isinstance(n, ast.Name) and n.id in local)
    yield from (name.id for name in found if id(name) not in own)


def _columns(statement: ast.stmt) -> Iterator[frozenset[str]]:
    """Names that each column of a table or a figure reads, with those that all of it reads."""
    match statement:
        case ast.Assign([ast.Name()], ast.Call(ast.Name("table" | "figure"), [number, title, *columns], keywords)):
            others = (_heard(keyword) for keyword in keywords if keyword.arg not in _BESIDE)
            common = _names(number).union(_names(title), *others)
            if not any(isinstance(column, ast.Starred) for column in columns):
                yield from (common | _names(column) for column in columns)


def _heard(keyword: ast.keyword) -> frozenset[str]:
    """Names on which all columns rest for an argument; on the positions of marks none does."""
    if keyword.arg == "marks" and isinstance(keyword.value, ast.Dict):
        return frozenset[str]().union(*(_names(key) for key in keyword.value.keys if key is not None))
    return _names(keyword.value)


def _names(node: ast.expr) -> frozenset[str]:
    return frozenset(n.id for n in source.nodes(node) if isinstance(n, ast.Name))


@lru_cache(maxsize=4096)
def touched(statement: ast.stmt) -> tuple[str, ...]:
    """Names that a statement binds, or whose value it changes."""
    nodes = source.nodes(statement)
    return tuple(dict.fromkeys([*bound(statement), *_of_worksheet(nodes, _changed(nodes))]))


@lru_cache(maxsize=4096)
def apart(statement: ast.stmt) -> tuple[ast.stmt, ...]:
    """A statement that puts values together, such as checks, as one for each: what is seen for one is not the others'.

    The last one is the statement itself with the names of the others; there are none where nothing is put together.
    """
    match statement:
        case ast.Assign([ast.Name() as target], ast.Tuple(parts) | ast.List(parts)) if len(parts) > 1:
            lines, names = list[ast.stmt](), list[ast.expr]()
            for k, part in enumerate(parts):
                value = part.value if isinstance(part, ast.Starred) else part
                known: ast.expr = value
                if not isinstance(value, ast.Name | ast.Constant):
                    lines.append(ast.Assign([ast.Name(f"_part {k}", ast.Store())], value))
                    known = ast.Name(f"_part {k}", ast.Load())
                names.append(known if value is part else ast.Starred(known, ast.Load()))
            together = (ast.List if isinstance(statement.value, ast.List) else ast.Tuple)(names, ast.Load())
            made = (ast.copy_location(line, statement) for line in (*lines, ast.Assign([target], together)))
            return tuple(map(ast.fix_missing_locations, made))
    return ()


@lru_cache(maxsize=4096)
def names_apart(statement: ast.stmt) -> tuple[ast.stmt, ...]:
    """A statement that gives several names a value each as one for each, where no value reads these names."""
    match statement:
        case ast.Assign([ast.Tuple(targets)], ast.Tuple(values)) if len(targets) == len(values):
            names = {target.id for target in targets if isinstance(target, ast.Name)}
            alone = len(names) == len(values) and not any(isinstance(value, ast.Starred) for value in values)
            if alone and names.isdisjoint(frozenset[str]().union(*map(_names, values))):
                made = (ast.Assign([target], value) for target, value in zip(targets, values, strict=True))
                return tuple(ast.fix_missing_locations(ast.copy_location(line, statement)) for line in made)
    return ()


@lru_cache(maxsize=4096)
def texts_apart(statement: ast.stmt) -> tuple[ast.stmt, ...]:
    """A choice that binds texts beside numbers as one of each: of the texts Python sees which."""
    values = dict[str, list[ast.expr]]()
    if isinstance(statement, ast.Match):
        statement = as_choice(statement) or statement
    if not isinstance(statement, ast.If) or not _assigned(statement, values):
        return (statement,)
    texts = {n for n, each in values.items() if all(isinstance(v, ast.Constant) and type(v.value) is str for v in each)}
    read = {n.id for n in source.nodes(statement) if isinstance(n, ast.Name) and isinstance(n.ctx, ast.Load)}
    if not texts or texts == values.keys() or not texts.isdisjoint(read):
        return (statement,)
    return _of_names(statement, texts), _of_names(statement, values.keys() - texts)


def _assigned(line: ast.stmt, values: dict[str, list[ast.expr]]) -> bool:
    """Whether a statement does nothing but give single names values, which are added to those known."""
    match line:
        case ast.If(_, body, orelse):
            return all([_assigned(each, values) for each in (*body, *orelse)])
        case ast.Assign([ast.Tuple(targets)], ast.Tuple(each)) if len(targets) == len(each):
            lines = (ast.Assign([target], value) for target, value in zip(targets, each, strict=True))
            return all([_assigned(one, values) for one in lines])
        case ast.Assign([ast.Name(name)], value) | ast.AugAssign(ast.Name(name), _, value):
            values.setdefault(name, []).append(value)
            return True
    return isinstance(line, ast.Pass)


def _of_names(line: ast.stmt, names: Set[str]) -> ast.stmt:
    """A choice that binds some of its names alone."""
    match line:
        case ast.If(test, body, orelse):
            then, otherwise = ([_of_names(each, names) for each in way] for way in (body, orelse))
            return ast.copy_location(ast.If(test, then, otherwise), line)
        case ast.Assign([ast.Tuple(targets)], ast.Tuple(each)):
            kept = [(t, v) for t, v in zip(targets, each, strict=True) if isinstance(t, ast.Name) and t.id in names]
            names_kept = ast.Tuple([t for t, _ in kept], ast.Store())
            values_kept = ast.Tuple([v for _, v in kept], ast.Load())
            return ast.fix_missing_locations(ast.copy_location(ast.Assign([names_kept], values_kept), line))
        case ast.Assign([ast.Name(name)]) | ast.AugAssign(ast.Name(name)) if name in names:
            return line
    return ast.copy_location(ast.Pass(), line)


def _beside(nodes: Iterable[ast.AST]) -> Iterator[ast.expr]:
    """Arguments that are the unit or the reason of what is shown: the one stays right, the other goes."""
    for node in nodes:
        match node:
            case ast.Call(ast.Name(name), args, keywords) if name in _ARGUMENTS:
                yield from (arg for role, arg in zip(_ARGUMENTS[name], args, strict=False) if role in _BESIDE)
                yield from (keyword.value for keyword in keywords if keyword.arg in _BESIDE)


def on_the_page(statement: ast.stmt) -> bool:
    """Whether a statement shows a text or a value, which is of no other use."""
    match statement:
        case ast.Expr(ast.Call(ast.Attribute(ast.Name("mo"), name))):
            return name != "stop"
        case ast.Expr(ast.Constant() | ast.Name()):
            return True
        case ast.Expr(ast.Call(ast.Name(name))):
            return name in _TEXTS
    return False


def _changed(nodes: Sequence[ast.AST]) -> Iterator[ast.Name]:
    """Names of what a statement may change in place: a list that something is appended to, an array's element."""
    for node in nodes:
        match node:
            case ast.Call(ast.Attribute(ast.Name() as name, "append" | "extend" | "insert" | "update" | "add")):
                yield name
    yield from chain.from_iterable(map(held_by, turned_through(nodes, [*altered(nodes)])))
    yield from _in_place(nodes)


def _in_place(nodes: Sequence[ast.AST]) -> Iterator[ast.Name]:
    """Names whose values a statement changes in place where these are arrays, parts of them also."""
    arrays = [*altered(nodes)]
    alone = (turns for turns in turned_through(nodes, arrays) if isinstance(turns, ast.Tuple | ast.List))
    return chain.from_iterable(map(held_by, (*arrays, *alone)))


def _within(nodes: Sequence[ast.AST]) -> Iterator[ast.Name]:
    """Names of what holds arrays that a statement changes in place: as elements, parts, or for turns."""
    arrays = [*altered(nodes)]
    parts = (array for array in arrays if not isinstance(array, ast.Name))
    return chain.from_iterable(map(held_by, (*turned_through(nodes, arrays), *parts)))


@lru_cache(maxsize=4096)
def shared_names(code: CodeType) -> frozenset[str]:
    """Names of the worksheet that functions in a piece of code bind."""
    inside = [constant for constant in code.co_consts if isinstance(constant, CodeType)]
    binds = not operations(code).isdisjoint(_BINDING)
    own = {i.argval for i in dis.get_instructions(code) if i.opname in _BINDING} if binds else set[str]()
    return frozenset(own.union(*map(shared_names, inside)))


def taker(error: BaseException) -> str:
    """What of another package a statement had handed quantities to when an error was raised; "" for none."""
    told = ""
    for frame, _ in walk_tb(error.__traceback__):
        package = str(frame.f_globals.get("__name__", "")).partition(".")[0]
        kind = type(frame.f_locals["self"]) if "self" in frame.f_locals else None
        if package not in sys.modules or package in _OWN or (kind and kind.__module__.startswith("mechsheet.")):
            continue
        of = f"{package}'s {kind.__name__ if kind else frame.f_code.co_name}"
        if "<locals>" not in frame.f_code.co_qualname:  # what decorates a function has no name of its own
            return of
        told = told or of
    return told
