"""What the names of a run rest on: where Python would see something else, they are no numbers."""

from collections.abc import Iterable
from typing import Any

from mechsheet.quantities.arithmetic import only_where, sized
from mechsheet.quantities.graph import Graph, Guard
from mechsheet.quantities.lines import Recording
from mechsheet.quantities.node import Node, conditions
from mechsheet.quantities.quantity import Quantity
from mechsheet.quantities.selected import Selected


class Guarded:
    """The ``names`` of a run, and ``chosen``: which guards quantities rest on that Python has taken as they are."""

    recording: Recording
    graph: Graph
    names: dict[str, Any]
    chosen: dict[Node, frozenset[Node]]

    def hold(self, name: str, guards: Iterable[Guard]) -> None:
        """Let the number of a name be none unless Python sees the same."""
        value: Any = self.names.get(name)
        kept = value
        if isinstance(value, Selected):
            kept = Selected(self.while_same(value.of, guards), value.holds)
        elif isinstance(value, Quantity) and value.dtype != bool and any(p.op != "constant" for p in value.parts):
            kept = self.while_same(value, guards)
        if kept is not value:  # though the same array
            kept.base, kept.places, self.names[name] = value, ..., kept

    def while_same(self, x: Quantity, rests: Iterable[Guard]) -> Quantity:
        """A quantity while Python sees the same, else no number."""
        for guard in rests:
            if not guard.lengths:
                self.note(guard)
            if any(guard.holds not in conditions(part, self.chosen) for part in x.parts):
                if guard.lengths:
                    x = sized(x, guard.holds)
                else:
                    self.graph.work = 0  # what guards a statement's numbers is none of its own operations
                    x = only_where(self.graph, Quantity(self.graph, guard.holds), x)
        return x

    def while_are(self, leaves: Iterable[Node]) -> tuple[Guard, ...]:
        """That some quantities are what they are now."""
        return tuple(Guard(self.graph.same(leaf), self.graph.line) for leaf in leaves)

    def note(self, guard: Guard) -> None:
        """Note a guard, at the first line that saw the same."""
        if guard.why and not self.graph.refuses:  # cells of a workbook follow all other inputs
            return
        known = self.recording.guards.get(guard.holds, guard)
        same = known.rows or known._replace(line=guard.line) == guard  # a number of rows stays one whatever looks at it
        self.recording.guards[guard.holds] = known if same else guard
