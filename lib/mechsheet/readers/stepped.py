"""Found values of several equations as the steps that lead to them from their guess, in operations that cells have.

They are the first steps of the worksheet's own Find, Newton's own from the same guess, so they end in the same one of
several roots. The worksheet's slopes are central differences, these are exact: where steps go so far, or widen what the
two differ by so much, that their ways might part, there is no value. Unknowns on whose way no other one rests, and in
which their own equations are linear, need no way: they are what these equations make them in the end.
"""

from collections.abc import Collection, Container, Iterable, Mapping, Sequence
from itertools import combinations, pairwise
from typing import Any, NamedTuple

import numpy as np

from mechsheet import units
from mechsheet.quantities.arithmetic import choice
from mechsheet.quantities.graph import Graph, Label, NotRecorded
from mechsheet.quantities.linear_rules import solved_rows
from mechsheet.quantities.node import Block, Node, bottom_up
from mechsheet.quantities.operations import Values
from mechsheet.quantities.quantity import Quantity, lift
from mechsheet.readers.derived import Sloped, Slopes, at
from mechsheet.readers.problems import alike, bounded, numbers_under, of_each
from mechsheet.worksheet.equations import longest_step

_Some = dict[int, Quantity]  # of some unknowns, by their numbers

_STEPS = 18  # two fewer than the worksheet's own, which end in the last digits
_ENDED = 1e-9  # sizes that the last step moves an unknown at most
_WIDER = 1e5  # times as much may two ways differ at a later step, times the square of how many sizes they lead away
_LINEAR_FAR = 1e6  # sizes that an unknown is at most in which its own equations are linear
_NEAR = 1e-6  # sizes of a step behind which they come nearer to each other
_MOST = 8_000_000  # operations on single numbers: six unknowns at 361 positions from 13 guesses take most of them
_BESIDE = 1e-4  # of the unknowns: within so much of them there is no corner at which differences see no slope


class _Group(NamedTuple):
    """As many equations as there are unknowns in them that are in no group before it; all by their numbers."""

    equations: tuple[int, ...]
    own: tuple[int, ...]
    unknowns: frozenset[int]  # all of its equations
    curved: bool  # in its own ones


class _Asked(NamedTuple):
    """A block by groups of its equations.

    Where not all of it is elementwise, ``rests`` tells which number of the unknowns elements rest on. What ``even``
    operations compare is linear in the unknowns: it stays 0 where it has no slopes.
    """

    block: Block
    groups: list[_Group]
    rests: Mapping[Node, Values]
    even: frozenset[Node]


def steps(graph: Graph, block: Block) -> list[Quantity]:
    """The unknowns of a block, from their guess; NaN where they may not be the worksheet's own.

    Raises NotRecorded where there is no such way to them.
    """
    if block.least:
        raise NotRecorded("the squares of its equations are made least")
    if any(len(ends) > 1 for ends in block.starts.values()):
        raise NotRecorded("it is looked for in intervals, from starts all over them")
    with bounded(graph, _MOST):
        return _stepped(graph, block)


def _stepped(graph: Graph, block: Block) -> list[Quantity]:
    guesses = [guess for (guess,) in block.starts.values()]
    shaping = (*guesses, *alike(graph, block))
    x = dict(enumerate(Quantity(graph, graph.like(guess, *shaping)) for guess in guesses))
    sizes = [_size(graph, x[k].re, unit) for k, unit in enumerate(block.unknown_unit)]
    longest = {k: most for k, unit in enumerate(block.unknown_unit) if np.isfinite(most := longest_step(unit))}
    asked = _asked(graph, block)
    stepped, straight = _apart(asked.groups, longest)
    sure: Any = True
    if stepped:
        ways, moves = [x], list[_Some]()
        for number in range(1, _STEPS + 1):
            step, clear = _step(graph, asked, stepped, x, sizes)
            if longest:
                part = 1 / np.maximum(_greatest([abs(step[k]) / most for k, most in longest.items()]), 1)
                graph.labels[part.re] = Label(f"part_{number}", "", f"part of step {number} that is taken")
                step = {k: part * whole for k, whole in step.items()}
            x = _gone(graph, block, x, step, number, f"after step {number} from its guess")
            sure = sure & clear
            ways.append(x)
            moves.append(step)
        sure = sure & _sure(graph, ways, moves, sizes, {k for group in stepped if group.curved for k in group.own})
    for group in straight:
        x = x | dict.fromkeys(group.own, lift(graph, 0.0))
        for number in (1, 2):
            step, clear = _step(graph, asked, [group], x, sizes)
            x = _gone(graph, block, x, step, number, "by linear equations" + ", corrected" * (number - 1))
            sure = sure & clear
        for k, last in step.items():
            sure = sure & (abs(last) <= _ENDED * np.maximum(sizes[k], abs(x[k])))
    whole = [graph.like(x[k].re, *shaping) for k in range(len(guesses))]
    return [choice(graph, sure, Quantity(graph, one), np.nan) for one in whole]


def _size(graph: Graph, guess: Any, unit: str) -> Any:
    """What an unknown is measured by: its guess, or its unit; an angle by no less than a radian."""
    known = abs(Quantity(graph, guess))
    if np.isfinite(longest_step(unit)):
        return np.maximum(known, 1.0)
    return choice(graph, known == 0, Quantity(graph, graph.constant(units.parse(unit).factor, unit)), known)


def _asked(graph: Graph, block: Block) -> _Asked:
    rests = {} if block.elementwise else numbers_under(block)
    x = [Quantity(graph, node) for node in block.nodes]
    equations, corners = at(dict(zip(block.nodes, x, strict=True)), block.residuals)
    moving = [node for node, (_, slopes) in corners.items() if _rest(slopes.values(), block.nodes)]
    groups = _groups(block, equations, [slopes for _, slopes in corners.values()])
    return _Asked(block, groups, rests, frozenset(corners.keys() - moving))


def _rest(slopes: Iterable[Quantity], unknowns: Iterable[Node]) -> bool:
    """Whether slopes rest on some unknowns."""
    return not set(unknowns).isdisjoint(bottom_up((slope.re for slope in slopes), ()))


def _groups(block: Block, equations: Sequence[Sloped], corners: Sequence[Slopes]) -> list[_Group]:
    """The equations by groups that can be solved one after the other, the smallest first."""
    known, left, groups = set[int](), list(range(len(equations))), list[_Group]()
    while left:
        chosen, own = _fewest(equations, left, known)
        slopes = [slope for i in chosen for k, slope in equations[i][1].items() if k in own]
        curved = _rest(slopes, [block.nodes[k] for k in own]) or any(k in own for moves in corners for k in moves)
        groups.append(_Group(chosen, own, frozenset(k for i in chosen for k in equations[i][1]), curved))
        known.update(own)
        left = [i for i in left if i not in chosen]
    return groups


def _fewest(
    equations: Sequence[Sloped], left: Sequence[int], known: Container[int]
) -> tuple[tuple[int, ...], tuple[int, ...]]:
    """The fewest equations that have as many unknowns not known yet, and these."""
    for count in range(1, len(left) + 1):
        for chosen in combinations(left, count):
            own = tuple(sorted({k for i in chosen for k in equations[i][1] if k not in known}))
            if len(own) == count:
                return chosen, own
    raise NotRecorded("the slopes of its equations are singular")


def _apart(groups: Sequence[_Group], angles: Iterable[int]) -> tuple[list[_Group], list[_Group]]:
    """Groups that have to go step by step, and those that need not: linear ones on which the others do not rest.

    An angle has to, as its steps may make those of all shorter.
    """
    stepped, straight, needed = list[_Group](), list[_Group](), set(angles)
    for group in reversed(groups):
        if group.curved or not needed.isdisjoint(group.own):
            stepped.insert(0, group)
            needed |= group.unknowns
        else:
            straight.insert(0, group)
    return stepped, straight


def _step(graph: Graph, asked: _Asked, groups: Sequence[_Group], x: _Some, sizes: Sequence[Any]) -> tuple[_Some, Any]:
    """Newton's step of groups, which is taken away from their unknowns, and whether no corner is near."""
    block = asked.block
    wanted = [i for group in groups for i in group.equations]
    unknowns = {node: x[k] for k, node in enumerate(block.nodes)}
    known, corners = at(unknowns, [block.residuals[i] for i in wanted])
    equations, step, none = dict(zip(wanted, known, strict=True)), _Some(), lift(graph, 0.0)
    for group in groups:
        rows = []
        for i in group.equations:
            value, slopes = equations[i]
            for k in sorted(slopes.keys() & step.keys()):
                value = value - slopes[k] * step[k]
            rows.append([*(slopes.get(k, none) for k in group.own), value])
        step |= zip(group.own, _solved(graph, rows), strict=True)
    clear: Any = True
    for node, (off, slopes) in corners.items():
        near = _BESIDE * sum(abs(slope) * np.maximum(sizes[k], abs(x[k])) for k, slope in slopes.items())
        own = abs(off) >= near if node in asked.even else abs(off) > near
        clear = clear & (of_each(own, asked.rests[node], block.nodes[0].shape) if node in asked.rests else own)
    return step, clear


def _gone(graph: Graph, block: Block, x: _Some, step: _Some, number: int, where: str) -> _Some:
    """The unknowns after a step."""
    there = {k: x[k] - one for k, one in step.items()}
    names = list(block.starts)
    for k, one in there.items():
        graph.labels[one.re] = Label(f"{names[k]}_{number}", block.unknown_unit[k], f"{names[k]} {where}")
    return x | there


def _sure(
    graph: Graph, ways: Sequence[_Some], moves: Sequence[_Some], sizes: Sequence[Any], curved: Collection[int]
) -> Any:
    """Whether the steps end in a root, without any place from which the worksheet's own might go elsewhere.

    Of the ``curved`` unknowns their own equations are not linear in them.
    """
    measures = {k: np.maximum(sizes[k], abs(ways[-1][k])) for k in moves[-1]}
    sure: Any = True
    for k, measure in measures.items():
        sure = sure & (abs(moves[-1][k]) <= _ENDED * measure)
    farthest = {k: _greatest([abs(x[k]) for x in ways[1:]]) for k in measures}
    for k in sorted(measures.keys() - curved):
        sure = sure & (farthest[k] <= _LINEAR_FAR * measures[k])
    if not curved:
        return sure
    off = _greatest([1.0, *(farthest[k] / sizes[k] for k in sorted(curved))])
    graph.labels[off.re] = Label("farthest", "", "sizes of the unknowns that the steps lead to at most")
    lengths = [_greatest([abs(step[k]) / measures[k] for k in sorted(curved)]) for step in moves]
    wider: Any = 1.0
    widest = [wider]
    for n, (before, after) in enumerate(pairwise(lengths), 2):
        graph.labels[before.re] = Label(f"length_{n - 1}", "", f"length of step {n - 1} in sizes of the unknowns")
        wider = choice(graph, before > _NEAR, np.maximum(wider, 1.0) * 2 * after / before, 1.0)
        graph.labels[wider.re] = Label(f"wider_{n}", "", f"times as wide at most are small differences after step {n}")
        widest.append(wider)
    return sure & (_greatest(widest[1:]) <= _WIDER / off**2)  # errors of differences grow with their width


def _greatest(values: Sequence[Any]) -> Any:
    most, *others = values
    for other in others:
        most = np.maximum(most, other)
    return most


def _solved(graph: Graph, rows: Sequence[list[Quantity]]) -> list[Quantity]:
    """The unknowns of linear equations, of two by determinants."""
    if len(rows) == 1:
        ((slope, value),) = rows
        return [value / slope]
    if len(rows) == 2:
        (a, b, p), (c, d, q) = rows
        whole = a * d - b * c
        return [(p * d - b * q) / whole, (a * q - p * c) / whole]
    (unknowns,) = solved_rows(graph, [list(row) for row in rows])
    return unknowns
