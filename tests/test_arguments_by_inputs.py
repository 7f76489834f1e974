"""What an argument of a table, figure, check, drawing, caption or slider takes from an input follows it, or is gone."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from as_script import as_script
from own_worksheet import own, recorded
from playwright.sync_api import Page
from test_recalculation import edit

from mechsheet.html import write
from mechsheet.readers.numbers import numbers
from mechsheet.worksheet import inputs
from mechsheet.worksheet.cells import Worksheet, load

FIELDS = "y = 0.5 * x**2  # [-] field\non = g.k > 2\ncolour = 'red' if g.k > 2 else 'blue'"
LOST = {  # by the argument, what shows numbers that a workbook cannot show another way
    "every": "table('2', 'Words', x, y, every=g.k)",
    "every, among others": "table('3', 'Words', x, y, **{'every': g.k})",
    "decimals": "table('4', 'Words', x, y, decimals=g.k)",
    "note by another way": "table('6', 'Words', x, y, note='of %3d' % g.k)",
    "every of a figure": "figure('2', 'Words', x, y, every=g.k)",
    "labels": "figure('3', 'Words', x, y, marks={f'k_{g.k}': 1.0})",
    "essential": "Check('essential', -1.0, 2.0, essential=on)",
    "agreement": "Check('agreement', 1.0, 2.0, '-', '', False, on)",
}
WORDS = [
    "table('5', 'Words', x, y, note=f'of {g.k}')",
    "table('7', f'Words of {g.k}', x, y)",
    "table('16', 'Words', x, y, note='of %d' % g.k)",
    "figure('4', f'Words of {g.k}', x, y)",
]
FOLLOWED = [
    *WORDS,
    "figure('5', 'Words', x, y, marks={'k': 1.0 * g.k})",
    "check('limit', y, 2.0 * g.k)",
    "check(f'Words of {g.k}', y, 99.0)",
    "check('of', 1e-6 * y, 1e-3, of=y * g.k)",
    "Check('limit of a Check', 1.0, 3.5 - g.k)",
    "table('8', 'Words', five, decimals=g.k)",
]
DRAWN = [
    "Drawing(width=200 + 20 * g.k).link(0, 1, 'a')",
    "Drawing(200, 200 + 20 * g.k).link(0, 1).link(0, 1j)",
    "Drawing(frame=[-1 - 1j * g.k, g.k + 1j]).link(0, 1)",
    "Drawing(scales={'N': 0.01 * g.k}).force(0, 10, 'F')",
    "Drawing(unit='N' if g.k > 2 else 'm').link(0, 1).dimension(0, 1, 'x')",
    "Drawing().cylinder(0, 1, 'c', barrel=0.1 * g.k)",
    "Drawing().slider(0, 0.1 * g.k, 's').link(0, 1).support(0, 'A', angle=0.1 * g.k)",
    "Drawing().link(0, 1).wheel(0, 0.1 * g.k)",
    "Drawing().polygon([0, 1, 1j], f'n{g.k}', colour)",
    "Drawing().path([0, 1, 1j], 'p', colour=colour)",
    "Drawing().link(0, 1).force(0, 10, 'F', into=on)",
    "Drawing().link(0, 1).arrow(0, 10, 'F', 'N' if g.k > 2 else 'kN', colour)",
    "Drawing().link(0, 1).moment(0, 2.5 - g.k, 'M', 'N*m' if g.k > 2 else 'kN*m', colour)",
    "Drawing().link(0, 1).dimension(0, 1, 'd', 10.0 * g.k)",
    "Drawing().text(0, f'text {g.k}').link(0, 1)",
    "caption('4', f'of {g.k}'), caption('5', 'words in ' + colour), caption('6', title=f'of {g.k}')",
]
SLIDER = (
    "turn = slider(0, 10.0 * g.k, step=1.0, value=2.0 * g.k, label=f'turn of {g.k}', unit='m' if g.k > 2 else 'mm')"
)
TURNED = "z = 2 * turn.value  # [-] turned\ntypeset()"
IMPORTED = "import Check, Drawing, ask, caption, check, export, figure, find, slider"
TEXT = """() => {
  dispatchEvent(new Event("beforeprint"));
  const shown = [...document.querySelectorAll("main [data-n]")], grey = shown.map(each => Boolean(each.dataset.reason));
  globalThis.emptied = which => {
    shown.forEach((each, n) => which[n] && each.replaceChildren());
    document.querySelectorAll(".ms-bar, .ms-inputs, .ms-print").forEach(each => each.remove());
    const main = document.querySelector("main"), ranges = [...main.querySelectorAll("[type=range]")];
    const drawn = [...main.querySelectorAll("svg")].map(each => each.outerHTML);
    return [main.textContent, ...ranges.map(each => each.outerHTML), ...drawn];
  };
  return grey;
}"""


def sheet_of(tmp_path: Path, lines: str, *further: str) -> Worksheet:
    path = Path(own(tmp_path, f"five = np.arange(5.0)  # [-] numbers\n{FIELDS}\n{lines}", further=further).path)
    path.write_text(path.read_text().replace("from mechsheet import ask, find", f"from mechsheet {IMPORTED}", 1))
    return load(path)


@pytest.mark.parametrize("argument", LOST)
def test_nothing_stands_in_a_workbook_that_is_shown_another_way(argument: str, tmp_path: Path) -> None:
    sheet = sheet_of(tmp_path, f"shown = {LOST[argument]}")
    _, recording = recorded(sheet)
    nodes = [
        column.re for n, columns in recording.tables.items() if n != "1" for column in columns if column is not None
    ]
    nodes += [part for check in recording.checks.values() for part in check.parts]
    assert nodes and not recording.gaps
    for k, there in ((2, True), (3, False)):
        known = numbers([*nodes, *recording.guards], {recording.inputs["k"]: float(k)})
        assert all(np.isfinite(known[node]).all() == there for node in nodes)
        assert all(known[guard].all() for guard in recording.guards) == there


def test_a_slider_whose_range_is_another_one_moves_nothing(tmp_path: Path) -> None:
    _, recording = recorded(
        sheet_of(tmp_path, f"{SLIDER}\nz = np.array([2.0 * turn.value])  # [-] turned\nt = table('2', '', z)")
    )
    (column,) = recording.tables["2"]
    assert column is not None and np.isnan(numbers([column.re], {recording.inputs["k"]: 3.0})[column.re]).all()


def test_words_stand_in_a_workbook_as_other_inputs_make_them(
    recalculated: Callable[[Path], Any], tmp_path: Path
) -> None:
    """In the title and the note of a table, on the tab of its sheet, and in the title of a chart."""
    lines = "\n".join(f"shown_{n} = {each}" for n, each in enumerate(WORDS))
    sheet = sheet_of(tmp_path, lines, 'export("Own", globals())')
    assert as_script(sheet.path, f"--out={tmp_path}").returncode == 0
    edited = edit(tmp_path / "own.xlsx", {"k": 3}, tmp_path / "other.xlsx")
    numbers = dict[int, list[float]]()
    for k, path in ((3, edited), (2, tmp_path / "own.xlsx")):
        book = recalculated(path)
        said = [book["5 Words"]["A2"].value, book["Table 7"]["A1"].value, book["Marks"]["A3"].value]
        assert said == [f"of {k}", f"Table 7 - Words of {k}", f"Figure 4 - Words of {k}"]
        numbers[k] = [row[1] for row in book["Table 7"].iter_rows(min_row=5, values_only=True)]
    assert numbers[2] == numbers[3] and all(isinstance(x, float) for x in numbers[2])


def test_all_that_a_page_shows_is_of_its_inputs_or_gone(blank: Page, tmp_path: Path) -> None:
    """Beside what the page of a run with them has, nothing else stands on it."""
    lines = "\n".join(f"shown_{n} = {each}" for n, each in enumerate([*LOST.values(), *FOLLOWED]))
    names = ", ".join(f"shown_{n}" for n in range(len(LOST) + len(FOLLOWED)))
    sheet = sheet_of(tmp_path, lines, f"typeset({names})", f"typeset({', '.join(DRAWN)})", SLIDER + "\nturn", TURNED)
    grey = list[list[bool]]()
    texts = list[list[str]]()
    for given, address in (({}, "#k=3"), ({"k": 3}, "")):
        page = tmp_path / "page.html"
        page.write_text(write.page(sheet, inputs.build(sheet.inputs, given)), encoding="utf-8")
        blank.goto("about:blank")
        blank.goto(page.as_uri() + address)
        blank.wait_for_selector("body[data-ready]")
        grey.append(blank.evaluate(TEXT))
        texts.append(blank.evaluate("which => emptied(which)", grey[0]))
    assert texts[0] == texts[1]
    assert any(grey[0]) and not all(grey[0]) and not any(grey[1])


ENDS = {  # slider, changed inputs, its end, where it rests
    "of many steps": ("slider(0, 400 * g.k, step=1, value=20, label='turn')", "k=3", "1200", "20"),
    "between two steps": ("slider(0, 50 * g.k + 7, step=10, value=2, label='turn')", "F=3", "100", "2"),
    "without a step": ("slider(0, 40 * g.F, value=31, label='turn')", "F=3.26", "130.4", "31"),
}


@pytest.mark.parametrize("made", ENDS)
def test_a_slider_ends_at_its_last_step_and_rests_at_its_own_place(made: str, blank: Page, tmp_path: Path) -> None:
    """Also where there are too many steps for all, and where its place is none of them."""
    line, address, end, rests = ENDS[made]
    sheet = sheet_of(tmp_path, "", f"turn = {line}\nturn", "z = 1 * turn.value  # [-] turned\ntypeset()")
    page = tmp_path / "page.html"
    page.write_text(write.page(sheet, sheet.inputs()), encoding="utf-8")
    blank.goto("about:blank")
    blank.goto(f"{page.as_uri()}#{address}")
    blank.wait_for_selector("body[data-ready]")
    blank.evaluate("dispatchEvent(new Event('beforeprint'))")
    assert blank.locator("#line-z .ms-value").inner_text() == rests
    assert blank.locator("[data-control]").get_attribute("max") == end
