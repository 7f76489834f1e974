"""Design by search: inputs within bounds that meet all requirements and make a goal greatest, and the scene they make.

The search knows nothing of mechanisms: a worksheet says what a variant is worth, for many variants at once.
"""

import json
import sys
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from decimal import ROUND_CEILING, Context
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mechsheet import units
from mechsheet.run import arguments, report
from mechsheet.worksheet import numbers
from mechsheet.worksheet.check import Check
from mechsheet.worksheet.errors import SheetError, as_given
from mechsheet.worksheet.inputs import declared
from mechsheet.worksheet.kinds import Input
from mechsheet.worksheet.scene import Limit

Array = NDArray[np.float64]

_FAR = 1e60  # energies of variants that miss a requirement lie above those of all that hold them, in any unit
_INSIDE = 1 - 1e-12  # a start at a bound must not be outside by rounding; it is rounded back to it
_LOST = 1e150  # and of those that have no value above all others; its square is still a number
_ROUNDS, _REACH, _DECADES = 50, 0.1, 3  # of variants beside a design: how far off of the ranges, spread over what sizes
_KEPT = 1e-9  # of a limit: their reserve of each requirement, so that rounding breaks none


@dataclass(frozen=True, eq=False)
class Requirement:
    """A quantity of each variant, in SI, that must be at least ``limit``, or at most."""

    name: str
    values: Array
    limit: float
    unit: str
    at_least: bool = True

    @property
    def reserve(self) -> Array:
        """By how much it is kept, in SI; negative where it is missed."""
        return self.values - self.limit if self.at_least else self.limit - self.values

    @property
    def missed(self) -> Array:
        """By what part of its limit it is missed; 0 where it is kept."""
        return np.maximum(0.0, -self.reserve) / (abs(self.limit) or 1.0)

    def stricter(self, part: float) -> "Requirement":
        """The same with a limit that is stricter by a part of it."""
        return replace(self, limit=self.limit + (1 if self.at_least else -1) * part * abs(self.limit))

    def check(self) -> Check:
        """The requirement of a single variant."""
        factor = units.parse(self.unit).factor
        value, limit = float(self.values[0]) / factor, self.limit / factor
        return Check(self.name, value, limit, self.unit, at_least=self.at_least)

    def __str__(self) -> str:
        return f"required at {'least' if self.at_least else 'most'} {_text(self.limit, self.unit)}"


@dataclass(frozen=True, eq=False)
class Judged:
    """What variants are worth: their goal, which is to be greatest, their requirements, and why some have no value."""

    goal: Array
    requirements: tuple[Requirement, ...]
    reasons: NDArray[np.object_]


Judge = Callable[[dict[str, Array]], Judged]


@dataclass(frozen=True, eq=False)
class Design:
    """The best variant of a search: its inputs in display units, its goal and requirements, and the variants tried.

    ``uncertainty`` is how far below its goal those reach that hold all requirements in the last generation, and what a
    step of the last decimal of each input changes: as little as that the search has told designs apart, and another
    search may find as much more; two digits, rounded up. It is infinite where half of the last generation misses a
    requirement. An estimate, no bound: of a better place that no variant came near it knows nothing.
    """

    inputs: dict[str, float]
    goal: float
    requirements: tuple[Requirement, ...]
    tried: int
    uncertainty: float


def search(
    judge: Judge,
    bounds: Mapping[str, tuple[float, float]],
    decimals: Mapping[str, int],
    *,
    seed: int,
    generations: int,
    members: int,
    start: Mapping[str, float] | None = None,
    done: Callable[[], object] = lambda: None,
) -> Design:
    """Differential evolution: the inputs within their bounds that hold all requirements and have the greatest goal.

    Parameters
    ----------
    judge : callable
        Takes many variants, an array for each input in its display unit, and says what they are worth.
    bounds : mapping of str to pair of float
        Least and greatest value of each input, in its display unit.
    decimals : mapping of str to int
        To how many decimals inputs are rounded, so that the design can be made; what is promised holds for these.
    seed, generations, members : int
        The same seed gives the same design; a generation has about ``members`` variants for each input.
    start : mapping, optional
        A design from which the search sets out.
    done : callable
        Called after every generation.

    Raises
    ------
    SheetError
        Where no variant that was tried holds all requirements: the one that is missed most, what was reached, and what
        could be reached if it were the only one; or why none of them has a value.
    """
    if not bounds:
        raise SheetError("bounds = {} must have those of at least one input")
    if missing := sorted(bounds.keys() - decimals.keys()):
        raise SheetError(f"decimals = {as_given(dict(decimals))} must have those of {missing[0]}")
    for name, (low, high) in bounds.items():
        if not low <= high:
            ends = "..".join(numbers.significant(end, 6) for end in (low, high))
            raise SheetError(f"bounds of {name} = {ends} must be in order")
    evolved = partial(_evolved, bounds=bounds, decimals=decimals, seed=seed, generations=generations, members=members)
    best, judged, tried, last = evolved(judge, start=start, done=done)
    if judged.reasons[0]:
        raise SheetError(f"no design within the bounds has a value: {judged.reasons[0]}")
    worst = max(judged.requirements, key=lambda r: float(r.missed[0]), default=None)
    if worst is not None and worst.missed[0] > 0:
        raise SheetError(_infeasible(judge, worst.name, evolved, best))
    goal = float(judged.goal[0])
    uncertainty = _reach(last, goal) + _steps(judge, best, goal, bounds, decimals)
    two_digits = Context(prec=2, rounding=ROUND_CEILING).create_decimal_from_float(uncertainty)
    return Design(best, goal, judged.requirements, tried, float(two_digits))


def _reach(energies: Array, goal: float) -> float:
    """How far below the best goal those of a generation reach that hold all requirements."""
    goals = -energies[energies < _FAR / 2]
    return goal - float(goals.min()) if 2 * len(goals) > len(energies) else np.inf


def _steps(
    judge: Judge,
    best: Mapping[str, float],
    goal: float,
    bounds: Mapping[str, tuple[float, float]],
    decimals: Mapping[str, int],
) -> float:
    """What a step of the last decimal of each input changes the goal by, in all, where requirements hold."""
    steps = np.diag([10.0 ** -decimals[x] for x in best])
    moved = np.array([*best.values()])[:, None] + np.hstack([steps, -steps])
    near = judge({x: np.clip(values, *bounds[x]) for x, values in zip(best, moved, strict=True)})
    there = (near.reasons == "") & (_missed(near) == 0)
    return float(np.where(there, abs(near.goal - goal), 0.0).reshape(2, -1).max(axis=0).sum())


def energies(judged: Judged) -> Array:
    """The less, the better: minus the goal of variants that hold all requirements, below those of all others."""
    missed = _missed(judged)
    value = np.where(missed > 0, _FAR * (1 + missed), -judged.goal)
    return np.where((judged.reasons != "") | np.isnan(value), _LOST, value)


def _missed(judged: Judged) -> Array:
    """By what parts of their limits the requirements are missed, in all."""
    return sum((r.missed for r in judged.requirements), np.zeros(len(judged.goal)))


def _infeasible(judge: Judge, name: str, evolved: Callable[..., Any], nearest: Mapping[str, float]) -> str:
    """Which requirement is missed most, and what it reaches alone; ``evolved`` is the search with its bounds."""

    def one(judged: Judged) -> Requirement:
        return next(r for r in judged.requirements if r.name == name)

    def alone(variants: dict[str, Array]) -> Judged:
        judged = judge(variants)
        return Judged(one(judged).reserve, (), judged.reasons)

    there = one(judge({x: np.array([v]) for x, v in nearest.items()}))
    best, *_ = evolved(alone, start=nearest, done=lambda: None)
    reached = one(judge({x: np.array([v]) for x, v in best.items()}))
    best_text, near_text = (_text(r.values[0], r.unit) for r in (reached, there))
    if reached.missed[0] > 0:
        return f"no design within the bounds: {name}: best reachable {best_text}, {reached}"
    return (
        f"no design within the bounds holds all requirements together: {name}: {near_text} where they are missed "
        f"least, {there}; alone it would reach {best_text}"
    )


def _evolved(
    judge: Judge,
    bounds: Mapping[str, tuple[float, float]],
    decimals: Mapping[str, int],
    seed: int,
    generations: int,
    members: int,
    start: Mapping[str, float] | None,
    done: Callable[[], object],
) -> tuple[dict[str, float], Judged, int, Array]:
    """The best variant, what it is worth, the variants tried and the energies of the last generation."""
    from scipy.optimize import Bounds, differential_evolution  # on use: takes longer than the rest of the package

    names, tried = list(bounds), 0
    middle = {name: (low + high) / 2 for name, (low, high) in bounds.items()}

    def variants(x: Array) -> dict[str, Array]:
        rounded = (np.round(column, decimals[name]) for name, column in zip(names, np.atleast_2d(x.T).T, strict=True))
        return {name: np.clip(column, *bounds[name]) for name, column in zip(names, rounded, strict=True)}

    def energy(x: Array, /, *_: Any) -> Any:
        nonlocal tried
        judged = judge(variants(x))
        tried += len(judged.goal)
        return energies(judged)

    def progress(*_: Any) -> None:
        done()

    found = differential_evolution(
        energy,
        Bounds(*np.array(list(bounds.values())).T),
        maxiter=generations,
        popsize=members,
        tol=0,
        atol=-1,  # of equal goals too, as on a plateau, it goes on
        rng=seed,
        callback=progress,
        polish=False,
        updating="deferred",
        vectorized=True,
        x0=None if start is None else [middle[x] + (start[x] - middle[x]) * _INSIDE for x in names],
    )
    chosen = variants(found.x[:, None])
    return {name: float(column[0]) for name, column in chosen.items()}, judge(chosen), tried, found.population_energies


def beside(
    judge: Judge, bounds: Mapping[str, tuple[float, float]], design: Mapping[str, float], count: int
) -> dict[str, float]:
    """The best of about ``count`` variants nearer and nearer to a design, itself among them: at the edge of a step.

    The inputs that move, and how far, are drawn anew for each variant; the reach is halved where none is better.
    """
    random, names = np.random.default_rng(0), list(bounds)
    low, high = np.array([*bounds.values()]).T
    best, least, reach = np.array([design[x] for x in names]), np.inf, _REACH
    members = max(count // _ROUNDS, 8)
    for _ in range(_ROUNDS):
        far = reach * 10.0 ** random.uniform(-_DECADES, 0, (members, 1))
        moving = random.random((members, len(names))) < random.uniform(0.3, 1, (members, 1))
        moves = random.normal(size=moving.shape) * moving * far * (high - low)
        moves[0] = 0
        near = np.clip(best + moves, low, high)
        judged = judge(dict(zip(names, near.T, strict=True)))
        energy = energies(replace(judged, requirements=tuple(r.stricter(_KEPT) for r in judged.requirements)))
        k = int(np.argmin(energy))
        better, least = energy[k] < least and k > 0, energy[k]
        best, reach = near[k], reach if better else reach / 2
    return dict(zip(names, best.tolist(), strict=True))


def pareto(a: Array, b: Array) -> NDArray[np.intp]:
    """Which designs no other one beats in both quantities, by falling ``a``; of equal ones the first.

    >>> pareto(np.array([3.0, 1.0, 2.0, 2.0]), np.array([1.0, 3.0, 2.0, 1.0]))
    array([0, 2, 1])
    """
    order = np.lexsort((-b, -a))
    before = np.maximum.accumulate(np.concatenate([[-np.inf], b[order][:-1]]))
    return order[b[order] > before]


def scene_text(
    fields: Mapping[str, Input], inputs: Mapping[str, float | str], limits: Mapping[str, Limit], remarks: Sequence[str]
) -> str:
    """Text of a scene file: remarks, inputs with their units, and limits of results."""
    lines = [*(f"# {remark}" for remark in remarks), "[inputs]"]
    texts = {name: _quoted(value) if isinstance(value, str) else repr(value) for name, value in inputs.items()}
    lines += [f"{_key(name)} = {text}  # {numbers.in_text(fields[name].unit)}" for name, text in texts.items()]
    lines += ["", "[limits]"] if limits else []
    for name, limit in limits.items():
        ends = (f"{end} = {value!r}" for end, value in (("min", limit.min), ("max", limit.max)) if value is not None)
        lines.append(f"{_quoted(name)} = {{{', '.join(ends)}}}")
    return "\n".join(lines) + "\n"


def _key(name: str) -> str:
    return name if name.isascii() and name.isidentifier() else _quoted(name)


def _quoted(text: str) -> str:
    return json.dumps(text, ensure_ascii=False)  # TOML knows no halves of a letter


def save_scene(text: str, name: str, namespace: Mapping[str, Any]) -> Any:
    """A scene beside the workbook, where a script was given ``--out``; in the page a button that hands it out.

    Nothing is written for a run that doesn't name a folder, nor while somebody looks at the page.
    """
    worksheet = str(namespace["__file__"])
    if arguments.is_script(worksheet):
        out = arguments.read(sys.argv[1:], declared(type(namespace["g"]))).out
        if out is not None:
            report.write(text.encode(), out / name)
            print(f"written {out / name}")
        return None
    import marimo as mo  # on use: a script needs it not

    return mo.download(text.encode(), filename=name, label="Scene of the design")


def _text(value: float, unit: str) -> str:
    return numbers.significant(value / units.parse(unit).factor, 4) + numbers.suffix(unit)
