"""The names of a worksheet as its sentences say them: notes, names of checks, what a Find looks for."""

import ast
from collections.abc import Iterable, Iterator, Mapping
from functools import lru_cache
from re import sub
from typing import Any

from mechsheet.worksheet import source, symbol


def said(namespace: Mapping[str, Any]) -> frozenset[str]:
    """What the lines and inputs of the worksheet that runs in a namespace may be called in a sentence."""
    own: Mapping[str, str] = getattr(type(namespace.get("g")), "__units__", {})
    return _said_of(source.cells(namespace)) | forms(own)


@lru_cache(maxsize=32)
def _said_of(cells: tuple[source.Cell, ...]) -> frozenset[str]:
    return forms(name for cell in cells for line in cell.body for node in source.nodes(line) for name in _named(node))


def _named(node: ast.AST) -> Iterator[str]:
    match node:
        case ast.Name(id=name) | ast.Attribute(attr=name) | ast.arg(arg=name):
            yield name


def forms(names: Iterable[str]) -> frozenset[str]:
    """Names also without underscores and last letters, by their parts, and of points the coordinates.

    >>> sorted(forms(["R_O1g", "P56_S"]) - {"R", "S"})
    ['O1g', 'P56', 'P56_S', 'RO1', 'RO1g', 'R_O1g', 'X56', 'Y56']
    """
    found = set[str]()
    for name in names:
        own = symbol.plain(name)
        found.update((name, own, sub("[a-z]+$", "", own), *name.split("_")))
        if own.startswith("P"):
            found.update((f"X{own[1:]}", f"Y{own[1:]}"))
    return frozenset(found)
