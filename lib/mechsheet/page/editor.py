"""What the editor tells of a worksheet as it is edited: its mistakes in words, at their lines."""

import ast
import builtins
import time
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from functools import lru_cache
from traceback import walk_tb
from types import FrameType
from typing import Any

from mechsheet import units
from mechsheet.document.left_out import left_out, unseen
from mechsheet.document.numberless import numberless
from mechsheet.page import notebook
from mechsheet.recording import dimensions
from mechsheet.worksheet import mistakes, source
from mechsheet.worksheet.cells import Cell, Worksheet, compiled
from mechsheet.worksheet.depending import circle, depending
from mechsheet.worksheet.errors import SheetError
from mechsheet.worksheet.lines import registry
from mechsheet.worksheet.no_inputs import beforehand, declared_in, inputs_of
from mechsheet.worksheet.title import Note

_PERIOD = 0.25  # s between two looks at the cells
_MOST = 100_000  # lines of a cell
_LISTED = 5  # lines that wait for what is gone
_NONE: Mapping[str, str] = {}
# Their functions compute through another worksheet, for long: nothing is known of the units of what they give.
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
        this, told, gone = mo.current_thread(), list[Note](), dict[str, str]()
        seen: list[Any] = []
        last: list[Any] = []
        while not this.should_exit:
            time.sleep(_PERIOD)
            names = dict(namespace)  # taken before the cells are seen at rest: so they were then
            cells, broken = cells_now(), notebook.unread()
            before, last = last, [*((cell.cell_id, cell.code, cell.status) for cell in cells), *broken]
            if last == seen or last != before or any(cell.busy for cell in cells):
                continue
            seen = last
            gone |= {name: cell.cell_id for cell in cells for name in cell.defs}
            notes = [*unread(broken), *unknown(cells, names, gone), *unsaid(cells, names), *unfit(cells, names)]
            known = {note.cell for note in notes}
            notes += [note for note in failed(cells, gone) if note.cell not in known]
            notes += lost(cells, names)
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


def unread(broken: Iterable[tuple[str, SyntaxError]]) -> Iterator[Note]:
    """What is no Python, in words."""
    for cell_id, error in broken:
        yield Note(cell_id, f"{mistakes.at('', error.lineno or 0, error.text or '')}: {mistakes.unread(error)}")


def unknown(
    cells: Iterable[notebook.Cell], names: Mapping[str, Any], gone: Mapping[str, str] = _NONE
) -> Iterator[Note]:
    """Names that a cell reads and none defines or two do, or that need each other, and inputs that there are not.

    What was defined before, by a cell that has a mistake now or is deleted, is in ``gone`` with the id of that cell:
    all that waits for it is told at once.
    """
    cells, waiting = list(cells), dict[str, list[tuple[str, str, str]]]()
    defined = {name for cell in cells for name in cell.defs} | set(names)
    twice = [name for name, count in Counter(name for cell in cells for name in cell.defs).items() if count > 1]
    fields = mistakes.input_names(names)
    for cell in cells:
        if names_twice := sorted(cell.defs.intersection(twice)):
            yield Note(cell.cell_id, mistakes.twice(*names_twice))
        missing, told = cell.refs - defined - set(dir(builtins)), set[str]()
        for node in _read(cell.code):
            why = ""
            if isinstance(node, ast.Attribute):
                if fields and not hasattr(names["g"], node.attr) and node.attr not in told:
                    told.add(node.attr)
                    why = mistakes.no_input(node.attr, fields)
            elif node.id in missing:
                missing = missing - {node.id}  # told once a cell
                why = mistakes.undefined(node.id, defined, fields)
                if gone.get(node.id, cell.cell_id) != cell.cell_id:  # by another cell, which tells why itself
                    place = cell.cell_id, _line(cell, node.lineno), node.id
                    waiting.setdefault(gone[node.id], []).append(place)
                    continue
            if why:
                yield Note(cell.cell_id, f"{_line(cell, node.lineno)}: {why}")
    yield from map(_lost, waiting.values())
    yield from _circular(cells)


def _circular(cells: Sequence[notebook.Cell]) -> Iterator[Note]:
    """One of the cells that need each other, none of which marimo runs: rather one that could be two cells."""
    found = ((cell, circle(cell, (c for c in cells if c is not cell), ast.parse(cell.code).body)) for cell in cells)
    told = set[str]()
    for cell, why in sorted(((cell, why) for cell, why in found if why), key=lambda each: each[1].whole):
        if told.isdisjoint(cell.defs):
            told |= depending(cells, cell.defs)
            places = (node.lineno for node in _read(cell.code) if isinstance(node, ast.Name) and node.id == why.name)
            yield Note(cell.cell_id, f"{_line(cell, next(places, 1))}: {why}")


def _lost(waiting: Sequence[tuple[str, str, str]]) -> Note:
    """What a cell no longer defines, at the first line that waits for it, and which others do."""
    lost = ", ".join(dict.fromkeys(name for *_, name in waiting))
    (cell, first), *others = dict.fromkeys((cell, line) for cell, line, _ in waiting)
    places = [line.partition(", ")[2] for _, line in others]
    more = f" and {len(places) - _LISTED} more" if len(places) > _LISTED else ""
    count = "1 other line waits" if len(places) == 1 else f"{len(places)} other lines wait"
    wait = f"; {count} for it too: {'; '.join(places[:_LISTED])}{more}" if places else ""
    return Note(cell, f"{first}: the cell that defines {lost} has a mistake or was deleted{wait}")


def failed(cells: Iterable[notebook.Cell], gone: Iterable[str] = ()) -> Iterator[Note]:
    """What else Python could not compute, with the line of the cell; what waits for names that are ``gone`` is told."""
    for cell in cells:
        if isinstance(cell.exception, NameError) and (cell.exception.name or "") in {*gone} - cell.defs:
            continue
        if cell.status == "exception" and isinstance(cell.exception, Exception):
            lines = [line for frame, line in walk_tb(cell.exception.__traceback__) if _is_of(frame, cell)]
            why = mistakes.why(cell.exception, (), cell.code)
            yield Note(cell.cell_id, f"{_line(cell, lines[-1])}: {why}" if lines else why)


def unsaid(cells: Iterable[notebook.Cell], names: Mapping[str, Any]) -> Iterator[Note]:
    """What would be left out without a word: numbers that formulas read and nothing declares, formulas not typeset.

    And while all cells have run, checks and solve blocks that none of them shows.
    """
    cells = list(cells)
    ran = [cell for cell in cells if cell.status == "success"]
    texts = source.of_texts(tuple((cell.code, cell.filename) for cell in ran))
    for n, line, why in (*left_out(texts, names), *(unseen(texts, names) if len(ran) == len(cells) else ())):
        yield Note(ran[n].cell_id, why if line is None else f"{_line(ran[n], line)}: {why}")


def lost(cells: Iterable[notebook.Cell], names: Mapping[str, Any]) -> Iterator[Note]:
    """Lines that have run and have no number, or none at some places, though what they read has."""
    for cell in cells:
        if cell.status == "success":
            with suppress(SheetError):  # what cannot be read `unsaid` tells
                for line, where in numberless(names, registry(names, source.of_texts(((cell.code, cell.filename),)))):
                    yield Note(cell.cell_id, f"{_line(cell, line.expression.lineno)}: {where}", mistake=False)


def unfit(cells: Iterable[notebook.Cell], names: Mapping[str, Any]) -> Iterator[Note]:
    """Lines of the worksheet that has run whose units do not fit, each mistake where it arises.

    What depends on the inputs is recorded, and what declares a unit or is computed with one; of cells that import or
    define classes what a recording runs again of a setup. A line whose meaning calls it an erratum is left as it is.
    While inputs are declared and not there, nothing is told.
    """
    given = beforehand(inputs_of(names))
    if not given and declared_in(names):
        return
    ran = [cell for cell in cells if cell.status == "success"]
    others = {name for cell in ran for name in cell.refs if is_of_studies(names.get(name))}
    known = registry(names, source.of_texts(tuple((cell.code, cell.filename) for cell in ran)))
    measured = {name for name, value in names.items() if isinstance(value, units.Constant) or value is units}
    setup = _setup(ran, depending(ran, {*given, *_functions(ran)}))
    of_setup = {name for n in setup for name in ran[n].defs}
    by_inputs = depending(ran, {*given, *_functions(ran), *measured, *known})
    computed = by_inputs - of_setup - depending(ran, others)
    common = {name: value for name, value in names.items() if name not in computed}
    recorded = tuple(runnable(n, cell, computed) for n, cell in enumerate(ran) if cell.defs & (computed - {*given}))
    lines = tuple(line for n in setup for line in _lines(n, ran[n]))
    assigned = tuple(line for line in lines if isinstance(line, ast.Assign | ast.AnnAssign))
    try:
        found = dimensions.of_every_line(Worksheet("", recorded, common, "", assigned, whole=lines), names, known)
    except Exception as error:
        yield Note("", f"units are not checked, as the worksheet cannot be recorded: {error}")
        return
    for mistake in found.mistakes:
        cell, line = divmod(mistake.line, _MOST)
        yield Note(ran[cell].cell_id, str(mistake._replace(line=line)))


def is_of_studies(value: Any) -> bool:
    """Whether a value is a function that computes through another worksheet."""
    return getattr(value, "__module__", "") in _OTHERS


def _functions(cells: Iterable[notebook.Cell]) -> set[str]:
    """Names of cells that define functions alone: in a recording they take quantities."""
    bodies = ((cell, ast.parse(cell.code).body) for cell in cells)
    return {name for cell, body in bodies if all(isinstance(s, ast.FunctionDef) for s in body) for name in cell.defs}


def _setup(cells: Iterable[notebook.Cell], by_inputs: set[str]) -> list[int]:
    """Positions of cells that import or define classes and do not depend on the inputs."""
    kinds = ast.Import | ast.ImportFrom | ast.ClassDef
    return [
        n
        for n, cell in enumerate(cells)
        if not cell.defs & by_inputs and any(isinstance(line, kinds) for line in ast.parse(cell.code).body)
    ]


def _lines(n: int, cell: notebook.Cell) -> list[ast.stmt]:
    """Statements of a cell, their lines counted behind those of the cells before it."""
    return ast.increment_lineno(ast.parse(cell.code), n * _MOST).body


def runnable(n: int, cell: notebook.Cell, computed: set[str]) -> Cell:
    """A cell that can be run by itself, its lines counted behind those of the cells before it."""
    lines, code = compiled(_lines(n, cell), cell.filename, f"_cell{n}")
    return Cell(cell.cell_id, frozenset(cell.refs & computed), tuple(cell.defs), (), tuple(lines), code)


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
    return mistakes.at("", number, cell.code.splitlines()[number - 1])
