"""RPR, kind 3: a slotted link with its block, or a passive cylinder with its rod. Notation as in `group`."""

from collections.abc import Sequence
from dataclasses import dataclass
from dataclasses import field as attribute
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from mechsheet.mechanics.arguments import Complex, Float, direction, elementwise, field, parameter, scalar_field, sign
from mechsheet.mechanics.group import Reach, condition, determinant, slid, within
from mechsheet.mechanics.load import Load, lever, resultant
from mechsheet.mechanics.planar import angle_between, dot


class RPRPosition(NamedTuple):
    """Position of an RPR group."""

    u: Complex  # unit vector of the slide
    s: Float  # [m] distance of A along u from the perpendicular through B


class RPRVelocity(NamedTuple):
    """First derivatives of an RPR group."""

    omega_A: Float  # [rad/s] angular velocity of both links
    ds: Float  # [m/s] sliding speed of A's link along u, relative to B's


class RPRAcceleration(NamedTuple):
    """Second derivatives of an RPR group."""

    epsilon_A: Float  # [rad/s^2] angular acceleration of both links
    dds: Float  # [m/s^2] second derivative of the sliding distance


class RPRReactions(NamedTuple):
    """Reactions of a block or rod pinned at A in a slotted link or cylinder pinned at B."""

    R_A: Complex  # [N] on the block at A, from the body that carries A
    R_B: Complex  # [N] on the slotted link at B, from the body that carries B
    R_C: Complex  # [N] on the block, from the slotted link
    M_C: Float  # [N m] on the block, from the slotted link, about A
    h_C: Float  # [m] distance of R_C from A along u; NaN where R_C is zero


@elementwise
def rpr(A: ArrayLike, B: ArrayLike, branch: ArrayLike, offset: ArrayLike = 0.0) -> RPRPosition:
    r"""Direction of a slotted link or passive cylinder pinned at B, with the block or rod pinned at A (kind 3).

    .. math:: A - B = (s + i e) u, \quad s = \pm\sqrt{|A - B|^2 - e^2}

    A cylinder whose length is given is a link of an RRR group.

    Parameters
    ----------
    A, B : complex, shape (...)
        Pins of the block and of the slotted link [m].
    branch : {+1, -1}, shape (...)
        Sign of s: +1 turns u from B towards A.
    offset : float, shape (...)
        e: distance of A's path from B [m], positive to the left of u.

    Returns
    -------
    RPRPosition
        u and s [m]; NaN where A is nearer to B than the offset, but for roundings of |A|, |B| and their distance;
        no direction where A = B.

    Raises
    ------
    ValueError
        A NaN or infinite offset, an infinite pin, a branch other than +1 and -1.

    Examples
    --------
    >>> rpr(2j, 0, 1)
    RPRPosition(u=np.complex128(1j), s=np.float64(2.0))
    """
    A, B = field(A, "A"), field(B, "B")
    d = A - B
    L = np.abs(d)
    e = within(parameter(offset, "offset", "m"), L, A, B)
    s = sign(branch) * np.sqrt((L - e) * (L + e))
    return RPRPosition(d / (s + 1j * e), s)


@elementwise
def rpr_reach(A: ArrayLike, B: ArrayLike) -> Reach:
    r"""Interval of the offset for which the slide passes through A: no farther from B than A is.

    Parameters
    ----------
    A, B : complex, shape (...)
        Pins of the block and of the slotted link [m].

    Returns
    -------
    Reach
        least and greatest offset [m], shape (...).

    Raises
    ------
    ValueError
        An infinite pin.

    Examples
    --------
    >>> rpr_reach(2j, 0)
    Reach(least=np.float64(-2.0), greatest=np.float64(2.0))
    """
    L = np.abs(field(A, "A") - field(B, "B"))
    return Reach(-L, L)


@elementwise
def rpr_velocity(A: ArrayLike, B: ArrayLike, u: ArrayLike, v_A: ArrayLike = 0.0, v_B: ArrayLike = 0.0) -> RPRVelocity:
    r"""Angular velocity and sliding speed of a slotted link or passive cylinder.

    .. math:: \bar u (v_A - v_B) = \dot s + i \omega_A (s + i e), \quad s + i e = \bar u (A - B)

    Parameters
    ----------
    A, B : complex, shape (...)
        Pins of the block and of the slotted link [m].
    u : complex, shape (...)
        Direction of the slide, of any length but zero.
    v_A, v_B : complex, shape (...)
        Velocities of the pins [m/s], or their analogues.

    Returns
    -------
    RPRVelocity
        omega_A [rad/s], ds [m/s]; NaN where A - B is square to the slide.

    Raises
    ------
    ValueError
        An infinite argument, a zero direction.

    Examples
    --------
    >>> rpr_velocity(2j, 0, 1j, v_A=3 + 1j)
    RPRVelocity(omega_A=np.float64(-1.5), ds=np.float64(1.0))
    """
    d, u, size, D = _slide(A, B, u)
    omega_A, along = slid(d, u, field(v_A, "v_A") - field(v_B, "v_B"), D)
    return RPRVelocity(omega_A, along * size)


@elementwise
def rpr_acceleration(
    A: ArrayLike,
    B: ArrayLike,
    u: ArrayLike,
    omega_A: ArrayLike,
    ds: ArrayLike,
    a_A: ArrayLike = 0.0,
    a_B: ArrayLike = 0.0,
) -> RPRAcceleration:
    r"""Angular acceleration and second derivative of the sliding distance of a slotted link or passive cylinder.

    .. math:: \bar u (a_A - a_B) = \ddot s + 2 i \omega_A \dot s + (i \varepsilon_A - \omega_A^2)(s + i e)

    Parameters
    ----------
    A, B, u
        As in `rpr_velocity`.
    omega_A, ds : float, shape (...)
        Angular velocity [rad/s] and sliding speed [m/s] from `rpr_velocity`.
    a_A, a_B : complex, shape (...)
        Accelerations of the pins [m/s^2], or their analogues.

    Returns
    -------
    RPRAcceleration
        epsilon_A [rad/s^2], dds [m/s^2]; NaN where A - B is square to the slide.

    Raises
    ------
    ValueError
        An infinite argument, a zero direction.

    Examples
    --------
    >>> rpr_acceleration(2j, 0, 1j, -1.5, 1)
    RPRAcceleration(epsilon_A=np.float64(1.5), dds=np.float64(4.5))
    """
    d, u, size, D = _slide(A, B, u)
    omega_A = scalar_field(omega_A, "omega_A")
    known = (2j * omega_A * scalar_field(ds, "ds") / size) * u - omega_A**2 * d
    epsilon_A, along = slid(d, u, field(a_A, "a_A") - field(a_B, "a_B") - known, D)
    return RPRAcceleration(epsilon_A, along * size)


@elementwise
def rpr_determinant(A: ArrayLike, B: ArrayLike, u: ArrayLike) -> Float:
    r"""Determinant of a slotted link or passive cylinder; NaN at a dead centre to rounding; shape (...).

    .. math:: D = (A - B) \cdot u

    >>> rpr_determinant(2j, 0, [1j, 1])
    array([ 2., nan])
    """
    *_, size, D = _slide(A, B, u)
    return D / size


@elementwise
def rpr_transmission_angle(A: ArrayLike, B: ArrayLike, u: ArrayLike) -> Float:
    """Angle between BA and the slide's normal, in [0, pi] [rad]; pi/2 where the offset is zero; shape (...).

    >>> rpr_transmission_angle(2j, 0, 1j)
    np.float64(1.5707963267948966)
    """
    return angle_between(field(A, "A") - field(B, "B"), 1j * field(u, "u"))


@elementwise
def rpr_condition(A: ArrayLike, B: ArrayLike, u: ArrayLike) -> Float:
    r"""Condition number of a slotted link or passive cylinder; infinite where A - B is square to u; shape (...).

    .. math:: \kappa = \frac{|A| + |B| + |A - B|}{|A - B| \sin\mu}

    >>> rpr_condition(2j, 0, 1j)
    np.float64(2.0)
    """
    d, _, size, D = _slide(A, B, u)
    return condition((np.abs(A) + np.abs(B) + np.abs(d)) * size, D)


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
        R_A, R_B, R_C [N], M_C [N m], h_C [m]; NaN where A - B is square to the slide, but for M_C.

    Raises
    ------
    ValueError
        An infinite argument, a zero direction, loads that are not a sequence of Load.

    Examples
    --------
    >>> rpr_reactions(2, 0, 1, loads_B=[Load(-3j, 4)]).R_A.imag
    np.float64(6.0)
    """
    _, u, size, D = _slide(A, B, u)
    F_A, T_A = resultant(loads_A, field(A, "A"), "loads_A")
    F_B, T_B = resultant(loads_B, field(B, "B"), "loads_B")
    N = (T_A + T_B) / D
    R_C = 1j * N * u
    return RPRReactions(-(R_C + F_A), R_C - F_B, R_C, -T_A, lever(-T_A, N * size))


@dataclass(frozen=True, eq=False)
class RPRGroup:
    """A slotted link or passive cylinder in its positions: each question about it as a function of what is not known.

    Arguments, results and errors are those of `rpr` and of the functions named beside it; ``acceleration`` takes the
    first derivatives from ``velocity``.

    >>> group = RPRGroup(2j, 0, +1)
    >>> group.u, group.s
    (np.complex128(1j), np.float64(2.0))
    >>> velocity = group.velocity(v_A=3 + 1j)
    >>> velocity.omega_A, group.acceleration(velocity).epsilon_A
    (np.float64(-1.5), np.float64(1.5))
    """

    A: ArrayLike  # [m] pin of the block or rod
    B: ArrayLike  # [m] pin of the slotted link or cylinder
    branch: ArrayLike  # +1 turns u from B towards A, -1 the other way
    offset: ArrayLike = 0.0  # [m] A's path from B, positive to the left of u
    u: Complex = attribute(init=False)  # unit vector of the slide
    s: Float = attribute(init=False)  # [m] distance of A along u from the perpendicular through B

    def __post_init__(self) -> None:
        u, s = rpr(self.A, self.B, self.branch, self.offset)
        object.__setattr__(self, "u", u)
        object.__setattr__(self, "s", s)

    @property
    def BA(self) -> Complex:
        """Vector from the pin of the slotted link to that of the block [m]."""
        return np.subtract(self.A, self.B)

    @property
    def reach(self) -> Reach:
        """Interval of the offset in which the group closes (`rpr_reach`)."""
        return rpr_reach(self.A, self.B)

    @property
    def determinant(self) -> Float:
        """Determinant [m], NaN at a dead centre (`rpr_determinant`)."""
        return rpr_determinant(self.A, self.B, self.u)

    @property
    def transmission_angle(self) -> Float:
        """Angle between BA and the slide's normal [rad] (`rpr_transmission_angle`)."""
        return rpr_transmission_angle(self.A, self.B, self.u)

    @property
    def condition(self) -> Float:
        """Condition number (`rpr_condition`)."""
        return rpr_condition(self.A, self.B, self.u)

    def velocity(self, v_A: ArrayLike = 0.0, v_B: ArrayLike = 0.0) -> RPRVelocity:
        """Velocities (`rpr_velocity`)."""
        return rpr_velocity(self.A, self.B, self.u, v_A, v_B)

    def acceleration(self, velocity: RPRVelocity, a_A: ArrayLike = 0.0, a_B: ArrayLike = 0.0) -> RPRAcceleration:
        """Accelerations (`rpr_acceleration`)."""
        return rpr_acceleration(self.A, self.B, self.u, *velocity, a_A, a_B)

    def reactions(self, loads_A: Sequence[Load] = (), loads_B: Sequence[Load] = ()) -> RPRReactions:
        """Reactions of pins and slide (`rpr_reactions`)."""
        return rpr_reactions(self.A, self.B, self.u, loads_A, loads_B)


def _slide(A: ArrayLike, B: ArrayLike, u: ArrayLike) -> tuple[Complex, Complex, Float, Float]:
    """Vector BA, the slide as given and its length, and the group's determinant times that length."""
    A, B, (u, size) = field(A, "A"), field(B, "B"), direction(u, "u")
    d = A - B
    return d, u, size, determinant(dot(d, u), (np.abs(A) + np.abs(B)) * size)
