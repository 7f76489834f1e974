"""Loads on links: forces and couples applied, inertia, their sums."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import reduce

import numpy as np
from numpy.typing import ArrayLike

from mechsheet.mechanics.arguments import Complex, Float, broadcasting, field, not_negative, scalar_field
from mechsheet.mechanics.planar import cross


@dataclass(frozen=True, eq=False)
class Load:
    """A force applied to a link at a point, and a couple; shapes (...) broadcast.

    A reaction known from a later group acts back with the opposite sign: ``Load(-R.R_A, A)``.
    """

    F: ArrayLike  # [N] force
    P: ArrayLike  # [m] point of application
    M: ArrayLike = 0.0  # [N m] couple, counter-clockwise


@broadcasting
def inertia(S: ArrayLike, m: ArrayLike, J: ArrayLike, a_S: ArrayLike = 0.0, epsilon: ArrayLike = 0.0) -> Load:
    r"""Inertia force and moment of a link (1.1), (1.2).

    .. math:: F = -m a_S, \quad M = -J \varepsilon

    Parameters
    ----------
    S : complex, shape (...)
        Centre of mass [m].
    m, J : float, shape (...)
        Mass [kg] and moment of inertia about the centre of mass [kg m^2].
    a_S : complex, shape (...)
        Acceleration of the centre of mass [m/s^2].
    epsilon : float, shape (...)
        Angular acceleration of the link [rad/s^2].

    Returns
    -------
    Load
        Force [N] at S and couple [N m].

    Raises
    ------
    ValueError
        A negative, NaN or infinite mass or moment of inertia, an infinite point or acceleration, shapes that do not
        broadcast.

    Examples
    --------
    >>> inertia(1j, 2, 0.5, a_S=3j, epsilon=4).M
    np.float64(-2.0)
    """
    S, m, J = field(S, "S"), not_negative(m, "mass m", "kg"), not_negative(J, "moment of inertia J", "kg m^2")
    F, M = -m * field(a_S, "a_S"), -J * scalar_field(epsilon, "epsilon")
    shapes = {x.shape for x in (S, F, M) if x.ndim}
    if len(shapes) > 1:
        np.broadcast_shapes(*shapes)
    return Load(F, S[()], M)


def resultant(loads: Sequence[Load], pole: Complex, name: str) -> tuple[Complex, Float]:
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


def lever(M: Float, N: Float) -> Float:
    """Distance along the slide at which the normal force N has the moment M; NaN without a force."""
    return M / np.where(N == 0, np.nan, N)
