"""Quantities that compute as numbers do and remember how: real and imaginary parts apart, each a node of the graph.

A cell of a worksheet is run with quantities of this kind in place of its numbers, so that the same line of source also
gives the formula of a cell. What numpy's functions make of them is registered by `numpy_rules`.
"""

from collections.abc import Callable, Iterator, Sequence
from functools import cache
from typing import Any

import numpy as np
from numpy.lib.mixins import NDArrayOperatorsMixin

from mechsheet.recording.graph import Graph, Label, Node, NotRecorded, Values, is_number
from mechsheet.units import Constant

UFUNCS: dict[Any, Callable[..., "Quantity"]] = {}  # of quantities
FUNCTIONS: dict[Any, Callable[..., Any]] = {}  # of the graph and whatever numpy's function takes
REDUCTIONS: dict[Any, str] = {}  # kinds that the reduce and accumulate of a ufunc stand for
METHODS = frozenset({
    "all", "any", "argmax", "argmin", "argsort", "clip", "conj", "conjugate", "copy", "cumprod", "cumsum", "diagonal",
    "dot", "max", "mean", "min", "nonzero", "prod", "ptp", "ravel", "repeat", "round", "sort", "squeeze", "std", "sum",
    "swapaxes", "trace", "transpose", "var",
})  # fmt: skip


class Quantity(NDArrayOperatorsMixin):
    """A quantity of a worksheet, real or complex, that takes part in arithmetic and in numpy's functions."""

    __slots__ = ("__weakref__", "base", "graph", "im", "re")

    def __init__(self, graph: Graph, re: Node, im: Node | None = None) -> None:
        self.graph, self.re, self.im = graph, re, im
        self.base: Quantity | None = None  # of which it is a view, were these numpy's arrays

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

    # Every exit to Python notes what is seen, or says that it is not recorded.

    def seen(self, rows: bool = False) -> Values:
        """Numbers for Python to look at; a guard tells while they are the same."""
        for node in self.parts:
            self.graph.see(self.graph.same(node), rows)
        return self.value

    def __bool__(self) -> bool:
        if self.im is not None or self.size != 1:
            raise NotRecorded("the truth of a complex number" if self.size == 1 else "the truth of several numbers")
        true = self.re if self.re.value.dtype == bool else self.graph.fold("ne", self.re, self.graph.constant(0))
        now = bool(true.value.reshape(()))
        self.graph.see(true if now else self.graph.fold("not", true))
        return now

    def __index__(self) -> int:
        if self.im is not None or self.size != 1 or not float(self.re.value.reshape(())).is_integer():
            raise TypeError(f"{self.value} is not a whole number")
        return int(self.seen().reshape(()))

    def __int__(self) -> int:
        whole: Quantity = trunc(self)
        return whole.__index__()

    def __round__(self, digits: int | None = None) -> Any:
        return rounded(self, digits or 0)

    def __format__(self, spec: str) -> str:
        value = self.seen()
        return (value.item() if value.size == 1 else value).__format__(spec)

    def __str__(self) -> str:
        return self.__format__("")

    def __repr__(self) -> str:
        return "a recorded quantity"

    def __hash__(self) -> int:
        value = self.seen()
        return hash(value.item() if value.size == 1 else value.tobytes())

    def __float__(self) -> float:
        raise NotRecorded("a number taken out of a quantity")

    def __complex__(self) -> complex:
        raise NotRecorded("a number taken out of a quantity")

    def __array__(self, *_: Any, **__: Any) -> Any:
        raise NotRecorded("an array made of a quantity")

    def tolist(self) -> Any:
        return list(self) if self.ndim else self

    def item(self, *index: Any) -> "Quantity":
        return self[index] if index else self.reshape(())

    def take(self, index: Values) -> "Quantity":
        """Elements by their flat positions, in the shape of ``index``."""
        shape = self.shape
        return self.each(lambda node: self.graph.take(self._whole(node, shape), np.asarray(index, order="C")))

    def rearranged(self, f: Callable[[Values], Values]) -> "Quantity":
        """What a function that only moves elements makes of it: what it does with their positions."""
        order = np.arange(self.size).reshape(self.shape)
        moved = f(order)
        result = self.take(moved)
        if np.ndim(moved) and owner(moved) is owner(order):
            result.base = self
        return result

    def __copy__(self) -> "Quantity":
        return Quantity(self.graph, self.re, self.im)

    def __deepcopy__(self, _: Any) -> "Quantity":
        return self.__copy__()

    def __reduce_ex__(self, _: Any) -> Any:
        raise NotRecorded("a quantity written as bytes")

    def broadcast(self, shape: tuple[int, ...]) -> "Quantity":
        return self.each(lambda node: self._whole(node, shape))

    def __getitem__(self, key: Any) -> "Quantity":
        first, *rest = key if isinstance(key, tuple) and key else (key,)
        if isinstance(first, Quantity) and first.re.value.dtype != bool and first.im is None and self.ndim:
            return self._at(first)[(slice(None),) * first.ndim + tuple(rest)] if rest else self._at(first)
        return self.rearranged(lambda order: order[plain(key)])

    def _at(self, position: "Quantity") -> "Quantity":
        """Elements along the first axis by positions that are quantities; NaN where there are none."""
        count, inner = self.shape[0], self.shape[1:]
        start = choice(self.graph, position < 0, position + count, position)
        if not inner:
            return self.each(lambda node: self.graph.at(self._whole(node, self.shape), start.re))
        rest = np.arange(int(np.prod(inner))).reshape(inner)
        inside = (start >= 0) & (start < count)
        flat = choice(self.graph, inside, start, np.nan)[(..., *(None,) * len(inner))] * rest.size + rest
        return self.each(lambda node: self.graph.at(self._whole(node, self.shape), flat.re))

    @property
    def T(self) -> "Quantity":
        """Transposed."""
        return self.rearranged(np.transpose)

    def astype(self, kind: Any, **_: Any) -> "Quantity":
        if (dtype := np.dtype(kind)).kind in "fc" and np.finfo(dtype).precision < 15:
            raise NotRecorded(f"numbers of the kind {dtype}")
        kind = dtype.kind
        return trunc(self) if kind in "iu" else self != 0 if kind == "b" else self.__copy__()

    def reshape(self, *shape: Any) -> "Quantity":
        return self.rearranged(lambda order: order.reshape(*shape))

    def reduced(self, kind: str, axis: Any = None, keepdims: bool = False) -> "Quantity":
        """What a kind of reduction says of a real quantity, along one or several axes or of all elements."""
        if self.im is not None and kind in ("any", "all"):
            nonzero: Quantity = self != 0
            return nonzero.reduced(kind, axis, keepdims)
        if self.im is not None and kind not in ("sum", "nansum"):
            raise NotRecorded(f"{kind} of complex numbers")
        if isinstance(axis, tuple):
            result = self
            for one in sorted((int(a) % self.ndim for a in axis), reverse=True):
                result = result.reduced(kind, one, keepdims)
            return result
        axis = None if axis is None else int(plain(axis)) % max(self.ndim, 1)
        return self.each(lambda node: self.graph.reduce(kind, node, axis, keepdims))

    def __getattr__(self, name: str) -> Any:
        """Methods of arrays, as numpy's functions of the same name."""
        function = FUNCTIONS.get(getattr(np, name, None)) if name in METHODS else None
        if function is None:
            raise AttributeError(f"{name} of a recorded quantity")
        return lambda *args, **kwargs: function(self.graph, self, *args, **kwargs)

    def each(self, f: Callable[[Node], Node]) -> "Quantity":
        """The same for the real and the imaginary part."""
        return Quantity(self.graph, f(self.re), None if self.im is None else f(self.im))

    def _whole(self, node: Node, shape: tuple[int, ...]) -> Node:
        if node.shape == shape:
            return node
        index = np.broadcast_to(np.arange(node.size).reshape(node.shape), shape)
        return self.graph.take(node, np.ascontiguousarray(index))

    def __array_ufunc__(self, ufunc: Any, method: str, *inputs: Any, **kwargs: Any) -> Any:
        if method in ("reduce", "accumulate") and ufunc in REDUCTIONS:
            return FUNCTIONS[ufunc, method](self.graph, *inputs, **kwargs)
        if not np.ndim(inputs[0]) and len(kwargs.get("out", ())) == 1 and kwargs["out"][0] is inputs[0]:
            kwargs.pop("out")  # of x += y, which binds a number anew
        operation = UFUNCS.get(ufunc)
        if operation is None or method != "__call__" or kwargs:
            given = f" with {', '.join(kwargs)}" if kwargs else ""
            raise NotRecorded((f"{ufunc.__name__}.{method}" if method != "__call__" else ufunc.__name__) + given)
        return operation(*[lift(self.graph, x) for x in inputs])

    def __array_function__(self, func: Any, types: Any, args: Any, kwargs: Any) -> Any:
        operation = FUNCTIONS.get(func)
        if operation is None:
            raise NotRecorded(f"numpy's {func.__name__}")
        return operation(self.graph, *args, **kwargs)


def is_literal(value: Quantity) -> bool:
    """Whether a real number, or an array of them, without a unit."""
    return value.im is None and value.re.op == "constant" and not value.re.args


def owner(array: Any) -> Any:
    """The array whose elements an array shows."""
    while isinstance(base := getattr(array, "base", None), np.ndarray | Quantity):
        array = base
    return array


def plain(value: Any) -> Any:
    """A value without quantities, for Python to look at; guards tell while it is the same."""
    if isinstance(value, Quantity):
        return value.seen() if value.ndim or value.re.value.dtype == bool else value.__index__()
    if isinstance(value, list | tuple):
        return type(value)(plain(v) for v in value)
    if isinstance(value, slice):
        return slice(*(plain(v) for v in (value.start, value.stop, value.step)))
    return value


def moved(x: "Quantity", source: Any, destination: Any) -> "Quantity":
    """numpy's moveaxis."""
    return x.rearranged(lambda order: np.moveaxis(order, source, destination))


def quantities(value: Any) -> Iterator[Quantity]:
    """Quantities in a value, in lists, dictionaries and the fields of dataclasses."""
    if isinstance(value, Quantity):
        yield value
    elif isinstance(value, list | tuple):
        for part in value:
            yield from quantities(part)
    elif isinstance(value, dict):
        yield from quantities(list(value.values()))
    elif hasattr(value, "__dataclass_fields__"):
        yield from quantities(list(vars(value).values()))


def has_quantity(value: Any) -> bool:
    return next(quantities(value), None) is not None


def lift(graph: Graph, value: Any) -> Quantity:
    """A number, an array or a list as a quantity of this recording."""
    if isinstance(value, Quantity):
        return value
    if isinstance(value, list | tuple) and has_quantity(value):
        return stack([lift(graph, v) for v in value])
    if isinstance(value, Constant):
        return Quantity(graph, graph.constant(float(value), value.unit))
    array = np.asarray(value)
    if array.dtype.kind == "c":
        return Quantity(graph, graph.constant(array.real), graph.constant(array.imag))
    if array.dtype.kind not in "biuf":
        raise NotRecorded(f"values of the kind {array.dtype}")
    return Quantity(graph, graph.constant(array))


def stack(parts: Sequence[Quantity]) -> Quantity:
    """Quantities along a new first axis."""
    shape = np.broadcast_shapes(*(p.shape for p in parts))
    whole = [p.broadcast(shape) for p in parts]
    return joined(whole, np.arange(len(whole) * whole[0].size).reshape(len(whole), *shape))


def joined(parts: Sequence[Quantity], where: Values) -> Quantity:
    """Elements of several quantities, which ``where`` numbers one after the other."""
    graph = parts[0].graph
    whole = [p.broadcast(p.shape) for p in parts]
    re = graph.join([p.re for p in whole], where)
    if all(p.im is None for p in whole):
        return Quantity(graph, re)
    im = [graph.constant(np.zeros(p.shape)) if p.im is None else p.im for p in whole]
    return Quantity(graph, re, graph.join(im, where))


def imaginary(x: Quantity) -> Node:
    """The imaginary part; 0 of a real quantity."""
    return x.im if x.im is not None else x.graph.constant(0.0)


def _whole_shape(f: Callable[[Quantity, Quantity], Quantity]) -> Callable[[Quantity, Quantity], Quantity]:
    """Arithmetic whose result has all elements also where a zero or one of the other operand leaves nothing to do."""

    def operation(x: Quantity, y: Quantity) -> Quantity:
        result, shape = f(x, y), np.broadcast_shapes(x.shape, y.shape)
        return result if result.shape == shape else result.broadcast(shape)

    return operation


@_whole_shape
def add(x: Quantity, y: Quantity) -> Quantity:
    graph = x.graph
    if x.im is None and y.im is None:
        return Quantity(graph, graph.add(x.re, y.re))
    return Quantity(graph, graph.add(x.re, y.re), graph.add(imaginary(x), imaginary(y)))


@_whole_shape
def subtract(x: Quantity, y: Quantity) -> Quantity:
    graph = x.graph
    if x.im is None and y.im is None:
        return Quantity(graph, graph.sub(x.re, y.re))
    return Quantity(graph, graph.sub(x.re, y.re), graph.sub(imaginary(x), imaginary(y)))


@_whole_shape
def multiply(x: Quantity, y: Quantity) -> Quantity:
    graph = x.graph
    if x.im is None and y.im is None:
        return Quantity(graph, graph.mul(x.re, y.re))
    a, b, c, d = x.re, imaginary(x), y.re, imaginary(y)
    return Quantity(graph, graph.sub(graph.mul(a, c), graph.mul(b, d)), graph.add(graph.mul(a, d), graph.mul(b, c)))


@_whole_shape
def divide(x: Quantity, y: Quantity) -> Quantity:
    graph = x.graph
    if y.im is None:
        return x.each(lambda part: graph.div(part, y.re))
    return divide(multiply(x, conjugate(y)), square(y))


def square(x: Quantity) -> Quantity:
    graph = x.graph
    two = graph.constant(2)
    re = graph.fold("pow", x.re, two)
    return Quantity(graph, re if x.im is None or is_number(x.im, 0) else graph.add(re, graph.fold("pow", x.im, two)))


def power(x: Quantity, y: Quantity) -> Quantity:
    graph = x.graph
    if y.im is not None:
        raise NotRecorded("a complex power")
    if x.im is None:
        return x if is_number(y.re, 1) else Quantity(graph, graph.fold("pow", x.re, y.re))
    if is_number(y.re, 2):
        return multiply(x, x)
    turned = multiply(angle(x), y)
    return multiply(power(absolute(x), y), polar(turned))


def angle(x: Quantity) -> Quantity:
    return Quantity(x.graph, x.graph.fold("atan2", imaginary(x), x.re))


def polar(phi: Quantity) -> Quantity:
    """The unit vector at an angle."""
    return Quantity(phi.graph, phi.graph.fold("cos", phi.re), phi.graph.fold("sin", phi.re))


def floor_divide(x: Quantity, y: Quantity) -> Any:
    """Whole quotients as numpy has them: what `mod` leaves is taken away first."""
    return elementwise("round")((x - x % y) / y)


def trunc(x: Quantity) -> Any:
    down = elementwise("floor")
    return choice(x.graph, x < 0, -down(-x), down(x))


def rounded(x: Quantity, decimals: int) -> Any:
    """Rounded to decimals, halves to the even neighbour."""
    scale = 10.0**decimals
    return elementwise("round")(x * scale) / scale if decimals else elementwise("round")(x)


def conjugate(x: Quantity) -> Quantity:
    return x if x.im is None else Quantity(x.graph, x.re, x.graph.neg(x.im))


def absolute(x: Quantity) -> Quantity:
    if x.im is None or is_number(x.im, 0):
        return Quantity(x.graph, x.graph.fold("abs", x.re))
    if is_number(x.re, 0):
        return Quantity(x.graph, x.graph.fold("abs", x.im))
    return Quantity(x.graph, x.graph.fold("sqrt", square(x).re))


@cache
def elementwise(op: str) -> Callable[..., Quantity]:
    """An operation of the graph on real quantities."""

    def operation(*args: Quantity) -> Quantity:
        if any(a.im is not None for a in args):
            raise NotRecorded(f"{op} of complex numbers")
        return Quantity(args[0].graph, args[0].graph.fold(op, *[a.re for a in args]))

    return operation


def choice(graph: Graph, condition: Any, x: Any, y: Any) -> Any:
    """Elements of ``x`` where the condition holds, else of ``y``; of texts those that hold now."""
    if any(np.asarray(v).dtype.kind == "U" for v in (x, y) if not isinstance(v, Quantity | list | tuple)):
        texts: Any = np.where(plain(condition), x, y)
        return texts
    c, a, b = lift(graph, condition), lift(graph, x), lift(graph, y)
    if a.im is None and b.im is None:
        return Quantity(graph, graph.fold("where", c.re, a.re, b.re))
    return Quantity(graph, graph.fold("where", c.re, a.re, b.re), graph.fold("where", c.re, imaginary(a), imaginary(b)))
