"""The hitch worksheet in a real browser."""

import json
import re
from contextlib import suppress
from math import inf
from pathlib import Path

import pytest
from conftest import SIZE, alive, drawn, in_sight, new_page, report_errors, until
from playwright.sync_api import expect

HITCH = Path(__file__).parents[1] / "worksheets" / "hitch.py"
TEMPLATE = Path(__file__).parents[1] / "lib" / "mechsheet" / "run" / "new_worksheet.txt"
READY = "24 of 24 checks pass"
UNDER_THE_BUTTON = ".marimo-cell:has(marimo-download) .ms-note"
SECTIONS = ["1 Input data", "2 Geometry", "3 Kinematics", "4 Lifting capacity", "5 Forces", "6 Steering stability"]


def cell(page, table: str, row: int, column: int):
    """A body cell of a table's first block."""
    return page.locator(f".ms-table:has-text('Table {table} ') table").first.locator(
        f"tbody tr:nth-child({row}) td:nth-child({column})"
    )


def ready(page) -> None:
    for last in ("Table 7 ", READY):
        page.get_by_text(last).first.wait_for()
    alive(page)


def choose(page, unit, other: str) -> None:
    """Again where the page moved under the click, as while its formulas are still being set."""
    item = page.get_by_role("menuitemradio", name=other, exact=True)

    def offered() -> bool:
        unit.click()
        return item.is_visible()

    until(page, offered, "no unit is offered")
    item.click()


def choose_by_keys(line) -> None:
    """The next unit of a line."""
    line.locator("math").first.wait_for()
    unit = line.locator("ms-unit")
    unit.focus()
    unit.press("Enter")
    line.page.keyboard.press("ArrowDown")
    line.page.keyboard.press("Enter")


@pytest.fixture
def page(left_open):
    """The hitch in ``run`` with the document's own inputs."""
    return left_open(HITCH, READY)


@pytest.fixture(scope="module")
def edited(browser, serve):
    """The hitch in the editor, to be read."""
    errors = list[str]()
    with new_page(browser) as page:
        report_errors(page, errors)
        page.goto(serve("edit", HITCH))
        ready(page)
        yield page
        assert errors == []


@pytest.fixture(params=["page", "edited"])
def opened(request, chromium):
    """Both need the browser, which only a name among the arguments tells the marks."""
    return request.getfixturevalue(request.param)


def test_opens_computed_with_every_section(opened):
    for section in SECTIONS:
        expect(opened.get_by_role("heading", name=section)).to_have_count(1)
    for number in ("2.1", "2.2", "3.1", "4.1", "5.1", "6.1", "7"):
        expect(opened.locator(f".ms-table:has-text('Table {number} ')")).to_have_count(1)
    expect(cell(opened, "4.1", 1, 2)).to_have_text("129614")
    assert opened.get_by_text("FAIL").count() == 0
    for trouble in ("Traceback", "Something went wrong", "internal error"):
        assert opened.get_by_text(trouble).count() == 0, trouble
    assert opened.get_by_text(READY).count() == 1


def test_outputs_are_whole_and_indices_are_small(opened):
    """In the editor too; the size of an index in an exponent follows that of the exponent."""
    cut = """() => [...document.querySelectorAll(".output-area")]
        .filter((e) => e.scrollHeight > e.clientHeight + 2).length"""
    assert opened.evaluate(cut) == 0
    opened.wait_for_function("() => document.querySelector('marimo-tex').shadowRoot?.querySelector('.katex-sizing')")
    sizes = opened.evaluate("""() =>
      [...document.querySelectorAll("marimo-tex")]
        .flatMap((tex) => [...(tex.shadowRoot?.querySelectorAll(".katex-sizing") ?? [])])
        .map((e) => [e.className, ...[e, e.parentElement].map((e) => parseFloat(getComputedStyle(e).fontSize))])
    """)
    parts = {name: size / whole for name, size, whole in sizes if "reset-size" in name}
    assert len(parts) >= 1
    of_texts = {"size1": 0.5, "size3": 0.7, "size6": 1.0}  # as KaTeX sets them
    for name, part in parts.items():
        outer, inner = (each.removeprefix("reset-") for each in name.split()[1:3])
        assert part == pytest.approx(of_texts[inner] / of_texts[outer], rel=1e-3), name
    of_lines = opened.evaluate("""() => [...document.querySelectorAll(".ms-line msub")].map((symbol) => {
      const [whole, index] = [...symbol.children].map((e) => parseFloat(getComputedStyle(e).fontSize));
      return index / whole;
    })""")
    assert not of_lines or 0.6 < min(of_lines) <= max(of_lines) < 0.85, "an index is smaller, one within it no less"
    assert opened.evaluate("[...document.fonts].some((font) => /STIX/.test(font.family) && font.status == 'loaded')")


def test_changed_input_changes_the_tables(page):
    field = page.locator(".ms-inputs tr:has-text('weight of the implement') input")
    field.fill("30000,5")
    field.press("Enter")
    page.locator(".ms-screen", has_text="30000.5").wait_for()
    expect(cell(page, "4.1", 1, 2), "129614 * 30000.5 / 27500").to_have_text("141399")
    field.fill("27500")
    field.press("Enter")
    expect(cell(page, "4.1", 1, 2)).to_have_text("129614")


def test_the_verdict_stays_in_sight_and_leads_to_the_check_that_fails(page):
    bar = page.locator(".ms-bar")
    in_sight(page.locator(".ms-summary"))
    expect(bar, "the summary is in sight itself").to_be_hidden()
    field = page.locator(".ms-inputs tr:has-text('weight of the implement') input")
    in_sight(field)
    in_sight(cell(page, "4.1", 1, 2))
    expect(bar).to_contain_text("24 of 24 checks")
    expect(bar, "how near the worst comes to its limit").to_contain_text("91.8 %")
    field.fill("37500")
    field.press("Enter")
    in_sight(cell(page, "4.1", 1, 2))
    expect(bar).to_contain_text("21 of 24 checks")
    expect(bar).to_contain_text("front axle keeps its least load: 20300 > 14620 N, 139 %")
    bar.get_by_role("link").last.click()
    expect(page.locator("#check-front-axle-keeps-its-least-load")).to_be_in_viewport()
    field.fill("27500")
    field.press("Enter")
    ready(page)


def test_bad_input_is_told_at_its_place_and_the_inputs_stay(page):
    field = page.locator(".ms-inputs tr:has-text('weight of the implement') input")
    field.fill("heavy")
    field.press("Enter")
    in_sight(page.get_by_text("P6 = 'heavy' N is no number").first)
    expect(page.locator(".ms-bar"), "there are no verdicts, and the mistake is in sight").to_be_hidden()
    page.wait_for_function("""() =>  // told where the verdicts of the checks were
        getComputedStyle(document.querySelector(".ms-told"), "::after").content.includes("P6 = 'heavy' N is no number")
    """)
    field.fill("27500")
    field.press("Enter")
    ready(page)
    expect(cell(page, "4.1", 1, 2)).to_have_text("129614")


def test_no_file_is_made_of_a_page_that_is_not_computed_to_its_end(serve, browser, tmp_path):
    """Its checks would be missing: the front sheet said that all pass where nothing was computed."""
    sheet = tmp_path / "lever.py"
    sheet.write_text(TEMPLATE.read_text(encoding="utf-8"), encoding="utf-8")
    with new_page(browser) as page:
        page.goto(serve("run", sheet))
        page.get_by_text("2 of 2 checks pass").wait_for()
        alive(page)
        field = page.locator("td[data-input=F] input")
        field.fill("-1")
        field.press("Enter")
        page.locator("ms-failed").first.wait_for()
        for button, file in (("Excel workbook", "lever.xlsx"), ("Page in one file", "lever.html")):
            told = f"{file} is not written: some cells did not run: g, phi, M, M_S, phi_found and 9 more missing"

            def refused(button=button, told=told):
                page.get_by_text(button).click()  # more than once, where it moves up meanwhile
                with suppress(AssertionError):
                    expect(page.locator(UNDER_THE_BUTTON)).to_have_text(told, timeout=1000)
                    return True
                return False

            until(page, refused, f"{file} is made")


def test_escape_brings_back_what_a_field_held(page):
    """What was typed and not computed with stayed, and went to the page with the next click."""
    field = page.locator("td[data-input=P6] input")
    refused = page.locator(".ms-told")
    field.fill("abc")
    field.press("Escape")
    expect(field).to_have_value("27500")
    field.press("Tab")
    drawn(page)
    expect(refused).to_be_hidden()
    field.fill("25000")
    field.press("Enter")
    field.fill("26000")
    field.press("Escape")
    expect(field).to_have_value("25000")
    field.fill("27500")
    field.press("Enter")


def test_a_slider_says_what_it_moves(page):
    """A screen reader said a number alone."""
    names = page.get_by_role("slider", name="part of the stroke")
    until(page, lambda: names.count() == page.get_by_role("slider").count() > 0, "a slider has no name")


def test_a_slider_that_is_drawn_late_says_what_it_moves(serve, browser, tmp_path):
    """Names were given once, a second after the page came to rest: what was drawn later had none."""
    text = TEMPLATE.read_text(encoding="utf-8").replace("read, summary", "read, slider, summary")
    moved = '@app.cell\ndef moved(g):\n    slider(0, 1, label="part of F") if g.F <= 1000 else None\n    return\n\n\n'
    text = text.replace(
        "@app.cell(hide_code=True)\ndef section_2()", f"{moved}@app.cell(hide_code=True)\ndef section_2()"
    )
    assert text.count(moved) == 1
    sheet = tmp_path / "lever.py"
    sheet.write_text(text, encoding="utf-8")
    with new_page(browser) as page:
        page.goto(serve("run", sheet))
        page.locator("html[data-measured]").wait_for()
        expect(page.get_by_role("slider")).to_have_count(0)
        field = page.locator("td[data-input=F] input")
        field.fill("1000")
        field.press("Enter")
        page.get_by_role("slider", name="part of F").wait_for()


def test_slider_moves_the_scheme(page):
    scheme = page.locator("div:has-text('Figure 2.1') > svg, div:has(> svg)").locator("svg[viewBox]").first
    before = scheme.inner_html()
    at = page.evaluate("() => getComputedStyle(document.querySelector('.ms-at')).transform")
    slider = page.get_by_role("slider").first
    slider.focus()
    for _ in range(5):
        slider.press("ArrowRight")
    until(page, lambda: scheme.inner_html() != before, "the scheme rests")
    shift = 0.05 * 0.25 / 0.3 * 562  # of the mark in the charts: 0.05 of the stroke on an axis from 0.4 to 0.7 m
    page.wait_for_function(
        """([from, shift]) => {
          const x = (transform) => Number(transform.split(", ")[4]);
          return Math.abs(x(getComputedStyle(document.querySelector(".ms-at")).transform) - x(from) - shift) < 0.01;
        }""",
        arg=[at, shift],
    )
    for _ in range(5):
        slider.press("ArrowLeft")
    until(page, lambda: scheme.inner_html() == before, "the scheme is another one")


def test_switch_shows_the_numbers_in_the_formulas(page):
    assert page.locator("ms-numbers math").count() == 0, "nothing is typeset before it is asked for"
    page.locator(".ms-switch").check()
    area = page.locator(".ms-line", has_text="piston area").locator("ms-numbers math")
    expect(area).to_have_text("=π(0.08m)24")
    clear = """() => [...document.querySelectorAll(".ms-line:has(ms-numbers math)")].every((line) => {
        const [numbers, formula] = ["ms-numbers math", ".ms-formula"].map((name) => line.querySelector(name));
        return numbers.getBoundingClientRect().top >= formula.getBoundingClientRect().bottom;
      })"""
    page.wait_for_function(clear)  # the page may scroll between two of its readings
    field = page.locator(".ms-inputs tr:has-text('piston diameter') input")
    field.fill("0.09")
    field.press("Enter")
    expect(area, "the numbers follow").to_have_text("=π(0.09m)24")
    field.fill("0.08")
    field.press("Enter")
    expect(area).to_have_text("=π(0.08m)24")
    page.locator(".ms-switch").uncheck()
    expect(page.locator("ms-numbers math")).to_have_count(0)


def test_hovering_a_chart_shows_its_values(page):
    chart = page.locator(".ms-figure:has-text('Figure 4.1') svg.ms-chart").first
    chart.hover(position={"x": 640, "y": 150})
    tip = page.locator(".ms-tip")
    tip.wait_for()
    assert tip.inner_text().splitlines() == ["S = 0.670 m", "G56 = 56377 N", "GS6 = 29959 N"]
    page.mouse.move(5, 5)
    tip.wait_for(state="hidden")


def test_every_session_has_its_own_inputs(serve, browser, page):
    with new_page(browser) as other:
        other.goto(serve("run", HITCH))
        ready(other)
        weights = {page: "20000", other: "30000"}
        for each, weight in weights.items():
            field = each.locator(".ms-inputs tr:has-text('weight of the implement') input")
            field.fill(weight)
            field.press("Enter")
        for each, force in zip(weights, ("94265", "141397"), strict=True):
            expect(cell(each, "4.1", 1, 2), "129614 * weight / 27500").to_have_text(force)
    field = page.locator(".ms-inputs tr:has-text('weight of the implement') input")
    field.fill("27500")
    field.press("Enter")
    expect(cell(page, "4.1", 1, 2)).to_have_text("129614")


def test_outline_leads_to_the_sections(page):
    page.wait_for_function("() => 'measured' in document.documentElement.dataset")
    heading = page.get_by_role("heading", name="6 Steering stability")
    places = [inf]

    def rests_in_sight() -> bool:  # it scrolls smoothly, and past it where something above is drawn meanwhile
        places.append(heading.bounding_box()["y"])
        drawn(page)
        if places[-1] == places[-2] and not -1 < places[-1] < 800:
            page.mouse.move(600, 400)
            page.mouse.move(1240, 0.25 * 1600 + 30)  # the marks at the right edge open it
            page.get_by_text("6 Steering stability").last.click()
        return -1 < places[-1] < 800 and places[-1] == places[-2]

    until(page, rests_in_sight, "the section is not in sight")
    page.mouse.move(5, 5)  # off the outline


def test_a_click_on_a_heading_closes_its_section_and_what_leads_there_opens_it(page):
    """Closed it stays while the page computes; printed it is whole."""
    page.wait_for_function("() => 'measured' in document.documentElement.dataset")
    geometry, below = (page.get_by_role("heading", name=name) for name in ("2 Geometry", "2.2 Second"))
    check = page.locator("#check-loop-of-group-2-3-")
    expect(geometry).to_have_attribute("aria-expanded", "true")
    geometry.click()
    expect(geometry).to_have_attribute("aria-expanded", "false")
    expect(below).to_be_hidden()
    expect(check).to_be_hidden()
    expect(page.get_by_role("heading", name="3 Kinematics"), "the next of its level stays").to_be_visible()
    field = page.locator(".ms-inputs tr:has-text('weight of the implement') input")
    for weight, force in (("20000", "94265"), ("27500", "129614")):
        field.fill(weight)
        field.press("Enter")
        expect(cell(page, "4.1", 1, 2)).to_have_text(force)
        expect(check, "computed anew it stays closed").to_be_hidden()
    ready(page)
    page.emulate_media(media="print")
    expect(check).to_be_visible()
    page.emulate_media(media="null")  # as it was: a page is printed later on
    expect(check).to_be_hidden()
    page.locator(".ms-summary a", has_text="loop of group (2, 3)").click()
    expect(check, "its place moves while what was opened is laid out").to_be_visible()
    expect(below).to_be_visible()
    below.click()
    expect(below).to_have_attribute("aria-expanded", "false")
    expect(check, "a part of a section is closed by itself").to_be_visible()
    below.press("Enter")
    expect(below, "by the keyboard too").to_have_attribute("aria-expanded", "true")


def test_in_the_editor_a_closed_section_takes_no_room_and_the_bar_leaves_the_footer_free(edited):
    edited.wait_for_function("() => 'measured' in document.documentElement.dataset")
    geometry, kinematics = (edited.get_by_role("heading", name=name) for name in ("2 Geometry", "3 Kinematics"))
    geometry.click()
    until(edited, lambda: 0 < kinematics.bounding_box()["y"] - geometry.bounding_box()["y"] < 200, "room is left")
    geometry.click()
    kinematics.scroll_into_view_if_needed()
    drawn(edited)
    bar, footer = (edited.locator(place).bounding_box() for place in (".ms-bar", "footer"))
    assert bar["y"] + bar["height"] <= footer["y"]


def test_on_a_narrow_screen_no_number_of_a_list_is_cut_off(edited):
    edited.set_viewport_size({"width": 800, "height": 1600})
    drawn(edited)
    beyond = """() => [...document.querySelectorAll(".ms-value")]
        .filter((e) => e.getBoundingClientRect().right > e.closest(".output-area").getBoundingClientRect().right + 1)
        .map((e) => e.textContent)"""
    assert edited.evaluate(beyond) == []
    edited.set_viewport_size(SIZE)


def test_download_is_the_workbook(page, tmp_path):
    from openpyxl import load_workbook

    with page.expect_download() as download:
        page.get_by_text("Excel workbook").click()
    path = tmp_path / download.value.suggested_filename
    download.value.save_as(path)
    assert path.name == "hitch.xlsx"
    assert load_workbook(path).sheetnames[:3] == ["Front", "Inputs", "Find"]
    expect(page.locator(UNDER_THE_BUTTON)).to_have_text("")


def test_the_button_of_the_workbook_tells_what_the_workbook_does_not_follow(left_open, tmp_path):
    """Once pressed, in the words of the script; the button works again then."""
    text, line = TEMPLATE.read_text(encoding="utf-8"), "M_S = M(phi)  # "
    assert line in text
    text = text.replace("import marimo as mo\n", "import marimo as mo\n    import numpy as np\n")
    sheet = tmp_path / "tangled.py"
    sheet.write_text(text.replace(line, "M_S = np.sort_complex(M(phi)).real  # "), encoding="utf-8")
    page = left_open(sheet, "2 of 2 checks pass")
    expect(page.locator("ms-in-place, ms-folded, [data-ms-folded]")).to_have_count(0)  # of the editor alone
    told = page.locator(UNDER_THE_BUTTON)
    expect(told).to_have_text("")
    written = sheet.read_text(encoding="utf-8").splitlines()
    number = next(n for n, line in enumerate(written, 1) if "np.sort_complex" in line)
    for _ in range(2):
        with page.expect_download():
            page.get_by_text("Excel workbook").click()
        expect(told).to_have_text(f"not followed there: line {number}, M_S: numpy's sort_complex")


def test_digits_that_are_not_proved_are_grey_while_they_are_asked_for(left_open, tmp_path):
    text, line = TEMPLATE.read_text(encoding="utf-8"), "M_S = M(phi)  # "
    assert line in text
    sheet = tmp_path / "losing.py"
    losing = "M_S = (1e14 * g.M_max + M(phi)) - 1e14 * g.M_max  # "  # to 4 N m
    sheet.write_text(text.replace(line, losing), encoding="utf-8")
    page = left_open(sheet, "checks pass")
    grey = """() => [...(CSS.highlights.get('ms-unproved') ?? [])]
        .filter((r) => r.startContainer.parentElement.closest('td'))
        .map((r) => [r.startContainer.data, r.startContainer.data.slice(r.startOffset)])"""
    assert page.evaluate(grey) == []
    switch = page.locator(".ms-study").get_by_role("checkbox").last
    switch.click()
    told = page.locator("ms-proof")
    expect(told).to_contain_text("every number proved to 9 digits")
    expect(told).to_contain_text("digits missing")
    page.wait_for_function("() => CSS.highlights.get('ms-unproved')?.size")
    lost = page.evaluate(grey)
    assert all(whole != digits for whole, digits in lost)
    value = page.locator("#line-M_S .ms-value")
    own = """(value) => [...CSS.highlights.get('ms-unproved')].filter((r) => value.contains(r.startContainer))
        .map((r) => r.startContainer.data.slice(r.startOffset, r.endOffset))"""
    digits = value.evaluate(own)
    assert digits == [number[-1] for number in re.findall(r"\d+", value.inner_text())], "4 N·m: the last digit of each"
    value.locator("ms-unit").first.click()
    page.get_by_role("menuitemradio", name="N·mm", exact=True).click()
    copy = page.locator("#line-M_S .ms-chosen")
    until(page, lambda: copy.evaluate(own)[1:] == [f"{digit}000" for digit in digits[1:]], "so has the other unit")
    value.locator(".ms-chosen ms-unit").click()
    page.get_by_role("menuitemradio", name="N·m", exact=True).click()
    field = page.locator(".ms-inputs tr:has-text('force on the lever') input")
    field.fill("1000")
    field.press("Enter")
    until(page, lambda: page.evaluate(grey) not in ([], lost), "other numbers are not proved")
    switch.click()
    expect(told).to_have_count(0)


def test_printed_page_is_a_document(page, tmp_path):
    """A4 with page numbers, inputs as a table, sharp charts, and none of the controls."""
    from pypdf import PdfReader

    page.locator("svg.ms-chart").nth(6).wait_for()
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


def test_a_unit_is_switched_wherever_the_quantity_is_shown(page):
    """By the keys alone; it stays while the inputs change, and is printed as it is seen."""
    table = page.locator(".ms-table:has-text('Table 4.1 ') table >> visible=true")
    line, force = (
        page.locator(".ms-line", has_text="force on the hydraulic cylinders"),
        table.locator("td:nth-child(2)").first,
    )
    choose_by_keys(line)
    expect(line).to_contain_text("129.61, 123.28, ")
    expect(force).to_have_text("129.61")
    assert page.evaluate("document.activeElement.textContent") == "kN", "the focus stays at the unit"
    choose(page, page.locator(".ms-table:has-text('Table 2.2 ') th ms-unit").first, "mm")
    expect(page.locator(".ms-table:has-text('Table 4.1 ') td >> visible=true").first).to_have_text("420")
    field = page.locator(".ms-inputs tr:has-text('weight of the implement') input")
    field.fill("30000,5")
    field.press("Enter")
    expect(force, "129.614 kN * 30000.5 / 27500").to_have_text("141.40")
    expect(line.locator("ms-value .ms-chosen")).to_contain_text("141.4, ")
    page.emulate_media(media="print")
    expect(force).to_have_text("141.40")
    page.emulate_media(media="null")
    choose(page, page.locator(".ms-table:has-text('Table 4.1 ') th:nth-child(2) ms-unit >> visible=true").first, "N")
    expect(line.locator(".ms-chosen")).to_have_count(0)
    expect(line).to_contain_text("141399, ")
    field.fill("27500")
    field.press("Enter")
    choose(page, page.locator(".ms-table:has-text('Table 2.2 ') th ms-unit >> visible=true").first, "m")
    expect(line).to_contain_text("129614, ")


def test_a_mark_on_every_output_styles_the_outputs_and_not_what_stands_in_them(browser, page):
    """marimo marks an output while its cell runs; formulas and tables in it must not be styled again for that."""
    page.wait_for_function("() => 'measured' in document.documentElement.dataset")
    page.set_viewport_size({"width": 1280, "height": 14_000})  # cells out of sight are not styled at all
    drawn(page)
    mark = "mark => { document.querySelectorAll('.output-area').forEach((e) => e.classList.toggle('x', mark)); }"
    elements = page.evaluate("() => document.querySelectorAll('.output-area *').length")
    styled = []
    for _ in range(3):  # what the page does beside it comes on top
        browser.start_tracing(page=page, categories=["devtools.timeline"])
        page.evaluate(mark, True)
        drawn(page)
        events = json.loads(browser.stop_tracing())["traceEvents"]
        styled.append(sum(e["args"].get("elementCount", 0) for e in events if e["name"] == "UpdateLayoutTree"))
        page.evaluate(mark, False)
        drawn(page)
    page.set_viewport_size(SIZE)
    assert 0 < min(styled) < elements / 20


def test_play_moves_the_slider_until_it_is_stopped(page):
    """The last that uses the page, which is opened again where a slider has moved."""
    slider, button = page.get_by_role("slider").first, page.locator(".ms-play").first

    def at() -> float:
        return float(slider.get_attribute("aria-valuenow"))

    first = at()
    button.click()
    until(page, lambda: at() > first + 0.04, "the slider rests")
    button.click()
    drawn(page)
    stopped = at()
    page.wait_for_timeout(500)  # ten of its steps
    assert at() == stopped
