"""The RRR group in elementary steps."""

from collections.abc import Sequence

import numpy as np

from mechsheet.mechanics.group import ROUNDINGS, Reach
from mechsheet.mechanics.load import Load
from mechsheet.mechanics.rrr import RRRAcceleration, RRRReactions, RRRVelocity
from mechsheet.quantities.elementary_group import carried, determinant, loaded_end, moved
from mechsheet.quantities.elementary_planar import Quantity, cross, dot, settled, step, whole


def rrr(A: Quantity, B: Quantity, r_A: Quantity, r_B: Quantity, branch: Quantity) -> Quantity:
    d = step("d", "m", "from the first outer pin to the second", B - A)
    LL = step("LL", "m**2", "squared distance of the outer pins", dot(d, d))
    over, under = (r_A + r_B) ** 2 / LL - 1, 1 - (r_A - r_B) ** 2 / LL
    size = (r_A + r_B + (np.abs(A) + np.abs(B)) / 2) / np.abs(d)
    square = over * under * (np.abs(np.minimum(over, under)) > ROUNDINGS * size)  # zero of links in one line
    along = (1 + (r_A - r_B) * (r_A + r_B) / LL) / 2
    q = step("q", "-", "inner pin along the line of the outer pins, part of it", along)
    h = step("h", "-", "inner pin across that line, part of it", branch * np.sqrt(square) / 2)
    return whole(A + (q + 1j * h) * d, d, h)


def rrr_reach(A: Quantity, B: Quantity, r_A: Quantity) -> Reach:
    L = np.abs(B - A)
    return Reach(np.abs(L - r_A), L + r_A)


def _area(A: Quantity, B: Quantity, C: Quantity) -> tuple[Quantity, Quantity]:
    """Product of the links, by the shorter one and the distance of the outer pins; and what it is made of."""
    a, b, d = C - A, C - B, B - A
    r_A, r_B = np.abs(a), np.abs(b)
    size = np.abs(A) * r_B + np.abs(B) * r_A + np.abs(C) * np.abs(d)
    return np.where(r_A <= r_B, cross(d, a), cross(d, b)), size


def _turning(a: Quantity, b: Quantity, w: Quantity, D: Quantity) -> tuple[Quantity, Quantity]:
    return dot(w, b) / D, dot(w, a) / D


def rrr_velocity(
    A: Quantity,
    B: Quantity,
    C: Quantity,
    v_A: Quantity = 0,
    v_B: Quantity = 0,
    dr_A: Quantity = 0,
    dr_B: Quantity = 0,
) -> RRRVelocity:
    a, b = C - A, C - B
    v_A, v_B = moved(v_A, a, dr_A), moved(v_B, b, dr_B)
    omega_A, omega_B = _turning(a, b, v_B - v_A, rrr_determinant(A, B, C))
    return RRRVelocity(v_A + 1j * omega_A * a, omega_A, omega_B)


def rrr_acceleration(
    A: Quantity,
    B: Quantity,
    C: Quantity,
    omega_A: Quantity,
    omega_B: Quantity,
    dr_A: Quantity = 0,
    dr_B: Quantity = 0,
    a_A: Quantity = 0,
    a_B: Quantity = 0,
    ddr_A: Quantity = 0,
    ddr_B: Quantity = 0,
) -> RRRAcceleration:
    a, b = C - A, C - B
    a_A, a_B = a_A + carried(a, omega_A, dr_A, ddr_A), a_B + carried(b, omega_B, dr_B, ddr_B)
    w = step("w", "m/s**2", "acceleration that the turning of the links must make up", a_B - a_A)
    epsilon_A, epsilon_B = _turning(a, b, w, rrr_determinant(A, B, C))
    return RRRAcceleration(a_A + 1j * epsilon_A * a, epsilon_A, epsilon_B)


def rrr_determinant(A: Quantity, B: Quantity, C: Quantity) -> Quantity:
    return determinant(*_area(A, B, C), "m**2")


def rrr_transmission_angle(A: Quantity, B: Quantity, C: Quantity) -> Quantity:
    area, _ = _area(A, B, C)
    return np.arctan2(np.abs(area), dot(C - A, C - B))


def rrr_condition(A: Quantity, B: Quantity, C: Quantity) -> Quantity:
    r_A, r_B = np.abs(C - A), np.abs(C - B)
    return (np.abs(A) + np.abs(B) + r_A + r_B) * np.maximum(r_A, r_B) / np.abs(settled(*_area(A, B, C)))


def rrr_reactions(
    A: Quantity, B: Quantity, C: Quantity, loads_A: Sequence[Load] = (), loads_B: Sequence[Load] = ()
) -> RRRReactions:
    (F_A, T_A), (F_B, T_B) = loaded_end(loads_A, A, "A"), loaded_end(loads_B, B, "B")
    D = rrr_determinant(A, B, C)
    R_C = -((T_B / D) * (C - A) + (T_A / D) * (C - B))
    return RRRReactions(-(R_C + F_A), R_C - F_B, R_C)
