"""Numbers that there are not for other inputs: where Python has an error, no comparison of one goes either way."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from conftest import examples
from hypothesis import assume, given
from hypothesis import strategies as st
from openpyxl import load_workbook
from test_counted_turns import recorded
from test_random_statements import OTHER, by_page, by_reader, plain, sheet_of
from typed_workbook import typed

from mechsheet.html import javascript
from mechsheet.run import report

if TYPE_CHECKING:
    from playwright.sync_api import Page

W = "w = np.array([1.0, 6.0, 7.0, 2.0])"
# For each a number that some of the other inputs have not, in a condition of one.
NOT_THERE = {
    "an element of an array": [W, "c = w[g.k] > 5"],
    "an element of a list of inputs": ["c = g.F[g.k] > 2"],
    "an element of a matrix": ["m = np.array([[1.0, g.x], [3.0, 4.0], [5.0, 6.0]])", "c = m[g.k, 0] > 2"],
    "a row of a matrix": ["m = np.array([[1.0, g.x], [3.0, 4.0], [5.0, 6.0]])", "r = m[g.k]", "c = r[1] > g.u"],
    "what is made of an element": [W, "v = 2.0 * w[g.k] + g.x", "c = v > 5"],
    "the truth of an element": [W, "c = w[g.k] and g.on"],
    "an element of rows": ["L = [(1.0, 2.0), (3.0, 4.0), (5.0, 6.0)]", "c = L[g.k][1] > 3"],
    "a field of an element": ['L = [{"d": 1.0}, {"d": 3.0}, {"d": 5.0}]', 'c = L[g.k]["d"] > 2'],
    "a key of a dictionary": ["d = {0: 1.5, 2: 2.5, 4: 3.0}", "c = d[g.k] > 2"],
    "the least of those above": ["s = min(z for z in SIZES if z > g.u * 3)", "c = s > 4"],
    "the first of those above": ["s = next(z for z in SIZES if z > g.u * 3)", "c = s > 4"],
    "the size behind a searched place": ["s = SIZES[np.searchsorted(SIZES, g.u * 3)]", "c = s > 4"],
    "the greatest of a list": ["c = max([q for q in g.F if q > g.u * 1.9]) > 2.7"],
    "the place in a list": ["i = [1.0, 2.0, 3.0, 4.0].index(float(g.k))", "c = i > 1"],
    "a name of one way": ["if g.k > 0:\n    t = g.x", "c = t > 0.5"],
    "a root": ["c = math.sqrt(g.x) > 0.5"],
    "a logarithm": ["c = math.log(g.x) < 0.5"],
    "an angle": ["c = math.asin(g.x) > 0.5"],
    "a quotient": ["c = 1 / g.x > 0.5"],
    "a quotient of differences": ["c = g.u / (g.x + 2.5) > 0.5"],
    "a power": ["c = g.x ** -0.5 > 0.5"],
    "what a division leaves": ["c = g.n % g.k > 0"],
    "a root beside what holds": ["c = math.sqrt(g.x) > 0.5 or g.on"],
    "the greatest of some": [W, "i = np.argmax(np.array([0.5, w[g.k]]))", "c = i > 0"],
    "the order of some": [W, "i = np.argsort(np.array([0.5, w[g.k]]))", "c = i[0] > 0"],
    "a root among sizes": ["c = sum(z > math.sqrt(g.x) for z in SIZES) > 3"],
    "the place of a root": ["c = np.searchsorted(SIZES, math.sqrt(g.x)) > 0"],
}
# For each fields that are not as long as each other, for some of the other inputs, which Python refuses.
UNLIKE = {
    "a comparison": "np.where(g.F > SIZES[:4], g.u, 1.0).sum()",
    "a condition of all": "np.all(g.F == [2.5, -1.0, 3.0, 0.5]) * g.u",
    "conditions": "np.sum((g.F > 0.6) & np.array([True, False, True, True])) * g.u",
    "a choice": "np.where(np.array([1.0, 0.0, 0.0, 1.0]) > g.x, g.F, g.u).sum()",
    "what is close": "np.isclose(g.F, [2.5, -1.0, 3.0, 0.5]).sum() * g.u",
    "steps": "np.gradient(g.F, [0.0, 1.0, 2.0, 4.0]).max()",
    "a table": "np.interp(g.u, np.arange(4.0), g.F)",
    "equations": "np.linalg.solve(np.eye(4) * 2.0 + g.u**2, g.F)[0]",
    "a product": "np.ones(g.n) @ np.arange(5.0) * g.u",
}
# For each a loop of which one turn compares a number that there is not, for some of the other inputs.
IN_TURNS = {
    "what ends it": "for w in SIZES:\n    if w > 1 / g.x:\n        break\n    s = s + w",
    "an element that ends it": "for i in range(3):\n    if SIZES[i + g.k] > 2.0:\n        break\n    s = s + 1.0",
    "a quotient of its number": "for i in range(4):\n    if i + 1 > 1 / (g.x - i + 2.5):\n        break\n    s = s + 1",
    "a number of turns": "for i in range(g.n):\n    if 1 / (g.x - i) > 0.4:\n        break\n    s = s + 1.0",
    "what it has made": (
        "w = 1.5\nfor i in range(g.n):\n    if w > 1 / (w - g.x):\n        break\n    w = w * 1.5\ns = s + w"
    ),
    "one in another": (
        "for w in (1, 2.5):\n    for v in (2, 3.0):\n        if v > w / g.x:\n            break\n        s = s + 1.0"
    ),
    "an element beyond the last": "for i in range(g.n):\n    if SIZES[i] > 100:\n        break\n    s = s + 1.0",
    "while it holds": "while s < 1 / g.x:\n    s = s + 0.5",
    "a way in it": "for w in SIZES:\n    if w > 4.0:\n        break\n    s = s + (w if w > 1 / g.x else 0.5)",
    "no turn before its end": "for w in SIZES:\n    if w > 0:\n        break\n    s = s + (w if w > 1 / g.x else 0.5)",
}
# For each what is made of a number that Python has an error for, where numpy has infinity.
MADE = {
    "springs in series": "1 / (1 / g.x + 1 / g.u)",
    "a function of them": "(lambda a, b: 1 / (1 / a + 1 / b))(g.x, g.u)",
    "a power": "(1 + g.x ** -2) ** -1",
    "an exponential": "math.exp(-1 / abs(g.x)) + g.u",
    "the least": "min(1 / abs(g.x), 5.0)",
    "an angle": "math.atan(1 / g.x)",
    "of a function of math": "1 / (1 + 1 / math.sin(g.x))",
    "of the greatest": "1 / (1 + 1 / max(g.x, 0.0))",
    "a sum": "sum(1 / (1 + 1 / (z - g.x)) for z in (1.5, 3.0, 0.0))",
    "one that numpy does not choose": "np.where(g.x == 0, 0.0, g.u / g.x).item()",
    "one of several": "np.select([g.x > 5, g.x == 0], [1.0, 2.0], g.u / g.x).item()",
    "a root that numpy does not choose": "np.where(g.x < 0, 0.0, math.sqrt(g.x)).item()",
    "a bare condition": "np.where(1 / g.x, 3.0, g.u).item()",
    "one asked for first": "g.u / g.x if g.x else 0.0",
    "numpy's quotient": "float(1 / (1 + np.divide(1.0, g.x + 2.5)))",
    "numpy's own": "np.where(g.x < 0, 0.0, np.sqrt(g.x + 0.1)).item()",
    "elements of an array": "float(np.sum(1 / (1 + 1 / (np.array(SIZES) - g.x))))",
}
INFINITE = "numpy's quotient", "numpy's own", "elements of an array"
# The same where Python asks first, or has a number in its place: there is one for all inputs.
ASKED = {
    "beside a condition": [W, "c = g.k < 4 and w[g.k] > 5"],
    "beside one that fails": [W, "c = g.k >= 4 or w[g.k] > 5"],
    "on a way": [W, "if g.k < 4:\n    c = w[g.k] > 5\nelse:\n    c = g.on"],
    "behind another way": [W, "if g.k >= 4:\n    c = g.on\nelif w[g.k] > 5:\n    c = True\nelse:\n    c = False"],
    "in a function": ["def f(k):\n    if k > 3:\n        return False\n    return SIZES[k] > 2", "c = f(g.k)"],
    "chosen before": [W, "v = w[g.k] if g.k < 4 else 0.5", "c = v > 2"],
    "a logarithm beside a condition": ["c = 0 < g.x and math.log(g.x) < 0.5"],
    "a key with another number": ["c = {0: 1.5, 2: 2.5}.get(g.k, 0.0) > 2"],
    "the first, or another number": ["c = next((z for z in SIZES if z > g.u * 3), 0.0) > 4"],
    "a key of each option": ["c = AREA[g.mode] > 2"],
    "an element that is no number": ["m = np.array([1.0, np.nan, 5.0, g.x, 2.0])", "c = m[g.k] > 2"],
    "a quotient beside a condition": ["c = g.x != 0 and 1 / g.x > 0.5"],
    "numpy's quotient": ["c = np.sin(g.u) / g.x > 0.5"],
    "numpy's root": ["c = np.sqrt(g.x) > 0.5"],
}


def test_a_page_shows_no_number_that_is_made_of_one_for_which_python_has_an_error(blank: Page, tmp_path: Path) -> None:
    """One over infinity is 0: springs in series of which one has no stiffness were shown with 0, without a word."""
    names = [f"y_{n}" for n in range(len(MADE))]
    every = list[list[float]]()
    for n, expression in enumerate(MADE.values()):  # one by one: an error would hide what is behind it
        (tmp_path / f"{n}").mkdir()
        every.append([x for (x,) in plain(sheet_of(tmp_path / f"{n}", [f"y_0 = {expression}"]), ["y_0"])])
    sheet = sheet_of(
        tmp_path, [f"{name} = {expression}" for name, expression in zip(names, MADE.values(), strict=True)]
    )
    recording = recorded(sheet, every=1, draws=True, lists=True)
    nodes = {n: recording.tables[name][0].re for n, name in enumerate(names)}
    looked = {n: [guard.holds for guard in recording.looked[f"z{name}"]] for n, name in enumerate(names)}
    found = by_page(blank, sheet, recording, nodes, looked)
    for n, (name, own) in enumerate(zip(MADE, every, strict=True)):
        np.testing.assert_allclose([shown.get(n, np.nan) for shown in found], own, err_msg=name)
        assert np.isnan(own).any() == (name not in ("one asked for first", *INFINITE)), name


@pytest.mark.parametrize("loop", IN_TURNS.values(), ids=IN_TURNS)
def test_a_page_takes_no_turns_where_python_has_an_error(loop: str, blank: Page, tmp_path: Path) -> None:
    """A turn that ends a loop, or does not, by a number that there is not."""
    sheet = sheet_of(tmp_path, ["s = 0.0", loop, "y_0 = s + g.u"])
    told = plain(sheet, ["y_0"])
    recording = recorded(sheet, every=1, draws=True, lists=True)
    nodes = {0: recording.tables["y_0"][0].re}
    looked = {0: [guard.holds for guard in recording.looked["zy_0"]]}
    found = by_page(blank, sheet, recording, nodes, looked)
    np.testing.assert_allclose([shown.get(0, np.nan) for shown in found], np.ravel(told))


@pytest.mark.parametrize("lines", [*NOT_THERE.values(), *ASKED.values()], ids=[*NOT_THERE, *ASKED])
def test_a_page_goes_no_way_where_python_has_an_error(lines: list[str], blank: Page, tmp_path: Path) -> None:
    """It went the other way; and a number that there is in another way is shown."""
    sheet = sheet_of(tmp_path, [*lines, "y_0 = 3.0 if c else g.u", "y_1 = 3.0 if not c else g.u"])
    told = plain(sheet, ["y_0", "y_1"])
    recording = recorded(sheet, every=1, draws=True, lists=True)
    nodes = {n: recording.tables[f"y_{n}"][0].re for n in (0, 1)}
    looked = {n: [guard.holds for guard in recording.looked[f"zy_{n}"]] for n in nodes}
    readers = by_reader(recording, nodes, looked, lists=True), by_page(blank, sheet, recording, nodes, looked)
    for found in readers:
        for each, shown, own in zip(OTHER, found, told, strict=True):
            np.testing.assert_allclose([shown.get(n, np.nan) for n in nodes], own, err_msg=str(each))


# What stands for what: $f a number, which may not exist, $i a place, $b a condition.
FORMS = {
    "f": [
        "g.x", "g.u", "0.5", "2.0", "SIZES[$i]", "g.F[$i]", "math.sqrt($f)", "math.log($f)", "(1 / $f)", "($f - $f)",
        "($f * $f)", "($f if $b else $f)", "{0: 1.5, 2: 2.5, 4: 3.0}[g.k]", "next(z for z in SIZES if z > $f)",
        "min(z for z in g.F if z > $f)", "max($f, $f)", "math.asin($f)", "np.sqrt($f)", "sum(z > $f for z in SIZES)",
    ],
    "i": ["g.k", "g.k + 2", "g.n", "1", "-1", "len(g.F) - g.k"],
    "b": ["$f > $f", "$f <= $f < $f", "($b and $b)", "($b or $b)", "(not $b)", "g.on", "any(z > $f for z in g.F)"],
}  # fmt: skip
SIMPLE = {"f": 6, "i": 4, "b": 1}  # of each kind how many forms lead to an end


def condition(random: Random, form: str = "$b", deep: int = 0) -> str:
    def part(found: re.Match[str]) -> str:
        forms = FORMS[found[1]]
        return condition(random, random.choice(forms[: SIMPLE[found[1]]] if deep > 2 else forms), deep + 1)

    return re.sub(r"\$(\w)", part, form)


@given(st.integers(0, 2**32 - 1))
@examples(20)
def test_conditions_written_at_random_go_no_way_where_python_has_an_error(blank: Page, seed: int) -> None:
    line = f"y_0 = 3.0 if {condition(Random(seed))} else g.u"
    with TemporaryDirectory() as folder:
        sheet = sheet_of(Path(folder), [line])
        told = [own for (own,) in plain(sheet, ["y_0"])]
        assume(np.isfinite(told[0]))
        recording = recorded(sheet, every=1, draws=True, lists=True)
        (column,) = recording.tables["y_0"]
        assume(column is not None)
        found = by_page(blank, sheet, recording, {0: column.re}, {0: [g.holds for g in recording.looked["zy_0"]]})
    for each, shown, own in zip(OTHER, found, told, strict=True):
        number = shown.get(0, np.nan)
        assert not np.isfinite(number) or number == own, (line, each, number, own)


@pytest.mark.parametrize("expression", UNLIKE.values(), ids=UNLIKE)
def test_a_page_has_no_number_where_lists_are_not_as_long_as_each_other(
    expression: str, blank: Page, tmp_path: Path
) -> None:
    """A row that was put in was compared with nothing, and told to be smaller or left out."""
    sheet = sheet_of(tmp_path, [f"y_0 = {expression}"])
    told = plain(sheet, ["y_0"])
    recording = recorded(sheet, every=1, draws=True, lists=True)
    nodes = {0: recording.tables["y_0"][0].re}
    looked = {0: [guard.holds for guard in recording.looked["zy_0"]]}
    (found,) = [by_page(blank, sheet, recording, nodes, looked)]
    np.testing.assert_allclose([shown.get(0, np.nan) for shown in found], np.ravel(told))


def test_why_there_is_none_is_told(tmp_path: Path) -> None:
    sheet = sheet_of(tmp_path, [*NOT_THERE["an element of an array"], "y_0 = 3.0 if c else g.u"])
    recording = recorded(sheet, every=1, draws=True, lists=True)
    (guard,) = recording.guards.values()
    assert javascript.otherwise(guard).endswith("it needs a number that does not exist for these inputs")


def test_that_lists_are_not_as_long_as_each_other_is_told(tmp_path: Path) -> None:
    sheet = sheet_of(tmp_path, [f"y_0 = {UNLIKE['a comparison']}"])
    recording = recorded(sheet, every=1, draws=True, lists=True)
    told = {javascript.otherwise(guard).partition(": ")[2] for guard in recording.looked["zy_0"]}
    assert told == {"what goes together here is not as long as each other for these inputs"}


def test_cells_have_an_error_themselves(recalculated_all: Callable[[list[Path]], list[Any]], tmp_path: Path) -> None:
    """So nothing is noted for them, which would stand in every formula."""
    lines, every = list[str](), list[list[float]]()
    for n, own in enumerate(NOT_THERE.values()):
        folder = tmp_path / str(n)
        folder.mkdir()
        every.append([x for (x,) in plain(sheet_of(folder, [*own, "y_0 = 3.0 if c else g.u"]), ["y_0"])])
        lines += [*own, f"y_{n} = 3.0 if c else g.u"]
    sheet = sheet_of(tmp_path, lines)
    path = tmp_path / "own.xlsx"
    path.write_bytes(
        report.workbook("", {**sheet.run(sheet.results, {"g": sheet.inputs()}), "__file__": sheet.path}, {})
    )
    rows = load_workbook(path)["Inputs"].iter_rows(min_row=3, values_only=True)
    at = {symbol: ("Inputs", f"B{row}") for row, (symbol, *_) in enumerate(rows, 3)}
    typed_in = [k for k, each in enumerate(OTHER) if each.keys() <= {"k", "x", "u", "mode", "on"}]
    paths = [typed(path, {at[name]: x for name, x in OTHER[k].items()}, tmp_path / f"{k}.xlsx") for k in typed_in]
    refused = set[str]()
    for k, book in zip(typed_in, recalculated_all(paths), strict=True):
        for n, (name, own) in enumerate(zip(NOT_THERE, every, strict=True)):
            shown = book[f"y_{n} Alone"]["A5"].value
            assert str(shown).startswith("#") or shown == own[k], (name, OTHER[k], shown)
            refused |= {name} if np.isnan(own[k]) else set()
    assert refused == {*NOT_THERE}
