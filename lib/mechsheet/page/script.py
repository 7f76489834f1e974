"""The scripts of the page, one for each thing that it does by itself."""

import base64
from functools import cache
from pathlib import Path


@cache
def script(name: str) -> str:
    """A script beside this file, as an address: the only form in which a page of marimo runs one from an output."""
    text = (Path(__file__).parent / name).read_bytes()
    return f'<script src="data:text/javascript;base64,{base64.b64encode(text).decode()}"></script>'
