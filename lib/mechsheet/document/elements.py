"""How each element of a drawing looks: its lines, areas and circles, and where its name may stand.

Each function draws one kind: the picture, the element, and its points in px.
"""

from cmath import rect
from collections.abc import Callable, Mapping
from itertools import pairwise
from math import pi

from mechsheet.document.labels import beside, inside, length, past, plain, unit
from mechsheet.document.picture import ARROW, BODY, EDGE, THIN, Picture
from mechsheet.document.shortened import apart
from mechsheet.worksheet.drawing import Element

# Sizes [px].
_MASS, _BARREL = 7.0, 7.0  # radii of a centre of mass, of a cylinder
_MOMENT = 26.0  # radius of the arc of a moment
_BLOCK = 14 + 8j  # half length and half height of a slider


def _link(picture: Picture, e: Element, a: complex, b: complex) -> None:
    picture.bar(a, b)
    picture.label(e.name, beside, a, b)


def _plate(picture: Picture, e: Element, *p: complex) -> None:
    picture.area(*p, opacity=0.1)
    for a, b in pairwise((*p, p[0])):
        picture.bar(a, b)
    picture.label(e.name, inside, *p)


def _cylinder(picture: Picture, e: Element, a: complex, b: complex, c: complex) -> None:
    u, size, end = unit(b - a), length(b - a), length(c - a)
    start = min(12.0, end / 3)
    piston, side = a + (start + size - end) * u, 1j * _BARREL * u
    picture.bar(a, a + start * u)
    picture.bar(piston, b)
    picture.line(piston + side, piston - side, width=BODY)
    near, far = a + start * u, a + end * u
    picture.line(near + side, far + side, far - side, near - side, closed=True)
    picture.label(e.name, beside, a, b, _BARREL)


def _slot(picture: Picture, e: Element, a: complex, b: complex) -> None:
    u, r = unit(b - a), _BLOCK.imag + 2.5
    arc = [r * u * rect(1, pi * i / 12) for i in range(-6, 7)]
    picture.line(*(b + q for q in arc), *(a - q for q in arc), width=BODY, closed=True)
    picture.label(e.name, beside, a, b, r)


def _slider(picture: Picture, e: Element, p: complex) -> None:
    u = rect(1, -e.value)
    a, b = _BLOCK.real * u, 1j * _BLOCK.imag * u
    corners = (p - a - b, p + a - b, p + a + b, p - a + b)
    picture.area(*corners, opacity=0.1)
    picture.line(*corners, closed=True)
    picture.label_round(e.name, p, length(_BLOCK))


def _hinge(picture: Picture, e: Element, p: complex) -> None:
    picture.pin(p, e.name)


def _support(picture: Picture, e: Element, p: complex) -> None:
    u = rect(1, -e.value)
    base, side = p + 17 * u, 1j * u
    picture.bar(p, base - 10 * side, EDGE)
    picture.bar(p, base + 10 * side, EDGE)
    picture.hatch(base + 15 * side, base - 15 * side)
    picture.pin(p, e.name)


def _mass(picture: Picture, e: Element, p: complex) -> None:
    for quarter in (0, 12):
        picture.area(p, *(p + _MASS * rect(1, pi * (quarter + i) / 12) for i in range(7)))
    picture.pin(p, e.name, _MASS)


def _text(picture: Picture, e: Element, p: complex) -> None:
    name, half = plain(e.name)
    picture.write(name, p, half)


def _ground(picture: Picture, _: Element, a: complex, b: complex) -> None:
    picture.hatch(a, b)


def _guide(picture: Picture, _: Element, a: complex, b: complex) -> None:
    aside = 1j * _BLOCK.imag * unit(b - a)
    picture.hatch(a + aside, b + aside)


def _wheel(picture: Picture, e: Element, p: complex, q: complex, *_: complex) -> None:
    picture.circle(p, length(q - p), BODY)
    picture.circle(p, 0.55 * length(q - p), THIN)
    picture.circle(p, 2.0)
    picture.label_round(e.name, p, 2.0)


def _polygon(picture: Picture, e: Element, *p: complex) -> None:
    picture.area(*p, opacity=0.15 if e.colour else 0.05, colour=e.colour)
    picture.line(*p, colour=e.colour, closed=True)
    picture.label(e.name, inside, *p)


def _path(picture: Picture, e: Element, *p: complex) -> None:
    picture.line(*apart(p), colour=e.colour)
    picture.label_end(e.name, *p[-2:])


def _arrow(picture: Picture, e: Element, p: complex, q: complex) -> None:
    if p != q:
        picture.arrow(*((q, p) if e.into else (p, q)), e.colour)
        picture.label(e.name, past, p, q)


def _moment(picture: Picture, e: Element, p: complex) -> None:
    sense = int(e.value > 0) - int(e.value < 0)
    if not sense:
        return
    arc = [p + _MOMENT * rect(1, -sense * (0.1 + 1.4 * i / 24) * pi) for i in range(25)]
    u = -1j * sense * unit(arc[-1] - p)
    picture.line(*arc, width=ARROW, colour=e.colour)
    picture.area(arc[-1] + 9 * u, arc[-1] + 4j * u, arc[-1] - 4j * u, colour=e.colour)
    picture.label_round(e.name, p, _MOMENT)


def _dimension(picture: Picture, e: Element, a: complex, b: complex) -> None:
    u = unit(b - a)
    n = -1j * u if e.value > 0 else 1j * u
    p, q = a + abs(e.value) * n, b + abs(e.value) * n
    picture.line(a + 3 * n, p + 5 * n, width=THIN)
    picture.line(b + 3 * n, q + 5 * n, width=THIN)
    picture.line(p, q, width=THIN)
    picture.area(p, p + (9 + 2.5j) * u, p + (9 - 2.5j) * u)
    picture.area(q, q - (9 + 2.5j) * u, q - (9 - 2.5j) * u)
    picture.label(e.name, beside, p, q)


LOOKS: Mapping[str, Callable[..., None]] = {
    "link": _link, "plate": _plate, "cylinder": _cylinder, "slot": _slot, "slider": _slider, "hinge": _hinge,
    "support": _support, "mass": _mass, "text": _text, "ground": _ground, "guide": _guide, "wheel": _wheel,
    "polygon": _polygon, "path": _path, "arrow": _arrow, "moment": _moment, "dimension": _dimension,
}  # fmt: skip
