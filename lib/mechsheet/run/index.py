"""The index of a worksheet on the terminal: ``python -m mechsheet.run.index WORKSHEET``."""

import sys
from collections.abc import Iterator, Sequence
from pathlib import Path

from mechsheet.run.arguments import UsageError
from mechsheet.run.ending import say, watch
from mechsheet.worksheet import index
from mechsheet.worksheet.cells import load
from mechsheet.worksheet.errors import SheetError
from mechsheet.worksheet.index import Entry


def main() -> None:
    worksheet, *options = sys.argv[1:]
    watch(worksheet)
    if options:
        raise UsageError(f"argument {options[0]!r}: index takes a worksheet and nothing else")
    load(worksheet)  # tells what cannot be read
    made = index.of_worksheet({"__file__": str(Path(worksheet).resolve())})
    if not made.formulas and not made.titles and not made.errata:
        raise SheetError(f"{worksheet} has no number of a printed formula, no table, no figure and no erratum")
    say(*_part("formulas", made.formulas), *_part("tables, figures, programs", made.titles))
    say(*_part("errata", made.errata))


def _part(title: str, entries: Sequence[Entry]) -> Iterator[str]:
    """A heading and the places below it; a line that tells where there are none."""
    places = [(entry.label, entry.name if entry.kind == "line" else "") for entry in entries]
    if not places:
        yield f"{title}: none"
        return
    yield f"{title}:"
    first, second = (max(map(len, texts)) for texts in zip(*places, strict=True))
    for (label, name), entry in zip(places, entries, strict=True):
        yield f"  {label:{first}}  {name:{second}}  line {entry.line:<5} {entry.text}".rstrip()


if __name__ == "__main__":
    main()
