"""RPP, kind 5: a link in the slot of a slider, on a guide that may move. Notation as in `group`."""

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


class RPPVelocity(NamedTuple):
    """First derivatives of an RPP group."""

    v_C: Complex  # [m/s] velocity of the slider's point C
    ds_A: Float  # [m/s] speed of the link along u_A, relative to the slider
    ds_B: Float  # [m/s] speed of the slider along u_B, relative to the guide


class RPPAcceleration(NamedTuple):
    """Second derivatives of an RPP group."""

    a_C: Complex  # [m/s^2] acceleration of the slider's point C
    dds_A: Float  # [m/s^2] second derivative of the sliding distance along u_A
    dds_B: Float  # [m/s^2] second derivative of the sliding distance along u_B


class RPPMotion(NamedTuple):
    """First derivatives of an `RPPGroup`, found and given."""

    v_C: Complex  # [m/s] velocity of the slider's point C
    ds_A: Float  # [m/s] speed of the link along u_A, relative to the slider
    ds_B: Float  # [m/s] speed of the slider along u_B, relative to the guide
    omega_B: ArrayLike  # [rad/s] angular velocity of the guide, as given


class RPPReactions(NamedTuple):
    """Reactions of a link pinned at A in the slot of a slider on a guide."""

    R_A: Complex  # [N] on the link at A, from the body that carries A
    R_B: Complex  # [N] on the slider, from the guide
    R_C: Complex  # [N] on the link, from the slider
    M_B: Float  # [N m] on the slider, from the guide, about C
    M_C: Float  # [N m] on the link, from the slider, about A
    h_B: Float  # [m] distance of R_B from C along u_B; NaN where R_B is zero
    h_C: Float  # [m] distance of R_C from A along u_A; NaN where R_C is zero


@elementwise
def rpp(A: ArrayLike, B: ArrayLike, u_A: ArrayLike, u_B: ArrayLike) -> Complex:
    r"""Point C of a slider on a guide through B, in whose slot a link pinned at A slides (kind 5).

    C is where the slot's line through A crosses the guide's line:

    .. math:: A = C + t \, u_A, \quad C = B + s \, u_B

    Parameters
    ----------
    A : complex, shape (...)
        Outer pin [m].
    B : complex, shape (...)
        A point of the guide [m].
    u_A, u_B : complex, shape (...)
        Directions of the slot and of the guide, of any length but zero.

    Returns
    -------
    complex, shape (...)
        C [m]; NaN where slot and guide are parallel.

    Raises
    ------
    ValueError
        An infinite argument, a zero direction.

    Examples
    --------
    Scotch yoke: the yoke follows the crank pin's abscissa.

    >>> rpp(0.3 + 0.4j, 0, 1j, 1)
    np.complex128(0.3+0j)
    """
    u_A, u_B, D = _directions(u_A, u_B)
    return crossing(field(A, "A"), field(B, "B"), u_A, u_B, D)


@elementwise
def rpp_reach(A: ArrayLike, B: ArrayLike, u_A: ArrayLike, u_B: ArrayLike) -> Reach:
    """Interval of the offset of slot or guide, square to itself, for which the slider has a place: without ends.

    Parameters
    ----------
    A, B, u_A, u_B
        As in `rpp`.

    Returns
    -------
    Reach
        Minus infinity and infinity, shape (...); NaN where slot and guide are parallel, for it has no place then.

    Raises
    ------
    ValueError
        As in `rpp`.

    Examples
    --------
    >>> rpp_reach(0.3 + 0.4j, 0, [1j, 2], 1)
    Reach(least=array([-inf,  nan]), greatest=array([inf, nan]))
    """
    return endless(rpp(A, B, u_A, u_B))


@elementwise
def rpp_velocity(
    A: ArrayLike,
    B: ArrayLike,
    C: ArrayLike,
    u_A: ArrayLike,
    u_B: ArrayLike,
    v_A: ArrayLike = 0.0,
    v_B: ArrayLike = 0.0,
    omega_B: ArrayLike = 0.0,
) -> RPPVelocity:
    r"""Velocities of a slider on a guide that may move, and of the link that slides in its slot.

    .. math:: \dot s_A u_A + \dot s_B u_B = v_A - v_B - i \omega_B (A - B)

    Parameters
    ----------
    A, B, C : complex, shape (...)
        Outer pin, point of the guide, slider's point from `rpp` [m].
    u_A, u_B : complex, shape (...)
        Directions of the slot and of the guide, of any length but zero.
    v_A, v_B : complex, shape (...)
        Velocities of A and of the guide's point B [m/s], or their analogues.
    omega_B : float, shape (...)
        Angular velocity of the guide, which is the slider's and the link's [rad/s].

    Returns
    -------
    RPPVelocity
        v_C of the slider's point, ds_A of the link along the slot, ds_B of the slider along the guide [m/s]; NaN
        where slot and guide are parallel.

    Raises
    ------
    ValueError
        An infinite argument, a zero direction.

    Examples
    --------
    >>> rpp_velocity(0.3 + 0.4j, 0, 0.3, 1j, 1, v_A=-4 + 3j).ds_B
    np.float64(-4.0)
    """
    B = field(B, "B")
    u_A, u_B, D = _directions(u_A, u_B)
    v_B, turning = field(v_B, "v_B"), 1j * scalar_field(omega_B, "omega_B")
    ds_A, ds_B = solve(u_A, u_B, field(v_A, "v_A") - v_B - turning * (field(A, "A") - B), D)
    return RPPVelocity(v_B + turning * (field(C, "C") - B) + ds_B * u_B, ds_A, ds_B)


@elementwise
def rpp_acceleration(
    A: ArrayLike,
    B: ArrayLike,
    C: ArrayLike,
    u_A: ArrayLike,
    u_B: ArrayLike,
    ds_A: ArrayLike,
    ds_B: ArrayLike,
    omega_B: ArrayLike = 0.0,
    a_A: ArrayLike = 0.0,
    a_B: ArrayLike = 0.0,
    epsilon_B: ArrayLike = 0.0,
) -> RPPAcceleration:
    r"""Accelerations of a slider on a guide that may move, and of the link that slides in its slot.

    .. math:: \ddot s_A u_A + \ddot s_B u_B = a_A - a_B - (i \varepsilon_B - \omega_B^2)(A - B)
              - 2 i \omega_B (\dot s_A u_A + \dot s_B u_B)

    Parameters
    ----------
    A, B, C, u_A, u_B
        As in `rpp_velocity`.
    ds_A, ds_B : float, shape (...)
        Sliding speeds [m/s] from `rpp_velocity`.
    omega_B : float, shape (...)
        Angular velocity of the guide [rad/s], as given to `rpp_velocity`.
    a_A, a_B : complex, shape (...)
        Accelerations of A and of the guide's point B [m/s^2], or their analogues.
    epsilon_B : float, shape (...)
        Angular acceleration of the guide [rad/s^2].

    Returns
    -------
    RPPAcceleration
        a_C of the slider's point, dds_A, dds_B [m/s^2]; NaN where slot and guide are parallel.

    Raises
    ------
    ValueError
        An infinite argument, a zero direction.

    Examples
    --------
    >>> rpp_acceleration(0.3 + 0.4j, 0, 0.3, 1j, 1, 3, -4, a_A=-30 - 40j).dds_B
    np.float64(-30.0)
    """
    B = field(B, "B")
    u_A, u_B, D = _directions(u_A, u_B)
    a_B, omega_B = field(a_B, "a_B"), scalar_field(omega_B, "omega_B")
    turning = 1j * scalar_field(epsilon_B, "epsilon_B") - omega_B**2
    coriolis_A = 2j * omega_B * scalar_field(ds_A, "ds_A") * u_A
    coriolis_B = 2j * omega_B * scalar_field(ds_B, "ds_B") * u_B
    known = a_B + turning * (field(A, "A") - B) + coriolis_A + coriolis_B
    dds_A, dds_B = solve(u_A, u_B, field(a_A, "a_A") - known, D)
    return RPPAcceleration(a_B + turning * (field(C, "C") - B) + coriolis_B + dds_B * u_B, dds_A, dds_B)


@elementwise
def rpp_determinant(u_A: ArrayLike, u_B: ArrayLike) -> Float:
    r"""Determinant of the directions of slot and guide; NaN where they are parallel to rounding; shape (...).

    .. math:: D = u_A \times u_B

    >>> rpp_determinant(1, [1j, 2])
    array([ 1., nan])
    """
    *_, D = _directions(u_A, u_B)
    return D


@elementwise
def rpp_transmission_angle(u_A: ArrayLike, u_B: ArrayLike) -> Float:
    """Angle between slot and guide of an RPP group, in [0, pi] [rad]; dead centres at 0 and pi; shape (...).

    >>> rpp_transmission_angle(1j, 1)
    np.float64(1.5707963267948966)
    """
    return angle_between(field(u_A, "u_A"), field(u_B, "u_B"))


@elementwise
def rpp_condition(u_A: ArrayLike, u_B: ArrayLike) -> Float:
    """Condition number 1/sin(mu) of an RPP group, for changes relative to its coordinates; shape (...).

    >>> rpp_condition(1j, 1)
    np.float64(1.0)
    """
    *_, D = _directions(u_A, u_B)
    return condition(np.ones(()), D)


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
        R_A, R_B, R_C [N], M_B, M_C [N m], h_B, h_C [m]; NaN where slot and guide are parallel, but for M_C.

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
    A, C = field(A, "A"), field(C, "C")
    u_A, u_B, D = _directions(u_A, u_B)
    F_A, T_A = resultant(loads_A, A, "loads_A")
    F_B, T_B = resultant(loads_B, C, "loads_B")
    N, _ = solve(u_A, u_B, 1j * F_B, D)
    N_B = -cross(u_B, F_B + 1j * N * u_A)  # what R_C leaves, and not a second quotient: no residual near a dead centre
    R_C = -1j * N * u_A
    M_B = -(T_A + cross(A - C, -R_C) + T_B)
    R_A = -(R_C + F_A)
    return RPPReactions(R_A, 1j * N_B * u_B, R_C, M_B, -T_A, lever(M_B, N_B), lever(-T_A, -N))


@dataclass(frozen=True, eq=False)
class RPPGroup:
    """A link in the slot of a slider in its positions: each question about it as a function of what is not yet known.

    Arguments, results and errors are those of `rpp` and of the functions named beside it; ``acceleration`` takes the
    first derivatives from ``velocity``, so that no rate is told twice.

    >>> group = RPPGroup(0.3 + 0.4j, 0, 1j, 1)
    >>> group.C
    np.complex128(0.3+0j)
    >>> velocity = group.velocity(v_A=-4 + 3j)
    >>> velocity.ds_B, group.acceleration(velocity, a_A=-30 - 40j).dds_B
    (np.float64(-4.0), np.float64(-30.0))
    """

    A: ArrayLike  # [m] outer pin
    B: ArrayLike  # [m] a point of the guide
    u_A: ArrayLike  # direction of the slot
    u_B: ArrayLike  # direction of the guide
    C: Complex = attribute(init=False)  # [m] slider's point

    def __post_init__(self) -> None:
        object.__setattr__(self, "C", rpp(self.A, self.B, self.u_A, self.u_B))

    @property
    def AC(self) -> Complex:
        """Vector from the outer pin to the slider's point [m]."""
        return np.subtract(self.C, self.A)

    @property
    def BC(self) -> Complex:
        """Vector from the guide's point to the slider's [m]."""
        return np.subtract(self.C, self.B)

    @property
    def reach(self) -> Reach:
        """Interval of the offset of slot or guide in which the group closes: without ends (`rpp_reach`)."""
        return rpp_reach(self.A, self.B, self.u_A, self.u_B)

    @property
    def determinant(self) -> Float:
        """Determinant, NaN at a dead centre (`rpp_determinant`)."""
        return rpp_determinant(self.u_A, self.u_B)

    @property
    def transmission_angle(self) -> Float:
        """Angle between slot and guide [rad] (`rpp_transmission_angle`)."""
        return rpp_transmission_angle(self.u_A, self.u_B)

    @property
    def condition(self) -> Float:
        """Condition number (`rpp_condition`)."""
        return rpp_condition(self.u_A, self.u_B)

    def velocity(self, v_A: ArrayLike = 0.0, v_B: ArrayLike = 0.0, omega_B: ArrayLike = 0.0) -> RPPMotion:
        """Velocities (`rpp_velocity`)."""
        rates = rpp_velocity(self.A, self.B, self.C, self.u_A, self.u_B, v_A, v_B, omega_B)
        return RPPMotion(*rates, omega_B)

    def acceleration(
        self,
        velocity: RPPMotion,
        a_A: ArrayLike = 0.0,
        a_B: ArrayLike = 0.0,
        epsilon_B: ArrayLike = 0.0,
    ) -> RPPAcceleration:
        """Accelerations (`rpp_acceleration`)."""
        rates = velocity.ds_A, velocity.ds_B, velocity.omega_B
        return rpp_acceleration(self.A, self.B, self.C, self.u_A, self.u_B, *rates, a_A, a_B, epsilon_B)

    def reactions(self, loads_A: Sequence[Load] = (), loads_B: Sequence[Load] = ()) -> RPPReactions:
        """Reactions of pin, slot and guide (`rpp_reactions`)."""
        return rpp_reactions(self.A, self.C, self.u_A, self.u_B, loads_A, loads_B)


def _directions(u_A: ArrayLike, u_B: ArrayLike) -> tuple[Complex, Complex, Float]:
    """Unit vectors of slot and guide, and their determinant."""
    u_A, u_B = unit(u_A, "u_A"), unit(u_B, "u_B")
    return u_A, u_B, determinant(cross(u_A, u_B), np.asarray(2.0))
