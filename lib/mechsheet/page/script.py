"""The scripts of the page, one for each thing that it does by itself, and the elements that they show."""

import base64
from functools import cache
from html import escape
from pathlib import Path
from typing import Any

from mechsheet.document.markup import attribute
from mechsheet.html.javascript import runtime


def element(kind: str, content: str = "", **told: Any) -> str:
    """HTML of an element with what it is told in its attributes: a text, or else JSON."""
    texts = (f' {name}="{escape(x)}"' if isinstance(x, str) else attribute(name, x) for name, x in told.items())
    return f"<{kind}{''.join(texts)}>{content}</{kind}>"


@cache
def script(name: str, *before: str) -> str:
    """A script beside this file, as an address: the only form in which a page of marimo runs one from an output.

    What it shares with the page in one file comes ``before`` it, within its own scope.
    """
    text = (Path(__file__).parent / name).read_bytes()
    if before:
        text = f"(() => {{\n{runtime(*before)}\n{text.decode()}\n}})();".encode()
    return f'<script src="data:text/javascript;base64,{base64.b64encode(text).decode()}"></script>'
