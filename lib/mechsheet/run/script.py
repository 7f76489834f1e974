"""A worksheet as a script whose mistakes are told in a line from its first moment on, those of its syntax too."""

import runpy
import sys
from io import StringIO

from mechsheet.run.ending import watch


def main() -> None:
    """``python -m mechsheet.run.script WORKSHEET ..``"""
    del sys.argv[0]
    watch(sys.argv[0])
    sys.stdout, sys.stderr = sys.stdout or StringIO(), sys.stderr or StringIO()  # none, if closed: marimo stops at it
    runpy.run_path(sys.argv[0], run_name="__main__")


if __name__ == "__main__":
    main()
