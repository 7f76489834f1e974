"""What numpy's functions make of recorded quantities: a rule for each of those that a recording knows."""

import math
from bisect import bisect_left, bisect_right
from collections.abc import Callable
from copy import copy
from typing import Any

import numpy as np

from mechsheet.quantities import polynomial_rules, text_column
from mechsheet.quantities.arithmetic import absolute, angle, choice, conjugate, cuts, is_whole, rounded, trunc
from mechsheet.quantities.array_rules import (
    blocks,
    cross,
    digitized,
    interpolated,
    least_squares,
    order,
    ordered,
    place_of,
    polynomial_fit,
    searched,
    summed,
    taken,
    taken_of,
    unwrapped,
)
from mechsheet.quantities.graph import Graph, Guard, NotRecorded
from mechsheet.quantities.linear_rules import (
    cholesky,
    determinant,
    diagonal,
    eigen,
    eigenvalues,
    inverse,
    kron,
    lower,
    matrix_power,
    outer,
    product,
    products,
    solution,
    transformed,
    upper,
)
from mechsheet.quantities.operations import REDUCE_SO_FAR
from mechsheet.quantities.quantity import FUNCTIONS, REDUCTIONS, Quantity, has_quantity, joined, lift, moved, plain
from mechsheet.quantities.refused import compared
from mechsheet.quantities.selected import Selected, also_of_selected
from mechsheet.quantities.shifted import inserted, padded, rolled, without
from mechsheet.quantities.statistics_rules import (
    average,
    correlation,
    covariance,
    filled_up,
    histogram,
    known_mean,
    known_variance,
    mean,
    median,
    norm,
    quantile,
    variance,
)
from mechsheet.quantities.ufunc_rules import finite

_OF_REDUCTIONS: dict[Any, str] = {
    np.add: "sum", np.multiply: "prod", np.maximum: "max", np.minimum: "min", np.logical_and: "all",
    np.logical_or: "any", np.fmax: "nanmax", np.fmin: "nanmin",
}  # fmt: skip
REDUCTIONS.update(_OF_REDUCTIONS)


def _reduction(kind: str) -> Callable[..., Any]:
    neutral: dict[str, float] = {"sum": 0.0, "prod": 1.0, "any": False, "all": True, "nansum": 0.0}
    combine = {"max": np.maximum, "min": np.minimum, "sum": np.add, "prod": np.multiply}

    def operation(
        graph: Graph, x: Any, axis: Any = None, keepdims: bool = False, initial: Any = None, where: Any = None,
        dtype: Any = None,
    ) -> Any:  # fmt: skip
        x = lift(graph, x)
        if where is not None and where is not True:
            x = choice(graph, where, x, neutral.get(kind) if initial is None else initial)
        if initial is not None and isinstance(x, Selected):
            x = x.filled(kind)
        result = x.reduced(kind, axis, keepdims)
        if initial is not None and kind == "max" and x.re.op == "abs" and initial == 0.0:  # the least
            return result
        return result if initial is None else lift(graph, combine[kind.removeprefix("nan")](result, initial))

    return operation


for _ufunc, _kind in REDUCTIONS.items():
    FUNCTIONS[_ufunc, "reduce"] = (  # of a ufunc: along the first axis, where none is given
        lambda graph, x, axis=0, _kind=_kind, **rest: _reduction(_kind)(graph, x, axis, **rest)
    )
    FUNCTIONS[_ufunc, "accumulate"] = lambda graph, x, axis=0, _kind=_kind: _so_far(_kind)(graph, x, axis)


def _so_far(kind: str) -> Callable[..., Any]:
    def operation(graph: Graph, x: Any, axis: int | None = None, dtype: Any = None) -> Any:
        x = lift(graph, x)
        if kind not in REDUCE_SO_FAR:
            raise NotRecorded(f"{kind} of the elements up to each one")
        if axis is None:
            x, axis = x.reshape(-1), 0
        return x.each(lambda node: graph.scan(kind, node, axis % x.ndim))

    return operation


def _rearranged(f: Callable[..., Any]) -> Callable[..., Any]:
    """Function that only moves elements: what it does with their positions, it does with them."""

    def operation(graph: Graph, x: Any, *args: Any, **kwargs: Any) -> Any:
        given, named = [plain(a) for a in args], {name: plain(a) for name, a in kwargs.items()}
        x = lift(graph, x)
        if f in (np.split, np.array_split):
            count = len(f(np.empty(x.extent), *given, **named))
            return [x.rearranged(_part, f, n, *given, **named) for n in range(count)]
        return x.rearranged(f, *given, **named)

    return operation


def _part(order: Any, split: Callable[..., Any], n: int, *args: Any, **kwargs: Any) -> Any:
    """One of the parts into which elements are split."""
    return split(order, *args, **kwargs)[n]


def _joined(f: Callable[..., Any]) -> Callable[..., Any]:
    """Function that puts several quantities together as one."""

    def operation(graph: Graph, parts: Any, *args: Any, **kwargs: Any) -> Any:
        return joined([lift(graph, p) for p in parts], f, *args, **kwargs)

    return operation


def _seen(f: Callable[..., Any]) -> Callable[..., Any]:
    """Function that finds positions: they are those of the present numbers, and a guard tells when they change."""

    def operation(graph: Graph, *args: Any, **kwargs: Any) -> Any:
        return f(*(lift(graph, x).seen() if has_quantity(x) else x for x in args), **kwargs)

    return operation


def _ends(x: Quantity, axis: int) -> tuple[Any, Any]:
    """All but the last and all but the first element along an axis."""
    before = (slice(None),) * (axis % x.ndim)
    return x[(*before, slice(None, -1))], x[(*before, slice(1, None))]


def _difference(graph: Graph, x: Any, n: int = 1, axis: int = -1, prepend: Any = None, append: Any = None) -> Any:
    x = lift(graph, x)
    one = x[(slice(None),) * (axis % x.ndim) + (slice(1),)]
    ends = [None if end is None else lift(graph, end) for end in (prepend, append)]
    before, after = ([] if end is None else [end if end.ndim else end.like(one)] for end in ends)
    if before or after:
        x = _joined(np.concatenate)(graph, [*before, x, *after], axis=axis)
    for _ in range(n):
        lower, upper = _ends(x, axis)
        x = upper - lower
    return x


def _strips(graph: Graph, y: Any, x: Any, dx: Any, axis: int) -> Any:
    lower, upper = _ends(lift(graph, y), axis)
    if x is None:
        return (lower + upper) * dx / 2
    x = lift(graph, x)
    start, end = _ends(x, axis if x.ndim > 1 else -1)
    width = end - start
    if x.ndim == 1 and lower.ndim > 1:
        width = width[(slice(None), *(None,) * (lower.ndim - 1 - axis % lower.ndim))]
    return width * (lower + upper) / 2


def _trapezoid(graph: Graph, y: Any, x: Any = None, dx: Any = 1.0, axis: int = -1) -> Any:
    return _strips(graph, y, x, dx, axis).reduced("sum", axis)


def trapezoid_so_far(graph: Graph, y: Any, x: Any = None, dx: Any = 1.0, axis: int = -1, initial: Any = None) -> Any:
    """scipy's cumulative_trapezoid."""
    parts = _so_far("sum")(graph, _strips(graph, y, x, dx, axis), axis)
    if initial is None:
        return parts
    one = parts[(slice(None),) * (axis % parts.ndim) + (slice(1),)]
    return _joined(np.concatenate)(graph, [lift(graph, float(initial)).like(one), parts], axis=axis)


def simpson(graph: Graph, y: Any, x: Any = None, *, dx: Any = 1.0, axis: int = -1) -> Any:
    """scipy's simpson: parabolas over each two strips, and over the last one the end of the parabola before it."""
    y = moved(lift(graph, y), axis, -1)
    widths = lift(graph, dx).like(y[..., 1:]) if x is None else _difference(graph, x)
    graph.measure(y.re)
    if (count := y.extent[-1]) < 3:
        return _trapezoid(graph, y, x, dx)
    first = slice(0, count - 2, 2)
    a, b = widths[..., first], widths[..., 1 : count - 1 : 2]
    low, middle, high = y[..., first], y[..., 1 : count - 1 : 2], y[..., 2:count:2]
    parts = (a + b) / 6 * ((2 - b / a) * low + (a + b) ** 2 / (a * b) * middle + (2 - a / b) * high)
    whole = parts.reduced("sum", -1)
    if count % 2 == 0:
        a, b = widths[..., -2], widths[..., -1]
        last = (2 * b + 3 * a) * b / (6 * (a + b)) * y[..., -1] + (b + 3 * a) * b / (6 * a) * y[..., -2]
        whole = whole + last - b**3 / (6 * a * (a + b)) * y[..., -3]
    return whole


def _gradient(graph: Graph, y: Any, x: Any = 1.0, axis: Any = None, edge_order: int = 1) -> Any:
    y = lift(graph, y)
    if y.ndim != 1 and axis is None:
        raise NotRecorded("numpy's gradient of a table along all of its axes")
    y = y if axis is None else moved(y, axis, -1)
    if np.ndim(x):
        graph.go_together(*y.parts, *lift(graph, x).parts, strictly=True)
    h = _difference(graph, x) if np.ndim(x) else lift(graph, x).like(y[..., 1:])
    slope = _difference(graph, y) / h
    start, end = slope[..., :-1], slope[..., 1:]
    bend = (end - start) / (h[..., 1:] + h[..., :-1])
    first, last = slope[..., :1], slope[..., -1:]
    inner = start + bend * h[..., :-1] if np.ndim(x) else (y[..., 2:] - y[..., :-2]) / (2 * x)
    if edge_order == 2:
        first, last = first - bend[..., :1] * h[..., :1], last + bend[..., -1:] * h[..., -1:]
    whole = _joined(np.concatenate)(graph, [first, inner, last], axis=-1)
    return whole if axis is None else moved(whole, -1, axis)


def _selected(graph: Graph, conditions: Any, choices: Any, default: Any = 0) -> Any:
    value = default
    for condition, one in reversed(list(zip(conditions, choices, strict=True))):
        value = text_column.chosen(graph, condition, one, value)
    return value


def _piecewise(graph: Graph, x: Any, conditions: Any, functions: Any) -> Any:
    values = [f(x) if callable(f) else f for f in functions]
    rest = values.pop() if len(values) > len(conditions) else 0
    chosen = _selected(graph, list(conditions)[::-1], values[::-1], rest)  # of several the last one counts
    return chosen.astype(int) if cuts(lift(graph, x)) else chosen


def _chosen(graph: Graph, condition: Any, *both: Any) -> Any:
    if not both:
        return np.nonzero(condition)
    plain = [each for each in both if not isinstance(each, Quantity | list | tuple)]
    if not any(isinstance(each, text_column.Texts) or np.asarray(each).dtype.kind == "U" for each in plain):
        graph.go_together(*(part for each in (condition, *both) for part in lift(graph, each).parts), hidden=True)
    return text_column.chosen(graph, condition, *both)


def _clipped(graph: Graph, x: Any, low: Any = None, high: Any = None, min: Any = None, max: Any = None) -> Any:
    low, high = min if low is None else low, max if high is None else high
    x = x if low is None else np.maximum(x, low)
    return lift(graph, x if high is None else np.minimum(x, high))


def _close(graph: Graph, x: Any, y: Any, rtol: float = 1e-5, atol: float = 1e-8) -> Any:
    x, y = lift(graph, x), lift(graph, y)
    graph.go_together(*x.parts, *y.parts, hidden=True)
    return (x == y) | (finite(y) & (absolute(x - y) <= atol + rtol * absolute(y)))


def _near(graph: Graph, x: Any, y: Any, *, rel_tol: float = 1e-9, abs_tol: float = 0.0) -> Any:
    """Python's isclose."""
    x, y = lift(graph, x), lift(graph, y)
    return absolute(x - y) <= np.maximum(rel_tol * np.maximum(absolute(x), absolute(y)), abs_tol)


def _like(value: Any) -> Callable[..., Any]:
    def operation(graph: Graph, x: Any, *given: Any, dtype: Any = None) -> Any:
        x = lift(graph, x)
        return lift(graph, *(given or (value,))).astype(dtype or (int if cuts(x) else x.dtype)).like(x)

    return operation


def _first(kind: str) -> Callable[..., Any]:
    def operation(graph: Graph, x: Any, axis: Any = None, keepdims: bool = False) -> Any:
        x = lift(graph, x)
        if x.dtype == bool:
            return choice(graph, x, 1.0, 0.0).reduced(kind, axis, keepdims)
        every = x.compared(kind) if isinstance(x, Selected) and x.compares else copy(x)  # which is no other name of x
        compared(x)
        graph.chosen.append((every, axis, kind))
        return x.reduced(kind, axis, keepdims)

    return operation


def _broadcast(graph: Graph, x: Any, shape: Any) -> Any:
    return lift(graph, x).broadcast(plain(shape if isinstance(shape, tuple) else (shape,)))


def _broadcast_arrays(graph: Graph, *x: Any) -> list[Quantity]:
    arrays = [lift(graph, a) for a in x]
    shapes = dict[Any, Quantity]()
    for part in (part for array in arrays for part in array.parts):
        shapes.setdefault(graph.size(part) if part.stretches else part.shape, Quantity(graph, part))
    return [array.like(*shapes.values()) for array in arrays]


def _is_among(graph: Graph, x: Any, several: Any, assume_unique: bool = False, invert: bool = False) -> Any:
    """numpy's isin."""
    same = (lift(graph, x)[..., None] == lift(graph, several).ravel()).reduced("any", -1)
    return ~same if invert else same


def _geometric(graph: Graph, start: Any, stop: Any, *count: Any) -> Any:
    start, stop = lift(graph, start), lift(graph, stop)
    start = choice(graph, start * stop == 0, np.nan, start)
    return start * (stop / start) ** linspace(graph, 0.0, 1.0, *count)


def _real(graph: Graph, x: Any) -> Any:
    return lift(graph, x).real


_OF_FUNCTIONS: dict[Any, Callable[..., Any]] = {
    np.where: _chosen, np.real: _real, np.take: taken, np.choose: taken_of,
    np.angle: lambda graph, x, deg=False: np.degrees(angle(lift(graph, x))) if deg else angle(lift(graph, x)),
    np.imag: lambda graph, x: lift(graph, x).imag, np.shape: lambda graph, x: lift(graph, x).shape,
    np.ndim: lambda graph, x: lift(graph, x).ndim, np.size: lambda graph, x: lift(graph, x).size,
    np.iscomplexobj: lambda graph, x: lift(graph, x).im is not None, np.copy: lambda graph, x: copy(lift(graph, x)),
    **{f: lambda graph, x, decimals=0: rounded(lift(graph, x), decimals) for f in (np.round, np.around)},
    np.fix: lambda graph, x: trunc(x),
    np.max: _reduction("max"), np.amax: _reduction("max"), np.nanmax: _reduction("nanmax"),
    np.min: _reduction("min"), np.amin: _reduction("min"), np.nanmin: _reduction("nanmin"),
    np.sum: _reduction("sum"), np.nansum: _reduction("nansum"), np.prod: _reduction("prod"),
    np.any: _reduction("any"), np.all: _reduction("all"), np.argmax: _first("argmax"), np.argmin: _first("argmin"),
    np.ptp: lambda graph, x, axis=None: lift(graph, x).reduced("max", axis) - lift(graph, x).reduced("min", axis),
    np.mean: mean, np.average: average, np.nanmean: known_mean, np.var: variance, np.median: median,
    np.std: lambda graph, x, axis=None, ddof=0: np.sqrt(variance(graph, x, axis, ddof)), np.quantile: quantile,
    np.percentile: lambda graph, x, q, axis=None: quantile(graph, x, lift(graph, q) / 100, axis),
    np.count_nonzero: lambda graph, x, axis=None: choice(graph, x, 1, 0).reduced("sum", axis),
    np.cumsum: _so_far("sum"), np.cumprod: _so_far("prod"), np.diff: _difference, np.ediff1d: _difference,
    np.trapezoid: _trapezoid, np.gradient: _gradient, np.interp: interpolated, np.searchsorted: searched,
    np.digitize: digitized, np.sort: ordered, np.cov: covariance, np.corrcoef: correlation, np.kron: kron,
    np.argsort: order, np.cross: cross, np.unwrap: unwrapped, np.einsum: summed, np.linalg.lstsq: least_squares,
    np.polyfit: polynomial_fit, np.dot: product, np.inner: product,
    np.vdot: lambda graph, x, y: product(graph, conjugate(lift(graph, x)).reshape(-1), lift(graph, y).reshape(-1)),
    np.outer: outer, np.linalg.solve: solution, np.linalg.det: determinant, np.linalg.norm: norm,
    np.linalg.inv: inverse, np.linalg.cholesky: cholesky, np.cumulative_sum: _so_far("sum"),
    np.sinc: lambda graph, x: choice(graph, lift(graph, x) == 0, 1.0, np.sin(np.pi * x) / (np.pi * x)),
    np.linalg.eigvalsh: eigenvalues,
    np.linalg.eigh: eigen,
    np.histogram: histogram,
    np.trace: lambda graph, A: lift(graph, A)[np.arange(len(A)), np.arange(len(A))].reduced("sum"),
    np.trim_zeros: polynomial_rules.without_zeros,
    np.polyval: polynomial_rules.value, np.polyder: polynomial_rules.derivative, np.polyint: polynomial_rules.integral,
    np.convolve: polynomial_rules.convolved, np.polymul: polynomial_rules.convolved,
    np.polyadd: polynomial_rules.added, np.polysub: lambda graph, p, q: np.polyadd(p, -lift(graph, q)),
    np.roots: polynomial_rules.roots,
    np.diag: diagonal, np.triu: upper, np.tril: lower, np.linalg.matrix_power: matrix_power,
    np.linalg.multi_dot: products,
    **{f: transformed(f) for f in (np.fft.fft, np.fft.ifft, np.fft.rfft, np.fft.irfft)},
    np.logspace: lambda graph, *ends: 10.0 ** linspace(graph, *ends),
    np.geomspace: _geometric,
    np.nanprod: lambda graph, x, axis=None: filled_up(graph, x, 1.0).reduced("prod", axis),
    np.nancumsum: lambda graph, x, axis=None: _so_far("sum")(graph, filled_up(graph, x, 0.0), axis),
    np.nanvar: known_variance, np.nanstd: lambda graph, *args, **rest: np.sqrt(known_variance(graph, *args, **rest)),
    np.select: _selected, np.piecewise: _piecewise, np.clip: _clipped, np.isclose: _close, np.isin: _is_among,
    math.isclose: _near, bisect_left: searched, bisect_right: lambda graph, a, x: searched(graph, a, x, "right"),
    np.allclose: lambda graph, *args, **rest: _close(graph, *args, **rest).reduced("all"),
    np.nan_to_num: lambda graph, x, nan=0.0: choice(graph, finite(lift(graph, x)), x, nan),
    np.zeros_like: _like(0.0), np.ones_like: _like(1.0), np.full_like: _like(np.nan), np.empty_like: _like(0.0),
    np.broadcast_to: _broadcast,
    np.broadcast_arrays: _broadcast_arrays,
    np.meshgrid: lambda graph, *x, **rest: [
        lift(graph, a)[where] for a, where in zip(x, np.meshgrid(*(np.arange(len(a)) for a in x), **rest), strict=True)
    ],
    np.append: lambda graph, x, y, axis=None: _joined(np.concatenate)(
        graph, [lift(graph, p).reshape(-1) if axis is None else p for p in (x, y)], axis=axis or 0
    ),
    **{f: _joined(f) for f in (np.concatenate, np.stack, np.vstack, np.hstack, np.dstack, np.column_stack)},
    np.block: blocks, np.unravel_index: place_of,
    np.roll: rolled, np.insert: inserted, np.delete: without, np.pad: padded,
    **{f: _seen(f) for f in (np.argwhere, np.unique, np.ix_, np.setdiff1d, np.union1d, np.intersect1d)},
    **{f: _rearranged(f) for f in (
        np.ravel, np.reshape, np.transpose, np.squeeze, np.expand_dims, np.moveaxis, np.swapaxes, np.flip,
        np.fliplr, np.flipud, np.rot90, np.repeat, np.tile, np.resize, np.split, np.array_split,
        np.atleast_1d, np.atleast_2d, np.diagonal, np.take_along_axis,
    )},
}  # fmt: skip
FUNCTIONS.update(_OF_FUNCTIONS)


def counted(graph: Graph, count: Any, kind: type = int) -> Quantity:
    """The numbers 0, 1, 2 .. of so many rows, which a writer with a fixed number of them notes."""
    count = lift(graph, count)
    rows, same = graph.rows(count.re, kind), graph.same(count.re)
    graph.see(same, rows=True)
    if not (rows.size or graph.draws or same in graph.fixed):  # no cell of a row notes that there are none
        graph.looked.setdefault(same, Guard(same, graph.line))
    return Quantity(graph, rows)


def filled(graph: Graph, shape: Any, value: Any) -> Any:
    """An array of one value."""
    axes = list(shape) if isinstance(shape, tuple | list) else [shape]
    array = lift(graph, value)
    for k, count in enumerate(axes):
        array = array.like(counted(graph, count)[(..., *(None,) * (len(axes) - 1 - k))])
    return array


def arange(graph: Graph, *ends: Any, dtype: Any = None) -> Any:
    """numpy's arange."""
    start, stop, step = (0, *ends, 1) if len(ends) == 1 else (*ends, 1)[:3]
    if not has_quantity(ends) and not all(float(e).is_integer() for e in ends):
        return np.arange(*ends)
    count, kind = stop - start, int if all(is_whole(lift(graph, end)) for end in ends) else float
    if kind is float or not (isinstance(step, int) and step == 1):
        count = np.maximum(np.ceil(count if step == 1 else count / step), 0)
    return counted(graph, as_many(lift(graph, count)), kind) * step + start


def as_many(count: Quantity) -> Quantity:
    """So many rows; where readers take any number of them, none where there would be less."""
    any_number = count.graph.draws and count.re not in count.graph.counts
    return lift(count.graph, np.maximum(count, 0)) if any_number else count


def linspace(graph: Graph, start: Any, stop: Any, count: Any = 50, endpoint: bool = True) -> Any:
    """numpy's linspace, of the positions alone that tables list.

    What compares as numpy does has it to the last bit: a limit may stand at one of the positions. The cells of a
    workbook, which take what differs by rounding for equal, have it as it is usually written.
    """
    pieces = count - int(endpoint)
    present = int(lift(graph, pieces).value)
    thin = graph.thin if endpoint and present // graph.thin + 1 in graph.listed else 1
    if thin > 1:
        graph.positions = present + 1
    rows = counted(graph, pieces // thin + 1 if thin > 1 else count, float) * thin
    if not (graph.draws or graph.bodies):
        return start + (stop - start) * (rows / pieces)
    places = start + rows * ((stop - start) / pieces)
    if not endpoint:
        return places
    last = choice(graph, pieces > 0, stop, start) if isinstance(pieces, Quantity) else stop if pieces > 0 else start
    return choice(graph, rows < pieces, places, last)


FUNCTIONS.update(also_of_selected(FUNCTIONS))
