"""The page has a writer for each kind of value, loaded when the first one is shown."""

import subprocess
import sys
from dataclasses import dataclass

import pytest

import mechsheet
from mechsheet.page import values
from mechsheet.worksheet.shown import Shown


@dataclass(frozen=True)
class Torque(Shown):
    """A kind of value that no writer knows."""


def test_value_without_a_writer_says_so():
    kind, text = Torque()._mime_()
    assert kind == "text/html" and "Torque: the page has no writer for values of this kind" in text


def test_every_kind_of_value_has_a_writer():
    kinds, more = set[type](), [Shown]
    while more:
        kinds |= (new := {kind for parent in more for kind in parent.__subclasses__() if kind is not Torque} - kinds)
        more = list(new)
    assert {"Check", "Drawing", "Figure", "Found", "Player", "Summary", "Table", "Typeset", "Used"} <= {
        kind.__name__ for kind in kinds
    }
    assert [kind for kind in kinds if values.html.dispatch(kind) is values.html.dispatch(object)] == []


def test_script_loads_no_writer_of_pages():
    """`import mechsheet` says where they are; a value that nobody looks at loads none."""
    code = "import sys; from mechsheet import check, title_block; print(check('a', 0, 1), *sys.modules)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, encoding="utf-8", check=True)
    assert "mechsheet.worksheet.check" in done.stdout and "mechsheet.page.values" not in done.stdout


def test_slider_rests_where_no_page_is_running_and_its_value_is_within_its_range():
    turn = mechsheet.slider(0, 360, step=2, value=40, label="crank", unit="deg")
    assert turn.value == 40 and "crank [°] 40" in turn._mime_()[1]
    assert mechsheet.slider(1, 3, label="load case").value == 1, "at its start"
    with pytest.raises(mechsheet.SheetError, match=r"slider load case: value = 4 must be 1\.\.3"):
        mechsheet.slider(1, 3, value=4, label="load case")
