"""Columns of texts that are computed: which of several stands in a row follows in cells and on a page."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest
from own_worksheet import written
from test_recalculation import computed, edit

from mechsheet import load
from mechsheet.html import write
from mechsheet.worksheet import inputs

if TYPE_CHECKING:
    from playwright.sync_api import Page

SETUP = """
from datetime import date, timedelta
from typing import Literal

import numpy as np
from numpy import linspace, where

from mechsheet import ask, export, inputs, read, table, typeset

W = {"IPE 80": 20e-6, "IPE 100": 34.2e-6, "IPE 120": 53e-6}
"""
GIVEN = """
M: float = 4000.0  # [N*m] moment
k: int = 4  # [-] how many; >= 1 <= 9
kind: Literal["a", "b"] = "a"  # kind
big: bool = True  # big
"""
LINES = """
x = linspace(1, 2.5, g.k) * g.M  # [N*m] moment
low = where(x < 7000, "yes", "no")
grade = where(x < 5000, "low", where(x < 9000, "mid", "high"))
other = np.select([x < 5000, x < 9000], ["low", "mid"], "high")
names = np.array([*W])
picked = names[np.minimum(np.searchsorted([*W.values()], x / 190e6), 2)]
each = np.array(["yes" if m < 7000 else "no" for m in x])
first = [next((name for name, w in W.items() if w > m / 190e6), "none") for m in x]
table_1 = table("1", "All", x, low, grade, other, picked, each, first)
y = g.M * np.arange(3)  # [N*m] others
kinds = np.asarray([f"kind {g.kind}", "big" if g.big else "small", "same"])
fixed = [date(2026, 1, n) for n in (1, 2, 3)]
table_2 = table("2", "Kinds", y, kinds, fixed)
days = [date(2026, 1, 1) + timedelta(days=n * round(g.M / 1000)) for n in range(3)]
table_3 = table("3", "Days", y, days)
said = [f"{m / 1000:.3f} kN m" if m < 7000 else "more" for m in x]
root = [f"{np.sqrt(m - 5000):.2f}" if m > 5000 else "none" for m in x]
table_4 = table("4", "Said", x, said, root)
"""
OTHERS: list[dict[str, Any]] = [{"M": 3000.0}, {"M": 1800.0, "kind": "b", "big": False}]


@pytest.fixture
def sheet(tmp_path: Path) -> Path:
    path = tmp_path / "texts.py"
    text = written(SETUP, GIVEN, LINES, "Texts").replace("    return (form,)", "    form\n    return (form,)")
    path.write_text(text.replace("    return x", "    typeset(table_1, table_2, table_3, table_4)\n    return x"))
    return path


def shown(path: Path, **given: Any) -> list[list[list[str]]]:
    """The rows of all tables for some inputs."""
    found = load(path)
    names = found.run([f"table_{n}" for n in (1, 2, 3, 4)], {"g": inputs.build(found.inputs, given)})
    return [[*map(list, zip(*(c.texts() for c in names[f"table_{n}"].columns), strict=True))] for n in (1, 2, 3, 4)]


def test_texts_are_columns(sheet: Path) -> None:
    """They were refused as no number, wherever they were not inputs."""
    first, kinds, days, _ = shown(sheet)
    assert [row[1:] for row in first] == [
        ["yes", "low", "low", "IPE 100", "yes", "IPE 100"],
        ["yes", "mid", "mid", "IPE 100", "yes", "IPE 100"],
        ["no", "mid", "mid", "IPE 120", "no", "IPE 120"],
        ["no", "high", "high", "IPE 120", "no", "IPE 120"],
    ]
    assert [row[1:] for row in kinds] == [["kind a", "2026-01-01"], ["big", "2026-01-02"], ["same", "2026-01-03"]]
    assert [row[1] for row in days] == ["2026-01-01", "2026-01-05", "2026-01-09"]


@pytest.mark.office
def test_cells_choose_the_texts_of_other_inputs(sheet: Path, tmp_path: Path, recalculated: Any) -> None:
    book = computed(sheet, tmp_path, {})
    for n, given in enumerate(OTHERS):
        typed = {key: ("yes" if x else "no") if isinstance(x, bool) else x for key, x in given.items()}
        live = recalculated(edit(book, typed, tmp_path / f"edited{n}.xlsx"))
        for title, own in zip(("1 All", "2 Kinds"), shown(sheet, **given), strict=False):
            rows = live[title].iter_rows(min_row=5, max_row=4 + len(own), values_only=True)
            assert [list(row[1:]) for row in rows] == [row[1:] for row in own], (title, given)
        days = [*live["3 Days"].iter_rows(min_row=5, max_row=7, values_only=True)]
        assert {row[1] for row in days} == {"#N/A"}  # which takes no number with it
        assert [row[0] for row in days] == [float(row[0]) for row in shown(sheet, **given)[2]]
        said = [*live["4 Said"].iter_rows(min_row=5, max_row=8, values_only=True)]
        assert [row[0] for row in said] == [float(row[0]) for row in shown(sheet, **given)[3]]
        assert [list(row[1:]) for row in said] == [row[1:] for row in shown(sheet, **given)[3]]


def test_a_page_chooses_the_texts_of_other_inputs(sheet: Path, tmp_path: Path, page: Page) -> None:
    """With other numbers of rows too; what Python alone makes is not known there, and said to be so."""
    file = tmp_path / "texts.html"
    file.write_text(write.page(load(sheet), load(sheet).inputs()), encoding="utf-8")
    for given in [*OTHERS, {"k": 7, "M": 2500.0}]:
        page.goto("about:blank")
        page.goto(file.as_uri())
        page.wait_for_selector("body[data-ready]")
        for key, x in given.items():
            field = page.locator(f"#input-{key}")
            if isinstance(x, bool):
                field.set_checked(x)
            elif isinstance(x, str):
                field.select_option(x)
            else:
                field.fill(str(x))
        tables = page.locator(".ms-table").evaluate_all(
            "all => all.map(t => [...t.querySelectorAll('tbody tr')].map(r => [...r.cells].map(c => c.innerText)))"
        )
        own = shown(sheet, **given)
        assert [[row[1:] for row in rows] for rows in tables[:2]] == [[row[1:] for row in rows] for rows in own[:2]]
        assert [row[0] for row in tables[2]] == [row[0] for row in own[2]]
        assert {row[1] for row in tables[2]} == {""}
        assert [row[0] for row in tables[3]] == [row[0] for row in own[3]]
        assert [row[1:] for row in tables[3]] == ([["", ""]] * 7 if "k" in given else [row[1:] for row in own[3]])
        assert "not known: Table 3" in page.locator(".ms-state").inner_text()


def test_a_formula_of_texts_among_the_inputs_has_no_number_to_put_in(tmp_path: Path) -> None:
    """There was no page of such a line: a text of an array has no .item()."""
    setup = SETUP + "\n\n@inputs\nclass Pipe:\n    name: str  # line\n    d: float  # [mm] bore\n"
    line = 'v = np.array([{"suction": 1.5}.get(n, 4.0) for n in g.pipes.name]) * 1.0  # [m/s] allowed\ntypeset()'
    path = tmp_path / "pipes.py"
    path.write_text(written(setup, 'pipes: list[Pipe] = [Pipe("suction", 0.04), Pipe("return", 0.025)]  # lines', line))
    sheet = load(path)
    assert "allowed" in write.page(sheet, sheet.inputs())


def test_a_figure_of_its_own_data_is_called_by_other_inputs_on_all_sheets(tmp_path: Path, recalculated: Any) -> None:
    """Only the chart was: the sheet of its data and that of its marks kept the number of the exported inputs."""
    path = tmp_path / "figure.py"
    lines = "x = linspace(1, 2.5, 5) * g.M  # [N*m] moment\ny = x**2  # [N**2*m**2] its square\n"
    lines += 'figure_1 = figure("1", f"Up to {x.max():.0f} N m", x, y, marks={"M": g.M})'
    path.write_text(
        written(SETUP.replace("export,", "export, figure,"), "M: float = 4000.0  # [N*m] M", lines, "Figure")
    )
    book = computed(path, tmp_path, {})
    live = recalculated(edit(book, {"M": 2000.0}, tmp_path / "edited.xlsx"))
    assert live["Fig 1 data"]["A1"].value == "Data of figure 1 - Up to 5000 N m"
    told = [cell.value for (cell, *_) in live["Marks"].iter_rows(min_row=3)]
    assert {*told} == {"Figure 1 - Up to 5000 N m"}
