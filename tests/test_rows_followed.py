"""Rows are an axis whose length is a quantity: what is made of them is read for any number of them."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from by_cells import by_cells
from own_worksheet import own, recorded, value_of

from mechsheet import evaluate
from mechsheet.readers.numbers import numbers
from mechsheet.recording.record import record

FOLLOWED = [
    "x * g.F",
    "linspace(0, 1, g.n).sum()",
    "np.linspace(0, g.F, 2 * g.n + 1)",
    "np.linspace(0, 1, g.n, endpoint=False)",
    "np.arange(g.n) * g.a",
    "np.arange(1, g.n + 1)[::-1]",
    "np.arange(0, g.F * g.n, 0.7)",
    "np.arange(2, 3 * g.n, 2) * 1.0",
    "np.zeros(g.n) + g.F",
    "np.full(g.n, g.F)",
    "np.ones((g.n, 2)) * g.a",
    "np.zeros_like(x) + 1",
    "np.ones(len(x)) * g.F",
    "x[1:] - x[:-1]",
    "x[::2]",
    "x[2:]",
    "x[-1] - x[0]",
    "x[len(x) // 2]",
    "x[::-1].cumsum()",
    "np.diff(x)",
    "np.cumsum(x)",
    "np.cumprod(x)",
    "np.maximum.accumulate(np.sin(x))",
    "np.gradient(np.sin(x), x)",
    "x.mean()",
    "np.trapezoid(np.sin(x), x)",
    "np.concatenate([[0.0], np.cumsum(x)])",
    "np.append(x, g.F)",
    "np.stack([x, x**2])[1]",
    "np.stack([x, x**2], axis=-1)[..., 1]",
    "np.stack([x, x**2]).sum(axis=0)",
    "np.stack([x, x**2]).sum(axis=1)",
    "np.stack([x, x**2]).reshape(-1)",
    "np.vstack([x, x]).T[:, 1]",
    "(x[:, None] * [1.0, g.a]).max(axis=0)",
    "(x[:, None] * x).sum(axis=1)",
    "np.outer(x, [1.0, 2.0])[:, 1]",
    "np.roll(x, 1)",
    "np.repeat(x, 2)",
    "np.tile(x, 2)",
    "np.flip(x)",
    "x.std(ddof=1)",
    "np.var(x)",
    "np.ptp(x)",
    "np.argmax(np.sin(x))",
    "x[np.argmax(np.sin(x))]",
    "np.interp(x, [0.0, 1.0], [g.F, 2.0])",
    "np.where(x > 1, x, 0.0)",
    "x @ x",
    "x.size * g.a",
    "np.linalg.norm(x)",
    "np.exp(1j * x).sum()",
    "(x + 1j * g.a)[1:]",
    "np.any(x > 4) * 1.0",
    "np.count_nonzero(x > 1)",
    "x[x > 1].sum()",
    "0 * x + g.a",
    "rrr(0.0, g.F, x + 2, 2.0, +1)",
    "np.stack([0 * x, x])[0]",
    "np.piecewise(x, [x > 1], [g.F, 0.0])",
    "find(lambda t: t**3 + t - x, 0, 9, unknown='t').value",
    "np.split(np.arange(2.0 * g.n), 2)[1]",
    "x.shape[0] * g.a",
    "np.cumsum(x[4:]).sum() + g.a",
    "np.trapezoid(x[4:], dx=g.a) + g.a",
    "np.cumsum(np.linspace(0, 1, g.n)[5:]).sum() + g.a",
    "max(v for v in linspace(0, g.F, g.n))",
]
LOOPED = [  # which add something for each row
    "y = 0.0\nfor v in x:\n    y += v**2 * g.a",
    "y, n = 0, 0\nfor v, w in zip(x, x**2):\n    n += 1\n    y = y + v * w\ny = y / n + v + w",
    (
        "y = 0.0\nfor v in x:\n    w = v**2\n    u = w * g.a\n    if u > g.F:\n        y += u / 2\n    elif w > 1:\n"
        "        y += w\n    else:\n        y -= 1\ny = y + u"
    ),
    "def total(xs):\n    s = 0.0\n    for v in xs:\n        s += v * g.a\n    return s\ny = total(x) + total([1, g.F])",
    "def life(S):\n    if S > g.F:\n        return 9 / S\n    return 7 / S**2\ny = sum(1 / life(v) for v in x)",
]
AS_PYTHON = [  # what a turn takes of the one before, or leaves behind
    "y, w = 0.0, 0.0\nfor v in x:\n    y += v * w\n    w = v",
    "y, w = 0.0, 0.0\nfor v in x:\n    w = max(w, v)\n    y += v\ny = y * w",
    "y = 0.0\nfor v in x:\n    y += y * v + 1",
    "y, s = 0.0, ''\nfor v in x:\n    y += v\n    s += 'a'\ny = y * len(s)",
    "L = []\ny = sum([L.append(v) or v for v in x]) + sum(L)",
    "L = []\ndef add(v):\n    L.append(v)\n    return v\ny = 0.0\nfor v in x:\n    y += add(v)\ny = y + len(L)",
    "w = x**2\ny = np.array([v * w for v in x]).sum(axis=0)",
    "y = np.zeros(2)\nfor v in x:\n    y += np.array([v, g.a])",
]
ROWS: list[dict[str, Any]] = [{}, {"n": 3}, {"n": 4, "F": 3.25}, {"n": 12, "a": 0.3}, {"n": 40, "F": -1.0}]


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("expression", FOLLOWED)
def test_what_is_made_of_rows_is_read_for_any_number_of_them(expression: str, tmp_path: Path) -> None:
    bind = "y_found = " + expression.removesuffix(".value") + "\ny = y_found.value" if "find(" in expression else ""
    sheet = own(tmp_path, f"{bind or f'y = {expression}'}  # [-] line")
    _, recording = recorded(sheet)
    assert not recording.gaps and not [guard for guard in recording.guards.values() if not guard.rows]
    for given in ROWS:
        expected = np.asarray(evaluate(sheet.path, ["y"], **given)["y"])
        value = value_of(recording, "y", given)
        assert np.shape(value) == expected.shape, given
        np.testing.assert_allclose(value, expected + 0, rtol=1e-12, atol=1e-13, err_msg=str(given))


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("lines", [*LOOPED, *AS_PYTHON])
def test_a_loop_that_adds_for_each_row_is_a_sum_of_any_number_of_them(lines: str, tmp_path: Path) -> None:
    """Of a table that somebody adds a row to on a page all that a loop had computed was grey."""
    sheet = own(tmp_path, f"{lines}\nresult = y * 1  # [-] line")
    _, recording = recorded(sheet)
    assert not recording.gaps
    for given in ROWS:
        expected = np.asarray(by_cells(sheet.path, ["result"], **given)["result"])
        value = value_of(recording, "result", given)
        if lines in LOOPED or "n" not in given:
            np.testing.assert_allclose(value, expected, rtol=1e-12, atol=1e-13, err_msg=str(given))
        else:
            assert np.isnan(value).all(), given


@pytest.mark.parametrize("ends", ["g.a, g.F, g.n", "0, 2 * np.pi, g.n + 1", "0, g.F, 8 * g.n, endpoint=False"])
def test_a_page_has_positions_to_the_last_bit(ends: str, tmp_path: Path) -> None:
    """So that a limit at one of them lies on the side where the worksheet has it."""
    sheet = own(tmp_path, f"y = np.linspace({ends})  # [-] line")
    names = sheet.run(sheet.results, {"g": sheet.inputs()})
    recording = record({**names, "__file__": sheet.path}, draws=True, lists=True)
    for given in ({"n": n, "F": F, "a": a} for n in (2, 3, 8, 50, 100, 211) for F, a in ((1.0, 0.0), (0.7, -1 / 3))):
        expected = by_cells(sheet.path, ["y"], **given)["y"]
        np.testing.assert_array_equal(value_of(recording, "y", given), expected, err_msg=str(given))
        np.testing.assert_array_equal(evaluate(sheet.path, ["y"], **given)["y"], expected, err_msg=str(given))


@pytest.mark.parametrize(
    "expression",
    [
        "sum(x)",
        "np.array([[v, g.a] for v in x])[:, 0]",
        "np.sort(np.sin(x))",
        "np.cumsum(x[x > 1])",
        "x * np.array([1.0, 2, 3, 4, 5])",
        "x.reshape(5, 1)[:, 0]",
        "x[np.array([0, 4])]",
        "float(len(repr(x.shape))) + x.sum()",
        "np.fft.fft(x).real",
        "sum(linspace(0, 1, g.n))",
        "x[:5] * np.arange(5)",
    ],
)
def test_what_rests_on_a_number_of_rows_that_python_saw_is_no_number_for_others(
    expression: str, tmp_path: Path
) -> None:
    _, recording = recorded(own(tmp_path, f"y = {expression}  # [-] line"))
    assert np.isfinite(value_of(recording, "y", {})).all()
    assert np.isnan(value_of(recording, "y", {"n": 4})).all()


@pytest.mark.parametrize("n", [2.5, -1, np.nan, 1e9])
def test_rows_of_no_number_are_none(n: float, tmp_path: Path) -> None:
    _, recording = recorded(own(tmp_path, "y = x.sum()  # [-] line"))
    (node,) = [node for node, name in recording.names.items() if name == "y"]
    assert np.isnan(numbers([node], {recording.inputs["n"]: n})[node]).all()


def test_the_columns_of_a_table_are_as_long_as_there_are_rows(tmp_path: Path) -> None:
    lines = "two = np.stack([x, 2 * x])  # [-] both\nforce = g.F * 2  # [-] one\n"
    lines += 'table_2 = table("2", "Two", x, force, two, every=2)'
    names, recording = recorded(own(tmp_path, lines))
    assert [len(column.values) for column in names["table_2"].columns] == [6, 6, 6]
    columns = [column.re for column in recording.tables["2"] if column is not None]
    known = numbers(columns, {recording.inputs["n"]: 8})
    assert [known[column].shape for column in columns] == [(8,), (8,), (8,)]


@pytest.mark.parametrize(
    "total", ["np.trapezoid(x**2, x)", "x.sum(axis=0)", "np.max(x, axis=-1) + g.a", "np.mean(x, 0)"]
)
def test_a_number_made_of_rows_along_an_axis_is_one_number(total: str, tmp_path: Path) -> None:
    """A check whose limit an integral gives was not followed, "has several limits", nor any other of its statement."""
    lines = f'from mechsheet import check\nW = {total}  # [-] one\ny = 2 * W  # [-] line\nc = check("c", g.F, y)'
    sheet = own(tmp_path, lines)
    _, recording = recorded(sheet)
    assert not recording.gaps and not [guard for guard in recording.guards.values() if not guard.rows]
    limit = recording.checks["c"].limit
    for given in ROWS:
        known = numbers([limit], {recording.inputs[key]: float(x) for key, x in given.items()})
        np.testing.assert_allclose(known[limit], evaluate(sheet.path, ["y"], **given)["y"], rtol=1e-12)


def test_a_workbook_has_a_check_of_the_number_of_its_rows(tmp_path: Path) -> None:
    _, recording = recorded(own(tmp_path, "y = x.mean()  # [-] line"))
    (guard,) = recording.guards.values()
    assert guard.rows
    known = numbers([guard.holds], {recording.inputs["n"]: 6})
    assert not known[guard.holds]


@pytest.mark.parametrize(
    "sum_of_none",
    [
        "np.arange(1.0, g.n - 4).sum()",
        "np.linspace(0.0, 1.0, g.n - 5).sum()",
        "np.ones(g.n - 5).sum()",
        "np.any(np.arange(g.n - 5) >= 0) * 1.0",
        "np.arange(1.0, len(x[x > 4 * g.n]) + 1).sum()",
    ],
)
def test_of_no_rows_cells_know_nothing_but_that_there_are_none(sum_of_none: str, tmp_path: Path) -> None:
    """No cell of a row noted it: a sum of no rows was 0 for all other inputs."""
    _, recording = recorded(own(tmp_path, f"y = {sum_of_none} + g.a  # [-] y"))
    assert value_of(recording, "y", {"a": 1.5}) == 1.5
    assert np.isnan(value_of(recording, "y", {"n": 8, "F": 30.0}))
