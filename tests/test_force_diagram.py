"""Groups cut free and polar diagrams, read back from the elements of their drawings."""

from itertools import combinations

import numpy as np
import pytest
from cells import run

from mechsheet.document.layout import lay_out
from mechsheet.worksheet.drawing import Drawing, Element
from mechsheet.worksheet.force_diagram import cut_group, largest_of, polar

PHI = np.linspace(0, 2 * np.pi, 361)
A = 0.1 * np.exp(1j * PHI)
F = 500 * np.exp(-2j * PHI)


def arrows(drawing: Drawing) -> dict[str, Element]:
    return {e.name: e for e in drawing.elements if e.kind == "arrow"}


def crank(k: int) -> Drawing:
    return cut_group(
        Drawing(width=400, height=300).link(0j, A[k], "1"),
        k,
        {"R21": (A, F, 0), "R_O1": (0, -F, A), "G": (A / 2, -30j)},
        [0, A],
    )


def test_forces_of_the_position_stand_at_their_points() -> None:
    for k in (0, 40, 300):
        drawn = arrows(crank(k))
        assert {name: e.points[0] for name, e in drawn.items()} == {"R21": A[k], "R_O1": 0, "G": A[k] / 2}
        assert {name: -e.vector if e.into else e.vector for name, e in drawn.items() if e.vector is not None} == {
            "R21": F[k],
            "R_O1": -F[k],
            "G": -30j,
        }


def test_force_at_a_pin_stands_on_the_side_without_the_link() -> None:
    for k in range(0, 360, 7):
        e = arrows(crank(k))["R21"]
        assert e.vector is not None
        to_the_link = (np.conj(e.vector) * (0 - A[k])).real  # the arrow goes from the pin along its vector
        assert to_the_link <= 1e-9


def test_frame_and_scale_rest_while_the_position_changes() -> None:
    one, other = crank(10), crank(200)
    assert one.scales == other.scales == {"N": pytest.approx(0.25 * 0.2 / 500)}
    assert np.array_equal(np.asarray(one.frame), np.asarray(other.frame))
    low, high = np.asarray(one.frame)
    ends = np.concatenate([A + one.scales["N"] * F, A - one.scales["N"] * F, A / 2 - 30j * one.scales["N"]])
    assert low.real <= ends.real.min() and low.imag <= ends.imag.min()
    assert high.real >= ends.real.max() and high.imag >= ends.imag.max()
    assert (one.width, one.height) == (400, 300)


def test_position_that_does_not_close_has_no_arrow_and_none_at_all_no_frame() -> None:
    open_ = np.where(np.arange(361) < 5, np.nan, A)
    drawn = cut_group(Drawing(), 2, {"R": (open_, F, 0)}, [open_])
    assert 'data-shape="arrow"' not in drawn.svg()
    never = cut_group(Drawing().hinge(0j, "O"), 2, {"R": (np.nan * A, F, 0)}, [np.nan * A])
    assert never.svg() == Drawing().hinge(0j, "O").svg()


def test_forces_that_are_zero_have_a_scale_all_the_same() -> None:
    assert cut_group(Drawing(), 0, {"R": (A, 0 * F)}, [0, A]).svg().count("<svg") == 1


def test_polar_diagram_marks_the_quarters_of_the_turn() -> None:
    R = 200 * np.exp(1j * PHI) + 50
    drawing = polar(R, 90, "R12")
    assert {e.name: e.points[0] for e in drawing.elements if e.kind == "hinge"} == {
        f"{k}°": R[k] for k in (0, 90, 180, 270)
    }
    assert arrows(drawing)["R12"].vector == R[90] and arrows(drawing)["R12"].points == (0,)
    assert drawing.unit == "N", "arrows have the scale of the curve"
    half = polar(R[::2], 45, "R12", turn=180)
    assert [e.points[0] for e in half.elements if e.kind == "hinge"] == [R[k] for k in (0, 90, 180, 270)]


@pytest.mark.parametrize("place", [1.0, 5.0, -2.0 + 3.0j])
@pytest.mark.parametrize("size", [0.02, 0.1, 0.4])
def test_names_of_a_polar_diagram_do_not_meet_where_its_quarters_are_close(size: float, place: complex) -> None:
    """As those of a bearing are, where the force is small but for the stroke in which the gas works."""
    stroke = np.exp(-(((PHI - 3.6) / 0.3) ** 2)) * (-30 + 12j * np.sin(2 * PHI))
    R = place + size * abs(place) * np.exp(3j * PHI) * (1 + 0.3 * np.cos(PHI)) + stroke
    for at in range(0, len(R), 24):
        names = lay_out(polar(R, at, "QA")).texts[:7]
        boxes = [(t.centre, t.half) for t in names]
        for (p, a), (q, b) in combinations(boxes, 2):
            apart, touch = p - q, a + b
            assert abs(apart.real) > touch.real or abs(apart.imag) > 0.75 * touch.imag, [t.name for t in names]


def test_polar_diagram_of_a_cycle_of_two_turns_marks_its_quarters() -> None:
    R = np.exp(1j * np.radians(np.arange(0, 721, 2))) * np.linspace(1, 2, 361)
    drawing = polar(R, 45, "R12", turn=180, turns=2)
    hinges = {e.name: e.points[0] for e in drawing.elements if e.kind == "hinge"}
    assert hinges == {"0°": R[0], "180°": R[90], "360°": R[180], "540°": R[270]}


def test_largest_magnitude_is_that_of_the_finite_elements() -> None:
    assert largest_of(np.array([3 + 4j, np.nan]), -2.0) == 5
    assert largest_of(np.array([np.nan]), 0.0) == 1


def test_polar_diagrams_stand_over_what_their_lines_say() -> None:
    lines = "R_A = 2.0 * exp(1j * phi)  # [N] crank on the rod, at A\nR_B = 3 * R_A\n"
    names = run(
        "from numpy import exp, linspace, pi\nfrom mechsheet import polar_diagrams\nphi = linspace(0, 2 * pi, 361)\n"
        f"{lines}shown = polar_diagrams(40, R12=R_A, R23=R_B)"
    )
    (first, said), (second, unsaid) = names["shown"].columns
    assert arrows(first)["R12"].vector == names["R_A"][40] and said == "crank on the rod, at A"
    assert arrows(second)["R23"].vector == names["R_B"][40] and unsaid == "", "no line declares it"
