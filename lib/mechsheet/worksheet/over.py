"""Over which quantity a field runs, and where along it the field is least and greatest."""

import ast
from collections.abc import Iterator, Mapping
from functools import lru_cache
from typing import Any, NamedTuple, TypeGuard

import numpy as np
from numpy.typing import NDArray

from mechsheet.worksheet import numbers, source
from mechsheet.worksheet.cells import bound
from mechsheet.worksheet.lines import Formula, registry


class Over(NamedTuple):
    """The quantity over which a field runs: the line that declares it, and its SI values, shape (n,)."""

    line: Formula
    values: Any

    def ends(self, field: Any) -> tuple[float, float] | None:
        """Its SI values where a field of shape (n,) is least and greatest; None where that is nowhere or everywhere.

        Where it differs by no more than rounding, its place means nothing.
        """
        field = np.asarray(field)
        known = field[~np.isnan(field)]
        if not known.size or known.max() - known.min() <= numbers.rounding(known):
            return None
        least, greatest = (np.flatnonzero(field == end)[0] for end in (known.min(), known.max()))
        return float(self.values[least]), float(self.values[greatest])


def over(name: str, namespace: Mapping[str, Any]) -> Over | None:
    """What the field of a line runs over: a quantity that it is computed from and that has as many numbers.

    Such quantities are those over which the worksheet draws its figures and by which its tables begin: of several the
    one beside which the name stands there, else the first. None where the line is no field of real numbers, shape (n,).
    """
    field = namespace.get(name)
    if not _is_row(field):
        return None
    written = _written(source.cells(namespace))
    beside = (axis for axis, names in written.shown if name in names)
    for axis in dict.fromkeys((*beside, *(axis for axis, _ in written.shown))):
        values = namespace.get(axis)
        if _is_row(values) and len(values) == len(field) and axis in written.sources(name):
            line = registry(namespace).get(axis)
            return Over(line, values) if line else None
    return None


def _is_row(value: Any) -> TypeGuard[NDArray[Any]]:
    return isinstance(value, np.ndarray) and value.ndim == 1 and value.dtype.kind in "iuf"


class _Written(NamedTuple):
    """What figures and tables show, the first quantity with all of them, and the names that each name is bound by."""

    shown: tuple[tuple[str, frozenset[str]], ...]
    reads: Mapping[str, frozenset[str]]

    def sources(self, name: str) -> set[str]:
        """All names that a name is computed from, without itself."""
        found, more = set[str](), {name}
        while more:
            more = {read for each in more for read in self.reads.get(each, ())} - found
            found |= more
        return found - {name}


@lru_cache(maxsize=32)
def _written(cells: tuple[source.Cell, ...]) -> _Written:
    shown, reads = list[tuple[str, frozenset[str]]](), dict[str, frozenset[str]]()
    for node in (node for cell in cells for node in cell.body):
        shown += _shown(node)
        read = frozenset(_read(node))
        for name in bound(node):
            reads[name] = reads.get(name, frozenset()) | read
    return _Written(tuple(shown), reads)


def _read(node: ast.AST) -> set[str]:
    """Names that a statement reads, without the arguments of its functions."""
    found = {node.id} if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Load) else set[str]()
    for part in ast.iter_child_nodes(node):
        found |= _read(part)
    return found - {a.arg for a in node.args.args} if isinstance(node, ast.Lambda | ast.FunctionDef) else found


def _shown(node: ast.stmt) -> Iterator[tuple[str, frozenset[str]]]:
    for call in source.nodes(node):
        match call:
            case ast.Call(ast.Name("figure" | "table"), [_, _, ast.Starred(ast.Tuple([first, *_])) | first, *_]):
                if isinstance(first, ast.Name):
                    yield first.id, frozenset(name for each in call.args[2:] for name in _read(each))
