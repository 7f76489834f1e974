"""Equilibrium of all bodies of a mechanism: what given reactions leave, and the reactions from one linear system.

Independent of the groups and of the order in which they are taken: it proves their results.
"""

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import reduce
from itertools import chain
from typing import Any, ClassVar, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mechsheet.mechanics.arguments import Complex, Float, broadcasting
from mechsheet.mechanics.group import ROUNDINGS
from mechsheet.mechanics.load import Load
from mechsheet.mechanics.planar import cross, dot


@dataclass(frozen=True)
class PinReaction:
    """Force in a pin, on one body from another; bodies are numbered from 1, 0 is the frame."""

    on: int
    by: int
    F: ArrayLike  # [N] on the body ``on``
    P: ArrayLike  # [m] the pin
    M: ArrayLike = 0.0  # [N m] a pin passes none on

    @property
    def units(self) -> tuple[tuple[ArrayLike, ArrayLike], ...]:
        """Force and moment for the magnitude 1 of each unknown."""
        return (1, 0), (1j, 0)

    @property
    def magnitudes(self) -> tuple[ArrayLike, ...]:
        """The unknowns: components x and y [N]."""
        return np.real(self.F), np.imag(self.F)


@dataclass(frozen=True)
class SlideReaction:
    """Force and moment in a prismatic pair, on one body from another."""

    on: int
    by: int
    F: ArrayLike  # [N] on the body ``on``, square to the slide
    P: ArrayLike  # [m] point to which they belong
    u: ArrayLike  # [-] direction of the slide, of length 1
    M: ArrayLike = 0.0  # [N m] on the body ``on``, about P

    @property
    def units(self) -> tuple[tuple[ArrayLike, ArrayLike], ...]:
        """Force and moment for the magnitude 1 of each unknown."""
        return (1j * np.asarray(self.u), 0), (0, 1)

    @property
    def magnitudes(self) -> tuple[ArrayLike, ...]:
        """The unknowns: force to the left of u [N] and moment [N m]."""
        return dot(self.F, 1j * np.asarray(self.u)), self.M


@dataclass(frozen=True)
class DriveMoment:
    """Moment that drives a body, from the frame."""

    on: int
    M: ArrayLike  # [N m]
    by: ClassVar[int] = 0
    F: ClassVar[ArrayLike] = 0.0
    P: ClassVar[ArrayLike] = 0.0

    @property
    def units(self) -> tuple[tuple[ArrayLike, ArrayLike], ...]:
        """Force and moment for the magnitude 1 of the unknown."""
        return ((0, 1),)

    @property
    def magnitudes(self) -> tuple[ArrayLike, ...]:
        """The unknown: the moment [N m]."""
        return (self.M,)


Reaction = PinReaction | SlideReaction | DriveMoment


class Left(NamedTuple):
    """What is left over on each body, zero in equilibrium; bodies along the first axis."""

    F: Complex  # [N] sum of the forces
    M: Float  # [N m] sum of the moments about the point of the body's first load


@broadcasting
def left_over(loads: Sequence[Sequence[Load]], reactions: Sequence[Reaction]) -> Left:
    """Sums of the forces and of the moments on each body, loads and reactions together.

    Parameters
    ----------
    loads : sequence of sequences of Load
        Loads on the bodies 1, 2, ..; each has one at least, whose point is the body's pole.
    reactions : sequence of PinReaction, SlideReaction, DriveMoment
        Reactions in all pairs, and the drive.

    Returns
    -------
    Left
        F [N], M [N m], shape (bodies, ...).

    Raises
    ------
    ValueError
        A body without a load, a reaction on or by a body that has none, shapes that do not broadcast.
    """
    _numbered(loads, reactions)
    forces, moments = [], []
    for body, of_body in enumerate(loads, start=1):
        acting = [(1, load.P, load.F, load.M) for load in of_body]
        acting += [(1, r.P, r.F, r.M) for r in reactions if r.on == body]
        acting += [(-1, r.P, r.F, r.M) for r in reactions if r.by == body]
        pole = np.asarray(of_body[0].P)
        forces.append(sum(sign * np.asarray(F) for sign, _, F, _ in acting))
        moments.append(sum(sign * (cross(np.asarray(P) - pole, F) + np.asarray(M)) for sign, P, F, M in acting))
    return Left(np.array(np.broadcast_arrays(*forces)), np.array(np.broadcast_arrays(*moments)))


@broadcasting
def solve_reactions(loads: Sequence[Sequence[Load]], reactions: Sequence[Reaction]) -> Float:
    """Magnitudes of all reactions at once, from three equations of equilibrium for each body.

    Parameters
    ----------
    loads : sequence of sequences of Load
        Loads on the bodies 1, 2, ..; each has one at least.
    reactions : sequence of PinReaction, SlideReaction, DriveMoment
        Where reactions act; what they are is not looked at.

    Returns
    -------
    float, shape (..., unknowns)
        As `magnitudes` lists them; NaN where the bodies can move, to rounding of the points, or a number is NaN.

    Raises
    ------
    ValueError
        More or fewer unknowns than equations, a body without a load, a reaction on or by a body that has none, shapes
        that do not broadcast.
    """
    _numbered(loads, reactions)
    size = 3 * len(loads)
    units = [(r, F, M) for r in reactions for F, M in r.units]
    if len(units) != size:
        raise ValueError(f"{len(units)} unknown reactions for {size} equations of equilibrium")
    # moments about a pair of each body and over its longest arm: neither origin nor size of the bodies count
    frames = [_frame(body, of_body, reactions) for body, of_body in enumerate(loads, start=1)]
    scales = [frames[max(r.on, r.by) - 1].arm if not np.any(F) else np.ones(()) for r, F, _ in units]
    directions = [(np.multiply(F, 1), np.multiply(M, scale)) for (_, F, M), scale in zip(units, scales, strict=True)]
    points = (x for load in chain.from_iterable(loads) for x in (load.F, load.P, load.M))
    shape = np.broadcast_shapes(
        *map(np.shape, points), *(F.shape for F, _ in directions), *(f.arm.shape for f in frames)
    )
    system, right = np.zeros((*shape, size, size)), np.zeros((*shape, size, 1))
    for j, ((r, *_), (F, M)) in enumerate(zip(units, directions, strict=True)):
        for body, way in ((r.on, 1), (r.by, -1)):
            if body:  # the frame of the mechanism, body 0, needs no equilibrium
                _add(system[..., 3 * body - 3 : 3 * body, j], way * F, way * M, r.P, frames[body - 1])
    for body, of_body in enumerate(loads):
        for load in of_body:
            F, M = np.negative(load.F), np.negative(load.M)
            _add(right[..., 3 * body : 3 * body + 3, 0], F, M, load.P, frames[body])
    inverse = _inverse(system, reduce(np.maximum, (f.away for f in frames)))
    found = inverse @ right
    found += inverse @ (right - system @ found)  # small reactions keep their digits beside large ones
    result: Float = found[..., 0] * np.stack(np.broadcast_arrays(*scales), axis=-1)
    return result


@broadcasting
def magnitudes(reactions: Sequence[Reaction]) -> Float:
    """Magnitudes of given reactions in the order in which `solve_reactions` finds them, shape (..., unknowns)."""
    return np.stack(np.broadcast_arrays(*(m for r in reactions for m in r.magnitudes)), axis=-1)


class _Frame(NamedTuple):
    """From where the moments on a body count."""

    pole: Complex  # [m]
    arm: Float  # [m] longest distance of a pair from the pole
    away: Float  # [-] distance from the origin, in arms


def _frame(body: int, of_body: Sequence[Load], reactions: Sequence[Reaction]) -> _Frame:
    pairs = [r.P for r in reactions if body in (r.on, r.by) and not isinstance(r, DriveMoment)]
    pole, *points = (np.asarray(P) for P in (pairs or [of_body[0].P]))
    arm = reduce(np.maximum, (np.abs(P - pole) for P in points), np.zeros(()))
    away = np.abs(pole) / np.where(arm == 0, np.inf, arm)  # one pair alone may be anywhere
    return _Frame(pole, np.where(arm == 0, 1.0, arm), away)


def _add(of_body: Float, F: ArrayLike, M: ArrayLike, P: ArrayLike, frame: _Frame) -> None:
    """Add a force and its moment about the pole, over the arm, to the three components along the last axis."""
    of_body[..., 0] += np.real(F)
    of_body[..., 1] += np.imag(F)
    of_body[..., 2] += (np.asarray(M) + cross(np.asarray(P) - frame.pole, F)) / frame.arm


def _inverse(system: Float, away: Float) -> Float:
    """Inverse; NaN where rounding of the points, which lie so many arms from the origin, can leave bodies that move."""
    one = np.eye(system.shape[-1])
    lost = np.asarray(~np.isfinite(system).all((-2, -1)))
    system = np.where(lost[..., None, None], one, system)
    doubtful = np.ones_like(lost)
    with suppress(np.linalg.LinAlgError):  # one is singular to its last digit
        inverse = np.linalg.inv(system)
        # the least singular value is more than one over the size of the inverse, and takes longer to find
        doubtful = ~(ROUNDINGS * (_size(system) + away) * _size(inverse) < 1)
    if np.any(doubtful):
        s = np.linalg.svdvals(system[doubtful])
        lost[doubtful] |= s[..., -1] <= ROUNDINGS * (s[..., 0] + np.broadcast_to(away, lost.shape)[doubtful])
        inverse = np.linalg.inv(np.where(lost[..., None, None], one, system))
    return np.where(lost[..., None, None], np.nan, inverse)


def _size(matrix: NDArray[Any]) -> Float:
    """Frobenius norm: no less than the greatest singular value."""
    size: Float = np.linalg.norm(matrix, axis=(-2, -1))
    return size


def _numbered(loads: Sequence[Sequence[Load]], reactions: Sequence[Reaction]) -> None:
    if not (isinstance(loads, list | tuple) and loads and all(isinstance(of_body, list | tuple) for of_body in loads)):
        raise ValueError(f"loads = {loads!r} must be a sequence of the loads of each body")
    if not (isinstance(reactions, list | tuple) and all(hasattr(r, "units") for r in reactions)):
        raise ValueError(f"reactions = {reactions!r} must be a sequence of reactions")
    for body, of_body in enumerate(loads, start=1):
        if not of_body:
            raise ValueError(f"body {body} has no load; a zero one tells its pole")
    for r in reactions:
        if not (0 <= r.on <= len(loads) and 0 <= r.by <= len(loads)):
            raise ValueError(f"reaction on the body {r.on} by the body {r.by}: there are bodies 0..{len(loads)}")
