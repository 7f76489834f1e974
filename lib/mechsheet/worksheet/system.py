"""The solve block of several unknowns: solutions of as many equations, or the least squares of more, with the verdict.

From guesses Newton's steps lead to one solution, and of a single problem starts around them show others; in intervals
starts all over them are tried, and more as long as that shows new solutions. What no start leads to is not seen, and
the words say no more.
"""

from collections import namedtuple
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mechsheet.mechanics.brackets import Array
from mechsheet.mechanics.starts import Place, Seen, around, aside, between, from_guess
from mechsheet.worksheet import numbers
from mechsheet.worksheet.equations import Asked, Start, Words, asked
from mechsheet.worksheet.errors import function
from mechsheet.worksheet.verdict import Verdict, asks_values_only

_LISTED = 8  # solutions that the verdict lists
_DEPEND = "no single solution for {}: the equations depend on each other, {} solves them, and so does {}"
_VOID = "nothing to solve for {}: an interval, a guess or a target is NaN"


@dataclass(frozen=True, eq=False)
class Solution(Verdict):
    """The verdict of a solve block of several unknowns; numbers in SI, arrays for arrays of problems.

    Attributes
    ----------
    value : named tuple
        The unknowns by their names: from guesses the solution to which they lead, in intervals the one nearest their
        middle. Unsolved: reading it raises SheetError with the reason, Waits where a number that was given is NaN; in
        an array the element is NaN.
    residual : tuple of float
        What each equation leaves at ``value``, of a complex one first the real part, then the imaginary one.
    condition : float
        Condition number of the slopes of the equations at ``value``, over the sizes of the unknowns (interval or
        guess): by so much roundings grow. Infinite where the slopes are singular, as at a double solution.
    solutions : tuple of named tuples
        All solutions that were seen, in ascending order of the first unknown; in an array NaN where a problem has
        fewer. None of least squares.
    interval : dict of two floats
        Where each unknown was looked for: the ends of its interval, or its guess twice.
    starts : int
        Places from which solutions were looked for.
    evaluations : int
        Values of all equations computed for ``value``, shape (...); what is looked for around a guess is not counted.
    least : bool
        Whether the squares of the equations were made least: then nothing is called solved.
    reason : str
        Why there is no value; "" where there is one.
    """

    _values: tuple[Any, ...]
    residual: tuple[Any, ...]
    condition: Any
    evaluations: Any
    least: bool
    words: Words
    interval: Mapping[str, tuple[Any, Any]]
    _waits: Any
    _compute: Callable[[], "_Others"]

    @property
    def value(self) -> Any:
        self.give()
        return _named(self.words.names)(*self._values)

    @property
    def waits(self) -> Any:
        return self._waits

    @property
    def valued(self) -> Any:
        valued = ~np.isnan(self._values[0])
        return valued if valued.ndim else bool(valued)

    @property
    def solved(self) -> Any:
        return self.valued & (not self.least)

    @property
    def solutions(self) -> tuple[Any, ...]:
        return self._others.solutions

    @property
    def starts(self) -> Any:
        return self._others.starts

    @property
    def reason(self) -> Any:
        return self._others.reason

    @cached_property
    def _others(self) -> "_Others":
        return self._compute()

    @property
    def names(self) -> tuple[str, ...]:
        return self.words.names

    def word(self) -> str:
        return "least squares" if self.least and not self.failures() else super().word()

    def headline(self) -> str:
        words = self.words
        if isinstance(self.reason, str):
            return words.unknowns if self.reason else words.point(self._values)
        count = f"{np.count_nonzero(self.valued)} of {self.reason.size} problems {'fitted' if self.least else 'solved'}"
        if not np.any(self.valued):
            return f"{words.unknowns}, {count}"
        spans = (numbers.extent(v, unit) for v, unit in zip(self._values, words.units, strict=True))
        return ", ".join(f"{name} = {text}" for name, text in zip(words.names, spans, strict=True)) + f", {count}"

    def details(self) -> list[tuple[str, str]]:
        words, rows = self.words, []
        single = isinstance(self.reason, str)
        if np.all(self.waits):
            return []
        if np.any(self.valued):
            left = [
                numbers.amount(np.nanmax(np.abs(r)), unit, 2)
                for r, unit in zip(self.residual, words.equation_units, strict=True)
            ]
            rows.append(("missed by" if single else "missed at most by", "; ".join(left)))
            worst = float(np.nanmax(self.condition))
            known = f"{numbers.significant(worst, 2)} times"
            if not np.isfinite(worst):
                known = "infinite: the slopes are singular"
            rows.append(("errors grow" if single else "errors grow at most", known))
        if single and not self.least:
            where = f"{self.starts} starts" + (" around the guess" if words.guessed else "")
            listed = [words.point(x) for x in self.solutions[:_LISTED]]
            more = [f"and {len(self.solutions) - _LISTED} more"] * (len(self.solutions) > _LISTED)
            rows.append((f"solutions seen by {where}", "; ".join([*listed, *more]) or "none"))
        rows.append(("searched", "; ".join(map(self._searched, words.names, words.units))))
        return [*rows, ("computed", f"{np.sum(self.evaluations)} times")]

    def _searched(self, name: str, unit: str) -> str:
        ends = self.interval[name]
        return f"{name} {'from' if np.array_equal(*ends) else 'in'} {numbers.extent(ends, unit)}"


class _Others(NamedTuple):
    """What there is beside the value."""

    solutions: tuple[Any, ...]
    starts: Any
    reason: Any


def minerr(
    f: Callable[..., Any],
    *,
    equals: Any = 0.0,
    unit: str | Sequence[str] = "-",
    unknown_unit: str | Sequence[str] = "-",
    **unknowns: Start,
) -> Solution:
    """Unknowns that make the sum of the squares of equations least, of which there may be more than unknowns.

    A residual of one ``unit`` counts as much in each equation. The arguments are those of `find` with several unknowns;
    in intervals the least of all sums that starts lead to is the value. The verdict never calls that solved.

    >>> minerr(lambda a, b: (a + b, a + 2 * b, a + 3 * b), equals=(1, 2, 2), a=1.0, b=1.0).solved
    False
    """
    function(f, "minerr")
    return solve(f, equals, unit, unknown_unit, unknowns, least=True)


def solve(
    f: Callable[..., Any],
    equals: Any,
    unit: str | Sequence[str],
    unknown_unit: str | Sequence[str],
    unknowns: Mapping[str, Start],
    least: bool = False,
) -> Solution:
    """`find` with several unknowns, or `minerr`."""
    problem = asked(f, equals, unit, unknown_unit, unknowns, least)
    equations, words, place, shape = problem.equations, problem.words, problem.place, problem.shape
    if equations is None:
        return _nothing(problem, least)
    weights = problem.weights if least else None
    seen = (from_guess if words.guessed else between)(equations, place, weights)
    chosen = seen.lowest if least else _nearest(seen, place)
    beside = np.full_like(chosen[0], np.nan) if least else aside(equations, place, chosen[0], chosen[2])
    lost = np.isnan(chosen[0][0]) | np.isnan(chosen[1]).any(0)  # of least squares: no step leads on from there
    none = problem.void | lost | ~np.isnan(beside[0])
    x, residual, condition = (np.where(none, np.nan, a) for a in chosen)

    def shaped(a: NDArray[Any]) -> Any:
        return a.reshape(shape) if shape else a.item()

    def others() -> _Others:
        every = around(equations, place) if words.guessed and not (least or shape) else seen
        reasons = np.full(problem.void.size, "", dtype=object)
        for i in np.flatnonzero(np.isnan(x[0])).tolist():
            if problem.void[i]:
                reasons[i] = _VOID.format(words.unknowns)
            elif np.isnan(beside[0, i]):
                reasons[i] = _reason(words, seen, every, i)
            else:
                own, other = (words.point(a[:, i].tolist()) for a in (chosen[0], beside))
                reasons[i] = _DEPEND.format(words.unknowns, own, other)
        points = () if least else np.moveaxis(np.where(problem.void, np.nan, every.x), 1, 0)
        solutions = tuple(_named(words.names)(*map(shaped, s)) for s in points if not np.isnan(s).all())
        return _Others(solutions, shaped(every.starts), shaped(reasons))

    solution = Solution(
        _values=tuple(map(shaped, x)),
        residual=tuple(map(shaped, residual)),
        condition=shaped(condition),
        evaluations=shaped(seen.evaluations),
        least=least,
        words=words,
        interval=problem.interval,
        _waits=shaped(problem.void),
        _compute=others,
    )
    if not asks_values_only():
        _ = solution.reason  # at once, because what f closes over may change
    return solution


_TIED = 2.0**-30  # of the sizes of the unknowns: two distances that differ by less are the same


def _nearest(seen: Seen, place: Place) -> tuple[Array, Array, Array]:
    """The solution nearest the middle of the places, the first of those as near: unknowns, residuals and condition."""
    off = np.abs(seen.x - (place.first / 2 + place.last / 2)[:, None]) / place.size[:, None]
    farthest = np.where(np.isnan(off[0]), np.inf, off.max(0))
    near, p = (farthest <= farthest.min(0) + _TIED).argmax(0), np.arange(off.shape[-1])
    return seen.x[:, near, p], seen.residual[:, near, p], seen.condition[near, p]


def _reason(words: Words, seen: Seen, every: Seen, i: int) -> str:
    """Why problem i has no solution: the equation that keeps the nearest place from being one."""
    how = f"no solution for {words.unknowns} {'from the guess' if words.guessed else f'by {seen.starts[i]} starts'}"
    x, r = seen.nearest.x[:, i].tolist(), seen.nearest.r[:, i]
    if np.isnan(r).any():
        return f"{how}: {words.equations[int(np.isnan(r).argmax())]} has no number there"
    rests = (seen.nearest.slopes[:, :, i] == 0).all(1)
    if not r.any() and rests.any():
        same = f"{words.equations[int(rests.argmax())]} rests on none of them near {words.point(x)}"
        return f"no single solution for {words.unknowns}: {same}"
    worst = int(np.argmax(seen.left[:, i]))
    left = numbers.amount(r[worst], words.equation_units[worst])
    reason = f"{how}: {words.equations[worst]} leaves {left} at the nearest, {words.point(x)}"
    others = [words.point(s) for s in every.x[:, :, i].T.tolist() if not np.isnan(s).any()] if words.guessed else []
    if not others:
        return reason
    nearer = "it" if len(others) == 1 else "one of them"
    return f"{reason}; starts around it see {'; '.join(others[:_LISTED])}: give a guess nearer to {nearer}"


def _nothing(problem: Asked, least: bool) -> Solution:
    """The verdict on problems none of which has a guess or an interval."""
    words, shape = problem.words, problem.shape
    none, count = np.full(shape, np.nan)[()], np.zeros(shape, dtype=int)[()]
    others, waits = _Others((), count, np.full(shape, _VOID.format(words.unknowns), dtype=object)[()]), np.isnan(none)
    lost = (none,) * len(words.names)
    left = (none,) * len(words.equations)
    return Solution(lost, left, none, count, least, words, problem.interval, waits, lambda: others)


@lru_cache(maxsize=128)
def _named(names: tuple[str, ...]) -> Any:
    return namedtuple("Values", names)
