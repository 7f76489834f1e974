"""One run of a worksheet's cells with quantities, statement by statement."""

import ast
from collections import ChainMap
from collections.abc import Iterable, Mapping, Sequence
from functools import partial
from itertools import chain
from types import CodeType
from typing import Any

import numpy as np

from mechsheet import units
from mechsheet.quantities.graph import Gap, Graph, Guard, NotRecorded
from mechsheet.quantities.lines import Recording, leaves_of
from mechsheet.quantities.node import Node
from mechsheet.quantities.of_lists import CHANGED
from mechsheet.quantities.quantity import Quantity, has_quantity, is_literal, lift
from mechsheet.quantities.selected import Selected
from mechsheet.quantities.sketch import Drawn, Sketch
from mechsheet.quantities.written import Said, Written
from mechsheet.recording import setting_up, showing, statement
from mechsheet.recording.by_size import decided
from mechsheet.recording.comprehended import of_cell
from mechsheet.recording.given import given
from mechsheet.recording.in_place import OTHER_NAME
from mechsheet.recording.leaving_out import LeavingOut
from mechsheet.recording.memory import Memory, changes, names_of, sets_of_others, shared_by
from mechsheet.recording.one_array import of_one_array, taken_apart
from mechsheet.recording.own_values import changed_as, is_array, resting_on
from mechsheet.recording.positions import OfPositions
from mechsheet.recording.shows import changes_held, under_others
from mechsheet.recording.sifted import in_one
from mechsheet.recording.stage import Stage
from mechsheet.recording.substitutes import Module, instead, shared, staged
from mechsheet.worksheet.cells import Cell, Worksheet
from mechsheet.worksheet.drawing import Drawing
from mechsheet.worksheet.lines import Formula, of_setup, rebound
from mechsheet.worksheet.no_inputs import beforehand, inputs_of
from mechsheet.worksheet.title import Mark, Slider

_DIFFERS = " would differ from the worksheet"
_PLACES = {"argmax", "argmin", "argsort"}
_MADE = "what it says is no text that is recorded"


class Run(LeavingOut, OfPositions):
    """One run of a worksheet's cells, statement by statement."""

    def __init__(
        self, sheet: Worksheet, graph: Graph, namespace: Mapping[str, Any], want: Sequence[str],
        lines: Mapping[str, Formula], unnamed: bool = False,
    ) -> None:  # fmt: skip
        """Of what ``want`` needs, and with what cells show under no name where ``unnamed`` asks for it."""
        g, known = given(graph, inputs_of(namespace))
        super().__init__(Recording(graph, known, every=graph.thin))
        self.sheet, self.namespace, self.asked = sheet, namespace, beforehand(g)
        self.recording.sections = list(dict.fromkeys(cell.section for cell in sheet.cells))
        sheet.begun.again()
        self.names: dict[str, Any] = shared(sheet.common)
        self.listed: dict[str, Any] = {}  # lists of lines, each as one quantity
        self.looked: dict[str, tuple[Guard, ...]] = {}  # by name: the guards that its value rests on
        self.chosen: dict[Node, frozenset[Node]] = {}
        self.lost: dict[str, NotRecorded] = {}  # names that have no value here, and why
        self.aliases: list[tuple[set[str], Memory, set[int], NotRecorded]] = []  # names kept, and what may change them
        self.passing: dict[str, Any] = {}  # of these, lines whose numbers are others at the next run
        self.want, self.lines, self.unnamed = want, lines, unnamed
        self.rebound: Sequence[Formula] = ()  # lines of the present cell whose names others bind anew
        self.constants = of_setup(sheet)  # its lines that end in a unit
        self.facts = partial(statement.facts, path=sheet.path, exact=graph.unmoved is not None)
        self.set_up()
        self.names = self.names | self.asked  # which functions of the setup do not read
        self.showing = showing.functions(sheet)
        more = showing.without_name(sheet, {"g", *namespace}, self.showing) if unnamed else []
        needs = chain.from_iterable(sorted(cell.needs) for cell in more)
        self.needed = [*sheet.needed([*want, *needs], self.asked)]
        self.needed += (cell for cell in more if cell not in self.needed)
        for cell in [*self.needed, *(showing.cells(sheet, self.needed) if graph.draws else ())]:
            self.run(cell)
        self.recording.values, self.recording.looked = ChainMap(self.listed, self.names), self.looked
        if graph.thin > 1:
            self.check_everywhere()

    def run(self, cell: Cell, draws: bool = True) -> None:
        """Run the statements of a cell, those that only draw where it ``draws``, and name what they give."""
        stage = Stage(self.recording, self.namespace, cell, self.while_same)
        lines, before = list[ast.stmt](), set[str]()
        for line in of_cell(cell, self.sheet):
            lines += self.parts(line, before)
            before.update(statement.touched(line))
        facts = [self.facts(line) for line in lines]
        last = {name: n for n, fact in enumerate(facts) for name in fact.touched}
        twice = len(last) < sum(len(fact.touched) for fact in facts)
        self.rebound = rebound(self.sheet, cell.lines) if twice else []
        self.of_cell, self.compared_later = frozenset(last), dict[str, None]()
        for n, (line, fact) in enumerate(zip(lines, facts, strict=True)):
            later = {name for name, end in last.items() if end > n}
            self.to_change = frozenset[str]().union(*(fact.in_place for fact in facts[n + 1 :]))
            if not draws and fact.touched and all(isinstance(self.namespace.get(x), Drawing) for x in fact.touched):
                continue
            if not self.apart(stage, line, later):
                self.step(stage, line.lineno, fact, later)
        if stale := self.differing(stage, [name for name in self.compared_later if name in self.names]):
            self.lose(stage, stale, set(), NotRecorded(", ".join(stale) + _DIFFERS))
        self.decide(stage, last)
        for name in dict.fromkeys([*(n for n in cell.code.co_names if n in self.lines), *cell.gives]):
            self.recording.define(cell.section, name, self.shown(name), self.lines)
        for solved in stage.solved:
            self.recording.define_steps(cell.section, solved)
        if self.graph.draws:
            self.show(stage, cell)

    def shown(self, name: str) -> Any:
        """What a name is; the list or the tuple of a line as the one quantity that it is shown as."""
        value = self.names.get(name, self.passing.get(name))
        self.listed.pop(name, None)
        if isinstance(value, Quantity) and value.dtype == bool:  # which is none only where it is shown
            return self.while_same(value, self.looked.get(name, ()))
        if name in self.lines and isinstance(value, list | tuple) and (one := in_one(self.graph, value)):
            self.listed[name] = value = self.while_same(one[0], (*self.looked.get(name, ()), *one[1]))
        return value

    def parts(self, line: ast.stmt, before: set[str]) -> tuple[ast.stmt, ...]:
        """What of a statement is run; names that are bound ``before`` it may be read by functions that it calls."""
        if statement.on_the_page(line):
            return showing.on_the_page(line, self.showing)
        apart = before.isdisjoint(statement.touched(line))
        return (apart and statement.names_apart(line)) or statement.texts_apart(line)

    def again(self) -> "Run":
        return Run(self.sheet, self.graph, self.namespace, self.want, self.lines, self.unnamed)

    def apart(self, stage: Stage, line: ast.stmt, later: set[str]) -> bool:
        """Run a statement part by part; whether it has such parts, and all of them can be recorded."""
        parts = [self.facts(part) for part in statement.apart(line)]
        gaps, own = len(self.recording.gaps), {name for part in parts[:-1] for name in part.touched}
        for part in parts:
            self.step(stage, line.lineno, part, later)
            if not own.isdisjoint(self.lost):
                break
        whole = bool(parts) and own.isdisjoint(self.lost)
        if not whole:
            del self.recording.gaps[gaps:]
        for name in own:
            self.names.pop(name, None)
            self.lost.pop(name, None)
        return whole

    def show(self, stage: Stage, cell: Cell) -> None:
        """Record the drawings and the marked positions that a cell shows; of the drawings all or none are known."""
        found = list[Drawn | None]()
        for part in showing.expressions(cell):
            name = part.id if isinstance(part, ast.Name) else showing.HERE
            if name is showing.HERE:
                self.step(stage, part.lineno, self.facts(showing.bound(part)), set())
                if name not in self.names:
                    self.lost.pop(name, None)
                    return
            value, own = self.names.get(name), [*showing.drawings(self.namespace.get(name))]
            guards = *self.looked.get(name, ()), *stage.guards.values()
            drawn = [*showing.drawings(value)]
            for k, x in value.positions if isinstance(value, Mark) else ():
                self.recording.positions[k] = self.while_same(lift(self.graph, x), guards).re
            sketches = (Drawn(each, guards) if isinstance(each, Sketch) else None for each in drawn)
            found += [None] * len(own) if own and len(own) != len(drawn) else sketches
        at = self.sheet.cells.index(cell)
        captions = {number: self.told(stage, title) for number, title in showing.captions(cell).items()}
        texts = [self.told(stage, text) for text in showing.texts(cell)]
        self.recording.captions |= {number: told for number, told in captions.items() if isinstance(told, Said)}
        self.recording.texts[at] = [told for told in texts if isinstance(told, Said)]
        if why := next((told for told in (*captions.values(), *texts) if isinstance(told, str)), ""):
            self.recording.unsaid[at] = why
        self.names.pop(showing.HERE, None)
        self.recording.drawings[at] = found

    def told(self, stage: Stage, text: ast.expr) -> Said | str:
        """A text, with the recorded numbers in it; of one that is not known why."""
        self.step(stage, text.lineno, self.facts(showing.bound(text)), set())
        lost, value = self.lost.pop(showing.HERE, None), self.names.pop(showing.HERE, None)
        guards = *self.looked.get(showing.HERE, ()), *stage.guards.values()
        known = value if isinstance(value, Written) else Written((value,)) if isinstance(value, str) else None
        return Said(known, guards) if known and not lost else f"line {text.lineno}: {lost or _MADE}"

    def step(self, stage: Stage, line: int, facts: statement.Statement, later: set[str]) -> None:
        """Run one statement; where it cannot be recorded, its names keep the numbers of the worksheet's own run.

        Those are not known of names that ``later`` statements of the cell bind or change again.
        """
        graph = self.graph
        graph.line, graph.looked, graph.numbered, graph.work = line, {}, {}, 0
        del graph.chosen[:]
        graph.meant.forget()
        staged.set(stage.shows)
        reads, before = self.reading(facts.loaded)
        under, unknown = reads | facts.former, facts.former.intersection(self.lost).difference(self.names)
        before.add(self.values(facts.former))
        codes = [facts.code, *(f.__code__ for f in before.functions)]
        changed = [*facts.touched, *chain.from_iterable(map(statement.shared_names, codes))]
        touched = dict.fromkeys(name for name in changed if not isinstance(self.names.get(name), Module))
        rests, shown = (
            {guard.holds: guard for name in sorted(names) for guard in self.looked.get(name, ())}
            for names in (reads, reads if facts.heard == facts.loaded else self.read(facts.heard))
        )
        may_change = any(map(changes, codes)) or changes_held(facts.shows, facts.in_place, self.names)
        unseen = (under | {*touched}) & self.lost.keys() - self.names.keys() if may_change else set[str]()
        arrays = (x for x in map(self.names.get, facts.in_place) if isinstance(x, np.ndarray | Quantity))
        held = (x for x in map(self.names.get, facts.within) if getattr(x, "ndim", 0) != 1)  # else of numbers
        others = Memory.sharing(self.names, [*arrays, *held]).difference(touched)
        seen = {frozenset(guard.holds for guard in self.looked.get(n, ())) for n in (*facts.changed, *others)}
        may = others and others <= self.of_cell and len(seen) == 1  # else it is another one for other inputs
        may = may and (facts.at_once or reads.isdisjoint(others))
        array = taken_apart(graph, self.names, facts.changed, others, {*facts.changed, *reads}) if may else None
        beside_it = others if array else set[str]()
        touched |= dict.fromkeys(beside_it)
        final = {name for name in touched if name not in later and not name.startswith("_")}
        several = of_one_array(final, self.to_change, self.namespace)
        final -= several
        self.compared_later = dict.fromkeys([*(n for n in self.compared_later if n not in final), *several])
        handed = under if sets_of_others(*codes) else under_others(facts.shows, self.names, under)
        reached = Memory.sharing(self.names, map(self.names.get, handed)).difference(touched)  # a function may change
        altered = facts.in_place | handed | reached  # names of arrays that may be others now
        differs: list[str] = []
        try:
            if others and not array:
                raise NotRecorded(OTHER_NAME)
            if gone := facts.in_place & self.lost.keys() - self.names.keys():
                raise self.lost[min(gone)]
            for name in facts.calls:
                if name in facts.renamed or statement.is_own(name, self.names, self.namespace):
                    raise NotRecorded(f"{name} is another function here than Python's own")
            exec(facts.code, self.names)
            if array:
                array.put_together(self.names)
            if graph.meant.disturbed():
                raise NotRecorded(CHANGED)
            if graph.untold:
                alone = resting_on(graph.untold, {name: self.names.get(name) for name in final})
                self.recording.gaps.append(Gap(alone, graph.line, next(iter(graph.untold.values()))))
                graph.untold.clear()
            self.measure(touched, reads)
            differs = self.differing(stage, final)
            if graph.thin > 1:
                others = {name for name in differs if not self.of_listed(name)}
                self.over_all([name for name in touched if name in others or self.over_listed(name)])
                differs = self.differing(stage, final)
            if not all(map(self.of_listed, differs)):
                of_all = " is of all positions, and only those that tables list are recorded"
                other = changed_as(differs, self.to_change, self.namespace)
                raise NotRecorded(", ".join(differs) + (of_all if graph.thin > 1 else other or _DIFFERS))
            if any(not _PLACES.isdisjoint(names_of(code)) for code in codes):
                decided(graph)
            if stage.built(final) and self.leaves(facts, under, codes, before):
                raise NotRecorded("its columns are built without table or figure")
        except (Exception, NotRecorded) as error:
            rests_on = [*self.recording.inputs.values()] if differs else self.leaves(facts, under, codes, before)
            gives = {name: self.namespace.get(name) for name in final}
            of_later = Memory.sharing(gives, map(self.namespace.get, self.to_change))  # which are others by then
            reason = self.why(error, reads)
            self.keep(stage, touched, final - of_later, reason, rests_on)
            changed_now = before.changed() | graph.meant.disturbed() | (before.mutable() if may_change else set())
            beside = before.named(self.names, changed_now)
            beside = beside.union(*(names for names, _ in self.aliasing(changed_now, altered, unseen)))
            if not self.to_change.isdisjoint(touched):  # it may be another name of what it reads, and changes later
                reached = Memory.sharing(self.names, map(self.names.get, under))
            beside = (beside | others | reached).difference(touched)
            self.lose(stage, beside | of_later, later | of_later, reason)
            before.add(self.values([*touched, *beside]))  # what is kept is another object than what had several names
            self.aliases.append(({*touched, *beside}, before, before.containers(), reason))
            stage.finish(lambda x: x)
            return
        ways = may_change and bool(graph.looked)  # of which others change more
        now = before.changed() | (before.mutable() if ways else set())
        now |= before.others(now)
        beside = before.named(self.names, now).difference(touched)
        for stale, reason in self.aliasing(now, altered, frozenset()):
            self.lose(stage, stale.difference(touched), later, reason)
        for names, *_ in self.aliases:  # what is bound anew is another value
            names -= {*touched} - facts.in_place - facts.former
        beside |= reached if graph.looked else set()
        known = {k: seen for k, seen in graph.looked.items() if not seen.lengths and (graph.refuses or not seen.why)}
        noted = {} if touched or beside else known
        stage.guards |= noted
        self.recording.guards |= graph.numbered | noted
        rests, shown = rests | graph.looked, shown | graph.looked
        for name in beside:
            self.looked[name] = tuple(({guard.holds: guard for guard in self.looked.get(name, ())} | rests).values())
        for name in touched:
            made = self.names.get(name)
            if isinstance(made, Slider) and name != showing.HERE:  # it rests where the worksheet has it
                own = self.namespace.get(name, made)
                self.names[name] = showing.slid(self.recording, name, made, own) if graph.draws else own
            former = self.looked.get(name, ()) if name in facts.former or name in beside_it else ()
            inputs = self.recording.inputs.values() if name in unknown else ()
            self.looked[name] = *rests.values(), *former, *self.while_are(inputs)
            self.hold(name, self.looked[name])
            if isinstance(value := self.names.get(name), Selected) and name in self.lines and not value.draws:
                self.note(Guard(value.same, graph.line))
        each = [
            {guard.holds: guard for name in sorted(self.read(names)) for guard in self.looked.get(name, ())}
            | graph.looked
            for names in facts.columns
        ]
        stage.finish(
            lambda x: self.while_same(x, shown.values()), [partial(self.while_same, rests=own.values()) for own in each]
        )

    def decide(self, stage: Stage, names: Iterable[str]) -> None:
        """Let what a cell gives and shows rest on what Python saw for statements that bind nothing, and may end it."""
        if not (guards := stage.guards):
            return
        for name in names:
            self.looked[name] = tuple(({guard.holds: guard for guard in self.looked.get(name, ())} | guards).values())
            self.hold(name, guards.values())
        stage.end(lambda x: self.while_same(x, guards.values()))

    def measure(self, touched: Iterable[str], reads: frozenset[str]) -> None:
        """Let unit constants that a statement binds be quantities, and numbers that a line declares in a unit.

        The unit of what Python made a number of, out of what it reads, is not known.
        """
        numbers = any(type(value) is float or is_array(value) for value in map(self.names.get, touched))
        made = numbers and any(has_quantity(self.names.get(name)) for name in reads)
        for name in touched:
            value, line = self.names.get(name), self.declared(name) or self.constants.get(name)
            if isinstance(value, units.Constant) or value is units:
                self.names[name] = instead(value)
            if isinstance(value, units.Constant | Selected) or value is units:
                continue
            unit = line.unit if line and not line.arguments else "-"
            number = value.re.value if isinstance(value, Quantity) and is_literal(value) else value
            if any(units.parse(unit).dims) and (type(number) in (int, float) or is_array(number)):
                self.names[name] = self.in_unit(value, number, unit)
            elif made and (type(value) is float or is_array(value)):
                self.names[name] = self.in_unit(value, value, units.UNKNOWN)

    def in_unit(self, value: Any, numbers: Any, unit: str) -> Quantity:
        """The numbers of a value, in a unit; whoever changes elements of it in place changes those of the value."""
        return Quantity(self.graph, self.graph.constant(numbers, unit), base=lift(self.graph, value).base)

    def declared(self, name: str) -> Formula | None:
        """The line that declares what the present statement binds a name to, which another one may bind anew."""
        here = (row for row in self.rebound if row.name == name and row.expression.lineno >= self.graph.line)
        return next(here, None) or self.lines.get(name)

    def set_up(self) -> None:
        """Run the setup again where it computes with units or declares one, or has a class; else its numbers stay."""
        alone, declared = self.graph.unmoved, self.lines.keys() | self.constants.keys()
        measured = {"units", *(name for name, value in self.names.items() if has_quantity(value))}
        reads = {line: self.read(self.facts(line).loaded) for line in setting_up.statements(self.sheet)}
        for line in self.sheet.defining() if alone else setting_up.again(reads, declared, measured):
            facts = self.facts(line)
            try:
                exec(facts.code, self.names)
                self.measure(facts.touched, frozenset())
            except (Exception, NotRecorded):  # its numbers stay, of no known dimension
                self.names |= {name: alone.unknown(self.graph, self.names[name]) for name in facts.touched if alone}
        if not alone:
            self.names |= setting_up.made_otherwise(self.graph, reads, self.names, self.sheet.common)

    def differing(self, stage: Stage, names: Iterable[str]) -> list[str]:
        """Names whose recorded numbers are not the worksheet's own."""
        return [x for x in names if not stage.same(self.names.get(x), self.namespace.get(x), x in self.lines)]

    def read(self, loaded: Iterable[str]) -> frozenset[str]:
        """Names that a statement reads, and those that the functions of the worksheet read which it names."""
        return self.reading(loaded)[0]

    def reading(self, loaded: Iterable[str]) -> tuple[frozenset[str], Memory]:
        """These names, and all that their values reach, but for the inputs."""
        found, waiting, reached = set[str](), {*loaded}, Memory((), self.names)
        while waiting:
            found |= waiting
            known = len(reached.functions)
            reached.add(self.values(waiting))
            waiting = set[str]().union(*(shared_by(f.__code__) for f in reached.functions[known:])) - found
        return frozenset(found), reached

    def leaves(
        self, facts: statement.Statement, reads: frozenset[str], codes: Iterable[CodeType], before: Memory
    ) -> list[Node]:
        """Inputs under what a statement reads, and under what Python saw for it."""
        roots = [guard.holds for name in sorted(reads) for guard in self.looked.get(name, ())]
        roots += before.nodes
        if not self.asked.keys().isdisjoint(reads):
            parts = facts.parts.union(*map(names_of, codes))
            used = [name for name in self.recording.inputs if name.partition(".")[0] in parts]
            roots += [self.recording.inputs[name] for name in (self.recording.inputs if facts.whole else used)]
        return leaves_of(roots, self.recording)
