"""The RPP group in elementary steps."""

from collections.abc import Sequence

from mechsheet.mechanics.load import Load
from mechsheet.mechanics.rpp import RPPAcceleration, RPPReactions, RPPVelocity
from mechsheet.quantities.elementary_group import along, lever, loaded_end
from mechsheet.quantities.elementary_planar import Quantity, cross, unit, whole
from mechsheet.quantities.elementary_prp import prp, prp_condition, prp_determinant, prp_reach, prp_transmission_angle

rpp, rpp_reach, rpp_determinant = prp, prp_reach, prp_determinant  # the same lines, seen from another body
rpp_transmission_angle, rpp_condition = prp_transmission_angle, prp_condition


def rpp_velocity(
    A: Quantity,
    B: Quantity,
    C: Quantity,
    u_A: Quantity,
    u_B: Quantity,
    v_A: Quantity = 0,
    v_B: Quantity = 0,
    omega_B: Quantity = 0,
) -> RPPVelocity:
    u_A, u_B = unit(u_A), unit(u_B)
    ds_A, ds_B = along(u_A, u_B, v_A - v_B - 1j * omega_B * (A - B))
    return RPPVelocity(whole(v_B + 1j * omega_B * (C - B) + ds_B * u_B, u_B, ds_B), ds_A, ds_B)


def rpp_acceleration(
    A: Quantity,
    B: Quantity,
    C: Quantity,
    u_A: Quantity,
    u_B: Quantity,
    ds_A: Quantity,
    ds_B: Quantity,
    omega_B: Quantity = 0,
    a_A: Quantity = 0,
    a_B: Quantity = 0,
    epsilon_B: Quantity = 0,
) -> RPPAcceleration:
    u_A, u_B = unit(u_A), unit(u_B)
    turning, coriolis_B = 1j * epsilon_B - omega_B**2, 2j * omega_B * ds_B * u_B
    known = a_B + turning * (A - B) + 2j * omega_B * ds_A * u_A + coriolis_B
    dds_A, dds_B = along(u_A, u_B, a_A - known)
    a_C = whole(a_B + turning * (C - B) + coriolis_B + dds_B * u_B, u_B, dds_B)
    return RPPAcceleration(a_C, dds_A, dds_B)


def rpp_reactions(
    A: Quantity, C: Quantity, u_A: Quantity, u_B: Quantity, loads_A: Sequence[Load] = (), loads_B: Sequence[Load] = ()
) -> RPPReactions:
    u_A, u_B = unit(u_A), unit(u_B)
    (F_A, T_A), (F_B, T_B) = loaded_end(loads_A, A, "A"), loaded_end(loads_B, C, "B")
    N, N_B = along(u_A, u_B, 1j * F_B)
    R_B, R_C = whole(1j * N_B * u_B, u_B, N_B), whole(-1j * N * u_A, u_A, N)
    M_B = -(T_A + cross(A - C, -R_C) + T_B)
    return RPPReactions(-(R_C + F_A), R_B, R_C, M_B, -T_A, lever(M_B, N_B), lever(T_A, N))
