"""Units: constants to compute with, and display units written as in ``[kN*m]``.

>>> from mechsheet.units import MPa, kN
>>> 27.5 * kN / (25 * MPa)
0.0011

A constant is the number of SI units that its unit holds, for every SI unit with its prefixes and those that engineers
type; `define` adds one's own. A display unit is read into that factor and the exponents of the base units. Knows
nothing of the package; the stub beside this file tells the names, which type checkers and editors read.
"""

from typing import Any, NoReturn

from mechsheet.units.definitions import (
    PURE,
    Constant,
    Dims,
    Unit,
    celsius,
    constant,
    define,
    known,
    names,
    nearest,
    parse,
)
from mechsheet.units.exchange import ANGLE, BARE, CYCLES, alike, conversion, convertible, kind, turned
from mechsheet.units.printing import raised, shown, si, word
from mechsheet.units.text import UNKNOWN, plain

__all__ = [
    "ANGLE",
    "BARE",
    "CYCLES",
    "PURE",
    "UNKNOWN",
    "Constant",
    "Dims",
    "Unit",
    "alike",
    "celsius",
    "constant",
    "conversion",
    "convertible",
    "define",
    "kind",
    "known",
    "names",
    "nearest",
    "parse",
    "plain",
    "raised",
    "shown",
    "si",
    "turned",
    "word",
]


class _Named(list[str]):
    """Names for those who look them up; ``import *``, which takes them one after the other, is refused."""

    def __getitem__(self, _: Any) -> NoReturn:
        raise ImportError(
            "from mechsheet.units import * would bring every unit, and g, A or F is something else in a formula: "
            "name those that are used, such as from mechsheet.units import kN, mm"
        )


__all__ = _Named(__all__)


def __getattr__(name: str) -> float:
    """The constant of a unit, such as ``from mechsheet.units import kN``."""
    try:
        value = globals()[name] = constant(name)
    except KeyError:
        near = nearest(name)
        raise AttributeError(f"unit {name} is not known" + (f"; nearest: {', '.join(near)}" if near else "")) from None
    return value


def __dir__() -> list[str]:
    return sorted([*globals(), *filter(str.isidentifier, names())])
