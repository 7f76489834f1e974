"""Mistakes in a worksheet, in words: what Python could not compute, and in which line."""

import builtins
import difflib
from collections.abc import Iterable
from pathlib import Path
from traceback import walk_tb


def at(line: int, text: str) -> str:
    """A line of a worksheet as a mistake names it: its number, and its text without its comment."""
    return f"line {line}, {text.partition('  #')[0].strip()}"


def undefined(name: str, known: Iterable[str]) -> str:
    return f"the name {name} is not defined in any cell{_near(name, known)}"


def no_input(name: str, known: Iterable[str]) -> str:
    return f"there is no input {name}{_near(name, known)}"


def told(error: BaseException, path: str) -> str:
    """One line for an exception, with the line of the worksheet file that raised it where one did."""
    file = Path(path).resolve()
    if isinstance(error, SyntaxError) and error.filename and Path(error.filename).resolve() == file:
        return f"{file.name}, {at(error.lineno or 0, error.text or '')}: {error.msg}"
    places = [(f, line) for f, line in walk_tb(error.__traceback__) if Path(f.f_code.co_filename).resolve() == file]
    known = {*places[-1][0].f_globals, *places[-1][0].f_locals} - {*dir(builtins)} if places else set[str]()
    why = _why(error, known)
    if not places:
        return why
    line = places[-1][1]
    return f"{file.name}, {at(line, file.read_text(encoding='utf-8').splitlines()[line - 1])}: {why}"


def _why(error: BaseException, known: Iterable[str]) -> str:
    if type(error) is NameError and error.name:
        return undefined(error.name, (name for name in known if not name.startswith("_")))
    fields = getattr(type(error.obj), "__inputs__", ()) if isinstance(error, AttributeError) else ()
    if fields:
        return no_input(str(getattr(error, "name", "")), (field.name for field in fields))
    return " ".join(f"{type(error).__name__}: {error}".removesuffix(": ").split())


def _near(name: str, known: Iterable[str]) -> str:
    near = difflib.get_close_matches(name, list(known), n=1)
    return f" (did you mean {near[0]}?)" if near else ""
