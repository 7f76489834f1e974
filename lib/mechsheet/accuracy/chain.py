"""The hitch and a crank with a dyad as chains of dyads, computed by the library: its own ways to do each job."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy import exp

from mechsheet.mechanics.load import Load
from mechsheet.mechanics.planar import angle
from mechsheet.mechanics.rrr import rrr, rrr_acceleration, rrr_reactions, rrr_velocity

Pins = list[tuple[Any, Any]]  # A and C of every dyad
REACTIONS = ("R56", "R07", "R34", "R05", "R01", "R03")  # of the hitch, in the order in which all methods list them


@dataclass(frozen=True)
class Dyad:
    """Links AC and BC, and the point that the rocker BC carries: B + z (C - B) is the next dyad's pin A."""

    B: complex
    r_A: float | None  # None: the coordinate itself, a driving cylinder
    r_B: float
    branch: int
    z: complex = 0


@dataclass(frozen=True)
class Chain:
    """Dyads that hang one on another, the first on the point A(q) that moves by dA(q)."""

    A: Callable[[Any], Any]
    dA: Callable[[Any], Any]
    dyads: tuple[Dyad, ...]


def hinges(h: Any) -> tuple[complex, ...]:
    """O1, O3, O5, O7 of the hitch with the inputs ``h``."""
    return tuple(getattr(h, f"X0{k}") + 1j * getattr(h, f"Y0{k}") for k in (1, 3, 5, 7))


def hitch_chain(h: Any, L4: float, L7: float) -> Chain:
    """The hitch with the inputs ``h`` over the length of its cylinder."""
    O1, O3, O5, O7 = hinges(h)
    dyads = (
        Dyad(O3, None, h.L3, -1, h.L34 / h.L3 * exp(1j * h.phi_BD)),
        Dyad(O5, L4, h.L5, +1, h.L56 / h.L5),
        Dyad(O7, h.L6, L7, -1),
    )
    return Chain(lambda q: O1 + 0 * q, lambda q: 0 * q, dyads)


def arm_pin(h: Any, S: Any) -> Any:
    """P34 of the hitch, the end of its lift arm."""
    O1, O3, *_ = hinges(h)
    return O3 + h.L34 / h.L3 * exp(1j * h.phi_BD) * (rrr(O1, O3, S, h.L3, -1) - O3)


def crank_chain(l_1: float, B: complex, l_A: float, l_B: float) -> Chain:
    """A dyad on a crank about 0, over the angle of the crank."""
    return Chain(lambda q: l_1 * exp(1j * q), lambda q: 1j * l_1 * exp(1j * q), (Dyad(B, l_A, l_B, +1),))


def chain_pins(chain: Chain, q: Any) -> Pins:
    """Pins A and C of all dyads."""
    A, pins = chain.A(q), []
    for d in chain.dyads:
        C = rrr(A, d.B, q if d.r_A is None else d.r_A, d.r_B, d.branch)
        pins.append((A, C))
        A = d.B + d.z * (C - d.B)
    return pins


def inner_pins(chain: Chain, q: Any) -> Any:
    """Inner pins of all dyads."""
    return np.array([C for _, C in chain_pins(chain, q)])


def link_angles(chain: Chain, q: Any) -> Any:
    """Angles of the links AC, BC of every dyad."""
    ends = zip(chain_pins(chain, q), chain.dyads, strict=True)
    return np.array([phi for (A, C), d in ends for phi in (angle(C - A), angle(C - d.B))])


def _velocities(chain: Chain, q: Any, pins: Pins) -> list[Any]:
    dA, found = chain.dA(q), []
    for (A, C), d in zip(pins, chain.dyads, strict=True):
        v = rrr_velocity(A, d.B, C, dA, dr_A=float(d.r_A is None))
        found.append(v)
        dA = d.z * v.v_C
    return found


def first_analogues(chain: Chain, q: Any) -> Any:
    """Velocity analogues of the links but the cylinder."""
    found = _velocities(chain, q, chain_pins(chain, q))
    return np.array([w for v in found for w in (v.omega_A, v.omega_B)])[1:]


def second_analogues(chain: Chain, q: Any) -> Any:
    """Acceleration analogues of the links but the cylinder, of a chain whose first pin A rests."""
    pins = chain_pins(chain, q)
    ddA: Any = 0
    found = list[Any]()
    for (A, C), d, v in zip(pins, chain.dyads, _velocities(chain, q, pins), strict=True):
        a = rrr_acceleration(A, d.B, C, v.omega_A, v.omega_B, dr_A=float(d.r_A is None), a_A=ddA)
        found += [a.epsilon_A, a.epsilon_B]
        ddA = d.z * a.a_C
    return np.array(found)[1:]


def hitch_points(h: Any, S: Any, L4: float, L7: float, S6: Any) -> dict[str, Any]:
    """Pins of the hitch by their names in the worksheet, and the centre of mass S6 [m] of the implement."""
    (_, P23), (P34, P45), (P56, P67) = chain_pins(hitch_chain(h, L4, L7), S)
    return {"P23_S": P23, "P34_S": P34, "P45_S": P45, "P56_S": P56, "P67_S": P67, "PS6_S": S6}


def hitch_reactions(h: Any, p: dict[str, Any]) -> Any:
    """The six `REACTIONS` to the weight of the implement."""
    O1, O3, O5, O7 = hinges(h)
    group_67 = rrr_reactions(p["P56_S"], O7, p["P67_S"], [Load(-1j * h.P6, p["PS6_S"])])
    group_45 = rrr_reactions(p["P34_S"], O5, p["P45_S"], [], [Load(-group_67.R_A, p["P56_S"])])
    group_23 = rrr_reactions(O1, O3, p["P23_S"], [], [Load(-group_45.R_A, p["P34_S"])])
    return np.array([group_67.R_A, group_67.R_B, -group_45.R_A, -group_45.R_B, group_23.R_A, group_23.R_B])
