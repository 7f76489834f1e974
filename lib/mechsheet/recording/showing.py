"""What a cell draws at its end: the expressions that give what it shows, and the drawings in a value."""

import ast
from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import chain
from typing import Any

from mechsheet.recording.lines import SLIDER, Recording
from mechsheet.recording.quantity import Quantity
from mechsheet.worksheet import source
from mechsheet.worksheet.cells import Cell, Worksheet
from mechsheet.worksheet.drawing import Drawing
from mechsheet.worksheet.title import SideBySide, Slider

HERE = "shown here"  # name of what an expression gives
_ARRANGED = {"typeset", "side_by_side"}  # calls that show their arguments
_WRITTEN = {"caption", "check", "figure", "player", "slider", "summary", "table"}  # calls that show no drawing


def cells(sheet: Worksheet, needed: Sequence[Cell]) -> list[Cell]:
    """Further cells that can be run after some, and that only show something."""
    known = {"g", *sheet.common, *chain.from_iterable(cell.gives for cell in needed)}
    return [cell for cell in sheet.cells if not cell.gives and cell.needs <= known and _shows(cell)]


def _shows(cell: Cell) -> bool:
    return bool(expressions(cell) or text(cell) or captions(cell))


def expressions(cell: Cell) -> list[ast.expr]:
    """The expressions whose values a cell shows and that may be drawings or marks, in their order."""
    match cell.lines[-1:]:
        case [ast.Expr(shown)]:
            return list(_singly(shown))
    return []


def text(cell: Cell) -> ast.expr | None:
    """The text in which a cell ends, where it is one with numbers in it."""
    match cell.lines[-1:]:
        case [ast.Expr(ast.Call(ast.Attribute(ast.Name("mo"), "md"), [ast.JoinedStr() as shown]))]:
            return shown
    return None


def captions(cell: Cell) -> dict[str, ast.expr]:
    """Titles with numbers in them, by the numbers of their captions."""
    found = dict[str, ast.expr]()
    for call in (node for line in cell.lines for node in source.nodes(line)):
        match call:
            case ast.Call(ast.Name("caption"), [ast.Constant(str(number)), ast.JoinedStr() as title]):
                found[number] = title
    return found


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


def slid(recording: Recording, name: str, own: Slider) -> Slider:
    """A slider whose position is an input of the recording."""
    leaf = recording.inputs[SLIDER + name] = recording.graph.leaf("input", SLIDER + name, own.value)
    position: Any = Quantity(recording.graph, leaf)
    return replace(own, value=position)
