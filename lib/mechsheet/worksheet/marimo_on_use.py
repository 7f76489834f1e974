"""marimo as the cells of a worksheet know it that runs without its page."""

from typing import Any


class Marimo:
    """marimo, imported at its first use: that takes half a second, and results need nothing of it, nor texts alone."""

    def md(self, text: str) -> "Markdown":
        return Markdown(text)

    def __getattr__(self, name: str) -> Any:
        import marimo  # on use: see above

        return getattr(marimo, name)


class Markdown(str):
    """A text that marimo lays out where something of it is asked for but the text itself."""

    def __getattr__(self, name: str) -> Any:
        import marimo  # on use: see above

        return getattr(marimo.md(self), name)
