"""One of several named options, as an input holds it."""

from collections.abc import Mapping
from operator import index
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mechsheet.worksheet import errors


class Chosen:
    """One of several named options: equal to its name and used as that text is, with its properties as attributes.

    >>> shear = Chosen(("single", "double"), 1, {"planes": 2})
    >>> shear == "double", f"{shear} shear", "in " + shear, shear.upper(), shear[:2], shear.planes
    (True, 'double shear', 'in double', 'DOUBLE', 'do', 2)
    """

    def __new__(cls, options: tuple[str, ...], at: Any, properties: Mapping[str, Any]) -> "Chosen":
        return str.__new__(ChosenText, options[at]) if isinstance(at, int | np.integer) else object.__new__(cls)

    def __init__(self, options: tuple[str, ...], at: Any, properties: Mapping[str, Any]) -> None:
        self._options, self._at, self._properties = options, at, properties

    def __getnewargs__(self) -> tuple[Any, ...]:
        return self._options, self._at, self._properties

    def _of(self, name: str) -> int:
        if name not in self._options:
            raise ValueError(f"{errors.as_given(name)} is none of the options {', '.join(self._options)}")
        return self._options.index(name)

    def __eq__(self, other: object) -> Any:
        if isinstance(other, str | Chosen):
            return self._at == self._of(str(other))
        return NotImplemented

    def __ne__(self, other: object) -> Any:
        if isinstance(other, str | Chosen):
            return self._at != self._of(str(other))
        return NotImplemented

    def __hash__(self) -> int:
        return hash(str(self))

    def __lt__(self, other: object) -> Any:
        return str(self) < str(other) if isinstance(other, str | Chosen) else NotImplemented

    def __le__(self, other: object) -> Any:
        return str(self) <= str(other) if isinstance(other, str | Chosen) else NotImplemented

    def __gt__(self, other: object) -> Any:
        return str(self) > str(other) if isinstance(other, str | Chosen) else NotImplemented

    def __ge__(self, other: object) -> Any:
        return str(self) >= str(other) if isinstance(other, str | Chosen) else NotImplemented

    def __bool__(self) -> bool:
        return all(self._options) or bool(str(self))

    def __len__(self) -> int:
        return len(str(self))

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> NDArray[Any]:
        return np.array(str(self), dtype)

    def __str__(self) -> str:
        return self._options[index(self._at)]

    def __format__(self, form: str) -> str:
        return str(self).__format__(form)

    def __repr__(self) -> str:
        return repr(str(self))

    def __getitem__(self, key: Any) -> str:
        return str(self)[key]

    def __contains__(self, part: object) -> bool:
        return str(part) in str(self)

    def __add__(self, other: object) -> Any:
        return str(self) + str(other) if isinstance(other, str | Chosen) else NotImplemented

    def __radd__(self, other: object) -> Any:
        return other + str(self) if isinstance(other, str) else NotImplemented

    def __mul__(self, other: object) -> Any:  # a text would be repeated, and "8" be taken for a number
        raise TypeError(f"unsupported operand type(s) for *: 'Chosen' and {type(other).__name__!r}")

    def __rmul__(self, other: object) -> Any:
        raise TypeError(f"unsupported operand type(s) for *: {type(other).__name__!r} and 'Chosen'")

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        if name not in self._properties and hasattr(str, name):
            return getattr(str(self), name)
        if name not in self._properties:
            has = ", ".join(self._properties)
            raise AttributeError(f"an option has no property {name}" + (f"; it has {has}" if has else ""))
        return self._properties[name]


class ChosenText(Chosen, str):
    """The same where it is known which one it is: a text for whatever takes one."""

    def __init__(self, options: tuple[str, ...], at: Any, properties: Mapping[str, Any]) -> None:
        super().__init__(options, at, properties)
        vars(self).update(properties)  # which go before the methods of texts


def first(chosen: Chosen) -> Chosen:
    """The same with the first of the options, as one of its kind."""
    return Chosen(chosen._options, 0, chosen._properties)


def place(chosen: Chosen) -> tuple[tuple[str, ...], Any]:
    """The names of all options, and the number of the chosen one."""
    return chosen._options, chosen._at


def cases(chosen: Chosen) -> dict[str, Any]:
    """Whether each of the options is the chosen one, by name."""
    return {option: chosen == option for option in chosen._options}
