"""Lines of a document that have no number somewhere though all that they read has: where, and of how many."""

from collections.abc import Iterator, Mapping
from operator import attrgetter
from types import ModuleType
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mechsheet.document.left_out import is_numeric
from mechsheet.worksheet.lines import Formula, names_read, registry
from mechsheet.worksheet.numbers import existing

_FEW = 4  # places that are named


class Numberless(NamedTuple):
    """A line, and where its value is none."""

    line: Formula
    where: str


def numberless(names: Mapping[str, Any], known: Mapping[str, Formula] | None = None) -> Iterator[Numberless]:
    """The lines, all or the ``known`` ones, where a run's numbers get lost: at them, not at what rests on them."""
    for line in (registry(names) if known is None else known).values():
        lost = _lost(existing(names[line.name]))
        if lost.any() and not any(_lost(_read(names, name)).any() for name in names_read(line)):
            yield Numberless(line, _where(lost))


def _lost(value: Any) -> NDArray[np.bool_]:
    return np.isnan(value) if is_numeric(value) else np.zeros((), bool)


def _read(names: Mapping[str, Any], name: str) -> Any:
    head, dot, part = name.partition(".")
    value = names.get(head)
    try:
        return value if not dot else None if isinstance(value, ModuleType) else attrgetter(part)(value)
    except AttributeError:  # of a unit, or of what is none itself
        return None


def _where(lost: NDArray[np.bool_]) -> str:
    if not lost.ndim:
        return "no number"
    at = np.argwhere(lost)
    some = ", ".join(" ".join(str(k + 1) for k in place) for place in at[:_FEW])
    return f"no number at {len(at)} of {lost.size} places: {some}{', …' if len(at) > _FEW else ''}"
