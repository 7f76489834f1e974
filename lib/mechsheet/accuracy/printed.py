"""The formulas of the documents as they are printed, in floats: what a port from Mathcad or Fortran would compute.

They are here to be compared with; no result of a worksheet rests on them. Angles by arccosines, reactions by
elimination with divisions by differences of coordinates. Errata that only misprint a formula are corrected: signs,
and quadrants that the documents take for granted. Names are those of the worksheets; SI and radians.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy import arccos as acos
from numpy import arctan as atan
from numpy import cos, exp, pi, sin, sqrt
from numpy.typing import ArrayLike

from mechsheet.worksheet.cells import Worksheet

Results = dict[str, Any]


@np.errstate(all="ignore")
def hitch(sheet: Worksheet, g: Any, S: ArrayLike, L4: float, S_p: float, L7: float) -> Results:
    """Sections 2 to 7 of the hitch's document for the strokes S [m] and the lengths found.

    The worksheet computes sections 4 and 6 from these, with the printed formulas.
    """
    S = np.asarray(S, np.float64)
    LS6 = sqrt(g.X6**2 + g.Y6**2)
    phiS6 = 2 * pi + atan(g.Y6 / g.X6) - hitch_pins(g, np.float64(S_p), L4, L7)["phi6_S"]
    r = hitch_pins(g, S, L4, L7)
    r["PS6_S"] = r["P56_S"] + LS6 * exp(1j * (phiS6 + r["phi6_S"]))
    r |= {"LS6": LS6, "phiS6": phiS6} | hitch_ratios(g, S, L4, L7, r)
    r |= _hitch_heights(g, r) | hitch_forces(g, r)
    return r | {name: value for name, value in sheet.run(_RESULTS, {"g": g, **r}).items() if name in _RESULTS}


_RESULTS = ("F_gc", "S_gc", "P_gc", "G56", "GS6", "dGS65", "Ra", "Rb", "dRa", "dRb", "Ra_min", "GS6_max")


def hitch_pins(g: Any, S: Any, L4: float, L7: float) -> Results:
    """2.1 to 2.3, with the corrected phi12 and the slopes of the frame in all quadrants: angles of the links, pins."""
    O3, O5 = g.X03 + 1j * g.Y03, g.X05 + 1j * g.Y05
    L13 = sqrt((g.X01 - g.X03) ** 2 + (g.Y01 - g.Y03) ** 2)
    phi13 = np.arctan2(g.Y03 - g.Y01, g.X01 - g.X03)
    phi3 = _cosines(g.L3, L13, S) - phi13
    phi12 = pi - phi13 - _cosines(S, L13, g.L3)
    phi34 = phi3 + g.phi_BD
    L35 = sqrt((g.X03 - g.X05) ** 2 + (g.Y03 - g.Y05) ** 2)
    delta1 = pi - acos((g.X03 - g.X05) / L35)
    S_1 = sqrt(L35**2 + g.L34**2 - 2 * L35 * g.L34 * cos(phi34 + delta1))
    phiS1 = _cosines(L35, S_1, g.L34)
    phi4 = _cosines(L4, S_1, g.L5) - phiS1 - delta1
    phi5 = pi - _cosines(g.L5, S_1, L4) - phiS1 - delta1
    X56, Y56 = g.X05 + g.L56 * cos(phi5), g.Y05 + g.L56 * sin(phi5)
    L57 = sqrt((g.X07 - g.X05) ** 2 + (g.Y07 - g.Y05) ** 2)
    delta2 = pi - acos((g.X07 - g.X05) / L57)
    L53 = sqrt((g.X07 - X56) ** 2 + (g.Y07 - Y56) ** 2)
    phi53 = _cosines(L53, L57, g.L56)
    phi6 = pi - _cosines(g.L6, L53, L7) + phi53 - delta2
    phi7 = _cosines(L7, L53, g.L6) + phi53 - delta2
    angles = {"phi12_S": phi12, "phi3_S": phi3, "phi34_S": phi34, "phi4_S": phi4, "phi5_S": phi5}
    angles |= {"phi6_S": phi6, "phi7_S": phi7}
    pins = {"P23_S": O3 + g.L3 * exp(1j * phi3), "P34_S": O3 + g.L34 * exp(1j * phi34)}
    pins |= {"P45_S": O5 + g.L5 * exp(1j * phi5), "P56_S": X56 + 1j * Y56}
    return angles | pins | {"P67_S": g.X07 + 1j * g.Y07 + L7 * exp(1j * phi7)}


def _cosines(a: Any, b: Any, c: Any) -> Any:
    """Angle between the sides a and b of a triangle, opposite to c, by the law of cosines."""
    return acos((a**2 + b**2 - c**2) / (2 * a * b))


def hitch_ratios(g: Any, S: Any, L4: float, L7: float, r: Results) -> Results:
    """Section 3 from the angles ``r``: ratios of the angular velocities, and their analogues."""
    phi34, phi4, phi5, phi6, phi7 = (r[f"phi{k}_S"] for k in (34, 4, 5, 6, 7))
    U43 = g.L34 * sin(phi5 - phi34) / (L4 * sin(phi4 - phi5))
    U53 = g.L34 * sin(phi34 - phi4) / (g.L5 * sin(phi5 - phi4))
    U65 = g.L56 * sin(phi7 - phi5) / (g.L6 * sin(phi6 - phi7))
    U75 = g.L56 * sin(phi5 - phi6) / (L7 * sin(phi7 - phi6))
    L13 = sqrt((g.X01 - g.X03) ** 2 + (g.Y01 - g.Y03) ** 2)
    dphi3 = 2 * S / sqrt(4 * L13**2 * g.L3**2 - (S**2 - L13**2 - g.L3**2) ** 2)
    ratios = {"U43": U43, "U53": U53, "U65": U65, "U75": U75, "dphi3": dphi3, "dphi4": dphi3 * U43}
    return ratios | {"dphi5": dphi3 * U53, "dphi6": dphi3 * U65 * U53, "dphi7": dphi3 * U75 * U53}


def _hitch_heights(g: Any, r: Results) -> Results:
    """Velocity analogues of the heights of suspension axis and centre of mass, and the check by the instant centre."""
    dphi6 = r["dphi6"]
    I56 = r["dphi5"] * g.L56 * cos(r["phi5_S"])
    IS6 = I56 + dphi6 * r["LS6"] * cos(r["phi6_S"] + r["phiS6"])
    P56, P67 = r["P56_S"], r["P67_S"]
    AA, BB = P56.imag * g.X05 - g.Y05 * P56.real, g.X07 - P67.real
    CC, DD = g.Y07 - P67.imag, g.X05 - P56.real
    EE, FF = P67.imag * g.X07 - g.Y07 * P67.real, g.Y05 - P56.imag
    Xp = (AA * BB - DD * EE) / (CC * DD - BB * FF)
    return {"I56": I56, "IS6": IS6, "Imp": dphi6 * (P56.real - Xp), "Isp": dphi6 * (r["PS6_S"].real - Xp)}


@np.errstate(all="ignore")
def hitch_forces(g: Any, r: Results) -> Results:
    """Section 5 from the pins ``r``, by elimination."""
    P23, P34, P45, P56, P67 = (r[f"P{k}_S"] for k in (23, 34, 45, 56, 67))
    a1, b1, c1 = g.Y07 - P67.imag, P67.real - g.X07, P67.imag - P56.imag
    d1, e1 = P67.real - P56.real, r["PS6_S"].real - P67.real
    R56x = g.P6 * b1 * (d1 + e1) / (a1 * d1 + b1 * c1)
    R56 = R56x - 1j * ((g.P6 * e1 - R56x * c1) / d1)
    R07 = -R56.real + 1j * (g.P6 - R56.imag)
    R05, R34 = _eliminated(P34, P45, g.X05 + 1j * g.Y05, P56, -R56)
    R03, R01 = _eliminated(g.X01 + 1j * g.Y01, P23, g.X03 + 1j * g.Y03, P34, -R34)
    group_67 = {"R56": R56, "R65": -R56, "R07": R07, "R67": -R07}
    return group_67 | {"R05": R05, "R34": R34, "R45": R34, "R03": R03, "R01": R01, "R23": R01}


def _eliminated(A: Any, C: Any, B: Any, P: Any, F: Any) -> tuple[Any, Any]:
    """Forces in the pins B and A of a group whose link BC carries the force F at P, by the formulas of 5.2 and 5.3."""
    a, b, c, d = A.imag - C.imag, A.real - C.real, B.imag - C.imag, C.real - B.real
    e = F.real * (C.imag - P.imag) + F.imag * (P.real - C.real)
    under = a * d + b * c
    R_Bx = -(b * e - F.real * a * d + F.imag * b * d) / under
    R_Ax = (b * e + F.real * b * c + F.imag * b * d) / under
    return R_Bx - 1j * ((e + R_Bx * c) / d), R_Ax + 1j * (R_Ax * a / b)


@np.errstate(all="ignore")
def landing_gear(g: Any, l2: ArrayLike) -> Results:
    """Formulas (1) to (25) for the lengths l2 [m] of the cylinder, (24) with its minus and (14) with its square.

    (28) gives one half of the circle; the right half is chosen here.
    """
    l12 = sqrt(g.a**2 + g.b**2)
    beta0, mu = np.arctan2(g.b, g.a), acos(g.l3 / l12)
    l20 = sqrt(l12**2 + g.l3**2 - 2 * l12 * g.l3 * cos(mu - g.theta / 2))
    l2n = sqrt(l12**2 + g.l3**2 - 2 * l12 * g.l3 * cos(mu + g.theta / 2))
    H = l2n - l20
    l2 = np.asarray(l2, np.float64)
    phi2 = pi / 2 + beta0 + _cosines(l2, l12, g.l3)
    half = np.arcsin((g.a - l2 * sin(phi2)) / g.l3)
    phi3 = np.where(-g.b - l2 * cos(phi2) > 0, half, pi - half)
    cosine, sine = cos(phi3 - phi2), sin(phi3 - phi2)
    omega3 = 1 / (g.l3 * sine)
    omega2 = -g.l3 * omega3 * cosine / l2
    eps3 = -(l2 * omega2**2 + g.l3 * omega3**2 * cosine) / (g.l3 * sine)
    eps2 = (g.l3 * omega3**2 * sine - g.l3 * eps3 * cosine - 2 * omega2) / l2
    V21 = H / g.t_r
    r = {"psi": pi + mu - (beta0 + g.theta / 2), "l20": l20, "l2n": l2n, "H": H, "V21": V21}
    r |= {"phi2i": phi2, "phi3i": phi3, "Ai": g.l3 * exp(1j * phi3)}
    r |= {"omega3_l2i": omega3, "omega2_l2i": omega2, "eps3_l2i": eps3, "eps2_l2i": eps2}
    return r | {"omega3i": V21 * omega3, "omega2i": V21 * omega2, "eps3i": V21**2 * eps3, "eps2i": V21**2 * eps2}


def dyad_pin(A: Any, B: Any, r_A: Any, r_B: Any, branch: int) -> tuple[Any, Any, Any, Any]:
    """Inner pin C of a group of two links by the law of cosines, angle of the link AC, length and angle of AB."""
    d = B - A
    L, phi_AB = sqrt(d.real**2 + d.imag**2), np.arctan2(d.imag, d.real)
    phi_A = phi_AB + branch * _cosines(r_A, L, r_B)
    return A + r_A * exp(1j * phi_A), phi_A, L, phi_AB


@np.errstate(all="ignore")
def dyad(
    A: complex, B: complex, r_A: float, r_B: float, branch: int, P_A: complex, P_B: complex, F_A: complex, F_B: complex
) -> Results:
    """A group of two links as the hitch's document computes each of its own: acos, sines, elimination."""
    C, phi_A, L, phi_AB = dyad_pin(A, B, r_A, r_B, branch)
    phi_B = phi_AB + pi - branch * _cosines(r_B, L, r_A)
    omega_B = 1 / (r_B * sin(phi_A - phi_B))
    omega_A = omega_B * r_B * cos(phi_A - phi_B) / r_A
    p, q = P_A - C, P_B - C
    H_A, H_B = p.real * F_A.imag - p.imag * F_A.real, q.real * F_B.imag - q.imag * F_B.real
    # (A - C) x R_A = -H_A, (B - C) x R_B = -H_B, R_A + R_B = -F, by elimination
    a, b, F = A - C, B - C, F_A + F_B
    K = H_B - (b.real * F.imag - b.imag * F.real)
    R_Ax = (K * a.real + H_A * b.real) / (a.real * b.imag - b.real * a.imag)
    R_A = R_Ax + 1j * ((R_Ax * a.imag - H_A) / a.real)
    return {"C": C, "omega_A": omega_A, "omega_B": omega_B, "R_A": R_A, "R_B": -F - R_A, "R_C": -F_A - R_A}


@np.errstate(all="ignore")
def machine_forces(g: Any, p: Any) -> Results:
    """Programs SR2, SR3 and SR1 of kinetostatics for the pins and loads ``p``, by the names of `pump.FORCES`.

    Forces across the links by moments, those along them by elimination.
    """

    def across(F: Any, arm: Any, phi: Any, M: Any, length: Any) -> Any:
        return (np.abs(F) * arm * sin(phi - np.angle(F)) + M) / length

    def sums(turned: Sequence[tuple[Any, Any]], *others: Any) -> tuple[Any, Any]:
        polar = [*turned, *((np.abs(F), np.angle(F)) for F in others)]
        return sum(F * cos(a) for F, a in polar), sum(F * sin(a) for F, a in polar)

    def joined(along: Any, over: Any, phi: Any) -> Any:
        return np.hypot(along, over) * exp(1j * (phi + np.arctan2(over, along)))

    phi2, phi3, phi4, phi6 = np.angle(p.B - p.A), np.angle(p.B - p.C), np.angle(p.E - p.D), np.angle(p.H - p.K)
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
    group_45 = {"R_D": R_D, "R_E": -(R_05 + p.F5_sum), "R_05": R_05}
    group_67 = {"R_K": R_K, "R_H": R_76 - p.F7_sum, "R_76": R_76}
    return {"R_A": R_A, "R_B": -(R_C + F3), "R_C": R_C} | group_45 | group_67


@np.errstate(all="ignore")
def ring(r: Any, phi: Any, M: Any, N: Any) -> Results:
    """Appendix 2 of the joint's document, with the signs that the scan has lost: a ring that is pressed in part."""
    c = np.asarray(N * r / (2 * M))[..., None]
    edge = pi / 2 + np.arcsin(c)
    k_0 = c * (pi - edge) - sin(edge)
    k_1 = ((pi - edge) / 2 - sin(2 * edge) / 4 - c * sin(edge)) / k_0
    k_2 = (1 - c) / (2 * k_0)
    pulled = np.maximum(cos(phi) + c, 0)
    S_1, S_2 = pulled.sum(-1, keepdims=True), (pulled * cos(phi)).sum(-1, keepdims=True)
    normal, moment = np.asarray(N)[..., None], np.asarray(M)[..., None]
    P_1 = (moment / r - k_1 * normal) / (S_2 - k_1 * S_1)
    pressed = normal - S_1 * P_1
    forces = {"P": P_1 * pulled, "R": pressed[..., 0], "p_0": (-k_2 * pressed / r)[..., 0]}
    return forces | {"y_0": -np.asarray(N * r**2 / (2 * M))}
