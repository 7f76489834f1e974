"""Means, spreads, orders and counts of recorded quantities, as numpy's functions have them."""

from typing import Any

import numpy as np

from mechsheet.quantities.arithmetic import absolute, choice, only_where, square
from mechsheet.quantities.array_rules import in_order, interpolated, may_lack, ordered
from mechsheet.quantities.graph import Graph, NotRecorded
from mechsheet.quantities.quantity import is_any_length, lift, moved
from mechsheet.quantities.ufunc_rules import finite


def median(graph: Graph, x: Any, axis: Any = None) -> Any:
    x = _in_order(graph, x, axis)
    count = x.count(0)
    low, high = (count - 1) // 2, count // 2
    return x[low] if isinstance(count, int) and low == high else (x[low] + x[high]) / 2


def _in_order(graph: Graph, x: Any, axis: Any) -> Any:
    """Numbers in order along the first axis; none where one of them is none."""
    x = lift(graph, x)
    x = ordered(graph, x.reshape(-1)) if axis is None else moved(ordered(graph, x, axis), axis, 0)
    return only_where(graph, ~np.isnan(x[-1:]), x) if x.extent[0] and may_lack(x) else x


def quantile(graph: Graph, x: Any, q: Any, axis: Any = None) -> Any:
    x, q = lift(graph, x), lift(graph, q)
    graph.see(((q >= 0) & (q <= 1)).reduced("all").re, why="a quantile is of a part from 0 to 1")
    x = _in_order(graph, x, axis)
    if x.ndim > 1 and q.ndim:
        raise NotRecorded("several of numpy's quantiles along an axis")
    if is_any_length(x) or x.ndim > 1:
        last = x.count(0) - 1
        at: Any = q * last
        low: Any = np.floor(at)
        return x[low] + (at - low) * (x[np.minimum(low + 1, last)] - x[low])
    return interpolated(graph, q * (len(x) - 1), np.arange(len(x)), x)


def mean(graph: Graph, x: Any, axis: Any = None, keepdims: bool = False) -> Any:
    x = lift(graph, x)
    return x.reduced("sum", axis, keepdims) / x.count(axis)


def average(graph: Graph, x: Any, axis: Any = None, weights: Any = None) -> Any:
    if weights is None:
        return mean(graph, x, axis)
    x, weights = lift(graph, x), lift(graph, weights)
    if axis is not None and weights.ndim == 1:  # along it
        weights = weights[(slice(None), *(None,) * (x.ndim - 1 - axis % x.ndim))]
    if axis is None:
        graph.go_together(*x.parts, *weights.parts, strictly=True)
    whole = (weights + 0 * x).reduced("sum", axis)
    return (x * weights).reduced("sum", axis) / choice(graph, whole == 0, np.nan, whole)


def known_mean(graph: Graph, x: Any, axis: Any = None) -> Any:
    x = lift(graph, x)
    return x.reduced("nansum", axis) / choice(graph, finite(x), 1.0, 0.0).reduced("sum", axis)


def filled_up(graph: Graph, x: Any, instead: float) -> Any:
    return lift(graph, choice(graph, finite(lift(graph, x)), x, instead))


def known_variance(graph: Graph, x: Any, axis: Any = None, ddof: Any = 0) -> Any:
    x = lift(graph, x)
    mean = known_mean(graph, x, axis) if axis is None else np.expand_dims(known_mean(graph, x, axis), axis)
    count = choice(graph, finite(x), 1.0, 0.0).reduced("sum", axis)
    return square(absolute(x - mean)).reduced("nansum", axis) / (count - ddof)


def variance(graph: Graph, x: Any, axis: Any = None, ddof: Any = 0) -> Any:
    x = lift(graph, x)
    off = square(absolute(x - mean(graph, x, axis, True)))
    return off.reduced("sum", axis) / (x.count(axis) - ddof)


def covariance(graph: Graph, x: Any, y: Any = None, rowvar: bool = True, bias: bool = False, ddof: Any = None) -> Any:
    """numpy's cov, of rows or columns, or of one quantity alone."""
    x = lift(graph, x)
    rows = [*(x if x.ndim > 1 and rowvar else x.T if x.ndim > 1 else [x]), *([] if y is None else [lift(graph, y)])]
    off = [row - mean(graph, row) for row in rows]
    left = rows[0].count(0) - ((0 if bias else 1) if ddof is None else ddof)
    table = [[(one * other).reduced("sum") / left for other in off] for one in off]
    return lift(graph, table) if len(rows) > 1 else table[0][0]


def correlation(graph: Graph, *given: Any, **rest: Any) -> Any:
    """numpy's corrcoef."""
    table = covariance(graph, *given, **rest)
    spread = np.sqrt(np.diagonal(table)) if table.ndim else np.sqrt(table)
    return table / (spread[:, None] * spread) if table.ndim else table / spread**2


def norm(graph: Graph, x: Any, ord: Any = None, axis: Any = None, keepdims: bool = False) -> Any:
    x = lift(graph, x)
    size = absolute(x)
    if ord is not None and axis is None and x.ndim > 1:
        if ord not in (1, np.inf):
            raise NotRecorded(f"numpy's norm of the order {ord} of a matrix")
        return size.reduced("sum", 0 if ord == 1 else 1).reduced("max")
    if ord in (np.inf, -np.inf):
        return size.reduced("max" if ord > 0 else "min", axis, keepdims)
    if ord == 0:
        return choice(graph, size == 0, 0.0, 1.0).reduced("sum", axis, keepdims)
    if ord in (None, 2):
        return np.sqrt(square(size).reduced("sum", axis, keepdims))
    return (size**ord).reduced("sum", axis, keepdims) ** (1 / ord)


def histogram(graph: Graph, x: Any, bins: Any = 10, range: Any = None) -> Any:
    """Numbers between each two edges, with the last edge, and the edges."""
    x, edges = lift(graph, x).reshape(-1), lift(graph, bins)
    if edges.ndim:
        in_order(graph, edges)
    else:
        low, high = (x.reduced("min"), x.reduced("max")) if range is None else map(lambda v: lift(graph, v), range)
        part = np.linspace(0, 1, int(edges) + 1)
        same = low == high
        low, high = choice(graph, same, low - 0.5, low), choice(graph, same, high + 0.5, high)
        edges = choice(graph, part == 1, high, low + (high - low) * part)
    lower, upper = edges[:-1], edges[1:]
    below = choice(graph, np.arange(upper.count(0)) == upper.count(0) - 1, x[:, None] <= upper, x[:, None] < upper)
    some = choice(graph, (x[:, None] >= lower) & below, 1, 0).reduced("sum", 0)
    return some if range is None else choice(graph, edges[0] <= edges[-1], some, np.nan), edges
