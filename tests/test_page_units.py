"""Display units that are switched in place on the page, in a real browser."""

import json
from base64 import b64decode
from decimal import Decimal
from itertools import pairwise
from math import log10
from pathlib import Path

import numpy as np
import pytest
from conftest import drawn, until
from playwright.sync_api import expect
from test_page import HITCH, choose

from mechsheet.document.shortened import ENDS
from mechsheet.html.javascript import runtime
from mechsheet.page import own, script, switched, values
from mechsheet.units import parse, shown
from mechsheet.worksheet import numbers
from mechsheet.worksheet.check import check
from mechsheet.worksheet.table import Column, Figure, Table


def decoded(*names: str) -> str:
    return b64decode(script.script(*names).split(",")[1].split('"')[0]).decode()


SCRIPT = decoded("units.js", "format.js")
ROWS = runtime("rows.js")
STYLE = HITCH.with_name("page.css").read_text(encoding="utf-8")
HALVES = [0.5, 1.5, 2.5, -0.5, 0.125, 0.375, -2.125, 9.5, 99.5, 0.0625, 1e-300, 1e22, -3e25, 0.0, -0.0, -4e-9]
NONE = [np.nan, np.inf, -np.inf]


def static(page, html: str) -> None:
    """A page of this alone, with the script of the units."""
    page.set_content(f"<style>{STYLE}</style><body>{html}</body>")
    page.add_script_tag(content=SCRIPT)


@pytest.mark.parametrize("top", [3, 25])  # of the greatest number hangs how many decimals there are
@pytest.mark.parametrize(
    ("unit", "other", "decimals", "power"),
    [
        *[("m", "mm", 3, False), ("mm", "m", 1, False), ("N", "kgf", 0, False), ("N", "MN", 0, False)],
        *[("deg", "rad", 1, False), ("rad", "deg", 3, False), ("MPa", "psi", 2, False), ("kN", "N", 5, False)],
        *[("m", "km", 3, True), ("m", "inch", 0, True), ("kgf", "tf", 1, True), ("Pa", "kPa", 2, True)],
        *[("mm", "cm", 1, False), ("cm", "mm", 2, True)],
    ],
)
def test_a_number_is_written_as_the_library_writes_it(
    page, unit: str, other: str, decimals: int, power: bool, top: int
) -> None:
    random = np.random.default_rng(18)
    own, factor = parse(unit).factor, parse(other).factor
    halves = np.array(HALVES) * factor / own  # halves in the other unit, where that is exact
    drawn = random.normal(size=1500) * 10 ** random.uniform(-12, top, 1500)
    rounded = np.round(random.normal(size=500), decimals) + 0.5 * 10.0**-decimals
    all_of_them = np.array([*halves, *HALVES, *drawn, *rounded])
    numbers_of_all = np.array([*all_of_them[abs(all_of_them) < 10**top], *NONE])
    few = [numbers_of_all[k : k + 2 * ENDS] for k in range(0, len(numbers_of_all), 2 * ENDS)]  # tables shown whole
    columns = [Column("F", unit, "force", decimals, each, power, of="F") for each in few]
    tables = [Table(str(n), "Forces", (column,)) for n, column in enumerate(columns)]
    static(page, "".join(map(values.html, tables)))
    choose(page, page.locator("ms-unit").first, shown(other))
    found = page.locator(".ms-chosen td").all_text_contents()
    wanted = [column.values * own / factor for column in columns]
    greatest = [Decimal(float(np.abs(x[np.isfinite(x)]).max())).adjusted() for x in wanted]
    places = [max(0, min(decimals + round(log10(factor / own)), 4 - most)) for most in greatest]
    pairs = [(x, digits) for each, digits in zip(wanted, places, strict=True) for x in each.tolist()]
    for text, (x, digits) in zip(found, pairs, strict=True):
        written = numbers.scientific(x, decimals, numbers.AXIS) if power else numbers.fixed(x, digits, numbers.AXIS)
        assert text == written, repr(x)
    assert {*page.locator(".ms-chosen th ms-unit").all_text_contents()} == {shown(other)}


@pytest.mark.parametrize(("unit", "other"), [("m", "mm"), ("N", "kgf"), ("deg", "rad"), ("MPa", "psi")])
def test_a_value_is_written_as_the_library_writes_it(page, unit: str, other: str) -> None:
    """Numbers, points, fields and small matrices; what is nothing but rounding, and what does not exist, among them."""
    random = np.random.default_rng(37)
    drawn = random.normal(size=(400, 3)) * 10 ** random.uniform(-9, 9, (400, 1)) * parse(unit).factor
    halves = np.array([x for x in HALVES if abs(x) < 1e15]) * parse(other).factor
    whole = np.arange(-3, 4)
    shown_values = [*drawn, *halves, halves[:9], drawn[:4], drawn[:3, :2] * (1 + 1e-17j), whole, 1e9, 3, 2 - 3e-20j]
    shown_values += [np.array([1.0, np.nan, 2e-17, -np.inf]), np.nan, np.array([[1.0, np.inf], [0.0, -2.0]])]
    static(page, "".join(switched.quantity(f"x{n}", unit, value) for n, value in enumerate(shown_values)))
    page.locator("ms-unit").first.click()
    page.get_by_role("menuitemradio", name=shown(other), exact=True).click()
    expect(page.locator(".ms-chosen")).to_have_count(1)
    found = page.evaluate(
        """label => [...document.querySelectorAll("ms-value")].map(value => {
            value.setAttribute("of", "x0");
            value.show();
            return value.querySelector(".ms-chosen").innerHTML.replace(/<ms-unit[^>]*>/, "<ms-unit>");
        })""",
        shown(other),
    )
    wanted = [numbers.value(value, other, switched._SWITCHED) for value in shown_values]
    assert [text.replace("&nbsp;", "\N{NO-BREAK SPACE}") for text in found] == wanted


def test_a_number_beside_another_follows_the_unit_chosen_where_its_quantity_is_shown(page) -> None:
    static(page, f"{switched.quantity('phi', 'deg', np.pi)}<p>least at {switched.beside('phi', 'deg', np.pi / 2)}</p>")
    expect(page.locator("p ms-unit")).to_have_count(0)
    for name, told in (("rad", "least at 1.5708 rad"), ("°", "least at 90°")):
        page.locator("ms-unit:visible").click()
        page.get_by_role("menuitemradio", name=name, exact=True).click()
        expect(page.locator("p")).to_have_text(told, use_inner_text=True)


def test_back_in_its_own_unit_a_table_is_as_it_was(page) -> None:
    column = Column("F", "N", "force", 0, np.array([2.5e3, np.nan]), of="F")
    static(page, values.html(Table("1", "Forces", (column,))))
    before = page.locator("table").inner_html()
    choose(page, page.locator("ms-unit").first, "kN")
    assert page.locator("table:visible td").all_text_contents() == ["2.500", "–"]
    choose(page, page.locator("ms-unit:visible").first, "N")
    expect(page.locator("table")).to_have_count(1)
    assert page.locator("table").inner_html() == before


def test_marks_in_a_table_are_those_of_its_copy_in_other_units(page) -> None:
    """The document's own number is in the unit of its column, and a mark that is gone is gone in the copy as well."""

    def forces(first: float) -> Table:
        S = Column("S", "m", "stroke", 3, np.array([0.1, 0.2]), of="S")
        F = Column("F", "N", "force", 0, np.array([first, 2500.0]), of="F")
        return Table("1", "Forces", (S, F))

    def shown() -> list[tuple[str, str | None, str | None]]:
        drawn(page)
        drawn(page)  # marks are set on the way to a picture
        cells = page.locator("td:visible").all()
        return [(c.text_content(), c.get_attribute("data-own"), c.get_attribute("data-band")) for c in cells]

    document = script.element("ms-own", told={"lines": {}, "checks": {}, "tables": {"1": own._table(forces(1234.0))}})
    bands = {"lines": {}, "checks": {}, "figures": {}, "tables": {"1": [[["± 0.01", ""], ["± 50", ""]]]}}
    static(page, f"{values.html(forces(1500.0))}{document}{script.element('ms-bands', told=bands, made=1)}")
    for name in ("own.js", "bands.js"):
        page.add_script_tag(content=decoded(name))
    first, *_ = before = shown()
    assert first == ("0.100", None, "± 0.01")
    assert before[1:] == [("1500", "1234", "± 50"), ("0.200", None, None), ("2500", None, None)]
    choose(page, page.locator("th ms-unit:visible").nth(1), "kN")
    assert shown() == [first, ("1.500", "1.234", None), ("0.200", None, None), ("2.500", None, None)]
    choose(page, page.locator("th ms-unit:visible").nth(0), "mm")
    choose(page, page.locator("th ms-unit:visible").nth(1), "N")
    assert shown()[:2] == [("100", None, None), before[1]]
    page.evaluate("document.querySelectorAll('ms-own, ms-bands').forEach(each => each.remove())")
    assert shown() == [("100", None, None), ("1500", None, None), ("200", None, None), ("2500", None, None)]


def test_an_axis_of_a_chart_and_what_the_pointer_tells_follow_the_unit(page) -> None:
    """The curves stay: 2500 N is where 2.5 kN is. An axis of several units stays as it is."""
    S = Column("S", "m", "stroke", 3, np.linspace(0.1, 0.5, 5), of="S")
    forces = [
        Column(name, "N", "force", 0, np.linspace(1e3, top, 5), of=name) for name, top in (("F", 4e3), ("G", 3e3))
    ]
    phi = Column("phi", "deg", "angle", 1, np.linspace(0, 40, 5), of="phi")
    figures = [Figure("1", "Forces", S, tuple(forces)), Figure("2", "Mixed", S, (forces[0], phi))]
    static(page, "".join(map(values.html, [Table("1", "Forces", (S, *forces, phi)), *figures])))

    def ticks(figure: int) -> list[tuple[float, float]]:
        """Where each number up the axis stands, and what it says."""
        found = page.locator("ms-figure").nth(figure).locator(".ms-chart:visible > g > text[text-anchor=end]")
        return [(float(text.get_attribute("y")), float(text.text_content().replace("−", "-"))) for text in found.all()]

    def title() -> str:
        return page.locator("ms-figure").first.locator(".ms-chart:visible > g > g > text").text_content()

    curve = page.locator("ms-figure").first.locator(".ms-chart:visible svg path").nth(1)
    own, mixed, path = ticks(0), ticks(1), curve.get_attribute("d")
    assert own[0][1] == 1000 and title().replace("\u200b", "") == "F, G [N]"
    choose(page, page.locator("th ms-unit:visible").nth(1), "kgf")
    slope = (own[-1][1] - own[0][1]) / (own[-1][0] - own[0][0])
    shown = ticks(0)
    assert len(shown) >= 4 and title().endswith("F, G [kgf]")
    for y, number in shown:
        assert number * 9.80665 == pytest.approx(own[0][1] + slope * (y - own[0][0]), abs=abs(slope) * 0.06)
    chart = page.locator("ms-figure").first.locator(".ms-chart:visible")
    told = json.loads(chart.get_attribute("data-values"))
    assert told["units"] == ["m", "kgf", "N"] and told["texts"][1][-1] == "407.9"
    grid = chart.locator("svg path").first.get_attribute("d")
    assert grid.count("H") == len(shown) and grid.count("V") == 5
    assert (curve.get_attribute("d"), ticks(1)) == (path, mixed)
    choose(page, page.locator("th ms-unit:visible").first, "mm")
    across = chart.locator("> g > text[text-anchor=middle]")
    assert across.all_text_contents() == [*map(str, range(100, 501, 50)), "S [mm]"]
    choose(page, page.locator("th ms-unit:visible").nth(1), "N")
    assert ticks(0) == own


def test_a_check_is_shown_in_another_unit_with_the_same_verdict(page) -> None:
    static(page, values.html(check("pressure", 17.5e6, 17.5e6 * (1 - 1e-9), "MPa")))
    assert "17.5 > 17.49999998\u00a0MPa" in page.locator("body").inner_text()
    choose(page, page.locator("ms-unit").first, "kPa")
    assert "17500 > 17499.99998\u00a0kPa" in page.locator("body").inner_text()
    assert page.locator("ms-unit:visible").count() == 1


@pytest.mark.parametrize("width", [1280, 800])
def test_heads_of_a_long_table_stay_in_sight(page, width: int) -> None:
    """Where it is moved under the hand within the page, and where the page alone is."""
    lengths = [Column(f"x{n}", "m", "length", 3, np.linspace(0, 1, 90), of=f"x{n}") for n in range(16)]
    page.set_viewport_size({"width": width, "height": 600})
    static(page, values.html(Table("1", "Lengths", tuple(lengths))))
    last = page.locator("tbody tr:last-child td:first-child").first
    last.scroll_into_view_if_needed()
    assert page.locator("thead th").first.is_visible()
    head, row = page.locator("thead th").first.bounding_box(), last.bounding_box()
    assert 0 <= head["y"] < row["y"] < 600


def test_rows_side_by_side_have_room_whatever_unit_is_chosen(page) -> None:
    """In pascals each number is longer: then fewer parts stand beside one another, and none covers the next."""
    stress = Column("sigma", "MPa", "stress", 2, np.linspace(1e3, 9e3, 40), of="sigma")
    static(page, values.html(Table("1", "Stresses", (stress, stress))))
    page.add_script_tag(content=ROWS)
    ends = """[...document.querySelectorAll("tbody tr")].filter(row => row.offsetWidth).map(
        row => [row.getBoundingClientRect().left, row.offsetWidth])"""

    def parts() -> int:
        drawn(page)  # the room that a part takes is measured on the way to each picture
        places = dict(page.evaluate(ends))
        at = sorted(places)
        assert all(a + places[a] <= b for a, b in pairwise(at)), "parts cover one another"
        return len(places)

    page.set_viewport_size({"width": 420, "height": 900})
    until(page, lambda: parts() == 2, "not side by side")
    choose(page, page.locator("ms-unit").first, "Pa")
    until(page, lambda: parts() == 1, "no room")


def test_a_table_is_copied_as_a_spreadsheet_reads_it(page) -> None:
    """What is seen as a minus is a hyphen there; what stands beside tables is copied as it is."""
    column = Column("F", "N", "force", 0, np.array([-2.5e3, 12.0]), of="F")
    static(page, values.html(Table("1", "Forces", (column,))) + "<p id='text'>−1</p>")
    page.add_script_tag(content=(Path(script.__file__).parent / "page.js").read_text(encoding="utf-8"))
    copied = """of => {
        getSelection().selectAllChildren(document.querySelector(of));
        const clipboardData = new DataTransfer();
        document.dispatchEvent(new ClipboardEvent("copy", {clipboardData}));
        return ["text/plain", "text/html"].map(kind => clipboardData.getData(kind));
    }"""
    assert page.locator("tbody td").all_text_contents() == ["−2500", "12"]
    text, html = page.evaluate(copied, "tbody")
    assert text.split() == ["-2500", "12"] and "<td>-2500</td>" in html
    assert page.evaluate(copied, "#text") == ["", ""]
