"""Reactive calculation documents for the design of mechanisms.

The mechanics are a library of their own: any planar
mechanism of class II is written as a crank or cylinder and Assur groups, one line a group, over any number of
positions at once. A six-bar mechanism: the crank O1-A drives the rocker B-O3 through the coupler A-B, the rocker
drives the slider C through the rod B-C; all links have mass, the slider works against 400 N.

>>> import numpy as np
>>> from mechsheet import (
...     Load, coupling_drive, crank, inertia, link_acceleration, link_velocity,
...     rrp, rrp_acceleration, rrp_reactions, rrp_velocity, rrr, rrr_acceleration, rrr_reactions, rrr_velocity,
... )

Positions, velocities and accelerations from the crank on, for a turn at 20 rad/s:

>>> O1, O3, omega1 = 0, 0.4 + 0.1j, 20.0
>>> phi1 = np.linspace(0, 2 * np.pi, 361)
>>> A = crank(O1, 0.1, phi1)
>>> v_A, a_A = link_velocity(A, O1, 0, omega1), link_acceleration(A, O1, 0, omega1, 0)
>>> B = rrr(A, O3, 0.4, 0.3, +1)
>>> v_B, omega2, omega3 = rrr_velocity(A, O3, B, v_A, 0)
>>> a_B, epsilon2, epsilon3 = rrr_acceleration(A, O3, B, omega2, omega3, a_A, 0)
>>> G, u = 0.35j, 1  # a point of the slider's guide and its direction
>>> C = rrp(B, G, u, 0.5, +1)
>>> v_C, omega4, ds = rrp_velocity(B, G, C, u, v_B)
>>> a_C, epsilon4, dds = rrp_acceleration(B, G, C, u, omega4, ds, a_B)

Inertia forces, then reactions from the last group to the crank:

>>> S2, S4 = (A + B) / 2, (B + C) / 2
>>> inertia2 = inertia(2.0, 0.03, S2, (a_A + a_B) / 2, epsilon2)
>>> inertia3 = inertia(0.0, 0.05, O3, 0, epsilon3)  # balanced about O3
>>> inertia4 = inertia(2.5, 0.05, S4, (a_B + a_C) / 2, epsilon4)
>>> on_slider = [inertia(4.0, 0.0, C, a_C, 0), Load(-400 * np.sign(v_C.real), C)]
>>> group45 = rrp_reactions(B, C, u, [inertia4], on_slider)
>>> group23 = rrr_reactions(A, O3, B, [inertia2], [inertia3, Load(-group45.R_A, B)])
>>> M, R_O1 = coupling_drive(O1, [Load(-group23.R_A, A)])

The balancing moment does the work of all loads, the inertia forces' sum over a turn to nothing:

>>> work = np.trapezoid(M, phi1)
>>> resisted = np.trapezoid(400 * np.abs(v_C) / omega1, phi1)
>>> print(f"{work:.0f} J of {resisted:.0f} J, M from {M.min():.0f} to {M.max():.0f} N m")
140 J of 140 J, M from -4 to 53 N m
"""

import ast
import sys
from collections.abc import Mapping
from importlib import import_module
from pathlib import Path
from typing import Any

from mechsheet.worksheet import shown, source


def _homes() -> dict[str, str]:
    """Module of each public name: the stub beside this file tells it, which type checkers and editors read too."""
    stub = ast.parse(Path(__file__).with_suffix(".pyi").read_text(encoding="utf-8"))
    imports = (node for node in stub.body if isinstance(node, ast.ImportFrom))
    return {name.name: str(node.module) for node in imports for name in node.names}


_HOMES = _homes()


def _cells_in_page(namespace: Mapping[str, Any]) -> source.Texts | None:
    """Texts of the cells of the page that runs in a namespace; there is none where marimo is not loaded."""
    texts: source.Texts | None = None
    if "marimo" in sys.modules:
        texts = import_module("mechsheet.page.notebook").texts(namespace)
    return texts


# What the lower rooms need of the page's, which is loaded only where a page asks for it.
shown.page = lambda: import_module("mechsheet.page.values")  # type: ignore[assignment,return-value]
source.in_page = _cells_in_page
__all__ = sorted([*_HOMES, "__version__"])


def __getattr__(name: str) -> Any:
    """A public name, loaded on its first use: mechanics alone bring numpy alone, and the package itself nothing."""
    if name in _HOMES:
        value = getattr(import_module(_HOMES[name]), name)
    elif name == "__version__":
        from importlib.metadata import version  # on use: takes longer than the rest of the package

        value = version(__name__)
    else:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return __all__
