"""Angles that a line converts from radians to degrees, or back, though its unit does so by itself."""

from collections.abc import Iterator
from math import isclose, pi
from typing import NamedTuple

from mechsheet import units
from mechsheet.quantities.node import Node
from mechsheet.recording.dimension_rules import Reader
from mechsheet.recording.pinpoint import Mistake
from mechsheet.worksheet import numbers
from mechsheet.worksheet.lines import Formula

_DEEPEST = 8  # operations between a line and the angle that it converts
_TYPED = 1e-4  # how far a rounded factor is off: 57.296 for 180/pi
_FACTORS = {pi / 180: ("pi/180", "180/pi"), pi / 30: ("2*pi/60", "60/(2*pi)")}
_OF_ANGLES = ("asin", "acos", "atan2")  # whose values are angles
_TAKING_ANGLES = ("sin", "cos", "tan")
_SAME = ("neg", "abs", "take", "like")


class Source(NamedTuple):
    """An angle, as it is called, the number by which it is multiplied, and what in that converts it, as it is typed."""

    name: str
    factor: float = 1.0
    conversion: str = ""

    def times(self, factor: float) -> "Source":
        """A multiple of it; what converts it back leaves no conversion."""
        whole = self.factor * factor
        kept = "" if _conversion(factor) else self.conversion
        return Source(self.name, whole, _conversion(whole) or kept)


def _conversion(factor: float) -> str:
    """A factor that converts an angle, or a speed, as it is typed; "" of any other."""
    for x, typed in _FACTORS.items():
        for y, text in zip((x, 1 / x), typed, strict=True):
            if isclose(abs(factor), y, rel_tol=_TYPED):
                return text
    return ""


def converted(reader: Reader) -> Iterator[Mistake]:
    """The lines in a unit of angle that convert an angle too, and sines, cosines and tangents of converted ones."""
    for node, lines in reader.declared.items():
        for line in lines:
            if line.mistake or units.kind(line.unit) != units.ANGLE or "erratum" in line.meaning:
                continue
            source = _source(reader, node, line, _DEEPEST)
            if source and source.conversion:
                why = f"{source.name} is in SI already: write it without {source.conversion}"
                converts = f"[{numbers.in_text(line.unit)}] converts it"
                yield Mistake(reader.places.line_of(line), line.name, f"{why}, {converts}")
    for node in reader.codes:
        source = _source(reader, node.args[0], None, _DEEPEST) if node.op in _TAKING_ANGLES and node.line else None
        if source and source.conversion:
            part = reader.places.find(node.line, node.op, [reader.leaf_names(node.args[0])])
            why = f"{source.name} is in SI already: write it without {source.conversion}"
            yield Mistake(part.line, part.text, why)


def _source(reader: Reader, node: Node, line: Formula | None, deep: int) -> Source | None:
    """The angle, or the speed in one, of which a value is a multiple by literals; None where there is none."""
    unit, name = "", reader.names.get(node, "the angle")
    if node.op == "input":
        unit = reader.unit_of_input(node)
    elif others := [each for each in reader.declared.get(node, ()) if each is not line]:
        unit, name = others[0].unit, others[0].name
    if unit:
        return Source(name) if unit != units.UNKNOWN and units.kind(unit) == units.ANGLE else None
    if node.op in _OF_ANGLES:
        return Source("the angle")
    if not deep:
        return None
    if node.op in _SAME:
        return _source(reader, node.args[0], line, deep - 1)
    if node.op in ("mul", "div"):
        a, b = node.args
        if (factor := _literal(b)) and (source := _source(reader, a, line, deep - 1)):
            return source.times(factor if node.op == "mul" else 1 / factor)
        if node.op == "mul" and (factor := _literal(a)) and (source := _source(reader, b, line, deep - 1)):
            return source.times(factor)
    return None


def _literal(node: Node) -> float:
    """A number without a unit; 0 for anything else."""
    return float(node.value.item()) if node.op == "constant" and not node.args and node.size == 1 else 0.0
