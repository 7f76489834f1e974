"""A served page tells, in a real browser, why a cell has failed: marimo leaves its place empty, and tells its log."""

import re
from collections.abc import Callable, Iterator
from pathlib import Path

import marimo as mo
import pytest
from conftest import marimo_server, placed
from playwright.sync_api import Page, expect

from mechsheet import __main__ as launcher
from mechsheet.html import write
from mechsheet.page import values
from mechsheet.worksheet import cells
from mechsheet.worksheet.shown import Charted

LEVER = (Path(launcher.__file__).parent / "run" / "new_worksheet.txt").read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def served(chromium: str, tmp_path_factory: pytest.TempPathFactory) -> Iterator[tuple[str, Path]]:
    """Address of a served worksheet, and its file, which every page that is opened reads anew."""
    folder = tmp_path_factory.mktemp("served")
    sheet = folder / "lever.py"
    sheet.write_text(LEVER, encoding="utf-8")
    copy = placed(sheet, folder)
    with marimo_server("run", copy, folder) as address:
        yield address, copy


@pytest.fixture
def planted(served: tuple[str, Path], page: Page) -> Callable[..., Page]:
    """A page of the worksheet with some of its text replaced."""

    def opened(*faults: tuple[str, str]) -> Page:
        text = LEVER
        for old, new in faults:
            assert text.count(old) == 1, old
            text = text.replace(old, new)
        served[1].write_text(text, encoding="utf-8")
        page.goto(served[0])
        return page

    return opened


def expect_told(page: Page, *failures: str) -> None:
    """Expect that these failures stand on the page, in their order, and no other; their ends are left open."""
    expect(page.locator("ms-failed")).to_have_count(len(failures))
    for place, text in zip(page.locator("ms-failed").all(), failures, strict=True):
        place.get_by_text(f"lever.py, {text}").wait_for()


def waiting(page: Page) -> dict[str, str]:
    """What each section is said to wait for, by the number of its heading."""
    said = page.locator(".marimo-cell:has(h2, h3)").evaluate_all(
        'all => all.map(e => [e.innerText.split(/\\s/)[0], getComputedStyle(e, "::after").content])'
    )
    return {section: text.strip('"') for section, text in said if text != "none"}


def test_a_mistake_in_a_function_is_told_at_the_cell_that_calls_it(planted: Callable[..., Page]) -> None:
    page = planted(("* sin(phi)  #", "* sin(phi) / g.parts[7]  #"))
    expect_told(
        page,
        "line 88, return g.F * g.L * sin(phi) / g.parts[7]: g.parts has 3 values, counted from 0: there is none at 7",
    )
    assert waiting(page) == {"2.1": "waits for section 2", "3": "waits for section 2"}
    page.set_viewport_size({"width": 1280, "height": 3000})
    expect(page.locator(".ms-bar"), "the mistake itself is in sight").to_be_hidden()
    page.set_viewport_size({"width": 1280, "height": 200})
    expect(page.locator(".ms-bar")).to_contain_text("not computed to its end lever.py, line 88")


def test_of_several_cells_each_tells_its_own(planted: Callable[..., Page]) -> None:
    page = planted(
        ("phi, M_S)\n", "phi, M_S[99])\n"), ('    export("TITLE", globals())', '    figure("2", "A", phi, {}["M"])')
    )
    expect_told(page, "line 144, table_1 = table(", 'line 153, figure("2", "A", phi, {}["M"]): {} has no ')
    assert waiting(page) == {}
    page.evaluate("scrollTo(0, 0)")
    expect(page.locator(".ms-bar")).to_contain_text("2 of 2 checks")
    expect(page.locator(".ms-bar")).to_contain_text("M_S[99]): M_S has 7 values, counted from 0: there is none at 99")


def test_what_stops_everything_is_told_at_the_top(planted: Callable[..., Page]) -> None:
    page = planted(("    STEELS = {", '    STEELS = {"x": {}["y"]} | {'))
    expect_told(page, 'line 19, STEELS = {"x": {}["y"]}')
    assert waiting(page) == dict.fromkeys(("1", "2", "2.1", "2.2", "3"), "waits for the setup")
    page = planted(("M_n = g.parts", "M_n = (g.parts"))  # of what cannot be read nobody knows what waits
    expect_told(page, *["line 127, M_n = (g.parts * g.F * g.L / n: '(' was never closed"] * 2)


STOPS = {
    "words": ('mo.stop(g.F > 0, mo.md("**Weigh** the _load_ first"))', "Weigh the load first"),
    "button": ('mo.stop(g.F > 0, mo.ui.button(label="go on"))', "stopped here by mo.stop"),
}


@pytest.mark.parametrize("stop", STOPS)
def test_what_the_author_stops_is_told_at_its_cell_and_elsewhere_what_waits_for_it(
    planted: Callable[..., Page], stop: str
) -> None:
    call, told = STOPS[stop]
    shown = "    typeset(table_1, figure_1, table_2)\n"
    page = planted(("    phi = ", f"    {call}\n    phi = "), (shown, f'    "Of **any** load."\n{shown}'))
    expect(page.locator("ms-failed")).to_have_count(1)
    if stop == "button":
        expect(page.locator("ms-failed").get_by_role("button", name="go on")).to_be_visible()
    else:
        expect(page.locator("ms-failed")).to_contain_text(told)
    assert waiting(page) == {"2.1": "waits for section 2", "3": "waits for section 2"}
    expect(page.get_by_text("Of any load."), "needs no number").to_be_visible()
    page.set_viewport_size({"width": 1280, "height": 200})
    expect(page.locator(".ms-bar")).to_contain_text(f"not computed to its end {told}")
    assert "ancestor" not in page.locator("body").inner_text()


# Nothing but the verdict of the solve block tells that there is no such angle: no check and no number rests on it.
UNFOUND = [
    ("M_max: float = 300.0", "M_max: float = 500.0"),
    ("phi_max = phi_found.value", "phi_max = pi / 2"),
    ("M(phi_max) - g.M_max, 1e-12", "M_S, 500"),
    (', "N*m", of=g.M_max)', ', "N*m")'),
]


def test_what_is_not_found_is_told_beside_checks_that_pass(planted: Callable[..., Page]) -> None:
    page = planted(*UNFOUND)
    expect(page.locator(".ms-summary")).to_contain_text("2 of 2 checks pass")
    page.set_viewport_size({"width": 1280, "height": 200})
    expect(page.locator(".ms-bar")).to_contain_text(re.compile("not found *angle φ"))
    page.set_viewport_size({"width": 1280, "height": 6000})
    expect(page.locator(".ms-bar"), "it is in sight").to_be_hidden()


def test_what_is_not_found_is_told_beside_checks_that_pass_in_one_file(tmp_path: Path, page: Page) -> None:
    text = LEVER
    for old, new in UNFOUND:
        assert text.count(old) == 1, old
        text = text.replace(old, new)
    (tmp_path / "lever.py").write_text(text, encoding="utf-8")
    sheet = cells.load(tmp_path / "lever.py")
    (tmp_path / "lever.html").write_text(write.page(sheet, sheet.inputs()), encoding="utf-8")
    page.goto((tmp_path / "lever.html").as_uri())
    expect(page.locator(".ms-summary b")).to_have_text("2 of 2 checks pass; 1 not found")
    page.locator("#input-M_max").fill("300")
    expect(page.locator(".ms-summary b")).to_have_text("2 of 2 checks pass")


def test_a_stop_without_a_word_says_that_it_is_one_and_a_refusal_is_told_once() -> None:
    assert "stopped here by mo.stop, which says nothing" in values.stopped(None, "1")
    assert values.stopped(mo.Html(values.failed("F must be > 0")), "1") == ""


def test_what_cannot_be_shown_is_told_where_it_stands() -> None:
    class Broken(Charted):
        def chart(self) -> object:
            return [][1]

    kind, text = values.written(Broken())
    assert kind == "text/html" and "this Broken cannot be shown: [] is empty: there is none at 1" in text


def test_a_worksheet_that_cannot_be_read_is_named_before_it_is_served(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    good, bad = tmp_path / "good.py", tmp_path / "bad.py"
    good.write_text("a = 1\n", encoding="utf-8")
    bad.write_text("a = (1\n", encoding="utf-8")
    called = list[list[str]]()
    monkeypatch.setattr(launcher, "call", lambda command, **_: called.append(command) or 0)
    assert launcher.page("serve", [str(bad)], []) == 1 and not called
    assert capsys.readouterr().err == "mechsheet: bad.py, line 1, a = (1: '(' was never closed\n"
    assert launcher.page("serve", [str(bad), str(good)], []) == 0
    assert called[0][-1] == str(good) and str(bad) not in called[0]


def test_a_check_that_only_the_summary_shows_is_judged_in_one_file(tmp_path: Path, page: Page) -> None:
    """Checks in a list too: without a place of its own the page's script stopped, and everything stayed as it was."""
    text = LEVER.replace("summary(within, strong)", "summary(within, [strong])").replace("typeset(strong)", "typeset()")
    (tmp_path / "lever.py").write_text(text, encoding="utf-8")
    sheet = cells.load(tmp_path / "lever.py")
    (tmp_path / "lever.html").write_text(write.page(sheet, sheet.inputs()), encoding="utf-8")
    page.goto((tmp_path / "lever.html").as_uri())
    page.locator("#input-F").fill("5000")
    expect(page.locator(".ms-summary b")).to_have_text("1 of 2 checks pass, 1 fail")
    expect(page.locator("#check-stress")).to_contain_text("FAIL stress: 875 > 235 MPa")
    expect(page.locator(".ms-state")).to_have_text("changed: F")
