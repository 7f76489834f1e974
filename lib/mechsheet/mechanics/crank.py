"""The crank, and the interval of its angle in which the group behind it closes.

A driving cylinder is a link of given length in an RRR group: `rrr_reach` is the interval of that
length, ``dr_A`` of `rrr_velocity` its rate.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from mechsheet.mechanics.arguments import Complex, Float, elementwise, field, length, parameter, unit
from mechsheet.mechanics.planar import angle, cross, near_one


class CrankReach(NamedTuple):
    """Crank angles axis - theta and axis + theta, theta from least to greatest; 0 and pi together are a full turn."""

    axis: Float  # [rad] direction about which the reach is symmetric
    least: Float  # [rad] theta; NaN where the group closes nowhere
    greatest: Float  # [rad] theta; NaN where the group closes nowhere


@elementwise
def crank(O1: ArrayLike, r: ArrayLike, phi: ArrayLike) -> Complex:
    r"""Pin of a crank of length r about the hinge O1 at the angle phi.

    .. math:: A = O_1 + r e^{i \varphi}

    Its motion is `link_velocity` and `link_acceleration` about O1.

    Parameters
    ----------
    O1 : complex, shape (...)
        Hinge [m].
    r, phi : float, shape (...)
        Length [m] and angle [rad].

    Returns
    -------
    complex, shape (...)
        A [m].

    Raises
    ------
    ValueError
        A negative or infinite length, a single NaN one, a NaN or infinite angle, an infinite hinge.

    Examples
    --------
    >>> crank(1, 2, 0)
    np.complex128(3+0j)
    """
    phi = parameter(phi, "angle phi", "rad")
    return field(O1, "O1") + length(r, "length r") * (np.cos(phi) + 1j * np.sin(phi))


@elementwise
def rrr_crank_reach(O1: ArrayLike, B: ArrayLike, r: ArrayLike, r_A: ArrayLike, r_B: ArrayLike) -> CrankReach:
    r"""Angles of a crank whose pin A carries the dyad A-C-B with B fixed.

    .. math:: |r_A - r_B| \le |A - B| \le r_A + r_B, \quad A = O_1 + r e^{i \varphi}

    Parameters
    ----------
    O1, B : complex, shape (...)
        Crank's hinge and the dyad's fixed pin [m].
    r, r_A, r_B : float, shape (...)
        Lengths of the crank, AC and BC [m].

    Returns
    -------
    CrankReach
        axis from O1 to B, least, greatest [rad].

    Raises
    ------
    ValueError
        A negative or infinite length, a single NaN one, an infinite point.

    Examples
    --------
    >>> rrr_crank_reach(0, 5, 4, 1, 2)
    CrankReach(axis=np.float64(0.0), least=np.float64(0.0), greatest=np.float64(0.6435011087932845))
    """
    r_A, r_B = length(r_A, "length r_A"), length(r_B, "length r_B")
    return _between(O1, B, r, np.abs(r_A - r_B), r_A + r_B)


@elementwise
def rpr_crank_reach(O1: ArrayLike, B: ArrayLike, r: ArrayLike, offset: ArrayLike = 0.0) -> CrankReach:
    r"""Angles of a crank whose pin A is the block of a slotted link pinned at B.

    .. math:: |A - B| \ge |e|, \quad A = O_1 + r e^{i \varphi}

    Parameters
    ----------
    O1, B : complex, shape (...)
        Crank's hinge and the slotted link's fixed pin [m].
    r, offset : float, shape (...)
        Length of the crank and offset e of the slot [m].

    Returns
    -------
    CrankReach
        axis from O1 to B, least, greatest [rad].

    Raises
    ------
    ValueError
        A negative or infinite length, a single NaN one, a NaN or infinite offset, an infinite point.

    Examples
    --------
    >>> rpr_crank_reach(0, 5, 4, offset=3)
    CrankReach(axis=np.float64(0.0), least=np.float64(0.6435011087932845), greatest=np.float64(3.141592653589793))
    """
    return _between(O1, B, r, np.abs(parameter(offset, "offset", "m")), np.inf)


@elementwise
def rrp_crank_reach(
    O1: ArrayLike, B: ArrayLike, u: ArrayLike, r: ArrayLike, r_A: ArrayLike, offset: ArrayLike = 0.0
) -> CrankReach:
    r"""Angles of a crank whose pin A carries a link AC with a slider on a fixed guide.

    .. math:: |u \times (A - B) - e| \le r_A, \quad A = O_1 + r e^{i \varphi}

    Parameters
    ----------
    O1, B : complex, shape (...)
        Crank's hinge and a point of the guide [m].
    u : complex, shape (...)
        Direction of the guide, of any length but zero.
    r, r_A : float, shape (...)
        Lengths of the crank and of AC [m].
    offset : float, shape (...)
        e: distance of C's path from the line through B [m], positive to the left of u.

    Returns
    -------
    CrankReach
        axis square to the guide (to its left), least, greatest [rad].

    Raises
    ------
    ValueError
        A negative or infinite length, a single NaN one, a NaN or infinite offset, an infinite point, a zero direction.

    Examples
    --------
    >>> rrp_crank_reach(0, 0, 1, 1, 3).greatest
    np.float64(3.141592653589793)
    """
    u, r = unit(u, "u"), length(r, "length r")
    r_A = length(r_A, "length r_A")
    gap = cross(u, field(O1, "O1") - field(B, "B")) - parameter(offset, "offset", "m")  # of O1 above C's path
    low, high = _half_angle(r_A - gap, r), _half_angle(-r_A - gap, r)
    return _reach(angle(1j * u), low, high, (r_A - gap >= -r) & (-r_A - gap <= r))


def _between(O1: ArrayLike, B: ArrayLike, r: ArrayLike, nearest: Float, farthest: Float | float) -> CrankReach:
    """Angles at which the crank's pin is between two distances from B."""
    r = length(r, "length r")
    frame = field(B, "B") - field(O1, "O1")
    d = np.abs(frame)
    longer, shorter = np.maximum(r, d), np.minimum(r, d)
    unit = near_one(longer)

    def opposite(D: Float | float) -> Float:  # 0 where D is too short for a triangle, pi where too long
        p, q, D = longer * unit, shorter * unit, D * unit
        sine = (D - (p - q)) * (D + (p - q))
        cosine = (q + (p - D)) * (p + q + D)
        return 2 * np.arctan2(np.sqrt(np.maximum(sine, 0)), np.sqrt(np.maximum(cosine, 0)))

    exists = (nearest <= r + d) & (farthest >= longer - shorter)
    return _reach(angle(frame), opposite(nearest), opposite(farthest), exists)


def _half_angle(c: Float, r: Float) -> Float:
    """arccos(c/r) with its digits near 0 and pi kept; 0 where c > r, pi where c < -r."""
    return 2 * np.arctan2(np.sqrt(np.maximum(r - c, 0)), np.sqrt(np.maximum(r + c, 0)))


def _reach(axis: Float, low: Float, high: Float, exists: ArrayLike) -> CrankReach:
    return CrankReach(axis, np.where(exists, low, np.nan)[()], np.where(exists, high, np.nan)[()])
