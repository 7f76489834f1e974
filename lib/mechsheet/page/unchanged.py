"""What was made of a value is kept while values like it come again: an input changes a part of a document's numbers."""

from collections.abc import Callable, Hashable
from dataclasses import fields, is_dataclass
from functools import lru_cache, wraps
from typing import Any, TypeVar

import numpy as np

from mechsheet import units

T = TypeVar("T")


class _Whole:
    """A value that equals another one where all that is in it does: arrays by their bytes, 0 and -0 are not alike."""

    def __init__(self, value: Any) -> None:
        self.value, self._content = value, _content(value)
        self._hash = hash(self._content)

    def __hash__(self) -> int:
        return self._hash

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Whole) and self._content == other._content


def kept(count: int) -> Callable[[Callable[[T], str]], Callable[[T], str]]:
    """Keep the ``count`` texts last made of values that hold data alone: no functions, and no state of a page."""

    def decorated(made: Callable[[T], str]) -> Callable[[T], str]:
        of_whole = lru_cache(count)(lambda whole: made(whole.value))

        @wraps(made)
        def same(value: T) -> str:
            try:
                whole = _Whole(value)
            except TypeError:  # it holds something else
                return made(value)
            return of_whole(whole)

        return same

    return decorated


def _content(value: Any) -> Hashable:
    if isinstance(value, np.ndarray):
        return (_content(value.tolist()),) if value.dtype.hasobject else (value.tobytes(), value.dtype, value.shape)
    named = [field.name for field in fields(value)] if is_dataclass(value) else getattr(value, "_fields", ())
    if named:
        known = ((name, getattr(value, name)) for name in named)
        return (type(value), *(_unit(each) if name == "unit" else _content(each) for name, each in known))
    if isinstance(value, list | tuple):
        return (type(value), *map(_content, value))
    if isinstance(value, float | complex):
        return (type(value), np.asarray(value).tobytes())
    if value is None or isinstance(value, str | int | bool | np.generic):
        return (type(value), value)
    raise TypeError(type(value).__name__)


def _unit(text: str) -> Hashable:
    """A unit with what it measures, which one's own may change; what is counted, in words, has none."""
    return text, units.known(text)
