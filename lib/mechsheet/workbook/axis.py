"""Axes of a workbook's charts, as XlsxWriter takes them: limits, step and number format."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from mechsheet.document.axis import axis
from mechsheet.workbook.content import LARGEST
from mechsheet.worksheet.numbers import fixed

_STEPS = 5


def linear(values: NDArray[np.float64], unit: str = "-") -> dict[str, Any]:
    """Limits, step and number format of an axis in round numbers; Excel's own often start at zero."""
    ends = axis([values[np.abs(values) < LARGEST]], unit, _STEPS)
    decimals = max(0, ends.places)
    plain = decimals < 6 and max(abs(ends.low), abs(ends.high)) < 1e7
    number = fixed(0, decimals) if plain else "0.0E+00"
    return {"min": ends.low, "max": ends.high, "major_unit": ends.step, "num_format": number}


def decades(values: NDArray[np.float64], unit: str = "-") -> dict[str, Any]:
    """Limits and number format of a logarithmic axis in whole decades, the other axis at its low end."""
    low, high = (float(10.0 ** end(np.log10(v))) for end, v in ((np.floor, values.min()), (np.ceil, values.max())))
    return {"log_base": 10, "min": low, "max": max(high, 10 * low), "crossing": low, "num_format": "0E+00"}
