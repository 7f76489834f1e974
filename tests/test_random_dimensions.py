"""Formulas written at random: none that is right is told, and each whose numbers change with the units of length is."""

from __future__ import annotations

import textwrap
from collections.abc import Iterator
from math import hypot
from pathlib import Path
from random import Random
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from test_dimensions import HEAD

from mechsheet import cross
from mechsheet.recording.dimensions import Dimensions, of_every_line
from mechsheet.worksheet.cells import load
from mechsheet.worksheet.lines import registry

Dims = tuple[int, int, int]  # exponents of kg, m, s
PURE: Dims = (0, 0, 0)
INPUTS: dict[str, tuple[float, Dims]] = {
    "F": (500.0, (1, 1, -2)), "M": (30e3, (1, 2, -2)), "L": (2.0, (0, 1, 0)), "D": (3e-5, (0, 1, 0)),
    "S": (200e12, (1, -1, -2)), "V": (0.5, (0, 3, 0)), "t": (3.0, (0, 0, 1)), "W": (2.0, (1, 0, 0)),
}  # fmt: skip
UNITS = {"N": (1, 1, -2), "kg": (1, 0, 0), "m": (0, 1, 0), "second": (0, 0, 1)}
# What a part has to measure: $d what the whole does, $x anything, $y times $x is $d, $z over $x is $d, $q is the square
# of $d, $1 is a number; capitals are arrays of five elements.
NUMBERS = [
    "($d + $d)", "($d - $d)", "($x * $y)", "($z / $x)", "max($d, $d)", "hypot($d, $d)", "sqrt(abs($q))", "$D.max()",
    "$D[2]", "np.where($x > $x, $d, $d)[()]", "($d if $x > $x else $d)", "np.interp($x, np.sort($X), $D)",
    "np.trapezoid($Y, $X)", "np.dot($Y, $X)", "np.linalg.norm($D)", "abs($d + 1j * $d)", "($d * sin($1))",
    "cross($x + 1j * $x, $y * exp(1j * $1))", "sum(part * $y for part in $X)", "np.polyval([$y, $d], $x)",
    "np.linalg.solve(np.array([[2 * $x, $x], [$x, -$x]]), np.array([$z, $z]))[1]", "np.clip($d, $d, $d)",
    "({'a': $d, 'b': $x}['a'] + $d)", "(lambda p, q: p * q + $d)($x, $y)", "np.average($D, weights=$X)",
]  # fmt: skip
ARRAYS = [
    "(np.array([1.0, 2, 3, 4, 5]) * $d)", "np.linspace(0, $d, 5)", "np.linspace($d, $d, 5)", "($X * $Y)", "($D + $D)",
    "np.array([$d, $d, $d, 0, $d])", "np.cumsum($D)", "np.gradient($Z, $X)", "np.where($X > $x, $D, $d)",
    "np.maximum($D, $d)", "np.interp($X, np.sort($X), $D)", "np.concatenate([$D[:3], [$d, $d]])",
    "np.array([part * $y for part in $X])", "np.stack([$D, $D]).sum(axis=0)", "($D * sin($A))",
]  # fmt: skip


class Writer:
    """A formula of some dimension; of its parts the one that is ``planted`` measures a length more."""

    def __init__(self, seed: int, planted: int | None = None) -> None:
        self.random, self.planted, self.parts = Random(seed), planted, 0
        self.dims = self.anything()
        self.line = f"y = {self.filled(self.random.choice(NUMBERS), self.dims, 0)} * 1.0"

    def anything(self) -> Dims:
        return self.random.choice([dims for _, dims in INPUTS.values()])

    def filled(self, form: str, d: Dims, deep: int) -> str:
        x = self.anything()
        of = {"d": d, "x": x, "q": times(d, d), "y": times(d, x, -1), "z": times(d, x), "1": PURE, "a": PURE}
        first, *rest = form.split("$")
        return first + "".join(self.part(of[each[0].lower()], each[0].isupper(), deep) + each[1:] for each in rest)

    def part(self, dims: Dims, of_five: bool, deep: int) -> str:
        self.parts += 1
        if self.parts - 1 == self.planted:
            dims = times(dims, (0, 1, 0))
        if deep < 2 and self.random.random() < 0.7:
            return self.filled(self.random.choice(ARRAYS if of_five else NUMBERS), dims, deep + 1)
        alike = [f"g.{name}" for name, (_, own) in INPUTS.items() if own == dims]
        written = " * ".join([f"{self.random.randint(2, 9)}", *powers(dims, "kg", "m", "second")])
        one = self.random.choice([*alike, written])
        return f"(np.array([1.0, 3, 4, 6, 8]) * {one})" if of_five else f"({one})"


def powers(dims: Dims, *units: str) -> Iterator[str]:
    return (f"{unit}**{power}" for unit, power in zip(units, dims, strict=True) if power)


def times(a: Dims, b: Dims, power: int = 1) -> Dims:
    kg, m, s = (p + power * q for p, q in zip(a, b, strict=True))
    return kg, m, s


def told(folder: Path, made: Writer) -> Dimensions:
    line = f"{made.line}  # [{'*'.join(powers(made.dims, 'kg', 'm', 's'))}] y"
    path = folder / "bar.py"
    path.write_text(HEAD + textwrap.indent(f"{line}\nreturn", "    "), encoding="utf-8")
    sheet = load(path)
    names = sheet.run(sheet.results, {"g": sheet.inputs()})
    return of_every_line(sheet, names, registry(names))


def computed(made: Writer, metre: float) -> float:
    """Its number by plain Python, in a system of units whose unit of length is shorter by this factor."""
    g = SimpleNamespace(**{name: value * metre ** dims[1] for name, (value, dims) in INPUTS.items()})
    names: dict[str, Any] = {unit: metre ** dims[1] for unit, dims in UNITS.items()}
    names |= {"np": np, "g": g, "cross": cross, "hypot": hypot, "sqrt": np.sqrt, "sin": np.sin, "exp": np.exp}
    exec(made.line, names)
    return float(names["y"])


@pytest.mark.parametrize("seeds", [range(start, start + 20) for start in range(0, 120, 20)], ids=str)
def test_a_formula_is_told_if_and_only_if_it_is_wrong(tmp_path: Path, seeds: range) -> None:
    wrong = 0
    for seed in seeds:
        right = Writer(seed)
        assert not told(tmp_path, right).mistakes, right.line
        for planted in Random(seed).sample(range(right.parts), min(3, right.parts)):
            made = Writer(seed, planted)
            numbers = [computed(made, metre) / metre ** made.dims[1] for metre in (1.0, 2.0, 0.4)]
            if np.ptp(numbers) > 1e-9 * abs(numbers[0]):  # not of what has no number
                wrong += 1
                found = told(tmp_path, made)  # a number is noted that is taken in the unit of what it is added to
                assert found.mistakes or found.notes, made.line
    assert wrong > 10
