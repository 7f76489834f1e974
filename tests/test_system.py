"""Find of several unknowns: what share of known solutions is seen, how well each holds, and the reason for none."""

import math
import re
from math import e, pi

import mpmath
import numpy as np
import pytest
from conftest import examples
from hypothesis import assume, given
from hypothesis import strategies as st
from numpy import cos, exp, sin

from mechsheet import find, minerr, rrr
from mechsheet.worksheet.errors import SheetError, Waits
from mechsheet.worksheet.system import Solution
from mechsheet.worksheet.verdict import values_only

EPS = float(np.finfo(float).eps)


def points(found: Solution):
    return np.array([tuple(s) for s in found.solutions])


# --- systems with a known number of solutions ----------------------------------------------------------------------


def himmelblau(x, y):
    """Gradient of Himmelblau's function: four minima, four saddles, one maximum."""
    a, b = x**2 + y - 11, x + y**2 - 7
    return 4 * x * a + 2 * b, 2 * a + 4 * y * b


def freudenstein_roth(x, y):
    return -13 + x + ((5 - y) * y - 2) * y, -29 + x + ((y + 1) * y - 14) * y


def powell_singular(a, b, c, d):
    """All four unknowns 0, where the slopes have rank 2."""
    return a + 10 * b, 5**0.5 * (c - d), (b - 2 * c) ** 2, 10**0.5 * (a - d) ** 2


def ferraris_tronconi(x, y):
    return 0.5 * sin(x * y) - 0.25 * y / pi - 0.5 * x, (1 - 0.25 / pi) * (exp(2 * x) - e) + e * y / pi - 2 * e * x


def merlet(x, y):
    """sin x cos y and cos x sin y are both 0: at 9 even and 4 odd multiples of a right angle in a turn."""
    return -sin(x) * cos(y) - 2 * cos(x) * sin(y), -cos(x) * sin(y) - 2 * sin(x) * cos(y)


def wright(*x):
    """Each unknown is 1 + w or 1 - w, and for each choice of signs there is one w > 0: 2^n solutions."""
    return tuple(v**2 - 2 * v + sum(x) for v in x)


def brown(a, b, c, d, e):
    """All but the last one are equal, which leaves 5 a^5 - 6 a^4 + 1 = 0."""
    total = a + b + c + d + e
    return *(v + total - 6 for v in (a, b, c, d)), a * b * c * d * e - 1


def platform(x, y, turn):
    """Planar platform on three legs of given length; see `modes`."""
    P = x + 1j * y
    return tuple(abs(P + b * exp(1j * turn) - a) - leg for a, b, leg in zip(BASE, TOP, LEGS, strict=True))


BASE, TOP, LEGS = (0, 15.91, 10j), (0, 16.04, 13.0 + 12j), (14.98, 15.38, 12.0)


def modes(turns=40_001):
    """Assembly modes of the platform, counted by the third leg's length along both arcs of the first two circles."""
    turn = np.linspace(-pi, pi, turns)
    count = 0
    for branch in (+1, -1):
        P = rrr(0, BASE[1] - TOP[1] * exp(1j * turn), LEGS[0], LEGS[1], branch)
        left = abs(P + TOP[2] * exp(1j * turn) - BASE[2]) - LEGS[2]
        count += int(np.count_nonzero(left[:-1] * left[1:] < 0))
    return count


SYSTEMS = [
    ("Himmelblau's gradient", himmelblau, {"x": (-6, 6), "y": (-6, 6)}, 0, 9),
    ("Freudenstein and Roth", freudenstein_roth, {"x": (-50, 50), "y": (-50, 50)}, 0, 1),
    ("Powell's singular function", powell_singular, dict.fromkeys("abcd", (-4, 5)), 0, 1),
    ("Powell's badly scaled one", lambda x, y: (1e4 * x * y, exp(-x) + exp(-y)), {"x": (-1, 10), "y": (-1, 10)},
     (1, 1.0001), 2),
    ("Rosenbrock", lambda x, y: (10 * (y - x**2), 1 - x), {"x": (-5, 5), "y": (-5, 5)}, 0, 1),
    ("Ferraris and Tronconi", ferraris_tronconi, {"x": (0.25, 1), "y": (1.5, 2 * pi)}, 0, 2),
    ("Merlet", merlet, {"x": (0, 2 * pi), "y": (0, 2 * pi)}, 0, 13),
    ("Wright, 3", lambda x, y, z: wright(x, y, z), dict.fromkeys("xyz", (-10, 10)), (4,) * 3, 8),
    ("Wright, 5", lambda x, y, z, u, v: wright(x, y, z, u, v), dict.fromkeys("xyzuv", (-10, 10)), (10,) * 5, 32),
    ("Brown, almost linear", brown, dict.fromkeys("abcd", (-2, 2)) | {"e": (-2, 12)}, 0, None),
    ("arm of two links", lambda a, b: exp(1j * a) + 0.8 * exp(1j * (a + b)), {"a": (-pi, pi), "b": (-pi, pi)},
     1.2 + 0.5j, 2),
    ("arm of three links", lambda a, b, c: (exp(1j * a) + 0.8 * exp(1j * b) + 0.5 * exp(1j * c), c),
     dict.fromkeys("abc", (-pi, pi)), (1.2 + 0.5j, 1.0), 2),
    ("sine and cosine", lambda x, y: (sin(x), cos(y)), {"x": (-10, 10), "y": (-10, 10)}, (0.5, 0.5), 42),
    ("two ellipses", lambda x, y: (x**2 / 4 + y**2, x**2 + y**2 / 4), {"x": (-3, 3), "y": (-3, 3)}, (1, 1), 4),
    ("circle and parabola", lambda x, y: (x**2 + y**2, y - x**2), {"x": (-3, 3), "y": (-3, 3)}, (4, -1), 2),
    ("circle and its tangent", lambda x, y: (x**2 + y**2, x), {"x": (-3, 3), "y": (-3, 3)}, (1, 1), 1),
    ("circle and a line beside it", lambda x, y: (x**2 + y**2, x + y), {"x": (-3, 3), "y": (-3, 3)}, (1, 3), 0),
    ("platform on three legs", platform, {"x": (-20, 20), "y": (-20, 20), "turn": (-pi, pi)}, 0, None),
]  # fmt: skip


def known(name: str, count: int | None) -> int:
    if name.startswith("Brown"):
        return sum(abs(mpmath.im(root)) < 1e-12 for root in mpmath.polyroots([1, 0, 0, 0, -6, 5], asc=True))
    return modes() if count is None else count


@pytest.mark.parametrize(("name", "f", "where", "equals", "count"), SYSTEMS, ids=[s[0] for s in SYSTEMS])
def test_every_solution_of_a_textbook_system_is_seen(name, f, where, equals, count):
    found = find(f, equals=equals, **where)

    assert len(found.solutions) == known(name, count)
    assert bool(found.reason) == (not found.solutions)
    for solution in found.solutions:
        values = f(*solution)
        parts = values if isinstance(values, tuple) else (values,)
        wanted = equals if isinstance(equals, tuple) else (equals,) * len(parts)
        assert max(abs(p - w) for p, w in zip(parts, wanted, strict=True)) < (1e-8 if "badly" in name else 1e-11)


# --- exactness -----------------------------------------------------------------------------------------------------


def test_solutions_agree_with_those_polished_to_50_digits():
    """Within a few roundings times the condition; the equations are polynomials that mpmath takes as they are."""
    for f, where in ((himmelblau, {"x": (-6, 6), "y": (-6, 6)}), (freudenstein_roth, {"x": (0, 9), "y": (0, 9)})):
        found = find(f, **where)
        for solution in found.solutions:
            with mpmath.workdps(50):
                true = mpmath.findroot(lambda x, y, f=f: list(f(x, y)), solution)
            off = max(abs(float(true[i]) - solution[i]) for i in range(2))
            assert off <= 16 * EPS * 12 * max(found.condition, 40)


scales = st.integers(-9, 9).map(lambda n: 10.0**n)


@examples(5)
@given(st.lists(st.tuples(scales, scales, scales, scales), min_size=6, max_size=6))
def test_units_of_unknowns_and_equations_change_nothing(units):
    a, b, c, d = np.array(units).T

    def equations(x, y):
        return c * (x**2 / a**2 + y / b - 3), d * (x / a - y / b)

    found = find(equations, x=(-4 * a, 4 * a), y=(-4 * b, 4 * b))
    guessed = find(equations, x=2 * a, y=2 * b)

    u = (np.sqrt(13) - 1) / 2
    for k, size in enumerate(np.array(units)[:, :2]):
        assert np.allclose(points(found)[:, :, k] / size, [(-1 - u, -1 - u), (u, u)], rtol=1e-13, atol=0), units[k]
        assert np.allclose(np.array([*guessed.value])[:, k] / size, u, rtol=1e-13, atol=0), units[k]
    assert np.all(found.condition < 20)


def test_two_links_are_those_of_the_group_on_both_branches():
    """Of 24 random pairs, each a problem of its own."""
    rng = np.random.default_rng(7)
    a, b, d, turn = np.array([0.3, 0.3, 0.3, -3])[:, None] + np.array([2.7, 2.7, 2.7, 6])[:, None] * rng.random((4, 80))
    closes = (abs(a - b) + 1e-3 < d) & (d < a + b - 1e-3)
    a, b, B = (x[closes][:24] for x in (a, b, d * np.exp(1j * turn)))
    found = find(lambda phi, psi: a * exp(1j * phi) - b * exp(1j * psi), equals=B, phi=(-pi, pi), psi=(-pi, pi))

    seen = points(found)  # solution, unknown, problem; NaN where a problem has fewer
    ends = a * exp(1j * seen[:, 0])
    for branch in (+1, -1):
        off = np.nanmin(abs(ends - rrr(0, B, a, b, branch)), axis=0)
        assert off.size == 24 and np.all(off < 64 * EPS * (a + b) * np.maximum(found.condition, 10))
    count = np.count_nonzero(~np.isnan(ends), axis=0) - np.count_nonzero(abs(abs(seen) - pi) < 1e-9, axis=(0, 1))
    assert np.all(count <= 2)


def test_a_double_solution_has_no_condition_and_half_the_digits():
    found = find(lambda x, y: (x**2 + y**2, x), equals=(1, 1), x=(-3, 3), y=(-3, 3))

    assert np.isinf(found.condition) and "infinite: the slopes are singular" in str(found)
    assert abs(found.value.x - 1) < 1e-15 and abs(found.value.y) < 1e-7
    assert found.solved


# --- guesses, arrays, sweeps -----------------------------------------------------------------------------------------


DEPENDENT = {
    "a line": lambda u, v: (u + v - 1, 2 * u + 2 * v - 2),
    "a circle": lambda u, v: (u**2 + v**2 - 1, 5 - 5 * u**2 - 5 * v**2),
    "moments about three points of a line": lambda u, v: (u * 2 - v * 3 - 1, u * 4 - v * 6 - 2),
    "sizes far apart": lambda u, v: (u * 1e6 + v - 1, u * 1e-3 + v * 1e-9 - 1e-9),
    "a complex one": lambda u, v: np.exp(1j * (u + v)) - np.exp(0.3j),
}


@pytest.mark.parametrize("places", [{"u": 0.4, "v": 0.7}, {"u": (-2, 3), "v": (-2, 3)}], ids=["guess", "intervals"])
@pytest.mark.parametrize("name", DEPENDENT)
def test_equations_that_depend_on_each_other_have_no_single_solution(name, places):
    """Newton's steps end in one of them, and nothing tells why in that one."""
    found = find(DEPENDENT[name], **places)
    assert not found.solved and np.isnan(found._values).all()
    assert found.reason.startswith("no single solution for u, v: the equations depend on each other, u = ")
    pair = re.findall(r"u = (\S+), v = (\S+)(?: solves|$)", found.reason)
    assert len(pair) == 2 and pair[0] != pair[1]
    with values_only():
        assert not find(DEPENDENT[name], **places).solved


def test_in_an_array_only_the_problems_that_depend_have_no_solution():
    found = find(lambda u, v: (u + v - 1, np.array([2.0, 3.0, 2.0]) * u + 2 * v - 2), u=0.4, v=0.7)
    assert found.solved.tolist() == [False, True, False] and found.value.v[1] == pytest.approx(1, abs=1e-14)
    assert ["depend" in reason for reason in found.reason] == [True, False, True]


@pytest.mark.parametrize(
    "f",
    [
        lambda u, v: (u**2 + v**2 - 1, v - 1),  # a line that touches a circle
        lambda u, v: (u**2 + v**2 - 1, (u - 3) ** 2 + v**2 - 4),  # circles that touch
        lambda u, v: ((u - 0.5) ** 2, (v - 0.5) ** 2),
        lambda u, v: (u * 1e-9 - 1, v * 1e9 - 1),
    ],
)
def test_a_double_solution_alone_is_one(f):
    for places in ({"u": 0.6, "v": 0.7}, {"u": (-2, 3), "v": (-2, 3)}):
        found = find(f, **places)
        assert found.solved or "depend" not in found.reason
    assert find(f, u=0.6, v=0.7).solved


def test_an_equation_without_an_unknown_is_named():
    found = find(lambda u, v: (v - u, 0 * u + 3), equals=(0, 3), u=0.2, v=0.9)
    assert found.reason.startswith("no single solution for u, v: equation 2 rests on none of them near u = ")
    u, v = re.findall(r"= ([\d.]+)", found.reason)
    assert u == v


def test_from_a_guess_the_value_is_where_it_leads_and_the_others_around_it_are_listed():
    found = find(himmelblau, x=3.5, y=-1.5)

    assert np.allclose(found.value, (3.584428, -1.848127), atol=1e-6)
    assert len(found.solutions) > 1 and found.starts == 64
    assert "solutions seen by 64 starts around the guess" in dict(found.details())
    alone = find(himmelblau, x=np.array([3.5]), y=-1.5)
    assert alone.value.x[0] == found.value.x, "what a problem gets does not depend on how it is asked"


def test_each_problem_of_an_array_has_its_own_verdict():
    height = np.array([0.5, 3.0, 1.0, np.nan, -0.5])
    found = find(lambda x, y: (x**2 + y**2, y), equals=(1, height), x=(0, 2), y=(-2, 2), unit=("m**2", "m"))

    assert found.solved.tolist() == [True, False, True, False, True]
    assert np.allclose(found.value.x[[0, 4]], np.sqrt(0.75)) and found.value.y[0] == 0.5
    assert found.reason[0] == "" and "no solution for x, y by 64 starts: equation" in found.reason[1]
    assert found.headline().endswith("3 of 5 problems solved")
    resists, waits = str(found).split("; problem ")[1:]
    assert resists.startswith("2: no solution for x, y by 64 starts: equation 2 leaves") and "is NaN" in waits
    one = find(lambda x, y: (x**2 + y**2, y), equals=(1, 0.5), x=(0, 2), y=(-2, 2))
    assert one.value.x == found.value.x[0]


def test_a_problem_of_an_array_is_searched_as_often_as_alone():
    """It had the evaluations of the one that took most starts, and took their time."""
    waves = np.array([1.0, 14.0])

    def roots(k):
        return find(lambda x, y: (sin(k * x), sin(k * y)), x=(0.1, 4.0), y=(0.1, 4.0))

    alone = [roots(k) for k in waves]
    assert roots(waves).evaluations.tolist() == [each.evaluations for each in alone]
    assert alone[1].evaluations > 5 * alone[0].evaluations


def test_arrays_broadcast_over_unknowns_targets_and_what_the_equations_read():
    a, b = np.array([[1.0], [2.0]]), np.array([3.0, 4.0, 5.0])
    found = find(lambda x, y: (x + y, a * x - y), equals=(b, 0), x=1.0, y=np.array([1.0, 2.0, 3.0]))

    assert found.value.x.shape == (2, 3) and np.allclose(found.value.x, b / (1 + a), rtol=1e-15)


def test_from_a_guess_an_angle_ends_in_the_turn_that_it_starts_in():
    """Of 400 sliders on a link: where it lies across the wanted direction Newton's own step turns it many times."""
    rng = np.random.default_rng(4)
    reach, start, far = rng.uniform(0.5, 4, 400), rng.uniform(-pi, pi, 400), rng.uniform(0.5, 3, 400)
    found = find(lambda turn, s: s * exp(1j * turn) - reach, unknown_unit=("deg", "m"), turn=start, s=far)

    assert np.all(found.solved) and abs(found.value.turn).max() <= pi + 1e-15
    assert np.allclose(found.value.s, reach * cos(found.value.turn), rtol=1e-14)
    assert found.evaluations.max() == 1 + 20 * (2 * 2 + 1), "never in a trust region"


def test_what_is_rounded_to_the_same_number_all_around_is_a_solution():
    """The real part is -2e-16 at all of the next floats: its slopes are a sixth of what it adds."""
    turned = 0.2 * 8.347208449245823
    found = find(lambda u, v: exp(1j * u) + 0.7114300409213384 * exp(1j * v), equals=turned, u=1.0, v=-1.0)

    assert found.solved and np.allclose(found.value, (0.18663192327807, -0.26386448915273), rtol=1e-13)


def test_values_only_gives_the_same_value():
    def asked():
        return find(himmelblau, x=3.5, y=-1.5), find(himmelblau, x=(-6, 6), y=(-6, 6))

    with values_only():
        fast = asked()
    assert [f.value for f in fast] == [f.value for f in asked()]


def test_unknowns_stay_inside_their_intervals():
    seen = []

    def f(x, y):
        seen.append((np.min(x), np.max(x)))
        return x**2 + y**2 - 1, x - y

    find(f, x=(0, 2), y=(-2, 2))
    assert min(low for low, _ in seen) >= 0 and max(high for _, high in seen) <= 2


# --- no solution -----------------------------------------------------------------------------------------------------


def test_the_equation_that_resists_is_named():
    found = find(lambda a, b: 2 * exp(1j * a) + exp(1j * b), equals=4, a=0.3, b=0.2, unit="m", unknown_unit="deg")

    assert not found.solved
    assert found.reason.startswith(
        "no solution for a, b from the guess: equation 1, real part leaves -1 m at the nearest, a = "
    )
    with pytest.raises(SheetError, match="equation 1, real part leaves -1 m"):
        found.value


def test_a_solution_at_infinity_and_a_level_equation_are_none():
    assert not find(lambda x, y: (exp(-x), y - 1), x=1.0, y=0.5).solved
    assert not find(lambda x, y: (1 / x, y - 1), x=1.0, y=0.5).solved
    assert not find(lambda x, y: (0 * x, y - 1), x=1.0, y=0.5).solved


def test_equations_without_a_number_say_which():
    found = find(lambda x, y: (x - y, np.sqrt(x - 5)), x=(0, 1), y=(0, 1))

    assert found.reason == "no solution for x, y by 64 starts: equation 2 has no number there"


def test_starts_around_the_guess_tell_of_solutions_where_the_guess_leads_to_none():
    found = find(lambda x, y: (x**3 - 2 * x + 2 + 0 * y, y - 1), x=1.0, y=1.0)

    assert not found.solved and "from the guess" in found.reason
    wider = find(lambda x, y: (x**3 - 2 * x + 2 + 0 * y, y - 1), x=-1.0, y=1.0)
    assert wider.value.x == pytest.approx(-1.7692923542386314, rel=1e-15)


def test_a_guess_from_which_another_solution_is_only_seen_is_told_what_to_do() -> None:
    found = find(lambda x, y: (x**3 - 2 * x + 2, y - x), x=0.0, y=0.5)
    assert not found.solved
    assert found.reason.endswith("; starts around it see x = -1.7693, y = -1.7693: give a guess nearer to it")


@pytest.mark.parametrize(
    ("asked", "message"),
    [
        ({"x": (2, 0), "y": 1.0}, "x from 2 must end above that, not at 0"),
        ({"x": (0, np.inf), "y": 1.0}, "an end of x = ∞ must be finite"),
        ({"x": (1, 2, 3), "y": 1.0}, "x needs a guess, or the two ends of its interval, not 3 numbers"),
        ({"x": 1.0}, "the equations are of x, y, the unknowns given are x"),
        ({"x": 1.0, "y": 1.0, "equals": (1, 2, 3)}, "equals has 3 values for 2 equations"),
        ({"x": 1.0, "y": 1.0, "unit": ("m",)}, "unit has 1 units for 2 equations"),
        (
            {"x": 1.0, "y": 1.0, "guess": 1.0},
            "find takes either an interval with equals, guess, branch, branches, unknown, quantity, unit and "
            "unknown_unit, or the unknowns x, y",
        ),
    ],
)
def test_bad_input_is_one_line(asked, message):
    with pytest.raises(SheetError) as error:
        find(lambda x, y: (x + y, x - y), **asked)
    assert str(error.value) == message


@pytest.mark.parametrize(
    "asked",
    [
        {"x": np.nan, "y": 1.0},
        {"x": (0.0, np.nan), "y": (0.0, 1.0)},
        {"x": 1.0, "y": 1.0, "equals": (np.nan, 0.0)},
        {"x": np.nan, "y": 1.0, "unit": ("m", "s")},
    ],
)
@pytest.mark.parametrize("ask", [find, minerr])
def test_what_rests_on_no_number_waits_with_the_reason(ask, asked):
    found = ask(lambda x, y: (x + y, x - y), **asked)
    says = "nothing to solve for x, y: an interval, a guess or a target is NaN"

    assert found.reason == says and found.waits and found.word() == "not evaluated"
    assert np.isnan(found.residual).all() and len(found.residual) == 2 and says in found._mime_()[1]
    with pytest.raises(Waits, match=says):
        _ = found.value


def test_a_target_without_a_number_leaves_its_neighbours_alone():
    found = find(lambda x, y: (x + y, x - y), x=1.0, y=1.0, equals=(np.array([2.0, np.nan]), 0.0))

    assert found.value.x[0] == 1 and np.isnan(found.value.x[1]) and found.waits.tolist() == [False, True]
    assert found.reason.tolist() == ["", "nothing to solve for x, y: an interval, a guess or a target is NaN"]


def test_equations_that_take_no_arrays_are_taken_one_by_one():
    found = find(lambda x, y: (math.sin(x) - y, x - 1), x=0.5, y=1.0)

    assert found.value.x == 1 and found.value.y == pytest.approx(math.sin(1), abs=1e-15)


def test_fewer_or_more_equations_than_unknowns_are_refused():
    with pytest.raises(SheetError, match=r"1 equation for 2 unknowns x, y: they do not determine them"):
        find(lambda x, y: x + y, x=1.0, y=1.0)
    with pytest.raises(SheetError, match=r"determine them: an array is one of as many problems, several are a tuple$"):
        minerr(lambda x, y: np.array([1.0, 2.0, 4.0]) - x - y * np.arange(3), x=1.0, y=1.0)
    with pytest.raises(ValueError, match=r"an equation is one number, several are a tuple$"):
        minerr(lambda x: np.array([x, x - 1]), x=1.0)
    with pytest.raises(SheetError, match="2 equations for 1 unknown x: minerr finds where their squares are least"):
        find(lambda x: (x, x - 1), x=1.0)


# --- least squares ---------------------------------------------------------------------------------------------------


@examples(30)
@given(st.lists(st.tuples(st.floats(-3, 3), st.floats(-3, 3)), min_size=3, max_size=8))
def test_a_line_through_points_is_that_of_linear_algebra_and_never_solved(data):
    t, y = np.array(data).T
    assume(np.ptp(t) > 0.1)
    found = minerr(lambda a, b: tuple(a + b * one for one in t), equals=tuple(y), a=1.0, b=1.0)

    assert np.allclose(found.value, np.linalg.lstsq(np.stack([t**0, t], 1), y)[0], rtol=0, atol=1e-7)
    assert found.solved is False and found.word() == "least squares" and found.reason == ""


def test_units_weigh_the_equations():
    def middle(units):
        return minerr(lambda x: (x, x), equals=(0, 1), unit=units, x=0.5).value.x

    assert middle("m") == pytest.approx(0.5, abs=1e-9)
    assert middle(("m", "mm")) == pytest.approx(1e6 / (1e6 + 1), rel=1e-9)


def test_intervals_give_the_least_of_several_minima():
    found = minerr(lambda x: ((x**2 - 1) * 3, x - 0.9), x=(-2, 2))

    assert found.value.x == pytest.approx(0.99732, abs=1e-4)
