"""The cells of the page as it stands, which marimo tells under no public name: all that is taken of its private parts.

A version of marimo that keeps them otherwise makes `running` raise `Unlike`, and nothing else rests on them.
"""

import ast
import builtins
import re
from collections.abc import AsyncIterator, Callable, Mapping, Set
from contextlib import asynccontextmanager, suppress
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from types import MappingProxyType
from typing import Any
from weakref import WeakKeyDictionary, WeakSet

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
    """What gives the cells of the calling cell's page as they are now, and the namespace in which they run.

    Raises Unlike where there is no page, too.
    """
    try:
        from marimo._runtime.context import ContextNotInitializedError, get_context  # on use: a version may lack them
    except ImportError as error:
        raise Unlike(str(error)) from None
    try:
        notebook: Any = get_context()
        graph, namespace = notebook.graph, notebook.globals
    except (ContextNotInitializedError, AttributeError) as error:  # there is no page, or it has none of these
        raise Unlike(str(error)) from None

    def cells() -> tuple[Cell, ...]:
        try:
            with graph.lock:
                return tuple(map(_cell, graph.cells.values()))
        except AttributeError as error:
            raise Unlike(str(error)) from None

    return cells, namespace


def unread() -> tuple[tuple[str, SyntaxError], ...]:
    """Cells of the calling cell's page that are no Python, by their ids; none where this marimo does not tell."""
    try:
        from marimo._messaging.errors import MarimoSyntaxError  # on use, as this: a version may lack it
        from marimo._runtime.context import get_context  # on use

        errors: dict[Any, Any] = get_context()._kernel.errors  # type: ignore[attr-defined]
        told = [(str(cell_id), each) for cell_id, these in list(errors.items()) for each in these]
        return tuple([(at, _printed(each.msg)) for at, each in told if isinstance(each, MarimoSyntaxError)])
    except (ImportError, AttributeError):
        return ()


@lru_cache
def _printed(text: str) -> SyntaxError:
    """What cannot be read, from what Python prints of it: number and text of a line, a mark beneath, and why."""
    found = _OF_SYNTAX.search(text)
    if not found:
        return SyntaxError(text, ("", 0, 0, ""))
    number, line, mark, why = found.groups()
    return SyntaxError(why, ("", int(number), len(mark or "") + 1, line))


_OF_SYNTAX = re.compile(r"line (\d+)\n(?: {4}(.*)\n(?: {4}( *)[\^~]+ *\n)?)?(?:\w*Error: )(.*)")


def stopped(cell_id: str = "") -> tuple[tuple[source.Cell, ...], tuple[Cell, ...], str]:
    """Cells of the file of the calling cell's page, those of the page, and the id of a cell: of none, of that cell.

    Nothing where this version of marimo does not tell, or the file cannot be read.
    """
    try:
        from marimo._runtime.context import get_context  # on use: a version may lack it

        cells, namespace = running()
        return source.of_file(namespace), cells(), cell_id or str(get_context().cell_id or "")
    except (ImportError, AttributeError, Unlike, SyntaxError, OSError):
        return (), (), ""


def is_setup() -> bool:
    """Whether the calling cell is the setup; not where this version of marimo does not tell."""
    try:
        from marimo._ast.names import SETUP_CELL_NAME  # on use, as this: a version may lack it
        from marimo._runtime.context import get_context  # on use

        return str(get_context().cell_id) == SETUP_CELL_NAME
    except (ImportError, AttributeError):
        return False


def tell_of_failures(
    told: Callable[[object, str, Mapping[str, Any]], str], kept: Callable[[str, Mapping[str, Any]], str]
) -> None:
    """Let every page that this process serves show in the place of a cell that failed the HTML that is ``told`` of it.

    It is told the exception, or what marimo has for it, the id of the cell and the namespace of the page. In the place
    of a cell that waits for the failed one stands what is ``kept`` of its code. Where they tell nothing, and where this
    version of marimo has no such place, all stays as it is.
    """
    try:
        from marimo._messaging.cell_output import CellChannel  # on use, as all of these: a version may lack it
        from marimo._messaging.notification_utils import CellNotificationUtils  # on use
        from marimo._runtime.context import get_context  # on use
        from marimo._runtime.runner.hooks import Priority  # on use
        from marimo._runtime.runtime import _KERNEL_LIFESPAN_REGISTRY  # on use
    except ImportError:
        return

    def show(cell_id: Any, html: str) -> None:
        if html:
            # The page leaves out what was stopped until it runs, and an error until its cell waits for its next run.
            CellNotificationUtils.broadcast_status(cell_id, "running")
            CellNotificationUtils.broadcast_output(CellChannel.OUTPUT, "text/html", html, cell_id, "queued")
            CellNotificationUtils.broadcast_status(cell_id, "idle")

    @asynccontextmanager
    async def page(_: None) -> AsyncIterator[None]:
        notebook: Any = get_context()
        kernel, seen = notebook._kernel, set[Any]()

        def raised(cell: Any, _: object, result: Any) -> None:
            if result.exception is not None:
                show(cell.cell_id, told(result.exception, str(cell.cell_id), notebook.globals))

        def unread(ended: Any) -> None:  # of cells that cannot even be run, and of those that were not run
            for cell_id, (error, *_more) in kernel.errors.items():
                if cell_id not in seen:
                    show(cell_id, told(error, str(cell_id), notebook.globals))
            seen.update(kernel.errors)
            waiting = ended.cancelled_cells
            for cell_id in {each for failed in waiting for each in waiting[failed]}:
                show(cell_id, kept(notebook.graph.cells[cell_id].code, notebook.globals))

        kernel._hooks.add_post_execution(raised, Priority.LATE)
        kernel._hooks.add_on_finish(unread, Priority.LATE)
        yield

    with suppress(AttributeError):
        _KERNEL_LIFESPAN_REGISTRY.register("mechsheet", page)


def compute_what_lost_a_name() -> None:
    """Let the calling page of the editor compute again what reads a name that no cell defines any more.

    marimo does not where the file was changed elsewhere: these cells would show their former numbers, as they do where
    this version of marimo keeps its cells otherwise.
    """
    try:
        from marimo._runtime.commands import ExecuteCellsCommand  # on use, as all of these: a version may lack it
        from marimo._runtime.context import get_context  # on use
        from marimo._runtime.runner.hooks import Priority  # on use

        kernel: Any = get_context()._kernel  # type: ignore[attr-defined]
        hooks, graph, ask = kernel._hooks, kernel.graph, kernel.enqueue_control_request
    except (ImportError, AttributeError):
        return
    if kernel in _looked_after:
        return
    _looked_after.add(kernel)
    asked = dict[Any, object]()

    def ended(_: Any) -> None:
        again = list[Any]()
        for cell_id, cell in graph.cells.items():
            lost = {name for name in cell.refs if name not in kernel.globals and not hasattr(builtins, name)}
            state = cell.code, lost
            if lost and cell.run_result_status == "success" and asked.get(cell_id) != state:
                asked[cell_id] = state  # it may do without
                again.append(cell_id)
        if again:
            ask(ExecuteCellsCommand(cell_ids=again, codes=[graph.cells[each].code for each in again]))

    hooks.add_on_finish(ended, Priority.LATE)


_looked_after = WeakSet[Any]()  # kernels of pages


def follow(changed: Callable[[], object]) -> None:
    """Let the calling cell show what it may show anew, in its place, whenever cells of its page have run.

    Its `globals()` tell marimo nothing of what it reads: it may run before the cells that define that, or not at all.
    Nothing is shown anew of a cell that failed, nor where this version of marimo keeps its cells otherwise.
    """
    try:
        from marimo._runtime.context import get_context  # on use, as all of these: a version may lack it
        from marimo._runtime.context.types import ExecutionContext  # on use
        from marimo._runtime.runner.hooks import Priority  # on use

        notebook: Any = get_context()
        kernel, cell_id = notebook._kernel, notebook.cell_id
        hooks, graph = kernel._hooks, kernel.graph
    except (ImportError, AttributeError):
        return
    following = kernel in _following
    _following.setdefault(kernel, {})[cell_id] = changed
    if following:
        return

    def ended(_: Any) -> None:
        for at, show in _following[kernel].items():
            if at in graph.cells and graph.cells[at].run_result_status == "success":
                # As while a value of it is set: else its threads may not read the values of its own fields.
                notebook.execution_context = ExecutionContext(at, True)
                try:
                    show()
                finally:
                    notebook.execution_context = None

    hooks.add_on_finish(ended, Priority.LATE)


_following = WeakKeyDictionary[Any, dict[Any, Callable[[], object]]]()  # by kernels of pages and ids of cells


def keep_unfinished(left: Callable[[Cell, object, Mapping[str, Any]], str]) -> Callable[[], None]:
    """Let the calling page of the editor show HTML that is ``left`` of each cell that failed or waits for one that did.

    It is told the cell, what it has raised and the namespace of the page, and stands below what marimo tells. Returned
    is what shows it of cells that have run before; it does nothing where this version of marimo has no such place.
    """
    try:
        from marimo._messaging.cell_output import CellChannel  # on use, as all of these: a version may lack it
        from marimo._messaging.notification_utils import CellNotificationUtils  # on use
        from marimo._runtime.context import get_context  # on use
        from marimo._runtime.runner.hooks import Priority  # on use

        kernel: Any = get_context()._kernel  # type: ignore[attr-defined]
        hooks, graph, namespace = kernel._hooks, kernel.graph, kernel.globals
    except (ImportError, AttributeError):
        return lambda: None
    if kernel in _keeping:
        return _keeping[kernel]
    there = set[Any]()  # cells below which it stands

    def show(raised: Mapping[Any, object] = MappingProxyType({}), waiting: Set[Any] = frozenset()) -> None:
        for cell_id, cell in list(graph.cells.items()):
            if cell.run_result_status not in ("exception", "cancelled"):
                there.discard(cell_id)
            elif cell_id not in there or cell_id in raised or cell_id in waiting:
                there.add(cell_id)
                if html := left(_cell(cell), raised.get(cell_id, cell.exception), namespace):
                    CellNotificationUtils.broadcast_console_output(CellChannel.MEDIA, "text/html", html, cell_id, None)

    def ended(run: Any) -> None:
        show(run.exceptions, {each for failed in run.cancelled_cells for each in run.cancelled_cells[failed]})

    hooks.add_on_finish(ended, Priority.LATE)
    return _keeping.setdefault(kernel, show)


_keeping = WeakKeyDictionary[Any, Callable[[], None]]()  # by kernels of pages


def run_what_is_written(server: Any) -> None:
    """Let the editor run a line that is written in place, whatever settings lie beside the worksheet.

    Where this version of marimo keeps its settings otherwise, the page says that the line waits to be run.
    """
    with suppress(AttributeError):
        known = server.state.config_manager
        known.partials = known.with_overrides({"runtime": {"watcher_on_save": "autorun"}}).partials


def is_served(server: Any) -> bool:
    """Whether the pages of a server are read and not edited; no where this version of marimo does not tell."""
    try:
        return bool(server.state.session_manager.mode == "run")
    except AttributeError:
        return False


def leave(scope: Any) -> None:
    """Close the session which a page of a server before this one opens here, by a request of it.

    Nothing of it is ever computed, for such a page is refused all else, and the page that is loaded again was given it.
    """
    with suppress(AttributeError, KeyError):
        sessions, told = scope["app"].state.session_manager, dict(scope["headers"])
        if told[b"marimo-server-token"].decode() != str(sessions.skew_protection_token):
            sessions.close_session(told[b"marimo-session-id"].decode())


async def take_over(scope: Any) -> Mapping[str, str | None]:
    """Let a page of the editor hold what was written into its file before a request of it is heard.

    marimo looks at a file once a second: what was typed until then would go with what comes from there, and what the
    page saves would go over it. Returned are the texts that cells of the page have got from the file, by their ids
    (none: the cell is no more), until it tells of texts that it has. Nothing is taken over where no file is watched.
    """
    with suppress(AttributeError, KeyError, OSError):
        sessions = scope["app"].state.session_manager
        session = sessions.get_session(dict(scope["headers"])[b"marimo-session-id"].decode())
        manager, document = session.app_file_manager, session.document
        if not (sessions.watch and manager.path):  # a new notebook has no file yet
            return {}
        now = Path(manager.path).stat().st_mtime_ns
        before, _seen[session] = _seen.get(session, now), now
        if now != before and not manager.file_content_matches_last_save():
            had = {cell.id: cell.code for cell in document.cells}
            await sessions.trigger_file_change(manager.path)
            has = {cell.id: cell.code for cell in document.cells}
            _brought[session] = {each: has.get(each) for each in had | has if had.get(each) != has.get(each)}
        elif scope["path"].endswith("/api/document/transaction"):
            _brought.pop(session, None)
        return _brought.get(session, {})
    return {}


_seen = WeakKeyDictionary[Any, int]()  # by sessions of pages, when their files were written
_brought = WeakKeyDictionary[Any, dict[str, str | None]]()  # by the same, texts of cells by their ids


def send_as_it_is(server: Any) -> None:
    """Let a server that only this machine can reach not pack what it sends: that takes longer than sending it."""
    with suppress(AttributeError):
        config = server.state.server.config
        config.ws_per_message_deflate = config.host not in ("127.0.0.1", "localhost", "::1")


def file() -> Path:
    """The file of the page that runs; none where this version of marimo does not tell."""
    try:
        return Path(running()[1].get("__file__", ""))
    except Unlike:
        return Path()


def shows(name: str) -> bool:
    """Whether a cell of the calling cell's page may show what a name gives; no where this marimo does not tell."""
    try:
        from marimo._runtime.context import get_context  # on use: a version may lack it

        notebook: Any = get_context()
        cells = [cell for cell in list(notebook.graph.cells.values()) if name in cell.refs]
        return any(_is_kept(cell.code, name) for cell in cells)
    except (ImportError, AttributeError):
        return False


@lru_cache
def _is_kept(code: str, name: str) -> bool:
    """Whether a cell reads a name elsewhere than in lines above its last whose value nobody takes."""
    *above, last = ast.parse(code).body
    kept = [last, *(node for node in above if not isinstance(node, ast.Expr))]
    return any(isinstance(part, ast.Name) and part.id == name for node in kept for part in source.nodes(node))


def is_first() -> bool:
    """Whether the calling cell, in this run of it, is the page's first to ask; it is again until it is edited or gone.

    No where this version of marimo does not tell.
    """
    try:
        from marimo._runtime.context import get_context  # on use: a version may lack it

        notebook: Any = get_context()
        graph, run = notebook.graph, notebook.execution_context
        cell = graph.cells[notebook.cell_id]
    except (ImportError, AttributeError, KeyError):
        return False
    known = _first.get(id(graph))
    if known and known[0] is graph and graph.cells.get(known[1].cell_id) is known[1]:
        if known[1] is not cell or known[2] is run:
            return False
    elif len(_first) == _PAGES:
        _first.clear()
    _first[id(graph)] = graph, cell, run
    return True


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
        graph = notebook.graph
        cells = list(graph.cells.values())
        known = _texts.get(id(graph))
        if not known or known[0] != cells:  # a cell that is edited is another one
            if len(_texts) == _PAGES:
                _texts.clear()
            known = _texts[id(graph)] = cells, tuple([(cell.code, _filename(cell)) for cell in cells])
        return known[1]
    except (ImportError, AttributeError):
        return None


# Texts of the cells of each page, by the identity of what holds them: they are asked for by every line of an output.
_texts: dict[int, tuple[list[Any], tuple[tuple[str, str], ...]]] = {}
_PAGES = 32
# Of each page, by the same, the cell that was its first to ask, and that run of it.
_first: dict[int, tuple[Any, Any, object]] = {}


def _filename(cell: Any) -> str:
    return str(cell.body.co_filename) if cell.body else ""


def _cell(cell: Any) -> Cell:
    busy = cell.runtime_state in ("running", "queued")
    names = frozenset(cell.defs), frozenset(cell.refs)
    return Cell(cell.cell_id, cell.code, _filename(cell), *names, cell.run_result_status, cell.exception, busy)
