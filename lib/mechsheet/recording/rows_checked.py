"""Checks of each row of a table, on a page where rows are put in or taken out: of a row put in there is none."""

from collections.abc import Callable
from contextvars import ContextVar
from types import FunctionType
from typing import Any

from mechsheet.quantities.graph import Guard, current
from mechsheet.quantities.quantity import Quantity
from mechsheet.recording import per_row

exists: ContextVar[Quantity | None] = ContextVar("exists", default=None)  # whether there is the row that is checked


def checked(f: FunctionType, plainly: Callable[..., Any], *sources: Any) -> Any:
    """What ``f`` gives for each row, a check: those of the rows before the last one are judged while there are these.

    That of the last one is not known for another number of rows: so not all of them pass where one is not looked at.
    """
    graph = current.get()
    if not graph.draws or graph.supposed or not per_row.are_rows(sources):
        return plainly(*sources)
    column = per_row.first_of(sources[0])
    count, rows = column.count(0), column.extent[0]
    as_many = count == rows
    why = f"row {rows} and those behind it have no check for another number of rows: make the page again with these"
    graph.numbered.setdefault(as_many.re, Guard(as_many.re, graph.line, why=why))
    found = list[Any]()
    for k in range(rows):
        known = exists.set(as_many if k == rows - 1 else count > k)
        try:
            found.append(f(*(source[k] for source in sources)))
        finally:
            exists.reset(known)
    return found


CALLS: dict[str, Any] = {"checked": checked}
