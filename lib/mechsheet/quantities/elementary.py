"""The library's functions in elementary steps, as the cells of a workbook compute them.

Each function of the files beside this one does what the function of the same name in the mechanics does, with
arithmetic, square roots and the functions of angles alone. The library's own check their arguments, keep the last
digits of links that a rounding parts from one line, and serve the worksheets; these serve as the formulas that a
workbook shows. What rounding alone makes of a dead centre is no number in either. Intermediate quantities carry the
name, unit and meaning under which the workbook lists them.
"""

from collections.abc import Callable
from importlib import import_module
from typing import Any

_FILES = {  # by those of the mechanics
    "crank": "elementary_planar",
    "drive": "elementary_drive",
    "equilibrium": "elementary_equilibrium",
    "joint": "elementary_joint",
    "load": "elementary_group",
    "planar": "elementary_planar",
    "prp": "elementary_prp",
    "rpp": "elementary_rpp",
    "rpr": "elementary_rpr",
    "rrp": "elementary_rrp",
    "rrr": "elementary_rrr",
}


def in_steps(f: Callable[..., Any]) -> Callable[..., Any] | None:
    """A function of the mechanics in elementary steps; None where it has no such form."""
    room, _, stem = f.__module__.rpartition(".")
    file = _FILES.get(stem) if room == "mechsheet.mechanics" and not f.__name__.startswith("_") else None
    if file is None:
        return None
    form: Callable[..., Any] | None = getattr(import_module(f"{__package__}.{file}"), f.__name__, None)
    return form
