"""The inputs of a page as a whole: steps back and on, the document's own, the address that carries them, a scene."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from conftest import ROOT, WITHIN
from playwright.sync_api import expect

if TYPE_CHECKING:
    from playwright.sync_api import Page

GUIDE = ROOT / "worksheets" / "guide.py"


def fill(page: Page, name: str, text: str) -> None:
    field = page.locator(f'td[data-input="{name}"] input')
    field.fill(text)
    field.blur()


def test_a_step_back_and_on_the_documents_own_and_a_link(
    left_open: Callable[[Path, str], Page], tmp_path: Path
) -> None:
    page = left_open(GUIDE, "as in the document")
    states, field = page.locator("ms-states"), page.locator('td[data-input="r"] input')
    own = field.input_value()
    fill(page, "r", "52")
    expect(states).to_contain_text(re.compile(rf"r = 52 mm \({own} in the document\)"))
    assert page.url.endswith("#r=52")
    fill(page, "r", "0,055 m")
    expect(states).to_contain_text("r = 55 mm")
    fill(page, "r", "-1")
    expect(states).to_contain_text("not computed with what the fields say")
    states.get_by_role("button", name="undo").click()
    expect(states).to_contain_text("r = 55 mm")
    states.get_by_role("button", name="undo").click()
    expect(states).to_contain_text("r = 52 mm")
    states.get_by_role("button", name="redo").click()
    expect(states).to_contain_text("r = 55 mm")
    with page.expect_download() as saved:
        states.get_by_role("button", name="save as a scene").click()
    saved.value.save_as(tmp_path / "scene.toml")
    assert tomllib.loads((tmp_path / "scene.toml").read_text(encoding="utf-8")) == {"inputs": {"r": 55}}
    page.reload()  # with the address as it is
    expect(states).to_contain_text("r = 55 mm", timeout=WITHIN * 1000)
    states.get_by_role("button", name="back to the document").click()
    expect(states).to_contain_text("as in the document")
    expect(field).to_have_value(own)
    assert "#" not in page.url


def test_a_symbol_tells_what_it_stands_for_and_leads_there(left_open: Callable[[Path, str], Page]) -> None:
    page = left_open(GUIDE, "as in the document")
    formula = page.locator("#line-M marimo-tex")
    formula.scroll_into_view_if_needed()
    formula.locator(".katex-html .mathnormal", has_text="F").hover()
    tip = page.locator(".ms-tip:visible")
    expect(tip).to_contain_text("force on the ram, constant over its way")
    expect(tip).to_contain_text("input: 50 kN")
    expect(tip).to_contain_text("in 1 An input")
    expect(page.locator("#line-M")).to_have_class(re.compile("ms-uses"))
    expect(page.locator("#line-s_k")).not_to_have_class(re.compile("ms-(uses|depends)"))
    formula.locator(".katex-html .mathnormal", has_text="F").click()
    expect(page.locator('td[data-input="F"] input')).to_be_focused()
