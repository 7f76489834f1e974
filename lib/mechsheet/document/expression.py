"""Expressions of Python read as formulas: what a line computes, in the notation of the field."""

import ast
import re
from collections.abc import Callable, Mapping
from functools import lru_cache
from typing import Any

from mechsheet.document import names
from mechsheet.document.constant import measured
from mechsheet.document.formula import (
    POWER,
    PRODUCT,
    RELATION,
    SIGN,
    SUM,
    WHOLE,
    Apply,
    Binary,
    Brackets,
    Cases,
    Code,
    Element,
    Fraction,
    Function,
    Integral,
    Matrix,
    Measure,
    Node,
    Number,
    Overline,
    Power,
    Prefix,
    Product,
    Range,
    Root,
    Row,
    Signed,
    Sum,
    Text,
    begins_as_number,
    begins_negative,
    strength,
)
from mechsheet.worksheet.lines import Formula, Given
from mechsheet.worksheet.symbol import Symbol, is_field, read


@lru_cache(maxsize=4096)
def left(line: Formula, single: frozenset[str] = frozenset()) -> Node:
    """Left side of a line: its symbol, of a function with its arguments; ``single`` are no fields."""
    symbol = read(line.name) if line.name in single else names.symbol(line.name)
    return Apply(symbol, Brackets(tuple(map(names.symbol, line.arguments)), close=True)) if line.arguments else symbol


@lru_cache(maxsize=4096)
def right(line: Formula, single: frozenset[str] = frozenset()) -> Node | None:
    """Right side of a line; None where it is a number or says the same as the left."""
    node = None
    if not isinstance(line.expression, ast.Constant):
        node = tree(measured(line.expression, line.constants), single=single)
    if isinstance(node, Measure) and node.unit == line.unit:
        return None
    return None if node == left(line, single) else node


_SOLVED = {"_found": "Find", "_least": "Minerr"}  # endings of the names of verdicts


def equation(line: Formula | Given, single: frozenset[str] = frozenset()) -> Node:
    """A line as an equation, or its symbol alone; of a solve block what must be equal."""
    if isinstance(line, Given):
        parts = (tree(measured(part, line.constants), single=single) for part in (line.expression, line.target))
        return Row((Text("Given" if line.first else "and"), Binary(next(parts), "=", next(parts))))
    node = right(line, single)
    if node is None:
        return left(line, single)
    own = (tree(measured(value, line.constants), single=single) for _, value in line.where)
    where = tuple(Binary(names.symbol(name), "=", value) for (name, _), value in zip(line.where, own, strict=True))
    whole = Binary(left(line, single), "=", node)
    return Row((whole, Text("where"), *where)) if where else whole


def substituted(line: Formula, numbers: Mapping[str, Measure]) -> Node | None:
    """Right side of a line with numbers for its symbols; None where it has none."""
    return tree(measured(line.expression, line.constants), numbers) if numbers and right(line) else None


@lru_cache(maxsize=4096)
def reads(line: Formula) -> tuple[str, ...]:
    """Names that the right side of a line reads, as they are written: ``g.L3`` too."""
    return tuple(dict.fromkeys(filter(None, map(_read_as, ast.walk(line.expression)))))


@lru_cache(maxsize=4096)
def fields_by_name(line: Formula | Given) -> tuple[str, ...]:
    """Names of a line that say "over S" (`is_field`)."""
    parts = [line.expression, *((line.target,) if isinstance(line, Given) else (v for _, v in line.where))]
    read = {node.id for part in parts for node in ast.walk(part) if isinstance(node, ast.Name)}
    own = set() if isinstance(line, Given) else {line.name}
    return tuple(name for name in sorted(read | own) if is_field(name))


def tree(node: ast.expr, numbers: Mapping[str, Measure] | None = None, single: frozenset[str] = frozenset()) -> Node:
    """Expression as a tree: fractions, roots, powers, no brackets that the reader does not need.

    ``numbers`` stand for some names, ``g.L3`` too; those in ``single`` are no fields over S, though they end so.
    """
    return _Reader(numbers or {}, single).read(node)


_ANGULAR = ("sin", "cos", "tan")
_COMPARISONS = {ast.Lt: "<", ast.LtE: "≤", ast.Gt: ">", ast.GtE: "≥", ast.Eq: "=", ast.NotEq: "≠"}
_OVER = ("max", "min", "sum", "amax", "amin", "nanmax", "nanmin")  # with an axis


class _Reader:
    """Reads expressions of Python."""

    def __init__(self, numbers: Mapping[str, Measure], single: frozenset[str]) -> None:
        self.numbers, self.single = numbers, single

    def read(self, node: ast.expr) -> Node:
        node = names.bare(node)
        kind = type(node)
        if self.numbers and kind in (ast.Name, ast.Attribute) and (number := self.numbers.get(_read_as(node))):
            return number
        rule = _RULES.get(kind)
        return (rule(self, node) if rule else None) or Code(ast.unparse(node))

    def least(self, node: ast.expr, least: int) -> Node:
        """The expression, in brackets where it holds together less than its place asks for."""
        part = self.read(node)
        return part if strength(part) >= least else Brackets((part,))

    def name(self, node: ast.Name) -> Node:
        return read(node.id) if node.id in self.single else names.symbol(node.id)

    def constant(self, node: ast.Constant) -> Node:
        match node.value:
            case complex(imag=1):
                return Symbol("i")
            case complex(imag=size):
                return Product(Number(size), Symbol("i"))
            case int() | float():
                return Number(node.value)
            case Measure() | Text():
                return node.value
        return Text(str(node.value))

    def attribute(self, node: ast.Attribute) -> Node | None:
        if number := names.constant(node):
            return number
        match node:
            case ast.Attribute(ast.Name("g"), name):
                return read(name)
            case ast.Attribute(ast.Attribute(ast.Name("g"), name), part):  # a property or a column of an input
                return names.symbol(f"{part}_{name}")
            case ast.Attribute(inner, ("real" | "imag") as part):
                return Prefix(Function("Re" if part == "real" else "Im"), self.least(inner, WHOLE), PRODUCT)
            case ast.Attribute(ast.Name(name), "value") if name.endswith("_found"):
                return Apply(Function("Find"), Brackets((names.symbol(name.removesuffix("_found")),)))
            case ast.Attribute(ast.Attribute(ast.Name(name), "value"), unknown):  # one of several
                ending = next((end for end in _SOLVED if name.endswith(end)), None)
                return Apply(Function(_SOLVED[ending]), Brackets((names.symbol(unknown),))) if ending else None
            case ast.Attribute(ast.Name(name), "value"):  # of a slider or field of the page
                return names.symbol(name)
            case ast.Attribute(ast.Name(name), "T") if re.fullmatch(r"[A-Z](_\w+)?", name):  # a matrix
                return Power(names.symbol(name), Function("T"))
            case ast.Attribute(ast.Name(name), part):  # a result of several parts
                return Apply(names.part(part), Brackets((names.whole(name),)))
            case ast.Attribute(ast.Call() as inner, part):
                return Apply(names.part(part), Brackets((self.read(inner),), "[]", high=True))
        return None

    def unary(self, node: ast.UnaryOp) -> Node | None:
        match node.op:
            case ast.USub():
                return Signed("-", self.least(node.operand, SIGN))
            case ast.UAdd():
                return Signed("+", self.least(node.operand, SIGN))
            case ast.Not() | ast.Invert():
                return Prefix(Text("not "), self.least(node.operand, PRODUCT), RELATION)
        return None

    def binary(self, node: ast.BinOp) -> Node | None:
        left, right = node.left, node.right
        match node.op:
            case ast.Mult() | ast.Div() if positive := _without_minus(node):
                return Signed("-", self.read(positive))
            case ast.Div():
                return Fraction(self.read(left), self.read(right))
            case ast.FloorDiv():
                return Brackets((Fraction(self.read(left), self.read(right)),), "⌊⌋")
            case ast.Pow():
                return self.power(left, right)
            case ast.Mult():
                return self.product(left, right)
            case ast.Mod():
                return Binary(self.least(left, PRODUCT), "mod", self.least(right, PRODUCT))
            case ast.Add():
                second = self.least(right, SUM)
                return Binary(self.least(left, SUM), "+", Brackets((second,)) if begins_negative(second) else second)
            case ast.Sub():
                return Binary(self.least(left, SUM), "-", self.least(right, PRODUCT))
            case ast.MatMult():
                return self.product(left, right)
            case ast.BitAnd() | ast.BitOr():
                return self.joined("and" if isinstance(node.op, ast.BitAnd) else "or", [left, right])
        return None

    def joined(self, word: str, conditions: list[ast.expr]) -> Node:
        """Conditions with a word between them."""
        first, *more = (self.condition(part, word) for part in conditions)
        for part in more:
            first = Binary(first, word, part)
        return first

    def condition(self, node: ast.expr, word: str) -> Node:
        part = self.read(node)
        mixed = isinstance(part, Binary) and part.sign in ("and", "or") and part.sign != word
        return Brackets((part,)) if mixed else part

    def boolean(self, node: ast.BoolOp) -> Node:
        return self.joined("and" if isinstance(node.op, ast.And) else "or", node.values)

    def choice(self, node: ast.IfExp) -> Node:
        return Cases(self.read(node.body), self.read(node.test), self.read(node.orelse))

    def power(self, base: ast.expr, exponent: ast.expr) -> Node:
        match base:
            case ast.Call(ast.Name(name), args) if name in _ANGULAR:
                return Prefix(Power(Function(name), self.read(exponent)), self.brackets(args), POWER)
        part = self.least(base, WHOLE)
        return Power(Brackets((part,)) if isinstance(part, Fraction) else part, self.read(exponent))

    def product(self, left: ast.expr, right: ast.expr) -> Node:
        match right:
            case ast.UnaryOp():
                second: Node = self.brackets([right])
            case ast.BinOp(op=ast.Div()):
                second = self.least(right, PRODUCT)
            case _:
                second = self.least(right, POWER if isinstance(right, ast.BinOp) else PRODUCT)
        return Product(_closed(self.least(left, PRODUCT)), second, begins_as_number(second))

    def compare(self, node: ast.Compare) -> Node | None:
        if not all(type(op) in _COMPARISONS for op in node.ops):
            return None
        part = self.least(node.left, SUM)
        for op, right in zip(node.ops, node.comparators, strict=True):
            part = Binary(part, _COMPARISONS[type(op)], self.least(right, SUM))
        return part

    def subscript(self, node: ast.Subscript) -> Node:
        """An element, or those whose number k is in a slice; what only arranges axes is not shown."""
        value, keys = (
            self.least(node.value, WHOLE),
            node.slice.elts if isinstance(node.slice, ast.Tuple) else [node.slice],
        )
        picked = [self.place(key) for key in keys if ast.unparse(key) not in (":", "...", "None")]
        if not picked:
            return value
        return Element(value, picked[0] if len(picked) == 1 else Brackets(tuple(picked)))

    def place(self, key: ast.expr) -> Node:
        if words := names.place(key):
            return words
        match key:
            case ast.Slice(None, ast.expr() as stop, None) if not isinstance(stop, ast.UnaryOp):
                return Binary(Symbol("k"), "<", self.least(stop, SUM))
            case ast.Slice(ast.expr() as start, None, None) if not isinstance(start, ast.UnaryOp):
                return Binary(Symbol("k"), "≥", self.least(start, SUM))
        return self.read(key)

    def starred(self, node: ast.Starred) -> Node:
        return self.read(node.value)

    def listed(self, node: ast.List | ast.Tuple) -> Node:
        rows = [row.elts for row in node.elts if isinstance(row, ast.List | ast.Tuple)]
        if rows and len(rows) == len(node.elts) and len({len(row) for row in rows}) == 1:
            return Matrix(tuple(Row(tuple(map(self.read, row))) for row in rows))
        return Brackets(tuple(map(self.read, node.elts)), "[]" if isinstance(node, ast.List) else "()", high=True)

    def each(self, node: ast.ListComp | ast.GeneratorExp) -> Node | None:
        """What is computed for each element of something."""
        match node.generators:
            case [ast.comprehension(index, source, [])]:
                of = Prefix(self.index(index), Prefix(Text(" of "), self.read(source)), RELATION)
                return Brackets((Prefix(self.read(node.elt), Prefix(Text(" for each "), of)),), "[]", high=True)
        return None

    def index(self, node: ast.expr) -> Node:
        """What stands for an element, or for its parts, but those that nothing reads."""
        named = [part for part in getattr(node, "elts", [node]) if ast.unparse(part) != "_"]
        return self.read(named[0]) if len(named) == 1 else self.brackets(named)

    def brackets(self, args: list[ast.expr]) -> Brackets:
        return Brackets(tuple(map(self.read, args)))

    def call(self, node: ast.Call) -> Node | None:
        match node:
            case ast.Call(ast.Name("sum") | ast.Attribute(_, "sum"), [ast.GeneratorExp() | ast.ListComp() as terms]):
                return self.sum(terms)
            case ast.Call(ast.Name(name), [x], [ast.keyword("axis", axis)]):
                if name in _OVER:
                    over = Element(Function(names.FUNCTIONS.get(name, name)), Text(_axis(ast.unparse(axis))))
                    return Apply(over, self.brackets([x]))
                return self.function(name, [x])
            case ast.Call(ast.Name(name), args, keywords):
                given = [*args, *(k.value for k in keywords)]
                return self.function(name, [a for a in given if not (isinstance(a, ast.Name) and a.id == "branch")])
            case ast.Call(ast.Attribute(ast.Attribute(ast.Name("np"), "linalg"), "solve"), [A, b]):
                return Product(Power(self.least(A, WHOLE), Number(-1)), self.least(b, PRODUCT))
            case ast.Call(ast.Attribute(ast.Attribute(ast.Name("np"), "linalg"), "inv"), [A]):
                return Power(self.least(A, WHOLE), Number(-1))
            case ast.Call(ast.Attribute(ast.Attribute(ast.Name("np"), "linalg"), ("det" | "norm") as name), [x]):
                return self.function("abs" if name == "norm" else name, [x])
            case ast.Call(ast.Attribute(x, ("max" | "min" | "sum" | "mean") as name), args, keywords):
                if len(args) + len(keywords) < 2:
                    along = [ast.keyword("axis", arg) for arg in args]
                    return self.call(ast.Call(ast.Name(name), [x], [*along, *keywords]))
        return None

    def sum(self, terms: ast.GeneratorExp | ast.ListComp) -> Node | None:
        """Sum over the elements of something, or over whole numbers."""
        match terms.generators:
            case [ast.comprehension(ast.Name() as index, ast.Call(ast.Name("range"), [*start, stop]), [])]:
                first = self.read(start[0]) if start else Number(0)
                return Sum(self.least(terms.elt, PRODUCT), self.read(index), first, self.before(stop))
            case [ast.comprehension(index, source, [])]:
                return Sum(self.least(terms.elt, PRODUCT), self.index(index), self.read(source))
        return None

    def function(self, name: str, args: list[ast.expr]) -> Node:
        match name, args:
            case "sqrt", [x]:
                return Root(self.read(x))
            case "hypot", [_, *_]:
                first, *more = (self.power(a, ast.Constant(2)) for a in args)
                for square in more:
                    first = Binary(first, "+", square)
                return Root(first)
            case "abs", [x]:
                return Brackets((self.read(x),), "||", high=True)
            case "log", [x, base]:
                return Apply(Element(Function("log"), self.read(base)), self.brackets([x]))
            case "conj", [x]:
                return Overline(self.read(x))
            case "exp", [x]:
                return Power(Symbol("e"), self.read(x))
            case "cross", [a, b]:
                return Binary(self.least(a, PRODUCT), "×", self.least(b, PRODUCT))
            case "dot", [a, b]:
                return Product(self.least(a, PRODUCT), self.least(b, PRODUCT), dot=True)
            case "arange", [stop]:
                return Range((Number(0), Number(1)), self.before(stop))
            case "arange", [start, stop]:
                return Range((self.read(start),), self.before(stop))
            case "linspace", [start, stop, *_]:
                return Range((self.read(start),), self.read(stop))
            case "trapezoid", [y, x]:
                return Integral(self.least(y, PRODUCT), self.least(x, WHOLE))
            case "cumulative_trapezoid", [y, x, *_]:
                return Integral(self.least(y, PRODUCT), self.least(x, WHOLE), so_far=True)
            case "ceil" | "floor", [x]:
                return Brackets((self.read(x),), "⌈⌉" if name == "ceil" else "⌊⌋")
            case "where", [condition, a, b]:
                return Cases(self.read(a), self.read(condition), self.read(b))
            case "celsius", [ast.Constant(int() | float() as degrees)]:
                return Measure(degrees, "degC")
            case "select", [ast.List(conditions), ast.List(values), *default] if len(conditions) == len(values):
                chosen = self.read(default[0]) if default else Number(0)
                for condition, x in zip(reversed(conditions), reversed(values), strict=True):
                    chosen = Cases(self.read(x), self.read(condition), chosen)
                return chosen
            case "array" | "asarray", [ast.List() | ast.Tuple() | ast.ListComp() as rows]:
                return self.read(rows)
            case "atan2", [y, x]:
                return Apply(Function(name), self.brackets([y, x]))
        return _applied(names.function(name), self.brackets(args))

    def before(self, stop: ast.expr) -> Node:
        """The last whole number before ``stop``."""
        match stop:
            case ast.Constant(int(value) | float(value)):
                return Number(value - 1)
            case ast.BinOp(last, ast.Add(), ast.Constant(1)):
                return self.read(last)
        return self.read(ast.BinOp(stop, ast.Sub(), ast.Constant(1)))


_RULES: dict[type[ast.expr], Callable[[_Reader, Any], Node | None]] = {
    ast.Name: _Reader.name, ast.Constant: _Reader.constant, ast.Attribute: _Reader.attribute,
    ast.UnaryOp: _Reader.unary, ast.BinOp: _Reader.binary, ast.Compare: _Reader.compare, ast.Call: _Reader.call,
    ast.Subscript: _Reader.subscript, ast.Starred: _Reader.starred, ast.List: _Reader.listed,
    ast.ListComp: _Reader.each, ast.GeneratorExp: _Reader.each, ast.Tuple: _Reader.listed,
    ast.IfExp: _Reader.choice, ast.BoolOp: _Reader.boolean,
}  # fmt: skip


def _axis(text: str) -> str:
    return "last axis" if text == "-1" else f"axis {text}"


def _applied(function: Node, arguments: Brackets) -> Node:
    """A function of its arguments; an angle that is one symbol or number follows without brackets."""
    if isinstance(function, Function) and function.name in _ANGULAR and len(arguments.items) == 1:
        angle = arguments.items[0]
        if isinstance(angle, Symbol) or (isinstance(angle, Measure) and strength(angle) == WHOLE):
            return Prefix(function, angle)
    return Apply(function, arguments)


def _closed(factor: Node) -> Node:
    """A factor with brackets round the angle at its end, for what follows is not part of the angle."""
    match factor:
        case Prefix(Function() as function, of) if factor.strength == WHOLE:
            return Apply(function, Brackets((of,)))
        case Product(left, right, dot):
            return Product(left, _closed(right), dot)
    return factor


def _without_minus(node: ast.expr) -> ast.expr | None:
    """A product or quotient without the minus of its first factor; None where it has none."""
    match node:
        case ast.BinOp(ast.UnaryOp(ast.USub(), first), (ast.Mult() | ast.Div()) as op, right):
            return ast.BinOp(first, op, right)
        case ast.BinOp(left, (ast.Mult() | ast.Div()) as op, right) if positive := _without_minus(left):
            return ast.BinOp(positive, op, right)
    return None


def _read_as(node: ast.AST) -> str:
    """Name under which a formula reads a quantity, ``g.L3`` and ``g.bolt.R_m`` too; "" for anything else."""
    match node:
        case ast.Attribute(ast.Name("g"), name):
            return f"g.{name}"
        case ast.Attribute(ast.Attribute(ast.Name("g"), name), part):
            return f"g.{name}.{part}"
        case ast.Name(name):
            return name
    return ""
