"""Products and powers of square arrays element by element, and those of vectors: formulas tell them from matrices'."""

import ast
from collections.abc import Mapping
from copy import deepcopy
from typing import cast

import numpy as np

from mechsheet.document import names
from mechsheet.document.formula import POWER, SIGN, WHOLE, Binary, Brackets, Node, Power, Prefix, Text
from mechsheet.document.functions import Reader
from mechsheet.worksheet.shapes import Shape, is_square

_ALIKE = ("linalg.inv", "linalg.matrix_power", "inv", "matrix_power", "copy", "round")  # of the shape of the first
_NUMBERS = ("det", "linalg.det", "trace", "len", "float", "int")
_REDUCED = ("sum", "max", "min", "mean", "prod", "norm", "linalg.norm")  # numbers where no axis is told


def marked(part: ast.expr, shapes: Mapping[str, Shape]) -> ast.expr:
    """An expression in which products, quotients and powers by elements are known where those of matrices exist too.

    The product of two vectors becomes a call of ``dot``.

    ``shapes`` are those of the values that are read, by their names.

    >>> def of(text):
    ...     part = marked(ast.parse(text, mode="eval").body, {"A": (2, 2), "B": (2, 2), "v": (2,), "k": ()})
    ...     return [ast.unparse(node) for node in ast.walk(part) if is_marked(node)]
    >>> of("k * A * B + A @ B"), of("2 * A.T * v"), of("A**2 / (v @ v)"), of("np.multiply(inv(A), B)"), of("v * v / 2")
    (['k * A * B'], ['2 * A.T * v'], ['A ** 2'], ['inv(A) * B'], [])
    >>> of("A @ v * v"), of("k / A / v"), of("A / k"), of("sqrt(A) * v"), of("[A**2 for A in v]")
    (['A @ v * v'], ['k / A'], [], ['sqrt(A) * v'], [])
    >>> of("det(A) * A * v[0]"), of("A * eye(2)"), of("A * v[:, None]"), of("A[0] * v"), of("[[k, 1], [2, k]] * A")
    ([], ['A * eye(2)'], ['A * v[:, None]'], [], ['[[k, 1], [2, k]] * A'])
    >>> shapes = {"A": (2, 3), "u": (2,), "v": (3,)}
    >>> [ast.unparse(marked(ast.parse(text, mode="eval").body, shapes)) for text in ("v @ v / 2", "u @ A @ v", "A @ v")]
    ['dot(v, v) / 2', 'dot(u @ A, v)', 'A @ v']
    """
    return cast("ast.expr", _Marking(shapes).visit(deepcopy(part))) if shapes else part


def is_marked(node: ast.AST) -> bool:
    return hasattr(node, "by_elements")


def read(reader: Reader, node: ast.BinOp) -> Node:
    """What is marked, with a sign that tells it from what matrices have; it is of all elements, and no numbers."""
    of = reader.symbols()
    if isinstance(node.op, ast.Pow):
        return Power(_closed(of.least(node.left, WHOLE)), Prefix(Text("⊙"), of.least(node.right, SIGN)))
    sign = "⊙" if isinstance(node.op, ast.Mult) else "⊘"
    return Binary(_closed(of.least(node.left, POWER)), sign, _closed(of.least(node.right, POWER)))


def _closed(part: Node) -> Node:
    """A part with brackets round a function and its angle, which would take in the sign behind it."""
    return Brackets((part,)) if isinstance(part, Prefix) else part


class _Marking(ast.NodeTransformer):
    def __init__(self, shapes: Mapping[str, Shape]) -> None:
        self.shapes = shapes

    def visit_GeneratorExp(self, node: ast.GeneratorExp | ast.ListComp) -> ast.AST:
        """A name of its own is no array that is called so."""
        own = {n.id for part in node.generators for n in ast.walk(part.target) if isinstance(n, ast.Name)}
        return _Marking({name: of for name, of in self.shapes.items() if name not in own}).generic_visit(node)

    visit_ListComp = visit_GeneratorExp

    def visit(self, node: ast.AST) -> ast.AST:
        node = super().visit(node)
        match names.bare(node) if isinstance(node, ast.Call) and not hasattr(node, "is_own") else node:
            case ast.BinOp(op=ast.Mult() | ast.Div() | ast.Pow()) as product if self.is_by_elements(product):
                product.by_elements = True  # type: ignore[attr-defined]
                return product
            case ast.BinOp(a, ast.MatMult(), b) if len(self.shape(a) or ()) == len(self.shape(b) or ()) == 1:
                return ast.Call(ast.Name("dot", ast.Load()), [a, b], [])  # a number, written with a dot
        return node

    def is_by_elements(self, node: ast.BinOp) -> bool:
        left, right = self.shape(node.left) or (), self.shape(node.right) or ()
        match node.op:
            case ast.Pow():
                return is_square(left) or is_square(right)
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
            case ast.UnaryOp(operand=of) | ast.Attribute(of, "real" | "imag"):
                return self.shape(of)
            case ast.Call(ast.Name(name), [of, *_]) if name in _ALIKE:
                return self.shape(of)
            case ast.Call(ast.Name(name), args) if name in _NUMBERS or (name in _REDUCED and len(args) == 1):
                return ()
            case ast.Call(ast.Name("solve" | "linalg.solve"), [_, of], []):
                return self.shape(of)
            case ast.Call(ast.Name("eye" | "identity"), [ast.Constant(int(n))], []):
                return (n, n)
            case ast.Call(ast.Name("diag"), [of], []):
                shape = self.shape(of)
                return shape and (shape[:1] if len(shape) > 1 else 2 * shape)
            case ast.Call(ast.Name("outer"), [first, second], []):
                return (self.shape(first) or ()) + (self.shape(second) or ())
            case ast.Call(ast.Name("array"), [of], []):
                return self.shape(of)
            case ast.List([first, *_] as elements):
                shape = self.shape(first)
                return None if shape is None else (len(elements), *shape)
            case ast.Subscript(of, key):
                return _taken(self.shape(of), key)
            case ast.IfExp(_, first, second) | ast.Call(ast.Name("where"), [_, first, second], []):
                return _broadcast(self.shape(first), self.shape(second))
            case ast.Compare(first, _, [second]):
                return _broadcast(self.shape(first), self.shape(second))
            case ast.BinOp(left, ast.MatMult(), right):
                rows, columns = self.shape(left), self.shape(right)
                return None if rows is None or columns is None else rows[:-1] + columns[1:]
            case ast.BinOp(left, _, right):
                return _broadcast(self.shape(left), self.shape(right))
            case ast.Call(ast.Name(name), args, []) if isinstance(getattr(np, name, None), np.ufunc):
                return _broadcast(*map(self.shape, args))
        return None


def _taken(shape: Shape | None, key: ast.expr) -> Shape | None:
    """The shape of what an index of numbers takes."""
    if shape is None:
        return None
    part = ast.Subscript(ast.Name("the whole", ast.Load()), key, ast.Load())
    code = compile(ast.fix_missing_locations(ast.Expression(part)), "", "eval")
    try:
        taken: Shape = eval(code, {"__builtins__": {}, "the whole": np.broadcast_to(0.0, shape)}).shape
        return taken
    except (NameError, AttributeError, IndexError, TypeError):  # by names, or of another array of that name
        return None


def _is_of_matrices(factor: ast.expr, shape: Shape) -> bool:
    return is_square(shape) or (isinstance(factor, ast.BinOp) and isinstance(factor.op, ast.MatMult))


def _broadcast(*shapes: Shape | None) -> Shape | None:
    try:
        return np.broadcast_shapes(*(shape for shape in shapes if shape is not None)) if None not in shapes else None
    except ValueError:  # a name within a comprehension that another quantity has too
        return None
