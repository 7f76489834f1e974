"""What Python or numpy could not compute, in words: by the kind of the error, with the names and values of the line.

Where no rule knows better words there are none: then the error's own are told.
"""

import ast
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from re import Match
from types import FunctionType, ModuleType
from typing import Any, NamedTuple

import numpy as np

from mechsheet.worksheet import failed_part
from mechsheet.worksheet.errors import OF_NONE, as_given, as_written, nearest, some
from mechsheet.worksheet.failed_part import UNKNOWN, Failed, Part, is_number


def in_words(error: BaseException) -> str:
    """What a line could not compute, as its reader would say it; "" where no better words are known than its own."""
    said = " ".join(as_written(str(error)).split())
    failed = failed_part.of(error)
    rules = (rule for rule in _RULES if isinstance(error, rule.kinds))
    return next(filter(None, (r.words(failed, m, error) for r in rules if (m := re.search(r.said, said)))), "")


def _count(shape: Sequence[object]) -> str:
    """How many values there are.

    >>> _count([2, 3]), _count([1]), _count([])
    ('2 x 3 values', '1 value', '1 number')
    """
    return " x ".join(map(str, shape)) + (" value" if [*shape] == [1] else " values") if len(shape) else "1 number"


def _has(part: Part) -> str:
    return f"{part.text} has {_count(part.shape)}" if part.shape else f"{part.says} is one number"


def _called(failed: Failed, name: str) -> str:
    """A function by its name in the line, where Python has none for it."""
    if not name.endswith("<lambda>"):
        return name.rpartition("<locals>.")[2]
    called = failed.part(failed.node.func) if isinstance(failed.node, ast.Call) else None
    return called.text if called and getattr(called.value, "__name__", "") == "<lambda>" else "the function"


def _lacking(failed: Failed, said: Match[str], _: Any) -> str:
    return f"{_called(failed, said[1])} is called without {said[2].replace(chr(39), '')}"


def _arguments(failed: Failed, said: Match[str], _: Any) -> str:
    values = "1 value" if said[3] == "1" else f"{said[3]} values"
    return f"{_called(failed, said[1])} is called with {values}, and takes {said[2]}"


def _no_argument(failed: Failed, said: Match[str], _: Any) -> str:
    return f"{_called(failed, said[1])} has no argument {said[2]}"


def _unpacked(failed: Failed, said: Match[str], _: Any) -> str:
    names = [ast.unparse(each) for each in getattr(failed.node, "elts", ())]
    if not names:
        return ""
    there, value = f"{len(names)} names: {', '.join(names)}", next(iter(failed.parts()), None)
    if value and is_number(value.value):
        return f"{value.says} is one number for {there}"
    if "NoneType" in said.string:
        return f"{value.text if value else 'what is given'} is None: {OF_NONE}"
    if "non-iterable" in said.string:
        return ""
    if got := len(value.value) if value and value.shape else (re.search(r"got (\d+)", said.string) or ["", ""])[1]:
        return f"{value.text if value else 'what is given'} has {got} values for {there}"
    count = "fewer" if "not enough" in said.string else "more"
    return f"{count} values are given than there are names: {', '.join(names)}"


def _nothing(failed: Failed, *_: Any) -> str:
    parts = failed.parts() if failed.is_of_numbers else []
    empty = [part for part in parts if part.size == 0] or [part for part in parts if part.value is UNKNOWN]
    needs = f": {failed.function.rpartition('.')[2]} takes at least one value" if failed.function else ""
    return f"{empty[0].text} is empty{needs}{_none_meets(failed)}" if empty else ""


def _none_meets(failed: Failed) -> str:
    """Why nothing is left, where a condition stands in the line."""
    return " (none meets the condition)" * any(isinstance(each, ast.Compare) for each in ast.walk(failed.node))


def _of_other_length(failed: Failed, said: Match[str], _: Any) -> str:
    """Of what does not fit each other, each with how many values it has."""
    shapes, joined = _shapes(said.string), bool(re.search(_JOINED, said.string))
    parts = (failed.stored() or (failed.members() if joined else failed.parts())) if failed.is_of_numbers else []
    if len(shapes) == len(parts) == 2 and all(part.shape is None for part in parts):
        return f"{parts[0].text} has {_count(shapes[0])}, {parts[1].text} has {_count(shapes[1])}: {_APART}"
    # One number fits to any others but those that it is joined with; a tuple may be a shape itself.
    several = [part for part in parts if joined or (part.shape and part.size != 1)]
    several = [part for part in several if part.size >= 0 and not (shapes and isinstance(part.value, tuple))]
    if len({tuple(part.shape or ()) for part in several}) > 1:
        return f"{', '.join(some(map(_has, several)))}: {_APART}"
    return f"{' and '.join(map(_count, shapes))} do not fit each other" if len({*shapes}) > 1 else ""


_JOINED = "inhomogeneous|input array|number of dimensions"
_APART = "they do not fit each other"


def _shapes(said: str) -> list[tuple[int, ...]]:
    """Those that numpy names, without numbers alone."""
    return [tuple(map(int, re.findall(r"\d+", each))) for each in re.findall(r"\(\d+,(?:\d+,?)*\)", said)]


def _by_zero(failed: Failed, *_: Any) -> str:
    match failed.node:
        case ast.BinOp(x, ast.Pow(), _):
            return f"0 has no negative power: {_equal(failed.part(x), 0)}"
        case ast.BinOp(_, _, x) | ast.AugAssign(_, _, x) if not isinstance(x, ast.Constant):
            return f"division by zero: {_equal(failed.part(x), 0)}"
    return "division by zero"


def _equal(part: Part, value: object) -> str:
    return part.says if part.value is not UNKNOWN else f"{part.text} = {value}"


def _not_there(failed: Failed, *_: Any) -> str:
    given = ", ".join(part.says for part in failed.parts())
    return f"{failed.function} has no value for {given}" if failed.function and failed.is_of_numbers else ""


def _too_large(failed: Failed, *_: Any) -> str:
    if not isinstance(failed.node, ast.expr) or not failed.is_of_numbers:
        return ""
    given = ", ".join(part.says for part in failed.parts() if part.says != part.text)
    return f"{failed.part(failed.node).text} is beyond the largest number, 1.8e308{given and f': {given}'}"


def _place(failed: Failed, said: Match[str], _: Any) -> str:
    known = re.search(r"index (-?\d+) is out of bounds for axis \d+ with size (\d+)", said.string)
    if not isinstance(failed.node, ast.Subscript):
        fits = (part for part in failed.parts() if known and part.shape and int(known[2]) in part.shape)
        has = next(map(_has, fits), f"there are {_count([int(known[2])])}" if known else "")
        return f"{has}, counted from 0: none is at {known[1]}" if known else ""
    container, *places = failed.parts()
    shape = container.shape or ([len(container.value)] if isinstance(container.value, str) else None)
    if shape is None and known:
        shape = [int(known[2])]
    if shape is None:
        return ""
    at = ", ".join(_equal(place, known[1]) if known and len(places) == 1 else place.says for place in places)
    if 0 in shape:
        return f"{container.text} is empty: there is none at {at}{_none_meets(failed)}"
    if "too many" in said.string:
        return f"{container.text} has {_count(shape)}: {at} are too many places for it"
    return f"{container.text} has {_count(shape)}, counted from 0: there is none at {at}"


def _key(failed: Failed, _: Any, error: Any) -> str:
    if not isinstance(failed.node, ast.Subscript) or not error.args:
        return ""
    container, *places = failed.parts()
    if not isinstance(container.value, Mapping):
        return ""
    key, known = error.args[0], [*container.value]
    by = f" ({places[0].text})" if len(places) == 1 and not isinstance(failed.node.slice, ast.Constant) else ""
    near = _near(key, (each for each in known if isinstance(each, str))) if isinstance(key, str) else ""
    has = f"it has {', '.join(some(map(as_given, known)))}" if known else "it is empty"
    return f"{container.text} has no {as_given(key)}{by}: {has}{near}"


def _near(name: str, known: Iterable[str]) -> str:
    near = nearest(name, known)
    return f" (did you mean {near[0]}?)" if near else ""


def _no_number(failed: Failed, said: Match[str], _: Any) -> str:
    """Of what is a text, nothing, a function or complex where a number is taken."""
    parts = failed.parts() if failed.is_of_numbers else []
    unknown = [part for part in parts if part.value is UNKNOWN]
    of_values = not failed.function or bool(re.search(_OF_KINDS, said.string))
    for part in parts if of_values else ():
        if isinstance(part.value, str):
            return f"{part.says} is a text, no number"
        if isinstance(part.value, np.ndarray) and part.value.dtype.kind == "U":
            return f"{part.text} has texts, no numbers"
        if part.value is None or (unknown == [part] and "NoneType" in said.string):
            return f"{part.text} is None: {OF_NONE}"
        if isinstance(part.value, FunctionType):
            return f"{part.text} is a function: it is computed with what stands in its brackets, such as {part.text}(x)"
    if re.search(r"complex|not supported for the input types|real number", said.string):
        for part in parts:
            if np.iscomplexobj(part.value):
                return f"{part.says} is complex, where a real number is taken"
    return ""


_OF_KINDS = r"\bstr\b|'str'|<U|StrDType|string|None|real number|function|not supported for the input types"


def _condition(failed: Failed, *_: Any) -> str:
    """Of a condition of many values."""
    match failed.above, failed.node:
        case ast.BoolOp(op, each), _:
            return _joined(op, each)
        case _, ast.BoolOp(op, each):
            return _joined(op, each)
        case _, ast.Compare(left, [_, _, *_] as ops, others):
            pairs = zip([left, *others], ops, others, strict=False)
            return _joined(ast.And(), [ast.Compare(a, [op], [b]) for a, op, b in pairs])
        case _, ast.UnaryOp(ast.Not(), x):
            return f"of many values it is written ~({ast.unparse(x)})"
        case _, ast.Call(ast.Name("min" | "max" as name)):
            other = {"min": "np.minimum", "max": "np.maximum"}[name]
            several = "".join(f"{_has(part)}: " for part in failed.parts() if part.shape)
            return f"{several}of many values {other}(a, b) takes the one or the other at each place"
    known = failed.part(failed.node) if isinstance(failed.node, ast.expr) else next(iter(failed.parts()), None)
    has = f"{_has(known)}, and a condition is one: " if known and known.shape else ""
    return f"{has}of many values each is chosen by np.where(condition, this, that)"


def _joined(op: ast.boolop, conditions: Sequence[ast.expr]) -> str:
    sign = " & " if isinstance(op, ast.And) else " | "
    return f"of many values it is written {sign.join(f'({ast.unparse(each)})' for each in conditions)}"


def _text(failed: Failed, said: Match[str], _: Any) -> str:
    whole = "whole " if "int()" in said.string else ""
    given = (part.says for part in failed.parts() if isinstance(part.value, str) and repr(part.value) == said[1])
    return f"{next(given, said[1])} is no {whole}number"


def _not_whole(failed: Failed, *_: Any) -> str:
    place = (
        ": a place is a whole number, as int({})" if isinstance(failed.node, ast.Subscript) else " is no whole number"
    )
    for part in failed.parts():
        if isinstance(part.value, float | np.floating):
            value = "" if part.says == part.text else f" = {float(part.value)}"
            return f"{part.text}{value}{place.format(part.text)}"
        if isinstance(part.value, str):
            return f"{part.says} is a text: a place is a whole number, and a column of a table is read by its name"
    return ""


def _singular(failed: Failed, *_: Any) -> str:
    matrix = [part.text for part in failed.parts() if part.shape and len(part.shape) > 1]
    return f"{matrix[0] if matrix else 'the matrix'} is singular: its equations depend on each other"


def _not_square(failed: Failed, *_: Any) -> str:
    matrix = [_has(part) for part in failed.parts() if part.shape]
    return f"{matrix[0]}: it must have as many rows as columns" if matrix else ""


def _attribute(failed: Failed, _: Any, error: Any) -> str:
    of, name = error.obj, error.name
    if not name and isinstance(failed.node, ast.Attribute):  # of what is set, of which Python tells them from 3.13 on
        of, name = failed.part(failed.node.value).value, failed.node.attr
    if of is None and isinstance(failed.node, ast.Attribute):
        return f"{failed.part(failed.node.value).text} is None: {OF_NONE}"
    if isinstance(of, ModuleType):
        return f"{of.__name__} has no {name}{_near(name, dir(of))}"
    kind = next((word for kinds, word in _KINDS if isinstance(of, kinds)), "")
    if not kind or not isinstance(failed.node, ast.Attribute):
        return ""
    near = " (np.array(..) has it)" if kind == "a list" and hasattr(np.ndarray, name) else _near(name, dir(of))
    return f"{failed.part(failed.node.value).text} is {kind}, which has no {name}{near}"


_KINDS: tuple[tuple[Any, str], ...] = (
    (int | float | complex | np.number, "a number"),
    (str, "a text"),
    (list | tuple, "a list"),
    (np.ndarray, "an array"),
)


def _one_number(failed: Failed, said: Match[str], error: Any) -> str:
    lacks = "and has no places" if isinstance(failed.node, ast.Subscript) else "where several are taken"
    for part in failed.parts() if failed.is_of_numbers else ():
        meant = not isinstance(error, TypeError) or f"{type(part.value).__name__}'" in said.string
        if is_number(part.value) and meant:
            return f"{part.says} is one number, {lacks}"
    return ""


def _several_numbers(failed: Failed, *_: Any) -> str:
    several = [_has(part) for part in failed.parts() if part.shape]
    name = failed.function.removeprefix("math.")
    other = f": np.{name} computes each" if name != failed.function and hasattr(np, name) else ""
    return f"{several[0]}, where {failed.function} takes one number{other}" if several and failed.function else ""


def _assertion(failed: Failed, *_: Any) -> str:
    given = ", ".join(part.says for part in failed.parts() if part.says != part.text)
    return f"it does not hold{given and f': {given}'}"


def _negative(failed: Failed, *_: Any) -> str:
    less = (part for part in failed.parts() if isinstance(part.value, int | float | np.integer) and part.value < 0)
    return next((f"{part.says} must not be negative" for part in less), "")


def _too_few(failed: Failed, *_: Any) -> str:
    return next((f"{_has(part)}, too few for {failed.function}" for part in failed.parts() if part.shape), "")


def _one_row(failed: Failed, *_: Any) -> str:
    rows = (part for part in failed.parts() if part.shape and len(part.shape) > 1)
    return next((f"{_has(part)}, where {failed.function} takes one row" for part in rows), "")


def _shape(_: Failed, said: Match[str], __: Any) -> str:
    return f"{_count([int(said[1])])} are not {_count(said[2].split(','))}"


def _brackets(failed: Failed, said: Match[str], _: Any) -> str:
    sign = "|" if isinstance(getattr(failed.node, "op", None), ast.BitOr) else "&"
    return f"conditions that are joined by {sign} stand each in brackets, as (a > 1) {sign} (b < 2)"


def _called_none(failed: Failed, *_: Any) -> str:
    return f"{failed.function} is None: {OF_NONE}" if failed.function else ""


def _axis(failed: Failed, said: Match[str], _: Any) -> str:
    has = next((f"{_has(part)}: " for part in failed.parts() if part.shape), "")
    return f"{has}axis {said[1]} is none of its {said[2]}, counted from 0"


NOT_BOUND = "has no value there: none of the ways that the lines above it went gives it one"
_FROM_FIELD = "has the value of its field: what a line computes has a name of its own"


class _Rule(NamedTuple):
    kinds: Any
    said: str
    words: Callable[[Failed, Match[str], Any], str]


_LENGTHS = (
    r"broadcast|same length|aligned|match|inhomogeneous|[Dd]imensions?\b|shorter than|longer than|lengths?\b|shapes? "
)
_ONE = r"not iterable|not subscriptable|has no len|one dimension|enough dimensions|index to scalar"
_RULES = (  # the first that knows words
    _Rule(TypeError, r"(\S+)\(\) missing \d+ required [\w-]+ arguments?: (.*)", _lacking),
    _Rule(TypeError, r"(\S+)\(\) takes (.+?) positional arguments? but (\d+) (?:was|were) given", _arguments),
    _Rule(TypeError, r"(\S+?)(?:\(\))? (?:takes|expected) (.+?) arguments?(?:,? got | ?\()(\d+)", _arguments),
    _Rule(TypeError, r"(\S+)\(\) got an unexpected keyword argument '(\w+)'", _no_argument),
    _Rule((TypeError, ValueError), "unpack", _unpacked),
    _Rule(ZeroDivisionError, "", _by_zero),
    _Rule(ValueError, r"math domain error|expected a|not defined for", _not_there),
    _Rule(OverflowError, "out of range|range error|too large", _too_large),
    _Rule(IndexError, r"out of (range|bounds)|too many indices", _place),
    _Rule(KeyError, "", _key),
    _Rule((ValueError, IndexError, TypeError), r"empty|zero-size|\(0\) specified", _nothing),
    _Rule(ValueError, r"truth value", _condition),
    _Rule(ValueError, r"(?:could not convert string|invalid literal).*?('.*?')", _text),
    _Rule((TypeError, IndexError), r"as an integer|indices must be integers|only integers", _not_whole),
    _Rule(TypeError, r"only (?:0-dim|length-1|size-1)", _several_numbers),
    _Rule(TypeError, r"bitwise_(or|and)\b|for [|&]:", _brackets),
    _Rule(TypeError, "'NoneType' object is not callable", _called_none),
    _Rule(TypeError, "", _no_number),
    _Rule(ValueError, "Singular matrix", _singular),
    _Rule(ValueError, r"must be square|at least two-dimensional", _not_square),
    _Rule(ValueError, r"cannot reshape array of size (\d+) into shape \((\d.*?),?\)", _shape),
    _Rule(ValueError, r"too small|too few", _too_few),
    _Rule(ValueError, r"rank-1 array", _one_row),
    _Rule(AttributeError, r"has no attribute", _attribute),
    _Rule(AttributeError, r"cannot assign to field '(\w+)'", lambda _, said, __: f"input {said[1]} {_FROM_FIELD}"),
    _Rule((ValueError, IndexError), r"axis (-?\d+) is out of bounds for array of dimension (\d+)", _axis),
    _Rule((TypeError, ValueError, IndexError), _ONE, _one_number),
    _Rule((TypeError, ValueError, IndexError), _LENGTHS, _of_other_length),
    _Rule(ValueError, r"non-negative|negative dimensions", _negative),
    _Rule(AssertionError, "^$", _assertion),
    _Rule(NameError, r"(?:local|free) variable '(\w+)'", lambda _, said, __: f"{said[1]} {NOT_BOUND}"),
    _Rule(RecursionError, "", lambda *_: "it calls itself without an end"),
    _Rule(
        MemoryError,
        r"allocate (.+?) for an array with shape \((.*?),?\)",
        lambda _, said, __: f"{_count(said[2].split(', '))} take {said[1]}, which the memory has not",
    ),
)
