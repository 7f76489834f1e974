"""Assur groups, loads and drives in elementary steps."""

from collections.abc import Sequence
from functools import reduce
from typing import Any

import numpy as np

from mechsheet.mechanics.drive import CouplingDrive, CylinderDrive, GearDrive
from mechsheet.mechanics.group import Reach
from mechsheet.mechanics.load import Load
from mechsheet.mechanics.prp import PRPAcceleration, PRPReactions, PRPVelocity
from mechsheet.mechanics.rpp import RPPAcceleration, RPPReactions, RPPVelocity
from mechsheet.mechanics.rpr import RPRAcceleration, RPRPosition, RPRReactions, RPRVelocity
from mechsheet.mechanics.rrp import RRPAcceleration, RRPReactions, RRPVelocity
from mechsheet.mechanics.rrr import RRRAcceleration, RRRReactions, RRRVelocity
from mechsheet.quantities.elementary_planar import Quantity, angle_between, cross, dot, step, unit, whole


def rrr(A: Quantity, B: Quantity, r_A: Quantity, r_B: Quantity, branch: Quantity) -> Quantity:
    d = step("d", "m", "from the first outer pin to the second", B - A)
    LL = step("LL", "m**2", "squared distance of the outer pins", dot(d, d))
    q = step("q", "-", "inner pin along the line of the outer pins, part of it", (LL + r_A**2 - r_B**2) / (2 * LL))
    h = step("h", "-", "inner pin across that line, part of it", branch * np.sqrt(r_A**2 / LL - q**2))
    return whole(A + (q + 1j * h) * d, d, h)


def rrr_reach(A: Quantity, B: Quantity, r_A: Quantity) -> Reach:
    L = np.abs(B - A)
    return Reach(np.abs(L - r_A), L + r_A)


def _turning(a: Quantity, b: Quantity, w: Quantity) -> tuple[Quantity, Quantity]:
    D = step("D", "m**2", "determinant of the group", cross(a, b))
    return dot(w, b) / D, dot(w, a) / D


def _sliding(a: Quantity, u: Quantity, w: Quantity) -> tuple[Quantity, Quantity]:
    D = step("D", "m", "determinant of the group", dot(a, u))
    return cross(u, w) / D, -dot(w, a) / D


def _swinging(d: Quantity, u: Quantity, w: Quantity) -> tuple[Quantity, Quantity]:
    p = cross(u, w) / dot(u, d)
    return p, dot(u, w) + p * cross(u, d)


def _none(x: Quantity) -> bool:
    return isinstance(x, int | float) and x == 0


def _moved(v: Quantity, a: Quantity, dr: Quantity) -> Quantity:
    return v if _none(dr) else v + a * (dr / np.abs(a))


def _carried(a: Quantity, omega: Quantity, dr: Quantity, ddr: Quantity) -> Quantity:
    rigid = -(omega**2) * a
    return rigid if _none(dr) and _none(ddr) else rigid + a * ((ddr + 2j * omega * dr) / np.abs(a))


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
    v_A, v_B = _moved(v_A, a, dr_A), _moved(v_B, b, dr_B)
    omega_A, omega_B = _turning(a, b, v_B - v_A)
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
    a_A, a_B = a_A + _carried(a, omega_A, dr_A, ddr_A), a_B + _carried(b, omega_B, dr_B, ddr_B)
    w = step("w", "m/s**2", "acceleration that the turning of the links must make up", a_B - a_A)
    epsilon_A, epsilon_B = _turning(a, b, w)
    return RRRAcceleration(a_A + 1j * epsilon_A * a, epsilon_A, epsilon_B)


def rrr_determinant(A: Quantity, B: Quantity, C: Quantity) -> Quantity:
    return cross(C - A, C - B)


def rrr_transmission_angle(A: Quantity, B: Quantity, C: Quantity) -> Quantity:
    return angle_between(C - A, C - B)


def rrr_condition(A: Quantity, B: Quantity, C: Quantity) -> Quantity:
    r_A, r_B = np.abs(C - A), np.abs(C - B)
    return (np.abs(A) + np.abs(B) + r_A + r_B) * np.maximum(r_A, r_B) / np.abs(cross(C - A, C - B))


def rrp(A: Quantity, B: Quantity, u: Quantity, r_A: Quantity, branch: Quantity, offset: Quantity = 0) -> Quantity:
    u = unit(u)
    h = step("h", "m", "outer pin to the left of the pin's path", cross(u, A - B) - offset)
    ahead = step("x", "m", "pin ahead of the outer pin", branch * np.sqrt((r_A - np.abs(h)) * (r_A + np.abs(h))))
    return whole(A + (ahead - 1j * h) * u, u, ahead)


def rrp_reach(A: Quantity, B: Quantity, u: Quantity, offset: Quantity = 0) -> Reach:
    return Reach(np.abs(cross(unit(u), A - B) - offset), np.asarray(np.inf))


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
    omega_A, ds = _sliding(a, u, guide - _moved(v_A, a, dr_A))
    return RRPVelocity(guide + ds * u, omega_A, ds)


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
    epsilon_A, dds = _sliding(a, u, guide - a_A - _carried(a, omega_A, dr_A, ddr_A))
    return RRPAcceleration(guide + dds * u, epsilon_A, dds)


def rrp_determinant(A: Quantity, C: Quantity, u: Quantity) -> Quantity:
    return dot(C - A, unit(u))


def rrp_transmission_angle(A: Quantity, C: Quantity, u: Quantity) -> Quantity:
    return angle_between(C - A, 1j * u)


def rrp_condition(A: Quantity, B: Quantity, C: Quantity, u: Quantity) -> Quantity:
    a = C - A
    return (np.abs(A) + np.abs(B) + np.abs(C - B) + np.abs(a)) / np.abs(dot(a, unit(u)))


def rpr(A: Quantity, B: Quantity, branch: Quantity, offset: Quantity = 0) -> RPRPosition:
    d = A - B
    s = step("s", "m", "distance along the slide", branch * np.sqrt(dot(d, d) - offset**2))
    return RPRPosition(d / (s + 1j * offset), s)


def rpr_reach(A: Quantity, B: Quantity) -> Reach:
    L = np.abs(A - B)
    return Reach(-L, L)


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


def prp(A: Quantity, B: Quantity, u_A: Quantity, u_B: Quantity) -> Quantity:
    u_A, u_B = unit(u_A), unit(u_B)
    along_A, _ = _along(u_A, u_B, B - A)
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
    ds_A, ds_B = _along(u_A, -u_B, guide_B - guide_A)
    return PRPVelocity(guide_A + ds_A * u_A, ds_A, ds_B)


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
    dds_A, dds_B = _along(u_A, -u_B, guide_B - guide_A)
    return PRPAcceleration(guide_A + dds_A * u_A, dds_A, dds_B)


def prp_determinant(u_A: Quantity, u_B: Quantity) -> Quantity:
    return cross(unit(u_A), unit(u_B))


def prp_transmission_angle(u_A: Quantity, u_B: Quantity) -> Quantity:
    return angle_between(u_A, u_B)


def prp_condition(u_A: Quantity, u_B: Quantity) -> Quantity:
    return 1 / np.abs(prp_determinant(u_A, u_B))


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
    ds_A, ds_B = _along(u_A, u_B, v_A - v_B - 1j * omega_B * (A - B))
    return RPPVelocity(v_B + 1j * omega_B * (C - B) + ds_B * u_B, ds_A, ds_B)


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
    dds_A, dds_B = _along(u_A, u_B, a_A - known)
    return RPPAcceleration(a_B + turning * (C - B) + coriolis_B + dds_B * u_B, dds_A, dds_B)


rpp, rpp_reach, rpp_determinant = prp, prp_reach, prp_determinant  # the same lines, seen from another body
rpp_transmission_angle, rpp_condition = prp_transmission_angle, prp_condition


def _along(a: Quantity, b: Quantity, w: Quantity) -> tuple[Quantity, Quantity]:
    D = step("D", "-", "determinant of the group", cross(a, b))
    return cross(w, b) / D, cross(a, w) / D


def crank(O1: Quantity, r: Quantity, phi: Quantity) -> Quantity:
    return O1 + r * (np.cos(phi) + 1j * np.sin(phi))


def inertia(S: Quantity, m: Quantity, J: Quantity, a_S: Quantity = 0, epsilon: Quantity = 0) -> Load:
    return Load(-m * a_S, S, -J * epsilon)


def _resultant(loads: Sequence[Any], pole: Quantity, end: str) -> tuple[Quantity, Quantity]:
    if not loads:
        return np.complex128(0), np.float64(0)
    forces, arms = [load.F for load in loads], [load.P - pole for load in loads]
    moments = [cross(arm, load.F) + load.M for arm, load in zip(arms, loads, strict=True)]
    force = step(f"F{end}", "N", "sum of the loads", reduce(lambda p, q: p + q, forces))
    return force, step(f"T{end}", "N*m", "moment of the loads about the pin", reduce(lambda p, q: p + q, moments))


def rrr_reactions(
    A: Quantity, B: Quantity, C: Quantity, loads_A: Sequence[Load] = (), loads_B: Sequence[Load] = ()
) -> RRRReactions:
    a, b = A - C, B - C
    (F_A, T_A), (F_B, T_B) = _resultant(loads_A, C, "A"), _resultant(loads_B, C, "B")
    F = F_A + F_B
    t = -T_A / dot(a, a)
    D = step("D", "m**2", "determinant of the group", cross(a, b))
    n = step("n", "N/m", "force along the link next to A, part of its length", (cross(b, F) - T_B + t * dot(a, b)) / D)
    R_A = (n + 1j * t) * a
    return RRRReactions(R_A, -(R_A + F), -(R_A + F_A))


def rrp_reactions(
    A: Quantity, C: Quantity, u: Quantity, loads_A: Sequence[Load] = (), loads_B: Sequence[Load] = ()
) -> RRPReactions:
    u, a = unit(u), C - A
    (F_A, T_A), (F_B, T_B) = _resultant(loads_A, A, "A"), _resultant(loads_B, C, "B")
    N = step("N", "N", "force of the guide, to the left of it", -(T_A + cross(a, F_B)) / dot(a, u))
    R_B = 1j * N * u
    R_C = R_B + F_B
    return RRPReactions(-(R_C + F_A), R_B, R_C, -T_B, -T_B / N)


def rpr_reactions(
    A: Quantity, B: Quantity, u: Quantity, loads_A: Sequence[Load] = (), loads_B: Sequence[Load] = ()
) -> RPRReactions:
    u = unit(u)
    (F_A, T_A), (F_B, T_B) = _resultant(loads_A, A, "A"), _resultant(loads_B, B, "B")
    N = step("N", "N", "force of the slide, to the left of it", (T_A + T_B) / dot(A - B, u))
    R_C = 1j * N * u
    return RPRReactions(-(R_C + F_A), R_C - F_B, R_C, -T_A, -T_A / N)


def prp_reactions(
    C: Quantity, u_A: Quantity, u_B: Quantity, loads_A: Sequence[Load] = (), loads_B: Sequence[Load] = ()
) -> PRPReactions:
    u_A, u_B = unit(u_A), unit(u_B)
    (F_A, T_A), (F_B, T_B) = _resultant(loads_A, C, "A"), _resultant(loads_B, C, "B")
    N_A, N_B = _along(u_A, u_B, 1j * (F_A + F_B))
    R_A = 1j * N_A * u_A
    return PRPReactions(R_A, 1j * N_B * u_B, -(R_A + F_A), -T_A, -T_B, -T_A / N_A, -T_B / N_B)


def rpp_reactions(
    A: Quantity, C: Quantity, u_A: Quantity, u_B: Quantity, loads_A: Sequence[Load] = (), loads_B: Sequence[Load] = ()
) -> RPPReactions:
    u_A, u_B = unit(u_A), unit(u_B)
    (F_A, T_A), (F_B, T_B) = _resultant(loads_A, A, "A"), _resultant(loads_B, C, "B")
    N, N_B = _along(u_A, u_B, 1j * F_B)
    R_C = -1j * N * u_A
    M_B = -(T_A + cross(A - C, -R_C) + T_B)
    return RPPReactions(-(R_C + F_A), 1j * N_B * u_B, R_C, M_B, -T_A, M_B / N_B, T_A / N)


def coupling_drive(O1: Quantity, loads: Sequence[Load] = ()) -> CouplingDrive:
    F, T = _resultant(loads, O1, "")
    return CouplingDrive(-T, -F)


def gear_drive(O1: Quantity, P: Quantity, alpha_w: Quantity, loads: Sequence[Load] = ()) -> GearDrive:
    F, T = _resultant(loads, O1, "")
    q = P - O1
    F_t = step("Ft", "N", "force along the pitch circle", -T / np.abs(q))
    F_w = (F_t + 1j * np.abs(F_t) * np.tan(alpha_w)) * 1j * (q / np.abs(q))
    return GearDrive(F_w, -(F + F_w))


def cylinder_drive(A: Quantity, C: Quantity, R_C: Quantity, loads: Sequence[Load] = ()) -> CylinderDrive:
    F, T = _resultant(loads, C, "")
    F, u = F + R_C, unit(C - A)
    N = -cross(u, F)
    return CylinderDrive(-dot(u, F), 1j * N * u, -T, -T / N)
