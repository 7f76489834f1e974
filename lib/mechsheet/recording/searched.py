"""A found value without a closed form as a search for it, in operations that a cell of a workbook has as well."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from mechsheet.recording.graph import Graph, Label, NotRecorded
from mechsheet.recording.lines import Recording
from mechsheet.recording.node import Block, Node, bottom_up
from mechsheet.recording.quantity import Quantity

PLACES = 97  # of the first look at the whole interval, dense at its ends
_FIRST = (1 - np.cos(np.linspace(0, np.pi, PLACES))) / 2
_LATER, _LOOKS = np.linspace(0, 1, 17), 15  # of each later one at the part in which the residual changes its sign
_EARLY = 4  # looks that count changes of sign; later ones may meet rounding
_NEAR, _AT_END = 0.45, 1e-9  # of the residual beside a place, that there may be a root about without a change of sign
_LESS = 0.1  # of the residual in the last early look may be left in the end: more is a jump or a pole


def search(recording: Recording) -> None:
    """Give found values of one equation without a closed form the search for them in its place.

    It has no value where its places show no change of sign, more than one, or that there may be more. A value that it
    doesn't find for the inputs at hand, or that takes too many cells, keeps the number of the worksheet's own run.
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
    try:
        root = _searched(block, a, b, unit)
    except NotRecorded:
        return None
    return root.re if np.allclose(root.value, found.value, 1e-12, 1e-300, equal_nan=True) else None


@np.errstate(all="ignore")  # the residual need not have a value everywhere
def _searched(block: Block, a: Quantity, b: Quantity, unit: str) -> Any:
    """The root between a and b, which closes in on it look by look; none where it isn't sure to be the only one."""
    graph = a.graph
    one: Any = True
    for look in range(_LOOKS):
        graph.work = 0  # a look may take what a line may
        places = _LATER if look else _FIRST
        x = a[..., None] * (1 - places) + b[..., None] * places
        left = _residual(block, x)
        graph.labels[x.re] = Label(f"tried_{look + 1}", unit, "places tried")
        graph.labels[left.re] = Label(f"left_{look + 1}", "", "what is left of the equation there")
        changed = _changed(left)
        first = np.arange(len(places) - 1) == np.argmax(changed, axis=-1)[..., None]
        a, b, f, g = (np.sum(np.where(first, q, 0.0), axis=-1) for y in (x, left) for q in (y[..., :-1], y[..., 1:]))
        graph.labels[a.re] = Label(f"from_{look + 1}", unit, "lower end of the part in which the sign changes")
        graph.labels[b.re] = Label(f"to_{look + 1}", unit, "upper end of it")
        most = np.maximum(abs(f), abs(g))
        if look < _EARLY:
            one, early = one & (np.sum(changed * 1.0, axis=-1) == 1), most
        if look == 0:
            one = one & (_unseen(left) == 0)
    return np.where(one & (most <= _LESS * early), a, np.nan)


def _changed(left: Quantity) -> Any:
    """Where the residual at a place and at the next one differ in sign."""
    f, g = left[..., :-1], left[..., 1:]
    return np.where(np.isfinite(f) & np.isfinite(g), (f < 0) != (g < 0), False)


def _unseen(left: Quantity) -> Any:
    """How many places come so near zero without a change of sign that there may be roots about them."""
    known, up = np.isfinite(left), np.where(left < 0, -1.0, 1.0)
    size = np.where(known, abs(left), 0.0)
    before, at, after = left[..., :-2] * up[..., 1:-1], size[..., 1:-1], left[..., 2:] * up[..., 1:-1]
    least = known[..., 1:-1] & ~(before < at) & ~(after < at)
    near = least & (at < _NEAR * (size[..., :-2] + size[..., 2:]))
    ends, beside = left[..., [0, -1]], left[..., [1, -2]]
    at_end = ((ends < 0) == (beside < 0)) & (abs(ends) <= _AT_END * abs(beside))
    return np.sum(near * 1.0, axis=-1) + np.sum(at_end * 1.0, axis=-1)


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
