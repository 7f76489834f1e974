"""Splines of scipy: polynomials between knots, whose slopes there follow from the values."""

import inspect
from collections.abc import Callable, Sequence
from functools import reduce
from math import prod
from typing import Any

import numpy as np

from mechsheet.quantities.graph import NotRecorded, current
from mechsheet.quantities.quantity import Quantity, has_quantity, lift
from mechsheet.quantities.refused import needed
from mechsheet.recording import solving

_CURVES = frozenset({"PPoly", "CubicSpline", "PchipInterpolator", "Akima1DInterpolator", "BSpline"})
_MADE = frozenset({"CubicSpline", "PchipInterpolator", "Akima1DInterpolator", "make_interp_spline"})
_SAME = 1e-15
_FLAT = 1e-9  # of the largest bend, below which Akima's slope is the mean one


def is_spline(value: Any) -> bool:
    """Whether a class or function of scipy that makes a spline, or a spline."""
    if getattr(value, "__name__", "") in _MADE:
        return bool(value.__module__.startswith("scipy.interpolate."))
    return type(value).__name__ in _CURVES and type(value).__module__.startswith("scipy.interpolate.")


def spline(value: Any) -> Any:
    """What takes the place of such a class or function, or of a spline that the setup has made."""
    if not hasattr(value, "__name__"):
        return _of_numbers(value)

    def made(*args: Any, **named: Any) -> Any:
        bound = inspect.signature(value).bind(*args, **named)
        bound.apply_defaults()
        own = value(*map(solving.now, bound.args), **{name: solving.now(x) for name, x in bound.kwargs.items()})
        given = bound.arguments
        if not has_quantity([given["x"], given["y"], given.get("bc_type")]):
            return _of_numbers(own)
        if np.ndim(own(own.x[0] if hasattr(own, "x") else own.t[0])):
            raise NotRecorded(f"scipy's {value.__name__} of several values at a knot")
        rising(given["x"])
        if given.get("bc_type") == "periodic":
            _closing(lift(current.get(), given["y"]))
        return Curve(_pieces(own), *_hermite(given["x"], given["y"], _slopes_of(value.__name__, given)))

    return made


def rising(x: Any) -> None:
    """Note that places in a table rise."""
    rise: Any = np.diff(lift(current.get(), x)) > 0
    needed(rise.reduced("all"), "scipy has an error for places that do not rise")


def _closing(values: Quantity) -> None:
    """Note that a periodic curve ends as it begins, as far as scipy takes numbers for the same."""
    first, last = values[0], values[-1]
    if first.re is not last.re:
        needed(
            abs(first - last) <= _SAME * (1 + abs(last)), "scipy has an error for a periodic curve whose ends differ"
        )


def cubic(x: Any, y: Any) -> Callable[[Any], Any]:
    """The cubic spline through values at knots, without a knot next to its ends."""
    knots, powers = _hermite(x, y, lambda h, m: _cubic_slopes(h, m, "not-a-knot"))
    return lambda at: Curve(None, knots, powers)(at, extrapolate=True)


class Curve:
    """Polynomials between knots, as scipy's PPoly: of each power, from the highest on, a factor for every piece.

    ``own`` is that of scipy for the present numbers, where there is one.
    """

    def __init__(self, own: Any, knots: Any, powers: Sequence[Any]) -> None:
        self._own, self.x, self._powers = own, knots, list(powers)

    def __call__(self, x: Any, nu: int = 0, extrapolate: Any = None) -> Any:
        if nu:
            return self.derivative(nu)(x, extrapolate=extrapolate)
        if self._own is not None and not has_quantity([x, self.x, *self._powers]):
            return self._own(x, extrapolate=extrapolate)
        graph, beyond = current.get(), self._own.extrapolate if extrapolate is None else extrapolate
        at, knots = lift(graph, x), lift(graph, self.x)
        if beyond == "periodic":
            at = knots[0] + np.mod(at - knots[0], knots[-1] - knots[0])
        piece: Any = np.clip(np.searchsorted(knots, at, side="right") - 1, 0, knots.extent[0] - 2)
        factors = (lift(graph, factor)[piece] for factor in self._powers)
        result = _horner(factors, at - knots[piece])
        return result if beyond else np.where((at >= knots[0]) & (at <= knots[-1]), result, np.nan)

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_") or not hasattr(self._own, name):
            raise AttributeError(name)
        raise NotRecorded(f"{name} of a spline")

    def derivative(self, nu: int = 1) -> "Curve":
        """Its derivative of an order; a negative one integrates."""
        if nu < 0:
            return self.antiderivative(-nu)
        degrees = range(len(self._powers) - 1, nu - 1, -1)
        powers = [c * prod(range(k - nu + 1, k + 1)) for k, c in zip(degrees, self._powers, strict=False)]
        return Curve(self._own.derivative(nu), self.x, powers or [0 * self._powers[-1]])

    def antiderivative(self, nu: int = 1) -> "Curve":
        """The integral from its first knot on, as often as ``nu`` says."""
        if nu > 1:
            return self.antiderivative().antiderivative(nu - 1)
        count, steps = len(self._powers), np.diff(self.x)
        powers = [c / (count - k) for k, c in enumerate(self._powers)]
        areas = np.cumsum(_horner([*powers, 0.0], steps))
        return Curve(self._own.antiderivative(), self.x, [*powers, np.concatenate([_row(0.0), areas[:-1]])])

    def integrate(self, a: Any, b: Any, extrapolate: Any = None) -> Any:
        """Its integral between two places."""
        if "periodic" in (extrapolate, self._own.extrapolate):
            raise NotRecorded("the integral of a periodic spline")
        whole = self.antiderivative()
        return whole(b, extrapolate=extrapolate) - whole(a, extrapolate=extrapolate)


def _pieces(own: Any) -> Any:
    """A spline of scipy by its polynomials."""
    from scipy.interpolate import PPoly  # on use: a worksheet without a spline needs none

    return PPoly.from_spline(own) if type(own).__name__ == "BSpline" else own


def _of_numbers(own: Any) -> Curve:
    curve = _pieces(own)
    if curve.c.ndim > 2:
        raise NotRecorded(f"scipy's {type(own).__name__} of several values at a knot")
    some = np.flatnonzero(np.diff(curve.x))  # that of B-splines repeats its ends
    return Curve(curve, curve.x[[*some, some[-1] + 1]], [row[some] for row in curve.c])


def _row(*numbers: Any) -> Quantity:
    return lift(current.get(), list(numbers))


def _horner(factors: Any, t: Any) -> Any:
    return reduce(lambda known, factor: known * t + factor, factors)


def _hermite(x: Any, y: Any, slopes: Callable[[Any, Any], Any]) -> tuple[Any, list[Any]]:
    """Knots, and the cubics between them that have the values and slopes there."""
    graph = current.get()
    knots, values = lift(graph, x), lift(graph, y)
    h = np.diff(knots)
    m = np.diff(values) / h
    s = slopes(h, m)
    twist = (s[:-1] + s[1:] - 2 * m) / h
    return knots, [twist / h, (m - s[:-1]) / h - twist, s[:-1], values[:-1]]


def _slopes_of(name: str, given: dict[str, Any]) -> Callable[[Any, Any], Any]:
    """How the slopes at the knots follow from the widths of the pieces and their mean slopes."""
    if given.get("axis"):
        raise NotRecorded(f"scipy's {name} along another axis")
    if name == "PchipInterpolator":
        return _pchip_slopes
    if name == "Akima1DInterpolator":
        if given.get("method", "akima") != "akima":
            raise NotRecorded(f"scipy's {name} but for Akima's own method")
        return _akima_slopes
    ends = given["bc_type"]
    if name == "make_interp_spline":
        if given["k"] != 3 or given["t"] is not None or not (ends is None or isinstance(ends, str)):
            raise NotRecorded("scipy's make_interp_spline but for a cubic one")
        ends = ends or "not-a-knot"
    return lambda h, m: _cubic_slopes(h, m, ends)


def _cubic_slopes(h: Any, m: Any, ends: Any) -> Any:
    """Slopes with which the second derivative has no jump at the knots between the ends."""
    count = len(m)
    first, last = (ends, ends) if isinstance(ends, str) else ends
    if count == 1:
        first, last = ((1, m[0]) if end in ("not-a-knot", "periodic") else end for end in (first, last))
    inner = [(h[k], 2 * (h[k - 1] + h[k]), h[k - 1], 3 * (h[k] * m[k - 1] + h[k - 1] * m[k])) for k in range(1, count)]
    if first == "periodic":
        return _closed(h, m, inner)
    if count == 2 and first == last == "not-a-knot":  # one parabola
        middle = (h[1] * m[0] + h[0] * m[1]) / (h[0] + h[1])
        return _row(2 * m[0] - middle, middle, 2 * m[1] - middle)
    start, end = _end(first, h, m), _end(last, h[::-1], m[::-1], -1)
    rows = [(0.0, *start), *inner, (end[1], end[0], 0.0, end[2])]
    return _row(*_tridiagonal(rows))


def _end(kind: Any, h: Any, m: Any, way: int = 1) -> tuple[Any, Any, Any]:
    """The equation of an end: factors of its slope and of the next one, and their sum; seen from that end."""
    if isinstance(kind, str) and kind == "not-a-knot":
        both = h[0] + h[1]
        return h[1], both, ((h[0] + 2 * both) * h[1] * m[0] + h[0] ** 2 * m[1]) / both
    order, value = {"clamped": (1, 0.0), "natural": (2, 0.0)}[kind] if isinstance(kind, str) else kind
    if order == 1:
        return 1.0, 0.0, value
    return 2.0, 1.0, 3 * m[0] - way * value * h[0] / 2


def _tridiagonal(rows: Sequence[tuple[Any, Any, Any, Any]]) -> list[Any]:
    """Unknowns of equations each of which has the one before, its own and the next one, by elimination."""
    upper, right = list[Any](), list[Any]()
    for before, own, after, value in rows:
        pivot = own - before * upper[-1] if upper else own
        right.append((value - before * right[-1] if right else value) / pivot)
        upper.append(after / pivot)
    found = [right[-1]]
    for factor, value in zip(upper[-2::-1], right[-2::-1], strict=True):
        found.append(value - factor * found[-1])
    return found[::-1]


def _closed(h: Any, m: Any, inner: Sequence[tuple[Any, Any, Any, Any]]) -> Any:
    """Slopes of a curve that goes on as it begins: those inside rest on that at its ends."""
    (first, *_), (*_, last, _) = inner[0], inner[-1]
    own = _tridiagonal(inner)
    still = [(before, at, after, 0.0) for before, at, after, _ in inner]
    still[0] = (*still[0][:3], -first)
    still[-1] = (*still[-1][:3], still[-1][3] - last)
    by_end = _tridiagonal(still)
    value = 3 * (h[0] * m[-1] + h[-1] * m[0]) - h[-1] * own[0] - h[0] * own[-1]
    end = value / (2 * (h[0] + h[-1]) + h[-1] * by_end[0] + h[0] * by_end[-1])
    return _row(end, *(a + b * end for a, b in zip(own, by_end, strict=True)), end)


def _pchip_slopes(h: Any, m: Any) -> Any:
    """Weighted harmonic means, none where the slope turns; at the ends by a parabola that goes no other way."""
    if len(m) == 1:
        return _row(m[0], m[0])
    before, after = 2 * h[1:] + h[:-1], h[1:] + 2 * h[:-1]
    mean = (before + after) / (before / m[:-1] + after / m[1:])
    inner = np.where(m[:-1] * m[1:] > 0, mean, 0.0)
    return np.concatenate([_row(_pchip_end(h, m)), inner, _row(_pchip_end(h[::-1], m[::-1]))])


def _pchip_end(h: Any, m: Any) -> Any:
    slope = ((2 * h[0] + h[1]) * m[0] - h[0] * m[1]) / (h[0] + h[1])
    most = np.where((m[0] * m[1] <= 0) & (abs(slope) > 3 * abs(m[0])), 3 * m[0], slope)
    return np.where(slope * m[0] > 0, most, 0.0)


def _akima_slopes(_: Any, m: Any) -> Any:
    """Means of the slopes beside a knot, each weighted by the bend on the other side; straight on at the ends."""
    if len(m) == 1:
        return _row(m[0], m[0])
    left, right = 2 * m[0] - m[1], 2 * m[-1] - m[-2]
    on: Any = np.concatenate([_row(2 * left - m[0], left), m, _row(right, 2 * right - m[-1])])
    bends = abs(np.diff(on))
    behind, ahead = bends[:-2], bends[2:]
    both = behind + ahead
    weighted = (ahead * on[1:-2] + behind * on[2:-1]) / both
    return np.where(both > _FLAT * np.max(both), weighted, (on[3:] + on[:-3]) / 2)
