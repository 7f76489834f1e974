"""Numbers that Python has computed of numbers alone, before a quantity meets them, by what they were computed.

``cos(pi / 2)`` is 6e-17 by then, and ``1 - 0.99`` has lost two digits: a proof wants 0 and a hundredth.
"""

import ast
import builtins
import operator
from collections import Counter
from collections.abc import Callable, Iterator, Mapping
from contextlib import suppress
from itertools import chain
from typing import Any

import numpy as np

from mechsheet.quantities.graph import Graph, NotRecorded, current
from mechsheet.quantities.node import Node
from mechsheet.quantities.quantity import FUNCTIONS, Quantity, lift
from mechsheet.readers.ball_rules import is_computed
from mechsheet.recording.math_rules import MATH
from mechsheet.recording.substitutes import instead
from mechsheet.units import UNKNOWN
from mechsheet.worksheet import source
from mechsheet.worksheet.cells import Worksheet
from mechsheet.worksheet.source import bound

_MOST = 200  # numbers of an array
_OPERATIONS: dict[type[ast.AST], Callable[..., Any]] = {
    ast.Add: operator.add, ast.Sub: operator.sub, ast.Mult: operator.mul, ast.Div: operator.truediv,
    ast.Pow: operator.pow, ast.Mod: operator.mod, ast.FloorDiv: operator.floordiv,
    ast.USub: operator.neg, ast.UAdd: operator.pos,
}  # fmt: skip
# Functions of Python's own, by numpy's of the same numbers.
_PYTHON: dict[Any, Callable[..., Any]] = {abs: np.abs, sum: np.sum, pow: np.power, max: np.max, min: np.min}
# What is raised by what is no number, or not made of numbers alone.
_NO_NUMBER = NotRecorded, TypeError, ValueError, LookupError, AttributeError, ArithmeticError
_Known = Mapping[float, Quantity]


@np.errstate(all="ignore")
def computed(graph: Graph, sheet: Worksheet) -> dict[Node, Node]:
    """The constants of a recording that Python had computed, with the operations that they are of."""
    known, token = dict[float, Quantity](), current.set(graph)
    try:
        for found, made in _Written(graph, sheet).every():
            if found.shape == made.extent and found.size <= _MOST:  # whose numbers may be rounded otherwise
                for x, one in zip(found.ravel().tolist(), made.ravel(), strict=True):
                    if is_computed(x):
                        known.setdefault(x, one)
        constants = [node for node in graph.nodes.values() if node.op == "constant" and not node.args]
        return {node: _meant(graph, node.value, known) for node in constants if _has(node.value, known)}
    finally:
        current.reset(token)


def _has(values: Any, known: _Known) -> bool:
    few = values.size <= _MOST and values.dtype.kind == "f"
    return few and not known.keys().isdisjoint(values.ravel().tolist())


def _meant(graph: Graph, values: Any, known: _Known) -> Node:
    each = [known.get(x, x) for x in values.ravel().tolist()]
    return lift(graph, each).reshape(values.shape).re if values.ndim else lift(graph, each[0]).re


class _Written:
    """What a worksheet writes of numbers alone: operations, functions of numpy's and Python's, names of such."""

    def __init__(self, graph: Graph, sheet: Worksheet) -> None:
        self.graph, self.common = graph, sheet.common
        self.lines = [*sheet.setup, *chain.from_iterable(cell.lines for cell in sheet.cells)]
        times = Counter(chain.from_iterable(map(bound, self.lines)))
        self.names = dict[str, ast.expr]()
        for line in self.lines:
            match line:
                case ast.Assign([ast.Name(name)], value) if times[name] == 1:
                    self.names[name] = value
        self.made = dict[tuple[str, Callable[..., Any]], Any]()  # of each name once: one may stand in another twice

    def every(self) -> Iterator[tuple[Any, Quantity]]:
        """Each as numpy has it, and as a quantity of which the operations are kept."""
        for node in chain.from_iterable(map(source.nodes, self.lines)):
            if isinstance(node, ast.BinOp | ast.UnaryOp | ast.Call | ast.Attribute):
                with suppress(*_NO_NUMBER):
                    found = np.asarray(self.of(node))
                    if found.dtype.kind in "fc":
                        made = lift(self.graph, self.of(node, self.kept, _following))
                        yield found.real, made.real
                        if found.dtype.kind == "c":
                            yield found.imag, made.imag

    def kept(self, x: Any) -> Quantity:
        """A number of which operations are kept, as of plain ones they are not, and what it moves is asked for."""
        return Quantity(self.graph, self.graph.node("mul", *(self.graph.constant(y, UNKNOWN) for y in (x, 1))))

    def of(
        self, node: ast.expr, number: Callable[[Any], Any] = lambda x: x, function: Callable[[Any], Any] = lambda f: f
    ) -> Any:
        """A number, or several, of an expression.

        Raises TypeError, or what else there is, where it is none of numbers alone.
        """

        def of(part: ast.expr) -> Any:
            return self.of(part, number, function)

        match node:
            case ast.Constant(int() | float() as x):
                return number(x)
            case ast.Constant(complex() as x):
                return number(x.imag) * 1j
            case ast.Attribute(of_complex, "real" | "imag" as name):
                return getattr(of(of_complex), name)
            case ast.List(parts) | ast.Tuple(parts):
                return [of(part) for part in parts]
            case ast.UnaryOp(operation, operand):
                return _OPERATIONS[type(operation)](of(operand))
            case ast.BinOp(left, operation, right):
                return _OPERATIONS[type(operation)](of(left), of(right))
            case ast.Call(f, args, []) if _is_rule(called := self.value(f)):
                return function(called)(*map(of, args))
            case ast.Name(name) if name in self.names:
                if (name, function) not in self.made:
                    self.made[name, function] = of(self.names[name])
                return self.made[name, function]
        if type(x := self.value(node)) is float:
            return number(x)
        raise TypeError(f"{ast.unparse(node)} is no number")

    def value(self, node: ast.expr) -> Any:
        """What a name, or one in a module, is in the worksheet's setup."""
        match node:
            case ast.Name(name):
                return self.common[name] if name in self.common else getattr(builtins, name)
            case ast.Attribute(of, name):
                return getattr(self.value(of), name)
        raise TypeError(f"{ast.unparse(node)} is no name")


def _following(f: Any) -> Callable[..., Any]:
    """What takes quantities in place of a function of numpy's or Python's."""
    rule = instead(_PYTHON.get(f, f))
    return (lambda *x: rule(list(x) if x[1:] else x[0])) if f in (max, min) else rule


def _is_rule(f: Any) -> bool:
    return isinstance(f, np.ufunc) or f in MATH or f in FUNCTIONS or f in (np.array, np.asarray, *_PYTHON)
