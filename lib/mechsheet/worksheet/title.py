"""What arranges a worksheet beside its formulas and tables: title, captions, columns, sliders, moving positions."""

import sys
from dataclasses import dataclass
from numbers import Real
from typing import Any, NamedTuple

from mechsheet.worksheet.errors import SheetError, as_given, is_one, measured, refuse
from mechsheet.worksheet.shown import Shown, page


class Note(NamedTuple):
    """What is told of the cell of that id: a mistake, or what need not be one."""

    cell: str
    text: str
    mistake: bool = True


@dataclass(frozen=True, eq=False)
class Title(Shown):
    """Title block: what the worksheet is about, its file, the day, the mistakes and the tools of the editor."""

    name: str
    text: str
    file: str
    notes: tuple[Note, ...] = ()
    tools: tuple[Any, ...] = ()


@dataclass(frozen=True, eq=False)
class Caption(Shown):
    """Number and title of a drawing, below it; those of a chart or a table stand with it."""

    number: str
    title: str


def caption(number: str, title: str) -> Caption:
    """Caption of a drawing: ``typeset(drawing_21, caption("2.1", "Scheme of the mechanism"))``."""
    return Caption(number, title)


@dataclass(frozen=True, eq=False)
class SideBySide(Shown):
    """Columns of what is shown: ``row`` of them share each row, of 0 as many as find room."""

    columns: tuple[tuple[Any, ...], ...]
    row: int = 0


def side_by_side(*shown: Any, row: int = 0) -> SideBySide:
    """Drawings beside each other, ``row`` of them or as many as find room; of a tuple, one below the other."""
    return SideBySide(tuple(each if isinstance(each, tuple) else (each,) for each in shown), row)


@dataclass(frozen=True, eq=False)
class Mark(Shown):
    """A moving position in SI: it is marked in every chart over the quantity of that name."""

    positions: tuple[tuple[str, float], ...]


def mark(**positions: Any) -> Mark:
    """The position of a slider, such as ``mark(S=S_t)``, to be shown beside what is drawn there."""
    return Mark(tuple(positions.items()))


@dataclass(frozen=True, eq=False)
class Slider(Shown):
    """A control by its range, step and position, all in ``unit``; without a step it rests at any position."""

    start: float
    stop: float
    step: float | None
    value: float
    label: str
    unit: str = "-"


def slider(
    start: float,
    stop: float,
    step: float | None = None,
    value: float | None = None,
    label: str = "",
    unit: str = "-",
) -> Any:
    """A slider, by default at its start: ``turn = slider(0, 360, step=2, label="crank", unit="deg")``.

    Other cells read its position as ``turn.value``, in ``unit``; they run again when it is moved. In a page it is an
    element of marimo, which alone does that; elsewhere a `Slider` that rests at its value.

    Raises SheetError where the value is not within the range.
    """
    made, of = Slider(start, stop, step, start if value is None else value, label, unit), label or "without a label"
    for what, x in {"start": start, "stop": stop, "value": made.value, "step": 1 if step is None else step}.items():
        if not is_one(x) or (what == "step" and isinstance(x, Real) and not x > 0):
            kind = "a number > 0" if what == "step" else "one number"
            refuse(SheetError(f"slider {of}: {what} = {as_given(x)} must be {kind}"))
    measured(unit, f"slider {of}")
    if not start <= made.value <= stop:
        refuse(SheetError(f"slider {of}: value = {made.value} must be {start}..{stop}"))
    # Of another worksheet, evaluated in a page, nothing can be moved there.
    return page().slider(made) if sys._getframe(1).f_globals.get("__name__") == "__main__" else made


@dataclass(frozen=True, eq=False)
class Player(Shown):
    """A slider that plays: to and fro, or ``turning`` always on, from its end to its beginning."""

    slider: Any
    turning: bool = False


def player(slider: Any, turning: bool = False) -> Player:
    """A slider with a play button, which moves it to and fro; ``turning`` always on, from its end to its beginning."""
    return Player(slider, turning)
