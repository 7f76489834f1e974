"""Roots that scipy finds from a guess are followed for other inputs, where no other one can be meant."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from own_worksheet import ELSEWHERE, own, recorded, value_of
from test_recalculation import edit

from mechsheet import evaluate
from mechsheet.readers.slopes import slopes
from mechsheet.recording.dimensions import dimensions
from mechsheet.run import report
from mechsheet.worksheet.lines import registry

IMPORT = "from scipy.optimize import fsolve, newton, root, root_scalar\n"
THREE = "[v[0] + v[1]**2 / 9 - g.F, v[1] - g.a * v[2], v[2]**3 / 50 + v[2] - v[0]]"
TWO = "[v[0] + v[1]**2 / 9 - c, v[1] - g.a * v[0]]"
FOLLOWED = [
    "y = fsolve(lambda v: v**2 - g.F, 1.0)[0]",
    "(y,) = fsolve(lambda v, c: math.cos(v[0]) - c * v[0], [1.0], args=(g.a,))",
    f"y = fsolve(lambda v: np.array({THREE}), np.array([1.0, 1.0, 1.0]), xtol=1e-13)[1]",
    "y = sum(fsolve(lambda v: v + np.sin(v) * g.a / 2 - c, c)[0] for c in (1.0, g.F))",
    "y = fsolve(lambda v: 2.0 * v - 5.0, 1.0)[0] * g.F + fsolve(lambda v: v - g.F, g.F, fprime=lambda v: [[1.0]])[0]",
    f"y = root(lambda v, c: {TWO}, [2.0, 1.5], (g.F,)).x[0]",
    f"s = root(lambda v, c: {TWO}, [2.0, 1.5], g.F, 'lm', tol=1e-13)\ny = s.x[1] if s.success else 0.0",
    "u, told, ok, said = fsolve(lambda v: v**2 - g.F, 1.5, full_output=True)\ny = u[0] if ok == 1 else 0.0",
    "y = newton(lambda v: v**3 - g.F * v - g.a, 2.0)",
    "y = newton(lambda v: v**3 - g.F, 1.5, fprime=lambda v: 3 * v**2)",
    "y = root_scalar(lambda v, c: v**3 - c, (g.F,), bracket=[0, 5]).root",
    "s = root_scalar(lambda v: v**3 - g.F, x0=1.5, fprime=lambda v: 3 * v**2)\ny = s.root * s.converged",
]
NAMED = {
    "y = fsolve(lambda v: v**2 + g.F, 1.0)": "scipy's fsolve of what has no root there",
    "y = fsolve(lambda v: v**3 - 3 * v + g.a, 0.9)": "not sure to which root",
    "y, told = newton(lambda v: v**2 - g.F, 1.5, full_output=True)": "scipy's newton with full_output",
    "y, told, *_ = fsolve(lambda v: v**2 - g.F, 1.5, full_output=True)\ny = y * told['nfev']": "nfev",
    "y = newton(lambda v: v**2 - x, x)": "scipy's newton from such a guess",
    "y = root(lambda v: ([v[0] - g.F], [[1.0]]), [1.0], jac=True).x": "scipy's root with jac",
    "y = root(lambda v: v - g.F, 1.0).nfev": "nfev",
}


@pytest.mark.parametrize("lines", FOLLOWED)
def test_it_is_followed(lines: str, tmp_path: Path) -> None:
    """scipy itself meets the root to ten digits at least."""
    sheet = own(tmp_path, f"{IMPORT}{lines}\nresult = np.atleast_1d(y) * 1  # [-] line")
    _, recording = recorded(sheet)
    assert not recording.gaps
    asked = any(word in lines for word in (".success", ".converged", "ok == 1"))
    assert bool([guard for guard in recording.guards.values() if not guard.rows]) is asked
    assert recording.found, "a workbook searches what is found"
    for given in ELSEWHERE[2:6]:  # the number of positions is nothing to it
        own_value = evaluate(sheet.path, ["result"], **given)["result"]
        np.testing.assert_allclose(value_of(recording, "result", given), own_value, rtol=1e-10, err_msg=str(given))


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("lines", NAMED)
def test_what_is_not_followed_is_named(lines: str, tmp_path: Path) -> None:
    _, recording = recorded(own(tmp_path, f"{IMPORT}{lines}\nresult = np.atleast_1d(y) * 1  # [-] line"))
    assert any(NAMED[lines] in str(gap) for gap in recording.gaps)


def test_where_there_are_several_roots_it_is_scipys_own_or_none(tmp_path: Path) -> None:
    """Of the three of v³ - 3 v + c = 0 it is the one to which scipy goes, over guesses and slopes of either sign."""
    sheet = own(tmp_path, f"{IMPORT}y = fsolve(lambda v: v**3 - 3 * v + g.a, g.F)[0] * 1  # [-] line")
    _, recording = recorded(sheet)
    known = 0
    for guess in np.linspace(-2.4, 2.6, 21):
        given = {"F": float(guess), "a": 0.3}
        value = value_of(recording, "y", given)
        if np.isfinite(value):
            assert value == pytest.approx(evaluate(sheet.path, ["y"], **given)["y"], rel=1e-9), guess
            known += 1
    assert known > 5


def test_it_has_the_slopes_of_its_equations_and_the_unit_of_its_guess(tmp_path: Path) -> None:
    """With u v = F and u = a v, v = sqrt(F / a)."""
    lines = "s = root(lambda v: [v[0] * v[1] - g.F, v[0] - g.a * v[1]], [1.0, 1.5])\ny = s.x[1] * 1  # [-] line"
    _, recording = recorded(own(tmp_path, IMPORT + lines))
    (node,) = (node for node, name in recording.names.items() if name == "y")
    v = np.sqrt(2.5 / 0.75)
    for side in slopes([node], [recording.inputs["F"], recording.inputs["a"]])[node]:
        np.testing.assert_allclose(side.ravel(), [v / 5, -v / 1.5], rtol=1e-13)
    lines = "a = 2.0  # [m] arm\ny = fsolve(lambda v: v**2 - a**2 * g.F, a)[0] * 1  # [UNIT] line"
    for unit, passed in (("m", True), ("N", False)):
        sheet = own(tmp_path, (IMPORT + lines).replace("UNIT", unit))
        names, recording = recorded(sheet)
        assert dimensions(recording, sheet, names, registry({**names, "__file__": sheet.path})).check().passed is passed


@pytest.mark.office
@pytest.mark.filterwarnings("ignore")  # scipy warns where there is no root
def test_cells_solve_as_scipy_does(recalculated_all: Any, tmp_path: Path) -> None:
    """Where the worksheet has no root, its numbers are none, and the cells have none."""
    lines = [f"{line}\nr_{k} = y * 1.0  # [-] line" for k, line in enumerate(FOLLOWED)]
    lines += ["y = fsolve(lambda v: [v[0] + v[1] - g.F, v[0] * v[1] - g.a], (g.F, 0.3))[0]\nlast = y * 1  # [-] last"]
    lines += [f"every = np.array([{', '.join(f'r_{k}' for k in range(len(FOLLOWED)))}])  # [-] all"]
    sheet = own(tmp_path, IMPORT + "\n".join([*lines, 'table_2 = table("2", "All", every, last)']))
    names = sheet.run(sheet.results, {"g": sheet.inputs()})
    book = tmp_path / "own.xlsx"
    book.write_bytes(report.workbook("Own", {**names, "__file__": sheet.path}, {}))
    changes: list[dict[str, Any]] = [{"F": 4.0, "a": 0.9}, {"a": 1.5, "F": 1.75}]
    edited = [edit(book, given, tmp_path / f"changed{n}.xlsx") for n, given in enumerate(changes)]
    for given, changed in zip(changes, recalculated_all(edited), strict=True):
        rows = [*changed["2 All"].iter_rows(min_row=5, values_only=True)]
        np.testing.assert_allclose([row[0] for row in rows], evaluate(sheet.path, ["every"], **given)["every"], 1e-10)
        if given == changes[-1]:
            assert rows[0][1] == "#N/A", "numbers with the sum 1.75 have no product of 1.5"
        else:
            assert rows[0][1] == pytest.approx(evaluate(sheet.path, ["last"], **given)["last"], rel=1e-10)
