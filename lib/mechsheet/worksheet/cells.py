"""The cells of a worksheet file: of those that some results need, in an order in which they can run."""

import ast
import re
import sys
from collections.abc import Container, Iterable, Iterator, Mapping
from copy import copy, deepcopy
from dataclasses import dataclass, field
from functools import lru_cache
from itertools import chain
from pathlib import Path
from types import CodeType, ModuleType
from typing import Any, NamedTuple

import numpy as np

from mechsheet.worksheet import data_file, mistakes, source
from mechsheet.worksheet.begun import Begun
from mechsheet.worksheet.check import STATED, checks_of, refuse_open, stating, unkept
from mechsheet.worksheet.errors import SheetError, as_given, nearest, raised
from mechsheet.worksheet.marimo_on_use import Marimo
from mechsheet.worksheet.no_inputs import NoInputs, declared_in, in_a_cell
from mechsheet.worksheet.numbers import existing
from mechsheet.worksheet.refused_cells import refuse_beside_inputs, refuse_misread, refuse_twice, refuse_unread
from mechsheet.worksheet.source import bound, constant, functions, is_app, parsed, texts

_SECTION = re.compile(r"^\s*## +(.*\S)", re.MULTILINE)
_PART = re.compile(r"abs\((\w+)\)|(\w+)\.(real|imag)")


class Cell(NamedTuple):
    """One cell: the names it reads and defines, the names that its checks may have, its lines as a tree and as code."""

    name: str
    needs: frozenset[str]
    gives: tuple[str, ...]
    checks: tuple[str, ...]  # as patterns
    lines: tuple[ast.stmt, ...]
    code: CodeType
    certain: tuple[str, ...] = ()  # of what it gives, not what only a branch or a loop binds
    section: str = ""  # heading ## above the cell, or in it
    closing: bool = False  # whether it has an essential check, such as that a group closes


@dataclass(frozen=True, eq=False)
class Worksheet:
    """Cells of a worksheet file, the names that all of them see (imports, the class of the inputs), and its title."""

    path: str
    cells: tuple[Cell, ...]
    common: Mapping[str, Any]
    title: str
    setup: tuple[ast.stmt, ...] = ()  # statements that bind shared names to values
    errors: Mapping[str, Any] = field(default_factory=dict)  # what its setup has numpy do about errors
    comments: dict[int, str] = field(default_factory=dict)  # of the lines of its file
    whole: tuple[ast.stmt, ...] = ()  # all statements of its setup, classes and functions
    begun: Begun = field(default_factory=Begun)  # what its setup holds as a run begins

    def defining(self) -> list[ast.stmt]:
        """Of its setup all but imports and the class of the inputs."""
        apart, imports = getattr(declared_in(self.common), "__name__", ""), ast.Import | ast.ImportFrom
        return [line for line in self.whole if not isinstance(line, imports) and apart not in bound(line)]

    def run(self, want: Iterable[str], given: Mapping[str, Any]) -> dict[str, Any]:
        """Namespace after running the cells that ``want`` depends on, where the names ``given`` are known already.

        Raises SheetError naming what no cell defines, a cell that stopped, or the essential check that fails where a
        cell raises: whatever is drawn or reduced behind a mechanism that does not close is explained by that.
        """
        return self._run(self.needed(want, given), given)

    def run_whole(self) -> dict[str, Any]:
        """Namespace after running every cell, inputs and export among them: those that others need first.

        Raises SheetError as `run` does, and where there is no cell.
        """
        if not self.cells:
            raise SheetError(f"{self.path} is no worksheet: it has no cells")
        order = self.needed(name for cell in self.cells for name in cell.gives)
        return self._run([*order, *(cell for cell in self.cells if cell not in order)], {})

    def _run(self, cells: Iterable[Cell], given: Mapping[str, Any]) -> dict[str, Any]:
        self.begun.again()
        names = {**self.common, **given}
        with raised(), np.errstate(**self.errors), stating() as names[STATED]:
            for cell in cells:
                try:
                    with mistakes.unbound(cell.gives, cell.certain, self.path):
                        exec(cell.code, names)
                    names.update(given)  # a cell that is needed for something else must not replace what is given
                except BaseException as error:
                    if isinstance(error, Exception):
                        self.close(given)
                    if isinstance(error, StopIteration):  # which would end a loop of who calls
                        raise SheetError(mistakes.told(error, self.path)) from error
                    if _is_stop(error):
                        raise SheetError(f"cell {cell.name} stopped before its end") from None
                    if isinstance(error, SystemExit) and not error.code and (line := mistakes.left(error, self.path)):
                        raise SheetError(f"{line}: the worksheet ends there, before its checks and workbook") from None
                    raise
        return names

    def refuse_unbound(self, want: Iterable[str], names: Container[str]) -> None:
        """Raises SheetError for a result that has no value where its cells have ended: another way of one binds it."""
        given = {name for cell in self.cells for name in cell.gives}
        for root in map(base, want):
            if root in given and root not in names:
                raise SheetError(f"{root} has no value: none of the ways that its cell went gives it one")

    def close(self, given: Mapping[str, Any]) -> None:
        """Evaluate the essential checks that can be evaluated.

        Raises SheetError for the first of them that fails.
        """
        self.begun.again()
        names, lost = {**self.common, **given}, set[str]()
        closing = [name for cell in self.cells if cell.closing for name in cell.gives]
        with raised(), np.errstate(all="ignore"):
            for cell in self.needed(closing, given):
                try:
                    if lost.isdisjoint(cell.needs):
                        exec(cell.code, names)
                        names.update(given)
                        continue
                except BaseException as error:
                    if not (isinstance(error, Exception) or _is_stop(error)):
                        raise
                lost.update(cell.gives)
        refuse_open(checks_of(names))

    def needed(self, want: Iterable[str], given: Iterable[str] = ()) -> list[Cell]:
        """Cells that ``want`` depends on, in an order in which they can run.

        ``want`` are names, parts of them as tables take them (``P56_S.imag``, ``abs(R56)``), and names of checks.
        """
        givers = {name: cell for cell in self.cells for name in cell.gives}
        known, order, begun = set(self.common) | set(given), list[Cell](), dict[Cell, str]()
        named = {**self.common, **givers}

        def ask(name: str) -> None:
            if name in known:
                return
            if name not in givers:
                if hasattr(declared_in(self.common), name):
                    line = f"{name}_1 = g.{name} in a line is one"
                    raise SheetError(f"{name} is an input of {self.path}, not a result: {line}")
                near = nearest(name, givers, 3)
                hint = f"; nearest: {', '.join(near)}" if near else ""
                raise SheetError(f"{name} is defined by no cell of {self.path}{hint}")
            if givers[name] in begun:
                other = [*begun.values()][-1]
                raise SheetError(f"{name} and {other} need each other: {self.path} has no order for them")
            run(givers[name], name)

        def run(cell: Cell, name: str) -> None:
            begun[cell] = name
            for need in sorted(cell.needs):
                ask(need)
            del begun[cell]
            known.update(cell.gives)
            order.append(cell)

        for name in want:
            root, checking = base(name), list[Cell]()
            if not is_result(root, named):
                checking = [cell for cell in self.cells if any(re.fullmatch(check, name) for check in cell.checks)]
            if not checking and (root in known or root in givers):
                ask(root)
                continue
            if not checking and root.isidentifier():
                ask(root)
            elif not checking:
                raise _no_check(name, (check.replace("\\", "") for c in self.cells for check in c.checks))
            for cell in checking:
                if cell not in order:
                    run(cell, name)
        return order

    @property
    def results(self) -> list[str]:
        """Names that the cells define, but for the inputs and what these alone need, such as the form of the page."""
        every = [name for cell in self.cells for name in cell.gives]
        if not declared_in(self.common):
            return every
        reading = [cell for cell in self.cells if cell.gives == ("g",)]
        needed = set(chain.from_iterable(cell.needs for cell in self.cells if cell not in reading))
        asked = {"g", *chain.from_iterable(cell.needs - needed for cell in reading)}
        return [name for name in every if name not in asked]

    @property
    def inputs(self) -> type:
        """Class of the inputs, `NoInputs` where there is none.

        Raises SheetError where there is one that cannot be used.
        """
        declared = declared_in(self.common)
        if declared is None:
            for cell in self.cells:
                if name := in_a_cell(cell.lines):
                    why = "where it cannot be set: move it, and what it needs, to the setup"
                    raise SheetError(f"{self.path} declares its inputs, {name}, in cell {cell.name}, {why}")
            return NoInputs
        if any("g" in {*cell.gives, *cell.needs} for cell in self.cells):
            return declared
        raise SheetError(f"{self.path}: no cell gives g, as which inputs are read: g = read(..)")


def asked(want: Iterable[str], what: str = "want", such: str = "GS6", least: int = 0) -> tuple[str, ...]:
    """Wanted names, each once, so many at least; SheetError where they are something else, such as one name alone."""
    names: list[object] = [want] if isinstance(want, str) or not isinstance(want, Iterable) else list(want)
    if names == [want] or len(names) < least or not all(isinstance(name, str) for name in names):
        raise SheetError(f"{what} = {as_given(want)} must be a list of names, such as {[such]}")
    return tuple(dict.fromkeys(map(str, names)))


def value(want: str, names: Mapping[str, Any]) -> Any:
    """A wanted result in the namespace of a run: a name, a part of one, or the check of that name."""
    root, part = split(want)
    if not (root.isidentifier() and is_result(root, names)):
        found = {check.name: check for check in (*unkept(names, ()), *checks_of(names))}
        if want in found:
            return found[want]
        if not root.isidentifier() or (isinstance(names, dict) and root not in names):
            raise _no_check(want, found)
    held = existing(names[root])
    if not part:
        return held
    if np.asarray(held).dtype.kind not in "iufc":
        raise SheetError(f"{want}: {root} is no number")
    return np.abs(held) if part == "abs" else getattr(np.asarray(held), part)


def is_result(name: str, names: Mapping[str, Any]) -> bool:
    """Whether a name may be that of a result: a function or a module has none, and leaves it to a check."""
    if not isinstance(names, dict):
        return True  # what knows more names than it tells
    return name in names and not (callable(names[name]) or isinstance(names[name], ModuleType))


def base(want: str) -> str:
    """Name of a wanted result without its part."""
    return split(want)[0]


@lru_cache(maxsize=1024)
def split(want: str) -> tuple[str, str]:
    """Name of a wanted result, and its part: ``real``, ``imag``, ``abs`` or none.

    >>> split("PS6_S.imag"), split("abs(R56)"), split("GS6")
    (('PS6_S', 'imag'), ('R56', 'abs'), ('GS6', ''))
    """
    match = _PART.fullmatch(want)
    if not match:
        return want, ""
    return (match[1], "abs") if match[1] else (match[2], match[3])


def _is_stop(error: BaseException) -> bool:
    return type(error).__name__ == "MarimoStopError"  # of mo.stop; marimo itself may not be loaded


def _no_check(name: str, known: Iterable[str]) -> SheetError:
    near = nearest(name, known)
    return SheetError(f"no check is named {name!r}" + (f"; nearest: {near[0]!r}" if near else ""))


def results(path: str | Path, certain: bool = False) -> list[str]:
    """Names that the cells of a worksheet file define, in the order of the file; nothing is run.

    With ``certain`` not those that only a branch or a loop binds, which may have been left out.
    """
    return [name for cell in load(path).cells for name in (cell.certain if certain else cell.gives)]


def load(path: str | Path) -> Worksheet:
    """Cells of a worksheet file; read again when the file changes, or a file of numbers that it names.

    Raises SheetError where the file cannot be read or is no Python.
    """
    if not isinstance(path, str | Path):
        raise SheetError(f"worksheet = {as_given(path)} must be a path")
    path = Path(path).resolve()
    try:
        changed = path.stat().st_mtime_ns
        return _load(path, changed, tuple(map(data_file.state, _data(path, changed))))
    except OSError as error:
        raise SheetError(f"worksheet {path} cannot be read: {error.strerror}") from None
    except UnicodeDecodeError as error:
        raise SheetError(f"worksheet {path} is no text in UTF-8: {error}") from None
    except SyntaxError as error:
        raise SheetError(mistakes.told(error, str(path))) from None


@lru_cache(maxsize=32)
def _data(path: Path, _changed: int) -> tuple[Path, ...]:
    return tuple(data_file.named(path.read_text(encoding="utf-8"), path.parent))


@lru_cache(maxsize=32)
def _load(path: Path, _changed: int, _data_changed: tuple[object, ...]) -> Worksheet:
    return read(path)


def read(path: Path) -> Worksheet:
    """Cells of a worksheet file, with shared names of their own."""
    text = path.read_text(encoding="utf-8")
    tree, comments = parsed(text, str(path))
    common: dict[str, Any] = {"__file__": str(path), "__name__": path.stem}
    lines = list[ast.stmt]()
    for node in _shared(tree):
        match node:
            case ast.Import([ast.alias("marimo", name)]):
                common[name or "marimo"] = Marimo()
            case _:
                lines.append(node)
    if (folder := str(path.parent)) not in sys.path:
        sys.path.append(folder)  # its modules are found wherever it is run from, and stand in place of no other
    with raised(), np.errstate():
        exec(compile(ast.Module(lines, []), path, "exec"), common)
        errors = np.geterr()
    setup = tuple(node for node in lines if isinstance(node, ast.Assign | ast.AnnAssign))
    title, own = _title(tree) or path.stem, tuple(_cells(tree, text, path))
    refuse_beside_inputs([cell.lines for cell in own], common, path)
    return Worksheet(str(path), own, common, title, setup, errors, comments, tuple(lines), Begun(common))


def _title(tree: ast.Module) -> str | None:
    """Title of the workbook: the first argument of ``export``."""
    for cell in functions(tree):
        for node in source.nodes(cell):
            match node:
                case ast.Call(ast.Name("export"), [ast.Constant(str(title)), *_]):
                    return title
    return None


def _shared(tree: ast.Module) -> Iterator[ast.stmt]:
    """The setup block and the classes and functions that stand alone, without marimo's decorators."""
    for node in tree.body:
        match node:
            case ast.With(items=[ast.withitem(context)]) if is_app(context, ("setup",)):
                yield from node.body
            case ast.ClassDef() | ast.FunctionDef():
                kept = [d for d in node.decorator_list if not is_app(d, ("class_definition", "function"))]
                if len(kept) < len(node.decorator_list):
                    alone = copy(node)
                    alone.decorator_list = kept
                    yield alone


def _cells(tree: ast.Module, text: str, path: Path) -> Iterator[Cell]:
    refuse_unread(tree, path)
    nodes, scopes = list(functions(tree)), {scope.get_lineno(): scope for scope in source.scopes_of(text, path)}
    refuse_misread([*_shared(tree), *nodes], path)
    gives, section = [defines(node.body) for node in nodes], ""
    shared = {name: node.lineno for node in _shared(tree) for name in bound(node)}
    refuse_twice(nodes, gives, shared, path)
    given = frozenset(chain.from_iterable(gives))
    for n, node in enumerate(nodes):
        lines = node.body[:-1] if isinstance(node.body[-1], ast.Return) else node.body
        section = [section, *(found for text in texts(lines) for found in _SECTION.findall(constant(text)))][-1]
        # What a program other than marimo has written may read more than it names as arguments.
        others = given.difference(gives[n])
        needs = frozenset(a.arg for a in node.args.args) | others.intersection(source.read_outside(scopes[node.lineno]))
        branching = any(isinstance(line, _OPEN) for line in lines)
        certain = defines(line for line in lines if not isinstance(line, _OPEN)) if branching else gives[n]
        lines, code = compiled(lines, str(path), f"_cell{n}")
        checks, closing = tuple(_checks(node)), _is_closing(node)
        yield Cell(node.name, needs, gives[n], checks, tuple(lines), code, certain, section, closing)


def compiled(lines: list[ast.stmt], path: str, own: str) -> tuple[list[ast.stmt], CodeType]:
    """Lines of a cell and their code, names with ``_`` changed to begin with ``own``, as they are no other cell's."""
    code = compile(ast.Module(lines, []), path, "exec")
    if not any(name.startswith("_") for name in code.co_names):  # as of most cells
        return lines, code
    private = {name for line in lines for name in bound(line) if name.startswith("_")}
    lines = deepcopy(lines)
    for node in (node for line in lines for node in ast.walk(line)):
        if isinstance(node, ast.alias):
            if (name := node.asname or node.name) in private:
                node.asname = own + name
            continue
        for part in ("id", "arg", "name"):  # of names, parameters and arguments, definitions and patterns
            if getattr(node, part, None) in private:
                setattr(node, part, own + getattr(node, part))
    return lines, compile(ast.Module(lines, []), path, "exec")


_OPEN = (ast.If, ast.For, ast.While, ast.Try, ast.TryStar, ast.Match)


def defines(lines: Iterable[ast.stmt]) -> tuple[str, ...]:
    """Names that lines of a cell define for others, as marimo sees them: all that they bind, but for those with ``_``.

    Not those that a cell returns: marimo's editor writes only what other cells read behind ``return``.
    """
    names = dict.fromkeys(name for line in lines for name in bound(line))
    return tuple(name for name in names if not name.startswith("_"))


def _is_closing(node: ast.FunctionDef) -> bool:
    for part in source.nodes(node):
        match part:
            case ast.Call(ast.Name("assembled")) | ast.keyword("essential"):
                return True
    return False


def _checks(node: ast.FunctionDef) -> Iterator[str]:
    """Texts that calls in a cell take first, which is where a check has its name, as patterns."""
    for call in source.nodes(node):
        match call:
            case ast.Call(args=[first, *_]) if (name := _name(first)).strip(".*"):
                yield name


def _name(text: ast.expr) -> str:
    """The pattern of a text, of one that is put together by its fixed parts."""
    match text:
        case ast.Constant(str(fixed)):
            return re.escape(fixed)
        case ast.JoinedStr(parts):
            return "".join(map(_name, parts))
        case ast.BinOp(left, ast.Add(), right):
            return _name(left) + _name(right)
    return ".*"
