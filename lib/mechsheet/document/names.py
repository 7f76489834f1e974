"""Names in formulas: symbols, the functions of the field, and what numpy, math and scipy have, without their names."""

import ast
import re
from functools import lru_cache
from inspect import Parameter, signature
from string import ascii_letters

import numpy as np

from mechsheet.document.formula import Apply, Binary, Brackets, Function, Node, Number, Text
from mechsheet.worksheet.lines import Formula, Given
from mechsheet.worksheet.symbol import DIFFERENCE, GREEK, INDEXED, LETTER, LETTERS, Symbol, is_field, read, stem

FUNCTIONS = {
    "asin": "arcsin", "acos": "arccos", "atan": "arctan", "angle": "arg", "log": "ln", "maximum": "max",
    "nanmax": "max", "minimum": "min", "nanmin": "min", "arctan2": "atan2", "log10": "lg",
    "len": "count", "ptp": "range", "amax": "max", "amin": "min",
}  # fmt: skip
_KNOWN = {"sin", "cos", "tan", "exp", "max", "min", "sum", "prod", "log2", "log1p", "expm1", *FUNCTIONS}
_RATES = {"ds": Symbol("s", mark="."), "dds": Symbol("s", mark="..")}  # which the rule for names does not know
_SYMBOL = re.compile(rf"([A-Z]+|d?({'|'.join(GREEK)}|[{LETTERS}]))(_|$)")  # VC, eps_BC, dbeta
_MODULES = {"np", "numpy", "math", "cmath", "scipy", "sp", "statistics"}
_IMPORTED = {"integrate", "interpolate", "linalg", "optimize", "special", "stats"}  # by their own names
_PARTS = {"fft", "polynomial", "random", "signal", *_IMPORTED}
_CALLED = {
    "fabs": "abs", "absolute": "abs", "float_power": "power", "conjugate": "conj", "gamma": "Gamma", "around": "round",
}  # fmt: skip
_UNLIMITED: dict[str, Node] = {"inf": Number(np.inf), "nan": Text("none")}
_CONSTANTS: dict[str, Node] = {"pi": Symbol("π"), "e": Symbol("e"), **_UNLIMITED}
_LINEAR = {"solve", "inv", "norm", "matrix_power"}  # which have a notation of their own
_OPERATORS: dict[str, type[ast.operator]] = {
    "add": ast.Add, "subtract": ast.Sub, "multiply": ast.Mult, "divide": ast.Div, "true_divide": ast.Div,
    "floor_divide": ast.FloorDiv, "mod": ast.Mod, "remainder": ast.Mod, "power": ast.Pow, "matmul": ast.MatMult,
    "logical_and": ast.BitAnd, "logical_or": ast.BitOr,
}  # fmt: skip
_RELATIONS: dict[str, type[ast.cmpop]] = {
    "less": ast.Lt, "less_equal": ast.LtE, "greater": ast.Gt, "greater_equal": ast.GtE, "equal": ast.Eq,
    "not_equal": ast.NotEq,
}  # fmt: skip
_SIGNS: dict[str, type[ast.unaryop]] = {"negative": ast.USub, "positive": ast.UAdd, "logical_not": ast.Not}


def bare(node: ast.expr) -> ast.expr:
    """An expression without the module that a function of it comes from; what algebra is left of is its parts."""
    match node:
        case ast.Call(ast.Attribute(of, name), args, keywords) if is_module(of):
            known = _CALLED.get(name, name)
            if operation := _operation(known, args, keywords):
                return operation
            path = f"linalg.{name}" if name in _LINEAR and ast.unparse(of).endswith("linalg") else known
            return bare(ast.Call(ast.Name(path), *_with_axis(name, args, keywords)))
        case ast.Call(ast.Attribute(x, name), args, keywords) if not is_module(x) and hasattr(np.ndarray, name):
            return bare(ast.Call(ast.Name(_CALLED.get(name, name)), *_with_axis(name, [x, *args], keywords)))
        case ast.Call(ast.Name("power" | "pow"), [x, n], []):
            return ast.BinOp(x, ast.Pow(), n)
        case ast.Call(ast.Name("square"), [x], []):
            return ast.BinOp(x, ast.Pow(), ast.Constant(2))
        case ast.Call(ast.Name("real" | "imag" as part), [x], []):
            return ast.Attribute(x, part)
        case ast.Call(ast.Name("float"), [x], []):
            return bare(x)
    return node


def _operation(name: str, args: list[ast.expr], keywords: list[ast.keyword]) -> ast.expr | None:
    """What a function of numpy does, where Python has a sign for it."""
    match args:
        case _ if keywords or any(isinstance(a, ast.Starred) for a in args):
            return None
        case [x, y] if name in _OPERATORS:
            return ast.BinOp(x, _OPERATORS[name](), y)
        case [x, y] if name in _RELATIONS:
            return ast.Compare(x, [_RELATIONS[name]()], [y])
        case [x] if name in _SIGNS:
            return ast.UnaryOp(_SIGNS[name](), x)
    return None


def _with_axis(
    name: str, args: list[ast.expr], keywords: list[ast.keyword]
) -> tuple[list[ast.expr], list[ast.keyword]]:
    """Arguments of a function of numpy, its axis by that name where it stands among the others."""
    place = _place_of_axis(name)
    if place is None or len(args) <= place or any(isinstance(a, ast.Starred) for a in args):
        return args, keywords
    return [*args[:place], *args[place + 1 :]], [ast.keyword("axis", args[place]), *keywords]


@lru_cache(maxsize=256)
def _place_of_axis(name: str) -> int | None:
    """Where numpy's function of that name has its axis; None where it has none, or as no other argument has."""
    try:
        parameters = signature(getattr(np, name)).parameters
    except (AttributeError, TypeError, ValueError):
        return None
    known = [p for p, told in parameters.items() if told.kind <= Parameter.POSITIONAL_OR_KEYWORD]
    return known.index("axis") if "axis" in known else None


def path_of(node: ast.expr) -> list[str]:
    """Names that lead to a value, without that of a module; none where another expression does."""
    match node:
        case ast.Name(name):
            return [name]
        case ast.Attribute(of, name) if is_module(of):
            return [name]
        case ast.Attribute(of, name) if before := path_of(of):
            return [*before, name]
    return []


def path(node: ast.Attribute) -> str:
    """Full name of a function that a value has, without those of a module and of the inputs; "" where it has none."""
    parts = path_of(node)
    return ".".join(parts[1:] if parts[:1] == ["g"] else parts)


def number(node: ast.expr) -> float | None:
    """The number that an expression is; None for any other."""
    match node:
        case ast.Constant(int() | float() as value) if not isinstance(value, bool):
            return value
        case ast.UnaryOp(ast.USub(), ast.Constant(int() | float() as value)):
            return -value
    return None


def is_fixed(node: ast.expr) -> bool:
    """Whether an expression is a number, or some of them."""
    return all(number(part) is not None for part in getattr(node, "elts", [node]))


_OF_ALL = {
    "all", "any", "amax", "amin", "argmax", "argmin", "argsort", "average", "cond", "concatenate", "convolve",
    "corrcoef", "count_nonzero", "cov", "cumprod", "cumsum", "cumulative_simpson", "cumulative_trapezoid", "det",
    "diag", "diff", "eig", "eigh", "eigvals", "eigvalsh", "einsum", "fft", "flip", "fsum", "gradient", "histogram",
    "hstack", "ifft", "inner", "inv", "irfft", "kron", "len", "linalg.inv", "linalg.matrix_power", "linalg.norm",
    "linalg.solve", "lstsq", "matrix_rank", "mean", "median", "nanargmax", "nanargmin", "nanmax", "nanmean",
    "nanmedian", "nanmin", "nanpercentile", "nanquantile", "nanstd", "nansum", "nanvar", "norm", "outer",
    "percentile", "pinv", "polyfit", "polyval", "prod", "ptp", "pvariance", "quantile", "rfft", "roll", "roots",
    "searchsorted", "simpson", "sort", "sorted", "stack", "std", "stdev", "sum", "svd", "tensordot", "trace",
    "transpose", "trapezoid", "unique", "var", "variance", "vdot", "vstack",
}  # fmt: skip


def is_of_all(name: str, count: int) -> bool:
    """Whether a function of so many arguments takes all elements of an array at once, not one after the other."""
    return name in _OF_ALL or (name in ("max", "min") and count == 1)


def constant(node: ast.Attribute) -> Node | None:
    """A number that a module has a name for."""
    return _CONSTANTS.get(node.attr) if is_module(node.value) else None


def is_module(node: ast.expr) -> bool:
    """Whether an expression is a module of functions."""
    match node:
        case ast.Name(name):
            return name in _MODULES or name in _IMPORTED
        case ast.Attribute(of, name):
            return name in _PARTS and is_module(of)
    return False


def counter(key: ast.expr) -> Symbol:
    """The letter that counts elements: one that their ends do not read."""
    read_there = {getattr(node, "id", getattr(node, "attr", "")) for node in ast.walk(key)}
    return Symbol(next(letter for letter in f"kijnmpq{ascii_letters}" if letter not in read_there))


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
        return Function(name.replace("_", " "))
    word = re.fullmatch(r"[a-z]{3,}(\d[a-z]+)?(_\w*)?|[A-Z][a-z]{3,}\w*[A-Z]\w*", name) and not re.match(
        f"{LETTER}|{DIFFERENCE}", name
    )
    is_symbol = re.fullmatch(r"[^\W\d_](_\w+)?|d[a-z]", name) or (
        not word and (re.search(r"\d", name) or _SYMBOL.match(name))
    )
    return symbol(name) if is_symbol else Function(name.replace("_", " "))


def whole(name: str) -> Node:
    """A result of several parts: its name in words, or its symbol where it is a capital with an index."""
    return symbol(name) if re.fullmatch(r"[A-Z]\d\w*", name) else Text(name.replace("_", " "))


def part(name: str) -> Node:
    """Part of a result: its symbol, or its name in words."""
    words = re.fullmatch(r"[a-z]{3,}(_[a-z]{3,})*", name) and not re.match(LETTER, name)
    return _RATES.get(name) or (Function(name.replace("_", " ")) if words else symbol(name))


@lru_cache(maxsize=4096)
def fields_by_name(line: Formula | Given) -> tuple[str, ...]:
    """Names of a line that say "over S" (`is_field`)."""
    parts = [line.expression, *((line.target,) if isinstance(line, Given) else (v for _, v in line.where))]
    read = {node.id for part in parts for node in ast.walk(part) if isinstance(node, ast.Name)}
    own = set() if isinstance(line, Given) else {line.name}
    return tuple(name for name in sorted(read | own) if is_field(name))
