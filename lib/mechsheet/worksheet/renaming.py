"""Renaming a symbol of a worksheet: in its lines, comments and texts, and in its scenes."""

import ast
import builtins
import io
import keyword
import re
import sys
import tokenize
from collections.abc import Iterator, Mapping, Set
from inspect import signature
from itertools import accumulate
from pathlib import Path
from typing import Any, NamedTuple

from mechsheet.worksheet import cells, inputs, mistakes
from mechsheet.worksheet.errors import SheetError, as_given, nearest
from mechsheet.worksheet.scene import is_of
from mechsheet.worksheet.source import functions

_WORDS = {"a", "A", "I"}  # of English too
_FIRST, _LAST = r"(?<![\w.])(?<!_\{)", r"(?!\w)"  # an index of another symbol, as of φ_{P6}, stays


def renamed(path: Path, old: str, new: str, scenes: Mapping[Path, str]) -> dict[Path, str]:
    """New texts of the worksheet and of those of the ``scenes`` that are its own and name the symbol.

    A symbol is an input or what a cell defines. Everything of that name follows: arguments, ``g.OLD``, keys of scenes,
    whole words of comments and texts. Attributes of other things, arguments of functions that are not the worksheet's
    own, and a field ``OLD_S`` keep theirs.

    Raises SheetError where OLD is no symbol, or NEW is no name or one that stands there already.
    """
    sheet = cells.load(path)
    declared = [field.name for field in inputs.declared(sheet.inputs)]
    given = {name for cell in sheet.cells for name in cell.gives if not name.startswith("_")}
    known = {*declared, *(given - {"g"} if declared else given)}
    if old not in known:
        near = nearest(old, known)
        raise SheetError(f"{as_given(old)} is no symbol of {path.name}" + (f"; nearest: {near[0]}" if near else ""))
    if not new.isidentifier() or keyword.iskeyword(new):
        raise SheetError(f"{as_given(new)} is no name: it must be letters, digits and _, first a letter")
    if new.startswith("_"):
        raise SheetError(f"{new} begins with _: such a name stays within its cell")
    text = path.read_text(encoding="utf-8")
    for token in _tokens(text):
        if token.type == tokenize.NAME and token.string == new:
            line = text.count("\n", 0, token.start) + 1
            raise SheetError(f"{mistakes.place(path, line)}: {new} stands there already")
    if new in dir(builtins):
        raise SheetError(f"{new} is a name of Python's own")
    made = {path: _in_worksheet(text, old, new, old in declared)}
    ast.parse(made[path])
    for scene, held in scenes.items():
        if is_of(held, declared) and (other := _in_scene(held, old, new)) != held:
            made[scene] = other
    return made


def _in_worksheet(text: str, old: str, new: str, is_input: bool) -> str:
    stay, before = _keywords_of_others(text, old), ["", ""]
    places = list[tuple[int, int, str]]()
    for token in _tokens(text):
        if token.type == tokenize.NAME and token.string == old and token.start not in stay:
            if before[1] != "." or (before[0] == "g" and is_input) or before[0] == "value":
                places.append((token.start, token.end, new))
        elif token.type in (tokenize.COMMENT, tokenize.STRING):
            within = {place - token.start for place in stay}
            places.append((token.start, token.end, _in_words(token.string, old, new, within)))
        if token.string.strip():
            before = [before[1], token.string]
    for start, end, held in reversed(places):
        text = text[:start] + held + text[end:]
    return text


def _keywords_of_others(text: str, name: str) -> set[int]:
    """Where a name is that of an argument of a function that is none of the worksheet's own, as in ``diff(x, n=2)``.

    What takes any names, as `find` does its unknowns, takes symbols.
    """
    tree, starts = ast.parse(text), _starts(text)
    own = {node.name for node in ast.walk(tree) if isinstance(node, ast.FunctionDef | ast.ClassDef)}
    own -= {cell.name for cell in functions(tree)}
    imported, found = dict[str, Any](), set[int]()
    for node in ast.walk(tree):
        match node:
            case ast.Assign([ast.Name(function)], ast.Lambda()):
                own.add(function)
            case ast.ImportFrom(str(module), names):
                there = sys.modules.get(module)
                imported |= {each.asname or each.name: getattr(there, each.name, None) for each in names}
    for node in ast.walk(tree):
        match node:
            case ast.Call(ast.Name(function)) if function in own or _takes_any(imported.get(function), name):
                continue
            case ast.Call(keywords=keywords):
                for k in keywords:
                    if k.arg == name:
                        line = text[starts[k.lineno - 1] :].encode()  # its columns are bytes
                        found.add(starts[k.lineno - 1] + len(line[: k.col_offset].decode()))
    return found


def _takes_any(function: Any, name: str) -> bool:
    """Whether a function takes arguments of any name, of which this is one."""
    try:
        takes = signature(function).parameters
    except (TypeError, ValueError):  # none, or one of C
        return False
    return name not in takes and any(p.kind is p.VAR_KEYWORD for p in takes.values())


def _in_words(text: str, old: str, new: str, stay: Set[int]) -> str:
    """Whole words of comments and texts, and ``g.OLD``; a word of English between ``$``, backticks or braces alone."""
    symbol = rf"(?:{_FIRST}|(?<=\bg\.)){re.escape(old)}{_LAST}"

    def follow(part: str, start: int) -> str:
        return re.sub(symbol, lambda word: old if start + word.start() in stay else new, part)

    if old not in _WORDS:
        return follow(text, 0)
    return re.sub(r"\$[^$]*\$|`[^`]*`|\{[^}]*\}", lambda found: follow(found[0], found.start()), text)


def _in_scene(text: str, old: str, new: str) -> str:
    return re.sub(rf"{_FIRST}{re.escape(old)}{_LAST}", new, text)


class _Token(NamedTuple):
    """A token, and where it starts and ends in the text."""

    type: int
    string: str
    start: int
    end: int


def _tokens(text: str) -> Iterator[_Token]:
    """Tokens of Python; a string with values in it is one, which it is to Python itself up to 3.11."""
    starts, begun = _starts(text), list[int]()
    for token in tokenize.generate_tokens(io.StringIO(text).readline):
        start, end = (starts[row - 1] + column for row, column in (token.start, token.end))
        kind = tokenize.tok_name[token.type]
        if kind.endswith("STRING_START"):
            begun.append(start)
        elif kind.endswith("STRING_END"):
            first = begun.pop()
            if not begun:
                yield _Token(tokenize.STRING, text[first:end], first, end)
        elif not begun:
            yield _Token(token.type, token.string, start, end)


def _starts(text: str) -> list[int]:
    """Where each line starts, and where the last one ends."""
    return [0, *accumulate(len(line) for line in io.StringIO(text))]
