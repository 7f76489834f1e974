"""Errors that a worksheet raises: ways that do have no number, and what handles one may have made another."""

import sys
from collections.abc import Callable
from typing import Any

import numpy as np

from mechsheet.quantities.arithmetic import elementwise
from mechsheet.quantities.graph import PARTIAL, NotRecorded, current
from mechsheet.quantities.node import bottom_up
from mechsheet.quantities.quantity import Quantity, quantities
from mechsheet.quantities.refused import of_library, on_ways

_NOT_ALWAYS = PARTIAL | {"found"}  # a Find without a solution raises an error where its value is read


class Refused(NotRecorded):
    """A way that is only supposed raises an error."""


def raised(error: Callable[[], Any]) -> Any:
    """What a way raises."""
    if current.get().supposed:
        raise Refused("it raises an error")
    return error()


def on_way(condition: Quantity, holds: bool, way: Callable[..., Any], *given: Any, **named: Any) -> Any:
    """What a way gives that is gone where a condition holds, or does not."""
    ways = condition.graph.ways
    ways.append(_where(condition, holds))
    try:
        return way(*given, **named)
    finally:
        ways.pop()


def only(condition: Quantity, holds: bool) -> None:
    """Note that there is something only where a condition holds, or does not, of the ways that are gone to it."""
    there = on_ways(_where(condition, holds))
    if not there.value:
        raise NotRecorded("it raises an error")
    condition.graph.see(there.re)


def _where(condition: Quantity, holds: bool) -> Any:
    truth = (condition if condition.dtype == bool else condition != 0).reshape(())
    return truth if holds else elementwise("not")(truth)


def handled(error: BaseException) -> None:
    """An exception that the worksheet handles may be one of recorded quantities alone."""
    raise NotRecorded(f"it handles an error ({error!r})")


def tried(*values: Any) -> Any:
    """What a worksheet makes where it handles errors: of what is no number Python may have made one."""
    graph = current.get()
    if of_library(sys._getframe(1)):  # which handles errors whatever the numbers are
        return values[0] if values else None
    for node in bottom_up((node for value in quantities(values) for node in value.nodes), ()):
        if node.op in _NOT_ALWAYS and node not in graph.always:
            finite: Any = np.isfinite(Quantity(graph, node))
            if not finite.reduced("all"):
                raise NotRecorded("it may handle an error")
        elif node.op == "where" and np.isfinite(node.value).all() and any(np.isnan(a.value).any() for a in node.args):
            finite = np.isfinite(Quantity(graph, node))  # such as an element that there is
            bool(finite.reduced("all"))
    return values[0] if values else None


CALLS: dict[str, Any] = {"raised": raised, "handled": handled, "tried": tried}
