"""What is refused of a worksheet's file before any cell of it runs: what is no cell, is misread, or is given twice."""

import ast
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from textwrap import dedent
from typing import Any

from mechsheet.worksheet import mistakes, source
from mechsheet.worksheet.caret import caret
from mechsheet.worksheet.errors import SheetError
from mechsheet.worksheet.no_inputs import declared_in
from mechsheet.worksheet.source import bound, is_app

_MARKS = ("cell", "function", "class_definition")  # what stands above what marimo reads


def refuse_unread(tree: ast.Module, path: Path) -> None:
    """Raise SheetError for a cell that the editor keeps as a text, because it is no Python, and one without a mark."""
    for node in tree.body:
        match node:
            case ast.FunctionDef() | ast.ClassDef() if not any(is_app(d, _MARKS) for d in node.decorator_list):
                mark = "@app.class_definition" if isinstance(node, ast.ClassDef) else "@app.cell"
                place = mistakes.place(path, node.lineno)
                raise SheetError(f"{place}: {node.name} belongs to no cell: write {mark} in a line of its own above it")
            case ast.Expr(ast.Call(ast.Attribute(attr="_unparsable_cell"), [ast.Constant(str(text)), *_])):
                try:
                    ast.parse(dedent(text))
                    why = "it is written as none"
                except SyntaxError as error:
                    why = f"{(error.text or '').strip()}: {mistakes.unread(error)}"
                raise SheetError(f"{mistakes.place(path, node.lineno)}: a cell there cannot be read: {why}")


def refuse_twice(
    nodes: Iterable[ast.FunctionDef], gives: Iterable[Iterable[str]], shared: Mapping[str, int], path: Path
) -> None:
    """Raise SheetError for names that two cells define, or a cell and what stands before the cells."""
    first, twice = dict[str, int](), dict[str, list[str]]()
    for node, names in zip(nodes, gives, strict=True):
        for name in names:
            if name in shared:
                places = f"lines {shared[name]} and {node.lineno}"
                raise SheetError(
                    f"{path.name}, {places}: {name} is of the setup: a cell must call its own another name"
                )
            if first.setdefault(name, node.lineno) != node.lineno:
                twice.setdefault(f"lines {first[name]} and {node.lineno}", []).append(name)
    if twice:
        raise SheetError(f"{path.name}, {'; '.join(f'{at}: {mistakes.twice(*names)}' for at, names in twice.items())}")


def refuse_misread(statements: Iterable[ast.stmt], path: Path) -> None:
    """Raise SheetError for a power by ^, and a line that is too deep for who reads it by calling itself, as Python."""
    for statement in statements:
        at, why = caret(statement)
        if why:
            raise SheetError(f"{mistakes.place(path, at)}, {why}")
        lines = statement.body if isinstance(statement, ast.FunctionDef) else [statement]
        for line in lines if len(source.nodes(statement)) > _DEEPEST else ():
            level, depth = [line] if len(source.nodes(line)) > _DEEPEST else list[ast.AST](), 0
            while level:
                level, depth = [part for node in level for part in ast.iter_child_nodes(node)], depth + 1
            if depth > _DEEPEST:
                why = f"{depth} operations in one another, and {_DEEPEST} are read: give its parts names"
                raise SheetError(f"{mistakes.place(path, line.lineno)}: {why}")


def refuse_beside_inputs(cells: Iterable[Sequence[ast.stmt]], names: Mapping[str, Any], path: Path) -> None:
    """Raise SheetError for what stands `beside_inputs` in a cell."""
    for lines in cells:
        for at, why in beside_inputs(lines, names):
            raise SheetError(f"{mistakes.place(path, at)}: {why}")


def beside_inputs(lines: Sequence[ast.stmt], names: Mapping[str, Any]) -> Iterator[tuple[int, str]]:
    """What the cell of g, the inputs, gives beside it, and a g of its own: the line, and why it may not.

    Where other inputs are given, that cell does not run: both would be those of the page alone. The class of the inputs
    and `read` are called as they are among the ``names`` of the worksheet; nothing where there is no such class.
    """
    cls = getattr(declared_in(names), "__name__", "")
    for line in (line for line in lines if cls and "g" in bound(line)):
        others = dict.fromkeys(name for each in lines for name in bound(each) if name != "g" and name[0] != "_")
        if others:
            yield line.lineno, f"g, the inputs, needs a cell of its own: move {', '.join(others)} to another one"
        match line:
            case (
                ast.Assign([ast.Name()], ast.Call(of, args, keywords))
                | ast.AnnAssign(value=ast.Call(of, args, keywords))
            ) if _called(of, names) == "read" or (_called(of, names) == cls and not args and not keywords):
                continue
        why = f"inputs begin with the values of their class: write g = read({cls}, form), or g = {cls}()"
        yield line.lineno, why


def _called(of: ast.expr, names: Mapping[str, Any]) -> str:
    """Name of what is called, as where it is defined."""
    match of:
        case ast.Name(name) | ast.Attribute(attr=name):
            return getattr(names.get(name), "__name__", name)
    return ""


_DEEPEST = 300  # levels of a statement: each takes some of Python's thousand calls in one another
