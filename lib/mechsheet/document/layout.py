"""A drawing laid out: its scale, the scales of its arrows, the box that is shown, and its names in free places."""

from cmath import isfinite
from collections.abc import Mapping, Sequence
from math import floor, inf, log10, nan
from typing import NamedTuple

import numpy as np

from mechsheet.document import labels
from mechsheet.document.elements import LOOKS
from mechsheet.document.labels import Points, Text
from mechsheet.document.picture import Group, Picture
from mechsheet.worksheet.drawing import FAR, MARGIN, Drawing, Element, quantity

_PART = 0.2  # longest arrow and longest scale bar, as a part of the picture


class Layout(NamedTuple):
    """What a writer draws, in px, y down: the box between two corners, groups of marks back to front, and texts."""

    low: complex
    high: complex
    groups: tuple[Group, ...]
    texts: Sequence[Text]


def lay_out(drawing: Drawing) -> Layout:
    """Layout of a drawing: fitted into its size, the scales of points and arrows shown below."""
    elements = (*drawing.behind, *drawing.elements)
    frame = np.ravel(np.asarray([] if drawing.frame is None else drawing.frame, dtype=complex))
    given = [p for p in frame.tolist() if isfinite(p)]
    centre, half = _box(given or [p for e in elements for p in _finite(e.points)])
    longest: dict[str, float] = {}
    for e in elements:
        if e.vector is not None and _finite((*e.points, e.vector)):
            longest[e.unit] = max(labels.length(e.vector), longest.get(e.unit, 0.0))
    auto = {unit: 2 * _PART * max(half.real, half.imag) / v if v else 0.0 for unit, v in longest.items()}
    scales = {**auto, drawing.unit: 1.0, **drawing.scales}
    if not given:
        centre, half = _box([p for e in elements for p in _finite(_ends(e, scales))])
    k = min((drawing.width / 2 - MARGIN) / half.real, (drawing.height / 2 - MARGIN) / half.imag)
    picture = Picture()
    for i, e in enumerate(elements):
        at = [k * (p - centre).conjugate() for p in _ends(e, scales)]
        if all([abs(p.real) < FAR and abs(p.imag) < FAR for p in at]):  # False for NaN
            picture.begin(faint=i < len(drawing.behind))
            LOOKS[e.kind](picture, e, *at)
            picture.end(e.kind, e.tip)
    colours = {drawing.unit: "", **{e.unit: e.colour for e in reversed(elements) if e.vector is not None}}
    bars = {drawing.unit: k} | {unit: k * scales[unit] for unit in longest}
    return _with_names(picture, k * half + (1 + 1j) * MARGIN if given else None, bars, colours)


def _with_names(
    picture: Picture, view: complex | None, scales: Mapping[str, float], colours: Mapping[str, str]
) -> Layout:
    """Names and scale bars added; ``view`` is half the size of the picture if that is given."""
    lines = picture.segments()
    ends = np.concatenate(lines[:2])
    picture.place_labels(lines, *((-view, view) if view else _corners(ends, 60)))
    if view:
        low, high = -view, view
    else:
        boxes = [t.centre + sign * t.half for t in picture.texts for sign in (1, -1)]
        low, high = _corners(np.concatenate([ends, np.array(boxes, dtype=complex)]), 4)
    if picture.groups:
        end = _scale_bars(picture, scales, colours, low.real + 8, high.imag + 20, _PART * (high - low).real)
        high = complex(max(high.real, end), high.imag + 28)
    return Layout(low, high, picture.finished(), picture.texts)


def _scale_bars(
    picture: Picture, scales: Mapping[str, float], colours: Mapping[str, str], left: float, y: float, longest: float
) -> float:
    """Bars of round length side by side at height y, one for each unit that there is; returns where they end."""
    for unit, scale in scales.items():
        if not unit or not 0 < (most := longest / scale if scale else 0.0) < inf:
            continue
        value = _round_below(most)
        end = left + value * scale
        picture.begin()
        if unit == "m":
            picture.line(complex(left, y - 4), complex(left, y), complex(end, y), complex(end, y - 4))
        else:
            picture.arrow(complex(left, y - 3), complex(end, y - 3), colours[unit])
        picture.end("scale", "")
        name, half = labels.plain(quantity(value, unit))
        picture.write(name, complex(end + 8 + half.real, y - 3), half)
        left = end + 2 * half.real + 32
    return left


def _ends(e: Element, scales: Mapping[str, float]) -> tuple[complex, ...]:
    """Points of an element, both ends of an arrow."""
    return e.points if e.vector is None else (*e.points, e.points[0] + scales.get(e.unit, nan) * e.vector)


def _finite(points: Sequence[complex]) -> Sequence[complex]:
    """The points of an element if it is drawn."""
    return points if all(map(isfinite, points)) else ()


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


def _round_below(x: float) -> float:
    """1, 2 or 5 times a power of ten, the largest that does not exceed x > 0."""
    power = 10.0 ** floor(log10(x))
    return next((m * power for m in (5, 2) if m * power <= x), power)
