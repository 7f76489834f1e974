"""The hitch worksheet in a real browser."""

import time
from pathlib import Path

import pytest

HITCH = Path(__file__).parents[1] / "worksheets" / "hitch.py"
SECTIONS = ["1 Input data", "2 Geometry", "3 Kinematics", "4 Lifting capacity", "5 Forces", "6 Steering stability"]


def cell(page, table: str, row: int, column: int) -> str:
    """Text of a body cell of a table's first block."""
    return (
        page.locator(f".ms-table:has-text('Table {table} ') table")
        .first.locator(f"tbody tr:nth-child({row}) td:nth-child({column})")
        .inner_text()
    )


def ready(page) -> None:
    page.get_by_text("Table 7 ").wait_for(timeout=120_000)


@pytest.fixture(params=["run", "edit"])
def opened(request, serve, page, console_errors):
    page.goto(serve(request.param, HITCH))
    ready(page)
    return page


def test_opens_computed_with_every_section(opened, console_errors):
    for section in SECTIONS:
        assert opened.get_by_role("heading", name=section).count() == 1, section
    for number in ("2.1", "2.2", "3.1", "4.1", "5.1", "6.1", "7"):
        assert opened.locator(f".ms-table:has-text('Table {number} ')").count() == 1, number
    assert cell(opened, "4.1", 1, 2) == "129614"
    assert opened.get_by_text("FAIL").count() == 0
    for trouble in ("Traceback", "Something went wrong", "internal error"):
        assert opened.get_by_text(trouble).count() == 0, trouble
    assert opened.get_by_text("18 of 18 checks pass").count() == 1
    assert console_errors == []


def test_changed_input_changes_the_tables(serve, page, console_errors):
    page.goto(serve("run", HITCH))
    ready(page)
    field = page.locator(".ms-inputs tr:has-text('weight of the implement') input")
    field.fill("30000,5")
    field.press("Enter")
    page.locator(".ms-screen", has_text="30000.5").wait_for(timeout=30_000)
    page.wait_for_function("() => document.body.innerText.includes('141399')", timeout=30_000)
    assert cell(page, "4.1", 1, 2) == "141399", "129614 * 30000.5 / 27500"
    assert console_errors == []


def test_bad_input_is_told_at_its_place_and_the_inputs_stay(serve, page):
    page.goto(serve("run", HITCH))
    ready(page)
    field = page.locator(".ms-inputs tr:has-text('weight of the implement') input")
    field.fill("heavy")
    field.press("Enter")
    page.get_by_text("P6 = 'heavy' N is no number").first.wait_for(timeout=30_000)
    field.fill("27500")
    field.press("Enter")
    ready(page)
    assert cell(page, "4.1", 1, 2) == "129614"


def test_slider_moves_the_scheme(serve, page, console_errors):
    page.goto(serve("run", HITCH))
    ready(page)
    scheme = page.locator("div:has-text('Figure 2.1') > svg, div:has(> svg)").locator("svg[viewBox]").first
    before = scheme.inner_html()
    slider = page.get_by_role("slider").first
    slider.focus()
    for _ in range(5):
        slider.press("ArrowRight")
    deadline = time.monotonic() + 20
    while scheme.inner_html() == before:
        assert time.monotonic() < deadline, "the scheme rests"
        page.wait_for_timeout(100)
    assert console_errors == []


def test_download_is_the_workbook(serve, page, tmp_path):
    from openpyxl import load_workbook

    page.goto(serve("run", HITCH))
    ready(page)
    with page.expect_download() as download:
        page.get_by_text("Excel workbook").click()
    path = tmp_path / download.value.suggested_filename
    download.value.save_as(path)
    assert path.name == "hitch.xlsx"
    assert load_workbook(path).sheetnames[:2] == ["Inputs", "Find"]


def test_printed_page_is_a_document(serve, page, tmp_path):
    """A4 with page numbers, inputs as a table, sharp charts, and none of the controls."""
    from pypdf import PdfReader

    page.goto(serve("run", HITCH))
    ready(page)
    page.locator("svg.marks").nth(6).wait_for()
    page.pdf(path=tmp_path / "hitch.pdf", prefer_css_page_size=True, print_background=True)
    pages = PdfReader(tmp_path / "hitch.pdf").pages
    texts = [p.extract_text() for p in pages]
    assert 10 < len(pages) < 25
    assert all(abs(float(p.mediabox.width) - 595) < 2 and abs(float(p.mediabox.height) - 842) < 2 for p in pages)
    assert all(f"{i} / {len(pages)}" in text for i, text in enumerate(texts, 1))
    whole = "\n".join(texts)
    assert all(word in whole for word in [*SECTIONS, "weight of the implement", "27500", "129614", "57569"])
    assert "Excel workbook" not in whole
    assert not any(len(p.images) for p in pages), "charts are drawn, not photographed"
    headings = [text.rstrip().splitlines()[-2:] for text in texts]
    assert not any(line.startswith("Table ") for lines in headings for line in lines), "a caption torn from its table"
