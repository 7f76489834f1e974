"""The end of a page: what it may be asked for, and buttons that make a file when they are pressed."""

from collections.abc import Callable, Iterable, Mapping
from functools import partial
from html import escape
from threading import Lock
from typing import Any, NamedTuple

import marimo as mo

from mechsheet.page import notebook
from mechsheet.page.design import Design, Designing
from mechsheet.page.study import Asked, Study
from mechsheet.worksheet.errors import SheetError


class File(NamedTuple):
    """A file by its name, what its button says, and its bytes with the lines that tell of it."""

    name: str
    label: str
    made: Callable[[], tuple[bytes, Iterable[str]]]


def download(*files: File, asked: Asked, designing: Designing, namespace: Mapping[str, Any]) -> mo.Html:
    """Buttons of some files; once one is pressed, the lines that come with its bytes stand below them.

    Above them stands what else the page may be ``asked`` for, of the values in its ``namespace``, and what it would
    take to have others.
    """
    told, last, drawing = list[str](), "", Lock()

    def shown() -> str:
        lines = "<br>".join(map(escape, told))
        side = "".join(button.text for button in buttons)
        below = f'<div class="ms-row">{side}</div><div class="ms-note">{lines}</div>'
        return f"<div>{study.text}{design.text}{below}</div>"

    def redraw() -> None:
        nonlocal last
        with drawing:  # of what two threads draw, what is drawn last is what there is then
            last = shown()
            mo.output.replace(mo.Html(last))

    def changed() -> None:
        study.offer()
        design.offer()
        if shown() != last:
            redraw()

    def pressed(file: File) -> bytes:
        told[:] = [f"{file.name} is not written"]
        try:
            data, told[:] = file.made()
        except SheetError as error:
            told[:] = [f"{file.name} is not written: {error}"]
            raise
        finally:
            redraw()
        return data

    study, design = Study(asked, namespace, redraw), Design(designing, namespace, redraw)
    buttons = [mo.download(partial(pressed, file), filename=file.name, label=file.label) for file in files]
    last = shown()
    if mo.app_meta().mode == "edit":
        notebook.follow(changed)
    return mo.Html(last)
