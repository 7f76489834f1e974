"""Error against run time: the methods of one job, timed turn about in one run, against the truth at 50 digits."""

import os
import platform
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from time import perf_counter
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from mechsheet.accuracy.arithmetic import EPS, relative_error
from mechsheet.document.error_chart import WorkPrecision, families
from mechsheet.quantities.unrepeatable import clock_read
from mechsheet.run.progress import progress
from mechsheet.worksheet.check import Check
from mechsheet.worksheet.table import Column, Table

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


class Timed(NamedTuple):
    """What a run returns, and of its run times the median, the quartiles [s] and the number."""

    result: Any
    seconds: float
    low: float
    high: float
    runs: int


@dataclass(frozen=True)
class Measured:
    """A method with its error, the median of its run times [s], their quartiles [s] and their number."""

    family: str
    setting: str
    error: float
    seconds: float
    low: float = np.nan
    high: float = np.nan
    runs: int = 1

    @property
    def digits(self) -> float:
        """Digits that are right."""
        return float(-np.log10(self.error))


def time_spread(times: Sequence[Timed | Measured]) -> tuple[Column, ...]:
    """Columns of how far run times lie apart, and of how many were taken."""
    seconds, low, high, runs = np.array([(t.seconds, t.low, t.high, t.runs) for t in times]).T
    apart = "half of what lies between the quartiles of the run times, over their median"
    return Column("spread", "%", apart, 0, 50 * (high - low) / seconds), Column("runs", "-", "run times taken", 0, runs)


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
        """A method beside the product's own, in words; its time is the same where the quartiles overlap."""
        own = self.own
        if row is own:
            return "the product's own"
        time = "faster" if row.seconds < _FASTER * own.seconds else "slower"
        if row.low <= own.high and own.low <= row.high:
            time = "the same time"
        if _better(row.error, own.error):
            return f"{time}, more digits"
        if _better(own.error, row.error):
            return f"{time}, fewer digits"
        return "no difference" if time == "the same time" else f"{time}, the same digits"

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
        return self._table([_best(self.rows[part]) for _, part in families(self.rows)], note)

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
            *time_spread(rows),
        )
        return Table(self.number, self.title, columns, note)

    def figure(self) -> WorkPrecision:
        """The work-precision diagram of all methods."""
        _, _, error, _, _, ratio, *_ = self.table().columns
        figure = WorkPrecision(self.number, self.title, ratio, (error,), rows=self.rows)
        return replace(figure, own=self.own, front=self.front, noise=_NOISE)


_ERROR = "largest error over the largest number, at least one rounding, at most 1"


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
            Measured(m.family, m.setting, largest_error(t.result, self.truth), t.seconds, t.low, t.high, t.runs)
            for m, t in zip(self.methods, found, strict=True)
        )
        return Comparison(self.number, self.title, tuple(rows))


def timed(runs: Sequence[Callable[[], Any]], seconds: float, done: Callable[[], object] = lambda: None) -> list[Timed]:
    """What each run returns, and its times, all taken turn about.

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
    quartiles = np.array([np.quantile(taken, (0.5, 0.25, 0.75)) for taken in times]).T.tolist()
    return list(map(Timed, results, *quartiles, map(len, times)))


def times_of_one(
    number: str,
    title: str,
    sizes: Sequence[int],
    given: Callable[[int], Any],
    ways: Mapping[str, Callable[[Any], Any]],
    seconds: float,
) -> Table:
    """Table of the time for one of n that are computed at once by several ways from what is given for n."""
    runs = [partial(way, case) for case in map(given, sizes) for way in ways.values()]
    with progress(len(runs), f"{number} {title}") as done:
        times = timed(runs, seconds, done)
    taken = np.array([(time.seconds, (time.high - time.low) / 2) for time in times]).reshape(len(sizes), -1, 2)
    each = 1e6 * taken / np.array(sizes)[:, None, None]
    columns = [Column(name, "µs", "median time of one of them", 3, each[:, k, 0]) for k, name in enumerate(ways)]
    half = "half of what lies between the quartiles"
    columns += [Column(f"{name} ±", "µs", half, 2, each[:, k, 1]) for k, name in enumerate(ways)]
    return Table(number, title, (Column("count", "-", "computed at once", 0, np.array(sizes, float)), *columns))


def measured_on(number: str) -> Table:
    """Table of what the run times were measured on."""
    cores = np.array([os.cpu_count() or 1])
    facts = {"processor": platform.processor() or platform.machine(), "system": platform.system()}
    facts |= {"software": f"Python {platform.python_version()}, numpy {np.__version__}"}
    columns = (Column(name, "", "", 0, np.array([fact], object)) for name, fact in facts.items())
    return Table(number, "Machine of the run times", (Column("cores", "-", "of the machine", 0, cores), *columns))


def _better(a: float, b: float) -> bool:
    """Whether the error a is less than b by more than the noise of a few roundings or a factor of two."""
    return 2 * a + _NOISE < b


def _best(rows: Sequence[Measured]) -> Measured:
    least = min(row.error for row in rows)
    return min((row for row in rows if not _better(least, row.error)), key=lambda row: row.seconds)
