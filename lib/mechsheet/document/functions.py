"""Functions in formulas: how each is written, with all that it is told.

A function of the table is written by its rule, which takes what it writes; where a call tells it more, or of one that
the table has not, all stands in brackets behind its name, and an axis as an index of that.
"""

import ast
import builtins
from collections.abc import Callable, Iterable
from copy import deepcopy
from functools import lru_cache
from inspect import Signature, signature
from math import ceil
from typing import Protocol, TypeAlias, cast

import numpy as np

from mechsheet.document import mapped, names
from mechsheet.document.formula import (
    PRODUCT,
    SUM,
    WHOLE,
    Apply,
    Binary,
    Brackets,
    Cases,
    Element,
    Function,
    Integral,
    Measure,
    Node,
    Number,
    Overline,
    Power,
    Prefix,
    Product,
    Range,
    Root,
    Text,
    strength,
)
from mechsheet.mechanics import crank, drive, equilibrium, joint, load, planar, prp, rpp, rpr, rrp, rrr
from mechsheet.worksheet.symbol import Symbol

ANGULAR = ("sin", "cos", "tan")
_FEW = 9  # values: more of them stand for all between the first and the last


class Reader(Protocol):
    """What reads the parts of an expression."""

    def read(self, node: ast.expr) -> Node:
        """The part as a tree."""

    def least(self, node: ast.expr, least: int) -> Node:
        """The part, in brackets where it holds together less than its place asks for."""

    def power(self, base: ast.expr, exponent: ast.expr) -> Node:
        """A power of two parts."""

    def without(self, bound: Iterable[str]) -> "Reader":
        """One for which these names stand for nothing but themselves."""

    def symbols(self) -> "Reader":
        """One that puts no numbers for symbols: for what is of all elements, not of the one that is shown."""


Rule: TypeAlias = Callable[..., Node | None]


def call(reader: Reader, node: ast.Call) -> Node:
    """A function of what it is told, but for the branch that it takes anyway."""
    args = [a for a in node.args if not _is_branch(a)]
    keywords = [k for k in node.keywords if not _is_branch(k.value) and not _is_implied(k)]
    of = reader.symbols()
    if not isinstance(node.func, ast.Name):
        function = _method(of, node.func) if isinstance(node.func, ast.Attribute) else of.least(node.func, WHOLE)
        return Apply(function, _told(reader, args, keywords))
    name = node.func.id
    if name == "interp" and args:  # at one place among all those of a table
        return Apply(names.function(name), Brackets((reader.read(args[0]), *_told(of, args[1:], keywords).items)))
    if names.is_of_all(name, len(args)):
        reader = reader.symbols()
    return _ruled(reader, name, args, keywords) or _plain(reader, name, args, keywords)


def marked(part: ast.expr, own: frozenset[str]) -> ast.expr:
    """An expression in which calls of ``own`` functions are known as such where others are called so."""
    taken = frozenset(name for name in own if name in RULES or hasattr(np, name) or hasattr(builtins, name))
    return cast("ast.expr", _OfOwn(taken).visit(deepcopy(part))) if taken else part


class _OfOwn(ast.NodeTransformer):
    def __init__(self, own: frozenset[str]) -> None:
        self.own = own

    def visit_Call(self, node: ast.Call) -> ast.Call:
        self.generic_visit(node)
        if isinstance(node.func, ast.Name) and node.func.id in self.own:
            node.is_own = True  # type: ignore[attr-defined]
        return node


def own(reader: Reader, node: ast.Call) -> Node:
    """A function of the worksheet's by its name, whatever numpy has of the same."""
    name = node.func.id if isinstance(node.func, ast.Name) else ""
    return Apply(Text(name), _told(reader, node.args, node.keywords))


def _method(reader: Reader, node: ast.Attribute) -> Node:
    """A function that a value has: by its full name where that is one of words."""
    if path := names.path(node):
        return Function(path) if "." in path else names.function(path)
    return Prefix(reader.least(node.value, WHOLE), Function(f".{node.attr}"))


def _is_branch(node: ast.expr) -> bool:
    return isinstance(node, ast.Name) and node.id == "branch"


def _is_implied(keyword: ast.keyword) -> bool:
    """Whether an argument says what a formula says anyway: numbers are real or complex, of all axes."""
    match keyword:
        case ast.keyword("dtype", ast.Name("float" | "complex") | ast.Attribute(_, "float64" | "complex128")):
            return True
        case ast.keyword("axis", ast.Constant(None)):
            return True
    return False


def _ruled(reader: Reader, name: str, args: list[ast.expr], keywords: list[ast.keyword]) -> Node | None:
    """A function by its rule; None where it has none, or is told what the rule does not write."""
    rule = RULES.get(name)
    if not rule or any(isinstance(a, ast.Starred) for a in args) or any(k.arg is None for k in keywords):
        return None
    try:
        bound = _signature(rule).bind(reader, *args, **{str(k.arg): k.value for k in keywords})
    except TypeError:
        return None
    return rule(*bound.args, **bound.kwargs)


@lru_cache(maxsize=256)
def _signature(rule: Rule) -> Signature:
    return signature(rule)


def _plain(reader: Reader, name: str, args: list[ast.expr], keywords: list[ast.keyword]) -> Node:
    function = names.function(name.rpartition(".")[2])
    first, own = keywords[:1], _parameters(name) if keywords else ()
    while first and own[len(args) : len(args) + 1] == (first[0].arg,):  # what comes next is so without its name
        args, keywords = [*args, first[0].value], keywords[1:]
        first = keywords[:1]
    axis = next((k for k in keywords if k.arg == "axis" and names.is_fixed(k.value)), None)
    if axis:
        function, keywords = Element(function, _axis(axis.value)), [k for k in keywords if k is not axis]
    told = _told(reader, args, keywords)
    if isinstance(function, Function) and function.name in ANGULAR and len(told.items) == 1 and not keywords:
        angle = told.items[0]  # one that is one symbol or number follows without brackets
        if isinstance(angle, Symbol) or (isinstance(angle, Measure) and strength(angle) == WHOLE):
            return Prefix(function, angle)
    return Apply(function, told)


@lru_cache(maxsize=256)
def _parameters(name: str) -> tuple[str | None, ...]:
    """Those of a function of the mechanics, in their order."""
    function = next((vars(file)[name] for file in _MECHANICS if name in vars(file)), None)
    return tuple(signature(function).parameters) if callable(function) else ()


_MECHANICS = crank, drive, equilibrium, joint, load, planar, prp, rpp, rpr, rrp, rrr


def _axis(node: ast.expr) -> Text:
    text = ast.unparse(node)
    return Text("last axis" if text == "-1" else f"axes {text}" if text.startswith("(") else f"axis {text}")


def _told(reader: Reader, args: list[ast.expr], keywords: list[ast.keyword]) -> Brackets:
    named = [
        Binary(Text(k.arg.replace("_", " ")), "=", reader.least(k.value, SUM)) if k.arg else reader.read(k.value)
        for k in keywords
    ]
    return Brackets((*map(reader.read, args), *named))


def _bracketed(sign: str) -> Rule:
    return lambda r, x: Brackets((r.read(x),), sign)


def _abs(r: Reader, x: ast.expr) -> Node:
    return Brackets((r.read(x),), "||", high=True)


def _norm(r: Reader, x: ast.expr, ord: ast.expr | None = None, axis: ast.expr | None = None) -> Node | None:
    if ord and axis:
        return None
    if axis:
        return Element(Brackets((r.read(x),), "‖‖", high=True), _axis(axis)) if names.is_fixed(axis) else None
    return Element(Brackets((r.read(x),), "‖‖", high=True), r.read(ord)) if ord else _abs(r, x)


def _hypot(r: Reader, first: ast.expr, *others: ast.expr) -> Node | None:
    if not others:
        return None
    node, *more = (r.power(x, ast.Constant(2)) for x in (first, *others))
    for square in more:
        node = Binary(node, "+", square)
    return Root(node)


def _log(r: Reader, x: ast.expr, base: ast.expr | None = None) -> Node | None:
    return Apply(Element(Function("log"), r.read(base)), Brackets((r.read(x),))) if base else None


def _cross(r: Reader, a: ast.expr, b: ast.expr) -> Node:
    return Binary(r.least(a, PRODUCT), "×", r.least(b, PRODUCT))


def _dot(r: Reader, a: ast.expr, b: ast.expr) -> Node:
    return Binary(r.least(a, PRODUCT), "⋅", r.least(b, PRODUCT))


def _solve(r: Reader, a: ast.expr, b: ast.expr) -> Node:
    return Product(Power(r.least(a, WHOLE), Number(-1)), r.least(b, PRODUCT))


def _transpose(r: Reader, a: ast.expr) -> Node:
    return Power(r.least(a, WHOLE), Function("T"))


def _arange(r: Reader, start: ast.expr, stop: ast.expr | None = None, step: ast.expr | None = None) -> Node:
    """Numbers up to the last one before ``stop``; the first two show how far they are from each other."""
    first, end = (start, stop) if stop else (ast.Constant(0), start)
    if step is None:
        few = not stop and (names.number(end) or 3) <= 2
        begin: tuple[Node, ...] = (Number(0),) if few else (r.read(first),) if stop else (Number(0), Number(1))
        return Range(begin, before(r, end, first))
    begin = (r.read(first), r.read(_added(first, step)))
    numbers = [names.number(x) for x in (first, end, step)]
    if None in numbers or not numbers[2]:
        return Range(begin, Prefix(Text("before "), r.read(end)))
    one, last, apart = (x or 0.0 for x in numbers)
    return Range(begin, Number(one + (ceil((last - one) / apart) - 1) * apart))


def _added(first: ast.expr, step: ast.expr) -> ast.expr:
    numbers = names.number(first), names.number(step)
    if numbers[0] is not None and numbers[1] is not None:
        return ast.Constant(numbers[0] + numbers[1])
    return step if numbers[0] == 0 else ast.BinOp(first, ast.Add(), step)


def before(r: Reader, stop: ast.expr, start: ast.expr | None = None) -> Node:
    """The last number before ``stop`` of those that are 1 apart, from ``start`` on."""
    first, end = names.number(start) if start else 0.0, names.number(stop)
    match stop:
        case ast.BinOp(last, ast.Add(), ast.Constant(1)):
            return r.read(last)
        case _ if first is not None and end is not None:
            return Number(first + ceil(end - first) - 1)
    return r.read(ast.BinOp(stop, ast.Sub(), ast.Constant(1)))


def _linspace(r: Reader, start: ast.expr, stop: ast.expr, num: ast.expr | None = None) -> Node:
    """The first and the last value, and how far the second is from the first where they are few."""
    match num:
        case ast.Constant(int(count)) if 2 < count <= _FEW:
            ends = names.number(start), names.number(stop)
            if ends[0] is not None and ends[1] is not None:
                second: Node = Number(ends[0] + (ends[1] - ends[0]) / (count - 1))
            else:
                part = _divided(stop if ends[0] == 0 else ast.BinOp(stop, ast.Sub(), start), count - 1)
                second = r.read(part if ends[0] == 0 else ast.BinOp(start, ast.Add(), part))
            return Range((r.read(start), second), r.read(stop))
    return Range((r.read(start),), r.read(stop))


def _divided(whole: ast.expr, by: int) -> ast.expr:
    """A part of something, of what is divided by a whole number itself as one fraction of that."""
    match whole:
        case ast.BinOp(of, ast.Div(), ast.Constant(int(already))):
            return ast.BinOp(of, ast.Div(), ast.Constant(already * by))
    return ast.BinOp(whole, ast.Div(), ast.Constant(by))


def _integral(r: Reader, y: ast.expr, x: ast.expr) -> Node:
    return Integral(r.least(y, PRODUCT), r.least(x, WHOLE))


def _so_far(r: Reader, y: ast.expr, x: ast.expr, initial: ast.expr | None = None) -> Node | None:
    integral = Integral(r.least(y, PRODUCT), r.least(x, WHOLE), so_far=True)
    match initial:
        case ast.Constant(0 | 0.0):
            return integral
        case None | ast.Constant(None):  # without the first one
            return Element(Brackets((integral,)), Binary(Symbol("k"), "≥", Number(1)))
    return None


def quad(r: Reader, node: ast.expr) -> Node | None:
    """The integral that scipy's function of it gives first; None for any other call, and where it is told more."""
    match names.bare(node):
        case ast.Call(ast.Name("quad"), [f, start, end, *more], keywords):
            match more, keywords:
                case [], []:
                    others = list[ast.expr]()
                case ([ast.Tuple(others)], []) | ([], [ast.keyword("args", ast.Tuple(others))]):
                    pass
                case _:
                    return None
        case _:
            return None
    if isinstance(f, ast.Lambda) and not others and len(f.args.args) == 1 and not f.args.defaults:
        over, of = f.args.args[0].arg, f.body
    else:
        used = {n.id for part in (f, *others, start, end) for n in ast.walk(part) if isinstance(n, ast.Name)}
        over = next(letter for letter in "xtsuvw" if letter not in used)
        of = ast.Call(f, [ast.Name(over), *others], [])
    inner = r.without([over])
    return Integral(inner.least(of, PRODUCT), names.symbol(over), False, r.read(start), r.read(end))


def _where(r: Reader, condition: ast.expr, x: ast.expr, y: ast.expr) -> Node:
    return Cases(r.read(x), r.read(condition), r.read(y))


def _cases(r: Reader, conditions: list[ast.expr], values: list[ast.expr], otherwise: Node) -> Node:
    for condition, x in zip(reversed(conditions), reversed(values), strict=True):
        otherwise = Cases(r.read(x), r.read(condition), otherwise)
    return otherwise


def _select(r: Reader, condlist: ast.expr, choicelist: ast.expr, default: ast.expr | None = None) -> Node | None:
    match condlist, choicelist:
        case ast.List(conditions), ast.List(values) if len(conditions) == len(values):
            return _cases(r, conditions, values, r.read(default) if default else Number(0))
    return None


def _piecewise(r: Reader, x: ast.expr, condlist: ast.expr, funclist: ast.expr) -> Node | None:
    match condlist, funclist:
        case ast.List(conditions), ast.List(functions) if 0 <= len(functions) - len(conditions) <= 1:
            values = [value for f in functions if (value := _at(f, x))]
            if len(values) == len(functions):
                count = len(conditions)
                rest = r.read(values[-1]) if len(values) > count else Number(0)
                return _cases(r, conditions[::-1], values[:count][::-1], rest)  # the last one that holds is taken
    return None


def _at(function: ast.expr, x: ast.expr) -> ast.expr | None:
    """A function's value at a place, or the number that it is; None where it would be a function of another name."""
    match function:
        case ast.Lambda(ast.arguments(args=[ast.arg(name)], defaults=[]), body):
            return body if isinstance(x, ast.Name) and x.id == name else None
        case ast.Name() | ast.Attribute():
            return ast.Call(function, [x], [])
    return function


def _array(r: Reader, object: ast.expr) -> Node | None:
    listed = isinstance(mapped.written_out(object), ast.List | ast.Tuple | ast.ListComp | ast.GeneratorExp)
    return r.read(object) if listed else None


def _celsius(_: Reader, degrees: ast.expr) -> Node | None:
    match degrees:
        case ast.Constant(int() | float() as number):
            return Measure(number, "degC")
    return None


def _complex(r: Reader, real: ast.expr, imag: ast.expr) -> Node:
    return r.read(ast.BinOp(real, ast.Add(), ast.BinOp(ast.Constant(1j), ast.Mult(), imag)))


RULES: dict[str, Rule] = {
    "sqrt": lambda r, x: Root(r.read(x)),
    "cbrt": lambda r, x: Root(r.read(x), Number(3)),
    "hypot": _hypot,
    "abs": _abs,
    "linalg.norm": _norm,
    "log": _log,
    "conj": lambda r, x: Overline(r.read(x)),
    "exp": lambda r, x: Power(Symbol("e"), r.read(x)),
    "exp2": lambda r, x: Power(Number(2), r.read(x)),
    "cross": _cross,
    "dot": _dot,
    "linalg.solve": _solve,
    "linalg.inv": lambda r, a: Power(r.least(a, WHOLE), Number(-1)),
    "linalg.matrix_power": lambda r, a, n: r.power(a, n),
    "transpose": _transpose,
    "arange": _arange,
    "range": _arange,
    "linspace": _linspace,
    "trapezoid": _integral,
    "simpson": _integral,
    "cumulative_trapezoid": _so_far,
    "cumulative_simpson": _so_far,
    "ceil": _bracketed("⌈⌉"),
    "floor": _bracketed("⌊⌋"),
    "where": _where,
    "select": _select,
    "piecewise": _piecewise,
    "array": _array,
    "asarray": _array,
    "celsius": _celsius,
    "complex": _complex,
}
