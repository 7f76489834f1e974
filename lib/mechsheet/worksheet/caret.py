"""A power as other programs write it: of whole numbers Python takes ``2^3`` for an exclusive or, and gives 1."""

import ast
from functools import lru_cache

from mechsheet.worksheet import source


@lru_cache(maxsize=4096)
def caret(statement: ast.stmt) -> tuple[int, str]:
    """Line of a power by ``^`` in a statement, and what is told of it; no line where there is none.

    Between truth values it is what Python takes it for.

    >>> caret(ast.parse("F = 2 * 10^3").body[0]), caret(ast.parse("b = (x > 2) ^ (y < 3)").body[0])
    ((1, '2 * 10 ^ 3: a power is written **, not ^'), (0, ''))
    """
    for node in source.nodes(statement):
        if isinstance(node, ast.BinOp) and isinstance(node.op, ast.BitXor) and _is_of_numbers(node):
            return node.lineno, f"{ast.unparse(node)}: a power is written **, not ^"
    return 0, ""


def _is_of_numbers(node: ast.expr) -> bool:
    """Whether a number is one of the operands, or of theirs."""
    match node:
        case ast.Constant(value):
            return isinstance(value, int | float | complex) and not isinstance(value, bool)
        case ast.BinOp(left, _, right):
            return _is_of_numbers(left) or _is_of_numbers(right)
        case ast.UnaryOp(_, operand):
            return _is_of_numbers(operand)
    return False
