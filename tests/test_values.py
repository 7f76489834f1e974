"""The page has a writer for each kind of value, loaded when the first one is shown."""

import subprocess
import sys
from dataclasses import dataclass

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
    assert "mechsheet.worksheet.checks" in done.stdout and "mechsheet.page.values" not in done.stdout
