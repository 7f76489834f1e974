"""Numbers of a recording for other inputs: numpy as one reader, and the reference for the others."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

import numpy as np

from mechsheet.recording.graph import ELEMENTWISE, REDUCE, Block, Node, Values, bottom_up
from mechsheet.worksheet.find import find
from mechsheet.worksheet.system import solve
from mechsheet.worksheet.verdict import values_only


def _at(source: Values, position: Values) -> Values:
    inside = (position >= 0) & (position < source.size)
    return np.where(inside, source.reshape(-1)[np.where(inside, position, 0).astype(np.intp)], np.nan)


def _reduced(node: Node, source: Values) -> Values:
    _, groups, kind = node.args
    return np.array([REDUCE[kind](source.reshape(-1)[group]) for group in groups]).reshape(node.shape)


_RULES: dict[str, Callable[..., Any]] = {
    "constant": lambda node: node.value,
    "rows": lambda node: node.value,
    "take": lambda node, source: source.reshape(-1)[node.args[1]],
    "at": lambda _, source, position: _at(source, position),
    "join": lambda node, *sources: _joined(node, sources),
    "reduce": _reduced,
    "exported": lambda node, *under: node.value if _same(node.args, under) else np.full(node.shape, np.nan),
    **{op: (lambda _, *args, f=f: f(*args)) for op, f in ELEMENTWISE.items()},
}


def _joined(node: Node, sources: tuple[Values, ...]) -> Any:
    _, which, inside = node.args
    starts = np.cumsum([0, *(source.size for source in sources)])[:-1]
    flat: Values = np.concatenate([np.asarray(s).reshape(-1) for s in sources])
    return flat[starts[which] + inside]


def _same(nodes: Sequence[Node], now: Sequence[Values]) -> bool:
    """Whether quantities are what they are in the recording."""
    return all(np.array_equal(a, b.value, equal_nan=True) for a, b in zip(now, nodes, strict=True))


@np.errstate(all="ignore")
def numbers(wanted: Iterable[Node], given: Mapping[Node, Any]) -> dict[Node, Values]:
    """Numbers of nodes, where some are given; inputs that are not keep theirs, and what is found is solved again.

    NaN where a number of the worksheet's own run is not that of these inputs, and where no solution is found.
    """
    known: dict[Node, Values] = {node: np.asarray(value) for node, value in given.items()}
    solved: dict[Block, list[Values]] = {}
    for node in bottom_up(wanted, known):
        if node.op == "input":
            known[node] = node.value
        elif node.op == "found":
            block, number = node.args
            if block not in solved and not _same(block.under, [known[o] for o in block.under]):
                solved[block] = _again(block, known)
            known[node] = solved[block][number] if block in solved else node.value
        else:
            known[node] = np.asarray(_RULES[node.op](node, *(known[o] for o in node.operands)))
    return known


def _again(block: Block, known: Mapping[Node, Values]) -> list[Values]:
    """The unknowns of a solve block for other numbers of what it rests on, and the evaluations of its equations."""
    under = {node: known[node] for node in block.under}

    def residuals(x: Sequence[Values]) -> list[Values]:
        found = numbers(block.residuals, {**under, **dict(zip(block.nodes, x, strict=True))})
        return [found[node] for node in block.residuals]

    def of(*x: Values) -> list[Values]:
        """Residuals of values that stand on one more axis."""
        if block.elementwise or x[0].shape == block.nodes[0].shape:
            return residuals(x)
        each = [residuals(one) for one in zip(*x, strict=True)]
        return [np.stack(parts) for parts in zip(*each, strict=True)]

    starts = {name: tuple(known.get(n, n.value) for n in nodes) for name, nodes in block.starts.items()}
    with values_only():
        if block.single:
            lo, hi, guess = ((starts.get(name) or (None,))[0] for name in ("lo", "hi", "guess"))
            found = find(lambda x: of(x)[0], lo, hi, guess=guess)
            return [np.asarray(found.value if found.valued is not False else np.nan)]
        given: dict[str, Any] = {name: ends if len(ends) > 1 else ends[0] for name, ends in starts.items()}
        solution = solve(
            lambda **x: tuple(of(*x.values())), 0.0, block.unit, block.unknown_unit, given, least=block.least
        )
    values = solution.value if solution.valued is not False else [np.nan] * len(block.nodes)
    return [np.asarray(v) for v in (*values, solution.evaluations)]
