"""Symbols, numbers and limits in HTML."""

from html import escape

from mechsheet.worksheet import symbol
from mechsheet.worksheet.kinds import Input
from mechsheet.worksheet.numbers import Notation

HTML = Notation(
    "−", "none", "∞", "{}\u2009·\u200910<sup>{}</sup>", "({}, {})", " … ", "°", " %", " {}", "<sup>{}</sup>", "·"
)

_SIGNS = {"<": "&lt;", ">": "&gt;", "<=": "≤", ">=": "≥"}


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
    """
    read = symbol.read(name)
    return f"{read.mark}<i>{read.base}</i>" + (f"<sub>{read.index}</sub>" if read.index else "")


def in_words(sentence: str) -> str:
    """A sentence, the names of quantities in it as their symbols.

    >>> in_words("omega3 - 1 < 0, theta/2")
    '<i>ω</i><sub>3</sub> − 1 &lt; 0, <i>θ</i>/2'
    """
    pieces = enumerate(symbol.pieces(sentence))
    return "".join(named(piece) if i % 2 else escape(piece).replace(" - ", " − ") for i, piece in pieces)


def limits(field: Input) -> str:
    """Limits of an input, or of one column of a table; other columns by their short names.

    >>> limits(Input("b.x", "m", "", "", False, ((">", "0.5"), ("<=", "b.l_2"))))
    '&gt;&nbsp;0.5, ≤&nbsp;<i>l</i><sub>2</sub>'
    """
    return ", ".join(f"{_SIGNS[sign]}&nbsp;{_limit(other)}" for sign, other in field.limits)


def _limit(text: str) -> str:
    return as_written(text.rpartition(".")[2]) if text[0].isalpha() else escape(text)
