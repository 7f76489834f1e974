"""A line edited where it stands on the page of the editor: what it would be as one types, then written into the file.

What the page asks comes as the text of a field, the answer stands in an element beside it, for ``in_place.js``.
"""

import ast
import json
import linecache
import re
import warnings
from collections.abc import Callable, Iterable, Iterator, Sequence, Set
from concurrent.futures import Future
from contextlib import suppress
from copy import deepcopy
from ctypes import c_ulong, py_object, pythonapi
from dataclasses import replace
from html import escape
from itertools import chain
from pathlib import Path
from threading import Thread
from typing import Any

import marimo as mo
import numpy as np

from mechsheet import units
from mechsheet.document.markup import as_written
from mechsheet.document.numberless import numberless
from mechsheet.page import bounded, editor, fields, notebook, values
from mechsheet.page.needing import needing
from mechsheet.page.script import element, script
from mechsheet.workbook.save import save
from mechsheet.worksheet import inputs, mistakes, scene, source
from mechsheet.worksheet.errors import SheetError, some
from mechsheet.worksheet.line_edit import (
    OF_INPUT,
    Change,
    asked_for,
    change,
    changed,
    declares,
    imported,
    line,
    same_cells,
)
from mechsheet.worksheet.lines import Formula, formulas
from mechsheet.worksheet.numbers import on_page
from mechsheet.worksheet.renaming import renamed
from mechsheet.worksheet.shown import Shown
from mechsheet.worksheet.typeset import Numbers, Typeset, no_number

_FILE = "__marimo__cell_in_place"  # under which a line is compiled
_LINE = re.compile(r"line (\d+), ")
_PATIENCE = 3  # seconds that a line may compute as one types
_ALTERED = (np.ndarray, list, dict, set)  # what a line may alter, of which it is given a copy
_BREAKS = "<i></i>"  # in the HTML of a line in which its cell would fail
_UNSAVED = "a cell holds text that is not saved: run it and save it (Ctrl+S), then write here"


class InPlace:
    """The field that takes what the page asks, and the answer to it; ``redraw`` is called with a new answer."""

    def __init__(self, namespace: dict[str, Any], redraw: Callable[[], object]) -> None:
        self.namespace, self.redraw = namespace, redraw
        self.path = Path(namespace["__file__"])
        self.answer: dict[str, Any] = {}
        self.scenes: dict[tuple[str, ...], dict[Path, tuple[str, str]]] = {}
        self.field = mo.ui.text_area(on_change=self.asked)
        # Of what is read as one types, by its name: the cell of a line that is written warns itself.
        warnings.filterwarnings("ignore", "", SyntaxWarning, f"<unknown>|{_FILE}")

    @property
    def shown(self) -> mo.Html:
        """What stands in the page, out of sight."""
        answer = json.dumps(self.answer, ensure_ascii=False)
        return mo.Html(
            f"{script('in_place.js')}<div hidden>{element('ms-in-place', answer=answer)}{self.field.text}</div>"
        )

    def asked(self, text: str) -> None:
        """Answer what the page asks: a line as it stands, what a text would be, to write it, what needs a cell."""
        asked = json.loads(text)
        try:
            found = self.done(**{key: value for key, value in asked.items() if key != "number"})
        except SheetError as error:
            found = {"why": on_page(str(error))}
        except Exception as error:  # of the library: the page is told, which waits for an answer
            found = {"why": mistakes.why(error, ())}
        self.answer = {"number": asked["number"], **found}
        self.redraw()

    def done(
        self,
        do: str,
        name: str = "",
        was: str = "",
        new: str = "",
        below: bool = False,
        sure: bool = False,
        everywhere: bool = False,
        **parts: Sequence[str],
    ) -> Any:
        """What the page is told of what it asked; a name that a line lets go may be another one ``everywhere``."""
        text, new = self.path.read_bytes().decode(), new.strip()
        match do:
            case "open":
                return {"line": line(text, name), "why": "" if self.is_taken(text) else _UNSAVED}
            case "type":
                made = change(text, name, was, new, below)
                needed = not below and _needing(made.of(text), name, was, new)
                renames = _renames(was, new) if needed else []
                return {"shown": self.preview(text, made, name, was, new, below), "renames": renames}
            case "taken":
                return {"taken": self.is_taken(text)}
            case "cell":
                return {"asks": _needed(text, name)}
        if not self.is_taken(text):
            raise SheetError(_UNSAVED)
        if everywhere:
            return self.rename(text, name, was, new)
        told = Change(**parts) if do == "undo" else change(text, name, was, new, below)
        if do == "write" and not sure and (need := _needing(told.of(text), name, was, was if below else new)):
            return {"asks": need, "renames": _renames(was, new)}
        if do == "write" and not sure and new and not below and _is_shown(was) and not _is_shown(new):
            return {"asks": "without its [unit] it is not shown, and no table takes it"}
        if do == "write" and not sure and self.breaks(text, told, name, was, new, below):
            return {"asks": "it has no value, and without one nor has what stands below it in its cell"}
        if do == "write" and name.startswith(OF_INPUT):
            self.preview(text, told, name, was, new, below)  # without inputs there is nothing: a mistake refuses them
        save(told.of(self.path.read_bytes().decode()).encode(), self.path)  # the editor may have saved it meanwhile
        for path, (now, former) in self.scenes.pop(tuple(told.after), {}).items() if do == "undo" else ():
            if path.is_file() and path.read_bytes().decode() == now:
                save(former.encode(), path)
        return {"written": told._asdict()}

    def rename(self, text: str, name: str, was: str, new: str) -> Any:
        """Write a line that gives its name another one, and that one in all others, and in the scenes beside the file.

        Texts of the scenes, now and before, are kept by what the change was made of, for it to be taken back.
        """
        old, other = _renames(was, new)
        made = renamed(self.path, old, other, scene.texts_beside(self.path))
        renamed_name = name.removesuffix(old) + other
        whole = made.pop(self.path)
        whole = change(whole, renamed_name, line(whole, renamed_name), new).of(whole)
        told = changed(text, whole)
        self.scenes[tuple(told.before)] = {path: (now, path.read_bytes().decode()) for path, now in made.items()}
        for path, now in {self.path: whole, **made}.items():
            save(now.encode(), path)
        return {"written": told._asdict()}

    def breaks(self, text: str, told: Change, name: str, was: str, new: str, below: bool) -> bool:
        """Whether the cell of a line that is written would fail in it."""
        if new and not name.startswith(OF_INPUT):
            with suppress(SheetError):  # it is not known of what computes for long
                return _BREAKS in self.preview(text, told, name, was, new, below)
        return False

    def is_taken(self, text: str) -> bool:
        """Whether the cells of the page are those of the file."""
        try:
            cells = notebook.running()[0]()
        except notebook.Unlike as error:
            raise SheetError(f"this marimo tells nothing of its cells ({error}): edit the code of the cell") from None
        return same_cells(text, (cell.code for cell in cells))

    def preview(self, text: str, told: Change, name: str, was: str, new: str, below: bool) -> str:
        """HTML of a line: as it is typeset with its value, its mistakes, and what the setup imports with it."""
        cells = notebook.running()[0]()
        if not new:
            return escape(_needing(told.of(text), name, was, "") or f"{name.removeprefix(OF_INPUT)} goes")
        names, lines = dict(self.namespace), imported(text, new)
        exec("\n".join(lines), names)
        if name.startswith(OF_INPUT):
            shown = _elsewhere(lambda: _input(told.of(text), new, names))
        else:
            shown = _elsewhere(lambda: _computed(cells, name, was, new, below, names))
        return shown + "".join(f"<div>{values.NOTE} the setup gets {escape(line)}</div>" for line in lines)


def _is_shown(text: str) -> bool:
    """Whether a line is typeset as a formula."""
    return any(isinstance(row, Formula) for row in formulas(source.of_texts(((text, _FILE),))[0]))


class _TooLong(BaseException):
    """Work has taken longer than one who types waits; no error, which a line might catch."""


def _elsewhere(work: Callable[[], str]) -> str:
    """What some work gives in a thread of no page: what is refused there is raised.

    Raises SheetError where that takes long; the thread ends with its next step in Python.
    """
    done: Future[str] = Future()

    def run() -> None:
        try:
            done.set_result(work())
        except SystemExit:  # which would end the page's process
            done.set_exception(SheetError("it ends the program: nothing would be computed"))
        except BaseException as error:
            done.set_exception(error)

    thread = Thread(target=run, daemon=True)  # that of a step which never ends would keep the page's process
    thread.start()
    try:
        return done.result(_PATIENCE)
    except TimeoutError:
        pythonapi.PyThreadState_SetAsyncExc(c_ulong(thread.ident or 0), py_object(_TooLong))
        raise SheetError(f"it computes for more than {_PATIENCE} s") from None


def _run(text: str, names: dict[str, Any]) -> None:
    """Run a text whose lines can be read as those of a cell."""
    linecache.cache[_FILE] = len(text), None, text.splitlines(keepends=True), _FILE
    code, more = bounded.compiled(text, _FILE)
    names.update(more)
    with np.errstate(all="ignore"):
        exec(code, names)


def _computed(cells: Iterable[notebook.Cell], name: str, was: str, new: str, below: bool, names: dict[str, Any]) -> str:
    """HTML of a formula computed with the names of the page, and its mistakes."""
    known, told, breaks, bound = set(names), list[str](), False, declares(ast.parse(new).body[0])
    above, rest = _parted(cells, name, was, below)
    late = {*chain(*map(source.bound, rest))}.difference(*map(source.bound, above))  # which it cannot read
    names = {each: value for each, value in names.items() if each not in late}
    rows = formulas(source.of_texts(((new, _FILE),))[0])
    read = {node.id for node in ast.walk(ast.parse(new)) if isinstance(node, ast.Name)}
    names |= {each: deepcopy(names[each]) for each in read if isinstance(names.get(each), _ALTERED)}
    if slow := sorted(each for each in read if editor.is_of_studies(names.get(each))):
        told.append(f"{slow[0]} computes for long: the value follows once the line is written")
    else:
        try:
            _run(_private(above, read), names)
            _run(new, names)
            told += filter(None, (no_number(row, names[row.name]) for row in rows if isinstance(row, Formula)))
        except Exception as error:
            lacks = str(error.name) if isinstance(error, NameError) else ""
            why = mistakes.why(error, known, new, mistakes.input_names(names))
            told.append(mistakes.late(lacks, lacks in bound) if lacks in late else why)
            breaks = True
    there = tuple(row for row in rows if not told or not isinstance(row, Formula))
    numbers = tuple(names[row.name] if isinstance(row, Formula) else None for row in there)
    shown = values.html(Typeset(there, numbers, (), Numbers(names)))
    if not told:
        given = chain.from_iterable(_several(names[each]) for each in sorted(bound))
        shown += "".join(values.html(each) for each in given if isinstance(each, Shown))
        said = {row.mistake for row in rows if isinstance(row, Formula)}  # which stands behind its value
        unfit = _unfit(cells, name, was, f"{was}\n{new}" if below else new, new, names)
        told += (text for text in unfit if text.partition(": ")[2] not in said)
        if not shown:
            told.append("it is not shown in the document: end the line in # [unit] meaning")
        own = {row.name: row for row in rows if isinstance(row, Formula) and row.has_value}
        shown += "".join(f"<div>{values.NOTE} {escape(where)}</div>" for _, where in numberless(names, own))
    return shown + _BREAKS * breaks + "".join(map(_mistake, told))


def _several(value: Any) -> Sequence[Any]:
    """What a line gives, which may be several checks."""
    return value if isinstance(value, list | tuple) else (value,)


def _parted(cells: Iterable[notebook.Cell], name: str, was: str, below: bool) -> tuple[list[ast.stmt], list[ast.stmt]]:
    """Statements of the cell of a line above it, and from it on."""
    for cell in cells:
        if name in cell.defs and was in cell.code:
            body = ast.parse(cell.code).body
            at = next((n for n, node in enumerate(body) if name in declares(node)), len(body)) + below
            return body[:at], body[at:]
    return [], []


def _private(above: Iterable[ast.stmt], read: Set[str]) -> str:
    """What gives the names with ``_`` that a line reads: marimo forgets those that a cell keeps to itself."""
    kept, needed = list[str](), {name for name in read if name.startswith("_")}
    for node in reversed([*above]) if needed else ():
        if not needed.isdisjoint(bound := source.bound(node)) and all(name.startswith("_") for name in bound):
            kept.insert(0, ast.unparse(node))
            needed |= {each.id for each in ast.walk(node) if isinstance(each, ast.Name) and each.id.startswith("_")}
    return "\n".join(kept)


def _unfit(
    cells: Iterable[notebook.Cell], name: str, was: str, made: str, new: str, names: dict[str, Any]
) -> Iterator[str]:
    """What does not fit in the units of a line in its cell."""
    changed, its, lines = list[notebook.Cell](), "", range(0)
    for cell in cells:
        if name in cell.defs and was in cell.code:
            code = cell.code.replace(was, made, 1)
            own = {node for node in ast.walk(ast.parse(new)) if isinstance(node, ast.Name)}
            refs = cell.refs | {node.id for node in own if isinstance(node.ctx, ast.Load)}
            defs = cell.defs | {*declares(ast.parse(new).body[0])}
            first = code[: code.index(made) + len(made) - len(new)].count("\n") + 1
            lines, its = range(first, first + new.count("\n") + 1), cell.cell_id
            cell = replace(cell, code=code, filename=_FILE, refs=refs - defs, defs=defs)
        changed.append(cell)
    for note in editor.unfit(changed, names):
        if (match := _LINE.match(note.text)) and note.cell == its and int(match[1]) in lines:
            yield note.text[match.end() :]


def _input(made: str, new: str, names: dict[str, Any]) -> str:
    """HTML of an input as the class of the worksheet declares it."""
    holder = asked_for(made)
    _run(holder, names)
    cls, field = ast.parse(holder).body[0], ast.parse(new).body[0]
    assert isinstance(cls, ast.ClassDef) and isinstance(field, ast.AnnAssign)
    g = names[cls.name]()
    (own,) = (each for each in inputs.declared(type(g)) if each.name == ast.unparse(field.target))
    unit = "" if own.unit == "-" else units.shown(own.unit)
    number = f"{as_written(own.name)} = {escape(own.brief(getattr(g, own.name)))} {escape(unit)}"
    return f'<div class="ms-line"><b>{number}</b><span>{fields.said(own)}</span></div>'


def _needing(text: str, name: str, was: str, new: str) -> str:
    """What needs the names that a line no longer declares once it is another one; nothing where nothing does."""
    before = OF_INPUT if name.startswith(OF_INPUT) else ""
    gone = sorted({before + own for own in _declared(was) - _declared(new)})
    places = needing(text, gone) if gone else ""
    return _go([own.removeprefix(OF_INPUT) for own in gone], places) if places else ""


def _renames(was: str, new: str) -> list[str]:
    """The name that a line has no longer, and the one that it has instead; nothing where it has several."""
    before, after = _declared(was), _declared(new)
    both = [*(before - after), *(after - before)]
    return both if len(before - after) == len(after - before) == 1 else []


def _needed(text: str, cell_id: str) -> str:
    """What needs names that a cell of the page defines; nothing where nothing else does."""
    cells = notebook.running()[0]()
    gone = {name for cell in cells if cell.cell_id == cell_id for name in cell.defs}
    others = [cell for cell in cells if cell.cell_id != cell_id]
    lost = sorted(name for name in gone if any(name in cell.refs for cell in others))
    places = needing(text, gone, whole=True) if lost else ""
    return _go(lost, places or "another cell") if lost else ""


def _go(names: Sequence[str], places: str) -> str:
    return f"{', '.join(some(names))} {'goes' if len(names) == 1 else 'go'}, needed in {places}"


def _declared(line: str) -> set[str]:
    return {name for node in ast.parse(line).body for name in declares(node)}


def _mistake(text: str) -> str:
    return f"<div>{values.MISTAKE} {escape(text)}</div>"
