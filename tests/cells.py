"""Runs text as a cell of the editor: compiled on its own, its source to be found by name."""

import itertools
import linecache
from typing import Any

_numbers = itertools.count()


def run(code: str, namespace: dict[str, Any] | None = None) -> dict[str, Any]:
    """Namespace after running ``code`` as one cell."""
    filename = f"<cell {next(_numbers)}>"
    linecache.cache[filename] = (len(code), None, code.splitlines(keepends=True), filename)
    names = {} if namespace is None else namespace
    exec(compile(code, filename, "exec"), names)
    return names
