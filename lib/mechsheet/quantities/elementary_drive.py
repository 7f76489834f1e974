"""Drives in elementary steps."""

from collections.abc import Sequence

import numpy as np

from mechsheet.mechanics.drive import CouplingDrive, CylinderDrive, GearDrive
from mechsheet.mechanics.load import Load
from mechsheet.quantities.elementary_group import lever, loaded_end
from mechsheet.quantities.elementary_planar import Quantity, cross, dot, step, unit


def coupling_drive(O1: Quantity, loads: Sequence[Load] = ()) -> CouplingDrive:
    F, T = loaded_end(loads, O1, "")
    return CouplingDrive(-T, -F)


def gear_drive(O1: Quantity, P: Quantity, alpha_w: Quantity, loads: Sequence[Load] = ()) -> GearDrive:
    F, T = loaded_end(loads, O1, "")
    q = P - O1
    F_t = step("Ft", "N", "force along the pitch circle", -T / np.abs(q))
    F_w = (F_t + 1j * np.abs(F_t) * np.tan(alpha_w)) * 1j * (q / np.abs(q))
    return GearDrive(F_w, -(F + F_w))


def cylinder_drive(A: Quantity, C: Quantity, R_C: Quantity, loads: Sequence[Load] = ()) -> CylinderDrive:
    F, T = loaded_end(loads, C, "")
    F, u = F + R_C, unit(C - A)
    N = -cross(u, F)
    return CylinderDrive(-dot(u, F), 1j * N * u, -T, lever(-T, N))
