"""A design refined by the slopes of its worksheet: a bounded method, every position a constraint of its own.

The least of several numbers has corners, so it is a variable of its own below each of them, which is made greatest.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from mechsheet import units
from mechsheet.recording.record import record
from mechsheet.recording.slopes import slopes
from mechsheet.run.banding import part_of
from mechsheet.worksheet import inputs as declarations
from mechsheet.worksheet import numbers
from mechsheet.worksheet.cells import base, load
from mechsheet.worksheet.errors import SheetError

Array = NDArray[np.float64]

_KEPT = 1e-9  # of a limit: reserve of each requirement, so that rounding breaks none
_HOLDS = 1e-6  # of the slope of the goal: what may be left of the conditions of an optimum
_ACTIVE = 1e-6  # of its size: a constraint that has less reserve holds the design
_STEPS = 60


class Asked(Protocol):
    """What is asked: results, requirements and goal."""

    needs: Any
    best: Any
    scene: Any

    @property
    def results(self) -> list[str]: ...


class Problem(Protocol):
    """A worksheet with what is asked of it, bounds in display units and limits in SI."""

    worksheet: Any
    asked: Any
    fields: Any
    bounds: dict[str, tuple[float, float]]
    limits: Any


class _At(NamedTuple):
    """All reserves at a design, each in parts of its size, and their slopes by the parts of the ranges."""

    reserves: Array
    slopes: Array
    goals: NDArray[np.bool_]  # those from which the variable of the goal is taken
    names: Sequence[str]


def refined(problem: Problem, start: Mapping[str, float]) -> tuple[dict[str, float], str]:
    """A better design near one, inputs in display units, and whether the conditions of an optimum hold there.

    The start itself where the slopes of a result are not known, which is said.
    """
    from scipy.optimize import Bounds, minimize  # on use: takes longer than the rest of the package

    names = list(start)
    low, high = np.array([problem.bounds[x] for x in names]).T
    known = dict[bytes, _At]()

    def at(z: Array) -> _At:
        part = np.clip(z[:-1], 0.0, 1.0)
        if part.tobytes() not in known:
            known[part.tobytes()] = _evaluated(problem, dict(zip(names, low + part * (high - low), strict=True)))
        return known[part.tobytes()]

    def reserve(z: Array) -> Array:
        here = at(z)
        return here.reserves - np.where(here.goals, z[-1], _KEPT)

    def slope(z: Array) -> Array:
        here = at(z)
        return np.column_stack([here.slopes, -1.0 * here.goals])

    first = np.clip((np.array([start[x] for x in names]) - low) / (high - low), 0.0, 1.0)
    try:
        here = at(np.append(first, 0.0))
        z = np.append(first, here.reserves[here.goals].min())
        down = np.append(np.zeros(len(names)), -1.0)
        ends = np.append(np.ones(len(names)), np.inf)
        method: Any = minimize  # its stubs refuse a start of a known length beside slopes that have none
        found = method(
            lambda z: float(-z[-1]),
            z,
            jac=lambda _: down,
            bounds=Bounds(np.where(np.isfinite(ends), 0.0, -np.inf), ends),
            constraints=[{"type": "ineq", "fun": reserve, "jac": slope}],
            method="SLSQP",
            options={"maxiter": _STEPS, "ftol": 1e-14},
        )
        part = np.clip(found.x[:-1], 0.0, 1.0)
        told = _conditions(at(found.x), part, names)
    except SheetError as error:
        return dict(start), f"not refined by slopes: {error}"
    return {x: float(v) for x, v in zip(names, low + part * (high - low), strict=True)}, told


def _evaluated(problem: Problem, design: Mapping[str, float]) -> _At:
    """Reserves of a design and their slopes, from one run and its recording.

    Raises SheetError where the design has no value, or a slope that is needed is not known.
    """
    sheet, asked = load(Path(problem.worksheet)), problem.asked
    g: Any = declarations.build(sheet.inputs, {**asked.scene.inputs, **design})
    only = replace(sheet, cells=tuple(sheet.needed([base(name) for name in asked.results], ["g"])))
    recording = record(only.run(only.results, {"g": g}), only, whole=True, every=1)
    nodes = {name: node for name in asked.results if (node := part_of(name, recording.values))}
    if missing := [name for name in asked.results if name not in nodes]:
        raise SheetError(f"{missing[0]} is not recorded")
    found = slopes(nodes.values(), [recording.inputs[x] for x in design])
    ranges = np.array([(b - a) * units.parse(problem.fields[x].unit).factor for x, (a, b) in problem.bounds.items()])
    reserves, slants, goals, labels = list[Array](), list[Array](), list[bool](), list[str]()

    def add(name: str, sign: float, limit: float, size: float, is_goal: bool, text: str, end: str = "") -> None:
        values, ahead = nodes[name].value.reshape(-1), found[nodes[name]].both
        slant = ahead.reshape(len(ranges), -1).T * ranges
        if np.isnan(values).any() or np.isnan(slant).any():
            raise SheetError(f"{name} has no slope at {text}")
        keep = range(values.size)
        if (end == "max" and sign > 0) or (end == "min" and sign < 0):  # at one position alone: that which is the end
            keep = range(k := int(np.argmax(sign * values)), k + 1)
        for k in keep:
            reserves.append(np.array([sign * (values[k] - limit) / size]))
            slants.append(sign * slant[k : k + 1] / size)
            goals.append(is_goal)
            labels.append(text + (f" at position {k}" if values.size > 1 else ""))

    for need in asked.needs:
        limit = problem.limits[need]
        sign, size = (1.0 if need.sign == ">=" else -1.0), abs(limit) or 1.0
        add(need.name, sign, limit, size, not asked.best, need.text, need.end)
    if asked.best:
        way, name = asked.best
        size = float(np.max(np.abs(nodes[name].value))) or 1.0
        size = 10.0 ** np.floor(np.log10(size))  # the same for designs near each other
        add(name, 1.0 if way == "max" else -1.0, 0.0, size, True, f"{way} {name}")
    return _At(np.concatenate(reserves), np.concatenate(slants), np.array(goals), labels)


def _conditions(here: _At, part: Array, names: Sequence[str]) -> str:
    """Whether the slopes of what holds a design balance that of the goal, by factors that are not negative."""
    from scipy.optimize import nnls  # on use: as above

    level = here.reserves[here.goals].min()
    left = here.reserves - here.goals * level
    holding = np.flatnonzero(left <= _ACTIVE * np.maximum(1.0, np.abs(here.reserves))).tolist()
    rows = [np.append(here.slopes[i], -1.0 * here.goals[i]) for i in holding]
    said = [here.names[i] for i in holding if not here.goals[i]]
    for i, x in enumerate(part):
        for end, way, word in ((0.0, 1.0, "lower"), (1.0, -1.0, "upper")):
            if abs(x - end) <= _ACTIVE:
                rows.append(np.append(way * np.eye(len(part))[i], 0.0))
                said.append(f"the {word} bound of {names[i]}")
    target = np.append(np.zeros(len(part)), -1.0)
    _, rest = nnls(np.array(rows).T, target)
    held = f", held by {', '.join(said)}" if said else ""
    if rest <= _HOLDS:
        return f"the conditions of an optimum hold{held}: none near it is better"
    return f"the conditions of an optimum do not hold: {numbers.significant(rest, 2)} of the goal's slope is left{held}"
