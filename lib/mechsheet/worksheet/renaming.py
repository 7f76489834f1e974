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

from mechsheet import units
from mechsheet.worksheet import cells, inputs, mistakes
from mechsheet.worksheet.data_file import ENDINGS
from mechsheet.worksheet.errors import SheetError, as_given, nearest
from mechsheet.worksheet.own_texts import own_texts
from mechsheet.worksheet.scene import is_of
from mechsheet.worksheet.source import functions

_ALL = "g"  # all inputs; one of them may be called so too, as that of gravity
_WORDS = {"a", "A", "I"}  # of English too
_FIRST, _LAST = r"(?<![\w.])(?<!_\{)", r"(?!\w)"  # an index of another symbol, as of φ_{P6}, stays


def renamed(path: Path, old: str, new: str, scenes: Mapping[Path, str]) -> dict[Path, str]:
    """New texts of the worksheet and of those of the ``scenes`` that are its own and name the symbol.

    A symbol is an input or what a cell defines. Everything of that name follows: arguments, ``g.OLD``, keys of scenes,
    whole words of comments and texts. Attributes of other things, columns of rows and properties of options among them,
    arguments of functions that are not the worksheet's own, units, names of files, and a field ``OLD_S`` keep theirs.

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
    text = path.read_bytes().decode()  # with its ends of lines
    if old not in declared and old in _imported(ast.parse(text)):
        raise SheetError(f"{old} is imported, and no symbol of {path.name}")
    for token in _tokens(text):
        if token.type == tokenize.NAME and token.string == new:
            line = text.count("\n", 0, token.start) + 1
            raise SheetError(f"{mistakes.place(path, line)}: {new} stands there already")
    if new in dir(builtins):
        raise SheetError(f"{new} is a name of Python's own")
    texts = {field.name for field in inputs.declared(sheet.inputs) if not field.continuous and not field.whole}
    made = {path: _in_worksheet(text, old, new, sheet.inputs.__name__ if old in declared else "", texts)}
    ast.parse(made[path])
    for scene, held in scenes.items():
        if is_of(held, declared, known) and (other := _in_scene(held, old, new)) != held:
            made[scene] = other
    return made


def _in_worksheet(text: str, old: str, new: str, inputs_class: str, texts: Set[str]) -> str:
    """The text of a worksheet; ``inputs_class`` declares the symbol where it is an input, ``texts`` are no numbers."""
    found = _Others(text, old, inputs_class, texts)
    before, places = ["", ""], list[tuple[int, int, str]]()
    for token in _tokens(text):
        if token.type == tokenize.NAME and token.string == old and not found.keeps(token.start):
            follows = before[1] != "." or (before[0] == "g" and inputs_class) or before[0] == "value"
            if follows and (old != _ALL or before == [_ALL, "."] or found.declares(token.start)):
                places.append((token.start, token.end, new))
        elif token.type in (tokenize.COMMENT, tokenize.STRING) and not found.keeps(token.start):
            within = {place - token.start for place in found.arguments}
            places.append((token.start, token.end, _in_words(token.string, old, new, within)))
        if token.string.strip():
            before = [before[1], token.string]
    for start, end, held in reversed(places):
        text = text[:start] + held + text[end:]
    return text


class _Others:
    """Where a name in a worksheet is that of something else than the symbol."""

    def __init__(self, text: str, name: str, inputs_class: str, texts: Set[str]) -> None:
        self.text, self.name, self.starts, tree = text, name, _starts(text), ast.parse(text)
        self.arguments, self.spans = set[int](), list[tuple[int, int]]()
        own = {node.name for node in ast.walk(tree) if isinstance(node, ast.FunctionDef | ast.ClassDef)}
        own -= {cell.name for cell in functions(tree)}
        imported, self.inputs = _imported(tree), range(0)
        for node in ast.walk(tree):
            match node:
                case ast.Assign([ast.Name(function)], ast.Lambda()):
                    own.add(function)
                case ast.ClassDef(of) if of == inputs_class:
                    self.inputs = range(*self._span(node))
                case ast.ClassDef(of) if _has_field(node, name):
                    own.discard(of)
                    self.spans.append(self._span(node))
        for node in ast.walk(tree):
            if isinstance(node, ast.Call):
                function, called = _called(node.func, imported)
                if function not in own:
                    self._add_units(node, called)
                    if not _takes_any(called, name):
                        self._add_arguments(node)

        for node in own_texts(tree, name, lambda function: _called(function, imported)[1], texts):
            start = self._at(node.lineno, node.col_offset)
            self.spans.append((start, start + 1))

    def keeps(self, place: int) -> bool:
        """Whether what stands at a place keeps its name."""
        return place in self.arguments or any(start <= place < end for start, end in self.spans)

    def declares(self, place: int) -> bool:
        """Whether a place is in the class of the inputs."""
        return place in self.inputs

    def _span(self, node: ast.ClassDef) -> tuple[int, int]:
        return self._at(node.lineno, 0), self.starts[node.end_lineno or node.lineno]

    def _add_arguments(self, call: ast.Call) -> None:
        """An argument of a function that is none of the worksheet's own, as in ``diff(x, n=2)``.

        What takes any names, as `find` does its unknowns, takes symbols.
        """
        self.arguments |= {self._at(k.lineno, k.col_offset) for k in call.keywords if k.arg == self.name}

    def _add_units(self, call: ast.Call, function: Any) -> None:
        """Texts that are given as units."""
        given = [(k.arg, k.value) for k in call.keywords] + list(zip(_parameters(function), call.args, strict=False))
        for node in (part for name, value in given if name in _UNITS for part in ast.walk(value)):
            if isinstance(node, ast.Constant) and isinstance(node.value, str):
                start = self._at(node.lineno, node.col_offset)
                self.spans.append((start, start + 1))

    def _at(self, line: int, column: int) -> int:
        """Where a place of the tree is in the text: its columns are bytes."""
        start = self.starts[line - 1]
        return start + len(self.text[start:].encode()[:column].decode())


_UNITS = ("unit", "unknown_unit")


def _imported(tree: ast.AST) -> dict[str, Any]:
    """What is imported, by the names that it has in the worksheet; none of what is not loaded."""
    found = dict[str, Any]()
    for node in ast.walk(tree):
        match node:
            case ast.ImportFrom(str(module), names):
                there = sys.modules.get(module)
                found |= {each.asname or each.name: getattr(there, each.name, None) for each in names}
            case ast.Import(names):
                first = ((each.asname or each.name.split(".")[0], each) for each in names)
                found |= {name: sys.modules.get(each.name if each.asname else name) for name, each in first}
    return found


def _called(function: ast.expr, imported: Mapping[str, Any]) -> tuple[str, Any]:
    """The name of what is called, and what it is as far as it is imported."""
    match function:
        case ast.Name(name):
            return name, imported.get(name)
        case ast.Attribute(ast.Name(module), name):
            return name, getattr(imported.get(module), name, None)
    return "", None


def _has_field(node: ast.ClassDef, name: str) -> bool:
    """Whether a class has an attribute of that name: a column of rows, a property of options, a method."""
    fields = (line.target for line in node.body if isinstance(line, ast.AnnAssign))
    methods = (line.name for line in node.body if isinstance(line, ast.FunctionDef))
    return name in {*map(ast.unparse, fields), *methods}


def _parameters(function: Any) -> list[str]:
    try:
        return list(signature(function).parameters)
    except (TypeError, ValueError):  # none, or one of C
        return []


def _takes_any(function: Any, name: str) -> bool:
    """Whether a function takes arguments of any name, of which this is one."""
    try:
        takes = signature(function).parameters
    except (TypeError, ValueError):  # none, or one of C
        return False
    return name not in takes and any(p.kind is p.VAR_KEYWORD for p in takes.values())


def _in_words(text: str, old: str, new: str, stay: Set[int]) -> str:
    """Whole words of comments and texts, and ``g.OLD``; a word of English between ``$``, backticks or braces alone.

    Of a name that a unit has too those in brackets and behind numbers are units, and a text that is one.
    """
    first = rf"(?<=\b{_ALL}\.)" if old == _ALL else rf"(?:{_FIRST}|(?<=\b{_ALL}\.))"
    symbol, is_unit = rf"{first}{re.escape(old)}{_LAST}", units.known(old)
    if is_unit and text.strip("\"'") != old and units.known(text.strip("\"'")):
        return text
    if not text.startswith("#") and text.rstrip("\"'").lower().endswith(_FILES):
        return text
    in_units = [found.span() for found in re.finditer(rf"{_IN_BRACKETS}|{_BEHIND_A_NUMBER}", text) if is_unit]
    in_units += _formats(text)
    in_units += [found.span() for found in re.finditer(_FILE, text, re.IGNORECASE)]

    def follow(part: str, start: int) -> str:
        def word(found: re.Match[str]) -> str:
            place = start + found.start()
            stays = place in stay or any(first <= place < last for first, last in in_units)
            return old if stays else new

        return re.sub(symbol, word, part)

    if old not in _WORDS:
        return follow(text, 0)
    return re.sub(r"\$[^$]*\$|`[^`]*`|\{[^}]*\}", lambda found: follow(found[0], found.start()), text)


def _formats(text: str) -> Iterator[tuple[int, int]]:
    """Where a text says how a value is written: ``{k:d}``, ``{day:%d.%m}``, ``{x!r}``, ``%d``, but not ``{k%d}``."""
    yield from (found.span() for found in re.finditer(r"[:!}][^\s{}()\[\]]*(?=\})", text))
    is_formatted = "f" in text.lower().partition("'" if text[-1] == "'" else '"')[0]
    for found in re.finditer(r"%[-+#]?[^\W\d_]", text):
        if not (is_formatted and re.search(r"\{[^{}:]*$", text[: found.start()])):
            yield found.span()


_FILES = (*ENDINGS, ".toml", ".py", ".css")
_FILE = rf"[\w./\\-]+(?:{'|'.join(map(re.escape, _FILES))})\b"  # which the symbol is not
_IN_BRACKETS = r"(?<![\w\])])\[[^\]\n\"']*\]"  # and no index
_BEHIND_A_NUMBER = r"(?:(?<![\w.])\d[\d.,]*(?:e[+-]?\d+)?|\}) ?[^\W\d]+(?:[*/·^]+-?\w+)*"


def _in_scene(text: str, old: str, new: str) -> str:
    """What a scene names; braces hold columns of rows, texts are values, behind numbers and in comments stand units."""
    others = [r"\{[^{}]*\}", r"=\s*(?:\"[^\"\n]*\"|'[^'\n]*')"]
    others += [_BEHIND_A_NUMBER, r"#\s*[^\s,;]+"] if units.known(old) else []
    symbol = rf"(?P<other>{'|'.join(others)})|{_FIRST}{re.escape(old)}{_LAST}"
    return re.sub(symbol, lambda found: found["other"] or new, text)


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
