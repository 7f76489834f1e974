"""Axes of a workbook's charts, as XlsxWriter takes them: limits, step and number format."""

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mechsheet.workbook.cell import LARGEST


def linear(values: NDArray[np.float64]) -> dict[str, Any]:
    """Limits, step and number format of an axis in round numbers; Excel's own often start at zero."""
    values = values[np.abs(values) < LARGEST]
    low, high = (float(values.min()), float(values.max())) if values.size else (0.0, 1.0)
    if high - low <= max(1e-9 * abs(low), 1e-9 * abs(high), 1e-300):
        low, high = low - (abs(low) / 2 or 0.5), high + (abs(high) / 2 or 0.5)
    fifth = (high - low) / 5
    power = math.floor(math.log10(fifth))
    steps = ((1, 0), (2, 0), (2.5, 1), (5, 0), (10, -1))
    step, more = next((m * 10.0**power, more) for m, more in steps if m * 10.0**power >= 0.999 * fifth)
    low, high = (round(end(edge / step) * step, 1 - power) for end, edge in ((math.floor, low), (math.ceil, high)))
    decimals = max(0, more - power)
    plain = decimals < 6 and max(abs(low), abs(high)) < 1e7
    return {"min": low, "max": high, "major_unit": step, "num_format": f"{0:.{decimals}f}" if plain else "0.0E+00"}


def decades(values: NDArray[np.float64]) -> dict[str, Any]:
    """Limits and number format of a logarithmic axis in whole decades, the other axis at its low end."""
    low, high = (float(10.0 ** end(np.log10(v))) for end, v in ((np.floor, values.min()), (np.ceil, values.max())))
    return {"log_base": 10, "min": low, "max": max(high, 10 * low), "crossing": low, "num_format": "0E+00"}
