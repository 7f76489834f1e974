"""Error against run time: the methods of one job, timed turn about in one run, against the truth at 50 digits."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from mechsheet.accuracy.arithmetic import EPS, relative_error
from mechsheet.accuracy.timing import STEPS, TURNS, time_spread, timed
from mechsheet.document.error_chart import WorkPrecision, families
from mechsheet.run.progress import progress
from mechsheet.worksheet.check import Check
from mechsheet.worksheet.table import Column, Table

_NOISE = 8 * EPS  # four units in the last place, within which errors count as equal
_SAME = 0.1  # part by which a time may be another one and count as the same


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
    """One way to do a job, with its tolerance, step or size in words.

    ``why`` says in a few words why the product does not use it, should it be faster at the same digits.
    """

    family: str
    setting: str
    run: Callable[[], Any]
    why: str = ""


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
    why: str = ""

    @property
    def digits(self) -> float:
        """Digits that are right."""
        return float(-np.log10(self.error))


@dataclass(frozen=True)
class Comparison:
    """The methods of one job; the first row is the product's own one, the rows of a family are neighbours.

    ``condition`` is the job's condition number: an error of so many roundings no method could avoid.
    """

    number: str
    title: str
    rows: tuple[Measured, ...]
    condition: float = np.nan

    @property
    def own(self) -> Measured:
        return self.rows[0]

    def time(self, row: Measured) -> str:
        """A time beside the own one, in words: the same within a tenth, and where the quartiles of enough runs meet."""
        own = self.own
        meet = row.low <= own.high and own.low <= row.high and min(row.runs, own.runs) >= TURNS
        if meet or 1 - _SAME <= row.seconds / own.seconds <= 1 + _SAME:
            return "the same time"
        return "faster" if row.seconds < own.seconds else "slower"

    def place(self, row: Measured) -> str:
        """A method beside the product's own, in words."""
        if row is self.own:
            return "the product's own"
        time = self.time(row)
        if _better(row.error, self.own.error):
            return f"{time}, more digits"
        if _better(self.own.error, row.error):
            return f"{time}, fewer digits"
        return "no difference" if time == "the same time" else f"{time}, the same digits"

    def why(self, row: Measured) -> str:
        """Why a method that is faster at no fewer digits is not used; "" of all others."""
        return row.why if self.place(row) in ("faster, the same digits", "faster, more digits") else ""

    @property
    def better(self) -> tuple[Measured, ...]:
        """Methods that are both faster and more accurate than the product's own: none, if that is on the front."""
        return tuple(row for row in self.rows if self.place(row) == "faster, more digits")

    @property
    def fastest(self) -> Measured:
        """The fastest of the methods of no fewer digits."""
        return min((row for row in self.rows if "fewer" not in self.place(row)), key=lambda row: row.seconds)

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
        ratio = seconds / self.own.seconds
        decimals = 3 if np.min(ratio) >= 1e-3 else 5  # so that no time is nothing
        columns = (
            Column("method", "", "", 0, np.array([row.family for row in rows], object)),
            Column("setting", "", "tolerance, step or size", 0, np.array([row.setting for row in rows], object)),
            Column("error", "-", _ERROR, 1, error, power=True),
            Column("digits", "-", "digits that are right", 1, digits),
            Column("time", "ms", "median of the run times", 3, 1e3 * seconds),
            Column("ratio", "-", "run time, times that of the product's own method", decimals, ratio),
            Column("place", "", "beside the product's own method", 0, np.array([*map(self.place, rows)], object)),
            Column("not used", "", "why not, where it is faster", 0, np.array([*map(self.why, rows)], object)),
            Column("roundings", "-", _ROUNDINGS, 1, error / (np.maximum(1.0, self.condition) * EPS), power=True),
            *time_spread(rows),
        )
        return Table(self.number, self.title, columns, note)

    def figure(self) -> WorkPrecision:
        """The work-precision diagram of all methods."""
        _, _, error, _, _, ratio, *_ = self.table().columns
        figure = WorkPrecision(self.number, self.title, ratio, (error,), rows=self.rows)
        return replace(figure, own=self.own, front=self.front, noise=_NOISE)


_ERROR = "largest error over the largest number, at least one rounding, at most 1"
_ROUNDINGS = "the error in roundings times the condition number of the job"


@dataclass(frozen=True)
class Job:
    """What is to be computed: its numbers at 50 digits, and all methods.

    The product's own method is the first; those of a family are next to each other. ``condition`` is the job's
    condition number: the greatest change of a number over the largest, for relative changes of what is given.
    """

    number: str
    title: str
    truth: Sequence[Any]
    methods: Sequence[Method]
    condition: float = np.nan

    def compare(self, seconds: float) -> Comparison:
        """Run the methods turn about, and compare the medians of their run times and their errors; see `timed`."""
        with progress(STEPS * len(self.methods), f"{self.number} {self.title}") as done:
            found = timed([method.run for method in self.methods], seconds, done)
        rows = (
            Measured(m.family, m.setting, largest_error(t.result, self.truth), *t[1:], m.why)
            for m, t in zip(self.methods, found, strict=True)
        )
        return Comparison(self.number, self.title, tuple(rows), self.condition)


def _better(a: float, b: float) -> bool:
    """Whether the error a is less than b by more than the noise of a few roundings or a factor of two."""
    return 2 * a + _NOISE < b


def _best(rows: Sequence[Measured]) -> Measured:
    least = min(row.error for row in rows)
    return min((row for row in rows if not _better(least, row.error)), key=lambda row: row.seconds)
