"""Two more jobs: reactions of a machine with groups RRR, RRP and RPR, and the bolts of a circular joint.

The reactions start from the pins and loads that the worksheet ``kinetostatics`` computes: these floats are the exact
numbers of the job, whose truth is the equilibrium of the six bodies at 50 digits.
"""

from collections.abc import Callable
from functools import partial
from types import SimpleNamespace
from typing import Any

import numpy as np
from flint import acb, arb
from numpy import cos, pi
from scipy.integrate import quad

from mechsheet.accuracy import plain, printed, sections
from mechsheet.accuracy.arithmetic import Numbers, cross, in_balls
from mechsheet.accuracy.conditioning import condition
from mechsheet.accuracy.dense import dense
from mechsheet.accuracy.precision import Job, Method
from mechsheet.accuracy.pump import FORCES, LOADS, Points, exact_forces, forces, loads, pairs
from mechsheet.accuracy.rivals import UNCHECKED
from mechsheet.mechanics.equilibrium import PinReaction, Reaction, SlideReaction, solve_reactions
from mechsheet.mechanics.joint import NODES, WEIGHTS, circular_joint
from mechsheet.mechanics.load import Load
from mechsheet.mechanics.rpr import rpr_reactions
from mechsheet.mechanics.rrp import rrp_reactions
from mechsheet.mechanics.rrr import rrr_reactions
from mechsheet.worksheet.cells import Worksheet


def machine_job(number: str, sheet: Worksheet, N: int) -> Job:
    """Reactions in the pins A to E, K, H and in both prismatic pairs of the worksheet ``kinetostatics``, all ways."""
    given = {"g": sheet.inputs(), "phi1": 2 * pi * np.arange(N) / N}
    p = SimpleNamespace(**sheet.run(_GIVEN, given))
    p.u7 = (p.K - p.H) / np.abs(p.K - p.H)
    each = [in_balls(_exactly)(p, k) for k in range(N)]
    methods = [
        Method("library: groups", "", partial(_by_groups, p)),
        Method("closed form, no checks", "", partial(_without_checks, p), UNCHECKED),
        Method("library: solve_reactions", "18 × 18", partial(_by_bodies, p)),
        Method("printed: elimination", "", partial(_as_printed, p), f"{UNCHECKED}, loses digits in line"),
        Method("dense system", "18 × 18", partial(_dense, p), "not over many positions"),
    ]
    given = {name: getattr(p, name) for name in (*_GIVEN, "u7")}
    kappa = condition(lambda x: _by_groups(SimpleNamespace(**x)), given)
    truth = [at[name] for name in FORCES for at in each]
    return Job(number, "Kinetostatic reactions", truth, methods, kappa)


_GIVEN = ("A", "B", "C", "D", "E", "K", "H", "u5", *(x for row in LOADS for x in row if x))


def _exactly(p: Points, k: int) -> Numbers:
    """The forces at one position at 50 digits."""
    given = {name: np.broadcast_to(getattr(p, name), p.A.shape)[k].item() for name in (*_GIVEN, "u7")}
    at = SimpleNamespace(**{name: acb(x) if isinstance(x, complex) else arb(x) for name, x in given.items()})
    return dict(zip(FORCES, exact_forces(at), strict=True))


def _complex(x: Any, y: Any) -> Any:
    return x + 1j * y


def _by_groups(p: Points) -> Any:
    F2, F3, F4, F5, F6, F7 = (Load(F, S, M) for _, F, S, M in loads(p))
    of_45 = rrp_reactions(p.D, p.E, p.u5, [F4], [F5])
    of_67 = rpr_reactions(p.K, p.H, p.K - p.H, [F6], [F7])
    of_23 = rrr_reactions(p.A, p.C, p.B, [F2], [F3, Load(-of_45.R_A, p.D), Load(-of_67.R_A, p.K)])
    hinges = of_23.R_A, -of_23.R_C, of_23.R_B, of_45.R_A, -of_45.R_C, of_67.R_A, of_67.R_B
    return np.array([*hinges, of_45.R_B, of_67.R_C])


def _without_checks(p: Points) -> Any:
    """The same by the closed forms alone."""

    def about(k: int, pole: Any) -> tuple[Any, Any]:
        _, F, S, M = of[k - 2]
        return F, cross(S - pole, F) + M

    of = loads(p)
    (F4, T4), (F5, _), (F6, T6), (F7, T7) = about(4, p.D), about(5, p.E), about(6, p.K), about(7, p.H)
    R_D, R_05, R_E = plain.rrp_forces(p.D, p.E, p.u5, F4, T4, F5)
    R_K, R_H, R_76 = plain.rpr_forces(p.K, p.H, F6, T6, F7, T7)
    (F2, T2), (F3, T3) = about(2, p.A), about(3, p.C)
    T3 = T3 - cross(p.D - p.C, R_D) - cross(p.K - p.C, R_K)
    R_A, R_C, R_B = plain.rrr_forces(p.A, p.C, p.B, F2, T2, F3 - R_D - R_K, T3)
    return np.array([R_A, -R_B, R_C, R_D, -R_E, R_K, R_H, R_05, R_76])


def _as_printed(p: Points) -> Any:
    return np.array([*map(printed.machine_forces(p.g, p).__getitem__, FORCES)])


def _dense(p: Points) -> Any:
    return np.array(forces(dense(6, pairs(p), loads(p)), p, _complex))


def _by_bodies(p: Points) -> Any:
    """The library's system of all bodies; which forces its reactions have is not looked at."""
    joints: list[Reaction] = []
    for *place, on, by in pairs(p):
        joints.append(SlideReaction(on, by, 0, *place) if len(place) == 2 else PinReaction(on, by, 0, *place))
    x = solve_reactions([[Load(F, S, M)] for _, F, S, M in loads(p)], joints)
    return np.array(forces(x.T, p, _complex))


# Circular joint


_BOLTS, _RADIUS, _MOMENT = 24, 0.6, 1e5  # the joint: number, m, N m
_STRIPS = 30, 100, 300, 1000
_GAUSS = (1 + NODES) / 2, WEIGHTS / 2  # on an arc of the length 1
_CLOSES = "loses digits as the arc closes"


def ring_job(number: str, count: int) -> Job:
    """Forces of 24 even bolts of a circular joint, all ways: from no normal force to one that all but lifts the rim."""
    phi = 2 * pi * np.arange(_BOLTS) / _BOLTS
    N = 2 * _MOMENT / _RADIUS * (1 - np.geomspace(1e-9, 1, count))
    truth = [force for each in N for force in sections.ring(phi.tolist(), _RADIUS, _MOMENT, each)["P"]]
    methods = [
        Method("library: circular_joint", "", lambda: circular_joint(_RADIUS, phi, _MOMENT, N).P),
        Method("printed: primitives of the arc", "", lambda: printed.ring(_RADIUS, phi, _MOMENT, N)["P"], _CLOSES),
        Method("quad, each force", "", partial(_bolts, phi, N, np.vectorize(_quadrature)), "one after the other"),
        Method("fixed places, no checks", "", partial(_bolts, phi, N, partial(_fixed, *_GAUSS)), UNCHECKED),
        *(Method("rim in strips", str(n), partial(_bolts, phi, N, partial(_fixed, *_strips(n)))) for n in _STRIPS),
    ]
    kappa = condition(lambda x: circular_joint(x["r"], phi, x["M"], x["N"]).P, {"r": _RADIUS, "M": _MOMENT, "N": N})
    return Job(number, "Bolts of a circular joint", truth, methods, kappa)


def _bolts(phi: Any, N: Any, arc: Callable[[Any, Any], Any]) -> Any:
    """Forces of the bolts, from sum and moment of cos(phi) + c over half the pressed arc between its edge and pi."""
    c = N * _RADIUS / (2 * _MOMENT)
    arc_N, arc_M = arc(c, np.arccos(-c))
    stretched = np.maximum(cos(phi) + c[:, None], 0)
    bolt_N, bolt_M = stretched.sum(-1), (stretched * cos(phi)).sum(-1)
    k_t = (N * arc_M - _MOMENT / _RADIUS * arc_N) / (bolt_N * arc_M - bolt_M * arc_N)
    return k_t[:, None] * stretched


def _quadrature(c: float, edge: float) -> tuple[float, float]:
    total, _ = quad(lambda t: cos(t) + c, edge, pi, epsabs=0)
    return total, quad(lambda t: (cos(t) + c) * cos(t), edge, pi, epsabs=0)[0]


def _strips(n: int) -> tuple[Any, Any]:
    """Places on an arc of the length 1, and their weights."""
    return (np.arange(n) + 0.5) / n, np.full(n, 1 / n)


def _fixed(places: Any, weights: Any, c: Any, edge: Any) -> Any:
    arc = (pi - edge)[:, None]
    cosines = cos(edge[:, None] + arc * places)
    load = (cosines + c[:, None]) * (arc * weights)
    return load.sum(-1), (load * cosines).sum(-1)
