"""What a served page tells of a cell that failed or was stopped: marimo leaves its place empty, or its sections."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any


def tell() -> None:
    """Let every page that this process serves tell why a cell of a worksheet has failed, in its place."""
    from mechsheet.page import notebook  # on use: a server is up sooner without

    notebook.tell_of_failures(told, kept)


def told(error: object, cell_id: str, namespace: Mapping[str, Any]) -> str:
    """HTML of why a cell of the page that runs in a namespace has failed; nothing where another place tells it."""
    import marimo as mo  # on use: as above

    from mechsheet.page import values  # on use: as above

    path = Path(namespace.get("__file__") or "")
    if mo.app_meta().mode != "run" or not _is_worksheet(path):
        return ""
    if isinstance(error, mo.MarimoStopError):
        return values.stopped(error.output, cell_id)
    reason = _reason(error, path)
    return values.failed(reason, cell_id=cell_id) if reason else ""


def kept(code: str, namespace: Mapping[str, Any]) -> str:
    """HTML of the texts without numbers in a cell that waits for another one; nothing where it has none."""
    import marimo as mo  # on use: as above

    from mechsheet.page import values, waiting  # on use: as above
    from mechsheet.worksheet import source  # on use: as above

    if mo.app_meta().mode != "run" or not _is_worksheet(Path(namespace.get("__file__") or "")):
        return ""
    return "".join(map(values.html, waiting.own_texts(source.parsed(code)[0].body)))


def _reason(error: object, path: Path) -> str:
    """Why a cell has failed; nothing where what marimo has instead of an exception only leads to another cell."""
    from mechsheet.worksheet import cells, mistakes  # on use: once a cell has failed
    from mechsheet.worksheet.errors import SheetError  # on use: as above

    if isinstance(error, SheetError):
        return str(error)
    if isinstance(error, BaseException):
        return mistakes.told(error, str(path))
    if getattr(error, "raising_cell", None):
        return ""
    try:
        cells.load(path)
    except SheetError as found:
        return str(found)
    return str(error.describe()) if hasattr(error, "describe") else ""


def _is_worksheet(path: Path) -> bool:
    return path.is_file() and b"mechsheet" in path.read_bytes()
