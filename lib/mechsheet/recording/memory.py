"""What Python code can reach and change in place: lists, arrays, objects, what functions keep."""

import builtins
import dataclasses
import dis
import gc
import pickle
import sys
import weakref
from collections import deque
from collections.abc import Callable, ItemsView, Iterable, Iterator, KeysView, Mapping, ValuesView
from functools import lru_cache, partial
from itertools import chain
from types import (
    BuiltinFunctionType,
    CellType,
    CodeType,
    FunctionType,
    GetSetDescriptorType,
    MappingProxyType,
    MemberDescriptorType,
    MethodType,
    ModuleType,
)
from typing import Any, NamedTuple

import numpy as np

from mechsheet.quantities.graph import current
from mechsheet.quantities.node import Node
from mechsheet.quantities.of_lists import OneOfLists
from mechsheet.quantities.quantity import Quantity, owner
from mechsheet.recording.sifted import Sifted

_ELEMENTS = {"STORE_SUBSCR", "STORE_SLICE"}
_SETS = {*_ELEMENTS, "STORE_ATTR", "DELETE_SUBSCR", "DELETE_ATTR"}
_MAY_CHANGE = {*_SETS, "POP_TOP", "STORE_DEREF"}
_METHODS = {  # which change what they are called of, in the middle of an expression too
    "append", "appendleft", "extend", "insert", "pop", "popleft", "popitem", "setdefault", "update", "remove",
    "discard", "clear", "__setitem__",
}  # fmt: skip
_SETTING = {
    *("recorded put", "recorded placed", "recorded put_where", "recorded changed", "recorded arranged"),
    *("recorded filled", "recorded outside", "recorded put_back"),
}
_SETTING_HELD = {f"recorded {change}" for change in ("put_held", "changed_held")}
_FIELD = type(vars(NamedTuple("_Named", [("field", int)]))["field"])
_LEAVES = (
    int, float, complex, str, bytes, np.generic, np.ufunc, ModuleType, range, type(None), GetSetDescriptorType,
    MemberDescriptorType, type(dataclasses.MISSING), _FIELD, Node,
)  # fmt: skip
# Leaves by their very type, which one look tells: most of what stands in lists.
_PLAIN = {int, float, complex, bool, str, bytes, np.float64, np.int64, np.bool_, ModuleType, type(None), Node}
_SEEN = {list, tuple, dict, set, frozenset, deque, np.ndarray, CellType, FunctionType, type}  # of parts alone
_UNCHANGED = (  # though what they hold may change
    tuple, frozenset, slice, FunctionType, BuiltinFunctionType, MethodType, partial, property, staticmethod,
    classmethod,
)  # fmt: skip
_MAPPINGS = (dict, MappingProxyType, getattr(builtins, "frozendict", dict))  # the last from Python 3.15 on


class Memory:
    """All that some values reach, with what it holds now."""

    def __init__(self, values: Iterable[Any], own: Mapping[str, Any]) -> None:
        """Functions are looked into where their global names are the ``own`` ones of the worksheet."""
        self.nodes = list[Node]()  # of quantities
        self.functions = list[FunctionType]()  # of the worksheet
        self.arrays = set[int]()  # identities of arrays, of what shows elements of another one that
        self.held: dict[int, tuple[Any, list[Any] | None]] = {}  # what is held, and its parts, by the identity
        self._beneath: dict[int, Any] = {}  # what nobody compares: it stands in what only its own code looks into
        self._own = own
        current.get().meant.memories.add(self)
        self.add(values)

    def add(self, values: Iterable[Any]) -> None:
        """Look at some values too."""
        for value, hidden, parts in _reached(values, self._own, self.held, self._beneath, _parts):
            if isinstance(value, Quantity):
                self.nodes.extend(value.nodes)
                self.held[id(value)] = (), []  # which nobody holds by this
                if value.ndim:
                    self.arrays.update(map(id, (value, *either_of(value))))
                continue
            if isinstance(value, np.ndarray):
                self.arrays.add(id(value))
            if isinstance(value, FunctionType):
                self.functions.append(value)
            if not hidden:
                known = weakref.ref(value) if isinstance(value, np.ndarray) else value  # which may have one name alone
                self.held[id(value)] = known, parts

    def values(self) -> list[Any]:
        """What is held, but for arrays."""
        return [value for value, _ in self.held.values() if not isinstance(value, weakref.ref)]

    def containers(self) -> set[int]:
        """Identities of lists, dictionaries, sets and objects, but for parts of what the library has made."""
        made = (part for value, parts in self.held.values() if _of_this(value) for part in parts or ())
        return {key for key, (value, _) in self.held.items() if _holds(value)} - Memory(made, self._own).held.keys()

    def holding(self) -> Iterator[int]:
        """Identities of what is held here, each as often as it is."""
        for value, parts in self.held.values():
            yield id(value)
            yield from map(id, parts or ())

    def follow(self) -> None:
        """Look at what the functions among the values read as well, which they may change."""
        known = 0
        while known < len(self.functions):
            new, known = self.functions[known:], len(self.functions)
            self.add(self._own[name] for f in new for name in shared_by(f.__code__) if name in self._own)

    def mutable(self) -> set[int]:
        """Identities of what can be changed in place."""
        return {key for key, (value, _) in self.held.items() if not _is_fixed(value)}

    def changed(self) -> set[int]:
        """Identities of what is not as it was; what nobody can look into may always be."""
        return {
            key for key, (value, parts) in self.held.items() if not _is_fixed(value) and not _as_it_was(value, parts)
        }

    def others(self, changed: set[int]) -> set[int]:
        """Identities of what would have changed for other inputs instead of what Python has looked for."""
        known = current.get().meant.taken
        return Memory([[*known[key][1].values()] for key in changed & known.keys()], self._own).mutable()

    @staticmethod
    def named(names: Mapping[str, Any], objects: set[int]) -> set[str]:
        """Names of values that reach one of some objects."""
        found, held, beneath = set[str](), dict[int, Any](), dict[int, Any]()
        for name, value in names.items() if objects else ():
            if name == "__builtins__" or type(value) in _PLAIN:
                continue
            known = len(held), len(beneath)
            for part, hidden, _ in _reached([value], names, held, beneath, _inside):
                of_array = isinstance(part, np.ndarray | Quantity)
                same = [part, *either_of(part)] if of_array else [part]
                if (not hidden or of_array) and not objects.isdisjoint(map(id, same)):
                    found.add(name)
                    for seen, count in zip((held, beneath), known, strict=True):  # it reaches one, its parts may too
                        while len(seen) > count:
                            seen.popitem()
                    break
        return found

    @staticmethod
    def sharing(names: Mapping[str, Any], others: Iterable[Any]) -> set[str]:
        """Names of values that reach an array which some others reach: they change with it."""
        return Memory.named(names, Memory(others, names).arrays)


def either_of(array: Any) -> list[Any]:
    """The arrays of which a condition tells which one an array is, and those whose elements these show."""
    return list(getattr(owner(array), "ways", ()))


def one_of(made: Any, *ways: Any) -> Any:
    """What stands for one of some arrays or lists, and knows them: who changes one changes the other."""
    arrays = (way for way in ways if isinstance(way, list) or (isinstance(way, np.ndarray | Quantity) and way.ndim))
    known = [*map(owner, arrays)]
    if known and np.ndim(made):
        made.ways = [each for way in known for each in (way, *either_of(way))]
    return made


def taken(value: Any, *ways: Any) -> Any:
    """What Python has looked for, and took out of what would give another one for other inputs."""
    if not isinstance(value, _LEAVES):
        known = current.get().meant.taken
        for key, (each, _) in Memory([value], {}).held.items():
            if not _is_fixed(each) and not isinstance(each, weakref.ref):
                known.setdefault(key, (each, {}))[1].update((id(way), way) for way in ways)
    return value


def _reached(
    values: Iterable[Any],
    own: Mapping[str, Any],
    held: dict[int, Any],
    beneath: dict[int, Any],
    parts_of: Callable[[Any], list[Any] | None],
) -> Iterator[tuple[Any, bool, list[Any] | None]]:
    """What values reach, whether only its own code looks into it, and its parts.

    Not what is ``held`` already or, of what only its own code looks into, ``beneath``; by its identity it is added.
    """
    waiting, others = _to_look_at(values, hidden=False), current.get().meant.taken
    while waiting:
        value, hidden = waiting.pop()
        if isinstance(value, Quantity | np.ndarray):
            shows, value = value, owner(value)
            if isinstance(shows, Quantity) and shows is not value:  # which rests on the places of its elements too
                yield shows, hidden, None
        if isinstance(value, Quantity):
            yield value, hidden, None
            continue
        seen = beneath if hidden else held
        if isinstance(value, _LEAVES) or id(value) in seen:
            if isinstance(value, np.ufunc):  # of numpy's frompyfunc
                waiting += _to_look_at(filter(callable, gc.get_referents(value)), hidden)
            continue
        if _foreign(value, own):
            waiting += _to_look_at(_kept(value, own), hidden=True)
            continue
        parts, seen[id(value)] = parts_of(value), None
        yield value, hidden, parts
        waiting += _to_look_at(parts or (), hidden)
        if id(value) in others:
            waiting += _to_look_at(others[id(value)][1].values(), hidden)
        waiting += _to_look_at(_hidden(value), hidden or not _is_live(value))


def _is_live(value: Any) -> bool:
    """Whether it shows what others hold as it is then: an iterator, what a dictionary has, a flat array."""
    return hasattr(value, "__next__") or isinstance(value, KeysView | ValuesView | ItemsView | MappingProxyType)


def _to_look_at(values: Iterable[Any], hidden: bool) -> list[tuple[Any, bool]]:
    return [(value, hidden) for value in values if type(value) not in _PLAIN]


def sets_of_others(line: CodeType, *functions: CodeType) -> bool:
    """Whether functions may set elements of arrays that are not their own, or a line does under no name of its own."""
    if any(_sets(code) or not _SETTING_HELD.isdisjoint(names_of(code)) for code in (line, *functions)):
        return True
    return any(not _SETTING.isdisjoint(names_of(code)) for code in functions)


@lru_cache(maxsize=4096)
def _sets(code: CodeType) -> bool:
    """Whether code sets elements of what has no name there, or one that it does not bind: of others a call does."""
    inside = (constant for constant in code.co_consts if isinstance(constant, CodeType))
    return not _ELEMENTS.isdisjoint(operations(code)) or any(map(_sets, inside))


def _holds(value: Any) -> bool:
    return isinstance(value, list | dict | set | deque) or (
        hasattr(value, "__dict__") and not (isinstance(value, type | FunctionType) or _of_this(value))
    )


def _is_fixed(value: Any) -> bool:
    if isinstance(value, FunctionType) and vars(value):  # of a function attributes alone
        return False
    return (_of_this(value) and not isinstance(value, Sifted | OneOfLists)) or isinstance(value, _UNCHANGED)


def _is_own(f: Any, own: Mapping[str, Any]) -> bool:
    """Whether it is a function of the worksheet's cells, or of its setup, which has these names by themselves."""
    known = f.__globals__ if isinstance(f, FunctionType) else {}
    return known is own or ("recorded imported" in known and not stands_for_others(f))


def _foreign(value: Any, own: Mapping[str, Any]) -> bool:
    """Functions, classes and what they are declared with that are none of the worksheet's own."""
    if isinstance(value, FunctionType):
        return not _is_own(value, own)
    known = isinstance(value, type) and (value.__module__ in sys.modules or hasattr(value, "__inputs__"))
    return known or type(value).__module__ == "typing"


_EMPTY = weakref.WeakSet[Any]()  # functions that keep nothing


def _kept(value: Any, own: Mapping[str, Any], within: frozenset[Any] = frozenset()) -> list[Any]:
    """What a function that is none of the worksheet's own keeps of those that were given where it was made."""
    cells = value.__closure__ if isinstance(value, FunctionType) else None
    if not cells or value in _EMPTY or value in within:
        return []
    held = (part for cell in cells for part in content(cell) if not _of_this(part) or isinstance(part, Quantity))
    inner = within | {value}
    kept = [x for x in held if not isinstance(x, _LEAVES) and not (_foreign(x, own) and not _kept(x, own, inner))]
    if not kept and not within:
        _EMPTY.add(value)
    return kept


def _hidden(value: Any) -> Iterable[Any]:
    """What a value refers to that is none of its parts: the arguments of a partial, the columns of a data frame."""
    return () if type(value) in _SEEN or _of_this(value) else gc.get_referents(value)


def _of_this(value: Any) -> bool:
    return type(value).__module__.startswith("mechsheet.")


def _parts(value: Any) -> list[Any] | None:
    """What a value holds now, in a form that does not change with it; None where nobody can look into it."""
    match value:
        case Sifted():
            return value.held()
        case OneOfLists():
            return [*value, *value.ways]
        case list() | tuple() | deque() | set() | frozenset():
            return list(value)
        case _ if isinstance(value, _MAPPINGS):
            return [*value, *value.values()]
        case np.ndarray() if value.dtype == object:
            return value.ravel().tolist()
        case np.ndarray():
            return [f"{value.dtype}{value.shape}".encode() + value.tobytes()]
        case _ if type(value).__module__.partition(".")[0] == "pandas" and hasattr(value, "to_numpy"):
            return _of_frame(value)  # whose columns stand in what only its own code looks into
        case CellType():
            return content(value)
        case type():
            return [*vars(value).values(), *value.__bases__]
        case MethodType():
            return [value.__self__, value.__func__]
        case BuiltinFunctionType():
            return [value.__self__]
        case partial():
            return [value.func, *value.args, *value.keywords.values()]
        case FunctionType():
            given = *(value.__defaults__ or ()), *(value.__kwdefaults__ or {}).values()
            return [*(value.__closure__ or ()), *given, *vars(value).values()]
    slots = getattr(type(value), "__slots__", None)
    if hasattr(value, "__next__") or not (slots or hasattr(value, "__dict__")):
        return None
    held = (name for name in slots or () if isinstance(getattr(type(value), name, None), MemberDescriptorType))
    return [*getattr(value, "__dict__", {}).values(), *(getattr(value, name, None) for name in held)]  # not computed


def _of_frame(value: Any) -> list[Any]:
    """What a table, a column or an index of pandas holds: its own values as they are written, others each by itself."""
    columns = [*value.items()] if hasattr(value, "items") and hasattr(value, "columns") else [("", value)]
    held = [[name, *column.tolist()] for name, column in columns]
    index: Any = getattr(value, "index", None)
    held += [] if index is None else [index.tolist()]
    plain = [[x if isinstance(x, _WRITTEN) else None for x in each] for each in held]
    return [pickle.dumps(plain), *(x for each in held for x in each if not isinstance(x, _WRITTEN))]


_WRITTEN = bool | int | float | complex | str | bytes | np.generic | None


def _inside(value: Any) -> list[Any] | None:
    """What there is to look at in a value: in an array of numbers nothing."""
    return [] if isinstance(value, np.ndarray) and value.dtype != object else _parts(value)


def content(cell: CellType) -> list[Any]:
    try:
        return [cell.cell_contents]
    except ValueError:  # it is empty
        return []


def _as_it_was(value: Any, parts: list[Any] | None) -> bool:
    if isinstance(value, weakref.ref):
        value = None if parts is None else value()  # of an array; a reference itself always is
        if value is None:  # nobody reaches it any more
            return True
    now = _parts(value)
    if parts is None or now is None or len(parts) != len(now):
        return False
    return all(a is b or (isinstance(a, bytes) and a == b) for a, b in zip(parts, now, strict=True))


def before_ways(now: Any, later: Any, *given: Any) -> Memory:
    """All that two ways reach, of which the first is gone, by what their functions read too, and what is given."""
    memory = Memory([*_read(now), *_read(later), *given], _shared(now, later))
    memory.follow()
    return memory


def _read(f: Any) -> list[Any]:
    """What a function reads, but for its arguments."""
    if not isinstance(f, FunctionType):
        return [f]
    names = () if stands_for_others(f) else names_of(f.__code__)
    return [f.__closure__, *(f.__globals__.get(name) for name in names)]


def stands_for_others(f: FunctionType) -> bool:
    """Whether a function is none of the worksheet's, but does what one or one of two do that it holds."""
    return str(f.__module__).startswith("mechsheet.")


def _shared(*functions: Any) -> Mapping[str, Any]:
    """The names of the worksheet that its functions share; what stands for one of two of them calls these."""
    waiting, seen = list(functions), set[FunctionType]()
    while waiting:
        f = waiting.pop(0)
        if isinstance(f, FunctionType) and f not in seen:
            seen.add(f)
            if not stands_for_others(f):
                return f.__globals__
            waiting[:0] = chain.from_iterable(map(content, f.__closure__ or ()))
    return {}


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
    if not _METHODS.isdisjoint(code.co_names) or any(
        "inplace" in part for part in code.co_consts if type(part) is tuple
    ):
        return True
    last, does = "", operations(code)
    # From Python 3.12 on a comprehension is called no more: one for no value ends by these.
    unused = ("CALL", "STORE_FAST", "POP_TOP", "POP_ITER") if "LOAD_FAST_AND_CLEAR" in does else ("CALL",)
    for instruction in dis.get_instructions(code) if not does.isdisjoint(_MAY_CHANGE) else ():
        if instruction.opname in _SETS or (instruction.opname == "POP_TOP" and last.startswith(unused)):
            return True
        if instruction.opname == "STORE_DEREF" and instruction.argval in code.co_freevars:
            return True
        last = instruction.opname
    return any(changes(constant) for constant in code.co_consts if isinstance(constant, CodeType))


def may_change(codes: Iterable[CodeType], own: Mapping[str, Any]) -> bool:
    """Whether some code, or a function of the worksheet or of a class of its that it names, may change something."""
    waiting, seen, methods = list(codes), set[CodeType](), dict[str, list[Any]]()
    for name, f in (item for made in own.values() if isinstance(made, type) for item in vars(made).items()):
        if _is_own(f, own):
            methods.setdefault(name, []).append(f)
    while waiting:
        code = waiting.pop()
        if code in seen:
            continue
        seen.add(code)
        if changes(code):
            return True
        named = [f for name in names_of(code) for f in (own.get(name), *methods.get(name, ()))]
        waiting += [f.__code__ for f in named if _is_own(f, own)]
    return False
