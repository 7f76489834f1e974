"""Arrays of 32 digits: each number is the sum of two floats, of which the second is below the first one's rounding.

T. J. Dekker, A floating-point technique for extending the available precision, Numer. Math. 18, 1971.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from mechsheet.accuracy.arithmetic import point, root

_SPLIT = 2.0**27 + 1  # times a float, parts it into halves whose products are exact


def _two_sum(a: Any, b: Any) -> tuple[Any, Any]:
    """a + b, and what its rounding leaves."""
    s = a + b
    v = s - a
    return s, (a - (s - v)) + (b - v)


def _renormal(a: Any, b: Any) -> tuple[Any, Any]:
    """The same where b is far below a."""
    s = a + b
    return s, b - (s - a)


def _two_product(a: Any, b: Any) -> tuple[Any, Any]:
    """a b, and what its rounding leaves."""
    p, (a1, a2), (b1, b2) = a * b, _halves(a), _halves(b)
    return p, ((a1 * b1 - p) + a1 * b2 + a2 * b1) + a2 * b2


def _halves(a: Any) -> tuple[Any, Any]:
    c = _SPLIT * a
    high = c - (c - a)
    return high, a - high


class Real:
    """Real numbers high + low."""

    def __init__(self, high: Any, low: Any = 0.0) -> None:
        self.high, self.low = high, low

    def __add__(self, other: Any) -> Real:
        other = _real(other)
        s, e = _two_sum(self.high, other.high)
        t, f = _two_sum(self.low, other.low)
        s, e = _renormal(s, e + t)
        return Real(*_renormal(s, e + f))

    def __neg__(self) -> Real:
        return Real(-self.high, -self.low)

    def __sub__(self, other: Any) -> Real:
        return self + -_real(other)

    def __mul__(self, other: Any) -> Any:
        if isinstance(other, Point):
            return other * self
        other = _real(other)
        p, e = _two_product(self.high, other.high)
        return Real(*_renormal(p, e + self.high * other.low + self.low * other.high))

    def __pow__(self, _two: int) -> Any:
        return self * self

    def __truediv__(self, other: Any) -> Any:
        other = _real(other)
        first = self.high / other.high
        second = (self - other * first).high / other.high
        third = (self - other * first - other * second).high / other.high
        return Real(*_renormal(first, second)) + third


class Point:
    """Complex numbers of two real ones."""

    def __init__(self, real: Real, imag: Real) -> None:
        self.real, self.imag = real, imag

    def __add__(self, other: Point) -> Point:
        return Point(self.real + other.real, self.imag + other.imag)

    def __neg__(self) -> Point:
        return Point(-self.real, -self.imag)

    def __sub__(self, other: Point) -> Point:
        return self + -other

    def __mul__(self, other: Any) -> Point:
        if not isinstance(other, Point):
            return Point(self.real * other, self.imag * other)
        a, b, c, d = self.real, self.imag, other.real, other.imag
        return Point(a * c - b * d, a * d + b * c)

    def __truediv__(self, other: Any) -> Any:
        if not isinstance(other, Point):
            return Point(self.real / other, self.imag / other)
        return self * Point(other.real, -other.imag) / (other.real * other.real + other.imag * other.imag)


def _real(x: Any) -> Real:
    """Numbers, or floats as such."""
    return x if isinstance(x, Real) else Real(x)


@root.register
def _root(x: Real) -> Real:
    r = np.sqrt(x.high)
    return Real(*_renormal(r, (x - Real(r) * r).high / (2 * r)))


point.register(Real, Point)
