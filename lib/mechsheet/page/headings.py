"""The headings of marimo's page, to which the index of a worksheet leads."""

import re
from functools import lru_cache

import marimo as mo


@lru_cache(maxsize=256)
def heading(text: str) -> str:
    """Id that marimo gives to a heading."""
    found = re.search(r'<h\d id="([^"]*)"', mo.md(f"# {text}").text)
    return found[1] if found else ""
