"""Positions that tables list, of all those that a worksheet computes: what rests on them."""

from collections.abc import Sequence
from typing import Any

from mechsheet.recording.graph import Graph
from mechsheet.recording.node import Node, bottom_up
from mechsheet.recording.quantity import Quantity


def listed(graph: Graph, value: Any) -> Any:
    """What was recorded over all positions, at those that tables list."""
    if not isinstance(value, Quantity):
        return value
    return value[tuple(slice(None, None, graph.thin if size == graph.positions else None) for size in value.extent)]


def on_rows(graph: Graph, nodes: Sequence[Node], known: dict[Node, tuple[bool, bool]]) -> list[tuple[bool, bool]]:
    """Whether each rests on the positions that tables list, and on a sum or an extreme over them.

    What is ``known`` of others is not looked for again, and added to.
    """
    count = (graph.positions - 1) // graph.thin + 1
    for part in bottom_up(nodes, known):
        under = [known[operand] for operand in part.operands]
        rests = (part.op == "rows" and part.size == count) or any(own for own, _ in under)
        reduced = part.op == "reduce" and rests and part.size < count
        known[part] = rests, reduced or any(over for _, over in under)
    return [known[node] for node in nodes]
