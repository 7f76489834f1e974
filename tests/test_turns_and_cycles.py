"""Turns, cycles and radians in time: SI has one dimension for them, and a factor of 2 pi lies between."""

from __future__ import annotations

from contextlib import chdir
from math import pi
from pathlib import Path
from typing import Any

import pytest
from as_script import as_script

from mechsheet import evaluate, load, sweep, units
from mechsheet.html import fields as html_fields
from mechsheet.recording.dimensions import mismatches
from mechsheet.units import alike
from mechsheet.worksheet import inputs
from mechsheet.worksheet.errors import SheetError
from tests.own_worksheet import written

SHEET = written(
    """
from numpy import linspace, maximum, pi, sqrt

from mechsheet import ask, inputs, read
from mechsheet.units import Hz, deg, min, rpm, s
""",
    """
n: float = 1200 * rpm  # [rpm] speed; > 0
omega: float = 40.0  # [rad/s] angular velocity
f: float = 20 * Hz  # [Hz] frequency
k: float = 3 / s  # [1/s] rate
z: float = 3.5  # [-] ratio
phi: float = 30 * deg  # [deg] angle
c: float = 2000.0  # [N/m] stiffness; > 0
m: float = 20.0  # [kg] mass; > 0
F: float = 100.0  # [N] tension; > 0
L: float = 2.0  # [m] length; > 0
""",
    """
n_1 = 1 * g.n  # [rpm] speed
LINES
""",
)
RPM = 2 * pi / 60


@pytest.fixture(scope="module")
def drive(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("sheet") / "drive.py"
    path.write_text(SHEET.replace("LINES", "pass"), encoding="utf-8")
    return path


@pytest.mark.parametrize(
    ("given", "si"),
    [
        ({"n": "20 Hz"}, 40 * pi),
        ({"n": "1200 1/min"}, 40 * pi),
        ({"n": "1200 min⁻¹"}, 40 * pi),
        ({"n": "20 rev/s"}, 40 * pi),
        ({"n": "20 rad/s"}, 20.0),
        ({"omega": "50 Hz"}, 100 * pi),
        ({"omega": "60 1/min"}, 2 * pi),
        ({"omega": "20 1/s"}, 20.0),
        ({"f": "1200 rpm"}, 20.0),
        ({"f": "0,05 kHz"}, 50.0),
        ({"f": "20 1/s"}, 20.0),
        ({"f": f"{2 * pi} rad/s"}, 1.0),
        ({"k": "20 rad/s"}, 20.0),
    ],
)
def test_a_cycle_is_a_turn_wherever_it_is_typed(drive: Path, given: dict[str, Any], si: float) -> None:
    ((name, text),) = given.items()
    cls = load(drive).inputs
    assert getattr(inputs.build(cls, given), name) == pytest.approx(si, rel=1e-14)
    (field,) = [each for each in html_fields.told(cls())["fields"] if each["name"] == name]
    number, _, unit = text.replace(",", ".").partition(" ")
    if unit in field["units"]:  # of the page in one file: what it takes it converts alike
        assert float(number) * field["units"][unit] * field["factor"] == pytest.approx(si, rel=1e-14)


def test_arguments_scenes_and_sweeps_convert_alike(drive: Path, tmp_path: Path) -> None:
    scene = tmp_path / "fast.toml"
    scene.write_text('[inputs]\nn = "25 Hz"\n', encoding="utf-8")
    with chdir(tmp_path):
        for given in ("--n=25 Hz", f"--scene={scene}", "--n=1500 1/min"):
            assert as_script(drive, given, "--want=n_1").stdout == "n_1 = 1500 rpm, speed\n"
    assert evaluate(drive, ["n_1"], n="25 Hz")["n_1"] == pytest.approx(1500 * RPM)
    assert sweep(drive, ["n_1"], {"n": ["25 Hz", "1500 1/min"]})["n_1"] == pytest.approx([1500 * RPM] * 2)


@pytest.mark.parametrize(
    ("given", "why"),
    [
        ({"n": "20 1/s"}, "speed n = '20 1/s': 1/s may count turns or radians: write it in rpm"),
        ({"k": "50 Hz"}, "rate k = '50 Hz': 1/s may count turns or radians: write it in 1/s"),
        ({"k": "60 rpm"}, "rate k = '60 rpm': 1/s may count turns or radians: write it in 1/s"),
        ({"n": "20 N"}, "speed n = '20 N': N does not measure rpm"),
        ({"phi": "30 %"}, "angle phi = '30 %': % does not measure deg"),
        ({"z": "30 deg"}, "ratio z = '30 deg': deg does not measure -"),
    ],
)
def test_what_may_be_meant_otherwise_is_refused(drive: Path, given: dict[str, Any], why: str) -> None:
    """Both readings of it are in use, and one is wrong by 2 pi or more."""
    cls = load(drive).inputs
    with pytest.raises(SheetError) as error:
        inputs.build(cls, given)
    assert str(error.value) == why
    ((name, text),) = given.items()
    (field,) = [each for each in html_fields.told(cls())["fields"] if each["name"] == name]
    assert text.partition(" ")[2] not in field["units"], "nor does the page in one file take it"


RIGHT = [
    "f_1 = g.n / (2 * pi)  # [Hz] turns in time",
    "f_1 = g.omega * 0.5 / pi  # [1/min] turns in time",
    "w = 2 * pi * g.f  # [rad/s] angular frequency",
    "turn = 2 * pi  # [rad] one\n    w = turn * g.f  # [rpm] speed",
    "w = g.phi * g.f  # [rad/s] of an angle a cycle",
    "w = g.z * g.n + g.omega  # [rpm] speeds",
    "r = 2 * g.omega  # [1/s] rate\n    q = g.f / 2  # [1/s] rate",
    "f_1 = g.n / (360 * deg)  # [Hz] turns in time",
    "f_1 = g.z * g.f  # [1/min] cycles",
    "f_1 = g.n * linspace(0, 1 / (2 * pi), 5)  # [Hz] turns in time",
    "n_2 = 300 * 2 * pi / min  # [rpm] speed\n    f_2 = 300 / min  # [1/min] frequency",
    "w = g.n + g.f * 2 * pi + g.k  # [rpm] sum\n    q = g.f > g.n / (2 * pi)  # [-] choice",
    "f_1 = sqrt(g.c / g.m) / (2 * pi)  # [Hz] natural frequency",
    "f_1 = sqrt(g.c / (4 * pi**2 * g.m))  # [Hz] natural frequency",
    "f_1 = sqrt(g.c / g.m) / 6.283  # [Hz] natural frequency",
    "f_1 = sqrt(g.F / (g.m * g.L)) / 2  # [Hz] first tone of a string",
    "f_1 = sqrt(g.F / (4 * g.m * g.L))  # [Hz] first tone of a string",
    "f_1 = sqrt(3 * g.c / (8 * pi**2 * g.m))  # [Hz] natural frequency",
    "m_1 = 4 * pi**2 * g.m  # [kg] as a step\n    f_1 = sqrt(g.c / m_1)  # [Hz] natural frequency",
    "L_1 = 2 * g.L  # [m] of a wave\n    f_1 = sqrt(g.F * g.L / (g.m * L_1 * L_1))  # [Hz] first tone of a string",
    "f_1 = sqrt(g.F / (8 * g.m * g.L))  # [1/min] of a ball that bounces",
    "f_1 = sqrt(g.z * g.c / g.m)  # [Hz] by a coefficient of a handbook",
    "f_1 = sqrt(g.c / g.m)  # [1/s] natural frequency",
    "f_1 = sqrt(g.c) / sqrt(4 * pi**2 * g.m)  # [Hz] natural frequency",
    "f_1 = 1 / (2 * pi * sqrt(g.m / g.c))  # [Hz] natural frequency",
    "f_1 = 0.5 / sqrt(g.m * g.L / g.F)  # [Hz] first tone of a string",
    "f_1 = sqrt(g.F / g.m) / sqrt(g.L)  # [1/s] rate",
    "t = 0.5  # [s] time\n    f_1 = sqrt(g.c / g.c) / t  # [Hz] cycles",
    "f_1 = sqrt(g.f**2 + (g.n / (2 * pi)) ** 2)  # [Hz] of two at once",
    "f_1 = sqrt(1 / (1 / g.f**2 + 1 / (2 * g.f) ** 2))  # [Hz] of two at once",
    "a = 9.81  # [m/s**2] gravity\n    t = 0.5  # [s] time\n    f_1 = sqrt(a / (a * t**2))  # [Hz] frequency",
    "w = sqrt(g.c / g.m)  # [rad/s] angular frequency\n    w_1 = sqrt(g.omega**2 - w**2)  # [rpm] damped",
]
WRONG = {
    "f_1 = 1 * g.n  # [Hz] turns in time": "[Hz] does not fit; the value is an angle in time, as in [rpm], until",
    "f_1 = g.n  # [1/min] turns in time": "[1/min] does not fit; the value is an angle in time, as in [rpm], until",
    "f_1 = maximum(g.z * g.omega / 2, 0.0)  # [Hz] turns": "[Hz] does not fit; the value is an angle in time, as in [r",
    "n_2 = 9.55 * g.omega  # [1/min] turns in time, shown 60 times": "in SI already, as an angle in time: write it",
    "w = g.f / g.z  # [rad/s] speed": "[rad/s] does not fit; the value is cycles in time, as in [Hz], until it is mult",
    "w = 3 * rpm * 2  # [Hz] speed": "[Hz] does not fit",
    "w = 2 * n_1 * linspace(0, 1, 3)  # [kHz] speed": "[kHz] does not fit",
    "f_1 = sqrt(g.c / g.m)  # [Hz] natural frequency": "[Hz] does not fit; the value is an angle in time",
    "f_1 = sqrt((g.c + g.c) / maximum(g.m, 1 * g.m))  # [kHz] frequency": "the value is an angle in time, as in",
    "q = g.c / g.m  # [1/s**2] square\n    f_1 = (q + q) ** 0.5  # [1/min] natural": "the value is an angle",
    "f_1 = sqrt(g.F / (g.m * g.L))  # [1/min] pendulum": "until it is divided by 2*pi",
    "f_1 = 1 / sqrt(g.m / g.c)  # [Hz] natural frequency": "[Hz] does not fit; the value is an angle in time",
    "f_1 = sqrt(g.c) / sqrt(g.m)  # [Hz] natural frequency": "[Hz] does not fit; the value is an angle in time",
    "f_1 = (g.m / g.c) ** -0.5  # [Hz] natural frequency": "[Hz] does not fit; the value is an angle in time",
    "f_1 = sqrt(g.F) * (1 / sqrt(g.m * g.L))  # [1/min] pendulum": "until it is divided by 2*pi",
    "w = g.n + g.f  # [rpm] sum": "stand together, as in [rpm] and [Hz]",
    "w = maximum(g.f, g.omega / 2)  # [1/s] greater": "stand together, as in [Hz] and [rad/s]",
    "q = 1.0 if g.n > g.f else 2.0  # [-] choice": "stand together, as in [rpm] and [Hz]",
    "n_2 = 300 / min  # [rpm] speed": "[rpm] is not shown as 1/min: write it in [1/min], or the number in rpm",
    "w = 1450 * rpm  # [1/min] speed": "[1/min] is not shown as rpm: write it in [rpm]",
}


def test_a_line_that_is_right_is_told_nothing_of(tmp_path: Path) -> None:
    for k, lines in enumerate(RIGHT):
        path = tmp_path / f"right_{k}.py"
        path.write_text(SHEET.replace("LINES", lines), encoding="utf-8")
        assert mismatches(path) == [], lines


@pytest.mark.parametrize("line", WRONG)
def test_a_missing_2_pi_is_told_at_its_line(line: str, tmp_path: Path) -> None:
    path = tmp_path / "wrong.py"
    path.write_text(SHEET.replace("LINES", line), encoding="utf-8")
    (mistake,) = mismatches(path)
    assert WRONG[line] in str(mistake) and mistake.part in line.split("\n")[-1]


@pytest.mark.parametrize(
    ("line", "told"),
    [
        ('f_1 = sqrt(g.c / g.m) / (2 * pi)  # [Hz] own\n    slow = check("speed", f_1, g.n, "rpm")', "[rpm] and [Hz]"),
        ('slow = check("speed", g.n, g.f, "Hz")', "[Hz] and [rpm]"),
        ('slow = check("speed", g.omega, 60 * Hz, "rpm")', "[rpm] and [Hz]"),
        ('w = sqrt(g.c / g.m)  # [rad/s] own\n    slow = check("speed", w, 60 * Hz, "Hz")', "[Hz] and [rad/s]"),
        ('slow = check("speed", g.n, at_least=g.omega, unit="Hz")', "[Hz] and [rpm]"),
    ],
)
def test_a_check_compares_no_turns_with_cycles(line: str, told: str, tmp_path: Path) -> None:
    """1693 rpm kept a limit of 1500: as 28 Hz, beside the 157 rad/s that the limit is."""
    path = tmp_path / "checked.py"
    text = SHEET.replace("LINES", line).replace("import ask,", "import ask, check,")
    path.write_text(text, encoding="utf-8")
    (mistake,) = mismatches(path)
    assert mistake.part == "check 'speed'" and told in mistake.why


def test_checks_of_turns_or_of_cycles_alone_are_right(tmp_path: Path) -> None:
    for k, line in enumerate(
        (
            'slow = check("speed", g.n, g.omega, "rpm")',
            'slow = check("frequency", g.f, 60 * Hz, "1/min")',
            'slow = check("speed", g.f * 2 * pi, g.n, "rpm")',
            'slow = check("rate", g.k, g.omega, "1/s")',
        )
    ):
        path = tmp_path / f"checked_{k}.py"
        path.write_text(SHEET.replace("LINES", line).replace("import ask,", "import ask, check,"), encoding="utf-8")
        assert mismatches(path) == [], line


def test_an_input_in_turns_is_not_shown_as_another_number(tmp_path: Path) -> None:
    path = tmp_path / "input.py"
    path.write_text(SHEET.replace("* rpm  # [rpm]", "* rpm  # [1/min]").replace("LINES", "pass"), encoding="utf-8")
    assert [m.why for m in mismatches(path)] == ["unit [1/min] is not shown as rpm: write it in [rpm]"]


def test_a_page_offers_no_unit_that_is_off_by_2_pi() -> None:
    assert alike("Hz") == ("Hz", "kHz") and alike("1/s") == ("1/s",)
    assert alike("rev/s") == ("rev/s", "rad/s", "deg/s", "rpm")


def test_a_unit_of_ones_own_counts_what_it_is_made_of(own_units: None) -> None:
    units.define("spin", 360, "deg/s")
    assert units.conversion("Hz", "spin") == pytest.approx(1, rel=1e-15)
