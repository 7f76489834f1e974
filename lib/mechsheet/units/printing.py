"""Units as a page or a workbook prints them, without their factors, and in the words of the base units."""

import re
from collections.abc import Callable
from fractions import Fraction
from functools import lru_cache

from mechsheet.units.definitions import BASE, DEFINED, OF_ANGLE, PREFIXED, Dims, known, single
from mechsheet.units.text import UNKNOWN, factors, plain

_POWERS = str.maketrans("-/0123456789", "⁻⁄⁰¹²³⁴⁵⁶⁷⁸⁹")
_RAISING = re.compile(r"\*\*(?:\(([+-]?[\d.]+)(?:/([\d.]+))?\)|([+-]?[\d.]+))")
_PRINTED = {"degC": "°C", "inch": "in"}


def raised(power: int | Fraction) -> str:
    """A power as a raised number.

    >>> raised(-6), raised(Fraction(1, 2))
    ('⁻⁶', '¹⁄²')
    """
    return str(power).translate(_POWERS)


def shown(text: str, power: Callable[[Fraction], str] = raised, times: str = "·", degree: str = "°") -> str:
    """Unit as a page or a workbook prints it, or a notation with its own powers, sign between units and degree.

    A text that is no product of units stands as it is.

    >>> shown("kgf/cm**2"), shown("N*m"), shown("m/s**2", "^{}".format), shown("um"), shown("inch"), shown("deg/s")
    ('kgf/cm²', 'N·m', 'm/s^2', 'µm', 'in', '°/s')
    >>> shown("MPa*m**0.5"), shown("open positions")
    ('MPa·m¹⁄²', 'open positions')
    """
    if text != UNKNOWN:
        if known(text) is None:
            return text
        text = plain(text)
    names = re.sub(r"[^\W\d_]+", lambda name: degree if name[0] == "deg" else _printed(name[0]), text)
    return _RAISING.sub(lambda by: power(Fraction(by[1] or by[3]) / Fraction(by[2] or 1)), names).replace("*", times)


def _printed(name: str) -> str:
    if name.endswith("ohm"):
        name = name.removesuffix("ohm") + "Ω"
    is_micro = "u" in PREFIXED.get(name[1:].replace("Ω", "ohm"), ()) and name[0] == "u"
    return "µ" + name[1:] if is_micro else _PRINTED.get(name, name)


def product(of: dict[str, Fraction]) -> str:
    """Units with their powers as text, ``-`` where there is none.

    >>> product({"N": Fraction(1), "m": Fraction(-2)}), product({"s": Fraction(-1)}), product({})
    ('N/m**2', '1/s', '-')
    """
    over = "*".join(_power(name, p) for name, p in of.items() if p > 0)
    under = "".join("/" + _power(name, -p) for name, p in of.items() if p < 0)
    return (over or "1" * bool(under)) + under or "-"


def _power(name: str, power: Fraction) -> str:
    if power == 1:
        return name
    return f"{name}**{power}" if power.denominator == 1 else f"{name}**({power})"


def si(text: str) -> str:
    """The unit without a factor that measures the same.

    >>> si("kgf*cm"), si("MPa"), si("deg"), si("%"), si("L/min")
    ('N*m', 'Pa', 'rad', '-', 'm**3/s')
    """
    if text in ("", UNKNOWN):
        return text
    found = dict[str, Fraction]()
    for name, power in factors(text):
        for part, own in factors(_coherent(name)):
            found[part] = found.get(part, Fraction(0)) + own * power
    return product(found)


@lru_cache(maxsize=1024)
def _coherent(name: str) -> str:
    size, dims = single(name)
    if name in OF_ANGLE:
        return "rad"
    if name == "rpm":
        return "rad/s"
    if size == 1 and name != "degC":
        return name
    if not any(dims):
        return "-"
    named = (n for n in (*BASE, *DEFINED) if single(n) == (1, dims))
    return next(named, "") or word(dims)


def word(dims: Dims) -> str:
    """A product of the base units with these exponents."""
    return product({n: Fraction(p).limit_denominator(99) for n, p in zip(BASE, dims, strict=True) if p})
