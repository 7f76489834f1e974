"""Inputs that are no plain numbers, edited in a real browser."""

from pathlib import Path

import pytest
from playwright.sync_api import expect
from test_kinds import SHEET, use


@pytest.fixture(scope="module")
def bolt(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("page") / "bolt.py"
    text = SHEET.replace("ask, check", "Used, ask, check")
    for name, last in (("form", "form"), ("g", "Used(g)"), ("table_1", "table_1")):
        text = text.replace(f"    return ({name},)", f"    {last}\n    return ({name},)")
    path.write_text(text, encoding="utf-8")
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
