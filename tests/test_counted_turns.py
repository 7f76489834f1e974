"""Loops and sums over so many numbers as an input says: other inputs take more turns, fewer or none."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from in_browser import evaluated
from openpyxl import load_workbook
from own_worksheet import written
from typed_workbook import typed

from mechsheet.html import javascript
from mechsheet.quantities.lines import Recording
from mechsheet.readers.numbers import numbers
from mechsheet.recording.record import record
from mechsheet.run import report
from mechsheet.worksheet import cells

if TYPE_CHECKING:
    from playwright.sync_api import Page

SETUP = """
import math
from math import prod

import numpy as np

from mechsheet import ask, check, export, inputs, read, table, typeset
"""
GIVEN = """
n: int = 5  # [-] how many; >= 0
m: int = 2  # [-] from which; >= 0
x: float = 0.7  # [-] argument; > 0
"""
FOLLOWED = [
    "s = 0.0\nfor i in range(g.n):\n    s = s + g.x**i / (i + 1)\nNAME = s * g.x",
    "s = 0.0\nfor i in range(g.m, g.n + 1):\n    s += g.x**i / (i + 1)\nNAME = s",
    "s = 0.0\nfor i in range(0, 2 * g.n, 3):\n    s += g.x**i\nNAME = s",
    "s = 0.0\nfor i in range(g.n, 0, -1):\n    s = (s + 1 / i) * g.x\nNAME = s",
    "s = 0.0\nfor i in np.arange(1, g.m + 3):\n    s += g.x**i / i\nNAME = s * 1.0",
    "s = 0.0\nfor t in np.linspace(0.0, g.x, g.m + 2):\n    s += np.sin(t)\nNAME = s",
    "s, t = 0.0, g.x\nfor i in range(g.n, 0, -1):\n    t -= 0.5\n    s = 0.25\nNAME = s + t",
    "s, term = 0.0, 1.0\nfor i in range(1, g.n + 1):\n    term *= g.x / i\n    s += term\nNAME = s",
    "p = 1.0\nfor i in range(g.m, g.n):\n    p *= g.x + 1 / (i + 1)\nNAME = p",
    "a, b = 0.0, g.x\nfor _ in range(g.n):\n    a, b = b, a + b\nNAME = a",
    "v, z = 0.0, 1.0\nfor i in range(g.n):\n    v += (9.81 - g.x * v * abs(v)) * 0.05\n    z -= v * 0.05\n"
    "    if z < 0:\n        z, v = 0.0, -0.5 * v\nNAME = z + v",
    "z = 1.0\nfor i in range(g.n):\n    z = (z + g.x / z) / 2\n"
    "    if abs(z * z - g.x) < 1e-6:\n        break\nNAME = z",
    "z = np.array([1.0, g.x])\nfor i in range(g.n):\n    z = np.array([z[1], z[0] * g.x + i])\nNAME = z[0] + z[1]",
    "top = 0.0\nfor i in range(g.n + 1):\n    top = max(top, math.sin(i * g.x))\nNAME = top * 1.0",
    "k = 0\nfor i in range(1, g.n + 1):\n    if g.x * i > 2:\n        k = i\n        break\nNAME = k * 1.0",
    "NAME = sum(g.x**q / q for q in range(1, g.n + 1)) * 1.0",
    "NAME = np.sum([g.x**q / q for q in range(1, g.n + 1)]) * 1.0",
    "NAME = math.prod(g.x + q for q in range(1, g.n + 1)) * 1.0",
    "NAME = prod([g.x + q for q in range(g.n)]) * 1.0",
    "NAME = math.fsum(g.x**q for q in range(g.m, g.n)) * 1.0",
    "NAME = max(math.sin(q * g.x) for q in range(g.n + 1)) * 1.0",
    "NAME = sum(g.x**q for q in range(1, int(g.n / 2) + 1)) * 1.0",
    "s = 0.0\nfor i in range(g.n // 2, g.n):\n    s += g.x**i / (i + 1)\nNAME = s",
    "s = 1.0\nfor i in range(max(g.n % 3, abs(g.m - g.n))):\n    s = s * g.x + 1\nNAME = s",
    "NAME = sum(math.comb(g.n, q) * g.x**q for q in range(g.n + 1)) * 1.0",
    "NAME = sum(g.x**q / math.factorial(q) for q in range(g.n + 1)) * 1.0",
    "s = 0.0\nfor q in range(g.n + 1):\n    s += (-1) ** q * g.x ** (2 * q) / math.factorial(2 * q)\nNAME = s",
    "NAME = math.factorial(g.n) * g.x + math.perm(g.n + 2, 2) + math.comb(g.n, g.m)",
    "def series(x, count):\n    s = 0.0\n    for i in range(count):\n        s = s * x + 1\n    return s\n"
    "NAME = series(g.x, g.n) + series(0.5, g.m)",
]
GATHERED = [  # in lists and arrays, which a workbook has as long as now
    "L = []\nfor i in range(g.n):\n    L.append(g.x * i**2)\nNAME = sum(L) + len(L) + np.array(L).sum()",
    "L, M = [], []\nfor i in range(1, g.n + 1):\n    d = g.x / i\n    L.append(d)\n    M.append(d**2)\n"
    "NAME = np.dot(L, M)",
    "v = np.zeros(g.n)\nfor i in range(g.n):\n    v[i] = g.x * i + 1\nNAME = v.sum() + len(v)",
    "v = np.zeros(g.m + 1)\nfor i in range(g.m):\n    v[i + 1] = v[i] + g.x\nNAME = v.sum() * 1.0",
    "v = np.zeros(g.m + 1)\nv[0] = g.x\nfor i in range(1, g.m + 1):\n    v[i] = v[i - 1] * g.x + i\nNAME = v[-1] * 1.0",
    "v, t = np.zeros((g.n + 1, 2)), np.linspace(0, 1, g.n + 1)\nfor i in range(g.n):\n"
    "    v[i + 1] = v[i] + np.array([v[i, 1], 1 - g.x * v[i, 0]]) * (t[i + 1] - t[i])\nNAME = v[-1, 0] + v[:, 1].sum()",
    "w, s = np.zeros(g.n + 1), np.zeros(g.n + 1)\nfor i in range(g.n):\n    a = 10 - g.x * w[i]**2\n"
    "    w[i + 1] = w[i] + a * 0.1\n    s[i + 1] = s[i] + (w[i] + w[i + 1]) / 2 * 0.1\n    if w[i + 1] > 1.5:\n"
    "        w[i + 1] = 1.5\nNAME = s[-1] + w.max()",
    "w = np.zeros(g.n + 1)\nfor i in range(g.n):\n    w[i + 1] = w[i] + g.x\n    if w[i + 1] > 3:\n        break\n"
    "NAME = w.max() + w.sum()",
    "w = np.zeros(g.n + 1)\nfor i in range(g.n + 1):\n    w[i] += g.x\n    w[g.n - i] += 1\nNAME = w.max() + w.sum()",
    "v = np.zeros(50)\nfor i in range(g.n):\n    v[i + 1] = v[i] + g.x\nNAME = v.sum() * 1.0",
    "v = np.zeros(50)\nv[g.n] = g.x\nv[-g.m - 1] = 2.0\nNAME = v[5] + v[13] * 2 + v[45] * 3 + v[47] * 4",
    "def lift(count):\n    y = np.zeros(count + 1)\n    y[0] = 0.1\n    for k in range(1, count + 1):\n"
    "        y[k] = y[k - 1] * (1 + g.x) / k\n    return y\nNAME = lift(g.n)[-1] + lift(g.m + 1).sum()",
    "v, w, s = np.ones(g.n + 1), np.zeros(g.n + 1), 0.0\nfor i in range(g.n + 1):\n    v[i] = g.x**i\n"
    "    w[i] = i - 1\n    s += g.x\nNAME = v @ w + s",
    "t, x, v = [0.0], [g.x], [0.0]\nfor i in range(g.n):\n    v.append(v[-1] - 0.1 * x[-1])\n"
    "    x.append(x[-1] + 0.1 * v[-1])\n    t.append(t[i] + 0.1)\n"
    "NAME = x[-1] + max(v) + np.array(t).sum() + np.dot(x, v) + len(t)",
    "L = [0.0, 1.0]\nfor i in range(g.n):\n    if L[-1] > 2:\n        L.append(L[-1] - g.x)\n    else:\n"
    "        L.append(L[-2] + g.x)\n    L[-1] *= 0.9\n    L.append(len(L) * g.x)\nNAME = max(L) + L[-1] + L[-2]",
    "def settling(count):\n    y, s = [0.5], 0.0\n    for k in range(count):\n        z = y[-1]\n"
    "        for j in range(3):\n            z += g.x * (1 - z) * 0.1\n        y.append(z)\n        s += z\n"
    "    return y[-1] + s + sum(y)\nNAME = settling(g.n) + settling(2 * g.m)",
    "v, s = np.ones(g.n + 1), 0.0\nfor i in range(g.n):\n    z = v[i] * g.x\n    v[i + 1] = z + 0.1\n    s += z\n"
    "NAME = v[-1] + s",
    "z = [1 + 1j]\nfor i in range(g.n):\n    z.append(z[-1] * np.exp(1j * g.x))\nNAME = abs(z[-1] - 1) + sum(z).real",
    "L = [1.0]\nfor i in range(g.m):\n    L.append(g.x * i)\nNAME = sum(L)",
    "v = np.zeros(g.m + 3)\nfor i in range(g.m):\n    v[i] = g.x\nNAME = v.sum()",
    "v = np.zeros(g.m, int)\nfor i in range(g.m):\n    v[i] = g.x * i\nNAME = v.sum() * 1.0",
    "v = np.zeros(g.m)\nw = v\nfor i in range(g.m):\n    v[i] = g.x * i\nNAME = w.sum() * 1.0",
    "L = [1.0]\nM = L\nfor i in range(g.m):\n    L.append(L[-1] * g.x)\nNAME = sum(M) * 1.0",
    "L = [1.0]\nfor i in range(g.m):\n    L.append(L[-1] * g.x)\n    if L[-1] < 0.4:\n        break\nNAME = sum(L)",
    "v = np.linspace(0.0, 2.0, g.n + 2)\nfor i in range(g.n, 0, -1):\n    v[:2] = g.x\nNAME = np.argmax(v) * 1.0",
]
NESTED = [  # a workbook takes as many turns of each as now
    "s = 0.0\nfor i in range(g.n):\n    for j in range(g.m):\n        s += g.x**(i + j)\nNAME = s",
    "s = 0.0\nfor i in range(g.n):\n    for j in range(i):\n        s += g.x**(i + j)\n    s += 1\nNAME = s",
    "s = 0.0\nfor i in range(g.n):\n    for j in range(g.m - 2):\n        s += g.x * (i + j)\n    s += 1\nNAME = s",
    "s = 0.0\nfor i in range(g.n):\n    for j in range(g.m):\n        if i == j:\n            continue\n"
    "        s += g.x / (i - j)\nNAME = s",
    "s = 0.0\nfor i in range(g.n):\n    for j in range(g.m):\n        if g.x * j > 1:\n            break\n"
    "        s += g.x**(i + j)\nNAME = s",
    "s = 0.0\nfor i in range(g.n):\n    for j in range(i + 1):\n        for k in range(g.m):\n"
    "            s += g.x * (i - j + k)\nNAME = s",
    "s = 0.0\nfor i in range(g.n):\n    for a, b in [(1.0, 2.0), (g.x, 3.0)]:\n        s += a * i + b\nNAME = s",
    "s = 0.0\nfor i, a in enumerate([1.0, 2.0, 4.0]):\n    for j in range(g.n):\n        s += a * g.x**j\nNAME = s",
    "s = 0.0\nfor i in range(g.n):\n    z = 1.0\n    while abs(z * z - g.x - i) > 1e-9:\n"
    "        z = (z + (g.x + i) / z) / 2\n    s += z\nNAME = s",
    "z, k = 1.0, 0\nwhile abs(z * z - g.x) > 1e-9:\n    for q in range(g.m):\n        z = (z + g.x / z) / 2\n"
    "    k += 1\nNAME = z + k",
    "M = np.zeros((g.n + 1, 3))\nfor i in range(g.n):\n    for j in range(3):\n"
    "        M[i + 1, j] = M[i, j] * 0.9 + g.x\nNAME = M.sum() * 1.0",
    "M = np.zeros((g.n + 1, g.m + 1))\nfor i in range(g.n + 1):\n    for j in range(g.m + 1):\n"
    "        M[i, j] = g.x**i / (j + 1)\nNAME = M.sum() * 1.0",
    "u = np.linspace(0, 1, 6)\nfor k in range(g.n):\n    v = u * 1\n    for i in range(1, 5):\n"
    "        v[i] = u[i] + g.x * 0.1 * (u[i + 1] - 2 * u[i] + u[i - 1])\n    u = v\nNAME = u.sum()",
    "def runge_kutta(f, y0, n, h):\n    y = np.zeros((n + 1, len(y0)))\n    y[0] = y0\n    for i in range(n):\n"
    "        k1 = f(y[i])\n        k2 = f(y[i] + h * k1)\n        y[i + 1] = y[i] + h / 2 * (k1 + k2)\n    return y\n"
    "def rate(u):\n    return np.array([u[1], -g.x * u[0]])\n"
    "NAME = runge_kutta(rate, [1.0, 0.0], g.n, 0.1)[-1, 0] * 1.0",
    "s = 0.0\nfor i in range(g.m - 2):\n    for j in range(g.n):\n        for k in range((i + 1)**2):\n"
    "            s += g.x\nNAME = s * 1.0",
    "y = np.zeros(g.m + 1)\nfor i in range(g.n):\n    for j in range((i + 1)**2):\n        y[0] += g.x\n"
    "NAME = y.sum() + len(y)",
]
LISTS = "arange", "linspace", "[g.x", "max(math"  # of so many numbers, which a workbook has as many of as now
OTHER: list[dict[str, Any]] = [
    {}, {"n": 0}, {"n": 1}, {"n": 2, "x": 1.25}, {"n": 12}, {"n": 13, "m": 4, "x": 0.31}, {"n": 40}, {"n": 3, "m": 9},
]  # fmt: skip


def sheet_of(folder: Path, title: str = "", each: Sequence[str] = FOLLOWED) -> cells.Worksheet:
    path = folder / "own.py"
    lines = "\n".join(f"{line.replace('NAME', f'y_{k}')}  # [-] line" for k, line in enumerate(each))
    for k in range(len(each)):
        lines += f"\nz_{k} = np.array([y_{k}])  # [-] alone\ntable_{k} = table('{k}', 'Alone', z_{k})"
    lines += "\ntypeset()"
    path.write_text(written(SETUP, GIVEN, lines, title), encoding="utf-8")
    return cells.load(path)


def expected(sheet: cells.Worksheet, given: dict[str, Any], each: Sequence[str] = FOLLOWED) -> list[float]:
    names = [f"y_{k}" for k in range(len(each))]
    found = sheet.run(names, {"g": sheet.inputs(**given)})
    return [found[name] for name in names]


def recorded(sheet: cells.Worksheet, **options: Any) -> Recording:
    names = sheet.run(sheet.results, {"g": sheet.inputs()})
    return record({**names, "__file__": sheet.path}, **options)


@pytest.mark.parametrize(("every", "followed"), [(FOLLOWED, len(FOLLOWED)), (GATHERED, 19), (NESTED, 14)])
def test_a_page_takes_as_many_turns_as_its_inputs_say(
    every: Sequence[str], followed: int, blank: Page, tmp_path: Path
) -> None:
    """Or has no number of what its reader does not follow, and says so."""
    sheet = sheet_of(tmp_path, each=every)
    recording = recorded(sheet, every=1, draws=True, lists=True)
    parts = {f"{k}": recording.values[f"y_{k}"].re for k in range(len(every))}
    guards = {k: [guard.holds for guard in recording.looked[f"y_{k}"]] for k in range(len(every))}
    parts |= {f"{k} guard {n}": node for k, seen in guards.items() for n, node in enumerate(seen)}
    given = [{name: float(getattr(sheet.inputs(**each), name)) for name in ("n", "m", "x")} for each in OTHER]
    script = javascript.module(recording, parts)
    for each, found in zip(OTHER, evaluated(blank, script, given), strict=True):
        for k, own in enumerate(expected(sheet, each, every)):
            number, why = found["values"][f"{k}"], found["gaps"].get(f"{k}")
            held = all(found["values"][f"{k} guard {n}"] == 1 for n in range(len(guards[k])))
            if number is None or not held:
                assert k >= followed and (why or not held), (every[k], each, why)
                continue
            np.testing.assert_allclose(number, own, rtol=1e-12, err_msg=f"{every[k]} {each}")


@pytest.mark.parametrize("every", [FOLLOWED, GATHERED, NESTED])
def test_cells_take_twice_as_many_turns_as_now_and_some_more(
    every: Sequence[str], recalculated_all: Callable[[list[Path]], list[Any]], tmp_path: Path
) -> None:
    """What takes more of them, or is a list of so many, or stands in another loop, has no number."""
    sheet = sheet_of(tmp_path, "Own", every)
    names = sheet.run(sheet.results, {"g": sheet.inputs()})
    path = tmp_path / "own.xlsx"
    path.write_bytes(report.workbook("", {**names, "__file__": sheet.path}, {}))
    rows = {row[0]: n for n, row in enumerate(load_workbook(path)["Inputs"].iter_rows(min_row=3, values_only=True), 3)}
    paths = [
        typed(path, {("Inputs", f"B{rows[name]}"): value for name, value in each.items()}, tmp_path / f"{n}.xlsx")
        for n, each in enumerate(OTHER)
    ]
    for each, book in zip(OTHER, recalculated_all(paths), strict=True):
        for k, own in enumerate(expected(sheet, each, every)):
            shown = book[f"{k} Alone"]["A5"].value
            if shown == "#N/A":
                may_be = each["n"] > 13 or any(form in every[k] for form in LISTS)
                assert may_be if every is FOLLOWED else each, (every[k], each)
            else:
                np.testing.assert_allclose(shown, own, rtol=1e-11, err_msg=f"{every[k]} {each}")


@pytest.mark.parametrize("every", [FOLLOWED, GATHERED, NESTED])
@pytest.mark.parametrize("bodies", [False, True])
def test_every_reader_has_the_number_of_the_inputs_or_none(bodies: bool, every: Sequence[str], tmp_path: Path) -> None:
    sheet = sheet_of(tmp_path, each=every)
    recording = recorded(sheet, whole=bodies)
    for each in OTHER:
        nodes = [recording.values[f"y_{k}"].re for k in range(len(every))]
        given = {recording.inputs[name]: float(value) for name, value in each.items()}
        found = numbers(nodes, given)
        for k, own in enumerate(expected(sheet, each, every)):
            assert np.isnan(found[nodes[k]]) or found[nodes[k]] == pytest.approx(own, rel=1e-12), (every[k], each)


LEFT = (
    "s = 0.0\nfor i in range(g.m, g.n):\n    for k in range((i + 1)**2):\n        s += g.x\n"
    "    if s > g.x:\n        break\nNAME = s * 1.0"
)


@pytest.mark.parametrize("draws", [False, True])
@pytest.mark.parametrize("line", [*NESTED[14:], LEFT])
def test_a_loop_that_is_not_followed_says_so_alone(line: str, draws: bool, tmp_path: Path) -> None:
    """What stands before it has names of its own, which tell too; it takes no turn now, or none for other inputs."""
    sheet = sheet_of(tmp_path, each=[line])
    recording = recorded(sheet, every=1, draws=draws, lists=draws)
    node = recording.values["y_0"].re
    guards = [guard.holds for guard in recording.looked["y_0"]] if draws else [*recording.guards]
    for each in [*OTHER, {"m": 5}]:
        (own,) = expected(sheet, each, [line])
        found = numbers([node, *guards], {recording.inputs[name]: float(value) for name, value in each.items()})
        if all(found[holds].all() for holds in guards) and not np.isnan(found[node]):
            assert found[node] == pytest.approx(own, rel=1e-12), each
