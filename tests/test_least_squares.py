"""Least squares: proved to be the least near there, with the digits that there are, and their slopes exact."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from own_worksheet import own

from mechsheet.accuracy.arithmetic import mp, mpf
from mechsheet.quantities.lines import Recording
from mechsheet.readers.gradients import gradient
from mechsheet.readers.proof import Proof
from mechsheet.readers.slopes import slopes, unfollowed
from mechsheet.recording.record import record
from mechsheet.run.proving import proof_of
from mechsheet.worksheet.system import minerr

LINES = """
from mechsheet import minerr
s = linspace(0.4, 2.3, 3)  # [-] positions
y_least = minerr(lambda k: (k - g.F, 2 * k - g.a, k**2), k=1.0, unit=("m", "mm", "m"), unknown_unit="m")
y = y_least.value.k  # [-] fitted
z_least = minerr(lambda p, q: (p * exp(q) - g.F, p * exp(2 * q) - 2 * g.a, p - 3), p=3.0, q=-0.3)
p, q = z_least.value  # [-] one, [-] other
m_least = minerr(lambda r: (r * s - g.F, r**2 - s), r=s)
m = m_least.value.r  # [-] over positions"""


def run(folder: Path, lines: str) -> tuple[Any, Recording, Proof]:
    sheet = own(folder, lines)
    names = {**sheet.run(sheet.results, {"g": sheet.inputs()}), "__file__": sheet.path}
    recording = record(names, sheet, whole=True, exact=True)
    return names, recording, proof_of(names, sheet, recording, ["m"])


def fitted(F: Any, a: Any) -> dict[str, Any]:
    """Where the slopes of the sums of squares vanish, at 50 digits."""
    thousand = mpf(1000) ** 2  # a residual of one millimetre counts as much as one of a metre
    y = mp.findroot(lambda k: (k - F) + thousand * 2 * (2 * k - a) + 2 * k**3, mpf("0.37"))

    def level(p: Any, q: Any) -> tuple[Any, Any]:
        e, one, two = mp.exp(q), p * mp.exp(q) - F, p * mp.exp(2 * q) - 2 * a
        return one * e + two * e**2 + p - 3, one * p * e + two * 2 * p * e**2

    p, q = mp.findroot(level, (mpf(3), mpf("-0.3")))
    each = [mpf("0.4") + mpf("0.95") * k for k in range(3)]
    m = [mp.findroot(lambda r, s=s: (r * s - F) * s + (r**2 - s) * 2 * r, mpf(1)) for s in each]
    return {"y": [y], "p": [p], "q": [q], "m": m}


def test_least_squares_are_proved_with_the_digits_that_there_are(tmp_path: Path) -> None:
    names, _, proof = run(tmp_path, LINES.strip())
    told = {root.name: str(root) for root in proof.roots}
    assert set(told) == {"y_least.k", "z_least.p", "z_least.q", "m_least.r"}
    assert all("proved, one least sum of squares there" in text for text in told.values()), told
    truths = fitted(mpf(2.5), mpf(0.75))
    for column in (c for c in proof.columns if c.name in truths):
        own_values, true = np.atleast_1d(names[column.name]), truths[column.name]
        off = max(abs(mpf(float(x)) - t) for x, t in zip(own_values, true, strict=True)) / max(map(abs, true))
        assert column.least > 9 or "the search for the least sum of squares ends there" in column.why
        assert column.least > 8 and abs(column.least - min(16.0, float(-mp.log10(off)))) < 0.2, column


@mp.workdps(40)
def test_slopes_of_least_squares_are_exact(tmp_path: Path) -> None:
    _, recording, _ = run(tmp_path, LINES.strip())
    by = [recording.inputs["F"], recording.inputs["a"]]
    for name in ("y", "p", "q", "m"):
        node = recording.values[name].whole().re
        found, last = slopes([node], by)[node].both.reshape(2, -1), node.size - 1
        assert gradient(node, last, by).both == pytest.approx(found[:, last], rel=1e-12)
        for k, (u, v) in enumerate([(1, 0), (0, 1)]):
            for i, own_slope in enumerate(found[k]):
                true = mp.diff(lambda t, n=name, i=i, u=u, v=v: fitted(mpf(2.5) + t * u, mpf(0.75) + t * v)[n][i], 0)
                assert own_slope == pytest.approx(float(true), rel=1e-6), (name, k, i)  # the fit itself has 9 digits


@pytest.mark.parametrize(
    ("equations", "exists"),
    [("np.sum(k * s) - g.F, k - g.a", False), ("(k - 1) ** 3", False), ("(k - g.F) ** 2 - 1, k - g.F", True)],
)
def test_what_is_not_proved_is_named(equations: str, exists: bool, tmp_path: Path) -> None:
    """A sum over positions is not elementwise, a level sum may be no least one, and a hill is none."""
    lines = f"""
from mechsheet import minerr
s = linspace(0.4, 2.3, 3)  # [-] positions
y_least = minerr(lambda k: ({equations},), k=2.4)
y = y_least.value.k  # [-] fitted"""
    _, recording, proof = run(tmp_path, lines.strip())
    (root,) = proof.roots
    assert root.exists == exists and ("one least sum of squares" in str(root)) == exists
    (column,) = (c for c in proof.columns if c.name == "y")
    assert exists or "no least sum of squares is proved there" in column.why
    known = unfollowed([recording.values["y"].whole().re], [recording.inputs["F"]]) is None
    assert known == ("sum" not in equations)


def test_of_what_has_no_number_at_the_guess_there_is_no_value() -> None:
    """It was the guess."""
    none = minerr(lambda x: (x - 1, np.sqrt(x - 5)), x=1.0)
    assert not none.valued and none.reason == "no solution for x from the guess: equation 2 has no number there"
    some = minerr(lambda x, k: (x - k, np.where(k > 2.5, x, np.nan)), x=np.array([1.0, 2.0]), k=np.array([2.0, 4.0]))
    assert some.valued.tolist() == [False, True]
