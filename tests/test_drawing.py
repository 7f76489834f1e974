"""Drawings, read back from their SVG: what stands where, to which scale, and what is left out."""

import re
from cmath import rect
from collections.abc import Callable
from itertools import pairwise
from math import inf, isfinite, nan, pi
from typing import Any, cast
from xml.etree import ElementTree

import numpy as np
import pytest
from conftest import examples
from hypothesis import given
from hypothesis import strategies as st

from mechsheet.document.drawing_svg import COLOURS as WRITTEN
from mechsheet.worksheet.drawing import COLOURS, Drawing
from mechsheet.worksheet.errors import SheetError
from mechsheet.worksheet.title import caption, side_by_side

SVG = "{http://www.w3.org/2000/svg}"
HALF_DIGIT = 0.05  # px, numbers are printed to 0.1 px
DIAGONAL = 2**0.5 * HALF_DIGIT  # how far a printed point is off at most
FRAME = [-2 - 2j, 2 + 2j]


def parsed(drawing: Drawing) -> ElementTree.Element:
    return ElementTree.fromstring(drawing.svg())


def shapes(root: ElementTree.Element, kind: str) -> list[ElementTree.Element]:
    return [g for g in root.iter(f"{SVG}g") if g.get("data-shape") == kind]


def lines(element: ElementTree.Element) -> list[list[complex]]:
    """Points of every line under an element, y up."""
    out = []
    for path in element.iter(f"{SVG}path"):
        for piece in path.attrib["d"].split("M")[1:]:
            out.append([complex(float(x), -float(y)) for x, y in (p.split() for p in piece.split("L"))])
    return out


def circles(element: ElementTree.Element) -> list[tuple[complex, float]]:
    return [
        (complex(float(c.attrib["cx"]), -float(c.attrib["cy"])), float(c.attrib["r"]))
        for c in element.iter(f"{SVG}circle")
    ]


def texts(root: ElementTree.Element) -> dict[str, complex]:
    return {
        "".join(t.itertext()): complex(float(t.attrib["x"]), -float(t.attrib["y"])) for t in root.iter(f"{SVG}text")
    }


def view(root: ElementTree.Element) -> tuple[float, float, float, float]:
    x, y, width, height = map(float, root.attrib["viewBox"].split())
    return x, y, width, height


def on_page(drawing: Drawing) -> Callable[[complex], complex]:
    """The map from metres to the page, from two hinges that are drawn along: equal axes, y up."""
    zero, one = (circles(g)[0][0] for g in shapes(parsed(drawing.hinge(0j).hinge(2 + 0j)), "hinge")[-2:])
    assert zero.imag == one.imag and one.real > zero.real
    return lambda z: zero + (one - zero) / 2 * z


def test_points_stand_to_one_scale_on_both_axes_with_y_up() -> None:
    points = [0.3 + 0.7j, -1.5 + 1j, 1 - 1.25j, 2j]
    drawing = Drawing(frame=FRAME)
    for point in points:
        drawing = drawing.hinge(point)
    place = on_page(drawing)
    drawn = [circles(g)[0][0] for g in shapes(parsed(drawing), "hinge")]
    for point, p in zip(points, drawn, strict=True):
        assert abs(p - place(point)) < 2 * DIAGONAL


def test_picture_without_frame_fills_the_asked_size_and_keeps_equal_axes() -> None:
    for corner in (1 + 1j, 10 + 1j, 1 + 10j, 1e-3 + 2e-3j, 4e5 + 1e5j):
        drawing = Drawing(width=640, height=480).hinge(0j).hinge(corner)
        root = parsed(drawing)
        a, b = (circles(g)[0][0] for g in shapes(root, "hinge"))
        assert (b - a).imag / (b - a).real == pytest.approx(corner.imag / corner.real, rel=2e-3)
        assert 0.8 < max(abs((b - a).real) / 640, abs((b - a).imag) / 480) < 1


def test_link_ends_at_the_circles_of_its_hinges_and_without_them_at_its_points() -> None:
    A, B = -1 - 1j, 1 + 0.5j
    place = on_page(Drawing(frame=FRAME))
    a, b = place(A), place(B)
    [[p, q]] = lines(shapes(parsed(Drawing(frame=FRAME).link(A, B)), "link")[0])
    assert abs(p - a) < 2 * DIAGONAL and abs(q - b) < 2 * DIAGONAL
    root = parsed(Drawing(frame=FRAME).link(A, B).hinge(A).mass(B))
    [[p, q]] = lines(shapes(root, "link")[0])
    for end, centre, kind in ((p, a, "hinge"), (q, b, "mass")):
        [(_, r)] = circles(shapes(root, kind)[0])
        assert abs(abs(end - centre) - r) < 3 * DIAGONAL


def test_link_to_a_point_computed_twice_still_ends_at_the_hinge() -> None:
    root = parsed(Drawing(frame=FRAME).link(0j, 0.3 + 0j).hinge(0.1 + 0.2 + 0j))
    [[_, end]] = lines(shapes(root, "link")[0])
    [(centre, r)] = circles(shapes(root, "hinge")[0])
    assert abs(centre - end) == pytest.approx(r, abs=3 * DIAGONAL)


def test_plate_has_an_edge_between_all_its_corners() -> None:
    corners = [0j, 1 + 0j, 0.5 + 1j]
    place = on_page(Drawing(frame=FRAME))
    edges = [line for line in lines(shapes(parsed(Drawing(frame=FRAME).plate(corners)), "plate")[0]) if len(line) == 2]
    for edge, ends in zip(edges, ((0, 1), (1, 2), (2, 0)), strict=True):
        assert all(abs(p - place(corners[i])) < 2 * DIAGONAL for p, i in zip(edge, ends, strict=True))


def test_wheel_has_its_radius_to_scale() -> None:
    place = on_page(Drawing(frame=FRAME))
    outer = circles(shapes(parsed(Drawing(frame=FRAME).wheel(1j, 0.75)), "wheel")[0])[0]
    assert outer[0] == pytest.approx(place(1j), abs=2 * DIAGONAL)
    assert outer[1] == pytest.approx(0.75 * abs(place(1) - place(0)), abs=DIAGONAL)


def test_cylinder_barrel_keeps_its_length_while_the_stroke_grows() -> None:
    place = on_page(Drawing(frame=FRAME))

    def barrel_end(S: float) -> complex:
        box = lines(shapes(parsed(Drawing(frame=FRAME).cylinder(0j, S + 0j, barrel=0.8)), "cylinder")[0])
        return max((p for line in box if len(line) == 5 for p in line), key=lambda p: p.real)

    assert barrel_end(0.9).real == pytest.approx(place(0.8).real, abs=2 * DIAGONAL)
    assert barrel_end(0.9) == barrel_end(1.5)


def test_guide_lies_below_the_slider_that_it_carries() -> None:
    root = parsed(Drawing(frame=FRAME).guide(-1 + 0j, 1 + 0j).slider(0j))
    block = [p for line in lines(shapes(root, "slider")[0]) for p in line]
    surface = lines(shapes(root, "guide")[0])[0]
    assert {p.imag for p in surface} == {min(p.imag for p in block)}


def test_hatching_of_the_ground_is_on_the_right() -> None:
    surface, *hatching = lines(shapes(parsed(Drawing(frame=FRAME).ground(-1 + 0j, 1 + 0j)), "ground")[0])
    assert len(hatching) > 10
    assert all(p.imag == surface[0].imag and q.imag < p.imag for p, q in hatching)


def test_support_stands_in_the_direction_of_the_frame() -> None:
    below = Drawing(frame=FRAME).support(0j)
    turned = [(Drawing(frame=FRAME).support(0j, angle=angle), angle) for angle in (0.0, pi / 2, 2.5)]
    for drawing, angle in [(below, -pi / 2), *turned]:
        root = parsed(drawing)
        [(pin, _)] = circles(shapes(root, "support")[0])
        points = [p for line in lines(shapes(root, "support")[0]) for p in line]
        assert ((np.mean(points) - pin) * rect(1, -angle)).real > 10


# Arrows


def arrow(element: ElementTree.Element) -> complex:
    """Vector from tail to tip: the shaft's first point, the head's first point."""
    shaft, head = lines(element)
    return head[0] - shaft[0]


def test_arrows_are_proportional_to_their_forces() -> None:
    forces = [3000 + 4000j, -1500 + 0j, 700j, 2000 - 1000j]
    drawing = Drawing().link(0j, 1 + 0j)
    for i, force in enumerate(forces):
        drawing = drawing.force(i / 4 + 0j, force)
    drawn = [arrow(g) for g in shapes(parsed(drawing), "arrow")]
    for force, vector in zip(forces, drawn, strict=True):
        assert vector / abs(drawn[0]) == pytest.approx(force / 5000, abs=0.005)
    assert abs(drawn[0]) > 40


def test_given_scale_of_forces_is_metres_per_newton_and_holds_for_a_small_force_too() -> None:
    place = on_page(Drawing(frame=FRAME))
    for force in (10e3, 20e3, 1e3j):
        drawing = Drawing(frame=FRAME, scales={"N": 5e-5}).force(0j, force)
        assert arrow(shapes(parsed(drawing), "arrow")[0]) == pytest.approx(
            place(force * 5e-5) - place(0), abs=2 * DIAGONAL
        )


def test_arrow_into_a_point_ends_there() -> None:
    root = parsed(Drawing(frame=FRAME).force(1j, 1000j, into=True).force(-1j, 1000j))
    into, out = shapes(root, "arrow")
    place = on_page(Drawing(frame=FRAME))
    assert abs(lines(into)[1][0] - place(1j)) < 2 * DIAGONAL
    assert abs(lines(out)[0][0] - place(-1j)) < 2 * DIAGONAL
    assert arrow(into) == pytest.approx(arrow(out), abs=2 * DIAGONAL)


def test_scale_bars_are_round_and_true() -> None:
    for size in (0.037, 1.0, 240.0):
        drawing = Drawing().link(0j, size + 0.6j * size).force(0j, 48_480 + 0j).arrow(0j, 0.3j, "v", "m/s")
        root = parsed(drawing)
        a, b = lines(shapes(root, "link")[0])[0]
        px = {"m": abs(b - a) / abs(size + 0.6j * size)}
        px["N"], px["m/s"] = (abs(arrow(g)) / v for g, v in zip(shapes(root, "arrow"), (48_480, 0.3), strict=True))
        labels = [t for t in texts(root) if t[0].isdigit()]
        for bar, label in zip(shapes(root, "scale"), labels, strict=True):
            number, unit = label.split()
            assert (unit == "mm") == (unit[0] == "m" and "/" not in unit and size < 0.1), "small lengths are told in mm"
            shown, (factor, unit) = float(number), {"kN": (1000, "N"), "mm": (1e-3, "m")}.get(unit, (1, unit))
            value = float(f"{shown * factor:.12g}")
            assert f"{value:e}"[0] in "125" and float(f"{value:.0e}") == value
            length = abs(arrow(bar)) if unit != "m" else abs(lines(bar)[0][2] - lines(bar)[0][1])
            assert length == pytest.approx(value * px[unit], abs=0.7)
            assert length > 40


def test_diagram_of_forces_has_their_scale_and_no_other() -> None:
    root = parsed(Drawing(unit="N").path([0j, 3000 + 4000j]).force(0j, 3000 + 4000j))
    curve, force = lines(shapes(root, "path")[0])[0], shapes(root, "arrow")[0]
    assert arrow(force) == pytest.approx(curve[1] - curve[0], abs=2 * DIAGONAL)
    (bar,) = shapes(root, "scale")
    (label,) = texts(root)
    number, unit = label.split()
    newtons = float(number) * {"N": 1, "kN": 1000}[unit]
    assert abs(arrow(bar)) / abs(arrow(force)) == pytest.approx(newtons / 5000, abs=0.01)


# Left out


ELEMENTS: dict[str, Callable[[Drawing, complex], Drawing]] = {
    "link": lambda d, z: d.link(z, 1 + 0j, "4"),
    "plate": lambda d, z: d.plate([0j, z, 1j], "3"),
    "cylinder": lambda d, z: d.cylinder(0j, z, "S"),
    "slot": lambda d, z: d.slot(z, 1j, "3"),
    "slider": lambda d, z: d.slider(z, 0.3, "2"),
    "hinge": lambda d, z: d.hinge(z, "P34"),
    "support": lambda d, z: d.support(z, "O1"),
    "mass": lambda d, z: d.mass(z, "S6"),
    "text": lambda d, z: d.text(z, "horizon"),
    "ground": lambda d, z: d.ground(0j, z),
    "guide": lambda d, z: d.guide(z, 1 + 0j),
    "wheel": lambda d, z: d.wheel(z, 0.5, "1"),
    "polygon": lambda d, z: d.polygon([0j, 1 + 0j, z], "A", "red"),
    "path": lambda d, z: d.path([z, 1 + 0j], "S6"),
    "arrow": lambda d, z: d.force(z, 1000j, "R56"),
    "dimension": lambda d, z: d.dimension(0j, z, "L13"),
}


@pytest.mark.parametrize("kind", ELEMENTS)
@pytest.mark.parametrize("bad", [complex(nan, nan), complex(0, nan), complex(inf, 0)])
def test_element_without_a_finite_point_is_left_out_and_the_others_stay(kind: str, bad: complex) -> None:
    others = Drawing().hinge(-1 + 0j, "A").hinge(1 + 1j, "B")
    drawing = ELEMENTS[kind](others, bad)
    assert len(ELEMENTS[kind](others, 0.5 + 0.5j).svg()) > len(others.svg())
    assert drawing.svg() == others.svg()


@pytest.mark.parametrize("bad", [nan, inf])
def test_element_with_a_vector_angle_or_radius_that_is_not_finite_is_left_out(bad: float) -> None:
    others = Drawing().hinge(0j).hinge(1 + 1j)
    for drawing in (
        others.force(0j, complex(bad, 0), "R"),
        others.slider(0j, bad, "3"),
        others.support(0j, "O", angle=bad),
        others.wheel(0j, bad, "1"),
    ):
        assert drawing.svg() == others.svg()


def test_zero_force_has_no_arrow() -> None:
    root = parsed(Drawing().hinge(0j).hinge(1 + 0j).force(0j, 0j, "R01").force(1 + 0j, 5000j, "R02"))
    assert [bool(lines(g)) for g in shapes(root, "arrow")] == [True]
    assert "R01" not in texts(root) and "R02" in texts(root)


def test_path_is_interrupted_where_it_is_not_finite() -> None:
    points = np.array([0, 1, 2 + 1j, nan, 3, 4 + 1j, complex(nan, 1)])
    root = parsed(Drawing().path(points, "S6"))
    assert [len(line) for g in shapes(root, "path") for line in lines(g)] == [3, 2]
    assert "S6" in texts(root)


def test_drawing_of_nothing_is_empty() -> None:
    assert not list(parsed(Drawing()).iter(f"{SVG}path"))
    assert not list(parsed(Drawing().path([])).iter(f"{SVG}path"))


# Names


def test_name_is_printed_as_symbol_with_index() -> None:
    svg = Drawing().hinge(0j, "P34").link(0j, 1 + 0j, "4").force(0j, 1j, "-R_05 = 5 N").mass(1 + 0j, "phi_3").svg()
    root = ElementTree.fromstring(svg)
    assert {"P34", "4", "−R05 = 5 N", "φ3"} <= set(texts(root))
    lowered = [t for t in root.iter(f"{SVG}tspan") if t.get("dy") == "4"]
    assert {t.text for t in lowered} == {"34", "05", "3"}


def test_text_is_escaped_and_what_xml_cannot_hold_is_replaced() -> None:
    wild = "<script>&\"']]>\x00\x1f\ud800"
    drawing = Drawing().text(0j, wild).hinge(1j, wild).arrow(0j, 1j, wild, wild)
    root = parsed(drawing)
    assert not list(root.iter(f"{SVG}script"))
    assert any(t.startswith("<script>&") for t in texts(root))


def test_names_keep_off_the_lines_and_off_each_other() -> None:
    for turn in np.linspace(0, 2 * pi, 25):
        A, B = rect(1, turn), 3 + 0.3j
        drawing = Drawing().support(0j, "O1").link(0j, A, "1").link(A, B, "2").hinge(A, "A").hinge(B, "B34")
        root = parsed(drawing + Drawing().link(0j, -1j * A).link(-1j * A, B).faint())
        names = {t: p + 5j for t, p in texts(root).items() if not t.endswith(" m")}  # from baseline to middle
        assert len(names) == 5
        places = list(names.values())
        assert min(abs(p - q) for i, p in enumerate(places) for q in places[:i]) > 10
        faint, *_ = root
        for shape in (g for kind in ("link", "support") for g in shapes(root, kind) if g not in list(faint)):
            for line in lines(shape):
                for p in places:
                    a, b = line
                    t = min(max(((p - a) * (b - a).conjugate()).real / abs(b - a) ** 2, 0), 1)
                    assert abs(a + t * (b - a) - p) > 5


def test_name_gives_way_to_a_line_and_crosses_a_faint_one_rather() -> None:
    link = Drawing(frame=FRAME).link(-2 + 0j, 2 + 0j, "1")
    above, below = Drawing().link(-2 + 0.07j, 2 + 0.07j), Drawing().link(-2 - 0.07j, 2 - 0.07j)

    def side(drawing: Drawing) -> bool:
        root = parsed(drawing)
        return texts(root)["1"].imag + 5 > lines(shapes(root, "link")[-1])[0][0].imag

    assert side(below + link) and not side(above + link)
    assert side(above.faint() + below + link) and not side(above + below.faint() + link)


def test_names_at_one_point_do_not_overlap() -> None:
    names = texts(parsed(Drawing(frame=FRAME).hinge(0j, "A1").hinge(0j, "B2")))
    apart = names["A1"] - names["B2"]
    assert abs(apart.real) > 20 or abs(apart.imag) > 15.9


def test_name_of_an_end_is_beyond_it_and_inside_a_given_frame() -> None:
    for turn in np.linspace(0, 2 * pi, 9):
        root = parsed(Drawing(frame=FRAME).link(0j, rect(1, turn)).hinge(rect(1, turn), "A"))
        [(pin, _)] = circles(shapes(root, "hinge")[0])
        assert ((texts(root)["A"] + 5j - pin) / rect(1, turn)).real > 9
    root = parsed(Drawing(frame=FRAME).link(0j, 2.35j).hinge(2.35j, "A"))
    assert -texts(root)["A"].imag > view(root)[1] + 10


# The picture as a whole


def test_frame_holds_the_picture_still_whatever_is_drawn() -> None:
    frame = np.array([0j, 2 + 1j, nan, 1 + 1.5j])
    views = {view(parsed(Drawing(frame=frame).link(0j, z, "1").force(z, 1000j, "F"))) for z in (1j, 2 + 1j, 9 - 5j)}
    assert len(views) == 1


def test_faint_elements_come_first_pale_without_names_and_without_the_frame() -> None:
    scheme = Drawing().support(0j, "O1").link(0j, 1j, "1").hinge(1j, "A").ground(-1 - 1j, 1 - 1j)
    root = parsed(Drawing() + Drawing().link(0j, 1 + 0j, "2") + scheme.faint())
    pale = next(iter(root))
    assert float(pale.attrib["opacity"]) < 0.5
    assert [g.get("data-shape") for g in pale] == ["link", "hinge"]
    assert set(texts(root)) - {"2"} == {t for t in texts(root) if t.endswith(" m")}


def test_drawing_is_a_value() -> None:
    one = Drawing().link(0j, 1 + 0j)
    before = one.svg()
    one.hinge(0j, "A")
    one.faint()
    assert (one + Drawing().hinge(5j)).svg() != before == one.svg()


def test_several_pictures_share_a_page_without_clashing_and_follow_its_colour() -> None:
    drawing = Drawing()
    for add in ELEMENTS.values():
        drawing = add(drawing, 0.5 + 0.7j)
    svg = drawing.svg()
    assert not re.search(r"\bid=|url\(|href|<style|class=", svg)
    colours = set(re.findall(r'(?:fill|stroke)="([^"]*)"', svg)) - {"none"}
    assert colours <= set(WRITTEN.values()) and "currentColor" in colours
    assert set(WRITTEN) == {"", *COLOURS}
    assert drawing._mime_() == ("text/html", svg)


def scheme(A: complex) -> Drawing:
    plates = Drawing().cylinder(0.4 + 0.5j, A, "S").plate([0.2 + 1j, A, A + 0.2], "3").plate([1j, 2 + 0j, A - 1], "6")
    links = plates.link(A, 0.6 + 0.3j, "4").link(0.1 + 0.4j, 1.1 + 0.2j, "5").link(0.4 + 0.9j, 1.1 + 0.7j, "7")
    for i, pin in enumerate((0.4 + 0.5j, 0.2 + 1j, 0.1 + 0.4j, 0.4 + 0.9j)):
        links = links.support(pin, f"O{i}")
    for i, P in enumerate((A, A + 0.2, 0.6 + 0.3j, 1.1 + 0.2j, 1.1 + 0.7j)):
        links = links.hinge(P, f"P{i}")
    return links.mass(2 + 0j, "S6")


def test_mechanism_with_two_faint_positions_is_small_and_printed_to_a_tenth_of_a_pixel() -> None:
    svg = (scheme(0.4 + 1j).faint() + scheme(0.5 + 1.2j).faint() + scheme(0.45 + 1.1j)).svg()
    assert len(svg) < 20_000
    numbers = " ".join(re.findall(r' (?:d|cx|cy|x|y|viewBox)="([^"]*)"', svg))
    assert not re.search(r"\.\d\d", numbers)


REALS = st.floats(allow_nan=False, allow_infinity=False)
POINTS = st.complex_numbers(allow_nan=False, allow_infinity=False) | st.complex_numbers(max_magnitude=3)
POSITIVE = st.floats(min_value=0, exclude_min=True, allow_infinity=False)
NAMES = st.text(max_size=12)
MOVES = st.one_of(
    st.tuples(st.sampled_from(["link", "slot", "dimension"]), POINTS, POINTS, NAMES),
    st.tuples(st.just("cylinder"), POINTS, POINTS, NAMES, POSITIVE | st.none()),
    st.tuples(st.sampled_from(["ground", "guide"]), POINTS, POINTS),
    st.tuples(st.sampled_from(["hinge", "mass", "text", "support"]), POINTS, NAMES),
    st.tuples(st.just("slider"), POINTS, REALS, NAMES),
    st.tuples(st.just("wheel"), POINTS, POSITIVE, NAMES),
    st.tuples(st.sampled_from(["plate", "polygon"]), st.lists(POINTS, min_size=3, max_size=5), NAMES),
    st.tuples(st.just("path"), st.lists(POINTS, max_size=6), NAMES),
    st.tuples(st.just("force"), POINTS, POINTS, NAMES, st.booleans()),
    st.tuples(st.just("arrow"), POINTS, POINTS, NAMES, NAMES),
)


@examples(100)
@given(st.lists(MOVES, max_size=8), st.integers(0, 8))
def test_any_finite_input_gives_well_formed_svg_inside_its_view(moves: list[tuple[Any, ...]], cut: int) -> None:
    def drawn(some: list[tuple[Any, ...]]) -> Drawing:
        drawing = Drawing()
        for kind, *arguments in some:
            drawing = getattr(drawing, kind)(*arguments)
        return drawing

    root = parsed(drawn(moves[:cut]).faint() + drawn(moves[cut:]))
    x, y, width, height = view(root)
    assert all(map(isfinite, (x, y, width, height))) and 0 < width < 2000 and 0 < height < 2000
    inked = [p for line in lines(root) for p in line] + list(texts(root).values())
    inked += [c + r * side for c, r in circles(root) for side in (1, -1, 1j, -1j)]
    for p in inked:
        assert x - 0.11 <= p.real <= x + width + 0.11
        assert y - 0.11 <= -p.imag <= y + height + 0.11


@pytest.mark.parametrize(
    ("build", "message"),
    [
        (lambda: Drawing().link(cast(Any, np.zeros(3)), 0j), "link: its points must be single complex numbers"),
        (lambda: Drawing().hinge(cast(Any, np.zeros(3))), r"hinge: .* got arrays of shape \(3,\)"),
        (lambda: Drawing().hinge(cast(Any, "A")), "hinge: its points must be single complex numbers"),
        (lambda: Drawing().link(0j, 1 + 0j, cast(Any, 3)), "link: its name must be a text between quotes, not 3"),
        (lambda: Drawing().plate([0j, 1j]), "plate: needs 3 points or more, got 2"),
        (lambda: Drawing().path(np.zeros((2, 3))), r"path: .* got arrays of shape \(3,\)"),
        (lambda: Drawing().force(0j, cast(Any, np.zeros(3))), "arrow: its points must be single complex numbers"),
        (lambda: Drawing().cylinder(0j, 1j, barrel=-0.2), "barrel of the cylinder = -0.2 m must be positive"),
        (lambda: Drawing().wheel(0j, 0.0), "radius of the wheel = 0.0 m must be positive"),
        (lambda: Drawing().polygon([0j, 1j, 1], colour="pink"), "'pink' is not known; there are blue, red"),
        (lambda: Drawing(width=20), "drawing of 20 x 480 px"),
        (lambda: Drawing(scales={"N": -1e-5}), "scale of the arrows = -1e-05 m/N must be positive"),
    ],
)
def test_what_cannot_be_drawn_is_named(build: Callable[[], Drawing], message: str) -> None:
    with pytest.raises(SheetError, match=message):
        build()


def test_what_does_not_exist_is_not_drawn_and_the_rest_is() -> None:
    """Where a mechanism does not close, the check of that speaks, not a drawing behind it."""
    rest = Drawing().support(0j, "O")
    nowhere = Drawing(frame=[nan, complex(nan, nan)]).support(0j, "O")
    for drawing in (nowhere, nowhere.cylinder(0j, 1j, barrel=nan), nowhere.wheel(0j, nan), nowhere.path([nan, nan])):
        assert drawing.svg() == rest.svg()
    assert 'data-shape="arrow"' not in Drawing(scales={"N": nan}).support(0j, "O").force(0j, 1j).svg()


@pytest.mark.parametrize(("M", "sense"), [(5.0, 1), (np.float64(-5.0), -1)])
def test_moment_is_an_arc_in_its_sense(M, sense):
    """Counter-clockwise where positive: with y downwards the area that the arc sweeps has the other sign."""
    svg = Drawing(frame=[-1 - 1j, 1 + 1j]).moment(0j, M, "M").svg()
    arc = re.search(r'data-shape="moment".*?d="M([^"]*)"', svg)[1]
    points = [complex(*map(float, xy.split())) for xy in arc.split("L")]
    swept = sum((a.conjugate() * b).imag for a, b in pairwise(points))
    assert sense * swept < 0
    assert ": 5 N*m" in svg or ": -5 N*m" in svg
    assert "moment" not in Drawing(frame=[-1 - 1j, 1 + 1j]).moment(0j, 0.0).moment(0j, float("nan")).svg()


def test_bar_of_a_scale_has_the_colour_of_its_arrows():
    svg = Drawing().arrow(0j, 1 + 0j, "V", "m/s", "orange").svg()
    assert svg.count('stroke="#cf7a17"') == 2


def test_drawings_stand_side_by_side_each_above_its_caption():
    text = side_by_side((Drawing().hinge(0j, "A"), caption("5.1", "a < b")), Drawing().hinge(0j, "B"))._mime_()[1]

    first, second = re.fullmatch(r'<div class="ms-beside"><div>(.*)</div><div>(.*)</div></div>', text).groups()
    assert re.fullmatch(
        r'<svg.*</svg><div class="ms-caption" id="figure-5\.1"><b>Figure 5\.1</b> – a &lt; b</div>', first
    )
    assert re.fullmatch(r"<svg.*>B<.*</svg>", second)
