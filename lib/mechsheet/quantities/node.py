"""One quantity of a recording: an operation on others, with its values."""

from collections.abc import Callable, Container, Iterable, Iterator, Mapping, Sequence, Set
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from mechsheet.quantities.operations import ELEMENTWISE, Values

LEAVES = ("constant", "input")


@dataclass(eq=False)
class Block:
    """A solve block: its unknowns are the ``nodes`` at which the ``residuals`` vanish, which themselves rest on these.

    ``starts`` are the quantities that it was given, by their names: ``lo``, ``hi`` and ``guess`` of a ``single``
    unknown, else the guess or the two ends of each. ``under`` are all that it rests on but its own unknowns. Where all
    is ``elementwise``, the residuals of many values of the unknowns are those of each. The residual of a ``single`` one
    is the difference of two ``sides``: the quantity and what it shall equal; those of several have ``targets``. On the
    assembly ``branches`` the quantity is another one; that of the first side is on the ``branch`` that is wanted.
    Where squares are made ``least``, the slopes of their sum by the unknowns are ``level``: none where not known.
    Where Python has ``seen`` something of the unknowns, residuals are those of the worksheet while that is the same.
    A root that scipy finds between two ends is that of its ``method``: of several the one that this leads to.
    """

    starts: Mapping[str, tuple["Node", ...]]
    single: bool
    least: bool = False
    unit: tuple[str, ...] = ()
    unknown_unit: tuple[str, ...] = ()
    nodes: tuple["Node", ...] = ()
    residuals: tuple["Node", ...] = ()
    level: tuple["Node", ...] = ()
    under: tuple["Node", ...] = ()
    elementwise: bool = True
    sides: tuple["Node", ...] = ()
    targets: tuple["Node", ...] = ()
    branch: "Node | None" = None
    branches: Mapping[int, "Node"] = field(default_factory=dict)
    seen: bool = False
    method: str = ""

    @property
    def equations(self) -> tuple["Node", ...]:
        """What vanishes at the unknowns."""
        return self.level if self.least else self.residuals

    @property
    def asked(self) -> tuple[Any, ...]:
        """What tells it from other blocks of the same unknowns."""
        return self.starts, self.residuals, self.sides, self.targets, self.branch, self.branches, self.method

    def rest(self) -> None:
        """Find out what the block rests on, once its residuals are known."""
        given = [n for nodes in self.starts.values() for n in nodes]
        given += [*self.sides[1:], *self.targets, *([] if self.branch is None else [self.branch])]
        own, self.under = _resting(self.nodes, [*self.residuals, *self.level, *self.branches.values()], given)
        self.elementwise = all(node.op in ELEMENTWISE for node in own)


class Loop:
    """A loop that ends by what it computes: the ``nodes`` of its state, of which a turn makes the ``following`` ones.

    It begins with the ``initial`` numbers and ends where ``done`` holds after a turn, or after the ``most`` turns;
    ``under`` are all that it rests on but its own state.
    """

    def __init__(
        self,
        nodes: Sequence["Node"],
        initial: Sequence["Node"],
        following: Sequence["Node"],
        done: "Node",
        most: int | None,
    ) -> None:
        self.nodes, self.initial, self.following, self.done, self.most = nodes, initial, following, done, most
        _, self.under = _resting(nodes, [done, *following], initial)


def _resting(
    nodes: Iterable["Node"], made: Sequence["Node"], given: Iterable["Node"]
) -> tuple[list["Node"], tuple["Node", ...]]:
    """What rests on some nodes, of all that is made of these, and what else that rests on, beside what is given."""
    own, under, rests = set(nodes), dict[Node, None](), list[Node]()
    for node in bottom_up(made, own):
        if not own.isdisjoint(node.operands):
            own.add(node)
            rests.append(node)
            under |= dict.fromkeys(operand for operand in node.operands if operand not in own)
    known = [*(node for node in under if node not in own), *(node for node in made if node not in own), *given]
    return rests, tuple(dict.fromkeys(node for node in known if node.op != "constant"))


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Node:
    """One real quantity of any shape: an operation on other quantities, with its values.

    It never changes, nor do its values. A node equals only itself: what a reader finds out about nodes it keeps in a
    table of its own, with the node as the key. ``line`` is the line of the worksheet that made it first, 0 for none.

    Operations are those of `ELEMENTWISE`, on operands that are broadcast to each other, and

    ==========================  ====================================================================================
    ``constant``, ``input``     numbers, with a unit where they have one; an input
    ``rows`` (count)            the numbers 0, 1, 2 .. of so many rows
    ``length`` (source, axis)   how many elements there are along an axis, which is counted from the last one
    ``found`` (block, number)   one of the unknowns that a `Block` finds; after them its evaluations of the equations
    ``state`` (initial)         one of the numbers that a `Loop` changes, at any of its turns
    ``iterated`` (loop, ..)     what its ``number`` is in the end; by some ``turns`` alone while it ends in them
    ``exported``                numbers of the worksheet's own run, which rest on its operands nobody knows how
    ``take`` (source, ..)       elements by their flat positions, in the shape of these
    ``at`` (source, position)   elements by positions that are a quantity themselves
    ``join`` (sources, ..)      elements of several sources: which source, and which element of it
    ``reduce`` (source, ..)     of each group of flat positions what the kind says, one of `REDUCE`
    ==========================  ====================================================================================

    A quantity ``stretches`` whose shape follows a number of rows that is a quantity. Positions are those of the present
    number; `Moved` says what they are for others.
    """

    op: str
    args: tuple[Any, ...]
    value: Values
    line: int = 0
    stretches: bool = False

    @property
    def shape(self) -> tuple[int, ...]:
        return self.value.shape

    @property
    def size(self) -> int:
        return self.value.size

    @property
    def operands(self) -> tuple["Node", ...]:
        found = _OPERANDS.get(self.op)
        return self.args if found is None else found(self.args)


_OPERANDS: dict[str, Callable[[tuple[Any, ...]], tuple[Node, ...]]] = {  # of operations that have other arguments too
    **dict.fromkeys(LEAVES, lambda args: ()),
    **dict.fromkeys(("found", "iterated"), lambda args: args[0].under),  # not known yet when the node is made
    **dict.fromkeys(("take", "reduce", "length"), lambda args: args[:1]),
    "join": lambda args: args[0],
}


def bottom_up(roots: Iterable["Node"], known: Container["Node"]) -> Iterator["Node"]:
    """Nodes under ``roots`` that are not ``known`` yet, each once and after its operands."""
    stack, begun, done = [*roots], set[Node](), set[Node]()
    while stack:
        node = stack[-1]
        if node in begun:
            stack.pop()
            if node in done or node in known:
                continue
        elif node in known:
            stack.pop()
            continue
        else:
            begun.add(node)
            found = _OPERANDS.get(node.op)  # as its operands, of which there are thousands
            if below := [each for each in (node.args if found is None else found(node.args)) if each not in begun]:
                stack += below
                continue
            stack.pop()
        done.add(node)
        yield node


def free_of(nodes: Iterable["Node"], made: Iterable["Node"]) -> bool:
    """Whether nothing that is made rests on some nodes."""
    own = set(nodes)
    roots = [*made]
    return own.isdisjoint(roots) and all(own.isdisjoint(node.operands) for node in bottom_up(roots, own))


def steps_of(node: Node, parts: Callable[[Node], Iterable[Node]], known: Container[Node]) -> Iterator[Node]:
    """What a quantity is made of by its ``parts``, but for what is ``known``: each once, after its own parts."""
    seen, stack = set[Node](), [(node, iter(parts(node)))]
    while stack:
        whole, rest = stack[-1]
        part = next((part for part in rest if part not in seen and part not in known), None)
        if part is not None:
            seen.add(part)
            stack.append((part, iter(parts(part))))
        else:
            stack.pop()
            if stack:
                yield whole


def has_equation(found: Node) -> bool:
    """Whether a quantity that is found is one of as many unknowns as its block has equations, which it solves."""
    block, number = found.args
    return bool(number < len(block.nodes) == len(block.equations))


def passes_over(node: Node) -> bool:
    """Whether an operation has a number where an operand is none: nobody may take a number not known for none."""
    return node.op == "finite" or (node.op == "reduce" and node.args[2].startswith("nan"))


def conditions(node: Node, known: dict[Node, frozenset[Node]]) -> frozenset[Node]:
    """Conditions where a quantity is no number in all its elements unless they hold, as it is chosen already.

    What is ``known`` of others is not looked for again, and added to.
    """
    none = frozenset[Node]()
    for part in bottom_up([node], known):
        under = [known[operand] for operand in part.operands]
        match part.op:
            case "where" if part.args[2].op == "constant" and np.isnan(part.args[2].value).all():
                known[part] = under[1] | {part.args[0]}
            case "where":
                known[part] = under[1] & under[2]
            case "sized":
                known[part] = under[0] | {part.args[1]}
            case "join":
                known[part] = frozenset.intersection(*under)
            case "pow" if part.args[1].op != "constant" or not part.args[1].value.all():
                known[part] = none
            case "lt" | "le" | "gt" | "ge" | "eq" | "ne" | "and" | "or" | "not" | "finite":
                known[part] = none
            case "reduce" if part.args[2] not in ("sum", "prod", "max", "min"):
                known[part] = none
            case _:
                known[part] = none.union(*under)
    return known[node]


def is_number(node: Node, number: float) -> bool:
    """Whether a node is this constant, without a unit."""
    return node.op == "constant" and not node.args and node.shape == () and bool(node.value == number)


def is_whole(
    node: Node,
    known: Set[Node],
    counted: Set[Node] = frozenset(),
    any_way: bool = False,
    of_lists: Set[Node] = frozenset(),
) -> bool:
    """Whether Python has a whole number there, where it has one at all; of some it is known, or they are as good.

    With ``any_way`` if it has one on any way of a condition, as each element of what is made ``of_lists`` may.
    """
    here = node.value
    if not any_way and here.dtype.kind == "f" and (np.floor(here) < here).any():  # as of most: none looks further
        return False
    waiting, met, turned = [node], set[Node](), dict[Node, tuple[Node, Node]]()
    while waiting:
        part = waiting.pop()
        if part in met or part in known or part in counted or (part.value.dtype.kind in "iu" and part not in turned):
            continue
        met.add(part)
        if part in turned:
            waiting += turned[part]
            continue
        match part.op:
            case "iterated":  # from the first turn on, as long as each leaves it so
                loop, number, _ = part.args
                turned |= zip(loop.nodes, zip(loop.initial, loop.following, strict=True), strict=True)
                waiting.append(loop.nodes[number])
            case "sized" | "like" | "take" | "at":
                waiting.append(part.args[0])
            case "join":
                waiting += part.args[0]
            case "where" | "max" | "min":
                ways = [way for way in part.operands if way.op not in LEAVES or not np.isnan(way.value).all()]
                ways = ways[part.op == "where" :]
                each = part.shape == () or part in of_lists
                if not (any_way and each and any(is_whole(way, known) for way in ways)):
                    waiting += ways
            case "add" | "sub" | "mul" | "neg" | "mod" | "abs":
                waiting += part.args
            case _:
                return False
    return True
