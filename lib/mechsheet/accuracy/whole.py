"""Whole worksheets: how long all their numbers take, or some of them, and how many digits of them are right."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy import linspace, pi

from mechsheet.accuracy import exact
from mechsheet.accuracy.arithmetic import Numbers, mpf
from mechsheet.accuracy.precision import Measured, largest_error, timed
from mechsheet.run.progress import progress
from mechsheet.worksheet.cells import Worksheet, load, results
from mechsheet.worksheet.lines import registry
from mechsheet.worksheet.title import Slider

_STUDY = ("phi3_g", "N_same", "N_other", "N_none", "N_g")  # first approximations of the slotted link


@dataclass(frozen=True)
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


def _joint(names: Mapping[str, Any]) -> Numbers:
    """Forces in all elements of the joint, from the areas that act."""
    shape = np.broadcast_shapes(*(np.shape(names[name]) for name in ("P", "y", "A")))
    y, A = (np.broadcast_to(names[name], shape).reshape(-1, shape[-1]).tolist() for name in ("y", "A"))
    M, N = (np.broadcast_to(names[name], (*shape[:-1], 1)).ravel().tolist() for name in ("M", "N"))
    forces = []
    for y_i, A_i, M_i, N_i in zip(y, A, M, N, strict=True):
        sigma = exact.stresses(y_i, A_i, mpf(M_i), mpf(N_i))
        forces += [s * area for s, area in zip(sigma, A_i, strict=True)]
    return {"P": forces}


# The field of positions, the truth at one of them, and the results that are compared: all, where none are named.
_TRUTHS: dict[str, tuple[str, Callable[[Any, Any], Numbers], Sequence[str]]] = {
    "hitch": ("S", exact.hitch, ()),
    "landing_gear": ("l2i", exact.landing_gear, ("Ai", "omega3_l2i", "eps3_l2i", "F_c")),
    "slotted_link": ("phi1_k", exact.slotted_link, ()),
    "kinetostatics": ("phi1", exact.kinetostatics, ()),
}


def exact_results(stem: str, names: Mapping[str, Any], rows: Iterable[int]) -> Numbers:
    """Results of a worksheet at 50 digits at some of its positions, by name; of the joint, which has none, all."""
    if stem == "joint":
        return _joint(names)
    field, truth, compared = _TRUTHS[stem]
    at = [truth(names["g"], float(names[field][i])) for i in rows]
    return {name: [p[name] for p in at] for name in compared or at[0].keys() & names.keys()}


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
    sheets = {stem: load(folder / f"{stem}.py") for stem in (*_TRUTHS, "joint")}
    wanted = {stem: _numbers_of(sheet) for stem, sheet in sheets.items()}
    cases = [(stem, n) for stem in sheets for n in (sizes if stem in _TRUTHS else (1,))]
    given = [_field(stem, sheets[stem], n) for stem, n in cases]
    runs = [lambda s=s, g=g: sheets[s].run(wanted[s], g) for (s, _), g in zip(cases, given, strict=True)]
    with progress(len(cases), "5 Whole worksheets") as done:
        made = timed(runs, seconds, done)
    return [
        Whole(
            *(stem, str(n) if stem in _TRUTHS else "load cases", _error(stem, names, n), time),
            *(n, len(wanted[stem]), len(sheets[stem].needed(wanted[stem], ["g"]))),
        )
        for (stem, n), (names, time) in zip(cases, made, strict=True)
    ]


def asked_costs(path: Path, asked: Iterable[Sequence[str]], seconds: float) -> list[tuple[int, float]]:
    """Cells run and run time [s] for the results asked for of a worksheet; of the whole document for no names."""
    sheet = load(path)
    given = {"g": sheet.inputs()}
    whole = [name for name in results(sheet.path) if name not in ("form", "g")]
    wants = [list(names) or whole for names in asked]
    times = timed([lambda want=want: sheet.run(want, given) for want in wants], seconds)  # type: ignore[misc]
    return [(len(sheet.needed(want, given)), time) for want, (_, time) in zip(wants, times, strict=True)]
