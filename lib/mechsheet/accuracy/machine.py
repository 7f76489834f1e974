"""Two more jobs: reactions of a machine with groups of all three kinds, and the bolts of a circular joint.

The reactions start from the pins and loads that the worksheet ``kinetostatics`` computes: these floats are the exact
numbers of the job, whose truth is the equilibrium of the six bodies at 50 digits.
"""

from collections.abc import Callable, Sequence
from functools import partial
from types import SimpleNamespace
from typing import Any

import numpy as np
from numpy import angle, arctan2, cos, exp, hypot, pi, sin
from scipy.integrate import quad

from mechsheet.accuracy import exact
from mechsheet.accuracy.arithmetic import mpc, mpf, pin, reactions, slide
from mechsheet.accuracy.dense import dense
from mechsheet.accuracy.precision import Job, Method
from mechsheet.mechanics.equilibrium import PinReaction, Reaction, SlideReaction, solve_reactions
from mechsheet.mechanics.joint import circular_joint
from mechsheet.mechanics.load import Load
from mechsheet.mechanics.rpr import rpr_reactions
from mechsheet.mechanics.rrp import rrp_reactions
from mechsheet.mechanics.rrr import rrr_reactions
from mechsheet.worksheet.cells import Worksheet

Points = Any  # the points, directions and loads of the machine by the worksheet's names, over the positions

# Worksheet's names of the loads on the bodies 2 to 7: force, the point where it acts, couple.
_LOADS: tuple[tuple[str, str, str | None], ...] = (
    ("F2_sum", "S2", "M_in2"),
    ("F3_own", "S3", "M_in3"),
    ("F4_sum", "S4", "M_in4"),
    ("F5_sum", "E", None),
    ("F6_sum", "S6", "M_in6"),
    ("F7_sum", "S7", "M_in7"),
)
_GIVEN = ("A", "B", "C", "D", "E", "K", "H", "u5", *(x for row in _LOADS for x in row if x))


def machine_job(number: str, sheet: Worksheet, N: int) -> Job:
    """Reactions in the pins A to E, K, H and in both prismatic pairs of the worksheet ``kinetostatics``, all ways."""
    given = {"g": sheet.inputs(), "phi1": 2 * pi * np.arange(N) / N}
    p = SimpleNamespace(**sheet.run(_GIVEN, given))
    p.u7 = (p.K - p.H) / np.abs(p.K - p.H)
    ways: dict[str, Callable[[], Any]] = {
        "library: groups": partial(_by_groups, p),
        "library: solve_reactions": partial(_by_bodies, p),
        "printed: elimination": partial(_printed, p.g, p),
        "dense system": lambda: np.array(_forces(dense(6, _pairs(p), _loads(p)), p)),
    }
    settings = {"library: solve_reactions": "18 × 18", "dense system": "18 × 18"}
    methods = [Method(family, settings.get(family, ""), way) for family, way in ways.items()]
    each = [_exactly(p, k) for k in range(N)]
    return Job(number, "Reactions of groups of all kinds", [x for way in zip(*each, strict=True) for x in way], methods)


def _pairs(p: Points) -> list[tuple[Any, ...]]:
    """Pins and slides of the bodies 2 to 7, here counted from 1, as `dense` takes them."""
    pins = [(p.A, 1, 0), (p.B, 2, 1), (p.C, 2, 0), (p.D, 3, 2), (p.E, 4, 3), (p.K, 5, 2), (p.H, 6, 0)]
    return [*pins, (p.E, p.u5, 4, 0), (p.K, p.u7, 5, 6)]


def _loads(p: Points) -> list[tuple[Any, ...]]:
    rows = enumerate(_LOADS, 1)
    return [(k, getattr(p, F), getattr(p, S), getattr(p, M) if M else 0 * p.A.real) for k, (F, S, M) in rows]


def _forces(x: Any, p: Points) -> list[Any]:
    """Forces in A, B, C, D, E, K, H and in the prismatic pairs from the solution of the equations."""
    return [*(x[k] + 1j * x[k + 1] for k in range(0, 14, 2)), 1j * x[14] * p.u5, 1j * x[16] * p.u7]


def _exactly(p: Points, k: int) -> list[Any]:
    """The forces at one position at 50 digits."""
    given = {name: np.broadcast_to(getattr(p, name), p.A.shape)[k] for name in (*_GIVEN, "u7")}
    at = SimpleNamespace(**{name: mpc(x) if np.iscomplexobj(x) else mpf(x) for name, x in given.items()})
    pairs = [[*place, on - 1, by - 1 if by else None] for *place, on, by in _pairs(at)]
    unknowns = [unknown for pair in pairs for unknown in (pin(*pair) if len(pair) == 3 else slide(*pair))]
    loads = [(body - 1, *load) for body, *load in _loads(at)]
    return _forces(reactions(unknowns, loads, [at.A, at.C, at.D, at.E, at.K, at.H]), at)


def _by_groups(p: Points) -> Any:
    F2, F3, F4, F5, F6, F7 = (Load(F, S, M) for _, F, S, M in _loads(p))
    of_45 = rrp_reactions(p.D, p.E, p.u5, [F4], [F5])
    of_67 = rpr_reactions(p.K, p.H, p.K - p.H, [F6], [F7])
    of_23 = rrr_reactions(p.A, p.C, p.B, [F2], [F3, Load(-of_45.R_A, p.D), Load(-of_67.R_A, p.K)])
    hinges = of_23.R_A, -of_23.R_C, of_23.R_B, of_45.R_A, -of_45.R_C, of_67.R_A, of_67.R_B
    return np.array([*hinges, of_45.R_B, of_67.R_C])


def _by_bodies(p: Points) -> Any:
    """The library's system of all bodies; which forces its reactions have is not looked at."""
    pairs: list[Reaction] = []
    for *place, on, by in _pairs(p):
        pairs.append(SlideReaction(on, by, 0, *place) if len(place) == 2 else PinReaction(on, by, 0, *place))
    x = solve_reactions([[Load(F, S, M)] for _, F, S, M in _loads(p)], pairs)
    return np.array(_forces(x.T, p))


def _printed(g: Any, p: Points) -> Any:
    """Programs SR2, SR3 and SR1: forces across the links by moments, those along them by elimination."""

    def across(F: Any, arm: Any, phi: Any, M: Any, length: Any) -> Any:
        return (np.abs(F) * arm * sin(phi - angle(F)) + M) / length

    def sums(turned: Sequence[tuple[Any, Any]], *forces: Any) -> tuple[Any, Any]:
        polar = [*turned, *((np.abs(F), angle(F)) for F in forces)]
        return sum(F * cos(a) for F, a in polar), sum(F * sin(a) for F, a in polar)

    def joined(along: Any, over: Any, phi: Any) -> Any:
        return hypot(along, over) * exp(1j * (phi + arctan2(over, along)))

    phi2, phi3, phi4, phi6 = angle(p.B - p.A), angle(p.B - p.C), angle(p.E - p.D), angle(p.H - p.K)
    R34_t = across(p.F4_sum, g.l_ES4, phi4, p.M_in4, g.l4)
    A, B = sums([(R34_t, phi4 + pi / 2)], p.F4_sum, p.F5_sum)
    R_D = joined(-(A * cos(g.phi05) + B * sin(g.phi05)) / cos(phi4 - g.phi05), R34_t, phi4)
    R_05 = (A * sin(phi4) - B * cos(phi4)) / cos(phi4 - g.phi05) * exp(1j * (g.phi05 + pi / 2))
    l_HK = np.abs(p.H - p.K)
    T6 = across(p.F6_sum, l_HK - g.l_KS6, phi6, p.M_in6, 1)
    R36_t = (T6 + across(p.F7_sum, g.l_HS7, phi6, p.M_in7, 1)) / l_HK
    A, B = sums([(R36_t, phi6 + pi / 2)], p.F6_sum)
    R_K = joined(-(A * cos(phi6) + B * sin(phi6)), R36_t, phi6)
    R_76 = (A * sin(phi6) - B * cos(phi6)) * exp(1j * (phi6 + pi / 2))
    F3 = p.F3_own - R_D - R_K
    M3 = p.M_in3 - ((np.conj(p.D - p.S3) * R_D).imag + (np.conj(p.K - p.S3) * R_K).imag)
    R12_t, R03_t = across(p.F2_sum, g.l_BS2, phi2, p.M_in2, g.l2), across(F3, g.l_BS3, phi3, M3, g.l3)
    A, B = sums([(R12_t, phi2 + pi / 2), (R03_t, phi3 + pi / 2)], p.F2_sum, F3)
    R_A = joined(-(A * sin(phi3) - B * cos(phi3)) / sin(phi3 - phi2), R12_t, phi2)
    R_C = joined(-(A * sin(phi2) - B * cos(phi2)) / sin(phi2 - phi3), R03_t, phi3)
    return np.array([R_A, -(R_C + F3), R_C, R_D, -(R_05 + p.F5_sum), R_K, R_76 - p.F7_sum, R_05, R_76])


# Circular joint


_BOLTS, _RADIUS, _MOMENT = 24, 0.6, 1e5  # the joint: number, m, N m
_STRIPS = 30, 100, 300, 1000


def ring_job(number: str, count: int) -> Job:
    """Forces of 24 even bolts of a circular joint, all ways: from no normal force to one that all but lifts the rim."""
    phi = 2 * pi * np.arange(_BOLTS) / _BOLTS
    N = 2 * _MOMENT / _RADIUS * (1 - np.geomspace(1e-9, 1, count))
    truth = [force for each in N for force in exact.ring(phi.tolist(), _RADIUS, _MOMENT, each)["P"]]
    methods = [
        Method("library: circular_joint", "", lambda: circular_joint(_RADIUS, phi, _MOMENT, N).P),
        Method("primitives of the arc", "", partial(_bolts, phi, N, _primitives)),
        Method("quad, each force", "", partial(_bolts, phi, N, np.vectorize(_quadrature))),
        *(Method("rim in strips", str(n), partial(_bolts, phi, N, partial(_strips, n))) for n in _STRIPS),
    ]
    return Job(number, "Bolts of a circular joint", truth, methods)


def _bolts(phi: Any, N: Any, arc: Callable[[Any, Any], Any]) -> Any:
    """Forces of the bolts, from sum and moment of cos(phi) + c over half the pressed arc between its edge and pi."""
    c = N * _RADIUS / (2 * _MOMENT)
    arc_N, arc_M = arc(c, np.arccos(-c))
    stretched = np.maximum(cos(phi) + c[:, None], 0)
    bolt_N, bolt_M = stretched.sum(-1), (stretched * cos(phi)).sum(-1)
    k_t = (N * arc_M - _MOMENT / _RADIUS * arc_N) / (bolt_N * arc_M - bolt_M * arc_N)
    return k_t[:, None] * stretched


def _primitives(c: Any, edge: Any) -> Any:
    return c * (pi - edge) - sin(edge), (pi - edge) / 2 - sin(2 * edge) / 4 - c * sin(edge)


def _quadrature(c: float, edge: float) -> tuple[float, float]:
    total, _ = quad(lambda t: cos(t) + c, edge, pi, epsabs=0)
    return total, quad(lambda t: (cos(t) + c) * cos(t), edge, pi, epsabs=0)[0]


def _strips(n: int, c: Any, edge: Any) -> Any:
    t = edge[:, None] + (pi - edge)[:, None] * (np.arange(n) + 0.5) / n
    load = (cos(t) + c[:, None]) * ((pi - edge) / n)[:, None]
    return load.sum(-1), (load * cos(t)).sum(-1)
