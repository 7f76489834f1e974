"""How a run ends that cannot go on: one line for its reader, and the exit code that a shell expects."""

import os
import sys
import warnings
from collections.abc import Callable
from functools import partial
from pathlib import Path
from types import TracebackType
from typing import Any, NoReturn

from mechsheet.worksheet import mistakes
from mechsheet.worksheet.errors import SheetError

INTERRUPTED = 130  # the exit code of a program that Ctrl-C ended, as shells have it
MISUSED = 2  # what was given cannot be used, as most commands have it
_over = list[bool]()
_warned = set[str]()
_held = list[str]()  # warnings that an error which ends the run says better
_UNREAD = 141  # of one whose reader has gone, as head does after its last line


def watch(worksheet: str) -> None:
    """Begin a run of the worksheet: whatever it raises ends in one line on stderr and the exit code.

    What it warns of is told in a line too.
    """
    _over.clear()
    _held.clear()
    warn_in_lines(worksheet, warn)
    sys.excepthook = partial(_end, worksheet)


def warn_in_lines(worksheet: str, tell: Callable[[str], object]) -> None:
    """Let a warning about a line of the worksheet be told in one line, as a mistake in it is."""
    warnings.showwarning = partial(_told_in_line, Path(worksheet).resolve(), tell, warnings.showwarning)


def over() -> None:
    """Note that the run has told its end: nothing more is to be said of it."""
    _over.append(True)


def is_over() -> bool:
    return bool(_over)


def warn(line: str) -> None:
    """Print a warning, once; one of an invalid value when the run has something to say: an error that ends it says why.

    A file is read more than once, and a scene is computed as others are.
    """
    if line in _warned:
        return
    _warned.add(line)
    if ": invalid value encountered" in line:
        _held.append(line)
    else:
        print(line, file=sys.stderr)


def _told_in_line(
    worksheet: Path,
    tell: Callable[[str], object],
    otherwise: Callable[..., None],
    message: Warning,
    kind: Any,
    file: str,
    line: int,
    *more: Any,
) -> None:
    """Tell a warning about a line of the worksheet, or of what that calls; what else there is goes on as it was."""
    if Path(file).resolve() != worksheet:
        frame = sys._getframe(1)
        while frame and Path(frame.f_code.co_filename).resolve() != worksheet:
            frame = frame.f_back  # type: ignore[assignment]
        if not frame:
            otherwise(message, kind, file, line, *more)
            return
        line = frame.f_lineno
    text = worksheet.read_text(encoding="utf-8").splitlines()
    # Of a backslash, as in $\phi$, Python warns from 3.12 on.
    hint = ' (a text with \\ is written r"..")' if "escape sequence" in str(message) else ""
    tell(f"{mistakes.at(worksheet, line, text[line - 1])}: {message}{hint}")


def say(*lines: object) -> None:
    """Print at once, so that what refuses it does so here, behind the warnings that were held back.

    Raises SheetError naming why standard output cannot be written; BrokenPipeError where its reader has gone.
    """
    while _held:
        print(_held.pop(0), file=sys.stderr)
    try:
        print(*(f"{line}\n" for line in lines), sep="", end="", flush=True)
    except BrokenPipeError:
        raise
    except OSError as error:
        raise SheetError(f"standard output cannot be written: {error.strerror}") from None


def _end(worksheet: str, _: type[BaseException], error: BaseException, _trace: TracebackType | None) -> NoReturn:
    over()
    text, code = "", 1
    if isinstance(error, KeyboardInterrupt):
        text, code = "interrupted", INTERRUPTED
    elif isinstance(error, BrokenPipeError):
        code = _UNREAD
    else:
        text, code = _told(error, worksheet)
    for stream, last in ((sys.stdout, ""), (sys.stderr, text and text + "\n")):
        try:
            if stream:  # none where it was closed from the beginning
                stream.write(last)
                stream.flush()
        except OSError:  # what is left of it goes nowhere, or Python would complain of it at its end
            os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())
    sys.exit(code)


def _told(error: BaseException, worksheet: str) -> tuple[str, int]:
    """The line that tells why, that the mechanism does not close or the error's own, and the exit code.

    Before it stand inputs whose number is hardly meant: what comes of one is told as something else.
    """
    from mechsheet.run import arguments  # on use: what watches a run from its beginning loads nothing that takes long
    from mechsheet.worksheet import cells, inputs, no_inputs

    unlikely = list[str]()
    try:
        if arguments.is_script(worksheet) and not isinstance(error, arguments.UsageError):
            sheet = cells.load(worksheet)
            given = arguments.read(sys.argv[1:], inputs.declared(sheet.inputs)).inputs
            own = (each for each in inputs.unlikely(sheet.inputs) if each[0] not in given)
            unlikely = [f"{place}: {why}\n" for _, place, why in own]
            sheet.close(no_inputs.beforehand(inputs.build(sheet.inputs, given)))
    except SheetError as cause:
        error = cause
    except Exception:  # the mistake that there is has its own line
        pass
    text = mistakes.refused(error, worksheet) if isinstance(error, SheetError) else mistakes.told(error, worksheet)
    return f"{''.join(unlikely)}error: {text}", MISUSED if isinstance(error, arguments.UsageError) else 1
