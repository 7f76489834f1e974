"""The title block of a worksheet, which tells its mistakes and has the tools of the editor while it is edited."""

import sys
from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path

from mechsheet.worksheet.title import Note, Title


def title_block(name: str, text: str = "") -> Title:
    """Title block of the calling worksheet; ``text`` is Markdown."""
    namespace = sys._getframe(1).f_globals
    file = Path(namespace.get("__file__", ""))
    title = Title(name, text, file.name)
    if "marimo" in sys.modules:
        import marimo as mo  # on use: a worksheet called as a function needs it not

        if mo.app_meta().mode == "edit" and mo.running_in_notebook():
            from mechsheet.page import editor, in_place, notebook, unfinished  # on use: only the editor needs them
            from mechsheet.page.script import element, script  # on use: as above

            folded = mo.Html(script("folded.js") + element("ms-folded", **{"class": "ms-screen"}))
            told = list[Note]()

            def edited() -> Title:
                return replace(title, notes=tuple(told), tools=(*title.tools, folded, lines.shown))

            def redraw() -> None:
                mo.output.replace(edited())

            def tell(notes: Iterable[Note]) -> None:
                told[:] = notes
                redraw()
                keep()

            keep = notebook.keep_unfinished(unfinished.left)
            lines = in_place.InPlace(namespace, redraw)
            told[:] = editor.watch(tell)
            return edited()
    return title
