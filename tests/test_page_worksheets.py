"""Every worksheet in a real browser: it opens computed, and a changed input changes its tables."""

import re
from pathlib import Path

import pytest
from conftest import SIZE, until
from playwright.sync_api import expect

WORKSHEETS = Path(__file__).parents[1] / "worksheets"
# an input of each sheet by its meaning, and a new value for it
CHANGED = {
    "accuracy": ("positions of the hitch", "1"),  # which is refused: another number would be measured for a minute
    "guide": ("force on the ram", "40"),
    "hitch": ("weight of the implement", "30000"),
    "hitch_design": ("weight of the implement", "26500"),
    "landing_gear": ("mass", "1000"),
    "slotted_link": ("angular velocity of the crank", "-12,5"),
    "kinetostatics": ("rod AB", "0.43"),
    "joint": ("radius of the joint", "65"),
    "bucket": ("pressure", "30"),
    "engine": ("bore", "90"),
    "bolted_joint": ("friction in the thread", "0,1"),
}

# in the setup of the accuracy worksheet: what is measured there, in part, each once
LESS = """from mechsheet.accuracy import claims, conditioning, extreme, timing

    timing.TURNS, timing._LONG = 1, 0.0
    claims.DOCUMENTS = conditioning.DOCUMENTS = ("slotted_link",)
    extreme.scenes = lambda: [extreme.read(path) for path in sorted(extreme.SCENES.glob("*.toml"))[::6]]"""

# numbers in the cells of lists and tables that have no room there
CUT = "[...document.querySelectorAll('ms-grid input')].filter(e => e.scrollWidth > e.clientWidth).map(e => e.value)"


def test_every_worksheet_is_opened():
    assert set(CHANGED) == {path.stem for path in WORKSHEETS.rglob("*.py")}


def tables(page) -> str:
    return "\n".join(page.locator(".ms-table").all_text_contents())


def assert_fits_a_telephone(page) -> None:
    """What is wider is moved under the hand by itself, and not the page with it."""
    page.set_viewport_size({"width": 400, "height": 900})
    page.evaluate("document.documentElement.classList.add('ms-measure')")
    until(page, lambda: page.evaluate("document.querySelector('#App').scrollWidth") == 400, "the page is wider")
    page.evaluate("document.documentElement.classList.remove('ms-measure')")
    page.set_viewport_size(SIZE)


def assert_fits_on_paper(page) -> None:
    """What is wider than a sheet widens the whole page, which is cut at its edge; a list leaves the meanings room."""
    size = page.viewport_size
    page.emulate_media(media="print")
    page.set_viewport_size({"width": 718, "height": 1000})
    assert page.evaluate("document.getElementById('App').getBoundingClientRect().right - innerWidth") <= 0
    squeezed = """all => all.filter(e => {
      const text = document.createRange();
      text.selectNodeContents(e);
      return text.getClientRects().length > 1 && e.clientWidth < 300;
    }).map(e => e.textContent)"""
    meanings = page.locator(".ms-print:has(table) > tbody > tr > td:last-child:not(:only-child)")
    assert meanings.evaluate_all(squeezed) == []
    page.set_viewport_size(size)
    page.emulate_media(media="null")


def measured_once(folder: Path) -> Path:
    """The accuracy worksheet of a few scenes, without repeats and large sizes: a page shows all as it shows these."""
    text = (WORKSHEETS / "accuracy.py").read_text("utf-8")
    folder_of = "folder = Path(__file__).parent"
    for own, less in (
        ("return 0.01", "return 1e-6"),
        ("sizes = (1, 10, 1000, 100_000)", "sizes = (1, 2, 3)"),
        ("else 10_000)", "else 100)"),
        (folder_of, f"{LESS}\n    {folder_of}"),
    ):
        assert text.count(own) == 1, own
        text = text.replace(own, less)
    path = folder / "accuracy.py"
    path.write_text(text, "utf-8")
    return path


@pytest.mark.parametrize("name", sorted(CHANGED))
def test_opens_and_reacts(name, left_open, tmp_path):
    meaning, value = CHANGED[name]
    path = measured_once(tmp_path) if name == "accuracy" else next(WORKSHEETS.rglob(f"{name}.py"))
    page = left_open(path, "Excel workbook")
    count = page.get_by_text(re.compile(r"^\d+ of \d+ checks pass$")).first
    count.wait_for()
    passed, checks = re.findall(r"\d+", count.text_content())
    assert passed == checks
    assert page.evaluate(CUT) == []
    assert_fits_on_paper(page)
    assert_fits_a_telephone(page)
    before = tables(page)
    field = page.locator(f".ms-inputs tr:has-text('{meaning}') input").first
    field.fill(value)
    field.press("Enter")
    until(page, lambda: tables(page) != before, "the tables rest")
    for trouble in ("Traceback", "Something went wrong", "internal error"):
        assert page.get_by_text(trouble).count() == 0, trouble


def test_a_find_behind_what_does_not_close_waits(serve, page, console_errors):
    """The failing check tells why; the title block says that the page ends there, and no second reason."""
    page.goto(serve("run", WORKSHEETS / "examples" / "bucket.py"))
    page.get_by_text("Excel workbook").wait_for()
    field = page.locator(".ms-inputs tr:has-text('hinge of the cylinder, along the arm') input").first
    field.fill("0")
    field.press("Enter")
    page.get_by_text("nothing to solve for link").first.wait_for()
    expect(page.locator(".ms-told")).to_be_visible()
    told = page.evaluate('getComputedStyle(document.querySelector(".ms-told"), "::after").content')
    assert told == "none"
    expect(page.get_by_text("no position closes for cylinder S").first).to_be_visible()
    assert page.get_by_text("must be finite").count() == 0 and console_errors == []
