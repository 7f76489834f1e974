"""Closing in on an edge, an extreme or a change of sign of a function, for whole arrays of problems at once.

Samples of a function stand on axis 0, problems on the last one; what is looked for in the same problem has a slot each
on the axis between. No step of a slot depends on another one. Every search goes on to the last floats.
"""

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]
Index = NDArray[np.intp]
Function = Callable[[Array], Array]

EPS = float(np.finfo(float).eps)
# Where the next points of a bracket go: fractions of its width, from its low end and from a predicted place.
_COARSE = np.linspace(0, 1, 9)[1:-1, None, None]
_FINE = np.concatenate([-(8.0 ** -np.arange(2, 6)), [0], 8.0 ** -np.arange(2, 6)])[:, None, None]
_BACK = np.array([-3, -2, -1])[:, None, None]
_EIGHTHS = np.arange(1, 8)[:, None, None] / 8
_SIDES = np.array([-1, -1, -1, 0, 1, 1, 1])[:, None, None]
_NEARER = 2.0 ** np.array([0, -5, -10, 0, -10, -5, 0])[:, None, None]  # parts of a distance
_LEAST = np.array([32, 8, 2, 0, 2, 8, 32])[:, None, None]  # floats
_MANY = np.arange(1, 16)[:, None, None] / 16


def last_finite(f: Function, x: Array, y: Array, inside: Index, outside: Index) -> Array:
    """The last float at which f is finite on the way from row ``inside``, where it is, to row ``outside``.

    Where a dyad stretches, x is a parabola in f, whose vertex is the edge.
    """
    way = np.where(outside < inside, -1, 1)
    rows = np.clip(inside - way * np.array([2, 1, 0])[:, None, None], 0, len(x) - 1)
    rows = np.where(np.isfinite(picked(y, rows)), rows, inside)
    x, y, out = way * picked(x, rows), picked(y, rows), way * picked(x, outside)  # the way is up now
    while True:
        last = x[2]
        active = np.nextafter(last, out) < out
        if not active.any():
            edge: Array = way * last
            return edge
        slope = (x[1] - last) / (y[1] - y[2])
        bend = ((x[0] - x[1]) / (y[0] - y[1]) - slope) / (y[0] - y[2])
        to_vertex = (y[1] - y[2] - slope / bend) / 2
        vertex = last + to_vertex * (slope + bend * (to_vertex + y[2] - y[1]))
        x_all, y_all = _closer(lambda u: f(way * u), x, y, last, np.where(active, out, last), vertex)
        k = np.logical_and.accumulate(np.isfinite(y_all)).sum(0)
        out = np.where(active, taken(np.concatenate([x_all, out[None]]), k[None])[0], out)
        x, y = (np.where(active, taken(v, k + _BACK), v_old) for v, v_old in ((x_all, x), (y_all, y)))


def extreme(f: Function, x: Array, y: Array, active: Mask, floor: Array) -> tuple[Array, Array]:
    """The extreme of f between three points whose middle value is the least or the greatest.

    The next one is near the vertex of the parabola through the three. Its neighbours must rise above it by more
    than rounding; where that no longer narrows the three, f is level.
    """
    sign = np.where(y[1] > np.fmin(y[0], y[2]), -1, 1)
    y = sign * y
    while active.any():
        low, mid, high = x
        p, q = (mid - low) * (y[1] - y[2]), (mid - high) * (y[1] - y[0])
        vertex = mid - ((mid - low) * p - (mid - high) * q) / (2 * (p - q))
        x_all, y_all = _closer(lambda u: sign * f(u), x, y, low, np.where(active, high, low), vertex)
        best = np.fmin(y_all, np.inf).argmin(0)
        row = np.arange(len(x_all))[:, None, None]
        above = y_all > taken(y_all, best[None]) + 4 * EPS * np.abs(y).max(0)
        left = np.where(above & (row < best), row, 0).max(0)
        right = np.where(above & (row > best), row, row[-1]).min(0)
        rows = np.stack([left, best, right])
        x, y = (np.where(active, taken(v, rows), v_old) for v, v_old in ((x_all, x), (y_all, y)))
        active = active & (x[2] - x[0] < (high - low) / 2) & (x[2] - x[0] > 4 * ulp(mid, floor))
    return x[1], sign * y[1]


def _closer(f: Function, x: Array, y: Array, low: Array, high: Array, near: Array) -> tuple[Array, Array]:
    """The points x, y and more between low and high: a coarse comb, and a fine one around a predicted place."""
    width = high - low
    near = np.where((low < near) & (near < high), near, low / 2 + high / 2)
    two = 2 * EPS * np.abs(near)
    new = np.concatenate([low * (1 - _COARSE) + high * _COARSE, near + _FINE * width, [near - two, near + two]])
    new = np.clip(new, low, high)
    x, y = np.concatenate([x, new]), np.concatenate([y, f(new)])
    order = x.argsort(axis=0, kind="stable")
    return taken(x, order), taken(y, order)


def bracketed(g: Function, x: Array, r: Array, active: Mask, floor: Array) -> tuple[Array, Array]:
    """The final brackets of the roots between x[0] and x[1], whose residuals r have opposite signs.

    The next points stand around the zero of the parabola x(r) through the bracket and the point x[2] beside it: as far
    off as half way to the zero of the line, and ever nearer, down to two floats. Where they have not narrowed the
    bracket to an eighth three times, and at the end, where f is rounding, the points are evenly spaced; where they have
    not there are more of them: a jump must be closed in to the last float to be told from a root. Zero, about which
    floats are ever nearer, is looked at first.
    """
    across = active & (x[0] < 0) & (x[1] > 0)
    if across.any():
        x, r = _narrowed(g, x, r, np.zeros_like(x[:1]), across)
    poor = np.zeros(active.shape)
    while True:
        (a, b, c), (r_a, r_b, r_c) = x, r
        width, unit = b - a, ulp(b, floor)  # the width may overflow
        active = active & (width > 4 * unit) & (r_a != 0) & (r_b != 0)
        if not active.any():
            return x[:2], r[:2]
        along = r_a / (r_b - r_a)
        line = a - width * along
        parabola = a + width * along * (r_c / (r_b - r_c)) + (c - a) * (r_a / (r_c - r_a)) * (r_b / (r_c - r_b))
        zero = np.where((a < parabola) & (parabola < b), parabola, line)
        off = np.abs(parabola - line) / 2
        off = np.where(off < width, off, width / 4)
        even = ~((a < zero) & (zero < b)) | (width <= 32 * unit) | (poor > 2)
        nearer = np.maximum(off * _NEARER, unit * _LEAST)
        new = np.where(even, a * (1 - _EIGHTHS) + b * _EIGHTHS, zero + _SIDES * nearer)
        many = active & (poor > 2) & (width > 32 * unit)
        if many.any():  # the others stay as they would be alone: what they do not need stands at their end b
            rest = np.broadcast_to(b, (len(_MANY) - len(new), *b.shape))
            new = np.where(many, a * (1 - _MANY) + b * _MANY, np.concatenate([new, rest]))
        x, r = _narrowed(g, x, r, np.clip(new, a, b), active)
        poor = np.where(x[1] - x[0] > width / 8, poor + 1, np.where(even & (poor > 2), poor, 0))


def _narrowed(g: Function, x: Array, r: Array, new: Array, active: Mask) -> tuple[Array, Array]:
    """The first change of sign between the ends x[0] and x[1] and the new points, and the point beside it."""
    new = np.where(active, new, x[0])
    x_all, r_all = np.concatenate([x[:1], new, x[1:2]]), np.concatenate([r[:1], g(new), r[1:2]])
    side = np.sign(r_all)
    k = (side[1:] != side[:-1]).argmax(0)
    rows = np.array([k, k + 1, np.where(k > 0, k - 1, k + 2)])
    return np.where(active, taken(x_all, rows), x), np.where(active, taken(r_all, rows), r)


def ulp(x: Array, floor: Array) -> Array:
    return EPS * np.abs(x) + floor


def true(mask: Mask) -> tuple[Index, Index]:
    """Row and column of the true elements; numpy's nonzero, many times as fast where they are few."""
    row, column = np.divmod(mask.ravel().nonzero()[0], mask.shape[1])
    return row, column


def slots(mask: Mask) -> tuple[Index, Mask]:
    """Rows of the true elements of each column, shape (K, p), and which of these slots are filled."""
    row, column = true(mask)
    count = np.bincount(column, minlength=mask.shape[1])
    order = column.argsort(kind="stable")
    place = np.arange(len(order)) - np.repeat(count.cumsum() - count, count)
    rows = np.zeros((count.max(initial=0), mask.shape[1]), dtype=np.intp)
    rows[place, column[order]] = row[order]
    return rows, np.arange(len(rows))[:, None] < count


def picked(values: NDArray[Any], rows: NDArray[Any]) -> NDArray[Any]:
    """The given rows of each column, shape of ``rows``."""
    picked: NDArray[Any] = values[rows, np.arange(values.shape[1])]
    return picked


def taken(values: Array, rows: Index) -> Array:
    """The given rows of each slot and column; numpy's take_along_axis, five times as fast."""
    flat = values.reshape(len(values), -1)
    return flat[rows.reshape(len(rows), -1), np.arange(flat.shape[1])].reshape(rows.shape)
