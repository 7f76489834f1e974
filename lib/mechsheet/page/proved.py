"""What the page shows of a proof: its check, exceptions and found values, and which digits of tables are not proved.

``proof.js`` greys these.
"""

from collections.abc import Iterator, Sequence
from html import escape
from math import isfinite
from uuid import uuid4

from mechsheet.document.blocks import blocks
from mechsheet.page import values
from mechsheet.page.script import element, script
from mechsheet.recording.proof import Proof, Proved
from mechsheet.worksheet.scene import PROVED
from mechsheet.worksheet.table import Table


def html(proof: Proof, tables: Sequence[Table]) -> str:
    """A proof of the numbers that the tables have now."""
    lines = [*map(str, proof.below(PROVED)[1:]), *proof.apart, *map(str, proof.roots), proof.table().note]
    said = values.html(proof.check()) + "".join(f'<div class="ms-note">{escape(line)}</div>' for line in lines)
    columns = {(column.where, column.name): column for column in proof.columns}
    unproved = [place for table in tables for place in _unproved(table, columns)]
    return script("proof.js") + element("ms-proof", said, unproved=unproved, made=uuid4().hex)


_Place = tuple[str, int, int, int, float | None]


def _unproved(table: Table, columns: dict[tuple[str, str], Proved]) -> Iterator[_Place]:
    """Cells with a digit that is not proved: table, block, row, column, and how far the number may be off."""
    for n, block in enumerate(blocks(table)):
        for k, column in enumerate(block):
            proved = columns.get((f"table {table.number}", column.symbol))
            if proved is None:
                continue
            for row, off in enumerate(proved.off.reshape(-1).tolist()):
                if off > 0.5 * 10.0**-column.decimals or column.power:
                    yield table.number, n, row, k, off if isfinite(off) else None
