"""Charts as SVG, in the page's own colours; hovering and moving positions find their data in it."""

from collections.abc import Iterable
from functools import lru_cache
from html import escape
from itertools import groupby
from math import isfinite
from operator import itemgetter
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mechsheet.document.chart import Chart, Curve, Label, Mark, Sample, Stroke, told
from mechsheet.document.markup import attribute, named
from mechsheet.worksheet.symbol import Symbol, is_slanted

_FONT = 13
_MOVING = "#e0483c"


def svg(chart: Chart) -> str:
    """A chart as one SVG element."""
    plot, frame = chart.plot, f"M{chart.plot.left} {chart.plot.top}"
    inside = "".join([*map(_curve, chart.curves), *(_mark(mark, plot.height) for mark in chart.marks), _moving(chart)])
    grid = "".join(f"M{u:z.1f} 0V{plot.height}" for u in chart.columns)
    grid += "".join(f"M0 {v:z.1f}H{plot.width}" for v in chart.rows)
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" class="ms-chart" width="{chart.width}" '
        f'viewBox="0 0 {chart.width} {chart.height}" '
        f'style="max-width:100%;height:auto" fill="none" stroke="currentColor" stroke-linejoin="round"'
        f"{attribute('data-values', _values(chart))}>"
        f'<path stroke-opacity=".6" d="{frame}V{plot.top + plot.height}H{plot.left + plot.width}"/>'
        f'<svg x="{plot.left}" y="{plot.top}" width="{plot.width}" height="{plot.height}" '
        f'viewBox="0 0 {plot.width} {plot.height}">'
        f'<path stroke-opacity=".16" stroke-width="1" d="{grid}"/>{inside}</svg>'
        f'<g fill="currentColor" stroke="none" font-size="{_FONT}">'
        f"{''.join([*map(_text, chart.texts), *map(_sample, chart.legend)])}</g></svg>"
    )


def inline(parts: Iterable[Symbol | str]) -> str:
    """Inside of a ``<text>`` element: symbols and words."""
    return "".join(escape(part) if isinstance(part, str) else _symbol(part) for part in parts)


def variable(name: str) -> str:
    """Name of the style that holds the moving position on an axis."""
    return f"--at-{name}"


def _moving(chart: Chart) -> str:
    """The position that the page moves, in SI."""
    return (
        f'<path class="ms-at" stroke="{_MOVING}" stroke-width="1.5" d="M0 0V{chart.plot.height}" style="transform:'
        f'translateX(calc((var({variable(chart.over)},-1e30) - {chart.low!r}) / {chart.scale!r} * 1px))"/>'
    )


def _dashed(stroke: Stroke) -> str:
    return f' stroke-dasharray="{" ".join(map(str, stroke.dashes))}"' if stroke.dashes else ""


def _curve(curve: Curve) -> str:
    colour = curve.stroke.colour
    line = f'<path stroke="{colour}" stroke-width="1.8"{_dashed(curve.stroke)} d="{_path(curve.x, curve.y)}"/>'
    if curve.dots is None:
        return line
    dots = "".join(
        f'<circle cx="{u:.1f}" cy="{v:.1f}" r="2.6"/>'
        for u, v in zip(curve.x[curve.dots].tolist(), curve.y[curve.dots].tolist(), strict=True)
        if isfinite(u) and isfinite(v)
    )
    return f'{line}<g fill="{colour}" stroke="none">{dots}</g>'


def _mark(mark: Mark, height: float) -> str:
    line = f'<path class="ms-mark" stroke-dasharray="5 4" stroke-opacity=".7" d="M{mark.x:.1f} 0V{height}"/>'
    return line + _text(Label(mark.x + 5, 14, (mark.symbol,), "start"))


def _sample(sample: Sample) -> str:
    return (
        f'<path stroke="{sample.stroke.colour}" stroke-width="2.2"{_dashed(sample.stroke)} fill="none" '
        f'd="M{sample.x:.0f} {sample.y:.0f}h{sample.length:.0f}"/>{_text(sample.label)}'
    )


def _path(px: NDArray[np.float64], py: NDArray[np.float64]) -> str:
    points = zip(np.isfinite(px + py).tolist(), px.tolist(), py.tolist(), strict=True)
    runs = (run for drawn, run in groupby(points, key=itemgetter(0)) if drawn)
    return "".join("M" + "L".join([f"{u:.1f} {v:.1f}" for _, u, v in run]) for run in runs)


def _text(label: Label) -> str:
    x, y = (0.0, 0.0) if label.upright else (label.x, label.y)
    text = (
        f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{label.anchor}" fill="currentColor" stroke="none">'
        f"{inline(label.parts)}</text>"
    )
    return f'<g transform="translate({label.x} {label.y}) rotate(-90)">{text}</g>' if label.upright else text


@lru_cache(maxsize=1024)
def _symbol(name: Symbol) -> str:
    """Inside of a ``<text>`` element: a symbol, its index lowered."""
    mark, base = (f'<tspan font-style="italic">{x}</tspan>' if is_slanted(x) else x for x in (name.mark, name.base))
    # the last part, of no width, takes what follows back to the line
    index = f'<tspan dy="4" font-size="11">{name.index}</tspan><tspan dy="-4">\u200b</tspan>'
    return mark + base + (index if name.index else "")


def _values(chart: Chart) -> dict[str, Any]:
    """What the pointer shows: places [px of the picture], texts of the quantities there, and the axes."""
    left = chart.plot.left
    return {
        "at": [round(left + u, 1) if isfinite(u) else None for u in chart.curves[0].x.tolist()],
        "names": [named(reading.name) for reading in chart.readings],
        "units": [reading.unit for reading in chart.readings],
        "texts": [reading.texts for reading in chart.readings],
        "axes": [told(axis, unit, axis.power) for axis, unit in zip(chart.axes, chart.axis_units, strict=True)],
    }
