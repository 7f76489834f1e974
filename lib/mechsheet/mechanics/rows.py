"""Functions of arrays of numbers, and those that take one number after the other.

A search asks for many values at once. A function that adds up or chooses over all that it is given, such as the
largest pressure angle over the positions, or that decides by ``if``, is right for one number only: it fails for
several, or tells something else.
"""

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mechsheet.mechanics.arguments import unmasked
from mechsheet.mechanics.brackets import Array

Parts = Callable[[Array], Sequence[NDArray[Any]]]  # of unknowns, shape (n, ...), each part of the shape behind n

_ALIKE = 1e-9  # of the largest: numpy rounds long arrays in another way than single numbers


def takes_arrays(f: Parts, x: Array, shape: tuple[int, ...]) -> bool:
    """Whether ``f`` of places, shape (n, k, *shape), is what it is of each; what it raises for one is raised."""
    each = one_by_one(f, shape)(x)
    try:
        together = f(x)
    except Exception:  # whatever it is: each place was taken alone
        return False
    return all(alone.shape == v.shape and _alike(alone, v) for alone, v in zip(each, together, strict=True))


def one_by_one(f: Parts, shape: tuple[int, ...]) -> Parts:
    """What calls ``f`` for one set of unknowns after the other: single numbers, or arrays of ``shape``."""

    def called(x: Array) -> list[NDArray[Any]]:
        single = x.reshape(len(x), -1, *shape)
        found = zip(*(f(single[:, i]) for i in range(single.shape[1])), strict=True)
        return [np.stack([_of_shape(v, shape) for v in values]).reshape(x.shape[1:]) for values in found]

    return called


def _of_shape(found: NDArray[Any], shape: tuple[int, ...]) -> NDArray[Any]:
    try:
        return np.broadcast_to(found, shape)
    except ValueError:  # of numpy's, which does not say of what
        of = f"unknowns of shape {shape}" if shape else "one number"
        told = f"what is to be solved gives numbers of shape {found.shape} for {of}"
        raise ValueError(f"{told}: an equation is one number, several are a tuple") from None


def of_one(f: Callable[[Array], Any]) -> Parts:
    """A function of one unknown as one of several."""
    return lambda x: (unmasked(f(x[0])),)


def each_alone(f: Callable[[Array], Any], shape: tuple[int, ...]) -> Callable[[Array], NDArray[Any]]:
    """A function of one unknown that calls ``f`` as `one_by_one` does."""
    called = one_by_one(of_one(f), shape)
    return lambda x: called(x[None])[0]


def _alike(one: NDArray[Any], other: NDArray[Any]) -> bool:
    size = np.abs(one[np.isfinite(one)]).max(initial=0)
    return np.allclose(one, other, rtol=0, atol=_ALIKE * size, equal_nan=True)
