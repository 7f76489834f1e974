"""How far a long job is: a bar in the page or on the terminal, and nothing in a pipe."""

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager

_WIDTH, _TITLE = 30, 30  # characters of the bar and of what stands behind it: together less than a line


@contextmanager
def progress(total: int, title: str) -> Iterator[Callable[..., object]]:
    """A bar that goes when all is done; what it gives is called after each of the ``total`` steps.

    A call may give the title of the step that follows.
    """
    marimo = sys.modules.get("marimo")  # a page has loaded it, and a script need not
    if marimo is not None and marimo.running_in_notebook():
        with marimo.status.progress_bar(total=total, title=title, remove_on_exit=True) as bar:
            yield lambda title=None: bar.update(title=title)
        return
    count, shown = 0, ""

    def draw() -> None:
        nonlocal shown
        if sys.stderr.isatty():
            full = _WIDTH * count // total
            bar = "#" * full + "." * (_WIDTH - full)
            shown = f"[{bar}] {count} of {total}  {title[:_TITLE]:{_TITLE}}"
            print(f"\r{shown}", end="", file=sys.stderr, flush=True)

    def done(following: str | None = None) -> None:
        nonlocal count, title
        count, title = count + 1, title if following is None else following
        if count < total:
            draw()

    draw()
    try:
        yield done
    finally:
        if shown:
            print(f"\r{'':{len(shown)}}\r", end="", file=sys.stderr, flush=True)
