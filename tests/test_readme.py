"""What the README shows does what it says."""

import re
import tomllib
from pathlib import Path

ROOT = Path(__file__).parents[1]
README = (ROOT / "README.md").read_text(encoding="utf-8")


def blocks(language: str) -> list[str]:
    return re.findall(rf"```{language}\n(.*?)```", README, re.DOTALL)


def test_lines_quoted_from_the_template_stand_there():
    template = (ROOT / "lib" / "mechsheet" / "new_worksheet.txt").read_text(encoding="utf-8")
    quoted = next(b for b in blocks("python") if "table_1" in b)
    assert all(f"    {line}\n" in template for line in quoted.splitlines())


def test_lines_quoted_from_the_hitch_stand_there():
    hitch = (ROOT / "worksheets" / "hitch.py").read_text(encoding="utf-8")
    quoted = next(b for b in blocks("python") if "F_gc" in b)
    assert all(line in hitch for line in quoted.splitlines())


def test_six_bar_of_the_readme_balances():
    names: dict = {}
    exec(next(b for b in blocks("python") if "coupling_drive" in b), names)
    R_A, A, M = names["group23"].R_A, names["A"], names["M"]
    assert abs(R_A).max() > 100
    assert abs(names["R_O1"] - R_A).max() < 1e-9, "forces on the crank"
    assert abs(M - (A.conjugate() * R_A).imag).max() < 1e-9, "moments on the crank"


def test_scene_and_arguments_of_the_readme_are_inputs_of_the_hitch():
    from worksheets.hitch import Hitch

    given = set(tomllib.loads(blocks("toml")[0])["inputs"]) | set(re.findall(r"--(\w+)=[\d.e]+ ", README))
    assert given == {"P6", "phi_P6"} and given <= set(Hitch.__dataclass_fields__)


def test_every_worksheet_and_every_file_named_is_there():
    assert {m for m in re.findall(r"^\| `(\w+)` \|", README, re.MULTILINE)} == {
        p.stem for p in (ROOT / "worksheets").glob("*.py")
    }
    for name in re.findall(r"`([\w./]+/[\w.]+)`", README):
        assert (ROOT / name).exists() or name == "worksheets/lever.py", name
