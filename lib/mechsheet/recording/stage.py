"""One cell of a worksheet while it is recorded: what `table`, `find`, `check` and their like do there."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from copy import copy
from dataclasses import replace
from functools import partial
from itertools import chain, count, repeat
from typing import Any, TypeVar

import numpy as np

from mechsheet import units
from mechsheet.quantities.arithmetic import choice as where
from mechsheet.quantities.graph import Guard, NotRecorded
from mechsheet.quantities.lines import Recording, Residual, Solved
from mechsheet.quantities.node import Node
from mechsheet.quantities.numpy_rules import arange
from mechsheet.quantities.quantity import Quantity, lift
from mechsheet.quantities.text_column import Texts
from mechsheet.quantities.text_column import shown as as_column
from mechsheet.quantities.written import Written, seen
from mechsheet.readers.terms import made_of
from mechsheet.recording import showing, solving
from mechsheet.recording.each_row import EachRow
from mechsheet.recording.own_values import named_parts
from mechsheet.recording.rows_checked import exists
from mechsheet.recording.substitutes import body, instead
from mechsheet.worksheet import find, system
from mechsheet.worksheet.cells import Cell
from mechsheet.worksheet.check import AGREED, Check, closed
from mechsheet.worksheet.find import Found
from mechsheet.worksheet.system import Solution
from mechsheet.worksheet.table import Figure, Table, listed
from mechsheet.worksheet.verdict import Verdict

V = TypeVar("V", bound=Verdict)


class Stage:
    """One cell while it is recorded: what it shows is noted, and compared with what the worksheet has."""

    def __init__(
        self, recording: Recording, namespace: Mapping[str, Any], cell: Cell,
        while_same: Callable[[Quantity, Iterable[Guard]], Quantity],
    ) -> None:  # fmt: skip
        """``while_same`` gives a quantity that is none where Python would see something else."""
        self.while_same = while_same
        self.graph, self.recording, self.namespace, self.cell = recording.graph, recording, namespace, cell
        self.solved: list[Solved] = []
        self.shown_now: list[tuple[dict[str, Any], str]] = []  # by the statement that is run
        self.solved_now: list[Solved] = []  # by it, or given their closed form
        self.shown: list[tuple[dict[str, Any], str]] = []  # by the statements before it
        self.guards: dict[Node, Guard] = {}  # by their conditions: of statements that bind nothing
        given = [namespace.get(name) for name in cell.gives]
        self.real = [v for group in given for v in (group if isinstance(group, tuple | list) else [group])]

    @property
    def shows(self) -> dict[str, Callable[..., Any]]:
        """What the functions that show do in this cell, by their names."""
        return {
            "table": self.table,
            "figure": self.figure,
            "sought": self.sought,
            "solve": self.solve,
            "rooted": partial(self._solved, None),  # by another package: there is no verdict
            "integrated": self.recording.integrals.__setitem__,
            "closed_form": self.closed_form,
            "judged": self.judged,
            "check_slope": self.check_slope,
            "Check": self.stated,
            "meanings": self.meanings,
        }

    def table(
        self, number: str, title: Any, *columns: Any, note: Any = "", every: Any = 1, decimals: Any = None, **_: Any
    ) -> None:
        self._argue(f"table {number} decimals", decimals)
        self._word(f"table {number}", title)
        self._word(f"table {number}", note, "note")
        self._show(number, columns, every if self.graph.thin == 1 else seen(every) and 1)

    def _argue(self, name: str, value: Any) -> None:
        """Note an argument that a page follows; for any other writer it is what it is now."""
        if self.graph.draws and isinstance(value, Quantity):
            self.shown_now.append((self.recording.arguments, name))
            self.recording.arguments[name] = value.re
        else:
            seen(value)

    def _word(self, of: str, text: Any, what: str = "title") -> None:
        """Note words that do not stand in the cell."""
        if not showing.stands(self.cell, text):
            self.shown_now.append((self.recording.worded, f"{of} {what}"))
            self.recording.worded[f"{of} {what}"] = self.graph.constant(1.0)
        if isinstance(text, Written):
            self.shown_now.append((self.recording.said, f"{of} {what}"))
            self.recording.said[f"{of} {what}"] = text

    def _show(self, number: str, columns: tuple[Any, ...], every: Any) -> None:
        """Note the columns of a table or a figure; where rows are of a fixed number, Python sees which it lists."""
        self.shown_now.append((self.recording.tables, number))
        whole = (c.parts if isinstance(c, EachRow) and c.pairs and c.every else c for c in columns)
        each = [
            self._column(of_all if isinstance(of_all, Texts) else column)
            for of_all, column in zip(whole, columns, strict=True)
        ]
        columns, rests = tuple(column for column, _ in each), [seen for _, seen in each]
        follows = self.graph.draws and isinstance(every, Quantity) and max(map(np.ndim, columns), default=0) == 1
        labels = {n: column for n, column in enumerate(columns) if isinstance(column, Texts)}
        given = [*(c.same if isinstance(c, Texts) else c for c in columns), *(label.at for label in labels.values())]
        rows = [lift(self.graph, column) for column in body(listed)(given, 1 if follows else int(seen(every)))]
        if follows:
            at = arange(self.graph, 0, rows[0].count(0), every)
            rows = [column[at] for column in rows]
        for (n, label), at in zip(labels.items(), rows[len(columns) :], strict=True):
            self.recording.labels[number, n] = label.name or label.texts, self.while_same(at, rests[n])
        shown = (
            self.while_same(copy(row), seen) for row, seen in zip(rows, rests, strict=False)
        )  # later lines may set
        self.recording.tables[number] = tuple(shown)

    def _column(self, column: Any) -> tuple[Any, list[Guard]]:
        """A column as a table shows it, and what Python sees for it: the others do not rest on that."""
        looked, self.graph.looked = self.graph.looked, {}
        try:
            return as_column(self.graph, column), [*self.graph.looked.values()]
        finally:
            self.graph.looked = looked

    def figure(
        self,
        number: str,
        title: str,
        *columns: Any,
        marks: Mapping[str, Any] | None = None,
        every: Any = 1,
        **_: Any,
    ) -> None:
        self._argue(f"figure {number} every", every)
        self._word(f"figure {number}", title)
        self._show(f"Fig {number}", columns, 1)
        self.shown_now.append((self.recording.marks, number))
        self.recording.marks[number] = {k: lift(self.graph, v).re for k, v in (marks or {}).items()}

    def sought(
        self, f: Any, words: Any, lo: Any, hi: Any, equals: Any, guess: Any, branch: Any, branches: Any
    ) -> solving.Solving:
        found = self._own(Found, lambda own: own.words.unknown == words.unknown)
        if found is None:
            low, high, wanted, start = map(solving.now, (lo, hi, equals, guess))
            with solving.tried(self.graph) as of:
                found = find.sought(of(f), words, low, high, wanted, start, branch, branches)
        given = {"lo": lo, "hi": hi, "guess": guess}
        return self._solved(found, solving.one(self.graph, found, f, given, equals, branch, branches))

    def solve(
        self, f: Any, equals: Any, unit: Any, unknown_unit: Any, unknowns: Mapping[str, Any], least: bool = False
    ) -> solving.Solving:
        found = self._own(Solution, lambda own: list(own.words.names) == list(unknowns) and own.least is least)
        if found is None:
            wanted, starts = solving.now(equals), {name: solving.now(x) for name, x in unknowns.items()}
            with solving.tried(self.graph) as of:
                found = system.solve(of(f), wanted, unit, unknown_unit, starts, least)
        return self._solved(found, solving.several(self.graph, found, f, equals, unknowns))

    def _own(self, kind: type[V], meant: Callable[[V], bool]) -> V | None:
        """The verdict of the worksheet's own run, where a name holds it; the next one that is meant is another."""
        for n, value in enumerate(self.real):
            if isinstance(value, kind) and meant(value):
                del self.real[n]
                return value
        return None

    def _solved(self, own: Verdict | None, new: solving.Solving) -> solving.Solving:
        self.solved += new.solved
        self._note(new, own)
        return new

    def _note(self, new: solving.Solving, own: Verdict | None) -> None:
        """Note found values by what the worksheet calls them."""
        known = self.recording.found
        name = next((f"{name}." for name, value in self.namespace.items() if own is not None and value is own), "")
        for solved in new.solved:
            unknown = solved.words.unknown
            keys = chain([f"{name}{unknown}"], (f"{unknown} {n}" for n in count(2)))  # of a loop, or called again
            key = next(key for key in keys if key not in known or known[key].node is solved.node)
            self.shown_now.append((known, key))
            known[key] = solved
            self.solved_now.append(solved)

    def closed_form(self, found: solving.Solving, value: Any = None, tolerance: float = 1e-10, **values: Any) -> Any:
        for solved in found.solved:
            name = solved.words.unknown
            if not values or name in values:
                own = getattr(found.value, name) if values else found.value
                self._closed(solved, own, lift(self.graph, values.get(name, value)), tolerance)
        return () if values else None

    def _closed(self, solved: Solved, found: Any, value: Quantity, tolerance: float) -> None:
        inside: Any = value
        if solved.interval and solved.interval[0] is not solved.interval[1]:
            low, high = (Quantity(self.graph, end) for end in solved.interval)
            slack = 1e-12  # an end of the interval may be a found value, rounded
            within = (value >= low * (1 - slack)) & (value <= high * (1 + slack))
            inside = np.where(within, value, np.nan)
        solved.inverse = inside.re
        self.solved_now.append(solved)
        words = solved.words
        instead(closed)(words.unknown, words.unknown_unit, found, value, tolerance)
        solved.compared = self.shown_now[-1][1]

    def judged(
        self,
        name: str | Written,
        residual: Any,
        limit: Any,
        unit: str,
        size: Any = np.inf,
        tells: Any = True,
        at_least: bool = False,
    ) -> None:
        parts = [lift(self.graph, r) for r in (residual if isinstance(residual, list) else [residual])]
        bound = limit if tells is True else np.where(lift(self.graph, tells), limit, np.nan)
        self._check(name, [(p if at_least else abs(p)).re for p in parts], bound, unit, at_least=at_least)

    def stated(
        self,
        name: str | Written,
        residual: Any,
        limit: Any,
        unit: str = "-",
        reason: str = "",
        essential: Any = False,
        agreement: Any = False,
        at_least: Any = False,
    ) -> None:
        for each in (essential, agreement, at_least):
            seen(each)
        self._check(name, [lift(self.graph, residual).re], limit, "-", signed=True, at_least=bool(at_least))

    def check_slope(
        self, name: str | Written, slope: Any, f: Callable[..., Any], x: Any, lo: Any, hi: Any, unit: str = "-"
    ) -> None:
        """The slope by central differences, at some of the positions; two steps tell how good they are.

        At the middle one alone where the function takes no arrays.
        """
        graph, slope, x = self.graph, lift(self.graph, slope), lift(self.graph, x)
        count, step, size = x.count(0), 0.002 * (hi - lo), abs(slope).max()
        middle, some = count // 2, lift(graph, np.arange(1, 4)) * (count - 1) // 4
        seen_before = dict(graph.looked), dict(graph.numbered)
        try:
            if x.extent[0] < 5:
                raise NotRecorded("few positions")
            fine, coarse = _differences(f, x[some], step)
            own, place = slope[some] if slope.ndim else slope, "at three of the positions"
        except (Exception, NotRecorded):  # of whatever cannot take an array
            graph.looked, graph.numbered = seen_before
            fine, coarse = _differences(f, x[middle], step)
            own, place = slope[middle] if slope.ndim else slope, "at the middle position"
        limit = np.maximum(1e-7 * size, 10 * abs(fine - coarse).max())
        self.judged(name, own - fine, limit, unit, size, limit <= AGREED * size)
        name = name.now if isinstance(name, Written) else name
        self.recording.checks[name] = replace(self.recording.checks[name], where=place)

    def meanings(self) -> dict[str, str]:
        """No words: of diagrams only the drawings are recorded, where they are at all."""
        if not self.graph.draws:
            raise NotRecorded("diagrams are drawn")
        return {}

    def _check(
        self,
        name: str | Written,
        parts: list[Node],
        limit: Any,
        unit: str | Written,
        signed: bool = False,
        at_least: bool = False,
    ) -> None:
        bound = lift(self.graph, limit)
        if not bound.single:
            raise NotRecorded(f"check {name!r} has several limits")
        if (of_row := exists.get()) is not None:
            parts = [where(self.graph, of_row, Quantity(self.graph, part), np.nan).re for part in parts]
        said, name = (name, name.now) if isinstance(name, Written) else (None, name)
        self.shown_now.append((self.recording.checks, name))
        shown = unit.now if isinstance(unit, Written) else unit  # a number is right beside the unit that it was given
        self.recording.checks[name] = Residual(parts, bound.re, shown, signed, at_least=at_least)
        if said is not None:
            self._word(f"check {name}", said, "name")

    def forget(self) -> None:
        """Take back what the present statement has shown."""
        for place, key in self.shown_now:
            place.pop(key, None)
        for solved in self.solved_now:
            solved.inverse = None
        self.shown_now.clear()
        self.solved_now.clear()

    def finish(
        self, f: Callable[[Quantity], Quantity], of_columns: Sequence[Callable[[Quantity], Quantity]] = ()
    ) -> None:
        """End the present statement, with a function of every quantity that it has shown, of columns one for each."""

        def of(node: Node) -> Node:
            return f(Quantity(self.graph, node)).re

        recording = self.recording
        for place, key in self.shown_now:
            if place is recording.tables:
                each = of_columns if len(of_columns) == len(recording.tables[key]) else repeat(f)
                columns = [None if c is None else own(c) for c, own in zip(recording.tables[key], each, strict=False)]
                constant = {n for n, c in enumerate(columns) if c is not None and c.re.op == "constant"}
                recording.constants |= {(key, n) for n in constant}
                recording.tables[key] = tuple(None if n in constant else c for n, c in enumerate(columns))
            elif place is recording.checks:
                check = recording.checks[key]
                limit = check.limit if check.limit.op == "constant" else of(check.limit)
                recording.checks[key] = replace(check, parts=[of(p) for p in check.parts], limit=limit)
            elif place is recording.worded or place is recording.arguments:
                place[key] = of(place[key])
            elif place is recording.marks:
                recording.marks[key] = {name: of(node) for name, node in recording.marks[key].items()}
        for solved in self.solved_now:
            solved.residual, solved.inverse, solved.target = (
                node and of(node) for node in (solved.residual, solved.inverse, solved.target)
            )
            solved.interval = solved.interval and (of(solved.interval[0]), of(solved.interval[1]))
        self.shown += self.shown_now
        self.shown_now.clear()
        self.solved_now.clear()

    def end(self, f: Callable[[Quantity], Quantity]) -> None:
        """End the cell, with a function of every quantity that it has shown."""
        self.shown_now = [(place, key) for place, key in self.shown if key in place]
        self.solved_now = [*self.solved]
        self.finish(f)

    def built(self, names: Iterable[str]) -> bool:
        """Whether one of some names is a table or a figure that no call of `table` or `figure` has made."""
        own = (self.namespace.get(name) for name in names)
        each = (x for group in own for x in (group if isinstance(group, tuple | list) else [group]))
        numbers = (
            x.number if isinstance(x, Table) else f"Fig {x.number}" for x in each if isinstance(x, Table | Figure)
        )
        return any(number not in self.recording.tables for number in numbers)

    def same(self, value: Any, own: Any, shown: bool = False) -> bool:
        """Whether a recorded value has the worksheet's texts, or numbers but for rounding; lists where ``shown``."""
        if isinstance(value, Texts) and isinstance(own, np.ndarray | list):
            return bool(value.now == solving.listed(self.graph, own).tolist())
        numbers = int | float | complex | np.ndarray | np.generic
        if shown and self.graph.thin > 1 and isinstance(value, list | tuple) and isinstance(own, list | tuple):
            flat = value and own and all(isinstance(x, numbers) and not np.ndim(x) for x in own)
            value, own = (np.stack(value), np.asarray(own)) if flat else (value, own)
        if not isinstance(own, numbers):
            return True
        kept = np.asarray(own)
        kept = kept + 0 if kept.dtype.kind in "biufc" else kept
        if kept.dtype.kind not in "iufc":
            return True
        if not isinstance(value, Quantity) and np.asarray(value).dtype.kind not in "biufc":
            return False  # as what a function has made that knows no quantity
        value = lift(self.graph, value)
        if kept.shape != value.extent:
            kept = solving.listed(self.graph, kept)
        if np.array_equal(value.value, kept):
            return True
        try:
            a, b = np.broadcast_arrays(value.value + 0, kept)
        except ValueError:
            return False
        if a.shape != kept.shape:
            return False
        size = np.max(np.abs(b), initial=0.0, where=np.isfinite(b))
        with np.errstate(invalid="ignore"):  # of two infinite numbers
            off = np.abs(a - b)[np.isfinite(a) | np.isfinite(b)]
        if (off <= 1e-7 * size).all():
            return True
        terms = max(made_of(part, self.recording.made_of) for part in value.nodes)
        return bool((off <= 1e-7 * max(size, 1e-6 * terms)).all())

    def kept(self, own: Any, rests_on: Sequence[Node]) -> Any:
        """The worksheet's own value instead of a recorded one; what it shows of it too."""
        graph, recording = self.graph, self.recording

        def exported(values: Any) -> Quantity:
            array = solving.listed(graph, values)
            parts = [array.real, array.imag] if array.dtype.kind == "c" else [array]
            return Quantity(graph, *(graph.exported(rests_on, part) for part in parts))

        match own:
            case bool() | int() | float() | complex() | np.generic() | np.ndarray():
                return exported(own) if np.asarray(own).dtype.kind in "biufc" else own
            case Table(number=number, columns=columns):
                for part in ("title", "note"):
                    if not showing.stands(self.cell, getattr(own, part)):
                        recording.worded[f"table {number} {part}"] = graph.exported(rests_on, 1.0)
                self.shown.append((recording.tables, number))
                recording.tables[number] = tuple(
                    Quantity(graph, graph.exported(rests_on, c.values * units.parse(c.unit).factor)) if c.unit else None
                    for c in columns
                )
            case Check():
                self.shown.append((recording.checks, own.name))
                numbers = [graph.exported(rests_on, x) for x in (own.residual, own.limit)]
                recording.checks[own.name] = Residual(numbers[:1], numbers[1], "-", True, at_least=own.at_least)
            case Verdict():
                found = solving.kept(graph, own, exported)
                self._note(found, own)
                return found
            case tuple() if hasattr(own, "_fields"):
                return type(own)(*(self.kept(v, rests_on) for v in own))
            case tuple() | list():
                return type(own)(self.kept(v, rests_on) for v in own)
            case dict():
                known = copy(own)  # which may have its keys as attributes
                known.update((key, self.kept(v, rests_on)) for key, v in own.items())
                return known
        new = copy(own) if (names := named_parts(own)) else own  # without its checks, which look at numbers
        for name in names:
            object.__setattr__(new, name, self.kept(getattr(own, name), rests_on))
        return new


def _differences(f: Callable[..., Any], at: Quantity, step: Any) -> tuple[Any, Any]:
    """Central differences at some places, by a step and by twice that; a function of arrays is asked once."""
    moves = np.array([1, -1, 2, -2, 4, -4])
    each = [*f(np.add.outer(moves * step, at))] if at.ndim else [f(at + n * step) for n in moves.tolist()]
    if len(each) != len(moves) or np.shape(each[0]) != at.shape:
        raise NotRecorded("a function of one number")
    first, second, fourth = (up - down for up, down in zip(each[::2], each[1::2], strict=True))
    return (8 * first - second) / (12 * step), (8 * second - fourth) / (24 * step)
