"""The contents of a worksheet as data, against what its page shows."""

from pathlib import Path

import numpy as np
import pytest

from mechsheet.document.parts import Control, Line, Section, Text, contents
from mechsheet.worksheet.checks import Check, Summary
from mechsheet.worksheet.drawing import Drawing
from mechsheet.worksheet.find import Found
from mechsheet.worksheet.inputs import Used
from mechsheet.worksheet.lines import Given, Typeset
from mechsheet.worksheet.shown import Shown
from mechsheet.worksheet.table import Figure, Table
from mechsheet.worksheet.title import Caption, Player, Title
from worksheets import hitch, landing_gear, slotted_link

SHEETS = {Path(module.__file__).stem: module for module in (hitch, landing_gear, slotted_link)}


def parts(value):
    """Values that an output of the page shows one after the other."""
    if isinstance(value, Typeset):
        return [type(row) for row in value.rows] + [kind for shown in value.shown for kind in parts(shown)]
    if isinstance(value, tuple | list):
        return [kind for each in value for kind in parts(each)]
    return [type(value)] if isinstance(value, Shown) else []


@pytest.mark.parametrize("name", SHEETS)
def test_contents_are_what_the_page_shows_in_its_order(name):
    outputs, _ = SHEETS[name].app.run()
    page = [kind for output in outputs for kind in parts(output)]
    found = contents(SHEETS[name].__file__)
    kinds = {Line: "Formula", Given: "Given", Control: Player.__name__}
    shown = [kinds.get(type(part), type(part).__name__) for part in found if not isinstance(part, Section | Text)]
    assert shown == [kind.__name__ for kind in page]


@pytest.fixture(scope="module")
def document():
    return contents(hitch.__file__)


def of(document, kind):
    return [part for part in document if isinstance(part, kind)]


def test_sections_stand_in_their_order_with_their_texts(document):
    assert [part.title for part in of(document, Section) if part.level == 2] == [
        "1 Input data", "2 Geometry", "3 Kinematics", "4 Lifting capacity", "5 Forces", "6 Steering stability",
        "7 Check by the instant centre",
    ]  # fmt: skip
    at = document.index(Section(2, "2 Geometry"))
    assert document[at + 1].markdown.startswith("Points are complex numbers $x + iy$ from the rear axle.")
    assert isinstance(document[0], Title) and isinstance(document[1], Summary)


def test_numbered_parts_follow_each_other(document):
    assert [table.number for table in of(document, Table)] == ["2.1", "2.2", "3.1", "4.1", "5.1", "6.1", "7"]
    figures = [part.number for part in of(document, Figure) + of(document, Caption)]
    assert len(figures) == len(set(figures)) > 5
    assert len(of(document, Drawing)) >= 2 and len(of(document, Used)) == 1


def test_what_is_asked_stands_before_what_is_found(document):
    found = [document.index(part) for part in of(document, Found)]
    equations = [i for i, part in enumerate(document) if isinstance(part, Given)]
    assert len(found) == len(equations) == 3
    assert all(equation < root for equation, root in zip(equations, found, strict=True))


def test_every_check_stands_in_the_summary_and_at_its_place(document):
    (summary,) = of(document, Summary)
    assert {check.name for check in of(document, Check)} == {check.name for check in summary.checks}


def test_lines_hold_values_and_controls_what_they_set(document):
    lines = {part.formula.name: part for part in of(document, Line)}
    assert lines["L4"].formula.unit == "m" and 0.5 < lines["L4"].value < 0.7
    assert lines["P23"].value is None, "a function has none"
    assert of(document, Control)[0] == Control("part", "part of the stroke", 0, 1, 0.01, 0.2, False)


def test_other_inputs_give_other_contents():
    heavy = {part.formula.name: part.value for part in of(contents(hitch.__file__, hitch.Hitch(P6=30e3)), Line)}
    light = {part.formula.name: part.value for part in of(contents(hitch.__file__), Line)}
    assert heavy["L4"] == light["L4"] and heavy.keys() == light.keys()
    assert np.all(abs(heavy["R56"]) > abs(light["R56"]))
