"""The operations of a recording in numpy: what their numbers are, and how elements are moved and reduced."""

import pickle
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import cached_property
from operator import getitem
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

Values = NDArray[Any]


def _number(f: Callable[..., Values]) -> Callable[..., Values]:
    """Arithmetic in which a condition counts as 1 or 0."""
    return lambda *args: f(*[a + 0 if a.dtype == bool else a for a in args])


def is_double(dtype: np.dtype[Any]) -> bool:
    """Whether numbers of a kind are those that recordings have: others are rounded, cut or run over elsewhere."""
    return dtype.kind == "b" or dtype in (np.float64, np.complex128, np.int64)


# What the numbers of an operation are: the reference for all other readers.
ELEMENTWISE: dict[str, Callable[..., Values]] = {
    "add": _number(np.add), "sub": _number(np.subtract), "mul": _number(np.multiply), "div": np.true_divide,
    "neg": np.negative, "pow": lambda a, b: np.power(np.asarray(a, float), b), "abs": np.abs, "sqrt": np.sqrt,
    "exp": np.exp, "log": np.log, "sin": np.sin, "cos": np.cos, "tan": np.tan, "asin": np.arcsin, "acos": np.arccos,
    "atan2": np.arctan2, "sign": np.sign, "floor": np.floor, "round": np.round, "mod": np.remainder, "max": np.maximum,
    "min": np.minimum, "where": np.where, "lt": np.less, "le": np.less_equal, "gt": np.greater,
    "ge": np.greater_equal, "eq": np.equal, "ne": np.not_equal, "and": np.logical_and, "or": np.logical_or,
    "not": np.logical_not, "finite": np.isfinite,
    "like": lambda a, *b: np.broadcast_arrays(a, *b)[0],  # in the shape that it has together with another one
    "sized": lambda a, same: np.where(same, a, np.nan),  # while lengths are the same
}  # fmt: skip
COMPARISONS = np.less, np.less_equal, np.greater, np.greater_equal, np.equal, np.not_equal
OF_TRUTH = frozenset((  # which are true or false of what is no number too
    *COMPARISONS, np.logical_and, np.logical_or, np.logical_xor, np.bitwise_and, np.bitwise_or, np.bitwise_xor,
))  # fmt: skip
SHAPED = ("like", "sized")  # whose further operands give the shape alone
REDUCE: dict[str, Callable[..., Any]] = {
    "max": np.max, "min": np.min, "sum": np.sum, "prod": np.prod, "any": np.any, "all": np.all, "argmax": np.argmax,
    "argmin": np.argmin, "nanmax": np.fmax.reduce, "nanmin": np.fmin.reduce, "nansum": np.nansum,
}  # fmt: skip
REDUCE_SO_FAR = {"sum": np.add, "prod": np.multiply, "max": np.maximum, "min": np.minimum, "all": np.logical_and}


@dataclass(frozen=True)
class Moved:
    """What numpy's function that only moves elements does, with whatever it is given beside them."""

    f: Callable[..., Any]
    args: tuple[Any, ...] = ()
    named: tuple[tuple[str, Any], ...] = ()

    def __call__(self, elements: Any) -> Any:
        return self.f(elements, *self.args, **dict(self.named))

    @cached_property
    def key(self) -> bytes:
        return pickle.dumps((self.f, self.args, self.named))

    def shown(self, places: Values, alone: bool) -> Values | None:
        """Places of elements that the array has which numpy gives; None where it may be a copy, by how the other lies.

        One of one axis that shows no other one lies in one piece.
        """
        return places if alone or self.f not in (np.ravel, np.reshape) else None

    def keeps(self, axes: int) -> bool:
        """Whether a quantity of so many axes stays as it is, however long they are."""
        if self.f is getitem:
            keys = self.args[0] if isinstance(self.args[0], tuple) else self.args
            return all(key is Ellipsis or (isinstance(key, slice) and key == slice(None)) for key in keys)
        if self.f is np.reshape:
            return axes == 1 and self.args in ((-1,), ((-1,),))
        return axes >= _KEPT_FROM.get(self.f, axes + 1) and (self.f is not np.ravel or axes == 1)

    def along(self, axes: int) -> tuple[int, bool] | None:
        """The axis along which parts are put together, counted from the last one, and whether it is a new one."""
        if self.args or self.f not in (np.stack, np.concatenate):
            return None
        return dict(self.named).get("axis", 0) % axes - axes, self.f is np.stack

    def origin(self, axis: int, axes: int) -> "Origin | None":
        """What an axis of the elements that an index picks out of so many axes shows; None where nobody tells."""
        every = _every(self, axes)
        if every is None:
            return None
        numbers = iter(range(-axes, 0))
        numbered = [(None if k is None else next(numbers), k) for k in every]
        number, key = [(n, k) for n, k in numbered if type(k) is not int][axis]
        return Origin(number, _left_out(key))

    def picked(self, stack: "Moved", axes: int) -> tuple[int, tuple["Moved", ...]] | None:
        """The number of the quantity in a stack of so many axes at which an index points, and what it picks of that."""
        whole = _every(self, axes)
        if whole is None or None in whole or stack.f is not np.stack:
            return None
        axis = dict(stack.named).get("axis", 0) % axes
        if not isinstance(number := whole[axis], int):
            return None
        further = Moved(getitem, ((*whole[:axis], *whole[axis + 1 :]),))
        return number, () if further.keeps(axes - 1) else (further,)


_KEPT_FROM: dict[Any, int] = {np.ravel: 1, np.atleast_1d: 1, np.atleast_2d: 2}  # functions, by the number of axes


class Origin(NamedTuple):
    """The axis that an axis shows, counted from the last one; none of a new one.

    And how many it leaves out, where these are as many for any length.
    """

    axis: int | None
    left_out: int | None


def _left_out(key: Any) -> int | None:
    if not isinstance(key, slice) or key.step not in (None, 1, -1):
        return None
    start, stop = key.start or 0, key.stop or 0
    if key.step == -1:
        return 0 if key.start is key.stop is None else None
    kept = type(start) is int and type(stop) is int and start >= 0 >= stop and key.stop != 0
    return start - stop if kept else None


class Along(NamedTuple):
    """How a quantity is reduced: along an axis or in all, or up to each element."""

    axis: int | None
    keepdims: bool = False
    so_far: bool = False

    def shows(self, axis: int, axes: int) -> int | None:
        """Which of so many axes an axis of the result shows, both counted from the last one; None where none."""
        if self.so_far:
            return axis
        if self.axis is None:
            return None
        reduced = self.axis - axes
        if self.keepdims:
            return axis if axis != reduced else None
        return axis if axis > reduced else axis - 1


def regrouped(value: Any, parts: Iterable[Any]) -> Any:
    """Parts in a list, or in a tuple with the names of ``value``: Python's own, and no list of the recording's."""
    if isinstance(value, list):
        return [*parts]
    return value._make(parts) if hasattr(value, "_make") else tuple(parts)


def _every(moved: Moved, axes: int) -> tuple[Any, ...] | None:
    """The numbers, slices and new axes of an index, for every axis; None where it is not of these alone."""
    if moved.f is not getitem:
        return None
    key = moved.args[0] if isinstance(moved.args[0], tuple) else moved.args
    if not all(type(k) is int or isinstance(k, slice) or k is Ellipsis or k is None for k in key):
        return None
    at = key.index(Ellipsis) if Ellipsis in key else len(key)
    left = axes - sum(k is not None and k is not Ellipsis for k in key)
    return (*key[:at], *[slice(None)] * left, *key[at + 1 :])
