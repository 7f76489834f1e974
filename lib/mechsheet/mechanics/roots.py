"""All roots of a function of one unknown in an interval, for whole arrays of problems at once.

An interval is sampled, cut at the edges between finite and NaN and at the local extremes, and so into monotone
pieces. A piece whose ends differ in sign is solved by bracketing; a cut that meets the target within rounding is
a touching root. Problems stand on the last axis, and ``f`` always gets the same problems in the same places; what a
problem gets does not depend on the others.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mechsheet.mechanics.arguments import first_of, unmasked
from mechsheet.mechanics.brackets import (
    EPS,
    Array,
    Function,
    Index,
    Mask,
    bracketed,
    extreme,
    last_finite,
    picked,
    slots,
    true,
    ulp,
)

_SAMPLES = 97  # of an interval, dense at its ends: features narrower than 1/60 of it can be missed
_PLACES = (1 - np.cos(np.linspace(0, np.pi, _SAMPLES)))[:, None] / 2
_RISE = 64  # a local extreme is looked for within so many times its height above the samples beside it
_PASSED = 2.0**-10  # and not where its sample has passed the target by so many times: there the sign changes tell
_OCTAVES = 8  # either way from the guess, the range searched for the reachable interval
_STEPS = 8  # samples in each octave
_RANGE = np.arange(-_OCTAVES * _STEPS, _OCTAVES * _STEPS + 1)[:, None] / _STEPS
_CLUSTER = 12  # samples between an edge and the next one
_BLOCK = 2**13  # values of f asked for at once: many more leave the processor's cache
_AROUND = np.array([-1, 0, 1])[:, None, None]
_SIDES = np.array([-1, 1])[:, None, None, None]
_BESIDE = 2.0 ** np.array([3, 4, 33])[:, None, None]  # floats off a root
_SCALES = np.linspace(0, 1, 16)[:, None, None]  # from the width of a bracket to the farthest place beside it
_FARTHEST = 2.0**33, 2.0**-20  # floats, or part of the interval
_AFTER = 1.25 ** np.arange(-2, 18)[:, None, None]  # times the place where the slope has made up for a rise
_TIED = 2.0**-30, 8 * EPS  # of a distance from the guess, and of the guess: two that differ by less are as near
_EXPLAINED = 8  # times what slope and rounding tell: a cubic root is as steep as that
_LEVEL = 4  # units in the last place: f that is nowhere farther off than that is the target everywhere
_ROUNDING = 2.0**-16  # of the range of f: what steps by more is not rounded


def real_values(f: Function, x: Array) -> Array:
    """f(x) as floats, NaN where not finite; probing out of reach is no reason for numpy's warnings."""
    with np.errstate(all="ignore"):
        y = unmasked(f(x))
    if y.dtype.kind not in "fiu":
        raise TypeError(f"the function to solve must return real numbers, not {first_of(y)}")
    infinite = np.isinf(y)
    return np.where(infinite, np.nan, y) if infinite.any() else y


class Counted:
    """f of x, shape (..., branches x problems), which knows how many of its values were computed."""

    def __init__(self, functions: list[Function], shape: tuple[int, ...]) -> None:
        self.functions, self.shape, self.count = functions, shape, 0

    def __call__(self, x: Array) -> Array:
        if x.size == 0:
            return x
        self.count += x.size
        columns = x.reshape(-1, len(self.functions), *self.shape)
        y = np.empty_like(columns)
        block = -(-len(columns) // max(1, round(x.size / len(self.functions) / _BLOCK)))
        for k, f in enumerate(self.functions):
            for i in range(0, len(columns), block):
                y[i : i + block, k] = real_values(f, columns[i : i + block, k])
        return y.reshape(x.shape)


@dataclass(frozen=True, eq=False)
class Roots:
    """Result for all columns c, branches x problems.

    ``roots`` has rows x, residual and bracket ends, shape (4, R, c), in ascending order, NaN where there is none;
    ``interval`` and ``reached`` have shape (2, c), ``jump`` (c), ``samples`` (c), the places at which f was looked at
    for all that; what it does between them is not known.
    """

    roots: Array
    interval: Array
    jump: Array
    void: Mask
    samples: NDArray[np.integer]
    pieces: "_Pieces"
    f: Counted

    def nearest(self, columns: Index, near: Array | None) -> tuple[Array, ...]:
        """The same as `nearest_root` for some columns: by default nearest to the middle of the interval."""
        lo, hi = self.interval[:, columns]
        return lo, hi, *_closest(self.roots[:, :, columns], lo / 2 + hi / 2 if near is None else near)

    @cached_property
    def reached(self) -> Array:
        """Least and greatest f; its extremes are looked for when this is read: where all is solved nobody asks."""
        with np.errstate(all="ignore"):
            x, y = self.pieces.x, self.pieces.y
            i, valid = slots(_turning(y))
            around = np.maximum(i, 1) + _AROUND
            top = extreme(self.f, picked(x, around), picked(y, around), valid, self.pieces.floor)[1]
            y = np.concatenate([y, np.where(valid, top, np.nan)])
            reached = np.stack([np.fmin.reduce(y), np.fmax.reduce(y)])
        reached[:, self.void] = np.nan
        return reached


class _Pieces(NamedTuple):
    """Monotone pieces of f in all columns: rows of x with f and the residual, some of which touch the target.

    ``cross`` marks the pieces, from each row to the next one, whose ends differ in sign, ``level`` the columns in which
    f is the target at all of three samples or more: there any x would do, and none is a root.
    """

    x: Array
    y: Array
    r: Array
    touch: Mask
    cross: Mask
    level: Mask
    equals: Array
    floor: Array
    samples: NDArray[np.integer]


@np.errstate(all="ignore")
def nearest_root(f: Counted, given: dict[str, Array]) -> tuple[Array, ...]:
    """The root nearest the guess of each column c: lo, hi, x, residual and bracket ends, NaN where there is none.

    ``given`` has ``equals`` and, of ``lo``, ``hi`` and ``guess``, what there is, all of shape (c): where an end is left
    out it is that of the finite f around the guess, and where the guess is, it is the middle.
    """
    lo, hi = _interval(f, given)
    near = given.get("guess", lo / 2 + hi / 2)
    pieces = _pieces(f, lo, hi, given["equals"])
    if pieces.touch.any():
        return lo, hi, *_closest(_roots(f, pieces)[0], near)
    i, valid = slots(pieces.cross)
    least = np.maximum(np.maximum(picked(pieces.x, i) - near, near - picked(pieces.x, i + 1)), 0)
    least = np.where(valid, least, np.inf)  # distance at which the root of a piece can lie
    root, distance = np.full((4, near.size), np.nan), np.full(near.size, np.inf)
    for _ in i:
        k = least.argmin(0)[None]
        active = np.isfinite(picked(least, k)) & (picked(least, k) <= distance + _play(distance, near))
        if not active.any():
            break
        new = _crossing(f, pieces, picked(i, k), active)[0][:, 0]
        further = np.abs(new[0] - near)
        tied = np.isfinite(root[0]) & (np.abs(further - distance) <= _play(distance, near))
        better = np.where(tied, new[0] < root[0], further < distance)
        root, distance = np.where(better, new, root), np.where(better, further, distance)
        least[k[0], np.arange(near.size)] = np.inf
    return lo, hi, *root


def _closest(roots: Array, near: Array) -> Array:
    """Of all roots of each column, rows as in `Roots`, the one nearest to a place, the first one of those as near."""
    off = np.fmin(np.abs(roots[0] - near), np.inf)
    least = off.min(0)
    nearest = (off <= least + _play(least, near)).argmax(0)
    closest: Array = roots[:, nearest, np.arange(near.size)]
    return closest


def _play(distance: Array, near: Array) -> Array:
    """By how much distances from the guess may differ by rounding."""
    return _TIED[0] * distance + _TIED[1] * np.abs(near)


@np.errstate(all="ignore")
def all_roots(f: Counted, given: dict[str, Array], void: Mask) -> Roots:
    """Everything about all columns c, NaN for the void ones; ``given`` as in `nearest_root`, ``void`` of shape (c)."""
    lo, hi = _interval(f, given)
    pieces = _pieces(f, lo, hi, given["equals"])
    roots, jump = _roots(f, pieces)
    interval = np.stack([lo, hi])
    for numbers in (roots, interval):
        numbers[..., void] = np.nan
    ends = 0 if "lo" in given and "hi" in given else len(_RANGE)
    return Roots(roots, interval, jump, void, ends + pieces.samples, pieces, f)


def _interval(f: Counted, given: dict[str, Array]) -> tuple[Array, Array]:
    """Ends of the interval given, or of the reachable one."""
    if "lo" in given and "hi" in given:
        return given["lo"], given["hi"]
    return reachable(f, given["guess"], given.get("lo"), given.get("hi"))


def _pieces(f: Counted, lo: Array, hi: Array, equals: Array) -> _Pieces:
    floor = EPS**2 * hi - EPS**2 * lo
    x = lo * (1 - _PLACES) + hi * _PLACES
    x[0], x[-1] = lo, hi
    y = f(x)
    if np.isnan(y).any():
        x, y = _with_edges(f, x, y)
    samples = 1 + (x[1:] != x[:-1]).sum(0, dtype=np.int32)
    r = y - equals
    turn = _turning(y)
    row, column = true(turn)
    own, beside = y[row, column], y[[row - 1, row + 1], column]
    rise = np.abs(own - beside).max(0)
    passed = np.where(own > beside[1], 1, -1) * r[row, column]
    turn[row, column] = (passed >= -_RISE * rise) & (passed <= _PASSED * rise)
    if turn.any():
        x, y, turn = _with_turns(f, x, y, turn, floor)
        r = y - equals
    touch, end = _touching(f, x, y, r, equals, turn, floor)
    below, above = r < 0, r > 0
    cross = (below[:-1] & above[1:]) | (above[:-1] & below[1:])
    inner = touch & ~end
    cross &= ~(inner[:-1] | inner[1:])  # beside a touching root the sign is rounding
    level = _level(r, equals)
    if level.any():
        level &= np.count_nonzero(~np.isnan(y), axis=0) > 2
        touch, cross = touch & ~level, cross & ~level
    return _Pieces(x, y, r, touch, cross, level, equals, floor, samples)


def _roots(f: Counted, pieces: _Pieces) -> tuple[Array, Array]:
    """All roots as in `Roots`, and the first jump over the target."""
    x, touch = pieces.x, pieces.touch
    crossing, jump = _crossing(f, pieces, *slots(pieces.cross))
    i, valid = slots(touch)
    at = picked(x, i)
    again = (np.abs(crossing[0] - at[:, None]) <= 2**12 * ulp(at, pieces.floor)[:, None]).any(1)  # beside an end
    touching = np.where(valid & ~again, np.stack([at, picked(pieces.r, i), at, at]), np.nan)
    roots = np.concatenate([crossing, touching, np.full((4, 1, x.shape[1]), np.nan)], axis=1)
    order = roots[0].argsort(axis=0, kind="stable")
    return roots[:, order, np.arange(x.shape[1])], jump


def reachable(f: Counted, guess: Array, lo: Array | None, hi: Array | None) -> tuple[Array, Array]:
    """The run of finite f around the finite sample nearest the guess, between the ends that are given."""
    k = _RANGE
    x = np.clip(guess * 2.0**k, lo, hi)
    y = f(x)
    finite = np.isfinite(y)
    row, bottom = np.arange(len(k))[:, None], len(k) - 1
    start = np.where(finite, np.abs(k), np.inf).argmin(0)
    first = np.where(~finite & (row < start), row + 1, 0).max(0)
    last = np.where(~finite & (row > start), row - 1, bottom).min(0)
    beyond = np.stack([np.maximum(first - 1, 0), np.minimum(last + 1, bottom)])
    closes = finite.any(0)
    run = np.where(closes, np.stack([first, last]), [[0], [bottom]])
    below, above = last_finite(f, x, y, run, np.where(closes, beyond, run))
    return below if lo is None else lo, above if hi is None else hi


def _with_edges(f: Counted, x: Array, y: Array) -> tuple[Array, Array]:
    """The samples with the edges between finite and NaN, and more samples towards each edge.

    f ends like a square root where a dyad stretches; samples spaced by squares see a smooth function.
    """
    finite = np.isfinite(y)
    i, valid = slots(finite[:-1] != finite[1:])
    inside = i + (valid & picked(finite, i + 1))
    edge = last_finite(f, x, y, inside, np.where(valid, 2 * i + 1 - inside, inside))
    more = edge + (picked(x, inside) - edge) * (np.arange(_CLUSTER) / _CLUSTER)[:, None, None] ** 2
    more_y = np.where(valid, f(more), np.nan)
    more = np.where(valid, more, x[0])  # what fills the rows sorts before the first sample
    x, y = np.concatenate([*more, x]), np.concatenate([*more_y, y])
    order = x.argsort(axis=0, kind="stable")
    return picked(x, order), picked(y, order)


def _turning(y: Array) -> Mask:
    """Samples that are local extremes: not beyond the one before, and not level with the next one."""
    turn = np.zeros(y.shape, dtype=bool)
    left, own, right = y[:-2], y[1:-1], y[2:]
    turn[1:-1] = ((own <= left) & (own < right)) | ((own >= left) & (own > right))
    return turn


def _level(r: Array, equals: Array) -> Mask:
    """Where f is the target everywhere, but for NaN."""
    least = _LEVEL * np.spacing(np.abs(equals))
    if (np.abs(r[:: len(r) - 1]) > least).any(0).all():  # as nearly always, and both ends tell
        return np.zeros(least.shape, dtype=bool)
    return np.asarray(np.fmax.reduce(np.abs(r)) <= least)


def _with_turns(f: Counted, x: Array, y: Array, turn: Mask, floor: Array) -> tuple[Array, Array, Mask]:
    """The samples with each of these local extremes of f in place of the sample beside it, and where they are."""
    i, valid = slots(turn)
    around = np.maximum(i, 1) + _AROUND
    where = i[valid], np.broadcast_to(np.arange(x.shape[1]), i.shape)[valid]
    x_turn, y_turn = extreme(f, picked(x, around), picked(y, around), valid, floor)
    x[where], y[where] = x_turn[valid], y_turn[valid]
    order = x.argsort(axis=0, kind="stable")
    return picked(x, order), picked(y, order), picked(turn, order)


def _touching(f: Counted, x: Array, y: Array, r: Array, equals: Array, turn: Mask, floor: Array) -> tuple[Mask, Mask]:
    """Which turns, ends and exact hits meet the target within what f varies over the next few floats; and the ends.

    On the calmer side of a turn, so that a jump beside it is no excuse.
    """
    out = np.ones((len(y) + 2, y.shape[1]), dtype=bool)
    out[1:-1] = np.isnan(y)
    end = (out[:-2] | out[2:]) & ~out[1:-1]
    row, column = true(end)
    next_ = np.where(out[row, column], row + 1, row - 1) % len(y)
    own, target = y[row, column], equals[column]
    unit = np.spacing(np.maximum(np.abs(own), np.abs(target)))
    touch = turn | (r == 0)
    touch[row, column] |= ~(np.abs(own - target) > np.abs(own - y[next_, column]) + unit)
    if not touch.any():
        return touch, end
    i, valid = slots(touch)
    at, own = picked(x, i), picked(y, i)
    near = at + np.array([[-1, -2, -4, -8], [1, 2, 4, 8]])[..., None, None] * ulp(at, floor)
    beside = f(np.clip(near, x[0], x[-1]))
    spread = np.fmax(np.fmax.reduce(beside, axis=1), own) - np.fmin(np.fmin.reduce(beside, axis=1), own)
    play = np.where(picked(end, i), spread.max(0), spread.min(0))
    unit = np.spacing(np.maximum(np.abs(own), np.abs(equals)))
    hit = valid & (np.abs(own - equals) <= play + unit)
    touch = np.zeros_like(turn)
    touch[i[hit], np.broadcast_to(np.arange(x.shape[1]), i.shape)[hit]] = True
    touch[1:] &= (r[1:] != 0) | (r[:-1] != 0)  # a run of zeros counts once
    return touch, end


def _crossing(f: Counted, pieces: _Pieces, i: Index, valid: Mask) -> tuple[Array, Array]:
    """Roots in the pieces i, shape (4, R, p) as in `Roots`, and the first jump.

    At a root the residual is small against what it is a little way off, at a pole it is not; and between the ends of
    the bracket it rises by no more than the slope beside them and rounding explain, at a jump by more.
    """
    x, r, equals, floor = pieces.x, pieces.r, pieces.equals, pieces.floor

    def g(u: Array) -> Array:
        return f(u) - equals

    last = len(x) - 1
    lower = np.abs(picked(r, i)) < np.abs(picked(r, np.minimum(i + 1, last)))
    third = np.where(lower, np.maximum(i - 1, 0), np.minimum(i + 2, last))
    rows = np.array([i, np.minimum(i + 1, last), third])
    ends, r_ends = bracketed(g, picked(x, rows), picked(r, rows), valid, floor)
    best = np.abs(r_ends[1]) < np.abs(r_ends[0])
    root, off = np.where(best, ends[1], ends[0]), np.where(best, r_ends[1], r_ends[0])
    ends, r_ends = np.where(off == 0, root, ends), np.where(off == 0, 0, r_ends)

    room = np.array([ends[0] - x[0], x[-1] - ends[1]])[:, None]
    beside = np.minimum(_BESIDE * ulp(root, floor), room)
    r_beside = g(ends[:, None] + _SIDES * beside)
    away = np.fmax.reduce(np.abs(r_beside[:, 2]), axis=0)
    unit = np.spacing(np.maximum(np.abs(equals), np.abs(off)))
    rise, width = np.abs(r_ends[1] - r_ends[0]), ends[1] - ends[0]
    slope = np.fmax.reduce(np.abs(r_beside[:, :2] - r_ends[:, None]) / beside[:, :2], axis=(0, 1))
    explained = rise <= _EXPLAINED * (width * slope + _bent(beside[:, :2], r_ends, r_beside[:, :2])) + 4 * unit
    if (valid & ~explained).any():
        far = np.maximum(_FARTHEST[0] * ulp(root, floor), _FARTHEST[1] * x[-1] - _FARTHEST[1] * x[0])
        rounding = _rounding(g, ends, r_ends, np.minimum(far, room[:, 0]))
        extent = np.fmax.reduce(pieces.y) - np.fmin.reduce(pieces.y)
        explained |= (rise <= _EXPLAINED * (width * slope + rounding)) & (rise <= _ROUNDING * extent)
    sound = explained & (np.abs(off) <= 4 * away + 4 * unit)
    roots = np.where(valid & sound, np.array([root, off, *ends]), np.nan)
    return roots, np.fmin.reduce(np.where(valid & ~sound, root, np.nan), axis=0, initial=np.nan)


def _rounding(g: Function, ends: Array, r_ends: Array, far: Array) -> Array:
    """What f is rounded by beside a bracket, no farther off than that: how much its values there are off a line.

    That is looked at where the slope has made up for the rise in the bracket, and a little farther: nearer f may be
    level between one rounded value and the next, much farther it may bend.
    """
    places = np.minimum(ends[1] - ends[0], far)[:, None] ** (1 - _SCALES) * far[:, None] ** _SCALES
    made_up = np.abs(g(ends[:, None] + _SIDES * places) - r_ends[:, None]) >= np.abs(r_ends[1] - r_ends[0]) / 2
    first = np.where(made_up.any(1), made_up.argmax(1), len(_SCALES) - 1)
    after = np.minimum(_AFTER * np.take_along_axis(places, first[:, None], 1), far[:, None])
    return _bent(after, r_ends, g(ends[:, None] + _SIDES * after))


def _bent(t: Array, r_0: Array, r: Array) -> Array:
    """How far a value is off the line through its neighbours at most, on either side; r_0 is that at t = 0."""
    t, r = np.concatenate([0 * t[:, :1], t], axis=1), np.concatenate([r_0[:, None], r], axis=1)
    line = r[:, :-2] + (r[:, 2:] - r[:, :-2]) * ((t[:, 1:-1] - t[:, :-2]) / (t[:, 2:] - t[:, :-2]))
    bent: Array = 2 * np.fmax.reduce(np.abs(r[:, 1:-1] - line), axis=(0, 1))
    return bent


def together(roots: Array, labels: list[int]) -> Iterator[tuple[NDArray[Any], ...]]:
    """The roots of all branches, in ascending order: x, residual, bracket ends, branch of each problem."""
    roots = roots.reshape(4, -1, roots.shape[2] // len(labels))
    order = roots[0].argsort(axis=0, kind="stable")
    for row in order[: np.isfinite(roots[0]).sum(0).max(initial=0)]:
        x, *more = roots[:, row, np.arange(row.size)]
        yield x, *more, np.where(np.isnan(x), 0, np.take(labels, row % len(labels)))
