"""Worksheets of one's own are recorded: what numpy and Python do in them is followed, or said not to be."""

from __future__ import annotations

import re
from functools import cache
from io import BytesIO
from itertools import chain
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from by_cells import by_cells
from openpyxl import load_workbook
from own_worksheet import OTHER, own, recorded, value_of

from mechsheet import evaluate, units
from mechsheet.quantities import graph
from mechsheet.quantities.lines import Recording
from mechsheet.quantities.quantity import Quantity
from mechsheet.readers.numbers import numbers
from mechsheet.recording import positions
from mechsheet.recording.dimensions import dimensions
from mechsheet.recording.record import record
from mechsheet.run import report
from mechsheet.worksheet import cells
from mechsheet.worksheet.lines import registry

ROOT = Path(__file__).resolve().parents[1]
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
    "((g.F + 1j * x).conjugate() * (x + 1j)).conj()", "np.array([[g.F, 1.0], [g.a, 3.0]]).flatten('F')",
    "x.take([0, 2])",
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
    "np.tanh(1e3 * (x - g.F / 2))", "np.tanh(x - g.F / 2)", "np.tanh(g.F + 1j * g.a)",
    "np.exp(1j * x) * g.F", "np.sqrt(g.F + 1j * x)", "abs(g.F + 1j * x)", "np.angle(g.a + 1j * x)", "(g.F + 1j * x)**3",
    "np.sin(g.F + 1j * g.a)", "np.log(g.F + 1j * x)", "g.a if g.F > 2.6 else 3 * g.a", "(1.0, 2, 4, 8)[g.k] * g.F",
    "[3.0, g.F, g.a, 1.0][g.k]", "{0: 1.0, 2: 5.0, 3: g.F}[g.k]", "np.array([3.0, 4.0, 5.0, 6.0])[g.k] * g.F", "x[g.k]",
    "float(g.F) * int(g.a * 10)", "np.round(g.F, 1)", "np.concatenate([x, [g.F], x[:2]])", "np.stack([x, x**2])[1]",
    "2 * np.column_stack([x, x])[:, 1]", "np.array([F * g.a for F in (1.0, g.F, 3.0)])", "np.sum([F**2 for F in x])",
    "np.einsum('i,i', [1.0, 2.0], [3.0, 4.0]) * g.F", "np.vstack([x, x]).sum(axis=0)", "np.meshgrid(x, [1.0, g.F])[1]",
    "np.searchsorted([1.0, 2.0, 3.0], x)", "np.maximum.accumulate(np.sin(x))", "np.add.reduce(x)", "x.max() + x.mean()",
    "np.flip(x).reshape(-1, 1)[:, 0]", "np.isclose(x, g.F) * 1.0", "1 * (1 < g.F < 2.6)",
    "1 * (g.F > 2 and not g.a > 1)", "1.0 if g.F > 3 or g.a > 1 else g.F",
    "rrr(0.0, g.F, x + 2, 2.0, +1)",
    "np.linalg.eigvalsh(np.array([[g.F, g.a, 0.3], [g.a, 2.0, 1], [0.3, 1, g.F]]))",
    "np.linalg.eigvalsh(np.array([[g.F, 1e-9, 0], [1e-9, g.F, 0], [0, 0, g.F]]))",
    "np.linalg.eigvalsh([[g.F, 7.0], [g.a, -1.0]], UPLO='U')", "np.linalg.eigvalsh([[g.F, 7.0], [g.a, -1.0]])[0]",
    "np.histogram(x**2, bins=4)[1]", "np.histogram(x * g.a, [0, 1, 2, 9])[0] * 1.0",
    "np.histogram(x, 3, (0, g.F))[0] * g.a", "np.histogram(0 * x + g.F, 3)[0] * 1.0",
    "np.isnan((0 * (np.where(x > g.F, np.nan, x) + 1j)).imag) * 1.0",
    "np.diag(np.array([g.F, g.a, 2.0]))", "np.diag(np.array([[g.F, g.a], [1.0, 2.0]]))", "np.triu(np.outer(x, x))",
    "np.tril(np.outer(x, x), -1)", "np.logspace(0, g.a, 4)", "np.geomspace(g.a, g.F, 4)", "np.nanstd(x)",
    "np.nanvar(np.where(x > g.F, x, np.nan), ddof=1)", "np.nanvar(np.outer(x, x), axis=1)",
    "np.nanprod(np.where(x > g.F, x, np.nan))", "np.nancumsum(np.where(x > g.F, x, np.nan))",
    "np.convolve(x, [1.0, g.a])", "np.polyder([g.F, g.a, 1.0])", "np.polyint([g.F, g.a])",
    "np.polyadd([1.0, g.F, 2], [g.a, 2.0])", "np.linalg.matrix_power(np.array([[g.F, 1.0], [0.0, g.a]]), 3)",
    "np.linalg.norm(x - 1, 1)", "np.linalg.norm(-x, np.inf)", "np.linalg.norm(np.outer(x, x), axis=1)",
    "np.median(np.outer(x, -x), axis=0)", "np.average(np.outer(x, x), axis=0, weights=x**2)",
    "(x > g.F).astype(int) * 2", "np.full(3, g.F)",
    "np.cov(x, x**2)", "np.cov(np.column_stack([x, x**2]), rowvar=False, ddof=0)", "np.corrcoef(x, np.sin(x))",
    "np.cov(x, bias=True)", "np.kron([1.0, g.F], [g.a, 2.0])", "np.kron([[1.0, g.F], [0, 1]], [[g.a, 2], [1, 3]])[2]",
    "np.sinc(x - g.F)", "np.sinc(x - x[2])", "np.linalg.inv([[g.F, 1.0], [g.a, 3.0]])[1]",
    "np.quantile(x, g.a / 2, axis=0)",
    "np.percentile(np.outer(x, [1.0, g.F]), 30, axis=0)", "np.digitize(x, [3.0, 2.0, 1.0], right=True) * g.a",
    "np.einsum('ii', [[1.0, g.F], [g.a, 2.0]])", "np.einsum('ii->i', [[1.0, g.F], [g.a, 2.0]])",
    "np.gradient(x**2, x**1.5, edge_order=2)", "np.gradient(np.outer(x, [1.0, g.F]), g.a, axis=0)[:, 1]",
    "np.linalg.norm([g.F, -g.a, 1.0], 3)", "np.linalg.norm([g.F, -g.a, 0], 0)", "np.linalg.norm(x, -np.inf)",
    "np.linalg.norm([[g.F, -3.0], [g.a, 2]], np.inf)", "np.linalg.norm(np.outer(x, x), axis=1, keepdims=True)[:, 0]",
    "np.convolve(x, [1.0, g.F], mode='same')", "np.convolve(x, [1.0, g.F], mode='valid')", "np.cumulative_sum(x)",
    "np.polymul([g.F, 1.0], [g.a, 2.0])", "np.polysub([1.0, g.F, 2], [g.a, 2.0])", "np.fmod(-x, g.a + 0.01)",
    "np.modf(-x)[0] + np.divmod(x, g.a + 0.01)[0]", "np.logaddexp(x, g.F)", "np.subtract.outer(x, [1.0, g.F])[:, 1]",
    "np.linalg.multi_dot([[[1.0, g.F]], [[g.a, 2.0], [1.0, 3.0]], [1.0, g.F]])",
    "np.abs(np.fft.rfft([g.F, g.a, 1.0, -g.F, 0.3]))", "np.fft.fft([g.F, 1j * g.a, 1.0]).imag",
    "np.fft.irfft([g.F, g.a + 1j * g.F, 1.0]) + np.fft.ifft([g.F, 2 * g.a, 1.0, 0]).real",
    "np.ones_like(x) * g.F", "np.radians(g.F) + np.degrees(g.a)", "x.T + x.real + x.imag",
]  # fmt: skip


@pytest.mark.parametrize("inside", [False, True], ids=["", "imports inside"])
def test_every_line_is_followed(inside: bool, tmp_path: Path) -> None:
    """All of them in one worksheet, whose recording takes no longer for many: what is wrong is told of each."""
    names = {f"y{n}_": expression for n, expression in enumerate(FOLLOWED)}
    sheet = own(tmp_path, "\n".join(f"{name} = {line}  # [-] line" for name, line in names.items()), inside)
    _, recording = recorded(sheet)
    text = Path(sheet.path).read_text().splitlines()
    seen = [*recording.gaps, *(guard for guard in recording.guards.values() if not guard.rows)]
    assert [(text[told.line - 1].strip(), told) for told in seen] == []
    parts = {name: tuple(recording.values[name].parts) for name in names}
    wrong = []
    for given in ({}, *OTHER):
        expected, again = by_cells(sheet.path, [*names], **given), evaluate(sheet.path, names, **given)
        known = numbers(chain(*parts.values()), {recording.inputs[key]: float(x) for key, x in given.items()})
        for name, expression in names.items():
            value = sum(known[part] * unit for part, unit in zip(parts[name], (1, 1j), strict=False))
            for found in (value, again[name]):
                alike = np.shape(found) == np.shape(expected[name])
                if not alike or not np.allclose(found, expected[name], rtol=1e-12, atol=1e-13, equal_nan=True):
                    wrong.append((expression, given, found, expected[name]))
    assert wrong == []


@pytest.mark.parametrize(
    "lines",
    [
        "import numpy.linalg as la\ny = la.norm(x)",
        "from numpy import linalg\ny = linalg.norm(x)",
        "import math as m, numpy\ny = numpy.cos(x) * m.hypot(g.F, 1)",
        "import mechsheet\ny = mechsheet.rrr(0.0, g.F, x + 2, 2.0, +1)",
        "from mechsheet.mechanics import rrr as dyads\ny = dyads.rrr(0.0, g.F, x + 2, 2.0, +1)",
        "def f(v):\n    from math import hypot, sqrt as root\n    return root(hypot(v, g.a))\ny = f(g.F)",
        "if True:\n    from math import exp as grow\ny = grow(g.F)",
        "def balance(x):\n    return 2 * x\ny = balance(x)",
        "from scipy.integrate import simpson\ny = simpson(np.outer([1.0, g.F], x**3), x=x**1.5, axis=1)[1]",
        "from scipy import integrate\ny = integrate.simpson(x[:4]**3, x=x[:4]) + integrate.trapezoid(x**2, dx=g.a)",
        "import scipy.linalg as la\ny = la.solve([[g.F, 1.0], [g.a, 3.0]], [1.0, 2.0])",
    ],
)
def test_what_is_imported_or_defined_under_any_name_is_followed(lines: str, tmp_path: Path) -> None:
    sheet = own(tmp_path, lines)
    _, recording = recorded(sheet)
    assert not recording.gaps and not [guard for guard in recording.guards.values() if not guard.rows]
    for given in OTHER:
        own_value = by_cells(sheet.path, ["y"], **given)["y"]
        np.testing.assert_allclose(value_of(recording, "y", given), own_value, rtol=1e-12, atol=1e-13)


@pytest.mark.parametrize(
    "lines",
    [
        'from mechsheet import check as proved, table as listed\nok = proved("ok", g.F, 9.0), listed("2", "Two", x)',
        'import mechsheet as ms\nok = ms.check("ok", g.F, 9.0), ms.table("2", "Two", x)',
        'from mechsheet.worksheet.check import check as own_check\nlisted = table\nok = own_check("ok", g.F, 9.0)\n'
        'two = listed("2", "Two", x)',
    ],
)
def test_what_shows_is_known_under_any_name(lines: str, tmp_path: Path) -> None:
    _, recording = recorded(own(tmp_path, lines))
    assert not recording.gaps and recording.checks.keys() == {"ok"} and recording.tables.keys() == {"1", "2"}


WAYS = [
    "if g.F > 3:\n    y = x\nelse:\n    y = x**2",
    "y = x\nif not g.F > 3:\n    y = y * g.a",
    "y = 0.0\nif g.F > 2 and g.a < 1:\n    y += g.F",
    "y = g.a\nif g.k == 2:\n    y, z = 2 * y, 1\nelif g.k == 3:\n    y = 5.0\nelse:\n    z: float = 7.0",
    "if g.F > 3:\n    y = np.sqrt(g.F - 3)\nelse:\n    y = g.a",
    "y = 0.0\nfor v in x:\n    if v > 2:\n        y = y + v * g.a",
    "y = 0.0\nfor v in x:\n    if v > 2:\n        w = v\n        if w > 3:\n            w = 2.0\n        y = y + w",
    "if np.any(x > 6):\n    y = g.F + 1j * g.a\nelse:\n    y = g.a",
    "def f(v):\n    if v > 3:\n        return 2 * v\n    return v**2\ny = f(g.F) * 1.0",
    "def f(v):\n    w = 2.0\n    if v > 3:\n        w += v\n    else:\n        w -= v\n    return w\ny = f(g.F) * 1.0",
    (
        "def f(v, w):\n    if v < 2:\n        return v, w\n    elif v < 3:\n        v = v + 1\n        return w, v\n"
        "    w = w * v\n    if w > 1:\n        return w, w\n    return 0.0, w\nA, B = f(g.F, g.a)\ny = A + 2 * B"
    ),
    "def f(n):\n    return 1 if n <= 1 else n * f(n - 1)\ny = (f(3) if g.F > 3 else f(2)) * g.a",
]


@pytest.mark.parametrize("lines", WAYS)
def test_ways_that_only_bind_names_or_end_a_function_are_a_choice(lines: str, tmp_path: Path) -> None:
    sheet = own(tmp_path, f"{lines}\nresult = y * 1  # [-] line")
    _, recording = recorded(sheet)
    assert not recording.gaps and not [guard for guard in recording.guards.values() if not guard.rows]
    for given in ({}, *OTHER, {"F": 4.0, "a": 1.5}):
        expected = by_cells(sheet.path, ["result"], **given)["result"]
        value = value_of(recording, "result", given)
        assert np.shape(value) == np.shape(expected)
        np.testing.assert_allclose(value, expected, rtol=1e-12, atol=1e-13)


@pytest.mark.parametrize(
    "lines",
    [
        "rows = []\nif g.F > 3:\n    rows.append(1.0)\ny = g.a + len(rows)",
        "def f(v):\n    if v > 3:\n        raise ValueError('too much')\n    return v\ny = f(g.F)",
        "if g.F > 3:\n    y = [g.a, g.F, 1.0]\nelse:\n    y = [g.a, g.F]\ny = sum(y)",
        "if g.F > 3:\n    y = x[:2]\nelse:\n    y = x\ny = y.sum()",
        "kind = 'low'\nif g.F > 3:\n    kind = 'high'\ny = {'low': g.a, 'high': 1.0}[kind.lower()]",
        "if g.F > 3:\n    ok = check('one', g.F, 9.0)\nelse:\n    ok = check('other', g.F, 9.0)\n"
        "y = g.a if g.F < 3 else [][0]",
        "def f(v):\n    return 0.0 if v < 0.5 else f(v - 1)\ny = g.a + f(g.F * 8)",
    ],
)
def test_ways_that_change_something_or_cannot_be_gone_are_guards(lines: str, tmp_path: Path) -> None:
    sheet = own(tmp_path, f"from mechsheet import check\n{lines}\nresult = y * 1  # [-] line")
    _, recording = recorded(sheet)
    assert not recording.gaps and [guard for guard in recording.guards.values() if not guard.rows]
    assert "one" not in recording.checks
    same, other = {"F": 2.51, "a": 1.25}, {"F": 4.0}
    expected = by_cells(sheet.path, ["result"], **same)["result"]
    (node,) = [node for node, name in recording.names.items() if name == "result"]
    known = numbers([node, *recording.guards], {recording.inputs[name]: x for name, x in same.items()})
    np.testing.assert_allclose(known[node], expected, rtol=1e-12)
    assert all(known[guard].all() for guard in recording.guards)
    changed = numbers([node, *recording.guards], {recording.inputs[name]: x for name, x in other.items()})
    assert np.isnan(changed[node]).all() or not all(changed[guard].all() for guard in recording.guards)


def test_what_stands_behind_an_integral_over_all_positions_is_recorded_too(tmp_path: Path) -> None:
    """The cell is run once more for the integral, which leaves alone what the cell shows."""
    sheet = own(
        tmp_path, 'from mechsheet import check\nW = np.trapezoid(x**2, x)  # [-] work\nok = check("ok", W, 99.0)'
    )
    Path(sheet.path).write_text(Path(sheet.path).read_text().replace('"All", x)', '"All", x, every=2)'))
    sheet = cells.read(Path(sheet.path))
    _, recording = recorded(sheet)
    assert not recording.gaps and recording.checks.keys() == {"ok"} and recording.tables.keys() == {"1"}
    expected = by_cells(sheet.path, ["W"], F=4.0)["W"]
    np.testing.assert_allclose(value_of(recording, "W", {"F": 4.0}), expected, rtol=1e-12)


def test_what_grows_over_all_positions_is_recorded_where_tables_list_some(tmp_path: Path) -> None:
    lines = """from scipy.integrate import cumulative_trapezoid
W = cumulative_trapezoid(x**2, x, initial=0)  # [-] work so far
off = W - (W.max() + W.min()) / 2  # [-] from its middle
table_2 = table("2", "Work", x, off, every=2)"""
    sheet = own(tmp_path, lines)
    Path(sheet.path).write_text(Path(sheet.path).read_text().replace('"All", x)', '"All", x, every=2)'))
    sheet = cells.read(Path(sheet.path))
    _, recording = recorded(sheet)
    assert not recording.gaps
    other = by_cells(sheet.path, ["off"], F=4.0)["off"]
    np.testing.assert_allclose(value_of(recording, "off", {"F": 4.0}), other[::2], rtol=1e-12)


def test_a_greatest_number_at_a_listed_position_is_followed_to_others(tmp_path: Path) -> None:
    """It is at the third of five positions, which is listed, and for the other inputs at the fourth, which is not."""
    sheet = own(tmp_path, "y = x * (2.2 * g.a * g.F - x)  # [-] arch\nmost = y.max()  # [-] greatest")
    Path(sheet.path).write_text(Path(sheet.path).read_text().replace('"All", x)', '"All", x, every=2)'))
    sheet = cells.read(Path(sheet.path))
    names, recording = recorded(sheet)
    other = by_cells(sheet.path, ["most", "y"], a=1.3)
    assert names["y"].argmax() == 2 and other["y"].argmax() == 3
    assert value_of(recording, "most", {"a": 1.3}) == pytest.approx(other["most"], rel=1e-12)


def test_a_check_looks_at_all_positions_where_tables_list_some(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The limit is passed at the fourth of five positions alone, which no table lists; what takes more is told."""
    monkeypatch.setattr(positions, "_MORE", 400)
    lines = """from mechsheet import check
y = x * (2.2 * g.a * g.F - x)  # [-] arch
within = check("within", y, 1.6 * g.F), check("least", y.min(), 1.0)
more = check("sum", sum(cos(k * x) for k in range(40)), 99.0)
scaled = check("scaled", y - y.max(), 1e-9, of=y)"""
    sheet = own(tmp_path, lines)
    Path(sheet.path).write_text(Path(sheet.path).read_text().replace('"All", x)', '"All", x, every=2)'))
    sheet = cells.read(Path(sheet.path))
    names, recording = recorded(sheet)
    assert not recording.gaps
    assert {name: check.where for name, check in recording.checks.items()} == {
        "within": "", "least": "", "sum": "at the listed positions", "scaled": ""
    }  # fmt: skip
    for given in ({}, {"a": 1.3}, {"F": 4.0, "a": 1.1}):
        own_checks = by_cells(sheet.path, ["within", "scaled"], **given)
        for check in (*own_checks["within"], own_checks["scaled"]):
            held = recording.checks[check.name]
            known = numbers([*held.parts, held.limit], {recording.inputs[k]: x for k, x in given.items()})
            assert max(np.max(known[p]) for p in held.parts) == pytest.approx(check.residual, rel=1e-12)
            assert known[held.limit] == pytest.approx(check.limit, rel=1e-12)
    book = load_workbook(BytesIO(report.workbook("", {**names, "__file__": sheet.path}, {})))
    said = [row[0].value for row in book["Checks"].iter_rows(min_row=4)]
    assert said[:4] == ["within", "least", "sum, at the listed positions", "scaled"]


@pytest.mark.parametrize(
    "expression",
    [
        "cos(g.F / 5 * math.pi + 3 * g.a - 3 * g.a)",
        "sin(x[-1] * math.pi / g.F - 2 * math.pi + 100 * g.a - 100 * g.a)",
        "np.tan(7 * g.a - 7 * g.a + 1e-17)",
        "np.arctan2(g.F * (x[-1] - 2 * g.F) + 3 * g.a - 3 * g.a, 1.0)",
        "np.log(1.0 + 30 * g.a - 30 * g.a)",
        "cos(x * 0 + math.pi / 2 + 40 * g.a - 40 * g.a).max()",
    ],
)
@pytest.mark.parametrize("a", [0.75, 0.3517, 0.6289])
def test_what_is_nothing_but_rounding_is_recorded_however_it_is_computed(
    expression: str, a: float, tmp_path: Path
) -> None:
    """The recorded sum is rounded in another order than the worksheet's."""
    sheet = own(tmp_path, f"y = {expression}  # [-] rounding")
    names = sheet.run(sheet.results, {"g": sheet.inputs(a=a)})
    names["y"] = names["y"] + 100 * a * 2e-16  # as another order of the same terms leaves
    assert not record({**names, "__file__": sheet.path}).gaps
    names["y"] += 1e-9
    assert record({**names, "__file__": sheet.path}).gaps


@pytest.mark.parametrize(
    "expression",
    [
        "g.F / (g.a - 0.5)",
        "(g.a - 0.5) ** -2",
        "math.log(g.a - 0.5)",
        "math.exp(2000 * g.a)",
        "(100 * g.a) ** (300 * g.a)",
    ],
)
def test_what_python_refuses_of_single_numbers_is_no_number(expression: str, tmp_path: Path) -> None:
    sheet = own(tmp_path, f"y = {expression}  # [-] line\nz = 1 / (1 + y)  # [-] rests on it")
    given = {"a": 0.5}
    with pytest.raises((ArithmeticError, ValueError)):
        by_cells(sheet.path, ["y"], **(given if "g.a - " in expression else {"a": 2.0}))
    _, recording = recorded(sheet, a=0.75 if "g.a - " in expression else 0.1)
    assert not recording.gaps
    there = given if "g.a - " in expression else {"a": 2.0}
    assert np.isnan(value_of(recording, "y", there)) and np.isnan(value_of(recording, "z", there))


@pytest.mark.parametrize(
    "expression", ["x.max() / (g.a - 0.5)", "-x[1] / (g.a - 0.5)", "(x - x).sum() + x[1] / (g.a - 0.5)"]
)
@pytest.mark.filterwarnings("ignore")
def test_a_number_of_numpy_may_be_infinite(expression: str, tmp_path: Path) -> None:
    sheet = own(tmp_path, f"y = {expression}  # [-] line")
    _, recording = recorded(sheet)
    assert value_of(recording, "y", {"a": 0.5}) == by_cells(sheet.path, ["y"], a=0.5)["y"]


@pytest.mark.parametrize(
    ("expression", "out_of_order"),
    [
        ("np.interp(g.F, [0.0, g.a, 2.0, 4.0], [1.0, g.F, 7.0, 8.0])", {"a": 2.5}),
        ("np.interp(g.a, x, x**2)", {"F": -1.0}),
        ("np.interp(x, [0.0, g.a, g.a], [1.0, 2.0, g.F], right=9.0)", {"a": -0.5}),
        ("np.searchsorted([0.0, g.a, 2.0], x) * 1.0", {"a": 2.5}),
        ("np.digitize(x, [0.0, g.a, 2.0]) * 1.0", {"a": 2.5}),
    ],
)
def test_what_numpy_finds_among_ordered_numbers_is_followed_while_they_are(
    expression: str, out_of_order: dict[str, float], tmp_path: Path
) -> None:
    sheet = own(tmp_path, f"y = {expression}  # [-] line")
    _, recording = recorded(sheet)
    assert not recording.gaps
    for given in ({}, {"a": 0.2}, {"F": 1.0}, {"n": 8}, {"a": 2.0}, {"F": 0.5, "a": 0.0}):
        expected = by_cells(sheet.path, ["y"], **given)["y"]
        np.testing.assert_allclose(value_of(recording, "y", given), expected, rtol=1e-12, err_msg=str(given))
    inputs = {recording.inputs[name]: x for name, x in out_of_order.items()}
    known = numbers(recording.guards, inputs)
    assert np.isnan(value_of(recording, "y", out_of_order)).all()
    assert not all(known[holds] for holds in recording.guards)


def test_among_numbers_that_are_not_in_order_nothing_is_followed(tmp_path: Path) -> None:
    _, recording = recorded(own(tmp_path, "y = np.interp(g.a, [2.0, g.F, 1.0], [1.0, 2.0, 3.0])  # [-] line"))
    assert "not in order" in recording.gaps[0].reason and np.isnan(value_of(recording, "y", {"F": 3.0}))


ARRAYS = {
    "fit": "np.polyfit(x, np.sin(x) + g.a, 3)",
    "line": "np.polyfit([0.0, 1.0, 2.0, 4.0], [g.F, 1.0, g.a, 2.0], 1, w=[1.0, g.F, 2.0, 1.0])",
    "curve": "np.polyval(np.polyfit([1.0, 2.0, 3.0], [g.F, g.a, 2.0], 2), x)",
    "least": "np.linalg.lstsq(np.array([[1.0, g.a], [g.F, 2.0], [1.0, 5.0]]), np.array([1.0, g.F, 2.0]))[0]",
    "several": "np.linalg.lstsq(np.stack([x, x**2], 1), np.stack([g.a * x + 1, np.cos(x)], 1))[0].reshape(-1)",
    "left": "np.linalg.lstsq(np.stack([x, x**2], 1), np.cos(x))[1]",
    "order": "np.argsort(np.sin(3 * x) * g.a) * 1.0",
    "ordered": "np.array([1.0, 2.0, 3.0])[np.argsort([g.F, g.a, 1.5])]",
    "equal": "np.argsort([g.F, g.a, g.F, g.a, 1.0], kind='stable') * 1.0",
    "rows": "np.array([[g.F, 1.0], [g.a, 2.0], [1.5, 3.0]])[np.array([g.F, g.a, 1.5]).argsort()][:, 1]",
    "columns": "np.argsort([[g.F, 1.0], [g.a, 2.0], [1.5, 0.5]], axis=0).reshape(-1) * 1.0",
    "cross": "np.cross([g.F, 1.0, g.a], [1.0, 2.0, g.F])",
    "crosses": "np.cross(np.stack([x, x**2, 1 + 0 * x], 1), [1.0, g.a, g.F]).reshape(-1)",
    "unwrap": "np.unwrap(np.angle(np.exp(3j * x))) * g.a",
    "degrees": "np.unwrap(np.mod(200 * x * g.a, 360), period=360)",
    "product": "np.einsum('ij,jk->ik', [[g.F, 1.0], [g.a, 2.0]], [[1.0, g.a], [3.0, g.F]]).reshape(-1)",
    "sums": "np.einsum('ij,j', np.array([[g.F, 1.0], [g.a, 2.0]]), np.array([1.0, g.a]))",
    "outer": "np.einsum('i,j->ji', x, np.array([1.0, g.a])).reshape(-1)",
}


@pytest.mark.parametrize("expression", ARRAYS.values(), ids=ARRAYS)
def test_functions_of_arrays_are_followed_to_other_inputs(expression: str, tmp_path: Path) -> None:
    _, recording = recorded(sheet := own(tmp_path, f"y = {expression}  # [-] line"))
    assert not recording.gaps and not [guard for guard in recording.guards.values() if not guard.rows]
    for given in ({}, *OTHER, {"F": 1.125, "a": -0.5}):
        expected = by_cells(sheet.path, ["y"], **given)["y"]
        np.testing.assert_allclose(value_of(recording, "y", given), expected, rtol=1e-9, atol=1e-12)


@pytest.mark.parametrize("line", ["np.quantile(x, [0.1, g.a / 2])", "x * np.percentile(x**2, 50 * g.a)"])
def test_a_quantile_beyond_the_least_and_greatest_is_none(line: str, tmp_path: Path) -> None:
    """numpy refuses it: pages and cells had a number where the worksheet has none."""
    _, recording = recorded(sheet := own(tmp_path, f"y = {line}  # [-] line"))
    for given in ({}, {"a": 2.0}, {"a": 0.0}):
        expected = by_cells(sheet.path, ["y"], **given)["y"]
        np.testing.assert_allclose(value_of(recording, "y", given), expected, rtol=1e-12)
    for given in ({"a": 2.125}, {"a": -0.125}):
        assert np.isnan(value_of(recording, "y", given)).all()


@pytest.mark.parametrize("some", ["g.F, 1.0, 2.0, 3.0, g.a, 5.0, 6.0", "g.F, 1.0, g.a, 1.0, 1.0, 1.0, 0.5"])
def test_an_order_of_equal_numbers_is_that_of_the_run_or_none(some: str, tmp_path: Path) -> None:
    """numpy sorts by what the processor has: which of equal numbers is first was another one on a page and in cells."""
    _, recording = recorded(sheet := own(tmp_path, f"y = g.F * np.argsort([{some}])  # [-] line"))
    assert not recording.gaps
    shown = 0
    for given in ({}, {"F": 2.0}, {"F": 5.0}, {"F": 1.0, "a": 1.0}, {"F": 6.0, "a": 6.0}, {"F": 1.25, "a": 0.25}):
        found = value_of(recording, "y", given)
        if np.isnan(found).all():
            assert recording.guards
        else:
            shown += 1
            np.testing.assert_allclose(found, by_cells(sheet.path, ["y"], **given)["y"], rtol=1e-12)
    assert shown > 1


@pytest.mark.parametrize("count", [8, 70])
@pytest.mark.parametrize("kind", ["None", "'stable'"])
def test_columns_are_ordered_however_many_numbers_they_have(count: int, kind: str, tmp_path: Path) -> None:
    """Of more than are compared each with all others, the order of columns stood in rows."""
    lines = (
        f"n = np.arange(1.0, {count + 1})\nA = np.sin(n[:, None] * (n + g.F))\nB = np.argsort(A, axis=0, kind={kind})"
    )
    _, recording = recorded(sheet := own(tmp_path, f"{lines}\ny = (B * n).reshape(-1)  # [-] line"))
    assert not recording.gaps
    np.testing.assert_allclose(value_of(recording, "y", {}), by_cells(sheet.path, ["y"])["y"], rtol=1e-12)


def test_a_fit_is_as_accurate_as_its_condition_lets_it(tmp_path: Path) -> None:
    """Of degree 7 over 40 places: the normal equations would keep no digit of it."""
    lines = "t = np.linspace(1, 3, 40)\ny = np.polyfit(t, g.F * t**7 - g.a * t**2, 7)  # [-] coefficients"
    _, recording = recorded(own(tmp_path, lines))
    assert not recording.gaps
    expected = [3.25, 0, 0, 0, 0, -0.5, 0, 0]
    np.testing.assert_allclose(value_of(recording, "y", {"F": 3.25, "a": 0.5}), expected, atol=1e-6)


def test_columns_that_rest_on_each_other_give_no_number_and_units_are_followed(tmp_path: Path) -> None:
    lines = """K = np.stack([x, x * (1 + (g.a - 0.5) * x)], axis=1)
y = np.linalg.lstsq(K, np.cos(x))[0]  # [-] unknowns
force = np.polyfit(x * m, x**2 * N, 1)[1]  # [N] at the origin
rate = np.polyfit(x * m, x**2 * N, 1)[0]  # [N/m] slope"""
    sheet = own(tmp_path, "from mechsheet.units import N, m\n" + lines)
    names, recording = recorded(sheet)
    assert not recording.gaps
    assert np.isnan(value_of(recording, "y", {"a": 0.5})).all() and np.isfinite(value_of(recording, "y", {})).all()
    assert dimensions(recording, sheet, names, registry(names)).check().passed


@pytest.mark.parametrize(
    ("expression", "reason"),
    [
        ("np.polyfit(x, x, 1, full=True)[0]", "numpy's polyfit with all that it tells"),
        ("np.linalg.lstsq(np.ones((2, 9)) * g.F, np.ones(2))[0]", "least squares of other than up to 8 unknowns"),
        ("np.einsum('...i,i', np.array([[g.F, 1.0], [g.a, 2.0]]), x[:2])", "numpy's einsum of '...i,i'"),
        ("np.linalg.eigvalsh(np.eye(4) * g.F)", "eigenvalues of a matrix of more than 3 rows"),
        ("np.linalg.norm(np.eye(2) * g.F, 2)", "numpy's norm of the order 2 of a matrix"),
        ("np.correlate(x, x)", "numpy's correlate"),
        ("np.roots([1.0, -g.F, 0.1, 2.0]).real", "numpy's roots of other than one or two"),
    ],
)
def test_functions_of_arrays_that_are_not_followed_are_named(expression: str, reason: str, tmp_path: Path) -> None:
    _, recording = recorded(own(tmp_path, f"y = {expression}  # [-] line"))
    (gap,) = recording.gaps
    assert gap.line == 37 and gap.reason.startswith(reason)


GUARDED = [  # what the numbers are decides about lengths and ways: other numbers of the same kind are followed
    ("x[x > 2]", {"F": 2.55}, {"F": 4.0}),
    ("np.sort(x * np.cos(3 * x))[np.flatnonzero(x > 2)]", {"F": 2.55}, {"F": 4.0}),
    ("[1, 2, 3][int(g.F)] * g.a", {"a": 1.2}, None),
    ("np.arange(int(3.7 * g.a)) + g.F", {"F": 1.0}, None),
    ('{"2": 3.0, "3": 4.0}[f"{g.k}"] * g.F', {"F": 3.0}, {"k": 3}),
    ("round(g.F, 1)", {"F": 3.14159}, None),
    ("round(g.F + 1.1, 1)", {"F": 3.14159}, {"F": 3.25}),  # 4.35 is a little less in binary: Python gives 4.3
]


@pytest.mark.parametrize(("expression", "same", "other"), GUARDED)
def test_what_python_saw_is_guarded(expression: str, same: dict[str, Any], other: Any, tmp_path: Path) -> None:
    sheet = own(tmp_path, f"y = {expression}  # [-] line")
    _, recording = recorded(sheet)
    assert not recording.gaps
    expected = by_cells(sheet.path, ["y"], **same)["y"]
    np.testing.assert_allclose(value_of(recording, "y", same), expected, rtol=1e-12)
    if other:
        assert np.isnan(value_of(recording, "y", other)).all()


def test_iterations_to_convergence_are_repeated(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A reader takes as many turns as its inputs need; a workbook has twice as many as now and some more."""
    monkeypatch.setattr("mechsheet.readers.numbers._TURNS", 200)
    lines = "y = 1.0\nwhile abs(y * y - g.F) > 1e-9:\n    y = (y + g.F / y) / 2\nz = y * 1  # [-] root"
    sheet = own(tmp_path, lines)
    _, recording = recorded(sheet)
    for F in (2.5, 2.5000001, 400.0):
        expected = by_cells(sheet.path, ["z"], F=F)["z"]
        assert value_of(recording, "z", {"F": F}) == pytest.approx(expected, rel=1e-14)
    assert np.isnan(value_of(recording, "z", {"F": -2.0})), "it never ends"
    (node,) = [node for node in recording.graph.nodes.values() if node.op == "iterated"]
    (turns,) = node.args[2:]
    known = {F: numbers([turns], {recording.inputs["F"]: F})[turns] for F in (2.5000001, 400.0, 1e30)}
    assert known[2.5000001] == pytest.approx(np.sqrt(2.5000001), rel=1e-9)
    assert known[400.0] == pytest.approx(20.0, rel=1e-9) and np.isnan(known[1e30])


def test_roots_of_a_parabola_come_in_the_order_of_numpy(tmp_path: Path) -> None:
    """While there are as many real ones; for others there is no number, and a guard says why."""
    real = "y = np.roots([g.a, -g.F, 1.2])  # [-] roots\nz = np.roots([1.0, 0, -g.F])[0]  # [-] first"
    _, recording = recorded(own(tmp_path, real))
    for given in ({}, {"F": 3.25}, {"a": -0.2}, {"F": -2.4}):
        own_values = by_cells(tmp_path / "own.py", ["y", "z"], **given)
        for name in ("y", "z") if given.get("F", 1) > 0 else "y":
            np.testing.assert_allclose(value_of(recording, name, given), own_values[name], rtol=1e-12)
    assert np.isnan(value_of(recording, "y", {"a": 2.0})).all() and recording.guards
    _, recording = recorded(own(tmp_path, "y = np.roots([g.a, -g.F, 9.0])  # [-] roots"))
    np.testing.assert_allclose(value_of(recording, "y", {"F": 3.0}), np.roots([0.75, -3.0, 9.0]), rtol=1e-12)


NOT_FOLLOWED = [
    ("np.fft.fft(x).real", "fft"),
    ("np.linalg.cond([[g.F, 1.0], [0.5, 3.0]])", "numpy's cond"),
    ("np.roots([1.0, g.F, 2.0, -0.5])[2].real", "whose order"),
    ("np.array([np.float64(v) for v in x.tolist()])", "an array made of a quantity"),
    ("np.vectorize(math.gamma)(x)", ""),
    ("table('9', 'F', g.F).columns[0].values[0]", "it goes on with the columns of a table"),
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


def test_what_another_package_is_handed_is_told_by_its_name(tmp_path: Path) -> None:
    """A solution that has its keys as attributes is read as in the worksheet: what rests on it is no gap of its own."""
    lines = """
from scipy.integrate import solve_ivp
from scipy.interpolate import KroghInterpolator
solution = solve_ivp(lambda t, y: -g.a * y, (0, 1), [g.F], t_eval=[0.0, 0.5, 1.0])
y = solution.y[0]  # [-] line
k = KroghInterpolator([0.0, 5.0, 9.0], [0.0, 25.0, 81.0])(g.F)  # [-] line
"""
    names, recording = recorded(own(tmp_path, lines.strip()))
    told = {gap.names: gap.reason for gap in recording.gaps}
    assert told == {("solution",): "scipy's solve_ivp", ("k",): "scipy's KroghInterpolator"}
    np.testing.assert_array_equal(value_of(recording, "y", {}), names["y"])
    assert np.isnan(value_of(recording, "y", {"F": 5.0})).all()


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
    expected = by_cells(sheet.path, ["y"], F=4.0, a=0.5)["y"]
    np.testing.assert_allclose(value_of(recording, "y", {"F": 4.0, "a": 0.5}), expected, rtol=1e-12)


def test_recording_leaves_the_worksheet_alone(tmp_path: Path) -> None:
    """Pages that are served at the same time share the modules and the cells of a worksheet."""
    sheet = own(tmp_path, "y = interp(x, [0.0, 9.0], [1.0, g.F])  # [-] line")
    before = dict(sheet.common)
    recorded(sheet)
    assert all(sheet.common[name] is value for name, value in before.items())
    assert not isinstance(evaluate(sheet.path, ["y"])["y"], Quantity)


def test_a_recording_puts_nothing_into_lists_of_the_setup(tmp_path: Path) -> None:
    """A worksheet that is run again found quantities in them, which no plain number is."""
    lines = "seen.append(g.F)\nknown['all']['F'] = g.F\nbeside[0] = g.a\ny = seen[-1] + known['all']['F']  # [-] line"
    path = Path(own(tmp_path, lines).path)
    setup = "import math\n    seen, known = [], {'all': {}}\n    beside = known['list'] = [1.0]"
    path.write_text(path.read_text().replace("import math", setup, 1))
    sheet = cells.load(path)
    _, recording = recorded(sheet)
    held = [*sheet.common["seen"], *sheet.common["known"]["all"].values(), *sheet.common["known"]["list"]]
    assert held == [1.0] and all(type(x) is float for x in held), "what they hold as a run begins"
    assert value_of(recording, "y", {"F": 4.0}) == 8.0 and not recording.gaps


@pytest.mark.parametrize(
    "lines",
    [
        "y = np.random.default_rng(g.k).normal(size=3)  # [-] plain numbers that rest on an input",
        'k = 3.0\nif g.F > 2:\n    k, kind = 5.0, {"b"}\ny = np.arange(3.0) + k  # [-] that rest on a way taken',
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


@cache
def document(name: str) -> tuple[cells.Worksheet, dict[str, Any], Recording]:
    """A worksheet of the project with its names and its recording."""
    sheet = cells.load(next((ROOT / "worksheets").rglob(f"{name}.py")))
    return sheet, *recorded(sheet)


@pytest.mark.parametrize(
    "name", ["hitch", "landing_gear", "kinetostatics", "joint", "bucket", "engine", "bolted_joint"]
)
def test_a_document_is_held_whole(name: str) -> None:
    assert not document(name)[2].gaps


def test_a_number_over_all_positions_is_followed_where_tables_list_some() -> None:
    """Works in a turn over 361 positions, of which 25 are listed; the columns of the tables stay those of 25."""
    sheet, names, recording = document("kinetostatics")
    changed = {"m4": 3.0, "l4": 0.46, "Q5": 4000.0, "eps1": 2.0}
    own = sheet.run(["W_b", "W_Q", "M_mean"], {"g": sheet.inputs(**changed)})
    for name in ("W_b", "W_Q", "M_mean"):
        assert names[name] != pytest.approx(own[name], rel=1e-4)
        assert value_of(recording, name, changed) == pytest.approx(own[name], rel=1e-12)
    assert {c.size for c in recording.tables["8.5"] if c is not None} == {25}


def test_a_loop_over_many_positions_is_given_up_before_it_takes_much_room(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Each of its numbers is a node of its own, which takes more room than a number in a field."""
    monkeypatch.setattr(graph, "_NODES", graph._NODES // 10)
    lines = """
t = np.linspace(0, 1, 3_001)  # [-] places
y = np.array([v * g.F + v**2 * g.a - np.sin(v * g.a) for v in t])  # [-] line
table_2 = table("2", "Thinned", t, y, every=1_000)
check_2 = check("greatest", np.max(y), 9.0)
"""
    sheet = own(tmp_path, "from mechsheet import check" + lines)
    names = sheet.run(sheet.results, {"g": sheet.inputs()}) | {"__file__": sheet.path}
    recording = record(names, sheet, every=1_000)
    assert len(recording.graph.nodes) < 6_000


CHECKS = """
from mechsheet import assembled, check, closed_form
xs = linspace(2.05, 6.05, 9)  # [m] distance
C = rrr(0j, xs, g.F, 3.0, +1)  # [m] pin
found = find(lambda x: x**2, 0.0, 9.0, equals=g.F, unknown="x_0")
checks_1 = (
    check("two ways", xs * g.F - g.F * xs * (1 + 1e-13), 1e-9, "mm", of=xs * g.F),
    check("by much", [g.F * xs, -g.a * xs], 30.0, "km"),
    check("a part that is an input", 1e-4 * g.F, g.a / 500, of=g.F),
    assembled("closes", C, xs, (abs(g.F - 3.0), g.F + 3.0), "x", "m"),
    closed_form(found, sqrt(g.F)),
)"""


@pytest.mark.parametrize("given", [{}, {"F": 2.25, "a": 0.5}, {"F": 0.5, "a": 0.4}, {"F": 2.0}])
def test_a_check_that_is_recorded_compares_what_the_worksheet_s_own_does(given: dict[str, Any], tmp_path: Path) -> None:
    """Residual and limit of each kind for other inputs, of a group that opens and a limit that tells nothing too."""
    sheet = own(tmp_path, CHECKS)
    _, recording = recorded(sheet)
    changed = {recording.inputs[name]: x for name, x in given.items()}
    checks = sheet.run(sheet.results, {"g": sheet.inputs(**given)})["checks_1"]
    for check in checks:
        known = recording.checks[check.name]
        now = numbers([*known.parts, known.limit], changed)
        largest, limit = max(np.max(now[part]) for part in known.parts), now[known.limit].item()
        factor = units.parse(known.unit).factor
        assert (largest <= limit) == check.passed, check
        if check.evaluated:
            assert np.allclose([largest / factor, limit / factor], [check.residual, check.limit], 1e-9, 1e-12), check
    told = "pass" if given.get("a", 0.75) <= 0.5 else "not evaluated"
    assert [check.verdict for check in checks[:3]] == ["pass", "pass", told]


def test_a_part_that_is_set_knows_nothing_of_the_other_one(tmp_path: Path) -> None:
    """An array that holds anything, NaN and infinity too, until both its parts are set; as the mechanics make some."""
    lines = """
def made():
    z = np.full(3, complex(math.nan, math.inf))
    z.real = g.F * np.arange(3.0)
    z.imag = g.a
    return z

y = made()  # [-] set"""
    sheet = own(tmp_path, lines)
    names, recording = recorded(sheet)
    assert recording.gaps == [] and np.array_equal(names["y"], 2.5 * np.arange(3.0) + 0.75j)
    now = numbers([*recording.values["y"].parts], {recording.inputs["F"]: 2.0})
    assert [now[part].tolist() for part in recording.values["y"].parts] == [[0.0, 2.0, 4.0], [0.75] * 3]


@pytest.mark.parametrize(
    ("lines", "reason"),
    [
        ("y = 'abab'.count('ab' if g.F > 3 else 'b') + g.F", "must be str, not recorded text"),
        ("y = len(('b' if g.F > 3 else 'c') * 3) + g.F", "for *: 'recorded text' and 'int'"),
        ("y = np.quantile(x, 0.3, method='lower')", "its argument 'method' is not followed"),
        ("y = np.concatenate([['a'], [g.F]]).size + g.F", "values that are no numbers"),
    ],
)
def test_the_reason_of_a_gap_names_nothing_that_users_do_not_know(lines: str, reason: str, tmp_path: Path) -> None:
    """It said Written, Quantity or what stands for a function of numpy's."""
    (gap,) = recorded(own(tmp_path, f"{lines}  # [-] line"))[1].gaps
    assert reason in gap.reason


def test_the_reason_of_a_gap_has_the_names_as_they_are_written(tmp_path: Path) -> None:
    """Those of one cell alone are called by their cell where they are run."""
    given = "def _f(v):\n    return v\ny = _f(*([g.F] if g.F.__class__ is float else []))  # [-] line"
    (gap,) = recorded(own(tmp_path, given))[1].gaps
    assert "(_f() missing 1 required positional argument" in gap.reason
