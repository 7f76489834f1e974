"""The page in one file beside the worksheet's own: what both show alike, and what keys tell."""

import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from conftest import WITHIN
from playwright.sync_api import Browser, Page, expect
from test_html_page import SCROLLED, SETTLED, fill, opened, written

from mechsheet.document import formula, parts
from mechsheet.document.mathml import mathml
from mechsheet.html import javascript, markdown, values
from mechsheet.worksheet import inputs
from mechsheet.worksheet.cells import load
from mechsheet.worksheet.check import Summary
from mechsheet.worksheet.drawing import Drawing
from mechsheet.worksheet.title import side_by_side

ROOT = Path(__file__).parents[1]


@pytest.fixture(scope="module")
def hitch(browser: Browser, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Page]:
    path = tmp_path_factory.mktemp("html") / "hitch.html"
    path.write_text(written("hitch", {}), encoding="utf-8")
    context = browser.new_context(viewport={"width": 1280, "height": 1000}, offline=True)
    context.set_default_timeout(WITHIN * 1000)
    yield opened(context.new_page(), path)
    context.close()


def test_words_below_drawings_that_stand_side_by_side_are_shown() -> None:
    shown = side_by_side((Drawing().hinge(0j, "A"), "to the *left*, $x < 0$"), (Drawing().hinge(0j, "B"), "right"))
    first, second = values.still(shown).split("</div></div><div>")
    assert "</svg>" in first and "to the <em>left</em>, <math>" in first and "right" in second


@pytest.mark.parametrize("weight", ["27500", "29000", "26000,5"])
def test_checks_are_summed_up_the_worst_first_with_what_they_take_of_their_limit(hitch: Page, weight: str) -> None:
    sheet = load(ROOT / "worksheets" / "hitch.py")
    namespace = sheet.run(sheet.results, {"g": inputs.build(sheet.inputs, {"P6": weight})})
    (summary,) = (part for part in parts.contents(namespace) if isinstance(part, Summary))
    fill(hitch, "P6", weight)
    rows = hitch.locator(".ms-summary .ms-row > span")
    shown = [(" ".join(row.split()[:1]), row.split()[-2:]) for row in rows.all_inner_texts()]
    for (verdict, end), check in zip(shown, summary.worst_first, strict=True):
        assert verdict.upper() == check.verdict.upper()
        assert (" ".join(end) == check.utilised) == bool(check.utilised), check.name


def test_space_tells_the_document_s_own_numbers(hitch: Page) -> None:
    def put_in(weight: str) -> None:
        fill(hitch, "P6", weight)
        hitch.evaluate(SETTLED)

    put_in("27500")
    value = hitch.locator("#line-F_gc .ms-value")
    cells = hitch.locator("#table-4\\.1 ~ .ms-wide td")
    own, first = value.text_content(), cells.all_text_contents()
    put_in("25000")
    tip, table = hitch.locator(".ms-tip"), hitch.locator("#table-4\\.1 ~ .ms-wide table").first
    differ = [text for text, now in zip(first, cells.all_text_contents(), strict=True) if text != now]
    assert len(differ) > 5

    def pressed(place: str, *keys: str) -> str:
        hitch.locator(place).first.focus()
        hitch.evaluate(SCROLLED)
        for key in keys:
            hitch.keyboard.press(key)
        return tip.inner_text()

    assert pressed("#line-F_gc .ms-formula", "Space") == f"the document's own: {own}"
    assert "91.8" in pressed(".ms-check:has-text('pressure within')", "Space")
    wide = "#table-4\\.1 ~ .ms-wide table"
    assert table.get_attribute("aria-description") == "space: the document's own number where one differs"
    told = [pressed(wide, "Space"), pressed(wide, "Space"), pressed(wide, "Shift+Space")]
    assert told == [f"the document's own: {text}" for text in (differ[0], differ[1], differ[0])]
    hitch.locator("#line-S_gc .ms-formula").focus()
    hitch.keyboard.press("Space")  # the same as in the document
    expect(tip).to_be_hidden()


def test_formulas_of_texts_have_blanks_where_print_has_them() -> None:
    """A minus at the beginning of what a relation, a comma or a bracket goes before is no difference."""
    for latex in (r"c \le -1", "a = -b", "(-a", "[-1, 1]", "a, -b", r"x \to -\infty"):
        assert markdown.formula(latex).count('form="prefix">&#x02212;') == 1, latex
    assert 'form="prefix"' not in markdown.formula("a - b")
    assert 'mathvariant="normal">' in markdown.formula(r"\Delta\beta") != markdown.formula(r"\beta")
    assert markdown.formula("a/2").count("<mo ") == 1


def test_a_range_has_dots_between_its_ends_alone() -> None:
    """As in the worksheet's own page: 0, 1 ... N."""
    ends = formula.Range((formula.Number(0), formula.Number(1)), formula.Number(9))
    assert mathml(ends).count(",") == 1


def test_a_long_table_goes_on_on_the_next_page_under_its_heading(browser: Browser) -> None:
    """It begins below what stands before it; a page was left half empty before it."""
    rows = "".join(f"<tr><td>{n}</td></tr>" for n in range(40))
    table = f"<table><thead><tr><th>x</th></tr></thead><tbody>{rows}</tbody></table>"
    style = javascript.runtime("page.css")
    page = browser.new_page()

    for before, count, sheets in ((20, 1, 1), (150, 4, 6)):  # 8 where a table stays whole
        body = f'<div style="height:{before}mm"></div><div class="ms-table">{table}</div>' * count
        page.set_content(f"<style>{style}</style><main>{body}</main>")
        assert len(re.findall(rb"/Type\s*/Page\b", page.pdf(prefer_css_page_size=True))) == sheets
    page.close()


def test_rows_side_by_side_stay_on_one_page_and_take_nothing_along(browser: Browser) -> None:
    """Few of them at the foot of a page had no heads, and the caption had drawn the last rows of a table before it."""
    rows = "".join(f"<tr><td>{n}</td></tr>" for n in range(25))
    table = f"<table><thead><tr><th>x</th></tr></thead><tbody>{rows}</tbody></table>"
    beside = f'<ms-rows style="--rows: 2; --each: 9em">{table}</ms-rows>'
    body = f'<div class="ms-table"><div class="ms-caption">t</div>{beside}</div>'
    page = browser.new_page()
    page.set_content(f"<style>{javascript.runtime('page.css')}</style><main>{body}</main>")
    page.emulate_media(media="print")
    style = "e => [getComputedStyle(e).breakInside, getComputedStyle(e).breakBefore]"
    assert page.locator("ms-rows").evaluate(style)[0] == "avoid"
    assert page.locator(".ms-caption").evaluate(style)[1] == "auto"
    page.close()


def test_many_numbers_of_a_line_go_on_in_the_next_and_none_is_cut(hitch: Page) -> None:
    """At the width of a telephone too; a number stays with its power of ten and its unit in one line."""
    cut = "[...document.querySelectorAll('.ms-value')].filter(e => e.getBoundingClientRect().right > innerWidth).length"
    lines = """[...document.querySelectorAll('.ms-value sup')].map(e => e.previousSibling).filter(
      text => text.data?.endsWith('10')).map(text => {
      const range = document.createRange();
      range.setStart(text, text.length - 6);
      range.setEnd(text, text.length);
      return new Set([...range.getClientRects()].map(box => box.top)).size;
    })"""
    alone = """[...document.querySelectorAll('.ms-value > ms-unit')].filter(
      unit => unit.previousSibling?.length > 1).filter(unit => {
      const range = document.createRange(), before = unit.previousSibling;
      range.setStart(before, before.length - 2);
      range.setEnd(before, before.length - 1);
      return range.getBoundingClientRect().bottom < unit.getBoundingClientRect().top;
    }).length"""
    fill(hitch, "P6", "2.75e9")  # of forces so large
    hitch.evaluate(SETTLED)
    hitch.set_viewport_size({"width": 390, "height": 1000})
    try:
        assert hitch.evaluate(cut) == 0
        assert hitch.evaluate(alone) == 0
        counts = hitch.evaluate(lines)
        assert len(counts) > 10 and set(counts) == {1}
    finally:
        fill(hitch, "P6", "27500")
        hitch.set_viewport_size({"width": 1280, "height": 1000})


def test_sections_are_listed_beside_the_page_and_above_it_on_request(hitch: Page) -> None:
    expect(hitch.locator("nav a").first).to_be_visible()
    hitch.set_viewport_size({"width": 800, "height": 1000})
    try:
        hitch.reload()
        hitch.wait_for_selector("body[data-ready]")
        expect(hitch.locator("nav a").first).to_be_hidden()
        hitch.locator("nav summary").click()
        expect(hitch.locator("nav a").first).to_be_visible()
    finally:
        hitch.set_viewport_size({"width": 1280, "height": 1000})


def test_nothing_of_a_field_is_cut_or_covered(browser: Browser, tmp_path: Path) -> None:
    """Numbers and columns of lists, and units beside the meanings: those of the joint are the widest."""
    path = tmp_path / "joint.html"
    path.write_text(written("joint", {}), encoding="utf-8")
    for width in (800, 1280):
        page = opened(browser.new_page(viewport={"width": width, "height": 1000}), path)
        cut = """[...document.querySelectorAll('.ms-grid input')].filter(e => e.scrollWidth > e.clientWidth
          || e.getBoundingClientRect().right > e.closest('.ms-grid').getBoundingClientRect().right + 1).length"""
        over = """[...document.querySelectorAll('.ms-field > .ms-unit')].filter(
          unit => unit.textContent && unit.scrollWidth > unit.clientWidth).map(unit => unit.textContent)"""
        assert (page.evaluate(cut), page.evaluate(over)) == (0, []), width
        page.close()


def test_a_list_is_printed_as_a_table_of_what_is_in_its_fields(browser: Browser, tmp_path: Path) -> None:
    path = tmp_path / "bolted_joint.html"
    path.write_text(written("examples/bolted_joint", {}), encoding="utf-8")
    page = opened(browser.new_page(), path)
    page.locator("[data-grid=cases] input").first.fill("-250")
    page.emulate_media(media="print")
    printed = page.locator("[data-used=cases] + tr table")
    expect(printed).to_be_visible()
    head, *rows = (row.split() for row in printed.locator("tr").all_inner_texts())
    assert head == ["FA", "[lbf]", "FQ", "[lbf]"]
    assert rows == [["1", "−250", "300"], ["2", "1500", "600"], ["3", "2500", "400"], ["4", "3000", "0"]]
    page.close()


def test_on_paper_every_number_stands_with_its_minus(hitch: Page) -> None:
    """It was a hyphen there, beside the minus of all results."""
    field, printed = hitch.locator("#input-X01"), hitch.locator("[data-used=X01] td:nth-child(2)")
    before = field.input_value()
    for typed, text in {"-0,415": "−0,415", before: before}.items():
        field.fill(typed)
        expect(printed).to_have_text(text)


def test_a_part_that_changes_is_painted_without_the_others(hitch: Page) -> None:
    """A frame of the whole page in view, beside one in which all is painted again: 5 ms of the thread and 14."""
    session = hitch.context.new_cdp_session(hitch)
    session.send("Performance.enable", {"timeDomain": "threadTicks"})
    frames = """async () => {
      for (let k = 0; k < 10; k++) {
        document.querySelector(".ms-state").textContent = k;
        await new Promise(done => requestAnimationFrame(() => setTimeout(done)));
      }
    }"""

    def spent() -> float:
        metrics = {m["name"]: m["value"] for m in session.send("Performance.getMetrics")["metrics"]}
        return float(metrics["TaskDuration"])

    def taken() -> float:
        hitch.evaluate(frames)
        before = spent()
        hitch.evaluate(frames)
        return spent() - before

    hitch.set_viewport_size({"width": 1280, "height": hitch.evaluate("document.body.scrollHeight")})
    try:
        alone = taken()
        style = hitch.add_style_tag(content="main > *, math { isolation: auto !important }")
        assert alone < 0.7 * taken()
        style.evaluate("element => element.remove()")
    finally:
        hitch.set_viewport_size({"width": 1280, "height": 1000})


def test_a_browser_of_two_years_ago_shows_the_page(hitch: Page, browser: Browser) -> None:
    """Without what has come since."""
    context = browser.new_context(offline=True)
    page = context.new_page()
    page.add_init_script("""
      const iterator = Object.getPrototypeOf(Object.getPrototypeOf([].values()));
      for (const name of ["map", "filter", "take", "drop", "flatMap", "reduce", "toArray", "forEach", "some", "every",
                          "find"]) delete iterator[name];
      for (const name of ["union", "intersection", "difference", "symmetricDifference", "isSubsetOf", "isSupersetOf",
                          "isDisjointFrom"]) delete Set.prototype[name];
      for (const name of ["groupBy", "withResolvers", "try", "escape", "fromAsync"])
        for (const owner of [Object, Map, Promise, RegExp, Array]) delete owner[name];
    """)
    errors = list[str]()
    page.on("pageerror", lambda error: errors.append(str(error)))
    page.goto(hitch.url.split("#")[0])
    page.wait_for_selector("body[data-ready]")
    page.locator(".ms-switch").check()
    fill(page, "P6", "26000")
    slider = page.locator("[data-control]").first
    slider.focus()
    slider.press("ArrowRight")
    page.locator("#line-P23 msub").first.hover()
    page.evaluate(SETTLED)
    expect(page.locator("#line-S_gc .ms-numbers math")).to_be_visible()
    assert errors == []
    context.close()


def test_a_long_and_narrow_table_of_inputs_is_printed_in_columns(blank: Page) -> None:
    """It took three sheets with one number in a line; one of more columns, and a short one, stay as they are."""

    def height(rows: int, columns: int) -> float:
        row = "<tr><th>1</th>" + "<td>4.5</td>" * columns + "</tr>"
        table = f"<table><thead>{row.replace('td', 'th')}</thead><tbody>{row * rows}</tbody></table>"
        style = (ROOT / "lib/mechsheet/html/page.css").read_text(encoding="utf-8")
        told = '<tr><td>p</td><td></td><td></td><td style="width:60em">pressure</td></tr>'
        inside = f'{told}<tr><td colspan="4">{table}</td></tr>'
        blank.set_content(f'<style>{style}</style><table class="ms-print"><tbody>{inside}</tbody></table>')
        blank.emulate_media(media="print")
        found = blank.locator("td[colspan]").bounding_box()
        assert found
        return found["height"]

    line = height(2, 2) / 3
    assert height(60, 2) < 35 * line
    assert height(60, 3) > 55 * line
    assert height(9, 2) > 9 * line
