"""Checks as values: a residual against its limit, with a verdict: pass, FAIL or not evaluated."""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass, replace
from math import isnan
from typing import Any, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mechsheet import units
from mechsheet.mechanics.arguments import unmasked
from mechsheet.mechanics.differences import derivative
from mechsheet.mechanics.rows import each_alone, of_one, takes_arrays
from mechsheet.worksheet import numbers
from mechsheet.worksheet.equations import common_shape, real_numbers
from mechsheet.worksheet.errors import SheetError, as_given, function, is_one, measured, refuse, texts
from mechsheet.worksheet.find import Found
from mechsheet.worksheet.shown import Shown
from mechsheet.worksheet.system import Solution
from mechsheet.worksheet.verdict import is_heard, tell

LITTLE = 1e-4  # of a limit: what takes less takes nothing of it
AGREED = 1e-3  # of a quantity: what may differ by more has not been compared


@dataclass(frozen=True)
class Check(Shown):
    """One statement that a worksheet proves about itself.

    ``residual`` and ``limit`` are in ``unit``; the check passes where ``residual <= limit``, or ``>=`` where the limit
    is what a quantity must be ``at_least``. Where one of them is NaN it is not evaluated, which is no pass. A check
    that is ``essential`` stops a script run before anything is written. In an ``agreement`` the residual is the
    difference of two computations: rounding and no value, while it passes.
    """

    name: str
    residual: float
    limit: float
    unit: str = "-"
    reason: str = ""
    essential: bool = False
    agreement: bool = False
    at_least: bool = False

    def __post_init__(self) -> None:
        texts(f"check {self.name}", name=self.name, unit=self.unit)
        for what, x in (("residual", self.residual), ("limit", self.limit)):
            if not is_one(x):
                refuse(SheetError(f"check {self.name}: its {what} must be one number, not {as_given(x)}"))

    @property
    def passed(self) -> bool:
        if (stated := _stated.get()) is not None:
            stated.pop(id(self), None)  # who reads a verdict uses it: it is no statement that is forgotten
        return self.residual >= self.limit if self.at_least else self.residual <= self.limit

    @property
    def evaluated(self) -> bool:
        """Whether there are a residual and a limit at all; what was not evaluated has not passed."""
        return not (isnan(self.residual) or isnan(self.limit))

    @property
    def verdict(self) -> str:
        """One of pass, FAIL, not evaluated."""
        return "not evaluated" if not self.evaluated else "pass" if self.passed else "FAIL"

    @property
    def utilisation(self) -> float:
        """What part of its limit a quantity takes, or of a quantity what is needed; NaN where that tells nothing."""
        part, whole = (self.limit, self.residual) if self.at_least else (self.residual, self.limit)
        tells = part >= 0 and whole > 0 and self.limit > 0 and not self.agreement
        return part / whole if tells else np.nan

    @property
    def utilised(self) -> str:
        """The utilisation in per cent, told apart from 100; nothing where there is none."""
        part = self.utilisation
        if 0 < part < LITTLE:
            return f"under {numbers.significant(100 * LITTLE, 1)} %"
        return f"{numbers.apart([100 * part, 100.0], digits=3)[0]} %" if np.isfinite(part) else ""

    def shown_in(self, unit: str) -> "Check":
        """The same check in another unit that measures the same; what is counted, in words, has its own alone."""
        if unit == self.unit:
            return self
        own, other = units.parse(self.unit), measured(unit, f"check {self.name}")
        if own.dims != other.dims:
            refuse(SheetError(f"check {self.name}: {unit} does not measure {numbers.in_text(self.unit)}"))
        residual, limit = (x * own.factor / other.factor for x in (self.residual, self.limit))
        return replace(self, residual=residual, limit=limit, unit=unit)

    @property
    def compared(self) -> tuple[str, str]:
        """Residual and limit as in lines and told apart, with two digits where the residual is only rounding."""
        both = self.residual, self.limit
        if not np.isfinite(both).all():
            residual, limit = (numbers.significant(x, 4).replace("inf", numbers.CELL.infinite) for x in both)
            return residual, limit
        rounding = self.agrees or abs(both[0]) < 1e-3 * both[1]
        residual, limit = numbers.apart(both, digits=2) if rounding else numbers.in_line(both, "-")
        return residual, limit

    @property
    def agrees(self) -> bool:
        """Whether two computations agree: then the limit tells how well, and the residual nothing."""
        return self.agreement and self.passed

    def __str__(self) -> str:
        residual, limit = self.compared
        said = f"within {limit}" if self.agrees else f"{residual} {'>=' if self.at_least else '<='} {limit}"
        compared = f": {said}{numbers.suffix(self.unit)}" if self.evaluated else ""
        part = f", {self.utilised}" if self.utilised else ""
        return f"{self.verdict}  {self.name}{compared}{part}" + (f"; {self.reason}" if self.reason else "")


STATED = "_stated"  # name in the namespace of a run of the checks that it has stated
_stated: ContextVar[dict[int, Check] | None] = ContextVar("stated", default=None)


@contextmanager
def stating() -> Iterator[dict[int, Check]]:
    """Checks that are stated within, by whatever number, but for those whose verdict is read there."""
    token = _stated.set(made := dict[int, Check]())
    try:
        yield made
    finally:
        _stated.reset(token)


def _state(check: Check) -> Check:
    if (stated := _stated.get()) is not None:
        stated[id(check)] = check
    return check


def unkept(names: Mapping[str, Any], kept: Iterable[Any]) -> list[Check]:
    """Checks that a run has stated and that are not among what its cells give and show; ``names`` are its namespace.

    Raises SheetError where several that differ have one name.
    """
    own, found = {check.name for check in kept if isinstance(check, Check)}, dict[str, Check]()
    for check in names.get(STATED, {}).values():
        if found.setdefault(check.name, check) != check and not isnan(check.residual):
            raise SheetError(f"two checks are called {check.name!r}: give each a name of its own")
    return [check for name, check in found.items() if name not in own]


def checks_of(names: Mapping[str, Any]) -> list[Check]:
    """Checks in the namespace of a run, alone or in groups, in the order in which they were made."""
    groups = (group if isinstance(group, tuple | list) else (group,) for group in names.values())
    return [check for group in groups for check in group if isinstance(check, Check)]


def refuse_open(judged: Iterable[Check]) -> None:
    """Raise SheetError for the first essential check that fails."""
    for check in judged:
        if check.essential and not check.passed:
            raise SheetError(f"{check.name}: {check.reason}" if check.reason else str(check))


@dataclass(frozen=True)
class Summary(Shown):
    """All checks of a worksheet in one place, each a link to where it stands."""

    checks: tuple[Check, ...]

    @property
    def count(self) -> str:
        """How many pass, and how many do not."""
        passed = sum(check.passed for check in self.checks)
        skipped = sum(not check.evaluated for check in self.checks)
        failed = len(self.checks) - passed - skipped
        told = f"{passed} of {len(self.checks)} checks pass" + (f", {failed} fail" if failed else "")
        return told + (f", {skipped} not evaluated" if skipped else "")

    @property
    def worst_first(self) -> tuple[Check, ...]:
        """Those that fail, those that are not evaluated, those that pass; in each the most utilised first."""

        def place(check: Check) -> tuple[bool, bool, float]:
            return check.passed, not check.evaluated, -check.utilisation if check.utilised else np.inf

        return tuple(sorted(self.checks, key=place))


def summary(*checks: Check | Sequence[Check]) -> Summary:
    """Verdicts of checks and groups of checks, the worst first."""
    every = [c for group in checks for c in (group if isinstance(group, tuple | list) else (group,))]
    for other in (c for c in every if not isinstance(c, Check)):
        raise SheetError(f"summary takes checks and groups of them, not {as_given(other)}")
    return Summary(tuple(every))


def check(
    name: str,
    residual: ArrayLike,
    limit: float | None = None,
    unit: str = "-",
    of: ArrayLike | None = None,
    *,
    at_least: float | None = None,
) -> Check:
    """Check that the largest magnitude of ``residual`` is at most ``limit``, both in SI; shown in ``unit``.

    Instead of the limit a check may have what the smallest value, with its sign, must be ``at_least``, such as a
    safety: ``check("safety", S, at_least=1.5)``.

    Where the residual is the difference of two computations, ``of`` is the quantity that both compute, and ``limit``
    the part of its largest magnitude by which they may differ: over a thousandth it would tell nothing. Without it the
    residual is a quantity, and what part of its limit it takes is its utilisation.

    The check is not evaluated, and says why, over no values, where a value is NaN, and where the limit tells nothing.
    """
    if at_least is not None:
        if limit is not None or of is not None:
            other = "a limit" if of is None else "of="
            refuse(SheetError(f"check {name}: it has at_least= and {other}: give one of them, or two checks"))
        return judged(name, residual, at_least, unit, at_least=True)
    if limit is None:
        refuse(SheetError(f"check {name}: it has no limit: give the limit behind the quantity, or at_least="))
    if of is None or not is_one(limit) or isinstance(limit, bool | np.bool_):  # which is refused there
        return judged(name, residual, limit, unit)
    try:
        size = float(np.max(np.abs(of), initial=0.0))
    except (TypeError, ValueError, OverflowError):  # of numpy's: they do not say of what
        refuse(SheetError(f"check {name}: of= must be numbers, not {as_given(of)}"))
    if isinstance(of, np.ndarray | list | tuple) and not np.size(of):
        return judged(name, (), limit, unit)
    return judged(name, residual, limit * size, unit, size, limit <= AGREED)


def judged(
    name: str,
    residual: ArrayLike,
    limit: float,
    unit: str,
    size: float = np.inf,
    tells: bool = True,
    at_least: bool = False,
) -> Check:
    """Check of a residual, of two computations of a quantity of that size; all in SI. Whether its limit ``tells``."""
    of = f"check {name if isinstance(name, str) else as_given(name)}"
    texts(of, name=name, unit=unit)
    try:
        residuals = unmasked(residual)
    except ValueError:  # rows that are not as long as each other
        refuse(SheetError(f"{of}: its residual must be numbers, not {as_given(residual)}"))
    if residuals.dtype.kind == "b" or isinstance(limit, bool | np.bool_):
        told = "a condition, which is no number: give a quantity and its limit, or at_least="
        refuse(SheetError(f"{of}: its {'limit' if isinstance(limit, bool | np.bool_) else 'residual'} is {told}"))
    if residuals.dtype.kind not in "iufc":
        refuse(SheetError(f"{of}: its residual must be numbers, not {as_given(residual)}"))
    if np.ndim(limit) or np.asarray(limit).dtype.kind not in "biuf":
        refuse(SheetError(f"{of}: its limit must be one number, not {as_given(limit)}"))
    if at_least and np.iscomplexobj(residual):
        refuse(SheetError(f"{of}: it has a complex number, of which none is the least"))
    sizes, factor = residuals if at_least else np.abs(residuals), measured(unit, of).factor
    reason, lost = "", int(np.count_nonzero(np.isnan(sizes)))
    if not sizes.size:
        reason = "there is nothing to check"
    elif lost:
        reason = f"{lost} of {sizes.size} values do not exist" if sizes.size > 1 else "its value does not exist"
    elif not tells:
        compared, least = (numbers.significant(x / factor, 2) for x in (size, limit))
        reason = f"the limit, {least}, is more than a thousandth of what is compared, {compared}{numbers.suffix(unit)}"
    elif not np.isfinite(limit):
        reason = "its limit does not exist" if np.isnan(limit) else "its limit is infinite"
    residual = np.nan if reason else float(np.min(sizes) if at_least else np.max(sizes)) / factor
    if size == 0 and residual > 0:
        reason = "what is compared is 0, and so is any part of it: without of= the limit is a number of its own"
    agreement = bool(np.isfinite(size))
    return _state(Check(name, residual, limit / factor, unit, reason, agreement=agreement, at_least=at_least))


def check_slope(
    name: str,
    slope: ArrayLike,
    f: Callable[[NDArray[np.float64]], NDArray[np.float64]],
    x: NDArray[np.float64],
    lo: float,
    hi: float,
    unit: str = "-",
) -> Check:
    """Check a derivative against adaptive differences of ``f`` at ``x``, taken inside ``lo``..``hi``.

    ``f`` takes arrays or, where it does not, one number after the other. The limit is 1e-8 of the greatest slope, or
    ten times what the differences say of their own error, or what rounding of ``f`` makes of them; over a thousandth
    of the slope it would tell nothing.
    """
    function(f, "check_slope")
    of, slope = f"check {name}", unmasked(slope)
    if slope.dtype.kind not in "iufc":
        refuse(SheetError(f"{of}: its slope must be numbers, not {as_given(slope)}"))
    x = np.atleast_1d(real_numbers(x, "x", of))
    lo, hi = (float(real_numbers(end, which, of)) for end, which in ((lo, "lo"), (hi, "hi")))
    if not hi > lo or not np.size(x):
        return _state(Check(name, np.nan, 0.0, unit, "there is nothing to check: the range is empty"))
    if np.ndim(slope) > np.ndim(x):
        return _state(
            Check(name, np.nan, 0.0, unit, "several variants at once: the slope of each is checked in its own run")
        )
    common_shape({"slope": slope, "x": x})
    if not takes_arrays(of_one(f), x[None, [0, -1]], ()):
        f = each_alone(f, ())
    ends = np.where(x == lo, 1, np.where(x == hi, -1, 0))
    step = 0.04 * (hi - lo)
    size = float(np.max(np.abs(slope)))
    least = 1e-8 * size
    # Finer differences than the check needs would be rounding, which their own error does not tell.
    enough = least / 10 if least > 0 else 0.0  # a slope may be NaN, a tolerance may not
    here = f(x)  # which differences ask for too
    differences, error = derivative(lambda at: here if at is x else f(at), x, step, ends, enough)
    rounding = 100 * float(np.finfo(float).eps * np.max(np.abs(here))) / step
    limit = max(least, 10 * float(np.max(error)), rounding)
    return judged(name, np.asarray(slope) - differences, limit, unit, size, limit <= AGREED * size)


@overload
def closed_form(found: Found, value: ArrayLike, tolerance: float = 1e-10) -> Check: ...
@overload
def closed_form(found: Solution, *, tolerance: float = 1e-10, **values: ArrayLike) -> tuple[Check, ...]: ...
def closed_form(
    found: Found | Solution, value: ArrayLike = np.nan, tolerance: float = 1e-10, **values: ArrayLike
) -> Check | tuple[Check, ...]:
    """Check that a solve block found what the unknown is in closed form, to a part of its own size.

    Of several unknowns those that have one are given by their names. A workbook then computes them by their closed
    forms, so that they follow changed inputs; where a closed form does not solve the equations any more, as on another
    branch, there is no number.

    Raises SheetError naming an unknown that the block does not have.
    """
    if isinstance(found, Found):
        own = found.words.unknown
        if values:
            refuse(SheetError(f"closed form of {own}: give it behind what is found, without a name"))
        return closed(own, found.words.unknown_unit, found.value, real_numbers(value, "closed form", own), tolerance)
    if not isinstance(found, Solution):
        refuse(SheetError(f"closed_form compares what find has found with a value, not {as_given(found)}"))
    if not values:
        first = found.words.names[0]
        refuse(SheetError(f"closed form of {found.words.unknowns}: give each that has one by its name, as {first}=.."))
    units_of = dict(zip(found.words.names, found.words.units, strict=True))
    for name in values:
        if name not in units_of:
            refuse(SheetError(f"closed form of {name}: the unknowns are {found.words.unknowns}"))
    return tuple(closed(k, units_of[k], getattr(found.value, k), x, tolerance) for k, x in values.items())


def closed(unknown: str, unit: str, found: ArrayLike, value: ArrayLike, tolerance: float) -> Check:
    return check(f"{unknown}: Find and the closed form", np.subtract(value, found), tolerance, unit, of=found)


def assembled(name: str, point: ArrayLike, over: ArrayLike, reaches: tuple[Any, Any], what: str, unit: str) -> Check:
    """Check that a group closes at every position: no element of ``point`` is NaN.

    ``what`` names the quantity ``over`` which the positions run; ``reaches`` are the limits between which
    the group closes. The reason names the first position that does not.
    """
    measured(unit, f"check {name}")
    lost = _lost(f"check {name}", point, reaches, what)
    count: Any = np.count_nonzero(lost) if lost.size else np.nan
    return _state(Check(name, count, 0, "open positions", _open(lost, over, reaches, what, unit), essential=True))


def require(point: ArrayLike, over: ArrayLike, reaches: tuple[Any, Any], what: str, unit: str) -> None:
    """Refuse to go on where a group closes nowhere; the arguments are those of `assembled`.

    Of many variants those that do not close stay NaN, and the others go on.
    """
    measured(unit, "require")
    lost = _lost("require", point, reaches, what)
    if np.ndim(lost) < 2 and lost.all():
        refuse(SheetError(_unreached(lost, over, reaches, what, unit)))
    _tell(lost, over, reaches, what, unit)


def _lost(of: str, point: ArrayLike, reaches: tuple[Any, Any], what: str) -> Any:
    """Where a point does not exist; refused in the name of what asks, as limits are that are no two."""
    if not isinstance(reaches, tuple | list | np.ndarray) or len(reaches) != 2:
        refuse(SheetError(f"{of}: reaches must be the two limits of {what}, not {as_given(reaches)}"))
    try:
        return np.isnan(point)
    except (TypeError, ValueError):  # of numpy's: they do not say of what
        refuse(SheetError(f"{of}: its points must be numbers, not {as_given(point)}"))


def _tell(lost: Any, over: ArrayLike, reaches: tuple[Any, Any], what: str, unit: str) -> None:
    if not is_heard():
        return
    lost = np.atleast_2d(lost)
    reasons = np.full(len(lost), "", dtype=object)
    over, low, high = (np.broadcast_to(x, lost.shape) for x in (over, *reaches))
    for i in np.flatnonzero(lost.any(1)):
        reasons[i] = _unreached(lost[i], over[i], (low[i], high[i]), what, unit)
    tell(reasons[:, None])


def _open(lost: Any, over: ArrayLike, reaches: tuple[Any, Any], what: str, unit: str) -> str:
    """Why a group is open somewhere, which others are told too; "" where it closes everywhere."""
    if not lost.size:
        return "there is nothing to check"
    if not lost.any():
        return ""
    _tell(lost, over, reaches, what, unit)
    return _unreached(lost, over, reaches, what, unit)


def _unreached(lost: NDArray[np.bool_], over: ArrayLike, reaches: tuple[Any, Any], what: str, unit: str) -> str:
    factor = measured(unit).factor
    try:
        x, lo, hi = (float(np.broadcast_to(v, np.shape(lost))[lost].flat[0]) / factor for v in (over, *reaches))
    except (TypeError, ValueError):  # of numpy's: they do not say of what
        refuse(SheetError(f"{what} and the limits of its reach must be real numbers, one or one for each position"))
    if np.isnan(x):
        return f"no position closes: there is no {what}"
    at, low, high = numbers.apart([x, lo, hi], digits=7)
    after = numbers.suffix(unit)
    return f"no position closes for {what} = {at}{after}: it reaches {low}..{high}{after}"
