"""Whole worksheets, and what is run of them where not all is asked for."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from numpy import linspace, pi

from mechsheet.accuracy.precision import Measured, largest_error
from mechsheet.accuracy.timing import STEPS, Timed, time_spread, timed
from mechsheet.accuracy.truths import TRUTHS, exact_results
from mechsheet.quantities.unrepeatable import clock_read
from mechsheet.recording.evaluation import evaluate
from mechsheet.run.progress import progress
from mechsheet.worksheet.cells import Worksheet, load
from mechsheet.worksheet.lines import registry
from mechsheet.worksheet.table import Column, Table
from mechsheet.worksheet.title import Slider

_STUDY = ("phi3_g", "N_same", "N_other", "N_none", "N_g")  # first approximations of the slotted link


@dataclass(frozen=True, kw_only=True)
class Whole(Measured):
    """All numbers and checks of a worksheet over so many positions."""

    positions: int
    names: int
    cells: int


def _numbers_of(sheet: Worksheet) -> list[str]:
    """Names of a worksheet's numbers and checks: lines with a unit, without tables and what follows a slider."""
    names = sheet.results
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
    clock_read()  # before anything is run for it
    sheets = {stem: load(folder / f"{stem}.py") for stem in (*TRUTHS, "joint")}
    wanted = {stem: _numbers_of(sheet) for stem, sheet in sheets.items()}
    cases = [(stem, n) for stem in sheets for n in (sizes if stem in TRUTHS else (1,))]
    given = [_field(stem, sheets[stem], n) for stem, n in cases]
    runs = [lambda s=s, g=g: sheets[s].run(wanted[s], g) for (s, _), g in zip(cases, given, strict=True)]
    with progress(STEPS * len(cases), "5 Whole worksheets") as done:
        made = timed(runs, seconds, done)

    def whole(stem: str, n: int, t: Timed) -> Whole:
        setting, cells = str(n) if stem in TRUTHS else "load cases", sheets[stem].needed(wanted[stem], ["g"])
        error, names = _error(stem, t.result, n), len(wanted[stem])
        return Whole(stem, setting, error, *t[1:], positions=n, names=names, cells=len(cells))

    return [whole(*case, t) for case, t in zip(cases, made, strict=True)]


def asked_costs(number: str, path: Path, asked: Mapping[str, Sequence[str]], seconds: float) -> Table:
    """Table of the cells run and the run times for results asked for; no names ask for the whole document, at last."""
    clock_read()  # before anything is run for it
    sheet, title = load(path), "Cost of what is asked for"
    given = {"g": sheet.inputs()}
    wants = [list(names) or sheet.results for names in asked.values()]
    again = [partial(evaluate, path, want, **given) for want in wants]
    for ask in again:
        ask(), ask()  # the second time it is recorded
    runs = [*(partial(sheet.run, want, given) for want in wants), *again]
    with progress(STEPS * len(runs), f"{number} {title}") as done:
        taken = timed(runs, seconds, done)
    ms, cells = 1e3 * np.array([time.seconds for time in taken]), [len(sheet.needed(want, given)) for want in wants]
    cold, warm, count = ms[: len(wants)], ms[len(wants) :], np.array(cells, float)
    columns = (
        Column("asked for", "", "", 0, np.array(list(asked), object)),
        Column("cells", "-", "cells run", 0, count),
        Column("of all", "%", "cells run over those of the whole document", 0, 100 * count / count[-1]),
        Column("time", "ms", "median of the run times", 2, cold),
        Column("of whole", "%", "time over that of the whole document", 0, 100 * cold / cold[-1]),
        *time_spread(taken[: len(wants)]),
        Column("again", "ms", "median time where it was asked for before", 2, warm),
        *time_spread(taken[len(wants) :], "again"),
    )
    return Table(number, title, columns)
