"""What a recording holds: lines and steps by their names, columns of tables, checks, found values and marks."""

import ast
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import lru_cache
from itertools import chain
from operator import attrgetter
from typing import Any, NamedTuple

import numpy as np

from mechsheet.quantities.graph import Gap, Graph, Guard
from mechsheet.quantities.node import Node, steps_of
from mechsheet.quantities.operations import Values
from mechsheet.quantities.quantity import Quantity
from mechsheet.quantities.sketch import Drawn
from mechsheet.quantities.written import Said, Written
from mechsheet.worksheet import symbol
from mechsheet.worksheet.lines import Formula

SLIDER = "slider "  # before the name of one among the inputs


@dataclass
class Line:
    """One quantity by its name: where it is defined, the number of its printed formula, where it stands."""

    node: Node
    symbol: str
    unit: str
    meaning: str
    text: str = ""
    number: str = ""
    holds: tuple[Node, ...] = ()  # of a step: what must hold for anybody to ask for it


@dataclass
class Residual:
    """What a check compares, in SI: the largest of some magnitudes, or one signed number, with its limit.

    With ``at_least`` it is the smallest of some signed numbers that has a limit from below.
    ``where`` it looks, if at some positions alone: those that tables list, where the worksheet looks at all of them.
    """

    parts: list[Node]
    limit: Node
    unit: str
    signed: bool = False
    where: str = ""
    at_least: bool = False

    def keeps(self, numbers: Values, limit: Values) -> Values:
        """Which numbers of what is compared keep the limit."""
        if self.at_least:
            return np.asarray(numbers >= limit)
        return np.asarray((numbers if self.signed else np.abs(numbers)) <= limit)

    def holds(self, there: Mapping[Node, Values]) -> bool:
        """Whether the check does where its quantities have these numbers."""
        return all(self.keeps(there[part], there[self.limit]).all() for part in self.parts)


class Told(NamedTuple):
    """What a solve block says of an unknown and of the equation that stands beside it: words and display units."""

    unknown: str
    quantity: str
    unit: str
    unknown_unit: str


@dataclass
class Solved:
    """A found value: what it leaves of its equation, its interval or guess, its closed form where there is one.

    Of one unknown the ``target`` is what its equation must be. How it is ``searched`` in place of a closed form, and
    the check by whose name it is ``compared`` with that. In the cells of a workbook the closed form is the value where
    the condition ``sure`` holds.
    """

    node: Node
    residual: Node | None
    interval: tuple[Node, Node] | None
    words: Told
    inverse: Node | None = None
    target: Node | None = None
    searched: str = ""
    compared: str = ""
    sure: Node | None = None


@dataclass
class Recording:
    """The quantities of a worksheet, cell by cell, and what it shows of them.

    ``tables`` are the columns by the number of a table, of a figure under ``Fig 1``, ``constants`` those of them that
    hold the same numbers for all inputs, ``labels`` those of texts: the name of their input, or all that may
    stand there, and which ones do;
    ``arguments`` others that are recorded, by names such as ``table 1 decimals``,
    ``worded`` what is a number while a ``table 1 title`` or note, or a ``check stress name``, that inputs change is
    that of the run or can be said, ``said`` those with recorded numbers or texts in them; ``marks`` the marks of a
    figure by its number
    and their labels; ``lines`` those of a section, ``others`` such as are the same for all inputs or but another name
    for a quantity; ``names`` the name that each node has in the worksheet. ``gaps`` are what keeps the numbers of the
    worksheet's own run, with the reasons, ``unsolved`` what does so in the cells of a workbook alone: found values, and
    numbers that are ``lost`` there, or would be others; ``guards`` the conditions under which all is recorded as the
    worksheet has it; ``integrals`` what a rule of places gives, with scipy's estimates of the errors where these are
    taken; ``drawings`` those that a cell shows, by its number, or None for one that is not recorded; ``captions`` and
    ``texts`` what captions, by their numbers, and cells say in texts that are others for other inputs, ``unsaid`` why
    one of a cell is not recorded; ``positions``
    what is marked along charts, by the name of its quantity; ``values`` what the names are in the recording, ``looked``
    the guards that these rest on. Only every ``every``-th position is recorded.
    """

    graph: Graph
    inputs: dict[str, Node]
    tables: dict[str, tuple[Quantity | None, ...]] = field(default_factory=dict)
    checks: dict[str, Residual] = field(default_factory=dict)
    found: dict[str, Solved] = field(default_factory=dict)
    lines: dict[str, list[Line]] = field(default_factory=dict)
    others: dict[str, list[Line]] = field(default_factory=dict)
    constants: set[tuple[str, int]] = field(default_factory=set)
    labels: dict[tuple[str, int], tuple[str | tuple[str | Written, ...], Quantity]] = field(default_factory=dict)
    arguments: dict[str, Node] = field(default_factory=dict)
    worded: dict[str, Node] = field(default_factory=dict)
    marks: dict[str, dict[str, Node]] = field(default_factory=dict)
    drawings: dict[int, list[Drawn | None]] = field(default_factory=dict)
    positions: dict[str, Node] = field(default_factory=dict)
    said: dict[str, Written] = field(default_factory=dict)
    captions: dict[str, Said] = field(default_factory=dict)
    texts: dict[int, list[Said]] = field(default_factory=dict)
    unsaid: dict[int, str] = field(default_factory=dict)
    gaps: list[Gap] = field(default_factory=list)
    unsolved: list[Gap] = field(default_factory=list)
    lost: dict[Node, bool] = field(default_factory=dict)
    guards: dict[Node, Guard] = field(default_factory=dict)  # by their conditions
    integrals: dict[Node, Node | None] = field(default_factory=dict)
    made_of: dict[Node, float] = field(default_factory=dict)  # the largest terms of sums, as far as looked at
    values: Mapping[str, Any] = field(default_factory=dict)
    looked: dict[str, tuple[Guard, ...]] = field(default_factory=dict)
    every: int = 1
    sections: list[str] = field(default_factory=list)
    names: dict[Node, str] = field(default_factory=dict)

    def leave_out(self, names: Iterable[str], line: int, reason: str) -> None:
        """Note what a statement leaves out, with what it has left out already."""
        same = self.gaps and self.gaps[-1][1:] == (line, reason)
        before = self.gaps.pop().names if same else ()
        self.gaps.append(Gap(tuple(dict.fromkeys((*before, *names))), line, reason))

    def define(self, section: str, name: str, value: Any, known: Mapping[str, Formula], arrays: bool = False) -> None:
        """Give the quantities of a line its name, and the steps behind it theirs; those of constants if ``arrays``."""
        if not isinstance(value, Quantity):
            return
        lines = self.lines.setdefault(section, [])
        stem = _stem(name)
        for line in _parts_of(name, value, known.get(name)):
            given = line.node.op == "constant" and not (arrays and line.node.size > 1)
            if given or line.node.op == "input" or line.node in self.names:
                continue
            self.names[line.node] = line.symbol
            self._name_steps(line.node, stem, lines)
            lines.append(line)

    def also(self, section: str, name: str, value: Quantity, line: Formula) -> None:
        """Note the quantities of a line that have no name of their own, for they have another one or need none."""
        for part in _parts_of(name, value, line):
            if self.names.get(part.node) != part.symbol:
                self.others.setdefault(section, []).append(part)

    def name_said(self, check: str) -> Written | None:
        """The name of a check with the recorded numbers or texts in it; None of one without."""
        return self.said.get(f"check {check} name")

    def texts_of_rows(self) -> Iterator[Written]:
        """Texts with numbers in them that tables show in their rows."""
        for texts, _ in self.labels.values():
            yield from (text for text in texts if isinstance(text, Written))

    def shown(self) -> Iterator[Node]:
        """What the tables, figures, checks, found values and marks are made of."""
        columns = chain.from_iterable(self.tables.values())
        yield from chain.from_iterable(column.parts for column in columns if column is not None)
        for check in self.checks.values():
            yield from (*check.parts, check.limit)
        yield from chain.from_iterable(text.nodes for text in (*self.said.values(), *self.texts_of_rows()))
        for solved in self.found.values():
            yield from filter(None, (solved.node, solved.inverse, solved.residual))
        for marks in self.marks.values():
            yield from marks.values()

    def define_steps(self, section: str, solved: Solved) -> None:
        """Give the steps of a found value's closed form and residual their names."""
        lines = self.lines.setdefault(section, [])
        for node in (solved.inverse, solved.residual):
            if node and node not in self.names:
                self._name_steps(node, self.names.get(solved.node, ""), lines)

    def _name_steps(self, node: Node, stem: str, lines: list[Line]) -> None:
        for step in steps_of(node, attrgetter("operands"), self.names):
            if step.op != "constant" and (label := self.graph.labels.get(step)):
                self.names[step] = f"{stem}_{label.symbol}"
                lines.append(Line(step, self.names[step], label.unit, label.meaning))


def _stem(name: str) -> str:
    return name.removesuffix("_S") if symbol.is_field(name) else name


def _parts_of(name: str, value: Quantity, line: Formula | None) -> Iterator[Line]:
    """What a name stands for, a complex quantity in two parts, with what its line says of it."""
    unit, meaning, number = (line.unit, line.meaning, line.number) if line else ("", "", "")
    text = _source(line.expression) if line and not line.again else ""
    ends = ("real", "imag") if value.im is not None else ("",)
    for node, part in zip(value.parts, ends, strict=True):
        yield Line(node, _coordinate(_stem(name), part), unit, meaning, text, number)


def _coordinate(name: str, part: str) -> str:
    axis = {"real": "x", "imag": "y"}.get(part, "")
    return axis.upper() + name[1:] if axis and name.startswith("P") else name + axis


_source = lru_cache(maxsize=4096)(ast.unparse)


def leaves_of(roots: Iterable[Node], recording: Recording) -> list[Node]:
    """Inputs that quantities rest on; of found values those of their equations."""
    order, found = {node: n for n, node in enumerate(recording.inputs.values())}, dict[Node, None]()
    waiting, visited = list(roots), set[Node]()
    while waiting:
        node = waiting.pop()
        if node in visited:
            continue
        visited.add(node)
        if node in order:  # else it stands for a number that is written
            found[node] = None
        waiting.extend(node.operands)
    return sorted(found, key=order.__getitem__)
