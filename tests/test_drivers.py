"""The crank and the intervals of its angle in which the group behind it closes."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from mechsheet.mechanics.crank import CrankReach, crank, rpr_crank_reach, rrp_crank_reach, rrr_crank_reach
from mechsheet.mechanics.rpr import rpr
from mechsheet.mechanics.rrp import rrp
from mechsheet.mechanics.rrr import rrr

lengths = st.floats(0.01, 10)
coordinates = st.floats(-10, 10).map(lambda x: round(x, 3))
points = st.builds(complex, coordinates, coordinates)
NEAR_END = 1e-6  # [rad] the ends of the interval are known to rounding, which a square root widens at a dead centre


def agrees(reach: CrankReach, closes: Any) -> None:
    """The group closes at the angles inside the reach, and at no other."""
    theta = np.linspace(0, np.pi, 181)
    inside = (theta >= reach.least + NEAR_END) & (theta <= reach.greatest - NEAR_END)
    outside = (theta < reach.least - NEAR_END) | (theta > reach.greatest + NEAR_END) | np.isnan(reach.least)
    for side in (+1, -1):
        closed = closes(reach.axis + side * theta)
        assert np.all(closed[inside])
        assert not np.any(closed[outside])


@given(points, lengths, points.filter(bool), lengths, lengths)
@example(0, 1, 3, 1.5, 1.5)
@example(0, 1, 3, 0.5, 0.5)
@example(0, 1, 3, 5, 0.5)
def test_rrr_closes_inside_the_crank_reach_only(O1: complex, r: float, frame: complex, r_A: float, r_B: float) -> None:
    B = O1 + frame
    agrees(
        rrr_crank_reach(O1, B, r, r_A, r_B),
        lambda phi: np.isfinite(rrr(crank(O1, r, phi), B, r_A, r_B, 1)),
    )


@given(points, lengths, points.filter(bool), coordinates)
@example(0, 2, 1, 0.5)
@example(0, 1, 4, 0.5)
@example(0, 1, 4, 9)
def test_slotted_link_closes_inside_the_crank_reach_only(O1: complex, r: float, frame: complex, e: float) -> None:
    B = O1 + frame
    agrees(rpr_crank_reach(O1, B, r, e), lambda phi: np.isfinite(rpr(crank(O1, r, phi), B, 1, e).s))


@given(points, lengths, points, points.filter(bool), lengths, coordinates)
@example(0, 1, 0, 1, 3, 0.5)
@example(0, 1, 0, 1, 0.5, 0.2)
@example(0, 1, 0, 1, 0.5, 9)
def test_slider_closes_inside_the_crank_reach_only(
    O1: complex, r: float, B: complex, u: complex, r_A: float, e: float
) -> None:
    agrees(
        rrp_crank_reach(O1, B, u, r, r_A, e),
        lambda phi: np.isfinite(rrp(crank(O1, r, phi), B, u, r_A, 1, e)),
    )


def test_grashof_crank_turns_fully_and_a_short_dyad_stops_it_at_its_dead_centres() -> None:
    r_B = np.array([0.3, 0.1, 0.02])  # beside a crank of 0.1, a frame of 0.4 and a coupler of 0.35
    axis, low, high = rrr_crank_reach(0, 0.4j, 0.1, 0.35, r_B)
    assert axis == np.pi / 2
    assert (low[0], high[0]) == (0, np.pi)
    nearest, farthest = (np.abs(crank(0, 0.1, axis + theta) - 0.4j) for theta in (low, high))
    assert nearest == pytest.approx(np.maximum(0.3, 0.35 - r_B), rel=1e-14)
    assert farthest == pytest.approx(np.minimum(0.5, 0.35 + r_B), rel=1e-14)


def test_reach_of_crank_variants_is_nan_alone_where_none_exists() -> None:
    reach = rrr_crank_reach(0, 5, 1, 1, [3.5, 2.5, 7.5])
    assert np.array_equal(np.isnan(reach.least), [False, True, True])
    assert np.array_equal(np.isnan(reach.greatest), [False, True, True])


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: crank(0, -1, 0), "length r = -1 m must not be negative"),
        (lambda: crank(0, 1, [0, np.nan]), "angle phi = nan rad must be a finite number"),
        (lambda: rrr_crank_reach(0, 3, 1, 1, -2), "length r_B = -2 m must not be negative"),
        (lambda: rpr_crank_reach(0, 3, 1, np.nan), "offset = nan m must be a finite number"),
        (lambda: rrp_crank_reach(0, 3, 0, 1, 2), "direction u = 0 must not be zero"),
    ],
)
def test_a_bad_argument_is_named_with_its_value(call: Any, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        call()
