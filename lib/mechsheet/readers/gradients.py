"""Gradients of a recording: one number by all on which it rests, in one pass backwards.

Reverse accumulation: from the number down, each operation hands on to its operands by how much it moves the number
where they move it. The parts are those of the rules of `slope_rules`, seen from both sides. Where these differ there is
no gradient here, and `slopes` tells one side from the other.

What is handed on has two rows: the derivative, and a weight that is above 0 where the number hangs on an element at
all. A condition, which has no derivative, hands on the second alone: where that meets a jump there is no gradient.
"""

from collections.abc import Callable, Container, Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from mechsheet.quantities.node import Block, Node, bottom_up, has_equation
from mechsheet.quantities.operations import ELEMENTWISE, SHAPED, Values
from mechsheet.readers.slope_rules import RULES, SMOOTH, Motion, Rule, kernel, reduced, smooth
from mechsheet.readers.slopes import Slope, jacobian, slopes, solution

Known = Mapping[Node, Values]
_Value = Callable[[Node], Values]
_Shares = Iterator[tuple[Node, Values]]

_STEPS = ("floor", "round", "sign")
_CONDITIONS = ("lt", "le", "gt", "ge", "eq", "ne")


def gradient(of: Node, element: int, by: Sequence[Node], known: Known | None = None) -> Slope:
    """Derivatives of one element of a quantity by every element of others, one after the other, shape (elements,).

    What `slopes` has of this element, for any number of others at the cost of a few evaluations; where the quantity has
    a corner, at the cost of one for each of them.
    """
    found = adjoints(of, element, known)
    each = np.concatenate([np.zeros(0), *(found.get(node, np.zeros(node.shape)).reshape(-1) for node in by)])
    if not np.isnan(each).any():
        return Slope(each, each)
    ahead, behind = (side.reshape(each.size, -1)[:, element] for side in slopes([of], by, known)[of])
    return Slope(ahead, behind)


def adjoints(of: Node, element: int = 0, known: Known | None = None) -> dict[Node, Values]:
    """Derivatives of one element of a quantity by all on which it rests, each in its shape; NaN at a corner.

    What is left out does not move it. ``known`` are the numbers at which, where these are not the recording's own.
    """
    unit = np.zeros((2, of.size))
    unit[:, element] = 1.0
    found = _Backward(known).through({of: unit.reshape(2, *of.shape)}, ())
    return {node: share[0] for node, share in found.items()}


class _Backward:
    """One pass backwards through a recording."""

    def __init__(self, known: Known | None) -> None:
        self.known = known

    def value(self, node: Node) -> Values:
        return node.value if self.known is None else self.known.get(node, node.value)

    @np.errstate(all="ignore")
    def through(self, given: Known, still: Container[Node]) -> dict[Node, Values]:
        """What is handed on to all under some quantities, down to what is ``still``."""
        shares, first = dict(given), dict[Block, Node]()
        order = list(bottom_up(given, still))
        for node in order:
            if node.op == "found":
                first.setdefault(node.args[0], node)
        for node in reversed(order):
            for operand, share in self._shares(node, shares, first):
                if operand.op != "constant" and share[1].any():
                    shares[operand] = shares[operand] + share if operand in shares else share
        return shares

    def _shares(self, node: Node, shares: Known, first: Mapping[Block, Node]) -> _Shares:
        """What a quantity hands on to its operands; the unknowns of a block do it together, after the last of them."""
        if node.op == "found" and has_equation(node):
            block: Block = node.args[0]
            yield from self._found(block, shares) if first[block] is node else ()
        elif node not in shares:
            return
        elif node.op == "iterated":
            yield from self._iterated(node, shares[node])
        elif node.op in _MOVED:
            yield from _MOVED[node.op](node, shares[node], self.value)
        elif node.op in ELEMENTWISE:
            yield from self._elementwise(node, shares[node])
        else:
            yield from ((operand, _lost(operand.shape)) for operand in node.operands)

    def _elementwise(self, node: Node, share: Values) -> _Shares:
        own, hangs = share
        for k, (operand, part) in enumerate(zip(*self._parts(node), strict=True)):
            if operand.op != "constant":
                chosen = node.op in ("max", "min") or (node.op == "where" and k > 0)
                rests = np.equal(part, 0) & (chosen or node.op in _STEPS)  # also where nobody knows what it would move
                slope = np.where((hangs > 0) & ~rests, part * own, 0.0)
                on = np.where(rests, 0.0, hangs) if chosen else hangs
                yield operand, _summed(np.stack(np.broadcast_arrays(slope, on)), operand.shape)

    def _parts(self, node: Node) -> tuple[Sequence[Node], Sequence[Any]]:
        """The operands of an operation and its partial derivatives by them, NaN where it jumps or has a corner."""
        y, values = self.value(node), [self.value(operand) for operand in node.operands]
        match node.op:
            case op if op in SHAPED:
                return node.operands[:1], (1.0,)
            case "and" | "or" | "not" | "finite":
                return node.operands, [0.0] * len(values)
            case "where":
                now = values[0].astype(bool)
                jumps = np.where(now | (values[0].dtype == bool), 0.0, np.nan)  # a number that is 0 as a condition
                return node.operands, (jumps, now + 0.0, ~now + 0.0)
            case op if op in _CONDITIONS:
                tied = np.where(values[0] == values[1], np.nan, 0.0)
                return node.operands, (tied, tied)
        rule: Rule
        rule, args = kernel(node) or (RULES.get(node.op, smooth), node.operands)
        if rule is smooth:
            return args, SMOOTH[node.op](y, *(v + 0.0 for v in values))
        return args, list(_both_sides(rule, node, y, [self.value(operand) for operand in args]))

    def _iterated(self, node: Node, share: Values) -> _Shares:
        """By as many turns as the loop takes: down to what these rest on."""
        ends = self.through({node.args[2]: share}, node.operands)
        yield from ((end, own) for end, own in ends.items() if end in node.operands or not end.operands)

    def _found(self, block: Block, shares: Known) -> _Shares:
        """By the equations: what the unknowns hand on goes to these, which go on to vanish."""
        given = [shares.get(node, np.zeros((2, *node.shape))).reshape(2, -1) for node in block.nodes]
        right, hangs = np.stack(given, -1) if block.elementwise else np.concatenate(given, 1)[:, None]
        if hangs.any():
            found = -solution(jacobian(block, self.known).transpose(0, 2, 1), right[..., None])[..., 0]
            each = found.T if block.elementwise else found.reshape(len(block.nodes), -1)
            on = np.broadcast_to(hangs.sum(-1), each[0].shape)
            residuals = dict[Node, Values]()
            for node, own in zip(block.equations, each, strict=True):
                share = _summed(np.stack([own, on]).reshape(2, *block.nodes[0].shape), node.shape)
                residuals[node] = residuals.get(node, 0.0) + share
            under = self.through(residuals, {*block.nodes, *block.under})
            yield from ((node, under[node]) for node in block.under if node in under)


def _both_sides(rule: Rule, node: Node, y: Values, values: Sequence[Values]) -> Values:
    """Partial derivatives by a rule, NaN where they are others from ahead than from behind."""
    n, seen = len(values), []
    for way in (1.0, -1.0):
        units = [np.broadcast_to(way * u.reshape(n, *[1] * len(node.shape)), (n, *node.shape)) for u in np.eye(n)]
        seen.append(way * rule(node, y, values, [Motion(u, u != 0) for u in units]).ahead)
    return Slope(*seen).both


def _lost(shape: tuple[int, ...]) -> Values:
    return np.stack([np.full(shape, np.nan), np.ones(shape)])


def _summed(share: Values, shape: tuple[int, ...]) -> Values:
    """What is handed on to an operand of a shape that was broadcast."""
    if share.shape[1:] == shape:
        return share
    ahead = share.ndim - 1 - len(shape)
    stretched = (1 + ahead + k for k, n in enumerate(shape) if n == 1)
    found: Values = np.sum(share, (*range(1, 1 + ahead), *stretched))
    return found.reshape(2, *shape)


# --- what moves and reduces elements -----------------------------------------------------------------------------


def _take(node: Node, share: Values, value: _Value) -> _Shares:
    source, index = node.args[:2]
    yield source, _put(source.shape, index, share)


def _at(node: Node, share: Values, value: _Value) -> _Shares:
    source, position = node.args
    index = value(position)
    inside = (index >= 0) & (index < source.size)
    yield source, _put(source.shape, np.where(inside, index, 0).astype(np.intp), share * inside)
    yield position, np.stack([np.zeros(share.shape[1:]), share[1]])


def _join(node: Node, share: Values, value: _Value) -> _Shares:
    sources, which, inside, _ = node.args
    which, inside = np.broadcast_arrays(which, inside)
    for k, source in enumerate(sources):
        here = which == k
        yield source, _put(source.shape, inside[here], share[:, here])


def _reduce(node: Node, share: Values, value: _Value) -> _Shares:
    source, groups, kind, _ = node.args
    flat, found = value(source).reshape(-1), np.zeros((2, source.size))
    for group, end, (own, hangs) in zip(groups, value(node).reshape(-1), share.reshape(2, -1).T, strict=True):
        if hangs:
            part = _part(kind, flat[group], end)
            rests = (part == 0) & (kind not in ("sum", "prod", "nansum"))
            on = np.where(rests & (kind in ("max", "min", "nanmax", "nanmin")), 0.0, hangs)
            _add(found, group, np.stack([np.where(rests, 0.0, part * own), on]))
    yield source, found.reshape(2, *source.shape)


def _part(kind: str, x: Values, y: Any) -> Values:
    """Partial derivatives of one number by those of which it is made."""
    if kind in ("any", "all", "sum"):
        return np.full(x.size, float(kind == "sum"))
    units = np.eye(x.size)
    ahead, behind = (way * reduced(kind, x, y, Motion(way * units, units != 0)).ahead for way in (1.0, -1.0))
    return Slope(ahead, behind).both


def _put(shape: tuple[int, ...], index: Values, share: Values) -> Values:
    found = np.zeros((2, *shape))
    _add(found.reshape(2, -1), index, share)
    return found


def _add(found: Values, index: Values, share: Values) -> None:
    for row, own in zip(found, share, strict=True):
        np.add.at(row, index, own)


_MOVED: dict[str, Callable[[Node, Values, _Value], _Shares]] = {
    "take": _take, "at": _at, "join": _join, "reduce": _reduce,
}  # fmt: skip
