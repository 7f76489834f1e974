"""Files written whole or not at all."""

import os
import re
import stat
from contextlib import suppress
from pathlib import Path

from mechsheet.worksheet.errors import SheetError


def save(data: bytes, path: Path) -> None:
    """Write a file whole or not at all; a link is followed, and a file that is there keeps its permissions.

    What runs that were killed have left unfinished beside it is removed.

    Raises SheetError where the folder or the disk refuses, or the file is read-only; an older file at ``path`` then
    stays as it was.
    """
    try:
        _write(data, Path(os.path.realpath(path)))
    except OSError as error:
        raise SheetError(f"{path} cannot be written: {error.strerror or error}") from error


def _write(data: bytes, path: Path) -> None:
    mode = stat.S_IMODE(path.stat().st_mode) if path.exists() else None
    if mode is not None and not (mode & 0o222 and os.access(path, os.W_OK)):  # root may write whatever the mode says
        raise PermissionError(None, "the file is read-only")
    beside = f".{path.name}.{_machine()}."
    _remove_left_over(path.parent, beside)
    temporary = path.with_name(f"{beside}{os.getpid()}.{os.urandom(16).hex()}")
    try:
        with temporary.open("xb") as file:
            file.write(data)
            file.flush()
            os.fsync(file.fileno())
        if mode is not None:
            temporary.chmod(mode)
        os.replace(temporary, path)
    finally:
        temporary.unlink(missing_ok=True)


def _remove_left_over(folder: Path, beside: str) -> None:
    """Remove the unfinished files of processes of this machine that are no more."""
    for name in os.listdir(folder):
        owner = re.fullmatch(re.escape(beside) + r"(\d+)\.[0-9a-f]{32}", name)
        if owner and not _runs(int(owner[1])):
            with suppress(OSError):
                os.unlink(folder / name)


def _machine() -> str:
    """Name of this machine, without what `socket` and `platform` load for it."""
    return os.uname().nodename if hasattr(os, "uname") else os.environ.get("COMPUTERNAME", "")


def _runs(process: int) -> bool:
    if os.name == "nt":  # asking by a signal would end it; but there a file that is being written cannot be removed
        return process == os.getpid()
    try:
        os.kill(process, 0)
    except ProcessLookupError:
        return False
    except (OSError, OverflowError):
        pass
    return True
