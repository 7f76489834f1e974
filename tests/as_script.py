"""A worksheet run by its command as a process, which is a copy of this one: what it has loaded is not loaded again."""

from __future__ import annotations

import gc
import os
import subprocess
import sys
import warnings
from pathlib import Path
from tempfile import TemporaryFile
from typing import IO, NoReturn

from mechsheet.run import script


def as_script(worksheet: str | Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    """What ``python -m mechsheet.run.script WORKSHEET ..`` prints, and its exit code."""
    command = [str(worksheet), *arguments]
    if not hasattr(os, "fork"):
        started = [sys.executable, "-m", "mechsheet.run.script", *command]
        return subprocess.run(started, capture_output=True, encoding="utf-8")
    with TemporaryFile("w+", encoding="utf-8") as out, TemporaryFile("w+", encoding="utf-8") as err:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", DeprecationWarning)  # of threads, of which the copy needs none
            child = os.fork()
        if not child:
            _run(command, out, err)
        code = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
        out.seek(0), err.seek(0)
        return subprocess.CompletedProcess(command, code, out.read(), err.read())


def _run(command: list[str], out: IO[str], err: IO[str]) -> NoReturn:
    code: object = 99  # of a fault in here
    try:
        warnings.resetwarnings()
        gc.freeze()  # what the tests hold is not looked through for waste again
        sys.argv, sys.stdout, sys.stderr = ["script", *command], out, err
        try:
            script.main()
            code = 0
        except Exception as error:
            sys.excepthook(type(error), error, None)
    except SystemExit as ended:
        code = ended.code or 0
    finally:
        out.flush(), err.flush()
        os._exit(code if isinstance(code, int) else 1)
