"""Lines of a cell that declare a quantity: its name, expression, unit, meaning and value; equations to be solved."""

import ast
import json
import re
import sys
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any

import numpy as np

from mechsheet import units
from mechsheet.worksheet import source
from mechsheet.worksheet.errors import SheetError, refuse

_DECLARED = re.compile(r"\[([^\]]*)\]\s*(.*)")
_REGISTRY = "__formulas__"


@dataclass(frozen=True)
class Formula:
    """One line ``name = expression  # [unit] meaning``; ``arguments`` are those of a function line."""

    name: str
    expression: ast.expr
    unit: str
    meaning: str
    arguments: tuple[str, ...] = ()


@dataclass(frozen=True)
class Given:
    """The equation of a solve block: ``expression`` must become ``target``."""

    expression: ast.expr
    target: ast.expr


def declared(comment: str, place: str) -> tuple[str, str] | None:
    """Unit and meaning of a comment ``[unit] meaning``; None where a comment declares nothing.

    Raises SheetError naming the place where the unit is not known.
    """
    match = _DECLARED.match(comment)
    if not match:
        return None
    try:
        units.parse(match[1])
    except ValueError as error:
        raise SheetError(f"{place}: {error}") from None
    return match[1], match[2]


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
            case ast.Assign([ast.Name(name)], expression):
                arguments: tuple[str, ...] = ()
            case ast.FunctionDef(name, body=[*_, ast.Return(ast.expr() as expression)]):
                expression = _on_its_branch(node, expression)
                arguments = tuple(a.arg for a in node.args.args if a.arg != "branch")
            case _:
                continue
        line = node.end_lineno or node.lineno
        found = declared(cell.comments.get(line, ""), cell.at(line))
        if found and not name.startswith("_"):
            yield Formula(name, expression, *found, arguments)


@lru_cache(maxsize=1000)
def _assigned(cell: source.Cell) -> tuple[str, ...]:
    """Names that the lines of a cell may declare."""
    assigned = (target for node in cell.body if isinstance(node, ast.Assign) for target in node.targets)
    functions = (node.name for node in cell.body if isinstance(node, ast.FunctionDef))
    return (*(target.id for target in assigned if isinstance(target, ast.Name)), *functions)


def _on_its_branch(node: ast.FunctionDef, expression: ast.expr) -> ast.expr:
    """The expression with the assembly branch that the function takes unless it is told another."""
    if not (node.args.args and node.args.args[-1].arg == "branch" and node.args.defaults):
        return expression
    default = ast.unparse(node.args.defaults[-1])
    text = re.sub(r"\bbranch\b", default, ast.unparse(expression))
    return ast.copy_location(ast.parse(text, mode="eval").body, expression)


def _equation(f: ast.expr) -> ast.expr:
    """What a function given to find computes, where it is written in the call."""
    return f.body if isinstance(f, ast.Lambda) else f


def registry(namespace: Mapping[str, Any]) -> Mapping[str, Formula]:
    """Formulas that the cells of a running worksheet have declared so far, by name."""
    known: Mapping[str, Formula] = namespace.get(_REGISTRY, {})
    return known


def typeset(*shown: Any, display: Mapping[str, str] | None = None) -> "Typeset":
    """Formulas of the calling cell with their values, then whatever else is ``shown``: the last line of a cell.

    Reads the cell's own source, so nothing is typed twice; declares each name's unit and meaning to the
    tables and figures below. Nothing is rendered until the page asks. ``display`` gives another display unit
    for some of the declared ones, such as ``{"kgf": "N"}``.

    Raises SheetError naming the line where a unit is not known.
    """
    frame = sys._getframe(1)
    known = frame.f_globals.setdefault(_REGISTRY, {})
    rows: list[Formula | Given] = []
    cell = source.cell(frame)
    try:
        lines = formulas(cell)
    except SheetError as error:
        refuse(error)
    for name in _assigned(cell):  # an edited line that has lost its unit must not keep the former one
        known.pop(name, None)
    for row in lines:
        if isinstance(row, Given):
            rows.append(row)
            continue
        if display and row.unit in display:
            row = replace(row, unit=display[row.unit])
        known[row.name] = row
        rows.append(row)
    values = tuple(frame.f_globals[row.name] if isinstance(row, Formula) else None for row in rows)
    return Typeset(tuple(rows), values, shown, Numbers(frame.f_globals))


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
class Typeset:
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

    def _mime_(self) -> tuple[str, str]:
        # In a bundle: plain HTML is parsed four times a run, in search of headings for the outline.
        return "application/vnd.marimo+mimebundle", json.dumps({"text/html": self.html})

    @property
    def html(self) -> str:
        """The lines as they stand in the page."""
        from mechsheet.page.lines import markup  # TODO-MERGE

        return markup(self)
