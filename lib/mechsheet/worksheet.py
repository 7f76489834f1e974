"""A worksheet file as a function: ask for some results, and only the cells that they need are run."""

import ast
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from types import CodeType
from typing import Any

from mechsheet import inputs
from mechsheet.errors import SheetError, raised


@dataclass(frozen=True)
class Cell:
    """One cell: the names it reads and defines, and its compiled lines."""

    name: str
    needs: frozenset[str]
    gives: tuple[str, ...]
    code: CodeType


@dataclass(frozen=True)
class Worksheet:
    """Cells of a worksheet file, and the names that all of them see: imports and the class of the inputs."""

    path: str
    cells: tuple[Cell, ...]
    common: Mapping[str, Any]

    def run(self, want: Iterable[str], given: Mapping[str, Any]) -> dict[str, Any]:
        """Namespace after running the cells that ``want`` depends on, where the names ``given`` are known already.

        Raises SheetError naming what no cell defines.
        """
        names = {**self.common, **given}
        with raised():
            for cell in self.needed(want, given):
                exec(cell.code, names)
        return names

    def needed(self, want: Iterable[str], given: Iterable[str] = ()) -> list[Cell]:
        """Cells that ``want`` depends on, in an order in which they can run."""
        givers = {name: cell for cell in self.cells for name in cell.gives}
        known, order = set(self.common) | set(given), list[Cell]()

        def ask(name: str) -> None:
            if name in known:
                return
            if name not in givers:
                raise SheetError(f"{name} is defined by no cell of {self.path}")
            cell = givers[name]
            known.update(cell.gives)
            for need in sorted(cell.needs):
                ask(need)
            order.append(cell)

        for name in want:
            ask(name)
        return order

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
    Only the cells that the results depend on are run.

    Raises SheetError for an unknown name, an input outside its limits, or where no solution exists.
    """
    sheet, want = load(worksheet), list(want)
    g = given.pop("g") if "g" in given else inputs.build(sheet.inputs, given)
    names = sheet.run(want, {"g": g})
    return {name: names[name] for name in want}


def results(path: str | Path) -> list[str]:
    """Names that the cells of a worksheet file define, in the order of the file; nothing is run."""
    tree = ast.parse(Path(path).read_text(encoding="utf-8"))
    return [name for node in _functions(tree) for name in _gives(node)]


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


@lru_cache(maxsize=32)
def _load(path: Path, _changed: int) -> Worksheet:
    tree = ast.parse(path.read_text(encoding="utf-8"))
    common: dict[str, Any] = {"__file__": str(path), "__name__": path.stem}
    exec(compile(ast.Module(list(_shared(tree)), []), path, "exec"), common)
    return Worksheet(str(path), tuple(_cells(tree, path)), common)


def _is_app(node: ast.expr, kinds: tuple[str, ...]) -> bool:
    """Whether a decorator or context is ``app.cell``, ``app.setup`` and the like, called or not."""
    node = node.func if isinstance(node, ast.Call) else node
    return isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name) and node.attr in kinds


def _shared(tree: ast.Module) -> Iterator[ast.stmt]:
    """The setup block and the classes and functions that stand alone, without marimo's decorators."""
    for node in tree.body:
        match node:
            case ast.With(items=[ast.withitem(context)]) if _is_app(context, ("setup",)):
                yield from node.body
            case ast.ClassDef() | ast.FunctionDef():
                kept = [d for d in node.decorator_list if not _is_app(d, ("class_definition", "function"))]
                if len(kept) < len(node.decorator_list):
                    node.decorator_list = kept
                    yield node


def _cells(tree: ast.Module, path: Path) -> Iterator[Cell]:
    for node in _functions(tree):
        code = compile(ast.Module(node.body[:-1], []), path, "exec")
        yield Cell(node.name, frozenset(a.arg for a in node.args.args), _gives(node), code)


def _functions(tree: ast.Module) -> Iterator[ast.FunctionDef]:
    """The cells as they stand in the file: functions that end by returning what they define."""
    for node in tree.body:
        if isinstance(node, ast.FunctionDef) and any(_is_app(d, ("cell",)) for d in node.decorator_list):
            yield node


def _gives(node: ast.FunctionDef) -> tuple[str, ...]:
    return tuple(n.id for n in ast.walk(node.body[-1]) if isinstance(n, ast.Name))
