"""What numpy's functions make of recorded quantities: a rule for each of those that a recording knows."""

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from mechsheet.recording.graph import Graph, NotRecorded, is_number
from mechsheet.recording.quantity import (
    FUNCTIONS,
    UFUNCS,
    Quantity,
    absolute,
    add,
    choice,
    conjugate,
    divide,
    elementwise,
    has_quantity,
    imaginary,
    lift,
    multiply,
    power,
    square,
    stack,
    subtract,
)


def _exp(x: Quantity) -> Quantity:
    graph = x.graph
    size = None if x.im is not None and is_number(x.re, 0) else Quantity(graph, graph.fold("EXP", x.re))
    if x.im is None:
        return Quantity(graph, graph.fold("EXP", x.re))
    turned = Quantity(graph, graph.fold("COS", x.im), graph.fold("SIN", x.im))
    return turned if size is None else multiply(size, turned)


def _angle(x: Quantity) -> Quantity:
    return Quantity(x.graph, x.graph.fold("ATAN2", imaginary(x), x.re))


def _hypot(x: Quantity, y: Quantity) -> Quantity:
    return absolute(Quantity(x.graph, x.re, y.re))


def _finite(x: Quantity) -> Quantity:
    both = [Quantity(x.graph, x.graph.fold("ISNUMBER", part)) for part in x.parts]
    return both[0] if len(both) == 1 else both[0] & both[1]


def _copysign(x: Quantity, y: Quantity) -> Quantity:
    return choice(x.graph, y >= 0, absolute(x), -absolute(x))


def _heaviside(x: Quantity, y: Quantity) -> Quantity:
    return choice(x.graph, x > 0, 1.0, choice(x.graph, x < 0, 0.0, y))


_ELEMENTWISE: dict[np.ufunc, str] = {
    np.arctan2: "ATAN2", np.remainder: "MOD", np.sqrt: "SQRT", np.sin: "SIN", np.cos: "COS", np.tan: "TAN",
    np.arcsin: "ASIN", np.arccos: "ACOS", np.log: "LN", np.sign: "SIGN", np.maximum: "MAX", np.minimum: "MIN",
    np.less: "<", np.less_equal: "<=", np.greater: ">", np.greater_equal: ">=", np.equal: "=", np.not_equal: "<>",
    np.logical_and: "AND", np.logical_or: "OR", np.logical_not: "NOT", np.bitwise_and: "AND", np.bitwise_or: "OR",
    np.invert: "NOT", np.rint: "ROUND",
}  # fmt: skip
UFUNCS.update({
    np.add: add, np.subtract: subtract, np.multiply: multiply, np.true_divide: divide, np.power: power,
    np.negative: lambda x: -x, np.positive: lambda x: x, np.absolute: absolute, np.conjugate: conjugate,
    np.exp: _exp, np.hypot: _hypot, np.square: square, np.copysign: _copysign, np.heaviside: _heaviside,
    np.isnan: lambda x: ~_finite(x), np.isfinite: _finite,
    **{ufunc: elementwise(op) for ufunc, op in _ELEMENTWISE.items()},
})  # fmt: skip


def _reduction(name: str) -> Callable[..., Quantity]:
    def operation(
        graph: Graph, x: Any, axis: int | None = None, keepdims: bool = False, initial: Any = None, where: Any = None
    ) -> Quantity:
        x = lift(graph, x) if where is None else choice(graph, where, x, initial)
        result: Quantity = getattr(x, name)(axis=axis, keepdims=keepdims)
        if initial is None:
            return result
        combine: Any = {"max": np.maximum, "min": np.minimum, "sum": np.add}[name]
        return lift(graph, combine(result, initial))

    return operation


def _joined(graph: Graph, parts: Sequence[Any], axis: int = 0) -> Quantity:
    return stack(graph, [lift(graph, p) for p in parts], axis)


def _stacked(graph: Graph, parts: Sequence[Any], axis: int = 0) -> Quantity:
    if axis not in (0, -1):
        raise NotRecorded(f"stack along axis {axis}")
    lifted = [lift(graph, p) for p in parts]
    return stack(graph, [p[..., None] for p in lifted], axis=-1) if axis else stack(graph, lifted)


def _rounded(graph: Graph, x: Any, decimals: int = 0) -> Quantity:
    if decimals:
        raise NotRecorded(f"round to {decimals} decimals")
    return lift(graph, elementwise("ROUND")(lift(graph, x)))


def _seen(f: Callable[..., Any]) -> Callable[..., Any]:
    """Function that finds positions: they are those of the present numbers, and a guard tells when they change."""

    def operation(graph: Graph, x: Any) -> Any:
        x = lift(graph, x)
        if x.re.op != "constant":
            graph.guards.append(((x != x.value).sum().re, 0))
        return f(x.value)

    return operation


def _trapezoid(graph: Graph, y: Any, x: Any = None, axis: int = -1) -> Quantity:
    if axis != -1:
        raise NotRecorded(f"trapezoid along axis {axis}")
    heights, places = lift(graph, y), lift(graph, x)
    return ((places[..., 1:] - places[..., :-1]) * (heights[..., 1:] + heights[..., :-1]) / 2).sum(axis=-1)


def _broadcast(graph: Graph, x: Any, shape: tuple[int, ...]) -> Quantity:
    return lift(graph, x).broadcast(shape)


FUNCTIONS.update({
    np.where: choice, np.angle: lambda graph, x: _angle(lift(graph, x)), np.real: lambda graph, x: lift(graph, x).real,
    np.imag: lambda graph, x: lift(graph, x).imag, np.shape: lambda graph, x: lift(graph, x).shape,
    np.ndim: lambda graph, x: lift(graph, x).ndim, np.size: lambda graph, x: lift(graph, x).size,
    np.concatenate: _joined, np.stack: _stacked, np.broadcast_to: _broadcast,
    np.max: _reduction("max"), np.amax: _reduction("max"), np.nanmax: _reduction("max"), np.min: _reduction("min"),
    np.amin: _reduction("min"), np.nanmin: _reduction("min"), np.sum: _reduction("sum"), np.any: _reduction("any"),
    np.all: _reduction("all"), np.round: _rounded,
    np.ravel: lambda graph, x: lift(graph, x).reshape(-1), np.trapezoid: _trapezoid,
    np.broadcast_arrays: lambda graph, *x: [_broadcast(graph, a, np.broadcast_shapes(*map(np.shape, x))) for a in x],
    np.argwhere: _seen(np.argwhere), np.nonzero: _seen(np.nonzero), np.flatnonzero: _seen(np.flatnonzero),
    np.count_nonzero: lambda graph, x: choice(graph, x, 1.0, 0.0).sum(),
    np.append: lambda graph, x, y: _joined(graph, [lift(graph, x).reshape(-1), lift(graph, y).reshape(-1)]),
})  # fmt: skip


def takes(f: Callable[..., Any], graph: Graph) -> Callable[..., Any]:
    """Function of numpy that also takes lists of recorded quantities."""

    def function(*args: Any, **kwargs: Any) -> Any:
        if f is np.array or f is np.asarray:
            return lift(graph, args[0]) if has_quantity(args[0]) else f(*args, **kwargs)
        if f is np.arange and not kwargs:
            ends = [int(a) for a in args]
            rows = Quantity(graph, graph.rows(len(range(*ends))))
            return rows * (ends[2] if ends[2:] else 1) + (ends[0] if ends[1:] else 0)
        if f is np.linspace and not kwargs:
            start, stop, count = args
            thin = graph.thin if (int(count) - 1) % graph.thin == 0 else 1
            rows = Quantity(graph, graph.rows((int(count) - 1) // thin + 1))
            return start + (stop - start) * (rows * thin / (count - 1))
        if f in (np.concatenate, np.stack):
            return f(*args, **kwargs) if not has_quantity(args[0]) else FUNCTIONS[f](graph, *args, **kwargs)
        if isinstance(f, np.ufunc) and len(args) == 1 and isinstance(args[0], list) and has_quantity(args[0]):
            return stack(graph, [f(lift(graph, a)) for a in args[0]])
        return f(*[lift(graph, a) if isinstance(a, list) and has_quantity(a) else a for a in args], **kwargs)

    return function
