"""Slopes on either side of where a formula goes another way, such as from one piece of a table to the next."""

from collections.abc import Iterable, Mapping, Sequence

import numpy as np

from mechsheet.quantities.node import Node
from mechsheet.quantities.operations import Values
from mechsheet.readers.numbers import numbers
from mechsheet.readers.slopes import Slope, slopes, solved_under
from mechsheet.worksheet.errors import SheetError

_OFF = 2.0**-26  # of an input: how far beside it is looked
_SMOOTH = 2.0**-16  # of a slope: what differs by less from that on the other side does by being beside
_BENT = 2.0**-10  # of what a slope makes of that: more is a jump
_EPS = float(np.finfo(float).eps)
_ROUNDINGS = 64


@np.errstate(invalid="ignore")
def beside(found: Mapping[Node, Slope], by: Sequence[Node]) -> dict[Node, Slope]:
    """Slopes by single numbers, with those a little beside them on a side that has none, but where it jumps there."""
    whole = dict(found)
    for k, x in enumerate(by):
        for sign in (1, -1):
            lost = [node for node in whole if np.any(np.isnan(whole[node][sign < 0][k]) & np.isfinite(node.value))]
            for node, slope in _there(lost, x, sign).items():
                sides = [side.copy() for side in whole[node]]
                own, other = sides[sign < 0][k], sides[sign > 0][k]
                smooth = np.abs(slope - other) <= _SMOOTH * np.abs(other)
                sides[sign < 0][k] = np.where(np.isnan(own), np.where(smooth, other, slope), own)
                whole[node] = Slope(*sides)
    return whole


def _there(wanted: Iterable[Node], x: Node, sign: int) -> dict[Node, Values]:
    """Slopes of quantities a little beside a number, NaN where they are others there."""
    wanted, found = list(wanted), dict[Node, Values]()
    if not wanted:
        return found
    step = sign * _OFF * (abs(x.value.item()) or 1.0)
    try:
        known = numbers([*wanted, *solved_under(wanted)], {x: x.value + step})
    except SheetError:  # there is none to be found there
        return found
    seen = slopes(wanted, [x], known)
    for node in wanted:
        slope = seen[node][0 if sign > 0 else 1][0]
        off = np.abs(known[node] - node.value - slope * step)
        same = off <= _BENT * np.abs(slope * step) + _ROUNDINGS * _EPS * np.abs(node.value)
        found[node] = np.where(same, slope, np.nan)
    return found
