"""Files written whole or not at all."""

import os
from pathlib import Path
from uuid import uuid4

from mechsheet.worksheet.errors import SheetError


def save(data: bytes, path: Path) -> None:
    """Write a file whole or not at all.

    Raises SheetError where the folder or the disk refuses; an older file at ``path`` then stays as it was.
    """
    temporary = path.with_name(f".{path.name}.{uuid4().hex}")
    try:
        try:
            with temporary.open("xb") as file:
                file.write(data)
                file.flush()
                os.fsync(file.fileno())
            os.replace(temporary, path)
        finally:
            temporary.unlink(missing_ok=True)
    except OSError as error:
        raise SheetError(f"workbook {path} cannot be written: {error.strerror or error}") from error
