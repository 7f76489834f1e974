"""What Python code can reach and change in place: lists, arrays, objects, what functions keep."""

import dis
import sys
import weakref
from collections import deque
from collections.abc import Iterable, Mapping
from functools import lru_cache
from itertools import chain
from types import (
    BuiltinFunctionType,
    CellType,
    CodeType,
    FunctionType,
    GetSetDescriptorType,
    MappingProxyType,
    MemberDescriptorType,
    ModuleType,
)
from typing import Any, NamedTuple

import numpy as np

from mechsheet.quantities.node import Node
from mechsheet.quantities.quantity import Quantity, owner
from mechsheet.recording.sifted import Sifted

_SETS = {"STORE_SUBSCR", "STORE_ATTR", "STORE_SLICE", "DELETE_SUBSCR", "DELETE_ATTR"}
_MAY_CHANGE = {*_SETS, "POP_TOP", "STORE_DEREF"}
_SETTING = {f"recorded {change}" for change in ("put", "placed", "put_where", "changed", "arranged", "outside")}
_FIELD = type(vars(NamedTuple("_Named", [("field", int)]))["field"])
_LEAVES = (
    int, float, complex, str, bytes, np.generic, np.ufunc, ModuleType, BuiltinFunctionType, range, slice, type(None),
    GetSetDescriptorType, MemberDescriptorType, property, staticmethod, classmethod, _FIELD, Node,
)  # fmt: skip
_UNCHANGED = (tuple, frozenset, FunctionType)  # though what they hold may change


class Memory:
    """All that some values reach, with what it holds now."""

    def __init__(self, values: Iterable[Any], own: Mapping[str, Any]) -> None:
        """Functions are looked into where their global names are the ``own`` ones of the worksheet."""
        self.nodes = list[Node]()  # of quantities
        self.arrays = set[int]()  # identities of arrays, of what shows elements of another one that
        self.held: dict[int, tuple[Any, list[Any] | None]] = {}  # what is held, and its parts, by the identity
        waiting = list(values)
        while waiting:
            value = waiting.pop()
            if isinstance(value, Quantity):
                self.nodes.extend(value.nodes)
                self.held[id(owner(value))] = (), []  # which nobody holds by this
                if value.ndim:
                    self.arrays.add(id(owner(value)))
            elif not (isinstance(value, _LEAVES) or id(value) in self.held or _foreign(value, own)):
                value = owner(value)
                parts = _parts(value)
                known = weakref.ref(value) if isinstance(value, np.ndarray) else value  # which may have one name alone
                self.held[id(value)] = (known, parts)
                if isinstance(value, np.ndarray):
                    self.arrays.add(id(value))
                waiting += parts or ()

    def mutable(self) -> set[int]:
        """Identities of what can be changed in place."""
        return {key for key, (value, _) in self.held.items() if not _is_fixed(value)}

    def changed(self) -> set[int]:
        """Identities of what is not as it was; what nobody can look into may always be."""
        return {
            key for key, (value, parts) in self.held.items() if not _is_fixed(value) and not _as_it_was(value, parts)
        }

    @staticmethod
    def named(names: Mapping[str, Any], objects: set[int]) -> set[str]:
        """Names of values that reach one of some objects."""
        if not objects:
            return set()
        return {name for name, value in names.items() if not objects.isdisjoint(Memory([value], names).held)}

    @staticmethod
    def sharing(names: Mapping[str, Any], others: Iterable[Any]) -> set[str]:
        """Names of values that reach an array which some others reach: they change with it."""
        return Memory.named(names, Memory(others, names).arrays)


def sets_of_others(codes: Iterable[CodeType]) -> bool:
    """Whether functions may set elements of arrays that are not their own."""
    return any(not _SETTING.isdisjoint(names_of(code)) for code in codes)


def _is_fixed(value: Any) -> bool:
    own = type(value).__module__.startswith("mechsheet.") and not isinstance(value, Sifted)
    return own or isinstance(value, _UNCHANGED)


def _foreign(value: Any, own: Mapping[str, Any]) -> bool:
    """Functions and classes that are none of the worksheet's own."""
    if isinstance(value, FunctionType):
        return value.__globals__ is not own
    return isinstance(value, type) and value.__module__ in sys.modules


def _parts(value: Any) -> list[Any] | None:
    """What a value holds now, in a form that does not change with it; None where nobody can look into it."""
    match value:
        case Sifted():
            return value.held()
        case list() | tuple() | deque() | set() | frozenset():
            return list(value)
        case dict() | MappingProxyType():
            return [*value, *value.values()]
        case np.ndarray():
            return (
                value.ravel().tolist()
                if value.dtype == object
                else [f"{value.dtype}{value.shape}".encode() + value.tobytes()]
            )
        case CellType():
            return _content(value)
        case FunctionType():
            return [*(value.__closure__ or ()), *(value.__defaults__ or ()), *(value.__kwdefaults__ or {}).values()]
    slots = getattr(type(value), "__slots__", None)
    if hasattr(value, "__next__") or not (slots or hasattr(value, "__dict__")):
        return None
    held = (name for name in slots or () if isinstance(getattr(type(value), name, None), MemberDescriptorType))
    return [*getattr(value, "__dict__", {}).values(), *(getattr(value, name, None) for name in held)]  # not computed


def _content(cell: CellType) -> list[Any]:
    try:
        return [cell.cell_contents]
    except ValueError:  # it is empty
        return []


def _as_it_was(value: Any, parts: list[Any] | None) -> bool:
    if isinstance(value, weakref.ref):
        value = value()
        if value is None:  # nobody reaches it any more
            return True
    now = _parts(value)
    if parts is None or now is None or len(parts) != len(now):
        return False
    return all(a is b or (isinstance(a, bytes) and a == b) for a, b in zip(parts, now, strict=True))


@lru_cache(maxsize=4096)
def names_of(code: CodeType) -> tuple[str, ...]:
    """Names that a piece of code reads, but for those of its own."""
    inside = (names_of(constant) for constant in code.co_consts if isinstance(constant, CodeType))
    return tuple(dict.fromkeys(chain(code.co_names, *inside)))


@lru_cache(maxsize=4096)
def shared_by(code: CodeType) -> frozenset[str]:
    """Names of the worksheet that a function reads: neither its own nor attributes of something that are called so."""
    inside = (shared_by(constant) for constant in code.co_consts if isinstance(constant, CodeType))
    own = {i.argval for i in dis.get_instructions(code) if i.opname in ("LOAD_GLOBAL", "LOAD_NAME")}
    return frozenset(own.union(*inside))


def operations(code: CodeType) -> set[str]:
    """Operations of a piece of code by name, without those of functions in it: quicker than to take it apart."""
    return {dis.opname[each] for each in set(code.co_code[::2])}


@lru_cache(maxsize=4096)
def changes(code: CodeType) -> bool:
    """Whether code, or a function in it, may change something in place: it sets a part, or calls for no value."""
    last, does = "", operations(code)
    for instruction in dis.get_instructions(code) if not does.isdisjoint(_MAY_CHANGE) else ():
        if instruction.opname in _SETS or (instruction.opname == "POP_TOP" and last.startswith("CALL")):
            return True
        if instruction.opname == "STORE_DEREF" and instruction.argval in code.co_freevars:
            return True
        last = instruction.opname
    return any(changes(constant) for constant in code.co_consts if isinstance(constant, CodeType))


def may_change(codes: Iterable[CodeType], own: Mapping[str, Any]) -> bool:
    """Whether some code, or a function of the worksheet that it names, may change something in place."""
    waiting, seen = list(codes), set[CodeType]()
    while waiting:
        code = waiting.pop()
        if code in seen:
            continue
        seen.add(code)
        if changes(code):
            return True
        named = (own.get(name) for name in names_of(code))
        waiting += [f.__code__ for f in named if isinstance(f, FunctionType) and f.__globals__ is own]
    return False
