"""The largest of what is put together as the largest of its parts, row by row: a workbook has fewer cells for it."""

from collections.abc import Container, Sequence
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np

from mechsheet.quantities.graph import Graph
from mechsheet.quantities.lines import Recording
from mechsheet.quantities.node import Node, bottom_up
from mechsheet.quantities.operations import ELEMENTWISE, SHAPED, Values
from mechsheet.readers.replaced import replaced


def narrow(recording: Recording) -> None:
    """Let checks compare as many numbers as one of the parts has, of all that they put together for it.

    What has a name in the worksheet stays as it is.
    """
    graph, named = recording.graph, recording.names
    parts = _Parts(graph, named)
    compared = {name: [*check.parts, check.limit] for name, check in recording.checks.items()}
    every = [node for nodes in compared.values() for node in nodes]
    same = {node: node for node in named}
    with np.errstate(all="ignore"):  # the worksheet's own run has warned
        reduced = {node: parts.reduced(node) for node in bottom_up(every, same) if node.op == "reduce"}
        new = replaced(graph, every, same | {node: other for node, other in reduced.items() if other is not node})
        for name, check in recording.checks.items():
            own = [new.get(part, part) for part in check.parts]
            if not check.signed:
                own = [one for part in own for one in parts.largest("min" if check.at_least else "max", part)]
            recording.checks[name] = replace(check, parts=own, limit=new.get(check.limit, check.limit))


class _Part(NamedTuple):
    """Elements of a quantity, by their flat positions, that are the elements of another one."""

    at: Values
    node: Node


class _Parts:
    """Of which parts quantities are put together; those that are ``named``, and all that is not, are one part."""

    def __init__(self, graph: Graph, named: Container[Node]) -> None:
        self.graph, self.named, self.known = graph, named, dict[Node, list[_Part] | None]()

    def reduced(self, node: Node) -> Node:
        """The largest or least of several parts, by those in each row; anything else as it is."""
        source, _, kind, along = node.args
        if kind not in ("max", "min") or along != (None, False, False):
            return node
        several = self.largest(kind, source)
        if several == [source]:
            return node
        return self.folded(kind, [self.graph.reduce(kind, one, None, False) for one in several])

    def largest(self, kind: str, node: Node) -> list[Node]:
        """Quantities among which the largest or least of a quantity is, one for all parts of a shape."""
        parts = self.of(node)
        if parts is None or node.value.dtype == bool:  # no cell with a condition counts as a number
            return [node]
        alike = dict[Any, list[Node]]()
        for part in parts:
            alike.setdefault(self.shape(part.node), []).append(part.node)
        several = [self.folded(kind, nodes) for nodes in alike.values()]
        return [self.graph.reduce(kind, one, None, False) if one.op == "constant" else one for one in several]

    def folded(self, kind: str, nodes: Sequence[Node]) -> Node:
        """One of several row by row, with few parentheses in one another."""
        if len(nodes) == 1:
            return nodes[0]
        half = len(nodes) // 2
        return self.graph.fold(kind, self.folded(kind, nodes[:half]), self.folded(kind, nodes[half:]))

    def shape(self, node: Node) -> Any:
        """The shape, as quantities where it follows a number of rows."""
        return self.graph.size(node) if node.stretches else node.shape

    def of(self, node: Node) -> list[_Part] | None:
        """The parts of a quantity, their positions in ascending order; None of what is one."""
        for each in bottom_up([node], self.known):
            self.graph.work = 0
            whole = each.op != "join" and all(self.known[operand] is None for operand in each.operands)
            self.known[each] = None if whole or each in self.named else self._apart(each)
        return self.known[node]

    def _apart(self, node: Node) -> list[_Part] | None:
        """The parts of a quantity by those of what it is made of; None where nobody tells."""
        match node.op:
            case "take":
                return self._picked(node.args[0], node.args[1].reshape(-1))
            case "join":
                found = list[_Part]()
                for k, source in enumerate(node.args[0]):
                    at = np.flatnonzero(node.args[1] == k)
                    picked = self._picked(source, node.args[2].reshape(-1)[at])
                    if picked is None:
                        return None
                    found += [_Part(at[part.at], part.node) for part in picked]
                return found
            case op if op in ELEMENTWISE and op not in SHAPED and node.shape:
                return self._elementwise(node)
        return None

    def _picked(self, source: Node, index: Values) -> list[_Part] | None:
        """The parts of what takes elements of a quantity; None where some of a number of rows are taken."""
        found = list[_Part]()
        for part in self.of(source) or [_Part(np.arange(source.size), source)]:
            place = np.full(source.size, -1)
            place[part.at] = np.arange(len(part.at))
            at = np.flatnonzero(place[index] >= 0)
            inside = place[index[at]]
            if np.array_equal(inside, np.arange(len(part.at))):
                found.append(_Part(at, part.node))
            elif len(at) and part.node.stretches:
                return None
            elif len(at):
                found.append(_Part(at, self.graph.take(part.node, inside)))
        return found or None

    def _elementwise(self, node: Node) -> list[_Part] | None:
        rows = np.arange(node.size)
        which = list[Values]()  # of each operand, the part in which each element stands
        spread = list[list[_Part] | None]()
        for operand in node.args:
            index = np.broadcast_to(np.arange(operand.size).reshape(operand.shape), node.shape).reshape(-1)
            picked = None if operand.size == 1 else self._picked(operand, index)
            if picked is None and operand.size > 1:
                return None
            spread.append(picked)
            number = np.zeros(node.size, int)
            for k, part in enumerate(picked or ()):
                number[part.at] = k
            which.append(number)
        found = list[_Part]()
        for key in dict.fromkeys(zip(*(number.tolist() for number in which), strict=True)):
            at = rows[np.logical_and.reduce([number == k for number, k in zip(which, key, strict=True)])]
            alone = [None if parts is None else parts[k] for parts, k in zip(spread, key, strict=True)]
            if any(part is not None and len(part.at) != len(at) for part in alone):
                return None
            operands = [o if p is None else p.node for o, p in zip(node.args, alone, strict=True)]
            if len({self.shape(o) for o in operands if o.size > 1}) > 1:
                return None
            found.append(_Part(at, self.graph.fold(node.op, *operands)))
        return found
