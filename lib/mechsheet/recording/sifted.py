"""A list of those elements for which a condition holds, which Python need not look at to count them."""

from collections.abc import Callable
from functools import reduce
from operator import or_
from typing import Any

from mechsheet.quantities.graph import Graph, Guard, NotRecorded
from mechsheet.quantities.quantity import Quantity, has_quantity, lift
from mechsheet.quantities.written import Written, either, joined

Pairs = list[tuple[Any, Any]]  # of every element whether it is kept, and its value
_READ = (
    "__iter__", "__len__", "__contains__", "__eq__", "__ne__", "__lt__", "__le__", "__gt__", "__ge__", "__add__",
    "__mul__", "__rmul__", "__reversed__", "__repr__", "index", "count", "copy", "__reduce_ex__",
)  # fmt: skip
_CHANGE = (
    "__setitem__", "__delitem__", "__iadd__", "__imul__", "append", "extend", "insert", "pop", "remove", "clear",
    "sort", "reverse",
)  # fmt: skip


class Sifted(list[Any]):
    """The elements that are kept now; how many, whether any, the first, the least and their sum hold for others too.

    Whatever else reads the list sees of every element whether it is kept.
    """

    def __init__(self, pairs: Pairs, asked: Callable[..., Any]) -> None:
        """``asked(kind, pairs, otherwise)`` is what Python makes of the elements that are kept."""
        super().__init__(value for holds, value in pairs if _now(holds))
        self.pairs, self._asked = pairs, asked

    def of(self, kind: str, *otherwise: Any) -> Any:
        """What ``len``, ``min``, ``max``, ``sum`` and the like give."""
        return self._asked(kind, [(holds, _given(value)) for holds, value in self.pairs], otherwise)

    @property
    def some(self) -> Any:
        """Whether there are any."""
        return reduce(or_, (holds for holds, _ in self.pairs))

    def each(self) -> Pairs:
        """Of every element whether it is kept, and the element."""
        return self.pairs

    def held(self) -> list[Any]:
        """All that it is made of, for who does not read it."""
        return [*list.__iter__(self), *(part for pair in self.pairs for part in pair)]

    def __bool__(self) -> bool:
        return bool(self.some) if self.pairs else list.__len__(self) > 0

    def __getitem__(self, key: Any) -> Any:
        if self.pairs and type(key) is int and key in (0, -1):
            return self.of("last" if key else "first")
        self._look()
        return super().__getitem__(key)

    def __radd__(self, other: list[Any]) -> list[Any]:
        return [*other, *self]

    def _look(self) -> None:
        for holds, _ in self.pairs:
            bool(holds)


def in_one(graph: Graph, values: list[Any] | tuple[Any, ...]) -> tuple[Quantity, list[Guard]] | None:
    """A list or a tuple as the one quantity that it is shown as, and what Python sees of it: which ones are kept.

    None where no number of it follows, of rows that are not as long as each other, and of texts.
    """
    looked, graph.looked = graph.looked, {}
    try:
        return (lift(graph, values), [*graph.looked.values()]) if has_quantity(values) or graph.looked else None
    except (NotRecorded, ValueError):
        return None
    finally:
        graph.looked = looked


def joined_kept(sign: Any, parts: Any) -> Any:
    """``sign.join(parts)``, of texts that are kept by conditions as well."""
    pairs = parts.each() if isinstance(sign, str) and isinstance(parts, Sifted) else []
    if not pairs or not all(isinstance(x, str | Written) for _, x in pairs):
        return joined(sign, parts)
    said = list[str | Written]()
    before: Any = None  # whether any is kept before it
    for holds, value in pairs:
        behind = joined(sign, ["", value])
        if before is not None:
            value = behind if before is True else either(before, behind, value)
        said.append(value if holds is True else either(holds, value, ""))
        before = True if before is True or holds is True else holds if before is None else before | holds
    return joined("", [Written(()), *said])


def _now(holds: Any) -> bool:
    return bool(holds.value) if isinstance(holds, Quantity) else bool(holds)


def _given(value: Any) -> Callable[[], Any]:
    return lambda: value


def _reading(name: str) -> Callable[..., Any]:
    own = getattr(list, name)

    def read(self: Sifted, *given: Any, **named: Any) -> Any:
        self._look()
        return own(self, *given, **named)

    return read


def _changing(name: str) -> Callable[..., Any]:
    own = getattr(list, name)

    def change(self: Sifted, *given: Any, **named: Any) -> Any:
        if any(isinstance(holds, Quantity) and holds.graph.supposed for holds, _ in self.pairs):
            raise NotRecorded("a list is changed where Python does not go")
        self._look()
        self.pairs = []  # it is a list as any other from here on
        return own(self, *given, **named)

    return change


for _name in _READ:
    setattr(Sifted, _name, _reading(_name))
for _name in _CHANGE:
    setattr(Sifted, _name, _changing(_name))
