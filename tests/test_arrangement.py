"""Which recorded quantities get a place of their own, and what they are called."""

import re
from collections.abc import Callable
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from openpyxl import load_workbook
from own_worksheet import own

from mechsheet.quantities.graph import Graph
from mechsheet.quantities.node import Node
from mechsheet.quantities.operations import Moved
from mechsheet.run import report
from mechsheet.workbook.arrangement import needing_place
from mechsheet.workbook.cell_formula import CellFormulas
from mechsheet.workbook.place import Place, called


def depth(formula: str) -> int:
    """Parentheses inside each other."""
    deepest = inside = 0
    for letter in formula:
        inside += (letter == "(") - (letter == ")")
        deepest = max(deepest, inside)
    return deepest


PICKED = Moved(np.take, ([1],))


@pytest.mark.parametrize(
    "wrap",
    [
        lambda graph, x: graph.node("sin", x),
        lambda graph, x: graph.node("div", graph.constant(3.0), graph.node("add", x, graph.constant(1.0))),
        lambda graph, x: graph.node("where", graph.node("lt", x, graph.constant(2.0)), x, graph.constant(5.0)),
        lambda graph, x: graph.node("atan2", x, graph.node("sqrt", x)),
        lambda graph, x: graph.take(
            graph.join([x, graph.node("neg", x)], graph.constant([1]).value, PICKED), graph.constant([0]).value
        ),
    ],
)
def test_deep_formulas_are_split_into_steps(wrap: Callable[[Graph, Node], Node]) -> None:
    """Whatever is nested thirty times, no cell has more than eight parentheses inside each other, and none is lost."""
    graph = Graph()
    x = root = graph.leaf("input", "x", 0.5)
    for _ in range(30):
        root = wrap(graph, root)
    placed = [x, *needing_place([root], {root}, {})]
    cells = CellFormulas({node: Place(f"v{n}", "S", n, 1) for n, node in enumerate(placed)})
    formulas = [cells.formulas(node)[0] for node in placed[1:]]
    assert max(map(depth, formulas)) <= 8
    assert len(formulas) < 30


def test_columns_behind_the_tables_go_over_several_sheets(tmp_path: Path) -> None:
    """The list of a section's lines says on which one; formulas find them there."""
    lines = [f"y{n}_ = {f'y{n - 1}_' if n else 'x'} + g.a * cos(x)  # [-] line {n}" for n in range(70)]
    sheet = own(tmp_path, "\n".join(lines) + '\ntable_2 = table("2", "last", y69_)')
    names = sheet.run(sheet.results, {"g": sheet.inputs()})
    book = load_workbook(BytesIO(report.workbook("", {**names, "__file__": sheet.path}, {})))
    first, second = (ws for ws in book.worksheets if re.match("[^R].* fields", ws.title))
    (listing,) = (ws for ws in book.worksheets if re.match("[^R].* lines", ws.title))
    told = {row[0].value: row[1].value for row in listing.iter_rows(min_row=3)}
    for ws in (first, second):
        assert all(told[cell.value] == f"column {cell.column_letter} of {ws.title}" for cell in ws[3])
    assert len(first[3]) == 64 and first.max_row == second.max_row == 4 + len(names["x"])


def test_position_of_the_greatest_of_cells_apart_from_each_other() -> None:
    """Columns of a matrix: MATCH takes one range or array, not a list of cells."""
    graph = Graph()
    x = graph.leaf("input", "x", np.arange(6.0).reshape(3, 2))
    node = graph.reduce("argmax", x, 0, False)
    cells = CellFormulas({x: Place("x", "S", 0, 0)})
    assert "MATCH(MAX(x,'S'!$A3,'S'!$A5),CHOOSE({1,2,3},x,'S'!$A3,'S'!$A5),0)-1" in cells.formulas(node)[0]


def column(graph: Graph, node: Node, *placed: Node) -> set[str]:
    """Formulas of a column, those that are the same seen from their cells once."""
    cells = CellFormulas({source: Place(f"v_{n}", "Fields", 4, n) for n, source in enumerate(placed)}, 4)
    return {seen_from(formula, row) for row, formula in enumerate(cells.formulas(node), 5)}


def seen_from(formula: str, row: int) -> str:
    """A formula with its relative rows counted from that of its cell."""
    return re.sub(r"(?<=[A-Z])\d+", lambda found: f"[{int(found[0]) - row}]", formula)


ELEMENTS: dict[str, Any] = {
    "slice": np.arange(2, 14),
    "every third": np.arange(1, 24, 3),
    "turned round": np.arange(24)[::-1],
    "last axis": np.arange(24).reshape(2, 3, 4)[:, 1:, 1],
    "transposed": np.arange(24).reshape(2, 3, 4).transpose(2, 0, 1),
    "repeated": np.repeat(np.arange(4), 3),
    "tiled": np.tile(np.arange(4), 3),
    "rows of a table": np.broadcast_to(np.arange(6).reshape(2, 1, 3), (2, 4, 3)).reshape(-1),
}


@pytest.mark.parametrize("index", ELEMENTS.values(), ids=ELEMENTS)
def test_elements_of_a_column_have_one_formula(index: Any) -> None:
    graph = Graph()
    x = graph.leaf("input", "x", np.arange(24.0))
    assert len(column(graph, graph.node("sin", graph.take(x, np.ascontiguousarray(index))), x)) == 1


def test_quantities_of_other_axes_have_one_formula() -> None:
    """Load cases on one axis and elements on another, a sum over one of them, and so far."""
    graph = Graph()
    case, element = (graph.leaf("input", name, np.arange(1.0, 1.0 + np.prod(s)).reshape(s)) for name, s in SHAPES)
    both = graph.node("add", graph.node("mul", case, element), case)
    assert both.shape == (3, 2, 4)
    assert len(column(graph, both, case, element)) == 1
    for axis in range(3):
        assert len(column(graph, graph.reduce("sum", both, axis, False), both)) == 1
    assert len(column(graph, graph.scan("sum", element, 1), element)) == 1


SHAPES = (("case", (3, 2, 1)), ("element", (1, 4)))


def test_numbers_that_differ_from_row_to_row_stand_in_a_column() -> None:
    graph = Graph()
    x, signs = graph.leaf("input", "x", np.arange(4.0)), graph.constant(np.array([1, -1, -1, 1]))
    node = graph.node("mul", x, signs)
    assert signs in needing_place([node], {node}, {})
    assert len(column(graph, node, x, signs)) == 1


def test_elements_of_several_quantities_have_a_formula_for_each() -> None:
    graph = Graph()
    x, y = (graph.leaf("input", name, np.arange(6.0).reshape(2, 3)) for name in "xy")
    beside = Moved(np.stack, (), (("axis", 1),))
    node = graph.join([x, y], beside([np.arange(6).reshape(2, 3), np.arange(6, 12).reshape(2, 3)]), beside)
    assert len(column(graph, node, x, y)) == 2
    assert node in needing_place([graph.node("sin", node)], set(), {})


def test_checks_are_called_by_whole_words_of_them() -> None:
    names = {
        "equilibrium of forces, bodies 2..7": "equilibrium_of_forces_bodies_2_7",
        "velocity equations are the slopes of the found angles": "velocity_equations_are_the_slopes",
        "Euler's formula": "Eulers_formula",
        "20 % of G": "check_20_of_G",
        "шаг": "check",
        "x" * 60: "x" * 40,
    }
    assert {text: called(text) for text in names} == names
