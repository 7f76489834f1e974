"""Prose with numbers and texts in it: on the page it is for other inputs what the worksheet says there."""

from pathlib import Path
from typing import TYPE_CHECKING
from urllib.parse import quote

import pytest
from own_worksheet import written
from test_html_page import opened, read

from mechsheet.html import write
from mechsheet.worksheet import cells, inputs

if TYPE_CHECKING:
    from playwright.sync_api import Page

SETUP = """import math
from typing import Literal
import marimo as mo
import numpy as np
from mechsheet import ask, inputs, one_of, read, typeset

@inputs
class Steel:
    R: float  # [-] strength

@inputs
class Case:
    name: str  # name
    P: float  # [-] power

STEELS = {"S235": Steel(235.0), "S355": Steel(355.0)}"""
GIVEN = """F: float = 2.5  # [-] number; > 0
side: Literal["left", "right"] = "left"  # side
steel: Steel = one_of(STEELS, "S235")  # steel
v: list[float] = [1.0, 4.0, 2.0]  # [-] values
cases: list[Case] = [Case("start", 1.0), Case("full", 4.0), Case("idle", 2.0)]  # cases"""
SAID = [
    "{int(3 * g.F)} or {math.ceil(g.F) + 1} or {round(g.F)}", "level {int(np.argmax(g.v)) + 1} of {len(g.v)}",
    "{np.count_nonzero(g.v > g.F)} above", "{g.steel}, {g.side} side", "a{'' if g.side == 'left' else ', turned'}.",
    "{'long' if g.F > 3 else f'short by {3 - g.F:.2f}'}", "{g.F / 7:g} and {g.F / 7:.1%} and {1e9 * g.F:e} and {g.F:f}",
    "{', '.join(f'{x:.1f} mm' for x in (g.F, 2 * g.F))}", "{-(-g.F // 1):.0f}", "{np.floor(g.F)}", "{2 * int(g.F) - 1}",
    "{'**long**, too' if g.F > 3 else f'`short` by {3 - g.F:.2f} <b>'} of {g.F:.1f} ",
    "$F = {g.F:.2f}\\,\\mathrm{{N}}$, $x_{{{g.F * 2:.0f}}} < {g.F:.1f}^2$, but $-3 - y = {1.5 - g.F:.2f}$ {g.F:.1f}",
    "$$\\sigma = \\frac{{{g.F:.1f}}}{{{g.F + 1:.3g}}} \\tag{{4}}$$",
    "{'$x^2$' if g.side == 'left' else '&'} and {'_one_' if g.F > 3 else 'two'} {g.side}",
    "{'**yes**' if g.F > 3 else 'no'}, {'*yes*' if g.F > 2 else 'no'}, {'_yes_' if g.F > 1.5 else 'no'}",
    "{kind} and **{kind}**, {'of' if kind == 'long' else 'at'} {g.F:.1f}",
    "{', '.join(c.name for c in g.cases if c.P > g.F)} are above, {' and '.join(over)} too",
    "{3 - g.F:+.1f} and {1e6 * g.F:,.0f} {-12345.67895 * g.F:+,.4f} {round(1000 * g.F):,}",
    "{len(g.v) - 5:+} and {g.F / 7:+.2%}",
    "{g.F:8.2f} N, {g.F:<7.1f} and {round(g.F):6d} | {g.F:^+9.2f} {'10 {:6.2f}'.format(g.F)}",
    "{turns} turns, {turns // 2} twice, {doubled} and {halves:g} by {last}",
    "{len([x for x in (1.0, 2.0, 3.0) if x > g.F])} of 3", "{len(above)}, {'some' if above else 'none'}",
]  # fmt: skip
PUT_TOGETHER = [  # or under a name, or one of two
    "note", "f'B {g.F:.1f} ' + kind + f' {g.side}'", "'C much' if g.F > 3 else 'C little'", "'D ' + kind",
    "'E {0:.2f} N, {1} {0:.1f}'.format(g.F, kind)", "'F {:.2f} N, {} {n}'.format(g.F, kind, n=g.side)",
    "'G ' + str(g.F) + ' N'", "'H ' + f'{g.F:.2f}'.replace('.', ',')", "str(round(g.F, 2)).replace('.', ',')",
    "', '.join(f'I {x:.1f}' for x in (g.F, 2 * g.F))", "'J %.2f N' % g.F", "'K %s, %.1f' % (kind, g.F)",
]  # fmt: skip
NOTES = [  # shown by typeset, or under a name
    'typeset(mo.md(f"L {g.F:.1f} {kind}"))',
    'noted = mo.md(f"M {g.F:.1f} {kind}")\n    noted',
    'titled = mo.md(", ".join(f"N {x:.1f}" for x in (g.F, y)))\n    typeset(y, titled)',
]
CHANGED = [
    {"F": "3.75"},
    {"side": "right", "F": "1"},
    {"steel": "S355", "v": "5; 1; 2; 7"},
    {"cases": "jog; 3 | full; 1 | stop; 2.6"},
    {"F": "9"},
]


@pytest.mark.parametrize("given", CHANGED)
def test_prose_is_that_of_the_worksheet(given: dict[str, str], blank: "Page", tmp_path: Path) -> None:
    """What stood in it as a whole number, an option, one of two words or in per cent had made all of it grey."""
    path = tmp_path / "prose.py"
    text = written(
        SETUP,
        GIVEN,
        "y = g.F  # [-] y\nkind = 'long' if y > 3 else 'short'\n"
        "over = [c.name for c, v in zip(g.cases, (1, 2, 3)) if v * c.P > g.F]\n"
        "above = [x for x in (1.0, 2.0, 3.0) if x > g.F]\nturns, doubled, halves, q = 0, 1, 0, g.F\n"
        "while q > 0.1:\n    q, turns, doubled, halves = q * 0.7, turns + 1, 2 * doubled, halves + 0.5\n"
        "for last in range(99):\n    q = q * 1.1\n    if q > g.F:\n        break\n"
        "note = f'A {g.F:.3f} {kind}'",
    )
    said = (
        f"@app.cell\ndef said_{k}(g, above, doubled, halves, kind, last, over, turns):\n"
        f'    mo.md(rf"""A{k} {words}""")\n    return\n\n\n'
        for k, words in enumerate(SAID)
    )
    put = (
        f"@app.cell\ndef put_{k}(g, kind, note):\n    mo.md({words})\n    return\n\n\n"
        for k, words in enumerate(PUT_TOGETHER)
    )
    notes = (f"@app.cell\ndef note_{k}(g, kind, y):\n    {lines}\n    return\n\n\n" for k, lines in enumerate(NOTES))
    path.write_text(text.replace("if __name__", "".join([*said, *put, *notes, "if __name__"])))
    sheet = cells.load(path)
    own, other = tmp_path / "own.html", tmp_path / "other.html"
    own.write_text(write.page(sheet, sheet.inputs()), encoding="utf-8")
    other.write_text(write.page(sheet, inputs.build(sheet.inputs, given)), encoding="utf-8")
    shown = []
    for page, address in ((own, "&".join(f"{k}={quote(v)}" for k, v in given.items())), (other, "")):
        blank.goto("about:blank")
        blank.goto(page.as_uri() + (f"#{address}" if address else ""))
        blank.wait_for_selector("body[data-ready]")
        shown.append(read(blank)["texts"])
    assert shown[0] == shown[1] and len(shown[0]) >= len(SAID) + len(PUT_TOGETHER) + len(NOTES)


def test_a_note_is_not_that_of_what_its_names_are_later(blank: "Page", tmp_path: Path) -> None:
    """The line that binds a name anew gives it the number that it has now, whatever the input is."""
    path, page = tmp_path / "later.py", tmp_path / "later.html"
    lines = 'v = g.F  # [-] v\nnote = mo.md(f"so {v:.1f}")\nv = 2.5  # [-] v\ntypeset(note)'
    path.write_text(written(SETUP, "F: float = 2.5  # [-] number; > 0", lines))
    page.write_text(write.page(cells.load(path), cells.load(path).inputs()), encoding="utf-8")
    blank.goto(f"{page.as_uri()}#F=3.75")
    blank.wait_for_selector("body[data-ready]")
    assert "so 2.5" not in blank.inner_text("body")


JUDGED = """limit = np.divide(1.0, g.F) if g.F >= 0 else np.sqrt(g.F)  # [-] limit
y = np.sqrt(g.x)  # [-] y
judged = check("y", y, limit, "-")
typeset(judged)"""


@pytest.mark.parametrize(
    ("given", "told"),
    [
        ("F=0", "its limit is infinite"),
        ("F=-1", "its limit does not exist"),
        ("x=-1", "its value does not exist"),
    ],
)
@pytest.mark.filterwarnings("ignore::RuntimeWarning")
def test_why_a_check_is_not_evaluated_is_that_of_the_worksheet(
    given: str, told: str, blank: "Page", tmp_path: Path
) -> None:
    """A quantity below an infinite limit had passed on the page alone, and of one without a number nothing was said."""
    path, to = tmp_path / "judged.py", tmp_path / "judged.html"
    path.write_text(
        written(
            SETUP.replace("import ask", "import ask, check, typeset"),
            "F: float = 0.5  # [-] F\nx: float = 1.0  # [-] x",
            JUDGED,
        )
    )
    sheet = cells.load(path)
    to.write_text(write.page(sheet, sheet.inputs()), encoding="utf-8")
    changed = inputs.build(sheet.inputs, dict([given.split("=")]))
    assert sheet.run(["judged"], {"g": changed})["judged"].reason == told
    shown = opened(blank, to, given).locator(".ms-check").last
    assert shown.locator(".ms-badge").inner_text() == "not evaluated" and told in shown.inner_text()


SIZED = """top = np.divide(9.0, g.F)  # [-] top
near = check("near", g.x, 0.04, "-", of=g.y)
least = check("least", top, at_least=2.0, unit="-")
typeset(near, least)"""


@pytest.mark.filterwarnings("ignore::RuntimeWarning")
def test_checks_of_a_limit_that_tells_nothing_and_of_what_is_infinite(blank: "Page", tmp_path: Path) -> None:
    """For other inputs a limit that is there was said not to exist, and what is infinite was inf."""
    path, to = tmp_path / "sized.py", tmp_path / "sized.html"
    given = "F: float = 0.5  # [-] F\nx: float = 1.0  # [-] x\ny: float = 2.0  # [-] y"
    path.write_text(written(SETUP.replace("import ask", "import ask, check, typeset"), given, SIZED))
    sheet = cells.load(path)
    to.write_text(write.page(sheet, sheet.inputs()), encoding="utf-8")
    near, least = opened(blank, to, "F=0&x=1.5").locator(".ms-check").all()
    assert "its limit is more than a thousandth of what is compared" in near.inner_text()
    assert "\N{INFINITY} \u2265 2" in least.inner_text()


@pytest.mark.parametrize(
    ("text", "why"),
    [
        ("made(g.F)", "what it shows is made by code that is not recorded"),
        ("f'{g.F:.1f} of {sorted(str(g.F))}'", "for these inputs the worksheet's code goes another way"),
    ],
)
def test_a_text_that_is_the_run_s_alone_says_why_and_so_does_the_bar(
    text: str, why: str, blank: "Page", tmp_path: Path
) -> None:
    """The bar named all but texts, and a text that is not recorded had no reason."""
    path, to = tmp_path / "said.py", tmp_path / "said.html"
    lines = f'note = mo.md({text})\ntypeset(mo.md("## 1 Notes"), note)'
    path.write_text(written(f"{SETUP}\n\ndef made(x):\n    return 'made %r' % x", "F: float = 2.5  # [-] F", lines))
    to.write_text(write.page(cells.load(path), cells.load(path).inputs()), encoding="utf-8")
    assert opened(blank, to).locator(".ms-grey").count() == 0
    page = opened(blank, to, "F=3.5")
    told = page.locator(".ms-grey").get_attribute("data-reason") or ""
    assert told.endswith(f": {why}")
    assert page.locator(".ms-state").inner_text() == f"changed: F; not known: a text of 1 Notes ({told})"


def test_a_unit_that_does_not_fit_is_told_at_the_top(blank: "Page", tmp_path: Path) -> None:
    """The page in the browser, the run and the workbook told it: who was given the one file was not."""
    for unit, told in (("m**2", []), ("N", ["mistake line 46, A: unit [N] does not fit; the value is in m²"])):
        path, to = tmp_path / "fit.py", tmp_path / "fit.html"
        path.write_text(written(SETUP, "b: float = 2.5  # [m] width", f"A = g.b**2  # [{unit}] area\ntypeset()"))
        to.write_text(write.page(cells.load(path), cells.load(path).inputs()), encoding="utf-8")
        assert opened(blank, to).locator(".ms-bar + p:has(.ms-FAIL)").all_inner_texts() == told
