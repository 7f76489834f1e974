"""Conditions of recorded quantities: all or one of several, what is none, what is one of some values."""

import builtins
import operator
from collections.abc import Callable
from functools import reduce
from types import FunctionType, GeneratorType
from typing import Any

import numpy as np

from mechsheet.quantities import perhaps
from mechsheet.quantities.arithmetic import elementwise
from mechsheet.quantities.graph import NotRecorded
from mechsheet.quantities.operations import regrouped
from mechsheet.quantities.options import is_same
from mechsheet.quantities.quantity import Quantity, has_quantity
from mechsheet.quantities.selected import Selected
from mechsheet.quantities.written import Written, seen
from mechsheet.recording.choices import ARRAYS, NUMBERS, as_condition, choice, is_condition
from mechsheet.recording.memory import may_change
from mechsheet.worksheet.chosen import Chosen


def both(*parts: FunctionType) -> Any:
    """``x and y``: of conditions whether all hold."""
    return _all(parts, True)


def any_of(*parts: FunctionType) -> Any:
    """``x or y``."""
    return _all(parts, False)


def _all(parts: tuple[FunctionType, ...], wanted: bool) -> Any:
    value = parts[0]()
    for part in parts[1:]:
        if is_condition(value):
            value = choice(value, part, _given(value)) if wanted else choice(value, _given(value), part)
        elif bool(value) is wanted:
            value = part()
        else:
            return value
    return value


def _given(value: Any) -> Any:
    return lambda: value


def negated(value: Any) -> Any:
    value = as_condition(value)
    return (
        elementwise("not")(value != 0 if value.re.value.dtype != bool else value) if is_condition(value) else not value
    )


def member(value: Any, several: Any) -> Any:
    """``value in several``: of a number, an option or a text that may be another one, the condition."""
    if isinstance(several, str):
        return seen(value) in several
    single = isinstance(value, Written | Chosen) or (isinstance(value, Quantity) and value.single)
    if not single or not isinstance(several, dict | list | tuple | set | frozenset):
        return value in several
    alike = NUMBERS | np.bool_ if isinstance(value, Quantity) else str | Written | NUMBERS | Chosen
    met = [value == each for each in several if isinstance(each, alike)]
    met += [same(value, None) for each in several if each is None]
    if not all(isinstance(each, bool | np.bool_) or is_condition(each) for each in met):
        return value in several
    return reduce(operator.or_, met, False)


def matched(value: Any) -> Any:
    """A value that is compared with True and False themselves, which no quantity is, or is matched with a pattern."""
    value = perhaps.settled(value)
    if isinstance(value, tuple | list) and has_quantity(value):
        return regrouped(value, map(matched, value))
    return bool(value) if is_condition(value) and value.re.value.dtype == bool else value


def same(x: Any, y: Any) -> Any:
    """``x is y``: of None, of objects and of conditions."""
    if y is None:
        return elementwise("not")(perhaps.some_of(x)) if isinstance(x, perhaps.Perhaps) else x is y
    if isinstance(y, bool):
        return matched(x) is y
    held, other = perhaps.itself(x), perhaps.itself(y)
    found = is_same(held, other)
    if found is None and has_quantity([held, other]):
        raise NotRecorded("whether two rows are the same one is not followed")
    found = held is other if found is None else found
    if not isinstance(x, perhaps.Perhaps) and not isinstance(y, perhaps.Perhaps):
        return found
    return (perhaps.some_of(x) & perhaps.some_of(y) & found) | (same(x, None) & same(y, None))


def some(values: Any) -> Any:
    """Python's any."""
    return _whether(values, "any", operator.or_)


def every(values: Any) -> Any:
    """Python's all."""
    return _whether(values, "all", operator.and_)


def _whether(values: Any, kind: str, fold: Callable[[Any, Any], Any]) -> Any:
    if isinstance(values, Selected) or (isinstance(values, Quantity) and values.ndim == 1):
        return (values if values.dtype == bool else values != 0).reduced(kind)
    frame = values.gi_frame if isinstance(values, GeneratorType) else None
    if frame and may_change([frame.f_code], frame.f_globals):
        return getattr(builtins, kind)(values)  # of which the last ones may not be asked for
    each = [as_condition(value) for value in values]
    if not any(map(is_condition, each)) or not all(isinstance(x, ARRAYS) for x in each):
        return getattr(builtins, kind)(each)
    return reduce(fold, (x != 0 if isinstance(x, Quantity) and x.dtype != bool else x for x in each))


CALLS: dict[str, Any] = {
    "and": both, "or": any_of, "not": negated, "same": same, "matched": matched, "member": member,
}  # fmt: skip
