import marimo

__generated_with = "0.25.1"
app = marimo.App(width="medium", app_title="Joints of compartments", css_file="page.css")

with app.setup:
    from itertools import pairwise

    import marimo as mo
    import numpy as np
    from numpy import abs, arange, array, cos, exp, isfinite, isnan, nan, pi, sin, where
    from numpy import arcsin as asin

    np.seterr(divide="ignore", invalid="ignore")  # an axis at infinity or a joint without load is shown so

    from mechsheet import (
        Check, Drawing, Used, ask, bending, caption, check, circular_joint, export, index, inputs, neutral_axis, read,
        side_by_side, slider, sum_of_elements, summary, table, title_block, typeset,
    )  # fmt: skip
    from mechsheet.units import cm, deg, kgf


@app.cell(hide_code=True)
def title():
    title_block(
        "Joints of compartments",
        """
    Forces and stresses in the joints of aircraft compartments under a bending moment and an axial force, after the
    industry standard OST 92-9236-79: a rectangular joint of beams and stringers, whose elements carry with one area
    in tension and with another in compression (appendices 1 and 3), and a circular joint, whose bolts carry the
    tension and whose rims the compression (appendix 2), each with as many elements and load cases as are given.
    Change an input or a formula: everything below follows.
    """,
    )
    return


@app.cell(hide_code=True)
def verdict(checks_joint, checks_ring):
    summary(checks_joint, checks_ring)
    return


@app.cell(hide_code=True)
def section_1():
    mo.md("""
    ## 1 Input data

    The circular joint is an example of ours; all other numbers are the document's. An axial force is positive in
    tension. Inputs are in the document's units; the last one shows all results in SI units.

    Tables are the arrays that the document's programs read, a row an element or a load case; add or delete rows, or
    paste them. The programs read the levels of the elements for each plane of the load; here a row gives both. In the
    plane ZOX the document counts the other way round: its beams 1 to 4 are 1, 4, 3, 2 here, its stringers 1 to 8 are
    2, 1, 8, 7, 6, 5, 4, 3.
    """)
    return


@app.class_definition
@inputs
class Beam:
    y: float  # [cm] level in the plane YOX
    z: float  # [cm] level in the plane ZOX
    F: float  # [cm**2] area, steel; > 0
    k_t: float  # [-] parts of the additional area in tension; >= 0
    k_c: float  # [-] parts of the additional area in compression; >= 0

    """A row of the beams."""


@app.class_definition
@inputs
class Stringer:
    y: float  # [cm] level in the plane YOX
    z: float  # [cm] level in the plane ZOX
    F: float  # [cm**2] area, aluminium; >= 0
    k_t: float  # [-] part of it that is joined in tension; >= 0
    k_c: float  # [-] part of it, with its skin, that is pressed; >= 0

    """A row of the stringers."""


@app.class_definition
@inputs
class Load:
    M: float  # [kgf*cm] bending moment
    N: float  # [kgf] axial force
    M_w: float  # [kgf*cm] moment of the third array

    """A load case of the rectangular joint."""


@app.class_definition
@inputs
class RingLoad:
    M: float  # [kgf*cm] bending moment
    N: float  # [kgf] axial force

    """A load case of the circular joint."""


@app.class_definition
@inputs
class Joint:
    # 1.1 Rectangular joint
    beams: list[Beam] = [
        Beam(25 * cm, 12.5 * cm, 1 * cm**2, 1, 1),
        Beam(-25 * cm, 12.5 * cm, 1 * cm**2, 1, 1),
        Beam(-25 * cm, -12.5 * cm, 1 * cm**2, 1, 1),
        Beam(25 * cm, -12.5 * cm, 1 * cm**2, 1, 1),
    ]  # beams, as they are numbered
    stringers: list[Stringer] = [
        Stringer(25 * cm, 6.25 * cm, 0.5 * cm**2, 0, 1),
        Stringer(12.5 * cm, 12.5 * cm, 0.5 * cm**2, 0, 1),
        Stringer(-12.5 * cm, 12.5 * cm, 0.5 * cm**2, 0, 1),
        Stringer(-25 * cm, 6.25 * cm, 0.5 * cm**2, 0, 1),
        Stringer(-25 * cm, -6.25 * cm, 0.5 * cm**2, 0, 1),
        Stringer(-12.5 * cm, -12.5 * cm, 0.5 * cm**2, 0, 1),
        Stringer(12.5 * cm, -12.5 * cm, 0.5 * cm**2, 0, 1),
        Stringer(25 * cm, -6.25 * cm, 0.5 * cm**2, 0, 1),
    ]  # stringers, as they are numbered
    delta: float = 0.1 * cm  # [cm] thickness of the skin; >= 0
    E_al: float = 0.72e6 * kgf / cm**2  # [kgf/cm**2] modulus of skin and stringers, aluminium; > 0
    E_st: float = 2.1e6 * kgf / cm**2  # [kgf/cm**2] modulus of the beams, steel; > 0
    psi: float = 0.65  # [-] part of a side whose skin works with the beams in tension; >= 0 <= 1
    k_a: float = 30  # [-] width of skin that works with an element in compression, in thicknesses; >= 0

    # 1.2 Rounding of the document's example
    d_E: float = 0.01  # [-] step of the ratio of the moduli, 0 for all digits; >= 0
    d_F: float = 0.01 * cm**2  # [cm**2] step of the beam's reduced additional area, 0 for all digits; >= 0

    # 1.3 Loads of the rectangular joint
    loads: list[Load] = [
        Load(5e5 * kgf * cm, 13e3 * kgf, 0),
        Load(3e5 * kgf * cm, -13e3 * kgf, 0),
    ]  # load cases

    # 1.4 Search for the neutral axis
    y_noo: float = 0 * cm  # [cm] first neutral axis
    k_max: int = 10  # [-] number of iterations; >= 1 <= 100

    # 1.5 Circular joint, an example of ours
    r: float = 60 * cm  # [cm] radius of the joint; > 0
    bolts: list[float] = [15 * k * deg for k in range(24)]  # [deg] angles of the bolts; >= -360 <= 360
    alpha: list[float] = [0, -7.5 * deg]  # [deg] angles of the planes of the load; >= -360 <= 360
    t: float = 15 * cm  # [cm] pitch of the stringers; > 0
    ring_loads: list[RingLoad] = [
        RingLoad(2e6 * kgf * cm, -2e4 * kgf),
        RingLoad(1.2e6 * kgf * cm, 2.5e4 * kgf),
    ]  # load cases of the circular joint

    # 1.6 Units of the results
    SI: int = 0  # [-] units of the results, 1 for SI and 0 for kgf, cm; >= 0 <= 1

    """After # stand the unit and the meaning, after ; the limits; the page and the code take the same units."""


@app.function
def rounded(x, step):
    """Number rounded to a step; a step of 0 keeps it."""
    return step * np.round(x / step) if step else x


@app.function
def planes(first, second):
    """Values of the elements in the two planes of the load, on the first axis of three: plane, load case, element."""
    return array([first, second])[:, None]


@app.function
def cases(x):
    """Values of the load cases, on the second axis."""
    return x[:, None]


@app.function
def counted(x):
    """Numbers along the first axis of x, from 1."""
    return arange(1, len(x) + 1).reshape(-1, *[1] * (x.ndim - 1))


@app.function
def of_cases(x):
    """Results of the load cases, with an axis of one element more."""
    return x[..., None]


@app.function
def elements(beams, stringers):
    """Values of the beams, behind them those of the stringers, on the last axis."""
    return np.concatenate([beams, stringers], axis=-1)


@app.function
def total(x):
    """Sum over the elements, which stay an axis of one."""
    return sum_of_elements(x)[..., None]


@app.function
def greatest(x):
    """Greatest of the elements."""
    return x.max(-1, keepdims=True)


@app.function
def positive(x):
    """Positive part."""
    return where(x > 0, x, 0)


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
def units_shown(g):
    si = {"kgf": "N", "cm": "mm", "cm**2": "mm**2", "cm**3": "mm**3", "cm**4": "mm**4"}
    si |= {"kgf*cm": "N*m", "kgf/cm": "N/mm", "kgf/cm**2": "MPa"}
    display = si if g.SI else {}
    unit_F, unit_M, unit_p = (display.get(unit, unit) for unit in ("kgf", "kgf*cm", "kgf/cm"))
    return display, unit_F, unit_M, unit_p


@app.cell(hide_code=True)
def section_17():
    mo.md(r"""
    ### 1.7 Load cases

    For each case the program reads three loads: a moment, a force, and a third one, which is 0 in both cases of the
    example. What it stood for is lost with the beginning of the listing; here it is one more moment in the plane of
    the load, which is added.
    """)
    return


@app.cell
def load_cases(display, g):
    M_b = cases(g.loads.M)  # [kgf*cm] bending moment of the first array
    M_w = cases(g.loads.M_w)  # [kgf*cm] moment of the third array
    M = M_b + M_w  # [kgf*cm] bending moment
    N = cases(g.loads.N)  # [kgf] axial force, positive in tension
    plane = arange(1, 3)[:, None, None]  # [-] plane of the load: 1 is YOX, 2 is ZOX
    case = counted(M)  # [-] load case
    typeset(display=display)
    return M, N, case, plane


@app.cell(hide_code=True)
def section_2():
    mo.md(r"""
    ## 2 Reduced areas (sheets 55, 56)

    Skin and stringers are of an aluminium alloy of the strength 4200 kgf/cm² and the yield strength 3000 kgf/cm², the
    beams of a steel of 11000 and 8500 kgf/cm² (names of these in the scan are hardly readable). The example compares
    no stress with them.

    All areas are reduced to steel. In tension a beam works together with the skin beside it and with each stringer
    that stands within the width of that skin, on a side where the beam stands itself: no farther from its line than
    the skin is thick. The stringers themselves are not joined in tension. In compression every element works with a
    strip of skin.

    Where a beam has more or less of this, or a stringer is joined, its row in 1.1 says how many parts.
    """)
    return


@app.cell
def reduced_areas(display, g):
    beta = rounded(g.E_al / g.E_st, g.d_E)  # [-] aluminium reduced to steel
    h = np.ptp(g.beams.y)  # [cm] side along Y, between the beams
    b = np.ptp(g.beams.z)  # [cm] side along Z, between the beams
    l_b = 0.5 * g.psi * b  # [cm] width of skin on the side b
    l_h = 0.5 * g.psi * h  # [cm] width of skin on the side h
    d_y = abs(cases(g.beams.y) - g.stringers.y)  # [cm] from each beam to each stringer, along Y
    d_z = abs(cases(g.beams.z) - g.stringers.z)  # [cm] from each beam to each stringer, along Z
    on_b, on_h = (d_y <= g.delta) & (d_z <= l_b), (d_z <= g.delta) & (d_y <= l_h)
    F_sb = sum_of_elements(g.stringers.F * on_b)  # [cm**2] stringers of the side b within the width
    F_sh = sum_of_elements(g.stringers.F * on_h)  # [cm**2] stringers of the side h within the width
    w_h = where(on_h, d_y, l_h).min(-1)  # [cm] width of skin on the side h, up to the first stringer
    F_sk = (l_b + w_h) * g.delta  # [cm**2] skin, added up as the document does
    dF_t = F_sk + F_sb + F_sh  # [cm**2] additional area of a beam in tension
    dF_tr = rounded(beta * dF_t, g.d_F)  # [cm**2] the same, reduced
    dF_cr = beta * g.k_a * g.delta**2  # [cm**2] additional area of an element in compression, reduced
    F_bt = g.beams.F + g.beams.k_t * dF_tr  # [cm**2] beams in tension
    F_bc = g.beams.F + g.beams.k_c * dF_cr  # [cm**2] beams in compression
    F_st = g.stringers.k_t * beta * g.stringers.F  # [cm**2] stringers in tension
    F_sc = g.stringers.k_c * (beta * g.stringers.F + dF_cr)  # [cm**2] stringers in compression
    typeset(display=display)
    return F_bc, F_bt, F_sb, F_sc, F_sh, F_st, b, beta, h, l_b, l_h, w_h


@app.cell(hide_code=True)
def section_21():
    mo.md("""
    ### 2.1 The example's own numbers

    The document prints 8.15 cm and 16.3 cm for the widths 8.125 cm and 16.25 cm. It then adds the whole width of skin
    on the side *b*, but on the side *h* only the part up to the stringer, 8.15 + 12.5. The rule for the width stood in
    a part of the standard that is lost, so the sum is kept as printed. The table has beam 1 in three ways: 1 with the
    example's own numbers, 2 with those of this worksheet, 3 with both widths whole. With the rounding of 1.2 the
    first two give the same area; the third does not.
    """)
    return


@app.cell
def printed_areas(F_sb, F_sh, beta, display, g, l_b, l_h, w_h):
    way = arange(1, 4)  # [-] 1 as printed, 2 as above, 3 with both widths whole
    l_be = array([8.15 * cm, l_b, l_b])  # [cm] width of skin on the side b; 8.15 is an erratum
    w_he = array([12.5 * cm, w_h[0], l_h])  # [cm] width of skin on the side h
    F_ske = (l_be + w_he) * g.delta  # [cm**2] skin
    dF_te = F_ske + F_sb[0] + F_sh[0]  # [cm**2] additional area in tension
    dF_tre = rounded(beta * dF_te, g.d_F)  # [cm**2] the same, reduced
    F_bte = g.beams.F[0] + g.beams.k_t[0] * dF_tre  # [cm**2] beam 1 in tension
    typeset(display=display)
    table_21 = table("2.1", "Beam 1 in tension, as printed and right", way, l_be, w_he, F_ske, dF_te, dF_tre, F_bte)
    table_21
    return


@app.cell
def section_of_elements(F_bc, F_bt, F_sc, F_st, display, g):
    y_b = planes(g.beams.y, g.beams.z)  # [cm] level of the beams in the plane of the load
    y_s = planes(g.stringers.y, g.stringers.z)  # [cm] level of the stringers in the plane of the load
    z_b = planes(g.beams.z, g.beams.y)  # [cm] place of the beams across the plane
    z_s = planes(g.stringers.z, g.stringers.y)  # [cm] place of the stringers across the plane
    y = elements(y_b, y_s)  # [cm] level of the elements
    z = elements(z_b, z_s)  # [cm] place of the elements across the plane
    A_t = elements(F_bt, F_st)  # [cm**2] areas in tension
    A_c = elements(F_bc, F_sc)  # [cm**2] areas in compression
    typeset(display=display)
    return A_c, A_t, y, z


@app.cell(hide_code=True)
def section_3():
    mo.md(r"""
    ## 3 Neutral axis (appendix 1)

    The section stays plane and every element carries with the area that belongs to the sign of its stress. Which
    area that is depends on the neutral axis, and the axis on the areas.

    The forces are unique. The stress $\sigma = a + b y$ has the energy $\frac12 \sum A_i \sigma_i^2$, which is
    convex in $a$ and $b$ although the areas change with the sign, and its derivatives are $N$ and $M$: two
    equilibria could not have different forces. An area changes only where the axis passes an element. Each such
    place answers to a ray of loads, in order round the plane of $N$ and $M$; between two neighbouring rays no area
    changes and one linear problem holds. So the rays beside the given load name the areas at once, in a number of
    steps known beforehand.
    """)
    return


@app.cell
def equilibrium(A_c, A_t, M, N, display, y):
    joint = neutral_axis(y, A_t, A_c, M[:, 0], N[:, 0])
    A = joint.area  # [cm**2] areas that act
    F = total(A)  # [cm**2] area of the section
    S = total(A * y)  # [cm**3] first moment of area
    y_c = S / F  # [cm] centroid
    I_z = total(A * (y - y_c) ** 2)  # [cm**4] second moment of area about the centroid
    M_z = M - N * y_c  # [kgf*cm] reduced moment, about the centroid
    y_no = y_c - N * I_z / (F * M_z)  # [cm] neutral axis
    y_1no = y_no - y_c  # [cm] neutral axis from the centroid
    sigma = N / F + M_z * (y - y_c) / I_z  # [kgf/cm**2] stress
    P = sigma * A  # [kgf] force in an element
    typeset(display=display)
    return A, F, I_z, M_z, P, S, joint, sigma, y_no, y_1no, y_c


@app.cell
def table_31(F, I_z, M, M_z, N, S, case, joint, plane, y_no, y_1no, y_c):
    table_31 = table("3.1", "Section in equilibrium", plane, case, M, N, M_z, y_no, y_1no, y_c, F, S, I_z)
    _found = [f"- plane {p + 1}, case {k + 1}: {state}" for (p, k), state in np.ndenumerate(joint.state)]
    typeset(table_31, "\n".join(_found))
    return


@app.cell(hide_code=True)
def section_31():
    mo.md(r"""
    ### 3.1 Sheet 57 as it reads

    For plane 1 and case 1 the scan reads $F$ = 6.928 cm² and $y_\mathrm{c}$ = 4.677 cm, line 1 of the table; line 2 is
    that of table 3.1. Only with the latter follow the other printed numbers: $S$ = 33.3 cm³, the reduced moment
    $M_\mathrm{z}$ = 4.366·10⁵ kgf·cm, the axis $y_\mathrm{1no}$ = −17.9 cm from the centroid with $I_\mathrm{z}$ =
    4105 cm⁴. One digit of each is misread. The sheet prints −17.9 cm twice, under two names: in equilibrium the areas
    give the axis that was assumed for them.
    """)
    return


@app.cell
def printed_section(F, I_z, M, N, display, y_c):
    line = arange(1, 3)  # [-] 1 as the scan reads, 2 as computed
    F_e = array([6.928 * cm**2, F[0, 0, 0]])  # [cm**2] area of the section; 6.928 is an erratum
    y_ce = array([4.677 * cm, y_c[0, 0, 0]])  # [cm] centroid; 4.677 is an erratum
    S_e = F_e * y_ce  # [cm**3] first moment of area that follows
    M_ze = M[0, 0] - N[0, 0] * y_ce  # [kgf*cm] reduced moment that follows
    y_1noe = -N[0, 0] * I_z[0, 0, 0] / (F_e * M_ze)  # [cm] neutral axis from the centroid that follows
    typeset(display=display)
    table_32 = table("3.2", "Plane 1, case 1, as the scan reads and right", line, F_e, y_ce, S_e, M_ze, y_1noe)
    table_32
    return


@app.cell(hide_code=True)
def section_32():
    mo.md(r"""
    ### 3.2 Iteration of the axis

    The document's program starts from an assumed axis $y_\mathrm{noo}$, with a first step of 5 cm, an accuracy of 0.001
    cm and 10 iterations, and prints an objective function beside the axis of each. What function, and how it is made
    least, is lost with the beginning of the listing. Here the areas that belong to an axis are taken, the axis of that
    section is found, and so again.

    This is Newton's method for a system that is linear piece by piece: once the areas repeat, they are the right ones,
    and the axis stays. Mostly they do after a few steps, but there is no axis where the areas that are met cannot
    carry the load, and no proof says that they always repeat. It is shown for comparison; the results do not use it.
    """)
    return


@app.cell
def iteration(A_c, A_t, M, N, g, y):
    def iterated():
        """Neutral axes of the successive steps, and from which step on the areas repeat."""
        stretched, axes, settled = (y - g.y_noo) * where(M < 0, -1, 1) > 0, [], []
        for _ in range(g.k_max):
            step = bending(y, where(stretched, A_t, A_c), M[:, 0], N[:, 0])
            before, stretched = stretched, step.sigma > 0
            axes.append(step.y_0[..., None])
            settled.append(((stretched == before) & isfinite(step.sigma)).all(-1, keepdims=True))
        ends = array(settled)
        return array(axes), where(ends.any(0), ends.argmax(0) + 1, 0)

    axes, steps = iterated()
    return axes, steps


@app.cell
def iteration_shown(axes, case, display, plane, steps):
    y_k = axes  # [cm] neutral axis of the step
    n_k = steps  # [-] steps until the areas repeat, 0 where they do not
    step = counted(axes)  # [-] step
    typeset(display=display)
    table_33 = table("3.3", "Iteration of the neutral axis", step, plane, case, y_k, n_k)
    table_33
    return


@app.cell(hide_code=True)
def section_33():
    mo.md("""
    ### 3.3 Check: equilibrium, and the sign of every stress
    """)
    return


@app.cell
def joint_check(A, A_c, A_t, M, N, P, joint, sigma, unit_F, unit_M, y):
    lost = isnan(joint.sigma).any(-1)
    reason = "; ".join(
        f"plane {p + 1}, case {k + 1}: no elements carry M = {M[k, 0] / (kgf * cm):.7g} kgf*cm"
        f" with N = {N[k, 0] / kgf:.7g} kgf"
        for p, k in np.argwhere(lost)
    )
    opposite = (A - where(sigma > 0, A_t, A_c)) * sigma
    largest = np.max(total(abs(P)))
    checks_joint = (
        Check("equilibrium exists", np.count_nonzero(lost), 0, "cases", reason, essential=True),
        check("equilibrium of forces", total(P) - N, 1e-12, unit_F, of=largest),
        check("equilibrium of moments", total(P * y) - M, 1e-12, unit_M, of=largest * np.ptp(y)),
        check("areas belong to the signs of the stresses", opposite, 1e-12, unit_F, of=largest),
    )
    typeset(*checks_joint)
    return (checks_joint,)


@app.cell(hide_code=True)
def section_4():
    mo.md(r"""
    ## 4 Results (appendix 3, item 6)

    Stresses are reduced to steel; the stress in the aluminium itself is $\beta$ times as much. A stretched stringer
    that is not joined carries nothing.
    """)
    return


@app.cell
def of_elements(A, P, beta, display, g, sigma):
    beam = counted(g.beams.y)  # [-] beam
    n_b = len(beam)  # [-] number of beams
    P_b = P[..., :n_b]  # [kgf] force in the beam
    sigma_b = sigma[..., :n_b]  # [kgf/cm**2] stress in the beam
    A_b = A[..., :n_b]  # [cm**2] area of the beam that acts
    stringer = counted(g.stringers.y)  # [-] stringer
    P_s = P[..., n_b:]  # [kgf] force in the stringer
    A_s = A[..., n_b:]  # [cm**2] area of the stringer that acts
    sigma_s = sigma[..., n_b:] * (A_s > 0)  # [kgf/cm**2] stress in the stringer, reduced to steel
    sigma_al = beta * sigma_s  # [kgf/cm**2] stress in the aluminium
    typeset(display=display)
    return A_b, A_s, P_b, P_s, beam, sigma_al, sigma_b, sigma_s, stringer


@app.cell
def tables_1_2(A_b, A_s, P_b, P_s, beam, case, plane, sigma_al, sigma_b, sigma_s, stringer):
    table_1 = table("1", "Forces and stresses in the beams", plane, case, beam, A_b, P_b, sigma_b)
    table_2 = table("2", "Forces and stresses in the stringers", plane, case, stringer, A_s, P_s, sigma_s, sigma_al)
    typeset(table_1, table_2)
    return


@app.cell(hide_code=True)
def section_41():
    mo.md("""
    ### 4.1 The section with its neutral axis and stresses

    The load acts in the vertical plane. Red is tension, blue compression; an element without colour does not carry.
    The diagram on the right shows the stress over the height.
    """)
    return


@app.cell
def drawn_case(N):
    drawn = slider(1, len(N), step=1, label="load case")
    drawn
    return (drawn,)


@app.cell
def scheme(A, g, sigma, y, y_no, z):
    def scheme(p, k, side, across):
        """Section in plane p under load case k; side and across name its dimensions."""
        lowest, highest = np.argmin(y[p, 0]), np.argmax(y[p, 0])
        low, high = y[p, 0, lowest], y[p, 0, highest]
        left, right = np.min(z[p]), np.max(z[p])
        size, reach = max(high - low, right - left), (right - left) / 2
        corners = array([left + 1j * low, left + 1j * high, right + 1j * high, right + 1j * low])
        picture = Drawing(width=760, height=420).polygon(corners)
        picture = picture.dimension(corners[0], corners[1], side).dimension(corners[3], corners[0], across)
        square = size * array([-1 - 1j, 1 - 1j, 1 + 1j, -1 + 1j])
        parts = np.repeat([0.015, 0.009], [len(g.beams.y), len(g.stringers.y)])
        for place, part, stress, area in zip(z[p, 0] + 1j * y[p, 0], parts, sigma[p, k], A[p, k], strict=True):
            colour = ("red" if stress > 0 else "blue") if area else ""
            picture = picture.polygon(place + part * square, colour=colour)
        axis = y_no[p, k, 0]
        inside = low < axis < high
        if inside:
            line = (left + right) / 2 + 1.3 * reach * array([-1, 1]) + 1j * axis
            picture = picture.path(line, "n.a.", "green")
        base, scale = right + 0.6 * reach + 0.2 * size, 0.3 * size / np.nanmax(abs(sigma))
        levels = array([low, axis if inside else high, high])
        stress = np.interp(levels, [low, high], [sigma[p, k, lowest], sigma[p, k, highest]])
        for (bottom, top), (s_bottom, s_top) in zip(pairwise(levels), pairwise(stress), strict=True):
            outline = [base + 1j * bottom, base + scale * s_bottom + 1j * bottom]
            outline += [base + scale * s_top + 1j * top, base + 1j * top]
            picture = picture.polygon(outline, colour="red" if s_bottom + s_top > 0 else "blue")
        for level, value, way in ((low, stress[0], -1), (high, stress[-1], 1)):
            text = f"{value / 1e6:.5g} MPa" if g.SI else f"{value / (kgf / cm**2):.5g} kgf/cm²"
            picture = picture.text(base + 1j * (level + way * 0.03 * size), text.replace("-", "−"))
        return picture

    return (scheme,)


@app.cell
def drawings_41_42(drawn, scheme):
    drawing_41 = scheme(0, drawn.value - 1, "h", "b")
    drawing_42 = scheme(1, drawn.value - 1, "b", "h")
    typeset(
        *(drawing_41, caption("4.1", f"Load in the plane YOX, case {drawn.value}")),
        *(drawing_42, caption("4.2", f"Load in the plane ZOX, case {drawn.value}")),
    )
    return


@app.cell(hide_code=True)
def section_5():
    mo.md(r"""
    ## 5 Circular joint (appendix 2)

    The scan has lost signs here, so the method is derived again from equilibrium. A uniform ring would carry the
    line load $q = (M\cos\varphi + N r/2)/\pi r^2$, which is proportional to $\cos\varphi + c$ with $c = N r / 2 M$.
    The bolts where $q > 0$ pull in proportion to $q$, the rims press on each other in proportion to $q$ where $q <
    0$; what a bolt and what the rim carries for one unit of $q$ follows from the equilibrium of forces and of
    moments.

    Where $c \ge 1$ all bolts pull and carry the load alone, with forces linear in $\cos\varphi$; where $c \le -1$ all
    is compressed and the rims carry $q$ itself; where $M = 0$ the load is spread evenly. Written with $q$, nothing is
    divided by $M$. Bolts at uneven angles are solved approximately: $M_\mathrm{x}$ is the moment across the plane of
    the load that they leave over. A line load in compression is negative.

    For compartments with a framework whose stiffness is not known yet this is a first approximation: a stringer
    carries the line load over its pitch.
    """)
    return


@app.cell
def ring_loads(display, g):
    M_r = cases(g.ring_loads.M)  # [kgf*cm] bending moment
    N_r = cases(g.ring_loads.N)  # [kgf] axial force, positive in tension
    phi = g.bolts - g.alpha[:, None, None]  # [deg] angle of the bolts from the plane of the load
    plane_r = counted(phi)  # [-] plane of the load
    load = counted(M_r)  # [-] load case
    bolt = counted(g.bolts)  # [-] bolt
    m = len(g.bolts)  # [-] number of bolts
    typeset(display=display)
    return M_r, N_r, bolt, load, m, phi, plane_r


@app.cell
def ring_equilibrium(M_r, N_r, display, g, phi):
    ring = circular_joint(g.r, phi, M_r[:, 0], N_r[:, 0])
    c = N_r * g.r / (2 * M_r)  # [-] force parameter of the joint
    y_rno = -(N_r * g.r**2 / (2 * M_r))  # [cm] neutral axis
    phi_no = of_cases(ring.phi_0)  # [deg] angle of the neutral axis, half of the pulled arc
    P_k = ring.P  # [kgf] force in a bolt
    P_max = greatest(P_k)  # [kgf] greatest force in a bolt
    p_o = of_cases(ring.p_0)  # [kgf/cm] greatest line load of the compressed arc
    P_str = p_o * g.t  # [kgf] force on a stringer there
    M_x = of_cases(ring.M_x)  # [kgf*cm] moment across the plane, left over
    typeset(display=display)
    return M_x, P_k, P_max, P_str, c, p_o, phi_no, ring, y_rno


@app.cell
def ring_states(ring):
    held = [f"- plane {p + 1}, case {k + 1}: {state}" for (p, k), state in np.ndenumerate(ring.state)]
    mo.md("\n".join(held))
    return


@app.cell(hide_code=True)
def section_52():
    mo.md("""
    ### 5.2 The document's formulas, and the equivalent forces

    The document's formulas with their signs restored hold where the moment is positive and one part is pulled, the
    other compressed; elsewhere they are left empty. The equivalent forces are those of a uniform ring where it is
    loaded most; the last two columns compare the bolts and the rims with it.
    """)
    return


@app.cell
def ring_printed(M_r, N_r, P_max, c, display, g, m, p_o, phi, ring):
    holds = (ring.state == "tension and compression")[..., None] & (M_r > 0)
    c_n = where(holds, c, nan)  # [-] force parameter, where the formulas hold
    phi_n = 0.5 * pi + asin(c_n)  # [deg] angle of the neutral axis
    k_0 = c_n * (pi - phi_n) - sin(phi_n)  # [-] compressed arc, sum of cos(phi) + c
    k_1 = (0.5 * (pi - phi_n) - 0.25 * sin(2 * phi_n) - c_n * sin(phi_n)) / k_0  # [-] lever of the compressed arc
    k_2 = (1 - c_n) / (2 * k_0)  # [-] greatest line load of the arc to its resultant
    S_1 = total(positive(cos(phi) + c_n))  # [-] pulled bolts
    S_2 = total(positive(cos(phi) + c_n) * cos(phi))  # [-] their levers
    P_1 = (M_r / g.r - k_1 * N_r) / (S_2 - k_1 * S_1)  # [kgf] force of a bolt for cos(phi) + c = 1
    P_n = P_1 * (greatest(cos(phi)) + c_n)  # [kgf] greatest force in a bolt
    p_n = k_2 * (S_1 * P_1 - N_r) / g.r  # [kgf/cm] greatest line load
    N_e1 = N_r + 2 * abs(M_r) / g.r  # [kgf] equivalent force in tension
    P_e = N_e1 / m  # [kgf] force in a bolt from it
    N_e2 = N_r - 2 * abs(M_r) / g.r  # [kgf] equivalent force in compression
    p_e = N_e2 / (2 * pi * g.r)  # [kgf/cm] line load from it
    i_P = P_max / P_e  # [-] greatest force in a bolt to the equivalent one
    i_p = p_o / p_e  # [-] greatest line load to the equivalent one
    typeset(display=display)
    return N_e1, N_e2, P_e, P_n, holds, i_P, i_p, k_0, p_e, p_n


@app.cell
def tables_51_52(M_r, M_x, N_e1, N_e2, N_r, P_e, P_max, P_str, c, i_P, i_p, load, p_e, p_o, phi_no, plane_r, y_rno):
    table_51 = table("5.1", "Circular joint", plane_r, load, M_r, N_r, c, y_rno, phi_no, P_max, p_o, P_str, M_x)
    table_52 = table("5.2", "Equivalent forces", plane_r, load, N_e1, P_e, N_e2, p_e, i_P, i_p)
    typeset(table_51, table_52)
    return


@app.cell(hide_code=True)
def section_53():
    mo.md("""
    ### 5.3 Check: equilibrium of the ring
    """)
    return


@app.cell
def ring_check(M_r, N_r, P_k, P_max, P_n, g, holds, k_0, p_n, p_o, phi, ring, unit_F, unit_M, unit_p):
    failed = isnan(ring.R)
    why = "; ".join(
        f"plane {p + 1}, case {k + 1}: {ring.state[p, k]} for M = {M_r[k, 0] / (kgf * cm):.7g} kgf*cm"
        f" with N = {N_r[k, 0] / kgf:.7g} kgf"
        for p, k in np.argwhere(failed)
    )
    forces = total(P_k) + ring.R[..., None]
    moments = total(P_k * g.r * cos(phi)) + ring.M_R[..., None]
    most = np.max(total(abs(P_k)) + abs(ring.R[..., None]))
    digits = 1e-13 / np.min(where(holds, abs(k_0), 1))  # the document's k_1 and k_2 lose digits as the arc closes
    checks_ring = (
        Check("ring in equilibrium exists", np.count_nonzero(failed), 0, "cases", why, essential=True),
        check("equilibrium of forces in the ring", forces - N_r, 1e-12, unit_F, of=most),
        check("equilibrium of moments in the ring", moments - M_r, 1e-12, unit_M, of=most * g.r),
    )
    if np.any(holds):
        checks_ring += (
            check("document's greatest bolt force", where(holds, P_n - P_max, 0), digits, unit_F, of=most),
            check("document's greatest line load", where(holds, p_n - p_o, 0), digits, unit_p, of=most / g.r),
        )
    typeset(*checks_ring)
    return (checks_ring,)


@app.cell(hide_code=True)
def section_54():
    mo.md("""
    ### 5.4 Force in every bolt, and the ring with its load

    Red bars outside are the forces of the bolts, the blue area inside is the line load of the rims, both for the
    load case chosen here, with the greatest of each; the load acts in the vertical plane.
    """)
    return


@app.cell
def drawn_ring_case(N_r):
    drawn_ring = slider(1, len(N_r), step=1, label="load case")
    drawn_ring
    return (drawn_ring,)


@app.cell
def ring_scheme(M_r, N_r, P_k, g, p_o, phi, phi_no, y_rno):
    def ring_scheme(p, k):
        def out(angle, radius):
            return radius * 1j * exp(-1j * angle)  # angles from the vertical, clockwise

        picture = Drawing(width=430, height=430, frame=1.4 * g.r * array([-1 - 1j, 1 + 1j]))
        picture = picture.path(out(np.linspace(0, 2 * pi, 181), g.r), colour="")

        if p_o[p, k, 0] < 0:
            middle, half = (pi if M_r[k, 0] >= 0 else 0), pi - phi_no[p, k, 0]
            arc = middle + half * np.linspace(-1, 1, 91)
            load = N_r[k, 0] * g.r / 2 + M_r[k, 0] * cos(arc)
            depth = 0.3 * load / load[45] * p_o[p, k, 0] / np.nanmin(p_o)
            picture = picture.polygon([*out(arc, g.r), *out(arc, g.r * (1 - depth))[::-1]], colour="blue")
            value = p_o[p, k, 0]
            text = f"{value / 1e3:.5g} N/mm" if g.SI else f"{value / (kgf / cm):.5g} kgf/cm"
            picture = picture.text(out(middle, 0.5 * g.r), text.replace("-", "−"))
        greatest_at = np.argmax(P_k[p, k] > (1 - 1e-9) * np.max(P_k[p, k]))  # the first of bolts that are alike
        for i, (angle, force) in enumerate(zip(phi[p, 0], P_k[p, k], strict=True)):
            picture = picture.hinge(out(angle, g.r))
            end = out(angle, g.r * (1 + 0.35 * force / np.nanmax(P_k)))
            text = f"{force:.0f} N" if g.SI else f"{force / kgf:.5g} kgf"
            if force > 0:
                picture = picture.path([out(angle, g.r), end], text if i == greatest_at else "", "red")
        axis = y_rno[k, 0]
        if abs(axis) < g.r:
            picture = picture.path([-1.1 * g.r + 1j * axis, 1.1 * g.r + 1j * axis], "n.a.", "green")
        return picture

    return (ring_scheme,)


@app.cell
def drawing_51(drawn_ring, phi, ring_scheme):
    drawing_51 = tuple(ring_scheme(p, drawn_ring.value - 1) for p in range(len(phi)))
    _caption = caption("5.1", f"Load in each plane, case {drawn_ring.value}")
    typeset(side_by_side(*drawing_51), _caption)
    return


@app.cell
def table_53(P_k, bolt, load, phi, plane_r):
    table_53 = table("5.3", "Forces in the bolts", plane_r, load, bolt, phi, P_k)
    table_53
    return


@app.cell(hide_code=True)
def listed():
    index()
    return


@app.cell
def workbook():
    export("Joints of compartments", globals())
    return


if __name__ == "__main__":
    app.run()
