"""The parts of a worksheet in the order of its file, as data for whoever writes them: from the file and one run."""

import ast
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from inspect import cleandoc
from pathlib import Path
from typing import Any

from mechsheet.worksheet import source
from mechsheet.worksheet.cells import load
from mechsheet.worksheet.errors import raised
from mechsheet.worksheet.inputs import Used
from mechsheet.worksheet.lines import Formula, Given, Typeset
from mechsheet.worksheet.title import Player

_HEADING = re.compile(r"^(#+) +(.*\S)\s*$", re.MULTILINE)
_OF_PAGE = {"ask", "export", "save_scene"}  # what they show is there to be pressed or filled in


@dataclass(frozen=True)
class Section:
    """A heading; ``level`` 2 is that of a section, 3 of one in it."""

    level: int
    title: str


@dataclass(frozen=True)
class Text:
    """Text between formulas, in Markdown with formulas between dollar signs."""

    markdown: str


@dataclass(frozen=True)
class Line:
    """A line with its value in SI; None for a line that is a function."""

    formula: Formula
    value: Any


@dataclass(frozen=True)
class Control:
    """A slider by the name that the formulas read, its range, its position, and whether it turns on at its end."""

    name: str
    label: str
    start: float
    stop: float
    step: float | None
    value: float
    turning: bool


def contents(worksheet: str | Path, g: Any = None) -> list[Any]:
    """What a worksheet shows, in the order of its file.

    These are `Section`, `Text`, `Line`, `Given`, `Control`, the inputs as `Used`, and the values that cells show as
    they are: title, captions, drawings, columns of them, tables, figures, found values, checks and their summary.
    ``g`` are the inputs, by default the worksheet's own. The worksheet is run once.

    Raises SheetError where the file, an input or the mechanism cannot be used.
    """
    sheet = load(worksheet)
    g = sheet.inputs() if g is None else g
    nodes = source.functions(ast.parse(Path(sheet.path).read_text(encoding="utf-8")))
    written = {id(cell): node for cell, node in zip(sheet.cells, nodes, strict=True)}  # cells may have one name
    labels = {name: label for node in written.values() for name, label in _labels(node)}
    kept = [cell for cell in sheet.cells if "g" not in cell.gives and not _asks(written[id(cell)])]
    names = {**sheet.common, "g": g}
    parts: dict[int, list[Any]] = {id(cell): [Used(g)] if "g" in cell.gives else [] for cell in sheet.cells}
    with raised():
        ordered = sheet.needed([name for cell in kept for name in cell.gives], names)
        for cell in [*ordered, *(cell for cell in kept if not cell.gives)]:
            shown = _shown(written[id(cell)], sheet.path, names)
            parts[id(cell)] = [part for value in shown for part in _parts(value, names, labels)]
    return [part for cell in sheet.cells for part in parts[id(cell)]]


def _asks(node: ast.FunctionDef) -> bool:
    """Whether a cell shows what is there to be filled in or pressed."""
    calls = (call.func for call in ast.walk(node) if isinstance(call, ast.Call))
    return any(isinstance(called, ast.Name) and called.id in _OF_PAGE for called in calls)


def _labels(node: ast.FunctionDef) -> Iterator[tuple[str, str]]:
    """Names of the sliders of a cell and their labels."""
    for statement in node.body:
        match statement:
            case ast.Assign([ast.Name(name)], ast.Call(ast.Attribute(_, "slider"), _, keywords)):
                yield name, next((source.constant(k.value) for k in keywords if k.arg == "label"), "")


def _last(node: ast.FunctionDef) -> ast.expr | None:
    """The expression in which a cell ends, whose value it shows."""
    match node.body[-2:]:
        case [ast.Expr(last), _]:
            return last
    return None


def _shown(node: ast.FunctionDef, path: str, names: dict[str, Any]) -> Iterator[Any]:
    """Run a cell; what it shows."""
    last, text = _last(node), source.markdown(node)
    exec(compile(ast.Module(node.body[: -1 if last is None else -2], []), path, "exec"), names)
    if text is not None:
        yield from _texts(str(eval(compile(ast.Expression(text), path, "eval"), names)))
    elif last is not None:
        yield eval(compile(ast.Expression(last), path, "eval"), names)


def _texts(markdown: str) -> Iterator[Section | Text]:
    """Headings of a text and what stands between them."""
    pieces = _HEADING.split(cleandoc(markdown))
    if pieces[0].strip():
        yield Text(pieces[0].strip())
    for marks, title, text in zip(pieces[1::3], pieces[2::3], pieces[3::3], strict=True):
        yield Section(len(marks), title)
        if text.strip():
            yield Text(text.strip())


def _parts(value: Any, names: Mapping[str, Any], labels: Mapping[str, str]) -> Iterator[Any]:
    """A value by itself, or the parts that it shows one after the other."""
    match value:
        case None:
            return
        case Typeset():
            for row, x in zip(value.rows, value.values, strict=True):
                yield row if isinstance(row, Given) else Line(row, None if row.arguments else x)
            for shown in value.shown:
                yield from _parts(shown, names, labels)
        case Player(slider, turning):
            yield _control(slider, turning, names, labels)
        case _ if all(hasattr(value, part) for part in ("start", "stop", "step", "value")):
            yield _control(value, False, names, labels)
        case tuple() | list():
            for each in value:
                yield from _parts(each, names, labels)
        case _:
            yield value


def _control(slider: Any, turning: bool, names: Mapping[str, Any], labels: Mapping[str, str]) -> Control:
    name = next(name for name in labels if names.get(name) is slider)
    return Control(name, labels[name], slider.start, slider.stop, slider.step, slider.value, turning)
