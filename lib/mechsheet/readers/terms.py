"""How large the numbers are of which a quantity is made: what its rounding, and what is left of it, is measured by."""

import math
from collections.abc import Container
from functools import reduce
from typing import Any, ClassVar

import numpy as np

from mechsheet.quantities.arithmetic import choice
from mechsheet.quantities.graph import Graph, NotRecorded
from mechsheet.quantities.node import Node, bottom_up, is_number, steps_of
from mechsheet.quantities.operations import Moved
from mechsheet.quantities.quantity import Quantity, lift


def made_of(node: Node, known: dict[Node, float]) -> float:
    """The largest number of which a quantity is a sum or difference, over all that it rests on.

    A function of such a sum has its roundings too, by as much as its slope: the cosine of a right angle is none.
    """
    for part in bottom_up([node], known):
        size, parts = size_of(part), part.operands
        match part.op:
            case "mul":
                size = max(size, known[parts[0]] * size_of(parts[1]), known[parts[1]] * size_of(parts[0]))
            case "div":
                least = np.min(np.abs(parts[1].value + 0.0), initial=np.inf)
                size = max(size, known[parts[0]] / least) if least else size
            case "pow" | "sqrt":
                size = max(size, size_of(parts[0]))
            case "exp":
                size *= max(1.0, known[parts[0]])
            case "tan":
                size = max(size, (1 + size**2) * known[parts[0]])
            case "log":
                size = max(size, known[parts[0]] / (size_of(parts[0]) or 1.0))
            case "atan2":
                largest = max(map(size_of, parts)) or 1.0
                size = max(size, *(known[p] / largest for p in parts))
            case op if op in _AS_LARGE:
                size = max([size, *(known[p] for p in parts)])
        known[part] = size
    return known[node]


_AS_LARGE = {  # as what they are made of: moved, chosen and added, and of functions those whose slope is about one
    "add", "sub", "neg", "abs", "max", "min", "mod", "sin", "cos", "asin", "acos", "take", "join", "reduce", "where",
    "like", "sized", "at",
}  # fmt: skip


def size_of(node: Node) -> float:
    sizes = np.abs(node.value + 0.0)
    if sizes.size and math.isfinite(largest := sizes.max()):
        return float(largest)
    return float(np.max(sizes, initial=0.0, where=np.isfinite(sizes)))


def measure(graph: Graph, node: Node, named: Container[Node]) -> Quantity:
    """How large the terms are of which each element is a sum or difference, as a quantity.

    They are looked for down to ``named`` quantities and steps of which they are no small difference for the inputs at
    hand: that all of these are nothing at once, and what they are made of is not, nobody expects.
    """
    return _Measured(graph, named).of(node)


class Terms:
    """The largest terms of quantities of one graph, of all that these are made of, as much as they move them."""

    def __init__(self, graph: Graph) -> None:
        self.graph = graph
        self.measured = {True: _MeasuredToTheEnd(graph, ()), False: _MeasuredBySums(graph, ())}

    def of(self, value: Quantity, deep: bool = True) -> Quantity:
        """Those of each element, of a point its own.

        Where it is not ``deep`` only those of the last sums, which take a tenth of the operations.
        """
        real, *imaginary = map(self.measured[deep].of, value.parts)
        return reduce(lambda a, b: Quantity(self.graph, self.graph.fold("max", a.re, b.re)), imaginary, real)

    def recorded(self, value: Quantity) -> Quantity:
        """The same by as much as a recording holds, as of many steps: at last itself, beside which nothing is small."""
        for deep in (True, False):
            self.graph.work = 0  # which limits a statement of the worksheet, and here what is said of one quantity
            try:
                return self.of(value, deep)
            except NotRecorded:
                pass
            finally:
                self.graph.work = 0
        return lift(self.graph, abs(value))


class _Measured:
    """The measures of some quantities, by those of what they are made of, down to ``named`` ones."""

    MEASURING: ClassVar = {  # by the operation: which of its operands are measured for it
        **dict.fromkeys(("neg", "abs", "like", "sized", "div", "pow", "sqrt", "reduce", "take"), slice(1)),
        **dict.fromkeys(("add", "sub", "max", "min", "mod", "mul"), slice(2)),
        "where": slice(1, None),
        "join": slice(None),
    }

    def __init__(self, graph: Graph, named: Container[Node]) -> None:
        self.graph, self.named, self.known, self.made = graph, named, dict[Node, Quantity](), dict[Node, float]()

    def of(self, node: Node) -> Quantity:
        for part in () if node in self.known else (*steps_of(node, self.parts, self.known), node):
            inside = None if self.ends(part) else self.inside(part)
            self.known[part] = abs(Quantity(self.graph, part)) if inside is None else inside
        return self.known[node]

    def ends(self, node: Node) -> bool:
        """Whether a quantity is measured by itself, whatever it is made of."""
        ends = node in self.named or node in self.graph.labels or node.op not in _LOOKED_INTO
        return ends and made_of(node, self.made) <= _ALIKE * size_of(node)

    def parts(self, node: Node) -> tuple[Node, ...]:
        """The operands by whose measures it is measured."""
        return () if self.ends(node) else node.operands[self.MEASURING.get(node.op, slice(0))]

    def inside(self, node: Node) -> Quantity | None:
        """By the measures of the operands; None where it is measured by itself."""
        args, itself = node.operands, Quantity(self.graph, node)
        measured: Any = None
        match node.op:
            case "neg" | "abs" | "like" | "sized":
                measured = self.of(args[0])
            case "add" | "sub" | "max" | "min" | "mod":
                measured = self.largest(*map(self.of, args[:2]))
            case "where":
                measured = choice(self.graph, Quantity(self.graph, args[0]), *map(self.of, args[1:]))
            case "mul":
                measured = self.of(args[0]) * self.of(args[1])
            case "div":
                measured = self.of(args[0]) / abs(Quantity(self.graph, args[1]))
            case "pow" if is_number(args[1], 2):
                measured = self.of(args[0]) ** 2
            case "sqrt":
                measured = np.sqrt(self.of(args[0]))
            case "sin" | "cos" | "asin" | "acos" | "atan2":
                measured = lift(self.graph, 1.0)
            case "log":
                measured = self.largest(abs(itself), lift(self.graph, 1.0))
            case "tan":
                measured = 1 + itself**2
            case "reduce" if node.args[2] == "sum" and not node.args[3].so_far:
                measured = self.whole(args[0]).reduced("sum", node.args[3].axis, node.args[3].keepdims)
            case "take":
                source, index, moves = node.args
                measured = self.whole(source)
                for move in moves or (Moved(np.take, (index,)),):
                    measured = measured.rearranged(move.f, *move.args, **dict(move.named))
            case "join":
                measured = self.joined(node)
        return None if measured is None else lift(self.graph, measured)

    def joined(self, node: Node) -> Quantity:
        sources, which, inside, moved = node.args
        starts = np.cumsum([0, *(source.size for source in sources)])
        each = [self.whole(source).re for source in sources]
        return Quantity(self.graph, self.graph.join(each, starts[which] + inside, moved))

    def whole(self, node: Node) -> Quantity:
        """The measure of each element, where it is one of all too."""
        measured = self.of(node)
        alike = measured.extent == node.shape and measured.re.stretches == node.stretches  # nobody looks at a length
        return measured if alike else measured.like(Quantity(self.graph, node))

    def largest(self, one: Quantity, other: Quantity) -> Quantity:
        return Quantity(self.graph, self.graph.fold("max", one.re, other.re))


class _MeasuredToTheEnd(_Measured):
    """Measures by all that quantities are made of: of a product what its factors are each moves it by the other one."""

    MEASURING: ClassVar = {**_Measured.MEASURING, "div": slice(2), "at": slice(1)}

    def ends(self, node: Node) -> bool:
        return False

    def size(self, node: Node) -> Any:
        return abs(Quantity(self.graph, node))

    def inside(self, node: Node) -> Quantity | None:
        args = node.operands
        measured: Any = None
        match node.op:
            case "mul":
                a, b = args
                measured = self.largest(self.of(a) * self.size(b), self.of(b) * self.size(a))
            case "div":
                a, b = args
                measured = self.largest(self.of(a), self.of(b) * self.size(a) / self.size(b)) / self.size(b)
            case "pow" if is_number(args[1], 2):
                measured = self.of(args[0]) * self.size(args[0])
            case "sqrt":
                root = Quantity(self.graph, node)
                measured = choice(self.graph, root > 0, self.of(args[0]) / root, 0.0)
            case "reduce" if node.args[2] in ("max", "min") and not node.args[3].so_far:
                measured = self.whole(args[0]).reduced("max", node.args[3].axis, node.args[3].keepdims)
            case "at":
                measured = Quantity(self.graph, self.graph.at(self.whole(args[0]).re, args[1]))
            case _:
                return super().inside(node)
        return lift(self.graph, measured)


class _MeasuredBySums(_MeasuredToTheEnd):
    """The same, but for what the terms of a sum are made of, where they are no sums."""

    MEASURING: ClassVar = {**_MeasuredToTheEnd.MEASURING, "add": slice(0), "sub": slice(0)}

    def inside(self, node: Node) -> Quantity | None:
        if node.op not in ("add", "sub"):
            return super().inside(node)
        parts = steps_of(node, lambda part: part.operands if part.op in _SUMS else (), ())
        first, *others = (abs(Quantity(self.graph, part)) for part in parts if part.op not in _SUMS)
        largest: Quantity = reduce(self.largest, others, first)
        return largest


_SUMS = ("add", "sub", "neg")
_ALIKE = 1e3  # times as large as a quantity itself is what it is made of at most where it is no small difference
_LOOKED_INTO = frozenset((
    "neg", "abs", "add", "sub", "max", "min", "where", "mul", "div", "sin", "cos", "asin", "acos", "atan2", "log",
))  # fmt: skip
