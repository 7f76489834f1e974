"""Balls of a recording: what surely encloses its quantities as exact arithmetic on its inputs has them.

The recording is evaluated in rigorous arithmetic of a chosen precision, by the rules of `ball_rules`. What is found is
enclosed by Krawczyk's operator: a box about the numbers of the worksheet's own run that it maps into its inside holds
one root, and no other. What is not recorded, or not enclosed, is a ball that says nothing.

R. Krawczyk, Newton-Algorithmen zur Bestimmung von Nullstellen mit Fehlerschranken, Computing 4 (1969).
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from functools import reduce
from itertools import pairwise
from types import MappingProxyType
from typing import Any

import numpy as np
from flint import arb, arb_mat, ctx

from mechsheet.quantities.node import Block, Node, bottom_up, has_equation
from mechsheet.quantities.operations import ELEMENTWISE, Values
from mechsheet.readers.ball_rules import (
    MADE,
    NONE,
    TRUE_OR_FALSE,
    UNDECIDED,
    ball,
    condition,
    constant,
    counted,
    distance,
    elementwise,
)
from mechsheet.readers.slope_rules import SMOOTH, kernel

_NEWTON = 12  # steps to the root of as many digits as are wanted
_WIDER = 6  # boxes, each 16 times as wide as the one before
_balls, _constants, _counted = (np.frompyfunc(f, 1, 1) for f in (ball, constant, counted))
_conditions, _distances = (np.frompyfunc(f, 1, 1) for f in (condition, distance))
_known = np.frompyfunc(lambda x: arb.nan() if x is NONE else x, 1, 1)


# Inputs that stand for numbers of the formulas, with these.
meant: ContextVar[Mapping[Node, Node]] = ContextVar("meant", default=MappingProxyType({}))


@contextmanager
def precision(bits: int) -> Iterator[None]:
    before, ctx.prec = ctx.prec, bits
    try:
        yield
    finally:
        ctx.prec = before


class Balls:
    """One evaluation of a recording; ``given`` are balls of nodes in place of their own."""

    def __init__(self, given: Mapping[Node, Values] | None = None) -> None:
        self.known: dict[Node, Values] = dict(given or {})
        self.solved = dict[Block, list[Values]]()

    def of(self, wanted: Iterable[Node]) -> list[Values]:
        """Balls of some nodes, arrays in their shapes."""
        wanted = list(wanted)
        for node in bottom_up(wanted, self.known):
            self.known[node] = self._of(node)
        return [self.known[node] for node in wanted]

    def _of(self, node: Node) -> Values:
        if node in (own := meant.get()):
            return self.of([own[node]])[0]
        if node.op in ("constant", "input", "rows", "length"):
            if node.value.dtype == bool:
                return np.asarray(node.value.astype(float), object)
            return _array(_constants if node.op == "constant" else _balls, node.value.astype(object))
        if node.op == "found":
            return self._found(node)
        if node.op == "iterated":  # by as many turns as the worksheet took, where that is decided
            return self.of(node.args[2:])[0]
        if node.op in ELEMENTWISE:
            values = [self.known[operand] for operand in node.args]
            if node.op in ("eq", "ne") and not any(
                map(_is_chosen, node.args)
            ):  # as Python saw it, a number is its float
                values = [_exact(v, operand) for v, operand in zip(values, node.args, strict=True)]
            if node.op in ("and", "or", "not"):
                values = [_array(_conditions, v) for v in values]
            elif node.op not in TRUE_OR_FALSE or (node.op == "where" and node.value.dtype != bool):
                first = [values.pop(0)] if node.op == "where" else []
                values = first + [_array(_counted, v) if _is_condition(v) else v for v in values]
            if node.op == "like":
                return np.broadcast_arrays(*values)[0]
            if node.op == "sqrt" and kernel(node):
                return _array(_distances, values[0])
            return elementwise(node.op, values)
        if node.op in MADE:
            return MADE[node.op](node, *(self.known[operand] for operand in node.operands))
        return _nothing(node.shape)

    def _found(self, node: Node) -> Values:
        block: Block = node.args[0]
        if not has_equation(node):
            return _nothing(node.shape)
        if block not in self.solved:
            self.solved[block] = enclosed(block, {n: self.known[n] for n in block.under})
        return self.solved[block][int(node.args[1])]


def unfollowed(wanted: Iterable[Node]) -> set[Node]:
    """Nodes of which no precision tells anything, with all that rests on them."""
    lost, seen = set[Node](), set[Node]()

    def look(nodes: Iterable[Node]) -> None:
        for node in bottom_up(nodes, seen):
            seen.add(node)  # what the turns of several loops rest on is looked at once
            below = node.operands
            if node.op == "iterated":
                look(node.args[2:])
                below = (*below, *node.args[2:])
            own = node.op == "exported" or (node.op == "found" and not has_equation(node))
            if own or not lost.isdisjoint(below):
                lost.add(node)

    look(wanted)
    return lost


def enclosed(block: Block, under: Mapping[Node, Values]) -> list[Values]:
    """Balls of the unknowns of a block, each problem's about the root next to the worksheet's own numbers.

    Balls that say nothing where no box is proved to hold a root. What the block rests on is ``under``.
    """
    problems = _Problems(block, under)
    at = problems.start()
    for _ in range(_NEWTON):
        step = problems.step(at)
        at = [[x.mid() for x in row] for row in problems.minus(at, step)]
        if all(d.contains(0) for row in step for d in row):  # no more than its rounding, or nobody knows where to
            break
    boxes: list[Any] = [None] * len(at)
    width = [
        [max(abs(d).upper(), abs(x).upper() * _unit(), _unit() ** 2) * 4 for x, d in zip(*pair, strict=True)]
        for pair in zip(at, step, strict=True)
    ]
    for _ in range(_WIDER):
        tried = problems.mapped(at, width)
        boxes = [old if old is not None else new for old, new in zip(boxes, tried, strict=True)]
        if all(box is not None for box in boxes):
            break
        width = [[w * 16 for w in row] for row in width]
    return problems.apart([box or [arb.nan()] * len(row) for box, row in zip(boxes, at, strict=True)])


def is_least(balls: Balls, block: Block) -> bool:
    """Whether a sum of squares surely bends upwards, along all unknowns, where its slopes vanish."""
    found = dict(zip(block.nodes, balls.of(block.nodes), strict=True))
    there = Balls({**{node: balls.known[node] for node in block.under}, **found})
    there.of(block.equations)
    counts = range(1, len(block.nodes) + 1)
    minors = (arb_mat([row[:k] for row in J.tolist()[:k]]) for J in tangents(there, block) for k in counts)
    return all(bool(minor.det() > 0) for minor in minors)


def _unit() -> Any:
    """One unit in the last place of the present precision."""
    return arb(2) ** (4 - ctx.prec)


class _Problems:
    """The problems of a block: each element where all is elementwise, else one of all elements."""

    def __init__(self, block: Block, under: Mapping[Node, Values]) -> None:
        self.block, self.under = block, under
        self.shapes = [node.shape for node in block.nodes]

    def start(self) -> list[list[Any]]:
        return self.rows([_known(_array(_balls, node.value.astype(object))) for node in self.block.nodes])

    def rows(self, values: Sequence[Values]) -> list[list[Any]]:
        """The unknowns or equations of each problem."""
        flat = [np.broadcast_to(v, s).reshape(-1) for v, s in zip(values, self.shapes, strict=True)]
        if self.block.elementwise:
            return [list(row) for row in zip(*flat, strict=True)]
        return [[x for v in flat for x in v]]

    def apart(self, rows: Sequence[Sequence[Any]]) -> list[Values]:
        """The unknowns one by one, each in its shape."""
        if self.block.elementwise:
            each = [[row[k] for row in rows] for k in range(len(self.shapes))]
        else:
            ends = np.cumsum([0, *(node.size for node in self.block.nodes)])
            each = [list(rows[0][a:b]) for a, b in pairwise(ends)]
        return [_objects(values).reshape(shape) for values, shape in zip(each, self.shapes, strict=True)]

    def evaluated(self, at: Sequence[Sequence[Any]]) -> tuple[list[list[Any]], list[Any]]:
        """Residuals of each problem, and their derivatives by its unknowns."""
        given = dict(zip(self.block.nodes, self.apart(at), strict=True))
        balls = Balls({**self.under, **given})
        residuals = self.rows(balls.of(self.block.equations))
        slopes = tangents(balls, self.block)
        return residuals, slopes

    def step(self, at: Sequence[Sequence[Any]]) -> list[list[Any]]:
        """Newton's step of each problem; none where it has none."""
        residuals, slopes = self.evaluated(at)
        return [_solved(J, f) for J, f in zip(slopes, residuals, strict=True)]

    def minus(self, at: Sequence[Sequence[Any]], step: Sequence[Sequence[Any]]) -> list[list[Any]]:
        return [
            [x - d if d.is_finite() else x for x, d in zip(row, ds, strict=True)]
            for row, ds in zip(at, step, strict=True)
        ]

    def mapped(self, at: Sequence[Sequence[Any]], width: Sequence[Sequence[Any]]) -> list[list[Any] | None]:
        """What Krawczyk's operator makes of boxes about points, where that is inside them; None elsewhere."""
        residuals, _ = self.evaluated(at)
        boxes = [[x + arb(0, w) for x, w in zip(*pair, strict=True)] for pair in zip(at, width, strict=True)]
        _, slopes = self.evaluated(boxes)
        return [krawczyk(*each) for each in zip(at, boxes, residuals, slopes, strict=True)]


def krawczyk(at: Sequence[Any], box: Sequence[Any], residuals: Sequence[Any], slopes: Any) -> list[Any] | None:
    """What the operator makes of a box about a point, with its residuals there and its slopes in the box; or None."""
    n = len(at)
    if not all(x is not NONE and x.is_finite() for x in [*residuals, *slopes.entries()]):
        return None
    try:
        Y = arb_mat(n, n, [x.mid() for x in slopes.entries()]).inv()
    except ZeroDivisionError:
        return None
    Y = arb_mat(n, n, [y.mid() for y in Y.entries()])
    left = arb_mat(n, n, [float(i == j) for i in range(n) for j in range(n)]) - Y * slopes
    off = arb_mat(n, 1, [b - x for b, x in zip(box, at, strict=True)])
    new = arb_mat(n, 1, list(at)) - Y * arb_mat(n, 1, list(residuals)) + left * off
    inside = all(b.contains_interior(k) for b, k in zip(box, new.entries(), strict=True))
    return list(new.entries()) if inside else None


def _solved(J: Any, f: Sequence[Any]) -> list[Any]:
    n = len(f)
    lost = [arb.nan()] * n
    if not all(x is not NONE and x.is_finite() for x in [*f, *J.entries()]):
        return lost
    try:
        return list(J.solve(arb_mat(n, 1, list(f))).entries())
    except ZeroDivisionError:
        return lost


# --- derivatives by the unknowns ---------------------------------------------------------------------------------


def tangents(balls: Balls, block: Block) -> list[Any]:
    """Derivatives of the equations of a block by its unknowns, a matrix for each of its problems.

    In balls that enclose all slopes between any two points of the balls at hand; those of a choice that these leave
    open say nothing.
    """
    if block.elementwise:
        shape, n = balls.known[block.nodes[0]].shape, len(block.nodes)
        columns = [_tangent(balls, block, {node: _filled(shape, arb(1))}) for node in block.nodes]
        flat = [[np.broadcast_to(v, shape).reshape(-1) for v in column] for column in columns]
        return [arb_mat(n, n, [flat[j][i][k] for i in range(n) for j in range(n)]) for k in range(flat[0][0].size)]
    every = list[list[Any]]()
    for node in block.nodes:
        for k in range(node.size):
            unit = _filled(node.shape, arb(0))
            unit.reshape(-1)[k] = arb(1)
            every.append([x for v in _tangent(balls, block, {node: unit}) for x in v.reshape(-1)])
    n = len(every)
    return [arb_mat(n, n, [every[j][i] for i in range(n) for j in range(n)])]


def _tangent(balls: Balls, block: Block, moving: dict[Node, Values]) -> list[Values]:
    """How the equations of a block move where some unknowns do."""
    _move(block.equations, balls.known, moving, {*moving, *block.nodes, *block.under})
    shapes = [balls.known[r].shape for r in block.equations]
    return [
        np.broadcast_to(moving.get(r, _filled((), arb(0))), shape)
        for r, shape in zip(block.equations, shapes, strict=True)
    ]


def _move(roots: Iterable[Node], known: Mapping[Node, Values], moving: dict[Node, Values], done: set[Node]) -> None:
    """Add how all under some quantities moves, as far as it does."""
    for node in bottom_up(roots, done):
        done.add(node)
        if node.op == "iterated":  # by the turns that the worksheet took
            _move([turns := node.args[2]], known, moving, done)
            if turns in moving:
                moving[node] = moving[turns]
        elif any(operand in moving for operand in node.operands):
            moving[node] = _moved(node, known, moving)


def _moved(node: Node, known: Mapping[Node, Values], moving: Mapping[Node, Values]) -> Values:
    y, values = known[node], [known[operand] for operand in node.operands]
    motions = [moving.get(operand) for operand in node.operands]
    if node.op == "pow" or node.op in SMOOTH:
        values = [_known(_array(_counted, v) if _is_condition(v) else v) for v in values]
        if node.op == "pow":
            parts = _of_power(_known(y), values, motions[1] is not None)
        else:
            parts = SMOOTH[node.op](_known(y), *values)
        terms = [part * m for part, m in zip(parts, motions, strict=True) if m is not None]
        return np.asarray(np.broadcast_to(sum(terms[1:], terms[0]), y.shape), object)
    filled = [_filled(v.shape, arb(0)) if m is None else m for v, m in zip(values, motions, strict=True)]
    match node.op:
        case "abs":
            return np.asarray(_signed(values[0], filled[0]), object)
        case "max" | "min":
            greater = elementwise("gt" if node.op == "max" else "lt", values)
            return elementwise("where", [greater, *filled])
        case "where":
            return np.asarray(_open(_array(_conditions, values[0]), *filled[1:]), object)
        case "like":
            return np.broadcast_to(filled[0], y.shape)
        case "sized":
            return filled[0]
        case "take" | "join":
            return MADE[node.op](node, *filled)
        case "reduce" if node.args[2] == "sum":
            return MADE["reduce"](node, *filled)
        case "reduce" if node.args[2] in ("max", "min"):
            return _of_extreme(node, _known(values[0]), filled[0])
    return _filled(y.shape, arb(0)) if node.value.dtype == bool else _nothing(y.shape)


def _of_power(y: Values, values: Sequence[Values], by_exponent: bool) -> tuple[Values, ...]:
    """Slopes of a power by its base, and by its exponent where that moves."""
    a, b = values
    by_base = b * _known(elementwise("pow", [a, np.asarray(b - 1, object)]))
    return (by_base, y * _known(elementwise("log", [a]))) if by_exponent else (by_base, y)


def _of_extreme(node: Node, values: Values, moved: Values) -> Values:
    """How the largest or least of several moves: as each of those that may be it."""
    sizes, found = (values if node.args[2] == "max" else -values).reshape(-1), np.empty(len(node.args[1]), object)
    for n, group in enumerate(node.args[1]):
        largest = reduce(arb.max, sizes[group])
        found[n] = reduce(arb.union, moved.reshape(-1)[group][[not x < largest for x in sizes[group]]])
    return found.reshape(node.shape)


_signed = np.frompyfunc(lambda a, m: arb.nan() if a is NONE else a.sgn() * m, 2, 1)
# Between the two values of an open choice there is no slope.
_open = np.frompyfunc(lambda c, a, b: arb.nan() if c == UNDECIDED else a if c else b, 3, 1)


def _array(f: np.ufunc, values: Values) -> Values:
    return np.asarray(f(values), object)


def _exact(values: Values, node: Node) -> Values:
    number = node.op == "constant" and node.value.dtype != bool
    return _array(_balls, node.value.astype(object)) if number else values


_CHOOSING = {  # what they choose among
    "where": slice(1, 3), "iterated": slice(2, 3), **dict.fromkeys(("take", "at", "like", "sized"), slice(1)),
}  # fmt: skip


def _is_chosen(node: Node) -> bool:
    """Whether one of several numbers that somebody has written."""
    waiting, met = [node], set[Node]()
    while waiting:
        part = waiting.pop()
        if part in met or (part.op == "constant" and part is not node):
            continue
        met.add(part)
        if part.op != "join" and part.op not in _CHOOSING:
            return False
        waiting += part.args[0] if part.op == "join" else part.args[_CHOOSING[part.op]]
    return True


def _is_condition(values: Values) -> bool:
    return bool(values.size) and isinstance(values.reshape(-1)[0], float)


def _objects(values: Sequence[Any]) -> Values:
    array = np.empty(len(values), object)
    array[:] = values
    return array


def _filled(shape: tuple[int, ...], x: Any) -> Values:
    array = np.empty(shape, object)
    array.fill(x)
    return array


def _nothing(shape: tuple[int, ...]) -> Values:
    return _filled(shape, arb.nan())
