"""Arrays that objects, dictionaries and lists hold, whose elements are set: followed for other inputs, or told."""

from pathlib import Path

import pytest
from never_stale import assert_never_stale
from own_worksheet import ELSEWHERE, assert_followed, own, recorded

LATER = "max(1.0, g.a * 1.3)"  # which is no change now, and is one for other inputs
MODEL = f"""class Model:
    def __init__(self):
        self.K, self.n, self.hist = np.ones(3), 0, []
    def step(self, h=1.0):
        self.K[0] = {LATER} * h
        self.n += 1
m = Model()
"""
SPACE = "from types import SimpleNamespace as S\no = S(K=np.ones(3), n=1)\n"
HELD = 'd = {"a": np.ones(3), "b": np.zeros(3)}\n'
TWO = "L = [np.ones(3), np.zeros(3)]\n"

FOLLOWED = [
    MODEL + "m.step()\nm.step(g.F)\ny = m.K * m.n",
    MODEL.replace("self.n += 1", "self.hist.append(self.K.copy())") + "m.step()\nm.step(g.F)\ny = m.hist[0] + m.K",
    MODEL.replace("self.n += 1", "self.K[1:] += g.a\n        self.K *= h") + "m.step()\nm.step(g.F)\ny = m.K",
    MODEL.replace("self.n += 1", "for i in range(2):\n            self.K[i + 1] = self.K[i] + g.a")
    + "m.step()\ny = m.K",
    MODEL + "class Other(Model):\n    def f(self):\n        self.K[1] = g.a\nm = Other()\nm.f()\ny = m.K",
    MODEL + "p = Model()\nfor i, each in enumerate((m, p)):\n    each.K[i] = g.F * g.a\ny = m.K + 10 * p.K",
    MODEL + "def change(each):\n    each.K[1] = g.a\nchange(m)\ny = m.K",
    MODEL + "p = m\nm.step()\nh = lambda: m.K[0]\ny = p.K + h()",
    SPACE + "o.K[o.n] = g.F\no.K[0] += g.a\no.K *= g.a\ny = o.K",
    SPACE + "o.K[1:] = o.K[:-1] * g.F\no.K[o.K < 2] = 0.0\ny = o.K",
    "import functools\nclass C:\n    @functools.cached_property\n    def K(self):\n        return np.ones(3)\n"
    "c = C()\nc.K[1] = g.F\ny = c.K",
    "class C:\n    K = np.zeros(3)\n    def add(self, v):\n        C.K[0] += v * g.a\nC().add(1.0)\ny = C.K + C().K",
    HELD
    + "for i in range(2):\n    d['a'][i + 1] = d['a'][i] + g.a * d['b'][i]\n    d['b'][i] -= g.F\ny = d['a'] + d['b']",
    HELD + "for k in d:\n    for i in range(3):\n        d[k][i] = g.F * i + g.a\ny = d['a'] + d['b']",
    HELD + "def f(q, i):\n    q['a'][i] = g.a\nf(d, 0)\nf(d, 2)\ny = d['a']",
    TWO + "for i in range(2):\n    L[i][i] = L[1 - i][i] + g.a\n    L[-1][2] = g.F\ny = L[0] + 10 * L[1]",
    "from collections import defaultdict\nd = defaultdict(lambda: np.zeros(2))\nd['a'][0] = g.F\nd['b'][1] += g.a\n"
    "y = d['a'] + d['b']",
    "T = {'a': {'b': np.ones(2), 'c': [1.0]}}\nT['a']['b'][1] = g.a\nT['a']['c'][0] = g.F\n"
    "y = T['a']['b'] + T['a']['c'][0]",
]
TOLD = [
    # another name, which sees what is changed later
    "z = np.ones(3)\n" + MODEL + f"m.K = z\nm.K[1] = {LATER}\ny = z + m.K",
    MODEL + "w = m.K\nm.step()\ny = w + m.K",
    MODEL + "v = m.K[:2]\nm.step()\ny = v[0] + m.K",
    MODEL.replace("self.n += 1", "self.hist.append(self.K)") + "m.step()\nm.step(g.F)\ny = m.hist[0] + m.K",
    MODEL.replace("        self.K[0]", "        self.old = self.K\n        self.K[0]") + "m.step()\ny = m.old + m.K",
    MODEL + "from copy import copy\np = copy(m)\nm.step()\ny = p.K",
    MODEL + "d = vars(m)\nm.step()\ny = d['K'] * 1.0",
    "class C:\n    K = np.ones(3)\na, b = C(), C()\n" + f"a.K[1] = {LATER}\ny = b.K * g.F",
    "z = np.ones(3)\nd = {'a': z}\n" + f"d['a'][0] = {LATER}\ny = z + d['a']",
    "z = np.ones(3)\nL = [z, z]\n" + f"L[0][0] = {LATER}\ny = L[1] + z",
    "L = [np.ones(2)] * 3\n" + f"L[0][0] = {LATER}\ny = L[0] + L[1]",
    HELD + f"e = dict(d)\nd['a'][0] = {LATER}\ny = e['a'] * g.F",
    HELD + f"it = iter(d.values())\nd['a'][0] = {LATER}\ny = next(it) * g.F",
    HELD + "k = 'a' if g.F > 3 else 'b'\nd[k][0] = 5.0 * g.a\ny = d['a'] + 10 * d['b']",
    TWO + "L[g.k % 2][0] = 5.0 * g.a\ny = L[0] + 10 * L[1]",
    # objects that do more than to keep what is set
    "class C:\n    def __init__(self):\n        self._k, self.n = np.ones(3), 0.0\n    @property\n    def K(self):\n"
    "        return self._k\n    @K.setter\n    def K(self, v):\n        self._k, self.n = v, v[1] - 1.0\n"
    f"c = C()\nc.K[1] = {LATER}\ny = c.K + c.n",
    "class C:\n    def __init__(self):\n        self.K = np.ones(3)\n    def __setattr__(self, name, v):\n"
    "        vars(self).update({name: v, 'n': v[1] - 1.0})\n" + f"c = C()\nc.K[1] = {LATER}\ny = c.K + c.n",
    "from dataclasses import dataclass, field\n@dataclass(frozen=True)\nclass P:\n"
    f"    K: object = field(default_factory=lambda: np.ones(3))\no = P()\no.K[1] = {LATER}\ny = o.K * g.F",
]


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("lines", [*FOLLOWED, *TOLD])
def test_arrays_that_are_held_are_never_stale(lines: str, tmp_path: Path) -> None:
    assert_never_stale(lines, tmp_path)


@pytest.mark.parametrize("lines", FOLLOWED)
def test_arrays_that_are_held_follow(lines: str, tmp_path: Path) -> None:
    """All that rests on the state of an object kept the document's numbers."""
    sheet = own(tmp_path, f"{lines}\nresult = np.atleast_1d(y) + g.F  # [-] line")
    _, recording = recorded(sheet)
    assert not recording.gaps
    assert_followed(sheet, recording, ELSEWHERE)
