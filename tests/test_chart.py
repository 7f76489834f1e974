"""Charts, read back from their SVG: what stands where, in which unit, and where nothing is drawn."""

import json
import re
from dataclasses import dataclass
from html import unescape

import numpy as np
import pytest

from mechsheet.document import chart
from mechsheet.document.axis import axis
from mechsheet.document.chart_svg import svg as written
from mechsheet.document.chart_svg import variable
from mechsheet.worksheet.symbol import Symbol, read


@dataclass(frozen=True)
class Q:
    symbol: str
    unit: str
    values: np.ndarray
    decimals: int = 3

    @property
    def name(self) -> str:
        return self.symbol


S = Q("S", "m", np.linspace(0.42, 0.67, 6))


def drawn(*lines: Q, **more) -> str:
    return written(chart.line_chart(S, lines, **more))


def points(svg: str, colour: str = chart.COLOURS[0]) -> list[list[complex]]:
    path = re.search(rf'<path stroke="{colour}"[^>]* d="([^"]*)"', svg)[1]
    return [[complex(*map(float, p.split())) for p in piece.split("L")] for piece in path.split("M")[1:]]


def ticks(svg: str, anchor: str) -> list[tuple[float, float]]:
    """Place [px] and number of the ticks of the axis whose texts are anchored so."""
    found = re.findall(rf'<text x="([\d.]+)" y="([\d.]+)" text-anchor="{anchor}"[^>]*>(−?[\d.]+)</text>', svg)
    return [(float(x if anchor == "middle" else y), float(n.replace("−", "-"))) for x, y, n in found]


@pytest.mark.parametrize("scale", [1, 1e-7, -3e9])
def test_curve_stands_where_the_ticks_say(scale):
    """The line through the ticks of each axis gives the values back, powers of ten in the title counted."""
    y = Q("F_gc", "N", scale * np.array([1.0, 2.0, 4.0, 3.0, -1.0, 0.5]))
    svg = drawn(y)
    (curve,) = points(svg)
    power = re.search(r"10([⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+) N\]", svg)
    factor = 10.0 ** int(power[1].translate(str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789"))) if power else 1.0
    (x1, a1), *_, (x2, a2) = ticks(svg, "middle")
    (y1, b1), *_, (y2, b2) = ticks(svg, "end")
    plot = chart.line_chart(S, [y]).plot
    left, top = plot.left, plot.top
    x = [a1 + (p.real + left - x1) / (x2 - x1) * (a2 - a1) for p in curve]
    f = [factor * (b1 + (p.imag + top + 4 - y1) / (y2 - y1) * (b2 - b1)) for p in curve]
    assert x == pytest.approx(S.values, abs=2e-4)
    assert f == pytest.approx(y.values, abs=3e-3 * np.ptp(y.values))


def test_what_is_not_finite_is_a_gap():
    pieces = points(drawn(Q("x", "-", np.array([1, 2, np.nan, 4, np.inf, 6]))))
    assert [len(piece) for piece in pieces] == [2, 1, 1]
    assert drawn(Q("x", "-", np.full(6, np.nan))).startswith("<svg"), "nothing to draw"
    assert drawn(Q("x", "-", np.full(6, 7.0))).startswith("<svg"), "one value"


def test_mark_stands_at_its_place_under_its_symbol():
    svg = drawn(Q("x", "-", np.arange(6.0)), marks=[("S_p", 0.545)])
    place = float(re.search(r'class="ms-mark"[^>]* d="M([\d.]+) 0', svg)[1])
    (curve,) = points(svg)
    assert place == pytest.approx((curve[0].real + curve[-1].real) / 2, abs=0.06)
    assert ">S</tspan><tspan" in svg and ">p</tspan>" in svg and "S_p" not in svg


def test_moving_mark_is_placed_in_si():
    svg = written(chart.line_chart(Q("phi1", "deg", np.array([0.0, 90.0, 180.0])), [Q("x", "-", np.arange(3.0))]))
    name, low, scale = re.search(r"var\((--at-\w+),-1e30\) - (\S+)\) / (\S+) \*", svg).groups()
    (curve,) = points(svg)
    assert name == variable("phi1")
    assert (np.pi / 2 - float(low)) / float(scale) == pytest.approx(curve[1].real, abs=0.06)


def test_lines_have_a_legend_and_hovering_shows_their_values():
    svg = drawn(Q("G56", "N", np.arange(6.0), 0), Q("dRa", "%", np.array([1, 2, np.nan, 4, 5, 6.25]), 1))
    assert svg.count('stroke-width="2.2"') == 2
    values = json.loads(unescape(re.search(r"data-values=\'([^\']*)\'", svg)[1]))
    assert values["names"] == ["<i>S</i>", "<i>G</i><sub>56</sub>", "Δ<i>R</i><sub>a</sub>"]
    assert values["units"] == ["m", "N", "%"]
    assert [column[2] for column in values["texts"]] == ["0.520", "2", "–"]
    assert "[N]; " in svg and "[%]" in svg


def test_an_axis_says_where_a_number_has_no_unit_and_others_have():
    """`w; eta [%]` stood at an axis of per cent, along which w = 0.5 was drawn at 0.5."""
    w = Q("w", "-", np.linspace(0.5, 1.0, 6))
    assert "[-]; " in drawn(w, Q("eta", "%", np.linspace(60.0, 80.0, 6))) and "[-]" not in drawn(w)


def test_every_so_many_values_are_marked_by_points():
    """The positions that a table lists, on a curve through more of them; all of them would hide the line."""
    x = Q("S", "m", np.linspace(0.0, 1.0, 61))
    y = Q("F", "N", x.values**2)
    circles = re.findall(r'cx="(\S+)" cy="(\S+)"', written(chart.line_chart(x, [y], every=10)))
    assert [complex(float(u), float(v)) for u, v in circles] == points(written(chart.line_chart(x, [y])))[0][::10]
    assert "<circle" not in written(chart.line_chart(x, [y]))


@pytest.mark.parametrize(("last", "step"), [(360, 60), (170, 30), (90, 15), (720, 180), (40, 10)])
def test_an_axis_in_degrees_is_divided_as_a_circle_is(last, step):
    svg = written(chart.line_chart(Q("phi1", "deg", np.array([0.0, last])), [Q("x", "-", np.arange(2.0))]))
    assert [n for _, n in ticks(svg, "middle")] == list(range(0, last + step, step))[: -(-last // step) + 1]


@pytest.mark.parametrize("last", [3e4, 28308.25, 0.01, 1.0])
def test_the_last_tick_is_within_the_picture(last):
    """It stands under the end of the axis, half of it beyond: a digit is about half as wide as high."""
    layout = chart.line_chart(Q("F", "lbf", np.array([0.0, last])), [Q("x", "-", np.arange(2.0))])
    tick = layout.texts[len(layout.columns) - 1]
    assert tick.x + 0.56 * 13 * len(tick.parts[0]) / 2 <= layout.width


def test_a_layout_is_data_that_another_writer_can_draw():
    """Curves inside the plot, ticks under it, every text in the picture."""
    layout = chart.line_chart(S, [Q("F", "N", np.arange(6.0)), Q("G", "N", np.array([0, 1, np.nan, 3, 4, 5.0]))])
    for curve in layout.curves:
        inside = np.isfinite(curve.y)
        assert np.all((curve.x >= 0) & (curve.x <= layout.plot.width))
        assert np.all((curve.y[inside] >= 0) & (curve.y[inside] <= layout.plot.height))
    assert [np.isnan(curve.y).tolist().count(True) for curve in layout.curves] == [0, 1]
    bottom = layout.plot.top + layout.plot.height
    across = [label for label in layout.texts if label.anchor == "middle" and bottom < label.y < layout.height - 10]
    assert [label.x for label in across] == pytest.approx([layout.plot.left + u for u in layout.columns])
    assert all(0 < label.x < layout.width and 0 < label.y < layout.height for label in layout.texts)
    assert [sample.label.parts for sample in layout.legend] == [(read("F"),), (read("G"),)]
    assert {type(part) for label in layout.texts for part in label.parts} == {str, Symbol}


@pytest.mark.parametrize("values", [[0.3, 0.9], [-1e-10, 1e-10], [1.75e-10, 2e-10], [-3e9, 7e9], [5.0], [], [np.nan]])
def test_an_axis_ends_on_the_ticks_next_to_its_values(values):
    made = axis([values], count=5)
    known = [v for v in values if np.isfinite(v)] or [made.low]
    slack = 1e-9 * made.step
    assert made.low - slack <= min(known) and max(known) <= made.high + slack
    assert len(set(known)) < 2 or (min(known) < made.low + made.step and made.high - made.step < max(known))
    assert made.ticks == pytest.approx(np.arange(len(made.ticks)) * made.step + made.low, abs=1e-9 * made.step)
    assert made.ticks[-1] == pytest.approx(made.high, abs=1e-9 * made.step)
    assert len({made.text(tick) for tick in made.ticks}) == len(made.ticks), "texts tell the ticks apart"
