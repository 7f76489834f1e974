"""None where nothing fits: what a worksheet makes of it holds for other inputs too, and shown it is no number."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from never_stale import assert_never_stale
from own_worksheet import ELSEWHERE, assert_followed, own, recorded, value_of, written
from playwright.sync_api import Page, expect
from test_html_page import opened
from test_recalculation import MADE, computed, edit, verdicts

from mechsheet import evaluate
from mechsheet.document.numberless import numberless
from mechsheet.html import write
from mechsheet.studies.sweep import sweep
from mechsheet.worksheet.cells import Worksheet, load

D = "D = [4.0, 6.0, 8.0, 10.0, 20.0]\n"
T = "T = [('M4', 4.0), ('M6', 6.0), ('M10', 10.0)]\n"
OF_F = "r = g.F - 3 if g.F > 2 else None\n"
FOLLOWED = [
    # searched by hand
    f"{D}best = None\nfor d in D:\n    if d >= 3 * g.F:\n        if best is None or d < best:\n            best = d\n"
    "y = best * g.a if best is not None else -1.0",
    f"{D}best = None\nfor d in D:\n    m = (d - 7) ** 2 * g.a\n    if d >= 3 * g.F and (best is None or m < best[0]):\n"
    "        best = (m, d)\ny = -1.0 if best is None else best[0] + best[1]",
    f"{D}best, low = None, math.inf\nfor d in D:\n    m = (d - 7) ** 2 * g.a\n    if d >= 6 * g.F and m < low:\n"
    "        low, best = m, d\ny = 0.0 if best is None else best",
    "lo = hi = None\nX = [1.0, 2.0, 3.0, 5.0]\nfor p, q in zip(X, X[1:]):\n    if p <= g.F < q:\n"
    "        lo, hi = p, q\ny = -1.0 if lo is None else (g.F - lo) / (hi - lo)",
    "s = None\nfor d in (1.0, 3.0, 3.5):\n    if d > g.F:\n        if s is None:\n            s = 0.0\n        s += d\n"
    "y = 0.0 if s is None else s",
    *(
        "found = None\nfor d in (0.5, 1.0, 2.0, 3.0):\n    w = g.F / d\n    if w > 4 or w < 0.1:\n        continue\n"
        f"    if w < {least}:\n        found = d\n        break\ny = found * g.a if found is not None else -1.0"
        for least in (1.2, 0.9)
    ),
    # of any number of turns
    "best, at = None, None\nfor k in range(g.n):\n    v = (k - g.F) ** 2\n"
    "    if v > 1 and (best is None or v < best):\n        best, at = v, k\ny = -1.0 if best is None else best + at",
    "s, before = 0.0, None\nfor k in range(g.n):\n    v = math.sin(k * g.F)\n    if before is not None:\n"
    "        s += abs(v - before)\n    before = v\ny = s",
    "t, hit = 0.0, None\nwhile hit is None and t < 5:\n    t += 0.3\n    if t * g.a > g.F:\n        hit = t\n"
    "y = t if hit is None else 10 * hit",
    # given by functions
    f"{D}d = next((d for d in D if d > 6 * g.F), None)\ny = 99.0 if d is None else d * g.a",
    f"{D}d = max((d for d in D if d < 2 * g.F), default=None)\ny = 99.0 if d is None else d * g.a",
    f"{D}def pick(need):\n    for d in D:\n        if d >= need:\n            return d\nd = pick(6 * g.F)\n"
    "if d is None:\n    d = 50.0\ny = d * g.a",
    "def kind(F):\n    if F < 2:\n        return None\n    elif F < 3:\n        return 2 * F\n    if F > 3.5:\n"
    "        return\n    return F\nr = kind(g.F)\ny = -1.0 if r is None else r",
    "def most(x, limit=None):\n    return x if limit is None else min(x, limit)\n"
    "y = most(g.F, g.a if g.a > 0.5 else None) + most(g.F)",
    "d = {1: g.F, 3: g.a}.get(g.k)\ny = 0.0 if d is None else d",
    # in rows, texts, arrays and objects
    f"{T}row = next((row for row in T if row[1] > 2 * g.F), None)\ny = 0.0 if row is None else row[1] * g.a",
    f"{T}row = next((row for row in T if row[1] > 3 * g.F), None)\nif row:\n    name, d = row\n    y = d * g.a\n"
    "else:\n    y = -1.0",
    f"{T}name = next((name for name, d in T if d > 3 * g.F), None)\n"
    "y = g.a if name is None else 1.0 if name == 'M10' else 2.0",
    f"{T}name = next((name for name, d in T if d > 3 * g.F), None)\ny = 0.0 if name is None else dict(T)[name] * g.a",
    "T = [('a', 4.0, None), ('b', 8.0, 2.0)]\nrow = T[0] if g.F > 3 else T[1]\n"
    "y = row[1] * g.a if row[2] is None else row[2]",
    "T = [{'d': 4.0, 'most': None}, {'d': 8.0, 'most': 2.0}]\nrow = T[0] if g.F > 3 else T[1]\n"
    "y = row['d'] * g.a if row['most'] is None else row['most']",
    "from types import SimpleNamespace as Rod\nT = [Rod(some=3.0), Rod(some=8.0)]\n"
    "rod = next((rod for rod in T if rod.some > g.F), None)\ny = 0.0 if rod is None else rod.some * g.a",
    "from dataclasses import dataclass\n@dataclass\nclass Rod:\n    d: float\n    mass: float | None = None\n"
    "    @property\n    def own(self):\n        return self.d if self.mass is None else self.mass * g.a\n"
    "T = [Rod(3.0), Rod(3.5, 2.0)]\nrod = next((rod for rod in T if rod.d > g.F), None)\n"
    "y = 0.0 if rod is None else rod.own",
    "v = np.array([1.0, g.F]) if g.F > 3 else None\ny = 0.0 if v is None else v.sum()",
    "v = [g.F if k > g.F else None for k in (1, 3, 5)]\n"
    "y = sum(w for w in v if w is not None) + sum(w is None for w in v)",
    "def twice(v):\n    return 2 * v\nf = None\nif g.F > 2:\n    f = twice\ny = g.a if f is None else f(g.a)",
    # where Python asks otherwise than by `is None`
    f"{OF_F}y = (r or 1.5) * g.a",
    f"{OF_F}y = -1.0 if not r else r",
    f"{OF_F}y = 5.0 if r is not None and r > 0.1 else 2.0",
    f"{OF_F}y = 1.0 if all([r, g.a > 0.5]) else 2.0",
    f"{OF_F}y = 1.0 if r in (None, 1.0) else 2.0 + r",
    f"{OF_F}y = 1.0 if r not in [None] else g.a",
    "y = (1.0 if g.a > 0.5 else None) or (2.0 if g.F > 2 else None) or 3.0\ny = y * g.F",
    "y = 1.0 if (r := next((d for d in (3.0, 3.5) if d > g.F), 0.5)) is None else r * g.a",
]
LOOKED_AT = [
    "hit, r, s, t = None, 1.0, 0.0, 0.0\nwhile hit is None:\n    t += 0.5\n    if r is None:\n        s += 1.0\n"
    "    r = None if t > 3 else t\n    if t > g.F:\n        hit = t\ny = s + hit",
    "s, r = 0.0, 1.0\nfor k in range(g.n):\n    r = None if k * g.a > g.F else k * 1.0\n"
    "    s += 1.0 if r is None else r\ny = s + (0.5 if r is None else r)",
    "v = [g.F if g.F > 3 else None, g.a, None if g.a > 0.8 else 2.0][g.k % 3]\ny = -1.0 if v is None else v",
    f"{OF_F}match r:\n    case None:\n        y = 1.0\n    case _:\n        y = r * 2",
    f"{OF_F}v = [1.0]\nif r is not None:\n    v.append(r)\ny = sum(v)",
    f"{OF_F}y = g.a if r == None else r + 1",
    "ok = g.F > 3 if g.a > 0.5 else None\ny = 0.0 if ok is None else 1.0 if ok else 2.0",
    f"{T}row = next((row for row in T if row[1] > 2 * g.F), None)\ny = 1.0 if row == ('M10', 10.0) else g.a",
    f"{T}row = next((row for row in T if row[1] > 2 * g.F), None)\ny = 1.0 if row in T[1:] else g.a",
    f"{T}name = next((name for name, d in T if d > 3 * g.F), None)\ny = {{'M10': 1.5, None: 9.5}}.get(name, g.a)",
    f"{T}name = next((name for name, d in T if d > 3 * g.F), None)\ny = len(f'{{name}}') * g.a",
    "lo = None\nfor v in x:\n    if lo is None or abs(v - 1) < abs(lo - 1):\n        lo = v\ny = lo * 1.0",
    "best = None\nfor k in range(g.n):\n    v = (k - g.F) ** 2\n    if best is None or v < best[0]:\n"
    "        best = (v, k)\ny = best[0] + best[1]",
    f"{OF_F}y = [g.a if r is None else r, 1.0][0 if r is None else 1] * g.F",
    f"{D}d = next((d for d in D if d > 6 * g.F), None)\ny = d * g.a",
    f"{T}name, d = next((row for row in T if row[1] > 3 * g.F), None)\ny = d * g.a",
]


@pytest.mark.parametrize("lines", FOLLOWED)
def test_whether_there_is_something_is_a_condition(lines: str, tmp_path: Path) -> None:
    """It was what Python saw of the present numbers: for others there was none."""
    sheet = own(tmp_path, f"{lines}\nresult = np.atleast_1d(y) * 1  # [-] line")
    _, recording = recorded(sheet)
    assert not (recording.gaps or [guard for guard in recording.guards.values() if not (guard.rows or guard.turns)])
    assert_followed(sheet, recording, ELSEWHERE)


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("lines", [*FOLLOWED, *LOOKED_AT])
def test_nothing_belongs_to_other_inputs(lines: str, tmp_path: Path) -> None:
    assert_never_stale(lines, tmp_path)


SETUP = """
import marimo as mo

from mechsheet import ask, inputs, read, table, typeset
"""
GIVEN = """
F: float = 2.5  # [-] needed
a: float = 0.75  # [-] part
"""
SHOWN = """
T = [("M4", 4.0), ("M6", 6.0), ("M10", 10.0)]
best = None
for name, d in T:
    if d >= g.F and (best is None or d < best[1]):
        best = (name, d)
wide = next((d for _, d in T if d > 2 * g.F), None)  # [-] diameter
area = 0.0 if best is None else best[1] ** 2 * g.a  # [-] area
said = "none fits" if best is None else f"{best[0]}, {best[1]:.1f} wide"
table_1 = table("1", "Fits", area, wide)
typeset(table_1, mo.md(f"It is {said}, and {None if best is None else best[0]} is its name."))
"""
SCENES: list[dict[str, float]] = [{"F": 2.5}, {"F": 4.5}, {"F": 7.0}, {"F": 11.0, "a": 0.5}, {"F": 1.5}]


def worksheet(tmp_path: Path) -> Worksheet:
    path = tmp_path / "rods.py"
    path.write_text(written(SETUP, GIVEN, SHOWN), encoding="utf-8")
    return load(path)


def by_hand(scene: dict[str, float]) -> tuple[float, float, str]:
    """The area, the diameter and the text."""
    rods = {"M4": 4.0, "M6": 6.0, "M10": 10.0}
    name = next((name for name, d in rods.items() if d >= scene["F"]), None)
    wide = next((d for d in rods.values() if d > 2 * scene["F"]), np.nan)
    said = f"{name}, {rods[name]:.1f} wide" if name else "none fits"
    area = rods[name] ** 2 * scene.get("a", 0.75) if name else 0.0
    return area, wide, f"It is {said}, and {name} is its name."


def test_a_line_that_is_none_is_no_number(tmp_path: Path) -> None:
    """For itself, in a table, in a sweep and in what is told of a run; it was refused for want of a unit."""
    sheet, want = worksheet(tmp_path), ["area", "wide"]
    for scene in SCENES:
        *expected, _ = by_hand(scene)
        found = evaluate(sheet.path, want, **scene)
        np.testing.assert_array_equal([found[name] for name in want], expected)
        names = sheet.run(sheet.results, {"g": sheet.inputs(**scene)})
        np.testing.assert_array_equal([column.values[0] for column in names["table_1"].columns], expected)
        lost = [each.line.name for each in numberless({**names, "__file__": sheet.path})]
        assert lost == (["wide"] if np.isnan(expected[1]) else [])
    swept = sweep(sheet.path, want, {name: [s.get(name, 0.75) for s in SCENES] for name in ("F", "a")})
    np.testing.assert_array_equal(np.transpose([swept[name] for name in want]), [by_hand(s)[:2] for s in SCENES])


def test_none_in_arithmetic_is_an_error_of_the_worksheet(tmp_path: Path) -> None:
    """No number that is shown elsewhere: a recording has none either."""
    sheet = own(tmp_path, "d = next((d for d in (3.0, 5.0) if d > g.F), None)\nresult = d * g.a  # [-] line")
    with pytest.raises(TypeError, match="NoneType"):
        sheet.run(["result"], {"g": sheet.inputs(F=9.0)})
    assert np.isnan(value_of(recorded(sheet)[1], "result", {"F": 9.0}))


def test_cells_have_what_the_worksheet_has(recalculated_all: Callable[[list[Path]], list[Any]], tmp_path: Path) -> None:
    book = computed(Path(worksheet(tmp_path).path), tmp_path, {})
    paths = [edit(book, scene, tmp_path / f"{n}.xlsx") for n, scene in enumerate(SCENES)]
    for scene, cells in zip(SCENES, recalculated_all(paths), strict=True):
        area, wide, _ = by_hand(scene)
        assert [cell.value for cell in cells["1 Fits"][5][:2]] == [area, "#N/A" if np.isnan(wide) else wide], scene
        assert verdicts(cells).get(MADE, "PASS") == "PASS"


def test_a_page_has_what_the_worksheet_has(blank: Page, tmp_path: Path) -> None:
    sheet, path = worksheet(tmp_path), tmp_path / "rods.html"
    path.write_text(write.page(sheet, sheet.inputs()), encoding="utf-8")
    for scene in SCENES:
        opened(blank, path, "&".join(f"{name}={value}" for name, value in scene.items()))
        area, wide, said = by_hand(scene)
        expect(blank.locator(".ms-table tbody td")).to_have_text(
            [f"{area:.3f}", "–" if np.isnan(wide) else f"{wide:.3f}"]
        )
        expect(blank.get_by_text(said, exact=True)).to_have_count(1)
        assert blank.locator(".ms-grey").count() == 0
