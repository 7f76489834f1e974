"""Charts on the page: a part of them under the pointer, in a real browser."""

from __future__ import annotations

import base64
import json
import re

import marimo as mo
import numpy as np
import pytest
from test_page_units import STYLE, choose

from mechsheet.page import notebook, script, smooth, values
from mechsheet.worksheet.table import Column, Figure, Table

CALLED = re.compile('base64,([^"]*)')


@pytest.fixture
def charts(page):
    """A page of two forces over a stroke, whose columns switch units."""
    S = Column("S", "m", "stroke", 3, np.linspace(0.1, 0.5, 9), of="S")
    F = Column("F", "N", "force", 0, 1e4 * np.linspace(0.1, 0.5, 9) ** 2, of="F")
    G = Column("G", "N", "force", 0, np.linspace(1e3, 3e3, 9), of="G")
    figure = Figure("1", "Forces", S, (F, G), marks=(("S_p", 0.32),))
    page.set_content(f"<style>{STYLE}</style><body>{values.html(Table('1', 'Forces', (S, F, G)))}{values.html(figure)}")
    page.add_script_tag(content=base64.b64decode(CALLED.search(script.script("units.js", "format.js"))[1]).decode())
    shared = ("tooltip.js", "format.js", "chart.js")
    page.add_script_tag(content=base64.b64decode(CALLED.search(script.script("chart.js", *shared))[1]).decode())
    return page


def plot(page) -> dict[str, float]:
    """The plot in the window."""
    frame = "e => { const b = e.getBoundingClientRect(); return [b.x, b.y, b.width / e.viewBox.baseVal.width] }"
    chart = page.locator("svg.ms-chart:visible")
    x, y, scale = chart.evaluate(frame)
    x0, y0, width, height = (float(chart.locator("> svg").get_attribute(n)) for n in ("x", "y", "width", "height"))
    return {"x": x + scale * x0, "y": y + scale * y0, "width": scale * width, "height": scale * height}


def drag(page, x: tuple[float, float], y: tuple[float, float]) -> None:
    """From one place to another, as parts of the plot from its upper left corner."""
    of = plot(page)
    begin, end = ((of["x"] + u * of["width"], of["y"] + v * of["height"]) for u, v in zip(x, y, strict=True))
    page.mouse.move(*begin)
    page.mouse.down()
    page.mouse.move(*end, steps=3)
    page.mouse.up()


def across(page) -> list[str]:
    return page.locator("svg.ms-chart:visible > g > text[text-anchor=middle]").all_text_contents()


def test_a_part_that_is_dragged_out_has_its_own_ticks_and_values_in_any_unit(charts):
    """The curves stay data: what the pointer tells and where a tick stands is as in the whole."""
    page, whole = charts, across(charts)
    drag(page, (0.25, 0.5), (0.5, 0.5))  # across alone: up the axis stays
    assert across(page) == ["0.20", "0.22", "0.24", "0.26", "0.28", "0.30", "S [m]"]
    up = page.locator("svg.ms-chart:visible > g > text[text-anchor=end]").all_text_contents()
    assert (up[0], up[-1]) == ("0", "3000")
    choose(page, page.locator("th ms-unit:visible").first, "mm")
    assert across(page) == ["200", "220", "240", "260", "280", "300", "S [mm]"]
    of = plot(page)
    page.mouse.move(of["x"] + 0.45 * of["width"], of["y"] + 50)
    assert page.locator(".ms-tip").inner_text().splitlines() == ["S = 250 mm", "F = 625 N", "G = 1750 N"]
    tip, middle = page.locator(".ms-tip").bounding_box(), of["x"] + 0.5 * of["width"]
    assert tip["x"] == pytest.approx(middle + 14, abs=2), "0.25 m is in the middle of 0.2 .. 0.3 m"
    choose(page, page.locator("th ms-unit:visible").first, "m")
    page.mouse.dblclick(of["x"] + 5, of["y"] + 50)
    assert across(page) == whole
    assert page.locator(".ms-part").count() == 0


def test_a_wheel_with_ctrl_enlarges_where_the_pointer_is_and_a_part_lies_within_the_axes(charts):
    page, of = charts, plot(charts)
    page.mouse.move(of["x"] + of["width"] / 2, of["y"] + of["height"] / 2)
    page.mouse.wheel(0, -1)
    page.keyboard.down("Control")
    assert page.locator(".ms-part").count() == 0, "a wheel alone moves the page"
    for _ in range(40):
        page.mouse.wheel(0, -300)
    page.keyboard.up("Control")
    page.locator("svg.ms-part").wait_for()
    view = page.locator("svg.ms-part > svg")
    box = "e => { const v = e.viewBox.baseVal; return [v.x, v.y, v.width, v.height] }"
    page.wait_for_function(f"() => ({box})(document.querySelector('svg.ms-part > svg'))[2] < 30")
    x, y, width, height = view.evaluate(box)
    assert (width, height) == pytest.approx((of["width"] / 20, of["height"] / 20), rel=1e-3), "no further"
    assert (x + width / 2, y + height / 2) == pytest.approx((of["width"] / 2, of["height"] / 2), rel=0.01)
    drag(page, (0.9, 0.9), (3.0, -2.0))  # what is dragged over the edge ends there
    assert view.evaluate(box)[0] + view.evaluate(box)[2] <= of["width"] * (1 + 1e-9)
    page.get_by_text("show the whole").click()
    assert page.locator(".ms-part").count() == 0


def test_a_part_stays_when_the_chart_is_drawn_anew_and_its_texts_keep_their_shape(charts):
    page, label = charts, charts.locator("svg.ms-chart:visible > svg text")
    own = label.bounding_box()
    drag(page, (0.5, 0.2), (0.75, 0.6))
    shown = label.bounding_box()
    assert (shown["y"], shown["width"]) == pytest.approx((own["y"], own["width"]), rel=0.02)
    before = across(page)
    values_now = json.loads(page.locator("svg.ms-part").get_attribute("data-values"))
    page.evaluate("""() => {
      const chart = document.querySelector("ms-figure svg.ms-chart:not(.ms-part)");
      const values = JSON.parse(chart.dataset.values);
      values.texts[1] = values.texts[1].map(() => "7");
      chart.dataset.values = JSON.stringify(values);
    }""")
    page.locator("svg.ms-part[data-values*='[\"7\"']").wait_for()
    assert across(page) == before
    assert values_now["axes"][0] == {"low": 0.1, "high": 0.5, "power": 0, "unit": "m", "factor": 1.0}


COMMON = "from mechsheet import sweep\nfrom numpy import arange, cumsum, linspace, gradient, sin"
CELLS = (
    "S = linspace(0.1, 0.5, 9)",
    "F = sin(9 * S)",
    "def G(S): return F_0 + S\nF_0 = 2.0",
    "G_S = G(S)\nk = arange(9)",
    "I = cumsum(F)\nK = S * k\nD = gradient(F, S)",
    "C = linspace(1, 2, 9)",
    "Z = F + 1j * G_S",
    "t = linspace(\n    0, 1, 9)\nQ = t**3\nt_S = S / 4",
    "found = sweep and S * 2",
)
DEFINES = ("S", "F", "G F_0", "G_S k", "I K D", "C", "Z", "t Q t_S", "found")
READS = ("", "S", "", "S G", "F S k", "", "F G_S", "S", "S sweep")


@pytest.fixture
def curves(monkeypatch):
    """What becomes of a curve over S in a page of these cells."""
    namespace: dict[str, object] = {}
    exec("\n".join((COMMON, *CELLS)), namespace)
    cells = tuple(
        notebook.Cell(
            f"c{n}", code, f"c{n}", frozenset(gives.split()), frozenset(reads.split()), "success", None, False
        )
        for n, (code, gives, reads) in enumerate(zip(CELLS, DEFINES, READS, strict=True))
    )
    monkeypatch.setattr(notebook, "running", lambda: (lambda: cells, namespace))
    monkeypatch.setattr(mo, "running_in_notebook", lambda: True)

    def column(want: str) -> Column:
        return Column(want, "-", "", 3, np.asarray(eval(want, namespace), float), want=want)

    return namespace, lambda *wants, over="S": smooth.smooth(Figure("1", "", column(over), tuple(map(column, wants))))


def test_a_curve_is_computed_between_the_points_of_a_table(curves):
    namespace, drawn = curves
    figure = drawn("F", "G_S", "abs(Z)", "Z.imag")
    x = figure.x.values
    assert len(x) == 121 and figure.every == 15
    np.testing.assert_array_equal(x[::15], namespace["S"])
    F, G, size, imaginary = (line.values for line in figure.lines)
    np.testing.assert_allclose(F, np.sin(9 * x), rtol=1e-15, atol=1e-15)
    np.testing.assert_allclose([G, imaginary], [2 + x, 2 + x], rtol=1e-15)
    np.testing.assert_allclose(size, np.hypot(F, G), rtol=1e-15)
    cube = drawn("Q", over="t")  # of the same cell as what it depends on
    np.testing.assert_allclose(cube.lines[0].values, cube.x.values**3, rtol=1e-15)
    namespace["F_0"] = 3.0  # of the same page, an input later
    namespace["G"] = lambda S: 3.0 + S
    namespace["G_S"] = namespace["G"](namespace["S"])
    np.testing.assert_allclose(drawn("G_S").lines[0].values, 3 + x, rtol=1e-15)


@pytest.mark.parametrize(
    ("wants", "over", "why"),
    [
        (("I",), "S", "a sum over the positions depends on how many there are"),
        (("D",), "S", "so does a difference from one to the next"),
        (("K",), "S", "their numbers are not between each other"),
        (("C",), "S", "it does not depend on what stands across"),
        (("F", "I"), "S", "one of them alone would be smooth"),
        (("found",), "S", "a search would be done again, over more positions"),
        (("S",), "F", "the other way round, and F turns back"),
        (("I",), "k", "there is no position between 1 and 2"),
    ],
)
def test_points_are_joined_by_straight_lines_where_nothing_is_known_between_them(curves, wants, over, why):
    figure = curves[1](*wants, over=over)
    assert (len(figure.x.values), figure.every) == (9, 1), why
