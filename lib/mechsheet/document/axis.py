"""Axes in round numbers: where they end, where their ticks stand and how these are written."""

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property
from math import ceil, floor, log10

import numpy as np
from numpy.typing import ArrayLike

from mechsheet.worksheet import numbers

_STEPS = (1, 2, 2.5, 5, 10)
_STEPS_OF_A_CIRCLE = {1: (1.5, 3, 4.5, 6, 9, 18), 2: (1.8, 3.6, 7.2, 10.8)}  # tens and hundreds of degrees
_LEAST = 1e-300  # length of an axis


@dataclass(frozen=True)
class Axis:
    """Ends and step of an axis; ``places`` is the last decimal of its ticks, negative before the point."""

    low: float
    high: float
    step: float
    places: int

    @cached_property
    def ticks(self) -> list[float]:
        return [i * self.step for i in range(round(self.low / self.step), round(self.high / self.step) + 1)]

    @cached_property
    def power(self) -> int:
        """Power of ten by which the ticks are divided where they are written."""
        largest = max(abs(self.low), abs(self.high))
        return 3 * floor(log10(largest) / 3) if not 1e-2 <= largest < 1e5 else 0

    def text(self, tick: float) -> str:
        """A tick as it is written, without the power of ten."""
        return numbers.fixed(tick / 10.0**self.power, max(0, self.places + self.power), numbers.AXIS)


def axis(values: Iterable[ArrayLike], unit: str = "-", count: int = 6) -> Axis:
    """Axis of about ``count`` steps that holds all finite values; degrees are divided as a circle is.

    >>> axis([[0.42, 0.67]], "m")
    Axis(low=0.4, high=0.7, step=0.05, places=2)
    >>> axis([[0, 360]], "deg").ticks
    [0.0, 60.0, 120.0, 180.0, 240.0, 300.0, 360.0]
    >>> axis([[0, 720]], "deg").ticks
    [0.0, 180.0, 360.0, 540.0, 720.0]
    """
    every = np.concatenate([np.ravel(np.asarray(v, dtype=float)) for v in values])
    every = every[np.isfinite(every)]
    low, high = (float(every.min()), float(every.max())) if every.size else (0.0, 1.0)
    if not high - low > max(1e-9 * abs(low), 1e-9 * abs(high), _LEAST):
        half = abs(low) / 2 or 0.5
        low, high = low - half, high + half
    rough = (high - low) / count
    exponent = floor(log10(rough))
    steps = _STEPS_OF_A_CIRCLE.get(exponent, _STEPS) if unit == "deg" else _STEPS
    factor = next(m for m in steps if m * 10.0**exponent >= 0.999 * rough)
    step = factor * 10.0**exponent
    ends = floor(low / step + 1e-9), ceil(high / step - 1e-9)
    low, high = (round(i * step, 1 - exponent) for i in ends)  # 0.3, not 0.30000000000000004
    return Axis(low, high, step, (factor == 2.5) - floor(log10(step) + 1e-9))
