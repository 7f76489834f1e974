"""Several names of one array, or of parts of it: what changes it under one of them changes it under all."""

from pathlib import Path

import pytest
from never_stale import assert_never_stale
from own_worksheet import own, recorded

TWO = "w = np.array([1.0, 2.0, 3.0, 4.0]) * g.F\nv = w\n"
PART = "w = np.array([1.0, 2.0, 3.0, 4.0]) * g.F\nv = w[1:3]\n"
MATRIX = "A = np.outer([1.0, 2.0, 3.0], [2.0, 1.0, 5.0]) * g.F\n"
FOLLOWED = [
    "w = x\nw[0] = g.F\ny = w + x",
    "w = x * g.F\nv = w\nw[w > 100 * g.a] = 0.0\ny = v",  # for other inputs alone
    "u = v = x * g.F\nu[0] = g.a\ny = v",
    f"{TWO}v[0] = g.a\nw[1] = g.a\ny = w + v * 10",
    f"{TWO}z = v * 2\nw[0] = g.a\ny = w + z",
    f"{TWO}w += 1\ny = v",
    f"{TWO}w[0] = v[1] * g.a\ny = v",
    f"{TWO}w[0], w[1] = w[1], w[0]\ny = v",
    f"{TWO}if g.F > 3:\n    w[0] = g.a\ny = v",
    f"{TWO}for i in range(1, 3):\n    w[i] = w[i - 1] * g.a\ny = v",
    f"{TWO}w.sort()\ny = v[::-1]",
    f"{TWO}w = w + 1\nv[0] = g.a\ny = w + v",
    f"{TWO}def f(k):\n    return v[k] * 2\nw[0] = g.a\ny = f(0)",
    f"{TWO}w[0] = v[2]\nu = v[::-1]\nu[0] = g.a\ny = w + v * 10 + u * 100",
    f"{PART}v[0] = g.a\ny = w",
    f"{PART}w[1] = g.a\ny = v",
    f"{PART}v -= v.mean()\ny = w",
    f"{PART}w = w * 1\nv[0] = g.a\ny = w",
    f"{PART}v = v * 1\nv[0] = g.a\ny = w",
    f"{MATRIX}r, c = A[1], A[:, 1]\nr[1] = g.a\ny = c",
    f"{MATRIX}r, c = A[1], A[:, 1]\nc *= 2\ny = np.append(A.ravel(), r)",
    f"{MATRIX}D = A.T\nA[0, 2] = g.a\ny = D.ravel()",
    f"{MATRIX}D = A.T\nA += D\ny = D.ravel()",
    "w = x * g.F\nv = w.reshape(-1, 1)\nv[0] = g.a\ny = w",
    "w = np.zeros(3)\nv = w[::2]\nv[0] = g.F\nw[2] = g.a\ny = v",
    "w = np.array([1, 2, 3])\nv = w\nv[0] = g.F * 10\ny = w / 2",  # of whole numbers
    "z = x * (1 + 1j * g.F)\nv = z\nv[0] = g.a * 1j\ny = z.real + z.imag",
]
COPIES = [  # or none, by how numpy has put the elements
    f"{MATRIX}v = {shown}\nv[{place}] = g.a\ny = A.ravel()"
    for shown, place in (("A.T.ravel()", "4"), ("A.reshape(9)", "4"), ("np.ascontiguousarray(A.T)", "1, 2"))
] + [
    f"{MATRIX}v = {shown}\nv[{place}] = max(v[{place}], 20 * g.a)\ny = A.ravel()"  # nothing now
    for shown, place in (("A.T.ravel()", "4"), ("(A.T * 1).ravel()", "4"), ("np.ascontiguousarray(A.T)", "1, 2"))
]
CHOSEN = [  # by what Python looks at: another array is changed for other inputs
    f"a, b = np.ones(2), np.ones(3)\nc = a if g.F > 2 else b\nc[0] = {value}\ny = sum({name})"
    for value in ("5.0", "max(1.0, g.a * 0.9)")
    for name in "ab"
]


@pytest.mark.parametrize("lines", FOLLOWED)
def test_a_change_under_one_name_follows_under_the_others(lines: str, tmp_path: Path) -> None:
    assert_never_stale(lines, tmp_path)
    assert not recorded(own(tmp_path, lines))[1].gaps


@pytest.mark.parametrize("lines", [*COPIES, *CHOSEN])
def test_what_may_be_another_array_is_never_stale(lines: str, tmp_path: Path) -> None:
    assert_never_stale(lines, tmp_path)


@pytest.mark.parametrize("array", ["['a', 'b']", "[1.5, 2.5], dtype=np.float32", "[(1.0,)], dtype=[('a', float)]"])
def test_an_array_of_other_values_ends_no_recording(array: str, tmp_path: Path) -> None:
    lines = f"w = np.array({array})\nv = w\nv[0] = v[-1]\ny = g.F"
    assert_never_stale(lines, tmp_path)


def test_texts_that_a_condition_chooses_hold_while_it_does(tmp_path: Path) -> None:
    lines = "names = np.array(['a', 'b']) if g.F > 2 else np.array(['a'])\ny = g.F * len(names)"
    assert_never_stale(lines, tmp_path)
    assert not recorded(own(tmp_path, lines))[1].gaps


def test_what_else_knows_the_array_is_told(tmp_path: Path) -> None:
    for more in ("L = [v]\nw[0] = g.a\ny = L[0]", "for i in range(1, 3):\n    w[i] = v[i - 1]\ny = v"):
        assert_never_stale(TWO + more, tmp_path)
        (gap, *_) = recorded(own(tmp_path, TWO + more))[1].gaps
        assert "has another name too" in gap.reason
