"""Found values without a closed form are searched by the cells of the workbook."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from test_recalculation import edit

from mechsheet import SheetError, evaluate
from mechsheet.run import report
from mechsheet.worksheet import cells

SEARCHED = {  # by the unknown: the equation, its interval and what it must be
    "E": "lambda x: x - g.a * sin(x), 0.0, 4.0, equals=g.F / 2",
    "S": "lambda x: np.sign(x - g.a) * abs(x - g.a) ** 0.2, 0.0, 1e3",
    "T": "lambda x: x * 1e9 - g.a * 1e5, -1.0, 1.0",
    "P": "lambda x: 1 / (g.F + 1 - x), 0.0, 3.0, equals=g.a",
    "J": "lambda x: where(x < g.F, x - 1, x + 10), 0.0, 2.0",
    "W": "lambda x: sin(g.F * x), 0.5, 2.0",
    "N": "lambda x: x**3 - g.F, 0.0, 2.0",
}
SHEET = '''
import marimo
app = marimo.App()

with app.setup:
    import numpy as np
    from numpy import exp, linspace, sin, where
    from mechsheet import ask, find, inputs, read, table

@app.class_definition
@inputs
class Own:
    F: float = 2.5  # [-] number
    a: float = 0.75  # [-] part
    n: int = 4  # [-] positions; > 1

    """Inputs."""

@app.cell
def given():
    form = ask(Own)
    return (form,)

@app.cell
def machine(form):
    g = read(Own, form)
    return (g,)
'''
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
    k = linspace(1, 2, g.n)  # [-] number
    x_found = find(lambda x: x * exp(x * k), 0.0, 3.0, equals=g.F, unknown="x")
    x = x_found.value  # [-] searched at every position
    y = x * E  # [-] what rests on it
    table_x = table("x", "All", k, x, y)
    return k, x, x_found, y
"""
CHANGES: list[tuple[dict[str, Any], str]] = [  # with those that have no value in the cells
    ({"F": 0.625, "a": 0.25}, "PJW"),  # the sign changes at a pole, where it jumps, and nowhere
    ({"F": 8.5}, "WNP"),  # W has several roots, the others none
]


@pytest.fixture(scope="module")
def path(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("own") / "own.py"
    searched = [CELL.replace("NAME", name).replace("EQUATION", f) for name, f in SEARCHED.items()]
    path.write_text("".join([SHEET, *searched, FIELDS, "\nif __name__ == '__main__':\n    app.run()\n"]), "utf-8")
    return path


def own(path: Path, name: str, given: dict[str, Any]) -> Any:
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
            value = found[name]
            if name in none:
                assert value == "#N/A", name
            else:
                assert value == pytest.approx(own(path, name, given)[0], rel=1e-12), name
        for n, name in enumerate(("k", "x", "y")):
            column = [row[n] for row in changed["x All"].iter_rows(min_row=5, max_row=8, values_only=True)]
            np.testing.assert_allclose(column, own(path, name, given), 1e-12)
