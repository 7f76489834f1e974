"""The reactions of a mechanism by numpy: one system of all bodies at every position."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from mechsheet.accuracy.arithmetic import cross, dot


def dense(bodies: int, pairs: Sequence[tuple[Any, ...]], loads: Sequence[tuple[Any, ...]], whole: bool = False) -> Any:
    """Force components of every pin, normal force and couple of every slide, shape (2 pairs, ...).

    Pins are (P, on, by), slides (P, u, on, by): on a body, counted from 1, by another one, 0 for the frame; loads are
    (body, force, point, couple). With the equilibrium of the ``whole`` beside that of the bodies by least squares.
    """
    shape, n = np.broadcast(*(pair[0] for pair in pairs)).shape, 2 * len(pairs)
    matrix, right = np.zeros((*shape, 3 * bodies, n)), np.zeros((*shape, 3 * bodies))
    for k, (P, *u, on, by) in zip(range(0, n, 2), pairs, strict=True):
        for row, sense in ((3 * body - 3, sense) for body, sense in ((on, 1), (by, -1)) if body):
            if u:
                matrix[..., row, k], matrix[..., row + 1, k] = -sense * u[0].imag, sense * u[0].real
                matrix[..., row + 2, k], matrix[..., row + 2, k + 1] = sense * dot(P, u[0]), sense
            else:
                matrix[..., row, k] = matrix[..., row + 1, k + 1] = sense
                matrix[..., row + 2, k], matrix[..., row + 2, k + 1] = -sense * P.imag, sense * P.real
    for body, F, P, M in loads:
        row = 3 * body - 3
        right[..., row], right[..., row + 1], right[..., row + 2] = -F.real, -F.imag, -cross(P, F) - M
    if not whole:
        return np.moveaxis(np.linalg.solve(matrix, right[..., None])[..., 0], -1, 0)
    matrix = np.concatenate([matrix, matrix.reshape(*shape, bodies, 3, n).sum(-3)], axis=-2)
    right = np.concatenate([right, right.reshape(*shape, bodies, 3).sum(-2)], axis=-1)
    Q, R = np.linalg.qr(matrix)  # of all positions at once, as lstsq cannot
    return np.moveaxis(np.linalg.solve(R, Q.mT @ right[..., None])[..., 0], -1, 0)
