"""Polynomials of recorded coefficients, the highest power first, as numpy has them."""

from typing import Any

import numpy as np

from mechsheet.quantities.arithmetic import choice
from mechsheet.quantities.graph import Graph, NotRecorded, current
from mechsheet.quantities.quantity import has_quantity, lift
from mechsheet.quantities.truths import are_truths


def value(graph: Graph, p: Any, x: Any) -> Any:
    value: Any = 0.0
    for c in p:
        value = value * x + c
    return value


def roots(graph: Graph, p: Any) -> Any:
    """numpy's roots of a line or a parabola in its order: first the greater, or with an imaginary part above 0."""
    first, *others = lift(graph, p)
    if len(others) not in (1, 2) or any(c.im is not None for c in (first, *others)):
        raise NotRecorded("numpy's roots of other than one or two, whose order is that of its search")
    if not first != 0:
        raise NotRecorded("numpy's roots of a polynomial that begins with 0")
    if len(others) == 1:
        return lift(graph, [-others[0] / first])
    half, product = others[0] / first / 2, others[1] / first
    apart = half * half - product
    if apart >= 0:
        greater = -half + choice(graph, half < 0, 1.0, -1.0) * np.sqrt(apart)
        return lift(graph, [greater, choice(graph, greater == 0, 0.0, product / greater)])
    return lift(graph, [-half + 1j * np.sqrt(-apart), -half - 1j * np.sqrt(-apart)])


def derivative(graph: Graph, p: Any, m: int = 1) -> Any:
    p = lift(graph, p)
    return p if not m else derivative(graph, p[:-1] * np.arange(len(p) - 1, 0, -1), m - 1)


def integral(graph: Graph, p: Any, m: int = 1, k: Any = None) -> Any:
    p, k = lift(graph, p), lift(graph, 0.0 if k is None else k)
    for n in range(m):
        constant = k[n] if k.ndim and len(k) > 1 else k.reshape(())
        p = np.concatenate([p / np.arange(len(p), 0, -1), constant[None]])
    return p


def convolved(graph: Graph, p: Any, q: Any, mode: str = "full") -> Any:
    """numpy's convolve."""
    p, q = lift(graph, p), lift(graph, q)
    if are_truths(p, q):
        raise NotRecorded("numpy's convolve of truths")
    rows = [np.concatenate([np.zeros(k), c * q, np.zeros(len(p) - 1 - k)]) for k, c in enumerate(p)]
    whole, (less, more) = lift(graph, rows).reduced("sum", 0), sorted((len(p), len(q)))
    start = {"full": 0, "same": (less - 1) // 2, "valid": less - 1}[mode]
    return whole[start : {"full": more + less - 1, "same": start + more, "valid": more}[mode]]


def added(graph: Graph, p: Any, q: Any) -> Any:
    p, q = lift(graph, p), lift(graph, q)
    count = max(len(p), len(q))
    longer = [np.concatenate([np.zeros(count - len(r)), r]) for r in (p, q)]
    return longer[0] + longer[1]


def without_zeros(graph: Graph, p: Any, trim: str = "fb") -> Any:
    """numpy's trim_zeros, of which Python sees which coefficients are none."""
    p = lift(graph, p)
    while "f" in trim.lower() and len(p) and p[0] == 0:
        p = p[1:]
    while "b" in trim.lower() and len(p) and p[-1] == 0:
        p = p[:-1]
    return p


def polynomial(p: Any, *given: Any, **named: Any) -> np.poly1d:
    """numpy's poly1d."""
    return np.poly1d(lift(current.get(), p) if has_quantity(p) else p, *given, **named)
