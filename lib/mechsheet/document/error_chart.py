"""Charts of errors: error over run time, digits kept over digits expected."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any, ClassVar, Protocol

import numpy as np

from mechsheet import units
from mechsheet.document.chart import COLOURS
from mechsheet.worksheet.shown import Charted
from mechsheet.worksheet.table import Column, Figure

FULL = 16.0  # digits of a float
SPARE = 1.0  # digits that a result may lose beyond its condition number


class Plotted(Protocol):
    """What a chart shows of a method: its error, the median of its run times [s], and the methods of its family."""

    @property
    def family(self) -> str: ...
    @property
    def setting(self) -> str: ...
    @property
    def error(self) -> float: ...
    @property
    def seconds(self) -> float: ...


class Kept(Protocol):
    """What a chart shows of a result: digits expected, and those that the printed formulas and the product keep."""

    @property
    def scene(self) -> str: ...
    @property
    def case(self) -> str: ...
    @property
    def result(self) -> str: ...
    @property
    def wanted(self) -> str: ...
    @property
    def expected(self) -> float: ...
    @property
    def printed(self) -> float: ...
    @property
    def product(self) -> float: ...


@dataclass(frozen=True)
class DigitsKept(Charted):
    """Chart of the digits kept over the digits expected: every result of every scene."""

    outcomes: Sequence[Kept]

    def chart(self) -> Any:
        """The altair chart; above the solid line lies more than can be expected, below the dashed one too little."""
        import altair as alt  # on use: only a page needs it

        measured = [o for o in self.outcomes if not o.wanted]
        ways = {"printed formulas": [o.printed for o in measured], "product": [o.product for o in measured]}
        points = [
            {"expected": o.expected, "kept": kept, "way": way, "scene": o.scene, "case": o.case, "result": o.result}
            for way, digits in ways.items()
            for o, kept in zip(measured, digits, strict=True)
            if np.isfinite(kept)
        ]
        colour = alt.Color("way:N", title=None, sort=[*ways], legend=alt.Legend(orient="top"))
        base = alt.Chart(alt.InlineData(points)).encode(
            x=alt.X("expected:Q", title="digits expected, 16 - log κ", scale=alt.Scale(domain=[0, FULL])),
            y=alt.Y("kept:Q", title="digits kept", scale=alt.Scale(domain=[0, FULL])),
            color=colour.scale(domain=[*ways], range=[COLOURS[3], COLOURS[0]]),
            tooltip=["scene:N", "case:N", "result:N", alt.Tooltip("expected:Q", format=".1f"), "kept:Q"],
        )
        ends = [{"x": 0.0, "y": 0.0, "spared": -SPARE}, {"x": FULL, "y": FULL, "spared": FULL - SPARE}]
        lines = alt.Chart(alt.InlineData(ends)).encode(x="x:Q")
        return alt.layer(
            base.mark_circle(size=14, opacity=0.5, clip=True),
            lines.mark_line(color="gray").encode(y="y:Q"),
            lines.mark_line(color="gray", strokeDash=[5, 4], clip=True).encode(y="spared:Q"),
        ).properties(width=560, height=420, usermeta={"embedOptions": {"renderer": "svg"}})


@dataclass(frozen=True)
class WorkPrecision(Charted, Figure):
    """Error over run time, both logarithmic: one line a family.

    Where there is a method of the product's own, it is marked, and a field shaded red: whatever is both faster and
    more accurate would lie there. Errors in the grey band are rounding and count as equal. A dashed line joins the
    methods of the front.
    """

    rows: Sequence[Plotted] = field(kw_only=True)
    own: Plotted | None = None
    front: Sequence[Plotted] = ()
    noise: float = 0.0  # within which errors count as equal

    logarithmic: ClassVar[bool] = True

    def series(self) -> list[tuple[Column, slice, str]]:
        return [(self.lines[0], rows, name) for name, rows in families(self.rows)]

    def chart(self) -> Any:
        """The diagram as an altair chart."""
        import altair as alt  # on use: only a page needs it

        names = [name for name, _ in families(self.rows)]
        points = [
            {"method": row.family, "setting": row.setting, "error": row.error, "ms": 1e3 * row.seconds}
            | {"x": float(x), "order": i}
            for i, (row, x) in enumerate(zip(self.rows, self.x.values, strict=True))
        ]
        x_marks = _decades(self.x.values)
        y_marks = [mark for mark in _decades(self.lines[0].values) if mark <= 1]
        title = f"{self.x.meaning} [{units.shown(self.x.unit)}]".removesuffix(" [-]")
        x = alt.X("x:Q", title=title).axis(values=x_marks, format="~g").scale(**_log(x_marks))
        y = alt.Y("error:Q", title="error").axis(values=y_marks[:: 1 + len(y_marks) // 10], format=".0e")
        y = y.scale(**_log(y_marks))
        looks = [_OTHERS[i % len(_OTHERS)] for i in range(len(names))]
        looks = [_OWN, *looks[:-1]] if self.own else looks
        legend = alt.Legend(title=None, orient="right", labelLimit=260, symbolSize=90, rowPadding=5)
        color, shape = (
            channel("method:N", sort=names, legend=legend).scale(domain=names, range=look)
            for channel, look in zip((alt.Color, alt.Shape), zip(*looks, strict=True), strict=True)
        )
        tooltip = [
            *(alt.Tooltip("method:N"), alt.Tooltip("setting:N"), alt.Tooltip("error:Q", format=".2e")),
            *(alt.Tooltip("ms:Q", title="time, ms", format=".3f"), alt.Tooltip("x:Q", title=self.x.symbol)),
        ]
        base = alt.Chart(alt.InlineData(points)).encode(x=x, y=y, color=color)
        layers = [
            base.mark_line(strokeWidth=1.6, opacity=0.75).encode(order="order:Q"),
            base.mark_point(filled=True, size=46, opacity=0.9).encode(shape=shape, tooltip=tooltip),
        ]
        if self.own:
            marked = base.transform_filter(alt.datum.method == self.own.family).encode(shape=shape, tooltip=tooltip)
            behind = self._behind(self.own, (x_marks[0], x_marks[-1]), (y_marks[0], y_marks[-1]))
            layers = [*(layer.encode(x=x, y=y) for layer in behind), *layers]
            layers.append(marked.mark_point(filled=True, size=260, opacity=1))
        title = f"Figure {self.number} – {self.title}"
        sharp = {"embedOptions": {"renderer": "svg"}}  # on paper too
        chart = alt.layer(*layers).properties(title=title, width=560, height=360, usermeta=sharp)
        return chart.configure_axis(labelFontSize=12, titleFontSize=12, titleFontWeight="normal").configure_legend(
            labelFontSize=13
        )

    def _behind(self, own: Plotted, x_ends: tuple[float, float], y_ends: tuple[float, float]) -> list[Any]:
        """What lies behind the points: the band of rounding, the field of better methods and the front."""
        import altair as alt  # on use: only a page needs it

        def field(color: str, right: float, low: float, high: float) -> Any:
            corners = alt.InlineData([{"x": x_ends[0], "right": right, "error": low, "high": high}])
            return alt.Chart(corners).mark_rect(color=color, opacity=0.13).encode(x2="right:Q", y2="high:Q")

        place = float(self.x.values[self.rows.index(own)])
        low, layers = max(y_ends[0], self.noise), list[Any]()
        if y_ends[0] < low:
            text = alt.Chart(alt.InlineData([{"x": x_ends[0], "error": y_ends[0]}])).mark_text(
                text="rounding", align="left", baseline="bottom", dx=5, dy=-4, fontSize=11, color=_GREY
            )
            layers += [field(_GREY, x_ends[1], y_ends[0], low), text]
        if own.error > low:
            layers.append(field(_OWN[0], place, low, own.error))
        steps = [{"x": place * row.seconds / own.seconds, "error": row.error} for row in self.front]
        steps = [{**steps[0], "error": y_ends[1]}, *steps, {**steps[-1], "x": x_ends[1]}]
        front = alt.Chart(alt.InlineData(steps)).mark_line(
            interpolate="step-after", color=_GREY, strokeDash=[4, 4], strokeWidth=1
        )
        return [*layers, front]


_OWN = ("#D1495B", "diamond")
_GREY = "#6B7280"
_SHAPES = ("circle", "square", "triangle-up", "triangle-down", "cross", "triangle-right", "triangle-left", "stroke")
_OTHERS = tuple(zip((c for c in COLOURS if c != "#e0483c"), _SHAPES, strict=False))  # none of the product's own red


def families(rows: Sequence[Plotted]) -> list[tuple[str, slice]]:
    """Neighbours of one family, by its name."""
    starts = [i for i, row in enumerate(rows) if i == 0 or row.family != rows[i - 1].family]
    return [(rows[a].family, slice(a, b)) for a, b in zip(starts, [*starts[1:], len(rows)], strict=True)]


def _decades(values: Any) -> list[float]:
    """Powers of ten around the values, with some room beside them."""
    room = 0.15  # of a decade
    low, high = np.log10(np.min(values)) - room, np.log10(np.max(values)) + room
    return [10.0**k for k in range(int(np.floor(low)), int(np.ceil(high)) + 1)]


def _log(marks: Sequence[float]) -> dict[str, Any]:
    """A logarithmic scale from the first mark to the last."""
    return {"type": "log", "domain": (marks[0], marks[-1]), "nice": False}
