"""Shapes of the values that a line reads: of square arrays a product by elements is not the one of matrices."""

from collections.abc import Iterator, Mapping
from functools import reduce
from typing import Any, TypeAlias

from mechsheet.worksheet.lines import Formula, Given, names_read

Shape: TypeAlias = tuple[int, ...]


def shapes(row: Formula | Given, namespace: Mapping[str, Any]) -> tuple[tuple[str, Shape], ...]:
    """The names that a line reads, with the shapes of their values; none where no value is square."""
    known = tuple(_known(row, namespace))
    return known if any(is_square(shape) for _, shape in known) else ()


def is_square(shape: Shape) -> bool:
    """Whether a shape is that of a square matrix, or of several."""
    return len(shape) > 1 and shape[-2] == shape[-1] > 1


def _known(row: Formula | Given, namespace: Mapping[str, Any]) -> Iterator[tuple[str, Shape]]:
    for name in names_read(row):
        head, *parts = name.split(".")
        value = reduce(_kept, parts, namespace.get(head))
        shape = () if isinstance(value, int | float) else getattr(value, "shape", None)
        if isinstance(shape, tuple) and not (isinstance(row, Formula) and name in row.others):
            yield name, shape


def _kept(of: Any, part: str) -> Any:
    """A part of a value, if it is there: to ask for the value of a Find without a root raises."""
    return getattr(of, "__dict__", {}).get(part)
