import marimo

__generated_with = "0.25.1"
app = marimo.App(width="medium", app_title="Landing gear", css_file="page.css")

with app.setup:
    import marimo as mo
    import numpy as np
    from numpy import abs, arange, cos, exp, hypot, linspace, maximum, pi, sin, sqrt
    from numpy import arccos as acos
    from numpy import arcsin as asin
    from numpy import arctan2 as atan2

    from mechsheet import (
        Drawing, Load, SheetError, Used, angle, angle_opposite, ask, caption, check, check_slope, closed_form,
        cross, cylinder_drive, dot, export, figure, find, index, inertia, inputs, link_acceleration,
        link_velocity, mark, player, read, refuse, rrr, rrr_acceleration, rrr_condition, rrr_reactions,
        rrr_velocity, slider, summary, table, title_block, typeset,
    )  # fmt: skip
    from mechsheet.units import deg

    ulp = np.finfo(float).eps


@app.cell(hide_code=True)
def title():
    title_block(
        "Landing gear",
        """
    Synthesis by the pressure angle and kinematics of the lever mechanism that retracts a main leg, after the method
    for the computer course project of the Kuibyshev Aviation Institute (1982); then the choice of the retraction time
    and the forces. In brackets stand the numbers of the document's formulas, figures and
    appendices; the steps are those of its algorithm.

    The document prints no numbers: the dimensions, masses and areas below are ours, plausible for an airliner. No
    second machine of this kind was found that is published with its dimensions and results.
    """,
    )
    return


@app.cell(hide_code=True)
def verdict(checks_analogues, checks_ends, checks_forces, checks_least, checks_pressure, checks_time):
    summary(checks_pressure, checks_ends, checks_analogues, checks_least, checks_time, checks_forces)
    return


@app.cell(hide_code=True)
def section_1():
    mo.md(r"""
    ## 1 Initial data

    The leg 3 is a bell crank on the hinge $O_2$, the origin; the axis x points to the right, y upwards. The cylinder
    1, 2 on the hinge $O_1$ pushes its crank $O_2 A$ and lengthens: the leg, hanging at first, swings clockwise, to the
    side of $O_1$. The braces 4, 5 and the locks of figure 1 take no part in the calculation.
    """)
    return


@app.class_definition
@inputs
class LandingGear:
    # 1.1 Mechanism
    a: float = 0.20  # [m] cylinder hinge O1 above the leg hinge O2
    b: float = 1.20  # [m] cylinder hinge O1 to the left of O2
    l3: float = 0.30  # [m] crank O2 A; > 0
    theta: float = 85 * deg  # [deg] swing of the leg; > 0 < 180
    t_r: float = 8  # [s] retraction time; > 0
    R: int = 6  # [-] parts of the stroke; >= 1 <= 1000

    # 1.2 Choice of the retraction time
    t_a: float = 5  # [s] shortest time of the curves; > 0 < t_b
    t_b: float = 10  # [s] longest time of the curves; > 0
    eps_lim: float = 0.1  # [rad/s**2] permitted angular acceleration of the leg; > 0

    # 1.3 Leg with wheels
    m3: float = 950  # [kg] mass; >= 0
    r3: float = 2.1  # [m] O2 to the centre of mass; >= 0
    J3: float = 700  # [kg*m**2] moment of inertia about the centre of mass; >= 0
    l_w: float = 2.9  # [m] O2 to the axle; > 0
    r_w: float = 0.58  # [m] radius of the wheel; > 0

    # 1.4 Weight and air
    g_n: float = 9.81  # [m/s**2] acceleration of gravity; >= 0
    rho: float = 1.225  # [kg/m**3] density of the air; >= 0
    U: float = 80  # [m/s] airspeed along x, positive against the retraction
    C_w: float = 0.6  # [m**2] drag area of the wheels; >= 0
    C_s: float = 0.7  # [m**2] drag area of the strut, broadside on; >= 0

    """After # stand the unit and the meaning, after ; the limits; the page and the code take the same units."""


@app.cell
def form():
    form = ask(LandingGear)
    form
    return (form,)


@app.cell
def given(form):
    g = read(LandingGear, form)
    Used(g)
    return (g,)


@app.cell(hide_code=True)
def section_2():
    mo.md(r"""
    ## 2 Synthesis by the pressure angle

    The pressure angle $\alpha$ lies between the force along the rod and the velocity of $A$. It vanishes where the line
    $O_1 A$ touches the circle of $A$. The swing is laid off by halves to both sides of that position, so that $\alpha$
    is small and about equal at its two ends.

    ### Step 1: angle μ of the tangent position
    """)
    return


@app.cell
def step_1(g):
    O1 = -g.b + 1j * g.a  # [m] cylinder hinge
    O2 = 0j  # [m] leg hinge
    beta0 = atan2(g.b, g.a)  # [deg] (2)
    l12 = hypot(g.a, g.b)  # [m] (3) distance of the hinges O1, O2
    if np.any(g.l3 >= l12):
        refuse(SheetError(f"crank l3 = {g.l3} m must be shorter than the distance O1 O2 = {np.round(l12, 4)} m"))
    mu = acos(g.l3 / l12)  # [deg] (4) between O2 O1 and the crank that O1 A touches
    typeset()
    return O1, O2, beta0, l12, mu


@app.cell(hide_code=True)
def section_22():
    mo.md(r"""
    ### Step 2: mounting angle ψ

    $\psi$ lies between the leg and its crank. The crank passes no dead centre while its angle from $O_2 O_1$ stays
    between 0° and 180°.
    """)
    return


@app.cell
def step_2(beta0, g, mu):
    if np.any(g.theta >= 2 * mu):
        _swing, _limit = (np.round(x / deg, 12) for x in (g.theta, 2 * mu))
        refuse(
            SheetError(f"swing theta = {_swing} deg must be < 2 mu = {_limit} deg: the crank passes the dead centre")
        )
    gamma_0 = mu - g.theta / 2  # [deg] crank from O2 O1, extended
    gamma_n = mu + g.theta / 2  # [deg] crank from O2 O1, retracted
    psi = pi + mu - (beta0 + g.theta / 2)  # [deg] (5) mounting angle
    typeset()
    return gamma_0, gamma_n, psi


@app.cell(hide_code=True)
def section_23():
    mo.md(r"""
    ### Step 3: stroke H of the piston

    The law of cosines (7), (8) is written as the length of a difference of vectors, and the difference (6) in factors:
    the same numbers with their digits kept. In (6) the document prints $l_{O_2 A_0}$ for $l_{O_1 A_0}$.
    """)
    return


@app.cell
def step_3(g, gamma_0, gamma_n, l12, mu):
    l20 = abs(l12 - g.l3 * exp(1j * gamma_0))  # [m] (7) cylinder, extended leg
    l2n = abs(l12 - g.l3 * exp(1j * gamma_n))  # [m] (8) cylinder, retracted leg
    H = 4 * g.l3 * l12 * sin(mu) * sin(g.theta / 2) / (l2n + l20)  # [m] (6) stroke, l2n - l20
    if np.any(l20 - (l12 - g.l3) <= 4 * ulp * l12):  # the length of the cylinder no longer tells the crank's angle
        refuse(SheetError(f"swing theta = {np.round(g.theta / deg, 12)} deg begins at the dead centre of the crank"))
    typeset()
    return H, l20, l2n


@app.cell(hide_code=True)
def section_24():
    mo.md(r"""
    ### Pressure angles at both ends

    The angles of the synthesis are equal only in the limit of a short crank. They are exactly equal, and then
    $\theta/2$ whatever the lengths, where $O_1$ lies on the line through both end positions of $A$: the swing is then
    laid off about $\mu_\mathrm{eq}$ instead of $\mu$. No mounting angle makes the larger of the two smaller than that.
    """)
    return


@app.cell
def pressure_ends(g, gamma_0, gamma_n, l12, mu, psi):
    alpha_0 = atan2(cos(gamma_0) - g.l3 / l12, sin(gamma_0))  # [deg] pressure angle, extended
    alpha_n = atan2(cos(gamma_n) - g.l3 / l12, sin(gamma_n))  # [deg] pressure angle, retracted
    mu_eq = acos(g.l3 / l12 * cos(g.theta / 2))  # [deg] middle of the swing for equal pressure angles
    psi_eq = psi + mu_eq - mu  # [deg] mounting angle for equal pressure angles
    alpha_eq = atan2(cos(mu_eq - g.theta / 2) - g.l3 / l12, sin(mu_eq - g.theta / 2))  # [deg] both of them
    checks_pressure = (check("equal pressure angles are theta/2", alpha_eq - g.theta / 2, 1e-9, "deg", of=1),)
    typeset(*checks_pressure)
    return alpha_0, alpha_n, checks_pressure


@app.cell(hide_code=True)
def section_25():
    mo.md(r"""
    The drawing is to scale, the leg cut short. At both ends of the stroke the red line is the force along the rod, the
    green one the velocity of $A$; the stroke $H$ is what the arc about $O_1$ through $A_0$ leaves of $O_1
    A_\mathrm{n}$.
    """)
    return


@app.cell
def drawing_21(O1, O2, beta0, g, gamma_0, gamma_n, l20, mu, psi):
    _up = pi / 2 + beta0  # direction from O2 to O1
    _at = lambda gamma: O2 + g.l3 * exp(1j * (_up - gamma))
    _corner, _A0, _Ak, _An = O2 + 1j * g.a, _at(gamma_0), _at(mu), _at(gamma_n)
    _B0 = O2 + 2.2 * (_A0 - O2) * exp(1j * psi)
    _arc = lambda P, r, start, turn: P + r * exp(1j * (start + turn * linspace(0, 1, 61)))

    def _angled(drawing, P, r, start, turn, name):
        return drawing.path(_arc(P, r, start, turn), colour="").text(
            P + (r + 0.1 * g.l3) * exp(1j * (start + turn / 2)), name
        )

    def _pressure(drawing, A, name):
        force, velocity = (A - O1) / abs(A - O1), -1j * (A - O2) / g.l3
        drawing = drawing.path([A, A + 0.75 * g.l3 * force], colour="red")
        drawing = drawing.path([A, A + 0.75 * g.l3 * velocity], colour="green")
        return _angled(drawing, A, 0.42 * g.l3, angle(force), angle(velocity / force), name)

    synthesis = Drawing(width=820, height=620).path(_arc(O2, g.l3, 0, 2 * pi))
    for _line in ([O1, _corner], [_corner, O2], [O1, O2], [O1, _Ak], [O2, _Ak], [O1, _A0], [O1, _An]):
        synthesis = synthesis.path(_line, colour="")
    synthesis = synthesis.path(_arc(O1, l20, angle(_A0 - O1), angle((_An - O1) / (_A0 - O1))), colour="orange")
    synthesis = synthesis.link(O2, _A0, "l3").link(O2, _An).link(O2, _B0, "3")
    synthesis = synthesis.dimension(O1, _corner, "b").dimension(_corner, O2, "a", 18.0)
    synthesis = synthesis.dimension(O1 + l20 * exp(1j * angle(_An - O1)), _An, "H", 70.0)
    synthesis = _angled(synthesis, O2, 0.25 * g.l3, pi / 2, beta0, "β₀")
    synthesis = _angled(synthesis, O2, 0.45 * g.l3, _up, -mu, "μ")
    synthesis = _angled(synthesis, O2, 0.65 * g.l3, _up - gamma_0, -g.theta / 2, "θ/2")
    synthesis = _angled(synthesis, O2, 0.65 * g.l3, _up - mu, -g.theta / 2, "θ/2")
    synthesis = _angled(synthesis, O2, 0.55 * g.l3, _up - gamma_0, psi, "ψ")
    synthesis = _pressure(_pressure(synthesis, _A0, "α₀"), _An, "αₙ")
    pins = synthesis.hinge(_A0, "A0").hinge(_Ak, "Ak").hinge(_An, "An").hinge(_B0, "B0")
    drawing_21 = pins.support(O1, "O1", pi / 2).support(O2, "O2", 0.0)
    typeset(drawing_21, caption("2.1", "Synthesis by the pressure angle (figure 2)"))
    return


@app.cell(hide_code=True)
def section_3():
    mo.md(r"""
    ## 3 Analytical study

    ### Step 4: division of the stroke

    Each part takes the time $\Delta t = t_\mathrm{r} / R$, in which the rod moves by $V_{21} \Delta t = H / R$.
    """)
    return


@app.cell
def step_4(H, g, l20):
    i = arange(g.R + 1)  # [-] number of the position
    l2i = l20 + i / g.R * H  # [m] (9) cylinder, length O1 A
    typeset()
    return (l2i,)


@app.cell(hide_code=True)
def section_35():
    mo.md(r"""
    ### Steps 5 to 7: angles of cylinder and crank

    $\beta_2$ is the document's $\Delta\beta_i$, the angle at $O_1$ of the triangle $O_1 A O_2$: (27) in the form that
    keeps its digits. $\varphi_2$ is the direction from $A$ to $O_1$, $\varphi_3$ that from $O_2$ to $A$, and
    $\varphi_{32}$ the document's $\Delta\varphi$. The leg's angle is a function of the cylinder's length, which the
    loop gives:

    $$\varphi_3 = \varphi(l_2) \tag{10}$$

    $$\bar l_3 + \bar l_2 = \bar b + \bar a \tag{16}$$

    $$\begin{aligned} l_3 \cos\varphi_3 + l_2 \cos\varphi_2 &= -b \\
    l_3 \sin\varphi_3 + l_2 \sin\varphi_2 &= a \end{aligned} \tag{17}$$

    Formula (28) takes $\varphi_3$ from one projection of the loop (17), by the arcsine; one of the programs takes the
    arccosine. Each is right on one half of the circle only. Both projections together, $l_3 e^{i\varphi_3} = O_1 - l_2
    e^{i\varphi_2}$, give the two-argument arctangent; it is counted from the tangent position $\varphi_\mathrm{3k}$,
    from which the crank never turns as far as 90°.
    """)
    return


@app.cell
def steps_5_to_7(O1, beta0, g, l12, mu):
    phi3k = pi / 2 + beta0 - mu  # [deg] crank in the tangent position
    beta2 = lambda l2: angle_opposite(g.l3, l2, l12)  # [deg] (27) between O1 O2 and the cylinder
    phi2 = lambda l2: pi / 2 + beta0 + beta2(l2)  # [deg] (26) cylinder
    phi3 = lambda l2: phi3k + angle((O1 - l2 * exp(1j * phi2(l2))) / exp(1j * phi3k))  # [deg] (10), (16), (17) crank
    phi32 = lambda l2: phi3(l2) - phi2(l2)  # [deg] crank from the cylinder
    A = lambda l2: g.l3 * exp(1j * phi3(l2))  # [m] pin of the rod on the crank

    @np.errstate(invalid="ignore")  # rounding may take the sine beyond 1: no angle then
    def phi3_half(l2):
        return asin((g.a - l2 * sin(phi2(l2))) / g.l3)  # [deg] (28) as printed, half of the circle (erratum)

    typeset()
    return A, beta2, phi2, phi3, phi32, phi3_half


@app.cell
def angles(A, O1, O2, beta2, l2i, phi2, phi3, phi32, phi3_half):
    beta2i = beta2(l2i)  # [deg] between O1 O2 and the cylinder
    phi2i = phi2(l2i)  # [deg] cylinder
    phi3i = phi3(l2i)  # [deg] crank
    phi32i = phi32(l2i)  # [deg] crank from the cylinder
    phi3_printed = phi3_half(l2i)  # [deg] (28) as printed, half of the circle (erratum)
    Ai = A(l2i)  # [m] pin of the rod on the crank
    # limit of the checks: from positions to velocities the digits lost are twice those of the condition number
    lost = 32 * ulp * np.max(rrr_condition(O1, O2, Ai)) ** 2
    typeset()
    return Ai, beta2i, lost, phi2i, phi32i, phi3_printed, phi3i


@app.cell(hide_code=True)
def section_pressure():
    mo.md(r"""
    ### Pressure angle along the stroke

    The force on $A$ points away from $O_1$, the velocity of $A$ is square to the crank: $\alpha = \varphi_{32} + 90°$.
    It is zero at the tangent position, where the cylinder has the length $l_\mathrm{2k}$.
    """)
    return


@app.cell
def pressure(alpha_0, alpha_n, g, l12, lost, phi32i):
    alpha = phi32i + pi / 2  # [deg] pressure angle, positive before the tangent position
    l2k = sqrt((l12 - g.l3) * (l12 + g.l3))  # [m] cylinder in the tangent position
    checks_ends = (
        check("pressure angle, extended", alpha[..., :1] - alpha_0, lost, "deg", of=1),
        check("pressure angle, retracted", alpha[..., -1:] - alpha_n, lost, "deg", of=1),
    )
    typeset(*checks_ends)
    return alpha, checks_ends, l2k


@app.cell
def angles_shown(alpha, alpha_f, beta2i, every, l2f, l2i, l2k, phi2i, phi32i, phi3_printed, phi3i):
    table_31 = table(
        "3.1",
        "Angles",
        *(l2i, beta2i, phi2i, phi3i, phi32i, alpha, phi3_printed),
        note="phi3printed is formula (28) as printed: wrong wherever phi3 is outside -90..90 deg.",
    )
    figure_31 = figure("3.1", "Pressure angle", l2f, alpha_f, marks={"l2k": l2k}, every=every)
    typeset(table_31, figure_31)
    return


@app.cell(hide_code=True)
def section_scheme():
    mo.md("""
    ### Scheme of the landing gear

    Drawn to scale from the computed points; the slider moves it from the extended position to the retracted one, which
    are shown faintly.
    """)
    return


@app.cell
def leg(O2, g, phi3, psi):
    e3 = lambda l2: exp(1j * (phi3(l2) + psi))  # [-] direction of the leg
    W3 = lambda l2: O2 + g.l_w * e3(l2)  # [m] axle
    D3 = lambda l2: O2 + g.l_w / 2 * e3(l2)  # [m] middle of the strut
    S3 = lambda l2: O2 + g.r3 * e3(l2)  # [m] centre of mass of the leg
    typeset()
    return D3, S3, W3, e3


@app.cell
def scheme(A, H, O1, O2, W3, g, l20):
    path_A, path_w = (_P(l20 + linspace(0, 1, 61) * H) for _P in (A, W3))
    # to the right of O2 room for arrows
    frame = [O1, O2, O2 + g.l_w / 2, *path_A, *(_P + g.r_w * _d for _P in path_w for _d in (1, 1j, -1, -1j))]

    def scheme(l2):
        a, w = A(l2), W3(l2)
        links = Drawing(width=760, height=560, frame=frame).cylinder(O1, a, "l2").link(O2, a, "l3").link(O2, w, "3")
        return links.wheel(w, g.r_w).support(O1, "O1", pi / 2).support(O2, "O2", 0.0).hinge(a, "A")

    ends = scheme(l20).faint() + scheme(l20 + H).faint()
    paths = Drawing().path(path_A).path(path_w)
    return ends, paths, scheme


@app.cell
def stroke():
    part = slider(0, 1, step=0.01, value=0.3, label="part of the stroke")
    player(part)
    return (part,)


@app.cell
def drawing_32(H, ends, l20, part, paths, scheme):
    l2_t = l20 + part.value * H  # [m] cylinder as drawn
    drawing_32 = scheme(l2_t) + ends + paths
    typeset(drawing_32, mark(l2f=l2_t), caption("3.2", "Scheme of the landing gear (figure 1)"))
    return (l2_t,)


@app.cell(hide_code=True)
def section_38():
    mo.md(r"""
    ### Step 8: analogues of the angular velocities

    Derivatives with respect to $l_2$: the angular velocities per unit of the rod's speed.

    $$(\omega_j)_{l_2} = \frac{\mathrm{d}\varphi_j}{\mathrm{d}l_2}, \qquad
    (\varepsilon_j)_{l_2} = \frac{\mathrm{d}^2\varphi_j}{\mathrm{d}l_2^2} \tag{15}$$

    The loop (17), differentiated, then in axes turned by $\varphi_2$:

    $$\begin{aligned} -l_3 (\omega_3)_{l_2} \sin\varphi_3 - l_2 (\omega_2)_{l_2} \sin\varphi_2 +
    \cos\varphi_2 &= 0 \\ l_3 (\omega_3)_{l_2} \cos\varphi_3 + l_2 (\omega_2)_{l_2} \cos\varphi_2 +
    \sin\varphi_2 &= 0 \end{aligned} \tag{18}$$

    $$\begin{aligned} -l_3 (\omega_3)_{l_2} \sin(\varphi_3 - \varphi_2) + 1 &= 0 \\
    l_3 (\omega_3)_{l_2} \cos(\varphi_3 - \varphi_2) + l_2 (\omega_2)_{l_2} &= 0 \end{aligned} \tag{19}$$
    """)
    return


@app.cell
def step_8(g, phi32):
    omega3_l2 = lambda l2: 1 / (g.l3 * sin(phi32(l2)))  # [rad/m] (15), (18)-(20) crank
    omega2_l2 = lambda l2: -(g.l3 * omega3_l2(l2) * cos(phi32(l2)) / l2)  # [rad/m] (15), (18), (19), (21) cylinder
    typeset()
    return omega2_l2, omega3_l2


@app.cell(hide_code=True)
def section_39():
    mo.md(r"""
    ### Step 9: analogues of the angular accelerations

    The equations (18), differentiated, then in the turned axes:

    $$\begin{aligned} -l_3 (\omega_3)_{l_2}^2 \cos\varphi_3 - l_3 (\varepsilon_3)_{l_2} \sin\varphi_3 -
    l_2 (\omega_2)_{l_2}^2 \cos\varphi_2 - l_2 (\varepsilon_2)_{l_2} \sin\varphi_2 -
    2 (\omega_2)_{l_2} \sin\varphi_2 &= 0 \\ -l_3 (\omega_3)_{l_2}^2 \sin\varphi_3 +
    l_3 (\varepsilon_3)_{l_2} \cos\varphi_3 - l_2 (\omega_2)_{l_2}^2 \sin\varphi_2 +
    l_2 (\varepsilon_2)_{l_2} \cos\varphi_2 + 2 (\omega_2)_{l_2} \cos\varphi_2 &= 0 \end{aligned} \tag{22}$$

    $$\begin{aligned} -l_3 (\omega_3)_{l_2}^2 \cos(\varphi_3 - \varphi_2) - l_3 (\varepsilon_3)_{l_2}
    \sin(\varphi_3 - \varphi_2) - l_2 (\omega_2)_{l_2}^2 &= 0 \\ -l_3 (\omega_3)_{l_2}^2
    \sin(\varphi_3 - \varphi_2) + l_3 (\varepsilon_3)_{l_2} \cos(\varphi_3 - \varphi_2) +
    2 (\omega_2)_{l_2} + l_2 (\varepsilon_2)_{l_2} &= 0 \end{aligned} \tag{23}$$

    From (23) the fraction (24) has a minus, which the document's print lacks; (25) takes its value and inherits the
    mistake with it. (24) is shown both ways.
    """)
    return


@app.cell
def step_9(g, omega2_l2, omega3_l2, phi32):
    def eps3_l2(l2):
        return -(
            (l2 * omega2_l2(l2) ** 2 + g.l3 * omega3_l2(l2) ** 2 * cos(phi32(l2))) / (g.l3 * sin(phi32(l2)))
        )  # [rad/m**2] (15), (22)-(24) crank

    def eps2_l2(l2):
        return (
            g.l3 * omega3_l2(l2) ** 2 * sin(phi32(l2)) - g.l3 * eps3_l2(l2) * cos(phi32(l2)) - 2 * omega2_l2(l2)
        ) / l2  # [rad/m**2] (15), (22), (23), (25) cylinder

    typeset()
    return eps2_l2, eps3_l2


@app.cell
def analogues(eps2_l2, eps3_l2, g, l2i, omega2_l2, omega3_l2, phi32i):
    omega3_l2i = omega3_l2(l2i)  # [rad/m] crank
    omega2_l2i = omega2_l2(l2i)  # [rad/m] cylinder
    eps3_l2i = eps3_l2(l2i)  # [rad/m**2] crank
    eps2_l2i = eps2_l2(l2i)  # [rad/m**2] cylinder
    eps3_printed = (l2i * omega2_l2i**2 + g.l3 * omega3_l2i**2 * cos(phi32i)) / (
        g.l3 * sin(phi32i)
    )  # [rad/m**2] (24) as printed, without the minus (erratum)
    typeset()
    return eps2_l2i, eps3_l2i, eps3_printed, omega2_l2i, omega3_l2i


@app.cell
def fine(H, eps2_l2, eps3_l2, g, l20, omega2_l2, omega3_l2, phi32):
    every = -(-60 // int(g.R))  # [-] small steps from row to row of the tables, 60 or more in all
    l2f = l20 + arange(every * g.R + 1) / (every * g.R) * H  # [m] cylinder, in small steps for the charts
    alpha_f = phi32(l2f) + pi / 2  # [deg] pressure angle, in small steps
    omega3_l2f = omega3_l2(l2f)  # [rad/m] crank, in small steps
    omega2_l2f = omega2_l2(l2f)  # [rad/m] cylinder, in small steps
    eps3_l2f = eps3_l2(l2f)  # [rad/m**2] crank, in small steps
    eps2_l2f = eps2_l2(l2f)  # [rad/m**2] cylinder, in small steps
    typeset()
    return alpha_f, eps2_l2f, eps3_l2f, every, l2f, omega2_l2f, omega3_l2f


@app.cell
def analogues_shown(
    eps2_l2f, eps2_l2i, eps3_l2f, eps3_l2i, eps3_printed, every, l2f, l2i, l2k, omega2_l2f, omega2_l2i, omega3_l2f,
    omega3_l2i,
):  # fmt: skip
    table_32 = table(
        "3.2",
        "Analogues",
        *(l2i, omega3_l2i, omega2_l2i, eps3_l2i, eps2_l2i, eps3_printed),
        note="eps3printed is formula (24) as printed: the sign is wrong.",
    )
    figure_33 = figure("3.3", "Velocity analogues", l2f, omega3_l2f, omega2_l2f, marks={"l2k": l2k}, every=every)
    figure_34 = figure("3.4", "Acceleration analogues", l2f, eps3_l2f, eps2_l2f, marks={"l2k": l2k}, every=every)
    typeset(table_32, figure_33, figure_34)
    return


@app.cell(hide_code=True)
def section_listings():
    mo.md(r"""
    ### The programs as printed (appendix 1, appendix 2)

    The Fortran listing has 3.14 for $\pi$, the arcsine (28), and `1/L3*SIN(DF)`, which multiplies by the sine that
    (20) divides by; its B is both the distance $b$ and an array. In (24) it has the minus.

    The other program, for the Promin-2, takes $\varphi_3$ from the projection on x by the arccosine, where its B is the
    abscissa of $O_1$: right on the upper half of the circle. It keeps (21) without the minus, to be read with the
    opposite sign, and goes on with that in (25). In its (24) the first term lacks $l_2$ and the second one the minus.

    Their numbers beside the right ones:
    """)
    return


@app.cell
def listings(O1, beta0, beta2i, g, l2i, mu, phi2i):
    psi_listing = 3.14 + mu - (beta0 + g.theta / 2)  # [deg] (5) as listed, 3.14 for pi (erratum)
    phi2_listing = 3.14 / 2 + beta0 + beta2i  # [deg] (26) as listed, 3.14 for pi (erratum)

    @np.errstate(invalid="ignore")  # rounding may take the sine beyond 1: no angle then
    def phi3_sine(l2, phi2):
        return asin((g.a - l2 * sin(phi2)) / g.l3)  # [deg] (28) (erratum)

    @np.errstate(invalid="ignore")
    def phi3_cosine(l2, phi2):
        return acos((O1.real - l2 * cos(phi2)) / g.l3)  # [deg] (17) by the arccosine (erratum)

    phi3_listing = phi3_sine(l2i, phi2_listing)  # [deg] (28) as listed (erratum)
    phi3_arccos = phi3_cosine(l2i, phi2i)  # [deg] (17) of the other program, half of the circle (erratum)
    phi32_listing = phi3_listing - phi2_listing  # [deg] as listed (erratum)
    omega3_listing = 1 / g.l3 * sin(phi32_listing)  # [rad/m] (20) as listed (erratum)
    omega2_listing = -(g.l3 * omega3_listing * cos(phi32_listing) / l2i)  # [rad/m] (21) as listed (erratum)
    eps3_listing = -(
        (l2i * omega2_listing**2 + g.l3 * omega3_listing**2 * cos(phi32_listing)) / (g.l3 * sin(phi32_listing))
    )  # [rad/m**2] (24) as listed, from these (erratum)
    phi32_promin = phi3_arccos - phi2i  # [deg] of the other program
    omega3_promin = 1 / (g.l3 * sin(phi32_promin))  # [rad/m] (20) of the other program
    omega2_promin = g.l3 * omega3_promin * cos(phi32_promin) / l2i  # [rad/m] (21) of the other program (erratum)
    eps3_promin = (g.l3 * omega3_promin**2 * cos(phi32_promin) - omega2_promin**2) / (
        g.l3 * sin(phi32_promin)
    )  # [rad/m**2] (24) of the other program (erratum)
    eps2_promin = (
        g.l3 * omega3_promin**2 * sin(phi32_promin) - g.l3 * eps3_promin * cos(phi32_promin) - 2 * omega2_promin
    ) / l2i  # [rad/m**2] (25) of the other program, from these (erratum)
    typeset()
    return (
        eps2_promin, eps3_listing, eps3_promin, omega2_listing, omega2_promin, omega3_listing, omega3_promin,
        phi2_listing, phi3_arccos, phi3_listing, psi_listing,
    )  # fmt: skip


@app.cell
def listings_shown(
    eps2_l2i, eps2_promin, eps3_l2i, eps3_listing, eps3_promin, l2i, omega2_l2i, omega2_listing, omega2_promin,
    omega3_l2i, omega3_listing, omega3_promin, phi2_listing, phi2i, phi3_arccos, phi3_listing, phi3i,
):  # fmt: skip
    table_34 = table(
        "3.4",
        "The programs' numbers",
        *(l2i, phi2i, phi2_listing, phi3i, phi3_listing, phi3_arccos),
        *(omega3_l2i, omega3_listing, omega3_promin, omega2_l2i, omega2_listing, omega2_promin),
        *(eps3_l2i, eps3_listing, eps3_promin, eps2_l2i, eps2_promin),
        note="The columns of the listing, of the arccosine and of Promin are as printed: wrong where they differ.",
    )
    table_34
    return


@app.cell(hide_code=True)
def section_310():
    mo.md(r"""
    ### Steps 10 and 11: speed of the rod and true values

    The pump's flow is constant, so is the speed of the rod. In (14) the document prints $V_{21}$ without its square:
    that is not an angular acceleration, as its unit shows; both programs have the square.
    """)
    return


@app.cell
def steps_10_11(H, eps2_l2i, eps3_l2i, g, omega2_l2i, omega3_l2i):
    V21 = H / g.t_r  # [m/s] (1) rod in the cylinder
    omega3i = V21 * omega3_l2i  # [rad/s] (11) crank
    eps3i = V21**2 * eps3_l2i  # [rad/s**2] (12) crank
    omega2i = V21 * omega2_l2i  # [rad/s] (13) cylinder
    eps2i = V21**2 * eps2_l2i  # [rad/s**2] (14) cylinder
    eps2_printed = V21 * eps2_l2i  # [rad/(m*s)] (14) as printed (erratum)
    typeset()
    return V21, eps2_printed, eps2i, eps3i, omega2i, omega3i


@app.cell(hide_code=True)
def section_312():
    mo.md(r"""
    ### Step 12: comparison with other methods

    Instead of graphs: the pin $A$ and the analogues by the general solution for a group of two links, one of which
    lengthens, and the slopes of $\varphi_3$, $\varphi_2$ and of their analogues by differences. The nearer a dead
    centre, the more digits are lost, which the limits allow for.
    """)
    return


@app.cell
def step_12(
    Ai, H, O1, O2, eps2_l2i, eps3_l2i, g, l12, l20, l2i, l2n, lost, omega2_l2, omega2_l2i, omega3_l2, omega3_l2i, phi2,
    phi3,
):  # fmt: skip
    A_group = rrr(O1, O2, l2i, g.l3, +1)  # [m] pin A of the group
    v_group = rrr_velocity(O1, O2, A_group, dr_A=1)
    a_group = rrr_acceleration(O1, O2, A_group, v_group.omega_A, v_group.omega_B, dr_A=1)
    scale = np.max(abs([eps3_l2i, eps2_l2i, omega3_l2i**2]))
    checks_analogues = (
        check("stroke: l2n - l20 = H", l2n - l20 - H, 1e-12, "m", of=l12),
        check("pin A is that of the group", Ai - A_group, lost, "m", of=g.l3),
        check("omega3 is that of the group", v_group.omega_B / omega3_l2i - 1, lost, of=1),
        check("omega2 is that of the group", v_group.omega_A - omega2_l2i, lost, "rad/m", of=omega3_l2i),
        check("eps3 is that of the group", a_group.epsilon_B - eps3_l2i, lost, "rad/m**2", of=scale),
        check("eps2 is that of the group", a_group.epsilon_A - eps2_l2i, lost, "rad/m**2", of=scale),
        check_slope("omega3 is the slope of phi3", omega3_l2i, phi3, l2i, l20, l20 + H, "rad/m"),
        check_slope("omega2 is the slope of phi2", omega2_l2i, phi2, l2i, l20, l20 + H, "rad/m"),
        check_slope("eps3 is the slope of omega3", eps3_l2i, omega3_l2, l2i, l20, l20 + H, "rad/m**2"),
        check_slope("eps2 is the slope of omega2", eps2_l2i, omega2_l2, l2i, l20, l20 + H, "rad/m**2"),
    )
    typeset(*checks_analogues)
    return checks_analogues, scale


@app.cell(hide_code=True)
def section_algorithm():
    mo.md("""
    ### The algorithm with its numbers

    Of what the loop computes the least and the greatest are told, each with its position i.
    """)
    return


@app.cell
def drawing_35(
    H, V21, beta2i, eps2_l2i, eps2i, eps3_l2i, eps3i, g, l20, l2i, l2n, mu, omega2_l2i, omega2i, omega3_l2i, omega3i,
    phi2i, phi32i, phi3i, psi,
):  # fmt: skip
    _least = lambda x, unit: f"{np.min(x) / unit:.4g} … {np.max(x) / unit:.4g}".replace("-", "−")
    _ends = lambda x, shown, unit=1.0: f"{_least(x, unit)}{shown} at i = {np.argmin(x)}, {np.argmax(x)}"
    _steps = (
        ("data", f"a = {g.a:.4g} m, b = {g.b:.4g} m, l₃ = {g.l3:.4g} m, θ = {g.theta / deg:.4g}°, t = {g.t_r:.4g} s"),
        ("1", f"μ = {mu / deg:.4g}° by (4)"),
        ("2", f"ψ = {psi / deg:.4g}° by (5)"),
        ("3", f"l₂₀ = {l20:.4g} m, l₂ₙ = {l2n:.4g} m, H = {H:.4g} m by (7), (8), (6)"),
        ("10", f"V₂₁ = {V21:.4g} m/s by (1)"),
        ("4", f"for i = 0 … {g.R}: l₂ = {_ends(l2i, ' m')}, by (9)"),
        ("5", f"Δβ = {_ends(beta2i, '°', deg)}, by (27)"),
        ("6", f"φ₂ = {_ends(phi2i, '°', deg)}, by (26)"),
        ("6", f"φ₃ = {_ends(phi3i, '°', deg)}, by (17)"),
        ("7", f"Δφ = {_ends(phi32i, '°', deg)}"),
        ("8", f"dφ₃/dl₂ = {_ends(omega3_l2i, ' rad/m')}, by (20)"),
        ("8", f"dφ₂/dl₂ = {_ends(omega2_l2i, ' rad/m')}, by (21)"),
        ("9", f"d²φ₃/dl₂² = {_ends(eps3_l2i, ' rad/m²')}, by (24)"),
        ("9", f"d²φ₂/dl₂² = {_ends(eps2_l2i, ' rad/m²')}, by (25)"),
        ("11", f"ω₃ = {_ends(omega3i, ' rad/s')}, by (11)"),
        ("11", f"ω₂ = {_ends(omega2i, ' rad/s')}, by (13)"),
        ("11", f"ε₃ = {_ends(eps3i, ' rad/s²')}, by (12)"),
        ("11", f"ε₂ = {_ends(eps2i, ' rad/s²')}, by (14)"),
        ("", f"i = {g.R}?"),
        ("12", "print, and compare with other methods"),
    )
    chart = Drawing(width=860, height=1000, frame=[-6.1 + 0.3j, 6.5 - 1j * len(_steps) + 0.6j], unit="")
    for _n, (_step, _says) in enumerate(_steps):
        _at, _w, _h = -1j * _n, (6.0 if _step else 1.2), 0.32
        _box = [_at + _w * _x + 1j * _h * _y for _x, _y in ((-1, -1), (-1, 1), (1, 1), (1, -1))]
        _box = _box if _step else [_at - _w, _at + 1j * _h, _at + _w, _at - 1j * _h]
        chart = chart.polygon(_box).text(_at, f"{_step}  {_says}".strip())
        if _n:
            chart = chart.path([_at + 1j - 1j * _h, _at + 1j * _h], colour="")
    _loop, _back = (next(n for n, (step, _) in enumerate(_steps) if step == name) for name in ("4", ""))
    chart = chart.path([1.2 - 1j * _back, 6.4 - 1j * _back, 6.4 - 1j * _loop, 6.0 - 1j * _loop], colour="blue")
    drawing_35 = chart.text(2.2 + 0.25j - 1j * _back, "no, i + 1").text(0.4 + 0.5j - 1j * (_back + 1), "yes")
    typeset(drawing_35, caption("3.5", "Algorithm (figure 3)"))
    return


@app.cell(hide_code=True)
def section_4():
    mo.md("""
    ## 4 Results, as the Fortran program prints them
    """)
    return


@app.cell
def results(eps2_printed, eps2i, eps3i, l2i, omega2i, omega3i, phi3i, psi):
    table_41 = table("4.1", "Results of the calculation", psi, l2i, phi3i, omega3i, omega2i, eps3i, eps2i)
    table_42 = table(
        "4.2",
        "Formula (14) as printed and right",
        *(l2i, eps2i, eps2_printed),
        note="eps2printed is formula (14) as printed, with V21 not squared.",
    )
    typeset(table_41, table_42)
    return


@app.cell(hide_code=True)
def section_5():
    mo.md(r"""
    ## 5 Choice of the retraction time

    A short retraction saves fuel in the take-off but loads rod and piston. The document looks for the position of the
    least analogue $(\varepsilon_3)_{l_2}$ and draws $\varepsilon_3$ over $t$. In magnitude the least is zero, in the
    tangent position $l_\mathrm{2k}$, at part $p_\mathrm{k}$ of the stroke; what the limit must be kept against is the
    greatest. $(\omega_3)_{l_2}^{-2}$ is concave in $l_2$, so $|(\omega_3)_{l_2}|$ is convex, its slope grows from end
    to end, and the greatest $|(\varepsilon_3)_{l_2}|$ is at one of the ends.
    """)
    return


@app.cell
def least(H, eps3_l2, eps3_l2i, l20, l2k, lost, scale):
    p_k = (l2k - l20) / H  # [%] part of the stroke at which the analogue is least
    eps3_k = eps3_l2(l2k)  # [rad/m**2] least analogue, zero but for rounding
    eps3_m = maximum(abs(eps3_l2(l20)), abs(eps3_l2(l20 + H)))  # [rad/m**2] greatest analogue
    checks_least = (
        check("the analogue vanishes in the tangent position", eps3_k, lost, "rad/m**2", of=scale),
        check("the greatest is at an end", np.max(abs(eps3_l2i), axis=-1, keepdims=True) / eps3_m - 1, lost, of=1),
    )
    typeset(*checks_least)
    return checks_least, eps3_m


@app.cell
def curves(H, eps3_l2, g, l20):
    t = linspace(g.t_a, g.t_b, 11)  # [s] retraction time
    eps3_t = lambda t, p: (H / t) ** 2 * eps3_l2(l20 + p * H)  # [rad/s**2] (12) crank at part p of the stroke
    eps3_p0 = eps3_t(t, 0)  # [rad/s**2] extended
    eps3_p25 = eps3_t(t, 0.25)  # [rad/s**2] after 25 % of the stroke
    eps3_p75 = eps3_t(t, 0.75)  # [rad/s**2] after 75 %
    eps3_p100 = eps3_t(t, 1)  # [rad/s**2] retracted
    eps_max = g.eps_lim  # [rad/s**2] limit
    eps_min = -g.eps_lim  # [rad/s**2] limit in the other direction
    typeset()
    return eps3_p0, eps3_p100, eps3_p25, eps3_p75, eps_max, eps_min, t


@app.cell
def find_t_lim(H, eps3_m, g):
    eps3_g = lambda t: (H / t) ** 2 * eps3_m  # [rad/s**2] greatest angular acceleration of the leg in magnitude
    t_lim_found = find(
        eps3_g,
        equals=g.eps_lim,
        guess=g.t_r,
        unknown="retraction time t_lim",
        quantity="greatest angular acceleration eps3_g of the leg",
        unit="rad/s**2",
        unknown_unit="s",
    )
    t_lim = t_lim_found.value  # [s] shortest retraction time that keeps the limit
    typeset(t_lim_found)
    return t_lim, t_lim_found


@app.cell(hide_code=True)
def section_closed():
    mo.md(r"""
    $\varepsilon_3$ falls with the square of the time, so the time has a closed form too.
    """)
    return


@app.cell
def t_closed(H, eps3_l2i, eps3_m, eps3i, g, lost, t_lim, t_lim_found):
    t_c = H * sqrt(eps3_m / g.eps_lim)  # [s] the same time in closed form
    eps3_lim = (H / t_lim) ** 2 * eps3_l2i  # [rad/s**2] (12) crank at that time
    checks_time = (
        closed_form(t_lim_found, t_c),
        check("t_lim just keeps the limit", np.max(abs(eps3_lim), axis=-1, keepdims=True) / g.eps_lim - 1, lost, of=1),
        check("t_r keeps the limit", eps3i, g.eps_lim, "rad/s**2"),
    )
    typeset(*checks_time)
    return (checks_time,)


@app.cell
def curves_shown(eps3_p0, eps3_p100, eps3_p25, eps3_p75, eps_max, eps_min, t, t_lim):
    table_51 = table(
        "5.1",
        "Angular acceleration of the leg and retraction time",
        *(t, eps3_p0, eps3_p25, eps3_p75, eps3_p100),
        *(eps_max, eps_min),
    )
    figure_51 = figure(
        "5.1",
        "Angular acceleration of the leg over the retraction time",
        *(t, eps3_p0, eps3_p25, eps3_p75, eps3_p100, eps_max, eps_min),
        marks={"t_lim": t_lim},
    )
    typeset(table_51, figure_51)
    return


@app.cell(hide_code=True)
def section_6():
    mo.md(r"""
    ## 6 Forces and power

    Beyond the document. The leg swings in the plane of the flow, at the speed $V_{21}$ between the ends of the stroke;
    what starts and stops it there is left out, so are friction and the mass of the cylinder. On the leg act its weight
    and inertia at $S_3$, the drag of the wheels at the axle, and at the middle of the strut the drag of the flow across
    it; the leg's own speed is small beside the flow.
    """)
    return


@app.cell
def loads(D3, O2, S3, V21, W3, e3, eps3_l2, g, omega3_l2):
    q = g.rho * g.U * abs(g.U) / 2  # [Pa] dynamic pressure, with the sign of the flow
    G3 = -1j * g.m3 * g.g_n  # [N] weight of the leg, at S3
    Q_w = q * g.C_w  # [N] drag of the wheels, at the axle
    Q3 = lambda l2: -1j * q * g.C_s * e3(l2).imag * abs(e3(l2).imag) * e3(l2)  # [N] drag across the strut

    def a_S3(l2):
        return link_acceleration(
            S3(l2), O2, V21 * omega3_l2(l2), V21**2 * eps3_l2(l2)
        )  # [m/s**2] acceleration of the centre of mass

    I3 = lambda l2: inertia(S3(l2), g.m3, g.J3, a_S3(l2), V21**2 * eps3_l2(l2))
    acting = lambda l2: [Load(G3, S3(l2)), I3(l2), Load(Q_w, W3(l2)), Load(Q3(l2), D3(l2))]
    typeset()
    return G3, I3, Q3, Q_w, acting


@app.cell(hide_code=True)
def section_61():
    mo.md(r"""
    ### 6.1 Reactions of the group (2, 3)
    """)
    return


@app.cell
def reactions(A, Ai, O1, O2, acting, l2i):
    reactions = lambda l2: rrr_reactions(O1, O2, A(l2), [], acting(l2))
    thrust = lambda A, group: cylinder_drive(O1, A, group.R_C).F  # [N] fluid on the rod, positive where it pushes
    group_23 = reactions(l2i)
    R01 = group_23.R_A  # [N] frame on the cylinder, at O1
    R03 = group_23.R_B  # [N] frame on the leg 3, at O2
    R23 = -group_23.R_C  # [N] rod 2 on the leg 3, at A
    F_c = thrust(Ai, group_23)  # [N] fluid on the rod
    typeset()
    return F_c, R01, R03, R23, reactions, thrust


@app.cell(hide_code=True)
def section_62():
    mo.md(r"""
    ### 6.2 Shares of the loads, by virtual work

    Each load moves with the velocity analogue of its point; the work of the cylinder on $\mathrm{d}l_2$ is that against
    the loads.
    """)
    return


@app.cell
def shares(D3, F_c, G3, I3, O2, Q3, Q_w, S3, V21, W3, l2i, omega3_l2i):
    v_S3 = lambda l2, omega3: link_velocity(S3(l2), O2, omega3)  # [-] velocity analogue of the centre of mass
    v_W3 = lambda l2, omega3: link_velocity(W3(l2), O2, omega3)  # [-] of the axle
    v_D3 = lambda l2, omega3: link_velocity(D3(l2), O2, omega3)  # [-] of the middle of the strut
    weight = lambda l2, omega3: -dot(G3, v_S3(l2, omega3))  # [N] share of the weight
    drag = lambda l2, omega3: -dot(Q_w, v_W3(l2, omega3)) - dot(Q3(l2), v_D3(l2, omega3))  # [N] share of the drag

    def inertial(l2, omega3):
        load = I3(l2)
        return -dot(load.F, v_S3(l2, omega3)) - load.M * omega3  # [N] share of the inertia

    F_G = weight(l2i, omega3_l2i)  # [N] share of the weight
    F_Q = drag(l2i, omega3_l2i)  # [N] share of the drag
    F_I = inertial(l2i, omega3_l2i)  # [N] share of the inertia
    P_c = F_c * V21  # [kW] power of the cylinder
    typeset()
    return F_G, F_I, F_Q, P_c, drag, inertial, weight


@app.cell
def fine_shares(A, V21, drag, inertial, l2f, omega3_l2f, reactions, thrust, weight):
    F_cf = thrust(A(l2f), reactions(l2f))  # [N] fluid on the rod, in small steps
    F_Gf = weight(l2f, omega3_l2f)  # [N] share of the weight, in small steps
    F_Qf = drag(l2f, omega3_l2f)  # [N] share of the drag, in small steps
    F_If = inertial(l2f, omega3_l2f)  # [N] share of the inertia, in small steps
    P_cf = F_cf * V21  # [kW] power of the cylinder, in small steps
    typeset()
    return F_Gf, F_If, F_Qf, F_cf, P_cf


@app.cell(hide_code=True)
def section_63():
    mo.md(r"""
    ### 6.3 Check: equilibrium, virtual work, power

    The energy of the leg is differentiated numerically: its growth and the work against the drag are what the cylinder
    gives.
    """)
    return


@app.cell
def equilibrium(
    Ai, D3, F_G, F_I, F_Q, F_c, G3, H, I3, O1, Q3, Q_w, R01, R03, R23, S3, V21, W3, g, l20, l2i, lost, omega3_l2
):
    I3i = I3(l2i)
    F_in = I3i.F  # [N] inertia force of the leg, at S3
    M_in = I3i.M  # [N*m] inertia moment of the leg
    F3 = R03 + R23 + G3 + F_in + Q_w + Q3(l2i)  # [N] forces on the leg 3
    M3 = (
        cross(Ai, R23) + cross(S3(l2i), G3 + F_in) + M_in + cross(W3(l2i), Q_w) + cross(D3(l2i), Q3(l2i))
    )  # [N*m] moments on the leg 3 about O2
    M2 = cross(Ai - O1, R01)  # [N*m] moments on the cylinder about A
    E3 = lambda l2: (g.J3 + g.m3 * g.r3**2) * (V21 * omega3_l2(l2)) ** 2 / 2 + g.m3 * g.g_n * S3(l2).imag  # [J] energy
    largest = np.max(abs([R01, R03, R23]))
    checks_forces = (
        check("equilibrium of forces on the leg", F3, lost, "N", of=largest),
        check("equilibrium of moments on the leg", M3, lost, "N*m", of=largest * g.l_w),
        check("equilibrium of moments on the cylinder", M2, lost, "N*m", of=largest * g.l3),
        check("virtual work: the shares make the force", F_G + F_Q + F_I - F_c, lost, "N", of=largest),
        check_slope("power: what the drag leaves raises the leg", F_c - F_Q, E3, l2i, l20, l20 + H, "N"),
    )
    typeset(*checks_forces)
    return (checks_forces,)


@app.cell(hide_code=True)
def section_drawn():
    mo.md("""
    The forces at the position of the slider, the loads and the reactions each with their own scale.
    """)
    return


@app.cell
def drawings_61_62(A, D3, G3, I3, O2, Q3, Q_w, S3, W3, ends, l2_t, part, reactions, scheme):
    s3, at = S3(l2_t), reactions(l2_t)
    leg_t = scheme(l2_t).mass(s3, "S3") + ends
    at_mass = leg_t.force(s3, G3, "G3").force(s3, I3(l2_t).F, "F_in").moment(s3, I3(l2_t).M, "M_in")
    drawing_61 = at_mass.force(W3(l2_t), Q_w, "Q_w").force(D3(l2_t), Q3(l2_t), "Q3")
    drawing_62 = scheme(l2_t).force(A(l2_t), -at.R_C, "R23").force(O2, at.R_B, "R03")
    typeset(
        player(part),
        *(drawing_61, caption("6.1", "Loads on the leg")),
        *(drawing_62, caption("6.2", "Reactions on the leg")),
    )
    return


@app.cell
def forces_shown(F_G, F_Gf, F_I, F_If, F_Q, F_Qf, F_c, F_cf, P_c, P_cf, R01, R03, R23, every, l2f, l2i):
    table_61 = table(
        "6.1",
        "Forces and power",
        *(l2i, F_c, F_G, F_Q, F_I, P_c, abs(R03)),
        *(R03.real, R03.imag, R23.real, R23.imag, R01.real, R01.imag),
    )
    figure_63 = figure("6.3", "Force of the cylinder and its shares", l2f, F_cf, F_Gf, F_Qf, F_If, every=every)
    figure_64 = figure("6.4", "Power of the cylinder", l2f, P_cf, every=every)
    typeset(table_61, figure_63, figure_64)
    return


@app.cell(hide_code=True)
def listed():
    index()
    return


@app.cell
def workbook():
    export("Landing gear", globals())
    return


if __name__ == "__main__":
    app.run()
