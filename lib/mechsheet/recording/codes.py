"""Codes of dimensions, each of which stands for exponents of the base units: one of all elements, or one of each."""

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

Codes = int | NDArray[np.intp]

NUMBER, UNKNOWN, ANY, LITERAL, WRONG = range(5)  # those of other exponents follow


def each(f: Callable[..., int], *codes: Codes) -> Codes:
    """A rule for each combination of the operands' dimensions."""
    if all(isinstance(c, int) for c in codes):
        return f(*codes)
    base = 1 + max((int(np.max(c)) for c in codes if np.size(c)), default=0)
    key: Any = 0
    for c in codes:
        key = key * base + c
    table = np.zeros(base ** len(codes), np.intp)
    for k in np.flatnonzero(np.bincount(key.reshape(-1))).tolist():
        table[k] = f(*(k // base**n % base for n in reversed(range(len(codes)))))
    return simple(table[key])


def only(codes: Codes, *several: int) -> bool:
    """Whether all elements have one code, one of some."""
    return isinstance(codes, int) and codes in several


def kinds(codes: Codes) -> list[int]:
    """The codes that there are."""
    return [codes] if isinstance(codes, int) else np.flatnonzero(np.bincount(codes.reshape(-1))).tolist()


def simple(codes: NDArray[np.intp]) -> Codes:
    """One code where those of all elements are the same."""
    return int(codes.flat[0]) if codes.size and (codes == codes.flat[0]).all() else codes
