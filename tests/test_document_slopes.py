"""Slopes of the documents by all their inputs against differences at 80 digits, in ordinary and in extreme scenes."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from flint import arb

from mechsheet.accuracy import extreme
from mechsheet.recording.ball_rules import NONE
from mechsheet.recording.balls import Balls, precision
from mechsheet.recording.lines import Recording
from mechsheet.recording.node import Node
from mechsheet.recording.numbers import numbers
from mechsheet.recording.record import record
from mechsheet.recording.slopes import slopes, solved_under, unfollowed
from mechsheet.worksheet import inputs
from mechsheet.worksheet.cells import load
from mechsheet.worksheet.errors import SheetError

WORKSHEETS = Path(__file__).parents[1] / "worksheets"
DOCUMENTS = ("hitch", "landing_gear", "kinetostatics", "slotted_link", "joint")
BITS, STEP = 540, 2.0**-90  # differences of a step h are right to h², here 54 digits, and lose 27 of 162
EPS = 2.0**-52
ROUNDINGS = 64


def recorded(stem: str, given: Mapping[str, Any]) -> tuple[Recording, list[Node], list[Node]]:
    """A recording, its results that have slopes, and the inputs that are no whole numbers.

    Printed errata lose digits by themselves, which is why they are errata.
    """
    sheet = load(WORKSHEETS / f"{stem}.py")
    names = sheet.run(sheet.results, {"g": inputs.build(sheet.inputs, given)})
    recording = record(names, sheet)
    by = [node for node in recording.inputs.values() if node.value.dtype.kind == "f"]
    columns = [column for columns in recording.tables.values() for column in columns if column is not None]
    lines = (line for section in recording.lines.values() for line in section)
    errata = {line.node for line in lines if "erratum" in line.meaning}
    results = dict.fromkeys(part for column in columns for part in column.parts if part not in errata)
    return recording, [node for node in results if not unfollowed([node], by)], by


def exactly(results: list[Node], node: Node, element: int, way: int) -> list[Any]:
    """All results where one element of an input has moved by a step."""
    moved = np.array([arb(float(x)) for x in node.value.reshape(-1)], object)
    moved[element] += way * arb(STEP)
    return [x for values in Balls({node: moved.reshape(node.shape)}).of(results) for x in values.reshape(-1)]


def quotients(low: list[Any], high: list[Any]) -> list[float]:
    """Differences over the step; NaN where there is no number, infinite where nobody knows."""

    def quotient(a: Any, b: Any) -> float:
        if a is NONE or b is NONE:
            return np.nan
        found = (arb(b) - arb(a)) / STEP
        return float(found) if found.is_finite() else np.inf

    return [quotient(a, b) for a, b in zip(low, high, strict=True)]


def worst(stem: str, given: Mapping[str, Any], every: int) -> tuple[float, int]:
    """The largest error of any slope, in roundings times its condition, and how many slopes there are.

    The condition is what one rounding of each input makes of the slopes, added up; a slope itself counts as one.
    """
    _, results, by = recorded(stem, given)
    found = slopes(results, by)
    spread = {node: np.zeros_like(found[node].ahead) for node in results}
    for x in by:
        for element in range(x.size):
            factor = np.ones(x.size)
            factor[element] += 64 * EPS
            moved = {**{y: y.value for y in by}, x: x.value * factor.reshape(x.shape)}
            try:
                there = slopes(results, by, numbers([*results, *solved_under(results)], moved))
            except SheetError:  # these have no solution
                continue
            for node in results:
                off = np.abs(there[node].ahead - found[node].ahead) / 64
                spread[node] += np.where(np.isfinite(off), off, 0.0)
    sizes = {node: np.max(np.abs(node.value + 0.0), initial=0.0, where=np.isfinite(node.value)) for node in results}
    most, count, k = 0.0, 0, -1
    with precision(BITS):
        here = exactly(results, by[0], 0, 0)
    for x in by:
        for element in range(x.size):
            k += 1
            if k % every:
                continue
            with precision(BITS):
                ahead = quotients(here, exactly(results, x, element, 1))
                behind = quotients(exactly(results, x, element, -1), here)
            at = 0
            for node in results:
                end = at + node.size
                for side, true in ((found[node].ahead, ahead[at:end]), (found[node].behind, behind[at:end])):
                    own, exact = side[k].reshape(-1), np.array(true)
                    both = np.isfinite(own) & np.isfinite(exact)
                    unit = sizes[node] / (abs(x.value.reshape(-1)[element]) or 1.0)
                    allowed = spread[node][k].reshape(-1) + EPS * (np.abs(exact) + 1e-3 * unit)
                    with np.errstate(invalid="ignore", divide="ignore"):
                        off = np.where(both & (own != exact), np.abs(own - exact) / allowed, 0.0)
                    most, count = max(most, float(np.max(off, initial=0.0))), count + int(np.count_nonzero(both))
                    # What Python saw of a rounded number is no number in exact arithmetic at all.
                    there_is = np.array([x is not NONE for x in here[at:end]])
                    told = np.isfinite(own) & np.isnan(exact) & (own != 0) & there_is
                    assert not told.any(), (stem, node.line, "a slope where there is no number beside")
                at = end
    return most, count


@pytest.mark.parametrize("stem", DOCUMENTS)
def test_slopes_of_the_documents_are_exact_to_rounding(stem: str) -> None:
    most, count = worst(stem, {}, 11 if stem != "joint" else 40)
    assert count > 1000 and most <= ROUNDINGS, (most, count)


# The leg that goes to its dead centre is accelerated without bound: its worksheet finds no time for it. With a tiny
# crank the length of the cylinder, rounded before it is used, decides its angles.
OTHERS = ("leg_to_dead_centre", "tiny_crank")
JOBS = ("hitch", "landing_gear")
EXTREME = [s for s in extreme.scenes() if s.job in JOBS and not s.says and s.name not in OTHERS][::3]


@pytest.mark.parametrize("scene", EXTREME, ids=lambda s: s.name)
def test_slopes_of_extreme_scenes(scene: extreme.Scene) -> None:
    most, count = worst(scene.job, scene.cases()[len(scene.values) // 2], 13)
    assert count > 50 and most <= ROUNDINGS, (most, count)
