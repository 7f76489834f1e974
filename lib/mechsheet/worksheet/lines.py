"""Lines of a cell that declare a quantity: its name, expression, unit, meaning and value; equations to be solved."""

import ast
import re
from collections.abc import Iterator, Mapping, Sequence
from functools import lru_cache
from typing import Any, NamedTuple

from mechsheet import units
from mechsheet.worksheet import source
from mechsheet.worksheet.altered import changed
from mechsheet.worksheet.branch import branches, on_its_branch, untold
from mechsheet.worksheet.caret import caret
from mechsheet.worksheet.cells import Worksheet
from mechsheet.worksheet.errors import SheetError
from mechsheet.worksheet.misread import misread
from mechsheet.worksheet.source import bound

_DECLARED = re.compile(r"\[([^\]]*)\]\s*(.*)")
_ONE_NUMBER = r"\(\d{1,3}(?:\.\d+)*[a-z]?\)"
_NUMBER = re.compile(rf"{_ONE_NUMBER}(?:\s*[-–,]\s*{_ONE_NUMBER})*(?=\s|$)")


class Formula(NamedTuple):
    """One line ``name = expression  # [unit] (1.26) meaning``.

    ``number`` is that of the printed formula, in its brackets: ``(1.26)``, ``(1.13), (1.14)``, or nothing.
    ``arguments`` are those of a function, by lambda or def; ``where`` its own names with what they stand for. The
    expression of a function with more than branches and such names in it is ``...``. ``constants`` are the names of
    units in it, as they are written, with the units. ``mistake`` tells why the unit is not known, and the value shown
    in SI. ``solved`` are the names of solve blocks in it, each with one that tells the unknown, such as ``beta_found``.
    From the line ``again`` on its name has another value, which is not the line's; ``others`` are the names it reads
    that have other values once the cell has run. Where a value is ``altered`` in place by then, its own or one that it
    reads, its formula gives another one. No ``own`` function is numpy's of that name; ``shapes`` are of what it reads.
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
    solved: tuple[tuple[str, str], ...] = ()
    again: int = 0
    others: frozenset[str] = frozenset()
    altered: bool = False
    own: frozenset[str] = frozenset()
    shapes: tuple[tuple[str, tuple[int, ...]], ...] = ()

    @property
    def has_value(self) -> bool:
        """Whether the value of its name is what the line gives; a function has none."""
        return not (self.arguments or self.again)

    @property
    def adding(self) -> ast.expr:
        """What tells the terms of the value; those of one that is altered nobody knows."""
        return ast.Constant(0.0) if self.altered else self.expression


class Given(NamedTuple):
    """An equation of a solve block: ``expression`` must become ``target``; ``first`` of the block or a further one.

    ``name`` is what the block is bound to.
    """

    expression: ast.expr
    target: ast.expr
    first: bool = True
    constants: tuple[tuple[str, str], ...] = ()
    name: str = ""
    own: frozenset[str] = frozenset()
    shapes: tuple[tuple[str, tuple[int, ...]], ...] = ()


class Declared(NamedTuple):
    """What a comment ``[unit] meaning`` declares, and why its unit is not known."""

    unit: str
    meaning: str
    mistake: str


def declared(comment: str, expression: ast.expr | None = None) -> Declared | None:
    """Unit, in signs that Python reads, and meaning of a comment behind an expression; None where it declares nothing.

    One that cannot be meant of the expression is as good as unknown.
    """
    match = _DECLARED.match(comment)
    if not match:
        return None
    unit, mistake = _read(match[1])
    if expression and not mistake and (mistake := misread(unit, match[1], expression)):
        unit = units.UNKNOWN
    return Declared(unit, match[2], mistake)


def _read(unit: str) -> tuple[str, str]:
    """A unit as it is typed, and why it is not known."""
    try:
        units.parse(unit)
    except ValueError as error:
        return units.UNKNOWN, str(error)
    return units.plain(unit), ""


@lru_cache(maxsize=1000)
def formulas(cell: source.Cell, changing: tuple[ast.FunctionDef, ...] = ()) -> tuple[Formula | Given, ...]:
    """Lines of a cell that end in a unit, and the equations of its solve blocks, in their order.

    What the functions of other cells change is known of those that are ``changing`` what they are handed.
    """
    return tuple(_formulas(cell, changing))


_OR = " or "  # between the meanings of a choice
_FOUND = "_found"  # ends the name of what solves for the unknown whose name stands before it
_OF_ONE = ("lo", "hi", "guess")  # arguments of a block with one unknown


def _formulas(cell: source.Cell, changing: tuple[ast.FunctionDef, ...]) -> Iterator[Formula | Given]:
    known, earlier = branches(cell.body), dict[str, Declared]()
    binding = dict[str, list[int]]()  # statements by the names that they bind
    altering = changed(cell.body, changing)
    for k, node in enumerate(cell.body):
        for name in bound(node):
            binding.setdefault(name, []).append(k)
    for k, node in enumerate(cell.body):
        at, why = caret(node)
        if why:
            raise SheetError(f"{cell.at(at)}, {why}")
        match node:
            case ast.Assign([ast.Name(name)], ast.Call(ast.Name("find" | "minerr"), [f, *ends], keywords)):
                named = {k.arg: k.value for k in keywords}
                if isinstance(f, ast.Name) and name.endswith(_FOUND) and (ends or not named.keys().isdisjoint(_OF_ONE)):
                    unknown = ast.Name(name.removesuffix(_FOUND), ast.Load())
                    f = ast.fix_missing_locations(ast.copy_location(ast.Call(f, [unknown], []), f))
                yield from _given(name, f, named.get("equals", ast.Constant(0)))
                continue
            case ast.Expr(ast.JoinedStr()):
                raise SheetError(f"{cell.at(node.lineno)}: a text with values in it belongs to mo.md or to typeset")
        number = node.end_lineno or node.lineno
        for line, told, _ in _told(cell, node, earlier):
            earlier[line.name] = told
            if several := _several(line.expression):
                raise SheetError(
                    f"{cell.at(number)}: {line.name} = {several} is several values: "
                    "a decimal number has a point, not a comma"
                )
            if not line.name.startswith("_"):
                printed = match[0] if (match := _NUMBER.match(told.meaning)) else ""
                meaning = told.meaning.removeprefix(printed).lstrip()
                again = next((cell.body[n].lineno for n in binding.get(line.name, ()) if n > k), 0)
                anew = () if line.arguments else (name for name in names_read(line) if binding.get(name, [-1])[-1] >= k)
                own = () if line.arguments else (line.name, *names_read(line))
                yield line._replace(
                    unit=told.unit,
                    number=printed,
                    meaning=meaning,
                    mistake=told.mistake,
                    expression=untold(line.expression, known),
                    where=tuple((name, untold(value, known)) for name, value in line.where),
                    again=again,
                    others=frozenset(anew),
                    altered=any(n > k for name in own for n in altering.get(name, ())),
                )


class _Told(NamedTuple):
    """What a statement binds a name to, with what it declares of that, and in which lines; a choice on each way."""

    line: Formula
    told: Declared
    numbers: tuple[int, ...]


def _told(cell: source.Cell, node: ast.stmt, earlier: Mapping[str, Declared]) -> list[_Told]:
    if isinstance(node, ast.If):
        return _chosen(cell, node, earlier)
    lines, number = _bound(node), node.end_lineno or node.lineno
    told = _declared_each(cell.comments.get(number, ""), cell.at(number), lines) if lines else ()
    return [_Told(*each, (number,)) for each in zip(lines, told, strict=False)]


def _chosen(cell: source.Cell, node: ast.If, earlier: Mapping[str, Declared]) -> list[_Told]:
    """Names that a choice declares: each way gives them a value and the same unit, or leaves them what they were.

    Raises SheetError where the units are unlike.
    """
    yes, no = _way(cell, node.body, earlier), _way(cell, node.orelse, earlier)
    found = list[_Told]()
    for name in dict.fromkeys([*yes, *no]):
        ways = [way[name] for way in (yes, no) if name in way]
        before = [earlier[name]] if len(ways) < 2 and name in earlier else []
        told = [*(each.told for each in ways), *before]
        if len(told) < 2:
            continue
        here = ways[-1]
        if others := {each.unit for each in told} - {here.told.unit}:
            why = f"{name} is [{here.told.unit}] here and [{others.pop()}] elsewhere: one name has one unit"
            raise SheetError(f"{cell.at(here.numbers[-1])}: {why}")
        stays = ast.copy_location(ast.Name(name, ast.Load()), node)
        expressions = [way[name].line.expression if name in way else stays for way in (yes, no)]
        choice = ast.copy_location(ast.IfExp(node.test, *expressions), node)
        meanings = dict.fromkeys(part for each in told for part in each.meaning.split(_OR) if part)
        meant = told[0]._replace(meaning=_OR.join(meanings))  # whichever way it goes
        found.append(_Told(Formula(name, choice, "", ""), meant, tuple(n for each in ways for n in each.numbers)))
    return found


def _way(cell: source.Cell, body: Sequence[ast.stmt], earlier: Mapping[str, Declared]) -> dict[str, _Told]:
    """What one way of a choice declares, by name."""
    found = dict[str, _Told]()
    for node in body:
        new = _told(cell, node, earlier)
        for name in bound(node):
            found.pop(name, None)
        found |= {each.line.name: each for each in new if not each.line.arguments}
    return found


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


def undeclaring(cell: source.Cell, node: ast.stmt) -> Iterator[int]:
    """Lines of a statement whose comment is a unit that declares nothing, where its last line declares nothing either.

    As within a function, a loop or a choice.
    """
    last = node.end_lineno or node.lineno
    told = {line: declared(cell.comments[line]) for line in range(node.lineno, last + 1) if line in cell.comments}
    lines = [line for line, each in told.items() if each and not each.mistake]
    if not lines or isinstance(node, ast.ClassDef) or (told.get(last) and _bound(node)):
        return
    declaring = set[int]()
    if isinstance(node, ast.If):
        given = (line for line in formulas(cell) if isinstance(line, Formula))
        earlier = {line.name: Declared(line.unit, line.meaning, "") for line in given}
        declaring = {line for each in _chosen(cell, node, earlier) for line in each.numbers}
    yield from (line for line in lines if line not in declaring)


def on_one_way(namespace: Mapping[str, Any], name: str) -> str:
    """Place of a unit behind a name that declares nothing there, as in one way of a choice alone; "" for none."""
    for cell in source.cells(namespace):
        for node in cell.body:
            numbers = {*undeclaring(cell, node)} if name in bound(node) else set[int]()
            for part in source.nodes(node):
                if isinstance(part, ast.stmt) and part.end_lineno in numbers and name in bound(part):
                    return cell.at(part.end_lineno or 0)
    return ""


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
        case ast.AugAssign(ast.Name(name), op, value):
            before = ast.copy_location(ast.Name(name, ast.Load()), node)
            return [Formula(name, ast.copy_location(ast.BinOp(before, op, value), node), "", "")]
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
    return {line.name: line for line in _of(sheet, sheet.setup)}


def rebound(sheet: Worksheet, body: tuple[ast.stmt, ...]) -> list[Formula]:
    """Lines among some statements of a worksheet whose names others bind anew."""
    return [line for line in _of(sheet, body) if line.again]


def _of(sheet: Worksheet, body: tuple[ast.stmt, ...]) -> list[Formula]:
    """Lines of some statements of a worksheet; none where they cannot be read, which their own cell tells."""
    try:
        found = formulas(source.Cell(body, sheet.comments, sheet.path))
    except SheetError:  # in the setup nothing keeps it from being a comment only
        return []
    return [line for line in found if isinstance(line, Formula)]


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


class _Line(NamedTuple):
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
        return displayed(self.formula, display)


def displayed(line: Formula, display: Mapping[str, str]) -> Formula:
    """A line in the unit in which its cell shows what has its own."""
    if line.unit not in display:
        return line
    unit, mistake = _read(display[line.unit])
    if not mistake and (units.parse(unit).dims != units.parse(line.unit).dims or units.turned(unit, line.unit)):
        unit, mistake = units.UNKNOWN, f"unit [{display[line.unit]}] does not measure {line.unit}"
    return line._replace(unit=unit, mistake=mistake)


@lru_cache(maxsize=32)
def _lines(cells: tuple[source.Cell, ...]) -> dict[str, _Line | SheetError]:
    """Lines of the cells by name; of a cell that cannot be read the reason, by every name that it may declare."""
    found = dict[str, _Line | SheetError]()
    for cell in cells:
        display = next(filter(None, map(_display, cell.body)), None)
        try:
            found |= {row.name: _Line(row, display) for row in formulas(cell) if isinstance(row, Formula)}
        except SheetError as error:
            found |= dict.fromkeys((name for node in cell.body for name in bound(node)), error)
    return found


def _display(node: ast.stmt) -> ast.expr | None:
    """Display units that a statement of a cell gives to typeset."""
    for call in source.calls_of(node, "typeset"):
        return next((k.value for k in call.keywords if k.arg == "display"), None)
    return None


def dotted(node: ast.Attribute) -> str:
    """An attribute as it is written."""
    return f"{node.value.id}.{node.attr}" if isinstance(node.value, ast.Name) else ast.unparse(node)


@lru_cache(maxsize=4096)
def names_read(row: Formula | Given) -> tuple[str, ...]:
    """Names that a line reads, parts of modules too, without its arguments."""
    parts = [row.expression, *((row.target,) if isinstance(row, Given) else (value for _, value in row.where))]
    named = (node for part in parts for node in source.nodes(part) if isinstance(node, ast.Name | ast.Attribute))
    read = (node.id if isinstance(node, ast.Name) else dotted(node) for node in named)
    own = () if isinstance(row, Given) else (*row.arguments, *(name for name, _ in row.where))
    return tuple(name for name in dict.fromkeys(read) if name not in own)
