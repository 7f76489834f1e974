"""Quantities that compute as numbers do and remember how: real and imaginary parts apart, each a node of the graph.

A cell of a worksheet is run with quantities of this kind in place of its numbers, so that the same line of source also
gives the formula of a cell. What numpy's functions make of them is registered by `numpy_rules`.
"""

from collections.abc import Callable, Iterator, Sequence
from functools import cache
from typing import Any

import numpy as np

from mechsheet.recording.graph import Graph, Label, Node, NotRecorded, Values, is_number

UFUNCS: dict[Any, Callable[..., "Quantity"]] = {}  # of quantities
FUNCTIONS: dict[Any, Callable[..., Any]] = {}  # of the graph and whatever numpy's function takes


class Quantity:
    """A quantity of a worksheet, real or complex, that takes part in arithmetic and in numpy's functions."""

    __slots__ = ("graph", "im", "re")

    def __init__(self, graph: Graph, re: Node, im: Node | None = None) -> None:
        self.graph, self.re, self.im = graph, re, im

    @property
    def value(self) -> Values:
        return self.re.value if self.im is None else self.re.value + 1j * self.im.value

    @property
    def parts(self) -> Iterator[Node]:
        yield self.re
        if self.im is not None:
            yield self.im

    @property
    def shape(self) -> tuple[int, ...]:
        return self.re.shape if self.im is None else np.broadcast_shapes(self.re.shape, self.im.shape)

    @property
    def ndim(self) -> int:
        return len(self.shape)

    @property
    def size(self) -> int:
        return int(np.prod(self.shape))

    @property
    def dtype(self) -> np.dtype[Any]:
        return self.value.dtype

    @property
    def real(self) -> "Quantity":
        return Quantity(self.graph, self.re)

    @property
    def imag(self) -> "Quantity":
        return Quantity(self.graph, self.graph.constant(0.0) if self.im is None else self.im)

    def called(self, symbol: str, unit: str, meaning: str) -> "Quantity":
        """Name a step of a calculation: it gets a cell of its own."""
        for node, axis in zip(self.parts, ("x", "y") if self.im else ("",), strict=False):
            if node.op not in ("constant", "input"):
                self.graph.labels.setdefault(node, Label(symbol + axis, unit, meaning))
        return self

    def __len__(self) -> int:
        return self.shape[0]

    def __iter__(self) -> Iterator["Quantity"]:
        return (self[i] for i in range(len(self)))

    def __bool__(self) -> bool:
        seen = bool(self.value)
        if self.re.op != "constant":
            self.graph.guards.append((self.re, seen))
        return seen

    def __index__(self) -> int:
        if self.re.op != "constant":
            self.graph.guards.append((self.re, int(self.value)))
        return int(self.value)

    __int__ = __index__

    def __float__(self) -> float:
        raise NotRecorded("a number taken out of a quantity")

    def take(self, index: Values) -> "Quantity":
        """Elements by their flat positions, in the shape of ``index``."""
        shape = self.shape
        return self.each(lambda node: self.graph.pick(self._whole(node, shape), index))

    def broadcast(self, shape: tuple[int, ...]) -> "Quantity":
        return self.each(lambda node: self._whole(node, shape))

    def __getitem__(self, key: Any) -> "Quantity":
        index = np.arange(self.size).reshape(self.shape)[key.value if isinstance(key, Quantity) else key]
        return self.take(np.asarray(index))

    @property
    def T(self) -> "Quantity":
        """Transposed."""
        return self.take(np.ascontiguousarray(np.arange(self.size).reshape(self.shape).T))

    def argmax(self, axis: int = 0) -> "Quantity":
        """Position of the first true element along the first axis; 0 where none is."""
        if axis != 0 or self.re.value.dtype != bool:
            raise NotRecorded("the position of a greatest number")
        first: Any = 0.0
        for n in reversed(range(len(self))):
            first = choice(self.graph, self[n], float(n), first)
        return lift(self.graph, first)

    def reshape(self, *shape: Any) -> "Quantity":
        return self.take(np.arange(self.size).reshape(*shape))

    def sum(self, axis: int | None = None, keepdims: bool = False) -> "Quantity":
        return self.each(lambda node: self.graph.reduce("SUM", node, axis, keepdims))

    def max(self, axis: int | None = None, keepdims: bool = False) -> "Quantity":
        return Quantity(self.graph, self.graph.reduce("MAX", self.re, axis, keepdims))

    def min(self, axis: int | None = None, keepdims: bool = False) -> "Quantity":
        return Quantity(self.graph, self.graph.reduce("MIN", self.re, axis, keepdims))

    def any(self, axis: int | None = None, keepdims: bool = False) -> "Quantity":
        return Quantity(self.graph, self.graph.reduce("OR", self.re, axis, keepdims))

    def all(self, axis: int | None = None, keepdims: bool = False) -> "Quantity":
        return Quantity(self.graph, self.graph.reduce("AND", self.re, axis, keepdims))

    def each(self, f: Callable[[Node], Node]) -> "Quantity":
        """The same for the real and the imaginary part."""
        return Quantity(self.graph, f(self.re), None if self.im is None else f(self.im))

    def _whole(self, node: Node, shape: tuple[int, ...]) -> Node:
        if node.shape == shape:
            return node
        index = np.broadcast_to(np.arange(node.size).reshape(node.shape), shape)
        return self.graph.pick(node, np.ascontiguousarray(index))

    def __array_ufunc__(self, ufunc: Any, method: str, *inputs: Any, **kwargs: Any) -> "Quantity":
        operation = UFUNCS.get(ufunc)
        if operation is None or method != "__call__" or kwargs:
            raise NotRecorded(f"{ufunc.__name__}.{method}" if method != "__call__" else ufunc.__name__)
        return operation(*[lift(self.graph, x) for x in inputs])

    def __array_function__(self, func: Any, types: Any, args: Any, kwargs: Any) -> Any:
        operation = FUNCTIONS.get(func)
        if operation is None:
            raise NotRecorded(func.__name__)
        return operation(self.graph, *args, **kwargs)

    def __add__(self, other: Any) -> "Quantity":
        return add(self, lift(self.graph, other))

    def __radd__(self, other: Any) -> "Quantity":
        return add(lift(self.graph, other), self)

    def __sub__(self, other: Any) -> "Quantity":
        return subtract(self, lift(self.graph, other))

    def __rsub__(self, other: Any) -> "Quantity":
        return subtract(lift(self.graph, other), self)

    def __mul__(self, other: Any) -> "Quantity":
        return multiply(self, lift(self.graph, other))

    def __rmul__(self, other: Any) -> "Quantity":
        return multiply(lift(self.graph, other), self)

    def __truediv__(self, other: Any) -> "Quantity":
        return divide(self, lift(self.graph, other))

    def __rtruediv__(self, other: Any) -> "Quantity":
        return divide(lift(self.graph, other), self)

    def __pow__(self, other: Any) -> "Quantity":
        return power(self, lift(self.graph, other))

    def __mod__(self, other: Any) -> "Quantity":
        return elementwise("MOD")(self, lift(self.graph, other))

    def __neg__(self) -> "Quantity":
        return self.each(self.graph.neg)

    def __pos__(self) -> "Quantity":
        return self

    def __abs__(self) -> "Quantity":
        return absolute(self)

    def __invert__(self) -> "Quantity":
        return elementwise("NOT")(self)

    def __and__(self, other: Any) -> "Quantity":
        return elementwise("AND")(self, lift(self.graph, other))

    def __or__(self, other: Any) -> "Quantity":
        return elementwise("OR")(self, lift(self.graph, other))

    __rand__, __ror__ = __and__, __or__

    def __lt__(self, other: Any) -> "Quantity":
        return elementwise("<")(self, lift(self.graph, other))

    def __le__(self, other: Any) -> "Quantity":
        return elementwise("<=")(self, lift(self.graph, other))

    def __gt__(self, other: Any) -> "Quantity":
        return elementwise(">")(self, lift(self.graph, other))

    def __ge__(self, other: Any) -> "Quantity":
        return elementwise(">=")(self, lift(self.graph, other))

    def __eq__(self, other: object) -> "Quantity":  # type: ignore[override]
        return elementwise("=")(self, lift(self.graph, other))

    def __ne__(self, other: object) -> "Quantity":  # type: ignore[override]
        return elementwise("<>")(self, lift(self.graph, other))

    __hash__ = None  # type: ignore[assignment]


def has_quantity(value: Any) -> bool:
    """Whether a quantity, or a list with one somewhere in it."""
    if isinstance(value, list | tuple):
        return any(has_quantity(v) for v in value)
    return isinstance(value, Quantity)


def lift(graph: Graph, value: Any) -> Quantity:
    """A number, an array or a list as a quantity of this recording."""
    if isinstance(value, Quantity):
        return value
    if isinstance(value, list | tuple) and has_quantity(value):
        return stack(graph, [lift(graph, v) for v in value])
    array = np.asarray(value)
    if array.dtype.kind == "c":
        return Quantity(graph, graph.constant(array.real), graph.constant(array.imag))
    if array.dtype.kind not in "biuf":
        raise NotRecorded(f"values of the kind {array.dtype}")
    return Quantity(graph, graph.constant(array))


def stack(graph: Graph, parts: Sequence[Quantity], axis: int | None = None) -> Quantity:
    """Quantities along an axis; along a new first one where ``axis`` is None."""
    re = graph.join([p.re for p in parts], axis)
    if all(p.im is None for p in parts):
        return Quantity(graph, re)
    zeros = [p.im or graph.constant(np.zeros(p.shape)) for p in parts]
    return Quantity(graph, re, graph.join(zeros, axis))


def imaginary(x: Quantity) -> Node:
    """The imaginary part; 0 of a real quantity."""
    return x.im if x.im is not None else x.graph.constant(0.0)


def add(x: Quantity, y: Quantity) -> Quantity:
    graph = x.graph
    if x.im is None and y.im is None:
        return Quantity(graph, graph.add(x.re, y.re))
    return Quantity(graph, graph.add(x.re, y.re), graph.add(imaginary(x), imaginary(y)))


def subtract(x: Quantity, y: Quantity) -> Quantity:
    graph = x.graph
    if x.im is None and y.im is None:
        return Quantity(graph, graph.sub(x.re, y.re))
    return Quantity(graph, graph.sub(x.re, y.re), graph.sub(imaginary(x), imaginary(y)))


def multiply(x: Quantity, y: Quantity) -> Quantity:
    graph = x.graph
    if x.im is None and y.im is None:
        return Quantity(graph, graph.mul(x.re, y.re))
    a, b, c, d = x.re, imaginary(x), y.re, imaginary(y)
    return Quantity(graph, graph.sub(graph.mul(a, c), graph.mul(b, d)), graph.add(graph.mul(a, d), graph.mul(b, c)))


def divide(x: Quantity, y: Quantity) -> Quantity:
    graph = x.graph
    if y.im is None:
        return x.each(lambda part: graph.div(part, y.re))
    return divide(multiply(x, conjugate(y)), square(y))


def square(x: Quantity) -> Quantity:
    graph = x.graph
    two = graph.constant(2)
    re = graph.fold("^", x.re, two)
    return Quantity(graph, re if x.im is None or is_number(x.im, 0) else graph.add(re, graph.fold("^", x.im, two)))


def power(x: Quantity, y: Quantity) -> Quantity:
    if y.im is not None or (x.im is not None and not is_number(y.re, 2)):
        raise NotRecorded("a power of a complex number")
    if x.im is not None:
        return multiply(x, x)
    return x if is_number(y.re, 1) else Quantity(x.graph, x.graph.fold("^", x.re, y.re))


def conjugate(x: Quantity) -> Quantity:
    return x if x.im is None else Quantity(x.graph, x.re, x.graph.neg(x.im))


def absolute(x: Quantity) -> Quantity:
    if x.im is None or is_number(x.im, 0):
        return Quantity(x.graph, x.graph.fold("ABS", x.re))
    if is_number(x.re, 0):
        return Quantity(x.graph, x.graph.fold("ABS", x.im))
    return Quantity(x.graph, x.graph.fold("SQRT", square(x).re))


@cache
def elementwise(op: str) -> Callable[..., Quantity]:
    """An operation of the graph on real quantities."""

    def operation(*args: Quantity) -> Quantity:
        if any(a.im is not None for a in args):
            raise NotRecorded(f"{op} of complex numbers")
        return Quantity(args[0].graph, args[0].graph.fold(op, *[a.re for a in args]))

    return operation


def choice(graph: Graph, condition: Any, x: Any, y: Any) -> Quantity:
    """Elements of ``x`` where the condition holds, else of ``y``."""
    c, a, b = lift(graph, condition), lift(graph, x), lift(graph, y)
    if a.im is None and b.im is None:
        return Quantity(graph, graph.fold("IF", c.re, a.re, b.re))
    return Quantity(graph, graph.fold("IF", c.re, a.re, b.re), graph.fold("IF", c.re, imaginary(a), imaginary(b)))
