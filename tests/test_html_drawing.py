"""Drawings laid out in a page: the same picture as in Python, whatever is drawn."""

from __future__ import annotations

import re
from collections.abc import Callable
from random import Random
from typing import TYPE_CHECKING, Any

import pytest

from mechsheet.document import drawing_svg
from mechsheet.html import javascript, sketched
from mechsheet.quantities.sketch import Drawn, Sketch
from mechsheet.worksheet.drawing import COLOURS, Drawing

if TYPE_CHECKING:
    from playwright.sync_api import Page

STATES = 300
NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:e[+-]?\d+)?")
NAMES = ("", "P34", "-R05", "omega3", "O1 fixed", "β₀", "dRa", "group_23", "S6'")
DRAW = """specs => {
  %s
  const nothing = {values: {}};
  return specs.map(spec => drawingSVG(drawnWith(spec, nothing)));
}"""


def test_a_drawing_is_laid_out_as_python_lays_it_out(blank: Page) -> None:
    random = Random(19)
    drawings = [drawn(random) for _ in range(STATES)]
    specs = [sketched.told(Drawn(Sketch.of(each), ()), str) for each in drawings]
    script = javascript.runtime("format.js", "chart.js", "drawing.js", "looks.js")
    escaped = 'const escaped = text => String(text).replaceAll("&", "&amp;").replaceAll("<", "&lt;");'
    made = blank.evaluate(DRAW % (escaped + script), specs)
    wrong = [n for n, (own, other) in enumerate(zip(map(drawing_svg.svg, drawings), made, strict=True))
             if not alike(own, other)]  # fmt: skip
    assert not wrong


@pytest.mark.parametrize("change", ["120.5", "Q"])
def test_the_comparison_sees_a_difference(change: str) -> None:
    own = drawing_svg.svg(Drawing().link(0j, 1 + 0j, "P").hinge(0j))
    assert alike(own, own)
    assert not alike(own, own.replace("P", change)) and not alike(own, own.replace('r="4.5"', 'r="4.7"'))


def alike(own: str, other: str) -> bool:
    """Whether two pictures have the same elements and names, to a digit of their coordinates."""
    texts, numbers = zip(*((NUMBER.sub("#", plain), NUMBER.findall(plain)) for plain in map(as_text, (own, other))),
                         strict=True)  # fmt: skip
    return bool(texts[0] == texts[1]) and all(abs(float(a) - float(b)) < 0.11 for a, b in zip(*numbers, strict=True))


def as_text(svg: str) -> str:
    return svg.replace("&#x27;", "'").replace("&quot;", '"')


def drawn(random: Random) -> Drawing:
    """Some elements of all kinds, some without a place, in a frame or in none."""
    size: dict[str, Any] = {"width": random.choice([345, 640, 900]), "height": random.choice([300, 480])}
    frame = points(random, 4) if random.random() < 0.6 else None
    scales = {"N": random.uniform(1e-4, 1e-3)} if random.random() < 0.5 else {}
    drawing = Drawing(**size, frame=frame, scales=scales, unit=random.choice(["m", "m", "N", ""]))
    for _ in range(random.randint(0, 12)):
        drawing = one_more(drawing, random)
        if random.random() < 0.1:
            drawing = drawing.faint() + drawing
    return drawing


def points(random: Random, count: int) -> list[complex]:
    def point() -> complex:
        return complex(random.uniform(-2, 2), random.uniform(-1, 3)) if random.random() > 0.03 else complex("nan")

    return [point() for _ in range(count)]


def one_more(d: Drawing, random: Random) -> Drawing:
    """The drawing with an element of some kind."""
    p, q, *more = points(random, 9)
    name, colour, angle = random.choice(NAMES), random.choice(["", *COLOURS]), random.uniform(-3, 3)
    force, size = 10 ** random.uniform(1, 4) * q, random.uniform(0.1, 1)
    steps: list[Callable[[], Drawing]] = [
        lambda: d.link(p, q, name),
        lambda: d.plate(more[: random.randint(3, 5)], name),
        lambda: d.cylinder(p, q, name, random.choice([None, 0.7])),
        lambda: d.slot(p, q, name),
        lambda: d.slider(p, angle, name),
        lambda: d.hinge(p, name),
        lambda: d.support(p, name, angle),
        lambda: d.mass(p, name),
        lambda: d.text(p, f"{90 * size:.4g}° by (5)"),
        lambda: d.ground(p, q),
        lambda: d.guide(p, q),
        lambda: d.wheel(p, size, name),
        lambda: d.polygon(more[:4], name, colour),
        lambda: d.path([x for x in more if x == x or not name], name, colour),
        lambda: d.force(p, force, name, random.random() < 0.5),
        lambda: d.arrow(p, force / 1e4, name, "m/s", colour),
        lambda: d.moment(p, random.choice([-3.0, 0.0, 12.5]), name),
        lambda: d.dimension(p, q, name, random.choice([30.0, -20.0])),
    ]
    return random.choice(steps)()
