"""A worksheet as a script whose mistakes are told in a line from its first moment on, those of its syntax too.

Its cells are run from the file: marimo is not needed where nobody looks at a page. It takes half a second to load, and
where the file itself is started, which has loaded it, as long again to register and run the cells.
"""

import gc
import sys
from io import StringIO
from pathlib import Path

from mechsheet.run.ending import watch

_END = 'if __name__ == "__main__":\n    app.run()'  # of a worksheet, as marimo writes it
_OBJECTS = 100_000  # made between two searches for circles among them, which take a tenth of a run if done as usual


def main() -> None:
    """``python -m mechsheet.run.script WORKSHEET ..``"""
    del sys.argv[0]
    watch(sys.argv[0])
    sys.stdout, sys.stderr = sys.stdout or StringIO(), sys.stderr or StringIO()  # none, where they were closed
    _run(sys.argv[0])


def start(worksheet: str) -> None:
    """``python WORKSHEET ..`` from where its setup asks for a first name of the package: the process ends here.

    Returns where the file was started for something else, such as an export of its page by marimo, or does something
    else with what marimo runs of it.
    """
    from mechsheet.run.arguments import is_script  # on use: as below

    if is_script(worksheet) and Path(worksheet).read_text(encoding="utf-8").rstrip().endswith(_END):
        _run(worksheet)
        sys.exit()


def _run(worksheet: str) -> None:
    gc.set_threshold(_OBJECTS, *gc.get_threshold()[1:])
    from mechsheet.worksheet.cells import load  # on use: an interruption while this loads is told as any other

    try:
        load(worksheet).run_whole()
    finally:
        gc.freeze()  # the process ends: to look through all that is left takes a sixth of a run, for nothing


if __name__ == "__main__":
    main()
