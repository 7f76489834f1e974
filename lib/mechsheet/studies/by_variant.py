"""Results of a chunk of variants: each has a row of its own, a number or a field over the positions."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mechsheet.worksheet.errors import SheetError
from mechsheet.worksheet.numbers import existing

_ALIKE = 1e-9  # of the greatest value: a variant among others and alone differ by rounding


@dataclass(frozen=True)
class Part:
    """Results of one chunk, variants on the leading axis, which variants lack a value, and the units."""

    values: dict[str, NDArray[Any]]
    lacking: NDArray[np.bool_]
    units: dict[str, str]


def joined(parts: Sequence[Part]) -> Part:
    """Parts one after the other; NaN for the values that some of them do not have."""
    like = {name: value for part in parts for name, value in part.values.items()}
    values = {}
    for name, value in like.items():
        for part in parts:
            same_shape(name, value, part.values.get(name, value))
        empty = (np.full((part.lacking.size, *value.shape[1:]), np.nan, value.dtype) for part in parts)
        values[name] = np.concatenate([part.values.get(name, e) for part, e in zip(parts, empty, strict=True)])
    lacking = np.concatenate([part.lacking for part in parts])
    return Part(values, lacking, {name: unit for part in parts for name, unit in part.units.items()})


def by_variant(value: Any, among: int | None) -> NDArray[Any]:
    """Values of each of so many variants in a row of its own, or of one alone, which may have several axes."""
    if among is None:
        return np.reshape(value, (1, -1))
    value = np.atleast_2d(value)
    return value if len(value) == among else np.broadcast_to(value, (among, value.shape[1]))


def told(verdict: Any, among: int | None) -> NDArray[Any]:
    """The same of what is told of each variant, which a single number that a Find found has no further axis for."""
    found = np.asarray(verdict)
    return by_variant(found[:, None] if found.shape == (among,) else found, among)


def array(held: Any) -> NDArray[Any]:
    """What a name holds as an array, of a whole number of any length too; of none for a list of unlike parts."""
    try:
        held = existing(held)
        return np.asarray(float(held) if type(held) is int else held)
    except (ValueError, OverflowError):
        return np.asarray(None)


def result(name: str, value: Any, among: int | None, one_row: bool = False) -> NDArray[Any]:
    """A result of each variant; ``among`` so many variants it is a number or a field.

    Of one alone an array of one is a number, unless a list or a table has ``one_row``, whose axis it may be.
    """
    found: NDArray[Any] = np.asarray(value)
    found = found.astype(complex if found.dtype.kind == "c" else float, copy=False)
    if among is None:
        return of_each(found[None], one_row)
    if not fits(found, among):
        raise TypeError(f"{name} of shape {found.shape} has no axis of {among} variants")
    rows = by_variant(found, among)
    return rows[:, 0] if found.ndim == 0 or found.shape[1:] == (1,) else rows


def of_each(values: NDArray[Any], one_row: bool) -> NDArray[Any]:
    return values[:, 0] if values.shape[1:] == (1,) and not one_row else values


def fits(value: NDArray[Any], among: int | None) -> bool:
    """Whether a value is a number or a field, for each of the variants or for all of them."""
    return among is None or value.ndim < 2 or (value.ndim == 2 and len(value) in (1, among))


def lacks(value: NDArray[Any]) -> NDArray[np.bool_]:
    """Which variants have NaN anywhere in this result."""
    if np.isfinite(value.sum()):  # a fifth of the time of looking at every element
        return np.zeros(len(value), dtype=bool)
    return np.asarray(np.isnan(value).reshape(len(value), -1).any(1), dtype=bool)


def alike(a: NDArray[Any], b: NDArray[Any]) -> bool:
    """Whether all variants have the same but for rounding."""
    own = tuple(range(1, a.ndim))
    size = np.max(np.abs(a), axis=own, keepdims=True, initial=0.0, where=np.isfinite(a))
    return a.shape == b.shape and np.allclose(b, a, rtol=0, atol=_ALIKE * size, equal_nan=True)


def same_shape(name: str, a: NDArray[Any], b: NDArray[Any]) -> None:
    if a.shape[1:] != b.shape[1:]:
        raise SheetError(f"{name} has shape {a.shape[1:]} in one variant and {b.shape[1:]} in another")
