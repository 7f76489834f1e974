"""Chains of dyads, the hitch among them, by the library and by its closed forms without checks."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy import exp

from mechsheet.accuracy import plain
from mechsheet.accuracy.arithmetic import cross
from mechsheet.mechanics.load import Load
from mechsheet.mechanics.planar import angle
from mechsheet.mechanics.rrr import RRRGroup, rrr, rrr_reactions

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
    """Dyads that hang one on another, the first on the point A(q) that moves by dA(q), and rests or has ddA(q)."""

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

    # Without checks

    def plain_links(self, q: Any) -> list[tuple[Any, Any, Any]]:
        """Pin A and the vectors AC and BC of every dyad."""
        A, found = self.A(q), list[tuple[Any, Any, Any]]()
        for d in self.dyads:
            C = plain.rrr(A, d.B, d.length(q), d.r_B, d.branch)
            found.append((A, C - A, C - d.B))
            A = d.B + d.z * (C - d.B)
        return found

    def plain_pins(self, q: Any) -> Any:
        """As `pins`."""
        return np.array([A + a for A, a, _ in self.plain_links(q)])

    def plain_angles(self, q: Any) -> Any:
        """As `angles`."""
        return np.array([np.angle(link) for _, *links in self.plain_links(q) for link in links])

    def plain_analogues(self, order: int, q: Any) -> Any:
        """As `analogues`."""
        dA, found = self.dA(q), list[Any]()
        ddA: Any = 0
        for (_, a, b), d in zip(self.plain_links(q), self.dyads, strict=True):
            r, lengthens = abs(a), d.r_A is None
            omega_A, omega_B = plain.rrr_turns(a, b, -dA - (a / r if lengthens else 0))
            dA = 1j * d.z * omega_B * b
            if order == 1:
                found += [omega_A, omega_B]
                continue
            x, epsilon_B = plain.rrr_turns(a, b, omega_A**2 * a - omega_B**2 * b - ddA)
            found += [x - 2 * omega_A / r if lengthens else x, epsilon_B]
            ddA = d.z * (1j * epsilon_B - omega_B**2) * b
        return np.array(found)[1:]


def crank_chain(l_1: Any, B: Any, l_A: Any, l_B: Any) -> Chain:
    """A dyad on a crank about 0, over the angle of the crank."""
    return Chain(lambda q: l_1 * exp(1j * q), lambda q: 1j * l_1 * exp(1j * q), (Dyad(B, l_A, l_B, +1),))


# --- hitch --------------------------------------------------------------------------------------------------------


def hinges(h: Any) -> tuple[complex, ...]:
    """O1, O3, O5, O7 of the hitch with the inputs ``h``."""
    return tuple(getattr(h, f"X0{k}") + 1j * getattr(h, f"Y0{k}") for k in (1, 3, 5, 7))


def arm(h: Any) -> Any:
    """The side of the hitch's lift arm next to the rod over the one next to the cylinder."""
    return h.L34 / h.L3 * exp(1j * h.phi_BD)


def arm_pin(h: Any, S: Any) -> Any:
    """P34 of the hitch, the end of its lift arm."""
    O1, O3, *_ = hinges(h)
    return O3 + arm(h) * (rrr(O1, O3, S, h.L3, -1) - O3)


def hitch_chain(h: Any, L4: Any, L7: Any) -> Chain:
    """The hitch with the inputs ``h`` over the length of its cylinder."""
    O1, O3, O5, O7 = hinges(h)
    dyads = Dyad(O3, None, h.L3, -1, arm(h)), Dyad(O5, L4, h.L5, +1, h.L56 / h.L5), Dyad(O7, h.L6, L7, -1)
    return Chain(lambda q: O1 + 0 * q, lambda q: 0 * q, dyads)


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


def plain_hitch_reactions(h: Any, p: dict[str, Any]) -> Any:
    """As `hitch_reactions`, without checks."""
    O1, O3, O5, O7 = hinges(h)
    P34, P56, G6 = p["P34_S"], p["P56_S"], -1j * h.P6
    R56, R07, _ = plain.rrr_forces(P56, O7, p["P67_S"], G6, cross(p["PS6_S"] - P56, G6), 0, 0)
    R4, R5, _ = plain.rrr_forces(P34, O5, p["P45_S"], 0, 0, -R56, cross(P56 - O5, -R56))
    R01, R03, _ = plain.rrr_forces(O1, O3, p["P23_S"], 0, 0, -R4, cross(P34 - O3, -R4))
    return np.array([R56, R07, -R4, -R5, R01, R03])
