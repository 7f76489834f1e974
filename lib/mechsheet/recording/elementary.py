"""The library's functions in elementary steps, as the cells of a workbook compute them.

Each function here does what the function of the same name in the mechanics does, with arithmetic, square roots and the
functions of angles alone; `STEPS` tells which is whose. The library's own keep more digits near dead centres, check
their arguments and serve the worksheets; these serve as the formulas that a workbook shows. Intermediate quantities
carry the name, unit and meaning under which the workbook lists them.
"""

from collections.abc import Callable, Sequence
from functools import reduce
from typing import Any

import numpy as np

from mechsheet.mechanics import drive, joint, load, planar
from mechsheet.mechanics import rpr as kind_3
from mechsheet.mechanics import rrp as kind_2
from mechsheet.mechanics import rrr as kind_1
from mechsheet.mechanics.group import Reach
from mechsheet.mechanics.load import Load

Quantity = Any  # a number, an array, or a quantity that records what is done with it


def step(symbol: str, unit: str, meaning: str, value: Quantity) -> Quantity:
    """A named intermediate quantity."""
    return value.called(symbol, unit, meaning) if hasattr(value, "called") else value


def cross(a: Quantity, b: Quantity) -> Quantity:
    return a.real * b.imag - a.imag * b.real


def dot(a: Quantity, b: Quantity) -> Quantity:
    return a.real * b.real + a.imag * b.imag


def angle(z: Quantity) -> Quantity:
    return np.arctan2(z.imag, z.real)


def angle_between(a: Quantity, b: Quantity) -> Quantity:
    return np.arctan2(np.abs(cross(a, b)), dot(a, b))


def angle_opposite(a: Quantity, b: Quantity, c: Quantity) -> Quantity:
    over, under = (a - b + c) * (a + b - c), (a + b + c) * (b + c - a)
    return 2 * np.arctan2(np.sqrt(over), np.sqrt(under))


def link_velocity(P: Quantity, A: Quantity, v_A: Quantity = 0, omega: Quantity = 0) -> Quantity:
    return v_A + 1j * omega * (P - A)


def link_acceleration(P: Quantity, A: Quantity, omega: Quantity, a_A: Quantity = 0, epsilon: Quantity = 0) -> Quantity:
    return a_A + (1j * epsilon - omega**2) * (P - A)


def rrr(A: Quantity, B: Quantity, r_A: Quantity, r_B: Quantity, branch: Quantity) -> Quantity:
    d = step("d", "m", "from the first outer pin to the second", B - A)
    LL = step("LL", "m**2", "squared distance of the outer pins", dot(d, d))
    q = step("q", "-", "inner pin along the line of the outer pins, part of it", (LL + r_A**2 - r_B**2) / (2 * LL))
    h = step("h", "-", "inner pin across that line, part of it", branch * np.sqrt(r_A**2 / LL - q**2))
    return A + (q + 1j * h) * d


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


def _unit(u: Quantity) -> Quantity:
    return u / np.abs(u)


def rrr_velocity(
    A: Quantity,
    B: Quantity,
    C: Quantity,
    v_A: Quantity = 0,
    v_B: Quantity = 0,
    dr_A: Quantity = 0,
    dr_B: Quantity = 0,
) -> kind_1.RRRVelocity:
    a, b = C - A, C - B
    v_A, v_B = _moved(v_A, a, dr_A), _moved(v_B, b, dr_B)
    omega_A, omega_B = _turning(a, b, v_B - v_A)
    return kind_1.RRRVelocity(v_A + 1j * omega_A * a, omega_A, omega_B)


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
) -> kind_1.RRRAcceleration:
    a, b = C - A, C - B
    a_A, a_B = a_A + _carried(a, omega_A, dr_A, ddr_A), a_B + _carried(b, omega_B, dr_B, ddr_B)
    w = step("w", "m/s**2", "acceleration that the turning of the links must make up", a_B - a_A)
    epsilon_A, epsilon_B = _turning(a, b, w)
    return kind_1.RRRAcceleration(a_A + 1j * epsilon_A * a, epsilon_A, epsilon_B)


def rrr_transmission_angle(A: Quantity, B: Quantity, C: Quantity) -> Quantity:
    return angle_between(C - A, C - B)


def rrr_condition(A: Quantity, B: Quantity, C: Quantity) -> Quantity:
    r_A, r_B = np.abs(C - A), np.abs(C - B)
    return (np.abs(A) + np.abs(B) + r_A + r_B) * np.maximum(r_A, r_B) / np.abs(cross(C - A, C - B))


def rrp(A: Quantity, B: Quantity, u: Quantity, r_A: Quantity, branch: Quantity, offset: Quantity = 0) -> Quantity:
    u = _unit(u)
    h = step("h", "m", "outer pin to the left of the pin's path", cross(u, A - B) - offset)
    ahead = step("x", "m", "pin ahead of the outer pin", branch * np.sqrt((r_A - np.abs(h)) * (r_A + np.abs(h))))
    return A + (ahead - 1j * h) * u


def rrp_reach(A: Quantity, B: Quantity, u: Quantity, offset: Quantity = 0) -> Reach:
    return Reach(np.abs(cross(_unit(u), A - B) - offset), np.asarray(np.inf))


def rrp_velocity(
    A: Quantity,
    B: Quantity,
    C: Quantity,
    u: Quantity,
    v_A: Quantity = 0,
    v_B: Quantity = 0,
    omega_B: Quantity = 0,
    dr_A: Quantity = 0,
) -> kind_2.RRPVelocity:
    a, u = C - A, _unit(u)
    guide = v_B + 1j * omega_B * (C - B)
    omega_A, ds = _sliding(a, u, guide - _moved(v_A, a, dr_A))
    return kind_2.RRPVelocity(guide + ds * u, omega_A, ds)


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
) -> kind_2.RRPAcceleration:
    a, u = C - A, _unit(u)
    guide = a_B + (1j * epsilon_B - omega_B**2) * (C - B) + 2j * omega_B * ds * u
    epsilon_A, dds = _sliding(a, u, guide - a_A - _carried(a, omega_A, dr_A, ddr_A))
    return kind_2.RRPAcceleration(guide + dds * u, epsilon_A, dds)


def rrp_transmission_angle(A: Quantity, C: Quantity, u: Quantity) -> Quantity:
    return angle_between(C - A, 1j * u)


def rrp_condition(A: Quantity, B: Quantity, C: Quantity, u: Quantity) -> Quantity:
    a = C - A
    return (np.abs(A) + np.abs(B) + np.abs(C - B) + np.abs(a)) / np.abs(dot(a, _unit(u)))


def rpr(A: Quantity, B: Quantity, branch: Quantity, offset: Quantity = 0) -> kind_3.RPRPosition:
    d = A - B
    s = step("s", "m", "distance along the slide", branch * np.sqrt(dot(d, d) - offset**2))
    return kind_3.RPRPosition(d / (s + 1j * offset), s)


def rpr_velocity(A: Quantity, B: Quantity, u: Quantity, v_A: Quantity = 0, v_B: Quantity = 0) -> kind_3.RPRVelocity:
    return kind_3.RPRVelocity(*_swinging(A - B, _unit(u), v_A - v_B))


def rpr_acceleration(
    A: Quantity, B: Quantity, u: Quantity, omega_A: Quantity, ds: Quantity, a_A: Quantity = 0, a_B: Quantity = 0
) -> kind_3.RPRAcceleration:
    d, u = A - B, _unit(u)
    known = 2j * omega_A * ds * u - omega_A**2 * d
    return kind_3.RPRAcceleration(*_swinging(d, u, a_A - a_B - known))


def rpr_transmission_angle(A: Quantity, B: Quantity, u: Quantity) -> Quantity:
    return angle_between(A - B, 1j * u)


def rpr_condition(A: Quantity, B: Quantity, u: Quantity) -> Quantity:
    d = A - B
    return (np.abs(A) + np.abs(B) + np.abs(d)) / np.abs(dot(d, _unit(u)))


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
) -> kind_1.RRRReactions:
    a, b = A - C, B - C
    (F_A, T_A), (F_B, T_B) = _resultant(loads_A, C, "A"), _resultant(loads_B, C, "B")
    F = F_A + F_B
    t = -T_A / dot(a, a)
    D = step("D", "m**2", "determinant of the group", cross(a, b))
    n = step("n", "N/m", "force along the link next to A, part of its length", (cross(b, F) - T_B + t * dot(a, b)) / D)
    R_A = (n + 1j * t) * a
    return kind_1.RRRReactions(R_A, -(R_A + F), -(R_A + F_A))


def rrp_reactions(
    A: Quantity, C: Quantity, u: Quantity, loads_A: Sequence[Load] = (), loads_B: Sequence[Load] = ()
) -> kind_2.RRPReactions:
    u, a = _unit(u), C - A
    (F_A, T_A), (F_B, T_B) = _resultant(loads_A, A, "A"), _resultant(loads_B, C, "B")
    N = step("N", "N", "force of the guide, to the left of it", -(T_A + cross(a, F_B)) / dot(a, u))
    R_B = 1j * N * u
    R_C = R_B + F_B
    return kind_2.RRPReactions(-(R_C + F_A), R_B, R_C, -T_B, -T_B / N)


def rpr_reactions(
    A: Quantity, B: Quantity, u: Quantity, loads_A: Sequence[Load] = (), loads_B: Sequence[Load] = ()
) -> kind_3.RPRReactions:
    u = _unit(u)
    (F_A, T_A), (F_B, T_B) = _resultant(loads_A, A, "A"), _resultant(loads_B, B, "B")
    N = step("N", "N", "force of the slide, to the left of it", (T_A + T_B) / dot(A - B, u))
    R_C = 1j * N * u
    return kind_3.RPRReactions(-(R_C + F_A), R_C - F_B, R_C, -T_A, -T_A / N)


def coupling_drive(O1: Quantity, loads: Sequence[Load]) -> drive.CouplingDrive:
    F, T = _resultant(loads, O1, "")
    return drive.CouplingDrive(-T, -F)


def gear_drive(O1: Quantity, P: Quantity, alpha_w: Quantity, loads: Sequence[Load]) -> drive.GearDrive:
    F, T = _resultant(loads, O1, "")
    q = P - O1
    F_t = step("Ft", "N", "force along the pitch circle", -T / np.abs(q))
    F_w = (F_t + 1j * np.abs(F_t) * np.tan(alpha_w)) * 1j * (q / np.abs(q))
    return drive.GearDrive(F_w, -(F + F_w))


def cylinder_drive(A: Quantity, C: Quantity, R_C: Quantity, loads: Sequence[Load] = ()) -> drive.CylinderDrive:
    F, T = _resultant(loads, C, "")
    F, u = F + R_C, _unit(C - A)
    N = -cross(u, F)
    return drive.CylinderDrive(-dot(u, F), 1j * N * u, -T, -T / N)


def sum_of_elements(x: Quantity) -> Quantity:
    return x.sum(axis=-1)


def bending(y: Quantity, A: Quantity, M: Quantity, N: Quantity) -> joint.Bending:
    F = step("F", "m**2", "area", A.sum(axis=-1))
    S = step("S", "m**3", "first moment of area", (A * y).sum(axis=-1))
    y_c = S / F
    lever = y - y_c[..., None]
    I_c = step("I", "m**4", "second moment of area about the centroid", (A * lever**2).sum(axis=-1))
    M_c = M - N * y_c
    sigma = (N / F)[..., None] + (M_c / I_c)[..., None] * lever
    return joint.Bending(sigma, F, S, y_c, I_c, M_c, y_c - N * I_c / (F * M_c))


def _numbers(*quantities: Quantity) -> Any:
    """Present values of quantities that may be recorded."""
    return [getattr(x, "value", x) for x in quantities]


ITERATIONS = 5  # of the neutral axis, from the areas that acted when the workbook was made


def neutral_axis(y: Quantity, A_t: Quantity, A_c: Quantity, M: Quantity, N: Quantity) -> joint.Section:
    """The document's iteration; its last areas count only where they are those of the stresses that they give."""
    known = joint.neutral_axis(*_numbers(y, A_t, A_c, M, N))
    stretched: Quantity = known.sigma > 0
    for _ in range(ITERATIONS):
        area = step("A", "m**2", "area that acts", np.where(stretched, A_t, A_c))
        result = bending(y, area, M, N)
        before, stretched = stretched, step("t", "-", "stretched", result.sigma > 0)
    settled = ((stretched & before) | ~(stretched | before)).all(axis=-1, keepdims=True)
    area = np.where(settled, area, np.nan)
    result = bending(y, area, M, N)
    return joint.Section(result.sigma, result.sigma * area, area, result.y_0, known.state)


def circular_joint(phi: Quantity, r: Quantity, M: Quantity, N: Quantity) -> joint.Ring:
    """The two equations of equilibrium with the integrals over the compressed arc written out."""
    known = joint.circular_joint(*_numbers(phi, r, M, N))
    bend, axial, side = 2 * np.abs(M), N * r, np.where(M < 0, -1.0, 1.0)
    u = step("u", "-", "1 where the joint is stretched most", side[..., None] * np.cos(phi))
    q = step("q", "N*m", "line load of a uniform ring at the bolt, pulled part", axial[..., None] + bend[..., None] * u)
    q = np.where(q > 0, q, 0.0)
    bolt_N, bolt_M = step("bN", "N*m", "sum of the bolts", q.sum(axis=-1)), (q * u).sum(axis=-1)
    over, under = np.where(bend > axial, bend - axial, 0.0), np.where(bend + axial > 0, bend + axial, 0.0)
    alpha = step("alpha", "rad", "half of the compressed arc", 2 * np.arctan2(np.sqrt(over), np.sqrt(under)))
    arc_N = step("aN", "N*m", "sum of the arc", (alpha * axial - bend * np.sin(alpha)) / np.pi)
    lever = bend * (alpha + np.sin(alpha) * np.cos(alpha)) - 2 * axial * np.sin(alpha)
    arc_M = step("aM", "N*m", "moment of the arc", lever / (2 * np.pi))
    mixed = step("mixed", "-", "one part pulled, the other compressed", (axial < bend) & (axial > -bend))
    rim = axial <= -bend
    D = step("D", "N**2*m**2", "determinant of the two equations", bolt_N * arc_M - bolt_M * arc_N)
    k_t = (axial * arc_M - bend * arc_N / 2) / D
    shares = np.where(mixed, (bend * bolt_N / 2 - axial * bolt_M) / D, 1.0)
    k_c = step("kc", "-", "line load of the rim, part of a uniform ring's", shares)
    alone = bending(u, 1 + 0 * u, bend / 2, axial).sigma
    alone = np.where(rim[..., None], 0.0, alone)
    P = np.where(mixed[..., None], k_t[..., None] * q, alone) / (r[..., None] if np.ndim(r) else r)
    c = side * axial / bend
    return joint.Ring(
        P=P,
        p_0=k_c * np.where(alpha > 0, axial - bend, 0.0) / (2 * np.pi * r**2),
        R=k_c * arc_N / r,
        M_R=side * k_c * arc_M,
        M_x=r * (P * np.sin(phi)).sum(axis=-1),
        c=c,
        y_0=-c * r,
        phi_0=np.pi - alpha,
        state=known.state,
    )


STEPS: dict[Callable[..., Any], Callable[..., Any]] = {
    getattr(module, name): globals()[name]
    for module, names in {
        planar: ("cross", "dot", "angle", "angle_between", "angle_opposite", "link_velocity", "link_acceleration"),
        load: ("inertia",),
        drive: ("coupling_drive", "gear_drive", "cylinder_drive"),
        kind_1: (
            *("rrr", "rrr_reach", "rrr_velocity", "rrr_acceleration", "rrr_transmission_angle", "rrr_condition"),
            "rrr_reactions",
        ),
        kind_2: (
            *("rrp", "rrp_reach", "rrp_velocity", "rrp_acceleration", "rrp_transmission_angle", "rrp_condition"),
            "rrp_reactions",
        ),
        kind_3: (
            *("rpr", "rpr_velocity", "rpr_acceleration", "rpr_transmission_angle", "rpr_condition"),
            "rpr_reactions",
        ),
        joint: ("sum_of_elements", "bending", "neutral_axis", "circular_joint"),
    }.items()
    for name in names
}

# Classes whose methods call the functions above: a worksheet that is recorded gets them with those of `STEPS`.
GROUPS = frozenset({kind_1.RRRGroup, kind_2.RRPGroup, kind_3.RPRGroup})
