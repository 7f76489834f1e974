"""Temperatures and their differences, which have the same dimension: [°C] is of a difference, 20 °C are 293.15 K."""

from collections.abc import Iterator

import numpy as np

from mechsheet import units
from mechsheet.quantities.node import Node
from mechsheet.recording.dimension_rules import Reader
from mechsheet.recording.pinpoint import Mistake
from mechsheet.worksheet.lines import Formula
from mechsheet.worksheet.misread import ZERO
from mechsheet.worksheet.misread import temperatures as written

_FIRST = ("abs", "max", "min", "where", "take", "at", "join", "round", "floor", "like")  # of these operands are alike
_DEEPEST = 8  # operations between a line and what it takes


def misread(reader: Reader) -> Iterator[Mistake]:
    """The lines and checks in [°C] whose value is a temperature in K, and those in [K] that show one given in °C."""
    for node, lines in reader.declared.items():
        for line in lines:
            if line.unit in _OTHER and not line.mistake and (why := _why(reader, node, line.unit, line)):
                yield Mistake(reader.places.line_of(line), line.name, why)
    for name, check in reader.recording.checks.items():
        unit = units.plain(check.unit)
        if unit in _OTHER and (why := next(filter(None, (_why(reader, x, unit) for x in check.parts)), "")):
            yield Mistake(reader.places.of_check(name, (check.parts[0].line, check.limit.line)), f"check {name!r}", why)


_OTHER = {"degC": "K", "K": "degC"}


def _why(reader: Reader, node: Node, unit: str, line: Formula | None = None) -> str:
    """Why a value cannot be shown in K or °C; "" where it can, or where nobody knows."""
    taken = _taken(reader, node, _OTHER[unit], line, _DEEPEST)
    if taken is None or not np.isclose(taken, 1):
        return ""
    if unit == "degC":
        return "[°C] is of a difference, and the value is a temperature in [K]: write it in [K], or subtract celsius(0)"
    return "the value is one in [°C], of which [K] shows the number: write it in [°C], or add celsius(0)"


def _taken(reader: Reader, node: Node, unit: str, line: Formula | None, deep: int) -> float | None:
    """How many quantities in a unit are added up in a value, less those that are subtracted; None if not known."""
    if node.op == "input":
        own = reader.unit_of_input(node)
        return 1.0 if own == unit else 0.0 if own in _OTHER and unit == "K" else None
    others = (each for each in reader.declared.get(node, ()) if each is not line)
    if unit == "K" and any(written(each.expression) == 1 for each in others):
        return 1.0

    def of(operand: Node) -> float | None:
        return _taken(reader, operand, unit, line, deep - 1) if deep else None

    match node.op:
        case "constant" if unit == "K" and node.size == 1 and abs(node.value.item()) == ZERO:
            return float(np.sign(node.value.item()))
        case "neg":
            return None if (a := of(node.args[0])) is None else -a
        case "add" | "sub":
            a, b = map(of, node.args)
            if node.op == "add" and unit == "K":  # what is added to a temperature is a difference
                known = a, b
                a, b = (
                    0.0 if n is None and (_is_given(x) or (1.0 in known and x.op != "constant")) else n
                    for x, n in zip(node.args, known, strict=True)
                )
            return None if a is None or b is None else a + b if node.op == "add" else a - b
        case "mul" | "div":
            (a, factor), (b, other) = ((of(x), _plain(x)) for x in node.args)
            if a is not None and other is not None:
                return a * other if node.op == "mul" else a / other
            return b * factor if node.op == "mul" and b is not None and factor is not None else None
        case "reduce" if node.args[2] in ("sum", "max", "min") and (a := of(node.args[0])) is not None:
            return a * node.args[0].size / max(node.size, 1) if node.args[2] == "sum" else a
    return next((x for x in map(of, node.operands) if x is not None), None) if node.op in _FIRST else None


def _is_given(node: Node) -> bool:
    """Whether a quantity is a number that is typed, with a unit or without, and not less than 0."""
    typed = node.op == "constant" or (node.op == "mul" and all(x.op == "constant" for x in node.args))
    return typed and bool(np.all(node.value >= 0))


def _plain(node: Node) -> float | None:
    """The number of a literal or of a length."""
    pure = (node.op == "constant" and not node.args) or node.op == "length"
    return float(node.value.item()) if pure and node.size == 1 and node.value else None
