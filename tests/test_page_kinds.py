"""Inputs that are no plain numbers, edited in a real browser."""

from pathlib import Path

import pytest
from playwright.sync_api import expect
from test_kinds import SHEET, use
from test_lists import SHEET as SECTION


def displayed(text: str) -> str:
    """The worksheet with what its cells give shown on the page."""
    text = text.replace("import ask", "import Used, ask")
    ends = {
        "(form,)": "form",
        "(g,)": "Used(g)",
        "(table_1,)": "table_1",
        "table_1, table_2": "typeset(table_1, table_2)",
    }
    for names, last in ends.items():
        text = text.replace(f"    return {names}", f"    {last}\n    return {names}")
    return text


@pytest.fixture(scope="module")
def bolt(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("page") / "bolt.py"
    path.write_text(displayed(SHEET), encoding="utf-8")
    return path


def shown(page, number: float) -> None:
    """The use at the whole force, in the last row of table 1."""
    cell = page.locator(".ms-table:has-text('Table 1 ') tbody tr:nth-child(3) td").nth(1)
    expect(cell).to_have_text(f"{number:.3f}")


def test_each_kind_is_edited_at_its_field(serve, page, bolt, console_errors):
    page.goto(serve("run", bolt))
    shown(page, use())
    row = page.locator(".ms-inputs tr")
    row.filter(has_text="grade of the bolt").locator("select").select_option("10.9")
    shown(page, use("10.9"))
    row.filter(has_text="planes of shear").locator("select").select_option("double")
    shown(page, use("10.9", "double"))
    row.filter(has_text="thread in the plane").get_by_role("checkbox").click()
    shown(page, use("10.9", "double", False))
    page.locator(".ms-screen", has_text="grade = 10.9").wait_for()
    expect(page.locator(".ms-screen", has_text="threaded = no")).to_have_count(1)
    assert console_errors == []


def test_lists_and_tables_are_edited_as_text_and_pasted(serve, page, tmp_path_factory, console_errors):
    path = tmp_path_factory.mktemp("page") / "section.py"
    path.write_text(displayed(SECTION), encoding="utf-8")
    page.goto(serve("run", path))

    def column(table: str, number: int) -> list[str]:
        cells = page.locator(f".ms-table:has-text('Table {table} ') tbody td:nth-child({number})")
        return cells.all_inner_texts()

    row = page.locator(".ms-inputs tr")
    expect(page.locator(".ms-table:has-text('Table 1 ') tbody tr")).to_have_count(3)
    forces = row.filter(has_text="forces").locator("input")
    expect(forces).to_have_value("10; -4; 2.5")
    forces.fill("10; -4; 2,5; 500 N")
    forces.press("Enter")
    expect(page.locator(".ms-table:has-text('Table 1 ') tbody tr")).to_have_count(4)
    assert column("1", 1) == ["10.00", "-4.00", "2.50", "0.50"]
    stringers = row.filter(has_text="stringers of the section").locator("textarea")
    expect(stringers).to_have_value("1; 25; 30\n0.5; -25; 30")
    stringers.fill("1\t25\t30\n1\t-25\t30\n2\t0\t30\n")  # as a spreadsheet program copies its cells
    stringers.blur()
    expect(page.locator(".ms-table:has-text('Table 2 ') tbody tr")).to_have_count(3)
    assert column("2", 1) == ["0.250", "0.250", "0.500"]
    stringers.fill("1; 25; 30 | 1; x; 30")
    stringers.blur()
    page.get_by_text("level stringers.y (2) = 'x' cm is no number").first.wait_for()
    assert console_errors == []
