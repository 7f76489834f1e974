"""The root between two ends to which a method of scipy leads: of several one, or where the function jumps over 0."""

from collections.abc import Callable
from typing import Any

import numpy as np

SHARP = {"xtol": 1e-300, "rtol": 4 * np.finfo(float).eps, "maxiter": 2000}  # to the last digits


def root(method: str, f: Callable[[float], Any], lo: Any, hi: Any) -> float:
    """As scipy's function of that name finds it; NaN where that raises."""
    from scipy import optimize  # on use: the worksheet has it

    try:
        return float(getattr(optimize, method)(lambda x: float(f(x)), float(lo), float(hi), **SHARP))
    except (ValueError, RuntimeError):
        return np.nan
