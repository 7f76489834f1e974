"""Which recorded quantities get a place of their own, and what they are called."""

from collections.abc import Callable

import numpy as np
import pytest

from mechsheet.recording.graph import Graph, Node
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


@pytest.mark.parametrize(
    "wrap",
    [
        lambda graph, x: graph.node("sin", x),
        lambda graph, x: graph.node("div", graph.constant(3.0), graph.node("add", x, graph.constant(1.0))),
        lambda graph, x: graph.node("where", graph.node("lt", x, graph.constant(2.0)), x, graph.constant(5.0)),
        lambda graph, x: graph.node("atan2", x, graph.node("sqrt", x)),
        lambda graph, x: graph.take(
            graph.join([x, graph.node("neg", x)], graph.constant([1]).value), graph.constant([0]).value
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
    formulas = [cells.formula(node) for node in placed[1:]]
    assert max(map(depth, formulas)) <= 8
    assert len(formulas) < 30


def test_position_of_the_greatest_of_cells_apart_from_each_other() -> None:
    """Columns of a matrix: MATCH takes one range or array, not a list of cells."""
    graph = Graph()
    x = graph.leaf("input", "x", np.arange(6.0).reshape(3, 2))
    node = graph.reduce("argmax", x, 0, False)
    cells = CellFormulas({x: Place("x", "S", 0, 0)})
    assert "MATCH(MAX('S'!$A$2,'S'!$A$4,'S'!$A$6),CHOOSE({1,2,3},'S'!$A$2,'S'!$A$4,'S'!$A$6),0)-1" in cells.formula(
        node, 1
    )


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
