"""A place in a workbook: the cell or column where a quantity stands, and the defined name that means it."""

import re
from functools import lru_cache
from typing import NamedTuple

_ADDRESS = re.compile(r"[A-Za-z]{1,3}\d+|[rR]\d*([cC]\d*)?|[cC]\d*|[rR]\d+[cC]\d+")


class DefinedNames:
    """Defined names of a workbook.

    The rule: a quantity keeps the name that it has in the worksheet, without the ``_S`` of a field; a point or a
    vector has one for each coordinate, ``P56`` X56 and Y56, ``R56`` R56x and R56y. A name that is the address of
    a cell (``L3``), or that another quantity has already, small and capital letters taken as the same, gets a
    line behind it: ``L3_``.
    """

    def __init__(self) -> None:
        self.taken: set[str] = set()

    def new(self, name: str) -> str:
        while _ADDRESS.fullmatch(name) or name.lower() in self.taken:
            name += "_"
        self.taken.add(name.lower())
        return name


class Place(NamedTuple):
    """Where a quantity stands: a cell or a column, and the name that means it (in a column: the cell of its row).

    The name of a column whose rows are not those of the tables means all of it: it is not ``aligned``. Of an input,
    ``differs`` is how many columns further it stands whether it differs from the exported one, ``typed`` likewise
    where one of several is typed.
    """

    name: str
    sheet: str
    row: int
    column: int
    aligned: bool = True
    differs: int = 0
    typed: int = 0

    def at(self, k: int = 0) -> str:
        """Address of the k-th cell."""
        return f"{quoted(self.sheet)}!${letters(self.column)}${self.row + k + 1}"

    def text(self, k: int) -> str:
        """Address of the cell in which the k-th is typed."""
        return self._replace(column=self.column + self.typed).at(k)

    def range(self, first: int, last: int) -> str:
        """Address of the cells from the first one to the last."""
        column = letters(self.column)
        return f"{quoted(self.sheet)}!${column}${self.row + first + 1}:${column}${self.row + last + 1}"

    def meaning(self, size: int) -> str:
        """What the name is defined as; a row without $ is that of the cell which uses it."""
        if not self.aligned:
            return f"={self.range(0, size - 1)}"
        return f"={self.at() if size == 1 else f'{quoted(self.sheet)}!${letters(self.column)}1'}"


def called(text: str) -> str:
    """Name of what is stated in words: whole words of them, up to 40 letters.

    >>> called("equilibrium of forces, bodies 2..7"), called("20 % of G")
    ('equilibrium_of_forces_bodies_2_7', 'check_20_of_G')
    """
    words = re.findall(r"\w+", text.replace("'", ""), re.ASCII)
    whole = [n for n in range(1, len(words) + 1) if len("_".join(words[:n])) <= 40]
    name = "_".join(words[: max(whole, default=1)])[:40]
    if len(whole) < len(words):
        name = re.sub(r"(_[a-z]{1,3})+$", "", name)
    return name if re.match("[A-Za-z]", name) else f"check_{name}".rstrip("_")


@lru_cache(maxsize=1024)
def letters(column: int) -> str:
    """Letters of a column counted from 0."""
    head, tail = divmod(column, 26)
    return (letters(head - 1) if head else "") + chr(65 + tail)


@lru_cache(maxsize=256)
def quoted(sheet: str) -> str:
    """Name of a sheet as an address has it."""
    return "'" + sheet.replace("'", "''") + "'"
