"""`np.r_` and `np.c_`: what stands in their square brackets is followed, and read as it is written."""

from pathlib import Path

import pytest
from in_tex import typeset
from never_stale import assert_never_stale
from own_worksheet import own, recorded

PUT = [
    "y = np.r_[0.0, x, g.F]",
    "y = np.r_[x[:2], [1, 2], g.F > 2, x[::-1]] * g.a",
    "y = np.r_[0:g.F:5j, g.a]",
    "y = np.r_[0 : g.k + 2, g.F]",
    "y = np.r_[3:0:-1, g.a] * g.F",
    "from numpy import c_, r_\ny = r_[c_[x, g.F * x][:, 1], 1:3]",
    "A = np.c_[x, x**2, np.ones(len(x)) * g.F]\ny = A @ np.array([g.a, 2.0, 1.0])",
    "A = np.c_[np.array([[1.0, g.F], [2, 3]]), [g.a, 4]]\ny = A.ravel()",
    "A = np.r_[np.array([[1.0, g.F]]), np.array([[g.a, 4]])]\ny = A.sum(0)",
    "y = np.c_[g.F, g.a][0]",
    "A = np.r_[x, 1]\nA[0] = g.F\ny = A * x[0]",  # another array
]


@pytest.mark.parametrize("lines", PUT)
def test_what_is_put_together_follows(lines: str, tmp_path: Path) -> None:
    assert_never_stale(lines, tmp_path)
    assert not recorded(own(tmp_path, lines))[1].gaps


def test_a_text_that_tells_how_is_told(tmp_path: Path) -> None:
    (gap, *_) = recorded(own(tmp_path, 'y = np.r_["0,2", x, x * g.F][1]'))[1].gaps
    assert "a text in numpy's r_" in str(gap)


@pytest.mark.parametrize(
    ("source", "tex"),
    [
        ("np.r_[0, L, 5.0]", r"\left[0,\ L,\ 5\right]"),
        ("np.c_[x, y] @ b", r"\begin{bmatrix} x & y \end{bmatrix}\,b"),
        ("np.r_[0:5, x]", r"\left[0\,\ldots\,4,\ x\right]"),
        ("np.r_[0:1:5j]", r"\left[0,\ 0.25\,\ldots\,1\right]"),
    ],
)
def test_it_is_a_list_or_a_matrix(source: str, tex: str) -> None:
    assert typeset(source) == tex
