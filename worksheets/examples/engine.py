import marimo

__generated_with = "0.25.1"
app = marimo.App(width="medium", app_title="Single-cylinder engine", css_file="../page.css")

with app.setup:
    import marimo as mo
    import numpy as np
    from numpy import abs, arcsin, arcsinh, cos, exp, interp, linspace, maximum, pi, sin, sinh, sqrt, trapezoid
    from scipy.integrate import cumulative_trapezoid

    from mechsheet import (
        Drawing, DriveMoment, Load, PinReaction, RRPGroup, SlideReaction, Used, ask, assembled, balance, caption,
        check, check_slope, closed_form, cross, dot, export, figure, find, from_file, inertia, inputs, largest_of,
        link_acceleration, mark, one_of, player, polar, read, side_by_side, slider, summary, table, title_block,
        typeset,
    )  # fmt: skip
    from mechsheet.units import MPa, bar, mm, rpm

    np.seterr(divide="ignore", invalid="ignore")  # a rod that does not reach the cylinder is told by its check

    @inputs
    class Gas:
        phi: float  # [deg] crank from the top dead centre before the intake; >= 0 <= 720
        p: float  # [bar] pressure in the cylinder; > 0

    @inputs
    class Iron:
        rho: float  # [kg/m**3] density; > 0
        v: float  # [m/s] greatest speed of the rim; > 0

    IRONS = {"grey cast iron": Iron(7200.0, 35.0), "ductile iron": Iron(7100.0, 55.0), "steel": Iron(7850.0, 75.0)}


@app.cell(hide_code=True)
def title():
    title_block(
        "Single-cylinder engine",
        """
    Crank, rod and piston of a four-stroke engine over a cycle of two turns: motion, forces of gas and inertia, torque,
    side force of the piston, load on crank pin and main bearing, and the flywheel that keeps the speed even. The
    pressure in the cylinder is a measured one, from the file `engine.csv` beside this worksheet. Weights and friction
    are left out.
    """,
    )
    return


@app.cell(hide_code=True)
def verdict(checks_bearing, checks_forces, checks_motion, checks_work, checks_flywheel, closing):
    summary(closing, checks_motion, checks_forces, checks_work, checks_bearing, checks_flywheel)
    return


@app.cell(hide_code=True)
def section_1():
    mo.md(r"""
    ## 1 Input data

    The crank 1 turns about O, the origin, and carries the rod 2 at A; the piston 3 on the rod's end C moves along the
    cylinder, whose axis is parallel to x at $y = e$. Angles count counter-clockwise from the axis x, which points to
    the cylinder head.
    """)
    return


@app.class_definition
@inputs
class Engine:
    # 1.1 Crank gear
    r: float = 50 * mm  # [mm] crank; > 0
    l: float = 170 * mm  # [mm] rod; > 0
    e: float = 1 * mm  # [mm] axis of the cylinder, from the crank's hinge
    D: float = 95 * mm  # [mm] bore; > 0
    n: float = 1800 * rpm  # [rpm] speed; > 0

    # 1.2 Masses
    m_P: float = 1.25  # [kg] piston with rings and pin; >= 0
    m_R: float = 1.7  # [kg] rod; >= 0
    l_S: float = 55 * mm  # [mm] rod's centre of mass from the crank's pin
    J_R: float = 0.0085  # [kg*m**2] rod about its centre of mass; >= 0
    m_C: float = 6.0  # [kg] crank with counterweights; >= 0
    r_C: float = -20 * mm  # [mm] its centre of mass from the hinge, negative opposite the pin

    # 1.3 Gas
    gas: list[Gas] = from_file("engine.csv")  # pressure in the cylinder over the cycle
    p_0: float = 1 * bar  # [bar] pressure in the crankcase; >= 0

    # 1.4 Bearings
    d_A: float = 60 * mm  # [mm] crank pin; > 0
    b_A: float = 32 * mm  # [mm] its bush; > 0
    p_A: float = 35 * MPa  # [MPa] greatest pressure in the bush; > 0

    # 1.5 Flywheel
    delta: float = 0.02  # [%] fluctuation of the speed that is allowed; > 0 < 50
    J_0: float = 0.06  # [kg*m**2] crank gear and what it drives; > 0
    iron: Iron = one_of(IRONS, "ductile iron")  # material of the rim
    D_F: float = 380 * mm  # [mm] middle diameter of the rim; > 0
    b_F: float = 60 * mm  # [mm] width of the rim; > 0

    # 1.6 Tables
    step: int = 10  # [-] positions, of 2 degrees each, from row to row; >= 1 <= 90

    """After # stand the unit and the meaning, after ; the limits."""


@app.cell
def form():
    form = ask(Engine)
    form
    return (form,)


@app.cell
def given(form):
    g = read(Engine, form)
    Used(g)
    return (g,)


@app.cell(hide_code=True)
def section_2():
    mo.md(r"""
    ## 2 Motion

    The rod stands at the angle $\beta$ to the cylinder's axis; $\mathrm{d}\beta$ and $\mathrm{d}x$ are slopes over the
    angle of the crank.
    """)
    return


@app.cell
def motion(g):
    omega = g.n  # [rad/s] crank
    phi = linspace(0, 4 * pi, 361)  # [deg] crank
    beta = lambda phi: arcsin((g.r * sin(phi) - g.e) / g.l)  # [deg] rod
    dbeta = lambda phi: g.r * cos(phi) / (g.l * cos(beta(phi)))  # [-] its slope
    x = lambda phi: g.r * cos(phi) + g.l * cos(beta(phi))  # [mm] piston from the crank's hinge
    dx = lambda phi: -g.r * sin(phi + beta(phi)) / cos(beta(phi))  # [mm/rad] its slope
    typeset()
    return beta, dbeta, dx, omega, phi, x


@app.cell
def fields(beta, dbeta, dx, g, omega, phi, x):
    beta_phi = beta(phi)  # [deg] rod
    A = g.r * exp(1j * phi)  # [mm] pin of the crank
    C = x(phi) + 1j * g.e  # [mm] pin of the piston
    S = A + g.l_S / g.l * (C - A)  # [mm] centre of mass of the rod
    x_top = sqrt((g.l + g.r) ** 2 - g.e**2)  # [mm] piston at the top dead centre
    x_bottom = sqrt((g.l - g.r) ** 2 - g.e**2)  # [mm] piston at the bottom dead centre
    s = x_top - x(phi)  # [mm] way of the piston
    v = -omega * dx(phi)  # [m/s] speed of the piston
    a_A = -(omega**2) * A  # [m/s**2] pin of the crank
    eps = omega**2 * (g.r * sin(phi) / g.l - sin(beta_phi) * dbeta(phi) ** 2) / cos(beta_phi)  # [rad/s**2] rod
    a_C = g.l * sin(beta_phi) * eps - omega**2 * (
        g.r * cos(phi) + g.l * cos(beta_phi) * dbeta(phi) ** 2
    )  # [m/s**2] piston
    a_S = a_A + g.l_S / g.l * (a_C - a_A)  # [m/s**2] centre of mass of the rod
    typeset()
    return A, C, S, a_A, a_C, a_S, beta_phi, eps, s, v, x_bottom, x_top


@app.cell(hide_code=True)
def section_21():
    mo.md("""
    ### 2.1 The same by the library's group

    Crank and group RRP, which knows none of these formulas; the piston's speed by differences too.
    """)
    return


@app.cell
def compared_motion(A, C, a_A, a_C, a_S, dx, eps, g, omega, phi, v, x):
    group = RRPGroup(A, 1j * g.e, 1, g.l, +1)
    group_v = group.velocity(1j * omega * A)
    group_a = group.acceleration(group_v, a_A)
    g_S = link_acceleration(A + g.l_S / g.l * group.AC, A, group_v.omega_A, group_a.epsilon_A, a_A)  # [m/s**2] rod
    closing = assembled("the rod reaches the cylinder's axis", group.C, g.l, group.reach, "rod l", "mm")
    checks_motion = (
        check("group RRP: piston", C - group.C, 1e-13, "mm", of=C),
        check("group RRP: speed of the piston", v + group_v.ds, 1e-12, "m/s", of=v),
        check("group RRP: acceleration of the piston", a_C - group_a.dds, 1e-12, "m/s**2", of=a_C),
        check("group RRP: acceleration of the rod", a_S - g_S, 1e-12, "m/s**2", of=a_S),
        check("group RRP: angular acceleration of the rod", eps - group_a.epsilon_A, 1e-12, "rad/s**2", of=eps),
        check_slope("dx is the slope of x", dx(phi), x, phi, 0, 4 * pi, "mm/rad"),
    )
    typeset(closing, *checks_motion)
    return checks_motion, closing, group, group_a


@app.cell
def results_2(a_C, beta_phi, g, phi, s, v):
    table_21 = table("2.1", "Motion", phi, beta_phi, s, v, a_C, every=g.step, decimals=2)
    figure_21 = figure("2.1", "Speed of the piston", phi, v)
    figure_22 = figure("2.2", "Acceleration of the piston", phi, a_C)
    typeset(table_21, figure_21, figure_22)
    return


@app.cell(hide_code=True)
def section_3():
    mo.md("""
    ## 3 Gas

    Between two points of the file the pressure is interpolated.
    """)
    return


@app.cell
def gas(g, phi, s, x_bottom, x_top):
    A_P = pi * g.D**2 / 4  # [cm**2] piston
    V_h = A_P * (x_top - x_bottom)  # [L] swept volume
    p = interp(phi, g.gas.phi, g.gas.p)  # [bar] pressure in the cylinder
    V = A_P * s  # [L] volume above that of the top dead centre
    F_g = -(p - g.p_0) * A_P  # [kN] gas on the piston
    W_i = trapezoid(p, V)  # [J] indicated work of a cycle
    p_mi = W_i / V_h  # [bar] indicated mean pressure
    P_i = W_i * g.n / (4 * pi)  # [kW] indicated power
    typeset()
    return A_P, F_g, V, W_i, p


@app.cell
def results_3(V, p, phi):
    figure_31 = figure("3.1", "Pressure in the cylinder", phi, p)
    figure_32 = figure("3.2", "Indicator diagram", V, p)
    typeset(figure_31, figure_32)
    return


@app.cell(hide_code=True)
def section_4():
    mo.md(r"""
    ## 4 Forces

    ### 4.1 Piston, rod, crank

    Inertia counts as a load. Along the cylinder act gas and inertia of the piston; moments of the rod about A give the
    side force $N$ of the cylinder on the piston:

    $$l \cos\beta\,N + l \sin\beta\,F + M_A = 0$$
    """)
    return


@app.cell
def forces(A, C, F_g, S, a_C, a_S, beta_phi, eps, g, omega, phi):
    F = F_g - g.m_P * a_C  # [kN] gas and inertia of the piston, along the cylinder
    F_S = -g.m_R * a_S  # [kN] inertia of the rod
    M_S = -g.J_R * eps  # [N*m] moment of its inertia
    M_A = cross(S - A, F_S) + M_S  # [N*m] inertia of the rod about A
    N = -(g.l * sin(beta_phi) * F + M_A) / (g.l * cos(beta_phi))  # [kN] side force, cylinder on the piston
    R_C = F + 1j * N  # [kN] piston on the rod, at C
    R_A = -(R_C + F_S)  # [kN] crank on the rod, at A
    F_1 = g.m_C * g.r_C * omega**2 * exp(1j * phi)  # [kN] inertia of the crank
    R_O = R_A - F_1  # [kN] frame on the crank, at O
    T = -cross(A, R_A)  # [N*m] torque of the engine
    T_g = F_g * cross(A, C - A) / (C - A).real  # [N*m] torque of the gas alone
    typeset()
    return F, F_1, F_S, M_S, N, R_A, R_C, R_O, T, T_g


@app.cell(hide_code=True)
def section_42():
    mo.md("""
    ### 4.2 Checks: the library's reactions, equilibrium of every body, virtual work
    """)
    return


@app.cell
def compared_forces(A, C, F_1, F_g, N, R_A, R_C, R_O, S, T, a_S, a_C, dbeta, dx, eps, g, group, group_a, phi):
    on_rod, on_piston = inertia(S, g.m_R, g.J_R, a_S, eps), inertia(C, g.m_P, 0, a_C)
    found = group.reactions([on_rod], [Load(F_g, C), inertia(C, g.m_P, 0, group_a.a_C)])
    size = largest_of(R_A, R_C, N)
    pairs = (
        DriveMoment(1, -T),
        PinReaction(1, 0, R_O, 0j),
        PinReaction(2, 1, R_A, A),
        PinReaction(3, 2, -R_C, C),
        SlideReaction(3, 0, 1j * N, C, 1),
    )
    loads = [[Load(F_1, 0j)], [on_rod], [on_piston, Load(F_g, C)]]
    V_S = 1j * A + g.l_S / g.l * (dx(phi) - 1j * A)  # [mm/rad] rod's centre of mass, for a radian of the crank
    W = (F_g - g.m_P * a_C) * dx(phi) + dot(on_rod.F, V_S) - on_rod.M * dbeta(phi)  # [N*m] virtual work of the loads
    checks_forces = (
        check("group RRP: force at the crank's pin", R_A - found.R_A, 1e-11, "kN", of=size),
        check("group RRP: force at the piston's pin", R_C - found.R_C, 1e-11, "kN", of=size),
        check("group RRP: side force", 1j * N - found.R_B, 1e-11, "kN", of=size),
        *balance("crank, rod, piston", loads, pairs, 1e-11, size, g.l + g.r),
        check("virtual work of the loads is the torque", W - T, 1e-11, "N*m", of=size * g.r),
    )
    typeset(*checks_forces)
    return (checks_forces,)


@app.cell(hide_code=True)
def section_43():
    mo.md("""
    ### 4.3 Over the cycle

    Drawn to scale; the slider turns the crank here and in the diagrams below.
    """)
    return


@app.cell
def turning():
    turn = slider(0, 718, step=2, value=378, label="crank", unit="deg")
    player(turn, turning=True)
    return (turn,)


@app.cell
def drawing_41(A, C, F, N, R_A, S, g, phi, turn, x_bottom, x_top):
    k = turn.value // 2
    _a, _c, _s = A[k], C[k], S[k]
    _b, _p = g.D / 2, 0.3 * g.D  # half the bore; half the piston's length, for the picture only
    _scale = 0.6 * g.l / largest_of(F, R_A)
    _frame = [-g.r - 1j * g.r, x_top + 3 * _p + 1j * g.r]
    _axis = 1j * g.e
    _walls = Drawing(width=860, height=420, frame=_frame, scales={"N": _scale})
    _end = x_top + 1.2 * _p
    _still = _walls.ground(_end + _axis + 1j * _b, x_bottom - _p + _axis + 1j * _b)
    _still = _still.ground(x_bottom - _p + _axis - 1j * _b, _end + _axis - 1j * _b)
    _still = _still.ground(_end + _axis - 1j * _b, _end + _axis + 1j * _b).path(A)
    _corners = [_c + _u * _p + 1j * _w * _b for _u, _w in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    _gear = _still.polygon(_corners, "3").link(0j, _a, "1").link(_a, _c, "2").mass(_s, "S")
    _pins = _gear.support(0j, "O", pi).hinge(_a, "A").hinge(_c, "C")
    drawing_41 = _pins.force(_c, F[k], "F").force(_c, 1j * N[k], "N").force(_a, -R_A[k], "-R_A")
    typeset(drawing_41, mark(phi=phi[k]), caption("4.1", f"Crank gear with its forces, φ = {turn.value}°"))
    return (k,)


@app.cell
def results_4(F, F_g, N, R_A, R_O, T, T_g, g, phi):
    table_41 = table("4.1", "Forces and torque", phi, F_g, F, N, abs(R_A), abs(R_O), T, every=g.step)
    figure_42 = figure("4.2", "Forces along the cylinder", phi, F_g, F)
    figure_43 = figure("4.3", "Side force", phi, N)
    figure_44 = figure("4.4", "Torque", phi, T, T_g)
    typeset(table_41, figure_42, figure_43, figure_44)
    return


@app.cell(hide_code=True)
def section_44():
    mo.md("""
    ### 4.4 Work over the cycle

    The torque does the work of the gas; inertia gives back what it takes.
    """)
    return


@app.cell
def work(T, T_g, W_i, phi):
    W_T = trapezoid(T, phi)  # [J] work of the torque in a cycle
    W_in = trapezoid(T - T_g, phi)  # [J] work of the inertia in a cycle
    T_m = W_T / (4 * pi)  # [N*m] mean torque
    checks_work = (
        check("torque and indicator diagram do the same work", W_T - W_i, 1e-3, "J", of=W_i),
        check("inertia does no work in a cycle", W_in, 1e-11, "J", of=4 * pi * largest_of(T - T_g)),
    )
    typeset(*checks_work)
    return T_m, checks_work


@app.cell(hide_code=True)
def section_5():
    mo.md("""
    ## 5 Bearings

    On the left the load on the main bearing, in the axes of the frame; on the right that of the rod on the crank's
    pin, in axes that turn with the crank: where the curve lies, the pin wears. The quarters of the cycle are marked.
    """)
    return


@app.cell
def bearings(R_A, R_O, g, phi):
    Q_O = -R_O  # [kN] crank on the main bearing
    Q_A = -R_A * exp(-1j * phi)  # [kN] rod on the crank's pin, along and across the crank
    p_m = np.max(abs(Q_A)) / (g.d_A * g.b_A)  # [MPa] greatest pressure in the bush
    checks_bearing = check("pressure in the bush of the crank's pin", p_m, g.p_A, "MPa")
    typeset(checks_bearing)
    return Q_A, Q_O, checks_bearing


@app.cell
def polars(Q_A, Q_O, k):
    typeset(
        side_by_side(
            (polar(Q_O, k, "Q_O", turn=180, turns=2), "crank on the main bearing"),
            (polar(Q_A, k, "Q_A", turn=180, turns=2), "rod on the crank's pin, x along the crank"),
        ),
        caption("5.1", "Polar diagrams"),
    )
    return


@app.cell
def results_5(Q_A, Q_O, g, phi):
    table_51 = table("5.1", "Loads on the bearings", phi, Q_O.real, Q_O.imag, Q_A.real, Q_A.imag, every=g.step)
    figure_52 = figure("5.2", "Loads on the bearings", phi, abs(Q_O), abs(Q_A))
    typeset(table_51, figure_52)
    return


@app.cell(hide_code=True)
def section_6():
    mo.md(r"""
    ## 6 Flywheel

    The load takes the mean torque. What the engine gives beyond it speeds the shaft up: the greatest excess
    $A_\mathrm{f}$ between the lowest and the highest speed sets the inertia for the fluctuation $\delta$. The rim alone
    counts, and its thickness is made up to a whole millimetre.
    """)
    return


@app.cell
def flywheel(T, T_m, g, omega, phi):
    E = cumulative_trapezoid(T - T_m, phi, initial=0)  # [J] excess of work
    A_f = np.max(E) - np.min(E)  # [J] greatest excess
    J = A_f / (g.delta * omega**2)  # [kg*m**2] wanted
    J_F = maximum(J - g.J_0, 0)  # [kg*m**2] of the rim, nothing where the machine has enough
    J_h = lambda h: g.iron.rho * pi * g.D_F * g.b_F * h * (g.D_F**2 + h**2) / 4  # [kg*m**2] rim of the thickness h
    h_found = find(
        lambda h: J_h(h),
        *(0, g.D_F),
        equals=J_F,
        unknown="thickness h",
        quantity="moment of inertia",
        unit="kg*m**2",
        unknown_unit="mm",
    )
    h = h_found.value  # [mm] thickness of the rim, found
    q_F = 4 * J_F / (g.iron.rho * pi * g.D_F * g.b_F)  # [mm**3] right side of the cubic equation
    h_c = closed_form(h_found, 2 * g.D_F / sqrt(3) * sinh(arcsinh(sqrt(27) * q_F / (2 * g.D_F**3)) / 3))
    typeset(h_found, h_c)
    return E, J_h, h, h_c


@app.cell
def made(E, J_h, g, h, h_c, omega):
    h_F = np.ceil(h / mm) * mm  # [mm] thickness of the rim, made
    m_F = g.iron.rho * pi * g.D_F * g.b_F * h_F  # [kg] rim
    J_all = g.J_0 + J_h(h_F)  # [kg*m**2] what turns
    E_m = (np.max(E) + np.min(E)) / 2  # [J] middle of the excess
    n_k = sqrt(omega**2 + 2 * (E - E_m) / J_all)  # [rpm] speed over the cycle
    delta_F = (np.max(n_k) - np.min(n_k)) / omega  # [%] fluctuation of the speed
    v_F = np.max(n_k) * (g.D_F + h_F) / 2  # [m/s] speed of the rim
    checks_flywheel = (
        h_c,
        check("fluctuation of the speed", delta_F, g.delta, "%"),
        check("speed of the rim", v_F, g.iron.v, "m/s"),
    )
    typeset(*checks_flywheel)
    return checks_flywheel, n_k


@app.cell
def results_6(E, T, g, n_k, phi):
    table_61 = table("6.1", "Flywheel", phi, T, E, n_k, every=g.step)
    figure_61 = figure("6.1", "Excess of work", phi, E)
    figure_62 = figure("6.2", "Speed with the flywheel", phi, n_k)
    typeset(table_61, figure_61, figure_62)
    return


@app.cell
def workbook():
    export("Single-cylinder engine", globals())
    return


if __name__ == "__main__":
    app.run()
