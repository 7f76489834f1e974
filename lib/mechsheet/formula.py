"""Formulas of a cell: each line's symbol, expression, unit and meaning, typeset with the value it gave."""

import ast
import html
import re
import sys
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from types import FrameType
from typing import Any

import numpy as np

from mechsheet import source, symbol, units
from mechsheet.errors import SheetError

_DECLARED = re.compile(r"\[([^\]]*)\]\s*(.*)")
_REGISTRY = "__formulas__"
_ROW = "display:flex;align-items:center;gap:1.5em;flex-wrap:wrap;padding:.15em 0"


@dataclass(frozen=True)
class Formula:
    """One line ``name = expression  # [unit] meaning``; ``arguments`` are those of a function line."""

    name: str
    expression: ast.expr
    unit: str
    meaning: str
    arguments: tuple[str, ...] = ()


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


def formulas(cell: source.Cell) -> Iterator[Formula]:
    """Lines of a cell that end in a unit, in their order."""
    for node in cell.body:
        match node:
            case ast.Assign([ast.Name(name)], expression):
                arguments: tuple[str, ...] = ()
            case ast.FunctionDef(name, body=[*_, ast.Return(ast.expr() as expression)]):
                arguments = tuple(a.arg for a in node.args.args)
            case _:
                continue
        line = node.end_lineno or node.lineno
        found = declared(cell.comments.get(line, ""), cell.at(line))
        if found and not name.startswith("_"):
            yield Formula(name, expression, *found, arguments)


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
    rows = declare(frame, display)
    return Typeset(rows, tuple(frame.f_globals[row.name] for row in rows), shown)


def declare(frame: FrameType, display: Mapping[str, str] | None = None) -> tuple[Formula, ...]:
    """Formulas of the cell that runs in ``frame``, made known to the tables and figures below it."""
    instead = display or {}
    rows = tuple(replace(row, unit=instead.get(row.unit, row.unit)) for row in formulas(source.cell(frame)))
    frame.f_globals.setdefault(_REGISTRY, {}).update({row.name: row for row in rows})
    return rows


@dataclass(frozen=True)
class Typeset:
    """Formulas and their values, shown as symbol = formula = value, unit, meaning."""

    rows: tuple[Formula, ...]
    values: tuple[Any, ...]
    shown: tuple[Any, ...] = ()

    def at(self, position: int) -> "Typeset":
        """The same formulas with the values at one position of their fields."""
        values = (np.asarray(v)[..., position] if np.ndim(v) else v for v in self.values)
        return replace(self, values=tuple(values))

    def _mime_(self) -> tuple[str, str]:
        import marimo as mo

        lines = []
        for row, value in zip(self.rows, self.values, strict=True):
            left, right = _left(row), latex(row.expression)
            tex = left if right == left else f"{left} = {right}"
            if not row.arguments:
                shown = value_latex(value, row.unit)
                tex = f"{tex} = {shown}" if _computes(row.expression) else f"{symbol.latex(row.name)} = {shown}"
            lines.append(
                f'<div class="ms-line" style="{_ROW}">'
                f'<marimo-tex class="arithmatex">||(\\displaystyle {html.escape(tex)}||)</marimo-tex>'
                f'<span style="opacity:.7;font-size:.9em">{html.escape(row.meaning)}</span></div>'
            )
        return "text/html", "".join(lines + [mo.as_html(more).text for more in self.shown])


def _left(row: Formula) -> str:
    arguments = r",\,".join(symbol.latex(a) for a in row.arguments)
    return symbol.latex(row.name) + (f"({arguments})" if arguments else "")


def _computes(node: ast.expr) -> bool:
    return not isinstance(node, ast.Constant)


def number_latex(x: float) -> str:
    """Number with five significant digits or all before the point; as a power of ten outside 1e-3..1e6."""
    if not np.isfinite(x):
        return r"\text{none}" if np.isnan(x) else (r"\infty" if x > 0 else r"-\infty")
    if 1e5 <= abs(x) < 1e6:
        return f"{x:.0f}"
    if x == 0 or 1e-3 <= abs(x) < 1e5:
        return np.format_float_positional(float(f"{x:.5g}") + 0.0, trim="-")  # + 0.0: no sign of zero
    mantissa, exponent = f"{x:.4e}".split("e")
    return rf"{mantissa.rstrip('0').rstrip('.')} \cdot 10^{{{int(exponent)}}}"


def value_latex(value: Any, unit: str) -> str:
    """Value in its display unit; a field of positions as first .. last, a point or a vector as a pair."""
    shown: Any = np.asarray(value) / units.parse(unit).factor
    ends = [shown] if shown.ndim == 0 else [shown.flat[0], shown.flat[-1]]
    texts = [
        rf"({number_latex(z.real)},\ {number_latex(z.imag)})" if np.iscomplexobj(shown) else number_latex(float(z))
        for z in ends
    ]
    return r" \,\ldots\, ".join(texts) + unit_latex(unit)


def unit_latex(unit: str) -> str:
    if unit == "-":
        return ""
    if unit == "deg":
        return r"^\circ"
    if unit == "%":
        return r"\,\%"
    text = re.sub(r"\*\*(-?\d+)", r"^{\1}", unit).replace("*", r"\cdot ")
    return r"\ \mathrm{" + text + "}"


_PRECEDENCE = {ast.Add: 1, ast.Sub: 1, ast.Mult: 2, ast.Div: 2, ast.USub: 3, ast.UAdd: 3, ast.Pow: 4}
_SYMBOL = re.compile(rf"([A-Z]+|{'|'.join(symbol.GREEK)})(_|$)")  # VC, eps_BC
_FUNCTIONS = {"sin": r"\sin", "cos": r"\cos", "tan": r"\tan", "angle": r"\arg", "exp": r"\exp", "log": r"\ln"}


def latex(node: ast.expr) -> str:
    """Expression in LaTeX: fractions, roots, powers, no brackets that the reader does not need."""
    return _tex(node)[0]


def _tex(node: ast.expr) -> tuple[str, int]:
    """LaTeX and precedence of its outermost operation (5: needs no brackets)."""
    if positive := _without_minus(node):
        return f"-{latex(positive)}", 1
    match node:
        case ast.Constant(value):
            return _constant(value)
        case ast.Name(name):
            return symbol.latex(name), 5
        case ast.Attribute(ast.Name("g"), name):
            return symbol.latex(name), 5
        case ast.Attribute(inner, "real"):
            return rf"\operatorname{{Re}} {_wrap(inner, 5)}", 2
        case ast.Attribute(inner, "imag"):
            return rf"\operatorname{{Im}} {_wrap(inner, 5)}", 2
        case ast.Attribute(ast.Name(name), "value") if name.endswith("_found"):
            return rf"\operatorname{{Find}}\,{symbol.latex(name.removesuffix('_found'))}", 2
        case ast.Attribute(ast.Name(name), "value"):  # of a slider or field of the page
            return symbol.latex(name), 5
        case ast.Attribute(ast.Name(name), part):  # a result of several parts
            return rf"{symbol.latex(part)}(\text{{{name.replace('_', ' ')}}})", 5
        case ast.UnaryOp(ast.USub(), inner):
            return f"-{_wrap(inner, 3)}", 1
        case ast.UnaryOp(ast.UAdd(), inner):
            return f"+{_wrap(inner, 3)}", 1
        case ast.BinOp(left, ast.Div(), right):
            return rf"\frac{{{latex(left)}}}{{{latex(right)}}}", 5
        case ast.BinOp(left, ast.Pow(), right):
            if isinstance(left, ast.Call) and isinstance(left.func, ast.Name) and left.func.id in ("sin", "cos"):
                return rf"{_FUNCTIONS[left.func.id]}^{{{latex(right)}}} {_brackets(left.args)}", 4
            base = _wrap(left, 5)
            return (rf"\left({base}\right)" if base.startswith(r"\frac") else base) + f"^{{{latex(right)}}}", 4
        case ast.BinOp(left, ast.Mult(), right):
            return _product(left, right), 2
        case ast.BinOp(left, ast.Mod(), right):
            return rf"{_wrap(left, 2)} \bmod {_wrap(right, 2)}", 2
        case ast.BinOp(left, (ast.Add() | ast.Sub()) as op, right):
            sign = "+" if isinstance(op, ast.Add) else "-"
            second = _wrap(right, 1 if sign == "+" else 2)
            return f"{_wrap(left, 1)} {sign} {_brackets([right]) if second.startswith('-') else second}", 1
        case ast.Call(ast.Name(name), args, keywords):
            return _call(name, [*args, *(k.value for k in keywords)])
        case ast.Subscript(inner, index):
            return f"{{{_wrap(inner, 5)}}}_{{{latex(index)}}}", 5
        case ast.List(items):
            return r"\left[" + r",\ ".join(latex(i) for i in items) + r"\right]", 5
        case ast.Tuple(items):
            return r"\left(" + r",\ ".join(latex(i) for i in items) + r"\right)", 5
    return r"\texttt{" + re.sub(r"([#$%&_{}])", r"\\\1", ast.unparse(node)) + "}", 5


def _without_minus(node: ast.expr) -> ast.expr | None:
    """A product or quotient without the minus of its first factor; None where it has none."""
    match node:
        case ast.BinOp(ast.UnaryOp(ast.USub(), first), (ast.Mult() | ast.Div()) as op, right):
            return ast.BinOp(first, op, right)
        case ast.BinOp(left, (ast.Mult() | ast.Div()) as op, right) if positive := _without_minus(left):
            return ast.BinOp(positive, op, right)
    return None


def _constant(value: object) -> tuple[str, int]:
    if isinstance(value, complex):
        return ("" if value.imag == 1 else number_latex(value.imag) + r"\,") + "i", 5 if value.imag == 1 else 2
    if isinstance(value, int | float):
        text = number_latex(value)
        return text, 2 if r"\cdot" in text else 5
    return rf"\text{{{value}}}", 5


def _wrap(node: ast.expr, level: int) -> str:
    text, precedence = _tex(node)
    return text if precedence >= level else _brackets([node])


def _product(left: ast.expr, right: ast.expr) -> str:
    match right:
        case ast.UnaryOp():
            b = _brackets([right])
        case ast.BinOp(op=ast.Div()):
            b = _wrap(right, 2)
        case _:
            b = _wrap(right, 4 if isinstance(right, ast.BinOp) else 2)
    return _wrap(left, 2) + (r" \cdot " if b[0].isdigit() or isinstance(right, ast.UnaryOp) else r"\,") + b


def _brackets(args: list[ast.expr]) -> str:
    inner = r",\ ".join(latex(a) for a in args)
    return rf"\left({inner}\right)" if r"\frac" in inner else f"({inner})"


def _call(name: str, args: list[ast.expr]) -> tuple[str, int]:
    match name, args:
        case "sqrt", [x]:
            return rf"\sqrt{{{latex(x)}}}", 5
        case "abs" | "hypot", _:
            inner = latex(args[0]) if name == "abs" else " + ".join(f"{_wrap(a, 5)}^2" for a in args)
            return (rf"\left|{inner}\right|" if name == "abs" else rf"\sqrt{{{inner}}}"), 5
        case "conj", [x]:
            return rf"\overline{{{latex(x)}}}", 5
        case "exp", [x]:
            return rf"e^{{{latex(x)}}}", 4
        case "cross", [a, b]:
            return rf"{_wrap(a, 2)} \times {_wrap(b, 2)}", 1
        case "atan2", [y, x]:
            return rf"\operatorname{{atan2}}{_brackets([y, x])}", 5
    head = _FUNCTIONS.get(name) or (symbol.latex(name) if _is_symbol(name) else rf"\operatorname{{{_words(name)}}}")
    return head + _brackets(args), 5


def _is_symbol(name: str) -> bool:
    return len(name) == 1 or bool(re.search(r"\d", name) or _SYMBOL.match(name))


def _words(name: str) -> str:
    return name.replace("_", r"\ ")
