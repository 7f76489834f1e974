"""Texts with recorded numbers in them: what a page writes again, and what Python has looked at."""

from __future__ import annotations

from collections.abc import Iterator
from html import escape, unescape
from typing import Any

import pytest

import mechsheet.recording.record  # noqa: F401  # knows what numpy does with quantities
from mechsheet.html import markdown, wording
from mechsheet.quantities.graph import Graph, current
from mechsheet.quantities.quantity import Quantity
from mechsheet.quantities.sketch import Sketch
from mechsheet.quantities.written import Number, Written, joined, text
from mechsheet.recording.choices import choice
from mechsheet.worksheet.drawing import Drawing


@pytest.fixture
def graph() -> Iterator[Graph]:
    graph = Graph(1, True)
    token = current.set(graph)
    yield graph
    current.reset(token)


def quantity(graph: Graph, name: str, value: float) -> Any:
    return Quantity(graph, graph.leaf("input", name, value))


def test_a_number_in_a_text_is_no_guard_until_the_text_is_looked_at(graph: Graph) -> None:
    x = quantity(graph, "x", -0.25)
    told = text("x = ", (x, ".3g"), " m").replace("-", "−").strip()
    assert isinstance(told, Written) and told.now == "x = −0.25 m" and not graph.looked
    assert told + "!" == "x = −0.25 m!" and graph.looked


def test_a_text_of_plain_numbers_or_another_format_is_one_of_python(graph: Graph) -> None:
    x = quantity(graph, "x", 2.5)
    assert text("a", (2.5, ".1f")) == "a2.5" and not graph.looked
    assert text((x, ">8.2f")) == f"{2.5:>8.2f}" and graph.looked


def test_a_format_without_digits_has_six_and_a_part_is_in_per_cent(graph: Graph) -> None:
    x = quantity(graph, "x", 0.123456789)
    for spec, followed in (("g", ".6g"), ("e", ".6e"), ("f", ".6f"), ("%", ".6f"), (".1%", ".1f")):
        told = text("a ", (x, spec), "!")
        assert told.now == f"a {x.value.item():{spec}}!" and not graph.looked
        assert told.parts[1].spec == followed


def test_texts_that_are_joined_are_looked_at_by_nobody(graph: Graph) -> None:
    x = quantity(graph, "x", 2.5)
    told = joined(", ", [text((x, ".1f")), "b", text((2 * x, ""))])
    assert told.now == "2.5, b, 5.0" and not graph.looked
    assert joined("-", (c for c in "ab")) == "a-b"


def test_one_of_two_texts_is_chosen_by_a_number(graph: Graph) -> None:
    x = quantity(graph, "x", 2.0)
    holds = Quantity(graph, graph.fold("gt", x.re, graph.constant(1.0)))
    told = choice(holds, lambda: text("long, ", (x, ".1f")), lambda: "short")
    assert told.now == "long, 2.0" and not graph.looked
    assert wording.written(told, str)[0]["else"] == ["short"]


def test_the_first_word_of_a_name_is_a_symbol_or_a_number(graph: Graph) -> None:
    x = quantity(graph, "x", 3.0)
    assert text((x, ".4g"), " N").head() == (Number(x, ".4g"), Written((" N",)))
    assert text("P34 of ", (x, ".4g")).head() == ("P34", Written((" of ", Number(x, ".4g"))))
    assert text("P", (x, ".4g")).head() is None


def test_a_number_that_is_none_of_its_own_in_a_formula_is_not_followed(graph: Graph) -> None:
    told = text("the **arm** $a = ", (quantity(graph, "x", 3.0), ".4g"), "$")
    assert wording.pieces(told, lambda shown: shown.replace("$", "<math>", 1).replace("$", "</math>"), str) == []


@pytest.mark.parametrize("other", ["on\n\nthe next line", "20&deg;", "a *long* one", "$x$"])
def test_markup_of_a_text_that_stands_for_another_one_is_followed_whole(graph: Graph, other: str) -> None:
    """Of one of two texts as the page has each; of a sign in a number it is not."""
    x = quantity(graph, "x", 3.0)
    holds = Quantity(graph, graph.fold("gt", x.re, graph.constant(1.0)))
    told = text((x, ".1f")).replace(".", other)
    assert wording.pieces(Written((*told.parts, " end")), markdown.html, str) == []
    (made,) = wording.pieces(
        Written((*choice(holds, lambda: text(other, (x, "")), lambda: "short").parts, " end")), markdown.html, str
    )
    whole = ["".join(part if isinstance(part, str) else "3.0" for part in way) for way in made["ways"]]
    assert [*map(unescape, whole)] == [unescape(markdown.html(each)) for each in (f"{other}3.0 end", "short end")]


def test_a_number_that_begins_a_list_is_not_followed(graph: Graph) -> None:
    told = text((quantity(graph, "x", 2.0), ".0f"), ". first")
    assert "<ol" in markdown.html(told.now) and wording.pieces(told, markdown.html, str) == []
    assert len(wording.pieces(text(told, " & more"), escape, str)) == 3


def test_a_class_in_a_text_is_written_as_python_does(graph: Graph) -> None:
    assert text("a ", (float, "")) == f"a {float}"


@pytest.mark.parametrize("end", [0.3, 1.5])
def test_a_recorded_cylinder_has_its_points_though_it_has_no_length(graph: Graph, end: float) -> None:
    drawn = Sketch().cylinder(quantity(graph, "a", 0.3), quantity(graph, "b", end), barrel=0.2)
    own = Drawing().cylinder(0.3, end, barrel=0.2)
    assert [complex(p.value) for p in drawn.elements[0].points] == pytest.approx(own.elements[0].points)
