"""Quantities with others in place of some that they rest on, which may have one more axis than these: their places."""

from collections.abc import Iterable, Mapping, Sequence

import numpy as np

from mechsheet.quantities.graph import Graph, NotRecorded
from mechsheet.quantities.node import Node, bottom_up
from mechsheet.quantities.operations import ELEMENTWISE, Moved, Values
from mechsheet.quantities.quantity import Quantity, joined


def replaced(graph: Graph, roots: Iterable[Node], others: Mapping[Node, Node], places: int = 0) -> dict[Node, Node]:
    """What ``roots`` and all under them are with ``others`` in place of some quantities, as far as they rest on these.

    With ``places`` the others have a first axis of so many places, which then stands before those of all: what is
    summed at one place stays in one row.
    """
    new, again = dict(others), _Again(graph, places)
    for node in bottom_up(roots, new):
        if any(new.get(operand, operand) is not operand for operand in node.operands):
            new[node] = again.made(node, new)
            if not places and node in graph.labels:
                graph.labels.setdefault(new[node], graph.labels[node])
    return new


def on_others(node: Node, graph: Graph, others: Mapping[Node, Node]) -> Node:
    """An operation with others of the same shapes in place of some of its operands."""
    return _Again(graph, 0).made(node, others)


class _Again:
    """Operations on other operands."""

    def __init__(self, graph: Graph, places: int) -> None:
        self.graph, self.places = graph, places

    def made(self, node: Node, new: Mapping[Node, Node]) -> Node:
        graph = self.graph
        match node.op:
            case "length":
                return graph.length(new[node.args[0]], node.args[1])
            case "reduce":
                return self.reduced(node, new[node.args[0]])
            case "take":
                source, index, moves = node.args
                return self.moved(Quantity(graph, new[source]), moves or (Moved(np.take, (index,)),)).re
            case "join":
                return self.joined(node, [self.operand(source, new, whole=True) for source in node.args[0]])
            case "at":
                source, position = (self.operand(operand, new) for operand in node.args)
                if self.places and node.args[0] in new:
                    at = self.operand(node.args[1], new, whole=True)
                    first = np.arange(self.places) * node.args[0].size
                    position = at + first.reshape(-1, *[1] * (at.ndim - 1))
                return graph.at(source.re, position.re)
            case "iterated":
                turns = node.args[2]
                return replaced(graph, [turns], new, self.places)[turns]
            case op if op in ELEMENTWISE:
                axes = max(len(operand.shape) for operand in node.args)
                return graph.node(op, *(self.operand(operand, new, axes).re for operand in node.args))
        raise NotRecorded(f"its equation rests on what is {_TOLD.get(node.op, node.op)}")

    def operand(self, node: Node, new: Mapping[Node, Node], axes: int = 0, whole: bool = False) -> Quantity:
        """An operand, at all places with so many further axes at least; at all in any case if it is ``whole``."""
        known = Quantity(self.graph, new.get(node, node))
        if not self.places:
            return known
        if node in new and known.ndim:  # a number of rows is the same at all places
            more = max(axes - len(node.shape), 0)
            return known[(slice(None), *[None] * more)] if more else known
        if not whole:
            return known
        return known.like(Quantity(self.graph, self.graph.constant(np.zeros((self.places, *[1] * known.ndim)))))

    def moved(self, source: Quantity, moves: Iterable[Moved]) -> Quantity:
        for move in moves:
            if self.places and source.ndim:
                source = source.rearranged(_at_places, move)
            else:
                source = source.rearranged(move.f, *move.args, **dict(move.named))
        return source

    def joined(self, node: Node, sources: Sequence[Quantity]) -> Node:
        _, which, inside, move = node.args
        starts = np.cumsum([0, *(source.size for source in node.args[0])])
        where = starts[which] + inside
        if not self.places:
            return self.graph.join([source.re for source in sources], where, move)
        return joined(sources, _joined_at_places, move or Moved(np.take, (where,))).re

    def reduced(self, node: Node, source: Node) -> Node:
        _, _, kind, along = node.args
        if not self.places:
            if along.so_far:
                return self.graph.scan(kind, source, along.axis)
            return self.graph.reduce(kind, source, along.axis, along.keepdims)
        axes = len(source.shape) - 1
        if along.so_far:
            return self.graph.scan(kind, source, along.axis % axes + 1)
        if along.axis is None and kind.startswith("arg") and axes > 1:
            raise NotRecorded("its equation rests on a position among those of several axes")
        axis = tuple(range(1, axes + 1)) if along.axis is None else along.axis % axes + 1
        return Quantity(self.graph, source).reduced(kind, axis, along.keepdims).re


_TOLD = {"found": "found itself", "state": "found by a loop", "exported": "not recorded"}


def _at_places(elements: Values, move: Moved) -> Values:
    """What a function that moves elements makes of them at each place."""
    places, *shape = elements.shape
    index = np.asarray(move(np.arange(np.prod(shape, dtype=int)).reshape(shape)))
    return np.asarray(elements.reshape(places, -1)[:, index])


def _joined_at_places(parts: Sequence[Values], move: Moved) -> Values:
    """What a function that puts elements together makes of parts at each place."""
    sizes = [part[0].size for part in parts]
    order = np.split(np.arange(sum(sizes)), np.cumsum(sizes)[:-1])
    shaped = [places.reshape(part.shape[1:]) for places, part in zip(order, parts, strict=True)]
    index = np.asarray(move(np.concatenate(order) if move.f is np.take else shaped))
    return np.asarray(np.concatenate([part.reshape(len(part), -1) for part in parts], axis=1)[:, index])
