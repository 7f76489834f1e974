"""Units in which the page can show what is declared in one: a click on that behind a number offers the others."""

from typing import Any

from mechsheet import units
from mechsheet.document.markup import HTML
from mechsheet.worksheet import numbers
from mechsheet.worksheet.numbers import Notation

_UNIT = "<ms-unit>{}</ms-unit>"
_PLAIN = HTML._replace(unit="\u00a0{}")  # a number and its unit stand in one line
_SWITCHED = _PLAIN._replace(degrees=_UNIT.format(HTML.degrees), unit=f"\u00a0{_UNIT}")


def notation(unit: str) -> Notation:
    """How a number and this unit are written."""
    return _SWITCHED if len(_alike(unit)) > 1 else _PLAIN


def head(unit: str) -> str:
    """A unit over a column."""
    return f"[{_UNIT.format(units.shown(unit)) if len(_alike(unit)) > 1 else units.shown(unit)}]"


def told(unit: str) -> list[list[Any]]:
    """This unit and those that measure the same: how each is printed, its factor, and what stands behind a number."""
    to = notation(unit)
    return [[units.shown(other), units.parse(other).factor, numbers.behind(other, to)] for other in _alike(unit)]


def _alike(unit: str) -> list[str]:
    return [unit, *(other for other in units.alike(unit)[1:] if "-" not in (unit, other))]
