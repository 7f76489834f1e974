import marimo

__generated_with = "0.25.1"
app = marimo.App(width="medium", app_title="Guide", css_file="page.css")

with app.setup:
    import marimo as mo
    from numpy import arccos, arcsin, cos, exp, linspace, pi, sin, sqrt

    from mechsheet import (
        Drawing, Used, ask, caption, check, check_slope, closed_form, export, figure, find, inputs, mark, player, read,
        slider, summary, table, title_block, typeset,
    )  # fmt: skip
    from mechsheet.units import deg


@app.cell(hide_code=True)
def title():
    title_block(
        "Guide",
        """
    A press that teaches by being edited: open it with `python lib/mechsheet edit guide`, do what stands after **Try**.
    A click on a formula, a check, a table or the symbol of an input edits its line, as does F2, Enter writes it, Ctrl-Z
    takes it back; two clicks on a text edit that, and the button *code* shows all lines of a cell: these Ctrl-Enter
    runs and Ctrl-S saves. A click on a heading closes its section on the screen, and another one opens it.
    """,
    )
    return


@app.cell(hide_code=True)
def verdict(found_c, right, strong):
    summary(strong, found_c, right)
    return


@app.cell(hide_code=True)
def section_1():
    mo.md("""
    ## 1 An input

    Each input is a line of a class: name, value, and after `#` its unit, its meaning and, after `;`, its limits. The
    page makes a field of it. Values are in SI units and radians, `30 * deg` or `0.06`; the field shows the unit that
    stands in the line. A speed in rpm is in rad/s too: a rim has `n * D / 2`, not `pi * D * n / 60`.

    **Try** `40` in the field of the crank, then `-40`, then `0,05 m`: a number that breaks its limit is told in words,
    a decimal comma is a decimal point, and a unit of your own is converted.

    **Try** a click on the symbol `l`, then Ctrl-Enter and `m: float = 12.0  # [kg] ram; > 0`: a new field is there.

    Behind the limits a tolerance may stand, `; ± 0.05`, `; ± 1 %` or `; ± 5 % normal`: all values within are equally
    likely, unless `normal` makes it three standard deviations.

    The kind of an input is its type: `float`, `int`, `bool` (a switch), `str` (a text), `Literal["single", "double"]`
    (names to choose from), `one_of(GRADES, "8.8")` (options with properties, `g.bolt.R_m`), `list[float]` (load
    cases), a list of rows of another class (a table, whose column is `g.bolts.x`, and whose rows are gone through by
    `for bolt in g.bolts`), or either from a file beside the worksheet, `from_file("gas.csv")`; both are grids, into
    which the cells of a spreadsheet are pasted. Rows and options may have texts, `name: str`: they are labels, in a
    sentence or the name of a check `bolt.name`, as a column of a table `g.bolts.name`. Unit names are constants:
    `640 * MPa`, `3 * inch`.
    """)
    return


@app.class_definition
@inputs
class Press:
    # 1.1 Links
    r: float = 0.06  # [mm] crank; > 0 < l; ± 0.05
    l: float = 0.24  # [mm] rod; > 0; ± 0.1

    # 1.2 Work
    F: float = 50e3  # [kN] force on the ram, constant over its way; >= 0; ± 5 % normal
    h: float = 0.02  # [mm] ram above its lowest place, where the work begins; > 0; ± 0.2
    M_max: float = 2500.0  # [N*m] what the drive can give; > 0

    """The fields above are made of these lines."""


@app.cell
def form():
    form = ask(Press)
    form
    return (form,)


@app.cell
def given(form):
    g = read(Press, form)
    Used(g)
    return (g,)


@app.cell(hide_code=True)
def section_2():
    mo.md(r"""
    ## 2 A line

    A formula is one line of Python: name, expression, then its unit and meaning. `typeset()` at the end of the cell
    prints the lines above it as you would write them, with their values. Names become symbols: `phi_1` is $\varphi_1$,
    `A_gc` is $A_\mathrm{gc}$. An input is `g.` and its name. A power is `**`; `pi`, `sqrt`, `sin` come from the first
    cell. Matrices are multiplied by `A @ B`, and so are vectors, shown as $v \cdot w$; `A * B` multiplies element by
    element, shown as $A \odot B$.

    A text between two lines is a string that stands by itself, in three quotes: it is shown where it stands.

    **Try** a click on the formula, and Ctrl-Enter for a new line: `k = g.l / g.r  # [-] rod to crank`.

    **Try** to spoil a unit: `[mm]` of the stroke as `[N]`. It is told, with the unit that fits: write units for reading
    and never convert in a formula.
    """)
    return


@app.cell
def stroke(g):
    H = 2 * g.r  # [mm] stroke of the ram
    beta_max = arcsin(g.r / g.l)  # [deg] greatest angle of the rod
    typeset()
    return


@app.cell(hide_code=True)
def section_3():
    mo.md("""
    ## 3 A function, and a field

    What depends on the position is a function, `lambda phi: ..`, or `def` where it is long. Given an array of positions
    it computes all of them at once: that is a field, and it needs no loop. What takes something of the turn before, as
    a series or steps of time, is one: `for i in range(1, g.n + 1): s += g.x**i / i`, below a line with `s = 0.0`.

    The first of a list that is enough is `next((d for d in D if d >= need), None)`. Where none is, its line has no
    number, which is told, and `d is None` asks for it.

    **Try** 25 positions instead of 13 in `linspace`.
    """)
    return


@app.cell
def ram(g):
    phi = linspace(0, pi, 13)  # [deg] crank, from the highest place of the ram to the lowest
    s = lambda phi: g.l + g.r + g.r * cos(phi) - sqrt(g.l**2 - (g.r * sin(phi)) ** 2)  # [mm] way left to the ram
    ds = lambda phi: g.r * sin(phi) * (g.r * cos(phi) / sqrt(g.l**2 - (g.r * sin(phi)) ** 2) - 1)  # [mm/rad] its slope
    s_k = s(phi)  # [mm] way left to the ram
    M = -g.F * ds(phi)  # [N*m] moment at the crank
    typeset()
    return M, ds, phi, s, s_k


@app.cell(hide_code=True)
def section_4():
    mo.md("""
    ## 4 A table and a chart

    `table` and `figure` take a number, a title and quantities; headings, units and decimals come from their lines.
    While the worksheet runs, a curve is computed between the points of the table too, where it follows from the
    quantity across. The pointer over a chart reads all its curves. A part that is dragged out over a chart fills it;
    Ctrl and the wheel enlarge it too, and a double click shows the whole again. It is printed as it is seen.

    **Try** to add `ds(phi)` to the table: it is refused, for a column is a name with a line of its own. Add that line
    to section 3 and the name to the table.
    """)
    return


@app.cell
def results(M, phi, phi_work, s_k):
    table_1 = table("1", "Press", phi, s_k, M)
    figure_1 = figure("1", "Moment at the crank", phi, M, marks={"phi_work": phi_work})
    typeset(table_1, figure_1)
    return


@app.cell(hide_code=True)
def section_5():
    mo.md("""
    ## 5 Given and Find

    `find` looks for the value at which a function equals something, between two ends: here the angle at which the work
    begins. It tells how it searched and what is left of the equation. Where the same number follows in another way,
    `closed_form` compares both, and the workbook computes it.

    **Try** a height `h` of 150 mm: no position has it, and you are told what can be reached.

    Several unknowns are found together, from guesses or in intervals, also for arrays of problems:

        xy_found = find(lambda x, y: (x**2 + y**2, y - x), equals=(g.r**2, 0), x=(0, 2), y=1.0)
        x = xy_found.value.x  # [mm] one of them

    `minerr` takes more equations than unknowns. `help("mechsheet.find")` says what the verdict tells.
    """)
    return


@app.cell
def work(g, s):
    work_found = find(
        s, 0, pi, equals=g.h, unknown="angle phi", quantity="way left to the ram", unit="mm", unknown_unit="deg"
    )
    phi_work = work_found.value  # [deg] crank where the work begins
    x_work = g.l + g.r - g.h  # [mm] ram from the crank's hinge
    phi_c = arccos((g.l**2 - g.r**2 - x_work**2) / (2 * g.r * x_work))  # [deg] the same by the law of cosines
    found_c = closed_form(work_found, phi_c)
    typeset(work_found, found_c)
    return found_c, phi_work


@app.cell(hide_code=True)
def section_6():
    mo.md("""
    ## 6 A check

    `check` compares a quantity, or what is left of two that should be equal, with a limit. Its verdict stands here, at
    the top of the page, in the workbook, and in the exit code of a run: a check that could not look at anything has not
    passed. Of a limit the check tells how much is taken, in per cent; the bar at the foot of the page names the worst
    one wherever you read, and a click leads to it. With `of`, the size of what two computations share, a check tells
    within what they agree. What must be at least something, such as a safety, is checked from below:
    `check("safety", S, at_least=g.S_min)`. `check_slope` compares a derivative with differences.

    **Try** a force of 90 kN. Then find with the field of `h` how much of the stroke the drive can work.
    """)
    return


@app.cell
def checks(ds, g, phi, phi_work, s):
    M_work = -g.F * ds(phi_work)  # [N*m] moment where the work begins
    strong = check("moment where the work begins", M_work, g.M_max, "N*m")
    right = check_slope("ds is the slope of s", ds(phi), s, phi, 0, pi, "m/rad")
    typeset(strong, right)
    return right, strong


@app.cell(hide_code=True)
def section_7():
    mo.md("""
    ## 7 A drawing

    Points are complex numbers, x + iy. A drawing is made of links, hinges, sliders, supports; a slider of the page
    moves it, and `player` gives it a play button. `mark` puts a line at its position into the charts.

    **Try** to press play, and to add `.force(B_t, 1j * g.F, "F", into=True)` to the drawing.
    """)
    return


@app.cell
def turn():
    turned = slider(0, 180, step=1, value=120, label="crank", unit="deg")
    player(turned)
    return (turned,)


@app.cell
def drawing(g, s, turned):
    phi_t = turned.value * deg  # [deg] crank as drawn
    A_t = g.r * 1j * exp(1j * phi_t)  # [m] pin of the crank
    B_t = -1j * (g.l + g.r - s(phi_t))  # [m] ram
    frame = [1j * g.r, -1j * g.r - g.l * 1j, g.r, -g.r]
    links = (
        Drawing(frame=frame).guide(-1j * (g.l - 2 * g.r), -1j * (g.l + 2 * g.r)).link(0, A_t, "r").link(A_t, B_t, "l")
    )
    press = links.support(0, "O", pi / 2).hinge(A_t, "A").slider(B_t, pi / 2).hinge(B_t, "B")
    typeset(press, mark(phi=phi_t), caption("2", "Press"))
    return


@app.cell(hide_code=True)
def section_8():
    mo.md("""
    ## 8 The same worksheet without the page

        python lib/mechsheet run guide --F=40 --r="55 mm"

    computes it with other inputs, prints what was found and every check, writes the workbook, and ends with exit code 0
    only if all checks pass: with 1 where one does not or an input is outside its limits, with 2 where what is given is
    not understood. Put a set of inputs in a file, `stiff.toml`, and it is a scene:

        [inputs]
        F = 40        # kN, the unit of the field
        h = 15        # mm

        [limits]
        M = { max = 2000 }  # N*m, at every position

    `run guide --tolerances` shows how far every result may be off within the tolerances, and how sure each check is,
    `--tolerances --want=M` the moment at every position, by the slopes, by random cases, and guaranteed.

    `run guide --scene=stiff.toml` runs it; with several files you get a table of scenes side by side. From Python, a
    worksheet is a function, and many variants are computed at once:

        from mechsheet import evaluate, grid, sensitivity, sweep, tolerance

        evaluate("worksheets/guide.py", ["M"], F=40)["M"]  # in SI units
        sweep("worksheets/guide.py", ["M"], grid(r=[50, 55, 60], F=[40, 50])).frame()

    What a scene does not ask for is not computed.

        python lib/mechsheet design guide --vary="r=50..70" --vary="h=10..40" --need="M <= 2700" --best="max H"
        python lib/mechsheet design guide --vary="h=10..60" --need="M_work = 2000"

    finds the inputs within bounds that meet all requirements, at every position, and have the best goal, or the one
    input that gives a result its value; it says how sure that is, and writes the scene `guide_designed.toml` into
    `exports/`, beside a worksheet of your own, or where `--out=FOLDER` says.

    On the page a list below the inputs offers the scenes beside the worksheet. Switches at its end mark every number
    that differs from the document, with its own behind it, and show the tolerances behind all numbers and in charts;
    fields there show what matters for a result: by how many percent it changes for one percent of each input. Below
    them is asked what it would take: the same as `design`, for the inputs of the page, with the scene to be saved.
    The last switch proves every number that the page shows, and greys the digits that are not proved.
    """)
    return


@app.cell(hide_code=True)
def section_9():
    mo.md("""
    ## 9 The workbook

    The button below, and every run, writes a workbook for Excel or LibreOffice. It is live: change a value on its sheet
    Inputs, and tables, charts and checks follow, for its cells hold the formulas of your lines. Lists and tables among
    the inputs are grids on the sheet Input tables.

    - A name means the cell of its own row. It is that of the worksheet without the `_S` of a field; a point has two,
      `X56` and `Y56`, a force `R56x` and `R56y`. A name that would be the address of a cell, or that differs from
      another in capitals only, gets a line behind it: `L3_`.
    - All lines stand on sheets at the end, by sections and in SI units, with the steps that a cell of their own holds;
      what a slider moves is that of its place at rest. A check that the cells look at in fewer places says where.
    - What is found is computed by its closed form where there is one, while that solves the equations. Else the cells
      search the interval of an equation of one unknown: where 97 places of it show a change of sign that is surely the
      one nearest the guess, or else the middle, there is a value. Of several unknowns with guesses they take the
      worksheet's own first eighteen steps, with a value where these surely end in the same root. All else that is found
      holds for the exported inputs alone, and the front sheet says why.
    - A spreadsheet takes two numbers for equal that agree in 15 digits. Where that decides, as of `3 * 0.1 <= 0.3`, its
      condition goes the other way than Python's, and the page's.
    - Where there is no number, a mechanism that does not close, an input outside its limits, cells say `#N/A`.
    - What the cells cannot follow is grey, holds for the exported inputs and says `#N/A` for others; the front sheet
      and the run name its line and the reason.

    A saved workbook is a scene too: `run guide --scene=guide.xlsx` computes with the inputs that you changed there, and
    `compare guide HEAD guide.xlsx` tells what changed since the last revision in git, and by how much.
    """)
    return


@app.cell
def workbook():
    export("Guide", globals())
    return


@app.cell(hide_code=True)
def section_10():
    mo.md("""
    ## 10 A worksheet of your own

        python lib/mechsheet new hinge
        python lib/mechsheet new hinge --like=bucket

    writes a small worksheet to start from, or one like an example. `help("mechsheet")` in Python lists all that a
    worksheet can use: groups of links (`rrr`, `RRPGroup`, ..), their velocities, accelerations and reactions, loads and
    drives, drawings, sweeps and design. Each name tells its arguments and units by `help("mechsheet.rrr")`.

        python lib/mechsheet rename hinge M_max M_lim

    gives a symbol another name in all lines, comments and texts of a worksheet, and in its scenes. In the editor a line
    that is given another name offers the same.

    A mechanism is written as its crank or cylinder, then one group a line, from which all else follows; the example
    `bucket` shows it with forces, `hitch` with everything that a document has. `engine` reads a file and drives a
    flywheel, `bolted_joint` has materials to choose from, load cases, inches and pounds, two unknowns.
    """)
    return


if __name__ == "__main__":
    app.run()
