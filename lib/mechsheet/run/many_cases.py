"""Many cases of a worksheet at once, by the recording of one of them, and which of these it knows."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from mechsheet import units
from mechsheet.document import parts
from mechsheet.quantities.lines import Residual
from mechsheet.quantities.node import Node
from mechsheet.quantities.operations import Values
from mechsheet.quantities.quantity import Quantity, lift
from mechsheet.readers.cases import RESULTS, Key
from mechsheet.readers.plan import NotPlanned
from mechsheet.recording.planned import Followed, followed
from mechsheet.recording.variants import Together, of_all, together
from mechsheet.worksheet.cells import Worksheet
from mechsheet.worksheet.drawing import Drawing
from mechsheet.worksheet.lines import Formula
from mechsheet.worksheet.table import Table
from mechsheet.worksheet.verdict import values_only

_MOST = 10_000_000  # numbers at a time
_ALIKE = 1e-7  # of the greatest value: ends are told with six digits, and a difference over a small step has rounding
_ROUNDING = 1e-13  # of the greatest value with the same unit


@dataclass(frozen=True)
class Told:
    """What cases tell, on the leading axis: numbers in display units by where they are shown, and which checks hold."""

    numbers: Mapping[Key, Values]
    holds: Mapping[str, Values]

    def some(self, which: Values) -> "Told":
        """What some of them tell."""
        numbers = {key: x[which] for key, x in self.numbers.items()}
        return Told(numbers, {name: holds[which] for name, holds in self.holds.items()})


@dataclass(frozen=True)
class Way:
    """How the recording of one case computes others: what is shown by its node and unit, and what is checked."""

    compute: Together
    shown: Mapping[Key, tuple[Node, str]]
    checks: Mapping[str, Residual]
    names: Mapping[Node, Values]  # what stands in the names of checks

    def told(self, given: Mapping[str, Values]) -> Iterator[tuple[Told, Values]]:
        """What cases tell, and which of them are known, as many at a time as there is room for."""
        few = max(1, _MOST // sum(node.size for node, _ in self.shown.values()))
        for at in range(0, len(next(iter(given.values()))), few):
            with values_only():
                numbers, known = self.compute({name: x[at : at + few] for name, x in given.items()})
            for node, own in self.names.items():
                known = known & of_all(numbers[node] == own)
            shown = {key: _flat(numbers[node]) / units.parse(unit).factor for key, (node, unit) in self.shown.items()}
            yield Told(shown, {name: _holds(check, numbers) for name, check in self.checks.items()}), known

    def agrees(self, told: Told, k: int, alone: Told) -> bool:
        """Whether the ``k``-th of some cases tells the same but for rounding as the worksheet does of it alone.

        What is left of quantities with the same unit is rounding where it is that of these.
        """
        largest = dict[str, float]()
        for key, (_, unit) in self.shown.items():
            largest[unit] = max(_size(told.numbers[key][k]), largest.get(unit, 0.0))
        for key, (_, unit) in self.shown.items():
            here, own = told.numbers[key][k], alone.numbers.get(key, np.empty((1, 0)))[0]
            most = max(_ALIKE * _size(here), _ROUNDING * largest[unit])
            if here.shape != own.shape or not np.allclose(here, own, rtol=0, atol=most, equal_nan=True):
                return False
        return all(x[0] == told.holds[name][k] for name, x in alone.holds.items() if name in told.holds)


def way(only: Worksheet, want: Sequence[str], g: Any, known: Mapping[str, Formula], varied: Sequence[str]) -> Way:
    """How the recording of the case with inputs ``g`` computes others; ``known`` are lines with a unit.

    The cells of ``only`` are all needed for what is wanted. How drawings look is not asked, nor are checks that are
    recorded at some of their positions. Raises NotPlanned where it cannot.
    """
    of = followed(only, want, g)
    looked = (guards for name, guards in of.recording.looked.items() if not isinstance(of.own.get(name), Drawing))
    of = replace(of, same=[*(guard.holds for guards in looked for guard in guards), *of.recording.guards])
    checks = {name: check for name, check in of.recording.checks.items() if not check.where}
    shown = {**dict(_of_lines(of, known)), **dict(_of_tables(of))}
    if not shown:
        raise NotPlanned("nothing is shown")
    names = {node: node.value for name in checks if (said := of.recording.name_said(name)) for node in said.nodes}
    judged = [node for check in checks.values() for node in (*check.parts, check.limit)]
    return Way(together(of, [*(node for node, _ in shown.values()), *judged, *names], varied), shown, checks, names)


def _of_lines(of: Followed, known: Mapping[str, Formula]) -> Iterator[tuple[Key, tuple[Node, str]]]:
    for name, line in known.items():
        value = of.recording.values.get(name) if line.has_value else None
        if isinstance(value, Quantity) or np.asarray(value).dtype.kind in "iufc":
            quantity = lift(of.recording.graph, value).whole()
            ends = ("real", "imag") if quantity.im is not None else ("",)
            for node, part in zip(quantity.parts, ends, strict=True):
                if node.value.dtype.kind in "if":
                    yield (RESULTS, f"{name}.{part}" if part else name), (node, line.unit)


def _of_tables(of: Followed) -> Iterator[tuple[Key, tuple[Node, str]]]:
    for table in (value for value in parts.values(of.own) if isinstance(value, Table)):
        recorded = of.recording.tables.get(table.number, (None,) * len(table.columns))
        for column, quantity in zip(table.columns, recorded, strict=True):
            if quantity is not None and column.values.dtype.kind in "biuf":
                yield (f"table {table.number}", column.name), (quantity.re, column.unit)


def _holds(check: Residual, numbers: Mapping[Node, Values]) -> Values:
    most = _flat(numbers[check.limit])
    holds = of_all(np.isfinite(most))
    for part in check.parts:
        holds = holds & of_all(check.keeps(_flat(numbers[part]), most))
    return holds


def _size(x: Values) -> float:
    return float(np.max(np.abs(x), initial=0.0, where=np.isfinite(x)))


def _flat(x: Values) -> Values:
    return x.reshape(len(x), -1)
