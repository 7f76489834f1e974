"""A text as an input, or in the rows of a table and the options of a choice: a label."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from mechsheet.worksheet import errors, numbers
from mechsheet.worksheet.errors import SheetError
from mechsheet.worksheet.kinds import Input

_LONGEST = 200  # characters, so that a formula of a workbook can hold it
_APART = frozenset(";|")  # what stands between the cells of a table and its rows


@dataclass(frozen=True)
class TextLine(Input):
    """A text, which no number rests on: in a recording its use is a guard."""

    @property
    def is_text(self) -> bool:
        return True

    def display(self, value: Any) -> Any:
        return value

    def read(self, value: object) -> Any:
        """The text in one line; a number is the text that it is written as."""
        number = isinstance(value, float) and np.isfinite(value)
        text = " ".join((numbers.significant(value, 15) if number else str(value)).split())  # type: ignore[arg-type]
        if isinstance(value, bool | np.bool_ | list | dict) or len(text) > _LONGEST or not text.isprintable():
            must = f"must be a line of at most {_LONGEST} characters"
            raise SheetError(f"{self.says(errors.as_given(value))} {must}", self.name)
        if self.many and not _APART.isdisjoint(text):
            raise SheetError(f"{self.says(errors.as_given(value))} must be a text without ; and |", self.name)
        return text

    def si(self, value: Any, default: Any) -> Any:
        return value

    def first(self, value: Any) -> Any:
        return self.read(value)

    def written(self, value: Any, default: Any) -> Any:
        return value

    def text(self, value: Any) -> str:
        return str(value)

    brief = text

    def readings(self, value: object) -> Iterator[str]:
        yield from ()

    def taken(self, value: Any) -> Any:
        return self.read(value)

    def leaves(self, value: Any) -> dict[str, tuple[Input, Any]]:
        return {self.name: (self, 0)}

    def texts(self, value: Any) -> tuple[str, ...]:
        return (value,)
