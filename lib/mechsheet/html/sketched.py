"""A recorded drawing as the page must know it: its elements by the keys of their numbers."""

from collections.abc import Callable, Iterable, Iterator
from math import isfinite
from typing import Any

from mechsheet.document.labels import as_printed, plain
from mechsheet.html import wording
from mechsheet.quantities.node import Node
from mechsheet.quantities.quantity import Quantity
from mechsheet.quantities.sketch import Drawn
from mechsheet.quantities.written import Number, OneOf, Written
from mechsheet.worksheet.drawing import Drawing, Element

Spec = dict[str, Any]
Key = Callable[[Node], str]


def told(drawn: Drawn, key: Key) -> Spec:
    """Elements, frame and scales of a drawing as JSON; ``key`` names the quantities."""
    sketch = drawn.sketch
    frame: Any = [] if sketch.frame is None else sketch.frame
    return {
        **size(sketch),
        "frame": [*_points(frame if isinstance(frame, list | tuple) else [frame], key)],
        "scales": {unit: _number(x, key) for unit, x in sketch.scales.items()},
        "elements": [
            *(_element(e, key) | {"faint": True} for e in sketch.behind),
            *(_element(e, key) for e in sketch.elements),
        ],
    }


def size(drawing: Drawing) -> Spec:
    return {"width": drawing.width, "height": drawing.height, "unit": drawing.unit}


def _element(e: Any, key: Key) -> Spec:
    own: Spec = {"kind": e.kind, "points": [*_points(e.points, key)]}
    if isinstance(e.name, Written):
        own |= {"name": _name(e.name, e.kind, key), "raw": wording.written(e.name, key)}
    elif e.name:
        own |= {"name": list(plain(e.name)[0] if e.kind == "text" else as_printed(e.name)[0]), "raw": e.name}
    if e.vector is not None:
        vector = -e.vector if isinstance(e, Element) and e.into else e.vector  # as it was given
        own |= {"vector": next(_points([vector], key)), "into": _number(e.into, key)}
    value = _number(e.value, key)
    own |= {"value": value} if value else {}
    colour = wording.written(e.colour, key) if isinstance(e.colour, Written) else e.colour
    return own | {part: text for part, text in (("unit", e.unit), ("colour", colour)) if text}


def _name(name: Written, kind: str, key: Key) -> Any:
    """The parts of a printed name that has numbers in it: it begins with a symbol, a number or a text of an input."""
    begin: list[Any]
    if kind != "text" and (ways := name.ways()):
        then, otherwise = (_name(way, kind, key) for way in (ways.then, ways.otherwise))
        return {"if": key(ways.holds.re), "then": then, "else": otherwise}
    split = None if kind == "text" else name.head()
    if split is None:
        return [wording.written(name, key), "", "", ""]
    first, rest = split
    if isinstance(first, OneOf):
        begin = [[wording.piece(first, key)], "", "", ""]
    elif isinstance(first, Number):
        begin = ["", [wording.piece(first._replace(instead=(*first.instead, ("-", "−"))), key)], "", ""]
    else:
        begin = list(as_printed(first)[0])
    return [*begin[:3], wording.written(rest, key)]


def _points(points: Iterable[Any], key: Key) -> Iterator[list[Any]]:
    """Real and imaginary part of each point or field of points."""
    for point in points:
        if isinstance(point, Quantity):
            yield [_part(point.re, key), 0 if point.im is None else _part(point.im, key)]
        elif isinstance(point, complex | float | int):
            yield [_finite(complex(point).real), _finite(complex(point).imag)]
        else:
            yield from _points(point, key)


def _number(x: Any, key: Key) -> Any:
    return _part(x.re, key) if isinstance(x, Quantity) else x if isinstance(x, bool) else _finite(float(x))


def _part(node: Node, key: Key) -> Any:
    return _finite(node.value.item()) if node.op == "constant" and not node.shape else key(node)


def _finite(x: float) -> Any:
    return (int(x) if float(x).is_integer() and abs(x) < 1e9 else x) if isfinite(x) else None
