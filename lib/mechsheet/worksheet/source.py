"""A cell reads its own source: its statements, their comments and the call that is being made."""

import ast
import io
import linecache
import tokenize
from dataclasses import dataclass
from functools import lru_cache
from types import CodeType, FrameType


@dataclass(frozen=True, eq=False)
class Cell:
    """Statements of the running cell, with the comment of each line and where the cell stands."""

    body: tuple[ast.stmt, ...]
    comments: dict[int, str]
    filename: str

    def at(self, line: int) -> str:
        """Place of a line as an error names it."""
        return f"line {line} of " + ("the cell" if "__marimo__cell_" in self.filename else self.filename)


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


def call(frame: FrameType) -> ast.Call:
    """Call expression that ``frame`` is making now."""
    position = list(frame.f_code.co_positions())[frame.f_lasti // 2]
    body = _body(_file(frame)[0], frame.f_lineno)
    for node in (n for statement in body for n in ast.walk(statement) if isinstance(n, ast.Call)):
        for indent in (0, body[0].col_offset):  # marimo runs a cell without the indentation that it has in the file
            end_column = (node.end_col_offset or 0) - indent
            if position == (node.lineno, node.end_lineno, node.col_offset - indent, end_column):
                return node
    raise RuntimeError(f"the source of {frame.f_code.co_filename} line {frame.f_lineno} cannot be read")


def _file(frame: FrameType) -> tuple[ast.Module, dict[int, str]]:
    linecache.checkcache(frame.f_code.co_filename)
    return _parse("".join(linecache.getlines(frame.f_code.co_filename)))


def _body(tree: ast.Module, line: int) -> tuple[ast.stmt, ...]:
    for node in tree.body:
        if isinstance(node, ast.FunctionDef) and node.lineno <= line <= (node.end_lineno or 0):
            return tuple(node.body)
    return tuple(tree.body)


@lru_cache(maxsize=256)
def _parse(text: str) -> tuple[ast.Module, dict[int, str]]:
    tokens = tokenize.generate_tokens(io.StringIO(text).readline)
    comments = {t.start[0]: t.string.lstrip("# ") for t in tokens if t.type == tokenize.COMMENT}
    return ast.parse(text), comments
