"""A closed form is a number of a workbook where it solves the equations, and of no other branch."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from own_worksheet import own, recorded
from test_recalculation import edit

from mechsheet import evaluate
from mechsheet.quantities.lines import Recording
from mechsheet.readers.numbers import numbers
from mechsheet.readers.searched import search
from mechsheet.run import report
from mechsheet.worksheet import cells

# The form is a root while k is as exported; of another k it is one hundredth beside it.
BESIDE = "(1 + 0.01 * (g.k != 2))"
FORMS = {
    "single": (
        "one_found = find(lambda u: u**2 - g.a * u, 1e-9 * g.a, 2 * (g.a + sqrt(g.F)), equals=g.F)",
        f"closed_form(one_found, (g.a / 2 + sqrt(g.a**2 / 4 + g.F)) * {BESIDE})",
    ),
    "target 0": (
        "one_found = find(lambda u: np.cos(u / g.a) * g.F - np.sin(u / g.a), -g.a, 1.6 * g.a)",
        f"closed_form(one_found, g.a * np.arctan(g.F) * {BESIDE})",
    ),
    "field": (
        "one_found = find(lambda u: u**2 * x - g.a, 0.0, 9 * sqrt(g.a / g.F))",
        f"closed_form(one_found, np.sqrt(g.a / x) * np.where(x > g.F, 1, {BESIDE}))",
    ),
    "two": (
        "one_found = find(lambda u, v: (u + v - g.F, u - v * g.a), u=g.F, v=g.F)",
        f"closed_form(one_found, u=g.F * g.a / (1 + g.a), v=g.F / (1 + g.a) * {BESIDE})",
    ),
}
ENDS = """
y = np.atleast_1d(one_found.value) * 2  # [-] what rests on it
n = np.sum(np.isfinite(y)) * 1.0  # [-] how many there are
c = FORM  # compared
table_2 = table("2", "Two", y)
table_3 = table("3", "Three", n)"""


def sheet_of(name: str, tmp_path: Path) -> cells.Worksheet:
    find, form = FORMS[name]
    lines = f"from mechsheet import closed_form\n{find}{ENDS.replace('FORM', form)}"
    if name == "two":
        lines = lines.replace("one_found.value)", "[one_found.value.u, one_found.value.v])")
    return own(tmp_path, lines)


def of_workbook(recording: Recording, given: dict[str, float]) -> tuple[Any, Any, bool]:
    """What the cells have of the lines y and n for other inputs, and whether the check of the closed form passes."""
    forms = {solved.node: solved.inverse for solved in recording.found.values()}
    check = recording.checks[next(name for name in recording.checks if "closed form" in name)]
    columns = [column.re for table in "23" for column in recording.tables[table] if column is not None]
    changed = {recording.inputs[name]: x for name, x in given.items()}
    roots = numbers([form for form in forms.values() if form], changed)
    found = {node: roots[form] for node, form in forms.items() if form}
    now = numbers([*columns, *check.parts, check.limit], changed | found)
    y, n = (now[column] for column in columns)
    return y, n, bool(max(np.max(now[part]) for part in check.parts) <= now[check.limit])


@pytest.mark.parametrize("name", FORMS)
def test_a_closed_form_that_does_not_solve_the_equations_is_no_number(name: str, tmp_path: Path) -> None:
    """Also of inputs a billion times as large or small, and of those that leave nothing of the equation's terms."""
    sheet = sheet_of(name, tmp_path)
    _, recording = recorded(sheet)
    search(recording)
    assert not recording.unsolved
    with np.errstate(invalid="ignore"):
        for given in ({}, {"F": 3.25, "a": 0.5}, {"F": 2.5e9, "a": 0.75}, {"F": 2e-9, "a": 3e-9}, {"a": 1e9}):
            y, n, passed = of_workbook(recording, given)
            np.testing.assert_allclose(y, evaluate(sheet.path, ["y"], **given)["y"], 1e-10, err_msg=str(given))
            assert passed and n == y.size, given
        y, _, passed = of_workbook(recording, {"k": 3.0})
    there = np.isfinite(y)
    expected = evaluate(sheet.path, ["y"], k=3)["y"]
    np.testing.assert_allclose(y[there], expected[there], 1e-10)
    assert not passed and there.sum() == (3 if name == "field" else 0)


@pytest.mark.office
def test_what_rests_on_a_closed_form_that_is_no_root_is_empty(recalculated: Any, tmp_path: Path) -> None:
    """Where it is a root the numbers stay; what counts them knows nothing."""
    book = tmp_path / "own.xlsx"
    book.write_bytes(report.workbook("Own", sheet_of("field", tmp_path).run_whole(), {}))
    changed = recalculated(edit(book, {"k": 3}, tmp_path / "changed.xlsx"))
    y, n = ([row[0] for row in changed[t].iter_rows(min_row=5, values_only=True)] for t in ("2 Two", "3 Three"))
    assert y == ["#N/A", "#N/A", *map(pytest.approx, evaluate(tmp_path / "own.py", ["y"], k=3)["y"][2:])]
    assert n == ["#N/A"]
    assert {row[4].value for row in changed["Checks"].iter_rows(min_row=3)} >= {"FAIL"}
