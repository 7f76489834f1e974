"""What is timed: jobs in which the product's methods stand beside the others, batches of them, whole worksheets."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from numpy import linspace, pi

from mechsheet.accuracy import exact, printed, rivals
from mechsheet.accuracy.arithmetic import Numbers
from mechsheet.accuracy.machine import machine_job, ring_job
from mechsheet.accuracy.precision import Job, Measured, Method, Timed, largest_error, time_spread, timed, times_of_one
from mechsheet.accuracy.rivals import REACTIONS, crank_chain, hitch_chain, hitch_points
from mechsheet.accuracy.truths import TRUTHS, exact_results
from mechsheet.readers import numbers as computed
from mechsheet.readers.gradients import gradient
from mechsheet.readers.slopes import slopes
from mechsheet.recording.evaluation import evaluate
from mechsheet.recording.record import record
from mechsheet.run import report
from mechsheet.run.progress import progress
from mechsheet.run.proving import proof_of
from mechsheet.worksheet import shown
from mechsheet.worksheet.cells import Worksheet, load, results
from mechsheet.worksheet.lines import registry
from mechsheet.worksheet.table import Column, Table
from mechsheet.worksheet.title import Slider

_PINS = ("P23_S", "P45_S", "P67_S")
_ANALOGUES = tuple(f"dphi{k}" for k in range(3, 8))


def accuracy_jobs(hitch: Any, machine: Worksheet, crank: Any, N: int, factors: Sequence[float]) -> dict[str, Job]:
    """The jobs by number: positions, derivatives, Finds and reactions of the hitch, positions of a dyad on a crank.

    Reactions of a machine with groups of all kinds and the bolts of a circular joint too. ``hitch`` are the inputs of
    the hitch worksheet, ``machine`` is the worksheet of kinetostatics, ``crank`` has l_1, l_A, l_B, X_B, Y_B [m]; all
    are computed at N positions. The factors are those of bad guesses.
    """
    S, q = linspace(hitch.S_min, hitch.S_max, N), linspace(0, 2 * np.pi, N)
    found = exact.finds(hitch)
    known = {name: float(x) for name, x in found.items()}
    L4, S_p, L7 = known.values()
    at, upright = [exact.hitch(hitch, s, **known) for s in S], [exact.hitch(hitch, S_p, **known)]
    chain, dyad = hitch_chain(hitch, L4, L7), crank_chain(crank.l_1, crank.X_B + 1j * crank.Y_B, crank.l_A, crank.l_B)
    B = dyad.dyads[0].B

    def of(names: Iterable[str], positions: Iterable[Numbers] = at) -> list[Any]:
        return [p[name] for name in names for p in positions]

    def printed_pins() -> Any:
        r = printed.hitch_pins(hitch, S, L4, L7)
        return np.array([r[name] for name in _PINS])

    def printed_dyad() -> Any:
        return printed.dyad_pin(dyad.A(q), B, crank.l_A, crank.l_B, +1)[0]

    def printed_analogues() -> Any:
        r = printed.hitch_ratios(hitch, S, L4, L7, printed.hitch_pins(hitch, S, L4, L7))
        return np.array([r[name] for name in _ANALOGUES])

    def derivatives(order: int, as_printed: Callable[[], Any] | None = None) -> list[Method]:
        return rivals.derivative_methods(chain, S, hitch.S_max - hitch.S_min, order, as_printed)

    def reactions(number: str, title: str, strokes: Any, positions: Sequence[Numbers]) -> Job:
        S6 = np.array([complex(p["PS6_S"]) for p in positions])
        return Job(number, title, of(REACTIONS, positions), rivals.reaction_methods(hitch, strokes, L4, L7, S6))

    second = zip(*(exact.second_analogues(hitch, s, L4, L7) for s in S), strict=True)
    pins = [exact.four_bar(crank.l_1, crank.l_A, crank.l_B, B, t)["C"] for t in q.tolist()]
    truth, finds, positions = list(found.values()), rivals.find_methods, rivals.position_methods
    jobs = (
        Job("1.1", "Position of the hitch", of(_PINS), positions(chain, S, printed_pins)),
        Job("1.2", "Position of a dyad", pins, positions(dyad, q, printed_dyad)),
        Job("2.1", "Velocity analogues", of(_ANALOGUES), derivatives(1, printed_analogues)),
        Job("2.2", "Acceleration analogues", [x for row in second for x in row], derivatives(2)),
        Job("3.1", "Find from the document's guesses", truth, finds(hitch, [1.0])),
        Job("3.2", "Find from bad guesses", truth * len(factors), finds(hitch, factors)),
        reactions("4.1", "Reactions", S, at),
        reactions("4.2", "Reactions, mast upright", np.array([S_p]), upright),
        machine_job("4.4", machine, N),
        ring_job("4.5", N),
    )
    return {job.number: job for job in jobs}


def batch_times(number: str, hitch: Any, sizes: Sequence[int], seconds: float) -> Table:
    """Table of the time for one of n positions or Finds computed at once: 1.3, 3.3 or 4.3."""
    L4, _, L7 = map(float, exact.finds(hitch).values())

    def strokes(n: int) -> Any:
        return linspace(hitch.S_min, hitch.S_max, n)

    def heights(n: int) -> Any:
        return linspace(0.19, 0.21, n) if n > 1 else np.array([0.2])

    def points(n: int) -> Any:
        return hitch_points(hitch, strokes(n), L4, L7, np.full(n, 2 + 0.5j))

    positions = {
        "library": hitch_chain(hitch, L4, L7).groups,
        "printed": lambda S: printed.hitch_pins(hitch, S, L4, L7),
    }
    batches: dict[str, tuple[str, Callable[[int], Any], Mapping[str, Callable[[Any], Any]]]] = {
        "1.3": ("Time of a position", strokes, positions),
        "3.3": ("Time of a Find", heights, rivals.rod_ways(hitch)),
        "4.3": ("Time of the reactions", points, rivals.reaction_ways(hitch)),
    }
    title, given, ways = batches[number]
    return times_of_one(number, title, sizes, given, ways, seconds)


# Whole worksheets

_STUDY = ("phi3_g", "N_same", "N_other", "N_none", "N_g")  # first approximations of the slotted link


@dataclass(frozen=True, kw_only=True)
class Whole(Measured):
    """All numbers and checks of a worksheet over so many positions."""

    positions: int
    names: int
    cells: int


def _numbers_of(sheet: Worksheet) -> list[str]:
    """Names of a worksheet's numbers and checks: lines with a unit, without tables and what follows a slider."""
    names = [name for name in results(sheet.path) if name not in ("form", "g")]
    found = sheet.run(names, {"g": sheet.inputs()})
    declared, sliders = registry(found), {name for name in names if isinstance(found[name], Slider)}

    def moves(name: str) -> bool:
        return any(sliders & set(cell.gives) for cell in sheet.needed([name], ["g"]))

    numbers = [name for name in names if name in declared and name not in _STUDY]
    return [name for name in (*numbers, *(name for name in names if name.startswith("check"))) if not moves(name)]


def _field(stem: str, sheet: Worksheet, n: int) -> dict[str, Any]:
    """The inputs, and a field of n positions that takes the place of the worksheet's own one."""
    g = sheet.inputs()
    t = linspace(0, 1, n) if n > 1 else np.array([0.5])
    if stem == "hitch":
        S = g.S_min * (1 - t) + g.S_max * t
        return {"g": g, "k": np.arange(n), "t": t, "S": S, "dS": (g.S_max - g.S_min) / max(n - 1, 1)}
    if stem == "landing_gear":
        made = sheet.run(["l20", "H"], {"g": g})
        return {"g": g, "i": np.arange(n), "l2i": made["l20"] + t * made["H"]}
    if stem == "slotted_link":
        return {"g": g, "k": np.arange(n), "dphi1": 2 * pi / max(n - 1, 1), "phi1_k": 2 * pi * t}
    if stem == "kinetostatics":
        base = ("C", "H", "O1", "O5", "omega1", "u5")
        made = sheet.run(base, {"g": g})
        return {"g": g, "phi1": 2 * pi * t} | {name: made[name] for name in base}
    return {"g": g}


def _error(stem: str, names: Mapping[str, Any], n: int) -> float:
    """Largest error of the results of a worksheet at three of its n positions."""
    rows = sorted({0, n // 3, n - 1})
    errors = []
    for name, numbers in exact_results(stem, names, rows).items():
        found = np.asarray(names[name])
        at = found.ravel() if len(numbers) == found.size else np.broadcast_to(found, (n,))[rows]
        errors.append(largest_error(at, numbers))
    return max(errors)


def whole_worksheets(folder: Path, sizes: Sequence[int], seconds: float) -> list[Whole]:
    """The worksheets of a folder with all their numbers and checks, each at several numbers of positions."""
    sheets = {stem: load(folder / f"{stem}.py") for stem in (*TRUTHS, "joint")}
    wanted = {stem: _numbers_of(sheet) for stem, sheet in sheets.items()}
    cases = [(stem, n) for stem in sheets for n in (sizes if stem in TRUTHS else (1,))]
    given = [_field(stem, sheets[stem], n) for stem, n in cases]
    runs = [lambda s=s, g=g: sheets[s].run(wanted[s], g) for (s, _), g in zip(cases, given, strict=True)]
    with progress(len(cases), "5 Whole worksheets") as done:
        made = timed(runs, seconds, done)

    def whole(stem: str, n: int, t: Timed) -> Whole:
        setting, cells = str(n) if stem in TRUTHS else "load cases", sheets[stem].needed(wanted[stem], ["g"])
        taken = t.seconds, t.low, t.high, t.runs
        counts = {"positions": n, "names": len(wanted[stem]), "cells": len(cells)}
        return Whole(stem, setting, _error(stem, t.result, n), *taken, **counts)

    return [whole(*case, t) for case, t in zip(cases, made, strict=True)]


def asked_costs(number: str, path: Path, asked: Mapping[str, Sequence[str]], seconds: float) -> Table:
    """Table of the cells run and the run times for results asked for; no names ask for the whole document, at last."""
    sheet, title = load(path), "Cost of what is asked for"
    given = {"g": sheet.inputs()}
    wants = [list(names) or [name for name in sheet.results if name != "form"] for names in asked.values()]
    again = [partial(evaluate, path, want, **given) for want in wants]
    for ask in again:
        ask(), ask()  # the second time it is recorded
    runs = [partial(sheet.run, want, given) for want in wants]
    both = _run_times(f"{number} {title}", [*runs, *again], seconds)
    time, *apart = (replace(column, values=column.values[: len(runs)]) for column in both)
    cells = np.array([len(sheet.needed(want, given)) for want in wants], float)
    columns = (
        Column("asked for", "", "", 0, np.array(list(asked), object)),
        Column("cells", "-", "cells run", 0, cells),
        Column("of all", "%", "cells run over those of the whole document", 0, 100 * cells / cells[-1]),
        time,
        Column("of whole", "%", "time over that of the whole document", 0, 100 * time.values / time.values[-1]),
        Column("again", "ms", "median time where it was asked for before", 2, both[0].values[len(runs) :]),
    )
    return Table(number, title, (*columns, *apart))


def study_costs(number: str, path: Path, studies: Mapping[str, Callable[[], Any]], seconds: float) -> Table:
    """Table of the run times of studies and of the readers of a worksheet's recording, as multiples of one run, too."""
    sheet, title = load(path), "Cost of studies"
    given = {"g": sheet.inputs()}
    names = sheet.run(sheet.results, given) | {"__file__": str(path)}
    recording = record(names, sheet)
    inputs = [node for node in recording.inputs.values() if node.size == 1 and node.value.dtype.kind == "f"]
    columns = [part for table in recording.tables.values() for c in table if c is not None for part in c.parts]

    def refreshed() -> list[tuple[str, str]]:
        values = sheet.run(sheet.results, given).values()
        return [shown.page().written(value) for value in values if isinstance(value, shown.Shown)]

    ways: dict[str, Callable[[], Any]] = {
        "a run of the worksheet's cells": partial(sheet.run, sheet.results, given),
        "the run recorded": partial(record, names, sheet),
        "its tables computed by the recording": partial(
            computed.numbers, columns, {node: node.value for node in inputs}
        ),
        "their slopes by one input": partial(slopes, columns, inputs[:1]),
        f"their slopes by all {len(inputs)} inputs": partial(slopes, columns, inputs),
        f"one number's slopes by all {len(inputs)} inputs": partial(gradient, columns[-1], 0, inputs),
        "all their digits proved": partial(proof_of, names, sheet, recording),
        "its workbook written": partial(report.workbook, path.stem, names, {}),
        "its page refreshed: a run, and all that it shows drawn": refreshed,
        **studies,
    }
    study = Column("study", "", "", 0, np.array(list(ways), object))
    time, *spread = _run_times(f"{number} {title}", list(ways.values()), seconds)
    of_run = Column(
        "of a run", "-", "time over that of a run of the worksheet's cells", 2, time.values / time.values[0]
    )
    return Table(number, title, (study, time, of_run, *spread))


def _run_times(job: str, runs: Sequence[Callable[[], Any]], seconds: float) -> tuple[Column, ...]:
    """Columns of the medians of run times, of their spread and of their number."""
    with progress(len(runs), job) as done:
        taken = timed(runs, seconds, done)
    ms = 1e3 * np.array([time.seconds for time in taken])
    return Column("time", "ms", "median of the run times", 1, ms), *time_spread(taken)
