"""Roots and tables of scipy are followed for other inputs, with their slopes; what is not is named by its function."""

from pathlib import Path

import numpy as np
import pytest
from own_worksheet import ELSEWHERE, own, recorded, value_of

from mechsheet import evaluate
from mechsheet.recording.dimensions import dimensions
from mechsheet.recording.slopes import slopes
from mechsheet.worksheet.lines import registry

ROOT = "from scipy.optimize import brentq, bisect\n"
LINE = "from scipy.interpolate import interp1d\n"
GRID = (
    "from scipy.interpolate import RegularGridInterpolator\nP = np.array([[1.0, 2.0, 0.5], [3.0, 4.0, 1.0]])\n"
    "grid = ([0.0, 5.0], [0.0, 1.0, 2.0])\n"
)
FOLLOWED = [
    ROOT + "y = brentq(lambda v: v**3 + g.a * v - g.F, 0.0, 9.0) * 1.0",
    ROOT + "y = brentq(lambda v, c: v**3 + c * v - g.F, 0.0, 2 * g.F, args=(g.a,)) * 1.0",
    ROOT + "y = np.array([bisect(lambda v: v**2 - c * g.F, 0.0, 9.0) for c in (1.0, 2.0)])",
    ROOT + "def f(v):\n    if v > 1:\n        return v**2 - g.F\n    return v - g.F\ny = brentq(f, 0.0, 9.0) * g.a",
    LINE + "f = interp1d([0.0, 1.0, 4.0, 9.0], [g.F, 3.0, 5.0, 1.0])\ny = f(g.F) * 1.0",
    LINE + "f = interp1d([0.0, 1.0, 2.0], [0.0, 3.0, 5.0], fill_value='extrapolate')\ny = f([g.F, g.a]) * 1.0",
    LINE
    + "f = interp1d([0.5, 1.0, 2.0], [g.a, 3.0, 5.0], bounds_error=False, fill_value=(0.0, 9.0))\ny = f(g.F) + f(g.a)",
    GRID + "f = RegularGridInterpolator(grid, P)\ny = f((g.F, g.a)) * 1.0",
    GRID + "f = RegularGridInterpolator(grid, P * g.a, bounds_error=False, fill_value=None)\ny = f([[g.F, 3 * g.a]])",
    GRID + "f = RegularGridInterpolator(grid, P, bounds_error=False, fill_value=7.0)\ny = f((2 * g.F, g.a)) * g.F",
    "A = np.block([[np.eye(2) * g.F, np.ones((2, 1))], [np.zeros(3)]])\ny = A[0] + A[:, 2]",
    "i, j = np.unravel_index(np.argmax([[g.F, 3.0], [g.a, 3.1]]), (2, 2))\ny = 10 * i + j + g.F",
]
NAMED = {
    ROOT + "y, told = brentq(lambda v: v**2 - g.F, 0.0, 9.0, full_output=True)": "scipy's brentq",
    LINE
    + "y = interp1d([0.0, 1.0, 4.0, 9.0], [0.0, 3.0, 5.0, 7.0], kind='cubic')(g.F)": "interp1d but for a linear one",
    GRID
    + "y = RegularGridInterpolator(grid, P, method='nearest')((g.F, g.a))": "RegularGridInterpolator but for a linear",
}


@pytest.mark.parametrize("lines", FOLLOWED)
def test_it_is_followed(lines: str, tmp_path: Path) -> None:
    sheet = own(tmp_path, f"{lines}\nresult = np.atleast_1d(y) * 1  # [-] line")
    _, recording = recorded(sheet)
    assert not recording.gaps and not [guard for guard in recording.guards.values() if not guard.rows]
    assert bool(recording.found) is lines.startswith(ROOT), "a workbook searches what is found"
    for given in ELSEWHERE:
        own_value = evaluate(sheet.path, ["result"], **given)["result"]
        np.testing.assert_allclose(value_of(recording, "result", given), own_value, rtol=1e-11, err_msg=str(given))


@pytest.mark.parametrize("lines", NAMED)
def test_what_is_not_followed_is_named(lines: str, tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    _, recording = recorded(own(tmp_path, f"{lines}\nresult = np.atleast_1d(y) * 1  # [-] line"))
    assert any(NAMED[lines] in str(gap) for gap in recording.gaps)
    assert capfd.readouterr().err == ""


def test_a_root_has_the_slopes_of_its_equation(tmp_path: Path) -> None:
    """dv/dF of v³ + a v = F is 1 / (3 v² + a), which differences of the solver's numbers tell less well."""
    _, recording = recorded(own(tmp_path, f"{FOLLOWED[0]}\nresult = np.atleast_1d(y) * 1  # [-] line"))
    (node,) = (node for node, name in recording.names.items() if name == "result")
    v = node.value[0]
    for side in slopes([node], [recording.inputs["F"]])[node]:
        np.testing.assert_allclose(side.ravel(), 1 / (3 * v**2 + 0.75), rtol=1e-13)


def test_a_root_has_the_unit_of_its_interval(tmp_path: Path) -> None:
    """What the solver itself put into the function has any unit."""
    lines = (
        "from scipy.optimize import brentq\na = 2.0  # [m] arm\nb = 9.0  # [m] end\n"
        "part = brentq(lambda v: np.arcsin(v / b) - a / b, a - a, b) / b  # [UNIT] part"
    )
    for unit, passed in (("-", True), ("N", False)):
        sheet = own(tmp_path, lines.replace("UNIT", unit))
        names, recording = recorded(sheet)
        assert dimensions(recording, sheet, names, registry({**names, "__file__": sheet.path})).check().passed is passed
