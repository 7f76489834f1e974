"""scipy's integral of a function between two ends, by Gauss and Kronrod's rule at places that cells have as well."""

import inspect
from collections.abc import Callable, Sequence
from contextlib import suppress
from functools import cache
from itertools import pairwise, product
from typing import Any, NamedTuple

import numpy as np

from mechsheet.quantities.arithmetic import choice, only_where
from mechsheet.quantities.graph import Graph, Label, NotRecorded, current
from mechsheet.quantities.node import Node, bottom_up
from mechsheet.quantities.quantity import Quantity, lift
from mechsheet.readers import derived
from mechsheet.readers.replaced import replaced
from mechsheet.recording import solving

# Kronrod's places in the half of a part from its middle on, with their weights; Gauss's are every second one of them.
_PLACES = (
    0.0, 0.14887433898163122, 0.2943928627014602, 0.4333953941292472, 0.5627571346686047, 0.6794095682990244,
    0.7808177265864169, 0.8650633666889845, 0.9301574913557082, 0.9739065285171717, 0.9956571630258081,
)  # fmt: skip
_WEIGHTS = (
    0.14944555400291692, 0.1477391049013385, 0.14277593857706009, 0.13470921731147334, 0.12349197626206585,
    0.10938715880229764, 0.09312545458369761, 0.07503967481091996, 0.054755896574351995, 0.032558162307964725,
    0.011694638867371874,
)  # fmt: skip
_OF_GAUSS = 0.29552422471475287, 0.26926671930999635, 0.21908636251598204, 0.1494513491505806, 0.06667134430868814
_AT = np.array([*(-x for x in _PLACES[:0:-1]), *_PLACES]) / 2 + 0.5  # in parts of a part
_PART = np.array([*_WEIGHTS[:0:-1], *_WEIGHTS]) / 2
_OFF = _PART.copy()  # what is between the two rules
_OFF[1::2] -= np.array([*_OF_GAUSS[::-1], *_OF_GAUSS]) / 2
_HALVED = 5  # times at most are parts between two corners
_CLOSE = 1e-10  # of the integral of the magnitude: Kronrod's rule is off by far less than the two differ
_CORNERS = 24

Note = Callable[[Node, Node | None], None]


def integral(f: Callable[..., Any], note: Note, *args: Any, **named: Any) -> Any:
    """What scipy's quad ``f`` gives for a function: its integral, and scipy's own estimate of the error.

    They are given to ``note``, the estimate once it is taken.

    With the inputs at hand parts twice as long would do; with others it is no number where two rules differ. Parts end
    at corners, such as where the function compares its variable with a number.
    """
    options = inspect.signature(f).bind(*args, **named).arguments
    g, a, b, more, points = (options.pop(name, None) for name in ("func", "a", "b", "args", "points"))
    graph, more = current.get(), more if isinstance(more, tuple) else () if more is None else (more,)
    if told := options.keys() - {"epsabs", "epsrel", "limit"}:
        raise NotRecorded(f"scipy's quad with {', '.join(sorted(told))}")
    ends = lift(graph, a), lift(graph, b)
    if not all(np.isfinite(end.value).all() for end in ends):
        raise NotRecorded("scipy's quad to infinity")
    if not all(end.single and end.im is None for end in ends):
        raise NotRecorded("scipy's quad between several ends")
    first, last = (end.reshape(()) for end in ends)
    variable = graph.state((first / 2 + last / 2).re)
    value = _of(graph, variable, lambda x: g(x, *more))
    edges = _edges(graph, variable, value, first, last, [] if points is None else [*lift(graph, points)])
    made = _Sums(graph, variable, value, edges)
    ways = product((False, True), (2**n for n in range(_HALVED)))
    known = (way for way in ways if all(made.sum(way[0], count)[1].value for count in (way[1], 2 * way[1])))
    if (way := next(known, None)) is None:
        raise NotRecorded(f"scipy's quad of what rules at {len(_AT) * 2**_HALVED} places differ about")
    whole, close = made.sum(way[0], 2 * way[1], labelled=True)
    result = only_where(graph, close, whole)
    note(result.re, None)

    def error() -> Quantity:
        with solving.tried(graph) as of:
            plainly = of(lambda x: g(x, *more))
            _, near, *_ = f(plainly, *map(solving.now, (first, last, ())), 1, points=solving.now(points), **options)
        under = [node for node in bottom_up(result.parts, ()) if node.op == "input"]
        own = Quantity(graph, graph.exported(under, near))
        note(result.re, own.re)
        return own

    return _Estimated(result, error)


class _Estimated(Sequence[Any]):
    """An integral and the estimate of its error, which is looked for once somebody takes it."""

    def __init__(self, whole: Any, error: Callable[[], Any]) -> None:
        self._whole, self._error = whole, cache(error)

    def __len__(self) -> int:
        return 2

    def __getitem__(self, key: Any) -> Any:
        return self._whole if key == 0 else (self._whole, self._error())[key]


def _of(graph: Graph, variable: Node, g: Callable[[Quantity], Any]) -> Node:
    """What a function makes of its variable."""
    looked = dict(graph.looked)
    value = lift(graph, g(Quantity(graph, variable)))
    seen = [holds for holds in graph.looked if holds not in looked]
    if variable in bottom_up(seen, ()):
        raise NotRecorded("in what scipy's quad takes the integral of Python looks at its variable")
    if value.im is not None or value.extent not in ((), (1,)):
        raise NotRecorded("scipy's quad of what is not one real number")
    return value.reshape(()).re


def _edges(
    graph: Graph, variable: Node, value: Node, first: Quantity, last: Quantity, points: Sequence[Quantity]
) -> list[Quantity]:
    """The ends, and between them where the function has a corner."""
    x, between = Quantity(graph, variable), [*points]
    with suppress(NotRecorded):  # of what has no known slope no corner is known either
        _, corners = derived.at({variable: x}, [value])
        for off, slopes in corners.values():
            if slopes and variable not in bottom_up([slopes[0].re], ()):
                place = (x - off / slopes[0]).reshape(-1)
                at = Quantity(graph, replaced(graph, [place.re], {variable: first.re}).get(place.re, place.re))
                between += [one for one in at if np.isfinite(one.value)]
    known = {end.re: end for end in (first, last)}
    between = [one for key, one in {one.re: one for one in between}.items() if key not in known]
    if not between:
        return [first, last]
    if len(between) > _CORNERS:
        raise NotRecorded(f"scipy's quad of a function with more than {_CORNERS} corners")
    low, high = np.minimum(first, last), np.maximum(first, last)
    inside: Any = np.sort(lift(graph, [np.clip(one, low, high) for one in between]))
    there = [*inside]
    return [first, *(choice(graph, first <= last, up, down) for up, down in zip(there, there[::-1], strict=True)), last]


class _Sums(NamedTuple):
    """What the integral is computed from."""

    graph: Graph
    variable: Node
    value: Node
    edges: Sequence[Quantity]

    def sum(self, eased: bool, count: int, labelled: bool = False) -> tuple[Any, Any]:
        """The integral in so many parts between each two edges, and whether two rules agree about it.

        Where it is ``eased``, places are dense at the edges, for a root or the like that begins there.
        """
        t = (np.repeat(np.arange(count), len(_AT)) + np.tile(_AT, count)) / count
        share, off = np.tile(_PART, count) / count, np.tile(_OFF, count) / count
        if eased:
            rate = 30 * (t * (1 - t)) ** 2
            t, share, off = t**3 * (10 - 15 * t + 6 * t**2), rate * share, rate * off
        low, high, shares, offs = (Quantity(self.graph, self.graph.constant(x, "-")) for x in (1 - t, t, share, off))
        places, sums, sizes, left = [a * low + b * high for a, b in pairwise(self.edges)], [], [], []
        x: Any = places[0] if len(places) == 1 else np.concatenate(places)
        y = self.at(x)
        for n, (a, b) in enumerate(pairwise(self.edges)):
            own, length = y[n * len(t) : (n + 1) * len(t)], b - a
            sums.append((own * shares).reduced("sum") * length)
            sizes.append((abs(own) * shares).reduced("sum") * abs(length))
            left.append(abs((own * offs).reshape(count, -1).reduced("sum", 1)).reduced("sum") * abs(length))
        if labelled:
            graph = self.graph
            number = sum(label.symbol.startswith("place_") for label in graph.labels.values()) + 1
            graph.labels[x.re] = Label(f"place_{number}", "", "places between the ends of the integral")
            graph.labels[y.re] = Label(f"value_{number}", "", "what is integrated there")
        return sum(sums[1:], sums[0]), sum(left[1:], left[0]) <= _CLOSE * sum(sizes[1:], sizes[0])

    def at(self, x: Quantity) -> Quantity:
        """What is integrated, at several places."""
        new = replaced(self.graph, [self.value], {self.variable: x.re}, x.extent[0])
        return Quantity(self.graph, new.get(self.value, self.value)).like(x)
