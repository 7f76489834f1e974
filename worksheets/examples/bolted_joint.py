import marimo

__generated_with = "0.25.1"
app = marimo.App(width="medium", app_title="Bolted joint", css_file="../page.css")

with app.setup:
    import marimo as mo
    import numpy as np
    from numpy import linspace, log, maximum, minimum, pi, sqrt, trapezoid, where

    from mechsheet import (
        Drawing, Used, ask, caption, check, check_slope, closed_form, export, figure, find, inputs, one_of,
        read, slider, summary, table, title_block, typeset,
    )  # fmt: skip
    from mechsheet.units import MPa, define, inch, ksi, lbf, mm

    mil = define("mil", 0.001, "inch")
    np.seterr(divide="ignore", invalid="ignore")  # embedding may take all preload; what there is not is shown so

    @inputs
    class Grade:
        R_p: float  # [ksi] yield strength; > 0
        R_m: float  # [ksi] tensile strength; > 0

    @inputs
    class Part:
        E: float  # [ksi] Young's modulus; > 0
        p_G: float  # [ksi] greatest pressure under the head; > 0

    @inputs
    class Tool:
        alpha: float  # [-] scatter of the preload, greatest to least; >= 1

    @inputs
    class Case:
        F_A: float  # [lbf] pull along the bolt; >= 0
        F_Q: float  # [lbf] push across the bolt; >= 0

    GRADES = {
        "SAE 5": Grade(92 * ksi, 120 * ksi),
        "SAE 8": Grade(130 * ksi, 150 * ksi),
        "8.8": Grade(640 * MPa, 800 * MPa),
        "10.9": Grade(940 * MPa, 1040 * MPa),
    }
    PARTS = {
        "steel": Part(29700 * ksi, 110 * ksi),
        "grey cast iron": Part(16000 * ksi, 123 * ksi),
        "aluminium": Part(10300 * ksi, 52 * ksi),
    }
    TOOLS = {"torque wrench": Tool(1.6), "turn of the nut": Tool(1.2), "impact wrench": Tool(2.5)}


@app.cell(hide_code=True)
def title():
    title_block(
        "Bolted joint",
        """
    One bolt of a flange with a gasket, preloaded: deformation of bolt and parts, tightening torque, and in every load
    case the force in the bolt and what is left to clamp the gasket. The gasket grows stiffer as it is pressed, and the
    joint may open, so force and gap are found together from two equations. After the spring model of VDI 2230, in
    inches and pounds.
    """,
    )
    return


@app.cell(hide_code=True)
def verdict(checks_joint, checks_strength, cone, high_c, low_c, slope):
    summary(checks_strength, checks_joint, low_c, high_c, cone, slope)
    return


@app.cell(hide_code=True)
def section_1():
    mo.md(r"""
    ## 1 Input data

    Lengths are those of the joint as it is drawn below. The gasket was pressed in a test with the force $F_\mathrm{G}$
    by $x_\mathrm{G}$; its force grows with the square of that.
    """)
    return


@app.class_definition
@inputs
class Joint:
    # 1.1 Bolt
    grade: Grade = one_of(GRADES, "SAE 8")  # grade of the bolt
    d: float = 1 / 2 * inch  # [inch] diameter; > 0 < d_h
    P: float = inch / 13  # [inch] pitch of the thread; > 0
    l_1: float = 0.75 * inch  # [inch] shank without thread; > 0 < l_K
    d_w: float = 0.75 * inch  # [inch] seat of head and nut, outside; > d_h
    E_S: float = 29700 * ksi  # [ksi] Young's modulus; > 0

    # 1.2 Parts
    part: Part = one_of(PARTS, "steel")  # material of the flanges
    l_K: float = 1.5 * inch  # [inch] thickness of both flanges; > 0
    d_h: float = 17 / 32 * inch  # [inch] hole; > 0
    D_A: float = 1.5 * inch  # [inch] diameter of the flanges round the bolt; > d_w
    F_G: float = 9000 * lbf  # [lbf] force on the gasket in the test; > 0
    x_G: float = 4 * mil  # [mil] compression of the gasket in the test; > 0
    mu_T: float = 0.3  # [-] friction at the gasket; > 0

    # 1.3 Tightening
    tool: Tool = one_of(TOOLS, "torque wrench")  # how it is tightened
    nu: float = 0.9  # [-] use of the yield strength; > 0 <= 1
    mu_G: float = 0.12  # [-] friction in the thread; >= 0
    mu_K: float = 0.12  # [-] friction under the head; >= 0
    f_Z: float = 0.3 * mil  # [mil] embedding; >= 0

    # 1.4 Load cases
    cases: list[Case] = [
        Case(0 * lbf, 300 * lbf),
        Case(1500 * lbf, 600 * lbf),
        Case(2500 * lbf, 400 * lbf),
        Case(3000 * lbf, 0 * lbf),
    ]  # loads on one bolt

    """After # stand the unit and the meaning, after ; the limits."""


@app.cell
def form():
    form = ask(Joint)
    form
    return (form,)


@app.cell
def given(form):
    g = read(Joint, form)
    Used(g)
    return (g,)


@app.cell
def loaded():
    case = slider(0, 1, step=0.01, value=0.6, label="part of the greatest load")
    case
    return (case,)


@app.cell
def scheme():
    def scheme(g, F):
        """Joint to scale, with a load."""
        bolt, seat, hole, flange = g.d / 2, g.d_w / 2, g.d_h / 2, g.D_A / 2  # radii
        half, gasket, head = g.l_K / 2, 4 * g.x_G, 0.65 * g.d  # heights; the gasket's for the picture only

        def box(x0, y0, x1, y1):
            return [x0 + 1j * y0, x1 + 1j * y0, x1 + 1j * y1, x0 + 1j * y1]

        corner = 1.7 * flange + 1j * (half + 2.4 * head)
        drawn = Drawing(width=700, height=420, frame=[-corner, corner])
        for side in (-1, 1):
            edge = side * hole, side * flange
            drawn = drawn.polygon(box(edge[0], gasket, edge[1], half)).polygon(box(edge[0], -half, edge[1], -gasket))
            drawn = drawn.polygon(box(edge[0], -gasket, edge[1], gasket), colour="red")
            drawn = drawn.arrow(edge[1] + 1j * half, 0.5j * F / lbf, "F_A", "lbf", "red")
            drawn = drawn.arrow(edge[1] - 1j * half, -0.5j * F / lbf, "", "lbf", "red")
        drawn = drawn.polygon(box(-bolt, -half - 1.6 * head, bolt, half)).polygon(box(-seat, half, seat, half + head))
        drawn = drawn.polygon(box(-seat, -half - head, seat, -half))
        drawn = drawn.dimension(-flange - 1j * half, -flange + 1j * half, "l_K", 40)
        foot = -1j * (half + 1.6 * head)
        return drawn.dimension(-bolt + foot, bolt + foot, "d", -20)

    return (scheme,)


@app.cell
def drawing_11(case, g, scheme):
    drawing_11 = scheme(g, case.value * g.cases.F_A.max())
    typeset(drawing_11, caption("1.1", "Joint and half of the load on either side; the gasket is red, not to scale"))
    return


@app.cell(hide_code=True)
def section_2():
    mo.md(r"""
    ## 2 Bolt and parts as springs

    The head and the nut give way as 0.4 to 0.5 diameters of the shank more would. The flanges are pressed in a cone
    from each seat, which ends at their diameter $D_\mathrm{A}$ where that is small.
    """)
    return


@app.cell
def springs(g):
    d_2 = g.d - 0.649519 * g.P  # [inch] pitch diameter
    d_3 = g.d - 1.226869 * g.P  # [inch] core diameter
    d_s = g.d - 0.9743 * g.P  # [inch] diameter of the stress area
    A_s = pi * d_s**2 / 4  # [inch**2] stress area
    delta_S = 4 / (pi * g.E_S) * ((0.9 * g.d + g.l_1) / g.d**2 + (0.5 * g.d + g.l_K - g.l_1) / d_3**2)  # [mil/lbf] bolt
    t = 0.362 + 0.032 * log(g.l_K / (2 * g.d_w)) + 0.153 * log(g.D_A / g.d_w)  # [-] tangent of the cone's angle
    D_K = minimum(g.D_A, g.d_w + g.l_K * t)  # [inch] greatest diameter of the cones
    l_H = g.l_K - (D_K - g.d_w) / t  # [inch] length between the cones
    delta_P = (
        2 / (g.d_h * t) * log((g.d_w + g.d_h) * (D_K - g.d_h) / ((g.d_w - g.d_h) * (D_K + g.d_h)))
        + 4 * l_H / (D_K**2 - g.d_h**2)
    ) / (pi * g.part.E)  # [mil/lbf] flanges
    c = g.F_G / g.x_G**2  # [lbf/mil**2] gasket
    F_K = lambda x: c * maximum(x, 0) ** 2  # [lbf] force that clamps, by the compression x of the gasket
    typeset()
    return A_s, D_K, F_K, c, d_2, d_s, delta_P, delta_S, t


@app.cell
def cones(D_K, delta_P, g, t):
    z = linspace(0, g.l_K / 2, 201)  # [inch] from the seat to the middle
    A_z = pi / 4 * (minimum(g.d_w + 2 * z * t, D_K) ** 2 - g.d_h**2)  # [inch**2] what is pressed there
    delta_z = 2 * trapezoid(1 / A_z, z) / g.part.E  # [mil/lbf] flanges, slice by slice
    cone = check("flanges slice by slice", delta_z - delta_P, 1e-3, "mil/lbf", of=delta_P)
    typeset(cone)
    return (cone,)


@app.cell(hide_code=True)
def section_3():
    mo.md(r"""
    ## 3 Tightening

    Pull and torsion of the thread together use the part $\nu$ of the yield strength at the greatest preload. The least
    one is smaller by the scatter of the tool, and embedding takes its part of what bolt and parts are stretched.
    """)
    return


@app.cell
def preload(A_s, c, d_2, d_s, delta_P, delta_S, g):
    k_t = 3 * d_2 / (2 * d_s) * (g.P / (pi * d_2) + 1.155 * g.mu_G)  # [-] torsion to pull
    F_M = g.nu * g.grade.R_p * A_s / sqrt(1 + 3 * k_t**2)  # [lbf] greatest preload
    D_m = (g.d_w + g.d_h) / 2  # [inch] middle of the seat
    M_A = F_M * (g.P / (2 * pi) + 1.155 * g.mu_G * d_2 / 2 + g.mu_K * D_m / 2)  # [lbf*ft] tightening torque
    F_M0 = F_M / g.tool.alpha  # [lbf] least preload
    u_0 = (delta_S + delta_P) * F_M0 + sqrt(F_M0 / c) - g.f_Z  # [mil] bolt and parts, least preload
    u_1 = (delta_S + delta_P) * F_M + sqrt(F_M / c)  # [mil] bolt and parts, greatest preload
    typeset()
    return F_M, F_M0, k_t, u_0, u_1


@app.cell(hide_code=True)
def section_4():
    mo.md(r"""
    ## 4 Load cases

    Bolt force $F_\mathrm{S}$ and compression $x$ of the gasket in every load case, by two equations: equilibrium, and
    the stretch $u$ that tightening has left. Where $x$ is negative the joint is open by as much. The load acts at the
    seats.

    ### 4.1 Least preload
    """)
    return


@app.cell
def low(F_K, F_M0, c, delta_P, delta_S, g, u_0):
    low_found = find(
        lambda F_S0, x_0: (F_S0 - F_K(x_0), delta_S * F_S0 + delta_P * F_K(x_0) + x_0),
        equals=(g.cases.F_A, u_0),
        unit=("lbf", "mil"),
        unknown_unit=("lbf", "mil"),
        F_S0=F_M0,
        x_0=sqrt(F_M0 / c),
    )
    F_S0 = low_found.value.F_S0  # [lbf] bolt
    x_0 = low_found.value.x_0  # [mil] gasket
    F_K0 = F_K(x_0)  # [lbf] what clamps
    k_u = (delta_S + delta_P) * c  # [1/mil] of the quadratic equation for x
    b_0 = u_0 - delta_S * g.cases.F_A  # [mil] what the load leaves of the stretch
    x_0c = where(b_0 > 0, 2 * b_0 / (1 + sqrt(1 + 4 * k_u * maximum(b_0, 0))), b_0)  # [mil] its solution
    low_c = closed_form(low_found, F_S0=g.cases.F_A + F_K(x_0c), x_0=x_0c)
    typeset(low_found, *low_c)
    return F_K0, F_S0, k_u, low_c, x_0


@app.cell(hide_code=True)
def section_42():
    mo.md("""
    ### 4.2 Greatest preload
    """)
    return


@app.cell
def high(F_K, F_M, c, delta_P, delta_S, g, k_u, u_1):
    high_found = find(
        lambda F_S1, x_1: (F_S1 - F_K(x_1), delta_S * F_S1 + delta_P * F_K(x_1) + x_1),
        equals=(g.cases.F_A, u_1),
        unit=("lbf", "mil"),
        unknown_unit=("lbf", "mil"),
        F_S1=F_M,
        x_1=sqrt(F_M / c),
    )
    F_S1 = high_found.value.F_S1  # [lbf] bolt
    x_1 = high_found.value.x_1  # [mil] gasket
    b_1 = u_1 - delta_S * g.cases.F_A  # [mil] what the load leaves of the stretch
    x_1c = where(b_1 > 0, 2 * b_1 / (1 + sqrt(1 + 4 * k_u * maximum(b_1, 0))), b_1)  # [mil] in closed form
    high_c = closed_form(high_found, F_S1=g.cases.F_A + F_K(x_1c), x_1=x_1c)
    typeset(high_found, *high_c)
    return F_S1, high_c


@app.cell(hide_code=True)
def section_43():
    mo.md(r"""
    ### 4.3 Strength

    In service half of the torsion is left. The bolt swings between the load cases.
    """)
    return


@app.cell
def strength(A_s, F_K0, F_S1, g, k_t, F_M):
    sigma = F_S1 / A_s  # [ksi] pull
    tau = k_t * F_M / A_s  # [ksi] torsion when tightened
    sigma_r = sqrt(sigma**2 + 3 * (tau / 2) ** 2)  # [ksi] both
    S_F = g.grade.R_p / sigma_r  # [-] safety against yield
    sigma_a = (F_S1.max() - F_S1.min()) / (2 * A_s)  # [ksi] amplitude
    sigma_A = 0.85 * (150 * mm / g.d + 45) * MPa  # [ksi] amplitude that a rolled thread bears
    p_K = F_S1.max() / (pi / 4 * (g.d_w**2 - g.d_h**2))  # [ksi] pressure under the head
    F_R = g.cases.F_Q / g.mu_T  # [lbf] what must clamp against slip
    checks_strength = (
        check("pull and torsion", sigma_r, g.grade.R_p, "ksi"),
        check("amplitude of the stress", sigma_a, sigma_A, "ksi"),
        check("pressure under the head", p_K, g.part.p_G, "ksi"),
        check("grip at the gasket: F_K0 less F_R", F_K0 - F_R, at_least=0, unit="lbf"),
    )
    typeset(*checks_strength)
    return F_R, S_F, checks_strength, sigma_r


@app.cell
def results_4(F_K0, F_R, F_S0, F_S1, S_F, g, sigma_r, x_0):
    F_A = g.cases.F_A  # [lbf] pull along the bolt
    F_Q = g.cases.F_Q  # [lbf] push across the bolt
    table_41 = table("4.1", "Load cases", F_A, F_Q, F_S0, F_K0, x_0, F_R, F_S1, sigma_r, S_F)
    typeset(table_41)
    return


@app.cell(hide_code=True)
def section_5():
    mo.md(r"""
    ## 5 Joint under a growing load

    With the least preload. The joint opens at the load $F_\mathrm{o}$, which stretches the bolt alone by all of $u_0$;
    from there on the bolt bears the load alone. Before, its force grows by the part $\Phi$ of the load, which is less
    the stiffer the gasket is pressed.
    """)
    return


@app.cell
def growing(F_K, F_M0, c, delta_P, delta_S, k_u, u_0):
    F_o = u_0 / delta_S  # [lbf] load at which the joint opens
    F = linspace(0, 1.5 * F_o, 61)  # [lbf] load
    grow_found = find(
        lambda F_SF, x_F: (F_SF - F_K(x_F), delta_S * F_SF + delta_P * F_K(x_F) + x_F),
        equals=(F, u_0),
        unit=("lbf", "mil"),
        unknown_unit=("lbf", "mil"),
        F_SF=F_M0,
        x_F=sqrt(F_M0 / c),
    )
    F_SF = grow_found.value.F_SF  # [lbf] bolt
    x_F = grow_found.value.x_F  # [mil] gasket
    F_KF = F_K(x_F)  # [lbf] what clamps
    h_F = maximum(-x_F, 0)  # [mil] gap
    b_F = u_0 - delta_S * F  # [mil] what the load leaves of the stretch
    x_Fc = where(b_F > 0, 2 * b_F / (1 + sqrt(1 + 4 * k_u * maximum(b_F, 0))), b_F)  # [mil] in closed form
    grow_c = closed_form(grow_found, F_SF=F + F_K(x_Fc), x_F=x_Fc)
    typeset(grow_found, *grow_c)
    return F, F_KF, F_SF, F_o, grow_c, h_F, x_F


@app.cell
def compared(F, F_K, F_SF, F_o, c, delta_P, delta_S, grow_c, h_F, k_u, u_0, x_F):
    x_F0 = lambda F: (
        2 * (u_0 - delta_S * F) / (1 + sqrt(maximum(1 + 4 * k_u * (u_0 - delta_S * F), 0)))
    )  # [mil] while it is shut
    delta_T = lambda x: delta_P + 1 / (2 * c * x)  # [mil/lbf] flanges and gasket, for a little more
    Phi = lambda F: delta_T(x_F0(F)) / (delta_S + delta_T(x_F0(F)))  # [-] part of the load that the bolt takes
    F_t = linspace(0, 0.9 * F_o, 10)  # [lbf] loads
    Phi_t = Phi(F_t)  # [-] part of the load that the bolt takes
    slope = check_slope(
        "Phi is the slope of the bolt force", Phi_t, lambda F: F + F_K(x_F0(F)), F_t, 0, 0.95 * F_o, "-"
    )
    checks_joint = (
        *grow_c,
        check("open, the bolt bears the load", where(x_F < 0, F_SF - F, 0), 1e-9, "lbf", of=F),
        check("open, the gap is the bolt's stretch", where(x_F < 0, delta_S * F - u_0 - h_F, 0), 1e-9, "mil", of=u_0),
    )
    typeset(slope, *checks_joint[2:])
    return Phi_t, F_t, checks_joint, slope


@app.cell
def results_5(F, F_KF, F_M0, F_SF, F_o, F_t, Phi_t, h_F):
    figure_51 = figure("5.1", "Forces under a growing load", F, F_SF, F_KF, marks={"F_o": F_o})
    figure_52 = figure("5.2", "Gap", F, h_F, marks={"F_o": F_o})
    table_51 = table("5.1", "Part of the load that the bolt takes", F_t, Phi_t)
    typeset(figure_51, figure_52, table_51)
    return


@app.cell(hide_code=True)
def section_51():
    mo.md(r"""
    ### 5.1 Joint diagram

    Over the bolt's stretch: the force of the bolt, and that of the parts, which is nothing where the bolt has taken all
    of $u_0$. They meet at the preload that embedding has left.
    """)
    return


@app.cell
def diagram(c, delta_P, delta_S, u_0):
    f = linspace(0, u_0, 41)  # [mil] stretch of the bolt
    F_f = f / delta_S  # [lbf] bolt
    F_p = (2 * (u_0 - f) / (1 / sqrt(c) + sqrt(maximum(1 / c + 4 * delta_P * (u_0 - f), 0)))) ** 2  # [lbf] parts
    typeset()
    return F_f, F_p, f


@app.cell
def results_51(F_f, F_p, f):
    figure_53 = figure("5.3", "Joint diagram", f, F_f, F_p)
    figure_53
    return


@app.cell
def workbook():
    export("Bolted joint", globals())
    return


if __name__ == "__main__":
    app.run()
