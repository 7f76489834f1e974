"""Assur groups of class II with two prismatic pairs: PRP and RPP. Notation as in `dyads`."""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from mechsheet.mechanics.arguments import Complex, Float, determinant, direction, elementwise, field, scalar_field
from mechsheet.mechanics.planar import angle_between, cross


class SlidersVelocity(NamedTuple):
    """First derivatives of a PRP or RPP group."""

    v_C: Complex  # [m/s] velocity of C
    ds_A: Float  # [m/s] sliding speed along u_A
    ds_B: Float  # [m/s] sliding speed along u_B


class SlidersAcceleration(NamedTuple):
    """Second derivatives of a PRP or RPP group."""

    a_C: Complex  # [m/s^2] acceleration of C
    dds_A: Float  # [m/s^2] second derivative of the sliding distance along u_A
    dds_B: Float  # [m/s^2] second derivative of the sliding distance along u_B


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
    return _crossing(A, B, u_A, u_B)


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
) -> SlidersVelocity:
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
    SlidersVelocity
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
    C, u_A, u_B = field(C, "C"), direction(u_A, "u_A"), direction(u_B, "u_B")
    guide_A = field(v_A, "v_A") + 1j * scalar_field(omega_A, "omega_A") * (C - field(A, "A"))
    guide_B = field(v_B, "v_B") + 1j * scalar_field(omega_B, "omega_B") * (C - field(B, "B"))
    ds_A, ds_B = _along(u_A, u_B, guide_B - guide_A)
    return SlidersVelocity(guide_A + ds_A * u_A, ds_A, -ds_B)


@elementwise
def prp_acceleration(
    A: ArrayLike,
    B: ArrayLike,
    C: ArrayLike,
    u_A: ArrayLike,
    u_B: ArrayLike,
    ds_A: ArrayLike,
    ds_B: ArrayLike,
    a_A: ArrayLike = 0.0,
    a_B: ArrayLike = 0.0,
    omega_A: ArrayLike = 0.0,
    omega_B: ArrayLike = 0.0,
    epsilon_A: ArrayLike = 0.0,
    epsilon_B: ArrayLike = 0.0,
) -> SlidersAcceleration:
    r"""Accelerations of two sliders with the common pin C on guides that may move.

    .. math:: a_C = a_A + (i \varepsilon_A - \omega_A^2)(C - A) + (\ddot s_A + 2 i \omega_A \dot s_A) u_A
              = a_B + (i \varepsilon_B - \omega_B^2)(C - B) + (\ddot s_B + 2 i \omega_B \dot s_B) u_B

    Parameters
    ----------
    A, B, C, u_A, u_B, omega_A, omega_B
        As in `prp_velocity`.
    ds_A, ds_B : float, shape (...)
        Sliding speeds [m/s] from `prp_velocity`.
    a_A, a_B : complex, shape (...)
        Accelerations of the guides' points A and B [m/s^2], or their analogues.
    epsilon_A, epsilon_B : float, shape (...)
        Angular accelerations of the guides [rad/s^2].

    Returns
    -------
    SlidersAcceleration
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
    C, u_A, u_B = field(C, "C"), direction(u_A, "u_A"), direction(u_B, "u_B")
    omega_A, omega_B = scalar_field(omega_A, "omega_A"), scalar_field(omega_B, "omega_B")
    turning_A = 1j * scalar_field(epsilon_A, "epsilon_A") - omega_A**2
    turning_B = 1j * scalar_field(epsilon_B, "epsilon_B") - omega_B**2
    coriolis_A = 2j * omega_A * scalar_field(ds_A, "ds_A") * u_A
    coriolis_B = 2j * omega_B * scalar_field(ds_B, "ds_B") * u_B
    guide_A = field(a_A, "a_A") + turning_A * (C - field(A, "A")) + coriolis_A
    guide_B = field(a_B, "a_B") + turning_B * (C - field(B, "B")) + coriolis_B
    dds_A, dds_B = _along(u_A, u_B, guide_B - guide_A)
    return SlidersAcceleration(guide_A + dds_A * u_A, dds_A, -dds_B)


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
    return 1 / np.abs(cross(direction(u_A, "u_A"), direction(u_B, "u_B")))


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
    return _crossing(A, B, u_A, u_B)


@elementwise
def rpp_velocity(
    A: ArrayLike,
    B: ArrayLike,
    C: ArrayLike,
    u_A: ArrayLike,
    u_B: ArrayLike,
    v_A: ArrayLike,
    v_B: ArrayLike = 0.0,
    omega_B: ArrayLike = 0.0,
) -> SlidersVelocity:
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
    SlidersVelocity
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
    u_A, u_B, B = direction(u_A, "u_A"), direction(u_B, "u_B"), field(B, "B")
    v_B, turning = field(v_B, "v_B"), 1j * scalar_field(omega_B, "omega_B")
    ds_A, ds_B = _along(u_A, u_B, field(v_A, "v_A") - v_B - turning * (field(A, "A") - B))
    return SlidersVelocity(v_B + turning * (field(C, "C") - B) + ds_B * u_B, ds_A, ds_B)


@elementwise
def rpp_acceleration(
    A: ArrayLike,
    B: ArrayLike,
    C: ArrayLike,
    u_A: ArrayLike,
    u_B: ArrayLike,
    ds_A: ArrayLike,
    ds_B: ArrayLike,
    a_A: ArrayLike,
    a_B: ArrayLike = 0.0,
    omega_B: ArrayLike = 0.0,
    epsilon_B: ArrayLike = 0.0,
) -> SlidersAcceleration:
    r"""Accelerations of a slider on a guide that may move, and of the link that slides in its slot.

    .. math:: \ddot s_A u_A + \ddot s_B u_B = a_A - a_B - (i \varepsilon_B - \omega_B^2)(A - B)
              - 2 i \omega_B (\dot s_A u_A + \dot s_B u_B)

    Parameters
    ----------
    A, B, C, u_A, u_B, omega_B
        As in `rpp_velocity`.
    ds_A, ds_B : float, shape (...)
        Sliding speeds [m/s] from `rpp_velocity`.
    a_A, a_B : complex, shape (...)
        Accelerations of A and of the guide's point B [m/s^2], or their analogues.
    epsilon_B : float, shape (...)
        Angular acceleration of the guide [rad/s^2].

    Returns
    -------
    SlidersAcceleration
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
    u_A, u_B, B = direction(u_A, "u_A"), direction(u_B, "u_B"), field(B, "B")
    a_B, omega_B = field(a_B, "a_B"), scalar_field(omega_B, "omega_B")
    turning = 1j * scalar_field(epsilon_B, "epsilon_B") - omega_B**2
    coriolis_A = 2j * omega_B * scalar_field(ds_A, "ds_A") * u_A
    coriolis_B = 2j * omega_B * scalar_field(ds_B, "ds_B") * u_B
    known = a_B + turning * (field(A, "A") - B) + coriolis_A + coriolis_B
    dds_A, dds_B = _along(u_A, u_B, field(a_A, "a_A") - known)
    return SlidersAcceleration(a_B + turning * (field(C, "C") - B) + coriolis_B + dds_B * u_B, dds_A, dds_B)


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
    return 1 / np.abs(cross(direction(u_A, "u_A"), direction(u_B, "u_B")))


def _along(a: Complex, b: Complex, w: Complex) -> tuple[Float, Float]:
    """p, q of p a + q b = w."""
    D = determinant(cross(a, b))
    return cross(w, b) / D, cross(a, w) / D


def _crossing(A: ArrayLike, B: ArrayLike, u_A: ArrayLike, u_B: ArrayLike) -> Complex:
    A, u_A = field(A, "A"), direction(u_A, "u_A")
    along_A, _ = _along(u_A, direction(u_B, "u_B"), field(B, "B") - A)
    return A + along_A * u_A
