"""Worksheets of one's own are recorded: what numpy and Python do in them is followed, or said not to be."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from mechsheet.recording.lines import Recording
from mechsheet.recording.numbers import numbers
from mechsheet.recording.quantity import Quantity
from mechsheet.recording.record import record
from mechsheet.worksheet import cells

SHEET = '''
import marimo
app = marimo.App()

with app.setup:
    import math
    from math import sqrt, sin, hypot

    import numpy as np
    from numpy import cos, exp, interp, linspace

    from mechsheet import ask, export, find, read, inputs, table, typeset
    from mechsheet import *

@app.class_definition
@inputs
class Own:
    F: float = 2.5  # [-] number
    a: float = 0.75  # [-] part
    n: int = 5  # [-] positions; > 1
    k: int = 2  # [-] choice; >= 0 < 4

    """Inputs."""

@app.cell
def given():
    form = ask(Own)
    return (form,)

@app.cell
def machine(form):
    g = read(Own, form)
    return (g,)

@app.cell
def lines(g):
    x = linspace(0.1, 2, g.n) * g.F  # [-] field
    LINES
    table_1 = table("1", "All", x)
    typeset()
    return

if __name__ == "__main__":
    app.run()
'''


def own(tmp_path: Path, lines: str) -> cells.Worksheet:
    path = tmp_path / "own.py"
    path.write_text(SHEET.replace("from mechsheet import *", "").replace("LINES", lines.replace("\n", "\n    ")))
    return cells.load(path)


def recorded(sheet: cells.Worksheet, **given: Any) -> tuple[dict[str, Any], Recording]:
    names = sheet.run(sheet.results, {"g": sheet.inputs(**given)})
    return names, record({**names, "__file__": sheet.path})


def value_of(recording: Recording, name: str, given: dict[str, Any]) -> Any:
    """A recorded line for other inputs: its parts by their names in the recording."""
    nodes = {known: node for node, known in recording.names.items()}
    found = [nodes[n] for n in (name, f"{name}x", f"{name}y") if n in nodes]
    assert found, f"{name} is not in the recording"
    known = numbers(found, {recording.inputs[key]: float(x) for key, x in given.items()})
    values = [known[node] for node in found]
    return values[0] if len(values) == 1 else values[0] + 1j * values[1]


FOLLOWED = [
    "interp(x, [0.0, 1.0, 4.0], [g.F, 3.0, 5.0])",
    "interp(g.a, [0.0, 1.0, 4.0], [g.F, 3.0, 5.0], left=7.0)",
    "np.cumsum(x)", "np.cumprod(x)", "np.diff(x)", "np.diff(x, n=2)", "np.diff(x, prepend=0)", "np.gradient(x, x)",
    "np.sort(np.array([g.F, 3.0, g.a, -g.F]))", "np.argmax(np.sin(x * g.a))", "np.argmin(np.cos(x))",
    "x[np.argmax(np.sin(x))]", "np.trapezoid(x**2, x)", "np.trapezoid(x, dx=g.a)",
    "np.linalg.solve(np.array([[g.F, 1.0], [g.a, 3.0]]), np.array([1.0, g.F]))",
    "np.linalg.solve(np.array([[0.0, 1, 2], [g.a, 3, 1], [2, g.F, 5]]), [1.0, g.F, 2])",
    "np.linalg.det(np.array([[g.F, 1.0, 2], [g.a, 3.0, 1], [4, 5, g.F]]))",
    "np.linalg.inv(np.array([[g.F, 1.0], [g.a, 3.0]]))", "np.linalg.norm(x)",
    "np.array([[g.F, 1.0], [g.a, 3.0]]) @ np.array([1.0, g.F])", "np.outer(x, x)", "x @ x", "np.dot(x, x)",
    "np.where(x > g.F, x, g.a)", "np.select([x > 3 * g.a, x > g.a], [x, g.F], 0.0)",
    "np.piecewise(x, [x < g.F, x >= g.F], [lambda v: v**2, lambda v: 2 * v])",
    "np.clip(x, g.a, g.F)", "np.round(x, 2)", "np.floor(x)", "np.ceil(x)", "np.trunc(-x)", "x // g.a", "x % g.a",
    "np.polyval([g.F, 2.0, g.a], x)", "np.repeat(x, 2)", "np.tile(x, 2)", "np.roll(x, 1)", "x[::-1]", "x[1:3]",
    "np.nanmax(np.where(x > g.F, x, np.nan))", "np.nansum(np.where(x > g.F, x, np.nan))", "np.nanmean(x)",
    "np.mean(x)", "np.std(x)", "np.var(x, ddof=1)", "np.median(x)", "np.ptp(x)", "np.prod(x)", "np.percentile(x, 30)",
    "np.average(x, weights=x**2)", "np.max(x) - np.min(x)", "max(g.F, g.a, 1.0)", "min([g.F, g.a])", "sum(x)",
    "np.count_nonzero(x > g.F)", "np.any(x > g.F) * 1.0", "np.heaviside(x - g.F, 1)", "np.sign(g.F - x)",
    "np.hypot(x, g.a)", "np.exp(-x) * sin(g.a) + math.atan2(g.F, g.a)", "sqrt(g.F) + hypot(g.F, g.a)",
    "np.sinh(g.a) + np.tanh(g.F) + np.log10(g.F) + np.expm1(g.a) + np.log1p(g.a) + np.cbrt(-g.F)",
    "np.exp(1j * x) * g.F", "np.sqrt(g.F + 1j * x)", "abs(g.F + 1j * x)", "np.angle(g.a + 1j * x)", "(g.F + 1j * x)**3",
    "np.sin(g.F + 1j * g.a)", "np.log(g.F + 1j * x)", "g.a if g.F > 2.6 else 3 * g.a", "(1.0, 2, 4, 8)[g.k] * g.F",
    "[3.0, g.F, g.a, 1.0][g.k]", "{0: 1.0, 2: 5.0, 3: g.F}[g.k]", "np.array([3.0, 4.0, 5.0, 6.0])[g.k] * g.F", "x[g.k]",
    "float(g.F) * int(g.a * 10)", "round(g.F, 1)", "np.concatenate([x, [g.F], x[:2]])", "np.stack([x, x**2])[1]",
    "2 * np.column_stack([x, x])[:, 1]", "np.array([F * g.a for F in (1.0, g.F, 3.0)])", "np.sum([F**2 for F in x])",
    "np.einsum('i,i', [1.0, 2.0], [3.0, 4.0]) * g.F", "np.vstack([x, x]).sum(axis=0)", "np.meshgrid(x, [1.0, g.F])[1]",
    "np.searchsorted([1.0, 2.0, 3.0], x)", "np.maximum.accumulate(np.sin(x))", "np.add.reduce(x)", "x.max() + x.mean()",
    "np.flip(x).reshape(-1, 1)[:, 0]", "np.isclose(x, g.F) * 1.0", "1 * (1 < g.F < 2.6)",
    "1 * (g.F > 2 and not g.a > 1)", "1.0 if g.F > 3 or g.a > 1 else g.F",
    "np.full(3, g.F)", "np.ones_like(x) * g.F", "np.radians(g.F) + np.degrees(g.a)", "x.T + x.real + x.imag",
]  # fmt: skip
OTHER = [{"F": 3.25}, {"F": 1.75, "a": 1.5}, {"a": 0.2, "k": 3}]


@pytest.mark.parametrize("expression", FOLLOWED)
def test_a_line_is_followed(expression: str, tmp_path: Path) -> None:
    sheet = own(tmp_path, f"y = {expression}  # [-] line")
    _, recording = recorded(sheet)
    assert not recording.gaps and not [guard for guard in recording.guards.values() if not guard.rows]
    for given in ({}, *OTHER):
        own_value = np.asarray(cells.evaluate(sheet.path, ["y"], **given)["y"])
        value = value_of(recording, "y", given)
        assert value.shape == own_value.shape
        np.testing.assert_allclose(value, own_value + 0, rtol=1e-12, atol=1e-13)


GUARDED = [  # what the numbers are decides about lengths and ways: other numbers of the same kind are followed
    ("x[x > 2]", {"F": 2.55}, {"F": 4.0}),
    ("np.sort(x * np.cos(3 * x))[np.flatnonzero(x > 2)]", {"F": 2.55}, {"F": 4.0}),
    ("[1, 2, 3][int(g.F)] * g.a", {"a": 1.2}, None),
    ("np.arange(int(3.7 * g.a)) + g.F", {"F": 1.0}, None),
    ('{"2": 3.0, "3": 4.0}[f"{g.k}"] * g.F', {"F": 3.0}, {"k": 3}),
]


@pytest.mark.parametrize(("expression", "same", "other"), GUARDED)
def test_what_python_saw_is_guarded(expression: str, same: dict[str, Any], other: Any, tmp_path: Path) -> None:
    sheet = own(tmp_path, f"y = {expression}  # [-] line")
    _, recording = recorded(sheet)
    assert not recording.gaps
    expected = cells.evaluate(sheet.path, ["y"], **same)["y"]
    np.testing.assert_allclose(value_of(recording, "y", same), expected, rtol=1e-12)
    if other:
        assert np.isnan(value_of(recording, "y", other)).all()


def test_a_way_that_a_loop_took_is_guarded(tmp_path: Path) -> None:
    """Iterations to convergence: the steps of the present numbers, while their verdicts are the same."""
    lines = "y = 1.0\nwhile abs(y * y - g.F) > 1e-9:\n    y = (y + g.F / y) / 2\nz = y * 1  # [-] root"
    sheet = own(tmp_path, lines)
    _, recording = recorded(sheet)
    near, far = {"F": 2.5000001}, {"F": 400.0}
    np.testing.assert_allclose(value_of(recording, "z", near), np.sqrt(2.5000001), rtol=1e-9)
    assert np.isnan(value_of(recording, "z", far)).all()


NOT_FOLLOWED = [
    ("np.fft.fft(x).real", "fft"),
    ("np.array([np.float64(v) for v in x.tolist()])", "an array made of a quantity"),
    ("np.vectorize(math.gamma)(x)", ""),
]


@pytest.mark.parametrize(("expression", "reason"), NOT_FOLLOWED)
def test_what_is_not_followed_is_named_and_never_stale(expression: str, reason: str, tmp_path: Path) -> None:
    sheet = own(
        tmp_path, f"y = {expression}  # [-] line\nz = 2 * y + g.a  # [-] rests on it\nw = 2 * x  # [-] does not"
    )
    names, recording = recorded(sheet)
    (gap,) = recording.gaps
    line = next(n for n, text in enumerate(Path(sheet.path).read_text().splitlines(), 1) if "y = " in text)
    assert gap.names == ("y",) and gap.line == line and reason in gap.reason
    np.testing.assert_allclose(value_of(recording, "z", {}), names["z"], rtol=1e-12)
    np.testing.assert_allclose(value_of(recording, "z", {"a": 2.0}), names["z"] - 0.75 + 2, rtol=1e-12)
    assert np.isnan(value_of(recording, "z", {"F": 2.6})).all()
    np.testing.assert_allclose(value_of(recording, "w", {"F": 5.0}), 2 * names["w"], rtol=1e-12)


ONCE = [  # other numbers at each run, however they are come by
    ("from time import perf_counter", "perf_counter()"),
    ("import time as clock", "clock.time_ns() / 1e9"),
    ("import datetime", "datetime.datetime.now().timestamp()"),
    ("from datetime import date, datetime", "datetime.today().microsecond + date.today().day"),
    ("", "np.random.default_rng().normal()"),
    ("", "np.random.default_rng(seed=None).normal(size=3).sum()"),
    ("", "np.random.rand()"),
    ("from numpy.random import normal", "float(normal(size=2).sum())"),
    ("import random", "random.uniform(0, 1)"),
    ("from random import Random, SystemRandom", "Random().random() + SystemRandom().random()"),
    ("from random import SystemRandom", "SystemRandom().random()"),
    ("", "np.random.Generator(np.random.PCG64()).normal()"),
    ("def elapsed():\n    import time\n    return time.monotonic()", "elapsed()"),
]


@pytest.mark.parametrize(("before", "expression"), ONCE)
def test_the_clock_and_chance_are_never_recorded(before: str, expression: str, tmp_path: Path) -> None:
    """Nothing rests on such a number, or a formula would hold it: the ways taken for it are no guards."""
    lines = f"""
{before}
y = {expression}  # [-] of this run
z = 2 * x if y + 1 > g.a * g.F else 3 * x  # [-] rests on it
w = 2 * x  # [-] does not
v = y * x  # [μs] too
table_2 = table("2", "Of this run", v, z)
"""
    sheet = own(tmp_path, re.sub(r"\n+", "\n", lines.strip()))
    names, recording = recorded(sheet)
    (gap,) = recording.gaps
    assert gap.names == ("y",) and "at each run" in gap.reason
    of_two = (recording, record({**names, "__file__": sheet.path}))
    first, second = ([(n.op, n.value.tolist()) for n in made.graph.nodes.values()] for made in of_two)
    assert repr(first) == repr(second)
    for name in ("y", "v", "z"):
        np.testing.assert_allclose(value_of(recording, name, {}), names[name], rtol=1e-15)
    for name in ("v", "z"):
        assert np.isnan(value_of(recording, name, {"F": 2.0})).all()
    assert "2" not in recording.tables, "its numbers stand in the workbook for these inputs alone"
    np.testing.assert_allclose(value_of(recording, "w", {"F": 5.0}), 2 * names["w"], rtol=1e-12)


@pytest.mark.parametrize("seeded", ["np.random.default_rng([7, 8]).normal(size=5)", "np.random.RandomState(7).rand(5)"])
def test_numbers_drawn_with_a_seed_are_recorded(seeded: str, tmp_path: Path) -> None:
    names, recording = recorded(own(tmp_path, f"y = {seeded} * g.F  # [-] line"))
    assert not recording.gaps
    np.testing.assert_allclose(value_of(recording, "y", {"F": 5.0}), 2 * names["y"], rtol=1e-12)


def test_numbers_that_the_cells_do_not_give_again_are_the_worksheet_s_own(tmp_path: Path) -> None:
    """A generator of all cells goes on where the worksheet's own run has left it."""
    sheet = own(tmp_path, "y = drawn.normal(size=5)  # [-] line\nz = 2 * y  # [-] rests on it")
    path = Path(sheet.path)
    path.write_text(
        path.read_text().replace("    from numpy import", "    drawn = np.random.default_rng(7)\n    from numpy import")
    )
    names, recording = recorded(cells.load(path))
    assert [gap.names for gap in recording.gaps] == [("y",)]
    np.testing.assert_array_equal(value_of(recording, "z", {}), names["z"])


def test_a_list_that_is_filled_and_an_array_whose_elements_are_set(tmp_path: Path) -> None:
    lines = """
rows = []
v = np.zeros(3)
for i in range(3):
    rows.append(g.F * i)
    v[i] = g.a + i
v[1] += g.F
y = np.array(rows) + v  # [-] line
"""
    sheet = own(tmp_path, lines.strip())
    _, recording = recorded(sheet)
    assert not recording.gaps
    expected = cells.evaluate(sheet.path, ["y"], F=4.0, a=0.5)["y"]
    np.testing.assert_allclose(value_of(recording, "y", {"F": 4.0, "a": 0.5}), expected, rtol=1e-12)


def test_recording_leaves_the_worksheet_alone(tmp_path: Path) -> None:
    """Pages that are served at the same time share the modules and the cells of a worksheet."""
    sheet = own(tmp_path, "y = interp(x, [0.0, 9.0], [1.0, g.F])  # [-] line")
    before = dict(sheet.common)
    recorded(sheet)
    assert all(sheet.common[name] is value for name, value in before.items())
    assert not isinstance(cells.evaluate(sheet.path, ["y"])["y"], Quantity)


@pytest.mark.parametrize(
    "lines",
    [
        "y = np.random.default_rng(g.k).normal(size=3)  # [-] plain numbers that rest on an input",
        "k = 3.0\nif g.F > 2:\n    k = 5.0\ny = np.arange(3.0) + k  # [-] plain numbers that rest on a way taken",
    ],
)
def test_plain_numbers_that_rest_on_what_python_saw_are_never_stale(lines: str, tmp_path: Path) -> None:
    sheet = own(tmp_path, f'{lines}\ntable_2 = table("2", "Plain", y)')
    names, recording = recorded(sheet)
    (column,) = recording.tables["2"]
    assert column is not None
    known = numbers([column.re], {recording.inputs["k"]: 3, recording.inputs["F"]: 1.0})
    assert np.isnan(known[column.re]).all()
    np.testing.assert_array_equal(numbers([column.re], {})[column.re], names["y"])


def test_what_is_not_followed_rests_on_the_way_that_was_taken_too(tmp_path: Path) -> None:
    lines = "c = 3.0\nif g.a > 0.5:\n    c = 5.0\ny = np.fft.fft(x * c).real  # [-] line"
    _, recording = recorded(own(tmp_path, lines))
    assert len(recording.gaps) == 1
    assert np.isnan(value_of(recording, "y", {"a": 0.2})).all()
    assert np.isfinite(value_of(recording, "y", {"k": 3})).all()
