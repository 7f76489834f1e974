"""A worksheet file as a function: ask for some results, and only the cells that they need are run."""

import ast
import difflib
import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from types import CodeType
from typing import Any

import numpy as np

from mechsheet.worksheet import inputs
from mechsheet.worksheet.checks import Check
from mechsheet.worksheet.errors import SheetError, raised
from mechsheet.worksheet.source import constant, functions, is_app, markdown

_SECTION = re.compile(r"^\s*## +(.*\S)", re.MULTILINE)
_PART = re.compile(r"abs\((\w+)\)|(\w+)\.(real|imag)")


@dataclass(frozen=True)
class Cell:
    """One cell: the names it reads and defines, the names that its checks may have, its compiled lines, its section."""

    name: str
    needs: frozenset[str]
    gives: tuple[str, ...]
    checks: tuple[re.Pattern[str], ...]
    code: CodeType
    section: str = ""  # heading ## above the cell, or in it


@dataclass(frozen=True)
class Worksheet:
    """Cells of a worksheet file, the names that all of them see (imports, the class of the inputs), and its title."""

    path: str
    cells: tuple[Cell, ...]
    common: Mapping[str, Any]
    title: str

    def run(self, want: Iterable[str], given: Mapping[str, Any]) -> dict[str, Any]:
        """Namespace after running the cells that ``want`` depends on, where the names ``given`` are known already.

        Raises SheetError naming what no cell defines, or a cell that stopped.
        """
        names = {**self.common, **given}
        with raised():
            for cell in self.needed(want, given):
                try:
                    exec(cell.code, names)
                except BaseException as error:
                    if type(error).__name__ != "MarimoStopError":  # of mo.stop; marimo itself may not be loaded
                        raise
                    raise SheetError(f"cell {cell.name} stopped before its end") from None
        return names

    def needed(self, want: Iterable[str], given: Iterable[str] = ()) -> list[Cell]:
        """Cells that ``want`` depends on, in an order in which they can run.

        ``want`` are names, parts of them as tables take them (``P56_S.imag``, ``abs(R56)``), and names of checks.
        """
        givers = {name: cell for cell in self.cells for name in cell.gives}
        known, order = set(self.common) | set(given), list[Cell]()

        def ask(name: str) -> None:
            if name in known:
                return
            if name not in givers:
                near = difflib.get_close_matches(name, givers, n=3)
                hint = f"; nearest: {', '.join(near)}" if near else ""
                raise SheetError(f"{name} is defined by no cell of {self.path}{hint}")
            run(givers[name])

        def run(cell: Cell) -> None:
            known.update(cell.gives)
            for need in sorted(cell.needs):
                ask(need)
            order.append(cell)

        for name in want:
            if (root := base(name)).isidentifier():
                ask(root)
                continue
            checking = [cell for cell in self.cells if any(check.fullmatch(name) for check in cell.checks)]
            if not checking:
                raise _no_check(name, (check.pattern.replace("\\", "") for c in self.cells for check in c.checks))
            for cell in checking:
                if cell not in order:
                    run(cell)
        return order

    @property
    def results(self) -> list[str]:
        """Names that the cells define, but for the inputs."""
        return [name for cell in self.cells for name in cell.gives if name != "g"]

    @property
    def inputs(self) -> type:
        """Class of the inputs."""
        for value in self.common.values():
            if isinstance(value, type) and hasattr(value, "__inputs__"):
                return value
        raise SheetError(f"{self.path} declares no inputs")


def evaluate(worksheet: str | Path, want: Iterable[str], **given: Any) -> dict[str, Any]:
    """Wanted results of a worksheet, by name, in SI.

    ``given`` are inputs by name in their display units, as in a scene, or the whole of them as ``g``.
    Only the cells that the results depend on are run. A result is a name, a part of one as in a table
    (``P56_S.imag``, ``abs(R56)``), or a check by its own name.

    Raises SheetError for an unknown name, an input outside its limits, or where no solution exists.
    """
    sheet, want = load(worksheet), list(want)
    g = given.pop("g") if "g" in given else inputs.build(sheet.inputs, given)
    names = sheet.run(want, {"g": g})
    return {name: value(name, names) for name in want}


def value(want: str, names: Mapping[str, Any]) -> Any:
    """A wanted result in the namespace of a run: a name, a part of one, or the check of that name."""
    root = base(want)
    if not root.isidentifier():
        found = {check.name: check for check in checks(names)}
        if want not in found:
            raise _no_check(want, found)
        return found[want]
    match = _PART.fullmatch(want)
    if not match:
        return names[root]
    if np.asarray(names[root]).dtype.kind not in "iufc":
        raise SheetError(f"{want}: {root} is no number")
    return np.abs(names[root]) if match[1] else getattr(np.asarray(names[root]), match[3])


def checks(names: Mapping[str, Any]) -> list[Check]:
    """Checks in the namespace of a run, alone or in groups, in the order in which they were made."""
    groups = (group if isinstance(group, tuple | list) else (group,) for group in names.values())
    return [check for group in groups for check in group if isinstance(check, Check)]


def base(want: str) -> str:
    match = _PART.fullmatch(want)
    return (match[1] or match[2]) if match else want


def _no_check(name: str, known: Iterable[str]) -> SheetError:
    near = difflib.get_close_matches(name, list(known), n=1)
    return SheetError(f"no check is named {name!r}" + (f"; nearest: {near[0]!r}" if near else ""))


def results(path: str | Path) -> list[str]:
    """Names that the cells of a worksheet file define, in the order of the file; nothing is run."""
    tree = ast.parse(Path(path).read_text(encoding="utf-8"))
    return [name for node in functions(tree) for name in _gives(node)]


def load(path: str | Path) -> Worksheet:
    """Cells of a worksheet file; read again when the file changes.

    Raises SheetError where the file cannot be read or is no Python.
    """
    path = Path(path).resolve()
    try:
        return _load(path, path.stat().st_mtime_ns)
    except OSError as error:
        raise SheetError(f"worksheet {path} cannot be read: {error.strerror}") from None
    except SyntaxError as error:
        raise SheetError(f"worksheet {path}, line {error.lineno}: {error.msg}") from None


class _Marimo:
    """marimo, imported at its first use: that takes half a second, and results need nothing of it."""

    def __getattr__(self, name: str) -> Any:
        import marimo  # on use: see above

        return getattr(marimo, name)


@lru_cache(maxsize=32)
def _load(path: Path, _changed: int) -> Worksheet:
    return read(path)


def read(path: Path) -> Worksheet:
    """Cells of a worksheet file, with shared names of their own."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    common: dict[str, Any] = {"__file__": str(path), "__name__": path.stem}
    lines = list[ast.stmt]()
    for node in _shared(tree):
        match node:
            case ast.Import([ast.alias("marimo", name)]):
                common[name or "marimo"] = _Marimo()
            case _:
                lines.append(node)
    with raised():
        exec(compile(ast.Module(lines, []), path, "exec"), common)
    return Worksheet(str(path), tuple(_cells(tree, path)), common, _title(tree) or path.stem)


def _title(tree: ast.Module) -> str | None:
    """Title of the workbook: the first argument of ``export``."""
    for node in ast.walk(tree):
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
                    node.decorator_list = kept
                    yield node


def _cells(tree: ast.Module, path: Path) -> Iterator[Cell]:
    section = ""
    for node in functions(tree):
        code = compile(ast.Module(node.body[:-1], []), path, "exec")
        section = [section, *_SECTION.findall(constant(markdown(node)))][-1]
        needs = frozenset(a.arg for a in node.args.args)
        yield Cell(node.name, needs, _gives(node), tuple(_checks(node)), code, section)


def _gives(node: ast.FunctionDef) -> tuple[str, ...]:
    return tuple(n.id for n in ast.walk(node.body[-1]) if isinstance(n, ast.Name))


def _checks(node: ast.FunctionDef) -> Iterator[re.Pattern[str]]:
    """Texts that calls in a cell take first, which is where a check has its name; of an f-string its fixed parts."""
    for call in ast.walk(node):
        match call:
            case ast.Call(args=[ast.Constant(str(text)), *_]):
                yield re.compile(re.escape(text))
            case ast.Call(args=[ast.JoinedStr(parts), *_]) if any(isinstance(p, ast.Constant) for p in parts):
                texts = (re.escape(str(p.value)) if isinstance(p, ast.Constant) else ".*" for p in parts)
                yield re.compile("".join(texts))
