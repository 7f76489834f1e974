"""The inputs of a page as a whole: steps back and on, the document's own, the address that carries them, a scene."""

from __future__ import annotations

import re
import shutil
import tomllib
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

import pytest
from conftest import ROOT, WITHIN, drawn, until
from playwright.sync_api import Route, expect

from mechsheet import evaluate, units

if TYPE_CHECKING:
    from playwright.sync_api import Page


@pytest.fixture(scope="module")
def press(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The guide with two scenes beside it, one of which is refused, and one of another worksheet."""
    folder = tmp_path_factory.mktemp("press")
    scenes = {"short": "r = 52\nF = '40,5'\n", "turned": "r = -1\n", "other": "L4 = 0.5\n"}
    for name, text in scenes.items():
        (folder / f"{name}.toml").write_text(f"[inputs]\n{text}", encoding="utf-8")
    return Path(shutil.copy(ROOT / "worksheets" / "guide.py", folder / "press.py"))


def fill(page: Page, name: str, text: str) -> None:
    field = page.locator(f'td[data-input="{name}"] input')
    field.fill(text)
    field.blur()


def let_go(page: Page, held: list[Route]) -> None:
    """Send what the fields have told meanwhile."""
    while held:
        held.pop(0).continue_()
    page.unroute("**/set_ui_element_value")


def test_a_step_back_and_on_the_documents_own_and_a_link(
    press: Path, left_open: Callable[[Path, str], Page], tmp_path: Path
) -> None:
    page = left_open(press, "as in the document")
    states, field = page.locator("ms-states"), page.locator('td[data-input="r"] input')
    own = field.input_value()
    fill(page, "r", "52")
    expect(states).to_contain_text(re.compile(rf"r = 52 mm \({own} in the document\)"))
    until(page, lambda: page.url.endswith("#r=52"), "the address has not followed")
    fill(page, "r", "0,055 m")
    expect(states).to_contain_text("r = 55 mm")
    fill(page, "r", "-1")
    expect(states).to_contain_text("not computed with what the fields say")
    expect(states).not_to_contain_text("in the document)")  # 55 mm, which no field shows
    for name in ("save as a scene", "copy a link"):  # either would carry other inputs than those that are seen
        expect(states.get_by_role("button", name=name)).to_be_disabled()
    states.get_by_role("button", name="undo").dblclick()  # the second one before the page has computed the first
    expect(states).to_contain_text("r = 52 mm")
    states.get_by_role("button", name="redo").click()
    expect(states).to_contain_text("r = 55 mm")
    with page.expect_download() as saved:
        states.get_by_role("button", name="save as a scene").click()
    saved.value.save_as(tmp_path / "scene.toml")
    assert tomllib.loads((tmp_path / "scene.toml").read_text(encoding="utf-8")) == {"inputs": {"r": 55}}
    until(page, lambda: page.url.endswith("#r=55"), "the address has not followed")
    page.reload()  # with the address as it is
    expect(states).to_contain_text("r = 55 mm", timeout=WITHIN * 1000)
    states.get_by_role("button", name="back to the document").click()
    expect(states).to_contain_text("as in the document")
    expect(field).to_have_value(own)
    until(page, lambda: "#" not in page.url, "the address has not followed")


def test_undo_and_redo_hold_however_long_the_page_computes(press: Path, left_open: Callable[[Path, str], Page]) -> None:
    """With what it was computing before, too: that is no step of its own."""
    page = left_open(press, "as in the document")
    states, held = page.locator("ms-states"), list[Route]()
    for text, told in (("52", "r = 52 mm"), ("0,055 m", "r = 55 mm")):
        fill(page, "r", text)
        expect(states).to_contain_text(told)
    fill(page, "r", "-1")
    expect(states).to_contain_text("not computed with what the fields say")
    page.route("**/set_ui_element_value", lambda route: held.append(route))
    states.get_by_role("button", name="undo").dblclick()
    until(page, lambda: bool(held), "the fields have told of nothing")
    page.wait_for_timeout(1500)  # a slow machine
    let_go(page, held)
    expect(states).to_contain_text("r = 52 mm")
    expect(states.get_by_role("button", name="redo")).to_be_enabled()
    states.get_by_role("button", name="redo").click()
    expect(states).to_contain_text("r = 55 mm")
    expect(states.get_by_role("button", name="redo")).to_be_disabled()
    for told in ("r = 52 mm", "as in the document"):
        states.get_by_role("button", name="undo").click()
        expect(states).to_contain_text(told)


KINDS = """\
import marimo

app = marimo.App()

with app.setup:
    from typing import Literal

    from mechsheet import Used, ask, inputs, read


@app.class_definition
@inputs
class Given:
    a: float = 0.6  # [m] width; > 0
    duty: Literal["light", "heavy"] = "light"  # service
    spare: bool = False  # one in reserve
    parts: list[float] = [1.0, 2.0, 3.0]  # [-] parts; > 0

    \"""Rows.\"""


@app.cell
def _():
    form = ask(Given)
    form
    return (form,)


@app.cell
def _(form):
    g = read(Given, form)
    Used(g)
    return (g,)


if __name__ == "__main__":
    app.run()
"""
OWN = {"a": "0.6", "duty": "light", "spare": "no", "parts": "1; 2; 3"}


@pytest.fixture(scope="module")
def kinds(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A worksheet with an input of each kind that a field has."""
    path = tmp_path_factory.mktemp("kinds") / "kinds.py"
    path.write_text(KINDS, encoding="utf-8")
    return path


def computed(page: Page, **others: str) -> None:
    """Wait until the page has computed with its own inputs but for these, and its fields show them."""
    told = "(JSON.parse(document.querySelector('ms-used')?.getAttribute('told') ?? '[]'))"
    known = f"Object.fromEntries({told}.map(({{ name, text }}) => [name, text]))"
    until(page, lambda: page.evaluate(known) == OWN | others, f"it has not computed with {others}")
    expect(page.locator('td[data-input="a"] input')).to_have_value((OWN | others)["a"])
    expect(page.locator('td[data-input="duty"] select option:checked')).to_have_text((OWN | others)["duty"])
    expect(page.get_by_role("checkbox")).to_be_checked(checked="spare" in others)
    rows = page.locator("ms-grid input").evaluate_all("all => all.map(each => each.value).filter(Boolean).join('; ')")
    assert rows == (OWN | others)["parts"]


def part(page: Page, row: int, text: str) -> None:
    page.get_by_label(f"parts, row {row}").fill(text)
    page.keyboard.press("Enter")


@pytest.mark.parametrize("kind", OWN)
def test_a_step_back_and_on_at_once_is_none(kinds: Path, left_open: Callable[[Path, str], Page], kind: str) -> None:
    """Of fields of every kind, whatever the page is still computing."""
    page = left_open(kinds, "as in the document")
    states, held = page.locator("ms-states"), list[Route]()
    match kind:
        case "a":
            fill(page, "a", "0.7")
        case "duty":
            page.locator('td[data-input="duty"] select').select_option("heavy")
        case "spare":
            page.get_by_role("checkbox").click()
        case "parts":
            part(page, 2, "5")
    changed = {kind: {"a": "0.7", "duty": "heavy", "spare": "yes", "parts": "1; 5; 3"}[kind]}
    computed(page, **changed)
    page.route("**/set_ui_element_value", lambda route: held.append(route))
    states.get_by_role("button", name="undo").click()
    until(page, lambda: bool(held), "the field has told of nothing")
    states.get_by_role("button", name="redo").click()
    page.wait_for_timeout(500)
    let_go(page, held)
    computed(page, **changed)
    states.get_by_role("button", name="undo").click()
    computed(page)


def test_what_a_grid_refuses_is_taken_back_alone(kinds: Path, left_open: Callable[[Path, str], Page]) -> None:
    page = left_open(kinds, "as in the document")
    states = page.locator("ms-states")
    part(page, 2, "abc")
    expect(states).to_contain_text("not computed with what the fields say")
    states.get_by_role("button", name="back to the document").click()
    computed(page)
    part(page, 2, "5")
    computed(page, parts="1; 5; 3")
    part(page, 2, "-1")
    expect(states).to_contain_text("not computed with what the fields say")
    states.get_by_role("button", name="undo").click()
    computed(page, parts="1; 5; 3")
    states.get_by_role("button", name="undo").click()
    computed(page)


def test_undo_takes_back_what_the_page_has_not_computed_yet(
    kinds: Path, left_open: Callable[[Path, str], Page]
) -> None:
    page = left_open(kinds, "as in the document")
    held = list[Route]()
    for text in ("0.7", "0.8"):
        fill(page, "a", text)
        computed(page, a=text)
    page.route("**/set_ui_element_value", lambda route: held.append(route))
    fill(page, "a", "0.9")
    until(page, lambda: bool(held), "the field has told of nothing")
    page.locator("ms-states").get_by_role("button", name="undo").click()
    let_go(page, held)
    computed(page, a="0.8")


def test_a_page_that_is_opened_again_shows_what_the_editor_computes_with(
    kinds: Path, serve: Callable[[str, Path], str], page: Page
) -> None:
    """Also where its address has not followed: the fields had begun anew, and stood there beside other numbers."""
    address = serve("edit", kinds)
    page.goto(address)
    page.get_by_text("as in the document").first.wait_for()
    fill(page, "a", "0.7")
    computed(page, a="0.7")
    part(page, 2, "5")
    computed(page, a="0.7", parts="1; 5; 3")
    page.goto("about:blank")
    page.goto(address)
    page.get_by_text("copy a link").first.wait_for()
    expect(page.locator('td[data-input="parts"] input').nth(1)).to_have_value("5")
    computed(page, a="0.7", parts="1; 5; 3")


# A field takes it as from the hand; the page does not know of it, as of what is typed before its scripts are there.
UNHEARD = """(field, text) => {
  Object.getOwnPropertyDescriptor(HTMLInputElement.prototype, "value").set.call(field, text);
  field.dispatchEvent(new InputEvent("input", {bubbles: true}));
}"""


def test_what_is_typed_before_the_page_listens_stays(kinds: Path, left_open: Callable[[Path, str], Page]) -> None:
    """The field took its former text again when the page told what it had computed, and the user's was lost."""
    page = left_open(kinds, "as in the document")
    field = page.locator('td[data-input="a"] input')
    field.evaluate(UNHEARD, "0.7")
    page.evaluate("document.querySelector('ms-states').follow()")
    drawn(page)
    expect(field).to_have_value("0.7")
    field.press("Enter")
    computed(page, a="0.7")


def test_a_link_that_is_pasted_into_the_open_page_holds(kinds: Path, left_open: Callable[[Path, str], Page]) -> None:
    """For all inputs, as in a page that is opened by it: it carries those that differ from the document."""
    page = left_open(kinds, "as in the document")
    part(page, 2, "5")
    computed(page, parts="1; 5; 3")
    page.evaluate("location.hash = 'a=700 mm&duty=heavy'")
    expect(page.locator("ms-states")).to_contain_text("a = 0.7 m")
    expect(page.locator("ms-states")).not_to_contain_text("parts")
    page.locator("ms-states").get_by_role("button", name="undo").click()
    computed(page, parts="1; 5; 3")
    page.locator("ms-states").get_by_role("button", name="redo").click()
    computed(page, a="0.7", duty="heavy")


def test_what_a_link_gives_that_no_input_takes_is_told(kinds: Path, left_open: Callable[[Path, str], Page]) -> None:
    page = left_open(kinds, "as in the document")
    states = page.locator("ms-states")
    page.evaluate("location.hash = 'a=700 mm&duty=medium&foo=3'")
    expect(states).to_contain_text("a = 0.7 m")
    expect(states).to_contain_text("duty has no option medium; there is no input foo")
    states.get_by_role("button", name="back to the document").click()
    expect(states).not_to_contain_text("foo")
    computed(page)


DEAF_ONCE = """() => {
  const own = EventTarget.prototype.dispatchEvent;
  EventTarget.prototype.dispatchEvent = function (event) {
    if (!(event instanceof FocusEvent)) return own.call(this, event);
    EventTarget.prototype.dispatchEvent = own;
    return true;
  };
}"""


def test_a_field_that_does_not_listen_yet_is_told_again(press: Path, left_open: Callable[[Path, str], Page]) -> None:
    page = left_open(press, "as in the document")
    states = page.locator("ms-states")
    fill(page, "r", "52")
    expect(states).to_contain_text("r = 52 mm")
    page.evaluate(DEAF_ONCE)
    states.get_by_role("button", name="undo").click()
    expect(states).to_contain_text("as in the document")


AT_ONCE = """(texts) => Object.entries(texts).forEach(([name, text]) => {
  const host = document.querySelector(`td[data-input="${name}"] marimo-ui-element > *`);
  const field = host.shadowRoot.querySelector("input");
  Object.getOwnPropertyDescriptor(HTMLInputElement.prototype, "value").set.call(field, text);
  field.dispatchEvent(new InputEvent("input", { bubbles: true }));
  field.dispatchEvent(new FocusEvent("focusout", { bubbles: true }));
})"""


def test_fields_that_change_while_the_page_computes_all_arrive(
    press: Path, left_open: Callable[[Path, str], Page]
) -> None:
    page = left_open(press, "as in the document")
    states, told = page.locator("ms-states"), list[str]()
    page.on("request", lambda request: "set_ui_element" in request.url and told.append(request.url))
    page.evaluate(AT_ONCE, {"r": "53", "l": "250", "F": "41", "h": "15"})
    for changed in ("r = 53 mm", "l = 250 mm", "F = 41 kN", "h = 15 mm"):
        expect(states).to_contain_text(changed)

    before = len(told)
    for name, value in (("r", "54"), ("l", "251"), ("h", "16")):
        fill(page, name, value)
        expect(states).to_contain_text(f"{name} = {value} mm")
    assert len(told) == before + 3, "a field and the element beside it both told of a change"


def test_a_symbol_tells_what_it_stands_for_and_leads_there(press: Path, left_open: Callable[[Path, str], Page]) -> None:
    page = left_open(press, "as in the document")
    formula = page.locator("#line-M math")
    formula.scroll_into_view_if_needed()
    formula.locator("mi", has_text="F").hover()
    tip = page.locator(".ms-tip:visible")
    expect(tip).to_contain_text("force on the ram, constant over its way")
    expect(tip).to_contain_text("input: 50 kN")
    expect(tip).to_contain_text("in 1 An input")
    expect(page.locator("#line-M")).to_have_class(re.compile("ms-uses"))
    expect(page.locator("#line-s_k")).not_to_have_class(re.compile("ms-(uses|depends)"))
    formula.locator("mi", has_text="M").hover()
    expect(tip).to_contain_text("moment")
    formula.locator("mi", has_text="M").click()
    expect(tip, "it would lie over the line that the editor opens there").to_have_count(0)
    formula.locator("mi", has_text="F").click()
    expect(page.locator('td[data-input="F"] input')).to_be_focused()


def test_a_scene_beside_the_worksheet_is_chosen_from_a_list(
    press: Path, left_open: Callable[[Path, str], Page]
) -> None:
    page = left_open(press, "as in the document")
    states = page.locator("ms-states")
    chosen = states.get_by_role("combobox", name="scenes")
    texts = chosen.locator("option").all_text_contents()
    assert texts[:2] == ["a scene", "short"] and len(texts) == 3
    assert texts[2].startswith("turned: ") and "must be positive" in texts[2]
    expect(chosen.locator("option").nth(2)).to_be_disabled()
    fill(page, "l", "250")
    expect(states).to_contain_text("l = 250 mm")
    chosen.select_option(label="short")
    expect(states).to_contain_text("r = 52 mm")
    expect(states).to_contain_text("F = 40.5 kN")
    expect(states).not_to_contain_text("l = 250 mm")
    expect(chosen).to_have_value("0")
    until(page, lambda: page.url.endswith("#r=52&F=40.5"), "the address has not followed")
    page.reload()  # with two inputs in the address
    expect(states).to_contain_text("r = 52 mm", timeout=WITHIN * 1000)
    expect(states).to_contain_text("F = 40.5 kN")
    fill(page, "r", "53")
    expect(states).to_contain_text("r = 53 mm")
    expect(chosen.locator("option:checked")).to_have_text("a scene")


LATE = """(() => {
  const define = customElements.define.bind(customElements);
  customElements.define = (name, kind, options) =>
    name === "marimo-text" ? setTimeout(() => define(name, kind, options), 2000) : define(name, kind, options);
  const bar = () => document.querySelector("ms-states");
  const again = () => (bar()?.textContent ? bar().replaceWith(bar().cloneNode(true)) : setTimeout(again, 50));
  again();
})()"""


def test_what_a_link_carries_waits_for_fields_that_are_drawn_late(
    press: Path, left_open: Callable[[Path, str], Page]
) -> None:
    """And for the bar of the states, which may be drawn anew meanwhile."""
    page = left_open(press, "as in the document")
    other = page.context.new_page()
    other.add_init_script(LATE)
    other.goto(page.url.partition("#")[0] + "#r=51&F=39")
    states = other.locator("ms-states")
    expect(states).to_contain_text("r = 51 mm", timeout=WITHIN * 1000)
    expect(states).to_contain_text("F = 39 kN")
    other.close()


def test_what_the_address_says_of_the_worksheet_stays(press: Path, left_open: Callable[[Path, str], Page]) -> None:
    """As its file where a server has several: inputs stand behind it, and a link within the page leads not out of it.

    The page has a base, to which what begins with # alone would lead.
    """
    page = left_open(press, "as in the document")
    fill(page, "r", "52")
    there = re.compile(r"/\?file=[^#]*press\.py#r=52$")
    expect(page).to_have_url(there)
    link = page.locator("#checks a").last
    link.click()
    expect(page.locator(link.get_attribute("href") or "")).to_be_in_viewport()
    expect(page).to_have_url(there)


def test_what_differs_from_the_document_is_marked_with_its_own_numbers(
    press: Path, left_open: Callable[[Path, str], Page]
) -> None:
    page = left_open(press, "as in the document")
    marked = page.locator("[data-own]")
    page.get_by_text("what differs from the document").click()
    page.locator("ms-own").wait_for(state="attached")
    expect(marked).to_have_count(0)
    fill(page, "r", "52")
    expect(page.locator("#line-H .ms-value")).to_have_attribute("data-own", "120\u00a0mm")
    expect(page.locator("tr:has(> .ms-changed)")).to_have_count(1)
    rows = page.locator(".ms-table:has(#table-1) tbody tr")
    until(page, lambda: rows.first.locator("[data-own]").count() == 1, "the table is not marked")

    found = [evaluate(press, ["s_k", "M"], **given) for given in ({}, {"r": 52})]
    shown = [
        [[f"{x / units.parse(unit).factor:.{digits}f}" for x in each[name]] for each in found]
        for name, unit, digits in (("s_k", "mm", 1), ("M", "N*m", 0))
    ]
    for column, (own, now) in enumerate(shown, start=1):
        for row, (before, after) in enumerate(zip(own, now, strict=True)):
            told = rows.nth(row).locator("td").nth(column).get_attribute("data-own")
            assert told == (None if before.strip("-") == after.strip("-") else before), (column, row)
    assert page.locator("#line-phi .ms-value").get_attribute("data-own") is None
    page.locator("ms-states").get_by_role("button", name="back to the document").click()
    expect(marked).to_have_count(0)
    page.get_by_text("what differs from the document").click()
    expect(page.locator("ms-own")).to_have_count(0)
