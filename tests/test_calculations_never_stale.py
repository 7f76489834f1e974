"""No number is stale of what an engineer writes in a cell: tables of gases and materials, load cases, statistics."""

from pathlib import Path

import numpy as np
import pytest
from never_stale import assert_never_stale
from own_worksheet import own, recorded

from mechsheet.readers.numbers import numbers

CONSTRUCTS = [
    "y = np.log(g.F - 2.0) * 0 + x * g.a",
    "y = g.a + len(f'{math.floor(g.F)}')",
    "T = {'M1': 0.25, 'M2': 0.4, 'M3': 0.5, 'M4': 0.7}\ny = T[f'M{math.floor(g.F)}'] * g.a",
    "y = 0.0 * np.sqrt(g.F - x) + g.a",
    "y = np.abs(0.0 * np.exp(1j * np.arcsin(g.F - 1.5))) + g.a",
    "y = np.abs(0j * np.sqrt(g.F - 2.0)) + np.abs((x + 0j) * 0.0) * g.a",
    "y = 0.0 / (x - g.F) * g.a",
    "y = 0.0 / np.sqrt(g.F - 2.0) * g.a",
    "y = np.array([0.0, 1.0]) @ np.array([np.log(g.F - 2.0), g.a])",
    "y = np.diag([1.0, g.a]) @ np.array([np.log(g.F - 2.0), 1.0])",
    "y = np.linalg.solve(np.diag([1.0, g.a]), [np.log(g.F - 2.0), 1.0])",
    (
        "T = np.array([300.0, 400, 600, 900])\ncp = np.array([1.005, 1.013, 1.051, 1.121])\n"
        "y = interp(300 * g.F, T, cp) * g.a"
    ),
    (
        "T = np.array([300.0, 400, 600, 900])\nh = np.cumsum(T) / g.F\n"
        "y = interp(g.a * 900, T, h) - interp(T, T * g.a, h)"
    ),
    "F_V, k_A = 20 * g.F, 1.6\nF_A = [1.0, g.F, 3.0]\ny = np.array([F_V / k_A + (1 - g.a) * F for F in F_A])",
    (
        "cases = {'start': (g.F, 1.0), 'stop': (1.0, g.a), 'idle': (0.2, 0.3)}\n"
        "y = max(np.hypot(*c) for c in cases.values())"
    ),
    (
        "cases = {'start': (g.F, 1.0), 'stop': (1.0, g.a)}\nworst = max(cases, key=lambda c: np.hypot(*cases[c]))\n"
        "y = cases[worst][0] * g.a"
    ),
    "materials = {'S235': 235.0, 'S355': 355.0}\nR_e = materials['S355' if g.F > 3 else 'S235']\ny = R_e / g.a",
    (
        "materials = {'S235': {'R': 235.0, 'E': 2.1}, 'S355': {'R': 355.0, 'E': 2.0}}\n"
        "m = materials['S355' if g.F > 3 else 'S235']\ny = m['R'] * m['E'] * g.a"
    ),
    "W = np.concatenate([[0.0], np.cumsum((x[1:] + x[:-1]) / 2 * np.diff(x))])\ny = W * g.a",
    "W = np.zeros_like(x)\nfor i in range(1, len(x)):\n    W[i] = W[i - 1] + (x[i] + x[i - 1]) * g.a\ny = W * 1.0",
    "W = np.zeros(len(x))\nW[1:] = np.cumsum(x[1:] * g.a)\ny = W * 1.0",
    "from scipy.integrate import cumulative_trapezoid\ny = cumulative_trapezoid(np.sin(x), x, initial=0) * g.a",
    "y = (x - x.mean()) / x.std(ddof=1) * g.a",
    "y = np.corrcoef(x, np.sin(x))[0, 1] * g.a",
    "y = np.cov(x, np.cos(x))[0, 1] * g.a",
    "y = np.quantile(x * np.cos(x), [0.1, 0.5, g.a / 2])",
    "y = np.percentile(np.cos(x * g.a), [25, 75])",
    "y = np.median(np.array([[g.F, 1.0, g.a], [2.0, 0.1, 3.0]]), axis=0)",
    "y = np.average(np.sin(x), weights=x**g.a)",
    "mask = (x > 1) & (x < g.F)\ny = np.where(mask, x, 0.0).sum() * g.a",
    "mask = (x > 1) & (x < g.F)\ny = x[mask].mean() * g.a if mask.any() else 0.0",
    "y = np.where(x > g.F, np.nan, x) * g.a",
    "v = np.where(x > g.F / 2, np.nan, x)\ny = np.nanmax(v) - np.nanmin(v) + np.nanmean(v) + np.nanstd(v)",
    "v = np.where(x > 2.0, np.nan, x)\ny = np.nan_to_num(v, nan=g.a)",
    "v = np.where(x > 2.0, np.nan, x)\ny = np.isnan(v).sum() * g.a",
    "y = np.where(np.isnan(np.sqrt(x - 2)), 0.0, x) * g.a",
    "y = np.select([x < 1, x < 2], [x * g.a, 1.0], default=np.nan)",
    "y = np.piecewise(x, [x < 1, x > g.F], [lambda v: v**2, 3.0, lambda v: -v])",
    "c = np.polyfit([0.0, 1.0, 2.0, 3.0], [g.F, 1.0, g.a, 2.0], 2)\ny = np.polyval(c, x)",
    "p = np.poly1d([g.F, 1.0, g.a])\ny = p(x) + p.deriv()(1.0)",
    "y = np.polyval(np.polyder([g.F, 2.0, 1.0]), x)",
    "y = np.polyval(np.polyint([g.F, 2.0, 1.0]), x) * g.a",
    "y = np.polymul([g.F, 1.0], [1.0, g.a]) * 1.0",
    "from numpy.polynomial import Polynomial\ny = Polynomial([1.0, g.F, g.a])(x)",
    "from numpy.polynomial import polynomial as P\ny = P.polyval(x, [1.0, g.F, g.a])",
    "y = np.roots([1.0, -g.F - 1, g.F]).real.max() * g.a",
    "y = np.trapezoid(np.vstack([x, x**2]), x, axis=1) * g.a",
    "y = np.trapezoid(np.abs(np.sin(x)), dx=g.a)",
    "y = np.gradient(np.sin(x), x[1] - x[0]) * g.a",
    "y = np.gradient(np.sin(x), x, edge_order=2) * g.a",
    "y = np.gradient(np.sin(x)) * g.a",
    "K = np.array([[2 * g.F, -g.F], [-g.F, g.F + g.a]])\ny = np.linalg.solve(K, [1.0, 2.0])",
    "K = np.diag([g.F - 2.5, g.a, 1.0])\ny = np.linalg.solve(K, [1.0, 2.0, 3.0]) if g.F != 2.5 else np.zeros(3)",
    "K = np.array([[0, g.F, 0], [g.a, 0, 0], [0, 0, 1.0]])\ny = np.linalg.solve(K, [1.0, np.log(g.F - 1.9), g.a])",
    "K = np.array([[2 * g.F, -g.F], [-g.F, g.F + g.a]])\ny = np.linalg.eigvalsh(K)",
    "K = np.array([[2 * g.F, -g.F], [-g.F, g.F + g.a]])\ny = np.sqrt(np.linalg.eigh(K)[0])",
    "K = np.array([[2 * g.F, -g.F], [-g.F, g.F + g.a]])\nw, V = np.linalg.eigh(K)\ny = V[1] / V[0]",
    "K = np.array([[2 * g.F, -g.F], [-g.F, g.F + g.a]])\nw, V = np.linalg.eigh(K)\ny = w * len(f'{V}')",
    "K = np.array([[2 * g.F, -g.F], [-g.F, g.F + g.a]])\ny = np.linalg.inv(K)[0] @ np.array([1.0, g.a])",
    "K = np.array([[2 * g.F, -g.F], [-g.F, g.F + g.a]])\ny = np.linalg.det(K) + np.linalg.norm(K) + np.trace(K)",
    "K = np.array([[2 * g.F, -g.F], [-g.F, g.F + g.a]])\ny = np.linalg.matrix_power(K, 2)[0]",
    (
        "K = np.array([[g.F, 1.0], [g.a, 3.0], [1.0, 1.0]])\n"
        "y = np.linalg.lstsq(K, np.array([1.0, g.F, 2.0]), rcond=None)[0]"
    ),
    (
        "K = np.array([[g.F, 1.0], [g.a, 3.0]])\n"
        "y = np.linalg.norm(K, axis=1) + np.linalg.norm(x, ord=1) + np.linalg.norm(x, np.inf)"
    ),
    "K = np.array([[g.F, 1.0], [g.a, 3.0]])\ny = np.linalg.cond(K) * g.a",
    "y = np.unwrap(np.angle(np.exp(3j * x))) * g.a",
    "y = np.unwrap(np.arctan2(np.sin(x * g.F), np.cos(x * g.F)))",
    "y = np.cross([g.F, 1.0, 0.0], [0.0, g.a, 2.0])",
    "r, f = np.array([g.F, 1.0]), np.array([g.a, 2.0])\ny = r[0] * f[1] - r[1] * f[0] + np.dot(r, f)",
    "y = np.outer(x, [1.0, g.a]).sum(axis=1)",
    "y = np.einsum('i,j->ij', x, np.array([1.0, g.a]))[:, 1]",
    "y = np.einsum('ij,j->i', np.array([[g.F, 1.0], [g.a, 2.0]]), [1.0, g.a])",
    "y = np.tensordot(x, x, axes=1) * g.a",
    "y = np.kron([1.0, g.F], [g.a, 2.0])",
    "y = np.histogram(x, bins=[0.0, 1.0, 2.0, 9.0])[0] * g.a",
    "y = np.histogram(x, 3, weights=x)[0] * g.a",
    "edges = np.array([0.0, 1.0, 2.0, 4.0])\ny = np.array([10.0, 20, 30, 40, 50])[np.searchsorted(edges, x)] * g.a",
    "d = np.array([6.0, 8, 10, 12, 16, 20])\ny = d[np.searchsorted(d, 3 * g.F)] * g.a",
    "d = np.array([6.0, 8, 10, 12, 16, 20])\ny = d[d >= 3 * g.F][0] * g.a",
    "d = np.array([6.0, 8, 10, 12, 16, 20])\ny = d[d >= 3 * g.F].min() * g.a",
    "d = [6.0, 8.0, 10.0, 12.0, 16.0]\ny = next(v for v in d if v >= 3 * g.F) * g.a",
    "d = [6.0, 8.0, 10.0, 12.0, 16.0]\ny = min((v for v in d if v >= 3 * g.F), default=20.0) * g.a",
    "d = [6.0, 8.0, 10.0, 12.0, 16.0]\ny = min(d, key=lambda v: abs(v - 3 * g.F)) * g.a",
    "d = np.array([6.0, 8, 10, 12, 16, 20])\ny = d[np.argmin(np.abs(d - 3 * g.F))] * g.a",
    "d = np.array([6.0, 8, 10, 12, 16, 20])\ny = d[np.argmax(d >= 3 * g.F)] * g.a",
    "t = sorted([(g.F, 1.0), (g.a, 2.0), (1.5, 3.0)])\ny = t[0][1] * g.F",
    (
        "t = sorted([(g.F, 1.0), (g.a, 2.0), (1.5, 3.0)], key=lambda r: r[0], reverse=True)\n"
        "y = np.array([r[1] for r in t]) * g.F"
    ),
    "F = np.array([g.F, g.a, 1.5])\norder = np.argsort(F)\ny = np.array([1.0, 2.0, 3.0])[order] * g.a",
    "F = np.array([[g.F, 1.0], [g.a, 2.0], [1.5, 3.0]])\ny = F[F[:, 0].argsort()][:, 1] * g.a",
    "y = np.unique(np.array([1.0, g.F, 1.0, g.a])) * 2",
    "v, n = np.unique(np.floor(x), return_counts=True)\ny = n * g.a",
    (
        "def area(d, t=2.0):\n    def inner(d):\n        return d - 2 * t * g.a\n"
        "    return np.pi / 4 * (d**2 - inner(d) ** 2)\ny = area(g.F) + area(x, t=0.5)"
    ),
    (
        "def stress(case):\n    F, M = case\n    return F / g.a + M / (g.F * 0.1)\n"
        "y = np.array([stress(c) for c in [(1.0, 2.0), (g.F, g.a), (3.0, 0.0)]])"
    ),
    "sigma = np.array([[F / A for F in (1.0, g.F)] for A in (g.a, 2.0)])\ny = sigma.max(axis=0) - sigma.min(axis=1)",
    "A = np.arange(12.0).reshape(3, 4) * g.F\ny = A[1:, ::2].sum(axis=1) * g.a",
    "A = np.arange(12.0).reshape(3, 4) * g.F\nA[:, 1] = g.a\nA[2] *= 2\ny = A.max(axis=0)",
    (
        "A = np.zeros((3, 3))\nfor i in range(3):\n    for j in range(3):\n        A[i, j] = g.F / (i + j + 1)\n"
        "y = A @ [1.0, g.a, 0.0]"
    ),
    "A = np.diag([g.F, g.a, 1.0])\ny = A.sum(axis=0)",
    "A = np.triu(np.outer([1.0, g.F], [g.a, 2.0]))\ny = A.ravel()",
    "A, B = np.meshgrid([1.0, g.F], x)\ny = (A * B).max(axis=0)",
    "A = x[:, None] * np.array([1.0, g.a])[None, :]\ny = A.argmax(axis=0) + A.sum(axis=0)",
    "y = np.apply_along_axis(lambda r: r.sum() * g.a, 1, np.outer(x, x))",
    "y = np.array(list(map(lambda v: v * g.a, x)))",
    "y = sum(v * w for v, w in zip(x, x[::-1])) * g.a",
    "y = np.array([i * v for i, v in enumerate(x)]) * g.a",
    "y = math.sqrt(sum(v**2 for v in (g.F, g.a, 1.0)))",
    "y = math.prod([g.F, g.a, 2.0]) + math.fsum([g.F, g.a])",
    "y = math.prod(v + g.a for v in (g.F, 1.0))",
    "y = math.fsum(v * g.a for v in (g.F, 1.0)) * g.F",
    "y = math.prod([g.F, 2.0], start=g.a) + math.modf(g.F)[0] + math.remainder(g.F, 0.4) + math.ldexp(g.a, 2)",
    "y = math.comb(g.n, 2) * g.F + math.factorial(g.k) + math.perm(g.n, g.k) * g.a + math.isqrt(g.n * 5)",
    "y = g.F / math.factorial(25) * 1e25 + g.a * math.prod(range(1, 25))",
    "y = np.fromiter((v * g.a for v in (g.F, 1.0)), float).sum()",
    "y = g.F * g.a if type(g.F) is float else 'none'",
    "y = {float: g.F, int: g.a}.get(type(g.F), [])",
    "y = math.degrees(math.atan2(g.F, g.a)) + math.hypot(g.F, g.a, 1.0)",
    "y = abs(complex(g.F, g.a)) + np.angle(complex(g.F, g.a), deg=True)",
    "z = g.F * np.exp(1j * x)\ny = z.real * g.a + z.imag",
    "y = np.linspace(0, g.F, 4)[-1] * g.a + np.linspace(0, 1, 3, endpoint=False)[1]",
    "y = np.geomspace(1.0, g.F, 4)",
    "y = np.logspace(0, g.a, 3)",
    "y = np.arange(0, g.F, 0.5)[-1] * g.a",
    "y = np.diff(np.sign(x - g.F))[np.newaxis].sum() * g.a",
    "s = np.sin(3 * x)\ni = np.where(np.diff(np.sign(s)))[0]\ny = x[i[0]] * g.a if len(i) else 0.0",
    "s = np.sin(3 * x)\ny = x[s.argmax()] - x[s.argmin()]",
    "y = np.max(np.abs(np.fft.rfft(x))) * g.a",
    "y = np.convolve(x, np.ones(3) / 3, mode='same') * g.a",
    "y = np.minimum(np.maximum(x, g.a), g.F).sum()",
    "y = np.clip(x, None, g.F) - np.clip(x, g.a, None)",
    "y = np.round(g.F * 10) / 10 + np.ceil(g.a) + math.floor(g.F)",
    "y = math.ceil(g.F / 0.4) * 0.4 * g.a",
    "y = 5 * round(g.F / 0.4) * g.a",
    "y = np.prod([1 + v for v in (g.F, g.a)])",
    "k = 'a' * int(g.F)\ny = len(k) * g.a",
    "grade = ('8.8', '10.9', '12.9')[g.k - 1]\nR_m = float(grade.split('.')[0]) * 100\ny = R_m * g.a",
    "y = 1.0 if 2 <= g.F < 3 else g.a if g.F < 2 else 3.0",
    "def step(v):\n    match v > 3:\n        case True:\n            return 2.0\n    return g.a\ny = step(g.F) * 1.0",
    (
        "from dataclasses import dataclass\n@dataclass\nclass Bolt:\n    d: float\n    def area(self):\n"
        "        return np.pi * self.d**2 / 4\ny = Bolt(g.F).area() * g.a"
    ),
    (
        "from typing import NamedTuple\nclass Case(NamedTuple):\n    F: float\n    M: float\n"
        "y = max(c.F + c.M for c in (Case(g.F, 1.0), Case(1.0, g.a)))"
    ),
    (
        "from collections import defaultdict\nsums = defaultdict(float)\nfor i, v in enumerate(x):\n"
        "    sums[i % 2] += v\ny = sums[1] * g.a"
    ),
    "n = 0\nfor v in x:\n    if v > 1.0:\n        n += 1\ny = n * g.a",
    "F_max = -1e9\nfor v in x * np.cos(x):\n    if v > F_max:\n        F_max = v\ny = F_max * g.a",
    "i_max = 0\nfor i in range(5):\n    if np.sin(x[i]) > np.sin(x[i_max]):\n        i_max = i\ny = x[i_max] * g.a",
    "y = np.interp(g.F, x / g.F, np.sin(x), period=2.0)",
    "y = np.interp(x + 7, [-1.0, g.a, 3.0, 6.0], [1.0, 3.0, g.F, 1.0], period=g.F + 3)",
    "y = np.interp(x, np.sort([g.F, g.a, 1.0]), [1.0, 2.0, 3.0])",
    "y = np.sinc(x) + np.deg2rad(g.F) + np.rad2deg(g.a)",
    "y = np.nanargmax(np.where(x > 2.0, np.nan, x)) * g.a",
    "y = np.nancumsum(x)[-1] * g.a + np.nanprod([g.F, np.nan])",
    "y = np.mean(np.vstack([x, 2 * x]), axis=0) - np.std(np.vstack([x, 2 * x]), axis=0)",
    "y = np.full(3, g.F) + np.ones_like(x)[:3] * g.a",
    "y = np.insert(x, 1, g.a)",
    "y = np.hstack([x, g.F]) * g.a",
    "y = np.r_[x, g.F] * g.a",
    "y = np.c_[x, x * g.a][:, 1]",
    "y = x[[0, -1]] * g.a + x[np.array([1, 2])]",
    "y = x[-1] - x[0] + x[len(x) // 2]",
    "a, *rest = x\ny = a * g.a + sum(rest)",
    "(a, b), c = (g.F, g.a), 2.0\ny = a * b + c",
    "y = np.ma.masked_greater(x, 2.0).mean() * g.a",
    "y = x.clip(g.a, g.F).cumsum().round(3)",
    "y = np.take(x, [0, int(g.F)]) * g.a",
    "y = np.choose(g.k, [1.0, g.F, g.a, 3.0])",
    "y = np.vectorize(lambda F: F * g.a if F > 1.0 else 0.0)(x)",
    "v = x.copy()\nv[0] = 9.0\nw = np.minimum(v, 3.0)\ny = v.max() + w.min() * g.a",
    "v = x * 1.0\nv[-1] = 0.5\ny = v.min() + v.max() * g.a",
    "v = x * 1.0\nv[0] = 5.0\ny = np.max(v) - np.ptp(v)",
    "v = np.array([1, 2, 3])\nv[0] = g.k * g.F\ny = v * g.a",
    "v = np.zeros(g.n, int)\nv[1] = 2 * g.F\ny = v * g.a",
    "i = np.arange(g.n)\nv = np.zeros_like(i)\nv[:] = x\ny = v * g.a",
    "y = 3.0 if (g.F > 3) is True else g.a",
    (
        "match g.F > 3, g.k:\n    case True, 2:\n        k = 5.0\n    case False, _:\n        k = 7.0\n"
        "    case _:\n        k = 9.0\ny = k * g.a"
    ),
]
ITERATIONS = [
    (
        "v = 1.0\nfor _ in range(100):\n    new = math.cos(v) * g.a\n    if abs(new - v) < 1e-10:\n        break\n"
        "    v = new\ny = v * 1.0"
    ),
    "v = g.F\nwhile abs(v * v - g.F) > 1e-12:\n    v = (v + g.F / v) / 2\ny = v * 1.0",
    (
        "v, n = g.F, 0\nwhile True:\n    step = (v**3 - g.F) / (3 * v**2)\n    v -= step\n    n += 1\n"
        "    if abs(step) < 1e-12:\n        break\ny = np.array([v, n])"
    ),
    (
        "lo, hi = 0.0, 10.0\nwhile hi - lo > 1e-9:\n    mid = (lo + hi) / 2\n    if mid**3 + g.a * mid > g.F:\n"
        "        hi = mid\n    else:\n        lo = mid\ny = (lo + hi) / 2"
    ),
    (
        "tol = 10.0 ** -g.k\nv = 1.0\nfor n in range(50):\n    new = (v + g.F / v) / 2\n"
        "    done = abs(new - v) < tol\n    v = new\n    if done:\n        break\ny = np.array([v, n])"
    ),
    (
        "def solved(F, start=1.0):\n    v = start\n    for _ in range(50):\n        new = (v + F / v) / 2\n"
        "        if abs(new - v) < 1e-12:\n            break\n        v = new\n    return v\ny = solved(g.F) * g.a"
    ),
    "v = x * 0 + 1\nwhile np.max(np.abs(v * v - x)) > 1e-12:\n    v = (v + x / v) / 2\ny = v * 1.0",
    (
        "lam = 0.02\nfor _ in range(100):\n"
        "    new = 1 / (-2 * math.log10(1e-4 / 3.7 + 2.51 / (1e5 * g.F * math.sqrt(lam)))) ** 2\n"
        "    if abs(new - lam) < 1e-14:\n        break\n    lam = new\ny = lam * 1.0"
    ),
    (
        "z = 1.0 + 0.5j\nwhile abs(z * z - (g.F + 1j * g.a)) > 1e-12:\n    z = (z + (g.F + 1j * g.a) / z) / 2\n"
        "y = z.imag * 1.0"
    ),
    "n = 0\ns = 0.0\nwhile s < 10 * g.F:\n    n += 1\n    s += n * g.a\ny = np.array([s, n])",
    "d = 6.0\nwhile g.F * 100 / d**2 > g.a:\n    d += 2.0\ny = d * 1.0",
    "for d in (6.0, 8.0, 10.0, 12.0, 16.0):\n    if g.F * 100 / d**2 < g.a * 4:\n        break\ny = d * g.a",
    (
        "for d in np.array([6.0, 8.0, 10.0, 12.0]):\n    if d < 8.5:\n        continue\n"
        "    if g.F * 100 / d**2 < g.a * 4:\n        break\ny = d * g.a"
    ),
    "v = 1.0\nk = 0\nwhile k < g.k:\n    v = v * g.F\n    k += 1\ny = v * 1.0",
    (
        "v = g.F\nhistory = []\nwhile v > 0.1:\n    history.append(v)\n    v = v / (2 + g.a**2)\n"
        "y = np.array([len(history), v])"
    ),
    "for i in range(5):\n    if x[i] > 1.2:\n        break\nelse:\n    i = 9\ny = i * g.a",
]


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("lines", [*CONSTRUCTS, *ITERATIONS])
def test_no_number_is_stale(lines: str, tmp_path: Path) -> None:
    assert_never_stale(lines, tmp_path)


COUNTED = "y = 0.0\nfor i in range(g.n**2):\n    y = y + 1.0"  # what nobody follows for another number
FORMER = [  # of which the value before is left, or added to
    f"{COUNTED}\ny += g.F",
    f"{COUNTED}\nfor j in range(2):\n    y *= g.a",
    f"{COUNTED}\nif g.F > 3:\n    y = g.a",
    f"{COUNTED}\nif g.F > 3:\n    y = g.a\nelif g.a > 0.8:\n    y = 2.0",
    f"{COUNTED}\nfor j in range(g.n - 5):\n    y = g.a",
    f"{COUNTED}\nj = g.F\nwhile j > 3:\n    y, j = g.a, j - 1",
    "y = g.F\nfor i in range(3):\n    y -= math.gamma(i + g.a + 1)",
    "y = g.F\nif math.gamma(g.a + 1) > 3:\n    y = 5.0",
    "y = g.F\ntry:\n    y = math.gamma(g.a + 1) / 0.0\nexcept ZeroDivisionError:\n    pass",
    "y = g.F\nfor i in range(int(math.gamma(g.a + 1) - 1)):\n    y = 2.0",
    "y = g.F\ny += math.gamma(g.a + 1)",
    "y, k = g.F, 0\nwhile math.gamma(k + g.a) < 5:\n    k += 1\n    y *= 2",
]


@pytest.mark.parametrize("lines", FORMER)
def test_what_a_name_was_before_is_no_number_of_other_inputs(lines: str, tmp_path: Path) -> None:
    """A statement that only adds to a name, or may leave it, takes over what stood behind it."""
    assert_never_stale(lines, tmp_path)


OF_TWO = "z = np.array([1.0, g.a])\n"
SHARED = [  # an array with another name, changed in place for other inputs alone
    f"{OF_TWO}w = z\nif g.F > 3:\n    z += g.F\ny = w.sum() + g.a",
    f"{OF_TWO}w = z\nif g.F > 3:\n    z[0] = g.F\ny = w.sum() + g.a",
    f"{OF_TWO}w = z[:1]\nfor i in range(g.n - 5):\n    z += g.a\ny = w.sum() + g.a",
    f"{OF_TWO}w = {{'first': z}}\nfor i in range(g.n - 5):\n    z += g.a\ny = w['first'].sum() + g.a",
    f"{OF_TWO}w = z\nwhile g.n - 4 > z[0]:\n    z += g.a\ny = w.sum() + g.a",
    "z = np.array([1.0, 2.0])\nw = z\nfor i in range(g.n - 5):\n    z += g.a\ny = w.sum() + g.a",
    f"{OF_TWO}w = z\nz += g.a - 0.7\ny = w.sum() * 1.0",
    "L = [g.a]\nM = L\nfor i in range(g.n - 5):\n    L.append(L[-1] * g.a)\ny = sum(M)",
]


@pytest.mark.parametrize("lines", SHARED)
def test_an_array_has_the_same_numbers_under_each_of_its_names(lines: str, tmp_path: Path) -> None:
    """What changes it in place says so, or is seen, at all of them."""
    assert_never_stale(lines, tmp_path)


POINTS = "points = np.array([1 + 1j * g.a, 2 + 2j, 3 - 1j * g.F])\n"
PARTS = [  # Python has an error for other inputs, where the imaginary part had been 0
    f"{POINTS}y = next(p for p in points if p.real > g.F).imag * 1",
    f"{POINTS}y = points[points.real > g.F][0].imag * 1",
    "if g.F > 2:\n    P = g.F * 1j\ny = P.imag * 1",
    "i = 0\nwhile i * g.a < 3 - g.F:\n    P = i * 1j + g.a\n    i = i + 1\ny = P.imag * 1",
]


@pytest.mark.parametrize("lines", PARTS)
def test_no_part_of_a_complex_number_is_one_where_there_is_none(lines: str, tmp_path: Path) -> None:
    assert_never_stale(lines, tmp_path)


def test_no_part_of_a_point_is_one_where_what_python_saw_is_another(tmp_path: Path) -> None:
    """The workbook had the ordinate 0 of a point of which it had no abscissa."""
    _, recording = recorded(own(tmp_path, "P = g.a * int(bin(g.k), 2) + 1j * g.F  # [-] point"))
    parts = [*recording.values["P"].parts]
    for given, known in [({"F": 3.25}, [1.5, 3.25]), ({"k": 3}, [np.nan, np.nan])]:
        found = numbers(parts, {recording.inputs[name]: x for name, x in given.items()})
        np.testing.assert_array_equal([found[part] for part in parts], known)


OF = "from numpy.polynomial import Polynomial\n"
POLYNOMIALS = [  # those of numpy that it advises, the lowest power first
    f"{OF}p = Polynomial([0.0, 1.0, 2.0])\ny = p(x) + p.deriv(2)(g.a) + p.deriv(5)(x) + p.roots()[0]",
    "p = np.polynomial.Polynomial([1.0, g.F, g.a])\ny = p(x[x > 1.0]).sum() + p.integ(2, k=[g.a, 1.0], lbnd=0.5)(x)",
    f"{OF}p, q = Polynomial([1.0, g.F]), Polynomial([g.a, -1.0])\ny = (p * q - 2 * p + 1 - q / 3 + (1 - q) ** 2)(x)",
    f"{OF}y = (Polynomial([1.0, g.a - 0.2]) * Polynomial([1.0, 2.0])).degree() * g.F",
    f"{OF}y = Polynomial([-g.F, 0.5, g.a]).roots() + Polynomial([3.0, 0.5, 1.0 + g.a]).roots().imag",
    f"{OF}p = Polynomial.fit(x, np.sin(x) * g.a, 3)\ny = p.deriv()(x) + p.convert().coef[1]",
    f"{OF}p = Polynomial([1.0, g.a]) if g.F > 3 else Polynomial([1.0, 2.0, 3.0])\ny = p(x) + len(p)",
    (
        "from numpy.polynomial import polynomial as of\ny = of.polyval(x, [1.0, g.F, g.a]) + of.polyfit(x, x**2, 2)[2]"
        "\ny += of.polyval(g.a, of.polyder([1.0, 2.0, g.F])) + of.polyval(x, of.polymul([1.0, g.a], of.polyint([g.F])))"
    ),
]


@pytest.mark.parametrize("lines", POLYNOMIALS)
def test_polynomials_of_the_lowest_power_first_follow(lines: str, tmp_path: Path) -> None:
    """Of none but poly1d there had been numbers for other inputs: numpy's own code makes arrays of what it is given."""
    assert_never_stale(lines, tmp_path)
    assert not recorded(own(tmp_path, lines))[1].gaps


NOT_TOLD = [
    (
        f"{OF}y = Polynomial.fit(x, x**3 * g.a, 3).coef[1] * 1.0",
        "the coefficients of a fitted Polynomial but for those of convert()",
    ),
    (f"{OF}y = Polynomial([1.0, g.a]).linspace(5)[1]", "linspace of a Polynomial"),
    ("from scipy.interpolate import CubicSpline\ny = CubicSpline(x, x**2 * g.a).solve(0.5)[0]", "solve of a spline"),
    ("t = find(lambda t: t * g.a, 0, 1, equals=g.F - 2)\ny = 7.0 if t.reason else t.value", "reason of what is found"),
]


@pytest.mark.parametrize(("lines", "reason"), NOT_TOLD)
def test_what_is_not_told_of_a_curve_is_named(lines: str, reason: str, tmp_path: Path) -> None:
    """It had been said that a Curve or a Solving, of which the worksheet knows nothing, has no such attribute."""
    assert_never_stale(lines, tmp_path)
    (gap,) = recorded(own(tmp_path, lines))[1].gaps
    assert gap.reason == reason


def test_a_field_of_points_on_an_axis_is_one_of_points(tmp_path: Path) -> None:
    """A page had the length 500 mm for other inputs where the worksheet has the point (500, 0) mm."""
    _, recording = recorded(own(tmp_path, "P = g.a + 0j * x  # [-] point"))
    across, up = recording.values["P"].parts
    found = numbers([across, up], {recording.inputs["a"]: 3.0})
    assert (found[across] == 3.0).all() and (found[up] == 0.0).all()


AMONG = [
    "y = np.where(np.isin(x, [x[1], g.F]), x, g.a) + np.isin(g.k, [2, 3])",
    "y = x[~np.isin(np.arange(len(x)), [0, g.k])].sum() + np.isin([[1, 2], [g.k, 4]], [[2]], invert=True).sum() * g.a",
    "y = 'ABCDE'.index('C' if g.a < 1 else 'D') * g.F",
]


@pytest.mark.parametrize("lines", AMONG)
def test_what_is_among_others_follows(lines: str, tmp_path: Path) -> None:
    """It was an array made of a quantity, or must be str, not Written."""
    assert_never_stale(lines, tmp_path)
    assert not recorded(own(tmp_path, lines))[1].gaps


SORTED_OUT = [
    (
        "d = {'tie': [], 'strut': []}\nfor v in [g.F, g.a, 2.0]:\n    d['tie' if v > 1 else 'strut'].append(v)\n"
        "y = sum(d['tie']) + len(d['strut'])"
    ),
    "d = {'1': [g.F], '2': []}\nfor v in [g.a, 2.0]:\n    d[f'{math.ceil(v)}'].extend([v, 1.0])\ny = sum(d['2'])",
    "L = [[], [], [], []]\nfor v in [g.F, g.a, 2.0]:\n    L[math.floor(v) % 4].append(v)\ny = len(L[2]) + sum(L[0])",
]


@pytest.mark.parametrize("lines", SORTED_OUT)
def test_what_is_sorted_into_lists_follows(lines: str, tmp_path: Path) -> None:
    """What stood in one of several lists was appended to a copy, so that all would differ from the worksheet."""
    assert_never_stale(lines, tmp_path)
    assert not recorded(own(tmp_path, lines))[1].gaps


SPEAKS = """from dataclasses import dataclass
@dataclass
class Rod:
    d: float
    def __SAYS__(self):
        return OF
"""
RODS = "T = [Rod(1.0), Rod(g.F), Rod(3.0), Rod(2.0)]\nc = T[g.k]\n"
SPECIAL = [
    SPEAKS.replace("SAYS", "bool").replace("OF", "self.d > 2") + RODS + "y = g.a if c else 2.0",
    SPEAKS.replace("SAYS", "len").replace("OF", "int(self.d > 2)") + RODS + "y = g.a if c else 2.0",
    SPEAKS.replace("SAYS", "str").replace("OF", "f'{self.d:.1f}'") + RODS + "y = g.a if str(c) == '2.0' else 2.0",
    SPEAKS.replace("SAYS", "str").replace("OF", "f'{self.d:.1f}'") + RODS + "y = g.a if f'{c}' == '2.0' else 2.0",
]


@pytest.mark.parametrize("lines", SPECIAL)
def test_an_object_says_itself_whether_it_is_true(lines: str, tmp_path: Path) -> None:
    """One of several was true and had a text of its own, whatever its class says of that."""
    assert_never_stale(lines, tmp_path)


REFUSED = [
    "y = np.geomspace(abs(g.F - 3.25), 2.0, 4)",
    "y = np.geomspace(g.a, abs(g.F - 3.25), 4)",
    "y = np.average([1.0, 2.0], weights=[g.F, -3.25])",
    "y = np.average(x, weights=x * (g.F - 3.25))",
    "y = math.comb(2 - g.k, 1) * g.F",
    "y = math.comb(5, 2 - g.k) * g.F",
    "y = math.perm(2 - g.k, 2) * g.F",
    "y = np.histogram(x, bins=3, range=(3.0, g.F + 1))[0]",
]


@pytest.mark.parametrize("lines", REFUSED)
def test_what_numpy_or_math_refuses_has_no_number(lines: str, tmp_path: Path) -> None:
    """The formula that stands for it goes on: a number stood where the worksheet raises an error."""
    assert_never_stale(lines, tmp_path)


LACKING = "w = np.log(x - g.a)\n"  # of which some are none
ENDLESS = "w = 1 / (x - x[1] * (g.F > 3))\n"  # of which one is infinite
NUMBERLESS = [
    *(f"{LACKING}y = {of}" for of in (
        "np.sort(w)", "np.sort(w[:4])", "np.median(w)", "np.median(w[:4])", "np.percentile(w, 90)",
        "np.argsort(w, kind='stable')", "np.searchsorted([0.0, 1.0, 2.0], w)", "np.digitize(w, [0.0, 1.0, 2.0])",
        "np.heaviside(w, 0.5)", "np.gradient(w)", "np.gradient(w, g.F)", "np.fmin(w, 0.5)", "np.isnan(w)",
    )),
    *(f"{ENDLESS}y = {of}" for of in (
        "np.isinf(w)", "np.isnan(w) + 2 * np.isfinite(w)", "np.fmax(w, 2.0)", "np.fmin(-w, 2.0)", "np.allclose(w, w)",
    )),
    "y = np.linalg.det([[g.F - 3.25, 1.0], [g.F - 3.25, 2.0]])",
    "y = np.arctan2(0 - (g.k - 3), -g.a)",
    "y = np.angle(-g.F - 1j * (g.k - 3))",
    "y = np.sqrt(-g.F - 1j * (g.k - 3)).imag",
]  # fmt: skip


@pytest.mark.filterwarnings("ignore::RuntimeWarning")  # of numpy's, of these numbers
@pytest.mark.parametrize("lines", NUMBERLESS)
def test_what_is_none_or_infinite_or_zero_is_as_numpy_has_it(lines: str, tmp_path: Path) -> None:
    """What is no number stood among those in order, no infinite one was, and 0 - x was -0."""
    assert_never_stale(lines, tmp_path)
