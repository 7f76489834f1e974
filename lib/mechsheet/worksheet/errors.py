"""The one error that a worksheet raises to its reader."""

import re
import sys
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from numbers import Real
from typing import Any, NoReturn

from mechsheet import units
from mechsheet.worksheet import shown as values

_called = ContextVar("_called", default=False)


class SheetError(ValueError):
    """Input or a result that cannot be used; the message is one line for the person at the worksheet.

    ``of`` is the input that is refused, such as ``P6`` or ``bolts.x (2)``, where it is one.
    """

    def __init__(self, text: str, of: str = "") -> None:
        super().__init__(text)
        self.of = of


class Waits(SheetError):
    """A number is to be computed from one that is NaN: why it is, another line tells."""


# What a line of a worksheet raises for some numbers; anything else is a mistake in it, whatever they are.
OF_NUMBERS = (ValueError, ArithmeticError, LookupError, AssertionError, StopIteration, RuntimeError)
OF_NONE = "a function without return gives None, and so does next(.., None)"


def is_of_numbers(error: Exception) -> bool:
    """Whether it is one of `OF_NUMBERS`, or of None in the place of a number that there is for others."""
    of_none = isinstance(error, TypeError | AttributeError) and "NoneType" in str(error)
    return of_none or isinstance(error, OF_NUMBERS)


_LONG = 60  # characters of what was given that an error shows
_LISTED = 5  # of many places or names


def cut(text: str) -> str:
    """A text as an error shows it: of a long one the beginning.

    >>> cut("P6"), cut("9" * 5000)[50:]
    ('P6', '9999999999.. (5000 characters)')
    """
    return text if len(text) <= _LONG else f"{text[:_LONG]}.. ({len(text)} characters)"


def as_written(text: str) -> str:
    """A text with the names that begin with _ as the worksheet has them: those that are run are called by their cell.

    >>> as_written("_cell3_k + _cell_Hbol_k + k")
    '_k + _k + k'
    """
    return _BY_CELL.sub("", text)


_BY_CELL = re.compile(r"(?<!\w)_cell(\d+|_[^\W_]+)(?=_)")


def some(places: Iterable[str]) -> list[str]:
    """Places or names, of many the first.

    >>> some("abcdefgh")
    ['a', 'b', 'c', 'd', 'e and 3 more']
    """
    listed = list(places)
    if len(listed) <= _LISTED + 1:
        return listed
    return [*listed[: _LISTED - 1], f"{listed[_LISTED - 1]} and {len(listed) - _LISTED} more"]


def nearest(name: str, known: Iterable[str], count: int = 1, cutoff: float = 0.6) -> list[str]:
    """Known names that are most like another one, whatever letters are capitals: the most like first.

    >>> nearest("p6", ["phi_P6", "P6", "L5"])
    ['P6']
    """
    import difflib  # on use: only a mistaken name needs it

    alike = dict[str, list[str]]()
    for each in known:
        alike.setdefault(each.lower(), []).append(each)
    near = difflib.get_close_matches(name[:_LONG].lower(), alike, n=count, cutoff=cutoff)
    return [each for lowered in near for each in alike[lowered]][:count]


def as_given(value: object) -> str:
    """What was given, as an error shows it: a text between quotes."""
    try:
        return cut(repr(value) if isinstance(value, str) else " ".join(str(value).split()))
    except ValueError:
        return "a whole number of thousands of digits"


def refuse(error: SheetError, shown: Any = None) -> NoReturn:
    """Stop the running cell and those that need it: in its own page the reason stands in its place, elsewhere raise.

    A served page hides the text of exceptions, so the reason is shown as the cell's output: ``shown``, or
    the message of the error.
    """
    if "marimo" in sys.modules and not _called.get():
        values.page().refused(error, shown)
    raise error


def is_one(x: Any) -> bool:
    """Whether something is one real number, or an array or a recorded quantity of one."""
    return isinstance(x, Real) or getattr(x, "ndim", 1) == 0


def measured(unit: str, of: str = "") -> units.Unit:
    """The unit of that text; one that is not known is refused, in the name of what has it."""
    try:
        return units.parse(unit)
    except ValueError as error:
        refuse(SheetError(f"{of}: {error}" if of else str(error)))


def texts(of: str, **given: object) -> None:
    """Refuse what is no text where one is asked for."""
    for name, value in given.items():
        if not isinstance(value, str):
            refuse(SheetError(f"{of}: its {name} must be a text between quotes, not {as_given(value)}"))


def function(f: object, of: str) -> None:
    """Refuse what is no function where one of the unknowns is asked for."""
    if not callable(f):
        raise SheetError(f"{of} takes a function of what is unknown, such as lambda x: x**2 - 2, not {as_given(f)}")


@contextmanager
def raised() -> Iterator[None]:
    """Let refusals raise, in a page too: a worksheet that is called as a function must not stop the cell that calls."""
    token = _called.set(True)
    try:
        yield
    finally:
        _called.reset(token)
