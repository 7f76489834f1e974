"""One of two lists that may have other names: who changes it changes the one that is meant."""

from collections.abc import Callable, Iterable
from copy import deepcopy
from typing import Any

from mechsheet.quantities.graph import NotRecorded
from mechsheet.quantities.meant import Meant
from mechsheet.quantities.options import must_exist

CHANGED = "a list is changed of which a condition tells which one it is"
_CHANGE = (
    "__delitem__", "__iadd__", "__imul__", "append", "extend", "insert", "pop", "remove", "clear", "sort", "reverse",
)  # fmt: skip


class OneOfLists(list[Any]):
    """The parts of one of two lists, each merged; a part that is set is set in both, where that one is meant.

    Whatever else changes it is not followed, unless nobody else knows the two: then it is a list as any other.
    """

    def __init__(self, parts: Iterable[Any], meant: Meant, merge: Callable[[Any, Any], Any], *ways: list[Any]) -> None:
        super().__init__(parts)
        self.ways, self._meant, self._merge = ways, meant, merge
        self._note()
        meant.made.append(self)

    def _note(self) -> None:
        """Note what it holds, and what they do."""
        self._held = [*map(list.copy, (self, *self.ways))]

    def is_stale(self) -> bool:
        """Whether one of the two has changed, or this one without them."""
        now = (self, *self.ways)
        return bool(self.ways) and any(
            len(each) != len(then) or any(a is not b for a, b in zip(list.__iter__(each), then, strict=True))
            for each, then in zip(now, self._held, strict=True)
        )

    def is_alone(self) -> bool:
        """Whether it is a list as any other by now, for nobody else knows the two."""
        if self.ways and not self._meant.are_known(self.ways):
            self.ways = ()
        return not self.ways

    def __copy__(self) -> list[Any]:
        return [*self]

    def __deepcopy__(self, known: dict[int, Any]) -> list[Any]:
        return [deepcopy(part, known) for part in self]

    def __setitem__(self, key: Any, value: Any) -> None:
        if not self.is_alone():
            must_exist(self)
        self._put(key, value)

    def _put(self, key: Any, value: Any) -> None:
        if not self.is_alone():
            if type(key) is not int or self.is_stale():
                raise NotRecorded(CHANGED)
            x, y = self.ways
            parts = self._merge(value, x[key]), self._merge(y[key], value)
            if any(part is None for part in parts):
                raise NotRecorded(CHANGED)
            for way, part in zip((x, y), parts, strict=True):
                (way._put if isinstance(way, OneOfLists) else way.__setitem__)(key, part)
        super().__setitem__(key, value)
        self._note()


def _changing(name: str) -> Callable[..., Any]:
    own = getattr(list, name)

    def change(self: OneOfLists, *given: Any, **named: Any) -> Any:
        alone, found = self.is_alone(), own(self, *given, **named)
        if not alone:
            raise NotRecorded(CHANGED)
        return found

    return change


for _name in _CHANGE:
    setattr(OneOfLists, _name, _changing(_name))
