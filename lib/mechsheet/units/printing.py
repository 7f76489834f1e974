"""Units as a page or a workbook prints them, without their factors, and in the words of the base units."""

import re
from collections.abc import Callable
from fractions import Fraction
from functools import lru_cache

from mechsheet.units.definitions import BASE, DEFINED, OF_ANGLE, PREFIXED, Dims, parse, single
from mechsheet.units.text import UNKNOWN, factors, plain

_POWERS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
_PRINTED = {"degC": "°C", "inch": "in"}
# Of each dimension what a reader may want to see instead; moments and energies are told apart by what is typed. Of
# kelvins nobody knows whether they are a temperature or a difference.
_USUAL = (
    "m cm mm um km inch ft", "N kN MN kgf tf lbf kip", "N*m kN*m N*mm kgf*m kgf*cm lbf*ft lbf*inch", "J kJ MJ Wh kWh",
    "Pa kPa MPa GPa bar kgf/cm**2 psi ksi", "m**2 cm**2 mm**2 inch**2 ft**2", "m**3 cm**3 mm**3 L inch**3 ft**3",
    "m**4 cm**4 mm**4 inch**4", "kg g t lb", "kg*m**2 kg*cm**2 lb*inch**2", "s ms min h", "rad deg rev",
    "rad/s deg/s rpm", "rad/s**2 deg/s**2", "m/s mm/s km/h ft/s mile/h knot", "m/s**2 mm/s**2 ft/s**2", "W kW MW hp PS",
    "N/m N/mm kN/m kgf/cm lbf/inch", "m**3/s L/min L/s m**3/h", "kg/m**3 g/cm**3 lb/ft**3", "- %",
)  # fmt: skip


def raised(power: int) -> str:
    """A power as a raised number.

    >>> raised(-6)
    '⁻⁶'
    """
    return str(power).translate(_POWERS)


def shown(text: str, power: Callable[[int], str] = raised, times: str = "·", degree: str = "°") -> str:
    """Unit as a page or a workbook prints it, or a notation with its own powers, sign between units and degree.

    A text that is no product of units stands as it is.

    >>> shown("kgf/cm**2"), shown("N*m"), shown("m/s**2", "^{}".format), shown("um"), shown("inch"), shown("deg/s")
    ('kgf/cm²', 'N·m', 'm/s^2', 'µm', 'in', '°/s')
    >>> shown("open positions")
    'open positions'
    """
    if text != UNKNOWN:
        try:
            parse(text)
        except ValueError:
            return text
        text = plain(text)
    names = re.sub(
        r"[^\W\d_]+", lambda name: degree if name[0] == "deg" else _printed(name[0]), text.replace("**(", "^(")
    )
    return re.sub(r"\*\*(-?\d+)", lambda raising: power(int(raising[1])), names).replace("*", times)


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
    return f"{name}**{power}" if power.denominator == 1 else f"{name}^({power})"


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


def alike(text: str) -> tuple[str, ...]:
    """Units in which a quantity may be shown instead, its own first; that one alone where no other is usual.

    >>> alike("kN*m")[:3], alike("kg/s"), alike("positions")
    (('kN*m', 'N*m', 'N*mm'), ('kg/s',), ('positions',))
    """
    try:
        return _alike(text, parse(text).dims)
    except ValueError:  # what is counted, in words
        return (text,)


@lru_cache(maxsize=1024)  # a unit of one's own may come to measure something else
def _alike(text: str, dims: Dims) -> tuple[str, ...]:
    groups = [group.split() for group in _USUAL]
    fits = (g for g in groups if any(dims) and dims == parse(g[0]).dims)
    own = next((g for g in groups if text in g), None) or next(fits, [])
    return (text, *(unit for unit in own if unit != text))
