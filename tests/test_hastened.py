"""What is kept of marimo's work is what marimo would work out again."""

import subprocess
import sys

import marimo

from mechsheet.page.hastened import VERSION

KEPT = """
from importlib.metadata import entry_points
from marimo._entrypoints import registry
from marimo._messaging import notification as n, serde
from marimo._session.state import session_view
from mechsheet.hastened import hasten

hasten(), hasten()
for group in ("marimo.cell.executor", "console_scripts"):
    assert list(registry.get_entry_points(group)) == list(entry_points(group=group))
assert registry.get_entry_points("console_scripts") is registry.get_entry_points("console_scripts")

messages = [
    n.CompletedRunNotification(),
    n.RemoveUIElementsNotification(cell_id="Hbol"),
    n.CellNotification(cell_id="Hbol", status="running", timestamp=1.5),
    n.VariableValuesNotification(variables=[n.VariableValue(name="S", value="0.5", datatype="float")]),
]
for message in messages:
    text = serde.serialize_kernel_message(message)
    assert session_view.deserialize_kernel_message(text) == serde.deserialize_kernel_message(text), text
try:
    session_view.deserialize_kernel_message(b'{"op": "no such message"}')
except Exception as error:
    kept = error
try:
    serde.deserialize_kernel_message(b'{"op": "no such message"}')
except Exception as error:
    assert type(error) is type(kept) and str(error) == str(kept)
print("the same")
"""


def test_the_version_for_which_it_is_written_is_the_one_installed():
    assert marimo.__version__ == VERSION


def test_entry_points_and_messages_are_the_same():
    ran = subprocess.run([sys.executable, "-c", KEPT], capture_output=True, text=True)
    assert ran.stdout.strip() == "the same", ran.stderr
