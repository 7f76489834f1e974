"""Python's functions of numbers, of the modules math, cmath and statistics, by those of numpy that take quantities."""

import cmath
import math
from bisect import bisect_left, bisect_right
from collections.abc import Callable
from functools import reduce
from typing import Any

import numpy as np

from mechsheet.quantities.arithmetic import choice, whole
from mechsheet.quantities.graph import NotRecorded, current
from mechsheet.quantities.quantity import has_quantity, lift
from mechsheet.quantities.refused import refused, unbounded

_SAME = (
    "sqrt", "exp", "log", "log10", "log2", "log1p", "expm1", "sin", "cos", "tan", "sinh", "cosh", "tanh", "hypot",
    "degrees", "radians", "floor", "ceil", "trunc", "copysign", "isnan", "isfinite", "isinf", "fmod", "cbrt",
    "exp2", "modf", "ldexp",
)  # fmt: skip
_OTHER = {"asin": "arcsin", "acos": "arccos", "atan": "arctan", "atan2": "arctan2", "asinh": "arcsinh"}
_OTHER |= {"acosh": "arccosh", "atanh": "arctanh", "fabs": "abs", "pow": "power", "fsum": "sum"}
MATH: dict[Any, Any] = {getattr(math, name): getattr(np, _OTHER.get(name, name)) for name in [*_SAME, *_OTHER]}
MATH |= {f: f for f in (math.isclose, bisect_left, bisect_right)}  # which are not those of numpy
STATISTICS: dict[str, tuple[Any, dict[str, int]]] = {
    "mean": (np.mean, {}), "fmean": (np.mean, {}), "median": (np.median, {}), "pstdev": (np.std, {}),
    "pvariance": (np.var, {}), "stdev": (np.std, {"ddof": 1}), "variance": (np.var, {"ddof": 1}),
}  # fmt: skip
_REFUSING = (
    "sqrt",
    "log",
    "log10",
    "log2",
    "log1p",
    "asin",
    "acos",
    "acosh",
    "atanh",
    "pow",
    "fmod",
    "factorial",
    "isqrt",
)
_MOST = 170  # whose factorial is a float
_DIVISIONS = 24  # of Euclid's algorithm: they end for any two numbers up to 75 024


def _product(values: Any, *, start: Any = 1) -> Any:
    return lift(current.get(), values).reduced("prod") * start


def _remainder(x: Any, y: Any) -> Any:
    graph = current.get()
    x, y = lift(graph, x), np.abs(lift(graph, y))
    left = np.fmod(x, 2 * y)  # to the last bit, as what is taken off it
    far, sign = np.abs(left), np.where(left < 0, -1.0, 1.0)
    return sign * np.where(far <= y / 2, far, np.where(far - y < y / 2, far - y, far - 2 * y))


def _factorial(n: Any) -> Any:
    """By a table of those that are floats; there is none of another number."""
    graph = current.get()
    n = lift(graph, n)
    each = lift(graph, [float(math.factorial(k)) for k in range(_MOST + 1)])
    return whole(each[choice(graph, (n >= 0) & (n <= _MOST), n, np.nan)])


def _permutations(n: Any, k: Any = None) -> Any:
    return _factorial(n) if k is None else _drawn(n, k, lambda rest: _factorial(rest))


def _combinations(n: Any, k: Any) -> Any:
    return _drawn(n, k, lambda rest: _factorial(k) * _factorial(rest))


def _drawn(n: Any, k: Any, among: Callable[[Any], Any]) -> Any:
    """``n`` factorial over what it is ``among``, of the rest that is not drawn; 0 where there are not so many.

    Of numbers below zero there is none.
    """
    graph = current.get()
    n, k = lift(graph, n), lift(graph, k)
    known = n <= _MOST
    if not known.value.all():
        raise NotRecorded(f"of more than {_MOST} there are more ways than a float takes")
    graph.see(known.reduced("all").re)
    rest = n - k
    some = choice(graph, rest < 0, 0, np.floor(_factorial(n) / among(np.maximum(rest, 0)) + 0.5))
    return whole(choice(graph, (n >= 0) & (k >= 0), some, np.nan))


def _hypot(*parts: Any) -> Any:
    return reduce(np.hypot, parts) if len(parts) > 1 else np.abs(parts[0])


def _distance(p: Any, q: Any) -> Any:
    graph = current.get()
    return _hypot(*(lift(graph, p) - lift(graph, q)))


def _logarithm(x: Any, *base: Any) -> Any:
    return np.log(x) / np.log(base[0]) if base else np.log(x)


def _whole(f: Callable[..., Any]) -> Callable[..., Any]:
    """A function that gives whole numbers in the module math."""
    return lambda x: whole(f(x)) if has_quantity(x) else f(x)


def _common(a: Any, b: Any) -> Any:
    """The greatest common divisor of two whole numbers; none of those that take more divisions."""
    graph = current.get()
    a, b = np.abs(lift(graph, a)), np.abs(lift(graph, b))
    for _ in range(_DIVISIONS):
        ended = b == 0
        a, b = choice(graph, ended, a, b), choice(graph, ended, 0, a % choice(graph, ended, 1, b))
    return whole(choice(graph, b == 0, a, np.nan))


def _divisor(*numbers: Any) -> Any:
    return reduce(_common, numbers, 0)


def _multiple(*numbers: Any) -> Any:
    def of_two(a: Any, b: Any) -> Any:
        divisor = _common(a, b)
        return whole(np.abs(a * b) / choice(current.get(), divisor == 0, 1, divisor))

    return reduce(of_two, numbers, 1)


def _complex(f: Callable[..., Any]) -> Callable[..., Any]:
    """A function of the module cmath, which takes any number for a complex one."""
    return lambda z: f(z + 0j)


def _refusing(f: Callable[..., Any]) -> Callable[..., Any]:
    """A function that has no number of some arguments, for which the module math has an error."""
    return lambda *x: refused(f(*x)) if has_quantity(x) else f(*x)


def _unbounded(f: Callable[..., Any]) -> Callable[..., Any]:
    """A function of great arguments, for which the module math has an error."""
    return lambda x: unbounded(f(x)) if has_quantity(x) else f(x)


MATH |= {getattr(math, f.__name__): _whole(f) for f in (np.floor, np.ceil, np.trunc)}
MATH |= {math.isqrt: _whole(lambda x: np.floor(np.sqrt(x)))}
MATH |= {math.prod: _product, math.remainder: _remainder, math.factorial: _factorial}
MATH |= {math.perm: _permutations, math.comb: _combinations}
MATH |= {math.hypot: _hypot, math.dist: _distance, math.log: _logarithm}  # of any number of coordinates, to any base
MATH |= {math.gcd: _divisor, math.lcm: _multiple, cmath.phase: np.angle}
MATH |= {cmath.rect: lambda r, phi: r * np.exp(1j * phi), cmath.polar: lambda z: (np.abs(z), np.angle(z))}
MATH |= {f: _refusing(MATH[f]) for f in (getattr(math, name) for name in _REFUSING)}
MATH |= {f: _unbounded(MATH[f]) for f in (math.exp, math.expm1, math.sinh, math.cosh)}
MATH |= {getattr(cmath, f.__name__): _complex(f) for f in (np.exp, np.sqrt, np.log, np.sin, np.cos)}
