"""The RPR group in elementary steps."""

from collections.abc import Sequence

import numpy as np

from mechsheet.mechanics.group import Reach
from mechsheet.mechanics.load import Load
from mechsheet.mechanics.rpr import RPRAcceleration, RPRPosition, RPRReactions, RPRVelocity
from mechsheet.quantities.elementary_group import loaded_end
from mechsheet.quantities.elementary_planar import Quantity, angle_between, cross, dot, step, unit


def rpr(A: Quantity, B: Quantity, branch: Quantity, offset: Quantity = 0) -> RPRPosition:
    d = A - B
    s = step("s", "m", "distance along the slide", branch * np.sqrt(dot(d, d) - offset**2))
    return RPRPosition(d / (s + 1j * offset), s)


def rpr_reach(A: Quantity, B: Quantity) -> Reach:
    L = np.abs(A - B)
    return Reach(-L, L)


def _swinging(d: Quantity, u: Quantity, w: Quantity) -> tuple[Quantity, Quantity]:
    p = cross(u, w) / dot(u, d)
    return p, dot(u, w) + p * cross(u, d)


def rpr_velocity(A: Quantity, B: Quantity, u: Quantity, v_A: Quantity = 0, v_B: Quantity = 0) -> RPRVelocity:
    return RPRVelocity(*_swinging(A - B, unit(u), v_A - v_B))


def rpr_acceleration(
    A: Quantity, B: Quantity, u: Quantity, omega_A: Quantity, ds: Quantity, a_A: Quantity = 0, a_B: Quantity = 0
) -> RPRAcceleration:
    d, u = A - B, unit(u)
    known = 2j * omega_A * ds * u - omega_A**2 * d
    return RPRAcceleration(*_swinging(d, u, a_A - a_B - known))


def rpr_determinant(A: Quantity, B: Quantity, u: Quantity) -> Quantity:
    return dot(A - B, unit(u))


def rpr_transmission_angle(A: Quantity, B: Quantity, u: Quantity) -> Quantity:
    return angle_between(A - B, 1j * u)


def rpr_condition(A: Quantity, B: Quantity, u: Quantity) -> Quantity:
    d = A - B
    return (np.abs(A) + np.abs(B) + np.abs(d)) / np.abs(dot(d, unit(u)))


def rpr_reactions(
    A: Quantity, B: Quantity, u: Quantity, loads_A: Sequence[Load] = (), loads_B: Sequence[Load] = ()
) -> RPRReactions:
    u = unit(u)
    (F_A, T_A), (F_B, T_B) = loaded_end(loads_A, A, "A"), loaded_end(loads_B, B, "B")
    N = step("N", "N", "force of the slide, to the left of it", (T_A + T_B) / dot(A - B, u))
    R_C = 1j * N * u
    return RPRReactions(-(R_C + F_A), R_C - F_B, R_C, -T_A, -T_A / N)
