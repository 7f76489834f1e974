"""A found value without a closed form as a search for it, in operations that a cell of a workbook has as well."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from mechsheet.recording.graph import Graph, Label, NotRecorded
from mechsheet.recording.lines import Recording
from mechsheet.recording.node import Block, Node, bottom_up
from mechsheet.recording.quantity import Quantity

PLACES = 129  # of the first look at the whole interval
_LATER, _TIMES = 17, 14  # of each later one at the part in which the residual changes its sign
_LESS = 1e-3  # of the residual about that part may be left in the end: more is a jump or a pole


def search(recording: Recording) -> None:
    """Give found values of one equation without a closed form the search for them in its place.

    It has no value where its places show no change of sign, or more than one. A value that it doesn't find for the
    inputs at hand, or that takes too many cells, keeps the number of the worksheet's own run.
    """
    for solved in recording.found.values():
        if solved.inverse is None and solved.node.op == "found":
            root = _root(recording.graph, solved.node, solved.words.unknown_unit)
            if root is not None:
                solved.inverse, solved.searched = root, True
                recording.define_steps("Search", solved)


def _root(graph: Graph, found: Node, unit: str) -> Node | None:
    block: Block = found.args[0]
    if not block.single or not block.elementwise or not block.starts.keys() >= {"lo", "hi"}:
        return None
    (low,), (high,) = block.starts["lo"], block.starts["hi"]
    a, b = (Quantity(graph, graph.like(end, low, high, *block.under)) for end in (low, high))
    graph.work = 0
    try:
        a, b, first, changes = _closer(block, a, b, PLACES, unit, 1)
        for look in range(2, _TIMES + 2):
            a, b, last, _ = _closer(block, a, b, _LATER, unit, look)
    except NotRecorded:
        return None
    root: Any = np.where((changes == 1) & (last <= _LESS * first), a, np.nan)
    return root.re if np.allclose(root.value, found.value, 1e-12, 1e-300, equal_nan=True) else None


def _closer(
    block: Block, low: Quantity, high: Quantity, places: int, unit: str, look: int
) -> tuple[Quantity, Quantity, Quantity, Quantity]:
    """Ends of the first part in which the residual changes its sign, its greater size there, and how many there are."""
    t = np.linspace(0, 1, places)
    x = low[..., None] * (1 - t) + high[..., None] * t
    left = _residual(block, x)
    f, g = left[..., :-1], left[..., 1:]
    x.graph.labels[x.re] = Label(f"tried_{look}", unit, "places tried")
    x.graph.labels[left.re] = Label(f"left_{look}", "", "what is left of the equation there")
    changed = np.where(np.isfinite(f) & np.isfinite(g), (f < 0) != (g < 0), False)
    first = np.arange(places - 1) == np.argmax(changed, axis=-1)[..., None]
    a, b, f, g = (np.sum(np.where(first, q, 0.0), axis=-1) for q in (x[..., :-1], x[..., 1:], f, g))
    x.graph.labels[a.re] = Label(f"from_{look}", unit, "lower end of the part in which the sign changes")
    x.graph.labels[b.re] = Label(f"to_{look}", unit, "upper end of it")
    return a, b, np.maximum(abs(f), abs(g)), np.sum(changed * 1.0, axis=-1)


def _residual(block: Block, x: Quantity) -> Quantity:
    """What is left of the equation at other values of its unknown."""
    graph, new = x.graph, {block.nodes[0]: x.re}
    for node in bottom_up(block.residuals, new):
        if any(new.get(operand, operand) is not operand for operand in node.operands):
            new[node] = graph.node(node.op, *(_at_places(Quantity(graph, n), new).re for n in node.operands))
    return Quantity(graph, new[block.residuals[0]])


def _at_places(operand: Quantity, new: Mapping[Node, Node]) -> Quantity:
    """An operand at all places, which stand on a last axis of their own."""
    known = new.get(operand.re)
    return Quantity(operand.graph, known) if known else operand[..., None] if operand.shape else operand
