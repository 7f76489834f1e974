"""Long tables and curves of many points, on the page and in the page in one file: nobody misses what is left out."""

from __future__ import annotations

import json
import re
from html import unescape
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from mechsheet.document import chart, chart_svg, drawing_svg
from mechsheet.document.shortened import APART, ENDS, MOST, apart, thinned
from mechsheet.html import javascript
from mechsheet.page import values
from mechsheet.worksheet.drawing import Drawing
from mechsheet.worksheet.table import Column, Figure, Table

if TYPE_CHECKING:
    from playwright.sync_api import Page

MANY = 10_007


def column(name: str, x: np.ndarray) -> Column:
    return Column(name, "m", "length", 3, x, of=name)


def figure() -> Figure:
    """Curves with a spike, a jump, gaps of one point and of many, and a lone point between two gaps."""
    x = np.linspace(0, 1, MANY)
    y, z = np.sin(40 * x), np.where(x < 0.3, -1.0, x)
    y[5003], y[7000:7400], z[123], z[8000:8005], z[8002] = 3, np.nan, np.nan, np.nan, 0.5
    return Figure("1", "Curves", column("x", x), (column("y", y), column("z", z)))


def test_a_table_shows_the_rows_at_both_ends_and_tells_how_many_it_leaves_out() -> None:
    k, x = np.arange(MANY), np.linspace(0, 1, MANY)
    text = values.html(Table("1", "Long", (Column("k", "-", "number", 0, k), column("x", x))))
    first = [int(row) for row in re.findall(r"<tr><td>(\d+)</td>", text)]
    assert first == [*range(ENDS), *range(MANY - ENDS, MANY)]
    assert f"rows {ENDS + 1} to {MANY - ENDS} of {MANY} are not shown" in text
    told = json.loads(unescape(re.search(r"columns=(['\"])(.*?)\1", text)[2]))
    assert told[1]["values"] == [*x[:ENDS], *x[-ENDS:]], "in another unit they are the same rows"


def test_a_table_that_is_no_longer_than_both_ends_is_whole() -> None:
    text = values.html(Table("1", "Short", (column("x", np.linspace(0, 1, 2 * ENDS)),)))
    assert text.count("<tr><td>") == 2 * ENDS and "not shown" not in text


def test_a_thinned_curve_reaches_what_the_whole_one_does_and_has_its_gaps() -> None:
    whole, few = figure(), thinned(figure())
    at = np.searchsorted(whole.x.values, few.x.values)
    assert np.array_equal(whole.x.values[at], few.x.values) and at.size < 2 * MOST
    for own_line, line in zip(whole.lines, few.lines, strict=True):
        assert np.array_equal(own_line.values[at], line.values, equal_nan=True)
        for start, end in pairwise(np.arange(101) * MANY // 100):  # six pixels each
            own_part = own_line.values[start:end]
            part = own_line.values[at[(at >= start) & (at < end)]]
            if np.isfinite(own_part).any():
                assert (np.nanmin(part), np.nanmax(part)) == (np.nanmin(own_part), np.nanmax(own_part))
        gaps = [np.count_nonzero(np.diff(np.isnan(x).astype(int)) == 1) for x in (own_line.values, line.values)]
        assert gaps[0] == gaps[1] > 0
    assert 3 in few.lines[0].values and 0.5 in few.lines[1].values
    pictures = [chart_svg.svg(chart.line_chart(shown.x, shown.lines)) for shown in (whole, few)]
    assert len(pictures[1]) < len(pictures[0]) / 3
    short = Figure("1", "Short", column("x", np.arange(MOST)), (column("y", np.arange(MOST)),))
    assert thinned(short) is short


def test_the_page_in_one_file_thins_the_same_points(blank: Page) -> None:
    whole = figure()
    columns = [column.values for column in (whole.x, *whole.lines)]
    numbers = "columns.map(values => values.map(x => x ?? NaN))"
    script = f"columns => {{ {javascript.runtime('chart.js')}\n return pointsShown({numbers}) }}"
    given = [[x if np.isfinite(x) else None for x in values.tolist()] for values in columns]
    at = blank.evaluate(script, given)
    assert np.array_equal(whole.x.values[at], thinned(whole).x.values)


def test_a_path_of_many_points_is_nowhere_farther_off_than_one_sees() -> None:
    """To and fro, round, and at rest: each point left out is within half a pixel of one before it that stays."""
    t = np.linspace(0, 1, MANY)
    path = np.concatenate([300 * np.abs(t - 0.5), 200 * np.exp(2j * np.pi * t), np.full(MANY, 7j)]).tolist()
    few = apart(path)
    assert few[0] == path[0] and few[-1] == path[-1] and len(few) < len(path) / 3
    at, kept = -1, iter(few[1:])
    following, last = next(kept), few[0]
    for point in path:
        if point == following:
            last, following, at = point, next(kept, None), at + 1
        assert abs(point - last) <= APART
    assert at == len(few) - 2 and apart(path[:MOST]) == path[:MOST]
    drawing = Drawing(frame=path[:10]).path(path)
    assert len(drawing_svg.svg(drawing)) < 30 * len(few)
