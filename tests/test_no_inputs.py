"""Worksheets of one's own that only define and compute: without inputs, without an export, or without either."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from as_script import as_command, as_file, as_script
from openpyxl import load_workbook

from mechsheet import SheetError, evaluate, results, sensitivity, sweep
from mechsheet.html import write
from mechsheet.run import compare, glance, html
from mechsheet.studies import asked_design
from mechsheet.worksheet import cells
from mechsheet.worksheet.no_inputs import NoInputs

SETUP = """
with app.setup:
    import marimo as mo
    from numpy import pi

    from mechsheet import ask, check, export, inputs, read, table, typeset
    from mechsheet.units import MPa, kN, m, mm, s
"""
# The same imports as marimo's editor makes them of somebody who has never heard of a setup.
IMPORTING = """
@app.cell
def _():
    from numpy import pi
    from mechsheet import check, table, typeset
    from mechsheet.units import MPa, kN, m, mm, s
    return MPa, check, kN, m, mm, pi, s, table, typeset
"""
ROD = """
@app.cell
def rod():
    F = 12 * kN  # [kN] pull
    d = 10 * mm  # [mm] diameter
    sigma = F / (pi * d**2 / 4)  # [MPa] stress
    checks = (check("stress", sigma, 200 * MPa, "MPa"), check("pull", F, 15 * kN, "kN"))
    typeset(*checks)
    return (sigma,)


@app.cell
def fall(sigma):
    g = 9.81 * m / s**2  # [m/s**2] gravity, which is no class of inputs
    v = g * 2 * s  # [m/s] speed after two seconds
    more = check("speed at the end", v, 30 * m / s, "m/s")
    typeset(more)
    return
"""
TABLE = """
@app.cell
def listed(d, F):
    table_1 = table("1", "Rod", F, d)
    return
"""
EXPORT = """
@app.cell
def book():
    export("Rod", globals())
    return
"""
INPUTS = """
@app.class_definition
@inputs
class Rod:
    F: float = 12 * kN  # [kN] pull; > 0

@app.cell
def given():
    form = ask(Rod)
    return (form,)

@app.cell
def machine(form):
    g = read(Rod, form)
    return (g,)

@app.cell
def rod(g):
    sigma = g.F / (100 * mm**2)  # [MPa] stress
    strong = check("stress", sigma, 200 * MPa, "MPa")
    typeset(strong)
    return
"""
NOTHING = 'no workbook is written: no cell calls export("rod", globals())'


def sheet(folder: Path, *parts: str, old: str = "", new: str = "") -> Path:
    text = "\n".join(["import marimo\n\napp = marimo.App()", *parts, 'if __name__ == "__main__":\n    app.run()\n'])
    assert old in text
    path = folder / "rod.py"
    path.write_text(text.replace(old, new) if old else text, encoding="utf-8")
    return path


@pytest.fixture
def rod(tmp_path: Path) -> Path:
    return sheet(tmp_path, SETUP, ROD)


# --- as a script -------------------------------------------------------------------------------------------------


def test_all_checks_are_judged_and_it_is_told_why_there_is_no_workbook(rod: Path) -> None:
    """Those of a group too, and the units, which are a check as in any worksheet."""
    done = as_script(rod)
    assert (done.returncode, done.stderr) == (0, "")
    lines = done.stdout.splitlines()
    names = ["stress", "pull", "speed at the end", "units"]
    assert [line.partition(":")[0] for line in lines[:-1]] == [f"pass  {name}" for name in names]
    assert lines[-1] == NOTHING and [*rod.parent.iterdir()] == [rod]


def test_a_check_that_fails_is_no_success(tmp_path: Path) -> None:
    done = as_script(sheet(tmp_path, SETUP, ROD, old="15 * kN", new="11 * kN"))
    assert done.returncode == 1 and "FAIL  pull: 12 <= 11 kN" in done.stdout


@pytest.mark.parametrize(
    "parts", [(SETUP, ROD), (IMPORTING, ROD.replace("def rod()", "def rod(MPa, check, kN, mm, pi)"))]
)
def test_the_started_file_tells_the_same_as_the_command(tmp_path: Path, parts: tuple[str, ...]) -> None:
    """Where its cells import the package, marimo runs them, and the report comes at the end of the process."""
    path = sheet(tmp_path, *parts, old="200 * MPa", new="100 * MPa")
    own, command = as_file(path), as_script(path)
    assert own.returncode == command.returncode == 1
    assert own.stdout == command.stdout and "FAIL  stress" in own.stdout
    for argument in ("--want=sigma", "--F=3"):
        own, command = as_file(path, argument), as_script(path, argument)
        assert (own.returncode, own.stdout, own.stderr) == (command.returncode, command.stdout, command.stderr)


def test_cells_that_marimo_runs_are_run_once(tmp_path: Path) -> None:
    """They have begun before the package is there: the report is made of what they have given."""
    setup = "with app.setup:\n    import mechsheet\n    from mechsheet.units import N\n"
    cell = "@app.cell\ndef _():\n    print('begun')\n    c = mechsheet.check('force', 2 * N, 1 * N, 'N')\n    return\n"
    done = as_file(sheet(tmp_path, setup, cell))
    assert done.returncode == 1 and done.stdout.count("begun\n") == 1
    assert "FAIL  force: 2 <= 1 N" in done.stdout and done.stdout.endswith(NOTHING + "\n")


@pytest.mark.parametrize(
    ("old", "new", "told"),
    [
        ("= 10 * mm", "= 10 * nn", "rod.py, line 16, d = 10 * nn: the name nn is not defined in any cell"),
        ("    d = 10 * mm", "    d = 0 * mm\n    [][1]", "rod.py, line 17, [][1]: [] is empty: there is none at 1"),
    ],
)
def test_a_mistake_is_told_in_a_line(tmp_path: Path, old: str, new: str, told: str) -> None:
    done = as_script(sheet(tmp_path, SETUP, ROD, old=old, new=new))
    assert (done.returncode, done.stdout, done.stderr) == (1, "", f"error: {told}\n")


def test_a_wrong_unit_fails(tmp_path: Path) -> None:
    done = as_script(sheet(tmp_path, SETUP, ROD, old="# [mm] diameter", new="# [kN] diameter"))
    assert done.returncode == 1
    assert "FAIL  units: 1 <= 0 mistakes; line 16, d: unit [kN] does not fit; the value is in m\n" in done.stdout


def test_an_open_essential_check_is_refused(tmp_path: Path) -> None:
    """As where a group does not close: nothing behind it is told."""
    path = sheet(tmp_path, SETUP, ROD, old='"kN"))', new='"kN"), Check("closes", 2, 0, "-", "open", essential=True))')
    path.write_text(path.read_text(encoding="utf-8").replace("import ask,", "import Check, ask,"), encoding="utf-8")
    done = as_script(path)
    assert (done.returncode, done.stdout, done.stderr) == (1, "", "error: closes: open\n")


def test_nothing_but_text_has_nothing_to_judge(tmp_path: Path) -> None:
    """Not even units, which would have passed over nothing; its page is one all the same."""
    path = sheet(tmp_path, SETUP, '@app.cell\ndef _():\n    mo.md("# Only this text")\n    return\n')
    done = as_script(path)
    assert (done.returncode, done.stdout, done.stderr) == (0, NOTHING + "\n", "")
    assert "Only this text" in write.page(cells.load(path), NoInputs())


def test_an_export_writes_the_workbook(tmp_path: Path) -> None:
    done = as_script(sheet(tmp_path, SETUP, ROD, TABLE, EXPORT))
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout.splitlines()[-1] == f"written {tmp_path / 'rod.xlsx'}"
    book = load_workbook(tmp_path / "rod.xlsx")
    assert [book["1 Rod"].cell(3, n).value for n in (1, 2)] == ["F", "d"]
    names = [row[0] for row in book["Checks"].iter_rows(min_row=3, values_only=True)]
    assert names == ["stress", "pull", "speed at the end", "units"], "and none of inputs, where there are none"


def test_inputs_without_an_export_are_judged(tmp_path: Path) -> None:
    path = sheet(tmp_path, SETUP, INPUTS)
    assert as_script(path).stdout.splitlines()[-1] == NOTHING
    done = as_script(path, "--F=30")
    assert done.returncode == 1 and "FAIL  stress: 300 <= 200 MPa" in done.stdout


# --- arguments and scenes ----------------------------------------------------------------------------------------


def test_arguments_that_can_be_used_are(rod: Path) -> None:
    done = as_script(rod, "--want=sigma")
    assert done.returncode == 0
    assert done.stdout.startswith("sigma = 152.789 MPa, stress\n") and "speed" not in done.stdout
    assert "pass  speed at the end" in as_script(rod, "--want=speed at the end").stdout
    assert "pass  every number proved to 9 digits" in as_script(rod, "--proof").stdout
    scene = rod.with_name("scene.toml")
    scene.write_text("[limits]\nsigma = {max = 150}\n")
    done = as_script(rod, f"--scene={scene}")
    assert done.returncode == 1 and "FAIL  sigma <= 150 MPa" in done.stdout


@pytest.mark.parametrize(
    ("argument", "told", "code"),
    [
        ("--F=3", "input F is unknown; the worksheet has none", 2),
        ("--g=3", "input g is unknown; the worksheet has none", 2),
        ("--scene=scene.toml", "input F is unknown; the worksheet has none", 2),
        ("--tolerances", "the worksheet has no inputs that could have tolerances", 1),
    ],
)
def test_arguments_that_need_inputs_are_refused(
    rod: Path, monkeypatch: pytest.MonkeyPatch, argument: str, told: str, code: int
) -> None:
    rod.with_name("scene.toml").write_text("[inputs]\nF = 3\n")
    monkeypatch.chdir(rod.parent)
    done = as_script(rod, argument)
    assert (done.returncode, done.stdout, done.stderr) == (code, "", f"error: {told}\n")


def test_a_folder_for_what_is_not_written_is_refused(rod: Path) -> None:
    """Who waits for a file must not take the run for a success."""
    done = as_script(rod, f"--out={rod.parent / 'out'}")
    assert (done.returncode, done.stderr) == (2, f"error: --out={rod.parent / 'out'}: {NOTHING}\n")


def test_inputs_that_no_cell_asks_for_are_refused(tmp_path: Path) -> None:
    """They would be left out without a word."""
    path = sheet(tmp_path, SETUP, INPUTS, old="read(Rod, form)", new="Rod()")
    path.write_text(path.read_text(encoding="utf-8").replace("form = ask(Rod)", "form = 1"), encoding="utf-8")
    assert as_script(path).returncode == 0
    done = as_script(path, "--F=30")
    assert (done.returncode, done.stdout) == (2, "") and "asks for inputs, as ask(..) does: given is F" in done.stderr


def test_a_class_of_inputs_in_a_cell_is_no_worksheet_without_inputs(tmp_path: Path) -> None:
    """Its page would hold them fast without a word."""
    inside = "@app.cell\ndef given():\n    @inputs\n    class Rod:\n        F: float = 2.0  # [N] pull\n    g = Rod()\n"
    path = sheet(tmp_path, SETUP, inside + "    return (g,)\n")
    with pytest.raises(SheetError, match="declares its inputs, Rod, in cell given, where it cannot be set"):
        evaluate(path, ["g"])


# --- results by name ---------------------------------------------------------------------------------------------


def test_results_are_given_by_name_also_the_one_that_is_called_g(rod: Path) -> None:
    for _ in range(3):  # with inputs the second time is recorded, the third computed from it
        found = evaluate(rod, ["sigma", "g", "speed at the end"])
        assert found["sigma"] == pytest.approx(12e3 / (3.141592653589793 * 0.01**2 / 4), rel=1e-15)
        assert found["g"] == 9.81 and found["speed at the end"].passed
    assert "g" in results(rod) and "g" in cells.load(rod).results
    for given in ({"F": 3}, {"g": 3}):
        with pytest.raises(SheetError, match="is unknown; the worksheet has none"):
            evaluate(rod, ["sigma"], **given)


def test_what_needs_inputs_is_refused(rod: Path) -> None:
    with pytest.raises(SheetError, match=r"rod\.py has no inputs by which its results could differ"):
        sensitivity(rod, ["sigma"])
    with pytest.raises(SheetError, match="input F is unknown; the worksheet has none"):
        sweep(rod, ["sigma"], {"F": [1.0, 2.0]})


@pytest.mark.parametrize(
    ("command", "told", "code"),
    [
        ((asked_design, "--vary=F=1..2", "--best=max sigma"), "has no inputs by which its results could differ", 1),
        ((compare, "rod.py", "scene.toml"), "input F is unknown; the worksheet has none", 2),
        ((html, "--F=3"), "input F is unknown; the worksheet has none", 2),
    ],
    ids=["design", "compare", "html"],
)
def test_commands_that_are_given_inputs_refuse_them(
    rod: Path, command: tuple[Any, ...], told: str, code: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    rod.with_name("scene.toml").write_text("[inputs]\nF = 3\n")
    monkeypatch.chdir(rod.parent)
    program, *options = command
    done = as_command(program, rod.name, *options)
    assert done.returncode == code and done.stdout == ""
    assert done.stderr.count("\n") == 1 and told in done.stderr


def test_two_states_are_compared(rod: Path) -> None:
    other = rod.with_name("other.py")
    other.write_text(rod.read_text(encoding="utf-8").replace("12 * kN", "13 * kN"), encoding="utf-8")
    done = as_command(compare, rod, rod, other)
    assert done.returncode == 1 and "F: 12 kN -> 13 kN  +1 kN" in done.stdout


# --- pages -------------------------------------------------------------------------------------------------------


def test_the_page_in_one_file_has_its_lines_and_no_fields(rod: Path) -> None:
    page = write.page(cells.load(rod), NoInputs())
    assert 'id="line-sigma"' in page and "speed after two seconds" in page and "152.79" in page
    assert "ms-inputs" not in page.partition("</style>")[2].partition("<script")[0]


def test_the_start_page_tells_its_verdict(rod: Path) -> None:
    made = glance.computed(rod)
    assert (made.kind, made.told) == ("PASS", "3 of 3 checks pass")
