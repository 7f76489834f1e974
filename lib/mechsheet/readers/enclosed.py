"""Guaranteed bounds of a recording's quantities where inputs lie anywhere within their tolerances, by balls."""

from collections.abc import Iterable, Mapping

import numpy as np
from flint import arb

from mechsheet.quantities.node import Node
from mechsheet.quantities.operations import Values
from mechsheet.readers.balls import Balls, precision

_BITS = 128


def enclosed(wanted: Iterable[Node], within: Mapping[Node, float]) -> dict[Node, tuple[Values, Values]]:
    """Least and greatest values of quantities, in their shapes, for inputs within ``within`` of their own values.

    NaN where the balls say nothing: they forget that two quantities rest on the same input, and grow the wider.
    """
    wanted = list(wanted)
    with precision(_BITS):
        given = {node: np.array(arb(float(node.value), size), object) for node, size in within.items()}
        balls = dict(zip(wanted, Balls(given).of(wanted), strict=True))
        return {node: (_ends(x, "lower", -np.inf), _ends(x, "upper", np.inf)) for node, x in balls.items()}


def _ends(balls: Values, end: str, way: float) -> Values:
    """Ends of balls as floats that are these or beyond them."""

    def outside(x: arb) -> float:
        near = float(x)
        return near if arb(near) == x else float(np.nextafter(near, way))

    known = (outside(getattr(x, end)()) if isinstance(x, arb) and x.is_finite() else np.nan for x in balls.flat)
    return np.fromiter(known, float, balls.size).reshape(balls.shape)
