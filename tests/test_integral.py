"""scipy's quad is followed for other inputs: its ends, its function and where that has corners rest on them."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from own_worksheet import ELSEWHERE, own, recorded, value_of
from test_recalculation import edit

from mechsheet import evaluate, sweep
from mechsheet.readers.proof import prove
from mechsheet.readers.searched import search
from mechsheet.readers.slopes import slopes
from mechsheet.recording import integral
from mechsheet.recording.dimensions import dimensions
from mechsheet.run import report
from mechsheet.worksheet.lines import registry

IMPORT = "from scipy.integrate import quad\n"
FOLLOWED = [
    "y = quad(lambda v: math.sin(v) * g.F, 0, g.a)[0]",
    "y, error = quad(lambda v: 1 / (1 + (g.F * v)**2), g.a, -1, epsabs=1e-12)",
    "y = quad(lambda v, c: 1 / sqrt(1 - c * math.sin(v)**2), 0, math.pi / 2, args=(g.a / 4,))[0]",
    "y = quad(lambda v: quad(lambda w: v * w + g.F, 0, v)[0], 0, g.a)[0]",
    "y = sum(quad(lambda v: math.exp(-g.a * v), 0, end)[0] for end in (1.0, g.F))",
    "y = quad(lambda v: g.F, 0, g.a)[0] + quad(lambda v: v, g.a, g.a)[0] + g.a * quad(lambda v: v**2, 0, 1)[0]",
    "y = quad(lambda v: sqrt(v) * sqrt(g.F - v), 0, g.F)[0]",
    "y = quad(lambda v: (v > g.a) * g.F, 3, 0, points=[g.a])[0]",
    "def f(v):\n    if v < g.a:\n        return g.F\n    return g.F * (v**2 + 1 - g.a**2)\ny = quad(f, 0, g.F)[0]",
    "y = quad(lambda v: max(v - g.a, 0) * g.F + max(v - g.F / 2, 0), 0, 3)[0]",
    "y = quad(lambda v: np.interp(v, [0.0, 1.0, 3.0], [g.F, 3.0, g.a]) * v**2, 0, 3)[0]",
    "from scipy import integrate\ny = integrate.quad(lambda v: np.sum([v, g.F, v**2]), a=0, b=g.a)[0]",
]
NAMED = {
    "y = quad(lambda v: exp(-v * g.F), 0, np.inf)[0]": "scipy's quad to infinity",
    "y = quad(lambda v: v * g.F, 0, 1, weight='cos', wvar=2.0)[0]": "scipy's quad with weight, wvar",
    "y = quad(lambda v: math.floor(v) * g.F, 0, 3)[0]": "scipy's quad of what rules at 672 places differ about",
    "y = quad(lambda v: abs(math.sin(4 * v)) * g.F, 0, 3)[0]": "scipy's quad of what rules at 672 places differ about",
    "y = quad(lambda v: g.F * len(str(v)), 0, 1)[0]": "Python looks at its variable",
}


@pytest.mark.parametrize("lines", FOLLOWED)
def test_it_is_followed(lines: str, tmp_path: Path) -> None:
    """scipy itself meets corners to ten digits alone."""
    sheet = own(tmp_path, f"{IMPORT}{lines}\nresult = np.atleast_1d(y) * 1  # [-] line")
    _, recording = recorded(sheet)
    assert not recording.gaps and not [guard for guard in recording.guards.values() if not guard.rows]
    for given in ELSEWHERE[2:6]:  # the number of positions is nothing to it
        own_value = evaluate(sheet.path, ["result"], **given)["result"]
        np.testing.assert_allclose(value_of(recording, "result", given), own_value, rtol=3e-10, err_msg=str(given))


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("lines", NAMED)
def test_what_is_not_followed_is_named(lines: str, tmp_path: Path) -> None:
    _, recording = recorded(own(tmp_path, f"{IMPORT}{lines}\nresult = np.atleast_1d(y) * 1  # [-] line"))
    assert any(NAMED[lines] in str(gap) for gap in recording.gaps)


def test_a_field_of_points_is_integrated_between_them(tmp_path: Path) -> None:
    """The parts end at its points, of which there are as many as there were."""
    lines = "y = quad(lambda v: interp(v, x, x**2), x[0], x[-1])[0] * 1  # [-] line"
    sheet = own(tmp_path, IMPORT + lines)
    _, recording = recorded(sheet)
    assert not recording.gaps
    for F in (2.5, 3.5):
        assert value_of(recording, "y", {"F": F}) == pytest.approx(evaluate(sheet.path, ["y"], F=F)["y"], rel=1e-9)
    assert np.isnan(value_of(recording, "y", {"n": 3}))


def test_the_rule_is_exact_for_polynomials_up_to_its_degree() -> None:
    for power in range(32):
        assert integral._PART @ integral._AT**power == pytest.approx(1 / (power + 1), rel=1e-15)
    for power in range(20):
        assert abs(integral._OFF @ integral._AT**power) < 1e-15


def test_a_function_that_becomes_too_sharp_for_the_places_has_no_number(tmp_path: Path) -> None:
    lines = "y = quad(lambda v: exp(-((v - 0.3) * g.F) ** 2), 0, 1)[0]"
    sheet = own(tmp_path, f"{IMPORT}{lines}\nresult = np.atleast_1d(y) * 1  # [-] line")
    _, recording = recorded(sheet)
    sharper = [value_of(recording, "result", {"F": F})[0] for F in (1.0, 5.0, 25.0, 125.0, 625.0, 3125.0)]
    expected = [evaluate(sheet.path, ["result"], F=F)["result"][0] for F in (1.0, 5.0)]
    np.testing.assert_allclose(sharper[:2], expected, rtol=1e-12)
    assert np.isnan(sharper[-4:-1]).all() and sharper[-1] == 0, "no place of scipy's own meets the last one either"


def test_what_rests_on_the_estimate_of_the_error_has_no_number_for_others(tmp_path: Path) -> None:
    """Only scipy's own places give it."""
    lines = "w = quad(lambda v: v * g.F, 0, 1)\ny = w[0] if w[1] < 1e-8 else 0.0"
    table = 'table_2 = table("2", "Two", result)'
    _, recording = recorded(own(tmp_path, f"{IMPORT}{lines}\nresult = y * 1  # [-] line\n{table}"))
    assert value_of(recording, "result", {}) == 1.25 and np.isnan(value_of(recording, "result", {"F": 3.0}))
    search(recording)
    assert ["estimate of the error" in str(gap) for gap in recording.unsolved] == [True]


def test_evaluate_and_sweep_have_the_numbers_of_the_worksheet(tmp_path: Path) -> None:
    """At a jump scipy may be off by 6e-5; whoever asks again is given the same."""
    lines = "f = lambda v: g.F if v < g.a else g.F * v\ny = quad(f, 0, g.F)[0]"
    sheet = own(tmp_path, f"{IMPORT}{lines}\nresult = y * 1.0  # [-] line")
    at = 2.5 + np.linspace(0, 1, 300)[140:160]
    alone = [sheet.run(["result"], {"g": sheet.inputs(F=float(F))})["result"] for F in at]
    exact = at * (0.75 + (at**2 - 0.75**2) / 2)
    assert np.max(np.abs(alone - exact)) > 1e-5 * exact[0]
    assert [evaluate(sheet.path, ["result"], F=float(F))["result"] for F in at] == alone
    np.testing.assert_array_equal(sweep(sheet.path, ["result"], {"F": at})["result"], alone)


def test_it_has_a_slope_and_a_unit_but_no_proved_digits(tmp_path: Path) -> None:
    lines = "a = 2.0  # [m] arm\nwork = quad(lambda v: v**2 * g.F, a - a, a * g.a)[0]  # [UNIT] work"
    for unit, passed in (("m^3", True), ("m^2", False)):
        sheet = own(tmp_path, (IMPORT + lines).replace("UNIT", unit))
        names, recording = recorded(sheet)
        known = registry({**names, "__file__": sheet.path})
        assert dimensions(recording, sheet, names, known).check().passed is passed
    (node,) = (node for node, name in recording.names.items() if name == "work")
    found = slopes([node], [recording.inputs["F"], recording.inputs["a"]])[node]
    for side in found:
        np.testing.assert_allclose(side.ravel(), [1.5**3 / 3, 1.5**2 * 2.5 * 2], rtol=1e-13)
    (proved,) = prove(recording, names, [], known, {"work": 1}, ["work"]).columns
    assert proved.least == 0 and "sum of a rule" in proved.why


@pytest.mark.office
def test_cells_integrate_as_scipy_does(recalculated_all: Any, tmp_path: Path) -> None:
    """The estimate of the error, which scipy's own places give, is of the exported inputs, and told."""
    lines = [f"{line}\nr_{k} = y * 1.0  # [-] line" for k, line in enumerate(FOLLOWED)]
    lines += [f"every = np.array([{', '.join(f'r_{k}' for k in range(len(FOLLOWED)))}])  # [-] all"]
    lines += ['table_2 = table("2", "All", every)\nfrom mechsheet import check\nsharp = check("sharp", error, 1e-9)']
    sheet = own(tmp_path, IMPORT + "\n".join(lines))
    names = sheet.run(sheet.results, {"g": sheet.inputs()})
    book = tmp_path / "own.xlsx"
    book.write_bytes(report.workbook("Own", {**names, "__file__": sheet.path}, {}))
    changes: list[dict[str, Any]] = [{}, {"a": 1.25, "F": 3.5}]
    edited = [edit(book, given, tmp_path / f"changed{n}.xlsx") for n, given in enumerate(changes)]
    for given, changed in zip(changes, recalculated_all(edited), strict=True):
        rows = [*changed["2 All"].iter_rows(min_row=5, values_only=True)]
        expected = evaluate(sheet.path, ["every"], **given)["every"]
        np.testing.assert_allclose([row[0] for row in rows], expected, rtol=3e-10)
        verdicts = {row[0]: row[4] for row in changed["Checks"].iter_rows(min_row=3, values_only=True)}
        assert verdicts["sharp"] == ("not evaluated" if given else "PASS")
        told = [cell for row in changed["Front"].iter_rows(values_only=True) for cell in row if cell]
        assert any("scipy's estimate of the error of an integral" in str(cell) for cell in told)
