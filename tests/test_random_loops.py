"""Loops written at random: whoever reads them has plain Python's numbers for other inputs, or says that it has none."""

from __future__ import annotations

import warnings
from collections.abc import Iterator, Sequence
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

import numpy as np
from conftest import examples
from hypothesis import given
from hypothesis import strategies as st
from in_browser import evaluated
from test_counted_turns import expected, recorded, sheet_of

from mechsheet.html import javascript
from mechsheet.quantities.lines import Recording
from mechsheet.quantities.node import Node
from mechsheet.quantities.quantity import Quantity
from mechsheet.readers.numbers import numbers
from mechsheet.worksheet.cells import Worksheet

if TYPE_CHECKING:
    from playwright.sync_api import Page

OTHER: list[dict[str, Any]] = [
    {}, {"n": 0}, {"n": 1}, {"n": 7, "x": 1.25}, {"m": 0}, {"m": 1, "n": 3}, {"m": 4, "n": 6, "x": 0.3},
    {"n": 9, "m": 3},
]  # fmt: skip
ENDS = ["g.n", "g.m", "g.m - 2", "1, g.n + 1", "g.m, g.n", "g.n, 0, -1", "3"]
UNFOLLOWED = [
    "for q in range(g.n**2):\n    s = s + 0.5",
    "for q in range(2):\n    t -= math.gamma(q + g.m + 1) * 0.01",
    "if math.gamma(g.m + 1) > 3:\n    s = 5.0",
    "L = []\nfor q in range(g.n**2):\n    L.append(g.x)\nt = t + sum(L)",
]


class Writer:
    """Statements that change ``s``, ``t``, an array ``y`` of g.n + 1 elements, one ``z`` of 12 and a list ``q``."""

    def __init__(self, random: Random) -> None:
        self.random, self.one = random, random.choice

    def lines(self) -> list[str]:
        begin = "s, t, q = 0.0, g.x, [0.5]\ny, z = np.zeros(g.n + 1), np.zeros(12)"
        more = [self.one(["y[0] = 1.0", "y = y + g.x", *UNFOLLOWED]) for _ in range(self.random.randint(0, 2))]
        after = [
            line for _ in range(self.random.randint(0, 2)) for line in self.one([self.loop, self.statement])("", ())
        ]
        return [begin, *more, *self.loop("", ()), *after, "NAME = s + t + y.sum() + z.sum() + len(y) + sum(q) + len(q)"]

    def loop(self, indent: str, outer: Sequence[str]) -> list[str]:
        name = "ijk"[len(outer)]
        ends = self.one(ENDS + [form.format(outer[-1]) for form in ("{}", "{} + 1", "g.n - {}") if outer])
        return [f"{indent}for {name} in range({ends}):", *self.body(indent + "    ", (*outer, name))]

    def body(self, indent: str, turns: Sequence[str]) -> list[str]:
        return [line for _ in range(self.random.randint(1, 3)) for line in self.statement(indent, turns)]

    def statement(self, indent: str, turns: Sequence[str]) -> Iterator[str]:
        kind = self.random.random()
        if kind < 0.3 or not turns:
            yield f"{indent}{self.one('st')} {self.one(['=', '+=', '-=', '*='])} {self.number(turns)} * 0.5"
        elif kind < 0.6:
            yield f"{indent}{self.element(turns)} {self.one(['=', '+=', '*='])} {self.number(turns)} * 0.5"
        elif kind < 0.75:
            yield f"{indent}if {self.number(turns)} {self.one(['<', '>', '!='])} {self.number(turns)}:"
            yield f"{indent}    {self.one(['break', 'continue', 's = 0.25', f't = {self.number(turns)}'])}"
        elif kind < 0.8:
            yield f"{indent}q.append({self.number(turns)} * 0.5)"
        elif len(turns) < 2:
            yield from self.loop(indent, turns)
        else:
            yield f"{indent}s += {self.number(turns)}"

    def element(self, turns: Sequence[str], where: str = "") -> str:
        turn = self.one(turns)
        if where == "read" and self.random.random() < 0.3:
            return self.one(["q[-1]", "q[0]", "len(q)"])
        return self.one([f"y[{turn} % (g.n + 1)]", "y[0]", "y[-1]", f"z[{turn} % 12]", f"z[({turn} + 3) % 12]"])

    def number(self, turns: Sequence[str], deep: int = 0) -> str:
        kind = self.random.random()
        if deep > 2 or kind < 0.4:
            return self.one(["s", "t", "g.x", "0.5", "2", *turns])
        if turns and kind < 0.6:
            return self.element(turns, "read")
        return f"({self.number(turns, deep + 1)} {self.one('+-*')} {self.number(turns, deep + 1)})"


def plain(sheet: Worksheet, lines: str) -> list[float | None]:
    """What the worksheet itself computes for each set of inputs; None where it is an error."""

    def run(each: dict[str, Any]) -> float | None:
        try:
            return expected(sheet, each, [lines])[0]
        except Exception:  # whatever plain Python has against these inputs
            return None

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # numbers grow beyond all limits in some
        return [run(each) for each in OTHER]


@given(st.randoms(use_true_random=False))
@examples(30)
def test_numbers_are_those_of_other_inputs_or_none(blank: Page, random: Random) -> None:
    """By the reader that all studies use, recorded for cells and for pages, and by the page's own script."""
    lines = "\n".join(Writer(random).lines())
    with TemporaryDirectory() as folder:
        sheet = sheet_of(Path(folder), each=[lines])
        own = plain(sheet, lines)
        if own[0] is None or not np.isfinite(own[0]):
            return
        told = np.array([np.nan if x is None or not np.isfinite(x) else x for x in own])
        for draws in (False, True):
            recording = recorded(sheet, every=1, draws=draws, lists=draws)
            value = recording.values.get("y_0")
            if not isinstance(value, Quantity):
                assert recording.gaps
                continue
            guards = [guard.holds for guard in recording.looked["y_0"]] if draws else [*recording.guards]
            shown = by_reader(recording, [value.re, *guards])
            assert_right(lines, shown, told)
            if draws:
                assert_right(lines, by_page(blank, sheet, recording, [value.re, *guards]), told)


def by_reader(recording: Recording, nodes: Sequence[Node]) -> list[Any]:
    """The first of some nodes for each set of inputs; NaN where one of the others does not hold."""
    sets = ({recording.inputs[name]: float(number) for name, number in each.items()} for each in OTHER)
    found = [numbers(nodes, given) for given in sets]
    return [each[nodes[0]] if all(each[holds].all() for holds in nodes[1:]) else np.nan for each in found]


def by_page(blank: Page, sheet: Worksheet, recording: Recording, nodes: Sequence[Node]) -> list[Any]:
    """The same by the script of a page."""
    script = javascript.module(recording, {f"{n}": node for n, node in enumerate(nodes)})
    sets = [{name: float(getattr(sheet.inputs(**each), name)) for name in ("n", "m", "x")} for each in OTHER]
    found = [page["values"] for page in evaluated(blank, script, sets)]
    held = [all(each[f"{n}"] == 1 for n in range(1, len(nodes))) for each in found]
    return [each["0"] if holds and each["0"] is not None else np.nan for each, holds in zip(found, held, strict=True)]


def assert_right(lines: str, shown: Sequence[Any], told: np.ndarray) -> None:
    """What is shown is what plain Python has, if it has anything; of the inputs that were recorded it is shown."""
    both = ~np.isnan(shown) & ~np.isnan(told)
    assert both[0], (lines, shown, told)
    np.testing.assert_allclose(np.asarray(shown, float)[both], told[both], rtol=1e-9, atol=1e-9, err_msg=lines)
