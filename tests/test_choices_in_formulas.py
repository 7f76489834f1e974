"""Choices, solve blocks and elements that a condition picks are formulas, and no code: by symbols and with numbers."""

import pytest
from cells import run
from in_tex import tex, typeset

from mechsheet.document.expression import equation, reads, substituted
from mechsheet.document.formula import Measure
from mechsheet.document.markup import named

SET_UP = "import numpy as np\nfrom mechsheet import find, minerr, typeset\nk = 2.0  # [-] factor\n"
WRITTEN = {
    "find(lambda a: a**2, 0, 20, equals=k).value * 2": r"\mathrm{Find}\left(a,\ a^{2} = k\right) \cdot 2",
    "find(f, 0, 20).value": r"\mathrm{Find}(f = 0)",
    "sizes[sizes >= k][0]": r"{(\mathrm{sizes}_{\mathrm{sizes} \ge k})}_{0}",
    "sizes[i][0]": r"{\mathrm{sizes}_{i}}_{,0}",
    '{"low": 1.0, "high": k}[mode]': (
        r"\begin{cases} 1 & \text{if }\mathrm{mode} = \text{low} \\ k & \text{otherwise} \end{cases}"
    ),
    "{1: 1.0, 2: k, 3: 3.0}[n]": (
        r"\begin{cases} 1 & \text{if }n = 1 \\ k & \text{if }n = 2 \\ 3 & \text{otherwise} \end{cases}"
    ),
    '{"low": 1.0, "high": k}["high"]': "k",
}


@pytest.mark.parametrize("source", WRITTEN)
def test_expressions_are_written_as_formulas(source: str) -> None:
    assert typeset(source) == WRITTEN[source]


@pytest.mark.parametrize(
    ("block", "line", "written"),
    [
        ("b_w = find(lambda beta: beta**2, 0, 9, equals=k)", "y = b_w.value", r"y = \mathrm{Find}(\beta)"),
        ("b = find(f, 0, 9, equals=k)", "y = 2 * b.value", r"y = 2\,\mathrm{Find}(b)"),
        ("b_found = find(lambda u: u**2, 0, 9, equals=k)", "y = b_found.value", r"y = \mathrm{Find}(b)"),
        (
            "p = find(lambda u, v: (u + v, u - v), equals=(k, 1.0), u=1.0, v=1.0, unit=('-', '-'))",
            "y = p.value.v",
            r"y = \mathrm{Find}(v)",
        ),
        (
            "p = minerr(lambda u, v: (u + v, u - v, u), equals=(k, 1, 1), u=1, v=1, unit=('-', '-', '-'))",
            "y = p.value.u",
            r"y = \mathrm{Minerr}(u)",
        ),
    ],
)
def test_a_solve_block_of_any_name_is_shown_by_its_unknown(block: str, line: str, written: str) -> None:
    names = run(f"{SET_UP}def f(b):\n    return b**2\n{block}\n{line}  # [-] found\nt = typeset()")
    (row,) = (row for row in names["t"].rows if getattr(row, "unit", None) and row.name == "y")
    assert tex(equation(row)) == written


def test_a_condition_of_all_elements_has_no_number_of_one() -> None:
    names = run(
        SET_UP + "sizes = np.array([1.0, 2.5, 4.0])  # [-] sizes\ny = sizes[sizes >= k][0]  # [-] next\nt = typeset()"
    )
    row = names["t"].rows[-1]
    assert {*reads(row)} == {"sizes", "k"}
    node = substituted(row, {"sizes": Measure(1.0, "-"), "k": Measure(2.0, "-")})
    assert node is not None and r"\mathrm{sizes} \ge 2" in tex(node)


def test_a_column_of_a_table_of_inputs_is_headed_by_its_symbol() -> None:
    names = run(
        "from mechsheet import inputs, table\n@inputs\nclass Part:\n    m: float  # [kg] mass\n\n"
        "@inputs\nclass Given:\n    parts: list[Part] = [Part(2.0), Part(3.0)]  # parts\n\ng = Given()\n"
        't = table("1", "Parts", g.parts.m)'
    )
    (column,) = names["t"].columns
    assert (column.symbol, named(column.name)) == ("m_parts", "<i>m</i><sub>parts</sub>")
