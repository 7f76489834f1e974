"""The formulas that stand on the sheets of a workbook: of inputs, tables, found values, checks, marks and lines."""

from typing import NamedTuple

from mechsheet import units
from mechsheet.recording.graph import Node
from mechsheet.recording.lines import Line
from mechsheet.workbook.arrangement import Arrangement
from mechsheet.workbook.cell_formula import CellFormulas
from mechsheet.worksheet.table import Table


class Compared(NamedTuple):
    """Formulas of a check's residual and of its limit, and the limit's value."""

    residual: str
    limit: str
    bound: float


class SheetFormulas:
    """Formulas of the quantities of a recording that stand as an `Arrangement` says."""

    def __init__(self, arrangement: Arrangement) -> None:
        self.arrangement, self.recording = arrangement, arrangement.recording
        self._cells = CellFormulas(arrangement.places)

    def name(self, node: Node) -> str:
        """Defined name of a quantity that has a place."""
        return self.arrangement.places[node].name

    def column(self, table: Table, n: int) -> list[str] | None:
        """Formulas of a table's column in its display unit; None where it holds plain numbers."""
        columns = self.arrangement.columns(table)
        node = columns[n] if n < len(columns) else None
        if node is None or node.op == "static":
            return None
        if (table.number, n) in self.arrangement.own:
            return self._cells.formulas(node)
        factor = units.parse(table.columns[n].unit).factor
        if node.size == 1:
            return [self._cells.reference(node, 0, 0, factor)] * len(table.columns[n].values)
        return self._cells.references(node, factor)

    def line(self, line: Line) -> list[str] | None:
        """Formulas of a quantity of a section; None where it holds plain numbers."""
        for solved in self.recording.found.values():
            if solved.node is line.node:
                return [self._cells.reference(solved.inverse)] if solved.inverse else None
        return None if line.node.op == "static" else self._cells.formulas(line.node)

    def found(self, unknown: str, unit: str, target_unit: str) -> tuple[str | None, ...]:
        """Formulas of a found value, of what it leaves of its equation, and of its interval; None where none is."""
        solved = self.recording.found.get(unknown)
        if solved is None:
            return None, None, None, None
        factor, target = units.parse(unit).factor, units.parse(target_unit).factor
        place = self.arrangement.places.get(solved.node)
        source = solved.inverse if place and place.sheet == "Find" else solved.node
        shown = source and (source in self.arrangement.places or solved.inverse)
        reference = self._cells.reference
        value = reference(source, 0, 0, factor) if source and shown else None
        left = reference(solved.residual, 0, 0, target) if solved.residual else None
        low, high = (reference(end, 0, 0, factor) for end in solved.interval) if solved.interval else (None, None)
        return value, left, low, high

    def closed(self, unknown: str) -> bool:
        """Whether a found value is computed by its closed form."""
        solved = self.recording.found.get(unknown)
        return solved is not None and solved.inverse is not None

    def check(self, name: str) -> Compared | None:
        """Formulas of a check; None where it holds plain numbers."""
        check = self.recording.checks.get(name)
        if check is None:
            return None
        places, reference = self.arrangement.places, self._cells.reference
        parts = [places[p].range(0, p.size - 1) if p.size > 1 else reference(p)[1:] for p in check.parts]
        largest = parts[0] if check.signed else f"MAX({','.join(parts)})"
        factor = units.parse(check.unit).factor
        residual = f"={largest}" + (f"/{factor!r}" if factor != 1 else "")
        return Compared(residual, reference(check.limit, 0, 0, factor), check.limit.value.item() / factor)

    def guard(self) -> str:
        """Formula of how many of the conditions that the worksheet's code looked at have changed; "" without any."""
        texts = set()
        for node, seen in self.recording.graph.guards:
            if not _depends(node):
                continue
            text = self._cells.reference(node)[1:]
            texts.add(f"IF({text},{'0,1' if seen else '1,0'})" if isinstance(seen, bool) else f"IF({text}={seen},0,1)")
        return "=" + "+".join(sorted(texts)) if texts else ""

    def mark(self, figure: str, label: str, unit: str) -> str | None:
        """Formula of the position that a figure marks; None where it is a plain number."""
        node = self.recording.marks.get(figure, {}).get(label)
        return self._cells.reference(node, 0, 0, units.parse(unit).factor) if node else None


def _depends(node: Node) -> bool:
    """Whether a quantity rests on an input or a found value."""
    stack, seen = [node], {node}
    while stack:
        here = stack.pop()
        if here.op in ("input", "found"):
            return True
        for operand in here.operands:
            if operand not in seen:  # many quantities share their operands
                seen.add(operand)
                stack.append(operand)
    return False
