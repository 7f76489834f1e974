"""Functions of numpy that round, order and move the elements of arrays, followed for other inputs and lengths."""

from pathlib import Path

import numpy as np
import pytest
from never_stale import assert_never_stale
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


MOVED = [
    "y = np.roll(x, g.k)", "y = np.roll(x, 1 - 3 * g.k)", "y = np.roll([g.F, g.a, 1], -g.k)",
    "y = np.roll(np.outer(x, [1, g.a]), g.k, axis=0)[:, 1]", "y = np.roll(x * 1j + g.a, g.k).imag",
    "w = np.roll(np.arange(5), g.k)\nw[0] = g.F\ny = w * 1.0", "y = np.roll(x[:0], g.k).sum() + g.F",
    "y = np.delete(x, g.k)", "y = np.delete(x, -g.k)", "y = np.delete([g.F, g.a, 1, 2], g.k)",
    "y = np.delete(x, np.argmax(abs(x - g.F)))", "y = np.delete(np.outer(x, [1, g.a]), g.k, axis=0)[:, 1]",
    "y = np.insert(x, 0, 0)", "y = np.insert(x, len(x), g.F)", "y = np.insert(x, -1, g.F)",
    "y = np.insert(x, g.k, g.F)", "y = np.insert(x, -g.k, g.F)", "y = np.insert(x, [0, 1], [g.F, g.a])",
    "y = np.insert(x, 1, x)",
    "y = np.insert(np.arange(4), 1, g.F) * 1.0", "y = np.insert(np.arange(4), g.k, g.F) * 1.0",
    "y = np.insert(x > 1, g.k, g.F > 2) * 1.0", "y = np.insert(x + 1j * x, g.k, g.F).imag",
    "y = np.insert(np.outer([1, g.F], [1, g.a, 5]), 1, [g.F, 2, 3], axis=0)[:, 1]",
    "y = np.insert(np.where(x > 2, np.nan, x), 1, g.a)", "y = np.insert(np.cumsum(x), 0, 0)[:-1]",
    "y = np.delete(x, 9 - 2 * g.k).sum() if g.k > 2 else g.F",
    "y = np.pad(x, 1)", "y = np.pad(x, (1, 2), constant_values=(g.F, g.a))", "y = np.pad(x, (2, 7), 'edge')",
    "y = np.pad(x + 1j, 1).imag", "y = np.pad(np.arange(4), 1, constant_values=g.F) * 1.0",
    "y = np.pad(np.outer(x, [1, g.a]), ((1, 0), (0, 1)), constant_values=g.F)[:, 2]",
]  # fmt: skip
ONLY_TOLD = [
    "y = np.roll(x, (g.k,))", "y = np.roll(x, g.k + 0.0)", "y = np.roll(np.outer(x[:3], [1, g.a]), g.k).ravel()",
    "y = np.delete(x, [g.k, 1])", "y = np.delete(x, x > 1)", "y = np.delete(x, g.k + 1)", "y = np.delete(x, g.k * 2)",
    "y = np.insert(x, g.k * 2, g.F)", "y = np.insert(x, g.k, [g.F, g.a])", "y = np.insert(x[x > 1], g.k, g.F).sum()",
    "y = np.insert(x, 4, g.F)", "y = np.pad(x, g.k)", "y = np.pad(x, 1, mode='mean')",
    "y = np.pad(x, 2, mode='reflect', reflect_type='odd')", "y = np.insert(x, 1, 1j * g.F) if g.F > 9 else x",
]  # fmt: skip


@pytest.mark.parametrize("lines", MOVED)
def test_elements_are_moved_put_in_and_left_out(lines: str, tmp_path: Path) -> None:
    """insert and pad were told, and roll and delete were followed where Python saw the same place alone."""
    assert_all_followed(lines, tmp_path)


@pytest.mark.parametrize("lines", ONLY_TOLD)
def test_what_is_moved_otherwise_is_never_stale(lines: str, tmp_path: Path) -> None:
    """Several places that inputs tell, places that there are not for some inputs, what is made of other numbers."""
    assert_never_stale(lines, tmp_path)


IN_ORDER = [
    "z = [g.F, g.a, 1.0]\nz.sort()\ny = z",
    "z = [g.F, g.a, 1.0]\nw = z\nz.sort(reverse=True)\nw[0] = g.F\ny = z",
    "z = [g.F, g.a, 1.0]\nz.sort(key=lambda v: -v)\ny = z",
    "z = [(g.F, 1), (g.a, 2)]\nz.sort(key=lambda v: v[0], reverse=True)\ny = [v[1] * 1.0 for v in z]",
    "def f(v):\n    v.sort()\nz = [g.F, g.a, 1.0]\nf(z)\ny = z",
    "z = [3, 1, g.k]\nz.sort()\ny = [1.5, 2.5, 3.5, 4.5][z[1]]",
    "z = np.array([[g.F, 1.0], [g.a, 2.0]])\nz.sort(axis=0)\ny = z.ravel()",
    "d = {'reverse': True}\nz = [g.F, g.a, 1.0]\nz.sort(**d)\ny = z",
    "z = np.array([g.F, g.a, 1.0])\nz.sort(kind='stable')\ny = z",
]
NOT_IN_ORDER = [
    "z = [g.F, g.a, 1.0]\nd = {'a': z}\nd['a'].sort()\ny = z",
    "z = [g.F, g.a, 1.0]\nif g.F > 2:\n    z.sort()\ny = z",
    "z = [g.F, g.a, 1.0]\nz.sort(reverse=g.k > 1)\ny = z",
    "z = [g.F, g.a, np.nan]\nz.sort()\ny = z[0] * 1.0",
    "z = [[g.F, 2], [g.a, 3]]\nw = z[0]\nz.sort(key=lambda r: r[0])\nw[1] = 7\ny = [r[1] * 1.0 for r in z]",
    "z = np.array([g.F, g.a, 1.0])\nw = z\nz.sort(axis=0)\ny = w",
    "z = [3, g.F]\nz.sort()\ny = len(f'{z[0]}') * g.a",
    "a = [g.F, g.a]\nz = a if g.k > 1 else [1.0, g.a]\nz.sort()\ny = sum(a) + a[0]",
]


@pytest.mark.parametrize("lines", IN_ORDER)
def test_what_is_put_in_order_in_place_is_followed(lines: str, tmp_path: Path) -> None:
    """A list had the order of the present numbers alone; an array along a named axis was told."""
    assert_all_followed(lines, tmp_path)


@pytest.mark.parametrize("lines", NOT_IN_ORDER)
def test_what_is_put_in_order_otherwise_is_never_stale(lines: str, tmp_path: Path) -> None:
    """Lists that have other names somewhere, an order that inputs tell, what has no order."""
    assert_never_stale(lines, tmp_path)
