"""Elements of a list, or rows of a table, for which a condition holds, such as ``x[x > a]``, however many these are."""

from collections.abc import Callable
from math import inf, nan
from typing import Any

import numpy as np

from mechsheet.quantities.arithmetic import choice, only_where, row_numbers
from mechsheet.quantities.graph import Graph
from mechsheet.quantities.node import Node
from mechsheet.quantities.quantity import FUNCTIONS, Quantity, lift
from mechsheet.quantities.refused import refused

_OF_NONE: dict[str, float] = {
    "sum": 0, "nansum": 0, "max": -inf, "min": inf, "nanmax": nan, "nanmin": nan, "any": False, "all": True,
}  # fmt: skip
_NUMBERS = int | float | complex | np.number
_ELEMENTWISE: dict[Any, tuple[int, int]] = {  # which arguments are elements
    np.where: (0, 3), np.clip: (0, 3), np.real: (0, 1), np.imag: (0, 1), np.angle: (0, 1), np.nan_to_num: (0, 1),
    np.zeros_like: (0, 1), np.ones_like: (0, 1), np.full_like: (0, 2), np.interp: (0, 1), np.polyval: (1, 2),
    np.round: (0, 1), np.around: (0, 1),
}  # fmt: skip


class Selected(Quantity):
    """Those elements ``of`` a list, or rows of a table, for which a condition ``holds``.

    What they are as a whole, such as the greatest, and one of them by its number is followed. Anything else is so too
    where readers take any number of rows; else it is of those for which it holds now, and no number for others.
    """

    __slots__ = ("holds", "of")

    def __init__(self, of: Quantity, holds: Quantity) -> None:
        self.graph, self.of, self.holds, self.base = of.graph, of, holds, None

    def __getattr__(self, name: str) -> Any:
        if name not in ("re", "im"):
            return super().__getattr__(name)
        if self.draws:
            self.graph.filtered = True
            places = Quantity(self.graph, self.graph.rows(self.count(0).re))
            return getattr(self.of[np.searchsorted(self._numbered(), places + 1)], name)
        held = self.of.rearranged(np.ndarray.__getitem__, self.holds.seen())
        return getattr(only_where(self.graph, Quantity(self.graph, self.same), held), name)

    @property
    def draws(self) -> bool:
        """Whether it is of as many elements as it holds for, whatever these are."""
        return self.graph.draws and len(self.of.extent) == 1

    @property
    def same(self) -> Node:
        """Whether the condition holds for those for which it holds now."""
        return self.graph.same(self.holds.re)

    @property
    def nodes(self) -> list[Node]:
        return [*self.of.parts, *self.holds.parts]

    @property
    def value(self) -> Any:
        return self.of.value[self.holds.value]

    @property
    def extent(self) -> tuple[int, ...]:
        return (int(np.count_nonzero(self.holds.value)), *self.of.extent[1:])

    @property
    def single(self) -> bool:
        return False

    def __copy__(self) -> Quantity:
        return Selected(self.of, self.holds)

    def are_places(self) -> bool:
        """Whether these are the places of what the condition holds for, as `places` gives them."""
        places = self.of.re
        if self.of.ndim != 1 or places.op not in ("rows", "constant"):
            return False
        return places.op == "rows" or np.array_equal(places.value, np.arange(len(places.value)))

    def count(self, axis: Any = None) -> Any:
        if axis != 0 and self.ndim > 1:
            return super().count(axis)
        return choice(self.graph, self.holds, 1, 0).reduced("sum")

    def __getitem__(self, key: Any) -> Quantity:
        if isinstance(key, tuple) and isinstance(key[0], int | np.integer):
            return self[key[0]][key[1:]]
        if isinstance(key, tuple) and key[0] == slice(None):
            return Selected(self.of[key], self.holds)
        pointed = isinstance(key, Quantity) and key.single and key.im is None and key.dtype != bool
        if not pointed and (not isinstance(key, int | np.integer) or isinstance(key, bool)):
            return super().__getitem__(key)
        number: Any = self._numbered()
        from_end = number[-1] + key + 1
        wanted = choice(self.graph, key >= 0, key + 1, from_end) if pointed else key + 1 if key >= 0 else from_end
        hit = self.holds & (number == wanted)
        if not (exists := hit.reduced("any")).value and not self.graph.supposed:
            raise IndexError(f"no element {key} of {self.extent[0]}")
        one: Quantity = refused(only_where(self.graph, exists, self.of[np.argmax(hit)]))
        return one

    def _numbered(self) -> Any:
        """How many it holds for up to each one."""
        return choice(self.graph, self.holds, 1, 0).cumsum()

    @property
    def compares(self) -> bool:
        """Whether a place among them is followed, as no cell does: it is that of a number, so that there is one."""
        return (
            self.graph.draws
            and self.ndim == 1
            and self.of.im is None
            and bool(np.isfinite(self.value).all() and self.value.size)
        )

    def compared(self, kind: str) -> Quantity:
        """All elements, those for which it does not hold as the one that ``argmax`` or ``argmin`` takes."""
        every: Quantity = choice(self.graph, self.holds, self.of, self.of[self._taken(kind.removeprefix("arg"))])
        return every

    def _taken(self, end: str) -> Any:
        """Which of all elements is the first one that is the greatest or the least of those for which it holds."""
        return np.argmax(self.holds & (self.of == self.filled(end).reduced(end)))

    def filled(self, kind: str) -> Quantity:
        """All elements, those for which it does not hold as ones that change nothing."""
        if self.ndim > 1 or kind not in _OF_NONE or (self.of.im is not None and kind != "sum"):
            return Quantity(self.graph, self.re, self.im)
        every: Quantity = choice(self.graph, self.holds, self.of, _OF_NONE[kind])
        return every

    def reduced(self, kind: str, axis: Any = None, keepdims: bool = False) -> Quantity:
        if kind in ("argmax", "argmin") and self.compares:
            taken = self._taken(end := kind.removeprefix("arg"))
            best = self.filled(end).reduced(end)
            place: Quantity = choice(
                self.graph, self.holds.reduced("any") & (best == best), self._numbered()[taken] - 1, nan
            )
            return place
        result = self.filled(kind).reduced(kind, axis, keepdims)
        if kind not in ("max", "min"):
            return result
        some = self.holds.reduced("any")
        if not some.value and not self.graph.supposed:
            raise ValueError(f"no element to take the {kind} of")
        known: Quantity = refused(only_where(self.graph, some, result))
        return known

    def __array_ufunc__(self, ufunc: Any, method: str, *inputs: Any, **kwargs: Any) -> Any:
        each = None if method != "__call__" or kwargs or ufunc.signature or ufunc.nout > 1 else of_each(ufunc, *inputs)
        return super().__array_ufunc__(ufunc, method, *inputs, **kwargs) if each is None else each

    def is_beside(self, x: Any) -> bool:
        """Whether one number, or of the same elements."""
        if isinstance(x, Selected):
            return x.holds.re is self.holds.re and x.ndim == self.ndim
        return isinstance(x, _NUMBERS) or (isinstance(x, Quantity) and x.single)


def of_each(function: Callable[..., Any], *given: Any) -> Selected | None:
    """What a function of single elements makes of those of a list; None where not all are of the same elements."""
    some = next((x for x in given if isinstance(x, Selected)), None)
    if some is None or not all(map(some.is_beside, given)):
        return None
    return Selected(lift(some.graph, function(*(x.of if isinstance(x, Selected) else x for x in given))), some.holds)


def also_of_selected(rules: dict[Any, Callable[..., Any]]) -> dict[Any, Callable[..., Any]]:
    """The rules of functions of single elements, which give of the elements of a list those of the same."""
    return {f: _also_of_selected(rules[f], *which) for f, which in _ELEMENTWISE.items()}


def _also_of_selected(rule: Callable[..., Any], first: int, last: int) -> Callable[..., Any]:
    def operation(graph: Graph, *args: Any, **kwargs: Any) -> Any:
        each = None
        if len(args) >= last and not kwargs:
            each = of_each(lambda *xs: rule(graph, *args[:first], *xs, *args[last:]), *args[first:last])
        return rule(graph, *args, **kwargs) if each is None else each

    return operation


def selected(graph: Graph, x: Quantity, key: Any) -> Quantity | None:
    """``x[key]`` where the key is a condition, or places of what one holds for; None of anything else."""
    if isinstance(key, tuple):
        some = selected(graph, x, key[0]) if key and isinstance(key[0], Quantity) else None
        return None if some is None else some[(slice(None), *key[1:])]
    if graph.thin > 1 or not isinstance(key, Quantity) or not x.ndim or key.ndim != 1:
        return None
    if isinstance(x, Selected):
        further = isinstance(key, Selected) and key.of.dtype == bool and key.holds.re is x.holds.re
        return Selected(x.of, x.holds & key.of) if isinstance(key, Selected) and further else None
    if isinstance(key, Selected):
        return None if key.of.dtype == bool or key.of.im is not None else Selected(x[key.of], key.holds)
    if key.dtype != bool or key.re in graph.fixed or key.extent != x.extent[:1]:
        return None
    return Selected(x, key) if graph.size(key.re) == graph.size(x.whole().re)[:1] else None


def places(graph: Graph, x: Any) -> Any:
    """numpy's flatnonzero."""
    x = lift(graph, x)
    if graph.thin > 1 or x.ndim != 1 or isinstance(x, Selected) or x.re in graph.fixed:
        return np.flatnonzero(x.seen())
    return Selected(row_numbers(graph, x.count(0)), x if x.dtype == bool else x != 0)


def _all_places(graph: Graph, x: Any) -> Any:
    """numpy's nonzero."""
    x = lift(graph, x)
    return (places(graph, x),) if x.ndim == 1 else np.nonzero(x.seen())


FUNCTIONS.update({
    np.ndarray.__getitem__: selected, np.flatnonzero: places, np.nonzero: _all_places,
    np.compress: lambda graph, holds, x: lift(graph, x)[lift(graph, holds)],
    np.extract: lambda graph, holds, x: lift(graph, x)[lift(graph, holds)],
})  # fmt: skip
