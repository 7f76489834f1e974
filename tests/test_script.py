"""The hitch worksheet and the template as scripts: exit codes, messages, what is written and what is left alone."""

import subprocess
import sys
from pathlib import Path

import pytest
from as_script import as_file, as_script, copied
from openpyxl import load_workbook
from own_worksheet import written

from mechsheet import __main__ as launcher
from mechsheet.worksheet.cells import load

HITCH = Path(__file__).parents[1] / "worksheets" / "hitch.py"
GUIDE = HITCH.with_name("guide.py")
LEVER = Path(launcher.__file__).parent / "run" / "new_worksheet.txt"


BESIDE = """import marimo
app = marimo.App()
with app.setup:
    from mechsheet import ask, inputs, read

    @inputs
    class Given:
        a: float = 1.0  # [m] length

@app.cell
def _():
    k = 3.0
    form = ask(Given)
    form
    return form, k

@app.cell
def _(form):
    g = read(Given, form)
    return (g,)

@app.cell
def _(g, k):
    c = k * g.a  # [m] all
    return (c,)
"""


def test_what_stands_beside_the_form_is_a_number_as_any_other(tmp_path):
    """Asked again for it, the form answered once more, and so without an end."""
    (tmp_path / "own.py").write_text(BESIDE, encoding="utf-8")
    told = as_script(tmp_path / "own.py", "--a=4", "--want=c")
    assert (told.stdout, told.returncode) == ("c = 12 m, all\n", 0), told.stderr


# The program that marimo makes of a worksheet, which is what it was before its cells were run from the file.
BY_MARIMO = "import runpy, sys; del sys.argv[0]; runpy.run_path(sys.argv[0], run_name='sheet')['app'].run()"


def run(*arguments: str, sheet: Path = HITCH) -> subprocess.CompletedProcess[str]:
    """By its command."""
    if sheet is HITCH:
        load(sheet)  # once, not in each of the copies
    return as_script(sheet, *arguments)


def run_by_marimo(sheet: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    return copied(lambda: exec(BY_MARIMO), ["-c", BY_MARIMO], sheet, *arguments)


@pytest.fixture(scope="module")
def started(tmp_path_factory):
    """What ``python hitch.py`` as a process of its own prints and writes, with all that it imports among its errors."""
    out = tmp_path_factory.mktemp("started")
    command = [sys.executable, "-X", "importtime", str(HITCH), f"--out={out}"]
    return subprocess.run(command, capture_output=True, encoding="utf-8"), out


def test_writes_the_workbook_and_reports(started):
    done, out = started
    errors = [line for line in done.stderr.splitlines() if not line.startswith("import time:")]
    assert (done.returncode, errors) == (0, [])
    lines = done.stdout.splitlines()
    assert [line.split(" = ")[1][:8] for line in lines[:3]] == ["0.66128 ", "0.46936 ", "0.75217 "]
    assert sum(line.startswith("pass  ") for line in lines) >= 15
    assert lines[-1] == f"written {out / 'hitch.xlsx'}"
    assert [p.name for p in out.iterdir()] == ["hitch.xlsx"]


def test_script_leaves_out_what_it_does_not_show(started):
    """Nor does marimo, which the file itself has loaded, run its cells."""
    loaded = {line.rsplit("|", 1)[-1].strip() for line in started[0].stderr.splitlines()}
    assert loaded >= {"xlsxwriter", "marimo"}
    assert not {"altair", "pandas", "openpyxl", "matplotlib", "marimo._output.formatters.formatters"} & loaded


def test_scene_and_arguments_replace_inputs_in_display_units(tmp_path):
    scene = tmp_path / "scene.toml"
    scene.write_text("[inputs]\nF = 900\nW = 5\n")
    out = tmp_path / "out"
    assert run(f"--scene={scene}", "--F=1000,5", f"--out={out}", sheet=changed(tmp_path)).returncode == 0
    used = {row[0]: row[1] for row in load_workbook(out / "lever.xlsx")["Inputs"].iter_rows(values_only=True)}
    assert (used["F"], used["W"], used["L"]) == (1000.5, 5, 0.35)


def test_wanted_results_are_printed_with_their_units_and_nothing_else_is_computed(tmp_path):
    done = run("--P6=20e3", "--want=L4,GS6", "--want=P56_S.imag", "--want=group (2, 3) closes", f"--out={tmp_path}")
    assert (done.returncode, done.stderr) == (0, "")
    lines = done.stdout.splitlines()
    for line, start in zip(lines, ("L4 = 0.661283 m, ", "GS6 = 29958.8..", "P56_S.imag = "), strict=False):
        assert line.startswith(start)
    judged = [line for line in lines[3:] if not line.startswith("written ")]
    assert all(line.startswith("pass  ") for line in judged) and "group (2, 3) closes" in done.stdout
    assert "equilibrium" not in done.stdout
    assert [p.name for p in tmp_path.iterdir()] == ["hitch_scenes.xlsx"]


@pytest.mark.parametrize(
    ("argument", "message", "code"),
    [
        ("--L5=-0.48", "error: lower link, to the lifting rod L5 = -0.48 m must be positive", 1),
        ("--S_min=0.7", "error: least length of the cylinder S_min = 0.7 m must be < S_max = 0.67 m", 1),
        ("--L55=1", "error: input L55 is unknown; nearest: L5, L56", 2),
        ("--P6=heavy", "error: weight of the implement P6 = 'heavy' N is no number", 2),
        ("--P6", "error: argument '--P6' must be --NAME=VALUE", 2),
        ("--N_pol=1", "error: number of positions N_pol = 1 must be >= 2", 1),
        ("--scene=none.toml", "error: scene none.toml cannot be read", 2),
        ("--S_max=0.9", "error: group (2, 3) closes: no position closes for cylinder S = 0.7", 1),
        ("--L3=2", "error: no position closes for cylinder S = 0.42 m: it reaches 1.42", 1),
        ("--k_gc=1e70", "error: number of cylinders k_gc = ", 1),
        ("--want=GS66", "error: GS66 is defined by no cell of", 2),
        ("--want=F_T0,no check", "error: no check is named 'F_T0,no check'", 2),
        ("--out=", "error: argument '--out=' must be --NAME=VALUE", 2),
        ("--Y56_min=-2", "error: lifting rod L4", 1),
        ("--Y_P56=3", "error: working stroke S_p", 1),
        ("--phi_P6=1", "error: group (6, 7) closes: no position closes for distance O7 P56 = ", 1),
    ],
)
def test_bad_input_is_one_line_and_touches_no_file(tmp_path, argument, message, code):
    """What is given cannot be used, which is 2; or the worksheet refuses the value or does not close with it."""
    old = tmp_path / "hitch.xlsx"
    old.write_bytes(b"old")
    done = run(f"--out={tmp_path}", argument)
    assert done.returncode == code
    assert done.stderr.startswith(message)
    assert done.stderr.count("\n") == 1
    assert [p.name for p in tmp_path.iterdir()] == ["hitch.xlsx"]
    assert old.read_bytes() == b"old"


def changed(tmp_path: Path, old: str = "", new: str = "") -> Path:
    """A worksheet from the template with some of its text replaced."""
    text = LEVER.read_text(encoding="utf-8").replace("TITLE", "Lever")
    assert old in text
    (tmp_path / "worksheets").mkdir()
    sheet = tmp_path / "worksheets" / "lever.py"
    sheet.write_text(text.replace(old, new, 1), encoding="utf-8")
    return sheet


def test_unwritable_folder_is_one_line(tmp_path):
    (tmp_path / "file").write_text("")
    done = run(f"--out={tmp_path / 'file'}", sheet=changed(tmp_path))
    assert done.returncode == 1
    assert done.stderr.startswith("error: ") and done.stderr.count("\n") == 1


def test_stopped_cell_is_no_success(tmp_path):
    sheet = changed(tmp_path, "    table_1 = ", "    mo.stop(True)\n    table_1 = ")
    done = run(f"--out={tmp_path}", sheet=sheet)
    assert (done.returncode, done.stderr) == (1, "error: cell results stopped before its end\n")
    by_marimo = run_by_marimo(sheet, f"--out={tmp_path}")
    missing = by_marimo.stderr.partition("SheetError: some cells did not run: ")[2]
    assert by_marimo.returncode == 1 and "table_1" in missing
    assert not (tmp_path / "lever.xlsx").exists()


def test_failed_check_is_no_success_but_is_written(tmp_path):
    sheet = changed(tmp_path, "M(phi_max) - g.M_max", "M(phi_max) - 1.001 * g.M_max")
    done = run(f"--out={tmp_path}", sheet=sheet)
    assert done.returncode == 1
    assert "FAIL  moment at the angle found" in done.stdout
    assert (tmp_path / "lever.xlsx").exists()


def test_raising_cell_is_no_success(tmp_path):
    sheet = changed(tmp_path, "    table_1 = ", "    1 / 0\n    table_1 = ")
    done = run(f"--out={tmp_path}", sheet=sheet)
    assert done.returncode == 1
    assert "division by zero" in done.stderr
    assert not (tmp_path / "lever.xlsx").exists()


@pytest.mark.parametrize(
    ("old", "new", "where", "told"),
    [
        ("# [MPa] stress", "# [MPaa] stress", "sigma", "unit [MPaa] is not known; nearest: MPa"),
        ("# [N] force", "# [Nn] force", "F: ", "unit [Nn] is not known; nearest: nN"),
    ],
    ids=["line", "input"],
)
def test_an_unknown_unit_fails_the_check_of_units_and_nothing_else(tmp_path, old, new, where, told):
    sheet = changed(tmp_path, old, new)
    done = run(f"--out={tmp_path}", sheet=sheet)
    assert done.returncode == 1 and (tmp_path / "lever.xlsx").exists()
    failed = [line for line in done.stdout.splitlines() if line.startswith("FAIL")]
    line = next(n for n, text in enumerate(sheet.read_text(encoding="utf-8").splitlines(), 1) if new in text)
    assert len(failed) == 1 and failed[0].startswith(f"FAIL  units: 1 <= 0 mistakes; line {line}, {where}")
    assert told in failed[0]


def test_implement_beyond_the_machine_fails_but_is_written(tmp_path):
    done = run("--P6=1e12", "--want=front axle keeps its least load", "--want=P_gc", f"--out={tmp_path}")
    assert done.returncode == 1
    assert "FAIL  front axle keeps its least load" in done.stdout
    assert (tmp_path / "hitch_scenes.xlsx").exists()


@pytest.fixture(scope="module")
def by_marimo(tmp_path_factory):
    """What marimo's own program of the file prints and writes."""
    out = tmp_path_factory.mktemp("marimo")
    return run_by_marimo(GUIDE, f"--out={out}"), out


@pytest.mark.parametrize("way", [as_file, as_script], ids=["itself", "command"])
def test_cells_are_run_from_the_file_to_the_same_report_and_workbook_as_by_marimo(tmp_path, way, by_marimo):
    (by_marimo, other), own = by_marimo, tmp_path / "own"
    done = way(GUIDE, f"--out={own}")
    assert (by_marimo.returncode, done.returncode) == (0, 0), by_marimo.stderr + done.stderr
    assert done.stdout == by_marimo.stdout.replace(str(other), str(own))
    assert (own / "guide.xlsx").read_bytes() == (other / "guide.xlsx").read_bytes()


def test_a_worksheet_that_imports_in_a_cell_is_run_once_by_marimo(tmp_path):
    """Its cells have begun by then."""
    sheet = tmp_path / "own.py"
    cell = (
        "@app.cell\ndef one():\n    print('begun')\n    from mechsheet import dot\n    print(dot(2, 3))\n    return\n"
    )
    sheet.write_text(f"import marimo\napp = marimo.App()\n\n{cell}\nif __name__ == '__main__':\n    app.run()\n")
    assert as_file(sheet).stdout.splitlines() == ["begun", "6.0"]


def test_what_a_worksheet_does_with_what_marimo_runs_of_it_is_done(tmp_path):
    end = "    app.run()\n"
    assert LEVER.read_text(encoding="utf-8").endswith(end)
    sheet = changed(tmp_path, end, '    _, defs = app.run()\n    print(type(defs["g"]).__name__)\n')
    done = as_file(sheet, f"--out={tmp_path}")
    assert done.stdout.endswith("Given\n"), done.stdout + done.stderr


SAID = """
M = 2 * g.F  # [N·m] moment
for k in range(2):
    print("in a loop", k, M)
N = told(M)  # [N·m] more
print("in a call", [print("inside") for _ in range(1)])
sys.stdout.write("in a stream\\n")
with open(Path(__file__).with_name("kept.txt"), "a") as kept:
    kept.write("line ")
logging.getLogger("told").error("logged")
log.error("logged too")
sys.stderr.write("in errors\\n")
warnings.warn("warned")
typeset(M, N)
print("last", M) if M > 0 else None
"""


@pytest.mark.parametrize("title", ["Said", ""], ids=["exported", "not exported"])
def test_what_a_cell_prints_is_said_once(tmp_path, title):
    """Though its lines are run once more to be followed by the cells, and the last one to be shown."""
    setup = "import logging, sys, warnings\nfrom pathlib import Path\n"
    setup += 'log = logging.getLogger("own")\nfrom mechsheet import ask, export, inputs, read, typeset'
    text = written(setup, "F: float = 2.5  # [N·m] load", SAID.strip(), title)
    function = '@app.function\ndef told(M):\n    print("in a function")\n    return M + M\n\n\n'
    path = tmp_path / "said.py"
    path.write_text(text.replace("@app.cell\n", function + "@app.cell\n", 1), encoding="utf-8")
    command = [sys.executable, "-m", "mechsheet", "run", path]
    done = subprocess.run(
        command, capture_output=True, encoding="utf-8"
    )  # what a copy of this process logs is pytest's
    said = ["in a loop 0 5.0", "in a loop 1 5.0", "in a function", "inside", "in a call [None]", "in a stream"]
    said.append("last 5.0")
    lines = [line for line in done.stdout.splitlines() if line.partition(" ")[0] in ("in", "inside", "last")]
    assert (done.returncode, lines) == (0, said)
    told = ["logged", "logged too", "in errors", 'said.py, line 51, warnings.warn("warned"): warned']
    assert done.stderr.splitlines() == told
    assert (tmp_path / "kept.txt").read_text() == "line "


def test_a_division_by_zero_is_told_as_the_worksheets_own_and_a_place_among_infinite_numbers_is_grey(tmp_path):
    """Python's own words name a file of the library; and no cell of a spreadsheet holds an infinite number."""
    setup = "import numpy as np\nfrom mechsheet import ask, check, export, inputs, read, table, typeset"
    lines = "phi = np.linspace(1, 0, 4)  # [rad] angle\nQ = np.minimum(g.F / np.tan(phi), 9.0)  # [N] press\n"
    lines += (
        "phi_Q = phi[Q.argmax()]  # [rad] where\nt = table('1', 'Press', phi, Q)\nlast = check('at', phi_Q, 2, 'rad')\n"
    )
    path = tmp_path / "press.py"
    text = written(setup, "F: float = 2.5  # [N] force", f"{lines}typeset(t, last)", "Press")
    path.write_text(text, encoding="utf-8")
    done = run(sheet=path)
    assert done.returncode == 0
    (told,) = done.stderr.splitlines()
    assert told.startswith("press.py, line ") and told.endswith("divide by zero encountered in divide")
    assert "phi_Q: an infinite number is among those compared, which no cell of a spreadsheet holds" in done.stdout
    assert "RuntimeWarning" not in run("--proof", sheet=path).stderr
