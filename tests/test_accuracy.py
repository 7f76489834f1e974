"""The accuracy worksheet: every method that it must compare, its truths against other derivations, its verdicts."""

from pathlib import Path

import mpmath as mp
import numpy as np
import pytest
import test_joint
import test_kinetostatics_sheet
import test_landing_gear
import test_slotted_link

from mechsheet.worksheet.cells import load

WORKSHEET = Path(__file__).parents[1] / "worksheets" / "accuracy.py"
SHEET = load(WORKSHEET)


def run(*want: str):
    return SHEET.run(want, {"g": SHEET.inputs(), "seconds": 1e-6, "sizes": (3,)})


def settings(methods, family: str) -> list[float]:
    return [float(m.setting) for m in methods if m.family == family]


# Every method


@pytest.fixture(scope="module")
def first():
    return run("chain_h", "S", "L4", "L7", "hitch")


@pytest.fixture(scope="module")
def positions(first):
    made = SHEET.common["position_methods"]
    return made(first["chain_h"], first["S"], lambda: None, lambda: None)


def decades(first: int, last: int) -> list[float]:
    return [10.0**-k for k in range(first, last + 1)]


def test_positions_are_compared_by_every_method_and_tolerance(positions):
    assert settings(positions, "Newton") == pytest.approx(decades(3, 14))
    for method in ("RK45", "DOP853", "Radau"):
        assert settings(positions, f"solve_ivp {method}") == pytest.approx(decades(3, 12))
    rest = {m.family for m in positions} - {"Newton"} - {f"solve_ivp {m}" for m in ("RK45", "DOP853", "Radau")}
    assert rest == {"library: rrr", "printed: law of cosines", "fsolve, each position"}


def test_derivatives_finds_and_reactions_are_compared_by_every_method(first):
    common = SHEET.common
    derivatives = common["derivative_methods"](first["chain_h"], first["S"], 0.25, 1)
    assert settings(derivatives, "central differences") == pytest.approx(decades(1, 10))
    assert settings(derivatives, "spline of the table") == [10 * 2**k for k in range(8)]
    finds = {m.family for m in common["find_methods"](first["hitch"], [1.0])}
    assert finds == {
        *("find", "inverse mechanism", "brentq on the reach", "Newton", "secant", "hybr", "hybr, printed formulas"),
    }
    ways = common["reaction_methods"](first["hitch"], first["S"], first["L4"], first["L7"], 2 + 0 * first["S"])
    assert [m.family for m in ways] == [
        *("library: rrr_reactions", "printed: elimination", "dense system", "least squares"),
    ]


@pytest.mark.parametrize("family", ["Newton", "fsolve, each position", "solve_ivp RK45", "solve_ivp Radau"])
def test_an_iteration_reaches_its_tolerance_and_no_more_without_need(positions, first, family):
    """A method that returned the library's own numbers would be exact at any tolerance."""
    pins = SHEET.common["inner_pins"](SHEET.common["by_library"](first["chain_h"], first["S"]))
    loose = next(m for m in positions if m.family == family)
    tight = next(m for m in positions if m.family == family and float(m.setting) < 1e-8)
    errors = [np.max(abs(m.run() - pins)) for m in (loose, tight)]
    assert 0 < errors[0] < 1e-2
    assert errors[1] < 1e-7


# Truths


def agree(found, exactly):
    with mp.workdps(50):
        assert all(abs(a - b) <= 1e-25 * max(1, abs(b)) for a, b in zip(found, exactly, strict=True)), (found, exactly)


def test_landing_gear_at_50_digits_is_that_of_the_construction():
    g = load(WORKSHEET.with_name("landing_gear.py")).inputs()
    with mp.workdps(50):
        other = test_landing_gear.Reference(g, mp.mpf(1) / 3)
        l2 = float(other.l2)
        here = test_landing_gear.Reference(g, (mp.mpf(l2) - other.l20) / other.H)
    found = SHEET.common["truth_landing_gear"](g, {"l2i": [l2]}, [0])
    agree([found[k][0] for k in ("Ai", "omega3_l2i", "eps3_l2i")], [here.A, here.omega3_l2, here.eps3_l2])
    agree(found["F_c"], [here.F_c])


def test_slotted_link_at_50_digits_is_that_of_its_own_test():
    g = load(WORKSHEET.with_name("slotted_link.py")).inputs()
    found = SHEET.common["truth_slotted_link"](g, {"phi1_k": [0.7]}, [0])
    other = test_slotted_link.derivatives(g, 0.7)
    names = {"SAB_k": "SAB", "omega_BC_k": "omega_BC", "eps_BC_k": "eps_BC", "VC_k": "VC", "WC_k": "WC"}
    agree([found[k][0] for k in names], [other[k] for k in names.values()])


@pytest.mark.parametrize("phi1", [0.7, 4.0])
def test_balancing_moment_by_work_is_that_of_the_dense_system(phi1):
    g = load(WORKSHEET.with_name("kinetostatics.py")).inputs()
    found = SHEET.common["truth_kinetostatics"](g, {"phi1": [phi1]}, [0])
    other = test_kinetostatics_sheet.Reference(g, phi1)
    agree([found["M_b"][0], found["K"][0]], [other.M_c, other.K])


def test_forces_of_the_joint_are_those_of_its_equilibria():
    sheet = load(WORKSHEET.with_name("joint.py"))
    names = sheet.run(["P", "A_t", "A_c"], {"g": sheet.inputs()})
    found = iter(SHEET.common["truth_joint"](names["g"], names, [])["P"])
    for plane in (0, 1):
        for case in (0, 1):
            y = names["y"][plane, 0]
            A_t, A_c = (np.broadcast_to(names[k], (2, 2, y.size))[plane, case] for k in ("A_t", "A_c"))
            M, N = (names[k][case, 0] for k in ("M", "N"))
            for force in next(test_joint.equilibria(y, A_t, A_c, M, N)):
                assert abs(float(next(found)) - float(force)) < 1e-9


# Verdicts


def test_find_alone_of_the_iterations_survives_bad_guesses():
    common, made = SHEET.common, run("hitch", "unknowns")
    ways = {m.family: m for m in common["find_methods"](made["hitch"], [0.25, 4.0])}
    errors = {name: max(map(made["unknowns"].error, m.run())) for name, m in ways.items()}
    assert errors["find"] < 1e-14
    assert errors["Newton"] == errors["secant"] == errors["hybr, printed formulas"] == 1


def test_printed_reactions_lose_all_digits_with_the_mast_upright_and_the_own_none():
    made = run("job_42")["job_42"]
    errors = {row.family: row.error for row in made.rows}
    assert errors["printed: elimination"] > 1e-2 and errors["library: rrr_reactions"] < 1e-14
    assert made.check().passed


@pytest.mark.parametrize(
    ("right", "wrong", "job"),
    [
        ("return np.array([C for _, C in pins])", "return np.array([C * (1 + 1e-13) for _, C in pins])", "check_11"),
        ("np.array([group_67.R_A,", "np.array([group_67.R_A.astype('complex64'),", "check_41"),
    ],
)
def test_a_default_that_loses_digits_fails(tmp_path, right, wrong, job):
    text = WORKSHEET.read_text(encoding="utf-8")
    assert right in text
    sheet = tmp_path / "accuracy.py"
    sheet.write_text(text.replace(right, wrong), encoding="utf-8")
    (tmp_path / "hitch.py").write_text(WORKSHEET.with_name("hitch.py").read_text(encoding="utf-8"), encoding="utf-8")
    worse = load(sheet)
    made = worse.run([job], {"g": worse.inputs(), "seconds": 1e-6, "sizes": (3,)})
    assert not made[job].passed


def test_less_is_run_for_less():
    table = run("table_6")["table_6"]
    cells = dict(zip(table.columns[0].values, table.columns[1].values, strict=True))
    assert cells["lift arm's angle as a function"] < cells["length of the lifting rod"] < cells["lifting capacity"]
    assert cells["lifting capacity"] < cells["whole document"] / 2


def test_every_worksheet_is_measured_at_every_size():
    rows = run("rows_5")["rows_5"]
    sheets = {path.stem for path in WORKSHEET.parent.glob("*.py")} - {
        WORKSHEET.stem,
        "hitch_design",
    }  # which computes through hitch
    assert {row.family for row in rows} == sheets
    assert all(row.digits > 12 for row in rows)
