"""What a page may ask of many runs of its worksheet: what matters for a result, what it would take to have another."""

import time
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from mechsheet.run.progress import remaining
from mechsheet.worksheet import numbers, shown
from mechsheet.worksheet.cells import load
from mechsheet.worksheet.errors import SheetError, as_given
from mechsheet.worksheet.inputs import Used
from mechsheet.worksheet.lines import registry
from mechsheet.worksheet.no_inputs import inputs_of
from mechsheet.worksheet.typeset import no_number


def searches(worksheet: Path) -> bool:
    """Whether a worksheet searches or measures over many runs; not known, so no, of one that cannot be read."""
    from mechsheet.html.write import studies  # on use: the start page needs it not

    try:
        return bool(studies(load(worksheet)))
    except Exception:  # of the worksheet's own lines: its run tells it
        return False


def results_of(namespace: Mapping[str, Any]) -> dict[str, str]:
    """Results of a run that are real numbers, or the parts of complex ones, by which one may ask, and their units.

    There is none where a line cannot be read, which its own cell tells.
    """
    found = dict[str, str]()
    try:
        lines = dict(registry(namespace))
    except (SheetError, SyntaxError):
        return found
    for name, line in lines.items():
        value = namespace.get(name)
        kind = "" if line.arguments or no_number(line, value) else np.asarray(value).dtype.kind
        parts = {"i": [name], "f": [name], "c": [f"{name}.real", f"{name}.imag", f"abs({name})"]}.get(kind, [])
        found |= dict.fromkeys(parts, "" if line.unit == "-" else numbers.in_text(line.unit))
    return found


def matters(namespace: Mapping[str, Any], name: str, position: str) -> tuple[Any, Any]:
    """Tornado and table of the elasticities of a result by all inputs, as they are in a run, at a position.

    Raises SheetError where there is no such position, or what `mechsheet.sensitivity` raises.
    """
    at: Any = int(position) if position.isdecimal() else position
    if not isinstance(at, int) and at not in ("least", "greatest"):
        raise SheetError(f"position {as_given(position)} must be least, greatest or a number from 0")
    found = shown.study("sensitivity")(namespace["__file__"], [name], g=inputs_of(namespace))
    title = f"What matters for {name}"
    return found.tornado("", title, name, at), found.table("", title, name, at)


def designed(namespace: Mapping[str, Any], options: Sequence[str], done: Callable[[float, str], object]) -> Any:
    """What it would take, asked by options of the command, with the other inputs as they are in a run.

    ``done`` is called with the part of a search that is behind it and the time that is left, in words. Raises
    SheetError where it cannot be asked or reached.
    """
    used, begun = Used(inputs_of(namespace)), time.monotonic()
    given = {name: value for name, value in used.given().items() if name in used.changed}

    def generation(count: int, total: int) -> None:
        done(count / total, remaining(time.monotonic() - begun, count, total))

    return shown.study("asked_design")(namespace["__file__"], options, given, generation)
