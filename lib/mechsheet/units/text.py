"""Units as they are typed, ``kgf/cm^2``, ``N·m``, ``mm²``, ``N m``: their names and powers."""

import re
from collections.abc import Iterator
from fractions import Fraction
from functools import lru_cache
from typing import NamedTuple

_RAISED = str.maketrans("⁻⁺⁄⁰¹²³⁴⁵⁶⁷⁸⁹", "-+/0123456789")
_TOKEN = re.compile(
    r"(?P<gap>\s*)(?:(?P<name>°C|°|%|[^\W\d_⁰¹²³⁴⁵⁶⁷⁸⁹]+)|(?P<number>\d+(?:\.\d+)?)"
    r"|(?P<sign>\*\*|[\^*·⋅×/()+-])|(?P<raised>[⁻⁺]?[⁰¹²³⁴⁵⁶⁷⁸⁹]+(?:⁄[⁰¹²³⁴⁵⁶⁷⁸⁹]+)?))"
)
_SIGNS = {"^": "**", "·": "*", "⋅": "*", "×": "*"}
# What stands for a name that Python takes; micro and ohm have two signs each.
_TYPED = {"°": "deg", "°C": "degC", "in": "inch"}
_LETTERS = str.maketrans({"\u00b5": "u", "\u03bc": "u", "\u2126": "ohm", "\u03a9": "ohm"})


UNKNOWN = "?"  # stands where a unit cannot be read
_ALONE = ("-", UNKNOWN)


class Factor(NamedTuple):
    """A unit by its name, to a power."""

    name: str
    power: Fraction


class Unreadable(ValueError):
    """A text that is no product of units."""


@lru_cache(maxsize=1024)
def plain(text: str) -> str:
    """A unit in signs that Python reads.

    Raises Unreadable where the text is no product of units.

    >>> plain("kgf/cm²"), plain("N m"), plain("µm"), plain("-")
    ('kgf/cm**2', 'N*m', 'um', '-')
    """
    return "".join(token.text for token in _tokens(text)) if text.strip() not in _ALONE else text.strip()


@lru_cache(maxsize=1024)
def factors(text: str) -> tuple[Factor, ...]:
    """Units of a text with their powers, in its order; none of a pure number.

    Raises Unreadable where the text is no product of units.

    >>> [f"{name} {power}" for name, power in factors("kg/(m·s²)")]
    ['kg 1', 'm -1', 's -2']
    """
    return () if text.strip() in _ALONE else tuple(_Grammar(text).whole())


class _Token(NamedTuple):
    kind: str
    text: str


def _tokens(text: str) -> list[_Token]:
    """Tokens of a unit, a power behind its sign and a product in a space with its own."""
    found, end, divided, depth = list[_Token](), 0, set[int](), 0
    text = text.strip()
    while end < len(text):
        match = _TOKEN.match(text, end)
        if not match:
            raise Unreadable(text)
        end, kind, token = match.end(), str(match.lastgroup), match[str(match.lastgroup)]
        if match["gap"] and found and kind == "name" and found[-1].text not in ("*", "/", "(", "**"):
            if depth in divided:  # of W/m K nobody knows what is divided
                raise Unreadable(text)
            found.append(_Token("sign", "*"))
        if kind == "raised":
            over, _, under = token.translate(_RAISED).partition("/")
            power = ["(", over, "/", under, ")"] if under else [over]
            found += [_Token("sign", "**"), *(_Token("number" if p[-1].isdigit() else "sign", p) for p in power)]
            continue
        depth += {"(": 1, ")": -1}.get(token, 0)
        divided = {level for level in divided if level <= depth} | ({depth} if token == "/" else set())
        if kind == "name":
            token = _TYPED.get(token) or token.translate(_LETTERS)
        found.append(_Token(kind, _SIGNS.get(token, token) if kind == "sign" else token))
    return found


class _Grammar:
    """Reads a product of powers, token by token."""

    def __init__(self, text: str) -> None:
        self.text, self.tokens, self.at = text, _tokens(text), 0

    def whole(self) -> list[Factor]:
        found = list(self.product())
        if self.at < len(self.tokens):
            raise Unreadable(self.text)
        return found

    def taken(self, *texts: str) -> str:
        """The next token where it is one of these texts; "" otherwise."""
        if self.at < len(self.tokens) and self.tokens[self.at].text in texts:
            self.at += 1
            return self.tokens[self.at - 1].text
        return ""

    def next(self, kind: str) -> str:
        """The next token, which must be of this kind."""
        if self.at == len(self.tokens) or self.tokens[self.at].kind != kind:
            raise Unreadable(self.text)
        self.at += 1
        return self.tokens[self.at - 1].text

    def product(self) -> Iterator[Factor]:
        sign = "*"
        while sign:
            power = Fraction(-1 if sign == "/" else 1)
            base = list(self.base())
            power *= self.power() if self.taken("**") else 1
            yield from (Factor(name, p * power) for name, p in base)
            sign = self.taken("*", "/")

    def base(self) -> Iterator[Factor]:
        if self.taken("("):
            yield from list(self.product())
            if not self.taken(")"):
                raise Unreadable(self.text)
        elif not self.taken("1"):
            yield Factor(self.next("name"), Fraction(1))

    def power(self) -> Fraction:
        inside, sign = self.taken("("), self.taken("-", "+")
        power = Fraction(sign + self.next("number"))
        if inside:
            power /= Fraction(self.next("number")) if self.taken("/") else 1
            if not self.taken(")"):
                raise Unreadable(self.text)
        return power
