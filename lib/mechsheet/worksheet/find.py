"""The solve block: every root of one equation in one unknown, with the verdict that proves it.

Of several unknowns it is a `system`. All branches are searched, which also tells all roots, what is reached and why
there is no value. A sweep asks for none of that (`values_only`): on the wanted branch it takes the nearest piece that
has a root, with the same value.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import cache, cached_property, partial
from typing import Any, NamedTuple, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mechsheet.mechanics.brackets import Array, Function
from mechsheet.mechanics.roots import Counted, Roots, all_roots, nearest_root, real_values, together
from mechsheet.mechanics.rows import each_alone, of_one, takes_arrays
from mechsheet.worksheet import numbers
from mechsheet.worksheet.equations import WORDS, Start, common_shape, meant, real_numbers
from mechsheet.worksheet.errors import SheetError, function, measured
from mechsheet.worksheet.system import Solution, solve
from mechsheet.worksheet.verdict import Verdict, asks_values_only

_BESIDE = 1.125  # times the guess: another place to try f


class _Words(NamedTuple):
    """What is asked, in words and display units."""

    unknown: str
    quantity: str
    unit: str
    unknown_unit: str

    def unit_of(self, _: str) -> str:
        return self.unknown_unit


@dataclass(frozen=True, eq=False)
class Root:
    """One root: unknown, assembly branch (0 without branches), residual and bracket, all in SI.

    Between the ends of the bracket the residual changes sign; they are equal where ``f`` only touches the target.
    In an array of problems each field is an array, NaN (branch 0) where a problem has fewer roots.
    """

    value: Any
    branch: Any
    residual: Any
    bracket: tuple[Any, Any]


@dataclass(frozen=True, eq=False)
class Found(Verdict):
    """The verdict of a solve block; numbers in SI, arrays for arrays of problems.

    Attributes
    ----------
    value : float
        The root on the wanted branch nearest the guess. Unsolved: reading it raises SheetError with the reason, Waits
        where a number that was given is NaN; in an array the element is NaN.
    branch : int, array of int or None
        The wanted branch.
    residual : float
        f - equals at ``value``; NaN where unsolved.
    bracket : tuple of float
        Interval that encloses ``value``: see `Root`.
    evaluations : int
        Values of f computed so far, over all problems and branches, sampling and verification included.
    roots : tuple of Root
        The roots of all branches in the interval, in ascending order: all that the samples show.
    samples : int
        Distinct places on all branches at which f was looked at for roots, reach and reason, whose words name them:
        what f does between two of them is not known.
    interval : tuple of float
        The interval searched on the wanted branch.
    reached : tuple of float
        Least and greatest f in that interval on the wanted branch, computed when it is read where all is solved; NaN
        where nothing is finite.
    reason : str
        Why there is no value; "" where solved.
    """

    _value: Any = field(repr=False)
    branch: Any
    residual: Any
    bracket: tuple[Any, Any]
    interval: tuple[Any, Any]
    equals: Any
    words: _Words
    _evaluations: Callable[[], int] = field(repr=False)
    _compute: Callable[[], "_Everything"] = field(repr=False)

    @property
    def value(self) -> Any:
        self.give()
        return self._value

    @property
    def waits(self) -> Any:
        waits = np.isnan(self.equals)
        return waits if waits.ndim else bool(waits)

    @property
    def solved(self) -> Any:
        solved = ~np.isnan(self._value)
        return solved if solved.ndim else bool(solved)

    @property
    def evaluations(self) -> int:
        return self._evaluations()

    @property
    def roots(self) -> tuple[Root, ...]:
        return self._everything.roots

    @property
    def samples(self) -> Any:
        return self._everything.samples

    @property
    def reached(self) -> tuple[Any, Any]:
        return self._everything.reached()

    @property
    def reason(self) -> Any:
        return self._everything.reason

    @cached_property
    def _everything(self) -> "_Everything":
        return self._compute()

    @property
    def names(self) -> tuple[str, ...]:
        return (self.words.unknown,) if self.words.unknown.isidentifier() else ()

    def headline(self) -> str:
        unknown, unit = self.words.unknown, self.words.unknown_unit
        if isinstance(self.reason, str):
            return unknown if self.reason else f"{unknown} = {numbers.extent(self._value, unit)}"
        count = f"{np.count_nonzero(self.solved)} of {self.reason.size} problems solved"
        return (
            f"{unknown} = {numbers.extent(self._value, unit)}, {count}"
            if np.any(self.solved)
            else f"{unknown}, {count}"
        )

    def details(self) -> list[tuple[str, str]]:
        words, single = self.words, isinstance(self.reason, str)
        if np.all(self.waits):
            return []
        on = "" if self.branch is None or np.ndim(self.branch) else f" on branch {self.branch:+d}"
        rows = [("condition", f"{words.quantity} = {numbers.extent(self.equals, words.unit)}{on}")]
        if np.any(self.solved):
            label = "missed by" if single else "missed at most by"
            rows.append((label, numbers.amount(np.nanmax(np.abs(self.residual)), words.unit, 2)))
        if single and not self.reason:
            low, high = self.bracket
            rows.append(("value within", numbers.amount(high - low, words.unknown_unit, 2)))
        if single:
            unit, texts = words.unknown_unit, numbers.in_line([root.value for root in self.roots], words.unknown_unit)
            behind = [numbers.suffix(unit) + (on and f" (branch {root.branch:+d})") for root in self.roots]
            roots = [text + more for text, more in zip(texts, behind, strict=True)]
            rows.append((f"roots seen by {self.samples} samples", "; ".join(roots) or "none"))
        rows.append(("searched", numbers.extent(self.interval, words.unknown_unit)))
        return [*rows, ("computed", f"{self.evaluations} times")]


class _Everything(NamedTuple):
    """What the search of all branches tells: see `Found`."""

    roots: tuple[Root, ...]
    samples: Any
    reached: Callable[[], tuple[Any, Any]]
    reason: Any


@overload
def find(  # type: ignore[overload-overlap]  # a name that is not one of these is an unknown
    f: Callable[..., Any],
    lo: ArrayLike | None = None,
    hi: ArrayLike | None = None,
    *,
    equals: ArrayLike = 0.0,
    guess: ArrayLike | None = None,
    branch: ArrayLike | None = None,
    branches: Sequence[int] | None = None,
    unknown: str = "unknown x",
    quantity: str = "f(x)",
    unit: str = "-",
    unknown_unit: str = "-",
) -> Found: ...
@overload
def find(
    f: Callable[..., Any],
    *,
    equals: Any = 0.0,
    unit: str | Sequence[str] = "-",
    unknown_unit: str | Sequence[str] = "-",
    **unknowns: Start,
) -> Solution: ...
def find(  # type: ignore[misc]
    f: Callable[..., Any],
    lo: ArrayLike | None = None,
    hi: ArrayLike | None = None,
    *,
    equals: Any = 0.0,
    guess: ArrayLike | None = None,
    branch: Any = None,
    branches: Sequence[int] | None = None,
    unknown: str = "unknown x",
    quantity: str = "f(x)",
    unit: Any = "-",
    unknown_unit: Any = "-",
    **unknowns: Start,
) -> Found | Solution:
    """Solve ``f(x) = equals`` for x in ``lo..hi``, or several equations for several unknowns; and say how well.

    Say also where else, or why not. Several unknowns are given by their names, which are those that ``f`` takes: each
    with its guess, or in round brackets with its interval. ``f`` then gives as many equations.

    Parameters
    ----------
    f : callable
        ``f(x)``, or ``f(x, branch)`` where ``branches`` are given: the quantity that must equal ``equals``; NaN
        where the mechanism does not close. It is called with x inside the interval only, and with many at once: x has
        the shape of the problems behind one more axis. One that does not broadcast, such as the largest value over
        some positions, is seen by that, and called for one number after the other.
    lo, hi : float, shape (...), optional
        The interval. An end that is not given is the end of the reachable interval: f is sampled on
        ``guess * 2**(k/8)``, k = -64..64, and the run of finite values around the finite sample nearest the guess
        is followed to the last float at which f is finite, or to the end of that range.
    equals : float, shape (...)
        The wanted value of f [unit].
    guess : float, shape (...), optional
        Chooses among several roots: the nearest one is the value, the smaller one of two as near. By default the
        middle of the interval. Positive where an end of the interval is not given.
    branch : int, shape (...), optional
    branches : sequence of int, optional
        The wanted assembly branch, and all of them; the roots on the others are reported too.
    unknown, quantity : str
        Words and symbol, as in ``lifting rod L4``.
    unit, unknown_unit : str
        Display units of ``quantity`` and ``unknown``; all numbers here are SI.
    **unknowns : float or tuple of two floats, shape (...)
        The guess or the interval of each of several unknowns. Then ``f`` takes them by name and gives the equations,
        a number or a tuple: each left side less right side, or with ``equals`` (a tuple) what must equal that. A
        complex equation is two. ``unit`` and ``unknown_unit`` are of all, or a tuple for each; what is left out
        above does not go with several unknowns.

    Returns
    -------
    Found, or Solution of several unknowns
        Shape (...) is that of lo, hi, equals, guess and what f closes over, broadcast; floats for shape ().

    Raises
    ------
    SheetError
        An interval that is empty, an infinite number (NaN leaves its problem unsolved), a guess that is missing or
        cannot be used; fewer or more equations than unknowns. It is a ValueError.
    ValueError
        A branch that is not one of ``branches``.

    Notes
    -----
    x is exact to about two floats of the root of f as computed, near zero to 1e-31 of the interval. At a local
    extreme or an end of the interval, a value within one unit in the last place of the target, or nearer to it than
    f varies over the next eight floats, counts as a root that touches: so dead centres and double roots are kept.
    A sign change at a jump or a pole is no root, and where every value solves the equation none is chosen. What f does
    within 1/60 of the interval can be missed.

    Several unknowns are found by Newton's method: from guesses the solution is that to which its own steps lead, which
    turn no unknown in a unit of angle by more than 45 degrees, or where twenty do not, those in a trust region; in
    intervals that nearest the middle of all that were seen by starts all over them, 32 for each unknown and as many
    again as long as that shows new ones. Each equation then leaves no more than it varies by over the next
    eight floats of the unknowns, or of an eighth of the guess or interval. What no start leads to is not seen.
    Where equations depend on each other all of a line solves them, and none is chosen.

    >>> find(lambda x: x**2, 0.0, 2.0, equals=2.0).value
    1.4142135623730951
    >>> circle_and_parabola = find(lambda x, y: (x**2 + y**2, y - x**2), equals=(4, -1), x=(-2, 2), y=(-2, 2))
    >>> len(circle_and_parabola.solutions)
    2
    """
    function(f, "find")
    if unknowns:
        if any(given is not None for given in (lo, hi, guess, branch, branches)):
            names = f"{', '.join(WORDS[:-1])} and {WORDS[-1]}"
            raise SheetError(f"find takes either an interval with {names}, or the unknowns {meant(unknowns)}")
        return solve(f, equals, unit, unknown_unit, unknowns)
    measured(unit), measured(unknown_unit)
    return sought(f, _Words(unknown, quantity, unit, unknown_unit), lo, hi, equals, guess, branch, branches)


def sought(
    f: Callable[..., Any],
    words: _Words,
    lo: ArrayLike | None,
    hi: ArrayLike | None,
    equals: ArrayLike,
    guess: ArrayLike | None,
    branch: Any,
    branches: Sequence[int] | None,
) -> Found:
    """`find` with one unknown."""
    labels = [0] if branches is None else list(branches)
    on = np.asarray(0 if branch is None else branch)
    among = np.equal.outer(labels, on)
    if (branch is None) != (branches is None) or not among.any(0).all():
        raise ValueError(f"branch = {branch} of {words.unknown} must be one of {branches}")
    given = _checked(words, lo=lo, hi=hi, equals=real_numbers(equals, "equals", words.unknown), guess=guess)
    functions = [f] if branches is None else [_on_branch(f, s) for s in labels]
    wanted = f if branches is None else _on_branch(f, on[()])

    given = dict(zip(given, np.broadcast_arrays(*given.values()), strict=True))
    void = np.isnan(list(given.values())).any(0)
    if void.all():
        return _nothing(words, None if branch is None else on[()], void.shape)
    if void.any():
        given = {name: np.where(void, v[~void][0], v) for name, v in given.items()}  # f sees no NaN
    start = given["guess"] if lo is None or hi is None else given["lo"] / 2 + given["hi"] / 2
    beside = next((given[end] for end in ("lo", "hi") if end in given), start * _BESIDE)
    first = real_values(wanted, start.reshape(-1)[0])  # its shape shows what f closes over
    if 0 in (shape := np.broadcast_shapes(void.shape, first.shape)):
        return _nothing(words, None if branch is None else on[()], shape)
    alone = shape if first.shape else ()
    places = np.stack([np.broadcast_to(x, alone) if alone else x.reshape(-1)[0] for x in (start, beside)])
    if not takes_arrays(of_one(partial(real_values, wanted)), places[None], alone):
        wanted, *functions = (each_alone(function, alone) for function in (wanted, *functions))
    void = np.broadcast_to(void, shape).reshape(-1)
    flat = {name: np.broadcast_to(v, shape).reshape(-1) for name, v in given.items()}
    own, every = Counted([wanted], shape), Counted(functions, shape)

    def shaped(a: NDArray[Any]) -> Any:
        return a.reshape(shape) if shape else a.item()

    @cache
    def search_all() -> Roots:
        columns = {name: np.tile(v, len(labels)) for name, v in flat.items()}  # branches x problems
        return all_roots(every, columns, np.tile(void, len(labels)))

    ranks = among.argmax(0)  # of the wanted branches among all
    at = np.broadcast_to(ranks, shape).reshape(-1) * void.size + np.arange(void.size)

    def everything() -> _Everything:
        search = search_all()
        reasons = np.full(void.size, "", dtype=object)
        for i in np.flatnonzero(np.isnan(value)):
            reasons[i] = _reason(words, flat["equals"][i], search, at[i])
            own_roots = [(s, x) for k, s in enumerate(labels) for x in search.roots[0, :, k * void.size + i]]
            places = [
                f"at {numbers.amount(x, words.unknown_unit)} on branch {s:+d}" for s, x in own_roots if np.isfinite(x)
            ]
            reasons[i] += f"; it is reached {', '.join(places)}" if places else ""
        roots = tuple(
            Root(shaped(x), shaped(s), shaped(r), (shaped(a), shaped(b)))
            for x, r, a, b, s in together(search.roots, labels)
        )
        samples = shaped(search.samples.reshape(len(labels), -1).sum(0))
        return _Everything(
            roots, samples, lambda: (shaped(search.reached[0, at]), shaped(search.reached[1, at])), shaped(reasons)
        )

    answer = nearest_root(own, flat) if asks_values_only() else search_all().nearest(at, flat.get("guess"))
    low, high, value, residual, *bracket = (np.where(void, np.nan, numbers) for numbers in answer)
    found = Found(
        _value=shaped(value),
        branch=None if branch is None else on[()],
        residual=shaped(residual),
        bracket=(shaped(bracket[0]), shaped(bracket[1])),
        interval=(shaped(low), shaped(high)),
        equals=shaped(np.where(void, np.nan, flat["equals"])),
        words=words,
        _evaluations=lambda: void.size + own.count + every.count,
        _compute=everything,
    )
    if not asks_values_only():
        _ = found.reason  # at once, because what f closes over may change
    return found


def _nothing(words: _Words, branch: Any, shape: tuple[int, ...]) -> Found:
    """The verdict on problems none of which has an interval, a target and a guess."""
    none = np.full(shape, np.nan)[()]
    reasons = np.full(shape, _without_numbers(words), dtype=object)[()]
    everything = _Everything((), np.zeros(shape, dtype=int)[()], lambda: (none, none), reasons)
    return Found(none, branch, none, (none, none), (none, none), none, words, lambda: 0, lambda: everything)


def _checked(words: _Words, **values: ArrayLike | None) -> dict[str, Array]:
    """The numbers that are given, as arrays; SheetError for the first that cannot be used."""
    given = {k: real_numbers(v, k, words.unknown) for k, v in values.items() if v is not None}
    common_shape(given)
    for name, v in given.items():
        if (bad := np.isinf(v)).any():
            unit = words.unit if name == "equals" else words.unknown_unit
            raise SheetError(f"{name} = {numbers.amount(v[bad][0], unit)} for {words.unknown} must be finite")
    ends = [given[name] for name in ("lo", "hi") if name in given]
    if len(ends) == 2:
        _in_order(words, ("lo", "hi"), *ends)
        return given
    if "guess" not in given:
        raise SheetError(f"{words.unknown} needs a guess, or both ends of its interval")
    for pair in (("lo", "guess"), ("guess", "hi")):
        if pair[0] in given and pair[1] in given:
            _in_order(words, pair, given[pair[0]], given[pair[1]])
    if (given["guess"] <= 0).any():
        least = numbers.amount(np.nanmin(given["guess"]), words.unknown_unit)
        raise SheetError(f"guess = {least} for {words.unknown} must be positive, or give both ends of its interval")
    return given


def _in_order(words: _Words, names: tuple[str, str], low: Array, high: Array) -> None:
    if not (low >= high).any():
        return
    low, high = np.broadcast_arrays(low, high)
    for a, b in zip(low[low >= high], high[low >= high], strict=True):
        small, large = (numbers.amount(v, words.unknown_unit) for v in (a, b))
        raise SheetError(f"{names[0]} = {small} for {words.unknown} must be less than {names[1]} = {large}")


def _on_branch(f: Callable[..., Any], s: Any) -> Function:
    return lambda x: f(x, s)


def _reason(words: _Words, equals: float, search: Roots, c: int) -> str:
    """Why the samples show no root in column c."""
    at, unit, by = words.unknown_unit, words.unit, f" by {search.samples[c]} samples"
    least, greatest = search.reached[:, c]
    if np.isnan(search.interval[:, c]).any():
        return _without_numbers(words)
    if np.isnan(least):
        nowhere = f"is NaN at each of {search.samples[c]} samples in {numbers.extent(search.interval[:, c], at)}"
        why = "as of a group that does not close, or a square root of a negative number"
        return f"{words.unknown}: {words.quantity} {nowhere}, {why}"
    *ends, target = numbers.apart([least, greatest, equals], unit)
    reach, after = numbers.span(ends), numbers.suffix(unit)
    if not least <= equals <= greatest:
        return f"{words.unknown}: {words.quantity} reaches {reach}{after}{by}, {target}{after} is outside"
    if search.pieces.level[c]:
        everywhere = f"at each of {search.samples[c]} samples in {numbers.extent(search.interval[:, c], at)}"
        return f"{words.unknown}: {words.quantity} is {target}{after} {everywhere}: any value would do"
    where = "" if np.isnan(search.jump[c]) else f" at {numbers.amount(search.jump[c], at)}"
    verdict = f"reaches {reach}{after}{by} but jumps over {target}{after}{where}"
    return f"{words.unknown}: {words.quantity} {verdict}"


def _without_numbers(words: _Words) -> str:
    return f"nothing to solve for {words.unknown}: its interval, target or guess is NaN"
