"""Functions to solve that are right for one number only: reductions over positions, branches, Python's own numbers."""

import math

import numpy as np
import pytest

from mechsheet import check_slope, find, minerr

# As many positions as a search may ask for at once: then nothing fails, and every value is wrong.
POSITIONS = [2, 3, 7, 8, 15, 16, 91, 97, 129]


def sum_of(values):
    return sum(values.tolist())


REDUCED = {
    "largest": (lambda s, r: np.max(s * r), lambda s: np.max(s)),
    "least": (lambda s, r: np.min(s * r), lambda s: np.min(s)),
    "mean, times a number": (lambda s, r: np.mean(s) * r, lambda s: np.mean(s)),
    "last of a running sum": (lambda s, r: np.cumsum(s * r)[-1], lambda s: np.sum(s)),
    "work": (lambda s, r: np.trapezoid(s * r, dx=1.0), lambda s: np.trapezoid(s, dx=1.0)),
    "scalar product": (lambda s, r: (s * r) @ np.ones(s.size), lambda s: np.sum(s)),
    "largest, as a part of the size": (lambda s, r: r * np.max(s * r) / np.mean(r), lambda s: np.max(s)),
    "one element": (lambda s, r: (s * r)[-1], lambda s: s[-1]),
    "Python's sum": (lambda s, r: sum_of(s * r), lambda s: np.sum(s)),
    "Python's float": (lambda s, r: float(r) * math.fsum(s), lambda s: np.sum(s)),
    "if": (lambda s, r: np.max(s) * r if r < 0.5 else np.max(s * r), lambda s: np.max(s)),
}


CASES = [(name, count) for name in REDUCED for count in (POSITIONS if name.startswith("largest") else (2, 16, 97))]


@pytest.mark.parametrize(("name", "count"), CASES)
def test_what_reduces_a_field_of_positions_is_solved(name, count):
    f, slope = REDUCED[name]
    s = np.linspace(0.4, 1.3, count)

    found = find(lambda r: f(s, r), 0.0, 2.0, equals=0.7 * slope(s))
    assert found.value == pytest.approx(0.7, abs=1e-15) and len(found.roots) == 1

    guessed = find(lambda r: f(s, r), equals=0.7 * slope(s), guess=1.0)
    assert guessed.value == pytest.approx(0.7, abs=1e-15)

    several = find(lambda r, q: (f(s, r) - q, q + r), equals=(0.0, 0.7 * (slope(s) + 1)), r=1.0, q=1.0)
    assert several.value.r == pytest.approx(0.7, rel=1e-12)

    fitted = minerr(lambda r: (f(s, r) - slope(s), f(s, r) - 2 * slope(s)), r=1.0)
    assert fitted.value.r == pytest.approx(1.5, rel=1e-8)


@pytest.mark.parametrize("count", [3, 5, 97])
def test_each_of_several_problems_has_its_own_largest(count):
    s = np.linspace(0.4, 1.3, count)
    wanted = np.array([0.3, 0.6, 0.9, 1.2, 1.5])

    many = find(lambda r: np.max(s * r), 0.0, 2.0, equals=wanted)
    within = find(lambda r: np.max(s * r), 0.0, np.full(5, 2.0), equals=wanted)
    np.testing.assert_allclose(many.value, wanted / 1.3, rtol=1e-15)
    np.testing.assert_allclose(within.value, wanted / 1.3, rtol=1e-15)


def test_branches_that_reduce_a_field():
    s = np.linspace(0.4, 1.3, 97)
    found = find(lambda r, b: np.max(s * r) * b, -2.0, 2.0, equals=0.65, branch=-1, branches=(+1, -1))

    assert found.value == pytest.approx(-0.65 / 0.4, rel=1e-15)
    assert sorted((root.branch, round(root.value, 9)) for root in found.roots) == [(-1, -1.625), (1, 0.5)]


def test_what_takes_arrays_is_called_with_arrays():
    calls = []

    def f(x):
        calls.append(np.size(x))
        return np.sin(x) / (1 + x)

    assert find(f, 0.0, 1.0, equals=0.3).solved
    assert sum(1 for size in calls if size == 1) <= 5 and len(calls) < 40


@pytest.mark.parametrize("count", [5, 9, 40])
def test_slopes_of_what_reduces_a_field(count):
    s = np.linspace(0.4, 1.3, 97)
    x = np.linspace(0.1, 0.9, count)

    assert check_slope("energy", np.full(count, np.sum(s)), lambda x: np.sum(s * x), x, 0.0, 1.0).passed
    assert not check_slope("energy", np.full(count, 1.01 * np.sum(s)), lambda x: np.sum(s * x), x, 0.0, 1.0).passed
