"""The numbers of the document's own inputs, which the page shows beside those that differ from them.

The element that carries them is shown by ``own.js``.
"""

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from mechsheet.document import parts
from mechsheet.document.blocks import blocks
from mechsheet.document.markup import compared
from mechsheet.document.shortened import shortened
from mechsheet.page import switched, values
from mechsheet.page.lines import valued
from mechsheet.page.script import element
from mechsheet.worksheet.check import Check
from mechsheet.worksheet.lines import registry
from mechsheet.worksheet.table import Table


def html(own: Mapping[str, Any]) -> str:
    """The element, from the namespace of a run with the document's own inputs."""
    shown = parts.values(own)
    checks = [value for value in shown if isinstance(value, Check)]
    # Of a check the whole is compared, and its verdict shown.
    told = {
        "lines": {name: valued(line, own[name], own) for name, line in registry(own).items() if line.has_value},
        "tables": {table.number: _table(table) for table in shown if isinstance(table, Table)},
        "checks": {values.anchor(check.name): [values.html(check), _verdict(check)] for check in checks},
    }
    return element("ms-own", told=told)


def _table(table: Table) -> tuple[int, list[list[tuple[list[str], switched.Numbers | None]]]]:
    """How many rows there are, and by blocks and columns the texts of those that the page shows, and their numbers."""
    shown = replace(table, columns=shortened(table.columns)[0])
    told = [[(values.cells(column), switched.numbers_of(column)) for column in block] for block in blocks(shown)]
    return len(table.columns[0].values), told


def _verdict(check: Check) -> str:
    return f"{check.verdict}: {compared(check, check.unit)}" if check.evaluated else check.verdict
