"""Found values of several equations as the steps that lead to them from their guess, in operations that cells have.

They are the first steps of the worksheet's own Find, Newton's own from the same guess, so they end in the same one of
several roots. The worksheet's slopes are central differences, these are exact: where steps go so far, or widen what the
two differ by so much, that their ways might part, there is no value.
"""

from collections.abc import Sequence
from itertools import combinations, pairwise
from typing import Any

import numpy as np

from mechsheet import units
from mechsheet.recording.arithmetic import choice
from mechsheet.recording.derived import Sloped, at
from mechsheet.recording.graph import Graph, Label, NotRecorded
from mechsheet.recording.linear_rules import solved_rows
from mechsheet.recording.node import Block, bottom_up
from mechsheet.recording.quantity import Quantity, lift

_Values = list[Quantity]  # of all unknowns

_STEPS = 12
_ENDED = 1e-9  # sizes that the last step moves an unknown at most
_FAR, _LINEAR_FAR = 100.0, 1e6  # that an unknown is at most; where its own equations are linear in it
_WIDER = 1e3  # times what two ways differ by at one step they differ by at a later one at most
_NEAR = 1e-6  # sizes of a step behind which they come nearer to each other
_BESIDE = 1e-4  # of the unknowns: within so much of them there is no corner at which differences see no slope


def steps(graph: Graph, block: Block) -> list[Quantity]:
    """The unknowns of a block, from their guess; NaN where they may not be the worksheet's own.

    Raises NotRecorded where there is no such way to them.
    """
    if block.least:
        raise NotRecorded("the squares of its equations are made least")
    if any(len(ends) > 1 for ends in block.starts.values()):
        raise NotRecorded("it is looked for in intervals, from starts all over them")
    if not block.elementwise:
        raise NotRecorded("its equations rest on sums or on other elements")
    guesses = [guess for (guess,) in block.starts.values()]
    x = [Quantity(graph, graph.like(guess, *guesses, *block.under)) for guess in guesses]
    sizes = [_size(graph, guess.re, unit) for guess, unit in zip(x, block.unknown_unit, strict=True)]
    ways, moves, curved = [x], list[_Values](), set[int]()
    clear: Any = True
    for number in range(1, _STEPS + 1):
        graph.work = 0  # a step may take what a line may
        equations, corners = at(dict(zip(block.nodes, x, strict=True)), block.residuals)
        about = [np.maximum(size, abs(one)) for size, one in zip(sizes, x, strict=True)]
        for off, slopes in corners:
            clear = clear & (abs(off) > _BESIDE * sum(abs(slope) * about[k] for k, slope in slopes.items()))
        step, curved = _step(graph, equations, x)
        x = [a - s for a, s in zip(x, step, strict=True)]
        for name, unit, one in zip(block.starts, block.unknown_unit, x, strict=True):
            graph.labels[one.re] = Label(f"{name}_{number}", unit, f"{name} after step {number} from its guess")
        ways.append(x)
        moves.append(step)
    graph.work = 0
    sure = _sure(graph, ways, moves, sizes, curved) & clear
    return [choice(graph, sure, one, np.nan) for one in x]


def _size(graph: Graph, guess: Any, unit: str) -> Any:
    """What an unknown is measured by: its guess, or its unit."""
    known = abs(Quantity(graph, guess))
    return choice(graph, known == 0, Quantity(graph, graph.constant(units.parse(unit).factor, unit)), known)


def _sure(
    graph: Graph, ways: Sequence[_Values], moves: Sequence[_Values], sizes: Sequence[Any], curved: set[int]
) -> Any:
    """Whether the steps end in a root, without any place from which the worksheet's own might go elsewhere.

    Of the ``curved`` unknowns their own equations are not linear in them.
    """
    measures = [np.maximum(size, abs(end)) for size, end in zip(sizes, ways[-1], strict=True)]
    sure: Any = True
    for k, measure in enumerate(measures):
        most = _FAR * sizes[k] if k in curved else _LINEAR_FAR * measure
        sure = sure & (_greatest([abs(x[k]) for x in ways[1:]]) <= most)
        sure = sure & (abs(moves[-1][k]) <= _ENDED * measure)
    if not curved:
        return sure
    lengths = [_greatest([abs(step[k]) / measures[k] for k in sorted(curved)]) for step in moves]
    wider: Any = 1.0
    widest = [wider]
    for n, (before, after) in enumerate(pairwise(lengths), 2):
        graph.labels[before.re] = Label(f"length_{n - 1}", "", f"length of step {n - 1} in sizes of the unknowns")
        wider = choice(graph, before > _NEAR, np.maximum(wider, 1.0) * 2 * after / before, 1.0)
        graph.labels[wider.re] = Label(f"wider_{n}", "", f"times as wide at most are small differences after step {n}")
        widest.append(wider)
    return sure & (_greatest(widest[1:]) <= _WIDER)


def _greatest(values: Sequence[Any]) -> Any:
    most, *others = values
    for other in others:
        most = np.maximum(most, other)
    return most


def _step(graph: Graph, equations: Sequence[Sloped], x: Sequence[Quantity]) -> tuple[list[Quantity], set[int]]:
    """Newton's step, which is taken away from the unknowns, and those whose own equations are not linear in them.

    Equations that have unknowns of their own alone are solved by themselves, the smallest such groups first.
    """
    found, curved, left = dict[int, Quantity](), set[int](), list(range(len(equations)))
    none = lift(graph, 0.0)
    while left:
        group, own = _group(equations, left, found)
        rows = []
        for i in group:
            value, slopes = equations[i]
            for k in sorted(slopes.keys() & found.keys()):
                value = value - slopes[k] * found[k]
            rows.append([*(slopes.get(k, none) for k in own), value])
        under = set(bottom_up((slope.re for *several, _ in rows for slope in several), ()))
        if not under.isdisjoint(x[k].re for k in own):
            curved |= set(own)
        found |= dict(zip(own, _solved(graph, rows), strict=True))
        left = [i for i in left if i not in group]
    return [found[k] for k in range(len(x))], curved


def _group(
    equations: Sequence[Sloped], left: Sequence[int], found: dict[int, Quantity]
) -> tuple[tuple[int, ...], list[int]]:
    """The fewest equations that have as many unknowns not found yet, and these."""
    for count in range(1, len(left) + 1):
        for group in combinations(left, count):
            own = sorted(set[int]().union(*(equations[i][1] for i in group)) - found.keys())
            if len(own) == count:
                return group, own
    raise NotRecorded("the slopes of its equations are singular at its guess")


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
