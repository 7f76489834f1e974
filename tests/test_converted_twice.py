"""Values in SI that a line converts though its unit does so by itself: angles, and temperatures to degrees Celsius."""

from pathlib import Path

import pytest

from mechsheet.recording.dimensions import mismatches
from tests.own_worksheet import written

SHEET = written(
    """
import math
import numpy as np
from math import pi

from mechsheet import ask, check, inputs, read
from mechsheet.units import K, celsius, deg, degC, rpm
""",
    """
T: float = 293.15  # [K] temperature; > 0
T_1: float = 350.0  # [K] temperature; > 0
t: float = 20.0  # [°C] difference
dT: float = 5.0  # [°C] difference
a: float = 30 * deg  # [deg] angle
n: float = 1200 * rpm  # [rpm] speed
z: float = 3.5  # [-] ratio
""",
    """
LINES
""",
)
ANGLES = [
    "x = np.degrees(g.a)  # [deg] angle",
    "x = np.rad2deg(g.a)  # [deg] angle",
    "x = np.degrees(np.linspace(0, 1, 3) * g.a)  # [deg] angles",
    "x = math.degrees(math.atan2(2.0, 1.0))  # [deg] angle",
    "x = g.a * 180 / pi  # [deg] angle",
    "x = -(180 / pi) * np.arctan2(g.z, 1)  # [deg] angle",
    "x = 57.296 * g.a  # [deg] angle",
    "x = 2 * math.degrees(g.a)  # [deg] angle",
    "x = g.n * 60 / (2 * pi)  # [rpm] speed",
    "x = 9.5493 * g.n  # [rpm] speed",
    "x = g.n * 2 * pi / 60  # [rad/s] speed",
    "x = np.radians(g.a)  # [deg] angle",
    "x = np.deg2rad(g.a)  # [rad] angle",
    "x = np.sin(np.radians(g.a))  # [-] sine",
    "x = math.cos(g.a * pi / 180)  # [-] cosine",
    "x = np.arcsin(g.z / 4)  # [deg] angle\ny = np.tan(math.radians(x))  # [-] tangent",
]
RIGHT_ANGLES = [
    "x = g.a  # [deg] angle\ny = g.n  # [rpm] speed",
    "x = np.degrees(g.a)  # [-] number of degrees\ny = x * pi / 180  # [deg] angle",
    "x = f'{np.degrees(g.a):.1f}' + str(math.degrees(g.a))",
    "print(math.degrees(g.a), g.n * 60 / (2 * pi))",
    "x = np.radians(45) + math.radians(g.z)  # [deg] angle",
    "x = np.sin(np.radians(np.degrees(g.a))) + np.cos(pi / 180 * g.z)  # [-] sum",
    "x = np.radians(2 * np.degrees(g.a))  # [deg] angle",
    "x = g.n / (2 * pi)  # [1/min] cycles",
    "x = 180 * g.a + 60 * g.a  # [deg] angle",
    "x = pi / 180 * g.z  # [deg] angle",
    "x = g.a * 180 / pi  # [deg] as printed (erratum)",
]
TEMPERATURES = [
    "x = g.T  # [°C] temperature",
    "x = g.T + g.dT  # [°C] temperature",
    "x = g.T + 10  # [°C] warmer",
    "x = 10 * degC + g.T  # [°C] warmer",
    "x = (g.T + g.T_1) / 2  # [°C] mean",
    "x = np.mean(np.array([g.T, g.T_1, g.T]))  # [°C] mean",
    "x = max(g.T, g.T_1)  # [°C] greater one",
    "y = celsius(20)  # [K] temperature\nx = y  # [°C] temperature",
    "x = g.t  # [K] temperature",
    "x = np.array([g.t, g.dT])  # [K] temperatures",
    "c = check('x', g.T, 373.15 * K, '°C')",
    "c = check('x', g.t + 273.15, 373.15, '°C')",
    "c = check('x', g.t + 273.15 + g.z * g.dT * np.exp(-g.z), 373.15, '°C')",
    "y = g.z * g.dT * np.exp(-g.z)  # [K] rise\nx = g.T + y  # [°C] temperature",
]
RIGHT_TEMPERATURES = [
    "x = g.T  # [K] temperature\ny = g.dT  # [°C] difference",
    "x = g.T_1 - g.T  # [°C] difference",
    "x = g.T_1 - g.T + g.dT  # [°C] difference",
    "x = g.T + g.dT  # [K] temperature",
    "x = g.t + celsius(0)  # [K] temperature",
    "x = g.T - celsius(0)  # [°C] over 0 °C",
    "x = g.T - 273.15 * K  # [°C] over 0 °C",
    "x = g.T - 273.15  # [°C] over 0 °C",
    "x = -273.15 + g.T  # [°C] over 0 °C",
    "x = g.T - 293.15  # [°C] over 20 °C",
    "x = -293.15 + g.T  # [°C] over 20 °C",
    "x = g.t + 273.15  # [K] temperature",
    "x = celsius(120) - celsius(20) + 5 * degC  # [K] rise",
    "x = g.t - g.dT  # [K] difference",
    "x = g.t + 273.15 + g.z * g.dT * np.exp(-g.z)  # [K] temperature",
    "x = g.t + g.z * g.dT * np.exp(-g.z)  # [°C] temperature",
    "x = g.z * g.dT + 20 * degC  # [K] rise",
    "c = check('x', g.T, 373.15 * K, 'K')",
]


def told(tmp_path: Path, lines: str) -> list[str]:
    path = tmp_path / "sheet.py"
    path.write_text(SHEET.replace("LINES", lines.replace("\n", "\n    ")), encoding="utf-8")
    return [str(mistake) for mistake in mismatches(path)]


@pytest.mark.parametrize("lines", ANGLES)
def test_an_angle_that_is_converted_twice_is_told(lines: str, tmp_path: Path) -> None:
    (mistake,) = told(tmp_path, lines)
    assert "is in SI already: write it without" in mistake and mistake.startswith("line ")


@pytest.mark.parametrize("lines", TEMPERATURES)
def test_a_temperature_in_the_unit_of_a_difference_is_told(lines: str, tmp_path: Path) -> None:
    (mistake,) = told(tmp_path, lines)
    assert "write it in [" in mistake and "celsius(0)" in mistake and "x" in mistake


@pytest.mark.parametrize("added", ["", " + g.z * g.dT * np.exp(-g.z)"])
def test_kelvins_by_a_typed_number_are_no_degrees(added: str, tmp_path: Path) -> None:
    """40 °C + 273.15 had been shown as 313.15 °C, and so had checks."""
    (mistake,) = told(tmp_path, f"x = g.t + 273.15{added}  # [°C] winding")
    assert "unit [°C] is of a difference: write a temperature in [K]" in mistake


@pytest.mark.parametrize("lines", [*RIGHT_ANGLES, *RIGHT_TEMPERATURES])
def test_what_is_converted_once_is_not_told(lines: str, tmp_path: Path) -> None:
    assert told(tmp_path, lines) == []
