"""What units hold: their definitions, prefixes, dimensions, and units of one's own."""

import re
import sys
from fractions import Fraction
from functools import lru_cache
from math import pi
from typing import NamedTuple

from mechsheet.units.text import Unreadable, factors

BASE = ("m", "kg", "s", "A", "K", "mol", "cd")
Dims = tuple[float, ...]  # exponents of the base units, in that order
PURE: Dims = (0,) * len(BASE)


class Unit(NamedTuple):
    """``factor`` times the display number is the SI number; ``dims`` are the exponents of `BASE`."""

    factor: float
    dims: Dims = PURE


class Constant(float):
    """The number of SI units that one of a unit holds: a float that knows its name, which a recording looks for."""

    __slots__ = ("unit",)
    unit: str

    def __reduce__(self) -> tuple[type[float], tuple[float]]:
        return float, (float(self),)  # another process computes with it


# Each by others, exactly: of SI as the 9th brochure has them, of the pound and the inch as agreed in 1959, the pound
# and the kilogram as forces by the standard acceleration of 9.80665 m/s², and mmHg, atm, cal and BTU by ISO 80000.
_DEFINITIONS = """
N = kg*m/s**2; Pa = N/m**2; J = N*m; W = J/s; Hz = 1/s; C = A*s; V = W/A; F = C/V; ohm = V/A; S = A/V; Wb = V*s
T = Wb/m**2; H = Wb/A; lm = cd; lx = lm/m**2; Bq = 1/s; Gy = J/kg; Sv = J/kg; kat = mol/s; sr = rad
g = 0.001 kg; L = 0.001 m**3; l = L; bar = 100000 Pa; Wh = 3600 J; t = 1000 kg
min = 60 s; h = 3600 s; day = 86400 s; degC = K
inch = 0.0254 m; mil = 0.001 inch; ft = 12 inch; yd = 3 ft; mile = 5280 ft; nmi = 1852 m; knot = nmi/h
acre = 43560 ft**2; gal = 231 inch**3; inHg = 25.4 mmHg
lb = 0.45359237 kg; oz = 0.0625 lb; slug = lbf*s**2/ft
kgf = 9.80665 N; tf = 1000 kgf; lbf = 4.4482216152605 N; kip = 1000 lbf
psi = lbf/inch**2; ksi = 1000 psi; atm = 101325 Pa; at = kgf/cm**2; mmHg = 133.322387415 Pa
hp = 550 lbf*ft/s; PS = 75 kgf*m/s; cal = 4.1868 J; BTU = 1055.05585262 J
"""
OF_ANGLE = {"rad": 1.0, "deg": pi / 180, "arcmin": pi / 10800, "arcsec": pi / 648000, "rev": 2 * pi}
_PREFIXES = {
    "q": -30, "r": -27, "y": -24, "z": -21, "a": -18, "f": -15, "p": -12, "n": -9, "u": -6, "m": -3, "c": -2, "d": -1,
    "da": 1, "h": 2, "k": 3, "M": 6, "G": 9, "T": 12, "P": 15, "E": 18, "Z": 21, "Y": 24, "R": 27, "Q": 30,
}  # fmt: skip
_OF_SI = "m s A K mol cd Hz N Pa J W C V F ohm S Wb T H lm lx Bq Gy Sv kat sr g L l"
PREFIXED = dict.fromkeys(_OF_SI.split(), tuple(_PREFIXES)) | {
    "rad": ("u", "m"), "bar": ("u", "m", "k", "M"), "Wh": ("m", "k", "M", "G"), "t": ("k", "M", "G"), "cal": ("k",),
}  # fmt: skip


# Words and signs of the trade that are no units here, with the one that is meant.
_MEANT = {
    "lbs": "lb", "pound": "lb", "feet": "ft", "foot": "ft", "inches": "inch", "sec": "s", "hr": "h", "hour": "h",
    "kp": "kgf", "kph": "km/h", "mph": "mile/h", "cc": "cm**3", "ccm": "cm**3", "degF": "degC", "degK": "K",
    "cSt": "mm**2/s", "cP": "mPa*s", "meter": "m", "metre": "m", "second": "s", "minute": "min", "degree": "deg",
    "radian": "rad", "gram": "g", "kilogram": "kg", "newton": "N", "pascal": "Pa", "joule": "J", "watt": "W",
    "kelvin": "K", "celsius": "degC", "percent": "%", "tonne": "t", "ton": "t", "liter": "L", "litre": "L",
    "bar": "bar", "hertz": "Hz", "volt": "V", "ampere": "A", "revolution": "rev", "micron": "um", "kmh": "km/h",
    "newtonmeter": "N*m", "newtonmetre": "N*m",
    "lbm": "lb", "ozf": "lbf", "lbft": "lbf*ft", "ftlb": "lbf*ft", "inlb": "lbf*inch", "lbin": "lbf*inch",
    "U": "rev", "upm": "rpm", "rps": "rev/s", "cps": "Hz", "torr": "mmHg", "var": "V*A", "gpm": "gal/min",
    "thou": "mil",
}  # fmt: skip
_PREFIX_WORDS = {"kilo": "k", "milli": "m", "mili": "m", "micro": "u", "centi": "c", "mega": "M", "giga": "G"}
_LIKE = "write units as m, kN*m, rad/s**2 or 1/m"


def _defined() -> dict[str, str]:
    lines = (line for lines in _DEFINITIONS.split("\n") for line in lines.split(";") if line)
    return {name.strip(): text.strip() for name, _, text in (line.partition("=") for line in lines)}


DEFINED = _defined()
# Units of one's own, with the file that defines each and the unit that it is made of.
_own: dict[str, tuple[tuple[Fraction | float, Dims], str, str]] = {}


def names() -> list[str]:
    """Names of all units, with their prefixes."""
    prefixed = (prefix + name for name, prefixes in PREFIXED.items() for prefix in prefixes)
    return list(dict.fromkeys([*BASE, *DEFINED, *OF_ANGLE, "rpm", "%", *_own, *prefixed]))


def parse(text: str) -> Unit:
    """Unit of a text such as ``MPa``, ``kN*m``, ``N·m``, ``kgf/cm^2``, ``mm²``, ``1/s``, ``%`` or ``-``, a number.

    Raises ValueError naming the text where a unit is unknown, and the nearest ones.

    >>> parse("kN*cm").factor, parse("m/s**2").dims
    (10.0, (1, 0, -2, 0, 0, 0, 0))
    """
    if (unit := known(text)) is None:
        raise ValueError(_unknown(text))
    return unit


@lru_cache(maxsize=4096)
def known(text: str) -> Unit | None:
    """Unit of a text; nothing where it is none, such as "open positions"."""
    try:
        factor, dims = _product(text)
    except (Unreadable, KeyError, AttributeError):  # the last of what is no text
        return None
    return Unit(float(factor), dims)


@lru_cache(maxsize=4096)
def _unknown(text: str) -> str:
    """Why a text is no unit, and which ones are nearest."""
    if not isinstance(text, str):
        return f"a unit must be a text between quotes, such as 'mm', not {text!r}"
    try:
        strange = next(factor.name for factor in factors(text) if known(factor.name) is None)
    except Unreadable:
        times = re.sub(r"(?<=[^\W\d_])[.-](?=[^\W\d_])", "*", text)  # N.m, N-m
        raised = re.sub(r"(?<=[^\W\d_])(-[1-9]|[2-9])", r"**\1", times)  # mm2
        return f"unit [{text}] is not known; " + (f"nearest: {raised}" if raised != text and known(raised) else _LIKE)
    of = f": {strange}" if strange != text else ""
    near = nearest(strange)
    return f"unit [{text}] is not known{of}; " + (f"nearest: {', '.join(near)}" if near else _LIKE)


def _product(text: str) -> tuple[Fraction | float, Dims]:
    factor, dims = Fraction(1), PURE
    for name, power in factors(text):
        size, of = single(name)
        factor *= size**power if power.denominator == 1 else float(size) ** float(power)  # type: ignore[assignment]
        dims = tuple(p + _number(power) * q for p, q in zip(dims, of, strict=True))
    return factor, dims


def _number(power: Fraction) -> float:
    return power.numerator if power.denominator == 1 else float(power)


@lru_cache(maxsize=1024)
def single(name: str) -> tuple[Fraction | float, Dims]:
    """Exact number and dimensions of a unit by its name; KeyError with the name where there is none."""
    if name in BASE:
        return Fraction(1), tuple(int(name == base) for base in BASE)
    if name in DEFINED:
        number, _, unit = DEFINED[name].rpartition(" ")
        size, dims = _product(unit)
        return Fraction(number or 1) * size, dims
    if name in OF_ANGLE:
        return OF_ANGLE[name], PURE
    if name == "%":
        return Fraction(1, 100), PURE
    if name == "rpm":
        return 2 * pi / 60, single("Hz")[1]
    if name in _own:
        return _own[name][0]
    for prefix in (name[:1], name[:2]):
        if prefix in PREFIXED.get(name.removeprefix(prefix), ()):
            size, dims = single(name.removeprefix(prefix))
            return size * Fraction(10) ** _PREFIXES[prefix], dims
    raise KeyError(name)


def counted(text: str) -> set[str]:
    """Names of the units in a text, instead of one of one's own those that it is made of."""
    names = {factor.name for factor in factors(text)}
    return names.union(*(counted(_own[name][2]) for name in names & _own.keys()))


def nearest(name: str) -> list[str]:
    """Units that are written much like another name, best first; of two that run together their product."""
    if meant := _MEANT.get(name) or _in_words(name.lower()) or _in_words(name.lower().removesuffix("s")):
        return [meant]
    every = names()
    if name[-1:] in ("g", "a") and name[:-1] in every and single(name[:-1])[1] == single("Pa")[1]:
        return [name[:-1]]  # a pressure over that of the air, or over none
    if name[:1] == "K" and f"k{name[1:]}" in every:
        return [f"k{name[1:]}"]
    halves = ((name[:n], name[n:]) for n in range(1, len(name)))
    plain = {*BASE, *DEFINED}
    if together := [f"{a}*{b}" for a, b in halves if a in every and (b in plain or (b in every and a[-1].isupper()))]:
        return together
    import difflib  # on use: only a mistaken unit needs it

    alike = [n for n in every if n.lower() == name.lower()]
    common = [n for n in every if n in DEFINED or n in BASE or n[:1] in "umckMG"]
    return alike[:3] or difflib.get_close_matches(name, common, n=2, cutoff=0.6)


def _in_words(name: str) -> str:
    """The unit of a word, or of one with a prefix before it that the unit takes; nothing where there is none."""
    for word, prefix in _PREFIX_WORDS.items():
        unit = prefix + _MEANT.get(name.removeprefix(word), "")
        if name.startswith(word) and unit != prefix and known(unit):
            return unit
    return _MEANT.get(name, "")


def constant(name: str) -> float:
    """The constant of a unit by its name; KeyError where there is none."""
    value = Constant(single(name)[0])
    value.unit = name
    return value


def celsius(degrees: float) -> float:
    """The temperature of a thermometer in degrees Celsius, in K: ``20*degC`` is a difference, ``celsius(20)`` is not.

    >>> celsius(20)
    293.15
    """
    return (degrees + 273.15) * constant("K")


def define(name: str, number: float, unit: str) -> float:
    """Add a unit of one's own, such as ``sheet = define("sheet", 0.6, "mm")``: the constant to compute with.

    From then on its name stands in display units and in texts such as ``3 sheet`` too. The worksheet that defines a
    unit may define it anew.

    Raises ValueError where the name is another unit already or no word of letters, or where the unit is not known.
    """
    if not (name.isidentifier() and name.isalpha()):
        raise ValueError(f"unit {name!r} must be a word of letters")
    parse(unit)
    size, dims = _product(unit)
    new, file = (Fraction(repr(float(number))) * size, dims), str(sys._getframe(1).f_globals.get("__file__", ""))
    old, owner, _ = _own.get(name, (None, "", ""))
    if old is None and known(name):
        old = single(name)
    if old == new:
        return constant(name)
    if old and owner != file:
        raise ValueError(f"unit {name} is {parse(name).factor!r} in SI units already, not {float(new[0])!r}")
    _own[name] = new, file, unit
    known.cache_clear()
    _unknown.cache_clear()
    single.cache_clear()
    return constant(name)
