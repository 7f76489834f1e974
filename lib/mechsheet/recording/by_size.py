"""Places that are taken by the size of numbers: whether it is these that decide, and not their rounding."""

from typing import Any

import numpy as np

from mechsheet.quantities.arithmetic import choice
from mechsheet.quantities.graph import Graph, NotRecorded
from mechsheet.quantities.node import bottom_up
from mechsheet.quantities.operations import Values
from mechsheet.quantities.quantity import Quantity, lift
from mechsheet.quantities.ufunc_rules import finite
from mechsheet.readers.terms import Terms
from mechsheet.worksheet import numbers

_BY_ROUNDING = "the numbers differ by rounding alone, which tells no place"


def decided(graph: Graph) -> None:
    """See that no place was taken by the size of numbers that differ by nothing but the rounding of their terms.

    Of all of them that is seen for other inputs too; of two that come next to each other for those of the run alone.
    Of any turn of a loop, or of any row, which are followed by one of them, nobody knows the numbers.
    """
    for given, axis, kind in tuple(graph.chosen):
        x = lift(graph, given)
        if not any(part.op == "state" for part in bottom_up(x.parts, ())):
            decide(x, axis, kind)


def decide(x: Quantity, axis: Any, kind: str) -> None:
    """The same of the places that are taken of one quantity."""
    graph = x.graph
    along = axis if x.ndim > 1 else None
    low, high = (x.reduced(end, along) for end in ("min", "max"))
    each = Terms(graph).of(x, deep=graph.draws)
    if np.isinf(each.value).any():
        if not graph.draws:
            raise NotRecorded("an infinite number is among those compared, which no cell of a spreadsheet holds")
        each = choice(graph, finite(x), each, 0.0)  # an infinite one has no rounding, and the others have their own
    terms = each.reduced("max", along)
    nothing = (low == 0) & (high == 0)  # as a spreadsheet program has it where next to nothing is left
    rounding = (high - low <= numbers.ROUNDING * terms) & ((high > low) | nothing) & (terms > 0) & finite(terms)
    holds = (~rounding).reduced("all")
    if not holds.value:
        raise NotRecorded(_BY_ROUNDING)
    if _tied(kind, x.value, along, numbers.ROUNDING * terms.value):
        raise NotRecorded("two of the numbers differ by rounding alone, which tells no place")
    graph.see(holds.re, why=_BY_ROUNDING)


def _tied(kind: str, values: Values, axis: Any, rounding: Any) -> bool:
    """Whether another number comes so near one that is taken; those that are equal stand in one order everywhere."""
    order = np.sort(values, axis=axis)
    if axis is not None:
        order = np.moveaxis(order, axis, -1)
    with np.errstate(invalid="ignore"):  # between infinite numbers there is no step
        steps = np.diff(order, axis=-1)
    first = {"argmax": steps[..., ::-1], "argmin": steps}.get(kind, steps)
    if kind != "argsort":  # behind those that are equal to the one that is taken
        first = np.take_along_axis(first, np.argmax(first > 0, axis=-1)[..., None], axis=-1) if first.size else first
    return bool(np.any((first > 0) & (first <= np.asarray(rounding)[..., None])))
