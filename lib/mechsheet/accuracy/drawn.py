"""Random geometries of the groups: errors in units of the condition number times a rounding, and times.

The exact numbers have 32 digits (`double_double`), all geometries at once.
"""

from collections.abc import Callable, Sequence
from functools import lru_cache
from typing import Any

import numpy as np

from mechsheet.accuracy.arithmetic import EPS
from mechsheet.accuracy.assur import KINDS, Kind
from mechsheet.accuracy.conditioning import WITHIN, changes
from mechsheet.accuracy.double_double import Point, Real
from mechsheet.accuracy.timing import times_of_one
from mechsheet.mechanics.planar import cross
from mechsheet.quantities.unrepeatable import clock_read
from mechsheet.run.progress import progress
from mechsheet.worksheet.check import Check
from mechsheet.worksheet.table import Column, Table

_QUANTILES = {"median": 0.5, "of 90 %": 0.9, "of 99 %": 0.99, "greatest": 1.0}
_OF = {
    "position": ("C", "u"),
    "velocity": ("v_C", "omega_A", "omega_B", "ds", "ds_A", "ds_B"),
    "acceleration": ("a_C", "epsilon_A", "epsilon_B", "dds", "dds_A", "dds_B"),
    "reactions": ("R_A", "R_B", "R_C", "M_A", "M_B", "M_C"),
}


def drawn(kind: Kind, count: int, names: Sequence[str]) -> dict[str, Any]:
    """What a kind of group is given by these names, at random: links that meet, motion and loads of the size of one."""
    rng = np.random.default_rng(1)

    def points() -> Any:
        return rng.normal(size=count) + 1j * rng.normal(size=count)

    r_A, r_B = 10 ** rng.uniform(-0.5, 0.5, (2, count))
    C, w = points(), points()
    a, u = np.exp(1j * rng.uniform(0, 2 * np.pi, (2, count)))
    A, B = C + r_A * a, C + r_B * a * np.exp(1j * rng.uniform(0.2, np.pi - 0.2, count))
    offset = cross(u, C - B) if "u" in kind.given else cross(-a, A - B)
    x = {"A": A, "B": B, "r_A": r_A, "r_B": r_B, "u": u, "w": w, "e": offset}
    return {
        name: x[name] if name in x else points() if f"{name}y" in kind.numbers else rng.normal(size=count)
        for name in names
    }


def group_times(number: str, sizes: Sequence[int], seconds: float) -> Table:
    """Table of the time for one of n positions of each group computed at once, each of a geometry of its own."""
    clock_read()  # before anything is run for it

    def way(kind: Kind) -> Callable[[int], Any]:
        return lambda n: kind.group({name: x[:n] for name, x in given[kind.given].items()})

    given = {kind.given: drawn(kind, max(sizes), kind.given) for kind in KINDS.values()}
    ways = {f"group {name}": way(kind) for name, kind in KINDS.items()}
    return times_of_one(number, "Time of a position of a group", sizes, int, ways, seconds)


def roundings(kind: Kind, x: dict[str, Any]) -> dict[str, Any]:
    """Errors of all results of the library in roundings times their condition numbers; shape (count,) each.

    Position and rates are rounded before anything is computed from them, and count as given.

    NaN where the change of an input that tells the condition number is more than the group can follow, infinite where
    the library has no number.
    """
    exact = kind.exact({name: _exactly(value) for name, value in x.items()})
    names = list(exact)
    found = kind.by_library(x)

    def together(x: dict[str, Any]) -> Any:
        made = kind.by_library(x)
        return np.array([made[name] for name in names])

    sizes, moved = changes(together, x)
    for name, change in kind.changes_by_rounding(x).items():
        moved[names.index(name)] += change
    kappa = np.maximum(1.0, moved / np.abs(sizes))
    return {
        name: np.where(np.isfinite(found[name]), _off(found[name], exact[name]) / (kappa[k] * EPS), np.inf)
        for k, name in enumerate(names)
    }


def _exactly(x: Any) -> Any:
    return Point(Real(x.real.copy()), Real(x.imag.copy())) if np.iscomplexobj(x) else Real(x)


def _off(found: Any, exact: Any) -> Any:
    """Relative error."""
    if isinstance(exact, Point):
        size = np.hypot(exact.real.high, exact.imag.high)
        return np.hypot(_less(found.real, exact.real), _less(found.imag, exact.imag)) / size
    return np.abs(_less(found, exact) / exact.high)


def _less(found: Any, exact: Real) -> Any:
    return (found - exact.high) - exact.low


@lru_cache(maxsize=2)  # a cell runs again where it is recorded
def random_groups(number: str, count: int) -> tuple[Table, Check]:
    """Quantiles of the errors of so many random geometries of each group, in roundings times their condition number."""
    rows = list[tuple[str, str, Any]]()
    with progress(len(KINDS), f"{number} Random groups") as done:
        for name, kind in KINDS.items():
            errors = roundings(kind, drawn(kind, count, kind.names))
            for of, results in _OF.items():
                told = np.concatenate([errors[y] for y in results if y in errors])
                rows.append((name, of, told[~np.isnan(told)]))
            done()
    columns = [
        Column("group", "", "", 0, np.array([name for name, *_ in rows], object)),
        Column("of", "", "", 0, np.array([of for _, of, _ in rows], object)),
        Column("geometries", "-", "at random", 0, np.full(len(rows), float(count))),
        Column("results", "-", "compared", 0, np.array([len(errors) for *_, errors in rows], float)),
    ]
    for name, part in _QUANTILES.items():
        errors_at = np.array([np.quantile(errors, part, method="higher") for *_, errors in rows])
        columns.append(Column(f"{name} error", "-", f"{name}, in roundings times the condition number", 2, errors_at))
    worst = float(columns[-1].values.max())
    name = "errors of random groups, in roundings times their condition"
    return Table(number, "Errors of random groups", tuple(columns)), Check(name, worst, WITHIN)
