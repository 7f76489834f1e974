"""Numbers of a run that a proof is asked of: columns of tables, and results by themselves."""

from collections.abc import Collection, Iterable, Iterator, Mapping
from typing import Any, NamedTuple

import numpy as np

from mechsheet.quantities.lines import Recording
from mechsheet.quantities.node import LEAVES, Node
from mechsheet.quantities.operations import Values
from mechsheet.quantities.quantity import Quantity
from mechsheet.worksheet.lines import Formula
from mechsheet.worksheet.table import Table


class Shown(NamedTuple):
    """Numbers that are shown, in a unit, the line where they are defined, and the quantity that they are."""

    where: str
    name: str
    line: int
    node: Node | None
    factor: float
    own: Values

    @property
    def at(self) -> str:
        """Before what is told of it; nothing of what no line defines, such as a column that code makes."""
        return f"line {self.line}: " if self.line else ""

    @property
    def size(self) -> float:
        """Largest magnitude, in the unit."""
        return float(np.max(np.abs(self.own), initial=0.0, where=np.isfinite(self.own)))


def of_tables(recording: Recording, tables: Iterable[Table], lines: Mapping[str, int]) -> Iterator[Shown]:
    for table in tables:
        recorded = recording.tables.get(table.number, (None,) * len(table.columns))
        for n, (column, quantity) in enumerate(zip(table.columns, recorded, strict=True)):
            if column.values.dtype.kind in "biuf" and (table.number, n) not in recording.constants:  # which is given
                line = lines.get(column.of) or lines.get(f"{column.of}_S", 0)
                node, factor = None if quantity is None else quantity.re, column.factor
                yield Shown(f"table {table.number}", column.symbol, line, node, factor, column.values)


def of_lines(
    recording: Recording,
    namespace: Mapping[str, Any],
    known: Mapping[str, Formula],
    lines: Mapping[str, int],
    fields: Collection[str],
) -> Iterator[Shown]:
    for name, line in known.items():
        quantity, own = recording.values.get(name), np.asarray(namespace.get(name))
        if not line.has_value or not isinstance(quantity, Quantity) or own.dtype.kind not in "biufc":
            continue
        if name in fields or (quantity.single and own.size == 1):
            for node, part in zip(quantity.whole().parts, (own.real, own.imag), strict=False):
                if node.op not in LEAVES:
                    yield Shown("results", name, lines.get(name, 0), node, 1.0, part.reshape(-1))
