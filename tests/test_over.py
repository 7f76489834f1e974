"""Of a field of many numbers a line says the least and the greatest, and where along which quantity they are."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from own_worksheet import own

from mechsheet.document.markup import HTML, where
from mechsheet.worksheet import numbers
from mechsheet.worksheet.over import over


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
        "y = np.outer(x, x)",
        "y = x[:15] * 1",
    ],
    ids=[
        "a number",
        "not computed from it",
        "level",
        "level but for rounding",
        "points",
        "two axes",
        "of another length",
    ],
)
def test_what_has_no_place_says_none(line: str, tmp_path: Path) -> None:
    assert shown(run(tmp_path, f"{line}  # [-] line"), "y") == ""


def test_a_few_numbers_stand_in_full_and_say_no_place(tmp_path: Path) -> None:
    assert shown(run(tmp_path, "y = x**2  # [-] line", n=10), "y") == ""


def test_of_several_quantities_it_is_the_one_beside_which_the_name_is_tabulated(tmp_path: Path) -> None:
    lines = 'v = x * 3  # [-] other\ny = v**2  # [-] line\ntable_2 = table("2", "Other", v, y)'
    assert shown(run(tmp_path, lines), "y") == "least at v = 0.3, greatest at v = 6"


def test_of_a_field_with_gaps_the_places_are_where_numbers_are(tmp_path: Path) -> None:
    lines = "y = np.where(x < 1, np.nan, x)  # [-] line"
    assert shown(run(tmp_path, lines), "y") == "least at x = 1.05, greatest at x = 2"


def test_roundings_beside_large_numbers_are_about_nothing() -> None:
    assert numbers.value([-1.5e-10, 20694.0, 83904.0], "N", HTML) == "≈ 0, 20694, 83904 N"
    assert numbers.value(np.array([0.0, 1e-9]), "m", HTML).startswith("0, 1"), "small, but large beside the others"
    assert numbers.value(np.linspace(0, 1e5, 20) - 1e-11, "N", HTML) == "≈ 0 … 100000 N"
    assert numbers.value(np.exp(1j * np.linspace(0, np.pi / 2, 20)), "m", HTML) == "(≈ 0 … 1, 0 … 1) m"
