"""Quantities that compute as numbers do and remember how: real and imaginary parts apart, each a node of the graph.

A cell of a worksheet is run with quantities of this kind in place of its numbers, so that the same line of source also
gives the formula of a cell. What numpy's functions make of them is registered by `numpy_rules`.
"""

import math
from collections.abc import Callable, Iterator, Sequence
from functools import reduce
from math import prod
from operator import getitem, mul
from operator import index as operator_index
from typing import Any

import numpy as np

from mechsheet.quantities.graph import Graph, Label, NotRecorded
from mechsheet.quantities.node import Node
from mechsheet.quantities.operations import OF_TRUTH, Moved, Values, is_double, regrouped
from mechsheet.quantities.repeated import Operators
from mechsheet.units import UNKNOWN, Constant
from mechsheet.worksheet import numbers

UFUNCS: dict[Any, Callable[..., "Quantity"]] = {}  # of quantities
FUNCTIONS: dict[Any, Callable[..., Any]] = {}  # of the graph and whatever numpy's function takes
REDUCTIONS: dict[Any, str] = {}  # kinds that the reduce and accumulate of a ufunc stand for
NOTED: dict[Any, Callable[..., None]] = {}  # what else is noted wherever a ufunc is called
METHODS = frozenset({
    "all", "any", "argmax", "argmin", "argsort", "clip", "copy", "cumprod", "cumsum", "diagonal", "dot",
    "max", "mean", "min", "nonzero", "prod", "ptp", "ravel", "repeat", "round", "searchsorted", "sort", "squeeze",
    "std", "sum", "swapaxes", "take", "trace", "transpose", "var",
})  # fmt: skip


class Quantity(Operators):
    """A quantity of a worksheet, real or complex, that takes part in arithmetic and in numpy's functions."""

    __slots__ = ("__weakref__", "base", "graph", "im", "places", "re", "ways")  # the last of one of several alone
    places: Any  # flat, of its elements in the base; ... where these are all of them

    def __init__(self, graph: Graph, re: Node, im: Node | None = None, *, base: Any = None) -> None:
        self.graph, self.re, self.im = graph, re, im
        self.base: Quantity | Values | None = base  # of which it is a view, were these numpy's arrays

    @property
    def value(self) -> Values:
        if self.im is None:
            return self.re.value
        parts = np.broadcast_arrays(self.re.value, self.im.value)
        value = np.empty(parts[0].shape, complex)  # a sum with 1j times an infinite number has no real part
        value.real, value.imag = parts
        return value

    @property
    def parts(self) -> Iterator[Node]:
        yield self.re
        if self.im is not None:
            yield self.im

    @property
    def nodes(self) -> list[Node]:
        """What it rests on."""
        return list(self.parts)

    @property
    def extent(self) -> tuple[int, ...]:
        """The shape with the present numbers of rows."""
        if self.im is None or self.re.shape == self.im.shape:
            return self.re.shape
        return np.broadcast_shapes(self.re.shape, self.im.shape)

    @property
    def shape(self) -> tuple[Any, ...]:
        """Lengths of the axes, those that follow a number of rows as quantities."""
        return tuple(self.count(axis) for axis in range(self.ndim))

    @property
    def ndim(self) -> int:
        return len(self.extent)

    @property
    def size(self) -> Any:
        if type(self) is Quantity:
            self.graph.ask_rows(self.re)
        return self.count()

    @property
    def single(self) -> bool:
        """Whether one number, whatever the number of rows is."""
        return not any(part.stretches for part in self.parts) and prod(self.extent) == 1

    def count(self, axis: Any = None) -> Any:
        """How many elements there are along one or several axes, or in all."""
        axes = range(self.ndim) if axis is None else axis if isinstance(axis, tuple) else (axis,)
        return reduce(mul, (self._length(k % self.ndim - self.ndim) for k in axes), 1)

    def _length(self, axis: int) -> Any:
        for part in self.parts:
            if part.stretches and len(part.shape) >= -axis and part.shape[axis] == self.extent[axis]:
                return Quantity(self.graph, self.graph.length(part, axis))
        return self.extent[axis]

    @property
    def dtype(self) -> np.dtype[Any]:
        return self.value.dtype

    @property
    def real(self) -> "Quantity":
        return Quantity(self.graph, self.whole().re, base=self)

    @property
    def imag(self) -> "Quantity":
        return Quantity(self.graph, self.whole().im or self.graph.like(self.graph.constant(0.0), self.re), base=self)

    def called(self, symbol: str, unit: str, meaning: str) -> "Quantity":
        """Name a step of a calculation: it gets a cell of its own."""
        for node, axis in zip(self.parts, ("x", "y") if self.im else ("",), strict=False):
            if node.op not in ("constant", "input"):
                self.graph.labels.setdefault(node, Label(symbol + axis, unit, meaning))
        return self

    def __len__(self) -> int:
        return operator_index(self.count(0))

    def __iter__(self) -> Iterator["Quantity"]:
        return (self[i] for i in range(len(self)))

    # Every exit to Python notes what is seen, or says that it is not recorded.

    def seen(self, rows: bool = False) -> Values:
        """Numbers for Python to look at; a guard tells while they are the same."""
        for node in self.parts:
            self.graph.measure(node)
            self.graph.see(self.graph.same(node), rows)
        return self.value

    def __bool__(self) -> bool:
        single = prod(self.extent) == 1
        if self.im is not None or not single:
            raise NotRecorded("the truth of a complex number" if single else "the truth of several numbers")
        self.graph.measure(self.re)
        true = self.re if self.re.value.dtype == bool else self.graph.fold("ne", self.re, self.graph.constant(0))
        now = bool(true.value.reshape(()))
        self.graph.see(true if now else self.graph.fold("not", true))
        return now

    def __index__(self) -> int:
        if self.im is not None or prod(self.extent) != 1 or not float(self.re.value.reshape(())).is_integer():
            raise TypeError(f"{self.value} is not a whole number")
        return int(self.seen().reshape(()))

    def __int__(self) -> int:
        return operator_index(np.trunc(self))

    def __round__(self, digits: int | None = None) -> Any:
        """Python's round, which knows on which side of a half in decimals the binary number is: numpy's does not."""
        if digits and digits > 0:
            size = abs(self) * 10.0**digits
            if not abs(size - np.floor(size) - 0.5) > numbers.ROUNDING * np.maximum(size, 1):
                raise NotRecorded("which way a half is rounded")
        rounded: Any = np.round(self, digits or 0)
        self.graph.whole.update([rounded.re] if digits is None else ())
        return rounded

    def __format__(self, spec: str) -> str:
        """Its text, for Python to look at; of a number the same while nothing but rounding changes it."""
        value = self.value.item() if self.value.size == 1 else self.value
        value = int(value) if spec.endswith("d") and isinstance(value, float) else value  # a whole number to Python
        text: str = value.__format__(spec)
        off = abs(value) * numbers.ROUNDING if isinstance(value, float) else 0.0
        if 0 < off < math.inf and all(x.__format__(spec) == text for x in (value - off, value + off)):
            self.graph.measure(self.re)
            near, least = (Quantity(self.graph, self.graph.constant(x, UNKNOWN)) for x in (value, off))
            self.graph.see((abs(self - near) <= least).re)
        else:
            self.seen()
        return text

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

    def rearranged(self, f: Callable[..., Values], *args: Any, **kwargs: Any) -> "Quantity":
        """What a function that only moves elements makes of it: what it does with their positions."""
        order, moved = np.arange(prod(self.extent)).reshape(self.extent), Moved(f, args, tuple(kwargs.items()))
        position = moved(order)
        index = np.asarray(position, order="C")
        result = self.whole().each(lambda node: self.graph.take(node, index, moved))
        if np.ndim(position) and owner(position) is owner(order):
            result.base, result.places = self, moved.shown(index, alone=self.base is None and self.ndim == 1)
        return result

    def whole(self) -> "Quantity":
        """With both parts in the shape of the whole."""
        return self if self.im is None else self.like(self)

    def like(self, *others: "Quantity") -> "Quantity":
        """In the shape that it has together with others."""
        parts = [part for other in others for part in other.parts]
        return self.each(lambda node: self.graph.like(node, *(p for p in parts if p is not node)))

    def __copy__(self) -> "Quantity":
        return Quantity(self.graph, self.re, self.im)

    def __deepcopy__(self, _: Any) -> "Quantity":
        return self.__copy__()

    def __reduce_ex__(self, _: Any) -> Any:
        raise NotRecorded("a quantity written as bytes")

    def broadcast(self, shape: tuple[int, ...]) -> "Quantity":
        return self if self.single and not shape else self.rearranged(np.broadcast_to, shape)

    def __getitem__(self, key: Any) -> "Quantity":
        some: Quantity | None = FUNCTIONS[np.ndarray.__getitem__](self.graph, self, key)
        if some is not None:
            return some
        first, *rest = key if isinstance(key, tuple) and key else (key,)
        if isinstance(first, Quantity) and first.re.value.dtype != bool and first.im is None and self.ndim:
            return self._at(first)[(slice(None),) * first.ndim + tuple(rest)] if rest else self._at(first)
        places = [k for k in rest if not isinstance(k, int | slice | None)]
        if isinstance(first, int | slice) and places and all(isinstance(k, Quantity) and not k.ndim for k in places):
            part, beside = self[first], tuple(rest)
            return part[beside] if isinstance(first, int) else moved(moved(part, 0, -1)[beside], -1, 0)
        return self.rearranged(getitem, plain(key))

    def _at(self, position: "Quantity") -> "Quantity":
        """Elements along the first axis by positions that are quantities; NaN where there are none."""
        count, *inner = self.shape
        start: Any = np.where(position < 0, position + count, position)
        if not inner:
            return self.whole().each(lambda node: self.graph.at(node, start.re))
        sizes = [operator_index(size) for size in inner]
        rest = np.arange(prod(sizes)).reshape(sizes)
        flat: Any = np.where((start >= 0) & (start < count), start, np.nan)[(..., *(None,) * len(inner))] * rest.size
        rows = self.whole().each(lambda node: self.graph.at(node, (flat + rest).re))
        rows.base = None if position.ndim else self
        return rows

    @property
    def T(self) -> "Quantity":
        return self.rearranged(np.transpose)

    def conjugate(self) -> "Quantity":
        return UFUNCS[np.conjugate](self)

    conj = conjugate

    def flatten(self, *order: Any) -> "Quantity":
        return self.rearranged(np.ravel, *order).__copy__()

    def astype(self, kind: Any, copy: Any = True, **_: Any) -> "Quantity":
        if not copy and self.dtype == kind:
            return self
        if not is_double(dtype := np.dtype(kind)):
            raise NotRecorded(f"numbers of the kind {dtype}")
        kind = dtype.kind
        if kind in "iufc" and self.dtype == bool:
            number: Quantity = FUNCTIONS[np.where](self.graph, self, 1, 0)
            return number.astype(dtype)
        if kind in "iu":
            whole: Quantity = lift(self.graph, self.value.astype(int)) if is_literal(self) else UFUNCS[np.trunc](self)
            self.graph.whole.add(whole.re)
            return whole
        other: Quantity = self != 0 if kind == "b" else self * 1.0
        return other

    def reshape(self, *shape: Any) -> "Quantity":
        return self.rearranged(np.reshape, plain(shape[0] if len(shape) == 1 else shape))

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
        return self.whole().each(lambda node: self.graph.reduce(kind, node, axis, keepdims))

    def __getattr__(self, name: str) -> Any:
        """Methods of arrays, as numpy's functions of the same name."""
        function = FUNCTIONS.get(getattr(np, name, None)) if name in METHODS else None
        if function is None:
            raise AttributeError(f"{name} of a recorded quantity")
        return lambda *args, **kwargs: function(self.graph, self, *args, **kwargs)

    def each(self, f: Callable[[Node], Node]) -> "Quantity":
        """The same for the real and the imaginary part."""
        return Quantity(self.graph, f(self.re), None if self.im is None else f(self.im))

    def __array_ufunc__(self, ufunc: Any, method: str, *inputs: Any, **kwargs: Any) -> Any:
        if method in ("reduce", "accumulate") and ufunc in REDUCTIONS:
            return FUNCTIONS[ufunc, method](self.graph, *inputs, **kwargs)
        if kwargs and len(kwargs.get("out", ())) == 1 and kwargs["out"][0] is inputs[0] and not np.ndim(inputs[0]):
            kwargs.pop("out")  # of x += y, which binds a number anew
        operation = UFUNCS.get(ufunc)
        if operation and method == "outer" and not kwargs:
            x, y = (lift(self.graph, each) for each in inputs)
            return operation(x[(..., *(None,) * y.ndim)], y)
        if operation is None or method != "__call__" or kwargs:
            given = f" with {', '.join(kwargs)}" if kwargs else ""
            raise NotRecorded((f"{ufunc.__name__}.{method}" if method != "__call__" else ufunc.__name__) + given)
        operands = [x if type(x) is Quantity else lift(self.graph, x) for x in inputs]
        if ufunc.signature or ufunc.nout > 1:
            return operation(*operands)
        self.graph.go_together(*(part for x in operands for part in x.parts), hidden=ufunc in OF_TRUTH)
        if ufunc in NOTED:
            NOTED[ufunc](*operands)
        key = ufunc, *[(x.re, x.im) for x in operands]
        known = self.graph.called.get(key)
        if known is None:
            known = self.graph.called[key] = operation(*operands)
        return known.__copy__()

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
        return regrouped(value, map(plain, value))
    if isinstance(value, slice):
        return slice(*(plain(v) for v in (value.start, value.stop, value.step)))
    return value


def moved(x: "Quantity", source: Any, destination: Any) -> "Quantity":
    """numpy's moveaxis."""
    return x.rearranged(np.moveaxis, source, destination)


class Listed(list[Any]):
    """A list with an element for each row."""

    def column(self) -> Quantity | None:
        """Its elements as one quantity; None where they are no numbers, or Python looks at each."""
        raise NotImplementedError


def quantities(value: Any) -> Iterator[Quantity]:
    """Quantities in a value, in lists, dictionaries and the fields of dataclasses."""
    if isinstance(value, Listed) and (column := value.column()) is not None:
        value = column
    if isinstance(value, Quantity):
        yield value
    elif isinstance(value, list | tuple):
        for part in value:
            yield from quantities(part)
    elif isinstance(value, dict):
        yield from quantities(list(value.values()))
    elif not isinstance(value, Node) and (fields := getattr(value, "__dataclass_fields__", None)):
        yield from quantities([getattr(value, name, 0) for name in getattr(value, "__dict__", fields)])


def has_quantity(value: Any) -> bool:
    return next(quantities(value), None) is not None


def is_any_length(value: Any) -> bool:
    """Whether a list that readers take for any number of its rows, as a page in one file does."""
    return isinstance(value, Quantity) and value.graph.draws and value.ndim == 1 and value.re.stretches


_LONGEST = np.iinfo(np.int64).max  # whole number of an array; those of Python have no end


def lift(graph: Graph, value: Any) -> Quantity:
    """A number, an array or a list as a quantity of this recording."""
    if isinstance(value, Quantity):
        return value
    if isinstance(value, Listed) and (column := value.column()) is not None:
        return column
    if isinstance(value, list | tuple) and has_quantity(value):
        return stack([lift(graph, v) for v in value])
    if isinstance(value, Constant):
        return Quantity(graph, graph.constant(float(value), value.unit))
    array = np.asarray(float(value) if type(value) is int and abs(value) > _LONGEST else value)
    if not is_double(kind := array.dtype):
        raise NotRecorded(f"numbers of the kind {kind}" if kind.kind in "iufc" else "values that are no numbers")
    parts = map(graph.constant, (array.real, array.imag) if array.dtype.kind == "c" else (array,))
    return Quantity(graph, *parts, base=value if isinstance(value, np.ndarray) and value.ndim else None)


def stack(parts: Sequence[Quantity]) -> Quantity:
    """Quantities along a new first axis."""
    shapes = {
        id(part) if any(own.stretches for own in part.parts) else part.extent: part for part in parts if part.extent
    }
    stretching = (own for part in shapes.values() for own in part.parts if own.stretches)
    parts[0].graph.go_together(*stretching, strictly=True)
    return joined([part.like(*shapes.values()) for part in parts], np.stack)


def joined(parts: Sequence[Quantity], f: Callable[..., Values], *args: Any, **kwargs: Any) -> Quantity:
    """What a function that only puts elements together makes of several quantities."""
    graph, moved = parts[0].graph, Moved(f, args, tuple(kwargs.items()))
    starts = np.cumsum([0, *(prod(p.extent) for p in parts)])
    positions = [s + np.arange(prod(p.extent)).reshape(p.extent) for s, p in zip(starts, parts, strict=False)]
    where = np.ascontiguousarray(moved(positions))
    whole = [p.whole() for p in parts]
    re = graph.join([p.re for p in whole], where, moved)
    if all(p.im is None for p in whole):
        return Quantity(graph, re)
    im = [graph.like(graph.constant(0.0), p.re) if p.im is None else p.im for p in whole]
    return Quantity(graph, re, graph.join(im, where, moved))
