"""What is changed in place, for recorded quantities: elements that are set, parts of numbers, ``+=`` of an array."""

import operator
import weakref
from collections.abc import Callable, Iterator
from functools import reduce
from sys import getrefcount
from types import SimpleNamespace
from typing import Any

import numpy as np

from mechsheet.quantities.arithmetic import choice, cuts, is_count, only_where, row_numbers
from mechsheet.quantities.graph import Graph, NotRecorded, current
from mechsheet.quantities.node import Node, bottom_up
from mechsheet.quantities.operations import ELEMENTWISE
from mechsheet.quantities.quantity import Quantity, has_quantity, joined, lift, owner, plain, quantities
from mechsheet.quantities.selected import Selected
from mechsheet.quantities.written import Written
from mechsheet.recording import exactly, ordered
from mechsheet.recording.choices import element
from mechsheet.recording.memory import either_of, taken

OTHER_NAME = "an array is changed that has another name too"
NOT_SET = object()  # an element that there is not


def put_where(array: Any, key: Callable[[], Any], value: Any) -> Any:
    """The array after a condition has set ``array[key()]``, or left what is there as it is."""
    return array if value is NOT_SET else put(array, key(), value)


def put(array: Any, key: Any, value: Any) -> Any:
    """The array after ``array[key] = value``."""
    if value is NOT_SET:
        return array
    if not isinstance(array, np.ndarray | Quantity) or not has_quantity([array, key, value]):
        array[key] = value
        return array
    graph = next(quantities([array, key, value])).graph
    graph.meant.gone += former([array])
    return _put(lift(graph, array), key, value)


def _put(old: Quantity, key: Any, value: Any) -> Any:
    new = lift(old.graph, value)
    if not has_quantity([key]):
        old = of_now(old)
    new = new.astype(bool) if old.dtype == bool else new.astype(int) if cuts(old) else new
    chosen = _at(old, places, new) if (places := _by_places(old, key)) else _where(old, key, new)
    return joined([old, new], _placed, plain(key)) if chosen is None else chosen


def placed(array: Any, key: Any, value: Any) -> Any:
    """The same in a turn that may be taken once more: what was there before stays as it is."""
    return _put(lift(current.get(), array), key, value)


def of_now(old: Quantity, always: bool = False) -> Quantity:
    """The array in its present length, where Python has taken what this rests on as it is now, as a loop does."""
    if isinstance(old, Selected):
        return old
    graph, own = old.graph, [*old.parts]
    parts = [known for part in own if (known := _at_length(graph, part, always)) is not None]
    if len(parts) < len(own):
        return old
    for part in own:
        graph.measure(part)
    return Quantity(graph, *parts)


def _at_length(graph: Graph, node: Node, always: bool) -> Node | None:
    """An array of one value, and what has been set in it, in a length that Python has seen; None of anything else."""
    if not node.stretches:
        return node
    if node.op == "like":
        one = node
        while one.op == "like":
            one = one.args[0]
        begins = (n for n in bottom_up([node], ()) if n.stretches and not any(part.stretches for part in n.operands))
        seen = one.size == 1 and all(n.op == "rows" and (always or _seen(graph, n.args[0])) for n in begins)
        return graph.take(one, np.zeros(node.shape, int)) if seen else None
    if node.op != "join":
        return None
    sources, which, inside, moved = node.args
    starts = np.cumsum([0, *(source.size for source in sources)])
    parts = [part for source in sources if (part := _at_length(graph, source, always)) is not None]
    return graph.join(parts, starts[which] + inside, moved) if len(parts) == len(sources) else None


def _seen(graph: Graph, count: Node) -> bool:
    """Whether a number rests on nothing but what Python has looked at."""
    same = graph.same(count)
    if count in graph.fixed or same in graph.looked:
        return True
    return count.op in ELEMENTWISE and all(_seen(graph, operand) for operand in count.operands)


def _where(old: Quantity, key: Any, new: Quantity) -> Quantity | None:
    """The array in which a condition tells what is set, of as many elements; None where Python has to look at it."""
    if isinstance(key, tuple) and len(key) == 1:
        (key,) = key
    if isinstance(key, Selected) and key.are_places():
        key = key.holds
    if not isinstance(key, Quantity) or key.dtype != bool or isinstance(old, Selected) or key.extent != old.extent:
        return None
    graph = old.graph
    if graph.thin > 1 or key.re in graph.fixed or graph.size(key.re) != graph.size(old.whole().re):
        return None
    if isinstance(new, Selected) and new.holds.re is key.re and new.of.extent == old.extent:
        new = new.of
    elif isinstance(new, Selected) or not new.single:
        return None
    set_to: Quantity = choice(graph, key, new, old)
    return set_to


def _by_places(old: Quantity, key: Any) -> list[Any]:
    """The place along each axis of which a quantity tells, or that any array of as many rows has; or that of all."""
    parts = key if isinstance(key, tuple) else (key,)
    every = [*parts, *[slice(None)] * (old.ndim - len(parts))]
    told = [part for part in every if isinstance(part, Quantity)]
    if isinstance(old, Selected) or old.dtype.kind not in "iufc" or len(every) > old.ndim or old.graph.thin > 1:
        return []
    if not (told or (old.graph.draws and any(part.stretches for part in old.parts))):
        return []
    places = all(part.single and part.dtype != bool and is_count(part) for part in told)
    others = all(type(part) is int or part == slice(None) for part in every if not isinstance(part, Quantity))
    return every if places and others and any(type(part) is not slice for part in every) else []


def _at(old: Quantity, places: list[Any], new: Quantity) -> Quantity | None:
    """The array in which what stands at some places is set; None where there is none, or another number of them."""
    graph, axes = old.graph, range(old.ndim)
    of = {axis: place for axis, place in enumerate(places) if type(place) is not slice}
    kept = tuple(slice(None) if type(place) is slice else None for place in places)
    if new.ndim not in (0, old.ndim - len(of)):
        return None
    is_set, exists = [], []
    for axis, place in of.items():
        count = old.count(axis)
        place = choice(graph, place < 0, place + count, place)
        exists.append((place >= 0) & (place < count))
        is_set.append((row_numbers(graph, count) == place)[tuple(slice(None) if k == axis else None for k in axes)])
    there = lift(graph, reduce(operator.and_, exists))
    if not there.value:
        return None
    value = new[kept] if new.ndim else new
    if np.broadcast_shapes(value.extent, old.extent) != old.extent:
        return None
    where = lift(graph, reduce(operator.and_, is_set))
    graph.pivots.add(where.re)  # what stands at another place may have another unit
    set_to: Quantity = choice(graph, where, value, old)
    return only_where(graph, there, set_to)


def part_of(array: Any, key: Callable[[], Any]) -> Any:
    """``array[key()]``, where a way does not set it; there may be none, as behind the last row, nor such a key."""
    try:
        return element(array, key())
    except (IndexError, KeyError, ValueError):
        return NOT_SET


def held(container: Any, key: Any) -> Any:
    """``container[key]``, which is changed in place: of several lists Python looks which one it is."""
    if isinstance(container, dict) and isinstance(key, Written):
        return taken(container[str(key)], container)
    if isinstance(container, dict | list) and isinstance(key, Quantity) and key.single:
        number = key.seen().item()
        return taken(container[int(number) if isinstance(container, list) else number], container)
    return element(container, key)


def _placed(old_and_new: Any, key: Any) -> Any:
    """An array with some elements set to others."""
    old, new = old_and_new
    both = np.array(old, np.result_type(old, new))
    both[key] = new
    return both


class Live:
    """The elements of an array under a name as they are when a loop comes to them, which changes some meanwhile."""

    def __init__(self, now: Callable[[], Any]) -> None:
        self._now = now

    def __len__(self) -> int:
        return len(self._now())

    def __iter__(self) -> Iterator[Any]:
        return (self._now()[k] for k in range(len(self)))


def live(now: Callable[[], Any]) -> Any:
    """What a loop goes through that changes it: who went through an array would know it as it was."""
    value = now()
    return Live(now) if type(value) in (np.ndarray, Quantity) and value.ndim else value


def changed(old: Any, operation: str, value: Any) -> Any:
    """``old`` after ``old += value`` or another such operation."""
    old = exactly.of_array(old)
    if isinstance(old, list) and isinstance(value, Quantity) and value.ndim == 0:  # which is as often there
        value = value.__index__()
    if not (isinstance(old, np.ndarray | Quantity) and old.ndim and has_quantity([old, value])):
        return exactly.operated(operation, old, value, f"i{operation.rstrip('_')}")
    graph = next(quantities([old, value])).graph
    graph.meant.gone += former([old])
    new = lift(graph, getattr(operator, operation)(old, value))
    if new.extent != lift(graph, old).extent:
        raise ValueError(f"an array of shape {lift(graph, old).extent} cannot hold one of shape {new.extent}")
    return new


# What does nothing but keep what is set.
_KEEPING: tuple[Any, ...] = object.__setattr__, type.__setattr__, SimpleNamespace.__setattr__
_HOLDING: tuple[Any, ...] = list.__setitem__, dict.__setitem__


def put_held(value: Any, holder: Any, place: Any, key: Any, by_name: bool, operation: str = "") -> None:
    """``holder.place[key] = value``, or ``holder[place][key]``; or ``+=`` or another such ``operation``."""
    array = getattr(holder, place) if by_name else element(holder, place)
    value = changed(element(array, key), operation, value) if operation else value
    if not _is_held(holder, place, by_name):
        array[key] = value
        return
    new = put(array, key, value)
    if new is not array:
        if by_name and (type(holder).__setattr__ not in _KEEPING or _is_property(holder, place)):
            raise NotRecorded(f"an array of an object that sees to it itself when {place} is set")
        del array, value  # of which it may be a part
        setattr(holder, place, new) if by_name else operator.setitem(holder, place, new)
        settled(new)


def _is_held(holder: Any, place: Any, by_name: bool) -> bool:
    """Whether another array may be put in the place of one, which is no part of an array itself."""
    if by_name:
        return not isinstance(holder, np.ndarray | Quantity)
    kept = getattr(type(holder), "__setitem__", None) in _HOLDING
    return kept and not isinstance(place, Quantity | Written | slice)


def _is_property(holder: Any, name: str) -> bool:
    return isinstance(getattr(type(holder), name, None), property)


def changed_held(value: Any, holder: Any, name: str, operation: str) -> None:
    """``holder.name += value``, or another such operation."""
    new = changed(getattr(holder, name), operation, value)
    del value
    setattr(holder, name, new)
    settled(new)


def arranged(old: Any, method: str, named: dict[str, Any], *args: Any) -> Any:
    """``old`` after ``old.sort()`` or ``old.fill(value)``."""
    if type(old) is list and method == "sort" and not args:
        old[:] = ordered.ranked(old, **named)
        return old
    if not (isinstance(old, np.ndarray | Quantity) and old.ndim and has_quantity([old, *args])):
        getattr(old, method)(*args, **named)
        return old
    graph = next(quantities([old, *args])).graph
    graph.meant.gone += former([old])
    array = lift(graph, old)
    return np.sort(array, *args, **named) if method == "sort" else np.full_like(array, *args, **named)


def filled(old: Any, function: str, named: dict[str, Any], *args: Any) -> Any:
    """``old`` after one of numpy's functions has put some numbers into it."""
    if not has_quantity([old, named, *args]):
        getattr(np, function)(old, *args, **named)
        return old
    graph = next(quantities([old, named, *args])).graph
    graph.meant.gone += former([old])
    array = lift(graph, old)
    match function, args:
        case "copyto", (new,):
            return _put(array, ..., choice(graph, lift(graph, named.get("where", True)), new, array))
        case "fill_diagonal", (new,) if array.ndim == 2 and not named and np.ndim(new) == 0:
            return _put(array, ..., choice(graph, np.eye(*array.extent, dtype=bool), new, array))
        case ("putmask" | "place", (holds, new)) if (one := lift(graph, new)).size == 1:
            return _put(array, ..., choice(graph, lift(graph, holds), one.reshape(()), array))
        case "put", (places, new) if array.ndim == 1 and not named:
            return _put(array, places, new)
    raise NotRecorded(f"numpy's {function} of these arguments")


def outside(value: Any) -> Any:
    """What a function changes in place, which is no recorded array: none would be put for it."""
    if isinstance(value, Quantity) and value.ndim:
        raise NotRecorded("an array that numpy changes in place")
    return value


def overwriting(value: Any) -> Any:
    """Whether scipy may put what it needs into the arrays that it is given: none would be put for them."""
    if value:
        raise NotRecorded("an array that scipy overwrites")
    return value


def former(values: list[Any]) -> list[Any]:
    """Arrays before what changes them, for who looks behind that whether they are known still."""
    arrays = [owner(array) for array in values if isinstance(array, np.ndarray | Quantity) and array.ndim]
    every = (each for array in arrays for each in (array, *either_of(array)))
    return [weakref.ref(each) for each in every if not isinstance(each, list)]


def left(arrays: list[Any]) -> None:
    """End the changes of arrays: nobody else may know one as it was before, but for who compares what there was."""
    for known in arrays:
        if (array := known()) is not None:
            compared = current.get().meant.compared(array)
            if getrefcount(array) > _BY_ONE + compared:
                raise NotRecorded(OTHER_NAME)


def _by_one_name() -> int:
    array = np.zeros(1)
    return getrefcount(array)


_BY_ONE = _by_one_name()


def is_array(value: Any) -> bool:
    return isinstance(value, np.ndarray | Quantity) and value.ndim > 0


def unshared(values: list[Any]) -> None:
    """NotRecorded where somebody knows one of some arrays beside who changes copies of them under a name."""
    if any(is_array(value) and getrefcount(value) > _IN_LIST for value in values):
        raise NotRecorded(OTHER_NAME)


def _most(values: list[Any]) -> int:
    return max(getrefcount(value) for value in values)


_IN_LIST = (lambda array: _most([array]))(np.zeros(1))  # of one with one name, in a list


def settled(new: Any) -> None:
    """End the change of an array for which another one has been put: nobody else may know the old one."""
    if isinstance(new, Quantity):
        gone, new.graph.meant.gone = new.graph.meant.gone, []
        left(gone)


def part(number: Any, name: str, value: Any) -> Any:
    """The number after ``number.real = value`` or ``number.imag = value``."""
    if not has_quantity([number, value]):
        setattr(number, name, value)
        return number
    graph = next(iter(quantities([number, value]))).graph
    old, new = lift(graph, number), lift(graph, value)
    if new.im is not None:
        raise NotRecorded(f"a complex number as the {name} part of another")
    own = graph.like(new.re, old.re)
    return Quantity(graph, own, old.imag.re) if name == "real" else Quantity(graph, old.re, own)


CALLS: dict[str, Any] = {
    "put": put, "placed": placed, "put_where": put_where, "part_of": part_of, "changed": changed, "settled": settled,
    "part": part, "former": former, "left": left, "arranged": arranged, "outside": outside, "held": held,
    "live": live, "filled": filled, "put_held": put_held, "changed_held": changed_held, "overwriting": overwriting,
}  # fmt: skip
CALLS |= {f"own {change}": CALLS[change] for change in ("put", "placed", "put_where", "changed", "arranged", "filled")}
