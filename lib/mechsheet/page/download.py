"""The button that makes a file when it is pressed, and what is said of that file below it."""

from collections.abc import Callable, Iterable
from html import escape

import marimo as mo


def download(made: Callable[[], tuple[bytes, Iterable[str]]], name: str, label: str) -> mo.Html:
    """Button of a file of that name; once pressed, the lines that come with the bytes stand below it."""

    def shown(lines: Iterable[str]) -> mo.Html:
        told = "<br>".join(map(escape, lines))
        return mo.Html(f'<div>{button.text}<div class="ms-note">{told}</div></div>')

    def pressed() -> bytes:
        data, lines = made()
        mo.output.replace(shown(lines))
        return data

    button = mo.download(pressed, filename=name, label=label)
    return shown(())
