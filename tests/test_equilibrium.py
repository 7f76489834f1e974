"""Equilibrium of all bodies at once, against levers by hand and against the chain of groups."""

from dataclasses import replace

import numpy as np
import pytest
from by_cells import by_cells
from own_worksheet import written

from mechsheet import (
    DriveMoment,
    Load,
    PinReaction,
    RRPGroup,
    SlideReaction,
    balance,
    coupling_drive,
    left_over,
    load,
    magnitudes,
    solve_reactions,
)
from mechsheet.readers.numbers import numbers
from mechsheet.recording.record import record

# A crank O-A, a rod A-C, a slider C on the x axis against 400 N, the rod of 20 N in its middle
PHI = np.linspace(0, 2 * np.pi, 37)
A = 0.1 * np.exp(1j * PHI)
GROUP = RRPGroup(A, 0, 1, 0.35, +1)
ROD = Load(-20j, (A + GROUP.C) / 2)
WORK = Load(-400, GROUP.C)
FOUND = GROUP.reactions([ROD], [WORK])
DRIVE = coupling_drive(0, [Load(-FOUND.R_A, A)])
LOADS = [[Load(0, 0)], [ROD], [WORK]]
REACTIONS = (
    DriveMoment(1, DRIVE.M),
    PinReaction(1, 0, DRIVE.R_O1, 0),
    PinReaction(2, 1, FOUND.R_A, A),
    PinReaction(2, 3, FOUND.R_C, GROUP.C),
    SlideReaction(3, 0, FOUND.R_B, GROUP.C, 1),
)


def test_lever_by_hand() -> None:
    """A bar of 2 m, pinned at 0, on a slide at 2 along x: 30 N down in the middle, 7 N along it."""
    unknown = (PinReaction(1, 0, 0, 0), DriveMoment(1, 0))
    assert solve_reactions([[Load(7 - 30j, 1)]], unknown) == pytest.approx([-7, 30, 30])
    left = left_over([[Load(7 - 30j, 1)]], [PinReaction(1, 0, -7 + 30j, 0), DriveMoment(1, 30)])
    assert left.F.tolist() == [0] and left.M.tolist() == [0]


def test_chain_of_groups_leaves_nothing() -> None:
    left = left_over(LOADS, REACTIONS)
    assert left.F.shape == left.M.shape == (3, 37)
    assert np.max(np.abs(left.F)) < 1e-11 and np.max(np.abs(left.M)) < 1e-12
    assert all(c.passed for c in balance("bodies 1..3", LOADS, REACTIONS, 1e-14, 1000, 0.1))


def test_one_system_finds_what_the_chain_finds() -> None:
    zero = [replace(r, F=0, M=0) if not isinstance(r, DriveMoment) else DriveMoment(1, 0) for r in REACTIONS]
    found = solve_reactions(LOADS, zero)
    assert found.shape == (37, 9)
    assert np.max(np.abs(found - magnitudes(REACTIONS))) < 1e-11 * 400


@pytest.mark.parametrize("i", range(1, 5))
def test_a_wrong_reaction_is_left_on_both_bodies(i: int) -> None:
    wrong = list(REACTIONS)
    r = wrong[i]
    assert not isinstance(r, DriveMoment)
    wrong[i] = replace(r, F=r.F + 1j)  # type: ignore[operator]
    left = left_over(LOADS, wrong)
    assert left.F[r.on - 1] == pytest.approx(np.full(37, 1j))
    if r.by:
        assert left.F[r.by - 1] == pytest.approx(np.full(37, -1j))
    forces, _ = balance("bodies 1..3", LOADS, wrong, 1e-14, 1000, 0.1)
    assert not forces.passed and forces.residual == pytest.approx(1) and forces.name.endswith(", bodies 1..3")


def test_wrong_moment_is_left_on_the_driven_body() -> None:
    left = left_over(LOADS, [DriveMoment(1, DRIVE.M + 2), *REACTIONS[1:]])
    assert left.M[0] == pytest.approx(np.full(37, 2))


def test_mechanism_that_cannot_be_held_is_nan_there_alone() -> None:
    """A slider's rod across its guide holds nothing: the one position of the three is NaN."""
    point = np.array([1 + 1j, 1j, -1 + 1j])  # of the rod from the slider at 0, pinned to the frame
    bodies = [[Load(-1j, point / 2)], [Load(5, 0)]]
    unknown = [PinReaction(1, 0, 0, point), PinReaction(1, 2, 0, 0), SlideReaction(2, 0, 0, 0, 1)]
    assert np.isnan(solve_reactions(bodies, unknown)).all(-1).tolist() == [False, True, False]


@pytest.mark.parametrize(
    ("loads", "reactions", "message"),
    [
        ([[]], REACTIONS[:1], "body 1 has no load"),
        ([], [], r"loads = \[\] must be a sequence of the loads of each body"),
        (3, [], "loads = 3 must be a sequence of the loads of each body"),
        ([[Load(1j, 0)]], "R12", "reactions = 'R12' must be a sequence of reactions"),
        ([[Load(0, 0)]], REACTIONS[:1], "1 unknown reactions for 3 equations"),
        ([[Load(0, 0)]], [PinReaction(2, 0, 0, 0)], r"reaction on the body 2 by the body 0: there are bodies 0..1"),
    ],
)
def test_what_is_no_mechanism_is_named(loads, reactions, message) -> None:
    with pytest.raises(ValueError, match=message):
        solve_reactions(loads, reactions)


@pytest.mark.parametrize("function", [left_over, solve_reactions])
def test_shapes_that_do_not_broadcast_are_refused_by_name(function) -> None:
    loads = [[Load(np.ones(2), 0)], [Load(1, np.ones(3))]]
    with pytest.raises(
        ValueError, match=r"shapes do not broadcast: loads\[0\]\[0\].F \(2,\), loads\[1\]\[0\].P \(3,\)"
    ):
        function(loads, [PinReaction(1, 2, 0, 0), PinReaction(2, 0, 0, 0), PinReaction(1, 0, 0, 0)])
    with pytest.raises(ValueError, match=r"reactions\[0\].F \(2,\), reactions\[1\].P \(3,\)"):
        magnitudes([PinReaction(1, 0, np.ones(2), 0), SlideReaction(1, 0, 0, np.ones(3), 1, np.ones(3))])


def test_bodies_are_followed_for_other_numbers_of_positions(tmp_path) -> None:
    """The page knew no equilibrium as soon as there were more positions: the shapes were looked at to refuse them."""
    lines = """
phi = np.linspace(0, 3, g.k)
R, A = g.F * np.exp(2j * phi), np.exp(1j * phi)
loads, reactions = [[Load(-R, A)]], [PinReaction(1, 0, R, 0j), DriveMoment(1, cross(A, R))]
left = left_over(loads, reactions)
found = solve_reactions(loads, reactions)
y = np.abs(left.F[0]) + magnitudes(reactions)[..., 2] + found[..., 2]  # [N] result
table_1 = table("1", "All", y)
"""
    names = "DriveMoment, Load, PinReaction, ask, cross, inputs, left_over, magnitudes, read, solve_reactions, table"
    path = tmp_path / "bodies.py"
    given = "F: float = 2.0  # [N] force\nk: int = 4  # [-] how many; > 1"
    path.write_text(written(f"import numpy as np\nfrom mechsheet import {names}", given, lines))
    sheet = load(path)
    run = sheet.run(sheet.results, {"g": sheet.inputs()})
    recording = record({**run, "__file__": sheet.path}, whole=True, every=1, draws=True)
    assert not recording.gaps
    (column,) = recording.tables["1"]
    assert column is not None
    more = {recording.inputs["k"]: np.array(7.0)}
    np.testing.assert_allclose(numbers([column.re], more)[column.re], by_cells(path, ["y"], k=7)["y"], atol=1e-12)
