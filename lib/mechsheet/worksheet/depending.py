"""What depends on names, and what needs itself: of cells, of lines, of whatever reads names and defines others."""

import ast
from collections.abc import Iterable, Sequence, Set
from typing import NamedTuple, Protocol

from mechsheet.worksheet.source import bound, nodes


class Reading(Protocol):
    """What reads names and defines others: a cell, or a line of one."""

    @property
    def refs(self) -> Set[str]: ...

    @property
    def defs(self) -> Set[str]: ...


class Part(NamedTuple):
    """Such a part by its names alone."""

    refs: Set[str]
    defs: Set[str]


def depending(parts: Iterable[Reading], names: Iterable[str]) -> set[str]:
    """Names that depend on some names, and these."""
    found, parts = set(names), list(parts)
    while more := {name for part in parts if part.refs & found for name in part.defs} - found:
        found |= more
    return found


class Circle(NamedTuple):
    """A name that a cell reads although it needs one that the cell gives; ``whole`` where the lines themselves do."""

    name: str
    own: str
    whole: bool

    def __str__(self) -> str:
        if self.whole:
            return f"{self.own} and {self.name} need each other: neither can be computed first"
        return f"{self.name} needs {self.own} of the same cell: what needs {self.name} needs a cell of its own"


def circle(cell: Reading, others: Iterable[Reading], body: Sequence[ast.stmt]) -> Circle | None:
    """Why a cell of the lines ``body`` cannot be computed before all that needs it; None where it can."""
    others, refs = list(others), cell.refs - cell.defs
    if refs.isdisjoint(depending(others, cell.defs)):
        return None
    lines = [Part(read(line), set(bound(line))) for line in body]
    pairs = [(name, own) for own in sorted(cell.defs) for name in sorted(refs & depending(others, {own}))]
    found = [Circle(name, own, own in depending(lines, {name})) for name, own in pairs]
    return max(found, key=lambda each: each.whole, default=None)


def read(line: ast.stmt) -> set[str]:
    """Names that a line reads; none that a function has as its arguments."""
    own = {node.arg for node in nodes(line) if isinstance(node, ast.arg)}
    return {node.id for node in nodes(line) if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Load)} - own
