r"""Reactions in the pairs of Assur groups of class II and of driving links.

Groups are taken from the last to the first: the reactions of one are loads of those before it, with the opposite
sign. Friction is left out. Names as in `dyads`: the link next to A and the link next to B meet in C.

======================  ============================================================================================
``R_A``                 force on the link next to A, from the body that carries A (the source's R_12)
``R_B``                 force on the link next to B, from the body that carries B (R_43)
``R_C``                 force on the link next to A, from the link next to B (R_32); the opposite acts on the other
``M_X``                 moment of the reaction of the prismatic pair X, acting on the same link as R_X
``h_X``                 distance along the slide at which the single force R_X does the same (h_32)
======================  ============================================================================================

The direction of any reaction is `angle`. Reactions are NaN at a dead centre.

Source: I. G. Shebanov, Dynamic synthesis and analysis of aircraft mechanisms: force analysis (in Ukrainian),
Kharkiv, KhAI, 2003, sections 1.1 to 1.4; derived anew.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import reduce
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from mechsheet.mechanics.arguments import (
    Complex,
    Float,
    determinant,
    direction,
    elementwise,
    field,
    not_negative,
    scalar_field,
)
from mechsheet.mechanics.dyads import rrr_determinant
from mechsheet.mechanics.planar import cross, dot, product


@dataclass(frozen=True)
class Load:
    """A force applied to a link at a point, and a couple; shapes (...) broadcast.

    A reaction known from a later group acts back with the opposite sign: ``Load(-R.R_A, A)``.
    """

    F: ArrayLike  # [N] force
    P: ArrayLike  # [m] point of application
    M: ArrayLike = 0.0  # [N m] couple, counter-clockwise


class RRRReactions(NamedTuple):
    """Reactions of a dyad of two links with the pins A, C, B."""

    R_A: Complex  # [N] on the link AC at A, from the body that carries A
    R_B: Complex  # [N] on the link BC at B, from the body that carries B
    R_C: Complex  # [N] on the link AC at C, from the link BC


class RRPReactions(NamedTuple):
    """Reactions of a link AC with a slider on a guide."""

    R_A: Complex  # [N] on the link AC at A, from the body that carries A
    R_B: Complex  # [N] on the slider, from the guide
    R_C: Complex  # [N] on the link AC at C, from the slider
    M_B: Float  # [N m] on the slider, from the guide, about C
    h_B: Float  # [m] distance of R_B from C along u; NaN where R_B is zero


class RPRReactions(NamedTuple):
    """Reactions of a block or rod pinned at A in a slotted link or cylinder pinned at B."""

    R_A: Complex  # [N] on the block at A, from the body that carries A
    R_B: Complex  # [N] on the slotted link at B, from the body that carries B
    R_C: Complex  # [N] on the block, from the slotted link
    M_C: Float  # [N m] on the block, from the slotted link, about A
    h_C: Float  # [m] distance of R_C from A along u; NaN where R_C is zero


class PRPReactions(NamedTuple):
    """Reactions of two sliders joined by the pin C."""

    R_A: Complex  # [N] on the slider A, from its guide
    R_B: Complex  # [N] on the slider B, from its guide
    R_C: Complex  # [N] on the slider A at C, from the slider B
    M_A: Float  # [N m] on the slider A, from its guide, about C
    M_B: Float  # [N m] on the slider B, from its guide, about C
    h_A: Float  # [m] distance of R_A from C along u_A; NaN where R_A is zero
    h_B: Float  # [m] distance of R_B from C along u_B; NaN where R_B is zero


class RPPReactions(NamedTuple):
    """Reactions of a link pinned at A in the slot of a slider on a guide."""

    R_A: Complex  # [N] on the link at A, from the body that carries A
    R_B: Complex  # [N] on the slider, from the guide
    R_C: Complex  # [N] on the link, from the slider
    M_B: Float  # [N m] on the slider, from the guide, about C
    M_C: Float  # [N m] on the link, from the slider, about A
    h_B: Float  # [m] distance of R_B from C along u_B; NaN where R_B is zero
    h_C: Float  # [m] distance of R_C from A along u_A; NaN where R_C is zero


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


def inertia(m: ArrayLike, J: ArrayLike, S: ArrayLike, a_S: ArrayLike, epsilon: ArrayLike) -> Load:
    r"""Inertia force and moment of a link (1.1), (1.2).

    .. math:: F = -m a_S, \quad M = -J \varepsilon

    Parameters
    ----------
    m, J : float, shape (...)
        Mass [kg] and moment of inertia about the centre of mass [kg m^2].
    S, a_S : complex, shape (...)
        Centre of mass [m] and its acceleration [m/s^2].
    epsilon : float, shape (...)
        Angular acceleration of the link [rad/s^2].

    Returns
    -------
    Load
        Force [N] at S and couple [N m].

    Raises
    ------
    ValueError
        A negative, NaN or infinite mass or moment of inertia, an infinite acceleration.

    Examples
    --------
    >>> inertia(2, 0.5, 1j, 3j, 4).M
    np.float64(-2.0)
    """
    m, J = not_negative(m, "mass m", "kg"), not_negative(J, "moment of inertia J", "kg m^2")
    return Load(-m * field(a_S, "a_S"), S, -J * scalar_field(epsilon, "epsilon"))


@elementwise
def rrr_reactions(
    A: ArrayLike, B: ArrayLike, C: ArrayLike, loads_A: Sequence[Load] = (), loads_B: Sequence[Load] = ()
) -> RRRReactions:
    r"""Reactions of the dyad A-C-B, kind 1 (program SR1).

    .. math:: R_C = -\frac{T_B \, a + T_A \, b}{a \times b}, \quad R_A = -(R_C + F_A), \quad R_B = R_C - F_B, \quad
              a = C - A, \; b = C - B

    with T_A and T_B the moments of the loads on AC about A and of those on BC about B; the determinant is that of
    (1.10). So loads near the outer pins leave small forces in C with all their digits.

    Parameters
    ----------
    A, B, C : complex, shape (...)
        Pins [m].
    loads_A, loads_B : sequence of Load
        Loads on the link AC and on the link BC.

    Returns
    -------
    RRRReactions
        R_A, R_B, R_C [N].

    Raises
    ------
    ValueError
        An infinite argument, loads that are not a sequence of Load.

    Examples
    --------
    A two-bar bracket with 10 N hanging from its tip; the strut AC is pressed, the tie BC pulled:

    >>> R = rrr_reactions(0, 3j, 4, loads_A=[Load(-10j, 4)])
    >>> R.R_A.real, R.R_B
    (np.float64(13.333333333333334), np.complex128(-13.333333333333334+10j))
    """
    A, B, C = field(A, "A"), field(B, "B"), field(C, "C")
    F_A, T_A = _resultant(loads_A, A, "loads_A")
    F_B, T_B = _resultant(loads_B, B, "loads_B")
    D = rrr_determinant(A, B, C)
    R_C = -(product(T_B / D, 0.0, C - A) + product(T_A / D, 0.0, C - B))
    return RRRReactions(-(R_C + F_A), R_C - F_B, R_C)


@elementwise
def rrp_reactions(
    A: ArrayLike, C: ArrayLike, u: ArrayLike, loads_A: Sequence[Load] = (), loads_B: Sequence[Load] = ()
) -> RRPReactions:
    r"""Reactions of a link AC with a slider on a guide, kind 2 (program SR2).

    .. math:: R_B = i N u, \quad N = -\frac{T_A + a \times F_B}{a \cdot u}, \quad R_C = R_B + F_B, \quad
              R_A = -(R_C + F_A), \quad M_B = -T_B, \quad a = C - A

    with T_A the moment of the loads on AC about A and T_B of those on the slider about C; (1.26) after elimination.

    Parameters
    ----------
    A, C : complex, shape (...)
        Outer pin and slider's pin [m].
    u : complex, shape (...)
        Direction of the guide, of any length but zero.
    loads_A, loads_B : sequence of Load
        Loads on the link AC and on the slider.

    Returns
    -------
    RRPReactions
        R_A, R_B, R_C [N], M_B [N m], h_B [m].

    Raises
    ------
    ValueError
        An infinite argument, a zero direction, loads that are not a sequence of Load.

    Examples
    --------
    >>> rrp_reactions(3j, 4, 1, loads_B=[Load(8, 4)]).R_B.imag
    np.float64(-6.0)
    """
    A, C, u = field(A, "A"), field(C, "C"), direction(u, "u")
    F_A, T_A = _resultant(loads_A, A, "loads_A")
    F_B, T_B = _resultant(loads_B, C, "loads_B")
    a = C - A
    N = -(T_A + cross(a, F_B)) / determinant(dot(a, u))
    R_B = 1j * N * u
    R_C = R_B + F_B
    return RRPReactions(-(R_C + F_A), R_B, R_C, -T_B, _arm(-T_B, N))


@elementwise
def rpr_reactions(
    A: ArrayLike, B: ArrayLike, u: ArrayLike, loads_A: Sequence[Load] = (), loads_B: Sequence[Load] = ()
) -> RPRReactions:
    r"""Reactions of a block or rod in a slotted link or cylinder, kind 3 (program SR3).

    .. math:: R_C = i N u, \quad N = \frac{T_A + T_B}{(A - B) \cdot u}, \quad R_A = -(R_C + F_A), \quad
              R_B = R_C - F_B, \quad M_C = -T_A

    with T_A the moment of the loads on the block about A and T_B of those on the slotted link about B; (1.35),
    (1.37) and (1.46) after elimination.

    Parameters
    ----------
    A, B : complex, shape (...)
        Pins of the block and of the slotted link [m].
    u : complex, shape (...)
        Direction of the slide, of any length but zero.
    loads_A, loads_B : sequence of Load
        Loads on the block or rod, and on the slotted link or cylinder.

    Returns
    -------
    RPRReactions
        R_A, R_B, R_C [N], M_C [N m], h_C [m].

    Raises
    ------
    ValueError
        An infinite argument, a zero direction, loads that are not a sequence of Load.

    Examples
    --------
    >>> rpr_reactions(2, 0, 1, loads_B=[Load(-3j, 4)]).R_A.imag
    np.float64(6.0)
    """
    A, B, u = field(A, "A"), field(B, "B"), direction(u, "u")
    F_A, T_A = _resultant(loads_A, A, "loads_A")
    F_B, T_B = _resultant(loads_B, B, "loads_B")
    N = (T_A + T_B) / determinant(dot(A - B, u))
    R_C = 1j * N * u
    return RPRReactions(-(R_C + F_A), R_C - F_B, R_C, -T_A, _arm(-T_A, N))


@elementwise
def prp_reactions(
    C: ArrayLike,
    u_A: ArrayLike,
    u_B: ArrayLike,
    loads_A: Sequence[Load] = (),
    loads_B: Sequence[Load] = (),
) -> PRPReactions:
    r"""Reactions of two sliders joined by the pin C, kind 4.

    .. math:: R_A = i N_A u_A, \quad R_B = i N_B u_B, \quad R_A + R_B = -F, \quad R_C = -(R_A + F_A)

    Parameters
    ----------
    C : complex, shape (...)
        Pin [m].
    u_A, u_B : complex, shape (...)
        Directions of the guides, of any length but zero.
    loads_A, loads_B : sequence of Load
        Loads on the slider A and on the slider B.

    Returns
    -------
    PRPReactions
        R_A, R_B, R_C [N], M_A, M_B [N m], h_A, h_B [m].

    Raises
    ------
    ValueError
        An infinite argument, a zero direction, loads that are not a sequence of Load.

    Examples
    --------
    >>> prp_reactions(0, 1, 1j, loads_A=[Load(3 - 2j, 0)]).R_B.real
    np.float64(-3.0)
    """
    C, u_A, u_B = field(C, "C"), direction(u_A, "u_A"), direction(u_B, "u_B")
    F_A, T_A = _resultant(loads_A, C, "loads_A")
    F_B, T_B = _resultant(loads_B, C, "loads_B")
    N_A, N_B = _normal_forces(u_A, u_B, F_A + F_B)
    R_A = 1j * N_A * u_A
    return PRPReactions(R_A, 1j * N_B * u_B, -(R_A + F_A), -T_A, -T_B, _arm(-T_A, N_A), _arm(-T_B, N_B))


@elementwise
def rpp_reactions(
    A: ArrayLike,
    C: ArrayLike,
    u_A: ArrayLike,
    u_B: ArrayLike,
    loads_A: Sequence[Load] = (),
    loads_B: Sequence[Load] = (),
) -> RPPReactions:
    r"""Reactions of a link pinned at A in the slot of a slider on a guide, kind 5.

    .. math:: R_C = i N_C u_A, \quad R_B = i N_B u_B, \quad R_B - R_C = -F_B, \quad R_A = -(R_C + F_A)

    Parameters
    ----------
    A, C : complex, shape (...)
        Outer pin and slider's point from `rpp` [m].
    u_A, u_B : complex, shape (...)
        Directions of the slot and of the guide, of any length but zero.
    loads_A, loads_B : sequence of Load
        Loads on the link and on the slider.

    Returns
    -------
    RPPReactions
        R_A, R_B, R_C [N], M_B, M_C [N m], h_B, h_C [m].

    Raises
    ------
    ValueError
        An infinite argument, a zero direction, loads that are not a sequence of Load.

    Examples
    --------
    Scotch yoke pushed back by 5 N:

    >>> rpp_reactions(0.3 + 0.4j, 0.3, 1j, 1, loads_B=[Load(-5, 0.3)]).R_A.real
    np.float64(5.0)
    """
    A, C, u_A, u_B = field(A, "A"), field(C, "C"), direction(u_A, "u_A"), direction(u_B, "u_B")
    F_A, T_A = _resultant(loads_A, A, "loads_A")
    F_B, T_B = _resultant(loads_B, C, "loads_B")
    N, N_B = _normal_forces(u_A, u_B, F_B)
    R_C = -1j * N * u_A
    M_B = -(T_A + cross(A - C, -R_C) + T_B)
    R_A = -(R_C + F_A)
    return RPPReactions(R_A, 1j * N_B * u_B, R_C, M_B, -T_A, _arm(M_B, N_B), _arm(-T_A, -N))


@elementwise
def coupling_drive(O1: ArrayLike, loads: Sequence[Load]) -> CouplingDrive:
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
    F, T = _resultant(loads, field(O1, "O1"), "loads")
    return CouplingDrive(-T, -F)


@elementwise
def gear_drive(O1: ArrayLike, P: ArrayLike, alpha_w: ArrayLike, loads: Sequence[Load]) -> GearDrive:
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
        F, R_O1 [N].

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
    if not alpha_w.max(initial=0) < np.pi / 2:
        raise ValueError(f"pressure angle alpha_w = {alpha_w.max():.6g} rad must be less than pi/2")
    F, T = _resultant(loads, O1, "loads")
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
        F, R [N], M [N m], h [m].

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
    F, T = _resultant(loads, C, "loads")
    F = F + field(R_C, "R_C")
    u = C - field(A, "A")
    u = u / np.abs(u)
    N = -cross(u, F)
    return CylinderDrive(-dot(u, F), 1j * N * u, -T, _arm(-T, N))


def _resultant(loads: Sequence[Load], pole: Complex, name: str) -> tuple[Complex, Float]:
    """Sum of the forces of the loads, and of their moments about the pole."""
    if not (isinstance(loads, Sequence) and all(isinstance(load, Load) for load in loads)):
        raise ValueError(f"{name} = {loads!r} must be a sequence of Load")
    F, T = [], []
    for i, load in enumerate(loads):
        force = field(load.F, f"{name}[{i}].F")
        arm = field(load.P, f"{name}[{i}].P") - pole
        F.append(force)
        T.append(cross(arm, force) + scalar_field(load.M, f"{name}[{i}].M"))
    if not loads:
        return np.zeros((), np.complex128), np.zeros(())
    return reduce(np.add, F), reduce(np.add, T)


def _normal_forces(u_A: Complex, u_B: Complex, F: Complex) -> tuple[Float, Float]:
    """p, q of i p u_A + i q u_B = -F, for unit vectors; q from the projection, to leave no residual."""
    p = -dot(F, u_B) / determinant(cross(u_A, u_B))
    return p, -cross(u_B, F + 1j * p * u_A)


def _arm(M: Float, N: Float) -> Float:
    """Distance along the slide at which the normal force N has the moment M."""
    return M / determinant(N)
