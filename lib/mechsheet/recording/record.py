"""A worksheet recorded: its statements run one by one with quantities that remember what is done with them."""

import ast
import builtins
from collections.abc import Iterable, Mapping
from dataclasses import fields, is_dataclass, replace
from itertools import chain
from pathlib import Path
from types import FunctionType
from typing import Any

import numpy as np

from mechsheet import units
from mechsheet.recording import statement
from mechsheet.recording.graph import Gap, Graph, Guard, Node, NotRecorded, bottom_up
from mechsheet.recording.lines import Recording
from mechsheet.recording.quantity import Quantity, is_literal
from mechsheet.recording.quantity import choice as where
from mechsheet.recording.stage import Stage, held
from mechsheet.recording.substitutes import any_quantity, current, instead, shared
from mechsheet.units import Constant
from mechsheet.worksheet import inputs
from mechsheet.worksheet.cells import Worksheet, load
from mechsheet.worksheet.check import Check
from mechsheet.worksheet.find import Found
from mechsheet.worksheet.lines import registry
from mechsheet.worksheet.table import Figure, Table
from mechsheet.worksheet.title import Slider


def record(namespace: Mapping[str, Any], sheet: Worksheet | None = None, whole: bool = False) -> Recording:
    """Run the cells behind the tables, found values and checks of ``namespace`` with recorded quantities.

    ``sheet`` has the cells where they are not those of the file; with ``whole`` all of them are run. What a recording
    does not hold keeps the numbers of the worksheet's own run, as nodes ``exported`` that know what they rest on;
    `Recording.gaps` says where and why. Where all tables list every so many positions, only those are recorded.
    """
    sheet = load(Path(namespace["__file__"])) if sheet is None else sheet
    listed = {value.every for value in namespace.values() if isinstance(value, Table)}
    graph = Graph(listed.pop() if len(listed) == 1 else 1)
    token = current.set(graph)
    try:
        return _Run(sheet, graph, namespace, whole).recording
    finally:
        current.reset(token)


class _Run:
    """One run of a worksheet's cells, statement by statement."""

    def __init__(self, sheet: Worksheet, graph: Graph, namespace: Mapping[str, Any], whole: bool) -> None:
        self.graph, self.namespace = graph, namespace
        g: Any = object.__new__(sheet.inputs)
        known = {}
        for declared in inputs.declared(sheet.inputs):
            value = getattr(namespace["g"], declared.name)
            known[declared.name] = graph.leaf("input", declared.name, value)
            object.__setattr__(g, declared.name, Quantity(graph, known[declared.name]))
        self.recording = Recording(graph, known, every=graph.thin)
        self.recording.sections = list(dict.fromkeys(cell.section for cell in sheet.cells))
        self.names: dict[str, Any] = {**shared(sheet.common), "__builtins__": builtins, "g": g}
        self.looked: dict[str, tuple[Guard, ...]] = {}  # by name: the guards that its value rests on
        self.chosen: dict[Node, frozenset[Node]] = {}
        self.lost: dict[str, str] = {}  # names that have no value here, and why
        want = sheet.results if whole else [name for name in sheet.results if _shown(namespace.get(name))]
        self.lines = lines = registry(namespace)
        for line in sheet.setup:
            self.set_up(line, sheet.path)
        for cell in sheet.needed(want, {"g": g}):
            stage = Stage(self.recording, namespace, cell)
            self.names |= stage.replacements()
            facts = [statement.facts(line, sheet.path) for line in cell.lines]
            last = {name: n for n, fact in enumerate(facts) for name in fact.touched}
            for n, (line, fact) in enumerate(zip(cell.lines, facts, strict=True)):
                if not statement.on_the_page(line):
                    final = {name for name in fact.touched if last[name] == n and not name.startswith("_")}
                    self.step(stage, line.lineno, fact, final)
            for name in dict.fromkeys([*(n for n in cell.code.co_names if n in lines), *cell.gives]):
                self.recording.define(cell.section, name, self.names.get(name), lines)
            for solved in stage.solved:
                self.recording.define_steps(cell.section, solved)
        self.recording.values = self.names

    def step(self, stage: Stage, line: int, facts: statement.Statement, final: set[str]) -> None:
        """Run one statement; where it cannot be recorded, its names keep the numbers of the worksheet's own run.

        Those are known of the ``final`` names, which no later statement binds again.
        """
        graph = self.graph
        graph.line, graph.looked, graph.work = line, {}, 0
        touched, reads = facts.touched, self.read(facts.loaded)
        texts = {name for name in reads if isinstance(self.names.get(name), str)}
        rests, shown = (
            {guard.holds: guard for name in names for guard in self.looked.get(name, ())}
            for names in (reads, reads - texts)
        )
        try:
            with np.errstate(all="ignore"):  # the worksheet's own run has warned
                exec(facts.code, self.names)
            self.measure(touched, reads)
            differs = [name for name in final if not stage.same(self.names.get(name), self.namespace.get(name))]
            if not all(name not in self.lines and self.of_listed(self.names[name]) for name in differs):
                of_all = " is of all positions, and only those that tables list are recorded"
                differ = of_all if graph.thin > 1 else " would differ from the worksheet"
                raise NotRecorded(", ".join(differs) + differ)
        except Exception as error:
            self.keep(stage, facts, final, self.why(error, reads), reads)
            return
        self.recording.guards |= {holds: guard for holds, guard in graph.looked.items() if guard.rows or not touched}
        met = {holds: guard for holds, guard in graph.looked.items() if not guard.rows}
        rests, shown = rests | met, shown | met

        def under_these(x: Quantity) -> Quantity:
            return x if x.re.op == "constant" else self.while_same(x, rests.values())

        for name in touched:
            if isinstance(self.names.get(name), Slider):  # it rests where the worksheet has it
                self.names[name] = self.namespace.get(name, self.names[name])
            self.looked[name] = tuple(rests.values())
            if rests and name in self.names and not isinstance(self.names[name], FunctionType):
                self.names[name] = _mapped(self.names[name], under_these)
        stage.finish(lambda x: self.while_same(x, shown.values()))

    def measure(self, touched: Iterable[str], reads: frozenset[str]) -> None:
        """Let unit constants that a statement binds be quantities, and numbers that a line declares in a unit.

        The unit of what Python made a number of, out of what it reads, is not known.
        """
        made = any(any_quantity(self.names.get(name)) for name in reads)
        for name in touched:
            value, line = self.names.get(name), self.lines.get(name)
            if isinstance(value, Constant) or value is units:
                self.names[name] = instead(value)
                continue
            unit = line.unit if line and not line.arguments else "-"
            number = value.re.value if isinstance(value, Quantity) and is_literal(value) else value
            if any(units.parse(unit).dims) and (type(number) in (int, float) or _is_array(number)):
                self.names[name] = Quantity(self.graph, self.graph.constant(number, unit))
            elif made and (type(value) is float or _is_array(value)):
                self.names[name] = Quantity(self.graph, self.graph.constant(value, units.UNKNOWN))

    def set_up(self, line: ast.stmt, path: str) -> None:
        """Run a statement of the setup again where it computes with units; else its numbers stay."""
        facts = statement.facts(line, path)
        if any(any_quantity(self.names.get(name)) for name in self.read(facts.loaded)) or "units" in facts.loaded:
            try:
                exec(facts.code, self.names)
            except Exception:  # what does not take quantities keeps the numbers that it has, of no known dimension
                return
            self.measure(facts.touched, frozenset())

    def keep(
        self, stage: Stage, facts: statement.Statement, final: set[str], reason: str, reads: frozenset[str]
    ) -> None:
        """The numbers of the worksheet's own run in place of a recording."""
        touched, graph = facts.touched, self.graph
        graph.work = 0
        rests_on = self.leaves(facts, reads)
        stage.forget()
        own = [self.namespace.get(name) for name in touched]
        if not rests_on and graph.thin == 1 and final.issuperset(touched) and all(map(_is_number, own)):
            for name, number in zip(touched, own, strict=True):  # the same for all inputs
                self.names[name] = Quantity(graph, graph.constant(number, units.UNKNOWN))
            return
        guards = tuple(Guard(graph.same(leaf), graph.line) for leaf in rests_on)
        if not touched or any(held(self.namespace.get(name)) for name in final) or not final.issuperset(touched):
            public = tuple(name for name in touched if not name.startswith("_"))
            self.recording.gaps.append(Gap(public, graph.line, reason))
            self.recording.guards |= {guard.holds: guard for guard in guards}
        for name in touched:
            self.looked[name] = guards
            if name in final and name in self.namespace:
                self.names[name] = stage.kept(self.namespace[name], rests_on)
                if isinstance(self.names[name], Quantity):
                    self.looked[name] = ()
            else:
                self.names.pop(name, None)
                self.lost[name] = reason

    def why(self, error: Exception, reads: frozenset[str]) -> str:
        """Why a statement cannot be recorded."""
        known = [self.lost[name] for name in reads if name in self.lost]
        if known and isinstance(error, NameError):
            return known[0]
        if isinstance(error, NotRecorded):
            return str(error)
        return f"it does not run with recorded quantities ({str(error).splitlines()[0] if str(error) else error!r})"

    def of_listed(self, value: Any) -> bool:
        """Whether a number is a greatest or least one over the positions that tables list, and differs only by that.

        Such a number without a unit of its own is the scale of a check over the same positions.
        """
        if self.graph.thin == 1 or not isinstance(value, Quantity) or value.size > 1:
            return False
        under = list(bottom_up([value.re], ()))
        kinds = {n.args[2] for n in under if n.op == "reduce" and n.args[0].size > 1}
        return kinds <= {"max", "min"} and any(n.op == "rows" for n in under)

    def conditions(self, node: Node) -> frozenset[Node]:
        """Conditions under which a quantity has a value, as it is chosen already."""
        known = self.chosen
        for part in bottom_up([node], known):
            found = frozenset(chain.from_iterable(known[operand] for operand in part.operands))
            if part.op == "where" and part.args[2].op == "constant" and np.isnan(part.args[2].value).all():
                found |= {part.args[0]}
            ends = part.op == "finite" or (part.op == "reduce" and part.args[2].startswith("nan"))
            known[part] = frozenset() if ends else found
        return known[node]

    def while_same(self, x: Quantity, rests: Iterable[Guard]) -> Quantity:
        """A quantity while Python sees the same, else no number."""
        for guard in rests:
            if guard.holds not in self.conditions(x.re):
                self.recording.guards[guard.holds] = guard
                x = where(self.graph, Quantity(self.graph, guard.holds), x, np.nan)
        return x

    def read(self, loaded: Iterable[str]) -> frozenset[str]:
        """Names that a statement reads, and those that the functions of the worksheet read which it names."""
        found, waiting = set[str](), set(loaded)
        while waiting:
            name = waiting.pop()
            if name in found:
                continue
            found.add(name)
            value = self.names.get(name)
            if isinstance(value, FunctionType) and value.__globals__ is self.names:
                waiting |= set(statement.names_of(value.__code__))
        return frozenset(found)

    def leaves(self, facts: statement.Statement, reads: frozenset[str]) -> list[Node]:
        """Inputs under what a statement reads, and under what Python saw for it."""
        roots = [guard.holds for name in sorted(reads) for guard in self.looked.get(name, ())]

        def noted(x: Quantity) -> Quantity:
            roots.extend(x.parts)
            return x

        for name in sorted(reads - {"g"}):
            _mapped(self.names.get(name), noted)
        codes = [f.__code__ for f in map(self.names.get, reads) if isinstance(f, FunctionType)]
        if "g" in reads:
            parts = facts.parts | {name for code in codes for name in statement.names_of(code)}
            used = [name for name in self.recording.inputs if name in parts]
            roots += [self.recording.inputs[name] for name in (self.recording.inputs if facts.whole else used)]
        return leaves_of(roots, self.recording)


def leaves_of(roots: Iterable[Node], recording: Recording) -> list[Node]:
    """Inputs that quantities rest on; of found values those of their equations."""
    solved = {s.node: s for s in recording.found.values()}
    found: dict[Node, None] = {}
    waiting, visited = list(roots), set[Node]()
    while waiting:
        node = waiting.pop()
        if node in visited:
            continue
        visited.add(node)
        if node.op == "input":
            found[node] = None
        if node in solved:
            waiting.extend(n for n in (solved[node].residual, *(solved[node].interval or ())) if n)
        waiting.extend(node.operands)
    order = {node: n for n, node in enumerate(recording.inputs.values())}
    return sorted(found, key=order.__getitem__)


def _mapped(value: Any, f: Any) -> Any:
    """A value with a function of every quantity in it in the place of that."""
    if isinstance(value, Quantity):
        return f(value)
    if isinstance(value, tuple) and hasattr(value, "_fields"):
        return type(value)(*(_mapped(v, f) for v in value))
    if isinstance(value, list | tuple):
        return type(value)(_mapped(v, f) for v in value)
    if isinstance(value, dict):
        return {name: _mapped(v, f) for name, v in value.items()}
    if is_dataclass(value) and not isinstance(value, type):
        new = {x.name: _mapped(getattr(value, x.name), f) for x in fields(value) if x.init}
        if any(new[name] is not getattr(value, name) for name in new):
            return replace(value, **new)
    return value


def _is_array(value: Any) -> bool:
    return isinstance(value, np.ndarray) and value.dtype.kind in "iuf"


def _is_number(value: Any) -> bool:
    return isinstance(value, float | np.floating) or _is_array(value)


def _shown(value: Any) -> bool:
    group = value if isinstance(value, tuple | list) else [value]
    return any(isinstance(v, Table | Figure | Check | Found) for v in group)
