"""The parts of a worksheet in the order of its file, as data for whoever writes them: from the file and one run."""

import ast
import re
from collections.abc import Container, Iterable, Iterator, Mapping
from functools import lru_cache
from inspect import cleandoc
from pathlib import Path
from types import CodeType
from typing import Any, NamedTuple

from mechsheet.worksheet import source
from mechsheet.worksheet.cells import load, results
from mechsheet.worksheet.check import Check, Summary
from mechsheet.worksheet.errors import SheetError, raised
from mechsheet.worksheet.lines import Formula, Given
from mechsheet.worksheet.over import Over, over
from mechsheet.worksheet.shown import Shown, arranged
from mechsheet.worksheet.table import Figure, Table
from mechsheet.worksheet.title import Player, SideBySide, Slider, Title
from mechsheet.worksheet.typeset import Typeset

_BLANK = r"\A(?:[ \t]*\n)+"  # lines at the beginning
_HEADING = r"(?m)^(#+) +(.*\S)\s*$"
_OF_PAGE = {"ask", "export", "save_scene"}  # what they show is there to be pressed or filled in


class Section(NamedTuple):
    """A heading; ``level`` 2 is that of a section, 3 of one in it."""

    level: int
    title: str


class Text(NamedTuple):
    """Text between formulas, in Markdown with formulas between dollar signs."""

    markdown: str


class Line(NamedTuple):
    """A line with its value in SI; None for a line that is a function. Of a field it may be at one ``position``.

    ``over`` is what a field runs over, where that is known.
    """

    formula: Formula
    value: Any
    position: int = 0
    over: Over | None = None


class Control(NamedTuple):
    """A slider by the name that the formulas read: what it moves, in ``unit``, and whether it turns on at its end."""

    name: str
    label: str
    start: float
    stop: float
    step: float | None
    value: float
    turning: bool
    unit: str = "-"


class _Written(NamedTuple):
    """A cell as it stands in the file: what it gives, in any case or in a branch, and the code of what it shows.

    ``before`` are the lines behind the names with ``_`` that it shows, which marimo keeps from other cells; both need
    the names ``reads``.
    """

    gives: tuple[str, ...]
    certain: frozenset[str]
    reads: frozenset[str]
    before: CodeType | None
    shown: CodeType | None
    is_text: bool


def contents(namespace: Mapping[str, Any]) -> list[Any]:
    """What a worksheet shows, in the order of its file, from the namespace of a run.

    Only the expressions in which cells end are evaluated again, not what they are computed from.

    These are `Section`, `Text`, `Line`, `Given`, `Control`, the inputs as `Used`, and the values that cells show as
    they are: title, captions, drawings, columns of them, tables, figures, found values, checks and their summary.
    Of a run that was asked for some results only, it is what the cells that have run show.
    """
    names = dict(namespace)
    return [part for value, _ in _cells(names) for part in _parts(value, names)]


def by_cell(namespace: Mapping[str, Any], only: Container[int] | None = None) -> dict[int, list[Any]]:
    """What `contents` lists, by the number of the cell in the file; of some cells ``only`` where they are given."""
    names = dict(namespace)
    found = {n: list(_parts(value, names)) for n, (value, _) in enumerate(_cells(names, only))}
    return {n: parts for n, parts in found.items() if parts}


def values(namespace: Mapping[str, Any]) -> list[Any]:
    """What the cells of a run can show, in the order of the file, each value of a group on its own.

    Of a cell first what it gives, by its lines, be it for the workbook alone; then what it shows under no name, but for
    a shorter table of a number that is given. Last comes what stands in the namespace and not yet in the file.
    """
    cells = [(list(_singly(given)), list(_singly([value]))) for value, given in _cells(dict(namespace))]
    numbers = {_number(value) for given, _ in cells for value in given} - {None}
    held = [v for given, parts in cells for v in (*given, *(part for part in parts if _number(part) not in numbers))]
    found, sums = dict[int, Any](), list[Summary]()
    for value in (*held, *_singly(value for name, value in namespace.items() if not name.startswith("_"))):
        if isinstance(value, Summary):
            sums.append(value)
        elif isinstance(value, Shown):
            found.setdefault(id(value), value)
    for check in (check for each in sums for check in each.checks):  # the one at the top must not decide the order
        found.setdefault(id(check), check)
    _told_apart(found.values())
    return list(found.values())


def called(value: Any) -> str:
    """What a table, figure or check is called; "" for anything else."""
    match value:
        case Table(number=number):
            return f"table {number}"
        case Figure(number=number):
            return f"figure {number}"
        case Check(name=name):
            return f"check {name}"
    return ""


def _told_apart(values: Iterable[Any]) -> None:
    """SheetError where two checks, tables or figures go by one name: for other inputs one would stand for both."""
    known = set[str]()
    for name in filter(None, map(called, values)):
        if name in known:
            kind, _, own = name.partition(" ")
            told, by = (f"are called {own!r}", "name") if kind == "check" else (f"have the number {own}", "number")
            raise SheetError(f"two {kind}s {told}: give each a {by} of its own")
        known.add(name)


def _number(value: Any) -> tuple[type, str] | None:
    return (type(value), value.number) if isinstance(value, Table | Figure) else None


def _singly(group: Iterable[Any]) -> Iterator[Any]:
    for value in group:
        match value:
            case tuple() | list():
                yield from _singly(value)
            case SideBySide(columns):
                yield from _singly(columns)
            case Typeset():
                yield from _singly(value.shown)
            case _:
                yield value


def _cells(names: dict[str, Any], only: Container[int] | None = None) -> Iterator[tuple[Any, list[Any]]]:
    """What each cell shows, and what it gives: nothing of one that has not run, nor of one that is not asked for.

    ``names`` are a copy of the run's, to which those that cells keep to themselves are added.
    """
    path = Path(names["__file__"]).resolve()
    cells = _read(path, path.stat().st_mtime_ns)
    names["title_block"] = lambda name, text="": Title(name, text, path.name)  # that of a page watches its cells too
    names.setdefault("print", lambda *_, **__: None)  # the cells have said it already
    with raised():
        for n, cell in enumerate(cells):
            if not cell.certain <= names.keys() or (only is not None and n not in only):
                yield None, []
                continue
            value = None
            if cell.shown and cell.reads <= names.keys():
                with arranged() as held:  # of what marimo has arranged nothing but its text is left
                    if cell.before:
                        exec(cell.before, names)
                    value = eval(cell.shown, names)
                value = str(value) if cell.is_text else value
                value = [*held, value] if held else value
            yield value, [names[name] for name in cell.gives if name in names]


@lru_cache(maxsize=32)
def _read(path: Path, _changed: int) -> tuple[_Written, ...]:
    """The cells of a file in their order."""
    nodes = list(source.functions(source.parsed(path.read_text(encoding="utf-8"), str(path))[0]))
    given = [cell.gives for cell in load(path).cells]
    certain, every = frozenset(results(path, certain=True)), frozenset(results(path))
    arranging = {name: line for node in nodes for line in node.body if (name := _arranging(line))}
    return tuple(
        _Written(gives, certain & {*gives}, *_ending(node, every, str(path), arranging))
        for node, gives in zip(nodes, given, strict=True)
    )


def _ending(
    node: ast.FunctionDef, every: frozenset[str], path: str, arranging: Mapping[str, ast.stmt]
) -> tuple[frozenset[str], CodeType | None, CodeType | None, bool]:
    """What a cell shows: the names that this reads of all cells, its code, and whether it is a text."""
    text, body = source.markdown(node), node.body[:-1] if isinstance(node.body[-1], ast.Return) else node.body
    match body[-1:]:
        case [ast.Expr(shown)] if not _asks(node):
            before = _before(body[:-1], shown, arranging)
            reads = every.intersection(name for part in (*before, shown) for name in _names(part))
            code = compile(ast.Module(before, []), path, "exec") if before else None
            return reads, code, compile(ast.Expression(text or shown), path, "eval"), text is not None
    return frozenset(), None, None, False


def _before(lines: list[ast.stmt], shown: ast.expr, arranging: Mapping[str, ast.stmt]) -> list[ast.stmt]:
    """Lines of a cell that have to do with the names with ``_`` in what it shows, and with those in these lines.

    So do those by which marimo arranges what is shown, in whatever cell: of that nothing but its text is left.
    """
    elsewhere = [line for name, line in arranging.items() if line not in lines and name in _names(shown)]
    private, size = {name for name in _names(shown) if name.startswith("_") or name in arranging}, -1
    while len(private) > size:
        size = len(private)
        kept = [line for line in lines if not private.isdisjoint(_names(line))]
        private |= {name for line in kept for name in _names(line) if name.startswith("_")}
    return elsewhere + kept


def _arranging(line: ast.stmt) -> str:
    """Name that a line gives to what marimo arranges; "" of any other."""
    match line:
        case ast.Assign([ast.Name(name)], ast.Call(ast.Attribute(ast.Name("mo"))) as arranged):
            return "" if any(part.startswith("_") for part in _names(arranged)) else name
    return ""


def _names(node: ast.AST) -> Iterator[str]:
    return (part.id for part in source.nodes(node) if isinstance(part, ast.Name))


def _asks(node: ast.FunctionDef) -> bool:
    """Whether a cell shows what is there to be filled in or pressed."""
    calls = (call.func for call in source.nodes(node) if isinstance(call, ast.Call))
    return any(isinstance(called, ast.Name) and called.id in _OF_PAGE for called in calls)


def texts(markdown: str) -> Iterator[Section | Text]:
    """Headings of a text and what stands between them."""
    pieces = re.split(_HEADING, cleandoc(markdown))
    if pieces[0].strip():
        yield Text(pieces[0].strip())
    for marks, title, text in zip(pieces[1::3], pieces[2::3], pieces[3::3], strict=True):
        yield Section(len(marks), title)
        if text.strip():
            yield Text(re.sub(_BLANK, "", text).rstrip())  # its first line may be indented, as code is


def _parts(value: Any, names: Mapping[str, Any]) -> Iterator[Any]:
    """A value by itself, or the parts that it shows one after the other."""
    match value:
        case None:
            return
        case Typeset(position=at):
            for row, x in zip(value.rows, value.values, strict=True):
                yield row if isinstance(row, Given) else _line(row, x, at, names)
            for shown in value.shown:
                yield from _parts(shown, names)
        case Player(Slider() as slider, turning):  # in a page it is marimo's element
            yield _control(slider, turning, names)
        case Slider():
            yield _control(value, False, names)
        case str():
            yield from texts(value)
        case tuple() | list():
            for each in value:
                yield from _parts(each, names)
        case _:
            yield value


def _line(row: Formula, value: Any, at: int, names: Mapping[str, Any]) -> Line:
    if not row.has_value:
        return Line(row, None, at)
    return Line(row, value, at, over(row.name, names) if getattr(value, "ndim", 0) else None)


def _control(slider: Slider, turning: bool, names: Mapping[str, Any]) -> Control:
    name = next(name for name, value in names.items() if value is slider)
    return Control(name, slider.label, slider.start, slider.stop, slider.step, slider.value, turning, slider.unit)
