"""Cells of a workbook with other contents, as somebody types them; all else of the file stays byte for byte."""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Mapping
from pathlib import Path
from xml.sax.saxutils import escape
from zipfile import ZIP_DEFLATED, ZipFile


def typed(path: Path, contents: Mapping[tuple[str, str], object], to: Path) -> Path:
    """The workbook of ``path`` written to ``to``, with contents by title of the sheet and address of a cell.

    Of a workbook that XlsxWriter has written, in which every cell named stands already: openpyxl would read and write
    all of its cells for that, which takes seconds.
    """
    by_sheet = defaultdict[str, dict[str, object]](dict)
    for (title, address), value in contents.items():
        by_sheet[title][address] = value
    with ZipFile(path) as book, ZipFile(to, "w", ZIP_DEFLATED) as edited:
        titles = re.findall(r'<sheet name="([^"]*)"', book.read("xl/workbook.xml").decode())
        parts = {f"xl/worksheets/sheet{titles.index(escape(t)) + 1}.xml": cells for t, cells in by_sheet.items()}
        for part in book.namelist():
            text = book.read(part)
            for address, value in parts.get(part, {}).items():
                text = _replaced(text.decode(), address, value).encode()
            edited.writestr(part, text)
    return to


def _replaced(text: str, address: str, value: object) -> str:
    cell = re.compile(rf'<c r="{address}"( s="\d+")?[^>]*?(?:/>|>.*?</c>)', re.DOTALL)
    (found,) = cell.finditer(text)
    start = f'<c r="{address}"{found[1] or ""}'
    match value:
        case None:
            new = f"{start}/>"
        case bool():
            new = f'{start} t="b"><v>{int(value)}</v></c>'
        case str():
            new = f'{start} t="inlineStr"><is><t xml:space="preserve">{escape(value)}</t></is></c>'
        case _:
            new = f"{start}><v>{value!r}</v></c>"
    return text[: found.start()] + new + text[found.end() :]
