"""MathML as TeX, in which formulas are written in a line: what it shows can be read, and compared."""

from __future__ import annotations

import ast
import re
from html import unescape
from xml.etree import ElementTree

from mechsheet.document.expression import tree
from mechsheet.document.formula import Measure, Node
from mechsheet.document.mathml import mathml
from mechsheet.worksheet.symbol import GREEK

_LETTERS = {letter: rf"\{word}" for word, letter in GREEK.items()} | {"ε": r"\varepsilon", "φ": r"\varphi"}
_KNOWN = ["sin", "cos", "tan", "arcsin", "arccos", "arctan", "arg", "exp", "ln", "max", "min"]
_SIGNS = {
    "−": "-", "⋅": r"\cdot", "×": r"\times", "≤": r"\le", "≥": r"\ge", "≠": r"\ne", "∈": r"\in", "∉": r"\notin",
    "↦": r"\mapsto", "…": r"\ldots", "∑": r"\sum", "∏": r"\prod", "∫": r"\int", "{": r"\{", "}": r"\}", "‖": r"\Vert",
    "⌊": r"\lfloor", "⌋": r"\rfloor", "⌈": r"\lceil", "⌉": r"\rceil", "∞": r"\infty",
}  # fmt: skip
_SPACES = {".17em": r"\,", "1em": r"\quad "}
_ACCENTS = {"˙": r"\dot", "¨": r"\ddot", "‾": r"\overline"}
_TERMS = re.compile('<span class="ms-terms">(.*?)</span>')
_ASKED = re.compile(' formula="(.*?)"')
_MATH = re.compile("<math.*?</math>")
_WORD = re.compile(r"\\[A-Za-z]+$")
_BRACKETS = "()[]{}|‖⌊⌋⌈⌉"


def typeset(source: str, numbers: dict[str, Measure] | None = None) -> str:
    """TeX of an expression as it is typeset."""
    return tex(tree(ast.parse(source, mode="eval").body, numbers))


def tex(node: Node) -> str:
    """TeX of a formula as it is typeset."""
    return in_tex(mathml(node))


def in_tex(html: str) -> str:
    """HTML with the MathML in it, the parts of a long formula together, as TeX."""
    html = _ASKED.sub(lambda told: f' formula="{unescape(told[1])}"', html)
    whole = _TERMS.sub(lambda terms: terms[1].replace('</math><wbr/><math displaystyle="true">', ""), html)
    return _MATH.sub(lambda math: _read(ElementTree.fromstring(math[0])).strip(), whole)


def _read(element: ElementTree.Element) -> str:
    parts, own = [_read(child) for child in element], element.text or ""
    match element.tag, parts:
        case "mi", _:
            return _letters(own, upright=element.get("mathvariant") == "normal")
        case "mn", _:
            return _SIGNS.get(own, own.replace("°", r"^\circ"))
        case "mtext", _:
            return rf"\text{{{own}}}".replace("\u2002", " ").replace("\u00a0", " ")
        case "mspace", _:
            return _SPACES[element.get("width", "")]
        case "mo", _:
            return _sign(element, own)
        case "mrow" | "math" | "mtd", _:
            return _row(list(element), parts)
        case "msub" | "munder", [base, index]:
            return f"{_base(base)}_{{{index}}}"
        case "msup", [base, exponent]:
            return f"{base}^{{{exponent}}}"
        case "msubsup" | "munderover", [base, index, exponent]:
            return f"{_base(base)}_{{{index}}}^{{{exponent}}}"
        case "mover", [base, accent]:
            return f"{_ACCENTS[accent]}{{{base}}}"
        case "mfrac", [over, under]:
            return rf"\frac{{{over}}}{{{under}}}"
        case "msqrt", _:
            return rf"\sqrt{{{''.join(parts)}}}"
        case "mroot", [of, degree]:
            return rf"\sqrt[{degree}]{{{of}}}"
        case "mtr", _:
            return " & ".join(parts)
        case "mtable", _:
            return r" \\ ".join(parts)
    raise AssertionError(ElementTree.tostring(element))


def _letters(own: str, upright: bool) -> str:
    text = _LETTERS.get(own, own)
    if own in _KNOWN:
        return rf"\{own}"
    return (
        text
        if own in _LETTERS or own == "∞" or (len(own) == 1 and not upright)
        else rf"\mathrm{{{text}}}".replace(" ", r"\ ")
    )


def _base(text: str) -> str:
    return f"{{{text}}}" if "_" in text or text.endswith((")", "]")) else text


def _sign(element: ElementTree.Element, own: str) -> str:
    sign = _SIGNS.get(own, own)
    alone = own in _ACCENTS or own in f"{_BRACKETS},…∑∏∫" or element.get("form") == "prefix"
    return sign if alone else f" {sign} "


def _row(elements: list[ElementTree.Element], parts: list[str]) -> str:
    """What stands side by side: behind a sign that begins it is no space, and brackets may be as high as it is."""
    if not elements:
        return ""
    first, last = elements[0], elements[-1]
    if first.tag == "mo" and f"{first.text}" in f"+−{_BRACKETS}" and len(parts) > 1 and first.get("form") != "infix":
        parts[0] = parts[0].strip()
        if first.text in _BRACKETS and first.get("stretchy") != "false" and len(parts) <= 3:
            inside = parts[1].strip()
            if elements[1].find("mtable") is not None and first.text in "{[":
                kind = "cases" if first.text == "{" else "bmatrix"
                return rf"\begin{{{kind}}} {inside} \end{{{kind}}}"
            if last.tag == "mo":
                return _beside(rf"\left{parts[0]}", inside, rf"\right{parts[-1]}")
    return _beside(*parts).replace(r",\,", r",\ ")


def _beside(*parts: str) -> str:
    """Parts in a row: a letter behind a word stands apart."""
    found = ""
    for part in parts:
        found += " " * bool(_WORD.search(found) and part[:1].isalpha()) + part
    return found
