"""The library's functions in elementary steps, as the cells of a workbook compute them.

Each function of the files beside this one does what the function of the same name in the mechanics does, with
arithmetic, square roots and the functions of angles alone; `STEPS` tells which is whose. The library's own keep more
digits near dead centres, check their arguments and serve the worksheets; these serve as the formulas that a workbook
shows. Intermediate quantities carry the name, unit and meaning under which the workbook lists them.
"""

from collections.abc import Callable
from inspect import isfunction
from typing import Any

from mechsheet.mechanics import crank, drive, equilibrium, joint, load, planar, prp, rpp, rpr, rrp, rrr
from mechsheet.quantities import elementary_equilibrium, elementary_groups, elementary_joint, elementary_planar


def _steps() -> dict[Callable[..., Any], Callable[..., Any]]:
    files = elementary_planar, elementary_groups, elementary_joint, elementary_equilibrium
    own = {name: f for file in files for name, f in vars(file).items()}
    return {
        f: own[name]
        for home in (planar, load, crank, rrr, rrp, rpr, prp, rpp, drive, joint, equilibrium)
        for name, f in vars(home).items()
        if isfunction(f) and f.__module__ == home.__name__ and name in own and not name.startswith("_")
    }


STEPS = _steps()

# Classes whose methods call functions of `STEPS`: a worksheet that is recorded gets them with the steps instead.
GROUPS = frozenset({rrr.RRRGroup, rrp.RRPGroup, rpr.RPRGroup, prp.PRPGroup, rpp.RPPGroup})
