"""A text as an input, or in the rows of a table and the options of a choice: a label."""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mechsheet.worksheet import errors, numbers
from mechsheet.worksheet.errors import SheetError
from mechsheet.worksheet.kinds import Input, Worded

LONGEST = 200  # characters, so that a formula of a workbook can hold it
_APART = frozenset(";|")  # what stands between the cells of a table and its rows


@dataclass(frozen=True)
class TextLine(Worded):
    """A text, which no number rests on: in a recording its use is a guard."""

    @property
    def is_text(self) -> bool:
        return True

    def read(self, value: object) -> Any:
        """The text in one line; a number is the text that it is written as."""
        number = isinstance(value, float) and np.isfinite(value)
        text = " ".join((numbers.significant(value, 15) if number else str(value)).split())  # type: ignore[arg-type]
        if isinstance(value, bool | np.bool_ | list | dict) or len(text) > LONGEST or not text.isprintable():
            must = f"must be a line of at most {LONGEST} characters"
            raise SheetError(f"{self.says(errors.as_given(value))} {must}", self.name)
        if self.many and not _APART.isdisjoint(text):
            raise SheetError(f"{self.says(errors.as_given(value))} must be a text without ; and |", self.name)
        return text

    def array(self, values: Iterable[Any]) -> NDArray[Any]:
        return np.array([*values], object)

    def si(self, value: Any, default: Any) -> Any:
        return value

    def first(self, value: Any) -> Any:
        return self.read(value)

    def taken(self, value: Any) -> Any:
        return self.read(value)

    def leaves(self, value: Any) -> dict[str, tuple[Input, Any]]:
        return {self.name: (self, 0)}

    def texts(self, value: Any) -> tuple[str, ...]:
        return (value,)
