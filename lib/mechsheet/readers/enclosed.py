"""Guaranteed bounds of a recording's quantities where inputs lie anywhere within their tolerances, by balls."""

from collections.abc import Iterable, Mapping, Sequence
from itertools import chain
from types import MappingProxyType

import numpy as np
from flint import arb

from mechsheet.quantities.node import Node
from mechsheet.quantities.operations import Values
from mechsheet.readers.balls import Balls, precision

_BITS = 128


def enclosed(
    wanted: Iterable[Node], within: Mapping[Node, float], resting: Mapping[Node, Sequence[Node]] = MappingProxyType({})
) -> dict[Node, tuple[Values, Values]]:
    """Least and greatest values of quantities, in their shapes, for inputs within ``within`` of their own values.

    NaN where the balls say nothing: they forget that two quantities rest on the same input, and grow the wider. So it
    is of one ``resting`` on conditions, where any of these may not hold.
    """
    wanted, conditions = list(wanted), list(chain.from_iterable(resting.values()))
    with precision(_BITS):
        given = {node: np.array(arb(float(node.value), size), object) for node, size in within.items()}
        every = [*wanted, *conditions]
        balls = dict(zip(every, Balls(given).of(every), strict=True))
        found = {node: (_ends(balls[node], "lower", -np.inf), _ends(balls[node], "upper", np.inf)) for node in wanted}
    for node in (node for node in wanted if node.value.dtype.kind in "iu"):
        found[node] = np.ceil(found[node][0]) + 0.0, np.floor(found[node][1]) + 0.0
    none = {node for node, holds in resting.items() if not all(np.all(balls[x] == 1.0) for x in holds)}
    return found | {node: (np.full(node.shape, np.nan), np.full(node.shape, np.nan)) for node in none}


def _ends(balls: Values, end: str, way: float) -> Values:
    """Ends of balls as floats that are these or beyond them."""

    def outside(x: arb) -> float:
        near = float(x)
        return near if arb(near) == x else float(np.nextafter(near, way))

    known = (outside(getattr(x, end)()) if isinstance(x, arb) and x.is_finite() else np.nan for x in balls.flat)
    return np.fromiter(known, float, balls.size).reshape(balls.shape)
