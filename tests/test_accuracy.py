"""The accuracy worksheet: every method that it must compare, its truths against other derivations, its verdicts."""

import re
import shutil
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import test_joint
import test_kinetostatics_sheet
import test_slotted_link
from test_displayed import assert_shown, outputs
from test_exports import assert_current

from mechsheet.accuracy import claims, conditioning, exact, extreme, jobs, machine, rivals
from mechsheet.accuracy.arithmetic import mp
from mechsheet.accuracy.precision import largest_error
from mechsheet.mechanics import rrr
from mechsheet.worksheet.cells import load
from mechsheet.worksheet.inputs import declared

WORKSHEET = Path(__file__).parents[1] / "worksheets" / "accuracy.py"
SHEET = load(WORKSHEET)


def run(*want: str):
    return SHEET.run(want, {"g": SHEET.inputs(), "seconds": 1e-6, "sizes": (3,)})


def test_what_is_measured_is_shown_and_exported(tmp_path, monkeypatch, timed_once):
    """As a script, in this process, by one run of all that there is."""
    monkeypatch.setattr(sys, "argv", [str(WORKSHEET), f"--out={tmp_path}"])
    shown, names = outputs(WORKSHEET, {})
    assert_current(WORKSHEET, tmp_path)
    assert_shown(WORKSHEET, shown, names)


def settings(methods, family: str) -> list[float]:
    return [float(m.setting) for m in methods if m.family == family]


# Every method


HITCH = load(WORKSHEET.with_name("hitch.py")).inputs()
FOUND = {name: float(x) for name, x in exact.finds(HITCH).items()}
S = np.linspace(HITCH.S_min, HITCH.S_max, 10)


@pytest.fixture(scope="module")
def hitch():
    return rivals.hitch_chain(HITCH, FOUND["L4"], FOUND["L7"])


@pytest.fixture(scope="module")
def positions(hitch):
    return rivals.position_methods(hitch, S, lambda: None)


def decades(first: int, last: int) -> list[float]:
    return [10.0**-k for k in range(first, last + 1)]


def test_positions_are_compared_by_every_method_and_tolerance(positions):
    assert settings(positions, "Newton") == pytest.approx(decades(3, 14))
    for method in ("RK45", "DOP853", "Radau"):
        assert settings(positions, f"solve_ivp {method}") == pytest.approx(decades(3, 12))
    rest = {m.family for m in positions} - {"Newton"} - {f"solve_ivp {m}" for m in ("RK45", "DOP853", "Radau")}
    assert rest == {"library: rrr", "printed: law of cosines", "fsolve, each position"}


def test_derivatives_finds_and_reactions_are_compared_by_every_method(hitch):
    derivatives = rivals.derivative_methods(hitch, S, 0.25, 1)
    assert settings(derivatives, "central differences") == pytest.approx(decades(1, 10))
    assert settings(derivatives, "spline of the table") == [10 * 2**k for k in range(8)]
    finds = {m.family for m in rivals.find_methods(HITCH, [1.0])}
    assert finds == {
        *("find", "inverse mechanism", "brentq on the reach", "Newton", "secant", "hybr", "hybr, printed formulas"),
    }
    ways = rivals.reaction_methods(HITCH, S, FOUND["L4"], FOUND["L7"], 2 + 0 * S)
    assert [m.family for m in ways] == [
        *("library: rrr_reactions", "printed: elimination", "dense system", "least squares"),
    ]


@pytest.mark.parametrize("family", ["Newton", "fsolve, each position", "solve_ivp RK45", "solve_ivp Radau"])
def test_an_iteration_reaches_its_tolerance_and_no_more_without_need(positions, hitch, family):
    """A method that returned the library's own numbers would be exact at any tolerance."""
    pins = hitch.pins(S)
    loose = next(m for m in positions if m.family == family)
    tight = next(m for m in positions if m.family == family and float(m.setting) < 1e-8)
    errors = [np.max(abs(m.run() - pins)) for m in (loose, tight)]
    assert 0 < errors[0] < 1e-2
    assert errors[1] < 1e-7


# Truths


def agree(found, exactly):
    assert all(abs(a - b) <= 1e-25 * max(1, abs(b)) for a, b in zip(found, exactly, strict=True)), (found, exactly)


@pytest.mark.parametrize("p", [0.25, 0.75])
def test_landing_gear_at_50_digits_gives_the_power_that_its_motion_takes(p):
    """The rod's power is what kinetic and potential energy gain in time, less the power of the wind."""
    g = load(WORKSHEET.with_name("landing_gear.py")).inputs()
    x = {name: mp.mpf(value) for name, value in vars(g).items()}
    stroke = exact.stroke(g)
    l2, v = stroke["l20"] + p * stroke["H"], stroke["V21"]
    hanging = mp.mpc(0, -1) / exact.landing_gear(g, stroke["l20"])["Ai"]  # the leg hangs where the cylinder is shortest

    def leg(t):
        return hanging * exact.landing_gear(g, l2 + v * t)["Ai"]  # its unit vector after the time t

    def slope(f):
        step = mp.mpf(10) ** -20
        return (8 * (f(step) - f(-step)) - f(2 * step) + f(-2 * step)) / (12 * step)

    def energy(t):
        omega = exact.landing_gear(g, l2 + v * t)["omega3i"]
        return (x["J3"] + x["m3"] * x["r3"] ** 2) * omega**2 / 2 + x["m3"] * x["g_n"] * x["r3"] * leg(t).imag

    here, q = exact.landing_gear(g, l2), x["rho"] * x["U"] * abs(x["U"]) / 2
    u = leg(mp.mpf(0))
    turning = slope(lambda t: mp.arg(leg(t) / u))
    normal = mp.mpc(0, 1) * u
    wind = q * x["C_w"] * (x["l_w"] * turning * normal).real
    wind += q * x["C_s"] * normal.real * abs(normal.real) * x["l_w"] / 2 * turning
    agree([here["omega3i"], here["P_c"]], [turning, slope(energy) - wind])
    agree([abs(here["Ai"]), abs(here["Ai"] - mp.mpc(-x["b"], x["a"]))], [x["l3"], l2])


def test_slotted_link_at_50_digits_is_that_of_its_own_test():
    g = load(WORKSHEET.with_name("slotted_link.py")).inputs()
    found = exact.slotted_link(g, 0.7)
    other = test_slotted_link.derivatives(g, 0.7)
    names = {"SAB_k": "SAB", "omega_BC_k": "omega_BC", "eps_BC_k": "eps_BC", "VC_k": "VC", "WC_k": "WC"}
    agree([found[k] for k in names], [other[k] for k in names.values()])


@pytest.mark.parametrize("phi1", [0.7, 4.0])
def test_balancing_moment_by_work_is_that_of_the_dense_system(phi1):
    g = load(WORKSHEET.with_name("kinetostatics.py")).inputs()
    found = exact.kinetostatics(g, phi1)
    other = test_kinetostatics_sheet.Reference(g, phi1)
    agree([found["M_b"], found["K"]], [other.M_c, other.K])


def test_forces_of_the_joint_are_those_of_its_equilibria():
    sheet = load(WORKSHEET.with_name("joint.py"))
    names = sheet.run(["P", "A_t", "A_c"], {"g": sheet.inputs()})
    found = iter(jobs.exact_results("joint", names, [])["P"])
    for plane in (0, 1):
        for case in (0, 1):
            y = names["y"][plane, 0]
            A_t, A_c = (np.broadcast_to(names[k], (2, 2, y.size))[plane, case] for k in ("A_t", "A_c"))
            M, N = (names[k][case, 0] for k in ("M", "N"))
            for force in next(test_joint.equilibria(y, A_t, A_c, M, N)):
                assert abs(float(next(found)) - float(force)) < 1e-9


# Verdicts


def test_find_alone_of_the_iterations_survives_bad_guesses():
    ways = {m.family: m for m in rivals.find_methods(HITCH, [0.25, 4.0])}
    truth = exact.finds(HITCH).values()
    errors = {name: max(largest_error(found, truth) for found in m.run()) for name, m in ways.items()}
    assert errors["find"] < 1e-14
    assert errors["Newton"] == errors["secant"] == errors["hybr, printed formulas"] == 1


def test_printed_reactions_lose_all_digits_with_the_mast_upright_and_the_own_none():
    made = run("job_42")["job_42"]
    errors = {row.family: row.error for row in made.rows}
    assert errors["printed: elimination"] > 1e-2 and errors["library: rrr_reactions"] < 1e-14
    assert made.check().passed
    assert "fastest setting" in made.summary().note and not made.table().note, "each table says what its rows are"


def test_all_ways_to_the_reactions_of_groups_of_all_kinds_are_right():
    job = machine.machine_job("4.4", load(WORKSHEET.with_name("kinetostatics.py")), 7)
    assert len(job.truth) == 9 * 7 and len(job.methods) == 4
    worst = max(abs(complex(force)) for force in job.truth)
    for method in job.methods:
        assert largest_error(method.run(), job.truth) < 1e-14, method.family
    R_A = job.truth[:7]  # by the worksheet's own groups, which take part in no method here
    own = load(WORKSHEET.with_name("kinetostatics.py"))
    made = own.run(["R_A"], {"g": own.inputs(), "phi1": 2 * np.pi * np.arange(7) / 7})["R_A"]
    assert np.array(R_A, complex) == pytest.approx(made, abs=1e-12 * worst)


def test_a_ring_all_but_lifted_loses_digits_by_primitives_and_none_by_the_own():
    errors = {m.family: largest_error(m.run(), job.truth) for job in [machine.ring_job("4.5", 10)] for m in job.methods}
    assert errors["library: circular_joint"] < 1e-14 and errors["quad, each force"] < 1e-14
    assert errors["primitives of the arc"] > 1e-13
    assert 1e-9 < errors["rim in strips"] < 1e-6


@pytest.mark.parametrize(
    ("module", "function", "worse", "job"),
    [
        (rrr, "rrr", lambda C: C * (1 + 1e-13), "check_11"),
        (rivals, "hitch_reactions", lambda R: R.astype("complex64"), "check_41"),
    ],
)
def test_a_default_that_loses_digits_fails(monkeypatch, module, function, worse, job):
    right = getattr(module, function)
    monkeypatch.setattr(module, function, lambda *given: worse(right(*given)))
    assert not run(job)[job].passed


def test_less_is_run_for_less():
    table = run("table_6")["table_6"]
    cells = dict(zip(table.columns[0].values, table.columns[1].values, strict=True))
    assert cells["lift arm's angle as a function"] < cells["length of the lifting rod"] < cells["lifting capacity"]
    assert cells["lifting capacity"] < cells["whole document"] / 2


def test_studies_stand_beside_what_is_kept_of_a_run():
    table = jobs.study_costs("8", WORKSHEET.with_name("slotted_link.py"), {"nothing": int}, 1e-6)
    study, time, of_run, _, runs = (column.values for column in table.columns)
    assert [study[0], *study[-4:]] == [
        "a run of the worksheet's cells",
        "all their digits proved",
        "its workbook written",
        "its page refreshed: a run, and all that it shows drawn",
        "nothing",
    ]
    assert np.all(time[:-1] > time[-1]) and np.all(runs >= 1)
    assert of_run[0] == 1 and np.allclose(of_run, time / time[0])


def test_a_proof_claims_the_digits_that_there_are_and_seldom_fewer():
    for stem, least in (("landing_gear", 40), ("kinetostatics", 15), ("joint", 48)):
        made = claims.claims(WORKSHEET.with_name(f"{stem}.py"))
        assert len(made) >= least and not any(claim.is_more or claim.is_fewer for claim in made), stem
        assert all(claim.proved > 13 for claim in made), stem


def test_a_claim_of_digits_that_there_are_not_fails(monkeypatch):
    made = [claims.Claim("hitch", "F_gc", 14.9, 12.25), claims.Claim("hitch", "GS6", 12.5, 15.1)]
    monkeypatch.setattr(claims, "claims", lambda path: made)
    table, check = claims.claims_table("7.4", WORKSHEET.parent)
    assert not check.passed and check.reason.startswith("hitch F_gc: 14.9 proved of 12.2")
    assert [column.values[0] for column in table.columns[1:]] == [2, 12.5, 12.25, 50]


def test_every_group_is_timed_at_every_size():
    table = conditioning.group_times("1.4", (1, 50), 1e-6)
    groups = [f"group {name}" for name in conditioning.GROUPS]
    assert [c.name for c in table.columns] == ["count", *groups, *(f"{name} ±" for name in groups)]
    one, many = np.array([c.values for c in table.columns[1:6]]).T
    assert (many < one).all() and (many > 0).all(), "checks are shared by all that are computed at once"


def test_random_groups_are_measured_in_roundings_and_one_that_loses_digits_fails(monkeypatch):
    table, check = conditioning.random_groups("7.5", 40)
    group, positions, *quantiles = (column.values for column in table.columns)
    assert list(group) == ["RRR", "RRP", "RPR", "PRP", "RPP"] and np.all(positions == 40)
    assert np.all(np.diff(quantiles, axis=0) >= 0) and np.all(quantiles[0] > 0)
    assert check.passed and check.residual == quantiles[-1].max()
    own = conditioning.GROUPS["PRP"]
    worse = own._replace(found=lambda *given: own.found(*given) * (1 + 1e-11))
    monkeypatch.setitem(conditioning.GROUPS, "PRP", worse)
    assert not conditioning.random_groups("7.5", 5)[1].passed


@pytest.fixture(scope="module")
def conditions():
    """Of the documents whose inputs are numbers alone, and few."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(conditioning, "DOCUMENTS", ("hitch", "landing_gear", "slotted_link"))
        return conditioning.end_to_end("7.6", WORKSHEET.parent)


@pytest.mark.parametrize(
    ("n", "stem", "want"),
    [
        (0, "hitch", ["GS6", "R05", "phi6_S", "L7"]),
        (1, "landing_gear", ["eps3i", "F_c", "H"]),
        (2, "slotted_link", ["VC_k"]),
    ],
)
def test_condition_from_end_to_end_is_that_of_runs_with_other_inputs(n, stem, want, conditions):
    name, kappa, *_, most = (column.values for column in conditions[0][n].columns)
    sheet, step = load(WORKSHEET.with_name(f"{stem}.py")), 1e-6
    g = sheet.inputs()

    def results(**changed: float):
        found = sheet.run(want, {"g": replace(g, **changed)})
        return {key: np.atleast_1d(found[key]) for key in want}

    moved = {key: dict[str, np.ndarray]() for key in want}
    for field in declared(sheet.inputs):
        x = getattr(g, field.name)
        if isinstance(x, float) and x:
            ahead, behind = (results(**{field.name: x * (1 + way * step)}) for way in (1, -1))
            for key in want:
                moved[key][field.name] = np.abs(ahead[key] - behind[key]) / (2 * step)
    for key, size in results().items():
        changes, row = np.array([*moved[key].values()]), list(name).index(key)
        k = changes.sum(0).argmax()
        other = max(1.0, changes[:, k].sum() / np.abs(size).max())
        assert kappa[row] == pytest.approx(np.log10(other), abs=1e-5), key
        assert most[row] == [*moved[key]][changes[:, k].argmax()], key


def test_all_results_of_a_document_have_their_condition_and_keep_the_digits_it_leaves(conditions):
    tables, check = conditions
    assert [table.number for table in tables] == ["7.6", "7.7", "7.8"] and check.passed
    for table, least, known in zip(tables, (130, 80, 40), (40, 15, 5), strict=True):
        name, kappa, expected, kept, _ = (column.values for column in table.columns)
        assert len(name) >= least and np.all(np.diff(kappa) <= 1e-6)
        assert np.count_nonzero(np.isfinite(kept)) >= known and not np.any(kept < expected - 2)
        assert len(table.head(8).columns[0].values) == 8 and "the workbook holds all" in table.head(8).note
    balance = {"F2", "F3", "F4", "F5", "F6", "F7", "F23", "F45", "F67", "M2", "M3", "M4", "M5", "M6", "M7"}
    none = set(re.findall(r"\w+", tables[0].note))
    assert balance <= none and none.isdisjoint(tables[0].columns[0].values), (
        "zero but for rounding, without a condition"
    )


def test_a_result_that_loses_more_than_its_condition_fails(monkeypatch):
    path = WORKSHEET.with_name("slotted_link.py")
    sheet, names, truths = conditioning.from_inputs(path, path.read_bytes())
    worse = {name: {k: y * (1 + 1e-11) for k, y in truth.items()} for name, truth in truths.items()}
    monkeypatch.setattr(conditioning, "DOCUMENTS", ("slotted_link",))
    monkeypatch.setattr(conditioning, "from_inputs", lambda *_: (sheet, names, worse))
    assert not conditioning.end_to_end("8.1", WORKSHEET.parent)[1].passed


def test_every_worksheet_is_measured_at_every_size():
    rows = run("rows_5")["rows_5"]
    sheets = {path.stem for path in WORKSHEET.parent.glob("*.py")} - {
        WORKSHEET.stem,
        "hitch_design",  # which computes through hitch
        "guide",  # no document
    }
    assert {row.family for row in rows} == sheets
    assert all(row.digits > 12 for row in rows)


def test_worksheets_in_any_folder_are_measured_by_the_scenes_of_the_package(tmp_path):
    for path in WORKSHEET.parent.glob("*.py"):
        shutil.copy(path, tmp_path)
    copied = load(tmp_path / WORKSHEET.name)
    assert "scenes" in {cell.name for cell in copied.needed(["checks_7"], ["g"])} and len(extreme.scenes()) > 30
    checks = copied.run(["checks_7"], {"g": copied.inputs(), "outcomes_7": []})["checks_7"]
    assert [c.verdict for c in checks] == ["not evaluated"] * 2, "no check passes over no scene"
