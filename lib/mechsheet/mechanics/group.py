r"""Assur groups of class II: what they have in common, and the notation of their files.

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

Arguments stand in one order: points, directions, lengths and branch, first derivatives, second derivatives, loads.
Derivatives that are not given are zero.

All arguments broadcast. NaN marks an element that does not exist: a group that does not close, or derivatives and
reactions at a dead centre, where the group's determinant is zero. NaN points and motions pass through, so that
groups follow one another, and so do NaN lengths in an array, which a Find gives where it has no solution. A single
length that is NaN, infinite lengths, infinite points and branches other than +1 and -1 raise ValueError.

A condition number is an upper bound of the relative change of a link's vector over the relative changes of
coordinates, lengths and directions that cause it: no more than about log10(condition) digits of a position are lost,
and twice as many of a velocity computed from that position. It grows towards a dead centre, with the spread of the
links' lengths, and with the distance of the group from the origin.

Reactions are found from the last group to the first: those of one are loads of the groups before it, with the
opposite sign. Friction is left out.

======================  ============================================================================================
``R_A``                 force on the link next to A, from the body that carries A (the source's R_12)
``R_B``                 force on the link next to B, from the body that carries B (R_43)
``R_C``                 force on the link next to A, from the link next to B (R_32); the opposite acts on the other
``M_X``                 moment of the reaction of the prismatic pair X, acting on the same link as R_X
``h_X``                 distance along the slide at which the single force R_X does the same (h_32)
======================  ============================================================================================

Source of the reactions: I. G. Shebanov, Dynamic synthesis and analysis of aircraft mechanisms: force analysis (in
Ukrainian), Kharkiv, KhAI, 2003, sections 1.1 to 1.4; derived anew.
"""

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from mechsheet.mechanics.arguments import Complex, Float, scalar_field
from mechsheet.mechanics.planar import cross

Points = tuple[Complex, ...]
_ROUNDING = 2.0**-52  # how far a rounded coordinate may be off, relative: twice the error of one rounding


class Reach(NamedTuple):
    """Interval of a length in which a group closes, its ends included; NaN where there is none."""

    least: Float  # [m]
    greatest: Float  # [m]


def solve(a: Complex, b: Complex, w: Complex, D: Float) -> tuple[Float, Float]:
    """x, y of x a + y b = w, for the `determinant` D = a x b."""
    return cross(w, b) / D, cross(a, w) / D


def determinant(a: Complex, b: Complex, points_a: Points, points_b: Points) -> Float:
    """a x b for vectors between the given points; NaN at a dead centre, where it is no larger than their rounding.

    A difference of two rounded points is off by their rounding: below that nothing is left of derivatives and
    reactions, whose condition is at least that of the determinant. A vector without points is a unit vector, rounded.
    """
    if not (a.ndim or b.ndim):  # numpy's own numbers take ten times as long for it as Python's
        p, q = complex(a), complex(b)
        one = p.real * q.imag - p.imag * q.real
        off = _uncertain(p, q, tuple(map(complex, points_a)), tuple(map(complex, points_b)))
        return np.asarray(one if abs(one) > off else np.nan)[()]
    D = cross(a, b)
    size = np.abs(D)
    if np.minimum.reduce(size, axis=None, initial=np.inf) > 4 * _ROUNDING * _greatest(points_a) * _greatest(points_b):
        return D  # one number for all elements, in a third of the time
    return np.where(size <= _uncertain(a, b, points_a, points_b), np.nan, D)


def moved(v: Complex, a: Complex, dr: ArrayLike, name: str) -> Complex:
    """Velocity of the end of the vector a of a link whose start moves by v, without its angular velocity's part."""
    dr = scalar_field(dr, name)
    return v + a * (dr / np.abs(a)) if dr.ndim or dr else v


def carried(a: Complex, omega: ArrayLike, dr: ArrayLike, ddr: ArrayLike, end: str) -> Complex:
    """Second derivative of the vector a of a link, without its angular acceleration's part."""
    omega = scalar_field(omega, f"omega_{end}")
    dr, ddr = scalar_field(dr, f"dr_{end}"), scalar_field(ddr, f"ddr_{end}")
    rigid = -(omega**2) * a
    if dr.ndim or ddr.ndim or dr or ddr:
        return rigid + a * ((ddr + 2j * omega * dr) / np.abs(a))
    return rigid


def _uncertain(a: Any, b: Any, points_a: tuple[Any, ...], points_b: tuple[Any, ...]) -> Any:
    """How far a x b may be off."""
    points_a, points_b = points_a or (a,), points_b or (b,)
    x_a, y_a = sum(abs(P.real) for P in points_a), sum(abs(P.imag) for P in points_a)
    x_b, y_b = sum(abs(P.real) for P in points_b), sum(abs(P.imag) for P in points_b)
    return _ROUNDING * ((x_a * abs(b.imag) + y_a * abs(b.real)) + (x_b * abs(a.imag) + y_b * abs(a.real)))


def _greatest(points: Points) -> float:
    """Bound of the coordinates of a vector between the points, whichever element; NaN where one of them is."""
    if not points:
        return 1.0
    sizes = [np.abs(P) for P in points]
    return sum(float(np.maximum.reduce(x, axis=None, initial=0.0) if x.ndim else x) for x in sizes)
