"""Products and powers of square arrays element by element, as numpy's ``A * B``: formulas tell them from matrices'."""

import ast
from collections.abc import Mapping
from copy import deepcopy
from typing import cast

import numpy as np

from mechsheet.document import names
from mechsheet.document.formula import POWER, SIGN, WHOLE, Binary, Node, Power, Prefix, Text
from mechsheet.document.functions import Reader
from mechsheet.worksheet.shapes import Shape, is_square

_LINEAR = ("linalg.inv", "linalg.matrix_power", "inv", "matrix_power")  # of the same shape as the matrix


def marked(part: ast.expr, shapes: Mapping[str, Shape]) -> ast.expr:
    """An expression in which products, quotients and powers by elements are known where those of matrices exist too.

    ``shapes`` are those of the values that are read, by their names.

    >>> def of(text):
    ...     part = marked(ast.parse(text, mode="eval").body, {"A": (2, 2), "B": (2, 2), "v": (2,), "k": ()})
    ...     return [ast.unparse(node) for node in ast.walk(part) if is_marked(node)]
    >>> of("k * A * B + A @ B"), of("2 * A.T * v"), of("A**2 / (v @ v)"), of("np.multiply(inv(A), B)"), of("v * v / 2")
    (['k * A * B'], ['2 * A.T * v'], ['A ** 2'], ['inv(A) * B'], [])
    >>> of("A @ v * v"), of("k / A / v"), of("A / k"), of("sqrt(A) * v")
    (['A @ v * v'], ['k / A'], [], ['sqrt(A) * v'])
    """
    return cast("ast.expr", _Marking(shapes).visit(deepcopy(part))) if shapes else part


def is_marked(node: ast.AST) -> bool:
    return hasattr(node, "by_elements")


def read(reader: Reader, node: ast.BinOp) -> Node:
    """What is marked, with a sign that tells it from what matrices have; it is of all elements, and no numbers."""
    of = reader.symbols()
    if isinstance(node.op, ast.Pow):
        return Power(of.least(node.left, WHOLE), Prefix(Text("⊙"), of.least(node.right, SIGN)))
    return Binary(
        of.least(node.left, POWER), "⊙" if isinstance(node.op, ast.Mult) else "⊘", of.least(node.right, POWER)
    )


class _Marking(ast.NodeTransformer):
    def __init__(self, shapes: Mapping[str, Shape]) -> None:
        self.shapes = shapes

    def visit(self, node: ast.AST) -> ast.AST:
        node = self.generic_visit(node)
        match names.bare(node) if isinstance(node, ast.Call) and not hasattr(node, "is_own") else node:
            case ast.BinOp(op=ast.Mult() | ast.Div() | ast.Pow()) as product if self.is_by_elements(product):
                product.by_elements = True  # type: ignore[attr-defined]
                return product
        return node

    def is_by_elements(self, node: ast.BinOp) -> bool:
        left, right = self.shape(node.left) or (), self.shape(node.right) or ()
        match node.op:
            case ast.Pow():
                return is_square(left)
            case ast.Div():
                return is_square(right)
        return bool(left and right) and any(map(_is_of_matrices, (node.left, node.right), (left, right)))

    def shape(self, node: ast.expr) -> Shape | None:
        """The shape of the value; None where it is not known."""
        match names.bare(node):
            case ast.Constant():
                return ()
            case ast.Name() | ast.Attribute() as name if (known := self.shapes.get(ast.unparse(name))) is not None:
                return known
            case ast.Attribute(of, "T") | ast.Call(ast.Name("transpose"), [of], []):
                shape = self.shape(of)
                return shape and shape[::-1]
            case ast.UnaryOp(operand=of):
                return self.shape(of)
            case ast.Call(ast.Name(name), [of, *_]) if name in _LINEAR:
                return self.shape(of)
            case ast.BinOp(left, ast.MatMult(), right):
                first, second = self.shape(left), self.shape(right)
                return None if first is None or second is None else first[:-1] + second[1:]
            case ast.BinOp(left, _, right):
                return _broadcast(self.shape(left), self.shape(right))
            case ast.Call(ast.Name(name), args, []) if isinstance(getattr(np, name, None), np.ufunc):
                return _broadcast(*map(self.shape, args))
        return None


def _is_of_matrices(factor: ast.expr, shape: Shape) -> bool:
    return is_square(shape) or (isinstance(factor, ast.BinOp) and isinstance(factor.op, ast.MatMult))


def _broadcast(*shapes: Shape | None) -> Shape | None:
    try:
        return np.broadcast_shapes(*(shape for shape in shapes if shape is not None)) if None not in shapes else None
    except ValueError:  # a name within a comprehension that another quantity has too
        return None
