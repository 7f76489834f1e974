"""Arrays of those elements for which a condition holds: a page shows as many of them as its inputs say."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from in_browser import evaluated
from own_worksheet import written

from mechsheet.html import javascript
from mechsheet.quantities.lines import Recording
from mechsheet.quantities.quantity import Quantity
from mechsheet.recording.record import record
from mechsheet.worksheet import cells

if TYPE_CHECKING:
    from playwright.sync_api import Page

SETUP = """
import numpy as np
from numpy import where

from mechsheet import ask, inputs, read, table, typeset
"""
GIVEN = """
n: int = 13  # [-] how many; > 1
lim: float = 0.5  # [-] limit
w: float = 1.0  # [-] rate
k: int = 3  # [-] part
"""
ARRAYS = [
    "F[F > g.lim]",
    "t[F > g.lim]",
    "F[F > g.lim] * 2 + 1",
    "F[F > g.lim] - t[F > g.lim]",
    "np.sort(F[F > g.lim])",
    "F[F > g.lim][::-1]",
    "F[F > g.lim].cumsum()",
    "np.cumsum(F[np.abs(F) > g.lim] ** 2)",
    "t[(F > g.lim) & (t > 1)]",
    "t[np.flatnonzero(F > g.lim)]",
    "t[np.nonzero(F > g.lim)[0]]",
    "t[np.where(F > g.lim)[0]]",
    "np.compress(F > g.lim, t)",
    "np.extract(F > g.lim, F)",
    "np.flatnonzero(F > g.lim) * 1.0",
    "np.append(F[F > g.lim], g.w)",
    "np.concatenate([[0.0], F[F > g.lim]])",
    "np.concatenate([F[F > g.lim], F[F <= g.lim]])",
    "np.where(F[F > g.lim] > 0.8, 1.0, F[F > g.lim])",
    "np.interp(t[F > g.lim], [0.0, 6.0], [0.0, g.w])",
    "np.maximum(F[F > g.lim], 0.7)",
    "np.abs(Z[F > g.lim])",
    "Z[F > g.lim].imag",
    "F[~(F > g.lim)]",
    "F[F > g.lim][F[F > g.lim] < 0.9]",
    "np.array([v * g.w for v in F if v > g.lim])",
    "np.array([v * u for v, u in zip(F, t) if v > g.lim])",
    "t[1:][np.diff(np.sign(F)) != 0]",
    "t[:-1][F[:-1] * F[1:] < 0]",
    "F[F > g.lim][:2]",
    "F[F > g.lim][1:]",
    "np.diff(t[F > g.lim])",
    "M[F > g.lim, 1]",
    "M[F > g.lim][:, 0] * g.w",
    "np.interp(g.lim, F[F > -2] * 0 + t[F > -2], F[F > -2])",
    "F[F > g.lim] / F.max()",
    "F[F > g.lim] - F[F > g.lim].sum()",
    "np.outer(F[F > g.lim], [1.0, g.w])[:, 1]",
    "F[np.isfinite(F / np.where(F > 0, 1.0, np.nan))]",
    "np.array([v for v in F if v > g.lim])[::-1]",
]
GIVES: list[dict[str, Any]] = [
    {}, {"lim": -0.3}, {"lim": 0.9, "w": 2.0}, {"n": 40}, {"n": 5, "w": 0.7}, {"lim": -2.0}, {"w": 3.1, "n": 61},
    {"lim": 0.99}, {"lim": 2.0},
]  # fmt: skip


def recorded(folder: Path, some: str, each: Sequence[str]) -> tuple[cells.Worksheet, Recording, list[dict[str, float]]]:
    """A worksheet with some lines and each of others, its recording for a page, and the sets of inputs."""
    lines = f"t = np.linspace(0, 6, g.n)  # [-] time\nF = np.cos(t * g.w)  # [-] force\n{some}\n"
    lines += "\n".join(f"y_{k} = {line}  # [-] line" for k, line in enumerate(each))
    path = folder / "own.py"
    path.write_text(written(SETUP, GIVEN, lines + '\ntable_1 = table("1", "All", F)\ntypeset()'), encoding="utf-8")
    sheet = cells.load(path)
    names = sheet.run(sheet.results, {"g": sheet.inputs()})
    given = [{name: float(getattr(sheet.inputs(**own), name)) for name in ("n", "lim", "w", "k")} for own in GIVES]
    return sheet, record({**names, "__file__": sheet.path}, every=1, draws=True, lists=True), given


def test_as_many_are_shown_as_the_condition_holds_for(blank: Page, tmp_path: Path) -> None:
    sheet, recording, given = recorded(tmp_path, "Z = F + 1j * t\nM = np.stack([F, t], axis=1)", ARRAYS)
    values = {str(k): recording.values.get(f"y_{k}") for k in range(len(ARRAYS))}
    assert all(isinstance(value, Quantity) for value in values.values())
    script = javascript.module(recording, {k: value.re for k, value in values.items() if isinstance(value, Quantity)})
    for each, found in zip(GIVES, evaluated(blank, script, given), strict=True):
        own = sheet.run([f"y_{k}" for k in range(len(ARRAYS))], {"g": sheet.inputs(**each)})
        for k, line in enumerate(ARRAYS):
            number, expected = found["values"][str(k)], own[f"y_{k}"]
            assert number is not None, (line, each, found["gaps"].get(str(k)))
            assert np.shape(number) == np.shape(expected), (line, each)
            np.testing.assert_allclose(number, expected, rtol=1e-12, atol=1e-13, err_msg=f"{line} {each}")


UNLIKE = [  # of arrays that are as long as each other now alone
    "P + Q", "where(P > 0.7, Q, 0.0)", "P @ Q", "np.dot(P, Q)", "np.interp(g.w, np.sort(P), Q)", "P + 1j * Q",
    "(P + 1j * Q).imag", "(P * Q).sum()", "np.trapezoid(Q, P)", "(P > Q).any() * 1.0", "(P - Q > 5).sum() * 1.0",
    "len(P - Q) * 1.0", "np.isclose(P, Q).sum() * 1.0", "np.array([P, Q])", "np.average(P, weights=Q)",
    "np.polyfit(np.sort(P), Q, 1)[0]", "P * Q.sum()", "np.concatenate([P, Q])",
    "sum(p * q for p, q in zip(P, Q)) * 1.0",
]  # fmt: skip


def test_nothing_is_shown_of_arrays_that_are_not_as_long_as_each_other(blank: Page, tmp_path: Path) -> None:
    """The worksheet has no number for these inputs; one element goes with any number where numpy repeats it."""
    some = "P = F[F > g.lim]  # [-] some\nQ = F[t < 2.4]  # [-] others"
    sheet, recording, given = recorded(tmp_path, some, UNLIKE)
    values = {f"y_{k}": recording.values[f"y_{k}"] for k in range(len(UNLIKE))}
    parts = {f"{name} {n}": node for name, value in values.items() for n, node in enumerate(value.parts)}
    guards = {name: [guard.holds for guard in recording.looked[name]] for name in values}
    parts |= {f"{name} guard {n}": node for name, each in guards.items() for n, node in enumerate(each)}
    followed = 0
    for each, found in zip(GIVES, evaluated(blank, javascript.module(recording, parts), given), strict=True):
        g = sheet.inputs(**each)
        t = np.linspace(0, 6, g.n)
        F = np.cos(t * g.w)
        P, Q = F[g.lim < F], F[t < 2.4]
        own = {"np": np, "where": np.where, "g": g, "P": P, "Q": Q}
        for k, line in enumerate(UNLIKE):
            here = [found["values"][f"y_{k} {n}"] for n, _ in enumerate(values[f"y_{k}"].parts)]
            seen = [found["values"][f"y_{k} guard {n}"] for n, _ in enumerate(guards[f"y_{k}"])]
            if any(x is None for x in here) or not all(x == 1 for x in seen):
                continue
            number = here[0] if len(here) == 1 else here[0] + 1j * here[1]
            try:
                expected = eval(line, own)
            except (ValueError, TypeError, np.linalg.LinAlgError):
                expected = np.full(np.shape(number), np.nan)
            np.testing.assert_allclose(number, expected, rtol=1e-9, atol=1e-11, err_msg=f"{line} {each}")
            followed += 1
    assert followed > 2 * len(UNLIKE)
