"""The document in one file: ``python -m mechsheet.run.html WORKSHEET [--NAME=VALUE ..] [--scene=F] [--out=FOLDER]``."""

import sys
from pathlib import Path
from typing import Any

from mechsheet.html import write
from mechsheet.run import report
from mechsheet.run.arguments import UsageError, read
from mechsheet.run.ending import say, watch
from mechsheet.worksheet import inputs
from mechsheet.worksheet.cells import load


def main() -> None:
    worksheet, *options = sys.argv[1:]
    watch(worksheet)
    sheet = load(worksheet)
    declared = inputs.declared(sheet.inputs)
    given = read(options, declared)
    if given.want or given.limits or given.proof or given.tolerances:
        raise UsageError("a page in one file holds the whole worksheet: it takes inputs, --scene of [inputs] and --out")
    g: Any = inputs.build(sheet.inputs, given.inputs)
    text = write.page(sheet, g).encode()
    path = (given.out or report.folder(Path(sheet.path))) / f"{Path(sheet.path).stem}.html"
    report.write(text, path)
    say(*inputs.readings(declared, given.inputs), f"written {path}, {round(len(text) / 1000)} kB")


if __name__ == "__main__":
    main()
