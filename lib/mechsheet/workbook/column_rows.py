"""The rows of a column that share one formula, and how it means the cells of another column that belong to them."""

import math
import re
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mechsheet.workbook.place import Place, letters, quoted

Index = NDArray[np.intp]
COUNTED = 4  # parentheses inside each other, at most, where the cell of a row is counted
_FURTHER = re.compile(r"\{\{(-?\d+)\}\}")


class Axis(NamedTuple):
    """Rows from one step along an axis to the next, how many steps there are, and positions that each goes on."""

    inner: int
    size: int
    further: int


class Unlike(Exception):
    """The rows have no formula in common."""


class Rows(NamedTuple):
    """Numbers of the rows of a quantity of a ``shape``, whose first number stands in the row ``first`` of its sheet.

    A cell that stands ``alone`` belongs to no row. In a formula ``{{n}}`` stands for a row of the sheet, that of the
    first number being n for the first number; `in_row` puts it in.
    """

    numbers: Index
    shape: tuple[int, ...]
    first: int
    alone: bool = False

    def cells(self, place: Place, at: Index) -> str:
        """The cells of a column at these positions, one for each row."""
        if self.alone or (len(at) > 1 and (at == at[0]).all()):
            return place.at(int(at[0]))
        further = at - self.numbers
        if place.aligned and not further.any():
            return place.name
        if (further == further[0]).all():
            return f"{quoted(place.sheet)}!{self._relative(place, int(further[0]))}"
        return f"INDEX({place.range(0, int(at.max()))},{self._counted(at)}+1)"

    def range(self, place: Place, start: Index, end: Index) -> str:
        """The cells of a column from one position to another, for each row."""
        if self.alone or (len(start) > 1 and (start == start[0]).all() and (end == end[0]).all()):
            return place.range(int(start[0]), int(end[0]))
        if len(start) == 1:
            ends = (self._relative(place, int(x[0] - self.numbers[0])) for x in (start, end))
            return f"{quoted(place.sheet)}!{':'.join(ends)}"
        whole = place.range(0, int(end.max()))
        return ":".join(f"INDEX({whole},{self._counted(x)}+1)" for x in (start, end))

    @staticmethod
    def in_row(text: str, row: int) -> str:
        """A formula as it stands in a row, counted from 0."""
        return _FURTHER.sub(lambda found: str(row + int(found[1])), text) if "{{" in text else text

    def _relative(self, place: Place, further: int) -> str:
        return f"${letters(place.column)}{{{{{place.row + 1 + further}}}}}"

    def _counted(self, at: Index) -> str:
        """Positions as a sum over the axes of the rows: so many for each step along one."""
        axes = _runs(at) if len(at) == math.prod(self.shape) else self._along_axes(at)
        start = int(at[0]) - sum(further * (int(self.numbers[0]) // inner % size) for inner, size, further in axes)
        row = f"ROW()-{self.first + 1}"
        terms = []
        for inner, size, further in axes:
            if further:
                over = f"QUOTIENT({row},{inner})" if inner > 1 else row
                digit = f"MOD({over},{size})" if inner * size < math.prod(self.shape) else over
                digit = f"({row})" if digit == row and further != 1 else digit
                terms.append(digit if further == 1 else f"{further}*{digit}")
        return "+".join([*terms, *([str(start)] if start or not terms else [])]).replace("+-", "-")

    def _along_axes(self, at: Index) -> list[Axis]:
        """The axes of the quantity along which positions of some of its rows go on."""
        digits = np.unravel_index(self.numbers, self.shape)
        varying = [n for n, digit in enumerate(digits) if (digit != digit[0]).any()]
        system = np.stack([np.ones(len(at), int), *(digits[n] for n in varying)], axis=-1)
        found = np.round(np.linalg.lstsq(system, at, rcond=None)[0]).astype(int)
        if not np.array_equal(system @ found, at):
            raise Unlike
        steps = zip(varying, found[1:].tolist(), strict=True)
        return [Axis(math.prod(self.shape[n + 1 :]), self.shape[n], further) for n, further in steps]


def _runs(at: Index) -> list[Axis]:
    """Axes along which positions go on in equal steps, found from the innermost one on."""
    axes: list[Axis] = []
    inner = 1
    while len(at) > 1:
        steps = np.diff(at)
        last = int(np.argmax(steps != steps[0])) + 1 if (steps != steps[0]).any() else len(at)
        fitting = (n for n in range(last, 1, -1) if len(at) % n == 0)
        size = next((n for n in fitting if (at.reshape(-1, n) == at[::n, None] + steps[0] * np.arange(n)).all()), 0)
        if not size:
            raise Unlike
        axes.insert(0, Axis(inner, size, int(steps[0])))
        at, inner = at[::size], inner * size
    return axes
