import marimo

__generated_with = "0.25.1"
app = marimo.App(width="medium", app_title="Excavator bucket", css_file="../page.css")

with app.setup:
    import marimo as mo
    from numpy import abs, exp, linspace, pi

    from mechsheet import (
        Drawing, Load, RRRGroup, Used, angle, ask, assembled, caption, check, closed_form, cylinder_drive, dot, export,
        figure, find, inputs, mark, player, read, rrr, rrr_reach, slider, summary, table, title_block, typeset,
    )  # fmt: skip


@app.cell(hide_code=True)
def title():
    title_block(
        "Excavator bucket",
        """
    The cylinder AB turns the rocker CB about its hinge C on the arm; the link BE carries the motion on to the bucket,
    which turns about the hinge D at the arm's end. Wanted are the link BE with which the bucket opens as far as it
    shall, the force at its teeth over the stroke, and the forces in the pins.
    """,
    )
    return


@app.cell(hide_code=True)
def verdict(checks_forces, checks_pins, closing_1, closing_2, link_c):
    summary(closing_1, link_c, closing_2, checks_forces, checks_pins)
    return


@app.cell(hide_code=True)
def section_1():
    mo.md("""
    ## 1 Input data

    The axes are those of the arm: from the hinge D of the bucket, x runs away from the machine along the arm, y from
    the arm to the side of its cylinder. Angles count counter-clockwise, so the bucket closes as they fall.
    """)
    return


@app.class_definition
@inputs
class Bucket:
    # 1.1 Hinges on the arm
    X_A: float = -2.15  # [m] hinge of the cylinder, along the arm; ± 0.002
    Y_A: float = 0.62  # [m] hinge of the cylinder, across the arm; ± 0.002
    X_C: float = -0.42  # [m] hinge of the rocker, along the arm; ± 0.001
    Y_C: float = 0.06  # [m] hinge of the rocker, across the arm; ± 0.001

    # 1.2 Links
    L_CB: float = 0.62  # [m] rocker; > 0; ± 0.001
    L_DE: float = 0.46  # [m] bucket from its hinge D to the pin E; > 0; ± 0.001
    L_DT: float = 1.45  # [m] bucket from its hinge D to the teeth; > 0; ± 0.005
    delta_T: float = 105 * pi / 180  # [deg] angle from DT to DE at the bucket; > 0 < 180

    # 1.3 Cylinder
    S_min: float = 1.45  # [m] shortest length; > 0 < S_max
    S_max: float = 2.33  # [m] greatest length; > 0
    D_c: float = 0.12  # [mm] bore; > 0; ± 0.05
    p_c: float = 34.3e6  # [MPa] pressure; > 0; ± 3 %
    phi_open: float = 5 * pi / 180  # [deg] teeth with the shortest cylinder; > -90 < 90

    # 1.4 Load
    m: float = 950.0  # [kg] bucket and soil; >= 0; ± 10 % normal
    L_DS: float = 0.75  # [m] centre of mass from the hinge D; >= 0
    delta_S: float = 80 * pi / 180  # [deg] angle from DS to DE; >= 0 < 180
    g_n: float = 9.81  # [m/s**2] gravity, across the arm; >= 0

    # 1.5 Pins
    d_pin: float = 0.09  # [mm] diameter; > 0; ± 0.05
    b_pin: float = 0.1  # [mm] length in the bush; > 0; ± 0.5
    p_pin: float = 60e6  # [MPa] greatest bearing pressure; > 0

    # 1.6 Positions
    n: int = 12  # [-] parts of the stroke; >= 2 <= 200

    """After # stand the unit and the meaning, after ; the limits."""


@app.cell
def form():
    form = ask(Bucket)
    form
    return (form,)


@app.cell
def given(form):
    g = read(Bucket, form)
    Used(g)
    return (g,)


@app.cell(hide_code=True)
def section_2():
    mo.md("""
    ## 2 Positions

    ### 2.1 Hinges and the rocker
    """)
    return


@app.cell
def rocker(g):
    A = g.X_A + 1j * g.Y_A  # [m] hinge of the cylinder
    C = g.X_C + 1j * g.Y_C  # [m] hinge of the rocker
    B = lambda S: rrr(A, C, S, g.L_CB, +1)  # [m] pin of cylinder, rocker and link
    S = linspace(g.S_min, g.S_max, g.n + 1)  # [m] cylinder
    closing_1 = assembled("cylinder and rocker close", B(S), S, rrr_reach(A, C, g.L_CB), "cylinder S", "m")
    typeset(closing_1)
    return A, B, C, S, closing_1


@app.cell(hide_code=True)
def section_22():
    mo.md("""
    ### 2.2 Link BE

    With the shortest cylinder the teeth stand at the given angle.
    """)
    return


@app.cell
def find_link(B, g):
    B_0 = B(g.S_min)  # [m] pin with the shortest cylinder
    phi_T0 = lambda L, branch: angle(rrr(B_0, 0, L, g.L_DE, branch)) - g.delta_T  # [deg] teeth, by the length of BE
    link = find(
        phi_T0,
        *rrr_reach(B_0, 0, g.L_DE),
        equals=g.phi_open,
        branches=(+1, -1),
        branch=+1,
        unknown="link L_BE",
        quantity="angle of the teeth",
        unit="deg",
        unknown_unit="mm",
    )
    L_BE = link.value  # [mm] link BE
    link_c = closed_form(link, abs(g.L_DE * exp(1j * (g.phi_open + g.delta_T)) - B_0))
    typeset(link, link_c)
    return L_BE, link_c


@app.cell(hide_code=True)
def section_23():
    mo.md("""
    ### 2.3 Groups over the stroke
    """)
    return


@app.cell
def groups(A, C, L_BE, S, g):
    group_1 = RRRGroup(A, C, S, g.L_CB, +1)
    B_S = group_1.C  # [m] pin of cylinder, rocker and link
    group_2 = RRRGroup(B_S, 0, L_BE, g.L_DE, +1)
    E_S = group_2.C  # [m] pin of link and bucket
    phi_E = angle(E_S)  # [deg] bucket, from D to E
    phi_T = phi_E - g.delta_T  # [deg] bucket, from D to the teeth
    T_S = g.L_DT * exp(1j * phi_T)  # [m] teeth
    G_S = g.L_DS * exp(1j * (phi_E - g.delta_S))  # [m] centre of mass
    mu_1 = group_1.transmission_angle  # [deg] between cylinder and rocker
    mu_2 = group_2.transmission_angle  # [deg] between link and bucket
    closing_2 = assembled(
        "link and bucket close", E_S, abs(B_S), (abs(L_BE - g.L_DE), L_BE + g.L_DE), "distance D B", "m"
    )
    typeset(closing_2)
    return B_S, E_S, G_S, T_S, closing_2, group_1, group_2, mu_1, mu_2, phi_T


@app.cell
def results_2(S, T_S, mu_1, mu_2, phi_T):
    table_21 = table("2.1", "Positions", S, phi_T, T_S.real, T_S.imag, mu_1, mu_2)
    figure_21 = figure("2.1", "Angle of the teeth", S, phi_T)
    typeset(table_21, figure_21)
    return


@app.cell
def stroke():
    part = slider(0, 1, step=0.01, value=0.3, label="part of the stroke")
    player(part)
    return (part,)


@app.cell
def scheme(A, B, C, L_BE, T_S, g):
    def scheme(S):
        b = B(S)
        e = rrr(b, 0, L_BE, g.L_DE, +1)
        t, s = g.L_DT * exp(1j * (angle(e) - g.delta_T)), g.L_DS * exp(1j * (angle(e) - g.delta_S))
        links = Drawing(frame=[A, C, b, *T_S]).cylinder(A, b, "S", 0.9 * g.S_min)
        arms = links.link(C, b, "rocker").link(b, e, "link").plate([0, e, t], "bucket")
        bucket = arms.hinge(b, "B").hinge(e, "E").mass(s, "G").text(1.06 * t, "T")
        return bucket.support(A, "A").support(C, "C").support(0, "D", pi)

    still = scheme(g.S_min).faint() + scheme(g.S_max).faint() + Drawing().path(T_S)
    return scheme, still


@app.cell
def drawing_21(g, part, scheme, still):
    S_t = g.S_min * (1 - part.value) + g.S_max * part.value  # [m] cylinder as drawn
    drawing_21 = scheme(S_t) + still
    typeset(drawing_21, mark(S=S_t), caption("2.2", "Arm's end with bucket, in the axes of the arm"))
    return


@app.cell(hide_code=True)
def section_3():
    mo.md("""
    ## 3 Digging force

    The teeth are pushed across DT. Without friction the cylinder's power is that of teeth and weight.
    """)
    return


@app.cell
def digging(G_S, T_S, g, group_1, group_2):
    velocity_1 = group_1.velocity(dr_A=1)
    velocity_2 = group_2.velocity(velocity_1.v_C)
    dphi = velocity_2.omega_B  # [rad/m] turn of the bucket by the cylinder
    F_c = g.p_c * pi * g.D_c**2 / 4  # [kN] cylinder
    u = -1j * T_S / g.L_DT  # [-] direction in which the teeth move as the bucket closes
    W = -1j * g.m * g.g_n  # [kN] weight of bucket and soil
    F_T = (F_c + dot(W, 1j * dphi * G_S)) / (-dphi * g.L_DT)  # [kN] force of the teeth on the soil
    typeset()
    return F_T, F_c, W, dphi, u


@app.cell
def results_3(F_T, S, dphi):
    table_31 = table("3.1", "Force at the teeth", S, dphi, F_T)
    figure_31 = figure("3.1", "Force at the teeth", S, F_T)
    typeset(table_31, figure_31)
    return


@app.cell(hide_code=True)
def section_4():
    mo.md("""
    ## 4 Forces in the pins

    The groups are cut one by one, from the bucket to the cylinder. The force that comes out for the cylinder must be
    the one from which the digging force was got.
    """)
    return


@app.cell
def reactions(A, B_S, F_T, F_c, G_S, T_S, W, g, group_1, group_2, u):
    on_bucket = group_2.reactions([], [Load(-F_T * u, T_S), Load(W, G_S)])
    on_rocker = group_1.reactions([], [Load(-on_bucket.R_A, B_S)])
    R_D = on_bucket.R_B  # [kN] arm on the bucket
    R_E = on_bucket.R_C  # [kN] in the pin E
    R_C = on_rocker.R_B  # [kN] arm on the rocker
    F_back = cylinder_drive(A, B_S, on_rocker.R_C).F  # [kN] cylinder, from the reactions
    p_D = abs(R_D) / (g.d_pin * g.b_pin)  # [MPa] pressure in the bush D
    p_E = abs(R_E) / (g.d_pin * g.b_pin)  # [MPa] pressure in the bush E
    p_C = abs(R_C) / (g.d_pin * g.b_pin)  # [MPa] pressure in the bush C
    checks_forces = check("cylinder from the reactions", F_back - F_c, 1e-11, "N", of=F_c)
    checks_pins = (
        check("pressure in the bush D", p_D, g.p_pin, "MPa"),
        check("pressure in the bush E", p_E, g.p_pin, "MPa"),
        check("pressure in the bush C", p_C, g.p_pin, "MPa"),
    )
    typeset(checks_forces, *checks_pins)
    return R_C, R_D, R_E, checks_forces, checks_pins, p_C, p_D, p_E


@app.cell
def results_4(R_C, R_D, R_E, S, p_C, p_D, p_E):
    table_41 = table("4.1", "Forces in the pins", S, abs(R_C), abs(R_D), abs(R_E), p_C, p_D, p_E)
    figure_41 = figure("4.1", "Pressure in the bushes", S, p_C, p_D, p_E)
    typeset(table_41, figure_41)
    return


@app.cell
def workbook():
    export("Excavator bucket", globals())
    return


if __name__ == "__main__":
    app.run()
