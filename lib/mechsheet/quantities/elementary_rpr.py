"""The RPR group in elementary steps."""

from collections.abc import Sequence

import numpy as np

from mechsheet.mechanics.group import Reach
from mechsheet.mechanics.load import Load
from mechsheet.mechanics.rpr import RPRAcceleration, RPRPosition, RPRReactions, RPRVelocity
from mechsheet.quantities.elementary_group import determinant, lever, loaded_end, none
from mechsheet.quantities.elementary_planar import Quantity, angle_between, cross, dot, settled, step, unit, whole


def rpr(A: Quantity, B: Quantity, branch: Quantity, offset: Quantity = 0) -> RPRPosition:
    d = A - B
    L = np.abs(d)
    if none(offset):
        s = step("s", "m", "distance along the slide", branch * L)
        return RPRPosition(d / s, s)
    e = step("e", "m", "offset, no more than the distance of the pins", np.clip(offset, -L, L))
    excess = settled(L - np.abs(offset), (2 * L + np.abs(A) + np.abs(B)) / 4)
    s = step("s", "m", "distance along the slide", branch * np.sqrt(excess * (L + np.abs(offset))))
    return RPRPosition(d / (s + 1j * e), s)


def rpr_reach(A: Quantity, B: Quantity) -> Reach:
    L = np.abs(A - B)
    return Reach(-L, L)


def _swinging(d: Quantity, u: Quantity, w: Quantity, D: Quantity) -> tuple[Quantity, Quantity]:
    return cross(u, w) / D, dot(w, d) / D


def rpr_velocity(A: Quantity, B: Quantity, u: Quantity, v_A: Quantity = 0, v_B: Quantity = 0) -> RPRVelocity:
    return RPRVelocity(*_swinging(A - B, unit(u), v_A - v_B, rpr_determinant(A, B, u)))


def rpr_acceleration(
    A: Quantity, B: Quantity, u: Quantity, omega_A: Quantity, ds: Quantity, a_A: Quantity = 0, a_B: Quantity = 0
) -> RPRAcceleration:
    d, u = A - B, unit(u)
    known = 2j * omega_A * ds * u - omega_A**2 * d
    return RPRAcceleration(*_swinging(d, u, a_A - a_B - known, rpr_determinant(A, B, u)))


def rpr_determinant(A: Quantity, B: Quantity, u: Quantity) -> Quantity:
    return determinant(dot(A - B, unit(u)), np.abs(A) + np.abs(B), "m")


def rpr_transmission_angle(A: Quantity, B: Quantity, u: Quantity) -> Quantity:
    return angle_between(A - B, 1j * u)


def rpr_condition(A: Quantity, B: Quantity, u: Quantity) -> Quantity:
    d, size = A - B, np.abs(A) + np.abs(B)
    return (size + np.abs(d)) / np.abs(settled(dot(d, unit(u)), size))


def rpr_reactions(
    A: Quantity, B: Quantity, u: Quantity, loads_A: Sequence[Load] = (), loads_B: Sequence[Load] = ()
) -> RPRReactions:
    u = unit(u)
    (F_A, T_A), (F_B, T_B) = loaded_end(loads_A, A, "A"), loaded_end(loads_B, B, "B")
    N = step("N", "N", "force of the slide, to the left of it", (T_A + T_B) / rpr_determinant(A, B, u))
    R_C = whole(1j * N * u, u, N)
    return RPRReactions(-(R_C + F_A), R_C - F_B, R_C, -T_A, lever(-T_A, N))
