"""Every line stands in the workbook, also one on which nothing rests, and follows its inputs or shows no number."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from as_script import as_script
from openpyxl import load_workbook
from own_worksheet import written
from test_recalculation import computed, edit, lines, lines_apart

SETUP = """import numpy as np
from numpy import linspace
from mechsheet import ask, check, export, inputs, read, slider
from mechsheet.units import kN"""
GIVEN = """F: float = 1200.0  # [N] force; >= 0
L: float = 0.35  # [m] length; > 0
n: int = 3  # [-] turns; > 0 < 9"""
LINES = """eta = 0.9  # [-] efficiency
P = 2 * kN  # [kN] constant load
F_1 = g.F  # [N] the force again
M = g.F * g.L * eta  # [N*m] moment
M_1 = M  # [N*m] the moment again
R = g.F + P * 1j  # [N] complex, its second part constant
ok = M > 3  # [-] truth
x = linspace(0, 1, 7)  # [-] places
M_x = M * (1 - x)  # [N*m] along the lever
two = np.outer(x, x) * M  # [N*m] matrix
total = 0 * M
for k in range(g.n):
    total = total + k * M
M_n = total  # [N*m] by turns
part = slider(0, 1, 0.1, value=0.5, label="part of it")
M_p = M * part.value  # [N*m] at the slider
read_of = float(f"{M:.3f}")  # [N*m] read out of a text"""


@pytest.fixture
def worksheet(tmp_path: Path) -> Path:
    path = tmp_path / "lines.py"
    path.write_text(written(SETUP, GIVEN, LINES, "Lines"))
    return path


def test_lines_alone_give_a_workbook(worksheet: Path, tmp_path: Path) -> None:
    """Without a table, figure or check it had a list of no lines, and said that all checks pass."""
    found = lines(load_workbook(computed(worksheet, tmp_path, {}), data_only=True))
    own = {name: values for (_, name), (_, values) in found.items()}
    one = {"eta": 0.9, "P": 2000, "F_1": 1200, "M": 378, "M_1": 378, "Rx": 1200, "Ry": 2000, "ok": 1, "M_n": 1134}
    one |= {"M_p": 189, "read_of": 378}
    single = {name: value for name, (value, *more) in own.items() if not more}
    assert single == {name: pytest.approx(value) for name, value in one.items()}
    assert {name: len(values) for name, values in own.items() if len(values) > 1} == {"x": 7, "M_x": 7, "two": 49}


@pytest.mark.office
def test_lines_follow_or_show_no_number(worksheet: Path, recalculated: Callable[[Path], Any], tmp_path: Path) -> None:
    (tmp_path / "other").mkdir()
    there = recalculated(edit(computed(worksheet, tmp_path, {}), {"F": 900.0, "L": 0.5}, tmp_path / "edited.xlsx"))
    own = load_workbook(computed(worksheet, tmp_path / "other", {"F": 900.0, "L": 0.5}), data_only=True)
    apart = list(lines_apart(there, own))
    assert len(apart) == 1 and "'read_of'): '#N/A' instead of 405" in apart[0]


def test_what_is_too_long_is_told(tmp_path: Path) -> None:
    """A line that rests on a hundred thousand numbers has no column of these; a run tells which it is."""
    path = tmp_path / "long.py"
    end = "long = g.F * linspace(0, 1, 100_000)  # [N] long\nmost = long.max()  # [N] greatest\n"
    path.write_text(written(SETUP, GIVEN, end + "other = g.L * linspace(0, 1, 20)  # [m] other", "Long"))
    told = [line for line in as_script(path).stdout.splitlines() if line.startswith("not there")]
    assert told == [f"not there: {name}, a line of too many numbers" for name in ("long", "most")]
    assert {name for _, name in lines(load_workbook(tmp_path / "long.xlsx", data_only=True))} == {"other"}


def test_what_no_line_takes_is_found_too(tmp_path: Path) -> None:
    """A found value that stands in a formula alone was on no sheet; one of two unknowns likewise."""
    path = tmp_path / "found.py"
    path.write_text(written(SETUP.replace("ask,", "ask, find,"), GIVEN, FOUND, "Found"))
    rows = load_workbook(computed(path, tmp_path, {}), data_only=True)["Find"].iter_rows(min_row=3, values_only=True)
    found = {row[0]: (row[1], row[2], row[9] != "found") for row in rows}
    assert found == {
        "x_1": (pytest.approx(1.5), "-", False),
        "phi_found.value": (pytest.approx(60), "°", True),
        "xy.value.y": (pytest.approx(1.5), "-", False),
    }


FOUND = """phi_found = find(np.cos, 0, np.pi, equals=0.5 + 0 * g.F, unknown="angle", unknown_unit="deg")
twice = 2 * np.sin(phi_found.value)  # [-] twice
xy = find(lambda x, y: (x + y - g.n, x - y), x=(-4, 4), y=(-3, 3))
x_1 = xy.value.x  # [-] first
s = xy.value.x + xy.value.y  # [-] sum"""
