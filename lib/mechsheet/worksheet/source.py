"""The source of a worksheet: the statements of its cells and their comments, and the call that is being made."""

import ast
import io
import linecache
import os
import re
import tokenize
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import lru_cache
from pathlib import Path
from symtable import SymbolTable, symtable
from types import CodeType, FrameType
from typing import Any

from mechsheet.worksheet import mistakes, shown


@dataclass(frozen=True)
class Cell:
    """Statements of a cell, with the comment of each line and where the cell stands; the same for the same ones."""

    body: tuple[ast.stmt, ...]
    comments: dict[int, str] = field(compare=False)
    filename: str

    def at(self, line: int) -> str:
        """Place of a line as an error names it."""
        return mistakes.place(self.filename, line)


def cell(frame: FrameType) -> Cell:
    """Cell that runs in ``frame``: a whole cell module in the editor, a function of the file in a script."""
    code = frame.f_code
    known = _read.get(id(code))
    if known is None:
        tree, comments = _file(frame)
        if len(_read) == _KEPT:
            _read.clear()
        known = _read[id(code)] = code, Cell(_body(tree, frame.f_lineno), comments, code.co_filename)
    return known[1]


# Cells by the identity of their code, held so that it stays theirs: code with another unit in a comment is equal.
_read: dict[int, tuple[CodeType, Cell]] = {}
_KEPT = 1000


def listed(arguments: Iterable[ast.expr]) -> list[ast.expr]:
    """Arguments of a call, those of a group ``*(a, b)`` one by one."""
    found = list[ast.expr]()
    for node in arguments:
        group = node.value if isinstance(node, ast.Starred) else None
        found += group.elts if isinstance(group, ast.Tuple) else [node]
    return found


def cells(namespace: Mapping[str, Any]) -> tuple[Cell, ...]:
    """Cells of the worksheet that runs in a namespace: those of its page, elsewhere those of its file, in their order.

    The same tuple as long as they stay the same.
    """
    texts = shown.cells_in_page(namespace)
    return of_file(namespace) if texts is None else of_texts(texts)


def of_file(namespace: Mapping[str, Any]) -> tuple[Cell, ...]:
    """Cells of the file of the worksheet that runs in a namespace, in their order."""
    path = namespace.get("__file__")
    return _in_file(path, os.stat(path).st_mtime_ns) if path else ()


def own_functions(namespace: Mapping[str, Any]) -> tuple[ast.FunctionDef, ...]:
    """Functions that the worksheet which runs in a namespace defines in its cells, and in its file beside these."""
    own = (line for cell in cells(namespace) for line in cell.body if isinstance(line, ast.FunctionDef))
    path = namespace.get("__file__")
    return (*own, *(_beside_cells(path, os.stat(path).st_mtime_ns) if path else ()))


@lru_cache(maxsize=32)
def of_texts(texts: shown.Texts) -> tuple[Cell, ...]:
    """Cells that are texts of their own."""
    return tuple(_alone(*text) for text in texts)


@lru_cache(maxsize=1000)
def _alone(text: str, filename: str) -> Cell:
    tree, comments = parsed(text)
    return Cell(tuple(tree.body), comments, filename)


@lru_cache(maxsize=32)
def _in_file(path: str, _changed: int) -> tuple[Cell, ...]:
    tree, comments = parsed(Path(path).read_text(encoding="utf-8"), path)
    return tuple(Cell(tuple(node.body), comments, path) for node in functions(tree))


@lru_cache(maxsize=32)
def _beside_cells(path: str, _changed: int) -> tuple[ast.FunctionDef, ...]:
    tree, _ = parsed(Path(path).read_text(encoding="utf-8"), path)
    whole = [line for node in tree.body for line in (node.body if isinstance(node, ast.With) else [node])]
    apart = {*functions(tree)}
    return tuple(line for line in whole if isinstance(line, ast.FunctionDef) and line not in apart)


def functions(tree: ast.Module) -> Iterator[ast.FunctionDef]:
    """The cells as they stand in the file: functions that end by returning what they define."""
    for node in tree.body:
        if isinstance(node, ast.FunctionDef) and any(is_app(d, ("cell",)) for d in node.decorator_list):
            yield node


def markdown(node: ast.FunctionDef) -> ast.expr | None:
    """Text of a cell that shows one by ``mo.md``."""
    match node.body:
        case [*_, ast.Expr(shown), ast.Return()] | [*_, ast.Expr(shown)]:
            match shown:
                case ast.Call(ast.Attribute(ast.Name("mo"), "md"), [text]):
                    return text
    return None


def texts(lines: Iterable[ast.stmt]) -> Iterator[ast.expr]:
    """Texts that lines of a cell show: those that stand by themselves, and what ``mo.md`` is given."""
    for line in lines:
        yield from standing([line])
        for call in nodes(line):
            match call:
                case ast.Call(ast.Attribute(ast.Name("mo"), "md"), [text]):
                    yield text


def standing(lines: Iterable[ast.stmt]) -> Iterator[ast.Constant]:
    """Texts that stand by themselves among the lines of a cell."""
    for line in lines:
        match line:
            case ast.Expr(ast.Constant(str()) as text):
                yield text


def constant(node: ast.expr | None) -> str:
    """A text as it stands in the source; of one with values in it the first part, of anything else nothing."""
    match node:
        case ast.Constant(str(text)) | ast.JoinedStr([ast.Constant(str(text)), *_]):
            return text
    return ""


def is_app(node: ast.expr, kinds: tuple[str, ...]) -> bool:
    """Whether a decorator or context is ``app.cell``, ``app.setup`` and the like, called or not."""
    node = node.func if isinstance(node, ast.Call) else node
    return isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name) and node.attr in kinds


def call(frame: FrameType) -> ast.Call:
    """Call expression that ``frame`` is making now."""
    position = list(frame.f_code.co_positions())[frame.f_lasti // 2]
    body = cell(frame).body
    for node in (n for statement in body for n in nodes(statement) if isinstance(n, ast.Call)):
        for indent in (0, body[0].col_offset):  # marimo runs a cell without the indentation that it has in the file
            end_column = (node.end_col_offset or 0) - indent
            if position == (node.lineno, node.end_lineno, node.col_offset - indent, end_column):
                return node
    raise RuntimeError(f"{mistakes.place(frame.f_code.co_filename, frame.f_lineno)}: its source cannot be read")


@lru_cache(maxsize=4096)
def nodes(tree: ast.AST) -> tuple[ast.AST, ...]:
    """All nodes of a tree whose shape stays, in the order of `ast.walk`: once for all who look for something in it."""
    found = [tree]
    for node in found:
        for name in node._fields:
            part = getattr(node, name, None)
            if isinstance(part, ast.AST):
                found.append(part)
            elif isinstance(part, list):
                found += [each for each in part if isinstance(each, ast.AST)]
    return tuple(found)


def calls_of(tree: ast.AST, name: str) -> Iterator[ast.Call]:
    """Calls of the function of that name."""
    for node in nodes(tree):
        match node:
            case ast.Call(ast.Name(called)) if called == name:
                yield node


_SCOPES = (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef)
_INNER = (ast.Lambda, ast.ListComp, ast.SetComp, ast.DictComp, ast.GeneratorExp)


@lru_cache(maxsize=4096)
def bound(node: ast.AST) -> tuple[str, ...]:
    """Names that a statement binds where it stands, in the order of its text; what has a scope of its own keeps its."""
    return tuple(_bound(node))


def _bound(node: ast.AST) -> Iterator[str]:
    waiting = [node]
    while waiting:
        part = waiting.pop()
        if isinstance(part, ast.Name):  # nearly all of them: every statement of a worksheet is looked through
            if isinstance(part.ctx, ast.Store):
                yield part.id
            continue
        if isinstance(part, _SCOPES):
            yield part.name
            continue
        if isinstance(part, _INNER):
            yield from (n.target.id for n in ast.walk(part) if isinstance(n, ast.NamedExpr))
            continue
        if isinstance(part, ast.alias):
            yield part.asname or part.name.partition(".")[0]
        elif isinstance(part, ast.MatchAs | ast.MatchStar) and part.name:
            yield part.name
        for name in reversed(part._fields):
            inner = getattr(part, name, None)
            if isinstance(inner, list):
                waiting += [each for each in reversed(inner) if isinstance(each, ast.AST)]
            elif isinstance(inner, ast.AST):
                waiting.append(inner)


def read(node: ast.AST, own: frozenset[str] = frozenset()) -> Iterator[ast.Name]:
    """Names that are read of the worksheet: not the parameters and the others of functions and comprehensions.

    Of a tree that may be changed later too: nothing is kept of it.
    """
    outside: list[ast.AST] = []
    inner = own
    match node:
        case ast.Name(name, ast.Load()) if name not in own:
            yield node
        case ast.Lambda(args) | ast.FunctionDef(args=args):
            outside = [*args.defaults, *filter(None, args.kw_defaults), *getattr(node, "decorator_list", ())]
            inner |= local(node)
        case ast.ListComp() | ast.SetComp() | ast.DictComp() | ast.GeneratorExp():
            outside = [node.generators[0].iter]
            inner |= {name for each in node.generators for name in _bound(each.target)}
    for part in outside:
        yield from read(part, own)
    for part in ast.iter_child_nodes(node):
        yield from read(part, inner)


def local(function: ast.Lambda | ast.FunctionDef) -> set[str]:
    """Names of a function's own: its parameters, and what it binds but for what it calls the worksheet's."""
    body = function.body if isinstance(function, ast.FunctionDef) else []
    given = {n.arg for n in ast.walk(function.args) if isinstance(n, ast.arg)}
    shared = (n for part in body for n in ast.walk(part) if isinstance(n, ast.Global))
    return given.union(*map(_bound, body)).difference(*(n.names for n in shared))


def scopes_of(text: str, path: Path | str = "") -> list[SymbolTable]:
    """Those of the functions that stand outermost; from Python 3.14 on annotations have some too."""
    return [scope for scope in symtable(text, str(path), "exec").get_children() if scope.get_type() == "function"]


def read_outside(scope: SymbolTable) -> Iterator[str]:
    """Names that a function, or what is defined in it, has neither as arguments nor of its own."""
    yield from (symbol.get_name() for symbol in scope.get_symbols() if symbol.is_global())
    for inner in scope.get_children():
        yield from read_outside(inner)


def _file(frame: FrameType) -> tuple[ast.Module, dict[int, str]]:
    linecache.checkcache(frame.f_code.co_filename)
    return parsed("".join(linecache.getlines(frame.f_code.co_filename)), frame.f_code.co_filename)


def _body(tree: ast.Module, line: int) -> tuple[ast.stmt, ...]:
    for node in tree.body:
        if isinstance(node, ast.FunctionDef) and node.lineno <= line <= (node.end_lineno or 0):
            return tuple(node.body)
    return tuple(tree.body)


@lru_cache(maxsize=256)
def parsed(text: str, filename: str = "<unknown>") -> tuple[ast.Module, dict[int, str]]:
    """Tree of a source, which all who ask share and none of them changes, and the comments of its lines.

    Raises SyntaxError, which names the file, where the text is no Python.
    """
    return ast.parse(text, filename), comments(text)


# Whatever may hold a # stands in a text or in a comment, which begin outside of each other: faster than all tokens.
_TEXT_OR_COMMENT = re.compile(
    r"""
    ([A-Za-z]*)(?: \"{3}((?:[^\\]|\\.)*?)\"{3} | '{3}((?:[^\\]|\\.)*?)'{3}
                 | "((?:[^"\\\n]|\\.)*)" | '((?:[^'\\\n]|\\.)*)' )
    | (\#[^\n]*)
    """,
    re.VERBOSE | re.DOTALL,
)


def comments(text: str) -> dict[int, str]:
    """Comments of the lines of a source that is Python, by their numbers."""
    found, line, at = dict[int, str](), 1, 0
    for match in _TEXT_OR_COMMENT.finditer(text):
        if comment := match[6]:
            line += text.count("\n", at, match.start())
            found[line], at = comment.lstrip("# "), match.start()
        elif "f" in match[1].lower() and _is_cut(match[0]):
            tokens = tokenize.generate_tokens(io.StringIO(text).readline)
            return {t.start[0]: t.string.lstrip("# ") for t in tokens if t.type == tokenize.COMMENT}
    return found


def _is_cut(text: str) -> bool:
    """Whether an f-string seems to end within one of its values, which from Python 3.12 on may hold its own quotes."""
    braces = text.replace("{{", "").replace("}}", "")
    return braces.count("{") != braces.count("}")
