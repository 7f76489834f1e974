"""The one error that a worksheet raises to its reader."""

import re
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from typing import Any, NoReturn

_called = ContextVar("_called", default=False)


class SheetError(ValueError):
    """Input or a result that cannot be used; the message is one line for the person at the worksheet."""


def refuse(error: SheetError, shown: Any = None) -> NoReturn:
    """Stop the running cell and those that need it: in its own page the reason stands in its place, elsewhere raise.

    A served page hides the text of exceptions, so the reason is shown as the cell's output: ``shown``, or
    the message of the error. The title block tells it too: the verdicts of the checks have gone with their cells.
    """
    if "marimo" in sys.modules and not _called.get():
        import marimo as mo

        if mo.running_in_notebook():
            place = mo.as_html(shown if shown is not None else mo.callout(str(error), kind="danger")).text
            mo.stop(True, mo.Html(place + told(str(error))))
    raise error


@contextmanager
def raised() -> Iterator[None]:
    """Let refusals raise, in a page too: a worksheet that is called as a function must not stop the cell that calls."""
    token = _called.set(True)
    try:
        yield
    finally:
        _called.reset(token)


def told(reason: str) -> str:
    """Style sheet that makes the title block tell why the sheet is not computed to its end."""
    return f'<style>.ms-told{{display:block!important}}.ms-told::after{{content:"{quoted(reason)}"}}</style>'


def quoted(text: str) -> str:
    """Text as it stands between the quotes of a style sheet in a page."""
    return re.sub(r"[^\w .,;:=()+-]", lambda c: f"\\{ord(c[0]):x} ", text)
