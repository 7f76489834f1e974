"""Planar mechanisms drawn to scale, as SVG: points are complex numbers in metres, y up, axes equal."""

import re
from cmath import isfinite, phase, rect
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cache, lru_cache
from html import escape
from itertools import groupby, pairwise
from math import floor, hypot, inf, log10, nan, pi
from typing import NamedTuple, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mechsheet.worksheet import symbol
from mechsheet.worksheet.errors import SheetError
from mechsheet.worksheet.shown import Shown

# Legible on white and on black; "" is the page's text colour.
COLOURS = {"": "currentColor", "blue": "#3b82d0", "red": "#e0483c", "green": "#2c9c5c", "orange": "#cf7a17"}

# Sizes on the page [px].
_BODY, _EDGE, _THIN = 2.4, 1.5, 0.9  # lines of links; of symbols; of hatching and dimensions
_PIN, _MASS, _BARREL = 4.5, 7.0, 7.0  # radii of a hinge, of a centre of mass, of a cylinder
_MOMENT = 26.0  # radius of the arc of a moment
_BLOCK = 14 + 8j  # half length and half height of a slider
_FONT, _INDEX = 15, 11
_MARGIN = 42.0  # round the outermost points, for symbols and labels
_GAP = 6.0  # from a line to its label
_CLEAR, _APART = 3 + 1j, 10 + 1j  # free space round a label; between labels
_CELL = 5.0  # grid in which free places are sought
_FAR = 1e5  # an element with a point beyond this is not drawn
_PART = 0.2  # longest arrow and longest scale bar, as a part of the picture

Points: TypeAlias = NDArray[np.complex128]


def _length(z: complex) -> float:
    return hypot(z.real, z.imag)


def _unit(z: complex) -> complex:
    """Direction of z; 0 where z is 0."""
    return z / length if (length := _length(z)) else 0j


def _key(p: complex) -> tuple[int, int]:
    """One key for a point that was computed in two ways."""
    return round(10 * p.real), round(10 * p.imag)


def _round_below(x: float) -> float:
    """1, 2 or 5 times a power of ten, the largest that does not exceed x > 0."""
    power = 10.0 ** floor(log10(x))
    return next((m * power for m in (5, 2) if m * power <= x), power)


def _quantity(value: float, unit: str) -> str:
    if unit == "N" and abs(value) >= 1000:
        return f"{value / 1000:.4g} kN"
    return f"{value:.4g} {unit}"


def _place(P: complex, *_: complex) -> str:
    return f"{P.real:.4g}, {P.imag:.4g} m"


def _distance(A: complex, B: complex) -> str:
    return f"{_length(B - A):.4g} m"


def _box(points: Sequence[complex] | Points) -> tuple[complex, complex]:
    """Centre and half size of the box around points; round a single point a box of 2 m."""
    z = np.asarray(points, dtype=complex)
    if not z.size:
        return 0j, 1 + 1j
    x0, x1, y0, y1 = (float(v) for v in (z.real.min(), z.real.max(), z.imag.min(), z.imag.max()))
    half = complex(x1 / 2 - x0 / 2, y1 / 2 - y0 / 2)
    least = 1e-9 if max(half.real, half.imag) > 1e-9 else 1.0
    return complex(x0 / 2 + x1 / 2, y0 / 2 + y1 / 2), complex(max(half.real, least), max(half.imag, least))


def _corners(z: Points, margin: float) -> tuple[complex, complex]:
    """Low and high corner of the box around points, a margin away from them."""
    centre, half = _box(z)
    half += (1 + 1j) * margin
    return centre - half, centre + half


def _finite(points: Sequence[complex]) -> Sequence[complex]:
    """The points of an element if it is drawn."""
    return points if all(map(isfinite, points)) else ()


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
    if colour not in COLOURS:
        raise SheetError(f"colour {colour!r} is not known; there are {', '.join(c for c in COLOURS if c)}")


@cache
def _circle(corners: int) -> tuple[complex, ...]:
    return tuple(rect(1, 2 * pi * i / corners) for i in range(corners + 1))


# Names and where they go


def _escape(text: str) -> str:
    """Text for XML, without the characters that XML 1.0 has not."""
    return escape(re.sub("[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]", "\ufffd", text))


def _width(text: str, size: float) -> float:
    """Width of a text in a serif face [px], estimated from its small, capital and wide characters."""
    narrow, small = " .,:;'()|", 0.48
    return size * sum(
        0.3 if c in narrow else small if c.islower() or c.isdigit() else 0.72 if c < "\u1100" else 1.0 for c in text
    )


@lru_cache(1000)
def _symbol(name: str) -> tuple[str, float]:
    """SVG text of a name, its index lowered, and its width [px]; what follows a space stays as it is."""
    first, space, rest = name.partition(" ")
    sign, first = ("−", first[1:]) if first.startswith("-") else ("", first)
    read = symbol.read(first)
    mark, base, index, rest = sign + read.mark, read.base, read.index, space + rest
    width = _width(mark + base + rest, _FONT) + _width(index, _INDEX)
    text = mark + (f'<tspan font-style="italic">{base}</tspan>' if len(base) == 1 and base.isalpha() else _escape(base))
    if index:
        text += f'<tspan dy="4" font-size="{_INDEX}">{index}</tspan>'
    if rest:
        text += f'<tspan dy="{-4 if index else 0}">{_escape(rest)}</tspan>'
    return text, width


def _reach(half: complex, n: complex) -> float:
    """How far a box of half size ``half`` reaches from its centre in direction n."""
    return abs(half.real * n.real) + abs(half.imag * n.imag)


def _beside(half: complex, a: complex, b: complex, r: float = 0.0) -> Iterator[complex]:
    """Beside the line ab of half width r, first on its left."""
    n = -1j * _unit(b - a)
    for t in (0.5, 0.36, 0.64, 0.24, 0.76):
        for side in (n, -n):
            yield a + t * (b - a) + side * (r + _GAP + _reach(half, n))


def _inside(half: complex, *points: complex) -> Iterator[complex]:
    """In the middle of a polygon, or outside beside its edges."""
    middle = sum(points) / len(points)
    yield middle
    for a, b in pairwise((*points, points[0])):
        m = (a + b) / 2
        n = 1j * _unit(b - a)
        if (n.conjugate() * (m - middle)).real < 0:
            n = -n
        yield m + n * (_GAP + _reach(half, n))


def _past(half: complex, a: complex, b: complex) -> Iterator[complex]:
    """At the end b of the arrow ab: beyond it or on its sides."""
    u = _unit(b - a)
    gaps = [_GAP, 2 * _GAP]
    if _length(b - a) < 4 * _GAP:  # a short arrow is crowded by what stands at its foot
        gaps.append(4 * _GAP)
    for gap in gaps:
        for back, n in ((0, u), (5, 1j * u), (5, -1j * u), (20, 1j * u), (20, -1j * u)):
            yield b - back * u + n * (gap + _reach(half, n))


def _ink_table(a: Points, b: Points, weight: NDArray[np.float64], size: complex) -> NDArray[np.float64]:
    """Summed area table of lines ab on a grid of unit cells: four look-ups give the ink in a box."""
    columns, rows = int(size.real) + 1, int(size.imag) + 1
    count = np.abs(b - a).astype(int) + 2  # samples of each line, both ends included
    line = np.repeat(np.arange(len(a)), count)
    step = np.arange(len(line)) - np.repeat(np.cumsum(count) - count, count)
    point = a[line] + (b - a)[line] * (step / (count - 1)[line])
    column, row = np.floor(point.real).astype(int), np.floor(point.imag).astype(int)
    seen = (column >= 0) & (column < columns) & (row >= 0) & (row < rows)
    ink = np.bincount((row * columns + column)[seen], weight[line[seen]], rows * columns)
    table = np.zeros((rows + 1, columns + 1))
    table[1:, 1:] = ink.reshape(rows, columns).cumsum(0).cumsum(1)
    return table


# The page


class _Mark(NamedTuple):
    """A line through points, or a circle of some radius round one; a trimmed line ends at the hinges' circles."""

    style: str
    points: Sequence[complex]
    radius: float = 0.0
    trimmed: bool = False


class _Group(NamedTuple):
    """The marks of one element."""

    kind: str
    tip: str
    faint: bool
    marks: Sequence[_Mark]


class _Label(NamedTuple):
    """A text, half its size, and places for its centre, best first."""

    text: str
    half: complex
    places: Iterator[complex]


@dataclass(frozen=True, eq=False)
class _Shape:
    """An element: its points [m], and how it is drawn on a page once they are known in px.

    An arrow has one point and a ``vector``: its other end follows from the scale of the ``unit`` [m/unit].
    """

    kind: str
    points: tuple[complex, ...]
    draw: Callable[..., None]
    tip: str = ""
    fixed: bool = False
    vector: complex | None = None
    unit: str = ""
    colour: str = ""

    def ends(self, scales: Mapping[str, float]) -> tuple[complex, ...]:
        if self.vector is None:
            return self.points
        return (*self.points, self.points[0] + scales.get(self.unit, nan) * self.vector)


class _Page:
    """One picture while it is built, in px round its middle, y down; ``view`` is half its size if that is given."""

    def __init__(self, view: complex | None) -> None:
        self.view = view
        self.groups: list[_Group] = []
        self.faint = False
        self.marks: list[_Mark] = []
        self.point_labels: list[_Label] = []  # they have the first choice of places
        self.labels: list[_Label] = []
        self.texts: list[str] = []
        self.taken: list[tuple[complex, complex]] = []
        self.pins: dict[tuple[int, int], float] = {}
        self.arms: dict[tuple[int, int], list[complex]] = {}

    def draw(self, shape: _Shape, points: Sequence[complex], faint: bool) -> None:
        if all([abs(p.real) < _FAR and abs(p.imag) < _FAR for p in points]):  # False for NaN
            self.marks, self.faint = [], faint
            shape.draw(self, *points)
            if self.marks:
                self.groups.append(_Group(shape.kind, "" if faint else shape.tip, faint, self.marks))

    # Marks

    def line(self, *points: complex, width: float = _EDGE, colour: str = "", closed: bool = False) -> None:
        style = f'stroke-width="{width}"' + (f' stroke="{COLOURS[colour]}"' if colour else "")
        self.marks.append(_Mark(style, (*points, points[0]) if closed else points))

    def bar(self, a: complex, b: complex, width: float = _BODY) -> None:
        """A line of a link, which ends at the circles of its hinges."""
        self.marks.append(_Mark(f'stroke-width="{width}"', (a, b), trimmed=True))
        if not self.faint:
            self.arms.setdefault(_key(a), []).append(b - a)
            self.arms.setdefault(_key(b), []).append(a - b)

    def area(self, *points: complex, opacity: float = 1, colour: str = "") -> None:
        self.marks.append(_Mark(f'stroke="none" fill="{COLOURS[colour]}" fill-opacity="{opacity}"', points))

    def circle(self, p: complex, r: float, width: float = _EDGE) -> None:
        self.marks.append(_Mark(f'stroke-width="{width}"', (p,), r))

    def pin(self, p: complex, name: str, r: float = _PIN) -> None:
        """A circle at which bars end."""
        self.circle(p, r)
        self.pins[_key(p)] = r
        self.label(name, self.around, p, r)

    def hatch(self, a: complex, b: complex) -> None:
        """A surface at rest, hatched on its right."""
        u = _unit(b - a)
        self.line(a, b)
        n = max(1, round(_length(b - a) / 7))
        for i in range(n):
            p = a + (i + 0.8) / n * (b - a)
            self.line(p, p + 7 * (1j - 0.8) * u, width=_THIN)

    def arrow(self, p: complex, q: complex, colour: str) -> None:
        u, length = _unit(q - p), _length(q - p)
        head = min(12.0, 0.7 * length)
        self.line(p, q - 0.8 * head * u, width=2.0, colour=colour)
        self.area(q, q - head * (1 + 0.34j) * u, q - head * (1 - 0.34j) * u, colour=colour)
        self.arms.setdefault(_key(p), []).append(q - p)

    # Names

    def label(self, name: str, places: Callable[..., Iterator[complex]], *where: complex | float) -> None:
        if name and not self.faint:
            text, width = _symbol(name)
            half = complex(width / 2, 8)
            labels = self.point_labels if places == self.around else self.labels
            labels.append(_Label(text, half, places(half, *where)))

    def around(self, half: complex, p: complex, r: float) -> Iterator[complex]:
        """Round a circle, first in the widest gap between the bars that end there."""
        arms = sorted(phase(q) for q in self.arms.get(_key(p), ()) if q)
        if arms:
            gap, start = max((b - a, a) for a, b in pairwise((*arms, arms[0] + 2 * pi)))
            best = start + gap / 2
        else:
            best = -pi / 4
        for distance in (r + 4, r + 12):
            for turn in (0, 0.5, -0.5, 1, -1, 1.6, -1.6, 2.3, -2.3, pi):
                n = rect(1, best + turn)
                yield p + n * (distance + _reach(half, n))

    def write(self, text: str, centre: complex, half: complex) -> None:
        self.texts.append(f'<text x="{centre.real:.1f}" y="{centre.imag + 0.33 * _FONT:.1f}">{text}</text>')
        self.taken.append((centre, half))

    def segments(self) -> tuple[Points, Points, NDArray[np.float64]]:
        """Start, end and weight of all lines; circles as polygons."""
        rows: list[tuple[complex, complex, float]] = []
        for group in self.groups:
            weight = 0.15 if group.faint else 1.0
            for _, points, r, _ in group.marks:
                if r:
                    points = [points[0] + r * q for q in _circle(24 if r > 10 else 4)]
                rows += [(a, b, weight) for a, b in pairwise(points)]
        a, b, weights = np.array(rows, dtype=complex).reshape(-1, 3).T
        return a, b, weights.real

    def place_labels(self, a: Points, b: Points, weight: NDArray[np.float64]) -> None:
        """Write each name at the first of its places that is free of lines and other names, or at the least bad."""
        low, high = (-self.view, self.view) if self.view else _corners(np.concatenate([a, b]), 60)
        table = _ink_table((a - low) / _CELL, (b - low) / _CELL, weight, (high - low) / _CELL)
        rows, columns = (n - 1 for n in table.shape)

        def cost(centre: complex, half: complex) -> float:
            room = half + _CLEAR
            p, q = (centre - room - low) / _CELL, (centre + room - low) / _CELL
            outside = p.real < 0 or p.imag < 0 or q.real > columns or q.imag > rows
            i, j = min(max(round(p.real), 0), columns), min(max(round(q.real), 0), columns)
            m, n = min(max(round(p.imag), 0), rows), min(max(round(q.imag), 0), rows)
            ink = table.item(n, j) - table.item(m, j) - table.item(n, i) + table.item(m, i)
            clashes = 0
            for c, r in self.taken:
                apart, least = c - centre, r + half + _APART
                clashes += abs(apart.real) < least.real and abs(apart.imag) < least.imag
            return float(6 * ink + 50 * clashes + 100 * outside)

        for text, half, places in (*self.point_labels, *self.labels):
            best, least = 0j, inf
            for rank, place in enumerate(places):
                if rank >= least:
                    break
                if (total := rank + cost(place, half)) < least:
                    best, least = place, total
            self.write(text, best, half)

    # SVG

    def path(self, points: Sequence[complex], trimmed: bool) -> str:
        if trimmed:
            a, b = points
            r_a, r_b = self.pins.get(_key(a), 0.0), self.pins.get(_key(b), 0.0)
            if _length(b - a) <= r_a + r_b:
                return ""
            u = _unit(b - a)
            points = (a + r_a * u, b - r_b * u)
        return "M" + "L".join([f"{p.real:.1f} {p.imag:.1f}" for p in points])

    def group(self, group: _Group) -> str:
        """One element; successive lines of one style are one path."""
        out = [f'<g data-shape="{group.kind}">']
        if group.tip:
            out.append(f"<title>{_escape(group.tip)}</title>")
        for (style, is_circle), run in groupby(group.marks, lambda mark: (mark.style, mark.radius > 0)):
            if is_circle:
                out += [
                    f'<circle {style} cx="{m.points[0].real:.1f}" cy="{m.points[0].imag:.1f}" r="{m.radius:.1f}"/>'
                    for m in run
                ]
            elif d := "".join([self.path(m.points, m.trimmed) for m in run]):
                out.append(f'<path {style} d="{d}"/>')
        return "".join(out) + "</g>"

    def scale_bars(
        self, scales: Mapping[str, float], colours: Mapping[str, str], left: float, y: float, longest: float
    ) -> float:
        """Bars of round length side by side at height y, one for each unit; returns where they end."""
        for unit, scale in scales.items():
            if not 0 < (most := longest / scale if scale else 0.0) < inf:
                continue
            value = _round_below(most)
            end = left + value * scale
            self.marks = []
            if unit == "m":
                self.line(complex(left, y - 4), complex(left, y), complex(end, y), complex(end, y - 4))
            else:
                self.arrow(complex(left, y - 3), complex(end, y - 3), colours[unit])
            self.groups.append(_Group("scale", "", False, self.marks))
            text = _quantity(value, unit)
            half = complex(_width(text, _FONT) / 2, 8)
            self.write(_escape(text), complex(end + 8 + half.real, y - 3), half)
            left = end + 2 * half.real + 32
        return left

    def svg(self, scales: Mapping[str, float], colours: Mapping[str, str]) -> str:
        a, b, weight = self.segments()
        self.place_labels(a, b, weight)
        if self.view:
            low, high = -self.view, self.view
        else:
            boxes = [c + sign * h for c, h in self.taken for sign in (1, -1)]
            low, high = _corners(np.concatenate([a, b, np.array(boxes, dtype=complex)]), 4)
        if self.groups:
            width = (high - low).real
            end = self.scale_bars(scales, colours, low.real + 8, high.imag + 20, _PART * width)
            high = complex(max(high.real, end), high.imag + 28)
        size = high - low
        faint = "".join([self.group(group) for group in self.groups if group.faint])
        clear = "".join([self.group(group) for group in self.groups if not group.faint])
        return (
            f'<svg xmlns="http://www.w3.org/2000/svg" width="{size.real:.1f}" '
            f'viewBox="{low.real:.1f} {low.imag:.1f} {size.real:.1f} {size.imag:.1f}" '
            'style="max-width:100%;height:auto" fill="none" stroke="currentColor" '
            'stroke-linecap="round" stroke-linejoin="round">'
            f'<g opacity="0.3">{faint}</g>{clear}'
            f'<g fill="currentColor" stroke="none" text-anchor="middle" font-size="{_FONT}" '
            f"font-family=\"KaTeX_Main,'Times New Roman',serif\">{''.join(self.texts)}</g></svg>"
        )


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
        moves: two corners, or the points of all positions. By default it fits what is drawn.
    scales : mapping of unit to float, optional
        Length of an arrow of one unit [m], such as ``{"N": 2e-6}``. By default the longest arrow of each unit
        is a fifth of the picture.
    unit : str, optional
        Unit of the points if they are no places: ``"N"`` for a diagram of forces, whose arrows then have its scale.

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
    shapes: tuple[_Shape, ...] = field(default=(), repr=False)
    behind: tuple[_Shape, ...] = field(default=(), repr=False)
    unit: str = "m"

    def __post_init__(self) -> None:
        if not (4 * _MARGIN <= self.width < _FAR and 4 * _MARGIN <= self.height < _FAR):
            raise SheetError(f"drawing of {self.width:g} x {self.height:g} px: both must be {4 * _MARGIN:g} px or more")
        if self.frame is not None and not np.isfinite(np.asarray(self.frame, dtype=complex)).any():
            raise SheetError("frame of the drawing has no finite point")
        for unit, scale in self.scales.items():
            if not 0 < scale < inf:
                raise SheetError(f"scale of the arrows = {scale} m/{unit} must be positive")

    def __add__(self, other: "Drawing") -> "Drawing":
        return replace(self, shapes=self.shapes + other.shapes, behind=self.behind + other.behind)

    def faint(self) -> "Drawing":
        """The moving elements only, pale and without names, to be drawn behind all others: an extreme position."""
        return replace(self, shapes=(), behind=(*self.behind, *(s for s in self.shapes if not s.fixed)))

    # Links

    def link(self, A: complex, B: complex, name: str = "") -> "Drawing":
        """Binary link AB."""

        def draw(page: _Page, a: complex, b: complex) -> None:
            page.bar(a, b)
            page.label(name, _beside, a, b)

        return self._with("link", (A, B), draw, name, _distance)

    def plate(self, points: Sequence[complex], name: str = "") -> "Drawing":
        """Link with three hinges or more, at its corners."""

        def draw(page: _Page, *p: complex) -> None:
            page.area(*p, opacity=0.1)
            for a, b in pairwise((*p, p[0])):
                page.bar(a, b)
            page.label(name, _inside, *p)

        return self._with("plate", points, draw, name, least=3)

    def cylinder(self, A: complex, B: complex, name: str = "", barrel: float | None = None) -> "Drawing":
        """Hydraulic cylinder: a barrel of length ``barrel`` [m] on A (by default 0.6 AB), a rod as long on B."""
        if barrel is not None and not 0 < barrel < inf:
            raise SheetError(f"barrel of the cylinder = {barrel} m must be positive")
        A, B = _points("cylinder", (A, B))
        barrel_end = A + (0.6 * (B - A) if barrel is None else barrel * _unit(B - A))

        def draw(page: _Page, a: complex, b: complex, c: complex) -> None:
            u, length, end = _unit(b - a), _length(b - a), _length(c - a)
            start = min(12.0, end / 3)
            piston, side = a + (start + length - end) * u, 1j * _BARREL * u
            page.bar(a, a + start * u)
            page.bar(piston, b)
            page.line(piston + side, piston - side, width=_BODY)
            near, far = a + start * u, a + end * u
            page.line(near + side, far + side, far - side, near - side, closed=True)
            page.label(name, _beside, a, b, _BARREL)

        return self._with("cylinder", (A, B, barrel_end), draw, name, _distance)

    def slot(self, A: complex, B: complex, name: str = "") -> "Drawing":
        """Link AB with a slot in which a slider moves."""

        def draw(page: _Page, a: complex, b: complex) -> None:
            u, r = _unit(b - a), _BLOCK.imag + 2.5
            arc = [r * u * rect(1, pi * i / 12) for i in range(-6, 7)]
            page.line(*(b + q for q in arc), *(a - q for q in arc), width=_BODY, closed=True)
            page.label(name, _beside, a, b, r)

        return self._with("slot", (A, B), draw, name, _distance)

    def slider(self, P: complex, angle: float = 0.0, name: str = "") -> "Drawing":
        """Slider at P that moves in the direction ``angle``; its hinge, if it has one, is a ``hinge`` at P."""

        def draw(page: _Page, p: complex, _: complex) -> None:
            u = rect(1, -angle)
            a, b = _BLOCK.real * u, 1j * _BLOCK.imag * u
            corners = (p - a - b, p + a - b, p + a + b, p - a + b)
            page.area(*corners, opacity=0.1)
            page.line(*corners, closed=True)
            page.label(name, page.around, p, _length(_BLOCK))

        return self._with("slider", (P, P + 0 * angle), draw, name, _place)  # an angle of NaN leaves it out too

    # Points

    def hinge(self, P: complex, name: str = "") -> "Drawing":
        """Hinge between moving links."""
        return self._with("hinge", (P,), lambda page, p: page.pin(p, name), name, _place)

    def support(self, P: complex, name: str = "", angle: float = -pi / 2) -> "Drawing":
        """Hinge on the frame, which lies in the direction ``angle`` from it, by default below."""

        def draw(page: _Page, p: complex, _: complex) -> None:
            u = rect(1, -angle)
            base, side = p + 17 * u, 1j * u
            page.bar(p, base - 10 * side, _EDGE)
            page.bar(p, base + 10 * side, _EDGE)
            page.hatch(base + 15 * side, base - 15 * side)
            page.pin(p, name)

        return self._with("support", (P, P + 0 * angle), draw, name, _place, fixed=True)

    def mass(self, S: complex, name: str = "") -> "Drawing":
        """Centre of mass."""

        def draw(page: _Page, p: complex) -> None:
            for quarter in (0, 12):
                page.area(p, *(p + _MASS * rect(1, pi * (quarter + i) / 12) for i in range(7)))
            page.pin(p, name, _MASS)

        return self._with("mass", (S,), draw, name, _place)

    def text(self, P: complex, text: str) -> "Drawing":
        """Text centred on P, as it stands."""

        def draw(page: _Page, p: complex) -> None:
            page.write(_escape(text), p, complex(_width(text, _FONT) / 2, 8))

        return self._with("text", (P,), draw, fixed=True)

    # Surroundings

    def ground(self, A: complex, B: complex) -> "Drawing":
        """Surface at rest from A to B, hatched on its right."""
        return self._with("ground", (A, B), lambda page, a, b: page.hatch(a, b), fixed=True)

    def guide(self, A: complex, B: complex) -> "Drawing":
        """Guide at rest for a slider whose centre moves from A to B; it is on the right of AB."""

        def draw(page: _Page, a: complex, b: complex) -> None:
            aside = 1j * _BLOCK.imag * _unit(b - a)
            page.hatch(a + aside, b + aside)

        return self._with("guide", (A, B), draw, fixed=True)

    def wheel(self, centre: complex, r: float, name: str = "") -> "Drawing":
        """Wheel of radius r."""
        if r <= 0:
            raise SheetError(f"radius of the wheel = {r} m must be positive")
        (centre,) = _points("wheel", (centre,))

        def draw(page: _Page, p: complex, q: complex, *_: complex) -> None:
            page.circle(p, _length(q - p), _BODY)
            page.circle(p, 0.55 * _length(q - p), _THIN)
            page.circle(p, 2.0)
            page.label(name, page.around, p, 2.0)

        return self._with("wheel", [centre, *(centre + r * i for i in (1, 1j, -1, -1j))], draw, name)

    def polygon(self, points: Sequence[complex], name: str = "", colour: str = "") -> "Drawing":
        """Outline of a body, or the area of a diagram; ``colour`` is one of `COLOURS`."""
        _known(colour)

        def draw(page: _Page, *p: complex) -> None:
            page.area(*p, opacity=0.15 if colour else 0.05, colour=colour)
            page.line(*p, colour=colour, closed=True)
            page.label(name, _inside, *p)

        return self._with("polygon", points, draw, name, least=3)

    def path(self, points: ArrayLike, name: str = "", colour: str = "blue") -> "Drawing":
        """Trajectory through an array of points, interrupted where they are not finite; its name is at its end."""
        _known(colour)
        z = np.array(_points("path", points, 0))
        finite = np.isfinite(z)
        pieces = np.split(z, np.flatnonzero(finite[1:] != finite[:-1]) + 1)
        drawn = [piece for piece in pieces if len(piece) > 1 and np.isfinite(piece).all()]

        def draw(page: _Page, *p: complex) -> None:
            page.line(*p, colour=colour)

        def draw_last(page: _Page, *p: complex) -> None:
            draw(page, *p)
            page.label(name, _past, *p[-2:])

        drawing = self
        for piece in drawn:
            drawing = drawing._with("path", piece, draw_last if piece is drawn[-1] else draw, name)
        return drawing

    # Vectors and dimensions

    def force(self, P: complex, F: complex, name: str = "", into: bool = False) -> "Drawing":
        """Force F [N]: an arrow that starts at P, or with ``into`` ends there."""
        return self.arrow(P, F, name, "N", "red", into)

    def arrow(
        self, P: complex, V: complex, name: str, unit: str, colour: str = "green", into: bool = False
    ) -> "Drawing":
        """Vector V in ``unit``; the arrows of a unit have one scale, which is shown below the picture."""
        _known(colour)
        P, V = _points("arrow", (P, V))

        def draw(page: _Page, p: complex, q: complex) -> None:
            if p != q:
                page.arrow(*((q, p) if into else (p, q)), colour)
                page.label(name, _past, p, q)

        def measure(*_: complex) -> str:
            return f"{_quantity(_length(V), unit)} ({V.real:.4g}, {V.imag:.4g})"

        return self._with("arrow", (P,), draw, name, measure, vector=-V if into else V, unit=unit, colour=colour)

    def moment(self, P: complex, M: float, name: str = "", unit: str = "N*m", colour: str = "red") -> "Drawing":
        """Moment M about P, counter-clockwise where positive: an arc that tells its sense, not its size."""
        _known(colour)

        def draw(page: _Page, p: complex, _: complex) -> None:
            sense = int(M > 0) - int(M < 0)
            if not sense:
                return
            arc = [p + _MOMENT * rect(1, -sense * (0.1 + 1.4 * i / 24) * pi) for i in range(25)]
            u = -1j * sense * _unit(arc[-1] - p)
            page.line(*arc, width=2.0, colour=colour)
            page.area(arc[-1] + 9 * u, arc[-1] + 4j * u, arc[-1] - 4j * u, colour=colour)
            page.label(name, page.around, p, _MOMENT)

        return self._with("moment", (P, P + 0 * M), draw, name, lambda *_: _quantity(M, unit))

    def dimension(self, A: complex, B: complex, name: str, offset: float = 30.0) -> "Drawing":
        """Dimension of AB, its line ``offset`` px to the left of AB."""

        def draw(page: _Page, a: complex, b: complex) -> None:
            u = _unit(b - a)
            n = -1j * u if offset > 0 else 1j * u
            p, q = a + abs(offset) * n, b + abs(offset) * n
            page.line(a + 3 * n, p + 5 * n, width=_THIN)
            page.line(b + 3 * n, q + 5 * n, width=_THIN)
            page.line(p, q, width=_THIN)
            page.area(p, p + (9 + 2.5j) * u, p + (9 - 2.5j) * u)
            page.area(q, q - (9 + 2.5j) * u, q - (9 - 2.5j) * u)
            page.label(name, _beside, p, q)

        return self._with("dimension", (A, B), draw, name, _distance, fixed=True)

    # The picture

    def svg(self) -> str:
        """The drawing as one SVG element, without identifiers, style sheets and scripts."""
        shapes = (*self.behind, *self.shapes)
        frame = np.ravel(np.asarray([] if self.frame is None else self.frame, dtype=complex))
        given = [p for p in frame.tolist() if isfinite(p)]
        centre, half = _box(given or [p for s in shapes for p in _finite(s.points)])
        longest: dict[str, float] = {}
        for s in shapes:
            if s.vector is not None and _finite((*s.points, s.vector)):
                longest[s.unit] = max(_length(s.vector), longest.get(s.unit, 0.0))
        auto = {unit: 2 * _PART * max(half.real, half.imag) / v if v else 0.0 for unit, v in longest.items()}
        scales = {**auto, self.unit: 1.0, **self.scales}
        if not given:
            centre, half = _box([p for s in shapes for p in _finite(s.ends(scales))])
        k = min((self.width / 2 - _MARGIN) / half.real, (self.height / 2 - _MARGIN) / half.imag)
        page = _Page(k * half + (1 + 1j) * _MARGIN if given else None)
        for i, shape in enumerate(shapes):
            page.draw(shape, [k * (p - centre).conjugate() for p in shape.ends(scales)], i < len(self.behind))
        colours = {s.unit: s.colour for s in reversed(shapes) if s.vector is not None}
        return page.svg({self.unit: k} | {unit: k * scales[unit] for unit in longest}, {self.unit: "", **colours})

    def _with(
        self,
        kind: str,
        points: ArrayLike,
        draw: Callable[..., None],
        name: str = "",
        measure: Callable[..., str] | None = None,
        least: int = 1,
        fixed: bool = False,
        vector: complex | None = None,
        unit: str = "",
        colour: str = "",
    ) -> "Drawing":
        at = _points(kind, points, least)
        tip = ": ".join(filter(None, (name, measure(*at[:2]) if measure else "")))
        shape = _Shape(kind, at, draw, tip, fixed, vector, unit, colour)
        return replace(self, shapes=(*self.shapes, shape))
