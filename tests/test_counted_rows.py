"""What is counted in a table of inputs, as teeth: a row has a whole number, in Python, a recording and a sweep."""

from __future__ import annotations

import re
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from in_browser import evaluated
from own_worksheet import value_of, written
from test_html_lists import leaves
from test_html_page import opened, read

from mechsheet import sweep
from mechsheet.html import javascript, write
from mechsheet.quantities.quantity import Quantity
from mechsheet.recording.record import record
from mechsheet.worksheet import cells, inputs
from mechsheet.worksheet.errors import SheetError

if TYPE_CHECKING:
    from playwright.sync_api import Page

SETUP = """
import marimo as mo
import math

import numpy as np

from mechsheet import ask, check, inputs, read, summary, table, typeset

RATIOS = [0.1, 0.2, 0.3, 0.4, 0.5]

@inputs
class Stage:
    z: int  # [-] teeth; > 5
    k: int  # [-] number of the ratio; >= 0 <= 4
    m: float  # [mm] module; > 0
"""
GIVEN = """
z_0: int = 17  # [-] teeth of the first; > 5
x: float = 2.0  # [-] number
stages: list[Stage] = [Stage(20, 1, 0.002), Stage(40, 2, 0.003)]  # stages
"""
LINES = [
    "sum(sum(range(s.k + 1)) for s in g.stages)",
    "sum(RATIOS[s.k] for s in g.stages)",
    "sum(1 / s.z**2 for s in g.stages) + g.stages[0].z ** -1",
    "sum(s.z // 3 + s.z % 7 for s in g.stages)",
    "g.stages[0].z / g.stages[-1].z",
    "sum(s.z**12 for s in g.stages)",
    "len([k for s in g.stages for k in range(s.z)])",
    "np.zeros(g.stages[1].k + 1).size",
    "sum(s.z * s.m for s in g.stages)",
    "math.gcd(g.stages[0].z, g.stages[1].z) + math.factorial(g.stages[0].k)",
    "np.prod([s.z for s in g.stages] * 8)",
]
ARRAYS = [
    "z = g.stages.z.copy()",
    "z = np.array([s.z for s in g.stages])",
    "z = [s.z for s in g.stages]",
    "z = np.array([s.z * s.k for s in g.stages])",
    "z = np.zeros_like(g.stages.z)",
    "z = np.full(3, g.stages[0].z)",
    "z = np.append(g.stages.z, 3)",
    "z = np.full_like(g.stages.z, g.x)",
]
GIVES: list[dict[str, Any]] = [
    {},
    {"stages": [(25, 4, 2), (31, 1, 3)]},
    {"stages": [(6, 0, 0.5), (200, 3, 8)], "z_0": 19},
]


def own(tmp_path: Path, lines: str, more: str = "") -> cells.Worksheet:
    path = tmp_path / "own.py"
    text = written(SETUP, GIVEN, lines + '\ntable_1 = table("1", "All", g.stages.z)\ntypeset()')
    path.write_text(text + more, encoding="utf-8")
    return cells.load(path)


def test_a_row_counts_as_the_input_of_one_number_does(tmp_path: Path) -> None:
    sheet = own(tmp_path, "y = 1.0  # [-] line")
    g = sheet.inputs()
    assert f"{g.stages[1].z} of {2 * g.stages[0].z + 1:>5}, {g.stages[1].z:.1f}" == "40 of    41, 40.0"
    assert np.array([s.z for s in g.stages]).dtype == g.stages.z.dtype == float, "which is neither cut nor overflows"


def test_a_column_of_what_is_counted_has_no_decimals(tmp_path: Path) -> None:
    """As that of a whole number has none: it was listed as 20.000."""
    sheet = own(tmp_path, 'y = 1.0  # [-] line\ntable_2 = table("2", "Two", g.stages.z, g.stages.m, g.z_0)')
    columns = sheet.run(["table_2"], {"g": sheet.inputs()})["table_2"].columns
    assert [(column.decimals, column.usual) for column in columns] == [(0, False), (1, True), (0, False)]


def test_what_counts_rows_is_followed_or_told(blank: Page, tmp_path: Path) -> None:
    lines = "\n".join(f"y_{k} = {line}  # [-] line" for k, line in enumerate(LINES))
    sheet = own(tmp_path, lines)
    names = sheet.run(sheet.results, {"g": sheet.inputs()})
    recording = record({**names, "__file__": sheet.path}, every=1, draws=True, lists=True)
    values = {str(k): recording.values[f"y_{k}"] for k in range(len(LINES))}
    parts = {k: value.re for k, value in values.items() if isinstance(value, Quantity)}  # the size of an array is none
    script = javascript.module(recording, parts)
    told = set()
    for given, found in zip(GIVES, evaluated(blank, script, [leaves(sheet, x) for x in GIVES]), strict=True):
        run = sheet.run([f"y_{k}" for k in range(len(LINES))], {"g": inputs.build(sheet.inputs, given)})
        for k, line in ((int(k), LINES[int(k)]) for k in parts):
            number, why = found["values"][str(k)], found["gaps"].get(str(k))
            if number is None:
                assert why, line
                told.add(line)
                continue
            np.testing.assert_allclose(number, float(run[f"y_{k}"]), rtol=1e-12, err_msg=f"{line} {given}")
    seen = {line for line in LINES if any(what in line for what in ("range(s", "zeros", "gcd"))}  # by Python
    assert told <= seen and {LINES[int(k)] for k in values.keys() - parts.keys()} <= seen


@pytest.mark.parametrize("line", LINES)
def test_a_sweep_counts_the_rows_of_each_variant(line: str, tmp_path: Path) -> None:
    sheet = own(tmp_path, f"y = {line}  # [-] line")
    rows = [" | ".join("; ".join(map(str, row)) for row in given["stages"]) for given in GIVES[1:]]
    swept = sweep(sheet.path, ["y"], {"stages": rows})
    for y, text in zip(swept["y"], rows, strict=True):
        g = inputs.build(sheet.inputs, {"stages": text})
        np.testing.assert_allclose(y, float(sheet.run(["y"], {"g": g})["y"]), rtol=1e-12)


@pytest.mark.parametrize("array", ARRAYS)
def test_an_array_of_what_is_counted_takes_any_number(array: str, tmp_path: Path) -> None:
    """It is one of floats in Python: a number with decimals that is set in it was cut in a recording."""
    sheet = own(tmp_path, f"{array}\nz[1] = g.x\ny = np.sum(z) * 1.0  # [-] line")
    names = sheet.run(sheet.results, {"g": sheet.inputs()})
    recording = record({**names, "__file__": sheet.path})
    for x in (2.0, 2.75, -1.5):
        expected = sheet.run(["y"], {"g": inputs.build(sheet.inputs, {"x": x})})["y"]
        assert value_of(recording, "y", {"x": x}) == expected


@pytest.mark.parametrize(
    ("rows", "said"),
    [
        ("5; 1; 2", "teeth stages.z (1) = 5 must be > 5"),
        ("20; 1; 2 | 20; 9; 2", "number of the ratio stages.k (2) = 9 must be <= 4"),
        ("20.5; 1; 2", "teeth stages.z (1) = 20.5 must be a whole number"),
        ("1e30; 1; 2", "teeth stages.z (1) = 1e+30 must be at most 9007199254740992 in size"),
    ],
)
def test_what_is_counted_is_refused_without_decimals(rows: str, said: str, tmp_path: Path) -> None:
    sheet = own(tmp_path, "y = 1.0  # [-] line")
    with pytest.raises(SheetError, match=f"^{re.escape(said)}$"):
        inputs.build(sheet.inputs, {"stages": rows})


WORDS = """
@app.cell
def words(g):
    z = [s.z for s in g.stages]
    mo.md(f"Teeth {', '.join(map(str, z))}, in all {sum(s.z for s in g.stages)}, twice {2 * g.stages[0].z}.")
    return


if __name__ == "__main__":
    app.run()
"""


def test_a_sentence_has_the_teeth_without_decimals(blank: Page, tmp_path: Path) -> None:
    sheet = own(tmp_path, "y = sum(s.z for s in g.stages)  # [-] line", WORDS)
    page = tmp_path / "own.html"
    page.write_text(write.page(sheet, sheet.inputs()), encoding="utf-8")
    texts = read(opened(blank, page))["texts"]
    assert any("Teeth 20, 40, in all 60, twice 40." in (text or "") for text in texts)
    texts = read(opened(blank, page, "stages=25;1;2|31;0;3"))["texts"]
    assert any("Teeth 25, 31, in all 56, twice 50." in (text or "") for text in texts)
