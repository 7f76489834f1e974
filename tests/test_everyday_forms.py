"""Forms of Python in which engineers write a choice: standard sizes, rows of a table, elements set in loops by cases,
and of those that meet a condition.

All are followed for other inputs, without a guard: the next size of a list, the law that was chosen, a matrix filled.
"""

from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from by_cells import by_cells
from never_stale import assert_never_stale
from own_worksheet import ELSEWHERE, assert_followed, own, recorded, value_of
from test_recalculation import MADE, edit, verdicts

from mechsheet import evaluate
from mechsheet.html import write
from mechsheet.quantities.written import Written
from mechsheet.readers.numbers import numbers
from mechsheet.readers.searched import search
from mechsheet.run import report
from mechsheet.worksheet import cells

SIZES = "D = np.array([6.0, 8, 10, 12, 16, 20])\n"
THREADS = "T = [(6.0, 1.0), (8.0, 1.25), (10.0, 1.5)]\n"
NAMED = "T = [('M6', 6, 1.0), ('M8', 8, 1.25), ('M10', 10, 1.5)]\n"
TABLE = "T = np.array([[1, 2.0], [2, 3.0], [3, 4.0]])\n"
KEPT = [
    SIZES + "y = min(d for d in D if d >= 3 * g.F) * g.a",
    SIZES + "y = min([d for d in D if d >= 5 * g.F], default=33.0) * g.a",
    SIZES + "y = max([1 / (d - 3 * g.F) for d in D if d > 3 * g.F])",
    SIZES + "y = [d for d in D if d >= 3 * g.F][0] * g.a",
    SIZES + "y = [d for d in D if d <= 5 * g.F][-1] * g.a",
    SIZES + "y = next((d for d in D if d >= 7 * g.F), 99.0) * g.a",
    SIZES + "y = min(filter(lambda d: d >= 3 * g.F, D)) * g.a",
    SIZES + "def fits(d):\n    return d >= 3 * g.F\nfit = list(filter(fits, D))\ny = fit[0] * g.a + len(fit)",
    SIZES + "fit = list(d for d in D if d >= 3 * g.F)\ny = fit[0] * g.a + len(fit)",
    SIZES
    + "fits = []\nfor d in D:\n    if d >= 3 * g.F:\n        fits.append(d)\ny = fits[0] * g.a + len(fits) + max(fits)",
    (
        SIZES + "names = []\nfits: list[float] = []\nfor k, d in enumerate(D):\n    A = math.pi * d**2 / 4\n"
        "    if g.F / A > 0.04:\n        continue\n    fits.append(A)\n    names.append(k)\n"
        "y = min(fits) * g.a + names[0]"
    ),
    (
        SIZES + "def fitting(need):\n    ok, no = [], 0.0\n    ok = []\n    for d in D:\n        if d >= need:\n"
        "            if d < 18:\n                ok.append(d)\n    return ok[0] if ok else 99.0\n"
        "y = fitting(5 * g.F) * g.a"
    ),
    (  # what is bound once a condition holds, names that are bound anew behind the loop
        THREADS
        + "fits = []\nfor d, P in T:\n    d = d * g.a\n    A, u = d**2 - P, g.F / P\n    if A > 60:\n        continue\n"
        "    m = A * u\n    d, e = m + d, 2 * u\n    if d < 20:\n        continue\n    fits.append((d, m * e))\n"
        "d, P = min(fits, key=lambda f: f[1]) if fits else (1.0, 2.0)\ny = d * P + len(fits)"
    ),
    SIZES + "fits = []\nfor v in (d * 2 for d in D):\n    if v >= 6 * g.F:\n        fits.append(v)\ny = fits[0] * g.a",
    (
        "def law(made=[]):\n    made.append(1)\n    n = len(made)\n    return lambda v: v * g.a + n\n"
        "y = sum(map(law(), [g.F, 2.0]))"
    ),
    (
        SIZES + "ok = []\nfor d in D:\n    if d >= 3 * g.F:\n        ok.append(d)\n"
        "y = sum(filter(lambda d: d < 9 * g.F, D)) * g.a + ok[0]"
    ),
    "y = sum(filter(None, [max(g.F - 2.5, 0.0), g.a, 2.0]))",
    "y = sum(map(int, [g.F * 2, g.a, 7.5])) + sum(map(max, [g.F, 2.0], [g.a, 3.0]))",
    "y = sum(map(round, [g.F * 1.3, g.a * 7.2])) + max(map(math.sin, [g.F, g.a]))",
    SIZES + "y = sum(d for d in D if d >= 3 * g.F) + len([d for d in D if d < 3 * g.F if d > g.a])",
    "import itertools\ny = next(n for n in itertools.count(1) if n * n > 4 * g.F) * g.a",
    "y = next((b for a, b in ((1.0, g.a), (3.0, 2.0)) if g.F <= a), 5.0) * 2.0",
    "y = max(v * w for v in (1.0, g.a) for w in (g.F, 2.0) if w > 1.5 * v)",
    NAMED + "row = next(r for r in T if r[1] > 2 * g.F)\ny = row[1] * row[2]",
    (
        "from collections import namedtuple\nThread = namedtuple('Thread', 'name d P')\n"
        "T = [Thread('M6', 6, 1.0), Thread('M8', 8, 1.25), Thread('M10', 10, 1.5)]\n"
        "t = [t for t in T if t.d > 2 * g.F][0]\ny = t.d * t.P * g.a"
    ),
    THREADS + "d, P = next((d, P) for d, P in T if d > 2 * g.F)\ny = d * P * g.a",
    THREADS + "row = next(r for r in T if r[0] > 2 * g.F)\ny = row[0] * row[1] * g.a",
    SIZES + "fits = [d for d in D if d >= 5 * g.F]\ny = (min(fits) if fits else 33.0) * g.a",
    SIZES + "fits = [d for d in D if d >= 7 * g.F]\ny = (fits[0] if fits else 33.0) * g.a + len(fits)",
    SIZES + "fits = [d for d in D if d <= 2 * g.F]\nif not fits:\n    y = 2.0\nelse:\n    y = fits[-1] * g.a",
    (
        NAMED + "fits = [r for r in T if r[1] > 2 * g.F if r[2] > g.a]\n"
        "row = max(fits, key=lambda r: r[2]) if fits else T[-1]\ny = row[1] * row[2]"
    ),
    (
        SIZES + "def next_size(need, sizes=D):\n    fits = [d for d in sizes if d >= need]\n"
        "    return min(fits, key=lambda d: d) if fits else sizes[-1]\ny = next_size(5 * g.F) * g.a"
    ),
    SIZES + "fits = [d for d in D if d >= 3 * g.F]\ny = min(fits, default=1.0) * g.a",
    "T = {'M6': (6.0, 1.0), 'M8': (9.0, 1.25)}\ny = next(v for v in T.values() if v[0] > 2 * g.F)[1] * g.a",
    # of a list that has a name
    SIZES + "fit = [d for d in D if d >= 3 * g.F]\ny = len(fit) / len(D) + fit[0] * g.a + fit[-1]",
    SIZES + "fit = [d for d in D if d >= 5 * g.F]\ny = min(fit) if fit else D[-1] * g.a",
    SIZES + "fit = [d * g.a for d in D if d > 3 * g.F]\ny = sum(fit) / len(fit) + max(fit)",
    SIZES + "fit = [d for d in D if d >= 6 * g.F]\ny = 1.0\nif not fit:\n    y = g.a",
    (
        THREADS + "fit = [r for r in T if r[0] >= 3 * g.F]\n"
        "r = min(fit, key=lambda r: r[1]) if fit else max(T, key=lambda r: r[1])\ny = r[0] * r[1] * g.a"
    ),
    SIZES + "k = 3\nfit = [d * k for d in D if d >= k * g.F]\nk = 5\ny = sum(fit) * g.a",
]
ITEM = (
    "from dataclasses import dataclass\n@dataclass\nclass Item:\n    d: float\n    m: float\n"
    "def item(d):\n    return Item(d, (d - 4 * g.F) ** 2 + g.a * d)\n"
)
BEST = [  # looked for one by one, and what is made of those that are kept
    (
        SIZES + ITEM + "best = None\nfor d in D:\n    each = item(d)\n    if d < 2.5 * g.F:\n        continue\n"
        "    if best is None or each.m < best.m:\n        best = each\ny = best.d * g.a if best is not None else 99.0"
    ),
    (
        SIZES + ITEM + "fit = [item(d) for d in D if d >= 2.5 * g.F]\nbest = None\nfor each in fit:\n"
        "    if best is None or each.m < best.m:\n        best = each\n"
        "y = best.m + sum(1 for each in fit if each is best) * g.a + len([i for i in fit if i == best and i.d > g.F])"
    ),
    (
        SIZES + "def pick(need):\n    best = None\n    for d in D:\n        if d < need:\n            continue\n"
        "        cost = (d - 4 * g.F) ** 2\n        if best is not None and cost >= best[1]:\n            continue\n"
        "        best = (d, cost)\n    return best\n"
        "found = pick(2.5 * g.F)\ny = 0.5 if found is None else found[0] * g.a"
    ),
    SIZES + "fit = [d for d in D if d >= 2.5 * g.F]\ny = 0.0\nfor d in fit:\n    if d > 9:\n        y += d * g.a",
    (
        SIZES + "low = 1e9\nfor d in D:\n    if d < 2.5 * g.F:\n        continue\n    if (d - 4 * g.F) ** 2 < low:\n"
        "        low, taken = (d - 4 * g.F) ** 2, d\ny = taken * g.a + low"
    ),
    (
        SIZES + "fit = [d for d in D if d >= 2.5 * g.F]\nmore = [d * g.a for d in fit]\n"
        "y = sum(m for m in more if m > g.F) + max(d - g.F for d in fit) + len([m for m in more if m < 3 * g.F])"
    ),
    (
        SIZES + "fit = sorted([(d, (d - 4 * g.F) ** 2) for d in D if d >= 2.5 * g.F], key=lambda f: f[1])\n"
        "y = fit[0][0] * g.a + fit[-1][1] + len(fit)"
    ),
    (
        "T = sorted([(abs(b / a - g.F), a, b) for a in (3, 5, 7) for b in range(4, 20)], key=lambda t: t[0])\n"
        "y = T[0][1] * g.a + T[-1][2] + len(T)"
    ),
    (
        ITEM + "every = [item(d) for d in (6.0, 8.0, 10.0, 12.0, 16.0)]\nbest = min(every, key=lambda i: i.m)\n"
        "y = sum(k for k, each in enumerate(every) if each is best) + sum(i.d for i in every if i is not best)"
    ),
]
RANKED = [  # rows in the order of a number of theirs
    THREADS + "T = sorted(T, key=lambda r: abs(r[0] - 3 * g.F))\ny = T[0][1] * g.a + T[-1][0]",
    NAMED + "T = sorted(T, key=lambda r: abs(r[1] - 3 * g.F), reverse=True)\ny = np.array([r[2] for r in T[:2]]) * g.a",
    THREADS
    + "fit = [r for r in sorted(T, key=lambda r: abs(r[0] - 8 * g.a)) if r[0] > 2 * g.F]\ny = fit[0][1] if fit else 0",
    SIZES + "y = sorted(D, key=lambda d: abs(d - 4 * g.F))[0] * g.a",
    "y = sum(k * v for k, v in enumerate(sorted([g.F, 2.0, g.a, 2.0], key=lambda v: -v)))",
]
READ_OTHERWISE = [  # of which Python sees each element
    SIZES + "d = 20.0\nok = []\nfor d in D:\n    if d >= 3 * g.F:\n        ok.append(d)\ny = d + sum(d for d in ok)",
    SIZES
    + "A = 5.0\nok = []\nfor d in D:\n    if d >= 3 * g.F:\n        A = d / 2\n        ok.append(A)\ny = ok[0] * g.a",
    SIZES + "ok = []\nfor d in D:\n    if d >= 3 * g.F and len(ok) < 2:\n        ok.append(d)\ny = len(ok) * g.a",
    SIZES + "ok = []\nfor d in D:\n    if d < 3 * g.F:\n        ok.append(d)\ny = d + ok[-1] * g.a",
    SIZES
    + "d = 1.0\nf = lambda: d\nok = []\nfor d in D:\n    if d < 3 * g.F:\n        ok.append(d)\ny = f() * ok[0]\nd = 2",
    SIZES + "A = 5.0\nok = []\nfor d in D:\n    if d < 3 * g.F:\n        continue\n    A = d\n    ok.append(A)\ny = A",
    SIZES
    + "A = 5.0\nok = []\nfor d in D:\n    if d < 3 * g.F:\n        A = d\n        ok.append(A)\nA += 1\ny = ok[0] * A",
    (
        SIZES + "L = []\ndef f(d):\n    L.append(d)\n    return d / 2\nok = []\nfor d in D:\n    if d < 2 * g.F:\n"
        "        continue\n    A = f(d)\n    if A > 3 * g.F:\n        continue\n    ok.append(A)\ny = sum(ok) + len(L)"
    ),
    SIZES + "ok = held = []\nfor d in D:\n    if d >= 3 * g.F:\n        ok.append(d)\ny = len(held) * g.a",
    SIZES + "ok = []\nfor d in D:\n    A = d * 2\n    if d >= 3 * g.F:\n        ok.append(A)\ny = ok[0] * g.a + A",
    SIZES + "ok = []\nfor d in D:\n    if d >= 3 * g.F:\n        ok.append(-d)\nok.sort()\ny = ok[0] * g.a",
    SIZES + "fit = [d for d in D if d >= 3 * g.F]\ny = np.array(fit).sum()",
    SIZES + "fit = [d for d in D if d >= 3 * g.F]\ny = 0.0\nfor d in fit:\n    y += d",
    SIZES + "fit = [d for d in D if d >= 3 * g.F]\nfit.append(g.a)\ny = sum(fit) + len(fit)",
    SIZES + "fit = [d for d in D if d >= 3 * g.F]\ny = sum([1.0, g.a] + fit) + fit[1:][0]",
    SIZES + "fit = [d for d in D if d >= 3 * g.F]\na, *b = fit\ny = a * g.a + len(b)",
    SIZES + "fit = [d for d in D if d >= 3 * g.F]\ny = float(len(str(fit))) + (10.0 in fit) + fit.index(12.0)",
    SIZES + "fit = [d for d in D if d >= 3 * g.F]\ny = float(sum(sorted(fit, reverse=True)[:2]) + len(tuple(fit)))",
    SIZES + "L = []\nfit = [L.append(d) or d for d in D if d >= 1.5 * g.F]\ny = sum(L) * g.a",
    SIZES + "if g.F > 3:\n    fit = [d for d in D if d >= g.F]\nelse:\n    fit = [g.a]\ny = len(fit) + sum(fit)",
    SIZES + "fit = sorted([d for d in D if d >= 3 * g.F], key=lambda d: abs(d - 9 * g.a))\ny = fit[1] + sum(fit[:2])",
    SIZES
    + "fit = sorted([d for d in D if d >= 3 * g.F], key=lambda d: -d)\ny = float('.'.join(str(d) for d in fit)[:2])",
    THREADS
    + "best = min(T, key=lambda t: abs(t[0] - 3 * g.F))\ny = sum(k for k, t in enumerate(T) if t is best) + g.a",
    SIZES
    + "best = None\nfor d in D:\n    if d >= 3 * g.F and (best is None or d < best):\n        best = d\ny = best * g.a",
    NAMED + "T = sorted(T, key=lambda r: r[1] * g.F)\ny = len(T[0][0]) * g.a",
    SIZES + "T = sorted(D, key=lambda d: np.sqrt(d - 3 * g.F + 4))\ny = T[0] * g.a",
    "T = sorted(['a', 'b'], key=lambda t: {'a': g.F, 'b': 3.0}[t])\ny = (T[0] == 'a') * g.a",
    SIZES + "fit = [d for d in D if d >= 3 * g.F]\nother = fit\nif g.a > 1:\n    other.append(1.0)\ny = len(fit) * 1.0",
]
MATRIX = "K = np.array([[2.0, g.F, 1.0], [g.F, 5.0, 2.0], [1.0, 2.0, 9.0]])\nfree = [i for i in range(3) if i != g.k]\n"
LOOKED = [  # of which Python sees the places, or which of the cases it is
    MATRIX + "y = np.linalg.solve(K[np.ix_(free, free)], [1.0, g.a])",
    MATRIX + "u = np.zeros(3)\nu[free] = np.array([g.F, g.a])\ny = u",
    MATRIX + "y = K[free][:, free].ravel()",
    MATRIX + "free = np.arange(3) != g.k\ny = K[np.ix_(free, free)].ravel()",
    MATRIX + "y = K[np.setdiff1d(np.arange(3), [g.k])].ravel()",
    MATRIX + "y = np.take(x, free) * g.a",
    "match [v for v in (g.k, 3) if v > 1]:\n    case [a, b]:\n        y = a + b * g.F\n    case _:\n        y = 1",
    (
        "from typing import NamedTuple\nclass Load(NamedTuple):\n    F: float\n    k: int\nmatch Load(g.F, g.k):\n"
        "    case Load(F=F, k=2):\n        y = F\n    case (F, _):\n        y = 2 * F"
    ),
]
CHOSEN = [
    "T = {'alu': {2: 2.0, 1: 1.0, 0: 2.0, 3: 7.0}, 'steel': {0: 0.0, 1: 1.0, 2: 4.5, 3: 8.0}}\n"
    "y = T['steel' if g.F > 3 else 'alu'][g.k] * g.F",
    "row = {True: 2.0, False: 1.0} if g.F > 3 else {False: 1.0, True: 4.5}\ny = row[g.a > 1] * g.F",
    "y = math.remainder(g.F, 0.7) + math.remainder(-g.F, 0.5) + math.remainder(2 * g.a, -1.0)",
    "t = 'low' if g.F > 3 else 'high'\ny = {'low': 2.0, 'mid': g.a}.get(t, g.F) + {'high': 5}.get(t, 0.0)",
    "y = min([g.F, 2.7, g.a], default=0.0) + max((v * g.a for v in (1.0, g.F)), default=9) + min([], default=g.F)",
    "y = {0: 1.0, 2: 2.0}.get(g.k, g.F) * g.a",
    "y = {0: 1.0, 2: 2.0}.get(round(g.F), 7.0) * g.a + {'a': 1.0}.get('b', g.F)",
    "law = (lambda v: v**2) if g.F > 3 else (lambda v: 3 * v)\ny = law(x[0]) * g.a",
    (
        "def f(v):\n    return v**2\ndef h(v):\n    return 3 * v\nif g.F > 3:\n    law = f\nelse:\n    law = h\n"
        "y = law(g.F) * g.a"
    ),
    (
        "row = {'R': 1.0, 'E': 3.0, 'n': 'x'} if g.F > 3 else {'R': 2.0, 'E': g.a, 'n': 'y'}\n"
        "y = row['R'] * row['E'] * len(row)"
    ),
    "row = [1.0, 2.0] if g.F > 3 else [g.a, 5.0]\ny = np.array(row) * 2",
    (
        "from dataclasses import dataclass\n@dataclass\nclass Bolt:\n    d: float\n    def area(self):\n"
        "        return np.pi * self.d**2 / 4\nb = Bolt(3.0) if g.F > 3 else Bolt(g.a)\ny = b.area() + b.d"
    ),
    (
        "from collections import namedtuple\nCase = namedtuple('Case', 'F M')\n"
        "c = Case(1.0, 2.0) if g.F > 3 else Case(g.a, g.F)\ny = c.F + c.M"
    ),
]
SET = [
    (
        "B = np.zeros((2, 2))\nr = np.zeros(2)\nB[0, 0], r[0] = 1.0, g.F\n"
        "B[1, 0], B[1, 1], r[1] = 3.0, g.a, 1.0\ny = np.linalg.solve(B, r)"
    ),
    "K = np.zeros((2, 2))\nK[0, 1] = K[1, 0] = -g.F\nK[0, 0] = K[1, 1] = g.F + g.a\ny = np.linalg.solve(K, [1.0, 2.0])",
    "v = np.zeros(3)\n(v[0], (v[1], v[2])), w = (g.F, (g.a, 2.0)), 3.0\nv[0], v[1] = v[1], v[0]\ny = v * w",
    (
        "M = np.zeros(3)\nX = np.array([1.0, 2.0, 3.0])\nfor i in range(3):\n    if X[i] < g.F:\n"
        "        M[i] = g.a * X[i]\n    else:\n        M[i] = g.a * X[i] - 3 * (X[i] - g.F)\ny = M * 1.0"
    ),
    (
        "M = np.zeros(4)\nfor F, p in ((1.0, 1.0), (g.a, 3.0), (2.0, g.F)):\n    for i in range(4):\n"
        "        if i > p:\n            M[i] += F * (i - p)\ny = M * 1.0"
    ),
    (
        "M = [0.0, 0.0, 0.0]\nfor i, v in enumerate((0.5, 2.7, 4.0)):\n    if v < g.a:\n        M[i] = v\n"
        "    elif v < g.F:\n        M[i] = v**2\ny = np.array(M)"
    ),
    (
        "M, T = np.zeros(3), np.zeros(3)\nfor i in range(3):\n    if i < g.F:\n        M[i] = i\n        T[i] = g.a\n"
        "    else:\n        T[i] = 2 * g.a\ny = M + T"
    ),
    (  # where the condition does not hold, there is no such element or no such key
        "n = 8\nK = np.eye(n) * g.F\nfor i in range(n):\n    if i < n - 1:\n        K[i, i + 1] -= g.a\n"
        "    if i > 0:\n        K[i, i - 1] -= 1.0\ny = np.linalg.solve(K, np.arange(n) * g.a) + np.linalg.inv(K)[2]"
    ),
    (
        "dofs, free = [('A', 0), ('A', 1), ('B', 0)], [('A', 1), ('B', 0)]\nK = np.zeros((2, 2))\n"
        "for r, p in enumerate(dofs):\n    for s, q in enumerate(dofs):\n        if p in free and q in free:\n"
        "            K[free.index(p), free.index(q)] += g.F * (r + s)\ny = K.sum(axis=0) * g.a"
    ),
    "d = {'x': 2.0}\nif g.F > 3:\n    d['x'] = g.a\ny = d['x'] * 2",
    (
        "K = np.array([[np.sin(i * j + g.F) for i in range(9)] for j in range(9)]) + 9 * np.eye(9)\n"
        "y = np.linalg.solve(K, np.arange(9))"
    ),
    "y = math.log(8, 2) * g.a + math.log(g.F, g.a + 2) + math.log(g.F)",
    (
        "import cmath\ny = cmath.phase(g.F + 1j * g.a) + sum(cmath.polar(1j * g.a)) + "
        "abs(cmath.exp(1j * g.F) + cmath.rect(2, g.a))"
    ),
    (
        "import cmath\ny = cmath.sqrt(2.9 - g.F).imag + cmath.log(1j * g.a).real + "
        "cmath.cos(1j * g.F).real + cmath.sin(g.a).real"
    ),
    (
        "y = math.gcd(g.n * 6, g.k * 4, 10) * g.a + math.lcm(g.n, g.k + 1) + math.gcd(0, g.k) + "
        "math.lcm(4, 6) + math.gcd(g.k)"
    ),
    "y = math.hypot(g.F, g.a, 3.0) + math.hypot(-g.F) + math.dist((g.F, 1.0, 0.0), [0.0, g.a, 2.0])",
    "import statistics as s\nv = [g.F, g.a, 2]\ny = s.mean(v) + s.fmean(v) * s.stdev(v) + s.median(v) - s.pstdev(v)",
]
POLYNOMIALS = [  # of one that begins with 0 the rest is another one
    "p = np.poly1d(np.polyfit([1, 2, 3, 4], [1.0, g.F, 3.0, 5.0], 2))\ny = p(x) + p.deriv()(x) + p.coeffs[0] - p[1]",
    "p = np.poly1d([g.a, 1.0]) * np.poly1d([1.0, g.F]) + 3\ny = p.integ(k=g.F)(x) + p.deriv(2)(g.a)",
    "p = np.poly1d([1.0, g.F, g.a])\ny = p.integ(2, [g.F, 1])(2)",
]
VECTORIZED = [
    "f = np.vectorize(lambda v, w: max(v, w) if v < g.F else w**2)\ny = f(np.array([g.a, 2, 3.0]), g.F) + f(g.a, 1)",
    (
        "@np.vectorize\ndef f(v):\n    if v < g.F:\n        return v**2\n    return v * g.a\n"
        "y = f([[1.0, 2.0], [3.0, g.a]]).sum(axis=0)"
    ),
]
SEARCHED = [
    "from bisect import bisect_left\nS = [1, 2, 3, 4, 8]\ny = S[bisect_left(S, g.F)] * g.a",
    "import bisect\nS = [1, 2, 3, 4, 8]\ny = S[bisect.bisect(S, g.F)] * S[S.index(round(g.F)) + 1]",
    "v = [g.F, g.a, 2.6]\ny = v.index(max(v)) * g.a + v.index(2.6)",
    "k = max(range(5), key=lambda i: np.sin(i * g.F))\ny = k * g.a",
    "w = min([(g.F, 2.0), (g.a * 3, 3.0), (g.a * 3, 1.0)])\ny = w[1]",
    "T = [(6, 1.0), (8, 1.25), (10, 1.5)]\nrow = min(T, key=lambda r: abs(r[0] - 3 * g.F))\ny = row[0] * row[1]",
    (
        "match g.k:\n    case 2:\n        y, t = g.F, 'a'\n    case 3 | 1:\n        y, t = g.a, 'b'\n"
        "    case _:\n        y, t = 7.0, 'c'"
    ),
    (
        "def f(k):\n    match k:\n        case 2:\n            return g.F\n        case 3:\n            return g.a\n"
        "    return 5.0\ny = f(g.k)"
    ),
    "s, p, q, l = sorted([g.F, g.a, 1.0, 2.2])\ny = s + l - p * q",
    "y = sorted([g.F, g.a, 3.0], reverse=True)[0] + sorted((g.F, 1.0))[-1]",
    "for d in (6.0, 8.0, 10.0):\n    if d > 3 * g.F:\n        break\nelse:\n    d = 33.0\ny = d * g.a",
    (
        "for d, P in [(6, 1.0), (8, 1.25), (10, 1.5)]:\n    A = d - P\n    if A > 3 * g.F:\n        d = 2 * d\n"
        "        break\nelse:\n    A = 0.5\ny = d * A * g.a"
    ),
    (
        "if g.F > 3:\n    v = g.F\n    kind = 'much'\nelif g.F > 2:\n    v = g.a\n    kind = 'some'\n"
        "else:\n    v = 0.0\n    kind = 'none'\ny = v * 2"
    ),
    "v = g.F\nif v > 3:\n    v = 3.0\n    kind = 'much'\nelse:\n    kind = 'some'\ny = v * 2",
]
BEARINGS = "T = {'6205': (4, 14.0), '6206': (6, 19.5), '6207': (8, 25.5), '6208': (13, 30.7)}\n"
WALKED = [  # tables gone through until a row fits, which a dict, zip and enumerate give as a list does
    BEARINGS + "for name, (d, C) in T.items():\n    if d > 2 * g.F and C > 9 * g.a:\n        break\ny = C * g.a",
    (
        BEARINGS + "name = '-'\nfor key, (d, C) in T.items():\n    if d > 3 * g.F:\n        name = key\n        break\n"
        "y = T[name][1] * g.a if name in T else 0.0"
    ),
    BEARINGS + "for name in T:\n    if T[name][0] > 2 * g.F:\n        break\ny = T[name][1] if name != '6207' else g.a",
    (
        BEARINGS + "def bearing(d):\n    for name, (bore, C) in T.items():\n        if bore > d:\n"
        "            return name, C\n    return '-', 0.0\nname, C = bearing(3 * g.F)\ny = C * g.a"
    ),
    "C = 0\nfor d, c in {1: 2.0, 2: 3.0, 3: 7.0}.items():\n    if d > g.F:\n        C = c\n        break\ny = C * g.a",
    "for i, d in enumerate([1, 2, 3, 5, 8]):\n    if d > g.F:\n        break\ny = d * g.a + i",
    "for d, P in zip([1, 2, 3, 5], [1.0, g.a, 2.0, 2.5], strict=True):\n    if d > g.F:\n        break\ny = d * P",
    "y = 2.0 * any(d > g.F for d in (1, 2, 3)) + all([d < g.F for d in (1, g.a)]) + any(v > 4 * g.a for v in (g.F, 1))",
    "y = 1.0 if all(d > g.F for d in [2.0, 3.0, 4.0]) and any(x > 6) else g.a",
    "y = g.a if g.k in (1, 2) else g.F if g.k not in {0: 1, 3: 2} else 7.0",
]
SELECTED = [
    "y = x[x > 0.6 * g.F].min() * len(x[x > g.F])",
    "y = np.max(x[x < g.F]) + max(x[x < g.F]) + sum(x[x < g.F])",
    "y = x[x > g.F].sum() + np.mean(x[x > g.F / 2] ** 2) ** 0.5",
    "y = x[x > 3].max(initial=0.0) + x[x > 3].sum(initial=g.a) + np.any(x[x > g.a] > 3)",
    "i = np.flatnonzero(x > g.F / 2)\ny = x[i[0]] + g.a * i[-1] + (x**2)[i][1] + x[i].sum()",
    "i = np.flatnonzero(x > 50)\ny = x[i[0]] if len(i) else -1.0",
    "i = np.where(x > g.F)[0]\nif i.size > 0:\n    y = x[i[0]]\nelse:\n    y = g.a",
    "sel = x > g.F / 2\nz = x[sel] ** 2 / x[sel].max()\ny = np.ptp(z) + z[0]",
    "z = np.exp(1j * x)[~(x > g.F) & (x > g.a / 9)]\ny = z[0] + z.sum() * z[-1]",
    "i = np.nonzero(np.diff(np.sign(x - g.F)))[0]\ny = x[i[0]] + (g.F - x[i[0]]) * g.a / (x[i[0] + 1] - x[i[0]])",
    SIZES + "b = D * np.array([1.0, 2, 3, 4, 5, 6])\ny = b[D >= 3 * g.F][0] * D[D >= 3 * g.F].min()",
    "y = x[x > g.a][x[x > g.a] < 3].max() + np.extract(x > g.a, x)[0]",
    TABLE + "row = T[T[:, 0] > g.F / 1.5][0]\ny = row[1] * g.a + T[T[:, 0] > g.F / 1.5, 1][0]",
    TABLE + "y = T[T[:, 0] > g.F / 1.5][:, 1].min() * g.a + T[T[:, 0] == g.k - 1][0, 1]",
    "v = np.where(x > g.F, np.nan, x)\ny = np.nanmax(v[x > g.a / 9]) + np.isnan(v[x > 1]).sum()",
]
GRID = "A = np.outer(np.arange(1, 6), [1.0, g.F, 3.0, g.F**2])\n"
PICKED = [  # columns of a table, and elements by their places
    GRID + "y = A[:, g.k] * g.a + A[:, -g.k]",
    GRID + "y = A[1:4, g.k] + A[:, g.k][:, None][::2, 0] + A[g.k, g.k]",
    GRID + "y = np.interp(g.F, [1, 2, 3, 4, 5], A[:, g.k])",
    GRID + "y = A[:, np.argmax(A[0])] + A[:, np.searchsorted([1.0, 2.0, 3.0], g.F)]",
    GRID + "y = A.reshape(5, 2, 2)[:, 1, g.k - 2] * A.reshape(5, 2, 2)[:, g.k - 2, :].sum(axis=1)",
    GRID + "A[:, g.k] += g.a\ny = A.sum(axis=0)",
    GRID + "y = np.take(A, g.k, axis=1) + np.take(A, g.k) * A.take([g.k, 0])[1] + A.take(g.k, axis=0)[1]",
    GRID + "y = np.take(A, [[0, 3], [2, 1]], axis=1)[2].ravel() * np.take(A[0], g.k)",
    "y = np.choose(g.k, [1.0, g.a, g.F, 3 * g.F]) + np.choose([0, 2, 1], [[1.0, g.a, 2], [g.F, 3, g.F], [7, g.a, 9]])",
    "y = np.angle(np.exp(1j * x), deg=True) + np.angle(g.F - 2.6, deg=True)",
]
LAW = """def f(t):
    out, low = np.zeros_like(t), t < g.F / 2
    out[low], out[~low] = t[low] ** 2 * g.a, np.where(t[~low] > 3, 3.0, np.sqrt(t[~low] - g.F / 2))
    return out
"""
PLACED = [  # by a condition that tells other elements for other inputs
    "s = np.zeros(g.n)\ns[x > g.F] = g.a\ny = s @ x",
    "s, m = np.zeros_like(x), x > g.F / 2\ns[m] = g.a * (x[m] - g.F / 2) ** 2\ns[~m] = x[~m]\ny = s.sum()",
    "s = x * 1\ns[s > g.F] = g.F\ns[s < g.a] *= g.a\ny = s.sum()",
    LAW + "y = f(x).sum()",
    (
        "s, ends = np.zeros(g.n), [0.0, g.a, 2 * g.a, 2 * g.F]\nfor low, high in zip(ends, ends[1:]):\n"
        "    m = (x >= low) & (x < high)\n    t = (x[m] - low) / (high - low)\n    s[m] = 10 * t**3 - 15 * t**4 + g.a\n"
        "y = s.sum()"
    ),
    "s, m = np.zeros(g.n), x > g.F\nif m.any():\n    s[m] = np.log(x[m] / g.F)\ny = s.sum()",
    "s, m = np.zeros(g.n), x > 3 * g.a\nif m.any():\n    s[m] = 1.0\ny = s @ x",
    "s, i = np.zeros(g.n), np.where(x > g.F)\ns[i] = np.interp(x[i], [0.0, 3.0, 9.0], [0.0, g.a, 2.0])\ny = s.sum()",
    "n = np.zeros(g.n, int)\nn[x > g.F / 2] = 2\ny = n @ x",
    "z = x + 1j * g.a\nz[np.flatnonzero(x > g.F)] = 2.0\ny = abs(z).sum()",
    "Z = np.outer(x, [1.0, g.a])\nZ[Z > g.F] = 0.0\ny = Z.sum()",
]
WAYS = "{0: lambda v: -v, 1: lambda v: v + 1, 2: lambda v: v * g.a, 3: lambda v: v**2}"
FUNCTIONS = [  # of which a number or a condition says which one is called
    f"y = {WAYS}[g.k](g.F)",
    f"way = {WAYS}[g.k]\ny = way(x)[1] + (way(g.F) if g.a > 0.5 else way(g.a))",
    f"y = {WAYS}.get(g.k + 1, lambda v: 3 * v)(g.F)",
    "y = [np.exp, np.cos, np.sin, math.sqrt][g.k](g.F)",
    "f = np.sin if g.F > 3 else np.cos\ny = f(x) * g.a",
    "f, c = {2: (np.sin, 1.0), 3: (lambda v: v - g.a, 2.0)}[g.k]\ny = c * f(g.F)",
    "f = getattr(np, 'exp' if g.F > 3 else 'sin')\ny = f(g.a)",
    "y = getattr(g, ['n', 'k', 'F', 'a'][g.k]) * getattr(g, 'none', 2.0)",
    "def f(v):\n    return 2 * v\nway = f if g.k > 2 else np.sqrt\ny = (way if g.F < 3 else np.exp)(g.a)",
]
EIGEN = [  # of which the vectors have a sign as numpy's steps end
    "w, V = np.linalg.eigh(np.array([[2 * g.F, -g.F], [-g.F, g.F + g.a]]))\ny = np.sqrt(w)",
    "r = np.linalg.eigh(np.diag([g.F, 2.0, 3.0]) - g.a)\ny = r[1] * 0 + r.eigenvalues if g.F < 0 else r[0]",
]
WORDS = [  # one of two texts, and a condition as a number
    "kind = 'root' if g.F > 3 else 'flank'\ny = 2.0 if kind == 'root' else g.a",
    "kind = 'root'\nif g.F > 3:\n    kind = 'flank'\nR = {'root': 2.0, 'flank': g.a}\ny = R[kind] * (kind in R) * g.F",
    "def f(v, law):\n    return v**2 if law == 'even' else v\ny = f(x, 'even' if g.k % 2 == 0 else 'odd')",
    "kind = 'root' if g.F > 3 else 'flank'\nmatch kind:\n    case 'root':\n        y = g.a\n    case _:\n        y = 3",
    "y = np.array([g.a, 2.0])[int(g.F > 3)] * 2 * int(g.F < 4) + float(g.a > 1)",
]
AROUND = [  # lists and dictionaries around a function, whose elements it sets
    "n = [0]\ndef f(v):\n    n[0] += 1\n    return v * g.a\ny = find(f, 0, 99, equals=g.F).value",
    "h = {0: g.a}\ndef f(n):\n    if n not in h:\n        h[n] = f(n - 1) * g.F + n\n    return h[n]\ny = f(4)",
    (
        "def outer():\n    v = [0.0] * 3\n    def put(i, w):\n        v[i] = w\n    put(0, g.F)\n    put(1, g.a)\n"
        "    return v\ny = outer()"
    ),
]
NEAREST = [
    "v, n = g.F, 0\nwhile v < 40 and n < 9:\n    v, n = v * 1.5 + x[np.argmin(abs(x - v / 10))], n + 1\ny = v",
    "v = 0.0\nfor d in (1.0, 2.0, 3.0):\n    v += x[np.argmin(abs(x - d))]\n    if v > g.F:\n        break\ny = v",
    SIZES + "from scipy.integrate import quad\ny = quad(lambda t: D[np.argmax(D * np.sin(t + g.a))] * t, 0, 0.5)[0]",
]
SOLVED = [  # of what takes one number after the other, where no name holds what is found
    "y = find(lambda v: np.cross([v, 1, 0], [0, g.a, 1])[2] + 9 * v, -50, 50, equals=g.F).value",
    "y = find(lambda v: next((d for d in (1.0, 2.0, 9.0) if d > v), 0.0) + 9 * v, -50, 50, equals=g.F).value",
    "y = find(lambda v: (2 * v if v > 1 else 1 + v) * g.a, 0, 50, equals=g.F).value",
    "y = find(lambda p, q: (np.cross([p, q, 1], [1, g.a, 2])[2] + p, q + p), equals=(g.F, 1), p=1.0, q=1.0).value.p",
]
APPENDED = [  # to the same lists whatever a condition says
    "T = []\nfor v in (1, 2.0, 3):\n    if v > g.F:\n        T.append(g.a)\n    else:\n        T.append(v)\ny = sum(T)",
    (
        "T, N = [0.0], []\nfor v in (1.0, 2.0, 3.0):\n    if v > g.F:\n        w = g.a\n        T.append(T[-1] + w)\n"
        "        N.append('much')\n    elif v > g.a:\n        T.append(v)\n        N.append('some')\n    else:\n"
        "        T.append(T[-1])\n        N.append('none')\ny = np.array(T) * len([n for n in N if n == 'some'])"
    ),
    (
        "def f(rows):\n    out = []\n    for v, w in rows:\n        if v < g.F:\n            if w > g.a:\n"
        "                out.append((v, w))\n            else:\n                out.append((w, g.a))\n        else:\n"
        "            out.append((0.0, v))\n    return out\ny = [p * 3 + q for p, q in f([(1.0, 2.0), (3.0, 1.0)])]"
    ),
    "T = [g.a]\nif g.F > 3:\n    T.append(g.F)\nelse:\n    T.append(2.0)\ny = T[1] * T[0] + len(T)",
]
BY_TYPE = "def f(v):\n    if {}:\n        return np.maximum(v, 0.4) * 2\n    return v + 0 * g.F\n"
TYPED = [  # of which a function asks whether it is one number, or a text
    BY_TYPE.format("isinstance(v, (int, float))") + "y = f(g.a - 0.3) + f(np.sin(g.a)) + f(g.k - 2) + f(x)",
    BY_TYPE.format("not isinstance(v, np.ndarray)") + "y = f(g.a - 0.3) + f(x - g.a)",
    BY_TYPE.format("np.isscalar(v)") + "y = f(g.a - 0.3) + f(np.sin(g.a)) + f(x)",
    BY_TYPE.format("not np.iterable(v)") + "y = f(g.a - 0.3) + f(x)",
    BY_TYPE.format("not hasattr(v, '__len__')") + "y = f(g.a - 0.3) + f(x)",
    BY_TYPE.format("type(v) is float") + "y = f(g.a - 0.3) + f(g.k - 2) + f(x)",
    BY_TYPE.format("type(v) in (float, int)") + "y = f(g.a - 0.3) + f(g.k - 2) + f(g.a > 1)",
    "def f(v):\n    return v(g.F) if callable(v) else max(v, 0.4)\ny = f(g.a - 0.3) + f(lambda v: v**2)",
    "def f(v):\n    return {'a': 2.0, 'b': g.F}[v] if isinstance(v, str) else v\ny = f('a' if g.F > 3 else 'b')",
]
GUARDED = [  # where other inputs change what there is
    "T = [('M6', 6), ('M10', 10)]\nname, d = next(r for r in T if r[1] > 2 * g.F)\ny = d * len(name)",
    "T = [('M6', 6), ('M10', 10)]\nrow = next(r for r in T if r[1] > 2 * g.F)\ny = row[1] * len(row[0])",
    "for d in (6.0, 8.0, 16.0):\n    if d > 3 * g.F:\n        break\nelse:\n    raise ValueError('none')\ny = d * g.a",
    "if g.F > 3:\n    v = g.F\n    kind = 'much'\nelse:\n    v = g.a\n    kind = 'some'\ny = v * len(kind)",
    "d = {}\nif g.F > 3:\n    d['x'] = g.a\ny = len(d) + g.F",
    "v = np.array([g.F, g.a])\nif v[0] > 3:\n    v[0] = 3.0\n    v[1] = v[0]\ny = v * 2",
    "row = [1.0, 2.0] if g.F > 3 else [g.a]\ny = len(row) * g.F",
    "v = 1.0\nwhile v < 3.1 * g.F:\n    v = v + len(f'{v:.0f}')\ny = v + g.F",
    "y = np.cumsum(x[x > g.F])[-1]",
    "y = np.zeros(len(x[x > g.F])) + x[x > g.F] + g.a",
    "y = x[x > g.F][1:].sum() + g.a",
    "T = zip([1, 2, 3, 5, 8], 'abcde')\nfor d, _ in T:\n    if d > g.F:\n        break\ny = next(T)[0] * g.a",
    "K = np.zeros(2)\ndef f(v):\n    K[0] = v\n    return v\ny = {2: f, 3: lambda v: 2 * v}[g.k](g.F) + K",
    "T, U = [], [1.0]\nif g.F > 3:\n    T.append(g.F)\nelse:\n    U.append(g.a)\ny = len(T) * 3 + sum(U)",
    "T = [g.a]\nif g.F > 3:\n    T.append(2.0)\n    v = sum(T)\nelse:\n    T.append(1.0)\n    v = g.F\ny = v + T[1]",
    "row = {'R': g.F, 'n': 'x'} if g.F > 3 else {'R': 2.0, 'n': 'yy'}\ny = row['R'] * len(row['n'])",
]


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize(
    "lines",
    [
        *KEPT,
        *RANKED,
        *CHOSEN,
        *SET,
        *POLYNOMIALS,
        *VECTORIZED,
        *SEARCHED,
        *WALKED,
        *SELECTED,
        *PICKED,
        *PLACED,
        *AROUND,
        *SOLVED,
        *BEST,
        *APPENDED,
        *TYPED,
        *GUARDED,
    ],
)
def test_an_everyday_form_is_followed(lines: str, tmp_path: Path) -> None:
    sheet = own(tmp_path, f"{lines}\nresult = np.atleast_1d(y) * 1  # [-] line")
    _, recording = recorded(sheet)
    told = recording.gaps or [guard for guard in recording.guards.values() if not guard.rows]
    assert bool(told) is (lines in [*GUARDED, *POLYNOMIALS, EIGEN[0]])
    for given in ELSEWHERE:
        own_value = by_cells(sheet.path, ["result"], **given)["result"]
        value = value_of(recording, "result", given)
        if not (lines in GUARDED and np.isnan(value).all()):
            np.testing.assert_allclose(value, own_value, rtol=1e-12, err_msg=str(given))


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize(
    "lines",
    [
        BY_TYPE.format("type(v) is float") + "y = f(np.sin(g.a - 0.3))",
        BY_TYPE.format("isinstance(v, int)") + "y = f(np.argmin(abs(x - g.F)) * 1) + g.a",
        "match g.a - 0.3:\n    case float(v):\n        y = max(v, 0.4)\n    case v:\n        y = v * 1",
        "match 'a' if g.F > 3 else 'b':\n    case str():\n        y = g.F\n    case _:\n        y = 3",
    ],
)
def test_what_rests_on_a_type_that_is_not_known_is_never_stale(lines: str, tmp_path: Path) -> None:
    """Whether a number is Python's own or one of numpy's is not known of each, and a pattern asks by itself."""
    assert_never_stale(lines, tmp_path)


@pytest.mark.parametrize("lines", NEAREST)
def test_a_place_taken_in_each_turn_is_followed_and_written(lines: str, tmp_path: Path) -> None:
    """What decides it stands in a turn of any number, of which neither cells nor a page can say anything."""
    sheet = own(tmp_path, f"{lines}\nresult = np.atleast_1d(y) * 1  # [-] line\ntable_2 = table('2', 'Two', result)")
    names, recording = recorded(sheet)
    assert_followed(sheet, recording, ELSEWHERE)
    report.workbook("", {**names, "__file__": sheet.path}, {})
    assert "<table" in write.page(sheet, sheet.inputs())


@pytest.mark.parametrize("lines", FUNCTIONS)
def test_a_function_that_is_chosen_is_followed(lines: str, tmp_path: Path) -> None:
    """While there is such a one: which one it is was seen as soon as more than two of the worksheet's were there."""
    sheet = own(tmp_path, f"{lines}\nresult = np.atleast_1d(y) * 1  # [-] line")
    _, recording = recorded(sheet)
    assert not recording.gaps
    others = [each for each in ELSEWHERE if "n" not in each] + [{"F": 3.5, "k": 3}, {"F": 4.0, "a": 0.25}]
    for given in others:
        known = numbers([*recording.guards], {recording.inputs[key]: float(x) for key, x in given.items()})
        assert all(known[guard] for guard in recording.guards), given
    assert_followed(sheet, recording, others)


@pytest.mark.parametrize("lines", READ_OTHERWISE)
def test_a_list_of_those_that_are_kept_is_never_stale(lines: str, tmp_path: Path) -> None:
    """Whatever reads it but for its count, its first, its last, its sum and its extremes."""
    assert_never_stale(lines, tmp_path)


def test_a_line_of_those_that_are_kept_is_known_while_they_are_the_same(tmp_path: Path) -> None:
    """It had the exported elements for all inputs, whatever read the list beside."""
    lines = SIZES + "fit = [d for d in D if d >= 3 * g.F]  # [-] line\nn = len(fit)  # [-] line"
    sheet = own(tmp_path, f"{lines}\ntwice = [g.a * d for d in fit]  # [-] line\ntable_2 = table('2', 'Two', n)")
    _, recording = recorded(sheet)
    for given, known in (({}, True), ({"F": 2.6}, True), ({"F": 3.4}, False), ({"F": 1.9}, False)):
        expected = by_cells(sheet.path, ["n", "twice"], **given)
        assert value_of(recording, "n", given) == expected["n"]
        for name in ("fit", "twice"):
            assert np.isfinite(value_of(recording, name, given)).all() == known, (name, given)
        if known:
            np.testing.assert_allclose(value_of(recording, "twice", given), expected["twice"])


MANY = "T = [ROW for k in range(40)]\nbest = None\nfor t in T:\n    if D < 3 * g.F:\n        continue\n"
MANY += "    if best is None or abs(D - 20 * g.a) < abs(BEST - 20 * g.a):\n        best = t\n"
MANY += "y = BEST * g.a + (NAME == 'M14')"


@pytest.mark.parametrize(
    "row, d, name",
    [
        ("(k * 1.0, f'M{k:02}')", "t[0]", "t[1]"),
        ("{'d': k * 1.0, 'name': f'M{k:02}'}", "t['d']", "t['name']"),
        ("SimpleNamespace(d=k * 1.0, name=f'M{k:02}')", "t.d", "t.name"),
    ],
)
def test_each_row_of_a_long_table_is_asked_once_whether_it_is_better(
    row: str, d: str, name: str, tmp_path: Path
) -> None:
    """Twice as long for each further row it took, where two conditions decided: of forty it did not end."""
    lines = MANY.replace("BEST", d.replace("t", "best", 1)).replace("NAME", name.replace("t", "best", 1))
    lines = "from types import SimpleNamespace\n" + lines.replace("ROW", row).replace("D <", f"{d} <")
    sheet = own(tmp_path, f"{lines.replace('D -', f'{d} -')}\nresult = np.atleast_1d(y) * 1  # [-] line")
    assert_followed(sheet, recorded(sheet)[1], ({"F": 3.25}, {"F": 1.75, "a": 0.9}))


@pytest.mark.parametrize("lines", LOOKED)
def test_places_and_cases_are_followed_while_they_are_the_same(lines: str, tmp_path: Path) -> None:
    """Those of a list that is kept by conditions, and what a tuple with names is compared with."""
    sheet = own(tmp_path, f"{lines}\nresult = np.atleast_1d(y) * 1  # [-] line")
    _, recording = recorded(sheet)
    assert not recording.gaps
    assert_followed(sheet, recording, ({"F": 3.25}, {"F": 1.75, "a": 1.5}))
    assert np.isnan(value_of(recording, "result", {"k": 1})).all()


@pytest.mark.parametrize("change", ["M += w * k", "M = M + w * k\n        L.append(w)"])
def test_names_of_a_functions_own_are_not_those_of_another_cell(change: str, tmp_path: Path) -> None:
    """What such a function changes was taken for the number of the same name, which was not there yet."""
    lines = (
        f"def moment(w):\n    M, L = 0.0, []\n    for k in (1.0, 2.0):\n        {change}\n    return M\ny = moment(g.F)"
    )
    others = ["M = 3.0 * g.F  # [-] number\nL = 2.0 * g.F  # [-] number"]
    sheet = own(tmp_path, f"{lines}\nresult = np.atleast_1d(y) * g.a  # [-] line", further=others)
    _, recording = recorded(sheet)
    assert not recording.gaps and not [guard for guard in recording.guards.values() if not guard.rows]
    assert_followed(sheet, recording, ELSEWHERE)


@pytest.mark.office
def test_cells_select_as_the_worksheet_does(recalculated_all: Any, tmp_path: Path) -> None:
    """And set those for which a condition holds; what nothing is left for has no number."""
    lines = [f"{line}\nr_{k} = abs(y) * 1  # [-] line" for k, line in enumerate([*SELECTED, *PLACED])]
    lines += [f"every = np.array([{', '.join(f'r_{k}' for k in range(len(SELECTED) + len(PLACED)))}])  # [-] all"]
    lines += ['last = x[x > g.a * g.F].max()  # [-] greatest\ntable_2 = table("2", "All", every, last)']
    sheet = own(tmp_path, "\n".join(lines))
    names = sheet.run(sheet.results, {"g": sheet.inputs()})
    book = tmp_path / "own.xlsx"
    book.write_bytes(report.workbook("Own", {**names, "__file__": sheet.path}, {}))
    changes: list[dict[str, Any]] = [{"F": 4.0, "a": 0.9}, {"a": 0.2}, {"a": 2.5}]
    edited = [edit(book, given, tmp_path / f"changed{n}.xlsx") for n, given in enumerate(changes)]
    for given, changed in zip(changes, recalculated_all(edited), strict=True):
        rows = [*changed["2 All"].iter_rows(min_row=5, values_only=True)]
        if given["a"] > 2:
            assert rows[0][1] == "#N/A"
            continue
        expected = evaluate(sheet.path, ["every", "last"], **given)
        np.testing.assert_allclose([row[0] for row in rows], expected["every"], rtol=1e-12)
        assert rows[0][1] == pytest.approx(expected["last"], rel=1e-12)


TABLES: dict[str, Any] = {
    "{'a': {'R': 1.0, 'f': (2.0, 3.0)}, 'b': {'R': 4.0, 'f': (g.F, 6.0)}}": "row['R'] * row['f'][0] + row['f'][1]",
    "{'a': [1.0, 2.0], 'b': [3.0, g.F]}": "np.array(row)",
    "{'a': lambda v: v**2, 'b': lambda v: 3 * v}": "row(g.F)",
    "{'a': np.array([1.0, 2.0]), 'b': np.array([3.0, 4.0])}": "row * g.F",
    "{'a': np.poly1d([1.0, 2.0]), 'b': np.poly1d([2.0, 3.0, 1.0])}": "row(g.F)",
}


@pytest.mark.office
def test_cells_count_the_rows_of_a_condition_that_rests_on_rows(recalculated_all: Any, tmp_path: Path) -> None:
    """They are numbered themselves: the numbers had waited for the count, which rests on them, and no cell had any."""
    lines = "sel = x > g.F\nz = np.ones(np.count_nonzero(sel)) * g.a  # [-] as many\nw = x[sel] + z  # [-] these"
    sheet = own(tmp_path, f"{lines}\ntable_2 = table('2', 'These', z, w)")
    names = sheet.run(sheet.results, {"g": sheet.inputs()})
    path = tmp_path / "own.xlsx"
    path.write_bytes(report.workbook("", {**names, "__file__": sheet.path}, {}))
    scenes: list[dict[str, Any]] = [{}, {"a": 1.5, "F": 2.0}, {"n": 6}, {"n": 3}]
    paths = [edit(path, each, tmp_path / f"{n}.xlsx") for n, each in enumerate(scenes)]
    for each, book in zip(scenes, recalculated_all(paths), strict=True):
        assert not any(
            str(cell.value).startswith("Err") for s in book.worksheets for row in s.iter_rows() for cell in row
        )
        shown = [[cell.value for cell in book["2 These"][letter][4:]] for letter in "AB"]
        numbers = by_cells(sheet.path, ["z", "w"], **each)
        if "n" in each:
            assert {x for column in shown for x in column} == {"#N/A"}
        else:
            np.testing.assert_allclose(shown, [numbers["z"], numbers["w"]], rtol=1e-12)
        assert verdicts(book)[MADE] == ("FAIL" if "n" in each else "PASS")


@pytest.mark.office
def test_cells_have_the_frequencies_of_a_chain_that_is_held_nowhere(recalculated_all: Any, tmp_path: Path) -> None:
    """What rotations leave beside the diagonal is so small that LibreOffice has no number for its square."""
    lines = "J = np.array([0.12, 0.03, 0.45])\nk = 1e4 * np.array([g.F, g.a])"
    lines += "\nK = np.array([[k[0], -k[0], 0], [-k[0], k[0] + k[1], -k[1]], [0, -k[1], k[1]]])"
    lines += "\ny = np.linalg.eigvalsh(K / np.sqrt(np.outer(J, J)))  # [-] squares"
    sheet = own(tmp_path, f"{lines}\ntable_2 = table('2', 'Two', y)")
    names = {**sheet.run(sheet.results, {"g": sheet.inputs()}), "__file__": sheet.path}
    path = tmp_path / "own.xlsx"
    path.write_bytes(report.workbook("Own", names, {}))
    given: list[dict[str, Any]] = [{}, {"F": 2.4, "a": 0.9}, {"F": 0.5}, {"F": 9.0}]
    edited = [edit(path, each, tmp_path / f"{k}.xlsx") for k, each in enumerate(given)]
    for each, book in zip(given, recalculated_all(edited), strict=True):
        found = [row[0].value for row in book["2 Two"].iter_rows(5, 7)]
        own_values = by_cells(sheet.path, ["y"], **each)["y"]
        np.testing.assert_allclose(found, own_values, rtol=1e-12, atol=1e-9, err_msg=str(each))


@pytest.mark.parametrize("table", TABLES)
def test_a_row_of_the_worksheets_own_table_follows_the_option(table: str, tmp_path: Path) -> None:
    lines = f"row = {table}[g.kind]\nresult = np.atleast_1d({TABLES[table]}) * 1  # [-] line"
    path = Path(own(tmp_path, lines).path)
    text = path.read_text().replace("import math\n", "import math\n    from typing import Literal\n", 1)
    path.write_text(text.replace('\n\n    """Inputs', '\n    kind: Literal["a", "b"] = "a"  # row\n\n    """Inputs', 1))
    sheet = cells.load(path)
    _, recording = recorded(sheet)
    assert not recording.gaps and not [guard for guard in recording.guards.values() if not guard.rows]
    for number, kind in enumerate("ab"):
        own_value = by_cells(sheet.path, ["result"], kind=kind, F=3.25)["result"]
        np.testing.assert_allclose(value_of(recording, "result", {"kind": number, "F": 3.25}), own_value, rtol=1e-12)


BANDED = """K = np.zeros((g.n, g.n))
for i in range(g.n):
    K[i, i] = 4 * g.F
    if i < g.n - 1:
        K[i, i + 1] = g.a
    if i > 0:
        K[i, i - 1] = g.a
y = np.linalg.solve(K, np.ones(g.n))"""


def test_a_matrix_is_assembled_of_rows_with_neighbours(tmp_path: Path) -> None:
    """The last row has none behind it: there is no element to leave as it is."""
    sheet = own(tmp_path, f"{BANDED}  # [-] line")
    _, recording = recorded(sheet)
    assert not recording.gaps
    for given in ({}, {"F": 4.0, "a": -0.5}):
        expected = by_cells(sheet.path, ["y"], **given)["y"]
        np.testing.assert_allclose(value_of(recording, "y", given), expected, rtol=1e-13)
    assert np.isnan(value_of(recording, "y", {"n": 4})).all()


@pytest.mark.parametrize("inside", [False, True])
@pytest.mark.parametrize("keeps", ["functools.cache", "functools.lru_cache", "functools.lru_cache(maxsize=8)"])
def test_a_function_that_keeps_its_values_is_followed(keeps: str, inside: bool, tmp_path: Path) -> None:
    """In each recording anew: what it kept of another one is none of it."""
    helpers = f"import functools\n@{keeps}\ndef square(v):\n    return v**2\n"
    helpers += f"@{keeps}\ndef cube(v):\n    return v * square(v)\nLAWS, POWERS = {{'cube': cube}}, [square]"
    lines = "p = 2 / square(g.F)  # [-] line\nq = 3 / cube(g.a)  # [-] line\n"
    lines += "r = LAWS['cube'](g.F) + POWERS[0](g.a)  # [-] line"
    sheet = own(tmp_path, f"{helpers}\n{lines}" if inside else lines)
    if not inside:
        path, indented = Path(sheet.path), helpers.replace("\n", "\n    ")
        path.write_text(path.read_text().replace("import math\n", f"import math\n    {indented}\n", 1))
        sheet = cells.load(path)
    for _ in range(2):
        _, recording = recorded(sheet)
        assert not recording.gaps and not [guard for guard in recording.guards.values() if not guard.rows]
        assert value_of(recording, "p", {"F": 4.0}) == 2 / 4.0**2
        assert value_of(recording, "q", {"a": 3.0}) == 3 / 3.0**3
        assert value_of(recording, "r", {"F": 4.0, "a": 3.0}) == 4.0**3 + 3.0**2


def test_a_number_under_many_conditions_is_told_in_a_text(tmp_path: Path) -> None:
    """Whether it is a whole one is asked of a number that is there while hundreds of conditions hold."""
    kept = "more = []\nfor d in range(700):\n    if d * g.a > 400:\n        more.append(d)\n"
    count = "k = len([v for v in (1, 2, 3) if v > g.F]) + len(more)"
    _, recording = recorded(own(tmp_path, f'{kept}{count}\nsaid = f"{{k}} of them"'))
    told = recording.values["said"]
    assert not recording.gaps and isinstance(told, Written) and told.now == "167 of them"


def test_a_root_that_cells_cannot_tell_is_told_in_words(tmp_path: Path) -> None:
    """Where no line is what is found, by what it is and not by an end of its interval."""
    lines = "from scipy.optimize import brentq\ny = brentq(lambda v: (v - g.F) * (v - 3) * (v - 7), 0, 9) + 1"
    _, recording = recorded(own(tmp_path, f"{lines}\nresult = y * 1  # [-] line"))
    search(recording)
    assert [gap.names for gap in recording.unsolved] == [("root 1",)]


RAISED = [
    "if g.k == 1:\n    C = 2 * g.F\nelif g.k == 2:\n    C = 3 * g.F\nelse:\n    raise ValueError('unknown')\ny = C + 1",
    (
        "match g.k:\n    case 0:\n        C = g.F\n    case 1:\n        C = 2 * g.F\n    case 2:\n        C = g.a\n"
        "    case _:\n        raise ValueError(f'unknown {g.k}')\ny = C + 1"
    ),
    (
        "def f(k, F):\n    if F <= 1:\n        raise ValueError('F')\n    if k == 1:\n        return 2 * F\n"
        "    elif k == 2:\n        return 3 * F\n    raise ValueError(f'unknown {k}')\ny = f(g.k, g.F) + 1"
    ),
    (  # raised only where the function is asked
        "def f(k, F):\n    if F <= 1:\n        raise ValueError('F')\n    return k * F\n"
        "y = (f(g.k, g.F) if g.k > 1 else 7.0) + (1.0 if g.k != 3 else f(g.k, g.F))"
    ),
]


@pytest.mark.parametrize("k", [1, 2])
@pytest.mark.parametrize("lines", RAISED)
def test_all_ways_that_do_not_raise_are_followed(lines: str, k: int, tmp_path: Path) -> None:
    """Whichever of them the worksheet goes; where it raises an error there is no number."""
    sheet = own(tmp_path, f'{lines}\nresult = np.atleast_1d(y) * 1.0  # [-] line\ntable_2 = table("2", "Two", result)')
    _, recording = recorded(sheet, k=k)
    for other, F in product(range(4), (2.5, 0.5, 4.0)):
        try:
            expected = by_cells(sheet.path, ["result"], k=other, F=F)["result"]
        except ValueError:
            expected = np.array([np.nan])
        known = numbers([recording.tables["2"][0].re], {recording.inputs["k"]: other, recording.inputs["F"]: F})
        np.testing.assert_allclose(known[recording.tables["2"][0].re], expected, rtol=1e-12, err_msg=f"{other} {F}")
