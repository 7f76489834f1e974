"""Polynomials of recorded coefficients, the highest power first, as numpy has them."""

from typing import Any

import numpy as np

from mechsheet.recording.graph import Graph, NotRecorded
from mechsheet.recording.quantity import lift


def value(graph: Graph, p: Any, x: Any) -> Any:
    value: Any = 0.0
    for c in p:
        value = value * x + c
    return value


def derivative(graph: Graph, p: Any) -> Any:
    p = lift(graph, p)
    return p[:-1] * np.arange(len(p) - 1, 0, -1)


def integral(graph: Graph, p: Any) -> Any:
    p = lift(graph, p)
    return np.concatenate([p / np.arange(len(p), 0, -1), np.zeros(1)])


def convolved(graph: Graph, p: Any, q: Any, mode: str = "full") -> Any:
    """numpy's convolve, of all places."""
    p, q = lift(graph, p), lift(graph, q)
    if mode != "full":
        raise NotRecorded(f"numpy's convolve of the mode {mode!r}")
    rows = [np.concatenate([np.zeros(k), c * q, np.zeros(len(p) - 1 - k)]) for k, c in enumerate(p)]
    return lift(graph, rows).reduced("sum", 0)


def added(graph: Graph, p: Any, q: Any) -> Any:
    p, q = lift(graph, p), lift(graph, q)
    count = max(len(p), len(q))
    longer = [np.concatenate([np.zeros(count - len(r)), r]) for r in (p, q)]
    return longer[0] + longer[1]
