"""Operators of a quantity: those of numpy, but for what is as often as it says."""

from typing import Any

from numpy.lib.mixins import NDArrayOperatorsMixin


class Operators(NDArrayOperatorsMixin):
    """Numpy's operators; a list, a tuple or a text times a number is that so many times, which Python looks at."""

    __slots__ = ()

    @property
    def ndim(self) -> int:
        raise NotImplementedError

    def __index__(self) -> int:
        raise NotImplementedError

    def __mul__(self, other: Any) -> Any:
        return other * self.__index__() if self._counts(other) else super().__mul__(other)

    def __rmul__(self, other: Any) -> Any:
        return other * self.__index__() if self._counts(other) else super().__rmul__(other)

    def _counts(self, other: Any) -> bool:
        return isinstance(other, list | tuple | str) and self.ndim == 0
