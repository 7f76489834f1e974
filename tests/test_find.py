"""The solve block: every root found, none invented, each proved; and the reason where there is none."""

import re
import subprocess
import sys
import warnings
from decimal import Decimal

import mpmath
import numpy as np
import pytest
from conftest import examples
from hypothesis import assume, example, given
from hypothesis import strategies as st

from mechsheet.worksheet import numbers
from mechsheet.worksheet.errors import SheetError, Waits
from mechsheet.worksheet.find import find
from mechsheet.worksheet.verdict import values_only

EPS = float(np.finfo(float).eps)
some = examples(30)


def real(low, high):
    return st.floats(low, high, allow_subnormal=False)


def up(x, floats):
    """The float that many places above x (below, if negative)."""
    for _ in range(abs(floats)):
        x = np.nextafter(x, np.copysign(np.inf, floats))
    return float(x)


def values(found):
    return [root.value for root in found.roots]


# --- known roots -----------------------------------------------------------------------------------------------


@some
@given(st.lists(st.integers(1, 39), min_size=1, max_size=6, unique=True), real(-5, 5), real(0.1, 10))
def test_a_polynomial_gives_all_its_roots_and_no_others(places, lo, width):
    lo, hi = lo, lo + width
    true = sorted(lo + width * k / 40 for k in places)

    found = find(lambda x: np.prod([x - r for r in true], axis=0), lo, hi)

    assert len(found.roots) == len(true)
    for root, r in zip(found.roots, true, strict=True):
        assert abs(root.value - r) <= 4 * EPS * abs(r) + 1e-30 * width
        assert root.bracket[0] <= root.value <= root.bracket[1] <= root.bracket[0] + 8 * EPS * abs(r) + 1e-30 * width


@pytest.mark.parametrize("f", [lambda x: x * (x + 5), np.sin, lambda x: np.expm1(x) * 1e-9, lambda x: x**3 - x])
def test_a_root_at_zero_is_zero(f):
    """And not what rounding leaves of the ends: of a Find alone, of one among many and of all roots."""
    plain, many = find(f, -0.4, 0.7), find(f, [-0.4, -0.9], 0.7)
    assert plain.value == 0 and many.value.tolist() == [0, 0]
    assert [root.value for root in find(f, -0.4, 0.7).roots] == [0]


@some
@given(st.lists(real(-3, 3), min_size=3, max_size=6), real(-3, 3))
def test_an_expanded_polynomial_is_solved_within_a_few_ulps_times_its_condition(c, x0):
    slope = np.polyval(np.polyder(c), x0)
    assume(abs(slope) > 1e-2)
    equals = float(np.polyval(c, x0))

    found = find(lambda x: np.polyval(c, x), x0 - 1, x0 + 0.9, equals=equals)

    with mpmath.workdps(50):
        near = min(values(found), key=lambda x: abs(x - x0))
        true = mpmath.findroot(lambda x: mpmath.polyval(c[::-1], x, asc=True) - equals, near)
    rounding = np.polyval(np.abs(c), abs(x0)) + abs(equals)
    limit = 4 * EPS * (abs(x0) + rounding / abs(slope)) + 1e-30
    assert abs(near - float(true)) <= limit
    assert abs(near - x0) <= limit


@some
@given(real(0.5, 6), real(0, 6), real(-0.99, 0.99))
def test_a_sine_gives_every_root_of_the_interval(k, phase, level):
    found = find(lambda x: np.sin(k * x + phase), 0.0, 5.0, equals=level)

    turns = 2 * np.pi * np.arange(-1, 8)
    true = np.sort(np.concatenate([np.arcsin(level) + turns, np.pi - np.arcsin(level) + turns]) - phase) / k
    assume(np.abs(true[:, None] - [0, 5]).min() > 1e-9)  # at an end one rounding decides
    assert values(found) == pytest.approx(true[(true > 0) & (true < 5)], abs=1e-13)
    assert all(abs(root.residual) <= 50 * EPS for root in found.roots)


def test_the_value_is_the_root_nearest_the_guess_and_nearest_the_middle_without_one():
    roots = np.array([0.2, 0.45, 0.9])

    def f(x):
        return np.prod([x - r for r in roots], axis=0)

    assert [find(f, 0.0, 1.0, guess=g).value for g in (-3, 0.3, 0.4, 0.8, 2)] == [0.2, 0.2, 0.45, 0.9, 0.9]
    assert find(f, 0.0, 1.0).value == 0.45
    assert find(lambda x: (x - 0.25) * (x - 0.75), 0.0, 1.0, guess=0.5).value == 0.25  # as near: the smaller


def test_the_nearest_root_is_found_where_a_farther_one_lies_in_a_nearer_piece():
    first, apart, t = np.meshgrid(np.linspace(0.4, 0.42, 7), [0.018, 0.024, 0.03], np.linspace(0.1, 0.9, 9))
    guess = first + t * apart
    found = find(lambda x: (x - first) * (x - first - apart), 0.0, 1.0, guess=guess)

    nearest = np.where(t < 0.5, first, first + apart)
    assert np.abs(found.value - nearest)[np.abs(t - 0.5) > 0.01].max() < 1e-14


# --- touching roots, ends, jumps, poles --------------------------------------------------------------------------


@some
@given(real(0.05, 0.95), real(0.1, 10), real(-2, 2))
def test_a_double_root_is_one_root_and_gone_a_little_above(x0, bend, top):
    def f(x):
        return top - bend * (x - x0) ** 2

    (root,) = find(f, 0.0, 1.0, equals=top).roots
    assert abs(root.value - x0) <= 1e-7
    outside = find(f, 0.0, 1.0, equals=up(top, 4) + 4 * EPS * bend)
    assert not outside.roots
    assert "is outside" in outside.reason


@some
@given(real(0.2, 0.8), real(0.5, 2), real(-10, -1.5), st.sampled_from([1, -1]))
@example(0.25, 0.5, -1.5, 1)  # the left root is below zero
def test_a_little_below_a_peak_both_roots_are_found(x0, bend, power, sign):
    height = 10**power
    roots = find(lambda x: sign * (1 - bend * (x - x0) ** 2), -0.1, 1.1, equals=sign * (1 - height)).roots

    half = np.sqrt(height / bend)
    assert [root.value for root in roots] == pytest.approx([x0 - half, x0 + half], abs=8 * EPS / half)


@pytest.mark.parametrize("floats", [2, 3, 10, 10**4])
def test_a_target_outside_by_some_floats_is_refused_in_a_text_that_does_not_contradict_itself(floats):
    found = find(lambda x: 0.74 - (x - 0.5) ** 2, 0.0, 1.0, equals=up(0.74, floats), unit="mm")

    low, high, target = map(
        Decimal, re.search(r"reaches (.*)\.\.(.*) mm by 97 samples, (.*) mm is outside", found.reason).groups()
    )
    assert low < high < target
    with pytest.raises(SheetError, match="is outside"):
        _ = found.value


def test_one_float_outside_is_rounding_of_the_target_and_the_residual_shows_it():
    found = find(lambda x: 0.74 - (x - 0.5) ** 2, 0.0, 1.0, equals=up(0.74, 1))

    assert found.residual == 0.74 - up(0.74, 1)
    assert found.value == pytest.approx(0.5, abs=1e-7)


def test_roots_at_the_ends_of_the_interval_count_and_roots_beyond_do_not():
    assert values(find(lambda x: (x - 0.1) * (x - 0.7), 0.1, 0.7)) == [0.1, 0.7]
    assert not find(lambda x: x - 0.7, 0.1, up(0.7, -20)).solved


@some
@given(real(0.05, 1), real(0.05, 1), st.integers(0, 1), st.sampled_from([0.1, 0.7, 3.0]))
def test_two_roots_closer_than_the_samples_are_both_found(x0, apart, side, scale):
    gap = 1e-5 * apart
    found = find(lambda x: (-1) ** side * (x - scale * x0) * (x - scale * x0 - gap), 0.0, 4.0)

    assert values(found) == pytest.approx([scale * x0, scale * x0 + gap], rel=1e-14)


@some
@given(real(-3, 3), real(0.5, 3), real(0, 3))
def test_a_pole_is_no_root(level, k, phase):
    found = find(lambda x: np.tan(k * x + phase), 0.0, 5.0, equals=level)

    true = (np.arctan(level) - phase + np.pi * np.arange(-1, 8)) / k
    assume(np.abs(true[:, None] - [0, 5]).min() > 1e-9)
    assert values(found) == pytest.approx(true[(true > 0) & (true < 5)], abs=1e-13)


@some
@given(real(-3, 3), real(0.5, 3), real(0, 3))
def test_the_wrap_of_an_angle_is_no_root(level, k, phase):
    found = find(lambda x: np.angle(np.exp(1j * (k * x + phase))), 0.0, 5.0, equals=level)

    true = (level - phase + 2 * np.pi * np.arange(-1, 5)) / k
    assume(np.abs(true[:, None] - [0, 5]).min() > 1e-9)
    assert values(found) == pytest.approx(true[(true > 0) & (true < 5)], abs=1e-13)


def test_a_jump_over_the_target_is_named_with_its_place():
    found = find(np.floor, 0.2, 9.7, equals=4.5, unknown="notch x", quantity="step", unknown_unit="mm")

    assert not found.roots
    assert found.reason == "notch x: step reaches 0..9 by 97 samples but jumps over 4.5 at 5000 mm"


@pytest.mark.parametrize("f", [lambda x: 0 * x + 3, lambda x: 3 * (np.sin(x) ** 2 + np.cos(x) ** 2)])
@pytest.mark.parametrize("guess", [None, 1.5])
def test_where_every_value_solves_none_is_chosen(f, guess):
    """As of an equation in which the unknown is cancelled, or that was left out of it by mistake."""
    found = find(f, 0.2, 9.7, equals=3, guess=guess, unknown="ratio x", quantity="sum", unit="m")

    assert not found.roots and not found.solved
    assert found.reason == "ratio x: sum is 3 m at each of 97 samples in 0.2..9.7: any value would do"
    with values_only():
        assert not find(f, 0.2, 9.7, equals=3, guess=guess).solved
    assert "reaches 3 m by 97 samples, 2 m is outside" in find(lambda x: 0 * x + 3, 0, 1, equals=2, unit="m").reason
    several = find(lambda x: f(x) + np.array([0, 1e-9]), 0.2, 9.7, equals=3)
    assert not several.solved.any() and "any value" in several.reason[0] and "outside" in several.reason[1]


def test_a_jump_that_passes_the_target_costs_few_calls():
    calls = []

    def turned(x):
        calls.append(x)
        return np.angle(np.exp(1j * x))  # from pi to -pi

    found = find(turned, 0.0, 5.0, equals=1.5)
    assert found.value == pytest.approx(1.5) and len(found.roots) == 1
    searched = sum(np.size(x) > 2 for x in calls)
    assert searched <= 20, "a quarter of the bracket in each would be 26 for the jump alone"


def test_the_peak_of_a_sawtooth_does_not_reach_above_itself_through_its_jump():
    assert not find(lambda x: x % 1, 0.0, 5.0, equals=1.2).roots
    assert not find(lambda x: -1 / (x - 1.234) ** 2, 0.0, 5.0, equals=1.2).roots


# --- edges between finite and NaN --------------------------------------------------------------------------------


def dyad(A, B, r_A, r_B, branch, sqrt=np.sqrt):
    """Pin of two links; NaN where they do not meet."""
    L = abs(B - A)
    a = (L + (r_A - r_B) * (r_A + r_B) / L) / 2
    h = sqrt((L + r_A + r_B) * (r_A + r_B - L) * (L - r_A + r_B) * (L + r_A - r_B)) / (2 * L)
    return A + (a + 1j * branch * h) * ((B - A) / L)


points = st.builds(complex, real(-1, 1), real(-1, 1))


@st.composite
def dyads(draw):
    A, B, r_B = draw(points), draw(points), draw(real(0.2, 1.5))
    assume(abs(B - A) > 0.2 and abs(abs(B - A) - r_B) > 0.05)
    return A, B, r_B


@some
@given(dyads(), real(0.02, 0.98), st.sampled_from([1, -1]))
def test_a_link_length_of_a_random_dyad_is_recovered_with_the_other_root_and_both_branches(mechanism, t, branch):
    A, B, r_B = mechanism
    L = abs(B - A)
    x0 = (1 - t) * abs(L - r_B) + t * (L + r_B)

    def height(x, s):
        return dyad(A, B, x, r_B, s).imag

    slope = (height(x0 * (1 + 1e-6), branch) - height(x0 * (1 - 1e-6), branch)) / 2e-6  # per relative change of x
    assume(abs(slope) > 1e-2)
    equals = float(height(x0, branch))
    found = find(height, equals=equals, guess=x0, branch=branch, branches=(1, -1))

    # the pin lies on the circle about B and on the line of the wanted height: two points
    reach = np.sqrt((r_B - (equals - B.imag)) * (r_B + (equals - B.imag)))
    pins = [complex(B.real + s * reach, equals) for s in (1, -1)]
    lengths = [abs(C - A) for C in pins]
    assume(min(lengths) > x0 / 200)  # inside the range searched
    assert values(found) == pytest.approx(sorted(lengths), rel=1e-10)
    assert abs(found.value / x0 - 1) <= EPS * (8 + 8 / abs(slope))
    for root in found.roots:
        assert abs(height(root.value, root.branch) - equals - root.residual) <= 1e-14  # a scalar rounds differently
        assert abs(root.residual) <= 1e-12


@some
@given(dyads(), st.sampled_from(["stretched", "folded"]))
def test_a_dead_centre_is_a_root_of_both_branches(mechanism, kind):
    A, B, r_B = mechanism
    assume(abs((B - A).real) > 0.01)  # on a vertical line another root comes as near as one likes
    with mpmath.workdps(50):
        L, out = abs(mpmath.mpc(B) - mpmath.mpc(A)), r_B if kind == "stretched" else -r_B
        equals = float((mpmath.mpc(B) + out * (mpmath.mpc(B) - mpmath.mpc(A)) / L).imag)
        length = float(abs(L + out))
    assume(L + r_B < 5 * length)  # folded to nearly nothing, its length drowns in the rounding of the others

    found = find(lambda x, s: dyad(A, B, x, r_B, s).imag, equals=equals, guess=L, branch=1, branches=(1, -1))

    at = [root.branch for root in found.roots if abs(root.value - length) <= 32 * EPS * length]
    assert sorted(at) == [-1, 1]


@some
@given(dyads())
def test_without_an_interval_the_ends_are_the_last_floats_at_which_the_group_closes(mechanism):
    A, B, r_B = mechanism

    def distance(x):
        return abs(dyad(A, B, x, r_B, 1))

    with np.errstate(invalid="ignore"):
        lo, hi = find(distance, equals=0.0, guess=abs(B - A)).interval
        assert np.isfinite(distance(np.array([lo, hi]))).all()
        assert np.isnan(distance(np.array([up(lo, -1), up(hi, 1)]))).all()
    assert hi == pytest.approx(abs(B - A) + r_B, rel=1e-14)
    assert lo == pytest.approx(abs(abs(B - A) - r_B), rel=1e-13)


@some
@given(real(0.5, 6), real(0, 3), real(0.5, 2.4), real(0.1, 2), real(-0.9, 0.9))
def test_a_gap_where_nothing_closes_cuts_the_interval_and_loses_no_root_beside_it(k, phase, gap, width, level):
    def f(x):
        return np.where((x > gap) & (x < gap + width), np.nan, np.sin(k * x + phase))

    true = np.concatenate([np.arcsin(level), np.pi - np.arcsin(level)] + 2 * np.pi * np.arange(-1, 8)[:, None])
    true = np.sort(true - phase) / k
    assume(np.abs(true[:, None] - [0, 5, gap, gap + width]).min() > 1e-9)
    true = true[(true > 0) & (true < 5) & ~((true > gap) & (true < gap + width))]
    assert values(find(f, 0.0, 5.0, equals=level)) == pytest.approx(true, abs=1e-13)


@some
@given(st.lists(real(-1, 1), min_size=4, max_size=4), real(1, 4))
def test_what_is_reached_is_the_least_and_the_greatest(c, k):
    def f(x):
        return c[0] * np.sin(k * x) + c[1] * np.cos(2 * x) + c[2] * x + c[3]

    low, high = find(f, 0.0, 3.0).reached
    dense = f(np.linspace(0, 3, 3001))
    assert low <= dense.min() + 4 * EPS
    assert high >= dense.max() - 4 * EPS
    assert high - dense.max() <= 1e-5  # by h**2 of the dense samples
    assert dense.min() - low <= 1e-5


def test_only_one_end_missing_keeps_the_other():
    found = find(lambda x: np.sqrt(2 - x), -1.0, equals=0.5, guess=0.3)

    assert found.interval == (-1.0, 2.0)
    assert found.value == 1.75
    assert find(lambda x: np.sqrt(x - 2), None, 5.0, equals=0.5, guess=3.0).interval == (2.0, 5.0)


# --- the function sees only what it can use ----------------------------------------------------------------------


def test_f_is_called_inside_the_interval_only_and_every_value_is_counted():
    seen = []

    def f(x, s):
        assert x.ndim <= 1
        assert np.isfinite(x).all()
        seen.append(np.ravel(x))
        return dyad(0j, 1 + 0j, x, 0.7, s).imag

    found = find(f, 0.1, 1.2, equals=0.3, branch=1, branches=(1, -1))

    every = np.concatenate(seen)
    assert every.min() == 0.1
    assert every.max() == 1.2
    assert found.evaluations == every.size - 4, "two places, each alone and both at once, show that f takes arrays"


def test_numpy_does_not_warn_when_the_search_leaves_the_reach():
    find(lambda x: np.log(x - 0.5) + np.sqrt(0.9 - x) + 1 / (x - 0.6), 0.0, 1.0)  # warnings are errors here


@pytest.mark.parametrize(
    ("gives", "told"),
    [
        (lambda x: 2.0 + 0j * x, "the function to solve must return real numbers, not (2+0j)"),
        (lambda x: None, "the function to solve must return real numbers, not None"),  # nothing behind `return`
        (lambda x: x > 0.5, "the function to solve must return real numbers, not True"),
        (lambda x: (x, x), "what is to be solved gives numbers of shape (2, 2) for unknowns of shape (2,)"),
    ],
)
def test_what_is_no_number_of_an_unknown_is_told_by_what_it_is(gives, told):
    """Not by numpy's words: an object, an axis remapping."""
    with pytest.raises((TypeError, ValueError), match=re.escape(told)):
        find(gives, 0.0, 2.0)


@pytest.mark.parametrize(
    ("gives", "told"),
    [
        (lambda x, y: None, "each equation must be a number, left side less right side, not None"),
        (lambda x, y: (x, "y"), "each equation must be a number, left side less right side, not 'y'"),
        (lambda x, y: ((x, y), y), "what is to be solved gives numbers of shape (2, 2) for unknowns of shape (2,)"),
    ],
)
def test_what_is_no_equation_is_told_by_what_it_is(gives, told):
    with pytest.raises((TypeError, ValueError), match=re.escape(told)):
        find(gives, x=1.0, y=1.0)


@pytest.mark.parametrize("guess", [None, 0.0, 1.3, 100.0])
def test_of_two_roots_as_near_the_smaller_one_is_the_value(guess):
    """Rounding chose: a check passed or failed by the last digit of an input."""
    center = guess or 0.0
    strength = np.linspace(0.1, 3.0, 300)

    def f(x):
        return (x - center) ** 2 * strength

    given = {"equals": 0.7} | ({} if guess is None else {"guess": guess})
    whole = find(f, center - 3.0, center + 3.0, **given).value
    with values_only():
        alone = find(f, center - 3.0, center + 3.0, **given).value
    assert (whole < center).all() and np.array_equal(whole, alone)
    both = find(lambda x, y: (x**2 + y**2 - 4 * strength, x * y - strength), x=(0, 4), y=(0, 4)).value
    assert (both.x < both.y).all()


# --- arrays of problems ------------------------------------------------------------------------------------------


def same(a, b):
    return np.array_equal(a, b, equal_nan=True)


def test_arrays_of_problems_give_what_each_gives_alone_in_any_order():
    rng = np.random.default_rng(5)
    c, lo, equals = rng.normal(size=(4, 60)), rng.uniform(-1, 0, 60), rng.uniform(-3, 3, 60)

    def cubic(c):
        return lambda x: np.where(x > 0.9, np.nan, ((c[0] * x + c[1]) * x + c[2]) * x + c[3])

    every = find(cubic(c), lo, 1.0, equals=equals)
    alone = [find(cubic(c[:, i]), lo[i], 1.0, equals=equals[i]) for i in range(60)]
    order = rng.permutation(60)
    mixed = find(cubic(c[:, order]), lo[order], 1.0, equals=equals[order])

    assert 10 < every.solved.sum() < 55  # both kinds are here
    assert list(every.reason) == [one.reason for one in alone]
    for i, one in enumerate(alone):
        assert same(every.value[i], one.value if one.solved else np.nan)
        assert same(every.residual[i], one.residual)
        assert every.reached[0][i], every.reached[1][i] == one.reached
        mine = [root.value[i] for root in every.roots if np.isfinite(root.value[i])]
        assert mine == values(one)
    assert same(mixed.value, every.value[order])
    assert list(mixed.reason) == list(every.reason[order])


def test_problems_broadcast_over_interval_target_guess_and_what_f_closes_over():
    k = np.array([[1.0], [2.0], [3.0]])  # seen by f alone

    found = find(lambda x: k * x**2, 0.1, np.array([4.0, 5.0]), equals=1.0, guess=1.0)

    assert found.value.shape == found.reason.shape == found.roots[0].branch.shape == (3, 2)
    assert found.value == pytest.approx(np.broadcast_to(1 / np.sqrt(k), (3, 2)), rel=4 * EPS)


def test_a_problem_without_numbers_stays_nan_and_its_neighbours_go_on():
    found = find(lambda x: x**2, np.array([0.0, np.nan, 0.0]), 2.0, equals=np.array([2.0, 2.0, 9.0]))

    assert found.value[0] == pytest.approx(np.sqrt(2), rel=4 * EPS)
    assert np.isnan([found.value[1:], found.residual[1:]]).all()
    assert list(found.solved) == [True, False, False]
    assert found.reason[1] == "nothing to solve for unknown x: its interval, target or guess is NaN"
    assert found.reason[2] == "unknown x: f(x) reaches 0..4 by 97 samples, 9 is outside"


def test_where_no_problem_has_numbers_all_stay_nan_and_f_is_not_asked():
    found = find(lambda x: 1 / 0, np.array([[np.nan], [np.nan]]), 2.0, unknown="rod L4")

    assert found.value.shape == found.reason.shape == found.interval[0].shape == (2, 1)
    assert np.isnan([found.value, found.residual, *found.bracket, *found.reached]).all()
    assert set(found.reason.flat) == {"nothing to solve for rod L4: its interval, target or guess is NaN"}
    assert not found.roots and not found.evaluations


def test_values_alone_are_the_same_and_the_rest_is_computed_when_it_is_read():
    every = rods()
    with values_only():
        lean = rods()
    few = lean.evaluations

    assert few < every.evaluations / 2, "of two branches only one"
    with values_only():
        easy = find(np.exp, 0.0, 1.0, equals=np.linspace(1.1, 2.7, 50))
    assert easy.evaluations / 50 <= 97 + 1 + 3 * 7 + 6, "the samples, a first value, three steps and the proof"
    assert same(lean.value, every.value) and same(lean.residual, every.residual)
    assert same(lean.interval[1], every.interval[1]) and same(lean.bracket[0], every.bracket[0])
    assert list(lean.reason) == list(every.reason) and 0 < np.count_nonzero(lean.solved) < 40
    assert len(lean.roots) == len(every.roots) and same(lean.roots[0].value, every.roots[0].value)
    assert lean.evaluations == few + every.evaluations - 40, "the first value of each problem counts once"


def rods():
    """The lifting rod for many heights, some of them out of reach."""
    heights = np.linspace(-0.9, 1.2, 40)
    return find(lambda L4, s: P56(S_MIN, L4, s).imag, equals=heights, guess=0.48, branch=-1, branches=(1, -1))


@some
@given(dyads(), real(0, 1), real(0, 1), st.sampled_from([1, -1]))
def test_the_value_is_one_of_all_roots_and_the_nearest_of_its_branch(mechanism, t, u, branch):
    A, B, r_B = mechanism
    low, high = abs(abs(B - A) - r_B), abs(B - A) + r_B
    target = B.imag + r_B * (2 * t - 1)
    guess = low + u * (high - low)
    found = find(lambda x, s: dyad(A, B, x, r_B, s).imag, equals=target, guess=guess, branch=branch, branches=(1, -1))

    mine = [root.value for root in found.roots if root.branch == branch]
    assert found.solved == bool(mine)
    assert not mine or found.value == min(mine, key=lambda x: abs(x - guess))


def test_many_problems_cost_little_more_values_each_than_a_few():
    def values_each(n):
        a = np.linspace(0.2, 0.8, n)
        found = find(lambda x: np.sin(x) - a * x, 0.1, 3.0)
        assert found.solved.all()
        return found.evaluations / n

    assert values_each(4000) <= 2 * values_each(10)


# --- the hitch ---------------------------------------------------------------------------------------------------

O1, O3, O5, O7 = 0.415 + 0.563j, 0.250 + 1.112j, 0.135 + 0.480j, 0.415 + 0.895j
L3, L5, L6, L34, L56 = 0.200, 0.480, 0.515, 0.325, 1.035
S_MIN, S_MAX = 0.420, 0.670
TURN = np.exp(1j * np.deg2rad(22.0))  # from arm O3-23 to arm O3-34
METRES = {"unit": "m", "unknown_unit": "m"}


def P34(S):
    return O3 + L34 * (dyad(O1, O3, S, L3, -1) - O3) / L3 * TURN


def P56(S, L4, branch=-1):
    return O5 + (dyad(O5, P34(S), L5, L4, branch) - O5) * L56 / L5


@pytest.fixture(scope="module")
def rod():
    return find(
        lambda L4, s: P56(S_MIN, L4, s).imag,
        equals=0.2,
        guess=0.48,
        branch=-1,
        branches=(1, -1),
        unknown="lifting rod L4",
        quantity="height Y56 of the lower link's end",
        **METRES,
    )


@pytest.fixture(scope="module")
def stroke(rod):
    found = find(lambda S: P56(S, rod.value).imag, S_MIN, S_MAX, equals=0.4, guess=0.545, unknown="stroke", **METRES)
    return found.value


def upper_link(S, L4, **given):
    P = P56(S, L4)
    return find(
        lambda L7, s: np.angle(dyad(P, O7, L6, L7, s) - P),
        equals=np.pi / 2,
        branches=(1, -1),
        unknown="upper link L7",
        quantity="mast angle phi6",
        unit="deg",
        unknown_unit="m",
        **given,
    )


def test_the_hitch_lengths_are_the_printed_ones(rod, stroke):
    assert f"{rod.value:.4f} {stroke:.4f}" == "0.6613 0.4694"
    assert f"{upper_link(stroke, rod.value, guess=0.56, branch=-1).value:.4f}" == "0.7522"


def exact_P34(S):
    """At 50 digits, from the same doubles."""
    o1, o3 = mpmath.mpc(O1), mpmath.mpc(O3)
    return o3 + L34 * (dyad(o1, o3, mpmath.mpf(S), mpmath.mpf(L3), -1, mpmath.sqrt) - o3) / L3 * mpmath.mpc(TURN)


def exact_lower_link(height, branch):
    """Pins P45 with the lower link's end at that height: its sine is known, its cosine has two signs."""
    sine = (mpmath.mpf(height) - O5.imag) / L56
    return mpmath.mpc(O5) + L5 * mpmath.mpc(branch * mpmath.sqrt(1 - sine**2), sine)


@mpmath.workdps(50)
def test_the_lifting_rod_and_its_other_root_are_exact_within_their_condition(rod):
    pin = exact_P34(S_MIN)
    true = sorted(abs(exact_lower_link(0.2, s) - pin) for s in (1, -1))

    assert [root.branch for root in rod.roots] == [-1, 1]
    for root, length in zip(rod.roots, true, strict=True):
        slope = (P56(S_MIN, root.value + 1e-6, root.branch) - P56(S_MIN, root.value - 1e-6, root.branch)).imag / 2e-6
        assert abs(root.value - length) <= 4 * EPS * (length + 1.5 / abs(slope))  # O5, P34, L56: up to 1.5 m
        assert root.bracket[0] < root.bracket[1] <= root.bracket[0] + 8 * EPS


@mpmath.workdps(50)
def test_the_working_stroke_is_exact_within_its_condition(rod, stroke):
    # P45 is known from the height, P34 from P45 and the rod, P23 from P34
    P45, o3 = exact_lower_link(0.4, 1), mpmath.mpc(O3)
    strokes = []
    for s in (1, -1):
        pin = dyad(o3, P45, mpmath.mpf(L34), mpmath.mpf(rod.value), s, mpmath.sqrt)
        strokes.append(abs(o3 + (pin - o3) / L34 * L3 / mpmath.mpc(TURN) - mpmath.mpc(O1)))

    slope = (P56(stroke + 1e-6, rod.value) - P56(stroke - 1e-6, rod.value)).imag / 2e-6
    assert min(abs(stroke - S) for S in strokes) <= 4 * EPS * (1 + 1.5 / abs(slope))


@mpmath.workdps(50)
def test_the_upper_link_is_the_distance_from_the_upright_mast(rod, stroke):
    P = P56(stroke, rod.value)  # the same double for both
    true = abs(mpmath.mpc(P) + L6 * mpmath.expj(mpmath.mpf(np.pi / 2)) - mpmath.mpc(O7))

    found = upper_link(stroke, rod.value, guess=0.56, branch=-1)
    slope = (np.angle(dyad(P, O7, L6, found.value + 1e-6, -1) - P) - np.pi / 2) / 1e-6
    assert abs(found.value - true) <= 4 * EPS * (1 + 3 / abs(slope))
    assert len(found.roots) == 1
    other = upper_link(stroke, rod.value, guess=0.56, branch=1)
    assert not other.solved
    assert other.reason.endswith("; it is reached at 0.7522 m on branch -1")


def test_the_lifting_rod_of_every_position_is_found_at_once():
    S = np.linspace(S_MIN, S_MAX, 10)
    every = find(lambda L4, s: P56(S, L4, s).imag, equals=0.2, guess=0.48, branch=-1, branches=(1, -1))

    assert every.solved.all()
    for i, s in enumerate(S):
        one = find(lambda L4, b, s=s: P56(s, L4, b).imag, equals=0.2, guess=0.48, branch=-1, branches=(1, -1))
        assert every.value[i] == pytest.approx(one.value, rel=8 * EPS)


# --- words -------------------------------------------------------------------------------------------------------


def rod_at(equals, *interval):
    return find(
        lambda L4: P56(S_MIN, L4).imag,
        *interval,
        equals=equals,
        guess=0.48,
        unknown="lifting rod L4",
        quantity="height Y56",
        unit="cm",
        unknown_unit="mm",
    )


def test_reasons_name_the_unknown_its_reach_and_the_limit_in_display_units():
    assert rod_at(2.0).reason == "lifting rod L4: height Y56 reaches -55.5..128.9 cm by 226 samples, 200 cm is outside"
    why = "as of a group that does not close, or a square root of a negative number"
    nowhere = "lifting rod L4: height Y56 is NaN at each of 97 samples in 100..150 mm"
    assert rod_at(0.2, 0.1, 0.15).reason == f"{nowhere}, {why}"
    assert find(lambda x: x, 0.0, 27500.0, equals=1e9, unit="kN").reason.endswith(
        "reaches 0..27.5 kN by 97 samples, 1000000 kN is outside"
    )


def test_a_solved_block_says_its_value_residual_bracket_roots_and_evaluations(rod):
    text, (mime, page) = str(rod), rod._mime_()

    assert mime == "text/html"
    assert "\n" not in text
    for words in (
        "lifting rod L4 = 0.66128 m",
        "0.2 m on branch -1",
        "0.66128 m (branch -1); 1.1047 m (branch +1)",
        f"roots seen by {rod.samples} samples",
        f"{rod.evaluations} times",
    ):
        assert words in text
        assert words.replace("-1", "−1") in re.sub("<[^>]*>", "", page)
    assert re.search(r"missed by [\d.]+e-1[67] m, value within [\d.]+e-1[67] m,", text)
    assert ">found<" in page


@pytest.mark.parametrize("x", [0.0001234567, 0.05242194, 12.345678, 129.61376])
def test_a_verdict_shows_the_digits_of_its_line(x):
    """Of one problem and of several, with its roots and its condition; five digits or all before the point."""
    many = np.linspace(x / 3, x, 12)
    one, several = (find(lambda u: u, 0.0, 2 * x, equals=e, unit="mm", unknown_unit="mm") for e in (x, many))
    line = numbers.value(float(one.value), "mm", numbers.PLAIN)
    assert (
        f" = {line}: condition" in str(one) and f" = {line}, missed by" in str(one) and f"samples {line}," in str(one)
    )
    assert f" = {numbers.value(several.value, 'mm', numbers.PLAIN)}, 12 of 12" in several.headline()


def test_an_unsolved_block_shows_itself_without_its_value():
    found = rod_at(2.0)

    assert str(found) == found.reason
    assert found.reason.replace(" -", " −") in found._mime_()[1]
    assert ">not found<" in found._mime_()[1]


def test_a_block_of_many_problems_tells_how_many_are_solved_and_why_not_the_others():
    found = find(lambda x: x**2, 0.0, 2.0, equals=np.array([1.0, 5.0, 6.0, 7.0, 8.0, 9.0]))

    page = found._mime_()[1]
    assert "unknown x = 1, 1 of 6 problems solved" in str(found)
    assert "problem 2: unknown x: f(x) reaches 0..4 by 97 samples, 5 is outside" in page
    assert "and 2 more" in page


def test_words_are_escaped_in_the_page():
    assert "a &lt; b" in find(lambda x: x, 0.0, 1.0, equals=0.5, unknown="a < b")._mime_()[1]


# --- bad arguments -----------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"lo": 2.0, "hi": 1.0}, "lo = 2000 mm for rod must be less than hi = 1000 mm"),
        ({"lo": [0.0, 1.0], "hi": 1.0}, "lo = 1000 mm for rod must be less than hi = 1000 mm"),
        ({"lo": 0.0, "hi": np.inf}, "hi = ∞ mm for rod must be finite"),
        ({"lo": 0.0, "hi": 1.0, "guess": -np.inf}, "guess = -∞ mm for rod must be finite"),
        ({"lo": 0.0}, "rod needs a guess, or both ends"),
        ({"guess": 0.0}, "guess = 0 mm for rod must be positive"),
        ({"hi": 2.0, "guess": 3.0}, "guess = 3000 mm for rod must be less than hi = 2000 mm"),
    ],
)
def test_numbers_that_cannot_be_used_are_named(arguments, words):
    with pytest.raises(SheetError, match=re.escape(words)):
        find(lambda x: x, **arguments, unknown="rod", unknown_unit="mm")


@pytest.mark.parametrize(
    "arguments",
    [{"lo": np.nan, "hi": 1.0}, {"lo": 0.0, "hi": np.nan}, {"lo": 0.0, "hi": 1.0, "equals": np.nan}, {"guess": np.nan}],
)
def test_what_rests_on_no_number_waits_with_the_reason(arguments):
    says = "nothing to solve for rod: its interval, target or guess is NaN"
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        found = find(lambda x: 1 / 0, **arguments, unknown="rod", unknown_unit="mm")
        page = found._mime_()[1]

    assert found.reason == str(found) == says and found.waits and not found.solved
    assert found.word() == "not evaluated" and says in page and "NaN mm" not in page
    with pytest.raises(Waits, match=says):
        _ = found.value


def test_what_closes_nowhere_does_not_wait():
    found = find(lambda x: x * np.nan, 0.0, 1.0, unknown="rod")
    assert not found.waits and found.word() == "not found"
    with pytest.raises(SheetError, match=r"rod: f\(x\) is NaN at each of 97 samples in 0..1, as of") as error:
        _ = found.value
    assert not isinstance(error.value, Waits)


@pytest.mark.parametrize(("branch", "branches"), [(0, (1, -1)), (None, (1, -1)), (1, None)])
def test_a_branch_that_is_not_one_of_the_branches_is_named(branch, branches):
    with pytest.raises(ValueError, match=f"branch = {branch} of rod must be one of"):
        find(lambda x: x, 0.0, 1.0, branch=branch, branches=branches, unknown="rod")


def test_the_module_starts_without_scipy_and_marimo():
    code = "import sys, mechsheet.worksheet.find; sys.exit(bool({'scipy', 'marimo', 'pandas'} & sys.modules.keys()))"
    assert subprocess.run([sys.executable, "-c", code]).returncode == 0


def test_what_is_masked_is_not_solved():
    masked = np.ma.masked_array([4.0, 9.0, 16.0], mask=[False, True, False])
    assert find(lambda x: x**2, 0.0, 10.0, equals=masked).value.tolist() == pytest.approx([2, np.nan, 4], nan_ok=True)
    within = find(lambda x: x**2 - masked, 0.0, 10.0)  # once of its zeros, what stands under the mask
    assert within.value.tolist() == pytest.approx([2, np.nan, 4], nan_ok=True)
    both = find(lambda x, y: (x + y - masked, x - y), x=1.0, y=1.0)
    assert both.value.x.tolist() == pytest.approx([2, np.nan, 8], nan_ok=True)


@pytest.mark.parametrize(
    ("given", "shown"),
    [
        (1j, "1j"),
        (np.array([2 + 1j]), "[2.+1.j]"),
        ("a", "'a'"),
        ("1", "'1'"),
        (None, "None"),
        (1 << 1024, str(1 << 1024)[:59]),
    ],
)
def test_what_is_no_real_number_is_named(given, shown):
    words = re.escape(shown)
    with pytest.raises(SheetError, match=f"^equals = {words}.* for rod must be real numbers$"):  # its real part, before
        find(lambda x: x**2, 0.0, 10.0, equals=given, unknown="rod")
    with pytest.raises(SheetError, match=f"^x = {words}.* must be real numbers$"):
        find(lambda x, y: (x + y - 1, x - y), x=given, y=1.0)


@pytest.mark.parametrize(
    ("given", "told"),
    [
        ({"lo": [0.0, 1.0], "hi": [3.0, 3.0, 3.0]}, "shapes do not broadcast: lo (2,), hi (3,)"),
        ({"lo": 0.0, "hi": 3.0, "unit": None}, "a unit must be a text between quotes, such as 'mm', not None"),
    ],
)
def test_what_a_find_cannot_take_is_named(given, told):
    with pytest.raises(SheetError, match=re.escape(told)):
        find(lambda x: x**2 - 2, **given)
    more = {"x": given["lo"], "y": given["hi"], "unit": given.get("unit", "-")}
    with pytest.raises(SheetError, match=re.escape(told.replace("lo", "x").replace("hi", "y"))):
        find(lambda x, y: (x - 1, y - 2), **more)


def test_of_no_problems_nothing_is_found_wherever_they_come_from():
    none = np.zeros(0)
    for found in (find(lambda x: x**2, 0.0, 1.0, equals=none), find(lambda x: x**2 - none, 0.0, 1.0)):
        assert found.value.shape == found.reason.shape == (0,) and found.roots == ()
