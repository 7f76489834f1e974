"""The slope rules of operations: how a result moves where its operands do.

A rule takes the node, its number and those of its operands, and their motions in the same directions.
"""

from collections.abc import Callable, Sequence
from functools import reduce
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mechsheet.quantities.node import Node, is_number
from mechsheet.quantities.operations import ELEMENTWISE, REDUCE, Values

ROUNDING = 64 * np.finfo(float).eps  # by which two numbers may differ that are the same but for rounding

# Partial derivatives of smooth operations, of the result and the operands; balls are numbers here too.
SMOOTH: dict[str, Callable[..., tuple[Any, ...]]] = {
    "add": lambda y, a, b: (1.0, 1.0),
    "sub": lambda y, a, b: (1.0, -1.0),
    "mul": lambda y, a, b: (b, a),
    "div": lambda y, a, b: (1 / b, -y / b),
    "neg": lambda y, a: (-1.0,),
    "sqrt": lambda y, a: (1 / (2 * y),),
    "exp": lambda y, a: (y,),
    "log": lambda y, a: (1 / a,),
    "sin": lambda y, a: (np.cos(a),),
    "cos": lambda y, a: (-np.sin(a),),
    "tan": lambda y, a: (1 + y * y,),
    "asin": lambda y, a: (1 / np.sqrt((1 - a) * (1 + a)),),
    "acos": lambda y, a: (-1 / np.sqrt((1 - a) * (1 + a)),),
    "atan2": lambda y, a, b: (b / (a * a + b * b), -a / (a * a + b * b)),
}


class Motion(NamedTuple):
    """How a quantity moves in each direction, shape (directions, ...); and whether it does, where that is not 0 alone.

    Of a condition, whether it holds just ahead, and whether that is something else than now, or not known: where it
    moves and is the same.
    """

    ahead: Values
    moves: Values

    def rearranged(self, f: Callable[[Values], Values]) -> "Motion":
        """What a function of arrays whose first axis is that of the directions makes of both."""
        return Motion(f(self.ahead), f(self.moves))


def shaped(motion: Motion, node: Node) -> Motion:
    return motion.rearranged(lambda x: x.reshape(len(x), *node.shape))


def _sum(parts: Sequence[Any], operands: Sequence[Motion]) -> Motion:
    """What partial derivatives make of the motions of operands; what does not move adds nothing."""
    moves = reduce(np.logical_or, [m.moves for m in operands])
    ahead = reduce(np.add, [np.where(m.moves, part * m.ahead, 0.0) for part, m in zip(parts, operands, strict=True)])
    return Motion(ahead if ahead.shape == moves.shape else np.broadcast_to(ahead, moves.shape), moves)


def smooth(node: Node, y: Values, values: Sequence[Values], operands: Sequence[Motion]) -> Motion:
    return _sum(SMOOTH[node.op](y, *(v + 0.0 for v in values)), [number(m) for m in operands])


def number(motion: Motion) -> Motion:
    """Of a condition that counts as 1 or 0, which jumps or rests."""
    if motion.ahead.dtype != bool:
        return motion
    return Motion(np.where(motion.moves, np.nan, 0.0), motion.moves)


def _sqrt(node: Node, y: Values, values: Sequence[Values], operands: Sequence[Motion]) -> Motion:
    motion = smooth(node, y, values, operands)
    # At 0 what moves downwards is no number ahead, and what stays to the first order nobody knows.
    wrong = (values[0] == 0) & motion.moves & ~(operands[0].ahead > 0)
    return Motion(np.where(wrong, np.nan, motion.ahead), motion.moves)


def _pow(node: Node, y: Values, values: Sequence[Values], operands: Sequence[Motion]) -> Motion:
    a, b = (v + 0.0 for v in values)
    by_base = np.where(b == 0, 0.0, b * np.power(a, b - 1))
    by_exponent = np.where((y == 0) & (b > 0), 0.0, np.log(a) * y) if operands[1].moves.any() else 0.0
    return _sum((by_base, by_exponent), operands)


def _abs(node: Node, y: Values, values: Sequence[Values], operands: Sequence[Motion]) -> Motion:
    (a,), (m,) = values, operands
    return Motion(np.where(a == 0, np.abs(m.ahead), np.sign(a) * m.ahead), m.moves)


def _extreme(node: Node, y: Values, values: Sequence[Values], operands: Sequence[Motion]) -> Motion:
    (a, b), (p, q) = values, operands
    first = a > b if node.op == "max" else a < b
    choose = np.maximum if node.op == "max" else np.minimum
    ahead = np.where(a == b, choose(p.ahead, q.ahead), np.where(first, p.ahead, q.ahead))
    moves = np.where(a == b, p.moves | q.moves, np.where(first, p.moves, q.moves))
    lost = _jumps(a, p) | _jumps(b, q)  # the other one may be the extreme ahead
    return Motion(np.where(np.isnan(y) | lost, np.nan, ahead), moves | lost)


def _jumps(value: Values, motion: Motion) -> NDArray[np.bool_]:
    """Where there is a number, and nobody knows what it is ahead."""
    return np.asarray(motion.moves & np.isnan(motion.ahead) & ~np.isnan(value))


def _compared(node: Node, y: Values, values: Sequence[Values], operands: Sequence[Motion]) -> Motion:
    """Of equal numbers that which their motions say; of what jumps nobody knows."""
    (a, b), (p, q) = values, [number(m) for m in operands]
    tied = (a == b) & (p.moves | q.moves)
    ahead = np.where(tied, ELEMENTWISE[node.op](p.ahead, q.ahead), y)
    unknown = (tied & np.isnan(p.ahead - q.ahead)) | _jumps(a, p) | _jumps(b, q)
    return Motion(np.where(unknown, y, ahead), (ahead != y) | unknown)


def _logical(node: Node, y: Values, values: Sequence[Values], operands: Sequence[Motion]) -> Motion:
    ahead = ELEMENTWISE[node.op](*(m.ahead for m in operands))
    unknown = [m.moves & (m.ahead == v) for m, v in zip(operands, values, strict=True)]
    return Motion(ahead, (ahead != y) | np.logical_or.reduce(np.broadcast_arrays(*unknown)))


def _where(node: Node, y: Values, values: Sequence[Values], operands: Sequence[Motion]) -> Motion:
    (c, a, b), (ahead, p, q) = values, operands
    now = c.astype(bool)
    if ahead.ahead.dtype != bool:  # a number as a condition holds unless it is 0, from which it moves away
        ahead = Motion(now | (ahead.ahead != 0), ~now & (ahead.ahead != 0))
    if p.ahead.dtype == q.ahead.dtype == bool:
        slope, moves = (np.where(ahead.ahead, x, z) for x, z in zip(p, q, strict=True))
        return Motion(slope, ahead.moves | moves)
    p, q = number(p), number(q)
    jumps = (ahead.ahead != now) & ~(np.abs((a + 0.0) - b) <= ROUNDING * np.abs(a))
    jumps |= ahead.moves & (ahead.ahead == now)
    slope, moves = (np.where(ahead.ahead, x, z) for x, z in zip(p, q, strict=True))
    return Motion(np.where(jumps, np.nan, slope), moves | jumps)


def _step(node: Node, y: Values, values: Sequence[Values], operands: Sequence[Motion]) -> Motion:
    """Whole numbers and signs, which rest but where they jump."""
    (a,), (m,) = values, operands
    match node.op:
        case "floor":
            jumps = (a == y) & (m.ahead < 0)
        case "round":
            jumps = (np.abs(a - y) == 0.5) & (m.ahead != 0)
        case _:
            jumps = (a == 0) & (m.ahead != 0)
    lost = np.isnan(m.ahead) | jumps
    return Motion(np.where(lost, np.nan, 0.0), m.moves & lost)


def _angle(node: Node, y: Values, values: Sequence[Values], operands: Sequence[Motion]) -> Motion:
    """Of a direction; at half a turn it jumps to minus half a turn where that turns on."""
    motion = smooth(node, y, values, operands)
    jumps = (values[0] == 0) & (values[1] < 0) & operands[0].moves & ~(operands[0].ahead * y > 0)
    return Motion(np.where(jumps, np.nan, motion.ahead), motion.moves)


def _mod(node: Node, y: Values, values: Sequence[Values], operands: Sequence[Motion]) -> Motion:
    a, b = values
    motion = _sum((1.0, -np.round((a - y) / b)), operands)
    jumps = (y == 0) & (motion.ahead * np.sign(b) < 0)
    return Motion(np.where(jumps, np.nan, motion.ahead), motion.moves)


def _same(node: Node, y: Values, values: Sequence[Values], operands: Sequence[Motion]) -> Motion:
    """The first operand in the shape of the result, which the others only shape."""
    shape = (len(operands[0].ahead), *node.shape)
    return operands[0].rearranged(lambda x: np.broadcast_to(x, shape))


def _finite(node: Node, y: Values, values: Sequence[Values], operands: Sequence[Motion]) -> Motion:
    """Whether there is a number ahead: where its slope is none, nobody knows."""
    (m,) = operands
    return Motion(y & ~np.isnan(m.ahead), m.moves & np.isnan(m.ahead) & y)


def _take(node: Node, y: Values, values: Sequence[Values], operands: Sequence[Motion]) -> Motion:
    index = node.args[1]
    return operands[0].rearranged(lambda x: x.reshape(len(x), -1)[:, index])


def _at(node: Node, y: Values, values: Sequence[Values], operands: Sequence[Motion]) -> Motion:
    source, position = values
    outside = ~((position >= 0) & (position < source.size))
    index = np.where(outside, 0, position).astype(np.intp)
    m = operands[0].rearranged(lambda x: x.reshape(len(x), -1)[:, index])
    lost = outside | (operands[1].moves & (operands[1].ahead != 0))
    return Motion(np.where(lost, np.nan, m.ahead), m.moves | operands[1].moves)


def _join(node: Node, y: Values, values: Sequence[Values], operands: Sequence[Motion]) -> Motion:
    _, which, inside, _ = node.args
    flat = np.cumsum([0, *(v.size for v in values)])[which] + inside
    if any(m.ahead.dtype != bool for m in operands):
        operands = [number(m) for m in operands]
    count = len(operands[0].ahead)
    return Motion(
        *(np.concatenate([x.reshape(count, -1) for x in part], 1)[:, flat] for part in zip(*operands, strict=True))
    )


def _reduce(node: Node, y: Values, values: Sequence[Values], operands: Sequence[Motion]) -> Motion:
    _, groups, kind, _ = node.args
    motion = operands[0].rearranged(lambda x: x.reshape(len(x), -1))
    source, ends = values[0].reshape(-1), y.reshape(-1)
    each = [
        reduced(kind, source[g], end, Motion(motion.ahead[:, g], motion.moves[:, g]))
        for g, end in zip(groups, ends, strict=True)
    ]
    return shaped(Motion(np.stack([m.ahead for m in each], 1), np.stack([m.moves for m in each], 1)), node)


def reduced(kind: str, x: Values, y: Any, motion: Motion) -> Motion:
    """How one number moves that is made of several, of which there is one axis."""
    moves = np.logical_or.reduce(motion.moves, axis=1)
    if kind in ("any", "all"):
        ahead, unknown = REDUCE[kind](motion.ahead, 1), np.logical_or.reduce(motion.moves & (motion.ahead == x), axis=1)
        return Motion(ahead, (ahead != y) | unknown)
    ahead = np.where(motion.moves, number(motion).ahead, 0.0)
    x = x + 0.0
    if kind.startswith("nan"):
        known = ~np.isnan(x)
        x, ahead, kind = x[known], ahead[:, known], kind.removeprefix("nan")
    jumps = np.logical_or.reduce(np.isnan(ahead) & ~np.isnan(x), axis=1)  # one that does may be the extreme ahead
    places = kind in ("argmax", "argmin")
    if places and not np.isnan(y) and not np.isnan(x[int(y)]):  # of equal ones the first, until one is better
        equal = x == x[int(y)]
        better = np.max if kind == "argmax" else np.min
        lost = jumps | (better(ahead[:, equal], 1) != ahead[:, int(y)])
        return Motion(np.where(lost, np.nan, 0.0), moves & lost)
    if kind == "sum":
        return Motion(ahead.sum(1), moves)
    if kind == "prod":
        others = [np.prod(np.delete(x, k)) for k in range(x.size)]
        return Motion(np.where(motion.moves, ahead * others, 0.0).sum(1), moves)
    if np.isnan(y) or places:
        return Motion(np.where(moves, np.nan, 0.0), moves)
    equal = x == y
    return Motion(np.where(jumps, np.nan, (np.max if kind == "max" else np.min)(ahead[:, equal], 1)), moves)


def _still(node: Node, y: Values, values: Sequence[Values], operands: Sequence[Motion]) -> Motion:
    """How many elements there are, however these move."""
    shape = len(operands[0].ahead), *node.shape
    return Motion(np.zeros(shape), np.zeros(shape, dtype=bool))


def _unknown(node: Node, y: Values, values: Sequence[Values], operands: Sequence[Motion]) -> Motion:
    """Numbers of the worksheet's own run: none where anything under them moves."""
    count = len(operands[0].ahead)
    moves = np.any([m.moves.reshape(count, -1).any(1) for m in operands], 0)
    spread = np.broadcast_to(moves.reshape(-1, *[1] * len(node.shape)), (count, *node.shape))
    return Motion(np.where(spread, np.nan, 0.0), spread)


Rule = Callable[[Node, Values, Sequence[Values], Sequence[Motion]], Motion]
RULES: dict[str, Rule] = {
    "sqrt": _sqrt, "pow": _pow, "abs": _abs, "max": _extreme, "min": _extreme, "where": _where, "mod": _mod,
    "atan2": _angle,
    "floor": _step, "round": _step, "sign": _step, "like": _same, "sized": _same, "finite": _finite,
    **dict.fromkeys(("lt", "le", "gt", "ge", "eq", "ne"), _compared),
    **dict.fromkeys(("and", "or", "not"), _logical),
    "take": _take, "at": _at, "join": _join, "reduce": _reduce, "length": _still, "exported": _unknown,
}  # fmt: skip


def kernel(node: Node) -> tuple[Rule, tuple[Node, ...]] | None:
    """The rule of a whole formula that has a singularity inside and none in all, and the operands of that formula."""
    match node:
        case Node(op="sqrt", args=(Node(op="add", args=(Node(op="pow", args=(a, p)), Node(op="pow", args=(b, q)))),)):
            return (_hypot, (a, b)) if is_number(p, 2) and is_number(q, 2) else None
        case Node(op="where", args=(Node(op="eq", args=(Node(op="add", args=(one, x)) as u, same)), first, rest)):
            quotient = rest.op == "div" and rest.args[1].op == "sub" and rest.args[1].args[0] is u
            return (_log1p, (x,)) if first is x and quotient and is_number(one, 1) and is_number(same, 1) else None
    return None


def _hypot(node: Node, y: Values, values: Sequence[Values], operands: Sequence[Motion]) -> Motion:
    """The distance from 0, of which a point there moves away in all directions."""
    a, b = values
    motion = _sum((a / y, b / y), operands)
    start = np.hypot(operands[0].ahead, operands[1].ahead)
    return Motion(np.where(y == 0, np.where(motion.moves, start, 0.0), motion.ahead), motion.moves)


def _log1p(node: Node, y: Values, values: Sequence[Values], operands: Sequence[Motion]) -> Motion:
    return _sum((1 / (1 + values[0]),), operands)
