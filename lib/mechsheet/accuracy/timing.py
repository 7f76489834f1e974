"""Run times: of many runs taken turn about, of so many at once, their spread, and the machine that took them."""

import os
import platform
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from pathlib import Path
from time import perf_counter
from typing import Any, NamedTuple

import numpy as np
import scipy

from mechsheet.quantities.unrepeatable import clock_read
from mechsheet.run.progress import progress
from mechsheet.worksheet.table import Column, Table

TURNS = 5  # of each run, at least
STEPS = TURNS + 1  # of each run, counted by a bar: the first one warms up
FEW = 3  # run times that make no quartiles
_LONG = 1.0  # s that a run takes whose first time must do


class Timed(NamedTuple):
    """What a run returns, and of its run times the median, the quartiles [s] and the number."""

    result: Any
    seconds: float
    low: float
    high: float
    runs: int


def timed(runs: Sequence[Callable[[], Any]], seconds: float, done: Callable[[], object] = lambda: None) -> list[Timed]:
    """What each run returns, and its times, all taken turn about.

    The first time of each is spent on caches and does not count; then each has `TURNS` turns of a fifth of the
    ``seconds``, and at least one run in each. One that takes a second runs once. ``done`` is called after each of the
    `STEPS` of each.
    """
    clock_read()
    results, times = list[Any](), [list[float]() for _ in runs]

    def once(i: int) -> Any:
        start = perf_counter()
        result = runs[i]()
        times[i].append(perf_counter() - start)
        return result

    for i in range(len(runs)):
        results.append(once(i))
        done()
    warm = [i for i, taken in enumerate(times) if taken[0] < _LONG]
    for i in warm:
        times[i].clear()
    for _ in range(TURNS):
        for i, taken in enumerate(times):
            left = seconds / TURNS if i in warm else 0.0
            while left > 0:
                once(i)
                left -= taken[-1]
            done()
    quartiles = np.array([np.quantile(taken, (0.5, 0.25, 0.75)) for taken in times]).T.tolist()
    return list(map(Timed, results, *quartiles, map(len, times)))


def spread(times: Sequence[Any]) -> np.ndarray:
    """Half of what lies between the quartiles of run times over their median, in percent; NaN of a few."""
    seconds, low, high, runs = np.array([(t.seconds, t.low, t.high, t.runs) for t in times]).T
    return np.where(runs < FEW, np.nan, 50 * (high - low) / seconds)


def time_spread(times: Sequence[Any], of: str = "") -> tuple[Column, ...]:
    """Columns of how far run times lie apart, a dash where they are a few, and of how many were taken.

    ``of`` tells them from others in a table.
    """
    apart = "half of what lies between the quartiles of the run times, over their median"
    runs = np.array([t.runs for t in times], float)
    spread_of, runs_of = (f"{of} {name}".strip() for name in ("spread", "runs"))
    return Column(spread_of, "%", apart, 0, spread(times)), Column(runs_of, "-", "run times taken", 0, runs)


def times_of_one(
    number: str,
    title: str,
    sizes: Sequence[int],
    given: Callable[[int], Any],
    ways: Mapping[str, Callable[[Any], Any]],
    seconds: float,
    most: Mapping[str, int] = {},
) -> Table:
    """Table of the time for one of n that are computed at once from what is given for n, a row for each way.

    ``most`` is the largest n of a way that takes them one after the other. The slope is that of the line through the
    logarithms of the time for all over those of n: 0 where they cost no more than one, 1 where each costs the same.
    """
    cases = [(way, n) for way in ways for n in sizes if n <= most.get(way, n)]
    made = {n: given(n) for n in sizes}
    with progress(STEPS * len(cases), f"{number} {title}") as done:
        taken = timed([partial(ways[way], made[n]) for way, n in cases], seconds, done)
    times = dict(zip(cases, taken, strict=True))
    columns = [Column("way", "", "", 0, np.array(list(ways), object))]
    for n in sizes:
        each = [1e6 * times[way, n].seconds / n if (way, n) in times else np.nan for way in ways]
        columns.append(Column(_count(n), "µs", f"median time of one of {n} at once", 3, np.array(each)))
    rows = [[time for (way, _), time in times.items() if way == name] for name in ways]
    slopes = [_slope([n for way, n in cases if way == name], row) for name, row in zip(ways, rows, strict=True)]
    columns.append(Column("slope", "-", "of the logarithm of the time for all over that of n", 2, np.array(slopes)))
    most_apart = np.array([np.max(spread(row)) for row in rows])
    least_runs = np.array([min(time.runs for time in row) for row in rows], float)
    columns += [
        Column("spread", "%", "the largest half of what lies between quartiles, over the median", 0, most_apart),
        Column("runs", "-", "run times taken of each, at least", 0, least_runs),
    ]
    return Table(number, title, tuple(columns))


def _count(n: int) -> str:
    return f"{n:,}".replace(",", " ")


def _slope(sizes: Sequence[int], times: Sequence[Timed]) -> float:
    if len(sizes) < 2:
        return np.nan
    return float(np.polyfit(np.log(sizes), np.log([time.seconds for time in times]), 1)[0])


def _load() -> float:
    return os.getloadavg()[0] if hasattr(os, "getloadavg") else np.nan


_LOAD_BEFORE = _load()


def measured_on(number: str) -> Table:
    """Table of what the run times were measured on, and how busy it was before the first and after the last of them."""
    facts = {"processor": _processor(), "system": f"{platform.system()}, Python {platform.python_version()}"}
    facts |= {"numpy": np.__version__, "scipy": scipy.__version__}
    busy = "processes that wanted the processors, mean of a minute"
    columns = (
        *(Column(name, "", "", 0, np.array([fact], object)) for name, fact in facts.items()),
        Column("cores", "-", "of the machine", 0, np.array([os.cpu_count() or 1])),
        Column("load before", "-", busy, 1, np.array([_LOAD_BEFORE])),
        Column("load after", "-", busy, 1, np.array([_load()])),
    )
    return Table(number, "Machine of the run times", columns)


def _processor() -> str:
    """Model of the processor, as the system tells it."""
    told = Path("/proc/cpuinfo")
    lines = told.read_text(encoding="utf-8", errors="replace").splitlines() if told.exists() else []
    models = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")]
    return next(iter(models), platform.processor() or platform.machine())
