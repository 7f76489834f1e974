"""Mistakes in a worksheet, in words: what Python could not compute, and in which line."""

import builtins
import keyword
import re
import sys
from collections.abc import Container, Iterable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from traceback import walk_tb
from types import FrameType

from mechsheet import units
from mechsheet.worksheet.errors import OF_NONE, SheetError, as_written, nearest


def place(file: str | Path, line: int) -> str:
    """A line as every message names it; without a file, and of a cell of the editor, its number: the place is known."""
    return f"line {line}" if not file or "__marimo__cell_" in str(file) else f"{Path(file).name}, line {line}"


def at(file: str | Path, line: int, text: str) -> str:
    """The same with the text of the line, without its comment."""
    return f"{place(file, line)}, {text.partition('  #')[0].strip().removesuffix(':')}"


def undefined(name: str, known: Iterable[str], inputs: Container[str] = ()) -> str:
    """What is told of a name that no cell defines, with what may have been meant.

    >>> undefined("cos", ["cos_1"])
    'the name cos is not defined in any cell (add from numpy import cos to the setup, the first cell)'
    """
    from mechsheet.worksheet import imports  # on use: a worksheet without mistakes needs nothing of it

    line = imports.origin(name)
    hint = f" (add {line} to {_SETUP})" if line else _near(name, known)
    hint = f" ({_ELSEWHERE[name]})" if name in _ELSEWHERE else f" ({_PRODUCT})" if _DOT in name else hint
    hint = f" (did you mean g.{name}?)" if name in inputs else hint
    return f"the name {name} is not defined in any cell{hint}"


_SETUP = "the setup, the first cell"
_ELSEWHERE = {  # names of other languages
    "i": "the imaginary unit is 1j", "j": "the imaginary unit is 1j", "yes": "did you mean True?",
    "no": "did you mean False?", "true": "did you mean True?", "false": "did you mean False?", "π": "did you mean pi?",
    "ln": f"the natural logarithm is log: add from numpy import log to {_SETUP}",
    "log": f"log, the natural logarithm, or log10: add from numpy import log10 to {_SETUP}",
    "lg": f"that is log10: add from numpy import log10 to {_SETUP}", "e": f"add from numpy import e to {_SETUP}",
    "tg": f"that is tan: add from numpy import tan to {_SETUP}",
    "arctg": f"that is arctan: add from numpy import arctan to {_SETUP}",
}  # fmt: skip
_DOT, _PRODUCT = "·", "a product is written *"  # which Python takes for a letter of the name


def twice(*names: str) -> str:
    """What is told of names that the same cells define."""
    are, them = ("are", "them") if len(names) > 1 else ("is", "it")
    rename = f"rename {them} in one of them; a name such as _{names[0]} stays in its cell"
    return f"{', '.join(names)} {are} defined in two cells: {rename}"


def late(name: str, itself: bool) -> str:
    """What is told of a name that has no value yet where its cell reads it: in its own line, or above that."""
    return f"{name} is computed from itself" if itself else f"{name} is defined below its use: move its line up"


def input_names(names: Mapping[str, object]) -> list[str]:
    """Names of the inputs in a namespace."""
    return [field.name for field in getattr(type(names.get("g")), "__inputs__", ())]


def no_input(name: str, known: Iterable[str]) -> str:
    if _DOT in name:
        return f"there is no input {name} ({_PRODUCT})"
    return f"there is no input {name}{_near(name, known)}"


def refused(error: ValueError, path: str) -> str:
    """What a worksheet refuses, and behind it the line that asks for it, such as that of a Find without a solution.

    What is read or written, inputs and a report, has no place there.
    """
    places = _places(error, Path(path).resolve())
    through = {frame.f_globals.get("__name__") for frame, _ in walk_tb(error.__traceback__)}
    if not places or not through.isdisjoint(_READ_OR_WRITTEN) or Path(path).name in str(error):
        return str(error)
    return f"{error} ({place(path, places[-1][1])})"


_READ_OR_WRITTEN = {f"mechsheet.worksheet.{name}" for name in ("data_file", "inputs", "kinds", "lists")}
_READ_OR_WRITTEN |= {"mechsheet.run.arguments", "mechsheet.run.report"}


def _places(error: BaseException, file: Path) -> list[tuple[FrameType, int]]:
    """The lines of a file that an exception went through."""
    return [(f, line) for f, line in walk_tb(error.__traceback__) if Path(f.f_code.co_filename).resolve() == file]


def left(error: SystemExit, path: str) -> str:
    """The line of a worksheet file by which its code ends the process; "" where something else does."""
    *_, frame = (frame for frame, _ in walk_tb(error.__traceback__))
    file = Path(path).resolve()
    places = _places(error, file)
    if not places or frame.f_globals.get("__name__") not in ("_sitebuiltins", places[-1][0].f_globals.get("__name__")):
        return ""
    return at(file, places[-1][1], file.read_text(encoding="utf-8").splitlines()[places[-1][1] - 1])


def told(error: BaseException, path: str) -> str:
    """One line for an exception, with the line of the worksheet file that raised it where one did."""
    file = Path(path).resolve()
    if isinstance(error.__cause__, StopIteration):  # in a generator, which Python says in other words
        error = error.__cause__
    if isinstance(error, SyntaxError) and error.filename and Path(error.filename).resolve() == file:
        text = (error.text or "").lstrip("\ufeff")
        return f"{at(file, error.lineno or 0, text)}: {unread(error)}"
    places = _places(error, file)
    if not places:
        return why(error, ())
    frame = places[-1][0]
    known = {*frame.f_globals, *frame.f_locals, *frame.f_code.co_varnames} - {*dir(builtins)}
    line, text = places[-1][1], file.read_text(encoding="utf-8")
    given = input_names(frame.f_globals)
    return f"{at(file, line, text.splitlines()[line - 1])}: {why(error, known, text, given)}"


def reason(error: BaseException, path: str) -> str:
    """Why one of several runs has no numbers: in the words of what the worksheet raises itself, else with the line."""
    if places := [] if isinstance(error, SheetError) else _places(error, Path(path).resolve()):
        line = Path(path).read_text(encoding="utf-8").splitlines()[places[-1][1] - 1]
        return str(error) if re.search(r"(^|[:;])\s*raise\b", line) else told(error, path)
    return str(error) if isinstance(error, ValueError) else told(error, path)


@contextmanager
def unbound(gives: Container[str], certain: Container[str], path: str) -> Iterator[None]:
    """SheetError where a name has no value that only some ways of a cell bind: of other inputs it may have one."""
    try:
        yield
    except NameError as error:
        if error.name in gives and error.name not in certain:
            raise SheetError(told(error, path)) from None
        raise


def why(error: BaseException, known: Iterable[str], text: str = "", inputs: Container[str] = ()) -> str:
    """An exception in words, with the ``known`` names and those of the ``inputs``; ``text`` is that of the cell."""
    from mechsheet.worksheet.in_words import NOT_BOUND, in_words  # on use: as above

    if isinstance(error, NameError) and error.name:
        called = as_written(error.name)
        if called in inputs:
            return undefined(called, (), inputs)
        name = rf"{called}\b"
        binds = rf"(^|[:;])\s*(def {name}|{name}\s*(=[^=]|,[^(]*=)|for\b[^:]*\b{name}[^:]* in )"
        lines = text.splitlines()
        if places := [n for n, line in enumerate(lines, 1) if re.search(binds, line)]:
            through = [line for _, line in walk_tb(error.__traceback__) if line <= len(lines)]
            read = [n for n in through if re.search(rf"\b{called}\b", lines[n - 1])]
            if read and places[0] < read[-1]:
                return f"{called} {NOT_BOUND}"
            return late(called, itself=bool(read) and places[0] == read[-1])
        return undefined(called, (name for name in known if not name.startswith("_")))
    if isinstance(error, AttributeError):
        name, kind = str(error.name or ""), type(error.obj)
        if fields := getattr(kind, "__inputs__", ()):
            return no_input(name, (field.name for field in fields))
        if hasattr(kind, "__row__"):
            return f"the table has no column {name}{_near(name, vars(error.obj))}"
        if hasattr(kind, "__properties__"):
            return f"{kind.__name__} has no {name}{_near(name, vars(error.obj))}"
    if imported := re.match(r"cannot import name '(\w+)' from '([\w.]+)'", str(error)):
        name, module = imported.groups()
        if module == "mechsheet.units" and (meant := units.nearest(name)):
            return f"unit {name} is not known; nearest: {', '.join(meant)}"
        return f"{module} has no {name}{_near(name, dir(sys.modules.get(module)))}"
    said, told = " ".join(as_written(str(error)).split()), in_words(error)
    if told and "positional argument" not in said:
        return told
    if " " not in said:  # the bare name of a key, or nothing
        said = f"{type(error).__name__}: {said}".removesuffix(": ")
    hint = next((hint for pattern, hint in _HINTS.items() if re.search(pattern, said)), "")
    if hint == _SEVERAL and (name := _list(error, said, text)):
        done = "multiplied" if "multiply" in said else "computed"
        hint = f"{name} is a list: np.array([..]) is {done} element by element"
    elif hint == _SEVERAL and "positional" in said and not re.search(r"\d,\d", text):
        hint = ""  # too many arguments of another kind
    elif hint == _SEVERAL and (typed := re.search(_TYPED, text)):  # often it is a line further up
        hint += f", as in {typed[0].strip()}"
    return (told or re.sub(r"'?\bChosen(Text)?\b'?", "an option", said)) + (f" ({hint})" if hint else "")


def _list(error: BaseException, said: str, text: str) -> str:
    """The list that a line computes with, by its name or its bracket; "" where it is something else."""
    values, read = dict[str, object](), ""
    for frame, line in [*walk_tb(error.__traceback__)][-1:]:
        values = {as_written(name): value for name, value in {**frame.f_globals, **frame.f_locals}.items()}
        read = "".join(text.splitlines()[line - 1 : line]).partition("#")[0]
    named = (name for name in re.findall(r"[^\W\d]\w*", read) if isinstance(values.get(name), list))
    return next(named, "[..]" if re.search(r"\blist\b", said) or re.search(r"(?<![\w\])])\[", read) else "")


def unread(error: SyntaxError) -> str:
    """Why Python cannot read a line, with what may have been meant by who writes formulas."""
    if "U+FEFF" in error.msg:
        return (
            "the file begins with a byte order mark (BOM), which Python's editors refuse: save it as UTF-8 without one"
        )
    text = (error.text or "").partition("#")[0]
    # These say enough; the last one Python 3.14 says of words that are like its own too.
    if error.msg.startswith(("expected", "unexpected indent", "unindent", "duplicate")) or "Did you mean" in error.msg:
        return error.msg
    if function := re.match(_FUNCTION, text):
        return f"a function is written {function[1]} = lambda {function[2]}: .."
    if (word := re.match(_WORD, text)) and keyword.iskeyword(word[1]) and word[1] != "lambda":
        return f"{word[1]} is a word of Python: take another name, such as {word[1]}_1"
    if error.msg.endswith("was never closed"):
        opened = text[(error.offset or 1) - 1 :].strip()
        return f"{error.msg}: {opened}" if text.count(opened[:1]) > 1 else error.msg
    meant = {**_MEANT, **_EQUAL} if _EQUALS in error.msg or "cannot assign" in error.msg else _MEANT
    if hint := next((hint for pattern, hint in meant.items() if re.search(pattern, text)), "") or _product(error, text):
        return f"{re.sub(_GUESS, '', error.msg)} ({hint})"  # two guesses are one too many
    return error.msg


_EQUALS = "instead of '='"
_GUESS = r"( here)?\. (Perhaps|Maybe) .*"


def _product(error: SyntaxError, text: str) -> str:
    """Where a * may be missing, or brackets behind a function: between two parts that stand beside each other."""
    from mechsheet.worksheet import imports  # on use: as above

    for found in re.finditer(_BESIDE, text):
        left, right = (part for part in found.groups() if part)
        if found.end() < (error.offset or 0) or {left, right} & {*keyword.kwlist}:
            continue
        if right != "(" and imports.origin(left).startswith("from numpy"):
            return f"what a function is of stands in brackets: {left}({right})"
        left, right = "(..)" if left in ")]" else left, "(..)" if right == "(" else right
        return f"is a * missing? {left} * {right}"
    return ""


_SEVERAL = "several values stand there: a decimal number has a point, not a comma"
_HINTS = {
    r"'str'|<U": "a text is no number",
    r"for \^|'bitwise_xor'": "a power is written **, not ^",
    r"'(int|float|complex|numpy\.\w+|Quantity)' object is not callable": "is a * missing before the bracket?",
    r"can't multiply sequence|'tuple' and|and 'tuple'|'list' and|and 'list'|concatenate (list|tuple)": _SEVERAL,
    r"for unary .: '(tuple|list)'": _SEVERAL,
    r"return arrays must be of ArrayType|positional arguments? but \d+ were given": _SEVERAL,
    r"'?NoneType\b": OF_NONE,
    r"'[A-Z]\w*' object (is not (iterable|subscriptable)|has no len)|type '[A-Z]\w*' has no len|non-iterable [A-Z]": (
        "inputs are read by their names: g.L, and a table's as g.bolts.x, or for bolt in g.bolts"
    ),
    r"'(Found|Solution)'|type (Found|Solution)\b": "what a Find has found is its .value",
    r"\bfunction'|type function\b": "a function is computed with what stands in its brackets, such as s(phi)",
    r"'Chosen(Text)?'": "an option is no number: its properties are read by their names, such as g.steel.R_e",
    r"truth value of an array": "of many values each is chosen by np.where(condition, this, that)",
    r"out of bounds for axis 0 with size 0|zero-size array|empty sequence|argument is empty|is empty$": (
        "no element is left there: none meets the condition"
    ),
    r"infs or NaNs|finite values|^SVD did not converge": (
        "what it is made of does not exist everywhere, as where a mechanism does not close"
    ),
    r"^only integers, slices": "a place is a whole number, as int(bolt.z); a column of a table is read by its name",
    r"cannot convert float (NaN|infinity) to integer": "what it is made of is none, as the root of a negative one",
    r"^StopIteration$": "next has found nothing for which its condition holds",
    r"unhashable type": "an array, a list or a table can be no key, and no member of a set",
}
_TYPED = r"(?m)^[ \t]*\w+(:\s*\w+)?\s*=[^#=\"'({\[\n]*?\d,\d[^#\n]*"
_FUNCTION = r"\s*([^\W\d]\w*)\(([\w\s,]+)\)\s*:?=(?!=)"  # as Mathcad has it
_WORD = r"\s*([a-z]+)\s*(?::[^=]*)?=(?!=)"
_BESIDE = (
    r"(?<![\w.])(\d[\d.]*(?:[eE][-+]?\d+)?+)\s*+([^\W\d][\w.]*|\()"  # 2a
    r"|([\w.]*\w|[)\]])\s+([\w.]*\w|\()|([)\]])([\w.]+|\()"
)
_CHOICE = "a choice is written this if condition else that"
_COMPARED = "comparisons are written <=, >= and !="
_INDEX = "an index is written x_1"
_MEANT = {  # by the line that cannot be read
    r"^\s*lambda\s*(:[^=]*)?=": "lambda is a word of Python: the symbol λ is lamda",
    r"[·×⋅∙]": _PRODUCT,
    r"[−–]": "a minus is written -",
    r"[²³⁴]": "a power is written **",
    r"[₀-₉]|^\s*[^\W\d]\w*(_\{|\.\d)": _INDEX,
    r"√": "a root is written sqrt(..)",
    r"∑": "a sum is written sum(..)",
    r"∞": "infinity is written inf, from numpy",
    r"[½¼¾⅓⅔]": "a fraction is written 1/2",
    r"°": "an angle in degrees is written 30 * deg",
    r"[≤≥≠]|<>|=<|=>": _COMPARED,
    r"[“”„«»‘’]": 'a text stands between " and "',
    r"&&|\|\|": "conditions are joined by and, or",
    r"\|[^|]+\|": "an absolute value is written abs(..)",
    r":=": "a definition is written =, not :=",
    r"\d,\d": "a decimal number has a point, not a comma",
    r"\d\s+\d{3}\b": "a number has no spaces",
    r"\d\s*%\s*($|[-+*/)])": "per cent are hundredths: 0.05, shown by [%]",
    r"[\w)]!(?!=)": "a factorial is written factorial(n), from math",
    r"^\s*[^\W\d]\w*'": "a name has no '",
    r"\?.*:|=\s*if\b|\bthen\b": _CHOICE,
    r"^\s*\d[\d.]*[^\W\d]\w*\s*=": "a name begins with a letter",
    r"\d\.\d+\.\d": "a number has one point",
    r"[-+*/=]\s*$": "what follows is missing",
}
_EQUAL = {
    r"^\s*(if|elif|while)\b": "what is compared is written ==",
    r"^[^=(\[{]*[-+*/][^=]*=|^\s*[\d.]+\s*=": "left of = stands one name; find solves an equation",
    "": "a line has one =, behind its name; what is compared is written ==",
}


def _near(name: str, known: Iterable[str]) -> str:
    near = nearest(name, known)
    return f" (did you mean {near[0]}?)" if near else ""
