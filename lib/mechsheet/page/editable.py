"""What the editor edits where it is shown: each place with the name of its line, reached by the keyboard too."""

import re
from collections.abc import Callable
from typing import Any

import marimo as mo

from mechsheet.page import notebook
from mechsheet.worksheet.check import Check
from mechsheet.worksheet.drawing import Drawing
from mechsheet.worksheet.shown import Shown
from mechsheet.worksheet.table import Figure, Table
from mechsheet.worksheet.title import Caption, SideBySide
from mechsheet.worksheet.verdict import Verdict

_KINDS = (Check, Verdict, Table, Figure, Drawing, Caption, SideBySide)
_LINE = '<div class="ms-line"'
_FIRST = re.compile("^<[^>]+")


def marking(html: Callable[[Any], str]) -> Callable[[Any], str]:
    """The writer of values that tells the page of the editor which line gives each."""

    def marked(value: Any) -> str:
        text = html(value)
        if not isinstance(value, Shown) or not mo.running_in_notebook() or mo.app_meta().mode != "edit":
            return text
        text = text.replace(f"{_LINE} id=", f'{_LINE} tabindex="0" id=')
        name = _name(value) if isinstance(value, _KINDS) else ""
        return _FIRST.sub(lambda tag: _told(tag[0], name), text) if name else text

    return marked


def _told(tag: str, name: str) -> str:
    """The first tag of what is shown, with the name of its line."""
    focus = "" if "tabindex" in tag else ' tabindex="0"'
    return f'{tag} data-line="{name}"{focus}'


def _name(value: Shown) -> str:
    """The name that a value, or a list that holds it, has in the page; "" of one that has none of the worksheet's."""
    try:
        namespace = dict(notebook.running()[1])
    except notebook.Unlike:
        return ""
    for name, each in namespace.items():
        held = each if isinstance(each, list | tuple) and each and isinstance(each[0], Shown) else (each,)
        if not name.startswith("_") and any(part is value for part in held):
            return name
    return ""
