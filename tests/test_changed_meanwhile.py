"""Arrays that are changed by who goes through them, followed for other inputs."""

from pathlib import Path

import pytest
from never_stale import assert_never_stale
from own_worksheet import ELSEWHERE, assert_followed, own, recorded

NUMBERS = "z = np.array([1.0, g.F, 3.0, g.a])\n"
FOLLOWED = [
    NUMBERS + "for i, v in enumerate(z):\n    z[i] = v * g.a\ny = z",
    NUMBERS + "i = 0\nfor v in z:\n    z[i] = v * g.a + z[0]\n    i += 1\ny = z",
    NUMBERS + "for i, v in enumerate(z):\n    z[(i + 1) % 4] += v * g.a\ny = z * v",
    NUMBERS + "w = z + g.a\nfor i, (v, u) in enumerate(zip(z, w)):\n    z[i] = v * u\n    w[i] = z[i] + u\ny = z + w",
    NUMBERS + "for i, v in enumerate(z[1:]):\n    z[i] = v - z[i]\ny = z",
    NUMBERS + "for i, v in enumerate(z[:-1], start=1):\n    z[i] += v * g.a\ny = z",
    NUMBERS + "for v in z:\n    z *= g.a\ny = z + v",
    NUMBERS + "for v in z:\n    z.fill(v + g.a)\ny = z + v",
    NUMBERS + "for i, v in enumerate(z):\n    if v > g.a:\n        z[i] = g.a\ny = z",
    NUMBERS + "for i, v in enumerate(z):\n    for k, u in enumerate(z):\n        z[k] = u + 0.5 * v\ny = z",
    "z = np.zeros(4)\nfor i, v in enumerate(z):\n    z[i] = g.F * i + v\ny = z",
    NUMBERS + "def scaled(u):\n    z = u * 1.0\n    for i, v in enumerate(z):\n        z[i] = v * g.a\n    return z\n"
    "y = scaled(z) + z",
    # no arrays, whose elements are looked at as ever
    "z = [1.0, g.F, 3.0]\nfor i, v in enumerate(z):\n    z[i] = v * g.a\ny = np.array(z)",
    "d = {'a': 1.0, 'b': g.F}\nfor k in d:\n    d[k] = d[k] * g.a\ny = d['a'] + d['b']",
    "z = [1.0, g.F]\nfor v in z:\n    if len(z) < 4:\n        z += [v * g.a]\ny = np.array(z)",
    # another array under the name, which nobody goes through
    NUMBERS + "for i, v in enumerate(z):\n    z = z * 1.0\n    z[i] = v + g.a\ny = z",
]
TOLD = [
    NUMBERS + "w = z\nfor i, v in enumerate(z):\n    z[i] = v * g.a\ny = w",
    "z = np.outer([1.0, g.F], [1.0, g.a])\nfor i, r in enumerate(z):\n    z[1] += r\ny = z.sum(axis=0)",
    "z = x[x > g.a]\nfor i, v in enumerate(z):\n    z[i] = v * 2.0 + g.F\ny = z",
]


@pytest.mark.parametrize("lines", [*FOLLOWED, *TOLD])
def test_what_goes_through_an_array_that_it_changes_is_never_stale(lines: str, tmp_path: Path) -> None:
    assert_never_stale(lines, tmp_path)


@pytest.mark.parametrize("lines", FOLLOWED)
def test_an_array_is_changed_by_who_goes_through_it(lines: str, tmp_path: Path) -> None:
    """It had another name, the one who went through it: all that rests on it kept the document's numbers."""
    sheet = own(tmp_path, f"{lines}\nresult = np.atleast_1d(y) + g.F  # [-] line")
    _, recording = recorded(sheet)
    assert not recording.gaps
    assert_followed(sheet, recording, ELSEWHERE)
