"""A design refined by the slopes of its worksheet: a bounded method, every position a constraint of its own.

The least of several numbers has corners, so it is a variable of its own below each of them, which is made greatest.
"""

from collections.abc import Iterator, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any, NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from mechsheet import units
from mechsheet.quantities.node import Node
from mechsheet.readers.bends import bends
from mechsheet.readers.slopes import slopes
from mechsheet.recording.record import record
from mechsheet.run.banding import part_of
from mechsheet.run.silent import silently
from mechsheet.studies.optimum import At, conditions
from mechsheet.worksheet import inputs as declarations
from mechsheet.worksheet import mistakes
from mechsheet.worksheet.cells import base, load
from mechsheet.worksheet.errors import SheetError

Array = NDArray[np.float64]

_KEPT = 1e-9  # of a limit: reserve of each requirement, so that rounding breaks none
_STEPS = 60
_REGIONS = 1.0, 0.1, 0.01, 0.001  # of the ranges, how far off the start a better one is looked for
_SAMPLES, _SEED = 32, 1  # designs all over the bounds that tell what the goal varies by


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
    computed: list[str]
    bounds: dict[str, tuple[float, float]]
    limits: Any

    def judge(self, variants: dict[str, Array], /) -> Any: ...


class _Goal(NamedTuple):
    """The goal of a design, and what that of others is mostly off it by: its reserves are counted from it, in these.

    The same for all designs, so that reserves and slopes change only where the goal does; so are the ``sizes`` of the
    requirements, in which theirs are counted.
    """

    start: float
    varies: float
    sizes: list[float]


class Slopes:
    """The slopes of a problem near a design, with its inputs in display units.

    All of it raises SheetError where a design on the way has no value, or the slopes of a result are not known.
    """

    def __init__(self, problem: Problem, start: Mapping[str, float]) -> None:
        self._problem, self._start, self._goal = problem, start, _goal(problem, start)
        self._low, self._high = np.array([problem.bounds[x] for x in start]).T
        self._known = dict[bytes, At]()

    def _parts(self, design: Mapping[str, float]) -> Array:
        """A design by the parts of the ranges."""
        own = np.array([design[x] for x in self._start])
        return np.asarray(np.clip((own - self._low) / (self._high - self._low), 0.0, 1.0))

    def _design(self, parts: Array) -> dict[str, float]:
        own = self._low + parts * (self._high - self._low)  # by rounding beyond a bound
        return dict(zip(self._start, np.clip(own, self._low, self._high).tolist(), strict=True))

    def _at(self, parts: Array) -> At:
        key = parts.tobytes()
        if key not in self._known:
            self._known[key] = _evaluated(self._problem, self._design(parts), self._goal)
        return self._known[key]

    def refined(self) -> dict[str, float]:
        """A design near the start that is better, as far as slopes lead to one: if need be where all have a value."""
        first = self._parts(self._start)
        here = self._at(first)
        for part in _REGIONS:
            try:
                return self._refined(first, here, part)
            except SheetError as error:
                lost = error
        raise lost

    def _refined(self, first: Array, here: At, part: float) -> dict[str, float]:
        """A better design no farther off the start than a part of the ranges."""
        from scipy.optimize import Bounds, minimize  # on use: takes longer than the rest of the package

        def at(z: Array) -> At:
            return self._at(np.clip(z[:-1], 0.0, 1.0))

        def reserve(z: Array) -> Array:
            here = at(z)
            return here.reserves - np.where(here.goals, z[-1], _KEPT)

        def slope(z: Array) -> Array:
            here = at(z)
            return np.column_stack([here.slopes, -1.0 * here.goals])

        down = np.append(np.zeros(len(first)), -1.0)
        lower, upper = np.maximum(first - part, 0.0), np.minimum(first + part, 1.0)
        method: Any = minimize  # its stubs refuse a start of a known length beside slopes that have none
        found = method(
            lambda z: float(-z[-1]),
            np.append(first, here.reserves[here.goals].min()),
            jac=lambda _: down,
            bounds=Bounds(np.append(lower, -np.inf), np.append(upper, np.inf)),
            constraints=[{"type": "ineq", "fun": reserve, "jac": slope}],
            method="SLSQP",
            options={"maxiter": _STEPS, "ftol": 1e-14},
        )
        return self._design(np.clip(found.x[:-1], 0.0, 1.0))

    def conditions(self, design: Mapping[str, float]) -> str:
        """Whether the conditions of an optimum hold at a design, and what holds it."""
        parts = self._parts(design)
        return conditions(self._at(parts), parts, list(self._start))


def _goal(problem: Problem, start: Mapping[str, float]) -> _Goal:
    """The goal at the start, and its scale: the median of how far that of designs all over the bounds is off it.

    The size of a requirement is its limit, or if that is 0 the median of its reserves there.
    """
    random, variants = np.random.default_rng(_SEED), dict[str, Array]()
    for x, (low, high) in problem.bounds.items():
        spread = low + (high - low) * (random.permutation(_SAMPLES) + 0.5) / _SAMPLES
        variants[x] = np.append(start[x], spread)
    judged = problem.judge(variants)
    own, others = float(judged.goal[0]), judged.goal[1:]
    sizes = [abs(need.limit) or (problem.asked.best and _median(need.reserve)) or 1.0 for need in judged.requirements]
    return _Goal(own, _median(others - own) or abs(own) or 1.0, sizes)


def _median(sizes: Array) -> float:
    """Of numbers as far as there are any, by their magnitudes."""
    known = np.abs(sizes[np.isfinite(sizes)])
    return float(np.median(known)) if known.size else 0.0


def _evaluated(problem: Problem, design: Mapping[str, float], goal: _Goal) -> At:
    """Reserves of a design and their slopes, from one run and its recording.

    Raises SheetError where the design has no value, or a slope that is needed is not known.
    """
    sheet, asked = load(Path(problem.worksheet)), problem.asked
    g: Any = declarations.build(sheet.inputs, {**asked.scene.inputs, **design})
    only = replace(sheet, cells=tuple(sheet.needed(problem.computed, ["g"])))
    try:
        with silently():
            recording = record(only.run(only.results, {"g": g}), only, whole=True, every=1)
    except Exception as error:  # of a line, as of a division by an input that is 0 at a bound
        raise SheetError(mistakes.reason(error, sheet.path)) from None
    nodes = {name: node for name in asked.results if (node := part_of(name, recording.values))}
    nodes |= {name: recording.inputs[name] for name in asked.results if base(name) not in problem.computed}
    if missing := [name for name in asked.results if name not in nodes]:
        raise SheetError(f"{missing[0]} is not recorded")
    by = [recording.inputs[x] for x in design]
    parts = {(name, way): [*_each(node, way)] for name, node in nodes.items() for way in (1.0, -1.0)}
    every = dict.fromkeys(node for each in parts.values() for node, _ in each)
    found = slopes([*nodes.values(), *every], by)
    ranges = np.array([(b - a) * units.parse(problem.fields[x].unit).factor for x, (a, b) in problem.bounds.items()])
    reserves, slants, goals, labels = list[Array](), list[Array](), list[bool](), list[str]()
    places = list[tuple[Node, int, float]]()

    def add(name: str, sign: float, limit: float, size: float, is_goal: bool, text: str, end: str = "") -> None:
        if np.isnan(nodes[name].value).any():
            raise SheetError(f"a design on the way to a better one has no {name}")
        alone = (end == "max" and sign > 0) or (end == "min" and sign < 0)  # at one position: that which is the end
        off, part = (goal.start, size * goal.varies) if is_goal else (0.0, size)
        for node, way in [(nodes[name], 1.0)] if alone else parts[name, sign]:
            values, ahead = way * node.value.reshape(-1), way * found[node].both
            slant = ahead.reshape(len(ranges), -1).T * ranges
            if np.isnan(slant).any():
                raise SheetError(f"{name} has no slope at {text}")
            keep = range(values.size)
            if alone:
                keep = range(k := int(np.argmax(sign * values)), k + 1)
            for k in keep:
                reserves.append(np.array([(sign * (values[k] - limit) - off * size) / part]))
                slants.append(sign * slant[k : k + 1] / part)
                goals.append(is_goal)
                places.append((node, k, sign * way / part))
                labels.append(text + (f" at position {k}" if nodes[name].size > 1 else ""))

    for need, size in zip(asked.needs, goal.sizes, strict=True):
        sign = 1.0 if need.sign == ">=" else -1.0
        add(need.name, sign, problem.limits[need], size, not asked.best, need.text, need.end)
    if asked.best:
        way, name = asked.best
        add(name, 1.0 if way == "max" else -1.0, 0.0, 1.0, True, f"{way} {name}")

    def bent(directions: Array) -> Array:
        seconds = bends(every, by, directions * ranges)
        return np.stack([x * seconds[node].reshape(len(directions), -1)[:, k] for node, k, x in places], axis=1)

    return At(np.concatenate(reserves), np.concatenate(slants), np.array(goals), labels, bent)


def _each(node: Node, sign: float) -> Iterator[tuple[Node, float]]:
    """The numbers of which one that must be small is the greatest, or one that must be great the least, by their signs.

    Each of them is smooth where that has a corner.
    """
    extreme = "min" if sign > 0 else "max"
    if node.op == extreme and all(x.shape == node.shape for x in node.operands):
        for x in node.operands:
            yield from _each(x, sign)
    elif node.op == "reduce" and node.args[2] == extreme and node.args[3].axis is None:
        yield from _each(node.operands[0], sign)
    elif node.op == "abs" and sign < 0:
        yield from ((node.operands[0], 1.0), (node.operands[0], -1.0))
    else:
        yield node, 1.0
