"""Curves between the points of a table: the cells of the page computed at more positions, for its charts."""

import ast
import threading
from collections.abc import Mapping
from dataclasses import replace
from functools import lru_cache, partial
from typing import Any

import marimo as mo
import numpy as np
from numpy.typing import NDArray

from mechsheet.page import editor, notebook
from mechsheet.worksheet.cells import Cell, Worksheet, base, value
from mechsheet.worksheet.depending import depending
from mechsheet.worksheet.table import MARKED, Column, Figure
from mechsheet.worksheet.typeset import typeset
from mechsheet.worksheet.verdict import values_only

_PIECES = 120  # of a curve: one takes five pixels
_NOISE = 1e-9  # of the largest number of a curve: by more the points may not differ from those of the table
_kept = threading.local()  # pages are threads: the last run of each, which several figures share


def smooth(figure: Figure) -> Figure:
    """The figure with curves computed between its points, which stay marked.

    Positions between those across are put in their place, and the cells that depend on them run again. Where a curve
    does not follow from them, or the points would not be those of the table, they are joined by straight lines as ever.
    """
    columns = (figure.x, *figure.lines)
    few = 2 <= len(figure.x.values) <= MARKED and figure.every == 1
    if not few or not all(column.want for column in columns) or not mo.running_in_notebook():
        return figure
    try:
        cells, namespace = notebook.running()
        own = namespace[figure.x.want]
        if not _is_axis(own, len(figure.x.values)):
            return figure
        every = -(-_PIECES // (len(own) - 1))
        at = np.arange(every * (len(own) - 1) + 1) / every
        fine = np.interp(at, np.arange(len(own)), own)
        names = _run(cells(), namespace, figure, fine)
        if names is None:
            return figure
        drawn = [_drawn(column, names, every) for column in columns]
    except Exception:  # of the worksheet's own lines at other positions: the points are right without them
        return figure
    return replace(figure, x=drawn[0], lines=tuple(drawn[1:]), every=every)


def _is_axis(values: Any, count: int) -> bool:
    """Whether there are positions between the values: real numbers that rise or fall."""
    if not isinstance(values, np.ndarray) or values.shape != (count,) or values.dtype.kind != "f":
        return False
    steps = np.diff(values)
    return bool(np.all(steps > 0) or np.all(steps < 0))


def _run(
    cells: tuple[notebook.Cell, ...], namespace: Mapping[str, Any], figure: Figure, fine: NDArray[Any]
) -> dict[str, Any] | None:
    """Namespace with the curves of a figure at other positions; None where one of them does not depend on these."""
    across, wanted = figure.x.want, {base(line.want) for line in figure.lines}
    cells = tuple(map(partial(_without, name=across), cells))
    computed = depending(cells, {across}) - {across}
    if not wanted <= computed:
        return None
    again = [cell for cell in cells if cell.defs & computed]
    texts = tuple(replace(cell, status=None, exception=None, busy=False) for cell in again)
    read = {name: namespace[name] for cell in again for name in cell.refs - computed if name in namespace}
    rests_on = across, texts, {name: id(value) for name, value in read.items()}
    before = getattr(_kept, "run", None)
    known = before[1] if before and before[0] == rests_on else {}
    common = {name: value for name, value in namespace.items() if name not in computed}
    common |= {name: _nothing for name, value in read.items() if value is typeset}
    sheet = Worksheet("", _runnable(texts, frozenset(computed)), common, "")
    needed = {cell.name for cell in sheet.needed(wanted, {across})}
    if any(editor.is_of_studies(read.get(name)) for cell in again if cell.cell_id in needed for name in cell.refs):
        return None  # what is computed over many runs would be again, over more positions
    with values_only():
        names = sheet.run(wanted, {across: fine, **known})
    _kept.run = rests_on, {name: names[name] for name in computed if name in names}, read  # held: the ids stay theirs
    return names


def _without(cell: notebook.Cell, name: str) -> notebook.Cell:
    """A cell without its line that defines a name, which it reads instead; where it does nothing else, as it is."""
    if name not in cell.defs:
        return cell
    code = cell.code.splitlines()
    for line in ast.parse(cell.code).body:
        if isinstance(line, ast.Assign) and [ast.unparse(target) for target in line.targets] == [name]:
            end = line.end_lineno or line.lineno
            code[line.lineno - 1 : end] = [""] * (end - line.lineno + 1)
            return replace(cell, code="\n".join(code), defs=cell.defs - {name}, refs=cell.refs | {name})
    return cell


def _nothing(*_: Any) -> None:
    """Instead of typesetting lines that nobody reads."""


@lru_cache(maxsize=32)  # compiled once for all figures and runs
def _runnable(cells: tuple[notebook.Cell, ...], computed: frozenset[str]) -> tuple[Cell, ...]:
    return tuple(editor.runnable(n, cell, set(computed)) for n, cell in enumerate(cells))


def _drawn(column: Column, names: Mapping[str, Any], every: int) -> Column:
    """A column at more positions; ValueError where it is another one at its own."""
    values = np.asarray(value(column.want, names) / column.factor, dtype=float)
    largest = np.nanmax(np.abs(column.values), initial=0.0)
    if not np.allclose(values[::every], column.values, rtol=0, atol=_NOISE * largest, equal_nan=True):
        raise ValueError(f"{column.want} has other values between more positions")
    return replace(column, values=values)
