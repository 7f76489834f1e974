"""The ball rules of operations: what encloses the exact result where balls enclose the operands.

A ball is a midpoint with a radius (`flint.arb`); one of no finite radius says nothing. `NONE` is a result that is
proved to be no number, as the root of what is surely negative. A condition is 1 where it surely holds, 0 where it
surely does not, and `UNDECIDED` where the balls of what it compares do not tell.
"""

from collections.abc import Callable, Sequence
from contextlib import suppress
from fractions import Fraction
from functools import cache
from operator import add, mul, neg, sub
from typing import Any

import numpy as np
from flint import arb, ctx

from mechsheet.quantities.node import Node
from mechsheet.quantities.operations import Values

NONE = None
UNDECIDED = 0.5
_HALF, _UNKNOWN = arb(0.5), arb.nan()


def endless(x: Any) -> bool:
    """Whether infinite itself, as life below a limit is, of one sign: a ball that says nothing has none."""
    return bool(abs(x) > 0 and not x.is_finite())


def leaves_open(balls: Values) -> bool:
    """Whether one of some balls says nothing."""
    shut = (x != UNDECIDED if isinstance(x, float) else x is NONE or x.is_finite() or endless(x) for x in balls.flat)
    return not all(shut)


def _of_number(f: Callable[[Any], Any]) -> Callable[[Any], Any]:
    """A function of a ball, no number where that is none."""
    return lambda a: NONE if a is NONE else f(a)


def _of_numbers(f: Callable[[Any, Any], Any]) -> Callable[[Any, Any], Any]:
    """A function of two balls, no number where one of them is none."""
    return lambda a, b: NONE if a is NONE or b is NONE else f(a, b)


def _divided(a: Any, b: Any) -> Any:
    if b.is_zero():
        return NONE if a.is_zero() else _UNKNOWN  # infinite, of which sign a zero does not tell here
    return a / b


def _root(a: Any) -> Any:
    return NONE if a < 0 else a.sqrt()


def _log(a: Any) -> Any:
    return NONE if a < 0 else a.log()


def _arc(f: Callable[[Any], Any]) -> Callable[[Any], Any]:
    return lambda a: NONE if abs(a) > 1 else f(a)


def _power(a: Any, b: Any) -> Any:
    if b is not NONE and b.is_zero():
        return arb(1)
    if a is NONE or b is NONE:
        return NONE
    if b.is_exact() and b.is_integer():
        n = int(b.unique_fmpz())
        return _divided(arb(1), _multiplied(a, -n)) if n < 0 else _multiplied(a, n)
    if a < 0 and b.is_exact():
        return NONE
    return arb(0) if a.is_zero() and b > 0 else a**b


def _multiplied(a: Any, n: int) -> Any:
    """A power by a whole number, also of a ball about 0."""
    if n == 1 or not a.contains(0):
        return a if n == 1 else a**n  # of a ball whose middle is 0 arb has no power
    size = abs(a).upper() ** n
    return arb(0 if n % 2 == 0 else -size).union(size)


def distance(square: Any) -> Any:
    """The root of a sum of squares, which is never negative."""
    if square is NONE or square > 0:
        return _of_number(arb.sqrt)(square)
    return arb(0).union(square.upper().sqrt()) if square.is_finite() else _UNKNOWN


def _whole(a: Any, down: Any) -> Any:
    """Between what a function that rises in steps makes of both ends."""
    if not a.is_finite():
        return _UNKNOWN
    low, high = down(a.lower()), down(a.upper())
    return low if low == high else low.union(high)


def _floor(a: Any) -> Any:
    return _whole(a, lambda x: x.floor().mid())


def _rounded(a: Any) -> Any:
    def nearest(x: Any) -> Any:
        up = (x + _HALF).floor().mid()
        tied = up - x == _HALF and not (up / 2).is_integer()
        return up - 1 if tied else up

    return _whole(a, nearest)


def _remainder(a: Any, b: Any) -> Any:
    return NONE if b.is_zero() else a - b * _floor(a / b)


def _chosen(c: Any, a: Any, b: Any) -> Any:
    if not isinstance(c, float):  # a number is true unless it is 0
        c = 0.0 if c is not NONE and c.is_zero() else UNDECIDED if c is not NONE and c.contains(0) else 1.0
    if c != UNDECIDED:
        return a if c else b
    if isinstance(a, float) or isinstance(b, float):
        return a if a is b or (isinstance(a, float) and a == b) else UNDECIDED
    if a is NONE or b is NONE:
        return NONE if a is b else _UNKNOWN
    return a.union(b) if a.is_finite() and b.is_finite() else _UNKNOWN


def _compared(surely: Callable[[Any, Any], bool], surely_not: Callable[[Any, Any], bool], of_none: float) -> Any:
    def compare(a: Any, b: Any) -> float:
        if a is NONE or b is NONE:
            return of_none
        return 1.0 if surely(a, b) else 0.0 if surely_not(a, b) else UNDECIDED

    return compare


def _alike(a: Any, b: Any) -> bool:
    """Whether surely equal: the same exact number, or one number as somebody has written it, chosen twice."""
    return bool(a == b) or (a is b and id(a) in _DECIMALS)


def _apart(a: Any, b: Any) -> bool:
    return bool(a.is_finite() and b.is_finite() and not a.overlaps(b))


def _is_finite(a: Any) -> float:
    return 0.0 if a is NONE else 1.0 if a.is_finite() else UNDECIDED


# Of single balls; `where` and the conditions take conditions too.
SINGLE: dict[str, Callable[..., Any]] = {
    "add": _of_numbers(add), "sub": _of_numbers(sub),
    "mul": _of_numbers(mul), "div": _of_numbers(_divided), "neg": _of_number(neg),
    "abs": _of_number(abs), "sqrt": _of_number(_root), "exp": _of_number(arb.exp), "log": _of_number(_log),
    "sin": _of_number(arb.sin), "cos": _of_number(arb.cos), "tan": _of_number(arb.tan),
    "asin": _of_number(_arc(arb.asin)), "acos": _of_number(_arc(arb.acos)), "atan2": _of_numbers(arb.atan2),
    "sign": _of_number(lambda a: a.sgn()), "floor": _of_number(_floor), "round": _of_number(_rounded),
    "mod": _of_numbers(_remainder), "pow": _power, "where": _chosen,
    "max": _of_numbers(arb.max), "min": _of_numbers(arb.min),
    "lt": _compared(lambda a, b: a < b, lambda a, b: a >= b or _alike(a, b), 0.0),
    "le": _compared(lambda a, b: a <= b or _alike(a, b), lambda a, b: a > b, 0.0),
    "gt": _compared(lambda a, b: a > b, lambda a, b: a <= b or _alike(a, b), 0.0),
    "ge": _compared(lambda a, b: a >= b or _alike(a, b), lambda a, b: a < b, 0.0),
    "eq": _compared(_alike, _apart, 0.0), "ne": _compared(_apart, _alike, 1.0),
    "and": min, "or": max, "not": lambda c: 1.0 - c, "finite": _is_finite,
    "like": lambda a, *_: a, "sized": lambda a, same: a if same == 1.0 else _UNKNOWN,
}  # fmt: skip
# Numpy's own loops over arrays of balls take a third of the time, and refuse what is no number.
_WITHOUT_NONE = {"add": np.add, "sub": np.subtract, "mul": np.multiply, "neg": np.negative}
TRUE_OR_FALSE = ("where", "and", "or", "not", "like", "sized")  # which take a condition as what it is


def ball(x: Any) -> Any:
    """The ball of a float, a whole number or a condition."""
    if isinstance(x, float):
        return NONE if np.isnan(x) else arb(x)
    return arb(int(x))


# Floats that stand for a part of pi, as worksheets write it: 2 * pi, pi / 2, pi / 180.
_PARTS = [(p, q) for q in (1, 2, 3, 4, 6, 8, 12, 30, 60, 180, 360) for p in range(1, 13)]
_OF_PI = {p * np.pi / q: (p, q) for p, q in _PARTS} | {p * (np.pi / q): (p, q) for p, q in _PARTS}


_WRITTEN = 12  # digits at most of a number that somebody has written
_COMPUTED = 2.0**-50  # of any other: its rounding, and that of what it is made of


def constant(x: Any) -> Any:
    """The ball of a number that a formula has: of 0.2 a fifth, and of a part of pi what it stands for.

    One of many digits has been computed, as 30 / pi or 1 / 3, and is off by the rounding of that.
    """
    p, q = _OF_PI.get(abs(x), (0, 1))
    if p:
        return arb.pi() * (p if x > 0 else -p) / q
    if is_computed(x):
        return arb(x, abs(x) * _COMPUTED)
    return ball(x) if not isinstance(x, float) or not np.isfinite(x) or _is_binary(x) else _written(x, ctx.prec)


@cache
def _written(x: float, _precision: int) -> Any:
    """The ball of a decimal fraction, the same one wherever it is written: by it two of them are known to be equal."""
    made = arb(repr(x))
    _DECIMALS[id(made)] = made
    return made


_DECIMALS = dict[int, Any]()


def _is_binary(x: float) -> bool:
    return Fraction(repr(x)) == Fraction(x)


def is_computed(x: Any) -> bool:
    """Whether a number is no part of pi and has more digits than somebody writes."""
    if not isinstance(x, float) or not np.isfinite(x) or abs(x) in _OF_PI or _is_binary(x):
        return False
    return len(repr(x).partition("e")[0].strip("-0.").replace(".", "")) > _WRITTEN


def counted(condition: float) -> Any:
    """A condition as the number 1 or 0."""
    return arb(0.5, 0.5) if condition == UNDECIDED else arb(condition)


def condition(x: Any) -> Any:
    """Whether a number is not 0."""
    return x if isinstance(x, float) else _chosen(x, 1.0, 0.0)


def elementwise(op: str, values: Sequence[Values]) -> Values:
    if op in _WITHOUT_NONE:
        with suppress(TypeError):
            return np.asarray(_WITHOUT_NONE[op](*values), object)
    f = np.frompyfunc(SINGLE[op], len(values), 1)
    return np.asarray(f(*values), object)


def _take(node: Node, source: Values) -> Values:
    return np.asarray(source.reshape(-1)[node.args[1]], object)


def _at(node: Node, source: Values, position: Values) -> Values:
    def pick(p: Any) -> Any:
        if p is NONE or not p.is_finite() or not p.is_exact():
            return NONE if p is NONE else _UNKNOWN
        n = p.unique_fmpz() if p.is_integer() else -1
        return source.reshape(-1)[int(n)] if 0 <= n < source.size else NONE

    return np.asarray(np.frompyfunc(pick, 1, 1)(position), object)


def _join(node: Node, *sources: Values) -> Values:
    _, which, inside, _ = node.args
    flat = np.concatenate([s.reshape(-1) for s in sources])
    return np.asarray(flat[np.cumsum([0, *(s.size for s in sources)])[which] + inside], object)


def _reduce(node: Node, source: Values) -> Values:
    _, groups, kind, _ = node.args
    flat, found = source.reshape(-1), np.empty(len(groups), object)
    for n, group in enumerate(groups):
        found[n] = _reduced(kind, flat[group].tolist())
    return found.reshape(node.shape)


def _reduced(kind: str, parts: list[Any]) -> Any:
    if kind in ("any", "all"):
        return (max if kind == "any" else min)([condition(x) for x in parts], default=float(kind == "all"))
    parts = [counted(x) if isinstance(x, float) else x for x in parts]
    if kind.startswith("nan"):
        kind, parts = kind.removeprefix("nan"), [x for x in parts if x is not NONE]
    if any(x is NONE for x in parts) or (kind in ("max", "min") and not parts):
        return _UNKNOWN if kind in ("argmax", "argmin") else NONE
    if kind in ("argmax", "argmin"):
        sizes = parts if kind == "argmax" else [-x for x in parts]
        best = [n for n, x in enumerate(sizes) if not any(x < y for y in sizes)]
        tied = all(sizes[n] == sizes[best[0]] for n in best)
        return arb(best[0]) if tied else arb(best[0]).union(arb(best[-1]))
    f = SINGLE[{"sum": "add", "prod": "mul"}.get(kind, kind)]
    result, *rest = parts or [arb(float(kind == "prod"))]
    for x in rest:
        result = f(result, x)
    return result


MADE: dict[str, Callable[..., Values]] = {"take": _take, "at": _at, "join": _join, "reduce": _reduce}
