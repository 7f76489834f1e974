"""Whole numbers with a unit: counted in that unit, computed with in SI, wherever they are given or shown."""

from __future__ import annotations

import json
from contextlib import chdir
from math import pi
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import written_cells
from as_script import as_script
from by_cells import by_cells
from cells import run

from mechsheet import Used, evaluate, load, sweep
from mechsheet.html import fields as html_fields
from mechsheet.page import fields as page_fields
from mechsheet.worksheet import inputs
from mechsheet.worksheet.errors import SheetError
from tests.own_worksheet import written

SHEET = written(
    """
from mechsheet import ask, export, inputs, read, typeset
""",
    """
n: int = 1450  # [rpm] speed; > 0 <= 3000
L: int = 25  # [mm] length
z: int = 17  # [-] teeth
t: int = 3  # [s] time
""",
    """
v = g.n * g.L * g.z  # [m/s] speed
typeset()
""",
    "Shaft",
)
RPM = 2 * pi / 60


@pytest.fixture(scope="module")
def shaft(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("sheet") / "shaft.py"
    path.write_text(SHEET, encoding="utf-8")
    return path


def speed(n: float = 1450, L: float = 25) -> float:
    return n * RPM * L / 1000 * 17


@pytest.mark.parametrize("given", [{}, {"n": 1500}, {"n": "3000", "L": 4}, {"L": "2,5 cm", "n": "25 rev/s"}])
def test_they_are_converted_and_counts_stay_whole(shaft: Path, given: dict[str, Any]) -> None:
    shown = {"n": 1450, "L": 25} | given | ({"L": 25, "n": 1500} if "2,5 cm" in given.values() else {})
    assert evaluate(shaft, ["v"], **given)["v"] == pytest.approx(speed(int(shown["n"]), shown["L"]), rel=1e-14)
    g: Any = inputs.build(load(shaft).inputs, given)
    assert [type(x) for x in (g.n, g.L, g.z, g.t)] == [float, float, int, int]
    rows = dict(inputs.Used(g).given())
    assert rows == {"n": int(shown["n"]), "L": shown["L"], "z": 17, "t": 3}
    assert inputs.build(load(shaft).inputs, rows) == g, "what is shown is read back as the same number"


def test_all_ways_to_give_them_agree(shaft: Path, tmp_path: Path) -> None:
    scene = tmp_path / "fast.toml"
    scene.write_text("[inputs]\nn = 1500\n", encoding="utf-8")
    with chdir(tmp_path):
        for given in ("--n=1500", f"--scene={scene}"):
            answer = as_script(shaft, given, "--want=v")
            assert answer.stdout.startswith(f"v = {speed(1500):.6g} m/s"), answer.stderr
    swept = sweep(shaft, ["v"], {"n": [1450, 1500, 1500.5]})
    np.testing.assert_allclose(swept["v"][:2], [speed(), speed(1500)], rtol=1e-14)
    assert swept.reasons[2] == "speed n = 1500.5 rpm must be a whole number"


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"n": 1500.5}, "speed n = 1500.5 rpm must be a whole number"),
        ({"L": "0.55 cm"}, "length L = 5.5 mm must be a whole number"),
        ({"n": 3001}, "speed n = 3001 rpm must be <= 3000 rpm"),
    ],
)
def test_they_are_whole_and_within_limits_in_their_unit(shaft: Path, given: dict[str, Any], message: str) -> None:
    with pytest.raises(SheetError) as error:
        inputs.build(load(shaft).inputs, given)
    assert str(error.value) == message


def test_fields_pages_and_workbook_show_the_unit_and_hold_si(shaft: Path, tmp_path: Path) -> None:
    g: Any = load(shaft).inputs()
    n, L, z, _ = html_fields.told(g)["fields"]
    assert (n["own"], n["shown"], n["text"]) == (pytest.approx(1450 * RPM), 1450, "1450")
    assert (L["own"], L["shown"], z["own"]) == (pytest.approx(0.025), 25, 17)
    assert page_fields.fields(g).value == {"n": "1450", "L": "25", "z": "17", "t": "3"}
    assert json.dumps([x for _, x in Used(g).rows()]) == "[1450, 25, 17, 3]"
    assert as_script(shaft, f"--out={tmp_path}").returncode == 0
    sheet = written_cells.read(tmp_path / "shaft.xlsx")["Inputs"]
    typed = {row for (row, column), (_, value) in sheet.items() if column == 1 and value == "n"}
    (row,) = typed
    (formula, in_si) = next(x for (r, c), x in sorted(sheet.items()) if r == row and x[0])
    assert in_si == pytest.approx(1450 * RPM) and f"*{RPM!r}" in formula


def test_one_that_is_declared_by_a_unit_is_in_si() -> None:
    start = "from mechsheet import inputs\nfrom mechsheet.units import rpm\n@inputs\nclass A:\n    "
    given: Any = run(f"{start}n: int = 1450 * rpm  # [rpm] speed")["A"]()
    assert given.n == run(f"{start}n: int = 1450  # [rpm] speed")["A"]().n == pytest.approx(1450 * RPM, rel=1e-15)
    with pytest.raises(SheetError, match=r"line 5: n = 1450\.5 rpm must be a whole number"):
        run(f"{start}n: int = 1450.5 * rpm  # [rpm] speed")


STAGE = """
import numpy as np
from mechsheet import ask, export, inputs, read, typeset
@inputs
class Stage:
    z: int  # [-] teeth
"""
STAGES = "stages: list[Stage] = [Stage(17), Stage(60)]  # stages"
OF_COLUMNS = {
    "g.stages.z**-2": lambda z: z**-2,
    "np.prod(g.stages.z) ** 8": lambda z: np.prod(z) ** 8,
    "np.full_like(g.stages.z, 0.5)": lambda z: np.full(len(z), 0.5),
}


@pytest.mark.parametrize("line", OF_COLUMNS)
@pytest.mark.parametrize("z", [(17, 60), (18, 61), (20, 40, 60)])
def test_a_column_has_the_same_kind_of_numbers_however_it_is_given(
    line: str, z: tuple[int, ...], tmp_path: Path
) -> None:
    """One that was typed was of numpy's integers, one of the worksheet was not: powers failed or overflowed."""
    path = tmp_path / "stages.py"
    path.write_text(written(STAGE, STAGES, f"y = {line}  # [-] result"))
    expected = OF_COLUMNS[line](np.array(z, float))
    given = {"stages": " | ".join(map(str, z))}
    np.testing.assert_allclose(by_cells(path, ["y"], **given)["y"], expected, rtol=1e-14)
    np.testing.assert_allclose(evaluate(path, ["y"], **given)["y"], expected, rtol=1e-14)
    np.testing.assert_allclose(sweep(path, ["y"], {"stages": [given["stages"]] * 2})["y"][1], expected, rtol=1e-14)
