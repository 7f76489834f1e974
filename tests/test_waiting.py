"""A served page names what a section waits for: marimo shows nothing of the cells below one that was stopped."""

import ast

import pytest

from mechsheet.page.notebook import Cell
from mechsheet.page.waiting import own_texts, waiting
from mechsheet.worksheet import source

TEXTS = (
    'mo.md("""\n    # Press\n\n    ## 1 Crank\n    """)',
    "O = 1\nP = O",
    'mo.md(r"""\n    ## 2 Forces\n\n    ### 2.1 Rod\n    """)',
    "R = P",
    'mo.md("## Remarks")',
    "Q = 5",
    'mo.md("## 3 Table")',
    "table(R)",
)


def names(text: str, kind: type[ast.expr_context]) -> frozenset[str]:
    return frozenset(n.id for n in ast.walk(ast.parse(text)) if isinstance(n, ast.Name) and isinstance(n.ctx, kind))


@pytest.mark.parametrize(
    ("stopped", "told"),
    [
        (
            "1",
            {"21-rod": "waits for section 1", "3-table": "waits for section 1"},
        ),  # through R, defined by a third cell
        ("3", {"3-table": "waits for section 2.1"}),  # the innermost of two headings of one text
        ("7", {}),
        ("", {}),
    ],
)
def test_a_section_says_what_it_waits_for(stopped: str, told: dict[str, str]) -> None:
    file = source.of_texts(tuple((text, "press.py") for text in TEXTS))
    run = [  # a served page has no cells of texts, and no order
        Cell(str(n), text, "press.py", names(text, ast.Store), names(text, ast.Load), None, None, busy=False)
        for n, text in reversed(list(enumerate(TEXTS)))
        if "mo.md" not in text
    ]
    assert waiting(file, run, stopped) == told


def test_texts_that_need_no_number_stay_where_a_cell_waits() -> None:
    cell = """
mo.stop(R > 9, mo.md("Only then."))
"The load."
R = P  # [N] load
typeset(mo.md("It is"), mo.md(f"{R} N"), "**known**")
"Shown by no typeset."
mo.md("Its end.")
"""
    assert own_texts(ast.parse(cell).body) == ["The load.", "It is", "**known**", "Its end."]
    assert own_texts(ast.parse("class Own:\n    'Inputs.'\n'What the cell does.'\nR = 1").body) == []
