"""The graph of a recording: quantities as operations on other quantities, and how they are made."""

import weakref
from collections.abc import Callable, Container, Iterable, Iterator, Mapping, Sequence
from contextvars import ContextVar
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

Values = NDArray[Any]


def bottom_up(roots: Iterable["Node"], known: Container["Node"]) -> Iterator["Node"]:
    """Nodes under ``roots`` that are not ``known`` yet, each once and after its operands."""
    stack, done = [(root, False) for root in roots], set[Node]()
    while stack:
        node, ready = stack.pop()
        if node in done or node in known:
            continue
        if ready:
            done.add(node)
            yield node
        else:
            stack.append((node, True))
            stack.extend((operand, False) for operand in node.operands if operand not in done)


class NotRecorded(BaseException):
    """Something that a recording does not hold, in words; no code of a worksheet handles it."""


MOST = 50_000  # numbers that one statement of a worksheet may compute
LEAVES = ("constant", "rows", "input")


@dataclass(eq=False)
class Block:
    """A solve block: its unknowns are the ``nodes`` at which the ``residuals`` vanish, which themselves rest on these.

    ``starts`` are the quantities that it was given, by their names: ``lo``, ``hi`` and ``guess`` of a ``single``
    unknown, else the guess or the two ends of each. ``under`` are all that it rests on but its own unknowns. Where all
    is ``elementwise``, the residuals of many values of the unknowns are those of each.
    """

    starts: Mapping[str, tuple["Node", ...]]
    single: bool
    least: bool = False
    unit: tuple[str, ...] = ()
    unknown_unit: tuple[str, ...] = ()
    nodes: tuple["Node", ...] = ()
    residuals: tuple["Node", ...] = ()
    under: tuple["Node", ...] = ()
    elementwise: bool = True

    def rest(self) -> None:
        """Find out what the block rests on, once its residuals are known."""
        own, under = set(self.nodes), dict[Node, None]()
        for node in bottom_up(self.residuals, own):
            if not own.isdisjoint(node.operands):
                own.add(node)
                self.elementwise &= node.op in ELEMENTWISE
                under |= dict.fromkeys(operand for operand in node.operands if operand not in own)
        outside = (r for r in self.residuals if r not in own)
        given = (node for nodes in self.starts.values() for node in nodes)
        known = [*(node for node in under if node not in own), *outside, *given]
        self.under = tuple(dict.fromkeys(node for node in known if node.op != "constant"))


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Node:
    """One real quantity of any shape: an operation on other quantities, with its values.

    It never changes, nor do its values. A node equals only itself: what a reader finds out about nodes it keeps in a
    table of its own, with the node as the key. ``line`` is the line of the worksheet that made it first, 0 for none.

    Operations are those of `ELEMENTWISE`, on operands that are broadcast to each other, and

    ==========================  ====================================================================================
    ``constant``, ``rows``      numbers, with a unit where they have one; the numbers 0, 1, 2 .. of the rows
    ``input``                   an input
    ``found`` (block, number)   one of the unknowns that a `Block` finds; after them its evaluations of the equations
    ``exported``                numbers of the worksheet's own run, which rest on its operands nobody knows how
    ``take`` (source, index)    elements by their flat positions, in the shape of ``index``
    ``at`` (source, position)   elements by positions that are a quantity themselves
    ``join`` (sources, ..)      elements of several sources: which source, and which element of it
    ``reduce`` (source, ..)     of each group of flat positions what the kind says, one of `REDUCE`
    ==========================  ====================================================================================
    """

    op: str
    args: tuple[Any, ...]
    value: Values
    line: int = 0

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
        if self.op == "found":
            under: tuple[Node, ...] = self.args[0].under
            return under
        return self.args[0] if self.op == "join" else self.args[:1] if self.op in ("take", "reduce") else self.args


class Guard(NamedTuple):
    """What Python saw of a quantity: it took one way of several, which the recorded formulas follow."""

    holds: Node  # true while Python would see the same
    line: int  # of the worksheet
    rows: bool = False  # it is the number of rows, which a writer with a fixed number of them knows


class Gap(NamedTuple):
    """Names whose numbers are those of the worksheet's own run, since what gives them is not recorded."""

    names: tuple[str, ...]
    line: int  # of the worksheet
    reason: str

    def __str__(self) -> str:
        return f"line {self.line}, {', '.join(self.names) or 'what it changes'}: {self.reason}"


class Label(NamedTuple):
    """What a step inside a library function is called."""

    symbol: str
    unit: str
    meaning: str


class Graph:
    """All nodes of one recording; equal operations on equal operands are one node.

    With ``thin`` only every so many of the numbers that ``linspace`` gives are taken: what a worksheet computes from
    position to position it then computes for the positions that its tables list.

    ``looked`` are guards, what the Python code saw of quantities: where one of them no longer holds, what rests on it
    is no longer what the worksheet has. ``labels`` are the names of steps inside library functions. ``line`` is the
    line of the worksheet that is run.
    """

    def __init__(self, thin: int = 1) -> None:
        self.thin = thin
        self.positions = 0  # numbers of linspace before any were left out
        self.line = 0
        self.work = 0  # numbers computed since somebody set it to 0
        self.fixed = set[Node]()  # which rest on constants alone
        self.pivots = set[Node]()  # conditions that put the rows of linear equations in order, which may be unlike
        self.nodes: dict[Any, Node] = {}
        self.looked: dict[Node, Guard] = {}  # by their conditions; since somebody emptied it
        self.gone: list[weakref.ref[Any]] = []  # arrays in whose place another one was put
        self.supposed = 0  # ways that Python does not take and that are recorded beside it, one in another
        self.labels: dict[Node, Label] = {}

    def node(self, op: str, *args: Node) -> Node:
        """An operation, element by element, on operands that are broadcast to each other."""
        return self._kept((op, *args), op, args, lambda: ELEMENTWISE[op](*[a.value for a in args]))

    def _kept(self, key: Any, op: str, args: tuple[Any, ...], value: Callable[[], Any]) -> Node:
        known = self.nodes.get(key)
        if known is None:
            known = self.nodes[key] = Node(op, args, _fixed(value()), self.line)
            self.work += known.size
            if op == "constant" or (known.operands and self.fixed.issuperset(known.operands)):
                self.fixed.add(known)
            if self.work > MOST:
                raise NotRecorded(f"it takes more than {MOST:,} operations on single numbers")
        return known

    def see(self, seen: Node, rows: bool = False) -> None:
        """Note that Python looks at a condition, which holds now."""
        if seen not in self.fixed:
            self.looked.setdefault(seen, Guard(seen, self.line, rows))

    def same(self, node: Node) -> Node:
        """The condition that a quantity is what it is now, in all its elements."""
        finite = np.isfinite(node.value)
        now = self.fold("eq", node, self.constant(np.where(finite, node.value, 0)))
        if not finite.all():
            now = self.fold("where", self.constant(finite), now, self.fold("not", self.fold("finite", node)))
        return self.reduce("all", now, None, False)

    def exported(self, rests_on: Sequence[Node], value: Any) -> Node:
        """Numbers of the worksheet's own run, and the quantities that they rest on, nobody knows how."""
        array = _fixed(np.array(value))
        key = ("exported", tuple(rests_on), array.dtype.char, array.shape, array.tobytes())
        return self._kept(key, "exported", tuple(rests_on), lambda: array)

    def constant(self, value: Any, *unit: str) -> Node:
        """A number or an array of numbers; in SI where a unit says what it measures."""
        array = np.asarray(value)
        key = ("constant", array.dtype.char, array.shape, array.tobytes(), *unit)
        return self._kept(key, "constant", unit, array.copy)

    def leaf(self, op: str, name: str, value: Any) -> Node:
        """An input."""
        return self._kept((op, name), op, (), lambda: np.array(value))

    def found(self, block: Block, number: int, name: str, value: Any) -> Node:
        """One of the values that a solve block finds."""
        return self._kept(("found", name, number), "found", (block, number), lambda: np.array(value))

    def rows(self, count: int) -> Node:
        """The numbers 0, 1, 2 .. of the rows."""
        return self._kept(("rows", count), "rows", (), lambda: np.arange(count))

    def take(self, source: Node, index: Values) -> Node:
        """Elements of a quantity by their flat positions."""
        if source.op in ("constant", "rows"):
            return self.constant(source.value.reshape(-1)[index], *source.args)
        if source.shape == index.shape and np.array_equal(index.reshape(-1), np.arange(source.size)):
            return source
        if source.op == "take":
            return self.take(source.args[0], source.args[1].reshape(-1)[index])
        if source.op == "join" and index.size:
            sources, which, inside = source.args
            chosen = np.unique(which.reshape(-1)[index])
            if chosen.size == 1:
                return self.take(sources[chosen[0]], inside.reshape(-1)[index])
        key = ("take", source, index.shape, index.tobytes())
        return self._kept(key, "take", (source, _fixed(index)), lambda: source.value.reshape(-1)[index])

    def at(self, source: Node, position: Node) -> Node:
        """Elements of a quantity at flat positions that are a quantity themselves; NaN where there is none."""
        where = position.value.astype(float)
        inside = (where >= 0) & (where < source.size)
        if position.op == "constant" and inside.all():
            return self.take(source, position.value.astype(np.intp))
        index = np.where(inside, where, 0).astype(np.intp)
        value = lambda: np.where(inside, source.value.reshape(-1)[index] + 0.0, np.nan)  # noqa: E731
        return self._kept(("at", source, position), "at", (source, position), value)

    def join(self, sources: Sequence[Node], where: Values) -> Node:
        """Elements of several quantities as one: ``where`` numbers the elements of all of them, one after the other."""
        ends = np.cumsum([source.size for source in sources])
        which = np.searchsorted(ends, where, side="right")
        args = tuple(sources), _fixed(which), _fixed(where - np.concatenate([[0], ends])[which])
        flat = np.concatenate([source.value.reshape(-1) for source in sources])
        key = ("join", *sources, where.shape, where.tobytes())
        return self._kept(key, "join", args, lambda: flat[where])

    def reduce(self, kind: str, source: Node, axis: int | None, keepdims: bool) -> Node:
        """What the kind says of the elements along an axis, or of all."""
        if source.op == "join" and axis is None and kind in ("max", "min") and not keepdims:
            greatest, *others = [self.reduce(kind, part, None, False) for part in dict.fromkeys(source.args[0])]
            for other in others:
                greatest = self.fold(kind, greatest, other)
            return greatest
        value = REDUCE[kind](source.value, axis=axis, keepdims=keepdims)
        if source.op == "constant":
            return self.constant(value)
        if source.size == 1 and not kind.startswith("arg"):
            return self.take(source, np.zeros(np.shape(value), int))
        flat = np.arange(source.size).reshape(source.shape)
        groups = flat.reshape(1, -1) if axis is None else np.moveaxis(flat, axis, -1).reshape(-1, flat.shape[axis])
        key = ("reduce", source, kind, axis, keepdims)
        return self._kept(key, "reduce", (source, _fixed(groups), kind), lambda: value)

    def scan(self, kind: str, source: Node, axis: int) -> Node:
        """What the kind says of the elements along an axis up to each one."""
        lines = np.moveaxis(np.arange(source.size).reshape(source.shape), axis, -1).reshape(-1, source.shape[axis])
        groups: list[Any] = [None] * source.size
        for line in lines:
            for n, k in enumerate(line, 1):
                groups[k] = _fixed(line[:n].copy())
        value = lambda: REDUCE_SO_FAR[kind].accumulate(source.value, axis=axis)  # noqa: E731
        return self._kept(("scan", source, kind, axis), "reduce", (source, tuple(groups), kind), value)

    # The operations below leave out what adds nothing: a reader looks for none of it.

    def add(self, a: Node, b: Node) -> Node:
        if is_number(a, 0):
            return b
        if is_number(b, 0):
            return a
        if b.op == "neg":
            return self.sub(a, b.args[0])
        return self.fold("add", a, b)

    def sub(self, a: Node, b: Node) -> Node:
        if is_number(b, 0):
            return a
        if is_number(a, 0):
            return self.neg(b)
        return self.add(a, b.args[0]) if b.op == "neg" else self.fold("sub", a, b)

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
        return self.fold("mul", a, b)

    def div(self, a: Node, b: Node) -> Node:
        if is_number(b, 1) or is_number(a, 0):
            return a
        return self.neg(self.div(a.args[0], b)) if a.op == "neg" else self.fold("div", a, b)

    def fold(self, op: str, *args: Node) -> Node:
        """An operation; of constants without a unit the constant that it gives."""
        if all(a.op == "constant" and not a.args for a in args):
            return self.constant(ELEMENTWISE[op](*[a.value for a in args]))
        return self.node(op, *args)


current: ContextVar[Graph] = ContextVar("current")  # the graph of the recording that is made here


def is_number(node: Node, number: float) -> bool:
    """Whether a node is this constant, without a unit."""
    return node.op == "constant" and not node.args and node.shape == () and bool(node.value == number)


def _fixed(value: Any) -> Values:
    """Values that nobody can change any more."""
    array = np.asarray(value)
    array.flags.writeable = False
    return array


def _number(f: Callable[..., Values]) -> Callable[..., Values]:
    """Arithmetic in which a condition counts as 1 or 0."""
    return lambda *args: f(*[a + 0 if a.dtype == bool else a for a in args])


# What the numbers of an operation are: the reference for all other readers.
ELEMENTWISE: dict[str, Callable[..., Values]] = {
    "add": _number(np.add), "sub": _number(np.subtract), "mul": _number(np.multiply), "div": np.true_divide,
    "neg": np.negative, "pow": lambda a, b: np.power(np.asarray(a, float), b), "abs": np.abs, "sqrt": np.sqrt,
    "exp": np.exp, "log": np.log, "sin": np.sin, "cos": np.cos, "tan": np.tan, "asin": np.arcsin, "acos": np.arccos,
    "atan2": np.arctan2, "sign": np.sign, "floor": np.floor, "round": np.round, "mod": np.remainder, "max": np.maximum,
    "min": np.minimum, "where": np.where, "lt": np.less, "le": np.less_equal, "gt": np.greater,
    "ge": np.greater_equal, "eq": np.equal, "ne": np.not_equal, "and": np.logical_and, "or": np.logical_or,
    "not": np.logical_not, "finite": np.isfinite,
}  # fmt: skip
REDUCE: dict[str, Callable[..., Any]] = {
    "max": np.max, "min": np.min, "sum": np.sum, "prod": np.prod, "any": np.any, "all": np.all, "argmax": np.argmax,
    "argmin": np.argmin, "nanmax": np.nanmax, "nanmin": np.nanmin, "nansum": np.nansum,
}  # fmt: skip
REDUCE_SO_FAR = {"sum": np.add, "prod": np.multiply, "max": np.maximum, "min": np.minimum, "all": np.logical_and}
