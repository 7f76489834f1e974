"""Lines of a cell that declare a quantity: its name, expression, unit, meaning and value; equations to be solved."""

import ast
import re
import sys
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np

from mechsheet import units
from mechsheet.worksheet import source
from mechsheet.worksheet.errors import SheetError
from mechsheet.worksheet.shown import Shown

_DECLARED = re.compile(r"\[([^\]]*)\]\s*(.*)")


@dataclass(frozen=True)
class Formula:
    """One line ``name = expression  # [unit] meaning``; ``arguments`` are those of a function, by lambda or def.

    ``constants`` are the names of units in it, as they are written, with the units. ``mistake`` tells why the unit is
    not known, and the value shown in SI.
    """

    name: str
    expression: ast.expr
    unit: str
    meaning: str
    arguments: tuple[str, ...] = ()
    constants: tuple[tuple[str, str], ...] = ()
    mistake: str = ""


@dataclass(frozen=True)
class Given:
    """The equation of a solve block: ``expression`` must become ``target``."""

    expression: ast.expr
    target: ast.expr
    constants: tuple[tuple[str, str], ...] = ()


class Declared(NamedTuple):
    """What a comment ``[unit] meaning`` declares, and why its unit is not known."""

    unit: str
    meaning: str
    mistake: str


def declared(comment: str) -> Declared | None:
    """Unit, in signs that Python reads, and meaning of a comment; None where it declares nothing."""
    match = _DECLARED.match(comment)
    if not match:
        return None
    unit, mistake = _read(match[1])
    return Declared(unit, match[2], mistake)


def _read(unit: str) -> tuple[str, str]:
    """A unit as it is typed, and why it is not known."""
    try:
        units.parse(unit)
    except ValueError as error:
        return units.UNKNOWN, str(error)
    return units.plain(unit), ""


@lru_cache(maxsize=1000)
def formulas(cell: source.Cell) -> tuple[Formula | Given, ...]:
    """Lines of a cell that end in a unit, and the equations of its solve blocks, in their order."""
    return tuple(_formulas(cell))


def _formulas(cell: source.Cell) -> Iterator[Formula | Given]:
    for node in cell.body:
        match node:
            case ast.Assign([ast.Name()], ast.Call(ast.Name("find"), [f, *_], keywords)):
                target = next((k.value for k in keywords if k.arg == "equals"), ast.Constant(0))
                yield Given(_equation(f), target)
                continue
            case ast.FunctionDef(name, args, [*_, ast.Return(ast.expr() as body)]) | ast.Assign(
                [ast.Name(name)], ast.Lambda(args, body)
            ):
                expression = _on_its_branch(args, body)
                arguments = tuple(a.arg for a in args.args if a.arg != "branch")
            case ast.Assign([ast.Name(name)], expression):
                arguments = ()
            case _:
                continue
        line = node.end_lineno or node.lineno
        found = declared(cell.comments.get(line, ""))
        if found and not name.startswith("_"):
            yield Formula(name, expression, found.unit, found.meaning, arguments, mistake=found.mistake)


def _on_its_branch(args: ast.arguments, expression: ast.expr) -> ast.expr:
    """The expression with the assembly branch that the function takes unless it is told another."""
    if not (args.args and args.args[-1].arg == "branch" and args.defaults):
        return expression
    default = ast.unparse(args.defaults[-1])
    text = re.sub(r"\bbranch\b", default, ast.unparse(expression))
    return ast.copy_location(ast.parse(text, mode="eval").body, expression)


def _equation(f: ast.expr) -> ast.expr:
    """What a function given to find computes, where it is written in the call."""
    return f.body if isinstance(f, ast.Lambda) else f


def registry(namespace: Mapping[str, Any], cells: tuple[source.Cell, ...] | None = None) -> Mapping[str, Formula]:
    """Lines of the running worksheet that declare what is in the namespace, by name, in the order of its source.

    ``cells`` are those of the worksheet where the namespace is a copy and does not tell.
    """
    return _Registry(_lines(source.cells(namespace) if cells is None else cells), namespace)


class _Registry(Mapping[str, Formula]):
    """Lines that declare what there is; each in the unit in which its cell displays it."""

    def __init__(self, lines: Mapping[str, "_Line"], namespace: Mapping[str, Any]) -> None:
        self.lines, self.namespace = lines, namespace

    def __getitem__(self, name: str) -> Formula:
        if name not in self.namespace:
            raise KeyError(name)
        return self.lines[name].shown(self.namespace)

    def __iter__(self) -> Iterator[str]:
        return (name for name in self.lines if name in self.namespace)

    def __len__(self) -> int:
        return sum(1 for _ in self)


@dataclass(frozen=True)
class _Line:
    """A line as it stands in the source, and the other display units that its cell's typeset gives."""

    formula: Formula
    display: ast.expr | None

    def shown(self, namespace: Mapping[str, Any]) -> Formula:
        """The line in the unit in which it is displayed."""
        match self.display:
            case None:
                return self.formula
            case ast.Name(name):
                display = namespace.get(name) or {}
            case ast.Dict():
                display = ast.literal_eval(self.display)
            case other:
                raise SheetError(
                    f"typeset(display={ast.unparse(other)}) must be a dictionary as it is written, or a name"
                )
        return _displayed(self.formula, display)


def _displayed(line: Formula, display: Mapping[str, str]) -> Formula:
    if line.unit not in display:
        return line
    unit, mistake = _read(display[line.unit])
    return replace(line, unit=unit, mistake=mistake)


@lru_cache(maxsize=32)
def _lines(cells: tuple[source.Cell, ...]) -> dict[str, _Line]:
    """Lines of the cells by name."""
    found = dict[str, _Line]()
    for cell in cells:
        display = next(filter(None, map(_display, cell.body)), None)
        found |= {row.name: _Line(row, display) for row in formulas(cell) if isinstance(row, Formula)}
    return found


def _display(node: ast.stmt) -> ast.expr | None:
    """Display units that a statement of a cell gives to typeset."""
    for call in ast.walk(node):
        match call:
            case ast.Call(ast.Name("typeset"), _, keywords):
                return next((k.value for k in keywords if k.arg == "display"), None)
    return None


def typeset(*shown: Any, display: Mapping[str, str] | None = None) -> "Typeset":
    """Formulas of the calling cell with their values, then whatever else is ``shown``: the last line of a cell.

    Where a cell calls it again, each call has the lines above it that no call above it has. Reads the cell's own
    source, so nothing is typed twice. Nothing is rendered until the page asks. A text is Markdown. ``display``
    gives another display unit for some of the declared ones, such as ``{"kgf": "N"}``, to tables and figures too: a
    dictionary as it is written, or a name of the worksheet. A line whose unit is not known is shown in SI, and why.
    """
    frame = sys._getframe(1)
    cell, here = source.cell(frame), frame.f_lineno
    above = max((end for end in _typeset_lines(cell) if end < here), default=0)
    lines = [row for row in formulas(cell) if above < row.expression.lineno < here]
    rows = [_displayed(row, display or {}) if isinstance(row, Formula) else row for row in lines]
    rows = [_with_constants(row, frame.f_globals) for row in rows]
    values = tuple(frame.f_globals[row.name] if isinstance(row, Formula) else None for row in rows)
    return Typeset(tuple(rows), values, shown, Numbers(frame.f_globals))


def _with_constants(row: Formula | Given, namespace: Mapping[str, Any]) -> Formula | Given:
    """A line with the units among the names that it reads."""
    found = ((name, _of_unit(name, namespace)) for name in _names(row))
    constants = tuple((name, value.unit) for name, value in found if isinstance(value, units.Constant))
    return replace(row, constants=constants) if constants else row


def _of_unit(name: str, namespace: Mapping[str, Any]) -> Any:
    head, dot, part = name.partition(".")
    value = namespace.get(head)
    return value if not dot else getattr(units, part, None) if value is units else None


@lru_cache(maxsize=4096)
def _names(row: Formula | Given) -> tuple[str, ...]:
    """Names that a line reads, parts of modules too, without its arguments."""
    parts = [row.expression] if isinstance(row, Formula) else [row.expression, row.target]
    nodes = (node for part in parts for node in ast.walk(part))
    read = (ast.unparse(node) for node in nodes if isinstance(node, ast.Name | ast.Attribute))
    own = row.arguments if isinstance(row, Formula) else ()
    return tuple(name for name in dict.fromkeys(read) if name not in own)


@lru_cache(maxsize=1000)
def _typeset_lines(cell: source.Cell) -> tuple[int, ...]:
    """Lines in which the statements of a cell end that call typeset."""
    calls = ((node, call) for node in cell.body for call in ast.walk(node) if isinstance(call, ast.Call))
    named = (node for node, call in calls if isinstance(call.func, ast.Name) and call.func.id == "typeset")
    return tuple(node.end_lineno or node.lineno for node in named)


class Numbers:
    """Values in their units by the names that formulas read, ``g.L3`` too, as they are when the page asks."""

    def __init__(self, namespace: Mapping[str, Any]) -> None:
        self.namespace = namespace
        self.known = registry(namespace)

    def at(self, name: str, position: int) -> tuple[float | complex, str] | None:
        """SI value of a name at one position of its field, and its unit; None where that is not known."""
        head, dot, part = name.partition(".")
        value: Any = self.namespace.get(head)
        if dot:
            unit = _units_of(type(value)).get(part)  # type: ignore[arg-type]  # a class can be hashed
            value = getattr(value, part) if unit else None
        else:
            line = self.known.get(name)
            unit = line.unit if line and not line.arguments else None
        if unit is None or not isinstance(value, int | float | complex | np.ndarray | np.generic) or not np.size(value):
            return None
        field = np.asarray(value)
        inside = field.shape and field.shape[-1] > position
        return (field[..., position].flat[0] if inside else field.flat[0]).item(), unit


@lru_cache(maxsize=16)
def _units_of(inputs: type) -> dict[str, str]:
    """Units of the inputs of a class by their names."""
    return {field.name: field.unit for field in getattr(inputs, "__inputs__", ())}


@dataclass(frozen=True)
class Typeset(Shown):
    """Lines of a cell and their values, shown as symbol = formula = value, unit, meaning."""

    rows: tuple[Formula | Given, ...]
    values: tuple[Any, ...]
    shown: tuple[Any, ...] = ()
    numbers: Numbers | None = None
    position: int = 0

    def at(self, position: int) -> "Typeset":
        """The same formulas with the values at one position of their fields."""
        values = (np.asarray(v)[..., position] if np.ndim(v) else v for v in self.values)
        return replace(self, values=tuple(values), position=position)
