"""Second slopes of a recording: how its quantities bend along directions of inputs, exact to rounding.

Along a direction each quantity is ``x + x' t + x'' t²/2`` to the second order. Of its result an operation makes of the
second terms what its slope rule makes of motions, and of products of the first ones what the rules here tell. What is
found bends so that its equations go on to hold. At a corner, or where one may be, there is no second slope: NaN.
"""

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

import numpy as np

from mechsheet.quantities.node import Block, Node, bottom_up, has_equation
from mechsheet.quantities.operations import ELEMENTWISE, Values
from mechsheet.readers.slope_rules import RULES, Motion, Rule, kernel, smooth
from mechsheet.readers.slopes import Forward, Slope, jacobian, solution, spread

Moving = Mapping[Node, Motion]

# What products of first terms add to the second one: of the result, its first term, the operands and theirs.
BENT: dict[str, Callable[..., Any]] = {
    **dict.fromkeys(("add", "sub"), lambda y, dy, a, b, da, db: 0.0),
    "neg": lambda y, dy, a, da: 0.0,
    "mul": lambda y, dy, a, b, da, db: 2 * da * db,
    "div": lambda y, dy, a, b, da, db: -2 * dy * db / b,
    "sqrt": lambda y, dy, a, da: -dy * dy / y,
    "exp": lambda y, dy, a, da: y * da * da,
    "log": lambda y, dy, a, da: -dy * dy,
    "sin": lambda y, dy, a, da: -y * da * da,
    "cos": lambda y, dy, a, da: -y * da * da,
    "tan": lambda y, dy, a, da: 2 * y * dy * da,
    "asin": lambda y, dy, a, da: a * da * dy / ((1 - a) * (1 + a)),
    "acos": lambda y, dy, a, da: a * da * dy / ((1 - a) * (1 + a)),
    "atan2": lambda y, dy, a, b, da, db: -2 * dy * (a * da + b * db) / (a * a + b * b),
    "pow": lambda y, dy, a, b, da, db: _of_power(y, a, b, da, db),
}


def _of_power(y: Values, a: Values, b: Values, da: Values, db: Values) -> Values:
    by_base: Values = np.where(b * (b - 1) == 0, 0.0, b * (b - 1) * np.power(a + 0.0, b - 2) * da * da)
    if not db.any():
        return by_base
    rate = np.log(a)
    by_both: Values = 2 * da * db * np.power(a + 0.0, b - 1) * (1 + b * rate) + y * (db * rate) ** 2
    return by_base + by_both


def bends(wanted: Iterable[Node], by: Sequence[Node], directions: Values) -> dict[Node, Values]:
    """Second derivatives of quantities along directions of the elements of others, shape (directions, ...)."""
    wanted, ends = list(wanted), np.cumsum([0, *(node.size for node in by)])
    sides = np.concatenate((directions, -directions))
    units = {n: sides[:, a : a + n.size].reshape(-1, *n.shape) for n, a in zip(by, ends, strict=False)}
    forward = Forward(len(sides), None)
    moving = forward.through(wanted, {node: Motion(unit, unit != 0) for node, unit in units.items()})
    second = _Second(forward).through(wanted, moving, {node: np.zeros(unit.shape) for node, unit in units.items()})
    bent = {node: _both(moving[node].ahead, second[node]) for node in wanted if node in second}
    return {node: bent.get(node, np.zeros((len(directions), *node.shape))) for node in wanted}


def _both(first: Values, second: Values) -> Values:
    """The second term where both sides have the same: the latter half of the directions are the former reversed."""
    ahead, behind = np.split(first, 2)
    smooth_there = ~np.isnan(Slope(ahead, -behind).both)
    return np.where(smooth_there, Slope(*np.split(second, 2)).both, np.nan)


class _Second:
    """Second terms along the directions of a pass forward."""

    def __init__(self, forward: Forward) -> None:
        self.forward, self.solved = forward, dict[Block, list[Values]]()

    @np.errstate(all="ignore")
    def through(self, wanted: Iterable[Node], moving: Moving, given: Mapping[Node, Values]) -> dict[Node, Values]:
        """Of all that moves under some quantities and is no condition, where some are given."""
        bent = dict(given)
        self._further(wanted, moving, bent, {*given})
        return bent

    def _further(self, wanted: Iterable[Node], moving: Moving, bent: dict[Node, Values], done: set[Node]) -> None:
        for node in bottom_up(wanted, done):
            done.add(node)
            if node in moving and moving[node].ahead.dtype != bool:
                bent[node] = self._of(node, moving, bent, done)

    def _of(self, node: Node, moving: Moving, bent: dict[Node, Values], done: set[Node]) -> Values:
        if node.op == "found":
            return self._found(node, moving, bent)
        if node.op == "iterated":
            self._further(node.args[2:], moving, bent, done)
            return bent.get(node.args[2], np.zeros(moving[node].ahead.shape))
        rule: Rule
        rule, args = kernel(node) or (RULES.get(node.op, smooth), node.operands)
        y, values = node.value, [operand.value for operand in args]
        first = [moving.get(operand) or self.forward.rest(operand) for operand in args]
        second = [Motion(bent[o], m.moves) if o in bent else m for o, m in zip(args, first, strict=True)]
        if node.op in ELEMENTWISE:
            first, second = ([spread(m, len(node.shape)) for m in motions] for motions in (first, second))
        found = rule(node, y, values, second)
        bend = _bend(node, rule, y, moving[node].ahead, values, [m.ahead for m in first])
        return np.where(found.moves, np.where(_at_corner(node, values), np.nan, found.ahead + bend), 0.0)

    def _found(self, node: Node, moving: Moving, bent: Mapping[Node, Values]) -> Values:
        block, number = node.args
        if not has_equation(node):
            return np.full(moving[node].ahead.shape, np.nan)
        if block not in self.solved:
            self.solved[block] = self._solved(block, moving, bent)
        found: Values = self.solved[block][number]
        return found

    def _solved(self, block: Block, moves: Moving, bent: Mapping[Node, Values]) -> list[Values]:
        """By the equations: what these bend by while the unknowns move evenly is made good by these."""
        count, shape, n = self.forward.count, block.nodes[0].shape, len(block.nodes)
        own = dict(zip(block.nodes, self.forward.solved[block], strict=True))
        under = {node: moves[node] for node in block.under if node in moves}
        inside = Forward(count, None)  # which solves again what blocks in this one find
        moving = inside.through(block.equations, {**under, **own})
        evenly = {node: np.zeros(motion.ahead.shape) for node, motion in own.items()}
        given = {**{node: bent[node] for node in under if node in bent}, **evenly}
        terms = _Second(inside).through(block.equations, moving, given)
        rest = [np.broadcast_to(terms.get(node, np.zeros(())), (count, *shape)) for node in block.equations]
        right = np.stack(rest).reshape(n, count, -1)  # equations, directions, elements
        if block.elementwise:
            found = -solution(jacobian(block), right.transpose(2, 0, 1)).transpose(1, 2, 0)
        else:
            found = -solution(jacobian(block), right.transpose(0, 2, 1).reshape(1, -1, count))
            found = found.reshape(n, -1, count).transpose(0, 2, 1)
        return [x.reshape(count, *shape) for x in found]


def _bend(node: Node, rule: Rule, y: Values, dy: Values, values: Sequence[Values], first: Sequence[Values]) -> Any:
    """What products of first terms add to the second one."""
    if kernel(node):
        if node.op == "sqrt":  # a distance
            return (first[0] ** 2 + first[1] ** 2 - dy * dy) / y
        return -dy * dy  # a logarithm
    if node.op in BENT:
        return BENT[node.op](y, dy, *(v + 0.0 for v in values), *(np.where(x.dtype == bool, 0.0, x) for x in first))
    of_many = node.op == "reduce" and node.args[2] == "prod"  # of which there is no rule
    return np.nan if of_many or node.op == "exported" else 0.0


def _at_corner(node: Node, values: Sequence[Values]) -> Any:
    """Where the first terms tell which of two second ones it is, or where the operation ends."""
    match node.op:
        case "abs":
            return values[0] == 0
        case "max" | "min":
            return values[0] == values[1]
        case "reduce" if node.args[2].removeprefix("nan") in ("max", "min"):
            flat, ends = values[0].reshape(-1), node.value.reshape(-1)
            tied = [np.count_nonzero(flat[g] == end) > 1 for g, end in zip(node.args[1], ends, strict=True)]
            return np.array(tied).reshape(node.shape)
    return False
