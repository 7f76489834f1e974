"""What of a run of a worksheet has a band where inputs lie within their tolerances: results, columns, checks."""

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, replace

import numpy as np

from mechsheet import units
from mechsheet.quantities.lines import Recording
from mechsheet.quantities.node import Node
from mechsheet.quantities.operations import Values
from mechsheet.quantities.quantity import Quantity, lift
from mechsheet.readers.bands import ENDS, Band, Bands, Tolerance
from mechsheet.readers.cases import JUMPS, RESULTS, Cases, goes_on
from mechsheet.worksheet import numbers
from mechsheet.worksheet.check import Check
from mechsheet.worksheet.lines import Formula
from mechsheet.worksheet.symbol import stem
from mechsheet.worksheet.table import Table

_Shown = tuple[str, str, str, Values, Node, bool]


@dataclass(frozen=True, eq=False)
class Banded:
    """Numbers that are shown, in ``unit``, with their band: a result, or a column of a table."""

    where: str
    name: str
    unit: str
    values: Values
    band: Band
    listed: bool = False  # a result that is the column of a table too

    @property
    def worst(self) -> Values:
        """Greatest deviations, in the unit; NaN where there is no number."""
        return self._of_numbers(self.band.worst)

    @property
    def squares(self) -> Values:
        """Deviations by the root of squares, in the unit; NaN likewise."""
        return self._of_numbers(self.band.squares)

    @property
    def most(self) -> float:
        """The greatest deviation of any number."""
        return float(np.max(self.worst, initial=0.0, where=~np.isnan(self.worst)))

    def _of_numbers(self, deviations: Values) -> Values:
        own = deviations.reshape(-1) / units.parse(self.unit).factor
        return np.where(np.isnan(self.values.reshape(-1)), np.nan, own)

    def told_by(self, cases: Cases, what: str, why: str = "") -> "Banded":
        """The same with what cases tell in place of a band that they are outside of: ``what`` it does, and why."""
        key = self.where, self.name
        if not (outside := cases.outside(key, self.values, self.worst, self.unit)):
            return self
        span = cases.spans.get(key)
        what = what or (goes_on(self.values, *span, self.worst) if span else JUMPS)
        return self.without(f"{what}: {outside}{why}")

    def without(self, why: str) -> "Banded":
        """The same of which no band is known, and why."""
        return replace(self, band=self.band.none(why))

    def cells(self) -> list[str]:
        """Where, name, value, worst case, root of squares: of several numbers those whose worst case is greatest."""
        after, values = numbers.suffix(self.unit), self.values.reshape(-1)
        known = values[~np.isnan(values)]
        if not known.size:
            return [self.where, self.name, numbers.CELL.none, "not known", "", "there is none at any position"]
        span = numbers.span(numbers.significant(end, 6) for end in (np.min(known), np.max(known))) + after
        if self.band.why:
            return [self.where, self.name, span, "not known", "", self.band.why]
        k = int(np.argmax(np.nan_to_num(self.worst)))
        gaps = values.size - known.size
        at = f"in row {k + 1}" if values.size > 1 else ""
        at += f"; there is none at {gaps} of {values.size} positions" if gaps else ""
        return [self.where, self.name, span, *(f"{about(x[k])}{after}" for x in (self.worst, self.squares)), at]


@dataclass(frozen=True, eq=False)
class RunBands:
    """Bands of a run: its inputs with tolerances, what has a band, how sure checks are by their names, lost cases."""

    by: Mapping[str, Tolerance]
    banded: tuple[Banded, ...]
    sure: Mapping[str, str]
    lost: tuple[str, ...] = ()

    def lines(self) -> list[str]:
        """All of it as texts, the checks left out: they stand beside their verdicts."""
        heads = ["", "", "", "worst case", "root of squares", ""]
        rows = [
            heads,
            *(row + [""] * (len(heads) - len(row)) for row in (b.cells() for b in self.banded if not b.listed)),
        ]
        shown = numbers.aligned(rows)
        return [
            f"within {', '.join(map(str, self.by.values()))}",
            *shown,
            *self.lost,
            f"{NOTE}; --tolerances --want=RESULT shows by how much one does.",
        ]

    def told(self, check: Check) -> str:
        """A check with how sure it is."""
        return f"{check}; {self.sure[check.name]}" if check.name in self.sure else str(check)


NOTE = "By the slopes: right for tolerances in which no result bends"


def run_bands(
    recording: Recording,
    tables: Iterable[Table],
    checks: Iterable[Check],
    known: Mapping[str, Formula],
    by: Mapping[str, Tolerance],
    run: Callable[[], Cases],
) -> RunBands:
    """Bands of results and of columns of tables; ``known`` are lines with a unit, ``run`` gives cases within ``by``."""
    bands = Bands(recording, by, run)
    tables = list(tables)
    shown = [*_of_lines(recording, known, {column.of for table in tables for column in table.columns})]
    shown += _of_tables(recording, tables)
    judged = {
        check.name: (recording.checks[check.name], check.passed)
        for check in checks
        if check.evaluated and check.name in recording.checks
    }
    found = bands.of(
        [node for *_, node, _ in shown] + [n for check, _ in judged.values() for n in bands.compared(check)]
    )
    banded = [Banded(where, name, unit, x, found[node], listed) for where, name, unit, x, node, listed in shown]
    seen = [[node, *(guard.holds for guard in recording.looked.get(name, ()))] for _, name, *_, node, _ in shown]
    jumping = bands.jumps(node for nodes in seen for node in nodes)
    for k, nodes in enumerate(seen):
        if jump := next((jumping[node] for node in nodes if node in jumping), None):
            lost = banded[k].band.lost
            banded[k] = banded[k].told_by(bands.cases, lost, "" if lost else f" ({bands.turns(jump)})")
    bands.look(node for nodes in seen for node in nodes)
    for k, (node, *guards) in enumerate(seen):
        if banded[k].band.lost or not (how := bands.misled(node, guards)):
            continue
        if how == ENDS:  # of which cases would tell no more than those that have numbers
            banded[k] = banded[k].without(how)
        elif not banded[k].band.why:
            banded[k] = banded[k].told_by(bands.cases, how)
    moved = tuple(each for each in banded if each.band.why or np.any(each.band.moves))
    sure = {name: bands.sure(name, passed) for name, (_, passed) in judged.items()}
    return RunBands(by, moved, sure, tuple(bands.cases.told()) if bands.ran else ())


def _of_lines(recording: Recording, known: Mapping[str, Formula], listed: set[str]) -> Iterator[_Shown]:
    for name, line in known.items():
        value = recording.values.get(name)
        chosen = line.has_value and recording.looked.get(name) and not isinstance(value, Quantity)
        if chosen and np.asarray(value).dtype.kind in "biuf":
            value = lift(recording.graph, value)  # a number that Python chose
        if not line.has_value or not isinstance(value, Quantity):
            continue
        ends = ("real", "imag") if value.im is not None else ("",)
        for node, part in zip(value.whole().parts, ends, strict=True):
            may_move = node.op != "constant" or recording.looked.get(name)
            if may_move and node.value.dtype.kind in "if" and node.size:
                values, column = (
                    node.value / units.parse(line.unit).factor,
                    not value.single and stem(name) in listed,
                )
                yield RESULTS, f"{name}.{part}" if part else name, line.unit, values, node, column


def _of_tables(recording: Recording, tables: Iterable[Table]) -> Iterator[_Shown]:
    for table in tables:
        recorded = recording.tables.get(table.number, (None,) * len(table.columns))
        for column, quantity in zip(table.columns, recorded, strict=True):
            if quantity is not None and column.values.dtype.kind in "biuf" and quantity.re.size == column.values.size:
                yield f"table {table.number}", column.name, column.unit, column.values, quantity.re, False


def about(x: float) -> str:
    """A deviation behind the sign of one; nothing in place of none."""
    return f"± {off(x)}" if np.isfinite(x) else off(x)


def off(x: float) -> str:
    """A deviation as it is shown, with two digits."""
    return numbers.apart([x], digits=2)[0] if np.isfinite(x) else numbers.CELL.none
