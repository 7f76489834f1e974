"""Arrays changed under another name, or in place by numpy; with decimals where all were whole; of other lengths."""

from pathlib import Path

import pytest
from never_stale import assert_never_stale
from own_worksheet import OTHER, assert_followed, own, recorded

SHARED = [  # by names that show elements of what is changed
    "w = np.arange(5.0)\nv = w[1:]\nif g.F > 3:\n    w += 1.0\ny = v.sum()",
    "w = x * 1.0\nv = w[::2]\nw[-1] *= g.a\ny = v.sum()",
    "w = np.outer([1.0, 2.0, 3.0, 4.0], [1.0, g.F])\nv = w[g.k]\nif g.a > 1:\n    v += 1.0\ny = w.sum()",
    "w = x * 1.0\nv = w.reshape(-1)\nv += g.F\nw[::2] = g.a\ny = v.sum()",
    "w = np.array([math.gamma(q + g.k + 3) for q in range(3)])\nv = w\nw[0] = g.F\ny = v.sum()",
    "w = np.arange(4) * g.F\ndef f(v):\n    if g.a > 1:\n        v[0] = 9.0\n    return v.sum()\nz = f(w)\ny = w.sum()",
    "w = np.arange(4) * g.F\ndef f(v):\n    v[0] = g.a\n    return v.sum()\nz = f(w)\ny = w.sum()",
]
IN_PLACE = [  # what changes nothing with the inputs that are recorded
    "w = np.arange(4) * (g.F - 2)\nw.sort()\ny = w[0] + 2 * w[3]",
    "w = x * 1.0\nnp.clip(w, 0, 6, out=w)\ny = w.sum()",
    "w = x * 1.0\nw.clip(0, 6, out=w)\ny = w.sum()",
    "w = x * 1.0\nnp.maximum(w, 0.15 * g.a, out=w)\ny = w.sum()",
    "w = x * 1.0\nw.fill(g.F)\ny = w.sum()",
    # Parts of an array, which has no name there.
    "w = np.array([1.0, g.F, 3.0])\nw[:2].sort()\ny = w[0] * 1.0",
    "w = np.array([[1.0, g.F], [1.875 * g.a, 3.0]])\nw.T.sort()\ny = w[0] @ [1.0, 2.0]",
    "w = np.array([1.0, g.F, 2.0])\nnp.maximum(w[:2], 1.25 * g.a, out=w[:2])\ny = w[0] * 1.0",
    "w = np.array([1.0, g.F, 3.0])\nnp.copyto(w[:2], np.minimum(w[:2], g.F))\ny = w[0] * 1.0",
    "w = np.array([1.0, g.F, 3.0])\nnp.add(w[:1], min(g.F, 1.0) - 1.0, w[:1])\ny = w[0] * 1.0",
    "w = np.array([1.0, g.F, 3.0])\nw.ravel().sort()\ny = w[2] * 1.0",
    "w = np.array([1.0, g.F, 3.0])\nw[:2][0] = min(1.0, g.F)\ny = w[0] * 1.0",
    # By way of what holds them, which is all that is changed.
    "w = np.array([1.0, g.F, 3.0])\nv = [w]\nv[0] *= max(1.0, g.F / 3)\ny = w[1] * 1.0",
    "w = np.array([1.0, g.F, 3.0])\nv = {'a': w}\nv['a'] *= max(1.0, g.F / 3)\ny = w[1] * 1.0",
    "w = np.array([1.0, g.F, 3.0])\nv = {'a': w}\nv['a'].sort()\ny = w[1] * 1.0",
    "w = np.array([1.0, g.F, 3.0])\nv = [w]\nv[0][:2].sort()\ny = w[0] * 1.0",
    "w = np.array([1.0, g.F, 3.0])\nv = [w]\nv[0][0] = min(1.0, g.F)\ny = w[0] * 1.0",
    "w = np.array([[1.0, g.F], [2.0, 3.0]])\nfor v in w:\n    v.sort()\ny = w[0] @ [1.0, 2.0]",
    "w = np.array([[1.0, g.F], [2.0, 3.0]])\nfor v in w:\n    v[0] = min(v[0], g.F)\ny = w.sum(axis=1)[0]",
    "w = np.array([1.0, g.F, 3.0])\nd = {'a': w}\nfor name, v in d.items():\n    v.sort()\ny = w[1] * 1.0",
    "w = np.array([1.0, g.F, 3.0])\nd = {'a': w}\nnp.maximum(w, 1.25 * g.a, out=d['a'])\ny = w[0] * 1.0",
    "w = [np.array([1.0, g.F]), np.array([2.0, g.a])]\nfor v in w:\n    v *= max(1.0, g.F / 3)\ny = w[0].sum()",
    "w = np.outer([1.0, 2.0], [1.0, g.F])\nfor v in w:\n    v += max(0.0, g.F - 3)\ny = w.sum()",
    "w = {'a': np.array([1.0, g.F])}\nfor v in w.values():\n    v += max(0.0, g.F - 3)\ny = w['a'].sum()",
    "w = np.array([1.0, g.F])\nfor v in (w, x * 1.0):\n    v += max(0.0, g.F - 3)\ny = w.sum()",
    "class Held:\n    pass\nw = np.array([1.0, g.F])\nv = Held()\nv.w = w\nv.w *= max(1.0, g.F / 3)\ny = w[1] * 1.0",
    "w = np.outer([1.0, 2.0], [0.5, g.F])\nw[0, 0] = w[1, 1] = 2.5 * g.a\nnp.fill_diagonal(w, 1.875)\ny = w.sum()",
]
FORMS = [  # of what is no array
    "w = [g.F, g.a, 7.0]\ny = w[min(g.k, 2) - 2] * g.F",
    "w = (x > 0.5) * 1\nw[0] = 4 * g.a\ny = w.sum() * 1.0",
    "w = (x > 0.5) / 1\nw[0] = 4 * g.a\ny = w.sum() * 1.0",
]
WHOLE = [  # of which numpy makes whole ones
    "y = np.piecewise(g.k + 1, [g.k < 0, g.k >= 0], [0, 0.5 * (g.k + 1)]) * 1.0",
]
DECIMALS = [  # in an array that looks as if it had whole numbers alone
    "w = np.arange(6) * 1.0\nw[g.k] *= 2 * g.a\ny = w.sum()",
    "w = np.arange(6.0)[::2]\nw[1] = 4 * g.a\ny = w.sum()",
    "w = np.array([g.k, g.n]).astype(float) + 0\nw[1] = 4 * g.a\ny = w.sum()",
    "w = np.arange(4) / 1\nw[0] = 7\nw[1] = 4 * g.a\ny = w.sum()",
    "w = np.ones_like(np.arange(3))\nw[0] = 4 * g.a\ny = w.sum() * 1.0",
]
LENGTHS = [  # of what is not followed
    "w = np.partition(np.append(x, g.a), 0)\ny = len(w) * 1.0",
    "w = np.partition(np.append(x, g.a), 0)\ny = np.where(g.F > 9, w, 0.5).sum()",
    "w = np.partition(np.append(x, g.a), 0)\ny = np.meshgrid([1.0, 2.0], w)[0].sum()",
]
GUARDED = [  # which asks first whether there is one
    "w = np.array([1.0, 2.0, 4.0])\ny = 3.0 if g.k < 3 and w[g.k] > 3 else g.F",
    "w = np.array([1.0, 2.0, 4.0])\nif g.k < 3:\n    y = 1.0 if w[g.k] > 3 else 2.0\nelse:\n    y = g.F",
    "y = g.F if g.F <= 2 or math.sqrt(g.F - 2) > 5 else 2.0",
    "w = np.array([3.0, 1.0, 2.0]) * g.F\ny = 3.0 if w[np.argmax(w)] > 8 else g.F",
    "w = x * 1.0\nw[np.argmax(w)] = g.a\ny = w.sum()",
    "def f(v):\n    w = np.zeros(3)\n    w[0] = v[1]\n    return w.sum() if g.a > 1 else w[0]\ny = x * f(x)",
]


@pytest.mark.parametrize("lines", [*SHARED, *IN_PLACE, *DECIMALS, *LENGTHS, *GUARDED, *FORMS, *WHOLE])
def test_no_number_is_stale(lines: str, tmp_path: Path) -> None:
    assert_never_stale(lines, tmp_path)


@pytest.mark.parametrize("lines", GUARDED)
def test_what_asks_first_is_followed(lines: str, tmp_path: Path) -> None:
    sheet = own(tmp_path, f"{lines}\nresult = np.atleast_1d(y) * 1  # [-] line")
    _, recording = recorded(sheet)
    assert_followed(sheet, recording, OTHER)
