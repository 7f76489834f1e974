"""Dimensions checked by a change of units: every result must scale as its declared unit says."""

import itertools
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from mechsheet import units
from mechsheet.worksheet import inputs
from mechsheet.worksheet.cells import load
from mechsheet.worksheet.lines import Formula, registry

# How much smaller the new metre, kilogram and second are; no small powers of one are powers of another.
_SCALES = (1.7, 2.3, 1.3)
_ROUNDING = 1e-9
_ALIKE = 1e-6  # no two products of small powers of the scales are as near to each other


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
    first, second = (sheet.run(want, {"g": machine}) for machine in (g, rescaled(g)))
    lines = [line for line in registry(first).values() if not line.arguments]
    return [
        Mismatch(line.name, line.unit, f"line {line.expression.lineno} of {sheet.path}")
        for line in unfit(lines, g, first, second)
    ]


def unfit(lines: Iterable[Formula], g: Any, first: Mapping[str, Any], second: Mapping[str, Any]) -> dict[Formula, str]:
    """Those of the lines whose unit does not fit, with the reason in words.

    ``first`` are the values on the inputs ``g``, ``second`` those on the `rescaled` ones.
    """
    lines = list(lines)
    values = [(line.unit, first[line.name]) for line in lines]
    values += [(field.unit, getattr(g, field.name)) for field in inputs.declared(type(g))]
    largest, known = _largest(values), [unit for unit, _ in values]
    return {
        line: f"unit [{line.unit}] does not fit; {_scaling(first[line.name], second[line.name], known)}"
        for line in lines
        if not _scales(first[line.name], second[line.name], line.unit, largest)
    }


def _factor(unit: str) -> float:
    return float(np.prod(np.power(_SCALES, units.parse(unit).dims)))


def rescaled(g: Any) -> Any:
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
    sizes = [(units.parse(unit).dims, np.abs(v)[np.isfinite(v)]) for unit, v in values]
    found = [[np.max(size) for dims, size in sizes if dims == kind and np.size(size)] for kind in kinds]
    length, force, time = (float(max(most, default=0.0)) or 1.0 for most in found)
    return length, force, time


def _scaling(first: Any, second: Any, known: Iterable[str]) -> str:
    """What a value scales as, in words: one of the known units, or powers of m, kg and s."""
    first, second = np.asarray(first), np.asarray(second)
    counted = np.isfinite(first) & np.isfinite(second) & (first != 0)
    ratios = second[counted] / first[counted]
    powers = np.array(list(itertools.product(range(-4, 5), repeat=3)))
    factors = np.prod(np.power(_SCALES, powers), axis=1)
    for dims, factor in zip(powers.tolist(), factors, strict=True):
        if ratios.size and np.allclose(ratios, factor, rtol=_ALIKE, atol=0):
            return f"the value is in {units.shown(_named(tuple(dims), known))}"
    return "it, or a function that it uses, adds different units or hides one in a number"


def _named(dims: tuple[int, ...], known: Iterable[str]) -> str:
    """A unit of these exponents: one that the worksheet uses, without its factor, or a product."""
    if not any(dims):
        return "- (a number)"
    used = [units.si(unit) for unit in known if units.parse(unit).dims == dims]
    parts = zip(("m", "kg", "s"), dims, strict=True)
    return min(used, key=len, default="*".join(name if n == 1 else f"{name}**{n}" for name, n in parts if n))
