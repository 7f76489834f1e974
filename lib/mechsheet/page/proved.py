"""What the page shows of a proof: its check, exceptions and found values, and which digits are not proved.

``proof.js`` greys these.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from math import isfinite
from uuid import uuid4

from mechsheet import units
from mechsheet.document.blocks import blocks
from mechsheet.document.markup import message
from mechsheet.document.shortened import rows, shortened
from mechsheet.page import values
from mechsheet.page.script import element, script
from mechsheet.readers.proof import Proof, Proved
from mechsheet.worksheet.lines import Formula
from mechsheet.worksheet.scene import PROVED
from mechsheet.worksheet.table import Table


def html(proof: Proof, tables: Sequence[Table], known: Mapping[str, Formula]) -> str:
    """A proof of the numbers that the tables and the lines ``known`` have now."""
    lines = [*map(str, proof.below(PROVED)[1:]), *proof.apart, *map(str, proof.roots), proof.table().note]
    said = values.html(proof.check()) + "".join(f'<div class="ms-note">{message(line)}</div>' for line in lines)
    columns = {(column.where, column.name): column for column in proof.columns}
    unproved = [place for table in tables for place in _unproved(table, columns)]
    told = {"unproved": unproved, "lines": _lines(proof, known), "made": uuid4().hex}
    return script("proof.js") + element("ms-proof", said, **told)


def _lines(proof: Proof, known: Mapping[str, Formula]) -> dict[str, float | None]:
    """How far the numbers of a line may be off, in its unit; None where nobody knows."""
    off = dict[str, float | None]()
    for column in proof.columns:
        if column.where == "results" and (most := float(column.off.max(initial=0.0))):
            own = most / units.parse(known[column.name].unit).factor if isfinite(most) else None
            before = off.get(column.name, 0.0)
            off[column.name] = None if own is None or before is None else max(own, before)
    return off


_Place = tuple[str, int, int, int, float | None]


def _unproved(table: Table, columns: dict[tuple[str, str], Proved]) -> Iterator[_Place]:
    """Cells with a digit that is not proved: table, block, row, column, and how far the number may be off."""
    for n, block in enumerate(blocks(replace(table, columns=shortened(table.columns)[0]))):
        for k, column in enumerate(block):
            proved = columns.get((f"table {table.number}", column.symbol))
            if proved is None:
                continue
            known = proved.off.reshape(-1)
            for row, off in enumerate(known[rows(known.size)].tolist()):
                if off > 0.5 * 10.0**-column.decimals or column.power:
                    yield table.number, n, row, k, off if isfinite(off) else None
