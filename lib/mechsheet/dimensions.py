"""Dimensions checked by a change of units: every result must scale as its declared unit says."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from mechsheet import formula, inputs, units
from mechsheet.worksheet import load

# How much smaller the new metre, kilogram and second are; no small powers of one are powers of another.
_SCALES = (1.7, 2.3, 1.3)
_ROUNDING = 1e-9


@dataclass(frozen=True)
class Mismatch:
    """A line whose value does not scale by its declared unit."""

    name: str
    unit: str
    place: str

    def __str__(self) -> str:
        return f"{self.place}: {self.name} does not scale as its unit [{self.unit}]"


def mismatches(worksheet: str | Path) -> list[Mismatch]:
    """Lines of a worksheet whose values do not scale by their declared units, in the order of the file.

    The worksheet runs twice: on its own inputs, and on the same machine measured in a smaller metre, kilogram
    and second. A line that adds newtons to newton metres, or hides a constant that has a unit, changes by
    another factor than its unit. Lines after the first one may be wrong only because they use it.
    """
    sheet = load(worksheet)
    want = [name for cell in sheet.cells for name in cell.gives if name != "g"]
    g = sheet.inputs()
    first, second = (sheet.run(want, {"g": machine}) for machine in (g, _rescaled(g)))
    lines = formula.registry(first).values()
    values = [(line.unit, first[line.name]) for line in lines if not line.arguments]
    values += [(field.unit, getattr(g, field.name)) for field in inputs.declared(type(g))]
    largest = _largest(values)
    return [
        Mismatch(line.name, line.unit, f"line {line.expression.lineno} of {sheet.path}")
        for line in lines
        if not line.arguments and not _scales(first[line.name], second[line.name], line.unit, largest)
    ]


def _factor(unit: str) -> float:
    return float(np.prod(np.power(_SCALES, units.parse(unit).dims)))


def _rescaled(g: Any) -> Any:
    """The same inputs in the other units; limits in display units no longer apply, so they are not checked."""
    other = object.__new__(type(g))
    for field in inputs.declared(type(g)):
        value = getattr(g, field.name)
        object.__setattr__(other, field.name, value if field.whole else value * _factor(field.unit))
    return other


def _scales(first: Any, second: Any, unit: str, largest: tuple[float, float, float]) -> bool:
    """Whether the second value is the first one in the other units, but for rounding of what it may be made of."""
    expected = np.asarray(first) * _factor(unit)
    m, kg, s = units.parse(unit).dims
    length, force, time = largest
    noise = _factor(unit) * length ** (m - kg) * force**kg * time ** (s + 2 * kg)
    return bool(np.allclose(second, expected, rtol=_ROUNDING, atol=1e-3 * _ROUNDING * noise, equal_nan=True))


def _largest(values: list[tuple[str, Any]]) -> tuple[float, float, float]:
    """The largest length, force and time of a worksheet, 1 where it has none."""
    kinds = [units.parse(unit).dims for unit in ("m", "N", "s")]
    found = [[np.nanmax(np.abs(v)) for unit, v in values if units.parse(unit).dims == kind] for kind in kinds]
    length, force, time = (float(max(sizes, default=0.0)) or 1.0 for sizes in found)
    return length, force, time
