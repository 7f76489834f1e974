"""Numbers with their first derivatives: what a position is computed with, velocity and acceleration come with it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from mechsheet.accuracy.arithmetic import point, root


class Taylor:
    """A number of any kind and its first one or two derivatives; what is no `Taylor` does not change."""

    def __init__(self, *of: Any) -> None:
        self.of = of

    def __add__(self, other: Any) -> Taylor:
        if not isinstance(other, Taylor):
            return Taylor(self.of[0] + other, *self.of[1:])
        return Taylor(*(a + b for a, b in zip(self.of, other.of, strict=True)))

    def __sub__(self, other: Any) -> Taylor:
        return self.__add__(-other)

    def __neg__(self) -> Taylor:
        return self._each(lambda x: -x)

    def __mul__(self, other: Any) -> Taylor:
        if not isinstance(other, Taylor):
            return self._each(lambda x: x * other)
        a, b = self.of, other.of
        return Taylor(*(_product(a, b, k) for k in range(len(a))))

    def __pow__(self, _two: int) -> Taylor:
        return self * self

    def __truediv__(self, other: Any) -> Taylor:
        if not isinstance(other, Taylor):
            return self._each(lambda x: x / other)
        (a, *da), (b, *db) = self.of, other.of
        q = a / b
        dq = (da[0] - q * db[0]) / b
        return Taylor(q, dq, *((c - dq * db[0] * 2 - q * d) / b for c, d in zip(da[1:], db[1:], strict=True)))

    @property
    def real(self) -> Taylor:
        return self._each(lambda x: x.real)

    @property
    def imag(self) -> Taylor:
        return self._each(lambda x: x.imag)

    def _each(self, f: Callable[[Any], Any]) -> Taylor:
        return Taylor(*map(f, self.of))


def _product(a: tuple[Any, ...], b: tuple[Any, ...], order: int) -> Any:
    if order < 2:
        return a[0] * b[0] if order == 0 else a[1] * b[0] + a[0] * b[1]
    return a[2] * b[0] + a[1] * b[1] * 2 + a[0] * b[2]


@root.register
def _root(x: Taylor) -> Taylor:
    a, *da = x.of
    r = root(a)
    dr = da[0] / r / 2
    return Taylor(r, dr, *((c / 2 - dr * dr) / r for c in da[1:]))


@point.register
def _point(x: Taylor, y: Any) -> Taylor:
    parts = y.of if isinstance(y, Taylor) else (y, *(dx * 0 for dx in x.of[1:]))
    return Taylor(*map(point, x.of, parts))
