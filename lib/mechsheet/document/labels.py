"""Where the names in a drawing go: places beside lines, at arrows and in areas, and the first of them that is free.

All in px, y down.
"""

from cmath import rect
from collections.abc import Iterable, Iterator
from functools import lru_cache
from itertools import pairwise
from math import hypot, inf, pi
from typing import NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from mechsheet.worksheet import symbol

FONT, INDEX = 15, 11  # sizes of names and of their indices
GAP = 6.0  # from a line to its name
_CLEAR, _APART = 3 + 1j, 10 + 1j  # free space round a name; between names
_CELL = 5.0  # grid in which free places are sought

Points: TypeAlias = NDArray[np.complex128]
Segments: TypeAlias = tuple[Points, Points, NDArray[np.float64]]  # starts, ends, weights of lines


class Name(NamedTuple):
    """A name as it is printed: sign or mark of a change, symbol, its index, and what follows as it stands."""

    mark: str
    base: str = ""
    lowered: str = ""
    rest: str = ""


class Label(NamedTuple):
    """A name, half its size, and places for its centre, best first."""

    name: Name
    half: complex
    places: Iterator[complex]


class Text(NamedTuple):
    """A name in its place."""

    name: Name
    centre: complex
    half: complex


def length(z: complex) -> float:
    return hypot(z.real, z.imag)


def unit(z: complex) -> complex:
    """Direction of z; 0 where z is 0."""
    return z / size if (size := length(z)) else 0j


def as_printed(name: str) -> tuple[Name, complex]:
    """A name of the worksheet as it is printed, and half its size."""
    printed, width = _printed(name)
    return printed, complex(width / 2, 8)


def plain(text: str) -> tuple[Name, complex]:
    """A text as it stands, and half its size."""
    return Name(text), complex(_width(text, FONT) / 2, 8)


@lru_cache(1000)
def _printed(name: str) -> tuple[Name, float]:
    first, space, rest = name.partition(" ")
    sign, first = ("−", first[1:]) if first.startswith("-") else ("", first)
    read = symbol.read(first)
    mark, base, index, rest = sign + read.mark, read.base, read.index, space + rest
    return Name(mark, base, index, rest), _width(mark + base + rest, FONT) + _width(index, INDEX)


def _width(text: str, size: float) -> float:
    """Width of a text in a serif face, estimated from its small, capital and wide characters."""
    narrow, small = " .,:;'()|", 0.48
    return size * sum(
        0.3 if c in narrow else small if c.islower() or c.isdigit() else 0.72 if c < "\u1100" else 1.0 for c in text
    )


def reach(half: complex, n: complex) -> float:
    """How far a box of half size ``half`` reaches from its centre in direction n."""
    return abs(half.real * n.real) + abs(half.imag * n.imag)


def beside(half: complex, a: complex, b: complex, r: float = 0.0) -> Iterator[complex]:
    """Beside the line ab of half width r, first on its left."""
    n = -1j * unit(b - a)
    for t in (0.5, 0.36, 0.64, 0.24, 0.76):
        for side in (n, -n):
            yield a + t * (b - a) + side * (r + GAP + reach(half, n))


def inside(half: complex, *points: complex) -> Iterator[complex]:
    """In the middle of a polygon, or outside beside its edges."""
    middle = sum(points) / len(points)
    yield middle
    for a, b in pairwise((*points, points[0])):
        m = (a + b) / 2
        n = 1j * unit(b - a)
        if (n.conjugate() * (m - middle)).real < 0:
            n = -n
        yield m + n * (GAP + reach(half, n))


def past(half: complex, a: complex, b: complex) -> Iterator[complex]:
    """At the end b of the arrow ab: beyond it or on its sides; then beside it, and round its end."""
    u, size = unit(b - a), length(b - a)
    ends = ((0, u), (5, 1j * u), (5, -1j * u), (20, 1j * u), (20, -1j * u))
    along = ((t * size, n) for t in (0.35, 0.6) for n in (1j * u, -1j * u) if size > 4 * GAP)
    farther = [(0, u * rect(1, turn)) for turn in (0, 0.8, -0.8, 1.6, -1.6, 2.4, -2.4, pi)]
    for gap, places in ((GAP, ends), (2 * GAP, ends), (GAP, along), (4 * GAP, farther), (7 * GAP, farther)):
        for back, n in places:
            yield b - back * u + n * (gap + reach(half, n))


def place(labels: Iterable[Label], texts: list[Text], lines: Segments, low: complex, high: complex) -> None:
    """Add each name to ``texts`` at the first of its places free of lines and other texts, or at the least bad."""
    a, b, weight = lines
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
        for _, c, r in texts:
            apart, least = c - centre, r + half + _APART
            clashes += abs(apart.real) < least.real and abs(apart.imag) < least.imag
        return float(0.3 * ink + 50 * clashes + 100 * outside)

    for name, half, places in labels:
        best, least = 0j, inf
        for rank, at in enumerate(places):
            if rank >= least:
                break
            if (total := rank + cost(at, half)) < least:
                best, least = at, total
        texts.append(Text(name, best, half))


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
