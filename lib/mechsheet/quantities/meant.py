"""What stands for one of several lists or objects that may have other names."""

import weakref
from collections import Counter
from collections.abc import Iterator, Sequence
from sys import getrefcount
from typing import Any


class Meant:
    """The lists of a recording that stand for one of two, and what Python took out of what would give another one."""

    def __init__(self) -> None:
        self.made: list[Any] = []  # `OneOfLists` of the present statement
        self.before: list[weakref.ref[Any]] = []  # those of others, as far as somebody knows them
        self.gone: list[weakref.ref[Any]] = []  # arrays in whose place another one was put
        self.taken: dict[int, tuple[Any, dict[int, Any]]] = {}  # what Python took and out of what, by identities
        self.memories: Any = weakref.WeakSet()  # which hold what they compare
        self.missing: dict[int, Any] = {}  # by its identity: what stands for a row or an object where there is none

    def lists(self) -> Iterator[Any]:
        """All lists that stand for one of two."""
        yield from (each for ref in self.before if (each := ref()) is not None)
        yield from self.made

    def disturbed(self) -> set[int]:
        """Identities of those that are not what they stand for any more, and of what they stand for."""
        stale = (each for each in self.lists() if each.is_stale())
        return {id(part) for each in stale for part in (each, *each.ways)}

    def forget(self) -> None:
        """Before a statement: forget those that nobody knows, or that are not what they stand for, and what is gone."""
        self.gone.clear()
        made = [*map(weakref.ref, self.made)]
        self.made.clear()
        self.before = [ref for ref in (*self.before, *made) if (each := ref()) is not None and not each.is_stale()]

    def compared(self, value: Any) -> int:
        """How often a value is held by what compares later what there was."""
        return sum(one == id(value) for memory in self.memories for one in memory.holding())

    def are_known(self, ways: Sequence[Any]) -> bool:
        """Whether somebody else than what stands for them knows one of some lists."""
        held = Counter[int]()
        for each in self.lists():
            held.update(map(id, each.ways))
        held.update(map(id, (*self.made, *self.missing.values())))
        for memory in self.memories:
            held.update(memory.holding())
        return _are_known(ways, held)


def _are_known(ways: Sequence[Any], held: Counter[int]) -> bool:
    alone = (count <= _ALONE - 1 + held[id(way)] for way, count in zip(ways, _counted(ways), strict=True))
    return not all(alone) or any(_are_known(way.ways, held) for way in ways if hasattr(way, "ways"))


def _counted(values: Sequence[Any]) -> list[int]:
    """How often each of some values is referred to: by these, and by what counts."""
    return [getrefcount(value) for value in values]


_ALONE = _counted((object(),))[0]
