"""Derivatives by differences: as exact as they say, and no other than those of scipy."""

import mpmath
import numpy as np
import pytest
from scipy.differentiate import derivative as by_scipy

from mechsheet.mechanics.differences import derivative

FUNCTIONS = {
    "wave": (np.sin, mpmath.sin, -3.0, 3.0),
    "fast wave": (lambda x: np.sin(40 * x), lambda x: mpmath.sin(40 * x), 0.0, 1.0),
    "growing": (np.exp, mpmath.exp, -2.0, 5.0),
    "pole beside the range": (lambda x: 1 / (1.05 - x), lambda x: 1 / (mpmath.mpf("1.05") - x), 0.0, 1.0),
    "dead centre beside the range": (
        lambda x: np.sqrt(1.001 - x),
        lambda x: mpmath.sqrt(mpmath.mpf("1.001") - x),
        0.0,
        1.0,
    ),
    "level": (lambda x: np.full(np.shape(x), 7.0), lambda x: mpmath.mpf(7), 0.0, 1.0),
}


def sampled(name):
    f, exact, lo, hi = FUNCTIONS[name]
    x = np.linspace(lo, hi, 11)
    return f, exact, x, 0.04 * (hi - lo), np.where(x == lo, 1, np.where(x == hi, -1, 0))


@pytest.mark.parametrize("name", FUNCTIONS)
@pytest.mark.parametrize("enough", [0.0, 1e-9, 1e-4])
def test_slopes_are_those_of_scipy_within_the_errors_of_both(name, enough):
    f, _, x, step, side = sampled(name)
    slope, error = derivative(f, x, step, side, enough)
    theirs = by_scipy(f, x, initial_step=step, step_direction=side, tolerances={"atol": enough, "rtol": 0.0})
    rounding = 1e-13 * np.max(np.abs(f(x))) / step
    assert np.all(np.abs(slope - theirs.df) <= 10 * (error + theirs.error) + rounding)
    assert np.all(error <= np.maximum(10 * theirs.error, enough) + 100 * rounding)


def test_rounding_that_is_alike_twice_is_no_agreement():
    """Near a dead centre the last digits of the values hide what a halving changes."""
    x, past = np.array([0.0, 0.5, 0.9]), 1.0000001
    for side in (-1, 0, 1):
        slope, error = derivative(lambda x: np.arccos(x) + np.sqrt(past - x), x, 1e-5, np.full(3, side), 1e-12)
        exact = -1 / np.sqrt(1 - x**2) - 0.5 / np.sqrt(past - x)
        assert np.all(np.abs(slope - exact) <= 10 * error)


@pytest.mark.parametrize("name", FUNCTIONS)
def test_the_change_of_the_last_halving_is_no_less_than_the_error(name):
    f, exact, x, step, side = sampled(name)
    slope, error = derivative(f, x, step, side, 1e-7)
    with mpmath.workdps(50):
        true = np.array([float(mpmath.diff(exact, mpmath.mpf(at))) for at in x])
    assert np.all(np.abs(slope - true) <= error + 1e-11 * max(1.0, np.max(np.abs(true))))
    assert np.all(np.isfinite(slope))


def test_where_a_value_is_missing_there_is_no_slope():
    x = np.linspace(0.0, 1.0, 5)
    slope, _ = derivative(lambda x: np.where(x <= 0.76, x, np.nan), x, 0.02, np.zeros(5, int), 0.0)
    assert np.isnan(slope).tolist() == [False, False, False, True, True]
