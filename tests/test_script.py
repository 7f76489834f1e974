"""The hitch worksheet as a script: exit codes, messages, what is written and what is left alone."""

import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

import pytest
from as_script import as_script
from openpyxl import load_workbook

HITCH = Path(__file__).parents[1] / "worksheets" / "hitch.py"
# The program that marimo makes of a worksheet, which is what it was before its cells were run from the file.
BY_MARIMO = "import runpy, sys; del sys.argv[0]; runpy.run_path(sys.argv[0], run_name='sheet')['app'].run()"


def run(*arguments: str, sheet: Path = HITCH, flags: Sequence[str] | None = None) -> subprocess.CompletedProcess[str]:
    """By its command; with flags by a Python of its own."""
    if flags is None:
        return as_script(sheet, *arguments)
    return subprocess.run([sys.executable, *flags, str(sheet), *arguments], capture_output=True, encoding="utf-8")


def test_writes_the_workbook_and_reports(tmp_path):
    done = run(f"--out={tmp_path}", flags=())
    assert (done.returncode, done.stderr) == (0, "")
    lines = done.stdout.splitlines()
    assert [line.split(" = ")[1][:8] for line in lines[:3]] == ["0.66128 ", "0.46936 ", "0.75217 "]
    assert sum(line.startswith("pass  ") for line in lines) >= 15
    assert lines[-1] == f"written {tmp_path / 'hitch.xlsx'}"
    assert [p.name for p in tmp_path.iterdir()] == ["hitch.xlsx"]


def test_scene_and_arguments_replace_inputs_in_display_units(tmp_path):
    scene = tmp_path / "scene.toml"
    scene.write_text("[inputs]\nP6 = 30000\nphi_P6 = 85\n")
    out = tmp_path / "out"
    assert run(f"--scene={scene}", "--P6=20000,5", f"--out={out}").returncode == 0
    used = {row[0]: row[1] for row in load_workbook(out / "hitch.xlsx")["Inputs"].iter_rows(values_only=True)}
    assert (used["P6"], used["phi_P6"], used["L5"]) == (20000.5, 85, 0.48)


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
        ("--S_min=0.7", "error: least length of the cylinder S_min = 0.7 m must be < S_max = 0.67", 1),
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


def test_unwritable_folder_is_one_line(tmp_path):
    (tmp_path / "file").write_text("")
    done = run(f"--out={tmp_path / 'file'}")
    assert done.returncode == 1
    assert done.stderr.startswith("error: ") and done.stderr.count("\n") == 1


def changed(tmp_path: Path, old: str, new: str) -> Path:
    text = HITCH.read_text(encoding="utf-8")
    assert old in text
    (tmp_path / "worksheets").mkdir()
    sheet = tmp_path / "worksheets" / "hitch.py"
    sheet.write_text(text.replace(old, new), encoding="utf-8")
    return sheet


def test_stopped_cell_is_no_success(tmp_path):
    sheet = changed(tmp_path, "    Ra = (", "    mo.stop(True)\n    Ra = (")
    done = run(f"--out={tmp_path}", sheet=sheet)
    assert (done.returncode, done.stderr) == (1, "error: cell stability stopped before its end\n")
    by_marimo = run(f"--out={tmp_path}", sheet=sheet, flags=("-c", BY_MARIMO))
    missing = by_marimo.stderr.partition("SheetError: some cells did not run: ")[2]
    assert by_marimo.returncode == 1 and "table_61" in missing
    assert not (tmp_path / "hitch.xlsx").exists()


def test_failed_check_is_no_success_but_is_written(tmp_path):
    sheet = changed(tmp_path, "Isp = k_p * (", "Isp = 1.001 * k_p * (")
    done = run(f"--out={tmp_path}", sheet=sheet)
    assert done.returncode == 1
    assert "FAIL  instant centre: Isp = IS6" in done.stdout
    assert (tmp_path / "hitch.xlsx").exists()


def test_raising_cell_is_no_success(tmp_path):
    sheet = changed(tmp_path, "    Ra = (", "    1 / 0\n    Ra = (")
    done = run(f"--out={tmp_path}", sheet=sheet)
    assert done.returncode == 1
    assert "division by zero" in done.stderr
    assert not (tmp_path / "hitch.xlsx").exists()


def test_an_unknown_unit_fails_the_check_of_units_and_nothing_else(tmp_path):
    sheet = changed(tmp_path, "# [MPa] pressure", "# [MPaa] pressure")
    done = run(f"--out={tmp_path}", sheet=sheet)
    assert done.returncode == 1 and (tmp_path / "hitch.xlsx").exists()
    failed = [line for line in done.stdout.splitlines() if line.startswith("FAIL")]
    line = next(n for n, text in enumerate(sheet.read_text(encoding="utf-8").splitlines(), 1) if "[MPaa]" in text)
    assert len(failed) == 1 and failed[0].startswith(f"FAIL  units: 1 <= 0 mistakes; line {line}, ")
    assert "unit [MPaa] is not known; nearest: MPa" in failed[0]


def test_an_unknown_unit_of_an_input_fails_the_check_of_units_and_nothing_else(tmp_path):
    sheet = changed(tmp_path, "# [N] weight of the implement; >", "# [Nn] weight of the implement; >")
    done = run(f"--out={tmp_path}", sheet=sheet)
    assert done.returncode == 1 and (tmp_path / "hitch.xlsx").exists()
    failed = [line for line in done.stdout.splitlines() if line.startswith("FAIL")]
    line = next(n for n, text in enumerate(sheet.read_text(encoding="utf-8").splitlines(), 1) if "[Nn]" in text)
    assert len(failed) == 1 and failed[0].startswith(f"FAIL  units: 1 <= 0 mistakes; line {line}, P6: ")
    assert "unit [Nn] is not known; nearest: nN" in failed[0]


def test_script_leaves_out_what_it_does_not_show(tmp_path):
    done = run(f"--out={tmp_path}", flags=("-X", "importtime"))
    assert done.returncode == 0
    loaded = {line.rsplit("|", 1)[-1].strip() for line in done.stderr.splitlines()}
    assert "xlsxwriter" in loaded
    assert not {"altair", "pandas", "openpyxl", "matplotlib"} & loaded


def test_implement_beyond_the_machine_fails_but_is_written(tmp_path):
    done = run("--P6=1e12", f"--out={tmp_path}")
    assert done.returncode == 1
    assert done.stdout.count("FAIL  ") == 3 and "FAIL  front axle keeps its least load" in done.stdout
    assert (tmp_path / "hitch.xlsx").exists()


@pytest.fixture(scope="module")
def by_marimo(tmp_path_factory):
    """What marimo's own program of the file prints and writes."""
    out = tmp_path_factory.mktemp("marimo")
    return run(f"--out={out}", sheet=HITCH.with_name("joint.py"), flags=("-X", "importtime", "-c", BY_MARIMO)), out


@pytest.mark.parametrize("flags", [(), ("-m", "mechsheet.run.script")], ids=["itself", "command"])
def test_cells_are_run_from_the_file_to_the_same_report_and_workbook_as_by_marimo(tmp_path, flags, by_marimo):
    (by_marimo, other), own = by_marimo, tmp_path / "own"
    done = run(f"--out={own}", sheet=HITCH.with_name("joint.py"), flags=("-X", "importtime", *flags))
    assert (by_marimo.returncode, done.returncode) == (0, 0)
    assert ("| marimo\n" in done.stderr) == (not flags) and "xlsxwriter" in done.stderr
    running = "marimo._output.formatters.formatters"  # which marimo loads as it runs an app
    assert running in by_marimo.stderr and running not in done.stderr
    assert done.stdout == by_marimo.stdout.replace(str(other), str(own))
    assert (own / "joint.xlsx").read_bytes() == (other / "joint.xlsx").read_bytes()


def test_a_worksheet_that_imports_in_a_cell_is_run_once_by_marimo(tmp_path):
    """Its cells have begun by then."""
    sheet = tmp_path / "own.py"
    cell = (
        "@app.cell\ndef one():\n    print('begun')\n    from mechsheet import dot\n    print(dot(2, 3))\n    return\n"
    )
    sheet.write_text(f"import marimo\napp = marimo.App()\n\n{cell}\nif __name__ == '__main__':\n    app.run()\n")
    assert run(sheet=sheet, flags=()).stdout.splitlines() == ["begun", "6.0"]


def test_what_a_worksheet_does_with_what_marimo_runs_of_it_is_done(tmp_path):
    sheet = tmp_path / "own.py"
    end = "    app.run()\n"
    text = HITCH.with_name("guide.py").read_text(encoding="utf-8")
    assert text.endswith(end)
    sheet.write_text(
        text.removesuffix(end) + '    _, defs = app.run()\n    print(type(defs["g"]).__name__)\n', encoding="utf-8"
    )
    done = run(f"--out={tmp_path}", sheet=sheet, flags=())
    assert done.stdout.endswith("Press\n"), done.stdout + done.stderr
