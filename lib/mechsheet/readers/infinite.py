"""Numbers that cells of a spreadsheet would not have: behind an infinite one, and where rounding decides a whole one.

A cell holds no infinite number and has an error value there. What is next to a whole number is that to LibreOffice.
"""

import math
from collections.abc import Iterable, Iterator, Mapping
from typing import Any

import numpy as np

from mechsheet.quantities.graph import Gap
from mechsheet.quantities.lines import Recording
from mechsheet.quantities.node import LEAVES, Node, bottom_up, passes_over
from mechsheet.quantities.operations import ELEMENTWISE, SHAPED, Values
from mechsheet.readers.numbers import moved_elements
from mechsheet.worksheet import numbers

_KEEPING = ("neg", "abs", "max", "min", "where")  # give an infinite number of infinite ones alone
_MOVING = ("take", "join", *SHAPED, "at")
_COMPARING = ("lt", "le", "gt", "ge", "eq", "ne", "and", "or", "not", "finite")
_EXTREME = ("max", "min", "nanmax", "nanmin")
_ARITHMETIC = ("add", "sub", "mul", "div")
_WHY = "where an infinite number stands on its way, which no cell holds, the workbook has this of the exported inputs"
_BESIDE = "the workbook has this of the exported inputs: a whole number, or the one below, by rounding alone"


def lose(recording: Recording) -> None:
    """Let what cells would miss, or have otherwise, keep the numbers of the worksheet's own run.

    `Recording.lost` are these quantities, `Recording.unsolved` says where they stand.
    """
    lines = (line.node for lines in recording.lines.values() for line in lines)
    shown = [*lines, *recording.shown()]
    nodes = [*bottom_up(shown, ())]
    counted = _counted(nodes)
    beside = {node for node in nodes if (node.op in _WHOLE or node in counted) and _is_beside(node)}
    behind = lost(shown) if any(map(_is_infinite, nodes)) else ()
    recording.lost = {node: passes_over(node) for node in behind} | dict.fromkeys(beside, True)
    for told, why in ((recording.lost.keys() - beside, _WHY), (beside, _BESIDE)):
        places = {node.line: dict.fromkeys(_named(recording, node)) for node in told}
        recording.unsolved += (Gap((*names,) or ("a step",), line, why) for line, names in sorted(places.items()))


def _is_infinite(node: Node) -> bool:
    values = node.value
    if values.dtype.kind != "f":
        return False
    return math.isinf(values.item()) if values.size == 1 else not np.isfinite(values).all()


@np.errstate(all="ignore")
def _is_beside(node: Node) -> bool:
    """Whether it is by the rounding of its operands alone that a number is whole, or two compare as they do."""
    x, *others = (np.asarray(part.value, float) for part in node.args)
    if node.op in (*_COMPARED, *_ORDERED):
        size = np.maximum(np.abs(x), np.abs(others[0]))
        return bool(((np.abs(x - others[0]) <= numbers.ROUNDING * size) & (x != others[0])).any())
    x = x / others[0] if others else x
    off = x - np.rint(x) if node.op != "round" else x - np.floor(x) - 0.5
    near = np.abs(off) <= numbers.ROUNDING * np.maximum(np.abs(x), 1.0)
    return bool((near & (node.value != 0 if node.op == "mod" else off != 0)).any())


_COMPARED = ("eq", "ne")  # pieces that others part are mostly alike where they meet
_WHOLE = {"floor", "round", "mod", *_COMPARED}
_ORDERED = ("lt", "le", "gt", "ge")


def _counted(nodes: Iterable[Node]) -> set[Node]:
    """Comparisons by which numbers are counted: the counts are not alike where they meet."""
    sums = [node.args[0] for node in nodes if node.op == "reduce" and node.args[2] == "sum"]
    waiting = [node.args[0] for node in sums if node.op == "where" and _are_unlike(*node.args[1:])]
    found = set[Node]()
    while waiting:
        node = waiting.pop()
        if node not in found and node.op in (*_ORDERED, *_MOVING, "and", "or", "not", "where"):
            found.add(node)
            waiting += [] if node.op in _ORDERED else node.operands
    return {node for node in found if node.op in _ORDERED}


def _are_unlike(x: Node, y: Node) -> bool:
    return x.op == y.op == "constant" and not np.array_equal(x.value, y.value)


def _named(recording: Recording, node: Node) -> Iterator[str]:
    """The lines of a quantity's line of the worksheet, else those that rest on it at once."""
    lines = [line for lines in recording.lines.values() for line in lines if line.text]
    own = [line.symbol for line in lines if line.node.line == node.line]
    yield from own or (line.symbol for line in lines if node in line.node.operands)


def endless(node: Node, known: dict[Node, bool]) -> bool:
    """Whether cells of a quantity may hold what stands for an infinite number there; ``known`` is added to.

    It comes of a constant that is infinite, which is chosen, compared, moved, or computed with by a number.
    """
    for part in bottom_up([node], known) if node not in known else ():
        if part.op in ("constant", "exported"):
            known[part] = part.value.dtype.kind == "f" and bool(np.isinf(part.value).any())
        elif part.op in _ARITHMETIC:
            first, second = (known.get(operand, False) for operand in part.args)
            known[part] = first > second if part.op == "div" else first != second
        else:
            over = _read(part)[part.op == "where" :]
            extreme = part.op == "reduce" and part.args[2] in _EXTREME
            known[part] = (extreme or part.op in (*_KEEPING, *_MOVING)) and any(known.get(x, False) for x in over)
    return known[node]


def carries(node: Node, known: dict[Node, bool]) -> bool:
    """Whether it is a sum, product or quotient of a number and what is ``endless``, which has a value all the same."""
    return node.op in _ARITHMETIC and sum(endless(operand, known) for operand in node.args) == 1


def lost(roots: Iterable[Node]) -> Iterator[Node]:
    """Quantities with elements that are numbers or truths though an infinite number stands on their way.

    One that is chosen by a condition, moved, or compared with a constant that is infinite is not among them.
    """
    errors, known = dict[Node, Values](), dict[Node, bool]()  # elements that a cell would have as an error value
    for node in bottom_up(roots, ()):
        wrong = _errors(node, errors, known)
        if wrong is None:
            continue
        there = True if node.value.dtype == bool else np.isfinite(node.value)
        if np.any(wrong & there) or (passes_over(node) and node.op == "reduce"):
            yield node
        else:
            errors[node] = wrong


def _errors(node: Node, errors: Mapping[Node, Values], known: dict[Node, bool]) -> Values | None:
    """The elements of a quantity that a cell would have as an error value; None for none."""
    if node.op in (*LEAVES, "rows", "length", "exported", "found", "state"):
        return None
    taking = _takes(node) or carries(node, known)
    unheld = [x for x in _read(node) if x in errors or (not taking and endless(x, known))]
    wrong = np.asarray(_made(node, known))
    if unheld:
        masks = [errors.get(x, np.isinf(x.value)) if x in unheld else np.zeros(x.shape, bool) for x in _read(node)]
        wrong = wrong | _over(node, masks)
    return wrong if wrong.any() else None


def _takes(node: Node) -> bool:
    """Whether an operation has a value of what stands for an infinite number."""
    if node.op == "reduce":
        return node.args[2] in _EXTREME or node.args[2].startswith("arg")
    return node.op in (*_KEEPING, *_MOVING, *_COMPARING)


def _read(node: Node) -> tuple[Node, ...]:
    """The operands whose elements an operation reads."""
    if node.op == "iterated":
        return node.args[2:]
    return node.operands[:1] if node.op in SHAPED else node.operands


def _over(node: Node, masks: list[Values]) -> Values:
    match node.op:
        case "where":
            chosen, first, second = masks
            return np.asarray(chosen | np.where(node.args[0].value, first, second))
        case "take" | "join":
            return moved_elements(node, masks)
        case "at":
            source, position = masks
            place = np.clip(node.args[1].value, 0, source.size - 1).astype(np.intp)
            return np.asarray(position | source.reshape(-1)[place])
        case "reduce":
            groups: Any = node.args[1]
            return np.array([masks[0].reshape(-1)[group].any() for group in groups]).reshape(node.shape)
        case "finite":
            return np.zeros(node.shape, bool)
    return np.broadcast_to(np.logical_or.reduce(np.broadcast_arrays(*masks)), node.shape)


def _made(node: Node, known: dict[Node, bool]) -> Any:
    """The elements in which an operation itself may make an infinite number."""
    made = node.op in ELEMENTWISE and node.op not in (*_KEEPING, *SHAPED) and np.isinf(node.value)
    if made is not False and carries(node, known):
        return made & ~np.logical_or.reduce(np.broadcast_arrays(*(np.isinf(x.value) for x in node.args)))
    return made
