"""Wide tables as blocks of columns, one below the other, each with the columns that name the rows."""

from itertools import takewhile

from mechsheet.worksheet.table import Column, Table

_MOST = 6  # columns beside each other, those that name the rows apart


def blocks(table: Table) -> list[tuple[Column, ...]]:
    """Columns of a table as they stand in a page."""
    whole = list(takewhile(lambda c: c.unit in ("-", "") and c.decimals == 0, table.columns))
    keys = table.columns[: max(1, len(whole))] if len(whole) < len(table.columns) else table.columns[:1]
    rest = table.columns[len(keys) :]
    found = [rest[i : i + _MOST] for i in range(0, max(len(rest), 1), _MOST)]
    if len(found) > 1 and len(found[-1]) == 1:
        found[-2:] = [found[-2] + found[-1]]
    return [(*keys, *block) for block in found]
