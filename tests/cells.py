"""Runs texts as cells of the editor: each compiled on its own, its source to be found by name."""

import itertools
import linecache
from collections.abc import Mapping
from typing import Any

from mechsheet.worksheet import shown

_numbers = itertools.count()
_elsewhere = shown.cells_in_page


def run(code: str, namespace: dict[str, Any] | None = None) -> dict[str, Any]:
    """Namespace after running ``code`` as one cell."""
    filename = f"<cell {next(_numbers)}>"
    linecache.cache[filename] = (len(code), None, code.splitlines(keepends=True), filename)
    names = {} if namespace is None else namespace
    names["cells that ran"] = (*names.get("cells that ran", ()), (code, filename))
    exec(compile(code, filename, "exec"), names)
    return names


def _in_page(namespace: Mapping[str, Any]) -> shown.Texts | None:
    """As a page knows its cells, these are known by the namespace in which they have run."""
    return namespace["cells that ran"] if "cells that ran" in namespace else _elsewhere(namespace)


shown.cells_in_page = _in_page
