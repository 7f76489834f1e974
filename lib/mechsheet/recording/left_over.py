"""What rounding leaves of what a worksheet's functions add, for which a line alone tells no terms."""

import ast
from collections.abc import Mapping
from typing import Any

from mechsheet.quantities.graph import NotRecorded
from mechsheet.quantities.quantity import Quantity
from mechsheet.readers.terms import Terms
from mechsheet.recording.record import record
from mechsheet.worksheet import numbers
from mechsheet.worksheet.errors import SheetError
from mechsheet.worksheet.lines import Formula, registry
from mechsheet.worksheet.terms import may_be_rounding


def is_left_over(value: Any, line: Formula, namespace: Mapping[str, Any]) -> bool:
    """Whether the value of a line is none but roundings of what it and all functions behind it add.

    The cells behind it are recorded for that, which takes one or some hundredths of a second; not for a product of
    others of which none may be rounding, such as a compliance.
    """
    if _multiplies(line.expression, namespace, registry(namespace)):
        return False
    try:
        found = record(namespace, every=1, want=[line.name]).values.get(line.name)
    except (SheetError, NotRecorded):
        return False
    return isinstance(found, Quantity) and numbers.is_rounding(value, Terms(found.graph).recorded(found).value)


def _multiplies(part: ast.expr, namespace: Mapping[str, Any], lines: Mapping[str, Formula]) -> bool:
    """Whether an expression multiplies and divides numbers, inputs and lines that are none too small in their units."""
    match part:
        case ast.Constant() | ast.Attribute(ast.Name("g")):
            return True
        case ast.Name(name):
            return name in lines and name in namespace and not may_be_rounding(namespace[name], lines[name].unit)
        case ast.UnaryOp(ast.USub(), operand):
            return _multiplies(operand, namespace, lines)
        case ast.BinOp(left, ast.Mult() | ast.Div() | ast.Pow(), right):
            return _multiplies(left, namespace, lines) and _multiplies(right, namespace, lines)
    return False
