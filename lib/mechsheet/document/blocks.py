"""Wide tables as blocks of columns, one below the other, each with the columns that name the rows.

Many rows of a few columns stand side by side.
"""

from collections.abc import Sequence
from itertools import takewhile
from math import ceil

from mechsheet.worksheet import numbers
from mechsheet.worksheet.table import Column, Table

_BETWEEN = 2.0  # in em between rows that stand side by side
_LEAST = 10  # rows that stand below one another
_SCREEN, _PAPER = 64.0, 54.0  # widths in em that a table may take; on paper its letters shrink before it breaks


def blocks(table: Table) -> list[tuple[Column, ...]]:
    """Columns of a table as they stand in a page."""
    whole = list(takewhile(lambda c: c.unit in ("-", "") and c.decimals == 0, table.columns))
    keys = table.columns[: max(1, len(whole))] if len(whole) < len(table.columns) else table.columns[:1]
    rest = table.columns[len(keys) :]
    room = _SCREEN - sum(map(_width, keys))
    count = ceil(sum(map(_width, rest)) / room) if room > 0 else len(rest)
    each = ceil(len(rest) / max(1, count)) or 1
    return [(*keys, *rest[i : i + each]) for i in range(0, max(len(rest), 1), each)]


def fitting(columns: Sequence[Column]) -> float:
    """By how much the letters of a block shrink on paper; 1 where it has room."""
    return min(1.0, _PAPER / sum(map(_width, columns)))


def beside(columns: Sequence[Column], table: str) -> str:
    """HTML of a block, its rows side by side as often as the page has room for them; its script measures that."""
    width, rows = sum(map(_width, columns)), len(columns[0].values)
    count = min(int((_SCREEN + _BETWEEN) / (width + _BETWEEN)), rows // _LEAST)
    if count < 2:
        return table
    return f'<ms-rows style="--rows:{count};--each:{numbers.fixed(width, 1)}em">{table}</ms-rows>'


def _width(column: Column) -> float:
    """Room that a column takes, in em: its longest text, and what stands on both sides of it."""
    return 1.4 + 0.56 * max(map(len, (column.symbol, f"[{column.unit}]", *column.texts())))
