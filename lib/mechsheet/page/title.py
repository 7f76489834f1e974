"""The title block of a worksheet, which tells its mistakes too while it is edited."""

import sys
from dataclasses import replace
from pathlib import Path

from mechsheet.worksheet.title import Title


def title_block(name: str, text: str = "") -> Title:
    """Title block of the calling worksheet; ``text`` is Markdown."""
    title = Title(name, text, Path(sys._getframe(1).f_globals.get("__file__", "")).name)
    if "marimo" in sys.modules:
        import marimo as mo  # on use: a worksheet called as a function needs it not

        if mo.app_meta().mode == "edit":
            from mechsheet.page import editor  # on use: only the editor needs it
            from mechsheet.page.script import element, script

            folded = mo.Html(script("folded.js") + element("ms-folded", **{"class": "ms-screen"}))
            title = replace(title, tools=(folded,))
            told = editor.watch(lambda notes: mo.output.replace(replace(title, notes=tuple(notes))))
            return replace(title, notes=told)
    return title
