"""The document in one file, in a browser that has no network."""

import base64
import hashlib
import json
import os
import re
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any
from urllib.parse import quote

import numpy as np
import pytest
import test_html_find
from as_script import as_command
from conftest import WITHIN, until
from in_browser import faults
from playwright.sync_api import Browser, Page, expect
from test_html_drawing import alike
from test_html_page_formulas import as_seen

from mechsheet import units
from mechsheet.document import chart, chart_svg, drawing_svg, expression, formula, parts
from mechsheet.document.mathml import inner
from mechsheet.document.shortened import ENDS
from mechsheet.html import write
from mechsheet.recording import showing
from mechsheet.run import arguments, html
from mechsheet.worksheet import inputs
from mechsheet.worksheet.cells import load
from mechsheet.worksheet.table import Figure
from mechsheet.worksheet.typeset import Numbers

ROOT = Path(__file__).parents[1]
CASES = "500;200|700;100|2500;400|3.5 kN;100|4;0"
LOADS = "500000;13000;0|300000;-13000;0|400000;5000;100"
SHEETS = {
    "hitch": {"P6": "30000,5", "N_pol": "12", "L5": "0.47", "side_67": "right"},
    "landing_gear": {"theta": "86"},
    "joint": {"psi": "0.6", "loads": LOADS, "ring_loads": "2000000;-20000|1200000;25000|900000;1000"},
    "slotted_link": {"L0": "0.5"},
    "kinetostatics": {"Y_H": "0.2222"},
    "guide": {"F": "42", "r": "55"},
    "examples/bucket": {"m": "1100", "D_c": "125"},
    "examples/engine": {"n": "2000", "e": "2"},
    "examples/bolted_joint": {"grade": "10.9", "mu_G": "0.14", "cases": CASES},
}
UNTOLD = {"joint": 2}  # lists of states, which are texts of Python's
NUMBER = re.compile(r"(-?\d+(?:\.\d+)?(?:e[+-]\d+)?)")
# Evaluations of the equations that are solved.
COUNTS = {"line-N_F", "line-N_g"}
# What is told is hidden as the page scrolls, which it does while parts that come into view take their heights.
SCROLLED = """() => new Promise(done => {
  let last, still = 0;
  const look = () => {
    const now = `${scrollY} ${document.body.scrollHeight}`;
    still = now === last ? still + 1 : 0;
    last = now;
    still < 10 ? requestAnimationFrame(look) : done();
  };
  look();
})"""
SETTLED = "dispatchEvent(new Event('beforeprint'))"  # what is out of view may wait
READ = (
    f"() => {{ {SETTLED};"
    + """
  const text = element => element?.textContent ?? null;
  const each = (selector, read) => [...document.querySelectorAll(selector)].map(read);
  return {
    lines: Object.fromEntries(each(".ms-line[id]", e => {
      const value = e.querySelector(".ms-value");
      return [e.id, value?.matches(".ms-grey") ? null : text(value)];
    })),
    numbers: each(".ms-line[id]:has(> .ms-numbers)", line => {
      const e = line.querySelector(".ms-numbers");
      return [line.id, e.matches(".ms-grey") ? null : e.innerHTML];
    }),
    tables: Object.fromEntries(each(".ms-table", e => [e.querySelector(".ms-caption").id,
      [...e.querySelectorAll("tbody tr")].map(row => [...row.cells].map(text))])),
    verdicts: Object.fromEntries(each(".ms-check", e => [e.id, text(e.querySelector(".ms-badge"))])),
    charts: each(".ms-figure svg.ms-chart", e => e.outerHTML.replace(/ (data-values|style)="[^"]*"/g, "")),
    drawings: each("[data-n] > svg:not(.ms-chart)", e => e.outerHTML),
    sliders: each("[data-control]", e => [e.min, e.max, e.value]),
    texts: each(".ms-between, .ms-caption", e => (e.querySelector(".ms-grey") ? null : text(e))),
    found: each(".ms-found", e => (e.matches(".ms-grey") ? null : e.innerHTML)),
    state: text(document.querySelector(".ms-state")),
    sum: text(document.querySelector(".ms-summary b")),
  };
}"""
)


def written(name: str, given: dict[str, str]) -> str:
    sheet = load(ROOT / "worksheets" / f"{name}.py")
    return write.page(sheet, inputs.build(sheet.inputs, given))


def drawn(name: str, given: dict[str, str]) -> dict[str, list[Any]]:
    """Drawings, charts and formulas with numbers of a worksheet as Python lays them out."""
    sheet = load(ROOT / "worksheets" / f"{name}.py")
    namespace = sheet.run(sheet.results, {"g": inputs.build(sheet.inputs, given)})
    shown, known = parts.contents(namespace), Numbers(namespace)
    figures = [part for part in shown if isinstance(part, Figure)]
    layouts = [chart.line_chart(figure.x, figure.lines, figure.marks, figure.every) for figure in figures]
    return {
        "drawings": [closed(drawing_svg.svg(part)) for part in showing.drawings(shown)],
        "charts": [
            re.sub(r" (?:data-values='[^']*'|style=\"[^\"]*\")", "", closed(chart_svg.svg(layout)))
            for layout in layouts
        ],
        "numbers": [
            (f"line-{p.formula.name}", x) for p in shown if isinstance(p, parts.Line) and (x := put_in(p, known))
        ],
    }


def put_in(line: parts.Line, known: Numbers) -> str:
    """The formula of a line with numbers for its symbols; nothing where it has none."""
    at, of = line.position, line.formula.name
    found = {name: x for name in expression.reads(line.formula) if (x := known.at(name, at, of))}
    read = {name: formula.Measure(x / units.parse(unit).factor, unit) for name, (x, unit) in found.items()}
    node = None if line.formula.arguments else expression.substituted(line.formula, read)
    return f'<math displaystyle="true"><mo>=</mo>{inner(node)}</math>' if node else ""


def closed(svg: str) -> str:
    """A picture as a browser writes it."""
    return re.sub(r"<(\w+)([^<>]*)/>", r"<\1\2></\1>", svg)


@pytest.fixture(scope="module")
def document(tmp_path_factory: pytest.TempPathFactory) -> Callable[..., Path]:
    """File of a worksheet with some inputs, written once."""
    folder, known = tmp_path_factory.mktemp("html"), dict[str, Path]()

    def path(name: str, **given: str) -> Path:
        key = name + json.dumps(given)
        if key not in known:
            known[key] = folder / f"{Path(name).name}_{len(known)}.html"
            known[key].write_text(written(name, given), encoding="utf-8")
        return known[key]

    return path


@pytest.fixture
def offline(browser: Browser) -> Iterator[Page]:
    """A page without network, whose errors and requests fail the test."""
    context = browser.new_context(viewport={"width": 1280, "height": 1000}, offline=True)
    context.set_default_timeout(WITHIN * 1000)
    page, trouble = context.new_page(), list[str]()
    page.on("pageerror", lambda error: trouble.append(str(error)))
    page.on("console", lambda message: trouble.append(message.text))
    page.on("request", lambda request: request.url[:5] in ("file:", "blob:", "data:") or trouble.append(request.url))
    yield page
    context.close()
    assert trouble == []


def opened(page: Page, path: Path, address: str = "") -> Page:
    page.goto("about:blank")
    page.goto(path.as_uri() + (f"#{address}" if address else ""))
    page.wait_for_selector("body[data-ready]")
    return page


def fill(page: Page, name: str, text: str) -> None:
    page.locator(f"#input-{name}").fill(text)


def read(page: Page) -> Any:
    return page.evaluate(READ)


@pytest.mark.parametrize("name", SHEETS)
def test_the_page_shows_for_other_inputs_what_the_worksheet_shows(
    name: str, document: Callable[..., Path], offline: Page
) -> None:
    """Tables, verdicts and found values letter by letter, of lines those that are not rounding; charts to 0.1 px.

    How often an equation was evaluated is no property of the document.
    """
    given = SHEETS[name]
    assert document(name).stat().st_size < 650_000
    there = read(opened(offline, document(name, **given)))
    pictures = drawn(name, given)
    changed = opened(offline, document(name), "&".join(f"{k}={quote(v)}" for k, v in given.items()))
    changed.get_by_label("numbers in the formulas").check()
    here = read(changed)
    assert faults(changed) == []
    assert changed.locator(".ms-bar + p .ms-FAIL").count() == 0  # which is there where units do not fit
    assert here["state"].startswith("changed: ")
    assert here["verdicts"] == there["verdicts"] and here["sliders"] == there["sliders"]
    for shown in (here, there):
        assert len(shown["drawings"]) == len(pictures["drawings"])
        for own, drawing in zip(pictures["drawings"], shown["drawings"], strict=True):
            assert alike(own, drawing)
    assert [x for x in here["texts"] if x is None] == [None] * UNTOLD.get(name, 0)
    for k, text in enumerate(here["texts"]):
        assert text in (None, there["texts"][k])
    assert list(map(without_counts, here["found"])) == list(map(without_counts, there["found"]))
    for caption, rows in there["tables"].items():
        assert here["tables"][caption] == rows, caption
    for k, curve in enumerate(pictures["charts"]):
        mine, own = (re.split(NUMBER, text) for text in (here["charts"][k], curve))
        assert mine[::2] == own[::2], k
        np.testing.assert_allclose(np.array(mine[1::2], float), np.array(own[1::2], float), rtol=0, atol=0.11)
    assert [line for line, _ in here["numbers"]] == [line for line, _ in pictures["numbers"]]
    for (line, mine), (_, own) in zip(here["numbers"], pictures["numbers"], strict=True):
        assert as_seen(mine) == as_seen(own), line
    lines = {k: (x, there["lines"][k]) for k, x in here["lines"].items() if x is not None}
    wrong = {k: pair for k, pair in lines.items() if len({*map(without_rounding, pair)}) > 1 and k not in COUNTS}
    assert wrong == {}
    assert len(lines) > 0.9 * sum(x is not None for x in there["lines"].values())


def without_counts(found: str) -> str:
    """The verdict of a Find without its residuals, and without how many samples saw an end that may not close."""
    return re.sub(r" by \d+ samples", "", test_html_find.without_rounding(found))


def without_rounding(text: str) -> tuple[str, ...]:
    """Numbers of a line, those of 1e-7 and less as 0: there stands what rounding leaves, and its place says nothing."""
    text, *place = text.partition(" least at ")
    found = re.findall("[\\d.]+(?:\u202f·\u202f10−?\\d+)?", text.replace("−0", "0"))
    shown = ["0" if re.search(r"10−(?:[7-9]|1\d|2\d)$", x) else x for x in found]
    return tuple(dict.fromkeys(shown)) if "0" in shown else (*shown, *place)


def test_nothing_is_asked_for_and_only_its_own_script_runs(document: Callable[..., Path]) -> None:
    text = document("slotted_link", **SHEETS["slotted_link"]).read_text(encoding="utf-8")
    policy = re.search('Content-Security-Policy" content="([^"]*)"', text)
    assert policy and policy[1].startswith("default-src 'none'; ")
    script = text[text.rindex("<script>") + 8 : text.rindex("</script>")]
    digest = base64.b64encode(hashlib.sha256(script.encode()).digest()).decode()
    assert f"script-src 'sha256-{digest}';" in policy[1]
    assert not re.search(r'(?:src|href)="(?!#)', text)
    assert '<html lang="en">' in text


def test_a_wrong_input_is_told_at_its_field_and_nothing_is_shown_for_it(
    document: Callable[..., Path], offline: Page
) -> None:
    page = opened(offline, document("hitch"))
    first = read(page)
    for name, text, told in (
        ("P6", "heavy", "weight of the implement P6 = 'heavy' N is no number"),
        ("L5", "-1", "lower link, to the lifting rod L5 = −1 m must be positive"),
        ("N_pol", "2.5", "number of positions N_pol = 2.5 must be a whole number"),
        ("S_min", "0.7", "least length of the cylinder S_min = 0.7 m must be < S_max = 0.67 m"),
        ("P6", "3 m", "P6 = '3 m': m is not known here: N, "),
        ("P6", "30 000", "P6 = '30 000' N is no number"),
        ("P6", "30.000,5", "P6 = '30.000,5' N is no number"),
        ("P6", "3e4/2", "P6 = '3e4/2' N is no number"),
    ):
        fill(page, name, text)
        expect(page.locator(f"#error-{name}")).to_contain_text(told)
        shown = read(page)
        assert shown["state"].startswith("not computed: ")
        assert name != "L5" or told in shown["state"], "with the same minus"
        assert set(shown["lines"].values()) <= {None, *first["lines"].values()}
        assert shown["lines"]["line-GS6"] is None
        assert set(shown["verdicts"].values()) == {"not known"}
        if name == "P6":
            assert faults(page) == []
        page.locator(".ms-back").click()
        assert read(page) == first


def test_units_are_read_and_the_changed_input_is_marked_and_kept_in_the_address(
    document: Callable[..., Path], offline: Page
) -> None:
    page = opened(offline, document("hitch"))
    fill(page, "P6", "30 kN")
    expect(page.locator(".ms-field.ms-changed")).to_have_count(1)
    expect(page.locator(".ms-state")).to_have_text("changed: P6")
    expect(page).to_have_url(re.compile("#P6=30%20kN$"))
    with page.expect_download() as saved:
        page.locator(".ms-save").click()
    path = saved.value.path()
    assert path.read_text(encoding="utf-8") == '[inputs]\nP6 = "30 kN"\n'
    sheet = load(ROOT / "worksheets" / "hitch.py")
    named = path.with_name("scene.toml")
    path.rename(named)
    g = inputs.build(sheet.inputs, arguments.read([f"--scene={named}"], inputs.declared(sheet.inputs)).inputs)
    assert g.P6 == 30e3


def test_percent_are_a_unit_of_a_number_without_one(document: Callable[..., Path], offline: Page) -> None:
    """As on the command line and in the editor."""
    page = opened(offline, document("examples/bolted_joint"))
    first = read(page)["lines"]
    fill(page, "nu", "90 %")
    assert read(page)["lines"] == first
    fill(page, "nu", "0.8")
    told = read(page)["lines"]
    fill(page, "nu", "80 %")
    assert read(page)["lines"] == told != first


def test_what_an_address_gives_that_no_input_takes_is_told(document: Callable[..., Path], offline: Page) -> None:
    """Else the page says that all is as in the document, to somebody who follows a link with another input."""
    page = opened(offline, document("examples/bolted_joint"), "foo=3&grade=12.8&nu=0.8")
    state = page.locator(".ms-state")
    expect(state).to_have_text("changed: nu; there is no input foo; grade has no option 12.8")
    page.get_by_role("button", name="back to the document").click()
    expect(state).to_have_text("as in the document")


def test_a_link_within_the_page_leaves_the_inputs(document: Callable[..., Path], offline: Page) -> None:
    page = opened(offline, document("hitch"))
    fill(page, "P6", "30000")
    expect(page).to_have_url(re.compile("#P6=30000$"))
    link = page.locator("a[href^='#check-']").first
    link.click()
    expect(page.locator(link.get_attribute("href") or "")).to_be_in_viewport()
    expect(page).to_have_url(re.compile("#P6=30000$"))
    assert page.locator("#input-P6").input_value() == "30000"


def test_rows_are_filled_in_put_in_and_taken_away(document: Callable[..., Path], offline: Page) -> None:
    page = opened(offline, document("examples/bolted_joint"))
    first, rows = read(page), page.locator("[data-grid=cases] tbody tr")
    rows.last.locator("input").first.fill("3,5 kN")
    rows.nth(4).locator("input").last.fill("100")
    expect(rows).to_have_count(6)
    expect(page.locator("#table-4\\.1 ~ .ms-wide tbody tr")).to_have_count(5)
    page.locator("[data-grid=cases] input").first.evaluate(
        """cell => {
          const clipboardData = new DataTransfer();
          clipboardData.setData("text/plain", "500\\t200\\r\\n700\\t100\\r\\n");
          cell.dispatchEvent(new ClipboardEvent("paste", {clipboardData, bubbles: true, cancelable: true}));
        }"""
    )
    rows.nth(3).locator("input").first.press("Control+Delete")
    rows.nth(1).locator("input").first.press("Control+Enter")
    page.keyboard.type("4")
    page.keyboard.press("ArrowUp")
    rows.nth(1).locator("button").click()
    rows.nth(1).locator("input").last.fill("0")
    cases = quote("500; 200 | 4; 0 | 2500; 400 | 3,5 kN; 100")
    expect(page).to_have_url(re.compile(re.escape(f"#cases={cases}") + "$"))
    expect(page.locator("#table-4\\.1 ~ .ms-wide tbody tr")).to_have_count(4)
    page.evaluate(SETTLED)
    expect(page.locator("main .ms-grey")).to_have_count(0)
    page.locator(".ms-back").click()
    assert read(page) == first
    expect(rows).to_have_count(5)


def test_what_ends_as_a_field_but_has_no_positions_is_written_as_a_number(document: Callable[..., Path]) -> None:
    text = document("examples/bolted_joint").read_text(encoding="utf-8")
    line = re.search('id="line-delta_S"><span class="ms-formula">.*?<math[^>]*>(?:<mrow>)?(<msub>.*?</msub>)<', text)
    assert line and line[1] == '<msub><mi>δ</mi><mi mathvariant="normal">S</mi></msub>'


def test_the_page_is_used_by_keys_alone(document: Callable[..., Path], offline: Page) -> None:
    """Each kind of what is used is reached by the tabulator, and shows that it is."""
    page = opened(offline, document("hitch"))
    look = "e => [e.matches(':focus-visible'), getComputedStyle(e).outlineStyle, getComputedStyle(e).outlineWidth]"
    fields = (".ms-field input[type=text]", "select", ".ms-switch", "[data-control]")
    for kind in (*fields, "a", "summary", ".ms-play", "ms-unit", ".ms-wide", ".ms-formula", ".ms-figure [data-n]"):
        element = page.locator(kind).first
        element.focus()
        page.keyboard.press("Shift+Tab")
        page.keyboard.press("Tab")
        visible, style, width = element.evaluate(look)
        assert visible and style != "none" and float(width.removesuffix("px")) >= 1, kind
    play = page.get_by_role("button", name="play").first
    play.focus()
    page.keyboard.press("Enter")
    expect(page.get_by_role("button", name="pause").first).to_be_visible()
    page.keyboard.press("Enter")


def test_a_slider_moves_its_drawings_which_follow_the_inputs(document: Callable[..., Path], offline: Page) -> None:
    page = opened(offline, document("hitch"))
    place = "document.querySelector('[data-n] > svg[viewBox]:not(.ms-chart)').parentElement.dataset.n"
    drawing = page.locator(f'[data-n="{page.evaluate(place)}"]')
    expect(drawing.locator("svg")).to_have_count(1)
    before = drawing.inner_html()
    page.locator("[data-control=part]").evaluate(
        "e => { e.value = 0.6; e.dispatchEvent(new Event('input', {bubbles: true})) }"
    )
    moving = expect(page.locator("#line-S_t .ms-value"))
    moving.to_have_text("0.57 m")
    page.evaluate(SETTLED)
    assert drawing.inner_html() != before
    mark = "getComputedStyle(document.querySelector('.ms-figure')).getPropertyValue('--at-S')"
    assert page.evaluate(f"Math.abs({mark} - 0.57) < 1e-9")
    moved = drawing.inner_html()
    fill(page, "S_max", "0.7")
    moving.not_to_have_text("0.57 m")
    page.evaluate(SETTLED)
    assert drawing.inner_html() != moved
    page.locator(".ms-back").click()
    moving.to_have_text("0.57 m")
    page.evaluate(SETTLED)
    assert drawing.inner_html() == moved


@pytest.mark.parametrize("name", ["hitch", "slotted_link"])
def test_the_moving_position_stands_in_each_chart_over_it(
    name: str, document: Callable[..., Path], offline: Page
) -> None:
    """A name with an underscore was asked for without it: the line stood thirty million pixels to the left."""
    page = opened(offline, document(name))
    page.evaluate(SETTLED)
    inside = """line => {
        const [at, chart] = [line, line.closest(".ms-chart")].map(e => e.getBoundingClientRect());
        return at.x > chart.x && at.x < chart.right;
    }"""
    lines = page.locator(".ms-at").all()
    assert lines and all(line.evaluate(inside) for line in lines)


def test_a_symbol_tells_what_it_means(document: Callable[..., Path], offline: Page) -> None:
    page = opened(offline, document("hitch"))
    symbol = page.locator("#line-S_c msub").last
    symbol.scroll_into_view_if_needed()
    page.evaluate(SCROLLED)
    symbol.hover()
    tip = page.locator(".ms-tip")
    expect(tip).to_contain_text("cylinder hinge")
    expect(tip).to_contain_text("in 2 Geometry")
    expect(tip).to_contain_text("all depend on it")
    assert page.locator(".ms-uses").count() > 0
    page.locator("#line-S_gc msubsup > :first-child").hover()  # with an exponent over its index
    expect(tip).to_contain_text("piston diameter")


def test_a_number_that_differs_tells_the_document_s_own(document: Callable[..., Path], offline: Page) -> None:
    page = opened(offline, document("hitch"))
    places = [
        "#line-S_gc .ms-value",
        "#line-F_gc .ms-value",
        "#table-4\\.1 ~ .ms-wide tbody tr:nth-child(3) td:nth-child(2)",
    ]
    places.append(".ms-check:has-text('pressure within') .ms-compared")
    own = [page.locator(place).first.text_content() or "" for place in places]
    fill(page, "P6", "25000")

    def told(place: str) -> str:
        page.mouse.move(0, 0)
        page.locator(place).first.hover()
        tip = page.locator(".ms-tip")
        return tip.inner_text() if tip.count() and tip.is_visible() else ""

    assert told(places[0]) == ""
    for place, text in zip(places[1:], own[1:], strict=True):
        until(page, lambda at=place, x=text: told(at) == f"the document's own: {x.removeprefix(': ')}", place)


def test_symbols_and_charts_tell_by_keys(document: Callable[..., Path], offline: Page) -> None:
    page = opened(offline, document("hitch"))
    formula, tip = page.locator("#line-S_c .ms-formula"), page.locator(".ms-tip")
    formula.focus()
    page.evaluate(SCROLLED)
    page.keyboard.press("ArrowLeft")
    last = tip.inner_text()
    page.keyboard.press("ArrowRight")
    assert last and tip.inner_text() not in ("", last)
    page.keyboard.press("Escape")
    expect(tip).to_be_hidden()
    page.keyboard.press("ArrowLeft")
    page.keyboard.press("Enter")
    assert page.evaluate("document.activeElement.closest('.ms-field, .ms-line').matches(':not(#line-S_c)')")
    page.locator(".ms-figure [data-n]").first.focus()
    page.evaluate(SCROLLED)
    told = list[str]()
    for key in ("Home", "ArrowRight", "ArrowLeft", "End", "ArrowRight"):
        page.keyboard.press(key)
        told.append(tip.inner_text())
    assert told[0] == told[2] != told[1] != told[3] == told[4]


def test_a_unit_is_switched_in_place_wherever_the_quantity_is_shown(
    document: Callable[..., Path], offline: Page
) -> None:
    page = opened(offline, document("hitch"))
    first = read(page)
    value, unit = page.locator("#line-S_t .ms-value"), page.locator("#line-S_t ms-unit")
    unit.focus()
    page.keyboard.press("Enter")
    page.get_by_role("menuitemradio", name="mm", exact=True).click()
    expect(value).to_have_text("470 mm")
    expect(unit).to_be_focused()
    head = page.locator("#table-2\\.1 ~ .ms-wide .ms-units ms-unit").first
    column = page.locator("#table-2\\.1 ~ .ms-wide tbody tr:first-child td").first
    own = column.inner_text()
    assert head.inner_text() == "m"
    head.click()
    page.get_by_role("menuitemradio", name="mm", exact=True).click()
    expect(head).to_have_text("mm")
    page.evaluate(SETTLED)
    assert float(column.inner_text()) == pytest.approx(1000 * float(own))
    fill(page, "S_max", "0.7")
    page.evaluate(SETTLED)
    assert "mm" in value.inner_text()
    page.locator(".ms-back").click()
    for place in (unit, head):
        place.click()
        page.get_by_role("menuitemradio", name="m", exact=True).click()
    assert read(page) == first


def test_where_a_field_is_least_is_told_in_the_unit_that_is_chosen(
    document: Callable[..., Path], offline: Page
) -> None:
    page = opened(offline, document("guide"))
    where, unit = page.locator("#line-M .ms-where"), page.locator("#line-phi ms-unit")
    own = where.inner_text()
    assert own.startswith("least at φ = 0°") and own.endswith("°")
    for name, told in (("rad", "least at φ = 0 rad, greatest at φ = 1.8326 rad"), ("°", own)):
        unit.click()
        page.get_by_role("menuitemradio", name=name, exact=True).click()
        expect(where).to_have_text(told)


def test_a_long_table_shows_the_rows_at_both_ends(document: Callable[..., Path], offline: Page) -> None:
    page = opened(offline, document("hitch"))
    table = page.locator("#table-4\\.1 ~ .ms-wide table").first
    rows, foot = table.locator("tbody tr"), table.locator("tfoot")
    least, greatest = (rows.nth(k).locator("td").first.inner_text() for k in (0, -1))
    fill(page, "N_pol", str(2 * ENDS + 50))
    expect(foot).to_have_text(f"rows {ENDS + 1} to {ENDS + 50} of {2 * ENDS + 50} are not shown")
    expect(rows).to_have_count(2 * ENDS)
    assert [rows.nth(k).locator("td").first.inner_text() for k in (0, -1)] == [least, greatest]
    fill(page, "N_pol", "150")
    expect(rows).to_have_count(150)
    expect(foot).to_have_text("")


def test_texts_of_inputs_are_no_markup(tmp_path: Path, offline: Page) -> None:
    evil = "<img src=x onerror=alert(1)>"
    source = (ROOT / "lib" / "mechsheet" / "run" / "new_worksheet.txt").read_text(encoding="utf-8")
    worksheet = tmp_path / "evil.py"
    text = source.replace("TITLE", "Evil <b>title</b>")
    line = re.search(r"\n    \w+: float = [^\n]*\n", text)
    assert line
    text = text.replace(line[0], f'{line[0]}    note: str = "{evil}"  # <i>what</i> it is\n', 1)
    worksheet.write_text(text, encoding="utf-8")
    sheet = load(worksheet)
    path = tmp_path / "evil.html"
    path.write_text(write.page(sheet, sheet.inputs()), encoding="utf-8")
    page = opened(offline, path, f"note={quote(evil + '&<script>')}")
    assert page.locator("main img").count() == 0
    assert page.locator("#input-note").input_value().startswith(evil)
    assert page.title() == "Evil <b>title</b>"
    assert page.locator(".ms-meaning i", has_text="what").count() == 0


@pytest.mark.parametrize("name", ["hitch_design", "accuracy"])
def test_a_worksheet_of_searches_or_measurements_is_refused_in_a_line(name: str, tmp_path: Path) -> None:
    done = as_command(html, ROOT / "worksheets" / f"{name}.py", f"--out={tmp_path}")
    assert done.returncode == 1
    assert re.fullmatch(rf"error: {name} computes by \w+, over many runs: a page cannot follow that\n", done.stderr)
    assert list(tmp_path.iterdir()) == []


def test_the_command_writes_the_page_with_the_inputs_given(document: Callable[..., Path], tmp_path: Path) -> None:
    """The same in two runs, whatever order they have for what is in no order: it is kept in versions."""
    sheet, given = str(ROOT / "worksheets" / "slotted_link.py"), SHEETS["slotted_link"]
    command = [sys.executable, "-m", "mechsheet", "html", sheet, f"--out={tmp_path}"]
    command += [f"--{name}={value}" for name, value in given.items()]
    seed = "2" if os.environ.get("PYTHONHASHSEED") == "1" else "1"
    environment = {**os.environ, "PYTHONHASHSEED": seed}
    done = subprocess.run(command, env=environment, capture_output=True, encoding="utf-8", timeout=WITHIN)
    assert done.returncode == 0, done.stderr
    path = tmp_path / "slotted_link.html"
    text = path.read_text(encoding="utf-8")
    assert done.stdout == f"written {path}, {round(len(text.encode()) / 1000)} kB\n"
    assert text == document("slotted_link", **given).read_text(encoding="utf-8")


def test_the_button_of_the_page_writes_it_with_the_inputs_there(serve: Any, page: Page, offline: Page) -> None:
    page.goto(serve("run", ROOT / "worksheets" / "examples" / "bucket.py"))
    page.get_by_text("Page in one file").wait_for()
    with page.expect_download() as saved:
        page.get_by_text("Page in one file").click()
    path = saved.value.path().rename(saved.value.path().with_suffix(".html"))
    expect(opened(offline, path).locator(".ms-state")).to_have_text("as in the document")
