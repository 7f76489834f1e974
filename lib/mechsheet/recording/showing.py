"""What a cell draws at its end: the expressions that give what it shows, and the drawings in a value."""

import ast
import re
import sys
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import lru_cache
from itertools import chain
from types import FunctionType
from typing import Any

from mechsheet.quantities.lines import SLIDER, Recording
from mechsheet.quantities.quantity import Quantity
from mechsheet.recording.forms import by_percent, formatted
from mechsheet.recording.memory import names_of
from mechsheet.worksheet import source
from mechsheet.worksheet.cells import Cell, Worksheet
from mechsheet.worksheet.drawing import Drawing
from mechsheet.worksheet.title import SideBySide, Slider

HERE = "shown here"  # name of what an expression gives
_ARRANGED = {"typeset", "side_by_side"}  # calls that show their arguments
_NUMBERS = re.compile(r"\b(Table|Figure|Check)\b")  # in what a function says that it gives
_WRITTEN = {"caption", "check", "figure", "player", "slider", "summary", "table"}  # calls that show no drawing


def cells(sheet: Worksheet, needed: Sequence[Cell]) -> list[Cell]:
    """Further cells that can be run after some, and that only show something."""
    known = {"g", *sheet.common, *chain.from_iterable(cell.gives for cell in needed)}
    return [cell for cell in sheet.cells if not cell.gives and cell.needs <= known and _shows(cell)]


def _shows(cell: Cell) -> bool:
    return bool(expressions(cell) or texts(cell) or captions(cell))


def expressions(cell: Cell) -> list[ast.expr]:
    """The expressions whose values a cell shows and that may be drawings or marks, in their order."""
    match cell.lines[-1:]:
        case [ast.Expr(shown)]:
            return list(_singly(shown))
    return []


def functions(sheet: Worksheet) -> frozenset[str]:
    """Names of functions that give a table, a figure or a check: by what they say, or by those that they call."""
    lines = [line for cell in sheet.cells for line in cell.lines]
    given = (
        alias
        for line in lines
        if isinstance(line, ast.ImportFrom) and line.module == "mechsheet"
        for alias in line.names
    )
    common = {each.asname or each.name: getattr(sys.modules["mechsheet"], each.name, None) for each in given}
    own = {name: f for name, f in {**common, **sheet.common}.items() if isinstance(f, FunctionType)}
    found = {name for name, f in own.items() if _NUMBERS.search(str(f.__annotations__.get("return", "")))}
    named = {name: {*names_of(f.__code__)} for name, f in own.items() if f.__globals__ is sheet.common}
    for line in lines:
        if isinstance(line, ast.FunctionDef):
            named[line.name] = {node.id for node in source.nodes(line) if isinstance(node, ast.Name)}
    while new := {name for name, of in named.items() if found & of} - found:
        found |= new
    return frozenset(found)


def without_name(sheet: Worksheet, known: Iterable[str], showing: frozenset[str]) -> list[Cell]:
    """Cells that give nothing that is shown, but show a table, a figure or a check under no name, of what is known."""
    at_hand = {*known}
    return [cell for cell in sheet.cells if cell.needs <= at_hand and _shows_some(cell.lines, showing)]


@lru_cache(maxsize=4096)
def _shows_some(lines: Sequence[ast.stmt], showing: frozenset[str]) -> bool:
    return any(on_the_page(line, showing) for line in lines)


@lru_cache(maxsize=4096)
def on_the_page(statement: ast.stmt, showing: frozenset[str]) -> tuple[ast.stmt, ...]:
    """Statements of their own for the tables, figures and checks that a statement shows under no name."""
    if not any(isinstance(node, ast.Name) and node.id in showing for node in source.nodes(statement)):  # as of most
        return ()
    return tuple(ast.fix_missing_locations(ast.Expr(call)) for call in _calls(statement, showing))


def _calls(node: ast.AST, showing: frozenset[str]) -> list[ast.expr]:
    match node:
        case ast.Call(ast.Name(name)) if name in showing:
            return [node]
        case ast.ListComp() | ast.SetComp() | ast.DictComp() | ast.GeneratorExp():
            some = any(_calls(part, showing) for part in ast.iter_child_nodes(node))
            return [ast.copy_location(ast.Call(ast.Name("list", ast.Load()), [node], []), node)] if some else []
        case ast.Lambda() | ast.FunctionDef() | ast.ClassDef():
            return []
    return [call for part in ast.iter_child_nodes(node) for call in _calls(part, showing)]


def texts(cell: Cell) -> list[ast.expr]:
    """The text in which a cell ends, and those between what it shows, where they are others for other inputs."""
    shown = [part for line in cell.lines for call in source.calls_of(line, "typeset") for part in call.args]
    notes = _notes(cell)
    parts = [_prose(part, notes) or part for part in shown]
    match cell.lines[-1:]:
        case [ast.Expr(last)] if text := _prose(last, notes):
            parts.append(text)
    return [text for text in parts if _follows(text)]


def _prose(shown: ast.expr, notes: Mapping[str, ast.expr]) -> ast.expr | None:
    """The text of ``mo.md(text)``, or of a note."""
    match shown:
        case ast.Call(ast.Attribute(ast.Name("mo"), "md"), [text]):
            return text
        case ast.Name(name):
            return notes.get(name)
    return None


def _notes(cell: Cell) -> dict[str, ast.expr]:
    """The texts of what a cell calls ``note = mo.md(text)``, of which no later line of it binds a name anew."""
    notes = dict[str, ast.expr]()
    for line in cell.lines:
        bound = {
            node.id for node in source.nodes(line) if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store)
        }
        notes = {name: text for name, text in notes.items() if bound.isdisjoint({name, *_names(text)})}
        match line:
            case ast.Assign([ast.Name(name)], ast.Call() as call) if text := _prose(call, {}):
                notes[name] = text
    return notes


def _names(text: ast.expr) -> set[str]:
    return {node.id for node in source.nodes(text) if isinstance(node, ast.Name)}


def _follows(text: ast.expr) -> bool:
    """Whether a text may be another one for other inputs: one with numbers in it, under a name too, or put together."""
    match text:
        case ast.BinOp(left, ast.Add(), right):
            return _follows(left) or _follows(right)
        case ast.BinOp():
            return by_percent(text) is not None
        case ast.Call(ast.Attribute(of, "replace")):
            return _follows(of)
        case ast.Call(ast.Attribute(_, "join")):
            return True
        case ast.Call():
            return formatted(text) is not None
    return isinstance(text, ast.JoinedStr | ast.Name | ast.IfExp)


def captions(cell: Cell) -> dict[str, ast.expr]:
    """Titles with numbers in them, by the numbers of their captions."""
    found = dict[str, ast.expr]()
    for call in (node for line in cell.lines for node in source.nodes(line)):
        match call:
            case ast.Call(ast.Name("caption"), [ast.Constant(str(number)), ast.JoinedStr() as title]):
                found[number] = title
    return found


def stands(cell: Cell, text: Any) -> bool:
    """Whether a text stands in a cell as an argument, whatever the inputs are, or is none."""
    if not isinstance(text, str):  # but one with recorded numbers in it, which nobody looks at here
        return False
    calls = (node for line in cell.lines for node in source.nodes(line) if isinstance(node, ast.Call))
    given = (part for call in calls for part in (*call.args, *(keyword.value for keyword in call.keywords)))
    return not text or any(isinstance(part, ast.Constant) and part.value == text for part in given)


def _singly(shown: ast.expr) -> Iterator[ast.expr]:
    match shown:
        case ast.Call(ast.Name(name), args) if name in _ARRANGED:
            parts = args
        case ast.Tuple(parts) | ast.List(parts):
            pass
        case ast.Starred(value):
            parts = [value]
        case ast.Name() | ast.Call(ast.Name()):
            if not (isinstance(shown, ast.Call) and shown.func.id in _WRITTEN):  # type: ignore[attr-defined]
                yield shown
            return
        case _:
            return
    for part in parts:
        yield from _singly(part)


def bound(expression: ast.expr) -> ast.stmt:
    """A statement that binds the value of an expression to `HERE`."""
    bind = ast.copy_location(ast.Assign([ast.Name(HERE, ast.Store())], expression), expression)
    return ast.fix_missing_locations(bind)


def drawings(shown: Any) -> Iterator[Drawing]:
    """Drawings in what is shown, in their order."""
    match shown:
        case Drawing():
            yield shown
        case SideBySide(columns):
            yield from drawings(columns)
        case tuple() | list():
            for part in shown:
                yield from drawings(part)


def slid(recording: Recording, name: str, made: Slider, own: Slider) -> Slider:
    """A slider whose position is an input of the recording, and its end an argument where that rests on others."""
    leaf = recording.inputs[SLIDER + name] = recording.graph.leaf("input", SLIDER + name, own.value)
    recording.graph.sliders.add(leaf)
    position: Any = Quantity(recording.graph, leaf)
    if isinstance(made.stop, Quantity):
        recording.arguments[f"slider {name} stop"] = made.stop.re
    return replace(own, value=position)
