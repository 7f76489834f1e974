"""Assur groups of kinds 1 to 3 against 50-digit positions and their differences, and by their properties."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import assume, example, given
from hypothesis import strategies as st
from moving import exact_rows, floats, path, turning
from random_groups import FAMILIES, numbers, triangles, vectors

from mechsheet.accuracy import arithmetic as exact
from mechsheet.accuracy.arithmetic import EPS
from mechsheet.mechanics.load import Load
from mechsheet.mechanics.planar import (
    angle,
    angle_opposite,
    cross,
    dot,
    link_acceleration,
    link_velocity,
    triangle_area,
)
from mechsheet.mechanics.rpr import (
    rpr,
    rpr_acceleration,
    rpr_condition,
    rpr_reach,
    rpr_transmission_angle,
    rpr_velocity,
)
from mechsheet.mechanics.rrp import (
    rrp,
    rrp_acceleration,
    rrp_condition,
    rrp_reach,
    rrp_transmission_angle,
    rrp_velocity,
)
from mechsheet.mechanics.rrr import (
    rrr,
    rrr_acceleration,
    rrr_condition,
    rrr_reach,
    rrr_reactions,
    rrr_transmission_angle,
    rrr_velocity,
)
from mechsheet.quantities.elementary import in_steps

families = pytest.mark.parametrize("family", FAMILIES)
every = pytest.mark.parametrize

# A result is a handful of products and sums over the group's determinant: each rounding counts once, through
# 1/sin(mu), and the determinant's own once more.
ROUNDINGS = 8


def within(found: Any, true: Any, bound: Any) -> None:
    """Every error is at most ROUNDINGS roundings of the bound."""
    ratio = np.abs(found - true) / (ROUNDINGS * EPS * bound)
    assert np.all(ratio <= 1), f"{np.nanmax(ratio):.3g} times the bound, element {np.nanargmax(ratio)}"


def reached(found: Any, true: Any, kappa: Any) -> Any:
    """Elements that exist; rounding alone may decide on existence, and only at a dead centre."""
    exists, closes = ~np.isnan(found), ~np.isnan(true)
    at_dead_centre = np.fmax(*kappa) > 1 / np.sqrt(ROUNDINGS * EPS)
    assert np.all((exists == closes) | at_dead_centre)
    assert np.any(exists & closes)
    return exists & closes


# --- positions -----------------------------------------------------------------------------------------------


@families
def test_rrr_position_loses_the_digits_of_its_condition_number_only(family: str) -> None:
    rng, A, B, C = triangles(family)
    r_A, r_B, branch = np.abs(C - A), np.abs(C - B), rng.choice([-1, 1], len(A))
    found = rrr(A, B, r_A, r_B, branch)
    true = floats(
        exact.rrr(A, B, r_A.real, r_B.real, branch.real)
        for A, B, r_A, r_B, branch in exact_rows(A, B, r_A, r_B, branch)
    )
    kappa = np.array([rrr_condition(A, B, found), rrr_condition(A, B, true)])
    ok = reached(found, true, kappa)
    within(found[ok], true[ok], (kappa[0] * np.minimum(r_A, r_B))[ok])


@families
def test_rrp_position_loses_the_digits_of_its_condition_number_only(family: str) -> None:
    rng, A, B, C = triangles(family)
    u = 1j * (C - B)  # the guide is square to CB, so that mu is its transmission angle
    B, offset = (B, -np.abs(B - C)) if family == "ordinary" else (C, 0.0)
    r_A, branch = np.abs(C - A), rng.choice([-1, 1], len(A))
    found = rrp(A, B, u, r_A, branch, offset)
    true = floats(
        exact.rrp(A, B, u, r.real, branch.real, e.real)
        for A, B, u, r, branch, e in exact_rows(A, B, u, r_A, branch, offset)
    )
    kappa = np.array([rrp_condition(A, B, found, u), rrp_condition(A, B, true, u)])
    ok = reached(found, true, kappa)
    within(found[ok], true[ok], (kappa[0] * r_A)[ok])


@families
def test_rpr_direction_loses_the_digits_of_its_condition_number_only(family: str) -> None:
    rng, A, B, C = triangles(family)
    offset, branch = cross((C - A) / np.abs(C - A), A - B), rng.choice([-1, 1], len(A))
    u, s = rpr(A, B, branch, offset)
    true = [exact.rpr(A, B, s.real, e.real) for A, B, s, e in exact_rows(A, B, branch, offset)]
    true_u, true_s = floats(x and x[0] for x in true), floats(x and x[1] for x in true)
    kappa = np.array([rpr_condition(A, B, u), rpr_condition(A, B, true_u)])
    ok = reached(u, true_u, kappa)
    within(u[ok], true_u[ok], kappa[0, ok])
    within(s[ok], true_s[ok], (kappa[0] * np.abs(A - B))[ok])


# --- velocities and accelerations ------------------------------------------------------------------------------
# The pins are given, so that they are exact; the speed V and the acceleration Q are what the motion of the outer
# pairs can excite at this transmission angle.


@families
@every("rigid", [True, False], ids=["rigid links", "cylinders"])
def test_rrr_velocities_and_accelerations_are_the_differences_of_positions(family: str, rigid: bool) -> None:
    rng, A, B, C = triangles(family)
    v_A, v_B, a_A, a_B = vectors(rng, 4)
    dr_A, dr_B, ddr_A, ddr_B = numbers(rng, 4) * (0 if rigid else 1)
    v = rrr_velocity(A, B, C, v_A, v_B, dr_A, dr_B)
    a = rrr_acceleration(A, B, C, v.omega_A, v.omega_B, dr_A, dr_B, a_A, a_B, ddr_A, ddr_B)

    def motion(A, B, C, v_A, v_B, a_A, a_B, dr_A, dr_B, ddr_A, ddr_B):
        pin_A, pin_B = cache(path(A, v_A, a_A)), cache(path(B, v_B, a_B))
        r_A, r_B = path(abs(C - A), dr_A, ddr_A), path(abs(C - B), dr_B, ddr_B)
        branch = exact.mp.sign(exact.cross(B - A, C - A))
        pin_C = cache(lambda t: exact.rrr(pin_A(t), pin_B(t), r_A(t).real, r_B(t).real, branch))
        link_A, link_B = (exact.rotation(lambda t, pin=pin: pin_C(t) - pin(t)) for pin in (pin_A, pin_B))
        return exact.derivatives(pin_C), link_A, link_B

    true = [motion(*x) for x in exact_rows(A, B, C, v_A, v_B, a_A, a_B, dr_A, dr_B, ddr_A, ddr_B)]
    r_A, r_B = np.abs(C - A), np.abs(C - B)
    s = np.abs(cross(C - A, C - B)) / (r_A * r_B)
    dr = np.abs(dr_A) + np.abs(dr_B)
    V = (np.abs(v_A) + np.abs(v_B) + dr) / s
    Q = (np.abs(a_A) + np.abs(a_B) + np.abs(ddr_A) + np.abs(ddr_B) + (V + dr) * V / np.minimum(r_A, r_B)) / s
    for i, (found, size) in enumerate(zip(v, (1, r_A, r_B), strict=True)):
        within(found, floats(x[i][0] for x in true), V / s / size)
    for i, (found, size) in enumerate(zip(a, (1, r_A, r_B), strict=True)):
        within(found, floats(x[i][1] for x in true), Q / s / size)


@families
def test_rrp_velocities_and_accelerations_are_the_differences_of_positions_on_a_moving_guide(family: str) -> None:
    rng, A, B, C = triangles(family)
    u = 1j * (C - B)
    u /= np.abs(u)
    v_A, v_B, a_A, a_B = vectors(rng, 4)
    omega_B, epsilon_B, dr_A, ddr_A = numbers(rng, 4)
    v = rrp_velocity(A, B, C, u, v_A, v_B, omega_B, dr_A)
    a = rrp_acceleration(A, B, C, u, v.omega_A, v.ds, omega_B, dr_A, a_A, a_B, epsilon_B, ddr_A)

    def motion(A, B, C, u, v_A, v_B, a_A, a_B, omega_B, epsilon_B, dr_A, ddr_A):
        pin_A, pin_B = cache(path(A, v_A, a_A)), cache(path(B, v_B, a_B))
        guide, r = cache(turning(u, omega_B, epsilon_B)), path(abs(C - A), dr_A, ddr_A)
        offset, branch = exact.cross(u, C - B) / abs(u), exact.mp.sign(exact.dot(u, C - A))
        pin_C = cache(lambda t: exact.rrp(pin_A(t), pin_B(t), guide(t), r(t).real, branch, offset))
        slide = exact.derivatives(lambda t: exact.dot(guide(t), pin_C(t) - pin_B(t)))
        return exact.derivatives(pin_C), exact.rotation(lambda t: pin_C(t) - pin_A(t)), slide

    true = [motion(*x) for x in exact_rows(A, B, C, u, v_A, v_B, a_A, a_B, omega_B, epsilon_B, dr_A, ddr_A)]
    r, arm = np.abs(C - A), np.abs(C - B)
    s = np.abs(dot(C - A, u)) / r
    V = (np.abs(v_A) + np.abs(v_B) + np.abs(omega_B) * arm + np.abs(dr_A)) / s
    Q = np.abs(a_A) + np.abs(a_B) + np.abs(ddr_A) + (np.abs(epsilon_B) + omega_B**2) * arm
    Q = (Q + 2 * np.abs(omega_B) * V + (V + np.abs(dr_A)) * V / r) / s
    for i, (found, size) in enumerate(zip(v, (1, r, 1), strict=True)):
        within(found, floats(x[i][0] for x in true), V / s / size)
    for i, (found, size) in enumerate(zip(a, (1, r, 1), strict=True)):
        within(found, floats(x[i][1] for x in true), Q / s / size)


@families
def test_rpr_velocities_and_accelerations_are_the_differences_of_positions(family: str) -> None:
    rng, A, B, C = triangles(family)
    u = 1j * (C - A) / np.abs(C - A)  # mu is the angle between BA and the slide's normal where CB is short
    v_A, v_B, a_A, a_B = vectors(rng, 4)
    v = rpr_velocity(A, B, u, v_A, v_B)
    a = rpr_acceleration(A, B, u, v.omega_A, v.ds, a_A, a_B)

    def motion(A, B, u, v_A, v_B, a_A, a_B):
        pin_A, pin_B = cache(path(A, v_A, a_A)), cache(path(B, v_B, a_B))
        slide = (A - B) / u * abs(u)
        group = cache(lambda t: exact.rpr(pin_A(t), pin_B(t), exact.mp.sign(slide.real), slide.imag))
        return exact.rotation(lambda t: group(t)[0]), exact.derivatives(lambda t: group(t)[1])

    true = [motion(*x) for x in exact_rows(A, B, u, v_A, v_B, a_A, a_B)]
    L = np.abs(A - B)
    s = np.abs(dot(A - B, u)) / L
    V = (np.abs(v_A) + np.abs(v_B)) / s
    Q = (np.abs(a_A) + np.abs(a_B) + V**2 / L) / s
    for i, (found, size) in enumerate(zip(v, (L, 1), strict=True)):
        within(found, floats(x[i][0] for x in true), V / s / size)
    for i, (found, size) in enumerate(zip(a, (L, 1), strict=True)):
        within(found, floats(x[i][1] for x in true), Q / s / size)


@families
def test_a_chain_from_lengths_to_accelerations_loses_twice_the_digits_of_its_condition_number(family: str) -> None:
    rng, A, B, C = triangles(family)
    r_A, r_B = np.abs(C - A), np.abs(C - B)
    branch = np.sign(cross(B - A, C - A))
    C = rrr(A, B, r_A, r_B, branch)
    ok = rrr_condition(A, B, C) < 1e7
    A, B, C, r_A, r_B, branch = (x[ok] for x in (A, B, C, r_A, r_B, branch))
    v_A, v_B, a_A, a_B = vectors(rng, 4)[:, ok]
    v = rrr_velocity(A, B, C, v_A, v_B)
    a = rrr_acceleration(A, B, C, v.omega_A, v.omega_B, a_A=a_A, a_B=a_B)

    def motion(A, B, r_A, r_B, branch, v_A, v_B, a_A, a_B):
        pin_A, pin_B = cache(path(A, v_A, a_A)), cache(path(B, v_B, a_B))
        return exact.derivatives(lambda t: exact.rrr(pin_A(t), pin_B(t), r_A.real, r_B.real, branch.real))

    true = [motion(*x) for x in exact_rows(A, B, r_A, r_B, branch, v_A, v_B, a_A, a_B)]
    kappa, s = rrr_condition(A, B, C), np.sin(rrr_transmission_angle(A, B, C))
    V = (np.abs(v_A) + np.abs(v_B)) / s
    Q = (np.abs(a_A) + np.abs(a_B) + V**2 / np.minimum(r_A, r_B)) / s
    within(v.v_C, floats(x[0] for x in true), kappa**2 * V)
    within(a.a_C, floats(x[1] for x in true), kappa**2 * Q)


# --- how near a dead centre --------------------------------------------------------------------------------------


@families
def test_transmission_angle_keeps_its_digits_near_a_dead_centre(family: str) -> None:
    _, A, B, C = triangles(family)
    pairs = [(z - x, z - y) for x, y, z in exact_rows(A, B, C)]
    true = floats(abs(exact.mp.arg(b / a)) for a, b in pairs).real
    for found in (
        rrr_transmission_angle(A, B, C),
        rrp_transmission_angle(A, C, 1j * (B - C)),
        rpr_transmission_angle(A, C, 1j * (C - B)),
    ):
        within(found, true, 1)


def test_condition_grows_towards_a_dead_centre_and_is_infinite_in_it() -> None:
    B = np.exp(1j * np.array([1, 0.1, 1e-4, 0]))
    for kappa in (rrr_condition(1, B, 0), rrp_condition(1, 0, 0, 1j * B), rpr_condition(1, 0, 1j * B)):
        assert np.all(np.diff(kappa) > 0)
        assert kappa[-1] == np.inf


# --- reach: impossible elements are NaN, alone -----------------------------------------------------------------

lengths = st.floats(1e-6, 1e6)
coordinates = st.floats(-1e6, 1e6).map(lambda x: round(x, 6))
points = st.builds(complex, coordinates, coordinates)


@given(points, points, lengths, st.sampled_from([-1, 1]))
@example(0, 3, 1, 1)
@example(0, 0.3, 0.1, -1)
def test_rrr_closes_at_both_ends_of_its_reach_and_nowhere_outside(A: complex, B: complex, r: float, s: int) -> None:
    low, high = rrr_reach(A, B, r)
    assert np.all(np.isfinite(rrr(A, B, r, [low, high], s)) == (A != B))
    assert np.all(np.isfinite(rrr(B, A, [low, high], r, s)) == (A != B))
    beyond = 6 * np.spacing(high + abs(A) + abs(B))  # of the longest, of the pins and of the ends
    assert np.isnan(rrr(A, B, r, high + beyond, s))
    assert low <= beyond or np.isnan(rrr(A, B, r, low - beyond, s))


def test_links_of_whole_millimetres_in_one_line_close() -> None:
    """0.1 and 0.7 are less than 0.8 as a computer has them: an eleventh of such dead centres had no position."""
    r_A, r_B = np.meshgrid(np.arange(1, 1000), np.arange(1, 1000)) / np.float64(1000)
    L = np.round(r_A + r_B, 3)
    assert np.mean(r_A + r_B < L) > 0.01
    shortest = np.minimum(r_A, r_B)
    for C in (rrr(0, L, r_A, r_B, 1), rrr(0, r_A, L, r_B, -1), rrr(r_B, 0, r_A, L, 1)):
        assert np.all(np.abs(C.imag) <= 8e-8 * L**2 / shortest)
    for a, b, c in ((L, r_A, r_B), (r_A, L, r_B), (r_A, r_B, L)):
        assert np.all(np.abs(np.sin(angle_opposite(a, b, c))) <= 8e-8 * L / shortest)
        assert np.all(triangle_area(a, b, c) <= 8e-8 * L**2)


@every("turn", [90, 0.001])  # degrees: level and upright, or anyhow
@every("far", [0, 1, 30, 1000])
@every("how", [lambda f: f, in_steps])
def test_groups_in_a_dead_centre_close_wherever_their_pins_are(how, far, turn) -> None:
    """What is taken from coordinates has their rounding: metres from the origin, up to half of these had no position.

    Neither had they on pages and in cells, where they are computed in steps.
    """
    rng, count = np.random.default_rng(4), 10_000
    r_A, r_B, x, y = np.round(rng.uniform([[0.05], [0.05], [-1], [-1]], 1, (4, count)), 3)
    A = far * (1 - 2j) + x + 1j * y
    u = np.exp(1j * np.deg2rad(turn * rng.integers(0, 360_000, count)))
    size = 4 * np.sqrt(EPS * (np.abs(A) + 2))
    for L in (r_A + r_B, np.where(r_A == r_B, 2 * r_A, r_A - r_B)):
        C = how(rrr)(A, A + L * u, r_A, r_B, 1)
        assert np.all(np.abs(L) * np.abs(C - A - r_A * u) < size)
    C = how(rrp)(A, A + r_B * u - r_A * 1j * u, u, r_A, -1)
    assert np.all(np.abs(C - A + r_A * 1j * u) < size)
    for e in (r_A, -r_A):
        along, s = how(rpr)(A + r_A * u, A, 1, e)
        assert np.all(np.abs(along * 1j * np.sign(e) - u) < size / r_A)
        assert np.all(s < size)


@given(points, points, points.filter(bool), coordinates, st.sampled_from([-1, 1]))
def test_rrp_closes_from_the_shortest_link_on(A: complex, B: complex, u: complex, e: float, s: int) -> None:
    low, _ = rrp_reach(A, B, u, e)
    assert np.isfinite(rrp(A, B, u, low, s, e))
    beyond = 6 * np.spacing(low + abs(A) + abs(B) + abs(e))
    assert low <= beyond or np.isnan(rrp(A, B, u, low - beyond, s, e))


@given(points, points, st.sampled_from([-1, 1]))
def test_rpr_closes_to_the_greatest_offset(A: complex, B: complex, s: int) -> None:
    assume(A != B)
    _, high = rpr_reach(A, B)
    for offset in (high, -high):
        u, along = rpr(A, B, s, offset)
        assert abs(along) <= 2e-8 * high
        assert abs(abs(u) - 1) <= 8 * EPS
    assert np.isnan(rpr(A, B, s, high + 6 * np.spacing(high + abs(A) + abs(B))).s)


@given(st.lists(st.tuples(points, points, lengths, lengths), min_size=1, max_size=8), st.sampled_from([-1, 1]))
def test_rrr_links_keep_their_lengths_and_the_branch_its_side(rows: Any, branch: int) -> None:
    A, B, r_A, r_B = (np.array(column) for column in zip(*rows, strict=True))
    C = rrr(A, B, r_A, r_B, branch)
    rounding = 8 * EPS * (np.abs(A) + np.abs(B) + r_A + r_B)
    ok = np.isfinite(C)
    assert np.all(np.abs(np.abs(C - A) - r_A)[ok] <= rounding[ok])
    assert np.all(np.abs(np.abs(C - B) - r_B)[ok] <= rounding[ok])
    assert np.all((branch * cross(B - A, C - A) / np.abs(B - A))[ok] >= -rounding[ok])


def test_an_unreachable_position_is_nan_alone_and_passes_through_the_groups_behind_it() -> None:
    C = rrr(0, [3, 9, 4], 2, 2, 1)
    v = rrr_velocity(0, [3, 9, 4], C, 1j, [2, 2, 2])
    a = rrr_acceleration(0, [3, 9, 4], C, v.omega_A, v.omega_B)
    D = rrp(C, -1j, 1, 4, 1)
    w = rrp_velocity(C, -1j, D, 1, v.v_C)
    s = rpr(C, 5, 1)
    for reached_position in (C, D, s.u):
        assert np.array_equal(np.isnan(reached_position), [False, True, False])
    for derivative in (*v, *a, *w, *rpr_velocity(C, 5, s.u, v.v_C)):  # the third position is a dead centre
        assert np.array_equal(np.isnan(derivative), [False, True, True])


def test_a_length_that_a_variant_does_not_have_leaves_nan_there_alone() -> None:
    lengths = np.array([[5.0], [np.nan], [4.0]])
    for found in (rrr(0, 6, lengths, 5, 1), rrr(0, 6, [5, 5], lengths, 1), rrp(0, 1j, 1, lengths, 1)):
        assert np.array_equal(np.isnan(found).all(1), [False, True, False])
        assert np.array_equal(np.isnan(found).any(1), [False, True, False])
    assert np.isnan(rrr_reach(0, 6, lengths)[1]).tolist() == [[False], [True], [False]]


@every(
    "f",
    [
        lambda x: rrr(x, 3 + 1j, 2.1, 1.9, -1),
        lambda x: rrp(x, 1j, 2 + 1j, 3.3, 1, 0.1),
        lambda x: rrr_reactions(x, 3 + 1j, 1 - 2j, [Load(3 - 1j, 2j, 0.3)], [Load(1j, x)]).R_A,
    ],
)
def test_one_number_alone_gives_the_same_as_among_others_to_the_last_bit(f) -> None:
    rng = np.random.default_rng(1)
    many = rng.uniform(-1, 1, 51) + 1j * rng.uniform(-1, 1, 51)
    one_by_one = np.array([f(complex(x)) for x in many])

    assert np.isfinite(one_by_one).sum() > 20
    assert np.array_equal(f(many), one_by_one, equal_nan=True)
    assert np.array_equal(f(many[:, None])[:, 0], one_by_one, equal_nan=True)
    assert np.array_equal(f(np.repeat(many, 3)[::3]), one_by_one, equal_nan=True)


@pytest.mark.parametrize(("B", "r_A", "abscissa"), [(1, 1e-6, 5e-13), (1e-6, 1, 5e-7), (1e-6, 1e6, 5e-7)])
def test_isosceles_needle_keeps_digits_that_squares_of_its_sides_have_not(
    B: float, r_A: float, abscissa: float
) -> None:
    """C lies above the middle of the short side, or at r_A^2/2L; r_B is the longer of L and r_A."""
    assert rrr(0, B, r_A, max(B, r_A), 1).real == pytest.approx(abscissa, rel=1e-15, abs=0)


def test_a_link_hardly_longer_than_its_way_to_the_guide_keeps_digits_that_squares_have_not() -> None:
    excess = 2.0**-40
    ahead = np.sqrt(excess * (2 + excess))
    assert rrp(1j, 0, 1, 1 + excess, 1).real == pytest.approx(ahead, rel=1e-15, abs=0)
    assert rpr(1 + excess, 0, 1, 1).s == pytest.approx(ahead, rel=1e-15, abs=0)


def test_coincident_outer_pins_leave_the_dyad_undetermined() -> None:
    assert np.isnan(rrr(1j, 1j, 2, 2, 1))
    assert np.isnan(rpr(1j, 1j, 1).u)


# --- arguments -------------------------------------------------------------------------------------------------


@every(
    ("call", "message"),
    [
        (lambda: rrr(0, 3, -0.48, 2, 1), "length r_A = -0.48 m must not be negative"),
        (lambda: rrr(0, 3, [2, 1], [2, -1e-9], 1), "length r_B = -1e-09 m must not be negative"),
        (lambda: rrr(0, 3, np.nan, 2, 1), "length r_A = nan m must be a finite number"),
        (lambda: rrr(0, 3, 2, np.inf, 1), "length r_B = inf m must be a finite number"),
        (lambda: rrr(0, [3, np.inf], 2, 2, 1), r"B = \(inf\+0j\) must be finite"),
        (lambda: rrr(0, 3, 2, 2, 0), r"branch = 0 must be \+1 or -1"),
        (lambda: rrr(0, 3, 2, 2, [1, 2]), r"branch = 2 must be \+1 or -1"),
        (lambda: rrr(0, 3, 2, 2, True), "branch = True must be real numbers"),
        (lambda: rrr(0, 3, 2 + 1j, 2, 1), r"length r_A = \(2\+1j\) must be real numbers"),
        (lambda: rrr("0", 3, 2, 2, 1), "A = '0' must be numbers"),
        (lambda: rrr(0, [3, 4], [1, 2, 3], 2, 1), r"shapes do not broadcast: B \(2,\), r_A \(3,\)"),
        (lambda: rrr(0, [[3], [4, 5]], 1, 2, 1), "B must be an array with rows of equal length"),
        (lambda: rrr_reach(0, 3, -1), "length r_A = -1 m must not be negative"),
        (lambda: rrr_velocity(0, 3, 1j, np.inf, 0), r"v_A = \(inf\+0j\) must be finite"),
        (lambda: rrr_velocity(0, 3, 1j, 1, 0, dr_A=np.inf), "dr_A = inf must be finite"),
        (lambda: rrp(0, 3, 0, 2, 1), "direction u = 0 must not be zero"),
        (lambda: rrp(0, 3, 1, 2, 1, np.nan), "offset = nan m must be a finite number"),
        (lambda: rpr(0, 3, 1, np.inf), "offset = inf m must be a finite number"),
        (lambda: rpr_velocity(0, 3, [1, 0], 2), "direction u = 0 must not be zero"),
    ],
)
def test_a_bad_argument_is_named_with_its_value(call: Any, message: str) -> None:
    with pytest.raises(ValueError, match=f"^{message}"):
        call()


def test_everything_broadcasts_positions_against_variants_and_branches() -> None:
    phi, r_B, branch = np.linspace(0, 6, 5), np.array([[2.0], [2.5], [3.0]]), np.array([1, -1])[:, None, None]
    C = rrr(np.exp(1j * phi), 3, 2, r_B, branch)
    assert C.shape == (2, 3, 5)
    assert C[1, 2, 3] == pytest.approx(complex(rrr(np.exp(1j * phi[3]), 3, 2, 3.0, -1)), rel=1e-15)
    v = rrr_velocity(np.exp(1j * phi), 3, C, 1j, 0, dr_B=np.zeros((4, 1, 1, 1)))
    assert v.omega_B.shape == (4, 2, 3, 5)


def test_an_empty_field_gives_an_empty_field() -> None:
    assert rrr(np.array([], complex), 3, 2, 2, 1).shape == (0,)


# --- the sources -----------------------------------------------------------------------------------------------


def test_landing_gear_analogues_follow_20_21_25_and_24_with_a_minus() -> None:
    """The leg O2-A of length l3 driven by the cylinder O1-A of length l2, derivatives with respect to l2."""
    O1, O2, l3 = 0, -0.6 + 1.1j, 0.5
    l2 = np.linspace(*rrr_reach(O2, O1, l3), 9)[1:-1]
    A = rrr(O1, O2, l2, l3, 1)
    v = rrr_velocity(O1, O2, A, dr_A=1)
    a = rrr_acceleration(O1, O2, A, v.omega_A, v.omega_B, dr_A=1)
    phi = np.angle((A - O2) / (A - O1))  # phi3 - phi2 with both vectors towards A
    # the source's l3 runs from A to O2: its phi3 is ours plus pi
    phi = phi + np.pi
    w3 = 1 / (l3 * np.sin(phi))
    w2 = -l3 * w3 * np.cos(phi) / l2
    e3 = -(l2 * w2**2 + l3 * w3**2 * np.cos(phi)) / (l3 * np.sin(phi))
    e2 = (l3 * w3**2 * np.sin(phi) - l3 * e3 * np.cos(phi) - 2 * w2) / l2
    for found, printed in ((v.omega_B, w3), (v.omega_A, w2), (a.epsilon_B, e3), (a.epsilon_A, e2)):
        assert found == pytest.approx(printed, rel=1e-12)


def test_slotted_link_table_is_reproduced_to_half_the_last_printed_digit() -> None:
    """Page 39: L1 = 0.8, L0 = 2.4, L3 = 3.5; omega1 = -10, as the angles fall from 360 degrees."""
    table = np.genfromtxt(Path(__file__).parent / "reference/slotted_link/table_results.csv", delimiter=",", names=True)
    A, omega = 0.8 * np.exp(1j * np.radians(table["phi1_deg"])), -10
    B = -2.4j
    u, s = rpr(A, B, 1)
    v = rpr_velocity(A, B, u, link_velocity(A, 0, omega))
    a = rpr_acceleration(A, B, u, v.omega_A, v.ds, link_acceleration(A, 0, omega))
    C = B + 3.5 * u
    found = {
        "phi3_deg": np.degrees(angle(u)),
        "AB": s,
        "omega_BC": v.omega_A,
        "eps_BC": a.epsilon_A,
        "VC": np.abs(link_velocity(C, B, v.omega_A)),
        "WC": np.abs(link_acceleration(C, B, v.omega_A, a.epsilon_A)),
    }
    for name, column in found.items():
        assert np.all(np.abs(column - table[name]) <= 0.5e-3), name
