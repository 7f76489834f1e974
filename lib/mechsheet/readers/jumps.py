"""Where a recording goes another way within tolerances: comparisons, whole numbers and choices, by the slopes."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import NamedTuple

import numpy as np

from mechsheet.quantities.node import Node, bottom_up
from mechsheet.quantities.operations import ELEMENTWISE, Values
from mechsheet.readers.numbers import numbers
from mechsheet.readers.slopes import slopes
from mechsheet.worksheet.errors import OF_NUMBERS

MISLED = 1.5  # times what slopes say: as far off a number may be that is not said to bend
_PLACES = 8  # ends of the tolerances, and those opposite to them, at which it is looked whether a line goes another way


class Jump(NamedTuple):
    """A line that goes another way within tolerances, and the numbers of the inputs that move what it looks at."""

    line: int
    by: tuple[int, ...]


@np.errstate(all="ignore")  # of what is no number
def jumps(wanted: Iterable[Node], by: Sequence[Node], sizes: Sequence[float]) -> dict[Node, Jump]:
    """Of some quantities those that rest on what goes another way where inputs are up to ``sizes`` off.

    To the first order, as bands are, and a little beyond where it does so at an end of these; whether a quantity jumps
    there or only bends, cases tell.
    """
    wanted, moving = list(wanted), set(by)
    order, steps = _order(wanted), dict[Node, _Turns]()
    outer = set(bottom_up(wanted, ()))
    for node in order:
        if not moving.isdisjoint(node.operands):
            moving.add(node)
            if turns := _TURNS.get(node.args[2] if node.op == "reduce" else node.op):
                steps[node] = turns
    seen = slopes(dict.fromkeys(x for node in steps for x in node.operands if x in moving), by)
    most = np.array(sizes, dtype=float)

    def moves(x: Node) -> Values:
        """By how much each input moves a quantity at most."""
        if x not in seen:
            return np.zeros((len(most), *x.shape))
        ahead, behind = seen[x]
        steeper = np.where(np.isnan(behind) | (np.abs(ahead) < np.abs(behind)), behind, ahead)
        return np.asarray(steeper * most.reshape(-1, *[1] * len(x.shape)))

    found = dict[Node, Jump]()
    for node, turns in steps.items():
        moved = [moves(x) for x in node.operands]
        beyond = node in outer and turns(node, [MISLED * m for m in moved])
        if turns(node, moved) or (beyond and _turned(node, moved, dict(zip(by, sizes, strict=True)))):
            found[node] = Jump(node.line, tuple(k for k in range(len(most)) if any(np.any(m[k] != 0) for m in moved)))
    known = -1
    while known < len(found):  # what is found rests on its equations, which rest on it
        known = len(found)
        for node in order:
            if node not in found and (under := next((found[x] for x in _under(node) if x in found), None)):
                found[node] = under
    return {node: found[node] for node in wanted if node in found}


def _under(node: Node) -> tuple[Node, ...]:
    """What a quantity rests on, inside of a loop and in the equations of what is found too."""
    if node.op == "iterated":
        return *node.operands, *node.args[2:]
    return (*node.operands, *node.args[0].equations) if node.op == "found" else node.operands


def _order(wanted: Sequence[Node]) -> list[Node]:
    """All that quantities rest on, each behind its operands."""
    roots, every = list(wanted), list[Node]()
    while True:
        every = list(bottom_up(roots, ()))
        known = set(every)
        new = [x for node in every for x in _under(node) if x not in known]
        if not new:
            return every
        roots += dict.fromkeys(new)


def _turned(node: Node, moves: Sequence[Values], sizes: Mapping[Node, float]) -> bool:
    """Whether something is another one at those ends of the tolerances to which slopes move it most."""
    first, *others = _aligned(node, moves)
    apart = first - others[0] if others else first
    ends = np.unique(np.sign(apart.reshape(len(apart), -1)), axis=1).T[:_PLACES]
    for end in np.concatenate([ends, -ends]):
        at = {x: x.value + part * size for (x, size), part in zip(sizes.items(), end, strict=True)}
        try:
            there = numbers([node], at)[node]
        except OF_NUMBERS:  # as of a Find that has no interval there
            return True
        if not np.array_equal(there, node.value, equal_nan=node.value.dtype.kind == "f"):
            return True
    return False


def _aligned(node: Node, moves: Sequence[Values]) -> list[Values]:
    """Moves of the operands of a node, by inputs first and with as many axes as the node has behind."""
    return [m.reshape(len(m), *[1] * (len(node.shape) + 1 - m.ndim), *m.shape[1:]) for m in moves]


def _off(moves: Sequence[Values], which: int = 0) -> Values:
    return np.asarray(np.abs(moves[which]).sum(0))


def _compared(node: Node, moves: Sequence[Values]) -> bool:
    """Whether a comparison may be another one; equality, which is met by chance alone, where it is met now."""
    a, b = (x.value for x in node.operands)
    if a.dtype == bool or b.dtype == bool:
        return False  # what these rest on tells
    rank = len(node.shape)
    p, q = (m.reshape(len(m), *[1] * (rank + 1 - m.ndim), *m.shape[1:]) for m in moves)
    off = np.abs(p - q).sum(0)
    apart = np.abs(a - b)
    if node.op in ("eq", "ne"):
        return bool(np.any((apart == 0) & ~(off == 0)))
    return bool(np.any(np.isfinite(apart) & ~(off == 0) & ~(apart > off)))


def _whole(node: Node, moves: Sequence[Values]) -> bool:
    """Whether a whole number or a sign may be another one."""
    (a,), off = (x.value for x in node.operands), _off(moves)
    f = ELEMENTWISE[node.op]
    return bool(np.any(np.isfinite(a) & ~(f(a - off) == f(a + off))))


def _mod(node: Node, moves: Sequence[Values]) -> bool:
    a, b = (x.value for x in node.operands)
    p, q = _aligned(node, moves)
    turns, off = a / b, np.abs((p - q * (a / b)) / b).sum(0)
    return bool(np.any(np.isfinite(turns) & ~(np.floor(turns - off) == np.floor(turns + off))))


def _wraps(node: Node, moves: Sequence[Values]) -> bool:
    """Whether an angle may pass from half a turn to minus half a turn."""
    y, x = (part.value for part in node.operands)
    p, q = (np.abs(m).sum(0) for m in _aligned(node, moves))
    return bool(np.any((p > 0) & (np.abs(y) <= p) & (x < q)))


def _first(node: Node, moves: Sequence[Values]) -> bool:
    """Whether the greatest or the least element may be another one."""
    (x,) = node.operands
    flat, moved = x.value.reshape(-1), moves[0].reshape(len(moves[0]), -1)
    if flat.dtype == bool:
        return False
    for group in node.args[1]:
        own, m = flat[group], moved[:, group]
        k = int(np.argmax(own) if node.args[2] == "argmax" else np.argmin(own))
        off = np.abs(m - m[:, [k]]).sum(0)
        if np.any(~(off == 0) & ~(np.abs(own - own[k]) > off)):
            return True
    return False


_Turns = Callable[[Node, Sequence[Values]], bool]
_TURNS: dict[str, _Turns] = {
    **dict.fromkeys(("lt", "le", "gt", "ge", "eq", "ne"), _compared),
    **dict.fromkeys(("floor", "round", "sign"), _whole),
    "mod": _mod,
    "atan2": _wraps,
    **dict.fromkeys(("argmax", "argmin"), _first),
}
