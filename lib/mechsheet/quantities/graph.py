"""The graph of a recording: quantities as operations on other quantities, and how they are made."""

import math
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from functools import partial, reduce
from typing import Any, NamedTuple

import numpy as np

from mechsheet.quantities.lengths import Lengths
from mechsheet.quantities.meant import Meant
from mechsheet.quantities.node import Block, Loop, Node, is_number, is_whole, steps_of
from mechsheet.quantities.operations import ELEMENTWISE, REDUCE, REDUCE_SO_FAR, Along, Moved, Values


class NotRecorded(BaseException):
    """Something that a recording does not hold, in words; no code of a worksheet handles it."""


# Operations that may have no finite number where all their operands have one.
PARTIAL = frozenset(("div", "pow", "sqrt", "exp", "log", "tan", "asin", "acos", "mod", "sized"))
_MOVING = frozenset(("input", "rows", "length", "take", "join", "reduce"))
_GIVEN = frozenset(("constant", "input", "exported"))  # of which no number is computed
MOST = 1_000_000  # numbers that one statement may compute, many of them each a cell of a workbook
_COPIED = 8  # numbers that are only put together, of which none has a cell, count as one that is computed
_NODES = 50_000  # operations that it may have, of however few numbers: they take time in Python
_SET = "an array whose elements are set one by one is a new one each time, a list that is appended to is not"
_ANOTHER = "it reads a text that is another one for these inputs; of the type Literal[..] all options may follow"
MOST_DRAWN = 2_000_000  # the same where no cell holds them: in a page in one file, or a function of the inputs


class Guard(NamedTuple):
    """What Python saw of a quantity: it took one way of several, which the recorded formulas follow."""

    holds: Node  # true while Python would see the same
    line: int  # of the worksheet
    rows: bool = False  # it is the number of rows, which a writer with a fixed number of them knows
    lengths: bool = False  # it follows from that number
    turns: bool = False  # a loop ends within the turns that a writer has which does not repeat it
    why: str = ""  # in other words than that the code goes another way


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


class Graph(Lengths):
    """All nodes of one recording; equal operations on equal operands are one node.

    With ``thin`` only every so many of the numbers that ``linspace`` gives are taken: what a worksheet computes from
    position to position it then computes for the positions that its tables list. With ``bodies`` the functions of the
    mechanics run themselves, in the steps that keep most digits and with what they refuse, and not in the shorter ones
    of a workbook.

    ``looked`` are guards, what the Python code saw of quantities: where one no longer holds, what rests on it is no
    longer what the worksheet has. ``labels`` name steps inside library functions.
    """

    def __init__(self, thin: int = 1, draws: bool = False, lists: bool = False, bodies: bool = False) -> None:
        super().__init__()
        self.untold = dict[Node, str]()  # numbers of now alone that the present statement has, and why
        self.thin, self.bodies, self.draws, self.lists = thin, bodies, draws, lists  # lists: inputs of any length
        self.refuses = draws or bodies  # what Python has an error for is told; cells have errors themselves
        self.listed = frozenset[int]()  # how many rows the tables have that list every so many
        self.positions = 0  # numbers of linspace before any were left out
        self.line, self.work = 0, 0  # of the worksheet, which is run; numbers computed since somebody set it to 0
        self.unmoved: Any = None  # of a proof: how numbers are computed of numbers alone
        self.most = MOST_DRAWN if self.refuses else MOST  # that these may be
        self.counts = set[Node]()  # which rest on numbers of rows, and are these themselves
        self.always = set[Node]()  # which are numbers whatever the inputs are
        self.refused = dict[Node, Node | None]()  # where Python has no error for one, see `refused`
        self.pythons = dict[Node, bool]()  # whether one is Python's own, which divides none by zero
        self.sliders = set[Node]()  # their places
        self.whole, self.counted, self.of_lists = set[Node](), set[Node](), set[Node]()  # ints, floats without decimals
        self.pivots = set[Node]()  # conditions that put the rows of linear equations in order, which may be unlike
        self.nodes: dict[Any, Node] = {}
        self.alike: dict[Any, list[tuple[float, Node]]] = {}  # exported, by what they rest on and shape
        self.looked: dict[Node, Guard] = {}  # by their conditions; since somebody emptied it
        self.numbered: dict[Node, Guard] = {}  # those of numbers of rows and of turns, likewise
        self.meant = Meant()  # what stands for one of several, or for another one
        self.called: dict[Any, Any] = {}  # what functions gave, see `once`, and what numpy's elementwise ones did
        self.supposed, self.ways = 0, list[Any]()  # how many ways are recorded that Python does not take; conditions
        self.labels: dict[Node, Label] = {}
        self.chosen = list[tuple[Any, Any, str]]()  # quantities of which places were taken by size, the axis, and how

    @contextmanager
    def labelled(self, labels: dict[Node, Label]) -> Iterator[None]:
        """Other ``labels`` for a while, so that no step keeps a name that it gets meanwhile."""
        kept = self.labels, self.called
        self.labels, self.called = labels, {}  # functions run again, and name their steps
        try:
            yield
        finally:
            self.labels, self.called = kept

    def node(self, op: str, *args: Node) -> Node:
        """An operation, element by element, on operands that are broadcast to each other."""
        key = op, *args
        return self.nodes.get(key) or self._kept(key, op, args, lambda: ELEMENTWISE[op](*[a.value for a in args]))

    def _kept(
        self, key: Any, op: str, args: tuple[Any, ...], value: Callable[[], Any], stretches: bool | None = None
    ) -> Node:
        known = self.nodes.get(key)
        if known is None:
            along = any(a.stretches for a in args) if stretches is None else stretches
            own = _fixed(value())
            along = along and own.ndim > 0  # one number has no rows, whatever it is made of
            known = self.nodes[key] = Node(op, args, own, self.line, along)
            if op not in _GIVEN:
                computed = known.size // (_COPIED if op == "join" and not along else 1)
                self.work += max(computed, self.most // _NODES)
            under = known.operands
            if op == "constant" or (under and op != "state" and self.fixed.issuperset(under)):
                self.fixed.add(known)
            elif op == "length" or (
                op in ELEMENTWISE
                and not self.counts.isdisjoint(under)
                and all(a in self.fixed or a in self.counts for a in under)
            ):
                self.counts.add(known)
            if self.always.issuperset(under) and _exists(known):
                self.always.add(known)
            if self.work > self.most:
                why = f"it takes more than {self.most:,} operations on single numbers"
                raise NotRecorded(f"{why}: {_SET}" if op == "join" else why)
        return known

    def see(self, seen: Node, rows: bool = False, turns: bool = False, why: str = "") -> None:
        """Note that Python looks at a condition, which holds now; ``why`` it goes another way where it does not."""
        if seen not in self.fixed or (self.unmoved and seen.op != "constant"):
            kept = self.numbered if rows or turns else self.looked
            kept.setdefault(seen, Guard(seen, self.line, rows, not rows and seen in self.counts, turns, why))

    def measure(self, node: Node) -> None:
        """Note that Python looks at the shape of a quantity."""
        for axis in range(-len(node.shape), 0) if node.stretches else ():
            self.see(self.same(self.length(node, axis)))

    def read(self, text: Node) -> None:
        """Note that Python reads a text, or several, of which numbers tell whether they are others."""
        self.measure(text)
        self.see(self.same(text), why=_ANOTHER if self.draws else "")  # cells are made for all that is seen

    def own_length(self, node: Node, axis: int) -> Node:
        return self._kept(("length", node, axis), "length", (node, axis), lambda: np.array(node.shape[axis]), False)

    def like(self, node: Node, *others: Node) -> Node:
        """A quantity in the shape that it has together with others."""
        for other in others:
            if not other.shape:
                continue
            shape = node.shape if node.shape == other.shape else np.broadcast_shapes(node.shape, other.shape)
            if not (node.stretches or other.stretches):
                if shape != node.shape:
                    index = np.broadcast_to(np.arange(node.size).reshape(node.shape), shape)
                    node = self.take(node, np.ascontiguousarray(index))
            elif shape != node.shape or (other.stretches and self.size(node) != self.size(other)):
                node = self.node("like", node, self._basis(other))
        return node

    def _basis(self, node: Node) -> Node:
        """What gives a quantity its shape, as far as that is one of what it is made of."""
        while node.op in ELEMENTWISE and (
            parts := [a for a in node.args if a.stretches and self.size(a) == self.size(node)]
        ):
            node = parts[-1] if node.op == "like" else parts[0]
        return node

    def same(self, node: Node) -> Node:
        """The condition that a quantity is what it is now, in all its elements."""
        finite = np.isfinite(node.value)
        now = self.fold("eq", node, self.constant(np.where(finite, node.value, 0)))
        if not finite.all():
            now = self.fold("where", self.constant(finite), now, self.fold("not", self.fold("finite", node)))
        return self.reduce("all", now, None, False)

    def exported(self, rests_on: Sequence[Node], value: Any) -> Node:
        """Numbers of the worksheet's own run, and the quantities that they rest on, nobody knows how.

        The same node for what differs by the rounding of a unit, such as a result and its column of a table.
        """
        array = _fixed(np.array(value))
        alike = self.alike.setdefault((tuple(rests_on), array.dtype.char, array.shape), [])
        size = float(np.nansum(np.abs(array)))
        for other, node in alike:
            if math.isclose(other, size) and np.allclose(node.value, array, 4 * np.finfo(float).eps, 0, equal_nan=True):
                return node
        key = ("exported", tuple(rests_on), array.dtype.char, array.shape, array.tobytes())
        alike.append((size, new := self._kept(key, "exported", tuple(rests_on), lambda: array, False)))
        return new

    def constant(self, value: Any, *unit: str) -> Node:
        """A number or an array of numbers; in SI where a unit says what it measures."""
        array = np.asarray(value)
        key = ("constant", array.dtype.char, array.shape, array.tobytes(), *unit)
        return self._kept(key, "constant", unit, array.copy, False)

    def leaf(self, op: str, name: str, value: Any) -> Node:
        """An input."""
        return self._kept((op, name), op, (), lambda: np.array(value), self.lists and np.ndim(value) > 0)

    def columns(self, nodes: Sequence[Node]) -> None:
        """Let lists that are inputs be of one length."""
        for node in nodes[1:]:
            self.lengths[node, -1] = self.length(nodes[0], -1)

    def found(self, block: Block, number: int, name: str, value: Any) -> Node:
        """One of the values that a solve block finds."""
        array = np.array(value)
        return self._kept(("found", name, number), "found", (block, number), lambda: array, array.ndim > 0)

    def state(self, initial: Node) -> Node:
        """A number that a loop changes, at any of its turns."""
        return self._kept(("state", len(self.nodes)), "state", (initial,), initial.value.copy, initial.stretches)

    def iterated(self, loop: Loop, number: int, turns: Node) -> Node:
        """What a loop makes of one of its numbers; the ``turns`` one after the other give it too, while they do."""
        key, stretches = ("iterated", loop, number), turns.stretches or loop.initial[number].stretches
        return self._kept(key, "iterated", (loop, number, turns), lambda: turns.value, stretches)

    def rows(self, count: Node, kind: type = int) -> Node:
        """The numbers 0, 1, 2 .. of so many rows."""
        stretches = count not in self.fixed
        if stretches:
            self.counts.add(count)
        return self._kept(
            ("rows", count, kind), "rows", (count,), lambda: np.arange(int(count.value), dtype=kind), stretches
        )

    def take(self, source: Node, index: Values, *moved: Moved) -> Node:
        """Elements of a quantity by their flat positions; by what has ``moved`` them, where it stretches."""
        if source.stretches:
            return self._taken(source, index, moved)
        if source.op in ("constant", "rows"):
            return self.constant(source.value.reshape(-1)[index], *(source.args if source.op == "constant" else ()))
        if source.shape == index.shape and np.array_equal(index.reshape(-1), np.arange(source.size)):
            return source
        if source.op == "take" and not source.args[2]:
            return self.take(source.args[0], source.args[1].reshape(-1)[index])
        if source.op == "join" and index.size:
            sources, which, inside, _ = source.args
            chosen = set(which.reshape(-1)[index].flat)
            if len(chosen) == 1:
                return self.take(sources[chosen.pop()], inside.reshape(-1)[index])
        key = ("take", source, index.shape, index.tobytes())
        return self._kept(key, "take", (source, _fixed(index), ()), lambda: source.value.reshape(-1)[index], False)

    def _taken(self, source: Node, index: Values, moved: tuple[Moved, ...]) -> Node:
        *before, last = moved
        if last.keeps(len(source.shape)) and not before:
            return source
        if source.op == "take":
            first, inner, earlier = source.args
            return self._kept_take(first, inner.reshape(-1)[index], (*earlier, *moved))
        if source.op == "join" and not before and (picked := last.picked(source.args[3], len(source.shape))):
            number, rest = picked
            if len({self.size(one) for one in source.args[0]}) == 1:
                part = source.args[0][number]
                return self.take(part, source.args[2].reshape(-1)[index], *rest) if rest else part
        return self._kept_take(source, index, moved)

    def _kept_take(self, source: Node, index: Values, moved: tuple[Moved, ...]) -> Node:
        key = ("take", source, index.shape, index.tobytes(), *(m.key for m in moved))
        return self._kept(
            key, "take", (source, _fixed(index), moved), lambda: source.value.reshape(-1)[index], index.ndim > 0
        )

    def at(self, source: Node, position: Node) -> Node:
        """Elements of a quantity at flat positions that are a quantity themselves; NaN where there is none."""
        where = position.value.astype(float)
        inside = (where >= 0) & (where < source.size)
        if position.op == "constant" and inside.all():
            fixed = position.value.astype(np.intp)
            return self.take(source, fixed, Moved(np.take, (fixed,)))
        index = np.where(inside, where, 0).astype(np.intp)
        value = lambda: np.where(inside, source.value.reshape(-1)[index] + 0.0, np.nan)  # noqa: E731
        return self._kept(("at", source, position), "at", (source, position), value, position.stretches)

    def join(self, sources: Sequence[Node], where: Values, moved: Moved) -> Node:
        """Elements of several quantities as one: ``where`` numbers the elements of all of them, one after the other.

        ``moved`` has put them together.
        """
        stretches = any(source.stretches for source in sources)
        if not stretches:
            sources, where = _apart(sources, where)
        ends = np.cumsum([source.size for source in sources])
        which = np.searchsorted(ends, where, side="right")
        inside = where - np.concatenate([[0], ends])[which]
        args = tuple(sources), _fixed(which), _fixed(inside), moved if stretches else None
        flat = np.concatenate([source.value.reshape(-1) for source in sources])
        key = ("join", *sources, where.shape, where.tobytes(), *([moved.key] if stretches else []))
        return self._kept(key, "join", args, lambda: flat[where], stretches)

    def reduce(self, kind: str, source: Node, axis: int | None, keepdims: bool) -> Node:
        """What the kind says of the elements along an axis, or of all."""
        if axis is None and kind in ("max", "min") and not keepdims and _joined(source):
            greatest = dict[Node, Node]()
            for part in (*steps_of(source, _joined, ()), source):
                each = [greatest[one] for one in _joined(part)] or [self._reduce(kind, part, None, False)]
                greatest[part] = reduce(partial(self.fold, kind), each)
            return greatest[source]
        return self._reduce(kind, source, axis, keepdims)

    def _reduce(self, kind: str, source: Node, axis: int | None, keepdims: bool) -> Node:
        value = REDUCE[kind](source.value, axis=axis, keepdims=keepdims)
        if source.op == "constant" or not (source.size or source.stretches):
            return self.constant(value)
        if source.size == 1 and not kind.startswith("arg") and not source.stretches:
            return self.take(source, np.zeros(np.shape(value), int))
        flat = np.arange(source.size).reshape(source.shape)
        count = flat.size if axis is None else flat.shape[axis]  # of which there may be none
        groups = (flat if axis is None else np.moveaxis(flat, axis, -1)).reshape(np.size(value), count)
        key = ("reduce", source, kind, axis, keepdims)
        args = source, _fixed(groups), kind, Along(axis, keepdims)
        return self._kept(key, "reduce", args, lambda: value, source.stretches and axis is not None)

    def scan(self, kind: str, source: Node, axis: int) -> Node:
        """What the kind says of the elements along an axis up to each one."""
        length = source.shape[axis]  # which may be none
        lines = np.moveaxis(np.arange(source.size).reshape(source.shape), axis, -1)
        lines = lines.reshape(source.size // max(length, 1), length)
        lines.flags.writeable = False
        groups: list[Any] = [None] * source.size
        for line in lines:
            for n, k in enumerate(line, 1):
                groups[k] = line[:n]  # a view: copies of all would be as many numbers as half the square of a line's
        value = lambda: REDUCE_SO_FAR[kind].accumulate(source.value, axis=axis)  # noqa: E731
        args = source, tuple(groups), kind, Along(axis, so_far=True)
        return self._kept(("scan", source, kind, axis), "reduce", args, value, source.stretches)

    # The operations below leave out what adds nothing: a reader looks for none of it. 0 - x is no -x, which may be -0.

    def add(self, a: Node, b: Node) -> Node:
        if b.op == "neg":
            return self.sub(a, b.args[0])
        for x, y in ((a, b), (b, a)):
            if is_number(x, 0) and self.alone(y, x):
                return y
        return self.fold("add", a, b)

    def sub(self, a: Node, b: Node) -> Node:
        if is_number(b, 0) and self.alone(a, b):
            return a
        return self.add(a, b.args[0]) if b.op == "neg" else self.fold("sub", a, b)

    def alone(self, node: Node, number: Node) -> bool:
        """Whether a number that changes nothing may be left out: it makes no numbers of conditions or whole ones."""
        if node.value.dtype == bool:
            return False
        return number.value.dtype.kind != "f" or not is_whole(node, self.whole)

    def neg(self, a: Node) -> Node:
        return a.args[0] if a.op == "neg" else self.fold("neg", a)

    def mul(self, a: Node, b: Node) -> Node:
        for x, y in ((a, b), (b, a)):
            if is_number(x, 0):
                return x
            if is_number(x, 1) and self.alone(y, x):
                return y
            if is_number(x, -1) and self.alone(y, x):
                return self.neg(y)
            if x.op == "neg":
                return self.neg(self.mul(x.args[0], y))
        return self.fold("mul", a, b)

    def div(self, a: Node, b: Node) -> Node:
        if is_number(a, 0) or (is_number(b, 1) and self.alone(a, self.constant(1.0))):
            return a
        return self.neg(self.div(a.args[0], b)) if a.op == "neg" else self.fold("div", a, b)

    def fold(self, op: str, *args: Node) -> Node:
        """An operation; of constants without a unit the constant that it gives, in their shape."""
        plain = [a.args[0] if a.op == "like" else a for a in args if a.op in ("constant", "like")]
        if len(plain) == len(args) and all(a.op == "constant" and not a.args for a in plain):
            value = ELEMENTWISE[op](*[a.value for a in plain])
            if not (self.unmoved and np.asarray(value).dtype.kind == "f"):  # which may be rounded
                return self.like(self.constant(value), *args)
        return self.node(op, *args)


current: ContextVar[Graph] = ContextVar("current")  # the graph of the recording that is made here


def _exists(node: Node) -> bool:
    """Whether an operation gives finite numbers wherever its operands are finite, whatever they are."""
    if node.op == "constant":
        return bool(np.all(np.isfinite(node.value)))
    if node.op == "div":
        return node.args[1].op == "constant" and bool(np.all(node.args[1].value))
    return node.op in _MOVING or (node.op in ELEMENTWISE and node.op not in PARTIAL)


def _apart(sources: Sequence[Node], where: Values) -> tuple[Sequence[Node], Values]:
    """What joins are made of instead of these, as far as elements of it are taken.

    So an array of which the elements are set one by one is no chain of arrays.
    """
    if not any(source.op == "join" for source in sources):
        return sources, where
    parts, places, end = list[Node](), list[Values](), 0  # of each element its place among those of all parts
    for source in sources:
        own, which, inside, _ = source.args if source.op == "join" else ((source,), 0, np.arange(source.size), None)
        starts = end + np.cumsum([0, *(part.size for part in own)])
        places.append((starts[which] + inside).reshape(-1))
        parts, end = [*parts, *own], int(starts[-1])
    sizes = np.array([part.size for part in parts])
    found = np.concatenate(places)[where]
    of = np.repeat(np.arange(len(parts)), sizes)
    taken = np.bincount(of[found.reshape(-1)], minlength=len(parts)) > 0
    gone = np.cumsum(np.where(taken, 0, sizes))
    return [part for part, some in zip(parts, taken.tolist(), strict=True) if some], found - gone[of[found]]


def _joined(node: Node) -> tuple[Node, ...]:
    """The quantities that are joined, each once, where all of their elements are in what is joined."""
    if node.op != "join":
        return ()
    sources, which, inside, _ = node.args
    starts = np.cumsum([0, *(source.size for source in sources)])
    whole = len(set((starts[which] + inside).flat)) == int(starts[-1])
    return tuple(dict.fromkeys(sources)) if whole else ()


def _fixed(value: Any) -> Values:
    """Values that nobody can change any more."""
    array = np.asarray(value)
    array.flags.writeable = False
    return array
