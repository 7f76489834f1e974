"""A closed form is a found value where it solves the equations: on another assembly branch it may not, for its inputs.

A workbook computes closed forms and looks for nothing: so it puts each one into the equations.
"""

from collections.abc import Sequence
from dataclasses import replace
from functools import reduce
from operator import and_

import numpy as np

from mechsheet.quantities.arithmetic import choice
from mechsheet.quantities.graph import Label, NotRecorded
from mechsheet.quantities.lines import Recording, Solved
from mechsheet.quantities.node import Block, Node
from mechsheet.quantities.quantity import Quantity, lift
from mechsheet.readers.replaced import replaced
from mechsheet.readers.terms import measure

_LEFT = 1e-7  # of the terms of an equation may be left by a root


def confirm(recording: Recording, block: Block, unknowns: Sequence[Solved]) -> None:
    """Let the closed forms of a block be values where they solve its equations, and its checks compare nothing else.

    Raises NotRecorded where they do not for the inputs at hand.
    """
    graph = recording.graph
    forms = {s.node: s.inverse for s in unknowns if s.inverse is not None}
    forms |= {node: graph.like(form, *block.under) for node, form in forms.items() if form.shape != node.shape}
    if any(form.shape != node.shape for node, form in forms.items()):
        raise NotRecorded("its closed form has another shape")
    graph.work = 0
    told = [solved.residual for solved in unknowns if solved.residual]
    new = replaced(graph, [*block.equations, *told], forms)
    left = [Quantity(graph, new.get(node, node)) for node in block.equations]
    holds = reduce(and_, (abs(x) <= _LEFT * measure(graph, x.re, recording.names) for x in left))
    graph.labels[holds.re] = Label("solves", "", "whether the closed form solves the equation")
    closed = [solved for solved in unknowns if not solved.searched and solved.inverse is not None]
    roots = {s.node: lift(graph, choice(graph, holds, Quantity(graph, forms[s.node]), np.nan)).re for s in closed}
    if any((np.isfinite(root.value) != np.isfinite(node.value)).any() for node, root in roots.items()):
        raise NotRecorded("its closed form does not solve the equations")
    for solved in unknowns:
        if solved.residual:
            solved.residual = new.get(solved.residual, solved.residual)
    for solved in closed:
        form = Quantity(graph, forms[solved.node])
        solved.inverse = roots[solved.node]
        solved.sure = lift(graph, choice(graph, np.isfinite(form), holds, True)).reduced("all").re
        _judge(recording, solved, lift(graph, choice(graph, holds, form, 0.0)).re)


def _judge(recording: Recording, solved: Solved, value: Node) -> None:
    """Let the check of a closed form compare it with what is found by it: with 0 where that is nothing."""
    check = recording.checks.get(solved.compared)
    if check:
        nodes = [*check.parts, check.limit]
        new = replaced(recording.graph, nodes, {solved.node: value})
        *parts, limit = (new.get(node, node) for node in nodes)
        recording.checks[solved.compared] = replace(check, parts=parts, limit=limit)
