"""What the setup of a worksheet holds that lines change in place: each run begins with it as the first one did."""

from collections import deque
from contextlib import suppress
from copy import copy
from types import CellType, FunctionType
from typing import Any

import numpy as np

_HOLDING = list, dict, set, deque


class Begun:
    """What the names of a setup hold, down to lists, dictionaries, sets and arrays, with what is first there.

    Those of its functions by default and around them, and of its classes and what is made of these, are there too: a
    dictionary in which a function keeps what it has computed would give numbers of other inputs. What a name is bound
    to stays, as what is Python's own.
    """

    def __init__(self, names: dict[str, Any] | None = None) -> None:
        names = names or {}
        self.first, module, waiting = list[tuple[Any, Any]](), names.get("__name__"), [*names.values()]
        known = {id(x): x for x in (names, names.get("__builtins__"))}
        while waiting:
            value = waiting.pop()
            if id(value) in known:
                continue
            known[id(value)] = value
            if isinstance(value, (*_HOLDING, np.ndarray)):
                self.first.append((value, copy(value)))
            if isinstance(value, (tuple, *_HOLDING)):
                waiting += value.values() if isinstance(value, dict) else value
            elif isinstance(value, CellType):
                with suppress(ValueError):  # it is empty
                    self.first.append((value, value.cell_contents))
                    waiting.append(value.cell_contents)
            elif isinstance(value, FunctionType) and value.__globals__ is names:
                waiting += [*(value.__defaults__ or ()), *(value.__kwdefaults__ or {}).values()]
                waiting += [vars(value), *(value.__closure__ or ())]
            elif isinstance(value, type) and value.__module__ == module:
                self.first.append((value, _attributes(value)))
                waiting += vars(value).values()
            elif type(value).__module__ == module:
                waiting.append(getattr(value, "__dict__", {}))

    def again(self) -> None:
        """Let all of them hold what they held at first, where a run has changed it."""
        for value, first in self.first:
            if isinstance(value, np.ndarray):
                if value.flags.writeable and value.tobytes() != first.tobytes():
                    value[...] = first
            elif isinstance(value, CellType):
                value.cell_contents = first
            elif isinstance(value, type):
                for name in _attributes(value).keys() - first.keys():
                    delattr(value, name)
                for name, own in first.items():
                    if vars(value).get(name) is not own:
                        setattr(value, name, own)
            elif _parts(value) != _parts(first):
                value.clear()
                value.update(first) if isinstance(value, dict | set) else value.extend(first)


def _attributes(kind: type) -> dict[str, Any]:
    """What a class holds under names of the worksheet's own."""
    return {name: x for name, x in vars(kind).items() if not name.startswith("__")}


def _parts(value: Any) -> list[Any]:
    """What one holds, told apart by what it is: elements may be alike that are others."""
    return [*map(id, value), *(map(id, value.values()) if isinstance(value, dict) else ())]
