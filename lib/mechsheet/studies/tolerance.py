"""The bands of results that tolerances of inputs leave, by one sweep of a worksheet."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import product
from pathlib import Path
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from mechsheet.studies.sensitivity import by_name, continuous, point, real, shared, solved
from mechsheet.studies.sweep import known, sweep
from mechsheet.worksheet import numbers
from mechsheet.worksheet.cells import asked, base
from mechsheet.worksheet.deviation import SIGMAS
from mechsheet.worksheet.errors import SheetError, as_given
from mechsheet.worksheet.table import Column, Table, usual_decimals

Array = NDArray[np.float64]

_CORNERS = 12  # toleranced inputs, 4096 corners
_PERCENTILES = (5.0, 50.0, 95.0)


@dataclass(frozen=True, eq=False)
class Band:
    """Between what a result lies, in its display unit, at each position.

    ``mean``, ``deviation`` and ``percentiles`` are those of Monte Carlo, and None for corners.
    """

    nominal: Array
    least: Array
    greatest: Array
    mean: Array | None = None
    deviation: Array | None = None
    percentiles: dict[float, Array] | None = None


@dataclass(frozen=True, eq=False)
class Tolerance:
    """Bands of results for inputs within their tolerances.

    ``lost`` of the ``count`` variants have no value, ``reason`` is that of the first of them; bands are then NaN.
    """

    names: tuple[str, ...]
    tolerances: dict[str, float]
    method: str
    bands: dict[str, Band]
    units: dict[str, str]
    input_units: dict[str, str]
    count: int
    lost: int
    reason: str

    def __getitem__(self, name: str) -> Band:
        return known(name, self.bands, "result of this tolerance")

    def table(self, number: str, title: str, *names: str) -> Table:
        """Bands of results, all of one shape, a row for each position."""
        columns: list[Column] = []
        for name in names or self.names:
            band, unit = self[name], self.units[name]
            parts = {"": band.nominal, "min": band.least, "max": band.greatest}
            if band.mean is not None and band.deviation is not None and band.percentiles is not None:
                parts |= {"mean": band.mean, "sd": band.deviation}
                parts |= {f"p{numbers.significant(p, 6)}": x for p, x in band.percentiles.items()}
            decimals = usual_decimals(unit) + 1
            columns += [
                Column(f"{name}_{part}".rstrip("_"), unit, f"{name} {part}".strip(), decimals, np.atleast_1d(x))
                for part, x in parts.items()
            ]
        shapes = {column.values.shape for column in columns}
        if len(shapes) > 1:
            raise SheetError(f"bands of {', '.join(names or self.names)} have different positions and no common table")
        k = Column("k", "-", "number of the position", 0, np.arange(shapes.pop()[0], dtype=float))
        units_of = {x: numbers.suffix(self.input_units[x]) for x in self.tolerances}
        each = (f"{x} ± {numbers.significant(t, 6)}{units_of[x]}" for x, t in self.tolerances.items())
        lost = f" {self.lost} have no value: {self.reason}." if self.lost else ""
        note = f"{self.count} variants by {self.method} of {', '.join(each)}.{lost}"
        return Table(number, title, (k, *columns), note, said=tuple(self.tolerances))


def tolerance(
    worksheet: str | Path,
    want: Iterable[str],
    tolerances: Mapping[str, float] | None = None,
    method: Literal["corners", "monte carlo"] = "corners",
    *,
    seed: int | None = None,
    count: int = 1000,
    distribution: Literal["uniform", "normal"] = "uniform",
    percentiles: Sequence[float] = _PERCENTILES,
    **given: Any,
) -> Tolerance:
    """Bands of results for inputs that lie within tolerances of their values, through one sweep of the worksheet.

    Parameters
    ----------
    worksheet, want, given
        As in `sensitivity`.
    tolerances : mapping of str to float, optional
        Input name -> ± its tolerance, in its display unit; by default those that stand at the inputs, with their
        distributions.
    method : {"corners", "monte carlo"}
        All 2**n corners of the tolerances, which bound every result that is monotonic in each input; or ``count``
        random variants.
    seed : int
        Of Monte Carlo, which must have one: the same seed gives the same bands.
    distribution : {"uniform", "normal"}
        Uniform over the tolerance, or normal with the tolerance as three standard deviations.
    percentiles : sequence of float
        Percentiles of Monte Carlo.

    Raises
    ------
    SheetError
        An unknown name, a negative tolerance or one of a whole number, more corners than 4096, Monte Carlo without a
        seed, inputs given that have no solution.
    """
    names, given = asked(want), by_name(worksheet, given)
    fields, at = point(worksheet, given)
    normal = [distribution == "normal"] * len(tolerances or ())
    if tolerances is None:
        declared = {x: field.tolerance for x, field in fields.items() if field.tolerance}
        tolerances, normal = {x: d.of(at[x]) for x, d in declared.items()}, [d.normal for d in declared.values()]
        distribution = "uniform"
    if not isinstance(tolerances, Mapping):
        raise SheetError(
            f"tolerances = {as_given(tolerances)} must be a mapping of inputs to numbers, such as {{'P6': 1.0}}"
        )
    if not tolerances:
        raise SheetError("no input has a tolerance")
    if distribution not in ("uniform", "normal"):
        raise SheetError(f"distribution {distribution!r} must be 'uniform' or 'normal'")
    for x, t in tolerances.items():
        continuous(fields, x, "cannot have a tolerance:")
        if not (isinstance(t, int | float | np.number) and np.isfinite(t) and t >= 0):
            told = f"{as_given(t)}{numbers.suffix(fields[x].unit)}"
            raise SheetError(f"tolerance of {fields[x].meaning} {x} = {told} must be a number >= 0")
    if not np.iterable(percentiles):
        raise SheetError(f"percentiles = {as_given(percentiles)} must be a list of numbers 0..100")
    for p in percentiles:
        if not (isinstance(p, int | float | np.number) and 0 <= p <= 100):
            raise SheetError(f"percentile {as_given(p)} must be 0..100")
    spread = np.array(list(tolerances.values()))
    if method == "corners":
        if len(spread) > _CORNERS:
            raise SheetError(
                f"{len(spread)} tolerances have 2**{len(spread)} corners; at most {_CORNERS}, or monte carlo"
            )
        parts = np.array(list(product((-1.0, 1.0), repeat=len(spread))))
    elif method == "monte carlo":
        parts = _drawn(seed, count, normal)
    else:
        raise SheetError(f"method {method!r} must be 'corners' or 'monte carlo'")
    moved = np.vstack([np.zeros(len(spread)), parts]) * spread
    variants = {x: at[x] + moved[:, i] for i, x in enumerate(tolerances)}
    swept = sweep(worksheet, dict.fromkeys(base(name) for name in names), {**shared(fields, given), **variants})
    solved(swept, 0)
    lost = swept.reasons[1:][swept.reasons[1:] != ""]
    bands = {}
    for name in names:
        results = real(swept, name)
        all_of_them = results[1:]
        random: dict[str, Any] = {}
        if method == "monte carlo":
            random["mean"], random["deviation"] = all_of_them.mean(0), all_of_them.std(0, ddof=1)
            random["percentiles"] = dict(zip(percentiles, np.percentile(all_of_them, percentiles, axis=0), strict=True))
        bands[name] = Band(results[0], results.min(0), results.max(0), **random)
    return Tolerance(
        names,
        dict(tolerances),
        f"{method}, {_said(normal)}, seed {seed}" if method == "monte carlo" else method,
        bands,
        {name: swept.units[base(name)] for name in names},
        {x: fields[x].unit for x in tolerances},
        len(parts),
        len(lost),
        str(lost[0]) if len(lost) else "",
    )


def _said(normal: Sequence[bool]) -> str:
    return "normal" if all(normal) else "uniform and normal" if any(normal) else "uniform"


def _drawn(seed: int | None, count: int, normal: Sequence[bool]) -> Array:
    """Random parts of the tolerances, a row for each variant."""
    if not isinstance(seed, int | np.integer) or seed < 0:
        raise SheetError(f"monte carlo needs a seed, a whole number such as seed=1, not {as_given(seed)}")
    if not isinstance(count, int | np.integer) or count < 2:
        raise SheetError(f"count = {as_given(count)} variants must be at least 2 and whole")
    rng = np.random.default_rng(seed)
    columns = (rng.normal(0, 1 / SIGMAS, count) if bell else rng.uniform(-1, 1, count) for bell in normal)
    return np.stack(list(columns), 1)
