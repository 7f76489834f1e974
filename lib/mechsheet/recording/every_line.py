"""The lines on which nothing rests that a worksheet shows in tables, figures and checks."""

from collections.abc import Iterable
from typing import Any

import numpy as np

from mechsheet import units
from mechsheet.quantities.lines import Line
from mechsheet.quantities.node import bottom_up, conditions
from mechsheet.quantities.quantity import Quantity
from mechsheet.recording import statement
from mechsheet.recording.recorded_run import Run
from mechsheet.worksheet.cells import Cell
from mechsheet.worksheet.title import Slider


def add_lines(run: Run) -> None:
    """Record the lines of cells that are not behind what is shown, and note which lines have no quantity of their own.

    What rests on a slider is that of its position at rest.
    """
    recording, known = run.recording, {*run.asked, *(name for cell in run.needed for name in cell.gives)}
    behind, gaps, guards = [*run.needed], len(recording.gaps), {*recording.guards}
    for cell in run.sheet.cells:
        if cell not in run.needed and any(name in run.lines for name in _bound(cell)):
            for each in [*run.sheet.needed(sorted(cell.needs), known), cell]:
                run.run(each, draws=False)
                behind.append(each)
                known.update(each.gives)
    if further := recording.gaps[gaps:]:
        at, names = _behind_lines(run, behind)
        recording.gaps[gaps:] = [gap for gap in further if not names.isdisjoint({*gap.names, *at.get(gap.line, ())})]
    for cell in sorted(behind, key=run.sheet.cells.index):
        for name in _bound(cell):
            _note(run, cell, name)
    every = [line.node for lines in recording.lines.values() for line in lines if line.text]
    every += [part.args[2] for part in bottom_up(every, ()) if part.op == "iterated"]  # by the turns that cells take
    guards = guards.union(*(conditions(node, run.chosen) for node in every))  # not those of what cells draw
    kept = {h: guard for h, guard in recording.guards.items() if h in guards or guard.rows or guard.lengths}
    recording.guards = kept


def _behind_lines(run: Run, cells: Iterable[Cell]) -> tuple[dict[int, set[str]], set[str]]:
    """What statements bind or change, by their places in the file, and all names on which lines rest."""
    at, waiting, found = dict[int, set[str]](), [*run.lines], set[str]()
    reads = dict[str, set[str]]()
    for line in (line for cell in cells for line in cell.lines):
        facts = statement.facts(line, run.sheet.path)
        at.setdefault(line.lineno, set()).update(facts.touched)
        for name in facts.touched:
            reads.setdefault(name, set()).update(run.read(facts.loaded))
    while waiting:
        name = waiting.pop()
        if name not in found:
            found.add(name)
            waiting += reads.get(name, ())
    return at, found


def _bound(cell: Cell) -> dict[str, None]:
    """Names that a cell binds or changes, in their order."""
    return dict.fromkeys(name for line in cell.lines for name in statement.touched(line))


def _note(run: Run, cell: Cell, name: str) -> None:
    """Note a line or a slider whose number stands elsewhere, or is the same for all inputs."""
    recording, line, value = run.recording, run.lines.get(name), run.shown(name)
    if isinstance(value, Slider):
        at = run.graph.constant(value.value * units.parse(value.unit).factor)
        at_rest = Line(at, name, value.unit, f"{value.label}: slider at rest".lstrip(": "))
        recording.others.setdefault(cell.section, []).append(at_rest)
    elif line and not line.again:
        number = value if isinstance(value, Quantity) else _plain(run, value)
        if number is None:
            return
        if all(part.op == "constant" for part in number.parts):  # it may be so only while Python sees the same
            number = run.while_same(number, run.looked.get(name, ()))
            recording.define(cell.section, name, number, run.lines, arrays=True)
        recording.also(cell.section, name, number, line)


def _plain(run: Run, value: Any) -> Quantity | None:
    """Plain numbers as a quantity."""
    several = isinstance(value, list | tuple) and all(isinstance(x, int | float | complex | np.number) for x in value)
    if several or isinstance(value, bool | int | float | complex | np.number | np.ndarray | np.bool_):
        numbers = np.asarray(value)
        numbers = numbers.astype(float) if isinstance(value, int) and numbers.dtype.kind == "O" else numbers
        if numbers.dtype.kind in "buif":
            return Quantity(run.graph, run.graph.constant(numbers))
        if numbers.dtype.kind == "c":
            return Quantity(run.graph, run.graph.constant(numbers.real), run.graph.constant(numbers.imag))
    return None
