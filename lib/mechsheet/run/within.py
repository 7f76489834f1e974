"""Runs of a worksheet for cases within the tolerances of its inputs, one by one: lines may go another way in each."""

import warnings
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager, redirect_stdout
from dataclasses import replace
from io import StringIO
from itertools import product
from typing import Any

import numpy as np

from mechsheet import units
from mechsheet.document import parts
from mechsheet.quantities.operations import Values
from mechsheet.readers.bands import Tolerance
from mechsheet.readers.cases import RESULTS, Cases, Key
from mechsheet.run.progress import progress
from mechsheet.worksheet.cells import Worksheet
from mechsheet.worksheet.check import Check
from mechsheet.worksheet.deviation import SIGMAS
from mechsheet.worksheet.errors import OF_NUMBERS
from mechsheet.worksheet.lines import Formula
from mechsheet.worksheet.table import Table

COUNT = 1000  # random cases
_ALL_ENDS = 6  # inputs of which all ends are put together; of more each alone


def cases(
    g: Any, sheet: Worksheet, want: Sequence[str], known: Mapping[str, Formula], by: Mapping[str, Tolerance]
) -> Cases:
    """What the cells behind wanted names tell in cases about the inputs ``g``; ``known`` are lines with a unit."""
    spans, holds = dict[Key, tuple[Values, Values] | None](), list[dict[str, bool]]()
    reasons = list[str]()
    every = np.concatenate([_ends(len(by)), _drawn([*by.values()])])
    with progress(len(every), "cases within the tolerances") as done:
        for each in every:
            moved = {name: t.value + part * t.size for (name, t), part in zip(by.items(), each.tolist(), strict=True)}
            done()
            try:
                with _silently():
                    names = sheet.run(want, {"g": replace(g, **moved)})
            except OF_NUMBERS as error:
                reasons.append(str(error))
                holds.append({})
                continue
            shown = parts.values(names)
            holds.append({check.name: check.passed for check in shown if isinstance(check, Check)})
            for key, x in _numbers(names, known, [table for table in shown if isinstance(table, Table)]):
                span = spans.setdefault(key, (x, x))
                same = span is not None and span[0].shape == x.shape
                spans[key] = (np.fmin(span[0], x), np.fmax(span[1], x)) if span is not None and same else None
    common = set.intersection(*(set(each) for each in holds if each)) if any(holds) else set()
    held = {name: np.array([each.get(name, False) for each in holds]) for name in common}
    return Cases(COUNT, spans, held, len(reasons), next(iter(reasons), ""))


@contextmanager
def _silently() -> Iterator[None]:
    """What lines print, and warn of, the worksheet's own run has told."""
    with warnings.catch_warnings(), redirect_stdout(StringIO()):
        warnings.simplefilter("ignore")
        yield


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
