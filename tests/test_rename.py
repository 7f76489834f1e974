"""A symbol of a worksheet under another name, in all of its files or in none."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest
from test_kinds import SHEET

from mechsheet import evaluate
from mechsheet.run import rename as command
from mechsheet.worksheet.errors import SheetError

SCENE = 'want = ["U"]\n[inputs]\nF = 7  # kN, F of the bolt\n[limits]\nU = {max = 2}\n'
OTHER = "[inputs]\nF = 1\nspan = 3\n"  # of another worksheet, which has an F too


@pytest.fixture
def bolt(tmp_path: Path) -> Path:
    path = tmp_path / "bolt.py"
    text = SHEET.replace("# [MPa] stress", "# [MPa] stress of F, of $\\\\varphi_{F}$ and F_max")
    path.write_text(text.replace('f"Use, {g.project}"', 'f"Use under {g.F:.0f} N, {g.project}"'), encoding="utf-8")
    (tmp_path / "scenes").mkdir()
    (tmp_path / "scenes" / "heavy.toml").write_text(SCENE, encoding="utf-8")
    (tmp_path / "other.toml").write_text(OTHER, encoding="utf-8")
    return path


def rename(path: Path, *names: str) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-X", "utf8", "-m", "mechsheet", "rename", str(path), *names]
    return subprocess.run(command, capture_output=True, encoding="utf-8", cwd=path.parent)


def in_process(monkeypatch: pytest.MonkeyPatch, path: Path, *names: str) -> None:
    monkeypatch.setattr(sys, "argv", ["rename", str(path), *names])
    monkeypatch.setattr(command, "watch", lambda _: None)
    command.main()


def test_an_input_is_renamed_in_lines_comments_texts_and_scenes(bolt: Path) -> None:
    use = evaluate(bolt, ["U"], F=7)["U"]
    done = rename(bolt, "F", "F_b")
    assert (done.returncode, done.stderr) == (0, "")
    assert [Path(line.removeprefix("written ")).name for line in done.stdout.splitlines()] == ["bolt.py", "heavy.toml"]
    assert evaluate(bolt, ["U"], F_b=7)["U"] == use
    text = bolt.read_text(encoding="utf-8")
    assert "F_b: float = 5 * kN  # [kN] force" in text and "tau = g.F_b / A  # [MPa] stress of F_b, of" in text
    assert "varphi_{F}$ and F_max" in text and 'f"Use under {g.F_b:.0f} N, {g.project}"' in text
    scene = SCENE.replace("F = 7  # kN, F of", "F_b = 7  # kN, F_b of")
    assert (bolt.parent / "scenes" / "heavy.toml").read_text(encoding="utf-8") == scene
    assert (bolt.parent / "other.toml").read_text(encoding="utf-8") == OTHER


def test_a_result_is_renamed_where_cells_take_and_give_it(bolt: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    expected = evaluate(bolt, ["R"])["R"]
    in_process(monkeypatch, bolt, "R", "ratio")
    text = bolt.read_text(encoding="utf-8")
    assert "return ratio, U, U_x, x" in text and "def results(ratio, U_x, g, x):" in text
    assert "ratio = g.grade.R_e / g.grade.R_m  # [-] ratio of the strengths" in text
    assert evaluate(bolt, ["ratio"])["ratio"] == expected
    assert 'want = ["U"]' in (bolt.parent / "scenes" / "heavy.toml").read_text(encoding="utf-8")
    in_process(monkeypatch, bolt, "U", "U_s")
    scene = (bolt.parent / "scenes" / "heavy.toml").read_text(encoding="utf-8")
    assert 'want = ["U_s"]' in scene and "U_s = {max = 2}" in scene


@pytest.mark.parametrize(
    ("names", "message"),
    [
        (("F", "tau"), "tau stands in line"),
        (("F", "sum"), "sum is a name of Python's own"),
        (("F", "F b"), "'F b' is no name"),
        (("F", "lambda"), "'lambda' is no name"),
        (("FF", "G"), "'FF' is no symbol of bolt.py; nearest: F"),
        (("linspace", "G"), "'linspace' is no symbol of bolt.py"),
        (("F",), "rename takes a worksheet, a symbol and its new name"),
    ],
)
def test_what_cannot_be_renamed_is_one_line_and_leaves_all_as_it_was(
    bolt: Path, names: tuple[str, ...], message: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    before = bolt.read_bytes()
    with pytest.raises(SheetError) as error:
        in_process(monkeypatch, bolt, *names)
    assert str(error.value).startswith(message) and "\n" not in str(error.value)
    assert bolt.read_bytes() == before


def test_where_a_scene_cannot_be_written_the_worksheet_stays(bolt: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    before = bolt.read_bytes()
    (bolt.parent / "scenes" / "heavy.toml").chmod(0o444)
    with pytest.raises(SheetError, match=r"heavy\.toml cannot be written: the file is read-only"):
        in_process(monkeypatch, bolt, "F", "F_b")
    assert bolt.read_bytes() == before
