"""The documents with their own inputs, each run and recorded once for the tests of a process."""

from functools import cache
from pathlib import Path
from typing import Any

from mechsheet.quantities.lines import Recording
from mechsheet.recording.record import record
from mechsheet.worksheet.cells import Worksheet, load

WORKSHEETS = Path(__file__).parents[1] / "worksheets"
DOCUMENTS = ("hitch", "landing_gear", "kinetostatics", "slotted_link", "joint")


@cache
def run(path: Path) -> tuple[Worksheet, dict[str, Any]]:
    """A worksheet and its namespace."""
    sheet = load(path)
    return sheet, sheet.run(sheet.results, {"g": sheet.inputs()})


@cache
def recorded(stem: str) -> tuple[Worksheet, dict[str, Any], Recording]:
    """A document, its namespace and its recording, in which nobody may search or change anything."""
    sheet, names = run(WORKSHEETS / f"{stem}.py")
    return sheet, names, record(names, sheet)
