"""The document in one file: ``python -m mechsheet.run.html WORKSHEET [--NAME=VALUE ..] [--scene=F] [--out=FOLDER]``."""

import sys
from pathlib import Path
from typing import Any

from mechsheet.html import write
from mechsheet.run import report
from mechsheet.run.arguments import read
from mechsheet.run.ending import say, watch
from mechsheet.worksheet import inputs
from mechsheet.worksheet.cells import Worksheet, checks, load, refuse_open
from mechsheet.worksheet.errors import SheetError

# What computes through many runs of a worksheet or of a method: no formula of one run repeats that.
_STUDIES = ("mechsheet.accuracy.", "mechsheet.studies.")


def main() -> None:
    worksheet, *options = sys.argv[1:]
    watch(worksheet)
    sheet = load(worksheet)
    refuse_studies(sheet)  # before anything is computed
    declared = inputs.declared(sheet.inputs)
    given = read(options, declared)
    if given.want or given.limits:
        raise SheetError("a page in one file holds the whole worksheet: its scene may have [inputs] and nothing else")
    g: Any = inputs.build(sheet.inputs, given.inputs)
    say(*inputs.readings(declared, given.inputs))
    path = (given.out or report.folder(Path(sheet.path))) / f"{Path(sheet.path).stem}.html"
    text = page(sheet, g)
    report.write(text.encode(), path)
    say(f"written {path}, {len(text.encode()) / 1000:.0f} kB")


def page(sheet: Worksheet, g: Any) -> str:
    """The page of a worksheet with these inputs.

    Raises SheetError where an essential check fails.
    """
    names = sheet.run(sheet.results, {"g": g})
    refuse_open(checks(names))
    return write.page(sheet.title, names, sheet)


def refuse_studies(sheet: Worksheet) -> None:
    """Raise SheetError for a worksheet of searches or measurements."""
    for name, value in sheet.common.items():
        if f"{getattr(value, '__module__', '')}.".startswith(_STUDIES):
            raise SheetError(f"{Path(sheet.path).stem} computes by {name}, over many runs: a page cannot follow that")


if __name__ == "__main__":
    main()
