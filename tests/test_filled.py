"""Arrays into which numpy's functions put numbers: `np.maximum(F, 0, out=F)`, `np.fill_diagonal(K, k)`."""

from pathlib import Path

import pytest
from never_stale import assert_never_stale
from own_worksheet import own, recorded

FILLED = [
    "z = x * g.F\nnp.maximum(z, 2.0 * g.a, out=z)\ny = z",
    "z = x * g.F\nv = z\nnp.clip(z, 1, 3 * g.a, out=z)\ny = v",  # under another name too
    "z = np.zeros(len(x))\nnp.add(x, g.F, out=z)\ny = z",
    "z = x * g.F\nnp.cumsum(z, out=z)\ny = z",
    "def f(v):\n    w = v * 1\n    np.maximum(w, g.a, out=w)\n    return w\ny = f(x * g.F)",
    "z = x * 1\nnp.copyto(z, g.F, where=x > g.a)\ny = z",
    "z = np.zeros((3, 3))\nnp.fill_diagonal(z, g.F)\ny = z.ravel()",
    "z = x * 1\nnp.putmask(z, z > g.F, g.a)\ny = z",
    "z = x * 1\nnp.place(z, z > g.F, [g.a])\ny = z",
    "z = x * 1\nnp.put(z, [0, 2], [g.F, g.a])\ny = z",
    "z = np.array([1, 2, 3])\nnp.copyto(z, 7)\ny = z * g.F",  # of numbers alone
    "z = np.zeros(3)\nfor i in range(3):\n    np.put(z, [i], g.F * i)\ny = z",
]
TOLD = [
    "z = x * 1\nnp.add(z, g.F, out=z, where=z > g.a)\ny = z",
    "z = np.zeros(3)\nnp.copyto(z[1:], g.F)\ny = z",
    "z = x * 1\nnp.putmask(z, z > g.F, [g.a, 1.0])\ny = z",
]


@pytest.mark.parametrize("lines", FILLED)
def test_what_numpy_puts_into_an_array_follows(lines: str, tmp_path: Path) -> None:
    assert_never_stale(lines, tmp_path)
    assert not recorded(own(tmp_path, lines))[1].gaps


@pytest.mark.parametrize("lines", TOLD)
def test_what_is_put_otherwise_is_told(lines: str, tmp_path: Path) -> None:
    assert_never_stale(lines, tmp_path)
    assert recorded(own(tmp_path, lines))[1].gaps
