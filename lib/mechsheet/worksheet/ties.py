"""Orders of numbers that do not rest on their last digits: another processor rounds otherwise, and orders the same."""

import numpy as np
from numpy.typing import ArrayLike

_ROUNDING = 1e-9  # of a number: others as near are equal to it but for rounding


def greatest(x: ArrayLike) -> int:
    """Place of the first number in an array that is the greatest but for rounding, or of the first NaN.

    >>> greatest([1.0, 3.0, 2.0, 3.0000000000000004])
    1
    """
    flat = np.asarray(x, float).ravel()
    return int(np.argmax(np.isclose(flat, np.max(flat), rtol=_ROUNDING, atol=0, equal_nan=True)))


def greatest_first(x: ArrayLike, off: ArrayLike = 0.0) -> list[int]:
    """Places of all numbers, shape (n), the greatest first and NaN last; those that are equal keep their order.

    Equal are those that differ by rounding, or by less than both may be ``off``.

    >>> greatest_first([1.9, np.nan, 3.0, 3.0000000000000004, 2.0], off=[0.0, 0.0, 0.0, 0.0, 0.2])
    [2, 3, 0, 4, 1]
    """
    every = np.asarray(x, float)
    order = np.argsort(-every, kind="stable")
    sizes, by = every[order], np.nan_to_num(np.broadcast_to(off, every.shape), posinf=0.0)[order]
    apart = ~np.isclose(sizes[1:], sizes[:-1], rtol=_ROUNDING, atol=by[:-1] + by[1:], equal_nan=True)
    rank = np.append(0, apart.cumsum())[: every.size]
    placed: list[int] = order[np.lexsort([order, rank])].tolist()
    return placed
