"""Equations at other values of their unknowns and their slopes by these, as quantities that a cell can compute."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from mechsheet.quantities.arithmetic import choice
from mechsheet.quantities.graph import NotRecorded
from mechsheet.quantities.node import Node, bottom_up, is_number
from mechsheet.quantities.operations import ELEMENTWISE, SHAPED
from mechsheet.quantities.quantity import Quantity
from mechsheet.readers.replaced import on_others
from mechsheet.readers.slope_rules import SMOOTH

Slopes = dict[int, Quantity]  # by the number of an unknown; none of what does not move
Sloped = tuple[Quantity, Slopes]

_COMPARED = frozenset(("lt", "le", "gt", "ge", "eq", "ne", "max", "min"))
_LEVEL = _COMPARED - {"max", "min"} | {"sign", "and", "or", "not", "finite"}


def at(unknowns: Mapping[Node, Quantity], equations: Sequence[Node]) -> tuple[list[Sloped], dict[Node, Sloped]]:
    """What equations are at other values of their unknowns, with their slopes by each of these.

    And what is 0 where an operation has a corner or jump, such as the difference of two numbers that it compares. The
    equations for each number of the unknowns rest on that number of them alone. Raises NotRecorded for an operation
    whose slope is not known.
    """
    graph = next(iter(unknowns.values())).graph
    new, slopes, corners = dict(unknowns), dict[Node, Slopes](), dict[Node, Sloped]()
    for k, node in enumerate(unknowns):
        slopes[node] = {k: Quantity(graph, graph.constant(1.0))}
    for node in bottom_up(equations, new):
        if any(operand in new for operand in node.operands):
            operands = [new[o] if o in new else Quantity(graph, o) for o in node.operands]
            moves = [slopes.get(operand, {}) for operand in node.operands]
            if node.op in ELEMENTWISE:
                new[node] = Quantity(graph, graph.fold(node.op, *(x.re for x in operands)))
                slopes[node] = _slopes(node.op, new[node], operands, moves)
            else:
                new[node] = _put_together(node, operands)
                slopes[node] = _put_together_slopes(node, operands, moves)
            if any(moves) and (node.op in _COMPARED or node.op in ("abs", "sign")):
                corners[node] = _corner(operands, moves)
    known = [(new[node] if node in new else Quantity(graph, node), slopes.get(node, {})) for node in equations]
    return known, corners


def _put_together(node: Node, operands: Sequence[Quantity]) -> Quantity:
    """Elements or sums of other operands, which are as many as they were."""
    graph, others = operands[0].graph, dict[Node, Node]()
    for old, new in zip(node.operands, operands, strict=True):
        shape = Quantity(graph, graph.constant(np.zeros(old.shape)))  # the old one rests on what is looked for
        others[old] = (new if new.extent == old.shape else new.like(shape)).re
    return Quantity(graph, on_others(node, graph, others))


def _put_together_slopes(node: Node, operands: Sequence[Quantity], moves: Sequence[Slopes]) -> Slopes:
    """How elements or sums move with each unknown: as what they are taken from does."""
    if node.op == "length" or not any(moves):
        return {}
    kind = node.args[2] if node.op == "reduce" else node.op
    sources = moves[:1] if kind == "at" else moves
    if kind not in ("sum", "take", "at", "join") or any(moves[len(sources) :]):
        raise NotRecorded(f"the slope of {kind}")
    zero = Quantity(operands[0].graph, operands[0].graph.constant(0.0))
    return {
        k: _put_together(node, [*(own.get(k, zero) for own in sources), *operands[len(sources) :]])
        for k in sorted({k for own in sources for k in own})
    }


def _corner(operands: Sequence[Quantity], moves: Sequence[Slopes]) -> Sloped:
    """The difference of what is compared, else with 0."""
    if len(operands) == 1:
        return operands[0], moves[0]
    (a, b), (own, others) = operands, moves
    return a - b, own | {k: own[k] - slope if k in own else -slope for k, slope in others.items()}


def _slopes(op: str, y: Quantity, operands: Sequence[Quantity], moves: Sequence[Slopes]) -> Slopes:
    """How a result moves with each unknown, where its operands do."""
    if op in _LEVEL:
        return {}
    if op in SHAPED:
        return moves[0]
    found = Slopes()
    for k in sorted({k for own in moves for k in own}):
        own = [move.get(k) for move in moves]
        slope = _slope(op, y, operands, own)
        if slope is not None and not is_number(slope.re, 0):
            found[k] = slope
    return found


def _slope(op: str, y: Quantity, operands: Sequence[Any], moves: Sequence[Quantity | None]) -> Any:
    """The slope of a result by one unknown, where some operands move."""
    graph = y.graph
    zero = Quantity(graph, graph.constant(0.0))
    first, *others = list[Any](zero if move is None else move for move in moves)
    match op:
        case "abs":
            return np.sign(operands[0]) * first
        case "max" | "min":
            a, b = operands
            return choice(graph, a > b if op == "max" else a < b, first, others[0])
        case "where":
            return choice(graph, operands[0], *others)
        case "pow" if moves[1] is None:
            base, exponent = operands
            return exponent * base ** (exponent - 1) * first
        case _ if op in SMOOTH:
            parts = SMOOTH[op](y, *operands)
            terms = [part * move for part, move in zip(parts, moves, strict=True) if move is not None]
            return sum(terms[1:], terms[0])
    raise NotRecorded(f"the slope of {op}")
