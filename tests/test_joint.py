"""Joints: the printed example, equilibria in exact arithmetic, the ring at 50 digits, and their worksheet."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import mpmath as mp
import numpy as np
import pytest
from as_script import as_script
from conftest import examples
from hypothesis import assume, given
from hypothesis import strategies as st
from printed import agrees, half_last_digit, rows

from mechsheet import units
from mechsheet.mechanics.joint import NODES, WEIGHTS, bending, circular_joint, neutral_axis
from mechsheet.worksheet.cells import load
from mechsheet.worksheet.check import Check, refuse_open
from mechsheet.worksheet.errors import SheetError
from mechsheet.worksheet.inputs import build, declared
from mechsheet.worksheet.table import Table
from worksheets import joint

SHEET = Path(__file__).parents[1] / "worksheets" / "joint.py"
KGF, CM = 9.80665, 0.01


@pytest.fixture(scope="module")
def sheet():
    return joint.app.run()[1]


def column(table, symbol):
    return next(c.values for c in table.columns if c.symbol == symbol)


# The printed example

# In the plane ZOX the document counts the other way round: the numbers here of its beams and stringers.
COUNTED = {
    ("1", "beam"): [1, 2, 3, 4],
    ("1", "stringer"): [1, 2, 3, 4, 5, 6, 7, 8],
    ("2", "beam"): [1, 4, 3, 2],
    ("2", "stringer"): [2, 1, 8, 7, 6, 5, 4, 3],
}


@pytest.mark.parametrize("row", rows("joint/inputs.csv"), ids=lambda row: f"{row['variant']} {row['element']}")
def test_printed_input_of_the_program(sheet, row):
    kind, number = row["element"].split()
    i = COUNTED[row["variant"], kind][int(number) - 1] - 1 + 4 * (kind == "stringer")
    assert agrees(sheet["y"][int(row["variant"]) - 1, 0, i] / CM, row["y_cm"])
    assert agrees(sheet["A_t"][i] / CM**2, row["area_tension_cm2"])
    assert agrees(sheet["A_c"][i] / CM**2, row["area_compression_cm2"])


@pytest.mark.parametrize("row", rows("joint/load_cases.csv"), ids=lambda row: row["case"])
def test_printed_load_case(sheet, row):
    i = int(row["case"]) - 1
    assert np.isclose(sheet["M"][i, 0], float(row["M_kgf_cm"]) * KGF * CM, rtol=1e-15)
    assert np.isclose(sheet["N"][i, 0], float(row["N_kgf"]) * KGF, rtol=1e-15)


def test_printed_table_1(sheet):
    table = sheet["table_1"]
    key = np.stack([column(table, name) for name in ("plane", "beam", "case")], axis=1).tolist()
    printed = rows("joint/table_1_beams.csv")
    assert len(printed) == len(key) == 16
    wrong = []
    for row in printed:
        beam = COUNTED[row["variant"], "beam"][int(row["beam"]) - 1]
        i = key.index([float(row["variant"]), beam, float(row["case"])])
        for symbol, name in (("Pb", "N_kgf"), ("sigmab", "sigma_kgf_cm2")):
            if not agrees(column(table, symbol)[i], row[name]):
                wrong.append((row, column(table, symbol)[i]))
    assert not wrong


SECTION = {
    "M_reduced": "Mz",
    "y_neutral": "yno",
    "y_neutral_from_centroid": "y1no",
    "y_centroid": "yc",
    "F": "F",
    "S": "S",
    "I": "Iz",
}


@pytest.mark.parametrize("row", rows("joint/section_variant1_case1.csv"), ids=lambda row: row["quantity"])
def test_printed_section(sheet, row):
    assert agrees(column(sheet["table_31"], SECTION[row["quantity"]])[0], row["printed"])


def test_area_and_centroid_are_misread_in_the_scan():
    """6.828 and 4.877 agree with each of the other printed numbers of the line, 6.928 and 4.677 with none."""
    printed = {row["quantity"]: row["printed"] for row in rows("joint/section_variant1_case1.csv")}
    M, N, I_c, y_0 = 5e5, 13e3, float(printed["I"]), float(printed["y_neutral"])

    def spread(a, b, name):  # half digits of the misread number and of the one compared with it
        return a * half_last_digit(b) + half_last_digit(printed[name])

    def relations(F, y_c):
        f, y = float(F), float(y_c)
        yield f * y - float(printed["S"]), y * half_last_digit(F) + spread(f, y_c, "S")
        yield M - N * y - float(printed["M_reduced"]), N * half_last_digit(y_c) + 50  # 4.366e5
        yield y_0 - y - float(printed["y_neutral_from_centroid"]), half_last_digit(y_c) + 0.005 + 0.05
        axis = -N * I_c / (f * (M - N * 4.877))
        yield axis - float(printed["y_neutral_from_centroid"]), 0.05 + 0.01 * abs(axis) / 4
        stress = N / f + (M - N * y) * (25 - y) / I_c
        yield stress - 4044, 1.0

    assert all(abs(off) <= play for off, play in relations("6.828", "4.877"))
    misread = list(relations("6.928", "4.677"))
    assert all(abs(off) > play for off, play in misread), misread


def test_printed_reduced_areas(sheet):
    value = {name: sheet[name][0] / CM**2 for name in ("F_bt", "F_bc", "F_sc", "F_sk")}
    assert [f"{value[name]:.3f}" for name in ("F_bt", "F_bc", "F_sc")] == ["2.040", "1.102", "0.272"]
    assert agrees(sheet["beta"], "0.34")
    assert (round(sheet["l_b"] / CM, 12), round(sheet["l_h"] / CM, 12)) == (8.125, 16.25)
    assert agrees(sheet["l_h"] / CM, "16.3") and agrees(sheet["dF_cr"] / CM**2, "0.102")
    assert not agrees(sheet["l_b"] / CM, "8.15"), "the erratum of sheet 55"
    as_printed = [column(sheet["table_21"], symbol)[0] for symbol in ("lbe", "whe", "Fske", "dFte", "dFtre", "Fbte")]
    printed = ("8.15", "12.5", "2.065", "3.065", "1.04", "2.04")
    assert all(agrees(*pair) for pair in zip(as_printed, printed, strict=True))
    assert abs(value["F_sk"] - 2.065) < 0.0026
    assert [f"{x:.3f}" for x in column(sheet["table_21"], "Fbte")] == ["2.040", "2.040", "2.170"]


def test_sheet_57_as_it_reads_beside_what_it_should(sheet):
    read, right = np.array([column(sheet["table_32"], name) for name in ("Fe", "yce", "Se", "Mze", "y1noe")]).T
    assert (read[0], read[1]) == pytest.approx((6.928, 4.677), rel=1e-14)
    printed = ("6.828", "4.877", "33.3", "4.366e5", "-17.9")
    assert all(agrees(*pair) for pair in zip(right, printed, strict=True))
    assert not any(agrees(*pair) for pair in zip(read, printed, strict=True))


def test_areas_without_the_rounding_of_the_example(sheet):
    whole = joint.app.run(defs={"g": replace(sheet["g"], d_E=0.0, d_F=0.0)})[1]
    beta = Fraction(72, 210)
    assert np.allclose(whole["F_bt"] / CM**2, float(1 + beta * Fraction("3.0625")), rtol=1e-14)
    assert np.allclose(whole["F_sc"] / CM**2, float(beta * Fraction("0.8")), rtol=1e-14)


def test_stringer_outside_the_skin_is_left_out(sheet):
    narrow = joint.app.run(defs={"g": replace(sheet["g"], psi=0.4)})[1]
    assert np.isclose(narrow["F_bte"][2], (1 + 0.34 * 1.5) * CM**2)
    assert not narrow["F_sb"].any() and not narrow["F_sh"].any()


def test_table_2_carries_what_the_beams_leave(sheet):
    """Stringers where compressed, with the beams of table 1, balance both loads; stretched ones carry nothing."""
    P_s, P_b = (column(sheet[f"table_{k}"], f"P{name}").reshape(2, 2, -1) for k, name in ((2, "s"), (1, "b")))
    sigma = sheet["sigma"][..., 4:]
    assert np.all(P_s[sigma >= 0] == 0) and np.all(P_s[sigma < 0] < 0)
    assert np.allclose(P_s.sum(-1) + P_b.sum(-1), [[13000, -13000]] * 2, rtol=1e-13)
    levels = sheet["y"] / CM
    moments = (P_b * levels[..., :4]).sum(-1) + (P_s * levels[..., 4:]).sum(-1)
    assert np.allclose(moments, [[5e5, 3e5]] * 2, rtol=1e-13)


def test_iteration_of_the_document_ends_at_the_same_axis(sheet):
    assert np.array_equal(sheet["n_k"][..., 0], [[2, 3], [1, 2]])
    assert np.allclose(sheet["y_k"][-1], sheet["y_no"], rtol=1e-13)


# Rectangular joint in exact arithmetic


def equilibria(y, A_t, A_c, M, N):
    """Forces of every equilibrium: each split of the elements by a level whose stresses have the signs assumed."""
    y, A_t, A_c = ([Fraction(float(v)) for v in values] for values in (y, A_t, A_c))
    M, N = Fraction(float(M)), Fraction(float(N))
    for level in y:
        for flip in (False, True):
            stretched = [(v > level) != flip for v in y]
            A = [t if s else c for t, c, s in zip(A_t, A_c, stretched, strict=True)]
            F, S = sum(A), sum(a * v for a, v in zip(A, y, strict=True))
            J = sum(a * v * v for a, v in zip(A, y, strict=True))
            if F * J == S * S:
                continue
            a, b = (N * J - M * S) / (F * J - S * S), (M * F - N * S) / (F * J - S * S)
            sigma = [a + b * v for v in y]
            if all(s >= 0 if up else s <= 0 for s, up in zip(sigma, stretched, strict=True)):
                yield [s * area for s, area in zip(sigma, A, strict=True)]


small = st.integers(-4, 4).map(float)
elements = st.lists(st.tuples(small, st.integers(0, 3), st.integers(0, 3)), min_size=1, max_size=7)


@given(elements, small, small)
def test_finds_the_one_equilibrium_or_says_there_is_none(section, M, N):
    """Whole numbers: elements on one level, the axis through elements and loads on the edge all happen."""
    y, A_t, A_c = (np.array(v, float) for v in zip(*section, strict=True))
    found, true = neutral_axis(y, A_t, A_c, M, N), list(equilibria(y, A_t, A_c, M, N))
    assert (found.state == "no equilibrium") == (not true)
    assert all(forces == true[0] for forces in true), "the forces are unique"
    if true:
        forces = np.array([float(f) for f in true[0]])
        assert np.allclose(found.force, forces, rtol=0, atol=1e-13 * max(1, np.max(np.abs(forces))))
    else:
        assert np.isnan(found.force).all() and np.isnan(found.y_0)


@pytest.mark.parametrize(("spread", "away"), [(1, 0), (6, 0), (1, 1e6)])
def test_real_numbers(spread, away):
    """Areas over 2 * spread decades, levels far from the axis of the load: forces keep their digits."""
    rng = np.random.default_rng(spread)
    for _ in range(30):
        n = rng.integers(2, 9)
        y, A_t, A_c = away + rng.normal(size=n), *10 ** rng.uniform(-spread, spread, (2, n))
        M, N = rng.normal(size=2)
        true = np.array([float(f) for f in next(equilibria(y, A_t, A_c, M, N))])
        assert np.allclose(neutral_axis(y, A_t, A_c, M, N).force, true, rtol=0, atol=4e-15 * np.max(np.abs(true)))


def plane_section(y, A, M, N):
    """Stresses N / F + (M - N y_c) (y - y_c) / I_c of exact numbers."""
    F = sum(A)
    y_c = sum(a * v for a, v in zip(A, y, strict=True)) / F
    slope = (M - N * y_c) / sum(a * (v - y_c) ** 2 for a, v in zip(A, y, strict=True))
    return [N / F + slope * (v - y_c) for v in y]


def worst_of_elements(y, A, M, N, sigma):
    """Greatest error of a stress in roundings of what its own condition allows: each input moved by a part of it."""
    given, n = [Fraction(float(v)) for v in (*y, *A, M, N)], len(y)
    true = plane_section(given[:n], given[n:-2], *given[-2:])
    allowed, part = [abs(v) for v in true], Fraction(1, 10**20)
    for k, v in enumerate(given):
        moved = [*given[:k], v * (1 + part), *given[k + 1 :]]
        changed = plane_section(moved[:n], moved[n:-2], *moved[-2:])
        allowed = [c + abs(a - b) / part for c, a, b in zip(allowed, changed, true, strict=True)]
    return max(abs(Fraction(float(s)) - t) / c for s, t, c in zip(sigma, true, allowed, strict=True)) / 2**-53


@pytest.mark.parametrize("decades", [1, 6])
def test_every_stress_keeps_the_digits_of_its_own_condition(decades):
    """Levels and areas over some decades: that of an element beside the axis had those of the greatest one only."""
    rng = np.random.default_rng(decades)
    for _ in range(40):
        n = rng.integers(2, 7)
        y = rng.choice([-1, 1], n) * 10 ** rng.uniform(-decades, 0, n)
        A_t, A_c = 10 ** rng.uniform(-decades, 0, (2, n))
        M, N = rng.normal(size=2) * 10 ** rng.uniform(-decades, decades, 2)
        found = neutral_axis(y, A_t, A_c, M, N)
        assert worst_of_elements(y, found.area, M, N, found.sigma) < 8


def test_levels_too_near_for_a_section_are_none():
    """What carries lies on levels whose squares are below all floats: no section, not one without load."""
    found = neutral_axis([0.0, 1e-200, 1.0], [1.0, 1.0, 0.0], [1.0, 1.0, 0.0], 1.0, 1.0)
    assert found.state == "no equilibrium" and np.isnan(found.sigma).all()


@examples(50)
@given(elements, st.integers(0, 6), st.sampled_from([-1.0, 1.0]), st.floats(1e-3, 1e3))
def test_axis_through_an_element(section, at, side, scale):
    """A stress that vanishes at an element is found again from its load, whichever area that element has."""
    y, A_t, A_c = (np.array(v, float) for v in zip(*section, strict=True))
    level = y[at % len(y)]
    sigma = side * scale * (y - level)
    A = np.where(sigma > 0, A_t, A_c)
    assume(np.unique(y[(A > 0) & (y != level)]).size >= 2)
    found = neutral_axis(y, A_t, A_c, (sigma * A * y).sum(), (sigma * A).sum())
    assert np.allclose(found.sigma, sigma, rtol=0, atol=1e-12 * scale)
    assert np.isclose(found.y_0, level, rtol=0, atol=1e-12)


def test_iteration_ends_without_an_axis_where_the_equilibrium_is_found(sheet):
    """Cables: with one row slack at the start the other row is no section, though in truth both are stretched."""
    M, N = np.full((2, 1), 10.0), np.full((2, 1), 1000.0)
    defs = {
        "A_t": np.ones(12),
        "A_c": np.zeros(12),
        "M": M,
        "N": N,
        "y": np.repeat([0.2, -0.2], 6) + np.zeros((2, 1, 12)),
    }
    lost = joint.iteration.run(g=sheet["g"], **defs)[1]
    assert np.all(lost["steps"] == 0) and np.isnan(lost["axes"]).all()
    assert neutral_axis(defs["y"], defs["A_t"], defs["A_c"], 10, 1000).state.tolist() == [["all in tension"]] * 2


@pytest.mark.parametrize(
    ("M", "N", "state"),
    [
        (0, 1000, "all in tension"),
        (0, -1000, "all in compression"),
        (100, 1e5, "all in tension"),
        (100, -1e5, "all in compression"),
        (100, 0, "tension and compression"),
        (-100, 10, "tension and compression"),
        (0, 0, "no load"),
    ],
)
def test_states_in_words(M, N, state):
    found = neutral_axis([0.25, 0.1, -0.25], [2e-4, 0, 2e-4], [1e-4, 1e-4, 1e-4], M, N)
    assert found.state == state
    assert np.isclose(found.force.sum(), N, rtol=1e-14, atol=0) or N == 0


def test_axis_at_infinity():
    """M -> 0 on a symmetric section: the axis goes to infinity, the stress is N / F, and nothing else happens."""
    y, A = [0.25, -0.25], [1e-4, 1e-4]
    assert np.isinf(neutral_axis(y, A, A, 0, 1000).y_0)
    assert np.isnan(neutral_axis(y, A, A, 0, 0).y_0)
    for M in 10.0 ** np.arange(-300, 1, 20):
        assert np.allclose(neutral_axis(y, A, A, M, 1000).sigma, [5e6 + M / 5e-5, 5e6 - M / 5e-5], rtol=1e-14)


def test_no_equilibrium():
    """Contact of two faces: no tension, and no compression whose line passes outside the contact."""
    y, A_t, A_c = [0.2, 0.0, -0.2], np.zeros(3), np.full(3, 1e-4)
    M, N = np.array([0, 150, 199, 201, -150, 0]), np.array([1000, -1000, -1000, -1000, -1000, 0])
    found = neutral_axis(y, A_t, A_c, M, N)
    assert (found.state == "no equilibrium").tolist() == [True, False, False, True, False, False]
    assert np.all(np.isnan(found.sigma[found.state == "no equilibrium"]))
    assert found.state[-1] == "no load" and np.all(found.force[-1] == 0)


def test_elements_on_one_level_are_no_section():
    """A single level gives I = 0 exactly, so nothing is made of rounding."""
    for y in (0.3, 1 / 3, 1e6 / 7):
        assert neutral_axis([y, y, y], [0.1, 0.2, 0.7], [0.3, 0.3, 0.3], 0.3, 1).state == "no equilibrium"


def test_cases_planes_and_variants_broadcast(sheet):
    rng = np.random.default_rng(5)
    y, A = rng.normal(size=(3, 1, 1, 6)), rng.uniform(0, 2, (2, 3, 2, 1, 6))
    M, N = rng.normal(size=(2, 4))
    found = neutral_axis(y, *A, M, N)
    assert found.force.shape == found.area.shape == (3, 2, 4, 6) and found.y_0.shape == found.state.shape == (3, 2, 4)
    for i in np.ndindex(3, 2, 4):
        one = neutral_axis(y[i[0], 0, 0], A[0][*i[:2], 0], A[1][*i[:2], 0], M[i[2]], N[i[2]])
        assert np.array_equal(one.force, found.force[i]) and one.y_0 == found.y_0[i] and one.state == found.state[i]


@examples(50)
@given(elements, small, small, st.floats(1e-6, 1e6))
def test_symmetries(section, M, N, scale):
    """Turned upside down, loaded the other way with areas exchanged, loaded more: the forces follow."""
    y, A_t, A_c = (np.array(v, float) for v in zip(*section, strict=True))
    force = neutral_axis(y, A_t, A_c, M, N).force
    near = {"rtol": 0, "atol": 1e-12 * (1 + np.nanmax(np.abs(force), initial=0)), "equal_nan": True}
    assert np.allclose(neutral_axis(-y, A_t, A_c, -M, N).force, force, **near)
    assert np.allclose(-neutral_axis(y, A_c, A_t, -M, -N).force, force, **near)
    assert np.allclose(neutral_axis(y, A_t, A_c, scale * M, scale * N).force / scale, force, **near)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (([0.1, np.nan], 1, 1, 0, 1), "level y = nan m must be a finite number"),
        (([0.1, 0.2], [1, -1], 1, 0, 1), "area in tension A_t = -1 m^2 must not be negative"),
        (([0.1, 0.2], 1, [1, -2], 0, 1), "area in compression A_c = -2 m^2 must not be negative"),
        (([0.1, 0.2], 1, 1, np.inf, 1), "moment M = inf N m must be a finite number"),
        (([0.1, 0.2], 1, 1, [1, 2], [1, 2, 3]), "shapes do not broadcast"),
        ((0.1, 1, 1, 0, 1), "level y = 0.1 m must be a row of elements"),
    ],
)
def test_bad_argument_is_named(arguments, message):
    with pytest.raises(ValueError, match=message.replace("^", r"\^")):
        neutral_axis(*arguments)


# Circular joint


def even(m, first=0.0):
    return first + 2 * np.pi * np.arange(m) / m


def ring_at_50_digits(phi, r, M, N):
    """Bolt forces, resultant and greatest line load, for M > 0: c, the angles and both equations, by quadrature."""
    with mp.workdps(50):
        phi, r, M, N = [mp.mpf(v) for v in phi], mp.mpf(r), mp.mpf(M), mp.mpf(N)
        c = N * r / (2 * M)
        edge = mp.acos(-c)

        def arc(f):
            return 2 * r * mp.quad(lambda a: (mp.cos(a) + c) * f(a), mp.linspace(edge, mp.pi, 3))

        w = [max(mp.cos(p) + c, 0) for p in phi]
        pulls = mp.matrix([[mp.fsum(w), arc(lambda a: 1)], [0, arc(mp.cos)]])
        pulls[1, 0] = mp.fsum(v * mp.cos(p) for v, p in zip(w, phi, strict=True))
        a, b = mp.lu_solve(pulls, mp.matrix([N, M / r]))
        return [a * v for v in w], b * pulls[0, 1], b * (c - 1)


@pytest.mark.parametrize("first", [0.0, 0.1])
@pytest.mark.parametrize("c", [-1 + 1e-9, -0.9, -0.3, 0.0, 0.625, 0.99, 1 - 1e-6, 1 - 1e-12])
def test_ring_to_50_digits(c, first):
    r, M = 0.6, 2e5
    phi, N = even(24, first if abs(c) < 0.9 else 0.0), 2 * M / r * c
    ring = circular_joint(r, phi, M, N)
    P, R, p_0 = ring_at_50_digits(phi, r, M, N)
    assert ring.state == "tension and compression"
    load = abs(N) + M / r
    assert np.allclose(ring.P, [float(v) for v in P], rtol=0, atol=1e-14 * load)
    assert abs(ring.R - float(R)) < 1e-14 * load
    # the line load is the quotient of a force and of an arc that closes
    assert abs(ring.p_0 - float(p_0)) < 1e-14 * load / r / (np.pi - ring.phi_0)
    assert np.isclose(-np.cos(ring.phi_0), c, rtol=0, atol=1e-15) and np.isclose(ring.y_0, -c * r, rtol=1e-15)


loads = st.floats(-1e6, 1e6)


@given(st.integers(3, 40), st.floats(0, 6.3), st.floats(0.1, 10), loads, loads)
def test_ring_is_in_equilibrium(m, first, r, M, N):
    phi = even(m, first)
    ring = circular_joint(r, phi, M, N)
    assume(ring.state != "no bolt in tension")
    play = 1e-13 * m * (abs(N) + abs(M) / r) + 1e-320  # the least float has no parts
    assert abs(ring.P.sum() + ring.R - N) <= play
    assert abs((ring.P * r * np.cos(phi)).sum() + ring.M_R - M) <= play * r
    assert ring.P.min() >= -play and play >= ring.R, "bolts pull and rims press"


@pytest.mark.parametrize(
    ("M", "N", "state"),
    [
        (3e4, 2e5, "all in tension"),
        (-3e4, 2e5, "all in tension"),
        (0, 1e5, "all in tension"),
        (3e4, -2e5, "all in compression"),
        (-3e4, -2e5, "all in compression"),
        (0, -1e5, "all in compression"),
        (0, 0, "no load"),
    ],
)
def test_ring_of_one_kind_is_the_uniform_ring(M, N, state):
    r, phi = 0.8, even(20)
    ring = circular_joint(r, phi, M, N)
    assert ring.state == state
    pulled = state == "all in tension"
    assert np.allclose(ring.P, pulled * (N / 20 + 2 * M / (20 * r) * np.cos(phi)), rtol=1e-13)
    pressed = state == "all in compression"
    assert np.isclose(ring.p_0, pressed * (N / (2 * np.pi * r) - abs(M) / (np.pi * r**2)), rtol=1e-13)
    assert np.isclose(ring.R, pressed * N, rtol=1e-13) and np.isclose(ring.M_R, pressed * M, rtol=1e-13)
    assert ring.phi_0 == (0 if pressed else np.pi)


@pytest.mark.parametrize("c", [-1, 1])
def test_ring_passes_smoothly_into_one_kind(c):
    r, M, phi = 0.6, 2e5, even(24)
    near, far = (circular_joint(r, phi, M, 2 * M / r * c * (1 + d)) for d in (-1e-9, 1e-9))
    assert near.state == "tension and compression" and str(far.state).startswith("all in ")
    assert np.allclose(near.P, far.P, rtol=0, atol=1e-8 * M / r) and np.isclose(
        near.R, far.R, rtol=0, atol=1e-8 * M / r
    )


def test_ring_loaded_the_other_way_is_turned_by_half():
    one, other = circular_joint(0.6, even(24), 2e5, -2e5), circular_joint(0.6, even(24), -2e5, -2e5)
    assert np.allclose(one.P, np.roll(other.P, 12), rtol=1e-12)
    assert np.allclose([one.p_0, one.R, one.M_R], [other.p_0, other.R, -other.M_R], rtol=1e-12)
    assert one.phi_0 == other.phi_0 and one.c == -other.c and one.y_0 == -other.y_0


def test_uneven_bolts():
    """Solved approximately, with the moment left over across the plane, or refused in words."""
    r, M = 0.6, 2e5
    phi = even(24) + 0.05 * np.cos(even(24))
    ring = circular_joint(r, phi, M, 0)
    assert np.isclose(ring.M_x, (ring.P * r * np.sin(phi)).sum(), rtol=1e-12) and abs(ring.M_x) > 1e-3 * M
    assert np.isclose(ring.P.sum() + ring.R, 0, atol=1e-9 * M)
    refused = circular_joint(r, [np.pi - 0.2, np.pi + 0.2, 3], M, [0, 2 * M / r * 0.999])
    assert refused.state.tolist() == ["no bolt in tension", "tension and compression"]
    crowded = [0, *np.linspace(0.7, 1.3, 20)]
    assert circular_joint(r, crowded, M, 0.99 * 2 * M / r).state == "ring in tension"
    far = [0, *np.linspace(2.2, 3.1, 19)]
    assert circular_joint(r, far, M, 1.01 * 2 * M / r).state == "bolt in compression"
    assert np.isnan(refused.R[0]) and np.isnan(refused.P[0]).all()


def test_rings_broadcast():
    phi, M, N = np.stack([even(24), even(24, 0.1)])[:, None], np.array([2e5, 1e5, 0]), np.array([-1e5, 0, 5e4])
    rings = circular_joint(0.6, phi, M, N)
    assert rings.P.shape == (2, 3, 24)
    assert all(np.shape(v) == (2, 3) for v in rings[1:])
    for p, k in np.ndindex(2, 3):
        one = circular_joint(0.6, phi[p, 0], M[k], N[k])
        assert np.array_equal(one.P, rings.P[p, k]) and one.state == rings.state[p, k]


@pytest.mark.parametrize("r", [0, -1])
def test_radius_must_be_positive(r):
    with pytest.raises(ValueError, match=f"radius r = {r} m must"):
        circular_joint(r, even(3), 1, 1)


# The worksheet


def checks(sheet):
    return [c for v in sheet.values() for c in (v if isinstance(v, tuple) else [v]) if isinstance(c, Check)]


CASES = [(5e5, 13e3, 0), (3e5, -13e3, 0)]
RING = [(2e6, -2e4), (1.2e6, 2.5e4)]
EXTREME = {
    "no load": {"loads": [(0, 0, 0)], "ring_loads": [(0, 0)]},
    "no moment": {"loads": [(0, 13e3, 0), (5, -13e3, -5)], "ring_loads": [(0, -2e4), (0, 2.5e4)]},
    "pulled": {"loads": [(5e5, 1e7, 0), CASES[1]], "ring_loads": [(2e6, 1e7), RING[1]]},
    "pressed": {"loads": [(5e5, -1e7, 0), CASES[1]], "ring_loads": [(2e6, -1e7), RING[1]]},
    "the other way": {"loads": [(-5e5, 13e3, 0), CASES[1]], "ring_loads": [(-2e6, -2e4), RING[1]]},
    "bare": {"delta": 0, "psi": 0, "stringers": [(0, 0, 0, 0, 1)]},
    "many": {
        "loads": [(k * 1e5, 13e3, -1e4 * k) for k in range(1, 10)],
        "alpha": [0, 10, 20],
        "bolts": [*range(0, 360, 30)],
    },
    "one element of each kind": {
        "beams": [(20, 10, 1, 1, 1)],
        "stringers": [(-15, -11, 0.5, 1, 1)],
        "loads": [(5e5, 1e4, 0)],
        "bolts": [0, 90, 180, 270],
        "ring_loads": RING[:1],
    },
    "one plane, one case": {"loads": CASES[:1], "ring_loads": RING[:1], "alpha": [0]},
}


def given_as(change):
    return build(load(SHEET).inputs, change)


@pytest.mark.parametrize("change", [{}, *EXTREME.values()], ids=["as printed", *EXTREME])
def test_every_check_passes(change):
    file = load(SHEET)
    names = file.run(file.results, {"g": given_as(change)})
    assert len(checks(names)) == (9 if names["holds"].any() else 7), "what holds nowhere is not checked"
    assert [str(c) for c in checks(names) if not c.passed] == []
    for p, k in np.ndindex(names["joint"].state.shape):
        assert "<svg" in names["scheme"](p, k, "h", "b").svg()
    for p, k in np.ndindex(names["ring"].state.shape):
        assert "<svg" in names["ring_scheme"](p, k).svg()


def test_a_case_that_no_elements_carry_leaves_the_drawings_of_the_others():
    """Bars, areas and diagrams are drawn to the scale of all cases: one without a number took them from all."""
    rows = {"beams": [(25, 12.5, 1, 1, 1), (-25, 12.5, 1, 1, 1)], "stringers": [(0, 0, 0, 0, 1)], "bolts": [0, 10]}
    loads = {"loads": [CASES[0], (0, 1e4, 0)], "ring_loads": RING}
    both, first = (
        load(SHEET).run(["scheme", "ring_scheme", "sigma", "P_k"], {"g": given_as(rows | given)})
        for given in (loads, {name: cases[:1] for name, cases in loads.items()})
    )
    assert np.isnan(both["sigma"][1, 1]).all() and np.isnan(both["P_k"][:, 1]).all(), "all cases are carried"
    assert both["scheme"](0, 0, "h", "b").svg() == first["scheme"](0, 0, "h", "b").svg()
    assert both["ring_scheme"](0, 0).svg() == first["ring_scheme"](0, 0).svg()


def test_document_formulas_of_the_ring_are_left_empty_where_they_do_not_hold():
    names = joint.app.run(defs={"g": given_as({"ring_loads": [RING[0], (1.2e6, 1e7)]})})[1]
    assert np.isfinite(names["P_n"][:, 0]).all() and np.isnan(names["P_n"][:, 1]).all()


# Any number of rows

RESULTS = ("A_t", "A_c", "sigma", "P", "y_no", "P_k", "p_o", "P_n", "M_x")


def results(**given):
    found = load(SHEET).run(RESULTS, {"g": given_as(given)})
    return {name: found[name] for name in RESULTS}


def alike(one, other, **picked):
    """Whether two runs have the same results, of the second those that an index picks."""
    for name, a in one.items():
        b = other[name][picked[name]] if name in picked else other[name]
        size = np.max(np.abs(a), initial=0, where=np.isfinite(a))
        assert np.allclose(a, b, rtol=0, atol=1e-11 * size, equal_nan=True), name


whole = st.integers(-9, 9)
loads_given = st.lists(st.tuples(whole, whole, whole), min_size=1, max_size=4)
bolts_given = st.lists(st.integers(0, 359), min_size=5, max_size=12, unique=True)


@examples(12)
@given(loads_given, st.data())
def test_each_load_case_is_as_if_it_were_alone(cases, data):
    """And a third load is a part of the first."""
    cases = [(1e5 * M, 1e4 * N, 1e4 * M_w) for M, N, M_w in cases]
    k = data.draw(st.integers(0, len(cases) - 1))
    M, N, M_w = cases[k]
    together = results(loads=cases, ring_loads=[case[:2] for case in cases])
    alone = results(loads=[(M + M_w, N, 0)], ring_loads=[(M, N)])
    one = np.s_[:, k : k + 1]
    alike(alone, together, **dict.fromkeys(("sigma", "P", "y_no", "P_k", "p_o", "P_n", "M_x"), one))


@examples(12)
@given(bolts_given, st.integers(-360, 360), st.randoms())
def test_only_the_angles_between_bolts_and_planes_count(bolts, turn, random):
    """The ring turned with its planes is the same ring, and the order of its bolts is no matter."""
    as_it_is = results(bolts=bolts, alpha=[0, 20])
    order = list(range(len(bolts)))
    random.shuffle(order)
    turned = [(bolts[k] + turn + 360) % 720 - 360 for k in order]
    other = results(bolts=turned, alpha=[turn, (turn + 380) % 720 - 360])
    alike(as_it_is, other, P_k=np.s_[..., np.argsort(order)])


@examples(12)
@given(st.permutations(range(4)), st.permutations(range(8)))
def test_order_of_the_elements_is_no_matter(beams, stringers):
    g = load(SHEET).inputs()
    rows = {
        name: np.column_stack([c.display(x) for c, x in field.leaves(getattr(g, name)).values()])
        for field in declared(type(g))
        if (name := field.name) in ("beams", "stringers")
    }
    picked = np.s_[..., np.argsort([*beams, *(4 + k for k in stringers)])]
    other = results(beams=rows["beams"][beams], stringers=rows["stringers"][stringers])
    alike(results(), other, **dict.fromkeys(("A_t", "A_c", "sigma", "P"), picked))


def test_elements_turned_by_a_right_angle_change_the_planes():
    g = load(SHEET).inputs()
    turned = replace(
        g,
        **{
            name: replace(getattr(g, name), y=getattr(g, name).z, z=getattr(g, name).y)
            for name in ("beams", "stringers")
        },
        psi=1.0,
    )
    one, other = (load(SHEET).run(["y", "A_c", "y_b"], {"g": each}) for each in (g, turned))
    assert np.array_equal(one["y"], other["y"][::-1]) and np.array_equal(one["A_c"], other["A_c"])


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"beams": "25; 12.5; 1"}, "beams, as they are numbered beams (1) = '25; 12.5; 1' must have the columns y, z"),
        ({"beams": "25; 12.5; 0; 1; 1"}, "area, steel beams.F (1) = 0.0 cm² must be positive"),
        ({"beams": []}, "beams, as they are numbered beams must have 1 to 10000 rows, not 0"),
        ({"stringers": "25; 12.5; 1; 0; -1"}, "part of it, with its skin, that is pressed stringers.k_c (1) = -1.0"),
        ({"loads": "5e5; 13e3"}, "load cases loads (1) = '5e5; 13e3' must have the columns M, N, M_w"),
        ({"loads": [(1, 2, "x")]}, "moment of the third array loads.M_w (1) = 'x' kgf·cm is no number"),
        ({"bolts": "0; 400"}, "angles of the bolts bolts (2) = 400.0 deg must be <= 360 deg"),
        ({"alpha": ""}, "angles of the planes of the load alpha must have 1 to 10000 rows, not 0"),
        ({"beams": "25; 12.5; 1; 1; 1", "stringers": "25; 12.5; 1; 0; 1"}, "equilibrium exists: plane 1, case 1: "),
        ({"bolts": "0"}, "ring in equilibrium exists: plane "),
    ],
)  # fmt: skip
def test_wrong_rows_are_one_line(given, message):
    with pytest.raises(SheetError) as error:
        names = load(SHEET).run(["checks_joint", "checks_ring"], {"g": given_as(given)})
        refuse_open(checks(names))
    assert str(error.value).startswith(message) and "\n" not in str(error.value)


def test_si_changes_the_units_and_nothing_else(sheet):
    si = joint.app.run(defs={"g": replace(sheet["g"], SI=1)})[1]
    used = set()
    for name in (
        "table_21",
        "table_31",
        "table_32",
        "table_33",
        "table_1",
        "table_2",
        "table_51",
        "table_52",
        "table_53",
    ):
        for a, b in zip(sheet[name].columns, si[name].columns, strict=True):
            used.add(b.unit)
            one, other = (c.values * units.parse(c.unit).factor for c in (a, b))
            assert a.symbol == b.symbol and np.allclose(one, other, rtol=1e-14)
    assert used == {"-", "N", "N*m", "mm", "mm**2", "mm**3", "mm**4", "MPa", "deg", "N/mm"}
    assert not any("kgf" in c.unit for t in si.values() if isinstance(t, Table) for c in t.columns)
    drawn = si["scheme"](0, 0, "h", "b").svg() + si["ring_scheme"](0, 0).svg()
    assert "MPa" in drawn and " N<" in drawn and "kgf" not in drawn
    assert "e+0" not in drawn, "forces of this size are written in full"


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--r=-50"], "error: radius of the joint r = -50.0 cm must be positive"),
        (
            ["--ring_loads=2e6; -66400"],
            "error: ring in equilibrium exists: plane 2, case 1: no bolt in tension for M = 2000000 kgf*cm"
            " with N = -66400 kgf",
        ),
    ],
)
def test_bad_input_is_one_line_and_writes_nothing(tmp_path, arguments, message):
    done = as_script(SHEET, *arguments, f"--out={tmp_path}")
    assert (done.returncode, done.stderr.strip(), list(tmp_path.iterdir())) == (1, message, [])


def test_script_writes_the_workbook(tmp_path):
    done = as_script(SHEET, "--SI=1", f"--out={tmp_path}")
    assert (done.returncode, done.stderr) == (0, "")
    assert [p.name for p in tmp_path.iterdir()] == ["joint.xlsx"]


def test_a_wrong_area_is_named_whatever_the_shape_of_the_loads():
    with pytest.raises(ValueError, match=r"^area in tension A_t = -1 m\^2 must not be negative$"):
        neutral_axis([0, 1], [1, -1], [1, 1], np.ones(3), 0)
    with pytest.raises(ValueError, match=r"^moment M = nan N m must be a finite number$"):
        neutral_axis([0, 1], [1, 1], [1, 1], np.ma.masked_array(np.ones(3), [0, 1, 0]), 0)


def test_levels_that_do_not_fit_the_areas_are_named():
    with pytest.raises(ValueError, match=r"^shapes do not broadcast: y \(3,\), A \(2,\)$"):
        bending([0, 1, 2], [1, 1], 1, 1)


def test_places_and_weights_of_the_arc_are_right_to_a_rounding():
    """Numpy's weights are not, by up to 63: a force of a bolt lost a digit by them."""
    with mp.workdps(30):
        for x, w in zip(map(float, NODES), map(float, WEIGHTS), strict=True):
            slope = mp.diff(lambda t: mp.legendre(16, t), x)
            off = mp.legendre(16, x) / slope
            true = x - off
            weight = 2 / ((1 - true**2) * mp.diff(lambda t: mp.legendre(16, t), true) ** 2)
            assert abs(off) < 2.0**-53 * abs(x)
            assert abs(w - weight) < 2.0**-53 * weight
