"""Whether a page is that of its file: studies compute through the file, and would tell of other formulas."""

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from mechsheet.page import notebook
from mechsheet.worksheet.errors import SheetError
from mechsheet.worksheet.line_edit import same_cells

_OTHER = "the file of this worksheet is another one than this page: save the page, or open it anew"


def refusing_another(namespace: Mapping[str, Any]) -> Callable[[], None]:
    """What raises SheetError while the cells of the calling page are not those of its file.

    Nothing does where this version of marimo does not tell of its cells.
    """
    try:
        cells, _ = notebook.running()
        cells()
    except notebook.Unlike:
        return lambda: None

    def refuse() -> None:
        try:
            text = Path(namespace["__file__"]).read_bytes().decode()
        except OSError:  # it is gone
            text = ""
        if not same_cells(text, [cell.code for cell in cells()]):
            raise SheetError(_OTHER)

    return refuse
