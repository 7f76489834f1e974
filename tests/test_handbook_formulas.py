"""Formulas of handbooks for a speed in turns a minute: whatever it is typed in, a worksheet has it in rad/s."""

from __future__ import annotations

from pathlib import Path

import pytest

from mechsheet.recording.dimensions import mismatches
from tests.own_worksheet import written

SHEET = written(
    """
from numpy import maximum, pi

from mechsheet import ask, check, inputs, read
from mechsheet.units import Hz, rpm
""",
    """
n: float = 1450 * rpm  # [rpm] speed; > 0
omega: float = 40.0  # [rad/s] angular velocity; > 0
f: float = 20 * Hz  # [Hz] frequency
D: float = 0.3  # [m] diameter
M: float = 50.0  # [N*m] torque
P: float = 7500.0  # [W] power
F: float = 100.0  # [N] force
q: float = 1e4  # [Pa] friction
""",
    """
LINES
""",
)
WRONG = {
    "v = pi * g.D * g.n / 60  # [m/s] of the rim": "n is in SI already, as an angle in time: write 0.5 for pi/60",
    "v = pi * g.D * g.n / 60000  # [m/s] of the rim": "write 0.5 for pi/60000",
    "v = 2 * pi * (g.D / 2) * g.n / 60  # [m/s] of the rim": "write 1 for 2*pi/60",
    "v = pi * g.D * g.n  # [m/s] of the rim": "write 0.5 for pi",
    "r = g.D / 2  # [m] radius\nv = 2 * pi * r * g.n  # [m/s] of the rim": "write 1 for 2*pi",
    "a = (pi * g.n / 30) ** 2 * g.D / 2  # [m/s**2] of the rim": "write 1 for pi/30",
    "x = g.M * g.n / 9550  # [kW] power": "write it without 9550",
    "x = g.M * g.n / 9.5493  # [W] power": "write it without 9.55",
    "x = g.P + pi * g.n * g.M / 30  # [W] power": "write 1 for pi/30",
    "x = 9550 * g.P / g.n  # [N*m] torque": "write it without 9550",
    "x = maximum(30 / pi * g.P / g.omega, 0)  # [N*m] torque": "omega is in SI already, as an angle in time",
    "x = 60 * g.P / (2 * pi * g.n)  # [N*m] torque": "write 1 for 60/(2*pi)",
    "t = 60 / g.n  # [s] of a turn": "write 2*pi for 60",
    'c = check("rim", pi * g.D * g.n / 60, 30.0, "m/s")': "write 0.5 for pi/60",
}
RIGHT = [
    "v = g.n * g.D / 2  # [m/s] of the rim",
    "v = pi * g.D * g.f  # [m/s] of the rim",
    "v = pi * g.D * g.n / (2 * pi)  # [m/s] of the rim",
    "n_1 = g.n / (2 * pi)  # [1/min] turns\nv = pi * g.D * n_1  # [m/s] of the rim",
    "x = g.M * g.n  # [kW] power",
    "x = pi * g.q * g.D**2 * g.D / 2 * g.omega  # [W] lost in a bearing",
    "x = pi / 3 * g.q * g.D**3 * g.omega  # [W] of a cone",
    "x = pi * g.n / g.omega / 60  # [-] of two speeds",
    "t = 2 * pi / g.n  # [s] of a turn",
    "t = 60 * g.D / (g.omega * g.D)  # [s] of a way",
    "v = pi * g.D * g.n / 60  # [m/s] as printed (erratum)",
    "x = g.M * g.f * 60 / 9550  # [kW] of cycles",
    'c = check("rim", g.D * g.n / 2, 30.0, "m/s")',
]


@pytest.mark.parametrize("lines", WRONG)
def test_what_converts_a_speed_once_more_is_told(lines: str, tmp_path: Path) -> None:
    """pi*D*n/60 was 19 times too small, pi*D*n six times too great, without a word: both have the right dimensions."""
    path = tmp_path / "wrong.py"
    path.write_text(SHEET.replace("LINES", lines.replace("\n", "\n    ")), encoding="utf-8")
    (mistake,) = mismatches(path)
    assert WRONG[lines] in mistake.why and (mistake.part in lines.splitlines()[-1] or "rim" in mistake.part)


def test_what_is_right_is_told_nothing_of(tmp_path: Path) -> None:
    for k, lines in enumerate(RIGHT):
        path = tmp_path / f"right_{k}.py"
        path.write_text(SHEET.replace("LINES", lines.replace("\n", "\n    ")), encoding="utf-8")
        assert mismatches(path) == [], lines
