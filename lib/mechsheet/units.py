"""Units: constants to compute with, and display units written as in ``[kN*m]``.

>>> from mechsheet.units import MPa, kN
>>> 27.5 * kN / (25 * MPa)
0.0011

A constant is the number of SI units that its unit holds. A display unit is read into that factor and the exponents of
m, kg, s. Knows nothing of the package.
"""

import ast
import difflib
import re
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from math import pi
from unicodedata import normalize


@dataclass(frozen=True)
class Unit:
    """``factor`` times the display number is the SI number; ``dims`` are the exponents of (m, kg, s)."""

    factor: float
    dims: tuple[float, float, float] = (0, 0, 0)

    def __mul__(self, other: "Unit") -> "Unit":
        m, kg, s = (p + q for p, q in zip(self.dims, other.dims, strict=True))
        return Unit(self.factor * other.factor, (m, kg, s))

    def __pow__(self, n: float) -> "Unit":
        m, kg, s = (p * n for p in self.dims)
        return Unit(self.factor**n, (m, kg, s))

    def __truediv__(self, other: "Unit") -> "Unit":
        return self * other**-1


_LENGTH, _FORCE, _PRESSURE, _POWER, _ENERGY = (1, 0, 0), (1, 1, -2), (-1, 1, -2), (2, 1, -3), (2, 1, -2)
_KGF = 9.80665

UNITS = {  # names as Python reads them: the Greek letter for either sign of a micro
    **{name: Unit(f, _LENGTH) for name, f in {"m": 1, "km": 1e3, "dm": 0.1, "cm": 0.01, "mm": 1e-3}.items()},
    **{name: Unit(f, _FORCE) for name, f in {"N": 1, "kN": 1e3, "MN": 1e6, "kgf": _KGF}.items()},
    **{name: Unit(f, _PRESSURE) for name, f in {"Pa": 1, "kPa": 1e3, "MPa": 1e6, "GPa": 1e9, "bar": 1e5}.items()},
    **{name: Unit(f, _POWER) for name, f in {"W": 1, "kW": 1e3}.items()},
    **{name: Unit(f, _ENERGY) for name, f in {"J": 1, "kJ": 1e3}.items()},
    **{name: Unit(f, (0, 0, 1)) for name, f in {"s": 1, "ms": 1e-3, "μs": 1e-6, "min": 60, "h": 3600}.items()},
    **{name: Unit(f, (0, 1, 0)) for name, f in {"kg": 1, "g": 1e-3, "t": 1e3}.items()},
    **{name: Unit(f) for name, f in {"rad": 1, "deg": pi / 180, "%": 0.01, "-": 1, "rev": 2 * pi}.items()},
    "Hz": Unit(1, (0, 0, -1)),
    "rpm": Unit(2 * pi / 60, (0, 0, -1)),
}


def __getattr__(name: str) -> float:
    """The constant of a unit, such as ``from mechsheet.units import kN``."""
    if name in UNITS:
        return float(UNITS[name].factor)
    near = difflib.get_close_matches(name, UNITS, n=1)
    raise AttributeError(f"unit {name} is not known" + (f"; nearest: {near[0]}" if near else ""))


def __dir__() -> list[str]:
    return sorted([*globals(), *filter(str.isidentifier, UNITS)])


@cache
def parse(text: str) -> Unit:
    """Unit of a text such as ``MPa``, ``kN*m``, ``rad/s**2``, ``1/m``, ``%`` or ``-`` (a pure number).

    Raises ValueError naming the text where a unit is unknown.

    >>> parse("kN*cm").factor, parse("m/s**2").dims
    (10.0, (1, 0, -2))
    """
    if text in UNITS:
        return UNITS[text]
    try:
        return _unit(ast.parse(text, mode="eval").body)
    except (SyntaxError, ValueError, TypeError, KeyError):
        raise ValueError(f"unit [{text}] is not known; write units as m, kN*m, rad/s**2 or 1/m") from None


_POWERS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def raised(power: int) -> str:
    """A power as a raised number.

    >>> raised(-6)
    '⁻⁶'
    """
    return str(power).translate(_POWERS)


def shown(text: str, power: Callable[[int], str] = raised, times: str = "·") -> str:
    """Unit as a page or a workbook prints it, or a notation with its own powers and sign between units.

    >>> shown("kgf/cm**2"), shown("N*m"), shown("m/s**2", "^{}".format)
    ('kgf/cm²', 'N·m', 'm/s^2')
    """
    return re.sub(r"\*\*(-?\d+)", lambda raising: power(int(raising[1])), text).replace("*", times)


def si(text: str) -> str:
    """The unit without a factor that measures the same.

    >>> si("kgf*cm"), si("MPa"), si("deg"), si("%"), si("µs")
    ('N*m', 'Pa', 'rad', '-', 's')
    """

    def plain(match: re.Match[str]) -> str:
        name = normalize("NFKC", match[0])
        unit = UNITS[name]
        if unit.factor == 1:
            return name
        if unit.dims == (0, 0, 0):
            return "rad" if name in ("deg", "rev") else "-"
        if name == "rpm":
            return "rad/s"
        return next(n for n, u in UNITS.items() if u.dims == unit.dims and u.factor == 1)

    return re.sub(r"[^\W\d_]+|%", plain, text)


def _unit(node: ast.expr) -> Unit:
    match node:
        case ast.Name(name):
            return UNITS[name]
        case ast.Constant(1):
            return Unit(1)
        case ast.BinOp(left, ast.Mult(), right):
            return _unit(left) * _unit(right)
        case ast.BinOp(left, ast.Div(), right):
            return _unit(left) / _unit(right)
        case ast.BinOp(left, ast.Pow(), right):
            n: int | float = ast.literal_eval(right)
            return _unit(left) ** n
    raise KeyError(node)
