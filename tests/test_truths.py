"""What is true or false in arithmetic: Python counts it, numpy combines it, and readers have what the worksheet has."""

from pathlib import Path

import pytest
from never_stale import assert_never_stale
from own_worksheet import ELSEWHERE, assert_followed, own, recorded

from mechsheet import sweep
from mechsheet.quantities.lines import Recording
from mechsheet.worksheet.cells import Worksheet

FOLLOWED = [
    "y = (g.F > 3) + (g.a > 1)",
    "y = (2 * g.F > 6) + (g.a**2 > 1) + (g.k > 2)",
    "n = (g.F > 3)\nn += (g.a > 1)\ny = n * 1",
    "y = sum(v > 3 for v in (g.F, g.a, 2.0)) + (g.F > 3) * (g.a > 1)",
    "y = (x > 3) + (x > 4)",
    "y = (x > 3) + (x > 4) + (x > 5) - 1",
    "b = x > 3\nb += x > 4\ny = b * 1.0",
    "n = (x > 3) + (x > 4)\ny = n.sum() + n[-1]",
    "y = np.where((x > 1) * (x < 4), x, 0.0)",
    "y = np.sum((x > 3) * (x > 4)) + np.sum((x > 3) + (x > 4))",
    "y = np.add(x > 3, x > 4) * 1.0 + (x > 3) ** 2",
    "y = (x > 3) @ (x > 4) + np.dot(x > 3, x > 2) * 1.0",
    "y = (x > 3).dot(x > 4) * 1.0 + np.inner(x > 3, x > 2) * 1.0 + np.vdot(x > 3, x > 1) * 1.0",
    "y = np.outer(x > 3, x > 4).sum() + ((x > 3) @ np.ones(g.n))",
    "y = np.trapezoid(x > 3)",
    "y = np.cumsum(x > 3) + np.diff((x > 3) * 1, prepend=0)",
    "y = (x > 3) ^ (x > 4)",
    "y = np.logical_or(g.k, 0) + np.logical_and(x, g.k) + np.logical_not(x > 3) + np.logical_xor(g.k, x > 3)",
    "y = (g.F > 3) & (g.a > 1) | (g.k > 2)",
    "y = (x > 3) + 0 + (x > 4)",
]
NUMPY_S = [  # or Python's: of both being true nobody knows
    "y = ((x[3] > 3) + (x[4] > 4)) * 1.0",
    "y = (np.sqrt(abs(g.F)) > 1.7) + (g.a > 1)",
    "y = (max(x) > 6) + (g.a > 1)",
    "n = x[2] > 2.4\nn += x[3] > 3\ny = n * 1",
]
BITS = ["y = g.k & 1", "y = round(g.F) & 1", "y = len(x) | 1", "y = np.bitwise_and(x.astype(int), 3)"]


def of(lines: str, tmp_path: Path) -> tuple[Worksheet, Recording]:
    sheet = own(tmp_path, f"{lines}\nresult = np.atleast_1d(y) * 1.0  # [-] line")
    return sheet, recorded(sheet)[1]


@pytest.mark.parametrize("lines", [*FOLLOWED, *NUMPY_S, *BITS])
def test_truths_in_arithmetic_are_never_stale(lines: str, tmp_path: Path) -> None:
    assert_never_stale(lines, tmp_path)


@pytest.mark.parametrize("lines", FOLLOWED)
def test_truths_are_combined_as_the_worksheet_does(lines: str, tmp_path: Path) -> None:
    """Numpy's were counted: where no two are true now, all readers had other numbers for inputs for which they are."""
    sheet, recording = of(lines, tmp_path)
    assert not recording.gaps
    assert_followed(sheet, recording, [given for given in ELSEWHERE if "n" not in given])


@pytest.mark.parametrize("lines", NUMPY_S)
def test_single_truths_that_may_be_numpy_s_are_added_while_not_all_hold(lines: str, tmp_path: Path) -> None:
    _, recording = of(lines, tmp_path)
    assert recording.guards or any("truths" in gap.reason for gap in recording.gaps)


@pytest.mark.parametrize("lines", BITS)
def test_bits_of_numbers_are_told(lines: str, tmp_path: Path) -> None:
    """They were taken for truths: 2 & 1 was 1."""
    _, recording = of(lines, tmp_path)
    assert any("bitwise" in gap.reason and "numbers" in gap.reason for gap in recording.gaps)


def test_a_truth_is_swept_as_one_or_none(tmp_path: Path) -> None:
    """The page and the command show it so; a sweep said that it is no number."""
    sheet, _ = of("y = 0.0\ngood = g.F > 3  # [-] whether", tmp_path)
    assert sweep(sheet.path, ["good"], {"F": [2.0, 4.0]})["good"].tolist() == [0.0, 1.0]
