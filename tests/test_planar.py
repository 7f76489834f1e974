"""Products, angles, triangles and points of a link."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from conftest import examples
from hypothesis import assume, example, given
from hypothesis import strategies as st
from mpmath import acos, mp, mpf, sqrt

from mechsheet.accuracy import arithmetic as exact
from mechsheet.accuracy.arithmetic import EPS
from mechsheet.mechanics.joint import sum_of_elements
from mechsheet.mechanics.planar import (
    angle,
    angle_between,
    angle_opposite,
    cross,
    dot,
    link_acceleration,
    link_point,
    link_velocity,
    product,
    triangle_area,
)

sides = st.floats(1e-6, 1e6)
numbers = st.floats(-1e6, 1e6).map(lambda x: round(x, 6))
vectors = st.builds(complex, numbers, numbers)


@given(vectors, st.floats(-1e6, 1e6))
def test_cross_of_a_vector_with_itself_or_its_opposite_is_exactly_zero(z: complex, real: float) -> None:
    field = np.full(64, z)  # long enough for vector instructions, whose fused products would leave a rest
    assert not np.any(cross(field, field))
    assert not np.any(cross(field, -2 * field))
    assert cross(1, real) == 0


@given(vectors, vectors)
def test_cross_and_dot_are_the_two_parts_of_one_product(a: complex, b: complex) -> None:
    rounding = 4 * EPS * abs(a) * abs(b)
    true = exact.mp.conj(a) * exact.mpc(b)
    assert abs(cross(a, b) - float(true.imag)) <= rounding
    assert abs(dot(a, b) - float(true.real)) <= rounding


def test_angle_of_the_negative_axis_is_plus_pi_whatever_the_sign_of_zero() -> None:
    assert np.all(angle(np.array([complex(-1, 0.0), complex(-1, -0.0)])) == np.pi)


def test_angle_holds_in_all_quadrants() -> None:
    phi = np.linspace(-np.pi, np.pi, 9)[1:]
    assert angle(3 * np.exp(1j * phi)) == pytest.approx(phi, rel=1e-15)


@given(st.floats(1e-300, 3.14), vectors.filter(lambda z: abs(z) > 1e-3))
def test_angle_between_keeps_the_digits_of_small_angles(phi: float, z: complex) -> None:
    a = complex(1, 0)
    b = complex(mp.cos(phi), mp.sin(phi))
    true = float(abs(mp.arg(exact.mpc(b))))
    assert abs(angle_between(a, b) - true) <= 4 * EPS * true
    assert abs(angle_between(b, a) - true) <= 4 * EPS * true


def exact_angle(a: mpf, b: mpf, c: mpf) -> mpf:
    return acos((b**2 + c**2 - a**2) / (2 * b * c))


@examples(40)
@given(st.lists(st.tuples(sides, sides, st.floats(0, 1), st.floats(-15, 0)), min_size=1, max_size=20))
@example([(1.0, 1.0, 0.0, -15.0), (1.0, 1.0, 1.0, -15.0), (1e6, 1e-6, 0.5, 0.0)])
def test_angles_and_areas_keep_all_digits_of_needle_shaped_triangles(rows: Any) -> None:
    """The side a runs from one end of its interval to the other, and within 1e-15 of both."""
    b, c, where, near = (np.array(column) for column in zip(*rows, strict=True))
    low, high = np.abs(b - c), b + c
    a = np.where(where < 0.5, low + (high - low) * 10**near / 2, high - (high - low) * 10**near / 2)
    found, area = angle_opposite(a, b, c), triangle_area(a, b, c)
    for i, (x, y, z) in enumerate(zip(a.tolist(), b.tolist(), c.tolist(), strict=True)):
        x, y, z = mpf(x), mpf(y), mpf(z)
        square = (x + y + z) * (y + z - x) * (x + z - y) * (x + y - z) / 16
        if square >= 0:
            true = float(exact_angle(x, y, z))
            assert abs(found[i] - true) <= 8 * EPS * true
            assert abs(area[i] - float(sqrt(square))) <= 8 * EPS * float(sqrt(square))


@given(sides, sides)
@example(0.1, 0.2)
def test_a_side_equal_to_the_rounded_sum_or_difference_of_the_others_makes_a_flat_triangle(b: float, c: float) -> None:
    rounding = np.sqrt(EPS * b * c) * (b + c)  # one rounding of the longest side
    assert np.pi - angle_opposite(b + c, b, c) <= 4 * rounding / (b * c)
    assert triangle_area(b + c, b, c) <= rounding
    assume(b != c)
    assert np.isfinite(angle_opposite(abs(b - c), b, c))
    assert np.isfinite(triangle_area(b, abs(b - c), c))


def test_an_impossible_triangle_is_nan_alone() -> None:
    found = angle_opposite([1, 3, 5, np.nan], 2, [2, 2, 2, 2])
    assert np.array_equal(np.isnan(found), [False, False, True, True])
    assert np.array_equal(np.isnan(triangle_area([1, 3, 5, np.nan], 2, 2)), [False, False, True, True])
    assert np.isnan(angle_opposite(1, 1, 0))


@pytest.mark.parametrize(
    ("sides", "message"),
    [
        ((-1, 2, 2), "side a = -1 m must not be negative"),
        ((1, [2, -3], 2), "side b = -3 m must not be negative"),
        ((1, 2, np.inf), "c = inf must be finite"),
        (([1, 2], [1, 2, 3], 2), r"shapes do not broadcast: a \(2,\), b \(3,\)"),
    ],
)
def test_a_bad_side_is_named_with_its_value(sides: Any, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        angle_opposite(*sides)


def test_a_point_of_a_link_keeps_its_place_while_the_link_moves() -> None:
    A, B = np.array([0, 1 + 1j]), np.array([2, 1 + 3j])
    assert np.array_equal(link_point(A, B, 0.5 + 1j), [0.5 + 1j, 1 + 1j + 0.5j - 1])


@given(vectors, vectors, numbers, numbers)
def test_motion_of_a_link_point_is_the_difference_of_its_positions(
    v_A: complex, arm: complex, omega: float, epsilon: float
) -> None:
    def point(t: Any) -> Any:
        return exact.mpc(v_A) * t + exact.mpc(arm) * exact.expj(omega * t + mpf(epsilon) * t**2 / 2)

    velocity, acceleration = exact.derivatives(point)
    noise = 1e-40  # of the differences, where the motion itself is zero
    speed, size = abs(v_A) + abs(omega * arm), abs(arm) * (abs(epsilon) + omega**2)
    assert abs(link_velocity(arm, 0, omega, v_A) - complex(velocity)) <= 8 * EPS * speed + noise
    assert abs(link_acceleration(arm, 0, omega, epsilon) - complex(acceleration)) <= 8 * EPS * size + noise


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: cross(None, 1), "a = None must be numbers"),  # numpy takes it for NaN
        (lambda: dot(1, "2"), "b = '2' must be numbers"),
        (lambda: product(1j, 2, 3), "p = 1j must be real numbers"),
        (lambda: angle("x"), "z = 'x' must be numbers"),
        (lambda: triangle_area(3, 4, 5j), "side c = 5j must be real numbers"),
        (lambda: sum_of_elements(3.0), "x = 3.0 must be a row of elements"),
    ],
)
def test_what_is_no_number_is_named(call: Any, words: str) -> None:
    with pytest.raises(ValueError, match=f"^{words}$"):
        call()


def test_what_is_masked_is_no_number() -> None:
    masked = np.ma.masked_array([3, 4, 5], mask=[False, True, False])  # whole numbers, too
    lost = [False, True, False]
    for found in (cross(masked, 1j), angle(masked * 1j), triangle_area(masked, 4, 5), angle_opposite(masked, 4, 5)):
        assert np.isnan(found).tolist() == lost


@pytest.mark.filterwarnings("error")
def test_a_point_of_a_link_without_length_is_nan_and_warns_of_nothing() -> None:
    assert np.isnan(link_point(1, 1, 3))


def test_the_sum_of_no_elements_is_nothing() -> None:
    assert sum_of_elements(np.zeros((2, 0))).tolist() == [0, 0]
