"""A drawing while it is laid out: lines, areas, circles and names in px round the middle of the picture, y down."""

from cmath import phase, rect
from collections.abc import Callable, Iterator, Sequence
from functools import cache
from itertools import pairwise
from math import pi
from typing import NamedTuple

import numpy as np

from mechsheet.document import labels
from mechsheet.document.labels import Label, Name, Segments, Text, length, reach, unit

# Sizes [px].
BODY, EDGE, THIN, ARROW = 2.4, 1.5, 0.9, 2.0  # lines of links; of symbols; of hatching and dimensions; of arrows
PIN = 4.5  # radius of a hinge


class Mark(NamedTuple):
    """A line through points, an area where its width is 0, or a circle of some radius round its one point."""

    points: Sequence[complex]
    width: float
    radius: float = 0.0
    colour: str = ""
    opacity: float = 1  # of an area
    trimmed: bool = False  # until it ends at the hinges' circles


class Group(NamedTuple):
    """The marks of one element, and what it tells under the pointer."""

    kind: str
    tip: str
    faint: bool
    marks: Sequence[Mark]


def _key(p: complex) -> tuple[int, int]:
    """One key for a point that was computed in two ways."""
    return round(10 * p.real), round(10 * p.imag)


@cache
def _circle(corners: int) -> tuple[complex, ...]:
    return tuple(rect(1, 2 * pi * i / corners) for i in range(corners + 1))


class Picture:
    """Groups of marks and names, added element by element."""

    def __init__(self) -> None:
        self.groups: list[Group] = []
        self.texts: list[Text] = []
        self._faint = False
        self._marks: list[Mark] = []
        self._end_labels: list[Label] = []  # they have the first choice of places, those of points the second
        self._point_labels: list[Label] = []
        self._labels: list[Label] = []
        self._pins: dict[tuple[int, int], float] = {}
        self._arms: dict[tuple[int, int], list[complex]] = {}

    def begin(self, faint: bool = False) -> None:
        """What follows is one element."""
        self._marks, self._faint = [], faint

    def end(self, kind: str, tip: str) -> None:
        """The element is complete; one that nothing was drawn of is none."""
        if self._marks:
            self.groups.append(Group(kind, "" if self._faint else tip, self._faint, self._marks))

    # Marks

    def line(self, *points: complex, width: float = EDGE, colour: str = "", closed: bool = False) -> None:
        self._marks.append(Mark((*points, points[0]) if closed else points, width, colour=colour))

    def bar(self, a: complex, b: complex, width: float = BODY) -> None:
        """A line of a link, which ends at the circles of its hinges."""
        self._marks.append(Mark((a, b), width, trimmed=True))
        if not self._faint:
            self._arms.setdefault(_key(a), []).append(b - a)
            self._arms.setdefault(_key(b), []).append(a - b)

    def area(self, *points: complex, opacity: float = 1, colour: str = "") -> None:
        self._marks.append(Mark(points, 0, colour=colour, opacity=opacity))

    def circle(self, p: complex, r: float, width: float = EDGE) -> None:
        self._marks.append(Mark((p,), width, r))

    def pin(self, p: complex, name: str, r: float = PIN) -> None:
        """A circle at which bars end."""
        self.circle(p, r)
        self._pins[_key(p)] = r
        self.label_round(name, p, r)

    def hatch(self, a: complex, b: complex) -> None:
        """A surface at rest, hatched on its right."""
        u = unit(b - a)
        self.line(a, b)
        n = max(1, round(length(b - a) / 7))
        for i in range(n):
            p = a + (i + 0.8) / n * (b - a)
            self.line(p, p + 7 * (1j - 0.8) * u, width=THIN)

    def arrow(self, p: complex, q: complex, colour: str) -> None:
        u, size = unit(q - p), length(q - p)
        head = min(12.0, 0.7 * size)
        self.line(p, q - 0.8 * head * u, width=ARROW, colour=colour)
        self.area(q, q - head * (1 + 0.34j) * u, q - head * (1 - 0.34j) * u, colour=colour)
        self._arms.setdefault(_key(p), []).append(q - p)

    # Names

    def label(self, name: str, places: Callable[..., Iterator[complex]], *where: complex | float) -> None:
        """A name at one of the ``places``, which are asked with half its size and ``where``."""
        if name and not self._faint:
            printed, half = labels.as_printed(name)
            self._labels.append(Label(printed, half, places(half, *where)))

    def label_end(self, name: str, a: complex, b: complex) -> None:
        """A name at the end b of a path that comes from a: nowhere else it says what it names."""
        if name and not self._faint:
            printed, half = labels.as_printed(name)
            self._end_labels.append(Label(printed, half, labels.past(half, a, b)))

    def label_round(self, name: str, p: complex, r: float) -> None:
        """A name round a circle, first in the widest gap between the bars that end there."""
        if name and not self._faint:
            printed, half = labels.as_printed(name)
            self._point_labels.append(Label(printed, half, self._around(half, p, r)))

    def _around(self, half: complex, p: complex, r: float) -> Iterator[complex]:
        arms = sorted(phase(q) for q in self._arms.get(_key(p), ()) if q)
        if arms:
            # of gaps that differ by rounding alone the last one
            gap, start = max((round(b - a, 6), a) for a, b in pairwise((*arms, arms[0] + 2 * pi)))
            best = start + gap / 2
        else:
            best = -pi / 4
        for distance in (r + 4, r + 12, r + 22, r + 34):
            for turn in (0, 0.5, -0.5, 1, -1, 1.6, -1.6, 2.3, -2.3, pi):
                n = rect(1, best + turn)
                yield p + n * (distance + reach(half, n))

    def write(self, name: Name, centre: complex, half: complex) -> None:
        self.texts.append(Text(name, centre, half))

    def place_labels(self, lines: Segments, low: complex, high: complex) -> None:
        """Write the names, clear of lines and of each other, inside the box between two corners."""
        labels.place((*self._end_labels, *self._point_labels, *self._labels), self.texts, lines, low, high)

    # The whole

    def segments(self) -> Segments:
        """Start, end and weight of all lines; circles as polygons."""
        rows: list[tuple[complex, complex, float]] = []
        for group in self.groups:
            weight = 3.0 if group.faint else 20.0  # whole numbers, whose sums are exact
            for points, _, r, *_ in group.marks:
                if r:
                    points = [points[0] + r * q for q in _circle(24 if r > 10 else 4)]
                rows += [(a, b, weight) for a, b in pairwise(points)]
        a, b, weights = np.array(rows, dtype=complex).reshape(-1, 3).T
        return a, b, weights.real

    def finished(self) -> tuple[Group, ...]:
        """The groups, the bars of links cut off at the circles of their hinges."""
        return tuple([g._replace(marks=[cut for m in g.marks if (cut := self._cut(m))]) for g in self.groups])

    def _cut(self, mark: Mark) -> Mark | None:
        if not mark.trimmed:
            return mark
        a, b = mark.points
        r_a, r_b = self._pins.get(_key(a), 0.0), self._pins.get(_key(b), 0.0)
        if length(b - a) <= r_a + r_b:
            return None
        u = unit(b - a)
        return Mark((a + r_a * u, b - r_b * u), mark.width)
