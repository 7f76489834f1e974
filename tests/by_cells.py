"""What the cells of a worksheet give, to the last bit: `evaluate` computes what is asked for again another way."""

from pathlib import Path
from typing import Any

from mechsheet.recording import evaluation
from mechsheet.worksheet import inputs
from mechsheet.worksheet.cells import load


def by_cells(worksheet: Path, want: list[str], **given: Any) -> dict[str, Any]:
    sheet = load(worksheet)
    return evaluation.by_cells(sheet, want, inputs.build(sheet.inputs, given))
