"""Renaming a symbol of a worksheet: in its lines, comments and texts, and in its scenes."""

import ast
import builtins
import difflib
import io
import keyword
import re
import tokenize
import tomllib
from collections.abc import Mapping
from pathlib import Path

from mechsheet.worksheet import cells, inputs
from mechsheet.worksheet.errors import SheetError, as_given

_WORDS = {"a", "A", "I"}  # of English too
_FIRST, _LAST = r"(?<![\w.])(?<!_\{)", r"(?!\w)"  # an index of another symbol, as of φ_{P6}, stays


def renamed(path: Path, old: str, new: str, scenes: Mapping[Path, str]) -> dict[Path, str]:
    """New texts of the worksheet and of those of the ``scenes`` that are its own and name the symbol.

    A symbol is an input or what a cell defines. Everything of that name follows: arguments, ``g.OLD``, keys of scenes,
    whole words of comments and texts. Attributes of other things, and a field ``OLD_S``, keep theirs.

    Raises SheetError where OLD is no symbol, or NEW is no name or one that stands there already.
    """
    sheet = cells.load(path)
    declared = [field.name for field in inputs.declared(sheet.inputs)]
    known = {*declared, *(name for name in sheet.results if not name.startswith("_"))}
    if old not in known:
        near = difflib.get_close_matches(old, known, n=1)
        raise SheetError(f"{as_given(old)} is no symbol of {path.name}" + (f"; nearest: {near[0]}" if near else ""))
    if not new.isidentifier() or keyword.iskeyword(new):
        raise SheetError(f"{as_given(new)} is no name: it must be letters, digits and _, first a letter")
    text = path.read_text(encoding="utf-8")
    if line := next(
        (token.start[0] for token in _tokens(text) if token.type == tokenize.NAME and token.string == new), 0
    ):
        raise SheetError(f"{new} stands in line {line} of {path.name} already")
    if new in dir(builtins):
        raise SheetError(f"{new} is a name of Python's own")
    made = {path: _in_worksheet(text, old, new, old in declared)}
    ast.parse(made[path])
    for scene, held in scenes.items():
        if _is_of(held, declared) and (other := _in_scene(held, old, new)) != held:
            made[scene] = other
    return made


def _in_worksheet(text: str, old: str, new: str, is_input: bool) -> str:
    lines, before = text.splitlines(keepends=True), ["", ""]
    places = list[tuple[tuple[int, int], tuple[int, int], str]]()
    for token in _tokens(text):
        if token.type == tokenize.NAME and token.string == old:
            if before[1] != "." or (before[0] == "g" and is_input) or before[0] == "value":
                places.append((token.start, token.end, new))
        elif token.type in (tokenize.COMMENT, tokenize.STRING):
            places.append((token.start, token.end, _in_words(token.string, old, new)))
        if token.string.strip():
            before = [before[1], token.string]
    for (row, column), (last, end), held in reversed(places):
        head, tail = lines[row - 1][:column], lines[last - 1][end:]
        lines[row - 1 : last] = [head + held + tail]
    return "".join(lines)


def _in_words(text: str, old: str, new: str) -> str:
    """Whole words of comments and texts, and ``g.OLD``; a word of English between ``$``, backticks or braces alone."""
    symbol = rf"(?:{_FIRST}|(?<=\bg\.)){re.escape(old)}{_LAST}"
    if old not in _WORDS:
        return re.sub(symbol, new, text)
    return re.sub(r"\$[^$]*\$|`[^`]*`|\{[^}]*\}", lambda found: re.sub(symbol, new, found[0]), text)


def _in_scene(text: str, old: str, new: str) -> str:
    return re.sub(rf"{_FIRST}{re.escape(old)}{_LAST}", new, text)


def _is_of(text: str, declared: list[str]) -> bool:
    """Whether a scene gives inputs, and all of them are the worksheet's."""
    try:
        given = tomllib.loads(text).get("inputs", {})
    except tomllib.TOMLDecodeError:
        return False
    return bool(given) and set(given) <= set(declared)


def _tokens(text: str) -> list[tokenize.TokenInfo]:
    return list(tokenize.generate_tokens(io.StringIO(text).readline))
