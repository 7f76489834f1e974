"""Planar mechanisms to be drawn to scale, as values: points are complex numbers in metres, y up."""

from cmath import isfinite
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from math import hypot, inf, isnan, nan, pi

import numpy as np
from numpy.typing import ArrayLike

from mechsheet.worksheet import numbers
from mechsheet.worksheet.errors import SheetError, as_given
from mechsheet.worksheet.shown import Shown

# Legible on white and on black; "" is the colour of the text round the drawing.
COLOURS = ("blue", "red", "green", "orange")

MARGIN = 42.0  # round the outermost points, for symbols and labels [px]
FAR = 1e5  # an element with a point beyond this is not drawn [px]
_FIXED = ("support", "text", "ground", "guide", "dimension")  # kinds that do not move


@dataclass(frozen=True, eq=False)
class Element:
    """One element of a drawing: its kind, its points [m], its name, and what it tells under the pointer.

    An arrow has one point and a ``vector`` in ``unit``, which ends in the point where it goes ``into`` it. ``value`` is
    the angle of a slider or a support [rad], a moment, or how far the line of a dimension lies beside it [px].
    """

    kind: str
    points: tuple[complex, ...]
    name: str = ""
    tip: str = ""
    value: float = 0.0
    vector: complex | None = None
    unit: str = ""
    into: bool = False
    colour: str = ""


@dataclass(frozen=True, eq=False)
class Drawing(Shown):
    """A drawing as a value: every method returns a new drawing with one more element; ``a + b`` draws b over a.

    Points and lengths are in metres, angles in radians; an element with a point that is not finite is left out.
    Names are symbols of the sheet: ``P34`` is printed as P with index 34.

    Parameters
    ----------
    width, height : float
        Greatest size in the page [px].
    frame : array of complex, optional
        The picture shows the box around these points [m] whatever is drawn, so that it rests while a mechanism
        moves: two corners, or the points of all positions. By default, and where none is finite, it fits what is drawn.
    scales : mapping of unit to float, optional
        Length of an arrow of one unit [m], such as ``{"N": 2e-6}``; arrows whose scale is NaN are left out. By default
        the longest arrow of each unit is a fifth of the picture.
    unit : str, optional
        Unit of the points if they are no places: ``"N"`` for a diagram of forces, whose arrows then have its scale;
        ``""`` for a scheme of boxes, which has no scale.

    Examples
    --------
    >>> def crank(A):
    ...     return Drawing().support(0j, "O1").link(0j, A, "1").hinge(A, "A")
    >>> drawing = Drawing(frame=[-1 - 1j, 1 + 1j]) + crank(1j).faint() + crank(1 + 0j)
    >>> drawing.svg()[:4]
    '<svg'
    """

    width: float = 640.0
    height: float = 480.0
    frame: ArrayLike | None = None
    scales: Mapping[str, float] = field(default_factory=dict)
    elements: tuple[Element, ...] = field(default=(), repr=False)
    behind: tuple[Element, ...] = field(default=(), repr=False)
    unit: str = "m"

    def __post_init__(self) -> None:
        if not (4 * MARGIN <= self.width < FAR and 4 * MARGIN <= self.height < FAR):
            width, height, least = (numbers.significant(x, 6) for x in (self.width, self.height, 4 * MARGIN))
            raise SheetError(f"drawing of {width} x {height} px: both must be {least} px or more")
        for unit, scale in self.scales.items():
            if not (0 < scale < inf or isnan(scale)):
                raise SheetError(f"scale of the arrows = {scale} m/{unit} must be positive")

    def __add__(self, other: "Drawing") -> "Drawing":
        return replace(self, elements=self.elements + other.elements, behind=self.behind + other.behind)

    def faint(self) -> "Drawing":
        """The moving elements only, pale and without names, to be drawn behind all others: an extreme position."""
        moving = (e for e in self.elements if e.kind not in _FIXED)
        return replace(self, elements=(), behind=(*self.behind, *moving))

    # Links

    def link(self, A: complex, B: complex, name: str = "") -> "Drawing":
        """Binary link AB."""
        return self._with("link", (A, B), name, _distance)

    def plate(self, points: Sequence[complex], name: str = "") -> "Drawing":
        """Link with three hinges or more, at its corners."""
        return self._with("plate", points, name, least=3)

    def cylinder(self, A: complex, B: complex, name: str = "", barrel: float | None = None) -> "Drawing":
        """Hydraulic cylinder: a barrel of length ``barrel`` [m] on A (by default 0.6 AB), a rod as long on B."""
        if barrel is not None and not (0 < barrel < inf or isnan(barrel)):
            raise SheetError(f"barrel of the cylinder = {barrel} m must be positive")
        A, B = _points("cylinder", (A, B))
        length = _length(B - A)
        end = A + (0.6 * (B - A) if barrel is None else barrel * ((B - A) / length if length else 0j))
        return self._with("cylinder", (A, B, end), name, _distance)

    def slot(self, A: complex, B: complex, name: str = "") -> "Drawing":
        """Link AB with a slot in which a slider moves."""
        return self._with("slot", (A, B), name, _distance)

    def slider(self, P: complex, angle: float = 0.0, name: str = "") -> "Drawing":
        """Slider at P that moves in the direction ``angle``; its hinge, if it has one, is a ``hinge`` at P."""
        return self._with("slider", (P,), name, _place, value=angle)

    # Points

    def hinge(self, P: complex, name: str = "") -> "Drawing":
        """Hinge between moving links."""
        return self._with("hinge", (P,), name, _place)

    def support(self, P: complex, name: str = "", angle: float = -pi / 2) -> "Drawing":
        """Hinge on the frame, which lies in the direction ``angle`` from it, by default below."""
        return self._with("support", (P,), name, _place, value=angle)

    def mass(self, S: complex, name: str = "") -> "Drawing":
        """Centre of mass."""
        return self._with("mass", (S,), name, _place)

    def text(self, P: complex, text: str) -> "Drawing":
        """Text centred on P, as it stands."""
        return self._with("text", (P,), text, tip="")

    # Surroundings

    def ground(self, A: complex, B: complex) -> "Drawing":
        """Surface at rest from A to B, hatched on its right."""
        return self._with("ground", (A, B))

    def guide(self, A: complex, B: complex) -> "Drawing":
        """Guide at rest for a slider whose centre moves from A to B; it is on the right of AB."""
        return self._with("guide", (A, B))

    def wheel(self, centre: complex, r: float, name: str = "") -> "Drawing":
        """Wheel of radius r."""
        if r <= 0:
            raise SheetError(f"radius of the wheel = {r} m must be positive")
        (centre,) = _points("wheel", (centre,))
        return self._with("wheel", [centre, *(centre + r * i for i in (1, 1j, -1, -1j))], name)

    def polygon(self, points: Sequence[complex], name: str = "", colour: str = "") -> "Drawing":
        """Outline of a body, or the area of a diagram; ``colour`` is one of `COLOURS`."""
        return self._with("polygon", points, name, least=3, colour=colour)

    def path(self, points: ArrayLike, name: str = "", colour: str = "blue") -> "Drawing":
        """Trajectory through an array of points, interrupted where they are not finite; its name is at its end."""
        _known(colour)
        z = np.array(_points("path", points, 0))
        finite = np.isfinite(z)
        pieces = np.split(z, np.flatnonzero(finite[1:] != finite[:-1]) + 1)
        drawn = [piece for piece in pieces if len(piece) > 1 and np.isfinite(piece).all()]
        drawing = self
        for piece in drawn:
            drawing = drawing._with("path", piece, name if piece is drawn[-1] else "", tip=name, colour=colour)
        return drawing

    # Vectors and dimensions

    def force(self, P: complex, F: complex, name: str = "", into: bool = False) -> "Drawing":
        """Force F [N]: an arrow that starts at P, or with ``into`` ends there."""
        return self.arrow(P, F, name, "N", "red", into)

    def arrow(
        self, P: complex, V: complex, name: str, unit: str, colour: str = "green", into: bool = False
    ) -> "Drawing":
        """Vector V in ``unit``; the arrows of a unit have one scale, which is shown below the picture."""
        P, V = _points("arrow", (P, V))

        def measure(*_: complex) -> str:
            return f"{quantity(_length(V), unit)} ({_digits(V.real)}, {_digits(V.imag)})"

        vector = -V if into else V
        return self._with("arrow", (P,), name, measure, vector=vector, unit=unit, into=into, colour=colour)

    def moment(self, P: complex, M: float, name: str = "", unit: str = "N*m", colour: str = "red") -> "Drawing":
        """Moment M about P, counter-clockwise where positive: an arc that tells its sense, not its size."""
        return self._with("moment", (P,), name, lambda _: quantity(M, unit), value=M, unit=unit, colour=colour)

    def dimension(self, A: complex, B: complex, name: str, offset: float = 30.0) -> "Drawing":
        """Dimension of AB, its line ``offset`` px to the left of AB."""
        return self._with("dimension", (A, B), name, _distance, value=offset)

    # The picture

    def svg(self) -> str:
        """The drawing as one SVG element, without identifiers, style sheets and scripts."""
        return self._mime_()[1]

    def _with(
        self,
        kind: str,
        points: ArrayLike,
        name: str = "",
        measure: Callable[..., str] | None = None,
        least: int = 1,
        tip: str | None = None,
        value: float = 0.0,
        vector: complex | None = None,
        unit: str = "",
        into: bool = False,
        colour: str = "",
    ) -> "Drawing":
        _known(colour)
        at = _points(kind, points, least)
        number = _points(kind, (value,))[0].real
        if not isfinite(number):  # leaves the element out
            at = (complex(nan, nan),) * len(at)
        if not isinstance(name, str):
            raise SheetError(f"{kind}: its name must be a text between quotes, not {as_given(name)}")
        if tip is None:
            tip = ": ".join(filter(None, (name, measure(*at[:2]) if measure else "")))
        element = Element(kind, at, name, tip, number, vector, unit, into, colour)
        return replace(self, elements=(*self.elements, element))


def quantity(value: float, unit: str) -> str:
    """A value with its unit, as it is written in a drawing: small lengths in mm, large forces in kN.

    What is written as 1 kN or 0.1 m is so too where it is a rounding less.
    """
    if unit == "N" and abs(value) > 999.95:
        value, unit = value / 1000, "kN"
    elif unit == "m" and 0 < abs(value) < 0.099995:
        value, unit = value * 1000, "mm"
    return f"{_digits(value)} {unit}"


def _digits(x: float) -> str:
    return numbers.significant(x, 4)


def _length(z: complex) -> float:
    return hypot(z.real, z.imag)


def _place(P: complex) -> str:
    return f"{_digits(P.real)}, {_digits(P.imag)} m"


def _distance(A: complex, B: complex) -> str:
    return quantity(_length(B - A), "m")


def _points(kind: str, points: ArrayLike, least: int = 1) -> tuple[complex, ...]:
    try:
        z = np.asarray(points, dtype=complex)
    except (TypeError, ValueError):
        raise SheetError(f"{kind}: its points must be single complex numbers [m], got {points!r}") from None
    if z.ndim != 1:
        raise SheetError(f"{kind}: its points must be single complex numbers [m], got arrays of shape {z.shape[1:]}")
    if len(z) < least:
        raise SheetError(f"{kind}: needs {least} points or more, got {len(z)}")
    return tuple(z.tolist())


def _known(colour: str) -> None:
    if colour and colour not in COLOURS:
        raise SheetError(f"colour {colour!r} is not known; there are {', '.join(COLOURS)}")
