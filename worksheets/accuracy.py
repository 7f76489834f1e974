import marimo

__generated_with = "0.25.1"
app = marimo.App(width="medium", app_title="Accuracy", css_file="page.css")

with app.setup:
    from functools import partial
    from pathlib import Path

    import marimo as mo
    import numpy as np

    from mechsheet import (
        Check, Column, DigitsKept, Judged, SheetError, Table, Used, WorkPrecision, accuracy_jobs, ask, asked_costs,
        batch_times, caption, circular_joint, claims_table, cost_of_checks, end_to_end, export, group_times, inputs,
        integration_steps, load, measured_on, measured_scenes, random_groups, read, refuse, search, sensitivity,
        study_costs, study_jobs, summary, sweep, time_spread, title_block, tolerance, typeset, whole_worksheets,
    )  # fmt: skip

    folder = Path(__file__).parent


@app.cell(hide_code=True)
def title():
    title_block(
        "Error against run time",
        """
    The product's ways to positions, derivatives, unknown lengths, reactions and studies stand here beside others that
    could do the same jobs. Errors are measured against arithmetic of 50 digits; all methods of a job run turn about in
    one process, and times are medians, given as multiples of the product's own. Times within a tenth of each other, and
    times of five runs or more whose quartiles overlap, are the same. Where a method is faster at the same digits, a few
    words say why it is not used.

    In a figure the product's own method is the large diamond. Whatever is both faster and more accurate would lie in
    the red field beside it. Errors in the grey band are a few roundings: there one method is as good as another, and
    there is no red field. The dashed line joins the methods that none surpasses in both.
    """,
    )
    return


@app.cell(hide_code=True)
def verdict(
    check_11, check_12, check_21, check_22, check_31, check_32, check_41, check_42, check_74, check_75, check_76,
    checks_16, checks_4, checks_5, checks_7, checks_8,
):  # fmt: skip
    _checks = (check_11, check_12, *checks_16, check_21, check_22, check_31, check_32, check_41, check_42)
    summary(_checks, checks_4, checks_5, (*checks_7, check_74, check_75, check_76), checks_8)
    return


@app.cell(hide_code=True)
def front(job_11, job_12, job_21, job_22, job_31, job_32, job_41, job_42, job_44, job_45, jobs_16, jobs_8):
    compared = (job_11, job_12, *jobs_16, job_21, job_22, job_31, job_32, job_41, job_42, job_44, job_45, *jobs_8)
    least = [min(row.error for row in job.rows) for job in compared]
    fastest = [job.fastest for job in compared]
    ratios = [row.seconds / job.own.seconds for row, job in zip(fastest, compared, strict=True)]
    better = [", ".join(f"{row.family} {row.setting}" for row in job.better) or "none" for job in compared]
    table_0 = Table(
        "0",
        "The product's own methods",
        (
            Column("job", "", "", 0, [f"{job.number} {job.title}" for job in compared]),
            Column("digits", "-", "digits that are right", 1, [job.own.digits for job in compared]),
            Column("most", "-", "digits of the most accurate method", 1, -np.log10(least)),
            Column("time", "ms", "median of the run times", 3, [1e3 * job.own.seconds for job in compared]),
            *time_spread([job.own for job in compared]),
        ),
    )
    table_01 = Table(
        "0.1",
        "The fastest methods of no fewer digits",
        (
            Column("job", "", "", 0, [job.number for job in compared]),
            Column("own method", "", "", 0, [job.own.family for job in compared]),
            Column("fastest", "", "of the methods of no fewer digits", 0, [row.family for row in fastest]),
            Column("least time", "-", "its time, times the product's own", 5, ratios),
            *time_spread(fastest),
            Column("better", "", "methods that leave the product's behind: faster and more accurate", 0, better),
        ),
        "least time: in times of the product's own. better: whatever is both faster and more accurate. Why the fastest "
        "is not used stands in the table of its job.",
    )
    table_02 = measured_on("0.2")
    typeset(table_0, table_01, table_02)
    return table_0, table_01, table_02


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
    full: int = 0  # [-] 1 for long runs and up to 1 000 000 positions, which take minutes; >= 0 <= 1
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


@app.function
def run_time(g):
    """Run time of a method in all, at least [s]."""
    if g.full:  # a statement, in a recording too: it is compared with run times, which no formula may hold
        return 0.5
    return 0.01


@app.function
def patience(g):
    """Factor of the number that slow ways have to compute."""
    if g.full:
        return 100
    return 1


@app.cell
def extent(g):
    seconds = run_time(g)
    sizes = (1, 10, 1000, 100_000)
    return seconds, sizes


@app.cell
def jobs(factors, g):
    hitch = load(folder / "hitch.py").inputs()
    jobs = accuracy_jobs(hitch, load(folder / "kinetostatics.py"), g, g.N, factors)
    return hitch, jobs


@app.cell(hide_code=True)
def section_1():
    mo.md(r"""
    ## 1 Position

    The loop of a dyad is $A + \ell_\mathrm{A} e^{i\alpha} = B + \ell_\mathrm{B} e^{i\beta}$; in the hitch each dyad
    hangs on the one before. Newton and fsolve start from the angles to one digit after the point, as one reads them off
    a drawing, and have the slopes of the loops in closed form; fsolve takes one position after the other, as a Find
    over a range does. The velocity equations are integrated from the first position on.
    """)
    return


@app.cell
def job_11(jobs, seconds):
    job_11 = jobs["1.1"].compare(seconds)
    figure_11, table_11, check_11 = job_11.figure(), job_11.table(), job_11.check()
    typeset(figure_11, job_11.summary(), check_11)
    return check_11, figure_11, job_11, table_11


@app.cell
def job_12(g, jobs, seconds):
    reach = abs(g.l_A - g.l_B), g.l_A + g.l_B
    frame = abs(g.X_B + 1j * g.Y_B)
    turn = abs(frame - g.l_1), frame + g.l_1
    if not reach[0] < turn[0] <= turn[1] < reach[1]:
        links, pins = (f"{low:.6g}..{high:.6g} m" for low, high in (reach, turn))
        refuse(
            SheetError(f"links l_A, l_B join pins that are {links} apart, over the turn of the crank they are {pins}")
        )
    job_12 = jobs["1.2"].compare(seconds)
    figure_12, table_12, check_12 = job_12.figure(), job_12.table(), job_12.check()
    typeset(figure_12, job_12.summary(), check_12)
    return check_12, figure_12, job_12, table_12


@app.cell
def job_13(g, hitch, seconds, sizes):
    """
    ### Cost of a position

    The tables give the time of one of so many that are computed at once: positions of the hitch, and random geometries
    of each group. The slope is that of the time for all over their number: 0 where all cost what one does, 1 where each
    costs the same. Beyond a thousand at once little is gained. A million, which are timed in the long runs, no longer
    fit the processor's cache and take longer each: sweeps go through their variants in chunks that do.
    """
    many = (*sizes, 1_000_000) if g.full else sizes
    table_13, table_14 = batch_times("1.3", hitch, many, seconds), group_times("1.4", many, seconds)
    typeset(table_13, table_14)
    return table_13, table_14


@app.cell
def job_15(g, hitch, seconds, sizes):
    """
    ### Cost of the checks

    The library looks at every argument, tells a dead centre from a number and adds in the order that keeps digits; the
    same closed forms in plain numpy do neither. What they leave of the library's time is what that costs: some half of
    it or more at the few positions of a document, and no small part where many are computed at once. It is paid for an
    error that names the argument, for NaN where a group does not close, and for the digits of section 7.
    """
    table_15 = cost_of_checks("1.5", hitch, sizes if g.full else sizes[:3], seconds)
    typeset(table_15)
    return (table_15,)


@app.cell
def time_responses(hitch, jobs, seconds):
    """
    ### Drives over time

    The product solves no equations of motion: it assembles the position at any time from the drive's coordinate, which
    both drives here have in closed form. Where there is none that alone need be integrated, as LSODA and Radau do
    before they assemble. Others integrate the velocity equations. They are stiff where something in the drive is much
    faster than the motion: here the valve of the hitch's cylinder, which follows its command within milliseconds while
    the lift takes a second. Its mode decays hundreds of times on the way (table 1.8), so explicit methods are held to
    small steps whatever the tolerance, and implicit ones, with the Jacobian in closed form, are not: they take less
    than half of the steps where the tolerance is loose, and more and more of theirs where it is tight.

    A crank that passes a dead centre of its coupler and rocker within a millionth of its length makes the equations
    steep, but not stiff: their fastest mode grows and decays some ten times in all, and where the tolerance is tight
    RK45, an explicit method, takes fewer evaluations than any implicit one. Where it is loose RK45, DOP853 and BDF step
    over the dead centre and go on in the other assembly: they report success, and no digit is right.
    """
    jobs_16 = jobs["1.6"].compare(seconds), jobs["1.7"].compare(seconds)
    table_16, table_17 = jobs_16[0].table(), jobs_16[1].table()
    figure_16, figure_17 = jobs_16[0].figure(), jobs_16[1].figure()
    checks_16 = jobs_16[0].check(), jobs_16[1].check()
    table_18 = integration_steps("1.8", hitch)
    typeset(figure_16, table_16, checks_16[0], figure_17, table_17, checks_16[1], table_18)
    return checks_16, figure_16, figure_17, jobs_16, table_16, table_17, table_18


@app.cell(hide_code=True)
def section_2():
    mo.md("""
    ## 2 Velocity and acceleration analogues

    First and second derivatives of the angles of the links 3 to 7 of the hitch with respect to $S$, each way with the
    positions that it needs. Differences take the positions at both sides, at steps that are parts of the stroke, those
    of five points at twice the step too; interpolated is a table of so many positions, by a cubic spline, or by a
    polynomial where they are dense at both ends as Chebyshev has it. All take closed forms without checks, so that
    central differences are sooner than the library, with fewer digits.
    """)
    return


@app.cell
def job_21(jobs, seconds):
    job_21 = jobs["2.1"].compare(seconds)
    figure_21, table_21, check_21 = job_21.figure(), job_21.table(), job_21.check()
    typeset(figure_21, job_21.summary(), check_21)
    return check_21, figure_21, job_21, table_21


@app.cell
def job_22(jobs, seconds):
    job_22 = jobs["2.2"].compare(seconds)
    figure_22, table_22, check_22 = job_22.figure(), job_22.table(), job_22.check()
    typeset(figure_22, job_22.summary(), check_22)
    return check_22, figure_22, job_22, table_22


@app.cell(hide_code=True)
def section_3():
    mo.md(r"""
    ## 3 Find

    The three unknown lengths of the hitch, one after the other: $L_4$, $S_\mathrm{p}$, $L_7$. All iterations solve the
    same equations: `find` has them by the library's dyads, the others by closed forms without checks, with the slopes
    in closed form too, and the last one by the formulas of the document, as a port from Mathcad has it. In closed form
    the mechanism is taken from the other end: the wanted point is known, and the unknown length is its distance from
    another known point; that must be thought out anew for every unknown.

    `find` does more for its time than the iterations: it samples the whole interval on both branches of assembly,
    reports every root with its bracket and residual, or why there is none, and whatever the guess. The iterations
    return one number; scipy's `find_root` and `brentq` need an interval with one change of sign.
    """)
    return


@app.cell
def job_31(jobs, seconds):
    job_31 = jobs["3.1"].compare(seconds)
    figure_31, table_31, check_31 = job_31.figure(), job_31.table(), job_31.check()
    typeset(figure_31, job_31.summary(), check_31)
    return check_31, figure_31, job_31, table_31


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
def job_32(jobs, seconds):
    job_32 = jobs["3.2"].compare(seconds)
    figure_32, table_32, check_32 = job_32.figure(), job_32.table(), job_32.check()
    typeset(figure_32, job_32.summary(), check_32)
    return check_32, figure_32, job_32, table_32


@app.cell
def job_33(g, hitch, seconds, sizes):
    """
    ### Many Finds at once

    The lifting rod for so many heights of the suspension axis, as a sweep asks for it: `find` and `find_root` take all
    of them in one call, brentq one after the other. `find_root` closes in on the one root between two ends; `find` has
    to find such ends first, on both branches. A dash: so many take too long here.
    """
    table_33 = batch_times("3.3", hitch, sizes, seconds, patience(g))
    typeset(table_33)
    return (table_33,)


@app.cell(hide_code=True)
def section_4():
    mo.md(r"""
    ## 4 Reactions

    From the same pins and the weight of the implement, all ways compute the same six reactions. The dense system holds
    the 18 equations of the six bodies at each position; least squares add the equilibrium of the whole mechanism. The
    second comparison has the hitch at $S_\mathrm{p}$, where the mast is upright and the printed formulas divide by its
    horizontal part, which is nothing but rounding. For a few positions one dense system is quicker than the library's
    checked functions, for many it takes many times as long.
    """)
    return


@app.cell
def reactions(jobs, seconds):
    job_41, job_42 = jobs["4.1"].compare(seconds), jobs["4.2"].compare(seconds)
    figure_41, table_41, check_41 = job_41.figure(), job_41.table(), job_41.check()
    figure_42, table_42, check_42 = job_42.figure(), job_42.table(), job_42.check()
    typeset(figure_41, job_41.summary(), check_41, figure_42, job_42.summary(), check_42)
    return check_41, check_42, figure_41, figure_42, job_41, job_42, table_41, table_42


@app.cell
def job_43(g, hitch, seconds, sizes):
    table_43 = batch_times("4.3", hitch, sizes, seconds, patience(g))
    table_43
    return (table_43,)


@app.cell
def machine_and_ring(jobs, seconds):
    """
    ### Other groups, and the circular joint

    The machine of the worksheet `kinetostatics` has a group RRR, RRP and RPR each, with weights, inertia forces, a
    resistance and a gas. All ways start from its pins and loads. The printed programs SR1, SR2 and SR3 keep the digits
    here, and say nothing at a dead centre.

    In the circular joint the normal force grows until the rim is all but lifted off: the printed primitives of its line
    load are differences of almost equal numbers then, and quadratures keep their digits. The library's has fixed
    places, the same for all cases at once; what it takes beyond the same without checks goes to them and to the state
    of each case.
    """
    job_44, job_45 = jobs["4.4"].compare(seconds), jobs["4.5"].compare(seconds)
    figure_44, table_44, figure_45, table_45 = job_44.figure(), job_44.table(), job_45.figure(), job_45.table()
    checks_4 = job_44.check(), job_45.check()
    typeset(figure_44, job_44.summary(), checks_4[0], figure_45, job_45.summary(), checks_4[1])
    return checks_4, figure_44, figure_45, job_44, job_45, table_44, table_45


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
    | slotted link | slider, angular velocity and acceleration of the link, point C with velocity and acceleration |
    | kinetostatics | pins, motion, inertia forces, loads and all reactions; balancing moment by the work of all loads |
    | joint | areas, neutral axes and forces of all elements; bolts and rims of the rings |
    """)
    return


@app.cell
def job_5(g, sizes):
    rows_5 = whole_worksheets(folder, sizes if g.full else sizes[:3:2], run_time(g))
    return (rows_5,)


@app.cell
def shown_5(rows_5):
    time_5 = Column("time", "ms", "run time", 1, [1e3 * row.seconds for row in rows_5])
    error_5 = Column("error", "-", "largest error of the results", 1, [row.error for row in rows_5], power=True)
    table_5 = Table(
        "5",
        "Whole worksheets",
        (
            Column("worksheet", "", "", 0, [row.family for row in rows_5]),
            Column("positions", "", "", 0, [row.setting for row in rows_5]),
            Column("names", "-", "numbers and checks, each over all positions", 0, [row.names for row in rows_5]),
            Column("cells", "-", "cells run", 0, [row.cells for row in rows_5]),
            time_5,
            Column("each", "µs", "time of a position", 1, [1e6 * row.seconds / row.positions for row in rows_5]),
            error_5,
            Column("digits", "-", "digits that are right", 1, [row.digits for row in rows_5]),
            *time_spread(rows_5),
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
    the hitch, against the whole document with its tables and drawings. What is asked for again is recorded the second
    time, and then computed without the cells wherever that gives the same; drawings and tables are not.
    """)
    return


@app.cell
def wants(g):
    asked = {
        "lift arm's angle as a function": ["phi3"],
        "length of the lifting rod": ["L4"],
        "angle of the lift arm over the stroke": ["phi3_S"],
        "lifting capacity": ["GS6"],
        "all reactions": ["R56", "R07", "R34", "R05", "R01", "R03"],
        "one drawing": ["drawing_21"],
        "one table": ["table_41"],
        "whole document": [],
    }
    table_6 = asked_costs("6", folder / "hitch.py", asked, run_time(g))
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
    a method; a large one is the nature of the scene. Each scene is a file of the package, run through the worksheet
    that it names, or through the library where it names a group. Lengths that a Find has found, the stroke of a
    position, and of a single group its position and the rates that its accelerations start from count as inputs of what
    follows, since they are rounded to 16 digits too.

    The product must keep the digits expected, less at most one. Where nothing exists, or can be told from rounding, it
    must say so in words. The printed formulas get every help: the lengths found, the right quadrants, the corrected
    signs; of kinetostatics and the slotted link they are the worksheets' own lines, programs SR1 to SR3 and the Find of
    six equations from the document's first approximations. In the scene `through_dead_centre` the velocity equations
    are integrated in their place, by DOP853: they are steep there, but not stiff (1.7).
    """)
    return


@app.cell
def scenes(g):
    scenes_7 = measured_scenes(folder, short=not g.full)
    outcomes_7 = [outcome for scene in scenes_7 for outcome in scene.outcomes]
    return outcomes_7, scenes_7


@app.cell
def checks_of_scenes(outcomes_7):
    def failing(name, says, told):
        judged = [o for o in outcomes_7 if bool(o.wanted) is says]
        wrong = [o for o in judged if not o.holds]
        reason = "; ".join(told.format(o=o) for o in wrong[:3]) if judged else "there is nothing to check"
        return Check(name, len(wrong) if judged else np.nan, 0, reason=reason)

    lost = "{o.scene} {o.case} {o.result}: {o.product:.1f} of {o.expected:.1f} digits"
    checks_7 = (
        failing("results that lose more than a digit beyond their condition", False, lost),
        failing("scenes that cannot exist, and nobody says so", True, "{o.scene} {o.case}: {o.wanted!r} is not said"),
    )
    typeset(*checks_7)
    return (checks_7,)


@app.cell
def table_71(outcomes_7, scenes_7):
    shown = [scene for scene in scenes_7 if not scene.says]
    hardest = [scene.hardest for scene in shown]
    beyond = "digits kept less digits expected, the least of all results"
    table_71 = Table(
        "7.1",
        "Digits in stiff and extreme scenes",
        (
            Column("scene", "", "file of the scene", 0, [s.words for s in shown]),
            Column("results", "-", "results measured", 0, [len(s.outcomes) for s in shown]),
            Column(
                "result",
                "",
                "where the printed formulas lose most, or the worst conditioned",
                0,
                [o.result for o in hardest],
            ),
            Column("log κ", "-", "logarithm of its condition number", 1, [np.log10(o.condition) for o in hardest]),
            Column("expected", "-", "digits expected", 1, [o.expected for o in hardest]),
            Column("printed", "-", "digits kept by the printed formulas", 1, [o.printed for o in hardest]),
            Column("product", "-", "digits kept by the product", 1, [o.product for o in hardest]),
            Column("margin", "-", beyond, 1, [s.margin for s in shown]),
        ),
        note="A dash: the documents print no formula of it, the worksheet's own line is the printed one, or a single "
        "group is of a kind whose printed formulas are not ported. The margin must not be less than -1.",
    )
    figure_71 = DigitsKept(outcomes_7)
    typeset(table_71, figure_71, caption("7.1", "Digits kept over digits expected, every result of every scene"))
    return figure_71, table_71


@app.cell
def tables_of_scenes(outcomes_7, scenes_7):
    table_72 = Table(
        "7.2",
        "What the scenes are",
        (
            Column("scene", "", "file of the scene", 0, [s.words for s in scenes_7]),
            Column("through", "", "worksheet or group", 0, [s.job.replace("_", " ") for s in scenes_7]),
            Column("what it is", "", "", 0, [s.about for s in scenes_7]),
        ),
    )
    said = [o for o in outcomes_7 if o.wanted]
    table_73 = Table(
        "7.3",
        "What is said where nothing exists",
        (
            Column("scene", "", "file of the scene", 0, [o.scene.replace("_", " ") for o in said]),
            Column("input", "", "value of the input that varies", 0, [o.case for o in said]),
            Column("words", "", "", 0, [o.words.split("; ")[0] for o in said]),
        ),
    )
    typeset(table_72, table_73)
    return table_72, table_73


@app.cell
def table_74():
    """
    ### Digits proved

    `--proof` encloses every number in a ball that holds the exact one, and claims the digits that this leaves. Here are
    its claims beside the errors that there are, by 50 digits from the inputs to the end: results of the documents at
    three positions each, of the joint in all load cases, all beside the largest number of their column. Angles are left
    out, which may be whole turns apart.
    """
    table_74, check_74 = claims_table("7.4", folder)
    typeset(table_74, check_74)
    return check_74, table_74


@app.cell
def table_75(g):
    r"""
    ### Errors over the condition number

    Of random geometries of each group, ordinary ones, whose pins, guides and lengths all move and whose links are
    loaded, the errors in roundings times $\kappa$: a method that is as good as any stays at a few. The exact numbers
    have 32 digits here.

    Then all results of the five documents with $\kappa$ from end to end, from the user's inputs on through whatever is
    found, by the slopes of the recording: of each document the worst conditioned ones, over all positions, and the
    input to blame. Those of which no other derivation is at hand are compared with balls around what their own formulas
    have, as `--proof` does; forms as they are printed, which lose more, do not count in the check.
    """
    table_75, check_75 = random_groups("7.5", 100_000 if g.full else 10_000)
    tables_76, check_76 = end_to_end("7.6", folder)
    typeset(table_75, check_75, *(table.head(8) for table in tables_76), check_76)
    return check_75, check_76, table_75, tables_76


@app.cell(hide_code=True)
def section_8():
    mo.md("""
    ## 8 Studies

    Two unknowns are the angles of the general dyad's links, every solution in a full turn of both: `find` samples the
    whole square and says what it saw; fsolve from a grid of starts, with the slopes in closed form, finds the same two
    much sooner, and would not know of others; the closed form is that of a dyad alone. The neutral axis is that of 24
    elements; the document's iteration takes a part of the time, and nobody has shown that it must end. A sweep runs the
    hitch's worksheet for all variants at once; a sensitivity follows its recording, through what is found, with all the
    digits that differences lose.
    """)
    return


@app.cell
def studied(g):
    studied = study_jobs(folder / "hitch.py", g, sweep, sensitivity)
    return (studied,)


@app.cell
def studies(seconds, studied):
    jobs_8 = tuple(job.compare(seconds) for job in studied.values())
    tables_8, checks_8 = tuple(job.table() for job in jobs_8), tuple(job.check() for job in jobs_8)
    typeset(*(part for shown in zip(tables_8, checks_8, strict=True) for part in shown))
    return checks_8, jobs_8, tables_8


@app.cell
def job_85(g):
    """
    ### What studies cost

    What reads the recording of a run of the hitch, tables, slopes, proof and workbook, what shows it as a page anew,
    and what runs over its worksheet many times; at last a circular joint.
    """
    sheet_8 = folder / "hitch.py"
    tolerances, moments = {"L3": 1e-3, "L5": 1e-3}, np.linspace(1e3, 1e5, 1000)
    searched = partial(search, bounds={"L3": (0.2, 0.24), "L5": (0.46, 0.5)}, decimals={"L3": 3, "L5": 3}, seed=1)
    ring = partial(circular_joint, 0.6, np.linspace(-1.0, 1.0, 24), moments, 2e4)

    def judge(variants):
        swept = sweep(sheet_8, ["GS6"], variants)
        return Judged(swept["GS6"].min(-1), (), swept.reasons)

    studies = {
        "sweep: capacity for 1000 centres of mass": partial(sweep, sheet_8, ["GS6"], {"X6": 0.7 + moments / 5e5}),
        "design: two links, 3 generations": partial(searched, judge, generations=3, members=10),
        "tolerances of two links: capacity at the corners": partial(tolerance, sheet_8, ["GS6"], tolerances),
        "tolerances of two links: 500 drawn": partial(
            tolerance, sheet_8, ["GS6"], tolerances, "monte carlo", count=500, seed=1
        ),
        "circular joint of 24 bolts, 1000 moments": ring,
    }
    table_85 = study_costs("8.5", sheet_8, studies, run_time(g))
    typeset(table_85)
    return (table_85,)


@app.cell
def workbook():
    export("Accuracy", globals())
    return


if __name__ == "__main__":
    app.run()
