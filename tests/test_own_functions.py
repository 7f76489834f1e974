"""Functions of a worksheet's own that are called like one that is known: they stand in formulas by their names."""

import re
from pathlib import Path

import pytest
from own_worksheet import written

from mechsheet.html import write
from mechsheet.worksheet.cells import load

SETUP = "import numpy as np\nfrom numpy import maximum\nfrom mechsheet import ask, inputs, read, typeset"
NAMES = ["power", "square", "hypot", "cbrt", "conj", "where", "floor", "exp", "sum", "abs", "interp", "sin", "divide"]


def line(tmp_path: Path, setup: str, formula: str) -> str:
    """The text of a line as the page shows it."""
    path = tmp_path / "own.py"
    path.write_text(written(setup, "F: float = 2.5  # [-] force", f"P = {formula}  # [-] product\ntypeset()"))
    shown = write.page(sheet := load(path), sheet.inputs())
    (found,) = re.findall('<math.*?id="line-P".*?product|id="line-P".*?product', shown, re.DOTALL)
    return re.sub("<[^>]*>", "", found)


@pytest.mark.parametrize("name", NAMES)
def test_a_function_of_the_worksheet_is_written_by_its_name(name: str, tmp_path: Path) -> None:
    """power(F, v) = F v stood there as the power of them: a formula that is not true."""
    shown = line(tmp_path, f"{SETUP}\n\ndef {name}(F, v):\n    return F * v\n", f"{name}(g.F, 2.0) + 1.0")
    assert re.search(rf"{name}\W*\(\W*F\W*2\W*\)", shown), shown


def test_one_of_numpy_is_written_as_it_is_known(tmp_path: Path) -> None:
    assert "max" in (shown := line(tmp_path, SETUP, "maximum(g.F, 2.0)")) and "maximum" not in shown


def test_a_method_that_keeps_something_is_called_for_each_row(tmp_path: Path) -> None:
    """It was taken for a formula of a row, and the page could not be written: KeyError: 'state'."""
    path = tmp_path / "own.py"
    lines = (
        "class R:\n    def __init__(self):\n        self.s = 0.0\n    def push(self, x):\n        if x > self.s:\n"
        "            self.s = x\n        return self.s\nrat = R()\n"
        "tops = np.array([rat.push(x) for x in g.xs])  # [-] running greatest\ntypeset()"
    )
    path.write_text(written(SETUP, "xs: list[float] = [0.1, 0.5, 0.2]  # [-] points", lines))
    sheet = load(path)
    assert "running greatest" in write.page(sheet, sheet.inputs())


def test_a_function_of_the_setup_that_keeps_something_is_called_for_each_row(tmp_path: Path) -> None:
    """The same: what a function of the setup changes was not looked for."""
    path = tmp_path / "own.py"
    memo = "CACHE = {}\ndef square(v):\n    if v not in CACHE:\n        CACHE[v] = v**2\n    return CACHE[v]"
    lines = "total = sum(square(v) for v in g.xs)  # [-] sum of squares\ntypeset()"
    path.write_text(written(f"{SETUP}\n{memo}", "xs: list[float] = [0.1, 0.5, 0.2]  # [-] points", lines))
    sheet = load(path)
    assert "sum of squares" in write.page(sheet, sheet.inputs())
