"""Units: constants, texts as they are typed, and units of one's own."""

import keyword
import math
import pickle
import pydoc
import re
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from scipy import constants

from mechsheet import units
from mechsheet.units import alike, define, definitions, exchange, parse, plain, shown, si
from mechsheet.worksheet.check import require
from mechsheet.worksheet.errors import SheetError
from mechsheet.worksheet.find import find
from mechsheet.worksheet.kinds import Input

M, KG, S, A, K, MOL, CD = np.eye(7, dtype=int)
KNOWN = [name for name in units.names() if name.isidentifier() and not keyword.iskeyword(name)]


@pytest.mark.parametrize(
    ("text", "factor", "dims"),
    [
        ("m", 1, M),
        ("cm**2", 1e-4, 2 * M),
        ("MPa", 1e6, KG - M - 2 * S),
        ("kN*m", 1e3, KG + 2 * M - 2 * S),
        ("rad/s**2", 1, -2 * S),
        ("1/m", 1, -M),
        ("kgf/cm**2", 98066.5, KG - M - 2 * S),
        ("%", 0.01, 0 * M),
        ("-", 1, 0 * M),
        ("W/(m*K)", 1, KG + M - 3 * S - K),
        ("V*s/A", 1, KG + 2 * M - 2 * S - 2 * A),
        ("mmol/L", 1, MOL - 3 * M),
        ("lx", 1, CD - 2 * M),
    ],
)
def test_factor_to_si_and_dimension(text, factor, dims):
    assert parse(text).factor == factor
    assert parse(text).dims == tuple(dims)


SECOND, METRE, KILOGRAM, TURN = 1, 1, 1, 2 * math.acos(-1)
INCH, POUND, GRAVITY = Fraction(254, 10000), Fraction(45359237, 10**8), Fraction(980665, 10**5)
DEFINED = {
    "inch": INCH, "ft": 12 * INCH, "yd": 36 * INCH, "mile": 63360 * INCH, "nmi": 1852, "knot": Fraction(1852, 3600),
    "min": 60, "h": 60 * 60, "day": 24 * 60 * 60, "degC": 1, "L": Fraction(1, 1000), "l": Fraction(1, 1000),
    "lb": POUND, "oz": POUND / 16, "slug": POUND * GRAVITY / (12 * INCH), "g": Fraction(1, 1000), "t": 1000,
    "kgf": GRAVITY, "tf": 1000 * GRAVITY, "lbf": POUND * GRAVITY, "kip": 1000 * POUND * GRAVITY,
    "psi": POUND * GRAVITY / INCH**2, "ksi": 1000 * POUND * GRAVITY / INCH**2, "bar": 10**5, "at": GRAVITY * 10**4,
    "hp": 550 * POUND * GRAVITY * 12 * INCH, "PS": 75 * GRAVITY, "Wh": 3600, "%": Fraction(1, 100),
    "mil": INCH / 1000, "gal": 231 * INCH**3, "acre": 43560 * (12 * INCH) ** 2,
    "rad": 1, "deg": TURN / 360, "arcmin": TURN / 360 / 60, "arcsec": TURN / 360 / 3600, "rev": TURN, "rpm": TURN / 60,
}  # fmt: skip
COHERENT = ["m", "kg", "s", "A", "K", "mol", "cd", "N", "Pa", "J", "W", "Hz", "C", "V", "F", "ohm", "S", "Wb", "T", "H"]
COHERENT += ["lm", "lx", "Bq", "Gy", "Sv", "kat", "sr"]
OF_SCIPY = {
    "inch": "inch", "ft": "foot", "yd": "yard", "mile": "mile", "nmi": "nautical_mile", "knot": "knot", "lb": "lb",
    "oz": "oz", "slug": "slug", "kgf": "kgf", "lbf": "lbf", "psi": "psi", "atm": "atm", "bar": "bar", "hp": "hp",
    "mil": "mil", "gal": "gallon", "acre": "acre", "L": "liter", "deg": "degree",
    "arcmin": "arcminute", "arcsec": "arcsecond", "min": "minute",
    "h": "hour", "day": "day", "BTU": "Btu", "cal": "calorie_IT", "g": "gram", "t": "metric_ton",
}  # fmt: skip
PREFIXES = {
    "quecto": "q", "ronto": "r", "yocto": "y", "zepto": "z", "atto": "a", "femto": "f", "pico": "p", "nano": "n",
    "micro": "u", "milli": "m", "centi": "c", "deci": "d", "deka": "da", "hecto": "h", "kilo": "k", "mega": "M",
    "giga": "G", "tera": "T", "peta": "P", "exa": "E", "zetta": "Z", "yotta": "Y", "ronna": "R", "quetta": "Q",
}  # fmt: skip


def test_every_unit_is_that_of_its_definition():
    """One that no worksheet uses would be wrong unseen."""
    simple = {name for name in units.names() if name not in definitions.PREFIXED.get(name[1:], ())}
    prefixed = (
        {p + n for n, prefixes in definitions.PREFIXED.items() for p in prefixes} - DEFINED.keys() - set(COHERENT)
    )
    assert simple - prefixed - definitions._own.keys() == {*DEFINED, *COHERENT, "atm", "mmHg", "inHg", "cal", "BTU"}
    assert {name: parse(name).factor for name in COHERENT} == dict.fromkeys(COHERENT, 1)
    assert {name: parse(name).factor for name in DEFINED} == {name: float(x) for name, x in DEFINED.items()}


def test_the_units_are_those_of_another_table():
    ours = {name: parse(name).factor for name in OF_SCIPY}
    assert ours == pytest.approx({name: getattr(constants, other) for name, other in OF_SCIPY.items()}, rel=1e-15)


def test_every_prefix_is_that_of_another_table():
    powers = {short: getattr(constants, name) for name, short in PREFIXES.items() if hasattr(constants, name)}
    powers |= {"r": 1e-27, "q": 1e-30, "R": 1e27, "Q": 1e30}
    assert powers.keys() == set(PREFIXES.values())
    for unit in ("m", "N", "Pa", "W", "V", "ohm"):
        own = {p: parse(p + unit).factor for p in powers}
        assert own == pytest.approx(powers, rel=1e-15)
    assert parse("mg").factor == 1e-6 and parse("kg") == parse("kg") and parse("ML").factor == 1e3


TYPED = [
    ("kgf/cm^2", "kgf/cm**2", "kgf/cm²"),
    ("N·m", "N*m", "N·m"),
    ("N m", "N*m", "N·m"),
    ("mm²", "mm**2", "mm²"),
    ("s⁻¹", "s**-1", "s⁻¹"),
    ("kg m²/s²", "kg*m**2/s**2", "kg·m²/s²"),
    ("W/(m K)", "W/(m*K)", "W/(m·K)"),
    ("l", "l", "l"),
    ("°", "deg", "°"),
    ("°C", "degC", "°C"),
    ("µm", "um", "µm"),
    ("μm", "um", "µm"),
    ("kΩ", "kohm", "kΩ"),
    ("in", "inch", "in"),
    ("in²", "inch**2", "in²"),
    (" - ", "-", "-"),
]


@pytest.mark.parametrize(("typed", "python", "printed"), TYPED)
def test_a_unit_as_it_is_typed_and_printed(typed, python, printed):
    assert (plain(typed), shown(python)) == (python, printed)
    assert parse(typed) == parse(python)
    assert parse(printed) == parse(python), "what is printed can be typed"


@pytest.mark.parametrize("text", ["", "foo", "2*m", "m*", "m**x", "f(m)", "m**'2'", "m/", "(m", "m)", "m**", "2"])
def test_unknown_unit_is_named(text):
    with pytest.raises(ValueError, match="is not known") as error:
        parse(text)
    assert f"[{text}]" in str(error.value)


def test_nobody_knows_what_is_divided():
    with pytest.raises(ValueError, match=re.escape("unit [W/m K] is not known")):
        parse("W/m K")


@pytest.mark.parametrize(
    ("text", "near"),
    [
        ("kn", ": kN"),
        ("Mpa", ": mPa, MPa"),
        ("kn*m", "kn; nearest: kN"),
        ("inches", ": inch"),
        ("Nm", ": N*m"),
        ("kNm/s", "kNm; nearest: kN*m"),
        ("LBF", ": lbf"),
        ("lbs", ": lb"),
        ("Newton*m", "Newton; nearest: N"),
        ("newtons", ": N"),
        ("Meters", ": m"),
        ("pounds", ": lb"),
        ("degrees", ": deg"),
        ("sec", ": s"),
        ("degF", ": degC"),
        ("kp/mm**2", "kp; nearest: kgf"),
        ("N/mm2", ": N/mm**2"),
        ("cm3/s", ": cm**3/s"),
        ("psig", ": psi"),
        ("barg", ": bar"),
        ("kPaa", ": kPa"),
        ("lbm", ": lb"),
        ("lbft", ": lbf*ft"),
        ("KN", ": kN"),
        ("Kg/m", "Kg; nearest: kg"),
        ("U/min", "U; nearest: rev"),
        ("min-1", ": min**-1"),
        ("milimeter", ": mm"),
        ("Millimetres", ": mm"),
        ("kilonewtons/m", "kilonewtons; nearest: kN"),
        ("Megapascal", ": MPa"),
        ("micrometer", ": um"),
        ("micron", ": um"),
        ("kmh", ": km/h"),
        ("percent", ": %"),
        ("Celsius", ": degC"),
        ("tonnes", ": t"),
        ("litre", ": L"),
        ("N.m", ": N*m"),
        ("kgf-cm", ": kgf*cm"),
        ("N.m/s2", ": N*m/s**2"),
    ],
)
def test_an_unknown_unit_is_told_with_the_nearest(text, near):
    with pytest.raises(ValueError, match=re.escape(f"unit [{text}] is not known")) as error:
        parse(text)
    assert str(error.value).endswith(near)
    parse(near.split(": ")[-1].split(", ")[0])


def test_a_micro_has_two_signs() -> None:
    assert parse("\u00b5s") == parse("\u03bcs") == parse("ms/m*mm")
    assert units.si("\u00b5s/m") == units.si("\u03bcs/m") == "s/m"


def test_newton_is_kilogram_metre_per_second_squared():
    assert parse("N") == parse("kg*m/s**2")
    assert parse("W") == parse("N*m/s")


def test_a_unit_is_a_constant_of_its_factor() -> None:
    assert (units.MPa, units.kgf, units.deg, units.min) == (1e6, 9.80665, math.pi / 180, 60.0)
    assert all(isinstance(getattr(units, name), float) for name in dir(units) if name in KNOWN)
    assert all(getattr(units, name) == parse(name).factor for name in KNOWN)
    with pytest.raises(AttributeError, match=r"unit Mpa is not known; nearest: mPa, MPa"):
        units.Mpa


def test_what_is_computed_with_constants_is_bare() -> None:
    from mechsheet.units import MPa, kN, mm

    assert type(640 * MPa) is type(kN / mm) is type(-kN) is type(kN**2) is float
    assert type(np.float64(2) * kN) is np.float64 and (np.arange(3) * kN).tolist() == [0, 1000, 2000]
    assert type(pickle.loads(pickle.dumps(kN))) is float and pickle.loads(pickle.dumps(kN)) == 1000


def test_a_difference_and_a_temperature() -> None:
    assert 20 * units.degC == 20
    assert units.celsius(20) == 293.15
    assert units.celsius(np.array([-273.15, 0])).tolist() == [0, 273.15]


def test_the_stub_tells_every_unit() -> None:
    """Type checkers and editors read it."""
    text = Path(units.__file__).with_suffix(".pyi").read_text(encoding="utf-8")
    told = [name.strip() for left in re.findall(r"^(.*) = _floats$", text, re.MULTILINE) for name in left.split(",")]
    assert told == KNOWN
    assert sorted(re.findall(r"import (\w+) as \1$", text, re.MULTILINE)) == sorted(units.__all__)


def test_units_are_imported_by_their_names() -> None:
    """All of them would be g, A and F too, and without a word none of them."""
    with pytest.raises(ImportError, match="name those that are used"):
        exec("from mechsheet.units import *")
    assert "define(" in pydoc.plain(pydoc.render_doc(units))


def test_a_unit_of_ones_own(own_units: None) -> None:
    sheet = define("sheet", 0.6, "mm")
    assert (sheet, parse("sheet**2").factor, parse("N/sheet").dims) == (6e-4, 3.6e-7, parse("N/m").dims)
    assert (units.sheet, si("N/sheet"), shown("sheet**2")) == (6e-4, "N/m", "sheet²")
    assert define("sheet", 0.7, "mm") == 7e-4 == parse("sheet").factor, "the worksheet that defines it may change it"
    globals_of_another = {"define": define, "__file__": "another.py"}
    assert eval("define('sheet', 0.7, 'mm')", globals_of_another) == 7e-4
    with pytest.raises(ValueError, match=r"unit sheet is 0\.0007 in SI units already, not 0\.0008"):
        eval("define('sheet', 0.8, 'mm')", globals_of_another)


@pytest.mark.parametrize(
    ("name", "unit", "why"),
    [("kN", "N", "unit kN is 1000.0 in SI units already"), ("a b", "m", "a word of letters"), ("x", "foo", "[foo]")],
)
def test_a_unit_that_cannot_be_ones_own(own_units: None, name: str, unit: str, why: str) -> None:
    with pytest.raises(ValueError, match=re.escape(why)):
        define(name, 2, unit)


def test_the_coherent_unit_measures_the_same() -> None:
    coherent = {name: parse(si(name)) for name in units.names()}
    assert len(coherent) > 700
    assert [name for name, unit in coherent.items() if unit.dims != parse(name).dims or unit.factor != 1] == []


def test_units_to_show_instead_measure_the_same() -> None:
    for group in exchange._USUAL:
        first, *others = group.split()
        assert alike(first) == (first, *others)
        assert {parse(unit).dims for unit in others} == {parse(first).dims}
    assert alike("J")[1] == "kJ" and alike("N*mm")[1] == "N*m", "energy and moment"
    assert alike("kg/s") == ("kg/s",)
    assert alike("K") == ("K",), "a temperature in kelvins is another number of degrees Celsius"


def test_errors_name_units_as_they_are_printed() -> None:
    area = Input("A", "cm**2", "area", "", False, ())
    for text in ("3 mm", "3 kN"):
        with pytest.raises(SheetError, match=r"does not measure cm²$"):
            area.read(text)
    with pytest.raises(SheetError, match=r"it reaches 1\.\.2 cm²$"):
        require(np.full(2, np.nan), np.full(2, 3e-4), (1e-4, 2e-4), "area", "cm**2")
    with pytest.raises(SheetError, match="lo = ∞ cm² for area must be finite"):
        find(lambda x: x, np.inf, 1.0, unknown="area", unknown_unit="cm**2")
