import marimo

__generated_with = "0.25.1"
app = marimo.App(width="medium", app_title="Slotted link", css_file="page.css")

with app.setup:
    import marimo as mo
    import numpy as np
    from numpy import abs, arange, copysign, cos, exp, isfinite, linspace, minimum, nan, pi, sin, sqrt, where
    from numpy import arctan2 as atan2

    from mechsheet import (
        Check, Drawing, Used, angle, angle_between, ask, caption, check, dot, export, figure, find, index,
        inputs, mark, player, read, rpr, rpr_acceleration, rpr_velocity, slider, summary, table, title_block,
        typeset,
    )  # fmt: skip
    from mechsheet.units import deg

    ulp = np.finfo(float).eps


@app.cell(hide_code=True)
def title():
    title_block(
        "Slotted link",
        """
    Positions, velocities and accelerations of a quick-return mechanism: the pin A of the crank 1 carries a slider 2,
    which drives the slotted link 3 about the hinge B; the point C is on the link. First the six equations are solved
    at once, as the document does, then the same numbers follow in closed form.
    Change an input or a formula: everything below follows.
    """,
    )
    return


@app.cell(hide_code=True)
def verdict(checks_agreement, checks_equations, checks_found, checks_strokes):
    summary(checks_found, checks_agreement, checks_equations, checks_strokes)
    return


@app.cell(hide_code=True)
def section_1():
    mo.md("""
    ## 1 Input data

    Angles count counter-clockwise, so the sign of the crank's angular velocity is its sense of turning. Only a crank
    that turns clockwise gives the signs of the document's table, whose crank angles fall and whose link begins with a
    negative angular velocity. With the other sign all velocities change theirs, and no acceleration does.
    """)
    return


@app.class_definition
@inputs
class SlottedLink:
    # 1.1 Dimensions
    L1: float = 0.8  # [m] crank; > 0
    L3: float = 3.5  # [m] link 3 from its hinge B to the point C; > 0
    L0: float = 2.4  # [m] crank's hinge O1 above the link's hinge B; >= 0

    # 1.2 Motion of the crank
    omega1: float = -10  # [rad/s] angular velocity of the crank, negative clockwise
    phi_0: float = 360 * deg  # [deg] position of the crank at k = 0
    n: int = 6  # [-] steps of a full turn; >= 2 <= 360

    # 1.3 First approximations of Find
    phi3_0: float = 1.5  # [rad] angle of the link 3
    SAB_0: float = 2  # [m] slider's distance from B along the link; > 0
    omega3_0: float = 1  # [rad/s] angular velocity of the link 3
    VAB_0: float = 0.3  # [m/s] velocity of the slider along the link
    eps3_0: float = 11  # [rad/s**2] angular acceleration of the link 3
    WAB_0: float = 1  # [m/s**2] acceleration of the slider along the link

    """After # stand the unit and the meaning, after ; the limits; the page and the code take the same units."""


@app.cell
def form():
    form = ask(SlottedLink)
    form
    return (form,)


@app.cell
def given(form):
    g = read(SlottedLink, form)
    Used(g)
    return (g,)


@app.cell
def coordinate(g):
    dphi1 = copysign(2 * pi / g.n, g.omega1)  # [deg] step of the crank, in its sense of turning
    k = arange(g.n + 1)  # [-] number of the position
    phi1_k = g.phi_0 + k * dphi1  # [deg] crank
    typeset()
    return (phi1_k,)


@app.cell(hide_code=True)
def section_2():
    mo.md(r"""
    ## 2 The six equations

    The loop $B A O_1$ is projected on both axes and differentiated twice. Each equation stands as its residual, left
    side minus right side, which Find makes zero: what is typeset here is what is solved. The page at hand, 39, solves
    (2.33), (2.37) and (2.38); (2.34) to (2.36) stand before it and are not at hand.
    """)
    return


@app.cell
def equations(g):
    f1 = lambda phi1, phi3, SAB: SAB * cos(phi3) - g.L1 * cos(phi1)  # [m] (2.33) position, x
    f2 = lambda phi1, phi3, SAB: SAB * sin(phi3) - g.L0 - g.L1 * sin(phi1)  # [m] (2.33) position, y

    def f3(phi1, phi3, SAB, omega3, VAB):
        return VAB * cos(phi3) - SAB * sin(phi3) * omega3 + g.L1 * sin(phi1) * g.omega1  # [m/s] (2.37) velocity, x

    def f4(phi1, phi3, SAB, omega3, VAB):
        return VAB * sin(phi3) + SAB * cos(phi3) * omega3 - g.L1 * cos(phi1) * g.omega1  # [m/s] (2.37) velocity, y

    def f5(phi1, phi3, SAB, omega3, VAB, eps3, WAB):
        return (
            WAB * cos(phi3)
            - 2 * VAB * sin(phi3) * omega3
            - SAB * cos(phi3) * omega3**2
            - SAB * sin(phi3) * eps3
            + g.L1 * cos(phi1) * g.omega1**2
        )  # [m/s**2] (2.38) acceleration, x

    def f6(phi1, phi3, SAB, omega3, VAB, eps3, WAB):
        return (
            WAB * sin(phi3)
            + 2 * VAB * cos(phi3) * omega3
            - SAB * sin(phi3) * omega3**2
            + SAB * cos(phi3) * eps3
            + g.L1 * sin(phi1) * g.omega1**2
        )  # [m/s**2] (2.38) acceleration, y

    typeset()
    return f1, f2, f3, f4, f5, f6


@app.cell(hide_code=True)
def section_3():
    mo.md(r"""
    ## 3 Find (program of page 39)

    One Find solves all six equations for every position, from the same first approximations: by Newton's own steps,
    shortened to those that turn the link by no more than 45°, and in a trust region where twenty of them end in no
    root. An evaluation is one value of all six equations; their slopes take twelve of them a step.
    """)
    return


@app.cell
def system(f1, f2, f3, f4, f5, f6, g):
    def residuals(x, phi1):
        phi3, SAB, omega3, VAB, eps3, WAB = x
        position = f1(phi1, phi3, SAB), f2(phi1, phi3, SAB)
        velocity = f3(phi1, phi3, SAB, omega3, VAB), f4(phi1, phi3, SAB, omega3, VAB)
        acceleration = f5(phi1, phi3, SAB, omega3, VAB, eps3, WAB), f6(phi1, phi3, SAB, omega3, VAB, eps3, WAB)
        return np.array([*position, *velocity, *acceleration])

    guess = np.array([[g.phi3_0, g.SAB_0, g.omega3_0, g.VAB_0, g.eps3_0, g.WAB_0]]).T
    L, w = g.L0 + g.L1, abs(g.omega1)
    size = np.maximum(abs(guess), np.array([[1, L, w, L * w, w**2, L * w**2]]).T)
    units_x = ("deg", "m", "rad/s", "m/s", "rad/s**2", "m/s**2")
    units_f = ("m", "m", "m/s", "m/s", "m/s**2", "m/s**2")
    return residuals, size, units_f, units_x


@app.cell
def found(f1, f2, f3, f4, f5, f6, g, phi1_k, units_f, units_x):
    F_found = find(
        lambda phi3, SAB, omega3, VAB, eps3, WAB: (
            f1(phi1_k, phi3, SAB),
            f2(phi1_k, phi3, SAB),
            f3(phi1_k, phi3, SAB, omega3, VAB),
            f4(phi1_k, phi3, SAB, omega3, VAB),
            f5(phi1_k, phi3, SAB, omega3, VAB, eps3, WAB),
            f6(phi1_k, phi3, SAB, omega3, VAB, eps3, WAB),
        ),
        phi3=g.phi3_0,
        SAB=g.SAB_0,
        omega3=g.omega3_0,
        VAB=g.VAB_0,
        eps3=g.eps3_0,
        WAB=g.WAB_0,
        unit=units_f,
        unknown_unit=units_x,
    )
    phi3_F = F_found.value.phi3  # [deg] link 3, found
    SAB_F = F_found.value.SAB  # [m] slider from B along the link, found
    omega3_F = F_found.value.omega3  # [rad/s] angular velocity of the link 3, found
    VAB_F = F_found.value.VAB  # [m/s] velocity of the slider along the link, found
    eps3_F = F_found.value.eps3  # [rad/s**2] angular acceleration of the link 3, found
    WAB_F = F_found.value.WAB  # [m/s**2] acceleration of the slider along the link, found
    N_F = F_found.evaluations  # [-] evaluations of the six equations
    F = np.array([phi3_F, SAB_F, omega3_F, VAB_F, eps3_F, WAB_F])
    typeset(F_found)
    return F, F_found, N_F, SAB_F, VAB_F, WAB_F, eps3_F, omega3_F, phi3_F


@app.cell(hide_code=True)
def section_31():
    mo.md(r"""
    ### 3.1 Results of the program

    The velocity and the acceleration of C follow from what is found, in projections on the axes as after (2.38). The
    acceleration is the whole one, by its magnitude. Table 3 has these numbers, table 1 those of the closed form.
    """)
    return


@app.cell
def program(eps3_F, g, omega3_F, phi3_F):
    VCx_F = -g.L3 * sin(phi3_F) * omega3_F  # [m/s] velocity of C, x
    VCy_F = g.L3 * cos(phi3_F) * omega3_F  # [m/s] velocity of C, y
    WCx_F = -g.L3 * cos(phi3_F) * omega3_F**2 - g.L3 * sin(phi3_F) * eps3_F  # [m/s**2] acceleration of C, x
    WCy_F = -g.L3 * sin(phi3_F) * omega3_F**2 + g.L3 * cos(phi3_F) * eps3_F  # [m/s**2] acceleration of C, y
    VC_F = sqrt(VCx_F**2 + VCy_F**2)  # [m/s] velocity of C
    WC_F = sqrt(WCx_F**2 + WCy_F**2)  # [m/s**2] acceleration of C
    typeset()
    return VC_F, WC_F


@app.cell(hide_code=True)
def section_4():
    mo.md(r"""
    ## 4 Closed form

    Slider and slotted link are the Assur group of the third kind: with $u$ the direction of the link,

    $$u = \frac{A - B}{S_{AB}}, \qquad V_A = (\dot S_{AB} + i\,\omega\,S_{AB})\,u, \qquad
      W_A = \big(\ddot S_{AB} - \omega^2 S_{AB} + i\,(\varepsilon\,S_{AB} + 2\,\omega\,\dot S_{AB})\big)\,u,$$

    so that the position alone fixes $u$ and $S_\mathrm{AB}$, and the rest is linear. The link points from B to the
    slider, $S_\mathrm{AB} > 0$: that is the branch +1 of the group. Points are complex numbers $x + iy$ from B. The
    angle $\varphi_3$ is counted from $\varphi_\mathrm{s} = \pi/2$, or from the crank, $\varphi_\mathrm{s} = \varphi_1$,
    where the link goes round with it: so it never jumps by a turn.
    """)
    return


@app.cell
def crank(g):
    B = 0j  # [m] hinge of the link 3
    O1 = 1j * g.L0  # [m] hinge of the crank
    A = lambda phi1: O1 + g.L1 * exp(1j * phi1)  # [m] pin of the crank, with the slider
    VA = lambda phi1: 1j * g.omega1 * g.L1 * exp(1j * phi1)  # [m/s] velocity of A
    WA = lambda phi1: -(g.omega1**2) * g.L1 * exp(1j * phi1)  # [m/s**2] acceleration of A
    typeset()
    return A, B, O1, VA, WA


@app.cell
def group(A, B, VA, WA, g):
    block = lambda phi1: where(abs(A(phi1) - B) > 16 * ulp * (g.L0 + g.L1), A(phi1), nan)
    u = lambda phi1: rpr(block(phi1), B, +1).u  # [-] direction of the link 3

    def phi3(phi1):
        phi_s = where(g.L1 > g.L0, phi1, pi / 2)
        return phi_s + angle(u(phi1) * exp(-1j * phi_s))  # [deg] link 3

    SAB = lambda phi1: rpr(block(phi1), B, +1).s  # [m] slider from B along the link

    def omega_BC(phi1):
        return rpr_velocity(block(phi1), B, u(phi1), VA(phi1)).omega_A  # [rad/s] angular velocity of the link 3

    VAB = lambda phi1: rpr_velocity(block(phi1), B, u(phi1), VA(phi1)).ds  # [m/s] velocity of the slider along the link

    def eps_BC(phi1):
        rates = omega_BC(phi1), VAB(phi1)
        return rpr_acceleration(block(phi1), B, u(phi1), *rates, WA(phi1)).epsilon_A  # [rad/s**2] angular acceleration

    def WAB(phi1):
        rates = omega_BC(phi1), VAB(phi1)
        return rpr_acceleration(block(phi1), B, u(phi1), *rates, WA(phi1)).dds  # [m/s**2] sliding acceleration

    C = lambda phi1: B + g.L3 * u(phi1)  # [m] point C
    VC = lambda phi1: 1j * omega_BC(phi1) * g.L3 * u(phi1)  # [m/s] velocity of C
    WC = lambda phi1: (1j * eps_BC(phi1) - omega_BC(phi1) ** 2) * g.L3 * u(phi1)  # [m/s**2] acceleration of C
    typeset()
    return C, SAB, VAB, VC, WAB, WC, eps_BC, omega_BC, phi3, u


@app.cell
def fields(C, SAB, VAB, VC, WAB, WC, eps_BC, g, omega_BC, phi1_k, phi3):
    phi3_k = phi3(phi1_k)  # [deg] link 3
    SAB_k = SAB(phi1_k)  # [m] slider from B along the link
    omega_BC_k = omega_BC(phi1_k)  # [rad/s] angular velocity of the link 3
    VAB_k = VAB(phi1_k)  # [m/s] velocity of the slider along the link
    eps_BC_k = eps_BC(phi1_k)  # [rad/s**2] angular acceleration of the link 3
    WAB_k = WAB(phi1_k)  # [m/s**2] acceleration of the slider along the link
    P_C_k = C(phi1_k)  # [m] point C
    VC_k = VC(phi1_k)  # [m/s] velocity of C
    WC_k = WC(phi1_k)  # [m/s**2] acceleration of C
    WCn_k = omega_BC_k**2 * g.L3  # [m/s**2] normal acceleration of C, from C to B
    WCt_k = eps_BC_k * g.L3  # [m/s**2] tangential acceleration of C, to the left of BC
    typeset()
    return P_C_k, SAB_k, VAB_k, VC_k, WAB_k, WC_k, WCn_k, WCt_k, eps_BC_k, omega_BC_k, phi3_k


@app.cell
def tables_1_2(P_C_k, SAB_k, VAB_k, VC_k, WAB_k, WC_k, WCn_k, WCt_k, eps_BC_k, omega_BC_k, phi1_k, phi3_k):
    table_1 = table(
        "1",
        "Results (table of page 39)",
        *(phi1_k, phi3_k, SAB_k, omega_BC_k, eps_BC_k, abs(VC_k), abs(WC_k)),
        decimals=3,
    )
    table_2 = table(
        "2",
        "Point C and slider, by components",
        phi1_k,
        *(P_C_k.real, P_C_k.imag, VC_k.real, VC_k.imag, WC_k.real, WC_k.imag, WCn_k, WCt_k, VAB_k, WAB_k),
    )
    typeset(table_1, table_2)
    return


@app.cell(hide_code=True)
def section_5():
    mo.md(r"""
    ## 5 Find against the closed form

    The six equations have more roots than the mechanism has positions: beside $(\varphi_3, S_\mathrm{AB})$ stand
    $(\varphi_3 + 2\pi j, S_\mathrm{AB})$, the same link, and $(\varphi_3 + \pi + 2\pi j, -S_\mathrm{AB})$, the link
    that points away from the slider, on which C stands on the other side of B and moves the opposite way. In which one
    a Find ends depends on its first approximations; nothing in the equations tells. The closed form names its branch,
    so its numbers are used everywhere else. The checks compare each root with the closed form of the branch that it is
    on.
    """)
    return


@app.cell
def table_3(SAB_F, VAB_F, VC_F, WAB_F, WC_F, eps3_F, omega3_F, phi1_k, phi3_F):
    table_3 = table("3", "Find", phi1_k, phi3_F, SAB_F, omega3_F, eps3_F, VC_F, WC_F, VAB_F, WAB_F, decimals=3)
    table_3
    return


@app.cell
def solved(A, B, F, SAB_k, VAB_k, WAB_k, eps_BC_k, g, omega_BC_k, phi1_k, phi3_k, residuals, size):
    closed = np.array([phi3_k, SAB_k, omega_BC_k, VAB_k, eps_BC_k, WAB_k])
    largest = np.maximum(size, np.nanmax(abs(closed), axis=1, keepdims=True))[:, 0]
    exists = isfinite(SAB_k)
    found_k = exists & isfinite(F[0])
    kappa = (g.L0 + g.L1) / np.nanmin(SAB_k)  # [-] factor by which the divisions by the distance AB widen roundings
    none = where(found_k.any(), 0, nan)  # in place of a position that is not found; where all are, nothing is compared
    r = where(found_k, residuals(F, phi1_k), none)
    side = np.sign(F[1])

    def at(angles):
        return " at phi1 = " + ", ".join(f"{x / deg:.6g}" for x in angles) + " deg"

    def every_position(name, lost, why):
        return Check(name, np.count_nonzero(lost), 0, "positions", why + at(phi1_k[lost]) if np.any(lost) else "")

    def agrees(name, found, closed, i, unit):
        return check(
            f"Find = closed form, {name}", where(found_k, found - closed, none), 1e-12 * kappa, unit, of=largest[i]
        )

    checks_found = (
        every_position("the link has a direction", ~exists, "the slider is at the hinge B"),
        every_position("Find ends in a root", exists & ~found_k, "none from these first approximations"),
        check("residual of Find, positions", r[:2], 1e-12 * kappa, "m", of=largest[1]),
        check("residual of Find, velocities", r[2:4], 1e-12 * kappa, "m/s", of=largest[3]),
        check("residual of Find, accelerations", r[4:], 1e-12 * kappa, "m/s**2", of=largest[5]),
    )
    checks_agreement = (
        agrees("position of the slider", F[1] * exp(1j * F[0]), A(phi1_k) - B, 1, "m"),
        agrees("angular velocity", F[2], omega_BC_k, 2, "rad/s"),
        agrees("sliding velocity", side * F[3], VAB_k, 3, "m/s"),
        agrees("angular acceleration", F[4], eps_BC_k, 4, "rad/s**2"),
        agrees("sliding acceleration", side * F[5], WAB_k, 5, "m/s**2"),
    )
    typeset(*checks_found, *checks_agreement)
    return checks_agreement, checks_found, closed, exists, largest


@app.cell(hide_code=True)
def section_51():
    mo.md(r"""
    ### 5.1 Other first approximations

    The same Find from other angles of the link, all else as given: at how many positions it ends on each branch.
    """)
    return


@app.cell
def others(f1, f2, f3, f4, f5, f6, g, phi1_k, units_f, units_x):
    phi3_g = linspace(-pi, pi, 13)  # [deg] first approximation of the link's angle
    G_found = find(
        lambda phi3, SAB, omega3, VAB, eps3, WAB: (
            f1(phi1_k, phi3, SAB),
            f2(phi1_k, phi3, SAB),
            f3(phi1_k, phi3, SAB, omega3, VAB),
            f4(phi1_k, phi3, SAB, omega3, VAB),
            f5(phi1_k, phi3, SAB, omega3, VAB, eps3, WAB),
            f6(phi1_k, phi3, SAB, omega3, VAB, eps3, WAB),
        ),
        phi3=phi3_g[:, None],
        SAB=g.SAB_0,
        omega3=g.omega3_0,
        VAB=g.VAB_0,
        eps3=g.eps3_0,
        WAB=g.WAB_0,
        unit=units_f,
        unknown_unit=units_x,
    )
    N_same = np.sum(G_found.value.SAB > 0, axis=1)  # [-] positions found on the branch +1: link points to slider
    N_other = np.sum(G_found.value.SAB < 0, axis=1)  # [-] positions found on the branch -1: it points away
    N_none = np.sum(np.isnan(G_found.value.SAB), axis=1)  # [-] positions not found
    N_g = np.sum(G_found.evaluations, axis=1)  # [-] evaluations of the six equations, in all
    typeset()
    return G_found, N_g, N_none, N_other, N_same, phi3_g


@app.cell
def table_4(N_none, N_other, N_same, phi3_g):
    table_4 = table("4", "Find from other angles of the link", phi3_g, N_same, N_other, N_none)
    table_4
    return


@app.cell(hide_code=True)
def section_52():
    mo.md("""
    ### 5.2 The equations themselves

    The closed form satisfies the six equations, and each pair of them is the time derivative of the pair above it,
    again by a complex step: the position equations alone are taken on trust.
    """)
    return


@app.cell
def derivatives(closed, exists, g, largest, phi1_k, residuals):
    rates = np.concatenate([closed[2:], 0 * closed[:2]])  # the third derivatives are in none of the slopes taken
    tilt = 1e-100j  # of the complex step: its square vanishes beside 1
    slopes = residuals(closed + tilt * rates, phi1_k + tilt * g.omega1)[:4].imag / tilt.imag
    own = where(exists, residuals(closed, phi1_k), 0)
    wrong = where(exists, slopes - residuals(closed, phi1_k)[2:], 0)
    checks_equations = (
        check("closed form in the position equations", own[:2], 1e-12, "m", of=largest[1]),
        check("closed form in the velocity equations", own[2:4], 1e-12, "m/s", of=largest[3]),
        check("closed form in the acceleration equations", own[4:], 1e-12, "m/s**2", of=largest[5]),
        check("velocity equations are the slopes of the position equations", wrong[:2], 1e-12, "m/s", of=largest[3]),
        check("acceleration equations are the slopes of these", wrong[2:], 1e-12, "m/s**2", of=largest[5]),
    )
    typeset(*checks_equations)
    return (checks_equations,)


@app.cell(hide_code=True)
def section_6():
    mo.md(r"""
    ## 6 Strokes

    A swinging link turns back where it touches the crank's circle; a link that goes round has its C at the ends of its
    travel along x where it lies along the x axis. In both cases the crank is then $\varphi_\mathrm{q} / 2$ off the
    direction from $O_1$ to B, and takes the quick stroke through the angle $\varphi_\mathrm{q}$ on the side of B.
    """)
    return


@app.cell
def strokes(A, B, g, phi1_k, u):
    gap = where(g.L1 == g.L0, nan, g.L1 - g.L0)  # [m] depth of B inside the crank's circle; none on it
    s_e = sqrt(abs(gap * (g.L0 + g.L1)))  # [m] slider from B at the ends of the strokes
    phi_q = 2 * atan2(s_e, minimum(g.L0, g.L1))  # [deg] turn of the crank in the quick stroke
    phi_w = 2 * pi - phi_q  # [deg] turn of the crank in the slow stroke
    K = phi_w / phi_q  # [-] stroke ratio: time of the slow stroke to that of the quick one
    phi_e1 = -pi / 2 - phi_q / 2  # [deg] crank at one end of the quick stroke
    phi_e2 = -pi / 2 + phi_q / 2  # [deg] crank at the other end
    psi = angle_between(A(phi_e1) - B, A(phi_e2) - B)  # [deg] turn of the link in each stroke
    H = 2 * g.L3 * sin(psi / 2)  # [m] distance between the ends of the travel of C
    omega_near = g.omega1 * g.L1 / gap  # [rad/s] angular velocity of the link as the crank points at B
    omega_far = g.omega1 * g.L1 / (g.L0 + g.L1)  # [rad/s] angular velocity of the link as the crank points away
    start = np.min(phi1_k)
    turned = {"e1": start + (phi_e1 - start) % (2 * pi), "e2": start + (phi_e2 - start) % (2 * pi)}
    ends = {name: float(x) for name, x in turned.items() if isfinite(x)}
    checks_strokes = tuple(  # the link touches the crank's circle there, or lies along the x axis
        check(f"the link turns back at {e}", dot(u(x), exp(1j * x)) if g.L1 < g.L0 else u(x).imag, 1e-12, of=1)
        for e, x in ends.items()
    )
    typeset(*checks_strokes)
    return K, checks_strokes, ends, omega_far, omega_near, psi


@app.cell(hide_code=True)
def section_7():
    mo.md("""
    ## 7 Scheme of the mechanism

    Drawn to scale; moving the knob turns the crank from its first position through one turn, in its own sense. The
    ends of the strokes are shown faintly, the paths of A and C in blue. Velocities are green, accelerations orange;
    their scales hold for the whole turn.
    """)
    return


@app.cell
def scheme(A, B, C, O1, P_C_t, VA, VC_t, WA, WC_t, ends, g, phi1_t, u):
    def scheme(phi1):
        a, c = A(phi1), C(phi1)
        near, far = B + abs(g.L0 - g.L1) * u(phi1), B + (g.L0 + g.L1) * u(phi1)
        tip = B + np.maximum(g.L3, g.L0 + g.L1) * u(phi1)
        links = Drawing().link(B, tip).slot(near, far, "3").slider(a, angle(u(phi1)), "2").link(O1, a, "1")
        return links.support(O1, "O1").support(B, "B").hinge(a, "A").hinge(c, "C")

    longest = lambda *vectors: np.nanmax(abs(np.concatenate(vectors)))
    reach = 0.3 * (g.L0 + g.L1 + g.L3)  # of the longest arrow in the turn
    most = {"m/s": longest(VA(phi1_t), VC_t), "m/s²": longest(WA(phi1_t), WC_t)}
    arrows = {unit: reach / value for unit, value in most.items() if value > 1e-290}
    tips = [P_C_t + arrows.get("m/s", 0) * VC_t, P_C_t + arrows.get("m/s²", 0) * WC_t]
    frame = np.concatenate([[B, O1], A(phi1_t), P_C_t, *tips])
    paths = Drawing(frame=frame, scales=arrows, height=560).path(A(phi1_t)).path(P_C_t)
    for _end in ends.values():
        paths = paths + scheme(_end).faint()
    return paths, scheme


@app.cell
def turn():
    part = slider(0, 360, step=2, value=30, label="turn of the crank", unit="deg")
    player(part, turning=True)
    return (part,)


@app.cell
def drawing_1(A, C, VA, VC, WA, WC, g, part, paths, phi3, scheme):
    phi1 = g.phi_0 + copysign(part.value * deg, g.omega1)  # [deg] crank as drawn
    phi3_1 = phi3(phi1)  # [deg] link 3 as drawn
    VC_1 = VC(phi1)  # [m/s] velocity of C
    WC_1 = WC(phi1)  # [m/s**2] acceleration of C
    moved = (paths + scheme(phi1)).arrow(A(phi1), VA(phi1), "VA", "m/s").arrow(C(phi1), VC_1, "VC", "m/s")
    both = moved.arrow(A(phi1), WA(phi1), "WA", "m/s²", "orange")
    drawing_1 = both.arrow(C(phi1), WC_1, "WC", "m/s²", "orange")
    typeset(
        drawing_1,
        mark(phi1_t=phi1),
        caption("1", "Slotted link with the velocities and accelerations of A and C"),
    )
    return


@app.cell(hide_code=True)
def section_8():
    mo.md("""
    ## 8 The full turn

    The same formulas at every degree of the crank; the workbook holds the numbers as table 5. The dashed lines are
    the ends of the strokes.
    """)
    return


@app.cell
def fine(C, SAB, VC, WC, eps_BC, g, omega_BC, phi3):
    phi1_t = g.phi_0 + copysign(1, g.omega1) * linspace(0, 2 * pi, 361)  # [deg] crank
    phi3_t = phi3(phi1_t)  # [deg] link 3
    SAB_t = SAB(phi1_t)  # [m] slider from B along the link
    omega_BC_t = omega_BC(phi1_t)  # [rad/s] angular velocity of the link 3
    eps_BC_t = eps_BC(phi1_t)  # [rad/s**2] angular acceleration of the link 3
    P_C_t = C(phi1_t)  # [m] point C
    VC_t = VC(phi1_t)  # [m/s] velocity of C
    WC_t = WC(phi1_t)  # [m/s**2] acceleration of C
    typeset()
    return P_C_t, SAB_t, VC_t, WC_t, eps_BC_t, omega_BC_t, phi1_t, phi3_t


@app.cell
def full_turn(P_C_t, SAB_t, VC_t, WC_t, ends, eps_BC_t, omega_BC_t, phi1_t, phi3_t):
    table_5 = table(
        "5",
        "Full turn",
        *(phi1_t, phi3_t, SAB_t, omega_BC_t, eps_BC_t, P_C_t.real, P_C_t.imag),
        *(VC_t.real, VC_t.imag, abs(VC_t), WC_t.real, WC_t.imag, abs(WC_t)),
    )
    figure_2 = figure("2", "Angle of the link", phi1_t, phi3_t, marks=ends)
    figure_3 = figure("3", "Slider from the hinge B", phi1_t, SAB_t, marks=ends)
    figure_4 = figure("4", "Angular velocity of the link", phi1_t, omega_BC_t, marks=ends)
    figure_5 = figure("5", "Angular acceleration of the link", phi1_t, eps_BC_t, marks=ends)
    figure_6 = figure("6", "Velocity of C", phi1_t, VC_t.real, VC_t.imag, abs(VC_t), marks=ends)
    figure_7 = figure("7", "Acceleration of C", phi1_t, WC_t.real, WC_t.imag, abs(WC_t), marks=ends)
    typeset(figure_2, figure_3, figure_4, figure_5, figure_6, figure_7)
    return


@app.cell(hide_code=True)
def section_9():
    mo.md(r"""
    ## 9 Where the crank passes the hinge

    The slider's distance from B runs between $|L_0 - L_1|$, as the crank points at B, and $L_0 + L_1$.

    - $L_1 < L_0$: B lies outside the crank's circle. The link swings; in the quick stroke it turns against the crank.
      The nearer the circle comes to B, the wider the swing, up to half a turn, and the shorter and faster the quick
      stroke: the stroke ratio grows without bound.
    - $L_1 > L_0$: B lies inside the circle. The link goes round with the crank, once for each turn, always in the
      crank's sense, fastest as the slider is nearest to B. Its strokes are its half turns below and above B.
    - $L_1 = L_0$: the circle goes through B. Everywhere else the link turns evenly, at half the crank's speed; as the
      crank points at B the slider is at the hinge itself, and the link can take any direction. From there it either
      turns on, with the slider on its other side ($S_\mathrm{AB}$ changes sign, the branch -1 follows), or it is thrown
      round by half a turn and the branch stays. The equations leave both open, and $\varepsilon_3$ drops out of them.
      That position alone has no numbers here, and a check names it if it is in the tables; there is no quick stroke and
      no stroke ratio.
    """)
    return


@app.cell(hide_code=True)
def here(K, g, omega_far, omega_near, psi):
    if g.L1 < g.L0:
        says = f"the link swings through {psi / deg:.4g}°, stroke ratio {K:.4g}"
    elif g.L1 > g.L0:
        says = f"the link goes round, stroke ratio of its half turns {K:.4g}"
    else:
        says = "the crank's circle goes through the hinge"
    near = f"{omega_near:.4g} rad/s".replace("-", "−") if isfinite(omega_near) else "none"
    far = f"{omega_far:.4g} rad/s".replace("-", "−")
    mo.md(
        f"**Here** L₁ = {g.L1:.6g} m, L₀ = {g.L0:.6g} m: {says}. "
        f"Angular velocity of the link near the hinge: {near}; far from it: {far}."
    )
    return


@app.cell(hide_code=True)
def listed():
    index()
    return


@app.cell
def workbook():
    export("Slotted link", globals())
    return


if __name__ == "__main__":
    app.run()
