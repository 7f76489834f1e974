"""Names in formulas: symbols, the functions of the field, and what numpy, math and scipy have, without their names."""

import ast
import re
from functools import lru_cache

import numpy as np

from mechsheet.document.formula import Apply, Binary, Brackets, Function, Node, Number, Text
from mechsheet.worksheet.symbol import GREEK, INDEXED, Symbol, is_field, read, stem

FUNCTIONS = {
    "asin": "arcsin", "acos": "arccos", "atan": "arctan", "angle": "arg", "log": "ln", "maximum": "max",
    "nanmax": "max", "minimum": "min", "nanmin": "min", "arctan2": "atan2", "log10": "lg",
    "len": "count", "ptp": "range",
}  # fmt: skip
_KNOWN = {"sin", "cos", "tan", "exp", "max", "min", "sum", "log2", "log1p", "expm1", *FUNCTIONS}
_RATES = {"ds": Symbol("s", mark="."), "dds": Symbol("s", mark="..")}  # which the rule for names does not know
_SYMBOL = re.compile(rf"([A-Z]+|d?({'|'.join(GREEK)}))(_|$)")  # VC, eps_BC, dbeta
_MODULES = {"np", "numpy", "math", "cmath", "scipy", "sp"}
_CALLED = {
    "fabs": "abs", "absolute": "abs", "pow": "power", "float_power": "power", "conjugate": "conj", "gamma": "Gamma",
}  # fmt: skip
_UNLIMITED: dict[str, Node] = {"inf": Number(np.inf), "nan": Text("none")}
_CONSTANTS: dict[str, Node] = {"pi": Symbol("π"), "e": Symbol("e"), **_UNLIMITED}
_LINEAR = {"solve", "inv", "det", "norm"}  # which have a notation of their own


def bare(node: ast.expr) -> ast.expr:
    """An expression without the module that a function of it comes from; what algebra is left of is its parts."""
    match node:
        case ast.Call(ast.Attribute(ast.Attribute(_, "linalg"), name)) if name in _LINEAR:
            return node
        case ast.Call(ast.Attribute(of, name), args, keywords) if _is_module(of):
            said = [k for k in keywords if k.arg in ("axis", "x")]
            return bare(ast.Call(ast.Name(_CALLED.get(name, name)), args, said))
        case ast.Call(ast.Name("power"), [x, n], []):
            return ast.BinOp(x, ast.Pow(), n)
        case ast.Call(ast.Name("square"), [x], []):
            return ast.BinOp(x, ast.Pow(), ast.Constant(2))
        case ast.Call(ast.Name("real" | "imag" as part), [x], []):
            return ast.Attribute(x, part)
        case ast.Call(ast.Name("float"), [x], []):
            return bare(x)
    return node


def constant(node: ast.Attribute) -> Node | None:
    """A number that a module has a name for."""
    return _CONSTANTS.get(node.attr) if _is_module(node.value) else None


def _is_module(node: ast.expr) -> bool:
    match node:
        case ast.Name(name):
            return name in _MODULES
        case ast.Attribute(of, name):
            return name.islower() and _is_module(of)
    return False


def place(key: ast.expr) -> Node | None:
    """Elements in words, which Python counts from either end, or by symbols; None where they are told as they are."""
    match key:
        case ast.Slice(None, None, ast.Constant(int(step))):
            return Text(f"every {step}")
        case ast.Slice(None, ast.UnaryOp(ast.USub(), ast.Constant(int(n))), None):
            return Text("all but last" + f" {n}" * (n > 1))
        case ast.Slice(ast.UnaryOp(ast.USub(), ast.Constant(int(n))), None, None):
            return Text("last" + f" {n}" * (n > 1))
        case ast.Slice(ast.Constant(int(start)), ast.Constant(int(stop)), None):
            return Binary(Binary(Number(start), "≤", Symbol("k")), "<", Number(stop))
        case ast.UnaryOp(ast.USub(), ast.Constant(int(n))):
            return Text("last" if n == 1 else f"last but {n - 1}")
        case ast.Constant(str(name)) if _OF_QUANTITY.fullmatch(name):
            return read(stem(name))
    return None


_OF_QUANTITY = re.compile(INDEXED)


@lru_cache(maxsize=4096)
def symbol(name: str) -> Node:
    """Symbol of a name; a field is a function of S, and what is no number has the sign that its value has."""
    if name in _UNLIMITED:
        return _UNLIMITED[name]
    symbol = read(stem(name))
    return Apply(symbol, Brackets((Symbol("S"),))) if is_field(name) else symbol


@lru_cache(maxsize=1024)
def function(name: str) -> Node:
    """A function of the field, one with a symbol of its own, or one in words."""
    if name in _KNOWN:
        return Function(FUNCTIONS.get(name, name))
    if len(name) > 2 and callable(vars(np).get(name)):
        return Function(name)
    word = re.fullmatch(r"[a-z]{3,}(_\w*)?", name) and not re.match(f"d?({'|'.join(GREEK)})", name)
    is_symbol = (
        len(name) == 1 or re.fullmatch("d[a-z]", name) or (not word and (re.search(r"\d", name) or _SYMBOL.match(name)))
    )
    return symbol(name) if is_symbol else Function(name.replace("_", " "))


def whole(name: str) -> Node:
    """A result of several parts: its name in words, or its symbol where it is a capital with an index."""
    return symbol(name) if re.fullmatch(r"[A-Z]\d\w*", name) else Text(name.replace("_", " "))


def part(name: str) -> Node:
    """Part of a result: its symbol, or its name in words."""
    words = re.fullmatch(r"[a-z]{3,}(_[a-z]{3,})*", name) and not re.match("|".join(GREEK), name)
    return _RATES.get(name) or (Function(name.replace("_", " ")) if words else symbol(name))
