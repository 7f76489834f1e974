"""Polynomials of recorded coefficients, the lowest power first, as those of numpy.polynomial.

Loaded where a worksheet has one of these.
"""

from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.polynomial import Polynomial
from numpy.polynomial import polynomial as of_numpy

from mechsheet.quantities.graph import Graph, NotRecorded, current
from mechsheet.quantities.polynomial_rules import added, convolved, derivative, integral, roots, value, without_zeros
from mechsheet.quantities.quantity import FUNCTIONS, lift


def instead(own: Any) -> Any:
    """What stands for something of numpy.polynomial; itself where its functions are those of `FUNCTIONS`."""
    if own is Polynomial:
        return Powers
    return Powers.like(own) if isinstance(own, Polynomial) else own


class Powers:
    """numpy's Polynomial; one that is fitted has powers of another variable, of which its values alone are the same."""

    __array_ufunc__ = None  # an array leaves its products to this
    __hash__ = None  # type: ignore[assignment]

    def __init__(self, coef: Any, domain: Any = None, window: Any = None, symbol: str = "x") -> None:
        if any(each is not None and [*each] != [-1, 1] for each in (domain, window)):
            raise NotRecorded("numpy's Polynomial in a domain of its own")
        self._powers, self._fitted, self._trims = np.atleast_1d(lift(current.get(), coef)), False, False

    @classmethod
    def fit(cls, x: Any, y: Any, deg: int, **named: Any) -> "Powers":
        """As numpy's, whose ``domain`` and ``window`` change no value."""
        made = cls(
            fitted(current.get(), x, y, deg, **{k: v for k, v in named.items() if k not in ("domain", "window")})
        )
        made._fitted = True
        return made

    @classmethod
    def like(cls, own: Polynomial) -> "Powers":
        """One that the setup has made."""
        made = cls(own.convert().coef)
        made._fitted = bool((own.domain != own.window).any())
        return made

    @classmethod
    def _trimmed(cls, coef: Any) -> "Powers":
        """Whose last coefficients are left out where they are 0, once somebody asks for these."""
        made: Powers = cls(coef)
        made._trims = True
        return made

    @property
    def coef(self) -> Any:
        if self._fitted:
            raise NotRecorded("the coefficients of a fitted Polynomial but for those of convert()")
        kept = without_zeros(current.get(), self._powers, "b") if self._trims else self._powers
        return kept if len(kept) else self._powers[:1]

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_") or not hasattr(Polynomial, name):
            raise AttributeError(name)
        raise NotRecorded(f"{name} of a Polynomial")

    def convert(self) -> "Powers":
        return self._trimmed(self._powers)

    def __iter__(self) -> Iterator[Any]:
        return iter(self.coef)

    def __len__(self) -> int:
        return len(self.coef)

    def __eq__(self, other: object) -> bool:
        raise NotRecorded("whether a Polynomial is another one")

    def __call__(self, x: Any) -> Any:
        return value(current.get(), self._powers[::-1], lift(current.get(), x))

    def degree(self) -> int:
        return len(self.coef) - 1

    def deriv(self, m: int = 1) -> "Powers":
        return Powers(derivative(current.get(), self._powers[::-1], m)[::-1] if m < len(self._powers) else [0.0])

    def integ(self, m: int = 1, k: Any = (), lbnd: Any = 0.0) -> "Powers":
        made, constants = self, [*k] if isinstance(k, list | tuple | np.ndarray) else [k]
        for n in range(m):
            made = Powers(integral(current.get(), made._powers[::-1])[::-1])
            made = made + ((constants[n] if n < len(constants) else 0.0) - made(0.0 if lbnd is None else lbnd))
        return made

    def roots(self) -> Any:
        found = roots(current.get(), self._powers[::-1])
        return np.sort(found) if found.im is None else found[::-1]

    def __add__(self, other: Any) -> "Powers":
        return self._trimmed(added(current.get(), self._powers[::-1], _powers(other)[::-1])[::-1])

    def __mul__(self, other: Any) -> "Powers":
        return self._trimmed(convolved(current.get(), self._powers, _powers(other)))

    __radd__, __rmul__ = __add__, __mul__

    def __neg__(self) -> "Powers":
        return Powers(-self._powers)

    def __sub__(self, other: Any) -> "Powers":
        return self.__add__(-_powers(other))

    def __rsub__(self, other: Any) -> "Powers":
        return (-self).__add__(other)

    def __truediv__(self, number: Any) -> "Powers":
        return Powers(self._powers / number)

    def __pow__(self, power: int) -> "Powers":
        made = Powers([1.0])
        for _ in range(power):
            made = made * self
        return made


def _powers(value: Any) -> Any:
    """The coefficients of one, of a number or of a list of them."""
    return value._powers if isinstance(value, Powers) else np.atleast_1d(lift(current.get(), value))


def fitted(graph: Graph, x: Any, y: Any, deg: int, **named: Any) -> Any:
    """The coefficients of least squares."""
    return np.polyfit(lift(graph, x), lift(graph, y), deg, **named)[::-1]


FUNCTIONS.update(
    {
        of_numpy.polyval: lambda graph, x, c: Powers(c)(x),
        of_numpy.polyder: lambda graph, c, m=1: Powers(c).deriv(m).coef,
        of_numpy.polyint: lambda graph, c, m=1, k=(), lbnd=0: Powers(c).integ(m, k, lbnd).coef,
        of_numpy.polymul: lambda graph, p, q: (Powers(p) * Powers(q)).coef,
        of_numpy.polyfit: fitted,
    }
)
