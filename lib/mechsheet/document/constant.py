"""Units in an expression of Python, as their constants stand there: a number and what it measures are one part."""

import ast
from collections.abc import Iterator
from functools import lru_cache
from typing import Any

from mechsheet import units
from mechsheet.document.formula import Measure, Text

Part = tuple[type[ast.operator], ast.expr]  # a factor, and whether it is multiplied or divided by


@lru_cache(maxsize=4096)
def measured(expression: ast.expr, constants: tuple[tuple[str, str], ...]) -> ast.expr:
    """The expression with a `Measure` for each number with its unit, such as ``9.81*m/s**2``, as a constant.

    ``constants`` are the names of units as they are written, with the units; a unit alone stands as text.
    """
    if not constants:
        return expression
    new: ast.expr = _Measuring(dict(constants)).visit(ast.parse(ast.unparse(expression), mode="eval").body)
    return new


class _Measuring(ast.NodeTransformer):
    def __init__(self, known: dict[str, str]) -> None:
        self.known = known

    def visit(self, node: ast.AST) -> Any:
        if isinstance(node, ast.expr) and (unit := self.unit(node)):
            return ast.Constant(Text(units.shown(unit)))  # type: ignore[arg-type]  # of the formula, not of Python
        return super().visit(node)

    def visit_BinOp(self, node: ast.BinOp) -> ast.expr:
        if not isinstance(node.op, ast.Mult | ast.Div):
            return ast.BinOp(self.visit(node.left), node.op, self.visit(node.right))
        parts = list(self.joined(list(_chain(node))))
        whole = parts[0][1]
        for op, part in parts[1:]:
            whole = ast.BinOp(whole, op(), part)
        return whole

    def joined(self, parts: list[Part]) -> Iterator[Part]:
        """Factors, each number together with the units behind it."""
        while parts:
            op, part = parts.pop(0)
            number, unit = _number(part), ""
            while number is not None and op is ast.Mult and parts and (name := self.closed(parts[0][1])):
                sign = "*" if parts.pop(0)[0] is ast.Mult else "/"
                unit = f"{unit or '1' * (sign == '/')}{sign}{name}".removeprefix("*")
            yield op, ast.Constant(Measure(number, unit, True)) if number is not None and unit else self.visit(part)  # type: ignore[arg-type]  # see above

    def unit(self, node: ast.expr) -> str:
        """The unit that an expression is; "" where it has anything else in it."""
        match node:
            case ast.Name() | ast.Attribute():
                return self.known.get(ast.unparse(node), "")
            case ast.BinOp(base, ast.Pow(), power) if (unit := self.unit(base)) and (raised := _power(power)):
                return f"{unit}**{raised}" if isinstance(base, ast.Name | ast.Attribute) else ""
            case ast.BinOp(left, ast.Mult() | ast.Div() as op, right):
                first, second = self.unit(left), self.closed(right)
                return f"{first}{'*' if isinstance(op, ast.Mult) else '/'}{second}" if first and second else ""
        return ""

    def closed(self, node: ast.expr) -> str:
        """The unit, in brackets where it is a product."""
        unit = self.unit(node)
        return f"({unit})" if unit and isinstance(node, ast.BinOp) and not isinstance(node.op, ast.Pow) else unit


def _chain(node: ast.expr) -> Iterator[Part]:
    """Factors of products and quotients that stand one after the other."""
    match node:
        case ast.BinOp(left, ast.Mult() | ast.Div() as op, right):
            yield from _chain(left)
            yield type(op), right
        case _:
            yield ast.Mult, node


def _power(node: ast.expr) -> str:
    """A power of a unit, such as ``2``, ``0.5`` or ``(1/2)``; "" of anything else."""
    match node:
        case ast.Constant(int() | float()):
            return ast.unparse(node)
        case ast.BinOp(ast.Constant(int()), ast.Div(), ast.Constant(int())):
            return f"({ast.unparse(node)})"
    return ""


def _number(node: ast.expr) -> float | None:
    match node:
        case ast.Constant(int() | float() as number) if not isinstance(number, bool):
            return number
        case ast.UnaryOp(ast.USub(), ast.Constant(int() | float() as number)):
            return -number
    return None
