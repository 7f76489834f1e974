"""RRP, kind 2: a link joined by a pin to a slider on a guide that may move. Notation as in `group`."""

from collections.abc import Sequence
from dataclasses import dataclass
from dataclasses import field as attribute
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from mechsheet.mechanics.arguments import (
    Complex,
    Float,
    direction,
    elementwise,
    field,
    length,
    parameter,
    scalar_field,
    sign,
    unit,
)
from mechsheet.mechanics.group import Reach, carried, condition, determinant, endless, moved, slid, within
from mechsheet.mechanics.load import Load, lever, resultant
from mechsheet.mechanics.planar import angle_between, cross, dot, product


class RRPVelocity(NamedTuple):
    """First derivatives of an RRP group."""

    v_C: Complex  # [m/s] velocity of the pin C
    omega_A: Float  # [rad/s] angular velocity of the link AC
    ds: Float  # [m/s] speed of the slider along u, relative to the guide


class RRPAcceleration(NamedTuple):
    """Second derivatives of an RRP group."""

    a_C: Complex  # [m/s^2] acceleration of the pin C
    epsilon_A: Float  # [rad/s^2] angular acceleration of the link AC
    dds: Float  # [m/s^2] second derivative of the slider's path along the guide


class RRPMotion(NamedTuple):
    """First derivatives of an `RRPGroup`, found and given."""

    v_C: Complex  # [m/s] velocity of the pin C
    omega_A: Float  # [rad/s] angular velocity of the link AC
    ds: Float  # [m/s] speed of the slider along u, relative to the guide
    omega_B: ArrayLike  # [rad/s] angular velocity of the guide, as given
    dr_A: ArrayLike  # [m/s] rate of the length AC, as given


class RRPReactions(NamedTuple):
    """Reactions of a link AC with a slider on a guide."""

    R_A: Complex  # [N] on the link AC at A, from the body that carries A
    R_B: Complex  # [N] on the slider, from the guide
    R_C: Complex  # [N] on the link AC at C, from the slider
    M_B: Float  # [N m] on the slider, from the guide, about C
    h_B: Float  # [m] distance of R_B from C along u; NaN where R_B is zero


@elementwise
def rrp(
    A: ArrayLike, B: ArrayLike, u: ArrayLike, r_A: ArrayLike, branch: ArrayLike, offset: ArrayLike = 0.0
) -> Complex:
    r"""Pin C of a link AC whose slider moves along a guide through B (kind 2).

    .. math:: C = A + \left(s \sqrt{r_A^2 - h^2} - i h\right) u, \quad h = u \times (A - B) - e

    Parameters
    ----------
    A : complex, shape (...)
        Outer pin [m].
    B : complex, shape (...)
        A point of the guide [m].
    u : complex, shape (...)
        Direction of the guide, of any length but zero.
    r_A : float, shape (...)
        Length of AC [m].
    branch : {+1, -1}, shape (...)
        s: +1 puts C ahead of A in the direction u.
    offset : float, shape (...)
        e: distance of C's path from the line through B [m], positive to the left of u.

    Returns
    -------
    complex, shape (...)
        C [m]; NaN where the link does not reach the guide (`rrp_reach`), but for roundings of |A|, |B|, e and r_A.

    Raises
    ------
    ValueError
        A negative or infinite length, a single NaN one, a NaN or infinite offset, an infinite point, a zero
        direction, a branch other than +1 and -1.

    Examples
    --------
    >>> rrp(3j, 0, 1, [5, 2], -1)
    array([-4. +0.j, nan+nanj])
    """
    A, u = field(A, "A"), unit(u, "u")
    B, e = field(B, "B"), parameter(offset, "offset", "m")
    r_A = length(r_A, "length r_A")
    h = within(cross(u, A - B) - e, r_A, A, B, e)
    ahead = np.sqrt((r_A - np.abs(h)) * (r_A + np.abs(h)))
    return A + product(sign(branch) * ahead, -h, u)


@elementwise
def rrp_reach(A: ArrayLike, B: ArrayLike, u: ArrayLike, offset: ArrayLike = 0.0) -> Reach:
    r"""Interval of the length r_A for which the link AC reaches the guide: from the distance of A, without end.

    Parameters
    ----------
    A, B, u, offset
        As in `rrp`.

    Returns
    -------
    Reach
        least r_A [m], which closes, and infinity, shape (...).

    Raises
    ------
    ValueError
        As in `rrp`.

    Examples
    --------
    >>> rrp_reach(3j, 0, 1, offset=1)
    Reach(least=np.float64(2.0), greatest=np.float64(inf))
    """
    h = cross(unit(u, "u"), field(A, "A") - field(B, "B")) - parameter(offset, "offset", "m")
    return Reach(np.abs(h), endless(h).greatest)


@elementwise
def rrp_velocity(
    A: ArrayLike,
    B: ArrayLike,
    C: ArrayLike,
    u: ArrayLike,
    v_A: ArrayLike = 0.0,
    v_B: ArrayLike = 0.0,
    omega_B: ArrayLike = 0.0,
    dr_A: ArrayLike = 0.0,
) -> RRPVelocity:
    r"""Velocities of a link AC and its slider C on a guide that may move.

    .. math:: i \omega_A a - \dot s u = w, \quad a = C - A, \quad
              w = v_B + i \omega_B (C - B) - v_A - \dot r_A a/|a|

    .. math:: \omega_A = u \times w / (a \cdot u), \quad \dot s = - w \cdot a / (a \cdot u)

    Parameters
    ----------
    A, B, C : complex, shape (...)
        Outer pin, point of the guide, slider's pin [m].
    u : complex, shape (...)
        Direction of the guide, of any length but zero.
    v_A, v_B : complex, shape (...)
        Velocities of A and of the guide's point B [m/s], or their analogues.
    omega_B : float, shape (...)
        Angular velocity of the guide, which is the slider's [rad/s].
    dr_A : float, shape (...)
        Rate of the length AC [m/s].

    Returns
    -------
    RRPVelocity
        v_C [m/s], omega_A [rad/s], ds [m/s]; NaN at a dead centre.

    Raises
    ------
    ValueError
        An infinite argument, a zero direction.

    Examples
    --------
    >>> rrp_velocity(3j, 0, 4, 1, v_A=1j).ds
    np.float64(-0.75)
    """
    A, C, a, u, size, D = _link(A, C, u)
    guide, known, shared = _guided(A, B, C, field(v_B, "v_B"), scalar_field(omega_B, "omega_B"))
    minus_omega, along = slid(a, u, moved(field(v_A, "v_A"), a, dr_A, "dr_A") - known, D)
    return RRPVelocity(guide + along * u, shared - minus_omega, along * size)


@elementwise
def rrp_acceleration(
    A: ArrayLike,
    B: ArrayLike,
    C: ArrayLike,
    u: ArrayLike,
    omega_A: ArrayLike,
    ds: ArrayLike,
    omega_B: ArrayLike = 0.0,
    dr_A: ArrayLike = 0.0,
    a_A: ArrayLike = 0.0,
    a_B: ArrayLike = 0.0,
    epsilon_B: ArrayLike = 0.0,
    ddr_A: ArrayLike = 0.0,
) -> RRPAcceleration:
    r"""Accelerations of a link AC and its slider C on a guide that may move.

    .. math:: i x a - \ddot s u = a_B + (i \varepsilon_B - \omega_B^2)(C - B)
              + 2 i \omega_B \dot s u - a_A - k_A a, \quad \varepsilon_A = x - 2 \omega_A \dot r_A/r_A

    with k as in `rrr_acceleration`, solved as the velocities are.

    Parameters
    ----------
    A, B, C, u
        As in `rrp_velocity`.
    omega_A, ds : float, shape (...)
        Angular velocity of AC [rad/s] and speed of the slider [m/s] from `rrp_velocity`.
    omega_B, dr_A : float, shape (...)
        Angular velocity of the guide [rad/s] and rate of the length AC [m/s], as given to `rrp_velocity`.
    a_A, a_B : complex, shape (...)
        Accelerations of A and of the guide's point B [m/s^2], or their analogues.
    epsilon_B : float, shape (...)
        Angular acceleration of the guide [rad/s^2].
    ddr_A : float, shape (...)
        Second derivative of the length AC [m/s^2].

    Returns
    -------
    RRPAcceleration
        a_C [m/s^2], epsilon_A [rad/s^2], dds [m/s^2]; NaN at a dead centre.

    Raises
    ------
    ValueError
        An infinite argument, a zero direction.

    Examples
    --------
    >>> rrp_acceleration(3j, 0, 4, 1, -0.25, -0.75).dds
    np.float64(-0.390625)
    """
    A, C, a, u, size, D = _link(A, C, u)
    a_B, omega_B = field(a_B, "a_B"), scalar_field(omega_B, "omega_B")
    ds = scalar_field(ds, "ds")
    if omega_B.ndim or omega_B:
        a_B = a_B - omega_B**2 * (C - field(B, "B")) + (2j * omega_B * ds / size) * u
    guide, known, shared = _guided(A, B, C, a_B, scalar_field(epsilon_B, "epsilon_B"))
    along_A, coriolis_A = carried(a, omega_A, dr_A, ddr_A, "A")
    minus_x, along = slid(a, u, field(a_A, "a_A") + along_A - known, D)
    return RRPAcceleration(guide + along * u, shared - minus_x - coriolis_A, along * size)


@elementwise
def rrp_determinant(A: ArrayLike, C: ArrayLike, u: ArrayLike) -> Float:
    r"""Determinant of a link AC with a slider; NaN at a dead centre to rounding; shape (...).

    .. math:: D = a \cdot u, \quad a = C - A

    >>> rrp_determinant(3j, [4, 0], 1)
    array([ 4., nan])
    """
    *_, size, D = _link(A, C, u)
    return D / size


@elementwise
def rrp_transmission_angle(A: ArrayLike, C: ArrayLike, u: ArrayLike) -> Float:
    """Angle between the link AC and the guide's normal, in [0, pi] [rad]; dead centres at 0 and pi; shape (...).

    >>> rrp_transmission_angle(1j, 1, 1)
    np.float64(2.356194490192345)
    """
    return angle_between(field(C, "C") - field(A, "A"), 1j * field(u, "u"))


@elementwise
def rrp_condition(A: ArrayLike, B: ArrayLike, C: ArrayLike, u: ArrayLike) -> Float:
    r"""Condition number of a link AC with a slider; infinite at a dead centre; shape (...).

    .. math:: \kappa = \frac{|A| + |B| + |a| + |C - B|}{|a| \sin\mu}, \quad a = C - A

    >>> rrp_condition(3j, 0, 4, 1)
    np.float64(3.0)
    """
    A, C, a, _, size, D = _link(A, C, u)
    guide = C - field(B, "B")
    return condition((np.abs(A) + np.abs(B) + np.abs(a) + np.abs(guide)) * size, D)


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
        R_A, R_B, R_C [N], M_B [N m], h_B [m]; NaN at a dead centre, but for M_B.

    Raises
    ------
    ValueError
        An infinite argument, a zero direction, loads that are not a sequence of Load.

    Examples
    --------
    >>> rrp_reactions(3j, 4, 1, loads_B=[Load(8, 4)]).R_B.imag
    np.float64(-6.0)
    """
    A, C, a, u, size, D = _link(A, C, u)
    F_A, T_A = resultant(loads_A, A, "loads_A")
    F_B, T_B = resultant(loads_B, C, "loads_B")
    N = -(T_A + cross(a, F_B)) / D
    R_B = 1j * N * u
    R_C = R_B + F_B
    return RRPReactions(-(R_C + F_A), R_B, R_C, -T_B, lever(-T_B, N * size))


@dataclass(frozen=True, eq=False)
class RRPGroup:
    """A link AC with a slider in its positions: each question about it as a function of what is not yet known.

    Arguments, results and errors are those of `rrp` and of the functions named beside it; ``acceleration`` takes the
    first derivatives from ``velocity``, so that no rate is told twice.

    >>> group = RRPGroup(3j, 0, 1, 5, +1)
    >>> group.C, group.AC
    (np.complex128(4+0j), np.complex128(4-3j))
    >>> velocity = group.velocity(v_A=1j)
    >>> velocity.ds, group.acceleration(velocity).dds
    (np.float64(-0.75), np.float64(-0.390625))
    """

    A: ArrayLike  # [m] outer pin
    B: ArrayLike  # [m] a point of the guide
    u: ArrayLike  # direction of the guide
    r_A: ArrayLike  # [m] length of AC
    branch: ArrayLike  # +1 puts C ahead of A in the direction u, -1 behind it
    offset: ArrayLike = 0.0  # [m] C's path from the line through B, positive to the left of u
    C: Complex = attribute(init=False)  # [m] slider's pin

    def __post_init__(self) -> None:
        object.__setattr__(self, "C", rrp(self.A, self.B, self.u, self.r_A, self.branch, self.offset))

    @property
    def AC(self) -> Complex:
        """Vector of the link [m]."""
        return np.subtract(self.C, self.A)

    @property
    def BC(self) -> Complex:
        """Vector from the guide's point to the slider's pin [m]."""
        return np.subtract(self.C, self.B)

    @property
    def reach(self) -> Reach:
        """Interval of r_A in which the link reaches the guide (`rrp_reach`)."""
        return rrp_reach(self.A, self.B, self.u, self.offset)

    @property
    def determinant(self) -> Float:
        """Determinant [m], NaN at a dead centre (`rrp_determinant`)."""
        return rrp_determinant(self.A, self.C, self.u)

    @property
    def transmission_angle(self) -> Float:
        """Angle between the link and the guide's normal [rad] (`rrp_transmission_angle`)."""
        return rrp_transmission_angle(self.A, self.C, self.u)

    @property
    def condition(self) -> Float:
        """Condition number (`rrp_condition`)."""
        return rrp_condition(self.A, self.B, self.C, self.u)

    def velocity(
        self, v_A: ArrayLike = 0.0, v_B: ArrayLike = 0.0, omega_B: ArrayLike = 0.0, dr_A: ArrayLike = 0.0
    ) -> RRPMotion:
        """Velocities (`rrp_velocity`)."""
        return RRPMotion(*rrp_velocity(self.A, self.B, self.C, self.u, v_A, v_B, omega_B, dr_A), omega_B, dr_A)

    def acceleration(
        self,
        velocity: RRPMotion,
        a_A: ArrayLike = 0.0,
        a_B: ArrayLike = 0.0,
        epsilon_B: ArrayLike = 0.0,
        ddr_A: ArrayLike = 0.0,
    ) -> RRPAcceleration:
        """Accelerations (`rrp_acceleration`)."""
        rates = velocity.omega_A, velocity.ds, velocity.omega_B, velocity.dr_A
        return rrp_acceleration(self.A, self.B, self.C, self.u, *rates, a_A, a_B, epsilon_B, ddr_A)

    def reactions(self, loads_A: Sequence[Load] = (), loads_B: Sequence[Load] = ()) -> RRPReactions:
        """Reactions of pins and guide (`rrp_reactions`)."""
        return rrp_reactions(self.A, self.C, self.u, loads_A, loads_B)


def _link(A: ArrayLike, C: ArrayLike, u: ArrayLike) -> tuple[Complex, Complex, Complex, Complex, Float, Float]:
    """Pins A and C, vector AC, the guide's direction and its length, and the determinant times that length."""
    A, C, (u, size) = field(A, "A"), field(C, "C"), direction(u, "u")
    a = C - A
    return A, C, a, u, size, determinant(dot(a, u), (np.abs(A) + np.abs(C)) * size)


def _guided(A: Complex, B: ArrayLike, C: Complex, v: Complex, omega: Float) -> tuple[Complex, Complex, Float]:
    """Motion of the guide at C; its motion at A or at C, and what the link's turning is counted from then.

    A guide that turns moves what is far from B by much more than the link makes of it. Where A is much nearer to B than
    C is, the equations hold the guide's motion at A, and the link's turning counts from the guide's.
    """
    B = field(B, "B")
    if not (omega.ndim or omega or B.ndim) and B == B:
        return v, v, np.zeros(())
    from_A, from_C = A - B, C - B
    guide = v + 1j * omega * from_C
    at_A = 16 * np.abs(from_A) < np.abs(from_C)
    if not np.count_nonzero(at_A):
        return guide, guide, np.zeros(())
    return guide, np.where(at_A, v + 1j * omega * from_A, guide), np.where(at_A, omega, 0.0)
