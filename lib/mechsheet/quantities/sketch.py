"""A drawing while it is recorded: its elements are made of quantities, which are looked at where it is drawn."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, fields, replace
from typing import Any, NamedTuple

import numpy as np

from mechsheet.quantities.arithmetic import only_where
from mechsheet.quantities.graph import Guard, NotRecorded, current
from mechsheet.quantities.quantity import Quantity, lift
from mechsheet.quantities.refused import needed
from mechsheet.quantities.written import Written, seen
from mechsheet.worksheet.drawing import Drawing

_SEEN = ("width", "height", "unit")  # of a drawing, which are what they are now


class Outline(NamedTuple):
    """One element: its kind, single points or arrays of them [m], a name, and what else `Element` has.

    Where ``into`` holds its vector ends in the point.
    """

    kind: str
    points: tuple[Quantity, ...]
    name: str | Written = ""
    value: Quantity | float = 0.0
    vector: Quantity | None = None
    unit: str = ""
    into: Quantity | bool = False
    colour: str | Written = ""

    def where(self, condition: Quantity) -> "Outline":
        """The element while a condition holds; else its points are no numbers, and it is not drawn."""
        graph = condition.graph
        return self._replace(points=tuple(only_where(graph, condition, p) for p in self.points))


@dataclass(frozen=True, eq=False)
class Sketch(Drawing):
    """A drawing of recorded quantities; where points are, and whether they are drawn, is judged there."""

    elements: tuple[Any, ...] = ()
    behind: tuple[Any, ...] = ()

    def __post_init__(self) -> None:
        """No number is looked at."""

    @classmethod
    def of(cls, drawing: Drawing) -> "Sketch":
        """A drawing to which recorded quantities are added."""
        return cls(**{part.name: getattr(drawing, part.name) for part in fields(Drawing)})

    def cylinder(self, A: Any, B: Any, name: str = "", barrel: Any = None) -> "Drawing":
        if barrel is not None:
            _positive("barrel of a cylinder", barrel)
        along = B - A
        size = np.where(abs(along) > 0, abs(along), 1.0)  # one of no length has a barrel of none
        return self._with("cylinder", (A, B, A + (0.6 * along if barrel is None else barrel * along / size)), name)

    def wheel(self, centre: Any, r: Any, name: str = "") -> "Drawing":
        _positive("radius of a wheel", r, infinite=True)
        return self._with("wheel", [centre, *(centre + r * i for i in (1, 1j, -1, -1j))], name)

    def path(self, points: Any, name: str = "", colour: str = "blue") -> "Drawing":
        return self._with("path", points, name, colour=colour)

    def arrow(self, P: Any, V: Any, name: str, unit: str, colour: str = "green", into: Any = False) -> "Drawing":
        return self._with("arrow", (P,), name, vector=V, unit=unit, into=into, colour=colour)

    def svg(self) -> str:
        raise NotRecorded("a drawing as a text")

    def _with(self, kind: str, points: Any, name: str = "", *_: Any, **others: Any) -> "Drawing":
        for looked in ("measure", "least", "tip"):
            others.pop(looked, None)
        if "unit" in others:
            others["unit"] = seen(others["unit"])
        graph = current.get()
        if isinstance(name, Written) and kind != "text" and not name.is_name():
            name = str(name)
        single = isinstance(points, list | tuple)
        each = tuple(lift(graph, p) for p in (points if single else (points,)))
        lifted = {key: lift(graph, x) for key, x in others.items() if key in ("value", "vector") and x is not None}
        return replace(self, elements=(*self.elements, Outline(kind, each, name, **others | lifted)))


class Drawn(NamedTuple):
    """A recorded drawing that a cell shows, and the guards under which it is the worksheet's own."""

    sketch: Sketch
    guards: Sequence[Guard]


def drawing(*args: Any, **kwargs: Any) -> Drawing:
    """A new drawing, of recorded quantities where drawings are recorded, or nobody looks at them."""
    args, kwargs = tuple(map(seen, args[:2])) + args[2:], {k: seen(x) if k in _SEEN else x for k, x in kwargs.items()}
    if not current.get().refuses:
        return Drawing(*args, **kwargs)
    made = Sketch(*args, **kwargs)
    for scale in made.scales.values():
        _positive("scale of arrows", scale)
    return made


def _positive(what: str, number: Any, infinite: bool = False) -> None:
    """Note what a drawing refuses: a number that is not above 0, or infinite where that is none either."""
    x = lift(current.get(), number)
    refused = x <= 0 if infinite else (x <= 0) | (x == np.inf)
    needed(~refused, f"a drawing has an error for a {what} that is not positive")


def merged(condition: Quantity, x: Sketch, y: Sketch) -> Sketch | None:
    """``x`` where the condition holds, else ``y``, which differ by elements at the end; None where by more."""
    if any(getattr(x, part) is not getattr(y, part) for part in ("frame", "behind")):
        return None
    if (x.width, x.height, x.unit) != (y.width, y.height, y.unit) or x.scales is not y.scales:
        return None
    same = sum(1 for _ in _common(x.elements, y.elements))
    holds = [e.where(condition) for e in x.elements[same:]]
    otherwise = [e.where(~condition) for e in y.elements[same:]]
    return replace(x, elements=(*x.elements[:same], *holds, *otherwise))


def _common(a: Sequence[Any], b: Sequence[Any]) -> Iterator[Any]:
    for x, y in zip(a, b, strict=False):
        if x is not y:
            return
        yield x
