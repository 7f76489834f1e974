"""RRR, kind 1: two links joined by a pin; a driving cylinder is a link of given length. Notation as in `group`."""

from collections.abc import Sequence
from dataclasses import dataclass
from dataclasses import field as attribute
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from mechsheet.mechanics.arguments import Complex, Float, elementwise, field, length, sign
from mechsheet.mechanics.group import ROUNDINGS, Reach, carried, condition, determinant, moved, turned
from mechsheet.mechanics.load import Load, resultant
from mechsheet.mechanics.planar import cross, flat, meet, product, turn

_EPS = 2.0**-52


class RRRVelocity(NamedTuple):
    """First derivatives of an RRR group."""

    v_C: Complex  # [m/s] velocity of the pin C
    omega_A: Float  # [rad/s] angular velocity of the link AC
    omega_B: Float  # [rad/s] angular velocity of the link BC


class RRRAcceleration(NamedTuple):
    """Second derivatives of an RRR group."""

    a_C: Complex  # [m/s^2] acceleration of the pin C
    epsilon_A: Float  # [rad/s^2] angular acceleration of the link AC
    epsilon_B: Float  # [rad/s^2] angular acceleration of the link BC


class RRRMotion(NamedTuple):
    """First derivatives of an `RRRGroup`, found and given."""

    v_C: Complex  # [m/s] velocity of the pin C
    omega_A: Float  # [rad/s] angular velocity of the link AC
    omega_B: Float  # [rad/s] angular velocity of the link BC
    dr_A: ArrayLike  # [m/s] rate of the length AC, as given
    dr_B: ArrayLike  # [m/s] rate of the length BC, as given


class RRRReactions(NamedTuple):
    """Reactions of a dyad of two links with the pins A, C, B."""

    R_A: Complex  # [N] on the link AC at A, from the body that carries A
    R_B: Complex  # [N] on the link BC at B, from the body that carries B
    R_C: Complex  # [N] on the link AC at C, from the link BC


@elementwise
def rrr(A: ArrayLike, B: ArrayLike, r_A: ArrayLike, r_B: ArrayLike, branch: ArrayLike) -> Complex:
    r"""Pin C of the dyad A-C-B of two links (kind 1).

    .. math:: C = A + (a + i\,h)\,(B - A)/L^2, \quad a = (L^2 + r_A^2 - r_B^2)/2, \quad h = 2 s S, \quad L = |B - A|

    with S the area of the triangle of the sides L, r_A, r_B; zero where one of them is the rounded sum or difference of
    the others, the end of reach, and beyond it by four roundings of the longest and two of the pins. The difference of
    squares is factored. The sum starts from the pin of the shorter link, with the same formula, so that the length of
    each link keeps its digits.

    Parameters
    ----------
    A, B : complex, shape (...)
        Outer pins [m].
    r_A, r_B : float, shape (...)
        Lengths of AC and BC [m].
    branch : {+1, -1}, shape (...)
        s: +1 puts C to the left of the line from A to B.

    Returns
    -------
    complex, shape (...)
        C [m]; NaN where the links do not meet (`rrr_reach` gives the interval in which they do) or A = B.

    Raises
    ------
    ValueError
        A negative or infinite length, a single NaN one, an infinite pin, a branch other than +1 and -1.

    Examples
    --------
    >>> rrr(0, 5, 3, [4, 9], 1)
    array([1.8+2.4j, nan+nanj])
    """
    A, d, L = _outer_pins(A, B)
    r_A, r_B = length(r_A, "length r_A"), length(r_B, "length r_B")
    from_A = r_A <= r_B
    count = np.count_nonzero(from_A)
    if 0 < count < from_A.size:
        P, r, other = np.where(from_A, A, field(B, "B")), np.minimum(r_A, r_B), np.maximum(r_A, r_B)
        half: Float | float = np.where(from_A, 0.5, -0.5)
    else:  # the same without the cost of choosing element by element
        P, r, other, half = (A, r_A, r_B, 0.5) if count else (field(B, "B"), r_B, r_A, -0.5)
    longer, shorter, middle = np.maximum(L, r), np.minimum(L, r), np.minimum(L, other)
    x, y, z = np.maximum(L, other), np.maximum(middle, r), np.minimum(middle, r)
    excess = z - (x - y)
    near = excess <= 2 * _EPS * x
    if np.count_nonzero(near):  # rounding alone parts the links from the line of A and B
        close = meet(x, y, z, np.abs(A) + np.abs(B))
        excess = np.where(flat(x, y, z), 0.0, np.where(close, np.maximum(excess, 0), np.nan))
    # over L: no square of a length leaves the range of floats
    square = ((x + (y + z)) / L) * (excess / L) * ((z + (x - y)) / L) * ((x + (y - z)) / L)
    a = (shorter / L) ** 2 + ((longer - other) / L) * ((longer + other) / L)
    C: Complex = P + product(half * a, sign(branch) / 2 * np.sqrt(square), d)
    return C


@elementwise
def rrr_reach(A: ArrayLike, B: ArrayLike, r_A: ArrayLike) -> Reach:
    r"""Interval of the length r_B for which the dyad A-C-B closes, its ends included.

    .. math:: |L - r_A| \le r_B \le L + r_A, \quad L = |B - A|

    By symmetry ``rrr_reach(B, A, r_B)`` is the interval of r_A.

    Parameters
    ----------
    A, B : complex, shape (...)
        Outer pins [m].
    r_A : float, shape (...)
        Length of AC [m].

    Returns
    -------
    Reach
        least and greatest r_B [m], shape (...).

    Raises
    ------
    ValueError
        A negative or infinite length, a single NaN one, an infinite pin.

    Examples
    --------
    >>> rrr_reach(0, 3, 1)
    Reach(least=np.float64(2.0), greatest=np.float64(4.0))
    """
    _, _, L = _outer_pins(A, B)
    r_A = length(r_A, "length r_A")
    return Reach(np.abs(L - r_A), L + r_A)


@elementwise
def rrr_velocity(
    A: ArrayLike,
    B: ArrayLike,
    C: ArrayLike,
    v_A: ArrayLike = 0.0,
    v_B: ArrayLike = 0.0,
    dr_A: ArrayLike = 0.0,
    dr_B: ArrayLike = 0.0,
) -> RRRVelocity:
    r"""Velocities of the dyad A-C-B.

    .. math:: i(\omega_A a - \omega_B b) = w, \quad a = C - A, \; b = C - B, \quad
              w = v_B + \dot r_B b/|b| - v_A - \dot r_A a/|a|

    .. math:: \omega_A = w \cdot b / (a \times b), \quad \omega_B = w \cdot a / (a \times b)

    Parameters
    ----------
    A, B, C : complex, shape (...)
        Pins [m].
    v_A, v_B : complex, shape (...)
        Velocities of the outer pins [m/s], or their analogues.
    dr_A, dr_B : float, shape (...)
        Rates of the lengths AC and BC [m/s]: the speed of a hydraulic cylinder.

    Returns
    -------
    RRRVelocity
        v_C [m/s], omega_A, omega_B [rad/s]; NaN at a dead centre.

    Raises
    ------
    ValueError
        An infinite argument.

    Examples
    --------
    A cylinder AC that lengthens by 1 m/s turns the leg BC:

    >>> rrr_velocity(0, 4 + 3j, 4, dr_A=1).omega_B
    np.float64(0.3333333333333333)
    """
    a, b, D = _links(A, B, C)
    v_A, v_B = moved(field(v_A, "v_A"), a, dr_A, "dr_A"), moved(field(v_B, "v_B"), b, dr_B, "dr_B")
    omega_A, omega_B = turned(a, b, v_B - v_A, D)
    return RRRVelocity(v_A + 1j * omega_A * a, omega_A, omega_B)


@elementwise
def rrr_acceleration(
    A: ArrayLike,
    B: ArrayLike,
    C: ArrayLike,
    omega_A: ArrayLike,
    omega_B: ArrayLike,
    dr_A: ArrayLike = 0.0,
    dr_B: ArrayLike = 0.0,
    a_A: ArrayLike = 0.0,
    a_B: ArrayLike = 0.0,
    ddr_A: ArrayLike = 0.0,
    ddr_B: ArrayLike = 0.0,
) -> RRRAcceleration:
    r"""Accelerations of the dyad A-C-B.

    .. math:: i(x a - y b) = a_B + k_B b - a_A - k_A a, \quad k = \ddot r/r - \omega^2

    .. math:: \varepsilon_A = x - 2 \omega_A \dot r_A/r_A, \quad \varepsilon_B = y - 2 \omega_B \dot r_B/r_B

    solved as the velocities are.

    Parameters
    ----------
    A, B, C : complex, shape (...)
        Pins [m].
    omega_A, omega_B : float, shape (...)
        Angular velocities of AC and BC [rad/s] from `rrr_velocity`.
    dr_A, dr_B : float, shape (...)
        Rates of the lengths AC and BC [m/s], as given to `rrr_velocity`.
    a_A, a_B : complex, shape (...)
        Accelerations of the outer pins [m/s^2], or their analogues.
    ddr_A, ddr_B : float, shape (...)
        Second derivatives of the lengths AC and BC [m/s^2].

    Returns
    -------
    RRRAcceleration
        a_C [m/s^2], epsilon_A, epsilon_B [rad/s^2]; NaN at a dead centre.

    Raises
    ------
    ValueError
        An infinite argument.

    Examples
    --------
    >>> rrr_acceleration(0, 4 + 3j, 4, 0, 1 / 3, dr_A=1).epsilon_A
    np.float64(0.08333333333333333)
    """
    a, b, D = _links(A, B, C)
    along_A, coriolis_A = carried(a, omega_A, dr_A, ddr_A, "A")
    along_B, coriolis_B = carried(b, omega_B, dr_B, ddr_B, "B")
    a_A, a_B = field(a_A, "a_A") + along_A, field(a_B, "a_B") + along_B
    x, y = turned(a, b, a_B - a_A, D)
    return RRRAcceleration(a_A + 1j * x * a, x - coriolis_A, y - coriolis_B)


@elementwise
def rrr_determinant(A: ArrayLike, B: ArrayLike, C: ArrayLike) -> Float:
    r"""Determinant of the dyad A-C-B; NaN at a dead centre, where it is no larger than rounding of the pins makes it.

    .. math:: D = a \times b, \quad a = C - A, \; b = C - B

    >>> rrr_determinant(0, 5, [4 + 3j, 2])
    array([15., nan])
    """
    *_, D = _links(A, B, C)
    return D


@elementwise
def rrr_transmission_angle(A: ArrayLike, B: ArrayLike, C: ArrayLike) -> Float:
    """Angle between the links at C, in [0, pi] [rad]; 0 and pi are the dead centres, pi/2 is best; shape (...).

    >>> rrr_transmission_angle(0, 4 + 3j, 4)
    np.float64(1.5707963267948966)
    """
    A, B, C = field(A, "A"), field(B, "B"), field(C, "C")
    return turn(lambda a, b, d: _area(a, b, d, cross(a, b), np.abs(a), np.abs(b)), C - A, C - B, B - A)


@elementwise
def rrr_condition(A: ArrayLike, B: ArrayLike, C: ArrayLike) -> Float:
    r"""Condition number of the dyad A-C-B; infinite at a dead centre; shape (...).

    .. math:: \kappa = \frac{|A| + |B| + |a| + |b|}{\min(|a|, |b|) \sin\mu}, \quad a = C - A, \; b = C - B

    >>> rrr_condition(0, 4 + 3j, 4)
    np.float64(4.0)
    """
    a, b, D = _links(A, B, C)
    r_A, r_B = np.abs(a), np.abs(b)
    return condition((np.abs(A) + np.abs(B) + r_A + r_B) * np.maximum(r_A, r_B), D)


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
        R_A, R_B, R_C [N]; NaN at a dead centre.

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
    a, b, D = _links(A, B, C)
    F_A, T_A = resultant(loads_A, field(A, "A"), "loads_A")
    F_B, T_B = resultant(loads_B, field(B, "B"), "loads_B")
    R_C = -(product(T_B / D, 0.0, a) + product(T_A / D, 0.0, b))
    return RRRReactions(-(R_C + F_A), R_C - F_B, R_C)


@dataclass(frozen=True, eq=False)
class RRRGroup:
    """The dyad A-C-B in its positions: each question about it as a function of what is not yet known.

    Arguments, results and errors are those of `rrr` and of the functions named beside it; ``acceleration`` takes the
    first derivatives from ``velocity``, so that no rate is told twice.

    >>> group = RRRGroup(0, 4 + 3j, 4, 3, -1)
    >>> group.C, group.AC, group.BC
    (np.complex128(4+0j), np.complex128(4+0j), np.complex128(-3j))
    >>> velocity = group.velocity(dr_A=1)
    >>> velocity.omega_B, group.acceleration(velocity).epsilon_A
    (np.float64(0.3333333333333333), np.float64(0.08333333333333333))
    >>> group.reactions([Load(-10j, 4)]).R_B
    np.complex128(-0+10j)
    """

    A: ArrayLike  # [m] outer pins
    B: ArrayLike
    r_A: ArrayLike  # [m] lengths of AC and BC
    r_B: ArrayLike
    branch: ArrayLike  # +1 puts C to the left of the line from A to B, -1 to the right
    C: Complex = attribute(init=False)  # [m] inner pin

    def __post_init__(self) -> None:
        object.__setattr__(self, "C", rrr(self.A, self.B, self.r_A, self.r_B, self.branch))

    @property
    def AC(self) -> Complex:
        """Vector of the link next to A [m]."""
        return np.subtract(self.C, self.A)

    @property
    def BC(self) -> Complex:
        """Vector of the link next to B [m]."""
        return np.subtract(self.C, self.B)

    @property
    def reach(self) -> Reach:
        """Interval of r_B in which the dyad closes with this r_A (`rrr_reach`)."""
        return rrr_reach(self.A, self.B, self.r_A)

    @property
    def determinant(self) -> Float:
        """Determinant [m^2], NaN at a dead centre (`rrr_determinant`)."""
        return rrr_determinant(self.A, self.B, self.C)

    @property
    def transmission_angle(self) -> Float:
        """Angle between the links at C [rad] (`rrr_transmission_angle`)."""
        return rrr_transmission_angle(self.A, self.B, self.C)

    @property
    def condition(self) -> Float:
        """Condition number (`rrr_condition`)."""
        return rrr_condition(self.A, self.B, self.C)

    def velocity(
        self, v_A: ArrayLike = 0.0, v_B: ArrayLike = 0.0, dr_A: ArrayLike = 0.0, dr_B: ArrayLike = 0.0
    ) -> RRRMotion:
        """Velocities (`rrr_velocity`)."""
        return RRRMotion(*rrr_velocity(self.A, self.B, self.C, v_A, v_B, dr_A, dr_B), dr_A, dr_B)

    def acceleration(
        self,
        velocity: RRRMotion,
        a_A: ArrayLike = 0.0,
        a_B: ArrayLike = 0.0,
        ddr_A: ArrayLike = 0.0,
        ddr_B: ArrayLike = 0.0,
    ) -> RRRAcceleration:
        """Accelerations (`rrr_acceleration`)."""
        rates = velocity.omega_A, velocity.omega_B, velocity.dr_A, velocity.dr_B
        return rrr_acceleration(self.A, self.B, self.C, *rates, a_A, a_B, ddr_A, ddr_B)

    def reactions(self, loads_A: Sequence[Load] = (), loads_B: Sequence[Load] = ()) -> RRRReactions:
        """Reactions in the pins (`rrr_reactions`)."""
        return rrr_reactions(self.A, self.B, self.C, loads_A, loads_B)


def _outer_pins(A: ArrayLike, B: ArrayLike) -> tuple[Complex, Complex, Float]:
    A = field(A, "A")
    d = field(B, "B") - A
    return A, d, np.abs(d)


def _links(A: ArrayLike, B: ArrayLike, C: ArrayLike) -> tuple[Complex, Complex, Float]:
    """Vectors AC and BC, and the group's determinant."""
    A, B, C = field(A, "A"), field(B, "B"), field(C, "C")
    a, b = C - A, C - B
    D, r_A, r_B = cross(a, b), np.abs(a), np.abs(b)
    if D.ndim:  # one number for all elements, in two thirds of the time
        p, q, far = (np.maximum.reduce(x, axis=None, initial=0.0) for x in (r_A, r_B, np.abs(C)))
        least = np.minimum.reduce(np.abs(D), axis=None, initial=np.inf)
        if least > _THIN * p * q + 2 * ROUNDINGS * (far * (p + q) + p * q):
            return a, b, D
    d = B - A
    size = np.abs(A) * r_B + np.abs(B) * r_A + np.abs(C) * np.abs(d)
    return a, b, determinant(_area(a, b, d, D, r_A, r_B), size)


_THIN = 2.0**-6  # of the greatest: a determinant below is worth a sharper formula


def _area(a: Complex, b: Complex, d: Complex, D: Float, r_A: Float, r_B: Float) -> Float:
    """a x b by the shorter of a and b and their difference d: the rounding of two long links is more than all of it."""
    thin = np.abs(D) <= _THIN * r_A * r_B
    if not np.count_nonzero(thin):
        return D
    return np.where(thin, np.where(r_A <= r_B, cross(d, a), cross(d, b)), D)[()]
