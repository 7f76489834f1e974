"""Lines of a cell as they are shown: formulas with their values, texts between them, and whatever else is given."""

import ast
import sys
from bisect import bisect
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache
from itertools import pairwise, starmap
from operator import attrgetter
from types import FunctionType
from typing import Any

import numpy as np

from mechsheet import units
from mechsheet.worksheet import altered, source
from mechsheet.worksheet.errors import SheetError, refuse
from mechsheet.worksheet.lines import Formula, Given, displayed, formulas, names_read, registry
from mechsheet.worksheet.numbers import existing
from mechsheet.worksheet.shapes import shapes
from mechsheet.worksheet.shown import Shown
from mechsheet.worksheet.verdict import asks_values_only


def typeset(*shown: Any, display: Mapping[str, str] | None = None) -> "Typeset":
    """Formulas of the calling cell with their values, then whatever else is ``shown``: the last line of a cell.

    Where a cell calls it again, each call has the lines above it that no call above it has. Reads the cell's own
    source, so nothing is typed twice. Nothing is rendered until the page asks. A text is Markdown; one that stands by
    itself among the lines, a string and nothing else, is shown where it stands. ``display`` gives another display unit
    for some of the declared ones, such as ``{"kgf": "N"}``, to tables and figures too: a dictionary as it is written,
    or a name of the worksheet. A line whose unit is not known is shown in SI, and why. A choice by ``if`` is a line of
    each name to which all of its ways give the same unit. Of a name that is bound twice the last line has the value.

    Raises SheetError naming the line whose names and units do not match.
    """
    frame = sys._getframe(1)
    cell, here = source.cell(frame), frame.f_lineno
    changing = () if asks_values_only() else altered.changing(source.own_functions(frame.f_globals))
    try:
        lines, between = _above(cell, here, changing)
    except SheetError as error:
        refuse(error)
    rows = [displayed(row, display) if display and isinstance(row, Formula) else row for row in lines]
    for row in rows:
        if isinstance(row, Formula) and not row.again and row.name not in frame.f_globals:
            why = f"{row.name} has no value where typeset() shows it: it is deleted before"
            refuse(SheetError(f"{cell.at(row.expression.lineno)}: {why}"))
    values = tuple(
        existing(frame.f_globals[row.name]) if isinstance(row, Formula) and not row.again else None for row in rows
    )
    for row, value in zip(rows, values, strict=True):
        if isinstance(row, Formula) and not row.again and (why := no_number(row, value)):
            refuse(SheetError(f"{cell.at(row.expression.lineno)}: {why}"))
    if asks_values_only():
        return Typeset((), (), shown)
    known = Numbers(frame.f_globals)
    if not between:
        return Typeset(tuple(rows), values, shown, known)
    parts = list[Any]()
    begins = [0, *(bisect(rows, text.lineno, key=lambda row: row.expression.lineno) for text in between), len(rows)]
    for text, some in zip(["", *(text.value for text in between)], starmap(slice, pairwise(begins)), strict=True):
        parts += [text, Typeset(tuple(rows[some]), values[some], (), known)]
    return Typeset((), (), (*parts[1:], *shown))


@lru_cache(maxsize=1000)
def _above(
    cell: source.Cell, here: int, changing: tuple[ast.FunctionDef, ...]
) -> tuple[tuple[Formula | Given, ...], tuple[ast.Constant, ...]]:
    """Lines and texts of a cell above a line, behind the typeset above that; SheetError of one that is not right."""
    above = max((end for end in typeset_lines(cell) if end < here), default=0)
    lines = tuple(row for row in formulas(cell, changing) if above < row.expression.lineno < here)
    return lines, tuple(text for text in source.standing(cell.body) if above < text.lineno < here)


def no_number(row: Formula, value: Any) -> str:
    """Why the value of a line cannot have its unit: it is neither a number, nor an array of them, nor a function."""
    if row.arguments or value is None or isinstance(value, int | float | complex):
        return ""
    if hasattr(value, "__array_ufunc__") and not isinstance(value, np.ndarray | np.generic):  # computes
        return ""
    try:
        kind = np.asarray(value).dtype.kind
    except ValueError:  # of rows that differ in length
        kind = "O"
    if kind in "biufc":
        return ""
    shown = f", typeset(f'{{{row.name}}}') shows it" if isinstance(value, str) else ""
    return f"{row.name} = {ast.unparse(row.expression)} is no number: it has no [unit]{shown}"


def _with_constants(row: Formula | Given, namespace: Mapping[str, Any], blocks: Mapping[str, str]) -> Formula | Given:
    """A line with the units and own functions among the names that it reads, and the unknowns of solve ``blocks``."""
    own = frozenset(name for name in names_read(row) if _is_own(namespace.get(name)))
    row = row._replace(own=own) if own else row
    found = ((name, _of_unit(name, namespace)) for name in names_read(row))
    constants = tuple((name, value.unit) for name, value in found if isinstance(value, units.Constant))
    row = row._replace(constants=constants) if constants else row
    known = shapes(row, namespace)
    row = row._replace(shapes=known) if known else row
    solved = tuple((name, blocks[name]) for name in names_read(row) if name in blocks)
    return row._replace(solved=solved) if solved and isinstance(row, Formula) else row


@lru_cache(maxsize=32)
def _unknowns(cells: tuple[source.Cell, ...]) -> dict[str, str]:
    """Names of solve blocks that do not end as such do, with those that tell the unknown and do."""
    found = dict[str, str]()
    for node in (node for cell in cells for node in cell.body):
        match node:
            case ast.Assign([ast.Name(name)], ast.Call(ast.Name("find" | "minerr" as kind), [f, *_])):
                unknown = f.args.args[0].arg if isinstance(f, ast.Lambda) and f.args.args else name
                ending = "_found" if kind == "find" else "_least"
                found |= {} if name.endswith(("_found", "_least")) else {name: f"{unknown}{ending}"}
    return found


def _is_own(value: Any) -> bool:
    """Whether a function is one of the worksheet's, or of a module of its own."""
    return isinstance(value, FunctionType) and str(value.__module__).partition(".")[0] not in _PACKAGES


_PACKAGES = {"numpy", "scipy", "mechsheet", "pandas"}


def _of_unit(name: str, namespace: Mapping[str, Any]) -> Any:
    head, dot, part = name.partition(".")
    value = namespace.get(head)
    return value if not dot else getattr(units, part, None) if value is units else None


@lru_cache(maxsize=1000)
def typeset_lines(cell: source.Cell) -> tuple[int, ...]:
    """Lines in which the statements of a cell end that call typeset."""
    return tuple(node.end_lineno or node.lineno for node in cell.body for _ in source.calls_of(node, "typeset"))


class Numbers:
    """Values in their units by the names that formulas read, ``g.L3`` too, as they are when the page asks."""

    def __init__(self, namespace: Mapping[str, Any]) -> None:
        self.namespace = namespace

    @cached_property
    def known(self) -> Mapping[str, Formula]:
        """Lines of the worksheet, by their names."""
        return registry(self.namespace)

    def __contains__(self, name: object) -> bool:
        """Whether something is the name of a line or an input of the worksheet."""
        return name in self.known or name in getattr(type(self.namespace.get("g")), "__units__", {})

    def at(self, name: str, position: int, of: str) -> tuple[float | complex, str] | None:
        """SI value of a name at one position of its field, and its unit; None where that is not known.

        Nor of a field in a line ``of`` which another number of positions is: that takes more than one of these.
        """
        head, dot, part = name.partition(".")
        value: Any = self.namespace.get(head)
        if dot:
            unit = getattr(type(value), "__units__", {}).get(part)
            value = attrgetter(part)(value) if unit else None
        else:
            line = self.known.get(name)
            unit = line.unit if line and line.has_value else None
        if unit is None or not isinstance(value, int | float | complex | np.ndarray | np.generic) or not np.size(value):
            return None
        field = np.asarray(value)
        if field.dtype.kind not in "iufc":  # texts and conditions are no numbers
            return None
        if field.size == 1:
            return field.item(), unit
        if field.shape[-1:] != np.shape(existing(self.namespace.get(of)))[-1:]:
            return None
        return field[..., min(position, field.shape[-1] - 1)].flat[0].item(), unit

    def single(self, names: Iterable[str]) -> frozenset[str]:
        """Of names that end as that of a field over S does those that have no positions."""
        S = np.asarray(self.namespace.get("S", 0))
        if S.ndim == 0 or S.dtype.kind not in "iuf":  # no stroke; a point may have that name too
            return frozenset(names)
        return frozenset(name for name in names if np.ndim(self.namespace.get(name, ())) == 0)


@dataclass(frozen=True, eq=False)
class Typeset(Shown):
    """Lines of a cell and their values, shown as symbol = formula = value, unit, meaning."""

    lines: tuple[Formula | Given, ...]
    values: tuple[Any, ...]
    shown: tuple[Any, ...] = ()
    numbers: Numbers | None = None
    position: int = 0

    @cached_property
    def rows(self) -> tuple[Formula | Given, ...]:
        """The lines with what the worksheet calls by the names that they read; a workbook does not ask."""
        namespace = self.numbers.namespace if self.numbers else {}
        blocks = _unknowns(source.cells(namespace))
        return tuple(_with_constants(line, namespace, blocks) for line in self.lines)

    def at(self, position: int) -> "Typeset":
        """The same formulas with the values at one position of their fields."""
        values = (np.asarray(v)[..., position] if np.ndim(v) else v for v in self.values)
        shown = (part.at(position) if isinstance(part, Typeset) else part for part in self.shown)
        return replace(self, values=tuple(values), shown=tuple(shown), position=position)
