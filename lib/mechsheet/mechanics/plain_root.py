"""The root nearest a guess, of one problem in which nothing is out of the ordinary, by single floats.

It looks at the function where `roots` does and by the same measures, at the 97 samples at once and at single places
after that. Whatever `roots` would look into more closely, it leaves to that: a sample that is no number, a turn or an
end near the target, a sign change that may be a jump or is level or rounded, no root.
"""

from collections.abc import Callable
from math import isfinite, ulp

import numpy as np

from mechsheet.mechanics.brackets import EPS, Array
from mechsheet.mechanics.roots import _BESIDE, _EXPLAINED, _PASSED, _PLACES, _RISE, Counted, reachable

Single = Callable[[float], float]
_HIGH = _PLACES[:, 0].copy()
_LOW = 1 - _HIGH
_NEAR, _FAR = float(_BESIDE.min()), float(_BESIDE.max())
_MOST = 100  # steps


class NotPlain(Exception):
    """A problem that only `roots` can answer."""


def plain_root(
    many: Callable[[Array], Array], f: Single, lo: float | None, hi: float | None, guess: float | None, equals: float
) -> float:
    """x in lo..hi with f(x) = equals, nearest the guess; ``many`` is f of an array.

    An end that is not given is that of the reachable interval. Raises NotPlain where it cannot tell as surely as
    `nearest_root`.
    """
    if lo is None or hi is None:
        lo, hi = _reached(many, lo, hi, guess)
    if not (isfinite(lo) and isfinite(hi) and lo < hi and isfinite(equals)):
        raise NotPlain
    x = lo * _LOW + hi * _HIGH
    x[0], x[-1] = lo, hi
    y = many(x)
    r = y - equals
    above = r > 0
    if not (np.isfinite(r).all() and r.all()):
        raise NotPlain
    _refuse_touching(y, equals)
    changes = np.flatnonzero(above[1:] != above[:-1]).tolist()
    near, floor = lo / 2 + hi / 2 if guess is None else guess, EPS**2 * hi - EPS**2 * lo
    pieces = [(float(x[i]), float(x[i + 1]), float(r[i]), float(r[i + 1])) for i in changes]
    found, distance = np.nan, np.inf
    for least, a, b, r_a, r_b in sorted((max(a - near, near - b, 0.0), a, b, r_a, r_b) for a, b, r_a, r_b in pieces):
        if least > distance:
            break
        root = _root(lambda u: f(u) - equals, (a, b, r_a, r_b), (lo, hi), floor, equals)
        if (abs(root - near), root) < (distance, found):
            found, distance = root, abs(root - near)
    if not isfinite(distance):
        raise NotPlain
    return found


def _reached(
    many: Callable[[Array], Array], lo: float | None, hi: float | None, guess: float | None
) -> tuple[float, float]:
    """The reachable interval around the guess."""
    if guess is None or not 0 < guess < np.inf or not (lo is None or lo < guess) or not (hi is None or guess < hi):
        raise NotPlain
    one = (np.array([given]) if given is not None else None for given in (guess, lo, hi))
    ends = reachable(Counted([many], (1,)), *one)  # type: ignore[arg-type]  # there is a guess
    return ends[0].item(), ends[1].item()


def _refuse_touching(y: Array, equals: float) -> None:
    """Raise NotPlain where a local extreme or an end is so near the target that it may touch it."""
    step = y[1:] - y[:-1]
    turns = np.flatnonzero(step[:-1] * step[1:] <= 0).tolist()
    for i in turns:
        left, own, right = y[i : i + 3].tolist()
        rise = max(abs(own - left), abs(own - right))
        passed = (own - equals) * (1 if own > right else -1)
        if -_RISE * rise <= passed <= _PASSED * rise:
            raise NotPlain
    for own, beside in (y[:2].tolist(), y[:-3:-1].tolist()):
        if abs(own - equals) <= abs(own - beside) + ulp(max(abs(own), abs(equals))):
            raise NotPlain


def _root(
    g: Single, piece: tuple[float, float, float, float], ends: tuple[float, float], floor: float, equals: float
) -> float:
    """The root between two places at which g has unlike signs; NotPlain where it may be a jump."""
    a, b, r_a, r_b = _bracketed(g, *piece, floor)
    root, off = (b, abs(r_b)) if abs(r_b) < abs(r_a) else (a, abs(r_a))
    unit, scale, rises = ulp(max(abs(equals), off)), EPS * abs(root) + floor, piece[3] > 0
    sides = [(b, r_b, min(1.0, (ends[1] - b) / (_FAR * scale))), (a, r_a, -min(1.0, (a - ends[0]) / (_FAR * scale)))]
    far = [(g(end + part * _FAR * scale), part) for end, _, part in sides if part]
    steps = [(end, r, np.sign(part) * min(_NEAR, abs(part) * _FAR) * scale) for end, r, part in sides if part]
    near = [(g(end + d), r, d) for end, r, d in steps]
    if any(not value or (value > 0) != ((side > 0) == rises) for value, *_, side in (*far, *near)):
        raise NotPlain  # about a root that is level or rounded there are many more
    if off and not any(off <= 4 * abs(value) + 4 * unit for value, _ in far):
        raise NotPlain
    rise = abs(r_b - r_a)
    if off and rise > 4 * unit and not any(rise <= _EXPLAINED * (b - a) * abs((value - r) / d) for value, r, d in near):
        raise NotPlain
    return root


def _bracketed(
    g: Single, a: float, b: float, r_a: float, r_b: float, floor: float
) -> tuple[float, float, float, float]:
    """The last bracket, four floats wide, by Brent's method; its lower end first. Zero is looked at first."""
    if a < 0 < b:
        r = g(0.0)
        if r == 0 or (r > 0) == (r_b > 0):
            b, r_b = 0.0, r
        else:
            a, r_a = 0.0, r
    c, r_c, step = a, r_a, b - a
    before = step
    for _ in range(_MOST):
        if (r_b > 0) == (r_c > 0):
            c, r_c, step = a, r_a, b - a
            before = step
        if abs(r_c) < abs(r_b):
            a, b, c, r_a, r_b, r_c = b, c, b, r_b, r_c, r_b
        near, half = 2 * (EPS * abs(b) + floor), (c - b) / 2
        if abs(half) <= near or r_b == 0:
            return (b, c, r_b, r_c) if b < c else (c, b, r_c, r_b)
        if abs(before) < near or abs(r_a) <= abs(r_b):
            step = before = half
        else:
            s = r_b / r_a
            if a == c:
                p, q = 2 * half * s, 1 - s
            else:
                t, u = r_a / r_c, r_b / r_c
                p, q = s * (2 * half * t * (t - u) - (b - a) * (u - 1)), (t - 1) * (u - 1) * (s - 1)
            q = -q if p > 0 else q
            p = abs(p)
            if 2 * p < min(3 * half * q - abs(near * q), abs(before * q)):
                before, step = step, p / q
            else:
                step = before = half
        a, r_a = b, r_b
        b += step if abs(step) > near else (near if half > 0 else -near)
        r_b = g(b)
    raise NotPlain
