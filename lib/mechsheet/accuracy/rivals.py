"""Chains of dyads by the library, and by the other methods that could do the same jobs: iterations, integration, ports.

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
from mechsheet.accuracy.dense import dense
from mechsheet.accuracy.precision import Method
from mechsheet.mechanics.load import Load
from mechsheet.mechanics.planar import angle
from mechsheet.mechanics.rrr import RRRGroup, rrr, rrr_reach, rrr_reactions
from mechsheet.worksheet import numbers
from mechsheet.worksheet.find import find

REACTIONS = ("R56", "R07", "R34", "R05", "R01", "R03")  # of the hitch, in the order in which all methods list them


@dataclass(frozen=True)
class Dyad:
    """Links AC and BC, and the point that the rocker BC carries: B + z (C - B) is the next dyad's pin A."""

    B: complex
    r_A: float | None  # None: the coordinate itself, a driving cylinder
    r_B: float
    branch: int
    z: complex = 0

    def length(self, q: Any) -> Any:
        """Length of AC."""
        return q if self.r_A is None else self.r_A


@dataclass(frozen=True)
class Chain:
    """Dyads that hang one on another, the first on the point A(q) that moves by dA(q)."""

    A: Callable[[Any], Any]
    dA: Callable[[Any], Any]
    dyads: tuple[Dyad, ...]

    def groups(self, q: Any) -> list[RRRGroup]:
        """The dyads in their positions."""
        A, found = self.A(q), list[RRRGroup]()
        for d in self.dyads:
            found.append(RRRGroup(A, d.B, d.length(q), d.r_B, d.branch))
            A = d.B + d.z * found[-1].BC
        return found

    def pins(self, q: Any) -> Any:
        """Inner pins of all dyads."""
        return np.array([group.C for group in self.groups(q)])

    def angles(self, q: Any) -> Any:
        """Angles of the links AC, BC of every dyad."""
        return np.array([angle(link) for group in self.groups(q) for link in (group.AC, group.BC)])

    def analogues(self, order: int, q: Any) -> Any:
        """First or second derivatives of the angles but the first; the second ones where the first pin A rests."""
        dA, found = self.dA(q), list[Any]()
        ddA: Any = 0
        for group, d in zip(self.groups(q), self.dyads, strict=True):
            v = group.velocity(dA, dr_A=float(d.r_A is None))
            dA = d.z * v.v_C
            if order == 1:
                found += [v.omega_A, v.omega_B]
            else:
                a = group.acceleration(v, ddA)
                found += [a.epsilon_A, a.epsilon_B]
                ddA = d.z * a.a_C
        return np.array(found)[1:]


def hinges(h: Any) -> tuple[complex, ...]:
    """O1, O3, O5, O7 of the hitch with the inputs ``h``."""
    return tuple(complex(getattr(h, f"X0{k}"), getattr(h, f"Y0{k}")) for k in (1, 3, 5, 7))


def arm(h: Any) -> Any:
    """The side of the hitch's lift arm next to the rod over the one next to the cylinder."""
    return h.L34 / h.L3 * exp(1j * h.phi_BD)


def arm_pin(h: Any, S: Any) -> Any:
    """P34 of the hitch, the end of its lift arm."""
    O1, O3, *_ = hinges(h)
    return O3 + arm(h) * (rrr(O1, O3, S, h.L3, -1) - O3)


def hitch_chain(h: Any, L4: float, L7: float) -> Chain:
    """The hitch with the inputs ``h`` over the length of its cylinder."""
    O1, O3, O5, O7 = hinges(h)
    dyads = Dyad(O3, None, h.L3, -1, arm(h)), Dyad(O5, L4, h.L5, +1, h.L56 / h.L5), Dyad(O7, h.L6, L7, -1)
    return Chain(lambda q: O1 + 0 * q, lambda q: 0 * q, dyads)


def crank_chain(l_1: float, B: complex, l_A: float, l_B: float) -> Chain:
    """A dyad on a crank about 0, over the angle of the crank."""
    return Chain(lambda q: l_1 * exp(1j * q), lambda q: 1j * l_1 * exp(1j * q), (Dyad(B, l_A, l_B, +1),))


def hitch_points(h: Any, S: Any, L4: float, L7: float, S6: Any) -> dict[str, Any]:
    """Pins of the hitch by their names in the worksheet, and the centre of mass S6 [m] of the implement."""
    of_23, of_45, of_67 = hitch_chain(h, L4, L7).groups(S)
    outer = {"P34_S": of_45.A, "P56_S": of_67.A, "PS6_S": S6}
    return outer | {"P23_S": of_23.C, "P45_S": of_45.C, "P67_S": of_67.C}


def hitch_reactions(h: Any, p: dict[str, Any]) -> Any:
    """The six `REACTIONS` to the weight of the implement."""
    O1, O3, O5, O7 = hinges(h)
    group_67 = rrr_reactions(p["P56_S"], O7, p["P67_S"], [Load(-1j * h.P6, p["PS6_S"])])
    group_45 = rrr_reactions(p["P34_S"], O5, p["P45_S"], [], [Load(-group_67.R_A, p["P56_S"])])
    group_23 = rrr_reactions(O1, O3, p["P23_S"], [], [Load(-group_45.R_A, p["P34_S"])])
    return np.array([group_67.R_A, group_67.R_B, -group_45.R_A, -group_45.R_B, group_23.R_A, group_23.R_B])


# Position


def _family(name: str, settings: Sequence[float], run: Callable[[Any], Any]) -> list[Method]:
    """A method at several tolerances, steps or sizes."""
    texts = (str(setting) if isinstance(setting, int) else numbers.scientific(setting, 0) for setting in settings)
    return [Method(name, text, partial(run, setting)) for text, setting in zip(texts, settings, strict=True)]


def _powers(first: int, last: int, step: int = 1) -> list[float]:
    return [10.0**-k for k in range(first, last + 1, step)]


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


def _links(chain: Chain, q: float, y: Any) -> Iterator[tuple[Dyad, complex, complex, complex]]:
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


def integrated(chain: Chain, q: Any, start: Any, method: Any, relative: float, absolute: float) -> Any:
    """Angles of the links at the positions q by the velocity equations, from the first on; NaN where that fails."""
    run = solve_ivp(_rates, (q[0], q[-1]), start, method, q, rtol=relative, atol=absolute, args=(chain,))
    return run.y if run.success else np.full((len(start), len(q)), nan)


def position_methods(chain: Chain, q: Any, as_printed: Callable[[], Any]) -> list[Method]:
    """All ways to the inner pins of a chain at the positions q; ``as_printed`` is that of the documents."""
    angles = chain.angles(q)
    guess, start = np.round(angles, 1), angles[:, 0]
    ways = [
        Method("library: rrr", "", partial(chain.pins, q)),
        Method("printed: law of cosines", "", as_printed),
        *_family("Newton", _powers(3, 14), partial(_by_newton, chain, q, guess)),
        *_family("fsolve, each position", _powers(3, 14, 3), partial(_by_fsolve, chain, q, guess)),
    ]

    def by_integration(method: str, tolerance: float) -> Any:
        return _pins_at(chain, integrated(chain, q, start, method, tolerance, tolerance))

    for name in ("RK45", "DOP853", "Radau"):
        ways += _family(f"solve_ivp {name}", _powers(3, 12), partial(by_integration, name))
    return ways


# Derivatives


def derivative_methods(
    chain: Chain, q: Any, stroke: float, order: int, as_printed: Callable[[], Any] | None = None
) -> list[Method]:
    """All ways to the first or second derivatives of the angles of the links but the cylinder."""

    def differences(part: float) -> Any:
        h = part * stroke
        behind, ahead = chain.angles(q - h)[1:], chain.angles(q + h)[1:]
        return (ahead - behind) / (2 * h) if order == 1 else (ahead - 2 * chain.angles(q)[1:] + behind) / h**2

    def spline(n: int) -> Any:
        table = linspace(q[0], q[-1], n)
        return CubicSpline(table, chain.angles(table)[1:], axis=1)(q, order)

    return [
        Method(f"library: rrr_{('velocity', 'acceleration')[order - 1]}", "", partial(chain.analogues, order, q)),
        *([Method("printed: sines of the angles", "", as_printed)] if as_printed else []),
        *_family("central differences", _powers(1, 10), differences),
        *_family("spline of the table", [10 * 2**k for k in range(8)], spline),
    ]


# Find


@dataclass(frozen=True)
class Unknown:
    """One Find of the hitch: f(x) = ``equals`` with x between the ends; f may take a branch where one is named."""

    f: Callable[..., Any]
    printed: Callable[[float], Any]  # f by the formulas of the document, as a port from Mathcad has it
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
    return float(find(u.f, *u.ends, equals=u.equals, guess=u.guess, **branches).value)


def _bracketing(u: Unknown, tolerance: float) -> float:
    try:
        return float(brentq(u.gap, *u.ends, xtol=tolerance, rtol=max(tolerance, 1e-15)))
    except ValueError:  # no change of sign between the ends
        return nan


def _newton(u: Unknown, tolerance: float, slope: Callable[[float], Any] | None = None) -> float:
    """The secant method where no slope is given."""
    x, r = newton(u.gap, u.guess, fprime=slope, tol=tolerance, full_output=True, disp=False)
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
        *iteration("Newton", lambda u, tolerance: _newton(u, tolerance, u.slope)),
        *iteration("secant", _newton),
        *iteration("hybr", _hybr),
        *iteration("hybr, printed formulas", lambda u, tolerance: _hybr(replace(u, f=u.printed), tolerance)),
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


def _by_equations(h: Any, p: dict[str, Any], whole: bool) -> Any:
    """Equilibrium of the bodies 2 to 7, here counted from 1; with that of the ``whole`` beside it."""
    O1, O3, O5, O7 = hinges(h)
    hitch = (  # the first six are `REACTIONS`
        *((p["P56_S"], 5, 4), (O7, 6, 0), (p["P34_S"], 2, 3), (O5, 0, 4), (O1, 1, 0), (O3, 2, 0)),
        *((p["P23_S"], 2, 1), (p["P45_S"], 3, 4), (p["P67_S"], 6, 5)),
    )
    x = dense(6, hitch, [(5, -1j * h.P6, p["PS6_S"], 0)], whole)
    return x[0:12:2] + 1j * x[1:12:2]


def reaction_ways(h: Any) -> dict[str, Callable[[dict[str, Any]], Any]]:
    """All ways to the six reactions of the hitch from its points."""
    return {
        "library": partial(hitch_reactions, h),
        "printed": lambda p: np.array([*map(printed.hitch_forces(h, p).__getitem__, REACTIONS)]),
        "dense": partial(_by_equations, h, whole=False),
        "least squares": partial(_by_equations, h, whole=True),
    }


def reaction_methods(h: Any, S: Any, L4: float, L7: float, S6: Any) -> list[Method]:
    """The same as methods, from the library's positions; S6 is the centre of mass [m]."""
    p = hitch_points(h, S, L4, L7, S6)
    families = "library: rrr_reactions", "printed: elimination", "dense system", "least squares"
    ways = zip(families, ("", "", "18 × 18", "21 × 18"), reaction_ways(h).values(), strict=True)
    return [Method(family, setting, partial(way, p)) for family, setting, way in ways]
