"""Rows, lists and objects of a worksheet's own table, of which a condition tells which one is meant: part by part."""

from collections.abc import Callable, ItemsView, Iterator, Mapping, Sequence, ValuesView
from copy import copy, deepcopy
from dataclasses import is_dataclass
from operator import attrgetter, itemgetter, setitem
from types import FunctionType, MethodType, SimpleNamespace
from typing import Any

from mechsheet.quantities.graph import NotRecorded, current
from mechsheet.quantities.refused import needed

Merge = Callable[[Any, Any], Any]  # of what both have as a part, the one that is meant
NEW = "one of several objects is given a part that it had not"


def _once(own: Any, key: Any, x: Any, y: Any, of: Callable[[Any], Any]) -> Any:
    """The part of one of two that ``of`` reads, which is merged once unless Python sees which of the two it is."""
    held, known, graph, now = own._held, repr(key), current.get(), [of(each) for each in every(own)]
    if known in held and all(a is b for a, b in zip(now, held[known][0], strict=True)):
        return held[known][1]
    looked, graph.looked = graph.looked, {}
    try:
        found = own._merge(of(x), of(y))
    finally:
        seen, graph.looked = graph.looked, looked | graph.looked
    if not seen:
        held[known] = now, found
    return found


def every(one: Any) -> list[Any]:
    """All rows or objects of which one is meant, each once."""
    if not isinstance(one, Row | Fields | Thing):
        return [one]
    if None not in one._held:
        one._held[None] = [*{id(each): each for way in _ways(one) for each in every(way)}.values()]
    found: list[Any] = one._held[None]
    return found


def _ways(one: Any) -> Sequence[Any]:
    ways: Sequence[Any] = one._things if isinstance(one, Thing) else one._rows
    return ways


def _set(own: Any, value: Any, of: Callable[[Any], Any], put: Callable[[Any, Any], None]) -> None:
    """Give a part of one of two a value: it is set in each of them where that one is meant."""
    must_exist(own)
    _put(own, value, of, put)


def _put(own: Any, value: Any, of: Callable[[Any], Any], put: Callable[[Any, Any], None]) -> None:
    if not isinstance(own, Row | Fields | Thing):
        put(own, value)
        return
    x, y = _ways(own)
    _put(x, own._merge(value, of(x)), of, put)
    _put(y, own._merge(of(y), value), of, put)  # as it is by now: the first may be in it


def must_exist(one: Any) -> None:
    """Note that a row or an object is there: Python has an error where it sets a part of none."""
    if (there := _exists(one)) is not True:
        needed(there, "there is none of which a part is set")


def _exists(one: Any) -> Any:
    """Whether one that the worksheet has is meant, and not what stands for it where it has none."""
    ways = _ways(one) if isinstance(one, Row | Fields | Thing) else one.ways if hasattr(type(one), "is_alone") else ()
    return one._merge(*map(_exists, ways)) if ways else id(one) not in current.get().meant.missing


class Known(dict[Any, Any]):
    """What is merged already of one of two: nothing of the worksheet's, which may change."""


class Row(Mapping[Any, Any]):
    """One of two dictionaries with the same keys."""

    __slots__ = ("_held", "_merge", "_rows")

    def __init__(self, merge: Merge, x: Mapping[Any, Any], y: Mapping[Any, Any]) -> None:
        self._merge, self._rows, self._held = merge, (x, y), Known()

    def __getitem__(self, key: Any) -> Any:
        return _once(self, key, *self._rows, itemgetter(key))

    def __setitem__(self, key: Any, value: Any) -> None:
        if key not in self._rows[0]:
            raise NotRecorded(NEW)
        _set(self, value, itemgetter(key), lambda row, part: setitem(row, key, part))

    def __iter__(self) -> Iterator[Any]:
        keys, *others = map(list, every(self))
        if any(each != keys for each in others):
            raise NotRecorded("two dictionaries have their keys in another order")
        return iter(keys)

    def values(self) -> ValuesView[Any]:
        iter(self)  # else the reason would be told as one of the view's
        return super().values()

    def items(self) -> ItemsView[Any, Any]:
        iter(self)
        return super().items()

    def __len__(self) -> int:
        return len(self._rows[0])

    def __copy__(self) -> Any:
        new: Any = copy(every(self)[0])
        new.update(self)
        return new

    def __deepcopy__(self, known: dict[int, Any]) -> Any:
        return deepcopy(copy(self), known)

    copy = __copy__


class Fields(Sequence[Any]):
    """One of two tuples or lists of a length, of which not all parts are numbers."""

    __slots__ = ("_held", "_merge", "_rows")

    def __init__(self, merge: Merge, x: Sequence[Any], y: Sequence[Any]) -> None:
        self._merge, self._rows, self._held = merge, (x, y), Known()

    def __getitem__(self, key: Any) -> Any:
        x, y = self._rows
        if isinstance(key, slice):
            return tuple(map(self._merge, x[key], y[key]))
        return _once(self, key, x, y, itemgetter(key))

    def __setitem__(self, key: Any, value: Any) -> None:
        if isinstance(key, slice):
            raise NotRecorded(NEW)
        _set(self, value, itemgetter(key), lambda row, part: setitem(row, key, part))

    def __len__(self) -> int:
        return len(self._rows[0])

    def __getattr__(self, name: str) -> Any:
        """A part of a named tuple."""
        if name.startswith("_"):
            raise AttributeError(name)
        return _once(self, name, *self._rows, attrgetter(name))

    def __copy__(self) -> Any:
        return self if isinstance(every(self)[0], tuple) else [*self]


class Thing:
    """One of two objects of a class."""

    __slots__ = ("_held", "_merge", "_things")
    __hash__ = None  # type: ignore[assignment]  # as that of what is compared by its parts

    def __init__(self, merge: Merge, x: Any, y: Any) -> None:
        self._merge, self._things, self._held = merge, (x, y), Known()

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):
            raise AttributeError(name)
        if isinstance(method := getattr(_kind(self._things[0]), name, None), FunctionType):
            return MethodType(method, self)
        return _once(self, name, *self._things, attrgetter(name))

    def __setattr__(self, name: str, value: Any) -> None:
        if name in Thing.__slots__:
            super().__setattr__(name, value)
            return
        kind: Any = _kind(self)
        usual = kind.__setattr__ in (object.__setattr__, SimpleNamespace.__setattr__)
        if not usual or hasattr(getattr(kind, name, None), "__set__"):
            raise NotRecorded(f"{kind.__name__} says itself what it is to set {name}")
        if not hasattr(self._things[0], name):
            raise NotRecorded(NEW)
        _set(self, value, attrgetter(name), lambda thing, part: setattr(thing, name, part))

    def __copy__(self) -> Any:
        kind: Any = _kind(self)
        new = kind.__new__(kind)
        vars(new).update((name, getattr(self, name)) for name in vars(every(self)[0]))
        return new

    def __deepcopy__(self, known: dict[int, Any]) -> Any:
        return deepcopy(copy(self), known)

    def __bool__(self) -> bool:
        kind: Any = _kind(self)
        own = getattr(kind, "__bool__", None) or getattr(kind, "__len__", None)
        return bool(own(self)) if own else True

    def __str__(self) -> str:
        raise NotRecorded("one of several objects is written as a text")

    def __eq__(self, other: object) -> Any:
        x, y = self._things
        return self._merge(x == other, y == other)

    def __ne__(self, other: object) -> Any:
        x, y = self._things
        return self._merge(x != other, y != other)


def is_same(x: Any, y: Any) -> Any:
    """``x is y``, where either may be one of two; None where a row of numbers is one that nobody can tell."""
    for one, other in ((x, y), (y, x)):
        if isinstance(one, Row | Fields | Thing):
            ways = [is_same(each, other) for each in _ways(one)]
            return None if any(way is None for way in ways) else one._merge(*ways)
    return None if x is not y and isinstance(x, tuple | list) and isinstance(y, tuple | list) else x is y


def changed(change: Callable[[Any], Any], one: "Row | Fields | Thing") -> Any:
    """One of two other rows or objects, each as it is changed."""
    return type(one)(one._merge, *map(change, _ways(one)))


def parted(merge: Merge, x: Any, y: Any) -> Any:
    """One of two rows or objects, by its parts; None where these are not of one kind."""
    if isinstance(x, dict | Row) and isinstance(y, dict | Row):
        return Row(merge, x, y) if {*x} == {*y} else None
    if isinstance(x, tuple | list | Fields) and isinstance(y, tuple | list | Fields):
        return Fields(merge, x, y) if len(x) == len(y) else None
    return Thing(merge, x, y) if _kind(x) is _kind(y) is not None else None


def is_object(value: Any) -> bool:
    """Whether an object of the worksheet's own that holds its parts under names, and no one of two."""
    return not isinstance(value, Thing) and _kind(value) is not None and hasattr(value, "__dict__")


def _kind(value: Any) -> type | None:
    """The class of an object that holds its parts under names, of the worksheet's own."""
    while isinstance(value, Thing):
        value = value._things[0]
    of_own = is_dataclass(value) and not type(value).__module__.startswith("mechsheet.")
    return type(value) if isinstance(value, SimpleNamespace) or of_own else None
