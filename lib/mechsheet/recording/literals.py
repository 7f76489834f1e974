"""Which literals of a worksheet are numbers for certain, and which may stand for a quantity with a unit."""

import math
from fractions import Fraction

from mechsheet.recording.graph import Node

TOLERANCE = 1e-6  # a literal below it is a tolerance, which has the unit of what it is compared with
VANISHING = 1e-50  # a literal below it, such as a complex step, is as good as 0
_MOST = 360  # in a fraction as formulas have them


def surely_pure(constant: Node) -> bool:
    """Whether a literal is a number for certain; a table may have a unit that nobody wrote."""
    if constant.value.dtype == bool:
        return True
    return constant.size == 1 and is_pure(float(constant.value.item()))


def is_pure(number: float) -> bool:
    """Whether a number is one as formulas have them: a small fraction, of pi or a root too, a power of ten.

    Anything else, such as 9.81 or 640e6, may have a unit that nobody wrote.
    """
    x = abs(number)
    if x < TOLERANCE or not math.isfinite(x) or math.log10(x).is_integer():
        return True
    for y in (x, x / math.pi, x * math.pi, x * x):
        near = Fraction(y).limit_denominator(_MOST)
        if near.numerator <= _MOST and abs(y - near) <= 1e-12 * y:
            return True
    return False
