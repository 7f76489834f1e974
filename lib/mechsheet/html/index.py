"""The index of a worksheet in a page: a fold whose rows lead to the lines, tables and figures."""

from collections.abc import Callable, Iterable, Iterator
from functools import partial
from html import escape
from itertools import groupby

from mechsheet.document.markup import named
from mechsheet.worksheet.index import Entry, Index

Heading = Callable[[str], str]


def written(index: Index, heading: Heading) -> str:
    """The fold; closed it tells how much there is. The browser's own search opens it where it finds a number in it.

    ``heading`` gives the id that the page has for a heading of this text.
    """
    link = partial(_link, heading)
    parts = (
        ("formulas", len(index.numbers), _by_number(index.formulas, link)),
        ("tables, figures and programs", len(index.titles), (_title(entry, link) for entry in index.titles)),
        ("errata", len(index.errata), (_erratum(entry, link) for entry in index.errata)),
    )
    counts = ", ".join(f"{count} {what}" for what, count, _ in parts if count)
    blocks = "".join(
        f'<b>{what.capitalize()}</b><div class="ms-entries">{"".join(f"<div>{row}</div>" for row in rows)}</div>'
        for what, count, rows in parts
        if count
    )
    summary = f"Index of the document: {counts or 'nothing'}"
    return f'<details class="ms-index"><summary>{summary}</summary>{blocks}</details>'


def anchor(entry: Entry, heading: Heading) -> str:
    """Id of the element of the page that shows the place."""
    return heading(entry.text) if entry.kind == "heading" else f"{entry.kind}-{entry.name}"


def _link(heading: Heading, entry: Entry, shown: str) -> str:
    return f'<a href="#{escape(anchor(entry, heading))}" title="{escape(entry.text)}">{shown}</a>'


def _by_number(entries: Iterable[Entry], link: Callable[[Entry, str], str]) -> Iterator[str]:
    for label, lines in groupby(entries, key=lambda entry: entry.label):
        yield f"{label} {', '.join(link(line, named(line.name)) for line in lines)}"


def _title(entry: Entry, link: Callable[[Entry, str], str]) -> str:
    return f"{escape(entry.label)} {link(entry, escape(entry.text))}"


def _erratum(entry: Entry, link: Callable[[Entry, str], str]) -> str:
    return f"{entry.label} {link(entry, named(entry.name))} {escape(entry.text)}".lstrip()
