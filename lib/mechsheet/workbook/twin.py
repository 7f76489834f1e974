"""The places of recorded quantities in a workbook, and the formulas that stand there."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

from mechsheet import units
from mechsheet.recording.live import Line, Names, Recording
from mechsheet.recording.recorded import Node
from mechsheet.workbook.cells import Home, formula, place, reference, spread
from mechsheet.worksheet.table import Table

_STEM = 24  # letters of a section in the name of its sheets, which 31 are all that Excel takes


@dataclass
class Section:
    """Quantities behind the tables of one section: a list of all, those with many values in columns of their own."""

    title: str
    listing: str
    sheet: str
    single: list[Line] = field(default_factory=list)
    fields: list[Line] = field(default_factory=list)


class Compared(NamedTuple):
    """Formulas of a check's residual and of its limit, and the limit's value."""

    residual: str
    limit: str
    bound: float


class Twin:
    """Formulas of a workbook.

    ``inputs`` and ``found`` give the rows of their sheets by symbol, ``sheets`` the names of the tables' sheets,
    ``first`` the row of the first number on each, ``name`` makes the name of a new sheet.
    """

    def __init__(
        self,
        recording: Recording,
        tables: Sequence[Table],
        sheets: Sequence[str],
        inputs: Mapping[str, int],
        found: Mapping[str, int],
        first: int,
        name: Callable[[str], str],
    ) -> None:
        self.recording, self.tables, self.first = recording, tables, first
        self.defined: list[tuple[str, str]] = []
        self.own: set[tuple[str, int]] = set()  # columns of tables that are the place of their quantity
        self.names = Names()
        self.lines = {id(line.node): line for lines in recording.lines.values() for line in lines}
        for node in recording.recorder.nodes.values():
            node.home = None
        for symbol, node in recording.inputs.items():
            self._settle(node, symbol, "Inputs", inputs[symbol], 4)
        for solved in recording.found.values():
            line = self.lines.get(id(solved.node))
            if line and line.symbol in found and units.parse(line.unit).factor == 1:
                self._settle(solved.node, line.symbol, "Find", found[line.symbol], 1)
        for table, sheet in zip(tables, sheets, strict=True):
            for n, column in enumerate(self._nodes(table)):
                line = self.lines.get(id(column))
                if column is None or line is None or column.home or column.value.size == 1:
                    continue
                if units.parse(table.columns[n].unit).factor == 1 and column.op not in ("pick", "join"):
                    self._settle(column, line.symbol, sheet, first, n)
                    self.own.add((table.number, n))
        self.sections = self._place_others(name)

    def _nodes(self, table: Table) -> tuple[Node | None, ...]:
        columns = self.recording.tables.get(table.number, ())
        # abs(R56) is recorded as one real quantity; the parts of a complex one stand in columns of their own
        return tuple(None if c is None or c.im is not None else c.re for c in columns)

    def _settle(self, node: Node, symbol: str, sheet: str, row: int, column: int) -> None:
        node.home = Home(self.names.new(symbol), sheet, row, column)
        self.defined.append((node.home.name, node.home.meaning(node.value.size)))

    def _roots(self) -> Iterator[Node]:
        for table in self.tables:
            yield from (node for node in self._nodes(table) if node)
        for solved in self.recording.found.values():
            yield from (n for n in (solved.node, solved.inverse, solved.residual, *(solved.interval or ())) if n)
        for check in self.recording.checks.values():
            yield from check.parts
            yield check.limit
        for marks in self.recording.marks.values():
            yield from marks.values()
        yield from (node for node, _ in self.recording.recorder.guards)

    def _place_others(self, name: Callable[[str], str]) -> list[Section]:
        """Sheets for all that stands neither on a table's sheet nor among inputs and found values."""
        for n, check in enumerate(self.recording.checks.values(), 1):
            for m, part in enumerate(check.parts, 1):
                if not part.name and part.operands:
                    part.name = f"check{n}" + (f"_{m}" if len(check.parts) > 1 else "")
        placed = [node for node in place(self._roots()) if not node.home]
        waiting = {id(node): node for node in placed}
        sections: dict[str, list[Line]] = {}
        for title, lines in self.recording.lines.items():
            for line in lines:
                if waiting.pop(id(line.node), None):
                    sections.setdefault(title, []).extend(self._parts_of(line, waiting))
                    sections[title].append(line)
        for n, (stated, residual) in enumerate(self.recording.checks.items(), 1):
            bound = Line(residual.limit, f"check{n}_limit", residual.unit, f"limit: {stated}")
            parts = [Line(part, part.name, residual.unit, f"residual: {stated}") for part in residual.parts]
            for line in [*parts, bound]:
                steps = self._parts_of(line, waiting)
                own = [line] if waiting.pop(id(line.node), None) else []
                sections.setdefault("Residuals", []).extend([*steps, *own])
        for n, node in enumerate(list(waiting.values()), 1):
            rows = node.op == "rows"
            line = Line(node, "k" if rows else f"step_{n}", "", "number of the row" if rows else "step of a formula")
            sections.setdefault("Residuals", []).append(line)
        known = self.recording.sections
        order = sorted(sections, key=lambda title: known.index(title) if title in known else len(known))
        return [self._section(title, sections[title], name) for title in order]

    def _parts_of(self, line: Line, waiting: dict[int, Node]) -> list[Line]:
        """Steps of a line's formula that get a place, in the order of their calculation."""
        found: list[Line] = []
        seen: set[int] = set()

        def walk(node: Node) -> None:
            for operand in node.operands:
                if id(operand) in seen or id(operand) in self.lines or operand.home:
                    continue
                seen.add(id(operand))
                walk(operand)
                if waiting.pop(id(operand), None):
                    text = f"step of {line.symbol}"
                    found.append(Line(operand, f"{line.symbol}_{len(found) + 1}", "", text))

        walk(line.node)
        return found

    def _section(self, title: str, lines: Sequence[Line], name: Callable[[str], str]) -> Section:
        section = Section(title, "", "")
        section.single = [line for line in lines if line.node.value.size == 1]
        section.fields = [line for line in lines if line.node.value.size > 1]
        section.listing = name(f"{title[:_STEM].rstrip()} lines")
        if section.fields:
            section.sheet = name(f"{title[:_STEM].rstrip()} fields")
        for n, line in enumerate(section.single):
            self._settle(line.node, line.symbol, section.listing, 2 + n, 1)
        for n, line in enumerate(section.fields):
            self._settle(line.node, line.symbol, section.sheet, self.first, n)
        return section

    def column(self, table: Table, n: int) -> list[str] | None:
        """Formulas of a table's column in its display unit; None where it holds plain numbers."""
        columns = self._nodes(table)
        node = columns[n] if n < len(columns) else None
        if node is None or node.op == "static":
            return None
        if (table.number, n) in self.own:
            return spread(lambda k: formula(node, k), node, own=True)
        factor = units.parse(table.columns[n].unit).factor
        if node.value.size == 1:
            return [reference(node, 0, 0, factor)] * len(table.columns[n].values)
        return spread(lambda k: reference(node, k, k, factor), node, own=False)

    def line(self, line: Line) -> list[str] | None:
        """Formulas of a quantity of a section; None where it holds plain numbers."""
        for solved in self.recording.found.values():
            if solved.node is line.node:
                return [reference(solved.inverse)] if solved.inverse else None
        if line.node.op == "static":
            return None
        return spread(lambda k: formula(line.node, k), line.node, own=True)

    def found(self, unknown: str, unit: str, target_unit: str) -> tuple[str | None, ...]:
        """Formulas of a found value, of what it leaves of its equation, and of its interval; None where none is."""
        solved = self.recording.found.get(unknown)
        if solved is None:
            return None, None, None, None
        factor, target = units.parse(unit).factor, units.parse(target_unit).factor
        here = solved.node.home and solved.node.home.sheet == "Find"
        source = solved.inverse if here else solved.node
        value = reference(source, 0, 0, factor) if source and (source.home or solved.inverse) else None
        left = reference(solved.residual, 0, 0, target) if solved.residual else None
        low, high = (reference(end, 0, 0, factor) for end in solved.interval) if solved.interval else (None, None)
        return value, left, low, high

    def closed(self, unknown: str) -> bool:
        """Whether a found value is computed by its closed form."""
        solved = self.recording.found.get(unknown)
        return solved is not None and solved.inverse is not None

    def check(self, name: str) -> "Compared | None":
        """Formulas of a check; None where it holds plain numbers."""
        check = self.recording.checks.get(name)
        if check is None:
            return None
        parts = [p.home.range(0, p.value.size - 1) if p.value.size > 1 else reference(p)[1:] for p in check.parts]
        largest = parts[0] if check.signed else f"MAX({','.join(parts)})"
        factor = units.parse(check.unit).factor
        residual = f"={largest}" + (f"/{factor!r}" if factor != 1 else "")
        return Compared(residual, reference(check.limit, 0, 0, factor), check.limit.value.item() / factor)

    def guard(self) -> str:
        """Formula of how many of the conditions that the worksheet's code looked at have changed; "" without any."""
        texts = set()
        for node, seen in self.recording.recorder.guards:
            if not _depends(node):
                continue
            text = reference(node)[1:]
            texts.add(f"IF({text},{'0,1' if seen else '1,0'})" if isinstance(seen, bool) else f"IF({text}={seen},0,1)")
        return "=" + "+".join(sorted(texts)) if texts else ""

    def mark(self, figure: str, label: str, unit: str) -> str | None:
        node = self.recording.marks.get(figure, {}).get(label)
        return reference(node, 0, 0, units.parse(unit).factor) if node else None


def _depends(node: Node) -> bool:
    """Whether a quantity rests on an input or a found value."""
    stack, seen = [node], {id(node)}
    while stack:
        here = stack.pop()
        if here.op in ("input", "found"):
            return True
        for operand in here.operands:
            if id(operand) not in seen:  # many quantities share their operands
                seen.add(id(operand))
                stack.append(operand)
    return False
