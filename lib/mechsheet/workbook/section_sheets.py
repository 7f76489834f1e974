"""The sheets of the lines of a section, in SI units."""

from collections.abc import Sequence
from itertools import chain

import numpy as np

from mechsheet.quantities.lines import Line
from mechsheet.units import shown, si
from mechsheet.workbook import looks, table_sheet
from mechsheet.workbook.arrangement import Section
from mechsheet.workbook.book import Book
from mechsheet.workbook.content import LARGEST, Content, computed
from mechsheet.workbook.place import letters
from mechsheet.workbook.sheet_formulas import SheetFormulas
from mechsheet.worksheet.table import Column


def write(book: Book, section: Section, formulas: SheetFormulas) -> None:
    """Sheets of one section: a list of its lines, and columns of those with many values; none without any."""
    heads = (
        *(("Name", looks.TEXT), ("Value", looks.SI), ("Unit", looks.TEXT)),
        *(("Meaning", looks.TEXT), ("Line", looks.TEXT)),
    )
    listed: list[tuple[Content, ...]] = [
        (formulas.name(line.node), _contents(line, formulas)[0], *_told(line)) for line in section.single
    ]
    for sheet, fields in section.fields.items():
        of_sheet = f" of {sheet}" if len(section.fields) > 1 else ""
        listed += [
            (formulas.name(line.node), f"column {letters(n)}{of_sheet}", *_told(line)) for n, line in enumerate(fields)
        ]
    listed += [(line.symbol, *_elsewhere(line, formulas), *_told(line)) for line in section.others]
    if not listed:
        return
    own_lines, own_fields = (f"{section.title} - {what}" if section.title else what for what in ("lines", "fields"))
    title = f"{own_lines}, in SI units"
    every = [*section.single, *chain.from_iterable(section.fields.values()), *section.others]
    grey = {n for n, line in enumerate(every) if formulas.kept(line.node)}
    book.listing(section.listing, title, heads, listed, behind=True, grey=grey)
    heading = f"{own_fields}, in SI units"
    for sheet, fields in section.fields.items():
        columns: list[tuple[Column, Sequence[Content]]] = []
        for line in fields:
            values = np.asarray(line.node.value, float).reshape(-1)
            column = Column(formulas.name(line.node), si(line.unit), "", looks.SI_DECIMALS, values)
            columns.append((column, _contents(line, formulas)))
        apart = [n for n, line in enumerate(fields) if formulas.kept(line.node)]
        note = table_sheet.not_followed([column for column, _ in columns], apart)
        table_sheet.write(book, sheet, heading, note, columns, numbers=looks.SI, grey=apart, behind=True)


def _elsewhere(line: Line, formulas: SheetFormulas) -> Sequence[Content]:
    """Where the column of a line stands, or its number."""
    place = formulas.arrangement.places.get(line.node)
    if line.node.size != 1:
        none = formulas.as_exported("no values", "not followed")
        return (f"column {letters(place.column)} of {place.sheet}" if place else none,)
    return computed([formulas.reference(line.node)] if place else None, [line.node.value.item() + 0.0])  # no -0


def _told(line: Line) -> tuple[str, str, str]:
    """Unit, the meaning behind the number of the printed formula, and the line of the worksheet or its number."""
    source = line.text or (f"line {line.node.line}" if line.node.line else "")
    return shown(si(line.unit)), f"{line.number} {line.meaning}".strip(), source


def _contents(line: Line, formulas: SheetFormulas) -> Sequence[Content]:
    values, texts = np.asarray(line.node.value, float).reshape(-1), formulas.line(line)
    if texts and formulas.holds_infinite(line.node):
        values = np.clip(values, -LARGEST, LARGEST)
    return computed(texts, values.tolist())
