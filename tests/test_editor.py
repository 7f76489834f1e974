"""Editing, in a real browser in ``marimo edit``: what depends on an edited line follows, mistakes are told there."""

import ast
import linecache
import os
import re
from contextlib import nullcontext, suppress
from math import asin, degrees
from pathlib import Path
from types import SimpleNamespace

import marimo
import pytest
from conftest import ROOT, alive, drawn, in_sight, marimo_server, new_page, placed, until
from playwright.sync_api import TimeoutError, expect
from test_page import choose, choose_by_keys
from written_cells import Values

from mechsheet import __main__ as launcher
from mechsheet import find
from mechsheet.document.left_out import left_out, unseen
from mechsheet.page import editor as told_by
from mechsheet.page import in_place, notebook, unfinished
from mechsheet.worksheet import source
from mechsheet.worksheet.check import Check
from mechsheet.worksheet.line_shown import given
from mechsheet.worksheet.lines import registry
from mechsheet.worksheet.source import of_texts

TEMPLATE = Path(launcher.__file__).parent / "run" / "new_worksheet.txt"


def written(code) -> str:
    """Text of an editor of code."""
    return "\n".join(code.locator(".cm-line").all_text_contents())


class Editor:
    """A worksheet from the template, opened in the editor."""

    def __init__(self, page, address):
        self.page = page
        self.former = {}
        page.goto(address)
        self.expect("2 of 2 checks pass")
        alive(page)
        expect(page.locator(".cm-content:visible")).to_have_count(0)  # it opens for reading, even the setup folded
        page.get_by_label("code of all cells").check()

    def expect(self, text: str) -> None:
        self.page.get_by_text(text).first.wait_for()

    def edit(self, old: str, new: str):
        """Put a text in the place of another one in the cell that holds it, and run the cell."""
        found = self.page.locator(".marimo-cell", has=self.page.locator(".cm-content", has_text=old)).first
        cell = found.get_attribute("id")
        text = written(self.code(cell))
        assert old in text
        self.former.setdefault(cell, text)
        self.write(cell, text.replace(old, new))
        return self.page.locator(f"#{cell}")

    def code(self, cell: str):
        return self.page.locator(f"#{cell} .cm-content").first

    def write(self, cell: str, text: str) -> None:
        self.code(cell).click()
        self.page.keyboard.press("Control+a")
        self.page.keyboard.insert_text(text)
        until(self.page, lambda: written(self.code(cell)) == text, "the editor does not take the text")
        drawn(self.page)
        self.page.keyboard.press("Control+Enter")

    def take_back(self) -> None:
        """Leave the cells as they were."""
        for cell, text in self.former.items():
            if written(self.code(cell)) != text:
                self.write(cell, text)
        self.former = {}
        self.expect("2 of 2 checks pass")
        self.expect_last_moment("420")

    def told(self) -> list[str]:
        """Mistakes named in the title block."""
        return self.page.locator(".ms-title a").all_text_contents()

    def expect_last_moment(self, text: str) -> None:
        table = self.page.locator(".ms-table:has-text('Table 1 ')")
        expect(table.locator("tbody tr").last.locator("td").last).to_have_text(text)


@pytest.fixture(scope="module")
def opened(browser, tmp_path_factory):
    """An editor for all tests: to open one takes as long as what any of them does there."""
    sheet, folder = tmp_path_factory.mktemp("lever") / "lever.py", tmp_path_factory.mktemp("edit")
    sheet.write_text(TEMPLATE.read_text(encoding="utf-8").replace("TITLE", "Lever"), encoding="utf-8")
    with marimo_server("edit", placed(sheet, folder), folder) as address, new_page(browser) as page:
        yield Editor(page, address)


@pytest.fixture
def editor(opened, chromium):
    """The browser must be named for the marks."""
    yield opened
    opened.take_back()


def click_until(page, shown):
    """Click a formula as one does: once more where the page was drawing it anew, which a busy machine does for long."""
    formula = page.locator("#line-M_n > span").last

    def seen():
        formula.click()
        with suppress(TimeoutError):
            shown.wait_for(timeout=1000)
        return shown.is_visible()

    until(page, seen, "a click on a formula opens nothing")


def click_delete(cell):
    """Click the button that a cell has while the pointer is on it: the page may move the cell away from under it."""

    def clicked():
        cell.hover()
        with suppress(TimeoutError):
            cell.get_by_test_id("delete-button").click(timeout=1000)
            return True
        return False

    until(cell.page, clicked, "the button to delete a cell does not stay")


def edit_in_place(editor):
    """Lines edited where they stand, seen in the file and in the page, and taken back."""
    page, file = editor.page, Path(editor.page.locator("marimo-filename").text_content())
    before, box, done = file.read_bytes(), page.locator(".ms-box"), page.locator(".ms-written")
    area = box.locator("textarea")
    page.locator("#line-M_S > span").last.click()
    expect(area).to_have_value("M_S = M(phi)  # [N*m] moment over the positions")
    area.fill("M_S = 2 * M(phi)  # [m] moment over the positions")
    box.get_by_text("unit [m] does not fit; the value is in N·m").wait_for()
    area.fill("M_S = 2 * M(phii)  # [N*m] moment over the positions")
    box.get_by_text("the name phii is not defined in any cell (did you mean phi?)").wait_for()
    area.press("Enter")
    box.get_by_text(
        "it has no value, and without one nor has what stands below it in its cell: Enter once more writes it"
    ).wait_for()
    area.fill("M_S = 2 * M(phi)  # [N*m] moment over the positions")
    box.get_by_text("840 N·m").wait_for()
    assert file.read_bytes() == before
    area.press("Enter")
    expect(done).to_have_text(re.compile("^M_S is writtenundo"))
    editor.expect_last_moment("840")
    assert file.read_bytes() == before.replace(b"M_S = M(phi)", b"M_S = 2 * M(phi)")
    page.keyboard.press("Control+z")
    expect(done).to_have_text("M_S is as it was")
    editor.expect_last_moment("420")
    assert file.read_bytes() == before
    page.locator(".ms-inputs tr:has-text('greatest moment') td").first.click()
    expect(area).to_have_value("M_max: float = 300.0  # [N*m] greatest moment; > 0")
    area.fill("M_max: float = 300.0  # [N*m] greatest moment; > 1000")
    box.get_by_text("must be > 1000").wait_for()
    area.press("Enter")
    click_until(page, box.get_by_text("Enter writes this line, Esc leaves it as it was"))
    expect(area).to_have_value("M_max: float = 300.0  # [N*m] greatest moment; > 1000")
    area.fill("M_max: float = 300.0  # [N*m] greatest moment; > 0")
    page.locator(".ms-box [data-do=below]").click()
    area.fill("M_add: float = 5  # [N*m] further {moment}")
    box.get_by_text("5 N·m").wait_for()
    area.press("Enter")
    page.locator(".ms-inputs tr", has_text="further {moment}").wait_for()
    expect(page.locator(".ms-inputs tr:has-text('greatest moment') input")).to_have_value("300")
    expect(done).to_have_text(re.compile("^M_add is writtenundo"))
    click_until(page, area)
    expect(area).to_have_value("M_n = g.parts * g.F * g.L / n  # [N*m] greatest moment in each load case")
    area.fill("M_n = 3 * g.parts")
    done.get_by_role("button").click()
    expect(done).to_have_text("M_add is as it was")
    assert file.read_bytes() == before
    expect(area).to_have_value("M_n = 3 * g.parts")
    area.fill("M_k = g.parts * g.F * g.L / n  # [N*m] greatest moment in each load case")
    expect(box.get_by_role("button", name="M_n becomes M_k everywhere")).to_be_visible()
    area.press("Alt+Enter")
    expect(done).to_have_text(re.compile("^M_k is writtenundo"))
    assert file.read_bytes() == before.replace(b"M_n", b"M_k")
    page.keyboard.press("Control+z")
    expect(done).to_have_text("M_k is as it was")
    click_until(page, area)
    area.fill("")
    box.get_by_text("M_n goes, needed in section 2.2, 3 and table 2").first.wait_for()
    area.press("Enter")
    box.get_by_text("Enter once more writes it, Esc leaves it as it was").wait_for()
    assert file.read_bytes() == before, "asked first"
    area.press("Enter")
    expect(done).to_have_text(re.compile("^M_n is writtenundo"))
    assert b"    M_n = " not in file.read_bytes()
    page.keyboard.press("Control+z")
    expect(done).to_have_text("M_n is as it was")
    assert file.read_bytes() == before
    click_until(page, area)
    area.fill("")
    area.press("Control+Enter")
    assert file.read_bytes() == before
    area.press("Escape")
    return area, lambda: file.read_bytes() == before


def test_edited_number_formula_and_unit_change_everything(editor, tmp_path):

    page = editor.page
    font = page.locator("ms-formulas").get_attribute("font")
    editor.expect_last_moment("420")
    area, is_unchanged = edit_in_place(editor)
    curve = page.locator("svg.ms-chart path[stroke='#3b82d0']").first
    before = curve.get_attribute("d")
    editor.edit("M_max: float = 300.0", "M_max: float = 310.0")
    expect(page.locator(".ms-inputs tr:has-text('greatest moment') input")).to_have_value("310")
    page.locator("#line-M_S > span").last.click()
    page.get_by_text("a cell holds text that is not saved: run it and save it").wait_for()
    area.press("Enter")
    area.press("Escape")
    assert is_unchanged()
    editor.edit("g.F * g.L * sin(phi)  # [N*m]", "g.F * g.L * sin(phi) ** 3  # [kN*m]")
    page.locator("math msup", has_text="sin3").first.wait_for(state="attached")
    page.wait_for_function(
        f"() => document.querySelector('svg.ms-chart path[stroke]').getAttribute('d') !== {before!r}"
    )
    editor.expect_last_moment("420")  # sine of a right angle
    editor.expect("2 of 2 checks pass")
    editor.expect(f"{degrees(asin((310 / 420) ** (1 / 3))):.3f}°")
    editor.edit("M_S = M(phi)  # [N*m]", "M_S = M(phi)  # [kN*m]")
    page.locator(".ms-table", has_text="kN·m").wait_for()
    editor.expect_last_moment("0.420")
    page.wait_for_function("() => document.querySelector('svg.ms-chart').textContent.includes('[kN·m]')")
    with page.expect_download() as download:
        page.get_by_text("Excel workbook").click()
    download.value.save_as(tmp_path / "lever.xlsx")
    sheet = Values(tmp_path / "lever.xlsx")["1 Moment of the lever"]
    values = [cell.value for row in sheet.iter_rows() for cell in row if isinstance(cell.value, int | float)]
    assert max(v for v in values if v < 1) == pytest.approx(0.42)
    page.get_by_text("Page in one file").click()  # which would have the lines of the file, where nothing is saved
    editor.expect("lever.html is not written: the file of this worksheet is another one than this page")
    assert page.locator("ms-formulas").get_attribute("font") == font, "each title block has a file of its own"


def test_a_line_is_written_with_the_import_of_what_it_calls(editor):
    """The folded setup had to be found first, and its import to be known."""
    page, file = editor.page, Path(editor.page.locator("marimo-filename").text_content())
    before, box, done = file.read_bytes(), page.locator(".ms-box"), page.locator(".ms-written")
    area = box.locator("textarea")
    page.locator("#line-M_S > span").last.click()
    expect(area).to_have_value("M_S = M(phi)  # [N*m] moment over the positions")
    area.fill("M_S = M(phi) * 2**10**10 * cosh(0)  # [N*m] moment over the positions")
    box.get_by_text("this power is a whole number of more than 10000 digits").wait_for()
    area.fill("M_S = M(phi) * input() * cosh(0)  # [N*m] moment over the positions")
    box.get_by_text("a line asks nobody: what is given is an input").wait_for()
    area.fill("M_S = 2 * M(phi) * cosh(0)  # [N*m] moment over the positions")
    box.get_by_text("the setup gets from numpy import cosh").wait_for()
    box.get_by_text("840 N·m").wait_for()
    assert file.read_bytes() == before
    area.press("Enter")
    expect(done).to_have_text(re.compile("^M_S is writtenundo"))
    editor.expect_last_moment("840")
    editor.expect("2 of 2 checks pass")
    assert file.read_bytes() == before.replace(b"M_S = M(phi)", b"M_S = 2 * M(phi) * cosh(0)").replace(
        b"import linspace, pi, sin", b"import cosh, linspace, pi, sin"
    )
    page.keyboard.press("Control+z")
    expect(done).to_have_text("M_S is as it was")
    assert file.read_bytes() == before


def test_what_would_it_take_offers_the_inputs_and_results_there_are_now(editor):
    """It was gone, with all else that is of inputs, once one brought an import; else it had the former ones."""
    page, file = editor.page, Path(editor.page.locator("marimo-filename").text_content())
    before, area, done = file.read_bytes(), page.locator(".ms-box textarea"), page.locator(".ms-written")
    by, so = (page.locator(f"ms-design .ms-{each} select").first for each in ("vary", "need"))
    matters = page.locator(".ms-study select")

    def offered(field) -> list[str]:
        return field.locator("option").evaluate_all("all => all.map(each => each.value)")

    page.get_by_text("what would it take").click()
    by.select_option("F")
    matters.select_option("M_n")
    page.locator("#line-M_S > span").last.click()
    expect(area).to_have_value("M_S = M(phi)  # [N*m] moment over the positions")
    page.keyboard.press("Control+Enter")
    area.fill("M_T = 2 * M(phi)  # [N*m] twice the moment")
    page.locator(".ms-box").get_by_text("840 N·m").wait_for()
    area.press("Enter")
    until(page, lambda: "M_T" in offered(so) and "M_T" in offered(matters), "the new result is not offered")
    assert (by.input_value(), matters.input_value()) == ("F", "M_n"), "what is chosen stays"
    page.keyboard.press("Control+z")
    expect(done).to_have_text("M_T is as it was")
    until(page, lambda: "M_T" not in offered(so) + offered(matters), "the former result is offered")
    page.locator(".ms-inputs tr:has-text('greatest moment') td").first.click()
    expect(area).to_have_value("M_max: float = 300.0  # [N*m] greatest moment; > 0")
    page.keyboard.press("Control+Enter")
    area.fill("F_2: float = 5 * kN  # [kN] another force")
    page.locator(".ms-box").get_by_text("the setup gets").wait_for()
    area.press("Enter")
    expect(done).to_have_text(re.compile("^F_2 is writtenundo"))
    until(page, lambda: "F_2" in offered(by), "the new input is not offered")
    expect(page.locator(".ms-study").get_by_role("checkbox")).to_have_count(3)
    assert "M_n" in offered(so) and "M_n" in offered(matters)
    page.keyboard.press("Control+z")
    expect(done).to_have_text("F_2 is as it was")
    until(page, lambda: offered(by)[:5] == ["", "F", "L", "M_max", "W"], "the former inputs are not offered")
    assert file.read_bytes() == before


def test_the_lines_of_a_cell_stay_where_one_of_them_has_no_number():
    """They were gone, as was all else that the page shows once cells have run."""
    code = "a = 2.0  # [m] one\nrows = [[1.0], [1.0, 2.0]]  # [m] rows of two lengths\ntypeset()"
    cell = notebook.Cell("c", code, "c", frozenset(), frozenset(), "exception", None, False)
    with pytest.raises(NameError) as failed:
        exec(compile(code, "c", "exec"), {})
    left = unfinished.left(cell, failed.value, {"a": 2.0, "rows": [[1.0], [1.0, 2.0]]})
    assert "line-a" in left and "rows of two lengths" in left


def test_nothing_is_lost_while_the_page_takes_over_what_is_written(browser, chromium, tmp_path, monkeypatch):
    """A line that is written in place, and what is typed elsewhere or taken back meanwhile: each had lost the others.

    The server looks at the file as late as on a busy machine. The editor saves nothing by itself whose path begins with
    /tmp/, as the same file's with one more slash does not.
    """
    late = "from marimo._utils import file_watcher\nfile_watcher.PollingFileWatcher.POLL_SECONDS = 1000\n"
    (tmp_path / "sitecustomize.py").write_text(late, encoding="utf-8")
    monkeypatch.setenv("PYTHONPATH", str(tmp_path), prepend=os.pathsep)
    sheet = tmp_path / "lever.py"
    sheet.write_text(TEMPLATE.read_text(encoding="utf-8").replace("TITLE", "Lever"), encoding="utf-8")
    file = placed(sheet, tmp_path)
    with marimo_server("edit", Path(f"/{file}"), tmp_path) as address, new_page(browser) as page:
        editor = Editor(page, address)
        area, text = page.locator(".ms-box textarea"), page.locator(".cm-content", has_text="M_n = g.parts")
        done = page.locator(".ms-written")

        def write(line: str) -> None:
            page.locator("#line-M_S > span").last.click()
            expect(area).to_have_value(re.compile("^M_S = "))
            area.fill(f"{line}  # [N*m] moment over the positions")
            area.press("Enter")

        for line, typed in (("M_S = 2 * M(phi)", "# one"), ("M_S = 3 * M(phi)", "# two")):
            write(line)
            expect(done).to_contain_text("M_S is written")
            text.click()
            page.keyboard.press("Control+End")
            page.keyboard.insert_text(f"\n{typed}")
            until(page, lambda: typed in file.read_text("utf-8"), "the editor does not save by itself")  # noqa: B023
            assert line in file.read_text("utf-8") and typed in written(text)
            page.keyboard.press("Control+Enter")
            expect(page.locator(".needs-run")).to_have_count(0)
            done.evaluate("chip => (chip.textContent = '')")
        editor.expect_last_moment("1260")
        page.locator(".ms-title b").first.click()
        for line in ("M_S = 4 * M(phi)", "M_S = 5 * M(phi)"):
            write(line)
            until(page, lambda: line in file.read_text("utf-8"), "it is not written")  # noqa: B023
        page.keyboard.press("Control+z")
        page.keyboard.press("Control+z")
        until(page, lambda: "M_S = 3 * M(phi)" in file.read_text("utf-8"), "both are taken back")
        editor.expect_last_moment("1260")


def test_a_check_written_as_a_line_is_seen_and_counted_at_once(editor):
    """It was neither, and nothing said so: the verdict stayed at 2 of 2 checks; nor could it, or a table, be edited."""
    page, file = editor.page, Path(editor.page.locator("marimo-filename").text_content())
    before, area = file.read_bytes(), page.locator(".ms-box textarea")
    page.locator("#line-sigma > span").last.click()
    expect(area).to_have_value("sigma = M_n / g.W  # [MPa] stress")
    page.keyboard.press("Control+Enter")
    area.fill('light = check("force on the lever", g.F, 2e3, "N")')
    page.locator(".ms-box").get_by_text("force on the lever").wait_for()
    area.press("Control+Enter")
    editor.expect("3 of 3 checks pass")
    shown = page.locator(".marimo-cell [data-line=light]")
    expect(shown).to_contain_text("force on the lever")
    expect(area).to_have_value("")  # a new line below, which there was none of behind what is no formula
    area.press("Escape")
    shown.click()
    expect(area).to_have_value('light = check("force on the lever", g.F, 2e3, "N")')
    area.press("Escape")
    table = page.get_by_role("group", name="Table 1 – Moment of the lever")
    for key in ("F2", "Enter"):
        table.press(key)
        expect(area).to_have_value('table_1 = table("1", "Moment of the lever", phi, M_S)')
        area.press("Escape")
        expect(table).to_be_focused()
    count = page.locator(".marimo-cell").count()
    table.press("b")  # a new cell below, to marimo
    page.get_by_role("figure", name="Figure 1 – Moment of the lever").locator(".ms-caption").click()
    expect(area).to_have_value(re.compile("^figure_1 = figure"))
    area.fill(f"figure_1 = 1  # {'a long line ' * 30}")
    assert area.evaluate("text => text.scrollHeight <= text.clientHeight"), "all of it is seen"
    area.press("Escape")
    assert page.locator(".marimo-cell").count() == count
    page.keyboard.press("Control+z")
    editor.expect("2 of 2 checks pass")
    assert file.read_bytes() == before


def test_a_field_says_what_it_is_and_its_line_is_edited_by_keys(editor):
    """A screen reader said a number alone, and a line was opened by the pointer alone."""
    field = editor.page.get_by_role("textbox", name="Mmax, N·m, greatest moment> 0")
    field.press("F2")
    area = editor.page.locator(".ms-box textarea")
    expect(area).to_have_value("M_max: float = 300.0  # [N*m] greatest moment; > 0")
    area.press("Escape")
    expect(field).to_be_focused()
    unit = editor.page.locator("#line-M_S ms-unit")
    unit.press("F2")
    expect(area).to_have_value("M_S = M(phi)  # [N*m] moment over the positions")
    area.press("Escape")
    expect(unit).to_be_focused()


def test_two_clicks_on_a_heading_edit_its_text(editor):
    """Its code stayed out of sight, with the button too, and its section was closed."""
    page = editor.page
    page.get_by_label("code of all cells").uncheck()
    heading = page.get_by_role("heading", name="3 Results")
    code = page.locator(".marimo-cell", has=heading).locator(".cm-content").first
    heading.dblclick()
    expect(code).to_be_focused()
    assert code.evaluate("text => text.closest('.cm').offsetHeight") > 10
    expect(heading).to_have_attribute("aria-expanded", "true")
    editor.edit("## 3 Results", "## 3 Outcome")
    anew = page.get_by_role("heading", name="3 Outcome")
    expect(anew, "a keyboard closes what is drawn anew too").to_have_attribute("aria-expanded", "true")
    expect(anew).to_have_attribute("tabindex", "0")
    page.locator(".ms-title b").first.click()
    expect(page.locator(".cm-content:visible")).to_have_count(0)
    page.get_by_label("code of all cells").check()


def test_a_second_tab_shows_what_the_first_computes_with(editor, browser):
    """Its fields kept what they had first, and what was typed there was computed beside the fields of the first."""
    name = "Mmax, N·m, greatest moment> 0"
    first = editor.page.get_by_role("textbox", name=name)
    with new_page(browser) as second:
        second.goto(editor.page.url)
        second.get_by_text("You are currently connected as a reader").wait_for()
        field = second.get_by_role("textbox", name=name)
        for text in ("310", "320"):
            editor.page.bring_to_front()
            first.fill(text)
            first.press("Enter")
            expect(field).to_have_value(text)
        second.bring_to_front()
        field.fill("330")
        field.press("Enter")
        expect(field).to_have_value("320")
    editor.page.bring_to_front()
    editor.expect(f"{degrees(asin(320 / 420)):.3f}°")
    first.fill("300")
    first.press("Enter")
    editor.expect(f"{degrees(asin(300 / 420)):.3f}°")


def test_mistakes_are_told_at_their_place_and_the_rest_stays(editor):
    page = editor.page

    def told(cell, *texts):
        for text in texts:
            cell.get_by_text(text).first.wait_for()
        expect(page.get_by_role("heading", name="3 Results")).to_have_count(1)
        expect(page.locator(".ms-inputs td[data-input]")).to_have_count(7)

    told(editor.edit("# [N*m] moment\n", "# [Nm] moment\n"), "unit [Nm] is not known; nearest: N*m")
    expect(page.get_by_text("TRACEBACK")).to_have_count(0)
    editor.expect("2 of 2 checks pass")
    told(editor.edit("# [Nm] moment\n", "# [N*m] moment\n"))
    editor.expect("2 of 2 checks pass")
    told(editor.edit("g.L * sin", "g.Ll * sin"), "'Given' object has no attribute 'Ll'")
    told(editor.edit("g.Ll * sin(phi)", "g.L * sin(phii)"), "name 'phii' is not defined")
    editor.expect("An ancestor raised an exception (NameError)")
    told(editor.edit("sin(phii)", "sin(phi"), "'(' was never closed")
    told(editor.edit("sin(phi", "sin(phi)"))
    editor.expect("2 of 2 checks pass")
    field = page.locator(".ms-inputs tr:has-text('greatest moment') input")
    field.fill("500")
    field.press("Enter")
    editor.expect("moment reaches 0..420 N·m by 97 samples, 500 N·m is outside")
    page.wait_for_function("() => !document.querySelector('.ms-table')")
    page.get_by_text("moment over the positions").first.wait_for()
    field.fill("abc")
    field.press("Enter")
    editor.expect("'abc' N·m is no number")
    expect(page.locator(".ms-told")).to_be_visible()
    field.fill("300")
    field.press("Enter")
    editor.expect("2 of 2 checks pass")
    expect(page.locator(".ms-told")).to_be_hidden()
    editor.expect_last_moment("420")


def test_lines_of_a_cell_that_failed_stay_and_are_edited(editor):
    """All of them went from the page with the one that failed, and those of every cell that needs it: none was left."""
    page, file = editor.page, Path(editor.page.locator("marimo-filename").text_content())
    before, area = file.read_bytes(), page.locator(".ms-box textarea")
    page.locator("#line-M_S > span").last.click()
    expect(area).to_have_value("M_S = M(phi)  # [N*m] moment over the positions")
    area.fill("M_S = M(phii)  # [N*m] moment over the positions")
    page.locator(".ms-box").get_by_text("phii is not defined").wait_for()
    area.press("Enter")
    page.locator(".ms-box").get_by_text("Enter once more").wait_for()
    area.press("Enter")
    expect(page.locator(".ms-waits #line-M_S")).to_be_visible()
    expect(page.locator("#line-phi .ms-value")).to_contain_text("90°")
    expect(page.locator(".ms-waits .ms-value")).to_have_count(0)
    field = page.get_by_role("textbox", name="L, m, length of the lever> 0")
    for text in ("0.4", "0.35"):
        field.fill(text)
        field.press("Enter")
        drawn(page)
        expect(page.locator("#line-phi")).to_have_count(1)
    page.locator(".ms-waits [data-line=table_1]").click()
    expect(area).to_have_value('table_1 = table("1", "Moment of the lever", phi, M_S)')
    area.press("Escape")
    page.locator("#line-M_S > span").last.click()
    expect(area).to_have_value("M_S = M(phii)  # [N*m] moment over the positions")
    area.press("Escape")
    page.keyboard.press("Control+z")
    expect(page.locator(".ms-written")).to_have_text("M_S is as it was")
    editor.expect_last_moment("420")
    editor.expect("2 of 2 checks pass")
    expect(page.locator(".ms-waits")).to_have_count(0)
    assert file.read_bytes() == before


def test_a_mistake_at_the_top_names_its_section(editor):
    """It was line 1, and every cell has one."""
    told = (
        "() => getComputedStyle(document.querySelector('.ms-told'), '::after').content.includes('2.2 Load cases, line')"
    )
    editor.edit("n = 2 if", "n = 2 ^ 1 if")
    editor.page.wait_for_function(told)
    editor.edit("n = 2 ^ 1 if", "n = 2 if")
    editor.expect("2 of 2 checks pass")
    editor.edit("M_S = M(phi)  # [N*m]", "M_S = M(phi)  # [m]")
    editor.page.locator(".ms-title div", has_text="2 Moment, line 6, M_S: unit").first.wait_for()


def test_mistakes_are_told_in_words_at_the_top_and_at_their_line(editor):
    page = editor.page

    def tells(cell, text):
        page.locator(".ms-title a", has_text=text).wait_for()
        place = cell.locator("[data-cell-role=output]")
        shown = "place => getComputedStyle(place, '::after').content"
        until(page, lambda: text in place.evaluate(shown), "it is not told at its line")
        expect(page.locator(".ms-title a", has_text=text)).to_have_attribute("href", f"#{cell.get_attribute('id')}")

    switch = page.locator(".ms-switch")
    switch.check()
    tells(
        editor.edit("M_S = M(phi)  # [N*m]", "M_S = M(phi)  # [m]"),
        "line 6, M_S: unit [m] does not fit; the value is in N·m",
    )
    editor.expect_last_moment("420.000")  # the sheet stays computed
    expect(switch).to_be_checked()
    cell = editor.edit("M_S = M(phi)  # [m]", "M_S = M(phi)  # [N*m]")
    page.wait_for_function("() => !document.querySelector('.ms-title a')")
    tells(
        editor.edit("g.L * sin(phi)", "g.L * sinn(phi)"),
        "g.F * g.L * sinn(phi): the name sinn is not defined in any cell (did you mean sin?)",
    )
    page.mouse.move(0, 0)
    trace = cell.locator(".codehilite")
    expect(trace).to_have_count(1)
    expect(trace).to_be_hidden()
    cell.get_by_role("button", name="Collapse traceback").hover()
    trace.wait_for()
    tells(
        editor.edit("sinn(phi)", "sin(phi, 1, 2, 3)"),
        "line 4, return g.F * g.L * sin(phi, 1, 2, 3): sin is called with 4 values, and takes from 1 to 2",
    )
    tells(
        editor.edit("sin(phi, 1, 2, 3)", "2sin(phi)"),
        "line 4, return g.F * g.L * 2sin(phi): invalid decimal literal (is a * missing? 2 * sin)",
    )
    editor.edit("2sin(phi)", "sin(phi) * (2^3)")
    editor.expect("line 4, 2 ^ 3: a power is written **, not ^")
    tells(editor.edit("sin(phi) * (2^3)", "sin(phi"), "line 4, return g.F * g.L * sin(phi: '(' was never closed")
    page.locator(".ms-title a", has_text="the cell that defines M, phi, M_S has a mistake or was deleted").wait_for()
    editor.edit("sin(phi", "sin(phi)")
    editor.expect("2 of 2 checks pass")
    page.wait_for_function("() => !document.querySelector('.ms-title a')")
    editor.expect_last_moment("420")
    editor.edit("M_S = M(phi)  # [N*m] moment over", "M_S = M(phi)  # moment over")
    editor.expect("column M_S: no line declares M_S with its unit")
    switch.uncheck()


class Cells:
    """Cells that have run one after the other, as the editor's kernel holds them."""

    def __init__(self, *codes: str):
        self.names = {}
        self.cells = [self.cell(f"c{i}", code) for i, code in enumerate(codes)]

    def cell(self, cell_id: str, code: str) -> SimpleNamespace:
        linecache.cache[cell_id] = len(code), None, code.splitlines(keepends=True), cell_id
        body, exception, nodes = compile(code, cell_id, "exec"), None, list(ast.walk(ast.parse(code)))
        try:
            exec(body, self.names)
        except Exception as error:
            exception = error
        top = ast.parse(code).body
        defs = {
            n.id
            for node in top
            if isinstance(node, ast.Assign)
            for n in ast.walk(node.targets[0])
            if isinstance(n, ast.Name)
        }
        defs |= {node.name for node in top if isinstance(node, ast.FunctionDef | ast.ClassDef)}
        defs |= {alias.name for node in top if isinstance(node, ast.ImportFrom) for alias in node.names}
        refs = {n.id for n in nodes if isinstance(n, ast.Name) and isinstance(n.ctx, ast.Load)} - defs
        status = "exception" if exception else "success"
        return SimpleNamespace(
            cell_id=cell_id,
            code=code,
            filename=cell_id,
            defs=defs,
            refs=refs,
            status=status,
            exception=exception,
            busy=False,
        )

    def texts(self, notes) -> list[str]:
        return [f"{note.cell}: {note.text}" for note in notes]


IMPORTS = """
from mechsheet import typeset
from mechsheet import inputs
from numpy import pi
"""
GIVEN = """
@inputs
class Bar:
    F: float = 500.0  # [N] force
    L: float = 2.0  # [m] length
    D: float = 0.03  # [m] diameter
    "end"
"""


def bar(*codes: str) -> Cells:
    return Cells(IMPORTS, GIVEN, "g = Bar()", *codes)


@pytest.mark.parametrize(
    ("line", "says"),
    [
        ("A = pi * g.D**2 / 4  # [mm**2] area", []),
        ("A = pi * g.D**2 / 4  # [m] area", ["c3: line 1, A: unit [m] does not fit; the value is in m²"]),
        ("A = g.F / 3  # [-] force", ["c3: line 1, A: unit [-] does not fit; the value is in N"]),
        ("A = g.L / g.D  # [m] slenderness", ["c3: line 1, A: unit [m] does not fit; the value is in - (a number)"]),
        (
            "A = g.L + g.F  # [m] nonsense",
            ["c3: line 1, g.L + g.F: adds m and N"],
        ),
        ("A = g.L + g.F  # [m] as printed (erratum)", []),
    ],
)
def test_unit_that_does_not_fit_is_told_with_the_one_that_does(line, says):
    found = bar(f"{line}\ntypeset()", "B = 2 * A  # [m**2] twice\nC = A * g.L  # [m**2] another\ntypeset()")
    notes = found.texts(told_by.unfit(found.cells[:4], found.names))
    assert len(notes) == len(says)
    assert all(note.startswith(text) for note, text in zip(notes, says, strict=True))


OF_UNITS = "from mechsheet.units import MPa, mm\n"


@pytest.mark.parametrize(
    ("cells", "told"),
    [
        ((OF_UNITS + "S = 640 * MPa",), []),
        ((OF_UNITS, "S = 640 * MPa"), []),
        ((OF_UNITS, "S = 640 * MPa  # [MPa] strength\ntypeset()"), []),
        (("S = 640e6  # [MPa] strength\ntypeset()",), []),
        (("import math\nS = 640e6  # [MPa] strength\ntypeset()",), []),
        ((OF_UNITS + "S = 640 * mm",), ["N: unit [N] does not fit; the value is in m³"]),
        ((OF_UNITS, "S = 640 * mm  # [MPa] strength\ntypeset()"), ["S: unit [MPa] does not fit; the value is in m"]),
    ],
)
def test_units_of_a_cell_without_inputs_are_followed(cells, told):
    found = bar(*cells, "N = S * g.D**2  # [N] force\ntypeset()")
    notes = found.texts(told_by.unfit(found.cells, found.names))
    assert [note.partition(", ")[2].partition("; 640")[0] for note in notes] == told


@pytest.mark.parametrize(
    ("unit", "told"),
    [
        ("m/s**2", []),
        ("mm", ["g: unit [mm] does not fit; the value is in m/s²; 9.81 has no unit, and would fit with s²"]),
    ],
)
def test_units_of_a_worksheet_without_inputs_are_checked(unit, told):
    """There g is a name like any other."""
    lines = f"g = 9.81 * m / s**2  # [{unit}] gravity\nv = 2 * s * g  # [m/s] speed\ntypeset()"
    found = Cells(IMPORTS, "from mechsheet.units import m, s", lines)
    notes = found.texts(told_by.unfit(found.cells, found.names))
    assert [note.partition(", ")[2] for note in notes] == told


def test_a_unit_that_is_not_known_is_told_once_as_one_types():
    line = "A = 2 * g.L  # [m] twice"
    found = bar(f"{line}\ntypeset()")
    cells = [notebook.Cell(**vars(cell)) for cell in found.cells]
    shown = in_place._computed(cells, "A", line, "A = 2 * g.L  # [mn] twice", False, found.names)
    assert shown.count("unit [mn] is not known; nearest: ") == 1


def test_units_are_not_checked_while_the_inputs_are_not_there():
    found = Cells(IMPORTS, GIVEN, "g = Bar(L=1 / 0)", "A = 2 * g.L  # [N] twice\ntypeset()")
    assert list(told_by.unfit(found.cells, found.names)) == []


def test_lines_that_follow_from_a_wrong_one_are_not_told():
    found = bar("A = g.D**2 + g.L  # [m**2] area\ntypeset()", "p = g.F / A  # [Pa] pressure\ntypeset()")
    assert [note.cell for note in told_by.unfit(found.cells, found.names)] == ["c3"]


def test_what_another_worksheet_computes_is_left_out():
    through = "from mechsheet import evaluate\n"
    found = bar(through, "x = g.L if evaluate else 0\nA = 0.5 + x  # [m] from there\ntypeset()")
    assert list(told_by.unfit(found.cells, found.names)) == []


def test_mistakes_in_names_and_of_python_are_put_in_words():
    found = bar("S_1 = 2 * g.LL + g.LL", "S_2 = S3 * 2  # twice", "S_3 = 1 / 0", "S_3 = M", "len(S_3)")
    assert found.texts(told_by.unknown(found.cells, found.names, {"M": "c2", "S3": "c4"})) == [
        "c3: line 1, S_1 = 2 * g.LL + g.LL: there is no input LL (did you mean L?)",
        "c4: line 1, S_2 = S3 * 2: the name S3 is not defined in any cell (did you mean S_3?)",
        "c5: S_3 is defined in two cells: rename it in one of them; a name such as _S_3 stays in its cell",
        "c6: S_3 is defined in two cells: rename it in one of them; a name such as _S_3 stays in its cell",
        "c6: line 1, S_3 = M: the cell that defines M has a mistake or was deleted",
    ]
    assert "c5: line 1, S_3 = 1 / 0: division by zero" in found.texts(told_by.failed(found.cells))
    two = bar("a = 1; k = 2", "k = 1; a = 2")
    both = "a, k are defined in two cells: rename them in one of them; a name such as _a stays in its cell"
    assert found.texts(told_by.unknown(two.cells, two.names)) == [f"c3: {both}", f"c4: {both}"]
    unit = bar("S_1 = 2 * mm", "S_2 = 2 * W")
    assert found.texts(told_by.unknown(unit.cells, unit.names)) == [
        "c3: line 1, S_1 = 2 * mm: the name mm is not defined in any cell "
        "(add from mechsheet.units import mm to the setup, the first cell)",
        "c4: line 1, S_2 = 2 * W: the name W is not defined in any cell",
    ]
    right = bar("S_1 = 2 * g.L")
    assert [*told_by.unknown(right.cells, right.names), *told_by.failed(right.cells)] == []


def test_cells_that_need_each_other_are_told_once_where_they_can_be_parted():
    found = bar("a = b", "b = a", "c = b")
    notes = found.texts(told_by.unknown(found.cells, {**found.names, "a": 1, "b": 1}))
    assert notes == ["c3: line 1, a = b: a and b need each other: neither can be computed first"]
    found = bar("a = 2 * d", "d = 1\nb = a", "e = d")
    notes = found.texts(told_by.unknown(found.cells, {**found.names, "a": 1}))
    assert notes == ["c4: line 2, b = a: a needs d of the same cell: what needs a needs a cell of its own"]


def test_a_name_that_its_own_cell_gives_too_late_is_told():
    found = bar("a = 2 * a", "b = c\nc = 1")
    assert found.texts(told_by.failed(found.cells, {"a", "b", "c"})) == [
        "c3: line 1, a = 2 * a: a is computed from itself",
        "c4: line 1, b = c: c is defined below its use: move its line up",
    ]


def test_what_waits_for_a_deleted_cell_is_told_in_one_line():
    found = bar("a = M", "b = M * A", "c = A\nd = M", "e = 1 / 0", *(f"f{n} = A" for n in range(5)))
    notes = list(told_by.unknown(found.cells, found.names, {"M": "c2", "A": "c2"}))
    assert found.texts(notes) == [
        "c3: line 1, a = M: the cell that defines M, A has a mistake or was deleted; 8 other lines wait for it too: "
        "b = M * A; c = A; d = M; f0 = A; f1 = A and 3 more"
    ]
    assert [n.cell for n in told_by.failed(found.cells, {"M", "A"})] == ["c6"], "no second line for one cause"


@pytest.mark.filterwarnings("ignore::RuntimeWarning")
def test_a_line_without_a_number_is_noted_and_what_rests_on_it_is_not():
    code = "A = np.sqrt(g.D - g.L)  # [m] root\nB = 2 * A  # [m] twice\ntypeset()"
    found = bar("import numpy as np", code, "C = np.log([1.0, -g.L, g.L])  # [-] log\nD = (1, 2\n)", "d, e = 2  # [m]")
    notes = list(told_by.lost(found.cells, found.names))
    assert found.texts(notes) == [
        "c4: line 1, A = np.sqrt(g.D - g.L): no number",
        "c5: line 1, C = np.log([1.0, -g.L, g.L]): no number at 1 of 3 places: 2",
    ]
    assert not any(note.mistake for note in notes)


def test_what_would_be_left_out_without_a_word_is_told():
    code = "A = 2 * g.D\nn = 3\nshown = [n]\nB = A * g.L  # [m**2] area\n"
    code += "import numpy as np\norder = np.argsort([1.0, 0.5])\n"
    code += "E = np.array([1.0, 2.0])[order]  # [-] places are no quantity\ntypeset()"
    found = bar(code, "C = 2 * B  # [m**2] twice", "k = 3  # [-]\nD = k * B  # [m**2] thrice\ntypeset()")
    assert found.texts(told_by.unsaid(found.cells, found.names)) == [
        "c3: line 1, A = 2 * g.D: A stands in formulas and is not shown: end its line in # [unit] meaning",
        "c4: line 1, C = 2 * B: C is not shown: end the cell in typeset()",
    ]


def test_a_check_that_no_cell_shows_is_told():
    """It counted nowhere on the page, and no note said so."""
    own = "from mechsheet import check, table, find, Drawing\n"
    own += "c = check('own', g.D, 1.0)\nd = [check('two', g.D, 1.0)]\nt = table('1', 'T', g.D)\n"
    own += "x_found = find(lambda x: x**2 - g.D, 0, 1)\ns = check('shown', g.D, 1.0)\nw = Drawing()\nn = []\nk = (1, 2)"
    found = bar(own, "s")
    assert found.texts(told_by.unsaid(found.cells, found.names)) == [
        "c3: line 2, c = check('own', g.D, 1.0): c is not shown: give it to typeset() and to summary()",
        "c3: line 3, d = [check('two', g.D, 1.0)]: d is not shown: give it to typeset() and to summary()",
        "c3: line 5, x_found = find(lambda x: x**2 - g.D, 0, 1): x_found is not shown: give it to typeset()",
    ]


def test_a_check_that_is_shown_and_not_counted_is_told():
    """The verdict was that all checks pass, where a run said that this one fails."""
    own = "from mechsheet import check, summary\na = check('a', g.D, 1.0)\nb = (check('b', g.D, 1.0), a)\n"
    own += "c = check('c', g.D, 0.1)\nd = [*b]"
    found = bar(own, "typeset(a, c)", "typeset(check('e', g.D, 0.1), b)", "summary(*d)")
    assert found.texts(told_by.unsaid(found.cells, found.names)) == [
        "c3: line 4, c = check('c', g.D, 0.1): c is not counted in the verdict: give it to summary()",
        "c5: line 1, typeset(check('e', g.D, 0.1), b): a check has no name and is not counted in the verdict: "
        "bind it to one, and give that to summary()",
    ]
    found = bar(own, "typeset(a, b, c, d)")
    assert not found.texts(told_by.unsaid(found.cells, found.names))


@pytest.mark.parametrize("path", sorted(ROOT.glob("worksheets/**/*.py")), ids=lambda path: path.stem)
def test_of_no_worksheet_is_a_check_told_that_none_shows(path):
    cells, made, found = source._in_file(str(path), 0), {}, find(lambda x: x, -1, 1)
    for statement in (statement for cell in cells for statement in cell.body):
        with suppress(SyntaxError):
            shown = {
                name: Check("any", 1.0, 2.0) if each.is_check else found
                for name, each in given(ast.unparse(statement)).items()
            }
            made |= {name: value for name, value in shown.items() if value is not found or "_found" in name}
    assert not [*unseen(cells, made)]


def test_a_unit_without_brackets_is_told_and_no_other_comment():
    bare = "s = 2 * g.D  # mm diameter\nf = s  # m/s speed\nt = 2 * s  # [m] twice"
    other = "a = 3.0  # m is the module\nb = 4.0  # s. above\nc = 2.0  # a note\nd = 2.0  # in mm\ne = 2.0  # deg of it"
    more = "name = 'x'  # mm name\nk = g.D / g.L  # D/L ratio\nh = 2.0  # mm\np = 2.0  # bar length\n_q = 1  # mm own"
    found = bar(f"{bare}\ntypeset()", f"{other}\n{more}", "def A(x):\n    return x**2  # mm**2 area")
    assert found.texts(told_by.unsaid(found.cells, found.names)) == [
        "c3: line 1, s = 2 * g.D: # mm diameter has no brackets: # [mm] diameter",
        "c3: line 2, f = s: # m/s speed has no brackets: # [m/s] speed",
        "c5: line 1, def A(x): # mm**2 area has no brackets: # [mm**2] area",
    ]


def test_lines_below_the_last_typeset_and_units_that_do_not_match_their_names_are_told():
    below = "A = 2 * g.D  # [m] twice\ntypeset()\nB = A\n\ndef C(A):\n    return 2 * A * B  # [m**2] other"
    found = bar(below, "D, E = 1, 2  # [m] one\nF = D  # [m] one", "typeset()\n'text'")
    assert found.texts(told_by.unsaid(found.cells, found.names)) == [
        "c4: c4, line 1: 2 names need 2 units, such as # [m] one, [s] other; got 1",
        "c3: line 5, def C(A): C is not shown: end the cell in typeset()",
        "c3: line 3, B = A: B stands in formulas and is not shown: end its line in # [unit] meaning",
    ]


def test_a_unit_that_declares_nothing_and_what_only_a_last_line_would_show_are_told():
    inside = "def A(x):\n    y = 2 * x  # [m] twice\n    return y\ntypeset()"
    looped = "for k in range(3):\n    B = k * L  # [m] last\nC = (  # [m] sum\n    B + L\n)\ntypeset()"
    bare = "D = 2 * L  # [m] twice\ntable_1 = table('1', 'Own', D)\ntable_1\ntypeset()"
    called = "check('own', 1.0, 2.0)\ntypeset()"
    shown = "'a text alone'\nE = 1  # [m] one\ntypeset()\ntable_1"
    title = "title_block('Own')\nmo.md('text')\nsummary(check_1)\nform"
    cells = source.of_texts(tuple((text, "") for text in (inside, looped, bare, called, shown, title)))
    nothing = "this [unit] is read by nobody: it is read behind NAME = FORMULA, in a line of its own, not in a block"
    own = "is not shown: a cell shows its last line, so"
    given = f"{own} give it to typeset()"
    assert [tuple(told) for told in left_out(cells, {})] == [
        (0, 2, nothing),
        (1, 2, nothing),
        (1, 3, nothing),
        (2, 3, f"table_1 {given}"),
        (3, 1, f"check own {given}"),
        (5, 1, f"title_block() {own} give it a cell of its own"),
        (5, 2, f"mo.md() {own} give it a cell of its own, or write the text alone, without mo.md"),
        (5, 3, f"summary() {own} give it to typeset()"),
    ]


def test_a_class_that_looks_as_one_of_inputs_but_is_none_is_told():
    """The worksheet had no inputs then, and nothing said why."""
    meant = "class Given:\n    # 1.1 Lever\n    F: float = 2.0  # [N] force; > 0\n    n: int = 3  # [-] number"
    others = ("@dataclass\nclass P:\n    x: float = 1.0  # [m] place", "class Q:\n    x: float = 1.0  # place")
    cells = source.of_texts(tuple((text, "") for text in (meant, *others, "class R:\n    pass")))
    told = "Given is no class of inputs: write @inputs in the line above it"
    assert [tuple(each) for each in left_out(cells, {})] == [(0, 1, told)]


def test_what_stands_beside_the_inputs_is_told():
    """The page follows it, and neither a sweep nor the workbook would."""
    found = Cells(IMPORTS, GIVEN, "g = Bar()\nk = 3 * g.L", "A = k * g.L  # [m**2] area\ntypeset()")
    own = "c2: line 1, g = Bar(): g, the inputs, needs a cell of its own: move k to another one"
    assert own in found.texts(told_by.unsaid(found.cells, found.names))


def test_a_name_of_a_formula_s_own_is_no_number_of_a_cell():
    code = "f = lambda rate: 2 * rate  # [-] twice\ntypeset()"
    found = bar(code, "rate = 3.0")
    assert list(told_by.unsaid(found.cells, found.names)) == []


def test_line_that_has_lost_its_unit_does_not_keep_the_former_one():
    found = bar("A = pi * g.D**2 / 4  # [mm**2] area\ntypeset()")
    right = [(cell.code, cell.filename) for cell in found.cells]
    assert "A" in registry(found.names, of_texts(tuple(right)))
    assert "A" not in registry(found.names, of_texts((*right[:3], ("A = pi * g.D**2 / 4  # area\ntypeset()", "c3"))))


def test_a_marimo_that_keeps_its_cells_otherwise_is_told_of_in_one_line(monkeypatch):
    from marimo._runtime import context

    known = SimpleNamespace(graph=SimpleNamespace(cells={"c": SimpleNamespace(cell_id="c")}, lock=nullcontext()))
    for lacking, what in ((known, "globals"), (SimpleNamespace(**vars(known), globals={}), "runtime_state")):
        monkeypatch.setattr(context, "get_context", lambda lacking=lacking: lacking)
        (note,) = told_by.watch(lambda notes: None)
        assert note.text.startswith(f"mistakes are not named here: marimo {marimo.__version__} tells nothing of its")
        assert what in note.text
    monkeypatch.delattr(context, "get_context")
    assert "cannot import name 'get_context'" in told_by.watch(lambda notes: None)[0].text


def test_a_line_that_is_drawn_anew_under_the_pointer_is_clicked(editor):
    page = editor.page
    editor.expect_last_moment("420")
    at = page.locator("#line-M_n > span").last
    at.scroll_into_view_if_needed()
    at.hover()
    page.mouse.down()
    page.evaluate("() => { const line = document.getElementById('line-M_n'); line.replaceWith(line.cloneNode(true)); }")
    page.mouse.up()
    expect(page.locator(".ms-box textarea")).to_have_value(re.compile("^M_n = "))
    page.keyboard.press("Escape")


def test_a_unit_that_moves_away_under_the_pointer_opens_no_line(editor):
    """The browser tells of a click on what holds both it and what came there, which is the line."""
    page = editor.page
    editor.expect_last_moment("420")
    unit = page.locator(".ms-table:has-text('Table 1 ') th ms-unit >> visible=true").first
    in_sight(unit)
    unit.hover()
    page.evaluate(
        """() => addEventListener('mousedown', ({ target }) => {
            addEventListener('click', ({ target }) => (window.clicked = target.tagName), { once: true });
            target.closest('table').style.marginTop = '40px';
        }, { once: true })"""
    )
    page.mouse.down()
    drawn(page)
    page.mouse.up()
    assert page.evaluate("window.clicked") not in (None, "MS-UNIT")
    assert page.locator(".ms-edited").count() == 0
    page.locator(".ms-table table >> visible=true").first.evaluate("table => (table.style.marginTop = '')")


def test_a_line_that_is_clicked_while_the_page_is_computed_anew_opens_then(editor):
    page = editor.page
    editor.expect_last_moment("420")
    asked = """async (formula) => {
        formula.click();
        await new Promise((done) => setTimeout(done));
        document.querySelector("ms-in-place").setAttribute("answer", "{}");
        return document.querySelector(".ms-box textarea")?.value ?? "";
    }"""
    assert page.locator("#line-M_n > span").last.evaluate(asked) == "", "answered before the page was computed anew"
    expect(page.locator(".ms-box textarea")).to_have_value(re.compile("^M_n = "))
    page.locator(".ms-box textarea").press("Escape")


def test_what_stands_in_the_box_is_of_the_inputs_there_are(editor):
    page, field = editor.page, editor.page.locator(".ms-inputs tr:has-text('force on the lever') input")
    shown = page.locator(".ms-box .ms-typed tbody tr").last.locator("td").last
    page.locator(".ms-table:has-text('Table 1 ') .ms-caption").first.click()
    expect(shown).to_have_text("420")
    field.fill("2400")
    field.press("Enter")
    expect(shown).to_have_text("840")
    field.fill("12o0")
    field.press("Enter")
    expect(page.locator(".ms-box .ms-typed.ms-former")).to_have_count(1)
    field.fill("1200")
    field.press("Enter")
    expect(shown).to_have_text("420")
    expect(page.locator(".ms-box .ms-typed.ms-former")).to_have_count(0)
    page.locator(".ms-box textarea").press("Escape")


def test_a_mistake_that_is_mended_does_not_stay_beside_the_next_one(editor):
    page, box = editor.page, editor.page.locator(".ms-box")
    click_until(page, box.locator("textarea"))
    box.locator("textarea").fill("M_n = g.F / 0  # [N] force")
    box.get_by_text("division by zero").wait_for()
    box.locator("textarea").fill("M_n = g.F^2  # [N**2] square")
    box.get_by_text("a power is written **").wait_for()
    expect(box).not_to_contain_text("division by zero")
    box.locator("textarea").press("Escape")


def test_a_line_that_loses_its_unit_is_asked_about(editor):
    """It went from the page, and the tables with it, which only Ctrl+Z or the code brought back."""
    page, file = editor.page, Path(editor.page.locator("marimo-filename").text_content())
    before, box = file.read_bytes(), page.locator(".ms-box")
    click_until(page, box.locator("textarea"))
    box.locator("textarea").fill("M_n = 2 * g.parts * g.F * g.L / n")
    box.locator("textarea").press("Enter")
    box.get_by_text("without its [unit] it is not shown, and no table takes it: Enter once more writes it").wait_for()
    assert file.read_bytes() == before
    box.locator("textarea").press("Escape")


def test_a_unit_is_switched_wherever_the_quantity_is_shown(editor):
    """By the keys alone, as in the page that is served; it stays while the inputs change."""
    page = editor.page
    table = page.locator(".ms-table:has-text('Table 1 ') table >> visible=true")
    line, row = page.locator(".ms-line", has_text="moment over the positions"), table.locator("tbody tr").last
    choose_by_keys(line)
    expect(line).to_contain_text("0, 0.1087, 0.21, ")
    expect(row.locator("td").last).to_have_text("0.420")
    assert page.evaluate("document.activeElement.textContent") == "kN·m", "the focus stays at the unit"
    choose(page, table.locator("th ms-unit").first, "rad")
    expect(row.locator("td").first).to_have_text("1.571")
    field = page.locator(".ms-inputs tr:has-text('force on the lever') input")
    field.fill("2400,5")
    field.press("Enter")
    expect(row.locator("td").last, "2400.5 N * 0.35 m").to_have_text("0.840")
    expect(line.locator("ms-value .ms-chosen")).to_contain_text("0.84")
    page.emulate_media(media="print")
    expect(row.locator("td").last).to_have_text("0.840")
    page.emulate_media(media="null")
    choose(page, table.locator("th ms-unit").last, "N·m")
    expect(line.locator(".ms-chosen")).to_have_count(0)
    expect(row.locator("td").last).to_have_text("840")
    field.fill("1200")
    field.press("Enter")
    choose(page, table.locator("th ms-unit").first, "°")
    expect(row.locator("td").first).to_have_text("90.0")
    editor.expect_last_moment("420")


def test_what_a_file_that_was_changed_elsewhere_cannot_give_is_shown_nowhere(editor):
    """Of cells that are not run nothing is shown, and of what rests on them neither: it would be of before."""
    page, file = editor.page, Path(editor.page.locator("marimo-filename").text_content())
    before = file.read_text(encoding="utf-8")
    circular = before.replace("(0, pi / 2, 7)", "(0, phi_max, 7)").replace("def moment(g)", "def moment(g, phi_max)")
    file.write_text(circular, encoding="utf-8")
    page.locator(".ms-title a", has_text="phi_max needs M of the same cell: what needs phi_max").wait_for()
    expect(page.locator(".ms-summary")).to_have_count(0)
    expect(page.locator(".ms-table")).to_have_count(0)
    file.write_text(before, encoding="utf-8")
    editor.expect("2 of 2 checks pass")
    first, last = (before.index(f"@app.cell{text}") for text in ("\ndef load_cases", "(hide_code=True)\ndef section_3"))
    file.write_text(before[:first] + before[last:], encoding="utf-8")
    page.locator(
        ".ms-title a",
        has_text=re.compile(r"the cell that defines (strong, )?M_n, sigma(, strong)? has a mistake or was deleted"),
    ).wait_for()
    expect(page.locator(".ms-summary")).to_have_count(0)
    expect(page.locator(".ms-table")).to_have_count(0)
    file.write_text(before, encoding="utf-8")
    editor.expect("2 of 2 checks pass")


def test_a_cell_that_others_need_goes_when_it_is_deleted_once_more(editor):
    page, told = editor.page, editor.page.locator(".ms-written")
    cells = page.locator(".marimo-cell")
    count, needed = cells.count(), cells.filter(has=page.locator("#line-M_S"))
    click_delete(needed)
    words = "M, M_S, phi go, needed in section 2.1, 3, table 1 and figure 1: delete once more to let it go"
    expect(told).to_have_text(words)
    expect(cells).to_have_count(count)
    page.locator(".ms-title b").first.click()  # it was not meant
    needed.click(button="right", position={"x": 300, "y": 10})
    page.get_by_role("menuitem", name="Delete", exact=True).click()
    drawn(page)
    page.wait_for_timeout(500)
    expect(cells).to_have_count(count)
    page.keyboard.press("Escape")
    page.locator(".ms-title b").first.click()
    told.evaluate("chip => (chip.textContent = '')")
    needed.evaluate("cell => cell.focus()")
    page.keyboard.press("Control+k")
    page.keyboard.type("delete")
    expect(page.get_by_role("option")).to_have_text(["Cell > Delete"])
    page.keyboard.press("Enter")
    expect(told).to_have_text(words)
    expect(cells).to_have_count(count)
    page.keyboard.press("Escape")
    page.locator(".ms-title b").first.click()
    text = cells.filter(has=page.get_by_role("heading", name="2.2 Load cases"))
    text.click(button="right")
    page.get_by_role("menuitem", name="Delete", exact=True).click()
    expect(cells).to_have_count(count - 1)  # nothing needs a text
    click_delete(needed)
    page.wait_for_timeout(1000)
    expect(cells).to_have_count(count - 1)
    click_delete(needed)
    expect(cells).to_have_count(count - 2)
    for there in (count - 1, count):
        page.get_by_test_id("undo-delete-cell").click()
        expect(cells).to_have_count(there)
    page.get_by_test_id("run-button").last.click()  # all that wait
