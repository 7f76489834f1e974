"""Formulas in LaTeX: a rule for each kind of node of the tree."""

import re
from collections.abc import Callable
from functools import lru_cache
from typing import Any

from mechsheet.document.formula import (
    Apply,
    Binary,
    Brackets,
    Cases,
    Code,
    Element,
    Fraction,
    Function,
    Integral,
    Matrix,
    Measure,
    Node,
    Number,
    Overline,
    Power,
    Prefix,
    Product,
    Range,
    Root,
    Row,
    Signed,
    Sum,
    Text,
    goes_on,
    is_high,
)
from mechsheet.worksheet import numbers
from mechsheet.worksheet.numbers import Notation
from mechsheet.worksheet.symbol import GREEK, LETTERS, Symbol

LATEX = Notation(
    "-", r"\text{none}", r"\infty", r"{} \cdot 10^{{{}}}", r"({},\ {})", r" \,\ldots\, ", r"^\circ", r"\,\%",
    r"\,\mathrm{{{}}}", r"^{{{}}}", r"\cdot ",
)  # fmt: skip
_LETTERS = {letter: rf"\{word}" for word, letter in GREEK.items()}
_LETTERS |= {"ε": r"\varepsilon", "φ": r"\varphi", "Ξ": r"\Xi", "Π": r"\Pi"}
_GREEK = re.compile(f"([{LETTERS}])")
_MARKS = {"": "{}", "Δ": r"\Delta {}", "d": "d{}", ".": r"\dot{{{}}}", "..": r"\ddot{{{}}}"}
_NAMED = {
    **{name: rf"\{name}" for name in ("sin", "cos", "tan", "arcsin", "arccos", "arctan", "arg", "exp", "ln", "max")},
    "min": r"\min",
    "sum": r"\textstyle\sum ",
    "prod": r"\textstyle\prod ",
}
_SIGNS = {
    "×": r"\times",
    "mod": r"\bmod",
    "≤": r"\le",
    "≥": r"\ge",
    "≠": r"\ne",
    "∈": r"\in",
    "∉": r"\notin",
    "↦": r"\mapsto",
    "and": r"\text{ and }",
    "or": r"\text{ or }",
}
_BRACKETS = {
    "{": r"\{",
    "}": r"\}",
    "‖": r"\Vert ",
    "⌊": r"\lfloor ",
    "⌋": r"\rfloor ",
    "⌈": r"\lceil ",
    "⌉": r"\rceil ",
}
_SPECIAL = re.compile(r"([_#%&$])")
_SPECIAL_IN_CODE = re.compile(r"([#$%&_{}])")


def latex(node: Node) -> str:
    """A formula in LaTeX."""
    return RULES[type(node)](node)


@lru_cache(maxsize=4096)
def symbol(s: Symbol) -> str:
    r"""A symbol in LaTeX.

    >>> from mechsheet.worksheet.symbol import read
    >>> symbol(read("phi34")), symbol(read("dRa"))
    ('\\varphi_{34}', '\\Delta R_{\\mathrm{a}}')
    """
    known = len(s.base) == 1 and (s.base.isascii() or not s.base.isalpha())  # to who sets a formula
    base = _LETTERS.get(s.base) or (s.base if known else rf"\mathrm{{{_escaped(s.base)}}}")
    index = "".join(
        _LETTERS.get(part) or (rf"\mathrm{{{part}}}" if re.search(r"[^\W\d_]", part) else part)
        for part in _GREEK.split(s.index)
        if part
    )
    return _MARKS[s.mark].format(base) + (f"_{{{index}}}" if index else "")


def _measure(node: Measure) -> str:
    return numbers.quantity(node.value, node.unit, LATEX)


def _function(node: Function) -> str:
    return _NAMED.get(node.name) or rf"\operatorname{{{node.name}}}".replace(" ", r"\ ")


def _code(node: Code) -> str:
    return r"\texttt{" + _SPECIAL_IN_CODE.sub(r"\\\1", node.text) + "}"


def _binary(node: Binary) -> str:
    sign = r",\ " if node.sign == "," else f" {_SIGNS.get(node.sign, node.sign)} "
    return latex(node.left) + sign + latex(node.right)


def _product(node: Product) -> str:
    return latex(node.left) + (r" \cdot " if node.dot else r"\,") + latex(node.right)


def _brackets(node: Brackets) -> str:
    inner = (r",\," if node.close else r",\ ").join(map(latex, node.items))
    left, right = (_BRACKETS.get(sign, sign) for sign in node.kind)
    return rf"\left{left}{inner}\right{right}" if is_high(node) else f"{left}{inner}{right}"


def _cases(node: Cases) -> str:
    rows, rest = list[str](), node
    while True:
        rows.append(rf"{latex(rest.value)} & \text{{if }} {latex(rest.condition)}")
        if not isinstance(rest.otherwise, Cases):
            break
        rest = rest.otherwise
    rows.append(rf"{latex(rest.otherwise)} & \text{{otherwise}}")
    inner = r" \\ ".join(rows)
    return rf"\begin{{cases}} {inner} \end{{cases}}"


def _sum(node: Sum) -> str:
    sign = r"\sum" if node.sign == "∑" else r"\prod"
    if node.end is None:
        return rf"{sign}_{{{latex(node.index)} \in {latex(node.start)}}} {latex(node.of)}"
    return rf"{sign}_{{{latex(node.index)} = {latex(node.start)}}}^{{{latex(node.end)}}} {latex(node.of)}"


def _integral(node: Integral) -> str:
    over = latex(node.over)
    limits = f"^{{{over}}}" if node.so_far else ""
    if node.start and node.end:
        limits = f"_{{{latex(node.start)}}}^{{{latex(node.end)}}}"
    return rf"\int{limits} {latex(node.of)}\,\mathrm{{d}}{over}"


def _matrix(node: Matrix) -> str:
    rows = r" \\ ".join(" & ".join(map(latex, row.items)) for row in node.rows)
    return rf"\begin{{bmatrix}} {rows} \end{{bmatrix}}"


def _escaped(text: str) -> str:
    return _SPECIAL.sub(r"\\\1", text)


RULES: dict[type[Any], Callable[[Any], str]] = {
    Symbol: symbol,
    Number: lambda node: numbers.usual(node.value, LATEX),
    Measure: _measure,
    Text: lambda node: rf"\text{{{_escaped(node.text)}}}",
    Code: _code,
    Function: _function,
    Signed: lambda node: node.sign + latex(node.of),
    Binary: _binary,
    Product: _product,
    Fraction: lambda node: rf"\frac{{{latex(node.over)}}}{{{latex(node.under)}}}",
    Root: lambda node: rf"\sqrt{f'[{latex(node.degree)}]' if node.degree else ''}{{{latex(node.of)}}}",
    Power: lambda node: f"{latex(node.base)}^{{{latex(node.exponent)}}}",
    Element: lambda node: f"{{{latex(node.of)}}}_{{{',' if goes_on(node) else ''}{latex(node.index)}}}",
    Overline: lambda node: rf"\overline{{{latex(node.of)}}}",
    Brackets: _brackets,
    Apply: lambda node: latex(node.function) + latex(node.arguments),
    Prefix: lambda node: f"{latex(node.operator)} {latex(node.of)}",
    Range: lambda node: r",\,".join(map(latex, node.first)) + r"\,\ldots\," + latex(node.last),
    Integral: _integral,
    Sum: _sum,
    Cases: _cases,
    Matrix: _matrix,
    Row: lambda node: r"\quad ".join(map(latex, node.items)),
}
