"""Where the recorded quantities stand in a workbook: which of them need a cell or a column, and on which sheet."""

from collections import Counter
from collections.abc import Callable, Container, Iterable, Iterator, Mapping, Sequence, Set
from dataclasses import dataclass
from itertools import chain

import numpy as np

from mechsheet import units
from mechsheet.quantities.lines import Line, Recording
from mechsheet.quantities.node import LEAVES, Node, bottom_up, steps_of
from mechsheet.readers.infinite import carries
from mechsheet.workbook.cell_formula import CellFormulas, nesting, written_of
from mechsheet.workbook.place import DefinedNames, Place, called
from mechsheet.worksheet.table import Table

_LIGHT = 6  # operations that a formula repeats rather than give them a cell
_HEAVY = 60  # operations that one formula holds at most
_WIDE = 64  # columns on one sheet: in a file with wider rows their repetitions are out of the compression's sight
_LONG = 10_000  # numbers of a column on which nothing rests that is shown
_DEEP = 6  # parentheses inside each other in one formula, to which what a sheet puts around it adds two


@dataclass
class Section:
    """Quantities of one section: a list of all, those with many values in columns of sheets."""

    title: str
    listing: str
    single: list[Line]
    fields: dict[str, list[Line]]  # by the sheet on which they stand
    others: list[Line]  # which stand elsewhere, or are single numbers that nothing changes


class Arrangement:
    """The places of the quantities of a recording, and the names that mean them.

    ``changed`` is the place of how many inputs differ from the exported ones, ``followed`` are those on which formulas
    rest, ``last`` the results where nothing is found. ``inputs`` gives their places and ``found`` the rows of the sheet
    Find by symbol, ``sheets`` the names of the tables' sheets, ``first`` the row of the first number on each, ``name``
    makes that of a new sheet of a title and an ending.
    """

    def __init__(
        self,
        recording: Recording,
        tables: Sequence[Table],
        sheets: Sequence[str],
        inputs: Mapping[str, Place],
        changed: Place,
        found: Mapping[str, int],
        first: int,
        name: Callable[[str, str], str],
    ) -> None:
        self.recording, self.tables, self.first = recording, tables, first
        self.defined: list[tuple[str, str]] = []
        self.own: set[tuple[str, int]] = set()  # columns of tables that are the place of their quantity
        self.places: dict[Node, Place] = {}
        self.lines = {line.node: line for lines in recording.lines.values() for line in lines}
        long = too_long(recording)
        self.own_lines = [line for line in declared(recording) if line.node.size and line not in long]
        self.last = [] if found else last_lines(recording, self.own_lines)
        self._names = DefinedNames()
        self.changed = self._defined(changed, changed.name, 1)
        for symbol, node in recording.inputs.items():
            place = inputs[symbol]._replace(aligned=node.size == 1)
            self.places[node] = self._defined(place, symbol, node.size)
        under = set(bottom_up(self._roots(), ()))
        self.followed = {symbol for symbol, node in recording.inputs.items() if node in under}
        for solved in recording.found.values():
            line = self.lines.get(solved.node)
            if line and line.symbol in found and units.parse(line.unit).factor == 1:
                self._settle(solved.node, line.symbol, "Find", found[line.symbol], 1)
        self.finite = not any(n.op in ("constant", "exported") and np.isinf(n.value + 0.0).any() for n in under)
        endless = CellFormulas({}, finite=self.finite).endless
        for table, sheet in zip(tables, sheets, strict=True):
            for n, column in enumerate(self.columns(table)):
                line = self.lines.get(column) if column else None
                if column is None or line is None or column in self.places or column.size == 1:
                    continue
                plain = table.columns[n].factor == 1 and column.op not in ("take", "join")
                plain &= (table.number, n) not in recording.labels
                if plain and not endless(column):
                    self._settle(column, line.symbol, sheet, first, n)
                    self.own.add((table.number, n))
        self.sections = self._place_others(name)

    def columns(self, table: Table) -> tuple[Node | None, ...]:
        """Quantities of a table's columns; None where one holds plain numbers."""
        columns = self.recording.tables.get(table.number, ())
        # abs(R56) is recorded as one real quantity; the parts of a complex one stand in columns of their own
        nodes = [None if c is None or c.im is not None else c.re for c in columns]
        return (*nodes, *[None] * (len(table.columns) - len(nodes)))

    def _settle(self, node: Node, symbol: str, sheet: str, row: int, column: int) -> None:
        self.places[node] = self._defined(Place("", sheet, row, column), symbol, node.size)

    def _defined(self, place: Place, symbol: str, size: int) -> Place:
        """A place under a name of its own."""
        named = place._replace(name=self._names.new(symbol.replace(".", "_")))
        self.defined.append((named.name, named.meaning(size)))
        return named

    def _roots(self) -> Iterator[Node]:
        for table in self.tables:
            yield from (node for node in self.columns(table) if node)
        for solved in self.recording.found.values():
            told = solved.inverse, solved.residual, solved.target, solved.sure
            yield from (n for n in (solved.node, *told, *(solved.interval or ())) if n)
        for check in self.recording.checks.values():
            yield from check.parts
            yield check.limit
        for marks in self.recording.marks.values():
            yield from marks.values()
        yield from self.recording.worded.values()
        yield from chain.from_iterable(
            text.nodes for text in (*self.recording.said.values(), *self.recording.texts_of_rows())
        )
        yield from self.recording.guards
        yield from (line.node for line in self.own_lines)

    def _place_others(self, name: Callable[[str, str], str]) -> list[Section]:
        """Sheets for all that stands neither on a table's sheet nor among inputs and found values."""
        names = dict(self.recording.names)
        checks = [(name if (said := self.recording.name_said(name)) is None else said.fixed, each)
                  for name, each in self.recording.checks.items()]  # fmt: skip
        for stated, check in checks:
            for m, part in enumerate(check.parts, 1):
                if part not in names and part.operands:
                    names[part] = called(stated) + (f"_{m}" if len(check.parts) > 1 else "")
        sure = {each.sure: names.get(each.node, "root") for each in self.recording.found.values() if each.sure}
        named = names.keys() | self.recording.graph.labels.keys() | sure.keys() | self.recording.lost.keys()
        if not self.finite:  # their formulas have what they compute with twice
            infinite = dict[Node, bool]()
            named = {*named, *(node for node in bottom_up(self._roots(), ()) if carries(node, infinite))}
        placed = [node for node in needing_place(self._roots(), named, self.places) if node not in self.places]
        waiting = {node: node for node in placed}
        known = self.lines.keys() | self.places.keys()
        sections: dict[str, list[Line]] = {}
        for title, lines in self.recording.lines.items():
            for line in lines:
                if waiting.pop(line.node, None):
                    sections.setdefault(title, []).extend(self._parts_of(line, waiting, known))
                    sections[title].append(line)
        for stated, residual in checks:
            bound = Line(residual.limit, f"{called(stated)}_limit", residual.unit, f"limit: {stated}")
            parts = [Line(part, names.get(part, ""), residual.unit, f"residual: {stated}") for part in residual.parts]
            for line in [*parts, bound]:
                steps = self._parts_of(line, waiting, known)
                own = [line] if waiting.pop(line.node, None) else []
                if steps or own:
                    sections.setdefault("Residuals", []).extend([*steps, *own])
        for n, node in enumerate(list(waiting.values()), 1):
            symbol, meaning = f"step_{n}", "step of a formula"
            if node.op == "rows":
                symbol, meaning = "k", "number of the row"
            elif node in sure:
                symbol, meaning = f"{sure[node]}_sure", f"whether the closed form of {sure[node]} is what is found"
            sections.setdefault("Residuals", []).append(Line(node, symbol, "", meaning))
        asked = self._asked_while()
        for line in chain.from_iterable(sections.values()):
            line.holds = () if line.text else asked.get(line.node, ())
        every = self.recording.sections
        titles = sections.keys() | self.recording.others.keys()
        order = sorted(titles, key=lambda title: (every.index(title) if title in every else len(every), title))
        return [self._section(title, sections.get(title, []), name) for title in order]

    def _parts_of(self, line: Line, waiting: dict[Node, Node], known: Set[Node]) -> list[Line]:
        """Steps of a line's formula that get a place, in the order of their calculation."""
        steps = [step for step in steps_of(line.node, written_of, known) if waiting.pop(step, None)]
        meaning = f"step of {line.symbol if line.text else line.meaning}"
        return [Line(step, f"{line.symbol}_{n}", "", meaning) for n, step in enumerate(steps, 1)]

    def _asked_while(self) -> dict[Node, tuple[Node, ...]]:
        """For each quantity the inputs that Python has looked at, and must see again where it is asked for.

        Of other ones its formula has what Python had made of them.
        """
        seen = (guard.holds for guards in self.recording.looked.values() for guard in guards if not guard.rows)
        looked = dict.fromkeys(holds for holds in seen if holds.op == "eq" and holds.args[0].op == "input")
        if not looked:
            return {}
        roots = list(self._roots())
        found = dict.fromkeys(roots, frozenset[Node]())
        for node in reversed([*bottom_up(roots, ())]):
            for operand in node.operands:
                under = found[node]
                if node.op == "where" and node.args[0] in looked and operand is node.args[1] and _is_none(node.args[2]):
                    under |= {node.args[0]}
                found[operand] = found.get(operand, under) & under
        return {node: tuple(each for each in looked if each in holds) for node, holds in found.items() if holds}

    def _section(self, title: str, lines: Sequence[Line], name: Callable[[str, str], str]) -> Section:
        single, fields = ([line for line in lines if (line.node.size > 1) == many] for many in (False, True))
        others = [
            *self.recording.others.get(title, []),
            *(line for line in self.recording.lines.get(title, []) if not line.node.size),
        ]
        section = Section(title, name(title, " lines"), single, {}, others)
        for n, line in enumerate(single):
            self._settle(line.node, line.symbol, section.listing, 2 + n, 1)
        for start in range(0, len(fields), _WIDE):
            sheet = name(title, " fields")
            section.fields[sheet] = fields[start : start + _WIDE]
            for n, line in enumerate(section.fields[sheet]):
                self._settle(line.node, line.symbol, sheet, self.first, n)
        return section


def _is_none(node: Node) -> bool:
    return node.op == "constant" and bool(np.isnan(node.value).all())


def declared(recording: Recording) -> list[Line]:
    """Lines that declare a unit, among them such as are another name for what no other line shows."""
    lines, others = ([line for lines in each.values() for line in lines if line.text and line.unit]
                     for each in (recording.lines, recording.others))  # fmt: skip
    shown = {line.node for line in lines}
    return [*lines, *(line for line in others if line.node.op not in LEAVES and line.node not in shown)]


def last_lines(recording: Recording, lines: Sequence[Line]) -> list[Line]:
    """Those of some lines that are single numbers on which no other line rests."""
    every = chain.from_iterable(recording.lines.values())
    under = set(bottom_up((operand for line in every for operand in line.node.operands), ()))
    last = (line for line in lines if line.node.size == 1 and line.node not in under)
    return [line for line in last if any(part.op != "constant" for part in _while_known(line.node))]


def _while_known(node: Node) -> Sequence[Node]:
    """What a quantity is while something holds, and what it is else; any other one itself."""
    return node.args[1:] if node.op == "where" else (node,)


def too_long(recording: Recording) -> list[Line]:
    """Lines that rest on more numbers than a column shall have, of which nothing is needed for what is shown."""
    if not any(node.size > _LONG for node in recording.graph.nodes.values()):
        return []
    lines, long = declared(recording), set[Node]()
    for node in bottom_up([line.node for line in lines], set(bottom_up(recording.shown(), ()))):
        if node.size > _LONG or not long.isdisjoint(node.operands):
            long.add(node)
    return [line for line in lines if line.node in long]


def needing_place(roots: Iterable[Node], named: Set[Node], places: Container[Node]) -> list[Node]:
    """Quantities behind ``roots`` that need a place of their own, the ones they rest on first.

    These are the ``named`` ones, those that have one of the ``places`` already, what a sum or a greatest value is taken
    of, what would make a formula too long or too deep, or stand in several of them, and what differs from row to row:
    numbers, and elements of several quantities.
    """
    order, parts = list[Node](), dict[Node, tuple[Node, ...]]()
    stack = [(root, False) for root in roots]
    while stack:
        node, done = stack.pop()
        if done:
            order.append(node)
        elif node not in parts:
            parts[node] = written_of(node)
            stack.append((node, True))
            stack.extend((operand, False) for operand in parts[node])
    uses = Counter(operand for node in order for operand in parts[node])
    placed, weight, depth = dict[Node, None](), dict[Node, int](), dict[Node, int]()
    for node in order:
        own = 1 + sum(weight[operand] for operand in parts[node]) if parts[node] else 0
        deep = nesting(node, depth)
        known = node in named or node.op in (*LEAVES, "rows", "found") or node in places
        repeated = uses[node] > 1 and own > _LIGHT and node.op not in ("take", "join")
        if node.op in ("constant", "input") or (node.op == "rows" and node.size == 1):
            own = 0
            if node.size > 1 and not np.array_equal(node.value, np.full_like(node.value, node.value.flat[0]), True):
                placed[node] = None  # one formula a column: it refers to what differs from row to row
        elif (
            (node.op == "join" and len(set(node.args[1].flat)) > 1)
            or known
            or repeated
            or own > _HEAVY
            or deep >= _DEEP
        ):
            placed[node] = None
            own = deep = 0
        if node.op in ("reduce", "at") and node.args[0].op != "input" and node.args[0] in parts[node]:
            placed.setdefault(node.args[0])
        weight[node], depth[node] = own, deep
    return [node for node in placed if node.size]
