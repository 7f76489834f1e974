"""What in a worksheet needs a name that is to go: its sections, tables and figures, whatever lies between."""

import ast
from collections.abc import Collection
from typing import NamedTuple

from mechsheet.page.waiting import headings, short
from mechsheet.worksheet import source
from mechsheet.worksheet.depending import depending, read
from mechsheet.worksheet.errors import some
from mechsheet.worksheet.line_edit import declares

_CAPTIONED = ("table", "figure")


class _Line(NamedTuple):
    code: ast.stmt
    refs: set[str]
    defs: set[str]


def needing(text: str, gone: Collection[str], whole: bool = False) -> str:
    """Sections, tables and figures of a worksheet that need names, ``g.NAME`` of an input; nothing where none does.

    Where the names go with their ``whole`` cells, what these need themselves goes too.
    """
    cells = [
        [_Line(line, _read(line), declares(line)) for line in node.body if not isinstance(line, ast.Return)]
        for node in source.functions(ast.parse(text))
    ]
    for cell in cells if whole else ():
        if any(line.defs.intersection(gone) for line in cell):
            cell[:] = [line._replace(refs=set[str]()) for line in cell]
    lines = [line for cell in cells for line in cell]
    lost = depending(lines, gone)
    section, sections, others = "", dict[str, None](), dict[str, None]()
    for line in lines:
        section = [section, *headings([line.code])][-1]
        if line.refs & lost:
            shown = [caption for node in source.nodes(line.code) for caption in _captions(node)]
            others |= dict.fromkeys(shown)
            sections |= dict.fromkeys([] if shown or not section else [short(section)])
    *first, last = [*([f"section {', '.join(some(sections))}"] if sections else []), *some(others)] or [""]
    return f"{', '.join(first)} and {last}" if first else last


def _read(line: ast.stmt) -> set[str]:
    """Names that a line reads, and inputs."""
    return read(line) | {ast.unparse(node) for node in source.nodes(line) if isinstance(node, ast.Attribute)}


def _captions(node: ast.AST) -> list[str]:
    """A table or figure that a call makes, by its number."""
    match node:
        case ast.Call(ast.Name(kind), [ast.Constant(str(number)), *_]) if kind in _CAPTIONED:
            return [f"{kind} {number}"]
    return []
