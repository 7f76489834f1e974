"""Assur groups of kinds 4 and 5 against 50-digit positions and their differences."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import settings
from moving import exact_rows, floats, path, turning
from random_groups import FAMILIES, numbers, triangles, vectors

from mechsheet.accuracy import arithmetic as exact
from mechsheet.accuracy.arithmetic import EPS
from mechsheet.mechanics.planar import cross
from mechsheet.mechanics.prp import (
    PRPGroup,
    prp,
    prp_acceleration,
    prp_condition,
    prp_transmission_angle,
    prp_velocity,
)
from mechsheet.mechanics.rpp import (
    RPPGroup,
    rpp,
    rpp_acceleration,
    rpp_condition,
    rpp_transmission_angle,
    rpp_velocity,
)

families = pytest.mark.parametrize("family", FAMILIES)
ROUNDINGS = 8  # as in test_dyads
EVERY = 200 // settings.default.max_examples or 1  # one of so many random groups moves, all of them in a search


def some(*arrays: Any) -> list[Any]:
    """Those that move: their exact differences take all the time."""
    return [x[..., ::EVERY] for x in arrays]


def within(found: Any, true: Any, bound: Any) -> None:
    """Every error is at most ROUNDINGS roundings of the bound."""
    ratio = np.abs(found - true) / (ROUNDINGS * EPS * bound)
    assert np.all(ratio <= 1), f"{np.nanmax(ratio):.3g} times the bound, element {np.nanargmax(ratio)}"


@families
@pytest.mark.parametrize(("group", "condition"), [(prp, prp_condition), (rpp, rpp_condition)])
def test_position_loses_the_digits_of_its_condition_number_only(family: str, group: Any, condition: Any) -> None:
    _, A, B, C = triangles(family)
    u_A, u_B = C - A, C - B
    true = floats(exact.lines(*x) for x in exact_rows(A, B, u_A, u_B))
    within(group(A, B, u_A, u_B), true, condition(u_A, u_B) * (np.abs(A) + np.abs(B)))


@pytest.mark.parametrize("kind", [PRPGroup, RPPGroup])
def test_two_lines_close_however_far_one_is_displaced_unless_they_are_parallel(kind: Any) -> None:
    _, A, B, C = triangles("ordinary")
    u_A, u_B = C - A, np.where(np.arange(A.size) % 2, C - B, A - C)  # every other pair is parallel
    closes = np.arange(A.size) % 2 == 1
    group = kind(A, B, u_A, u_B)
    least, greatest = group.reach
    assert np.array_equal(greatest == np.inf, closes) and np.array_equal(least == -np.inf, closes)
    assert np.array_equal(np.isnan(greatest), ~closes) and np.array_equal(np.isnan(least), ~closes)
    for offset in (0, *np.logspace(-6, 100, 5), *-np.logspace(-6, 100, 5)):
        for moved in (kind(A + 1j * u_A * offset, B, u_A, u_B), kind(A, B + 1j * u_B * offset, u_A, u_B)):
            assert np.array_equal(np.isfinite(moved.C), closes)


@families
def test_prp_velocities_and_accelerations_are_the_differences_of_positions_on_moving_guides(family: str) -> None:
    rng, *groups = triangles(family)
    A, B, C = some(*groups)
    u_A, u_B = (C - A) / np.abs(C - A), (C - B) / np.abs(C - B)
    C = prp(A, B, u_A, u_B)
    v_A, v_B, a_A, a_B = some(*vectors(rng, 4))
    omega_A, omega_B, epsilon_A, epsilon_B = some(*numbers(rng, 4))
    v = prp_velocity(A, B, C, u_A, u_B, v_A, v_B, omega_A, omega_B)
    a = prp_acceleration(A, B, C, u_A, u_B, v.ds_A, v.ds_B, omega_A, omega_B, a_A, a_B, epsilon_A, epsilon_B)

    def motion(A, B, u_A, u_B, v_A, v_B, a_A, a_B, omega_A, omega_B, epsilon_A, epsilon_B):
        pin_A, pin_B = path(A, v_A, a_A), path(B, v_B, a_B)
        guide_A, guide_B = turning(u_A, omega_A, epsilon_A), turning(u_B, omega_B, epsilon_B)
        pin_C = lambda t: exact.lines(pin_A(t), pin_B(t), guide_A(t), guide_B(t))  # noqa: E731
        slide_A = exact.derivatives(lambda t: exact.dot(guide_A(t), pin_C(t) - pin_A(t)))
        slide_B = exact.derivatives(lambda t: exact.dot(guide_B(t), pin_C(t) - pin_B(t)))
        return exact.derivatives(pin_C), slide_A, slide_B

    true = [motion(*x) for x in exact_rows(A, B, u_A, u_B, v_A, v_B, a_A, a_B, omega_A, omega_B, epsilon_A, epsilon_B)]
    s = np.abs(cross(u_A, u_B))
    # C is rounded: its error, EPS (|A| + |B|)/s, counts in place of the arms where these are shorter
    arm_A, arm_B = np.abs(C - A) + (np.abs(A) + np.abs(B)) / s, np.abs(C - B) + (np.abs(A) + np.abs(B)) / s
    V = (np.abs(v_A) + np.abs(v_B) + np.abs(omega_A) * arm_A + np.abs(omega_B) * arm_B) / s
    Q = np.abs(a_A) + np.abs(a_B) + (omega_A**2 + np.abs(epsilon_A)) * arm_A + (omega_B**2 + np.abs(epsilon_B)) * arm_B
    Q = (Q + 2 * (np.abs(omega_A) + np.abs(omega_B)) * V) / s
    for i, found in enumerate(v):
        within(found, floats(x[i][0] for x in true), V / s)
    for i, found in enumerate(a):
        within(found, floats(x[i][1] for x in true), Q / s)


@families
def test_rpp_velocities_and_accelerations_are_the_differences_of_positions_on_a_moving_guide(family: str) -> None:
    rng, *groups = triangles(family)
    A, B, C = some(*groups)
    u_A, u_B = (C - A) / np.abs(C - A), (C - B) / np.abs(C - B)
    C = rpp(A, B, u_A, u_B)
    v_A, v_B, a_A, a_B = some(*vectors(rng, 4))
    omega, epsilon = some(*numbers(rng, 2))
    v = rpp_velocity(A, B, C, u_A, u_B, v_A, v_B, omega)
    a = rpp_acceleration(A, B, C, u_A, u_B, v.ds_A, v.ds_B, omega, a_A, a_B, epsilon)

    def motion(A, B, u_A, u_B, v_A, v_B, a_A, a_B, omega, epsilon):
        pin_A, pin_B = path(A, v_A, a_A), path(B, v_B, a_B)
        slot, guide = turning(u_A, omega, epsilon), turning(u_B, omega, epsilon)
        pin_C = lambda t: exact.lines(pin_A(t), pin_B(t), slot(t), guide(t))  # noqa: E731
        slide_A = exact.derivatives(lambda t: exact.dot(slot(t), pin_A(t) - pin_C(t)))
        slide_B = exact.derivatives(lambda t: exact.dot(guide(t), pin_C(t) - pin_B(t)))
        return exact.derivatives(pin_C), slide_A, slide_B

    true = [motion(*x) for x in exact_rows(A, B, u_A, u_B, v_A, v_B, a_A, a_B, omega, epsilon)]
    s = np.abs(cross(u_A, u_B))
    arm = np.abs(A - B) + np.abs(C - B) + (np.abs(A) + np.abs(B)) / s
    V = (np.abs(v_A) + np.abs(v_B) + np.abs(omega) * arm) / s
    Q = (np.abs(a_A) + np.abs(a_B) + (omega**2 + np.abs(epsilon)) * arm + 2 * np.abs(omega) * V) / s
    for i, found in enumerate(v):
        within(found, floats(x[i][0] for x in true), V / s)
    for i, found in enumerate(a):
        within(found, floats(x[i][1] for x in true), Q / s)


def test_scotch_yoke_moves_as_the_cosine_of_the_crank_angle() -> None:
    phi = np.linspace(0, 6, 13)
    A = 0.3 * np.exp(1j * phi)
    C = rpp(A, 0, 1j, 1)
    v = rpp_velocity(A, 0, C, 1j, 1, 1j * A)
    a = rpp_acceleration(A, 0, C, 1j, 1, v.ds_A, v.ds_B, a_A=-A)
    for found, true in ((C, np.cos(phi)), (v.ds_B, -np.sin(phi)), (a.dds_B, -np.cos(phi))):
        assert found == pytest.approx(0.3 * true, abs=1e-16)


def test_parallel_guides_are_a_dead_centre_nan_alone() -> None:
    u_B = np.array([1j, 2, -1])
    C = prp(0, 1 + 1j, 1, u_B)
    assert np.array_equal(np.isnan(C), [False, True, True])
    for group in (prp_velocity(0, 1j, 0, 1, u_B), rpp_velocity(0, 1j, 0, 1, u_B, 1)):
        for derivative in group:
            assert np.array_equal(np.isnan(derivative), [False, True, True])
    for condition in (prp_condition, rpp_condition):
        assert np.array_equal(condition(1, u_B), [1, np.inf, np.inf])
    for transmission_angle in (prp_transmission_angle, rpp_transmission_angle):
        assert np.array_equal(transmission_angle(1, u_B), [np.pi / 2, 0, np.pi])


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: prp(0, 1, 0, 1j), "direction u_A = 0 must not be zero"),
        (lambda: rpp(0, 1, 1, [1j, 0]), "direction u_B = 0 must not be zero"),
        (lambda: prp_velocity(0, 1, 1, 1, 1j, omega_A=np.inf), "omega_A = inf must be finite"),
        (lambda: rpp_velocity(0, 1, 1, [1, 1], [1j, 1j, 1j], 0), r"shapes do not broadcast: u_A \(2,\), u_B \(3,\)"),
    ],
)
def test_a_bad_argument_is_named_with_its_value(call: Any, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        call()
