"""What arranges a worksheet beside its formulas and tables: title, captions, columns, moving positions, players."""

from dataclasses import dataclass
from typing import Any

from mechsheet.worksheet.shown import Shown


@dataclass(frozen=True)
class Note:
    """A mistake in the cell of that id."""

    cell: str
    text: str


@dataclass(frozen=True)
class Title(Shown):
    """Title block: what the worksheet is about, its file, the day, and the mistakes that the editor has found."""

    name: str
    text: str
    file: str
    notes: tuple[Note, ...] = ()


@dataclass(frozen=True)
class Caption(Shown):
    """Number and title of a drawing, below it; those of a chart or a table stand with it."""

    number: str
    title: str


def caption(number: str, title: str) -> Caption:
    """Caption of a drawing: ``typeset(drawing_21, caption("2.1", "Scheme of the mechanism"))``."""
    return Caption(number, title)


@dataclass(frozen=True)
class SideBySide(Shown):
    """Columns of what is shown, as many in a row as find room."""

    columns: tuple[tuple[Any, ...], ...]


def side_by_side(*shown: Any) -> SideBySide:
    """Drawings beside each other; of a tuple, one below the other."""
    return SideBySide(tuple(each if isinstance(each, tuple) else (each,) for each in shown))


@dataclass(frozen=True)
class Mark(Shown):
    """A moving position in SI: it is marked in every chart over the quantity of that name."""

    positions: tuple[tuple[str, float], ...]


def mark(**positions: Any) -> Mark:
    """The position of a slider, such as ``mark(S=S_t)``, to be shown beside what is drawn there."""
    return Mark(tuple(positions.items()))


@dataclass(frozen=True)
class Player(Shown):
    """A slider that plays: to and fro, or ``turning`` always on, from its end to its beginning."""

    slider: Any
    turning: bool = False


def player(slider: Any, turning: bool = False) -> Player:
    """A slider with a play button, which moves it to and fro; ``turning`` always on, from its end to its beginning."""
    return Player(slider, turning)
