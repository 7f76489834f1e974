"""Lines of a cell that declare a quantity: its name, expression, unit, meaning and value; equations to be solved."""

import ast
import re
import sys
from bisect import bisect
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import pairwise, starmap
from operator import attrgetter
from typing import Any, NamedTuple

import numpy as np

from mechsheet import units
from mechsheet.worksheet import source
from mechsheet.worksheet.branch import branches, on_its_branch, untold
from mechsheet.worksheet.cells import Worksheet
from mechsheet.worksheet.errors import SheetError, refuse
from mechsheet.worksheet.shown import Shown
from mechsheet.worksheet.verdict import asks_values_only

_DECLARED = re.compile(r"\[([^\]]*)\]\s*(.*)")
_ONE_NUMBER = r"\(\d{1,3}(?:\.\d+)*[a-z]?\)"
_NUMBER = re.compile(rf"{_ONE_NUMBER}(?:\s*[-–,]\s*{_ONE_NUMBER})*(?=\s|$)")


@dataclass(frozen=True)
class Formula:
    """One line ``name = expression  # [unit] (1.26) meaning``.

    ``number`` is that of the printed formula, in its brackets: ``(1.26)``, ``(1.13), (1.14)``, or nothing.
    ``arguments`` are those of a function, by lambda or def; ``where`` its own names with what they stand for. The
    expression of a function with more than branches and such names in it is ``...``. ``constants`` are the names of
    units in it, as they are written, with the units. ``mistake`` tells why the unit is not known, and the value shown
    in SI.
    """

    name: str
    expression: ast.expr
    unit: str
    meaning: str
    arguments: tuple[str, ...] = ()
    where: tuple[tuple[str, ast.expr], ...] = ()
    number: str = ""
    constants: tuple[tuple[str, str], ...] = ()
    mistake: str = ""


@dataclass(frozen=True)
class Given:
    """An equation of a solve block: ``expression`` must become ``target``; ``first`` of the block or a further one.

    ``name`` is what the block is bound to.
    """

    expression: ast.expr
    target: ast.expr
    first: bool = True
    constants: tuple[tuple[str, str], ...] = ()
    name: str = ""


class Declared(NamedTuple):
    """What a comment ``[unit] meaning`` declares, and why its unit is not known."""

    unit: str
    meaning: str
    mistake: str


def declared(comment: str, expression: ast.expr | None = None) -> Declared | None:
    """Unit, in signs that Python reads, and meaning of a comment behind an expression; None where it declares nothing.

    Of a temperature no unit is known but K, for °C is that of a difference.
    """
    match = _DECLARED.match(comment)
    if not match:
        return None
    unit, mistake = _read(match[1])
    if unit == "degC" and expression and _temperatures(expression) == 1:
        unit, mistake = units.UNKNOWN, f"unit [{match[1]}] is of a difference: write a temperature in [K]"
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
    known = branches(cell.body)
    for node in cell.body:
        match node:
            case ast.Assign([ast.Name(name)], ast.Call(ast.Name("find" | "minerr"), [f, *_], keywords)):
                yield from _given(name, f, next((k.value for k in keywords if k.arg == "equals"), ast.Constant(0)))
                continue
            case ast.Expr(ast.JoinedStr()):
                raise SheetError(f"{cell.at(node.lineno)}: a text with values in it belongs to mo.md or to typeset")
        lines, number = _bound(node), node.end_lineno or node.lineno
        found = _declared_each(cell.comments.get(number, ""), cell.at(number), lines) if lines else ()
        for line, told in zip(lines, found, strict=False):
            if several := _several(line.expression):
                raise SheetError(
                    f"{cell.at(number)}: {line.name} = {several} is several values: "
                    "a decimal number has a point, not a comma"
                )
            if not line.name.startswith("_"):
                printed = match[0] if (match := _NUMBER.match(told.meaning)) else ""
                meaning = told.meaning.removeprefix(printed).lstrip()
                line = replace(line, unit=told.unit, number=printed, meaning=meaning, mistake=told.mistake)
                own = tuple((name, untold(value, known)) for name, value in line.where)
                yield replace(line, expression=untold(line.expression, known), where=own)


def _several(expression: ast.expr) -> str:
    """An expression where values apart by commas stand for one number; "" where none do."""
    match expression:  # without brackets of its own it begins where its first part does
        case ast.Tuple([first, *_]) if first.col_offset == expression.col_offset:
            return ast.unparse(expression)[1:-1]
    for node in source.nodes(expression):
        match node:
            case ast.BinOp(ast.Tuple([ast.Constant(), _]), _, _) | ast.BinOp(_, _, ast.Tuple([ast.Constant(), _])):
                return ast.unparse(expression)
    return ""


def _temperatures(expression: ast.expr) -> int:
    """How many temperatures an expression adds, less those that it subtracts: one where it is a temperature itself."""
    match expression:
        case ast.Call(ast.Name("celsius") | ast.Attribute(attr="celsius")):
            return 1
        case ast.BinOp(left, ast.Add(), right):
            return _temperatures(left) + _temperatures(right)
        case ast.BinOp(left, ast.Sub(), right):
            return _temperatures(left) - _temperatures(right)
    return 0


def undeclaring(cell: source.Cell, node: ast.stmt) -> Iterator[int]:
    """Lines of a statement whose comment is a unit that declares nothing, where its last line declares nothing either.

    As within a function, a loop or a choice.
    """
    last = node.end_lineno or node.lineno
    if isinstance(node, ast.ClassDef) or (_bound(node) and declared(cell.comments.get(last, ""))):
        return
    for line in range(node.lineno, last + 1):
        told = declared(cell.comments.get(line, ""))
        if told and not told.mistake:
            yield line


def _bound(node: ast.stmt) -> list[Formula]:
    """What a statement binds names to, without a unit as yet."""
    match node:
        case ast.FunctionDef(name, args, body):
            where, given = _body(body)
            expression = on_its_branch(args, given) if given else ast.copy_location(ast.Constant(...), node)
            return [Formula(name, expression, "", "", _named(args), where)]
        case ast.Assign([ast.Name(name)], ast.Lambda(args, value)):
            return [Formula(name, on_its_branch(args, value), "", "", _named(args))]
        case ast.Assign([ast.Name(name)], expression) | ast.AnnAssign(ast.Name(name), _, ast.expr() as expression):
            return [Formula(name, expression, "", "")]
        case ast.Assign([ast.Tuple(targets)], expression):
            names = [target.id for target in targets if isinstance(target, ast.Name)]
            if len(names) == len(targets):
                return [Formula(name, _element(expression, n), "", "") for n, name in enumerate(names)]
    return []


def _declared_each(comment: str, place: str, lines: Sequence[Formula]) -> Iterator[Declared]:
    """Unit and meaning of each name of a line; several are told as ``[m] one, [s] other``."""
    count = len(lines)
    parts = re.split(r",\s*(?=\[)", comment) if count > 1 else [comment]
    expressions = (*(line.expression for line in lines[: len(parts)]), *[None] * (len(parts) - count))
    found = [told for part, own in zip(parts, expressions, strict=True) if (told := declared(part, own))]
    if found and len(found) != count:
        raise SheetError(f"{place}: {count} names need {count} units, such as # [m] one, [s] other; got {len(found)}")
    yield from found


def _named(args: ast.arguments) -> tuple[str, ...]:
    return tuple(a.arg for a in args.args if a.arg != "branch")


def _element(expression: ast.expr, n: int) -> ast.expr:
    """What the n-th name of several is bound to."""
    if isinstance(expression, ast.Tuple | ast.List) and not any(isinstance(e, ast.Starred) for e in expression.elts):
        return expression.elts[n]
    index = ast.copy_location(ast.Constant(n), expression)
    return ast.copy_location(ast.Subscript(expression, index, ast.Load()), expression)


def _body(body: Sequence[ast.stmt]) -> tuple[tuple[tuple[str, ast.expr], ...], ast.expr | None]:
    """Own names of a function and what it gives, its branches as a choice; None where it does anything else."""
    match body:
        case [ast.Return(ast.expr() as value)]:
            return (), value
        case [ast.Expr(ast.Constant(str())), *rest]:
            return _body(rest)
        case [ast.Assign([ast.Name(name)], value), *rest]:
            where, result = _body(rest)
            return ((name, value), *where), result
        case [ast.If(test, yes, no), *rest]:
            (own, chosen), (others, other) = _body(yes), _body([*no, *rest])
            if chosen and other and not own and not others:
                return (), ast.copy_location(ast.IfExp(test, chosen, other), test)
    return (), None


def _given(name: str, f: ast.expr, target: ast.expr) -> Iterator[Given]:
    """The equations of a solve block: what its function computes where it is written in the call, else the function."""
    left = f.body if isinstance(f, ast.Lambda) else f
    several = left.elts if isinstance(left, ast.Tuple) else [left]
    targets = target.elts if isinstance(target, ast.Tuple) else [target] * len(several)
    for n, (expression, wanted) in enumerate(zip(several, targets, strict=False)):
        yield Given(expression, wanted, n == 0, name=name)


def registry(namespace: Mapping[str, Any], cells: tuple[source.Cell, ...] | None = None) -> Mapping[str, Formula]:
    """Lines of the running worksheet that declare what is in the namespace, by name, in the order of its source.

    ``cells`` are those of the worksheet where the namespace is a copy and does not tell.

    Raises SheetError where a line is asked for in whose cell names and units do not match.
    """
    return _Registry(_lines(source.cells(namespace) if cells is None else cells), namespace)


def of_setup(sheet: Worksheet) -> Mapping[str, Formula]:
    """Lines of the setup that end in a unit, which typeset shows nowhere: constants of all cells."""
    try:
        found = formulas(source.Cell(sheet.setup, sheet.comments, sheet.path))
    except SheetError:  # no line of a cell, so that nothing keeps it from being a comment only
        return {}
    return {line.name: line for line in found if isinstance(line, Formula)}


class _Registry(Mapping[str, Formula]):
    """Lines that declare what there is; each in the unit in which its cell displays it."""

    def __init__(self, lines: Mapping[str, "_Line | SheetError"], namespace: Mapping[str, Any]) -> None:
        self.lines, self.namespace = lines, namespace

    def __getitem__(self, name: str) -> Formula:
        line = self.lines[name]
        if isinstance(line, SheetError):
            raise line
        if name not in self.namespace:
            raise KeyError(name)
        return line.shown(self.namespace)

    def __iter__(self) -> Iterator[str]:
        return (name for name, line in self.lines.items() if isinstance(line, _Line) and name in self.namespace)

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
def _lines(cells: tuple[source.Cell, ...]) -> dict[str, _Line | SheetError]:
    """Lines of the cells by name; of a cell that cannot be read the reason, by every name that it may declare."""
    found = dict[str, _Line | SheetError]()
    for cell in cells:
        display = next(filter(None, map(_display, cell.body)), None)
        try:
            found |= {row.name: _Line(row, display) for row in formulas(cell) if isinstance(row, Formula)}
        except SheetError as error:
            found |= {line.name: error for node in cell.body for line in _bound(node)}
    return found


def _display(node: ast.stmt) -> ast.expr | None:
    """Display units that a statement of a cell gives to typeset."""
    for call in source.nodes(node):
        match call:
            case ast.Call(ast.Name("typeset"), _, keywords):
                return next((k.value for k in keywords if k.arg == "display"), None)
    return None


def typeset(*shown: Any, display: Mapping[str, str] | None = None) -> "Typeset":
    """Formulas of the calling cell with their values, then whatever else is ``shown``: the last line of a cell.

    Where a cell calls it again, each call has the lines above it that no call above it has. Reads the cell's own
    source, so nothing is typed twice. Nothing is rendered until the page asks. A text is Markdown; one that stands by
    itself among the lines, a string and nothing else, is shown where it stands. ``display`` gives another display unit
    for some of the declared ones, such as ``{"kgf": "N"}``, to tables and figures too: a dictionary as it is written,
    or a name of the worksheet. A line whose unit is not known is shown in SI, and why.

    Raises SheetError naming the line whose names and units do not match.
    """
    frame = sys._getframe(1)
    cell, here = source.cell(frame), frame.f_lineno
    above = max((end for end in typeset_lines(cell) if end < here), default=0)
    try:
        lines = [row for row in formulas(cell) if above < row.expression.lineno < here]
        between = [text for text in source.standing(cell.body) if above < text.lineno < here]
    except SheetError as error:
        refuse(error)
    rows = [_displayed(row, display or {}) if isinstance(row, Formula) else row for row in lines]
    values = tuple(frame.f_globals[row.name] if isinstance(row, Formula) else None for row in rows)
    for row, value in zip(rows, values, strict=True):
        if isinstance(row, Formula) and (why := no_number(row, value)):
            refuse(SheetError(f"{cell.at(row.expression.lineno)}: {why}"))
    if asks_values_only():
        return Typeset((), (), shown)
    rows = [_with_constants(row, frame.f_globals) for row in rows]
    known = Numbers(frame.f_globals)
    if not between:
        return Typeset(tuple(rows), values, shown, known)
    parts = list[Any]()
    begins = [0, *(bisect(rows, text.lineno, key=lambda row: row.expression.lineno) for text in between), len(rows)]
    for text, some in zip(["", *(text.value for text in between)], starmap(slice, pairwise(begins)), strict=True):
        parts += [text, Typeset(tuple(rows[some]), values[some], (), known)]
    return Typeset((), (), (*parts[1:], *shown))


def no_number(row: Formula, value: Any) -> str:
    """Why the value of a line cannot have its unit: it is neither a number, nor an array of them, nor a function."""
    computes = hasattr(value, "__array_ufunc__") and not isinstance(value, np.ndarray | np.generic)
    if row.arguments or computes or isinstance(value, int | float | complex):
        return ""
    try:
        kind = np.asarray(value).dtype.kind
    except ValueError:  # of rows that differ in length
        kind = "O"
    return "" if kind in "biufc" else f"{row.name} = {ast.unparse(row.expression)} is no number: it has no [unit]"


def _with_constants(row: Formula | Given, namespace: Mapping[str, Any]) -> Formula | Given:
    """A line with the units among the names that it reads."""
    found = ((name, _of_unit(name, namespace)) for name in names_read(row))
    constants = tuple((name, value.unit) for name, value in found if isinstance(value, units.Constant))
    return replace(row, constants=constants) if constants else row


def _of_unit(name: str, namespace: Mapping[str, Any]) -> Any:
    head, dot, part = name.partition(".")
    value = namespace.get(head)
    return value if not dot else getattr(units, part, None) if value is units else None


@lru_cache(maxsize=4096)
def names_read(row: Formula | Given) -> tuple[str, ...]:
    """Names that a line reads, parts of modules too, without its arguments."""
    parts = [row.expression, *((row.target,) if isinstance(row, Given) else (value for _, value in row.where))]
    nodes = (node for part in parts for node in source.nodes(part))
    named = (node for node in nodes if isinstance(node, ast.Name | ast.Attribute))
    read = (node.id if isinstance(node, ast.Name) else ast.unparse(node) for node in named)
    own = () if isinstance(row, Given) else (*row.arguments, *(name for name, _ in row.where))
    return tuple(name for name in dict.fromkeys(read) if name not in own)


@lru_cache(maxsize=1000)
def typeset_lines(cell: source.Cell) -> tuple[int, ...]:
    """Lines in which the statements of a cell end that call typeset."""
    calls = ((node, call) for node in cell.body for call in source.nodes(node) if isinstance(call, ast.Call))
    named = (node for node, call in calls if isinstance(call.func, ast.Name) and call.func.id == "typeset")
    return tuple(node.end_lineno or node.lineno for node in named)


class Numbers:
    """Values in their units by the names that formulas read, ``g.L3`` too, as they are when the page asks."""

    def __init__(self, namespace: Mapping[str, Any]) -> None:
        self.namespace, self.known = namespace, registry(namespace)

    def __contains__(self, name: object) -> bool:
        """Whether something is the name of a line or an input of the worksheet."""
        return name in self.known or name in getattr(type(self.namespace.get("g")), "__units__", {})

    def at(self, name: str, position: int) -> tuple[float | complex, str] | None:
        """SI value of a name at one position of its field, and its unit; None where that is not known."""
        head, dot, part = name.partition(".")
        value: Any = self.namespace.get(head)
        if dot:
            unit = getattr(type(value), "__units__", {}).get(part)
            value = attrgetter(part)(value) if unit else None
        else:
            line = self.known.get(name)
            unit = line.unit if line and not line.arguments else None
        if unit is None or not isinstance(value, int | float | complex | np.ndarray | np.generic) or not np.size(value):
            return None
        field = np.asarray(value)
        inside = field.shape and field.shape[-1] > position
        return (field[..., position].flat[0] if inside else field.flat[0]).item(), unit

    def single(self, names: Iterable[str]) -> frozenset[str]:
        """Of names that end as that of a field over S does those that have no positions."""
        S = np.asarray(self.namespace.get("S", 0))
        if S.ndim == 0 or S.dtype.kind not in "iuf":  # no stroke; a point may have that name too
            return frozenset(names)
        return frozenset(name for name in names if np.ndim(self.namespace.get(name, ())) == 0)


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
        shown = (part.at(position) if isinstance(part, Typeset) else part for part in self.shown)
        return replace(self, values=tuple(values), shown=tuple(shown), position=position)
