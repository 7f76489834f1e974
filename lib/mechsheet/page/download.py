"""The end of a page: buttons that make a file when they are pressed, a switch that proves, and what these say."""

from collections.abc import Callable, Iterable, Mapping
from functools import partial
from html import escape
from typing import Any, NamedTuple

import marimo as mo

from mechsheet.page.study import Asked, Study


class File(NamedTuple):
    """A file by its name, what its button says, and its bytes with the lines that tell of it."""

    name: str
    label: str
    made: Callable[[], tuple[bytes, Iterable[str]]]


def download(*files: File, asked: Asked, namespace: Mapping[str, Any], proof: Callable[[], str]) -> mo.Html:
    """Buttons of some files, and the switch of a proof.

    Once a button is pressed, the lines that come with its bytes stand below; while it is switched on, the HTML of the
    proof does. Above them stands what else the page may be ``asked`` for, of the values in its ``namespace``.
    """
    told = {"file": "", "proof": ""}

    def shown() -> mo.Html:
        side = "".join(button.text for button in buttons) + switch.text
        below = f'<div class="ms-note">{told["file"]}</div>{told["proof"]}'
        return mo.Html(f'<div>{study.text}<div class="ms-row">{side}</div>{below}</div>')

    def redraw() -> None:
        mo.output.replace(shown())

    def pressed(file: File) -> bytes:
        data, lines = file.made()
        told["file"] = "<br>".join(map(escape, lines))
        redraw()
        return data

    def switched(on: bool) -> None:
        told["proof"] = proof() if on else ""
        redraw()

    study = Study(asked, namespace, redraw)
    buttons = [mo.download(partial(pressed, file), filename=file.name, label=file.label) for file in files]
    switch = mo.ui.switch(label="every number proved", on_change=switched)
    return shown()
