"""Rows that are put into a table of inputs on a page in one file, or taken out: what Python picks of them follows."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any
from urllib.parse import quote

import numpy as np
from in_browser import evaluated
from own_worksheet import written
from test_html_lists import leaves
from test_html_page import read

from mechsheet.html import javascript, write
from mechsheet.quantities.lines import Recording
from mechsheet.quantities.quantity import Quantity
from mechsheet.recording.record import record
from mechsheet.worksheet import cells, inputs

if TYPE_CHECKING:
    from playwright.sync_api import Page

SETUP = """
import numpy as np

from mechsheet import ask, check, inputs, read, table, typeset

@inputs
class Bolt:
    name: str  # mark
    d: float  # [-] diameter
    w: float  # [-] weight
    x: float  # [-] place
"""
GIVEN = """
a: float = 3.5  # [-] least; > 0
F: list[float] = [2.5, -1, 3]  # [-] forces
bolts: list[Bolt] = [Bolt("b", 4, 3, 1), Bolt("a", 3, 5, 2), Bolt("c", 6, 4, 4.5), Bolt("d", 5, 5, 3)]  # bolts
"""
FOLLOWED = [
    "next((b for b in g.bolts if b.d > g.a), None).x * 1.0",
    "max(g.bolts, key=lambda b: b.w).x * g.a",
    "min(g.bolts, key=lambda b: abs(b.d - g.a)).x",
    "max(g.F, key=lambda v: abs(v))",
    "max((b for b in g.bolts if b.d < 6), key=lambda b: b.w * b.x).d",
    "min([(b.x, b.d) for b in g.bolts if b.d < 6], key=lambda p: p[0] - p[1])[1]",
    "next(b for b in g.bolts if b.d > g.a - 2).x",
    "next((b.x for b in g.bolts if b.d > g.a + 2), 0.0)",
    "next((p for p in g.bolts.x if p > 100), g.a)",
    "[b.x for b in g.bolts if b.w < 6][-1]",
    "[b for b in g.bolts if b.w < 6][0].d",
    "len([b for b in g.bolts if b.d > g.a]) * 1.0",
    "sum(1 for b in g.bolts if b.d > g.a) * g.a",
    "sum(b.w * b.x for b in g.bolts if b.d > g.a)",
    "max(b.x for b in g.bolts if b.d > 2)",
    "min((v for v in g.F if v > 3), default=7.5)",
    "np.array([b.x for b in g.bolts if b.d > 2]).sum()",
    "np.mean([b.x * g.a for b in g.bolts if b.d > 2])",
    "np.max([b.x for b in g.bolts if b.d > 2])",
    "sorted(g.bolts.d)[0]",
    "sorted(g.bolts.d)[-1] - sorted(g.F, reverse=True)[0]",
    "sum(sorted(g.bolts.w, reverse=True)[:2])",
    "sorted(g.bolts, key=lambda b: b.w * g.a)[0].x",
    "sorted(g.bolts, key=lambda b: b.w, reverse=True)[0].x",
    "sum(b.x for b in sorted(g.bolts, key=lambda b: b.w)[:3] if b.d > g.a)",
    "sum(v * w for v, w in zip(np.interp(g.bolts.d, [0.0, 10.0], [0.0, g.a]), g.bolts.w))",
    "sum(v * w for v, w in zip(np.sin(g.bolts.d), g.bolts.w, strict=True) if v > -0.5)",
    "sum(v for v in np.sin(g.bolts.x))",
    "sum(v for _, _, v in zip(g.bolts.d, g.bolts.w, g.bolts.x)) * g.a",
    "sum([v * g.a for _, _, v in [(b.d, b.w, b.x) for b in g.bolts if b.d > 2]])",
    "g.bolts[g.bolts.d * g.a >= 1][np.argmin(g.bolts[g.bolts.d * g.a >= 1].w)].x",
    "max(g.bolts[g.bolts.d > 2], key=lambda b: b.w).x",
    "sum(b.x for b in g.bolts[g.bolts.d > 2] if b.w < 6)",
    "sum(g.bolts.w[k] * b for k, b in enumerate(g.bolts.x)) * g.a",
    "sum(g.bolts.w[k] * g.bolts.x[k] for k in range(len(g.bolts))) * g.a",
    "max(range(len(g.bolts)), key=lambda k: g.bolts.w[k]) + g.a",
    "next(k for k, b in enumerate(g.bolts, 1) if b.d > 2) + g.a",
    "max(zip(g.bolts.w, g.bolts.x), key=lambda p: p[0])[1] * g.a",
    "max(g.bolts, key=lambda b: (b.w // 2, -b.d)).x * g.a",
    "max([(b.w // 2, b.x) for b in g.bolts if b.d > 2])[1]",
    "min(zip(g.bolts.w, g.bolts.x))[1]",
    "len(g.bolts[g.bolts.d > g.a].name) * 1.0",
    "(g.bolts[g.bolts.d > 2].x)[np.argmax(g.bolts[g.bolts.d > 2].w)]",
]  # fmt: skip
NAMED = [
    "fits = [b for b in g.bolts if b.d > g.a - 2]\nNAME = len(fits) + min(fits, key=lambda b: b.x).d + fits[0].w",
    "fits = [b.x for b in g.bolts if b.d > 100]\nNAME = fits[0] if fits else g.a",
    "fits = [b.d for b in g.bolts if b.d > g.a]\nNAME = min(fits, default=0.0) + (sum(fits) if fits else 1.0)",
    "fits = [b.x for b in g.bolts if b.d > 2]\nNAME = fits[len(fits) - 1] + sum(fits) / len(fits)",
    "fits = g.bolts[g.bolts.d * g.a >= 1]\nNAME = fits[np.argmin(fits.d)].x",
    "up = sorted([b for b in g.bolts if b.d > 2], key=lambda b: b.d)\nNAME = up[0].x * g.a + up[-1].w",
    "S = [b.w * g.a for b in g.bolts]\nNAME = max(S) + sum(S) / len(S) + S[0] + S.index(max(S))",
    "S = [b.w * g.a for b in g.bolts]\nNAME = g.bolts[np.argmax(S)].x",
    "S = [(b.x, b.w) for b in g.bolts if b.d > 2]\nx, w = S[0]\nNAME = x * w + sum(x * w for x, w in S)",
    "fits = [b for b in g.bolts if b.d > 2]\nNAME = sum(f.x for f in fits) + len([f for f in fits if f.w > g.a])",
    "s = 0.0\nfor k in range(len(g.bolts)):\n    s += g.bolts.w[k] * g.bolts.x[k]\nNAME = s * g.a",
    "fits = [b for b in g.bolts if b.d > 2]\ns = 0.0\nfor f in fits:\n    s += f.x * f.w\nNAME = s * g.a",
    "def fit(rows, d):\n    ok = [r for r in rows if r.d > d]\n"
    "    return min(ok, key=lambda r: r.w) if ok else rows[-1]\nNAME = fit(g.bolts, 2).x * fit(g.bolts, 100.0).d",
    "worst = max(g.bolts, key=lambda b: b.w)\nNAME = worst.d * worst.x",
]
HELD = [  # what a list that Python looks into, its texts, or their order gives is right or told
    "fits = [b for b in g.bolts if b.d > g.a]\nfits.append(g.bolts[0])\nNAME = len(fits) + fits[-1].x",
    "fits = [b.x for b in g.bolts if b.d > 2]\nfits.sort()\nNAME = fits[0] * 1.0",
    "fits = [b.x for b in g.bolts if b.d > g.a]\nfits += [g.a]\nNAME = sum(fits) * 1.0",
    "S = [b.w for b in g.bolts]\nS[0] = 3.0\nNAME = sum(S) * g.a",
    "NAME = len([b for b in g.bolts if b.name == 'a']) * g.a",
    "NAME = next((b for b in g.bolts if b.name.startswith('b')), g.bolts[0]).d * 1.0",
    "NAME = len(max(g.bolts, key=lambda b: b.w).name) * g.a",
    "NAME = {'b': 1.0, 'a': 2.0}.get(max(g.bolts, key=lambda b: b.w).name, 9.0) * g.a",
    "T = {'b': 1.0, 'a': 2.0}\nNAME = sum(T.get(b.name, 7.0) * b.w for b in g.bolts if b.d > g.a) * 1.0",
    "L = []\nNAME = sum(L.append(b.x) or b.x for b in g.bolts if b.d > g.a) + len(L)",
    "NAME = max(g.bolts, key=lambda b: np.sqrt(b.x - 0.75)).d * 1.0",
    "it = iter([b.x for b in g.bolts if b.d > 2])\nNAME = next(it) + next(it, 0.0)",
    "best = g.bolts[0]\nfor b in g.bolts:\n    if b.w > best.w:\n        best = b\nNAME = best.x * 1.0",
    "NAME = sum(b.x for b in g.bolts if all(b.d >= c.d - 3 for c in g.bolts)) * 1.0",
]
BOLTS = [("b", 4, 3, 1), ("a", 3, 5, 2), ("c", 6, 4, 4.5), ("d", 5, 5, 3)]
GIVES: list[dict[str, Any]] = [
    {}, {"a": 5.2}, {"bolts": BOLTS[:1]}, {"bolts": BOLTS[1:3], "a": 1.25}, {"bolts": [*BOLTS[::-1], ("e", 7, 1, 0.5)]},
    {"bolts": [(str(k), 2.1 + (k * 7) % 11 / 2, 1 + (k * 5) % 7 / 1.5, (k * 3) % 13 - 4.0) for k in range(40)], "a": 4},
    {"F": [1.5]}, {"F": [1, 2.5, -4, 6, 0.25], "a": 0.4},
]  # fmt: skip


def test_what_python_picks_of_rows_is_followed_for_any_number_of_them(blank: Page, tmp_path: Path) -> None:
    each = [f"NAME = {line}" for line in FOLLOWED] + NAMED
    sheet, recording = recorded(tmp_path, each)
    parts = {f"{k}": recording.values[f"y_{k}"].re for k in range(len(each))}
    script = javascript.module(recording, parts)
    for given, found in zip(GIVES, evaluated(blank, script, [leaves(sheet, x) for x in GIVES]), strict=True):
        for k, line in enumerate(each):
            expected = sheet.run([f"y_{k}"], {"g": inputs.build(sheet.inputs, given)})[f"y_{k}"]
            number, why = found["values"][str(k)], found["gaps"].get(str(k))
            assert number is not None, (line, given, why)
            np.testing.assert_allclose(number, expected, rtol=1e-12, atol=1e-13, err_msg=f"{line} {given}")


def test_what_python_looks_at_is_right_or_told(blank: Page, tmp_path: Path) -> None:
    sheet, recording = recorded(tmp_path, HELD)
    held = {str(k): recording.values.get(f"y_{k}") for k in range(len(HELD))}
    parts = {k: value.re for k, value in held.items() if isinstance(value, Quantity)}
    assert len(parts) == len(HELD)
    other = [
        {"bolts": [(name, *row[1:]) for name, row in zip(names, BOLTS, strict=True)]} for names in ("bxcd", "dacb")
    ]
    given = [*GIVES, *other, {"bolts": [("b", 4, 7, 1), ("a", 3, 5, 2), ("c", 6, 4, 4.5), ("d", 5, 8, 3)]}]
    script = javascript.module(recording, parts)
    known = 0
    for each, found in zip(given, evaluated(blank, script, [typed(sheet, x) for x in given]), strict=True):
        for k, line in enumerate(HELD):
            number, why = found["values"][str(k)], found["gaps"].get(str(k))
            if number is None:
                assert why, (line, each)
                continue
            expected = sheet.run([f"y_{k}"], {"g": inputs.build(sheet.inputs, each)})[f"y_{k}"]
            np.testing.assert_allclose(number, expected, rtol=1e-12, atol=1e-13, err_msg=f"{line} {each}")
            known += 1
    assert known >= len(HELD)


def typed(sheet: cells.Worksheet, given: dict[str, Any]) -> dict[str, Any]:
    """Inputs in SI; of a text whether it is another one than the exported one."""
    names = [row[0] for row in given.get("bolts", BOLTS)]
    same = [k < len(BOLTS) and name == BOLTS[k][0] for k, name in enumerate(names)]
    return leaves(sheet, given) | {"bolts.name": [float(not each) for each in same]}


def recorded(tmp_path: Path, each: list[str]) -> tuple[cells.Worksheet, Recording]:
    path = tmp_path / "own.py"
    lines = "\n".join(f"{line.replace('NAME', f'y_{k}')}  # [-] line" for k, line in enumerate(each))
    path.write_text(written(SETUP, GIVEN, lines + '\ntable_1 = table("1", "All", g.F)\ntypeset()'), encoding="utf-8")
    sheet = cells.load(path)
    names = sheet.run(sheet.results, {"g": sheet.inputs()})
    return sheet, record({**names, "__file__": sheet.path}, every=1, draws=True, lists=True)


SHOWN = """
worst = max(g.bolts, key=lambda b: b.w)
fits = [b for b in g.bolts if b.d > g.a]
n = len(fits)  # [-] how many
least = min(fits, key=lambda b: b.w)
U = g.bolts.w / 8  # [-] used
checks_1 = [check(f"bolt {b.name}", u, 1.0) for b, u in zip(g.bolts, U)]
"""
WORDS = """@app.cell
def words(g, worst, n, least, U, checks_1):
    mo.md(f"Worst {worst.name} of {len(g.bolts)} at {worst.x:.1f}, {n} fit, the least of them {least.name}, "
          f"no. {np.argmax(U) + 1} is {g.bolts.name[np.argmax(U)]}, "
          f"first {next(b.name for b in g.bolts if b.d > g.a)}.")
    return


@app.cell
def shown(checks_1):
    summary(*checks_1)
    return


"""


def test_a_page_names_the_rows_and_judges_those_that_it_has_checks_of(blank: Page, tmp_path: Path) -> None:
    """Of a row that is put in there is no check: nobody may take it for one that has passed."""
    path = tmp_path / "shown.py"
    text = written(SETUP.replace("import ask,", "import ask, export, summary,"), GIVEN, SHOWN, "Shown")
    text = text.replace("import numpy", "import marimo as mo\n    import numpy").replace(
        "    return worst", "    typeset(*checks_1)\n    return worst"
    )
    path.write_text(text.replace("@app.cell\ndef workbook", WORDS + "@app.cell\ndef workbook"), encoding="utf-8")
    sheet = cells.load(path)
    own = tmp_path / "own.html"
    own.write_text(write.page(sheet, sheet.inputs()), encoding="utf-8")
    for rows in (BOLTS, BOLTS[1:], BOLTS[:2], [*BOLTS, ("new", 4.5, 1, 7)], [("new", 9, 9.5, 7), *BOLTS]):
        fresh = tmp_path / "fresh.html"
        fresh.write_text(write.page(sheet, inputs.build(sheet.inputs, {"bolts": rows})), encoding="utf-8")
        typed_in = quote(" | ".join("; ".join(map(str, row)) for row in rows))
        here, there = (shown_by(blank, each) for each in (f"{own.as_uri()}#bolts={typed_in}", fresh.as_uri()))
        assert here["texts"] == there["texts"] and here["lines"] == there["lines"], rows
        assert here["texts"], "prose"
        for k, (name, verdict) in enumerate(here["checks"]):
            if len(rows) == len(BOLTS) or k < min(len(rows), len(BOLTS) - 1):
                assert (name, verdict) == there["checks"][k], rows
            else:
                assert verdict == "not known", rows
        passed = sum(verdict == "PASS" for _, verdict in here["checks"])
        assert here["sum"].startswith(f"{passed} of {len(BOLTS)} checks pass")
        assert ("have no check" in here["state"]) == (len(rows) != len(BOLTS))


def shown_by(page: Page, address: str) -> Any:
    page.goto("about:blank")
    page.goto(address)
    page.wait_for_selector("body[data-ready]")
    read_off: dict[str, Any] = read(page)
    of = "e => [e.querySelector('.ms-name')?.textContent, e.querySelector('.ms-badge').textContent]"
    checks = page.evaluate(f"[...document.querySelectorAll('.ms-check')].map({of})")
    return read_off | {"checks": [tuple(each) for each in checks]}
