"""Joints: the printed example, equilibria in exact arithmetic, the ring at 50 digits, and their worksheet."""

from __future__ import annotations

import subprocess
import sys
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import mpmath as mp
import numpy as np
import pytest
from conftest import examples
from hypothesis import assume, given
from hypothesis import strategies as st
from printed import agrees, half_last_digit, rows

from mechsheet import units
from mechsheet.mechanics.joint import circular_joint, neutral_axis
from mechsheet.worksheet.check import Check
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


@pytest.mark.parametrize("row", rows("joint/inputs.csv"), ids=lambda row: f"{row['variant']} {row['element']}")
def test_printed_input_of_the_program(sheet, row):
    kind, number = row["element"].split()
    i = int(number) - 1 + 4 * (kind == "stringer")
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
        i = key.index([float(row[name]) for name in ("variant", "beam", "case")])
        for symbol, name in (("Pb", "N_kgf"), ("sigmab", "sigma_kgf_cm2")):
            if not agrees(column(table, symbol)[i], row[name]):
                wrong.append((row, column(table, symbol)[i]))
    assert not wrong


SECTION = {
    "M_reduced": "Mc",
    "y_neutral": "y0",
    "y_neutral_from_centroid": "y0c",
    "y_centroid": "yc",
    "F": "F",
    "S": "S",
    "I": "Ic",
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
    value = {name: sheet[name] / CM**2 for name in ("F_bt", "F_bc", "F_sc", "F_sk")}
    assert [f"{value[name]:.3f}" for name in ("F_bt", "F_bc", "F_sc")] == ["2.040", "1.102", "0.272"]
    assert agrees(sheet["beta"], "0.34")
    assert (round(sheet["l_b"] / CM, 12), round(sheet["l_h"] / CM, 12)) == (8.125, 16.25)
    assert not agrees(sheet["l_b"] / CM, "8.15"), "the erratum of sheet 55"
    # 8.15 leads to the same reduced area as 8.125
    assert round(0.34 * ((8.15 + 12.5) * 0.1 + 1), 2) == round(0.34 * ((8.125 + 12.5) * 0.1 + 1), 2) == 1.04
    assert abs(value["F_sk"] - 2.065) < 0.0026


def test_areas_without_the_rounding_of_the_example(sheet):
    whole = joint.app.run(defs={"g": replace(sheet["g"], d_E=0.0, d_F=0.0)})[1]
    beta = Fraction(72, 210)
    assert np.isclose(whole["F_bt"] / CM**2, float(1 + beta * Fraction("3.0625")), rtol=1e-14)
    assert np.isclose(whole["F_sc"] / CM**2, float(beta * Fraction("0.8")), rtol=1e-14)


def test_stringer_outside_the_skin_is_left_out(sheet):
    narrow = joint.app.run(defs={"g": replace(sheet["g"], psi=0.4)})[1]
    assert narrow["l_b"] < narrow["t_b"] and np.isclose(narrow["F_bt2"], (1 + 0.34 * 1.5) * CM**2)


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
    assert np.allclose(sheet["y_k"][-1], sheet["y_0"], rtol=1e-13)


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
    for _ in range(60):
        n = rng.integers(2, 9)
        y, A_t, A_c = away + rng.normal(size=n), *10 ** rng.uniform(-spread, spread, (2, n))
        M, N = rng.normal(size=2)
        true = np.array([float(f) for f in next(equilibria(y, A_t, A_c, M, N))])
        assert np.allclose(neutral_axis(y, A_t, A_c, M, N).force, true, rtol=0, atol=4e-15 * np.max(np.abs(true)))


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


EXTREME = {
    "no load": {"M_1": 0.0, "N_1": 0.0, "M_2": 0.0, "N_2": 0.0, "M_r1": 0.0, "N_r1": 0.0, "M_r2": 0.0, "N_r2": 0.0},
    "no moment": {"M_1": 0.0, "M_2": 0.0, "M_r1": 0.0, "M_r2": 0.0},
    "pulled": {"N_1": 1e8, "N_r1": 1e8},
    "pressed": {"N_1": -1e8, "N_r1": -1e8},
    "the other way": {"M_1": -5e4, "M_r1": -2e5},
    "bare": {"delta": 0.0, "F_s": 0.0, "psi": 0.0},
}


@pytest.mark.parametrize("change", [{}, *EXTREME.values()], ids=["as printed", *EXTREME])
def test_every_check_passes(sheet, change):
    names = joint.app.run(defs={"g": replace(sheet["g"], **change)})[1]
    assert len(checks(names)) == (9 if names["holds"].any() else 7), "what holds nowhere is not checked"
    assert [str(c) for c in checks(names) if not c.passed] == []
    for k in (0, 1):
        for p in (0, 1):
            assert "<svg" in names["scheme"](p, k, "h", "b").svg() and "<svg" in names["ring_scheme"](p, k).svg()


def test_document_formulas_of_the_ring_are_left_empty_where_they_do_not_hold(sheet):
    names = joint.app.run(defs={"g": replace(sheet["g"], N_r2=1e8)})[1]
    assert np.isfinite(names["P_n"][:, 0]).all() and np.isnan(names["P_n"][:, 1]).all()


def test_si_changes_the_units_and_nothing_else(sheet):
    si = joint.app.run(defs={"g": replace(sheet["g"], SI=1)})[1]
    used = set()
    for name in ("table_31", "table_32", "table_1", "table_2", "table_51", "table_52", "table_53"):
        for a, b in zip(sheet[name].columns, si[name].columns, strict=True):
            used.add(b.unit)
            one, other = (c.values * units.parse(c.unit).factor for c in (a, b))
            assert a.symbol == b.symbol and np.allclose(one, other, rtol=1e-14)
    assert used == {"-", "N", "N*m", "mm", "mm**2", "mm**3", "mm**4", "MPa", "deg", "N/mm"}
    assert not any("kgf" in c.unit for t in si.values() if isinstance(t, Table) for c in t.columns)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--h=-50"], "error: side along Y, between the beams h = -50.0 cm must be positive"),
        (
            ["--N_r1=-66400"],
            "error: ring in equilibrium exists: plane 2, case 1: no bolt in tension for M = 2000000 kgf*cm"
            " with N = -66400 kgf",
        ),
    ],
)
def test_bad_input_is_one_line_and_writes_nothing(tmp_path, arguments, message):
    done = subprocess.run(
        [sys.executable, SHEET, *arguments, f"--out={tmp_path}"], capture_output=True, encoding="utf-8"
    )
    assert (done.returncode, done.stderr.strip(), list(tmp_path.iterdir())) == (1, message, [])


def test_script_writes_the_workbook(tmp_path):
    done = subprocess.run([sys.executable, SHEET, "--SI=1", f"--out={tmp_path}"], capture_output=True, encoding="utf-8")
    assert (done.returncode, done.stderr) == (0, "")
    assert [p.name for p in tmp_path.iterdir()] == ["joint.xlsx"]
