"""What worksheets take of scipy beside functions that numpy has too: a root in an interval, tables between values."""

import inspect
from collections.abc import Callable
from functools import cache, partial
from itertools import product
from types import SimpleNamespace
from typing import Any

import numpy as np

from mechsheet.quantities.graph import Graph, NotRecorded, current
from mechsheet.quantities.quantity import Quantity, has_quantity, lift
from mechsheet.quantities.refused import needed, refused
from mechsheet.readers.between import SHARP
from mechsheet.recording import solving, spline_rules
from mechsheet.recording.guessed import GUESSED, guessed
from mechsheet.recording.integral import Note, integral

_ROOTS = frozenset({"brentq", "brenth", "bisect", "ridder", "toms748"})
_TABLES = frozenset({"interp1d", "RegularGridInterpolator"})


def solved(
    f: Callable[..., Any], note: Callable[[solving.Solving], Any], note_integral: Note
) -> Callable[..., Any] | None:
    """What takes the place of a function of scipy that solves or integrates another one; None for any other.

    What is found is given to one that notes it.
    """
    if f.__name__ == "quad":
        return partial(integral, f, note_integral)
    return partial(guessed, f, note, _between(note)) if f.__name__ in GUESSED else root(f, note)


def _between(note: Callable[[solving.Solving], Any]) -> Callable[..., Any]:
    def function(*args: Any, **named: Any) -> Any:
        from scipy.optimize import brentq  # on use: the worksheet has it

        function = root(brentq, note)
        assert function
        return function(*args, **named)

    return function


@cache
def root(f: Callable[..., Any], note: Callable[[solving.Solving], Any]) -> Callable[..., Any] | None:
    """What takes the place of a function of scipy that finds a root between two ends; None for any other function.

    What is solved is given to ``note``.
    """
    if f.__name__ not in _ROOTS:
        return None

    def function(g: Callable[..., Any], a: Any, b: Any, args: Any = (), **options: Any) -> Any:
        graph, more = current.get(), args if isinstance(args, tuple) else (args,)
        if options.keys() - {"xtol", "rtol", "maxiter"}:
            raise NotRecorded(f"scipy's {f.__name__}")
        with solving.tried(graph) as of:
            value = f(of(lambda x: g(x, *more)), solving.now(a), solving.now(b), **SHARP)  # as it will be solved again
        number = sum(key[0] == "found" for key in graph.nodes)
        words = SimpleNamespace(unknown=f"root {number + 1}", quantity="f(x)", unit="-", unknown_unit="-")
        found: Any = SimpleNamespace(words=words, _value=value)
        given = {"lo": a, "hi": b, "guess": None}
        solved = solving.one(graph, found, lambda x: g(x, *more), given, 0.0, None, None, f.__name__)
        note(solved)
        return solved.value

    return function


def is_table(value: Any) -> bool:
    """Whether a class of scipy that interpolates in a table, or an object of one."""
    of = value if isinstance(value, type) else type(value)
    return of.__name__ in _TABLES and of.__module__.startswith("scipy.interpolate.")


def table(value: Any) -> Callable[..., Any]:
    """What takes the place of such a class, or of an object that the setup has made."""
    if not isinstance(value, type):
        return _looked_up(value, _known(value))

    def made(*args: Any, **named: Any) -> Callable[..., Any]:
        given = inspect.signature(value).bind(*args, **named)
        given.apply_defaults()
        own = value(*map(solving.now, given.args), **{name: solving.now(x) for name, x in given.kwargs.items()})
        return _looked_up(own, given.arguments)

    return made


def _known(own: Any) -> dict[str, Any]:
    if type(own).__name__ == "interp1d":
        fill = "extrapolate" if own._extrapolate else own.fill_value
        return {"x": own.x, "y": own.y, "kind": own._kind, "bounds_error": own.bounds_error, "fill_value": fill}
    parts = "values", "method", "bounds_error", "fill_value"
    return {"points": own.grid} | {name: getattr(own, name) for name in parts}


def _looked_up(own: Any, given: dict[str, Any]) -> Callable[..., Any]:
    """A table as a function: linear between its places, and as it says beyond them."""
    kind = type(own).__name__
    single = kind == "interp1d"
    points, values = ((given["x"],), given["y"]) if single else (given["points"], given["values"])
    fill, bounded = given["fill_value"], given["bounds_error"]
    bounded = bounded if bounded is not None else single and isinstance(fill, float) and bool(np.isnan(fill))
    extrapolates = fill is None or isinstance(fill, str)
    below, above = (np.nan, np.nan) if bounded else fill if isinstance(fill, tuple) else (fill, fill)
    told = given.get("kind", given.get("method"))

    def function(*at: Any) -> Any:
        if not has_quantity([*at, *points, values]):
            return own(*at)
        graph = current.get()
        curved = single and told == "cubic"
        if not (curved or told == "linear") or np.ndim(solving.now(values)) != len(points):
            raise NotRecorded(f"scipy's {kind} but for a linear{' or cubic' * single} one")
        places = at[0] if len(at) == 1 and isinstance(at[0], tuple | list) and not single else at
        places = [lift(graph, place) for place in places]
        if not single and len(places) == 1 and len(points) > 1:
            places = [places[0][..., k] for k in range(len(points))]
        axes = [lift(graph, axis) for axis in points]
        if not single:
            for axis in axes:
                spline_rules.rising(axis)
        on = lift(graph, values)
        result = spline_rules.cubic(axes[0], on)(places[0]) if curved else _linear(graph, places, axes, on)
        if extrapolates:
            return result
        for x, axis in zip(places, axes, strict=True):
            under, over = x < axis[0], x > axis[-1]
            if bounded and x.ndim:  # of which some may be left out
                needed(~(under | over).reduced("any"), "scipy has an error for places beyond its table")
            result = np.where(under, below, np.where(over, above, result))
        return refused(result) if bounded else result

    return function


def _linear(graph: Graph, places: list[Quantity], axes: list[Quantity], values: Quantity) -> Any:
    """Between the corners of the cell of a grid in which each place lies, or that is nearest to it."""
    cells, parts = list[Any](), list[Any]()
    for x, axis in zip(places, axes, strict=True):
        cell = np.clip(np.searchsorted(axis, x, side="right") - 1, 0, axis.extent[0] - 2)
        low, high = axis[cell], axis[cell + 1]
        cells.append(cell)
        parts.append((x - low) / (high - low))
    flat, result = values.reshape(-1), None
    for corner in product((0, 1), repeat=len(axes)):
        number, weight = 0, 1.0
        for cell, part, step, axis in zip(cells, parts, corner, axes, strict=True):
            number, weight = number * axis.extent[0] + cell + step, weight * (part if step else 1 - part)
        term = weight * flat[number]
        result = term if result is None else result + term
    return result
