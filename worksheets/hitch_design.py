import marimo

__generated_with = "0.25.1"
app = marimo.App(width="medium", app_title="Design of a tractor hitch", css_file="page.css")

with app.setup:
    import tomllib
    from pathlib import Path

    import marimo as mo
    import numpy as np
    from numpy import abs, arcsin, max, min, minimum, sin

    from mechsheet import (
        Check,
        Column,
        Judged,
        Limit,
        Requirement,
        SheetError,
        Table,
        Used,
        ask,
        declared,
        evaluate,
        export,
        figure,
        inputs,
        load,
        pareto,
        progress,
        read,
        refuse,
        save_scene,
        scene_text,
        search,
        sensitivity,
        summary,
        sweep,
        table,
        title_block,
        tolerance,
        typeset,
    )
    from mechsheet.units import deg, shown


@app.cell(hide_code=True)
def title():
    title_block(
        "Design of a tractor hitch",
        """
    Chooses lengths and hinge positions of the hitch within bounds, so that every requirement holds at every position
    and the least reserve becomes greatest. All numbers come from the worksheet `hitch`: its cells are run for
    a generation of variants at once. Change a bound or a requirement: the search starts again, the same inputs give the
    same design.
    """,
    )
    return


@app.cell(hide_code=True)
def verdict(checks_design, checks_scene):
    summary(checks_design, checks_scene)
    return


@app.cell(hide_code=True)
def section_1():
    mo.md("""
    ## 1 Input data
    """)
    return


@app.class_definition
@inputs
class Choice:
    # 1.1 Bounds of what is chosen
    L3_min: float = 0.18  # [m] lift arm, to the cylinder pin, least; > 0 <= L3_max
    L3_max: float = 0.22  # [m] lift arm, to the cylinder pin, greatest; > 0
    L34_min: float = 0.28  # [m] lift arm, to the lifting rod, least; > 0 <= L34_max
    L34_max: float = 0.36  # [m] lift arm, to the lifting rod, greatest; > 0
    L5_min: float = 0.43  # [m] lower link, to the lifting rod, least; > 0 <= L5_max
    L5_max: float = 0.53  # [m] lower link, to the lifting rod, greatest; > 0
    L56_min: float = 0.90  # [m] lower link, whole, least; > 0 <= L56_max
    L56_max: float = 1.08  # [m] lower link, whole, greatest; > 0
    L6_min: float = 0.45  # [m] mast of the implement, least; > 0 <= L6_max
    L6_max: float = 0.60  # [m] mast of the implement, greatest; > 0
    X07_min: float = 0.35  # [m] upper link hinge O7, x, least; <= X07_max
    X07_max: float = 0.48  # [m] upper link hinge O7, x, greatest
    Y07_min: float = 0.82  # [m] upper link hinge O7, y, least; <= Y07_max
    Y07_max: float = 0.97  # [m] upper link hinge O7, y, greatest
    phi_BD_min: float = 10 * deg  # [deg] angle between the two sides of the lift arm, least; <= phi_BD_max
    phi_BD_max: float = 35 * deg  # [deg] angle between the two sides of the lift arm, greatest

    # 1.2 Requirements, at every position
    dG_req: float = 0.10  # [%] reserve of capacity, part of the implement's weight
    dRa_req: float = 0.20  # [%] share of the whole weight on the front axle; >= 0 < 100
    phi6_min: float = 85 * deg  # [deg] angle of the mast, least; < phi6_max
    phi6_max: float = 115 * deg  # [deg] angle of the mast, greatest
    mu_req: float = 40 * deg  # [deg] transmission angle of each group, away from its dead centres; >= 0 < 90
    Y56_req: float = 1.0  # [m] height of the suspension axis that the lift must reach
    X56_req: float = 0.95  # [m] suspension axis behind the rear axle, clear of the wheels

    # 1.3 Implement
    P6: float = 27500  # [N] weight of the implement; > 0

    # 1.4 Search
    seed: int = 1  # [-] seed of the search and of the tolerances; >= 0
    generations: int = 30  # [-] generations of a search; >= 1 <= 10000
    members: int = 6  # [-] variants of a generation for each input that is chosen; >= 1 <= 1000
    n_t: int = 5  # [-] points of the trade-off; >= 2 <= 100
    d_max: float = 0.3  # [%] greatest lead of capacity over stability in the trade-off; > 0

    # 1.5 Tolerances of what is made
    t_L: float = 0.001  # [m] of lengths and hinges; >= 0
    t_phi: float = 0.5 * deg  # [deg] of the lift arm's angle; >= 0
    n_mc: int = 500  # [-] variants of the Monte Carlo method; >= 2 <= 1000000

    """After # stand the unit and the meaning, after ; the limits; the page and the code take the same units."""


@app.cell
def form():
    form = ask(Choice)
    form
    return (form,)


@app.cell
def given(form):
    g = read(Choice, form)
    Used(g)
    return (g,)


@app.cell(hide_code=True)
def section_2():
    mo.md(r"""
    ## 2 What a design is worth

    Two reserves are compared, both in parts of the implement's weight: by how much heavier it might be before the
    cylinders fail to lift it ($G_\mathrm{S6}$ of the hitch), and before the front axle loses its least load
    ($G_\mathrm{S6,lim}$). The goal is the lesser of the two at the worst position. Transmission angles are those
    between the two links of each group, $90^\circ$ far from a dead centre and $0^\circ$ in it.
    """)
    return


@app.cell
def model():
    hitch = Path(__file__).with_name("hitch.py")
    bounded = ("L3", "L34", "L5", "L56", "L6", "X07", "Y07", "phi_BD")
    wanted = ("GS6", "GS6_lim", "dRa", "phi6_S", "P56_S", "phi12_S", "phi3_S", "phi4_S", "phi5_S", "phi7_S")
    return bounded, hitch, wanted


@app.cell
def limits(bounded, g, hitch):
    fields = {field.name: field for field in declared(load(hitch).inputs)}
    bounds = {x: tuple(float(fields[x].display(getattr(g, f"{x}_{end}"))) for end in ("min", "max")) for x in bounded}
    decimals = {x: {"m": 4, "deg": 2}[fields[x].unit] for x in bounded}  # 0.1 mm, 0.01 deg
    return bounds, decimals, fields


@app.cell
def worth(g, hitch, wanted):
    def reserves(s):
        return min(s["GS6"], -1) / g.P6 - 1, min(s["GS6_lim"], -1) / g.P6 - 1  # capacity and stability

    def transmission(a, b):
        return min(arcsin(abs(sin(a - b))), -1)

    def requirements(s):
        capacity, _ = reserves(s)
        mu_23, mu_45 = transmission(s["phi12_S"], s["phi3_S"]), transmission(s["phi4_S"], s["phi5_S"])
        return (
            Requirement("reserve of capacity", capacity, g.dG_req, "%"),
            Requirement("share of the front axle", min(s["dRa"], -1), g.dRa_req, "%"),
            Requirement("least angle of the mast", min(s["phi6_S"], -1), g.phi6_min, "deg"),
            Requirement("greatest angle of the mast", max(s["phi6_S"], -1), g.phi6_max, "deg", at_least=False),
            Requirement("transmission angle, cylinder and lift arm", mu_23, g.mu_req, "deg"),
            Requirement("transmission angle, lifting rod and lower link", mu_45, g.mu_req, "deg"),
            Requirement(
                "transmission angle, mast and upper link", transmission(s["phi6_S"], s["phi7_S"]), g.mu_req, "deg"
            ),
            Requirement("height of the suspension axis", max(s["P56_S"].imag, -1), g.Y56_req, "m"),
            Requirement("suspension axis behind the rear axle", min(s["P56_S"].real, -1), g.X56_req, "m"),
        )

    def judge(lead):
        """Judge of variants whose reserve of capacity is to lead that of stability by so much."""

        def judged(variants):
            s = sweep(hitch, wanted, {**variants, "P6": g.P6})
            capacity, stable = reserves(s)
            return Judged(minimum(capacity - lead / 2, stable + lead / 2), requirements(s), s.reasons)

        return judged

    return judge, requirements, reserves


@app.cell(hide_code=True)
def section_3():
    mo.md("""
    ## 3 The chosen design

    Differential evolution over the bounds; lengths are rounded to a tenth of a millimetre and angles to a hundredth of
    a degree within the search, so that what is promised holds for the design as it is written. How uncertain it is that
    the least reserve is the greatest, the last generation tells: by as much as its variants reach below the best one,
    and a step of the last decimal of each input changes it. Another search may find so much more, with other lengths;
    of a better design that no variant came near it knows nothing.
    """)
    return


@app.cell
def effort(g):
    how = {"seed": g.seed, "generations": g.generations, "members": g.members}
    return (how,)


@app.cell
def chosen(bounds, decimals, g, how, judge):
    with progress(g.generations, "search") as _done:
        try:
            design = search(judge(0.0), bounds, decimals, **how, done=_done)
        except SheetError as error:
            refuse(error)
    return (design,)


@app.cell
def table_31(bounds, design, fields, hitch):
    present = load(hitch).inputs

    if np.isfinite(design.uncertainty):
        uncertain = f"the greatest one is uncertain by {100 * design.uncertainty:.2g} %"
    else:
        uncertain = "how near the greatest one is not known: half of the last generation misses a requirement"

    def column(name, values, meaning):
        return Column(name, "", meaning, 4, np.array(values, dtype=float))

    table_31 = Table(
        "3.1",
        "Chosen inputs",
        (
            Column("input", "", "", 0, list(design.inputs), names=True),
            Column("unit", "", "", 0, [shown(fields[x].unit) for x in design.inputs]),
            column("chosen", list(design.inputs.values()), "value of the design"),
            column("present", [fields[x].display(getattr(present, x)) for x in design.inputs], "value in the hitch"),
            column("least", [bounds[x][0] for x in design.inputs], "lower bound"),
            column("greatest", [bounds[x][1] for x in design.inputs], "upper bound"),
        ),
        note=f"Best of {design.tried} variants; its least reserve is {100 * design.goal:.2f} %, {uncertain}.",
    )
    table_31
    return (table_31,)


@app.cell
def design_checks(design):
    checks_design = tuple(requirement.check() for requirement in design.requirements)
    typeset(*checks_design)
    return (checks_design,)


@app.cell
def positions(design, g, hitch):
    with_design = {**design.inputs, "P6": g.P6}
    h = evaluate(hitch, ["S", "S_p", "GS6", "GS6_lim", "dGS65", "dRa", "phi6_S", "P56_S"], **with_design)
    S = h["S"]  # [m] length of the cylinder
    GS6 = h["GS6"]  # [N] capacity at the centre of mass
    GS6_lim = h["GS6_lim"]  # [N] greatest stable load
    r_G = GS6 / g.P6 - 1  # [%] reserve of capacity
    r_R = GS6_lim / g.P6 - 1  # [%] reserve of stability
    dRa = h["dRa"]  # [%] share of the front axle
    phi6_S = h["phi6_S"]  # [deg] mast
    P56_S = h["P56_S"]  # [m] suspension axis
    r_min = min(minimum(r_G, r_R))  # [%] least reserve
    typeset()
    return GS6, GS6_lim, P56_S, S, dRa, h, phi6_S, r_G, r_R, r_min, with_design


@app.cell
def table_32(GS6, GS6_lim, P56_S, S, dRa, phi6_S, r_G, r_R):
    table_32 = table(
        "3.2", "The design over the stroke", S, GS6, GS6_lim, r_G, r_R, dRa, phi6_S, P56_S.real, P56_S.imag
    )
    table_32
    return (table_32,)


@app.cell
def figure_31(S, h, r_G, r_R):
    figure_31 = figure("3.1", "Reserves of the design", S, r_G, r_R, marks={"S_p": h["S_p"]})
    figure_31
    return (figure_31,)


@app.cell(hide_code=True)
def section_4():
    mo.md("""
    ## 4 Capacity against stability

    The search again, asking that the reserve of capacity leads that of stability by more and more: how much stability
    more capacity costs. Designs that another one beats in both are left out.
    """)
    return


@app.cell
def leads(bounds, decimals, design, g, how, judge):
    led = [(0.0, design)]
    with progress(g.n_t * g.generations, "trade-off") as _done:
        for _lead in np.linspace(0, g.d_max, g.n_t + 1)[1:]:
            _start = led[-1][1].inputs
            led.append((float(_lead), search(judge(_lead), bounds, decimals, **how, start=_start, done=_done)))
    return (led,)


@app.cell
def unbeaten(bounds, g, hitch, led, reserves, wanted):
    _variants = {x: np.array([design.inputs[x] for _, design in led]) for x in bounds}
    unbeaten = [led[k] for k in pareto(*reserves(sweep(hitch, wanted, {**_variants, "P6": g.P6})))]
    return (unbeaten,)


@app.cell
def trade_off(bounds, g, hitch, reserves, unbeaten, wanted):
    pareto_variants = {x: np.array([design.inputs[x] for _, design in unbeaten]) for x in bounds}
    r_G_led, r_R_led = reserves(sweep(hitch, wanted, {**pareto_variants, "P6": g.P6}))
    c_G = r_G_led  # [%] least reserve of capacity
    c_R = r_R_led  # [%] least reserve of stability
    c_d = np.array([lead for lead, _ in unbeaten])  # [%] lead that was asked for
    c_u = np.array([design.uncertainty for _, design in unbeaten])  # [%] uncertainty of what the search made greatest
    typeset()
    return c_G, c_R, c_d, c_u, pareto_variants


@app.cell
def table_41(bounds, c_G, c_R, c_d, c_u, fields, pareto_variants):
    table_41 = Table(
        "4.1",
        "Designs of the trade-off",
        (
            *table("4.1", "", c_G, c_R, c_d, c_u, decimals=3).columns,
            *(Column(x, fields[x].unit, fields[x].meaning, 4, pareto_variants[x]) for x in bounds),
        ),
    )
    table_41
    return (table_41,)


@app.cell
def figure_41(c_G, c_R, r_G):
    figure_41 = figure("4.1", "Stability against capacity", c_G, c_R, marks={"chosen": min(r_G)})
    typeset(
        figure_41,
        mo.md(
            f"Over this range {100 * np.ptp(c_G):.1f} % of capacity cost {100 * np.ptp(c_R):.2f} % of stability, "
            "both in parts of the implement's weight."
        ),
    )
    return (figure_41,)


@app.cell(hide_code=True)
def section_5():
    mo.md("""
    ## 5 Sensitivity of the chosen design

    What the reserves depend on, by all inputs of the hitch: percent of the result for one percent of the input, at the
    position where the result is least; and between what they lie when the chosen inputs are made within their
    tolerances.
    """)
    return


@app.cell
def sensitivities(hitch, with_design):
    slopes = sensitivity(hitch, ["GS6", "GS6_lim"], **with_design)
    tornado_51 = slopes.tornado("5.1", "Sensitivity of the capacity", "GS6")
    tornado_52 = slopes.tornado("5.2", "Sensitivity of the greatest stable load", "GS6_lim")
    table_51 = slopes.table("5.1", "Sensitivity of the capacity", "GS6")
    table_52 = slopes.table("5.2", "Sensitivity of the greatest stable load", "GS6_lim")
    typeset(tornado_51, table_51, tornado_52, table_52)
    return slopes, table_51, table_52, tornado_51, tornado_52


@app.cell
def tolerances(bounds, fields, g, hitch, with_design):
    made = {x: float(fields[x].display({"m": g.t_L, "deg": g.t_phi}[fields[x].unit])) for x in bounds}
    corners = tolerance(hitch, ["dGS65", "dRa"], made, **with_design)
    random = tolerance(hitch, ["dGS65", "dRa"], made, "monte carlo", seed=g.seed, count=g.n_mc, **with_design)
    table_53 = corners.table("5.3", "Reserve and front axle at the corners of the tolerances")
    table_54 = random.table("5.4", "Reserve of capacity within the tolerances", "dGS65")
    typeset(table_53, table_54)
    return corners, random, table_53, table_54


@app.cell(hide_code=True)
def section_6():
    mo.md("""
    ## 6 Scene for the hitch

    The design as a scene that the worksheet `hitch` opens, with its requirements as limits. The button below hands it
    out; a script writes it beside the workbook where `--out` names a folder.
    """)
    return


@app.cell
def scene_of_design(P56_S, dRa, design, fields, g, r_min, with_design):
    least = {
        "dGS65": Limit(round(100 * g.dG_req, 9)),
        "dRa": Limit(round(100 * g.dRa_req, 9)),
        "P56_S.real": Limit(g.X56_req),
    }
    mast = {"phi6_S": Limit(round(g.phi6_min / deg, 9), round(g.phi6_max / deg, 9))}
    scene = scene_text(
        fields,
        with_design,
        {**least, **mast},
        [
            f"A hitch designed by hitch_design, seed {g.seed}, {design.tried} variants.",
            f"Least reserve {100 * r_min:.4f} %, share of the front axle at least {100 * min(dRa):.4f} %,",
            f"suspension axis lifted to {max(P56_S.imag):.4f} m.",
        ],
    )
    mo.md(f"```toml\n{scene}\n```")
    return (scene,)


@app.cell
def scene_check(design, g, hitch, scene):
    opened = evaluate(hitch, ["GS6", "GS6_lim"], **tomllib.loads(scene)["inputs"])
    r_scene = min(minimum(opened["GS6"], opened["GS6_lim"])) / g.P6 - 1
    checks_scene = Check(
        "the scene keeps the promised reserve", float(abs(r_scene - design.goal)), 1e-12, agreement=True
    )
    checks_scene
    return (checks_scene,)


@app.cell
def workbook(scene):
    _book = export("Design of a tractor hitch", globals())
    mo.vstack([save_scene(scene, "designed.toml", globals()), _book])
    return


if __name__ == "__main__":
    app.run()
