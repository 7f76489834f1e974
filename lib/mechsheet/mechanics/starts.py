"""Seen of several equations in several unknowns, looked for from many starts, for whole arrays of problems at once.

The starts fill the intervals evenly, the same ones for all problems. As long as the last ones have led to a new
solution there are more of them; what lies where no start leads is not found, and nobody knows of it. Solutions at which
slopes are singular may be as many as there are starts, where equations depend on each other: they count as one.
"""

from typing import NamedTuple

import numpy as np

from mechsheet.mechanics.brackets import EPS, Array, Index, Mask
from mechsheet.mechanics.newton import Ended, Equations, first_or_second, joined, newton, vanishing

_STARTS = 32  # for each unknown, before it is asked whether more are needed
_MOST = 16  # times as many
_APART = 64  # roundings, times the condition, high at a double solution: ends nearer to each other are one solution
_FARTHEST = 2.0**-10  # and never farther apart than so many sizes of the unknowns
_FINE = 2.0**-10  # of its size: an unknown that small is looked for anew
_SINGULAR = 2.0**22  # condition from which on slopes may be singular but for the rounding of differences
_ASIDE = 2.0**-7  # of the sizes: how far off a solution another one is looked for then
_SEEN = 2.0**-4  # of an unknown is its size then at least: the two differ in the digits that are shown
_REACH = 100.0  # sizes that the first step from a guess goes at most


class Seen(NamedTuple):
    """The distinct solutions that were seen of all problems p, NaN where a problem has fewer.

    ``x`` (n, r, p), ``residual`` (m, r, p) and ``condition`` (r, p) stand in ascending order of the first unknown;
    ``starts`` (p) is the number of places from which they were looked for, ``evaluations`` (p) of all equations.
    ``nearest`` is the start that came nearest to a solution, by the part ``left`` (m, p) that each equation leaves of
    what it changes over the sizes of the unknowns; ``lowest`` are unknowns, residuals and condition there.
    """

    x: Array
    residual: Array
    condition: Array
    starts: Index
    evaluations: Index
    nearest: Ended
    left: Array
    lowest: tuple[Array, Array, Array]


class Place(NamedTuple):
    """Where unknowns are looked for, all of shape (n, p): first and last start, size, the least one, and ends.

    An unknown is taken to be as large as its size until it is found, then as itself, but no smaller than the least.
    ``most`` is how far a step of Newton's own from a guess moves it at most.
    """

    first: Array
    last: Array
    size: Array
    least: Array
    most: Array
    lo: Array
    hi: Array


def from_guess(f: Equations, at: Place, unit: Array | None) -> Seen:
    """Where the first start itself leads; with a ``unit`` to where the residuals' squares are least.

    These are Newton's own steps where a few of them, none too long, lead to a solution, else those in a trust region.
    """
    guess = at.first[:, None]
    if unit is not None:
        ended, held = _led(f, guess, at, _REACH, unit)
        return _distinct([ended], [held], at.size)
    ended, held = _led(f, guess, at, np.inf, None, at.most[:, None])
    if not held.all():
        more, held_then = _led(f, guess, at, _REACH, None, only=~held)
        ended, held = first_or_second(ended, more, held), held | held_then
    return _distinct([ended], [held], at.size)


def around(f: Equations, at: Place) -> Seen:
    """What starts within a size of the first one lead to."""
    ended, held = _batch(f, at._replace(first=at.first - at.size, last=at.first + at.size), 0, None)
    return _distinct([ended], [held], at.size)


def between(f: Equations, at: Place, unit: Array | None) -> Seen:
    """What starts all over the places lead to."""
    batches, holding = list[Ended](), list[Mask]()
    searching = np.ones(at.first.shape[1], dtype=bool)
    seen = starts = np.zeros(at.first.shape[1], dtype=np.intp)
    while searching.any() and len(batches) < _MOST:
        ended, held = _batch(f, at, len(batches), unit, searching)
        batches.append(ended)
        holding.append(held)
        starts = starts + len(held) * searching
        known = _distinct(batches, holding, at.size)
        singular = known.condition > _SINGULAR
        found = (~np.isnan(known.x[0]) & ~singular).sum(0) + singular.any(0)
        searching = searching & (found > seen)
        seen = found
    return known._replace(starts=starts)


def aside(f: Equations, at: Place, x: Array, condition: Array) -> Array:
    """Another solution right beside each of these, shape (n, p), NaN where there is none.

    Where there is one, equations depend on each other: all along a line the unknowns solve them. At a double solution
    slopes are singular too, but what starts beside it comes back.
    """
    singular = condition > _SINGULAR
    if not singular.any():
        return np.full_like(x, np.nan)
    own, unit = np.where(singular, x, at.first)[:, None], np.fmax(at.size, _SEEN * np.abs(x))[:, None]
    way = _led(f, own, at, 1.0, None, only=singular)[0].least_moving(unit[:, 0])
    ended, held = _led(f, own + np.array([-1, 1])[:, None] * _ASIDE * unit * way, at, 1.0, None, only=singular)
    off = np.abs((ended.x - own) / unit).max(0)
    held &= singular & (off > _ASIDE / 4) & (off < 4 * _ASIDE)
    other: Array = ended.x[:, held.argmax(0), np.arange(singular.size)]
    return np.where(held.any(0), other, np.nan)


def _batch(f: Equations, at: Place, number: int, unit: Array | None, only: Mask | bool = True) -> tuple[Ended, Mask]:
    """Where one more lot of starts ends, and which of them in a solution."""
    count = _STARTS * len(at.first)
    share = _spread(len(at.first), number * count, count)[:, :, None]
    return _led(f, at.first[:, None] * (1 - share) + at.last[:, None] * share, at, 1.0, unit, only=only)


def _led(
    f: Equations,
    x: Array,
    at: Place,
    reach: float,
    unit: Array | None,
    free: Array | None = None,
    only: Mask | bool = True,
) -> tuple[Ended, Mask]:
    """Where starts end, and which of the ``only`` ones that are asked for in a solution, shape (s, p)."""
    size, least, lo, hi = (a[:, None] for a in (at.size, at.least, at.lo, at.hi))
    ended = newton(f, x, size, lo, hi, reach, unit, free, only)
    small: Mask = np.logical_or.reduce(np.maximum(np.abs(ended.x), least) < _FINE * size) & only
    if small.any() and unit is None:  # steps were too coarse for it
        finer = np.maximum(np.abs(ended.x), least)
        again = newton(f, ended.x, finer, lo, hi, np.inf, free=np.full_like(hi, np.inf), only=small)
        ended = first_or_second(ended, again, ~small)
    held: Mask = np.logical_and.reduce(vanishing(f, ended, np.maximum(np.abs(ended.x), least), lo, hi))
    return ended, held & only & (unit is None)


def _spread(n: int, first: int, count: int) -> Array:
    """Places that fill a unit cube evenly, shape (n, count), as Roberts has it: steps by powers of a golden ratio."""
    golden = 2.0
    for _ in range(64):
        golden = (1 + golden) ** (1 / (n + 1))
    step = golden ** -np.arange(1.0, n + 1)
    places: Array = (0.5 + step[:, None] * np.arange(first, first + count)) % 1
    return places


def _distinct(batches: list[Ended], holding: list[Mask], size: Array) -> Seen:
    """The solutions that are not the same as another one, within rounding times the condition of both."""
    whole, held = joined(batches), np.concatenate(holding)
    p, condition = np.arange(held.shape[1]), whole.condition(size)
    radius = _radius(condition)
    kept: list[tuple[Array, Array, Array]] = []
    for s in np.flatnonzero(held.any(1)):
        new = held[s].copy()
        if kept:
            others, conditions = np.stack([k[0] for k in kept]), np.stack([k[2] for k in kept])
            near = np.fmax(_radius(conditions), radius[s])
            new &= ~(np.abs(whole.x[:, s] - others) <= near[:, None] * size).all(1).any(0)
        if new.any():
            x, r, own = (np.where(new, a, np.nan) for a in (whole.x[:, s], whole.r[:, s], condition[s]))
            kept.append((x, r, own))
    none = np.full_like(whole.x[:, 0], np.nan), np.full_like(whole.r[:, 0], np.nan), np.full_like(condition[0], np.nan)
    x, r, own = (np.stack(parts, axis=-2) for parts in zip(*(kept or [none]), strict=True))
    order = np.argsort(x[0], axis=0, kind="stable")
    with np.errstate(all="ignore"):
        left = np.abs(whole.r) / np.fmax.reduce(whole.scale, axis=1)[:, None]  # what is large nowhere is small
        nearest = np.where(np.isfinite(left).all(0), (left**2).sum(0), np.inf).argmin(0)
    return Seen(
        x[:, order, p],
        r[:, order, p],
        own[order, p],
        np.full(p.size, len(held)),
        whole.evaluations.sum(0),
        whole.rows(nearest),
        left[:, nearest, p],
        (whole.x[:, nearest, p], whole.r[:, nearest, p], condition[nearest, p]),
    )


def _radius(condition: Array) -> Array:
    """How far apart in sizes of the unknowns two ends of one solution may be."""
    return np.minimum(_APART * EPS * np.minimum(condition, 1 / EPS), _FARTHEST)
