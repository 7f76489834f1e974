"""Shapes of the values that a line reads, which tell what a product is: of matrices, of vectors, by elements."""

import ast
from collections.abc import Iterator, Mapping
from functools import reduce
from typing import Any, TypeAlias

from mechsheet.worksheet import source
from mechsheet.worksheet.lines import Formula, Given, names_read

Shape: TypeAlias = tuple[int, ...]


def shapes(row: Formula | Given, namespace: Mapping[str, Any]) -> tuple[tuple[str, Shape], ...]:
    """The names that a line reads, with the shapes of their values; none where they tell nothing of its products."""
    known = tuple(_known(row, namespace))
    return known if any(is_square(shape) for _, shape in known) or _multiplies(row) else ()


def _multiplies(row: Formula | Given) -> bool:
    parts = (*row, *dict(getattr(row, "where", ())).values())
    return any(isinstance(x, ast.MatMult) for part in parts if isinstance(part, ast.expr) for x in source.nodes(part))


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
