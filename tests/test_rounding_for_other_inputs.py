"""What is nothing but rounding for other inputs is about nothing there, and tells no place of a greatest number."""

from pathlib import Path

import numpy as np
import pytest
from own_worksheet import own, recorded, value_of
from playwright.sync_api import Page
from test_html_guards import shown

from mechsheet import evaluate
from mechsheet.readers.numbers import numbers

LEFT = """u = np.cos(x / g.F)  # [-] of no input
d = (u + 0.1) - 0.1 - u + (g.F - 3.25) * x  # [-] what is left
"""
PLACES = {
    "function": "y = np.argmax(np.abs(d)) + g.a",
    "method": "y = d.argmin() + g.a",
    "order": "y = x[np.argsort(d)]",
    "function of its own": "def place(field):\n    return np.argmax(field)\ny = x[place(d)]",
    "of rows": "y = np.argmax(np.stack([d, -d]), axis=1) + g.a",
}


@pytest.mark.parametrize("place", PLACES)
def test_rounding_tells_no_place(place: str, tmp_path: Path) -> None:
    """Of what the worksheet itself computes; for other inputs the place is followed."""
    sheet = own(
        tmp_path,
        f"{LEFT}{PLACES[place]}\nresult = np.atleast_1d(y) * 1  # [-] line\ntable_2 = table('2', 'Two', result)",
    )
    _, recording = recorded(sheet)
    assert not recording.gaps
    for F, known in ((2.75, True), (4.0, True), (3.25, False)):
        value = value_of(recording, "result", {"F": F})
        assert np.isfinite(value).all() == known
        if known:
            np.testing.assert_allclose(value, evaluate(sheet.path, ["result"], F=F)["result"], rtol=1e-12)
    _, recording = recorded(sheet, F=3.25)
    (column,) = recording.tables["2"]
    assert column is not None and "rounding alone" in recording.gaps[0].reason
    assert np.isnan(numbers([column.re], {recording.inputs["F"]: 2.75})[column.re]).all()


@pytest.mark.parametrize("field", ["np.full(5, g.F)", "np.zeros(5) * g.F", "np.sin(x)", "np.array([g.F, g.F, g.a])"])
def test_numbers_that_are_the_same_by_what_they_are_keep_their_places(field: str, tmp_path: Path) -> None:
    _, recording = recorded(own(tmp_path, f"y = np.argmax({field}) + g.a  # [-] line\ntable_2 = table('2', 'Two', x)"))
    assert not recording.gaps
    assert np.isfinite(value_of(recording, "y", {"F": 3.25}))


PEAKS = "p = np.array([0.1 * g.a + 0.2 * g.a, 0.05, 0.3 * g.a])"  # the two greatest are apart by rounding
TIED = {
    "function": "y = np.argmax(p) + g.a",
    "least": "y = np.argmin(-p) + g.a",
    "order": "y = np.argsort(p) * g.a",
    "of rows": "y = np.argmax(np.stack([p, p]), axis=1) + g.a",
}


@pytest.mark.parametrize("place", TIED)
def test_two_that_rounding_tells_apart_tell_no_place(place: str, tmp_path: Path) -> None:
    """Cells compute with other last bits: where the first of several peaks stood, they had another one."""
    end = "result = np.atleast_1d(y) * 1  # [-] line\ntable_2 = table('2', 'Two', result)"
    sheet = own(tmp_path, f"{PEAKS}\n{TIED[place]}\n{end}")
    _, recording = recorded(sheet)
    assert "two of the numbers differ by rounding alone" in recording.gaps[0].reason
    if place != "order":  # which here has others that come near
        _, recording = recorded(sheet, a=0.1)
        assert not recording.gaps, "another one is the greatest"


def test_of_equal_numbers_the_first_is_taken_everywhere(tmp_path: Path) -> None:
    """Those that a limit makes equal have one place, and so have numbers that are given."""
    lines = "y = np.argmax(np.minimum(np.sin(x), g.a)) + np.argmax([g.F, g.a, g.F])  # [-] line"
    _, recording = recorded(own(tmp_path, f"{lines}\ntable_2 = table('2', 'Two', x)"))
    assert not recording.gaps


def test_a_page_tells_rounding_of_other_inputs_as_the_worksheet_does(blank: Page, tmp_path: Path) -> None:
    """Also what a function of several sums leaves, and a root of its squares; a place is grey."""
    lines = f"""{LEFT}m = np.polyfit(x, d, 1)[0]  # [-] slope
r = np.sqrt(np.mean(d**2))  # [-] root of mean square
w = np.sort(np.abs(d))  # [-] by size
z = 2 * np.max(np.abs(d))  # [-] twice the greatest
k = np.argmax(d)  # [-] its place"""
    sheet = own(tmp_path, lines)
    for F in (2.75, 3.25):
        here, there = shown(blank, tmp_path / "a.html", sheet, f"F={F}"), shown(blank, tmp_path / "b.html", sheet, F=F)
        assert {name: text for name, text in here.items() if name != "k"} == {
            n: x for n, x in there.items() if n != "k"
        }
        assert [here[name][0].startswith("≈ 0") for name in "dmrwz"] == [F == 3.25] * 5
        assert bool(here["k"][1]) == (F == 3.25)
    assert here["k"] == ("", "line 43: the numbers differ by rounding alone, which tells no place")
