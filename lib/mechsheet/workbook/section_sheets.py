"""The sheets of what stands behind the tables of a section, in SI units."""

from collections.abc import Sequence

import numpy as np

from mechsheet.recording.lines import Line
from mechsheet.units import shown, si
from mechsheet.workbook import looks, table_sheet
from mechsheet.workbook.arrangement import Section
from mechsheet.workbook.book import Book
from mechsheet.workbook.content import Content, computed
from mechsheet.workbook.place import letters
from mechsheet.workbook.sheet_formulas import SheetFormulas
from mechsheet.worksheet.table import Column


def write(book: Book, section: Section, formulas: SheetFormulas) -> None:
    """Sheets of one section: a list of its lines, and columns of those with many values."""
    fields = (
        *(("Name", looks.TEXT), ("Value", looks.SI), ("Unit", looks.TEXT)),
        *(("Meaning", looks.TEXT), ("Line", looks.TEXT)),
    )
    listed: list[tuple[Content, ...]] = [
        (formulas.name(line.node), _contents(line, formulas)[0], shown(si(line.unit)), _meaning(line), _source(line))
        for line in section.single
    ]
    listed += [
        (formulas.name(line.node), f"column {letters(n)}", shown(si(line.unit)), _meaning(line), _source(line))
        for n, line in enumerate(section.fields)
    ]
    title = f"{section.title} - lines behind the tables, in SI units"
    grey = {n for n, line in enumerate([*section.single, *section.fields]) if formulas.kept(line.node)}
    book.listing(section.listing, title, fields, listed, behind=True, grey=grey)
    if section.fields:
        columns: list[tuple[Column, Sequence[Content]]] = []
        for line in section.fields:
            values = np.asarray(line.node.value, float).reshape(-1)
            column = Column(formulas.name(line.node), si(line.unit), "", looks.SI_DECIMALS, values)
            columns.append((column, _contents(line, formulas)))
        apart = [n for n, line in enumerate(section.fields) if formulas.kept(line.node)]
        note = table_sheet.not_followed([column for column, _ in columns], apart)
        heading = f"{section.title} - fields, in SI units"
        table_sheet.write(book, section.sheet, heading, note, columns, numbers=looks.SI, grey=apart, behind=True)


def _meaning(line: Line) -> str:
    """The meaning behind the number of the printed formula, as in the worksheet."""
    return f"{line.number} {line.meaning}".strip()


def _source(line: Line) -> str:
    """The line of the worksheet behind a quantity: its text, else its number."""
    return line.text or (f"line {line.node.line}" if line.node.line else "")


def _contents(line: Line, formulas: SheetFormulas) -> Sequence[Content]:
    return computed(formulas.line(line), np.asarray(line.node.value, float).reshape(-1).tolist())
