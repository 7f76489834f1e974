"""What says something while a worksheet is recorded, which keeps it to itself: the worksheet's own run has said it."""

import os
import sys
import warnings
from io import StringIO
from typing import Any


def unsaid(*_: Any, **__: Any) -> None:
    """In place of what says something."""


def unspoken(value: Any, room: str) -> Any:
    """In place of a stream, of a log or of what warns one that keeps it to itself; None in place of anything else."""
    if value is sys.stdout or value is sys.stderr:
        return StringIO()
    if room != "logging":
        return unsaid if value is warnings.warn else None
    logging = sys.modules["logging"]
    quiet = logging.Logger("", level=1000)  # above all that is told
    if isinstance(value, logging.Logger):
        return quiet
    name = getattr(value, "__name__", "")
    telling = ("debug", "info", "warning", "error", "exception", "critical", "log")
    return unsaid if name in telling else (lambda *_: quiet) if name == "getLogger" else None


def opened(file: Any, mode: str = "r", *args: Any, **kwargs: Any) -> Any:
    """A file, which is read; what the worksheet writes it has written already."""
    return open(*(file, mode) if {*mode}.isdisjoint("wax+") else (os.devnull, mode.replace("x", "w")), *args, **kwargs)
