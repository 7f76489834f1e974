"""Where a worksheet has what its document prints under a number, and where the document is wrong: from its source."""

import ast
import re
import sys
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import Any, NamedTuple

from mechsheet.worksheet import source
from mechsheet.worksheet.errors import SheetError, refuse
from mechsheet.worksheet.lines import Formula, formulas
from mechsheet.worksheet.shown import Shown

_NUMBER = r"\(((?:\d+\.)*)(\d+)[a-z]?\)"
_LABELS = re.compile(r"\(((?:appendix|figures?|programs?|sheets?|tables?) [^()]*)\)")
_HEADING = re.compile(r"^ *#+ +(.*\S)", re.MULTILINE)


class Entry(NamedTuple):
    """One place of the worksheet.

    ``label`` is what the document calls it, such as ``(1.26)``, ``figure 1.3``, ``program SR2``; nothing where it has
    no name for it. ``kind`` is ``line``, ``table``, ``figure`` or ``heading``; ``name`` that of the line or the number
    of the table or figure; ``text`` the meaning or the title; ``line`` that of the source.
    """

    label: str
    kind: str
    name: str
    text: str
    line: int


@dataclass(frozen=True, eq=False)
class Index(Shown):
    """Lines by the numbers of the printed formulas; tables, figures and programs; lines that the document has wrong."""

    formulas: tuple[Entry, ...]
    titles: tuple[Entry, ...]
    errata: tuple[Entry, ...]

    @property
    def numbers(self) -> tuple[str, ...]:
        """Numbers of the printed formulas, each once."""
        return tuple(dict.fromkeys(entry.label for entry in self.formulas))


def index() -> Index:
    """Index of the calling worksheet, with its errata: the last line of a cell near the end.

    A line has the number of its formula at the head of its meaning, ``# [N] (1.26) along the rod``, and the word
    erratum where it follows the print and the print is wrong. Tables and figures have their numbers; what the document
    calls otherwise stands in brackets in a title, ``## 4 Group (4, 5) (program SR2, figure 1.3)``.

    Raises SheetError naming the line whose names and units do not match.
    """
    try:
        return of_worksheet(sys._getframe(1).f_globals)
    except SheetError as error:
        refuse(error)


def of_worksheet(namespace: Mapping[str, Any]) -> Index:
    """Index of the worksheet that runs in a namespace, or whose ``__file__`` that is.

    Raises SheetError as `index`.
    """
    path = {"__file__": namespace.get("__file__")}  # a page does not run the cells that are nothing but a text
    return of_cells(source.cells(namespace), source.cells(path))


def of_cells(cells: Iterable[source.Cell], texts: Iterable[source.Cell]) -> Index:
    """Index of the cells of a worksheet and of the headings in ``texts``, in their order; formulas by their numbers.

    Raises SheetError as `index`.
    """
    cells = tuple(cells)
    lines = [line for cell in cells for line in formulas(cell) if isinstance(line, Formula)]
    numbered = [_of_line(line, label, line.meaning) for line in lines for label in numbers(line.number)]
    wrong = (line for line in lines if "erratum" in line.meaning)
    errata = [_of_line(line, line.number, line.meaning.removesuffix("(erratum)").rstrip()) for line in wrong]
    headings = [entry for cell in texts for node in cell.body for entry in _entries(node)[0]]
    titles = [entry for cell in cells for node in cell.body for entry in _entries(node)[1]]
    by_number = sorted(numbered, key=lambda entry: _order(entry.label))
    return Index(tuple(by_number), (*headings, *titles), tuple(errata))


def _of_line(line: Formula, label: str, text: str) -> Entry:
    return Entry(label, "line", line.name, text, line.expression.lineno)


def numbers(printed: str) -> list[str]:
    """Each number that a line has, those between the ends of a range too.

    >>> numbers("(1.3)-(1.5), (2)")
    ['(1.3)', '(1.4)', '(1.5)', '(2)']
    """
    found = list[str]()
    for part in filter(None, printed.split(",")):
        ends = list(re.finditer(_NUMBER, part))
        (head, first), (_, last) = ends[0].groups(), ends[-1].groups()
        between = (f"({head}{n})" for n in range(int(first) + 1, int(last)))
        found += dict.fromkeys([ends[0][0], *between, ends[-1][0]])
    return found


def _order(label: str) -> tuple[tuple[int, ...], str]:
    return tuple(map(int, re.findall(r"\d+", label))), label


@lru_cache(maxsize=4096)
def _entries(node: ast.stmt) -> tuple[tuple[Entry, ...], tuple[Entry, ...]]:
    """Headings of a statement, and its tables, figures and captions: once for all who ask."""
    return tuple(_headings(node)), tuple(_titles(node))


def _titles(node: ast.stmt) -> Iterator[Entry]:
    """Tables, figures and captions of a statement."""
    for call in source.nodes(node):
        match call:
            case ast.Call(ast.Name("table" | "figure" | "caption" as kind), [ast.Constant(str(number)), title, *_]):
                kind, text = "figure" if kind == "caption" else kind, _title(title)
                for label in _labels(text) or [f"{kind} {number}"]:
                    yield Entry(label, kind, number, _LABELS.sub("", text).rstrip(), call.lineno)


def _headings(node: ast.stmt) -> Iterator[Entry]:
    """Headings of a statement's text that the document has a name for."""
    for markdown in source.texts([node]):
        for heading in _HEADING.findall(source.constant(markdown)):
            for label in _labels(heading):
                yield Entry(label, "heading", "", heading, markdown.lineno)


def _title(node: ast.expr) -> str:
    """A title; of one with a value in it what stands before the words of that value."""
    text = source.constant(node)
    return text.rpartition(", ")[0] if isinstance(node, ast.JoinedStr) else text


def _labels(title: str) -> list[str]:
    """What the document calls the things of a title: ``(programs SR1, SR2, figure 1.2)``."""
    found, kind = list[str](), ""
    for part in (part for group in _LABELS.findall(title) for part in group.split(", ")):
        word, _, designation = part.rpartition(" ")
        kind = word.removesuffix("s") or kind
        found.append(f"{kind} {designation}")
    return found
