import marimo

__generated_with = "0.25.1"
app = marimo.App(width="medium", app_title="Accuracy", css_file="page.css")

with app.setup:
    import cmath
    from collections.abc import Callable
    from dataclasses import dataclass
    from fractions import Fraction
    from pathlib import Path
    from types import SimpleNamespace

    import marimo as mo
    import mpmath as mp
    import numpy as np
    from numpy import arccos as acos
    from numpy import arctan as atan
    from numpy import cos, exp, linspace, nan, pi, sin, sqrt
    from scipy.integrate import solve_ivp
    from scipy.interpolate import CubicSpline
    from scipy.optimize import brentq, fsolve, newton, root

    from mechsheet import (
        Check,
        Column,
        Load,
        Measured,
        Method,
        SheetError,
        Table,
        Truth,
        Used,
        WorkPrecision,
        angle,
        ask,
        caption,
        compare,
        cross,
        dot,
        export,
        find,
        inputs,
        load,
        progress,
        read,
        refuse,
        registry,
        results,
        rrr,
        rrr_acceleration,
        rrr_reach,
        rrr_reactions,
        rrr_velocity,
        summary,
        timed,
        title_block,
        typeset,
    )
    from mechsheet.accuracy import exact, extreme

    folder = Path(__file__).parent
    deg = pi / 180


@app.cell(hide_code=True)
def title():
    title_block(
        "Error against run time",
        """
    Every method with which the product computes stands here beside the others that could do the same job. Errors are
    measured against arithmetic of 50 digits; all methods of a job run turn about in one process, and times are medians,
    given as multiples of the product's own.

    In a figure the product's own method is the large diamond. Whatever is both faster and more accurate would lie in
    the red field beside it. Errors in the grey band are a few roundings: there one method is as good as another, and
    there is no red field. The dashed line joins the methods that none surpasses in both.
    """,
    )
    return


@app.cell(hide_code=True)
def verdict(check_11, check_12, check_21, check_22, check_31, check_32, check_41, check_42, checks_5, checks_7):
    summary(check_11, check_12, check_21, check_22, check_31, check_32, check_41, check_42, checks_5, checks_7)
    return


@app.cell(hide_code=True)
def front(job_11, job_12, job_21, job_22, job_31, job_32, job_41, job_42):
    jobs = (job_11, job_12, job_21, job_22, job_31, job_32, job_41, job_42)
    least = [min(row.error for row in job.rows) for job in jobs]
    alike = [min(row.seconds for row in job.rows if "fewer" not in job.place(row)) / job.own.seconds for job in jobs]
    better = [", ".join(f"{row.family} {row.setting}" for row in job.better) or "none" for job in jobs]
    table_0 = Table(
        "0",
        "The product's own methods",
        (
            Column("job", "", "", 0, np.array([f"{job.number} {job.title}" for job in jobs], object)),
            Column("own method", "", "", 0, np.array([job.own.family for job in jobs], object)),
            Column("digits", "-", "digits that are right", 1, np.array([job.own.digits for job in jobs])),
            Column("most", "-", "digits of the most accurate method", 1, -np.log10(least)),
            Column("least time", "-", "of the methods of no fewer digits, times the own time", 3, np.array(alike)),
            Column(
                "faster and more accurate", "", "methods that leave the product's behind", 0, np.array(better, object)
            ),
        ),
        "least time: the fastest method of no fewer digits, in times of the product's own.",
    )
    table_0
    return (table_0,)


@app.cell(hide_code=True)
def section_0():
    mo.md("""
    ## Input data

    The hitch is that of its own worksheet. The general dyad is a link AC and a rocker BC, driven by a crank over a full
    turn.
    """)
    return


@app.class_definition
@inputs
class Accuracy:
    # 1 Extent
    full: int = 0  # [-] 1 for long runs and 100 000 positions, which take minutes; >= 0 <= 1
    N: int = 10  # [-] positions of the hitch and of the crank; >= 2 <= 1000

    # 2 General dyad
    l_1: float = 0.1  # [m] crank; > 0
    l_A: float = 0.4  # [m] link AC; > 0
    l_B: float = 0.3  # [m] rocker BC; > 0
    X_B: float = 0.4  # [m] rocker's hinge B from the crank's, x
    Y_B: float = 0.1  # [m] rocker's hinge B from the crank's, y

    """After # stand the unit and the meaning, after ; the limits; the page and the code take the same units."""


@app.cell
def form():
    form = ask(Accuracy)
    form
    return (form,)


@app.cell
def given(form):
    g = read(Accuracy, form)
    Used(g)
    return (g,)


@app.cell
def extent(g):
    seconds = 0.5 if g.full else 0.02  # s, run time of a method in all, at least
    sizes = (1, 10, 1000, 100_000) if g.full else (1, 10, 1000)
    return seconds, sizes


@app.cell
def machine(g):
    hitch = load(folder / "hitch.py").inputs()
    S = linspace(hitch.S_min, hitch.S_max, g.N)  # m, cylinder
    lengths = exact.finds(hitch)  # at 50 digits
    L4 = float(lengths["L4"])
    S_p = float(lengths["S_p"])
    L7 = float(lengths["L7"])
    known = {"L4": L4, "S_p": S_p, "L7": L7}
    return L4, L7, S, S_p, hitch, known, lengths


@app.cell
def truth(S, S_p, hitch, known):
    at = [exact.hitch(hitch, s, **known) for s in S]
    upright = exact.hitch(hitch, S_p, **known)
    return at, upright


@app.cell(hide_code=True)
def section_1():
    mo.md(r"""
    ## 1 Position

    The loop of a dyad is $A + \ell_A e^{i\alpha} = B + \ell_B e^{i\beta}$; in the hitch each dyad hangs on the one
    before. Newton and fsolve start from the angles to one digit after the point, as one reads them off a drawing;
    fsolve takes one position after the other, as a Find over a range does. The velocity equations are integrated from
    the first position on.
    """)
    return


@app.class_definition
@dataclass(frozen=True)
class Dyad:
    """Links AC and BC, and the point that the rocker BC carries: B + z (C - B) is the next dyad's pin A."""

    B: complex
    r_A: float | None  # None: the coordinate itself, a driving cylinder
    r_B: float
    branch: int
    z: complex = 0


@app.class_definition
@dataclass(frozen=True)
class Chain:
    """Dyads that hang one on another, the first on the point A(q) that moves by dA(q)."""

    A: Callable
    dA: Callable
    dyads: tuple


@app.function
def hitch_chain(h, L4, L7):
    O1, O3, O5, O7 = (getattr(h, f"X0{k}") + 1j * getattr(h, f"Y0{k}") for k in (1, 3, 5, 7))
    dyads = (
        Dyad(O3, None, h.L3, -1, h.L34 / h.L3 * exp(1j * h.phi_BD)),
        Dyad(O5, L4, h.L5, +1, h.L56 / h.L5),
        Dyad(O7, h.L6, L7, -1),
    )
    return Chain(lambda q: O1 + 0 * q, lambda q: 0 * q, dyads)


@app.function
def by_library(chain, q):
    """Pins A and C of all dyads."""
    A, pins = chain.A(q), []
    for d in chain.dyads:
        C = rrr(A, d.B, q if d.r_A is None else d.r_A, d.r_B, d.branch)
        pins.append((A, C))
        A = d.B + d.z * (C - d.B)
    return pins


@app.function
def inner_pins(pins):
    return np.array([C for _, C in pins])


@app.function
def angles_of(chain, pins):
    """Angles of the links AC, BC of every dyad."""
    return np.array(
        [phi for (A, C), d in zip(pins, chain.dyads, strict=True) for phi in (angle(C - A), angle(C - d.B))]
    )


@app.function
def pins_at(chain, y):
    """Inner pins from the angles of the links."""
    return np.array([d.B + d.r_B * exp(1j * y[2 * k + 1]) for k, d in enumerate(chain.dyads)])


@app.function
def by_newton(chain, q, guess, tolerance):
    """Angles by Newton's method on the loop of each dyad, at all positions at once."""
    A, y = chain.A(q), guess.copy()
    for k, d in enumerate(chain.dyads):
        r_A = q if d.r_A is None else d.r_A
        for _ in range(50):
            a, b = r_A * exp(1j * y[2 * k]), d.r_B * exp(1j * y[2 * k + 1])
            gap, D = d.B + b - A - a, cross(a, b)
            step = np.array([dot(gap, b) / D, dot(gap, a) / D])
            y[2 * k : 2 * k + 2] += step
            if np.max(abs(step)) < tolerance:
                break
        A = d.B + d.z * d.r_B * exp(1j * y[2 * k + 1])
    return pins_at(chain, y)


@app.function
def loops(y, chain, q):
    """Gaps of all loops at one position, as real numbers."""
    A, gaps = chain.A(q), []
    for k, d in enumerate(chain.dyads):
        b = d.r_B * cmath.exp(1j * y[2 * k + 1])
        gap = A + (q if d.r_A is None else d.r_A) * cmath.exp(1j * y[2 * k]) - d.B - b
        gaps += [gap.real, gap.imag]
        A = d.B + d.z * b
    return gaps


@app.function
def by_fsolve(chain, q, guess, tolerance):
    found = [
        fsolve(loops, start, args=(chain, s), xtol=tolerance, full_output=True)[0]
        for s, start in zip(q.tolist(), guess.T, strict=True)
    ]
    return pins_at(chain, np.array(found).T)


@app.function
def rates(q, y, chain):
    """Velocity equations: derivatives of the angles of the links with respect to q."""
    dA, slopes = chain.dA(q), []
    for k, d in enumerate(chain.dyads):
        u = cmath.exp(1j * y[2 * k])
        a, b = u * (q if d.r_A is None else d.r_A), d.r_B * cmath.exp(1j * y[2 * k + 1])
        w = -dA - (u if d.r_A is None else 0)
        D = a.real * b.imag - a.imag * b.real
        turn = (w.real * a.real + w.imag * a.imag) / D
        slopes += [(w.real * b.real + w.imag * b.imag) / D, turn]
        dA = 1j * d.z * turn * b
    return slopes


@app.function
def by_integration(chain, q, start, method, tolerance):
    run = solve_ivp(rates, (q[0], q[-1]), start, method=method, t_eval=q, rtol=tolerance, atol=tolerance, args=(chain,))
    return pins_at(chain, run.y) if run.success else np.full((len(chain.dyads), len(q)), nan)


@app.function
def position_methods(chain, q, own, printed):
    """All ways to the positions of a chain; ``own`` and ``printed`` are those that are no iteration."""
    exact_angles = angles_of(chain, by_library(chain, q))
    guess, start = np.round(exact_angles, 1), exact_angles[:, 0]
    powers = [10.0**-k for k in range(3, 15)]
    return [
        Method("library: rrr", "", own),
        Method("printed: law of cosines", "", printed),
        *(Method("Newton", f"{t:.0e}", lambda t=t: by_newton(chain, q, guess, t)) for t in powers),
        *(Method("fsolve, each position", f"{t:.0e}", lambda t=t: by_fsolve(chain, q, guess, t)) for t in powers[::3]),
        *(
            Method(f"solve_ivp {name}", f"{t:.0e}", lambda name=name, t=t: by_integration(chain, q, start, name, t))
            for name in ("RK45", "DOP853", "Radau")
            for t in powers[:10]
        ),
    ]


@app.function
def printed_hitch(h, S, L4, L7):
    """Angles of the links by the formulas of the document, and its pins."""
    L13 = sqrt((h.X01 - h.X03) ** 2 + (h.Y01 - h.Y03) ** 2)
    phi13 = atan((h.Y03 - h.Y01) / (h.X01 - h.X03))
    phi3 = acos((h.L3**2 + L13**2 - S**2) / (2 * h.L3 * L13)) - phi13
    phi34 = phi3 + h.phi_BD
    L35 = sqrt((h.X03 - h.X05) ** 2 + (h.Y03 - h.Y05) ** 2)
    delta1 = pi - acos((h.X03 - h.X05) / L35)
    S1 = sqrt(L35**2 + h.L34**2 - 2 * L35 * h.L34 * cos(phi34 + delta1))
    phiS1 = acos((L35**2 + S1**2 - h.L34**2) / (2 * L35 * S1))
    phi4 = acos((L4**2 + S1**2 - h.L5**2) / (2 * L4 * S1)) - phiS1 - delta1
    phi5 = pi - acos((h.L5**2 + S1**2 - L4**2) / (2 * h.L5 * S1)) - phiS1 - delta1
    X56, Y56 = h.X05 + h.L56 * cos(phi5), h.Y05 + h.L56 * sin(phi5)
    L57 = sqrt((h.X07 - h.X05) ** 2 + (h.Y07 - h.Y05) ** 2)
    delta2 = pi - acos((h.X07 - h.X05) / L57)
    L53 = sqrt((h.X07 - X56) ** 2 + (h.Y07 - Y56) ** 2)
    phi53 = acos((L53**2 + L57**2 - h.L56**2) / (2 * L53 * L57))
    phi6 = pi - acos((h.L6**2 + L53**2 - L7**2) / (2 * h.L6 * L53)) + phi53 - delta2
    phi7 = acos((L7**2 + L53**2 - h.L6**2) / (2 * L7 * L53)) + phi53 - delta2
    P23 = (h.X03 + h.L3 * cos(phi3)) + 1j * (h.Y03 + h.L3 * sin(phi3))
    P45 = (h.X05 + h.L5 * cos(phi5)) + 1j * (h.Y05 + h.L5 * sin(phi5))
    P67 = (h.X07 + L7 * cos(phi7)) + 1j * (h.Y07 + L7 * sin(phi7))
    return (L13, phi3, phi34, phi4, phi5, phi6, phi7), np.array([P23, P45, P67])


@app.cell
def job_11(L4, L7, S, at, hitch, seconds):
    chain_h = hitch_chain(hitch, L4, L7)
    truth_11 = Truth(p[name] for name in ("P23_S", "P45_S", "P67_S") for p in at)
    ways_11 = position_methods(
        chain_h, S, lambda: inner_pins(by_library(chain_h, S)), lambda: printed_hitch(hitch, S, L4, L7)[1]
    )
    with progress(len(ways_11), "1.1 Position of the hitch") as done_11:
        job_11 = compare("1.1", "Position of the hitch", ways_11, truth_11.error, seconds=seconds, done=done_11)
    figure_11, table_11, check_11 = job_11.figure(), job_11.table(), job_11.check()
    typeset(figure_11, job_11.summary(), check_11)
    return chain_h, check_11, figure_11, job_11, table_11


@app.function
def printed_dyad(A, B, r_A, r_B):
    """The inner pin as the documents compute it: law of cosines and angles."""
    d = B - A
    L = sqrt(d.real**2 + d.imag**2)
    phi = np.arctan2(d.imag, d.real) + acos((r_A**2 + L**2 - r_B**2) / (2 * r_A * L))
    return A.real + r_A * cos(phi) + 1j * (A.imag + r_A * sin(phi))


@app.function
def exact_dyad(l_1, B, r_A, r_B, q):
    """The inner pin at 50 digits."""
    with mp.workdps(50):
        A, B, r_A, r_B = l_1 * mp.expj(mp.mpf(q)), mp.mpc(B), mp.mpf(r_A), mp.mpf(r_B)
        d = B - A
        u = (abs(d) ** 2 + r_A**2 - r_B**2) / (2 * abs(d))
        return A + d / abs(d) * mp.mpc(u, mp.sqrt(r_A**2 - u**2))


@app.cell
def job_12(g, seconds):
    B, q = g.X_B + 1j * g.Y_B, linspace(0, 2 * pi, g.N)
    reach, turn = (abs(g.l_A - g.l_B), g.l_A + g.l_B), (abs(abs(B) - g.l_1), abs(B) + g.l_1)
    if not reach[0] < turn[0] <= turn[1] < reach[1]:
        links, pins = (f"{low:.6g}..{high:.6g} m" for low, high in (reach, turn))
        refuse(
            SheetError(f"links l_A, l_B join pins that are {links} apart, over the turn of the crank they are {pins}")
        )
    chain_d = Chain(lambda q: g.l_1 * exp(1j * q), lambda q: 1j * g.l_1 * exp(1j * q), (Dyad(B, g.l_A, g.l_B, +1),))
    truth_12 = Truth(exact_dyad(g.l_1, B, g.l_A, g.l_B, s) for s in q.tolist())
    ways_12 = position_methods(
        chain_d,
        q,
        lambda: rrr(g.l_1 * exp(1j * q), B, g.l_A, g.l_B, +1),
        lambda: printed_dyad(g.l_1 * exp(1j * q), B, g.l_A, g.l_B),
    )
    with progress(len(ways_12), "1.2 Position of a dyad") as done_12:
        job_12 = compare("1.2", "Position of a dyad", ways_12, truth_12.error, seconds=seconds, done=done_12)
    figure_12, table_12, check_12 = job_12.figure(), job_12.table(), job_12.check()
    typeset(figure_12, job_12.summary(), check_12)
    return check_12, figure_12, job_12, table_12


@app.cell(hide_code=True)
def section_13():
    mo.md("""
    ### Cost of a position

    The library checks its arguments, which the printed formulas do not: that is what the few positions of a document
    pay for. Over many positions it is lost in the arithmetic. The tables give the time of one of so many that are
    computed at once.
    """)
    return


@app.function
def costs(number, title, sizes, seconds, ways):
    """Table of the time for one of n positions computed at once; ``ways`` are named functions that make a run for n."""
    runs = [make(n) for n in sizes for make in ways.values()]
    times = np.array([time for _, time in timed(runs, seconds)]).reshape(len(sizes), len(ways))
    each = 1e6 * times / np.array(sizes)[:, None]
    return Table(
        number,
        title,
        (
            Column("count", "-", "computed at once", 0, np.array(sizes, float)),
            *(Column(name, "µs", "time of one of them", 2, each[:, k]) for k, name in enumerate(ways)),
        ),
    )


@app.cell
def job_13(L4, L7, chain_h, hitch, seconds, sizes):
    def strokes(n):
        return linspace(hitch.S_min, hitch.S_max, n)

    def library(n):
        S_n = strokes(n)
        return lambda: by_library(chain_h, S_n)

    def printed(n):
        S_n = strokes(n)
        return lambda: printed_hitch(hitch, S_n, L4, L7)

    ways_13 = {"library": library, "printed": printed}
    table_13 = costs("1.3", "Time of a position", sizes, seconds, ways_13)
    table_13
    return strokes, table_13


@app.cell(hide_code=True)
def section_2():
    mo.md("""
    ## 2 Velocity and acceleration analogues

    First and second derivatives of the angles of the links 3 to 7 of the hitch with respect to $S$, each way with the
    positions that it needs. Central differences take the library's positions at both sides, at steps that are parts of
    the stroke; the interpolation is a cubic spline through a table of so many positions.
    """)
    return


@app.function
def velocities(chain, q, pins):
    """Velocity analogues of all dyads of a driven chain, by the library."""
    dA, found = chain.dA(q), []
    for (A, C), d in zip(pins, chain.dyads, strict=True):
        v = rrr_velocity(A, d.B, C, dA, dr_A=float(d.r_A is None))
        found.append(v)
        dA = d.z * v.v_C
    return found


@app.function
def accelerations(chain, pins, rates_of):
    """Acceleration analogues of all dyads of a chain whose first pin A rests, by the library."""
    ddA, found = 0, []
    for (A, C), d, v in zip(pins, chain.dyads, rates_of, strict=True):
        a = rrr_acceleration(A, d.B, C, v.omega_A, v.omega_B, dr_A=float(d.r_A is None), a_A=ddA)
        found.append(a)
        ddA = d.z * a.a_C
    return found


@app.function
def first_analogues(chain, q):
    return np.array([w for v in velocities(chain, q, by_library(chain, q)) for w in (v.omega_A, v.omega_B)])[1:]


@app.function
def second_analogues(chain, q):
    pins = by_library(chain, q)
    changes = accelerations(chain, pins, velocities(chain, q, pins))
    return np.array([e for a in changes for e in (a.epsilon_A, a.epsilon_B)])[1:]


@app.function
def link_angles(chain, q):
    """Angles of the links but the cylinder."""
    return angles_of(chain, by_library(chain, q))[1:]


@app.function
def differences(chain, q, h, order):
    """Central differences of the angles, of the given order."""
    behind, ahead = link_angles(chain, q - h), link_angles(chain, q + h)
    return (ahead - behind) / (2 * h) if order == 1 else (ahead - 2 * link_angles(chain, q) + behind) / h**2


@app.function
def interpolated(chain, q, n, order):
    """Derivatives of the cubic spline through a table of n positions."""
    table = linspace(q[0], q[-1], n)
    return CubicSpline(table, link_angles(chain, table), axis=1)(q, order)


@app.function
def printed_analogues(h, S, L4, L7):
    """Velocity analogues by the sines of the angles, as the document prints them."""
    L13, _, phi34, phi4, phi5, phi6, phi7 = printed_hitch(h, S, L4, L7)[0]
    U43 = h.L34 * sin(phi5 - phi34) / (L4 * sin(phi4 - phi5))
    U53 = h.L34 * sin(phi34 - phi4) / (h.L5 * sin(phi5 - phi4))
    U65 = h.L56 * sin(phi7 - phi5) / (h.L6 * sin(phi6 - phi7))
    U75 = h.L56 * sin(phi5 - phi6) / (L7 * sin(phi7 - phi6))
    dphi3 = 2 * S / sqrt(4 * L13**2 * h.L3**2 - (S**2 - L13**2 - h.L3**2) ** 2)
    return np.array([dphi3, dphi3 * U43, dphi3 * U53, dphi3 * U65 * U53, dphi3 * U75 * U53])


@app.function
def exact_second_analogues(h, S, L4, L7):
    """Second derivatives of the angles 3 to 7 at one stroke, by differences of the positions at 200 digits."""
    names = ("phi3_S", "phi4_S", "phi5_S", "phi6_S", "phi7_S")
    with mp.workdps(200):
        step, S = mp.mpf(10) ** -60, mp.mpf(S)
        behind, here, ahead = (exact.geometry(h, S + k * step, L4, L7) for k in (-1, 0, 1))
        return [(ahead[name] - 2 * here[name] + behind[name]) / step**2 for name in names]


@app.function
def derivative_methods(chain, S, stroke, order):
    """Central differences and interpolation."""
    return [
        *(
            Method("central differences", f"{h:.0e}", lambda h=h: differences(chain, S, h * stroke, order))
            for h in (10.0**-k for k in range(1, 11))
        ),
        *(
            Method("spline of the table", f"{n}", lambda n=n: interpolated(chain, S, n, order))
            for n in (10, 20, 40, 80, 160, 320, 640, 1280)
        ),
    ]


@app.cell
def job_21(L4, L7, S, at, chain_h, hitch, seconds):
    stroke = hitch.S_max - hitch.S_min
    truth_21 = Truth(p[f"dphi{k}"] for k in range(3, 8) for p in at)
    ways_21 = [
        Method("library: rrr_velocity", "", lambda: first_analogues(chain_h, S)),
        Method("printed: sines of the angles", "", lambda: printed_analogues(hitch, S, L4, L7)),
        *derivative_methods(chain_h, S, stroke, 1),
    ]
    with progress(len(ways_21), "2.1 Velocity analogues") as done_21:
        job_21 = compare("2.1", "Velocity analogues", ways_21, truth_21.error, seconds=seconds, done=done_21)
    figure_21, table_21, check_21 = job_21.figure(), job_21.table(), job_21.check()
    typeset(figure_21, job_21.summary(), check_21)
    return check_21, figure_21, job_21, stroke, table_21


@app.cell
def job_22(L4, L7, S, chain_h, hitch, seconds, stroke):
    second = np.array([exact_second_analogues(hitch, s, L4, L7) for s in S], object)
    truth_22 = Truth(second.T.ravel())
    ways_22 = [
        Method("library: rrr_acceleration", "", lambda: second_analogues(chain_h, S)),
        *derivative_methods(chain_h, S, stroke, 2),
    ]
    with progress(len(ways_22), "2.2 Acceleration analogues") as done_22:
        job_22 = compare("2.2", "Acceleration analogues", ways_22, truth_22.error, seconds=seconds, done=done_22)
    figure_22, table_22, check_22 = job_22.figure(), job_22.table(), job_22.check()
    typeset(figure_22, job_22.summary(), check_22)
    return check_22, figure_22, job_22, table_22


@app.cell(hide_code=True)
def section_3():
    mo.md(r"""
    ## 3 Find

    The three unknown lengths of the hitch, one after the other: $L_4$, $S_p$, $L_7$. All iterations solve the same
    equations, written with the library's dyads; the last one those of the document, as a port from Mathcad has it.
    In closed form the mechanism is taken from the other end: the wanted point is known, and the unknown length is its
    distance from another known point; that must be thought out anew for every unknown.

    `find` does more for its time than the iterations: it looks through the whole interval on both branches of assembly,
    reports every root with its bracket and residual, or why there is none, and whatever the guess. The iterations
    return one number.
    """)
    return


@app.function
def hitch_functions(h):
    """What the three Finds of the hitch make equal to something, and their derivatives, by the library."""
    O1, O3, O5, O7 = (getattr(h, f"X0{k}") + 1j * getattr(h, f"Y0{k}") for k in (1, 3, 5, 7))
    z = h.L34 / h.L3 * exp(1j * h.phi_BD)

    def P34(S):
        return O3 + z * (rrr(O1, O3, S, h.L3, -1) - O3)

    def P45(S, L4, branch=+1):
        return rrr(P34(S), O5, L4, h.L5, branch)

    def P56(S, L4, branch=+1):
        return O5 + h.L56 / h.L5 * (P45(S, L4, branch) - O5)

    def phi6(S, L4, L7, branch=-1):
        P = P56(S, L4)
        return angle(rrr(P, O7, h.L6, L7, branch) - P)

    def slope_L4(S, L4):
        C = P45(S, L4)
        return (h.L56 / h.L5 * rrr_velocity(P34(S), O5, C, dr_A=1).v_C).imag

    def slope_S(S, L4):
        C = rrr(O1, O3, S, h.L3, -1)
        A = O3 + z * (C - O3)
        v = rrr_velocity(O1, O3, C, dr_A=1).v_C
        return (h.L56 / h.L5 * rrr_velocity(A, O5, rrr(A, O5, L4, h.L5, +1), z * v).v_C).imag

    def slope_L7(S, L4, L7):
        P = P56(S, L4)
        return rrr_velocity(P, O7, rrr(P, O7, h.L6, L7, -1), dr_B=1).omega_A

    return P34, P56, phi6, slope_L4, slope_S, slope_L7


@app.function
def in_turn(f_L4, f_S, f_L7):
    """The three unknowns, each from the ones before it; NaN from the first that fails on."""
    L4 = f_L4()
    S_p = nan if np.isnan(L4) else f_S(L4)
    return np.array([L4, S_p, nan if np.isnan(S_p) else f_L7(S_p, L4)])


@app.function
def by_find(h, factor):
    """The three Finds of the hitch worksheet."""
    O5, O7 = h.X05 + 1j * h.Y05, h.X07 + 1j * h.Y07
    P34, P56, phi6, *_ = hitch_functions(h)
    guess_4, guess_S, guess_7 = guesses(h, factor)
    return in_turn(
        lambda: (
            find(
                lambda L4, s: P56(h.S_min, L4, s).imag,
                *rrr_reach(P34(h.S_min), O5, h.L5),
                equals=h.Y56_min,
                guess=guess_4,
                branches=(+1, -1),
                branch=+1,
            ).value
        ),
        lambda L4: find(lambda S: P56(S, L4).imag, h.S_min, h.S_max, equals=h.Y_P56, guess=guess_S).value,
        lambda S, L4: (
            find(
                lambda L7, s: phi6(S, L4, L7, s),
                *rrr_reach(P56(S, L4), O7, h.L6),
                equals=h.phi_P6,
                guess=guess_7,
                branches=(+1, -1),
                branch=-1,
            ).value
        ),
    )


@app.function
def guesses(h, factor):
    """The document's guesses, the lengths times the factor, the stroke as far towards its ends."""
    part = 0.5 if factor == 1 else float(factor > 1)
    return 0.8 * h.L4_0 * factor, h.S_min + part * (h.S_max - h.S_min), 0.8 * h.L7_0 * factor


@app.function
@np.errstate(all="ignore")
def by_iteration(h, factor, solve):
    """The three unknowns by ``solve(f, slope, guess, ends)``."""
    O5, O7 = h.X05 + 1j * h.Y05, h.X07 + 1j * h.Y07
    P34, P56, phi6, slope_L4, slope_S, slope_L7 = hitch_functions(h)
    guess_4, guess_S, guess_7 = guesses(h, factor)

    def lengths(f, slope, guess, ends):
        positive = lambda g: lambda x: g(x) if x > 0 else nan  # noqa: E731
        return solve(positive(f), positive(slope), guess, ends)

    return in_turn(
        lambda: lengths(
            lambda L4: P56(h.S_min, L4).imag - h.Y56_min,
            lambda L4: slope_L4(h.S_min, L4),
            guess_4,
            rrr_reach(P34(h.S_min), O5, h.L5),
        ),
        lambda L4: lengths(lambda S: P56(S, L4).imag - h.Y_P56, lambda S: slope_S(S, L4), guess_S, (h.S_min, h.S_max)),
        lambda S, L4: lengths(
            lambda L7: phi6(S, L4, L7) - h.phi_P6,
            lambda L7: slope_L7(S, L4, L7),
            guess_7,
            rrr_reach(P56(S, L4), O7, h.L6),
        ),
    )


@app.function
def solvers():
    """Iterations for one equation: name, tolerances, and ``solve(f, slope, guess, ends, tolerance)``."""

    def bracketing(f, slope, guess, ends, tolerance):
        try:
            return brentq(f, *ends, xtol=tolerance, rtol=max(tolerance, 1e-15))
        except ValueError:  # no change of sign between the ends
            return nan

    def newtons(f, slope, guess, ends, tolerance):
        return solution(*newton(f, guess, fprime=slope, tol=tolerance, full_output=True, disp=False))

    def secant(f, slope, guess, ends, tolerance):
        return solution(*newton(f, guess, tol=tolerance, full_output=True, disp=False))

    def solution(x, result):
        return x if result.converged else nan

    def hybr(f, slope, guess, ends, tolerance):
        result = root(lambda x: f(x.item()), guess, method="hybr", tol=tolerance)
        return result.x.item() if result.success else nan

    return {"brentq on the reach": bracketing, "Newton": newtons, "secant": secant, "hybr": hybr}


@app.function
@np.errstate(all="ignore")
def by_port(h, factor, tolerance):
    """hybr on the formulas of the document."""

    def hybr(f, guess):
        result = root(lambda x: f(x.item()), guess, method="hybr", tol=tolerance)
        return result.x.item() if result.success else nan

    def Y56(S, L4):
        return h.Y05 + h.L56 * sin(printed_hitch(h, S, L4, h.L7_0)[0][4])

    guess_4, guess_S, guess_7 = guesses(h, factor)
    return in_turn(
        lambda: hybr(lambda L4: Y56(h.S_min, L4) - h.Y56_min, guess_4),
        lambda L4: hybr(lambda S: Y56(S, L4) - h.Y_P56, guess_S),
        lambda S, L4: hybr(lambda L7: printed_hitch(h, S, L4, L7)[0][5] - h.phi_P6, guess_7),
    )


@app.function
def by_inverse(h):
    """The unknown lengths as distances between known points."""
    O1, O3, O5, O7 = (getattr(h, f"X0{k}") + 1j * getattr(h, f"Y0{k}") for k in (1, 3, 5, 7))
    z = h.L34 / h.L3 * exp(1j * h.phi_BD)

    def lower_link(Y):
        """Its direction where its end has the height Y."""
        rise = (Y - h.Y05) / h.L56
        return sqrt((1 - rise) * (1 + rise)) + 1j * rise

    P34 = O3 + z * (rrr(O1, O3, h.S_min, h.L3, -1) - O3)
    L4 = abs(O5 + h.L5 * lower_link(h.Y56_min) - P34)
    P45, P56 = (O5 + length * lower_link(h.Y_P56) for length in (h.L5, h.L56))
    P23 = O3 + (rrr(P45, O3, L4, h.L34, -1) - O3) / z
    return np.array([L4, abs(P23 - O1), abs(P56 + h.L6 * exp(1j * h.phi_P6) - O7)])


@app.function
def find_methods(h, factors):
    """All ways to the three unknowns, each from all guesses."""
    powers = [10.0**-k for k in (4, 6, 8, 10, 12, 14)]

    def all_of(way):
        return lambda: np.array([way(factor) for factor in factors])

    return [
        Method("find", "", all_of(lambda factor: by_find(h, factor))),
        Method("inverse mechanism", "", all_of(lambda factor: by_inverse(h))),
        *(
            Method(
                name,
                f"{t:.0e}",
                all_of(
                    lambda factor, solve=solve, t=t: by_iteration(h, factor, lambda *given: solve(*given, tolerance=t))
                ),
            )
            for name, solve in solvers().items()
            for t in powers
        ),
        *(
            Method("hybr, printed formulas", f"{t:.0e}", all_of(lambda factor, t=t: by_port(h, factor, t)))
            for t in powers
        ),
    ]


@app.cell
def job_31(hitch, lengths, seconds):
    unknowns = Truth(lengths[name] for name in ("L4", "S_p", "L7"))
    ways_31 = find_methods(hitch, [1.0])
    with progress(len(ways_31), "3.1 Find from the document's guesses") as done_31:
        job_31 = compare(
            "3.1", "Find from the document's guesses", ways_31, unknowns.error, seconds=seconds, done=done_31
        )
    figure_31, table_31, check_31 = job_31.figure(), job_31.table(), job_31.check()
    typeset(figure_31, job_31.summary(), check_31)
    return check_31, figure_31, job_31, table_31, unknowns


@app.cell(hide_code=True)
def bad_guesses():
    factors = [0.25, 0.5, 0.8, 1.25, 2.0, 4.0]
    mo.md(f"""
    ### Bad guesses

    The document's guesses of the lengths times {", ".join(f"{factor:g}" for factor in factors)}; the stroke begins at
    its least length with the small factors and at its greatest with the others. The error is that of the worst guess,
    the time that of all. A method that ends at another root, or nowhere, has no digit right.
    """)
    return (factors,)


@app.cell
def job_32(factors, hitch, seconds, unknowns):
    ways_32 = find_methods(hitch, factors)

    def worst(found):
        return max(map(unknowns.error, found))

    with progress(len(ways_32), "3.2 Find from bad guesses") as done_32:
        job_32 = compare("3.2", "Find from bad guesses", ways_32, worst, seconds=seconds, done=done_32)
    figure_32, table_32, check_32 = job_32.figure(), job_32.table(), job_32.check()
    typeset(figure_32, job_32.summary(), check_32)
    return check_32, figure_32, job_32, table_32


@app.cell(hide_code=True)
def section_33():
    mo.md("""
    ### Many Finds at once

    The lifting rod for so many heights of the suspension axis, as a sweep asks for it: `find` takes all of them in one
    call, brentq one after the other.
    """)
    return


@app.cell
def job_33(hitch, seconds, sizes):
    def heights(n):
        return linspace(0.19, 0.21, n) if n > 1 else np.array([0.2])

    lower, upper = rrr_reach(hitch_functions(hitch)[0](hitch.S_min), hitch.X05 + 1j * hitch.Y05, hitch.L5)

    def height(L4, s=+1):
        return hitch_functions(hitch)[1](hitch.S_min, L4, s).imag

    def together(n):
        asked = {"equals": heights(n), "branches": (+1, -1), "branch": +1}
        return lambda: find(height, lower, upper, **asked).value

    def one_by_one(n):
        return lambda: [brentq(lambda L4, Y=Y: height(L4) - Y, lower, upper, xtol=1e-14) for Y in heights(n)]

    def known_point(n):
        P34, O5 = hitch_functions(hitch)[0](hitch.S_min), hitch.X05 + 1j * hitch.Y05
        rise = (heights(n) - hitch.Y05) / hitch.L56
        return lambda: abs(O5 + hitch.L5 * (sqrt((1 - rise) * (1 + rise)) + 1j * rise) - P34)

    ways_33 = {"find": together, "brentq": one_by_one, "inverse": known_point}
    table_33 = costs("3.3", "Time of a Find", sizes[:3], seconds, ways_33)
    table_33
    return (table_33,)


@app.cell(hide_code=True)
def section_4():
    mo.md(r"""
    ## 4 Reactions

    From the same pins and the weight of the implement, all ways compute the same six reactions. The dense system holds
    the 18 equations of the six bodies at each position; least squares add the equilibrium of the whole mechanism.
    The second comparison has the hitch at $S_p$, where the mast is upright and the printed formulas divide by its
    horizontal part, which is nothing but rounding.
    """)
    return


@app.function
def library_reactions(O1, O3, O5, O7, P23, P34, P45, P56, P67, S6, P6):
    group_67 = rrr_reactions(P56, O7, P67, [Load(-1j * P6, S6)])
    group_45 = rrr_reactions(P34, O5, P45, [], [Load(-group_67.R_A, P56)])
    group_23 = rrr_reactions(O1, O3, P23, [], [Load(-group_45.R_A, P34)])
    return np.array([group_67.R_A, group_67.R_B, -group_45.R_A, -group_45.R_B, group_23.R_A, group_23.R_B])


@app.function
@np.errstate(all="ignore")
def printed_reactions(O1, O3, O5, O7, P23, P34, P45, P56, P67, S6, P6):
    """The document's formulas, one unknown eliminated after the other."""
    a1, b1 = O7.imag - P67.imag, P67.real - O7.real
    c1, d1, e1 = P67.imag - P56.imag, P67.real - P56.real, S6.real - P67.real
    R56x = P6 * b1 * (d1 + e1) / (a1 * d1 + b1 * c1)
    R56y = -(P6 * e1 - R56x * c1) / d1
    R07x, R07y = -R56x, P6 - R56y
    R65x, R65y = -R56x, -R56y
    a2, b2 = P34.imag - P45.imag, P34.real - P45.real
    c2, d2 = O5.imag - P45.imag, P45.real - O5.real
    e2 = R65x * (P45.imag - P56.imag) + R65y * (P56.real - P45.real)
    R05x = -(b2 * e2 - R65x * a2 * d2 + R65y * b2 * d2) / (a2 * d2 + b2 * c2)
    R05y = -(e2 + R05x * c2) / d2
    R34x = (b2 * e2 + R65x * b2 * c2 + R65y * b2 * d2) / (a2 * d2 + b2 * c2)
    R34y = R34x * a2 / b2
    R43x, R43y = -R34x, -R34y
    a3, b3 = P23.imag - O1.imag, P23.real - O1.real
    c3, d3 = O3.imag - P23.imag, O3.real - P23.real
    e3 = R43x * (P23.imag - P34.imag) + R43y * (P34.real - P23.real)
    R03x = (b3 * e3 + R43x * a3 * d3 - R43y * b3 * d3) / (a3 * d3 - b3 * c3)
    R03y = (e3 + R03x * c3) / d3
    R01x = -(b3 * e3 + R43x * b3 * c3 - R43y * b3 * d3) / (a3 * d3 - b3 * c3)
    R01y = R01x * a3 / b3
    pairs = ((R56x, R56y), (R07x, R07y), (R34x, R34y), (R05x, R05y), (R01x, R01y), (R03x, R03y))
    return np.array([x + 1j * y for x, y in pairs])


@app.function
def equations(O1, O3, O5, O7, P23, P34, P45, P56, P67, S6, P6):
    """Equilibrium of the bodies 2 to 7 at all positions: matrix (..., 18, 18) and right-hand side (..., 18)."""
    pins = (
        (P56, 5, 6),
        (O7, 0, 7),
        (P34, 4, 3),
        (O5, 0, 5),
        (O1, 0, 2),
        (O3, 0, 3),
        (P23, 2, 3),
        (P45, 5, 4),
        (P67, 6, 7),
    )
    matrix, right = np.zeros((*P67.shape, 18, 18)), np.zeros((*P67.shape, 18))
    for k, (P, giver, taker) in enumerate(pins):
        for body, sense in ((taker, 1), (giver, -1)):
            if body:
                row = 3 * (body - 2)
                matrix[..., row, 2 * k] = matrix[..., row + 1, 2 * k + 1] = sense
                matrix[..., row + 2, 2 * k], matrix[..., row + 2, 2 * k + 1] = -sense * P.imag, sense * P.real
    right[..., 13], right[..., 14] = P6, P6 * S6.real
    return matrix, right


@app.function
def of_unknowns(x):
    """The six reactions from the unknowns of `equations`; R05 is counted on the frame."""
    R = np.moveaxis(x[..., 0:12:2] + 1j * x[..., 1:12:2], -1, 0)
    return R * np.array([1, 1, 1, -1, 1, 1]).reshape(-1, *[1] * (R.ndim - 1))


@app.function
def dense_reactions(*given):
    matrix, right = equations(*given)
    return of_unknowns(np.linalg.solve(matrix, right[..., None])[..., 0])


@app.function
def least_squares(*given):
    matrix, right = equations(*given)
    whole = matrix.reshape(*matrix.shape[:-2], 6, 3, 18).sum(-3)
    matrix = np.concatenate([matrix, whole], axis=-2)
    right = np.concatenate([right, right.reshape(*right.shape[:-1], 6, 3).sum(-2)], axis=-1)
    return of_unknowns(np.array([np.linalg.lstsq(A, b, rcond=None)[0] for A, b in zip(matrix, right, strict=True)]))


@app.function
def reaction_methods(h, S, L4, L7, S6):
    """All ways to the reactions from the library's positions."""
    O1, O3, O5, O7 = (getattr(h, f"X0{k}") + 1j * getattr(h, f"Y0{k}") for k in (1, 3, 5, 7))
    (_, P23), (P34, P45), (P56, P67) = by_library(hitch_chain(h, L4, L7), S)
    given = (O1, O3, O5, O7, P23, P34, P45, P56, P67, S6, h.P6)
    return [
        Method("library: rrr_reactions", "", lambda: library_reactions(*given)),
        Method("printed: elimination", "", lambda: printed_reactions(*given)),
        Method("dense system", "18 × 18", lambda: dense_reactions(*given)),
        Method("least squares", "21 × 18", lambda: least_squares(*given)),
    ]


@app.function
def reactions_of(at):
    """The six reactions at 50 digits, as the methods list them."""
    return [p[name] for name in ("R56", "R07", "R34", "R05", "R01", "R03") for p in at]


@app.cell
def job_41(L4, L7, S, at, hitch, seconds):
    S6 = np.array([complex(p["PS6_S"]) for p in at])
    ways_41 = reaction_methods(hitch, S, L4, L7, S6)
    with progress(len(ways_41), "4.1 Reactions") as done_41:
        job_41 = compare("4.1", "Reactions", ways_41, Truth(reactions_of(at)).error, seconds=seconds, done=done_41)
    figure_41, table_41, check_41 = job_41.figure(), job_41.table(), job_41.check()
    typeset(figure_41, job_41.summary(), check_41)
    return check_41, figure_41, job_41, table_41


@app.cell
def job_42(L4, L7, S_p, hitch, seconds, upright):
    S6_p = np.array([complex(upright["PS6_S"])])
    ways_42 = reaction_methods(hitch, np.array([S_p]), L4, L7, S6_p)
    with progress(len(ways_42), "4.2 Reactions, mast upright") as done_42:
        job_42 = compare(
            "4.2",
            "Reactions, mast upright",
            ways_42,
            Truth(reactions_of([upright])).error,
            seconds=seconds,
            done=done_42,
        )
    figure_42, table_42, check_42 = job_42.figure(), job_42.table(), job_42.check()
    typeset(figure_42, job_42.summary(), check_42)
    return check_42, figure_42, job_42, table_42


@app.cell(hide_code=True)
def section_43():
    mo.md("""
    ### Cost of a position

    For a few positions one dense system is quicker than the library's checked functions, for many it is not.
    """)
    return


@app.cell
def job_43(L4, L7, hitch, seconds, sizes, strokes):
    def way(k):
        def make(n):
            S_n = strokes(n)
            return reaction_methods(hitch, S_n, L4, L7, 2 + 0.5j + 0 * S_n)[k].run

        return make

    ways_43 = {"library": way(0), "printed": way(1), "dense": way(2), "least squares": way(3)}
    table_43 = costs("4.3", "Time of the reactions", sizes[:3], seconds, ways_43)
    table_43
    return (table_43,)


@app.cell(hide_code=True)
def section_5():
    mo.md("""
    ## 5 Whole worksheets

    Every number and every check of the five documents, through the worksheets themselves and at different numbers of
    positions; drawings and tables are left out. The field of positions is replaced; all else is the document's input.
    The joint has no positions but load cases, and the slotted link goes without its study of first approximations.
    The error is the largest of the results below, each relative to its own largest value, at three of the positions.
    At one position alone a number that is nearly zero there has fewer digits: the lift arm of the hitch is nearly
    level, the angular acceleration of the leg turns its sign.

    | worksheet | results compared with 50 digits |
    | :-- | :-- |
    | hitch | all numbers of sections 2 to 7 |
    | landing gear | pin A, analogues of the crank's angular velocity and acceleration, force of the cylinder |
    | slotted link | slider, angular velocity and acceleration of the link, velocity and acceleration of C |
    | kinetostatics | pins of plunger and piston; balancing moment by the work of all loads and inertia forces |
    | joint | forces in all elements, from the areas that act |
    """)
    return


@app.function
def truth_hitch(g, names, rows):
    for_all = [exact.hitch(g, names["S"][i]) for i in rows]
    return {name: [p[name] for p in for_all] for name in for_all[0] if name in names}


@app.function
def truth_landing_gear(g, names, rows):
    with mp.workdps(50):
        O1, l3 = mp.mpc(-mp.mpf(g.b), g.a), mp.mpf(g.l3)
        L, leg = abs(O1), -1j * mp.expj(-mp.mpf(g.theta) / 2)
        tangent = l3 * O1 / L**2 * mp.mpc(l3, -mp.sqrt(L**2 - l3**2))
        H = abs(tangent / mp.expj(mp.mpf(g.theta) / 2) - O1) - abs(tangent * mp.expj(mp.mpf(g.theta) / 2) - O1)
        along = leg / tangent * l3  # the leg hangs down where the cylinder is shortest
        v, q = H / g.t_r, mp.mpf(g.rho) * g.U * abs(g.U) / 2

        def A(l2):
            cosine = (l3**2 + L**2 - l2**2) / (2 * l3 * L)
            return l3 * O1 / L * mp.mpc(cosine, -mp.sqrt(1 - cosine**2))

        def at(l2):
            here = A(l2)
            omega, eps = (mp.diff(lambda x: mp.arg(A(x) / here), l2, n) for n in (1, 2))
            u = here / l3 * along
            n = 1j * u
            air = q * mp.mpf(g.l_w) * (g.C_s * n.real * abs(n.real) / 2 - g.C_w * u.imag)
            weight = -mp.mpf(g.m3) * g.g_n * g.r3 * u.real
            rod = (here - O1) / l2
            F = ((mp.mpf(g.J3) + g.m3 * mp.mpf(g.r3) ** 2) * v**2 * eps - air - weight) / (mp.conj(here) * rod).imag
            return here, omega, eps, F

        columns = zip(*(at(mp.mpf(float(names["l2i"][i]))) for i in rows), strict=True)
        return dict(zip(("Ai", "omega3_l2i", "eps3_l2i", "F_c"), columns, strict=True))


@app.function
def truth_slotted_link(g, names, rows):
    with mp.workdps(50):
        L1, L0, L3, w = (mp.mpf(x) for x in (g.L1, g.L0, g.L3, g.omega1))

        def at(phi1):
            def A(t):
                return mp.mpc(0, L0) + L1 * mp.expj(phi1 + w * t)

            def C(t):
                return L3 * A(t) / abs(A(t))

            omega, eps = (mp.diff(lambda t: mp.arg(A(t) / A(0)), 0, n) for n in (1, 2))
            V, W = (mp.diff(lambda t: C(t).real, 0, n) + 1j * mp.diff(lambda t: C(t).imag, 0, n) for n in (1, 2))
            return abs(A(0)), omega, eps, V, W

        columns = zip(*(at(mp.mpf(float(names["phi1_k"][i]))) for i in rows), strict=True)
        return dict(zip(("SAB_k", "omega_BC_k", "eps_BC_k", "VC_k", "WC_k"), columns, strict=True))


@app.function
def truth_kinetostatics(g, names, rows):
    with mp.workdps(100):  # differences with the step h keep more than 50 digits of them
        x = {name: mp.mpf(value) for name, value in vars(g).items()}
        C, H, O5 = mp.mpc(x["X_C"], x["Y_C"]), mp.mpc(x["X_H"], x["Y_H"]), mp.mpc(x["X05"], x["Y05"])
        u5 = mp.expj(x["phi05"])

        def pins(phi):
            A = x["l1"] * mp.expj(phi)
            d = C - A
            along = (abs(d) ** 2 + x["l2"] ** 2 - x["l3"] ** 2) / (2 * abs(d))
            B = A + mp.mpc(along, mp.sqrt(x["l2"] ** 2 - along**2)) * d / abs(d)
            D, K = (C + (B - C) * x[f"l_C{k}"] / x["l3"] * mp.expj(x[f"delta_{k}"]) for k in "DK")
            z = (D - O5) / u5
            return A, B, D, K, O5 + u5 * (z.real + mp.sqrt(x["l4"] ** 2 - z.imag**2))

        def bodies(phi):
            """Centre of mass and direction of each body."""
            A, B, D, K, E = pins(phi)
            e7 = (K - H) / abs(K - H)
            return (
                *(A * x["l_O1S1"] / x["l1"], A, B + (A - B) * x["l_BS2"] / x["l2"], A - B),
                *(B + (C - B) * x["l_BS3"] / x["l3"], B - C, E + (D - E) * x["l_ES4"] / x["l4"], D - E),
                *(E, u5, K - e7 * x["l_KS6"], e7, H + e7 * x["l_HS7"], e7),
            )

        def at(phi):
            h, omega, eps = mp.mpf(10) ** -15, x["n1"], x["eps1"]
            table = [bodies(phi + k * h) for k in range(-3, 4)]
            ends = [pins(phi + k * h)[3:] for k in range(-3, 4)]

            def slopes(values):
                a, b, c, here, d, e, f = values
                first = (45 * (d - c) - 9 * (e - b) + (f - a)) / (60 * h)
                return first, (2 * (f + a) - 27 * (e + b) + 270 * (d + c) - 490 * here) / (180 * h**2)

            work = mp.mpf(0)
            for body in range(7):
                S1, S2 = slopes([row[2 * body] for row in table])
                u = [row[2 * body + 1] for row in table]
                t1, t2 = slopes([mp.arg(value / u[3]) for value in u])
                F = -x[f"m{body + 1}"] * (S2 * omega**2 + S1 * eps + 1j * x["g_n"])
                M = -x.get(f"J{body + 1}", 0) * (t2 * omega**2 + t1 * eps)
                work += (mp.conj(F) * S1).real + M * t1
            K, E = ends[3]
            K1, E1 = (slopes([pair[k] for pair in ends])[0] for k in (0, 1))
            work += x["p_g"] * mp.pi * x["D_g"] ** 2 / 4 * (mp.conj((K - H) / abs(K - H)) * K1).real
            forwards = (E1 / u5).real
            if forwards * omega > 0:
                work -= x["Q5"] * forwards
            return K, E, -work

        columns = zip(*(at(mp.mpf(float(names["phi1"][i]))) for i in rows), strict=True)
        return dict(zip(("K", "E", "M_b"), columns, strict=True))


@app.function
def truth_joint(g, names, rows):
    shape = np.broadcast_shapes(*(np.shape(names[name]) for name in ("P", "y", "A")))
    y, A = (np.broadcast_to(names[name], shape).reshape(-1, shape[-1]) for name in ("y", "A"))
    M, N = (np.broadcast_to(names[name], (*shape[:-1], 1)).ravel() for name in ("M", "N"))
    forces = []
    for y_i, A_i, M_i, N_i in zip(y.tolist(), A.tolist(), M.tolist(), N.tolist(), strict=True):
        levels, areas = list(map(Fraction, y_i)), list(map(Fraction, A_i))
        F, S, J = (sum(a * v**k for a, v in zip(areas, levels, strict=True)) for k in range(3))
        m, n = Fraction(M_i), Fraction(N_i)
        a, b = (n * J - m * S) / (F * J - S**2), (m * F - n * S) / (F * J - S**2)
        forces += [mp.mpf((a + b * v) * w) for v, w in zip(levels, areas, strict=True)]
    return {"P": forces}


@app.function
def sliders():
    """Stand-ins for the sliders of the worksheets, whose values a page does not give to the cell that makes them."""
    values = {"part": 0.2, "forces_at": 0.2, "turn": 40, "drawn": 1, "drawn_ring": 1}
    return {name: SimpleNamespace(value=value, text="") for name, value in values.items()}


@app.function
def numbers_of(stem):
    """Names of a worksheet's numbers and checks: lines with a unit, without tables and what follows a slider."""
    sheet = load(folder / f"{stem}.py")
    names = [name for name in results(sheet.path) if name not in ("form", "g")]
    declared = registry(sheet.run(names, {"g": sheet.inputs(), **sliders()}))
    study = ("phi3_g", "N_same", "N_other", "N_none", "N_g")  # first approximations of the slotted link

    def moves(name):
        return any(set(cell.gives) & set(sliders()) for cell in sheet.needed([name], ["g"]))

    numbers = [name for name in names if name in declared and name not in study]
    return [name for name in (*numbers, *(name for name in names if name.startswith("check"))) if not moves(name)]


@app.function
def fields_of(stem, n):
    """The field of n positions that takes the place of a worksheet's own one."""
    sheet = load(folder / f"{stem}.py")
    g = sheet.inputs()
    t = linspace(0, 1, n) if n > 1 else np.array([0.5])
    if stem == "hitch":
        return {"g": g, "S": g.S_min * (1 - t) + g.S_max * t, "dS": (g.S_max - g.S_min) / max(n - 1, 1)}
    if stem == "landing_gear":
        made = sheet.run(["l20", "H"], {"g": g})
        return {"g": g, "i": np.arange(n), "l2i": made["l20"] + t * made["H"]}
    if stem == "slotted_link":
        return {"g": g, "k": np.arange(n), "dphi1": 2 * pi / max(n - 1, 1), "phi1_k": 2 * pi * t}
    if stem == "kinetostatics":
        base = ("C", "H", "O1", "O5", "omega1", "u5")
        made = sheet.run(base, {"g": g})
        return {"g": g, "phi1": 2 * pi * t} | {name: made[name] for name in base}
    return {"g": g}


@app.function
def error_of(truth, names, n):
    """Largest error of the results of a worksheet at three of its n positions."""
    rows = sorted({0, n // 3, n - 1})
    exactly = truth(names["g"], names, rows)
    errors = []
    for name, numbers in exactly.items():
        found = np.asarray(names[name])
        at = found.ravel() if len(numbers) == found.size else np.broadcast_to(found, (n,))[rows]
        errors.append(Truth(numbers).error(at))
    return max(errors)


@app.cell
def job_5(seconds, sizes):
    truths = {
        "hitch": truth_hitch,
        "landing_gear": truth_landing_gear,
        "slotted_link": truth_slotted_link,
        "kinetostatics": truth_kinetostatics,
        "joint": truth_joint,
    }
    cases = [(stem, n) for stem in truths for n in (sizes if stem != "joint" else (1,))]
    wanted = {stem: numbers_of(stem) for stem in truths}
    sheets = {stem: load(folder / f"{stem}.py") for stem in truths}
    given_5 = [fields_of(*case) for case in cases]
    runs_5 = [
        lambda stem=stem, given=given: sheets[stem].run(wanted[stem], given)
        for (stem, _), given in zip(cases, given_5, strict=True)
    ]
    with progress(len(cases), "5 Whole worksheets") as done_5:
        made_5 = timed(runs_5, seconds, done_5)
    rows_5 = tuple(
        Measured(stem, "load cases" if stem == "joint" else f"{n}", error_of(truths[stem], names, n), time)
        for (stem, n), (names, time) in zip(cases, made_5, strict=True)
    )
    return cases, rows_5, sheets, wanted


@app.cell
def shown_5(cases, rows_5, sheets, wanted):
    stems = np.array([row.family for row in rows_5], object)
    cells_5 = [len(sheets[stem].needed(wanted[stem], ["g"])) for stem, _ in cases]
    time_5 = Column("time", "ms", "run time", 1, 1e3 * np.array([row.seconds for row in rows_5]))
    error_5 = Column(
        "error", "-", "largest error of the results", 1, np.array([row.error for row in rows_5]), power=True
    )
    table_5 = Table(
        "5",
        "Whole worksheets",
        (
            Column("worksheet", "", "", 0, stems),
            Column("positions", "", "", 0, np.array([row.setting for row in rows_5], object)),
            Column(
                "names",
                "-",
                "numbers and checks, each over all positions",
                0,
                np.array([len(wanted[s]) for s in stems]),
            ),
            Column("cells", "-", "cells run", 0, np.array(cells_5)),
            time_5,
            Column(
                "each",
                "µs",
                "time of a position",
                1,
                np.array([1e6 * r.seconds / n for r, (_, n) in zip(rows_5, cases, strict=True)]),
            ),
            error_5,
            Column("digits", "-", "digits that are right", 1, np.array([row.digits for row in rows_5])),
        ),
    )
    figure_5 = WorkPrecision("5", "Whole worksheets", time_5, (error_5,), rows=rows_5)
    least_5 = min(row.digits for row in rows_5)
    checks_5 = Check("5 Whole worksheets: digits lost of 16, at most", 16 - least_5, 4.0)
    typeset(figure_5, table_5, checks_5)
    return checks_5, figure_5, table_5


@app.cell(hide_code=True)
def section_6():
    mo.md("""
    ## 6 Leave out what is not needed

    A worksheet is a graph of cells. `evaluate` runs those that the results asked for depend on, and no others: here for
    the hitch, against the whole document with its tables and drawings.
    """)
    return


@app.cell
def wants(seconds):
    document = load(folder / "hitch.py")
    known_6 = {"g": document.inputs(), **sliders()}
    whole = [name for name in results(document.path) if name not in ("form", "g")]
    asked = {
        "lift arm's angle as a function": ["phi3"],
        "length of the lifting rod": ["L4"],
        "angle of the lift arm over the stroke": ["phi3_S"],
        "lifting capacity": ["GS6"],
        "steering stability": ["GS6_lim"],
        "all reactions": ["R56", "R07", "R34", "R05", "R01", "R03"],
        "one drawing": ["drawing_21"],
        "one table": ["table_41"],
        "whole document": whole,
    }
    times_6 = [
        time for _, time in timed([lambda want=want: document.run(want, known_6) for want in asked.values()], seconds)
    ]
    cells_6 = [len(document.needed(want, known_6)) for want in asked.values()]
    table_6 = Table(
        "6",
        "Cost of what is asked for",
        (
            Column("asked for", "", "", 0, np.array(list(asked), object)),
            Column("cells", "-", "cells run", 0, np.array(cells_6)),
            Column(
                "of all", "%", "cells run over those of the whole document", 0, 100 * np.array(cells_6) / cells_6[-1]
            ),
            Column("time", "ms", "median of the run times", 1, 1e3 * np.array(times_6)),
            Column("of whole", "%", "time over that of the whole document", 0, 100 * np.array(times_6) / times_6[-1]),
        ),
    )
    table_6
    return (table_6,)


@app.cell(hide_code=True)
def section_7():
    mo.md(r"""
    ## 7 Stiff and extreme scenes

    How many digits can a result keep? With inputs $x_i$, rounded to 16 digits, and the result $y$, no method keeps more
    than $16 - \log_{10}\kappa$ of them for sure, where

    $$\kappa = \sum_i \left| x_i \frac{\partial y}{\partial x_i} \right| / |y|$$

    is its condition number, taken here from derivatives at 50 digits. A small $\kappa$ with digits lost is the fault of
    a method; a large one is the nature of the scene. Each scene is a file in `tests/scenes`, run through the worksheet
    that it names, or through the library where it names a group. Lengths that a Find has found, the stroke of a
    position and the pin of a single group count as inputs of what follows, since they are rounded to 16 digits too.

    The product must keep the digits expected, less at most one. Where nothing exists, or can be told from rounding, it
    must say so in words. The printed formulas get every help: the lengths found, the right quadrants, the corrected
    signs. In the scene `through_dead_centre` the velocity equations are integrated in their place, by Radau's implicit
    method, for they are stiff.
    """)
    return


@app.cell
def scenes(g):
    scenes_7 = [extreme.read(path) for path in sorted((folder.parent / "tests" / "scenes").glob("*.toml"))]
    measured_7 = {}
    with progress(len(scenes_7), "scenes") as done:
        for scene in scenes_7:
            measured_7[scene.name] = extreme.measure(scene, folder, short=not g.full)
            done()
    outcomes_7 = [outcome for outcomes in measured_7.values() for outcome in outcomes]
    return measured_7, outcomes_7, scenes_7


@app.cell
def checks_of_scenes(outcomes_7):
    def lost(outcomes):
        return "; ".join(f"{o.scene} {o.case} {o.result}: {o.product:.1f} of {o.expected:.1f} digits" for o in outcomes)

    short = [o for o in outcomes_7 if not o.wanted and not o.holds]
    silent = [o for o in outcomes_7 if o.wanted and not o.holds]
    unsaid = "; ".join(f"{o.scene} {o.case}: {o.wanted!r} is not said" for o in silent)
    checks_7 = (
        Check("results that lose more than a digit beyond their condition", len(short), 0, reason=lost(short[:3])),
        Check("scenes that cannot exist, and nobody says so", len(silent), 0, reason=unsaid),
    )
    typeset(*checks_7)
    return (checks_7,)


@app.cell
def table_71(measured_7, scenes_7):
    def hardest(outcomes):
        """The result whose printed formula loses most beyond its condition, or the product where none is printed."""
        told = [o for o in outcomes if o.expected > extreme.SPARE and np.isfinite(o.condition)]
        return max(told, key=lambda o: (o.expected - o.printed if np.isfinite(o.printed) else -99, -o.product))

    shown = [(scene, measured_7[scene.name]) for scene in scenes_7 if not scene.says]
    picked = [hardest(outcomes) for _, outcomes in shown]
    margin = [min(o.product - o.expected for o in outcomes) for _, outcomes in shown]

    def texts(values):
        return np.array([*values], object)

    def numbers(values):
        return np.array([*values], float)

    table_71 = Table(
        "7.1",
        "Digits in stiff and extreme scenes",
        (
            Column("scene", "", "file in tests/scenes", 0, texts(s.name.replace("_", " ") for s, _ in shown)),
            Column("results", "-", "results measured", 0, numbers(len(outcomes) for _, outcomes in shown)),
            Column("result", "", "where the printed formulas lose most", 0, texts(o.result for o in picked)),
            Column("log κ", "-", "logarithm of its condition number", 1, np.log10([o.condition for o in picked])),
            Column("expected", "-", "digits expected", 1, numbers(o.expected for o in picked)),
            Column("printed", "-", "digits kept by the printed formulas", 1, numbers(o.printed for o in picked)),
            Column("product", "-", "digits kept by the product", 1, numbers(o.product for o in picked)),
            Column("margin", "-", "digits kept less digits expected, the least of all results", 1, numbers(margin)),
        ),
        note="A dash: the documents have no formula. The margin must not be less than -1.",
    )
    table_71
    return numbers, table_71, texts


@app.cell
def table_72(scenes_7, texts):
    table_72 = Table(
        "7.2",
        "What the scenes are",
        (
            Column("scene", "", "file in tests/scenes", 0, texts(s.name.replace("_", " ") for s in scenes_7)),
            Column("through", "", "worksheet or group", 0, texts(s.job.replace("_", " ") for s in scenes_7)),
            Column("what it is", "", "", 0, texts(s.about for s in scenes_7)),
        ),
    )
    table_72
    return (table_72,)


@app.cell
def figure_71(outcomes_7):
    figure_71 = extreme.Kept(outcomes_7)
    typeset(figure_71, caption("7.1", "Digits kept over digits expected, every result of every scene"))
    return (figure_71,)


@app.cell
def table_73(outcomes_7, texts):
    said = [o for o in outcomes_7 if o.wanted]
    table_73 = Table(
        "7.3",
        "What is said where nothing exists",
        (
            Column("scene", "", "file in tests/scenes", 0, texts(o.scene.replace("_", " ") for o in said)),
            Column("input", "", "value of the input that varies", 0, texts(o.case for o in said)),
            Column("words", "", "", 0, texts(o.words.split("; ")[0] for o in said)),
        ),
    )
    table_73
    return (table_73,)


@app.cell
def workbook():
    export("Accuracy", globals())
    return


if __name__ == "__main__":
    app.run()
