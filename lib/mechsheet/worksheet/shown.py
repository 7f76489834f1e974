"""Values of a worksheet are data; how a page shows them and what it shows of a refusal is told by the page's room."""

from collections.abc import Callable
from typing import Any, Protocol


class Page(Protocol):
    """What the page's room tells."""

    def written(self, value: object) -> tuple[str, str]:
        """MIME type and text of a value."""

    def refused(self, error: Exception, shown: Any) -> None:
        """Stop the running cell with an error in its place, or ``shown``; return where no page is running."""


def _none() -> Page:
    raise RuntimeError("no writer of pages is registered: import mechsheet, not a part of it by its file")


page: Callable[[], Page] = _none  # set by the package itself, and called when a value is shown for the first time


class Shown:
    """A value that a cell can show: marimo asks it for its text, and the writer for its kind answers."""

    def _mime_(self) -> tuple[str, str]:
        return page().written(self)


class Charted(Shown):
    """What the page shows as the altair chart that it gives."""

    def chart(self) -> Any:
        raise NotImplementedError
