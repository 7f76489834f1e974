"""The cells of the page as it stands, which marimo tells under no public name: all that is taken of its private parts.

A version of marimo that keeps them otherwise makes `running` raise `Unlike`, and nothing else rests on them.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import marimo as mo

from mechsheet.worksheet import source


class Unlike(Exception):
    """This version of marimo keeps its cells in another way."""


@dataclass(frozen=True)
class Cell:
    """A cell: its text, names it defines and reads, and what became of it; ``busy`` until that is known."""

    cell_id: str
    code: str
    filename: str  # under which it is compiled
    defs: frozenset[str]
    refs: frozenset[str]
    status: str | None
    exception: object
    busy: bool


def running() -> tuple[Callable[[], tuple[Cell, ...]], dict[str, Any]]:
    """What gives the cells of the calling cell's page as they are now, and the namespace in which they run."""
    try:
        from marimo._runtime.context import get_context  # on use: a version may lack it

        notebook: Any = get_context()
        graph, namespace = notebook.graph, notebook.globals
    except (ImportError, AttributeError) as error:
        raise Unlike(str(error)) from None

    def cells() -> tuple[Cell, ...]:
        try:
            with graph.lock:
                return tuple(map(_cell, graph.cells.values()))
        except AttributeError as error:
            raise Unlike(str(error)) from None

    return cells, namespace


def stopped() -> tuple[tuple[source.Cell, ...], tuple[Cell, ...], str]:
    """Cells of the file of the calling cell's page, those of the page, and the id of that cell.

    Nothing where this version of marimo does not tell.
    """
    try:
        from marimo._runtime.context import get_context  # on use: a version may lack it

        cells, namespace = running()
        return source.of_file(namespace), cells(), str(get_context().cell_id or "")
    except (ImportError, AttributeError, Unlike):
        return (), (), ""


def reads(name: str) -> bool:
    """Whether a cell of the calling cell's page reads a name; no where this version of marimo does not tell."""
    try:
        from marimo._runtime.context import get_context  # on use: a version may lack it

        notebook: Any = get_context()
        return any(name in cell.refs for cell in list(notebook.graph.cells.values()))
    except (ImportError, AttributeError):
        return False


def texts(namespace: Mapping[str, Any]) -> tuple[tuple[str, str], ...] | None:
    """Texts of the cells of the page that runs in a namespace, each with the name under which it is compiled.

    None where none does, or this version of marimo tells nothing of it: then the file of the worksheet holds.
    """
    if not mo.running_in_notebook():
        return None
    try:
        from marimo._runtime.context import get_context  # on use: a version may lack it

        notebook: Any = get_context()
        if notebook.globals is not namespace:
            return None
        return tuple([(cell.code, _filename(cell)) for cell in list(notebook.graph.cells.values())])
    except (ImportError, AttributeError):
        return None


def _filename(cell: Any) -> str:
    return str(cell.body.co_filename) if cell.body else ""


def _cell(cell: Any) -> Cell:
    busy = cell.runtime_state in ("running", "queued")
    names = frozenset(cell.defs), frozenset(cell.refs)
    return Cell(cell.cell_id, cell.code, _filename(cell), *names, cell.run_result_status, cell.exception, busy)
