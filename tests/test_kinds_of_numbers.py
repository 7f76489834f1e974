"""Kinds of numbers in arrays, whole ones, truths and short ones: what numpy makes of them is not what it makes of all.

Each line changes nothing for the inputs of the worksheet that would be seen there.
"""

from pathlib import Path

import pytest
from never_stale import assert_never_stale
from own_worksheet import ELSEWHERE, assert_followed, own, recorded

ONE = "(g.F - 1.5)"  # for the inputs of the worksheet
FOLLOWED = [
    f"z = np.zeros(3, dtype=bool)\nz[0] = {ONE}\ny = z * 1.0",
    f"z = x > 3\nz[1:] = {ONE}\ny = z * 1.0",
    f"z = np.ones(3, dtype=bool)\nfor i in range(2):\n    z[i] = {ONE} - i\ny = z * 1.0",
    "y = np.around(x * 100, -1) + np.round(g.F * 46.0, -1)",
    "y = np.around(x * 1000, -2)",
    f"z = np.array([1, 2, 3])\nz[0] = {ONE}\ny = z",
    "y = np.kron(x[:2] > 3, [True, False]) * 1.0",
]
TOLD = {
    "I = np.arange(1, 6) * g.k\ny = np.reciprocal(I + 1) + 0.5": "reciprocal",
    "y = np.reciprocal(g.k + 1) + 0.5": "reciprocal",
    f"y = np.float32(1.0) * {ONE}": "float32",
    f"y = np.array([1.0, 2.0], dtype=np.float32) * {ONE}": "float32",
    f"z = np.zeros(3, dtype=np.float32)\nz[0] = {ONE} / 3\ny = z": "float32",
    "y = np.arange(3, dtype=np.int16) * (g.k * 10000)": "int16",
    "y = (x * 10).astype(np.int8)": "int8",
    f"y = np.longdouble(1) / 3 * {ONE}": "longdouble float128",
    "y = np.convolve(x > 3, x > 6) * 1.0": "truths",
    "y = np.einsum('i,i', x > 3, x > 6) * 1.0": "truths",
}


@pytest.mark.parametrize("lines", [*FOLLOWED, *TOLD])
def test_no_number_is_that_of_another_kind(lines: str, tmp_path: Path) -> None:
    assert_never_stale(lines, tmp_path)


@pytest.mark.parametrize("lines", FOLLOWED)
def test_what_is_cut_or_rounded_is_so_for_other_inputs(lines: str, tmp_path: Path) -> None:
    sheet = own(tmp_path, f"{lines}\nresult = np.atleast_1d(y) * 1.0  # [-] line")
    _, recording = recorded(sheet)
    assert not recording.gaps
    assert_followed(sheet, recording, [given for given in ELSEWHERE if "n" not in given])


@pytest.mark.parametrize(("lines", "reason"), TOLD.items())
def test_what_numpy_makes_of_another_kind_is_told(lines: str, reason: str, tmp_path: Path) -> None:
    _, recording = recorded(own(tmp_path, f"{lines}\nresult = np.atleast_1d(y) * 1.0  # [-] line"))
    assert any(word in gap.reason for word in reason.split() for gap in recording.gaps)
