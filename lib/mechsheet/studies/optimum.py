"""Whether the conditions of an optimum hold at a design, to the first and to the second order.

To the first order the slopes of what holds the design balance that of the goal, by factors that are not negative. To
the second order the goal and all that holds it, by these factors, must bend downwards along every way left free: where
they do, the design is better than any near it (J. Nocedal and S. Wright, Numerical Optimization, 12.5).
"""

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mechsheet.worksheet import numbers
from mechsheet.worksheet.ties import greatest

Array = NDArray[np.float64]

WORSE = "each one near it is worse"  # what is said ends so where that is known
_HOLDS = 1e-6  # of what the goal varies by over the bounds: what may be left of its slope at an optimum, or of a bend
_ROUNDING = 1e-12  # of the slope of the goal
_ACTIVE = 1e-6  # of its size: a constraint that has less reserve holds the design


class At(NamedTuple):
    """All reserves at a design, each in parts of its size, and their slopes by the parts of the ranges.

    Those of the goal are what is above its start, in parts of what it varies by. ``bends`` are second slopes of all
    reserves along directions, a row for each direction, NaN where they are not known.
    """

    reserves: Array
    slopes: Array
    goals: NDArray[np.bool_]  # those from which the variable of the goal is taken
    names: Sequence[str]
    bends: Callable[[Array], Array]


def conditions(here: At, part: Array, names: Sequence[str]) -> str:
    """Whether they hold at a design with these parts of the ranges of its inputs, in words."""
    from scipy.optimize import nnls  # on use: takes longer than the rest of the package

    level = here.reserves[here.goals].min()
    above = here.reserves - here.goals * level
    holding = np.flatnonzero(above <= _ACTIVE * np.maximum(1.0, np.abs(here.reserves))).tolist()
    rows = [np.append(here.slopes[i], -1.0 * here.goals[i]) for i in holding]
    goals = [here.names[i] for i in holding if here.goals[i]]
    places = "the goal at {} positions" if len({*goals}) > 1 else "{} numbers of the goal"
    said = [places.format(len(goals))] if len(goals) > 1 else []
    said += dict.fromkeys(here.names[i] for i in holding if not here.goals[i])
    for i, x in enumerate(part):
        for end, way, word in ((0.0, 1.0, "lower"), (1.0, -1.0, "upper")):
            if abs(x - end) <= _ACTIVE:
                rows.append(np.append(way * np.eye(len(part))[i], 0.0))
                said.append(f"the {word} bound of {names[i]}")
    size = max(1.0, float(np.abs(here.slopes[here.goals]).max()))  # slopes beside which 1 is lost to rounding
    sizes = np.array([size if row[-1] else float(np.linalg.norm(row)) or 1.0 for row in rows])
    balance = np.array([np.append(row[:-1] / own, row[-1]) for row, own in zip(rows, sizes, strict=True)]).T
    factors, _ = nnls(balance, np.append(np.zeros(len(part)), -1.0))
    *rest, whole = balance @ factors  # of factors of the goal that are one in all there is this part
    left = max(float(np.linalg.norm(rest) / -whole) - _ROUNDING, 0.0) * size
    factors *= size / sizes
    held = f", held by {', '.join(said)}" if said else ""
    if left > _HOLDS:
        slope = f"a slope of {numbers.significant(left, 2)} of what the goal varies by within the bounds is left"
        return f"the conditions of an optimum do not hold: {slope}{held}"
    beside = np.array(rows) * np.append(np.ones(len(part)), size)  # the goal's variable in numbers of the slopes' size
    better, second = _second(here, holding, beside, factors / -whole, names)
    if better:
        return f"the conditions of an optimum hold to the first order alone{held}: {second}"
    return f"the conditions of an optimum hold{held}: to the first order none near it is better; {second}"


def _second(here: At, holding: Sequence[int], rows: Array, factors: Array, names: Sequence[str]) -> tuple[bool, str]:
    """Whether designs near one are better to the second order, and what is known of them, in words.

    The goal falls to the first order along a way that leaves what holds it by a factor: all other ways are free.
    """
    bare, free = _ways(rows[factors > _HOLDS]), _ways(rows)
    if not bare.size:
        return False, f"what holds it leaves no way free, so that {WORSE}"
    count = len(names)
    pairs = [(i, j) for i in range(count) for j in range(i, count)]
    units = np.eye(count)
    bends = here.bends(np.array([units[i] if i == j else units[i] + units[j] for i, j in pairs]))
    held = [(i, factor) for i, factor in zip(holding, factors, strict=False) if factor > _HOLDS]
    for i, _ in held:
        if np.isnan(bends[:, i]).any():
            return False, f"to the second order nothing is known, for {here.names[i]} has no second slope there"
    bend = dict(zip(pairs, sum(factor * bends[:, i] for i, factor in held), strict=True))
    H = np.diag([bend[i, i] for i in range(count)])
    for i, j in pairs:
        if i < j:
            H[i, j] = H[j, i] = (bend[i, j] - bend[i, i] - bend[j, j]) / 2
    most, way = _most(bare, H)
    if most < -_HOLDS:
        return False, f"to the second order {WORSE}"
    if free.size:
        most, way = _most(free, H)
    moved = {x: d for x, d in zip(names, way * np.sign(way[greatest(np.abs(way))]), strict=True) if abs(d) > 0.01}
    several = ", ".join(f"{x} by {numbers.significant(d, 2)}" for x, d in moved.items())
    along = f"{several} of the ranges" if len(moved) > 1 else "".join(moved)
    better = bool(free.size) and most > _HOLDS
    return better, f"to the second order it {'gets better' if better else 'is level'} along {along}"


def _ways(rows: Array) -> Array:
    """Orthonormal ways of the inputs, columns, along which rows of slopes by these and by the goal do not change."""
    lengths = np.linalg.norm(rows, axis=1, keepdims=True)
    _, sizes, across = np.linalg.svd(rows / np.where(lengths == 0, 1.0, lengths))
    rank = int(np.count_nonzero(sizes > _HOLDS))
    level = across[rank:, :-1].T
    return np.asarray(np.linalg.qr(level)[0]) if level.size else level


def _most(ways: Array, H: Array) -> tuple[float, Any]:
    """By how much something bends upwards at most along some ways, and along which."""
    sizes, turned = np.linalg.eigh(ways.T @ H @ ways)
    return float(sizes[-1]), ways @ turned[:, -1]
