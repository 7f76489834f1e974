"""Units that fit by their dimensions and tell another number than is meant: of temperatures, angles and turns."""

import ast

from mechsheet import units


def misread(unit: str, typed: str, expression: ast.expr) -> str:
    """Why a unit behind an expression, here as it is read and as it is typed, cannot be meant; "" where it can.

    Of a temperature none is known but K, for °C is that of a difference; 1450 rpm are not shown as 1450 1/min. Degrees
    that an angle is converted to would be converted again.
    """
    if unit == "degC" and temperatures(expression) == 1:
        return f"unit [{typed}] is of a difference: write a temperature in [K]"
    match expression:
        case ast.Call(ast.Name(name) | ast.Attribute(attr=name), [angle]) if name in _TO_DEGREES:
            if units.kind(unit) == units.ANGLE:
                return f"{ast.unparse(angle)} is in SI already: write it without {name}, [{typed}] converts it"
        case ast.BinOp(_, ast.Mult(), ast.Name(own)) if own in ("rpm", "Hz") and units.turned(own, unit):
            return f"unit [{typed}] is not shown as {own}: write it in [{own}]"
        case ast.BinOp(ast.Constant(), ast.Div(), ast.Name("min" | "h" as own)) if units.turned(f"1/{own}", unit):
            return f"unit [{typed}] is not shown as 1/{own}: write it in [1/{own}], or the number in {typed}"
    return ""


ZERO = 273.15  # 0 °C in K: who adds it to what is in °C has a temperature
_TO_DEGREES = ("degrees", "rad2deg")


def temperatures(expression: ast.expr) -> int:
    """How many temperatures an expression adds, less those that it subtracts: one where it is a temperature itself."""
    match expression:
        case ast.Call(ast.Name("celsius") | ast.Attribute(attr="celsius")):
            return 1
        case ast.Constant(value) if value == ZERO:
            return 1
        case ast.BinOp(left, ast.Add(), right):
            return temperatures(left) + temperatures(right)
        case ast.BinOp(left, ast.Sub(), right):
            return temperatures(left) - temperatures(right)
    return 0
