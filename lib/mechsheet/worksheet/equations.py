"""What is asked of a solve block of several unknowns: its equations, and where each unknown is looked for."""

import inspect
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mechsheet import units
from mechsheet.mechanics.arguments import first_of, shape_error, unmasked
from mechsheet.mechanics.brackets import Array, Mask
from mechsheet.mechanics.rows import Parts, one_by_one, takes_arrays
from mechsheet.mechanics.starts import Place
from mechsheet.worksheet import numbers
from mechsheet.worksheet.errors import SheetError, as_given, measured, nearest

Start = ArrayLike | tuple[ArrayLike, ArrayLike]  # a guess, or the ends of an interval

_BLOCK = 2**13  # values of the equations asked for at once: many more leave the processor's cache


class Words(NamedTuple):
    """What is asked, in words and display units; of a complex equation both parts."""

    names: tuple[str, ...]
    units: tuple[str, ...]
    equations: tuple[str, ...] = ()
    equation_units: tuple[str, ...] = ()
    guessed: bool = True

    @property
    def unknowns(self) -> str:
        return ", ".join(self.names)

    def unit_of(self, unknown: str) -> str:
        return self.units[self.names.index(unknown)]

    def point(self, x: Sequence[float]) -> str:
        shown = (f"{name} = {numbers.extent(v, unit)}" for name, v, unit in zip(self.names, x, self.units, strict=True))
        return ", ".join(shown)


class Asked(NamedTuple):
    """A solve block of several unknowns: problems of a ``shape``, p in all, the ``void`` ones without numbers.

    ``interval`` has the two ends, or twice the guess, of each unknown as given; ``place`` is of all unknowns and
    problems, its parts of shape (n, p).
    ``equations`` are None where all problems are void.
    """

    words: Words
    interval: Mapping[str, tuple[Any, Any]]
    shape: tuple[int, ...]
    void: Mask
    place: Place
    equations: "Equations | None"

    @property
    def weights(self) -> Array:
        """Units of the equations, shape (m, 1, 1)."""
        return np.array([units.parse(unit).factor for unit in self.words.equation_units])[:, None, None]


def asked(
    f: Callable[..., Any],
    equals: Any,
    unit: str | Sequence[str],
    unknown_unit: str | Sequence[str],
    unknowns: Mapping[str, Start],
    least: bool,
) -> Asked:
    """What is asked; SheetError for what cannot be."""
    names = tuple(unknowns)
    words = Words(names, _each(unknown_unit, len(names), "unknown_unit", "unknowns"))
    _match(f, names)
    places = {n: _place(n, value, u) for (n, value), u in zip(unknowns.items(), words.units, strict=True)}
    shape = common_shape({name: p.first for name, p in places.items()})
    interval = {name: (p.first[()], p.last[()]) for name, p in places.items()}
    parts = zip(*places.values(), strict=True)
    place = Place(*(np.stack([np.broadcast_to(a, shape) for a in part]) for part in parts))
    void = np.isnan(np.stack(place)).any((0, 1))
    guessed = bool(np.array_equal(place.first, place.last, equal_nan=True))
    if void.all():
        words = _with_equations(words, [False] * len(names), unit if isinstance(unit, str) else "-", guessed)
        return Asked(words, interval, void.shape, void.reshape(-1), place, None)
    place = Place(*(np.where(void, part[:, ~void][:, :1].reshape(-1, *[1] * void.ndim), part) for part in place))
    values = _values(f, names)
    first = values((place.first / 2 + place.last / 2).reshape(len(names), -1)[:, 0])
    targets = _targets(equals, len(first))
    shape = np.broadcast_shapes(void.shape, *(a.shape for a in (*first, *targets)))
    complex_ = [np.iscomplexobj(v) or np.iscomplexobj(t) for v, t in zip(first, targets, strict=True)]
    words = _with_equations(words, complex_, unit, guessed)
    m, n = len(words.equations), len(names)
    counted = f"{m} equation{'s' * (m > 1)} for {n} unknown{'s' * (n > 1)} {words.unknowns}"
    if m < n:
        array = ": an array is one of as many problems, several are a tuple" if any(v.ndim for v in first) else ""
        raise SheetError(f"{counted}: they do not determine them{array}")
    if m > n and not least:
        raise SheetError(f"{counted}: minerr finds where their squares are least")
    lost = np.any([np.broadcast_to(x, shape) for x in (void, *map(np.isnan, targets))], axis=0).reshape(-1)
    if lost.all():
        return Asked(words, interval, shape, lost, place, None)
    alone = shape if any(v.ndim for v in first) else ()
    more = [1] * (len(shape) - void.ndim)  # axes of what f closes over
    flat = Place(*(np.broadcast_to(v.reshape(n, *more, *void.shape), (n, *shape)).reshape(n, -1) for v in place))
    tried = np.stack([flat.first / 2 + flat.last / 2, flat.first + flat.size / 8], axis=1)
    tried = tried.reshape(n, 2, *shape) if alone else tried[..., 0]
    if not takes_arrays(values, tried, alone):
        values = one_by_one(values, alone)
    return Asked(words, interval, shape, lost, flat, Equations(values, shape, targets, complex_))


class Equations:
    """Equations less what they equal, in real parts: of unknowns (n, k, p) the residuals (m, k, p)."""

    def __init__(self, values: Parts, shape: tuple[int, ...], targets: Sequence[Any], complex_: Sequence[bool]) -> None:
        self.values, self.shape, self.targets, self.complex = values, shape, targets, complex_

    def __call__(self, x: Array) -> Array:
        rows = max(1, _BLOCK // x.shape[2])
        return np.concatenate([self._left(x[:, i : i + rows]) for i in range(0, x.shape[1], rows)], axis=1)

    def _left(self, x: Array) -> Array:
        values = self.values(x.reshape(*x.shape[:2], *self.shape))
        left = [v - t for v, t in zip(values, self.targets, strict=True)]
        parts = [p for v, two in zip(left, self.complex, strict=True) for p in ((v.real, v.imag) if two else (v,))]
        y = np.stack(parts).reshape(len(parts), *x.shape[1:]).astype(float)
        return np.where(np.isfinite(y), y, np.nan)


def _values(f: Callable[..., Any], names: tuple[str, ...]) -> Parts:
    """The equations of unknowns in the order of their names."""

    def values(x: Array) -> list[NDArray[Any]]:
        with np.errstate(all="ignore"):
            return _parts(f(**dict(zip(names, x, strict=True))))

    return values


def _parts(values: Any) -> list[NDArray[Any]]:
    """The equations as f gives them: several, or one."""
    several = list(values) if isinstance(values, tuple | list) else [values]
    parts = [unmasked(v) for v in several]
    for part in parts:
        if part.dtype.kind not in "fciu":
            raise TypeError(f"each equation must be a number, left side less right side, not {first_of(part)}")
    return parts


def _targets(equals: Any, count: int) -> list[NDArray[Any]]:
    several = list(equals) if isinstance(equals, tuple | list) else [equals] * count
    if len(several) != count:
        raise SheetError(f"equals has {len(several)} values for {count} equations")
    targets = [unmasked(v) for v in several]
    for target in targets:
        if target.dtype.kind not in "fciub":
            raise SheetError(f"equals = {as_given(equals)} must be numbers")
    return targets


def real_numbers(value: ArrayLike | None, name: str, of: str = "") -> Array:
    """What is given as numbers, NaN where it is masked; SheetError that names it where it is none, such as a text."""
    try:
        if value is None or np.asarray(value).dtype.kind in "cSU":
            raise TypeError
        return unmasked(value, float)
    except (TypeError, ValueError, OverflowError):  # of numpy's: they do not say of what
        raise SheetError(f"{name} = {as_given(value)}{of and f' for {of}'} must be real numbers") from None


def common_shape(given: Mapping[str, Array]) -> tuple[int, ...]:
    """The shape of the problems that numbers by their names are of; SheetError where they do not broadcast."""
    if len({x.shape for x in given.values() if x.ndim}) > 1 and (error := shape_error(given)):
        raise SheetError(str(error))
    return np.broadcast_shapes(*(x.shape for x in given.values()))


def _match(f: Callable[..., Any], names: tuple[str, ...]) -> None:
    """Refuse unknowns that are not those which f takes."""
    parameters = inspect.signature(f).parameters.values()
    if any(p.kind is p.VAR_KEYWORD for p in parameters):
        return
    taken = [p.name for p in parameters if p.default is p.empty]
    if sorted(taken) != sorted(names):
        raise SheetError(f"the equations are of {', '.join(taken)}, the unknowns given are {meant(names)}")


def meant(unknowns: Iterable[str]) -> str:
    """Unknowns that are given, with the word of find that one of them may be."""
    near = next((near[0] for name in unknowns if (near := nearest(name, WORDS))), "")
    return ", ".join(unknowns) + (f" (did you mean {near}?)" if near else "")


WORDS = ("equals", "guess", "branch", "branches", "unknown", "quantity", "unit", "unknown_unit")  # of find


def _place(name: str, value: Start, unit: str) -> Place:
    """Where an unknown is looked for: around a guess, or in an interval."""
    interval, factor = isinstance(value, tuple), units.parse(unit).factor
    ends = [real_numbers(v, name) for v in (value if isinstance(value, tuple) else (value,))]
    if interval and len(ends) != 2:
        raise SheetError(f"{name} needs a guess, or the two ends of its interval, not {len(ends)} numbers")
    for end in ends:
        if (bad := np.isinf(end)).any():
            given = numbers.amount(end[bad][0], unit)
            raise SheetError(f"{'an end of ' * interval}{name} = {given} must be finite")
    if not interval:
        size = np.where(ends[0] == 0, factor, np.abs(ends[0]))
        endless = np.full(ends[0].shape, np.inf)
        most = np.full(ends[0].shape, longest_step(unit))
        return Place(ends[0], ends[0], size, np.minimum(size, factor), most, -endless, endless)
    low, high = np.broadcast_arrays(*ends)
    for a, b in zip(low[low >= high], high[low >= high], strict=True):
        small, large = (numbers.amount(v, unit) for v in (a, b))
        raise SheetError(f"{name} from {small} must end above that, not at {large}")
    return Place(low, high, high - low, np.minimum(high - low, factor), np.full(low.shape, np.inf), low, high)


def longest_step(unit: str) -> float:
    """How far a step of Newton's own from a guess moves an unknown at most: an angle by an eighth of a turn."""
    return np.pi / 4 if units.si(unit) == "rad" else np.inf


def _each(unit: str | Sequence[str], count: int, what: str, of: str) -> tuple[str, ...]:
    several = (unit,) * count if isinstance(unit, str) or not isinstance(unit, Sequence) else tuple(unit)
    if len(several) != count:
        raise SheetError(f"{what} has {len(several)} units for {count} {of}")
    for each in several:
        measured(each)
    return several


def _with_equations(words: Words, complex_: Sequence[bool], unit: str | Sequence[str], guessed: bool) -> Words:
    each = _each(unit, len(complex_), "unit", "equations")
    labels = [
        (f"equation {i}{part}", u)
        for i, (two, u) in enumerate(zip(complex_, each, strict=True), 1)
        for part in ((", real part", ", imaginary part") if two else ("",))
    ]
    texts, of = zip(*labels, strict=True)
    return Words(words.names, words.units, texts, of, guessed)
