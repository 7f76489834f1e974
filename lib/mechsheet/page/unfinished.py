"""What the editor keeps of a cell that failed, or waits for one that did: its lines, to be read and edited."""

import ast
from collections.abc import Mapping
from html import escape
from traceback import walk_tb
from typing import Any

import marimo as mo

from mechsheet.page import notebook, values
from mechsheet.worksheet import source
from mechsheet.worksheet.errors import SheetError
from mechsheet.worksheet.line_edit import declares
from mechsheet.worksheet.lines import Formula, formulas
from mechsheet.worksheet.typeset import Numbers, Typeset, no_number


def left(cell: notebook.Cell, error: object, namespace: Mapping[str, Any]) -> str:
    """HTML of the lines of a cell that typesets some: those above the one where it failed with their values.

    What gives something else to be shown, such as a check, stands as it is typed. Nothing where the lines cannot be
    read.
    """
    (own,) = source.of_texts(((cell.code, cell.filename),))
    if not any(call for node in own.body for call in source.calls_of(node, "typeset")):
        return ""
    try:
        rows = formulas(own)
    except SheetError:
        return ""
    end, numbers, found = _end(error, cell.filename), Numbers(namespace), ""
    for node in own.body:
        last = node.end_lineno or node.lineno
        lines = tuple(row for row in rows if node.lineno <= row.expression.lineno <= last)
        given = tuple(_number(row, namespace) if isinstance(row, Formula) and last < end else None for row in lines)
        part = Typeset(lines, given, (), numbers) if lines else _as_typed(cell.code, node)
        text = values.html(Typeset((), (), (part,))) if part else ""
        found += text if last < end else f'<div class="ms-waits">{text}</div>' if text else ""
    return found


def _number(row: Formula, namespace: Mapping[str, Any]) -> Any:
    """The value of a line; none of one that has no number, which may be what failed."""
    value = namespace.get(row.name)
    return None if no_number(row, value) else value


def _end(error: object, filename: str) -> int:
    """The line of a cell in which it failed; 0 of one that was not begun."""
    trace = walk_tb(error.__traceback__) if isinstance(error, BaseException) else ()
    return next((n for f, n in trace if (f.f_code.co_filename, f.f_code.co_name) == (filename, "<module>")), 0)


def _as_typed(code: str, node: ast.stmt) -> object:
    """A text among the lines, or a line that gives what is no formula, to be clicked; nothing of any other one."""
    names = [name for name in sorted(declares(node)) if not name.startswith("_")]
    if names:
        typed = escape(ast.get_source_segment(code, node) or "")
        return mo.Html(f'<div class="ms-line ms-typed" tabindex="0" data-line="{names[0]}"><code>{typed}</code></div>')
    return next((text.value for text in source.standing([node])), "")
