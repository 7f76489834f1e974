"""Display units."""

import math

import pytest

from mechsheet import units
from mechsheet.units import parse


@pytest.mark.parametrize(
    ("text", "factor", "dims"),
    [
        ("m", 1, (1, 0, 0)),
        ("cm**2", 1e-4, (2, 0, 0)),
        ("MPa", 1e6, (-1, 1, -2)),
        ("kN*m", 1e3, (2, 1, -2)),
        ("rad/s**2", 1, (0, 0, -2)),
        ("1/m", 1, (-1, 0, 0)),
        ("kgf/cm**2", 98066.5, (-1, 1, -2)),
        ("%", 0.01, (0, 0, 0)),
        ("-", 1, (0, 0, 0)),
    ],
)
def test_factor_to_si_and_dimension(text, factor, dims):
    assert parse(text).factor == pytest.approx(factor, rel=1e-15)
    assert parse(text).dims == dims


SECONDS, TURN = {"s": 1, "ms": 1 / 1000, "μs": 1 / 1000**2, "min": 60, "h": 60 * 60}, 2 * math.acos(-1)
METRES = {"m": 1, "dm": 1 / 10, "cm": 1 / 100, "mm": 1 / 1000, "km": 1000}
KILOGRAMS = {"kg": 1, "g": 1 / 1000, "t": 1000}
IN_SI = {
    **SECONDS, **METRES, **KILOGRAMS,
    "N": 1, "kN": 1000, "MN": 1000**2, "kgf": 9.80665,
    "Pa": 1, "kPa": 1000, "MPa": 1000**2, "GPa": 1000**3, "bar": 10 / (METRES["cm"] ** 2),
    "W": 1, "kW": 1000, "J": 1, "kJ": 1000, "Hz": 1,
    "rad": 1, "deg": TURN / 360, "rev": TURN, "rpm": TURN / SECONDS["min"], "%": 1 / 100, "-": 1,
}  # fmt: skip


def test_every_unit_is_that_of_its_definition():
    """A unit that is in one worksheet alone, or in none, would be wrong unseen: bar is 10 N on a square centimetre."""
    assert IN_SI.keys() == units.UNITS.keys()
    assert {name: parse(name).factor for name in IN_SI} == pytest.approx(IN_SI, rel=1e-15)


@pytest.mark.parametrize("text", ["", "m^2", "foo", "2*m", "m*", "m**x", "f(m)", "Mpa", "m**'2'"])
def test_unknown_unit_is_named(text):
    with pytest.raises(ValueError, match="is not known") as error:
        parse(text)
    assert f"[{text}]" in str(error.value)


def test_a_micro_has_two_signs() -> None:
    assert parse("\u00b5s") == parse("\u03bcs") == parse("ms/m*mm")
    assert units.si("\u00b5s/m") == units.si("\u03bcs/m") == "s/m"


def test_newton_is_kilogram_metre_per_second_squared():
    assert parse("N") == parse("kg*m/s**2")
    assert parse("W") == parse("N*m/s")


def test_a_unit_is_a_constant_of_its_factor() -> None:
    assert (units.MPa, units.kgf, units.deg, units.min) == (1e6, 9.80665, math.pi / 180, 60.0)
    assert all(isinstance(getattr(units, name), float) for name in dir(units) if name in units.UNITS)
    with pytest.raises(AttributeError, match="unit Mpa is not known; nearest: MPa"):
        units.Mpa
