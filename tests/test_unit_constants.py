"""Unit constants in a worksheet of one's own: its script, and its workbook in LibreOffice."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from as_script import as_script
from openpyxl import load_workbook

from mechsheet import evaluate

BOLT = '''\
import marimo

app = marimo.App()

with app.setup:
    from math import pi
    from mechsheet import Used, ask, check, export, inputs, read, table, typeset
    from mechsheet.units import MPa, N, celsius, inch, kN, m, s
    STRENGTH = 640 * MPa


@app.class_definition
@inputs
class Bolt:
    F: float = 27500.0  # [kN] load; > 0
    d: float = 0.01  # [mm] diameter; > 0
    W: float = 20.0  # [kg] mass

    """Inputs."""


@app.cell
def asked():
    form = ask(Bolt)
    return (form,)


@app.cell
def given(form):
    g = read(Bolt, form)
    return (g,)


@app.cell
def stress(g):
    A = pi * g.d**2 / 4  # [mm^2] area
    sigma = g.F / A  # [MPa] stress
    k = STRENGTH / sigma  # [-] reserve
    n = g.F / (2 * kN)  # [-] number
    D = g.d + 3 * inch  # [mm] head
    M = (g.F + 500 * N) * D / 2  # [N·m] moment
    G = g.W * 9.81 * m / s**2  # [N] weight
    T = celsius(20) + g.W * 0  # [K] temperature
    typeset()
    return A, D, G, M, T, k, n, sigma


@app.cell
def tables(D, G, M, k, n, sigma):
    table_1 = table("1", "Results", D, sigma, k, n, M, G)
    table_1
    return (table_1,)


@app.cell
def checks(sigma):
    strong = check("strength", sigma, 0.9 * STRENGTH, "MPa")
    strong
    return (strong,)


@app.cell
def end():
    export("Bolt", globals())
    return


if __name__ == "__main__":
    app.run()
'''


def script(folder: Path, *given: str, change: tuple[str, str] = ("", "")) -> Any:
    path = folder / "bolt.py"
    assert change[0] in BOLT
    path.write_text(BOLT.replace(*change), encoding="utf-8")
    return as_script(path, f"--out={folder}", *given)


@pytest.mark.office
def test_a_workbook_computes_with_constants(recalculated: Callable[[Path], Any], tmp_path: Path) -> None:
    assert script(tmp_path).returncode == 0
    book = load_workbook(tmp_path / "bolt.xlsx")
    texts = {cell.value for sheet in book for row in sheet.iter_rows() for cell in row if isinstance(cell.value, str)}
    assert "=F/(2*1000)" in texts, "no #N/A where nothing can fail, and a number for each unit"
    assert {"=IFERROR(640*1E6/sigma,NA())", "=d+3*0.0254", "=(F+500)*D_/2", "=W*9.81"} <= texts
    for row in book["Inputs"].iter_rows(min_row=3):
        row[1].value = {"F": 31.5, "d": 12, "W": 3}.get(row[0].value, row[1].value)
    book.save(tmp_path / "edited.xlsx")
    live = recalculated(tmp_path / "edited.xlsx")
    own = evaluate(tmp_path / "bolt.py", ["D", "sigma", "k", "n", "M", "G"], F=31.5, d=12, W=3)
    factors = {"D": 1e-3, "sigma": 1e6}
    shown = [cell.value for cell in list(live["1 Results"].iter_rows())[4]][: len(own)]
    assert shown == pytest.approx([x / factors.get(name, 1) for name, x in own.items()], rel=1e-14)


def test_a_script_tells_what_has_no_unit(tmp_path: Path) -> None:
    told = script(tmp_path, change=("9.81 * m / s**2", "9.81"))
    assert told.returncode == 1
    assert "FAIL  units: 1 <= 0 mistakes; line 42, G: unit [N] does not fit; the value is in kg; 9.81 has no unit" in (
        told.stdout
    )


@pytest.mark.parametrize("load", ["27.5 kN", "27500 N", "27,5kN", "27.5", "2804.21959 kgf"])
def test_a_unit_stands_behind_an_argument(tmp_path: Path, load: str) -> None:
    told = script(tmp_path, f"--F={load}")
    assert told.returncode == 0, told.stderr
    value = load_workbook(tmp_path / "bolt.xlsx")["Inputs"]["B3"].value
    assert value == pytest.approx(27.5, rel=1e-8)
