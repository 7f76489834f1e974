"""The setup of a worksheet, run again as far as units reach: what is made otherwise there stays the worksheet's own."""

import ast
from collections.abc import Iterable, Iterator, Mapping, Set
from copy import copy
from dataclasses import fields, is_dataclass
from functools import partial
from typing import Any

import numpy as np

from mechsheet.quantities.graph import Graph
from mechsheet.quantities.operations import regrouped
from mechsheet.quantities.quantity import Quantity
from mechsheet.recording.own_values import is_array
from mechsheet.recording.statement import touched
from mechsheet.recording.substitutes import shared
from mechsheet.units import UNKNOWN
from mechsheet.worksheet.cells import Worksheet

_STAYING = ast.Import | ast.ImportFrom | ast.FunctionDef  # of a function the recording has one of its own
_NUMBERS = int | float | complex | np.ndarray | np.generic


def statements(sheet: Worksheet) -> Iterator[ast.stmt]:
    """Those of a setup that are run again: no imports and functions, and of classes those that have functions alone."""
    for line in sheet.whole:
        if isinstance(line, ast.ClassDef):
            own = sheet.common.get(line.name)
            of_inputs = hasattr(own, "__inputs__") or hasattr(own, "__properties__")  # which are of this very class
            if not of_inputs and any(isinstance(part, ast.FunctionDef) for part in line.body):
                yield line
        elif not isinstance(line, _STAYING):
            yield line


def again(reads: Mapping[ast.stmt, Set[str]], declared: Set[str], measured: Set[str]) -> list[ast.stmt]:
    """Classes, statements with units or for them, and all that make, change or read later what these do.

    ``reads`` are the names that each of them reads, in their order; ``measured`` ones are units, or have some.
    """
    every = [(line, touched(line), read) for line, read in reads.items()]
    starts = (isinstance(line, ast.ClassDef) or declared & {*names} or measured & read for line, names, read in every)
    chosen = {n for n, start in enumerate(starts) if start}
    known = -1
    while known < len(chosen):
        known, first = len(chosen), dict[str, int]()
        for n in sorted(chosen):
            first = {**dict.fromkeys(every[n][1], n), **first}
        for n, (_, names, read) in enumerate(every):
            if not first.keys().isdisjoint(names) or any(first.get(name, n) < n for name in read):
                chosen.add(n)
    return [every[n][0] for n in sorted(chosen)]


def made_otherwise(
    graph: Graph, lines: Iterable[ast.stmt], names: Mapping[str, Any], own: Mapping[str, Any]
) -> dict[str, Any]:
    """What a setup's names hold in the worksheet's own run, of no known unit, for those with other numbers by now."""
    bound = dict.fromkeys(name for line in lines for name in touched(line))
    others = [name for name in bound if name in own and not _is_alike(names.get(name), own[name])]
    kept = shared(own) if others else {}
    return {name: _unmeasured(graph, kept[name]) for name in others}


def _unmeasured(graph: Graph, own: Any) -> Any:
    """Numbers of the worksheet's own run, down to lists, dictionaries and fields, of no known unit."""
    if isinstance(own, list | tuple):
        return regrouped(own, (_unmeasured(graph, each) for each in own))
    if type(own) is dict:
        return {key: _unmeasured(graph, each) for key, each in own.items()}
    if is_dataclass(own) and not isinstance(own, type):
        group = copy(own)
        for field in fields(own):
            object.__setattr__(group, field.name, _unmeasured(graph, getattr(own, field.name)))
        return group
    return Quantity(graph, graph.constant(own, UNKNOWN)) if type(own) is float or is_array(own) else own


def _is_alike(made: Any, own: Any, seen: frozenset[int] = frozenset()) -> bool:
    """Whether numbers are the same but for rounding, down to lists, dictionaries and what an object holds."""
    if made is own or id(own) in seen or isinstance(own, type):
        return True
    alike = partial(_is_alike, seen=seen | {id(own)})
    if isinstance(own, list | tuple):
        return isinstance(made, list | tuple) and len(made) == len(own) and all(map(alike, made, own))
    if isinstance(own, dict):
        return isinstance(made, dict) and made.keys() == own.keys() and all(alike(made[key], own[key]) for key in own)
    if not isinstance(own, _NUMBERS):  # what stands for another kind is the recording's
        known = isinstance(own, str) and made == own
        other = type(made).__qualname__ != type(own).__qualname__
        return known or other or (hasattr(own, "__dict__") and alike(vars(made), vars(own)))
    number = np.asarray(made.value if isinstance(made, Quantity) else made)
    if not {number.dtype.kind, np.asarray(own).dtype.kind} <= {*"biufc"}:
        return np.array_equal(number, own)
    return number.shape == np.shape(own) and np.allclose(number, own, rtol=1e-12, atol=0, equal_nan=True)
