"""Quantities that record the operations done with them: the lines of a worksheet as spreadsheet formulas.

A cell of a worksheet is run with quantities of this kind in place of its numbers. They compute as numbers do and
remember how, real and imaginary parts apart, so that the same line of source also gives the formula of a cell.
"""

from collections.abc import Callable, Iterator, Sequence
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

Values = NDArray[Any]


class NotRecorded(Exception):
    """An operation that has no counterpart among the formulas of a spreadsheet."""


LEAVES = ("constant", "rows", "input", "found", "static")


class Node:
    """One real quantity of any shape: an operation on other quantities, with its values.

    ``name`` is that of the line that defines it, ``label`` (symbol, unit, meaning) that of a step inside a library
    function. ``home`` is where it stands in the workbook.
    """

    __slots__ = ("args", "home", "label", "name", "op", "section", "source", "uses", "value")

    def __init__(self, op: str, args: tuple[Any, ...], value: Values) -> None:
        self.op, self.args, self.value = op, args, value
        self.name, self.section, self.source, self.uses = "", "", None, 0
        self.label: tuple[str, str, str] | None = None
        self.home: Any = None

    @property
    def operands(self) -> tuple["Node", ...]:
        if self.op in LEAVES:
            return ()
        return self.args[0] if self.op == "join" else self.args[:1] if self.op in ("pick", "reduce") else self.args


class Recorder:
    """All nodes of one recording; equal operations on equal operands are one node.

    With ``thin`` only every so many of the numbers that ``linspace`` gives are taken: what a worksheet computes from
    position to position it then computes for the positions that its tables list.

    ``guards`` are the conditions that the Python code looked at, with what it saw: where one of them changes,
    the recorded formulas are no longer those of the worksheet.
    """

    def __init__(self, thin: int = 1) -> None:
        self.thin = thin
        self.nodes: dict[Any, Node] = {}
        self.guards: list[tuple[Node, Any]] = []

    def node(self, op: str, *args: Any) -> Node:
        key = (op, *[id(a) for a in args])
        known = self.nodes.get(key)
        if known is None:
            with np.errstate(all="ignore"):
                value = _COMPUTE[op](*[a.value for a in args])
            known = self.nodes[key] = Node(op, args, value)
        return known

    def constant(self, value: Any) -> Node:
        array = np.asarray(value)
        key = ("constant", array.dtype.char, array.shape, array.tobytes())
        known = self.nodes.get(key)
        if known is None:
            known = self.nodes[key] = Node("constant", (), array)
        return known

    def leaf(self, op: str, name: str, value: Any) -> Node:
        """An input, a found value or an array of numbers that nothing is known about."""
        node = self.nodes[op, name] = Node(op, (), np.asarray(value))
        return node

    def rows(self, count: int) -> "Recorded":
        """The numbers 0, 1, 2 .. of the rows."""
        key = ("rows", count)
        if key not in self.nodes:
            self.nodes[key] = Node("rows", (), np.arange(count))
        return Recorded(self, self.nodes[key])

    def pick(self, source: Node, index: Values) -> Node:
        """Elements of a quantity by their flat positions."""
        if source.op in ("constant", "rows"):
            return self.constant(source.value.reshape(-1)[index])
        if source.value.size == 1 and index.shape == ():
            return source
        key = ("pick", id(source), index.shape, index.tobytes())
        known = self.nodes.get(key)
        if known is None:
            known = self.nodes[key] = Node("pick", (source, index), source.value.reshape(-1)[index])
        return known

    def join(self, sources: Sequence[Node], axis: int | None) -> Node:
        """Elements of several quantities as one; a new first axis where ``axis`` is None."""
        shapes = [s.value.shape for s in sources]
        which = [np.full(shape, n) for n, shape in enumerate(shapes)]
        index = [np.arange(s.value.size).reshape(shape) for s, shape in zip(sources, shapes, strict=True)]
        values = [s.value for s in sources]
        if axis is None:
            values, which, index = (list(np.broadcast_arrays(*part)) for part in (values, which, index))
            join: Callable[..., Values] = np.stack
        else:
            join = np.concatenate
        at = axis or 0
        args = tuple(sources), join(which, axis=at), join(index, axis=at)
        return Node("join", args, join(values, axis=at))

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
        if source.value.size == 1:
            return self.pick(source, np.zeros(np.shape(value), int))
        flat = np.arange(source.value.size).reshape(source.value.shape)
        groups = flat.reshape(1, -1) if axis is None else np.moveaxis(flat, axis, -1).reshape(-1, flat.shape[axis])
        key = ("reduce", id(source), kind, axis, keepdims)
        known = self.nodes.get(key)
        if known is None:
            known = self.nodes[key] = Node("reduce", (source, groups, kind), np.asarray(value))
        return known

    def lift(self, value: Any) -> "Recorded":
        """A number, an array or a list as a quantity of this recording."""
        if isinstance(value, Recorded):
            return value
        if isinstance(value, list | tuple) and any(_has_recorded(v) for v in value):
            return self.stack([self.lift(v) for v in value])
        array = np.asarray(value)
        if array.dtype.kind == "c":
            return Recorded(self, self.constant(array.real.copy()), self.constant(array.imag.copy()))
        if array.dtype.kind not in "biuf":
            raise NotRecorded(f"values of the kind {array.dtype}")
        return Recorded(self, self.constant(array))

    def stack(self, parts: Sequence["Recorded"], axis: int | None = None) -> "Recorded":
        re = self.join([p.re for p in parts], axis)
        if all(p.im is None for p in parts):
            return Recorded(self, re)
        zeros = [p.im or self.constant(np.zeros(p.shape)) for p in parts]
        return Recorded(self, re, self.join(zeros, axis))

    # The operations below leave out what adds nothing: a reader looks for none of it.

    def add(self, a: Node, b: Node) -> Node:
        if _is(a, 0):
            return b
        if _is(b, 0):
            return a
        if b.op == "neg":
            return self.sub(a, b.args[0])
        return self.fold("+", a, b)

    def sub(self, a: Node, b: Node) -> Node:
        if _is(b, 0):
            return a
        if _is(a, 0):
            return self.neg(b)
        return self.add(a, b.args[0]) if b.op == "neg" else self.fold("-", a, b)

    def neg(self, a: Node) -> Node:
        return a.args[0] if a.op == "neg" else self.fold("neg", a)

    def mul(self, a: Node, b: Node) -> Node:
        for x, y in ((a, b), (b, a)):
            if _is(x, 0):
                return x
            if _is(x, 1):
                return y
            if _is(x, -1):
                return self.neg(y)
            if x.op == "neg":
                return self.neg(self.mul(x.args[0], y))
        return self.fold("*", a, b)

    def div(self, a: Node, b: Node) -> Node:
        if _is(b, 1) or _is(a, 0):
            return a
        return self.neg(self.div(a.args[0], b)) if a.op == "neg" else self.fold("/", a, b)

    def fold(self, op: str, *args: Node) -> Node:
        if all(a.op == "constant" for a in args):
            with np.errstate(all="ignore"):
                return self.constant(_COMPUTE[op](*[a.value for a in args]))
        return self.node(op, *args)


class Recorded:
    """A quantity of a worksheet, real or complex, that takes part in arithmetic and in numpy's functions."""

    __slots__ = ("im", "re", "recorder")

    def __init__(self, recorder: Recorder, re: Node, im: Node | None = None) -> None:
        self.recorder, self.re, self.im = recorder, re, im

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
        return np.broadcast_shapes(*(p.value.shape for p in self.parts))

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
    def real(self) -> "Recorded":
        return Recorded(self.recorder, self.re)

    @property
    def imag(self) -> "Recorded":
        return Recorded(self.recorder, self.recorder.constant(0.0) if self.im is None else self.im)

    def called(self, symbol: str, unit: str, meaning: str) -> "Recorded":
        """Name a step of a calculation: it gets a cell of its own."""
        for node, axis in zip(self.parts, ("x", "y") if self.im else ("",), strict=False):
            if node.op not in ("constant", "input") and node.label is None:
                node.label = (symbol + axis, unit, meaning)
        return self

    def __len__(self) -> int:
        return self.shape[0]

    def __iter__(self) -> Iterator["Recorded"]:
        return (self[i] for i in range(len(self)))

    def __bool__(self) -> bool:
        seen = bool(self.value)
        if self.re.op != "constant":
            self.recorder.guards.append((self.re, seen))
        return seen

    def __index__(self) -> int:
        if self.re.op != "constant":
            self.recorder.guards.append((self.re, int(self.value)))
        return int(self.value)

    __int__ = __index__

    def __float__(self) -> float:
        raise NotRecorded("a number taken out of a quantity")

    def __getitem__(self, key: Any) -> "Recorded":
        shape = self.shape
        index = np.arange(self.size).reshape(shape)[key.value if isinstance(key, Recorded) else key]
        return self._map(lambda node: self.recorder.pick(self._whole(node, shape), np.asarray(index)))

    @property
    def T(self) -> "Recorded":
        """Transposed."""
        index = np.ascontiguousarray(np.arange(self.size).reshape(self.shape).T)
        return self._map(lambda node: self.recorder.pick(self._whole(node, self.shape), index))

    def argmax(self, axis: int = 0) -> "Recorded":
        """Position of the first true element along the first axis; 0 where none is."""
        if axis != 0 or self.re.value.dtype != bool:
            raise NotRecorded("the position of a greatest number")
        first: Any = 0.0
        for n in reversed(range(len(self))):
            first = _where(self.recorder, self[n], float(n), first)
        return self.recorder.lift(first)

    def reshape(self, *shape: Any) -> "Recorded":
        index = np.arange(self.size).reshape(*shape)
        return self._map(lambda node: self.recorder.pick(self._whole(node, self.shape), index))

    def sum(self, axis: int | None = None, keepdims: bool = False) -> "Recorded":
        return self._map(lambda node: self.recorder.reduce("SUM", node, axis, keepdims))

    def max(self, axis: int | None = None, keepdims: bool = False) -> "Recorded":
        return Recorded(self.recorder, self.recorder.reduce("MAX", self.re, axis, keepdims))

    def min(self, axis: int | None = None, keepdims: bool = False) -> "Recorded":
        return Recorded(self.recorder, self.recorder.reduce("MIN", self.re, axis, keepdims))

    def any(self, axis: int | None = None, keepdims: bool = False) -> "Recorded":
        return Recorded(self.recorder, self.recorder.reduce("OR", self.re, axis, keepdims))

    def all(self, axis: int | None = None, keepdims: bool = False) -> "Recorded":
        return Recorded(self.recorder, self.recorder.reduce("AND", self.re, axis, keepdims))

    def _map(self, f: Callable[[Node], Node]) -> "Recorded":
        return Recorded(self.recorder, f(self.re), None if self.im is None else f(self.im))

    def _whole(self, node: Node, shape: tuple[int, ...]) -> Node:
        if node.value.shape == shape:
            return node
        index = np.broadcast_to(np.arange(node.value.size).reshape(node.value.shape), shape)
        return self.recorder.pick(node, np.ascontiguousarray(index))

    def __array_ufunc__(self, ufunc: Any, method: str, *inputs: Any, **kwargs: Any) -> "Recorded":
        operation = _UFUNCS.get(ufunc)
        if operation is None or method != "__call__" or kwargs:
            raise NotRecorded(f"{ufunc.__name__}.{method}" if method != "__call__" else ufunc.__name__)
        return operation(*[self.recorder.lift(x) for x in inputs])

    def __array_function__(self, func: Any, types: Any, args: Any, kwargs: Any) -> Any:
        operation = _FUNCTIONS.get(func)
        if operation is None:
            raise NotRecorded(func.__name__)
        return operation(self.recorder, *args, **kwargs)

    def __add__(self, other: Any) -> "Recorded":
        return _add(self, self.recorder.lift(other))

    def __radd__(self, other: Any) -> "Recorded":
        return _add(self.recorder.lift(other), self)

    def __sub__(self, other: Any) -> "Recorded":
        return _subtract(self, self.recorder.lift(other))

    def __rsub__(self, other: Any) -> "Recorded":
        return _subtract(self.recorder.lift(other), self)

    def __mul__(self, other: Any) -> "Recorded":
        return _multiply(self, self.recorder.lift(other))

    def __rmul__(self, other: Any) -> "Recorded":
        return _multiply(self.recorder.lift(other), self)

    def __truediv__(self, other: Any) -> "Recorded":
        return _divide(self, self.recorder.lift(other))

    def __rtruediv__(self, other: Any) -> "Recorded":
        return _divide(self.recorder.lift(other), self)

    def __pow__(self, other: Any) -> "Recorded":
        return _power(self, self.recorder.lift(other))

    def __mod__(self, other: Any) -> "Recorded":
        return _real("MOD")(self, self.recorder.lift(other))

    def __neg__(self) -> "Recorded":
        return self._map(self.recorder.neg)

    def __pos__(self) -> "Recorded":
        return self

    def __abs__(self) -> "Recorded":
        return _absolute(self)

    def __invert__(self) -> "Recorded":
        return _real("NOT")(self)

    def __and__(self, other: Any) -> "Recorded":
        return _real("AND")(self, self.recorder.lift(other))

    def __or__(self, other: Any) -> "Recorded":
        return _real("OR")(self, self.recorder.lift(other))

    __rand__, __ror__ = __and__, __or__

    def __lt__(self, other: Any) -> "Recorded":
        return _real("<")(self, self.recorder.lift(other))

    def __le__(self, other: Any) -> "Recorded":
        return _real("<=")(self, self.recorder.lift(other))

    def __gt__(self, other: Any) -> "Recorded":
        return _real(">")(self, self.recorder.lift(other))

    def __ge__(self, other: Any) -> "Recorded":
        return _real(">=")(self, self.recorder.lift(other))

    def __eq__(self, other: object) -> "Recorded":  # type: ignore[override]
        return _real("=")(self, self.recorder.lift(other))

    def __ne__(self, other: object) -> "Recorded":  # type: ignore[override]
        return _real("<>")(self, self.recorder.lift(other))

    __hash__ = None  # type: ignore[assignment]


def _has_recorded(value: Any) -> bool:
    if isinstance(value, list | tuple):
        return any(_has_recorded(v) for v in value)
    return isinstance(value, Recorded)


def takes(f: Callable[..., Any], recorder: Recorder) -> Callable[..., Any]:
    """Function of numpy that also takes lists of recorded quantities."""

    def function(*args: Any, **kwargs: Any) -> Any:
        if f is np.array or f is np.asarray:
            return recorder.lift(args[0]) if _has_recorded(args[0]) else f(*args, **kwargs)
        if f is np.arange and not kwargs:
            ends = [int(a) for a in args]
            return recorder.rows(len(range(*ends))) * (ends[2] if ends[2:] else 1) + (ends[0] if ends[1:] else 0)
        if f is np.linspace and not kwargs:
            start, stop, count = args
            thin = recorder.thin if (int(count) - 1) % recorder.thin == 0 else 1
            return start + (stop - start) * (recorder.rows((int(count) - 1) // thin + 1) * thin / (count - 1))
        if f in (np.concatenate, np.stack):
            return f(*args, **kwargs) if not _has_recorded(args[0]) else _FUNCTIONS[f](recorder, *args, **kwargs)
        if isinstance(f, np.ufunc) and len(args) == 1 and isinstance(args[0], list) and _has_recorded(args[0]):
            return recorder.stack([f(recorder.lift(a)) for a in args[0]])
        return f(*[recorder.lift(a) if isinstance(a, list) and _has_recorded(a) else a for a in args], **kwargs)

    return function


def _is(node: Node, number: float) -> bool:
    return node.op == "constant" and node.value.shape == () and node.value == number


def _zero(x: Recorded) -> Node:
    return x.im if x.im is not None else x.recorder.constant(0.0)


def _pair(x: Recorded, re: Node, im: Node) -> Recorded:
    return Recorded(x.recorder, re, im)


def _add(x: Recorded, y: Recorded) -> Recorded:
    add = x.recorder.add
    if x.im is None and y.im is None:
        return Recorded(x.recorder, add(x.re, y.re))
    return _pair(x, add(x.re, y.re), add(_zero(x), _zero(y)))


def _subtract(x: Recorded, y: Recorded) -> Recorded:
    sub = x.recorder.sub
    if x.im is None and y.im is None:
        return Recorded(x.recorder, sub(x.re, y.re))
    return _pair(x, sub(x.re, y.re), sub(_zero(x), _zero(y)))


def _multiply(x: Recorded, y: Recorded) -> Recorded:
    r = x.recorder
    if x.im is None and y.im is None:
        return Recorded(r, r.mul(x.re, y.re))
    a, b, c, d = x.re, _zero(x), y.re, _zero(y)
    return _pair(x, r.sub(r.mul(a, c), r.mul(b, d)), r.add(r.mul(a, d), r.mul(b, c)))


def _divide(x: Recorded, y: Recorded) -> Recorded:
    r = x.recorder
    if y.im is None:
        return x._map(lambda part: r.div(part, y.re))
    return _divide(_multiply(x, _conjugate(y)), _square(y))


def _square(x: Recorded) -> Recorded:
    r = x.recorder
    two = r.constant(2)
    re = r.fold("^", x.re, two)
    return Recorded(r, re if x.im is None or _is(x.im, 0) else r.add(re, r.fold("^", x.im, two)))


def _power(x: Recorded, y: Recorded) -> Recorded:
    if y.im is not None or (x.im is not None and not _is(y.re, 2)):
        raise NotRecorded("a power of a complex number")
    if x.im is not None:
        return _multiply(x, x)
    return x if _is(y.re, 1) else Recorded(x.recorder, x.recorder.fold("^", x.re, y.re))


def _conjugate(x: Recorded) -> Recorded:
    return x if x.im is None else _pair(x, x.re, x.recorder.neg(x.im))


def _absolute(x: Recorded) -> Recorded:
    if x.im is None or _is(x.im, 0):
        return Recorded(x.recorder, x.recorder.fold("ABS", x.re))
    if _is(x.re, 0):
        return Recorded(x.recorder, x.recorder.fold("ABS", x.im))
    return Recorded(x.recorder, x.recorder.fold("SQRT", _square(x).re))


def _exp(x: Recorded) -> Recorded:
    r = x.recorder
    size = None if x.im is not None and _is(x.re, 0) else Recorded(r, r.fold("EXP", x.re))
    if x.im is None:
        return Recorded(r, r.fold("EXP", x.re))
    turned = _pair(x, r.fold("COS", x.im), r.fold("SIN", x.im))
    return turned if size is None else _multiply(size, turned)


def _angle(x: Recorded) -> Recorded:
    return Recorded(x.recorder, x.recorder.fold("ATAN2", _zero(x), x.re))


def _hypot(x: Recorded, y: Recorded) -> Recorded:
    return _absolute(_pair(x, x.re, y.re))


def _real(op: str) -> Callable[..., Recorded]:
    def operation(*args: Recorded) -> Recorded:
        if any(a.im is not None for a in args):
            raise NotRecorded(f"{op} of complex numbers")
        return Recorded(args[0].recorder, args[0].recorder.fold(op, *[a.re for a in args]))

    return operation


_real = cache(_real)


def _finite(x: Recorded) -> Recorded:
    both = [Recorded(x.recorder, x.recorder.fold("ISNUMBER", part)) for part in x.parts]
    return both[0] if len(both) == 1 else both[0] & both[1]


def _copysign(x: Recorded, y: Recorded) -> Recorded:
    return _where(x.recorder, y >= 0, _absolute(x), -_absolute(x))


def _heaviside(x: Recorded, y: Recorded) -> Recorded:
    return _where(x.recorder, x > 0, 1.0, _where(x.recorder, x < 0, 0.0, y))


_UFUNCS: dict[Any, Callable[..., Recorded]] = {
    np.add: _add, np.subtract: _subtract, np.multiply: _multiply, np.true_divide: _divide, np.power: _power,
    np.negative: lambda x: -x, np.positive: lambda x: x, np.absolute: _absolute, np.conjugate: _conjugate,
    np.exp: _exp, np.hypot: _hypot, np.arctan2: _real("ATAN2"), np.remainder: _real("MOD"), np.sqrt: _real("SQRT"),
    np.sin: _real("SIN"), np.cos: _real("COS"), np.tan: _real("TAN"), np.arcsin: _real("ASIN"),
    np.arccos: _real("ACOS"), np.log: _real("LN"), np.sign: _real("SIGN"), np.square: _square,
    np.maximum: _real("MAX"), np.minimum: _real("MIN"), np.copysign: _copysign, np.heaviside: _heaviside,
    np.less: _real("<"), np.less_equal: _real("<="), np.greater: _real(">"), np.greater_equal: _real(">="),
    np.equal: _real("="), np.not_equal: _real("<>"), np.isnan: lambda x: ~_finite(x), np.isfinite: _finite,
    np.logical_and: _real("AND"), np.logical_or: _real("OR"), np.logical_not: _real("NOT"),
    np.bitwise_and: _real("AND"), np.bitwise_or: _real("OR"), np.invert: _real("NOT"), np.rint: _real("ROUND"),
}  # fmt: skip


def _where(r: Recorder, condition: Any, x: Any, y: Any) -> Recorded:
    c, a, b = r.lift(condition), r.lift(x), r.lift(y)
    if a.im is None and b.im is None:
        return Recorded(r, r.fold("IF", c.re, a.re, b.re))
    return Recorded(r, r.fold("IF", c.re, a.re, b.re), r.fold("IF", c.re, _zero(a), _zero(b)))


def _reduction(name: str) -> Callable[..., Recorded]:
    def operation(
        r: Recorder, x: Any, axis: int | None = None, keepdims: bool = False, initial: Any = None, where: Any = None
    ) -> Recorded:
        x = r.lift(x) if where is None else _where(r, where, x, initial)
        result: Recorded = getattr(x, name)(axis=axis, keepdims=keepdims)
        if initial is None:
            return result
        combine: Any = {"max": np.maximum, "min": np.minimum, "sum": np.add}[name]
        return r.lift(combine(result, initial))

    return operation


def _joined(r: Recorder, parts: Sequence[Any], axis: int = 0) -> Recorded:
    return r.stack([r.lift(p) for p in parts], axis)


def _stacked(r: Recorder, parts: Sequence[Any], axis: int = 0) -> Recorded:
    if axis not in (0, -1):
        raise NotRecorded(f"stack along axis {axis}")
    lifted = [r.lift(p) for p in parts]
    return r.stack([p[..., None] for p in lifted], axis=-1) if axis else r.stack(lifted)


def _rounded(r: Recorder, x: Any, decimals: int = 0) -> Recorded:
    if decimals:
        raise NotRecorded(f"round to {decimals} decimals")
    return r.lift(_real("ROUND")(r.lift(x)))


def _seen(f: Callable[..., Any]) -> Callable[..., Any]:
    """Function that finds positions: they are those of the present numbers, and a guard tells when they change."""

    def operation(r: Recorder, x: Any) -> Any:
        x = r.lift(x)
        if x.re.op != "constant":
            r.guards.append(((x != x.value).sum().re, 0))
        return f(x.value)

    return operation


def _trapezoid(r: Recorder, y: Any, x: Any = None, axis: int = -1) -> Recorded:
    if axis != -1:
        raise NotRecorded(f"trapezoid along axis {axis}")
    heights, places = r.lift(y), r.lift(x)
    return ((places[..., 1:] - places[..., :-1]) * (heights[..., 1:] + heights[..., :-1]) / 2).sum(axis=-1)


def _broadcast(r: Recorder, x: Any, shape: tuple[int, ...]) -> Recorded:
    whole = r.lift(x)
    return whole._map(lambda node: whole._whole(node, shape))


_FUNCTIONS: dict[Any, Callable[..., Any]] = {
    np.where: _where, np.angle: lambda r, x: _angle(r.lift(x)), np.real: lambda r, x: r.lift(x).real,
    np.imag: lambda r, x: r.lift(x).imag, np.shape: lambda r, x: r.lift(x).shape, np.ndim: lambda r, x: r.lift(x).ndim,
    np.size: lambda r, x: r.lift(x).size, np.concatenate: _joined, np.stack: _stacked, np.broadcast_to: _broadcast,
    np.max: _reduction("max"), np.amax: _reduction("max"), np.nanmax: _reduction("max"), np.min: _reduction("min"),
    np.amin: _reduction("min"), np.nanmin: _reduction("min"), np.sum: _reduction("sum"), np.any: _reduction("any"),
    np.all: _reduction("all"), np.round: _rounded,
    np.ravel: lambda r, x: r.lift(x).reshape(-1), np.trapezoid: _trapezoid,
    np.broadcast_arrays: lambda r, *x: [_broadcast(r, a, np.broadcast_shapes(*map(np.shape, x))) for a in x],
    np.argwhere: _seen(np.argwhere), np.nonzero: _seen(np.nonzero), np.flatnonzero: _seen(np.flatnonzero),
    np.count_nonzero: lambda r, x: _where(r, x, 1.0, 0.0).sum(),
    np.append: lambda r, x, y: _joined(r, [r.lift(x).reshape(-1), r.lift(y).reshape(-1)]),
}  # fmt: skip


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
