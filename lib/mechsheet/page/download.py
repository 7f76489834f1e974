"""The buttons that make a file when they are pressed, and what is said of that file below them."""

from collections.abc import Callable, Iterable
from functools import partial
from html import escape
from typing import NamedTuple

import marimo as mo


class File(NamedTuple):
    """A file by its name, what its button says, and its bytes with the lines that tell of it."""

    name: str
    label: str
    made: Callable[[], tuple[bytes, Iterable[str]]]


def download(*files: File) -> mo.Html:
    """Buttons of some files; once one is pressed, the lines that come with its bytes stand below them."""

    def shown(lines: Iterable[str]) -> mo.Html:
        told = "<br>".join(map(escape, lines))
        side = "".join(button.text for button in buttons)
        return mo.Html(f'<div><div class="ms-row">{side}</div><div class="ms-note">{told}</div></div>')

    def pressed(file: File) -> bytes:
        data, lines = file.made()
        mo.output.replace(shown(lines))
        return data

    buttons = [mo.download(partial(pressed, file), filename=file.name, label=file.label) for file in files]
    return shown(())
