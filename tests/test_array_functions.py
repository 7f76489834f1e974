"""Functions of numpy that round, order and move the elements of arrays, followed for other inputs and lengths."""

from pathlib import Path

import numpy as np
import pytest
from own_worksheet import ELSEWHERE, assert_followed, own, recorded, value_of

PARTS = [
    "y = (x * 1j + 1.25).real", "y = np.imag(x + 1j)", "y = x.imag", "y = (x + 1j * g.a).imag.sum()",
    "y = np.sum((1j * x + g.a).real)",
]  # fmt: skip


def assert_all_followed(lines: str, tmp_path: Path) -> None:
    """Without a gap or a guard, and in the lengths that numpy has."""
    sheet = own(tmp_path, f"{lines}\nresult = np.atleast_1d(y) * 1  # [-] line\ntable_2 = table('2', 'Two', result)")
    _, recording = recorded(sheet)
    assert not recording.gaps and not [guard for guard in recording.guards.values() if not guard.rows]
    assert_followed(sheet, recording, ELSEWHERE)
    for n in (3, 5):
        expected = sheet.run(["result"], {"g": sheet.inputs(n=n)})["result"]
        assert np.shape(value_of(recording, "result", {"n": n})) == np.shape(expected)


@pytest.mark.parametrize("lines", PARTS)
def test_a_part_of_complex_numbers_has_the_length_of_the_whole(lines: str, tmp_path: Path) -> None:
    """Where it is the same number for all, a part was one number alone: its sum was that number."""
    assert_all_followed(lines, tmp_path)


ROUNDED = [
    "y = np.around(x, 1)", "y = np.around(x)", "y = np.round(x * 1e3, -2)",
    "z = np.round(x - 1.26j * x, 1)\ny = z.real + 2 * z.imag",
    "y = np.round(g.k * 7, -1) * 1.5", "y = x[x > 1].round(1).sum()", "y = np.around(x[x > g.a], 1).max()",
    "w = np.round(np.arange(4) * g.k, 1)\nw[0] = g.F\ny = w * 1.0",
    "w = np.round(np.arange(4) * g.k * 7, -1)\nw[0] = g.F\ny = w * 1.0",
    "w = np.arange(4) * g.k\nv = np.round(w, 1)\nv[0] = 9\ny = w + v * g.a",
]  # fmt: skip


@pytest.mark.parametrize("lines", ROUNDED)
def test_arrays_are_rounded_to_decimals(lines: str, tmp_path: Path) -> None:
    """Complex ones, those of a condition and what is `around` were told, and whole ones in which something is set."""
    assert_all_followed(lines, tmp_path)
