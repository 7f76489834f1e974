"""Arithmetic of recorded quantities: real and imaginary parts apart, and nothing recorded that adds nothing."""

from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np

from mechsheet.quantities.graph import Graph, NotRecorded
from mechsheet.quantities.node import Node, is_number
from mechsheet.quantities.node import is_whole as _is_whole
from mechsheet.quantities.quantity import Quantity, lift, plain


def imaginary(x: Quantity) -> Node:
    """The imaginary part; 0 of a real quantity."""
    return x.im if x.im is not None else x.graph.constant(0.0)


def _whole_shape(f: Callable[[Quantity, Quantity], Quantity]) -> Callable[[Quantity, Quantity], Quantity]:
    """Arithmetic whose result has all elements also where a zero or one of the other operand leaves nothing to do."""

    def operation(x: Quantity, y: Quantity) -> Quantity:
        result, one, two = f(x, y), x.extent, y.extent
        shape = one if one == two else np.broadcast_shapes(one, two)
        return result if result.extent == shape else result.like(x, y)

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


def is_zero(x: Quantity) -> bool:
    """Whether a number is 0 whatever the inputs are."""
    return is_number(x.re, 0) and (x.im is None or is_number(x.im, 0))


def _none_times(x: Quantity, y: Quantity) -> bool:
    """Whether one of two is 0 and the other one may be no number, which their product then isn't either."""
    always = x.graph.always
    return any(is_zero(a) and not (b.re in always and (b.im is None or b.im in always)) for a, b in ((x, y), (y, x)))


@_whole_shape
def multiply(x: Quantity, y: Quantity) -> Quantity:
    graph = x.graph
    if _none_times(x, y):
        zero, other = (x, y) if is_zero(x) else (y, x)
        if other.im is not None:  # both parts are none where one is
            none = graph.fold("mul", zero.re, graph.add(other.re, other.im))
            return Quantity(graph, none, none)
        return Quantity(graph, graph.fold("mul", zero.re, other.re), zero.im and graph.constant(0.0))
    if x.im is None and y.im is None:
        return Quantity(graph, graph.mul(x.re, y.re))
    a, b, c, d = x.re, imaginary(x), y.re, imaginary(y)
    return Quantity(graph, graph.sub(graph.mul(a, c), graph.mul(b, d)), graph.add(graph.mul(a, d), graph.mul(b, c)))


@_whole_shape
def divide(x: Quantity, y: Quantity) -> Quantity:
    graph = x.graph
    if y.im is None and is_zero(x):
        return x.each(lambda part: graph.fold("div", part, y.re))
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
    quotient = elementwise("round")((x - x % y) / y)
    return whole(quotient) if is_whole(x) and is_whole(y) else quotient


def is_whole(x: Quantity) -> bool:
    """Whether Python has a whole number there, where it has one at all."""
    return _is_whole(x.re, x.graph.whole)


def cuts(x: Quantity) -> bool:
    """Whether an array of these numbers has whole ones alone, to which it cuts whatever is set in it."""
    if is_whole(x):
        return True
    if _is_whole(x.re, x.graph.whole, any_way=True, of_lists=x.graph.of_lists):
        raise NotRecorded("an array of what is a whole number on one way and none on another cuts what is set in it")
    return False


def whole(x: Quantity) -> Quantity:
    """What Python has as a whole number: a text shows it without decimals."""
    x.graph.whole.add(x.re)
    return x


def is_count(x: Quantity) -> bool:
    """Whether a text has no decimals of it: of a whole number, and of what is counted in a row."""
    return _is_whole(x.re, x.graph.whole, x.graph.counted)


def as_count(made: Quantity, each: Quantity) -> Quantity:
    """What Python's own sum, least or greatest of some numbers is: counted where each of them is."""
    if is_count(each):
        made.graph.counted.add(made.re)
    return made


def row_numbers(graph: Graph, count: Any) -> Quantity:
    """The numbers 0, 1, 2 .. of so many rows."""
    return Quantity(graph, graph.rows(count.re)) if isinstance(count, Quantity) else lift(graph, np.arange(count))


def trunc(x: Quantity) -> Any:
    if x.dtype == bool:
        return choice(x.graph, x, 1, 0)
    down = elementwise("floor")
    return choice(x.graph, x < 0, -down(-x), down(x))


def rounded(x: Quantity, decimals: int) -> Any:
    """Rounded to decimals, halves to the even neighbour, each part of a complex number; whole numbers have none."""
    if x.im is not None:
        return x.each(lambda part: rounded(Quantity(x.graph, part), decimals).re)
    if is_whole(x) and decimals > 0:
        return x.__copy__()
    scale, nearest = 10.0 ** abs(decimals), elementwise("round")
    made = nearest(x * scale) / scale if decimals > 0 else nearest(x / scale) * scale if decimals else nearest(x)
    return whole(made) if is_whole(x) else made


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


def sized(x: Quantity, holds: Node) -> Quantity:
    """A quantity while lengths are the same, else no number."""
    return x.each(lambda part: x.graph.node("sized", part, holds))


def none_like(x: Quantity) -> Quantity:
    """No numbers in the shape of a quantity, in both parts of a complex one."""
    none = lift(x.graph, np.nan).like(x)
    return x.each(lambda _: none.re)


def only_where(graph: Graph, condition: Any, x: Any) -> Quantity:
    """Elements of ``x`` where the condition holds, else none: NaN beside a complex number has the imaginary part 0."""
    c, a, none = lift(graph, condition), lift(graph, x), graph.constant(np.nan)
    graph.go_together(*c.parts, *a.parts)
    return a.each(lambda part: graph.fold("where", c.re, part, none))


def choice(graph: Graph, condition: Any, x: Any, y: Any) -> Any:
    """Elements of ``x`` where the condition holds, else of ``y``; of texts those that hold now."""
    if any(np.asarray(v).dtype.kind == "U" for v in (x, y) if not isinstance(v, Quantity | list | tuple)):
        texts: Any = np.where(plain(condition), x, y)
        return texts
    c, a, b = lift(graph, condition), lift(graph, x), lift(graph, y)
    graph.go_together(*c.parts, *a.parts, *b.parts)
    if a.im is None and b.im is None:
        return Quantity(graph, graph.fold("where", c.re, a.re, b.re))
    return Quantity(graph, graph.fold("where", c.re, a.re, b.re), graph.fold("where", c.re, imaginary(a), imaginary(b)))
