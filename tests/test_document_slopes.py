"""First and second slopes of the documents by all inputs against differences at 80 digits, and in extreme scenes."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np
import pytest
from flint import arb
from run_once import DOCUMENTS, WORKSHEETS, recorded

from mechsheet.accuracy import extreme
from mechsheet.quantities.lines import Recording
from mechsheet.quantities.node import Node
from mechsheet.readers.ball_rules import NONE
from mechsheet.readers.balls import Balls, precision
from mechsheet.readers.bends import bends
from mechsheet.readers.numbers import numbers
from mechsheet.readers.slopes import slopes, solved_under, unfollowed
from mechsheet.recording.record import record
from mechsheet.worksheet import inputs
from mechsheet.worksheet.cells import load
from mechsheet.worksheet.errors import SheetError

BITS, STEP = 400, 2.0**-90  # differences of a step h are right to h, here 27 digits, and lose 27 or 54 of 120
EPS = 2.0**-52
ROUNDINGS = 64
TOGETHER = 8  # groups of inputs, of which each is rounded for itself
EXACT = np.frompyfunc(arb, 1, 1)


def asked(recording: Recording) -> tuple[list[Node], list[Node]]:
    """The results of a recording that have slopes, and its inputs that are no whole numbers.

    Printed errata lose digits by themselves, which is why they are errata.
    """
    by = [node for node in recording.inputs.values() if node.value.dtype.kind == "f"]
    columns = [column for columns in recording.tables.values() for column in columns if column is not None]
    lines = (line for section in recording.lines.values() for line in section)
    errata = {line.node for line in lines if "erratum" in line.meaning}
    results = dict.fromkeys(part for column in columns for part in column.parts if part not in errata)
    if unfollowed(results, by):
        results = [node for node in results if not unfollowed([node], by)]
    return [*results], by


def apart(known: Mapping[Node, Any], moving: Node) -> dict[Node, Any]:
    """Of what was evaluated one after the other, that which does not rest on a quantity."""
    resting = {moving}
    for node in known:
        turns = node.args[2:] if node.op == "iterated" else ()
        if not resting.isdisjoint((*node.operands, *turns)):
            resting.add(node)
    return {node: value for node, value in known.items() if node not in resting}


def exactly(results: list[Node], node: Node, element: int, way: int, known: Mapping[Node, Any]) -> list[Any]:
    """All results where one element of an input has moved by a step; what does not rest on it is ``known``."""
    moved = np.array([arb(float(x)) for x in node.value.reshape(-1)], object)
    moved[element] += way * arb(STEP)
    return flat(Balls({**known, node: moved.reshape(node.shape)}).of(results))


def flat(values: Iterable[Any]) -> list[Any]:
    return [x for value in values for x in value.reshape(-1)]


def quotients(here: list[Any], there: list[Any], way: int) -> list[float]:
    """Differences over the step; NaN where there is no number, infinite where nobody knows."""

    def quotient(a: Any, b: Any) -> float:
        if a is NONE or b is NONE:
            return np.nan
        if a is b and a.is_finite():  # it does not rest on what moves
            return 0.0
        found = (arb(b) - arb(a)) / (way * STEP)
        return float(found) if found.is_finite() else np.inf

    return [quotient(a, b) for a, b in zip(here, there, strict=True)]


def side_by_side(results: list[Node], found: Mapping[Node, Any]) -> Any:
    """What each direction makes of every result, one after the other."""
    return np.concatenate([found[node].reshape(len(found[node]), -1) for node in results], 1)


def conditions(results: list[Node], by: list[Node], found: Any) -> Any:
    """What one rounding of each input, of a list of all its elements, makes of the slopes, added up.

    Of some inputs at once, which stand far from each other and move opposite ways: neighbours would often cancel.
    """
    spread, under = np.zeros(found.shape), [*results, *solved_under(results)]
    for group in range(TOGETHER):
        ways = {x: (-1) ** (k // TOGETHER) * (k % TOGETHER == group) for k, x in enumerate(by)}
        moved = {x: x.value * (1 + 64 * EPS * way) for x, way in ways.items()}
        try:
            there = slopes(results, by, numbers(under, moved))
        except SheetError:  # these have no solution
            continue
        off = np.abs(side_by_side(results, {node: there[node].ahead for node in results}) - found) / 64
        spread += np.where(np.isfinite(off), off, 0.0)
    return spread


def worst(results: list[Node], by: list[Node], behind: int, every: int = 1) -> tuple[float, int]:
    """The largest error of any slope, in roundings times its condition, and how many slopes there are.

    Of every so many inputs, of a list of its first, middle and last element, seen from ahead, and of every so many also
    from ``behind``. The condition is what roundings of the inputs make of the slopes; a slope itself counts as one.
    """
    both_sides = slopes(results, by)
    found = [side_by_side(results, {node: slope[k] for node, slope in both_sides.items()}) for k in (0, 1)]
    spread = conditions(results, by, found[0])
    largest = [np.max(np.abs(node.value + 0.0), initial=0.0, where=np.isfinite(node.value)) for node in results]
    sizes = np.repeat(largest, [node.size for node in results])
    lines = np.repeat([node.line for node in results], [node.size for node in results])
    most, count = 0.0, 0
    elements = enumerate((x, element) for x in by for element in range(x.size))
    tried = [(k, x, element) for k, (x, element) in elements if element in (0, x.size // 2, x.size - 1)]
    with precision(BITS):
        balls = Balls()
        here = flat(balls.of(results))
        beside = {x: apart(balls.known, x) for x in by}
    there_is = np.array([y is not NONE for y in here])
    for k, x, element in tried[::every]:
        unit = sizes / (abs(x.value.reshape(-1)[element]) or 1.0)
        for way, side in zip((1, -1) if k % behind == 0 else (1,), found, strict=False):
            with precision(BITS):
                exact = np.array(quotients(here, exactly(results, x, element, way, beside[x]), way))
            own = side[k]
            both = np.isfinite(own) & np.isfinite(exact)
            allowed = spread[k] + EPS * (np.abs(exact) + 1e-3 * unit)
            with np.errstate(invalid="ignore", divide="ignore"):
                off = np.where(both & (own != exact), np.abs(own - exact) / allowed, 0.0)
            most, count = max(most, float(np.max(off, initial=0.0))), count + int(np.count_nonzero(both))
            # What Python saw of a rounded number is no number in exact arithmetic at all.
            told = np.isfinite(own) & np.isnan(exact) & (own != 0) & there_is
            assert not told.any(), (lines[told], "a slope where there is no number beside")
    return most, count


def second_off(stem: str) -> tuple[float, int]:
    """The largest error of any second slope along a way on which all inputs move, of the largest of its column."""
    results, by = asked(recorded(stem)[-1])
    rng = np.random.default_rng(5)
    way = {x: x.value * rng.uniform(-1, 1, x.shape) for x in by}
    found = bends(results, by, np.concatenate([d.reshape(-1) for d in way.values()])[None])

    def at(t: float) -> list[Any]:
        moved = {x: np.asarray(EXACT(x.value.astype(object)) + EXACT(d.astype(object)) * t) for x, d in way.items()}
        return flat(Balls(moved).of(results))

    with precision(BITS):
        each = zip(at(-STEP), at(0.0), at(STEP), strict=True)
        true = [np.nan if NONE in three else float((three[0] - 2 * three[1] + three[2]) / STEP**2) for three in each]
    most, count, start = 0.0, 0, 0
    for node in results:
        own, exact = found[node][0].reshape(-1), np.array(true[start : start + node.size])
        start += node.size
        both = np.isfinite(own) & np.isfinite(exact)
        size = max(np.max(np.abs(x[both]), initial=0.0) for x in (exact, node.value.reshape(-1)))
        if size:
            most, count = (
                max(most, float(np.max(np.abs(own - exact)[both], initial=0.0) / size)),
                count + int(both.sum()),
            )
    return most, count


@pytest.mark.parametrize("stem", DOCUMENTS)
def test_second_slopes_of_the_documents_are_right(stem: str) -> None:
    most, count = second_off(stem)
    assert count > 600 and most <= 1e-9, (most, count)


@pytest.mark.parametrize("stem", DOCUMENTS)
def test_slopes_of_the_documents_by_all_inputs_are_exact_to_rounding(stem: str) -> None:
    most, count = worst(*asked(recorded(stem)[-1]), 11)
    assert count > 1000 and most <= ROUNDINGS, (most, count)


SCENES = ("away_1e6", "dead_centre_extended", "links_parallel", "retraction_time")
EXTREME = [s for s in extreme.scenes() if s.name in SCENES]


@pytest.mark.parametrize("scene", EXTREME, ids=lambda s: s.name)
def test_slopes_of_extreme_scenes(scene: extreme.Scene) -> None:
    sheet = load(WORKSHEETS / f"{scene.job}.py")
    names = sheet.run(sheet.results, {"g": inputs.build(sheet.inputs, scene.cases()[len(scene.values) // 2])})
    most, count = worst(*asked(record(names, sheet)), 1, 13)
    assert count > 50 and most <= ROUNDINGS, (most, count)
