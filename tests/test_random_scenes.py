"""Workbooks at inputs that nobody chose: every number of their tables and figures is the worksheet's own.

Another seed, or more scenes: ``SCENES=20 SEED=7 pytest tests/test_random_scenes.py``.
"""

from __future__ import annotations

import math
import os
from collections.abc import Callable
from io import BytesIO
from pathlib import Path
from random import Random
from typing import Any

import numpy as np
import pytest
from test_recalculation import ROOT, disagreements, edit, whole
from written_cells import Values

from mechsheet.run import report
from mechsheet.worksheet import cells, inputs
from mechsheet.worksheet.check import checks_of, refuse_open
from mechsheet.worksheet.errors import SheetError

SCENES, SEED = int(os.environ.get("SCENES", "0")), os.environ.get("SEED", "")
COUNTS = {"guide": 2, "bucket": 2, "landing_gear": 1, "slotted_link": 1, "joint": 1, "hitch": 1, "kinetostatics": 1}
FIXED: dict[str, list[dict[str, Any]]] = {
    "joint": [
        {"loads.M (2)": -150000, "loads.N (1)": -40000},  # other areas act, after other numbers of steps
        {"loads.M_w (1)": 2e5, "y_noo": 12, "stringers.k_t (2)": 1},
        {"ring_loads.N (2)": 9e4, "ring_loads.M (1)": -1e6},  # all bolts pull, the other side pulls
        {"k_max": 8},  # other rows
    ],
    "landing_gear": [{"U": 57.8089, "a": 0.190441, "eps_lim": 0.101883}],  # an analogue that is zero but for rounding
}


def scene(sheet: cells.Worksheet, random: Random) -> dict[str, float]:
    """Some inputs, one or several, near what they are or far from it; whole numbers, of which rows depend, stay."""
    default = sheet.inputs()
    elements = dict[str, list[tuple[str, Any]]]()
    for field in inputs.declared(sheet.inputs):
        for name, (column, value) in field.leaves(getattr(default, field.name)).items():
            if column.continuous:
                shown = [column.display(float(x)) for x in np.ravel(value)]
                elements[name] = [(f"{name} ({k})" if np.ndim(value) else name, x) for k, x in enumerate(shown, 1)]
    found = {}
    for name in random.sample(sorted(elements), random.choice([1, 1, 2, 4])):
        element, x = random.choice(elements[name])
        factor = random.choice([random.uniform(0.95, 1.05), random.uniform(0.6, 1.4), math.exp(random.gauss(0, 1)), -1])
        found[element] = float(f"{x * factor or random.uniform(-1, 1):.6g}")
    return found


def own(sheet: cells.Worksheet, changes: dict[str, Any]) -> Any:
    """The workbook that the worksheet exports at changed inputs; None where it refuses them."""
    try:
        g = inputs.build(sheet.inputs, whole(sheet.inputs, changes))
        names = {**sheet.run(sheet.results, {"g": g}), "__file__": sheet.path}
        refuse_open(checks_of(names))
    except SheetError:
        return None
    return Values(BytesIO(report.workbook(sheet.title, names, {})))


def verdicts(book: Any) -> dict[str, str]:
    return {row[0].value: row[4].value for row in book["Checks"].iter_rows(min_row=3)}


@pytest.mark.parametrize("name", COUNTS)
def test_at_random_inputs_every_number_is_the_worksheets_own(
    name: str, recalculated_all: Callable[[list[Path]], list[Any]], tmp_path: Path
) -> None:
    """Other rows or checks than the workbook has, and what the worksheet refuses, leave a failing check."""
    folder = ROOT / "worksheets"
    sheet = cells.load(next(path for path in (folder / f"{name}.py", folder / f"examples/{name}.py") if path.exists()))
    random = Random(f"{name} {SEED}")
    scenes = FIXED.get(name, []) + [scene(sheet, random) for _ in range(SCENES or COUNTS[name])]
    names = {**sheet.run(sheet.results, {"g": sheet.inputs()}), "__file__": sheet.path}
    made = tmp_path / "made.xlsx"
    made.write_bytes(report.workbook(sheet.title, names, {}))
    edited = [edit(made, changes, tmp_path / f"scene_{n}.xlsx") for n, changes in enumerate(scenes)]
    wrong = dict[str, Any]()
    for changes, live in zip(scenes, recalculated_all(edited), strict=True):
        there, told = own(sheet, changes), verdicts(live)
        if there is None or "k_max" in changes or verdicts(there).keys() != told.keys():
            if "FAIL" not in told.values():
                wrong[str(changes)] = "no check fails"
        elif found := list(disagreements(live, there, r"\d|Fig")):
            wrong[str(changes)] = found[:5]
        else:
            other = {check: told[check] for check, verdict in verdicts(there).items() if told[check] != verdict}
            wrong |= {str(changes): other} if other else {}
    assert wrong == {}
