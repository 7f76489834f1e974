"""How many elements quantities have along their axes, where these follow a number of rows."""

from abc import ABC, abstractmethod
from collections.abc import Generator, Iterator, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from itertools import chain, combinations
from typing import Any, TypeVar

from mechsheet.quantities.node import Node, steps_of
from mechsheet.quantities.operations import ELEMENTWISE

_T = TypeVar("_T")
_Asking = Generator[tuple[Node, int], Any, _T]  # of something that needs lengths: of which quantities, along which axes
unnoted = ContextVar("unnoted", default=False)  # whether a loop takes its turns
_UNLIKE = "what goes together here is not as long as each other for these inputs"


@contextmanager
def turning() -> Iterator[None]:
    """A loop takes other turns for other inputs: nothing is noted of the lengths that go together in one of them."""
    token = unnoted.set(True)
    try:
        yield
    finally:
        unnoted.reset(token)


def _by_condition(length: Node) -> bool:
    """Whether a length is that of the elements for which a condition holds."""
    under = steps_of(length, lambda part: part.operands if part.op in ELEMENTWISE else (), ())
    return any(part.op == "reduce" for part in chain([length], under))


class Lengths(ABC):
    """The lengths of the axes of quantities, as quantities; ``fixed`` ones rest on constants alone."""

    filtered = False  # whether a condition tells how many rows something has
    draws = False  # whether it is a page, in which lists are as long as they are typed

    def __init__(self) -> None:
        self.fixed = set[Node]()
        self.lengths: dict[tuple[Node, int], Node] = {}
        self.sizes: dict[Node, tuple[Node, ...]] = {}

    @abstractmethod
    def constant(self, value: Any, *unit: str) -> Node:
        """A number or an array of numbers; in SI where a unit says what it measures."""

    @abstractmethod
    def node(self, op: str, *args: Node) -> Node:
        """An operation, element by element, on operands that are broadcast to each other."""

    @abstractmethod
    def reduce(self, kind: str, node: Node, axis: Any, keepdims: bool) -> Node:
        """Sums, greatest values and the like along axes."""

    @abstractmethod
    def own_length(self, node: Node, axis: int) -> Node:
        """The length of a quantity along an axis that nothing else has."""

    @abstractmethod
    def see(self, seen: Node, *, why: str = "") -> None:
        """Note that Python looks at a condition, which holds now."""

    def ask_rows(self, node: Node) -> None:
        """Note that Python asks how many rows a list among the inputs has: its cells have numbers for so many alone."""
        if node.op == "input" and node.shape and not node.stretches:
            self.see(self.reduce("all", self.node("finite", node), None, False))

    def go_together(self, *parts: Node, strictly: bool = False, hidden: bool = False) -> None:
        """Note that the shapes of quantities go together, as numpy asks for, where a condition tells how many rows.

        Where they are to ``strictly``, none is repeated: all are as long as each other along the last axis. Of rows
        that are put in or taken out it is noted then, and where numbers that there are not would be ``hidden``.
        """
        as_typed = self.draws and (strictly or hidden) and not unnoted.get()
        if not (self.filtered or as_typed):
            return
        fields = [part for part in parts if part.shape]
        one = self.constant(1)
        for axis in range(-1 if strictly else -max((len(part.shape) for part in fields), default=0), 0):
            lengths = dict.fromkeys(self.length(part, axis) for part in fields if len(part.shape) >= -axis)
            for a, b in combinations(lengths, 2):
                if not (as_typed or _by_condition(a) or _by_condition(b)):
                    continue
                alike = self.node("eq", a, b)
                if not strictly:
                    alike = self.node("or", alike, self.node("or", self.node("eq", a, one), self.node("eq", b, one)))
                self.see(alike, why=_UNLIKE if as_typed else "")

    def length(self, node: Node, axis: int) -> Node:
        """How many elements a quantity has along an axis, which is counted from the last one."""
        known = self.lengths.get((node, axis))
        waiting = [self._length_of(node, axis)] if known is None else []
        while waiting:  # it does not call itself: of a loop's turns each rests on the one before
            try:
                part = waiting[-1].send(known)
            except StopIteration as end:
                known = end.value
                waiting.pop()
            else:
                known = None
                waiting.append(self._length_of(*part))
        assert known is not None
        return known

    def _length_of(self, node: Node, axis: int) -> _Asking[Node]:
        """The length along an axis, which asks for those of other quantities."""
        if not node.stretches:
            return self.constant(node.shape[axis])
        if node.op == "rows":
            count: Node = node.args[0]
            return count
        if node.op == "found":  # all unknowns of a block have one shape
            node = node.args[0].nodes[0]
        known = self.lengths.get((node, axis))
        if known is None and node.op == "found" and not node.args[0].residuals:
            return self.own_length(node, axis)
        if known is None:
            if node.op == "found":  # on which its residuals rest
                self.lengths[node, axis] = self.own_length(node, axis)
            under = yield from self._length_under(node, axis)
            known = self.lengths[node, axis] = under or self.own_length(node, axis)
        return known

    def _length_under(self, node: Node, axis: int) -> _Asking[Node | None]:
        """The length of what a quantity is made of, where both are as long whatever the number of rows is."""
        parts = list[tuple[Node, int]]()
        if node.op in ELEMENTWISE:
            parts = [(part, axis) for part in node.args if len(part.shape) >= -axis]
        elif node.op == "at":  # as many as the places are
            parts = [(node.args[1], axis)]
        elif node.op in ("state", "iterated"):  # which is as it was at first
            parts = [(node.args[0] if node.op == "state" else node.args[0].initial[node.args[1]], axis)]
        elif node.op == "found":
            parts = [(part, axis) for part in node.args[0].residuals if part.shape == node.shape]
        elif node.op == "reduce":
            shown = node.args[3].shows(axis, len(node.args[0].shape))
            if shown is None:
                return self.constant(node.shape[axis])
            parts = [(node.args[0], shown)]
        elif node.op == "join":
            sources, joined = node.args[0], node.args[3].along(len(node.shape))
            if joined is not None and joined[0] != axis:
                parts = [(source, axis + (joined[1] and axis < joined[0])) for source in sources]
            elif joined is not None and (joined[1] or not (yield from self._any_stretches(sources, axis))):
                return self.constant(node.shape[axis])
        elif node.op == "take" and len(node.args[2]) == 1:
            source, _, (moved,) = node.args
            origin = moved.origin(axis, len(source.shape))
            if origin and origin.left_out == 0:
                known: Node = yield source, origin.axis
                return known
            if origin and (origin.axis is None or not (yield from self._any_stretches([source], origin.axis))):
                return self.constant(node.shape[axis])
            if origin and origin.left_out:
                known = yield source, origin.axis
                return self.node("max", self.node("sub", known, self.constant(origin.left_out)), self.constant(0))
        found = set[Node]()
        for part, k in parts:
            if part.stretches:
                found.add((yield part, k))
        if parts and self.fixed.issuperset(found):
            return self.constant(node.shape[axis])
        if len(found) > 1:  # what is found for the rows has as many
            found = {n for n in found if n.op != "length" or n.args[0].op != "found"}
        fixed = all(part.stretches or part.shape[k] == 1 for part, k in parts)
        return found.pop() if fixed and len(found) == 1 else None

    def _any_stretches(self, nodes: Sequence[Node], axis: int) -> _Asking[bool]:
        for node in nodes:
            if node.stretches and (yield node, axis) not in self.fixed:
                return True
        return False

    def stretch(self, node: Node, axis: int) -> bool:
        """Whether a quantity stretches along an axis, which is counted from the last one."""
        return node.stretches and self.length(node, axis) not in self.fixed

    def size(self, node: Node) -> tuple[Node, ...]:
        """The lengths of all axes."""
        known = self.sizes.get(node)
        if known is None:
            known = tuple(self.length(node, axis) for axis in range(-len(node.shape), 0))
            if node.op != "found":  # whose residuals tell, once they are known
                self.sizes[node] = known
        return known
