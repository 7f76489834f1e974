"""Reactive calculation documents for the design of mechanisms.

Everything public is a name of this package, loaded on its first use: ``from mechsheet import find, table, rrr``. Units
stand apart, in `mechsheet.units`.

A worksheet
    inputs          inputs, one_of, from_file, ask, read, Used, declared
    formulas        typeset, registry
    Find            find, Found, minerr, Solution
    checks          check, require, check_slope, closed_form, assembled, balance, largest_of, Check, summary
    tables, charts  table, figure, Table, Figure, Column
    drawings        Drawing, cut_group, polar, polar_diagrams, caption, side_by_side, slider, player, mark
    the document    title_block, index, progress, export
    errors          SheetError, refuse

A worksheet as a function
    one run         evaluate, load, results
    many runs       sweep, grid, Sweep, sensitivity, tolerance
    design          search, Requirement, Judged, pareto, Limit, scene_text, save_scene
    methods         accuracy_jobs, batch_times, group_times, cost_of_checks, integration_steps, whole_worksheets,
                    asked_costs, study_jobs, study_costs, claims_table, random_groups, end_to_end, time_spread,
                    measured_on, WorkPrecision
    extreme scenes  measured_scenes, DigitsKept

Mechanics: numpy arrays in, numpy arrays out
    vectors         dot, cross, product, angle, angle_between, angle_opposite, triangle_area
    links           link_point, link_velocity, link_acceleration
    drivers         crank, rrr_crank_reach, rrp_crank_reach, rpr_crank_reach
    group RRR       rrr, rrr_reach, rrr_velocity, rrr_acceleration, rrr_transmission_angle, rrr_condition,
                    rrr_determinant, rrr_reactions, RRRGroup
    group RRP       rrp, rrp_reach, rrp_velocity, rrp_acceleration, rrp_transmission_angle, rrp_condition,
                    rrp_determinant, rrp_reactions, RRPGroup
    group RPR       rpr, rpr_reach, rpr_velocity, rpr_acceleration, rpr_transmission_angle, rpr_condition,
                    rpr_determinant, rpr_reactions, RPRGroup
    group PRP       prp, prp_reach, prp_velocity, prp_acceleration, prp_transmission_angle, prp_condition,
                    prp_determinant, prp_reactions, PRPGroup
    group RPP       rpp, rpp_reach, rpp_velocity, rpp_acceleration, rpp_transmission_angle, rpp_condition,
                    rpp_determinant, rpp_reactions, RPPGroup
    loads, drives   Load, inertia, coupling_drive, gear_drive, cylinder_drive
    equilibrium     PinReaction, SlideReaction, DriveMoment, left_over, solve_reactions, magnitudes
    joints          neutral_axis, bending, circular_joint, sum_of_elements

``__version__`` is the version of the package.

Any planar mechanism of class II is written as a crank or cylinder and Assur groups, one line a group, over any number
of positions at once. A six-bar mechanism: the crank O1-A drives the rocker B-O3 through the coupler A-B, the rocker
drives the slider C through the rod B-C; all links have mass, the slider works against 400 N.

>>> import numpy as np
>>> from mechsheet import (
...     Load, RRPGroup, RRRGroup, coupling_drive, crank, inertia, link_acceleration, link_velocity,
... )

Positions, velocities and accelerations from the crank on, for a turn at 20 rad/s:

>>> O1, O3, omega1 = 0, 0.4 + 0.1j, 20.0
>>> phi1 = np.linspace(0, 2 * np.pi, 361)
>>> A = crank(O1, 0.1, phi1)
>>> v_A, a_A = link_velocity(A, O1, omega1), link_acceleration(A, O1, omega1)
>>> coupler_rocker = RRRGroup(A, O3, 0.4, 0.3, +1)
>>> B = coupler_rocker.C
>>> v23 = coupler_rocker.velocity(v_A)
>>> a23 = coupler_rocker.acceleration(v23, a_A)
>>> rod_slider = RRPGroup(B, 0.35j, 1, 0.5, +1)  # on a guide through 0.35j in the direction 1
>>> C = rod_slider.C
>>> v45 = rod_slider.velocity(v23.v_C)
>>> a45 = rod_slider.acceleration(v45, a23.a_C)

Inertia forces, then reactions from the last group to the crank:

>>> inertia2 = inertia((A + B) / 2, 2.0, 0.03, (a_A + a23.a_C) / 2, a23.epsilon_A)
>>> inertia3 = inertia(O3, 0.0, 0.05, epsilon=a23.epsilon_B)  # balanced about O3
>>> inertia4 = inertia((B + C) / 2, 2.5, 0.05, (a23.a_C + a45.a_C) / 2, a45.epsilon_A)
>>> on_slider = [inertia(C, 4.0, 0.0, a45.a_C), Load(-400 * np.sign(v45.v_C.real), C)]
>>> group45 = rod_slider.reactions([inertia4], on_slider)
>>> group23 = coupler_rocker.reactions([inertia2], [inertia3, Load(-group45.R_A, B)])
>>> M, R_O1 = coupling_drive(O1, [Load(-group23.R_A, A)])

The balancing moment does the work of all loads, the inertia forces' sum over a turn to nothing:

>>> work = np.trapezoid(M, phi1)
>>> resisted = np.trapezoid(400 * np.abs(v45.v_C) / omega1, phi1)
>>> print(f"{work:.0f} J of {resisted:.0f} J, M from {M.min():.0f} to {M.max():.0f} N m")
140 J of 140 J, M from -4 to 53 N m
"""

import ast
import sys
from collections.abc import Mapping
from importlib import import_module
from pathlib import Path
from typing import Any

from mechsheet.worksheet import shown


def _homes() -> dict[str, str]:
    """Module of each public name: the stub beside this file tells it, which type checkers and editors read too."""
    stub = ast.parse(Path(__file__).with_suffix(".pyi").read_text(encoding="utf-8"))
    imports = (node for node in stub.body if isinstance(node, ast.ImportFrom))
    return {name.name: str(node.module) for node in imports for name in node.names}


_HOMES = _homes()


def _cells_in_page(namespace: Mapping[str, Any]) -> shown.Texts | None:
    """Texts of the cells of the page that runs in a namespace; there is none where marimo is not loaded."""
    texts: shown.Texts | None = None
    if "marimo" in sys.modules:
        texts = import_module("mechsheet.page.notebook").texts(namespace)
    return texts


# What the lower rooms need of the page's, which is loaded only where a page asks for it.
shown.page = lambda: import_module("mechsheet.page.values")  # type: ignore[assignment,return-value]
shown.cells_in_page = _cells_in_page
shown.study = lambda name: getattr(import_module(f"mechsheet.studies.{name}"), name)

# A worksheet that is run as a script tells its mistakes in a line, and its cells are run as by the command.
_started = vars(sys.modules.get("__main__", sys))
_worksheet = type(_started.get("app")).__module__.startswith("marimo.")
if _worksheet:
    import_module("mechsheet.run.ending").watch(_started["__file__"])


def _asked_by_the_worksheet() -> bool:
    """Whether the statements of the started file itself ask for a name, and not a cell that marimo runs of it."""
    frame = sys._getframe(2)
    while frame.f_back and frame.f_globals.get("__name__") == "importlib._bootstrap":
        frame = frame.f_back
    return frame.f_globals is _started and frame.f_code.co_name == "<module>"


__all__ = sorted([*_HOMES, "__version__"])


def __getattr__(name: str) -> Any:
    """A public name, loaded on its first use: mechanics alone bring numpy alone, and the package itself nothing."""
    if name in _HOMES:
        if _worksheet and _asked_by_the_worksheet():
            import_module("mechsheet.run.script").start(_started["__file__"])
        main = vars(sys.modules.get("__main__", sys))
        if (
            "marimo" in sys.modules and main.get("__file__") and main.get("__loader__", main) is None
        ):  # marimo runs its cells
            import_module("mechsheet.run.script").report_at_exit(main)
        value = getattr(import_module(_HOMES[name]), name)
    elif name == "__version__":
        from importlib.metadata import version  # on use: takes longer than the rest of the package

        value = version(__name__)
    else:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    # who asks for the members and their values too, as help() does, would load all and print it behind the contents
    asked_by = sys._getframe(1).f_globals.get("__name__")
    return [] if asked_by == "inspect" else __all__
