"""Found values without a closed form are searched by the cells of the workbook."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from own_worksheet import own
from test_recalculation import edit

from mechsheet import SheetError, evaluate
from mechsheet.run import report
from mechsheet.worksheet import cells

SEARCHED = {  # by the unknown: the equation, its interval and what it must be
    "E": "lambda x: x - g.a * np.sin(x), 0.0, 4.0, equals=g.F / 2",
    "S": "lambda x: np.sign(x - g.a) * abs(x - g.a) ** 0.2, 0.0, 1e3",
    "T": "lambda x: x * 1e9 - g.a * 1e5, -1.0, 1.0",
    "P": "lambda x: 1 / (g.F + 1 - x), 0.0, 3.0, equals=g.a",
    "J": "lambda x: np.where(x < g.F, x - 1, x + 10), 0.0, 2.0",
    "W": "lambda x: np.sin(g.F * x), 0.5, 2.0",
    "N": "lambda x: x**3 - g.F, 0.0, 2.0",
    "B": "lambda x: (x + g.F - 0.625) * (1 - x), 0.0, 2.0, guess=0.1",
    "U": "lambda x: (x - g.a) * (2 * g.F - x), 1.0, 6.0, guess=6.0",
    "D": "lambda x: ((x - 0.7) ** 2 + (g.F - 0.625) ** 2) * (1.55 - x), 0.0, 2.0, guess=0.8",
    "C": "lambda x: (x - g.a) * ((x - 1.012) ** 2 + (g.F - 0.625) ** 2 - 1e-5), 0.0, 2.0, guess=1.0",
    "V": "lambda x: np.sqrt(x - 0.1) * (1.2 - x) + (g.F - 0.625) - 1e-4, 0.0, 4.0, guess=0.1",
}
CELL = """
@app.cell
def cell_NAME(g):
    NAME_found = find(EQUATION, unknown="NAME")
    NAME = NAME_found.value  # [-] searched
    return NAME, NAME_found
"""
FIELDS = """
@app.cell
def fields(E, g):
    j = np.linspace(1, 2, g.n)  # [-] number
    t_found = find(lambda t: t * np.exp(t * j), 0.0, 3.0, equals=g.F, unknown="t")
    t = t_found.value  # [-] searched at every position
    s = t * E  # [-] what rests on it
    table_2 = table("2", "Own", j, t, s)
    return j, s, t, t_found
"""
CHANGES: list[tuple[dict[str, Any], str]] = [  # with those that have no value in the cells
    # the sign changes at a pole, where it jumps, nowhere; there are other roots: at an end, touching, close, beside NaN
    ({"F": 0.625, "a": 0.25}, "PJWBDCV"),
    ({"F": 8.5}, "WNPUV"),  # W has several roots, the others none
]


@pytest.fixture(scope="module")
def path(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = Path(own(tmp_path_factory.mktemp("own"), "y = x * 1.0").path)
    searched = [CELL.replace("NAME", name).replace("EQUATION", f) for name, f in SEARCHED.items()]
    text, end = path.read_text(encoding="utf-8"), "\nif __name__"
    path.write_text(text.replace(end, "".join([*searched, FIELDS, end])), encoding="utf-8")
    return path


def of_worksheet(path: Path, name: str, given: dict[str, Any]) -> Any:
    """What the worksheet finds; NaN where it says that there is nothing to be found."""
    try:
        return np.atleast_1d(evaluate(path, [name], **given)[name])
    except SheetError as error:
        assert name in str(error)
        return np.array([np.nan])


def test_cells_find_what_the_worksheet_finds(path: Path, recalculated_all: Any, tmp_path: Path) -> None:
    book = tmp_path / "own.xlsx"
    book.write_bytes(report.workbook("Own", cells.load(path).run_whole(), {}))
    edited = [edit(book, given, tmp_path / f"changed{n}.xlsx") for n, (given, _) in enumerate(CHANGES)]
    for (given, none), changed in zip(CHANGES, recalculated_all(edited), strict=True):
        found = {row[0]: row[1] for row in changed["Find"].iter_rows(min_row=3, values_only=True)}
        for name in SEARCHED:
            if name in none:
                assert found[name] == "#N/A", name
            else:
                assert found[name] == pytest.approx(of_worksheet(path, name, given)[0], rel=1e-12), name
        for n, name in enumerate(("j", "t", "s")):
            column = [row[n] for row in changed["2 Own"].iter_rows(min_row=5, max_row=9, values_only=True)]
            np.testing.assert_allclose(column, of_worksheet(path, name, given), 1e-12)
