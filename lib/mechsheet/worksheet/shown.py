"""What higher rooms tell those below: how a page shows values, which are data, which cells it runs; many runs.

The package itself loads this file: nothing else is imported here.
"""

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from contextvars import ContextVar
from typing import Any, Protocol

Texts = tuple[tuple[str, str], ...]  # of cells: each with the name under which it is compiled


class Page(Protocol):
    """What the page's room tells."""

    def written(self, value: object) -> tuple[str, str]:
        """MIME type and text of a value."""

    def slider(self, slider: Any) -> Any:
        """What a page moves for a slider; the slider itself where no page is running."""

    def refused(self, error: Exception, shown: Any) -> None:
        """Stop the running cell with an error in its place, or ``shown``; return where no page is running."""


def _none() -> Page:
    raise RuntimeError("no writer of pages is registered: import mechsheet, not a part of it by its file")


page: Callable[[], Page] = _none  # set by the package itself, and called when a value is shown for the first time


def _unregistered(_name: str) -> Any:
    raise RuntimeError("no studies are registered: import mechsheet, not a part of it by its file")


study: Callable[[str], Any] = _unregistered  # the function of that name, of many runs; set by the package itself


def _no_page(_namespace: Mapping[str, Any]) -> Texts | None:
    return None


# Cells of the page that runs in a namespace, as they have run last; set by the package itself.
cells_in_page: Callable[[Mapping[str, Any]], Texts | None] = _no_page


_asked: ContextVar["list[Shown] | None"] = ContextVar("_asked", default=None)


@contextmanager
def arranged() -> Iterator["list[Shown]"]:
    """List of the values whose texts marimo asks for within it, to arrange them, in that order; it is given none."""
    asked = list[Shown]()
    token = _asked.set(asked)
    try:
        yield asked
    finally:
        _asked.reset(token)


class Shown:
    """A value that a cell can show: marimo asks it for its text, and the writer for its kind answers."""

    def _mime_(self) -> tuple[str, str]:
        if (asked := _asked.get()) is None:
            return page().written(self)
        asked.append(self)
        return "text/html", ""


class Charted(Shown):
    """What the page shows as the altair chart that it gives."""

    def chart(self) -> Any:
        raise NotImplementedError
