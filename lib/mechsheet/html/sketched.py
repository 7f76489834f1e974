"""A recorded drawing as the page must know it: its elements by the keys of their numbers."""

from collections.abc import Callable, Iterable, Iterator
from math import isfinite
from typing import Any

from mechsheet.document.labels import as_printed, plain
from mechsheet.recording.node import Node
from mechsheet.recording.quantity import Quantity
from mechsheet.recording.sketch import Drawn
from mechsheet.worksheet.drawing import Drawing, Element

Spec = dict[str, Any]
Key = Callable[[Node], str]


def told(drawn: Drawn, key: Key) -> Spec:
    """Elements, frame, scales and guards of a drawing as JSON; ``key`` names the quantities."""
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
        "guards": [[key(guard.holds), guard.line] for guard in drawn.guards],
    }


def size(drawing: Drawing) -> Spec:
    return {"width": drawing.width, "height": drawing.height, "unit": drawing.unit}


def _element(e: Any, key: Key) -> Spec:
    name, _ = plain(e.name) if e.kind == "text" else as_printed(e.name)
    own: Spec = {"kind": e.kind, "points": [*_points(e.points, key)]}
    own |= {"name": list(name), "raw": e.name} if e.name else {}
    if e.vector is not None:
        vector = -e.vector if isinstance(e, Element) and e.into else e.vector  # as it was given
        own |= {"vector": next(_points([vector], key)), "into": _number(e.into, key)}
    value = _number(e.value, key)
    own |= {"value": value} if value else {}
    return own | {part: text for part in ("unit", "colour") if (text := getattr(e, part))}


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
