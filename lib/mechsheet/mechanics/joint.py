r"""Joints of compartments under bending and axial force: neutral axis, stresses, forces in elements and bolts.

A normal force N is positive in tension, a moment M where it pulls the side of positive y. Both act on the line
y = 0 of the joint, or on the centre of the ring.

Source: industry standard OST 92-9236-79, appendices 1 to 3, in Russian; derived anew, since the scan has lost formulas.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mechsheet.mechanics.arguments import Float, elementwise, not_negative, parameter, reals

__all__ = ["Bending", "Ring", "Section", "bending", "circular_joint", "neutral_axis", "sum_of_elements"]

Text = NDArray[np.str_]


class Bending(NamedTuple):
    """A joint whose elements all keep their areas; shapes (...), NaN where the areas lie on one level."""

    sigma: Float  # [Pa] stress of the plane section at the elements, shape (..., n)
    F: Float  # [m^2] area
    S: Float  # [m^3] first moment of area about y = 0
    y_c: Float  # [m] centroid
    I_c: Float  # [m^4] second moment of area about the centroid
    M_c: Float  # [N m] moment about the centroid
    y_0: Float  # [m] neutral axis; infinite where the stress is the same everywhere


class Section(NamedTuple):
    """A joint in equilibrium; shapes (...), NaN where there is no equilibrium."""

    sigma: Float  # [Pa] stress of the plane section at the elements, shape (..., n)
    force: Float  # [N] force in the elements, shape (..., n)
    area: Float  # [m^2] area of the elements that acts, shape (..., n)
    y_0: Float  # [m] neutral axis; infinite where the stress is the same everywhere, NaN without load
    state: Text  # "tension and compression", "all in tension", "all in compression", "no load", "no equilibrium"


class Ring(NamedTuple):
    """A circular joint in equilibrium; shapes (...), NaN where there is no equilibrium of this kind."""

    P: Float  # [N] tension of the bolts, shape (..., m)
    p_0: Float  # [N/m] line load where the ring is compressed most, negative; 0 where all bolts pull
    R: Float  # [N] resultant of the line load, negative
    M_R: Float  # [N m] moment of the line load
    M_x: Float  # [N m] moment of the bolts about the axis in the plane of the load; 0 for symmetrical bolts
    c: Float  # [-] force parameter; infinite where M = 0, NaN without load
    y_0: Float  # [m] neutral axis; infinite where M = 0, NaN without load
    phi_0: Float  # [rad] half of the pulled arc: 0 where all is compressed, pi where all is pulled
    state: Text  # as in `Section`, or "no bolt in tension", "bolt in compression", "ring in tension"


@elementwise
@np.errstate(over="ignore")  # a neutral axis beyond all floats is infinite
def bending(y: ArrayLike, A: ArrayLike, M: ArrayLike, N: ArrayLike) -> Bending:
    r"""Stresses of a plane section made of elements with given areas.

    .. math:: \sigma = \frac{N}{F} + \frac{(M - N y_c)(y - y_c)}{I_c}, \quad y_0 = y_c - \frac{N I_c}{F (M - N y_c)}

    Where these two cancel, nearer to the neutral axis than to the centroid, levels are counted from the axis: the
    stress there is nothing but what its rounding leaves, so that every element has the digits of its own condition.

    Parameters
    ----------
    y, A : float, shape (..., n)
        Level of each element [m], and its area [m^2], not negative.
    M, N : float, shape (...)
        Moment about y = 0 [N m] and normal force [N].

    Returns
    -------
    Bending

    Raises
    ------
    ValueError
        A negative area, NaN, infinity, or shapes that do not broadcast.
    """
    y, A = np.broadcast_arrays(_row(y, "level y", "m"), not_negative(A, "area A", "m^2"))
    M, N = parameter(M, "moment M", "N m"), parameter(N, "normal force N", "N")
    unit_y, unit_A = _power_of_two(y), _power_of_two(A)  # no square of a length leaves the range of floats
    y, A, M = y / unit_y[..., None], A / unit_A[..., None], M / unit_y
    largest = np.take_along_axis(y, A.argmax(-1)[..., None], -1)  # levels from here: one level gives I_c = 0 exactly
    F = A.sum(-1)
    lever = y - largest
    lever = lever - (A * lever).sum(-1, keepdims=True) / F[..., None]
    S = sum_of_elements(A * y)
    y_c = S / F
    second = (A * lever**2).sum(-1)
    I_c = np.where(second > 0, second, np.nan)
    M_c = M - N * y_c
    y_0 = y_c - N / M_c * (I_c / F)
    t, moments = y - y_0[..., None], A * (M[..., None] - N[..., None] * y)
    slope, axis = moments.sum(-1) / (F * I_c), (moments * t).sum(-1) / (F * I_c)
    uniform = (N / F)[..., None] + (M_c / I_c)[..., None] * lever
    nearer = t * (2 / (y_0 - y_c))[..., None] > -1  # to the axis than to the centroid
    sigma = np.where(nearer, slope[..., None] * t - axis[..., None], uniform)
    F, S, I_c = F * unit_A, S * unit_A * unit_y, I_c * unit_A * unit_y * unit_y
    section = np.broadcast_arrays(F, S, y_c * unit_y, I_c, M_c * unit_y, y_0 * unit_y)
    return Bending(sigma / unit_A[..., None], *section)


def sum_of_elements(x: ArrayLike) -> Float:
    """Sum over the elements, the last axis, as if computed with twice the digits; shape (...).

    Nothing is left over where the terms of a symmetrical section cancel: its centroid is on its axis.

    Source: T. Ogita, S. M. Rump, S. Oishi, Accurate Sum and Dot Product, 2005, algorithm Sum2.

    >>> sum_of_elements([0.1, 0.2, 0.3, -0.1, -0.2, -0.3])
    np.float64(0.0)
    """
    x = reals(x, "x")
    if not x.ndim:
        raise ValueError(f"x = {x} must be a row of elements")
    s, lost = np.zeros(x.shape[:-1]), 0.0
    for term in np.moveaxis(x, -1, 0):
        before, s = s, s + term
        part = s - before
        lost = lost + ((before - (s - part)) + (term - part))
    return s + np.where(np.isfinite(s), lost, 0.0)


@elementwise
def neutral_axis(y: ArrayLike, A_t: ArrayLike, A_c: ArrayLike, M: ArrayLike, N: ArrayLike) -> Section:
    r"""Equilibrium of elements that have one area in tension and another in compression.

    The stress is linear over the section, :math:`\sigma = a + b y`. Its energy
    :math:`\tfrac12 \sum A_i \sigma_i^2` is convex in (a, b), and its gradient is (N, M): where there is an
    equilibrium, its forces are the only ones. No iteration is needed to find it. While the neutral axis rises from
    below the section to above it, and once more with the signs exchanged, the load (N, M) turns once, always to the
    left; it passes 2 n rays, each of which puts the axis on the level of an element. Between two neighbouring rays
    no element changes its area, so the rays beside the given load tell which areas act, and one linear problem
    remains. There is no equilibrium where the load lies in a gap that the rays leave, such as tension on elements
    that carry compression only.

    Parameters
    ----------
    y : float, shape (..., n)
        Levels of the elements [m].
    A_t, A_c : float, shape (..., n)
        Their areas where stretched and where compressed [m^2], not negative.
    M, N : float, shape (...)
        Moment about y = 0 [N m] and normal force [N].

    Returns
    -------
    Section
        NaN where no equilibrium exists, or what would carry the load lies on one level.

    Raises
    ------
    ValueError
        A negative area, NaN, infinity, or shapes that do not broadcast.
    """
    y, A_t, A_c = np.broadcast_arrays(
        _row(y, "level y", "m"),
        not_negative(A_t, "area in tension A_t", "m^2"),
        not_negative(A_c, "area in compression A_c", "m^2"),
    )
    M, N = np.broadcast_arrays(parameter(M, "moment M", "N m"), parameter(N, "normal force N", "N"))
    unit_y, unit_A = _power_of_two(y), _power_of_two(np.maximum(A_t, A_c))
    y, A_t, A_c, M = y / unit_y[..., None], A_t / unit_A[..., None], A_c / unit_A[..., None], M / unit_y
    elements, level = y[..., None, :], np.sort(y)[..., None]
    apart = np.diff(level[..., 0], append=np.inf) > 0
    above = elements > level
    tension = np.concatenate([above, ~above], axis=-2)  # (..., 2 n rays, n elements)
    A = np.where(tension, A_t[..., None, :], A_c[..., None, :])
    force = A * np.concatenate([elements - level, level - elements], axis=-2)
    ray_N, ray_M = force.sum(-1), (force * elements).sum(-1)
    to_left = ray_N * M[..., None] - ray_M * N[..., None]
    carries = A > 0  # a section has two levels
    spread = np.where(carries, elements, -np.inf).max(-1) > np.where(carries, elements, np.inf).min(-1)
    between = spread & np.concatenate([apart, apart], -1) & (to_left >= 0) & (np.roll(to_left, -1, -1) <= 0)
    ray, exists = between.argmax(-1), between.any(-1)
    A = np.broadcast_to(A, (*ray.shape, *A.shape[-2:]))
    area = np.where(exists[..., None], np.take_along_axis(A, ray[..., None, None], -2)[..., 0, :], 0.0)
    result = bending(y, area, M, N)
    sigma = result.sigma
    pulled, pressed = (sigma > 0).any(-1), (sigma < 0).any(-1)
    state = np.select(
        [np.isnan(result.I_c), pulled & pressed, pulled, pressed],
        ["no equilibrium", "tension and compression", "all in tension", "all in compression"],
        "no load",
    )
    in_m2 = unit_A[..., None]
    return Section(sigma / in_m2, sigma * area, (area + 0 * sigma) * in_m2, result.y_0 * unit_y, state)


# Gauss's places and weights on -1..1, exact to rounding for an arc up to the whole circle. They stand here with all
# their digits: numpy's weights are off by up to 63 roundings.
_HALF_NODES = (
    0.09501250983763744, 0.2816035507792589, 0.45801677765722737, 0.6178762444026438,
    0.755404408355003, 0.8656312023878318, 0.9445750230732326, 0.9894009349916499,
)  # fmt: skip
_HALF_WEIGHTS = (
    0.1894506104550685, 0.18260341504492358, 0.16915651939500254, 0.14959598881657674,
    0.12462897125553388, 0.09515851168249279, 0.062253523938647894, 0.027152459411754096,
)  # fmt: skip
NODES = np.array([*(-x for x in reversed(_HALF_NODES)), *_HALF_NODES])
WEIGHTS = np.array([*reversed(_HALF_WEIGHTS), *_HALF_WEIGHTS])


@elementwise
@np.errstate(over="ignore")  # a neutral axis beyond all floats is infinite
def circular_joint(r: ArrayLike, phi: ArrayLike, M: ArrayLike, N: ArrayLike) -> Ring:
    r"""Circular joint: bolts carry the tension, contact of the rims the compression.

    A uniform ring would carry the line load :math:`q = (M \cos\varphi + N r / 2) / \pi r^2`, proportional to
    :math:`\cos\varphi + c` with :math:`c = N r / 2 M`. Bolts where q > 0 carry forces :math:`P_k = k_t q(\varphi_k)`,
    the rim where q < 0 the line load :math:`p = k_c q`, and equilibrium of forces and moments gives k_t and k_c:

    .. math::

        \sum P_k + \int p\, r\, d\varphi = N, \quad
        \sum P_k r \cos\varphi_k + \int p\, r^2 \cos\varphi\, d\varphi = M

    The determinant of these two equations is positive as soon as one bolt is stretched. Where :math:`|c| \ge 1` there
    is one kind only: the whole rim with p = q, or the bolts alone, with forces linear in :math:`\cos\varphi`.

    Bolts at uneven angles are solved approximately, as in the source: c is that of a uniform ring, M_x is left over.

    Parameters
    ----------
    r : float, shape (...)
        Radius of the joint [m], positive.
    phi : float, shape (..., m)
        Angles of the bolts from the plane of the load [rad].
    M, N : float, shape (...)
        Moment [N m] and normal force [N].

    Returns
    -------
    Ring
        NaN where uneven bolts leave no equilibrium of this kind; ``state`` says why.

    Raises
    ------
    ValueError
        A radius that is not positive, NaN, infinity, or shapes that do not broadcast.
    """
    phi, r = _row(phi, "angle phi", "rad"), not_negative(r, "radius r", "m")
    if not r.all():
        raise ValueError("radius r = 0 m must be positive")
    r, M, N = np.broadcast_arrays(r, parameter(M, "moment M", "N m"), parameter(N, "normal force N", "N"))
    # From here on forces are in units of load / r, moments in units of load, line loads of load / 2 pi r^2.
    load = 2 * np.abs(M) + np.abs(N) * r
    unit = np.where(load > 0, load, 1.0)
    bend, axial, side = 2 * np.abs(M) / unit, N * r / unit, np.where(M < 0, -1.0, 1.0)
    u = side[..., None] * np.cos(phi)  # 1 where the joint is stretched most
    stretched = np.maximum(axial[..., None] + bend[..., None] * u, 0)
    bolt_N, bolt_M = stretched.sum(-1), (stretched * u).sum(-1)

    # Half of the compressed arc, cos alpha = c; theta runs over the arc from its middle.
    alpha = 2 * np.arctan2(np.sqrt(np.maximum(bend - axial, 0)), np.sqrt(np.maximum(bend + axial, 0)))
    theta = alpha[..., None] * NODES
    below = np.sin((alpha[..., None] + theta) / 2) * np.sin((alpha[..., None] - theta) / 2)
    pressed = np.minimum(bend + axial, 0)[..., None] - 2 * bend[..., None] * below
    arc = pressed * WEIGHTS * alpha[..., None] / (2 * np.pi)
    arc_N, arc_M = arc.sum(-1), -(arc * np.cos(theta)).sum(-1)

    mixed, rim = (alpha > 0) & (alpha < np.pi), alpha == np.pi
    determinant = bolt_N * arc_M - bolt_M * arc_N
    sine = np.sqrt(np.maximum((bend - axial) * (bend + axial), 0))  # of alpha, times bend
    k_t = sine**3 / (2 * np.pi * bend * determinant)  # (axial arc_M - bend arc_N / 2) / determinant, not cancelled
    k_c = np.where(mixed, (bend * bolt_N / 2 - axial * bolt_M) / determinant, 1.0)
    alone = bending(u, np.ones_like(u), bend / 2, axial).sigma
    bolts = np.where(mixed[..., None], k_t[..., None] * stretched, np.where(rim[..., None], 0.0, alone))

    rounding = phi.shape[-1] * np.finfo(float).eps
    failures = {
        "no bolt in tension": mixed & (bolt_N == 0),
        "ring in tension": mixed & (k_c * arc_N > rounding),
        "bolt in compression": ~mixed & ~rim & ~(bolts.min(-1) >= -rounding),
    }
    kinds = {"tension and compression": mixed, "all in compression": rim, "no load": load == 0}
    states = failures | kinds
    lost = np.where(np.any([*failures.values()], axis=0), np.nan, 0.0)
    P = bolts * (unit / r)[..., None] + lost[..., None]
    c = side * axial / bend + lost
    return Ring(
        P=P,
        p_0=k_c * np.where(alpha > 0, axial - bend, 0.0) * unit / (2 * np.pi * r**2) + lost,
        R=k_c * arc_N * unit / r + lost,
        M_R=side * k_c * arc_M * unit + lost,
        M_x=r * (P * np.sin(phi)).sum(-1),
        c=c,
        y_0=-c * r,
        phi_0=np.pi - alpha + lost,
        state=np.select([*states.values()], [*states], "all in tension"),
    )


def _power_of_two(x: Float) -> Float:
    """A power of two beside the greatest of each row: to divide by it rounds nothing."""
    found: Float = np.ldexp(1.0, np.frexp(np.abs(x).max(-1))[1] - 1)
    return found


def _row(value: ArrayLike, name: str, unit: str) -> Float:
    """Numbers with an axis of elements."""
    x = parameter(value, name, unit)
    if not x.ndim or not x.shape[-1]:
        raise ValueError(f"{name} = {x} {unit} must be a row of elements")
    return x
