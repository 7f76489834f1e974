"""Newton's method for several equations in several unknowns, for whole arrays of starts and problems at once.

Each start goes on in a trust region, so that it also gets past places where the slopes say nothing; where the equations
are more than the unknowns, it goes to the least sum of their squares. Unknowns and equations may be of any size: steps
are measured by the size of each unknown, residuals by what they change over it. Slopes are central differences, so
what is solved may itself compute with complex numbers. No start depends on the others.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mechsheet.mechanics.brackets import EPS, Array, Index, Mask

Equations = Callable[[Array], Array]  # of unknowns, shape (n, k, p), the residuals (m, k, p); NaN where there are none

_STEP = EPS ** (1 / 3)  # of differences, as a part of the unknown
_LEAST = 2.0**-6  # of its size: an unknown nearer to 0 counts as so large
_SMALL = 1e-6  # a step from which on only rounding can keep the residuals from falling
_LINEAR = 0.75  # and where it is shorter than so much of the one before, they still fall, if out of sight
_STUCK = 1e-12
_MOST = 100  # steps
_FREE = 20  # of Newton's own, whatever they lead to
_LEVEL = 1e-9  # cosine between the residuals and what any step changes, from which on none makes them less
_VARIED = 8  # floats by which an unknown is varied to see what rounding does
_ROUNDED = 8  # times that variation: what a residual may be
_NOISE = 2.0**-6  # of what an equation changes over the sizes: where it varies by more, there is nothing to solve


class Ended(NamedTuple):
    """Where each start of each problem ended: unknowns (n, s, p), residuals (m, s, p), slopes (m, n, s, p).

    ``evaluations`` counts values of all equations, shape (s, p); ``scale`` (m, s, p) is what each equation changes over
    the sizes of the unknowns at most.
    """

    x: Array
    r: Array
    slopes: Array
    scale: Array
    evaluations: Index

    @np.errstate(all="ignore")
    def condition(self, size: Array) -> Array:
        """Condition number of the slopes over the sizes and the largest scales of any start, shape (s, p).

        Infinite where the slopes are singular.
        """
        values = np.linalg.svd(self._over(size), compute_uv=False)
        condition: Array = values[..., 0] / values[..., -1]
        return np.where(condition < 1 / EPS, condition, np.inf)

    @np.errstate(all="ignore")
    def least_moving(self, size: Array) -> Array:
        """The way in sizes of the unknowns, shape (n, s, p), on which the slopes change the equations least."""
        way: Array = np.moveaxis(np.linalg.svd(self._over(size))[2][..., -1, :], -1, 0)
        return way

    def _over(self, size: Array) -> Array:
        largest = np.fmax.reduce(self.scale, axis=1)[:, None, None]
        return _known(_turned(self.slopes * size[:, None] / largest))

    def rows(self, chosen: NDArray[np.intp]) -> "Ended":
        """One start of each problem, shape (.., p); ``chosen`` (p) says which."""
        p = np.arange(chosen.size)
        x, r, slopes, scale = (a[..., chosen, p] for a in (self.x, self.r, self.slopes, self.scale))
        return Ended(x, r, slopes, scale, self.evaluations[chosen, p])


def first_or_second(first: Ended, second: Ended, chosen: Mask) -> Ended:
    """The first one of two where that is chosen, shape (s, p), else the second, with the evaluations of both."""
    x, r, slopes, scale = (
        np.where(chosen, getattr(first, name), getattr(second, name)) for name in ("x", "r", "slopes", "scale")
    )
    return Ended(x, r, slopes, scale, first.evaluations + np.where(chosen, 0, second.evaluations))


def joined(several: list[Ended]) -> Ended:
    """All starts of several lots."""
    x, r, slopes, scale = (
        np.concatenate([getattr(ended, name) for ended in several], axis=-2) for name in ("x", "r", "slopes", "scale")
    )
    return Ended(x, r, slopes, scale, np.concatenate([ended.evaluations for ended in several]))


@np.errstate(all="ignore")
def newton(
    f: Equations,
    x: Array,
    size: Array,
    lo: Array,
    hi: Array,
    reach: float,
    unit: Array | None = None,
    free: Array | None = None,
    only: Mask | bool = True,
) -> Ended:
    """Where f leads from the starts x, shape (n, s, p); without a number it stays, and so do all but the ``only`` ones.

    ``size`` (n, s, p) of the unknowns, ``lo`` and ``hi`` (n, 1, p) their ends, where steps end too; ``reach`` is how
    many sizes the first step goes at most. ``unit`` (m, 1, 1) weighs the residuals where their squares shall be least.
    With ``free`` a few steps are Newton's own, whatever they lead to, but move no unknown by more than that (n, 1, p).
    """
    n, x, r, sizes = len(x), x.copy(), f(x), np.broadcast_to(size, x.shape)
    moving: Mask = np.logical_and.reduce(np.isfinite(r)) & only
    evaluations = np.broadcast_to(only, moving.shape).astype(np.intp)
    slopes = np.full((len(r), *x.shape), np.nan)
    largest = np.zeros(r.shape)
    radius, before = np.full(moving.shape, reach), np.full(moving.shape, np.inf)
    fresh, sank = moving.copy(), moving.copy()
    for _ in range(_MOST if free is None else _FREE):
        k = np.flatnonzero(fresh.any(1))
        if k.size:
            new = differences(f, x[:, k], r[:, k], sizes[:, k], lo, hi)
            slopes[:, :, k] = np.where(fresh[k], new, slopes[:, :, k])
            evaluations += 2 * n * fresh
            moving &= ~fresh | np.isfinite(slopes).all((0, 1))
        if not moving.any():
            break
        i, j = np.nonzero(moving)  # of many problems most have ended when a few still go on
        at, own_size, slopes_at, low, high = x[:, i, j], sizes[:, i, j], slopes[:, :, i, j], lo[:, 0, j], hi[:, 0, j]
        scale = _scale(slopes_at, own_size) if unit is None else np.broadcast_to(unit[:, 0], (len(r), i.size))
        largest[:, i, j] = np.fmax(largest[:, i, j], scale)
        jacobian = _turned(slopes_at * own_size / scale[:, None])
        own = (r[:, i, j] / scale).T
        step, length, whole, slopes_there = _step(jacobian, own, at, low, high, radius[i, j])
        if free is not None:
            part = 1 / np.maximum(np.abs(step.T * own_size / free[:, 0, j]).max(0), 1)
            step, length = step * part[:, None], length * part
        stop = (whole <= _SMALL) & ~sank[i, j] & (whole > _LINEAR * before[i, j])
        target = np.clip(at + step.T * own_size, low, high)
        stop |= (target == at).all(0) | (own == 0).all(-1) | (radius[i, j] < _STUCK)
        stop |= _lowest(jacobian, own)
        moving[i, j] = active = ~stop
        fresh[:] = False
        if not active.any():
            continue
        target = np.where(active, target, at)
        k, row = np.unique(i, return_inverse=True)
        tried = x[:, k]
        tried[:, row, j] = target
        there = f(tried)[:, row, j]
        evaluations[i, j] += active
        gone = ((target - at) / own_size).T
        expected = _square(own) - _square(own + _applied(jacobian, gone))
        left = (there / scale).T
        fallen = _square(own) - _square(left)
        gain = np.where(fallen > 0, fallen / np.maximum(expected, np.finfo(float).tiny), -1)
        if unit is None:  # what is left to go by the same slopes may have become less where the residuals have not
            onward = _within(slopes_there, left, np.full(whole.shape, np.inf))[1]
            nearer = np.isfinite(left).all(-1) & (onward < whole - length / 4)
            gain = np.where(nearer, np.maximum(gain, 0.5), gain)
        sinks = active & (gain > 1e-4)
        taken = active & (sinks | (whole <= _SMALL) | (free is not None)) & np.isfinite(there).all(0)
        longest = radius[i, j]
        shrunk = np.where(gain < 0.25, length / 4, np.where(gain > 0.75, np.maximum(longest, 3 * length), longest))
        radius[i, j] = np.where(active & (free is None), shrunk, longest)
        moving[i, j] &= taken | (free is None)
        before[i, j], sank[i, j] = np.where(taken, whole, before[i, j]), np.where(active, sinks, sank[i, j])
        x[:, i, j], r[:, i, j] = np.where(taken, target, at), np.where(taken, there, r[:, i, j])
        fresh[i, j] = taken
    return Ended(x, r, slopes, largest, evaluations)


def differences(f: Equations, x: Array, r: Array, size: Array, lo: Array, hi: Array) -> Array:
    """Slopes of f at x, shape (m, n, s, p), inside the ends; one-sided where f has no number on the other side."""
    step = _STEP * np.maximum(np.abs(x), _LEAST * size)
    y, ends = _beside(f, x, step, lo, hi)
    none = ~np.isfinite(y)
    y = np.where(none, r[:, None, None], y)
    at = np.where(none, x, ends)
    slopes: Array = (y[:, 1] - y[:, 0]) / (at[:, 1] - at[:, 0])
    return slopes


@np.errstate(all="ignore")
def vanishing(f: Equations, ended: Ended, size: Array, lo: Array, hi: Array) -> Mask:
    """Which residuals, shape (m, s, p), are no more than rounding: what f varies by over the next floats.

    These are as far apart as those of the unknown, or of an eighth of its size; by its slopes f also varies where it is
    rounded to the same number at all of them. What is 0 all around is not solved, nor where from one float to the next
    f is nearly all that it is anywhere, as a sine of 1e20.
    """
    step = EPS * np.maximum(_VARIED * np.abs(ended.x), size)
    y = _beside(f, ended.x, step, lo, hi)[0].reshape(len(ended.r), -1, *ended.r.shape[1:])
    varied = np.fmax(np.fmax.reduce(y, axis=1), ended.r) - np.fmin(np.fmin.reduce(y, axis=1), ended.r)
    level = (varied == 0) & (ended.slopes == 0).all(1)
    by_slopes = (np.abs(ended.slopes) * step).sum(1)
    noise = (varied > _ROUNDED * by_slopes) & (varied > _NOISE * ended.scale)
    small: Mask = (np.abs(ended.r) <= _ROUNDED * np.fmax(varied, by_slopes)) & ~level & ~noise
    return small


def _beside(f: Equations, x: Array, step: Array, lo: Array, hi: Array) -> tuple[Array, Array]:
    """f with each unknown by itself a step lower and higher, shape (m, 2, n, s, p), and these unknowns (2, n, s, p)."""
    n = len(x)
    ends = np.stack([np.clip(x - step, lo, hi), np.clip(x + step, lo, hi)])
    at = np.broadcast_to(x[:, None, None], (n, 2, *x.shape)).copy()
    own = np.arange(n)
    at[own, :, own] = ends.swapaxes(0, 1)
    y = f(at.reshape(n, -1, x.shape[-1]))
    return y.reshape(len(y), 2, *x.shape), ends


def _step(
    jacobian: Array, r: Array, x: Array, lo: Array, hi: Array, radius: Array
) -> tuple[Array, Array, Array, tuple[Array, Array, Array]]:
    """The step within the radius, shape (q, n), its length, that of Newton's own step, and the slopes decomposed.

    Unknowns at an end do not leave it.
    """
    decomposed = np.linalg.svd(_known(jacobian), full_matrices=False)
    step, whole = _within(decomposed, r, radius)
    held = ((x <= lo).T & (step < 0)) | ((x >= hi).T & (step > 0))
    q = np.flatnonzero(held.any(1))
    if q.size:
        again = np.linalg.svd(_known(np.where(held[q, None], 0.0, jacobian[q])), full_matrices=False)
        for every, new in zip(decomposed, again, strict=True):
            every[q] = new
        step[q], whole[q] = _within(again, r[q], radius[q])
        step = np.where(held, 0.0, step)
    return step, np.sqrt(_square(step)), whole, decomposed


def _within(decomposed: tuple[Array, Array, Array], r: Array, radius: Array) -> tuple[Array, Array]:
    """The step within the radius by decomposed slopes, and the length of Newton's own step."""
    u, values, v = decomposed
    along = -np.einsum("...mk,...m->...k", u, _known(r))
    least = max(u.shape[-2], v.shape[-1]) * EPS * values[..., :1]
    parts = np.where(values > least, along / np.where(values > least, values, 1.0), 0.0)
    length = np.sqrt(_square(parts))
    q = np.flatnonzero(length > radius)
    if q.size:
        parts[q] = _shortened(values[q], along[q], radius[q])
    return np.einsum("...kn,...k->...n", v, parts), length


def _shortened(values: Array, along: Array, radius: Array) -> Array:
    """Steps that are damped until they are as long as the radius."""
    parts, damping = along, np.zeros(radius.shape)
    for _ in range(12):  # of Newton's method for the damping
        denominator = values**2 + damping[:, None]
        parts = np.where(denominator > 0, values * along / denominator, 0.0)
        slope = -_square(np.where(denominator > 0, parts / np.sqrt(denominator), 0.0))
        norm = np.sqrt(_square(parts))
        change = np.where(slope < 0, norm**2 / slope * (1 - norm / radius), 0.0)
        before, damping = damping, np.maximum(damping + change, 0.0)
        if (damping == before).all():
            break
    shortened: Array = parts * (radius / np.maximum(np.sqrt(_square(parts)), 1e-300))[:, None]
    return shortened


def _lowest(jacobian: Array, r: Array) -> Mask:
    """Whether the residuals, not 0, are as small as their slopes can make them."""
    along = np.einsum("...mn,...m->...n", jacobian, r)
    lowest: Mask = _square(along) <= _LEVEL**2 * np.einsum("...mn,...mn->...", jacobian, jacobian) * _square(r)
    return lowest


def _scale(slopes: Array, size: Array) -> Array:
    """What each equation changes over the sizes of the unknowns, shape (m, s, p); 1 where it does not."""
    scale = np.abs(slopes * size[None]).max(1)
    return np.where(scale > 0, scale, 1.0)


def _turned(slopes: Array) -> Array:
    return np.moveaxis(slopes, (0, 1), (-2, -1))


def _known(a: Array) -> Array:
    return np.where(np.isfinite(a), a, 0.0)


def _square(a: Array) -> Array:
    total: Array = np.einsum("...n,...n->...", a, a)
    return total


def _applied(jacobian: Array, step: Array) -> Array:
    result: Array = np.einsum("...mn,...n->...m", jacobian, step)
    return result
