"""A worksheet beside numbers of its test's own: a value for every line that has a unit, whatever reads it."""

import ast
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np

from mechsheet.worksheet.cells import load
from mechsheet.worksheet.lines import registry

FOLDER = Path(__file__).parents[1] / "worksheets"
SLIDERS = {name: SimpleNamespace(value=x, text="") for name, x in {"part": 0.35, "forces_at": 0.4}.items()}
SLIDERS |= {name: SimpleNamespace(value=n, text="") for name, n in {"turn": 40, "drawn": 1, "drawn_ring": 1}.items()}


def inputs(stem: str, **changed: Any) -> Any:
    """Inputs of a worksheet in SI, some of them changed."""
    return replace(load(FOLDER / f"{stem}.py").inputs(), **changed)


def disagreements(stem: str, g: Any, reference: dict[str, Any], within: float = 1e-7) -> list[str]:
    """Where a worksheet and a reference differ by more than a part of the largest, and lines that have no reference.

    The reference is by expressions in the worksheet's names: ``P23_S``, ``P23(S)``. Angles, whose expressions begin
    with a name such as phi or gamma, may differ by whole turns.
    """
    sheet = load(FOLDER / f"{stem}.py")
    asked = {node.id for key in reference for node in ast.walk(ast.parse(key)) if isinstance(node, ast.Name)}
    names = sheet.run(sheet.results, {"g": g, **SLIDERS})
    found = [f"{name} has no reference" for name in sorted(set(registry(names)) - asked)]
    for key, true in reference.items():
        value, exact = np.broadcast_arrays(np.asarray(eval(key, names)), np.asarray(true))
        off = abs(value - exact)
        if key.startswith(("phi", "gamma", "psi", "beta", "delta")):
            off = abs(np.exp(1j * (value - exact)) - 1)
        size = np.max(abs(exact), initial=0.0, where=np.isfinite(exact))
        wrong = ~(off <= within * size + 1e-13) & ~(np.isnan(value) & np.isnan(exact)) & (value != exact)
        if wrong.any():
            found.append(f"{key}: {value[wrong][:3]} and not {exact[wrong][:3]}")
    return found


# Vector equations, in plain numpy


def circles(A: Any, r_A: Any, B: Any, r_B: Any, side: int) -> Any:
    """The point at r_A from A and r_B from B, to the left (+1) of the line from A to B."""
    d = abs(B - A)
    x = (d**2 + r_A**2 - r_B**2) / (2 * d)
    return A + (x + 1j * side * np.sqrt(r_A**2 - x**2)) * (B - A) / d


def slopes(f: Any, x: Any, step: float) -> tuple[Any, Any]:
    """First and second derivative of f, by seven values."""
    y = [f(x + k * step) for k in range(-3, 4)]
    first = (-y[0] + 9 * y[1] - 45 * y[2] + 45 * y[4] - 9 * y[5] + y[6]) / (60 * step)
    second = (2 * y[0] - 27 * y[1] + 270 * y[2] - 490 * y[3] + 270 * y[4] - 27 * y[5] + 2 * y[6]) / (180 * step**2)
    return first, second


def turns(f: Any, x: Any, step: float) -> tuple[Any, Any]:
    """First and second derivative of the direction of the vector f."""
    v1, v2 = slopes(f, x, step)
    rate = v1 / f(x)
    return rate.imag, (v2 / f(x) - rate**2).imag


def moment(arm: Any, force: Any) -> Any:
    return arm.real * force.imag - arm.imag * force.real


def along(force: Any, way: Any) -> Any:
    return force.real * way.real + force.imag * way.imag
