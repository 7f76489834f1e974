"""A found value without a closed form as a search for it, in operations that a cell of a workbook has as well.

That of one equation closes in on its change of sign nearest the guess; of several they are the `stepped` ones.
"""

from collections.abc import Iterator, Sequence
from contextlib import suppress
from typing import Any, NamedTuple

import numpy as np

from mechsheet.quantities.arithmetic import choice
from mechsheet.quantities.graph import Gap, Graph, Label, NotRecorded
from mechsheet.quantities.lines import Recording, Solved, leaves_of
from mechsheet.quantities.node import Block, Node, bottom_up
from mechsheet.quantities.operations import Values
from mechsheet.quantities.quantity import Quantity, lift, moved
from mechsheet.readers.confirmed import confirm
from mechsheet.readers.problems import alike, bounded, numbers_under
from mechsheet.readers.replaced import replaced
from mechsheet.readers.stepped import steps

PLACES = 97  # of the first look at the whole interval, dense at its ends
_FIRST = (1 - np.cos(np.linspace(0, np.pi, PLACES))) / 2
_LATER, _LOOKS = np.linspace(0, 1, 17), 15  # of each later one at the part in which the residual changes its sign
_EARLY = 4  # looks that count changes of sign; later ones may meet rounding
_NEAR, _AT_END = 0.45, 1e-9  # of the residual beside a place, that there may be a root about without a change of sign
_MOST = 500_000  # operations on single numbers: it tries many places of which one is the root
_NEAREST = f"the nearest change of sign of {PLACES} places"
_NOWHERE = 1e300  # how far away a change of sign is that there is not
_LESS = 0.1  # of the residual in the last early look may be left in the end: more is a jump or a pole


def search(recording: Recording) -> None:
    """Give found values without a closed form that solves the equations the search for them in its place.

    It has no value where that of the worksheet is not sure to be the same: of one equation where its places show no
    change of sign, none that is surely nearest, or that there may be more. What it doesn't find for the inputs at hand
    keeps the number of the worksheet's own run; `Recording.unsolved` says which found values do so whatever there is,
    and why.
    """
    blocks = dict[Block, list[Solved]]()
    for solved in recording.found.values():
        if solved.node.op == "found":
            blocks.setdefault(solved.node.args[0], []).append(solved)
    for block, unknowns in blocks.items():
        recording.graph.line = block.nodes[0].line
        try:
            with np.errstate(all="ignore"):  # the equations need not have a value everywhere
                _know(recording, block, unknowns)
        except NotRecorded as reason:
            for solved in unknowns:
                solved.inverse, solved.searched = None, ""
            recording.unsolved.append(Gap(_named(recording, unknowns), block.nodes[0].line, f"{_KEPT}: {reason}"))
        for solved in unknowns:
            recording.define_steps("Search" if solved.searched else _section(recording, solved.node), solved)
    recording.unsolved += _counted(recording)


def _know(recording: Recording, block: Block, unknowns: Sequence[Solved]) -> None:
    """Let unknowns be known by closed forms that solve the equations, else by the search for them."""
    if len(unknowns) == len(block.nodes) and all(solved.inverse for solved in unknowns):
        with suppress(NotRecorded):
            confirm(recording, block, unknowns)
            return
        for solved in unknowns:
            solved.inverse = None
    if block.seen:
        raise NotRecorded("in its equations Python looks at what is found")
    graph = recording.graph
    found = [_root(graph, block, unknowns[-1].words.unknown_unit)] if block.single else steps(graph, block)
    roots = {n: _at_hand(recording, n, x) for n, x in zip(block.nodes, found, strict=True)}
    for solved in unknowns:
        if solved.inverse is None:
            solved.inverse = roots[solved.node]
            solved.searched = _NEAREST if block.single else "Newton's steps from its guess"
    if not all(solved.searched for solved in unknowns):
        confirm(recording, block, unknowns)


def _section(recording: Recording, node: Node) -> str:
    """Where a found value is a line."""
    with_it = (title for title, lines in recording.lines.items() if any(line.node is node for line in lines))
    return next(with_it, "Search")


def _counted(recording: Recording) -> Iterator[Gap]:
    """Counts of evaluations and estimates of errors that are shown: they hang on the worksheet's own search or rule."""
    columns = (part for table in recording.tables.values() for c in table if c is not None for part in c.parts)
    estimates = {*recording.integrals.values()}
    judged = (part for check in recording.checks.values() for part in check.parts)
    for node in bottom_up([*columns, *judged], ()):
        count = node.op == "found" and node.args[1] == len(node.args[0].nodes)
        if count or node in estimates:
            names = tuple(name for known, name in recording.names.items() if node in (known, *known.operands))
            what = "how often the equations are evaluated" if count else "scipy's estimate of the error of an integral"
            yield Gap(names, node.line, f"{_KEPT}: {what}")


_KEPT = "the workbook has this of the exported inputs"


def _named(recording: Recording, unknowns: Sequence[Solved]) -> tuple[str, ...]:
    """The lines that are what a block finds, else its unknowns in words."""
    return tuple(recording.names.get(solved.node, solved.words.unknown) for solved in unknowns)


def _at_hand(recording: Recording, found: Node, root: Any) -> Node:
    """A root, with the numbers of the worksheet's own run where it isn't sure, while the inputs are the same."""
    graph, own = recording.graph, found.value
    known = np.isfinite(root.value)
    size = np.max(np.abs(own), initial=0.0, where=np.isfinite(own))
    if not np.any(known) or np.any(known & ~np.isclose(root.value, own, 1e-12, 1e-12 * size)):
        raise NotRecorded("its cells do not come to it")
    if (known == np.isfinite(own)).all():
        return lift(graph, root).re
    same: Any = True
    for leaf in leaves_of([found], recording):
        same = same & Quantity(graph, graph.same(leaf))
    kept = choice(graph, same, own, np.nan)
    return lift(graph, choice(graph, np.isfinite(root), root, kept)).re


def _root(graph: Graph, block: Block, unit: str) -> Any:
    numbers_under(block)
    if not block.starts.keys() >= {"lo", "hi"}:
        raise NotRecorded("its interval has an open end")
    given = [start for starts in block.starts.values() for start in starts]
    shaping = (*given, *alike(graph, block))
    a, b, *guess = (Quantity(graph, graph.like(start, *shaping)) for start in given)
    if a.extent != block.nodes[0].shape:
        raise NotRecorded("its interval has another shape")
    with bounded(graph, _MOST):
        return _searched(block, a, b, guess[0] if guess else a / 2 + b / 2, unit)


class _Part(NamedTuple):
    """A part in which a residual changes its sign: its ends, and the most of the residual at them."""

    start: Any
    end: Any
    most: Any


def _searched(block: Block, a: Quantity, b: Quantity, guess: Quantity, unit: str) -> Any:
    """The root between a and b nearest the guess, which closes in on it look by look; none where it isn't sure."""
    graph = a.graph
    x, left = _tried(block, a, b, _FIRST, "1", unit)
    changed, above = _changed(left), x[..., :-1] > guess[..., None]
    number = np.arange(len(_FIRST) - 1)
    sides = np.argmax(np.where(changed & ~above, number, -1), axis=-1), np.argmax(changed & above, axis=-1)
    known = np.any(changed & ~above, axis=-1), np.any(changed & above, axis=-1)
    parts = [_part(x, left, side) for side in sides]
    sure = _unseen(left) == 0
    if block.method:  # of several it may find any, and of a stretch of zeros
        sure = sure & (np.sum(changed * 1.0, axis=-1) == 1) & (np.sum((left == 0) * 1.0, axis=-1) <= 1)
    for look in range(2, _EARLY + 1):
        closer = [_closer(block, *pair, unit) for pair in zip(parts, (f"{look}", f"{look}_above"), strict=True)]
        parts = [part for part, _ in closer]
        for there, (_, once) in zip(known, closer, strict=True):
            sure = sure & (~there | once)
    farther, nearer = (
        [choice(graph, there, off(part, guess), _NOWHERE) for there, part in zip(known, parts, strict=True)]
        for off in (_farther, _nearer)
    )
    upper = farther[1] < farther[0]
    taken = np.where(above, number == sides[1][..., None], number == sides[0][..., None])
    off = np.minimum(abs(x[..., :-1] - guess[..., None]), abs(x[..., 1:] - guess[..., None]))
    others = np.min(np.where(changed & ~taken, off, _NOWHERE), axis=-1)
    sure = sure & (np.minimum(*farther) < np.minimum(choice(graph, upper, *nearer), others))
    part = _Part(*(choice(graph, upper, high, low) for low, high in zip(*parts, strict=True)))
    early = part.most
    for look in range(_EARLY + 1, _LOOKS + 1):
        part, _ = _closer(block, part, f"{look}", unit)
    closes = True if block.method else part.most <= _LESS * early
    return np.where(sure & closes, part.start, np.nan)


def _farther(part: _Part, guess: Quantity) -> Any:
    """How far a part is from the guess at most."""
    return np.maximum(abs(part.start - guess), abs(part.end - guess))


def _nearer(part: _Part, guess: Quantity) -> Any:
    """How far it is at least."""
    return np.maximum(np.maximum(part.start - guess, guess - part.end), 0)


def _tried(block: Block, a: Quantity, b: Quantity, places: Values, name: str, unit: str) -> tuple[Quantity, Quantity]:
    """Places between a and b, and what is left of the equation there."""
    x = a[..., None] * (1 - places) + b[..., None] * places
    left = _residual(block, x)
    x.graph.labels[x.re] = Label(f"tried_{name}", unit, "places tried")
    x.graph.labels[left.re] = Label(f"left_{name}", "", "what is left of the equation there")
    return x, left


def _part(x: Quantity, left: Quantity, number: Any) -> _Part:
    """The part between a place and the next one."""
    own = np.arange(x.extent[-1] - 1) == number[..., None]
    a, b, f, g = (np.sum(np.where(own, q, 0.0), axis=-1) for y in (x, left) for q in (y[..., :-1], y[..., 1:]))
    return _Part(a, b, np.maximum(abs(f), abs(g)))


def _closer(block: Block, part: _Part, name: str, unit: str) -> tuple[_Part, Any]:
    """The first part of a part in which the residual changes its sign, and whether it is the only one."""
    x, left = _tried(block, part.start, part.end, _LATER, name, unit)
    changed = _changed(left)
    closer, labels = _part(x, left, np.argmax(changed, axis=-1)), x.graph.labels
    labels[closer.start.re] = Label(f"from_{name}", unit, "lower end of the part in which the sign changes")
    labels[closer.end.re] = Label(f"to_{name}", unit, "upper end of it")
    return closer, np.sum(changed * 1.0, axis=-1) == 1


def _changed(left: Quantity) -> Any:
    """Where the residual at a place and at the next one differ in sign."""
    f, g = left[..., :-1], left[..., 1:]
    return np.where(np.isfinite(f) & np.isfinite(g), (f < 0) != (g < 0), False)


def _unseen(left: Quantity) -> Any:
    """How many places come so near zero without a change of sign that there may be roots about them."""
    known, up = np.isfinite(left), np.where(left < 0, -1.0, 1.0)
    size = np.where(known, abs(left), 0.0)
    before, at, after = left[..., :-2] * up[..., 1:-1], size[..., 1:-1], left[..., 2:] * up[..., 1:-1]
    least = known[..., 1:-1] & ~(before < at) & ~(after < at)
    near = least & (at < _NEAR * (size[..., :-2] + size[..., 2:]))
    ends, beside = left[..., [0, -1]], left[..., [1, -2]]
    at_end = ((ends < 0) == (beside < 0)) & (abs(ends) <= _AT_END * abs(beside))
    return np.sum(near * 1.0, axis=-1) + np.sum(at_end * 1.0, axis=-1)


def _residual(block: Block, x: Quantity) -> Quantity:
    """What is left of the equation at other values of its unknown, which stand on the last axis."""
    new = replaced(x.graph, block.residuals, {block.nodes[0]: moved(x, -1, 0).re}, x.extent[-1])
    return moved(Quantity(x.graph, new[block.residuals[0]]), 0, -1)
