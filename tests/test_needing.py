"""Before a line goes, the page says what needs it, whatever lies between: else one sees it only afterwards."""

from collections.abc import Iterable
from pathlib import Path

import pytest

from mechsheet import __main__ as launcher
from mechsheet.page.needing import needing

LEVER = (Path(launcher.__file__).parent / "run" / "new_worksheet.txt").read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("gone", "places"),
    [
        (["M_n"], "section 2.2, 3 and table 2"),
        (["g.M_max"], "section 2.1, 3 and figure 1"),  # the figure through phi_found and phi_max
        (["figure_1"], "section 3"),
        (["g.F"], "section 2, 2.1, 2.2, 3, table 1, table 2 and figure 1"),  # through the function M too
        (["M_max", "angle"], ""),  # M_max is no name of a formula but of an input
    ],
)
def test_what_needs_a_name_is_named_in_the_order_of_the_document(gone: Iterable[str], places: str) -> None:
    assert needing(LEVER, gone) == places


def test_what_a_cell_needs_of_itself_goes_with_it() -> None:
    assert needing(LEVER, ["M", "M_S", "phi"], whole=True) == "section 2.1, 3, table 1 and figure 1"
    assert needing(LEVER, ["table_1", "table_2", "figure_1"], whole=True) == ""


def test_a_functions_own_argument_is_no_name_of_the_worksheet() -> None:
    cell = "@app.cell\ndef one():\n    def f(phi):\n        return phi\n    return (f,)\n"
    assert needing(cell, ["phi"]) == ""


def test_of_many_sections_the_first_are_named() -> None:
    cells = "".join(f'@app.cell\ndef c{n}():\n    mo.md("# {n} A")\n    b{n} = a\n' for n in range(9))
    assert needing(cells.replace('"# ', '"## '), ["a"]) == "section 0, 1, 2, 3, 4 and 4 more"
