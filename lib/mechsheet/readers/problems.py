"""Blocks of many problems, one for each number of their unknowns: what belongs to which, and how much they may take."""

from collections.abc import Iterator
from contextlib import contextmanager
from itertools import pairwise

import numpy as np

from mechsheet.quantities.graph import Graph, NotRecorded
from mechsheet.quantities.node import Block, Node, bottom_up
from mechsheet.quantities.operations import ELEMENTWISE, Values
from mechsheet.quantities.quantity import Quantity

NONE, SEVERAL = -1, -2


@contextmanager
def bounded(graph: Graph, most: int) -> Iterator[None]:
    """What the cells for a block may take: so many operations on single numbers, of which a third or so have a cell."""
    before, graph.most, graph.work = graph.most, most, 0
    try:
        yield
    finally:
        graph.most, graph.work = before, 0


def alike(graph: Graph, block: Block) -> tuple[Node, ...]:
    """What the block rests on that has the shape of its unknowns."""
    shape = block.nodes[0].shape
    found = tuple(node for node in block.under if block.elementwise or node.shape == shape)
    return found or (graph.constant(np.zeros(shape)),)


def numbers_under(block: Block) -> dict[Node, Values]:
    """Which number of the unknowns each element of what rests on these rests on: `NONE` or `SEVERAL` may be.

    Raises NotRecorded where the equations for one of them rest on others.
    """
    rests = {node: np.arange(node.size).reshape(node.shape) for node in block.nodes}
    numbers = rests[block.nodes[0]]
    for node in bottom_up(block.residuals, rests):
        under = [rests[operand] for operand in node.operands]
        if node.op == "take":
            rests[node] = under[0].reshape(-1)[node.args[1]]
        elif node.op == "join":
            starts = np.cumsum([0, *(one.size for one in under)])
            rests[node] = np.concatenate([one.reshape(-1) for one in under])[starts[node.args[1]] + node.args[2]]
        elif node.op == "reduce":
            groups = [_of_all(under[0].reshape(-1)[group]) for group in node.args[1]]
            rests[node] = np.array(groups, int).reshape(node.shape)
        elif node.op in ELEMENTWISE:
            rests[node] = _of_both(*under)
        elif node.op == "at" and (under[0] == NONE).all():
            rests[node] = under[1]
        elif node.op == "length":
            rests[node] = np.full(node.shape, NONE)
        else:  # of all that it rests on
            whole = np.concatenate([np.array([NONE]), *(one.reshape(-1) for one in under)])
            rests[node] = np.full(node.shape, _of_all(whole))
    own = [rests[residual] for residual in block.residuals]
    if not all(one.shape == numbers.shape and ((one == numbers) | (one == NONE)).all() for one in own):
        raise NotRecorded("what its equations leave for one of the values rests on others of them")
    return rests


def of_each(holds: Quantity, rests: Values, shape: tuple[int, ...]) -> Quantity:
    """Whether something holds of all the elements that rest on each number of the unknowns."""
    order = np.argsort(rests, axis=None)
    ends = np.searchsorted(rests.reshape(-1)[order], np.arange(np.prod(shape, dtype=int) + 1))
    groups = [order[start:end] for start, end in pairwise(ends)]
    most = max(map(len, groups))
    if (rests == SEVERAL).any() or not all(map(len, groups)):
        raise NotRecorded("what its equations compare is not that of each value by itself")
    index = np.array([np.resize(group, most) for group in groups]).reshape(*shape, most)
    whole = holds.like(Quantity(holds.graph, holds.graph.constant(np.zeros(rests.shape))))
    return whole.rearranged(np.take, index).reduced("all", -1)


def _of_both(*rests: Values) -> Values:
    one, *others = np.broadcast_arrays(*rests)
    for other in others:
        one = np.where((other == NONE) | (other == one), one, np.where(one == NONE, other, SEVERAL))
    return one


def _of_all(rests: Values) -> int:
    known = set(rests.reshape(-1).tolist()) - {NONE}
    return known.pop() if len(known) == 1 else SEVERAL if known else NONE
