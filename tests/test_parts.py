"""The contents of a worksheet as data, against what its page shows."""

import re
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from as_script import as_script
from openpyxl import load_workbook
from own_worksheet import own

from mechsheet.document.parts import Control, Line, Section, Text, contents, texts, values
from mechsheet.html import markdown
from mechsheet.html.write import page
from mechsheet.worksheet.cells import load
from mechsheet.worksheet.check import Check, Summary
from mechsheet.worksheet.drawing import Drawing
from mechsheet.worksheet.errors import SheetError
from mechsheet.worksheet.find import Found
from mechsheet.worksheet.inputs import Used
from mechsheet.worksheet.lines import Given
from mechsheet.worksheet.shown import Shown
from mechsheet.worksheet.table import Figure, Table
from mechsheet.worksheet.title import Caption, Player, Slider, Title
from mechsheet.worksheet.typeset import Typeset
from worksheets import hitch, joint, kinetostatics, landing_gear, slotted_link

SHEETS = {Path(sheet.__file__).stem: sheet for sheet in (hitch, joint, kinetostatics, landing_gear, slotted_link)}


def run(worksheet, g=None):
    """Namespace of a run of the whole worksheet."""
    sheet = load(worksheet)
    return sheet.run(sheet.results, {"g": sheet.inputs() if g is None else g})


@cache
def document_of(name):
    """The contents of a document with its own inputs."""
    return contents(run(SHEETS[name].__file__))


def parts(value):
    """Values that an output of the page shows one after the other."""
    if isinstance(value, Typeset):
        return [type(row) for row in value.rows] + [kind for shown in value.shown for kind in parts(shown)]
    if isinstance(value, tuple | list):
        return [kind for each in value for kind in parts(each)]
    return [Control if isinstance(value, Player | Slider) else type(value)] if isinstance(value, Shown) else []


@pytest.mark.parametrize("name", SHEETS)
def test_contents_are_what_the_page_shows_in_its_order(name):
    outputs, _ = SHEETS[name].app.run()
    page = [kind for output in outputs for kind in parts(output)]
    kinds = {Line: "Formula", Given: "Given"}
    found = [part for part in document_of(name) if not isinstance(part, Section | Text)]
    assert [kinds.get(type(part), type(part).__name__) for part in found] == [kind.__name__ for kind in page]


@pytest.fixture(scope="module")
def document():
    return document_of("hitch")


def of(document, kind):
    return [part for part in document if isinstance(part, kind)]


def test_sections_stand_in_their_order_with_their_texts(document):
    assert [part.title for part in of(document, Section) if part.level == 2] == [
        "1 Input data", "2 Geometry", "3 Kinematics", "4 Lifting capacity", "5 Forces", "6 Steering stability",
        "7 Check by the instant centre",
    ]  # fmt: skip
    at = document.index(Section(2, "2 Geometry"))
    assert document[at + 1].markdown.startswith("Points are complex numbers $x + iy$ from the rear axle.")
    assert isinstance(document[0], Title) and isinstance(document[1], Summary)


def test_numbered_parts_follow_each_other(document):
    assert [table.number for table in of(document, Table)] == ["2.1", "2.2", "3.1", "4.1", "5.1", "6.1", "7"]
    figures = [part.number for part in of(document, Figure) + of(document, Caption)]
    assert len(figures) == len(set(figures)) > 5
    assert len(of(document, Drawing)) >= 2 and len(of(document, Used)) == 1


def test_what_is_asked_stands_before_what_is_found(document):
    found = [document.index(part) for part in of(document, Found)]
    equations = [i for i, part in enumerate(document) if isinstance(part, Given)]
    assert len(found) == len(equations) == 3
    assert all(equation < root for equation, root in zip(equations, found, strict=True))


def test_every_check_stands_in_the_summary_and_at_its_place(document):
    (summary,) = of(document, Summary)
    assert {check.name for check in of(document, Check)} == {check.name for check in summary.checks}


def test_lines_hold_values_and_controls_what_they_set(document):
    lines = {part.formula.name: part for part in of(document, Line)}
    assert lines["L4"].formula.unit == "m" and 0.5 < lines["L4"].value < 0.7
    assert lines["P23"].value is None, "a function has none"
    assert of(document, Control)[0] == Control("part", "part of the stroke", 0, 1, 0.01, 0.2, False)


def test_texts_stand_between_what_a_cell_shows():
    document = document_of("kinetostatics")
    at = document.index(Text("The same vectors by the library:"))
    assert isinstance(document[at - 1], Line) and document[at - 1].formula.name == "gamma23"
    assert isinstance(document[at + 1], Line) and document[at + 1].formula.name == "R_A"


def test_every_part_is_data():
    """What a cell shows by marimo's own names, a text or a column, a writer could only skip."""
    known = Section | Text | Line | Given | Control | Shown
    assert [(name, part) for name in SHEETS for part in document_of(name) if not isinstance(part, known)] == []


def test_other_inputs_give_other_contents():
    heavy = {part.formula.name: part.value for part in of(contents(run(hitch.__file__, hitch.Hitch(P6=30e3))), Line)}
    light = {part.formula.name: part.value for part in of(document_of("hitch"), Line)}
    assert heavy["L4"] == light["L4"] and heavy.keys() == light.keys()
    assert np.all(abs(heavy["R56"]) > abs(light["R56"]))


# --- what the workbook and the report take ---------------------------------------------------------------------------

SHEET = """
import marimo

app = marimo.App()

with app.setup:
    import marimo as mo
    from mechsheet import check, export, figure, inputs, side_by_side, summary, table, typeset
    import numpy as np


@app.class_definition
@inputs
class Bar:
    b: float = 2.0  # [m] length; > 0


@app.cell
def top(ok):
    summary(ok, check("told in the summary alone", 0.0, 1.0))
    return


@app.cell
def given():
    g = Bar()
    return (g,)


@app.cell
def lengths(g):
    a = g.b * np.array([1.0, 2.0, 3.0])  # [m] a
    c = 2 * a  # [m] c
    _slack = 5.0
    ok = check("named", a[0] - g.b, 1e-9)
    typeset(check("under no name", _slack, 1.0), side_by_side(ok, table("1", "Beside", a, c)))
    return a, c, ok


@app.cell
def kept(a, c):
    _half = a / 2
    _slack = 7.0
    table_2 = table("2", "For the workbook alone", a, c)
    _worst = check("of a private name", np.max(_half), _slack)
    check_last = check("shown by no cell", 0.0, 1.0)
    if a[0] < 0:
        never = a
    typeset(_worst, table("2", "In short, for the page", a))
    return (check_last, table_2)


@app.cell
def alone(c):
    figure("1", "Shown and given by no name", c, c)
    return


@app.cell
def workbook():
    export("Bar", globals())
    return


if __name__ == "__main__":
    app.run()
"""
NAMES = [*("named", "under no name", "shown by no cell", "of a private name", "told in the summary alone")]


@pytest.fixture(scope="module")
def bar(tmp_path_factory):
    path = tmp_path_factory.mktemp("worksheets") / "bar.py"
    path.write_text(SHEET, encoding="utf-8")
    return path


def test_values_are_what_cells_give_or_show_each_once(bar):
    names = run(bar)
    assert [check.name for check in of(values(names), Check)] == NAMES
    assert {check.name: check.residual for check in of(values(names), Check)}["under no name"] == 5.0, "of its own cell"
    assert [shown.title for shown in of(values(names), Table | Figure)] == [
        *("Beside", "For the workbook alone", "Shown and given by no name")
    ]
    assert [shown.title for shown in of(contents(names), Table)] == ["In short, for the page"]


def test_a_check_that_a_page_shows_failing_makes_the_script_fail(bar, tmp_path):
    script = as_script(bar, f"--out={tmp_path}")
    told = [line for line in script.stdout.splitlines() if line.startswith(("pass", "FAIL"))]
    assert [line[6:].partition(":")[0] for line in told] == [*NAMES, "units"]
    assert [line[6:].partition(":")[0] for line in told if line.startswith("FAIL")] == ["under no name"]
    assert script.returncode == 1
    rows = load_workbook(tmp_path / "bar.xlsx")["Checks"].iter_rows(min_row=3, max_col=1)
    assert [row[0].value for row in rows][1 : 1 + len(NAMES)] == NAMES  # behind that of the inputs' limits


PLATE = '''
import marimo
app = marimo.App()

with app.setup:
    from mechsheet import inputs, typeset

@app.class_definition
@inputs
class Plate:
    a: float = 2.0  # [m] side

@app.cell
def given():
    g = Plate()
    return (g,)

@app.cell
def areas(g):
    r"""
    ## 1 Area

    Of the side $a_1$:
    """
    A = g.a**2  # [m**2] area
    """### 1.1 Half of it"""
    half = A / 2  # [m**2] half
    above = typeset()
    """By another cell."""
    twice = A * 2  # [m**2] twice
    below = typeset("Its end.")
    return above, below

@app.cell
def areas_shown(above, below):
    typeset(above, below)
    return
'''


def test_a_text_stands_between_the_lines_of_its_cell_and_is_as_written_for_every_input(tmp_path):
    (sheet := tmp_path / "plate.py").write_text(PLATE)
    names = run(sheet)
    found = [getattr(part, "formula", part) for part in contents(names)]
    assert [getattr(part, "name", part) for part in found] == [
        *(Section(2, "1 Area"), Text("Of the side $a_1$:"), "A", Section(3, "1.1 Half of it"), "half"),
        *(Text("By another cell."), "twice", Text("Its end.")),
    ]
    assert [cell.section for cell in load(sheet).cells] == ["", "1 Area", "1 Area"]
    assert re.search(
        r'<h3[^>]*>1\.1 Half of it</h3>.*id="line-half".*<p>By another cell', page(load(sheet), names["g"]), re.S
    )


def test_a_text_between_lines_has_no_values_in_it(tmp_path):
    (sheet := tmp_path / "plate.py").write_text(PLATE.replace('"""By another', 'f"""By {g.a}'))
    with pytest.raises(SheetError, match=r"plate.py, line 29: a text with values in it belongs to mo.md or to typeset"):
        run(sheet)


def test_of_a_run_for_some_results_it_is_what_its_cells_show(bar):
    sheet = load(bar)
    asked = sheet.run(["table_2"], {"g": sheet.inputs()})
    del asked["table_2"]  # as if the cell had not come to its end
    assert [check.name for check in of(values(asked), Check)][:2] == ["named", "under no name"]
    assert all(check.name != "of a private name" for check in of(values(asked), Check))


@pytest.mark.parametrize(
    ("shown", "told"),
    [
        ("np.zeros(2)", "ndarray: shown in the worksheet alone"),
        ("2.5 * 2", "float: shown in the worksheet alone"),
        ('mo.callout("Mind the bolts")', "what marimo shows: shown in the worksheet alone"),
        ('mo.vstack([mo.md("so it is"), table("2", "Two", x)])', "what marimo shows: shown in the worksheet alone"),
        ('mo.vstack([table("2", "Two", x)])', ""),
    ],
)
def test_what_a_page_in_one_file_cannot_show_is_named(tmp_path, shown, told):
    """An array, a number, a text that marimo shows: all of it was left out without a word."""
    path = Path(own(tmp_path, "import marimo as mo").path)
    path.write_text(path.read_text().replace("    typeset()\n", f"    {shown}\n"))
    text = page(load(path), load(path).inputs())
    assert text.count("shown in the worksheet alone") == bool(told) and told in text
    assert ('id="table-2"' in text) is ("table(" in shown)


@pytest.mark.parametrize(
    ("lines", "says"),
    [
        (
            'check_2 = check("load", g.F, 9.0)\ncheck_3 = check("load", g.a, 9.0)',
            "two checks are called 'load': give each a name of its own",
        ),
        (
            'several = [check("load", q, 9.0) for q in (g.F, g.F)]',
            "two checks are called 'load': give each a name of its own",
        ),
        (
            'table_2 = table("2", "Forces", x)\ntable_3 = table("2", "Parts", x)',
            "two tables have the number 2: give each a number of its own",
        ),
        (
            "\n".join(f'figure_{n} = figure("4", "{n}", x, x)' for n in (2, 3)),
            "two figures have the number 4: give each a number of its own",
        ),
        ('check_2 = check("load", g.F, 9.0)\ncheck_3 = check_2\npair = (check_2, check_3)', ""),
        ('table_2 = table("2", "Forces", x)\nfigure_2 = figure("2", "Forces", x, x)', ""),
    ],
)
def test_what_is_told_by_its_name_has_one_of_its_own(lines, says, tmp_path):
    """Else the formulas of one would stand under both, in the workbook and on the page in one file."""
    sheet = own(tmp_path, lines)
    path = Path(sheet.path)
    path.write_text(path.read_text().replace("import ask, find", "import ask, check, find", 1))
    sheet = load(path)
    for of in (lambda: values(sheet.run_whole()), lambda: page(sheet, sheet.inputs())):
        if not says:
            of()
            continue
        with pytest.raises(SheetError) as error:
            of()
        assert str(error.value) == says


def test_code_below_a_heading_stays_code():
    """Its first line is indented as the others are."""
    below = [
        part.markdown for part in texts("""
        ## 1 How

            python run

        tells it.
        """) if isinstance(part, Text)
    ]  # fmt: skip
    assert below == ["    python run\n\ntells it."] and "<code>python run" in markdown.html(below[0])
