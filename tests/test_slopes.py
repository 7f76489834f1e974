"""Slopes of a recording: a rule for each operation, corners from both sides, and what is found with its equations."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from mechsheet.quantities.graph import Graph, current
from mechsheet.quantities.node import Block
from mechsheet.quantities.operations import ELEMENTWISE
from mechsheet.quantities.quantity import Quantity
from mechsheet.readers.gradients import gradient
from mechsheet.readers.slope_rules import RULES, SMOOTH, Motion, reduced
from mechsheet.readers.slopes import Slope, jacobian, slopes, unfollowed
from tests.own_worksheet import own, recorded

nan, inf = np.nan, np.inf


def test_every_operation_has_a_rule() -> None:
    """But those that rest on nothing, and what is found or a loop ends with, which have passes of their own."""
    made = {"take", "at", "join", "reduce", "length", "exported"}
    assert {*ELEMENTWISE, *made} == {*RULES, *SMOOTH}


def assert_same(backwards: Slope, forwards: Slope, element: int) -> None:
    """That the pass backwards has what the forward ones have of one element."""
    for seen_back, side in zip(backwards, forwards, strict=True):
        wanted = side.reshape(seen_back.size, -1)[:, element]
        np.testing.assert_allclose(seen_back, wanted, rtol=1e-13, atol=1e-15 * np.nanmax(np.abs(wanted), initial=1.0))


def seen(f: Callable[..., Any], *at: float) -> Slope:
    graph = Graph()
    token = current.set(graph)
    try:
        x = [Quantity(graph, graph.leaf("input", f"x{k}", float(v))) for k, v in enumerate(at)]
        y, by = f(*x), [v.re for v in x]
        found = slopes([y.re], by)[y.re]
        for element in range(y.re.size):
            assert_same(gradient(y.re, element, by), found, element)
        return found
    finally:
        current.reset(token)


@pytest.mark.parametrize(
    ("f", "at", "ahead", "behind"),
    [
        (abs, [0], [1], [-1]),
        (abs, [-2], [-1], [-1]),
        (np.maximum, [3, 3], [1, 1], [0, 0]),
        (np.minimum, [3, 3], [0, 0], [1, 1]),
        (lambda x: np.maximum(x, x), [3], [1], [1]),
        (lambda x: np.where(x > 1, x**2, 2 * x - 1), [1], [2], [2]),
        (lambda x: np.where(x > 1, x**2, 1.0), [1], [2], [0]),
        (lambda x: np.where(x > 1, x, -x), [1], [nan], [-1]),
        (lambda x: np.where(x >= 1, x, -x), [1], [1], [nan]),
        (lambda x: np.where(x == 1, 7.0, x), [1], [nan], [nan]),
        (lambda x: np.where(~(x > 1) & (x < 2), 1.0, x), [1], [1], [0]),
        (np.floor, [2], [0], [nan]),
        (np.round, [2.5], [nan], [nan]),
        (np.sign, [0], [nan], [nan]),
        (lambda x: x % 2.0, [4], [1], [nan]),
        (np.sqrt, [0], [inf], [nan]),
        (lambda x: np.sqrt(x * x), [0], [nan], [nan]),
        (lambda x, y: abs(x + 1j * y), [0, 0], [1, 1], [-1, -1]),
        (lambda x, y: abs(x + 1j * y), [3, -4], [0.6, -0.8], [0.6, -0.8]),
        (lambda x, y: x**y, [2, 3], [12, 8 * np.log(2)], [12, 8 * np.log(2)]),
        (lambda x: x**0, [0], [0], [0]),
        (lambda x: x**2, [0], [0], [0]),
        (np.log1p, [1e-9], [1 / (1 + 1e-9)], [1 / (1 + 1e-9)]),
        (np.sinh, [1e-9], [1], [1]),
        (np.cumsum, [3], [1], [1]),
        (lambda x: (np.where(x > 1, 7.0, x) - 1) ** 2, [1], [nan], [0]),
    ],
)
def test_corners_and_kernels(f: Any, at: list[float], ahead: list[float], behind: list[float]) -> None:
    found = seen(f, *at)
    for side, wanted in ((found.ahead, ahead), (found.behind, behind)):
        np.testing.assert_allclose(np.ravel(side), wanted, rtol=4e-16)


@pytest.mark.parametrize("f", [np.argmax, np.argmin, np.max])
def test_of_what_is_no_number_nothing_is_the_greatest(f: Any) -> None:
    graph = Graph()
    token = current.set(graph)
    try:
        x = Quantity(graph, graph.leaf("input", "x", 2.5))
        y = f(np.array([nan, nan]) * x) * 1.0
        assert np.isnan(slopes([y.re], [x.re])[y.re].both).all() and np.isnan(gradient(y.re, 0, [x.re]).both).all()
    finally:
        current.reset(token)


@pytest.mark.parametrize(
    ("f", "slope"),
    [
        (lambda a: a.max(), ([1, 1, 0], [0, 0, 0])),
        (lambda a: a.sum(), ([1, 1, 1], [1, 1, 1])),
        (lambda a: a.prod(), ([6, 6, 9], [6, 6, 9])),
        (lambda a: np.cumsum(a)[1], ([1, 1, 0], [1, 1, 0])),
        (lambda a: a[::-1][0], ([0, 0, 1], [0, 0, 1])),
        (lambda a: a.argmax() * 1.0, ([0, nan, 0], [nan, 0, 0])),
        (lambda a: np.stack([a, 2 * a])[1, 0], ([2, 0, 0], [2, 0, 0])),
        (lambda a: np.where((a > 2).all(), a[0], 5.0), ([0, 0, nan], [0, 0, 0])),
    ],
)
def test_elements(f: Any, slope: Any) -> None:
    """Of three numbers of which two are the greatest."""
    graph = Graph()
    token = current.set(graph)
    try:
        leaf = graph.leaf("input", "a", np.array([3.0, 3.0, 2.0]))
        y = f(Quantity(graph, leaf))
        found = slopes([y.re], [leaf])[y.re]
        assert_same(gradient(y.re, 0, [leaf]), found, 0)
    finally:
        current.reset(token)
    for side, wanted in zip(found, slope, strict=True):
        np.testing.assert_array_equal(side, wanted)


def block(coupled: bool) -> tuple[list[Any], Any, Any]:
    """Unknowns u, v with u² + p v = q and u - v = 1, of two problems; ``coupled`` by their sum."""
    graph = Graph()
    p, q = (Quantity(graph, graph.leaf("input", n, x)) for n, x in (("p", 2.0), ("q", np.array([7.0, 13.0]))))
    u = np.sqrt(np.array([7.0, 13.0]) + 3) - 1
    made = Block({"u": (q.re,), "v": (q.re,)}, single=False)
    made.nodes = tuple(graph.found(made, k, "u, v", x) for k, x in enumerate([u, u - 1]))
    x, y = (Quantity(graph, node) for node in made.nodes)
    first = x**2 + p * y - q + (1e-300 * x.sum() if coupled else 0)
    made.residuals = (first.re, (x - y - 1).re)
    made.rest()
    return [p, q], (x, y), made


@pytest.mark.parametrize("coupled", [False, True])
def test_what_is_found_moves_with_its_equations(coupled: bool) -> None:
    (p, q), (x, y), made = block(coupled)
    assert made.elementwise != coupled
    u, v = x.value, y.value
    assert jacobian(made).shape == ((1, 4, 4) if coupled else (2, 2, 2))
    wanted = (x + 3 * y).re
    seen = slopes([wanted], [p.re, q.re])[wanted]
    for element in range(wanted.size):
        assert_same(gradient(wanted, element, [p.re, q.re]), seen, element)
    found = seen.both
    # with v = u - 1: (2 u + p) du = dq - v dp
    by_p, by_q = -v / (2 * u + 2), 1 / (2 * u + 2)
    np.testing.assert_allclose(found, 4 * np.array([by_p, [by_q[0], 0], [0, by_q[1]]]), rtol=1e-14, atol=1e-16)


def test_what_is_not_recorded_has_no_slope(tmp_path: Path) -> None:
    _, recording = recorded(own(tmp_path, "y = float(np.sort_complex([g.F, 2.0])[0].real) + g.a  # [-] not recorded"))
    node, (F, a) = recording.values["y"].re, (recording.inputs[k] for k in "Fa")
    lacking = unfollowed([node], [F])
    assert lacking is not None and lacking.op == "exported" and lacking.line == recording.gaps[0].line
    assert unfollowed([node], [recording.inputs["n"]]) is None
    assert np.isnan(gradient(node, 0, [F]).both).all()
    assert np.isnan(slopes([node], [F])[node].both).all() and unfollowed([F], [a]) is None


JUMPING = [  # at F = 1: what jumps there is compared with something that it is not equal to
    "np.where(np.floor(g.F) > 0.5, g.a, 2 * g.a)",
    "np.where(g.F % 1.0 > 0.5, g.a, 2 * g.a)",
    "np.where(np.sign(g.F - 1) > -0.5, g.a, 2 * g.a)",
    "g.a if np.round(g.F + 0.5) > 1.5 else 2 * g.a",
    "max(0.5, g.F % 1.0)",
    "abs(np.floor(g.F) - 0.2)",
]


@pytest.mark.parametrize("line", JUMPING)
def test_a_comparison_with_what_jumps_has_no_slope(line: str, tmp_path: Path) -> None:
    """The condition holds or not just beside the point, and a slope of 0 was told there."""
    _, recording = recorded(own(tmp_path, f"y = {line}  # [-] result"), F=1.0)
    node, by = recording.values["y"].re, recording.inputs["F"]
    assert np.isnan(slopes([node], [by])[node].both).all()


def test_a_slope_that_is_infinite_on_either_side_is_none(tmp_path: Path) -> None:
    """Of a root of an amount at 0 it is inf ahead and -inf behind, and inf was told."""
    _, recording = recorded(own(tmp_path, "y = sqrt(abs(g.F))  # [-] result"), F=0.0)
    node, by = recording.values["y"].re, recording.inputs["F"]
    assert np.isnan(slopes([node], [by])[node].both).all()


def test_a_place_that_is_not_known_moves_as_nobody_knows() -> None:
    """Of the greatest of numbers that are not followed all slopes ended in an error."""
    motion = Motion(np.array([[1.0, 2.0], [0.0, 0.0]]), np.array([[True, True], [False, False]]))
    moved = reduced("argmax", np.array([1.0, 2.0]), np.nan, motion)
    np.testing.assert_equal(moved.ahead, [np.nan, 0.0])
