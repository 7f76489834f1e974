"""The solve block: every root of one equation in one unknown, with the verdict that proves it.

An interval is sampled, cut at the edges between finite and NaN and at the local extremes, and so into monotone
pieces. A piece whose ends differ in sign is solved by bracketing; a cut that meets the target within rounding is
a touching root. Everything runs for whole arrays of problems at once: problems on the last axis, and ``f`` always
gets the same problems in the same places; what a problem gets does not depend on the others.

All branches are searched, which also tells all roots, what is reached and why there is no value. A sweep asks for none
of that (`values_only`): on the wanted branch it takes the nearest piece that has a root, with the same value.
"""

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass, field
from decimal import Decimal
from functools import cache, cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mechsheet import units
from mechsheet.worksheet.errors import SheetError, refuse
from mechsheet.worksheet.shown import Shown

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]
Index = NDArray[np.intp]
Function = Callable[[Array], Array]

_EPS = float(np.finfo(float).eps)
_SAMPLES = 97  # of an interval, dense at its ends: features narrower than 1/60 of it can be missed
_PLACES = (1 - np.cos(np.linspace(0, np.pi, _SAMPLES)))[:, None] / 2
_RISE = 64  # a local extreme is looked for within so many times its height above the samples beside it
_PASSED = 2.0**-10  # and not where its sample has passed the target by so many times: there the sign changes tell
_OCTAVES = 8  # either way from the guess, the range searched for the reachable interval
_STEPS = 8  # samples in each octave
_CLUSTER = 12  # samples between an edge and the next one
_BLOCK = 2**13  # values of f asked for at once: many more leave the processor's cache
# Where the next points of a bracket go: fractions of its width, from its low end and from a predicted place.
_COARSE = np.linspace(0, 1, 9)[1:-1, None, None]
_FINE = np.concatenate([-(8.0 ** -np.arange(2, 6)), [0], 8.0 ** -np.arange(2, 6)])[:, None, None]
_AROUND = np.array([-1, 0, 1])[:, None, None]
_BACK = np.array([-3, -2, -1])[:, None, None]
_BESIDE = np.array([-1, 1])[:, None, None, None] * 2.0 ** np.array([18, 21, 33])[:, None, None]  # floats off a root
_EVEN = np.array([-1, 0, 1])[:, None, None]
_MANY = np.arange(1, 16)[:, None, None] / 16

_values_only: ContextVar[bool] = ContextVar("values_only", default=False)


@contextmanager
def values_only() -> Iterator[None]:
    """Within it `find` computes values alone; roots, what is reached and reasons are computed when they are read."""
    token = _values_only.set(True)
    try:
        yield
    finally:
        _values_only.reset(token)


@dataclass(frozen=True)
class _Words:
    """What is asked, in words and display units."""

    unknown: str
    quantity: str
    unit: str
    unknown_unit: str


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
class Found(Shown):
    """The verdict of a solve block; numbers in SI, arrays for arrays of problems.

    Attributes
    ----------
    value : float
        The root on the wanted branch nearest the guess. Unsolved: reading it raises SheetError with the reason;
        in an array the element is NaN.
    branch : int or None
        The wanted branch.
    residual : float
        f - equals at ``value``; NaN where unsolved.
    bracket : tuple of float
        Interval that encloses ``value``: see `Root`.
    evaluations : int
        Values of f computed so far, over all problems and branches, sampling and verification included.
    roots : tuple of Root
        All roots of all branches in the interval, in ascending order.
    interval : tuple of float
        The interval searched on the wanted branch.
    reached : tuple of float
        Least and greatest f in that interval on the wanted branch, computed when it is read where all is solved; NaN
        where nothing is finite.
    reason : str
        Why there is no value; "" where solved.
    """

    _value: Any = field(repr=False)
    branch: int | None
    residual: Any
    bracket: tuple[Any, Any]
    interval: tuple[Any, Any]
    equals: Any
    words: _Words
    _evaluations: Callable[[], int] = field(repr=False)
    _compute: Callable[[], "_Everything"] = field(repr=False)

    @property
    def value(self) -> Any:
        if np.ndim(self._value) == 0 and not self.solved:
            refuse(SheetError(self.reason), self)
        return self._value

    @property
    def solved(self) -> Any:
        """Where there is a value."""
        solved = ~np.isnan(self._value)
        return solved if solved.ndim else bool(solved)

    @property
    def evaluations(self) -> int:
        return self._evaluations()

    @property
    def roots(self) -> tuple[Root, ...]:
        return self._everything.roots

    @property
    def reached(self) -> tuple[Any, Any]:
        return self._everything.reached()

    @property
    def reason(self) -> Any:
        return self._everything.reason

    @cached_property
    def _everything(self) -> "_Everything":
        return self._compute()

    def __str__(self) -> str:
        if isinstance(self.reason, str) and self.reason:
            return self.reason
        return f"{self.headline()}: " + ", ".join(f"{k} {v}" for k, v in self.details())

    def headline(self) -> str:
        """The unknown and its value, or how many problems are solved."""
        unknown, unit = self.words.unknown, self.words.unknown_unit
        if isinstance(self.reason, str):
            return unknown if self.reason else f"{unknown} = {_amount(unit, self._value, 6)}"
        count = f"{np.count_nonzero(self.solved)} of {self.reason.size} problems solved"
        return f"{unknown} = {_span(unit, self._value)}, {count}" if np.any(self.solved) else f"{unknown}, {count}"

    def failures(self) -> list[str]:
        """Why there is no value, of the first problems without one."""
        reasons = np.atleast_1d(self.reason)
        failed = np.argwhere(reasons != "").tolist()
        where = [f"problem {', '.join(map(str, i))}: " if np.ndim(self.reason) else "" for i in failed]
        texts = [w + reasons[tuple(i)] for w, i in zip(where[:3], failed[:3], strict=True)]
        return texts + [f"and {len(failed) - 3} more"] * (len(failed) > 3)

    def details(self) -> list[tuple[str, str]]:
        """How the value was found: what is said of it, and in words and numbers what it is."""
        words, single = self.words, isinstance(self.reason, str)
        on = "" if self.branch is None else f" on branch {self.branch:+d}"
        rows = [("condition", f"{words.quantity} = {_span(words.unit, self.equals)}{on}")]
        if np.any(self.solved):
            label = "residual" if single else "largest residual"
            rows.append((label, _amount(words.unit, np.nanmax(np.abs(self.residual)), 2)))
        if single and not self.reason:
            rows.append(("bracket", _span(words.unknown_unit, self.bracket)))
        if single:
            roots = [
                _amount(words.unknown_unit, root.value, 6) + (on and f" (branch {root.branch:+d})")
                for root in self.roots
            ]
            rows.append(("all roots", "; ".join(roots) or "none"))
        rows.append(("searched", _span(words.unknown_unit, self.interval)))
        return [*rows, ("evaluations", str(self.evaluations))]


@dataclass(frozen=True, eq=False)
class _Everything:
    """What the search of all branches tells: see `Found`."""

    roots: tuple[Root, ...]
    reached: Callable[[], tuple[Any, Any]]
    reason: Any


def find(
    f: Callable[..., Any],
    lo: ArrayLike | None = None,
    hi: ArrayLike | None = None,
    *,
    equals: ArrayLike = 0.0,
    guess: ArrayLike | None = None,
    branch: int | None = None,
    branches: Sequence[int] | None = None,
    unknown: str = "unknown x",
    quantity: str = "f(x)",
    unit: str = "-",
    unknown_unit: str = "-",
) -> Found:
    """Solve ``f(x) = equals`` for x in ``lo..hi`` and say how well, where else, or why not.

    Parameters
    ----------
    f : callable
        ``f(x)``, or ``f(x, branch)`` where ``branches`` are given: the quantity that must equal ``equals``; NaN
        where the mechanism does not close. It broadcasts: x has the shape of the problems behind one more axis.
        It is called with x inside the interval only.
    lo, hi : float, shape (...), optional
        The interval. An end that is not given is the end of the reachable interval: f is sampled on
        ``guess * 2**(k/8)``, k = -64..64, and the run of finite values around the finite sample nearest the guess
        is followed to the last float at which f is finite, or to the end of that range.
    equals : float, shape (...)
        The wanted value of f [unit].
    guess : float, shape (...), optional
        Chooses among several roots: the nearest one is the value, the smaller one of two as near. By default the
        middle of the interval. Positive where an end of the interval is not given.
    branch, branches : int, sequence of int, optional
        The wanted assembly branch, and all of them; the roots on the others are reported too.
    unknown, quantity : str
        Words and symbol, as in ``lifting rod L4``.
    unit, unknown_unit : str
        Display units of ``quantity`` and ``unknown``; all numbers here are SI.

    Returns
    -------
    Found
        Shape (...) is that of lo, hi, equals, guess and what f closes over, broadcast; floats for shape ().

    Raises
    ------
    SheetError
        An interval that is empty, an infinite number, NaN (in an array NaN leaves its problem unsolved), a guess
        that is missing or cannot be used. It is a ValueError.
    ValueError
        A branch that is not one of ``branches``.

    Notes
    -----
    x is exact to about two floats of the root of f as computed, near zero to 1e-31 of the interval. At a local
    extreme or an end of the interval, a value within one unit in the last place of the target, or nearer to it than
    f varies over the next eight floats, counts as a root that touches: so dead centres and double roots are kept.
    A sign change at a jump or a pole is no root. What f does within 1/60 of the interval can be missed.

    >>> find(lambda x: x**2, 0.0, 2.0, equals=2.0).value
    1.4142135623730951
    """
    if branch not in (branches or (None,)):
        raise ValueError(f"branch = {branch} of {unknown} must be one of {branches}")
    words = _Words(unknown, quantity, unit, unknown_unit)
    given = _checked(words, lo=lo, hi=hi, equals=equals, guess=guess)
    labels = [0] if branches is None else list(branches)
    functions = [f] if branches is None else [_on_branch(f, s) for s in labels]
    wanted = 0 if branch is None else labels.index(branch)

    given = dict(zip(given, np.broadcast_arrays(*given.values()), strict=True))
    void = np.isnan(list(given.values())).any(0)
    if void.all():
        return _nothing(words, branch, void.shape)
    given = {name: np.where(void, v[~void][0], v) for name, v in given.items()}  # f sees no NaN
    start = given["guess"] if lo is None or hi is None else given["lo"] / 2 + given["hi"] / 2
    first = _values(functions[wanted], start)  # its shape shows what f closes over
    shape = np.broadcast_shapes(void.shape, first.shape)
    void = np.broadcast_to(void, shape).reshape(-1)
    flat = {name: np.broadcast_to(v, shape).reshape(-1) for name, v in given.items()}
    own, every = _Counted([functions[wanted]], shape), _Counted(functions, shape)

    def shaped(a: NDArray[Any]) -> Any:
        return a.reshape(shape) if shape else a.item()

    @cache
    def search_all() -> _Search:
        columns = {name: np.tile(v, len(labels)) for name, v in flat.items()}  # branches x problems
        return _search(every, columns, np.tile(void, len(labels)))

    at = wanted * void.size + np.arange(void.size)

    def everything() -> _Everything:
        search = search_all()
        reasons = np.full(void.size, "", dtype=object)
        for i in np.flatnonzero(np.isnan(value)):
            reasons[i] = _reason(words, flat["equals"][i], search, at[i])
            own_roots = [(s, x) for k, s in enumerate(labels) for x in search.roots[0, :, k * void.size + i]]
            places = [f"at {_amount(unknown_unit, x)} on branch {s:+d}" for s, x in own_roots if np.isfinite(x)]
            reasons[i] += f"; it is reached {', '.join(places)}" if places else ""
        roots = tuple(
            Root(shaped(x), shaped(s), shaped(r), (shaped(a), shaped(b)))
            for x, r, a, b, s in _together(search.roots, labels)
        )
        return _Everything(
            roots, lambda: (shaped(search.reached[0, at]), shaped(search.reached[1, at])), shaped(reasons)
        )

    answer = _nearest(own, flat) if _values_only.get() else search_all().nearest(at, flat.get("guess"))
    low, high, value, residual, *bracket = (np.where(void, np.nan, numbers) for numbers in answer)
    found = Found(
        _value=shaped(value),
        branch=branch,
        residual=shaped(residual),
        bracket=(shaped(bracket[0]), shaped(bracket[1])),
        interval=(shaped(low), shaped(high)),
        equals=shaped(np.where(void, np.nan, flat["equals"])),
        words=words,
        _evaluations=lambda: first.size + own.count + every.count,
        _compute=everything,
    )
    if not _values_only.get():
        _ = found.reason  # at once, because what f closes over may change
    return found


def _nothing(words: _Words, branch: int | None, shape: tuple[int, ...]) -> Found:
    """The verdict on problems none of which has an interval, a target and a guess."""
    none = np.full(shape, np.nan)
    everything = _Everything((), lambda: (none, none), np.full(shape, _without_numbers(words), dtype=object))
    return Found(none, branch, none, (none, none), (none, none), none, words, lambda: 0, lambda: everything)


def _checked(words: _Words, **numbers: ArrayLike | None) -> dict[str, Array]:
    """The numbers that are given, as arrays; SheetError for the first that cannot be used."""
    given = {name: np.asarray(v, dtype=float) for name, v in numbers.items() if v is not None}
    for name, v in given.items():
        bad = ~np.isfinite(v) if v.ndim == 0 else np.isinf(v)
        if bad.any():
            raise SheetError(f"{name} = {v[bad][0]} for {words.unknown} must be finite")
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
        least = _amount(words.unknown_unit, np.nanmin(given["guess"]))
        raise SheetError(f"guess = {least} for {words.unknown} must be positive, or give both ends of its interval")
    return given


def _in_order(words: _Words, names: tuple[str, str], low: Array, high: Array) -> None:
    low, high = np.broadcast_arrays(low, high)
    for a, b in zip(low[low >= high], high[low >= high], strict=True):
        small, large = (_amount(words.unknown_unit, v) for v in (a, b))
        raise SheetError(f"{names[0]} = {small} for {words.unknown} must be less than {names[1]} = {large}")


def _on_branch(f: Callable[..., Any], s: int) -> Function:
    return lambda x: f(x, s)


def _values(f: Function, x: Array) -> Array:
    """f(x) as floats, NaN where not finite; probing out of reach is no reason for numpy's warnings."""
    with np.errstate(all="ignore"):
        y = np.asarray(f(x))
    if y.dtype.kind not in "fiu":
        raise TypeError(f"the function to solve must return real numbers, not {y.dtype}")
    infinite = np.isinf(y)
    return np.where(infinite, np.nan, y) if infinite.any() else y


class _Counted:
    """f of x, shape (..., branches x problems), which knows how many of its values were computed."""

    def __init__(self, functions: list[Function], shape: tuple[int, ...]) -> None:
        self.functions, self.shape, self.count = functions, shape, 0

    def __call__(self, x: Array) -> Array:
        if x.size == 0:
            return x
        self.count += x.size
        columns = x.reshape(-1, len(self.functions), *self.shape)
        y = np.empty_like(columns)
        block = max(1, _BLOCK * len(columns) * len(self.functions) // x.size)
        for k, f in enumerate(self.functions):
            for i in range(0, len(columns), block):
                y[i : i + block, k] = _values(f, columns[i : i + block, k])
        return y.reshape(x.shape)


@dataclass(frozen=True)
class _Search:
    """Result for all columns c, branches x problems.

    ``roots`` has rows x, residual and bracket ends, shape (4, R, c), in ascending order, NaN where there is none;
    ``interval`` and ``reached`` have shape (2, c), ``jump`` (c).
    """

    roots: Array
    interval: Array
    jump: Array
    void: Mask
    pieces: "_Pieces"
    f: _Counted

    def nearest(self, columns: Index, near: Array | None) -> tuple[Array, ...]:
        """The same as `_nearest` for some columns: by default nearest to the middle of the interval."""
        lo, hi = self.interval[:, columns]
        return lo, hi, *_closest(self.roots[:, :, columns], lo / 2 + hi / 2 if near is None else near)

    @cached_property
    def reached(self) -> Array:
        """Least and greatest f; its extremes are looked for when this is read: where all is solved nobody asks."""
        with np.errstate(all="ignore"):
            x, y = self.pieces.x, self.pieces.y
            i, valid = _slots(_turning(y))
            around = np.maximum(i, 1) + _AROUND
            top = _extreme(self.f, _at(x, around), _at(y, around), valid, self.pieces.floor)[1]
            y = np.concatenate([y, np.where(valid, top, np.nan)])
            reached = np.stack([np.fmin.reduce(y), np.fmax.reduce(y)])
        reached[:, self.void] = np.nan
        return reached


@dataclass(frozen=True)
class _Pieces:
    """Monotone pieces of f in all columns: rows of x with f and the residual, some of which touch the target.

    ``cross`` marks the pieces, from each row to the next one, whose ends differ in sign.
    """

    x: Array
    y: Array
    r: Array
    touch: Mask
    cross: Mask
    equals: Array
    floor: Array


@np.errstate(all="ignore")
def _nearest(f: _Counted, given: dict[str, Array]) -> tuple[Array, ...]:
    """The interval, and the root nearest the guess: x, residual and bracket ends, NaN where there is none."""
    lo, hi = _interval(f, given)
    near = given.get("guess", lo / 2 + hi / 2)
    pieces = _pieces(f, lo, hi, given["equals"])
    if pieces.touch.any():
        return lo, hi, *_closest(_roots(f, pieces)[0], near)
    i, valid = _slots(pieces.cross)
    least = np.maximum(np.maximum(_at(pieces.x, i) - near, near - _at(pieces.x, i + 1)), 0)
    least = np.where(valid, least, np.inf)  # distance at which the root of a piece can lie
    root, distance = np.full((4, near.size), np.nan), np.full(near.size, np.inf)
    for _ in i:
        k = least.argmin(0)[None]
        active = np.isfinite(_at(least, k)) & (_at(least, k) <= distance)
        if not active.any():
            break
        new = _crossing(f, pieces, _at(i, k), active)[0][:, 0]
        further = np.abs(new[0] - near)
        better = (further < distance) | ((further == distance) & (new[0] < root[0]))
        root, distance = np.where(better, new, root), np.where(better, further, distance)
        least[k[0], np.arange(near.size)] = np.inf
    return lo, hi, *root


def _closest(roots: Array, near: Array) -> Array:
    """Of all roots of each column, rows as in `_Search`, the one nearest to a place."""
    nearest = np.fmin(np.abs(roots[0] - near), np.inf).argmin(0)
    closest: Array = roots[:, nearest, np.arange(near.size)]
    return closest


@np.errstate(all="ignore")
def _search(f: _Counted, given: dict[str, Array], void: Mask) -> _Search:
    """Everything about all columns, NaN for the void ones."""
    lo, hi = _interval(f, given)
    pieces = _pieces(f, lo, hi, given["equals"])
    roots, jump = _roots(f, pieces)
    interval = np.stack([lo, hi])
    for numbers in (roots, interval):
        numbers[..., void] = np.nan
    return _Search(roots, interval, jump, void, pieces, f)


def _interval(f: _Counted, given: dict[str, Array]) -> tuple[Array, Array]:
    """Ends of the interval given, or of the reachable one."""
    if "lo" in given and "hi" in given:
        return given["lo"], given["hi"]
    return _reachable(f, given["guess"], given.get("lo"), given.get("hi"))


def _pieces(f: _Counted, lo: Array, hi: Array, equals: Array) -> _Pieces:
    floor = _EPS**2 * (hi - lo)
    x = lo * (1 - _PLACES) + hi * _PLACES
    x[0], x[-1] = lo, hi
    y = f(x)
    if np.isnan(y).any():
        x, y = _with_edges(f, x, y)
    r = y - equals
    turn = _turning(y)
    row, column = turn.nonzero()
    own, beside = y[row, column], y[[row - 1, row + 1], column]
    rise = np.abs(own - beside).max(0)
    passed = np.where(own > beside[1], 1, -1) * r[row, column]
    turn[row, column] = (passed >= -_RISE * rise) & (passed <= _PASSED * rise)
    if turn.any():
        x, y, turn = _with_turns(f, x, y, turn, floor)
        r = y - equals
    touch, end = _touching(f, x, y, r, equals, turn, floor)
    below, above = r < 0, r > 0
    cross = (below[:-1] & above[1:]) | (above[:-1] & below[1:])
    inner = touch & ~end
    cross &= ~(inner[:-1] | inner[1:])  # beside a touching root the sign is rounding
    return _Pieces(x, y, r, touch, cross, equals, floor)


def _roots(f: _Counted, pieces: _Pieces) -> tuple[Array, Array]:
    """All roots as in `_Search`, and the first jump over the target."""
    x, touch = pieces.x, pieces.touch
    crossing, jump = _crossing(f, pieces, *_slots(pieces.cross))
    i, valid = _slots(touch)
    at = _at(x, i)
    again = (np.abs(crossing[0] - at[:, None]) <= 2**12 * _ulp(at, pieces.floor)[:, None]).any(1)  # beside an end
    touching = np.where(valid & ~again, np.stack([at, _at(pieces.r, i), at, at]), np.nan)
    roots = np.concatenate([crossing, touching, np.full((4, 1, x.shape[1]), np.nan)], axis=1)
    order = roots[0].argsort(axis=0, kind="stable")
    return roots[:, order, np.arange(x.shape[1])], jump


def _reachable(f: _Counted, guess: Array, lo: Array | None, hi: Array | None) -> tuple[Array, Array]:
    """The run of finite f around the finite sample nearest the guess, between the ends that are given."""
    k = np.arange(-_OCTAVES * _STEPS, _OCTAVES * _STEPS + 1)[:, None] / _STEPS
    x = np.clip(guess * 2.0**k, lo, hi)
    y = f(x)
    finite = np.isfinite(y)
    row, bottom = np.arange(len(k))[:, None], len(k) - 1
    start = np.where(finite, np.abs(k), np.inf).argmin(0)
    first = np.where(~finite & (row < start), row + 1, 0).max(0)
    last = np.where(~finite & (row > start), row - 1, bottom).min(0)
    beyond = np.stack([np.maximum(first - 1, 0), np.minimum(last + 1, bottom)])
    closes = finite.any(0)
    run = np.where(closes, np.stack([first, last]), [[0], [bottom]])
    below, above = _edge(f, x, y, run, np.where(closes, beyond, run))
    return below if lo is None else lo, above if hi is None else hi


def _with_edges(f: _Counted, x: Array, y: Array) -> tuple[Array, Array]:
    """The samples with the edges between finite and NaN, and more samples towards each edge.

    f ends like a square root where a dyad stretches; samples spaced by squares see a smooth function.
    """
    finite = np.isfinite(y)
    i, valid = _slots(finite[:-1] != finite[1:])
    inside = i + (valid & _at(finite, i + 1))
    edge = _edge(f, x, y, inside, np.where(valid, 2 * i + 1 - inside, inside))
    more = edge + (_at(x, inside) - edge) * (np.arange(_CLUSTER) / _CLUSTER)[:, None, None] ** 2
    more_y = np.where(valid, f(more), np.nan)
    more = np.where(valid, more, x[0])  # what fills the rows sorts before the first sample
    x, y = np.concatenate([*more, x]), np.concatenate([*more_y, y])
    order = x.argsort(axis=0, kind="stable")
    return _at(x, order), _at(y, order)


def _edge(f: _Counted, x: Array, y: Array, inside: Index, outside: Index) -> Array:
    """The last float at which f is finite on the way from row ``inside``, where it is, to row ``outside``.

    Where a dyad stretches, x is a parabola in f, whose vertex is the edge.
    """
    way = np.where(outside < inside, -1, 1)
    rows = np.clip(inside - way * np.array([2, 1, 0])[:, None, None], 0, len(x) - 1)
    rows = np.where(np.isfinite(_at(y, rows)), rows, inside)
    x, y, out = way * _at(x, rows), _at(y, rows), way * _at(x, outside)  # the way is up now
    while True:
        last = x[2]
        active = np.nextafter(last, out) < out
        if not active.any():
            edge: Array = way * last
            return edge
        slope = (x[1] - last) / (y[1] - y[2])
        bend = ((x[0] - x[1]) / (y[0] - y[1]) - slope) / (y[0] - y[2])
        to_vertex = (y[1] - y[2] - slope / bend) / 2
        vertex = last + to_vertex * (slope + bend * (to_vertex + y[2] - y[1]))
        x_all, y_all = _closer(lambda u: f(way * u), x, y, last, np.where(active, out, last), vertex)
        k = np.logical_and.accumulate(np.isfinite(y_all)).sum(0)
        out = np.where(active, _take(np.concatenate([x_all, out[None]]), k[None])[0], out)
        x, y = (np.where(active, _take(v, k + _BACK), v_old) for v, v_old in ((x_all, x), (y_all, y)))


def _closer(f: Function, x: Array, y: Array, low: Array, high: Array, near: Array) -> tuple[Array, Array]:
    """The points x, y and more between low and high: a coarse comb, and a fine one around a predicted place."""
    width = high - low
    near = np.where((low < near) & (near < high), near, (low + high) / 2)
    two = 2 * _EPS * np.abs(near)
    new = np.concatenate([low + _COARSE * width, near + _FINE * width, [near - two, near + two]])
    new = np.clip(new, low, high)
    x, y = np.concatenate([x, new]), np.concatenate([y, f(new)])
    order = x.argsort(axis=0, kind="stable")
    return _take(x, order), _take(y, order)


def _turning(y: Array) -> Mask:
    """Samples that are local extremes: not beyond the one before, and not level with the next one."""
    turn = np.zeros(y.shape, dtype=bool)
    left, own, right = y[:-2], y[1:-1], y[2:]
    turn[1:-1] = ((own <= left) & (own < right)) | ((own >= left) & (own > right))
    return turn


def _with_turns(f: _Counted, x: Array, y: Array, turn: Mask, floor: Array) -> tuple[Array, Array, Mask]:
    """The samples with each of these local extremes of f in place of the sample beside it, and where they are."""
    i, valid = _slots(turn)
    around = np.maximum(i, 1) + _AROUND
    where = i[valid], np.broadcast_to(np.arange(x.shape[1]), i.shape)[valid]
    x_turn, y_turn = _extreme(f, _at(x, around), _at(y, around), valid, floor)
    x[where], y[where] = x_turn[valid], y_turn[valid]
    order = x.argsort(axis=0, kind="stable")
    return _at(x, order), _at(y, order), _at(turn, order)


def _extreme(f: _Counted, x: Array, y: Array, active: Mask, floor: Array) -> tuple[Array, Array]:
    """The extreme of f between three points whose middle value is the least or the greatest.

    The next one is near the vertex of the parabola through the three. Its neighbours must rise above it by more
    than rounding; where that no longer narrows the three, f is level.
    """
    sign = np.where(y[1] > np.fmin(y[0], y[2]), -1, 1)
    y = sign * y
    while active.any():
        low, mid, high = x
        p, q = (mid - low) * (y[1] - y[2]), (mid - high) * (y[1] - y[0])
        vertex = mid - ((mid - low) * p - (mid - high) * q) / (2 * (p - q))
        x_all, y_all = _closer(lambda u: sign * f(u), x, y, low, np.where(active, high, low), vertex)
        best = np.fmin(y_all, np.inf).argmin(0)
        row = np.arange(len(x_all))[:, None, None]
        above = y_all > _take(y_all, best[None]) + 4 * _EPS * np.abs(y).max(0)
        left = np.where(above & (row < best), row, 0).max(0)
        right = np.where(above & (row > best), row, row[-1]).min(0)
        rows = np.stack([left, best, right])
        x, y = (np.where(active, _take(v, rows), v_old) for v, v_old in ((x_all, x), (y_all, y)))
        active = active & (x[2] - x[0] < (high - low) / 2) & (x[2] - x[0] > 4 * _ulp(mid, floor))
    return x[1], sign * y[1]


def _touching(f: _Counted, x: Array, y: Array, r: Array, equals: Array, turn: Mask, floor: Array) -> tuple[Mask, Mask]:
    """Which turns, ends and exact hits meet the target within what f varies over the next few floats; and the ends.

    On the calmer side of a turn, so that a jump beside it is no excuse.
    """
    out = np.pad(np.isnan(y), ((1, 1), (0, 0)), constant_values=True)
    end = (out[:-2] | out[2:]) & ~out[1:-1]
    row, column = end.nonzero()
    next_ = np.where(out[row, column], row + 1, row - 1) % len(y)
    own, target = y[row, column], equals[column]
    unit = np.spacing(np.maximum(np.abs(own), np.abs(target)))
    touch = turn | (r == 0)
    touch[row, column] |= ~(np.abs(own - target) > np.abs(own - y[next_, column]) + unit)
    if not touch.any():
        return touch, end
    i, valid = _slots(touch)
    at, own = _at(x, i), _at(y, i)
    near = at + np.array([[-1, -2, -4, -8], [1, 2, 4, 8]])[..., None, None] * _ulp(at, floor)
    beside = f(np.clip(near, x[0], x[-1]))
    spread = np.fmax(np.fmax.reduce(beside, axis=1), own) - np.fmin(np.fmin.reduce(beside, axis=1), own)
    play = np.where(_at(end, i), spread.max(0), spread.min(0))
    unit = np.spacing(np.maximum(np.abs(own), np.abs(equals)))
    hit = valid & (np.abs(own - equals) <= play + unit)
    touch = np.zeros_like(turn)
    touch[i[hit], np.broadcast_to(np.arange(x.shape[1]), i.shape)[hit]] = True
    touch[1:] &= (r[1:] != 0) | (r[:-1] != 0)  # a run of zeros counts once
    return touch, end


def _crossing(f: _Counted, pieces: _Pieces, i: Index, valid: Mask) -> tuple[Array, Array]:
    """Roots in the pieces i, shape (4, R, p) as in `_Search`, and the first jump.

    At a root the residual is small against what it is, and against what it varies, a little way off; at a pole it
    is not the first, at a jump not the second.
    """
    x, r, equals, floor = pieces.x, pieces.r, pieces.equals, pieces.floor

    def g(u: Array) -> Array:
        return f(u) - equals

    lower = np.abs(_at(r, i)) < np.abs(_at(r, np.minimum(i + 1, len(x) - 1)))
    third = np.clip(np.where(lower, i - 1, i + 2), 0, len(x) - 1)
    rows = np.stack([i, np.minimum(i + 1, len(x) - 1), third])
    ends, r_ends = _bracketed(g, _at(x, rows), _at(r, rows), valid, floor)
    best = np.abs(r_ends[1]) < np.abs(r_ends[0])
    root, off = np.where(best, ends[1], ends[0]), np.where(best, r_ends[1], r_ends[0])
    ends, r_ends = np.where(off == 0, root, ends), np.where(off == 0, 0, r_ends)

    beside = np.clip(ends[:, None] + _BESIDE * _ulp(root, floor), x[0], x[-1])
    around = np.concatenate([r_ends[:, None], g(beside)], axis=1)
    varies = (np.fmax.reduce(around, axis=1) - np.fmin.reduce(around, axis=1)).max(0)
    away = np.fmax.reduce(np.abs(around[:, 1:]), axis=(0, 1))
    unit = np.spacing(np.maximum(np.abs(equals), np.abs(off)))
    sound = np.abs(off) <= 4 * np.minimum(varies, away) + 4 * unit
    roots = np.where(valid & sound, np.stack([root, off, *ends]), np.nan)
    return roots, np.fmin.reduce(np.where(valid & ~sound, root, np.nan), axis=0, initial=np.nan)


def _bracketed(g: Function, x: Array, r: Array, active: Mask, floor: Array) -> tuple[Array, Array]:
    """The final brackets of the roots between x[0] and x[1], whose residuals r have opposite signs.

    The next points are the zero of the parabola x(r) through the bracket and the point x[2] beside it, and one on
    either side: as far off as half way to the zero of the line, and farther where that has not narrowed the bracket to
    a quarter. Where it has not three times, and at the end, where f is rounding, the points are evenly spaced. Where it
    has not there are more of them: a jump must be closed in to the last float to be told from a root.
    """
    poor = np.zeros(active.shape)
    while True:
        (a, b, c), (r_a, r_b, r_c) = x, r
        width, unit = b - a, _ulp(b, floor)
        active = active & (width > 4 * unit) & (r_a != 0) & (r_b != 0)
        if not active.any():
            return x[:2], r[:2]
        line = a - width * r_a / (r_b - r_a)
        to_b, to_c = width * r_c / ((r_b - r_a) * (r_b - r_c)), (c - a) * r_b / ((r_c - r_a) * (r_c - r_b))
        parabola = a + r_a * (to_b + to_c)
        zero = np.where((a < parabola) & (parabola < b), parabola, line)
        off = np.abs(parabola - line) / 2
        off = np.maximum(np.where(off < width, off, width / 4), 8 ** (1 + poor) * unit)
        even = ~((a < zero) & (zero < b)) | (width <= 64 * unit) | (poor > 2)
        new = np.where(even, a + width / 2, zero) + _EVEN * np.where(even, width / 4, off)
        many = active & (poor > 2) & (width > 64 * unit)
        if many.any():  # the others stay as they would be alone: what they do not need stands at their end b
            rest = np.broadcast_to(b, (len(_MANY) - len(new), *b.shape))
            new = np.where(many, a + _MANY * width, np.concatenate([new, rest]))
        x, r = _narrowed(g, x, r, np.clip(new, a, b), active)
        poor = np.where(x[1] - x[0] > width / 4, poor + 1, np.where(even & (poor > 2), poor, 0))


def _narrowed(g: Function, x: Array, r: Array, new: Array, active: Mask) -> tuple[Array, Array]:
    """The first change of sign between the ends x[0] and x[1] and the new points, and the point beside it."""
    new = np.where(active, new, x[0])
    x_all, r_all = np.concatenate([x[:1], new, x[1:2]]), np.concatenate([r[:1], g(new), r[1:2]])
    side = np.sign(r_all)
    k = (side[1:] != side[:-1]).argmax(0)
    rows = np.stack([k, k + 1, np.where(k > 0, k - 1, k + 2)])
    return np.where(active, _take(x_all, rows), x), np.where(active, _take(r_all, rows), r)


def _ulp(x: Array, floor: Array) -> Array:
    return _EPS * np.abs(x) + floor


def _slots(mask: Mask) -> tuple[Index, Mask]:
    """Rows of the true elements of each column, shape (K, p), and which of these slots are filled."""
    row, column = mask.nonzero()
    count = np.bincount(column, minlength=mask.shape[1])
    order = column.argsort(kind="stable")
    place = np.arange(len(order)) - np.repeat(count.cumsum() - count, count)
    rows = np.zeros((count.max(initial=0), mask.shape[1]), dtype=np.intp)
    rows[place, column[order]] = row[order]
    return rows, np.arange(len(rows))[:, None] < count


def _at(values: NDArray[Any], rows: NDArray[Any]) -> NDArray[Any]:
    """The given rows of each column, shape of ``rows``."""
    picked: NDArray[Any] = values[rows, np.arange(values.shape[1])]
    return picked


def _take(values: Array, rows: Index) -> Array:
    """The given rows of each slot and column; numpy's take_along_axis, five times as fast."""
    flat = values.reshape(len(values), -1)
    return flat[rows.reshape(len(rows), -1), np.arange(flat.shape[1])].reshape(rows.shape)


def _together(roots: Array, labels: list[int]) -> Iterator[tuple[NDArray[Any], ...]]:
    """The roots of all branches, in ascending order: x, residual, bracket ends, branch of each problem."""
    roots = roots.reshape(4, -1, roots.shape[2] // len(labels))
    order = roots[0].argsort(axis=0, kind="stable")
    for row in order[: np.isfinite(roots[0]).sum(0).max(initial=0)]:
        x, *more = roots[:, row, np.arange(row.size)]
        yield x, *more, np.where(np.isnan(x), 0, np.take(labels, row % len(labels)))


def _reason(words: _Words, equals: float, search: _Search, c: int) -> str:
    """Why there is no root in column c."""
    at, unit = words.unknown_unit, words.unit
    least, greatest = search.reached[:, c]
    if np.isnan(search.interval[:, c]).any():
        return _without_numbers(words)
    if np.isnan(least):
        return f"nothing closes for {words.unknown} in {_span(at, search.interval[:, c])}"
    low, high, target = _texts(unit, least, greatest, equals)
    reach = low if low == high else f"{low}..{high}"
    if not least <= equals <= greatest:
        return f"{words.unknown}: {words.quantity} reaches {reach}{_suffix(unit)}, {target}{_suffix(unit)} is outside"
    where = "" if np.isnan(search.jump[c]) else f" at {_amount(at, search.jump[c])}"
    verdict = f"reaches {reach}{_suffix(unit)} but jumps over {target}{_suffix(unit)}{where}"
    return f"{words.unknown}: {words.quantity} {verdict}"


def _without_numbers(words: _Words) -> str:
    return f"nothing to solve for {words.unknown}: its interval, target or guess is NaN"


def _texts(unit: str, *values: float, digits: int = 4) -> list[str]:
    """The SI numbers in a display unit, with as many digits as tell unequal ones apart (17 always do)."""
    factor = Decimal(repr(float(units.parse(unit).factor)))
    shown = [Decimal(float(v)) / factor for v in values]
    while True:
        rounded = [Decimal(f"{v:.{digits - 1}e}").normalize() for v in shown]
        if len(set(rounded)) == len(set(shown)) or digits == 17:
            return [f"{v:f}" if -6 < v.adjusted() < 15 else f"{v:e}" for v in rounded]
        digits += 1


def _suffix(unit: str) -> str:
    return "" if unit == "-" else f" {unit}"


def _amount(unit: str, value: float, digits: int = 4) -> str:
    return _texts(unit, value, digits=digits)[0] + _suffix(unit)


def _span(unit: str, values: ArrayLike) -> str:
    """Least..greatest of the values, one number where they are equal."""
    texts = _texts(unit, np.nanmin(values), np.nanmax(values))
    return "..".join(dict.fromkeys(texts)) + _suffix(unit)
