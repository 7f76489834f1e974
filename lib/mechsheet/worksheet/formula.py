"""Formulas of a cell: each line's symbol, expression, unit and meaning, typeset with the value it gave."""

import ast
import html
import re
import sys
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cache, cached_property, lru_cache
from typing import Any, NamedTuple

import numpy as np

from mechsheet import units
from mechsheet.worksheet import source, symbol
from mechsheet.worksheet.errors import SheetError, refuse
from mechsheet.worksheet.shown import Shown

_DECLARED = re.compile(r"\[([^\]]*)\]\s*(.*)")


@dataclass(frozen=True)
class Formula:
    """One line ``name = expression  # [unit] meaning``; ``arguments`` are those of a function line."""

    name: str
    expression: ast.expr
    unit: str
    meaning: str
    arguments: tuple[str, ...] = ()

    @cached_property
    def symbol(self) -> str:
        """Left side in LaTeX: the symbol, of a function with its arguments."""
        arguments = r",\,".join(symbol.latex(a) for a in self.arguments)
        return symbol.latex(self.name) + (f"({arguments})" if arguments else "")

    @cached_property
    def tex(self) -> str:
        """Right side in LaTeX; nothing where it is a number or says the same as the left."""
        right = "" if isinstance(self.expression, ast.Constant) else latex(self.expression)
        return "" if right == self.symbol else right

    @cached_property
    def names(self) -> tuple[str, ...]:
        """What the right side reads, as it is written."""
        return tuple(dict.fromkeys(filter(None, map(_read_as, ast.walk(self.expression)))))


@dataclass(frozen=True)
class Given:
    """The equation of a solve block: ``expression`` must become ``target``."""

    expression: ast.expr
    target: ast.expr

    @cached_property
    def tex(self) -> str:
        """The equation in LaTeX."""
        return rf"\text{{Given}}\quad {latex(self.expression)} = {latex(self.target)}"


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


def registry(namespace: Mapping[str, Any], cells: tuple[source.Cell, ...] | None = None) -> Mapping[str, Formula]:
    """Lines of the running worksheet that declare what is in the namespace, by name, in the order of its source.

    ``cells`` are those of the worksheet where the namespace is a copy and does not tell.

    Raises SheetError where a line is asked for in whose cell a unit is not known.
    """
    return _Registry(_lines(source.cells(namespace) if cells is None else cells), namespace)


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
            case other:
                display = ast.literal_eval(other)
        return _displayed(self.formula, display)


def _displayed(line: Formula, display: Mapping[str, str]) -> Formula:
    return replace(line, unit=display[line.unit]) if line.unit in display else line


@lru_cache(maxsize=32)
def _lines(cells: tuple[source.Cell, ...]) -> dict[str, _Line | SheetError]:
    """Lines of the cells by name; of a cell that cannot be read the reason, by every name that it may declare."""
    found = dict[str, _Line | SheetError]()
    for cell in cells:
        display = next(filter(None, map(_display, cell.body)), None)
        try:
            found |= {row.name: _Line(row, display) for row in formulas(cell) if isinstance(row, Formula)}
        except SheetError as error:
            assigned = (target for node in cell.body if isinstance(node, ast.Assign) for target in node.targets)
            found |= {target.id: error for target in assigned if isinstance(target, ast.Name)}
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

    Reads the cell's own source, so nothing is typed twice. Nothing is rendered until the page asks. ``display``
    gives another display unit for some of the declared ones, such as ``{"kgf": "N"}``, to tables and figures too: a
    dictionary as it is written, or a name of the worksheet.

    Raises SheetError naming the line where a unit is not known.
    """
    frame = sys._getframe(1)
    try:
        lines = formulas(source.cell(frame))
    except SheetError as error:
        refuse(error)
    rows = [_displayed(row, display or {}) if isinstance(row, Formula) else row for row in lines]
    values = tuple(frame.f_globals[row.name] if isinstance(row, Formula) else None for row in rows)
    return Typeset(tuple(rows), values, shown, _Numbers(frame.f_globals))


class _Numbers:
    """Values in their units by the names that formulas read, ``g.L3`` too, as they are when the page asks."""

    def __init__(self, namespace: Mapping[str, Any]) -> None:
        self.namespace = namespace
        self.known = registry(namespace)

    def text(self, name: str, position: int) -> str | None:
        """Value of a name at one position of its field in LaTeX; None where its unit is not known."""
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
        return value_latex(
            field[..., position].flat[0] if field.shape and field.shape[-1] > position else field.flat[0], unit
        )


@lru_cache(maxsize=16)
def _units_of(inputs: type) -> dict[str, str]:
    """Units of the inputs of a class by their names."""
    return {field.name: field.unit for field in getattr(inputs, "__inputs__", ())}


@dataclass(frozen=True)
class Typeset(Shown):
    """Formulas and their values, shown as symbol = formula = value, unit, meaning."""

    rows: tuple[Formula | Given, ...]
    values: tuple[Any, ...]
    shown: tuple[Any, ...] = ()
    numbers: _Numbers | None = None
    position: int = 0

    def at(self, position: int) -> "Typeset":
        """The same formulas with the values at one position of their fields."""
        values = (np.asarray(v)[..., position] if np.ndim(v) else v for v in self.values)
        return replace(self, values=tuple(values), position=position)

    @property
    def html(self) -> str:
        """The lines as they stand in the page."""
        lines = [
            _line(row.tex) if isinstance(row, Given) else self._formula(row, value)
            for row, value in zip(self.rows, self.values, strict=True)
        ]
        return "".join([*lines, *map(markup, self.shown)])

    def _formula(self, row: Formula, value: Any) -> str:
        formula = " = ".join(filter(None, (row.symbol, row.tex)))
        if row.arguments:
            return _line(formula, "", row.meaning)
        numbers = "" if self.numbers is None else _substituted(row, self.numbers, self.position)
        return _line(f"{formula} =", value_html(value, row.unit), row.meaning, numbers)


def markup(value: Any) -> str:
    """What the page shows of a value, as HTML."""
    if isinstance(value, Typeset):
        return value.html
    kind, text = value._mime_() if hasattr(value, "_mime_") else ("", "")
    if kind == "text/html":
        return str(text)
    import marimo as mo

    return mo.as_html(value).text


def _line(tex: str, value: str = "", meaning: str = "", numbers: str = "") -> str:
    """A typeset line; its numbers wait in an attribute until the reader asks for them.

    The value is an element of its own: where it alone changes, the browser keeps the formula as it has set it, and the
    value is there with the output that holds it.
    """
    more = f'<ms-numbers tex="{html.escape("= " + numbers)}"></ms-numbers>' if numbers else ""
    typeset = _tex_element(tex) + (f'<span class="ms-value">{value}</span>' if value else "")
    return (
        f'<div class="ms-line"><span class="ms-formula">{typeset}</span><span>{html.escape(meaning)}</span>{more}</div>'
    )


def _tex_element(tex: str) -> str:
    return f'<marimo-tex class="arithmatex">||(\\displaystyle {html.escape(tex)}||)</marimo-tex>'


def _read_as(node: ast.AST) -> str:
    """Name under which a formula reads a quantity, ``g.L3`` too; "" for anything else."""
    match node:
        case ast.Attribute(ast.Name("g"), name):
            return f"g.{name}"
        case ast.Name(name):
            return name
    return ""


def _substituted(row: Formula, numbers: _Numbers, position: int) -> str:
    """The right side with numbers for its symbols; nothing where it has none."""
    found = {name: text for name in row.names if (text := numbers.text(name, position)) is not None}
    return latex(row.expression, found) if found and row.tex else ""


class _Notation(NamedTuple):
    """How the parts of a value are written."""

    power: str  # of ten, behind a number
    none: str
    infinite: str
    pair: str
    span: str
    degrees: str
    percent: str
    unit: str
    raised: str
    times: str  # between units


_LATEX = _Notation(
    r"{} \cdot 10^{{{}}}", r"\text{none}", r"\infty", r"({},\ {})", r" \,\ldots\, ", r"^\circ", r"\,\%",
    r"\ \mathrm{{{}}}", r"^{{{}}}", r"\cdot ",
)  # fmt: skip
_HTML = _Notation(
    "{}\u2009·\u200910<sup>{}</sup>", "none", "∞", "({}, {})", " … ", "°", " %", " {}", "<sup>{}</sup>", "·"
)  # fmt: skip


def number_latex(x: float) -> str:
    """Number with five significant digits or all before the point; as a power of ten outside 1e-3..1e6."""
    return _number(x, _LATEX)


def value_latex(value: Any, unit: str) -> str:
    """Value in its display unit; a field of positions as first .. last, a point or a vector as a pair."""
    return _value(value, unit, _LATEX)


def value_html(value: Any, unit: str) -> str:
    """The same for the page, which shows text at once and LaTeX later."""
    return _value(value, unit, _HTML).replace("-", "−")


def _number(x: float, to: _Notation) -> str:
    if not np.isfinite(x):
        return to.none if np.isnan(x) else ("" if x > 0 else "-") + to.infinite
    if 1e5 <= abs(x) < 1e6:
        return f"{x:.0f}"
    if x == 0 or 1e-3 <= abs(x) < 1e5:
        return np.format_float_positional(float(f"{x:.5g}") + 0.0, trim="-")  # + 0.0: no sign of zero
    mantissa, exponent = f"{x:.4e}".split("e")
    return to.power.format(mantissa.rstrip("0").rstrip("."), int(exponent))


def _value(value: Any, unit: str, to: _Notation) -> str:
    field = np.asarray(value)
    ends = [field.item()] if field.ndim == 0 else [field.flat[0].item(), field.flat[-1].item()]
    return to.span.join(_end(end, unit, to) for end in ends) + _unit(unit, to)


@lru_cache(maxsize=4096, typed=True)  # most numbers stay when an input changes; 0 and 0j are not shown alike
def _end(end: float | complex, unit: str, to: _Notation) -> str:
    z = end / units.parse(unit).factor
    return to.pair.format(_number(z.real, to), _number(z.imag, to)) if isinstance(z, complex) else _number(z, to)


@cache
def _unit(unit: str, to: _Notation) -> str:
    special = {"-": "", "deg": to.degrees, "%": to.percent}
    if unit in special:
        return special[unit]
    powers = re.sub(r"\*\*(-?\d+)", lambda power: to.raised.format(power[1]), unit)
    return to.unit.format(powers.replace("*", to.times))


_SYMBOL = re.compile(rf"([A-Z]+|{'|'.join(symbol.GREEK)})(_|$)")  # VC, eps_BC
_FUNCTIONS = {
    "sin": r"\sin", "cos": r"\cos", "tan": r"\tan", "asin": r"\arcsin", "acos": r"\arccos", "atan": r"\arctan",
    "angle": r"\arg", "exp": r"\exp", "log": r"\ln", "maximum": r"\max", "minimum": r"\min",
    "max": r"\max", "nanmax": r"\max", "min": r"\min", "nanmin": r"\min", "sum": r"\textstyle\sum ",
}  # fmt: skip
_ANGULAR = ("sin", "cos", "tan")
_COMPARISONS = {ast.Lt: "<", ast.LtE: r"\le", ast.Gt: ">", ast.GtE: r"\ge", ast.Eq: "=", ast.NotEq: r"\ne"}
_RATES = {"ds": r"\dot{s}", "dds": r"\ddot{s}"}  # parts of a result that the rule for names does not know


def latex(node: ast.expr, numbers: Mapping[str, str] | None = None) -> str:
    """Expression in LaTeX: fractions, roots, powers, no brackets that the reader does not need.

    ``numbers`` are texts to stand for some names, ``g.L3`` too.
    """
    return _Writer(numbers or {}).text(node)


class _Writer:
    """Writes expressions; a text comes with the precedence of its outermost operation (5: needs no brackets)."""

    def __init__(self, numbers: Mapping[str, str]) -> None:
        self.numbers = numbers

    def text(self, node: ast.expr) -> str:
        return self.write(node)[0]

    def write(self, node: ast.expr) -> tuple[str, int]:
        if self.numbers and (number := self.numbers.get(_read_as(node))):
            return number, 5 if number.replace(".", "").isdigit() else 1 if number.startswith("-") else 2
        if positive := _without_minus(node):
            return f"-{self.text(positive)}", 1
        match node:
            case ast.Constant(value):
                return _constant(value)
            case ast.Name(name):
                return symbol.latex(name), 5
            case ast.Attribute(ast.Name("g"), name):
                return symbol.latex(name), 5
            case ast.Attribute(inner, ("real" | "imag") as part):
                return rf"\operatorname{{{'Re' if part == 'real' else 'Im'}}} {self.wrap(inner, 5)}", 2
            case ast.Attribute(ast.Name(name), "value") if name.endswith("_found"):
                return rf"\operatorname{{Find}}({symbol.latex(name.removesuffix('_found'))})", 5
            case ast.Attribute(ast.Name(name), "value"):  # of a slider or field of the page
                return symbol.latex(name), 5
            case ast.Attribute(ast.Name(name), part):  # a result of several parts
                return rf"{_part(part)}(\text{{{name.replace('_', ' ')}}})", 5
            case ast.Attribute(ast.Call() as inner, part):
                return rf"{_part(part)}\left[{self.text(inner)}\right]", 5
            case ast.UnaryOp((ast.USub() | ast.UAdd()) as sign, inner):
                return ("-" if isinstance(sign, ast.USub) else "+") + self.wrap(inner, 3), 1
            case ast.BinOp(left, ast.Div(), right):
                return rf"\frac{{{self.text(left)}}}{{{self.text(right)}}}", 5
            case ast.BinOp(ast.Call(ast.Name(name), args), ast.Pow(), right) if name in _ANGULAR:
                return rf"{_FUNCTIONS[name]}^{{{self.text(right)}}} {self.brackets(args)}", 4
            case ast.BinOp(left, ast.Pow(), right):
                base = self.wrap(left, 5)
                base = rf"\left({base}\right)" if base.startswith(r"\frac") else base
                return f"{base}^{{{self.text(right)}}}", 4
            case ast.BinOp(left, ast.Mult(), right):
                return self.product(left, right), 2
            case ast.BinOp(left, ast.Mod(), right):
                return rf"{self.wrap(left, 2)} \bmod {self.wrap(right, 2)}", 1
            case ast.BinOp(left, (ast.Add() | ast.Sub()) as op, right):
                sign_text = "+" if isinstance(op, ast.Add) else "-"
                second = self.wrap(right, 1 if sign_text == "+" else 2)
                return f"{self.wrap(left, 1)} {sign_text} {self.brackets([right]) if second[0] == '-' else second}", 1
            case ast.Compare(left, [op], [right]) if type(op) in _COMPARISONS:
                return f"{self.wrap(left, 1)} {_COMPARISONS[type(op)]} {self.wrap(right, 1)}", 0
            case ast.Call(ast.Name(name), args, keywords):
                written = [*args, *(k.value for k in keywords)]
                return self.call(name, [a for a in written if not (isinstance(a, ast.Name) and a.id == "branch")])
            case ast.Call(ast.Attribute(ast.Name("np"), name), args):
                return self.call(name, args)
            case ast.Subscript(inner, index):
                return f"{{{self.wrap(inner, 5)}}}_{{{self.text(index)}}}", 5
            case ast.Starred(inner):
                return self.write(inner)
            case ast.List(items):
                return r"\left[" + r",\ ".join(map(self.text, items)) + r"\right]", 5
            case ast.Tuple(items):
                return r"\left(" + r",\ ".join(map(self.text, items)) + r"\right)", 5
        return r"\texttt{" + re.sub(r"([#$%&_{}])", r"\\\1", ast.unparse(node)) + "}", 5

    def wrap(self, node: ast.expr, level: int) -> str:
        text, precedence = self.write(node)
        return text if precedence >= level else self.brackets([node])

    def product(self, left: ast.expr, right: ast.expr) -> str:
        match right:
            case ast.UnaryOp():
                b = self.brackets([right])
            case ast.BinOp(op=ast.Div()):
                b = self.wrap(right, 2)
            case _:
                b = self.wrap(right, 4 if isinstance(right, ast.BinOp) else 2)
        a = self.wrap(left, 2)
        if bare := re.search(r"\\(sin|cos|tan) (?!.*(sin|cos|tan) )(\S+)$", a):  # what follows is not its argument
            a = f"{a[: bare.start()]}\\{bare[1]}({bare[3]})"
        return a + (r" \cdot " if b[0].isdigit() or b.startswith("(-") else r"\,") + b

    def brackets(self, args: list[ast.expr]) -> str:
        inner = r",\ ".join(map(self.text, args))
        return rf"\left({inner}\right)" if re.search(r"\\frac|\\left|\^\{", inner) else f"({inner})"

    def call(self, name: str, args: list[ast.expr]) -> tuple[str, int]:
        match name, args:
            case "sqrt", [x]:
                return rf"\sqrt{{{self.text(x)}}}", 5
            case "hypot", _:
                return rf"\sqrt{{{' + '.join(f'{self.wrap(a, 5)}^2' for a in args)}}}", 5
            case "abs", [x]:
                return rf"\left|{self.text(x)}\right|", 5
            case "conj", [x]:
                return rf"\overline{{{self.text(x)}}}", 5
            case "exp", [x]:
                return rf"e^{{{self.text(x)}}}", 4
            case "cross", [a, b]:
                return rf"{self.wrap(a, 2)} \times {self.wrap(b, 2)}", 1
            case "dot", [a, b]:
                return rf"{self.wrap(a, 2)} \cdot {self.wrap(b, 2)}", 2
            case "arange", [stop]:
                return rf"0,\,1\,\ldots\,{self.before(stop)}", 0
            case "arange", [start, stop]:
                return rf"{self.text(start)}\,\ldots\,{self.before(stop)}", 0
            case "linspace", [start, stop, *_]:
                return rf"{self.text(start)}\,\ldots\,{self.text(stop)}", 0
            case "trapezoid", [y, x]:
                return rf"\int {self.wrap(y, 2)}\,\mathrm{{d}}{self.wrap(x, 5)}", 2
            case "where", [condition, a, b]:
                rows = rf"{self.text(a)} & \text{{if }} {self.text(condition)} \\ {self.text(b)} & \text{{otherwise}}"
                return rf"\begin{{cases}} {rows} \end{{cases}}", 5
            case (("sin" | "cos" | "tan"), [ast.Name() | ast.Attribute(ast.Name("g")) as x]):
                text, precedence = self.write(x)
                if precedence == 5 and "(" not in text:
                    return f"{_FUNCTIONS[name]} {text}", 5
            case "atan2", [y, x]:
                return rf"\operatorname{{atan2}}{self.brackets([y, x])}", 5
        head = _FUNCTIONS.get(name) or (symbol.latex(name) if _is_symbol(name) else rf"\operatorname{{{_words(name)}}}")
        return head + self.brackets(args), 5

    def before(self, stop: ast.expr) -> str:
        """The last whole number before ``stop``."""
        match stop:
            case ast.Constant(int(value)):
                return str(value - 1)
            case ast.BinOp(last, ast.Add(), ast.Constant(1)):
                return self.text(last)
        return self.text(ast.BinOp(stop, ast.Sub(), ast.Constant(1)))


def _without_minus(node: ast.expr) -> ast.expr | None:
    """A product or quotient without the minus of its first factor; None where it has none."""
    match node:
        case ast.BinOp(ast.UnaryOp(ast.USub(), first), (ast.Mult() | ast.Div()) as op, right):
            return ast.BinOp(first, op, right)
        case ast.BinOp(left, (ast.Mult() | ast.Div()) as op, right) if positive := _without_minus(left):
            return ast.BinOp(positive, op, right)
    return None


def _part(name: str) -> str:
    return _RATES.get(name) or symbol.latex(name)


def _constant(value: object) -> tuple[str, int]:
    if isinstance(value, complex):
        return ("" if value.imag == 1 else number_latex(value.imag) + r"\,") + "i", 5 if value.imag == 1 else 2
    if isinstance(value, int | float):
        text = number_latex(value)
        return text, 2 if r"\cdot" in text else 5
    escaped = re.sub(r"([_#%&$])", r"\\\1", str(value))
    return rf"\text{{{escaped}}}", 5


def _is_symbol(name: str) -> bool:
    word = re.fullmatch(r"[a-z]{3,}(_\w*)?", name) and not re.match("|".join(symbol.GREEK), name)
    return len(name) == 1 or (not word and bool(re.search(r"\d", name) or _SYMBOL.match(name)))


def _words(name: str) -> str:
    return name.replace("_", r"\ ")
