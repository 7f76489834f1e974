"""What the setup of a worksheet holds that lines change in place: each run begins with it as the first one did."""

from collections import deque
from collections.abc import Iterable
from copy import copy
from types import FunctionType
from typing import Any

import numpy as np

_HOLDING = list, dict, set, deque


class Begun:
    """Lists, dictionaries, sets and arrays, those in these and of functions by default too, with what they first hold.

    A dictionary in which a function keeps what it has computed would give numbers of other inputs.
    """

    def __init__(self, values: Iterable[Any] = ()) -> None:
        self.first = dict[int, tuple[Any, Any]]()
        waiting = list(values)
        while waiting:
            value = waiting.pop()
            if id(value) in self.first:
                continue
            if isinstance(value, (*_HOLDING, np.ndarray)):
                self.first[id(value)] = value, copy(value)
            if isinstance(value, (tuple, *_HOLDING)):
                waiting += value.values() if isinstance(value, dict) else value
            if isinstance(value, FunctionType):
                waiting += [*(value.__defaults__ or ()), *(value.__kwdefaults__ or {}).values()]

    def again(self) -> None:
        """Let all of them hold what they held at first, where a run has changed it."""
        for value, first in self.first.values():
            if isinstance(value, np.ndarray):
                if value.flags.writeable and value.tobytes() != first.tobytes():
                    value[...] = first
            elif _parts(value) != _parts(first):
                value.clear()
                value.update(first) if isinstance(value, dict | set) else value.extend(first)


def _parts(value: Any) -> list[Any]:
    """What one holds, told apart by what it is: elements may be alike that are others."""
    return [*map(id, value), *(map(id, value.values()) if isinstance(value, dict) else ())]
