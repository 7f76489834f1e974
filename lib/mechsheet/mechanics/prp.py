"""PRP, kind 4: two sliders with a common pin, on guides that may move. Notation as in `group`."""

from collections.abc import Sequence
from dataclasses import dataclass
from dataclasses import field as attribute
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from mechsheet.mechanics.arguments import Complex, Float, elementwise, field, scalar_field, unit
from mechsheet.mechanics.group import Reach, condition, crossing, determinant, endless, solve
from mechsheet.mechanics.load import Load, lever, resultant
from mechsheet.mechanics.planar import angle_between, cross


class PRPVelocity(NamedTuple):
    """First derivatives of a PRP group."""

    v_C: Complex  # [m/s] velocity of the pin C
    ds_A: Float  # [m/s] sliding speed along u_A
    ds_B: Float  # [m/s] sliding speed along u_B


class PRPAcceleration(NamedTuple):
    """Second derivatives of a PRP group."""

    a_C: Complex  # [m/s^2] acceleration of the pin C
    dds_A: Float  # [m/s^2] second derivative of the sliding distance along u_A
    dds_B: Float  # [m/s^2] second derivative of the sliding distance along u_B


class PRPMotion(NamedTuple):
    """First derivatives of a `PRPGroup`, found and given."""

    v_C: Complex  # [m/s] velocity of the pin C
    ds_A: Float  # [m/s] sliding speed along u_A
    ds_B: Float  # [m/s] sliding speed along u_B
    omega_A: ArrayLike  # [rad/s] angular velocity of the guide A, as given
    omega_B: ArrayLike  # [rad/s] angular velocity of the guide B, as given


class PRPReactions(NamedTuple):
    """Reactions of two sliders joined by the pin C."""

    R_A: Complex  # [N] on the slider A, from its guide
    R_B: Complex  # [N] on the slider B, from its guide
    R_C: Complex  # [N] on the slider A at C, from the slider B
    M_A: Float  # [N m] on the slider A, from its guide, about C
    M_B: Float  # [N m] on the slider B, from its guide, about C
    h_A: Float  # [m] distance of R_A from C along u_A; NaN where R_A is zero
    h_B: Float  # [m] distance of R_B from C along u_B; NaN where R_B is zero


@elementwise
def prp(A: ArrayLike, B: ArrayLike, u_A: ArrayLike, u_B: ArrayLike) -> Complex:
    r"""Pin C of two sliders on guides through A and B (kind 4).

    .. math:: C = A + u_A \, \frac{(B - A) \times u_B}{u_A \times u_B}

    Parameters
    ----------
    A, B : complex, shape (...)
        A point of each guide [m].
    u_A, u_B : complex, shape (...)
        Directions of the guides, of any length but zero.

    Returns
    -------
    complex, shape (...)
        C [m]; NaN where the guides are parallel.

    Raises
    ------
    ValueError
        An infinite argument, a zero direction.

    Examples
    --------
    >>> prp(0, 1 + 2j, 1, 1 + 1j)
    np.complex128(-1+0j)
    """
    u_A, u_B, D = _guides(u_A, u_B)
    return crossing(field(A, "A"), field(B, "B"), u_A, u_B, D)


@elementwise
def prp_reach(A: ArrayLike, B: ArrayLike, u_A: ArrayLike, u_B: ArrayLike) -> Reach:
    """Interval of the offset of a guide, square to itself, for which the sliders have a common pin: without ends.

    Parameters
    ----------
    A, B, u_A, u_B
        As in `prp`.

    Returns
    -------
    Reach
        Minus infinity and infinity, shape (...); NaN where the guides are parallel, for they have no pin then.

    Raises
    ------
    ValueError
        As in `prp`.

    Examples
    --------
    >>> prp_reach(0, 1 + 2j, 1, [1 + 1j, 2])
    Reach(least=array([-inf,  nan]), greatest=array([inf, nan]))
    """
    return endless(prp(A, B, u_A, u_B))


@elementwise
def prp_velocity(
    A: ArrayLike,
    B: ArrayLike,
    C: ArrayLike,
    u_A: ArrayLike,
    u_B: ArrayLike,
    v_A: ArrayLike = 0.0,
    v_B: ArrayLike = 0.0,
    omega_A: ArrayLike = 0.0,
    omega_B: ArrayLike = 0.0,
) -> PRPVelocity:
    r"""Velocities of two sliders with the common pin C on guides that may move.

    .. math:: v_C = v_A + i \omega_A (C - A) + \dot s_A u_A = v_B + i \omega_B (C - B) + \dot s_B u_B

    Parameters
    ----------
    A, B, C : complex, shape (...)
        A point of each guide, and the pin [m].
    u_A, u_B : complex, shape (...)
        Directions of the guides, of any length but zero.
    v_A, v_B : complex, shape (...)
        Velocities of the guides' points A and B [m/s], or their analogues.
    omega_A, omega_B : float, shape (...)
        Angular velocities of the guides, which are the sliders' [rad/s].

    Returns
    -------
    PRPVelocity
        v_C, ds_A, ds_B [m/s]; NaN where the guides are parallel.

    Raises
    ------
    ValueError
        An infinite argument, a zero direction.

    Examples
    --------
    >>> prp_velocity(0, 1, 1, 1, 1j, v_B=2).ds_A
    np.float64(2.0)
    """
    C = field(C, "C")
    u_A, u_B, D = _guides(u_A, u_B)
    guide_A = field(v_A, "v_A") + 1j * scalar_field(omega_A, "omega_A") * (C - field(A, "A"))
    guide_B = field(v_B, "v_B") + 1j * scalar_field(omega_B, "omega_B") * (C - field(B, "B"))
    ds_A, minus_ds_B = solve(u_A, u_B, guide_B - guide_A, D)
    return PRPVelocity(guide_A + ds_A * u_A, ds_A, -minus_ds_B)


@elementwise
def prp_acceleration(
    A: ArrayLike,
    B: ArrayLike,
    C: ArrayLike,
    u_A: ArrayLike,
    u_B: ArrayLike,
    ds_A: ArrayLike,
    ds_B: ArrayLike,
    omega_A: ArrayLike = 0.0,
    omega_B: ArrayLike = 0.0,
    a_A: ArrayLike = 0.0,
    a_B: ArrayLike = 0.0,
    epsilon_A: ArrayLike = 0.0,
    epsilon_B: ArrayLike = 0.0,
) -> PRPAcceleration:
    r"""Accelerations of two sliders with the common pin C on guides that may move.

    .. math:: a_C = a_A + (i \varepsilon_A - \omega_A^2)(C - A) + (\ddot s_A + 2 i \omega_A \dot s_A) u_A
              = a_B + (i \varepsilon_B - \omega_B^2)(C - B) + (\ddot s_B + 2 i \omega_B \dot s_B) u_B

    Parameters
    ----------
    A, B, C, u_A, u_B
        As in `prp_velocity`.
    ds_A, ds_B : float, shape (...)
        Sliding speeds [m/s] from `prp_velocity`.
    omega_A, omega_B : float, shape (...)
        Angular velocities of the guides [rad/s], as given to `prp_velocity`.
    a_A, a_B : complex, shape (...)
        Accelerations of the guides' points A and B [m/s^2], or their analogues.
    epsilon_A, epsilon_B : float, shape (...)
        Angular accelerations of the guides [rad/s^2].

    Returns
    -------
    PRPAcceleration
        a_C, dds_A, dds_B [m/s^2]; NaN where the guides are parallel.

    Raises
    ------
    ValueError
        An infinite argument, a zero direction.

    Examples
    --------
    >>> prp_acceleration(0, 1, 1, 1, 1j, 2, 0, a_B=3).dds_A
    np.float64(3.0)
    """
    C = field(C, "C")
    u_A, u_B, D = _guides(u_A, u_B)
    omega_A, omega_B = scalar_field(omega_A, "omega_A"), scalar_field(omega_B, "omega_B")
    turning_A = 1j * scalar_field(epsilon_A, "epsilon_A") - omega_A**2
    turning_B = 1j * scalar_field(epsilon_B, "epsilon_B") - omega_B**2
    coriolis_A = 2j * omega_A * scalar_field(ds_A, "ds_A") * u_A
    coriolis_B = 2j * omega_B * scalar_field(ds_B, "ds_B") * u_B
    guide_A = field(a_A, "a_A") + turning_A * (C - field(A, "A")) + coriolis_A
    guide_B = field(a_B, "a_B") + turning_B * (C - field(B, "B")) + coriolis_B
    dds_A, minus_dds_B = solve(u_A, u_B, guide_B - guide_A, D)
    return PRPAcceleration(guide_A + dds_A * u_A, dds_A, -minus_dds_B)


@elementwise
def prp_determinant(u_A: ArrayLike, u_B: ArrayLike) -> Float:
    r"""Determinant of two sliders: of their guides' directions; NaN where they are parallel to rounding; shape (...).

    .. math:: D = u_A \times u_B

    >>> prp_determinant(1, [1j, 2])
    array([ 1., nan])
    """
    *_, D = _guides(u_A, u_B)
    return D


@elementwise
def prp_transmission_angle(u_A: ArrayLike, u_B: ArrayLike) -> Float:
    """Angle between the guides of a PRP group, in [0, pi] [rad]; dead centres at 0 and pi; shape (...).

    >>> prp_transmission_angle(1, 1j)
    np.float64(1.5707963267948966)
    """
    return angle_between(field(u_A, "u_A"), field(u_B, "u_B"))


@elementwise
def prp_condition(u_A: ArrayLike, u_B: ArrayLike) -> Float:
    """Condition number 1/sin(mu) of a PRP group, for changes relative to its coordinates; shape (...).

    >>> prp_condition(1, 2j)
    np.float64(1.0)
    """
    *_, D = _guides(u_A, u_B)
    return condition(np.ones(()), D)


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
        R_A, R_B, R_C [N], M_A, M_B [N m], h_A, h_B [m]; NaN where the guides are parallel, but for M_A, M_B.

    Raises
    ------
    ValueError
        An infinite argument, a zero direction, loads that are not a sequence of Load.

    Examples
    --------
    >>> prp_reactions(0, 1, 1j, loads_A=[Load(3 - 2j, 0)]).R_B.real
    np.float64(-3.0)
    """
    C = field(C, "C")
    u_A, u_B, D = _guides(u_A, u_B)
    F_A, T_A = resultant(loads_A, C, "loads_A")
    F_B, T_B = resultant(loads_B, C, "loads_B")
    F = F_A + F_B
    N_A, _ = solve(u_A, u_B, 1j * F, D)
    N_B = -cross(u_B, F + 1j * N_A * u_A)  # what R_A leaves, and not a second quotient: no residual near a dead centre
    R_A = 1j * N_A * u_A
    return PRPReactions(R_A, 1j * N_B * u_B, -(R_A + F_A), -T_A, -T_B, lever(-T_A, N_A), lever(-T_B, N_B))


@dataclass(frozen=True, eq=False)
class PRPGroup:
    """Two sliders with a common pin in its positions: each question about it as a function of what is not yet known.

    Arguments, results and errors are those of `prp` and of the functions named beside it; ``acceleration`` takes the
    first derivatives from ``velocity``, so that no rate is told twice.

    >>> group = PRPGroup(0, 1 + 2j, 1, 1 + 1j)
    >>> group.C
    np.complex128(-1+0j)
    >>> velocity = group.velocity(v_B=2)
    >>> velocity.ds_A, group.acceleration(velocity, a_B=3).dds_A
    (np.float64(2.0), np.float64(3.0))
    """

    A: ArrayLike  # [m] a point of each guide
    B: ArrayLike
    u_A: ArrayLike  # directions of the guides
    u_B: ArrayLike
    C: Complex = attribute(init=False)  # [m] pin

    def __post_init__(self) -> None:
        object.__setattr__(self, "C", prp(self.A, self.B, self.u_A, self.u_B))

    @property
    def AC(self) -> Complex:
        """Vector from the guide's point A to the pin [m]."""
        return np.subtract(self.C, self.A)

    @property
    def BC(self) -> Complex:
        """Vector from the guide's point B to the pin [m]."""
        return np.subtract(self.C, self.B)

    @property
    def reach(self) -> Reach:
        """Interval of the offset of a guide in which the group closes: without ends (`prp_reach`)."""
        return prp_reach(self.A, self.B, self.u_A, self.u_B)

    @property
    def determinant(self) -> Float:
        """Determinant, NaN at a dead centre (`prp_determinant`)."""
        return prp_determinant(self.u_A, self.u_B)

    @property
    def transmission_angle(self) -> Float:
        """Angle between the guides [rad] (`prp_transmission_angle`)."""
        return prp_transmission_angle(self.u_A, self.u_B)

    @property
    def condition(self) -> Float:
        """Condition number (`prp_condition`)."""
        return prp_condition(self.u_A, self.u_B)

    def velocity(
        self, v_A: ArrayLike = 0.0, v_B: ArrayLike = 0.0, omega_A: ArrayLike = 0.0, omega_B: ArrayLike = 0.0
    ) -> PRPMotion:
        """Velocities (`prp_velocity`)."""
        rates = prp_velocity(self.A, self.B, self.C, self.u_A, self.u_B, v_A, v_B, omega_A, omega_B)
        return PRPMotion(*rates, omega_A, omega_B)

    def acceleration(
        self,
        velocity: PRPMotion,
        a_A: ArrayLike = 0.0,
        a_B: ArrayLike = 0.0,
        epsilon_A: ArrayLike = 0.0,
        epsilon_B: ArrayLike = 0.0,
    ) -> PRPAcceleration:
        """Accelerations (`prp_acceleration`)."""
        rates = velocity.ds_A, velocity.ds_B, velocity.omega_A, velocity.omega_B
        return prp_acceleration(self.A, self.B, self.C, self.u_A, self.u_B, *rates, a_A, a_B, epsilon_A, epsilon_B)

    def reactions(self, loads_A: Sequence[Load] = (), loads_B: Sequence[Load] = ()) -> PRPReactions:
        """Reactions of pin and guides (`prp_reactions`)."""
        return prp_reactions(self.C, self.u_A, self.u_B, loads_A, loads_B)


def _guides(u_A: ArrayLike, u_B: ArrayLike) -> tuple[Complex, Complex, Float]:
    """Unit vectors of the guides, and their determinant."""
    u_A, u_B = unit(u_A, "u_A"), unit(u_B, "u_B")
    return u_A, u_B, determinant(cross(u_A, u_B), np.asarray(2.0))
