"""Lists, tuples and texts that are as often as a number of the worksheet says: they are no products."""

from pathlib import Path

import pytest
from never_stale import assert_never_stale
from own_worksheet import own, recorded

from mechsheet import evaluate

FORMS = [
    "m = 1 if g.F < 3 else 2\nL = [1.0, g.a] * m\ny = sum(L)",
    "m = 1 if g.F < 3 else 2\nL = m * [1.0, g.a]\ny = len(L)",
    "m = int(g.F)\nL = (g.a, 1.0) * m\ny = np.array(L)",
    "m = math.ceil(g.F)\nL = [g.a] * m\nL[0] = g.F\ny = sum(L)",
    "L = [1.0, g.a]\nL *= int(g.F)\ny = sum(L)",
    "L = [1.0, g.a]\nM = L\nM *= 1 if g.F < 3 else 2\ny = sum(L)",
    "L = [0.0] * g.n\nfor i in range(g.n):\n    L[i] = i * g.a\ny = np.array(L)",
    "L = [[0.0] * g.k for _ in range(2)]\ny = len(L[1]) + g.F",
    "L = [None] * (g.n // 2)\ny = len(L) + g.F",
    "t = 'ab' * int(g.F)\ny = len(t) + g.a",
    "x1 = np.array([2.0])\ny = [g.F, g.a] * x1 * np.array([g.a])",
]


@pytest.mark.parametrize("lines", FORMS)
def test_what_is_as_often_as_a_number_says_is_never_stale(lines: str, tmp_path: Path) -> None:
    assert_never_stale(lines, tmp_path)


def test_a_list_twice_is_no_list_of_the_double(tmp_path: Path) -> None:
    """All readers, and who asks for the result again, had the sum of one list of two times its numbers."""
    lines = "m = 1 if g.F < 3 else 2\nL = [1.0, g.a] * m\nresult = np.array([len(L), L[-1]])  # [-] line"
    sheet = own(tmp_path, lines)
    _, recording = recorded(sheet)
    assert not recording.gaps
    for F, count in ((2.6, 2), (2.7, 2), (3.5, 4), (3.6, 4)):
        assert list(evaluate(sheet.path, ["result"], F=F)["result"]) == [count, 0.75]
