"""Find while a worksheet is recorded: values that its equations determine, as quantities that can be solved again."""

from collections import namedtuple
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from itertools import count
from typing import Any

import numpy as np

from mechsheet import units
from mechsheet.quantities.graph import Graph, NotRecorded
from mechsheet.quantities.lines import Solved, Told
from mechsheet.quantities.node import Block, Node, bottom_up
from mechsheet.quantities.operations import regrouped
from mechsheet.quantities.quantity import Quantity, has_quantity, lift
from mechsheet.readers import derived
from mechsheet.worksheet.find import Found
from mechsheet.worksheet.system import Solution
from mechsheet.worksheet.verdict import Verdict


@dataclass
class Solving:
    """What `find` gives while recording; the ``value`` of several unknowns is a named tuple of quantities."""

    value: Any
    residual: Any
    solved: tuple[Solved, ...]
    evaluations: Any = None

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        raise NotRecorded(f"{name} of what is found")


class _OfSeveral(NotRecorded, Exception):
    """What a recording does not hold of several places at once; a search then goes to one after the other."""


@contextmanager
def tried(graph: Graph) -> Iterator[Callable[[Callable[..., Any]], Callable[..., Any]]]:
    """What lets a function of the worksheet be tried at plain numbers; what is looked at meanwhile is of no use."""

    def place(x: Any) -> Quantity:
        return Quantity(graph, graph.constant(x, units.UNKNOWN))

    def of(f: Callable[..., Any]) -> Callable[..., Any]:
        def at(*x: Any, **unknowns: Any) -> Any:
            try:
                return now(f(*map(place, x[:1]), *x[1:], **{name: place(y) for name, y in unknowns.items()}))
            except NotRecorded as error:
                if any(np.size(each) > 1 for each in (*x[:1], *unknowns.values())):
                    raise _OfSeveral(*error.args) from None
                raise

        return at

    looked, work = dict(graph.looked), graph.work
    try:
        yield of
    finally:
        graph.looked, graph.work = looked, work


def now(x: Any) -> Any:
    """Present numbers."""
    if isinstance(x, Quantity):
        return x.value
    return regrouped(x, map(now, x)) if isinstance(x, tuple | list) and has_quantity(x) else x


def listed(graph: Graph, values: Any) -> Any:
    """Values of the worksheet's own run at the positions that are recorded."""
    array = np.asarray(values)
    for axis, size in enumerate(array.shape):
        if graph.thin > 1 and size == graph.positions:
            array = array.take(range(0, size, graph.thin), axis)
    return array


def one(
    graph: Graph,
    found: Found,
    f: Callable[..., Any],
    given: dict[str, Any],
    equals: Any,
    branch: Any,
    branches: Any,
    method: str = "",
) -> Solving:
    """A value of one equation, as it was found from what is ``given`` of its interval and its guess."""

    def solved_by(n: int) -> tuple[Block, Solving]:
        starts = {k: (lift(graph, x).re,) for k, x in given.items() if x is not None}
        block = Block(starts, single=True, method=method)
        name = f"{found.words.unknown}, line {graph.line}, {n}"
        block.nodes = (graph.found(block, 0, name, listed(graph, found._value)),)
        x, target = Quantity(graph, block.nodes[0]), lift(graph, equals)
        value = lift(graph, f(x, branch) if branch is not None else f(x))
        left = value - target
        block.residuals, block.sides = (left.re,), (value.re, target.re)
        if branch is not None:
            block.branch = lift(graph, branch).re
            with graph.labelled({**graph.labels}):  # only the wanted branch has steps with names
                block.branches = {s: lift(graph, f(x, s)).re for s in branches}
        block.rest()
        block.seen = _seen(graph, block)
        words = found.words
        told = Told(words.unknown, words.quantity, words.unit, words.unknown_unit)
        ends = (starts["lo"][0], starts["hi"][0]) if starts.keys() >= {"lo", "hi"} else None
        alone = target.re if target.single else None
        solved = Solved(block.nodes[0], left.re if left.single else None, ends, told, target=alone)
        return block, Solving(x, left, (solved,))

    return _first(solved_by)


def several(graph: Graph, found: Solution, f: Callable[..., Any], equals: Any, unknowns: Mapping[str, Any]) -> Solving:
    """Values of several equations, as they were found."""

    def solved_by(n: int) -> tuple[Block, Solving]:
        words = found.words
        given = {name: x if isinstance(x, tuple) else (x,) for name, x in unknowns.items()}
        starts = {name: tuple(lift(graph, v).re for v in values) for name, values in given.items()}
        block = Block(starts, False, found.least, words.equation_units, words.units)
        name = f"{words.unknowns}, line {graph.line}, {n}"
        values = [listed(graph, v) for v in (*found._values, found.evaluations)]
        *block_nodes, evaluations = (graph.found(block, k, name, value) for k, value in enumerate(values))
        block.nodes = tuple(block_nodes)
        x = [Quantity(graph, node) for node in block.nodes]
        equations = f(**dict(zip(words.names, x, strict=True)))
        parts = equations if isinstance(equations, tuple | list) else [equations]
        wanted = equals if isinstance(equals, tuple | list) else [equals] * len(parts)
        left = [part for e, w in zip(parts, wanted, strict=True) for part in _parts(lift(graph, e - w), block.nodes[0])]
        if len(left) != len(words.equations):
            raise NotRecorded(f"{len(left)} equations where the worksheet has {len(words.equations)}")
        block.residuals = tuple(part.re for part in left)
        if block.least:
            block.level = _level(block)
        block.targets = tuple(dict.fromkeys(n for w in wanted for n in lift(graph, w).parts if n.op != "constant"))
        block.rest()
        block.seen = _seen(graph, block)
        solved = []
        for k, (node, unknown, unit) in enumerate(zip(block.nodes, words.names, words.units, strict=True)):
            told = Told(unknown, words.equations[k], words.equation_units[k], unit)
            residual = left[k].re if left[k].single else None
            ends = starts[unknown]
            solved.append(Solved(node, residual, (ends[0], ends[-1]), told))
        value = namedtuple("Values", words.names)(*x)
        return block, Solving(value, tuple(left), tuple(solved), Quantity(graph, evaluations))

    return _first(solved_by)


def _first(solved: Callable[[int], tuple[Block, Solving]]) -> Solving:
    """The solve block of this line that asks the same, else a new one: a line may ask several things, one by one."""
    for n in count():
        block, new = solved(n)
        known = block.nodes[0].args[0]
        if known is block or known.asked == block.asked:
            return new
    raise AssertionError


def _seen(graph: Graph, block: Block) -> bool:
    """Whether Python looks at the unknowns of a block, of which only its equations know yet, but for their numbers."""
    conditions = (condition for condition in graph.looked if condition not in graph.counts)
    return not set(block.nodes).isdisjoint(bottom_up(conditions, ()))


def _level(block: Block) -> tuple[Node, ...]:
    """Slopes of the sum of squares by the unknowns, which are 0 where it is least; none where they are not known."""
    block.rest()
    graph = Graph()  # of its own: the worksheet does not compute them
    if not block.elementwise:
        return ()
    try:
        equations, _ = derived.at({node: Quantity(graph, node) for node in block.nodes}, block.residuals)
    except NotRecorded:
        return ()
    counts = [units.parse(unit).factor ** -2 for unit in block.unit]
    level = []
    for k, node in enumerate(block.nodes):
        terms = [count * x * slopes[k] for (x, slopes), count in zip(equations, counts, strict=True) if k in slopes]
        level.append((sum(terms[1:], terms[0]) if terms else lift(graph, 0.0)).like(Quantity(graph, node)).re)
    return tuple(level)


def kept(graph: Graph, own: Verdict, exported: Callable[[Any], Quantity]) -> Solving:
    """The values of the worksheet's own run, where the equations are not recorded."""
    if isinstance(own, Solution):
        words, values = own.words, [exported(v) for v in own._values]
        told = [
            Told(name, equation, unit, own_unit)
            for name, equation, unit, own_unit in zip(
                words.names, words.equations, words.equation_units, words.units, strict=False
            )
        ]
        solved = tuple(Solved(v.re, None, None, t) for v, t in zip(values, told, strict=False))
        named = namedtuple("Values", words.names)(*values)
        return Solving(named, tuple(map(exported, own.residual)), solved, exported(own.evaluations))
    if isinstance(own, Found):
        value, w = exported(own._value), own.words
        told_one = Told(w.unknown, w.quantity, w.unit, w.unknown_unit)
        return Solving(value, exported(own.residual), (Solved(value.re, None, None, told_one),))
    raise NotRecorded(f"a verdict of the kind {type(own).__name__}")


def _parts(equation: Quantity, like: Node) -> list[Quantity]:
    """The real equations of one, in the shape of the problems."""
    whole = equation.like(Quantity(equation.graph, like))
    return [whole.real, whole.imag] if equation.im is not None else [whole]
