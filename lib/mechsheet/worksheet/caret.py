"""A power as other programs write it: of whole numbers Python takes ``2^3`` for an exclusive or, and gives 1."""

import ast
from functools import lru_cache

from mechsheet.worksheet import source


@lru_cache(maxsize=4096)
def caret(statement: ast.stmt) -> tuple[int, str]:
    """Line of a power by ``^`` in a statement, and what is told of it; no line where there is none.

    Between what is seen to be a truth value, or a set, it is what Python takes it for; of names nobody sees that.

    >>> caret(ast.parse("F = 2 * 10^3").body[0]), caret(ast.parse("b = (x > 2) ^ (y < 3)").body[0])
    ((1, '2 * 10 ^ 3: a power is written **, not ^'), (0, ''))
    >>> caret(ast.parse("F = g.n^g.k").body[0])
    (1, 'g.n ^ g.k: a power is written **, not ^; that one of two conditions holds alone, a != b')
    """
    nodes = source.nodes(statement)
    if ast.BitXor not in map(type, nodes):  # as nearly everywhere
        return 0, ""
    for node in nodes:
        if isinstance(node, ast.BinOp) and isinstance(node.op, ast.BitXor):
            told = f"{ast.unparse(node)}: a power is written **, not ^"
            if _is_of_numbers(node):
                return node.lineno, told
            if not (_is_truth(node.left) or _is_truth(node.right)):
                return node.lineno, f"{told}; that one of two conditions holds alone, a != b"
    return 0, ""


def _is_truth(node: ast.expr) -> bool:
    """Whether an operand is seen to be a truth value, or a set."""
    match node:
        case ast.Compare() | ast.UnaryOp(ast.Not(), _) | ast.Constant(bool()) | ast.Set() | ast.SetComp():
            return True
        case ast.BoolOp(_, values):
            return all(map(_is_truth, values))
        case ast.BinOp(left, ast.BitAnd() | ast.BitOr() | ast.BitXor(), right):
            return _is_truth(left) or _is_truth(right)
        case ast.UnaryOp(ast.Invert(), operand):
            return _is_truth(operand)
        case ast.Call(ast.Name(name) | ast.Attribute(_, name)):
            return name in _TRUTHS or name.startswith(("is", "logical_"))
    return False


_TRUTHS = {"all", "any", "bool", "set", "frozenset"}


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
