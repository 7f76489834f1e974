"""Whether an equation has one root alone in the interval searched, proved by subdivision in balls.

A part of the interval has no root where the ball of the residual keeps away from 0 or is proved to be no number, or
where the slope keeps away from 0 and the residual has one sign at both ends. The other parts are halved, down to a
billionth of the interval: what is left then, as beside a dead centre, is not excluded and is told.
"""

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from flint import arb, arb_mat

from mechsheet.quantities.node import Block, Node
from mechsheet.quantities.operations import Values
from mechsheet.readers.ball_rules import NONE
from mechsheet.readers.balls import Balls, krawczyk, tangents

_FINEST = 2.0**-30  # of the interval
_MOST = 2000  # parts


class Part(NamedTuple):
    """An interval in which a further root is not excluded."""

    low: float
    high: float


def others(block: Block, under: Mapping[Node, Values], root: Any, low: Any, high: Any) -> list[Part] | None:
    """Parts of an interval in which a further root than this one is not excluded; None where too many are left."""
    low, high = low.lower(), high.upper()
    finest = (high - low) * _FINEST
    own = _widest(block, under, root, high - low)
    parts = [(a, b) for a, b in ((low, own.lower()), (own.upper(), high)) if a < b]
    left, count = list[Part](), 0
    while parts:
        count += len(parts)
        if count > _MOST:
            return None
        open_ = [part for part, out in zip(parts, _excluded(block, under, parts), strict=True) if not out]
        parts = []
        for a, b in open_:
            if b - a < finest:
                left.append(Part(float(a.lower()), float(b.upper())))
            else:
                middle = ((a + b) / 2).mid()
                parts += [(a, middle), (middle, b)]
    return _joined(sorted(left))


def _residuals(block: Block, under: Mapping[Node, Values], x: Sequence[Any]) -> tuple[list[Any], Balls]:
    """Residual of each of some balls of the unknown, and their evaluation."""
    array = np.empty(len(x), object)
    array[:] = x
    balls = Balls({**under, block.nodes[0]: array})
    (residual,) = balls.of(block.residuals)
    return list(np.broadcast_to(residual, array.shape)), balls


def _evaluated(block: Block, under: Mapping[Node, Values], x: Sequence[Any]) -> tuple[list[Any], list[Any]]:
    """Residual and slope of each of some balls of the unknown."""
    residuals, balls = _residuals(block, under, x)
    return residuals, [J[0, 0] for J in tangents(balls, block)]


def _widest(block: Block, under: Mapping[Node, Values], root: Any, size: Any) -> Any:
    """The widest box about a root, of those that are an eighth of each other, that holds no other."""
    at = root.mid()
    widths = [(size / 2**k).upper() for k in range(2, 40, 3)]
    boxes = [at + arb(0, w) for w in widths]
    residual, _ = _residuals(block, under, [at])
    for box, slope in zip(boxes, _evaluated(block, under, boxes)[1], strict=True):
        if slope.is_finite() and krawczyk([at], [box], residual, arb_mat(1, 1, [slope])) is not None:
            return box
    return root


def _excluded(block: Block, under: Mapping[Node, Values], parts: Sequence[tuple[Any, Any]]) -> list[bool]:
    hulls = [a.union(b) for a, b in parts]
    out = [f is NONE or bool(f > 0 or f < 0) for f in _residuals(block, under, hulls)[0]]
    if open_ := [k for k, excluded in enumerate(out) if not excluded]:
        _, slopes = _evaluated(block, under, [hulls[k] for k in open_])
        lows, highs = (_residuals(block, under, [parts[k][end] for k in open_])[0] for end in (0, 1))
        for k, slope, a, b in zip(open_, slopes, lows, highs, strict=True):
            one_sign = NONE not in (a, b) and bool((a > 0 and b > 0) or (a < 0 and b < 0))
            out[k] = one_sign and bool(slope > 0 or slope < 0)
    return out


def _joined(parts: Sequence[Part]) -> list[Part]:
    """Neighbours as one."""
    found = list[Part]()
    for part in parts:
        if found and part.low <= found[-1].high:
            found[-1] = Part(found[-1].low, max(part.high, found[-1].high))
        else:
            found.append(part)
    return found
