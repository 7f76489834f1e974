"""Drawings of forces over all positions of a mechanism: groups cut free at one of them, polar diagrams of reactions."""

import ast
import sys
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mechsheet.worksheet import source
from mechsheet.worksheet.drawing import Drawing
from mechsheet.worksheet.lines import registry
from mechsheet.worksheet.title import SideBySide, side_by_side


def largest_of(field: ArrayLike, *others: ArrayLike) -> Any:
    """Largest magnitude of the finite elements, 1 where there is none but zero: what a rounding error is a part of."""
    sizes = np.concatenate([np.ravel(np.abs(each)) for each in (field, *others)])
    return np.max(sizes, initial=0, where=np.isfinite(sizes)) or 1.0


def cut_group(
    drawn: Drawing,
    at: int,
    forces: Mapping[str, Sequence[ArrayLike]],
    points: Sequence[ArrayLike],
    part: float = 0.25,
) -> Drawing:
    """A group cut free: its links and pins, and the forces on it, which keep their scale in all positions.

    Parameters
    ----------
    drawn : Drawing
        Links, pins and masses at the position that is shown; its width and height are the picture's.
    at : int
        Which position that is.
    forces : mapping of name to (P, F) or (P, F, Q)
        Force F [N] at the point P [m], each over the positions or at rest. Q is the other pin of the link that F
        pulls or pushes at the pin P: the arrow then stands on the side of P on which the link does not lie.
    points : sequence of complex
        Pins of the group [m], over the positions or at rest: the picture has room for them all.
    part : float
        Length of the longest arrow of all positions, as a part of the group's size.

    Returns
    -------
    Drawing
        What was ``drawn`` with the forces; as it was where the group closes in no position or has no size.
    """
    ends = np.concatenate([np.ravel(point) for point in points])
    low, high = _corners(ends)
    size = max((high - low).real, (high - low).imag)
    if not size > 0:
        return drawn
    scale = part * size / largest_of(0.0, *(F for _, F, *_ in forces.values()))
    room = [ends]
    for P, F, *other in forces.values():
        room += [np.ravel(P + sign * scale * np.asarray(F)) for sign in ((1, -1) if other else (1,))]
    picture = Drawing(drawn.width, drawn.height, _corners(np.concatenate(room)), {"N": scale}) + drawn
    for name, (P, F, *other) in forces.items():
        p, f, *q = (_at(field, at) for field in (P, F, *other))
        picture = picture.force(p, f, name, into=bool(q) and (np.conj(f) * (q[0] - p)).real > 0)
    return picture


def polar(R: NDArray[np.complex128], at: int, name: str, turn: int = 360, turns: int = 1) -> Drawing:
    """Polar diagram of a force: the path of its end over a cycle, its quarters, and the force at one position.

    Parameters
    ----------
    R : complex, shape (..)
        Force [N], from the beginning of the cycle on.
    at : int
        Position at which it is drawn as an arrow.
    name : str
        Its symbol.
    turn : int
        Positions in a turn.
    turns : int
        Turns in a cycle.
    """
    (low, high), beyond = _corners(np.append(R, 0)), 0.1 * (1 + 1j) * largest_of(R)
    x0, x1, y0, y1 = (low - beyond).real, (high + beyond).real, (low - beyond).imag, (high + beyond).imag
    axes = Drawing(width=320, height=300, unit="N", frame=[x0 + 1j * y0, x1 + 1j * y1])
    picture = axes.path([x0, x1], "x", "").path([1j * y0, 1j * y1], "y", "").path(R)
    for k in range(4):
        picture = picture.hinge(R[k * turn * turns // 4], f"{90 * k * turns}°")
    return picture.force(0j, R[at], name)


def polar_diagrams(at: int, turn: int = 360, **forces: NDArray[np.complex128]) -> SideBySide:
    """Polar diagrams of forces, three in a row, each over what the line says that declares its force.

    ``at`` and ``turn`` are those of `polar`, the forces fields of the worksheet by their symbols: ``R12=R_A``.
    """
    said = meanings()
    drawn = ((polar(R, at, name, turn), said.get(name, "")) for name, R in forces.items())
    return side_by_side(*drawn, row=3)


def meanings() -> dict[str, str]:
    """What lines say that declare the fields given to the call of the caller's caller, by its keywords."""
    frame = sys._getframe(2)
    known = registry(frame.f_globals)
    given = {k.arg: k.value.id for k in source.call(frame).keywords if k.arg and isinstance(k.value, ast.Name)}
    return {name: known[field].meaning for name, field in given.items() if field in known}


def _at(field: ArrayLike, at: int) -> complex:
    z = np.asarray(field, dtype=complex)
    return complex(z[at] if z.ndim else z)


def _corners(z: NDArray[np.complex128]) -> NDArray[np.complex128]:
    """Corners of the box around the finite points; infinite where there is none."""
    x, y, seen = z.real, z.imag, np.isfinite(z)
    low = [np.min(part, initial=np.inf, where=seen) for part in (x, y)]
    high = [np.max(part, initial=-np.inf, where=seen) for part in (x, y)]
    return np.array([low[0] + 1j * low[1], high[0] + 1j * high[1]])
