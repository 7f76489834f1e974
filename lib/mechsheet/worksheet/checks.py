"""Checks as values: a residual against its limit, with a verdict."""

import html
import re
import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import isnan
from types import FrameType
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mechsheet import units
from mechsheet.mechanics.equilibrium import Reaction, left_over
from mechsheet.mechanics.load import Load
from mechsheet.worksheet import symbol
from mechsheet.worksheet.errors import SheetError, refuse
from mechsheet.worksheet.find import Found

_TOLD = "__told__"


@dataclass(frozen=True)
class Check:
    """One statement that a worksheet proves about itself.

    ``residual`` and ``limit`` are in ``unit``; the check passes where ``residual <= limit``, so NaN fails.
    A check that is ``essential`` stops a script run before anything is written.
    """

    name: str
    residual: float
    limit: float
    unit: str = "-"
    reason: str = ""
    essential: bool = False

    @property
    def passed(self) -> bool:
        return self.residual <= self.limit

    @property
    def evaluated(self) -> bool:
        """Whether there is a residual at all; what was not evaluated has not passed."""
        return not isnan(self.residual)

    def __str__(self) -> str:
        if not self.evaluated:
            return f"FAIL  {self.name}: not evaluated; {self.reason}".removesuffix("; ")
        verdict = "pass" if self.passed else "FAIL"
        text = f"{verdict}  {self.name}: {self.residual:.3g} <= {self.limit:.3g} {self.unit}".removesuffix(" -")
        return f"{text}; {self.reason}" if self.reason else text

    def _mime_(self) -> tuple[str, str]:
        unit = "" if self.unit == "-" else f" {html.escape(units.shown(self.unit))}"
        sign = "≤" if self.passed else "≰"
        compared = f": {self.residual:.2g} {sign} {self.limit:.2g}{unit}" if self.evaluated else ""
        return "text/html", (
            f'<div id="{_anchor(self)}">{_badge(self)} {symbol.in_words(self.name)}{compared}'
            f'<span style="opacity:.7"> {html.escape(self.reason)}</span></div>'
        )


def _badge(check: Check) -> str:
    kind, verdict = ("PASS" if check.passed else "FAIL",) * 2 if check.evaluated else ("OPEN", "not evaluated")
    return f'<span class="ms-badge ms-{kind}">{verdict}</span>'


def _anchor(check: Check) -> str:
    return "check-" + re.sub(r"\W+", "-", check.name)


@dataclass(frozen=True)
class Summary:
    """All checks of a worksheet in one place, each a link to where it stands."""

    checks: tuple[Check, ...]

    def _mime_(self) -> tuple[str, str]:
        passed = sum(check.passed for check in self.checks)
        skipped = sum(not check.evaluated for check in self.checks)
        failed = len(self.checks) - passed - skipped
        count = f"{passed} of {len(self.checks)} checks pass" + (f", {failed} fail" if failed else "")
        count += f", {skipped} not evaluated" if skipped else ""
        items = "".join(
            f"<span>{_badge(check)} "
            f'<a href="#{_anchor(check)}">{symbol.in_words(check.name)}</a> {html.escape(check.reason)}</span>'
            for check in sorted(self.checks, key=lambda check: (check.passed, not check.evaluated))
        )
        return "text/html", (f'<div class="ms-summary"><b>{count}</b><div class="ms-row">{items}</div></div>')


def summary(*checks: Check | tuple[Check, ...]) -> Summary:
    """Verdicts of checks and groups of checks, those that fail first."""
    return Summary(tuple(c for group in checks for c in (group if isinstance(group, tuple) else (group,))))


def check(name: str, residual: ArrayLike, limit: float, unit: str = "-") -> Check:
    """Check that the largest magnitude of ``residual`` is at most ``limit``, both in SI; shown in ``unit``.

    Where an element is NaN the check is not evaluated, which is no pass.
    """
    sizes, factor = np.abs(residual), units.parse(unit).factor
    lost = int(np.count_nonzero(np.isnan(sizes)))
    reason = f"{lost} of {sizes.size} values do not exist" if lost else ""
    return Check(name, float(np.max(sizes)) / factor, limit / factor, unit, reason)


def balance(
    what: str,
    loads: Sequence[Sequence[Load]],
    reactions: Sequence[Reaction],
    forces: float,
    moments: float,
) -> tuple[Check, Check]:
    """Check that loads and reactions hold each body in equilibrium: what is left of forces [N] and of moments [N m].

    ``loads`` and ``reactions`` are those of `left_over`; ``forces`` and ``moments`` are the limits, ``what`` names the
    bodies.
    """
    left = left_over(loads, reactions)
    return (
        check(f"equilibrium of forces, {what}", left.F, forces, "N"),
        check(f"equilibrium of moments, {what}", left.M, moments, "N*m"),
    )


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

    The limit is 1e-8 of the greatest slope, or ten times what the differences say of their own error, or what
    rounding of ``f`` makes of them.
    """
    from scipy.differentiate import derivative

    if not hi > lo:
        return Check(name, np.nan, 0.0, unit, "the range is empty")
    ends = np.where(x == lo, 1, np.where(x == hi, -1, 0))
    step = 0.04 * (hi - lo)
    found = derivative(f, x, initial_step=step, step_direction=ends)
    rounding = 100 * float(np.finfo(float).eps * np.max(np.abs(f(x)))) / step
    limit = max(1e-8 * float(np.max(np.abs(slope))), 10 * float(np.max(found.error)), rounding)
    return check(name, np.asarray(slope) - found.df, limit, unit)


def closed_form(found: Found, value: ArrayLike, tolerance: float = 1e-10) -> Check:
    """Check that a solve block found what the unknown is in closed form, to a part of its own size.

    A workbook then computes the unknown by its closed form, so that it follows changed inputs.
    """
    name, unit = found.words.unknown, found.words.unknown_unit
    return check(
        f"{name}: Find and the closed form", np.asarray(value) - found.value, tolerance * abs(found.value), unit
    )


def assembled(name: str, point: ArrayLike, over: ArrayLike, reaches: tuple[Any, Any], what: str, unit: str) -> Check:
    """Check that a group closes at every position: no element of ``point`` is NaN.

    ``what`` names the quantity ``over`` which the positions run; ``reaches`` are the limits between which
    the group closes. The reason names the first position that does not.
    """
    lost = np.isnan(point)
    count = int(np.count_nonzero(lost))
    if not count:
        return Check(name, 0, 0, "open positions", essential=True)
    reason = _unreached(lost, over, reaches, what, unit)
    _tell(sys._getframe(1), lost, over, reaches, what, unit)
    return Check(name, count, 0, "open positions", reason, essential=True)


def require(point: ArrayLike, over: ArrayLike, reaches: tuple[Any, Any], what: str, unit: str) -> None:
    """Refuse to go on where a group closes nowhere; the arguments are those of `assembled`.

    Of many variants those that do not close stay NaN, and the others go on.
    """
    lost = np.isnan(point)
    if np.ndim(lost) < 2 and lost.all():
        refuse(SheetError(_unreached(lost, over, reaches, what, unit)))
    _tell(sys._getframe(1), lost, over, reaches, what, unit)


def listen(namespace: dict[str, Any]) -> list[NDArray[np.object_]]:
    """List to which `assembled` and `require` add, for each variant, why it does not close; "" where it does."""
    told: list[NDArray[np.object_]] = namespace.setdefault(_TOLD, [])
    return told


def _tell(frame: FrameType, lost: Any, over: ArrayLike, reaches: tuple[Any, Any], what: str, unit: str) -> None:
    told = frame.f_globals.get(_TOLD)
    if told is None:
        return
    lost = np.atleast_2d(lost)
    reasons = np.full(len(lost), "", dtype=object)
    over, low, high = (np.broadcast_to(x, lost.shape) for x in (over, *reaches))
    for i in np.flatnonzero(lost.any(1)):
        reasons[i] = _unreached(lost[i], over[i], (low[i], high[i]), what, unit)
    told.append(reasons[:, None])


def _unreached(lost: NDArray[np.bool_], over: ArrayLike, reaches: tuple[Any, Any], what: str, unit: str) -> str:
    factor = units.parse(unit).factor
    x, lo, hi = (float(np.broadcast_to(v, np.shape(lost))[lost].flat[0]) / factor for v in (np.asarray(over), *reaches))
    if np.isnan(x):
        return f"no position closes: there is no {what}"
    digits = next((n for n in range(7, 17) if len({f"{v:.{n}g}" for v in {x, lo, hi}}) == len({x, lo, hi})), 17)
    x_, lo_, hi_ = (f"{v:.{digits}g}" for v in (x, lo, hi))  # as many digits as tell them apart
    return f"no position closes for {what} = {x_} {unit}: it reaches {lo_}..{hi_} {unit}"
