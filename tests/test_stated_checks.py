"""Every check that a worksheet states is judged, kept under a name or not; one that looks at nothing is no pass."""

from pathlib import Path

import numpy as np
import pytest
from as_script import as_command, as_script
from own_worksheet import written
from written_cells import Values

from mechsheet import check, evaluate
from mechsheet.run import batch, rename
from mechsheet.worksheet.errors import SheetError

SETUP = "from mechsheet import ask, check, export, inputs, read"
GIVEN = "F: float = 1200.0  # [N] force; > 0"


def worksheet(folder: Path, lines: str, title: str = "Stated") -> Path:
    path = folder / "stated.py"
    path.write_text(written(SETUP, GIVEN, f"y = 2 * g.F  # [N] twice\n{lines}", title))
    return path


LOST = {
    "under a name that is used again": "ok = check('a', g.F, 1, 'N')\nok = check('b', g.F, 5000, 'N')",
    "under no name": "ok = check('b', g.F, 5000, 'N')\ncheck('a', g.F, 1, 'N')\nz = 1",
    "in a dict": "ok = {'x': check('a', g.F, 1, 'N')}",
    "in a function": "def stated(x):\n    check('a', x, 1, 'N')\n    return x\nz = stated(g.F)",
    "under a name that goes": "ok = check('a', g.F, 1, 'N')\nok = None",
}


@pytest.mark.parametrize("how", LOST)
@pytest.mark.parametrize("title", ["Stated", ""])
def test_what_no_name_keeps_is_judged(how: str, title: str, tmp_path: Path) -> None:
    """A run with a workbook passed though such a check fails, and its sheet Checks had none."""
    path = worksheet(tmp_path, LOST[how], title)
    run = as_script(path)
    assert run.returncode == 1 and "FAIL  a: 1200 <= 1 N" in run.stdout, run.stdout + run.stderr
    if title:
        rows = Values(tmp_path / "stated.xlsx")["Checks"].iter_rows(min_row=3, values_only=True)
        assert {row[0]: row[4] for row in rows}["a"] == "FAIL"


def test_a_scene_judges_it_too(tmp_path: Path) -> None:
    path, scene = worksheet(tmp_path, LOST["in a dict"]), tmp_path / "one.toml"
    scene.write_text("[inputs]\nF = 900")
    run = as_command(batch, path, scene)
    assert run.returncode == 1 and "FAIL  a: 900 <= 1 N" in run.stdout, run.stdout


def test_a_verdict_that_is_read_is_no_statement(tmp_path: Path) -> None:
    """A worksheet may ask a check for its own choice."""
    lines = "for k in (1, 2000):\n    if check('enough', g.F, k, 'N').passed:\n        z = k"
    assert as_script(worksheet(tmp_path, lines)).returncode == 0


def test_two_of_one_name_are_refused(tmp_path: Path) -> None:
    run = as_script(worksheet(tmp_path, "for k in (1, 2):\n    check('a', k * g.F, 5000, 'N')"))
    assert run.returncode and "two checks are called 'a'" in run.stderr


def test_a_limit_that_tells_nothing_is_no_pass() -> None:
    for told in (check("a", 3.0, np.inf), check("a", 3.0, 1e-9, of=np.inf), check("a", 0.0, 1e-9, of=[])):
        assert told.verdict == "not evaluated" and told.reason, told
    for residual, limit in ((True, 1), (np.array([False]), 0), (3.0, True)):
        with pytest.raises(SheetError, match="is a condition, which is no number"):
            check("a", residual, limit)


@pytest.mark.parametrize("end", ["exit()", "import sys; sys.exit(0)", "raise SystemExit"])
def test_a_worksheet_that_ends_itself_is_told(end: str, tmp_path: Path) -> None:
    run = as_script(worksheet(tmp_path, end))
    assert run.returncode == 1 and "the worksheet ends there, before its checks" in run.stderr, run.stderr
    assert not (tmp_path / "stated.xlsx").exists()


@pytest.mark.parametrize("mark", ["", "app.cell\n", "@app.cel\n"])
def test_a_cell_without_its_mark_is_told(mark: str, tmp_path: Path) -> None:
    """Its lines and checks were left out without a word."""
    path = worksheet(tmp_path, "ok = check('a', g.F, 1, 'N')")
    path.write_text(path.read_text().replace("@app.cell\ndef lines", f"{mark}def lines"))
    run = as_script(path)
    assert run.returncode and "lines belongs to no cell: write @app.cell in a line of its own above it" in run.stderr


def test_a_check_of_one_word_goes_by_its_name(tmp_path: Path) -> None:
    path = worksheet(tmp_path, "ok = check('stress', g.F, 1, 'N')")
    assert evaluate(path, ["stress"])["stress"].verdict == "FAIL"
    scene = tmp_path / "one.toml"
    scene.write_text("[limits]\nstress = { max = 5000 }")
    assert "pass  stress: 1200 <= 5000 N" in as_script(path, f"--scene={scene}").stdout
    run = as_script(path, "--want=stress")
    assert run.returncode == 1 and "FAIL  stress" in run.stdout
    assert "stres is defined by no cell" in as_script(path, "--want=stres").stderr


def test_a_symbol_is_not_renamed_to_one_of_its_cell_alone(tmp_path: Path) -> None:
    path = worksheet(tmp_path, "z = y")
    before = path.read_bytes()
    run = as_command(rename, path, "y", "_y")
    assert run.returncode and "_y begins with _" in run.stderr and path.read_bytes() == before
