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
import vector_equations
from flint import acb, arb
from test_displayed import assert_shown, outputs
from test_exports import assert_current, exported

from mechsheet import sensitivity, sweep
from mechsheet.accuracy import (
    chains,
    claims,
    conditioning,
    drawn,
    exact,
    extreme,
    finding,
    jobs,
    machine,
    precision,
    printed,
    pump,
    responses,
    rivals,
    studied,
    timing,
    truths,
    whole,
)
from mechsheet.accuracy.arithmetic import in_balls, mp, point, root
from mechsheet.accuracy.assur import KINDS
from mechsheet.accuracy.double_double import Point, Real
from mechsheet.accuracy.precision import largest_error
from mechsheet.accuracy.taylor import Taylor
from mechsheet.accuracy.timing import Timed
from mechsheet.mechanics import rrr
from mechsheet.quantities.unrepeatable import clock_read
from mechsheet.worksheet.cells import load
from mechsheet.worksheet.inputs import declared

WORKSHEET = Path(__file__).parents[1] / "worksheets" / "accuracy.py"
SHEET = load(WORKSHEET)


def run(*want: str):
    return SHEET.run(want, {"g": SHEET.inputs(), "seconds": 1e-6, "sizes": (3,)})


@pytest.fixture
def timed_once(monkeypatch):
    """Each method runs once: its time is another one in every run anyway."""

    def timed(runs, _, done):
        clock_read()

        def once(run):
            result = run()
            done()
            return Timed(result, 1.0, 1.0, 1.0, 5)

        return list(map(once, runs))

    for module in (jobs, precision, studied, timing, whole):
        monkeypatch.setattr(module, "timed", timed)


def test_what_is_measured_is_shown_and_exported(tmp_path, monkeypatch, timed_once):
    """As a script, in this process, by one run of all that there is."""
    monkeypatch.setattr(sys, "argv", [str(WORKSHEET), f"--out={tmp_path}"])
    shown, names = outputs(WORKSHEET, {})
    assert_current(WORKSHEET, tmp_path)
    assert_shown(WORKSHEET, shown, names)


def test_every_check_counts_in_the_verdict():
    (verdict,) = (cell for cell in SHEET.cells if cell.name == "verdict")
    made = {name for cell in SHEET.cells for name in cell.gives if name.startswith("check")}
    assert made == {name for name in verdict.needs if name.startswith("check")}


def test_where_a_method_is_faster_at_the_same_digits_the_workbook_says_why_it_is_not_used():
    faster, all_rows = 0, 0
    for title, cells in exported("accuracy").items():
        heads = {cell.value: column for (row, column), cell in cells.items() if row == 3}
        if "not used" in heads:
            for row in {row for row, _ in cells if row > 4}:
                place, why = (cells.get((row, heads[name])) for name in ("place", "not used"))
                all_rows += 1
                assert isinstance(cells[row, heads["roundings"]].value, float), (title, row)
                if place.value in ("faster, the same digits", "faster, more digits"):
                    faster += 1
                    assert why and why.value, (title, row)
    assert faster > 10 and all_rows > 100


def settings(methods, family: str) -> list[float]:
    return [float(m.setting) for m in methods if m.family == family]


# Every method


HITCH = load(WORKSHEET.with_name("hitch.py")).inputs()
CRANK = SHEET.inputs()
FOUND = {name: float(x) for name, x in exact.finds(HITCH).items()}
S = np.linspace(HITCH.S_min, HITCH.S_max, 10)
SOLVERS = ("RK45", "DOP853", "LSODA")


@pytest.fixture(scope="module")
def hitch():
    return chains.hitch_chain(HITCH, FOUND["L4"], FOUND["L7"])


@pytest.fixture(scope="module")
def positions(hitch):
    return rivals.position_methods(hitch, S, lambda: None)


def decades(first: int, last: int, step: int = 1) -> list[float]:
    return [10.0**-k for k in range(first, last + 1, step)]


def test_positions_are_compared_by_every_method_and_tolerance(positions):
    assert settings(positions, "Newton") == pytest.approx(decades(3, 14))
    for method in SOLVERS:
        assert settings(positions, f"solve_ivp {method}") == pytest.approx(decades(3, 12, 3))
    rest = {m.family for m in positions} - {"Newton"} - {f"solve_ivp {m}" for m in SOLVERS}
    assert rest == {"library: rrr", "closed form, no checks", "printed: law of cosines", "fsolve, each position"}


def test_derivatives_finds_and_reactions_are_compared_by_every_method(hitch):
    derivatives = rivals.derivative_methods(hitch, S, 0.25, 1)
    assert settings(derivatives, "central differences") == pytest.approx(decades(1, 10))
    assert settings(derivatives, "differences of five points") == pytest.approx(decades(2, 5))
    assert settings(derivatives, "spline of the table") == [10 * 2**k for k in range(8)]
    assert settings(derivatives, "polynomial of the table") == [10, 20, 40, 80]
    finds = {m.family for m in finding.find_methods(HITCH, [1.0])}
    assert finds == {
        *("find", "inverse mechanism", "find_root", "brentq", "Newton", "secant", "hybr", "hybr, printed formulas"),
    }
    ways = rivals.reaction_methods(HITCH, S, FOUND["L4"], FOUND["L7"], 2 + 0 * S)
    assert [m.family for m in ways] == [
        *("library: rrr_reactions", "closed form, no checks", "printed: elimination", "dense system", "least squares"),
    ]


@pytest.mark.parametrize("family", ["Newton", "fsolve, each position", "solve_ivp RK45", "solve_ivp LSODA"])
def test_an_iteration_reaches_its_tolerance_and_no_more_without_need(positions, hitch, family):
    """A method that returned the library's own numbers would be exact at any tolerance."""
    pins = hitch.pins(S)
    loose = next(m for m in positions if m.family == family)
    tight = next(m for m in positions if m.family == family and float(m.setting) < 1e-8)
    errors = [np.max(abs(m.run() - pins)) for m in (loose, tight)]
    assert 0 < errors[0] < 1e-2
    assert errors[1] < 1e-7


def test_closed_forms_without_checks_are_those_of_the_library(hitch):
    p = chains.hitch_points(HITCH, S, FOUND["L4"], FOUND["L7"], 2 + 0.5j + 0 * S)
    for plain, own in (
        (hitch.plain_pins(S), hitch.pins(S)),
        (hitch.plain_angles(S), hitch.angles(S)),
        (hitch.plain_analogues(1, S), hitch.analogues(1, S)),
        (hitch.plain_analogues(2, S), hitch.analogues(2, S)),
        (chains.plain_hitch_reactions(HITCH, p), chains.hitch_reactions(HITCH, p)),
    ):
        assert plain == pytest.approx(own, rel=1e-12)


@pytest.mark.parametrize("order", [1, 2])
def test_differences_gain_by_the_order_of_their_formula(hitch, order):
    """A tenth of the step leaves a hundredth of the error, of five points a ten thousandth."""
    methods, own = rivals.derivative_methods(hitch, S, 0.25, order), hitch.analogues(order, S)
    for family, gain in (("central differences", 1e2), ("differences of five points", 1e4)):
        rows = {float(m.setting): np.max(abs(m.run() - own)) for m in methods if m.family == family}
        assert gain / 3 < rows[1e-2] / rows[1e-3] < 3 * gain, family


@pytest.mark.parametrize("order", [1, 2])
def test_a_polynomial_makes_more_of_a_table_than_a_spline(hitch, order):
    methods, own = rivals.derivative_methods(hitch, S, 0.25, order), hitch.analogues(order, S)
    error = {(m.family, m.setting): np.max(abs(m.run() - own)) for m in methods if "table" in m.family}
    assert error["polynomial of the table", "40"] < 1e-3 * error["spline of the table", "1280"]


def test_iterations_have_the_slopes_of_their_equations():
    lengths = [*FOUND.values()]
    for k, x in enumerate(lengths):
        u, h = finding.unknown(HITCH, 1.0, *lengths[:k]).unchecked(), 1e-6
        assert u.slope(x) == pytest.approx((u.f(x + h) - u.f(x - h)) / (2 * h), rel=1e-7)
        assert u.gap(x) == pytest.approx(0, abs=1e-12)


def test_all_ways_to_the_lifting_rod_put_the_axis_at_its_height():
    """The height by the printed formulas, which take part in none of them."""
    heights, ways = np.linspace(0.19, 0.21, 3), finding.rod_ways(HITCH)
    assert list(ways) == [
        *("find", "find_root", "find_root, no checks", "brentq", "brentq, no checks", "inverse mechanism"),
    ]
    for name, way in ways.items():
        reached = [printed.hitch_pins(HITCH, HITCH.S_min, L4, HITCH.L7_pre)["P56_S"].imag for L4 in way(heights)]
        assert reached == pytest.approx(heights, abs=1e-12), name


# Drives over time


def test_a_fast_valve_is_stiff_and_a_dead_centre_is_not():
    """Told by the evaluations of the solvers, and by how often the fastest mode decays: the lift takes 500 of its."""
    table = responses.integration_steps("1.8", HITCH)
    drive, decays, tolerance, method, steps, evaluations, *_, error = (column.values for column in table.columns)
    assert sorted(set(tolerance)) == [1e-7, 1e-3]
    rows = list(zip(drive, method, tolerance == 1e-3, steps, evaluations, strict=True))
    needed = {(of, name): n for of, name, loose, _, n in rows if not loose}
    taken = {(of, name): n for of, name, loose, n, _ in rows if loose}
    valve, crank = "cylinder behind a fast valve", "crank past a dead centre"
    explicit, implicit = ("RK45", "DOP853"), ("LSODA", "BDF", "Radau")
    assert min(needed[valve, m] for m in explicit) > 1.5 * max(needed[valve, m] for m in implicit)
    assert min(needed[valve, m] for m in explicit) > 3 * needed[valve, "LSODA"]
    assert max(taken[valve, m] for m in implicit) < 0.5 * min(taken[valve, m] for m in explicit)
    assert needed[crank, "RK45"] < min(needed[crank, m] for m in implicit)
    lost = [(of, name) for of, name, e in zip(drive, method, error, strict=True) if e > 0.1]
    assert lost == [(crank, "RK45"), (crank, "DOP853"), (crank, "BDF")]  # in the other assembly
    assert np.all(error[tolerance == 1e-7] < 1e-5)
    assert decays[drive == valve] == pytest.approx(500) and np.all(decays[drive == crank] < 20)


def test_a_drive_that_alone_is_integrated_takes_the_pin_with_it():
    job, crank = responses.response_jobs(("1.6", "1.7"), HITCH)
    assembled = [m for m in job.methods if "assembled" in m.family and m.setting]
    assert [m.setting for m in assembled] == ["1e-05", "1e-09"] * 2
    for m in assembled:
        assert largest_error(m.run(), job.truth) < 10 * float(m.setting), m.family
    assert not any("assembled" in m.family and m.setting for m in crank.methods)


@pytest.mark.parametrize("drive", [responses.lift(HITCH), responses.crank_past_dead_centre()])
def test_slopes_of_a_drive_are_those_of_differences(drive):
    y = np.array(drive.start) + 0.01
    y[0] += 0.3 * (len(y) > 2)
    t, step = float(drive.times[3]), 1e-6
    ahead, behind = (np.array([drive.rates(t, y + way * e) for e in step * np.eye(len(y))]) for way in (1, -1))
    assert np.array(drive.slopes(t, y)) == pytest.approx((ahead - behind).T / (2 * step), rel=1e-6, abs=1e-6)


def test_the_lift_follows_its_valve():
    """The valve's opening is 1 - exp(-t/lag): speed and stroke of the assembled positions, by differences."""
    drive, h = responses.lift(HITCH), 1e-6
    t = np.array([0.0005, 0.003, 0.2])
    speed = (drive.along(t + h) - drive.along(t - h)) / (2 * h)
    assert speed == pytest.approx((HITCH.S_max - HITCH.S_min) * (1 - np.exp(-t / 2e-3)), rel=1e-6)
    assert drive.along(0.0) == HITCH.S_min


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
    tangent, normal = (found["WC_k"] / found["P_C_k"] * abs(found["P_C_k"]) * way for way in (mp.mpc(0, -1), -1))
    agree([found["WCt_k"], found["WCn_k"]], [tangent.real, normal.real])


@pytest.mark.parametrize("phi1", [0.7, 4.0])
def test_reactions_and_the_balancing_moment_by_work_are_those_of_the_dense_system(phi1):
    g = load(WORKSHEET.with_name("kinetostatics.py")).inputs()
    found = pump.kinetostatics(g, phi1)
    other = test_kinetostatics_sheet.Reference(g, phi1)
    agree([found["M_b"], found["K"]], [other.M_c, other.K])
    agree([found[name] for name in pump.FORCES], [other.vectors[name] for name in pump.FORCES])
    agree([found["h76"]], [other.h76])


def test_forces_of_the_joint_are_those_of_its_equilibria():
    sheet = load(WORKSHEET.with_name("joint.py"))
    names = sheet.run(["P", "A_t", "A_c"], {"g": sheet.inputs()})
    found = iter(truths.exact_results("joint", names, [])["P"])
    for plane in (0, 1):
        for case in (0, 1):
            y = names["y"][plane, 0]
            A_t, A_c = (np.broadcast_to(names[k], (2, 2, y.size))[plane, case] for k in ("A_t", "A_c"))
            M, N = (names[k][case, 0] for k in ("M", "N"))
            for force in next(test_joint.equilibria(y, A_t, A_c, M, N)):
                assert abs(float(next(found)) - float(force)) < 1e-9


def test_a_ball_that_has_no_50_digits_is_refused_and_one_about_nothing_is_nothing():
    centre = in_balls(lambda y: {"y": y()})
    assert abs(centre(lambda: arb(2).sqrt())["y"] - mp.sqrt(2)) < 1e-60
    assert centre(lambda: arb(0, 1e-99))["y"] == 0 and mp.isnan(centre(arb.nan)["y"])
    for wide in (arb(1, 1e-49), arb(0, 1e-49)):
        with pytest.raises(ArithmeticError, match="is not known to 50 digits"):
            centre(lambda wide=wide: wide)


def real(x) -> mp.mpf:
    return mp.mpf(float(x.high)) + mp.mpf(float(x.low))


def test_arrays_of_32_digits_compute_as_50_digits_do():
    rng = np.random.default_rng(5)
    for a, b, c, d in rng.normal(size=(20, 4)) * 10.0 ** rng.integers(-3, 4, size=(20, 4)):
        p, q, r = Real(a) / Real(b), Real(c) / 3 + 1, Real(d * d)
        P, Q, R = mp.mpf(a) / b, mp.mpf(c) / 3 + 1, mp.mpf(d * d)
        for found, true in ((p * q - r, P * Q - R), (p / q, P / Q), (root(r), mp.sqrt(R)), (p**2, P**2)):
            assert abs(real(found) - true) < 1e-30 * max(abs(true), abs(P * Q), abs(R))
        z, w = point(p, q) / point(q, r), mp.mpc(P, Q) / mp.mpc(Q, R)
        assert abs(mp.mpc(real(z.real), real(z.imag)) - w) < 1e-30 * abs(w)


def test_derivatives_come_with_a_number():
    """Of t^2 sqrt(1 + t) / (2 - t) at t = 0.3, by mpmath's own."""
    t = Taylor(mp.mpf("0.3"), mp.mpf(1), mp.mpf(0))
    found = t**2 * root(t + 1) / (t * -1 + 2)
    for order, value in enumerate(found.of):
        assert abs(value - mp.diff(lambda t: t**2 * mp.sqrt(1 + t) / (2 - t), mp.mpf("0.3"), order)) < 1e-30


# The groups: what is exact of them, by their position alone, against the vector equations of another file


ve = vector_equations


def ordinary(name: str) -> dict[str, float]:
    """The numbers of one of the random geometries."""
    kind = KINDS[name]
    x = {key: value[0] for key, value in drawn.drawn(kind, 1, kind.names).items()}
    numbers = {}
    for key, value in x.items():
        parts = {key: value.real, f"{key}y": value.imag} if np.iscomplexobj(value) else {key: value}
        numbers |= {part: float(number) for part, number in parts.items()}
    return numbers


def by_vector_equations(name: str, x: dict) -> dict:
    """All results of a group from the vector equations."""
    loads_A, loads_B = [(x["F_A"], x["P_A"], x["T_A"])], [(x["F_B"], x["P_B"], x["T_B"])]
    A, B, pins = x["A"], x["B"], (x["v_A"], x["v_B"])
    if name == "RRR":
        C = ve.rrr(A, B, x["r_A"], x["r_B"], 1)[""]
        v = ve.rrr_velocity(A, B, C, *pins, x["dr_A"], x["dr_B"])
        rates = v["omega_A"], v["omega_B"], x["dr_A"], x["dr_B"], x["a_A"], x["a_B"], x["ddr_A"], x["ddr_B"]
        a, R = ve.rrr_acceleration(A, B, C, *rates), ve.rrr_reactions(A, B, C, loads_A, loads_B)
    elif name == "RRP":
        C = ve.rrp(A, B, x["u"], x["r_A"], 1, x["e"])[""]
        v = ve.rrp_velocity(A, B, C, x["u"], *pins, x["omega_B"], x["dr_A"])
        rates = v["omega_A"], v["ds"], x["omega_B"], x["dr_A"], x["a_A"], x["a_B"], x["epsilon_B"], x["ddr_A"]
        a, R = ve.rrp_acceleration(A, B, C, x["u"], *rates), ve.rrp_reactions(A, C, x["u"], loads_A, loads_B)
    elif name == "RPR":
        u = ve.rpr(A, B, 1, x["e"])["u"]
        v = ve.rpr_velocity(A, B, u, *pins)
        a = ve.rpr_acceleration(A, B, u, v["omega_A"], v["ds"], x["a_A"], x["a_B"])
        return {"u": u} | v | a | ve.rpr_reactions(A, B, u, loads_A, loads_B)
    elif name == "PRP":
        C, guides = ve.prp(A, B, x["w"], x["u"])[""], (x["w"], x["u"])
        v = ve.prp_velocity(A, B, C, *guides, *pins, x["omega_A"], x["omega_B"])
        rates = v["ds_A"], v["ds_B"], x["omega_A"], x["omega_B"], x["a_A"], x["a_B"], x["epsilon_A"], x["epsilon_B"]
        a, R = ve.prp_acceleration(A, B, C, *guides, *rates), ve.prp_reactions(C, *guides, loads_A, loads_B)
    else:
        C, guides = ve.rpp(A, B, x["w"], x["u"])[""], (x["w"], x["u"])
        v = ve.rpp_velocity(A, B, C, *guides, *pins, x["omega_B"])
        rates = v["ds_A"], v["ds_B"], x["omega_B"], x["a_A"], x["a_B"], x["epsilon_B"]
        a, R = ve.rpp_acceleration(A, B, C, *guides, *rates), ve.rpp_reactions(A, C, *guides, loads_A, loads_B)
    return {"C": C} | v | a | R


@pytest.mark.parametrize("name", KINDS)
def test_exact_groups_obey_their_vector_equations_with_50_digits_and_with_32(name):
    kind, numbers = KINDS[name], ordinary(name)
    exactly, other = kind.exact_of(**numbers), in_balls(by_vector_equations)(name, kind.joined(numbers, arb, acb))
    assert set(exactly) == {key for key in other if key != "exists" and not key.startswith("h_")}
    arrays = kind.exact(kind.joined(numbers, Real, lambda x, y: Point(x, y)))
    for key, y in exactly.items():
        z = arrays[key]
        short = mp.mpc(real(z.real), real(z.imag)) if isinstance(z, Point) else real(z)
        true = other[key]
        assert abs(y - true) < 1e-45 * abs(true) and abs(short - y) < 1e-27 * abs(y), key


# Verdicts


def test_find_alone_of_the_iterations_survives_bad_guesses():
    ways = {m.family: m for m in finding.find_methods(HITCH, [0.25, 4.0])}
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
    assert len(job.truth) == 9 * 7 and len(job.methods) == 5
    worst = max(abs(complex(force)) for force in job.truth)
    for method in job.methods:
        assert largest_error(method.run(), job.truth) < 1e-14, method.family
    R_A = job.truth[:7]  # by the worksheet's own groups, which take part in no method here
    own = load(WORKSHEET.with_name("kinetostatics.py"))
    made = own.run(["R_A"], {"g": own.inputs(), "phi1": 2 * np.pi * np.arange(7) / 7})["R_A"]
    assert np.array(R_A, complex) == pytest.approx(made, abs=1e-12 * worst)


def test_a_ring_all_but_lifted_loses_digits_by_primitives_and_none_by_the_own():
    errors = {m.family: largest_error(m.run(), job.truth) for job in [machine.ring_job("4.5", 10)] for m in job.methods}
    assert errors["fixed places, no checks"] < 1e-15
    assert errors["library: circular_joint"] < 1e-14 and errors["quad, each force"] < 1e-14
    assert errors["printed: primitives of the arc"] > 1e-13
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


def test_less_is_run_for_less(timed_once):
    table = run("table_6")["table_6"]
    cells = dict(zip(table.columns[0].values, table.columns[1].values, strict=True))
    assert cells["lift arm's angle as a function"] < cells["length of the lifting rod"] < cells["lifting capacity"]
    assert cells["lifting capacity"] < cells["whole document"] / 2


def test_studies_stand_beside_what_is_kept_of_a_run(timed_once):
    table = studied.study_costs("8", WORKSHEET.parent / "examples" / "bolted_joint.py", {"nothing": int}, 1e-6)
    study, time, of_run, _, runs = (column.values for column in table.columns)
    assert [study[0], *study[-4:]] == [
        "a run of the worksheet's cells",
        "all their digits proved",
        "its workbook written",
        "a run, and the HTML of all that it shows",
        "nothing",
    ]
    assert np.all(runs == 5) and np.all(of_run == time / time[0])


@pytest.fixture(scope="module")
def studies():
    return studied.study_jobs(WORKSHEET.with_name("hitch.py"), CRANK, sweep, sensitivity)


def test_two_unknowns_close_their_loop(studies):
    (alpha_1, beta_1, alpha_2, beta_2), B = studies["8.1"].truth, CRANK.X_B - CRANK.l_1 + 1j * CRANK.Y_B
    for alpha, beta in ((alpha_1, beta_1), (alpha_2, beta_2)):
        assert abs(CRANK.l_A * mp.expj(alpha) - B - CRANK.l_B * mp.expj(beta)) < 1e-45
    assert alpha_1 < alpha_2


def test_forces_of_the_elements_bear_their_moments(studies):
    forces, y = np.array(studies["8.2"].truth, float).reshape(40, 24), np.linspace(-0.1, 0.1, 24)
    assert forces.sum(-1) == pytest.approx(-1e4, rel=1e-12)
    assert (forces * y).sum(-1) == pytest.approx(np.linspace(1e3, 1e5, 40), rel=1e-12)
    stress = forces / np.where(forces > 0, 2e-4, 3e-4)
    assert np.diff(stress, 2, axis=-1) == pytest.approx(0, abs=1e-6 * np.abs(stress).max())


def test_a_sensitivity_is_what_a_run_with_other_inputs_tells(studies):
    """Elasticities of the worst capacities' positions 0 and 4 by the crank's hinge and the implement's weight."""
    sheet, step = load(WORKSHEET.with_name("hitch.py")), 1e-6
    names = [name for name, x in sensitivity(sheet.path, ["GS6"]).inputs.items() if x]
    truth = np.array(studies["8.4"].truth, float).reshape(len(names), 2)
    for name in ("X01", "L5", "phi_P6", "P_gc_max"):
        g = sheet.inputs()
        x = getattr(g, name)
        ahead, behind = (
            sheet.run(["GS6"], {"g": replace(g, **{name: x * (1 + way * step)})})["GS6"][[0, 4]] for way in (1, -1)
        )
        assert truth[names.index(name)] == pytest.approx((ahead - behind) / (ahead + behind) / step, rel=1e-6), name


def test_five_points_make_more_of_a_sweep_than_two(studies):
    rows = studies["8.4"].methods
    errors = {(m.family, m.setting): largest_error(m.run(), studies["8.4"].truth) for m in rows if "diff" in m.family}
    assert errors["differences of five points", "1e-04"] < 1e-4 * errors["differences by a sweep", "1e-04"]


@pytest.mark.parametrize("number", ["8.1", "8.2", "8.3", "8.4"])
def test_studies_keep_the_digits_of_the_best(studies, number):
    errors = {m.family: largest_error(m.run(), studies[number].truth) for m in studies[number].methods}
    own, *others = errors
    assert errors[own] < 1e-14 and others
    assert errors[own] < 4 * min(errors.values()) + 8 * 2.0**-53


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


def test_every_group_is_timed_at_every_size(monkeypatch):
    """By the numbers that it computes, not by the clock: a second for each of them."""

    def timed(runs, seconds, done):
        results = [run() for run in runs]
        sizes = [max(map(np.size, vars(group).values())) for group in results]
        return [Timed(result, float(n), 0.9 * n, 1.3 * n, 5) for result, n in zip(results, sizes, strict=True)]

    monkeypatch.setattr(timing, "timed", timed)
    table = drawn.group_times("1.4", (1, 50), 1e-6)
    way, one, many, slope, apart, runs = (column.values for column in table.columns)
    assert list(way) == [f"group {name}" for name in KINDS] and [c.name for c in table.columns[1:3]] == ["1", "50"]
    assert np.all(one == 1e6) and np.all(many == 1e6) and slope == pytest.approx(1)
    assert apart == pytest.approx(20) and np.all(runs == 5)


def test_checks_are_what_the_closed_forms_leave_of_the_library(monkeypatch):
    def timed(runs, seconds, done):
        for library, plain in zip(runs[::2], runs[1::2], strict=True):
            np.testing.assert_allclose(library(), plain(), rtol=1e-12)
        return [Timed(None, t, t, t, 5) for _ in runs[::2] for t in (4.0, 1.0)]

    monkeypatch.setattr(jobs, "timed", timed)
    work, count, library, plain, share, *_ = (
        c.values for c in jobs.cost_of_checks("1.5", HITCH, (1, 20), 1e-6).columns
    )
    assert list(count) == [1, 20] * 4 and len(set(work)) == 4
    assert library == pytest.approx(4e6 / count) and plain == pytest.approx(1e6 / count) and share == pytest.approx(75)


def test_random_groups_are_measured_in_roundings_and_one_that_loses_digits_fails(monkeypatch):
    table, check = drawn.random_groups("7.5", 40)
    group, of, count, results, *quantiles = (column.values for column in table.columns)
    assert list(group[::4]) == ["RRR", "RRP", "RPR", "PRP", "RPP"] and np.all(count == 40)
    assert list(of[:4]) == ["position", "velocity", "acceleration", "reactions"]
    assert results[:8].tolist() == [40, 120, 120, 120, 40, 120, 120, 160]
    assert np.all(np.diff(quantiles, axis=0) >= 0) and np.all(quantiles[0] > 0) and np.all(quantiles[-1] < 64)
    assert check.passed and check.residual == quantiles[-1].max()
    own = KINDS["PRP"]

    class Lost(type(own)):
        def by_library(self, x):
            found = own.by_library(x)
            return found | {"C": np.where(np.arange(len(found["C"])) == 3, np.nan, found["C"])}

    monkeypatch.setitem(drawn.KINDS, "PRP", Lost(*own))
    assert drawn.random_groups("7.5", 6)[1].residual == np.inf, "a number that is missing is no small error"

    class Worse(type(own)):
        def by_library(self, x):
            return {name: y * (1 + 1e-11) for name, y in own.by_library(x).items()}

    monkeypatch.setitem(drawn.KINDS, "PRP", Worse(*own))
    assert not drawn.random_groups("7.5", 5)[1].passed


def test_condition_of_a_function_by_its_own_differences():
    """Of x - y it is (|x| + |y|) / |x - y|, at worst of its elements; of a point both parts count."""
    x = {"x": np.array([3.0, 3.0]), "y": np.array([2.0, 2.999])}
    here, total = conditioning.changes(lambda x: x["x"] - x["y"], x)
    assert total / here == pytest.approx([5, 5.999 / 1e-3], rel=1e-6)
    assert conditioning.condition(lambda x: abs(x["z"]), {"z": 3 + 4j}) == pytest.approx((9 + 16) / 25)


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
    all_of = compared = 0
    for table, least, derived, inputs in zip(tables, (130, 80, 40), (40, 15, 5), (4, 1, 1), strict=True):
        name, kappa, expected, kept, against, _ = (column.values for column in table.columns)
        assert len(name) >= least and np.all(np.diff(kappa) <= 1e-6)
        assert np.count_nonzero(against == "50 digits") >= derived and np.count_nonzero(against == "") == inputs
        assert np.array_equal(np.isnan(kept), against == "") and not np.any(kept < expected - 2)
        own_forms = np.array([not re.search("_(printed|listing)$", each) for each in name])
        all_of, compared = all_of + own_forms.sum(), compared + np.count_nonzero(own_forms & (against != ""))
        assert len(table.head(8).columns[0].values) == 8 and "the workbook holds all" in table.head(8).note
        told = re.match(r"(\d+) of (\d+) results are compared with 50 digits by .*, (\d+) with what", table.note)
        assert [int(n) for n in told.groups()] == [
            np.count_nonzero(against == "50 digits"), len(name), np.count_nonzero(against == "balls")
        ]  # fmt: skip
    assert f"of {compared} of {all_of} results" in check.name and compared >= 240
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


def test_every_worksheet_is_measured_at_every_size(timed_once):
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
