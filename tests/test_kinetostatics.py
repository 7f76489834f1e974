"""Reactions against 50-digit solutions, residuals, one dense system for a whole mechanism, and virtual work."""

from __future__ import annotations

from itertools import chain
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from moving import exact_rows
from random_groups import FAMILIES, numbers, triangles, vectors

from mechsheet.accuracy import arithmetic as exact
from mechsheet.accuracy.arithmetic import EPS
from mechsheet.mechanics.crank import crank
from mechsheet.mechanics.drive import coupling_drive, cylinder_drive, gear_drive
from mechsheet.mechanics.load import Load, inertia
from mechsheet.mechanics.planar import angle, cross, dot, link_acceleration, link_point, link_velocity
from mechsheet.mechanics.prp import prp, prp_acceleration, prp_reactions, prp_velocity
from mechsheet.mechanics.rpp import rpp, rpp_acceleration, rpp_reactions, rpp_velocity
from mechsheet.mechanics.rpr import rpr, rpr_acceleration, rpr_reactions, rpr_velocity
from mechsheet.mechanics.rrp import rrp, rrp_acceleration, rrp_reactions, rrp_velocity
from mechsheet.mechanics.rrr import rrr, rrr_acceleration, rrr_reactions, rrr_velocity

ROUNDINGS = 8
GROUPS = ["rrr", "rrp", "rpr", "prp", "rpp"]


def group(kind: str, family: str) -> SimpleNamespace:
    """A random group with two loads on each link; sine of its transmission angle, its unknowns and poles."""
    rng, A, B, C = triangles(family)
    g = SimpleNamespace(A=A, B=B, C=C, u=C - A if kind == "rpr" else 1j * (C - B), u_A=C - A, u_B=C - B)
    for name in ("u", "u_A", "u_B"):
        setattr(g, name, getattr(g, name) / np.abs(getattr(g, name)))
    if kind == "rpr":
        g.u = 1j * g.u
    F = vectors(rng, 4)
    P = np.array([A + (C - A) * z for z in vectors(rng, 2)] + [B + (C - B) * z for z in vectors(rng, 2)])
    M = numbers(rng, 4) * np.abs(np.repeat([C - A, C - B], 2, axis=0))
    g.on_A, g.on_B = [[Load(F[i], P[i], M[i]) for i in pair] for pair in ((0, 1), (2, 3))]
    return g


def solve(kind: str, g: SimpleNamespace) -> Any:
    match kind:
        case "rrr":
            return rrr_reactions(g.A, g.B, g.C, g.on_A, g.on_B)
        case "rrp":
            return rrp_reactions(g.A, g.C, g.u, g.on_A, g.on_B)
        case "rpr":
            return rpr_reactions(g.A, g.B, g.u, g.on_A, g.on_B)
        case "prp":
            return prp_reactions(g.C, g.u_A, g.u_B, g.on_A, g.on_B)
    return rpp_reactions(g.A, g.C, g.u_A, g.u_B, g.on_A, g.on_B)


def pairs(kind: str, g: SimpleNamespace) -> tuple[Any, Any, Any]:
    """Unknowns of the pairs A, B, C: the link next to A is body 0, the link next to B body 1."""
    match kind:
        case "rrr":
            return exact.pin(g.A, 0), exact.pin(g.B, 1), exact.pin(g.C, 0, 1)
        case "rrp":
            return exact.pin(g.A, 0), exact.slide(g.C, g.u, 1), exact.pin(g.C, 0, 1)
        case "rpr":
            return exact.pin(g.A, 0), exact.pin(g.B, 1), exact.slide(g.A, g.u, 0, 1)
        case "prp":
            return exact.slide(g.C, g.u_A, 0), exact.slide(g.C, g.u_B, 1), exact.pin(g.C, 0, 1)
    return exact.pin(g.A, 0), exact.slide(g.C, g.u_B, 1), exact.slide(g.A, g.u_A, 0, 1)


def sine(kind: str, g: SimpleNamespace) -> Any:
    """Sine of the transmission angle."""
    a, b, d = g.C - g.A, g.C - g.B, g.A - g.B
    match kind:
        case "rrr":
            return np.abs(cross(a, b)) / np.abs(a * b)
        case "rrp":
            return np.abs(dot(a, g.u)) / np.abs(a)
        case "rpr":
            return np.abs(dot(d, g.u)) / np.abs(d)
    return np.abs(cross(g.u_A, g.u_B))


def excitation(kind: str, g: SimpleNamespace) -> tuple[Any, Any]:
    """Force and moment that the loads put on a group whose transmission angle is right."""
    a, b, d = np.abs(g.C - g.A), np.abs(g.C - g.B), np.abs(g.A - g.B)
    force = sum(np.abs(load.F) for load in g.on_A + g.on_B)

    def moment(loads: list[Load], *poles: Any) -> Any:
        return sum(np.abs(load.M) + sum(np.abs((load.P - pole) * load.F) for pole in poles) for load in loads)

    T_A, T_B = moment(g.on_A, g.A, g.C), moment(g.on_B, g.B, g.C)
    match kind:
        case "rrr":
            return force + T_A / a + T_B / b, T_A + T_B
        case "rrp":
            return force + T_A / a, T_A + T_B
        case "rpr":
            return force + (T_A + T_B) / d, T_A + T_B
    return force, T_A + T_B


@pytest.mark.parametrize("family", FAMILIES)
@pytest.mark.parametrize("kind", GROUPS)
def test_reactions_lose_the_digits_of_the_transmission_angle_only(kind: str, family: str) -> None:
    g, names = group(kind, family), ["A", "B", "C", "u", "u_A", "u_B"]
    R, s = solve(kind, g), sine(kind, g)
    force, moment = excitation(kind, g)
    rows = [*(getattr(g, name) for name in names), *(x for load in g.on_A + g.on_B for x in (load.F, load.P, load.M))]
    for i, row in enumerate(exact_rows(*(x[:30] for x in rows))):
        exactly = SimpleNamespace(**dict(zip(names, row, strict=False)))
        for name in ("u", "u_A", "u_B"):
            setattr(exactly, name, getattr(exactly, name) / abs(getattr(exactly, name)))
        loads = [
            (k // 2, F, P, M.real) for k, (F, P, M) in enumerate(zip(row[6::3], row[7::3], row[8::3], strict=True))
        ]
        true = exact.reactions(list(chain(*pairs(kind, exactly))), loads, [exactly.C] * 2)
        bound = ROUNDINGS * EPS * force[i] / s[i] ** 2
        for pair, (x, y) in zip("ABC", zip(true[::2], true[1::2], strict=True), strict=True):
            found = getattr(R, f"R_{pair}")[i]
            if hasattr(R, f"M_{pair}"):
                u = {"rrp": exactly.u, "rpr": exactly.u}.get(kind, exactly.u_B if pair == "B" else exactly.u_A)
                assert abs(found - complex(1j * u * x)) <= bound
                arms = abs(exactly.C - exactly.A) if kind == "rpp" else 0
                assert abs(getattr(R, f"M_{pair}")[i] - float(y)) <= ROUNDINGS * EPS * moment[i] + float(arms) * bound
            else:
                assert abs(found - complex(x, y)) <= bound


@pytest.mark.parametrize("family", FAMILIES)
@pytest.mark.parametrize("excited", [True, False], ids=["any loads", "loads that the dead centre does not amplify"])
@pytest.mark.parametrize("kind", GROUPS)
def test_equilibrium_residuals_are_units_in_the_last_place_of_the_largest_force(
    kind: str, excited: bool, family: str
) -> None:
    g = group(kind, family)
    if not excited:  # straight into the outer pairs
        F = [g.on_A[0].F, g.on_B[0].F]
        g.on_A = [Load(1j * g.u_A, g.C) if kind == "prp" else Load(F[0], g.A)]
        normal = {"rrp": 1j * g.u, "prp": 1j * g.u_B, "rpp": 1j * g.u_B}
        g.on_B = [Load(normal[kind], g.C) if kind in normal else Load(F[1], g.B)]
    R = solve(kind, g)
    largest = np.max([np.abs(x) for x in (R.R_A, R.R_B, R.R_C, *(load.F for load in g.on_A + g.on_B))], axis=0)
    M_A, M_B, M_C = (getattr(R, name, 0.0) for name in ("M_A", "M_B", "M_C"))
    at_A = g.C if kind == "prp" else g.A  # where R_A, R_B, R_C act
    at_B = g.B if kind in ("rrr", "rpr") else g.C
    at_C = g.A if kind in ("rpr", "rpp") else g.C
    links = (
        [Load(R.R_A, at_A, M_A), Load(R.R_C, at_C, M_C), *g.on_A],
        [Load(R.R_B, at_B, M_B), Load(-R.R_C, at_C, -M_C), *g.on_B],
    )
    for loads in links:
        arm = np.max([np.abs(load.P - g.C) for load in loads], axis=0)
        couple = np.max([np.abs(load.M) + 0 * arm for load in loads], axis=0)
        assert np.all(np.abs(sum(load.F for load in loads)) <= ROUNDINGS * EPS * largest)
        moments = sum(load.M + cross(load.P - g.C, load.F) for load in loads)
        assert np.all(np.abs(moments) <= ROUNDINGS * EPS * (largest * arm + couple))


@pytest.mark.parametrize("kind", GROUPS)
def test_a_quarter_turn_and_other_units_change_nothing_but_rounding(kind: str) -> None:
    """Links along the axes are no special positions."""
    g, turned = group(kind, "ordinary"), group(kind, "ordinary")
    for name in ("A", "B", "C"):
        setattr(turned, name, 1j * (0.25 * getattr(g, name)))
    for name in ("u", "u_A", "u_B"):
        setattr(turned, name, 1j * getattr(g, name))
    for name in ("on_A", "on_B"):
        loads = [Load(1j * (8 * x.F), 1j * (0.25 * x.P), 2 * x.M) for x in getattr(g, name)]
        setattr(turned, name, loads)
    R, R_turned = solve(kind, g), solve(kind, turned)
    for name, x in R._asdict().items():
        factor = {"R": 8j, "M": 2, "h": 0.25}[name[0]]
        assert np.all(np.abs(getattr(R_turned, name) - factor * x) <= 4 * EPS * np.abs(factor * x) / sine(kind, g) ** 2)


@pytest.mark.parametrize("floats_beside", [0, 1, 2, 3])
def test_an_upright_link_is_no_singularity_where_the_printed_elimination_divides_by_zero(floats_beside: int) -> None:
    """The hitch's 5.1 divides by X67 - X56, which is zero at the working position itself."""
    C = 0.25 + 0.5j
    x = C.real
    for _ in range(floats_beside):
        x = np.nextafter(x, 1)
    A, B = x - 0.4j, 1.1 + 0.7j
    loads = [Load(-3e3j + 200, 0.6 - 0.1j)], [Load(50j, B)]
    R, slightly_turned = (
        rrr_reactions(A * z, B * z, C * z, *([Load(q.F * z, q.P * z)] for (q,) in loads)) for z in (1, np.exp(0.3j))
    )
    for force, turned in zip(R, slightly_turned, strict=True):
        assert abs(force * np.exp(0.3j) - turned) <= 64 * EPS * np.max(np.abs(R))


# --- a whole mechanism of all five groups ----------------------------------------------------------------------


@pytest.fixture(scope="module")
def machine() -> SimpleNamespace:
    """A crank and one group of each kind, with inertia forces, weights, forces and couples, over a turn.

    Bodies: crank 0; dyad 1, 2; link 3 with slider 4; block 5 in the slotted link 6; link 7 in the slot of slider 8;
    slider 9 on a guide that moves with body 2, slider 10 on a fixed guide.
    """
    phi, omega, epsilon = np.linspace(0, 2 * np.pi, 73), 12.0, -30.0
    O1, D, E = 0j, 0.42 + 0.05j, 0.1 - 0.35j
    A = crank(O1, 0.1, phi)
    v_A, a_A = link_velocity(A, O1, omega), link_acceleration(A, O1, omega, epsilon)

    B = rrr(A, D, 0.4, 0.25, 1)
    v1 = rrr_velocity(A, D, B, v_A)
    a1 = rrr_acceleration(A, D, B, v1.omega_A, v1.omega_B, a_A=a_A)

    K = link_point(B, D, 0.05 - 0.1j)  # the third pin of body 2
    v_K, a_K = link_velocity(K, D, v1.omega_B), link_acceleration(K, D, v1.omega_B, a1.epsilon_B)
    G, u3 = 0.6 + 0.2j, np.exp(0.1j)
    C = rrp(K, G, u3, 0.5, 1, 0.02)
    v3 = rrp_velocity(K, G, C, u3, v_K)
    a3 = rrp_acceleration(K, G, C, u3, v3.omega_A, v3.ds, a_A=a_K)

    Q = link_point(A, B, 0.2 + 0.05j)  # the third pin of body 1
    v_Q, a_Q = link_velocity(Q, A, v1.omega_A, v_A), link_acceleration(Q, A, v1.omega_A, a1.epsilon_A, a_A)
    u5 = rpr(Q, E, 1, 0.03).u
    v5 = rpr_velocity(Q, E, u5, v_Q)
    a5 = rpr_acceleration(Q, E, u5, v5.omega_A, v5.ds, a_Q)

    N = E + 0.7 * u5  # the third pin of body 6
    v_N, a_N = link_velocity(N, E, v5.omega_A), link_acceleration(N, E, v5.omega_A, a5.epsilon_A)
    H, w7, u8 = 0.7j, np.exp(1.4j), np.exp(-0.2j)
    X = rpp(N, H, w7, u8)
    v7 = rpp_velocity(N, H, X, w7, u8, v_N)
    a7 = rpp_acceleration(N, H, X, w7, u8, v7.ds_A, v7.ds_B, a_A=a_N)

    J1, u9, u10 = 0.7 - 0.1j, 1j * (B - D) / np.abs(B - D), np.exp(1.1j)
    Y = prp(B, J1, u9, u10)
    v9 = prp_velocity(B, J1, Y, u9, u10, v1.v_C, 0, v1.omega_B)
    a9 = prp_acceleration(B, J1, Y, u9, u10, v9.ds_A, v9.ds_B, v1.omega_B, 0, a1.a_C, 0, a1.epsilon_B)

    still = 0 * phi
    bodies = [  # a point, its velocity and acceleration, angular velocity and acceleration
        (A, v_A, a_A, omega, epsilon),
        (A, v_A, a_A, v1.omega_A, a1.epsilon_A),
        (B, v1.v_C, a1.a_C, v1.omega_B, a1.epsilon_B),
        (K, v_K, a_K, v3.omega_A, a3.epsilon_A),
        (C, v3.v_C, a3.a_C, still, still),
        (Q, v_Q, a_Q, v5.omega_A, a5.epsilon_A),
        (E + 0 * Q, still, still, v5.omega_A, a5.epsilon_A),
        (N, v_N, a_N, still, still),
        (X, v7.v_C, a7.a_C, still, still),
        (Y, v9.v_C, a9.a_C, v1.omega_B, a1.epsilon_B),
        (Y, v9.v_C, a9.a_C, still, still),
    ]
    rng = np.random.default_rng(1)
    loads: list[list[Load]] = []
    power = still
    for P, v_P, a_P, w, e in bodies:
        S, T = (P + 0.1 * complex(*rng.normal(size=2)) for _ in range(2))
        m, J, F, M = rng.uniform(0.5, 3), rng.uniform(0.01, 0.1), complex(*rng.normal(0, 50, 2)), rng.normal(0, 5)
        on = [inertia(S, m, J, link_acceleration(S, P, w, e, a_P), e), Load(-9.81j * m, S), Load(F, T, M)]
        power = power + sum(dot(link_velocity(x.P, P, w, v_P), x.F) + x.M * w for x in on)
        loads.append(on)

    # from the last group to the first
    prp_group = prp_reactions(Y, u9, u10, loads[9], loads[10])
    rpp_group = rpp_reactions(N, X, w7, u8, loads[7], loads[8])
    rpr_group = rpr_reactions(Q, E, u5, loads[5], [*loads[6], Load(-rpp_group.R_A, N)])
    rrp_group = rrp_reactions(K, C, u3, loads[3], loads[4])
    on_1 = [*loads[1], Load(-rpr_group.R_A, Q)]
    on_2 = [*loads[2], Load(-rrp_group.R_A, K), Load(-prp_group.R_A, Y, -prp_group.M_A)]
    rrr_group = rrr_reactions(A, D, B, on_1, on_2)
    on_crank = [*loads[0], Load(-rrr_group.R_A, A)]
    groups = (rrr_group, rrp_group, rpr_group, rpp_group, prp_group)

    unknowns = list(
        chain(
            exact.pin(A, 1, 0), exact.pin(D + 0 * A, 2), exact.pin(B, 1, 2),
            exact.pin(K, 3, 2), exact.slide(C, u3, 4), exact.pin(C, 3, 4),
            exact.pin(Q, 5, 1), exact.pin(E + 0 * A, 6), exact.slide(Q, u5, 5, 6),
            exact.pin(N, 7, 6), exact.slide(X, u8, 8), exact.slide(N, w7, 7, 8),
            exact.slide(Y, u9, 9, 2), exact.slide(Y, u10, 10), exact.pin(Y, 9, 10),
            exact.pin(O1 + 0 * A, 0),
        )
    )  # fmt: skip
    all_loads = [(k, x.F, x.P, x.M) for k, on in enumerate(loads) for x in on]

    def dense(drive: tuple[Any, ...]) -> Any:
        """Every unknown of the mechanism from one system of 33 equations, the drive's last."""
        columns, right = exact.equations([*unknowns, [drive]], all_loads, [body[0] for body in bodies])
        matrix = np.array([[x + 0 * phi for x in column] for column in columns]).T
        return np.linalg.solve(matrix, np.array([x + 0 * phi for x in right]).T[..., None])[..., 0].T

    return SimpleNamespace(**locals())


def test_machine_closes_everywhere(machine: Any) -> None:
    for body in machine.bodies:
        assert np.all(np.isfinite(body[0]))


def test_reactions_of_the_groups_agree_with_one_dense_system_of_the_whole_mechanism(machine: Any) -> None:
    drive = coupling_drive(machine.O1, machine.on_crank)
    found = []
    for R, directions in zip(machine.groups, ((), ("B", machine.u3), ("C", machine.u5), None, None), strict=True):
        for pair in "ABC":
            force = getattr(R, f"R_{pair}")
            if not hasattr(R, f"M_{pair}"):
                found += [force.real, force.imag]
                continue
            u = {"A": machine.u9, "B": machine.u10} if R is machine.prp_group else {"B": machine.u8, "C": machine.w7}
            along = u[pair] if directions is None else directions[1]
            assert np.all(np.abs(dot(force, along)) <= 1e-13 * np.abs(force))  # square to the slide
            found += [cross(along, force), getattr(R, f"M_{pair}")]
    found += [drive.R_O1.real, drive.R_O1.imag, drive.M]
    expected = machine.dense((0, 0j * machine.A, machine.A, 1))
    assert np.array(found) == pytest.approx(expected, rel=1e-11, abs=1e-11 * np.max(np.abs(expected)))


def test_position_of_the_resultant_in_a_prismatic_pair_gives_its_moment(machine: Any) -> None:
    g = machine
    for h, u, R, M in (
        (g.rrp_group.h_B, g.u3, g.rrp_group.R_B, g.rrp_group.M_B),
        (g.rpr_group.h_C, g.u5, g.rpr_group.R_C, g.rpr_group.M_C),
        (g.rpp_group.h_B, g.u8, g.rpp_group.R_B, g.rpp_group.M_B),
        (g.rpp_group.h_C, g.w7, g.rpp_group.R_C, g.rpp_group.M_C),
        (g.prp_group.h_A, g.u9, g.prp_group.R_A, g.prp_group.M_A),
        (g.prp_group.h_B, g.u10, g.prp_group.R_B, g.prp_group.M_B),
    ):
        assert cross(h * u, R) == pytest.approx(M, rel=1e-13)


def test_balancing_moment_of_the_coupling_does_the_work_of_all_loads(machine: Any) -> None:
    M = coupling_drive(machine.O1, machine.on_crank).M
    assert -M * machine.omega == pytest.approx(machine.power, abs=1e-12 * np.max(np.abs(machine.power)))


def test_balancing_force_of_the_gear_does_the_work_of_all_loads_and_agrees_with_the_dense_system(machine: Any) -> None:
    P, alpha_w = -0.15 + 0.05j, np.radians(20)
    drive = gear_drive(machine.O1, P, alpha_w, machine.on_crank)
    v_P = link_velocity(P, machine.O1, machine.omega)
    assert -dot(drive.F, v_P) == pytest.approx(machine.power, abs=1e-12 * np.max(np.abs(machine.power)))
    expected = machine.dense((0, drive.F / np.abs(drive.F), P + 0 * machine.A, 0))
    assert np.abs(drive.F) == pytest.approx(expected[-1], rel=1e-10)
    found = drive.R_O1
    assert found == pytest.approx(expected[-3] + 1j * expected[-2], rel=1e-10)


def test_gear_teeth_push_inwards_by_the_pressure_angle_on_either_flank() -> None:
    F = gear_drive(0, -2, np.radians(20), [Load(0, 0, [3.0, -3.0])]).F
    # (1.47): gamma = pi/2 - alpha_w, and 3 pi/2 + alpha_w where the sign is minus
    assert angle(F) == pytest.approx(np.radians([70, -70]), rel=1e-15)
    assert np.abs(F) == pytest.approx(1.5 / np.cos(np.radians(20)), rel=1e-15)


def test_cylinder_force_does_the_work_of_the_loads_and_holds_barrel_and_rod() -> None:
    O1, O2, l3, V = 0, -0.6 + 1.1j, 0.5, 0.05
    l2 = np.linspace(0.8, 1.6, 9)
    A = rrr(O1, O2, l2, l3, 1)
    v = rrr_velocity(O1, O2, A, dr_A=V)
    a = rrr_acceleration(O1, O2, A, v.omega_A, v.omega_B, dr_A=V)
    u = A / l2
    S1, S2, S3 = 0.3 * u, A - 0.25 * u, O2 + 2j * (A - O2)
    barrel = [inertia(S1, 4, 0.1, link_acceleration(S1, O1, v.omega_A, a.epsilon_A), a.epsilon_A), Load(-40j, S1)]
    rod = [inertia(S2, 3, 0.2, link_acceleration(S2, A, v.omega_A, a.epsilon_A, a.a_C), a.epsilon_A), Load(-30j, S2)]
    leg = [inertia(S3, 50, 9, link_acceleration(S3, O2, v.omega_B, a.epsilon_B), a.epsilon_B), Load(300 - 500j, S3)]
    R = rrr_reactions(O1, O2, A, barrel + rod, leg)
    drive = cylinder_drive(O1, A, R.R_C, rod)

    velocities = (
        [link_velocity(S1, O1, v.omega_A)] * 2,
        [link_velocity(S2, A, v.omega_A, v.v_C)] * 2,
        [link_velocity(S3, O2, v.omega_B)] * 2,
    )
    power = 0.0
    for on, speeds, omega in zip((barrel, rod, leg), velocities, (v.omega_A, v.omega_A, v.omega_B), strict=True):
        power = power + sum(dot(load.F, speed) + load.M * omega for load, speed in zip(on, speeds, strict=True))
    found = drive.F * V
    assert found == pytest.approx(-power, rel=1e-12)

    assert drive.F * u + drive.R + R.R_C + sum(load.F for load in rod) == pytest.approx(0, abs=1e-9)
    assert cross(drive.h * u, drive.R) == pytest.approx(drive.M, rel=1e-13)
    on_barrel = [Load(-drive.F * u - drive.R, A, -drive.M), *barrel]
    assert R.R_A + sum(load.F for load in on_barrel) == pytest.approx(0, abs=1e-9)
    assert sum(cross(load.P, load.F) + load.M for load in on_barrel) == pytest.approx(0, abs=1e-9)


# --- the source's formulas, with its slips -------------------------------------------------------------------
# Its numbers: link 2 next to the outer pin A, link 3; forces F2, F3 at S2, S3 on the links' axes, couples M2, M3.


@pytest.fixture
def source() -> SimpleNamespace:
    g = SimpleNamespace(F2=30 * np.exp(0.7j), F3=50 * np.exp(2.6j), M2=4.0, M3=-2.5, phi2=0.4, phi3=1.9, l=0.6, l3=0.4)
    g.gamma2, g.gamma3 = angle(g.F2), angle(g.F3)
    return g


def test_program_sr1_gives_the_reactions_of_kind_1(source: Any) -> None:
    """(1.5), (1.8), (1.10) to (1.19): pins A, B inner, C outer, S2 and S3 at 0.2 from B."""
    g = source
    t12 = (abs(g.F2) * 0.2 * np.sin(g.phi2 - g.gamma2) + g.M2) / g.l
    t43 = (abs(g.F3) * 0.2 * np.sin(g.phi3 - g.gamma3) + g.M3) / g.l3
    W = 1j * t12 * np.exp(1j * g.phi2) + g.F2 + g.F3 + 1j * t43 * np.exp(1j * g.phi3)  # A + iB of (1.10)
    n12 = -(W.real * np.sin(g.phi3) - W.imag * np.cos(g.phi3)) / np.sin(g.phi3 - g.phi2)
    n43 = -(W.real * np.sin(g.phi2) - W.imag * np.cos(g.phi2)) / np.sin(g.phi2 - g.phi3)
    R12, R43 = (n12 + 1j * t12) * np.exp(1j * g.phi2), (n43 + 1j * t43) * np.exp(1j * g.phi3)
    to_A, to_C = -np.exp(1j * g.phi2), -np.exp(1j * g.phi3)  # from the inner pin, here the origin
    R = rrr_reactions(g.l * to_A, g.l3 * to_C, 0, [Load(g.F2, 0.2 * to_A, g.M2)], [Load(g.F3, 0.2 * to_C, g.M3)])
    found = (R.R_A, R.R_B, -R.R_C)
    assert found == pytest.approx((R12, R43, -(R43 + g.F3)), rel=1e-14)
    gamma12 = g.phi2 + np.arctan(t12 / n12) + (np.pi if n12 < 0 else 0)  # (1.13), (1.14)
    assert angle(R.R_A * np.exp(-1j * gamma12)) == pytest.approx(0, abs=1e-14)


def test_program_sr2_gives_the_reactions_of_kind_2_with_plus_in_its_second_equation(source: Any) -> None:
    """(1.24), (1.26): the line after (1.26) repeats its second equation with a minus, which its solution has not."""
    g, phi4 = source, 0.3
    t12 = (abs(g.F2) * 0.2 * np.sin(g.phi2 - g.gamma2) + g.M2) / g.l
    W = 1j * t12 * np.exp(1j * g.phi2) + g.F2 + g.F3
    n12 = -(W.real * np.cos(phi4) + W.imag * np.sin(phi4)) / np.cos(g.phi2 - phi4)
    n43 = (W.real * np.sin(g.phi2) - W.imag * np.cos(g.phi2)) / np.cos(g.phi2 - phi4)
    assert n12 * np.sin(g.phi2) + n43 * np.cos(phi4) == pytest.approx(-W.imag, rel=1e-14)
    assert n12 * np.sin(g.phi2) - n43 * np.cos(phi4) != pytest.approx(-W.imag, rel=1e-2)
    to_A = -np.exp(1j * g.phi2)
    R = rrp_reactions(g.l * to_A, 0, np.exp(1j * phi4), [Load(g.F2, 0.2 * to_A, g.M2)], [Load(g.F3, 0)])
    R12, R43 = (n12 + 1j * t12) * np.exp(1j * g.phi2), 1j * n43 * np.exp(1j * phi4)
    found = (R.R_A, R.R_B, -R.R_C)
    assert found == pytest.approx((R12, R43, -(R43 + g.F3)), rel=1e-14)
    assert R.M_B == 0


def test_program_sr3_gives_the_reactions_of_kind_3_with_gamma3_in_its_second_term(source: Any) -> None:
    """(1.35), (1.37), (1.41), (1.46): F3 turns with the sine of phi2 - gamma3, printed as phi2 - gamma2."""
    g, S2, S3 = source, 0.2, 0.25  # from A and from E along the axis
    u = np.exp(1j * g.phi2)

    def tangential(gamma: float) -> float:
        moment = abs(g.F2) * (g.l - S2) * np.sin(g.phi2 - g.gamma2) + abs(g.F3) * S3 * np.sin(g.phi2 - gamma)
        return float((moment + g.M2 + g.M3) / g.l)

    # the source's axis runs from A to E: A = -l u, the moments count about E = 0
    R = rpr_reactions(-g.l * u, 0, u, [Load(g.F2, (S2 - g.l) * u, g.M2)], [Load(g.F3, -S3 * u, g.M3)])
    assert cross(u, R.R_A) == pytest.approx(tangential(g.gamma3), rel=1e-14)
    assert cross(u, R.R_A) != pytest.approx(tangential(g.gamma2), rel=1e-2)
    W = 1j * tangential(g.gamma3) * u + g.F2
    R32 = W.real * np.sin(g.phi2) - W.imag * np.cos(g.phi2)
    found = R.R_C
    assert found == pytest.approx(1j * R32 * u, rel=1e-14)
    found = R.R_B
    assert found == pytest.approx(R.R_C - g.F3, rel=1e-14)
    gamma32 = angle(R.R_C)
    h32 = -(abs(g.F2) * S2 * np.sin(g.gamma2 - g.phi2) + g.M2) / (abs(R32) * np.sin(gamma32 - g.phi2))
    assert R.h_C == pytest.approx(h32, rel=1e-13)


def test_balancing_moment_is_minus_the_sum_that_1_56_prints(source: Any) -> None:
    g = source
    A, S1 = g.l * np.exp(1j * g.phi2), 0.2 * np.exp(1j * g.phi2)
    printed = abs(g.F3) * g.l * np.sin(g.gamma3 - g.phi2) + abs(g.F2) * 0.2 * np.sin(g.gamma2 - g.phi2) + g.M2
    M, R_O1 = coupling_drive(0, [Load(g.F3, A), Load(g.F2, S1, g.M2)])
    found = M
    assert found == pytest.approx(-printed, rel=1e-14)
    assert R_O1 == -(g.F2 + g.F3)


# --- arguments -------------------------------------------------------------------------------------------------


def test_reactions_at_a_dead_centre_and_behind_an_unreachable_pin_are_nan_alone() -> None:
    C = np.array([1j, 0.5, complex("nan+nanj"), 1 - 1j])
    R = rrr_reactions(0, 1, C, [Load(1, 1j)], [Load(2j, 1)])
    D = coupling_drive(0, [Load(-R.R_A, 2)])
    for reaction in (*R, *D):
        assert np.array_equal(np.isnan(reaction), [False, True, True, False])


def test_an_unloaded_group_has_no_reactions_and_no_position_of_a_resultant() -> None:
    R = rrp_reactions(1j, [1, 2], 1)
    assert not np.any([R.R_A, R.R_B, R.R_C])
    assert R.M_B == 0
    assert np.all(np.isnan(R.h_B))


def test_an_unloaded_drive_is_at_rest() -> None:
    """Without loads, as the groups."""
    assert coupling_drive(0) == (0, 0) and gear_drive(0, -0.1, 0.3) == (0, 0) and cylinder_drive(0, 1, 0).F == 0


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: rrr_reactions(0, 1, 1j, Load(1, 0)), "loads_A = Load.* must be a sequence of Load"),
        (lambda: rrr_reactions(0, 1, 1j, [], [1 + 2j]), "loads_B = .* must be a sequence of Load"),
        (lambda: rrr_reactions(0, 1, 1j, [Load(np.inf, 0)]), r"loads_A\[0\].F = .* must be finite"),
        (
            lambda: rrr_reactions(0, 1, [1j, 2j], [Load(1, [1, 2, 3])]),
            r"not broadcast: C \(2,\), loads_A\[0\].P \(3,\)",
        ),
        (lambda: inertia(0, -1, 1), "mass m = -1 kg must not be negative"),
        (lambda: inertia(0, 1, np.nan), "moment of inertia J = nan kg m\\^2 must be a finite number"),
        (
            lambda: gear_drive(0, 1, np.pi / 2, []),
            "pressure angle alpha_w = 1.5707963267948966 rad must be less than pi/2",
        ),
        (lambda: gear_drive(0, 1, -0.1, []), "pressure angle alpha_w = -0.1 rad must not be negative"),
        (lambda: coupling_drive(0, [Load(1, 0, 1j)]), r"loads\[0\].M = 1j must be real numbers"),
        (lambda: rpr_reactions(0, 1, 0), "direction u = 0 must not be zero"),
    ],
)
def test_a_bad_argument_is_named_with_its_value(call: Any, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        call()
