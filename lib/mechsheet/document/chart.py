"""Layout of line charts, whoever draws them: curves, ticks, marks, legend and texts in coordinates of the picture."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import groupby
from math import isfinite
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from mechsheet import units
from mechsheet.document.axis import Axis, axis
from mechsheet.worksheet import numbers
from mechsheet.worksheet.symbol import Symbol, read, stem
from mechsheet.worksheet.table import MARKED

# Legible on white and on black; dashes tell lines apart on paper without colours.
COLOURS = ("#3b82d0", "#e0483c", "#2c9c5c", "#cf7a17", "#8b6fd6", "#1aa3a8", "#c2528b", "#8a8a3a")
_DASHES = ((), (9, 3), (3, 3), (9, 3, 2, 3))
WIDTH, HEIGHT = 660, 330  # of the picture [px]
_LEFT, _RIGHT, _TOP, _BOTTOM = 74, 24, 34, 46  # from its edges to the axes
_SAMPLE, _LETTER = 26, 9  # of the legend: a piece of the line, about a letter


class Plotted(Protocol):
    """What a chart shows of a column: values are in ``unit``."""

    @property
    def symbol(self) -> str: ...
    @property
    def name(self) -> str: ...
    @property
    def unit(self) -> str: ...
    @property
    def decimals(self) -> int: ...
    @property
    def values(self) -> NDArray[np.float64]: ...


@dataclass(frozen=True)
class Box:
    """A rectangle in the picture [px]."""

    left: float
    top: float
    width: float
    height: float


@dataclass(frozen=True)
class Label:
    """A text at a point of the picture: symbols and words; ``anchor`` is ``start``, ``middle`` or ``end``."""

    x: float
    y: float
    parts: tuple[Symbol | str, ...]
    anchor: str
    upright: bool = False  # read from below


@dataclass(frozen=True)
class Stroke:
    """Colour of a line and the lengths of its dashes and gaps, none for a full line."""

    colour: str
    dashes: tuple[int, ...]


@dataclass(frozen=True, eq=False)
class Curve:
    """Points of a line from the corner of the plot, NaN where it has a gap; ``dots`` are those marked one by one."""

    stroke: Stroke
    x: NDArray[np.float64]
    y: NDArray[np.float64]
    dots: slice | None


@dataclass(frozen=True)
class Mark:
    """A vertical line at a named position, from the corner of the plot."""

    x: float
    symbol: Symbol


@dataclass(frozen=True)
class Sample:
    """A piece of a line in the legend, from ``x`` on, and the name of the line behind it."""

    stroke: Stroke
    x: float
    y: float
    length: float
    label: Label


@dataclass(frozen=True)
class Reading:
    """What hovering tells of a quantity: its name, its unit and a text at each value of x."""

    name: str
    unit: str
    texts: tuple[str, ...]


@dataclass(frozen=True, eq=False)
class Chart:
    """A chart as it is drawn; what lies inside ``plot`` counts from its upper left corner [px]."""

    width: float
    height: float
    plot: Box
    curves: tuple[Curve, ...]
    marks: tuple[Mark, ...]
    columns: tuple[float, ...]  # of the grid
    rows: tuple[float, ...]
    texts: tuple[Label, ...]
    legend: tuple[Sample, ...]
    over: str  # name of the quantity across
    low: float  # its value at the left edge, in SI
    scale: float  # of it, SI units a pixel
    readings: tuple[Reading, ...]
    axes: tuple[Axis, Axis]  # across and up, in the units of the first quantities on them
    axis_units: tuple[str, str]


@dataclass(frozen=True)
class Ticks:
    """Ticks of an axis in another unit: their places inside the plot [px], how they are written, and that unit."""

    at: tuple[float, ...]
    texts: tuple[str, ...]
    unit: str
    axis: dict[str, Any]


def told(of: Axis, unit: str, power: int, factor: float = 1.0) -> dict[str, Any]:
    """What a page must know of an axis in a unit to show a part of it; ``factor`` of these are one of its own unit."""
    return {"low": of.low * factor, "high": of.high * factor, "power": power, "unit": unit, "factor": factor}


def ticks(chart: Chart, up: bool, unit: str, other: str) -> Ticks:
    """Round ticks of the axis across or ``up`` in another unit than its own, where it ends as it does."""
    own, factor = chart.axes[up], units.parse(unit).factor / units.parse(other).factor
    ends = own.low * factor, own.high * factor
    made = axis([ends], other, count=8)
    inside = [t for t in made.ticks if ends[0] - 1e-9 * made.step <= t <= ends[1] + 1e-9 * made.step]
    length = chart.plot.height if up else chart.plot.width
    parts = [(t - ends[0]) / (ends[1] - ends[0]) * length for t in inside]
    places = [length - part for part in parts] if up else parts
    rounded, texts = tuple(round(u, 1) for u in places), tuple(map(made.text, inside))
    return Ticks(rounded, texts, _unit(other, made.power), told(own, other, made.power, factor))


def line_chart(x: Plotted, lines: Sequence[Plotted], marks: Sequence[tuple[str, float]] = (), every: int = 1) -> Chart:
    """Curves of ``lines`` over ``x``; a value that is not finite is a gap.

    Every so many of the values are marked by a point, unless they are many. ``marks`` are named positions on the x axis
    in its unit. A position that the page sets by `mark` is marked too.
    """
    across = axis([x.values, *([m] for _, m in marks)], x.unit)
    up = axis([line.values for line in lines], lines[0].unit)
    plot = Box(_LEFT, _TOP, WIDTH - _LEFT - _RIGHT, HEIGHT - _TOP - _BOTTOM)
    k_x, k_y = plot.width / (across.high - across.low), -plot.height / (up.high - up.low)
    px = k_x * (np.asarray(x.values, dtype=float) - across.low)
    dots = slice(None, None, every) if len(px[::every]) <= MARKED else None
    curves = (
        Curve(_stroke(i), px, plot.height + k_y * (np.asarray(line.values, dtype=float) - up.low), dots)
        for i, line in enumerate(lines)
    )
    columns = tuple(k_x * (t - across.low) for t in across.ticks)
    rows = tuple(plot.height + k_y * (t - up.low) for t in up.ticks)
    factor = units.parse(x.unit).factor
    under = HEIGHT - _BOTTOM + 17
    texts = [
        *(Label(_LEFT + u, under, (across.text(t),), "middle") for u, t in zip(columns, across.ticks, strict=True)),
        *(Label(_LEFT - 7, _TOP + v + 4, (up.text(t),), "end") for v, t in zip(rows, up.ticks, strict=True)),
        Label(_LEFT + plot.width / 2, HEIGHT - 8, _title([x], across.power), "middle"),
        Label(16, _TOP + plot.height / 2, _title(lines, up.power), "middle", upright=True),
    ]
    return Chart(
        WIDTH,
        HEIGHT,
        plot,
        tuple(curves),
        tuple(Mark(k_x * (m - across.low), read(stem(name))) for name, m in marks),
        columns,
        rows,
        tuple(texts),
        tuple(_legend(lines)) if len(lines) > 1 else (),
        x.symbol,
        across.low * factor,
        factor / k_x,
        tuple(map(_reading, [x, *lines])),
        (across, up),
        (x.unit, lines[0].unit),
    )


def _stroke(i: int) -> Stroke:
    return Stroke(COLOURS[i % len(COLOURS)], _DASHES[i % len(_DASHES)])


def _title(quantities: Sequence[Plotted], power: int) -> tuple[Symbol | str, ...]:
    """Symbols and units of an axis: ``S [m]``, ``G56, GS6 [N]``; a power of ten goes before the unit.

    Numbers without a unit say so where others have one.
    """
    parts, several = list[Symbol | str](), len({quantity.unit for quantity in quantities}) > 1
    for unit, members in groupby(quantities, key=lambda q: q.unit):
        for i, quantity in enumerate(members):
            parts += [", " if i else "; " if parts else "", read(stem(quantity.name))]
        parts.append(_unit(unit, power) or (" [-]" if several else ""))
    return tuple(part for part in parts if part)


def _unit(unit: str, power: int) -> str:
    factor = f"10{units.raised(power)} " if power else ""
    shown = f"{factor}{units.shown(unit)}" if unit != "-" else factor.strip()
    return f" [{shown}]" if shown else ""


def _legend(lines: Sequence[Plotted]) -> Iterator[Sample]:
    left = float(_LEFT)
    for i, line in enumerate(lines):
        name = read(stem(line.name))
        yield Sample(_stroke(i), left, 17, _SAMPLE, Label(left + _SAMPLE + 5, 21, (name,), "start"))
        left += _SAMPLE + 5 + _LETTER * len(name.mark + name.base + name.index) + 16


def _reading(quantity: Plotted) -> Reading:
    to = numbers.AXIS
    texts = [numbers.fixed(v, quantity.decimals, to) if isfinite(v) else to.none for v in quantity.values.tolist()]
    unit = "" if quantity.unit == "-" else units.shown(quantity.unit)
    return Reading(quantity.name, unit, tuple(texts))
