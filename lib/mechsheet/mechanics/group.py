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
reactions at a dead centre, where the group's determinant is zero or so small that eight roundings of the points and
directions can make it zero. NaN points and motions pass through, so that groups follow one another, and so do NaN
lengths in an array, which a Find gives where it has no solution. A single length that is NaN, infinite lengths,
infinite points and branches other than +1 and -1 raise ValueError. Lengths and directions may be of any size from
1e-150 to 1e150.

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

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from mechsheet.mechanics.arguments import Complex, Float, scalar_field
from mechsheet.mechanics.planar import cross, dot, meet

ROUNDINGS = 8 * 2.0**-53  # a determinant that eight roundings make zero has no digit that can be trusted


class Reach(NamedTuple):
    """Interval of a length in which a group closes, ends included: infinite without an end, NaN if it never does."""

    least: Float  # [m]
    greatest: Float  # [m]


def within(x: Float, most: Float, *of: Complex | Float) -> Float:
    """x; ``most`` in size where it is more by rounding alone, as in `meet`, its own and that of what it is made of."""
    size = np.abs(x)
    if not np.count_nonzero(size > most):
        return x
    return np.where(meet(size, most, 0.0, sum(map(np.abs, of))), np.clip(x, -most, most), x)


def endless(known: Complex | Float) -> Reach:
    """Every length, where what does not depend on it is ``known``; NaN where that is."""
    end = np.where(np.isnan(known), np.nan, np.inf)[()]
    return Reach(-end, end)


def solve(a: Complex, b: Complex, w: Complex, D: Float) -> tuple[Float, Float]:
    """x, y of x a + y b = w, for the determinant D = a x b."""
    return cross(w, b) / D, cross(a, w) / D


def crossing(A: Complex, B: Complex, u_A: Complex, u_B: Complex, D: Float) -> Complex:
    """Where the lines through A along u_A and through B along u_B meet, counted from the nearer one."""
    along_A, along_B = solve(u_A, u_B, B - A, D)
    return np.where(np.abs(along_A) < np.abs(along_B), A + along_A * u_A, B - along_B * u_B)[()]


def turned(a: Complex, b: Complex, w: Complex, D: Float) -> tuple[Float, Float]:
    """x, y of i (x a - y b) = w, for the determinant D = a x b."""
    return dot(w, b) / D, dot(w, a) / D


def slid(a: Complex, u: Complex, w: Complex, D: Float) -> tuple[Float, Float]:
    """x, y of i x a + y u = w, for the determinant D = a . u."""
    return cross(u, w) / D, dot(w, a) / D


def determinant(D: Float, size: Float) -> Float:
    """D; NaN at a dead centre. One rounding of what D is made of changes it by 2**-53 ``size`` at most."""
    lost = np.abs(D) <= ROUNDINGS * size
    return np.where(lost, np.nan, D)[()] if np.count_nonzero(lost) else D


def condition(size: Float, D: Float) -> Float:
    """size / |D|; infinite at a dead centre, where the `determinant` D is NaN."""
    kappa: Float = size / np.abs(D)
    lost = np.isnan(D)
    return np.where(lost & ~np.isnan(size), np.inf, kappa)[()] if np.count_nonzero(lost) else kappa


def moved(v: Complex, a: Complex, dr: ArrayLike, name: str) -> Complex:
    """Velocity of the end of the vector a of a link whose start moves by v, without its angular velocity's part."""
    dr = scalar_field(dr, name)
    return v + a * (dr / np.abs(a)) if dr.ndim or dr else v


def carried(a: Complex, omega: ArrayLike, dr: ArrayLike, ddr: ArrayLike, end: str) -> tuple[Complex, Float]:
    """Second derivative of the vector a of a link along a, and the angular acceleration that its Coriolis part is like.

    That part is square to a as the angular acceleration's is, so that it counts in that alone.
    """
    omega = scalar_field(omega, f"omega_{end}")
    dr, ddr = scalar_field(dr, f"dr_{end}"), scalar_field(ddr, f"ddr_{end}")
    if dr.ndim or ddr.ndim or dr or ddr:
        r = np.abs(a)
        return ((ddr + 0 * dr) / r - omega**2) * a, 2 * omega * dr / r  # 0 dr: its shape and its NaN count everywhere
    return -(omega**2) * a, _NONE


_NONE = np.zeros(())
