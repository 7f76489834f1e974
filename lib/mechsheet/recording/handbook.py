"""Handbook formulas with numbers that convert units: of speeds in turns, v = pi*D*n/60, and to kW, P = M*n/1000.

Here all is in SI, a speed in rad/s, whatever it is typed in, and the unit of a line converts what is shown.
"""

from collections.abc import Iterator
from math import isclose, pi, prod
from typing import NamedTuple

from mechsheet import units
from mechsheet.quantities.node import Node
from mechsheet.recording.codes import only
from mechsheet.recording.dimension_rules import Reader
from mechsheet.recording.pinpoint import Mistake
from mechsheet.worksheet import numbers
from mechsheet.worksheet.lines import Formula

_DEEPEST = 12  # operations between a line and a factor of it
_MINUTE = (30, 60, 30e3, 60e3)  # of which 2*pi/60 is made, with mm in m or W in kW too
_OF_PI = (0.5, 1, 2, 4)
_TYPED = {30 / pi: "9.55", 30e3 / pi: "9550"}
_OFF = 1e-4  # how far a rounded one of these is off
_TOGETHER = ("add", "sub", "max", "min")
_SAME = ("neg", "abs", "take", "like")


class _Factor(NamedTuple):
    """One of those that a value is a product of, and whether it stands in the denominator."""

    node: Node
    below: bool
    unit: str  # "" of a number

    @property
    def number(self) -> float:
        return abs(float(self.node.value.item()))


def by_turns(reader: Reader) -> Iterator[Mistake]:
    """The lines that turn a speed in SI into radians a second, or into turns, as if it were in turns a minute."""
    if not any(map(_is_speed, reader.used)):
        return
    for node, lines in reader.declared.items():
        for line in lines:
            if line.mistake or units.kind(line.unit) == units.ANGLE or "erratum" in line.meaning:
                continue
            if not only(reader.codes[node], reader.of_unit(line.unit)):
                continue
            if why := next(filter(None, (_why(reader, term, line) for term in _terms(node, _DEEPEST))), ""):
                yield Mistake(reader.places.line_of(line), line.name, why)
    for name, check in reader.recording.checks.items():
        terms = [term for node in (*check.parts, check.limit) for term in _terms(node, _DEEPEST)]
        if why := next(filter(None, (_why(reader, term, None) for term in terms)), ""):
            yield Mistake(reader.places.of_check(name, [term.line for term in terms]), f"check {name!r}", why)


def to_the_unit(reader: Reader) -> Iterator[Mistake]:
    """The lines that multiply by the number by which their unit does too: it may be meant."""
    for node, lines in reader.declared.items():
        for line in lines:
            factor = units.parse(line.unit).factor if line.unit != units.UNKNOWN else 1.0
            if line.mistake or factor == 1 or units.kind(line.unit) == units.ANGLE or "erratum" in line.meaning:
                continue
            factors = _factors(reader, node, line, False, _DEEPEST) or []
            for x in factors if any(x.unit for x in factors) else ():
                if not x.unit and isclose(x.number * factor, 1 if not x.below else factor**2, rel_tol=1e-9):
                    done = f"{'divided' if x.below else 'multiplied'} by {_short(x.number)}"
                    unit = numbers.in_text(line.unit)
                    yield Mistake(reader.places.line_of(line), line.name, f"{done}, as [{unit}] does once more")


def _is_speed(unit: str) -> bool:
    return bool(unit) and units.kind(unit) == units.ANGLE and units.parse(unit).dims == units.parse("rad/s").dims


def _terms(node: Node, deep: int) -> Iterator[Node]:
    """What a value is the sum or the greatest of."""
    if deep and node.op in _TOGETHER:
        for operand in node.operands:
            yield from _terms(operand, deep - 1)
    else:
        yield node


def _why(reader: Reader, term: Node, line: Formula | None) -> str:
    factors = _factors(reader, term, line, False, _DEEPEST) or []
    speeds = [factor for factor in factors if _is_speed(factor.unit)]
    conversion = _conversion(reader, factors, speeds[0]) if len(speeds) == 1 else ""
    if not conversion:
        return ""
    name = reader.names.get(speeds[0].node, "the speed")
    return f"{name} is in SI already, as an angle in time: {conversion}"


def _conversion(reader: Reader, factors: list[_Factor], speed: _Factor) -> str:
    """What to write instead of the numbers that convert a speed; "" where none do."""
    plain = [factor for factor in factors if not factor.unit]
    with_it = [x.number for x in plain if x.below == speed.below]
    against = [x.number for x in plain if x.below != speed.below]
    for several in (with_it, against):
        for x, typed in _TYPED.items():
            if any(isclose(number, x, rel_tol=_OFF) for number in several):
                return f"write it without {typed}"
    for turns, minutes, are_below in ((with_it, against, speed.below), (against, with_it, not speed.below)):
        of_pi = [x / pi for x in turns if any(isclose(x, k * pi, rel_tol=_OFF) for k in _OF_PI)]
        minute = next((x for x in minutes if x in _MINUTE), 0)
        if of_pi and minute:
            left, circle = of_pi[0] * 30 * (1000 if minute >= 1000 else 1) / minute, _times_pi(of_pi[0])
            if are_below:
                return f"write {_short(1 / left)} for {_short(minute)}/({circle})"
            return f"write {_short(left)} for {circle}/{_short(minute)}"
    if speed.below and len(factors) == 2 and against == [60]:
        return "write 2*pi for 60"
    lengths = [x for x in factors if x.unit and x is not speed]
    if with_it and not speed.below and len(lengths) == 1 and not lengths[0].below:
        is_way = only(reader.codes[lengths[0].node], reader.of_unit("m"))
        whole = prod(with_it) / prod(against or [1]) / pi
        if is_way and any(isclose(whole, k, rel_tol=_OFF) for k in (1, 2)):
            return f"write {_short(whole / 2)} for {_times_pi(whole)}"
    return ""


def _short(x: float) -> str:
    return numbers.amount(x, "-")


def _times_pi(x: float) -> str:
    return "pi" if isclose(x, 1, rel_tol=_OFF) else f"{_short(x)}*pi"


def _factors(reader: Reader, node: Node, line: Formula | None, below: bool, deep: int) -> list[_Factor] | None:
    """All that a value is made of by products, quotients and powers; None where one of them is not known."""
    unit = reader.unit_of_input(node) if node.op == "input" else ""
    if others := [each for each in reader.declared.get(node, ()) if each is not line]:
        unit = others[0].unit
    if unit:
        return None if unit == units.UNKNOWN else [_Factor(node, below, unit)]
    if node.op == "constant":
        return [_Factor(node, below, "")] if not node.args and node.size == 1 else None
    if not deep:
        return None
    if node.op in _SAME:
        return _factors(reader, node.args[0], line, below, deep - 1)
    if node.op in ("mul", "div"):
        first = _factors(reader, node.args[0], line, below, deep - 1)
        second = _factors(reader, node.args[1], line, below ^ (node.op == "div"), deep - 1)
        return None if first is None or second is None else first + second
    if node.op == "pow" and node.args[1].op == "constant" and node.args[1].size == 1:
        return _factors(reader, node.args[0], line, below ^ bool(node.args[1].value.item() < 0), deep - 1)
    return [_Factor(node, below, "-")]
