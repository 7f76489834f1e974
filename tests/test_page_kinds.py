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


BARE = """\
import marimo

app = marimo.App()

with app.setup:
    import marimo as mo

    from mechsheet import check, table, typeset


@app.cell
def _():
    mo.md("## 1 Beam")
    return


@app.cell
def _():
    F = 8829.0  # [N] force
    M = F * 2.5 / 4  # [N*m] moment
    typeset()
    return (M,)


@app.cell
def _(M):
    mo.vstack([check("moment", M, 1e4, "N*m"), check("again", M, 1e4, "N*m")])
    return


if __name__ == "__main__":
    app.run()
"""


@pytest.mark.parametrize(("mode", "above"), [("run", ""), ("edit", ""), ("run", 'title_block("Beam")\n    ')])
def test_a_page_without_title_block_has_style_and_scripts(serve, page, tmp_path, console_errors, mode, above):
    """They come with the first value that is shown, once: two checks in one cell bring them one time.

    A title block above the last line of its cell is none: all values had stayed out of sight.
    """
    path = tmp_path / "bare.py"
    text = BARE.replace("import check", "import check, title_block").replace('mo.md("', f'{above}mo.md("')
    path.write_text(text, encoding="utf-8")
    page.goto(serve(mode, path))
    expect(page.locator(".ms-badge.ms-PASS")).to_have_count(2)
    page.wait_for_function("customElements.get('ms-numbers') && document.querySelector('style.ms-style')")
    colour = "getComputedStyle(document.querySelector('.ms-badge.ms-PASS')).backgroundColor"
    assert page.evaluate(colour) not in ("rgba(0, 0, 0, 0)", "transparent")
    assert page.locator("ms-style").count() == 1
    assert console_errors == []


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


@pytest.fixture(scope="module")
def section(tmp_path_factory: pytest.TempPathFactory) -> Path:
    text = displayed(SECTION).replace("App()", 'App(css_file="page.css")')
    rows = 'greatest level\n\n        """Rows."""\n'  # the editor loses a comment at the end of a setup
    text = text.replace("greatest level\n", rows)
    path = tmp_path_factory.mktemp("page") / "section.py"
    path.write_text(text, encoding="utf-8")
    return path


def listed(page, table: str, numbers: list[str]) -> None:
    """The first column of a table, as soon as it has these numbers."""
    expect(page.locator(f".ms-table:has-text('Table {table} ') tbody td:first-child")).to_have_text(numbers)


def pasted(cell, text: str) -> None:
    """Cells of a spreadsheet program, pasted where the focus is."""
    cell.evaluate(
        """(cell, text) => {
          const clipboardData = new DataTransfer();
          clipboardData.setData("text/plain", text);
          cell.dispatchEvent(new ClipboardEvent("paste", { clipboardData, bubbles: true, cancelable: true }));
        }""",
        text,
    )


@pytest.mark.parametrize("mode", ["run", "edit"])
def test_lists_and_tables_are_edited_in_a_grid(serve, page, section, console_errors, mode):
    """By typing, with the keys alone, and pasted from a spreadsheet program; units and decimal commas as in a field."""
    page.goto(serve(mode, section))
    listed(page, "1", ["10.00", "−4.00", "2.50"])
    page.get_by_label("F [kN], row 2").fill("-4,5")
    page.get_by_label("F [kN], row 2").press("Enter")
    listed(page, "1", ["10.00", "−4.50", "2.50"])
    assert page.evaluate("document.activeElement.ariaLabel") == "F [kN], row 3"
    page.keyboard.press("Enter")
    page.keyboard.type("500 N")
    page.keyboard.press("Enter")
    listed(page, "1", ["10.00", "−4.50", "2.50", "0.50"])
    pasted(page.get_by_label("F [kN], row 4"), "1\t2\t3\r\n")  # a row of it is a list too
    listed(page, "1", ["10.00", "−4.50", "2.50", "1.00", "2.00", "3.00"])

    area = page.get_by_label("A [cm²], row 1")
    listed(page, "2", ["0.667", "0.333"])
    pasted(area, "1\t25\t30\r\n1\t-25\t30\r\n2\t0\t0,3 m\r\n")  # more rows than there are
    listed(page, "2", ["0.250", "0.250", "0.500"])
    area.press("Control+Delete")
    listed(page, "2", ["0.333", "0.667"])
    area.press("Control+Enter")  # in between, with the focus on it
    for key in ("3", "Tab", "1", "Tab", "40", "Enter"):
        page.keyboard.press(key) if len(key) > 2 else page.keyboard.type(key)
    listed(page, "2", ["0.167", "0.500", "0.333"])
    page.get_by_label("y [cm], row 2").hover()
    page.locator("ms-grid tr", has=page.get_by_label("y [cm], row 2")).get_by_role("button").click()
    listed(page, "2", ["0.333", "0.667"])
    expect(page.locator("ms-states")).to_contain_text("stringers = 1; -25; 30 | 2; 0; 30")  # each row to be told apart
    assert console_errors == []


def test_a_bad_cell_is_told_at_its_place_and_nothing_is_lost(serve, page, section, console_errors):
    page.goto(serve("run", section))
    listed(page, "2", ["0.667", "0.333"])
    level = page.get_by_label("y [cm], row 2")
    red = "() => getComputedStyle(document.querySelector('[data-input=\"stringers.y (2)\"]')).outlineStyle"

    def told(text: str) -> None:
        page.wait_for_function(
            """(text) => getComputedStyle(document.querySelector('td[data-input="stringers"]'), "::after")
                .content.includes(text)""",
            arg=text,
        )
        page.wait_for_function(f"{red} === 'solid'")

    for typed, text in {
        "x": "level stringers.y (2) = 'x' cm is no number",
        "31": "level stringers.y (2) = 31.0 cm must be < stringers.y_top = 30.0 cm",
        "2 kN": "level stringers.y (2) = '2 kN': kN does not measure cm",
        "": "level stringers.y (2) = '' cm is no number",
    }.items():
        level.fill(typed)
        level.press("Tab")
        told(text)
        assert [each.input_value() for each in page.locator("ms-grid").nth(1).locator("input").all()] == [
            *("1", "25", "30"),
            *("0.5", typed, "30"),
            *("", "", ""),
        ]
    level.fill("-25")
    level.press("Tab")
    listed(page, "2", ["0.667", "0.333"])
    pasted(page.get_by_label("y_top [cm], row 2"), "30\t7")  # beside the columns
    page.get_by_text("stringers (2) = '0.5; -25; 30; 7' must have the columns A, y, y_top").first.wait_for()
    assert console_errors == []


def test_the_editor_tells_what_the_setup_refuses(serve, page, tmp_path):
    """Of that cell it shows nothing but what it raises: all other cells had waited for it, without a word."""
    path = tmp_path / "section.py"
    path.write_text(displayed(SECTION), encoding="utf-8")
    page.goto(serve("edit", path))
    page.get_by_text("the editor loses one that ends the setup cell").first.wait_for()
