"""What a served page has where something waits for a cell that was stopped: marimo leaves it out without a word."""

import ast
import re
from collections.abc import Iterable, Mapping, Sequence

from mechsheet.page.headings import heading
from mechsheet.page.notebook import Cell
from mechsheet.worksheet import source
from mechsheet.worksheet.depending import depending

_HEADING = re.compile(r"^\s*#{2,6} +(\S.*?)\s*$", re.MULTILINE)


def waiting(file: Sequence[source.Cell], cells: Sequence[Cell], stopped: str) -> Mapping[str, str]:
    """By the ids of the headings under which something waits: what it waits for.

    The texts of a served page are none of its cells, so the headings are those of the worksheet's ``file``. The section
    of the stopped cell itself has the reason in it.
    """
    own = frozenset[str]().union(*(cell.defs for cell in cells if cell.cell_id == stopped))
    lost = depending(cells, own)
    last, at, places = "", "", dict[str, None]()
    for cell in file:
        nodes = [node for statement in cell.body for node in source.nodes(statement)]
        last = [last, *headings(cell.body)][-1]
        names = [node for node in nodes if isinstance(node, ast.Name)]
        if own & {name.id for name in names if isinstance(name.ctx, ast.Store)}:
            at = last
        elif lost & {name.id for name in names}:
            places[last] = None
    waits = "waits for the setup" if stopped == "setup" else f"waits for {_named(at)}"
    return {heading(place): waits for place in places if place not in ("", at)}


def section(file: Sequence[source.Cell], cells: Sequence[Cell], cell_id: str) -> str:
    """Heading above a cell in the worksheet's ``file``, found by what it defines; "" where that does not tell."""
    own = frozenset[str]().union(*(cell.defs for cell in cells if cell.cell_id == cell_id))
    last = ""
    for cell in file:
        last = [last, *headings(cell.body)][-1]
        if not own.isdisjoint(name for statement in cell.body for name in source.bound(statement)):
            return last
    return ""


def headings(lines: Iterable[ast.stmt]) -> list[str]:
    """Headings in the texts that lines of a cell show."""
    return [found for text in source.texts(lines) for found in _HEADING.findall(source.constant(text))]


def own_texts(lines: Iterable[ast.stmt]) -> list[str]:
    """Texts that lines of a cell show whatever it computes: without values, and on no condition."""
    found, standing = list[str](), list[str]()
    for line in lines:
        match line:
            case ast.Expr(ast.Constant(str(text))):
                standing.append(text)
            case ast.Expr(ast.Call(ast.Name("typeset"), arguments)):
                found += [*standing, *map(_text, arguments)]
                standing.clear()
            case ast.Expr(shown):
                found.append(_text(shown))
    return [text for text in found if text]


def _text(shown: ast.expr) -> str:
    """A text as it stands in the source, plain or in ``mo.md``; nothing of one with values, and of anything else."""
    match shown:
        case ast.Constant(str(text)) | ast.Call(ast.Attribute(ast.Name("mo"), "md"), [ast.Constant(str(text))]):
            return text
    return ""


def _named(section: str) -> str:
    """A section by its number, or by its heading where it has none."""
    if not section:
        return "what is not computed above"
    named = short(section)
    return named if named.startswith("“") else f"section {named}"


def short(section: str) -> str:
    """The number of a section, or its heading where it has none."""
    number = section.partition(" ")[0]
    return number if number[:1].isdigit() else f"“{section}”"
