"""A worksheet as a script whose mistakes are told in a line from its first moment on, those of its syntax too.

Its cells are run from the file: marimo is not needed where nobody looks at a page. It takes half a second to load, and
where the file itself is started, which has loaded it, as long again to register and run the cells.
"""

import atexit
import gc
import os
import sys
from collections.abc import Mapping
from io import StringIO
from pathlib import Path
from typing import Any

from mechsheet.run.ending import is_over, watch

_END = 'if __name__ == "__main__":\n    app.run()'  # of a worksheet, as marimo writes it
_reporting = list[str]()  # the worksheet that is to be reported at the exit
_SEARCHES = 50  # of those that are new, before older ones are looked through too
_OBJECTS = 100_000  # made between two searches for circles among them, which take a tenth of a run if done as usual


def main() -> None:
    """``python -m mechsheet.run.script WORKSHEET ..``"""
    del sys.argv[0]
    watch(sys.argv[0])
    sys.stdout, sys.stderr = sys.stdout or StringIO(), sys.stderr or StringIO()  # none, where they were closed
    try:
        _run(sys.argv[0])
    except Exception as error:  # told here: what runs this module as a program puts another name into the arguments
        sys.excepthook(type(error), error, error.__traceback__)


def start(worksheet: str) -> None:
    """``python WORKSHEET ..`` from where its setup asks for a first name of the package: the process ends here.

    Returns where the file was started for something else, such as an export of its page by marimo, or does something
    else with what marimo runs of it.
    """
    from mechsheet.run.arguments import is_script  # on use: as below

    if is_script(worksheet) and _only_runs(worksheet):
        _run(worksheet)
        sys.exit()


def _only_runs(worksheet: str) -> bool:
    return Path(worksheet).read_text(encoding="utf-8").rstrip().endswith(_END)


def report_at_exit(names: Mapping[str, Any]) -> None:
    """Let a started worksheet end in a report as others do whose cells marimo runs, as they import the package.

    ``names`` are those of its cells.
    """
    from mechsheet.run.arguments import is_script  # on use: as below

    if not _reporting and is_script(names["__file__"]) and _only_runs(names["__file__"]):
        _reporting.append(names["__file__"])
        watch(names["__file__"])
        atexit.register(_report, names)


def _report(names: Mapping[str, Any]) -> None:
    if is_over():
        return
    from mechsheet.run import ask, report  # on use: nothing else of it is needed so late
    from mechsheet.worksheet.cells import load  # on use: as above

    try:
        try:
            ask.unasked(load(names["__file__"]))
            report.end(names)
        except Exception as error:
            sys.excepthook(type(error), error, error.__traceback__)
    except SystemExit as ended:  # which at an exit changes nothing
        sys.stdout.flush()
        os._exit(ended.code if isinstance(ended.code, int) else 0)


def _run(worksheet: str) -> None:
    gc.set_threshold(_OBJECTS, _SEARCHES, _SEARCHES)
    from mechsheet.run import ask, report  # on use: an interruption while this loads is told as any other
    from mechsheet.worksheet.cells import load  # on use: as above
    from mechsheet.worksheet.verdict import listen  # on use: as above

    try:
        sheet = load(worksheet)
        ask.unasked(sheet)
        with listen():
            report.end(sheet.run_whole())
    finally:
        gc.freeze()  # the process ends: to look through all that is left takes a sixth of a run, for nothing


if __name__ == "__main__":
    main()
