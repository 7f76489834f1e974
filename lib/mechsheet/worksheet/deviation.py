"""How far a made input may lie from its value: its tolerance, as it stands on the line that declares it."""

import re
from dataclasses import dataclass
from math import inf
from typing import Any, Protocol

from mechsheet.worksheet import numbers
from mechsheet.worksheet.errors import SheetError

SIGMAS = 3.0  # standard deviations that the tolerance of a normal distribution stands for
_SIGN = r"(?:±|\+/?-)\s*(.*?)\s*(normal)?"
_AT_END = re.compile(r"(?:±|\+/?-)\s*[\d.,]+[^;]*$")
LIKE = "± 0.001, ± 1 % or ± 0.001 normal"


class Number(Protocol):
    """What reads a number in the unit of an input, and says its name with a value."""

    def read(self, value: object) -> Any:
        """Number in the display unit; SheetError naming the input and what cannot be used of it."""

    def says(self, value: object) -> str:
        """The input with this value, as an error names it."""


@dataclass(frozen=True)
class Deviation:
    """A tolerance: ``amount`` in the display unit of the input, or of ``percent`` of its value.

    All values within are equally likely, unless ``normal``: then it is three standard deviations.
    """

    amount: float
    percent: bool = False
    normal: bool = False

    def of(self, value: float) -> float:
        """Greatest deviation from a value, both in the display unit."""
        return abs(value) * self.amount / 100 if self.percent else self.amount

    def text(self, unit: str, to: numbers.Notation | None = None) -> str:
        """The tolerance of an input with that unit, as it is written, or as a notation writes its unit.

        >>> Deviation(0.001).text("m"), Deviation(1.0, percent=True, normal=True).text("m")
        ('± 0.001 m', '± 1 % normal')
        """
        behind = " %" if self.percent else numbers.behind(unit, to) if to else numbers.suffix(unit)
        return f"± {numbers.significant(self.amount, 10)}{behind}" + " normal" * self.normal


def is_meant(text: str) -> bool:
    """Whether a part of a line that declares an input is its tolerance."""
    return text.strip().startswith(("±", "+-", "+/-"))


def is_misplaced(text: str) -> bool:
    """Whether a meaning or a limit ends in what looks like a tolerance."""
    return _AT_END.search(text) is not None


def read(text: str, own: Number, part: Number) -> Deviation:
    """Tolerance from a text such as ``± 0.001``, ``+- 1 %`` or ``± 0.5 mm normal``.

    ``own`` is the input in its unit, ``part`` the same in percent.

    Raises SheetError naming the input and what cannot be used.
    """
    match = re.fullmatch(_SIGN, text.strip())
    amount, normal = (match[1], bool(match[2])) if match else (text.strip(), False)
    field, percent = (part, True) if amount.endswith("%") else (own, False)
    try:
        x = float(field.read(amount.removesuffix("%").strip()))
    except SheetError as error:
        raise SheetError(f"tolerance of {error}; it is such as {LIKE}") from None
    if not 0 <= x < inf:
        raise SheetError(f"tolerance of {field.says(numbers.significant(x, 10))} must be a finite number >= 0")
    return Deviation(x, percent, normal)
