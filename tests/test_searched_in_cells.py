"""Found values without a closed form are searched by the cells of the workbook."""

from __future__ import annotations

from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from openpyxl import load_workbook
from own_worksheet import own, recorded
from test_recalculation import edit

from mechsheet import SheetError, evaluate
from mechsheet.quantities.node import bottom_up
from mechsheet.readers.numbers import numbers
from mechsheet.readers.searched import search
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
    # of a whole field at each place: its least, a sum, an integral, a table, a system, a mask
    "L": "lambda x: np.min(np.cos(x * p) + g.a * p), 0.0, 1.5, equals=0.6 + g.F / 90",
    "Q": "lambda x: np.trapezoid(np.exp(-x * p) + g.a, p), 0.0, 9.0, equals=0.6 + g.F / 9 + 2 * g.a",
    "I": "lambda x: np.interp(x, [0, 1, 2, 4], [0, g.a, 2.5, 9]), 0.0, 4.0, equals=g.F",
    "M": "lambda x: np.linalg.solve(np.array([[x, 1], [g.a, 3]]), [1, 2])[0], 1.0, 9.0, equals=0.06 + g.F / 50",
    "Z": "lambda x: np.cumsum(np.where(p > 1, p * x, 0))[-1] + np.max(np.stack([p, x * p])), 0.0, 30.0, equals=g.F + 2",
}
CELL = """
@app.cell
def cell_NAME(g, p):
    NAME_found = find(EQUATION, unknown="NAME")
    NAME = NAME_found.value  # [-] searched
    return NAME, NAME_found
"""
FIELDS = """
@app.cell
def summed(g):
    p = np.linspace(0, 2, 6)  # [-] places
    z = np.array([0.5, 0.8, 1.0])  # [-] factors
    q_found = find(lambda q: np.sum(np.exp(-q[..., None] * p) * z[:, None], axis=-1), 0.0, 90.0, equals=1.1 + g.F / 9)
    q = q_found.value  # [-] searched with a sum for each
    table_3 = table("3", "Sums", z, q)
    return p, q, q_found


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
    ({"F": 8.5}, "NPUV"),  # they have no root; W has several
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
        sums = [row[1] for row in changed["3 Sums"].iter_rows(min_row=5, max_row=7, values_only=True)]
        np.testing.assert_allclose(sums, of_worksheet(path, "q", given), 1e-12)
        for n, name in enumerate(("j", "t", "s")):
            column = [row[n] for row in changed["2 Own"].iter_rows(min_row=5, max_row=9, values_only=True)]
            np.testing.assert_allclose(column, of_worksheet(path, name, given), 1e-12)


SEVERAL = {  # equations with several roots, and how many of 20 inputs have a value at least, in each element
    "middle": ("lambda t: np.sin(g.F * t), 0.5, 4.0", 20),
    "guess": ("lambda t: np.sin(g.F * t), 0.5, 4.0, guess=g.a + 0.5", 20),
    "outside": ("lambda t: np.cos(t * g.F), 0.5, 4.0, guess=-9.0", 20),
    "crank": ("lambda t: np.cos(t) + np.sqrt(9 - np.sin(t) ** 2), 0.0, 6.28, equals=3 + g.a / 4, guess=5.0", 20),
    "all about": ("lambda t: np.sin(50 * t) + g.a / 9, 0.5, 1.5", 20),
    "poles": ("lambda t: np.tan(t), 0.0, 6.0, equals=g.a, guess=g.F / 3", 6),
    "three": ("lambda t: t * (t - 1e-3 * g.a) * (t - 0.1) * (t - g.F), -1.0, 9.0, guess=0.3", 12),
    "tables": ("lambda t: np.interp(t, [0, 1, 2, 4, 9], [0, g.a, 2.5, 9, 20]), 0.0, 9.0, equals=x", 20),
    "means": ("lambda t: np.mean(np.maximum(t[..., None] * x - g.a * x**2 / 9, 0), -1), 0.0, 9.0, equals=x", 20),
    "field": ("lambda t: np.sin(t * x), 0.5, 4.0, equals=0.1 * g.a, guess=2.2", 15),
}


@pytest.mark.parametrize("name", SEVERAL)
def test_of_several_roots_cells_find_the_nearest(name: str, tmp_path: Path) -> None:
    """Or nothing, never another one."""
    equation, of_20 = SEVERAL[name]
    lines = (
        f'u_found = find({equation})\ny = np.atleast_1d(u_found.value) * 1  # [-] root\ntable_2 = table("2", "Y", y)'
    )
    sheet = own(tmp_path, lines)
    _, recording = recorded(sheet, F=2.2)
    search(recording)
    (solved,) = recording.found.values()
    assert solved.inverse is not None
    random, shown, count = np.random.default_rng(5), 0.0, 8
    for F, a in zip(random.uniform(1, 6, count), random.uniform(0.05, 2, count), strict=True):
        value = numbers([solved.inverse], {recording.inputs["F"]: F, recording.inputs["a"]: a})[solved.inverse]
        there = np.isfinite(value)
        if there.any():
            expected = np.reshape(of_worksheet(Path(sheet.path), "y", {"F": F, "a": a}), value.shape)
            np.testing.assert_allclose(value[there], expected[there], 1e-12, 1e-14, err_msg=str((F, a)))
        shown += there.mean()
    assert shown >= count * of_20 / 20


@pytest.mark.parametrize(
    ("lines", "reason"),
    [
        ("u_found = find(lambda u: np.sum(np.exp(-u * np.linspace(0, 1, 999))), 0.0, 9.0, equals=90 * g.F)", "500,000"),
        ("u_found = find(lambda u: u * x + u.sum() * 1e-9, 0.0, 9.0 / x, equals=g.F)", "rests on others of them"),
        (
            "u_found = find(lambda u: u * (2 + len(f'{u:.1f}') * 1e-9), 0.0, 9.0, equals=g.F)",
            "Python looks at what is found",
        ),
    ],
)
def test_a_search_that_cells_do_not_make_is_named(lines: str, reason: str, tmp_path: Path) -> None:
    sheet = own(tmp_path, f'{lines}\ny = np.atleast_1d(u_found.value) * 2  # [-] found\ntable_2 = table("2", "Two", y)')
    _, recording = recorded(sheet)
    search(recording)
    (gap,) = recording.unsolved
    assert reason in gap.reason and not recording.gaps


def test_finds_that_call_their_unknown_the_same_are_searched_each(tmp_path: Path) -> None:
    finds = [f"{name}_found = find(lambda t: t**{power} - g.F, 0.0, 9.0)" for name, power in (("p", 2), ("q", 3))]
    values = ["p = p_found.value  # [-] root", "again = q_found", "q = again.value  # [-] other root"]
    sheet = own(tmp_path, "\n".join([*finds, *values, "y = x * 1.0  # [-] y"]))
    _, recording = recorded(sheet)
    search(recording)
    known = [name for name, solved in recording.found.items() if solved.inverse]
    assert known == ["p_found.unknown x", "q_found.unknown x"]
    book = load_workbook(BytesIO(report.workbook("Own", cells.load(sheet.path).run_whole(), {})))
    lines = [row[:2] + row[4:5] for row in book["Find"].iter_rows(min_row=3, values_only=True)]
    assert [left for _, _, left in lines] == ["=p^2-F", "=q^3-F"] and len({value for _, value, _ in lines}) == 2


def test_a_search_rests_on_nothing_that_it_finds(tmp_path: Path) -> None:
    """The number of rows of what rests on the unknown, by which a mean divides, would be a circle of cells."""
    less = "g.a * np.interp(x, np.array([0.0, 9]), np.array([0.0, 1]))"
    found = f"u_found = find(lambda u: np.mean(np.maximum(u * x - {less}, 0)), 0.0, 9.0, equals=g.a)"
    sheet = own(tmp_path, f"{found}\ny = u_found.value * x  # [-] y")
    _, recording = recorded(sheet)
    search(recording)
    (solved,) = recording.found.values()
    assert solved.searched and solved.inverse and solved.node not in set(bottom_up([solved.inverse], ()))
