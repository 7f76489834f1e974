"""Rows of an input table that are counted and put together by their names, as these are typed."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from own_worksheet import written
from test_counted_turns import recorded
from test_random_statements import sheet_of

from mechsheet.quantities.node import bottom_up
from mechsheet.readers.numbers import numbers
from mechsheet.worksheet import cells

SETUP = """
from collections import Counter, defaultdict

import numpy as np

from mechsheet import ask, export, inputs, read, table, typeset

@inputs
class Case:
    name: str  # name
    M: float  # [-] moment
"""
GIVEN = """
cases: list[Case] = [Case("a", 1.0), Case("b", 2.0), Case("c", 5.0)]  # cases
word: str = "q"  # another name
k: int = 2  # [-] number
x: float = 2.0  # [-] factor
"""
BY_NAME = "\nfor c in g.cases:\n    d[c.name]"
LINES = {
    "names of which each stands once": (
        "d = []\nfor c in g.cases:\n    if c.name not in d:\n        d.append(c.name)\ny = len(d) * g.x"
    ),
    "names that stand before": "d = [c.name for c in g.cases]\ny = sum(n in d[:k] for k, n in enumerate(d)) * g.x",
    "lists that are begun": (
        "d = {}\nfor c in g.cases:\n    if c.name not in d:\n        d[c.name] = []\n    d[c.name].append(c.M * g.x)\n"
        "y = max(map(sum, d.values())) + len(d)"
    ),
    "lists": f"d = defaultdict(list){BY_NAME}.append(c.M * g.x)\ny = max(sum(v) / len(v) for v in d.values()) + len(d)",
    "sums": f"d = defaultdict(float){BY_NAME} += c.M * g.x\ny = max(d.values()) + len(d)",
    "counts": f"d = Counter(){BY_NAME} += 1\ny = max(d.values()) * g.x + len(d)",
    "another name among them": "y = g.x if g.word in [c.name for c in g.cases] else 7.0",
    "another name alone": "y = g.x if g.cases[0].name in [g.word] else 7.0",
    "numbers": "d = defaultdict(float)\nfor c in g.cases:\n    d[c.M] += g.x\ny = max(d.values()) + len(d)",
    "a number": "d = defaultdict(lambda: 3.0, {1: 2.0, 4: 5.0})\ny = d[g.k] * g.x",
}
OTHER: list[dict[str, Any]] = [
    {}, {"x": 3.0}, {"k": 1}, {"k": 4}, {"word": "a"}, {"cases": [("a", 1.0), ("b", 5.0), ("c", 5.0)]},
    {"cases": [("a", 1.0), ("b", 2.0), ("a", 5.0)]}, {"cases": [("q", 1.0), ("q", 2.0), ("c", 5.0)]},
]  # fmt: skip


@pytest.mark.parametrize("lines", LINES.values(), ids=LINES)
def test_what_is_put_together_by_names_is_that_of_the_names_shown(lines: str, tmp_path: Path) -> None:
    """A name that stands once was taken for one that always does; what a dictionary gives by itself was not known."""
    path = tmp_path / "own.py"
    lines += "  # [-] line\nz = np.array([y])  # [-] line\ntable_1 = table('1', 'Alone', z)\ntypeset()"
    path.write_text(written(SETUP, GIVEN, lines), encoding="utf-8")
    sheet = cells.load(path)
    recording = recorded(sheet, every=1, draws=True, lists=True)
    assert recording.gaps == []
    (column,) = recording.tables["1"]
    assert column is not None
    looked = [guard.holds for guard in recording.looked["z"]]
    own = sheet.inputs()
    for each in OTHER:
        rows = [sheet.inputs().cases[0].__class__(*row) for row in each.get("cases", ())]
        g = sheet.inputs(**({**each, "cases": rows} if rows else each))
        typed = {
            "cases.M": g.cases.M, "k": np.asarray(float(g.k)), "x": np.asarray(g.x),
            "cases.name": np.array([float(c.name != o.name) for c, o in zip(g.cases, own.cases, strict=True)]),
            "word": np.asarray(float(g.word != own.word)),
        }  # fmt: skip
        known = numbers([column.re, *looked], {recording.inputs[name]: typed[name] for name in recording.inputs})
        (told,) = sheet.run(["z"], {"g": g})["z"]
        if all(known[holds].all() for holds in looked):
            assert known[column.re] == [told], each
        else:
            assert each and "x" not in each


@pytest.mark.parametrize("line", ["AREA[g.mode]", "AREA.get(g.mode, 1.0)"])
def test_an_option_of_these_inputs_alone_is_a_key_as_well(line: str, tmp_path: Path) -> None:
    """Behind a statement that may have changed the inputs it was told to have no attribute ``value``."""
    changed = "a = g.F * 1.0\n    b = a\n    b[0] = g.x\n    return a.sum()"
    sheet = sheet_of(tmp_path, [f"def f():\n    {changed}", "y_0 = f() * 1.0", f"y_1 = {line} * 1.0"])
    recording = recorded(sheet, every=1, draws=True, lists=True)
    assert [gap.reason for gap in recording.gaps] == ["an array is changed that has another name too"]
    column = recording.tables["y_1"][0]
    assert column is not None and column.value == [2.5]
    assert recording.inputs["mode"] in bottom_up([guard.holds for guard in recording.looked["zy_1"]], ())
