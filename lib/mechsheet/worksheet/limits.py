"""The limits of inputs: how a line says them, what they can be compared with, and where values are within them."""

import dataclasses
import operator
import re
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from functools import lru_cache
from typing import Any

import numpy as np

from mechsheet.worksheet import numbers
from mechsheet.worksheet.errors import SheetError
from mechsheet.worksheet.kinds import Input, number

MOST, LEAST = 1e60, 1e-60  # products of a few inputs of this size are still numbers
_EXACT = 2**53  # up to it all whole numbers are floats
_AT_MOST, _AT_LEAST = f"at most {numbers.significant(MOST, 6)} in size", f"at least {numbers.significant(LEAST, 6)}"
_COMPARE = {"<": operator.lt, "<=": operator.le, ">": operator.gt, ">=": operator.ge}
_BEHIND_A_COMMA = re.compile(r",\s*([<>]=?\s*[\w.+-]+)\s*$")
_LIMIT = re.compile(r"\s*(<=|>=|<|>)\s*([^\s<>=]+?),?(?=[\s<>]|$)")


def misplaced(meaning: str) -> str:
    """A limit that stands at the end of a meaning, behind a comma; "" without one."""
    found = _BEHIND_A_COMMA.search(meaning)
    return found[1] if found else ""


def read(text: str, field: str, place: str) -> Iterator[tuple[str, str]]:
    """The limits of a line, all of its text; SheetError naming the place and what cannot be read."""
    at = 0
    while text[at:].strip():
        match = _LIMIT.match(text, at)
        if not match:
            like = "> 0, <= 3 or < S_max"
            raise SheetError(
                f"{place}: limit {text[at:].strip()!r} of {field} cannot be read; limits are such as {like}"
            )
        yield match[1], match[2]
        at = match.end()


def comparable(fields: Iterable[Input], places: Mapping[str, str]) -> None:
    """SheetError where a limit is neither a number nor an input in the same unit."""
    units_of = {field.name: field.unit for field in fields if not field.is_text}
    for field in fields:
        for sign, other in field.limits:
            said = f"{places[field.name]}: limit {sign} {other} of {field.name}"
            if other in units_of:
                if units_of[other] != field.unit:
                    theirs, own = (numbers.in_text(unit) for unit in (units_of[other], field.unit))
                    raise SheetError(f"{said}: {other} is in {theirs}, {field.name} in {own}: give both in one unit")
                continue
            try:
                number(other)
            except ValueError:
                raise SheetError(f"{said}: {other} is neither a number nor an input") from None


def touched(fields: Iterable[Input], names: Collection[str]) -> list[Input]:
    """Those inputs of which one of the names is the own one or that of a limit."""
    return [field for field in fields if field.name in names or any(other in names for _, other in field.limits)]


def rules(fields: Iterable[Input], shown: Mapping[str, Any]) -> Iterator[tuple[Any, Callable[[int], SheetError]]]:
    """The rules for inputs in display units, one by one: where each holds, and what to say of a variant where not.

    ``shown`` has the values of the inputs, and of those that their limits name.
    """

    def say(field: Input, must: str, other: str = "") -> Callable[[int], SheetError]:
        def refusal(i: int) -> SheetError:
            limit = f" = {_element(shown[other], i)}{numbers.suffix(field.unit)}" if other else ""
            named = dataclasses.replace(field, name=f"{field.name} ({i + 1})") if field.many else field
            value = _element(shown[field.name], i)
            value = int(value) if field.whole and abs(value) <= _EXACT and value == np.rint(value) else value
            return SheetError(f"{named.says(value)} must be {must}{limit}", named.name)

        return refusal

    for field in (fields := tuple(fields)):  # what is no number is named before what it would be compared with
        value = shown[field.name]
        size = abs(value) if type(value) in (float, int) else np.abs(np.asarray(value, dtype=float))
        if type(size) not in (float, int) or not size <= MOST:  # of a single number, as most are, one look will do
            yield size < np.inf, say(field, "a finite number")
            yield size <= MOST, say(field, _AT_MOST)
        if field.whole:
            yield np.rint(np.asarray(value, float)) == value, say(field, "a whole number")
            yield size <= _EXACT, say(field, f"at most {_EXACT} in size")
    for field in fields:
        value = shown[field.name]
        for sign, other in field.limits:
            is_input, is_length = other in shown, (sign, other) == (">", "0")
            limit = shown[other] if is_input else _number(other)
            in_unit = "" if is_input else numbers.suffix(field.unit)
            must = "positive" if is_length else f"{sign} {other}{in_unit}"
            yield _COMPARE[sign](value, limit), say(field, must, other * is_input)
            if is_length:
                yield abs(value) >= LEAST, say(field, f"{_AT_LEAST}{in_unit}")


@lru_cache(maxsize=1000)
def _number(text: str) -> float:
    """The number of a limit, which every new value is compared with."""
    return number(text)


def _element(values: Any, i: int) -> Any:
    """One of the values, or the value of all."""
    return np.ravel(values)[i] if np.ndim(values) else values
