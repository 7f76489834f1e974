"""Cases within the tolerances of a worksheet's inputs, in each of which its lines may go another way."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial
from itertools import product
from typing import Any

import numpy as np

from mechsheet import units
from mechsheet.document import parts
from mechsheet.quantities.graph import NotRecorded
from mechsheet.quantities.operations import Values
from mechsheet.readers.bands import Tolerance
from mechsheet.readers.cases import RESULTS, Cases, Key
from mechsheet.readers.plan import NotPlanned
from mechsheet.run.many_cases import Told, Way, way
from mechsheet.run.progress import progress
from mechsheet.run.silent import silently
from mechsheet.worksheet import mistakes
from mechsheet.worksheet.cells import Worksheet
from mechsheet.worksheet.check import Check
from mechsheet.worksheet.deviation import SIGMAS
from mechsheet.worksheet.errors import is_of_numbers
from mechsheet.worksheet.lines import Formula
from mechsheet.worksheet.table import Table

COUNT = 1000  # random cases
WAYS = 4  # recordings at most
_PAYS = 100  # cases that take as long alone as a recording, and more
_ALL_ENDS = 6  # inputs of which all ends are put together; of more each alone


def cases(
    g: Any,
    sheet: Worksheet,
    want: Sequence[str],
    known: Mapping[str, Formula],
    by: Mapping[str, Tolerance],
    ways: int = WAYS,
) -> Cases:
    """What the cells behind wanted names tell in cases about the inputs ``g``; ``known`` are lines with a unit.

    Recordings of so many of them compute all others that these know, and what is left runs one by one.
    """
    every = np.concatenate([_ends(len(by)), _drawn([*by.values()])])
    at = {name: t.value + part * t.size for (name, t), part in zip(by.items(), every.T, strict=True)}
    runs = _Runs(g, sheet, want, known, at, np.all(np.abs(every) <= 1, axis=1))
    left = np.arange(len(every))[::-1]  # the random ones first, which go the most usual ways
    with progress(len(every), "cases within the tolerances") as done, silently():
        while left.size:
            first, left = left[0], left[1:]
            told = runs.alone(first)
            done()
            if told and ways and len(left) >= _PAYS:
                ways -= 1
                try:
                    of_others = runs.others(first, told, left)
                except (NotPlanned, NotRecorded):
                    ways = 0
                    continue
                left = left[~of_others]
                for _ in range(np.count_nonzero(of_others)):
                    done()
    return runs.cases(partial(cases, g, sheet, want, known, by, ways=0) if runs.recorded else None)


class _Runs:
    """What cases tell, of which ``at`` has the inputs that differ in SI: one alone, or many at once.

    Those that are not ``inside`` are farther off than a tolerance, as few of a normal one are: no span tells of these.
    """

    def __init__(
        self,
        g: Any,
        sheet: Worksheet,
        want: Sequence[str],
        known: Mapping[str, Formula],
        at: Mapping[str, Values],
        inside: Values,
    ) -> None:
        self.g, self.sheet, self.want, self.known, self.at, self.inside = g, sheet, want, known, at, inside
        self.count = len(next(iter(at.values())))
        self.spans, self.holds = dict[Key, tuple[Values, Values] | None](), dict[str, Values]()
        self.lost, self.recorded = dict[int, str](), False

    def alone(self, k: int) -> Told | None:
        """What one case tells, for which all lines run; None of one without numbers."""
        try:
            told = self._run(k)
        except Exception as error:
            if not is_of_numbers(error):
                raise
            self.lost[k] = mistakes.reason(error, self.sheet.path)
            return None
        self._add(told, np.array([k]))
        return told

    def others(self, k: int, alone: Told, left: Values) -> Values:
        """Which of the cases that are left the recording of one knows, that tells of this what it does alone.

        Raises NotPlanned or NotRecorded where it cannot.
        """
        only = replace(self.sheet, cells=tuple(self.sheet.needed(self.want, ["g"])))
        by = way(only, self.want, self._g(k), self.known, [*self.at])
        told, known = next(by.told(self._rows(np.array([k]))))
        are_told, start = np.zeros(len(left), dtype=bool), 0
        if not (known[0] and by.agrees(told, 0, alone)):
            return are_told
        for told, known in by.told(self._rows(left)):
            here = np.flatnonzero(known)
            if here.size and all(self._agrees(by, told, n, left[start + n]) for n in here[[0, -1]]):
                self._add(told.some(here), left[start + here])
                are_told[start + here] = self.recorded = True
            start += len(known)
        return are_told

    def _agrees(self, by: Way, told: Told, n: int, k: int) -> bool:
        """Whether the ``n``-th of what is told is what the worksheet tells of its case alone."""
        try:
            return by.agrees(told, n, self._run(k))
        except Exception as error:
            if not is_of_numbers(error):
                raise
            return False

    def cases(self, alone: Callable[[], Cases] | None) -> Cases:
        """What all of them tell; of checks those that every case with numbers has."""
        there = np.array([k not in self.lost for k in range(self.count)])
        held = {name: holds == 1 for name, holds in self.holds.items() if not np.isnan(holds[there]).any()}
        return Cases(COUNT, self.spans, held, len(self.lost), next(iter(self.lost.values()), ""), alone)

    def _g(self, k: int) -> Any:
        return replace(self.g, **{name: x[k].item() for name, x in self.at.items()})

    def _rows(self, which: Values) -> dict[str, Values]:
        return {name: x[which] for name, x in self.at.items()}

    def _run(self, k: int) -> Told:
        names = self.sheet.run(self.want, {"g": self._g(k)})
        shown = parts.values(names)
        numbers = _numbers(names, self.known, [table for table in shown if isinstance(table, Table)])
        holds = {check.name: np.array([check.passed]) for check in shown if isinstance(check, Check)}
        return Told({key: x[None] for key, x in numbers}, holds)

    def _add(self, told: Told, which: Values) -> None:
        inside = self.inside[which]
        for key, x in told.numbers.items() if inside.any() else ():
            low, high = np.fmin.reduce(x[inside]), np.fmax.reduce(x[inside])
            span = self.spans.setdefault(key, (low, high))
            same = span is not None and span[0].shape == low.shape
            self.spans[key] = (np.fmin(span[0], low), np.fmax(span[1], high)) if span is not None and same else None
        for name, holds in told.holds.items():
            self.holds.setdefault(name, np.full(self.count, np.nan))[which] = holds


def _ends(count: int) -> Values:
    """Ends of so many tolerances, in parts of them: a row for each case."""
    if count <= _ALL_ENDS:
        return np.array([*product((-1.0, 1.0), repeat=count)])
    return np.concatenate([-np.eye(count), np.eye(count)])


def _drawn(by: Sequence[Tolerance]) -> Values:
    rng = np.random.default_rng(1)
    return np.stack([rng.normal(0, 1 / SIGMAS, COUNT) if t.normal else rng.uniform(-1, 1, COUNT) for t in by], 1)


def _numbers(
    names: Mapping[str, Any], known: Mapping[str, Formula], tables: Sequence[Table]
) -> Iterator[tuple[Key, Values]]:
    """Numbers that a run shows, in display units, by where they stand and their name."""
    for name, line in known.items():
        value = np.asarray(names.get(name) if line.has_value else None)
        if value.dtype.kind in "iufc":
            ends = {"real": value.real, "imag": value.imag} if value.dtype.kind == "c" else {"": value}
            for part, x in ends.items():
                yield (RESULTS, f"{name}.{part}" if part else name), x.reshape(-1) / units.parse(line.unit).factor
    for table in tables:
        for column in table.columns:
            if column.values.dtype.kind in "biuf":
                yield (f"table {table.number}", column.name), column.values.reshape(-1) + 0.0
