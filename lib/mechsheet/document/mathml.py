"""Formulas in MathML: a rule for each kind of node of the tree."""

import re
from collections.abc import Callable, Iterable, Iterator
from functools import lru_cache
from html import escape
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
from mechsheet.worksheet.symbol import LETTERS, Symbol

# What is no digit stands outside the element of a number, which it ends and begins again.
NUMBER = Notation(
    '</mn><mo form="prefix">−</mo><mn>',
    "</mn><mtext>none</mtext><mn>",
    "∞",
    "{}</mn><mo>⋅</mo><msup><mn>10</mn><mrow><mn>{}</mn></mrow></msup><mn>",
    "</mn><mo>(</mo><mn>{}</mn><mo>,</mo><mn>{}</mn><mo>)</mo><mn>",
    "</mn><mo>…</mo><mn>",
    "°",
    '</mn><mspace width=".17em"/><mtext>%</mtext><mn>',
    '</mn><mspace width=".17em"/><mtext>{}</mtext><mn>',
    "</mtext><msup><mrow></mrow><mrow><mn>{}</mn></mrow></msup><mtext>",
    "·",
)
_ENDING, _BLANK = re.compile("^ | $"), "\u00a0"  # a plain blank at the end of a text is left out
_EMPTY = re.compile("<(mn|mtext)></\\1>")
_THIN, _COMMA, _QUAD = '<mspace width=".17em"/>', '<mo separator="true">,</mo>', '<mspace width="1em"/>'
_DOTTED = f'{_THIN}<mo lspace="0" rspace="0">…</mo>{_THIN}'
_FORM = ' form="{}"'  # of a bar, which may begin or end
_GREEK = re.compile(f"([{LETTERS}])")
_UPRIGHT = re.compile("[A-ZΓΔΘΛΞΠΣΥΦΨΩ]")  # Greek capitals, and letters of an index
_WORDS = ("mod", "and", "or")
_BEGIN, _END = '<math displaystyle="true">', "</math>"
_BREAK = f"{_END}<wbr/>{_BEGIN}"
_TAG, _LONG = re.compile("<.*?>"), 25  # characters that have room in a line of a narrow screen
_DOTS = {".": "˙", "..": "¨"}


def mathml(node: Node) -> str:
    """A formula in MathML, with the space of a line of its own; one that may go on in the next line in a span."""
    text = f"{_BEGIN}{in_terms(node)}{_END}"
    return f'<span class="ms-terms">{text}</span>' if _BREAK in text else text


def equal_to(node: Node) -> str:
    """A formula behind the sign that it is equal, as `mathml` writes it."""
    return f"{_BEGIN}<mo>=</mo>{in_terms(node)}{_END}"


def in_terms(node: Node) -> str:
    """What stands in the element of a formula; a long one ends it and begins another before each of its terms.

    >>> from mechsheet.worksheet.symbol import read
    >>> x = read("x")
    >>> in_terms(Binary(x, "=", Binary(x, "+", x))).count("<wbr/>")
    0
    """
    whole = inner(node)
    return whole if len(_TAG.sub("", whole)) < _LONG else _BREAK.join(_terms(node))


def _terms(node: Node) -> Iterator[str]:
    """Parts of a formula between which a line may end: all but the first begin with their sign."""
    match node:
        case Binary(left, ("=" | "+" | "-" | "and" | "or") as sign, right):
            yield from _terms(left)
            first, *more = _terms(right)
            yield f"<mrow>{_sign(sign, _FORM.format('infix'))}{first}</mrow>"
            yield from more
        case Row([first, *more]):
            yield from _terms(first)
            for item in more:
                begun, *rest = _terms(item)
                yield f"<mrow>{_QUAD}{begun}</mrow>"
                yield from rest
        case _:
            yield inner(node)


def inner(node: Node) -> str:
    """One element of MathML."""
    return RULES[type(node)](node)


@lru_cache(maxsize=4096)
def symbol(s: Symbol) -> str:
    """A symbol in MathML.

    >>> from mechsheet.worksheet.symbol import read
    >>> symbol(read("phi34"))
    '<msub><mi>φ</mi><mn>34</mn></msub>'
    >>> symbol(read("dRa"))
    '<mrow><mi mathvariant="normal">Δ</mi><msub><mi>R</mi><mi mathvariant="normal">a</mi></msub></mrow>'
    """
    base = _letters(s.base)
    if s.mark in _DOTS:
        base = f'<mover accent="true">{base}<mo stretchy="false">{_DOTS[s.mark]}</mo></mover>'
    if s.index:
        parts = [_index(part) for part in _GREEK.split(s.index) if part]
        base = f"<msub>{base}{_row(parts)}</msub>"
    return _row([_letters(s.mark), base]) if s.mark in ("Δ", "d") else base


def _letters(text: str) -> str:
    """A letter, slanted unless it is a Greek capital, or a word."""
    return _upright(text) if text in LETTERS and _UPRIGHT.fullmatch(text) else f"<mi>{escape(text)}</mi>"


def _upright(text: str) -> str:
    return f'<mi mathvariant="normal">{escape(text)}</mi>'


def _index(text: str) -> str:
    if text in LETTERS:
        return _letters(text)
    return _upright(text) if re.search(r"[^\W\d_]", text) else f"<mn>{escape(text)}</mn>"


def _row(parts: Iterable[str]) -> str:
    held = [part for part in parts if part]
    return held[0] if len(held) == 1 else f"<mrow>{''.join(held)}</mrow>"


def _digits(text: str) -> str:
    """A number as `NUMBER` writes it."""
    parts = _EMPTY.sub("", f"<mn>{text}</mn>")
    return f"<mrow>{parts}</mrow>" if parts.count("<m") > 1 else parts


def _sign(sign: str, form: str = "") -> str:
    if sign in _WORDS:
        return f"<mtext>\u2002{sign}\u2002</mtext>"
    separator = ' separator="true"' if sign == "," else ""
    return f"<mo{form}{separator}>{escape(sign.replace('-', '−'))}</mo>"


def _function(node: Function) -> str:
    if sign := {"sum": "∑", "prod": "∏"}.get(node.name):
        return f'<mo largeop="false">{sign}</mo>'
    return f"<mi>{escape(node.name)}</mi>" if len(node.name) > 1 else _upright(node.name)


def _signed(node: Signed) -> str:
    return f"<mrow>{_sign(node.sign)}{inner(node.of)}</mrow>"


def _power(node: Power) -> str:
    """An exponent stands over the index of its base.

    >>> from mechsheet.worksheet.symbol import read
    >>> _power(Power(read("omega3"), Number(2)))
    '<msubsup><mi>ω</mi><mn>3</mn><mn>2</mn></msubsup>'
    """
    base, exponent = inner(node.base), inner(node.exponent)
    if isinstance(node.base, Symbol) and base.startswith("<msub>"):
        return f"<msubsup>{base.removeprefix('<msub>').removesuffix('</msub>')}{exponent}</msubsup>"
    return f"<msup>{base}{exponent}</msup>"


def _binary(node: Binary) -> str:
    """Between words alone a sign would have no space: they count as letters, as one beside them would."""
    match node:
        case Binary(Text(first), sign, Text(last)) if first[:1].isalpha() and last[:1].isalpha():
            return f"<mrow>{_upright(first)}{_sign(sign)}{_upright(last)}</mrow>"
    return f"<mrow>{inner(node.left)}{_sign(node.sign)}{inner(node.right)}</mrow>"


def _product(node: Product) -> str:
    return f"<mrow>{inner(node.left)}{'<mo>⋅</mo>' if node.dot else _THIN}{inner(node.right)}</mrow>"


def _brackets(node: Brackets) -> str:
    between = _COMMA if node.close else _COMMA + _THIN
    return _fenced(node.kind[0], between.join(map(inner, node.items)), node.kind[1], is_high(node))


def _fenced(left: str, inside: str, right: str, high: bool = True) -> str:
    """What stands between two signs, which are as high as it is where it is ``high``; the last one may be none."""
    flat = "" if high else ' stretchy="false"'
    first, last = (
        f"<mo{_FORM.format(form) if sign in '|‖' else ''}{flat}>{sign}</mo>" if sign else ""
        for form, sign in (("prefix", left), ("postfix", right))
    )
    return f"<mrow>{first}<mrow>{inside}</mrow>{last}</mrow>"


def _prefix(node: Prefix) -> str:
    space = "" if isinstance(node.operator, Text) else _THIN
    return f"<mrow>{inner(node.operator)}{space}{inner(node.of)}</mrow>"


def _range(node: Range) -> str:
    first = (_COMMA + _THIN).join(map(inner, node.first))
    return f"<mrow>{first}{_DOTTED}{inner(node.last)}</mrow>"


def _cases(node: Cases) -> str:
    rows, rest = list[str](), node
    while True:
        rows.append(_table_row([inner(rest.value), f"<mrow><mtext>if\u2002</mtext>{inner(rest.condition)}</mrow>"]))
        if not isinstance(rest.otherwise, Cases):
            break
        rest = rest.otherwise
    rows.append(_table_row([inner(rest.otherwise), "<mtext>otherwise</mtext>"]))
    return _fenced("{", f'<mtable class="cases">{"".join(rows)}</mtable>', "")


def _table_row(cells: Iterable[str]) -> str:
    return f"<mtr>{''.join(f'<mtd>{cell}</mtd>' for cell in cells)}</mtr>"


def _sum(node: Sum) -> str:
    if node.end is None:
        sign = f"<munder><mo>{node.sign}</mo><mrow>{inner(node.index)}<mo>∈</mo>{inner(node.start)}</mrow></munder>"
    else:
        start = f"<mrow>{inner(node.index)}<mo>=</mo>{inner(node.start)}</mrow>"
        sign = f"<munderover><mo>{node.sign}</mo>{start}{inner(node.end)}</munderover>"
    return f"<mrow>{sign}{inner(node.of)}</mrow>"


def _integral(node: Integral) -> str:
    over = inner(node.over)
    sign = f"<msup><mo>∫</mo>{over}</msup>" if node.so_far else "<mo>∫</mo>"
    if node.start and node.end:
        sign = f"<msubsup><mo>∫</mo>{inner(node.start)}{inner(node.end)}</msubsup>"
    return f"<mrow>{sign}{inner(node.of)}{_THIN}{_upright('d')}{over}</mrow>"


def _root(node: Root) -> str:
    return f"<mroot>{inner(node.of)}{inner(node.degree)}</mroot>" if node.degree else f"<msqrt>{inner(node.of)}</msqrt>"


def _matrix(node: Matrix) -> str:
    rows = "".join(_table_row(map(inner, row.items)) for row in node.rows)
    return _fenced("[", f"<mtable>{rows}</mtable>", "]")


def _measure(node: Measure) -> str:
    if node.typed and not isinstance(node.value, complex):
        return numbers.as_typed(node.value, NUMBER) + numbers.behind(node.unit, NUMBER)
    return numbers.quantity(node.value, node.unit, NUMBER)


RULES: dict[type[Any], Callable[[Any], str]] = {
    Symbol: symbol,
    Number: lambda node: _digits((numbers.as_typed if node.typed else numbers.usual)(node.value, NUMBER)),
    Measure: lambda node: _digits(_measure(node)),
    Text: lambda node: f"<mtext>{_ENDING.sub(_BLANK, escape(node.text))}</mtext>",
    Code: lambda node: f'<mtext class="code">{escape(node.text)}</mtext>',
    Function: _function,
    Signed: _signed,
    Binary: _binary,
    Product: _product,
    Fraction: lambda node: f"<mfrac>{inner(node.over)}{inner(node.under)}</mfrac>",
    Root: _root,
    Power: _power,
    Element: lambda node: f"<msub>{inner(node.of)}{_row([_COMMA * goes_on(node), inner(node.index)])}</msub>",
    Overline: lambda node: f'<mover accent="true">{inner(node.of)}<mo stretchy="true">‾</mo></mover>',
    Brackets: _brackets,
    Apply: lambda node: f"<mrow>{inner(node.function)}{inner(node.arguments)}</mrow>",
    Prefix: _prefix,
    Range: _range,
    Integral: _integral,
    Sum: _sum,
    Cases: _cases,
    Matrix: _matrix,
    Row: lambda node: f"<mrow>{_QUAD.join(map(inner, node.items))}</mrow>",
}
