"""How far a long job is: a bar in the page or on the terminal, and nothing in a pipe."""

import sys
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from contextvars import ContextVar

_WIDTH, _TITLE = 20, 26  # characters of the bar and of what stands behind it: together less than a line
_LONG = 2.0  # s of a job that shows how far it is
_shown = ContextVar("_shown", default=False)  # whether there is a bar already: one of a part would stand in its place


@contextmanager
def progress(total: int, title: str) -> Iterator[Callable[..., object]]:
    """A bar with the time that is left, gone when all is done; called after each of the ``total`` steps.

    A call may give the title of the step that follows.
    """
    marimo = sys.modules.get("marimo")  # a page has loaded it, and a script need not
    if marimo is None or not marimo.running_in_notebook():
        with on_terminal(total, title) as done:
            yield done
        return
    with marimo.status.progress_bar(total=total, title=title, remove_on_exit=True) as bar:
        yield lambda title=None: bar.update(title=title)


@contextmanager
def on_terminal(total: int, title: str, since: float | None = None) -> Iterator[Callable[..., object]]:
    """The same as `progress` where nothing else has a bar, and none in a page, whose cells may show their own.

    The time that is left is told by that ``since`` which the work goes on, on the clock that never goes back.
    """
    marimo = sys.modules.get("marimo")
    in_page = marimo is not None and marimo.running_in_notebook()
    drawing = total > 1 and sys.stderr.isatty() and not _shown.get() and not in_page
    begun, count, width = time.monotonic() if since is None else since, 0, 0

    def draw() -> None:
        nonlocal width
        full = _WIDTH * count // total
        bar = "#" * full + "." * (_WIDTH - full)
        step = f"{title[:_TITLE]}  {remaining(time.monotonic() - begun, count, total)}".strip()
        text = f"[{bar}] {count} of {total}  {step}"
        width = max(width, len(text))
        print(f"\r{text:{width}}", end="", file=sys.stderr, flush=True)

    def done(following: str | None = None) -> None:
        nonlocal count, title
        count, title = count + 1, title if following is None else following
        if drawing and count < total:
            draw()

    if drawing:
        draw()
    token = _shown.set(_shown.get() or drawing)
    try:
        yield done
    finally:
        _shown.reset(token)
        if width:
            print(f"\r{'':{width}}\r", end="", file=sys.stderr, flush=True)


@contextmanager
def if_long(title: str) -> Iterator[Callable[[int, int], object]]:
    """A bar on the terminal once a job takes long; called with how many of how many steps are behind."""
    begun, shown = time.monotonic(), 0
    step: Callable[..., object] | None = None
    with ExitStack() as stack:

        def done(behind: int, count: int) -> None:
            nonlocal step, shown
            if step is None and time.monotonic() - begun > _LONG:
                step = stack.enter_context(on_terminal(count, title, begun))
            while step and shown < behind:
                step()
                shown += 1

        yield done


def remaining(seconds: float, count: int, total: int) -> str:
    """Time that the other steps will take, as ``count`` of all have taken so many seconds; "" where nobody knows.

    >>> remaining(10.0, 1, 4), remaining(600.0, 2, 4), remaining(1.0, 0, 4)
    ('30 s left', '10 min left', '')
    """
    if not count:
        return ""
    left = seconds / count * (total - count)
    return f"{round(left)} s left" if left < 90 else f"{round(left / 60)} min left"
