"""Many scenes of a worksheet: the example scenes hold, a bad one stays alone, files are whole or not there."""

import os
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from as_script import as_script
from by_cells import by_cells
from openpyxl import load_workbook
from test_exports import differences
from test_exports import read as workbook

from mechsheet.recording.dimensions import dimensions
from mechsheet.run import arguments, batch, units_once
from mechsheet.workbook import save, writing
from mechsheet.worksheet.cells import load
from mechsheet.worksheet.errors import SheetError
from tests.own_worksheet import own

ROOT = Path(__file__).resolve().parents[1]
HITCH = ROOT / "worksheets" / "hitch.py"
EXAMPLES = ROOT / "worksheets" / "scenes"


def scene(folder: Path, name: str, text: str) -> str:
    file = folder / f"{name}.toml"
    file.write_text(text, encoding="utf-8")
    return str(file)


def row(printed: str, head: str) -> list[str]:
    """Cells of a row of the printed summary."""
    return next(line for line in printed.splitlines() if line.startswith(head)).removeprefix(head).split()


def test_the_example_scenes_pass_side_by_side(tmp_path, monkeypatch, capsys):
    monkeypatch.setenv("COLUMNS", "200")
    assert batch.run(str(HITCH), [str(EXAMPLES / "*.toml"), f"--out={tmp_path}"]) == 0
    printed = capsys.readouterr()
    assert row(printed.out, "verdict") == 5 * ["pass"]
    assert row(printed.out, "P6 [N]") == ["27500", "34000", "9000", "16000", "33000"]
    assert printed.out.endswith(f"5 of 5 scenes pass, written to {tmp_path}\n")
    assert printed.err == "", "no bar where stderr is no terminal"
    whole = {"hitch_designed.xlsx", "hitch_heavy.xlsx", "hitch_other_tractor.xlsx"}
    assert {path.name for path in tmp_path.iterdir()} == {"hitch_scenes.xlsx", *whole}


def test_the_example_scenes_are_what_they_say(capsys):
    assert batch.run(str(HITCH), [str(EXAMPLES / "heavy.toml"), "--D_gc=0.08"]) == 1, "it takes the larger cylinders"
    assert batch.run(str(HITCH), [str(EXAMPLES / "heavy.toml"), "--P_gr=8000"]) == 1, "and the counterweights"
    assert "heavy: FAIL  front axle keeps its least load" in capsys.readouterr().out
    sheet = load(HITCH)
    road, _ = batch.compute(sheet, "", arguments.load(EXAMPLES / "transport.toml", ()))
    raised = {q.name: q.values for q in road.quantities}
    document = by_cells(HITCH, ["L4", "L7", "P56", "PS6", "phi6"])
    assert raised["L4"] == pytest.approx(document["L4"], abs=1e-5)
    assert raised["L7"] == pytest.approx(document["L7"], abs=1e-5)
    S = np.array([0.66, 0.665, 0.67])
    assert raised["P56_S.imag"] == pytest.approx(document["P56"](S, document["L4"]).imag, abs=2e-5)
    assert raised["PS6_S.imag"] == pytest.approx(document["PS6"](S).imag, abs=1e-4)


def test_one_bad_scene_does_not_stop_the_others(tmp_path, monkeypatch, capsys):
    monkeypatch.setenv("COLUMNS", "200")
    files = [
        scene(tmp_path, "typing", "[inputs\n"),
        scene(tmp_path, "good", 'want = ["GS6"]\n[limits]\nGS6 = {min = 25e3}\n'),
        scene(tmp_path, "unknown", "[inputs]\nP66 = 1\n"),
        scene(tmp_path, "open", "[inputs]\nS_max = 0.9\n"),
        scene(tmp_path, "gaps", 'want = ["GS6"]\n[inputs]\nS_max = 0.9\n'),
        scene(tmp_path, "weak", 'want = ["GS6"]\n[limits]\nGS6 = {min = 30e3, max = 32e3}\n'),
        str(tmp_path / "missing.toml"),
    ]
    out = tmp_path / "out"
    assert batch.run(str(HITCH), [*files, f"--out={out}"]) == 2
    lines = capsys.readouterr().out.splitlines()
    assert row("\n".join(lines), "verdict") == ["error", "pass", "error", "error", "FAIL", "FAIL", "error"]
    reasons = [line for line in lines if ": " in line]
    starts = [
        f"typing: scene {files[0]} is no valid TOML",
        "unknown: input P66 is unknown; nearest: P6",
        "open: group (2, 3) closes: no position closes for cylinder S = 0.7",
        "gaps: FAIL  GS6 does not exist at ",
        "weak: FAIL  GS6 >= 30000 N: 29959 >= 30000 N, 100.1 %; it is 29958.8..",
        "weak: FAIL  GS6 <= 32000 N: 33441 <= 32000 N, 105 %; it is 29958.8..",
        f"missing: scene {files[-1]} cannot be read",
    ]
    assert len(reasons) == len(starts)
    assert all(reason.startswith(start) for reason, start in zip(reasons, starts, strict=True)), reasons
    assert lines[-1] == f"1 of 7 scenes pass, written to {out}"
    assert [path.name for path in out.iterdir()] == ["hitch_scenes.xlsx"]


@pytest.mark.parametrize("jobs", ["1", "2"])
def test_inputs_of_a_scene_that_fails_are_shown_as_they_are_given(jobs, tmp_path, capsys, monkeypatch):
    """Where the worksheet refuses them, where a line fails, where nobody can read them; others keep the worksheet's."""
    monkeypatch.setenv("COLUMNS", "200")
    sheet = own(tmp_path, 'y = next(size for size in (1, 2, 3) if g.F <= size)  # [-] size\nc = check("c", y, 3)')
    path = Path(sheet.path)
    path.write_text(path.read_text().replace("import export", "import check, export"), encoding="utf-8")
    texts = {"good": "F = 2.75", "none": "F = 3.5", "low": "n = -4", "word": 'F = "much"', "unknown": "G = 1\nF = 2"}
    files = [scene(tmp_path, name, f"[inputs]\n{text}\n") for name, text in texts.items()]
    files.append(scene(tmp_path, "typing", "[inputs\n"))
    out = tmp_path / "out"
    assert batch.run(str(path), [*files, "--a=1.5", f"--jobs={jobs}", f"--out={out}"]) == 2
    printed = capsys.readouterr().out
    assert row(printed, "verdict") == ["pass", *5 * ["error"]]
    assert row(printed, "F [-]") == ["2.75", "3.5", "2.5", "much", "2"]
    assert row(printed, "n [-]") == ["5", "5", "-4", "5", "5"]
    assert row(printed, "a [-]") == 5 * ["1.5"]
    (line,) = (
        r for r in load_workbook(out / "own_scenes.xlsx").worksheets[0].iter_rows(values_only=True) if r[0] == "F"
    )
    assert line[3:] == (2.75, 3.5, 2.5, "much", 2, None)


def test_an_exception_of_one_scene_is_its_one_line(tmp_path, capsys):
    sheet = tmp_path / "sheet.py"
    sheet.write_text(
        "import marimo\napp = marimo.App()\n\nwith app.setup:\n    from mechsheet import typeset\n"
        "    from mechsheet import inputs\n\n\n@app.class_definition\n@inputs\nclass A:\n"
        '    x: float = 2.0  # [m] length\n\n    """Text."""\n\n\n'
        "@app.cell\ndef one(g):\n    y = int(1 // g.x)  # [1/m] curvature\n    typeset()\n    return (y,)\n"
    )
    files = [scene(tmp_path, name, f'want = ["y"]\n[inputs]\nx = {x}\n') for name, x in (("a", 0), ("b", 0.5))]
    assert batch.run(str(sheet), files) == 1
    printed = capsys.readouterr().out
    assert row(printed, "verdict") == ["error", "pass"] and row(printed, "y [1/m]") == ["2"]
    assert re.search(
        r"a: sheet.py, line 19, y = int\(1 // g.x\): (float floor )?division by zero", printed
    )  # by the version of Python


def test_a_result_that_rests_on_no_solution_says_which_equation_resists(tmp_path, capsys):
    sheet = tmp_path / "sheet.py"
    sheet.write_text(
        "import marimo\napp = marimo.App()\n\nwith app.setup:\n    from mechsheet import find, inputs, typeset\n"
        "    from numpy import array\n\n\n@app.class_definition\n@inputs\nclass A:\n"
        '    x: float = 2.0  # [-] number\n\n    """Text."""\n\n\n'
        "@app.cell\ndef one(g):\n    x = array([g.x, 4])\n"
        "    found = find(lambda u, v: (u**2, u + v), equals=(x, 0), u=1.0, v=1.0)\n"
        "    u = found.value.u  # [-] root\n    typeset()\n    return (u,)\n"
    )
    files = [scene(tmp_path, name, f'want = ["u"]\n[inputs]\nx = {x}\n') for name, x in (("a", -3), ("b", 1))]
    assert batch.run(str(sheet), files) == 1
    printed = capsys.readouterr().out
    assert row(printed, "verdict") == ["FAIL", "pass"] and "a: FAIL  u does not exist at 1 of 2 positions" in printed
    assert "problem 1: no solution for u, v from the guess: equation 1 leaves 3 at the nearest" in printed


def test_workbook_of_a_scene_is_that_of_the_script(tmp_path):
    file = scene(tmp_path, "own", "[inputs]\nP6 = 20e3\n")
    assert batch.run(str(HITCH), [file, f"--out={tmp_path}"]) == 0
    assert as_script(HITCH, f"--scene={file}", f"--out={tmp_path}").returncode == 0
    different = list(differences(workbook(tmp_path / "hitch.xlsx"), workbook(tmp_path / "hitch_own.xlsx")))
    assert {text.partition(",")[0] for text in different} == {"Front", "Inputs"}
    for text in different:
        script_s, scene_s = re.findall(r"value='(.*?)'", text)
        assert scene_s == script_s.replace("Tractor hitch", "Tractor hitch: own") != script_s


BRIEF = {
    "accuracy": batch.Scene(want=("check_12",)),
    "hitch_design": batch.Scene(inputs={"generations": 1, "n_t": 2, "n_mc": 2}),
}


@pytest.mark.parametrize("sheet", sorted((ROOT / "worksheets").rglob("*.py")), ids=lambda path: path.stem)
def test_every_worksheet_takes_scenes(sheet):
    outcome, _ = batch.compute(load(sheet), "own", BRIEF.get(sheet.stem, batch.Scene()))
    assert outcome.verdict == "pass" and outcome.checks


def test_a_limit_of_no_check_is_named(tmp_path):
    file = scene(tmp_path, "own", '[limits]\n"no such check" = {max = 0}\n')
    with pytest.raises(SheetError, match="no check is named 'no such check'"):
        batch.compute(load(HITCH), "own", arguments.load(Path(file), ()))


def test_summary_workbook(tmp_path):
    want = 'want = ["GS6", "L4", "table_41"]\n'
    files = [
        scene(tmp_path, "a", want + "[inputs]\nP6 = 20e3\nN_pol = 3\n"),
        scene(tmp_path, "b", want + "[limits]\nGS6 = {min = 30e3}\n"),
        scene(tmp_path, "c", "[inputs]\nP6 = -1\n"),
    ]
    assert batch.run(str(HITCH), [*files, f"--out={tmp_path}"]) == 1
    book = load_workbook(tmp_path / "hitch_scenes.xlsx")
    assert book.sheetnames == ["Scenes", "GS6", "a 4.1 Lifting capacity", "b 4.1 Lifting capacity"]
    cells = {line[0]: line[1:] for line in book["Scenes"].iter_rows(min_row=2, values_only=True)}
    assert cells["Symbol"] == ("Unit", "Meaning", "a", "b", "c")
    assert cells["P6"] == ("N", "weight of the implement", 20000, 27500, -1)
    assert cells["N_pol"][2:] == (3, 10, 10) and "L5" not in cells
    GS6 = by_cells(HITCH, ["GS6"], P6=20e3, N_pol=3)["GS6"], by_cells(HITCH, ["GS6"])["GS6"]
    assert cells["GS6 least"] == ("N", "capacity at the centre of mass", *(x.min() for x in GS6), None)
    assert cells["GS6 greatest"][2:4] == tuple(x.max() for x in GS6)
    assert cells["L4"][2] == cells["L4"][3] == by_cells(HITCH, ["L4"])["L4"]
    assert cells["GS6 >= 30000 N"][2:] == (None, "FAIL", None)
    assert cells["verdict"][2:] == ("PASS", "FAIL", "FAIL")
    assert cells["reason"][4] == "weight of the implement P6 = -1.0 N must be >= 0 N"
    values = [line[1:] for line in book["GS6"].iter_rows(min_row=5, values_only=True)]
    assert [line[0] for line in values[:3]] == list(GS6[0]) and values[3][0] == "=#N/A"
    assert [line[1] for line in values] == list(GS6[1])


def test_long_texts_of_a_summary_have_room(tmp_path):
    """Reasons and tables ran over the cells beside them, and were cut."""
    rows = [
        ("Verdict",),
        ("reason", "", "", "", "no position closes for cylinder S: " * 4),
        ("F", "N", "force", 1.5, -2.5e-7),
    ]
    (tmp_path / "summary.xlsx").write_bytes(writing.comparison("Scenes", ["a", "b"], rows, []))
    sheet = load_workbook(tmp_path / "summary.xlsx")["Scenes"]
    assert sheet["E4"].alignment.wrap_text and sheet["E4"].value.startswith("no position")
    width, height, usual = (
        sheet.column_dimensions["E"].width,
        sheet.row_dimensions[4].height,
        sheet.row_dimensions[5].height,
    )
    assert len(sheet["E4"].value) < width * (height / usual) * 1.3 and sheet.column_dimensions["D"].width < width


def test_limits_of_checks_stand_for_their_own(tmp_path, capsys):
    name = "instant centre: Imp = I56"
    files = [
        scene(tmp_path, "strict", f'want = ["{name}"]\n[limits]\n"{name}" = {{max = 1e-30}}\n'),
        scene(tmp_path, "least", f'want = ["{name}"]\n[limits]\n"{name}" = {{min = 1}}\n'),
        scene(tmp_path, "point", 'want = ["L4"]\n[limits]\nP56_S = {min = 1}\n'),
        scene(tmp_path, "function", 'want = ["P56"]\n'),
        scene(tmp_path, "drawing", 'want = ["figure_41"]\n'),
    ]
    assert batch.run(str(HITCH), files) == 2
    strict, *others = [line for line in capsys.readouterr().out.splitlines() if ": " in line]
    assert re.fullmatch(r"strict: FAIL  instant centre: Imp = I56: \d\.\d+e-1\d <= 1e-30", strict)  # rounding
    assert others == [
        f"least: limit of the check '{name}' must be {{max = NUMBER}}",
        "point: limit of P56_S: it is complex; limit P56_S.real, P56_S.imag or abs(P56_S)",
        "function: P56 is a function of S, L4; numbers with a unit, checks and tables can be asked for",
        "drawing: figure_41 is declared by no line with its unit; numbers with a unit, checks and tables can be asked"
        " for",
    ]


@pytest.mark.parametrize("files", [("a", "b"), ("a",)], ids=["first", "summary"])
def test_ctrl_c_leaves_whole_files_only(files, tmp_path, monkeypatch, capsys):
    """The signal comes when the last file has been written beside its place and is about to be moved there."""
    given = [scene(tmp_path, name, "[inputs]\nP6 = 20e3\n") for name in files]
    out, moved, move = tmp_path / "out", [], os.replace

    def replace(source, target):
        if len(moved) == 1:
            raise KeyboardInterrupt
        move(source, target)
        moved.append(Path(target))

    monkeypatch.setattr(save.os, "replace", replace)
    assert batch.run(str(HITCH), [*given, f"--out={out}"]) == 130
    assert list(out.iterdir()) == moved == [out / "hitch_a.xlsx"]
    load_workbook(moved[0])
    printed = capsys.readouterr()
    assert printed.err == f"\ninterrupted after 1 of {len(files)} scenes\n" and printed.out == ""


def test_bar_on_a_terminal(tmp_path, monkeypatch, capsys):
    files = [scene(tmp_path, name, 'want = ["L4"]\n') for name in ("a", "b")]
    monkeypatch.setattr(sys.stderr, "isatty", lambda: True, raising=False)
    assert batch.run(str(HITCH), files) == 0
    first, second, last, after = capsys.readouterr().err.split("\r")[1:]
    assert first.strip() == f"[{20 * '.'}] 0 of 2  a"
    assert re.fullmatch(r"\[#{10}\.{10}\] 1 of 2  b  \d+ (s|min) left", second.strip())
    assert last == " " * len(second) and after == "", "nothing of it stays"


def test_several_processes_tell_and_write_what_one_does(tmp_path, capsys):
    """A scene that fails among them, one with a mistake, and inputs that differ from the worksheet's."""
    files = [
        scene(tmp_path, "strong", 'want = ["L4", "GS6"]\n[inputs]\nP6 = 30e3'),
        scene(tmp_path, "wrong", 'want = ["L4"]\n[inputs]\nP6 = "much"'),
        scene(tmp_path, "limited", 'want = ["L4"]\n[limits]\nL4 = {max = 0.1}'),
    ]
    said, books = [], []
    for jobs in ("1", "2"):
        out = tmp_path / jobs
        assert batch.run(str(HITCH), [*files, f"--jobs={jobs}", f"--out={out}"]) == 2
        said.append(capsys.readouterr().out.replace(str(out), "FOLDER"))
        books.append(workbook(out / "hitch_scenes.xlsx"))
    assert said[0] == said[1] and "wrong: " in said[0] and "0.1 m" in said[0]
    assert books[0] == books[1]


@pytest.mark.parametrize("jobs", ["0", "-1", "two", "1.5", ""])
def test_jobs_are_a_number_of_processes(jobs):
    with pytest.raises(SheetError, match=f"jobs = {jobs} must be a number of processes, at least 1"):
        batch.run(str(HITCH), [str(EXAMPLES / "heavy.toml"), f"--jobs={jobs}"])


def test_jobs_without_a_scene_are_no_input():
    with pytest.raises(SheetError, match=r"^argument '--jobs=2': processes compute scenes side by side, and none"):
        arguments.read(["--jobs=2"], ())


def test_files_that_would_overwrite_one_another_are_refused(tmp_path):
    (tmp_path / "other").mkdir()
    a, b = scene(tmp_path, "a", 'want = ["L4"]\n'), scene(tmp_path / "other", "a", 'want = ["L4"]\n')
    with pytest.raises(SheetError, match=re.escape(f"scene {b} has the name of {a}")):
        batch.run(str(HITCH), [a, b])
    with pytest.raises(SheetError, match="has the name of the summary"):
        batch.run(str(HITCH), [scene(tmp_path, "scenes", 'want = ["L4"]\n')])
    book = tmp_path / "hitch_a.xlsx"
    book.write_bytes(b"edited by hand")
    with pytest.raises(SheetError, match="would be overwritten; give another folder"):
        batch.run(str(HITCH), [a, str(book), f"--out={tmp_path}"])
    assert book.read_bytes() == b"edited by hand"


def test_more_scenes_than_a_sheet_has_columns_are_refused_at_once(tmp_path):
    """They were computed, and those behind the last column were not in the workbook that was said to be written."""
    many = [f"s{k}.toml" for k in range(16382)]
    with pytest.raises(SheetError, match="16382 scenes have no room side by side in a workbook: at most 16381"):
        batch.run(str(HITCH), [*many, f"--out={tmp_path}"])


def test_an_edited_workbook_is_a_scene_like_another(tmp_path, capsys):
    assert as_script(HITCH, f"--out={tmp_path}").returncode == 0
    book = load_workbook(tmp_path / "hitch.xlsx")
    cell = next(line[1] for line in book["Inputs"].iter_rows() if line[0].value == "P6")
    cell.value = "20000,5"
    edited = tmp_path / "mine.xlsx"
    book.save(edited)
    assert batch.run(str(HITCH), [str(edited), str(tmp_path / "hitch.xlsx"), f"--out={tmp_path / 'out'}"]) == 0
    assert row(capsys.readouterr().out, "P6 [N]") == ["20000.5", "27500"]
    done = as_script(HITCH, f"--scene={edited}", f"--out={tmp_path}")
    assert (done.returncode, done.stderr) == (0, "")
    used = {line[0]: line[1] for line in load_workbook(tmp_path / "hitch.xlsx")["Inputs"].iter_rows(values_only=True)}
    assert used["P6"] == 20000.5


def test_script_of_a_scene_that_wants_some_results_answers_those(tmp_path):
    file = scene(tmp_path, "a", 'want = ["GS6", "table_41"]\n[limits]\nGS6 = {min = 29e3}\nPS6_S.imag = {}\n')
    assert as_script(HITCH, f"--scene={file}").stderr.startswith("error: scene ")
    scene(tmp_path, "a", 'want = ["GS6", "table_41"]\n[limits]\nGS6 = {min = 29e3}\n')
    exported = (ROOT / "exports" / "hitch.xlsx").stat().st_mtime_ns
    done = as_script(HITCH, f"--scene={file}")
    assert (done.returncode, done.stderr) == (0, "")
    lines = done.stdout.splitlines()
    assert lines[:2] == ["GS6 = 29958.8..33441.2 N, capacity at the centre of mass", "Table 4.1 - Lifting capacity"]
    assert lines[2].split() == ["S", "Fgc", "Pgc", "G56", "GS6", "dGS65"] and lines[4].split()[0] == "0.420"
    assert lines[-1].startswith("pass  GS6 >= 29000 N: ") and len(lines) == 4 + 10 + 3 + 1
    assert (ROOT / "exports" / "hitch.xlsx").stat().st_mtime_ns == exported, "nothing is written without --out"
    done = as_script(HITCH, f"--scene={file}", "--X6=1.2", f"--out={tmp_path / 'out'}")
    assert done.returncode == 1 and "FAIL  GS6 >= 29000 N: " in done.stdout and done.stderr == ""
    assert [path.name for path in (tmp_path / "out").iterdir()] == ["hitch_scenes.xlsx"]


def test_script_of_the_whole_worksheet_keeps_the_limits_of_its_scene(tmp_path):
    file = scene(tmp_path, "a", '[limits]\ndRa = {min = 30}\n"loop of group (2, 3)" = {max = 1e-30}\n')
    done = as_script(HITCH, f"--scene={file}", f"--out={tmp_path}")
    assert done.returncode == 1 and done.stderr == ""
    failed = [line for line in done.stdout.splitlines() if line.startswith("FAIL")]
    assert [line.split(":")[0] for line in failed] == ["FAIL  loop of group (2, 3)", "FAIL  dRa >= 30 %"]
    listed = [line[0].value for line in load_workbook(tmp_path / "hitch.xlsx")["Checks"].iter_rows()]
    assert "dRa >= 30 %" in listed


def test_a_wide_summary_is_broken_at_the_width_of_the_terminal(tmp_path, monkeypatch, capsys):
    files = [scene(tmp_path, name, 'want = ["GS6"]\n') for name in ("one", "two", "three")]
    monkeypatch.setenv("COLUMNS", "60")
    assert batch.run(str(HITCH), files) == 0
    lines = capsys.readouterr().out.splitlines()
    assert max(map(len, lines)) <= 60
    assert lines[0].split() == ["one", "two"]
    assert sum(line.startswith("verdict") for line in lines) == 2


def test_command_line_in_a_process_of_its_own(tmp_path):
    """From the launcher on, with a pattern that no shell has expanded."""
    scene(tmp_path, "a", 'want = ["L4"]\n')
    scene(tmp_path, "b", 'want = ["L4"]\n')
    command = [sys.executable, "-m", "mechsheet", "run", "hitch", str(tmp_path / "*.toml")]
    done = subprocess.run(command, capture_output=True, encoding="utf-8")
    assert (done.returncode, done.stderr) == (0, "")
    assert row(done.stdout, "verdict") == ["pass", "pass"]
    done = subprocess.run([*command, "--P66=1"], capture_output=True, encoding="utf-8")
    assert (done.returncode, done.stdout, done.stderr) == (2, "", "error: input P66 is unknown; nearest: P6, Y_P56\n")
    done = subprocess.run([*command, f"--out={tmp_path / 'a.toml'}"], capture_output=True, encoding="utf-8")
    assert done.returncode == 1 and done.stderr.startswith("error: folder ") and done.stderr.count("\n") == 1


def test_a_wanted_table_is_printed_with_its_texts_and_powers(tmp_path, capsys):
    """A text has no decimals, and an error of 2e-15 is no 0.0."""
    lines = """from mechsheet import Column, Table
name = Column("way", "", "", 0, ["a", "b"])
table_2 = Table("2", "Two", (name, Column("error", "-", "", 1, np.array([2e-15, g.F]), power=True)))"""
    sheet = own(tmp_path, lines)
    assert batch.answer(str(sheet.path), arguments.load(Path(scene(tmp_path, "one", 'want = ["table_2"]\n')), ())) == 0
    printed = capsys.readouterr().out
    assert re.search(r"way +error\n +\[-\]\na +2\.0e-15\nb +2\.5e\+00", printed), printed


def test_what_a_scene_among_others_wants_is_told_of_each(tmp_path, capsys):
    """A wanted table, and how far numbers are proved: what the same scene alone prints."""
    sheet = own(tmp_path, "")
    lines = 'want = ["table_1"]\nproof = 9\n[inputs]\nF = '
    batch.run(sheet.path, [scene(tmp_path, name, f"{lines}{F}") for name, F in (("a", 2), ("b", 3))])
    out = capsys.readouterr().out
    for name, first in (("a", "0.200"), ("b", "0.300")):
        assert f"{name}: Table 1 - All\n" in out and re.search(rf"^{name}: {first}$", out, re.MULTILINE)
        assert re.search(rf"^{name}: table 1 +5 +1\d\.\d +x$", out, re.MULTILINE)


def test_a_scene_is_judged_by_the_units_of_its_lines_as_a_run_is(tmp_path, capsys):
    sheet = own(tmp_path, "L = 2 * g.F  # [m] length of a number")
    assert batch.run(sheet.path, [scene(tmp_path, "one", "[inputs]\nF = 2")]) == 1
    assert "one: FAIL  units: 1 <= 0 mistakes" in capsys.readouterr().out


def test_the_units_of_scenes_are_judged_once_while_their_lines_go_the_same_way(tmp_path, capsys, monkeypatch):
    """To record each would take five times as long as to compute it."""
    recorded = []
    monkeypatch.setattr(units_once, "dimensions", lambda *a: recorded.append(a) or dimensions(*a))
    way = "arm = 2.0  # [m] arm\nall_of = [g.F * 2.0] if g.F <= 3 else [g.F + arm, 1.0]\ny = all_of[0] * 1.0"
    sheet = own(tmp_path, way)
    scenes = [scene(tmp_path, f"with_{F}", f"[inputs]\nF = {F}") for F in (1, 2, 2.5, 4, 5, 1.5)]
    batch.run(sheet.path, scenes)
    out = capsys.readouterr().out
    assert (out.count(": FAIL  units"), len(recorded)) == (6, 2)
