"""A factor of 2 pi that is missing between an angle and cycles in time, which have the same dimensions."""

from collections.abc import Iterable, Iterator
from itertools import combinations
from math import isclose, pi
from typing import NamedTuple

import numpy as np

from mechsheet import units
from mechsheet.quantities.node import Node
from mechsheet.recording.codes import only
from mechsheet.recording.dimension_rules import Reader
from mechsheet.recording.pinpoint import Mistake
from mechsheet.worksheet import numbers
from mechsheet.worksheet.lines import Formula

# Of these the result counts what the first operand that counts does.
_SAME = ("neg", "abs", "add", "sub", "max", "min", "where", "take", "at", "join", "reduce", "round", "floor", "like")
_OF_NUMBERS = ("neg", "abs", "add", "sub", "mul", "div", "max", "min")
_TOGETHER = ("add", "sub", "max", "min", "lt", "le", "gt", "ge")
_TURNS = (2 * pi, 2 * pi * 60, 2 * pi / 60)
_TIME = units.parse("s").dims
_DEEPEST, _NEAR = 8, 3  # operations between a line, or what any operation reads, and what it is a multiple of
_TYPED = 1e-3  # how far a rounded one of these is off: 9.55 for 60/(2*pi)


def turned(reader: Reader) -> Iterator[Mistake]:
    """The lines whose unit counts cycles where the value counts an angle, or the other way round."""
    for node, lines in reader.declared.items():
        for line in lines:
            if not units.kind(line.unit):
                continue
            counted = _Counted(reader, line)
            own = counted.unit(node, _DEEPEST) or counted.of_root(node)
            if own and units.turned(own, line.unit) and "erratum" not in line.meaning:
                angle = units.kind(own) == units.ANGLE
                is_in, by = ("an angle in time", "divided") if angle else ("cycles in time", "multiplied")
                why = f"unit [{line.unit}] does not fit; the value is {is_in}, as in [{own}], until it is {by} by 2*pi"
                yield Mistake(reader.places.line_of(line), line.name, why)
    counted = _Counted(reader)
    for name, check in reader.recording.checks.items():
        nodes = (*check.parts, check.limit)
        if why := _compared([check.unit, *(counted.unit(node, _DEEPEST) for node in nodes)]):
            yield Mistake(reader.places.of_check(name, [node.line for node in nodes]), f"check {name!r}", why)
    if {units.ANGLE, units.CYCLES} <= {*map(units.kind, reader.used)}:
        for node in reader.recording.graph.nodes.values():
            if node.op in _TOGETHER and (why := _compared([counted.unit(x, _NEAR) for x in node.operands])):
                reader.tell(node, why, node.operands)


def _compared(several: Iterable[str]) -> str:
    """Why quantities in these units are not added or compared; "" of those that are."""
    for a, b in combinations(filter(None, several), 2):
        if units.turned(a, b):
            return f"an angle and cycles in time stand together, as in [{a}] and [{b}]: 2*pi is between them"
    return ""


class _Counted(NamedTuple):
    """What the value of a line is a multiple of, by the units that other lines and inputs declare."""

    reader: Reader
    line: Formula | None = None

    def told(self, node: Node) -> str:
        """The unit of an input, of a constant, or of what another line makes; "" of anything else."""
        if node.op in ("input", "constant"):
            unit = self.reader.unit_of_input(node) if node.op == "input" else "".join(node.args)
            return "" if unit == units.UNKNOWN else unit
        lines = (line for line in self.reader.declared.get(node, ()) if line is not self.line and not line.mistake)
        return next((line.unit for line in lines if self.reader.places.lines.get(line.name) == node.line), "")

    def unit(self, node: Node, deep: int) -> str:
        """The unit of what a value is a multiple of, without a factor of pi; "" where there is none."""
        if unit := self.told(node):
            return unit
        of: tuple[Node, ...] = ()
        if deep and node.op in _SAME and not (node.op == "reduce" and node.args[2] not in ("sum", "max", "min")):
            of = node.operands
        elif deep and node.op in ("mul", "div"):
            a, b = node.args
            of = (a,) if self.plain(b, deep) else (b,) if node.op == "mul" and self.plain(a, deep) else ()
        return next(filter(None, (self.unit(operand, deep - 1) for operand in of)), "")

    def of_root(self, node: Node) -> str:
        """The unit of a natural frequency, the root of a stiffness over a mass; "" of anything else, a multiple too."""
        is_rate = only(self.reader.codes[node], self.reader.of_unit("rad/s"))
        return "rad/s" if is_rate and self.is_of_roots(node, _DEEPEST) else ""

    def is_of_roots(self, node: Node, deep: int) -> bool:
        """Whether a value is made of roots of quantities alone."""
        match node.op:
            case "sqrt":
                return self.is_of_quantities(node.args[0], deep)
            case "pow":
                return bool(np.all(np.abs(node.args[1].value) == 0.5)) and self.is_of_quantities(node.args[0], deep)
            case "mul" | "div" if deep:
                factors = [x for x in node.operands if not (x.op == "constant" and self.is_of_quantities(x, deep))]
                return bool(factors) and all(self.is_of_roots(x, deep - 1) for x in factors)
        return False

    def is_of_quantities(self, node: Node, deep: int) -> bool:
        """Whether a value is made of no time, no rate and no number: 4 may be of a string, 8*pi**2 of turns."""
        unit = self.told(node) or next((line.unit for line in self.reader.declared.get(node, ())), "")
        if node.op in ("input", "constant"):
            return not _is_of_time(unit) if unit else bool(np.all(node.value == 1))
        if unit and units.kind(unit) != units.BARE:
            return False
        return deep > 0 and node.op in _OF_NUMBERS and all(self.is_of_quantities(x, deep - 1) for x in node.operands)

    def plain(self, node: Node, deep: int) -> bool:
        """Whether a node is a pure number in which no turn is hidden."""
        if unit := self.told(node):
            return units.parse(unit).dims == units.PURE and units.kind(unit) == units.BARE
        if node.op == "constant":
            return not any(map(_holds_pi, np.abs(node.value).flat))
        if node.op in ("rows", "length"):
            return True
        return deep > 0 and node.op in _OF_NUMBERS and all(self.plain(operand, deep - 1) for operand in node.operands)


def _is_of_time(unit: str) -> bool:
    """Whether a unit is of time alone, or of nothing."""
    return not any(power for power, of_time in zip(units.parse(unit).dims, _TIME, strict=True) if not of_time)


def _holds_pi(x: float) -> bool:
    """Whether a number looks like a short one times or over pi."""
    if not 0 < x < np.inf:
        return False
    short = (
        y for y in (x / pi, x * pi, pi / x, 1 / (x * pi)) if isclose(y, float(numbers.significant(y, 4)), rel_tol=1e-12)
    )
    return any(short) or any(isclose(y, z, rel_tol=_TYPED) for y in (x, 1 / x) for z in _TURNS)
