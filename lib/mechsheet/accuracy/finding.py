"""The lengths that a Find has to find in the hitch, by `find` and by the other ways to them."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np
from numpy import exp, nan, sqrt
from numpy.typing import NDArray
from scipy.optimize import brentq, elementwise, newton, root

from mechsheet.accuracy import plain, printed
from mechsheet.accuracy.chains import arm, arm_pin, hinges
from mechsheet.accuracy.precision import Method
from mechsheet.accuracy.rivals import UNCHECKED, family, powers
from mechsheet.mechanics.planar import angle
from mechsheet.mechanics.rrr import RRRGroup, rrr, rrr_reach
from mechsheet.worksheet.find import find


@dataclass(frozen=True)
class Unknown:
    """One Find of the hitch: f(x) = ``equals`` with x between the ends; f may take a branch where one is named."""

    f: Callable[..., Any]
    plain: Callable[[Any], Any]  # f by the library's closed form without checks
    printed: Callable[[float], Any]  # and by the formulas of the document, as a port from Mathcad has it
    slope: Callable[[float], Any]  # of the closed form
    ends: tuple[Any, Any]
    guess: float
    equals: float
    branch: int | None = None

    def gap(self, x: Any) -> Any:
        return self.f(x) - self.equals

    def unchecked(self) -> "Unknown":
        """The same by closed forms without checks, without a value for lengths that are not positive."""
        if not self.branch:
            return replace(self, f=self.plain)
        return replace(
            self, f=lambda x: self.plain(x) if x > 0 else nan, slope=lambda x: self.slope(x) if x > 0 else nan
        )


def unknown(h: Any, factor: float, *known: float) -> Unknown:
    """The first of L4, S_p, L7 that is not known, by the library.

    The guess is the document's, a length times the factor, the stroke as far towards its ends.
    """
    O1, O3, O5, O7 = hinges(h)
    lever = h.L56 / h.L5

    def lower(S: Any, L4: Any, branch: int = +1) -> RRRGroup:
        return RRRGroup(arm_pin(h, S), O5, L4, h.L5, branch)

    def P56(S: Any, L4: Any, branch: int = +1) -> Any:
        return O5 + lever * lower(S, L4, branch).BC

    def plain_P34(S: Any) -> Any:
        return O3 + arm(h) * (plain.rrr(O1, O3, S, h.L3, -1) - O3)

    def rise(P34: Any, L4: Any, dP34: Any, dL4: float) -> Any:
        """Derivative of the height of P56 where P34 and L4 change."""
        b = plain.rrr(P34, O5, L4, h.L5, +1) - O5
        a = O5 + b - P34
        return (lever * 1j * plain.rrr_turns(a, b, -dP34 - dL4 * a / abs(a))[1] * b).imag

    def plain_P56(P34: Any, L4: Any) -> Any:
        return O5 + lever * (plain.rrr(P34, O5, L4, h.L5, +1) - O5)

    def as_printed(S: Any, L4: Any) -> Any:
        return printed.hitch_pins(h, S, L4, h.L7_pre)["P56_S"].imag

    if not known:
        P34 = plain_P34(h.S_min)
        return Unknown(
            lambda L4, s=+1: P56(h.S_min, L4, s).imag,
            lambda L4: plain_P56(P34, L4).imag,
            lambda L4: as_printed(h.S_min, L4),
            lambda L4: rise(P34, L4, 0, 1),
            rrr_reach(arm_pin(h, h.S_min), O5, h.L5),
            *(0.8 * h.L4_pre * factor, h.Y56_min, +1),
        )
    L4 = known[0]
    if len(known) == 1:

        def slope(S: float) -> Any:
            P23 = plain.rrr(O1, O3, S, h.L3, -1)
            a, b = P23 - O1, P23 - O3
            return rise(plain_P34(S), L4, arm(h) * 1j * plain.rrr_turns(a, b, -a / abs(a))[1] * b, 0)

        part = 0.5 if factor == 1 else float(factor > 1)
        ends, guess = (h.S_min, h.S_max), h.S_min + part * (h.S_max - h.S_min)
        return Unknown(
            lambda S: P56(S, L4).imag,
            lambda S: plain_P56(plain_P34(S), L4).imag,
            lambda S: as_printed(S, L4),
            *(slope, ends, guess, h.Y_P56),
        )
    P = P56(known[1], L4)

    def turns(L7: float) -> Any:
        C = plain.rrr(P, O7, h.L6, L7, -1)
        a, b = C - P, C - O7
        return plain.rrr_turns(a, b, b / abs(b))[0]

    return Unknown(
        lambda L7, s=-1: angle(rrr(P, O7, h.L6, L7, s) - P),
        lambda L7: np.angle(plain.rrr(P, O7, h.L6, L7, -1) - P),
        lambda L7: printed.hitch_pins(h, known[1], L4, L7)["phi6_S"],
        turns,
        rrr_reach(P, O7, h.L6),
        *(0.8 * h.L7_pre * factor, h.phi_P6, -1),
    )


def _in_turn(solve: Callable[..., float]) -> Any:
    """The three unknowns, each from the ones before it; NaN from the first that fails on."""
    found = list[float]()
    while len(found) < 3 and not (found and np.isnan(found[-1])):
        found.append(solve(*found))
    return np.array(found + [nan] * (3 - len(found)))


def _inner(ends: tuple[Any, Any]) -> tuple[Any, Any]:
    """An interval without its ends, where a closed form without checks may have rounding in its root."""
    low, high = ends
    return low + 1e-9 * (high - low), high - 1e-9 * (high - low)


def _by_find(u: Unknown) -> float:
    branches: dict[str, Any] = {"branches": (+1, -1), "branch": u.branch} if u.branch else {}
    return float(find(u.f, *u.ends, equals=u.equals, guess=u.guess, **branches).value)


def _bracketing(u: Unknown, tolerance: float) -> float:
    try:
        return float(brentq(u.gap, *u.ends, xtol=tolerance, rtol=max(tolerance, 1e-15)))
    except ValueError:  # no change of sign between the ends
        return nan


def _elementwise(u: Unknown) -> float:
    result = elementwise.find_root(u.gap, u.ends)
    return float(result.x) if result.success else nan


def _newton(u: Unknown, tolerance: float, slope: Callable[[float], Any] | None = None) -> float:
    """The secant method where no slope is given."""
    x, r = newton(u.gap, u.guess, fprime=slope, tol=tolerance, full_output=True, disp=False)
    return float(x) if r.converged else nan


def _hybr(u: Unknown, tolerance: float, slope: Callable[[float], Any] | None = None) -> float:
    def gap(x: NDArray[np.float64]) -> float:
        return float(u.gap(x.item()))

    jacobian: Any = None if slope is None else lambda x: [[slope(x.item())]]
    result = root(gap, [u.guess], method="hybr", jac=jacobian, tol=tolerance)
    return float(result.x.item()) if result.success else nan


def _lower_link(h: Any, Y: Any) -> Any:
    """Direction of the lower link where its end has the height Y."""
    rise = (Y - h.Y05) / h.L56
    return sqrt((1 - rise) * (1 + rise)) + 1j * rise


def by_inverse(h: Any) -> Any:
    """The unknown lengths as distances between known points: the mechanism taken from the other end."""
    O1, O3, O5, O7 = hinges(h)
    L4 = abs(O5 + h.L5 * _lower_link(h, h.Y56_min) - arm_pin(h, h.S_min))
    P45, P56 = (O5 + length * _lower_link(h, h.Y_P56) for length in (h.L5, h.L56))
    P23 = O3 + (rrr(P45, O3, L4, h.L34, -1) - O3) / arm(h)
    return np.array([L4, abs(P23 - O1), abs(P56 + h.L6 * exp(1j * h.phi_P6) - O7)])


def find_methods(h: Any, factors: Sequence[float]) -> list[Method]:
    """All ways to the three unknowns L4, S_p, L7, each from all guesses; all but `find` by closed forms alone."""

    @np.errstate(all="ignore")
    def each(solve: Callable[[Unknown], float]) -> Any:
        return np.array([_in_turn(lambda *known, k=k: solve(unknown(h, k, *known))) for k in factors])

    def iteration(name: str, solve: Callable[[Unknown, float], float], why: str) -> list[Method]:
        return family(name, powers(4, 12, 4), lambda tolerance: each(lambda u: solve(u, tolerance)), why)

    def unchecked(solve: Callable[..., float]) -> Callable[[Unknown, float], float]:
        return lambda u, tolerance: solve(u.unchecked(), tolerance)

    def by_slope(solve: Callable[..., float]) -> Callable[[Unknown, float], float]:
        return unchecked(lambda u, tolerance: solve(u, tolerance, u.slope))

    def inside(u: Unknown) -> Unknown:
        return replace(u, f=u.plain, ends=_inner(u.ends))

    elementwise_root = Method("find_root", "", lambda: each(lambda u: _elementwise(inside(u))), ONE_ROOT)
    return [
        Method("find", "", partial(each, _by_find)),
        Method("inverse mechanism", "", lambda: np.array([by_inverse(h) for _ in factors]), "thought out for each"),
        *([elementwise_root] if len(factors) == 1 else []),  # it has no guess
        *iteration("brentq", lambda u, tolerance: _bracketing(inside(u), tolerance), ONE_ROOT),
        *iteration("Newton", by_slope(_newton), BY_GUESS),
        *iteration("secant", unchecked(_newton), BY_GUESS),
        *iteration("hybr", by_slope(_hybr), BY_GUESS),
        *iteration("hybr, printed formulas", lambda u, tolerance: _hybr(replace(u, f=u.printed), tolerance), BY_GUESS),
    ]


ONE_ROOT = f"one root, on one branch, {UNCHECKED}"
BY_GUESS = "the root that the guess leads to"


def rod_ways(h: Any) -> dict[str, Callable[[Any], Any]]:
    """The lifting rod for heights of the suspension axis, all at once."""
    u, P34, O5 = unknown(h, 1.0), arm_pin(h, h.S_min), hinges(h)[2]

    def together(heights: Any) -> Any:
        return find(u.f, *u.ends, equals=heights, branches=(+1, -1), branch=+1).value

    def elementwise_root(f: Callable[[Any], Any], ends: tuple[Any, Any], heights: Any) -> Any:
        solve: Any = elementwise.find_root
        return solve(lambda L4, Y: f(L4) - Y, ends, args=(heights,)).x

    def one_by_one(f: Callable[[Any], Any], ends: tuple[Any, Any], heights: Any) -> Any:
        return [brentq(lambda L4, Y=Y: f(L4) - Y, *ends, xtol=1e-14) for Y in heights]

    def known_point(heights: Any) -> Any:
        return abs(O5 + h.L5 * _lower_link(h, heights) - P34)

    return {
        "find": together,
        "find_root": partial(elementwise_root, u.f, u.ends),
        "find_root, no checks": partial(elementwise_root, u.plain, _inner(u.ends)),
        "brentq": partial(one_by_one, u.f, u.ends),
        "brentq, no checks": partial(one_by_one, u.plain, _inner(u.ends)),
        "inverse mechanism": known_point,
    }
