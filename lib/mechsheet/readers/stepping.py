"""What moves by steps too small to see, as what a bisection ends with: its slopes say that it keeps still."""

from collections.abc import Mapping, Sequence

import numpy as np

from mechsheet.quantities.node import Node
from mechsheet.quantities.operations import Values
from mechsheet.readers.jumps import jumps
from mechsheet.readers.numbers import numbers
from mechsheet.readers.slopes import Slope
from mechsheet.worksheet.errors import OF_NUMBERS

_NEAR = 1e-6  # of an input: so near it is a line that goes another way
_STEP = 2.0**-12  # of one: how far on either side it is looked how much a quantity moves
_BENT = 0.02  # of that: by more the sides differ at a corner alone
_OTHER = 0.1  # of it: what differs by more from a slope is another one
_ROUNDING = 1e-9  # of the greatest number


def stepping(found: Mapping[Node, Slope], by: Sequence[Node]) -> dict[Node, int]:
    """Quantities that move by as much on either side of some inputs, and not by their slopes; each with its line."""
    sizes = [abs(x.value.item()) or 1.0 for x in by]
    jumping = jumps(found, by, [_NEAR * size for size in sizes])
    stepped = dict[Node, int]()
    for k, (x, size) in enumerate(zip(by, sizes, strict=True) if jumping else ()):
        step = _STEP * size
        try:
            ahead, behind = (numbers(jumping, {x: x.value + off}) for off in (step, -step))
        except OF_NUMBERS:  # it has no numbers on one side
            continue
        for node, jump in jumping.items():
            sides = (ahead[node] - node.value) / step, (node.value - behind[node]) / step
            if _is_stepping(found[node].both[k], *sides, _ROUNDING * np.max(np.abs(node.value), initial=0.0) / step):
                stepped[node] = jump.line
    return stepped


@np.errstate(invalid="ignore")
def _is_stepping(slope: Values, ahead: Values, behind: Values, rounding: float) -> bool:
    middle = (ahead + behind) / 2
    smooth = np.abs(ahead - behind) <= _BENT * np.abs(middle)
    return bool(np.any(smooth & (np.abs(middle - slope) > _OTHER * np.abs(middle) + rounding)))  # of none nobody knows
