"""What the editor tells of a worksheet as it is edited: its mistakes in words, at their lines."""

import ast
import builtins
import difflib
import time
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import lru_cache
from traceback import walk_tb
from types import FrameType
from typing import Any

import numpy as np

from mechsheet.page import notebook
from mechsheet.recording import dimensions
from mechsheet.worksheet import source
from mechsheet.worksheet.cells import Cell, Worksheet
from mechsheet.worksheet.lines import registry
from mechsheet.worksheet.title import Note

_PERIOD = 0.25  # s between two looks at the cells
# Their functions compute through another worksheet, whose inputs keep their metre.
_OTHERS = {
    f"mechsheet.{name}"
    for name in ("studies.design", "studies.sensitivity", "studies.sweep", "studies.tolerance", "worksheet.cells")
}


def watch(show: Callable[[list[Note]], object]) -> tuple[Note, ...]:
    """Call ``show`` whenever the mistakes found in the cells of the worksheet in the editor have changed.

    The cells are looked at from a thread of the calling cell, and read again once an edited one has run; a changed
    value costs nothing. Returned is what there is to tell at once: nothing, or that this version of marimo tells
    nothing of its cells.
    """
    import marimo as mo  # on use: reading the cells needs it not

    def look() -> None:
        this, told, gone = mo.current_thread(), list[Note](), set[str]()
        seen: list[Any] = []
        last: list[Any] = []
        while not this.should_exit:
            time.sleep(_PERIOD)
            names = dict(namespace)  # taken before the cells are seen at rest: so they were then
            cells = cells_now()
            before, last = last, [(cell.cell_id, cell.code, cell.status) for cell in cells]
            if last == seen or last != before or any(cell.busy for cell in cells):
                continue
            seen = last
            gone |= {name for cell in cells for name in cell.defs}
            notes = [*unknown(cells, names, gone), *unfit(cells, names)]
            known = {note.cell for note in notes}
            notes += [note for note in failed(cells) if note.cell not in known]
            if notes != told:
                told = notes
                show(notes)

    try:
        cells_now, namespace = notebook.running()
        cells_now()
    except notebook.Unlike as error:
        return (Note("", f"mistakes are not named here: marimo {mo.__version__} tells nothing of its cells ({error})"),)
    mo.Thread(target=look, daemon=True).start()
    return ()


def unknown(cells: Iterable[notebook.Cell], names: Mapping[str, Any], gone: Iterable[str] = ()) -> Iterator[Note]:
    """Names that a cell reads and none defines or two do, and inputs that there are not.

    What was defined before, by a cell that has a mistake now or is deleted, is in ``gone``.
    """
    cells = list(cells)
    defined = {name for cell in cells for name in cell.defs} | set(names)
    twice = [name for name, count in Counter(name for cell in cells for name in cell.defs).items() if count > 1]
    fields = [field.name for field in getattr(type(names.get("g")), "__inputs__", ())]
    for cell in cells:
        for name in cell.defs.intersection(twice):
            yield Note(cell.cell_id, f"{name} is defined in two cells: rename it in one of them")
        missing = cell.refs - defined - set(dir(builtins))
        for node in _read(cell.code):
            why = ""
            if isinstance(node, ast.Attribute):
                if fields and not hasattr(names["g"], node.attr):
                    why = f"there is no input {node.attr}{_near(node.attr, fields)}"
            elif node.id in missing:
                missing = missing - {node.id}  # told once a cell
                why = f"the name {node.id} is not defined in any cell{_near(node.id, defined)}"
                if node.id in gone:
                    why = f"the cell that defines {node.id} has a mistake or was deleted"
            if why:
                yield Note(cell.cell_id, f"{_line(cell, node.lineno)}: {why}")


def failed(cells: Iterable[notebook.Cell]) -> Iterator[Note]:
    """What else Python could not compute, with the line of the cell."""
    for cell in cells:
        if cell.status == "exception" and isinstance(cell.exception, Exception):
            lines = [line for frame, line in walk_tb(cell.exception.__traceback__) if _is_of(frame, cell)]
            yield Note(cell.cell_id, f"{_line(cell, lines[-1])}: {cell.exception}" if lines else str(cell.exception))


def unfit(cells: Iterable[notebook.Cell], names: Mapping[str, Any]) -> Iterator[Note]:
    """Lines of the worksheet that has run whose unit does not fit; of those that follow from another the first alone.

    What depends on the inputs runs once more, on the same machine in other units. A line whose meaning calls it an
    erratum is left as it is.
    """
    g = names.get("g")
    if not hasattr(type(g), "__inputs__"):
        return
    ran = [cell for cell in cells if cell.status == "success"]
    homes = {name: cell for cell in ran for name in cell.defs}
    others = {name for cell in ran for name in cell.refs if getattr(names.get(name), "__module__", "") in _OTHERS}
    known = names.keys() & homes.keys() - _depending(ran, others)
    declared = registry(names, source.of_texts(tuple((cell.code, cell.filename) for cell in ran)))
    lines = [line for name, line in declared.items() if name in known and not line.arguments]
    computed = _depending(ran, {"g"})
    common = {name: value for name, value in names.items() if name not in computed}
    sheet = Worksheet("", tuple(_compiled(cell, computed) for cell in ran if cell.defs & computed), common, "")
    try:
        with np.errstate(all="ignore"):  # the page has told of these already
            second = sheet.run([line.name for line in lines], {"g": dimensions.rescaled(g)})
    except Exception as error:
        yield Note("", f"units are not checked, as the worksheet does not run in other ones: {error}")
        return
    wrong = [(x, why) for x, why in dimensions.unfit(lines, g, names, second).items() if "erratum" not in x.meaning]
    told = set[str]()
    for line, why in wrong:
        cell = homes[line.name]
        before = {name for other, _ in wrong if homes[other.name] is not cell for name in homes[other.name].defs}
        if cell.cell_id not in told and not cell.defs & _depending(ran, before):
            told.add(cell.cell_id)
            yield Note(cell.cell_id, f"line {line.expression.lineno}, {line.name}: {why}")


def _depending(cells: Iterable[notebook.Cell], names: set[str]) -> set[str]:
    """Names that depend on some names, and these."""
    found, cells = set(names), list(cells)
    while more := {name for cell in cells if cell.refs & found for name in cell.defs} - found:
        found |= more
    return found


def _compiled(cell: notebook.Cell, computed: set[str]) -> Cell:
    code = compile(cell.code, cell.filename, "exec")
    return Cell(cell.cell_id, frozenset(cell.refs & computed), tuple(cell.defs), (), code)


@lru_cache(maxsize=1000)
def _read(code: str) -> tuple[ast.Name | ast.Attribute, ...]:
    """Names and inputs that a cell reads."""
    nodes = ast.walk(ast.parse(code))
    return tuple(
        node
        for node in nodes
        if (isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name) and node.value.id == "g")
        or (isinstance(node, ast.Name) and isinstance(node.ctx, ast.Load))
    )


def _is_of(frame: FrameType, cell: notebook.Cell) -> bool:
    return bool(frame.f_code.co_filename == cell.filename)


def _line(cell: notebook.Cell, number: int) -> str:
    """A line as a note names it: its number, and its text without its comment."""
    return f"line {number}, {cell.code.splitlines()[number - 1].partition('  #')[0].strip()}"


def _near(name: str, known: Iterable[str]) -> str:
    near = difflib.get_close_matches(name, known, n=1)
    return f" (did you mean {near[0]}?)" if near else ""
