"""What a worksheet's setup imports for its formulas: from where a name comes, and the setup with one more.

Texts in, texts out.
"""

import ast
import builtins
import io
import re
import sys
import textwrap
from collections.abc import Container, Iterable, Iterator, Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from mechsheet import units

WIDE = 120  # characters of a line of the file
_MODULES = {"np": "import numpy as np", "math": "import math"}
_SKIP = "  # fmt: skip"  # which keeps many names in few rows


def origin(name: str) -> str:
    """The line that imports a name of formulas: a function, a constant, a unit, a module; "" of any other name.

    >>> origin("cos"), origin("mm"), origin("find"), origin("np"), origin("cosine")
    ('from numpy import cos', 'from mechsheet.units import mm', 'from mechsheet import find', 'import numpy as np', '')
    """
    if name in _MODULES:
        return _MODULES[name]
    if name == "Literal":
        return "from typing import Literal"
    if len(name) > 1 and name in units.names():  # a letter is as often a quantity
        return f"from mechsheet.units import {name}"
    if name in vars(sys.modules["mechsheet"]).get("__all__", ()):
        return f"from mechsheet import {name}"
    meant = getattr(np, name) if len(name) > 1 and name in np.__all__ else None
    return f"from numpy import {name}" if callable(meant) or isinstance(meant, float) else ""


def lacking(line: str, given: Container[str]) -> list[str]:
    """The lines that import what a line reads and is not ``given``, sorted.

    A function is one where it is called: `power`, `angle` and many others are as often a quantity that is missing.
    Of ``log`` nobody knows whether that to base 10 is meant.

    >>> lacking("b = cos(x) * pi + power", ["x"])
    ['from numpy import cos', 'from numpy import pi']
    """
    nodes = list(ast.walk(ast.parse(line)))
    called = {node.func.id for node in nodes if isinstance(node, ast.Call) and isinstance(node.func, ast.Name)}
    parted = {node.value.id for node in nodes if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name)}
    names = {node.id for node in nodes if isinstance(node, ast.Name)}
    own = {node.arg for node in nodes if isinstance(node, ast.arg)}
    own |= {node.id for node in nodes if isinstance(node, ast.Name) and not isinstance(node.ctx, ast.Load)}
    found = set[str]()
    for name in names - own - {"log"}:
        if name not in given and not hasattr(builtins, name) and (line := origin(name)):
            is_used = name in parted if name in _MODULES else name in called or not _is_function(name)
            if is_used:
                found.add(line)
    return sorted(found)


def _is_function(name: str) -> bool:
    """Whether a name that can be imported is one of what formulas call."""
    return name != "Literal" and name not in units.names() and not isinstance(getattr(np, name, None), float)


class Setup(NamedTuple):
    """The beginning of a worksheet's setup, down to the last of its imports that changes, before and after.

    Of a cell all of it.
    """

    before: str
    after: str


def added(text: str, setup: ast.With | ast.FunctionDef, lines: Iterable[str]) -> Setup | None:
    """The setup of a file, or a cell, with more lines that import, each joined to that from the same module.

    None where its statements share their rows: there is no place for a further one.
    """
    rows, top, body = list(io.StringIO(text, newline="")), setup.lineno - 1, setup.body
    if any(_last(a) > b.lineno - 1 for a, b in pairwise(body)) or body[0].lineno - 1 == top:
        return None
    end = "\r\n" if rows[top].endswith("\r\n") else "\n"
    top_row = body[0].lineno - 1
    indent = rows[top_row][: body[0].col_offset]
    names, changes = dict[str, set[str]](), list[tuple[int, int, list[str]]]()
    lines = list(lines)
    for line in lines:
        match ast.parse(line).body:
            case [ast.ImportFrom(module=str(module), names=[alias])]:
                names.setdefault(module, set()).add(alias.name)
            case _:
                at = _behind(node for node in body if isinstance(node, ast.Import)) or top_row
                changes.append((at, at, [f"{indent}{line}{end}"]))
    for module, those in names.items():
        if node := _joined(rows, body, module):
            first, behind = node.lineno - 1, _last(node)
            changes.append((first, behind, list(_with(rows[first:behind], node, those, indent, end))))
        else:
            at = _behind(node for node in body if _is_before(node, module)) or top_row
            changes.append((at, at, [f"{indent}from {module} import {', '.join(sorted(those, key=_order))}{end}"]))
    match body[-1]:
        case ast.Return(ast.expr() as value) as last:
            given = {n.id for n in ast.walk(value) if isinstance(n, ast.Name)}.union(*map(_bound, lines))
            changes.append((last.lineno - 1, _last(last), returning(sorted(given), indent, end)))
    made = list(rows)
    bottom = max(behind for _, behind, _ in changes)
    for first, behind, new in sorted(changes, key=lambda each: each[:2], reverse=True):
        made[first:behind] = new
    grown = len(made) - len(rows)
    return Setup("".join(rows[top:bottom]), "".join(made[top : bottom + grown]))


def _bound(line: str) -> set[str]:
    """Names that a line which imports binds."""
    nodes = (node for node in ast.parse(line).body if isinstance(node, ast.Import | ast.ImportFrom))
    return {alias.asname or alias.name for node in nodes for alias in node.names}


def returning(names: Sequence[str], indent: str, end: str) -> list[str]:
    """The rows of a cell that give names to others."""
    one = ", ".join(names) if len(names) != 1 else f"({names[0]},)"
    listed = one if len(one) <= WIDE - len(f"{indent}return ") else several(names, indent, end)
    return [f"{indent}return {listed}".rstrip() + end]


def several(names: Sequence[str], indent: str, end: str) -> str:
    """Names in brackets over several lines."""
    rows = textwrap.wrap(", ".join(names) + ",", WIDE - len(indent) - 4)
    return end.join(["(", *(f"{indent}    {row}" for row in rows), f"{indent})"])


def _last(node: ast.stmt) -> int:
    """Number of the row behind a statement, from 0."""
    return node.end_lineno or node.lineno


def _joined(rows: Sequence[str], body: Sequence[ast.stmt], module: str) -> ast.ImportFrom | None:
    """The import from a module that further names can join: one without other names for them, or comments between."""
    for node in body:
        if isinstance(node, ast.ImportFrom) and node.module == module and not node.level:
            own = rows[node.lineno - 1 : _last(node)]
            named = all(alias.asname is None and alias.name != "*" for alias in node.names)
            if named and not any("#" in row or "\\" in row for row in own[:-1]):
                return node
    return None


def _with(rows: Sequence[str], node: ast.ImportFrom, names: Iterable[str], indent: str, end: str) -> Iterator[str]:
    """The rows of an import with further names, in one row where there is room, else as they stood."""
    listed = sorted({*(alias.name for alias in node.names), *names}, key=_order)
    told = rows[-1].encode()[node.end_col_offset :].decode().rstrip()  # a comment
    one = f"{indent}from {node.module} import {', '.join(listed)}"
    if len(rows) == 1 and len(one) + len(told) <= WIDE:
        yield one + told + end
        return
    yield f"{indent}from {node.module} import ({end}"
    if len({alias.lineno for alias in node.names}) == len(node.names) > 1:
        yield from (f"{indent}    {name},{end}" for name in listed)
    else:
        text = textwrap.wrap(", ".join(listed) + ",", WIDE - len(indent) - 4)
        yield from (f"{indent}    {row}{end}" for row in text)
        told = told or _SKIP
    yield f"{indent}){told}{end}"


def _order(name: str) -> tuple[int, str]:
    """Constants, then classes, then the others, as a formatter sorts them."""
    return (0 if re.fullmatch(r"[A-Z][A-Z\d_]+", name) else 1 if name[0].isupper() else 2), name


def _behind(before: Iterable[ast.stmt]) -> int:
    """Row behind the last of some statements, from 0; 0 where there is none."""
    return max(map(_last, before), default=0)


def _is_before(node: ast.stmt, module: str) -> bool:
    """Whether an import stands before that from a module: those of this package come last."""
    own = [module.startswith("mechsheet"), isinstance(node, ast.ImportFrom) and "mechsheet" in (node.module or "")]
    return isinstance(node, ast.Import | ast.ImportFrom) and own != [False, True]
