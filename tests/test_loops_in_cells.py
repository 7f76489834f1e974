"""Loops that end by what they compute, in the cells of a workbook: other inputs take another number of turns."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from openpyxl import load_workbook
from own_worksheet import own
from test_recalculation import MADE, computed, edit, lines, verdicts
from typed_workbook import typed

from mechsheet import evaluate
from mechsheet.run import report

LOOPS = """
from mechsheet import check
y0 = 1.0
while abs(y0 * y0 - g.F) > 1e-12 * g.F:
    y0 = (y0 + g.F / y0) / 2
lo, hi = 0.0, 40.0
while hi - lo > 1e-9:
    mid = (lo + hi) / 2
    if mid**3 + g.a * mid > g.F:
        hi = mid
    else:
        lo = mid
y1 = (lo + hi) / 2
for y2 in (6.0, 8.0, 10.0, 12.0, 16.0):
    if g.F * 100 / y2**2 < g.a * 4:
        break
y3 = x * 0 + 1
while np.max(np.abs(y3 * y3 - x)) > 1e-12 * g.F:
    y3 = (y3 + x / y3) / 2
root = y0 * 1.0  # [-] by Newton
halved = y1 * 1.0  # [-] by halves
bolt = y2 * 1.0  # [-] the first that is large enough
field = y3 * 1.0  # [-] of a field
single = np.array([root, halved, bolt])  # [-] of single numbers
table_2 = table("2", "Single", single)
table_3 = table("3", "Field", field)
check_2 = check("root", root**2 - g.F, 1e-9)"""


def test_loops_are_followed_while_they_end_within_the_turns_of_the_cells(
    recalculated_all: Callable[[list[Path]], list[Any]], tmp_path: Path
) -> None:
    """Twice as many turns as now and some more; where that is too few no number is shown, and a check fails."""
    sheet = own(tmp_path, LOOPS.strip())
    names = sheet.run(sheet.results, {"g": sheet.inputs()})
    path = tmp_path / "own.xlsx"
    path.write_bytes(report.workbook("", {**names, "__file__": sheet.path}, {}))
    rows = load_workbook(path)["Inputs"].iter_rows(min_row=3, values_only=True)
    (row,) = [n for n, (symbol, *_) in enumerate(rows, 3) if symbol == "F"]
    values = [0.7, 3.25, 19.0, 1e30]
    paths = [typed(path, {("Inputs", f"B{row}"): F}, tmp_path / f"{n}.xlsx") for n, F in enumerate(values)]
    for F, book in zip(values, recalculated_all(paths), strict=True):
        shown = [[cell.value for cell in book[title]["A"][4:]] for title in ("2 Single", "3 Field")]
        checks = {line[0].value: line[4].value for line in book["Checks"].iter_rows(min_row=3)}
        made = checks["made for these inputs: where this fails, export the worksheet again"]
        if F > 1e9:
            assert shown[0][0] == "#N/A" and set(shown[1]) == {"#N/A"}
            assert (checks["root"], made) == ("not evaluated", "FAIL")
            continue
        expected = evaluate(sheet.path, ["single", "field"], F=F)
        np.testing.assert_allclose(shown[0], expected["single"], rtol=1e-10)
        np.testing.assert_allclose(shown[1], expected["field"], rtol=1e-10)
        assert (checks["root"], made) == ("PASS", "PASS")


BRAKED = """v, way, t = 10 * g.F, 0.0, 0.0
while v > 0:
    w = v - 9.81 * g.a * 0.1
    way, t, v = way + 0.05 * (v + w), t + 0.1, w
t_0 = t * 1.0  # [s] time
s_0 = way * 1.0  # [m] way"""


def test_lines_alone_tell_that_cells_take_too_few_turns(
    recalculated_all: Callable[[list[Path]], list[Any]], tmp_path: Path
) -> None:
    """Of a loop behind no table or check, no number was shown, and all was said to be made for these inputs."""
    sheet = own(tmp_path, "y = g.F * 1.0  # [-] number", further=[BRAKED])
    book = computed(Path(sheet.path), tmp_path, {})
    values = [3.25, 250.0]
    paths = [edit(book, {"F": F}, tmp_path / f"{n}.xlsx") for n, F in enumerate(values)]
    known, unknown = recalculated_all(paths)
    found = {name: numbers for (_, name), (_, numbers) in lines(known).items()}
    own_values = evaluate(sheet.path, ["t_0", "s_0"], F=3.25)
    np.testing.assert_allclose([*found["t_0"], *found["s_0"]], [own_values["t_0"], own_values["s_0"]], rtol=1e-10)
    lost = {name: numbers for (_, name), (_, numbers) in lines(unknown).items()}
    assert (lost["t_0"], lost["s_0"]) == (["#N/A"], ["#N/A"])
    assert (verdicts(known)[MADE], verdicts(unknown)[MADE]) == ("PASS", "FAIL")
