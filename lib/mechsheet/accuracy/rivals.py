"""Positions, derivatives and reactions by the methods that could do the same jobs: iterations, integration, ports.

Every function ``.._methods`` lists all ways to one job, the product's own first. Each is at its best: all positions at
once where it can take them, and its slopes in closed form.
"""

import cmath
from collections.abc import Callable, Iterator, Sequence
from functools import partial
from typing import Any

import numpy as np
from numpy import exp, linspace, nan
from numpy.polynomial.chebyshev import chebder, chebval
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicSpline
from scipy.optimize import fsolve

from mechsheet.accuracy import printed
from mechsheet.accuracy.arithmetic import cross, dot
from mechsheet.accuracy.chains import (
    REACTIONS,
    Chain,
    Dyad,
    hinges,
    hitch_points,
    hitch_reactions,
    plain_hitch_reactions,
)
from mechsheet.accuracy.dense import dense
from mechsheet.accuracy.precision import Method
from mechsheet.worksheet import numbers

UNCHECKED = "checks nothing"  # why a closed form is not used that is faster


# Position


def family(name: str, settings: Sequence[float], run: Callable[[Any], Any], why: str = "") -> list[Method]:
    """A method at several tolerances, steps or sizes."""
    texts = (str(setting) if isinstance(setting, int) else numbers.scientific(setting, 0) for setting in settings)
    return [Method(name, text, partial(run, setting), why) for text, setting in zip(texts, settings, strict=True)]


def powers(first: int, last: int, step: int = 1) -> list[float]:
    """Powers of ten, 10**-first and on."""
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


def _slopes_of_gaps(y: Any, chain: Chain, q: float) -> Any:
    """Their derivatives by the angles of the links: its own ones, and that of the rocker that carries its pin."""
    slopes, z = np.zeros((len(y), len(y))), 0j
    for k, (d, _, a, b) in zip(range(0, len(y), 2), _links(chain, q, y), strict=True):
        for column, slope in ((k - 1, 1j * z), (k, 1j * a), (k + 1, -1j * b)):
            if column >= 0:
                slopes[k, column], slopes[k + 1, column] = slope.real, slope.imag
        z = d.z * b
    return slopes


def _by_fsolve(chain: Chain, q: Any, guess: Any, tolerance: float) -> Any:
    """fsolve on all loops, one position after the other."""
    starts = zip(q.tolist(), guess.T, strict=True)
    solve: Any = partial(fsolve, _gaps, fprime=_slopes_of_gaps, xtol=tolerance, full_output=True)  # a code, no warning
    found = [solve(y, args=(chain, s))[0] for s, y in starts]
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
        Method("closed form, no checks", "", partial(chain.plain_pins, q), UNCHECKED),
        Method("printed: law of cosines", "", as_printed, f"{UNCHECKED}, loses digits in line"),
        *family("Newton", powers(3, 14), partial(_by_newton, chain, q, guess), "needs a guess"),
        *family("fsolve, each position", powers(3, 14, 3), partial(_by_fsolve, chain, q, guess)),
    ]

    def by_integration(method: str, tolerance: float) -> Any:
        return _pins_at(chain, integrated(chain, q, start, method, tolerance, tolerance))

    for name in ("RK45", "DOP853", "LSODA"):
        ways += family(f"solve_ivp {name}", powers(3, 12, 3), partial(by_integration, name))
    return ways


# Derivatives


def derivative_methods(
    chain: Chain, q: Any, stroke: float, order: int, as_printed: Callable[[], Any] | None = None
) -> list[Method]:
    """All ways to the first or second derivatives of the angles of the links but the cylinder.

    Differences, splines and polynomials take angles by closed forms without checks, the fastest that there are.
    """

    def angles(q: Any) -> Any:
        return chain.plain_angles(q)[1:]

    def differences(part: float) -> Any:
        h = part * stroke
        behind, ahead = angles(q - h), angles(q + h)
        return (ahead - behind) / (2 * h) if order == 1 else (ahead - 2 * angles(q) + behind) / h**2

    def five_points(part: float) -> Any:
        h = part * stroke
        (p, r), (s, t) = ((angles(q - k * h), angles(q + k * h)) for k in (1, 2))
        if order == 1:
            return (8 * (r - p) - (t - s)) / (12 * h)
        return (16 * (p + r) - (s + t) - 30 * angles(q)) / (12 * h**2)

    def spline(n: int) -> Any:
        table = linspace(q[0], q[-1], n)
        return CubicSpline(table, angles(table), axis=1)(q, order)

    def polynomial(n: int) -> Any:
        """Through a table at Chebyshev's places, of which it makes the most."""
        theta, k = np.pi * (np.arange(n) + 0.5) / n, np.arange(n)[:, None]
        middle, half = (q[0] + q[-1]) / 2, (q[-1] - q[0]) / 2
        parts = np.cos(k * theta) @ angles(middle + half * np.cos(theta)).T * (np.where(k, 2, 1) / n)
        return chebval((q - middle) / half, chebder(parts, order)) / half**order

    return [
        Method(f"library: rrr_{('velocity', 'acceleration')[order - 1]}", "", partial(chain.analogues, order, q)),
        Method("closed form, no checks", "", partial(chain.plain_analogues, order, q), UNCHECKED),
        *(
            [Method("printed: sines of the angles", "", as_printed, f"{UNCHECKED}, loses digits in line")]
            if as_printed
            else []
        ),
        *family("central differences", powers(1, 10), differences),
        *family("differences of five points", powers(2, 5), five_points),
        *family("spline of the table", [10 * 2**k for k in range(8)], spline),
        *family("polynomial of the table", [10 * 2**k for k in range(4)], polynomial),
    ]


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
        "library: rrr_reactions": partial(hitch_reactions, h),
        "closed form, no checks": partial(plain_hitch_reactions, h),
        "printed: elimination": lambda p: np.array([*map(printed.hitch_forces(h, p).__getitem__, REACTIONS)]),
        "dense system": partial(_by_equations, h, whole=False),
        "least squares": partial(_by_equations, h, whole=True),
    }


def reaction_methods(h: Any, S: Any, L4: float, L7: float, S6: Any) -> list[Method]:
    """The same as methods, from the library's positions; S6 is the centre of mass [m]."""
    p = hitch_points(h, S, L4, L7, S6)
    settings = {"dense system": "18 × 18", "least squares": "21 × 18"}
    whys = {"closed form, no checks": UNCHECKED, "printed: elimination": f"{UNCHECKED}, divides by rounding"}
    whys |= {"dense system": "not over many positions", "least squares": "not over many positions"}
    ways = reaction_ways(h).items()
    return [Method(name, settings.get(name, ""), partial(way, p), whys.get(name, "")) for name, way in ways]
