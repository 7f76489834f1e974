"""Numbers as texts: how many digits are shown, and how a notation writes them, with their unit."""

import re
from collections.abc import Callable, Iterable, Sequence
from decimal import Decimal
from fractions import Fraction
from functools import cache, lru_cache
from math import floor, inf, isfinite, isnan, log10
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mechsheet import units


class Notation(NamedTuple):
    """How the parts of a number and of its unit are written."""

    minus: str
    none: str  # NaN
    infinite: str
    power: str  # of ten, behind a number
    pair: str
    span: str
    degrees: str
    percent: str
    unit: str
    raised: str
    times: str  # between units


PLAIN = Notation("-", "nan", "inf", "{}e{:+03d}", "({}, {})", "..", " deg", " %", " {}", "**{}", "*")
CELL = PLAIN._replace(none="–", infinite="∞")  # of a table
AXIS = CELL._replace(minus="−")

_SMALLEST = 1e-6  # in the unit of a column: what is smaller may be nothing but rounding


def existing(value: Any) -> Any:
    """A value; None is a number that does not exist, as NaN is."""
    return np.nan if value is None else value


def significant(x: float, digits: int) -> str:
    """A number rounded to so many digits, as a power of ten where it has more before its point.

    >>> significant(0.000123456, 4), significant(15348729, 6)
    ('0.0001235', '1.53487e+07')
    """
    return f"{x:.{digits}g}"


def fixed(x: float, decimals: int, to: Notation = PLAIN) -> str:
    """A number with so many decimals; what rounds to zero has no sign.

    >>> fixed(-0.0004, 3), fixed(-2.5, 3, AXIS), fixed(float("nan"), 3, CELL)
    ('0.000', '−2.500', '–')
    """
    if not isfinite(x):
        return _unlimited(x, to)
    text = f"{x:z.{decimals}f}"
    return text if to.minus == "-" else text.replace("-", to.minus)


def _in_full(known: NDArray[np.float64], decimals: int) -> int:
    """So many decimals, or one or two more where no number has any behind them.

    >>> [_in_full(np.array(known), 1) for known in ([1.0, 1.25], [1.0, 1.5], [1.0, 4 / 3])]
    [2, 1, 1]
    """
    for more in (decimals, decimals + 1, decimals + 2):
        if (np.abs(known - np.round(known, more)) <= 1e-6 * 10.0**-more).all():
            return more
    return decimals


def enough(values: ArrayLike, decimals: int) -> int:
    """So many decimals, or more where these show numbers in full, or left less than two digits of the largest: three.

    Of one with more than six digits before its point only so many that these are nine in all.

    >>> enough([0, 2.3e-4], 1), enough([0.2, 1.3], 1), enough([3.15, 12.5], 1), enough([1e-12], 1)
    (6, 1, 2, 1)
    >>> enough([1 / 3, 7654321.1], 3), enough([1 / 3, 4.8e14], 3)
    (2, 0)
    """
    known = np.asarray(values, float)
    known = known[np.isfinite(known)]
    decimals = _in_full(known, decimals)
    largest = np.abs(known).max(initial=0.0)
    if largest < _SMALLEST:
        return decimals
    place = floor(log10(largest))
    return min(decimals, max(8 - place, 0)) if largest >= 10.0 ** (1 - decimals) else 2 - place


def scientific(x: float, decimals: int, to: Notation = PLAIN) -> str:
    """A number as a power of ten.

    >>> scientific(0.00123, 1)
    '1.2e-03'
    """
    return f"{x:z.{decimals}e}".replace("-", to.minus) if isfinite(x) else _unlimited(x, to)


def usual(x: float, to: Notation) -> str:
    """Five significant digits or all before the point, six of what has no more; a power of ten outside 1e-3..1e6.

    >>> usual(0.4150004, AXIS), usual(129613.7, AXIS), usual(-1.5e-7, AXIS), usual(9.80665, AXIS)
    ('0.415', '129614', '−1.5e−07', '9.80665')
    """
    if not isfinite(x):
        return _unlimited(x, to)
    if 1e5 <= abs(x) < 1e6:
        return f"{x:.0f}".replace("-", to.minus)
    digits = 6 if f"{x:.6g}" == f"{x:.12g}" else 5  # as it was typed
    if is_plain(x):
        return f"{float(f'{x:.{digits}g}') + 0.0:.15g}".replace("-", to.minus)  # no sign of zero
    mantissa, exponent = f"{x:.{digits - 1}e}".split("e")
    return to.power.format(mantissa.rstrip("0").rstrip("."), int(exponent)).replace("-", to.minus)


def as_typed(x: float, to: Notation) -> str:
    """A number with all the digits that are typed of it.

    >>> as_typed(1.226869, AXIS), as_typed(123456.7, AXIS), as_typed(7.6543212e-9, AXIS), as_typed(27.50, AXIS)
    ('1.226869', '123456.7', '7.6543212e−09', '27.5')
    """
    if not isfinite(x) or float(f"{x:.6g}") == x:
        return usual(x, to)
    if is_plain(x):
        return np.format_float_positional(x, trim="-").replace("-", to.minus)
    mantissa, exponent = np.format_float_scientific(x, trim="-").split("e")
    return to.power.format(mantissa, int(exponent)).replace("-", to.minus)


def is_plain(x: float) -> bool:
    """Whether the usual text of a finite number needs no power of ten."""
    return x == 0 or 1e-3 <= abs(x) < 1e6


def value(values: Any, unit: str, to: Notation) -> str:
    """SI value in its display unit; a point or a vector as a pair.

    A few numbers stand in full, a small matrix in rows; of more numbers the least .. the greatest, with how many there
    are not, of more points the least .. the greatest x and y; of no numbers that there are none.
    Beside numbers that are 1e15 times as large, one of their rounding is about 0.
    """
    return in_any_unit(values)(unit, to)


def in_any_unit(values: Any) -> Callable[[str, Notation], str]:
    """What `value` says of the values in a unit and a notation; they are looked at once."""
    field = np.asarray(values)
    if not field.size:
        return lambda unit, to: "none"
    least = rounding(field)
    if _in_rows(field):
        rows = field.tolist()
        return lambda unit, to: "[" + "; ".join(_each(row, least, unit, to) for row in rows) + "]" + behind(unit, to)
    if in_full(field):
        all_of_them = field.ravel().tolist()
        return lambda unit, to: _each(all_of_them, least, unit, to) + behind(unit, to)
    if field.dtype.kind != "c":
        ends, lost = _ends(field), int(np.count_nonzero(np.isnan(field)))
        of = f" ({lost} of {field.size} {{}})" if 0 < lost < field.size else ""
        return lambda unit, to: _from_to(ends, least, unit, to) + behind(unit, to) + of.format(to.none)
    x, y = _ends(field.real), _ends(field.imag)
    return lambda unit, to: (
        to.pair.format(_from_to(x, least, unit, to), _from_to(y, least, unit, to)) + behind(unit, to)
    )


def in_full(values: Any) -> bool:
    """Whether all numbers of a field stand where it is shown."""
    field = np.asarray(values)
    return _in_rows(field) or field.size <= (_MOST_POINTS if field.dtype.kind == "c" else _MOST_NUMBERS)


def _in_rows(field: NDArray[Any]) -> bool:
    return field.ndim == 2 and max(field.shape) <= _MOST_ROWS


_MOST_NUMBERS, _MOST_POINTS, _MOST_ROWS = 10, 4, 4  # that stand in full
ROUNDING = 2.0**-48


def rounding(field: NDArray[Any]) -> float:
    """16 roundings of the largest finite number of a field: what is less may be nothing but these."""
    if field.dtype.kind not in "fc":
        return 0.0
    return ROUNDING * float(np.max(np.abs(field), where=np.isfinite(field), initial=0.0))


def is_rounding(values: Any, terms: ArrayLike) -> bool:
    """Whether numbers that are sums of terms, by their magnitudes, are none but 16 roundings of these or less.

    >>> is_rounding([3e-12, 0.0], [1e5, 2e5]), is_rounding([3e-9, 0.0], [1e5, 2e5]), is_rounding(0.0, 1e5)
    (True, False, False)
    """
    field, sizes = np.asarray(values), np.asarray(terms)
    if field.dtype.kind not in "fc" or not sizes.any() or not field.any():
        return False
    alike = sizes.shape in ((), field.shape)
    return bool((np.abs(field) <= ROUNDING * (sizes if alike else sizes.min())).all())


def _each(values: list[Any], least: float, unit: str, to: Notation) -> str:
    return ", ".join(_end(x, least, unit, to) for x in values)


def _ends(field: NDArray[Any]) -> tuple[float, ...]:
    """Least and greatest number that there is; a NaN where there is none."""
    known = field[~np.isnan(field)]
    return (known.min().item(), known.max().item()) if known.size else (field.flat[0].item(),)


def _from_to(ends: tuple[float, ...], least: float, unit: str, to: Notation) -> str:
    """Least and greatest number, without their unit."""
    return to.span.join(dict.fromkeys(_end(end, least, unit, to) for end in ends))


def quantity(z: float | complex, unit: str, to: Notation) -> str:
    """Number or pair in its display unit."""
    return _number(z, to) + behind(unit, to)


@lru_cache(maxsize=32768, typed=True)  # most numbers stay when an input changes; 0 and 0j are not shown alike
def _end(end: float | complex, least: float, unit: str, to: Notation) -> str:
    if isinstance(end, complex):
        return to.pair.format(_end(end.real, least, unit, to), _end(end.imag, least, unit, to))
    return "≈ 0" if 0 < abs(end) < least else usual(end / units.parse(unit).factor, to)


@lru_cache(maxsize=4096, typed=True)
def _number(z: float | complex, to: Notation) -> str:
    return to.pair.format(usual(z.real, to), usual(z.imag, to)) if isinstance(z, complex) else usual(z, to)


@cache
def behind(unit: str, to: Notation) -> str:
    """A unit as it stands behind a number; a pure number has none."""
    special = {"-": "", "deg": to.degrees, "%": to.percent}
    if unit in special:
        return special[unit]
    degree = to.degrees.strip()
    return to.unit.format(units.shown(unit, lambda power: _raised(power, to), to.times, degree))


def _raised(power: Fraction, to: Notation) -> str:
    text = str(power) if power.denominator == 1 or to.raised != PLAIN.raised else f"({power})"
    return to.raised.format(text.replace("-", to.minus))


def _unlimited(x: float, to: Notation) -> str:
    return to.none if isnan(x) else ("" if x == inf else to.minus) + to.infinite


def span(texts: Iterable[str]) -> str:
    """Least..greatest, one text where they are equal.

    >>> span(["1", "2"]), span(["1", "1"])
    ('1..2', '1')
    """
    return PLAIN.span.join(dict.fromkeys(texts))


def apart(values: Sequence[float], unit: str = "-", digits: int = 4) -> list[str]:
    """The SI numbers in a display unit, with as many digits as tell unequal ones apart (17 always do).

    >>> apart([0.5, 0.50001], "mm"), apart([-inf, 1.0])
    (['500', '500.01'], ['-∞', '1'])
    """
    factor = Decimal(repr(float(units.parse(unit).factor)))
    shown = [Decimal(float(v)) / factor for v in values]
    while True:
        rounded = [Decimal(f"{v:.{digits - 1}e}").normalize() for v in shown]
        if len(set(rounded)) == len(set(shown)) or digits == 17:
            texts = (f"{v:f}" if -6 < v.adjusted() < 15 else f"{v:e}" for v in rounded)
            return [text.replace("Infinity", CELL.infinite) for text in texts]
        digits += 1


def in_line(values: Sequence[float], unit: str) -> list[str]:
    """The SI numbers in a display unit with the digits of a line, or with as many more as tell unequal ones apart.

    >>> in_line([0.05242193], "mm"), in_line([12345.67], "N"), in_line([1.000001, 1.0], "-")
    (['52.422'], ['12346'], ['1.000001', '1'])
    >>> in_line([1.5e-9, 7.713842e6], "-")
    ['1.5e-9', '7.7138e6']
    """
    factor = units.parse(unit).factor
    texts = [usual(v / factor, PLAIN._replace(power="{}e{:d}")) for v in values]
    return texts if len(set(texts)) == len(set(values)) else apart(values, unit, 6)


def amount(x: float, unit: str, digits: int = 4) -> str:
    """An SI number in its display unit, which is written behind it.

    >>> amount(0.5, "mm"), amount(2.0, "-")
    ('500 mm', '2')
    """
    return apart([x], unit, digits)[0] + suffix(unit)


def extent(values: ArrayLike, unit: str) -> str:
    """Least..greatest of SI numbers as in a line, one number where they are equal but for rounding.

    >>> extent([0.5, 1.0], "mm"), extent([0.1 + 0.2, 0.3], "mm")
    ('500..1000 mm', '300 mm')
    """
    ends = np.array([np.nanmin(values), np.nanmax(values)], float)
    known = ends[:1] if ends[1] - ends[0] <= rounding(ends) else ends
    return span(in_line(known.tolist(), unit)) + suffix(unit)


def suffix(unit: str) -> str:
    """A unit behind a number in plain text, as it is printed; a pure number has none.

    >>> suffix("m/s**2"), suffix("deg"), suffix("-")
    (' m/s²', ' deg', '')
    """
    return "" if unit == "-" else f" {in_text(unit)}"


def in_text(unit: str) -> str:
    """A unit in plain text, such as a head in the terminal: degrees and broken powers as they are typed.

    >>> in_text("deg/s"), in_text("N*m"), in_text("MPa*m**0.5")
    ('deg/s', 'N·m', 'MPa·m^(1/2)')
    """
    return units.shown(
        unit, lambda n: units.raised(n) if n.denominator == 1 else f"^({n})", degree=PLAIN.degrees.strip()
    )


_POWER = r"(?<!\w)(?<!\w\.)(\d+(?:\.\d*)?)e([+-]?\d+)\b"
_QUOTED = r"((?<!\w)'[^']*'(?!\w)|(?<!\w)&#x27;.*?&#x27;(?!\w))"
_COMPARED = "(>|<|&gt;|&lt;)="
_SIGNS = {">": "≥", "<": "≤", "&gt;": "≥", "&lt;": "≤"}
_HYPHEN = r"(?<![\w.)])-(?=[\d.∞])|(?<=\.\.)-|(?<= )-(?= )"


def rewritten(text: str, to: Notation, raised: Callable[[int], str] = str) -> str:
    """Numbers, degrees and comparisons of a plain text as a notation writes them, powers of ten ``raised``.

    What stands between quotes is as it was typed.

    >>> rewritten("-2e-05..3.5e+30 deg, x2e3, '-2e5' must be >= -1", ON_PAGE, units.raised)
    "−2·10⁻⁵..3.5·10³⁰°, x2e3, '-2e5' must be ≥ −1"
    """
    parts = enumerate(re.split(_QUOTED, text))
    return "".join(part if n % 2 else _rewritten(part, to, raised) for n, part in parts)


def _rewritten(text: str, to: Notation, raised: Callable[[int], str]) -> str:
    text = re.sub(_HYPHEN, to.minus, re.sub(r"(?<=\d) deg\b", to.degrees, text))
    text = re.sub(_COMPARED, lambda sign: _SIGNS[sign[1]], text)
    return re.sub(_POWER, lambda e: to.power.format(e[1], raised(int(e[2])).replace("-", to.minus)), text)


ON_PAGE = AXIS._replace(power="{}·10{}", degrees="°")  # where nothing can be raised but by signs of their own


def on_page(text: str) -> str:
    """A plain text as the page writes it where it takes no HTML."""
    return rewritten(text, ON_PAGE, units.raised)


def aligned(rows: Sequence[Sequence[str]]) -> list[str]:
    """Rows of equally many texts as lines of columns."""
    wide = [max(map(len, column)) for column in zip(*rows, strict=True)]
    return ["  ".join(text.ljust(w) for text, w in zip(row, wide, strict=True)).rstrip() for row in rows]
