"""The RRP group in elementary steps."""

from collections.abc import Sequence

import numpy as np

from mechsheet.mechanics.group import Reach
from mechsheet.mechanics.load import Load
from mechsheet.mechanics.rrp import RRPAcceleration, RRPReactions, RRPVelocity
from mechsheet.quantities.elementary_group import carried, determinant, lever, loaded_end, moved
from mechsheet.quantities.elementary_planar import Quantity, angle_between, cross, dot, settled, step, unit, whole


def rrp(A: Quantity, B: Quantity, u: Quantity, r_A: Quantity, branch: Quantity, offset: Quantity = 0) -> Quantity:
    u = unit(u)
    h = step("h", "m", "outer pin to the left of the pin's path", cross(u, A - B) - offset)
    excess = settled(r_A - np.abs(h), (2 * r_A + np.abs(A) + np.abs(B) + np.abs(offset)) / 4)
    ahead = step("x", "m", "pin ahead of the outer pin", branch * np.sqrt(excess * (r_A + np.abs(h))))
    return whole(A + (ahead - 1j * h) * u, u, ahead)


def rrp_reach(A: Quantity, B: Quantity, u: Quantity, offset: Quantity = 0) -> Reach:
    return Reach(np.abs(cross(unit(u), A - B) - offset), np.asarray(np.inf))


def _sliding(a: Quantity, u: Quantity, w: Quantity, D: Quantity) -> tuple[Quantity, Quantity]:
    return cross(u, w) / D, -dot(w, a) / D


def rrp_velocity(
    A: Quantity,
    B: Quantity,
    C: Quantity,
    u: Quantity,
    v_A: Quantity = 0,
    v_B: Quantity = 0,
    omega_B: Quantity = 0,
    dr_A: Quantity = 0,
) -> RRPVelocity:
    a, u = C - A, unit(u)
    guide = v_B + 1j * omega_B * (C - B)
    omega_A, ds = _sliding(a, u, guide - moved(v_A, a, dr_A), rrp_determinant(A, C, u))
    return RRPVelocity(whole(guide + ds * u, u, ds), omega_A, ds)


def rrp_acceleration(
    A: Quantity,
    B: Quantity,
    C: Quantity,
    u: Quantity,
    omega_A: Quantity,
    ds: Quantity,
    omega_B: Quantity = 0,
    dr_A: Quantity = 0,
    a_A: Quantity = 0,
    a_B: Quantity = 0,
    epsilon_B: Quantity = 0,
    ddr_A: Quantity = 0,
) -> RRPAcceleration:
    a, u = C - A, unit(u)
    guide = a_B + (1j * epsilon_B - omega_B**2) * (C - B) + 2j * omega_B * ds * u
    w = guide - a_A - carried(a, omega_A, dr_A, ddr_A)
    epsilon_A, dds = _sliding(a, u, w, rrp_determinant(A, C, u))
    return RRPAcceleration(whole(guide + dds * u, u, dds), epsilon_A, dds)


def rrp_determinant(A: Quantity, C: Quantity, u: Quantity) -> Quantity:
    return determinant(dot(C - A, unit(u)), np.abs(A) + np.abs(C), "m")


def rrp_transmission_angle(A: Quantity, C: Quantity, u: Quantity) -> Quantity:
    return angle_between(C - A, 1j * u)


def rrp_condition(A: Quantity, B: Quantity, C: Quantity, u: Quantity) -> Quantity:
    a, A_, C_ = C - A, np.abs(A), np.abs(C)
    return (A_ + np.abs(B) + np.abs(C - B) + np.abs(a)) / np.abs(settled(dot(a, unit(u)), A_ + C_))


def rrp_reactions(
    A: Quantity, C: Quantity, u: Quantity, loads_A: Sequence[Load] = (), loads_B: Sequence[Load] = ()
) -> RRPReactions:
    u, a = unit(u), C - A
    (F_A, T_A), (F_B, T_B) = loaded_end(loads_A, A, "A"), loaded_end(loads_B, C, "B")
    N = step("N", "N", "force of the guide, to the left of it", -(T_A + cross(a, F_B)) / rrp_determinant(A, C, u))
    R_B = whole(1j * N * u, u, N)
    R_C = R_B + F_B
    return RRPReactions(-(R_C + F_A), R_B, R_C, -T_B, lever(-T_B, N))
