"""Exact points and directions that move, and how arrays become exact numbers and these arrays again."""

from collections.abc import Callable, Iterable, Iterator
from typing import Any

import numpy as np

from mechsheet.accuracy.arithmetic import expj, mpc, mpf


def exact_rows(*arrays: Any) -> Iterator[list[mpc]]:
    """The elements of the broadcast arrays, one tuple of exact numbers after the other."""
    for row in np.broadcast(*arrays):
        yield [mpc(complex(x)) for x in row]


def path(x: mpc, v: mpc, a: mpc) -> Callable[[mpf], mpc]:
    """Quantity with the given value, first and second derivative at t = 0."""
    return lambda t: x + v * t + a * t**2 / 2


def turning(u: mpc, omega: mpc, epsilon: mpc) -> Callable[[mpf], mpc]:
    """Unit vector along u at t = 0, turning with the angular velocity and acceleration."""
    return lambda t: u / abs(u) * expj((omega * t + epsilon * t**2 / 2).real)


def floats(values: Iterable[Any]) -> np.ndarray:
    """Exact numbers, rounded once."""
    return np.array([complex(z) for z in values])
