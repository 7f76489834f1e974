"""What a loop ends with: its digits proved and its slopes exact, by as many turns as it takes."""

from __future__ import annotations

from collections.abc import Container, Iterable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from own_worksheet import own

from mechsheet.accuracy.arithmetic import mp, mpf
from mechsheet.quantities.lines import Recording
from mechsheet.quantities.node import Node, bottom_up
from mechsheet.readers import balls
from mechsheet.readers.bends import bends
from mechsheet.readers.gradients import gradient
from mechsheet.readers.numbers import numbers
from mechsheet.readers.proof import Proof
from mechsheet.readers.slopes import slopes, solved_under, unfollowed
from mechsheet.recording.record import record
from mechsheet.run.proving import proof_of

LOOPS = {
    "heron": "y = 1.0\nwhile abs(y * y - g.F * g.a) > 1e-9:\n    y = (y + g.F * g.a / y) / 2\nz = 2 * y  # [-] root",
    "in place": (
        "y = 0.5\nfor k in range(60):\n    b = y\n    y = cos(g.a * y) / g.F\n"
        "    if abs(y - b) < 1e-13:\n        break\nz = 2 * y  # [-] fixed point"
    ),
}


def exactly(name: str, F: Any, a: Any, turns: int) -> Any:
    y = mpf(1) if name == "heron" else mpf("0.5")
    for _ in range(turns):
        y = (y + F * a / y) / 2 if name == "heron" else mp.cos(a * y) / F
    return 2 * y


def turns_of(name: str) -> int:
    y, count, F, a = (1.0 if name == "heron" else 0.5), 0, 2.5, 0.75
    while True:
        if name == "heron" and abs(y * y - F * a) <= 1e-9:
            return count
        b, count = y, count + 1
        y = (y + F * a / y) / 2 if name == "heron" else np.cos(a * y) / F
        if name != "heron" and abs(y - b) < 1e-13:
            return count


def run(folder: Path, lines: str) -> tuple[Any, Recording, Proof]:
    sheet = own(folder, lines)
    names = {**sheet.run(sheet.results, {"g": sheet.inputs()}), "__file__": sheet.path}
    recording = record(names, sheet, whole=True, exact=True)
    return names, recording, proof_of(names, sheet, recording)


@pytest.mark.parametrize("name", LOOPS)
def test_iterations_to_convergence_are_proved_and_differentiated(name: str, tmp_path: Path) -> None:
    names, recording, proof = run(tmp_path, LOOPS[name])
    assert any(node.op == "iterated" for node in recording.graph.nodes.values())
    node, by = recording.values["z"].whole().re, [recording.inputs["F"], recording.inputs["a"]]
    assert unfollowed([node], by) is None
    turns = turns_of(name)
    (claim,) = (column for column in proof.columns if column.name == "z")
    off = abs(mpf(float(names["z"])) / exactly(name, mpf(2.5), mpf(0.75), turns) - 1)
    assert claim.least > 14 and abs(claim.least - min(16.0, float(-mp.log10(off)) if off else 16.0)) < 0.2
    found, ways = slopes([node], by)[node].both, [(1.0, 0.0), (0.0, 1.0), (1.0, 1.0)]
    assert gradient(node, 0, by).both == pytest.approx(found, rel=1e-13)
    second = bends([node], by, np.array(ways))[node]
    for k, (u, v) in enumerate(ways):

        def way(t: Any, u: float = u, v: float = v) -> Any:
            return exactly(name, mpf(2.5) + t * u, mpf(0.75) + t * v, turns)

        along = [mp.diff(way, 0, n) for n in (1, 2)]
        assert (found @ np.array([u, v])).item() == pytest.approx(float(along[0]), rel=1e-12)
        assert second[k].item() == pytest.approx(float(along[1]), rel=1e-11)
    there = {by[0]: np.array(2.5 * (1 + 1e-15)), by[1]: by[1].value}
    again = slopes([node], by, numbers([node, *solved_under([node])], there))[node].both
    assert again == pytest.approx(found, rel=1e-12)


def test_an_end_that_rounding_decides_is_not_proved(tmp_path: Path) -> None:
    """Until nothing changes any more: in exact arithmetic something always does."""
    lines = (
        "y = 1.0\nfor k in range(60):\n    b = y\n    y = (y + g.F / y) / 2\n    if y == b:\n        break\n"
        "z = 2 * y  # [-] root"
    )
    _, _, proof = run(tmp_path, lines)
    (claim,) = (column for column in proof.columns if column.name == "z")
    assert claim.least == 0 and "line " in claim.why and "a loop" in claim.why


@pytest.mark.parametrize("reader", ["balls", "slopes", "bends"])
def test_what_the_turns_of_several_loops_rest_on_is_gone_through_once(
    reader: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Once for each loop that ends by convergence it took minutes: a proof, and what tolerances come to."""
    lines = (
        "y = 1.0\nfor k in range(4):\n    x = y\n    while abs(x * x - g.F * y) > 1e-9:\n"
        "        x = (x + g.F * y / x) / 2\n    y = x + g.a\nz = 2 * y  # [-] root"
    )
    _, recording, _ = run(tmp_path, lines)
    node, by = recording.values["z"].whole().re, [recording.inputs["F"], recording.inputs["a"]]
    assert sum(each.op == "iterated" for each in bottom_up([node], ())) > 3
    passes = {
        "balls": [lambda: balls.unfollowed([node])],
        "slopes": [lambda: unfollowed([node], by), lambda: slopes([node], by)],
        "bends": [lambda: bends([node], by, np.eye(2))],
    }
    for again in passes[reader]:
        gone = list[Node]()

        def counted(roots: Iterable[Node], known: Container[Node], gone: list[Node] = gone) -> Iterator[Node]:
            for each in bottom_up(roots, known):
                gone.append(each)
                yield each

        monkeypatch.setattr(f"mechsheet.readers.{reader}.bottom_up", counted)
        again()
        assert len(gone) == len(set(gone)) > 30
