"""Seen of several equations in several unknowns, looked for from many starts, for whole arrays of problems at once.

The starts fill the intervals evenly, the same ones for all problems. As long as the last ones have led to a new
solution there are more of them; what lies where no start leads is not found, and nobody knows of it.
"""

from dataclasses import dataclass, replace

import numpy as np

from mechsheet.mechanics.brackets import EPS, Array, Index, Mask
from mechsheet.mechanics.newton import Ended, Equations, joined, newton, vanishing

_STARTS = 32  # for each unknown, before it is asked whether more are needed
_MOST = 16  # times as many
_APART = 64  # roundings, times the condition, high at a double solution: ends nearer to each other are one solution
_FARTHEST = 2.0**-10  # and never farther apart than so many sizes of the unknowns
_REACH = 100.0  # sizes that the first step from a guess goes at most


@dataclass(frozen=True)
class Seen:
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


def from_guess(f: Equations, guess: Array, size: Array, lo: Array, hi: Array, unit: Array | None) -> Seen:
    """Where the guess itself leads; all of shape (n, p). With a ``unit`` the residuals' squares shall be least."""
    ended = newton(f, guess[:, None], size[:, None], lo[:, None], hi[:, None], _REACH, unit)
    return _distinct([ended], [_held(f, ended, size, lo, hi, unit)], size)


def around(f: Equations, guess: Array, size: Array, lo: Array, hi: Array) -> Seen:
    """What starts within a size of the guess lead to."""
    ended = _batch(f, guess - size, guess + size, size, lo, hi, 0, None)
    return _distinct([ended], [_held(f, ended, size, lo, hi, None)], size)


def between(f: Equations, low: Array, high: Array, size: Array, lo: Array, hi: Array, unit: Array | None) -> Seen:
    """What starts all over the places from ``low`` to ``high`` lead to."""
    batches, holding = list[Ended](), list[Mask]()
    searching = np.ones(low.shape[1], dtype=bool)
    seen = starts = np.zeros(low.shape[1], dtype=np.intp)
    while searching.any() and len(batches) < _MOST:
        batches.append(_batch(f, low, high, size, lo, hi, len(batches), unit))
        holding.append(_held(f, batches[-1], size, lo, hi, unit) & searching)
        starts = starts + len(holding[-1]) * searching
        known = _distinct(batches, holding, size)
        found = (~np.isnan(known.x[0])).sum(0)
        searching = searching & (found > seen)
        seen = found
    return replace(known, starts=starts)


def _batch(
    f: Equations, low: Array, high: Array, size: Array, lo: Array, hi: Array, number: int, unit: Array | None
) -> Ended:
    """Where one more lot of starts between low and high ends."""
    count = _STARTS * len(low)
    places = _spread(len(low), number * count, count)[:, :, None]
    x = low[:, None] * (1 - places) + high[:, None] * places
    return newton(f, x, size[:, None], lo[:, None], hi[:, None], 1.0, unit)


def _held(f: Equations, ended: Ended, size: Array, lo: Array, hi: Array, unit: Array | None) -> Mask:
    """Which starts end in a solution."""
    held: Mask = np.logical_and.reduce(vanishing(f, ended, size[:, None], lo[:, None], hi[:, None]))
    return held & (unit is None)


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
