"""The other methods that could do the product's jobs, each beside its own: iterations, integration, differences, ports.

Every function ``.._methods`` lists all ways to one job, the product's own first.
"""

import cmath
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np
from numpy import exp, linspace, nan, sqrt
from numpy.typing import NDArray
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicSpline
from scipy.optimize import brentq, fsolve, newton, root

from mechsheet.accuracy import printed
from mechsheet.accuracy.arithmetic import cross, dot
from mechsheet.accuracy.chain import (
    REACTIONS,
    Chain,
    arm,
    arm_pin,
    first_analogues,
    hinges,
    hitch_points,
    hitch_reactions,
    inner_pins,
    link_angles,
    second_analogues,
)
from mechsheet.accuracy.precision import Method
from mechsheet.mechanics.planar import angle
from mechsheet.mechanics.rrr import RRRGroup, rrr, rrr_reach
from mechsheet.worksheet import numbers
from mechsheet.worksheet.find import find


def _family(name: str, settings: Sequence[float], run: Callable[[Any], Any]) -> list[Method]:
    """A method at several tolerances, steps or sizes."""
    texts = (str(setting) if isinstance(setting, int) else numbers.scientific(setting, 0) for setting in settings)
    return [Method(name, text, partial(run, setting)) for text, setting in zip(texts, settings, strict=True)]


def _powers(first: int, last: int, step: int = 1) -> list[float]:
    return [10.0**-k for k in range(first, last + 1, step)]


# Position


def _pins_at(chain: Chain, y: Any) -> Any:
    """Inner pins from the angles of the links."""
    return np.array([d.B + d.r_B * exp(1j * beta) for d, beta in zip(chain.dyads, y[1::2], strict=True)])


def _turns(w: Any, a: Any, b: Any) -> tuple[Any, Any]:
    """Turns of the links AC and BC that move the end of a by w beyond that of b: i (alpha a - beta b) = w."""
    D = cross(a, b)
    return dot(w, b) / D, dot(w, a) / D


def _by_newton(chain: Chain, q: Any, guess: Any, tolerance: float) -> Any:
    """Newton's method on the loop of each dyad, at all positions at once."""
    A, y = chain.A(q), guess.copy()
    for k, d in enumerate(chain.dyads):
        for _ in range(50):
            a, b = d.length(q) * exp(1j * y[2 * k]), d.r_B * exp(1j * y[2 * k + 1])
            step = np.array(_turns(d.B + b - A - a, a, b))
            y[2 * k : 2 * k + 2] += step
            if np.max(abs(step)) < tolerance:
                break
        A = d.B + d.z * d.r_B * exp(1j * y[2 * k + 1])
    return _pins_at(chain, y)


def _links(chain: Chain, q: float, y: Any) -> Iterator[tuple[Any, ...]]:
    """The dyads at one position, each with the direction of AC and the vectors AC and BC."""
    for d, alpha, beta in zip(chain.dyads, y[::2], y[1::2], strict=True):
        u = cmath.exp(1j * alpha)
        yield d, u, d.length(q) * u, d.r_B * cmath.exp(1j * beta)


def _gaps(y: Any, chain: Chain, q: float) -> list[float]:
    """Gaps of all loops at one position, as real numbers."""
    A, gaps = chain.A(q), []
    for d, _, a, b in _links(chain, q, y):
        gap = A + a - d.B - b
        gaps += [gap.real, gap.imag]
        A = d.B + d.z * b
    return gaps


def _by_fsolve(chain: Chain, q: Any, guess: Any, tolerance: float) -> Any:
    """fsolve on all loops, one position after the other."""
    starts = zip(q.tolist(), guess.T, strict=True)
    found = [fsolve(_gaps, y, args=(chain, s), xtol=tolerance, full_output=True)[0] for s, y in starts]
    return _pins_at(chain, np.array(found).T)


def _rates(q: float, y: Any, chain: Chain) -> list[float]:
    """Velocity equations: derivatives of the angles of the links with respect to q."""
    dA, slopes = chain.dA(q), list[float]()
    for d, u, a, b in _links(chain, q, y):
        turns = _turns(-dA - (u if d.r_A is None else 0), a, b)
        slopes += turns
        dA = 1j * d.z * turns[1] * b
    return slopes


def _by_integration(chain: Chain, q: Any, start: Any, method: Any, tolerance: float) -> Any:
    """The velocity equations integrated from the first position on."""
    precise = {"method": method, "rtol": tolerance, "atol": tolerance}
    run = solve_ivp(_rates, (q[0], q[-1]), start, t_eval=q, args=(chain,), **precise)
    return _pins_at(chain, run.y) if run.success else np.full((len(chain.dyads), len(q)), nan)


def position_methods(chain: Chain, q: Any, as_printed: Callable[[], Any]) -> list[Method]:
    """All ways to the inner pins of a chain at the positions q; ``as_printed`` is that of the documents."""
    angles = link_angles(chain, q)
    guess, start = np.round(angles, 1), angles[:, 0]
    ways = [
        Method("library: rrr", "", partial(inner_pins, chain, q)),
        Method("printed: law of cosines", "", as_printed),
        *_family("Newton", _powers(3, 14), partial(_by_newton, chain, q, guess)),
        *_family("fsolve, each position", _powers(3, 14, 3), partial(_by_fsolve, chain, q, guess)),
    ]
    for name in ("RK45", "DOP853", "Radau"):
        ways += _family(f"solve_ivp {name}", _powers(3, 12), partial(_by_integration, chain, q, start, name))
    return ways


# Derivatives


def derivative_methods(
    chain: Chain, q: Any, stroke: float, order: int, as_printed: Callable[[], Any] | None = None
) -> list[Method]:
    """All ways to the first or second derivatives of the angles of the links but the cylinder."""

    def angles(at: Any) -> Any:
        return link_angles(chain, at)[1:]

    def differences(part: float) -> Any:
        h = part * stroke
        behind, ahead = angles(q - h), angles(q + h)
        return (ahead - behind) / (2 * h) if order == 1 else (ahead - 2 * angles(q) + behind) / h**2

    def spline(n: int) -> Any:
        table = linspace(q[0], q[-1], n)
        return CubicSpline(table, angles(table), axis=1)(q, order)

    name, own = ("rrr_velocity", first_analogues) if order == 1 else ("rrr_acceleration", second_analogues)
    return [
        Method(f"library: {name}", "", partial(own, chain, q)),
        *([Method("printed: sines of the angles", "", as_printed)] if as_printed else []),
        *_family("central differences", _powers(1, 10), differences),
        *_family("spline of the table", [10 * 2**k for k in range(8)], spline),
    ]


# Find


@dataclass(frozen=True)
class Unknown:
    """One Find of the hitch: f(x) = ``equals`` with x between the ends; f may take a branch where one is named."""

    f: Callable[..., Any]
    printed: Callable[..., Any]  # f by the formulas of the document, as a port from Mathcad has it
    slope: Callable[[float], Any]
    ends: tuple[Any, Any]
    guess: float
    equals: float
    branch: int | None = None

    def gap(self, x: Any) -> Any:
        return self.f(x) - self.equals

    def positive(self) -> "Unknown":
        """The same, without a value for lengths that are not positive."""
        if not self.branch:
            return self
        return replace(self, f=lambda x: self.f(x) if x > 0 else nan, slope=lambda x: self.slope(x) if x > 0 else nan)

    def as_printed(self) -> "Unknown":
        return replace(self, f=self.printed)


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

    def as_printed(S: Any, L4: Any) -> Any:
        return printed.hitch_pins(h, S, L4, h.L7_0)["P56_S"].imag

    if not known:
        return Unknown(
            lambda L4, s=+1: P56(h.S_min, L4, s).imag,
            lambda L4: as_printed(h.S_min, L4),
            lambda L4: (lever * lower(h.S_min, L4).velocity(dr_A=1).v_C).imag,
            rrr_reach(arm_pin(h, h.S_min), O5, h.L5),
            *(0.8 * h.L4_0 * factor, h.Y56_min, +1),
        )
    L4 = known[0]
    if len(known) == 1:

        def slope(S: float) -> Any:
            v = RRRGroup(O1, O3, S, h.L3, -1).velocity(dr_A=1).v_C
            return (lever * lower(S, L4).velocity(arm(h) * v).v_C).imag

        part = 0.5 if factor == 1 else float(factor > 1)
        ends, guess = (h.S_min, h.S_max), h.S_min + part * (h.S_max - h.S_min)
        return Unknown(lambda S: P56(S, L4).imag, lambda S: as_printed(S, L4), slope, ends, guess, h.Y_P56)
    P = P56(known[1], L4)
    return Unknown(
        lambda L7, s=-1: angle(rrr(P, O7, h.L6, L7, s) - P),
        lambda L7: printed.hitch_pins(h, known[1], L4, L7)["phi6_S"],
        lambda L7: RRRGroup(P, O7, h.L6, L7, -1).velocity(dr_B=1).omega_A,
        rrr_reach(P, O7, h.L6),
        *(0.8 * h.L7_0 * factor, h.phi_P6, -1),
    )


def _in_turn(solve: Callable[..., float]) -> Any:
    """The three unknowns, each from the ones before it; NaN from the first that fails on."""
    found = list[float]()
    while len(found) < 3 and not (found and np.isnan(found[-1])):
        found.append(solve(*found))
    return np.array(found + [nan] * (3 - len(found)))


def _by_find(u: Unknown) -> float:
    branches: dict[str, Any] = {"branches": (+1, -1), "branch": u.branch} if u.branch else {}
    value: float = find(u.f, *u.ends, equals=u.equals, guess=u.guess, **branches).value
    return value


def _bracketing(u: Unknown, tolerance: float) -> float:
    try:
        return float(brentq(u.gap, *u.ends, xtol=tolerance, rtol=max(tolerance, 1e-15)))
    except ValueError:  # no change of sign between the ends
        return nan


def _newton(u: Unknown, tolerance: float) -> float:
    x, r = newton(u.gap, u.guess, fprime=u.slope, tol=tolerance, full_output=True, disp=False)
    return float(x) if r.converged else nan


def _secant(u: Unknown, tolerance: float) -> float:
    x, r = newton(u.gap, u.guess, tol=tolerance, full_output=True, disp=False)
    return float(x) if r.converged else nan


def _hybr(u: Unknown, tolerance: float) -> float:
    def gap(x: NDArray[np.float64]) -> float:
        return float(u.gap(x.item()))

    result = root(gap, [u.guess], method="hybr", tol=tolerance)
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
    """All ways to the three unknowns L4, S_p, L7, each from all guesses."""

    @np.errstate(all="ignore")
    def each(solve: Callable[[Unknown], float]) -> Any:
        return np.array([_in_turn(lambda *known, k=k: solve(unknown(h, k, *known))) for k in factors])

    def iteration(name: str, solve: Callable[[Unknown, float], float]) -> list[Method]:
        return _family(name, _powers(4, 14, 2), lambda tolerance: each(lambda u: solve(u.positive(), tolerance)))

    return [
        Method("find", "", partial(each, _by_find)),
        Method("inverse mechanism", "", lambda: np.array([by_inverse(h) for _ in factors])),
        *iteration("brentq on the reach", _bracketing),
        *iteration("Newton", _newton),
        *iteration("secant", _secant),
        *iteration("hybr", _hybr),
        *iteration("hybr, printed formulas", lambda u, tolerance: _hybr(u.as_printed(), tolerance)),
    ]


def rod_ways(h: Any) -> dict[str, Callable[[Any], Any]]:
    """The lifting rod for heights of the suspension axis, all at once."""
    u, P34, O5 = unknown(h, 1.0), arm_pin(h, h.S_min), hinges(h)[2]

    def together(heights: Any) -> Any:
        return find(u.f, *u.ends, equals=heights, branches=(+1, -1), branch=+1).value

    def one_by_one(heights: Any) -> Any:
        return [brentq(lambda L4, Y=Y: u.f(L4) - Y, *u.ends, xtol=1e-14) for Y in heights]

    def known_point(heights: Any) -> Any:
        return abs(O5 + h.L5 * _lower_link(h, heights) - P34)

    return {"find": together, "brentq": one_by_one, "inverse": known_point}


# Reactions


def _equations(h: Any, p: dict[str, Any]) -> tuple[Any, Any]:
    """Equilibrium of the bodies 2 to 7 at all positions: matrix (..., 18, 18) and right-hand side (..., 18)."""
    O1, O3, O5, O7 = hinges(h)
    pins = (  # the force in each is that of the first body on the second
        *((p["P56_S"], 5, 6), (O7, 0, 7), (p["P34_S"], 4, 3), (O5, 5, 0), (O1, 0, 2), (O3, 0, 3)),
        *((p["P23_S"], 2, 3), (p["P45_S"], 5, 4), (p["P67_S"], 6, 7)),
    )
    shape = p["P67_S"].shape
    matrix, right = np.zeros((*shape, 18, 18)), np.zeros((*shape, 18))
    for k, (P, giver, taker) in enumerate(pins):
        for body, sense in ((taker, 1), (giver, -1)):
            if body:
                row = 3 * (body - 2)
                matrix[..., row, 2 * k] = matrix[..., row + 1, 2 * k + 1] = sense
                matrix[..., row + 2, 2 * k], matrix[..., row + 2, 2 * k + 1] = -sense * P.imag, sense * P.real
    right[..., 13], right[..., 14] = h.P6, h.P6 * p["PS6_S"].real
    return matrix, right


def _of_unknowns(x: Any) -> Any:
    """The six reactions from the unknowns of the equations."""
    return np.moveaxis(x[..., 0:12:2] + 1j * x[..., 1:12:2], -1, 0)


def _dense(h: Any, p: dict[str, Any]) -> Any:
    matrix, right = _equations(h, p)
    return _of_unknowns(np.linalg.solve(matrix, right[..., None])[..., 0])


def _least_squares(h: Any, p: dict[str, Any]) -> Any:
    """With the equilibrium of the whole mechanism beside that of each body."""
    matrix, right = _equations(h, p)
    whole = matrix.reshape(*matrix.shape[:-2], 6, 3, 18).sum(-3)
    matrix = np.concatenate([matrix, whole], axis=-2)
    right = np.concatenate([right, right.reshape(*right.shape[:-1], 6, 3).sum(-2)], axis=-1)
    return _of_unknowns(np.array([np.linalg.lstsq(A, b, rcond=None)[0] for A, b in zip(matrix, right, strict=True)]))


def _eliminated(h: Any, p: dict[str, Any]) -> Any:
    R = printed.hitch_forces(h, p)
    return np.array([R[name] for name in REACTIONS])


def reaction_ways(h: Any) -> dict[str, Callable[[dict[str, Any]], Any]]:
    """All ways to the six reactions of the hitch from its points."""
    ways = {"library": hitch_reactions, "printed": _eliminated, "dense": _dense, "least squares": _least_squares}
    return {name: partial(way, h) for name, way in ways.items()}


def reaction_methods(h: Any, S: Any, L4: float, L7: float, S6: Any) -> list[Method]:
    """The same as methods, from the library's positions; S6 is the centre of mass [m]."""
    p = hitch_points(h, S, L4, L7, S6)
    families = "library: rrr_reactions", "printed: elimination", "dense system", "least squares"
    ways = zip(families, ("", "", "18 × 18", "21 × 18"), reaction_ways(h).values(), strict=True)
    return [Method(family, setting, partial(way, p)) for family, setting, way in ways]
