import marimo

__generated_with = "0.25.1"
app = marimo.App(width="medium", app_title="Tractor hitch", css_file="page.css")

with app.setup:
    from typing import Literal

    import marimo as mo
    import numpy as np
    from numpy import abs, arange, cos, exp, pi, sin, sqrt, where
    from numpy import arccos as acos
    from numpy import arcsin as asin
    from numpy import arctan2 as atan2

    np.seterr(divide="ignore", invalid="ignore")  # no load: infinite reserve; no closure: NaN; both are shown so

    from mechsheet import (
        Check, Drawing, Load, Used, angle, ask, assembled, caption, check, check_slope, closed_form, cross,
        cut_group, export, figure, find, index, inputs, mark, player, read, require, rrr, rrr_reach,
        rrr_reactions, rrr_velocity, side_by_side, slider, summary, table, title_block, typeset,
    )  # fmt: skip
    from mechsheet.units import MPa, deg, m


@app.cell(hide_code=True)
def title():
    title_block(
        "Tractor hitch",
        """
    Geometry, kinematics, lifting capacity, forces and steering stability of a three-point hitch (MN) that a
    hydraulic cylinder (GC) lifts, with the implement (NM) that it carries on a tractor (MSHA).
    Change an input or a formula: everything below follows.
    """,
    )
    return


@app.cell(hide_code=True)
def verdict(
    checks_L4, checks_L7, checks_S_p, checks_analogues, checks_closing, checks_design, checks_drawn, checks_forces,
    checks_loops, checks_pole, checks_stability,
):  # fmt: skip
    summary(
        *(checks_design, checks_L4, checks_S_p, checks_L7, checks_closing, checks_loops),
        *(checks_analogues, checks_drawn, checks_forces, checks_stability, checks_pole),
    )
    return


@app.cell(hide_code=True)
def section_1():
    mo.md(r"""
    ## 1 Input data

    The document prints metres for $\varphi_\mathrm{BD}$ and $k_\mathrm{gc}$, an angle and a number. It writes $L_4$ and
    $L_7$ for the preliminary lengths too, and its captions of $a$ and $b$ are other ones (section 6).
    """)
    return


@app.class_definition
@inputs
class Hitch:
    # 1.1 Hinges on the tractor, from the rear axle
    X01: float = 0.415  # [m] cylinder hinge O1, x
    X03: float = 0.250  # [m] lift arm hinge O3, x
    X05: float = 0.135  # [m] lower link hinge O5, x
    X07: float = 0.415  # [m] upper link hinge O7, x
    Y01: float = 0.563  # [m] cylinder hinge O1, y
    Y03: float = 1.112  # [m] lift arm hinge O3, y
    Y05: float = 0.480  # [m] lower link hinge O5, y
    Y07: float = 0.895  # [m] upper link hinge O7, y

    # 1.2 Lengths of the links
    L3: float = 0.200  # [m] lift arm, to the cylinder pin; > 0
    L5: float = 0.480  # [m] lower link, to the lifting rod; > 0
    L6: float = 0.595 - 0.08  # [m] mast of the implement; > 0
    L34: float = 0.325  # [m] lift arm, to the lifting rod; > 0
    L56: float = 1.035  # [m] lower link, whole; > 0
    phi_BD: float = 22 * deg  # [deg] angle between the two sides of the lift arm
    L7_pre: float = 0.7  # [m] preliminary length of the upper link; > 0
    L4_pre: float = 0.6  # [m] preliminary length of the lifting rod; > 0
    Y56_min: float = 0.2  # [m] height of the suspension axis P56 at the least stroke

    # 1.3 Generalised coordinate
    S_min: float = 0.420  # [m] least length of the cylinder; > 0 < S_max
    S_max: float = 0.670  # [m] greatest length of the cylinder; > 0
    N_pol: int = 10  # [-] number of positions; >= 2 <= 10000

    # 1.4 Implement
    P6: float = 27500  # [N] weight of the implement; >= 0
    X6: float = 0.857  # [m] centre of mass from the suspension axis, along the ground
    Y6: float = 0.156  # [m] centre of mass above the suspension axis
    Y_P56: float = 0.4  # [m] suspension axis above the ground at work
    phi_P6: float = 90 * deg  # [deg] angle of the mast to the x axis at work; > 0 < 180

    # 1.5 Hydraulic drive of the tractor
    eta: float = 0.84  # [-] efficiency of the hydraulic system; > 0 <= 1
    D_gc: float = 0.08  # [m] piston diameter of a cylinder; > 0
    P_gc_max: float = 17.5e6  # [Pa] greatest pressure of the hydraulic system; > 0
    k_gc: int = 2  # [-] number of cylinders; >= 1

    # 1.6 Tractor
    a: float = 0.6  # [m] counterweights to the front axle; >= 0
    b: float = 1.62  # [m] rear axle to the tractor's centre of mass; >= 0
    L: float = 2.960  # [m] wheelbase; > 0
    P_gr: float = 8000  # [N] weight of the counterweights; >= 0
    P_msha: float = 56000  # [N] weight of the tractor; > 0

    # 1.7 Assembly
    side_23: Literal["left", "right"] = "right"  # pin P23, as seen from O1 to O3
    side_45: Literal["left", "right"] = "left"  # pin P45, as seen from P34 to O5
    side_67: Literal["left", "right"] = "right"  # pin P67, as seen from P56 to O7
    side_6: Literal["left", "right"] = "right"  # implement, from the rear axle

    """After # stand the unit and the meaning, after ; the limits; the page and the code take the same units."""


@app.cell
def form():
    form = ask(Hitch)
    form
    return (form,)


@app.cell
def given(form):
    g = read(Hitch, form)
    Used(g)
    return (g,)


@app.cell
def coordinate(g):
    dS = (g.S_max - g.S_min) / (g.N_pol - 1)  # [m] step of the generalised coordinate
    k = arange(g.N_pol)  # [-] number of the position
    t = k / (g.N_pol - 1)  # [-] part of the stroke
    S = g.S_min * (1 - t) + g.S_max * t  # [m] generalised coordinate, the length of the cylinder
    typeset()
    return (S,)


@app.cell(hide_code=True)
def section_2():
    mo.md(r"""
    ## 2 Geometry

    Points are complex numbers $x + iy$ from the rear axle. Each structural group of two links closes in two ways; the
    last argument of `rrr` names the one meant: +1 puts the inner pin to the left of the line from the first outer pin
    to the second. The inputs choose it, and the side of the tractor on which the implement is: a machine seen from its
    other side has the other one everywhere, its abscissas and $\varphi_\mathrm{BD}$ with the other sign and
    $\varphi_\mathrm{P6}$ from 180°.

    The document takes its angles from the law of cosines, by functions that know half of the circle. Its formulas stand
    below each group with the index d. They hold, but for whole turns, for the sides of the groups that 1.7 gives, and
    while the lift arm keeps to its side of the line $O_3 O_5$: beyond $\varphi_{341}$ = 180° the document's
    $\varphi_\mathrm{S1}$ has the wrong sign, and so has $\varphi_{53}$ where $P_{56}$ passes the line $O_5 O_7$.
    """)
    return


@app.cell
def sides(g):
    s_23 = where(g.side_23 == "left", 1, -1)  # [-] branch of the group (2, 3)
    s_45 = where(g.side_45 == "left", 1, -1)  # [-] branch of the group (4, 5)
    s_67 = where(g.side_67 == "left", 1, -1)  # [-] branch of the group (6, 7)
    s_6 = where(g.side_6 == "right", 1, -1)  # [-] direction from the rear axle to the implement
    typeset()
    return s_23, s_45, s_6, s_67


@app.cell
def hinges(g):
    O1 = g.X01 + 1j * g.Y01  # [m] cylinder hinge
    O3 = g.X03 + 1j * g.Y03  # [m] lift arm hinge
    O5 = g.X05 + 1j * g.Y05  # [m] lower link hinge
    O7 = g.X07 + 1j * g.Y07  # [m] upper link hinge
    typeset()
    return O1, O3, O5, O7


@app.cell(hide_code=True)
def section_21():
    mo.md("""
    ### 2.1 First structural group: cylinder and lift arm (2, 3)
    """)
    return


@app.cell
def group_1(O1, O3, g, s_23):
    L13 = abs(O1 - O3)  # [m] distance of the hinges O1, O3
    phi13 = atan2(g.Y03 - g.Y01, g.X01 - g.X03)  # [deg] slope of the line O1 O3
    P23 = lambda S: rrr(O1, O3, S, g.L3, s_23)  # [m] pin of the cylinder on the lift arm
    phi3 = lambda S: angle(P23(S) - O3)  # [deg] lift arm, side of the cylinder
    phi12 = lambda S: angle(P23(S) - O1)  # [deg] cylinder
    phi34 = lambda S: phi3(S) + g.phi_BD  # [deg] lift arm, side of the lifting rod
    P34 = lambda S: O3 + g.L34 * exp(1j * phi34(S))  # [m] pin of the lifting rod on the lift arm
    typeset()
    return L13, P23, P34, phi12, phi13, phi3, phi34


@app.cell
def printed_21(L13, S, g, phi13):
    phi3_d = acos((g.L3**2 + L13**2 - S**2) / (2 * g.L3 * L13)) - phi13  # [deg] lift arm by the document's formula
    typeset()
    return


@app.cell(hide_code=True)
def section_22():
    mo.md(r"""
    ### 2.2 Second structural group: lifting rod and lower link (4, 5)

    The length of the lifting rod $L_4$ is unknown; it must put the suspension axis $P_{56}$ at the height
    $Y_\mathrm{56,min}$ when the cylinder is shortest.
    """)
    return


@app.cell
def group_2(O3, O5, P34, g, s_45):
    L35 = abs(O3 - O5)  # [m] distance of the hinges O3, O5
    delta1 = pi - angle(O3 - O5)  # [deg] slope of the line O5 O3, as the document counts it
    P45 = lambda S, L4, branch=s_45: rrr(P34(S), O5, L4, g.L5, branch)  # [m] pin of the lifting rod on the lower link
    phi4 = lambda S, L4: angle(P45(S, L4) - P34(S))  # [deg] lifting rod
    phi5 = lambda S, L4, branch=s_45: angle(P45(S, L4, branch) - O5)  # [deg] lower link
    P56 = lambda S, L4, branch=s_45: O5 + g.L56 * exp(1j * phi5(S, L4, branch))  # [m] suspension axis
    typeset()
    return L35, P45, P56, delta1, phi4, phi5


@app.cell
def find_L4(O1, O3, O5, P34, P56, g, s_45, s_6):
    require(P34(g.S_min), g.S_min, rrr_reach(O1, O3, g.L3), "cylinder S", "m")
    L4_0 = (g.L4_pre * 0.1 + g.L4_pre * 1.5) * 0.5  # [m] start of the document's Find
    L4_found = find(
        lambda L4, branch: P56(g.S_min, L4, branch).imag,
        *rrr_reach(P34(g.S_min), O5, g.L5),
        equals=g.Y56_min,
        guess=L4_0,
        branches=(+1, -1),
        branch=s_45,
        unknown="lifting rod L4",
        quantity="height Y56 of the suspension axis",
        unit="m",
        unknown_unit="m",
    )
    L4 = L4_found.value  # [m] lifting rod, found
    psi5_0 = asin((g.Y56_min - g.Y05) / g.L56)  # [deg] lower link at the least stroke, above the horizontal
    phi5_0 = where(s_6 > 0, psi5_0, pi - psi5_0)  # [deg] lower link at the least stroke
    P45_0 = O5 + g.L5 * exp(1j * phi5_0)  # [m] its pin for the lifting rod
    P34_0 = P34(g.S_min)  # [m] pin of the lifting rod on the lift arm at the least stroke
    L4_c = abs(P45_0 - P34_0)  # [m] lifting rod as the distance of two points, which are now known
    s_34 = where(cross(P45_0 - O3, P34_0 - O3) > 0, 1, -1)  # [-] side of O3 P45 on which P34 is
    checks_L4 = closed_form(L4_found, L4_c)
    typeset(L4_found, checks_L4)
    return L4, checks_L4, s_34


@app.cell
def printed_22(L35, L4, S, delta1, g, phi34):
    phi341 = phi34(S) + delta1  # [deg] lift arm from the line O3 O5
    S1 = sqrt(L35**2 + g.L34**2 - 2 * L35 * g.L34 * cos(phi341))  # [m] distance O5 P34
    phiS1 = acos((L35**2 + S1**2 - g.L34**2) / (2 * L35 * S1))  # [deg] at O5, from O3 to P34
    phi41 = acos((L4**2 + S1**2 - g.L5**2) / (2 * L4 * S1)) - phiS1  # [deg] lifting rod from the line O3 O5
    phi51 = pi - acos((g.L5**2 + S1**2 - L4**2) / (2 * g.L5 * S1)) - phiS1  # [deg] lower link from that line
    phi4_d = phi41 - delta1  # [deg] lifting rod by the document's formula
    phi5_d = phi51 - delta1  # [deg] lower link by the document's formula
    typeset()
    return


@app.cell(hide_code=True)
def section_23():
    mo.md(r"""
    ### 2.3 Third structural group: mast and upper link (6, 7)

    The working stroke $S_\mathrm{p}$ puts the suspension axis at its working height; the length of the upper link $L_7$
    then sets the mast to the angle $\varphi_\mathrm{P6}$.
    """)
    return


@app.cell
def find_S_p(L4, O1, O3, O5, P56, g, s_34, s_6):
    S_p_found = find(
        lambda S: P56(S, L4).imag,
        g.S_min,
        g.S_max,
        equals=g.Y_P56,
        guess=0.5 * (g.S_max + g.S_min),
        unknown="working stroke S_p",
        quantity="height Y56 of the suspension axis",
        unit="m",
        unknown_unit="m",
    )
    S_p = S_p_found.value  # [m] working stroke, found
    psi5_p = asin((g.Y_P56 - g.Y05) / g.L56)  # [deg] lower link at work, above the horizontal
    phi5_p = where(s_6 > 0, psi5_p, pi - psi5_p)  # [deg] lower link at work
    P45_p = O5 + g.L5 * exp(1j * phi5_p)  # [m] its pin for the lifting rod
    P34_p = rrr(O3, P45_p, g.L34, L4, s_34)  # [m] pin of the lifting rod on the lift arm
    P23_p = O3 + g.L3 * exp(1j * (angle(P34_p - O3) - g.phi_BD))  # [m] pin of the cylinder
    S_c = abs(P23_p - O1)  # [m] working stroke as the distance of two points
    checks_S_p = closed_form(S_p_found, S_c)
    typeset(S_p_found, checks_S_p)
    return S_p, checks_S_p


@app.cell
def group_3(L4, O5, O7, P56, g, s_67):
    L57 = abs(O7 - O5)  # [m] distance of the hinges O5, O7
    delta2 = pi - angle(O7 - O5)  # [rad] slope of the line O5 O7, as the document counts it
    P67 = lambda S, L7: rrr(P56(S, L4), O7, g.L6, L7, s_67)  # [m] pin of the upper link on the mast

    def phi6P(P, L7, branch=s_67):
        return angle(rrr(P, O7, g.L6, L7, branch) - P)  # [deg] mast where P is the suspension axis

    phi6 = lambda S, L7: phi6P(P56(S, L4), L7)  # [deg] mast
    phi7 = lambda S, L7: angle(P67(S, L7) - O7)  # [deg] upper link
    typeset()
    return L57, P67, delta2, phi6, phi6P, phi7


@app.cell
def find_L7(L4, O7, P56, S_p, g, phi6P, s_67):
    P56_p = P56(S_p, L4)  # [m] suspension axis at work
    L7_0 = (g.L7_pre * 0.1 + g.L7_pre * 1.5) * 0.5  # [m] start of the document's Find
    L7_found = find(
        lambda L7, branch: phi6P(P56_p, L7, branch),
        *rrr_reach(P56_p, O7, g.L6),
        equals=g.phi_P6,
        guess=L7_0,
        branches=(+1, -1),
        branch=s_67,
        unknown="upper link L7",
        quantity="mast angle phi6",
        unit="deg",
        unknown_unit="m",
    )
    L7 = L7_found.value  # [m] upper link, found
    L7_c = abs(P56_p + g.L6 * exp(1j * g.phi_P6) - O7)  # [m] upper link as the distance of two points
    checks_L7 = closed_form(L7_found, L7_c)
    typeset(L7_found, checks_L7)
    return L7, checks_L7


@app.cell
def printed_23(L4, L57, L7, P56, S, delta2, g):
    P56_d = P56(S, L4)  # [m] suspension axis
    L53 = sqrt((g.X07 - P56_d.real) ** 2 + (g.Y07 - P56_d.imag) ** 2)  # [m] distance O7 P56
    phi53 = acos((L53**2 + L57**2 - g.L56**2) / (2 * L53 * L57))  # [deg] at O7, from O5 to P56
    phi61 = pi - acos((g.L6**2 + L53**2 - L7**2) / (2 * g.L6 * L53)) + phi53  # [deg] mast from the line O7 O5
    phi71 = acos((L7**2 + L53**2 - g.L6**2) / (2 * L7 * L53)) + phi53  # [deg] upper link from that line
    phi6_d = phi61 - delta2  # [deg] mast by the document's formula
    phi7_d = phi71 - delta2  # [deg] upper link by the document's formula
    typeset()
    return


@app.cell(hide_code=True)
def section_24():
    mo.md("""
    ### 2.4 Fields over the stroke

    With the lengths found, the positions are computed once for all $S$. The group closes wherever its two links
    reach each other; a position that does not close is left empty.
    """)
    return


@app.cell
def fields(L4, L7, O5, O7, P23, P34, P45, P56, P67, S, phi12, phi3, phi34, phi4, phi5, phi6, phi7):
    P23_S = P23(S)  # [m] pin of the cylinder on the lift arm
    P34_S = P34(S)  # [m] pin of the lifting rod on the lift arm
    P45_S = P45(S, L4)  # [m] pin of the lifting rod on the lower link
    P56_S = P56(S, L4)  # [m] suspension axis
    P67_S = P67(S, L7)  # [m] pin of the upper link on the mast
    phi12_S = phi12(S)  # [deg] cylinder
    phi3_S = phi3(S)  # [deg] lift arm, side of the cylinder
    phi34_S = phi34(S)  # [deg] lift arm, side of the lifting rod
    phi4_S = phi4(S, L4)  # [deg] lifting rod
    phi5_S = phi5(S, L4)  # [deg] lower link
    phi6_S = phi6(S, L7)  # [deg] mast
    phi7_S = phi7(S, L7)  # [deg] upper link
    S1_S = abs(P34_S - O5)  # [m] distance O5 P34
    L53_S = abs(P56_S - O7)  # [m] distance O7 P56
    typeset()
    return L53_S, P23_S, P34_S, P45_S, P56_S, P67_S, S1_S, phi12_S, phi34_S, phi3_S, phi4_S, phi5_S, phi6_S, phi7_S


@app.cell(hide_code=True)
def section_25():
    mo.md(r"""
    ### 2.5 Centre of mass of the implement

    $X_6, Y_6$ are given at work, in the axes of the tractor; turned back by the mast's angle there,
    $\varphi_6(S_\mathrm{p}) = \varphi_\mathrm{P6}$, they stay with the mast.
    """)
    return


@app.cell
def centre_of_mass(L4, L7, P56, P67, S, S_p, g, phi6):
    LS6 = sqrt(g.X6**2 + g.Y6**2)  # [m] suspension axis to the centre of mass
    r_s = abs(g.X6 + 1j * g.Y6 - P67(S_p, L7))  # [m] printed by the document, mixes two frames; nothing uses it
    phiS6 = (atan2(g.Y6, g.X6) - g.phi_P6) % (2 * pi)  # [deg] from the mast to the centre of mass
    PS6 = lambda S: P56(S, L4) + LS6 * exp(1j * (phiS6 + phi6(S, L7)))  # [m] centre of mass of the implement
    PS6_S = PS6(S)  # [m] centre of mass of the implement
    typeset()
    return LS6, PS6, PS6_S, phiS6


@app.cell(hide_code=True)
def section_scheme():
    mo.md("""
    ### Scheme of the hitch

    Drawn to scale from the computed points; the slider moves it from the least stroke to the greatest, which are
    shown faintly. The blue lines are the paths of the suspension axis and of the implement's centre of mass, the green
    arrows their velocities and that of the lifting rod's pin while the cylinder lengthens by one metre a second.
    """)
    return


@app.cell
def stroke():
    part = slider(0, 1, step=0.01, value=0.2, label="part of the stroke")
    player(part)
    return (part,)


@app.cell
def scheme(L4, L7, O1, O3, O5, O7, P23, P23_S, P34, P34_S, P45, P45_S, P56, P56_S, P67, P67_S, PS6, PS6_S, S, g):
    frame = np.concatenate([[O1, O3, O5, O7], P23_S, P34_S, P45_S, P56_S, P67_S, PS6_S])
    pins = lambda S: (P23(S), P34(S), P45(S, L4), P56(S, L4), P67(S, L7), PS6(S))

    def scheme(p23, p34, p45, p56, p67, s6):
        links = (
            Drawing(frame=frame).plate([O3, p23, p34], "3").cylinder(O1, p23, "S", 0.9 * g.S_min).link(p34, p45, "4")
        )
        links = links.link(O5, p56, "5").plate([p56, p67, s6], "6").link(O7, p67, "7")
        pins = links.support(O1, "O1").support(O3, "O3").support(O5, "O5").support(O7, "O7", pi).hinge(p23, "P23")
        return pins.hinge(p34, "P34").hinge(p45, "P45").hinge(p56, "P56").hinge(p67, "P67").mass(s6, "S6")

    fine = np.linspace(g.S_min, g.S_max, 100)
    paths = Drawing().path(P56(fine, L4)).path(PS6(fine))
    still = scheme(*pins(g.S_min)).faint() + scheme(*pins(g.S_max)).faint() + paths  # what the slider does not move
    return frame, pins, scheme, still


@app.cell
def velocities(O1, O3, O5, O7):
    def velocities(p23, p34, p45, p56, p67, s6, dS=1.0):
        v34 = 1j * rrr_velocity(O1, O3, p23, dr_A=dS).omega_B * (p34 - O3)
        v56 = 1j * rrr_velocity(p34, O5, p45, v34).omega_B * (p56 - O5)
        vS6 = v56 + 1j * rrr_velocity(p56, O7, p67, v56).omega_A * (s6 - p56)
        return v34, v56, vS6

    return (velocities,)


@app.cell
def drawing_21(g, part, pins, scheme, still, velocities):
    S_t = g.S_min * (1 - part.value) + g.S_max * part.value  # [m] stroke as drawn
    pins_t = pins(S_t)
    _, P34_t, _, P56_t, _, PS6_t = pins_t
    V34, V56, VS6 = velocities(*pins_t)
    moved = scheme(*pins_t).arrow(P34_t, V34, "V34", "m/s").arrow(P56_t, V56, "V56", "m/s")
    drawing_21 = moved.arrow(PS6_t, VS6, "VS6", "m/s") + still
    typeset(drawing_21, mark(S=S_t), caption("2.1", "Kinematic scheme of the hitch"))
    return


@app.cell(hide_code=True)
def section_26():
    mo.md(r"""
    ### 2.6 Check

    Every group closes at every position, and each pin is computed again round the other way of its loop. The
    document's formula for $\varphi_{12}$
    misses the pin: it is shown as printed, beside the right one.
    """)
    return


@app.cell
def loops(L13, L4, L53_S, L7, O1, O3, P23_S, P34_S, P45_S, P56_S, P67_S, S, S1_S, g, phi12_S, phi13, phi4_S, phi6_S):
    phi12_printed = phi13 - acos((S**2 + L13**2 - g.L3**2) / (2 * S * L13))  # [deg] cylinder, as printed (erratum)
    P23s_S = O1 + S * exp(1j * phi12_printed)  # [m] as printed: misses P23 (erratum)
    P23c_S = O1 + S * exp(1j * phi12_S)  # [m] pin of the cylinder from O1
    P34s_S = P45_S - L4 * exp(1j * phi4_S)  # [m] pin of the lifting rod on the lift arm, from P45
    P45s_S = P34_S + L4 * exp(1j * phi4_S)  # [m] pin of the lifting rod on the lower link, from P34
    P67s_S = P56_S + g.L6 * exp(1j * phi6_S)  # [m] pin of the upper link, from P56
    checks_loops = (
        check("loop of group (2, 3)", P23c_S - P23_S, 1e-12, "m", of=L13),
        check("loop of group (4, 5)", P34s_S - P34_S, 1e-12, "m", of=L4),
        check("loop of group (6, 7)", P67s_S - P67_S, 1e-12, "m", of=L7),
    )
    checks_closing = (
        assembled("group (2, 3) closes", P23_S, S, rrr_reach(O1, O3, g.L3), "cylinder S", "m"),
        assembled("group (4, 5) closes", P45_S, S1_S, (abs(L4 - g.L5), L4 + g.L5), "distance O5 P34", "m"),
        assembled("group (6, 7) closes", P67_S, L53_S, (abs(L7 - g.L6), L7 + g.L6), "distance O7 P56", "m"),
    )
    typeset(*checks_closing, *checks_loops)
    return P23c_S, P23s_S, P34s_S, P45s_S, P67s_S, checks_closing, checks_loops


@app.cell
def tables_2(
    P23_S, P23c_S, P23s_S, P34_S, P34s_S, P45_S, P45s_S, P56_S, P67_S, P67s_S, PS6_S, S, phi34_S, phi3_S, phi4_S,
    phi5_S, phi6_S, phi7_S,
):  # fmt: skip
    table_21 = table("2.1", "Link angles", S, phi34_S, phi3_S, phi4_S, phi5_S, phi6_S, phi7_S)
    table_22 = table(
        "2.2",
        "Points",
        S,
        *(P23_S.real, P23_S.imag, P23s_S.real, P23s_S.imag, P34_S.real, P34_S.imag),
        *(P34s_S.real, P34s_S.imag, P45_S.real, P45_S.imag, P45s_S.real, P45s_S.imag),
        *(P56_S.real, P56_S.imag, P67_S.real, P67_S.imag, P67s_S.real, P67s_S.imag),
        *(PS6_S.real, PS6_S.imag, P23c_S.real, P23c_S.imag),
        note="X23s, Y23s follow the document's formula for phi12 and miss P23; X23c, Y23c close the loop.",
    )
    typeset(table_21, table_22)
    return


@app.cell(hide_code=True)
def section_3():
    mo.md(r"""
    ## 3 Kinematics

    ### 3.1 Transmission ratios and velocity analogues

    The loop of each group, differentiated and projected across one of its links, gives the ratio of two angular
    velocities. Analogues are derivatives with respect to $S$; the document calls those of the links 4 to 7
    $\varphi_{41}$ to $\varphi_{71}$, as it calls the angles in 2.2 and 2.3.
    """)
    return


@app.cell
def transmission(L13, L4, L7, LS6, S, g, phi12_S, phi34_S, phi3_S, phi4_S, phi5_S, phi6_S, phi7_S, phiS6):
    U43 = g.L34 * sin(phi5_S - phi34_S) / (L4 * sin(phi4_S - phi5_S))  # [-] lifting rod to lift arm
    U53 = g.L34 * sin(phi34_S - phi4_S) / (g.L5 * sin(phi5_S - phi4_S))  # [-] lower link to lift arm
    U65 = g.L56 * sin(phi7_S - phi5_S) / (g.L6 * sin(phi6_S - phi7_S))  # [-] mast to lower link
    U75 = g.L56 * sin(phi5_S - phi6_S) / (L7 * sin(phi7_S - phi6_S))  # [-] upper link to lower link
    dphi3 = 1 / (g.L3 * sin(phi12_S - phi3_S))  # [rad/m] lift arm
    dphi3_d = (
        2 * S / sqrt(4 * L13**2 * g.L3**2 - (S**2 - L13**2 - g.L3**2) ** 2)
    )  # [rad/m] lift arm by the document's formula, without its sign
    dphi4 = dphi3 * U43  # [rad/m] lifting rod
    dphi5 = dphi3 * U53  # [rad/m] lower link
    dphi6 = dphi3 * U65 * U53  # [rad/m] mast
    dphi7 = dphi3 * U75 * U53  # [rad/m] upper link
    I56 = dphi5 * g.L56 * cos(phi5_S)  # [-] transmission number of the suspension axis
    IS6 = I56 + dphi6 * LS6 * cos(phi6_S + phiS6)  # [-] main transmission number, of the centre of mass
    typeset()
    return I56, IS6, U43, U53, U65, U75, dphi3, dphi4, dphi5, dphi6, dphi7


@app.cell(hide_code=True)
def section_32():
    mo.md("""
    ### 3.2 The same derivatives by another way

    The positions alone are differentiated numerically, with no formula of velocities.
    """)
    return


@app.cell
def differences(I56, IS6, L4, P23_S, P34_S, P45_S, P56, P56_S, P67_S, PS6, PS6_S, S, dphi3, g, phi3, velocities):
    checks_analogues = (
        check_slope("dphi3 is the slope of phi3", dphi3, phi3, S, g.S_min, g.S_max, "rad/m"),
        check_slope("I56 is the slope of Y56", I56, lambda s: P56(s, L4).imag, S, g.S_min, g.S_max),
        check_slope("IS6 is the slope of YS6", IS6, lambda s: PS6(s).imag, S, g.S_min, g.S_max),
    )
    _v34, _v56, _vS6 = velocities(P23_S, P34_S, P45_S, P56_S, P67_S, PS6_S)
    checks_drawn = (
        check("velocities as drawn: V56 rises by I56", _v56.imag - I56, 1e-11, of=I56),
        check("velocities as drawn: VS6 rises by IS6", _vS6.imag - IS6, 1e-11, of=IS6),
    )
    typeset(*checks_analogues, *checks_drawn)
    return checks_analogues, checks_drawn


@app.cell
def results_3(I56, IS6, S, S_p, U43, U53, U65, U75, dphi3, dphi4, dphi5, dphi6, dphi7):
    table_31 = table("3.1", "Kinematics", S, U43, U53, U65, U75, I56, IS6, dphi3, dphi4, dphi5, dphi6, dphi7)
    figure_31 = figure("3.1", "Velocity analogue of the lift arm", S, dphi3, marks={"S_p": S_p})
    figure_32 = figure("3.2", "Transmission numbers", S, I56, IS6, marks={"S_p": S_p})
    typeset(table_31, figure_31, figure_32)
    return


@app.cell(hide_code=True)
def section_4():
    mo.md(r"""
    ## 4 Lifting capacity

    Where $I_\mathrm{S6}$ is negative the implement sinks as the cylinder lengthens: the cylinder would have to pull.
    Force, pressure and capacity are negative there; the hitch carries nothing. At $I_\mathrm{S6} = 0$, a dead centre,
    the capacity has no bound.
    """)
    return


@app.cell
def capacity(I56, IS6, g):
    F_gc = g.P6 * IS6  # [N] force on the hydraulic cylinders
    S_gc = pi * g.D_gc**2 / 4  # [cm**2] piston area
    P_gc = F_gc / (g.k_gc * S_gc * g.eta)  # [MPa] pressure in the cylinders
    G56 = (
        g.k_gc * g.P_gc_max * g.eta * S_gc / I56
    )  # [N] capacity at the suspension axis; the document prints IS6, its numbers follow I56
    GS6 = g.k_gc * g.P_gc_max * g.eta * S_gc / IS6  # [N] capacity at the centre of mass
    dGS65 = (GS6 - g.P6) / g.P6  # [%] reserve of capacity
    typeset()
    return F_gc, G56, GS6, P_gc, dGS65


@app.cell
def results_4(F_gc, G56, GS6, P_gc, S, S_p, dGS65):
    table_41 = table("4.1", "Lifting capacity", S, F_gc, P_gc, G56, GS6, dGS65)
    figure_41 = figure("4.1", "Lifting capacity", S, G56, GS6, marks={"S_p": S_p})
    figure_42 = figure("4.2", "Force on the cylinders", S, F_gc, marks={"S_p": S_p})
    figure_43 = figure("4.3", "Pressure in the cylinders", S, P_gc, marks={"S_p": S_p})
    typeset(table_41, figure_41, figure_42, figure_43)
    return


@app.cell(hide_code=True)
def section_5():
    mo.md(r"""
    ## 5 Forces

    The groups are taken from the implement to the cylinder, each cut free and closed by the moments about its
    inner pin. Every reaction says which body acts on which.

    ### 5.1 Third group (6, 7)

    The equations $F_{67}$, $M_7$, $M_6$ leave rounding only. The document prints the last one with a plus before
    $R_\mathrm{56y}(X_{67} - X_{56})$; its numbers follow the minus.

    The document's lengths $a_1$ to $e_3$ and its formulas for the components along x stand below each group. Its
    formulas for those along y divide by $d_1$, $b_2$, $d_2$, $b_3$ or $d_3$, which pass through zero: $d_1$ does so at
    work, where the mast is upright. The group's own equations divide by its determinant alone.
    """)
    return


@app.cell
def forces_3(O7, P56_S, P67_S, PS6_S, g):
    G6 = -1j * g.P6  # [N] weight of the implement, at its centre of mass
    group_67 = rrr_reactions(P56_S, O7, P67_S, [Load(G6, PS6_S)])
    R56 = group_67.R_A  # [N] lower link 5 on the mast 6, at P56
    R07 = group_67.R_B  # [N] frame on the upper link 7, at O7
    R67 = -R07  # [N] mast 6 on the upper link 7, at P67
    F67 = R56 + R07 + G6  # [N] forces on the group
    M7 = cross(O7 - P67_S, R07)  # [N*m] moments on the upper link 7 about P67
    M6 = cross(P56_S - P67_S, R56) + cross(PS6_S - P67_S, G6)  # [N*m] moments on the mast 6 about P67
    M6_printed = (
        R56.real * (P67_S - P56_S).imag + R56.imag * (P67_S - P56_S).real - g.P6 * (PS6_S - P67_S).real
    )  # [N*m] as printed (erratum)
    typeset()
    return F67, G6, M6, M7, R07, R56, R67


@app.cell
def printed_3(O7, P56_S, P67_S, PS6_S, g):
    a1 = (O7 - P67_S).imag  # [m] O7 above P67
    b1 = (P67_S - O7).real  # [m] P67 to the right of O7
    c1 = (P67_S - P56_S).imag  # [m] P67 above P56
    d1 = (P67_S - P56_S).real  # [m] P67 to the right of P56
    e1 = (PS6_S - P67_S).real  # [m] S6 to the right of P67
    R56_x = g.P6 * b1 * (d1 + e1) / (a1 * d1 + b1 * c1)  # [N] R56 along x by the document's formula
    typeset()
    return


@app.cell(hide_code=True)
def section_52():
    mo.md(r"""
    ### 5.2 Second group (4, 5)

    $R_{34}$ and $R_{05}$ are forces of the group on its neighbours, as the document counts them.
    """)
    return


@app.cell
def forces_2(O5, P34_S, P45_S, P56_S, R56):
    R65 = -R56  # [N] mast 6 on the lower link 5, at P56
    group_45 = rrr_reactions(P34_S, O5, P45_S, [], [Load(R65, P56_S)])
    R34 = -group_45.R_A  # [N] lifting rod 4 on the lift arm 3, at P34
    R05 = -group_45.R_B  # [N] lower link 5 on the frame, at O5
    R45 = R34  # [N] lower link 5 on the lifting rod 4, at P45
    F45 = R65 - R34 - R05  # [N] forces on the group
    M4 = cross(P34_S - P45_S, -R34)  # [N*m] moments on the lifting rod 4 about P45
    M5 = cross(O5 - P45_S, -R05) + cross(P56_S - P45_S, R65)  # [N*m] moments on the lower link 5 about P45
    typeset()
    return F45, M4, M5, R05, R34, R45, R65


@app.cell
def printed_2(O5, P34_S, P45_S, P56_S, R65):
    a2 = (P34_S - P45_S).imag  # [m] P34 above P45
    b2 = (P34_S - P45_S).real  # [m] P34 to the right of P45
    c2 = (O5 - P45_S).imag  # [m] O5 above P45
    d2 = (P45_S - O5).real  # [m] P45 to the right of O5
    e2 = R65.real * (P45_S - P56_S).imag + R65.imag * (P56_S - P45_S).real  # [N*m] moment of R65 about P45
    D_2 = a2 * d2 + b2 * c2  # [m**2] determinant of the group
    R05_x = -(b2 * e2 - R65.real * a2 * d2 + R65.imag * b2 * d2) / D_2  # [N] R05 along x by the document's formula
    R34_x = (b2 * e2 + R65.real * b2 * c2 + R65.imag * b2 * d2) / D_2  # [N] R34 along x by the document's formula
    typeset()
    return


@app.cell(hide_code=True)
def section_53():
    mo.md(r"""
    ### 5.3 First group (2, 3)

    The document writes $-R_{43}$ for $R_{34}$.
    """)
    return


@app.cell
def forces_1(O1, O3, P23_S, P34_S, R34):
    R43 = -R34  # [N] lift arm 3 on the lifting rod 4, at P34
    group_23 = rrr_reactions(O1, O3, P23_S, [], [Load(R34, P34_S)])
    R01 = group_23.R_A  # [N] frame on the cylinder 2, at O1
    R03 = group_23.R_B  # [N] frame on the lift arm 3, at O3
    R23 = R01  # [N] cylinder 2 on the lift arm 3, at P23
    F23 = R01 + R03 - R43  # [N] forces on the group
    M2 = cross(O1 - P23_S, R01)  # [N*m] moments on the cylinder 2 about P23
    M3 = cross(O3 - P23_S, R03) - cross(P34_S - P23_S, R43)  # [N*m] moments on the lift arm 3 about P23
    typeset()
    return F23, M2, M3, R01, R03, R23, R43


@app.cell
def printed_1(O1, O3, P23_S, P34_S, R43):
    a3 = (P23_S - O1).imag  # [m] P23 above O1
    b3 = (P23_S - O1).real  # [m] P23 to the right of O1
    c3 = (O3 - P23_S).imag  # [m] O3 above P23
    d3 = (O3 - P23_S).real  # [m] O3 to the right of P23
    e3 = R43.real * (P23_S - P34_S).imag + R43.imag * (P34_S - P23_S).real  # [N*m] moment of R43 about P23
    D_3 = a3 * d3 - b3 * c3  # [m**2] determinant of the group
    R03_x = (b3 * e3 + R43.real * a3 * d3 - R43.imag * b3 * d3) / D_3  # [N] R03 along x by the document's formula
    R01_x = -(b3 * e3 + R43.real * b3 * c3 - R43.imag * b3 * d3) / D_3  # [N] R01 along x by the document's formula
    typeset()
    return


@app.cell(hide_code=True)
def section_groups():
    mo.md("""
    The groups cut free, at the position of the table nearest to this slider. Arrows are the forces that act on the
    group; all arrows of a drawing have one scale.
    """)
    return


@app.cell
def forces_drawn():
    forces_at = slider(0, 1, step=0.01, value=0.2, label="part of the stroke")
    player(forces_at)
    return (forces_at,)


@app.cell
def position(S, forces_at):
    k_t = round(forces_at.value * (len(S) - 1))  # [-] number of the position drawn
    S_k = S[k_t]  # [m] stroke of the position drawn
    typeset()
    return (k_t,)


@app.cell
def drawings_5(G6, O1, O3, O5, O7, P23_S, P34_S, P45_S, P56_S, P67_S, PS6_S, R01, R03, R05, R07, R34, R56, R65, g, k_t):
    p23, p34, p45, p56, p67, s6 = (P[k_t] for P in (P23_S, P34_S, P45_S, P56_S, P67_S, PS6_S))
    small = Drawing(width=345, height=345)
    links_67 = small.plate([p56, p67, s6], "6").link(O7, p67, "7")
    pins_67 = links_67.hinge(O7, "O7").hinge(p67, "P67").hinge(p56, "P56").mass(s6, "S6")
    forces_67 = {"R56": (P56_S, R56), "R07": (O7, R07), "P6": (PS6_S, G6)}
    drawing_51 = cut_group(pins_67, k_t, forces_67, [O7, P56_S, P67_S, PS6_S], part=0.4)
    links_45 = small.link(p34, p45, "4").link(O5, p56, "5")
    pins_45 = links_45.hinge(O5, "O5").hinge(p34, "P34").hinge(p45, "P45").hinge(p56, "P56")
    forces_45 = {"R65": (P56_S, R65), "-R05": (O5, -R05), "-R34": (P34_S, -R34)}
    drawing_52 = cut_group(pins_45, k_t, forces_45, [O5, P34_S, P45_S, P56_S], part=0.4)
    links_23 = small.plate([O3, p23, p34], "3").cylinder(O1, p23, "S", 0.9 * g.S_min)
    pins_23 = links_23.hinge(O1, "O1").hinge(O3, "O3").hinge(p23, "P23").hinge(p34, "P34")
    forces_23 = {"R01": (O1, R01), "R03": (O3, R03), "R34": (P34_S, R34)}
    drawing_53 = cut_group(pins_23, k_t, forces_23, [O1, O3, P23_S, P34_S], part=0.4)
    typeset(
        side_by_side(
            (drawing_51, caption("5.1", "Assur group (6, 7)")),
            (drawing_52, caption("5.2", "group (4, 5)")),
            (drawing_53, caption("5.3", "group (2, 3)")),
        )
    )
    return


@app.cell(hide_code=True)
def section_54():
    mo.md("""
    ### 5.4 Check: equilibrium of every body, and virtual work
    """)
    return


@app.cell
def equilibrium(
    F23, F45, F67, F_gc, G6, M2, M3, M4, M5, M6, M7, R01, R03, R05, R07, R23, R34, R45, R56, R65, R67, g, phi12_S,
):  # fmt: skip
    F2 = R01 - R23  # [N] forces on the cylinder 2
    F3 = R03 + R23 + R34  # [N] forces on the lift arm 3
    F4 = R45 - R34  # [N] forces on the lifting rod 4
    F5 = R65 - R05 - R45  # [N] forces on the lower link 5
    F6 = R56 - R67 + G6  # [N] forces on the mast 6
    F7 = R07 + R67  # [N] forces on the upper link 7
    largest = np.max(abs([R01, R03, R05, R07, R34, R56]))
    checks_forces = (
        check("equilibrium of forces, the three groups", [F23, F45, F67], 1e-12, "N", of=largest),
        check("equilibrium of forces, bodies 2..7", [F2, F3, F4, F5, F6, F7], 1e-12, "N", of=largest),
        check("equilibrium of moments, bodies 2..7", [M2, M3, M4, M5, M6, M7], 1e-12, "N*m", of=largest * g.L56),
        check("virtual work: R01 = P6 IS6 along the cylinder", R01 - F_gc * exp(1j * phi12_S), 1e-10, "N", of=largest),
    )
    typeset(*checks_forces)
    return (checks_forces,)


@app.cell
def results_5(F_gc, R01, R03, R05, R07, R23, R34, R45, R56, S, S_p):
    table_51 = table(
        "5.1",
        "Reactions",
        S,
        *(R56.real, R56.imag, R07.real, R07.imag, R23.real, R23.imag, R05.real, R05.imag),
        *(R34.real, R34.imag, R45.real, R45.imag, R03.real, R03.imag, R01.real, R01.imag),
        *(abs(R56), abs(R07), abs(R03), abs(R05), abs(R34), abs(R23), abs(R45), abs(R01), F_gc),
        note="R05 acts on the frame and R34 on the lift arm; the others act on the body named last in their line.",
    )
    figure_54 = figure(
        "5.4", "Reactions", S, abs(R01), abs(R03), abs(R05), abs(R07), abs(R34), abs(R56), marks={"S_p": S_p}
    )
    typeset(table_51, figure_54)
    return


@app.cell(hide_code=True)
def section_6():
    mo.md(r"""
    ## 6 Steering stability

    Forces and moments about the rear axle give the load $R_\mathrm{a}$ on the steered front wheels and $R_\mathrm{b}$
    on the rear ones:

    $$-P_\mathrm{gr} + R_\mathrm{a} - P_\mathrm{msha} + R_\mathrm{b} - P_6 = 0$$

    $$P_\mathrm{gr} (a + L) - R_\mathrm{a} L + P_\mathrm{msha} b - P_6 X_\mathrm{S6} = 0$$

    The document captions $a$ as the distance from the front wheels to the implement's centre of mass and $b$ as that
    from the rear wheels to the counterweights; in its moments, and its numbers, they are what 1.6 says. It first
    prints $R_\mathrm{b}$ with a weight that it does not define in the place of $P_\mathrm{msha}$.

    At least a fifth of the whole weight must stay on the steered wheels. The printed formula for the greatest implement
    subtracts newtons from newton metres and keeps the present implement's weight in the limit; the right one takes
    $R_\mathrm{a} = 0.2\,(P + P_\mathrm{msha} + P_\mathrm{gr})$.
    """)
    return


@app.cell
def stability(PS6_S, g, s_6):
    x_6 = s_6 * PS6_S.real  # [m] centre of mass of the implement behind the rear axle
    Ra = (g.P_gr * (g.a + g.L) + g.P_msha * g.b - g.P6 * x_6) / g.L  # [N] load on the front axle
    Rb = g.P_gr + g.P_msha + g.P6 - Ra  # [N] load on the rear axle
    dRa = Ra / (g.P6 + g.P_msha + g.P_gr)  # [%] share of the front axle
    dRb = Rb / (g.P6 + g.P_msha + g.P_gr)  # [%] share of the rear axle
    Ra_min = 0.2 * (g.P6 + g.P_msha + g.P_gr)  # [N] least load on the front axle
    GS6_max = (g.P_msha * g.b + g.P_gr * (g.a + g.L) - Ra_min) / x_6  # [N] greatest load, as printed (erratum)
    GS6_lim = (g.P_msha * g.b + g.P_gr * (g.a + g.L) - 0.2 * g.L * (g.P_msha + g.P_gr)) / (
        x_6 + 0.2 * g.L
    )  # [N] greatest load
    Ra_lim = (g.P_gr * (g.a + g.L) + g.P_msha * g.b - GS6_lim * x_6) / g.L  # [N] front axle under the greatest load
    checks_stability = check(
        "front axle keeps 20 % under GS6lim", Ra_lim / (GS6_lim + g.P_msha + g.P_gr) - 0.2, 1e-12, of=1
    )
    typeset(checks_stability)
    return GS6_lim, GS6_max, Ra, Ra_min, Rb, checks_stability, dRa, dRb


@app.cell
def drawing_61(P23_S, P34_S, P45_S, P56_S, P67_S, PS6_S, Ra, Rb, frame, g, k_t, s_6, scheme):
    pins_k = P23_S[k_t], P34_S[k_t], P45_S[k_t], P56_S[k_t], P67_S[k_t], PS6_S[k_t]
    rear, front = 0.8, 0.55  # radii of the wheels, for the picture only
    fore = -int(s_6)  # direction from the rear axle to the front one
    nose, axle, C = fore * (g.L + g.a), fore * g.L, fore * g.b + 0.9j
    body = [nose + 0.6j, nose + 1.05j, fore * g.b + 1.25j, -0.2 * fore + 1.25j, -0.2 * fore + 0.6j]
    ends = sorted([nose + fore * 0.3 * m, -fore * (np.max(-fore * frame.real) + 0.3)])
    machine = Drawing(width=900, height=480).ground(*ends).wheel(1j * rear, rear).wheel(axle + 1j * front, front)
    weights = (machine.polygon(body) + scheme(*pins_k).faint()).mass(C, "C").force(C, -1j * g.P_msha, "P_msha")
    loads = weights.force(nose + 0.6j, -1j * g.P_gr, "P_gr").mass(PS6_S[k_t], "S6").force(PS6_S[k_t], -1j * g.P6, "P6")
    wheels = loads.force(axle + 0j, 1j * Ra[k_t], "Ra", into=True).force(0j, 1j * Rb[k_t], "Rb", into=True)
    drawing_61 = wheels
    for name, level, *dimension in (("a", 1.05, nose, axle), ("L", 1.6, axle, 0), ("b", 1.25, fore * g.b, 0)):
        low, high = sorted(dimension)
        drawing_61 = drawing_61.dimension(low + 1j * level, high + 1j * level, name)
    typeset(drawing_61, caption("6.1", "The machine with its loads; wheels for the picture only"))
    return


@app.cell(hide_code=True)
def section_62():
    mo.md("""
    ### 6.2 Does the machine carry the implement?

    At every position the pressure must stay below the greatest one, the weight below the capacity, and the front axle
    must keep its least load.
    """)
    return


@app.cell
def design(GS6, P_gc, Ra, Ra_min, g):
    _pulls = "the cylinder would have to pull: the capacity is negative" if np.any(GS6 < 0) else ""
    checks_design = (
        Check("pressure within its limit", float(np.max(P_gc)) / MPa, g.P_gc_max / MPa, "MPa"),
        Check("weight within the capacity", g.P6, float(np.min(GS6)), "N", _pulls),
        Check("front axle keeps its least load", Ra_min, float(np.min(Ra)), "N"),
    )
    typeset(*checks_design)
    return (checks_design,)


@app.cell
def results_6(GS6_lim, GS6_max, Ra, Rb, S, S_p, dRa, dRb):
    table_61 = table(
        "6.1",
        "Stability",
        *(S, Ra, Rb, dRa, dRb, GS6_max, GS6_lim),
        note="GS6max follows the document's formula, which is wrong; GS6lim is the greatest stable load.",
    )
    figure_62 = figure("6.2", "Share of the weight on the steered wheels", S, dRa, marks={"S_p": S_p})
    typeset(table_61, figure_62)
    return


@app.cell(hide_code=True)
def section_7():
    mo.md(r"""
    ## 7 Check by the instant centre

    The mast turns about the point where the lines of the lower link and of the upper link meet. Its transmission
    numbers follow from the distances to that pole, whose abscissa from $O_5$ is $N_\mathrm{p} / D_\mathrm{p}$;
    multiplied out, the check holds for parallel links too, where the pole lies at infinity. The document's own formulas
    for it follow, by its letters AA to FF.
    """)
    return


@app.cell
def pole(I56, IS6, L7, O5, O7, P56_S, P67_S, PS6_S, dphi5, g, phi6_S, phi7_S):
    D_p = cross(P56_S - O5, P67_S - O7)  # [m**2] zero where the links are parallel
    N_p = cross(O7 - O5, P67_S - O7) * (P56_S - O5).real  # [m**3] abscissa of the pole from O5, times D_p
    X_p = g.X05 + N_p / D_p  # [m] abscissa of the pole, infinite where the links are parallel
    k_p = dphi5 / (g.L6 * L7 * sin(phi6_S - phi7_S))  # [1/m**3] angular velocity analogue of the mast over D_p
    Imp = k_p * ((P56_S - O5).real * D_p - N_p)  # [-] transmission number of the suspension axis
    Isp = k_p * ((PS6_S - O5).real * D_p - N_p)  # [-] main transmission number
    checks_pole = (
        check("instant centre: Imp = I56", Imp - I56, 1e-11, of=I56),
        check("instant centre: Isp = IS6", Isp - IS6, 1e-11, of=IS6),
    )
    typeset(*checks_pole)
    return Imp, Isp, X_p, checks_pole


@app.cell
def printed_7(P56_S, P67_S, PS6_S, dphi6, g):
    AA = P56_S.imag * g.X05 - g.Y05 * P56_S.real  # [m**2] moment of the line of the lower link about the rear axle
    BB = g.X07 - P67_S.real  # [m] O7 to the right of P67
    CC = g.Y07 - P67_S.imag  # [m] O7 above P67
    DD = g.X05 - P56_S.real  # [m] O5 to the right of P56
    EE = P67_S.imag * g.X07 - g.Y07 * P67_S.real  # [m**2] moment of the line of the upper link about the rear axle
    FF = g.Y05 - P56_S.imag  # [m] O5 above P56
    X_pd = (AA * BB - DD * EE) / (CC * DD - BB * FF)  # [m] abscissa of the pole by the document's formula
    Imp_d = dphi6 * (P56_S.real - X_pd)  # [-] transmission number of the suspension axis from it
    Isp_d = dphi6 * (PS6_S.real - X_pd)  # [-] main transmission number from it
    typeset()
    return


@app.cell
def table_7(I56, IS6, Imp, Isp, S, X_p):
    table_7 = table("7", "Instant centre", S, I56, IS6, Imp, Isp, X_p)
    table_7
    return


@app.cell(hide_code=True)
def listed():
    index()
    return


@app.cell
def workbook():
    export("Tractor hitch", globals())
    return


if __name__ == "__main__":
    app.run()
