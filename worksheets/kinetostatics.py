import marimo

__generated_with = "0.25.1"
app = marimo.App(width="medium", app_title="Kinetostatics", css_file="page.css")

with app.setup:
    import marimo as mo
    import numpy as np
    from numpy import abs, cos, exp, hypot, isfinite, linspace, maximum, pi, sin, trapezoid, where
    from numpy import arctan as atan
    from numpy import arctan2 as atan2
    from numpy import max as most
    from numpy import min as least

    np.seterr(divide="ignore", invalid="ignore")  # the arm of a force that is zero is shown as none

    from mechsheet import (
        Check, Drawing, DriveMoment, Load, PinReaction, RPRGroup, RRPGroup, RRRGroup, SlideReaction, Used, angle, ask,
        assembled, balance, caption, check, check_slope, coupling_drive, cross, cut_group, dot, export, figure,
        gear_drive, index, inertia, inputs, largest_of, link_acceleration, link_velocity, magnitudes, mark, player,
        polar_diagrams, read, rpr, rpr_acceleration, rpr_velocity, rrp, rrp_acceleration, rrp_transmission_angle,
        rrp_velocity, rrr, rrr_acceleration, rrr_transmission_angle, rrr_velocity, slider, solve_reactions, summary,
        table, title_block, typeset,
    )  # fmt: skip
    from mechsheet.units import MPa, deg, mm

    ulp = np.finfo(float).eps
    group_picture = Drawing(width=760, height=460)  # of each group cut free


@app.cell(hide_code=True)
def title():
    title_block(
        "Kinetostatics",
        """
    Reactions in the pairs of a lever mechanism of the second class, its links' inertia included, after I. G. Shebanov,
    *Force analysis*, Kharkiv Aviation Institute, 2003. In brackets stand the numbers of the document's formulas,
    figures and programs.

    The document gives the method for one group of each kind and prints no numbers. The mechanism here is ours: a
    plunger pump, whose dimensions, masses and loads are plausible and no more. Its crank drives a group of the first
    kind, whose rocker drives one of the second kind, the plunger, and one of the third kind, a gas cylinder. Change
    an input or a formula: everything below follows.

    A second machine: with the groups of the worksheet `hitch`, all of the first kind, section 6 gives the reactions
    that its document prints in table 5.1. For the other two kinds no published machine with all its numbers was found.
    """,
    )
    return


@app.cell(hide_code=True)
def verdict(
    check_dead, checks_23, checks_45, checks_67, checks_bodies, checks_closing, checks_dense, checks_directions,
    checks_drive, checks_gear, checks_work,
):  # fmt: skip
    summary(
        *(checks_closing, checks_45, checks_67, checks_23, checks_directions, checks_gear, checks_drive),
        *(check_dead, checks_bodies, checks_work, checks_dense),
    )
    return


@app.cell(hide_code=True)
def section_1():
    mo.md(r"""
    ## 1 Input data

    The crank 1 turns about $O_1$, the origin; the axis x points to the right, y upwards, angles count
    counter-clockwise. The rod 2 joins the crank's pin A to the pin B of the rocker 3, which turns about C. On the
    rocker, the pin D carries the rod 4 of the plunger 5, whose pin E moves along a fixed guide, and the pin K carries
    the piston rod 6 of the cylinder 7 on the hinge H.
    """)
    return


@app.class_definition
@inputs
class Mechanism:
    # 1.1 Hinges and guide, from the crank's hinge O1
    X_C: float = 0.45  # [m] rocker's hinge C, x
    Y_C: float = -0.10  # [m] rocker's hinge C, y
    X_H: float = 0.98  # [m] cylinder's hinge H, x
    Y_H: float = 0.22  # [m] cylinder's hinge H, y
    X05: float = 0.90  # [m] a point of the path of E, x
    Y05: float = -0.40  # [m] a point of the path of E, y
    phi05: float = -10 * deg  # [deg] direction of the guide

    # 1.2 Lengths of the links
    l1: float = 0.10  # [m] crank O1 A; > 0
    l2: float = 0.42  # [m] rod AB; > 0
    l3: float = 0.28  # [m] rocker CB; > 0
    l_CD: float = 0.22  # [m] rocker, C to D; > 0
    delta_D: float = 170 * deg  # [deg] rocker, from CB to CD
    l_CK: float = 0.20  # [m] rocker, C to K; > 0
    delta_K: float = -35 * deg  # [deg] rocker, from CB to CK
    l4: float = 0.45  # [m] rod DE; > 0
    l6: float = 0.30  # [m] rod with piston, from K; > 0
    l7: float = 0.32  # [m] cylinder, from H; > 0

    # 1.3 Centres of mass, on the lines of the pins
    l_O1S1: float = 0.02  # [m] crank, O1 to S1
    l_BS2: float = 0.22  # [m] rod 2, B to S2
    l_BS3: float = 0.24  # [m] rocker, B to S3
    l_ES4: float = 0.25  # [m] rod 4, E to S4
    l_KS6: float = 0.14  # [m] rod with piston, K to S6
    l_HS7: float = 0.13  # [m] cylinder, H to S7

    # 1.4 Masses and moments of inertia about the centres of mass
    m1: float = 9.0  # [kg] crank; >= 0
    m2: float = 3.2  # [kg] rod 2; >= 0
    m3: float = 6.5  # [kg] rocker; >= 0
    m4: float = 2.6  # [kg] rod 4; >= 0
    m5: float = 8.0  # [kg] plunger; >= 0
    m6: float = 1.8  # [kg] rod with piston; >= 0
    m7: float = 4.5  # [kg] cylinder; >= 0
    J1: float = 0.05  # [kg*m**2] crank; >= 0
    J2: float = 0.06  # [kg*m**2] rod 2; >= 0
    J3: float = 0.12  # [kg*m**2] rocker; >= 0
    J4: float = 0.05  # [kg*m**2] rod 4; >= 0
    J6: float = 0.015  # [kg*m**2] rod with piston; >= 0
    J7: float = 0.05  # [kg*m**2] cylinder; >= 0

    # 1.5 Loads
    g_n: float = 9.81  # [m/s**2] acceleration of gravity; >= 0
    Q5: float = 4500  # [N] resistance to the plunger in its working stroke, along the guide; >= 0
    p_g: float = 0.6 * MPa  # [MPa] pressure of the gas above that of the air; >= 0
    D_g: float = 0.05  # [m] diameter of the piston; > 0

    # 1.6 Drive
    n1: float = 300 * 2 * pi / 60  # [rpm] speed of the crank, negative clockwise
    eps1: float = 0.0  # [rad/s**2] angular acceleration of the crank
    l_O1P: float = 0.16  # [m] pitch radius of the crank's gear; > 0
    alpha_w: float = 20 * deg  # [deg] pressure angle of the gear; >= 0 < 90

    # 1.7 Tables
    step: int = 15  # [-] degrees of the crank from row to row; >= 1 <= 180

    """After # stand the unit and the meaning, after ; the limits; the page and the code take the same units."""


@app.cell
def form():
    form = ask(Mechanism)
    form
    return (form,)


@app.cell
def given(form):
    g = read(Mechanism, form)
    Used(g)
    return (g,)


@app.cell(hide_code=True)
def section_2():
    mo.md(r"""
    ## 2 Kinematics

    Points are complex numbers $x + iy$, functions of the crank's angle $\varphi_1$. $V$ and $u$ are velocity analogues:
    the velocity of a point and the angular velocity of a link for a crank that turns with 1 rad/s.
    All fields below have one value at each degree of the crank.
    """)
    return


@app.cell
def base(g):
    O1 = 0j  # [m] crank's hinge
    C = g.X_C + 1j * g.Y_C  # [m] rocker's hinge
    H = g.X_H + 1j * g.Y_H  # [m] cylinder's hinge
    O5 = g.X05 + 1j * g.Y05  # [m] a point of the path of E
    u5 = exp(1j * g.phi05)  # [-] direction of the guide
    omega1 = g.n1  # [rad/s] angular velocity of the crank
    phi1 = linspace(0, 2 * pi, 361)  # [deg] crank
    typeset()
    return C, H, O1, O5, omega1, phi1, u5


@app.cell
def kinematics(C, H, O1, O5, g, u5):
    """
    ### 2.1 Crank 1 and group (2, 3)

    The last argument of `rrr`, `rrp` and `rpr` names the branch of assembly.
    """
    P_A = lambda phi1: O1 + g.l1 * exp(1j * phi1)  # [m] pin of the crank
    V_A = lambda phi1: 1j * (P_A(phi1) - O1)  # [m] velocity analogue of A
    P_B = lambda phi1: rrr(P_A(phi1), C, g.l2, g.l3, +1)  # [m] pin of the rod 2 on the rocker
    motion_23 = lambda phi1: rrr_velocity(P_A(phi1), C, P_B(phi1), V_A(phi1))
    u2 = lambda phi1: motion_23(phi1).omega_A  # [-] rod 2 to crank
    u3 = lambda phi1: motion_23(phi1).omega_B  # [-] rocker 3 to crank
    P_D = lambda phi1: C + g.l_CD / g.l3 * (P_B(phi1) - C) * exp(1j * g.delta_D)  # [m] pin of the rod 4 on the rocker
    V_D = lambda phi1: 1j * u3(phi1) * (P_D(phi1) - C)  # [m] velocity analogue of D
    P_K = lambda phi1: C + g.l_CK / g.l3 * (P_B(phi1) - C) * exp(1j * g.delta_K)  # [m] pin of the rod 6 on the rocker
    V_K = lambda phi1: 1j * u3(phi1) * (P_K(phi1) - C)  # [m] velocity analogue of K
    """### 2.2 Groups (4, 5) and (6, 7)"""
    P_E = lambda phi1: rrp(P_D(phi1), O5, u5, g.l4, +1)  # [m] pin of the plunger
    motion_45 = lambda phi1: rrp_velocity(P_D(phi1), O5, P_E(phi1), u5, V_D(phi1))
    V_E = lambda phi1: motion_45(phi1).v_C  # [m] velocity analogue of E
    u4 = lambda phi1: motion_45(phi1).omega_A  # [-] rod 4 to crank
    e7 = lambda phi1: rpr(P_K(phi1), H, +1).u  # [-] direction of the cylinder, from H to K
    motion_67 = lambda phi1: rpr_velocity(P_K(phi1), H, e7(phi1), V_K(phi1))
    u6 = lambda phi1: motion_67(phi1).omega_A  # [-] rod 6 and cylinder 7 to crank
    typeset()
    return P_A, P_B, P_D, P_E, P_K, V_A, V_D, V_E, V_K, e7, motion_45, motion_67, u2, u3, u4, u6


@app.cell
def turn():
    """
    ### 2.3 Positions

    Drawn to scale. The slider turns the crank here and in all drawings below; formulas over the turn show their values
    at its position. The blue lines are the paths of the pins.
    """
    turn = slider(0, 360, step=2, value=40, label="crank", unit="deg")
    typeset(player(turn, turning=True))
    return (turn,)


@app.cell
def fields(C, H, O5, P_A, P_B, P_D, P_E, P_K, g, phi1, u5):
    A = P_A(phi1)  # [m] pin of the crank
    B = P_B(phi1)  # [m] pin of the rod 2 on the rocker
    D = P_D(phi1)  # [m] pin of the rod 4 on the rocker
    E = P_E(phi1)  # [m] pin of the plunger
    K = P_K(phi1)  # [m] pin of the rod 6 on the rocker
    phi2 = angle(B - A)  # [deg] rod 2, from A to B
    phi3 = angle(B - C)  # [deg] rocker, from C to B
    phi4 = angle(E - D)  # [deg] rod 4, from D to E
    phi6 = angle(H - K)  # [deg] rod 6, from K to H
    s5 = dot(E - O5, u5)  # [m] plunger along the guide
    s7 = g.l6 + g.l7 - abs(H - K)  # [m] stroke of the piston
    mu23 = rrr_transmission_angle(A, C, B)  # [deg] between rod 2 and rocker
    mu45 = rrp_transmission_angle(D, E, u5)  # [deg] between rod 4 and the normal of the guide
    group_23 = RRRGroup(A, C, g.l2, g.l3, +1)
    group_45 = RRPGroup(D, O5, u5, g.l4, +1)
    group_67 = RPRGroup(K, H, +1)
    position_lines = typeset()
    return A, B, D, E, K, group_23, group_45, group_67, mu23, mu45, phi2, phi3, phi4, phi6, position_lines, s5, s7


@app.cell
def drawing_21(A, B, C, D, E, H, K, O1, O5, g, phi1, position_lines, s5, turn, u5):
    _frame = np.concatenate([[O1, C, H, O1 - g.l_O1P], A, B, D, E, K])
    _paths = Drawing(width=820, height=520, frame=_frame).path(A).path(B).path(D).path(K)
    _s = s5[isfinite(s5)]
    _ends = (O5 + (_s.min() - 30 * mm) * u5, O5 + (_s.max() + 30 * mm) * u5) if _s.size else None
    _a, _b, _d, _e, _k = (_P[turn.value] for _P in (A, B, D, E, K))
    _bars = (_paths.guide(*_ends) if _ends else _paths).link(O1, _a, "1").link(_a, _b, "2").plate([C, _b, _k, _d], "3")
    _bodies = _bars.link(_d, _e, "4").slider(_e, g.phi05, "5").cylinder(H, _k, "7", g.l7)
    _fixed = _bodies.support(O1, "O1").support(C, "C", 0.0).support(H, "H", 0.0)
    drawing_21 = _fixed.hinge(_a, "A").hinge(_b, "B").hinge(_d, "D").hinge(_e, "E").hinge(_k, "K")
    _title = caption("2.1", f"Scheme of the mechanism, φ₁ = {turn.value}°")
    typeset(drawing_21, mark(phi1=phi1[turn.value]), _title, position_lines.at(turn.value))
    return


@app.cell
def positions(A, B, C, D, E, g, group_23, group_45, group_67, mu23, mu45, phi1, phi2, phi3, phi4, phi6, s5, s7):
    r"""
    The groups must close, and the piston must stay in its cylinder: its stroke is the document's $l_\mathrm{BC}$, from
    the open end of the cylinder to the piston.
    """
    checks_closing = (
        assembled("group (2, 3) closes", B, abs(A - C), (abs(g.l2 - g.l3), g.l2 + g.l3), "distance A C", "m"),
        assembled("group (4, 5) closes", where(isfinite(D), E, 0), g.l4, group_45.reach, "rod l4", "m"),
        check("the piston stays in its cylinder", maximum(0, maximum(-s7, s7 - g.l7)), 0, "m"),
    )
    # limit of the checks: from positions to forces the digits lost are twice those of the groups' condition numbers
    kappa = [np.max(group.condition) for group in (group_23, group_45, group_67)]
    lost = 32 * ulp * max(kappa) ** 2
    table_21 = table("2.1", "Positions", phi1, phi2, phi3, phi4, phi6, s5, s7, every=g.step)
    figure_22 = figure("2.2", "Transmission angles", phi1, mu23, mu45)
    typeset(*checks_closing, table_21, figure_22)
    return checks_closing, lost


@app.cell(hide_code=True)
def section_3():
    mo.md(r"""
    ## 3 Loads

    ### 3.1 Velocities and accelerations

    The crank turns with $\omega_1$ and $\varepsilon_1$ in every position.
    """)
    return


@app.cell
def loads_of_links(
    A, B, C, D, E, H, K, O1, O5, P_A, P_B, P_D, P_E, P_K, e7, g, motion_45, motion_67, omega1, phi1, u2, u3, u4, u5, u6
):
    P_S1 = lambda phi1: O1 + g.l_O1S1 * exp(1j * phi1)  # [m] crank
    P_S2 = lambda phi1: P_B(phi1) + g.l_BS2 / g.l2 * (P_A(phi1) - P_B(phi1))  # [m] rod 2
    P_S3 = lambda phi1: P_B(phi1) + g.l_BS3 / g.l3 * (C - P_B(phi1))  # [m] rocker
    P_S4 = lambda phi1: P_E(phi1) + g.l_ES4 / g.l4 * (P_D(phi1) - P_E(phi1))  # [m] rod 4
    P_S6 = lambda phi1: P_K(phi1) - g.l_KS6 * e7(phi1)  # [m] rod with piston
    P_S7 = lambda phi1: H + g.l_HS7 * e7(phi1)  # [m] cylinder
    centre_lines = typeset()
    omega2 = omega1 * u2(phi1)  # [rad/s] rod 2
    omega3 = omega1 * u3(phi1)  # [rad/s] rocker 3
    omega4 = omega1 * u4(phi1)  # [rad/s] rod 4
    omega6 = omega1 * u6(phi1)  # [rad/s] rod 6 and cylinder 7
    v5 = omega1 * motion_45(phi1).ds  # [m/s] plunger along the guide
    v6 = omega1 * motion_67(phi1).ds  # [m/s] rod 6 in the cylinder, outwards
    a_A = (1j * g.eps1 - omega1**2) * (A - O1)  # [m/s**2] pin A
    change_23 = rrr_acceleration(A, C, B, omega2, omega3, a_A=a_A)
    eps2 = change_23.epsilon_A  # [rad/s**2] rod 2
    eps3 = change_23.epsilon_B  # [rad/s**2] rocker 3
    a_D = (1j * eps3 - omega3**2) * (D - C)  # [m/s**2] pin D
    a_K = (1j * eps3 - omega3**2) * (K - C)  # [m/s**2] pin K
    change_45 = rrp_acceleration(D, O5, E, u5, omega4, v5, a_A=a_D)
    eps4 = change_45.epsilon_A  # [rad/s**2] rod 4
    a_E = change_45.a_C  # [m/s**2] plunger
    eps6 = rpr_acceleration(K, H, K - H, omega6, v6, a_A=a_K).epsilon_A  # [rad/s**2] rod 6 and cylinder 7
    S1 = P_S1(phi1)  # [m] crank
    S2 = P_S2(phi1)  # [m] rod 2
    S3 = P_S3(phi1)  # [m] rocker
    S4 = P_S4(phi1)  # [m] rod 4
    S6 = P_S6(phi1)  # [m] rod with piston
    S7 = P_S7(phi1)  # [m] cylinder
    a_S1 = link_acceleration(S1, O1, omega1, g.eps1)  # [m/s**2] crank
    a_S2 = link_acceleration(S2, A, omega2, eps2, a_A)  # [m/s**2] rod 2
    a_S3 = link_acceleration(S3, C, omega3, eps3)  # [m/s**2] rocker
    a_S4 = link_acceleration(S4, D, omega4, eps4, a_D)  # [m/s**2] rod 4
    a_S6 = link_acceleration(S6, K, omega6, eps6, a_K)  # [m/s**2] rod with piston
    a_S7 = link_acceleration(S7, H, omega6, eps6)  # [m/s**2] cylinder
    r"""
    ### 3.2 Inertia forces and moments (figure 1.1)

    The links have a plane of symmetry parallel to that of the motion, so the inertia of each makes a force at its
    centre of mass and a moment. A link that moves without turning, or turns evenly, has the force alone: so the
    plunger, and the crank while $\varepsilon_1 = 0$. One that turns about its own centre of mass has the moment alone.
    Forces are complex numbers too.
    """
    F_in1 = -g.m1 * a_S1  # [N] (1.1) crank, at S1
    F_in2 = -g.m2 * a_S2  # [N] (1.1) rod 2, at S2
    F_in3 = -g.m3 * a_S3  # [N] (1.1) rocker, at S3
    F_in4 = -g.m4 * a_S4  # [N] (1.1) rod 4, at S4
    F_in5 = -g.m5 * a_E  # [N] (1.1) plunger, at E
    F_in6 = -g.m6 * a_S6  # [N] (1.1) rod with piston, at S6
    F_in7 = -g.m7 * a_S7  # [N] (1.1) cylinder, at S7
    M_in1 = -g.J1 * g.eps1  # [N*m] (1.2) crank
    M_in2 = -g.J2 * eps2  # [N*m] (1.2) rod 2
    M_in3 = -g.J3 * eps3  # [N*m] (1.2) rocker
    M_in4 = -g.J4 * eps4  # [N*m] (1.2) rod 4
    M_in6 = -g.J6 * eps6  # [N*m] (1.2) rod with piston
    M_in7 = -g.J7 * eps6  # [N*m] (1.2) cylinder
    r"""
    ### 3.3 Weights, resistance, gas

    The resistance $Q_5$ acts in the working stroke, in which the plunger moves in the direction of the guide. The gas
    pushes the piston out of the cylinder and the cylinder the other way.
    """
    G1 = -1j * g.m1 * g.g_n  # [N] crank
    G2 = -1j * g.m2 * g.g_n  # [N] rod 2
    G3 = -1j * g.m3 * g.g_n  # [N] rocker
    G4 = -1j * g.m4 * g.g_n  # [N] rod 4
    G5 = -1j * g.m5 * g.g_n  # [N] plunger
    G6 = -1j * g.m6 * g.g_n  # [N] rod with piston
    G7 = -1j * g.m7 * g.g_n  # [N] cylinder
    working = motion_45(phi1).ds * where(omega1 < 0, -1, 1) > 0
    F_Q = where(working, -g.Q5, 0) * u5  # [N] resistance to the plunger, at E
    F_g = g.p_g * pi * g.D_g**2 / 4  # [N] force of the gas on the piston
    F_gas = F_g * e7(phi1)  # [N] gas on the piston, along the cylinder
    load_lines = typeset()
    return (
        F_Q, F_g, F_gas, F_in1, F_in2, F_in3, F_in4, F_in5, F_in6, F_in7, G1, G2, G3, G4, G5, G6, G7, M_in1, M_in2,
        M_in3, M_in4, M_in6, M_in7, P_S1, P_S2, P_S3, P_S4, P_S6, P_S7, S1, S2, S3, S4, S6, S7, a_E, a_S1, a_S2, a_S3,
        a_S4, a_S6, a_S7, centre_lines, eps2, eps3, eps4, eps6, load_lines,
    )  # fmt: skip


@app.cell
def loads_shown(centre_lines, load_lines, turn):
    typeset(centre_lines, load_lines.at(turn.value))
    return


@app.cell
def loads_listed(
    F_in2, F_in3, F_in4, F_in5, F_in6, F_in7, M_in2, M_in3, M_in4, M_in6, M_in7, a_E, eps2, eps3, eps4, eps6, g, phi1
):
    table_31 = table("3.1", "Accelerations", phi1, eps2, eps3, eps4, eps6, abs(a_E), every=g.step, decimals=1)
    table_32 = table(
        "3.2",
        "Inertia forces",
        *(phi1, abs(F_in2), abs(F_in3), abs(F_in4), abs(F_in5), abs(F_in6), abs(F_in7)),
        every=g.step,
    )
    table_33 = table("3.3", "Inertia moments", phi1, M_in2, M_in3, M_in4, M_in6, M_in7, every=g.step, decimals=1)
    typeset(table_31, table_32, table_33)
    return


@app.cell(hide_code=True)
def section_4():
    mo.md(r"""
    ## 4 Second kind: group (4, 5), rod and slider (program SR2)

    The groups are taken from the last to the first, then the driving link (1.2): so the document's first kind is here
    the last. Friction is taken as small and left out.

    The document's links 1, 2, 3, 4 and points A, B of the second kind are here the links 3, 4, 5, 0 and the points D,
    E; its $\varphi_4$ is $\varphi_{05}$. So its $R_{12}$ is here $R_{34}$, the force of the link 3 on the link 4, its
    $R_{43}$ is $R_{05}$ and its $R_{23}$ is $R_{45}$.

    Loads and inertia of a link make one force $F$, of the direction $\gamma$, at its centre of mass, and one moment
    $M$. A component keeps its sign with its number, so the document's cases "if minus, then $\gamma = \varphi -
    0.5\,\pi$" are not needed; the two-argument arctangent gives the angles of all quadrants, for which the document
    has the cases (1.28), (1.32) and the programs UGL2 to UGL4 (6.1).

    Moments on the rod about E, as vectors and as determinants over the unit vector of the axis z, then the forces on
    the group and on the plunger:

    $$\bar l_{ED} \times \bar R_{34}^\tau + \bar l_{ES_4} \times \bar F_4 + \bar M_4 = 0 \tag{1.22}$$

    $$\begin{vmatrix} l_{ED} \cos(\varphi_4 + \pi) & l_{ED} \sin(\varphi_4 + \pi) \\
    R_{34}^\tau \cos(\varphi_4 + 0.5\,\pi) & R_{34}^\tau \sin(\varphi_4 + 0.5\,\pi) \end{vmatrix} +
    \begin{vmatrix} l_{ES_4} \cos(\varphi_4 + \pi) & l_{ES_4} \sin(\varphi_4 + \pi) \\
    F_4 \cos\gamma_4 & F_4 \sin\gamma_4 \end{vmatrix} + M_4 = 0 \tag{1.23}$$

    $$\bar R_{34}^n + \bar R_{34}^\tau + \bar F_4 + \bar F_5 + \bar R_{05} = 0 \tag{1.25}$$

    $$\bar R_{05} + \bar F_5 + \bar R_{45} = 0 \tag{1.29}$$

    The line of $R_{05}$ passes through E: about it the force of the guide has no arm, $h_{05} = 0$.
    """)
    return


@app.cell
def kind_2(F_Q, F_in4, F_in5, G4, G5, M_in4, g, phi4):
    F4_sum = G4 + F_in4  # [N] loads on the rod 4, at S4
    F4 = abs(F4_sum)  # [N] loads on the rod 4
    gamma4 = angle(F4_sum)  # [deg] their direction
    M4 = M_in4  # [N*m] their moment
    F5_sum = G5 + F_in5 + F_Q  # [N] loads on the plunger 5, at E
    F5 = abs(F5_sum)  # [N] loads on the plunger 5
    gamma5 = angle(F5_sum)  # [deg] their direction
    R34_t = (F4 * g.l_ES4 * sin(phi4 - gamma4) + M4) / g.l4  # [N] (1.22)-(1.24) at D, across the rod
    gamma34_t = phi4 + 0.5 * pi  # [deg] its direction
    A_45 = R34_t * cos(gamma34_t) + F4 * cos(gamma4) + F5 * cos(gamma5)  # [N] (1.25), (1.26) known forces, x
    B_45 = R34_t * sin(gamma34_t) + F4 * sin(gamma4) + F5 * sin(gamma5)  # [N] (1.25), (1.26) known forces, y
    R34_n = -(A_45 * cos(g.phi05) + B_45 * sin(g.phi05)) / cos(phi4 - g.phi05)  # [N] (1.26) at D, along the rod
    R05 = (A_45 * sin(phi4) - B_45 * cos(phi4)) / cos(phi4 - g.phi05)  # [N] (1.26) of the guide, across it
    gamma05 = g.phi05 + 0.5 * pi  # [deg] its direction
    R34 = hypot(R34_n, R34_t)  # [N] (1.27) rocker 3 on the rod 4, at D
    gamma34 = (phi4 + atan2(R34_t, R34_n)) % (2 * pi)  # [deg] (1.28)
    R45_x = -(R05 * cos(gamma05) + F5 * cos(gamma5))  # [N] (1.29), (1.30) rod 4 on the plunger 5, at E
    R45_y = -(R05 * sin(gamma05) + F5 * sin(gamma5))  # [N] (1.29), (1.30)
    R45 = hypot(R45_x, R45_y)  # [N] (1.31)
    gamma45 = atan2(R45_y, R45_x) % (2 * pi)  # [deg] (1.32)
    SR2 = typeset()
    return A_45, B_45, F4_sum, F5_sum, M4, R05, R34, R34_n, R45, SR2, gamma05, gamma34, gamma45


@app.cell
def drawing_41(D, E, F4_sum, F5_sum, R_05, R_D, S4, SR2, checks_45, g, lines_42, turn, u5, vectors_45):
    _d, _e, _s4 = D[turn.value], E[turn.value], S4[turn.value]
    _links = group_picture.guide(_e - 60 * mm * u5, _e + 60 * mm * u5).link(_d, _e, "4").slider(_e, g.phi05, "5")
    _forces = {"F4": (S4, F4_sum), "F5": (E, F5_sum, D), "R05": (E, R_05), "R34": (D, R_D, E)}
    drawing_41 = cut_group(_links.hinge(_d, "D").hinge(_e, "E").mass(_s4, "S4"), turn.value, _forces, [D, E])
    typeset(
        *(turn, drawing_41),
        caption("4.1", f"Group (4, 5) with its forces (figure 1.3), φ₁ = {turn.value}°"),
        SR2.at(turn.value),
        "The same vectors by the mechanics library, which solves the group's equations in another form:",
        *(vectors_45.at(turn.value), *checks_45),
        r"""
        **Erratum.** The second line of the system after (1.26) is printed with a minus, $R_{12}^n \sin\varphi_2 -
        R_{43} \cos\varphi_4 = -B$; in (1.26) it has the plus. What each line leaves, and the reactions that solve
        the system as printed:
        """,
        lines_42.at(turn.value),
    )
    return


@app.cell(hide_code=True)
def section_5():
    mo.md(r"""
    ## 5 Third kind: group (6, 7), rod with piston and cylinder (program SR3)

    The document's links 1, 2, 3, 4 and points A, E are here the links 3, 6, 7, 0 and the points K, H; its $\varphi_2$
    is $\varphi_6$, from K to H. So its $R_{12}$ is here $R_{36}$, its $R_{32}$, the force of the cylinder on the rod
    square to their common line, is $R_{76}$, and its $R_{43}$ is $R_{07}$.

    Moments on the group about H, forces on the rod and on the cylinder, and moments on the rod about K, where
    $R_{76}$ has the arm $h_{76} = l_\mathrm{KN}$:

    $$\bar l_{HK} \times \bar R_{36}^\tau + \bar l_{HS_6} \times \bar F_6 + \bar l_{HS_7} \times \bar F_7 + \bar M_6 +
    \bar M_7 = 0, \qquad l_{HK} = l_6 - s_7 + l_7, \quad l_{HS_6} = l_{HK} - l_{KS_6} \tag{1.33}$$

    $$\begin{gathered} \begin{vmatrix} l_{HK} \cos(\varphi_6 + \pi) & l_{HK} \sin(\varphi_6 + \pi) \\
    R_{36}^\tau \cos(\varphi_6 + 0.5\,\pi) & R_{36}^\tau \sin(\varphi_6 + 0.5\,\pi) \end{vmatrix} +
    \begin{vmatrix} l_{HS_6} \cos(\varphi_6 + \pi) & l_{HS_6} \sin(\varphi_6 + \pi) \\
    F_6 \cos\gamma_6 & F_6 \sin\gamma_6 \end{vmatrix} + {} \\ {} +
    \begin{vmatrix} l_{HS_7} \cos(\varphi_6 + \pi) & l_{HS_7} \sin(\varphi_6 + \pi) \\
    F_7 \cos\gamma_7 & F_7 \sin\gamma_7 \end{vmatrix} + M_6 + M_7 = 0 \end{gathered} \tag{1.34}$$

    $$\bar R_{36}^n + \bar R_{36}^\tau + \bar F_6 + \bar R_{76} = 0 \tag{1.36}$$

    $$\bar R_{67} + \bar F_7 + \bar R_{07} = 0 \tag{1.40}$$

    $$\bar l_{KN} \times \bar R_{76} + \bar l_{KS_6} \times \bar F_6 + \bar M_6 = 0 \tag{1.44}$$

    $$\begin{vmatrix} l_{KN} \cos\varphi_6 & l_{KN} \sin\varphi_6 \\
    R_{76} \cos\gamma_{76} & R_{76} \sin\gamma_{76} \end{vmatrix} +
    \begin{vmatrix} l_{KS_6} \cos\varphi_6 & l_{KS_6} \sin\varphi_6 \\
    F_6 \cos\gamma_6 & F_6 \sin\gamma_6 \end{vmatrix} + M_6 = 0 \tag{1.45}$$
    """)
    return


@app.cell
def kind_3(F_gas, F_in6, F_in7, G6, G7, H, K, M_in6, M_in7, g, phi6):
    F6_sum = G6 + F_in6 + F_gas  # [N] loads on the rod with piston 6, at S6
    F6 = abs(F6_sum)  # [N] loads on the rod with piston 6
    gamma6 = angle(F6_sum)  # [deg] their direction
    M6 = M_in6  # [N*m] their moment
    F7_sum = G7 + F_in7 - F_gas  # [N] loads on the cylinder 7, at S7
    F7 = abs(F7_sum)  # [N] loads on the cylinder 7
    gamma7 = angle(F7_sum)  # [deg] their direction
    M7 = M_in7  # [N*m] their moment
    l_HK = abs(H - K)  # [m] (1.33) H to K; l6 - s7 + l7 loses its digits where l7 is long
    l_HS6 = l_HK - g.l_KS6  # [m] (1.33) H to S6
    T6 = F6 * l_HS6 * sin(phi6 - gamma6) + M6  # [N*m] (1.34) moment of the loads on 6 about H
    T7 = F7 * g.l_HS7 * sin(phi6 - gamma7) + M7  # [N*m] (1.34) moment of the loads on 7 about H
    R36_t = (T6 + T7) / l_HK  # [N] (1.33)-(1.35) at K, across the rod
    gamma36_t = phi6 + 0.5 * pi  # [deg] its direction
    A_67 = R36_t * cos(gamma36_t) + F6 * cos(gamma6)  # [N] (1.36), (1.37) known forces, x
    B_67 = R36_t * sin(gamma36_t) + F6 * sin(gamma6)  # [N] (1.36), (1.37) known forces, y
    R36_n = -(A_67 * cos(phi6) + B_67 * sin(phi6))  # [N] (1.37) at K, along the rod
    R76 = A_67 * sin(phi6) - B_67 * cos(phi6)  # [N] (1.37) cylinder 7 on the rod 6, across it
    gamma76 = phi6 + 0.5 * pi  # [deg] its direction
    R36 = hypot(R36_n, R36_t)  # [N] (1.38) rocker 3 on the rod 6, at K
    gamma36 = (phi6 + atan2(R36_t, R36_n)) % (2 * pi)  # [deg] (1.39)
    gamma67 = gamma76 + pi  # [deg] rod 6 on the cylinder 7
    R07_x = -(R76 * cos(gamma67) + F7 * cos(gamma7))  # [N] (1.40), (1.41) frame on the cylinder 7, at H
    R07_y = -(R76 * sin(gamma67) + F7 * sin(gamma7))  # [N] (1.40), (1.41)
    R07 = hypot(R07_x, R07_y)  # [N] (1.42)
    gamma07 = atan2(R07_y, R07_x) % (2 * pi)  # [deg] (1.43)
    h76 = -(F6 * g.l_KS6 * sin(gamma6 - phi6) + M6) / (R76 * sin(gamma76 - phi6))  # [m] (1.44)-(1.46) its arm from K
    SR3 = typeset()
    return (
        A_67, F6, F6_sum, F7, F7_sum, M6, M7, R07, R36, R36_n, R36_t, R76, SR3, T6, gamma07, gamma36, gamma6, gamma76,
        h76, l_HK,
    )  # fmt: skip


@app.cell
def drawing_51(F6_sum, F7_sum, H, K, R_H, R_K, S6, S7, SR3, checks_67, g, lines_52, turn, vectors_67):
    _k, _s6, _s7 = K[turn.value], S6[turn.value], S7[turn.value]
    _links = group_picture.cylinder(H, _k, "7", g.l7).hinge(H, "H").hinge(_k, "K").mass(_s6, "S6").mass(_s7, "S7")
    _forces = {"F6": (S6, F6_sum), "F7": (S7, F7_sum), "R36": (K, R_K, H), "R07": (H, R_H, K)}
    drawing_51 = cut_group(_links, turn.value, _forces, [K, H])
    typeset(
        *(turn, drawing_51),
        caption("5.1", f"Group (6, 7) with its forces (figure 1.4), φ₁ = {turn.value}°"),
        SR3.at(turn.value),
        """
        The same vectors by the library; $R_{76}$ at the arm $h_{76}$ does the same as the library's $R_{76}$ at
        K with its moment.
        """,
        *(vectors_67.at(turn.value), *checks_67),
        r"""
        **Errata.** The second term of (1.35) is printed with $\sin(\varphi_2 - \gamma_2)$, the direction of the
        other link's load. (1.34) is printed with $\sin(\varphi_2 + 0.5)$ for $\sin(\varphi_2 + 0.5\,\pi)$: the
        determinant over $l_\mathrm{EA} R_{12}^\tau$ is -1 with the $\pi$. The first line of the system after (1.37) is
        printed with $R_{43}$ for $R_{32}$, and its right sides are called those of (1.10). (1.37) itself has
        $R_{12}^\tau$ where (1.10) and (1.26) have $|R_{12}^\tau|$: the direction is turned where $R_{12}^\tau$ is
        negative, so the sign would count twice. The printed and the right numbers:
        """,
        lines_52.at(turn.value),
    )
    return


@app.cell(hide_code=True)
def section_6():
    mo.md(r"""
    ## 6 First kind: group (2, 3), rod and rocker (program SR1)

    Points and links have the document's names, but for its link 4, which is here the frame 0: its $R_{43}$ is
    $R_{03}$. The reactions found above act back on the rocker at D and K; with its own loads they make the force
    $F_3$ at $S_3$ and the moment $M_3$.

    Moments on each link about B, then the forces on the group and on the rocker:

    $$\bar l_{BA} \times \bar R_{12}^\tau + \bar l_{BS_2} \times \bar F_2 + \bar M_2 = 0 \tag{1.3}$$

    $$\begin{vmatrix} l_{BA} \cos(\varphi_2 + \pi) & l_{BA} \sin(\varphi_2 + \pi) \\
    R_{12}^\tau \cos(\varphi_2 + 0.5\,\pi) & R_{12}^\tau \sin(\varphi_2 + 0.5\,\pi) \end{vmatrix} +
    \begin{vmatrix} l_{BS_2} \cos(\varphi_2 + \pi) & l_{BS_2} \sin(\varphi_2 + \pi) \\
    F_2 \cos\gamma_2 & F_2 \sin\gamma_2 \end{vmatrix} + M_2 = 0 \tag{1.4}$$

    $$\bar l_{BC} \times \bar R_{03}^\tau + \bar l_{BS_3} \times \bar F_3 + \bar M_3 = 0 \tag{1.6}$$

    $$\begin{vmatrix} l_{BC} \cos(\varphi_3 + \pi) & l_{BC} \sin(\varphi_3 + \pi) \\
    R_{03}^\tau \cos(\varphi_3 + 0.5\,\pi) & R_{03}^\tau \sin(\varphi_3 + 0.5\,\pi) \end{vmatrix} +
    \begin{vmatrix} l_{BS_3} \cos(\varphi_3 + \pi) & l_{BS_3} \sin(\varphi_3 + \pi) \\
    F_3 \cos\gamma_3 & F_3 \sin\gamma_3 \end{vmatrix} + M_3 = 0 \tag{1.7}$$

    $$\bar R_{12}^n + \bar R_{12}^\tau + \bar F_2 + \bar F_3 + \bar R_{03}^\tau + \bar R_{03}^n = 0 \tag{1.9}$$

    $$\bar R_{03} + \bar F_3 + \bar R_{23} = 0 \tag{1.17}$$
    """)
    return


@app.cell
def kind_1(D, F_in2, F_in3, G2, G3, K, M_in2, M_in3, R34, R36, S3, g, gamma34, gamma36, phi2, phi3):
    F2_sum = G2 + F_in2  # [N] loads on the rod 2, at S2
    F2 = abs(F2_sum)  # [N] loads on the rod 2
    gamma2 = angle(F2_sum)  # [deg] their direction
    M2 = M_in2  # [N*m] their moment
    R43 = -R34 * exp(1j * gamma34)  # [N] rod 4 on the rocker 3, at D
    R63 = -R36 * exp(1j * gamma36)  # [N] rod 6 on the rocker 3, at K
    F3_own = G3 + F_in3  # [N] weight and inertia of the rocker 3, at S3
    F3_sum = F3_own + R43 + R63  # [N] loads on the rocker 3, at S3
    F3 = abs(F3_sum)  # [N] loads on the rocker 3
    gamma3 = angle(F3_sum)  # [deg] their direction
    M3 = M_in3 + cross(D - S3, R43) + cross(K - S3, R63)  # [N*m] their moment
    R12_t = (F2 * g.l_BS2 * sin(phi2 - gamma2) + M2) / g.l2  # [N] (1.3)-(1.5) at A, across the rod
    gamma12_t = phi2 + 0.5 * pi  # [deg] its direction
    R03_t = (F3 * g.l_BS3 * sin(phi3 - gamma3) + M3) / g.l3  # [N] (1.6)-(1.8) at C, across the rocker
    gamma03_t = phi3 + 0.5 * pi  # [deg] its direction
    A_2 = R12_t * cos(gamma12_t) + F2 * cos(gamma2)  # [N] (1.9), (1.10) known forces on 2, x
    A_3 = R03_t * cos(gamma03_t) + F3 * cos(gamma3)  # [N] (1.9), (1.10) known forces on 3, x
    A_23 = A_2 + A_3  # [N] (1.9), (1.10) known forces, x
    B_2 = R12_t * sin(gamma12_t) + F2 * sin(gamma2)  # [N] (1.9), (1.10) known forces on 2, y
    B_3 = R03_t * sin(gamma03_t) + F3 * sin(gamma3)  # [N] (1.9), (1.10) known forces on 3, y
    B_23 = B_2 + B_3  # [N] (1.9), (1.10) known forces, y
    R12_n = -(A_23 * sin(phi3) - B_23 * cos(phi3)) / sin(phi3 - phi2)  # [N] (1.10) at A, along the rod
    R03_n = -(A_23 * sin(phi2) - B_23 * cos(phi2)) / sin(phi2 - phi3)  # [N] (1.10) at C, along the rocker
    R12 = hypot(R12_n, R12_t)  # [N] (1.11) crank 1 on the rod 2, at A
    R03 = hypot(R03_n, R03_t)  # [N] (1.12) frame on the rocker 3, at C
    gamma12 = (phi2 + atan2(R12_t, R12_n)) % (2 * pi)  # [deg] (1.13), (1.14)
    gamma03 = (phi3 + atan2(R03_t, R03_n)) % (2 * pi)  # [deg] (1.15), (1.16)
    R23_x = -(R03 * cos(gamma03) + F3 * cos(gamma3))  # [N] (1.17), (1.18) rod 2 on the rocker 3, at B
    R23_y = -(R03 * sin(gamma03) + F3 * sin(gamma3))  # [N] (1.17), (1.19)
    R23 = hypot(R23_x, R23_y)  # [N] (1.20)
    gamma23 = atan2(R23_y, R23_x) % (2 * pi)  # [deg] (1.21)
    SR1 = typeset()
    return (
        F2_sum, F3_own, M2, R03, R03_n, R03_t, R12, R12_n, R12_t, R23, R23_x, R23_y, R43, R63, SR1, gamma03, gamma12,
        gamma23,
    )  # fmt: skip


@app.cell
def compared(
    A_45, A_67, B_45, D, E, F6, F7, F_Q, F_gas, G2, G3, G4, G5, G6, G7, H, K, M7, R03, R05, R07, R12, R23, R34, R34_n,
    R36, R36_n, R36_t, R45, R76, S2, S3, S4, S6, S7, T6, a_E, a_S2, a_S3, a_S4, a_S6, a_S7, eps2, eps3, eps4, eps6, g,
    gamma03, gamma05, gamma07, gamma12, gamma23, gamma34, gamma36, gamma45, gamma6, gamma76, group_23, group_45,
    group_67, h76, l_HK, lost, phi4, phi6,
):  # fmt: skip
    found_45 = group_45.reactions(
        [Load(G4, S4), inertia(S4, g.m4, g.J4, a_S4, eps4)], [Load(G5 + F_Q, E), inertia(E, g.m5, 0, a_E)]
    )
    R_D = found_45.R_A  # [N] rocker 3 on the rod 4, at D
    R_05 = found_45.R_B  # [N] guide on the plunger 5, at E
    R_E = -found_45.R_C  # [N] rod 4 on the plunger 5, at E
    _size = largest_of(R_D, R_05, R_E)
    checks_45 = (
        check("second kind: R34 is that of the library", R34 * exp(1j * gamma34) - R_D, lost, "N", of=_size),
        check("second kind: R05 is that of the library", R05 * exp(1j * gamma05) - R_05, lost, "N", of=_size),
        check("second kind: R45 is that of the library", R45 * exp(1j * gamma45) - R_E, lost, "N", of=_size),
    )
    vectors_45 = typeset()
    r_45 = R34_n * sin(phi4) + R05 * cos(g.phi05) + B_45  # [N] (1.26) left by the line with the plus
    r_45_printed = R34_n * sin(phi4) - R05 * cos(g.phi05) + B_45  # [N] (1.26) left by the line as printed (erratum)
    R34_n_printed = -(A_45 * cos(g.phi05) - B_45 * sin(g.phi05)) / cos(phi4 + g.phi05)  # [N] (1.26) printed (erratum)
    R05_printed = -(A_45 * sin(phi4) - B_45 * cos(phi4)) / cos(phi4 + g.phi05)  # [N] (1.26) as printed (erratum)
    lines_42 = typeset()
    found_67 = group_67.reactions(
        [Load(G6, S6), Load(F_gas, K), inertia(S6, g.m6, g.J6, a_S6, eps6)],
        [Load(G7, S7), Load(-F_gas, H), inertia(S7, g.m7, g.J7, a_S7, eps6)],
    )
    R_K = found_67.R_A  # [N] rocker 3 on the rod 6, at K
    R_H = found_67.R_B  # [N] frame on the cylinder 7, at H
    R_76 = found_67.R_C  # [N] cylinder 7 on the rod 6
    M_76 = found_67.M_C  # [N*m] its moment about K
    _size = largest_of(R_K, R_H, R_76)
    _moments = where(R76 == 0, 0, R76 * h76) - M_76
    checks_67 = (
        check("third kind: R36 is that of the library", R36 * exp(1j * gamma36) - R_K, lost, "N", of=_size),
        check("third kind: R76 is that of the library", R76 * exp(1j * gamma76) - R_76, lost, "N", of=_size),
        check("third kind: R07 is that of the library", R07 * exp(1j * gamma07) - R_H, lost, "N", of=_size),
        check("third kind: R76 h76 is the library's moment", _moments, lost, "N*m", of=_size * largest_of(l_HK)),
    )
    vectors_67 = typeset()
    T7_printed = F7 * g.l_HS7 * sin(phi6 - gamma6) + M7  # [N*m] (1.35) as printed (erratum)
    R36_t_printed = (T6 + T7_printed) / l_HK  # [N] (1.35) as printed (erratum)
    d_134 = cos(phi6 + pi) * sin(phi6 + 0.5 * pi) - sin(phi6 + pi) * cos(phi6 + 0.5 * pi)  # [-] (1.34)
    d_134_printed = cos(phi6 + pi) * sin(phi6 + 0.5) - sin(phi6 + pi) * cos(phi6 + 0.5 * pi)  # [-] (1.34) (erratum)
    r_67 = R36_n * cos(phi6) - R76 * sin(phi6) + A_67  # [N] (1.37) left by the first line
    r_67_printed = R36_n * cos(phi6) - R07 * sin(phi6) + A_67  # [N] (1.37) left as printed (erratum)
    gamma36_t_UGL2 = where(R36_t < 0, phi6 - 0.5 * pi, phi6 + 0.5 * pi)  # [deg] (1.35) of |R36_t|
    A_67_printed = R36_t * cos(gamma36_t_UGL2) + F6 * cos(gamma6)  # [N] (1.37) as printed, R36_t with sign (erratum)
    B_67_printed = R36_t * sin(gamma36_t_UGL2) + F6 * sin(gamma6)  # [N] (1.37) as printed, R36_t with sign (erratum)
    R76_printed = A_67_printed * sin(phi6) - B_67_printed * cos(phi6)  # [N] (1.37) from them (erratum)
    lines_52 = typeset()
    found_23 = group_23.reactions(
        [Load(G2, S2), inertia(S2, g.m2, g.J2, a_S2, eps2)],
        [Load(G3, S3), inertia(S3, g.m3, g.J3, a_S3, eps3), Load(-R_D, D), Load(-R_K, K)],
    )
    R_A = found_23.R_A  # [N] crank 1 on the rod 2, at A
    R_C = found_23.R_B  # [N] frame on the rocker 3, at C
    R_B = -found_23.R_C  # [N] rod 2 on the rocker 3, at B
    largest = largest_of(R_A, R_B, R_C, R_D, R_E, R_05, R_K, R_H)
    checks_23 = (
        check("first kind: R12 is that of the library", R12 * exp(1j * gamma12) - R_A, lost, "N", of=largest),
        check("first kind: R03 is that of the library", R03 * exp(1j * gamma03) - R_C, lost, "N", of=largest),
        check("first kind: R23 is that of the library", R23 * exp(1j * gamma23) - R_B, lost, "N", of=largest),
    )
    vectors_23 = typeset()
    return (
        R_05, R_A, R_B, R_C, R_D, R_E, R_H, R_K, checks_23, checks_45, checks_67, largest, lines_42, lines_52,
        vectors_23, vectors_45, vectors_67,
    )  # fmt: skip


@app.cell
def drawing_61(A, B, C, D, F2_sum, F3_own, K, R_A, R_C, R_D, R_K, S2, S3, SR1, checks_23, turn, vectors_23):
    _a, _b, _d, _k, _s2, _s3 = (_P[turn.value] for _P in (A, B, D, K, S2, S3))
    _links = group_picture.link(_a, _b, "2").plate([C, _b, _k, _d], "3").mass(_s2, "S2").mass(_s3, "S3")
    _pins = _links.hinge(_a, "A").hinge(_b, "B").hinge(C, "C").hinge(_d, "D").hinge(_k, "K")
    _back = {"R43": (D, -R_D, C), "R63": (K, -R_K, C)}
    _own = {"F2": (S2, F2_sum), "F3_own": (S3, F3_own), "R12": (A, R_A, B), "R03": (C, R_C, B)}
    drawing_61 = cut_group(_pins, turn.value, _back | _own, [A, B, C, D, K])
    typeset(
        *(turn, drawing_61),
        caption("6.1", f"Group (2, 3) with its forces (figure 1.2), φ₁ = {turn.value}°"),
        SR1.at(turn.value),
        "The same vectors by the library:",
        *(vectors_23.at(turn.value), *checks_23),
    )
    return


@app.cell
def directions(R03, R03_n, R03_t, R12, R12_n, R12_t, R23, R23_x, R23_y, gamma03, gamma12, gamma23, phi2, phi3):
    r"""
    ### 6.1 Directions by cases (programs UGL2, UGL3, UGL4)

    The document's subprograms take the arctangent of a quotient and choose the quadrant by signs. Their schemes are
    lost in the scan; by their notation, UGL2 turns the assumed direction of a component that comes out with minus,
    UGL3 is (1.21) and UGL4 is (1.13), (1.14). They agree with the two-argument arctangent in every case, but for whole
    turns: UGL3 gives $-90°$ to $270°$, so it is $360°$ less where the force points to the right and down; UGL4 counts
    on from the link. Where both components are zero there is no direction.
    """
    gamma12_UGL2 = where(R12_t < 0, phi2 - 0.5 * pi, phi2 + 0.5 * pi)  # [deg] (1.5) of |R12_t|
    gamma12_UGL4 = phi2 + where(R12_n < 0, pi, 0) + atan(R12_t / R12_n)  # [deg] (1.13), (1.14)
    gamma03_UGL4 = phi3 + where(R03_n < 0, pi, 0) + atan(R03_t / R03_n)  # [deg] (1.15), (1.16)
    gamma23_UGL3 = where(R23_x < 0, pi, 0) + atan(R23_y / R23_x)  # [deg] (1.21)
    _apart = lambda R, *pair: where(R == 0, 0, exp(1j * pair[0]) - exp(1j * pair[1]))
    _t = abs(R12_t) * exp(1j * gamma12_UGL2) - R12_t * exp(1j * (phi2 + 0.5 * pi))
    checks_directions = (
        check("UGL2: |R12t| in its direction is R12t", _t, 32 * ulp, "N", of=R12_t),
        check("UGL3: gamma23 but for whole turns", _apart(R23, gamma23, gamma23_UGL3), 64 * ulp, of=1),
        check("UGL4: gamma12 but for whole turns", _apart(R12, gamma12, gamma12_UGL4), 64 * ulp, of=1),
        check("UGL4: gamma03 but for whole turns", _apart(R03, gamma03, gamma03_UGL4), 64 * ulp, of=1),
    )
    direction_lines = typeset()
    return checks_directions, direction_lines, gamma03_UGL4, gamma12_UGL2, gamma12_UGL4, gamma23_UGL3


@app.cell
def directions_shown(
    checks_directions, direction_lines, g, gamma03, gamma03_UGL4, gamma12, gamma12_UGL2, gamma12_UGL4, gamma23,
    gamma23_UGL3, phi1, turn,
):  # fmt: skip
    table_61 = table(
        "6.1",
        "Directions by cases",
        *(phi1, gamma12_UGL2, gamma12, gamma12_UGL4, gamma03, gamma03_UGL4, gamma23, gamma23_UGL3),
        every=g.step,
        note="Directions that differ by 360 degrees are the same.",
    )
    typeset(direction_lines.at(turn.value), *checks_directions, table_61)
    return


@app.cell(hide_code=True)
def section_7():
    mo.md(r"""
    ## 7 Driving link

    On the crank act its weight and inertia and, at A, the reaction of the first group.
    """)
    return


@app.cell
def loads_1(F_in1, G1, M_in1, R12, gamma12):
    F1_sum = G1 + F_in1  # [N] loads on the crank, at S1
    F1 = abs(F1_sum)  # [N] loads on the crank
    gamma1 = angle(F1_sum)  # [deg] their direction
    M1 = M_in1  # [N*m] their moment
    R21 = R12  # [N] rod 2 on the crank 1, at A
    gamma21 = gamma12 + pi  # [deg] its direction
    given_1 = typeset()
    return F1, F1_sum, M1, R21, gamma1, gamma21, given_1


@app.cell
def loads_1_shown(given_1, turn):
    given_1.at(turn.value)
    return


@app.cell(hide_code=True)
def section_71():
    mo.md(r"""
    ### 7.1 Drive by a gear (program SRWL1)

    The wheel on the crank is driven at its pitch point P, to the left of $O_1$. Whichever flank of its teeth works, the
    force on it points inwards, $\alpha_\mathrm{w}$ off the tangent: where (1.49) comes out with minus, the direction is
    $1.5\,\pi + \alpha_\mathrm{w}$.

    $$\bar l_{O_1P} \times \bar F_b + \bar l_{O_1S_1} \times \bar F_1 + \bar l_{O_1A} \times \bar R_{21} + \bar M_1 = 0
    \tag{1.47}$$

    $$\begin{gathered}
    \begin{vmatrix} l_{O_1P} \cos\pi & l_{O_1P} \sin\pi \\ F_b \cos\gamma_b & F_b \sin\gamma_b \end{vmatrix} +
    \begin{vmatrix} l_{O_1S_1} \cos\varphi_1 & l_{O_1S_1} \sin\varphi_1 \\ F_1 \cos\gamma_1 & F_1 \sin\gamma_1
    \end{vmatrix} + {} \\ {} + \begin{vmatrix} l_{O_1A} \cos\varphi_1 & l_{O_1A} \sin\varphi_1 \\
    R_{21} \cos\gamma_{21} & R_{21} \sin\gamma_{21} \end{vmatrix} + M_1 = 0 \end{gathered} \tag{1.48}$$

    $$\bar R_{O_1} + \bar F_1 + \bar F_b + \bar R_{21} = 0 \tag{1.50}$$
    """)
    return


@app.cell
def gear(A, F1, G1, M1, O1, R21, R_A, S1, a_S1, g, gamma1, gamma21, lost, phi1):
    gamma_b0 = 0.5 * pi - g.alpha_w  # [deg] direction assumed first
    T1 = F1 * g.l_O1S1 * sin(gamma1 - phi1) + M1  # [N*m] (1.49) moment of the loads about O1
    T2 = R21 * g.l1 * sin(gamma21 - phi1)  # [N*m] (1.49) moment of R21 about O1
    F_b = (T1 + T2) / (g.l_O1P * sin(gamma_b0))  # [N] (1.47)-(1.49) balancing force
    gamma_b = where(F_b < 0, 1.5 * pi + g.alpha_w, gamma_b0)  # [deg] its direction
    R_O1g_x = -(F1 * cos(gamma1) + abs(F_b) * cos(gamma_b) + R21 * cos(gamma21))  # [N] (1.50), (1.51) at O1
    R_O1g_y = -(F1 * sin(gamma1) + abs(F_b) * sin(gamma_b) + R21 * sin(gamma21))  # [N] (1.50), (1.51)
    R_O1g = hypot(R_O1g_x, R_O1g_y)  # [N] (1.52) frame on the crank, gear
    gamma_O1g = atan2(R_O1g_y, R_O1g_x) % (2 * pi)  # [deg] (1.53)
    loads_O1 = [Load(G1, S1), inertia(S1, g.m1, g.J1, a_S1, g.eps1), Load(-R_A, A)]
    P_w = O1 - g.l_O1P  # [m] pitch point
    drive_g = gear_drive(O1, P_w, g.alpha_w, loads_O1)
    F_w = drive_g.F  # [N] balancing force on the crank's wheel, at P
    R_1g = drive_g.R_O1  # [N] frame on the crank, at O1, gear
    _size = largest_of(F_w, R_1g, R_A)
    checks_gear = (
        check("gear: the force is that of the library", abs(F_b) * exp(1j * gamma_b) - F_w, lost, "N", of=_size),
        check("gear: RO1 is that of the library", R_O1g * exp(1j * gamma_O1g) - R_1g, lost, "N", of=_size),
    )
    gear_lines = typeset()
    return F_b, F_w, P_w, R_1g, R_O1g, T1, T2, checks_gear, gamma_O1g, gamma_b, gear_lines, loads_O1


@app.cell
def drawing_71(A, F1_sum, F_w, O1, P_w, R_1g, R_A, S1, checks_gear, g, gear_lines, turn):
    _a, _wheel = A[turn.value], [O1 + g.l_O1P * _side for _side in (1, 1j, -1, -1j)]
    _links = group_picture.wheel(O1, g.l_O1P).link(O1, _a, "1").hinge(O1, "O1").hinge(_a, "A").hinge(P_w, "P")
    _forces = {"F1": (S1, F1_sum), "R21": (A, -R_A, O1), "F_b": (P_w, F_w, O1), "R_O1": (O1, R_1g, A)}
    drawing_71 = cut_group(_links, turn.value, _forces, [A, *_wheel])
    _title = caption("7.1", f"Crank driven by a gear (figure 1.5), φ₁ = {turn.value}°")
    typeset(turn, drawing_71, _title, gear_lines.at(turn.value), *checks_gear)
    return


@app.cell(hide_code=True)
def section_72():
    mo.md(r"""
    ### 7.2 Drive by a coupling (program SRWL2)

    The coupling gives the crank a moment and no force:

    $$\bar M_b + \bar M_1 + \bar l_{O_1A} \times \bar R_{21} + \bar l_{O_1S_1} \times \bar F_1 = 0 \tag{1.54}$$

    $$M_b + M_1 + \begin{vmatrix} l_{O_1A} \cos\varphi_1 & l_{O_1A} \sin\varphi_1 \\
    R_{21} \cos\gamma_{21} & R_{21} \sin\gamma_{21} \end{vmatrix} + \begin{vmatrix} l_{O_1S_1} \cos\varphi_1 &
    l_{O_1S_1} \sin\varphi_1 \\ F_1 \cos\gamma_1 & F_1 \sin\gamma_1 \end{vmatrix} = 0 \tag{1.55}$$

    $$\bar R_{21} + \bar F_1 + \bar R_{O_1} = 0 \tag{1.57}$$

    **Errata.** In (1.54) the products are garbled: a moment is multiplied by a length there; above it is as (1.55) has
    it. (1.56) is printed without the minus that (1.55) gives. From (1.57) on, the print has $F_{21}$ for $R_{21}$.
    """)
    return


@app.cell
def coupling(F1, O1, R21, R_A, T1, T2, g, gamma1, gamma21, loads_O1, lost):
    M_b_printed = T2 + T1  # [N*m] (1.56) as printed (erratum)
    M_b = -(T2 + T1)  # [N*m] (1.54)-(1.56) balancing moment
    R_O1c_x = -(R21 * cos(gamma21) + F1 * cos(gamma1))  # [N] (1.57), (1.58) frame on the crank, at O1
    R_O1c_y = -(R21 * sin(gamma21) + F1 * sin(gamma1))  # [N] (1.57), (1.58)
    R_O1c = hypot(R_O1c_x, R_O1c_y)  # [N] (1.58) frame on the crank, coupling
    gamma_O1c = atan2(R_O1c_y, R_O1c_x) % (2 * pi)  # [deg] (1.59)
    drive_c = coupling_drive(O1, loads_O1)
    M_c = drive_c.M  # [N*m] balancing moment
    R_1c = drive_c.R_O1  # [N] frame on the crank, at O1, coupling
    _size = largest_of(R_1c, R_A)
    checks_drive = (
        check("coupling: the moment is that of the library", M_b - M_c, lost, "N*m", of=_size * g.l1),
        check("coupling: RO1 is that of the library", R_O1c * exp(1j * gamma_O1c) - R_1c, lost, "N", of=_size),
    )
    coupling_lines = typeset()
    return M_b, M_c, R_1c, R_O1c, checks_drive, coupling_lines, gamma_O1c


@app.cell
def drawing_72(A, F1_sum, M_c, O1, R_1c, R_A, S1, checks_drive, coupling_lines, turn):
    _a, _M = A[turn.value], M_c[turn.value]
    _forces = {"F1": (S1, F1_sum), "R21": (A, -R_A, O1), "R_O1": (O1, R_1c, A)}
    drawing_72 = cut_group(group_picture.link(O1, _a, "1").hinge(O1, "O1").hinge(_a, "A"), turn.value, _forces, [A, O1])
    _says = f"balancing moment {_M:.4g} N·m" if isfinite(_M) else "no balancing moment"
    _title = caption("7.2", f"Crank driven by a coupling (figure 1.6), φ₁ = {turn.value}°: {_says}")
    typeset(turn, drawing_72, _title, coupling_lines.at(turn.value), *checks_drive)
    return


@app.cell(hide_code=True)
def section_8():
    mo.md(r"""
    ## 8 Full turn
    """)
    return


@app.cell
def turn_listed(
    F_b, M_b, R03, R05, R07, R12, R23, R34, R36, R45, R76, R_O1c, R_O1g, g, gamma03, gamma07, gamma12, gamma23, gamma34,
    gamma36, gamma45, gamma_O1c, gamma_O1g, gamma_b, h76, omega1, phi1, s5,
):  # fmt: skip
    P_b = M_b * omega1  # [kW] power of the drive
    W_b = trapezoid(M_b, phi1)  # [J] work of the drive in a turn
    M_mean = W_b / (2 * pi)  # [N*m] mean moment
    W_Q = g.Q5 * (most(s5) - least(s5))  # [J] work against the resistance in a turn
    power_lines = typeset()
    table_81 = table("8.1", "Reactions, second kind", phi1, R34, gamma34, R05, R45, gamma45, every=g.step)
    table_82 = table(
        "8.2",
        "Reactions, third kind",
        *(phi1, R36, gamma36, R76, h76, R07, gamma07),
        every=g.step,
        note="Where R76 passes through zero its arm h76 grows without bound: the pair then passes on a moment alone.",
    )
    table_83 = table("8.3", "Reactions, first kind", phi1, R12, gamma12, R23, gamma23, R03, gamma03, every=g.step)
    table_84 = table("8.4", "Drive by a gear", phi1, F_b, gamma_b, R_O1g, gamma_O1g, every=g.step)
    table_85 = table("8.5", "Drive by a coupling", phi1, M_b, R_O1c, gamma_O1c, P_b, every=g.step)
    typeset(table_81, table_82, table_83, table_84, table_85)
    return (power_lines,)


@app.cell
def power_shown(power_lines, turn):
    power_lines.at(turn.value)
    return


@app.cell
def turn_drawn(F_b, M_b, R03, R05, R07, R12, R23, R34, R36, R45, R76, R_O1c, R_O1g, phi1):
    figure_81 = figure("8.1", "Reactions of the second kind", phi1, R34, R45, R05)
    figure_82 = figure("8.2", "Reactions of the third kind", phi1, R36, R07, R76)
    figure_83 = figure("8.3", "Reactions of the first kind", phi1, R12, R23, R03)
    figure_84 = figure("8.4", "Balancing force of the gear", phi1, F_b)
    figure_85 = figure("8.5", "Balancing moment of the coupling", phi1, M_b)
    figure_86 = figure("8.6", "Reactions of the frame on the crank", phi1, R_O1g, R_O1c)
    typeset(figure_81, figure_82, figure_83, figure_84, figure_85, figure_86)
    return


@app.cell
def figure_87(R_1c, R_1g, R_A, R_B, R_C, R_D, R_E, R_H, R_K, turn):
    """
    ### Polar diagrams

    Each curve is the path of the end of a reaction, drawn from one point in the axes x, y of the frame; the crank's
    angle is marked at the quarters of the turn, the arrow is the reaction at the slider's position. Straight pieces are
    jumps, where the resistance begins and ends.
    """
    _polars = polar_diagrams(
        turn.value, R12=R_A, R23=R_B, R03=R_C, R34=R_D, R45=R_E, R36=R_K, R07=R_H, R_O1g=R_1g, R_O1c=R_1c
    )
    typeset(turn, _polars, caption("8.7", "Polar diagrams of the reactions"))
    return


@app.cell(hide_code=True)
def section_9():
    mo.md(r"""
    ## 9 Checks

    ### 9.1 Equilibrium of every body

    By the reactions of the document's formulas.
    """)
    return


@app.cell
def dead_centres(R_A, R_D, R_K):
    _lost = ~isfinite(R_A + R_D + R_K)
    _first = f"first at phi1 = {np.argmax(_lost)} deg" if np.any(_lost) else ""
    check_dead = Check("no position is a dead centre", np.count_nonzero(_lost), 0, "positions", _first, essential=True)
    typeset(check_dead)
    return (check_dead,)


@app.cell
def reactions(
    A, B, C, D, E, F1_sum, F2_sum, F3_own, F4_sum, F5_sum, F6_sum, F7_sum, H, K, M1, M2, M4, M6, M7, M_b, M_in3, O1,
    R03, R05, R07, R12, R23, R43, R45, R63, R76, R_O1c, S1, S2, S3, S4, S6, S7, gamma03, gamma05, gamma07, gamma12,
    gamma23, gamma45, gamma76, gamma_O1c, group_67, h76, largest, lost, u5,
):  # fmt: skip
    R12_v = R12 * exp(1j * gamma12)  # [N] crank 1 on the rod 2
    R23_v = R23 * exp(1j * gamma23)  # [N] rod 2 on the rocker 3
    R03_v = R03 * exp(1j * gamma03)  # [N] frame on the rocker 3
    R45_v = R45 * exp(1j * gamma45)  # [N] rod 4 on the plunger 5
    R05_v = R05 * exp(1j * gamma05)  # [N] guide on the plunger 5
    R76_v = R76 * exp(1j * gamma76)  # [N] cylinder 7 on the rod 6
    R07_v = R07 * exp(1j * gamma07)  # [N] frame on the cylinder 7
    R_O1_v = R_O1c * exp(1j * gamma_O1c)  # [N] frame on the crank
    M_67 = where(R76 == 0, 0, -R76 * h76)  # [N*m] rod 6 on the cylinder 7, about K
    reactions = (
        DriveMoment(1, M_b),
        PinReaction(1, 0, R_O1_v, O1),
        PinReaction(2, 1, R12_v, A),
        PinReaction(3, 2, R23_v, B),
        PinReaction(3, 0, R03_v, C),
        PinReaction(3, 4, R43, D),
        PinReaction(5, 4, R45_v, E),
        PinReaction(3, 6, R63, K),
        PinReaction(7, 0, R07_v, H),
        SlideReaction(5, 0, R05_v, E, u5),
        SlideReaction(6, 7, R76_v, K, group_67.u, -M_67),
    )
    _forces = F1_sum, F2_sum, F3_own, F4_sum, F5_sum, F6_sum, F7_sum
    _loads = zip(_forces, (S1, S2, S3, S4, E, S6, S7), (M1, M2, M_in3, M4, 0, M6, M7), strict=True)
    loads = [[Load(*load)] for load in _loads]  # on the bodies 1..7: force, its point, moment
    longest = largest_of(A - O1, B - C, A - B, D - E, H - K)
    M_max = largest * longest
    checks_bodies = balance("bodies 1..7", loads, reactions, lost, largest, longest)
    typeset(*checks_bodies)
    return M_max, checks_bodies, loads, reactions


@app.cell
def energy(C, F_g, H, P_A, P_D, P_E, P_K, P_S1, P_S2, P_S3, P_S4, P_S6, P_S7, V_A, V_D, V_E, V_K, g, u2, u3, u4, u6):
    r"""
    ### 9.2 Power and energy

    Virtual work: the balancing moment and all loads, each with the velocity analogue of its point, do no work together,
    whatever the reactions. The gear gives the power of the coupling.

    Energy: with the reduced moment of inertia $J_\mathrm{r}$ and the potential $U$ of weights and gas,
    $M_\mathrm{b} = J_\mathrm{r}\,\varepsilon_1 + \tfrac{1}{2}\,\omega_1^2\,\mathrm{d}J_\mathrm{r}/\mathrm{d}\varphi_1 +
    \mathrm{d}U/\mathrm{d}\varphi_1 - F_\mathrm{Q} \cdot V_\mathrm{E}$. Here the derivatives are taken numerically, so
    no formula of accelerations, inertia forces or reactions takes part.
    """
    V_S2 = lambda phi1: link_velocity(P_S2(phi1), P_A(phi1), u2(phi1), V_A(phi1))  # [m] velocity analogue of S2
    V_S3 = lambda phi1: link_velocity(P_S3(phi1), C, u3(phi1))  # [m] velocity analogue of S3
    V_S4 = lambda phi1: link_velocity(P_S4(phi1), P_D(phi1), u4(phi1), V_D(phi1))  # [m] velocity analogue of S4
    V_S6 = lambda phi1: link_velocity(P_S6(phi1), P_K(phi1), u6(phi1), V_K(phi1))  # [m] velocity analogue of S6
    V_S7 = lambda phi1: link_velocity(P_S7(phi1), H, u6(phi1))  # [m] velocity analogue of S7
    # fmt: off
    J_m = lambda phi1: (
        g.m1 * g.l_O1S1**2 + g.m2 * abs(V_S2(phi1)) ** 2 + g.m3 * abs(V_S3(phi1)) ** 2 + g.m4 * abs(V_S4(phi1)) ** 2
        + g.m5 * abs(V_E(phi1)) ** 2 + g.m6 * abs(V_S6(phi1)) ** 2 + g.m7 * abs(V_S7(phi1)) ** 2
    )  # [kg*m**2] reduced masses
    J_r = lambda phi1: (
        J_m(phi1) + g.J1 + g.J2 * u2(phi1) ** 2 + g.J3 * u3(phi1) ** 2 + g.J4 * u4(phi1) ** 2
        + (g.J6 + g.J7) * u6(phi1) ** 2
    )  # [kg*m**2] reduced moment of inertia
    Y_m = lambda phi1: (
        g.m1 * P_S1(phi1).imag + g.m2 * P_S2(phi1).imag + g.m3 * P_S3(phi1).imag + g.m4 * P_S4(phi1).imag
        + g.m5 * P_E(phi1).imag + g.m6 * P_S6(phi1).imag + g.m7 * P_S7(phi1).imag
    )  # [kg*m] masses times their heights
    # fmt: on
    U = lambda phi1: g.g_n * Y_m(phi1) - F_g * abs(P_K(phi1) - H)  # [J] potential of weights and gas
    typeset()
    return J_r, U, V_S2, V_S3, V_S4, V_S6, V_S7


@app.cell
def work(
    F1_sum, F2_sum, F3_own, F4_sum, F5_sum, F6_sum, F7_sum, F_Q, F_w, J_r, M1, M2, M4, M6, M7, M_b, M_in3, O1, P_w, S1,
    U, V_E, V_S2, V_S3, V_S4, V_S6, V_S7, g, M_max, lost, omega1, phi1, u2, u3, u4, u6,
):  # fmt: skip
    V_S1 = 1j * (S1 - O1)  # [m] velocity analogue of S1
    W_1 = dot(F1_sum, V_S1) + M1  # [N*m] work of the loads on the crank, for a radian of the crank
    W_2 = dot(F2_sum, V_S2(phi1)) + M2 * u2(phi1)  # [N*m] on the rod 2
    W_3 = dot(F3_own, V_S3(phi1)) + M_in3 * u3(phi1)  # [N*m] on the rocker 3
    W_4 = dot(F4_sum, V_S4(phi1)) + M4 * u4(phi1)  # [N*m] on the rod 4
    W_5 = dot(F5_sum, V_E(phi1))  # [N*m] on the plunger 5
    W_6 = dot(F6_sum, V_S6(phi1)) + M6 * u6(phi1)  # [N*m] on the rod with piston 6
    W_7 = dot(F7_sum, V_S7(phi1)) + M7 * u6(phi1)  # [N*m] on the cylinder 7
    work_lines = typeset()
    energy = lambda phi1: omega1**2 * J_r(phi1) / 2 + U(phi1)  # [J] energy at the speed of the crank
    driven = M_b - g.eps1 * J_r(phi1) + dot(F_Q, V_E(phi1))  # [N*m] left of the moment for the change of energy
    checks_work = (
        check("virtual work of moment and loads", M_b + W_1 + W_2 + W_3 + W_4 + W_5 + W_6 + W_7, lost, "N*m", of=M_max),
        check("the gear gives the power of the coupling", dot(F_w, 1j * (P_w - O1)) - M_b, lost, "N*m", of=M_max),
        check_slope("energy: the moment is its slope", driven[..., ::15], energy, phi1[::15], -pi, 3 * pi, "N*m"),
    )
    energy_lines = typeset()
    return checks_work, energy_lines, work_lines


@app.cell
def work_shown(checks_work, energy_lines, turn, work_lines):
    typeset(work_lines.at(turn.value), energy_lines, *checks_work)
    return


@app.cell
def dense(largest, M_max, loads, lost, reactions):
    r"""
    ### 9.3 One system for the whole mechanism

    Three equations of equilibrium for each of the seven bodies, with moments about $O_1$, hold the balancing moment,
    both components of the force in each of the eight hinges, and force and moment in both prismatic pairs: 21
    equations for 21 unknowns, solved at once in every position.
    """
    dense = solve_reactions(loads, reactions)
    _off = dense - magnitudes(reactions)
    checks_dense = (
        check("one system: balancing moment", _off[..., 0], lost, "N*m", of=M_max),
        check("one system: forces in the hinges", _off[..., 1:17:2] + 1j * _off[..., 2:17:2], lost, "N", of=largest),
        check("one system: forces in the prismatic pairs", _off[..., [17, 19]], lost, "N", of=largest),
        check("one system: moment of the guide", _off[..., 18], lost, "N*m", of=M_max),
        check("one system: moment of the cylinder on the rod", _off[..., 20], lost, "N*m", of=M_max),
    )
    typeset(*checks_dense)
    return (checks_dense,)


@app.cell(hide_code=True)
def listed():
    index()
    return


@app.cell
def workbook():
    export("Kinetostatics", globals())
    return


if __name__ == "__main__":
    app.run()
