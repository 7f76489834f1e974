r"""Assur groups of class II: positions, velocities, accelerations, transmission angles, condition numbers.

A group is two links joined by the inner pair C; its outer pairs A and B hang on bodies whose motion is known.
R is a pin, P a prismatic pair.

========  =====  ==========================================================================================
group     kind   links
========  =====  ==========================================================================================
``rrr``   1      links AC and BC joined by the pin C; a driving cylinder is a link of given length
``rrp``   2      link AC joined by the pin C to a slider on a guide through B
``rpr``   3      block or rod pinned at A, sliding in a slotted link or cylinder pinned at B
``prp``   4      two sliders joined by the pin C, on guides through A and B
``rpp``   5      link pinned at A, sliding in the slot of a slider on a guide through B
========  =====  ==========================================================================================

Points, directions u, velocities v and accelerations a are complex, angles count counter-clockwise. ``omega_A``
and ``epsilon_A`` belong to the link next to A, ``omega_B`` and ``epsilon_B`` to the link next to B; ``dr`` and
``ds`` are first, ``ddr`` and ``dds`` second derivatives of a length and of a sliding distance. Everything is
linear in the derivatives and knows nothing of time: derivatives with respect to a coordinate S of the driver give
the analogues d/dS and d^2/dS^2 from the same functions.

All arguments broadcast. NaN marks an element that does not exist: a group that does not close, or derivatives and
reactions at a dead centre, where the group's determinant is zero. NaN points and motions pass through, so that
groups follow one another, and so do NaN lengths in an array, which a Find gives where it has no solution. A single
length that is NaN, infinite lengths, infinite points and branches other than +1 and -1 raise ValueError.

A condition number is an upper bound of the relative change of a link's vector over the relative changes of
coordinates, lengths and directions that cause it: no more than about log10(condition) digits of a position are lost,
and twice as many of a velocity computed from that position. It grows towards a dead centre, with the spread of the
links' lengths, and with the distance of the group from the origin.
"""

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
    length,
    parameter,
    scalar_field,
    sign,
)
from mechsheet.mechanics.planar import angle_between, cross, dot, product, sorted_area

_ROUNDING = 2.0**-53  # relative error of one rounding


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


class RPR(NamedTuple):
    """Position of an RPR group."""

    u: Complex  # unit vector of the slide
    s: Float  # [m] distance of A along u from the perpendicular through B


class RPRVelocity(NamedTuple):
    """First derivatives of an RPR group."""

    omega: Float  # [rad/s] angular velocity of both links
    ds: Float  # [m/s] sliding speed of A's link along u, relative to B's


class RPRAcceleration(NamedTuple):
    """Second derivatives of an RPR group."""

    epsilon: Float  # [rad/s^2] angular acceleration of both links
    dds: Float  # [m/s^2] second derivative of the sliding distance


@elementwise
def rrr(A: ArrayLike, B: ArrayLike, r_A: ArrayLike, r_B: ArrayLike, branch: ArrayLike) -> Complex:
    r"""Pin C of the dyad A-C-B of two links (kind 1).

    .. math:: C = A + (a + i\,h)\,(B - A)/L^2, \quad a = (L^2 + r_A^2 - r_B^2)/2, \quad h = 2 s S, \quad L = |B - A|

    with S the area of the triangle of the sides L, r_A, r_B. The difference of squares is factored. The sum starts from
    the pin of the shorter link, with the same formula, so that the length of each link keeps its digits.

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
    h = 2 * sign(branch) * sorted_area(np.maximum(L, r_A), np.minimum(L, r_A), r_B)
    from_A = r_A <= r_B
    count = np.count_nonzero(from_A)
    if 0 < count < from_A.size:
        P, r, other = np.where(from_A, A, field(B, "B")), np.minimum(r_A, r_B), np.maximum(r_A, r_B)
        way: ArrayLike = np.where(from_A, 1.0, -1.0)
    else:  # the same without the cost of choosing element by element
        P, r, other, way = (A, r_A, r_B, 1.0) if count else (field(B, "B"), r_B, r_A, -1.0)
    longer = np.maximum(L, r)
    a = (np.minimum(L, r) ** 2 + (longer - other) * (longer + other)) / 2
    square = L**2
    C: Complex = P + product(way * a / square, h / square, d)
    return C


@elementwise
def rrr_reach(A: ArrayLike, B: ArrayLike, r_A: ArrayLike) -> tuple[Float, Float]:
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
    tuple of float, shape (...)
        Least and greatest r_B [m].

    Raises
    ------
    ValueError
        A negative or infinite length, a single NaN one, an infinite pin.

    Examples
    --------
    >>> rrr_reach(0, 3, 1)
    (np.float64(2.0), np.float64(4.0))
    """
    _, _, L = _outer_pins(A, B)
    r_A = length(r_A, "length r_A")
    return np.abs(L - r_A), L + r_A


@elementwise
def rrr_velocity(
    A: ArrayLike,
    B: ArrayLike,
    C: ArrayLike,
    v_A: ArrayLike,
    v_B: ArrayLike,
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

    >>> rrr_velocity(0, 4 + 3j, 4, 0, 0, dr_A=1).omega_B
    np.float64(0.3333333333333333)
    """
    a, b = _links(A, B, C)
    v_A, v_B = _moved(field(v_A, "v_A"), a, dr_A, "dr_A"), _moved(field(v_B, "v_B"), b, dr_B, "dr_B")
    omega_A, omega_B = _turning(a, b, v_B - v_A, rrr_determinant(A, B, C))
    return RRRVelocity(v_A + 1j * omega_A * a, omega_A, omega_B)


@elementwise
def rrr_acceleration(
    A: ArrayLike,
    B: ArrayLike,
    C: ArrayLike,
    omega_A: ArrayLike,
    omega_B: ArrayLike,
    a_A: ArrayLike,
    a_B: ArrayLike,
    dr_A: ArrayLike = 0.0,
    dr_B: ArrayLike = 0.0,
    ddr_A: ArrayLike = 0.0,
    ddr_B: ArrayLike = 0.0,
) -> RRRAcceleration:
    r"""Accelerations of the dyad A-C-B.

    .. math:: i(\varepsilon_A a - \varepsilon_B b) = a_B + k_B b - a_A - k_A a, \quad
              k = (\ddot r + 2 i \omega \dot r)/r - \omega^2

    solved as the velocities are.

    Parameters
    ----------
    A, B, C : complex, shape (...)
        Pins [m].
    omega_A, omega_B : float, shape (...)
        Angular velocities of AC and BC [rad/s] from `rrr_velocity`.
    a_A, a_B : complex, shape (...)
        Accelerations of the outer pins [m/s^2], or their analogues.
    dr_A, dr_B, ddr_A, ddr_B : float, shape (...)
        First [m/s] and second [m/s^2] derivatives of the lengths AC and BC.

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
    >>> rrr_acceleration(0, 4 + 3j, 4, 0, 1 / 3, 0, 0, dr_A=1).epsilon_A
    np.float64(0.08333333333333333)
    """
    a, b = _links(A, B, C)
    a_A = field(a_A, "a_A") + _carried(a, omega_A, dr_A, ddr_A, "A")
    a_B = field(a_B, "a_B") + _carried(b, omega_B, dr_B, ddr_B, "B")
    epsilon_A, epsilon_B = _turning(a, b, a_B - a_A, rrr_determinant(A, B, C))
    return RRRAcceleration(a_A + 1j * epsilon_A * a, epsilon_A, epsilon_B)


def rrr_determinant(A: ArrayLike, B: ArrayLike, C: ArrayLike) -> Float:
    r"""Determinant of the dyad A-C-B; NaN at a dead centre, where it is no larger than rounding of the pins makes it.

    .. math:: D = a \times b, \quad a = C - A, \; b = C - B

    A difference of two rounded pins is off by their rounding: below that nothing is left of derivatives and
    reactions, whose condition is at least that of D.

    >>> rrr_determinant(0, 5, [4 + 3j, 2])
    array([15., nan])
    """
    A, B, C = field(A, "A"), field(B, "B"), field(C, "C")
    a, b = C - A, C - B
    D = cross(a, b)
    off_A, off_B = _rounded(A) + _rounded(C), _rounded(B) + _rounded(C)
    rounding = _product(off_A, b) + _product(off_B, a)
    return np.where(np.abs(D) <= rounding, np.nan, D)[()]


@elementwise
def rrr_transmission_angle(A: ArrayLike, B: ArrayLike, C: ArrayLike) -> Float:
    """Angle between the links at C, in [0, pi] [rad]; 0 and pi are the dead centres, pi/2 is best; shape (...).

    >>> rrr_transmission_angle(0, 4 + 3j, 4)
    np.float64(1.5707963267948966)
    """
    return angle_between(*_links(A, B, C))


@elementwise
def rrr_condition(A: ArrayLike, B: ArrayLike, C: ArrayLike) -> Float:
    r"""Condition number of the dyad A-C-B; infinite at a dead centre; shape (...).

    .. math:: \kappa = \frac{|A| + |B| + |a| + |b|}{\min(|a|, |b|) \sin\mu}, \quad a = C - A, \; b = C - B

    >>> rrr_condition(0, 4 + 3j, 4)
    np.float64(4.0)
    """
    a, b = _links(A, B, C)
    r_A, r_B = np.abs(a), np.abs(b)
    size: Float = np.abs(A) + np.abs(B) + r_A + r_B
    return size * np.maximum(r_A, r_B) / np.abs(cross(a, b))


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
        C [m]; NaN where the link does not reach the guide (`rrp_reach`).

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
    A, u = field(A, "A"), direction(u, "u")
    h = cross(u, A - field(B, "B")) - parameter(offset, "offset", "m")
    r_A = length(r_A, "length r_A")
    ahead = np.sqrt((r_A - np.abs(h)) * (r_A + np.abs(h)))
    return A + product(sign(branch) * ahead, -h, u)


@elementwise
def rrp_reach(A: ArrayLike, B: ArrayLike, u: ArrayLike, offset: ArrayLike = 0.0) -> tuple[Float, Float]:
    r"""Interval of the length r_A for which the link AC reaches the guide: from the distance of A, without end.

    Parameters
    ----------
    A, B, u, offset
        As in `rrp`.

    Returns
    -------
    tuple of float, shape (...)
        Least r_A [m], which closes, and infinity.

    Raises
    ------
    ValueError
        As in `rrp`.

    Examples
    --------
    >>> rrp_reach(3j, 0, 1, offset=1)
    (np.float64(2.0), np.float64(inf))
    """
    h = cross(direction(u, "u"), field(A, "A") - field(B, "B")) - parameter(offset, "offset", "m")
    return np.abs(h), np.where(np.isnan(h), np.nan, np.inf)[()]


@elementwise
def rrp_velocity(
    A: ArrayLike,
    B: ArrayLike,
    C: ArrayLike,
    u: ArrayLike,
    v_A: ArrayLike,
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
    (a, arm), u = _links(A, B, C), direction(u, "u")
    guide = field(v_B, "v_B") + 1j * scalar_field(omega_B, "omega_B") * arm
    omega_A, ds = _sliding(a, u, guide - _moved(field(v_A, "v_A"), a, dr_A, "dr_A"))
    return RRPVelocity(guide + ds * u, omega_A, ds)


@elementwise
def rrp_acceleration(
    A: ArrayLike,
    B: ArrayLike,
    C: ArrayLike,
    u: ArrayLike,
    omega_A: ArrayLike,
    ds: ArrayLike,
    a_A: ArrayLike,
    a_B: ArrayLike = 0.0,
    omega_B: ArrayLike = 0.0,
    epsilon_B: ArrayLike = 0.0,
    dr_A: ArrayLike = 0.0,
    ddr_A: ArrayLike = 0.0,
) -> RRPAcceleration:
    r"""Accelerations of a link AC and its slider C on a guide that may move.

    .. math:: i \varepsilon_A a - \ddot s u = a_B + (i \varepsilon_B - \omega_B^2)(C - B)
              + 2 i \omega_B \dot s u - a_A - k_A a

    with k as in `rrr_acceleration`, solved as the velocities are.

    Parameters
    ----------
    A, B, C, u
        As in `rrp_velocity`.
    omega_A, ds : float, shape (...)
        Angular velocity of AC [rad/s] and speed of the slider [m/s] from `rrp_velocity`.
    a_A, a_B : complex, shape (...)
        Accelerations of A and of the guide's point B [m/s^2], or their analogues.
    omega_B, epsilon_B : float, shape (...)
        Angular velocity [rad/s] and acceleration [rad/s^2] of the guide.
    dr_A, ddr_A : float, shape (...)
        First [m/s] and second [m/s^2] derivatives of the length AC.

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
    >>> rrp_acceleration(3j, 0, 4, 1, -0.25, -0.75, 0).dds
    np.float64(-0.390625)
    """
    (a, arm), u = _links(A, B, C), direction(u, "u")
    omega_B = scalar_field(omega_B, "omega_B")
    turning = 1j * scalar_field(epsilon_B, "epsilon_B") - omega_B**2
    guide = field(a_B, "a_B") + turning * arm + 2j * omega_B * scalar_field(ds, "ds") * u
    epsilon_A, dds = _sliding(a, u, guide - field(a_A, "a_A") - _carried(a, omega_A, dr_A, ddr_A, "A"))
    return RRPAcceleration(guide + dds * u, epsilon_A, dds)


@elementwise
def rrp_transmission_angle(A: ArrayLike, C: ArrayLike, u: ArrayLike) -> Float:
    """Angle between the link AC and the guide's normal, in [0, pi] [rad]; dead centres at 0 and pi; shape (...).

    >>> rrp_transmission_angle(1j, 1, 1)
    np.float64(2.356194490192345)
    """
    return angle_between(_link(A, C), 1j * direction(u, "u"))


@elementwise
def rrp_condition(A: ArrayLike, B: ArrayLike, C: ArrayLike, u: ArrayLike) -> Float:
    r"""Condition number of a link AC with a slider; infinite at a dead centre; shape (...).

    .. math:: \kappa = \frac{|A| + |B| + |a| + |C - B|}{|a| \sin\mu}, \quad a = C - A

    >>> rrp_condition(3j, 0, 4, 1)
    np.float64(3.0)
    """
    a, guide = _links(A, B, C)
    size: Float = np.abs(A) + np.abs(B) + np.abs(a) + np.abs(guide)
    return size / np.abs(dot(a, direction(u, "u")))


@elementwise
def rpr(A: ArrayLike, B: ArrayLike, branch: ArrayLike, offset: ArrayLike = 0.0) -> RPR:
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
    RPR
        u and s [m]; NaN where A is nearer to B than the offset; no direction where A = B.

    Raises
    ------
    ValueError
        A NaN or infinite offset, an infinite pin, a branch other than +1 and -1.

    Examples
    --------
    >>> rpr(2j, 0, 1)
    RPR(u=np.complex128(1j), s=np.float64(2.0))
    """
    d = field(A, "A") - field(B, "B")
    L, e = np.abs(d), parameter(offset, "offset", "m")
    s = sign(branch) * np.sqrt((L - e) * (L + e))
    return RPR(d / (s + 1j * e), s)


@elementwise
def rpr_velocity(A: ArrayLike, B: ArrayLike, u: ArrayLike, v_A: ArrayLike, v_B: ArrayLike = 0.0) -> RPRVelocity:
    r"""Angular velocity and sliding speed of a slotted link or passive cylinder.

    .. math:: \bar u (v_A - v_B) = \dot s + i \omega (s + i e), \quad s + i e = \bar u (A - B)

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
        omega [rad/s], ds [m/s]; NaN where A - B is square to the slide.

    Raises
    ------
    ValueError
        An infinite argument, a zero direction.

    Examples
    --------
    >>> rpr_velocity(2j, 0, 1j, v_A=3 + 1j)
    RPRVelocity(omega=np.float64(-1.5), ds=np.float64(1.0))
    """
    d, u = field(A, "A") - field(B, "B"), direction(u, "u")
    return RPRVelocity(*_swinging(d, u, field(v_A, "v_A") - field(v_B, "v_B")))


@elementwise
def rpr_acceleration(
    A: ArrayLike,
    B: ArrayLike,
    u: ArrayLike,
    omega: ArrayLike,
    ds: ArrayLike,
    a_A: ArrayLike,
    a_B: ArrayLike = 0.0,
) -> RPRAcceleration:
    r"""Angular acceleration and second derivative of the sliding distance of a slotted link or passive cylinder.

    .. math:: \bar u (a_A - a_B) = \ddot s + 2 i \omega \dot s + (i \varepsilon - \omega^2)(s + i e)

    Parameters
    ----------
    A, B, u
        As in `rpr_velocity`.
    omega, ds : float, shape (...)
        Angular velocity [rad/s] and sliding speed [m/s] from `rpr_velocity`.
    a_A, a_B : complex, shape (...)
        Accelerations of the pins [m/s^2], or their analogues.

    Returns
    -------
    RPRAcceleration
        epsilon [rad/s^2], dds [m/s^2]; NaN where A - B is square to the slide.

    Raises
    ------
    ValueError
        An infinite argument, a zero direction.

    Examples
    --------
    >>> rpr_acceleration(2j, 0, 1j, -1.5, 1, a_A=0)
    RPRAcceleration(epsilon=np.float64(1.5), dds=np.float64(4.5))
    """
    d, u = field(A, "A") - field(B, "B"), direction(u, "u")
    omega = scalar_field(omega, "omega")
    known = 2j * omega * scalar_field(ds, "ds") * u - omega**2 * d
    return RPRAcceleration(*_swinging(d, u, field(a_A, "a_A") - field(a_B, "a_B") - known))


@elementwise
def rpr_transmission_angle(A: ArrayLike, B: ArrayLike, u: ArrayLike) -> Float:
    """Angle between BA and the slide's normal, in [0, pi] [rad]; pi/2 where the offset is zero; shape (...).

    >>> rpr_transmission_angle(2j, 0, 1j)
    np.float64(1.5707963267948966)
    """
    return angle_between(field(A, "A") - field(B, "B"), 1j * direction(u, "u"))


@elementwise
def rpr_condition(A: ArrayLike, B: ArrayLike, u: ArrayLike) -> Float:
    r"""Condition number of a slotted link or passive cylinder; infinite where A - B is square to u; shape (...).

    .. math:: \kappa = \frac{|A| + |B| + |A - B|}{|A - B| \sin\mu}

    >>> rpr_condition(2j, 0, 1j)
    np.float64(2.0)
    """
    d = field(A, "A") - field(B, "B")
    size: Float = np.abs(A) + np.abs(B) + np.abs(d)
    return size / np.abs(dot(d, direction(u, "u")))


def _rounded(P: Complex) -> Complex:
    """How far the coordinates of a rounded point may be off."""
    return 2 * _ROUNDING * (np.abs(P.real) + 1j * np.abs(P.imag))


def _product(off: Complex, a: Complex) -> Float:
    """How far a x b may be off where b is."""
    return off.real * np.abs(a.imag) + off.imag * np.abs(a.real)


def _turning(a: Complex, b: Complex, w: Complex, D: Float) -> tuple[Float, Float]:
    """p, q of i (p a - q b) = w, for the determinant D = a x b."""
    return dot(w, b) / D, dot(w, a) / D


def _sliding(a: Complex, u: Complex, w: Complex) -> tuple[Float, Float]:
    """p, q of i p a - q u = w."""
    D = determinant(dot(a, u))
    return cross(u, w) / D, -dot(w, a) / D


def _swinging(d: Complex, u: Complex, w: Complex) -> tuple[Float, Float]:
    """p, q of i p d + q u = w, for a unit vector u."""
    p = cross(u, w) / determinant(dot(u, d))
    return p, dot(u, w) + p * cross(u, d)


def _moved(v: Complex, a: Complex, dr: ArrayLike, name: str) -> Complex:
    """Velocity of the end of the vector a of a link whose start moves by v, without its angular velocity's part."""
    dr = scalar_field(dr, name)
    return v + a * (dr / np.abs(a)) if dr.ndim or dr else v


def _carried(a: Complex, omega: ArrayLike, dr: ArrayLike, ddr: ArrayLike, end: str) -> Complex:
    """Second derivative of the vector a of a link, without its angular acceleration's part."""
    omega = scalar_field(omega, f"omega_{end}")
    dr, ddr = scalar_field(dr, f"dr_{end}"), scalar_field(ddr, f"ddr_{end}")
    rigid = -(omega**2) * a
    if dr.ndim or ddr.ndim or dr or ddr:
        return rigid + a * ((ddr + 2j * omega * dr) / np.abs(a))
    return rigid


def _outer_pins(A: ArrayLike, B: ArrayLike) -> tuple[Complex, Complex, Float]:
    A = field(A, "A")
    d = field(B, "B") - A
    return A, d, np.abs(d)


def _link(A: ArrayLike, C: ArrayLike) -> Complex:
    return field(C, "C") - field(A, "A")


def _links(A: ArrayLike, B: ArrayLike, C: ArrayLike) -> tuple[Complex, Complex]:
    C = field(C, "C")
    return C - field(A, "A"), C - field(B, "B")
