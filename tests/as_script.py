"""A command run as a process which is a copy of this one: what it has loaded is not loaded again."""

from __future__ import annotations

import atexit
import gc
import os
import subprocess
import sys
import warnings
from collections.abc import Callable, Sequence
from importlib import import_module
from importlib.machinery import SourceFileLoader
from pathlib import Path
from tempfile import TemporaryFile
from types import ModuleType
from typing import IO, NoReturn

import xlsxwriter.workbook  # noqa: F401  # as two below: each copy would load it again for its workbook

from mechsheet import __main__ as launcher
from mechsheet.recording import record  # noqa: F401
from mechsheet.run import script
from mechsheet.workbook import writing  # noqa: F401


def as_script(worksheet: str | Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    """What ``python -m mechsheet.run.script WORKSHEET ..`` prints, and its exit code."""
    return as_command(script, worksheet, *arguments)


def as_command(program: ModuleType, *arguments: str | Path) -> subprocess.CompletedProcess[str]:
    """What ``python -m PROGRAM ..`` prints, and its exit code."""
    return copied(lambda: sys.exit(program.main()), ["-m", program.__name__], *arguments)


def as_launched(*arguments: str | Path, **streams: IO[str]) -> subprocess.CompletedProcess[str]:
    """What ``mechsheet ..`` prints with the program that it starts, and its exit code."""

    def call(command: list[str], **_: object) -> int:
        assert command[:2] == [sys.executable, "-m"]
        sys.argv = command[2:]
        return import_module(command[2]).main() or 0

    def start() -> None:
        launcher.call = call  # in the copy alone
        sys.exit(launcher.main())

    return copied(start, ["-m", "mechsheet"], *arguments, **streams)


def as_file(worksheet: str | Path, *arguments: str, **streams: IO[str]) -> subprocess.CompletedProcess[str]:
    """What ``python WORKSHEET ..`` prints, and its exit code."""
    import marimo  # noqa: F401  # on use: each copy would load it again

    def start() -> None:
        del sys.argv[0]
        main = ModuleType("__main__")
        main.__file__, main.__loader__ = str(worksheet), SourceFileLoader("__main__", str(worksheet))
        sys.modules["__main__"] = main
        sys.path.insert(0, str(Path(worksheet).parent))
        del sys.modules["mechsheet"]  # which looks as it is imported at what has been started
        exec(compile(Path(worksheet).read_bytes(), worksheet, "exec"), vars(main))

    return copied(start, ["-X", "utf8"], worksheet, *arguments, **streams)


def copied(
    main: Callable[[], object],
    options: Sequence[str],
    *arguments: str | Path,
    out: IO[str] | None = None,
    err: IO[str] | None = None,
) -> subprocess.CompletedProcess[str]:
    """What a program prints, unless it goes elsewhere, and its exit code.

    ``options`` are those of a Python that runs it where no process can be copied.
    """
    command = [*options, *map(str, arguments)]
    if not hasattr(os, "fork"):
        pipe = subprocess.PIPE
        return subprocess.run([sys.executable, *command], stdout=out or pipe, stderr=err or pipe, encoding="utf-8")
    with TemporaryFile("w+", encoding="utf-8") as told, TemporaryFile("w+", 1, encoding="utf-8") as said:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", DeprecationWarning)  # of threads, of which the copy needs none
            child = os.fork()
        if not child:
            _run(main, ["script", *map(str, arguments)], out or told, err or said)
        code = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
        told.seek(0), said.seek(0)
        return subprocess.CompletedProcess(command, code, told.read(), said.read())


def _run(main: Callable[[], object], command: list[str], out: IO[str], err: IO[str]) -> NoReturn:
    code: object = 99  # of a fault in here
    try:
        warnings.resetwarnings()
        gc.freeze()  # what the tests hold is not looked through for waste again
        atexit._clear()  # what the tests do at their end
        sys.argv, sys.stdout, sys.stderr, sys.excepthook = command, out, err, sys.__excepthook__
        try:
            main()
            code = 0
        except SystemExit:
            raise
        except BaseException as error:
            code = 1
            sys.excepthook(type(error), error, error.__traceback__)
    except SystemExit as ended:
        code = ended.code or 0
    finally:
        atexit._run_exitfuncs()  # the report of a started worksheet may end the process there
        for stream in (out, err):
            try:
                stream.flush()
            except OSError:
                code = 120  # as Python ends then
        os._exit(code if isinstance(code, int) else 1)
