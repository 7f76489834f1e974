"""The graph of a recording: quantities as operations on other quantities, and how they are made."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

Values = NDArray[Any]


class NotRecorded(Exception):
    """An operation that has no counterpart among the formulas of a spreadsheet."""


LEAVES = ("constant", "rows", "input", "found", "static")


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Node:
    """One real quantity of any shape: an operation on other quantities, with its values.

    It never changes, nor do its values. A node equals only itself: what a reader finds out about nodes it keeps in a
    table of its own, with the node as the key.
    """

    op: str
    args: tuple[Any, ...]
    value: Values

    @property
    def shape(self) -> tuple[int, ...]:
        return self.value.shape

    @property
    def size(self) -> int:
        return self.value.size

    @property
    def operands(self) -> tuple["Node", ...]:
        if self.op in LEAVES:
            return ()
        return self.args[0] if self.op == "join" else self.args[:1] if self.op in ("pick", "reduce") else self.args


class Label(NamedTuple):
    """What a step inside a library function is called."""

    symbol: str
    unit: str
    meaning: str


class Graph:
    """All nodes of one recording; equal operations on equal operands are one node.

    With ``thin`` only every so many of the numbers that ``linspace`` gives are taken: what a worksheet computes from
    position to position it then computes for the positions that its tables list.

    ``guards`` are the conditions that the Python code looked at, with what it saw: where one of them changes,
    the recorded formulas are no longer those of the worksheet.

    ``labels`` are the names of steps inside library functions.
    """

    def __init__(self, thin: int = 1) -> None:
        self.thin = thin
        self.nodes: dict[Any, Node] = {}
        self.guards: list[tuple[Node, Any]] = []
        self.labels: dict[Node, Label] = {}

    def node(self, op: str, *args: Node) -> Node:
        """An operation, element by element, on operands that are broadcast to each other."""
        key = (op, *args)
        known = self.nodes.get(key)
        if known is None:
            known = self.nodes[key] = Node(op, args, _fixed(_COMPUTE[op](*[a.value for a in args])))
        return known

    def constant(self, value: Any) -> Node:
        """A number or an array of numbers."""
        array = np.asarray(value)
        key = ("constant", array.dtype.char, array.shape, array.tobytes())
        known = self.nodes.get(key)
        if known is None:
            known = self.nodes[key] = Node("constant", (), _fixed(array.copy()))
        return known

    def leaf(self, op: str, name: str, value: Any) -> Node:
        """An input, a found value or an array of numbers that nothing is known about."""
        node = self.nodes[op, name] = Node(op, (), _fixed(np.array(value)))
        return node

    def rows(self, count: int) -> Node:
        """The numbers 0, 1, 2 .. of the rows."""
        key = ("rows", count)
        if key not in self.nodes:
            self.nodes[key] = Node("rows", (), _fixed(np.arange(count)))
        return self.nodes[key]

    def pick(self, source: Node, index: Values) -> Node:
        """Elements of a quantity by their flat positions."""
        if source.op in ("constant", "rows"):
            return self.constant(source.value.reshape(-1)[index])
        if source.size == 1 and index.shape == ():
            return source
        key = ("pick", source, index.shape, index.tobytes())
        known = self.nodes.get(key)
        if known is None:
            value = source.value.reshape(-1)[index]
            known = self.nodes[key] = Node("pick", (source, _fixed(index)), _fixed(value))
        return known

    def join(self, sources: Sequence[Node], axis: int | None) -> Node:
        """Elements of several quantities as one; a new first axis where ``axis`` is None."""
        shapes = [s.shape for s in sources]
        which = [np.full(shape, n) for n, shape in enumerate(shapes)]
        index = [np.arange(s.size).reshape(shape) for s, shape in zip(sources, shapes, strict=True)]
        values = [s.value for s in sources]
        if axis is None:
            values, which, index = (list(np.broadcast_arrays(*part)) for part in (values, which, index))
            join: Callable[..., Values] = np.stack
        else:
            join = np.concatenate
        at = axis or 0
        args = tuple(sources), _fixed(join(which, axis=at)), _fixed(join(index, axis=at))
        return Node("join", args, _fixed(join(values, axis=at)))

    def reduce(self, kind: str, source: Node, axis: int | None, keepdims: bool) -> Node:
        """Greatest, least or sum of the elements along an axis, or of all."""
        if source.op == "join" and axis is None and kind in ("MAX", "MIN") and not keepdims:
            greatest, *others = [self.reduce(kind, part, None, False) for part in dict.fromkeys(source.args[0])]
            for other in others:
                greatest = self.fold(kind, greatest, other)
            return greatest
        value = _REDUCE[kind](source.value, axis=axis, keepdims=keepdims)
        if source.op == "constant":
            return self.constant(value)
        if source.size == 1:
            return self.pick(source, np.zeros(np.shape(value), int))
        flat = np.arange(source.size).reshape(source.shape)
        groups = flat.reshape(1, -1) if axis is None else np.moveaxis(flat, axis, -1).reshape(-1, flat.shape[axis])
        key = ("reduce", source, kind, axis, keepdims)
        known = self.nodes.get(key)
        if known is None:
            known = self.nodes[key] = Node("reduce", (source, _fixed(groups), kind), _fixed(value))
        return known

    # The operations below leave out what adds nothing: a reader looks for none of it.

    def add(self, a: Node, b: Node) -> Node:
        if is_number(a, 0):
            return b
        if is_number(b, 0):
            return a
        if b.op == "neg":
            return self.sub(a, b.args[0])
        return self.fold("+", a, b)

    def sub(self, a: Node, b: Node) -> Node:
        if is_number(b, 0):
            return a
        if is_number(a, 0):
            return self.neg(b)
        return self.add(a, b.args[0]) if b.op == "neg" else self.fold("-", a, b)

    def neg(self, a: Node) -> Node:
        return a.args[0] if a.op == "neg" else self.fold("neg", a)

    def mul(self, a: Node, b: Node) -> Node:
        for x, y in ((a, b), (b, a)):
            if is_number(x, 0):
                return x
            if is_number(x, 1):
                return y
            if is_number(x, -1):
                return self.neg(y)
            if x.op == "neg":
                return self.neg(self.mul(x.args[0], y))
        return self.fold("*", a, b)

    def div(self, a: Node, b: Node) -> Node:
        if is_number(b, 1) or is_number(a, 0):
            return a
        return self.neg(self.div(a.args[0], b)) if a.op == "neg" else self.fold("/", a, b)

    def fold(self, op: str, *args: Node) -> Node:
        """An operation; of constants the constant that it gives."""
        if all(a.op == "constant" for a in args):
            return self.constant(_COMPUTE[op](*[a.value for a in args]))
        return self.node(op, *args)


def is_number(node: Node, number: float) -> bool:
    """Whether a node is this constant."""
    return node.op == "constant" and node.shape == () and bool(node.value == number)


def _fixed(value: Any) -> Values:
    """Values that nobody can change any more."""
    array = np.asarray(value)
    array.flags.writeable = False
    return array


def _number(f: Callable[..., Values]) -> Callable[..., Values]:
    """Arithmetic in which a condition counts as 1 or 0."""
    return lambda *args: f(*[a + 0 if a.dtype == bool else a for a in args])


_COMPUTE: dict[str, Callable[..., Values]] = {
    "+": _number(np.add), "-": _number(np.subtract), "*": _number(np.multiply), "/": np.true_divide,
    "neg": np.negative, "ABS": np.abs, "SQRT": np.sqrt, "SIN": np.sin, "COS": np.cos, "TAN": np.tan,
    "ASIN": np.arcsin, "ACOS": np.arccos,
    "ATAN2": np.arctan2, "EXP": np.exp, "LN": np.log, "SIGN": np.sign, "MOD": np.remainder, "MAX": np.maximum,
    "MIN": np.minimum, "IF": np.where, "<": np.less, "<=": np.less_equal, ">": np.greater, ">=": np.greater_equal,
    "=": np.equal, "<>": np.not_equal, "AND": np.logical_and, "OR": np.logical_or, "NOT": np.logical_not,
    "ISNUMBER": np.isfinite, "ROUND": np.round, "^": lambda a, b: np.power(np.asarray(a, float), b),
}  # fmt: skip
_REDUCE: dict[str, Callable[..., Any]] = {"MAX": np.max, "MIN": np.min, "SUM": np.sum, "OR": np.any, "AND": np.all}
