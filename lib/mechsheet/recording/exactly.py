"""Numbers that a worksheet computes of numbers alone, which the recording of a proof keeps as operations too.

Python has rounded them before a quantity meets them: ``cos(pi / 2)`` is 6e-17 by then, ``1 - 0.99`` has lost two
digits, and neither ``0.3 // 0.1`` nor ``1 - cos(1e-9)`` tells that it is another whole number than the exact one. So
what is computed is made of inputs that stand for what is written; of what cannot be followed nothing is known.
"""

import ast
import operator
from collections.abc import Callable, Mapping
from contextlib import suppress
from fractions import Fraction
from functools import partial, reduce
from types import BuiltinFunctionType
from typing import Any

import numpy as np

from mechsheet.quantities.graph import Graph, NotRecorded, current
from mechsheet.quantities.node import Node
from mechsheet.quantities.quantity import Quantity, has_quantity
from mechsheet.recording.forms import call
from mechsheet.units import UNKNOWN

_PLAIN = int | float | complex | np.number | np.ndarray
_WRITTEN = 12  # digits at most of what is written, as `ball_rules` has it
_HIGHEST = 64  # power that is computed to find out whether it is a decimal
_LARGEST = 2.0**53  # whole number up to which all of them are floats
_DECIMAL: dict[str, Callable[[Fraction, Fraction], Any]] = {
    name: getattr(operator, name) for name in ("add", "sub", "mul", "truediv", "floordiv", "mod", "pow")
}
OPERATIONS = {
    ast.Add: "add", ast.Sub: "sub", ast.Mult: "mul", ast.Div: "truediv", ast.FloorDiv: "floordiv", ast.Mod: "mod",
    ast.Pow: "pow", ast.MatMult: "matmul", ast.LShift: "lshift", ast.RShift: "rshift", ast.BitAnd: "and_",
    ast.BitOr: "or_", ast.BitXor: "xor",
}  # fmt: skip
_METHODS = frozenset(
    ("sum", "mean", "prod", "dot", "std", "var", "cumsum", "cumprod", "trace", "ptp", "round")
)  # of arrays, that compute
# Functions of numpy that choose numbers or put them together, which stay those that are written.
_CHOOSING = frozenset((
    np.array, np.asarray, np.asanyarray, np.ascontiguousarray, np.fromiter, np.zeros, np.ones, np.empty, np.full,
    np.zeros_like, np.ones_like, np.full_like, np.eye, np.identity, np.diag, np.concatenate, np.stack, np.vstack,
    np.hstack, np.column_stack, np.append, np.insert, np.delete, np.sort, np.max, np.min, np.maximum, np.minimum,
    np.where, np.select, np.negative, np.positive, np.sign, np.clip, np.ravel, np.reshape, np.transpose, np.flip,
    np.roll, np.repeat, np.tile, np.squeeze, np.unique, np.atleast_1d, np.broadcast_to, np.real, np.imag, np.conjugate,
    np.meshgrid, np.expand_dims, np.moveaxis, np.nan_to_num, np.copy,
))  # fmt: skip


class Unmoved:
    """What a recording knows of numbers that are computed of numbers alone."""

    def __init__(self) -> None:
        self.written = dict[Node, Node]()  # inputs that stand for numbers, and these
        self.lost = dict[Node, str]()  # numbers of which nobody knows how Python has them, and by what
        self.modules = dict[str, dict[str, Any]]()  # of the user's own, what each defines
        self.imported: dict[int, tuple[str, str]] | None = None  # module and name of each number of these

    def unknown(self, graph: Graph, own: Any, by: str = "its line") -> Any:
        """Numbers of the worksheet's own run of which nobody knows how they were computed."""
        if isinstance(own, list | tuple):
            return getattr(type(own), "_make", type(own))([self.unknown(graph, each, by) for each in own])
        if not isinstance(own, _PLAIN) or not _is_computed(own):
            return own
        array = np.asarray(own)
        parts = (array.real, array.imag) if array.dtype.kind == "c" else (array,)
        nodes = [graph.exported((), part) for part in parts]
        self.lost |= dict.fromkeys(nodes, f"what {by} makes of numbers alone is not followed")
        return Quantity(graph, *nodes)


def computed(
    f: Callable[..., Any], followed: Callable[..., Any], args: tuple[Any, ...], named: Mapping[str, Any] | None = None
) -> Any:
    """What a function makes of numbers alone: for a proof what ``followed`` makes of quantities that stand for them."""
    named, graph = named or {}, current.get()
    own = f(*args, **named)
    if graph.unmoved is None or f in _CHOOSING or not _is_computed(own):
        return own
    looked, numbered = dict(graph.looked), dict(graph.numbered)
    with suppress(Exception, NotRecorded):
        floats = _has_floats((*args, *named.values()))
        every = floats or isinstance(f, np.ufunc | BuiltinFunctionType)
        first = [number(graph, x, whole=not floats) for x in (args if every else args[:1])]
        made = followed(*first, *args[len(first) :], **{k: number(graph, x) for k, x in named.items()})
        if _is_alike(made, own):
            return made
    graph.looked, graph.numbered = looked, numbered
    return _lost(graph, own, getattr(f, "__name__", str(f)))


def operated(name: str, a: Any, b: Any, changing: str = "") -> Any:
    """An operation of Python's; of numbers alone, unless it is decimal as it stands, for a proof that of quantities."""
    f = getattr(operator, changing or name)
    graph = current.get()
    if graph.unmoved is None or not (isinstance(a, _PLAIN) and isinstance(b, _PLAIN)):
        return f(a, b)
    own = f(a, b)
    if not _is_computed(own) or _is_decimal(name, a, b, own):
        return own
    looked, numbered = dict(graph.looked), dict(graph.numbered)
    with suppress(Exception, NotRecorded):
        made = f(number(graph, a, whole=True), number(graph, b, whole=True))
        if _is_alike(made, own):
            return made
    graph.looked, graph.numbered = looked, numbered
    return _lost(graph, own, name)


def number(graph: Graph, x: Any, whole: bool = False) -> Any:
    """What stands for a number, or for several; for ``whole`` ones too, as far as they are no truths."""
    if isinstance(x, list) and x and not has_quantity(x):
        array = np.asarray(x) if all(isinstance(each, _PLAIN) for each in x) else None
        return [number(graph, each, whole) for each in x] if array is None else number(graph, array, whole)
    if isinstance(x, tuple):
        return getattr(type(x), "_make", type(x))([number(graph, each, whole) for each in x])
    if not isinstance(x, _PLAIN) or isinstance(x, bool):
        return x
    array = np.asarray(x)
    if array.dtype.kind == "c":
        parts = (array.real, array.imag)
        return Quantity(graph, *(_stands_for(graph, part) if part.any() else graph.constant(part) for part in parts))
    if array.dtype.kind == "f" or (whole and array.dtype.kind in "iu"):
        return Quantity(graph, _stands_for(graph, array))
    return x


def given(graph: Graph, args: tuple[Any, ...]) -> tuple[Any, ...]:
    """Arguments of what the library computes, those of numbers alone for a proof as what stands for them."""
    return args if graph.unmoved is None else tuple(number(graph, x) for x in args)


def _stands_for(graph: Graph, value: Any) -> Node:
    array = np.asarray(value, float)
    whole = np.asarray(value).dtype.kind in "iu" and bool((abs(array) > _LARGEST).any())
    if whole and any(int(x) != n for x, n in zip(array.flat, np.asarray(value).ravel().tolist(), strict=True)):
        raise NotRecorded("a whole number of too many digits")
    node = graph.leaf("input", f"written {array.shape} {array.tobytes().hex()}", array)
    graph.unmoved.written.setdefault(node, graph.constant(array))
    return node


def _lost(graph: Graph, own: Any, by: str) -> Any:
    """What is not followed; Raises NotRecorded where it holds its numbers to itself."""
    unknown = graph.unmoved.unknown(graph, own, by)
    if unknown is own:
        raise NotRecorded(f"what {by} makes of numbers alone")
    return unknown


def by_itself(graph: Graph, own: Any) -> Any:
    """A number of which nothing is known but that it is the same for all inputs."""
    return graph.unmoved.unknown(graph, own) if graph.unmoved else Quantity(graph, graph.constant(own, UNKNOWN))


def _is_computed(own: Any) -> bool:
    """Whether among what was made are numbers that may be rounded."""
    if isinstance(own, list | tuple):
        return any(map(_is_computed, own))
    if hasattr(own, "__dataclass_fields__") and not isinstance(own, type):
        return any(map(_is_computed, vars(own).values()))
    return isinstance(own, _PLAIN) and np.asarray(own).dtype.kind in "fc"


def _has_floats(values: Any) -> bool:
    if isinstance(values, list | tuple):
        return any(map(_has_floats, values))
    return isinstance(values, _PLAIN) and np.asarray(values).dtype.kind in "fc"


def _is_alike(made: Any, own: Any) -> bool:
    """Whether quantities are of the shape of numbers."""
    if isinstance(own, list | tuple):
        return len(made) == len(own) and all(map(_is_alike, made, own))
    return not isinstance(own, _PLAIN) or np.shape(own) == (made.extent if isinstance(made, Quantity) else ())


def _is_decimal(name: str, a: Any, b: Any, own: Any) -> bool:
    """Whether the decimals of two numbers make that of the result, so that nothing of it is rounded."""
    if name not in _DECIMAL or not all(type(x) in (int, float, np.float64) for x in (a, b, own)):
        return False
    if not all(np.isfinite(float(x)) and _is_short(x) for x in (a, b, own)):
        return False
    if name == "pow" and (float(b) != int(b) or abs(b) > _HIGHEST):
        return False
    with suppress(ArithmeticError):
        return bool(_DECIMAL[name](_decimal(a), Fraction(int(b)) if name == "pow" else _decimal(b)) == _decimal(own))
    return False


def _decimal(x: Any) -> Fraction:
    return Fraction(x) if isinstance(x, int) else Fraction(repr(float(x)))


def _is_short(x: Any) -> bool:
    digits = repr(float(x)).partition("e")[0].strip("-0.").replace(".", "")
    return isinstance(x, int) or len(digits) <= _WRITTEN


# --- what Python computes by itself ------------------------------------------------------------------------------


def of_array(x: Any) -> Any:
    """What computes by a method, or is changed in place: for an array of numbers alone what stands for it."""
    array = isinstance(x, np.ndarray) and x.dtype.kind in "fc"
    return number(current.get(), x) if array and current.get().unmoved is not None else x


def _quotient(a: Any, b: Any) -> Any:
    return operated("floordiv", a, b), operated("mod", a, b)


def _of_complex(x: Any) -> Any:
    return computed(abs, np.abs, (x,)) if isinstance(x, complex) else abs(x)


def rounded(x: Any, *digits: Any) -> Any:
    """Python's round, which leaves of a decimal another one."""
    if current.get().unmoved is None or has_quantity([x, *digits]):
        return round(x, *digits)
    own = round(x, *digits)
    if type(x) is type(own) is float and _is_short(x) and round(_decimal(x), *digits) == _decimal(own):
        return own
    return computed(round, round, (x, *digits))


def powered(*x: Any) -> Any:
    return operated("pow", *x) if len(x) == 2 else pow(*x)


def added(values: Any, start: Any = 0) -> Any:
    """Python's sum."""
    return sum(values, start) if current.get().unmoved is None else reduce(partial(operated, "add"), values, start)


def of_others(f: Callable[..., Any]) -> Callable[..., Any]:
    """A function of another package, of which nobody knows what it makes of numbers alone."""

    def function(*args: Any, **named: Any) -> Any:
        if has_quantity([*args, *named.values()]):
            return f(*args, **named)
        return computed(f, f if getattr(f, "__module__", "") in ("_operator", "_functools") else _unknown, args, named)

    return function


def _unknown(*_: Any, **__: Any) -> Any:
    raise NotRecorded("a function of another package")


class Following(ast.NodeTransformer):
    """Makes calls of operations in the code of a worksheet, and of what else computes."""

    def visit_BinOp(self, node: ast.BinOp) -> ast.AST:
        self.generic_visit(node)
        name = f"plain {OPERATIONS[type(node.op)]}"
        return call(name, node, node.left, node.right) if name in CALLS else node

    def visit_Call(self, node: ast.Call) -> ast.AST:
        """Python's own functions, and the methods of arrays."""
        self.generic_visit(node)
        match node:
            case ast.Call(ast.Name("abs" | "divmod" as name)):
                node.func = ast.copy_location(ast.Name(f"recorded {name}", ast.Load()), node.func)
            case ast.Call(ast.Attribute(array, name) as method) if name in _METHODS:
                method.value = call("array", array, array)
        return node


CALLS: dict[str, Any] = {f"plain {name}": partial(operated, name) for name in (*_DECIMAL, "matmul")}
CALLS |= {"array": of_array, "divmod": _quotient, "abs": _of_complex}
