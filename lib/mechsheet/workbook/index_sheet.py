"""The sheet that leads from the numbers of the printed formulas, tables and figures to their places in the workbook."""

from collections.abc import Mapping

from mechsheet.workbook import looks
from mechsheet.workbook.book import Book
from mechsheet.workbook.content import Content
from mechsheet.workbook.place import quoted
from mechsheet.workbook.sheet_formulas import SheetFormulas
from mechsheet.worksheet.index import Entry, Index

_FIELDS = (("In the document", looks.TEXT), ("Name", looks.TEXT), ("Meaning, title", looks.TEXT))


def write(book: Book, index: Index, sheets: Mapping[tuple[str, str], str], formulas: SheetFormulas | None) -> None:
    """The sheet Index; ``sheets`` are those of the tables and figures, by kind and number.

    A name is a link to the cell or column of its line, a number of a table or figure one to its sheet. What has no
    place of its own, such as a line that is a function or a drawing, is no link.
    """
    rows: list[tuple[Content, ...]] = []
    links: list[tuple[int, int, str, str]] = []
    for title, entries in (
        ("Formulas", index.formulas),
        ("Tables, figures, programs", index.titles),
        ("Errata", index.errata),
    ):
        if entries:
            rows.append((title,))
        for entry in entries:
            name = entry.name if entry.kind == "line" else ""
            col, shown = (1, name) if name else (0, entry.label)
            if at := _place(entry, sheets, formulas):
                links.append((len(rows), col, at, shown))
            text = formulas.words(f"{entry.kind} {entry.name} title", entry.text) if formulas else entry.text
            rows.append((entry.label, name, text))
    sheet = book.listing("Index", "Formulas, tables and figures of the document, and its errata", _FIELDS, rows)
    style = book.style(looks.CELL, looks.LINK)
    for row, col, at, shown in links:
        sheet.write_url(row + 2, col, f"internal:{at}", style, shown)


def _place(entry: Entry, sheets: Mapping[tuple[str, str], str], formulas: SheetFormulas | None) -> str:
    """Address of what an entry means; nothing where the workbook has it nowhere."""
    if entry.kind == "line":
        place = formulas.place(entry.name) if formulas else None
        return place.at() if place else ""
    name = sheets.get((entry.kind, entry.name))
    return f"{quoted(name)}!A1" if name else ""
