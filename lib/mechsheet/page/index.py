"""The index of a worksheet in the page: a fold whose rows lead to the lines, tables and figures."""

import re
from collections.abc import Iterable, Iterator
from functools import lru_cache
from html import escape
from itertools import groupby

import marimo as mo

from mechsheet.document.markup import named
from mechsheet.worksheet.index import Entry, Index


def written(index: Index) -> str:
    """The fold; closed it tells how much there is. The browser's own search opens it where it finds a number in it."""
    parts = (
        ("formulas", len(index.numbers), _by_number(index.formulas)),
        ("tables, figures and programs", len(index.titles), map(_title, index.titles)),
        ("errata", len(index.errata), map(_erratum, index.errata)),
    )
    counts = ", ".join(f"{count} {what}" for what, count, _ in parts if count)
    blocks = "".join(
        f'<b>{what.capitalize()}</b><div class="ms-entries">{"".join(f"<div>{row}</div>" for row in rows)}</div>'
        for what, count, rows in parts
        if count
    )
    summary = f"Index of the document: {counts or 'nothing'}"
    return f'<details class="ms-index"><summary>{summary}</summary>{blocks}</details>'


def anchor(entry: Entry) -> str:
    """Id of the element of the page that shows the place."""
    if entry.kind != "heading":
        return f"{entry.kind}-{entry.name}"
    return _heading(entry.text)


@lru_cache(maxsize=256)
def _heading(text: str) -> str:
    """Id that marimo gives to a heading."""
    found = re.search(r'<h\d id="([^"]*)"', mo.md(f"# {text}").text)
    return found[1] if found else ""


def _link(entry: Entry, shown: str) -> str:
    return f'<a href="#{escape(anchor(entry))}" title="{escape(entry.text)}">{shown}</a>'


def _by_number(entries: Iterable[Entry]) -> Iterator[str]:
    for label, lines in groupby(entries, key=lambda entry: entry.label):
        yield f"{label} {', '.join(_link(line, named(line.name)) for line in lines)}"


def _title(entry: Entry) -> str:
    return f"{escape(entry.label)} {_link(entry, escape(entry.text))}"


def _erratum(entry: Entry) -> str:
    return f"{entry.label} {_link(entry, named(entry.name))} {escape(entry.text)}".lstrip()
