"""What is computed as one types is bounded: a single step that lasts would keep the page, and nobody could end it.

A loop is many steps and can be ended. What is one step for Python, and stands in the line itself, is refused before it
is made: a whole number of tens of thousands of digits, tens of millions of elements, a question to who types.
"""

import ast
import builtins
import itertools
import math
from collections.abc import Callable, Mapping
from types import CodeType
from typing import Any

import numpy as np

from mechsheet.worksheet.errors import SheetError

_DIGITS = 10_000  # of a whole number
_MOST = 10_000_000  # elements of a range, a list or an array
_TYPING = "it is not computed as one types"


def compiled(text: str, filename: str) -> tuple[CodeType, dict[str, Any]]:
    """A text compiled, each of its lines where it stands, and what its names must hold besides."""
    tree = ast.fix_missing_locations(_Bounded().visit(ast.parse(text, filename)))
    return compile(tree, filename, "exec"), {_BY: _operand, _CALLED: _called}


_BY, _CALLED = "bounded operand", "bounded call"  # no names that a line could have
_LITERAL = (ast.List, ast.Tuple, ast.Constant, ast.JoinedStr)


class _Bounded(ast.NodeTransformer):
    """``a ** b`` becomes ``(lambda a: a ** bounded(a, b))(a)``, ``f(x)`` becomes ``bounded(f)(x)``."""

    def visit_BinOp(self, node: ast.BinOp) -> ast.AST:
        self.generic_visit(node)
        repeats = isinstance(node.op, ast.Mult) and any(isinstance(n, _LITERAL) for n in (node.left, node.right))
        if not (isinstance(node.op, ast.Pow | ast.LShift) or repeats):
            return node
        own = "bounded left"
        left, of = ast.Name(own, ast.Load()), ast.Constant(type(node.op).__name__)
        right = ast.Call(ast.Name(_BY, ast.Load()), [left, node.right, of], [])
        arguments = ast.arguments([], [ast.arg(own)], None, [], [], None, [])
        body = ast.copy_location(ast.BinOp(left, node.op, right), node)
        return ast.copy_location(ast.Call(ast.Lambda(arguments, body), [node.left], []), node)

    def visit_Call(self, node: ast.Call) -> ast.AST:
        self.generic_visit(node)
        node.func = ast.copy_location(ast.Call(ast.Name(_CALLED, ast.Load()), [node.func], []), node.func)
        return node


def _operand(left: Any, right: Any, kind: str) -> Any:
    """The right operand of a power, a shift or a repetition, if that is bounded."""
    match kind, left, right:
        case "Pow", int(), int() if abs(left) > 1 and right * math.log10(abs(left)) > _DIGITS:
            raise SheetError(f"this power is a whole number of more than {_DIGITS} digits: {_TYPING}")
        case "LShift", int(), int() if left and right > _DIGITS / math.log10(2):
            raise SheetError(f"this shift is a whole number of more than {_DIGITS} digits: {_TYPING}")
        case ("Mult", list() | tuple() | str() as what, int(n)) | ("Mult", int(n), list() | tuple() | str() as what):
            _refuse_many(len(what) * n)
    return right


def _refuse_many(count: float) -> None:
    if count > _MOST:
        raise SheetError(f"these are more than {_MOST // 10**6} million elements: {_TYPING}")


def _called(function: Any) -> Any:
    """A function, or what bounds it where it is one of those that can last in a single step."""
    try:
        bound = _BOUNDS.get(function) or _BOUNDS.get(getattr(function, "__wrapped__", None))  # a page has its own input
    except TypeError:  # what can be no key is none of them
        return function
    if bound is None:
        return function

    def bounded(*arguments: Any, **named: Any) -> Any:
        bound(*arguments, **named)
        return function(*arguments, **named)

    return bounded


def _asks(*_: Any, **__: Any) -> None:
    raise SheetError("a line asks nobody: what is given is an input")


def _program(*_: Any, **__: Any) -> None:
    raise SheetError("a line holds no program as a text: write what it computes")


def _endless(*_: Any, **__: Any) -> None:
    raise SheetError(f"this has no end: {_TYPING}")


def _range(*ends: Any, **_: Any) -> None:
    start, stop, step = (0, *ends, 1) if len(ends) == 1 else (*ends, 1)[:3]
    _refuse_many((float(stop) - float(start)) / (float(step) or 1.0))


def _factorial(n: Any, *_: Any) -> None:
    _operand(10, int(n), "Pow")


def _shaped(shape: Any, *_: Any, **__: Any) -> None:
    _refuse_many(math.prod(float(n) for n in np.ravel(shape)))


def _square(n: Any, *_: Any, **__: Any) -> None:
    _refuse_many(float(n) ** 2)


def _points(start: Any, stop: Any, num: Any = 50, *_: Any, **__: Any) -> None:
    _refuse_many(float(num))


def _times(values: Any, times: Any, *_: Any, **__: Any) -> None:
    _refuse_many(np.size(values) * float(np.max(times)))


def _power(base: Any, exponent: Any, modulus: Any = None) -> None:
    if modulus is None:
        _operand(base, exponent, "Pow")


_BOUNDS: Mapping[Any, Callable[..., None]] = {
    **dict.fromkeys((builtins.input, builtins.breakpoint), _asks),
    **dict.fromkeys((builtins.eval, builtins.exec), _program),
    **dict.fromkeys((itertools.count, itertools.cycle, itertools.repeat), _endless),
    **dict.fromkeys((range, np.arange), _range),
    **dict.fromkeys((math.factorial, math.perm, math.comb), _factorial),
    **dict.fromkeys((np.zeros, np.ones, np.empty, np.full), _shaped),
    **dict.fromkeys((np.eye, np.identity, np.tri), _square),
    **dict.fromkeys((np.linspace, np.logspace, np.geomspace), _points),
    **dict.fromkeys((np.repeat, np.tile), _times),
    pow: _power,
}
