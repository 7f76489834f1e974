"""Slopes of a recording: how its quantities move where inputs do, within 64 roundings of their condition.

Forward accumulation: each direction is an input that moves ahead, and each operation tells how its result moves then.
Where a formula has a corner, such as `abs` at 0 or the greater of two equal numbers, that is the slope on the side to
which the direction points; where it jumps there, or is no number ahead, it is NaN. What is found moves so that its
equations go on to hold, and what a loop ends with as by as many turns as it takes.
"""

from collections.abc import Iterable, Mapping, Sequence
from typing import NamedTuple

import numpy as np

from mechsheet.quantities.node import Block, Node, bottom_up, has_equation
from mechsheet.quantities.operations import ELEMENTWISE, Values
from mechsheet.readers.slope_rules import ROUNDING, RULES, Motion, Rule, kernel, number, smooth


class Slope(NamedTuple):
    """Derivatives of a quantity by the elements of others, shape (elements, ...), seen from ahead and from behind.

    They differ at a corner; NaN where there is none on that side.
    """

    ahead: Values
    behind: Values

    @property
    def both(self) -> Values:
        """The derivative; NaN where the sides differ, or one of them has none."""
        with np.errstate(invalid="ignore"):
            same = np.abs(self.ahead - self.behind) <= ROUNDING * np.abs(self.ahead)
        opposite = np.isinf(self.ahead) & (self.ahead != self.behind)  # as at the foot of a root of what is an amount
        return np.where(same & ~opposite, self.ahead, np.nan)


def slopes(wanted: Iterable[Node], by: Sequence[Node], known: Mapping[Node, Values] | None = None) -> dict[Node, Slope]:
    """Derivatives of some quantities by every element of others, one after the other along the first axis.

    ``known`` are the numbers at which, where these are not the recording's own. Ask `unfollowed` before: what rests on
    that is NaN here.
    """
    return _seen(list(wanted), _units(by), known)


def _units(by: Sequence[Node]) -> dict[Node, Values]:
    """Every element of some quantities by itself ahead, one after the other."""
    ends = np.cumsum([0, *(node.size for node in by)])
    every = np.eye(ends[-1])
    return {n: every[:, a : a + n.size].reshape(-1, *n.shape) for n, a in zip(by, ends, strict=False)}


def _seen(
    wanted: Sequence[Node], units: Mapping[Node, Values], known: Mapping[Node, Values] | None
) -> dict[Node, Slope]:
    """Slopes in some directions, shape (directions, ...) each, from both sides."""
    count = max(map(len, units.values()), default=0)
    forward = Forward(2 * count, known)  # in all directions, then in all the other way: most of a pass is its calls
    sides = {node: np.concatenate((unit, -unit)) for node, unit in units.items()}
    moving = forward.through(wanted, {node: Motion(side, side != 0) for node, side in sides.items()})
    seen = {node: number(moving.get(node) or forward.rest(node)).ahead for node in wanted}
    return {node: Slope(ahead[:count], -ahead[count:]) for node, ahead in seen.items()}


def unfollowed(wanted: Iterable[Node], by: Iterable[Node]) -> Node | None:
    """What has no slope by some quantities and stands between them and what is wanted; None where all is followed."""
    moving, known = set(by), set[Node]()

    def lost(nodes: Iterable[Node]) -> Node | None:
        for node in bottom_up(nodes, known):
            known.add(node)  # what the turns of several loops rest on is looked at once
            if not moving.isdisjoint(node.operands):
                if node.op == "exported" or (node.op == "found" and not has_equation(node)):
                    return node
                if node.op == "iterated" and (inside := lost(node.args[2:])):
                    return inside
                moving.add(node)
        return None

    return lost(wanted)


def seen(wanted: Iterable[Node], by: Iterable[Node]) -> Node | None:
    """What is a number only while another one is what Python saw, though some quantities move that; None of nothing."""
    moving = set(by)
    for node in bottom_up(wanted, ()):
        if not moving.isdisjoint(node.operands):
            moving.add(node)
        if node.op == "where" and node.args[2].op == "constant" and np.isnan(node.args[2].value).all():
            kept = (part for part in bottom_up(node.args[:1], ()) if part.op == "eq")
            if any(part.value.all() and part.args[0] in moving for part in kept):
                return node
    return None


def solved_under(wanted: Iterable[Node]) -> list[Node]:
    """What solve blocks make zero and loops end with, of all on which some quantities rest.

    Slopes for other numbers need theirs.
    """
    under = list(bottom_up(wanted, ()))
    blocks = dict.fromkeys(node.args[0] for node in under if node.op == "found")
    turns = [node.args[2] for node in under if node.op == "iterated"]
    return [*turns, *(node for block in blocks for node in block.equations), *(solved_under(turns) if turns else ())]


class Forward:
    """One pass through a recording, in some directions."""

    def __init__(self, count: int, known: Mapping[Node, Values] | None) -> None:
        self.count, self.known = count, known
        self.solved = dict[Block, list[Motion]]()

    def value(self, node: Node) -> Values:
        return node.value if self.known is None else self.known.get(node, node.value)

    @np.errstate(all="ignore")
    def through(
        self, wanted: Iterable[Node], moves: Mapping[Node, Motion], still: Iterable[Node] = ()
    ) -> dict[Node, Motion]:
        """How all that moves under some quantities does so, where some move and others are ``still``."""
        moving = dict(moves)
        self._further(wanted, moving, {*moves, *still})
        return moving

    def _further(self, wanted: Iterable[Node], moving: dict[Node, Motion], done: set[Node]) -> None:
        for node in bottom_up(wanted, done):
            done.add(node)
            if any(operand in moving for operand in node.operands):
                motion = self._of(node, moving, done)
                if motion.moves.any():
                    moving[node] = motion

    def _of(self, node: Node, moving: dict[Node, Motion], done: set[Node]) -> Motion:
        if node.op == "found":
            return self._found(node, moving)
        if node.op == "iterated":
            self._further(node.args[2:], moving, done)  # what the turns of several loops rest on moves once
            return moving.get(node.args[2]) or self.rest(node)
        rule: Rule
        rule, args = kernel(node) or (RULES.get(node.op, smooth), node.operands)
        motions = [moving.get(operand) or self.rest(operand) for operand in args]
        if node.op in ELEMENTWISE:
            motions = [spread(m, len(node.shape)) for m in motions]
        return rule(node, self.value(node), [self.value(operand) for operand in args], motions)

    def rest(self, node: Node) -> Motion:
        """A quantity that does not move; of a condition what it is."""
        value = self.value(node)
        rest = value if value.dtype == bool else np.zeros(())
        return Motion(
            np.broadcast_to(rest, (self.count, *node.shape)), np.broadcast_to(False, (self.count, *node.shape))
        )

    def _found(self, node: Node, moving: Mapping[Node, Motion]) -> Motion:
        """By the equations: what these move by is made good by the unknowns."""
        block, number = node.args
        if not has_equation(node):
            lost: Rule = RULES["exported"]
            return lost(node, node.value, (), [moving[o] for o in node.operands if o in moving])
        if block not in self.solved:
            self.solved[block] = self._solved(block, moving)
        motion: Motion = self.solved[block][number]
        return motion

    def _solved(self, block: Block, moving: Mapping[Node, Motion]) -> list[Motion]:
        under = {node: moving[node] for node in block.under if node in moving}
        pushed = self.through(block.equations, under, block.nodes)
        rest = [pushed.get(node) or self.rest(node) for node in block.equations]
        shape, count, n = block.nodes[0].shape, self.count, len(block.nodes)
        right = np.stack([np.broadcast_to(r.ahead, (count, *shape)).reshape(count, -1) for r in rest], -1)
        if block.elementwise:
            found = -solution(jacobian(block, self.known), np.moveaxis(right, 0, -1))  # problems, unknowns, directions
        else:
            whole = right.transpose(2, 1, 0).reshape(1, -1, count)
            found = -solution(jacobian(block, self.known), whole).reshape(n, -1, count).transpose(1, 0, 2)
        moves = np.logical_or.reduce([m for r in rest for m in r.moves.reshape(count, -1).T])
        moves = np.broadcast_to(moves.reshape(-1, *[1] * len(shape)), (count, *shape))
        return [Motion(np.where(moves, found[:, k].T.reshape(count, *shape), 0.0), moves) for k in range(n)]


def jacobian(block: Block, known: Mapping[Node, Values] | None = None) -> Values:
    """Derivatives of the equations of a block by its unknowns, shape (problems, equations, unknowns).

    Where all is elementwise each element is a problem, else they are one, whose equations and unknowns have all
    elements, those of the first one before those of the second. NaN at a corner.
    """
    if block.elementwise:
        shape, n = block.nodes[0].shape, len(block.nodes)
        units = {node: np.zeros((n, *shape)) for node in block.nodes}
        for k, unit in enumerate(units.values()):
            unit[k] = 1.0
    else:
        units = _units(block.nodes)
    seen = _seen(block.equations, units, known)
    rows = [seen[node].both.reshape(len(seen[node].ahead), -1) for node in block.equations]
    if block.elementwise:
        rows = [np.broadcast_to(row, (n, block.nodes[0].size)) for row in rows]
        return np.stack(rows).transpose(2, 0, 1)
    return np.concatenate(rows, 1).T[None]


def solution(J: Values, right: Values) -> Values:
    """Of linear equations; NaN where they have none, or more than one."""
    bad: Values = ~np.logical_and.reduce(np.isfinite(J), axis=(-2, -1))
    J = np.where(bad[:, None, None], np.eye(J.shape[-1]), J)
    bad |= np.linalg.det(J) == 0
    J = np.where(bad[:, None, None], np.eye(J.shape[-1]), J)
    return np.where(bad[:, None, None], np.nan, np.linalg.solve(J, right))


def spread(motion: Motion, ndim: int) -> Motion:
    """With axes of length 1 behind that of the directions, as many as broadcasting would add in front."""
    return motion.rearranged(lambda x: x.reshape(len(x), *[1] * (ndim + 1 - x.ndim), *x.shape[1:]))
