"""Editing in a real browser, in ``marimo edit``: what depends on an edited line follows, mistakes are told there."""

from math import asin, degrees
from pathlib import Path

import pytest

from mechsheet import __main__ as launcher

TEMPLATE = Path(launcher.__file__).with_name("new_worksheet.txt")


class Editor:
    """A worksheet from the template, opened in the editor."""

    def __init__(self, page, address):
        self.page = page
        page.set_viewport_size({"width": 1280, "height": 3000})
        page.goto(address)
        self.expect("1 of 1 checks pass")

    def expect(self, text: str) -> None:
        self.page.get_by_text(text).first.wait_for(timeout=20_000)

    def edit(self, old: str, new: str):
        """Put a text in the place of another one in the cell that holds it, and run the cell."""
        found = self.page.locator(".marimo-cell", has=self.page.locator(".cm-content", has_text=old)).first
        cell = self.page.locator(f"#{found.get_attribute('id')}")
        code = cell.locator(".cm-content").first
        lines = code.locator(".cm-line").evaluate_all("lines => lines.map(line => line.textContent)")
        text = "\n".join(lines)
        assert old in text
        code.click()
        self.page.keyboard.press("Control+a")
        self.page.keyboard.insert_text(text.replace(old, new))
        self.page.wait_for_timeout(300)
        self.page.keyboard.press("Control+Enter")
        return cell

    def last_moment(self) -> str:
        return self.page.locator(".ms-table tbody tr").last.locator("td").last.inner_text()


@pytest.fixture
def editor(serve, page, tmp_path):
    sheet = tmp_path / "lever.py"
    sheet.write_text(TEMPLATE.read_text(encoding="utf-8").replace("TITLE", "Lever"), encoding="utf-8")
    return Editor(page, serve("edit", sheet))


def test_edited_number_formula_and_unit_change_everything(editor, tmp_path):
    from openpyxl import load_workbook

    page = editor.page
    assert editor.last_moment() == "420"
    curve = page.locator("svg.ms-chart path[stroke='#3b82d0']").first
    before = curve.get_attribute("d")
    editor.edit("M_max: float = 300.0", "M_max: float = 310.0")
    page.locator(".ms-screen", has_text="310").first.wait_for(timeout=30_000)
    editor.edit("g.F * g.L * sin(phi)  # [N*m]", "g.F * g.L * sin(phi) ** 3  # [kN*m]")
    page.locator("marimo-tex", has_text="sin^{3}").first.wait_for(timeout=30_000, state="attached")
    page.wait_for_function(
        f"() => document.querySelector('svg.ms-chart path[stroke]').getAttribute('d') !== {before!r}"
    )
    assert editor.last_moment() == "420", "sine of a right angle"
    editor.expect("1 of 1 checks pass")
    editor.expect(f"{degrees(asin((310 / 420) ** (1 / 3))):.4f} deg")
    editor.edit("M_S = M(phi)  # [N*m]", "M_S = M(phi)  # [kN*m]")
    page.locator(".ms-table", has_text="kN·m").wait_for(timeout=30_000)
    assert editor.last_moment() == "0.420"
    page.wait_for_function("() => document.querySelector('svg.ms-chart').textContent.includes('[kN·m]')")
    with page.expect_download() as download:
        page.get_by_text("Excel workbook").click()
    download.value.save_as(tmp_path / "lever.xlsx")
    sheet = load_workbook(tmp_path / "lever.xlsx")["1 Moment of the lever"]
    values = [cell.value for row in sheet.iter_rows() for cell in row if isinstance(cell.value, int | float)]
    assert max(v for v in values if v < 1) == pytest.approx(0.42)


def test_mistakes_are_told_at_their_place_and_the_rest_stays(editor):
    page = editor.page

    def told(cell, *texts):
        for text in texts:
            cell.get_by_text(text).first.wait_for(timeout=30_000)
        assert page.get_by_role("heading", name="3 Results").count() == 1
        assert page.locator(".ms-inputs input").count() == 3

    told(
        editor.edit("# [N*m] moment\n", "# [Nm] moment\n"), "line 4 of the cell: unit [Nm] is not known; write units as"
    )
    assert page.get_by_text("TRACEBACK").count() == 0
    assert "unit [Nm] is not known" in page.evaluate("""() =>
        getComputedStyle(document.querySelector(".ms-told"), "::after").content""")
    told(editor.edit("# [Nm] moment\n", "# [N*m] moment\n"))
    editor.expect("1 of 1 checks pass")
    told(editor.edit("g.L * sin", "g.Ll * sin"), "'Given' object has no attribute 'Ll'")
    told(editor.edit("g.Ll * sin(phi)", "g.L * sin(phii)"), "name 'phii' is not defined")
    editor.expect("An ancestor raised an exception (NameError)")
    told(editor.edit("sin(phii)", "sin(phi"), "'(' was never closed")
    told(editor.edit("sin(phi", "sin(phi)"))
    editor.expect("1 of 1 checks pass")
    field = page.locator(".ms-inputs tr:has-text('greatest moment') input")
    field.fill("500")
    field.press("Enter")
    editor.expect("angle phi: moment reaches 0..420 N*m, 500 N*m is outside")
    assert page.locator(".ms-table").count() == 0 and page.get_by_text("moment over the positions").count() > 0
    field.fill("abc")
    field.press("Enter")
    editor.expect("M_max = 'abc' N*m is no number")
    assert page.locator(".ms-told").is_visible()
    field.fill("300")
    field.press("Enter")
    editor.expect("1 of 1 checks pass")
    assert not page.locator(".ms-told").is_visible()
    assert editor.last_moment() == "420"
