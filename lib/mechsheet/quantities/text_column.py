"""A column of texts as a recording has it: of those among the inputs is known whether each is the exported one.

Those that numbers choose are known by which one of several each is.
"""

from collections.abc import Iterator, Sequence
from functools import reduce
from operator import index, or_
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mechsheet.quantities.arithmetic import choice
from mechsheet.quantities.graph import Graph
from mechsheet.quantities.quantity import Quantity, lift, stack
from mechsheet.quantities.written import Either, Number, OneOf, Written
from mechsheet.worksheet.table import as_texts

_MOST, _LONG = 250, 4000  # texts, and their signs, in the formula of a cell
_SAID = 100  # rows of texts with numbers in them, each of which has a formula of its own
Among = tuple[tuple[str, ...], Quantity]  # texts, and which one each is


class Texts:
    """Texts of the column of that ``name``, those of the rows ``at``: one is `Written`, at all of them Python looks.

    The ``column`` is 0 where a text is the exported one, else 1; there is none of texts that are no inputs, of which
    those ``at`` numbers are chosen.
    """

    ndim, base = 1, None
    __hash__ = None  # type: ignore[assignment]  # as of an array

    def __init__(self, name: str, column: Quantity | None, texts: tuple[Any, ...], at: Quantity) -> None:
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
    def dtype(self) -> np.dtype[Any]:
        return np.dtype(object) if self.column is not None else np.array(self.texts).dtype

    @property
    def shape(self) -> tuple[Any, ...]:
        return self.at.shape

    @property
    def size(self) -> Any:
        return self.at.size

    @property
    def same(self) -> Quantity:
        """Where a text is the exported one 0, else 1: what stands in a table for it."""
        return self.at if self.column is None else self.column[self.at]

    @property
    def now(self) -> list[str]:
        """The texts with the present numbers, of which nothing is noted."""
        return [self.texts[int(k)] for k in self.at.value.flat]

    def seen(self) -> NDArray[Any]:
        """The texts for Python to look at; a guard tells while they are the same."""
        rows = self.at.seen()
        if self.column is not None:
            self.at.graph.read(self.same.re)
        return np.array([self.texts[int(k)] for k in rows], self.dtype)

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
        if self.column is None and isinstance(other, str):
            return reduce(or_, (self.at == k for k, text in enumerate(self.texts) if text == other), self.at != self.at)
        return self.seen() == (other.seen() if isinstance(other, Texts) else _plain(other))

    def __ne__(self, other: object) -> Any:
        same = self == other
        return same == 0 if isinstance(same, Quantity) else ~same

    def __contains__(self, text: object) -> bool:
        return bool((self == text).any())


class Said(Texts):
    """Texts with numbers in them, one for each row of a table; there is none where a number is none."""

    def __init__(self, graph: Graph, texts: Sequence[str | Written]) -> None:
        super().__init__("", None, tuple(texts), lift(graph, np.arange(len(texts))))
        self.known = stack([lift(graph, choice(graph, _exists(graph, text), 0.0, np.nan)) for text in texts])

    @property
    def same(self) -> Quantity:
        return self.known


def _plain(text: object) -> object:
    return str(text) if isinstance(text, Written) else text


def among(graph: Graph, value: Any) -> Among | None:
    """Texts that are no inputs, and which one of them a text is, or each of a list; None of anything else."""
    match value:
        case str():
            return (value,), lift(graph, 0)
        case Texts(column=None) | OneOf(column=None):
            return value.texts, value.at
        case Either(holds, then, otherwise):
            return _either(graph, holds, among(graph, then), among(graph, otherwise))
        case Written(parts):
            nothing: Among | None = (("",), lift(graph, 0))
            return reduce(_in_a_row, (among(graph, part) for part in parts), nothing)
        case list() | tuple() if value and any(isinstance(each, Written) for each in value):
            return _listed([among(graph, each) for each in value])
        case list() | tuple() if any(isinstance(each, Quantity) for each in value):
            return None
        case list() | tuple() | np.ndarray() if (own := as_texts(value)) is not None and own.ndim == 1:
            return tuple(own.tolist()), lift(graph, np.arange(own.size))
    return None


def chosen(graph: Graph, condition: Any, x: Any, y: Any) -> Any:
    """Elements of ``x`` where the condition holds, else of ``y``, which may be texts."""
    if isinstance(condition, Quantity) and condition.ndim == 1:
        sides = [among(graph, each) if not isinstance(each, Quantity) else None for each in (x, y)]
        if (found := _either(graph, condition, *sides)) is not None:
            return Texts("", None, *found)
    return choice(graph, condition, x, y)


def chosen_among(graph: Graph, values: Any) -> Texts | None:
    """A list of texts that numbers choose as a column; None of any other."""
    if isinstance(values, Texts):
        return values
    words = type(values) in (list, tuple) and any(isinstance(each, Written) for each in values)
    found = among(graph, values) if words else None
    return found and Texts("", None, *found)


def held_in(graph: Graph, values: NDArray[Any], many: bool) -> Any:
    """An array as a quantity or, where ``many`` are taken of it, as texts; None of any other."""
    if values.dtype.kind in "biufc":
        return lift(graph, values)
    found = among(graph, values) if many else None
    return found and Texts("", None, *found)


def shown(graph: Graph, column: Any) -> Any:
    """What a table shows as a column, of texts these; of more than a cell can write Python sees which they are."""
    if isinstance(column, Texts) and column.column is not None:
        return column
    found = None if isinstance(column, Quantity | str | Written) else among(graph, column)
    if found is None:
        words = isinstance(column, list | tuple) and any(isinstance(each, Written) for each in column)
        if words and graph.thin == 1 and len(column) <= _SAID and all(isinstance(x, str | Written) for x in column):
            return Said(graph, column)
        return shown(graph, [*map(str, column)]) if words else column
    if found[1].re.op != "constant" and (len(found[0]) > _MOST or sum(map(len, found[0])) > _LONG):
        return shown(graph, Texts("", None, *found).seen())
    return Texts("", None, *found)


def _exists(graph: Graph, text: str | Written) -> Any:
    """Whether there are all numbers that stand in a text."""
    holds: Any = True
    for part in text.parts if isinstance(text, Written) else ():
        match part:
            case Number(value):
                holds = holds & np.isfinite(value)
            case OneOf(at):
                holds = holds & np.isfinite(at)
            case Either(first, then, otherwise):
                holds = holds & choice(graph, first, _exists(graph, then), _exists(graph, otherwise))
    return holds


def _either(graph: Graph, holds: Quantity, x: Among | None, y: Among | None) -> Among | None:
    if x is None or y is None:
        return None
    return (*x[0], *y[0]), choice(graph, holds, x[1], y[1] + len(x[0]))


def _in_a_row(x: Among | None, y: Among | None) -> Among | None:
    """Each text of the ones before each of the others."""
    if x is None or y is None or len(x[0]) * len(y[0]) > _MOST:
        return None
    return tuple(a + b for a in x[0] for b in y[0]), x[1] * len(y[0]) + y[1]


def _listed(each: Sequence[Among | None]) -> Among | None:
    texts, first, places = tuple[str, ...](), dict[tuple[str, ...], int](), list[Quantity]()
    for found in each:
        if found is None:
            return None
        if found[0] not in first:
            first[found[0]] = len(texts)
            texts += found[0]
        places.append(found[1] + first[found[0]])
    return texts, stack(places)
