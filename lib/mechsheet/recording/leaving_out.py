"""What a run leaves out: names whose values nobody can follow, with those of the worksheet's own run or none."""

from collections.abc import Iterable, Iterator, Mapping, Set
from typing import Any

from mechsheet.quantities.graph import Guard, NotRecorded
from mechsheet.quantities.node import Node
from mechsheet.quantities.quantity import Quantity
from mechsheet.quantities.unrepeatable import Unrepeatable
from mechsheet.recording import exactly, statement
from mechsheet.recording.guarded import Guarded
from mechsheet.recording.memory import Memory
from mechsheet.recording.named import in_words
from mechsheet.recording.own_values import held, is_number, may_be_kept
from mechsheet.recording.stage import Stage
from mechsheet.worksheet.errors import as_written
from mechsheet.worksheet.lines import Formula


class LeavingOut(Guarded):
    """A run of a worksheet that has the names of its cells; see `Run`."""

    namespace: Mapping[str, Any]
    asked: Mapping[str, Any]
    lines: Mapping[str, Formula]
    looked: dict[str, tuple[Guard, ...]]
    lost: dict[str, NotRecorded]
    aliases: list[tuple[set[str], Memory, set[int], NotRecorded]]
    passing: dict[str, Any]
    to_change: frozenset[str]

    def keep(
        self, stage: Stage, touched: Iterable[str], final: set[str], reason: NotRecorded, rests_on: list[Node]
    ) -> None:
        """The numbers of the worksheet's own run in place of a recording."""
        graph = self.graph
        graph.work = 0
        stage.forget()
        own = [self.namespace.get(name) for name in touched]
        lasting = graph.thin == 1 and final.issuperset(touched) and not isinstance(reason, Unrepeatable)
        if lasting and not rests_on and all(map(is_number, own)):
            for name, number in zip(touched, own, strict=True):  # the same for all inputs
                self.names[name], self.looked[name] = exactly.by_itself(graph, number), ()
            return
        guards = self.while_are(rests_on)
        if not final or not final.issuperset(touched) or any(held(self.namespace.get(name)) for name in final):
            if not (isinstance(reason, Unrepeatable) and reason in self.lost.values()):  # what rests on that is known
                public = [name for name in touched if not name.startswith("_")]
                self.recording.leave_out(public, graph.line, as_written(str(reason)))
            for guard in guards:
                self.note(guard)
        known = [name for name in touched if name in final and may_be_kept(name, self.namespace)]
        if isinstance(reason, Unrepeatable):
            self.passing |= {n: stage.kept(self.namespace[n], rests_on) for n in known if n in self.lines}
            known = []
        kept = {name: stage.kept(self.namespace[name], rests_on) for name in known}
        for name in touched:
            self.looked[name] = guards
            if isinstance(value := kept.get(name), Quantity):  # which has numbers where these hold alone
                self.chosen |= dict.fromkeys(value.parts, frozenset(guard.holds for guard in guards))
                self.looked[name] = guards if value.ndim else ()  # another array may be longer
            if name in kept:
                self.names[name] = kept[name]
            else:
                self.names.pop(name, None)
                self.lost[name] = reason
                if self.to_change - {name}:  # which may be other names of it
                    self.looked[name] = self.while_are(self.recording.inputs.values())

    def aliasing(self, ids: set[int], altered: Set[str], unseen: Set[str]) -> Iterator[tuple[set[str], NotRecorded]]:
        """Names that hold what is kept of a statement, where it may be what has changed under another name, and why."""
        for names, _, containers, reason in self.aliases if ids or altered or unseen else ():
            if not (containers.isdisjoint(ids) and names.isdisjoint(unseen)):
                yield {name for name in names if Memory(self.values([name]), self.names).containers()}, reason
            if not names.isdisjoint(altered):
                yield {name for name in names if Memory(self.values([name]), self.names).arrays}, reason

    def lose(self, stage: Stage, names: Iterable[str], later: set[str], reason: NotRecorded) -> None:
        """Names whose values a statement has changed, or may have changed, nobody knows how."""
        every = [*self.recording.inputs.values()]
        if shown := sorted(name for name in names if name in self.lines):
            self.recording.leave_out(shown, self.graph.line, as_written(str(reason)))
        for name in names:
            self.looked[name] = self.while_are(every)
            if name not in later and may_be_kept(name, self.namespace):
                self.names[name] = stage.kept(self.namespace[name], every)
            else:
                self.names.pop(name, None)
                self.lost[name] = reason

    def why(self, error: BaseException, reads: frozenset[str]) -> NotRecorded:
        """Why a statement cannot be recorded."""
        known = [self.lost[name] for name in sorted(reads) if name in self.lost]
        if known and isinstance(error, NameError):
            return next((reason for reason in known if isinstance(reason, Unrepeatable)), known[0])
        if isinstance(error, NotRecorded):
            taker = "" if isinstance(error, Unrepeatable) else statement.taker(error)
            return NotRecorded(taker) if taker else error.with_traceback(None)
        if isinstance(error, AttributeError) and error.obj is None:  # which what shows gives here
            return NotRecorded(f"it goes on with the {error.name} of a table, figure or check that it shows")
        return NotRecorded(f"it does not run with recorded quantities ({in_words(error)})")

    def values(self, names: Iterable[str]) -> Iterator[Any]:
        """The values of some names, but for the inputs."""
        return (self.names.get(name) for name in names if name not in self.asked)
