"""Fits by least squares, orders, places in them and products of arrays, by rules that run on recorded quantities."""

import string
from collections.abc import Iterator
from copy import copy
from functools import reduce
from operator import mul
from typing import Any

import numpy as np

from mechsheet.quantities.arithmetic import choice
from mechsheet.quantities.graph import Graph, NotRecorded
from mechsheet.quantities.quantity import Quantity, is_any_length, joined, lift, moved
from mechsheet.quantities.refused import compared
from mechsheet.quantities.truths import are_truths
from mechsheet.units import UNKNOWN

SORTED = 64  # so many numbers are put in order by comparisons; the order of more is that of the present ones
_KEPT = 3  # equal numbers among so many are in order on every processor; numpy sorts more as each has instructions for
_EQUAL = "of equal numbers argsort keeps the order with kind='stable' alone"
_MOST = 8  # unknowns of a fit


def least_squares(graph: Graph, A: Any, b: Any, rcond: Any = None) -> Any:
    """numpy's lstsq: unknowns, sums of the squares left, rank; the singular values are not recorded.

    Gram and Schmidt's columns of the matrix with the right sides beside it, each made orthogonal twice: as accurate as
    Householder's, where the normal equations square the condition. Columns that rest on each other give no number.
    """
    A, b = lift(graph, A), lift(graph, b)
    size = A.extent[-1]
    if A.ndim != 2 or b.ndim not in (1, 2) or size > _MOST or A.extent[0] < size or A.im is not None:
        raise NotRecorded(f"least squares of other than up to {_MOST} unknowns in as many equations or more")
    columns, along = list[Quantity](), list[list[Any]]()
    for k in range(size):
        part, parts = _orthogonal(A[:, k], columns)
        own, length = (np.sqrt((v * v).sum()) for v in (A[:, k], part))
        rest: Any = np.where(length > own * A.extent[0] * np.finfo(float).eps, length, np.nan)
        columns.append(part / rest)
        along.append([*parts, rest])
    solved, left = list[Any](), list[Any]()
    for right in [b] if b.ndim == 1 else [b[:, k] for k in range(b.extent[1])]:
        rest, parts = _orthogonal(right, columns)
        for i in reversed(range(size)):
            for j in range(i + 1, size):
                parts[i] = parts[i] - along[j][i] * parts[j]
            parts[i] = parts[i] / along[i][i]
        solved.append(lift(graph, parts))
        left.append((rest * rest).sum())
    x = solved[0] if b.ndim == 1 else moved(lift(graph, solved), 0, -1)
    return x, lift(graph, left if A.extent[0] > size else []), size, np.full(size, np.nan)


def _orthogonal(column: Quantity, columns: list[Quantity]) -> tuple[Quantity, list[Any]]:
    """What of a column is across all others, which have the length 1, and its parts along them."""
    parts: list[Any] = [0.0] * len(columns)
    for _ in range(2):
        for k, other in enumerate(columns):
            part = (other * column).sum()
            column, parts[k] = column - part * other, parts[k] + part
    return column, parts


def polynomial_fit(graph: Graph, x: Any, y: Any, deg: int, rcond: Any = None, full: bool = False, w: Any = None) -> Any:
    """numpy's polyfit; its columns are made as long as each other first, as numpy's are."""
    if full:
        raise NotRecorded("numpy's polyfit with all that it tells")
    x, y = lift(graph, x), lift(graph, y)
    graph.go_together(*x.parts, *y.parts, strictly=True)
    powers = [x**k if k else lift(graph, 1.0).like(x) for k in reversed(range(deg + 1))]
    if w is not None:
        powers, y = [power * w for power in powers], y * w
    lengths = [np.sqrt((power * power).sum()) for power in powers]
    matrix = np.stack([power / length for power, length in zip(powers, lengths, strict=True)], axis=-1)
    found, *_ = least_squares(graph, matrix, y)
    return lift(graph, [found[k] / length for k, length in enumerate(lengths)])


def to_sort(graph: Graph, x: Any, axis: Any) -> tuple[Quantity, int, int]:
    """What is put in order along its last axis, the axis that this was, and how many numbers it has."""
    x = lift(graph, x)
    if axis is None:
        x, axis = x.reshape(-1), 0
    x = moved(x, axis, -1)
    graph.measure(x.re)
    return x, axis, x.extent[-1]


def may_lack(x: Quantity) -> bool:
    """Whether some of the numbers may be none, which numpy puts behind all others; in cells it spreads."""
    return x.graph.refuses or bool(np.isnan(x.value).any())


def is_ranked(x: Quantity) -> bool:
    """Whether numbers are put in order by comparing each with all others, however many they are."""
    return is_any_length(x) and x.extent[0] <= SORTED


def order(graph: Graph, x: Any, axis: Any = -1, kind: Any = None, stable: Any = None) -> Any:
    """numpy's argsort, equal numbers in the order that they have: where the rank of each one points.

    Where numpy may take these in any order, that of the run is known as long as each is less than the same others.
    """
    compared(x := lift(graph, x))
    by_machine = not stable and kind not in ("stable", "mergesort")
    graph.chosen.append((copy(x), axis, "argsort"))
    if is_ranked(x):
        number: Any = Quantity(graph, graph.rows(graph.length(x.re, -1)))
    else:
        x, axis, count = to_sort(graph, x, axis)
        if count > SORTED:
            return _now(x.seen(), axis, kind, stable)
        number = np.arange(count)
    one, other = x[..., :, None], x[..., None, :]
    if by_machine and (is_ranked(x) or count > _KEPT):
        equal: Any = (other == one) & (number != number[:, None])
        if equal.value.any():
            (other < one).seen()
            return _now(x.value, axis, kind, stable)
        graph.see((~equal).reduced("all").re, why=_EQUAL)
    beside = number != number[:, None]  # a number only known within bounds may not be seen to be no less than itself
    less, same = other < one, other == one
    if may_lack(x):
        less, same = less | (np.isnan(one) & ~np.isnan(other)), same | (np.isnan(one) & np.isnan(other))
    before: Any = (less & beside) | (same & (number < number[:, None]))
    rank = choice(graph, before, 1, 0).reduced("sum", -1)
    there = choice(graph, rank[..., None, :] == number[:, None], number, 0)
    return moved(there.reduced("sum", -1), -1, axis)


def taken(graph: Graph, x: Any, places: Any, axis: int | None = None) -> Any:
    """numpy's take: elements by their places along an axis, or else among all."""
    x, places = lift(graph, x), lift(graph, places)
    if axis is None:
        x, axis = x.reshape(-1), 0
    found, new = moved(x, axis, 0)[places], range(places.ndim)
    return moved(found, [*new], [axis % x.ndim + k for k in new])


def taken_of(graph: Graph, which: Any, values: Any) -> Any:
    """numpy's choose: of several values the one of a number."""
    which = lift(graph, which)
    return np.select([which == k for k in range(len(values))], [*values], np.nan)


def cross(graph: Graph, a: Any, b: Any, axis: int = -1) -> Any:
    """numpy's cross of vectors with three components."""
    a, b = (moved(lift(graph, v), axis, -1) for v in (a, b))
    if a.extent[-1] != 3 or b.extent[-1] != 3:
        raise NotRecorded("numpy's cross of vectors without three components")
    parts = [a[..., i] * b[..., j] - a[..., j] * b[..., i] for i, j in ((1, 2), (2, 0), (0, 1))]
    return moved(lift(graph, np.stack(parts, axis=-1)), -1, axis)


def unwrapped(graph: Graph, p: Any, discont: Any = None, axis: int = -1, *, period: float = 2 * np.pi) -> Any:
    """numpy's unwrap: from one to the next never further than half a period."""
    p = moved(lift(graph, p), axis, -1)
    step: Any = np.diff(p)
    low, high = -period / 2, period / 2
    near: Any = np.mod(step - low, period) + low
    near = np.where((near == low) & (step > 0), high, near)
    turn = np.where(abs(step) < (high if discont is None else np.maximum(discont, high)), 0.0, near - step)
    whole = np.concatenate([p[..., :1], p[..., 1:] + np.cumsum(turn, axis=-1)], axis=-1)
    return moved(lift(graph, whole), -1, axis)


def summed(graph: Graph, subscripts: str, *operands: Any) -> Any:
    """numpy's einsum of named axes."""
    given, arrow, result = subscripts.replace(" ", "").partition("->")
    names = given.split(",")
    every = sorted(set("".join(names)))
    if not arrow:
        result = "".join(letter for letter in every if given.count(letter) == 1)
    if not set(every) <= set(string.ascii_letters):
        raise NotRecorded(f"numpy's einsum of {subscripts!r}")
    factors = list[Any]()
    for name, operand in zip(names, operands, strict=True):
        own: list[str] = [letter for letter in every if letter in name]
        whole: Any = lift(graph, operand)
        for letter in [letter for letter in own if name.count(letter) > 1]:  # of a matrix its diagonal
            first, second = name.index(letter), name.rindex(letter)
            whole, name = np.diagonal(whole, 0, first, second), name.replace(letter, "") + letter
        whole = np.transpose(whole, [name.index(letter) for letter in own])
        factors.append(whole[tuple(slice(None) if letter in own else None for letter in every)])
    if are_truths(*factors):
        raise NotRecorded("numpy's einsum of truths")
    product = reduce(mul, factors)
    left = [letter for letter in every if letter in result]
    lost = tuple(k for k, letter in enumerate(every) if letter not in result)
    total = product.reduced("sum", lost) if lost else product
    return np.transpose(total, [left.index(letter) for letter in result])


def interpolated(
    graph: Graph, x: Any, xp: Any, fp: Any, left: Any = None, right: Any = None, period: Any = None
) -> Any:
    x, xp, fp = (lift(graph, v) for v in (x, xp, fp))
    graph.go_together(*xp.parts, *fp.parts, strictly=True)
    if period is not None:
        return interpolated(graph, *_unrolled(x, xp, fp, abs(lift(graph, period))))
    if xp.extent == (1,):
        graph.measure(xp.re)
        return fp[0] + 0 * x
    in_order(graph, xp)
    piece = _rank(graph, xp[1:-1], x)
    start, end, low, high = xp[piece], xp[piece + 1], fp[piece], fp[piece + 1]
    inside = low + (x - start) / of_any_unit(end - start) * of_any_unit(high - low)
    inside = choice(graph, x == xp[-1], fp[-1], inside)  # though others before it may be as great
    below = choice(graph, x < xp[0], fp[0] if left is None else left, inside)
    return choice(graph, x > xp[-1], fp[-1] if right is None else right, below)


def _now(x: Any, axis: int, kind: Any, stable: Any) -> Any:
    """The order of the run's numbers along their last axis, which was this one."""
    return np.moveaxis(np.argsort(x, axis=-1, kind=kind, stable=stable), -1, axis)


def _unrolled(x: Quantity, xp: Quantity, fp: Quantity, period: Quantity) -> tuple[Any, Any, Any]:
    """Places within a period, and a table of it that goes on by one row at both ends."""
    at: Any = xp % period
    order: Any = np.argsort(at, kind="stable")
    at, fp = at[order], fp[order]
    return (
        x % period,
        np.concatenate([at[-1:] - period, at, at[:1] + period]),
        np.concatenate([fp[-1:], fp, fp[:1]]),
    )


def of_any_unit(value: Quantity) -> Quantity:
    """A value such as a difference of numbers in a table; literals may have a unit that nobody wrote."""
    graph = value.graph
    return value.each(lambda node: node if node.args or node.op != "constant" else graph.constant(node.value, UNKNOWN))


def in_order(graph: Graph, x: Quantity) -> None:
    """Note that numbers do not fall: of others nobody knows what numpy finds among them."""
    rising = (x[:-1] <= x[1:]).reduced("all")
    if not rising.value:
        raise NotRecorded("numbers that are not in order")
    graph.see(rising.re)


def searched(graph: Graph, a: Any, v: Any, side: str = "left") -> Any:
    a, v = lift(graph, a), lift(graph, v)
    in_order(graph, a)
    compared(v)
    found = _rank(graph, a, v, strictly=side == "left")
    return choice(graph, np.isnan(v), a.count(0), found) if may_lack(v) else found


def digitized(graph: Graph, x: Any, bins: Any, right: bool = False) -> Any:
    """numpy's digitize, of edges that rise or fall."""
    bins, side = lift(graph, bins), "left" if right else "right"
    if bins.extent[0] > 1 and bins.value[0] > bins.value[-1]:
        return bins.count(0) - searched(graph, bins[::-1], x, side)
    return searched(graph, bins, x, side)


def _rank(graph: Graph, a: Quantity, v: Quantity, strictly: bool = False) -> Any:
    """How many numbers, which do not fall, each number is not below; ``strictly`` how many it is above."""
    if a.re.stretches:
        below = a < v[..., None] if strictly else a <= v[..., None]
        return below.reduced("sum", -1)

    def passed(k: Any) -> Any:
        return a[k] < v if strictly else a[k] <= v

    found, left = lift(graph, 0).like(v), a.re.size  # of those left, which follow the ones found
    while left > 1:
        half = left // 2
        found = choice(graph, passed(found + (half - 1)), found + half, found)
        left -= half
    return choice(graph, passed(found), found + 1, found) if left else found


def ordered(graph: Graph, x: Any, axis: Any = -1, kind: Any = None) -> Any:
    """Sorted by an even-odd network of comparisons; many numbers by the order that they have now."""
    if is_ranked(x := lift(graph, x)):
        return x[order(graph, x, kind="stable")]
    x, axis, count = to_sort(graph, x, axis)
    if count > SORTED:
        now = np.argsort(x.value, axis=-1, kind="stable")
        x = np.take_along_axis(x, now, axis=-1)
        graph.see((x[..., :-1] <= x[..., 1:]).reduced("all").re)
        return moved(x, -1, axis)
    parts = [x[..., k] for k in range(count)]
    least: Any = np.fmin if may_lack(x) else np.minimum
    for start in range(len(parts)):
        for k in range(start % 2, len(parts) - 1, 2):
            low, high = parts[k], parts[k + 1]
            parts[k], parts[k + 1] = least(low, high), np.maximum(low, high)
    return moved(lift(graph, parts), 0, axis)


def blocks(graph: Graph, arrays: Any) -> Any:
    """numpy's block: parts of the innermost lists beside each other, those of the lists around under each other."""

    def leaves(part: Any, depth: int) -> Iterator[tuple[Quantity, int]]:
        if isinstance(part, list):
            for inner in part:
                yield from leaves(inner, depth + 1)
        else:
            yield lift(graph, part), depth

    found = list(leaves(arrays, 0))
    deep = max(depth for _, depth in found)
    axes = max(deep, *(part.ndim for part, _ in found))

    def put(part: Any, axis: int) -> Quantity:
        if isinstance(part, list):
            return joined([put(inner, axis + 1) for inner in part], np.concatenate, axis=axis)
        whole = lift(graph, part)
        return whole[(None,) * (axes - whole.ndim)] if whole.ndim < axes else whole

    return put(arrays, -deep)


def place_of(graph: Graph, place: Any, shape: Any, order: str = "C") -> tuple[Any, ...]:
    """numpy's unravel_index: the places along each axis of one among all elements."""
    if order != "C":
        raise NotRecorded("unravel_index in the order of columns")
    places = list[Any]()
    left = lift(graph, place)
    for size in reversed(shape if isinstance(shape, tuple | list) else (shape,)):
        places.append(left % size)
        left = left // size
    return tuple(reversed(places))
