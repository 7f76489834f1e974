"""What numpy's elementwise functions make of recorded quantities."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np

from mechsheet.quantities.arithmetic import (
    absolute,
    angle,
    choice,
    conjugate,
    divide,
    elementwise,
    floor_divide,
    is_whole,
    multiply,
    polar,
    power,
    square,
    subtract,
    trunc,
)
from mechsheet.quantities.graph import NotRecorded
from mechsheet.quantities.linear_rules import product
from mechsheet.quantities.node import is_number
from mechsheet.quantities.quantity import UFUNCS, Quantity, lift
from mechsheet.quantities.truths import LOGICAL, added, bitwise, logical, multiplied


def _exp(x: Quantity) -> Any:
    graph = x.graph
    if x.im is None:
        return Quantity(graph, graph.fold("exp", x.re))
    turned = polar(Quantity(graph, x.im))
    return turned if is_number(x.re, 0) else multiply(Quantity(graph, graph.fold("exp", x.re)), turned)


def _log(x: Quantity) -> Any:
    if x.im is None:
        return elementwise("log")(x)
    return Quantity(x.graph, elementwise("log")(absolute(x)).re, angle(x).re)


_FEW, _MANY = 3, 16  # terms of a series that leave less than the rounding of floats, or of a ball of a proof


def _sinh(x: Quantity) -> Any:
    """With the digits of small arguments, by the first terms of its series."""
    series: Any = 1
    for k in range(2 * (_MANY if x.graph.unmoved else _FEW), 0, -2):
        series = 1 + x * x / (k * (k + 1)) * series
    return choice(x.graph, absolute(x) < 0.03, x * series, (_exp(x) - _exp(-x)) / 2)


def _cosh(x: Quantity) -> Any:
    return (_exp(x) + _exp(-x)) / 2


def _tanh(x: Quantity) -> Any:
    """No exponential of it is infinite: beyond the limits it is 1 to far more digits than there are."""
    if x.im is None:
        limit = lift(x.graph, 350.0)
        x = elementwise("max")(elementwise("min")(x, limit), -limit)
    return _sinh(x) / _cosh(x)


def _expm1(x: Quantity) -> Any:
    """With the digits of small arguments."""
    return choice(x.graph, absolute(x) < 1, 2 * _sinh(x / 2) * _exp(x / 2), _exp(x) - 1)


def _log1p(x: Quantity) -> Any:
    """With the digits of small arguments: the quotient's errors are the same above and below."""
    one = 1 + x
    return choice(x.graph, elementwise("eq")(one, lift(x.graph, 1.0)), x, _log(one) * x / (one - 1))


def _sin(x: Quantity) -> Any:
    if x.im is None:
        return elementwise("sin")(x)
    return Quantity(x.graph, (_sin(x.real) * _cosh(x.imag)).re, (_cos(x.real) * _sinh(x.imag)).re)


def _cos(x: Quantity) -> Any:
    if x.im is None:
        return elementwise("cos")(x)
    return Quantity(x.graph, (_cos(x.real) * _cosh(x.imag)).re, (-_sin(x.real) * _sinh(x.imag)).re)


def _sqrt(x: Quantity) -> Any:
    if x.im is None:
        return elementwise("sqrt")(x)
    return multiply(elementwise("sqrt")(absolute(x)), polar(angle(x) / 2))


def _hypot(x: Quantity, y: Quantity) -> Any:
    return absolute(Quantity(x.graph, x.re, y.re))


def finite(x: Quantity) -> Any:
    both = [Quantity(x.graph, x.graph.fold("finite", part)) for part in x.parts]
    return both[0] if len(both) == 1 else both[0] & both[1]


def _is_nan(x: Quantity) -> Any:
    """Whether it is no number: what an infinite one is made less by is finite."""
    return ~finite(elementwise("min")(absolute(x), Quantity(x.graph, x.graph.constant(1.0))))


def _is_infinite(x: Quantity) -> Any:
    return ~finite(x) & ~_is_nan(x)


def _number(x: Quantity, value: float) -> Quantity:
    """A number of the graph of ``x``, which takes no unit from it, as one that a line adds to it does."""
    return Quantity(x.graph, x.graph.constant(value, "-"))


def _reciprocal(x: Quantity) -> Any:
    if is_whole(x):
        raise NotRecorded("reciprocal of whole numbers, which is one")
    return 1 / x


def _copysign(x: Quantity, y: Quantity) -> Any:
    return choice(x.graph, y >= 0, absolute(x), -absolute(x))


def _heaviside(x: Quantity, y: Quantity) -> Any:
    return choice(x.graph, x > 0, 1.0, choice(x.graph, x < 0, 0.0, choice(x.graph, _is_nan(x), np.nan, y)))


def _where_known(combine: str) -> Callable[[Quantity, Quantity], Any]:
    """The greater or lesser of two, or the one that is a number."""

    def operation(x: Quantity, y: Quantity) -> Any:
        both = elementwise(combine)(x, y)
        return choice(x.graph, _is_nan(x), y, choice(x.graph, _is_nan(y), x, both))

    return operation


def _equal(x: Quantity, y: Quantity) -> Any:
    same = elementwise("eq")(x.real, y.real)
    return same if x.im is None and y.im is None else same & elementwise("eq")(x.imag, y.imag)


_ELEMENTWISE: dict[np.ufunc, str] = {
    np.arctan2: "atan2", np.remainder: "mod", np.tan: "tan",
    np.arcsin: "asin", np.arccos: "acos", np.sign: "sign", np.maximum: "max", np.minimum: "min",
    np.less: "lt", np.less_equal: "le", np.greater: "gt", np.greater_equal: "ge",
    np.rint: "round", np.floor: "floor",
}  # fmt: skip
_OF_UFUNCS: dict[Any, Callable[..., Any]] = {
    np.add: added, np.subtract: subtract, np.multiply: multiplied, np.true_divide: divide, np.power: power,
    np.float_power: power, np.negative: lambda x: x.each(x.graph.neg), np.positive: lambda x: x, np.absolute: absolute,
    np.fabs: absolute, np.conjugate: conjugate, np.reciprocal: _reciprocal,
    np.exp: _exp, np.sin: _sin, np.cos: _cos, np.log: _log, np.sqrt: _sqrt, np.hypot: _hypot,
    np.square: square, np.copysign: _copysign,
    np.heaviside: _heaviside, np.isnan: _is_nan, np.isfinite: finite, np.isinf: _is_infinite,
    np.signbit: lambda x: x < 0,
    np.equal: _equal, np.not_equal: lambda x, y: ~_equal(x, y),
    np.fmax: _where_known("max"), np.fmin: _where_known("min"),
    np.exp2: lambda x: 2.0**x, np.expm1: _expm1, np.log1p: _log1p,
    np.log2: lambda x: _log(x) / math.log(2), np.log10: lambda x: _log(x) / math.log(10),
    np.cbrt: lambda x: elementwise("sign")(x) * absolute(x) ** (1 / 3),
    np.sinh: _sinh, np.cosh: _cosh, np.tanh: _tanh,
    np.arctan: lambda x: elementwise("atan2")(x, _number(x, 1.0)),
    np.arcsinh: lambda x: elementwise("sign")(x) * _log1p(absolute(x) + x * x / (1 + _sqrt(x * x + 1))),
    np.arccosh: lambda x: _log1p(x - 1 + _sqrt((x - 1) * (x + 1))),
    np.arctanh: lambda x: _log1p(2 * x / (_number(x, 1.0) - x)) / 2,
    np.degrees: lambda x: x / (math.pi / 180), np.radians: lambda x: x * (math.pi / 180),
    np.rad2deg: lambda x: x / (math.pi / 180), np.deg2rad: lambda x: x * (math.pi / 180),
    np.ceil: lambda x: -elementwise("floor")(-x), np.trunc: trunc,
    np.floor_divide: floor_divide, np.divmod: lambda x, y: (floor_divide(x, y), elementwise("mod")(x, y)),
    np.fmod: lambda x, y: elementwise("sign")(x) * elementwise("mod")(absolute(x), absolute(y)),
    np.modf: lambda x: (x - trunc(x), trunc(x)),
    np.logaddexp: lambda x, y: elementwise("max")(x, y) + _log1p(_exp(-absolute(x - y))),
    np.matmul: lambda x, y: product(x.graph, x, y),
    np.ldexp: lambda x, n: x * 2.0**n,
    **{ufunc: elementwise(op) for ufunc, op in _ELEMENTWISE.items()},
    **{getattr(np, f"logical_{name}"): logical(of) for name, of in LOGICAL.items()},
    **{
        getattr(np, name): bitwise(name, LOGICAL[name[8:]])
        for name in ("bitwise_and", "bitwise_or", "bitwise_xor", "bitwise_not")
    },
}  # fmt: skip
UFUNCS.update(_OF_UFUNCS)
