"""Units that stand for each other: into which a number is converted, and in which a reader may want to see it.

Angles, cycles and pure numbers, which SI does not tell apart, are kept apart here.
"""

from contextlib import suppress
from functools import lru_cache
from math import pi

from mechsheet.units.definitions import OF_ANGLE, PURE, Dims, counted, parse
from mechsheet.units.printing import shown

ANGLE, CYCLES, BARE = "angle", "cycles", ""
# Of each dimension what a reader may want to see instead; moments and energies are told apart by what is typed. Of
# kelvins nobody knows whether they are a temperature or a difference.
_USUAL = (
    "m cm mm um km inch ft", "N kN MN kgf tf lbf kip", "N*m kN*m N*mm kgf*m kgf*cm lbf*ft lbf*inch", "J kJ MJ Wh kWh",
    "Pa kPa MPa GPa bar kgf/cm**2 psi ksi", "m**2 cm**2 mm**2 inch**2 ft**2", "m**3 cm**3 mm**3 L inch**3 ft**3",
    "m**4 cm**4 mm**4 inch**4", "kg g t lb", "kg*m**2 kg*cm**2 lb*inch**2", "s ms min h", "rad deg rev",
    "rad/s deg/s rpm", "Hz kHz", "rad/s**2 deg/s**2", "m/s mm/s km/h ft/s mile/h knot", "m/s**2 mm/s**2 ft/s**2",
    "W kW MW hp PS", "N/m N/mm kN/m kgf/cm lbf/inch", "m**3/s L/min L/s m**3/h", "kg/m**3 g/cm**3 lb/ft**3", "- %",
)  # fmt: skip

_RATES = ("rpm", "rad/s", "Hz", "1/min", "1/s")  # in which turns and cycles are told
_RATE = parse("1/s").dims


def kind(text: str) -> str:
    """What a unit counts: an angle as ``rpm`` and ``deg``, cycles as ``Hz`` and ``1/min``, or neither as ``1/s``."""
    names = counted(text)
    if names & {*OF_ANGLE, "rpm"}:
        return ANGLE
    unit = parse(text)
    return CYCLES if any(name.endswith("Hz") for name in names) or (unit.dims == _RATE and unit.factor != 1) else BARE


def turned(a: str, b: str) -> bool:
    """Whether one of two units counts an angle and the other one cycles in time, so that 2 pi stands between them."""
    return {kind(a), kind(b)} == {ANGLE, CYCLES} and parse(a).dims == parse(b).dims == _RATE


def conversion(given: str, own: str) -> float:
    """By what a number in the unit ``given`` is multiplied to be one in the unit ``own``.

    A cycle is a turn: 20 Hz are 1200 rpm, and 1200 1/min are.

    Raises ValueError saying why where the two do not measure the same, or nobody knows whether they do.

    >>> conversion("kN", "N"), round(conversion("Hz", "rpm")), round(conversion("1/min", "rpm"))
    (1000.0, 60, 1)
    """
    theirs, ours, counts, own_counts = parse(given), parse(own), kind(given), kind(own)
    ratio, printed = theirs.factor / ours.factor, shown(own, degree="deg")
    if theirs.dims != ours.dims or (counts != own_counts and theirs.dims == PURE):
        raise ValueError(f"{given} does not measure {printed}")
    if turned(given, own):
        return ratio * 2 * pi if counts == CYCLES else ratio / (2 * pi)
    if counts == own_counts or theirs.dims != _RATE or own_counts == CYCLES or (ratio == 1 and counts != CYCLES):
        return ratio
    raise ValueError(f"{given if own_counts else own} may count turns or radians: write it in {printed}")


def convertible(own: str) -> dict[str, float]:
    """Conversions of the usual units into ``own``, by each as it is typed and as it is printed.

    >>> [*convertible("rpm")]
    ['rpm', 'rad/s', 'deg/s', '°/s', 'Hz', '1/min']
    """
    found = dict[str, float]()
    for unit in (*alike(own), *_RATES):
        with suppress(ValueError):
            found |= dict.fromkeys((unit, shown(unit)), conversion(unit, own))
    return found


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
    fits = (g for g in groups if any(dims) and dims == parse(g[0]).dims and kind(text) == kind(g[0]))
    own = next((g for g in groups if text in g), None) or next(fits, [])
    return (text, *(unit for unit in own if unit != text))
