"""Line charts as SVG, in the page's own colours: symbols with indices, units, marked positions, values to show."""

import json
from collections.abc import Iterator, Sequence
from html import escape
from itertools import groupby
from math import ceil, floor, isfinite, log10
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from mechsheet import units
from mechsheet.worksheet import symbol
from mechsheet.worksheet.table import MARKED

# Legible on white and on black; dashes tell lines apart on paper without colours.
COLOURS = ("#3b82d0", "#e0483c", "#2c9c5c", "#cf7a17", "#8b6fd6", "#1aa3a8", "#c2528b", "#8a8a3a")
_DASHES = ("", "9 3", "3 3", "9 3 2 3")
WIDTH, HEIGHT = 660, 330  # of the picture [px]
_LEFT, _RIGHT, _TOP, _BOTTOM = 74, 16, 34, 46  # from its edges to the axes
_FONT = 13


class Quantity(Protocol):
    """What a chart shows of a column: values are in ``unit``."""

    @property
    def symbol(self) -> str: ...
    @property
    def unit(self) -> str: ...
    @property
    def decimals(self) -> int: ...
    @property
    def values(self) -> NDArray[np.float64]: ...


def line_chart(x: Quantity, lines: Sequence[Quantity], marks: Sequence[tuple[str, float]] = (), every: int = 1) -> str:
    """Curves of ``lines`` over ``x`` as one SVG element; a value that is not finite is a gap.

    Every so many of the values are marked by a point, unless they are many. ``marks`` are named positions on the x axis
    in its unit. A position that the page sets by `mark` is marked too.
    """
    across = _axis([x.values, *([m] for _, m in marks)], x.unit)
    up = _axis([line.values for line in lines], lines[0].unit)
    width, height = WIDTH - _LEFT - _RIGHT, HEIGHT - _TOP - _BOTTOM
    k_x, k_y = width / (across.high - across.low), -height / (up.high - up.low)
    px = k_x * (np.asarray(x.values, dtype=float) - across.low)
    inside = []
    for i, line in enumerate(lines):
        colour, dash = COLOURS[i % len(COLOURS)], _dash(i)
        py = height + k_y * (np.asarray(line.values, dtype=float) - up.low)
        inside.append(f'<path stroke="{colour}" stroke-width="1.8"{dash} d="{_path(px, py)}"/>')
        if len(px[::every]) <= MARKED:
            dots = "".join(
                f'<circle cx="{u:.1f}" cy="{v:.1f}" r="2.6"/>'
                for u, v in zip(px[::every].tolist(), py[::every].tolist(), strict=True)
                if isfinite(u) and isfinite(v)
            )
            inside.append(f'<g fill="{colour}" stroke="none">{dots}</g>')
    for name, m in marks:
        u = k_x * (m - across.low)
        inside.append(
            f'<path class="ms-mark" stroke-dasharray="5 4" stroke-opacity=".7" d="M{u:.1f} 0V{height}"/>'
            + _text(u + 5, 14, symbol.svg(name), "start")
        )
    scale, low = units.parse(x.unit).factor / k_x, across.low * units.parse(x.unit).factor
    inside.append(
        f'<path class="ms-at" stroke="#e0483c" stroke-width="1.5" d="M0 0V{height}" style="transform:'
        f'translateX(calc((var({variable(x.symbol)},-1e30) - {low!r}) / {scale!r} * 1px))"/>'
    )
    grid = "".join(f"M{k_x * (t - across.low):.1f} 0V{height}" for t in across.ticks)
    grid += "".join(f"M0 {height + k_y * (t - up.low):.1f}H{width}" for t in up.ticks)
    plot = (
        f'<svg x="{_LEFT}" y="{_TOP}" width="{width}" height="{height}" viewBox="0 0 {width} {height}">'
        f'<path stroke-opacity=".16" stroke-width="1" d="{grid}"/>{"".join(inside)}</svg>'
    )
    texts = [
        _text(_LEFT + k_x * (t - across.low), HEIGHT - _BOTTOM + 17, across.text(t), "middle") for t in across.ticks
    ]
    texts += [_text(_LEFT - 7, HEIGHT - _BOTTOM + k_y * (t - up.low) + 4, up.text(t), "end") for t in up.ticks]
    texts.append(_text(_LEFT + width / 2, HEIGHT - 8, _title([x], across.power), "middle"))
    turned = f'<g transform="translate(16 {_TOP + height / 2}) rotate(-90)">{{}}</g>'
    texts.append(turned.format(_text(0, 0, _title(lines, up.power), "middle")))
    if len(lines) > 1:
        texts += _legend(lines)
    frame = f'<path stroke-opacity=".6" d="M{_LEFT} {_TOP}V{HEIGHT - _BOTTOM}H{WIDTH - _RIGHT}"/>'
    values = escape(json.dumps(_values(x, lines, px), ensure_ascii=False, separators=(",", ":")))
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" class="ms-chart" width="{WIDTH}" viewBox="0 0 {WIDTH} {HEIGHT}" '
        f'style="max-width:100%;height:auto" fill="none" stroke="currentColor" stroke-linejoin="round" '
        f'data-values="{values}">{frame}{plot}'
        f'<g fill="currentColor" stroke="none" font-size="{_FONT}">{"".join(texts)}</g></svg>'
    )


def variable(name: str) -> str:
    """Name of the style that holds the moving position on an axis."""
    return f"--at-{name}"


class _Axis:
    """Ends, ticks and number format of an axis; numbers are shown divided by ten to the ``power``."""

    def __init__(self, low: float, high: float, unit: str, count: int, whole: bool) -> None:
        if not high - low > 1e-9 * max(abs(low), abs(high)):
            half = abs(low) / 2 or 0.5
            low, high = low - half, high + half
        rough = (high - low) / count
        tenth = 10.0 ** floor(log10(rough))
        steps = (1.5, 3, 4.5, 6, 9, 18) if unit == "deg" and tenth == 10 else (1, 2, 2.5, 5, 10)
        step = next(m * tenth for m in steps if m * tenth >= 0.999 * rough)
        first, last = (floor(low / step + 1e-9), ceil(high / step - 1e-9)) if whole else (low / step, high / step)
        self.low, self.high = first * step, last * step
        self.ticks = [i * step for i in range(ceil(first - 1e-9), floor(last + 1e-9) + 1)]
        largest = max(abs(self.low), abs(self.high))
        self.power = 3 * floor(log10(largest) / 3) if not 1e-2 <= largest < 1e5 else 0
        self.decimals = max(0, -floor(log10(step / 10.0**self.power) + 1e-9) + (step / tenth == 2.5))

    def text(self, tick: float) -> str:
        return f"{tick / 10.0**self.power:z.{self.decimals}f}".replace("-", "−")


def _axis(values: Sequence[Sequence[float] | NDArray[np.float64]], unit: str, count: int = 6) -> _Axis:
    every = np.concatenate([np.ravel(np.asarray(v, dtype=float)) for v in values])
    every = every[np.isfinite(every)]
    low, high = (float(every.min()), float(every.max())) if every.size else (0.0, 1.0)
    return _Axis(low, high, unit, count, whole=True)


def _dash(i: int) -> str:
    dash = _DASHES[i % len(_DASHES)]
    return f' stroke-dasharray="{dash}"' if dash else ""


def _path(px: NDArray[np.float64], py: NDArray[np.float64]) -> str:
    pieces = []
    for drawn, run in groupby(zip(px.tolist(), py.tolist(), strict=True), key=lambda p: isfinite(p[0] + p[1])):
        if drawn:
            pieces.append("M" + "L".join([f"{u:.1f} {v:.1f}" for u, v in run]))
    return "".join(pieces)


def _text(x: float, y: float, text: str, anchor: str) -> str:
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" fill="currentColor" stroke="none">{text}</text>'


def _title(quantities: Sequence[Quantity], power: int) -> str:
    """Symbols and units of an axis: ``S [m]``, ``G56, GS6 [N]``; a power of ten goes before the unit."""
    parts = []
    for unit, members in groupby(quantities, key=lambda q: q.unit):
        symbols = ", ".join(symbol.svg(q.symbol) for q in members)
        factor = f"10{units.raised(power)} " if power else ""
        shown = f"{factor}{units.shown(unit)}" if unit != "-" else factor.strip()
        parts.append(f"{symbols} [{escape(shown)}]" if shown else symbols)
    return "; ".join(parts)


def _legend(lines: Sequence[Quantity]) -> Iterator[str]:
    left = float(_LEFT)
    for i, line in enumerate(lines):
        yield (
            f'<path stroke="{COLOURS[i % len(COLOURS)]}" stroke-width="2.2"{_dash(i)} fill="none" '
            f'd="M{left:.0f} 17h26"/>' + _text(left + 31, 21, symbol.svg(line.symbol), "start")
        )
        left += 31 + 9 * len(symbol.text(line.symbol)) + 16


def _values(x: Quantity, lines: Sequence[Quantity], px: NDArray[np.float64]) -> dict[str, object]:
    """What hovering shows: places [px of the picture], and texts of the quantities there."""
    quantities = [x, *lines]
    return {
        "at": [round(_LEFT + u, 1) if isfinite(u) else None for u in px.tolist()],
        "names": [symbol.html(q.symbol) for q in quantities],
        "units": ["" if q.unit == "-" else units.shown(q.unit) for q in quantities],
        "texts": [[f"{v:z.{q.decimals}f}" if isfinite(v) else "–" for v in q.values.tolist()] for q in quantities],
    }
