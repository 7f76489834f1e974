"""Elements of arrays moved along, put in, left out and set around: numpy's roll, insert, delete and pad."""

from typing import Any

import numpy as np

from mechsheet.quantities.arithmetic import choice, cuts, is_count, only_where, row_numbers
from mechsheet.quantities.graph import Graph, NotRecorded
from mechsheet.quantities.quantity import Quantity, is_any_length, joined, lift, moved, plain
from mechsheet.quantities.refused import refused
from mechsheet.quantities.selected import Selected

_MOVING = ("edge", "reflect", "symmetric", "wrap")  # modes of pad that give elements which there are


def _is_told(x: Quantity, place: Any, axis: Any) -> bool:
    """Whether a quantity tells by how much, or where, an array is changed along one axis."""
    if not isinstance(place, Quantity) or place.extent or not is_count(place):
        return False
    one_axis = x.ndim == 1 if axis is None else type(axis) is int
    return one_axis and not isinstance(x, Selected) and x.graph.thin == 1


def rolled(graph: Graph, x: Any, shift: Any, axis: Any = None) -> Any:
    x = lift(graph, x)
    if not _is_told(x, shift, axis):
        return x.rearranged(np.roll, plain(shift), *(() if axis is None else (plain(axis),)))
    along = moved(x, axis or 0, 0)
    count = along.count(0)
    return moved(along[(row_numbers(graph, count) - shift) % count], 0, axis or 0)


def _of_any_length(x: Quantity, place: Any) -> Any:
    """The place, as one of which rows tell whether there is one where readers take any number of them."""
    return lift(x.graph, place) if type(place) is int and is_any_length(x) else place


def _place(place: Any, count: Any, ends: Any) -> tuple[Any, Any]:
    """The place as one from the first element on, and whether there is one: one of ``ends``."""
    place = choice(place.graph, place < 0, place + count, place)
    exists = (place >= 0) & (place < ends)
    if not exists.value and not place.graph.supposed:
        raise IndexError("there is no such place")
    return place, exists


def without(graph: Graph, x: Any, place: Any, axis: Any = None) -> Any:
    x = lift(graph, x)
    place = _of_any_length(x, place)
    if not _is_told(x, place, axis):
        return x.rearranged(np.delete, plain(place), plain(axis))
    along = moved(x, axis or 0, 0)
    count = along.count(0)
    place, exists = _place(place, count, count)
    rows = row_numbers(graph, count - 1)
    left = along[choice(graph, rows < place, rows, rows + 1)]
    return moved(refused(only_where(graph, exists, left)), 0, axis or 0)


def _of_kind(x: Quantity, new: Any) -> Any:
    """What an array makes of numbers that are put into it."""
    new = lift(x.graph, new)
    if new.im is not None and x.im is None:
        raise NotRecorded("a complex number put among real ones")
    if x.dtype == bool or new.dtype == bool:
        return new.astype(x.dtype)
    return new.astype(int) if cuts(x) else new


def inserted(graph: Graph, x: Any, place: Any, values: Any, axis: Any = None) -> Any:
    x = lift(graph, x)
    new, place = _of_kind(x, values), _of_any_length(x, place)
    if not (new.single and not new.ndim and _is_told(x, place, axis)):
        return joined([x, new], _put_in, plain(place), plain(axis))
    along = moved(x, axis or 0, 0)
    count = along.count(0)
    place, exists = _place(place, count, count + 1)
    rows = row_numbers(graph, count + 1)
    at = choice(graph, rows < place, rows, choice(graph, rows == place, count, rows - 1))
    both: Any = np.concatenate([along, new.like(along[:1])])
    return moved(refused(only_where(graph, exists, both[at])), 0, axis or 0)


def _put_in(array_and_new: Any, place: Any, axis: Any) -> Any:
    array, new = array_and_new
    return np.insert(array, place, new, axis)


def padded(graph: Graph, x: Any, width: Any, mode: Any = "constant", constant_values: Any = 0) -> Any:
    x = lift(graph, x)
    if mode in _MOVING:
        return x.rearranged(np.pad, plain(width), mode=mode)
    if mode != "constant":
        raise NotRecorded(f"numpy's pad in the mode {mode}")
    new = _of_kind(x, constant_values)
    if is_any_length(x):
        edges, counts = new.broadcast((1, 2))[0], np.broadcast_to(plain(width), (1, 2))[0]
        before, after = (edge.broadcast((int(count),)) for edge, count in zip(edges, counts, strict=True))
        return joined([before, x, after], np.concatenate)
    return joined([x, new], _set_around, plain(width))


def _set_around(array_and_new: Any, width: Any) -> Any:
    array, new = array_and_new
    return np.pad(array, width, constant_values=new)
