"""What several groups and drives have in common, in elementary steps."""

from collections.abc import Sequence
from functools import reduce
from typing import Any

import numpy as np

from mechsheet.mechanics.group import ROUNDINGS
from mechsheet.mechanics.load import Load
from mechsheet.quantities.elementary_planar import Quantity, cross, step


def none(x: Quantity) -> bool:
    """Whether there is nothing of it, as where an argument is left out."""
    return isinstance(x, int | float) and x == 0


def moved(v: Quantity, a: Quantity, dr: Quantity) -> Quantity:
    return v if none(dr) else v + a * (dr / np.abs(a))


def carried(a: Quantity, omega: Quantity, dr: Quantity, ddr: Quantity) -> Quantity:
    rigid = -(omega**2) * a
    return rigid if none(dr) and none(ddr) else rigid + a * ((ddr + 2j * omega * dr) / np.abs(a))


def determinant(D: Quantity, size: Quantity, unit: str) -> Quantity:
    """Determinant of a group; none at a dead centre, where it is no more than rounding of what it is made of."""
    return step("D", unit, "determinant of the group", np.where(np.abs(D) > ROUNDINGS * size, D, np.nan))


def of_guides(u_A: Quantity, u_B: Quantity) -> Quantity:
    """Determinant of two unit vectors."""
    return determinant(cross(u_A, u_B), 2.0, "-")


def along(a: Quantity, b: Quantity, w: Quantity) -> tuple[Quantity, Quantity]:
    D = of_guides(a, b)
    return cross(w, b) / D, cross(a, w) / D


def loaded_end(loads: Sequence[Any], pole: Quantity, end: str) -> tuple[Quantity, Quantity]:
    if not loads:
        return np.complex128(0), np.float64(0)
    forces, arms = [load.F for load in loads], [load.P - pole for load in loads]
    moments = [cross(arm, load.F) + load.M for arm, load in zip(arms, loads, strict=True)]
    force = step(f"F{end}", "N", "sum of the loads", reduce(lambda p, q: p + q, forces))
    return force, step(f"T{end}", "N*m", "moment of the loads about the pin", reduce(lambda p, q: p + q, moments))


def lever(M: Quantity, N: Quantity) -> Quantity:
    return M / np.where(N == 0, np.nan, N)


def inertia(S: Quantity, m: Quantity, J: Quantity, a_S: Quantity = 0, epsilon: Quantity = 0) -> Load:
    return Load(-m * a_S, S, -J * epsilon)
