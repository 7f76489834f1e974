"""Units to broken powers, as of a fracture toughness: typed in several ways, printed as one writes them."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
import written_cells
from as_script import as_script
from cells import run

from mechsheet import load
from mechsheet.document.mathml import NUMBER
from mechsheet.html import fields as html_fields
from mechsheet.page import fields as page_fields
from mechsheet.page.values import html
from mechsheet.units import parse, plain, shown, si
from mechsheet.workbook import reading
from mechsheet.worksheet import numbers
from mechsheet.worksheet.inputs import declared
from tests.own_worksheet import written

SHEET = written(
    """
from numpy import pi

from mechsheet import ask, export, inputs, read, typeset
from mechsheet.units import MPa, m
""",
    """
K: float = 50 * MPa * m**0.5  # [MPa*m**0.5] toughness
""",
    """
K_2 = 2 * g.K + 3 * MPa * m ** (1 / 2)  # [MPa*m**(1/2)] toughness
typeset()
""",
    "Crack",
)


@pytest.mark.parametrize("typed", ["MPa*m**0.5", "MPa*m**(1/2)", "MPa·m^(1/2)", "MPa m¹⁄²", "MPa*m**(0.5)"])
def test_ways_to_type_one_are_one(typed: str) -> None:
    assert shown(typed) == "MPa·m¹⁄²" and numbers.in_text(typed) == "MPa·m^(1/2)"
    for printed in (shown(typed), numbers.in_text(typed), plain(typed), si(typed)):
        assert parse(printed).dims == parse("MPa*m**0.5").dims


@pytest.mark.parametrize(
    ("typed", "printed"), [("m**-0.5", "m⁻¹⁄²"), ("N/mm**1.5", "N/mm³⁄²"), ("m**(-2/3)", "m⁻²⁄³"), ("m**+2", "m²")]
)
def test_what_is_printed_can_be_typed(typed: str, printed: str) -> None:
    assert shown(typed) == printed and parse(printed) == parse(typed)


def test_behind_a_number_it_is_raised() -> None:
    assert numbers.behind("MPa*m**0.5", numbers.PLAIN) == " MPa*m**(1/2)"
    assert "<mn>1/2</mn>" in numbers.behind("MPa*m**0.5", NUMBER)
    start = "from mechsheet import typeset\nfrom mechsheet.units import MPa, m\n"
    for constant in ("50 * MPa * m**0.5", "50 * MPa * m ** (1 / 2)"):
        written = html(run(f"{start}K = 2 + {constant}  # [MPa*m**0.5] toughness\nt = typeset()")["t"])
        assert (
            "<mtext>MPa·m</mtext><msup><mrow></mrow><mrow><mn>1/2</mn></mrow></msup>" in written
            and "MPa·m<sup>1/2</sup>" in written
        )


def test_page_terminal_and_workbook_print_it(tmp_path: Path) -> None:
    path = tmp_path / "crack.py"
    path.write_text(SHEET, encoding="utf-8")
    g: Any = load(path).inputs()
    assert "MPa·m¹⁄²" in html_fields.fields(g) and "MPa·m¹⁄²" in page_fields.fields(g).text
    assert html_fields.told(g)["fields"][0]["unit"] == "MPa·m^(1/2)"
    assert as_script(path, "--want=K_2").stdout == "K_2 = 103 MPa·m^(1/2), toughness\n"
    assert as_script(path, f"--out={tmp_path}").returncode == 0
    assert ("", "MPa·m¹⁄²") in written_cells.read(tmp_path / "crack.xlsx")["Inputs"].values()
    assert reading.inputs(tmp_path / "crack.xlsx", declared(type(g))) == {"K": 50}
