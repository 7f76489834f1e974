"""Numbers of a recording for other inputs: numpy as one reader, and the reference for the others."""

from collections.abc import Callable, Container, Iterable, Mapping, Sequence
from itertools import chain
from typing import Any

import numpy as np

from mechsheet.quantities.node import Block, Loop, Node, bottom_up, passes_over, steps_of
from mechsheet.quantities.operations import ELEMENTWISE, REDUCE, REDUCE_SO_FAR, Values
from mechsheet.readers import between
from mechsheet.worksheet.find import find
from mechsheet.worksheet.system import solve
from mechsheet.worksheet.verdict import values_only

_MOST = 1_000_000  # rows


def _at(source: Values, position: Values) -> Values:
    inside = (position >= 0) & (position < source.size)
    return np.where(inside, source.reshape(-1)[np.where(inside, position, 0).astype(np.intp)], np.nan)


def _reduced(node: Node, source: Values) -> Any:
    _, _, kind, along = node.args
    if along.so_far:
        return REDUCE_SO_FAR[kind].accumulate(source, axis=along.axis)
    return REDUCE[kind](source, axis=along.axis, keepdims=along.keepdims)


def _taken(node: Node, source: Values) -> Any:
    _, index, moved = node.args
    if not moved:
        return source.reshape(-1)[index]
    for move in moved:
        source = np.asarray(move(source))
    return source


def _rows(count: Values) -> Values:
    """Numbers of so many rows; none of a number that is not whole."""
    if not (float(count).is_integer() and 0 <= count <= _MOST):
        raise ValueError(f"{count} rows")
    return np.arange(int(count))


_RULES: dict[str, Callable[..., Any]] = {
    "constant": lambda node: node.value,
    "rows": lambda _, count: _rows(count),
    "length": lambda node, source: np.array(source.shape[node.args[1]]),
    "take": _taken,
    "at": lambda _, source, position: _at(source, position),
    "join": lambda node, *sources: _joined(node, sources),
    "reduce": _reduced,
    "exported": lambda node, *under: node.value if _same(node.args, under) else np.full(node.shape, np.nan),
    **{op: (lambda _, *args, f=f: f(*args)) for op, f in ELEMENTWISE.items()},
}


def moved_elements(node: Node, sources: Sequence[Values]) -> Values:
    """What an operation that moves elements, or puts them together, makes of others in their places."""
    return np.asarray(_RULES[node.op](node, *sources))


def _joined(node: Node, sources: tuple[Values, ...]) -> Any:
    _, which, inside, moved = node.args
    if moved:
        return moved(list(sources))
    starts = np.cumsum([0, *(source.size for source in sources)])[:-1]
    flat: Values = np.concatenate([np.asarray(s).reshape(-1) for s in sources])
    return flat[starts[which] + inside]


def _same(nodes: Sequence[Node], now: Sequence[Values]) -> bool:
    """Whether quantities are what they are in the recording."""
    return all(np.array_equal(a, b.value, equal_nan=True) for a, b in zip(now, nodes, strict=True))


@np.errstate(all="ignore")
def numbers(wanted: Iterable[Node], given: Mapping[Node, Any]) -> dict[Node, Values]:
    """Numbers of nodes, where some are given; inputs that are not keep theirs, and what is found is solved again.

    NaN where a number of the worksheet's own run is not that of these inputs, where no solution is found, and where the
    worksheet has no such rows or does not put as many together.
    """
    known: dict[Node, Values] = {node: np.asarray(value) for node, value in given.items()}
    solved: dict[Block | Loop, list[Values]] = {}
    none, lost = set[Node](), set[Node]()  # no numbers, and what rests on numbers that are lost with other inputs
    for node in bottom_up(wanted, known):
        if (node.op == "exported" and not _same(node.args, [known[o] for o in node.args])) or not lost.isdisjoint(
            node.operands
        ):
            lost.add(node)
        if not none.isdisjoint(node.operands) or (node in lost and (passes_over(node) or _decided(node, lost))):
            none.add(node)
        elif node.op == "input":
            known[node] = node.value
            continue
        else:
            try:
                known[node] = _number(node, known, solved)
                continue
            except (ValueError, IndexError):
                if not (node.stretches or any(operand.stretches for operand in node.operands)):
                    raise
                none.add(node)
        known[node] = np.full(node.shape, False if node.value.dtype == bool else np.nan)
    return known


def _decided(node: Node, lost: Container[Node]) -> bool:
    """Whether a number is chosen by conditions of which nobody knows whether they hold."""
    return node.value.dtype != bool and any(part in lost and part.value.dtype == bool for part in node.operands)


def _number(node: Node, known: Mapping[Node, Values], solved: dict[Block | Loop, list[Values]]) -> Values:
    if node.op == "iterated":
        loop, number, _ = node.args
        if loop not in solved:
            solved[loop] = _repeated(loop, known)
        ended: Values = solved[loop][number]
        return ended
    if node.op != "found":
        values = [known[operand] for operand in node.operands]
        made = np.asarray(_RULES[node.op](node, *values))
        refused = node.op in _REFUSED and made.shape == () and np.isinf(made) and np.isfinite(values).all()
        if refused and not _of_arrays(node):
            return np.asarray(np.nan)
        return made
    block, number = node.args
    if block not in solved and not _same(block.under, [known[o] for o in block.under]):
        solved[block] = _again(block, known)
    return solved[block][number] if block in solved else node.value


_REFUSED = ("div", "pow", "log", "exp")  # by Python, where one number of single ones is infinite


def _of_arrays(node: Node) -> bool:
    """Whether a number is computed from elements of arrays, by numpy, which refuses nothing."""
    return any(part.shape for part in chain([node], steps_of(node, _single, ())))


def _single(node: Node) -> tuple[Node, ...]:
    """What a single number is made of."""
    return node.operands if not node.shape and (node.op in ELEMENTWISE or node.op in _ELEMENTS) else ()


_ELEMENTS = ("take", "at", "reduce")


def _repeated(loop: Loop, known: Mapping[Node, Values]) -> list[Values]:
    """The numbers of a loop at its end; none of one that does not end."""
    under = {node: known[node] for node in loop.under}
    state = [known.get(node, node.value) for node in loop.initial]
    for _ in range(_TURNS if loop.most is None else loop.most):
        found = numbers([loop.done, *loop.following], {**under, **dict(zip(loop.nodes, state, strict=True))})
        state = [found[node] for node in loop.following]
        if found[loop.done].all():
            return state
    return [value + np.nan for value in state] if loop.most is None else state


_TURNS = 10_000  # of a loop


def _again(block: Block, known: Mapping[Node, Values]) -> list[Values]:
    """The unknowns of a solve block for other numbers of what it rests on, and the evaluations of its equations."""
    under = {node: known[node] for node in block.under}

    def residuals(x: Sequence[Values]) -> list[Values]:
        found = numbers(block.residuals, {**under, **dict(zip(block.nodes, x, strict=True))})
        return [found[node] for node in block.residuals]

    def of(*x: Values) -> list[Values]:
        """Residuals of values that stand on one more axis; of single numbers as if all elements were that."""
        if block.elementwise or x[0].ndim == block.nodes[0].value.ndim:
            return residuals(x)
        if not x[0].ndim:
            return residuals([np.broadcast_to(one, whole) for one in x])
        each = [residuals(one) for one in zip(*x, strict=True)]
        return [np.stack(parts) for parts in zip(*each, strict=True)]

    starts = {name: tuple(known.get(n, n.value) for n in nodes) for name, nodes in block.starts.items()}
    whole = np.broadcast_shapes(*(np.shape(end) for ends in starts.values() for end in ends))
    with values_only():
        if block.single:
            lo, hi, guess = ((starts.get(name) or (None,))[0] for name in ("lo", "hi", "guess"))
            if block.method:
                return [np.asarray(between.root(block.method, lambda x: of(np.asarray(x))[0], lo, hi))]
            found = find(lambda x: of(x)[0], lo, hi, guess=guess)
            return [np.asarray(found.value if found.valued is not False else np.nan)]
        given: dict[str, Any] = {name: ends if len(ends) > 1 else ends[0] for name, ends in starts.items()}
        solution = solve(
            lambda **x: tuple(of(*x.values())), 0.0, block.unit, block.unknown_unit, given, least=block.least
        )
    values = solution.value if solution.valued is not False else [np.nan] * len(block.nodes)
    return [np.asarray(v) for v in (*values, solution.evaluations)]
