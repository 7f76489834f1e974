"""Symbols, numbers and limits in HTML."""

import json
import re
from collections.abc import Container, Iterable
from html import escape
from typing import Any

from mechsheet.worksheet import numbers, symbol
from mechsheet.worksheet.check import Check
from mechsheet.worksheet.kinds import Input
from mechsheet.worksheet.lines import Formula
from mechsheet.worksheet.numbers import Notation
from mechsheet.worksheet.over import Over, Written

HTML = Notation(
    "−", "none", "∞", "{}\u202f·\u202f10<sup>{}</sup>", "({}, {})", " … ", "°", " %", " {}", "<sup>{}</sup>", "·"
)

_SIGNS = {"<": "&lt;", ">": "&gt;", "<=": "≤", ">=": "≥"}


def attribute(name: str, value: Any) -> str:
    """An attribute that holds JSON, whose double quotes need no escape in it: text is longer by each of them.

    >>> print(attribute("told", {"a": "it's < 1"}))
     told='{"a":"it&#39;s &lt; 1"}'
    """
    return f" {name}='{escape(_as_json(value), quote=False).replace(_QUOTE, '&#39;')}'"


_QUOTE = "'"
_as_json = json.JSONEncoder(ensure_ascii=False, separators=(",", ":")).encode


def named(name: str) -> str:
    """Name of a quantity as its symbol, for headings of tables and legends.

    >>> named("phi34"), named("R56x")
    ('<i>φ</i><sub>34</sub>', '<i>R</i><sub>56x</sub>')
    """
    return as_written(symbol.stem(name))


def as_written(name: str) -> str:
    """Name of what is no field, such as an input, as its symbol.

    >>> as_written("l_S")
    '<i>l</i><sub>S</sub>'
    >>> as_written("beta_phi"), as_written("Phi_t"), as_written("side23")  # as in formulas
    ('<i>β</i><sub><i>φ</i></sub>', 'Φ<sub>t</sub>', 'side<sub>23</sub>')
    """
    read = symbol.read(name)
    index = re.sub(f"[{symbol.LETTERS}]", lambda m: _letters(m[0]), read.index)
    return _letters(read.mark) + _letters(read.base) + (f"<sub>{index}</sub>" if index else "")


def _letters(text: str) -> str:
    return f"<i>{text}</i>" if symbol.is_slanted(text) else text


def meant(meaning: str, known: Container[str] = ()) -> str:
    """What a line or an input means, its numbers as on the page and names in it as symbols.

    Names are Greek words, what has an index by an underscore, and of those with digits the ``known`` ones.

    >>> meant("abscissa of the pole < 1, times D_p; bolt M8")
    'abscissa of the pole &lt; 1, times <i>D</i><sub>p</sub>; bolt M8'
    >>> meant("sum of cos(phi) + c, below 40 psi")
    'sum of cos(<i>φ</i>) + c, below 40 psi'
    >>> meant("l2 - l1 on the branch -1, bolt M8", {"l1", "l2"})
    '<i>l</i><sub>2</sub> − <i>l</i><sub>1</sub> on the branch −1, bolt M8'
    """
    return _with_symbols(_IN_PROSE.split(meaning), known)


def _with_symbols(pieces: Iterable[str], known: Container[str]) -> str:
    """Pieces of a sentence, every second one as a symbol unless it is one of a known name alone."""
    shown, text = "", ""
    for i, piece in enumerate(pieces):
        if i % 2 and (piece in known or not symbol.is_doubtful(piece)):
            shown, text = shown + message(text) + named(piece), ""
        else:
            text += piece
    return shown + message(text)


_IN_PROSE = re.compile(rf"({symbol.IN_PROSE}|\b{symbol.DOUBTFUL})")


def printed(number: str) -> str:
    """Number of a printed formula, or from which to which.

    >>> printed("(1.54)-(1.56)")
    '(1.54)–(1.56)'
    """
    return escape(number).replace(")-(", ")–(")


def in_words(sentence: str, names: tuple[str, ...] = (), known: Iterable[str] | None = None) -> str:
    r"""A sentence, the ``names`` of quantities in it and what looks like one as symbols, its numbers as on the page.

    What may be a grade, a fit or a unit as well is a symbol where it is among the ``known``; where none are given, too.

    >>> in_words("omega3 - 1 < 0, theta/2")
    '<i>ω</i><sub>3</sub> − 1 &lt; 0, <i>θ</i>/2'
    >>> in_words("phi3 = -1.5e-7..90 deg, -2..-1 m")
    '<i>φ</i><sub>3</sub> = −1.5\u202f·\u202f10<sup>−7</sup>..90°, −2..−1 m'
    >>> in_words("bolt M12 under F12, in psi", known={"F12"})
    'bolt M12 under <i>F</i><sub>12</sub>, in psi'
    """
    pieces = symbol.pieces(sentence, names)
    return _with_symbols(pieces, {*names, *(pieces if known is None else known)})


def message(text: str) -> str:
    """A message, its numbers and signs as the page writes them; its names may be those of lines and stay.

    >>> message("n = -0.5 must be >= 0, not 'a<b'")
    'n = −0.5 must be ≥ 0, not &#x27;a&lt;b&#x27;'
    """
    return numbers.rewritten(escape(text), HTML)


def compared(check: Check, unit: str, to: Notation = HTML) -> str:
    r"""Residual and limit of an evaluated check in a unit, what part of its limit it takes; or how well it agrees.

    >>> compared(Check("stress", 330.0, 355.0, "MPa"), "MPa")
    '330 ≤ 355 MPa, 93 %'
    >>> compared(Check("safety", 2.0, 1.5, at_least=True), "-")
    '2 ≥ 1.5, 75 %'
    >>> compared(Check("loop", 2e-16, 1e-12, agreement=True), "-")
    'within 1\u202f·\u202f10<sup>−12</sup>'
    """
    residual, limit = (numbers.rewritten(text, to) for text in check.shown_in(unit).compared)
    limit += numbers.behind(unit, to)
    if check.agrees:
        return f"within {limit}"
    part = f", {check.utilised}" if check.utilised else ""
    sign = ("≥" if check.passed else "&lt;") if check.at_least else "≤" if check.passed else "&gt;"
    return f"{residual} {sign} {limit}{part}"


def _in_its_unit(line: Formula, x: Any) -> str:
    return numbers.value(x, line.unit, HTML)


def where(field: Any, over: Over | None, written: Written = _in_its_unit) -> str:
    """Where a field is least and where it is greatest, if its numbers do not stand in full."""
    places = over.places(field, named, written) if over else None
    return f' <span class="ms-where">least at {places[0]}, greatest at {places[1]}</span>' if places else ""


def once(line: Formula) -> str:
    """What stands for the value of a line whose name has another one further down."""
    return f' <span class="ms-where">{escape(line.name)} has another value from line {line.again} on</span>'


def limits(field: Input) -> str:
    """Limits and tolerance of an input, or of one column of a table; other columns by their short names.

    >>> limits(Input("b.x", "m", "", "", False, ((">", "-0.5"), ("<=", "b.l_2"))))
    '&gt;&nbsp;−0.5, ≤&nbsp;<i>l</i><sub>2</sub>'
    >>> from mechsheet.worksheet.deviation import Deviation
    >>> limits(Input("b", "deg", "", "", False, (), tolerance=Deviation(0.5)))
    '±&nbsp;0.5°'
    """
    parts = [f"{_SIGNS[sign]}&nbsp;{_limit(other)}" for sign, other in field.limits]
    return ", ".join(filter(None, (*parts, tolerance(field))))


def tolerance(field: Input) -> str:
    """Tolerance of an input; "" where none is known."""
    return field.tolerance.text(field.unit, HTML).replace(" ", "&nbsp;") if field.tolerance else ""


def _limit(text: str) -> str:
    if text[0].isalpha():
        return as_written(text.rpartition(".")[2])
    return message(text)
