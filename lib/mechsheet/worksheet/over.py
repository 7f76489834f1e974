"""Over which quantities a field runs, and where along them the field is least and greatest."""

import ast
from collections.abc import Callable, Container, Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import lru_cache
from math import inf
from typing import Any, NamedTuple, TypeGuard

import numpy as np
from numpy.typing import NDArray

from mechsheet.worksheet import numbers, source
from mechsheet.worksheet.lines import Formula, registry
from mechsheet.worksheet.source import bound


class Axis(NamedTuple):
    """The quantity along one axis of a field: the line that declares it, and its SI values, shape (n,)."""

    line: Formula
    values: NDArray[Any]


_ALIKE = 1e-9  # of the span of a field: numbers no further from its end are shown as that end
Written = Callable[[Formula, Any], str]  # how a number of a line is


class Over(NamedTuple):
    """What a field of some shape runs over: along each of its axes a quantity, where one is known."""

    shape: tuple[int, ...]
    axes: tuple[Axis | None, ...]

    def places(self, of: Any, named: Callable[[str], str], written: Written) -> tuple[str, str] | None:
        """Where a field is least and where it is greatest, its quantities as they are ``named`` and ``written``.

        Along axes of which no quantity is known the elements are counted from 1. None where the field stands in full,
        and where it is nowhere or everywhere: where it differs by no more than rounding, its place means nothing.
        """
        values = np.asarray(of)
        if values.shape != self.shape or numbers.in_full(values):
            return None
        known = values[~np.isnan(values)]
        if not known.size or (span := known.max() - known.min()) <= numbers.rounding(known):
            return None
        # Of several turns that differ by roundings alone, the first.
        alike = max(numbers.rounding(known), _ALIKE * span if np.isfinite(span) else 0.0)
        ends = known.min(), known.max()
        least, greatest = (np.argwhere(np.isclose(values, end, 0, alike))[0].tolist() for end in ends)
        return self._place(least, named, written), self._place(greatest, named, written)

    def _place(self, at: Iterable[int], named: Callable[[str], str], written: Written) -> str:
        told, elements = list[str](), list[tuple[str, str]]()
        for axis, k, n in zip(self.axes, at, self.shape, strict=True):
            if axis:
                told.append(f"{named(axis.line.name)} = {written(axis.line, axis.values[k])}")
            elif n > 1:
                elements.append((str(k + 1), str(n)))
        if elements:
            bare = "{}" if len(elements) == 1 else "({})"
            told.append("element " + " of ".join(bare.format(", ".join(each)) for each in zip(*elements, strict=True)))
        return ", ".join(told)


def over(name: str, namespace: Mapping[str, Any]) -> Over | None:
    """What the field of a line runs over: along each axis a quantity that has as many numbers and lies along it.

    Such quantities are those over which the worksheet draws its figures, and those by which its tables begin: the
    first, and the whole numbers behind it. It is one that the field is computed from, the first beside which its name
    stands there or else the first of all; along one of several axes it may be whole numbers, too, beside which it
    stands, or the only ones beside which there stands what it is computed from, or what is computed from it. A line
    between the two that puts elements elsewhere, such as one that sorts them, leaves no place certain.
    None where the line is no field of real numbers, or one along a single axis of which nothing is known.
    """
    values = namespace.get(name)
    if not _is_field(values):
        return None
    written, lines = _written(source.cells(namespace)), registry(namespace)
    several, axes = sum(n > 1 for n in values.shape) > 1, list[Axis | None]()
    for back, n in zip(range(values.ndim, 0, -1), values.shape, strict=True):
        found = written.along(name, namespace, (back, n), several) if n > 1 else ""
        axes.append(Axis(lines[found], namespace[found].ravel()) if found in lines else None)
    return Over(values.shape, tuple(axes)) if several or any(axes) else None


def _is_field(value: Any) -> TypeGuard[NDArray[Any]]:
    return isinstance(value, np.ndarray) and value.size > 1 and value.dtype.kind in "iuf"


def _runs(values: Any, axis: tuple[int, int]) -> bool:
    """Whether a field has along an axis, so many from the last, as many numbers."""
    back, n = axis
    return _is_field(values) and values.ndim >= back and values.shape[-back] == n


class _Shown(NamedTuple):
    """Columns of a figure or a table, "" for one that is no name; all names in it; how many columns may head it."""

    columns: tuple[str, ...]
    names: frozenset[str]
    most: int

    def heads(self, namespace: Mapping[str, Any]) -> Iterator[str]:
        """The first column, and in a table those of whole numbers behind it."""
        for k, name in enumerate(self.columns[: self.most]):
            values = namespace.get(name)
            if k and not (isinstance(values, np.ndarray) and values.dtype.kind in "iu"):
                return
            if _is_field(values):
                yield name


@dataclass(frozen=True, eq=False)
class _Written:
    """What figures and tables show, and the names that each name is bound by.

    ``moved`` are names to which elements are put elsewhere than they stood, ``picked`` those by which they are taken.
    """

    shown: tuple[_Shown, ...]
    reads: Mapping[str, frozenset[str]]
    moved: frozenset[str]
    picked: Mapping[str, frozenset[str]]
    known: dict[str, set[str]] = field(default_factory=dict)

    def along(self, name: str, namespace: Mapping[str, Any], axis: tuple[int, int], several: bool) -> str:
        """The quantity along an axis of a field, which may have several of them; nothing where none is certain."""
        # What the field is not computed from may be that of the last run: of counts, as many are the same.
        lying = [
            (head, each)
            for each in self.shown
            for head in each.heads(namespace)
            if head != name and _runs(namespace[head], axis) and namespace[head].size == axis[1]
            if head in self.sources(name) or (several and namespace[head].dtype.kind in "iu")
        ]
        moved = {head for head in dict(lying) if self.moves(name, head, namespace, axis)}
        known = [(head, each) for head, each in lying if head not in moved]
        beside = [head for head, each in known if name in each.names]
        if found := beside or [head for head, _ in known if head in self.sources(name)]:
            return found[0]
        others = {
            head
            for head, each in known
            if any(self.belong(name, c) for c in each.columns if c != head and _runs(namespace.get(c), axis))
        }
        return others.pop() if len(others) == 1 else ""

    def moves(self, name: str, head: str, namespace: Mapping[str, Any], axis: tuple[int, int]) -> bool:
        """Whether an element of a field may stand elsewhere along an axis than what it is computed from.

        It may by the lines between the two: by functions, and by what has the axis too or is not there any more.
        """
        between, waiting = set[str](), [name]
        while waiting:
            each = waiting.pop()
            x = namespace.get(each)
            if each not in {*between, head} and (each not in namespace or callable(x) or _runs(x, axis)):
                between.add(each)
                waiting += self.reads.get(each, ())
        if head in self.sources(name):
            between = {each for each in between if head in self.sources(each) or not _is_field(namespace.get(each))}
        picked = frozenset[str]().union(*(self.picked.get(each, ()) for each in between))
        return not self.moved.isdisjoint(between) or any(_is_field(namespace.get(each)) for each in picked)

    def belong(self, name: str, other: str) -> bool:
        return other in self.sources(name) or name in self.sources(other)

    def sources(self, name: str) -> set[str]:
        """All names that a name is computed from, without itself."""
        if name not in self.known:
            found, more = set[str](), {name}
            while more:
                more = {read for each in more for read in self.reads.get(each, ())} - found
                found |= more
            self.known[name] = found - {name}
        return self.known[name]


@lru_cache(maxsize=32)
def _written(cells: tuple[source.Cell, ...]) -> _Written:
    shown, moved = list[_Shown](), set[str]()
    reads, picked = dict[str, frozenset[str]](), dict[str, frozenset[str]]()
    lines = [node for cell in cells for node in cell.body]
    own = {name for node in lines if not isinstance(node, ast.Import | ast.ImportFrom) for name in bound(node)}
    for node in lines:
        shown += _shown(node)
        read, by = frozenset(_read(node)), frozenset(_picked(node))
        names = set(bound(node))
        for name in names:
            reads[name] = reads.get(name, frozenset()) | read
            picked[name] = picked.get(name, frozenset()) | by
        in_place = set(_in_place(node))
        moved |= in_place | (names if in_place or any(_moves(part, own) for part in source.nodes(node)) else set())
    return _Written(tuple(shown), reads, frozenset(moved), picked)


# Functions and methods whose results stand elsewhere than their arguments, or nowhere that one could tell.
_MOVING = frozenset({
    "sort", "sorted", "argsort", "lexsort", "partition", "argpartition", "searchsorted", "unique", "flip", "flipud",
    "fliplr", "reversed", "reverse", "roll", "rot90", "concatenate", "hstack", "delete", "block", "tile", "repeat",
    "resize", "take", "choose", "compress", "extract", "permutation", "shuffle", "choice",
    "fft", "ifft", "rfft", "irfft", "correlate", "convolve", "histogram", "bincount", "linspace", "arange", "logspace",
    "geomspace", "fromiter",
})  # fmt: skip
_ADDING = {"append": 2, "insert": 3}  # numpy's functions by how many arguments they have, unlike the methods of lists


def _moves(node: ast.AST, own: Container[str]) -> bool:
    """Whether a part of a statement puts elements elsewhere, and is no function of the worksheet's ``own``."""
    match node:
        case ast.Call(ast.Name(name)) if name in own:
            return False
        case ast.Call(ast.Name(name) | ast.Attribute(attr=name), args):
            return name in _MOVING or len(args) >= _ADDING.get(name, inf)
        case ast.Subscript(ast.Attribute(attr="r_" | "c_")):
            return True
        case ast.Subscript():
            return any(map(_counts_back, _indices(node)))
    return False


def _indices(node: ast.Subscript) -> list[ast.expr]:
    return node.slice.elts if isinstance(node.slice, ast.Tuple) else [node.slice]


def _counts_back(index: ast.expr) -> bool:
    """Whether an index runs from the end, or is one of several elements by itself."""
    match index:
        case ast.Slice(step=ast.UnaryOp(ast.USub())) | ast.List() | ast.Compare():
            return True
        case ast.UnaryOp(ast.USub() | ast.Invert(), of) | ast.BinOp(_, ast.Sub(), of):
            return not isinstance(of, ast.Constant)
    return False


def _picked(node: ast.stmt) -> Iterator[str]:
    """Names by which a statement takes elements."""
    for part in source.nodes(node):
        if isinstance(part, ast.Subscript):
            yield from (index.id for index in _indices(part) if isinstance(index, ast.Name))


def _in_place(statement: ast.stmt) -> Iterator[str]:
    """Names of what a statement puts in another order itself."""
    match statement:
        case ast.Expr(ast.Call(ast.Attribute(ast.Name(name), "sort" | "reverse"))):
            yield name
        case ast.Expr(ast.Call(ast.Attribute(attr="shuffle"), [ast.Name(name)])):
            yield name


def _read(node: ast.AST) -> set[str]:
    """Names that a statement reads, without the arguments of its functions."""
    found = {node.id} if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Load) else set[str]()
    for part in ast.iter_child_nodes(node):
        found |= _read(part)
    return found - {a.arg for a in node.args.args} if isinstance(node, ast.Lambda | ast.FunctionDef) else found


def _shown(node: ast.stmt) -> Iterator[_Shown]:
    for call in source.nodes(node):
        match call:
            case ast.Call(ast.Name("figure" | "table" as kind), [_, _, *given]):
                columns = source.listed(given)
                names = frozenset(name for column in columns for name in _read(column))
                plain = tuple(column.id if isinstance(column, ast.Name) else "" for column in columns)
                yield _Shown(plain, names, 1 if kind == "figure" else len(plain))
