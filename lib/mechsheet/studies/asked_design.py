"""What would it take: ``design NAME --vary=INPUT=LEAST..GREATEST --need=REQUIREMENT --best=GOAL`` for any worksheet.

Several inputs within bounds are searched, then refined by slopes, or beside a step by variants near it; one input and
one value of a result are solved. The page asks the same in the same words.
"""

import re
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mechsheet import units
from mechsheet.run import arguments, batch, report
from mechsheet.run.ending import say, watch
from mechsheet.run.progress import progress
from mechsheet.studies import design, refined
from mechsheet.studies.optimum import WORSE
from mechsheet.studies.sensitivity import continuous, point, solved
from mechsheet.studies.sweep import Sweep, sweep
from mechsheet.worksheet import inputs, numbers
from mechsheet.worksheet.cells import Worksheet, base, load, value
from mechsheet.worksheet.errors import SheetError, as_given
from mechsheet.worksheet.find import find
from mechsheet.worksheet.kinds import Input
from mechsheet.worksheet.scene import Limit, Scene

Array = NDArray[np.float64]

_GENERATIONS, _MEMBERS, _SEED = 30, 10, 1
_PLACES = 201  # at which is looked before the search, and whether other values would do
_DIGITS = 5  # to which the inputs are found, of their ranges
_NAME = r"(\w+(?:\.real|\.imag)?|abs\(\w+\))"
_NEED = re.compile(rf"(?:(min|max)\s+)?{_NAME}\s*(>=|<=|=)\s*(.+)")
_BEST = re.compile(rf"(max|min)\s+{_NAME}")
_VARY = re.compile(r"(\w+)\s*=\s*(.+?)\s*\.\.\s*(.+)")


class Need(NamedTuple):
    """A result that must be at least (``>=``), at most or equal to a number, in its display unit, at every position.

    The least or the greatest one over the positions is what is meant where ``end`` is ``min`` or ``max``.
    """

    text: str
    end: str
    name: str
    sign: str
    limit: str

    def of(self, values: Array) -> Array:
        """What must keep the limit, of each variant: of several positions the worst, or the end that is meant."""
        rows = values.reshape(len(values), -1)
        end = self.end or {">=": "min", "<=": "max"}.get(self.sign, "")
        if not end and rows.shape[1] > 1:
            raise SheetError(f"--need={self.text!r}: {self.name} has {rows.shape[1]} positions: min or max {self.name}")
        return np.asarray(rows.max(1) if end == "max" else rows.min(1))


@dataclass(frozen=True)
class Asked:
    """What is varied, between which texts; what is needed; what shall be greatest (``max``) or least; the scene."""

    vary: dict[str, tuple[str, str]]
    needs: tuple[Need, ...]
    best: tuple[str, str] | None
    scene: Scene

    @property
    def results(self) -> list[str]:
        """Results that tell what a variant is worth."""
        return list(dict.fromkeys([*(need.name for need in self.needs), *([self.best[1]] if self.best else [])]))


@arguments.usage()
def read(options: Sequence[str], declared: Sequence[Input]) -> Asked:
    """What is asked for by arguments of the command.

    Raises UsageError for one of another form, and where nothing is varied or asked for.
    """
    vary, needs, best, rest = dict[str, tuple[str, str]](), list[Need](), list[tuple[str, str]](), list[str]()
    for option in _joined(options):
        name, _, text = option.partition("=")
        match name:
            case "--vary":
                found = _form(_VARY, option, text, '--vary="b=0.3..0.5"')
                vary[found[1]] = found[2], found[3]
            case "--need":
                found = _form(_NEED, option, text, '--need="gamma >= 25 deg"')
                needs.append(Need(text, found[1] or "", found[2], found[3], found[4]))
            case "--best":
                found = _form(_BEST, option, text, '--best="max F_T"')
                best.append((found[1], found[2]))
            case _:
                rest.append(option)
    scene = arguments.read(rest, declared)
    if scene.want or scene.proof or scene.tolerances or scene.limits:
        raise SheetError("design takes --vary, --need, --best, inputs, --scene of [inputs] and --out")
    if not vary:
        raise SheetError('nothing is varied: give an input and its bounds, such as --vary="b=0.3..0.5"')
    equal = [need for need in needs if need.sign == "="]
    if len(best) > 1 or (equal and (len(needs) > 1 or best or len(vary) > 1)) or not (best or needs):
        form = 'one --best="max F_T" with any --need="gamma >= 25 deg", or one --vary with one --need="L = 0.5 m"'
        raise SheetError(f"design takes {form}")
    return Asked(vary, tuple(needs), best[0] if best else None, scene)


def _joined(options: Sequence[str]) -> Iterator[str]:
    """Options whose value stands behind a space, as one each."""
    given = iter(options)
    for option in given:
        yield f"{option}={next(given, '')}" if option in ("--vary", "--need", "--best") else option


def _form(form: re.Pattern[str], option: str, text: str, like: str) -> re.Match[str]:
    match = form.fullmatch(text.strip())
    if not match:
        raise SheetError(f"argument {as_given(option)} must be such as {like}")
    return match


class Problem:
    """What is asked of a worksheet, with the units and bounds in which it is asked."""

    def __init__(self, worksheet: str | Path, asked: Asked) -> None:
        self.worksheet, self.asked = worksheet, asked
        self.fields, self.at = point(worksheet, asked.scene.inputs)
        g: Any = inputs.build(load(worksheet).inputs, asked.scene.inputs)
        shown = {f.name: x if type(f) is Input else f.text(getattr(g, f.name)) for f, x in inputs.Used(g).rows()}
        self.given = {name: shown[name] for name in asked.scene.inputs}  # of a list its text, which is no variants
        self.bounds = dict[str, tuple[float, float]]()
        with arguments.usage():
            sheet = load(worksheet)
            results = (name for name in asked.results if name in sheet.results or name not in asked.vary)
            self.computed = [*dict.fromkeys(map(base, results))]
            sheet.needed(self.computed, ["g"])
            for name, ends in asked.vary.items():
                continuous(self.fields, name, "cannot be sought by varying")
                low, high = (self.fields[name].read(end) for end in ends)
                if not low < high:
                    raise SheetError(f"bounds of {self.fields[name].says('..'.join(ends))} must be in order")
                self.bounds[name] = low, high
        try:
            now = self.swept({name: np.array([self.at[name]]) for name in self.bounds})
        except TypeError as error:  # of what is no number
            raise arguments.UsageError(str(error)) from None
        valued = now
        if now.reasons[0]:  # a mechanism may be looked for that closes; another one tells the units
            valued = self._valued()
        self.units = {name: valued.units[base(name)] for name in asked.results}
        for name in asked.results:
            if np.iscomplexobj(self.values(valued, name)):
                raise arguments.UsageError(f"{name} is complex; take {name}.real, {name}.imag or abs({name})")
        with arguments.usage():
            self.limits = {need: self._limit(need) for need in asked.needs}
            self.now = self.judged(now)
        self.several = asked.best is not None and self.values(valued, asked.best[1]).size > 1  # positions of the goal

    def _valued(self) -> Sweep:
        """The document's own variant, or where that has no value the first one within the bounds that has one.

        Raises SheetError where none of them has.
        """
        _, there = point(self.worksheet, {})
        valued = sweep(self.worksheet, self.computed, _alone({x: there[x] for x in self.bounds}))
        if valued.reasons[0]:
            places = self.places()
            closing = np.flatnonzero(self.swept(places).reasons == "")
            valued = self.swept({x: values[closing[:1]] for x, values in places.items()}) if closing.size else valued
        solved(valued, 0)
        return valued

    def _limit(self, need: Need) -> float:
        """The limit of a requirement in SI."""
        unit = self.units[need.name]
        return float(Input(need.name, unit, "limit of", "", False, ()).read(need.limit) * units.parse(unit).factor)

    def swept(self, variants: Mapping[str, Array]) -> Sweep:
        return sweep(self.worksheet, self.computed, {**self.given, **variants})

    def values(self, swept: Sweep, name: str) -> Array:
        """A result of all variants, or one of the inputs that are varied, in SI."""
        if name in self.bounds and name not in self.computed:
            return np.asarray(swept.inputs[name] * units.parse(self.units[name]).factor)
        return np.asarray(value(name, {base(name): swept[base(name)]}))

    def judge(self, variants: dict[str, Array]) -> design.Judged:
        """What variants are worth: without a goal by the least reserve, each in parts of its limit."""
        return self.judged(self.swept(variants))

    def judged(self, swept: Sweep) -> design.Judged:
        requirements = tuple(
            design.Requirement(
                need.text,
                need.of(self.values(swept, need.name)),
                self.limits[need],
                self.units[need.name],
                need.sign == ">=",
            )
            for need in self.asked.needs
        )
        if self.asked.best:
            way, name = self.asked.best
            rows = self.values(swept, name).reshape(len(swept.reasons), -1)
            goal = rows.min(1) if way == "max" else -rows.max(1)
        else:
            goal = np.min([r.reserve / (abs(r.limit) or 1.0) for r in requirements], axis=0)
        return design.Judged(np.asarray(goal), requirements, swept.reasons)

    @property
    def decimals(self) -> dict[str, int]:
        """To how many decimals each input is found."""
        return {x: int(_DIGITS - np.ceil(np.log10(high - low))) for x, (low, high) in self.bounds.items()}

    def places(self) -> dict[str, Array]:
        """Variants all over the bounds, with the bounds themselves, and the present one as far as it is within them.

        A grid as fine as a few hundred make it; of eight inputs or more the lower bounds alone.
        """
        count = int(_PLACES ** (1 / len(self.bounds)))
        axes = (np.linspace(low, high, count) for low, high in self.bounds.values())
        grid = np.stack(np.meshgrid(*axes, indexing="ij")).reshape(len(self.bounds), -1)
        now = (np.clip(self.at[x], low, high) for x, (low, high) in self.bounds.items())
        return {x: np.append(values, own) for x, values, own in zip(self.bounds, grid, now, strict=True)}

    def goal(self, x: float) -> str:
        """The goal of a variant, in words."""
        if not self.asked.best:
            return f"least reserve of the requirements = {numbers.significant(100 * x, 4)} % of its limit"
        way, name = self.asked.best
        end, own = ("least ", x) if way == "max" else ("greatest ", -x)
        return f"{end if self.several else ''}{name} = {numbers.amount(own, self.units[name], 6)}"


def solve(problem: Problem) -> tuple[dict[str, float], list[str]]:
    """The one input that gives one result its value, by `find` on the worksheet, and its verdict."""
    ((name, (low, high)),) = problem.bounds.items()
    (need,) = problem.asked.needs
    field, factor = problem.fields[name], units.parse(problem.fields[name].unit).factor

    def f(x: Any) -> Any:
        swept = problem.swept({name: np.ravel(x) / factor})
        return need.of(problem.values(swept, need.name)).reshape(np.shape(x))

    found = find(
        f,
        low * factor,
        high * factor,
        equals=problem.limits[need],
        unknown=f"{field.meaning} {name}",
        quantity=" ".join(filter(None, (need.end, need.name))),
        unit=problem.units[need.name],
        unknown_unit=field.unit,
    )
    if not found.solved:
        raise SheetError(str(found.reason))
    x = float(found.value / factor)
    places = np.unique(np.append(np.linspace(low, high, _PLACES), x))
    others = np.flatnonzero(f(places * factor) != problem.limits[need])
    k = np.searchsorted(places[others], x)
    level = places[others[k - 1] + 1 if k else 0 : others[k] if k < len(others) else None]
    if len(level) < 2:
        return {name: x}, [str(found)]
    ends = numbers.span(numbers.significant(end, 6) for end in (level[0], level[-1])) + numbers.suffix(field.unit)
    return {name: x}, [str(found), f"any {name} of {ends} would do, as far as {_PLACES} places tell"]


def best(problem: Problem, done: Callable[[], object] = lambda: None) -> tuple[dict[str, float], list[str]]:
    """The inputs that hold all requirements and have the best goal, and how sure that is."""
    places = problem.places()
    start = int(np.argmin(design.energies(problem.judge(places))))
    found = design.search(
        problem.judge,
        problem.bounds,
        problem.decimals,
        seed=_SEED,
        generations=_GENERATIONS,
        members=_MEMBERS,
        start={x: float(values[start]) for x, values in places.items()},
        done=done,
    )
    count = found.tried + len(next(iter(places.values())))
    told = [f"{problem.goal(found.goal)} by {count} variants"]
    chosen, refinement = _refined(problem, found)
    needs = problem.judge(_alone(chosen)).requirements
    told += [f"{r.name}: it is {numbers.amount(float(r.values[0]), r.unit, 6)}" for r in needs]
    lost = problem.now.reasons[0]
    told += [f"now: {lost}" if lost else f"now {problem.goal(float(problem.now.goal[0]))}", *refinement]
    return chosen, [*told, "elsewhere within the bounds only the search has looked"]


def _refined(problem: Problem, found: design.Design) -> tuple[dict[str, float], list[str]]:
    """What slopes make of the design of a search, and where they tell of no optimum as many variants near it again.

    Of a step slopes know nothing: they lead beyond it, say that a slope is left at its edge, or that a tread is level.
    """
    chosen, told = _by_slopes(problem, found.inputs, found.goal)
    if told[-1].endswith(WORSE):
        return chosen, told
    before = float(problem.judge(_alone(chosen)).goal[0])
    near = design.beside(problem.judge, problem.bounds, chosen, found.tried)
    judged = problem.judge(_alone(near))
    if design.energies(judged)[0] >= -before:
        return chosen, [*told, f"none of {found.tried} variants near it is better"]
    nearer = (
        f"refined by {found.tried} variants near it, for slopes know no steps: {problem.goal(float(judged.goal[0]))}"
    )
    said = [text for text in told if not text.startswith("the conditions")]
    try:
        return near, [*said, nearer, refined.Slopes(problem, near).conditions(near)]
    except SheetError:
        return near, [*said, nearer]


def _by_slopes(problem: Problem, start: dict[str, float], goal: float) -> tuple[dict[str, float], list[str]]:
    """What slopes make of a design, that design itself where this is no better; and what they say."""
    try:
        slopes = refined.Slopes(problem, start)
        chosen = slopes.refined()
        judged = problem.judge(_alone(chosen))
        missed = [f"a design that misses {r.name}" for r in judged.requirements if r.missed[0] != 0]
        reason = [f"a design that has no value: {judged.reasons[0]}"] if judged.reasons[0] else missed
        if not reason and judged.goal[0] >= goal:
            return chosen, [f"refined by slopes: {problem.goal(float(judged.goal[0]))}", slopes.conditions(chosen)]
        lead = (reason or ["no better one"])[0]
        return start, [f"not refined by slopes: they lead to {lead}", slopes.conditions(start)]
    except SheetError as error:
        return start, [f"not refined by slopes: {error}"]


def _alone(chosen: Mapping[str, float]) -> dict[str, Array]:
    return {x: np.array([v]) for x, v in chosen.items()}


def scene_of(problem: Problem, chosen: Mapping[str, float], told: Sequence[str]) -> str:
    """Text of the scene of a design; what must be equal to a number is no limit."""
    limits = dict[str, Limit]()
    for need, limit in problem.limits.items():
        if need.end in ("", {">=": "min", "<=": "max"}.get(need.sign)) and base(need.name) in problem.computed:
            end = limit / units.parse(problem.units[need.name]).factor
            known = limits.get(need.name, Limit())
            ends = [x for x in (known.min if need.sign == ">=" else known.max, end) if x is not None]
            limits[need.name] = Limit(max(ends), known.max) if need.sign == ">=" else Limit(known.min, min(ends))
    limits = {} if any(need.sign == "=" for need in problem.asked.needs) else limits
    return design.scene_text(problem.fields, {**problem.given, **chosen}, limits, told)


class Answer(NamedTuple):
    """The inputs found, what is said of them, and the text of their scene."""

    inputs: list[str]
    told: list[str]
    scene: str


def answer(worksheet: str | Path, asked: Asked, done: Callable[[], object] = lambda: None) -> Answer:
    """What it would take; ``done`` is called after each generation of a search.

    Raises SheetError where it cannot be asked or reached.
    """
    problem = Problem(worksheet, asked)
    solving = any(need.sign == "=" for need in asked.needs)
    chosen, told = solve(problem) if solving else best(problem, done)
    found = list[str]()
    for name, x in chosen.items():
        field = problem.fields[name]
        ends = numbers.span(numbers.significant(end, 10) for end in problem.bounds[name])
        own = numbers.significant(x, 10) + numbers.suffix(field.unit)
        found.append(f"{name} = {own}, within {ends}; {field.meaning}")
    return Answer(found, told, scene_of(problem, chosen, told))


def asked_design(
    worksheet: str | Path, options: Sequence[str], given: Mapping[str, Any], done: Callable[[int, int], object]
) -> Answer:
    """`answer` for the inputs of a page; ``done`` is called with how many of how many generations are behind."""
    asked, count = read(options, inputs.declared(load(worksheet).inputs)), 0
    asked = replace(asked, scene=Scene(inputs={**given, **asked.scene.inputs}))

    def generation() -> None:
        nonlocal count
        count += 1
        done(count, _GENERATIONS)

    return answer(worksheet, asked, generation)


def _with_it(sheet: Worksheet, scene: Path) -> list[str]:
    """Where the worksheet does not pass with the scene that is written: the search saw what it was asked for."""
    return [f"with it: {problem}" for problem in batch.attempt(sheet, scene, [], None).problems]


def main() -> None:
    """``python -m mechsheet.studies.asked_design WORKSHEET ..``"""
    worksheet, *options = sys.argv[1:]
    watch(worksheet)
    sheet = load(worksheet)
    asked = read(options, inputs.declared(sheet.inputs))
    with progress(_GENERATIONS, "search") as done:
        found = answer(sheet.path, asked, lambda: done(""))
    say(*found.inputs, *found.told)
    path = (asked.scene.out or report.folder(Path(sheet.path))) / f"{Path(sheet.path).stem}_designed.toml"
    report.write(found.scene.encode(), path)
    say(f"written {path}", *_with_it(sheet, path))


if __name__ == "__main__":
    main()
