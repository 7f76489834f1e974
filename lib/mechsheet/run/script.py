"""A worksheet as a script whose mistakes are told in a line from its first moment on, those of its syntax too.

Its cells are run from the file: marimo, which takes a second to load, is not needed where nobody looks at a page.
"""

import gc
import sys
from io import StringIO

from mechsheet.run.ending import watch

_OBJECTS = 100_000  # made between two searches for circles among them, which take a tenth of a run if done as usual


def main() -> None:
    """``python -m mechsheet.run.script WORKSHEET ..``"""
    del sys.argv[0]
    watch(sys.argv[0])
    sys.stdout, sys.stderr = sys.stdout or StringIO(), sys.stderr or StringIO()  # none, where they were closed
    gc.set_threshold(_OBJECTS, *gc.get_threshold()[1:])
    from mechsheet.worksheet.cells import load  # on use: an interruption while this loads is told as any other

    load(sys.argv[0]).run_whole()


if __name__ == "__main__":
    main()
