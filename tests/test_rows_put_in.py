"""Rows that are put into a table of inputs on a page in one file, or taken out: what Python picks of them follows."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from in_browser import evaluated
from own_worksheet import written
from test_html_lists import leaves

from mechsheet.html import javascript
from mechsheet.quantities.lines import Recording
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
    "g.bolts[g.bolts.d * g.a >= 1][np.argmin(g.bolts[g.bolts.d * g.a >= 1].w)].x",
    "max(g.bolts[g.bolts.d > 2], key=lambda b: b.w).x",
    "sum(b.x for b in g.bolts[g.bolts.d > 2] if b.w < 6)",
    "(g.bolts[g.bolts.d > 2].x)[np.argmax(g.bolts[g.bolts.d > 2].w)]",
]  # fmt: skip
NAMED = [
    "fits = [b for b in g.bolts if b.d > g.a - 2]\nNAME = len(fits) + min(fits, key=lambda b: b.x).d + fits[0].w",
    "fits = [b.x for b in g.bolts if b.d > 100]\nNAME = fits[0] if fits else g.a",
    "fits = [b.d for b in g.bolts if b.d > g.a]\nNAME = min(fits, default=0.0) + (sum(fits) if fits else 1.0)",
    "fits = [b.x for b in g.bolts if b.d > 2]\nNAME = fits[len(fits) - 1] + sum(fits) / len(fits)",
    "fits = g.bolts[g.bolts.d * g.a >= 1]\nNAME = fits[np.argmin(fits.d)].x",
    "up = sorted([b for b in g.bolts if b.d > 2], key=lambda b: b.d)\nNAME = up[0].x * g.a + up[-1].w",
    "worst = max(g.bolts, key=lambda b: b.w)\nNAME = worst.d * worst.x",
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


def recorded(tmp_path: Path, each: list[str]) -> tuple[cells.Worksheet, Recording]:
    path = tmp_path / "own.py"
    lines = "\n".join(f"{line.replace('NAME', f'y_{k}')}  # [-] line" for k, line in enumerate(each))
    path.write_text(written(SETUP, GIVEN, lines + '\ntable_1 = table("1", "All", g.F)\ntypeset()'), encoding="utf-8")
    sheet = cells.load(path)
    names = sheet.run(sheet.results, {"g": sheet.inputs()})
    return sheet, record({**names, "__file__": sheet.path}, every=1, draws=True, lists=True)
