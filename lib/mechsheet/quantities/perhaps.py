"""What may be None: Python's `is None` is a condition then, and whatever else is made of it is made of the value.

For inputs for which it is None that is an error of Python's, and no number here.
"""

from collections.abc import Callable, Iterator
from copy import copy, deepcopy
from typing import Any

from mechsheet.quantities.graph import NotRecorded
from mechsheet.quantities.node import Node
from mechsheet.quantities.quantity import Quantity
from mechsheet.quantities.refused import on_ways, sure, unless


class Number(Quantity):
    """Numbers, or None where ``some`` does not hold; so are its elements, which Python has an error for."""

    __slots__ = ("some",)

    def __init__(self, some: Quantity, value: Quantity) -> None:
        super().__init__(value.graph, value.re, value.im)
        self.some, self.base = some, value

    @property
    def nodes(self) -> list[Node]:
        return [*self.parts, *self.some.parts]

    def __bool__(self) -> bool:
        return bool(self.some) and super().__bool__()

    def __copy__(self) -> "Number":
        return Number(self.some, self)

    def each(self, f: Callable[[Node], Node]) -> "Number":
        return Number(self.some, super().each(f))


class Row:
    """A row, a text, a function or an object of the worksheet's own, or None, into which Python cannot look."""

    __slots__ = ("_itself", "_some")

    def __init__(self, some: Quantity, value: Any) -> None:
        self._some, self._itself = some, value

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):
            raise AttributeError(name)
        return self._part(getattr(self._itself, name))

    def __setattr__(self, name: str, value: Any) -> None:
        if name in Row.__slots__:
            super().__setattr__(name, value)
        else:
            setattr(there(self), name, value)

    def __getitem__(self, key: Any) -> Any:
        return self._part(self._itself[key])

    def __setitem__(self, key: Any, value: Any) -> None:
        there(self)[key] = value

    def __call__(self, *given: Any, **named: Any) -> Any:
        return there(self)(*given, **named)

    def __iadd__(self, more: Any) -> Any:
        own = there(self)
        own += more
        return own

    def __copy__(self) -> Any:
        return copy(there(self))

    def __deepcopy__(self, known: dict[int, Any]) -> Any:
        return deepcopy(there(self), known)

    def _part(self, part: Any) -> Any:
        """A part of it: a number is none where it is None, of all else Python looks whether it is there."""
        if isinstance(part, Quantity):
            return part if sure(self._some) else unless(self._some, part)
        there(self)
        return part

    def __iter__(self) -> Iterator[Any]:
        return iter(there(self))

    def __bool__(self) -> bool:
        return bool(settled(self))

    def __hash__(self) -> int:
        return hash(settled(self))

    def __eq__(self, other: object) -> Any:
        same = None if isinstance(self._itself, tuple | list | dict) else self._itself == other
        return self._some & same if isinstance(same, Quantity) else settled(self) == other

    def __ne__(self, other: object) -> Any:
        same = self == other
        return not same if isinstance(same, bool) else same == 0


def _looking(name: str) -> Callable[..., Any]:
    def method(self: Row, *given: Any) -> Any:
        return getattr(there(self), name)(*given)

    return method


for _name in (
    "__len__", "__contains__", "__str__", "__format__", "__repr__",
    "__lt__", "__le__", "__gt__", "__ge__", "__add__", "__radd__", "__mul__", "__rmul__",
):  # fmt: skip
    setattr(Row, _name, _looking(_name))

Perhaps = Number | Row


def some_of(value: Any) -> Any:
    """Whether there is a value, as a condition or as what is so for all inputs."""
    if isinstance(value, Perhaps):
        return value.some if isinstance(value, Number) else value._some
    return value is not None


def itself(value: Any) -> Any:
    """The value, where there is one."""
    if isinstance(value, Number):
        number = Quantity(value.graph, value.re, value.im)
        number.base = value
        return number
    return value._itself if isinstance(value, Row) else value


def settled(value: Any) -> Any:
    """A value or None, for Python to look at: a guard tells while it is the same of the two."""
    if not isinstance(value, Perhaps):
        return value
    return itself(value) if some_of(value) else None


def there(value: Any) -> Any:
    """A value that Python looks into, for which it has an error where that is None."""
    if isinstance(value, Perhaps) and not sure(some_of(value)):
        holds = on_ways(some_of(value))
        if not holds.value:
            raise NotRecorded("it is None")
        holds.graph.see(holds.re)
    return itself(value)
