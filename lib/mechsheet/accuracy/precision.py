"""Error against run time: the methods of one job, timed turn about in one run, against the truth at 50 digits."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from statistics import median
from time import perf_counter
from typing import Any, ClassVar

import numpy as np
from numpy.typing import ArrayLike

from mechsheet.accuracy.arithmetic import EPS
from mechsheet.accuracy.condition import relative_error
from mechsheet.recording.unrepeatable import clock_read
from mechsheet.run.progress import progress
from mechsheet.worksheet.check import Check
from mechsheet.worksheet.shown import Charted
from mechsheet.worksheet.table import Column, Figure, Table

_NOISE = 8 * EPS  # four units in the last place, within which errors count as equal
_FASTER = 0.9  # part of a time that counts as less of it


def largest_error(found: ArrayLike, truth: Iterable[Any]) -> float:
    """Largest error of ``found``, in the order of the exact numbers and relative to the largest of them.

    From one rounding to 1, where no digit is right.

    >>> largest_error([2, 4.5], [2, 4])
    0.125
    """
    values = np.ravel(found)
    error = relative_error(values, list(truth)) if np.isfinite(values).all() else 1.0
    return min(max(error, EPS), 1.0)


@dataclass(frozen=True)
class Method:
    """One way to do a job, with its tolerance, step or size in words."""

    family: str
    setting: str
    run: Callable[[], Any]


@dataclass(frozen=True)
class Measured:
    """A method with its error and the median of its run times [s]."""

    family: str
    setting: str
    error: float
    seconds: float

    @property
    def digits(self) -> float:
        """Digits that are right."""
        return float(-np.log10(self.error))


@dataclass(frozen=True)
class Comparison:
    """The methods of one job; the first row is the product's own one, the rows of a family are neighbours."""

    number: str
    title: str
    rows: tuple[Measured, ...]

    @property
    def own(self) -> Measured:
        return self.rows[0]

    def place(self, row: Measured) -> str:
        """A method beside the product's own, in words."""
        if row is self.own:
            return "the product's own"
        time = "faster" if row.seconds < _FASTER * self.own.seconds else "slower"
        if _better(row.error, self.own.error):
            return f"{time}, more digits"
        return f"{time}, fewer digits" if _better(self.own.error, row.error) else f"{time}, the same digits"

    @property
    def better(self) -> tuple[Measured, ...]:
        """Methods that are both faster and more accurate than the product's own: none, if that is on the front."""
        return tuple(row for row in self.rows if self.place(row) == "faster, more digits")

    @property
    def front(self) -> tuple[Measured, ...]:
        """Methods than which none is both faster and more accurate, from the fastest to the most accurate."""
        front = list[Measured]()
        for row in sorted(self.rows, key=lambda row: (row.seconds, row.error)):
            if not front or row.error < front[-1].error:
                front.append(row)
        return tuple(front)

    def check(self, limit: float = 1.0) -> Check:
        """Check that the product's own method keeps the digits of the most accurate one, but for ``limit`` of them.

        Time is left out: it says nothing on a busy machine.
        """
        best = min(self.rows, key=lambda row: row.error)
        name = f"{self.number} {self.title}: digits fewer than by the most accurate method"
        return Check(name, best.digits - self.own.digits, limit)

    def table(self) -> Table:
        """All methods with all their settings."""
        return self._table(self.rows)

    def summary(self) -> Table:
        """One row a family: its fastest setting among those of as many digits as it has."""
        note = "Each method at its fastest setting among those of its most digits; the workbook holds all settings."
        return self._table([_best(self.rows[part]) for _, part in _slices(self.rows)], note)

    def _table(self, rows: Sequence[Measured], note: str = "") -> Table:
        error, digits, seconds = np.array([(row.error, row.digits, row.seconds) for row in rows]).T
        columns = (
            Column("method", "", "", 0, np.array([row.family for row in rows], object)),
            Column("setting", "", "tolerance, step or size", 0, np.array([row.setting for row in rows], object)),
            Column("error", "-", _ERROR, 1, error, power=True),
            Column("digits", "-", "digits that are right", 1, digits),
            Column("time", "ms", "median of the run times", 3, 1e3 * seconds),
            Column("ratio", "-", "run time, times that of the product's own method", 3, seconds / self.own.seconds),
            Column("place", "", "beside the product's own method", 0, np.array([*map(self.place, rows)], object)),
        )
        return Table(self.number, self.title, columns, note)

    def figure(self) -> "WorkPrecision":
        """The work-precision diagram of all methods."""
        _, _, error, _, _, ratio, _ = self.table().columns
        return WorkPrecision(self.number, self.title, ratio, (error,), rows=self.rows, own=self.own, front=self.front)


_ERROR = "largest error over the largest number, at least one rounding, at most 1"


@dataclass(frozen=True)
class WorkPrecision(Charted, Figure):
    """Error over run time, both logarithmic: one line a family.

    Where there is a method of the product's own, it is marked, and a field shaded red: whatever is both faster and
    more accurate would lie there. Errors in the grey band are rounding and count as equal. A dashed line joins the
    methods of the front.
    """

    rows: tuple[Measured, ...] = field(kw_only=True)
    own: Measured | None = None
    front: tuple[Measured, ...] = ()

    logarithmic: ClassVar[bool] = True

    def series(self) -> list[tuple[Column, slice, str]]:
        return [(self.lines[0], rows, name) for name, rows in _slices(self.rows)]

    def chart(self) -> Any:
        """The diagram as an altair chart."""
        import altair as alt  # on use: only a page needs it

        names = [name for name, _ in _slices(self.rows)]
        points = [
            {"method": row.family, "setting": row.setting, "error": row.error, "ms": 1e3 * row.seconds}
            | {"x": float(x), "order": i}
            for i, (row, x) in enumerate(zip(self.rows, self.x.values, strict=True))
        ]
        x_marks = _decades(self.x.values)
        y_marks = [mark for mark in _decades(self.lines[0].values) if mark <= 1]
        title = f"{self.x.meaning} [{self.x.unit}]".removesuffix(" [-]")
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
        return (
            chart.configure_axis(labelFontSize=12, titleFontSize=12, titleFontWeight="normal", gridColor="#E4E4E4")
            .configure_legend(labelFontSize=13)
            .configure_title(fontSize=14, anchor="start", offset=12)
        )

    def _behind(self, own: Measured, x_ends: tuple[float, float], y_ends: tuple[float, float]) -> list[Any]:
        """What lies behind the points: the band of rounding, the field of better methods and the front."""
        import altair as alt  # on use: only a page needs it

        def field(color: str, right: float, low: float, high: float) -> Any:
            corners = alt.InlineData([{"x": x_ends[0], "right": right, "error": low, "high": high}])
            return alt.Chart(corners).mark_rect(color=color, opacity=0.13).encode(x2="right:Q", y2="high:Q")

        place = float(self.x.values[self.rows.index(own)])
        low, layers = max(y_ends[0], _NOISE), list[Any]()
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
_OTHERS = (
    *(("#1F4E79", "circle"), ("#2E8B8B", "square"), ("#EDAE49", "triangle-up"), ("#7030A0", "triangle-down")),
    *(("#548235", "cross"), ("#8C564B", "triangle-right"), (_GREY, "triangle-left"), ("#3D9BE9", "circle")),
)


@dataclass(frozen=True)
class Job:
    """What is to be computed: its numbers at 50 digits, and all methods.

    The product's own method is the first; those of a family are next to each other.
    """

    number: str
    title: str
    truth: Sequence[Any]
    methods: Sequence[Method]

    def compare(self, seconds: float) -> Comparison:
        """Run the methods turn about, and compare the medians of their run times and their errors; see `timed`."""
        with progress(len(self.methods), f"{self.number} {self.title}") as done:
            found = timed([method.run for method in self.methods], seconds, done)
        rows = (
            Measured(m.family, m.setting, largest_error(result, self.truth), time)
            for m, (result, time) in zip(self.methods, found, strict=True)
        )
        return Comparison(self.number, self.title, tuple(rows))


def timed(
    runs: Sequence[Callable[[], Any]], seconds: float, done: Callable[[], object] = lambda: None
) -> list[tuple[Any, float]]:
    """What each run returns, and the median of its times [s], all taken turn about.

    A run that was made three times and takes ``seconds`` in all, or ten times as long, is left out of further turns.
    ``done`` is called when a run has its turn the first time.
    """
    clock_read()
    results, times = [], [list[float]() for _ in runs]

    def once(i: int) -> Any:
        start = perf_counter()
        result = runs[i]()
        times[i].append(perf_counter() - start)
        return result

    for i in range(len(runs)):
        results.append(once(i))
        done()
    for taken in times:
        if taken[0] < seconds / 3:  # the first run of a fast method is spent on caches
            taken.clear()
    while waiting := [i for i, taken in enumerate(times) if sum(taken) < (seconds if len(taken) > 2 else 10 * seconds)]:
        for i in waiting:
            once(i)
    return [(result, median(taken)) for result, taken in zip(results, times, strict=True)]


def _better(a: float, b: float) -> bool:
    """Whether the error a is less than b by more than the noise of a few roundings or a factor of two."""
    return 2 * a + _NOISE < b


def _slices(rows: Sequence[Measured]) -> list[tuple[str, slice]]:
    starts = [i for i, row in enumerate(rows) if i == 0 or row.family != rows[i - 1].family]
    return [(rows[a].family, slice(a, b)) for a, b in zip(starts, [*starts[1:], len(rows)], strict=True)]


def _best(rows: Sequence[Measured]) -> Measured:
    least = min(row.error for row in rows)
    return min((row for row in rows if not _better(least, row.error)), key=lambda row: row.seconds)


def _decades(values: Any) -> list[float]:
    """Powers of ten around the values, with some room beside them."""
    room = 0.15  # of a decade
    low, high = np.log10(np.min(values)) - room, np.log10(np.max(values)) + room
    return [10.0**k for k in range(int(np.floor(low)), int(np.ceil(high)) + 1)]


def _log(marks: Sequence[float]) -> dict[str, Any]:
    """A logarithmic scale from the first mark to the last."""
    return {"type": "log", "domain": (marks[0], marks[-1]), "nice": False}
