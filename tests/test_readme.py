"""What the README shows does what it says."""

import re
from pathlib import Path

from mechsheet.run import batch

ROOT = Path(__file__).parents[1]
README = (ROOT / "README.md").read_text(encoding="utf-8")


def test_what_is_read_before_the_first_worksheet_opens_is_short():
    assert README.count("\n") <= 150


def blocks(language: str) -> list[str]:
    return re.findall(rf"```{language}\n(.*?)```", README, re.DOTALL)


def test_lines_quoted_from_the_hitch_stand_there():
    hitch = (ROOT / "worksheets" / "hitch.py").read_text(encoding="utf-8")
    quoted = next(b for b in blocks("python") if "F_gc" in b)
    assert all(line in hitch for line in quoted.splitlines())


def test_sweep_of_the_readme_has_an_axis_for_each_input(monkeypatch):
    monkeypatch.chdir(ROOT)
    names: dict = {}
    exec(next(b for b in blocks("python") if "grid(" in b), names)
    assert names["swept"]["GS6"].shape == (3, 3, 10) and len(names["swept"].frame()) == 90
    assert names["swept"].solved.any()


def test_arguments_of_the_readme_are_inputs_of_the_hitch():
    from worksheets.hitch import Hitch

    given = set(re.findall(r"--(\w+)=[\d.e]+ ", README))
    assert given == {"P6", "phi_P6"} and given <= set(Hitch.__dataclass_fields__)


def test_scene_of_the_readme_passes(tmp_path, capsys):
    scene = tmp_path / "scene.toml"
    scene.write_text(blocks("toml")[0], encoding="utf-8")
    assert batch.run(str(ROOT / "worksheets" / "hitch.py"), [str(scene)]) == 0
    assert "checks passed" in capsys.readouterr().out


def test_evaluation_of_the_readme_gives_the_capacity(monkeypatch):
    monkeypatch.chdir(ROOT)
    names: dict = {}
    exec(next(b for b in blocks("python") if "evaluate(" in b), names)
    assert names["GS6"].shape == (10,) and names["GS6"].min() > 28e3


def test_every_worksheet_and_every_file_named_is_there():
    assert {m for m in re.findall(r"^\| `(\w+)` \|", README, re.MULTILINE)} == {
        p.stem for p in (ROOT / "worksheets").glob("*.py")
    }
    for name in re.findall(r"`([\w./]+/[\w.]+)`", README):
        assert (ROOT / name).exists() or name == "worksheets/lever.py", name
