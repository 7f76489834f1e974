"""Matrix products and small systems of linear equations of recorded quantities."""

from typing import Any

import numpy as np

from mechsheet.recording.arithmetic import absolute, choice
from mechsheet.recording.graph import Graph, NotRecorded
from mechsheet.recording.quantity import lift, moved

_MOST = 6  # equations


def product(graph: Graph, x: Any, y: Any) -> Any:
    """The matrix product, as numpy's matmul and dot have it for one and two axes."""
    x, y = lift(graph, x), lift(graph, y)
    if not x.ndim or not y.ndim:
        return x * y
    if y.ndim == 1:
        return (x * y).reduced("sum", -1)
    if x.ndim == 1:
        return (x[:, None] * y).reduced("sum", -2)
    return (x[..., :, :, None] * y[..., None, :, :]).reduced("sum", -2)


def outer(graph: Graph, x: Any, y: Any) -> Any:
    return lift(graph, x).reshape(-1, 1) * lift(graph, y).reshape(-1)


def _eliminated(graph: Graph, A: Any, right: list[list[Any]]) -> tuple[list[list[Any]], Any]:
    """Upper triangles of square matrices on the last axes, and the signs of their rows' orders, greatest pivots first.

    ``right`` are the right sides by rows, which are changed with them.
    """
    A = lift(graph, A)
    size = A.shape[-1]
    if A.ndim < 2 or A.shape[-2] != size or size > _MOST:
        raise NotRecorded(f"a system of more than {_MOST} linear equations")
    rows = [[A[..., i, j] for j in range(size)] + right[i] for i in range(size)]
    sign = lift(graph, 1.0)
    for j in range(size):
        for i in range(j + 1, size):
            greater = absolute(rows[i][j]) > absolute(rows[j][j])
            graph.pivots.update(greater.parts)
            sign = choice(graph, greater, -sign, sign)
            pairs = list(zip(rows[j], rows[i], strict=True))
            rows[j], rows[i] = (
                [choice(graph, greater, q, p) for p, q in pairs], [choice(graph, greater, p, q) for p, q in pairs]
            )  # fmt: skip
        for i in range(j + 1, size):
            part = rows[i][j] / rows[j][j]
            rows[i] = [p - part * q if k > j else p for k, (p, q) in enumerate(zip(rows[i], rows[j], strict=True))]
    return rows, sign


def solution(graph: Graph, A: Any, b: Any) -> Any:
    b = lift(graph, b)
    size, vector = np.shape(A)[-1], b.ndim == 1
    columns = [b] if vector else [b[..., k] for k in range(b.shape[-1])]
    rows, _ = _eliminated(graph, A, [[column[..., i] for column in columns] for i in range(size)])
    solved: list[list[Any]] = []
    for k in range(len(columns)):
        x: list[Any] = [None] * size
        for i in reversed(range(size)):
            rest = rows[i][size + k]
            for j in range(i + 1, size):
                rest = rest - rows[i][j] * x[j]
            x[i] = rest / rows[i][i]
        solved.append(x)
    if vector:
        return moved(lift(graph, solved[0]), 0, -1)
    return moved(lift(graph, [lift(graph, list(row)) for row in zip(*solved, strict=True)]), (0, 1), (-2, -1))


def determinant(graph: Graph, A: Any) -> Any:
    rows, sign = _eliminated(graph, A, [[] for _ in range(np.shape(A)[-1])])
    for i, row in enumerate(rows):
        sign = sign * row[i]
    return lift(graph, sign)
