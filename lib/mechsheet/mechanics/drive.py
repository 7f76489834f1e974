"""Balance of the driving link: a crank by coupling or gear, a hydraulic cylinder. Notation as in `group`."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from mechsheet.mechanics.arguments import Complex, Float, elementwise, field, not_negative, refusal
from mechsheet.mechanics.load import Load, lever, resultant
from mechsheet.mechanics.planar import cross, dot


class CouplingDrive(NamedTuple):
    """Balance of a crank that a coupling turns."""

    M: Float  # [N m] balancing moment on the crank, from the coupling
    R_O1: Complex  # [N] on the crank at O1, from the frame


class GearDrive(NamedTuple):
    """Balance of a crank that a gear turns."""

    F: Complex  # [N] balancing force on the crank's wheel at the pitch point, from the driving wheel
    R_O1: Complex  # [N] on the crank at O1, from the frame


class CylinderDrive(NamedTuple):
    """Balance of the rod of a hydraulic cylinder."""

    F: Float  # [N] balancing force of the fluid on the rod, positive where it lengthens the cylinder
    R: Complex  # [N] on the rod, from the barrel, square to the axis
    M: Float  # [N m] on the rod, from the barrel, about C
    h: Float  # [m] distance of R from C along the axis from A to C; NaN where R is zero


@elementwise
def coupling_drive(O1: ArrayLike, loads: Sequence[Load] = ()) -> CouplingDrive:
    r"""Balancing moment of a crank turned by a coupling (program SRWL2); (1.54) to (1.58).

    .. math:: M = -\sum T_{O_1}, \quad R_O1 = -\sum F

    Parameters
    ----------
    O1 : complex, shape (...)
        Crank's hinge on the frame [m].
    loads : sequence of Load
        All loads on the crank, the reactions of the groups that it moves among them.

    Returns
    -------
    CouplingDrive
        M [N m], R_O1 [N].

    Raises
    ------
    ValueError
        An infinite hinge, loads that are not a sequence of Load.

    Examples
    --------
    >>> coupling_drive(0, [Load(-10j, 2)]).M
    np.float64(20.0)
    """
    F, T = resultant(loads, field(O1, "O1"), "loads")
    return CouplingDrive(-T, -F)


@elementwise
def gear_drive(O1: ArrayLike, P: ArrayLike, alpha_w: ArrayLike, loads: Sequence[Load] = ()) -> GearDrive:
    r"""Balancing force of a crank turned by an external spur gear (program SRWL1); (1.47) to (1.52).

    The teeth push: whichever flank works, the force points inwards by the pressure angle from the tangent.

    .. math:: F = \left(F_t + i |F_t| \tan\alpha_w\right) i q/|q|, \quad F_t = -\sum T_{O_1} / |q|, \quad q = P - O_1

    Parameters
    ----------
    O1, P : complex, shape (...)
        Crank's hinge on the frame, and pitch point of the gear [m].
    alpha_w : float, shape (...)
        Pressure angle [rad], in [0, pi/2).
    loads : sequence of Load
        All loads on the crank, the reactions of the groups that it moves among them.

    Returns
    -------
    GearDrive
        F, R_O1 [N]; NaN where P = O1.

    Raises
    ------
    ValueError
        A pressure angle outside its range, an infinite point, loads that are not a sequence of Load.

    Examples
    --------
    >>> gear_drive(0, -1, 0, [Load(10j, 2)]).F.imag
    np.float64(20.0)
    """
    O1 = field(O1, "O1")
    alpha_w = not_negative(alpha_w, "pressure angle alpha_w", "rad")
    if np.count_nonzero(upright := alpha_w >= np.pi / 2):
        raise refusal(alpha_w[upright], "pressure angle alpha_w", "rad", "must be less than pi/2")
    F, T = resultant(loads, O1, "loads")
    q = field(P, "P") - O1
    F_t = -T / np.abs(q)
    F_w = (F_t + 1j * np.abs(F_t) * np.tan(alpha_w)) * 1j * (q / np.abs(q))
    return GearDrive(F_w, -(F + F_w))


@elementwise
def cylinder_drive(A: ArrayLike, C: ArrayLike, R_C: ArrayLike, loads: Sequence[Load] = ()) -> CylinderDrive:
    r"""Balancing force of a hydraulic cylinder whose barrel is pinned at A and whose rod is pinned at C.

    .. math:: F = -(R_C + F_2) \cdot u, \quad R = -i u \, (u \times (R_C + F_2)), \quad M = -T_2, \quad
              u = (C - A)/|C - A|

    The cylinder is a link of given length in an RRR group, whose reactions take all loads on barrel and rod.

    Parameters
    ----------
    A, C : complex, shape (...)
        Pins of barrel and rod [m].
    R_C : complex, shape (...)
        Force on the rod at C [N]: ``R_C`` of `rrr_reactions` where the cylinder is the link next to A.
    loads : sequence of Load
        Loads on the rod alone, with sum F_2 and moment T_2 about C.

    Returns
    -------
    CylinderDrive
        F, R [N], M [N m], h [m]; NaN where A = C, but for M.

    Raises
    ------
    ValueError
        An infinite argument, loads that are not a sequence of Load.

    Examples
    --------
    >>> cylinder_drive(0, 3 + 4j, -6 - 8j).F
    np.float64(10.0)
    """
    C = field(C, "C")
    F, T = resultant(loads, C, "loads")
    F = F + field(R_C, "R_C")
    u = C - field(A, "A")
    u = u / np.abs(u)
    N = -cross(u, F)
    return CylinderDrive(-dot(u, F), 1j * N * u, -T, lever(-T, N))
