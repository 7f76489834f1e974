"""Long tables and lines of many points as a page shows them: the rows at both ends, the points that one can see."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from mechsheet.worksheet.table import Column, Figure

ENDS = 100  # rows at either end of a table that has more than twice as many
PIECES = 400  # of a curve, each of which takes two pixels across: of each its ends, its least and its greatest value
MOST = 4 * PIECES  # points of a curve or a path that are all drawn
APART = 0.5  # px along a path of more points, of which one cannot see more


def rows(count: int) -> NDArray[np.intp]:
    """The rows of so many that are shown."""
    every = np.arange(count)
    return every if count <= 2 * ENDS else np.concatenate([every[:ENDS], every[-ENDS:]])


def shortened(columns: Sequence[Column]) -> tuple[tuple[Column, ...], int]:
    """Columns with the rows that are shown, and how many between them are not."""
    count = len(columns[0].values)
    shown = rows(count)
    return tuple(_taken(column, shown) for column in columns), count - len(shown)


def foot(left_out: int, columns: int) -> str:
    """HTML of the foot of a table of some columns, so many of whose rows are not shown."""
    if not left_out:
        return ""
    told = f"rows {ENDS + 1} to {ENDS + left_out} of {2 * ENDS + left_out} are not shown"
    return f'<tfoot><tr><td class="ms-text" colspan="{columns}">{told}</td></tr></tfoot>'


def thinned(figure: Figure) -> Figure:
    """A figure with the points that its curves need to look as they are, and the ends of their gaps."""
    count = len(figure.x.values)
    if count <= MOST:
        return figure
    columns = [np.asarray(column.values, dtype=float) for column in (figure.x, *figure.lines)]
    shown = np.zeros(count, dtype=bool)
    ends = np.arange(PIECES + 1) * count // PIECES
    for piece in map(np.arange, ends[:-1], ends[1:]):
        shown[[piece[0], piece[-1]]] = True
        for values in columns:
            known = piece[np.isfinite(values[piece])]
            shown[known[[values[known].argmin(), values[known].argmax()]] if known.size else known] = True
    for values in columns:
        change = np.flatnonzero(np.diff(np.isfinite(values)))
        shown[change] = shown[change + 1] = True
    at = np.flatnonzero(shown)
    return replace(figure, x=_taken(figure.x, at), lines=tuple(_taken(line, at) for line in figure.lines), every=1)


def apart(path: Sequence[complex]) -> Sequence[complex]:
    """The points of a path [px] that it needs to look as it is."""
    if len(path) <= MOST:
        return path
    points = np.asarray(path)
    steps = np.floor(np.concatenate([[0.0], np.abs(np.diff(points)).cumsum()]) / APART)
    shown = np.concatenate([[True], steps[1:] > steps[:-1]])
    shown[-1] = True
    kept: list[complex] = points[shown].tolist()
    return kept


def _taken(column: Column, at: NDArray[np.intp]) -> Column:
    return replace(column, values=column.values[at])
