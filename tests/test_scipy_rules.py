"""Roots and tables of scipy are followed for other inputs, with their slopes; what is not is named by its function."""

from pathlib import Path

import numpy as np
import pytest
from own_worksheet import ELSEWHERE, own, recorded, value_of

from mechsheet import evaluate
from mechsheet.readers.numbers import numbers
from mechsheet.readers.searched import search
from mechsheet.readers.slopes import slopes
from mechsheet.recording.dimensions import dimensions
from mechsheet.worksheet.lines import registry

ROOT = "from scipy.optimize import brentq, bisect\n"
LINE = "from scipy.interpolate import interp1d\n"
GRID = (
    "from scipy.interpolate import RegularGridInterpolator\nP = np.array([[1.0, 2.0, 0.5], [3.0, 4.0, 1.0]])\n"
    "grid = ([0.0, 5.0], [0.0, 1.0, 2.0])\n"
)
KNOTS = (
    "from scipy.interpolate import Akima1DInterpolator, CubicSpline, PchipInterpolator, interp1d, make_interp_spline\n"
    "T = [0.0, 0.4, 1.0, 1.7, 2.1, 3.0]\nV = np.array([0.3, 1.0, 0.9, 0.2, 0.5, 0.3])\n"
)
SPLINES = [
    "CubicSpline(T, V * g.F)(g.a * np.array([-1.0, 0.5, 1.0, 4.5])) * 1.0",
    "CubicSpline(np.array(T) * g.F, V * g.a, bc_type='natural')([g.F, 2 * g.a, 1.0], 1)",
    "CubicSpline(T, V + g.a * np.array([0, 1, 0, 0, 1, 0]), bc_type='periodic')([g.F, 5 * g.a])",
    "CubicSpline(T[:3], V[:3] * g.F, bc_type='periodic' if V[0] == V[2] else 'not-a-knot')(g.a)",
    "CubicSpline(T[:3], [g.a, g.F, g.a], bc_type='periodic')([g.F, 5 * g.a])",
    "CubicSpline(T[:4], V[:4] * g.F, bc_type=((1, g.a), (2, g.F)))(g.a) * 1.0",
    "CubicSpline(T[:2], V[:2] * g.F)(g.a) + CubicSpline(T[:2], V[:2] * g.F, bc_type='clamped')(g.a)",
    "CubicSpline(T, V)(g.a, 2) + CubicSpline(T, V, extrapolate=False)(g.F / 4)",
    "CubicSpline(T, V * g.F).integrate(0.1, g.a) + CubicSpline(T, V).antiderivative(2)(g.a)",
    "CubicSpline(T, V * g.F).derivative(2)(g.a) + CubicSpline(T, V * g.F)(g.a, 3) + CubicSpline(T, V * g.F)(g.a, 4)",
    "PchipInterpolator(T, V * g.F)(g.a * np.linspace(0.1, 2, 9)) * 1.0",
    "PchipInterpolator(np.array(T) * g.a, V**2 * g.F).derivative()(g.a * np.linspace(0.1, 2, 9))",
    "PchipInterpolator(T[:2], V[:2] * g.F)(g.a) + PchipInterpolator(T[:3], [g.F, 1.0, 1.0])(g.a)",
    "Akima1DInterpolator(T, V * g.F)(g.a * np.linspace(0.1, 2, 9)) * 1.0",
    "Akima1DInterpolator(T, [0.0, g.F, 2.0, 2.0, 2.0, g.a])(g.a, extrapolate=True) * 1.0",
    "make_interp_spline(T, V * g.F)(g.a) + make_interp_spline(T, V)(g.a)",
    "make_interp_spline(T, V, k=2)(g.a * np.linspace(0.1, 2, 9))",
    "interp1d(T, V * g.F, kind='cubic', fill_value='extrapolate')(g.a) + interp1d(T, V, kind='cubic')(g.a / 2)",
]
SEVERAL = [  # roots of which scipy finds one, one at an end, a jump, a stretch of zeros
    ROOT + "y = brentq(lambda v: (v - g.F) * (v - 5 * g.a) * (v - 9 * g.a), 0.05, 20.0, xtol=1e-14) * 1.0",
    ROOT + "y = bisect(lambda v: (v - g.F) * (v - 5 * g.a) * (v - 9 * g.a), 0.05, 20.0, xtol=1e-14) * 1.0",
    ROOT + "y = brentq(lambda v: v * (v - g.F), 0.0, 10.0) + bisect(lambda v: (v - g.F) * (v - 9), 3 - g.a, 9.0)",
    ROOT + "y = brentq(lambda v: g.F - 4 * (v > g.a) - v * 0.1, 0.0, 10.0, xtol=1e-14) * 1.0",
    ROOT + "y = bisect(lambda v: g.F - 4 * (v > g.a) - v * 0.1, 0.0, 10.0, xtol=1e-14) * 1.0",
    ROOT + "y = brentq(lambda v: g.F - (v >= 1.5) - 3 * (v >= 3 * g.a), 0.0, 10.0, xtol=1e-14) * 1.0",
]
FOLLOWED = [
    *SEVERAL,
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
    *(f"{KNOTS}y = {line}" for line in SPLINES),
]
NAMED = {
    ROOT + "y, told = brentq(lambda v: v**2 - g.F, 0.0, 9.0, full_output=True)": "scipy's brentq",
    LINE
    + "y = interp1d([0.0, 1.0, 4.0, 9.0], [0.0, 3.0, 5.0, 7.0], kind='quadratic')(g.F)": "interp1d but for a linear",
    GRID
    + "y = RegularGridInterpolator(grid, P, method='nearest')((g.F, g.a))": "RegularGridInterpolator but for a linear",
}


REFUSED = ("np.array(T) * g", "V + g.a *")  # knots that do not rise, and other ends of a periodic curve


@pytest.mark.parametrize("lines", FOLLOWED)
def test_it_is_followed(lines: str, tmp_path: Path) -> None:
    sheet = own(tmp_path, f"{lines}\nresult = np.atleast_1d(y) * 1  # [-] line")
    _, recording = recorded(sheet)
    seen = [guard for guard in recording.guards.values() if not guard.rows]
    assert not recording.gaps and bool(seen) is any(each in lines for each in REFUSED), "what scipy has an error for"
    assert bool(recording.found) is lines.startswith(ROOT), "a workbook searches what is found"
    for given in ELSEWHERE[2:6]:  # the number of positions is nothing to it
        own_value = evaluate(sheet.path, ["result"], **given)["result"]
        np.testing.assert_allclose(value_of(recording, "result", given), own_value, rtol=1e-11, err_msg=str(given))


PLACES, SOME = "[0.0, 1.0, g.F, 3.25, 5.0, 6.0]", "[1.0, 3.0, 2.0, 2.0, 4.0, 3.0]"
REFUSES = [
    f"{KNOTS}y = CubicSpline([0.0, 1.0, 2.0], [2.5, 0.0, g.F], bc_type='periodic')(0.3)",
    f"{KNOTS}y = PchipInterpolator({PLACES}, {SOME})(5.8)",
    f"{GRID}y = RegularGridInterpolator(({PLACES},), {SOME})([5.8])",
    f"{LINE}y = interp1d([0.0, 3.0], [1.0, g.F])([g.F, 0.5])[1]",
    f"{LINE}y = 1.0 if interp1d([0.0, 3.0], [1.0, 2.0])(g.F) > 1.5 else 5.0",
    f"{GRID}y = np.where(RegularGridInterpolator(([0.0, 3.0],), [1.0, g.F])([g.F, 0.5]) > 2, 1.0, 2.0)",
]


@pytest.mark.parametrize("lines", REFUSES)
def test_what_scipy_has_an_error_for_has_no_number(lines: str, tmp_path: Path) -> None:
    """Of a table that ends before, or a curve that no knots give, a page had numbers where the worksheet has none."""
    sheet = own(tmp_path, f"{lines}\nresult = np.atleast_1d(y) * 1  # [-] line")
    for F in (2.5, 2.5):
        evaluate(sheet.path, ["result"], F=F)
    with pytest.raises(ValueError):
        evaluate(sheet.path, ["result"], F=3.25)


@pytest.mark.parametrize("lines", SEVERAL)
def test_of_several_roots_cells_have_the_one_that_scipy_finds_or_none(lines: str, tmp_path: Path) -> None:
    sheet = own(tmp_path, f"{lines}\nresult = np.atleast_1d(y) * 1  # [-] line")
    _, recording = recorded(sheet)
    search(recording)
    for given in [{}, *ELSEWHERE[2:6]]:
        inputs = {recording.inputs[name]: float(x) for name, x in given.items()}
        for solved in (solved for solved in recording.found.values() if solved.inverse is not None):
            known = numbers([solved.inverse, solved.node], inputs)
            found, own_value = known[solved.inverse], known[solved.node]
            assert np.isnan(found) or found == pytest.approx(own_value, rel=1e-11), given


@pytest.mark.parametrize("lines", NAMED)
def test_what_is_not_followed_is_named(lines: str, tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    _, recording = recorded(own(tmp_path, f"{lines}\nresult = np.atleast_1d(y) * 1  # [-] line"))
    assert any(NAMED[lines] in str(gap) for gap in recording.gaps)
    assert capfd.readouterr().err == ""


def test_a_root_has_the_slopes_of_its_equation(tmp_path: Path) -> None:
    """dv/dF of v³ + a v = F is 1 / (3 v² + a), which differences of the solver's numbers tell less well."""
    _, recording = recorded(own(tmp_path, f"{FOLLOWED[len(SEVERAL)]}\nresult = np.atleast_1d(y) * 1  # [-] line"))
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
