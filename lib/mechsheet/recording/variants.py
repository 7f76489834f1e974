"""Results of a worksheet for many variants of its inputs at once, by the recording of one run.

Every quantity that follows the inputs has an axis of variants in front of its own axes, whatever its line does with
these: so a line may take means and maxima, pick elements, or ask whether something holds, as one does for one machine.
"""

from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mechsheet.quantities.node import Block, Node, bottom_up
from mechsheet.quantities.operations import ELEMENTWISE, REDUCE, REDUCE_SO_FAR, Values
from mechsheet.quantities.quantity import Quantity
from mechsheet.readers.plan import NotPlanned
from mechsheet.readers.terms import Terms
from mechsheet.recording.planned import Followed, Results, results
from mechsheet.worksheet.cells import Worksheet, value
from mechsheet.worksheet.find import find
from mechsheet.worksheet.system import solve

_MOST = 100_000  # numbers of a quantity at a time: they fit a processor's cache


Together = Callable[[Mapping[str, NDArray[np.float64]]], tuple[dict[Node, Values], NDArray[np.bool_]]]


class Known(NamedTuple):
    """Results of all variants, by what is wanted, and of which of them the recording knows them."""

    values: dict[str, NDArray[Any]]
    known: NDArray[np.bool_]


@dataclass(frozen=True)
class Again:
    """What gives results from the inputs that vary, in SI, one number a variant, by the recording of one of these.

    Not known are those that the worksheet refuses, that have no number somewhere, and for which it goes another way.
    """

    found: Results
    compute: Together

    def __call__(self, given: Mapping[str, NDArray[np.float64]]) -> Known:
        found, (numbers, known) = self.found, self.compute(given)
        for node in dict.fromkeys(found.wanted):
            known = known & of_all(np.isfinite(numbers[node]))
        space = dict[str, Any]()
        for root, parts in found.parts.items():
            own = np.asarray(found.of.own[root])
            made = np.empty((len(known), *own.shape), complex if len(parts) > 1 or own.dtype.kind == "c" else float)
            each = [_under(numbers[part], len(part.shape), made.ndim - 1) for part in parts]
            if len(each) == 1:
                made[...] = each[0]
            else:
                made.real, made.imag = each
            space[root] = made
        return Known({name: value(name, space) for name in found.roots}, known)

    def terms(self, name: str) -> Values:
        """How large the numbers are of which a result of the recorded variant is a sum, in each of its elements."""
        graph = self.found.of.recording.graph
        return Terms(graph).recorded(Quantity(graph, *self.found.parts[self.found.roots[name]])).value


def variants(only: Worksheet, want: Sequence[str], g: Any, varied: Sequence[str]) -> Again:
    """What gives wanted results of variants of the ``varied`` inputs, all others of which are those of ``g``.

    The cells of ``only`` are all needed for the results. Raises NotPlanned where a quantity cannot be followed for many
    variants.
    """
    found = results(only, want, g)
    return Again(found, together(found.of, found.wanted, varied))


def together(of: Followed, wanted: Iterable[Node], varied: Sequence[str]) -> Together:
    """What gives quantities of a recording for many variants, in front of their own axes, and which of these it knows.

    Raises NotPlanned where a quantity cannot be followed for many variants.
    """
    wanted, inputs = [*dict.fromkeys(wanted)], of.recording.inputs
    for name in varied:
        if name in inputs and inputs[name].shape:
            raise NotPlanned(f"{name} is no single number")
    leaves = {inputs[name]: name for name in varied if name in inputs}
    roots = [*dict.fromkeys([*wanted, *of.same, *of.exist, *of.found])]
    order = [node for node in bottom_up(roots, leaves) if node.op not in ("constant", "input")]
    moving = _moving(order, leaves)
    order = [node for node in order if node in moving]
    for node in order:
        _check(node, moving)
    uses = Counter([*roots, *(operand for node in order for operand in node.operands)])

    @np.errstate(all="ignore")
    def some(given: Mapping[str, NDArray[np.float64]]) -> tuple[list[Values], NDArray[np.bool_]]:
        count = len(next(iter(given.values())))
        numbers: dict[Node, Values] = {node: given[name] for node, name in leaves.items()}
        left, solved = uses.copy(), dict[Block, list[Values]]()
        for node in order:
            numbers[node] = _number(node, numbers, solved)
            for operand in node.operands:
                left[operand] -= 1
                if not left[operand]:
                    numbers.pop(operand, None)  # of large fields there would be too many

        def whole(node: Node) -> Values:
            return np.broadcast_to(numbers.get(node, node.value), (count, *node.shape))

        known = np.ones(count, dtype=bool)
        for node in of.same:
            known &= of_all(whole(node))
        for node in (*of.exist, *of.found):
            known &= of_all(np.isfinite(whole(node)))
        return [whole(node) for node in wanted], known

    few = max(1, _MOST // max((node.size for node in order), default=1))

    def every(given: Mapping[str, NDArray[np.float64]]) -> tuple[dict[Node, Values], NDArray[np.bool_]]:
        starts = range(0, len(next(iter(given.values()))), few)
        parts = [some({name: x[at : at + few] for name, x in given.items()}) for at in starts]
        values = [np.concatenate(each) for each in zip(*(numbers for numbers, _ in parts), strict=True)]
        return dict(zip(wanted, values, strict=True)), np.concatenate([known for _, known in parts])

    return every


def of_all(holds: Values) -> NDArray[np.bool_]:
    """Of which variants a condition holds at all places."""
    return np.asarray(holds.reshape(len(holds), -1).all(1))


def _moving(order: Sequence[Node], leaves: Mapping[Node, str]) -> set[Node]:
    """Nodes that follow the inputs that vary."""
    moving = set(leaves)
    for node in order:
        if node.op != "length" and not moving.isdisjoint(node.operands):
            moving.add(node)
    return moving


def _check(node: Node, moving: set[Node]) -> None:
    if node.op not in ELEMENTWISE.keys() | _RULES.keys() | {"found"}:
        raise NotPlanned(node.op)
    if node.op == "found" and (node.args[0].method or not node.args[0].elementwise):
        raise NotPlanned("a Find whose equations are not of each number, or one of scipy's")


def _number(node: Node, numbers: Mapping[Node, Values], solved: dict[Block, list[Values]]) -> Values:
    if node.op == "found":
        block, number = node.args
        if block not in solved:
            solved[block] = _solved(block, numbers)
        unknown: Values = solved[block][number]
        return unknown
    operands = [numbers.get(operand, operand.value) for operand in node.operands]
    if node.op in ELEMENTWISE:
        return np.asarray(ELEMENTWISE[node.op](*_side_by_side(node, operands)))
    made: Values = _RULES[node.op](node, *operands)
    return made


def _side_by_side(node: Node, values: Sequence[Values]) -> list[Values]:
    """Operands as they are broadcast to each other, each with its variants in front of that."""
    most = max(len(operand.shape) for operand in node.operands)
    return [_under(x, len(operand.shape), most) for operand, x in zip(node.operands, values, strict=True)]


def _under(x: Values, own: int, axes: int) -> Values:
    """Numbers of so many axes of their own among those of more, behind the axes of the variants."""
    lead = x.ndim - own
    return x.reshape(*x.shape[:lead], *[1] * (axes - own), *x.shape[lead:]) if lead and own < axes else x


def _flat(source: Node, x: Values) -> Values:
    """Its own axes as one."""
    return x.reshape(*x.shape[: x.ndim - len(source.shape)], -1)


def _reduced(node: Node, x: Values) -> Values:
    source, _, kind, along = node.args
    f: Callable[..., Any] = REDUCE_SO_FAR[kind].accumulate if along.so_far else REDUCE[kind]
    if along.axis is None:
        found = np.asarray(f(_flat(source, x), axis=-1))
        return found.reshape(*found.shape[:1], *node.shape) if node.shape else found
    axis = along.axis if along.axis < 0 else along.axis - len(source.shape)
    return np.asarray(f(x, axis=axis) if along.so_far else f(x, axis=axis, keepdims=along.keepdims))


def _at(node: Node, x: Values, position: Values) -> Values:
    source, where = node.args
    flat, places = _flat(source, x), position
    inside = (places >= 0) & (places < source.size)
    index = np.where(inside, places, 0).astype(np.intp)
    if flat.ndim == 1 or position.ndim == len(where.shape):
        found = np.take(flat, index, axis=-1)
    else:
        found = np.take_along_axis(flat, _flat(where, index), axis=-1).reshape(*flat.shape[:-1], *where.shape)
    held: Values = np.where(inside, found, np.nan)
    return held


def _joined(node: Node, *values: Values) -> Values:
    sources, which, inside, _ = node.args
    flat = [_flat(source, x) for source, x in zip(sources, values, strict=True)]
    lead = np.broadcast_shapes(*(x.shape[:-1] for x in flat))
    whole = np.concatenate([np.broadcast_to(x, (*lead, x.shape[-1])) for x in flat], axis=-1)
    starts = np.cumsum([0, *(source.size for source in sources)])[:-1]
    return np.asarray(np.take(whole, starts[which] + inside, axis=-1))


_RULES: dict[str, Callable[..., Values]] = {
    "take": lambda node, x: np.take(_flat(node.args[0], x), node.args[1], axis=-1),
    "at": _at,
    "join": _joined,
    "reduce": _reduced,
}


def _solved(block: Block, numbers: Mapping[Node, Values]) -> list[Values]:
    """The unknowns of a block for all variants, and the evaluations of its equations."""

    given = {*block.under, *block.nodes}
    order = [node for node in bottom_up(block.residuals, given) if node.op != "constant"]

    def residuals(*x: Any) -> list[Values]:
        inner = {**numbers, **dict(zip(block.nodes, map(np.asarray, x), strict=True))}
        for node in order:
            inner[node] = _number(node, inner, {})
        return [inner.get(node, node.value) for node in block.residuals]

    axes = max(len(node.shape) for node in block.nodes)
    starts = {
        name: [_under(numbers.get(n, n.value), len(n.shape), axes) for n in nodes]
        for name, nodes in block.starts.items()
    }
    if block.single:
        lo, hi, guess = ((starts.get(name) or (None,))[0] for name in ("lo", "hi", "guess"))
        return [np.asarray(find(lambda x: residuals(x)[0], lo, hi, guess=guess).value)]
    places: dict[str, Any] = {name: tuple(ends) if len(ends) > 1 else ends[0] for name, ends in starts.items()}
    found = solve(
        lambda **x: tuple(residuals(*x.values())), 0.0, block.unit, block.unknown_unit, places, least=block.least
    )
    return [np.asarray(v) for v in (*found.value, found.evaluations)]
