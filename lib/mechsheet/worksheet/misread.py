"""Units that fit by their dimensions and tell another number than is meant: of temperatures, and of turns."""

import ast

from mechsheet import units


def misread(unit: str, typed: str, expression: ast.expr) -> str:
    """Why a unit behind an expression, here as it is read and as it is typed, cannot be meant; "" where it can.

    Of a temperature none is known but K, for °C is that of a difference; 1450 rpm are not shown as 1450 1/min.
    """
    if unit == "degC" and _temperatures(expression) == 1:
        return f"unit [{typed}] is of a difference: write a temperature in [K]"
    match expression:
        case ast.BinOp(_, ast.Mult(), ast.Name(own)) if own in ("rpm", "Hz") and units.turned(own, unit):
            return f"unit [{typed}] is not shown as {own}: write it in [{own}]"
    return ""


def _temperatures(expression: ast.expr) -> int:
    """How many temperatures an expression adds, less those that it subtracts: one where it is a temperature itself."""
    match expression:
        case ast.Call(ast.Name("celsius") | ast.Attribute(attr="celsius")):
            return 1
        case ast.BinOp(left, ast.Add(), right):
            return _temperatures(left) + _temperatures(right)
        case ast.BinOp(left, ast.Sub(), right):
            return _temperatures(left) - _temperatures(right)
    return 0
