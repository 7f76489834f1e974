"""Arrays of which loops set elements, and lists to which they append, where the inputs say how many turns they take."""

from typing import Any

import numpy as np

from mechsheet.quantities.arithmetic import choice
from mechsheet.quantities.graph import current
from mechsheet.quantities.numpy_rules import as_many, filled
from mechsheet.quantities.quantity import Quantity, lift
from mechsheet.recording.choices import ARRAYS, NUMBERS, UNBOUND
from mechsheet.recording.each_row import every_row
from mechsheet.recording.in_place import placed
from mechsheet.recording.loops import Turns

_MOST = 20  # elements that stand in a list before


def setting(items: Any, lists: list[Any], arrays: list[Any]) -> bool:
    """Whether a loop that sets elements of arrays and lists alone has so many turns as the inputs say."""
    if not isinstance(items, Turns) or not all(isinstance(x, ARRAYS) or x is UNBOUND for x in arrays):
        return False
    if lists and not (current.get().draws and items.count.value > 0 and all(map(_is_of_numbers, lists))):
        return False  # another name of a list is found out only where something is appended now
    items.sets = True
    return True


def _is_of_numbers(values: Any) -> bool:
    """Whether something is a list of numbers, few enough to be put into an array one by one; of none nobody knows."""
    return type(values) is list and 0 < len(values) <= _MOST and all(map(_is_number, values))


def _is_number(x: Any) -> bool:
    return x.single and x.dtype != bool if isinstance(x, Quantity) else isinstance(x, NUMBERS) and type(x) is not bool


def room(values: list[Any], turns: Turns, each: int) -> Any:
    """A list as an array with room for what all turns append; what is not there yet is no number."""
    array = filled(current.get(), as_many(turns.count) * each + len(values), np.nan)
    for n, value in enumerate(values):
        array = placed(array, n, value)
    return array


def place_of(key: Any, count: Any) -> Any:
    """The place of an element of a list that has so many so far; of none that there is not."""
    if isinstance(key, int) and isinstance(count, int):
        return range(count)[key]
    place = choice(current.get(), key < 0, key + count, key) if isinstance(key, Quantity) else key + count * (key < 0)
    place = lift(current.get(), place)
    return choice(current.get(), (place >= 0) & (place < count), place, np.nan)


def in_list(array: Any) -> list[Any]:
    """The array as a list again."""
    rows = every_row(array)
    return [*array] if rows is None else rows


CALLS: dict[str, Any] = {"setting": setting, "room": room, "place_of": place_of, "in_list": in_list}
