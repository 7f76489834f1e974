"""Results of a worksheet as one function of its inputs, by a `plan` of its recording."""

import dis
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from types import CodeType, FunctionType, ModuleType
from typing import Any

import numpy as np

from mechsheet.quantities.lines import Recording
from mechsheet.quantities.node import Node, bottom_up
from mechsheet.quantities.quantity import Quantity, lift
from mechsheet.quantities.refused import refusing
from mechsheet.readers.plan import REFUSED, NotPlanned, plan
from mechsheet.recording.record import record
from mechsheet.units import Constant
from mechsheet.worksheet import inputs
from mechsheet.worksheet.cells import Worksheet, base, value
from mechsheet.worksheet.marimo_on_use import Marimo

_PARTIAL = frozenset(("div", "pow", "sqrt", "exp", "log", "asin", "acos"))  # of which Python refuses single numbers
_ROOMS = frozenset(("mechsheet", "numpy", "scipy", "math", "cmath", "operator", "itertools", "functools", "builtins"))
_READING = frozenset(("load", "loadtxt", "genfromtxt", "fromfile", "fromregex", "memmap", "io"))  # of numpy and scipy
_SHARED = ("LOAD_GLOBAL", "LOAD_NAME")
_READING |= {"open", "input", "exec", "eval", "compile", "globals", "vars", "setattr", "__import__"}


@dataclass(frozen=True)
class Followed:
    """The recording of one run of a worksheet, and ``own``, the names of that run.

    The worksheet has the same for other inputs while all of ``same`` hold and all of ``exist`` are numbers; ``found``
    are the single numbers that a Find of it gives: of fields what has none is in what is made of them.
    """

    recording: Recording
    own: Mapping[str, Any]
    same: Sequence[Node]
    exist: Sequence[Node]
    found: Sequence[Node]


@dataclass(frozen=True)
class Results:
    """Wanted results of a worksheet in what is followed ``of`` it.

    ``roots`` are the names in the worksheet, by what is wanted of them, and ``parts`` their quantities.
    """

    of: Followed
    roots: Mapping[str, str]
    parts: Mapping[str, Sequence[Node]]

    @property
    def wanted(self) -> list[Node]:
        """All quantities that are wanted."""
        return [part for parts in self.parts.values() for part in parts]


def followed(only: Worksheet, want: Sequence[str], g: Any) -> Followed:
    """The recording of a worksheet whose cells are all needed for what is wanted of it.

    Raises NotPlanned where the worksheet may give something else at each run, or where something is not recorded.
    """
    if foreign := next(_foreign(only), None):
        raise NotPlanned(f"{foreign} may give something else at each run")
    own = only.run(want, {"g": g})
    recording = record(own, only, whole=True, every=1, bodies=True)
    if recording.integrals:
        raise NotPlanned("an integral by scipy's own places has other digits at corners")
    seen = [guard.holds for guards in recording.looked.values() for guard in guards]
    quantities = (q for q in recording.values.values() if isinstance(q, Quantity))
    under = bottom_up([part for quantity in quantities for part in quantity.parts], set())
    exist = [node for node in under if node.shape == () and node.op in _PARTIAL]
    exist += refusing(recording.graph)  # of which nothing may be made
    found = [solved.node for solved in recording.found.values() if not solved.node.shape]
    return Followed(recording, own, [*seen, *recording.guards], exist, found)


def results(only: Worksheet, want: Sequence[str], g: Any) -> Results:
    """What is wanted of a worksheet whose cells are all needed for it; raises NotPlanned as `followed` does."""
    of = followed(only, want, g)
    roots = {name: base(name) for name in want}
    parts = dict[str, Sequence[Node]]()
    for root in roots.values():
        known = of.recording.values.get(root)
        if not isinstance(known, Quantity) and np.asarray(known).dtype.kind not in "biufc":
            raise NotPlanned(f"{root} is no recorded number")
        parts[root] = [*lift(of.recording.graph, known).parts]
    return Results(of, roots, parts)


def planned(only: Worksheet, want: Sequence[str], g: Any) -> Callable[[Any], dict[str, Any] | None]:
    """What gives the wanted results of a worksheet whose cells are all needed for them, from its inputs.

    None where only the worksheet itself can tell, which may refuse the inputs, or have no number. Raises NotPlanned
    where it could never do other.
    """
    found = results(only, want, g)
    of, taken = found.of, found.of.recording.inputs
    compute = plan([*taken.values()], found.wanted, of.same, of.exist)
    singles = [node.shape == () for node in taken.values()]

    def again(g: Any) -> dict[str, Any] | None:
        given = leaves(g)
        numbers = [given[name] for name in taken]
        if not all(isinstance(x, float | int) for x, single in zip(numbers, singles, strict=True) if single):
            return None  # variants, or numbers of a type of numpy's, which a worksheet may tell apart
        try:
            computed = iter(compute(numbers))
        except REFUSED:
            return None
        space = dict[str, Any]()
        for root, nodes in found.parts.items():
            each = [next(computed) for _ in nodes]
            if not all(map(_finite, each)) or not _is_kind(of.own[root], each):
                return None
            space[root] = _like(of.own[root], each)
        return {name: value(name, space) for name in found.roots}

    return again


def leaves(g: Any) -> dict[str, Any]:
    """Numbers of inputs, by the names that they have in a recording."""
    found = dict[str, Any]()
    for field in inputs.declared(type(g)):
        held = getattr(g, field.name)
        if field.continuous:
            found[field.name] = held
        else:
            found.update((name, x) for name, (_, x) in field.leaves(held).items())
    return found


def _finite(x: Any) -> bool:
    return bool(np.isfinite(x).all()) if isinstance(x, np.ndarray) else -np.inf < x < np.inf


def _is_kind(own: Any, parts: Sequence[Any]) -> bool:
    """Whether numbers are of the kind that the worksheet's own are, where whole or real ones may become others."""
    held = np.asarray(own).dtype
    if held.kind in "fc":
        return held.kind == "c" or len(parts) == 1
    return len(parts) == 1 and np.array_equal(np.asarray(parts[0]).astype(held), parts[0])


def _like(own: Any, parts: Sequence[Any]) -> Any:
    """A number or an array of the type that the worksheet's own is."""
    if not isinstance(own, np.ndarray):
        return type(own)(*parts) if len(parts) == 1 else type(own)(complex(*parts))
    made = np.empty(own.shape, own.dtype)
    if len(parts) == 1:
        made[...] = parts[0]
    else:
        made.real, made.imag = parts
    return made


def _foreign(only: Worksheet) -> Iterator[str]:
    """What the cells use that may give something else at each run, such as what a file holds."""
    seen = set[CodeType]()
    waiting = [cell.code for cell in only.cells]
    while waiting:
        code = waiting.pop()
        if code in seen:
            continue
        seen.add(code)
        waiting += [inner for inner in code.co_consts if isinstance(inner, CodeType)]
        module = False
        for step in dis.get_instructions(code):
            if step.opname == "IMPORT_NAME" and _room(step.argval) not in _ROOMS:
                yield step.argval
            if step.argval in _READING and (module or step.opname in _SHARED):
                yield step.argval
            used = only.common.get(step.argval) if step.opname in _SHARED else None
            module = isinstance(used, ModuleType)
        for name in code.co_names:
            used = only.common.get(name)
            if not _plain(used, only.common):
                yield name
            if isinstance(used, FunctionType) and used.__globals__ is only.common:
                waiting.append(used.__code__)


def _room(module: str) -> str:
    return module.partition(".")[0]


def _plain(used: Any, common: Mapping[str, Any]) -> bool:
    """Whether something gives the same for the same arguments: a number, a function of the library or of numpy's."""
    match used:
        case None | bool() | int() | float() | complex() | str() | np.ndarray() | np.generic() | Constant() | Marimo():
            return True
        case tuple() | list():
            return all(_plain(each, common) for each in used)
        case dict():
            return all(_plain(each, common) for each in used.values())
        case ModuleType():
            return _room(used.__name__) in _ROOMS
        case FunctionType() if used.__globals__ is common:
            return True  # its own code is looked at
        case np.ufunc():
            return True
    if hasattr(used, "__inputs__") or hasattr(used, "__properties__"):
        return True
    return callable(used) and _room(str(getattr(used, "__module__", ""))) in _ROOMS
