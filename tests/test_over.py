"""Of a field of many numbers a line says the least and the greatest, and where along which quantity they are."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from own_worksheet import own

from mechsheet.document.markup import HTML, named, where
from mechsheet.html import javascript
from mechsheet.worksheet import numbers
from mechsheet.worksheet.over import over
from mechsheet.worksheet.results import quantities

if TYPE_CHECKING:
    from playwright.sync_api import Page


def run(tmp_path: Path, lines: str, n: int = 21) -> dict[str, Any]:
    sheet = own(tmp_path, lines)
    return {**sheet.run(sheet.results, {"g": sheet.inputs(n=n, F=1.0)}), "__file__": sheet.path}


def shown(names: dict[str, Any], name: str) -> str:
    text = where(names[name], over(name, names))
    return text.replace("<i>", "").replace("</i>", "").removeprefix(' <span class="ms-where">').removesuffix("</span>")


def test_a_field_says_where_it_is_least_and_greatest(tmp_path: Path) -> None:
    names = run(tmp_path, "y = (x - 1.05) ** 2  # [-] not monotonic\nz = 2 * y  # [-] through another line")
    assert shown(names, "y") == "least at x = 1.05, greatest at x = 0.1"
    assert shown(names, "z") == shown(names, "y")


@pytest.mark.parametrize(
    "line",
    [
        "y = 3 * g.F",
        "y = linspace(0, 1, 21)",
        "y = 0 * x",
        "y = 1 + x * 1e-16",
        "y = x + 1j",
        "y = x[:15] * 1",
    ],
    ids=[
        "a number",
        "not computed from it",
        "level",
        "level but for rounding",
        "points",
        "of another length",
    ],
)
def test_what_has_no_place_says_none(line: str, tmp_path: Path) -> None:
    assert shown(run(tmp_path, f"{line}  # [-] line"), "y") == ""


MOVED = [
    "y = np.sort(v)",
    "y = np.array(sorted(v, reverse=True))",
    "y = v[::-1]",
    "y = v[np.argsort(v)]",
    "order = np.argsort(v)\ny = v[order]",
    "y = np.flip(v) * 2",
    "y = np.roll(v, 5)",
    "y = np.concatenate([v[5:], v[:5]])",
    "y = np.append(v[5:], v[:5])",
    "y = np.r_[v[5:], v[:5]]",
    "y = np.unique(v)",
    "y = linspace(v.min(), v.max(), 21)",
    "y = v * 1  # [-] line\ny.sort()",
    "y = 2 * v\nw = np.sort(y)\ny = w + 1",
    "y = np.array([v[20 - i] for i in range(21)])",
    "y = np.array([v[-i] for i in range(21)])",
    "def turned(field):\n    return field[::-1]\ny = turned(v)",
    "def turned():\n    return np.sort(v)\ny = 2 * turned()",
    "w = np.sort(v)\nz = 2 * w\ny = z**2",
]
STAYS = [
    "y = np.cumsum(v)",
    "y = np.maximum.accumulate(v)",
    "y = np.gradient(v, x)",
    "w = np.sort(v)\nm = w[3]\ny = v - m",
    "y = np.array([v[i] * 2 for i in range(21)])",
]


@pytest.mark.parametrize("line", MOVED)
def test_elements_that_are_put_elsewhere_have_no_place(line: str, tmp_path: Path) -> None:
    """As many numbers do not make the axis that of another field."""
    names = run(
        tmp_path, f'v = (x - 1.05) ** 2 + x / 9  # [-] not in order\n{line}  # [-] line\ntable_2 = table("2", "", x, y)'
    )
    assert np.size(names["y"]) == 21 and shown(names, "y") == "" and "least at x" in shown(names, "v")


@pytest.mark.parametrize("line", STAYS)
def test_elements_that_stay_have_their_places(line: str, tmp_path: Path) -> None:
    names = run(tmp_path, f"v = (x - 1.05) ** 2 + x / 9  # [-] not in order\n{line}  # [-] line")
    assert "least at x" in shown(names, "y")


def test_a_few_numbers_stand_in_full_and_say_no_place(tmp_path: Path) -> None:
    assert shown(run(tmp_path, "y = x**2  # [-] line", n=10), "y") == ""


def test_of_several_quantities_it_is_the_one_beside_which_the_name_is_tabulated(tmp_path: Path) -> None:
    lines = 'v = x * 3  # [-] other\ny = v**2  # [-] line\ntable_2 = table("2", "Other", v, y)'
    assert shown(run(tmp_path, lines), "y") == "least at v = 0.3, greatest at v = 6"


def test_of_a_field_with_gaps_the_places_are_where_numbers_are(tmp_path: Path) -> None:
    lines = "y = np.where(x < 1, np.nan, x)  # [-] line"
    assert shown(run(tmp_path, lines), "y") == "least at x = 1.05, greatest at x = 2"


def test_of_ends_that_differ_by_roundings_alone_it_is_the_first(tmp_path: Path) -> None:
    """Else another processor, or the page in one file, names another turn of the same crank."""
    lines = "t = np.round(x * 10)  # [-] steps\ny = (t % 4) * (1 + 1e-13 * t)  # [-] least and greatest several times"
    names = run(tmp_path, f"{lines}\nw = np.where(x > 1, np.inf, y)  # [-] infinite")
    first, greatest = (names["x"][names["t"] % 4 == rest][0] for rest in (0, 3))
    assert shown(names, "y") == f"least at x = {first:.5g}, greatest at x = {greatest:.5g}"
    assert shown(names, "w") == f"least at x = {first:.5g}, greatest at x = {names['x'][names['x'] > 1][0]:.5g}"


def test_roundings_beside_large_numbers_are_about_nothing() -> None:
    assert numbers.value([-1.5e-10, 20694.0, 83904.0], "N", HTML) == "≈ 0, 20694, 83904 N"
    assert numbers.value(np.array([0.0, 1e-9]), "m", HTML).startswith("0, 1"), "small, but large beside the others"
    assert numbers.value(np.linspace(0, 1e5, 20) - 1e-11, "N", HTML) == "≈ 0 … 100000 N"
    assert numbers.value(np.exp(1j * np.linspace(0, np.pi / 2, 20)), "m", HTML) == "(≈ 0 … 1, 0 … 1) m"


AXES = """case = np.arange(1, 4)[:, None]  # [-] load case
P = (case - 2.2) ** 2 * np.sin(x)  # [-] over both
Q = 3 * P  # [-] tabulated beside them
table_2 = table("2", "Cases", case, x, Q)"""


@pytest.mark.parametrize(
    ("line", "expected"),
    [
        ("y = Q * 1", "least at case = 2, x = 0.1, greatest at case = 1, x = 1.525"),
        ("y = np.outer(x[:15], x**2)", "least at x = 0.1, element 1 of 15, greatest at x = 2, element 15 of 15"),
        ("y = np.arange(30).reshape(5, 6)", "least at element (1, 1) of (5, 6), greatest at element (5, 6) of (5, 6)"),
        (
            "y = np.arange(63.0).reshape(3, 21)",
            "least at element (1, 1) of (3, 21), greatest at element (3, 21) of (3, 21)",
        ),
        ("y = np.arange(12).reshape(3, 4)", ""),
    ],
    ids=["both known", "one known", "none known", "none that it has to do with", "in full, in rows"],
)
def test_of_a_field_over_several_axes_the_place_is_told_along_each(line: str, expected: str, tmp_path: Path) -> None:
    assert shown(run(tmp_path, f"{AXES}\n{line}  # [-] line"), "y") == expected


def test_rows_are_named_by_what_counts_them_if_only_one_does(tmp_path: Path) -> None:
    lines = """M = np.array([0.6, 0.1, 0.3])[:, None]  # [-] moments
case = np.arange(1, 4)[:, None]  # [-] load case
load = np.arange(2, 5)[:, None]  # [-] other
P = M * x  # [-] force
Q = M * x * 2  # [-] force
R = M * x * 3  # [-] what nothing is computed from
P_2 = 2 * P  # [-] tabulated once
Q_2 = 2 * Q  # [-] tabulated twice
table_2 = table("2", "Cases", case, x, P_2, Q_2)
table_3 = table("3", "Others", load, x, Q_2)"""
    names = run(tmp_path, lines)
    assert shown(names, "P") == "least at case = 2, x = 0.1, greatest at case = 1, x = 2"
    assert (
        shown(names, "Q") == shown(names, "R") == "least at x = 0.1, element 2 of 3, greatest at x = 2, element 1 of 3"
    )


def test_the_terminal_tells_the_places(tmp_path: Path) -> None:
    names = run(tmp_path, AXES)
    (told,) = quantities("Q", names)
    assert str(told).endswith(", least at case = 2, x = 0.1, greatest at case = 1, x = 1.525, tabulated beside them")
    (told,) = quantities("case", names)
    assert "least" not in str(told), "a few numbers"


def test_a_page_in_one_file_tells_the_same_places(blank: Page, tmp_path: Path) -> None:
    lines = "y = np.outer(x[:15], x**2)  # [-] one known\nz = 2 * P[:, :1] * np.ones(7)  # [-] one axis lost"
    ties = "w = np.round(x * 10) % 4 * (1 + 1e-13 * x)  # [-] least and greatest several times"
    names = run(tmp_path, f"{AXES}\n{lines}\n{ties}")
    for name in ("P", "y", "z", "w"):
        field, known = names[name], over(name, names)
        assert known is not None
        specs = [axis and {"key": axis.line.name, "named": named(axis.line.name)} for axis in known.axes]
        told = blank.evaluate(
            f"""([field, shape, over, values]) => {{{javascript.runtime("format.js")}
            return whereText([Object.assign(field, {{shape}})], over, values)}}""",
            [
                field.ravel().tolist(),
                field.shape,
                [spec and {**spec, "factor": 1, "behind": ""} for spec in specs],
                {axis.line.name: axis.values.tolist() for axis in known.axes if axis},
            ],
        )
        assert told == where(field, known) != ""
