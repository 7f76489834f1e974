"""What depends on no input is the same for all inputs: it is given, so nothing of it is to be proved, or not known."""

from pathlib import Path

import numpy as np
import pytest
import written_cells
from as_script import as_script
from own_worksheet import own, recorded

from mechsheet.readers.numbers import numbers
from mechsheet.worksheet.cells import load

CONSTANTS = """member = np.array([1, 2, 3])  # [-] whole numbers
sizes = np.array([1, 2.5, 4]) * 1e-3  # [L] typed ones
lengths = np.array([len(name) for name in ("a", "bb", "ccc")])  # [-] counted
later = np.interp([0.5, 1.5, 2.5], [0, 1, 3], [0, 2, 5])  # [-] by a function of numpy
result = sizes * g.F  # [L] of an input
table_2 = table("2", "Constants", member, sizes, lengths, later)
figure_2 = figure("2", "Constants", member, sizes, marks={"two": 2.0})
table_3 = table("3", "Result", result)"""
LOST = "common = np.gcd(int(g.F), 4)  # [-] what is not followed\n"


def test_typed_constants_are_given_and_what_is_computed_of_them_is_proved(tmp_path: Path) -> None:
    sheet = own(tmp_path, CONSTANTS, further=['export("Own", globals())'])
    run = as_script(sheet.path, "--proof", f"--out={tmp_path}")
    assert run.returncode == 0 and "not recorded" not in run.stdout, run.stdout
    assert "table 2  6 " in run.stdout and "table 3  3 " in run.stdout  # of table 2 sizes and later


def test_constants_stand_for_all_inputs_beside_what_is_not_followed(tmp_path: Path) -> None:
    """On the sheets of a table and of the data of a chart; also where a column is none of another statement's."""
    sheet = own(tmp_path, LOST + CONSTANTS, further=['export("Own", globals())'])
    run = as_script(sheet.path, f"--out={tmp_path}")
    assert run.returncode == 0 and "common: gcd" in run.stdout, run
    cells = written_cells.read(tmp_path / "own.xlsx")["2 Constants"]
    assert {column for row, column in cells if row > 4} == {1, 2, 3, 4}
    assert not any(formula for (row, _), (formula, _) in cells.items() if row > 4)
    assert not cells.get((2, 1), ("", None))[1]  # no note of columns that hold as exported


COLUMNS = ["m", "np.array([g.F, g.a])"], ["", '["low" if g.F < 3 else "high", "other"]']


@pytest.mark.parametrize(("unit", "column"), COLUMNS, ids=["numbers", "texts"])
def test_a_table_that_is_built_of_columns_is_no_constant(unit: str, column: str, tmp_path: Path) -> None:
    """Nobody knows how its columns come from the inputs: it holds for those of the run."""
    columns = f'Column("v", "m", "", 1, np.array([g.F, 1.0])), Column("w", "{unit}", "", 1, {column})'
    line = f'table_2 = Table("2", "Built", ({columns}))'
    path = Path(own(tmp_path, line).path)
    path.write_text(path.read_text().replace("import ask, find", "import Column, Table, ask, find", 1))
    _, recording = recorded(load(path))
    assert [(gap.names, gap.reason) for gap in recording.gaps] == [
        (("table_2",), "its columns are built without table or figure")
    ]
    (first, *_) = recording.tables["2"]
    assert first is not None and np.isnan(numbers([first.re], {recording.inputs["F"]: 3.25})[first.re]).all()
