"""Equilibrium of all bodies of a mechanism: what given reactions leave, and the reactions from one linear system.

Independent of the groups and of the order in which they are taken: it proves their results.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from mechsheet.mechanics.arguments import Complex, Float, shape_error
from mechsheet.mechanics.load import Load
from mechsheet.mechanics.planar import cross, dot


@dataclass(frozen=True)
class PinReaction:
    """Force in a pin, on one body from another; bodies are numbered from 1, 0 is the frame."""

    on: int
    by: int
    P: ArrayLike  # [m] the pin
    F: ArrayLike  # [N] on the body ``on``
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
    P: ArrayLike  # [m] point to which they belong
    F: ArrayLike  # [N] on the body ``on``, square to the slide
    M: ArrayLike  # [N m] on the body ``on``, about P
    u: ArrayLike  # [-] direction of the slide, of length 1

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
    by: int = 0
    P: ArrayLike = 0.0
    F: ArrayLike = 0.0

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


def solve_reactions(loads: Sequence[Sequence[Load]], reactions: Sequence[Reaction]) -> Float:
    """Magnitudes of all reactions at once, from three equations of equilibrium for each body.

    Parameters
    ----------
    loads : sequence of sequences of Load
        Loads on the bodies 1, 2, ...
    reactions : sequence of PinReaction, SlideReaction, DriveMoment
        Where reactions act; what they are is not looked at.

    Returns
    -------
    float, shape (..., unknowns)
        As `magnitudes` lists them; NaN where the system has no solution.

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
    columns = [(r, _wrench(F, M, r.P)) for r, F, M in units]
    known = [sum(_wrench(load.F, load.M, load.P) for load in of_body) for of_body in loads]
    shape = np.broadcast_shapes(*(np.shape(c)[:-1] for _, c in columns), *(np.shape(k)[:-1] for k in known))
    system, right = np.zeros((*shape, size + 3, size)), np.zeros((*shape, size + 3, 1))
    for j, (r, column) in enumerate(columns):
        system[..., 3 * r.by : 3 * r.by + 3, j] -= column
        system[..., 3 * r.on : 3 * r.on + 3, j] += column
    for body, of_body in enumerate(known, start=1):
        right[..., 3 * body : 3 * body + 3, 0] = -of_body
    system, right = system[..., 3:, :], right[..., 3:, :]  # the frame, body 0, needs no equilibrium
    system[np.linalg.det(system) == 0] = np.nan
    found: Float = np.linalg.solve(system, right)[..., 0]
    return found


def magnitudes(reactions: Sequence[Reaction]) -> Float:
    """Magnitudes of given reactions in the order in which `solve_reactions` finds them, shape (..., unknowns)."""
    if error := shape_error({"reactions": reactions}):
        raise error
    return np.stack(np.broadcast_arrays(*(m for r in reactions for m in r.magnitudes)), axis=-1)


def _wrench(F: ArrayLike, M: ArrayLike, P: ArrayLike) -> Float:
    """Force and its moment about the origin, as three components along the last axis."""
    return np.stack(np.broadcast_arrays(np.real(F), np.imag(F), np.asarray(M) + cross(P, F)), axis=-1)


def _numbered(loads: Sequence[Sequence[Load]], reactions: Sequence[Reaction]) -> None:
    for body, of_body in enumerate(loads, start=1):
        if not of_body:
            raise ValueError(f"body {body} has no load; a zero one tells its pole")
    for r in reactions:
        if not (0 <= r.on <= len(loads) and 0 <= r.by <= len(loads)):
            raise ValueError(f"reaction on the body {r.on} by the body {r.by}: there are bodies 0..{len(loads)}")
    if error := shape_error({"loads": loads, "reactions": reactions}):
        raise error
