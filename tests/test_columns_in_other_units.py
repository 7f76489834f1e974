"""The units in which a table or a figure shows its columns: of the same quantity, for columns that it has."""

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from as_script import as_script
from cells import run
from own_worksheet import own

from mechsheet.worksheet.errors import SheetError

CELL = """
import numpy as np
from mechsheet import typeset
from mechsheet.units import rpm
y_1 = np.array([0.42, 0.67])  # [m] stroke
P23_S = y_1 * (1 + 2j)  # [m] pin
R56 = y_1 * (3000 + 4000j)  # [kN] reaction
n = y_1 * rpm  # [rpm] speed
T = y_1 + 300  # [K] temperature
dT = y_1 + 3  # [degC] difference
k = y_1 + 3  # [mms] mistaken
typeset()
"""


@pytest.fixture(scope="module")
def names() -> dict[str, Any]:
    return run("from mechsheet import figure, table", run(CELL))


@pytest.mark.parametrize(
    ("column", "show", "unit", "first"),
    [
        ("y_1", "{'y1': 'mm'}", "mm", 420),
        ("y_1", "{'y_1': 'mm'}", "mm", 420),
        ("P23_S.imag", "{'Y23': 'cm'}", "cm", 84),
        ("P23_S.imag", "{'P23_S.imag': 'cm'}", "cm", 84),
        ("abs(R56)", "{'R56': 'N'}", "N", 2100),
        ("R56.real", "{'R56x': 'N'}", "N", 1260),
        ("n", "{'n': 'deg/s'}", "deg/s", 2.52),
        ("n", "{'n': '°/s'}", "deg/s", 2.52),
        ("dT", "{'dT': 'K'}", "K", 3.42),
        ("k", "{'k': 'mm'}", "?", 3.42),
    ],
)
def test_a_column_is_named_as_it_is_headed_or_written(
    column: str, show: str, unit: str, first: float, names: dict[str, Any]
) -> None:
    run(f't = table("1", "T", {column}, show={show})\nf = figure("2", "F", y_1, {column}, show={show})', names)
    for found in (names["t"].columns[-1], names["f"].lines[-1]):
        assert found.unit == unit and np.isclose(found.values[0], first)


@pytest.mark.parametrize(("unit", "other"), [("kN", "kg"), ("rpm", "Hz"), ("rpm", "1/min")])
def test_a_line_is_not_displayed_in_the_unit_of_another_quantity(unit: str, other: str) -> None:
    line = f"from mechsheet import typeset\nx = 2.5  # [{unit}] quantity\nt = typeset(display={{'{unit}': '{other}'}})"
    (row,) = run(line)["t"].rows
    assert row.mistake == f"unit [{other}] does not measure {unit}" and row.unit == "?"


@pytest.mark.parametrize(
    ("show", "says"),
    [
        ("{'y1': 'kg'}", "show of y1 = 'kg': kg does not measure m"),
        ("{'y_1': 'foot'}", "show of y1 = 'foot': unit [foot] is not known; nearest: ft"),
        ("{'n': 'Hz'}", "show of n = 'Hz': a column in rpm is another number there"),
        ("{'n': '1/min'}", "show of n = '1/min': a column in rpm is another number there"),
        ("{'T': 'degC'}", "show of T = 'degC': a column in K is another number there"),
        ("{'n': 3}", "show of n = 3: its unit must be a text between quotes, not 3"),
        ("{'zz': 'mm'}", "show has 'zz', which is no column; nearest: y1, n, T"),
        ("{'y2': 'mm'}", "show has 'y2', which is no column; nearest: y1"),
    ],
)
@pytest.mark.parametrize("kind", ["table", "figure"])
def test_another_quantity_and_no_column_are_refused(kind: str, show: str, says: str, names: dict[str, Any]) -> None:
    """They were shown with the wrong unit, or as if nothing had been asked."""
    with pytest.raises(SheetError, match=f"^{kind} 1: {re.escape(says)}"):
        run(f't = {kind}("1", "T", y_1, n, T, show={show})', names)


def test_a_workbook_divides_by_a_whole_turn(recalculated: Callable[[Path], Any], tmp_path: Path) -> None:
    """By two pi, and not by two times pi."""
    table, figure = (f"{kind}, show={{'n': 'rev/s'}})" for kind in ("table('2', 'Two', n", "figure('2', 'Two', n, x"))
    lines = f"n = 10 * x  # [rpm] speed\ntable_2 = {table}\nfigure_2 = {figure}"
    sheet = own(tmp_path, lines, further=['export("Own", globals())'])
    as_script(sheet.path, f"--out={tmp_path}")
    book, turns = recalculated(tmp_path / "own.xlsx"), 10 * np.linspace(0.1, 2, 5) * 2.5 / (2 * np.pi)
    for title in ("2 Two", "Fig 2 data"):
        found = [row[0] for row in book[title].iter_rows(min_row=5, max_row=9, values_only=True)]
        np.testing.assert_allclose(found, turns, rtol=1e-12)
