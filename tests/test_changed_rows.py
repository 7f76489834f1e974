"""Rows of a matrix and arrays of a list that are changed by the loop which goes through them, for other inputs."""

from pathlib import Path

import pytest
from never_stale import assert_never_stale
from own_worksheet import ELSEWHERE, assert_followed, own, recorded, value_of

TWOS = "A = np.ones((3, 3)) * 2\n"
NOW = "(g.F - 1.5)"  # 1 for the inputs of the worksheet: there it changes nothing
LISTED = "L = [np.ones(3) * 2, np.ones(3) * g.a]\n"
FOLLOWED = [
    TWOS + f"for r in A:\n    r *= {NOW}\ny = A[1]",
    TWOS + "for r in A:\n    r /= r.sum() + g.a\ny = A[:, 2]",
    TWOS + f"for i, r in enumerate(A):\n    r[i] += {NOW} - 1\ny = A.sum(axis=0)",
    TWOS + f"for i, r in enumerate(A):\n    if i == 1:\n        continue\n    r[0] = {NOW} + 1\ny = A[:, 0]",
    TWOS + f"for r, k in zip(A, (g.F, g.a, {NOW})):\n    r[1:] *= k\ny = A.sum(axis=1)",
    TWOS + "for t, r in zip(x[:3], A):\n    r[0] = t\n    r[1] = np.sin(t) * r[0]\ny = A[:, 1]",
    TWOS + "for r in reversed(A):\n    r.fill(g.a)\n    r[0] = g.F\n    r.sort()\ny = A[2]",
    TWOS + "for r in A:\n    r[r > g.a] = g.F\ny = A[0]",
    TWOS + "for r in A:\n    if r[0] > g.a:\n        r[0] = g.F\ny = A[:, 0]",
    "A = np.arange(6).reshape(3, 2)\nfor r in A:\n    r[0] = g.F\ny = A[:, 0]",
    TWOS + f"def scale(M, k):\n    for r in M:\n        r *= k\n    return M.sum()\ns = scale(A, {NOW})\ny = A[0] + s",
    TWOS + "def scaled(M):\n    M = M.copy()\n    for r in M:\n        r *= g.a\n    return M\ny = scaled(A)[1] + A[1]",
    LISTED + f"for s in L:\n    s *= {NOW}\ny = L[0] + L[1]",
    LISTED + f"for i, s in enumerate(L):\n    s[i] = {NOW} + 1\ny = L[0] + L[1]",
    LISTED + f"def scale(L, k):\n    for s in L:\n        s *= k\nscale(L, {NOW})\ny = L[0] - L[1]",
    f"L = [np.zeros(2), 3.0]\nfor s in L:\n    s += {NOW}\ny = L[0] + L[1] + s",
    # what is no array of its own stays what it is
    f"z = np.ones(3) * g.F\nfor v in z:\n    v += {NOW}\ny = z + v",
    f"z = [1.0, g.F]\nfor v in z:\n    v *= {NOW}\ny = np.array(z) + v",
    "z = [[g.F, 1.0], [g.a, 2.0]]\nfor p in z:\n    p += [3.0]\n    p[0] = g.a\ny = np.array(z)[:, 0]",
    f"z = [{{'m': g.F}}, {{'m': g.a}}]\nfor d in z:\n    d['m'] += {NOW}\ny = z[0]['m'] - z[1]['m']",
    f"A = np.zeros((0, 2))\nfor r in A:\n    r *= {NOW}\ny = A.sum() + g.F",
]
TOLD = [
    f"A = np.zeros((2, 2, 2))\nfor M in A:\n    for r in M:\n        r[0] += {NOW}\ny = A[1].sum(axis=0)",
    TWOS + f"B = A\nfor r in A:\n    r *= {NOW}\ny = B[1]",
    TWOS + f"v = A[1]\nfor r in A:\n    r *= {NOW}\ny = v",
    TWOS + f"for r in A:\n    r *= {NOW}\nr[0] = g.F\ny = A[2]",
    TWOS + f"for r in A:\n    r *= {NOW}\nA[2] = {NOW} + 1\ny = r",
    TWOS + f"kept = []\nfor r in A:\n    r *= {NOW}\n    kept.append(r)\nA[0, 0] += {NOW} - 1\ny = kept[0]",
    TWOS + f"for r in A:\n    w = r\n    w *= {NOW}\ny = A[1]",
    TWOS + f"for r in A:\n    w = r[:1]\n    r *= {NOW}\n    w += {NOW} - 1\ny = A[1]",
    TWOS + f"for r in A:\n    r += A.sum() * ({NOW} - 1)\ny = A[1]",
    TWOS + f"for r in A.T:\n    r *= {NOW}\ny = A[1]",
    TWOS + f"for r in A[1:]:\n    r *= {NOW}\ny = A[:, 1]",
    TWOS + f"for i, r in enumerate(A):\n    if r[0] > 5 * g.a:\n        break\n    r *= {NOW}\ny = A[:, 1]",
    TWOS + f"def scale():\n    for r in A:\n        r *= {NOW}\nscale()\ny = A[1]",
    TWOS + f"def scale(k):\n    for r in A:\n        r[0] *= k\nA[0, 0] = g.a\nscale({NOW})\ny = A[1]",
    TWOS + f"def scale(M):\n    for r in M:\n        r *= {NOW}\n    return r\nlast = scale(A)\ny = A[1] + last",
    f"a, b = np.ones(3), np.ones(3)\nL = [a, b]\nfor s in L:\n    s *= {NOW}\ny = a + L[1]",
    f"a, b = np.ones(3), np.ones(3)\nfor s in (a, b):\n    s *= {NOW}\ny = a + b",
    f"a, b = np.ones(3), np.ones(3)\nfor s, k in zip((a, b), ({NOW}, g.a)):\n    s *= k\ny = a + b",
    f"a, b = np.ones(3), np.ones(3)\nfor i, s in enumerate([a, b]):\n    s[i] *= {NOW}\ny = a + b",
    LISTED + f"M = list(L)\nfor s in L:\n    s *= {NOW}\ny = M[0]",
    f"L = [np.zeros(2)] * 3\nfor s in L:\n    s += {NOW}\ny = L[0]",
    f"d = {{'a': np.ones(2), 'b': np.ones(2)}}\nfor v in d.values():\n    v *= {NOW}\ny = d['a']",
]


@pytest.mark.parametrize("lines", [*FOLLOWED, *TOLD])
def test_rows_that_are_changed_are_never_stale(lines: str, tmp_path: Path) -> None:
    assert_never_stale(lines, tmp_path)


@pytest.mark.parametrize("lines", FOLLOWED)
def test_rows_are_changed_by_who_goes_through_them(lines: str, tmp_path: Path) -> None:
    """A row was another name of the matrix, an array one of the list's: all of it kept the document's numbers."""
    sheet = own(tmp_path, f"{lines}\nresult = np.atleast_1d(y) + g.F  # [-] line")
    _, recording = recorded(sheet)
    assert not recording.gaps
    assert_followed(sheet, recording, ELSEWHERE)


MORE = f"([g.a] if {NOW} > 2 else [])"  # nothing for the inputs of the worksheet
ALIASED = [
    TWOS + f"for k in range(3):\n    w = A[k]\n    w *= {NOW}\ny = A[1]",
    TWOS + f"if g.F > 2:\n    w = A[1]\n    w *= {NOW}\ny = A[1]",
    TWOS + f"with np.errstate(all='ignore'):\n    w = A.T[1]\n    w *= {NOW}\ny = A[1]",
    TWOS + f"try:\n    w = np.asarray(A[1])\n    w *= {NOW}\nexcept ValueError:\n    w = 0\ny = A[1]",
    TWOS + f"def row(k):\n    return A[k]\nfor k in range(3):\n    w = row(k)\n    w *= {NOW}\ny = A[1]",
    TWOS + f"for w in (A[k] for k in range(3)):\n    w *= {NOW}\ny = A[1]",
    TWOS + f"for w in map(lambda k: A[k], range(3)):\n    w *= {NOW}\ny = A[1]",
    LISTED + f"i = 0\nwhile i < 2:\n    w = L[i]\n    v = w[:2]\n    v *= {NOW}\n    i += 1\ny = L[0]",
    f"d = {{'a': np.ones(3)}}\nfor k in d:\n    w = d[k] if g.F > 0 else d['a']\n    w *= {NOW}\ny = d['a']",
    f"L = [1.0, g.F]\nif g.F > 2:\n    M = L\n    M += {MORE}\ny = sum(L)",
    f"L = [[1.0], [g.F]]\nfor k in range(2):\n    M = L[k]\n    M += {MORE}\ny = sum(map(sum, L))",
    f"d = {{'p': [1.0]}}\nfor k in d:\n    M = d[k]\n    M += {MORE}\ny = sum(d['p']) + g.F",
    f"L = [1.0, g.F]\nM = L\nM *= 1 if {NOW} < 2 else 2\ny = sum(L)",
    f"s = {{1, 2}}\nif g.n > 2:\n    t = s\n    t |= {{5}} if {NOW} > 2 else set()\ny = sum(s) + g.F",
    "class S:\n    def __init__(self):\n        self.K = np.ones(3)\n    def row(self):\n        return self.K\n"
    f"o = S()\nfor k in range(2):\n    w = o.row()\n    w *= {NOW}\ny = o.K",
]


@pytest.mark.parametrize("lines", [lines.replace(NOW, f) for lines in ALIASED for f in (NOW, "g.F")])
def test_a_part_under_a_name_of_the_statement_s_own_is_never_stale(lines: str, tmp_path: Path) -> None:
    """What failed within it, or on a way that is not gone now, was taken to have changed nothing."""
    assert_never_stale(lines, tmp_path)


def test_numbers_of_an_array_are_added_to_without_a_change_of_it(tmp_path: Path) -> None:
    """Else it would rest on the way that Python goes now."""
    lines = "s = 0.0\nfor k in range(3):\n    v = x[k]\n    if v > g.a:\n        v += 1.0\n    s += v\ny = x"
    _, recording = recorded(own(tmp_path, f"{lines}\nresult = x * 2.0  # [-] line"))
    assert not recording.gaps and not recording.looked.get("result")


UNFOLLOWED = [
    "z = np.ones(3)\nnp.putmask(z, z < 0.5, [g.F, 1.0])",
    "z = np.ones(3)\nnp.put(z, [0], g.F, mode='clip')",
    "z = np.ones(3)\nnp.random.default_rng(int(g.k)).shuffle(z)",
    "z = []\nfor f in (g.F, 2.0):\n    f *= 2\n    z.append(math.ulp(f))",
    "def near(rows, v):\n    return rows\nz = np.ones(3)\nnear(z, g.F)[1] = math.ulp(g.F)",
]


@pytest.mark.parametrize("lines", UNFOLLOWED)
def test_who_cannot_be_followed_changes_no_inputs(lines: str, tmp_path: Path) -> None:
    """All inputs were those of the document for who stands below, and only those that it had read were looked at."""
    _, recording = recorded(own(tmp_path, f"{lines}\nother = g.a * 2.0  # [-] other"))
    (gap,) = recording.gaps
    assert "g" not in gap.names and "int" not in gap.names
    assert value_of(recording, "other", {"F": 3.25, "a": 1.5}) == 3.0


OVERWRITING = [
    f"from scipy.linalg import solve\nz = np.ones(2)\nsolve(np.eye(2) * {NOW}, z, overwrite_b=True)\ny = z",
    f"import scipy.linalg as la\nz = np.ones(2)\nw = la.solve(np.eye(2) * {NOW}, z, overwrite_b=True)\ny = z",
]


@pytest.mark.parametrize("lines", OVERWRITING)
def test_an_array_that_scipy_overwrites_is_never_stale(lines: str, tmp_path: Path) -> None:
    assert_never_stale(lines, tmp_path)


def test_reasons_name_what_users_wrote(tmp_path: Path) -> None:
    """'function' object has no attribute 'at', 'recorded number' object does not support item assignment."""
    for lines, said in (
        ("z = np.zeros(3)\nnp.add.at(z, [0, 0], g.F)\ny = z", "at of a function is not followed"),
        ("A = np.zeros((2, 3))\nA.T[0, 1] = g.F\ny = A[1]", "has no name of its own"),
        ("y = x * 2.0\nL = [y]\nw = L[0]\nw[w > 1.1] = 1.1", "an array is changed that has another name too"),
    ):
        _, recording = recorded(own(tmp_path, f"{lines}\nresult = y * 1.0  # [-] line"))
        assert said in recording.gaps[0].reason


ROWS_OF = "A = np.outer([1.0, 2.0, 3.0], [2.0, 1.0, 5.0]) * g.F\n"
TAKEN = [
    f"{ROWS_OF}for i in range(3):\n    row = A[i]\n    row /= row.sum() * g.a\ny = np.append(A.ravel(), row)",
    f"{ROWS_OF}for i, s in enumerate([1.0, g.a, 2.0]):\n    row = A[i]\n    row[1] *= s\ny = A.ravel()",
    f"{ROWS_OF}for i in [0, 0, 1]:\n    row = A[i]\n    row *= g.a\ny = A.ravel()",
    f"{ROWS_OF}for i in range(3):\n    row = A[i]\n    for j in range(3):\n        row[j] += i * g.a\ny = A.ravel()",
    f"{ROWS_OF}def f(A):\n    B = A * 1\n    for i in range(3):\n        r = B[i]\n        r -= r.mean() * g.a\n"
    "    return B\ny = f(A).ravel()",
    "L = [x * g.F, x * g.a]\nfor i in range(2):\n    v = L[i]\n    v *= 2\ny = L[0] + L[1] * v",
    "w = x * g.F\nfor i in range(3):\n    v = w[i]\n    v *= 2\ny = w",  # a number
    "d = {0: 1.0, 1: g.F}\nfor k in (0, 1):\n    v = d[k]\n    v *= g.a\ny = d[0] + d[1] * v",
    # Copies, which change nothing of the array:
    f"{ROWS_OF}for i in ([0, 2], np.array([1])):\n    r = A[i]\n    r *= np.maximum(1, g.a)\ny = A.ravel() * r[0, 0]",
    f"{ROWS_OF}for i in [(0, 1), (1, 2)]:\n    row = A[i]\n    row *= np.maximum(1.0, g.a)\ny = A.ravel() * row",
    f"{ROWS_OF}for i in [True, False]:\n    row = A[i]\n    row *= np.maximum(1.0, g.a)\ny = A.ravel()",
    f"{ROWS_OF}for i in [A[:, 0] < 2, A[:, 0] >= 2]:\n    row = A[i]\n    row *= np.maximum(1.0, g.a)\ny = A.ravel()",
    f"{ROWS_OF}for i in [slice(0, 2), (2, slice(1))]:\n    part = A[i]\n    part *= g.a\ny = A.ravel()",  # and parts
    f"f = lambda r: abs(r).max()\n{ROWS_OF}for i in range(3):\n    r = A[i]\n    r /= f(r)\ny = A.ravel()",
    "def f():\n    A = np.outer(x[:3], x[:3])\n    def s(r):\n        return r.max() if len(r) else later(r)\n"
    "    for i in range(3):\n        r = A[i]\n        r /= s(r) + g.a\n    later = max\n    return A\ny = f().ravel()",
]
TAKEN_TOLD = [
    f"{ROWS_OF}for i in range(3):\n    row = A[i]\n    row /= A.sum() * g.a\ny = A.ravel()",
    f"{ROWS_OF}B = A\nfor i in range(3):\n    row = A[i]\n    row /= row.sum() * g.a\ny = B.ravel()",
    # Functions that read the array while a row of it is taken out:
    f"{ROWS_OF}s = lambda: A.sum()\nfor i in range(3):\n    row = A[i]\n    row /= np.maximum(1, s())\ny = A.ravel()",
    f"{ROWS_OF}def s(i):\n    return A[i].max()\ndef t(i):\n    return s(i)\nfor i in range(3):\n    r = A[i]\n"
    "    r -= np.minimum(r, 0)\n    r /= t(i)\ny = A.ravel()",
    f"{ROWS_OF}def s(k):\n    return A.sum() * k\nfor row in A:\n    row /= max(map(s, [1, 2]))\ny = A.ravel()",
    "d = {0: x * 1.0, 1: x * g.F}\nfor k in (0, 1):\n    v = d[k]\n    v *= g.a\ny = d[0] + d[1]",
]


@pytest.mark.parametrize("lines", TAKEN)
def test_a_row_that_is_taken_first_and_changed_follows(lines: str, tmp_path: Path) -> None:
    assert_never_stale(lines, tmp_path)
    assert not recorded(own(tmp_path, lines))[1].gaps


@pytest.mark.parametrize("lines", TAKEN_TOLD)
def test_a_row_of_what_has_another_name_is_told(lines: str, tmp_path: Path) -> None:
    assert_never_stale(lines, tmp_path)
    assert recorded(own(tmp_path, lines))[1].gaps
