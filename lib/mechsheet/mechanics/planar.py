"""Planar points as complex numbers: products, angles, triangles, points of a rigid link."""

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mechsheet.mechanics.arguments import (
    Complex,
    Float,
    broadcasting,
    elementwise,
    field,
    reals,
    refusal,
    scalar_field,
    vector,
)

_EPS = 2.0**-52
_LEAST = 2.0**-960  # the parts of a sum of products above it have their digits

__all__ = [
    "Complex",
    "Float",
    "angle",
    "angle_between",
    "angle_opposite",
    "cross",
    "dot",
    "link_acceleration",
    "link_point",
    "link_velocity",
    "product",
    "triangle_area",
]


@broadcasting
def cross(a: ArrayLike, b: ArrayLike) -> Float:
    """Out-of-plane component of a x b, positive where b lies to the left of a; shape (...).

    Written in real products: the fused ones of a complex product do not vanish for parallel vectors.

    >>> cross(1, 2j)
    np.float64(2.0)
    """
    p, q = vector(a, "a"), vector(b, "b")
    return p.real * q.imag - p.imag * q.real


@broadcasting
def dot(a: ArrayLike, b: ArrayLike) -> Float:
    """Scalar product a . b; shape (...).

    >>> dot(3 + 1j, 2)
    np.float64(6.0)
    """
    p, q = vector(a, "a"), vector(b, "b")
    return p.real * q.real + p.imag * q.imag


@broadcasting
def product(p: ArrayLike, q: ArrayLike, z: ArrayLike) -> Complex:
    """(p + iq) z for real p, q; shape (...).

    Written in real products: numpy fuses the complex ones of arrays and not those of single numbers, and a variant
    must give the same alone as among others.

    >>> product(1, 2, 3 + 1j)
    np.complex128(1+7j)
    """
    p, q, z = reals(p, "p"), reals(q, "q"), vector(z, "z")
    x, y = z.real.copy(), z.imag.copy()  # of an array every other number: each pass over them takes twice the time
    found = np.asanyarray(p * x - q * y, np.complex128)
    found.imag = p * y + q * x
    return found[()]


def angle(z: ArrayLike) -> Float:
    """Direction angle of z by the two-argument arctangent, in (-pi, pi] [rad]; shape (...).

    >>> angle([1j, -1])
    array([1.57079633, 3.14159265])
    """
    z = vector(z, "z")
    return np.arctan2(z.imag + 0.0, z.real + 0.0)  # + 0.0: the angle of -1 - 0.0j would be -pi


@broadcasting
def angle_between(a: ArrayLike, b: ArrayLike) -> Float:
    """Angle between two vectors, in [0, pi] [rad], with its digits near 0 and pi kept; shape (...).

    >>> angle_between(1, [1j, -2])
    array([1.57079633, 3.14159265])
    """
    return turn(lambda p, q: cross(p, q), vector(a, "a"), vector(b, "b"))


@np.errstate(over="ignore", invalid="ignore")
def turn(area: Callable[..., Float], a: Complex, b: Complex, *sides: Complex) -> Float:
    """Angle between a and b, of which ``area`` gives the area a x b; vectors of any size."""
    c, d = np.abs(area(a, b, *sides)), dot(a, b)
    size = c + np.abs(d)
    if np.count_nonzero((size > _LEAST) & (size < np.inf)) < size.size:
        unit = near_one(np.maximum(np.abs(a), np.abs(b)))
        c, d = np.abs(area(a * unit, b * unit, *(x * unit for x in sides))), dot(a * unit, b * unit)
    found: Float = np.arctan2(c, d)
    return found


@elementwise
def angle_opposite(a: ArrayLike, b: ArrayLike, c: ArrayLike) -> Float:
    r"""Angle of a triangle opposite its side a, between the sides b and c.

    .. math:: \alpha = 2 \arctan \sqrt{\frac{(a - b + c)(a + b - c)}{(a + b + c)(b + c - a)}}

    The factors are summed in the order that keeps their digits, so that a needle-shaped triangle loses none.

    Parameters
    ----------
    a, b, c : float, shape (...)
        Sides [m], not negative; NaN passes through.

    Returns
    -------
    float, shape (...)
        Angle [rad] in [0, pi]; NaN where the sides make no triangle, or b or c is zero.

    Raises
    ------
    ValueError
        A negative or infinite side.

    References
    ----------
    W. Kahan, Miscalculating Area and Angles of a Needle-like Triangle, 2014.

    Examples
    --------
    >>> angle_opposite([1, 5, 9], 4, [4, 3, 3])
    array([0.25065566, 1.57079633,        nan])
    """
    a, b, c = _side(a, "a"), _side(b, "b"), _side(c, "c")
    b, c = np.maximum(b, c), np.minimum(b, c)
    closes = (c > 0) & meet(a, b, c) & meet(b, a, c)
    unit = near_one(b)
    a, b, c = a * unit, b * unit, c * unit
    over = ((b - c) + a) * np.where(c < a, c - (b - a), a - (b - c))
    under = (b + (c + a)) * ((b - a) + c)
    # where the sides close to rounding, a factor below zero is that
    tangent = np.arctan2(np.sqrt(np.maximum(over, 0)), np.sqrt(np.maximum(under, 0)))
    return np.where(closes, 2 * tangent, np.nan)[()]


@elementwise
@broadcasting
def triangle_area(a: ArrayLike, b: ArrayLike, c: ArrayLike) -> Float:
    r"""Area of a triangle with the sides a, b, c, with the digits of a needle-shaped one kept.

    .. math:: 4 S = \sqrt{(a + b + c)(b + c - a)(a + c - b)(a + b - c)}

    Parameters
    ----------
    a, b, c : float, shape (...)
        Sides [m].

    Returns
    -------
    float, shape (...)
        Area [m^2]; zero where the longest side is the sum of the others, to four roundings; NaN where the sides
        make no triangle.

    References
    ----------
    W. Kahan, Miscalculating Area and Angles of a Needle-like Triangle, 2014.

    Examples
    --------
    >>> triangle_area(3, 4, [5, 7, 8])
    array([ 6.,  0., nan])
    """
    p, q, r = reals(a, "side a"), reals(b, "side b"), reals(c, "side c")
    x, y = np.maximum(p, q), np.minimum(p, q)
    x, z = np.maximum(x, r), np.minimum(x, r)
    y, z = np.maximum(y, z), np.minimum(y, z)
    excess = z - (x - y)
    # where the sides meet to rounding, an excess below zero is that
    excess = np.where(meet(x, y, z), np.maximum(excess, 0), np.nan)
    # two roots: the product of four lengths would leave the range of floats
    area: Float = np.sqrt((x + (y + z)) * excess) * np.sqrt((z + (x - y)) * (x + (y - z))) / 4
    return area


@elementwise
def link_point(A: ArrayLike, B: ArrayLike, z: ArrayLike) -> Complex:
    """Point of the link AB with the link's own coordinates z: origin in A, real axis towards B.

    .. math:: P = A + z (B - A) / |B - A|

    Parameters
    ----------
    A, B : complex, shape (...)
        Points of the link [m].
    z : complex, shape (...)
        Coordinates in the link [m].

    Returns
    -------
    complex, shape (...)
        P [m]; NaN where A = B.

    Examples
    --------
    >>> link_point(1, 1 + 2j, 3 + 1j)
    np.complex128(3j)
    """
    A = field(A, "A")
    d, z = field(B, "B") - A, field(z, "z")
    size = np.abs(d)
    return A + product(z.real / size, z.imag / size, d)


@broadcasting
def link_velocity(P: ArrayLike, A: ArrayLike, omega: ArrayLike, v_A: ArrayLike = 0.0) -> Complex:
    r"""Velocity of the point P of a link that turns with omega, A being another point of it.

    .. math:: v_P = v_A + i \omega (P - A)

    Parameters
    ----------
    P, A : complex, shape (...)
        Points of the link [m].
    omega : float, shape (...)
        Angular velocity of the link [rad/s], or its analogue.
    v_A : complex, shape (...)
        Velocity of A [m/s], or its analogue; A rests where it is left out.

    Returns
    -------
    complex, shape (...)
        v_P [m/s].

    Examples
    --------
    >>> link_velocity(2j, 0, 3, 1)
    np.complex128(-5+0j)
    """
    return field(v_A, "v_A") + 1j * scalar_field(omega, "omega") * (field(P, "P") - field(A, "A"))


@broadcasting
def link_acceleration(
    P: ArrayLike, A: ArrayLike, omega: ArrayLike, epsilon: ArrayLike = 0.0, a_A: ArrayLike = 0.0
) -> Complex:
    r"""Acceleration of the point P of a link, A being another point of it.

    .. math:: a_P = a_A + (i \varepsilon - \omega^2)(P - A)

    Parameters
    ----------
    P, A : complex, shape (...)
        Points of the link [m].
    omega : float, shape (...)
        Angular velocity of the link [rad/s], or its analogue.
    epsilon : float, shape (...)
        Angular acceleration of the link [rad/s^2], or its analogue.
    a_A : complex, shape (...)
        Acceleration of A [m/s^2], or its analogue; A rests where it is left out.

    Returns
    -------
    complex, shape (...)
        a_P [m/s^2].

    Examples
    --------
    >>> link_acceleration(2, 0, 3, 4, a_A=1)
    np.complex128(-17+8j)
    """
    turning = 1j * scalar_field(epsilon, "epsilon") - scalar_field(omega, "omega") ** 2
    return field(a_A, "a_A") + turning * (field(P, "P") - field(A, "A"))


def near_one(length: Float) -> Float:
    """A power of two that brings a length near 1: to multiply by it rounds nothing, and no square leaves the floats."""
    found: Float = np.ldexp(1.0, np.clip(-np.frexp(length)[1], -1000, 1000))
    return found


def meet(x: Float, y: Float, z: Float | float, far: Float | float = 0.0) -> NDArray[np.bool_]:
    """x is at most y + z, or more by four roundings, as decimal lengths are: 0.8 is more than 0.1 + 0.7.

    And by two of what they are taken from, of the size ``far``.
    """
    return (x - y) - z <= _EPS * (2 * x + far)


def flat(x: Float, y: Float, z: Float) -> NDArray[np.bool_]:
    """x is y + z, where any one of the three is the rounded sum or difference of the others."""
    found: NDArray[np.bool_] = (x == y + z) | (x - y == z) | (x - z == y)
    return found


def _side(value: ArrayLike, name: str) -> Float:
    x = scalar_field(value, name)
    if (x < 0).any():
        raise refusal(x[x < 0], f"side {name}", "m", "must not be negative")
    return x
