r"""Derivatives of functions that only have values: difference quotients, extrapolated to no step.

.. math:: D(h) = \frac{f(x + h) - f(x - h)}{2h} = f' + c_2 h^2 + c_4 h^4 + \dots, \qquad
          D(h) = \frac{f(x + h) - f(x)}{h} = f' + c_1 h + c_2 h^2 + \dots

References
----------
C. J. F. Ridders, Accurate computation of F'(x) and F'(x) F''(x), Advances in Engineering Software 4 (1982).
"""

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]

_ROUNDING = 32 * np.finfo(float).eps  # of the largest value: what the roundings of a function make of it
_HALVINGS = 9


def extrapolated(quotients: Array, widths: Array, size: float, ratio: ArrayLike = 4.0) -> tuple[Array, Array]:
    """Limits of difference quotients for no step, and estimates of their errors; steps on axis 1, halved each.

    ``size`` is that of the greatest value that the quotients of the ``widths`` are made of. Halving the step takes the
    error down by the ``ratio``, 4 of central ones and 2 of those to one side, and what is left of it by as much each
    time. Of all extrapolations that one is taken whose estimated error, by its two predecessors, is least.
    """
    best = np.full_like(quotients[:, 0], np.nan)
    error = np.full_like(best, np.inf)
    before = [quotients[:, 0]]
    for n in range(1, quotients.shape[1]):
        row = [quotients[:, n]]
        rounding = _ROUNDING * size / np.abs(widths[:, n])
        for m in range(1, n + 1):
            row.append(row[-1] + (row[-1] - before[m - 1]) / (np.power(ratio, m) - 1))
            off = np.maximum(np.abs(row[m] - row[m - 1]), np.abs(row[m] - before[m - 1]))
            with np.errstate(invalid="ignore"):
                new = np.where(np.isnan(row[m]), np.inf, off + rounding)
            better = new < error
            best, error = np.where(better, row[m], best), np.where(better, new, error)
        before = row
    flat = np.all(quotients == 0, axis=1)  # no influence at all: no error either
    return best, np.where(flat, 0.0, np.where(np.isnan(best), np.nan, error))


def derivative(f: Callable[[Array], ArrayLike], x: Array, lo: float, hi: float, step: float) -> tuple[Array, Array]:
    """Derivative of ``f`` at places of shape (n) between ``lo`` and ``hi``, and estimates of its errors.

    ``f`` is taken at arrays of shape (n, k), never outside of these ends: within the ``step`` of one of them the
    differences are to the other side. NaN where ``f`` has no value at a place that is needed.
    """
    to_side = np.where(x - lo < step, 1, np.where(hi - x < step, -1, 0))[:, None]
    steps = step / 2.0 ** np.arange(_HALVINGS + 1)
    ends = [x[:, None] + np.where(to_side == -way, 0, way * steps) for way in (1, -1)]
    ahead, behind = (np.asarray(f(end), float) for end in ends)
    widths = ends[0] - ends[1]  # the steps as they are after rounding
    size = float(np.max(np.abs([ahead, behind]), initial=0.0))
    return extrapolated((ahead - behind) / widths, widths, size, np.where(to_side[:, 0], 2.0, 4.0))
