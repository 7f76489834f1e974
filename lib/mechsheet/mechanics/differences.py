r"""Derivatives of functions that only have values, by differences of eighth order on steps that are halved.

.. math:: f'(x) = \frac{1}{h} \sum_k w_k f(x + c_k h), \qquad c_k = \pm 1, \pm\tfrac12, \pm\tfrac14, \pm\tfrac18

and at an end of the range :math:`c_k = 1, 2^{-1/2}, \dots, 2^{-7/2}` to one side. Steps, weights and the end of halving
are those of ``scipy.differentiate.derivative``, which takes longer to be imported than a worksheet to be computed.
"""

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]

_HALVINGS = 10  # of the step, the first one included
_WORSE = 10  # times the error before: finer steps are nothing but rounding
_EPS = float(np.finfo(float).eps)
_HALVES = 2.0 ** -np.arange(4)
_BOTH = np.stack([_HALVES, -_HALVES], 1).ravel()  # in pairs, so that halving the step goes on by one pair
_ONE = 2.0 ** (-np.arange(8) / 2)


def _weights(steps: Array) -> Array:
    """Weights of the values at ``steps``, shape (8,), and last of the value in the middle, shape (9,)."""
    powers = np.vander([*steps, 0.0], increasing=True).T
    return np.linalg.solve(powers, np.eye(9)[1])


def derivative(
    f: Callable[[Array], ArrayLike], x: Array, step: float, side: NDArray[np.int_], enough: float
) -> tuple[Array, Array]:
    """Derivative of ``f`` at places of shape (n,), and by how much the last halving of the step has changed it.

    ``f`` is taken at arrays of shape (n,) and (n, k), at ``side`` 0 within ``step`` to both sides of a place, else to
    that side alone. A step is halved until the change is less than ``enough``, or ten times the change before. NaN
    where ``f`` has no value that is needed.
    """
    both = side[:, None] == 0
    ahead = _weights(_BOTH)[:-1:2]
    opposite = [*np.stack([ahead, -ahead], 1).ravel(), 0.0]  # to the last digit, so that what is level has no slope
    at = np.where(both, _BOTH, side[:, None] * _ONE)
    weights = np.where(both, opposite, side[:, None] * _weights(_ONE))
    slope, error = np.full((2, len(x)), np.nan)
    middle, values, left = np.asarray(f(x), float)[:, None], np.empty((len(x), 0)), np.arange(len(x))
    new = at
    for _ in range(_HALVINGS):
        more = np.asarray(f(x[left, None] + step * new[left]), float)
        values = np.hstack([values, more])[:, -8:]
        found = np.einsum("ij,ij->i", np.hstack([values, middle[left]]), weights[left]) / step
        rounded = _EPS * np.einsum("ij,ij->i", np.abs(np.hstack([values, middle[left]])), np.abs(weights[left])) / step
        change, before = np.abs(found - slope[left]), error[left]
        slope[left], error[left] = found, change + rounded
        going = ~(change < enough) & np.isfinite(found) & ~(change > _WORSE * before) & ~(change < rounded)
        left, values, new, step = left[going], values[going], new[:, -2:], step / 2
        if not left.size:
            break
    slope[~np.isfinite(slope)] = np.nan
    return slope, error
