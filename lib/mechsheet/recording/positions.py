"""Runs over the positions that tables list: what of them rests on all positions, as a sum or a check does."""

from abc import ABC, abstractmethod
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any, Self, TypeVar

import numpy as np

from mechsheet import units
from mechsheet.quantities.graph import Graph
from mechsheet.quantities.lines import Recording, Residual
from mechsheet.quantities.node import Node, bottom_up
from mechsheet.quantities.quantity import Quantity
from mechsheet.quantities.text_column import Texts
from mechsheet.worksheet.check import Check
from mechsheet.worksheet.lines import Formula
from mechsheet.worksheet.table import Figure, Table

T = TypeVar("T")
_MORE = 1_000_000  # operations on single numbers that checks over all positions take at most, beside those of tables


def step_of(namespace: Mapping[str, Any]) -> int:
    """Every how many positions all tables of a run list; 1 where some list others."""
    steps = {table.every for table in _shown(namespace, Table)}
    return steps.pop() if len(steps) == 1 else 1


def rows_of(namespace: Mapping[str, Any]) -> frozenset[int]:
    """How many rows the tables of a run have."""
    return frozenset(len(table.columns[0].values) for table in _shown(namespace, Table))


def lacking(run: "OfPositions", namespace: Mapping[str, Any]) -> tuple[bool, bool, int]:
    """Whether a run has other rows than the worksheet's tables and figures, other words, and how many gaps.

    It has where some fields are of other positions than those that tables list, or given and not made by `linspace`.
    """
    recording = run.recording
    own = {table.number: len(table.columns[0].values) for table in _shown(namespace, Table)}
    own |= {f"Fig {figure.number}": len(figure.x.values[:: recording.every]) for figure in _shown(namespace, Figure)}
    columns = ((own.get(number), c) for number, of in recording.tables.items() for c in of if c is not None)
    others = any(count not in (None, column.extent[-1]) for count, column in columns)
    return others, run.says_otherwise(namespace), len(recording.gaps)


def _shown(namespace: Mapping[str, Any], kind: type[T]) -> Iterator[T]:
    groups = (value if isinstance(value, tuple | list) else [value] for value in namespace.values())
    yield from (value for group in groups for value in group if isinstance(value, kind))


class OfPositions(ABC):
    """A run of a worksheet's cells over the positions that its tables list.

    ``lines`` declare a unit, ``names`` are what it knows of them, and the ``namespace`` is the worksheet's own.
    """

    namespace: Mapping[str, Any]
    names: dict[str, Any]
    lines: Mapping[str, Formula]

    def __init__(self, recording: Recording) -> None:
        self.recording, self.graph = recording, recording.graph
        self.over_all_positions = list[Self]()  # a run of the same graph, once it is needed
        self.of_rows = dict[Node, tuple[bool, bool]]()  # whether it rests on the positions listed; on a sum of them

    @abstractmethod
    def again(self) -> Self:
        """Another run of the same graph."""

    def everywhere(self) -> Self:
        """A run of the same graph over all positions."""
        graph = self.graph
        if not self.over_all_positions:
            kept = graph.thin, graph.most, graph.line, graph.looked, graph.numbered, graph.work
            graph.thin, graph.most = 1, _MORE
            try:
                with graph.labelled({}):  # what only this run needs is no named step
                    self.over_all_positions.append(self.again())
            finally:
                graph.thin, graph.most, graph.line, graph.looked, graph.numbered, graph.work = kept
        return self.over_all_positions[0]

    def over_all(self, names: Sequence[str]) -> None:
        """Take numbers from the run over all positions."""
        for name in names:
            run = self.everywhere()
            if name in run.names:
                self.names[name] = value = _listed(self.graph, run.names[name])
                value = value.at if isinstance(value, Texts) else value
                if isinstance(value, Quantity):
                    self.guard_as(run, value.parts)
                    if not value.single:
                        self.of_rows |= dict.fromkeys(value.parts, (True, False))

    def guard_as(self, run: "OfPositions", nodes: Iterable[Node]) -> None:
        """Take over the guards of another run on which quantities rest."""
        guards = run.recording.guards
        if guards:
            under = list(bottom_up(nodes, ()))
            under += bottom_up((node.args[2] for node in under if node.op == "iterated"), under)
            self.recording.guards |= {node: guards[node] for node in under if node in guards}

    def check_everywhere(self) -> None:
        """Let checks look at all positions while that is not too much; the others look at those listed."""
        recording, left = self.recording, _MORE
        columns = (part for table in recording.tables.values() for c in table if c is not None for part in c.parts)
        compared = (part for check in recording.checks.values() for part in (*check.parts, check.limit))
        known = set(bottom_up([*columns, *compared, *recording.guards], ()))
        judged = {check.name: check for check in _shown(self.namespace, Check)}
        for name, own in recording.checks.items():
            of_rows = any(any(rests) for rests in self.on_rows([*own.parts, own.limit]))
            if not of_rows and (name not in judged or _compares_alike(own, judged[name])):
                continue
            whole = self.everywhere().recording.checks.get(name, own)
            nodes = [*whole.parts, whole.limit]
            more = list(bottom_up(nodes, known))
            takes = sum(node.size for node in more if node.size > 1)
            if takes > left or any(node.op == "exported" for node in more):
                recording.checks[name] = replace(own, where=own.where or "at the listed positions")
            else:
                recording.checks[name], left = whole, left - takes
                known.update(more)
                self.guard_as(self.everywhere(), nodes)

    def on_rows(self, nodes: Sequence[Node]) -> list[tuple[bool, bool]]:
        """Whether each rests on the positions that tables list, and on a sum or an extreme over them."""
        count = (self.graph.positions - 1) // self.graph.thin + 1
        for part in bottom_up(nodes, self.of_rows):
            under = [self.of_rows[operand] for operand in part.operands]
            rests = (part.op == "rows" and part.size == count) or any(own for own, _ in under)
            reduced = part.op == "reduce" and rests and part.size < count
            self.of_rows[part] = rests, reduced or any(over for _, over in under)
        return [self.of_rows[node] for node in nodes]

    def over_listed(self, name: str) -> bool:
        """Whether a line is a sum or an extreme over the positions that tables list, which that over all may equal."""
        value = self.names.get(name)
        if name not in self.lines or not isinstance(value, Quantity):
            return False
        return any(over for _, over in self.on_rows(list(value.parts)))

    def says_otherwise(self, namespace: Mapping[str, Any]) -> bool:
        """Whether words or marks rest on a sum or an extreme over the positions that tables list, or are not its own.

        These are the worksheet's, where all positions make them.
        """
        if self.graph.thin == 1:
            return False
        recording, own = self.recording, dict(_words(namespace))
        now: dict[str, tuple[str | float, list[Node]]] = {}
        for key, text in recording.said.items():
            now[key] = text.now, [*text.nodes]
        for (number, n), (texts, at) in recording.labels.items():
            if not isinstance(texts, str):
                now[f"table {number} {n}"] = "\n".join(str(texts[int(k)]) for k in at.value.flat), [at.re]
        for number, marks in recording.marks.items():
            now |= {f"figure {number} at {label}": (float(node.value), [node]) for label, node in marks.items()}
        if any(over for _, over in self.on_rows([node for _, nodes in now.values() for node in nodes])):
            return True
        return not all(_alike(said, own.get(key)) for key, (said, _) in now.items())

    def of_listed(self, name: str) -> bool:
        """Whether a number is a greatest or least one over the positions that tables list, and differs only by that.

        Such a number without a unit of its own is the scale of a check over the same positions.
        """
        value = self.names[name]
        if self.graph.thin == 1 or name in self.lines or not isinstance(value, Quantity) or not value.single:
            return False
        under = list(bottom_up([value.re], ()))
        kinds = {n.args[2] for n in under if n.op == "reduce" and n.args[0].size > 1}
        return kinds <= {"max", "min"} and any(n.op == "rows" for n in under)


def _words(namespace: Mapping[str, Any]) -> Iterator[tuple[str, str | float]]:
    """The words and marks that inputs may change in what a worksheet shows, by what a recording calls them."""
    for table in _shown(namespace, Table):
        yield from ((f"table {table.number} title", table.title), (f"table {table.number} note", table.note))
        for n, column in enumerate(table.columns):
            if column.values.dtype.kind in "OU":
                yield f"table {table.number} {n}", "\n".join(map(str, column.values))
    for figure in _shown(namespace, Figure):
        yield f"figure {figure.number} title", figure.title
        for label, at in figure.marks:
            yield f"figure {figure.number} at {label}", at * units.parse(figure.x.unit).factor
    yield from ((f"check {check.name} name", check.name) for check in _shown(namespace, Check))


def _alike(said: str | float, own: str | float | None) -> bool:
    """Whether a text is the same, and a mark at the same place but for rounding."""
    if isinstance(said, str) or not isinstance(own, float):
        return said == own
    return bool(np.isclose(said, own, rtol=1e-7, atol=0.0, equal_nan=True))


def _compares_alike(recorded: Residual, own: Check) -> bool:
    """Whether a check compares what the worksheet's own does, but for rounding."""
    end, factor = min if recorded.at_least else max, units.parse(recorded.unit).factor
    values = [x for part in recorded.parts for x in part.value.flat]
    off = np.array([end(values, default=0.0), recorded.limit.value]) - np.array([own.residual, own.limit]) * factor
    return (
        not own.evaluated
        or own.agreement
        or bool((abs(off) <= 1e-7 * max(abs(own.residual), abs(own.limit)) * factor).all())
    )


def _listed(graph: Graph, value: Any) -> Any:
    """What was recorded over all positions, at those that tables list."""
    if isinstance(value, list | tuple) and len(value) == graph.positions:
        return value[:: graph.thin]
    extent = value.extent if isinstance(value, Quantity) else value.at.extent if isinstance(value, Texts) else ()
    key = tuple(slice(None, None, graph.thin if size == graph.positions else None) for size in extent)
    return value[key] if key else value
