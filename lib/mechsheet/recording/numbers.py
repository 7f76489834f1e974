"""Numbers of a recording for other inputs: numpy as one reader, and the reference for the others."""

from collections.abc import Callable, Iterable, Mapping
from typing import Any

import numpy as np

from mechsheet.recording.graph import ELEMENTWISE, REDUCE, Node, Values, bottom_up


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
    "exported": lambda node, *under: node.value if _same(node, under) else np.full(node.shape, np.nan),
    **{op: (lambda _, *args, f=f: f(*args)) for op, f in ELEMENTWISE.items()},
}


def _joined(node: Node, sources: tuple[Values, ...]) -> Any:
    _, which, inside = node.args
    starts = np.cumsum([0, *(source.size for source in sources)])[:-1]
    flat: Values = np.concatenate([np.asarray(s).reshape(-1) for s in sources])
    return flat[starts[which] + inside]


def _same(node: Node, under: tuple[Values, ...]) -> bool:
    return all(np.array_equal(a, b.value) for a, b in zip(under, node.args, strict=True))


@np.errstate(all="ignore")
def numbers(wanted: Iterable[Node], given: Mapping[Node, Any]) -> dict[Node, Values]:
    """Numbers of nodes, where inputs and found values are the ones given; the others keep theirs.

    NaN where a number of the worksheet's own run is not that of these inputs.
    """
    known: dict[Node, Values] = {node: np.asarray(value) for node, value in given.items()}
    for node in bottom_up(wanted, known):
        if node.op in ("input", "found"):
            known[node] = node.value
        else:
            known[node] = np.asarray(_RULES[node.op](node, *(known[o] for o in node.operands)))
    return known
