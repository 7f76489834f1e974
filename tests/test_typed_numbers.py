"""Numbers as they were typed: a standard module of 1.25 mm is not shown as 1.2, nor 9.80665 as 9.8066."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from cells import run

from mechsheet import html
from mechsheet.page.values import html as shown
from mechsheet.worksheet import numbers

if TYPE_CHECKING:
    from playwright.sync_api import Page

CELL = """
import numpy as np
from mechsheet import inputs, table, typeset
from mechsheet.units import N, kN, mm, ms, MPa

@inputs
class Given:
    modules: list[float] = [1 * mm, 1.25 * mm, 1.5 * mm]  # [mm] modules
    F: float = 2.5  # [N] force
    L: float = 123.456789 * mm  # [mm] length

g = Given()
m = np.array([1, 1.25, 2.125]) * mm  # [mm] modules
d = 17 * m  # [mm] diameters
t = np.arange(3) * 20e-3  # [ms] time
E = np.array([210e9, 70.5e9])  # [GPa] modulus
wires = np.array([3.15, 6.3, 0.25]) * 1e-3  # [mm] wires
force = wires * 1e3  # [N] force
third = np.array([1 / 3, 1.25]) * mm  # [mm] computed
far = np.array([1.23456, 1.5]) * mm  # [mm] too fine
k = np.array([1, 2])  # [-] number
"""


@pytest.fixture(scope="module")
def names() -> dict[str, Any]:
    return run(CELL)


@pytest.mark.parametrize(
    ("columns", "texts"),
    [
        ("m", ["1.000", "1.250", "2.125"]),
        ("g.modules", ["1.00", "1.25", "1.50"]),
        ("k, g.F", ["2.5", "2.5"]),
        ("d", ["17.000", "21.250", "36.125"]),
        ("wires", ["3.15", "6.30", "0.25"]),  # with one decimal the last of them was 0.2, and its force 0
        ("force", ["3.15", "6.30", "0.25"]),
        ("g.L", ["123.5"]),
        ("t", ["0.0", "20.0", "40.0"]),
        ("E", ["210.00", "70.50"]),
        ("third", ["0.3", "1.2"]),
        ("far", ["1.2", "1.5"]),
        ("k", ["1", "2"]),
    ],
)
def test_a_column_shows_in_full_what_has_few_decimals(columns: str, texts: list[str], names: dict[str, Any]) -> None:
    found = run(f'shown = table("1", "T", {columns})', dict(names))["shown"].columns[-1]
    assert found.texts() == texts
    given = run(f'shown = table("1", "T", {columns}, decimals=1)', dict(names))["shown"].columns[-1]
    assert given.decimals == (0 if columns == "k" else 1), "those that are asked for hold"


@pytest.mark.parametrize(
    ("x", "text"),
    [
        (9.80665, "9.80665"), (1035.25, "1035.25"), (0.640625, "0.640625"), (-20.1253, "−20.1253"), (8.125, "8.125"),
        (9.806652, "9.8067"), (1035.253, "1035.3"), (1 / 3, "0.33333"), (2 / 3, "0.66667"), (1.23456e-7, "1.23456e−07"),
        (1.234567e7, "1.2346e+07"), (129613.7, "129614"), (0.1 + 0.2, "0.3"),
    ],
)  # fmt: skip
def test_a_line_shows_six_digits_of_what_has_no_more(x: float, text: str) -> None:
    assert numbers.usual(x, numbers.AXIS) == text


def test_a_constant_is_shown_as_it_is_typed() -> None:
    cell = "from mechsheet import typeset\ng_n = 9.80665  # [m/s**2] gravity\nt = typeset()\n"
    assert ">9.80665\xa0<" in shown(run(cell)["t"])


def test_the_page_in_one_file_shows_the_same(blank: Page) -> None:
    blank.add_script_tag(path=f"{html.__path__[0]}/format.js")
    some = [9.80665, 1035.25, -20.1253, 9.806652, 1 / 3, 1.23456e-7, 8.125, 129613.7, 0.0, 0.1 + 0.2, 123456.5]
    of_page = blank.evaluate(
        "all => all.map(x => usual(x, {minus: '−', none: '–', power: (x, p) => `${x}|${p}`}))", some
    )
    assert of_page == [numbers.usual(x, numbers.AXIS._replace(power="{}|{}")) for x in some]
    columns = [[1.0, 1.25], [1.0, 4 / 3], [2.5], [1.23456], [21.125, float("nan")], [1e9 + 0.5], [-0.0625]]
    told = [[[None if x != x else x for x in column], d] for column in columns for d in (0, 1, 3)]
    of_page = blank.evaluate("all => all.map(([xs, d]) => enough(xs.map(x => x ?? NaN), d))", told)
    assert of_page == [numbers.enough(np.array(column), d) for column in columns for d in (0, 1, 3)]
