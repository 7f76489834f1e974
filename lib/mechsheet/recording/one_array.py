"""Names of a cell for one array, or for parts of it: what changes it under one of them changes it under all."""

from collections.abc import Iterable, Mapping, Set
from copy import copy
from functools import reduce
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mechsheet.quantities.graph import Graph
from mechsheet.quantities.operations import is_double
from mechsheet.quantities.quantity import Quantity, joined, lift, owner
from mechsheet.recording.memory import either_of

Places = NDArray[np.intp]


class _Part(NamedTuple):
    """A name, or "" for the array itself, with its elements as they were, and their places in the array."""

    name: str
    numbers: Quantity
    places: Places


class OneArray(NamedTuple):
    """What several names stand for, one of which a statement changes while it has no other name."""

    changed: _Part
    others: list[_Part]

    def put_together(self, names: dict[str, Any]) -> None:
        """Once the statement has run, give the other names what they are now, and all of them one array again."""
        graph, (name, _, places) = self.changed.numbers.graph, self.changed
        new = lift(graph, names[name])
        at = np.full(max(int(part.places.max(initial=-1)) for part in self.others) + 1, -1)
        at[places.reshape(-1)] = np.arange(places.size)
        now = {part.name: _replaced(part, new, at, places) for part in self.others}
        whole = now.pop("")
        names |= {part.name: _shown(now[part.name], part.places, whole) for part in self.others if part.name}
        names[name] = _shown(new, places, whole)


def taken_apart(
    graph: Graph, names: dict[str, Any], changed: Set[str], others: Set[str], reads: Set[str]
) -> OneArray | None:
    """The other names of an array by themselves before a statement changes it, which ``reads`` some of them at once.

    None where anything else knows the array, or where it is one of several.
    """
    arrays = {id(owner(names[name])) for name in others}
    several = [name for name in changed if id(owner(names.get(name))) in arrays]
    if len(several) != 1:
        return None
    parts = [_part(graph, name, names.get(name), names[several[0]]) for name in (*several, *sorted(others))]
    known = [part for part in parts if part]
    if len(known) < len(parts):
        return None
    array = owner(names[several[0]])
    whole = array.extent if isinstance(array, Quantity) else array.shape
    every = np.arange(int(np.prod(whole))).reshape(whole)
    all_of_it = all(np.array_equal(part.places, every) for part in known)
    if either_of(array) or not (all_of_it or graph.thin == 1):
        return None
    for node in () if all_of_it else (node for part in known for node in part.numbers.parts):
        graph.measure(node)
    known.append(_Part("", copy(lift(graph, array.copy() if isinstance(array, np.ndarray) else array)), every))
    for part in known:
        if part.name in reads:
            names[part.name] = copy(part.numbers)
        else:
            names.pop(part.name, None)
    return OneArray(known[0], known[1:])


def of_one_array(names: Iterable[str], others: Iterable[str], own: Mapping[str, Any]) -> set[str]:
    """Those of the names, among the worksheet's own values, that are of an array which one of the others is of too."""
    arrays = {id(owner(own[name])): name for name in others if _is_array(own.get(name))}
    return {n for n in names if arrays and _is_array(own.get(n)) and arrays.get(id(owner(own[n])), n) != n}


def _is_array(value: Any) -> bool:
    return isinstance(value, np.ndarray) and value.ndim > 0


def _part(graph: Graph, name: str, value: Any, array: Any) -> _Part | None:
    """What a name has of the array that another value is of; None where that is not known."""
    if type(value) not in (np.ndarray, Quantity) or owner(value) is not owner(array) or not is_double(value.dtype):
        return None
    places = _places(value)
    return None if places is None else _Part(name, copy(lift(graph, value)), places)


def _places(array: Any) -> Places | None:
    """Flat places of the elements of an array in that whose elements it shows; None where they are not known."""
    if isinstance(array, np.ndarray):
        return _in_memory(array, owner(array))
    if not isinstance(array.base, np.ndarray | Quantity):
        return np.arange(int(np.prod(array.extent))).reshape(array.extent)
    own = getattr(array, "places", ... if isinstance(array.base, np.ndarray) else None)
    beneath = None if own is None else _places(array.base)
    return beneath if beneath is None or own is ... else beneath.reshape(-1)[own]


def _in_memory(array: NDArray[Any], whole: NDArray[Any]) -> Places | None:
    if not whole.flags.c_contiguous or whole.dtype != array.dtype or not array.size:
        return None
    begin = array.__array_interface__["data"][0] - whole.__array_interface__["data"][0]
    along = (np.arange(count) * step for count, step in zip(array.shape, array.strides, strict=True))
    return reduce(np.add.outer, along, np.asarray(begin)) // array.itemsize


def _replaced(part: _Part, new: Quantity, at: Places, places: Places) -> Quantity:
    """A part in which those elements are new that another one, at some places, has too."""
    if np.array_equal(part.places, places):
        return copy(new)
    out_of = at[part.places.reshape(-1)]
    into = np.flatnonzero(out_of >= 0)
    return joined([part.numbers, new], _merged, into, out_of[into])


def _merged(old_and_new: Any, into: Places, out_of: Places) -> Any:
    old, new = old_and_new
    both = np.array(old, order="C")  # of which a flat one shows the elements
    both.reshape(-1)[into] = new.reshape(-1)[out_of]
    return both


def _shown(numbers: Quantity, places: Places, whole: Quantity) -> Quantity:
    """Numbers as elements of an array."""
    shown = copy(numbers)
    shown.base, shown.places = whole, places
    return shown
