"""The other methods that could do the product's jobs, each beside its own: iterations, integration, differences, ports.

Every function ``.._methods`` lists all ways to one job, the product's own first.
"""

import cmath
from collections.abc import Callable, Sequence
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
from mechsheet.accuracy.chain import (
    REACTIONS,
    Chain,
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
from mechsheet.mechanics.planar import angle, cross, dot
from mechsheet.mechanics.rrr import rrr, rrr_reach, rrr_velocity
from mechsheet.worksheet import numbers
from mechsheet.worksheet.find import find

Runs = Callable[[float], Callable[[], Any]]


def _family(name: str, settings: Sequence[float], run: Runs) -> list[Method]:
    """A method at several tolerances, steps or sizes."""
    texts = (str(setting) if isinstance(setting, int) else numbers.scientific(setting, 0) for setting in settings)
    return [Method(name, text, run(setting)) for text, setting in zip(texts, settings, strict=True)]


def _powers(first: int, last: int, step: int = 1) -> list[float]:
    return [10.0**-k for k in range(first, last + 1, step)]


# Position


def _pins_at(chain: Chain, y: Any) -> Any:
    """Inner pins from the angles of the links."""
    return np.array([d.B + d.r_B * exp(1j * y[2 * k + 1]) for k, d in enumerate(chain.dyads)])


def _by_newton(chain: Chain, q: Any, guess: Any, tolerance: float) -> Any:
    """Newton's method on the loop of each dyad, at all positions at once."""
    A, y = chain.A(q), guess.copy()
    for k, d in enumerate(chain.dyads):
        r_A = q if d.r_A is None else d.r_A
        for _ in range(50):
            a, b = r_A * exp(1j * y[2 * k]), d.r_B * exp(1j * y[2 * k + 1])
            gap, D = d.B + b - A - a, cross(a, b)
            step = np.array([dot(gap, b) / D, dot(gap, a) / D])
            y[2 * k : 2 * k + 2] += step
            if np.max(abs(step)) < tolerance:
                break
        A = d.B + d.z * d.r_B * exp(1j * y[2 * k + 1])
    return _pins_at(chain, y)


def _loops(y: Any, chain: Chain, q: float) -> list[float]:
    """Gaps of all loops at one position, as real numbers."""
    A, gaps = chain.A(q), []
    for k, d in enumerate(chain.dyads):
        b = d.r_B * cmath.exp(1j * y[2 * k + 1])
        gap = A + (q if d.r_A is None else d.r_A) * cmath.exp(1j * y[2 * k]) - d.B - b
        gaps += [gap.real, gap.imag]
        A = d.B + d.z * b
    return gaps


def _by_fsolve(chain: Chain, q: Any, guess: Any, tolerance: float) -> Any:
    """fsolve on all loops, one position after the other."""
    found = [
        fsolve(_loops, start, args=(chain, s), xtol=tolerance, full_output=True)[0]
        for s, start in zip(q.tolist(), guess.T, strict=True)
    ]
    return _pins_at(chain, np.array(found).T)


def _rates(q: float, y: Any, chain: Chain) -> list[float]:
    """Velocity equations: derivatives of the angles of the links with respect to q."""
    dA, slopes = chain.dA(q), []
    for k, d in enumerate(chain.dyads):
        u = cmath.exp(1j * y[2 * k])
        a, b = u * (q if d.r_A is None else d.r_A), d.r_B * cmath.exp(1j * y[2 * k + 1])
        w = -dA - (u if d.r_A is None else 0)
        D = a.real * b.imag - a.imag * b.real
        turn = (w.real * a.real + w.imag * a.imag) / D
        slopes += [(w.real * b.real + w.imag * b.imag) / D, turn]
        dA = 1j * d.z * turn * b
    return slopes


def _by_integration(chain: Chain, q: Any, start: Any, method: Any, tolerance: float) -> Any:
    """The velocity equations integrated from the first position on."""
    run = solve_ivp(
        _rates, (q[0], q[-1]), start, method=method, t_eval=q, rtol=tolerance, atol=tolerance, args=(chain,)
    )
    return _pins_at(chain, run.y) if run.success else np.full((len(chain.dyads), len(q)), nan)


def position_methods(chain: Chain, q: Any, as_printed: Callable[[], Any]) -> list[Method]:
    """All ways to the inner pins of a chain at the positions q; ``as_printed`` is that of the documents."""
    angles = link_angles(chain, q)
    guess, start = np.round(angles, 1), angles[:, 0]
    ways = [
        Method("library: rrr", "", lambda: inner_pins(chain, q)),
        Method("printed: law of cosines", "", as_printed),
        *_family("Newton", _powers(3, 14), lambda t: lambda: _by_newton(chain, q, guess, t)),
        *_family("fsolve, each position", _powers(3, 14, 3), lambda t: lambda: _by_fsolve(chain, q, guess, t)),
    ]
    for name in ("RK45", "DOP853", "Radau"):
        ways += _family(
            f"solve_ivp {name}",
            _powers(3, 12),
            lambda t, name=name: lambda: _by_integration(chain, q, start, name, t),  # type: ignore[misc]
        )
    return ways


# Derivatives


def derivative_methods(
    chain: Chain, q: Any, stroke: float, order: int, as_printed: Callable[[], Any] | None = None
) -> list[Method]:
    """All ways to the first or second derivatives of the angles of the links but the cylinder."""

    def angles(at: Any) -> Any:
        return link_angles(chain, at)[1:]

    def differences(h: float) -> Any:
        behind, ahead = angles(q - h), angles(q + h)
        return (ahead - behind) / (2 * h) if order == 1 else (ahead - 2 * angles(q) + behind) / h**2

    def spline(n: float) -> Any:
        table = linspace(q[0], q[-1], int(n))
        return CubicSpline(table, angles(table), axis=1)(q, order)

    own = ("rrr_velocity", first_analogues) if order == 1 else ("rrr_acceleration", second_analogues)
    return [
        Method(f"library: {own[0]}", "", lambda: own[1](chain, q)),
        *([Method("printed: sines of the angles", "", as_printed)] if as_printed else []),
        *_family("central differences", _powers(1, 10), lambda h: lambda: differences(h * stroke)),
        *_family("spline of the table", [10 * 2**k for k in range(8)], lambda n: lambda: spline(n)),
    ]


# Find


@dataclass(frozen=True)
class Unknown:
    """One Find of the hitch: f(x) = ``equals`` with x between the ends; f may take a branch where one is named."""

    f: Callable[..., Any]
    slope: Callable[[float], Any]
    ends: tuple[Any, Any]
    guess: float
    equals: float
    branch: int | None = None


def unknown(h: Any, factor: float, *known: float) -> Unknown:
    """The first of L4, S_p, L7 that is not known, by the library.

    The guess is the document's, a length times the factor, the stroke as far towards its ends.
    """
    O1, O3, O5, O7 = hinges(h)
    z, lever = h.L34 / h.L3 * exp(1j * h.phi_BD), h.L56 / h.L5

    def P56(S: Any, L4: Any, branch: int = +1) -> Any:
        return O5 + lever * (rrr(arm_pin(h, S), O5, L4, h.L5, branch) - O5)

    def height_rate(A: Any, L4: float, **rates: Any) -> Any:
        return (lever * rrr_velocity(A, O5, rrr(A, O5, L4, h.L5, +1), **rates).v_C).imag

    if not known:
        A = arm_pin(h, h.S_min)
        return Unknown(
            lambda L4, s=+1: P56(h.S_min, L4, s).imag,
            lambda L4: height_rate(A, L4, dr_A=1),
            *(rrr_reach(A, O5, h.L5), 0.8 * h.L4_0 * factor, h.Y56_min, +1),
        )
    if len(known) == 1:

        def slope(S: float) -> Any:
            v = rrr_velocity(O1, O3, rrr(O1, O3, S, h.L3, -1), dr_A=1).v_C
            return height_rate(arm_pin(h, S), known[0], v_A=z * v)

        guess = h.S_min + (0.5 if factor == 1 else float(factor > 1)) * (h.S_max - h.S_min)
        return Unknown(lambda S: P56(S, known[0]).imag, slope, (h.S_min, h.S_max), guess, h.Y_P56)
    P = P56(known[1], known[0])
    return Unknown(
        lambda L7, s=-1: angle(rrr(P, O7, h.L6, L7, s) - P),
        lambda L7: rrr_velocity(P, O7, rrr(P, O7, h.L6, L7, -1), dr_B=1).omega_A,
        *(rrr_reach(P, O7, h.L6), 0.8 * h.L7_0 * factor, h.phi_P6, -1),
    )


def _in_turn(ask: Callable[..., Unknown], solve: Callable[[Unknown], float]) -> Any:
    """The three unknowns, each from the ones before it; NaN from the first that fails on."""
    found = list[float]()
    while len(found) < 3 and not (found and np.isnan(found[-1])):
        found.append(solve(ask(*found)))
    return np.array(found + [nan] * (3 - len(found)))


def _by_find(u: Unknown) -> float:
    branches: dict[str, Any] = {"branches": (+1, -1), "branch": u.branch} if u.branch else {}
    value: float = find(u.f, *u.ends, equals=u.equals, guess=u.guess, **branches).value
    return value


def _positive(u: Unknown) -> Unknown:
    """The same, without a value for lengths that are not positive."""
    if not u.branch:
        return u
    return replace(u, f=lambda x: u.f(x) if x > 0 else nan, slope=lambda x: u.slope(x) if x > 0 else nan)


def _as_printed(h: Any, u: Unknown, *known: float) -> Unknown:
    """The same by the formulas of the document, as a port from Mathcad has it."""

    def height(S: Any, L4: Any) -> Any:
        return printed.hitch_pins(h, S, L4, h.L7_0)["P56_S"].imag

    if not known:
        return replace(u, f=lambda L4: height(h.S_min, L4))
    if len(known) == 1:
        return replace(u, f=lambda S: height(S, known[0]))
    return replace(u, f=lambda L7: printed.hitch_pins(h, known[1], known[0], L7)["phi6_S"])


def _bracketing(u: Unknown, tolerance: float) -> float:
    try:
        return float(brentq(lambda x: u.f(x) - u.equals, *u.ends, xtol=tolerance, rtol=max(tolerance, 1e-15)))
    except ValueError:  # no change of sign between the ends
        return nan


def _newton(u: Unknown, tolerance: float, slope: bool = True) -> float:
    """Newton's method, or the secant method without a slope."""
    first = u.slope if slope else None
    x, r = newton(lambda x: u.f(x) - u.equals, u.guess, fprime=first, tol=tolerance, full_output=True, disp=False)
    return float(x) if r.converged else nan


def _hybr(u: Unknown, tolerance: float) -> float:
    def gap(x: NDArray[np.float64]) -> float:
        return float(u.f(x.item()) - u.equals)

    result = root(gap, [u.guess], method="hybr", tol=tolerance)
    return float(result.x.item()) if result.success else nan


def _lower_link(h: Any, Y: Any) -> Any:
    """Direction of the lower link where its end has the height Y."""
    rise = (Y - h.Y05) / h.L56
    return sqrt((1 - rise) * (1 + rise)) + 1j * rise


def by_inverse(h: Any) -> Any:
    """The unknown lengths as distances between known points: the mechanism taken from the other end."""
    O1, O3, O5, O7 = hinges(h)
    z = h.L34 / h.L3 * exp(1j * h.phi_BD)
    L4 = abs(O5 + h.L5 * _lower_link(h, h.Y56_min) - arm_pin(h, h.S_min))
    P45, P56 = (O5 + length * _lower_link(h, h.Y_P56) for length in (h.L5, h.L56))
    P23 = O3 + (rrr(P45, O3, L4, h.L34, -1) - O3) / z
    return np.array([L4, abs(P23 - O1), abs(P56 + h.L6 * exp(1j * h.phi_P6) - O7)])


def find_methods(h: Any, factors: Sequence[float]) -> list[Method]:
    """All ways to the three unknowns L4, S_p, L7, each from all guesses."""

    Asked = Callable[..., Unknown]  # of a factor and the lengths known

    def each(solve: Callable[[Unknown], float], asked: Asked) -> Callable[[], Any]:
        @np.errstate(all="ignore")
        def all_of() -> Any:
            return np.array([_in_turn(partial(asked, factor), solve) for factor in factors])

        return all_of

    def positive(*factor_and_known: float) -> Unknown:
        return _positive(unknown(h, *factor_and_known))

    def port(*factor_and_known: float) -> Unknown:
        return _as_printed(h, unknown(h, *factor_and_known), *factor_and_known[1:])

    def iteration(solve: Callable[[Unknown, float], float], asked: Asked = positive) -> Runs:
        return lambda t: each(lambda u: solve(u, t), asked)

    tolerances = _powers(4, 14, 2)
    return [
        Method("find", "", each(_by_find, partial(unknown, h))),
        Method("inverse mechanism", "", lambda: np.array([by_inverse(h) for _ in factors])),
        *_family("brentq on the reach", tolerances, iteration(_bracketing)),
        *_family("Newton", tolerances, iteration(_newton)),
        *_family("secant", tolerances, iteration(lambda u, t: _newton(u, t, slope=False))),
        *_family("hybr", tolerances, iteration(_hybr)),
        *_family("hybr, printed formulas", tolerances, iteration(_hybr, port)),
    ]


def rod_ways(h: Any) -> dict[str, Callable[[int], Callable[[], Any]]]:
    """The lifting rod for n heights of the suspension axis at once."""
    u, P34, O5 = unknown(h, 1.0), arm_pin(h, h.S_min), hinges(h)[2]

    def heights(n: int) -> Any:
        return linspace(0.19, 0.21, n) if n > 1 else np.array([0.2])

    def together(Y: Any) -> Any:
        return find(u.f, *u.ends, equals=Y, branches=(+1, -1), branch=+1).value

    def one_by_one(Y: Any) -> Any:
        return [brentq(lambda L4, Y=y: u.f(L4) - Y, *u.ends, xtol=1e-14) for y in Y]

    def known_point(Y: Any) -> Any:
        return abs(O5 + h.L5 * _lower_link(h, Y) - P34)

    def for_n(way: Callable[[Any], Any]) -> Callable[[int], Callable[[], Any]]:
        return lambda n: partial(way, heights(n))

    return {"find": for_n(together), "brentq": for_n(one_by_one), "inverse": for_n(known_point)}


# Reactions


def _equations(h: Any, p: dict[str, Any]) -> tuple[Any, Any]:
    """Equilibrium of the bodies 2 to 7 at all positions: matrix (..., 18, 18) and right-hand side (..., 18)."""
    O1, O3, O5, O7 = hinges(h)
    pins = (
        *((p["P56_S"], 5, 6), (O7, 0, 7), (p["P34_S"], 4, 3), (O5, 0, 5), (O1, 0, 2), (O3, 0, 3)),
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
    """The six reactions from the unknowns of the equations, where R05 is counted on the frame."""
    R = np.moveaxis(x[..., 0:12:2] + 1j * x[..., 1:12:2], -1, 0)
    return R * np.array([1, 1, 1, -1, 1, 1]).reshape(-1, *[1] * (R.ndim - 1))


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


def reaction_methods(h: Any, S: Any, L4: float, L7: float, S6: Any) -> list[Method]:
    """All ways to the six reactions of the hitch from the library's positions; S6 is the centre of mass [m]."""
    p = hitch_points(h, S, L4, L7, S6)
    return [
        Method("library: rrr_reactions", "", lambda: hitch_reactions(h, p)),
        Method("printed: elimination", "", lambda: _eliminated(h, p)),
        Method("dense system", "18 × 18", lambda: _dense(h, p)),
        Method("least squares", "21 × 18", lambda: _least_squares(h, p)),
    ]
