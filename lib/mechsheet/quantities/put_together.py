"""numpy's ``r_`` and ``c_``: what stands in square brackets put together, as rows or as columns."""

from typing import Any

import numpy as np

from mechsheet.quantities.graph import NotRecorded, current
from mechsheet.quantities.numpy_rules import arange, linspace
from mechsheet.quantities.quantity import FUNCTIONS, Quantity, has_quantity, lift


class PutTogether:
    """One of the two, of recorded numbers, arrays and slices too."""

    def __init__(self, own: Any) -> None:
        self._own = own

    def __getitem__(self, key: Any) -> Any:
        keys = key if isinstance(key, tuple) else (key,)
        if not has_quantity([_ends(each) for each in keys]):
            return self._own[key]
        if any(isinstance(each, str) for each in keys):
            raise NotRecorded("a text in numpy's r_")
        parts = [lift(current.get(), _row(each)) for each in keys]
        parts = [part if part.ndim else part.reshape(1) for part in parts]
        if self._own is np.c_:
            return FUNCTIONS[np.concatenate](
                current.get(), [part if part.ndim > 1 else part.reshape(-1, 1) for part in parts], axis=-1
            )
        return FUNCTIONS[np.concatenate](current.get(), parts)


def _ends(key: Any) -> Any:
    return [key.start, key.stop, key.step] if isinstance(key, slice) else key


def _row(key: Any) -> Quantity | Any:
    """The numbers of a slice, as many as an imaginary step says; anything else is itself."""
    if not isinstance(key, slice):
        return key
    start = 0 if key.start is None else key.start
    if isinstance(key.step, complex):
        return linspace(current.get(), start, key.stop, int(abs(key.step)))
    return arange(current.get(), start, key.stop, 1 if key.step is None else key.step)
