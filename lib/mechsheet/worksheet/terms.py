"""How large the terms are that a line adds: of a sum that should be nothing, rounding leaves a part of them."""

import ast
from collections.abc import Mapping
from functools import lru_cache
from typing import Any

import numpy as np

from mechsheet import units
from mechsheet.worksheet import numbers

_AS_LARGE = ("abs", "conj", "real", "imag")
_SMALL = 1e-2  # more is no rounding of what a line may add, up to 3e12 in SI; to look at that takes time
_LEAST = 1e-6  # in the unit of a line: what rounding leaves of 1e8 is less


def is_rounding(value: Any, expression: ast.expr, namespace: Mapping[str, Any]) -> bool:
    """Whether the value of an expression is nothing but the rounding of what it adds."""
    field = np.asarray(value)
    if field.dtype.kind not in "fc" or not 0 < np.abs(field).max(initial=0.0) < _SMALL:
        return False
    return numbers.is_rounding(field, terms(expression, namespace))


def may_be_rounding(value: Any, unit: str) -> bool:
    """Whether numbers are so small in the unit of their line, where nobody wants such, that they may be rounding."""
    field = np.asarray(value)
    return field.dtype.kind in "fc" and 0 < np.abs(field).max(initial=0.0) < _LEAST * units.parse(unit).factor


def terms(expression: ast.expr, namespace: Mapping[str, Any]) -> Any:
    """Magnitudes of the largest term of an expression, element by element; 0 where it adds none, or none that is known.

    Names stand for their values in the namespace, numbers or what computes as they do; what a function of the
    worksheet's own adds is not known.
    """
    if not _adds(expression):
        return np.zeros(())
    try:
        with np.errstate(all="ignore"):
            found = _largest(expression, namespace)
    except ValueError:  # of a product that is no element's by an element
        return np.zeros(())
    return np.where(np.isfinite(found), found, 0.0)


@lru_cache(maxsize=4096)
def _adds(expression: ast.expr) -> bool:
    """Whether an expression is a sum, or a product with one in it, or the integral of one."""
    match expression:
        case ast.BinOp(_, ast.Add() | ast.Sub()) | ast.Call(ast.Name("cross" | "dot")):
            return True
        case ast.BinOp(left, ast.Mult() | ast.Div(), right):
            return _adds(left) or _adds(right)
        case ast.UnaryOp(operand=of) | ast.Attribute(of, "real" | "imag"):
            return _adds(of)
        case ast.Call(ast.Name(name), [of]) if name in _AS_LARGE:
            return _adds(of)
        case ast.Call(ast.Name("trapezoid"), [of, ast.Name()]):
            return _adds(of)
    return False


def _largest(node: ast.expr, namespace: Mapping[str, Any]) -> Any:
    match node:
        case ast.BinOp(left, ast.Add() | ast.Sub(), right):
            return np.maximum(_largest(left, namespace), _largest(right, namespace))
        case ast.BinOp(left, ast.Mult(), right) | ast.Call(ast.Name("cross" | "dot"), [left, right]):
            return _largest(left, namespace) * _largest(right, namespace)
        case ast.BinOp(left, ast.Div(), right):
            return _largest(left, namespace) / _size(right, namespace)
        case ast.UnaryOp(operand=of) | ast.Attribute(of, "real" | "imag"):
            return _largest(of, namespace)
        case ast.Call(ast.Name(name), [of]) if name in _AS_LARGE:
            return _largest(of, namespace)
        case ast.Call(ast.Name("trapezoid"), [of, ast.Name(over)]):
            return np.abs(np.trapezoid(_largest(of, namespace), namespace[over]))
        case ast.Call(ast.Name("sin" | "cos"), _):
            return np.ones(())
    return _size(node, namespace)


def _size(node: ast.expr, namespace: Mapping[str, Any]) -> Any:
    """Magnitude of a number or of a name, ``g.L3`` too; 0 of what it would take to compute anew."""
    value: Any = None
    match node:
        case ast.Constant(number):
            value = number
        case ast.Name(name):
            value = namespace.get(name)
        case ast.Attribute(ast.Name(of), name):
            value = getattr(namespace.get(of), name, None)
    field = value if hasattr(value, "dtype") else np.asarray(value)
    return np.abs(field) if field.dtype.kind in "iufc" else np.zeros(())
