"""The PRP group in elementary steps."""

from collections.abc import Sequence

import numpy as np

from mechsheet.mechanics.group import Reach
from mechsheet.mechanics.load import Load
from mechsheet.mechanics.prp import PRPAcceleration, PRPReactions, PRPVelocity
from mechsheet.quantities.elementary_group import along, lever, loaded_end, of_guides
from mechsheet.quantities.elementary_planar import Quantity, angle_between, cross, settled, unit, whole


def prp(A: Quantity, B: Quantity, u_A: Quantity, u_B: Quantity) -> Quantity:
    u_A, u_B = unit(u_A), unit(u_B)
    along_A, _ = along(u_A, u_B, B - A)
    return whole(A + along_A * u_A, u_A, along_A)


def prp_reach(A: Quantity, B: Quantity, u_A: Quantity, u_B: Quantity) -> Reach:
    return Reach(np.asarray(-np.inf), np.asarray(np.inf))


def prp_velocity(
    A: Quantity,
    B: Quantity,
    C: Quantity,
    u_A: Quantity,
    u_B: Quantity,
    v_A: Quantity = 0,
    v_B: Quantity = 0,
    omega_A: Quantity = 0,
    omega_B: Quantity = 0,
) -> PRPVelocity:
    u_A, u_B = unit(u_A), unit(u_B)
    guide_A, guide_B = v_A + 1j * omega_A * (C - A), v_B + 1j * omega_B * (C - B)
    ds_A, ds_B = along(u_A, -u_B, guide_B - guide_A)
    return PRPVelocity(whole(guide_A + ds_A * u_A, u_A, ds_A), ds_A, ds_B)


def prp_acceleration(
    A: Quantity,
    B: Quantity,
    C: Quantity,
    u_A: Quantity,
    u_B: Quantity,
    ds_A: Quantity,
    ds_B: Quantity,
    omega_A: Quantity = 0,
    omega_B: Quantity = 0,
    a_A: Quantity = 0,
    a_B: Quantity = 0,
    epsilon_A: Quantity = 0,
    epsilon_B: Quantity = 0,
) -> PRPAcceleration:
    u_A, u_B = unit(u_A), unit(u_B)
    guide_A = a_A + (1j * epsilon_A - omega_A**2) * (C - A) + 2j * omega_A * ds_A * u_A
    guide_B = a_B + (1j * epsilon_B - omega_B**2) * (C - B) + 2j * omega_B * ds_B * u_B
    dds_A, dds_B = along(u_A, -u_B, guide_B - guide_A)
    return PRPAcceleration(whole(guide_A + dds_A * u_A, u_A, dds_A), dds_A, dds_B)


def prp_determinant(u_A: Quantity, u_B: Quantity) -> Quantity:
    return of_guides(unit(u_A), unit(u_B))


def prp_transmission_angle(u_A: Quantity, u_B: Quantity) -> Quantity:
    return angle_between(u_A, u_B)


def prp_condition(u_A: Quantity, u_B: Quantity) -> Quantity:
    return 1 / np.abs(settled(cross(unit(u_A), unit(u_B)), 2.0))


def prp_reactions(
    C: Quantity, u_A: Quantity, u_B: Quantity, loads_A: Sequence[Load] = (), loads_B: Sequence[Load] = ()
) -> PRPReactions:
    u_A, u_B = unit(u_A), unit(u_B)
    (F_A, T_A), (F_B, T_B) = loaded_end(loads_A, C, "A"), loaded_end(loads_B, C, "B")
    N_A, N_B = along(u_A, u_B, 1j * (F_A + F_B))
    R_A, R_B = whole(1j * N_A * u_A, u_A, N_A), whole(1j * N_B * u_B, u_B, N_B)
    return PRPReactions(R_A, R_B, -(R_A + F_A), -T_A, -T_B, lever(-T_A, N_A), lever(-T_B, N_B))
