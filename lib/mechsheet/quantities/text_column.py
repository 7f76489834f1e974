"""A column of texts among the inputs, as a recording has it: of each is known whether it is the exported one."""

from collections.abc import Iterator
from operator import index
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mechsheet.quantities.quantity import Quantity
from mechsheet.quantities.written import OneOf, Written


class Texts:
    """Texts of the column of that ``name``, those of the rows ``at``: one is `Written`, at all of them Python looks.

    The ``column`` is 0 where a text is the exported one, else 1.
    """

    dtype, ndim, base = np.dtype(object), 1, None
    __hash__ = None  # type: ignore[assignment]  # as of an array

    def __init__(self, name: str, column: Quantity, texts: tuple[str, ...], at: Quantity) -> None:
        self.name, self.column, self.texts, self.at = name, column, texts, at

    def __getitem__(self, key: Any) -> "Written | Texts":
        at, column = self.at[key], self.column
        if at.ndim:
            return Texts(self.name, column, self.texts, at)
        return Written((OneOf(at, self.texts, column, self.name),))

    def __len__(self) -> int:
        return index(self.at.count(0))

    def __iter__(self) -> Iterator[Any]:
        return (self[k] for k in range(len(self)))

    @property
    def shape(self) -> tuple[Any, ...]:
        return self.at.shape

    @property
    def size(self) -> Any:
        return self.at.size

    @property
    def same(self) -> Quantity:
        """Where a text is the exported one 0, else 1: what stands in a table for it."""
        return self.column[self.at]

    def seen(self) -> NDArray[Any]:
        """The texts for Python to look at; a guard tells while they are the same."""
        rows = self.at.seen()
        self.at.graph.read(self.same.re)
        return np.array([self.texts[k] for k in rows], object)

    def __repr__(self) -> str:
        return repr(self.seen())

    def __str__(self) -> str:
        return str(self.seen())

    def tolist(self) -> list[Any]:
        return list(self)

    def __getattr__(self, name: str) -> Any:
        """Whatever else an array has."""
        if name.startswith("_"):
            raise AttributeError(name)
        return getattr(self.seen(), name)

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> NDArray[Any]:
        return self.seen() if dtype is None else self.seen().astype(dtype)

    def __eq__(self, other: object) -> Any:
        return self.seen() == (other.seen() if isinstance(other, Texts) else _plain(other))

    def __ne__(self, other: object) -> Any:
        return ~(self == other)

    def __contains__(self, text: object) -> bool:
        return bool((self == text).any())


def _plain(text: object) -> object:
    return str(text) if isinstance(text, Written) else text
