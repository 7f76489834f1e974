"""Jumps of any size are no roots; steep, noisy and rounded functions have theirs; what was sampled is named so."""

import numpy as np
import pytest

from mechsheet.worksheet.find import find

SIZES = 10.0 ** np.arange(-14, 4)  # of a jump, as a part of what the smooth function is between 0 and its root


def noise(x):
    """Numbers between -1 and 1 that follow from the bits of x and look random."""
    with np.errstate(over="ignore"):
        bits = np.asarray(x, float)[..., None].view(np.uint64)[..., 0] * np.uint64(0x9E3779B97F4A7C15)
    return (bits >> np.uint64(11)) / 2.0**52 - 1


def with_jump(smooth, at, size, under=0.5):
    """The function with a jump over its root, so much of it below."""
    return lambda x: smooth(x) + size * np.where(x < at, -under, 1 - under)


def roots_near(f, at, within, lo=0.0, hi=1.0):
    return [root.value for root in find(f, lo, hi).roots if abs(root.value - at) <= within]


SMOOTH = {
    "line": lambda x: x,
    "sine": np.sin,
    "exponential": np.expm1,
    "bent": lambda x: x + 3 * x**2,
}


@pytest.mark.parametrize("under", [0.5, 0.9])
@pytest.mark.parametrize("slope", [1e-3, 1.0, 50.0])
@pytest.mark.parametrize("shape", SMOOTH)
def test_a_jump_of_any_size_is_no_root(shape, slope, under):
    """All places and sizes at once: each is a problem of its own."""
    at, size = map(np.ravel, np.broadcast_arrays(np.array([[0.3], [0.7], [0.0123]]), SIZES))
    f = with_jump(lambda x: SMOOTH[shape](slope * (x - at)), at, size * slope * at, under)
    found = find(f, np.zeros(at.size), 1.0, guess=1.001 * at)
    with np.errstate(invalid="ignore"):
        wrong = found.solved & (abs(found.value - at) <= 1e-13)
    assert not wrong.any(), [*zip(at[wrong], size[wrong], strict=True)]


@pytest.mark.parametrize("flat", [lambda x: 0 * x, lambda x: (x - 0.3) ** 3], ids=["level", "cubic"])
def test_a_jump_without_a_slope_is_no_root(flat):
    assert [size for size in SIZES if roots_near(with_jump(flat, 0.3, size), 0.3, 1e-13)] == []


def test_a_jump_is_named_with_its_place():
    found = find(with_jump(lambda x: x - 0.3, 0.3, 2e-6), 0, 1)
    assert found.reason == "unknown x: f(x) reaches -0.3..0.7 by 97 samples but jumps over 0 at 0.3"


@pytest.mark.parametrize("to", [1e-300, 1e-200, 1e-30, 1e30, 1e200, 1e300])
def test_a_jump_at_any_scale_is_no_root_and_a_root_is_one(to):
    assert not find(with_jump(lambda x: x / to - 0.3, 0.3 * to, 2e-9), 0.0, to).solved
    assert find(lambda x: x / to - 0.3, 0.0, to).value == pytest.approx(0.3 * to, rel=1e-15)
    assert find(lambda x: x - 0.3 * to, -to, to).value == pytest.approx(0.3 * to, rel=1e-15)


def test_the_widest_interval_does_not_overflow():
    assert find(lambda x: x - 3e299, -1.7e308, 1.7e308).value == 3e299
    assert find(lambda x: np.cbrt(x) - 1e100, -1.7e308, 1.7e308).value == pytest.approx(1e300, rel=1e-15)


LEGITIMATE = {
    "a step of 1e-12": lambda x: np.tanh(1e12 * (x - 0.3)),
    "a step of a few floats": lambda x: np.tanh(3e15 * (x - 0.3)),
    "a steep line": lambda x: 1e18 * (x - 0.3),
    "a level line": lambda x: 1e-290 * (x - 0.3),
    "infinite slope": lambda x: np.cbrt(x - 0.3),
    "of the power 1/2": lambda x: np.sign(x - 0.3) * np.sqrt(abs(x - 0.3)),
    "of the power 1/4": lambda x: np.sign(x - 0.3) * abs(x - 0.3) ** 0.25,
    "a kink": lambda x: np.where(x < 0.3, 1e-9 * (x - 0.3), 1e3 * (x - 0.3)),
    "level on one side": lambda x: np.where(x < 0.3, -1e-300, x - 0.3),
    "a triple root": lambda x: (x - 0.3) ** 3,
    "a triple root, expanded": lambda x: x**3 - 0.9 * x**2 + 0.27 * x - 0.027,
    "single precision": lambda x: np.float32(x) - 0.3,
    "rounded far from the origin": lambda x: (1e8 + x) - 1e8 - 0.3,
    "half of it rounded": lambda x: 0.5 * x + ((1e8 + x) - 1e8) - 0.45,
    "rounded against the slope": lambda x: -0.5 * x + ((1e8 + x) - 1e8) - 0.15,
    "rounded beside the slope": lambda x: 0.5 * x + abs((1e5 + x) * np.exp(1j * x) - 1e5 * np.exp(1j * x)) - 0.45,
    "a difference of cosines": lambda x: np.cos(0.3) - np.cos(x),
    **{f"noise of {size:g}": lambda x, size=size: x - 0.3 + size * noise(x) for size in (1e-14, 1e-12, 1e-9, 1e-6)},
    "coarse noise": lambda x: x - 0.3 + 1e-10 * noise(np.round(x, 9)),
}


@pytest.mark.parametrize("name", LEGITIMATE)
def test_what_is_steep_noisy_or_rounded_has_its_root(name):
    assert roots_near(LEGITIMATE[name], 0.3, 2e-5), find(LEGITIMATE[name], 0.0, 1.0).reason


def test_noise_in_treads_is_no_jump():
    """Rounded values that stay for some floats, as of a term far from the origin, whatever their size and place."""
    rng = np.random.default_rng(1)
    at, tread = rng.uniform(0.05, 0.95, 400), 10.0 ** rng.uniform(-16, -8, 400)
    own = rng.uniform(0, 0.9, 400) * (rng.random(400) < 0.5)  # part of the slope that is not rounded

    def f(x):
        steps = np.round(x / tread)
        return own * (x - at) + (1 - own) * (tread * (steps + noise(steps)) - at)

    found = find(f, np.zeros(400), 1.0)
    assert found.solved.all() and np.all(abs(found.value - at) < 4 * tread + 1e-15)


def test_a_root_near_zero_of_what_is_rounded_near_one():
    assert find(lambda x: (1 + x) - 1 - 1e-20, -1.0, 1.0).solved


# What was only sampled


def test_what_stands_between_the_samples_is_not_denied():
    def dip(x):
        return np.where(abs(x - 0.5173) < 5e-4, 0.0, 1.0)

    def island(x):
        return np.where(abs(x - 0.5173) < 5e-4, x, np.nan)

    assert find(dip, 0, 1, equals=0.5).reason == "unknown x: f(x) reaches 1 by 97 samples, 0.5 is outside"
    assert find(island, 0, 1, equals=0.5).reason.startswith("unknown x: f(x) is NaN at each of 97 samples in 0..1")
    many = find(lambda x: np.sin(1000 * x), 0, 1)
    assert 0 < len(many.roots) < 318
    assert f"roots seen by {many.samples} samples" in str(many) and "all roots" not in str(many)


def test_samples_are_the_places_that_were_looked_at():
    seen = []

    def f(x):
        seen.append(np.ravel(x))
        return np.where(x < 0.1, np.nan, x)

    found = find(f, 0.0, 1.0, equals=2.0)
    assert 97 < found.samples <= np.unique(np.concatenate(seen)).size
    assert find(f, 0.2, 1.0, equals=2.0).samples == 97
