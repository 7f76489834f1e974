"""Expressions of Python read as formulas: what a line computes, in the notation of the field."""

import ast
import re
from collections.abc import Callable, Iterable, Mapping
from functools import lru_cache, reduce
from typing import Any

from mechsheet.document import by_elements, comprehension, functions, mapped, names, solved
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
    Power,
    Prefix,
    Product,
    Row,
    Signed,
    Sum,
    Text,
    begins_as_number,
    begins_negative,
    strength,
)
from mechsheet.worksheet.lines import Formula, Given
from mechsheet.worksheet.symbol import Symbol, read


@lru_cache(maxsize=4096)
def left(line: Formula, single: frozenset[str] = frozenset()) -> Node:
    """Left side of a line: its symbol, of a function with its arguments; ``single`` are no fields."""
    symbol = read(line.name) if line.name in single else names.symbol(line.name)
    return Apply(symbol, Brackets(tuple(map(names.symbol, line.arguments)), close=True)) if line.arguments else symbol


@lru_cache(maxsize=4096)
def right(line: Formula, single: frozenset[str] = frozenset()) -> Node | None:
    """Right side of a line; None where it is a number, says the same as the left, or is not what the value is now."""
    node = None
    if not (line.altered or isinstance(line.expression, ast.Constant)):
        node = tree(_written(line.expression, line), single=single)
    if isinstance(node, Measure) and node.unit == line.unit:
        return None
    return None if node == left(line, single) else node


_SOLVED = {"_found": "Find", "_least": "Minerr"}  # endings of the names of verdicts


def equation(line: Formula | Given, single: frozenset[str] = frozenset()) -> Node:
    """A line as an equation, or its symbol alone; of a solve block what must be equal."""
    if isinstance(line, Given):
        parts = (tree(_written(part, line), single=single) for part in (line.expression, line.target))
        return Row((Text("Given" if line.first else "and"), Binary(next(parts), "=", next(parts))))
    node = right(line, single)
    if node is None:
        return left(line, single)
    own = (tree(_written(value, line), single=single) for _, value in line.where)
    where = tuple(Binary(names.symbol(name), "=", value) for (name, _), value in zip(line.where, own, strict=True))
    whole = Binary(left(line, single), "=", node)
    return Row((whole, Text("where"), *where)) if where else whole


def substituted(line: Formula, numbers: Mapping[str, Measure]) -> Node | None:
    """Right side of a line with numbers for its symbols; None where it has none, or reads matrices."""
    if not numbers or not right(line) or line.shapes:
        return None
    expression = _written(line.expression, line)
    node = tree(expression, numbers)
    return None if node == tree(expression) else node


def _written(part: ast.expr, line: Formula | Given) -> ast.expr:
    """A part of a line with its units as such, solve blocks by their unknowns, and what calls its own functions."""
    if isinstance(line, Formula) and line.solved:
        part = solved.by_unknowns(part, line.solved)
    part = functions.marked(measured(part, line.constants), line.own)
    return by_elements.marked(part, dict(line.shapes))


@lru_cache(maxsize=4096)
def reads(line: Formula) -> tuple[str, ...]:
    """Names that the right side of a line reads, as they are written: ``g.L3`` too; none that has another value now."""
    read = dict.fromkeys(filter(None, map(_read_as, ast.walk(line.expression))))
    return tuple(name for name in read if name not in line.others)


def tree(node: ast.expr, numbers: Mapping[str, Measure] | None = None, single: frozenset[str] = frozenset()) -> Node:
    """Expression as a tree: fractions, roots, powers, no brackets that the reader does not need.

    ``numbers`` stand for some names, ``g.L3`` too; those in ``single`` are no fields over S, though they end so.
    """
    return _Reader(numbers or {}, single).read(node)


_COMPARISONS = {
    ast.Lt: "<", ast.LtE: "≤", ast.Gt: ">", ast.GtE: "≥", ast.Eq: "=", ast.NotEq: "≠",
    ast.In: "∈", ast.NotIn: "∉", ast.Is: "=", ast.IsNot: "≠",
}  # fmt: skip


class _Reader:
    """Reads expressions of Python."""

    def __init__(self, numbers: Mapping[str, Measure], single: frozenset[str]) -> None:
        self.numbers, self.single = numbers, single

    def read(self, node: ast.expr) -> Node:
        if isinstance(node, ast.Call) and hasattr(node, "is_own"):
            return functions.own(self, node)
        node = mapped.written_out(names.bare(node))
        kind = type(node)
        if self.numbers and kind in (ast.Name, ast.Attribute) and (number := self.numbers.get(_read_as(node))):
            return number
        rule = _RULES.get(kind)
        return (rule(self, node) if rule else None) or Code(ast.unparse(node))

    def without(self, bound: Iterable[str]) -> "_Reader":
        """One for which these names stand for nothing but themselves."""
        return _Reader({name: x for name, x in self.numbers.items() if name not in bound}, self.single)

    def symbols(self) -> "_Reader":
        """One that puts no numbers for symbols: for what is of all elements, not of the one that is shown."""
        return _Reader({}, self.single)

    def least(self, node: ast.expr, least: int) -> Node:
        """The expression, in brackets where it holds together less than its place asks for."""
        part = self.read(node)
        return part if strength(part) >= least else Brackets((part,))

    def name(self, node: ast.Name) -> Node:
        return read(node.id) if node.id in self.single else names.symbol(node.id)

    def constant(self, node: ast.Constant) -> Node:
        match node.value:
            case bool(value):
                return Text("true" if value else "false")
            case complex(imag=1):
                return Symbol("i")
            case complex(imag=size):
                return Product(Number(size), Symbol("i"))
            case int() | float():
                return Number(node.value, typed=True)
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
            case ast.Attribute(ast.Call(ast.Name("find"), [f, *_], keywords), "value"):
                return solved.found(self, f, next((k.value for k in keywords if k.arg == "equals"), ast.Constant(0)))
            case ast.Attribute(ast.Name(name), "value"):  # of a slider or field of the page
                return names.symbol(name)
            case ast.Attribute(ast.Name(name), "T") if re.fullmatch(r"[A-Za-z](_\w+)?", name):  # a matrix
                return Power(names.symbol(name), Function("T"))
            case ast.Attribute(ast.BinOp() | ast.Subscript() as inner, "T"):
                return Power(self.least(inner, WHOLE), Function("T"))
            case ast.Attribute(ast.Call(ast.Attribute(of)) as inner, "T") if names.is_module(of):
                return Power(self.least(inner, WHOLE), Function("T"))
            case ast.Attribute(of, name) if names.is_module(of):
                return Code(name) if name.endswith("_") else names.function(name)
            case ast.Attribute(ast.Subscript(ast.Attribute(ast.Name("g")) as table, row), part):  # of one row
                return self.read(ast.Subscript(ast.Attribute(table, part), row))
            case ast.Attribute(ast.Name(name), part):  # a result of several parts
                return Apply(names.part(part), Brackets((names.whole(name),)))
            case ast.Attribute(ast.Subscript() as inner, part):
                return Apply(names.part(part), Brackets((self.read(inner),)))
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
            case _ if by_elements.is_marked(node):
                return by_elements.read(self, node)
            case ast.Mult() | ast.Div() if positive := _without_minus(node):
                return Signed("-", self.read(positive))
            case ast.Div():
                under = [right]  # of one fraction, not one on another
                while isinstance(left, ast.BinOp) and isinstance(left.op, ast.Div) and not by_elements.is_marked(left):
                    under, left = [left.right, *under], left.left
                below: ast.expr = reduce(lambda a, b: ast.BinOp(a, ast.Mult(), b), under)
                match left:  # two beside each other
                    case ast.BinOp(ast.BinOp(op=ast.Div()) as a, ast.Mult(), b) if not by_elements.is_marked(left):
                        return self.product(a, ast.BinOp(b, ast.Div(), below))
                return Fraction(self.read(left), self.read(below))
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
                closed = begins_negative(second) or _is_rest(second)
                return Binary(self.least(left, SUM), "+", Brackets((second,)) if closed else second)
            case ast.Sub():
                return Binary(self.least(left, SUM), "-", self.least(right, PRODUCT))
            case ast.MatMult():
                return self.symbols().product(left, right)
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
        match names.bare(base):
            case ast.Call(ast.Name(name), args, []) if name in functions.ANGULAR:
                return Prefix(Power(Function(name), self.read(exponent)), self.brackets(args), POWER)
        part = self.least(base, WHOLE)
        closed = isinstance(part, Fraction) or _is_of_many(part)
        return Power(Brackets((part,)) if closed else part, self.read(exponent))

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
            among = isinstance(op, ast.In | ast.NotIn) and isinstance(right, ast.List | ast.Tuple | ast.Set)
            part = Binary(part, _COMPARISONS[type(op)], self.among(right) if among else self.least(right, SUM))
        return part

    def among(self, node: ast.expr) -> Node:
        """Elements of a set."""
        return Brackets(tuple(map(self.read, getattr(node, "elts", [node]))), "{}")

    def subscript(self, node: ast.Subscript) -> Node:
        """An element, or those whose number k is in a slice; what only arranges axes is not shown."""
        if isinstance(node.value, ast.Dict) and (chosen := self.chosen(node.value, node.slice)):
            return chosen
        match node.slice:
            case ast.Constant(0) if integral := functions.quad(self, node.value):
                return integral
            case ast.Tuple(elts):
                keys = elts
            case key:
                keys = [key]
        shown = [key for key in keys if ast.unparse(key) not in _ARRANGING]
        while shown and ast.unparse(shown[-1]) == ":":
            shown.pop()
        whole = self.symbols() if shown and isinstance(node.value, ast.Name | ast.Attribute) else self
        value = whole.least(node.value, WHOLE)
        if not shown:
            return value
        if isinstance(value, Element) and isinstance(value.index, Binary) and value.index.sign != ",":  # those picked
            value = Brackets((value,))
        inside = self.without([_read_as(node.value)])  # of which a condition is of all elements, not of the one shown
        return Element(value, _listed(map(inside.place, shown)))

    def chosen(self, among: ast.Dict, key: ast.expr) -> Node | None:
        """One of several values by a key, as a choice; None of what is no such dictionary."""
        options = [option.value for option in among.keys if isinstance(option, ast.Constant)]
        if not options or len(options) < len(among.keys):
            return None
        if isinstance(key, ast.Constant):
            return self.read(among.values[options.index(key.value)]) if key.value in options else None
        *others, last = map(self.read, among.values)
        for option, value in reversed([*zip(options, others, strict=False)]):
            of = Text(option) if isinstance(option, str) else self.read(ast.Constant(option))
            last = Cases(value, Binary(self.least(key, SUM), "=", of), last)
        return last

    def place(self, key: ast.expr) -> Node:
        if words := names.place(key):
            return words
        match key:
            case ast.UnaryOp(ast.USub(), counted):
                return Prefix(Text("from the end "), self.least(counted, SUM))
            case ast.expr() if not isinstance(key, ast.Slice):
                return self.read(key)
        k = names.counter(key)
        match key.lower, key.upper:
            case ast.expr() as start, ast.expr() as stop if not _is_minus(start) and not _is_minus(stop):
                first = Binary(self.least(start, SUM), "≤", k)
                parts: list[Node] = [Binary(first, "<", self.least(stop, SUM))]
            case start, stop:
                parts = [self.beyond(k, "≥", start, "last ")] if start else []
                parts += [self.beyond(k, "<", stop, "all but last ")] if stop else []
        match key.step:
            case ast.UnaryOp(ast.USub(), ast.Constant(1)):
                parts.append(Text("reversed"))
            case ast.expr() as step:
                parts.append(Prefix(Text("every "), self.least(step, SUM)))
        return _listed(parts or [Text(":")])

    def beyond(self, k: Symbol, sign: str, end: ast.expr, counted: str) -> Node:
        """Elements on one side of an end, which may be counted from the last one."""
        if not isinstance(end, ast.UnaryOp) or not _is_minus(end):
            return Binary(k, sign, self.least(end, SUM))
        return Text(counted.strip()) if names.number(end) == -1 else Prefix(Text(counted), self.least(end.operand, SUM))

    def starred(self, node: ast.Starred) -> Node:
        return self.read(node.value)

    def listed(self, node: ast.List | ast.Tuple) -> Node:
        rows = [row.elts for row in node.elts if isinstance(row, ast.List | ast.Tuple)]
        if rows and len(rows) == len(node.elts) and len({len(row) for row in rows}) == 1:
            return Matrix(tuple(Row(tuple(map(self.read, row))) for row in rows))
        return Brackets(tuple(map(self.read, node.elts)), "[]" if isinstance(node, ast.List) else "()", high=True)

    def brackets(self, args: list[ast.expr]) -> Brackets:
        return Brackets(tuple(map(self.read, args)))

    def call(self, node: ast.Call) -> Node:
        return comprehension.over_each(self, node) or functions.call(self, node)

    def each(self, node: comprehension.Each) -> Node:
        return comprehension.listed(self, node)

    def function(self, node: ast.Lambda) -> Node | None:
        return comprehension.function(self, node)


_RULES: dict[type[ast.expr], Callable[[_Reader, Any], Node | None]] = {
    ast.Name: _Reader.name, ast.Constant: _Reader.constant, ast.Attribute: _Reader.attribute,
    ast.UnaryOp: _Reader.unary, ast.BinOp: _Reader.binary, ast.Compare: _Reader.compare, ast.Call: _Reader.call,
    ast.Subscript: _Reader.subscript, ast.Starred: _Reader.starred, ast.List: _Reader.listed,
    ast.ListComp: _Reader.each, ast.GeneratorExp: _Reader.each, ast.Tuple: _Reader.listed,
    ast.IfExp: _Reader.choice, ast.BoolOp: _Reader.boolean, ast.Lambda: _Reader.function,
    ast.Set: _Reader.among,
}  # fmt: skip


_ARRANGING = ("...", "None", "np.newaxis", "numpy.newaxis", "newaxis")  # axes


def _listed(parts: Iterable[Node]) -> Node:
    return reduce(lambda before, part: Binary(before, ",", part), parts)


def _is_minus(node: ast.expr) -> bool:
    return isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub)


def _is_rest(node: Node) -> bool:
    """Whether a part is what a division leaves: behind a sum it would be what the whole sum leaves."""
    return isinstance(node, Binary) and node.sign == "mod"


def _is_of_many(node: Node) -> bool:
    """Whether a part begins with the sign of a sum, which an exponent behind it would not be of."""
    function = node.function if isinstance(node, Apply) else None
    function = function.of if isinstance(function, Element) else function
    return isinstance(function, Function) and function.name in ("sum", "prod")


def _closed(factor: Node) -> Node:
    """A factor with brackets round the angle at its end, for what follows is not part of the angle."""
    match factor:
        case Prefix(Function() as function, of) if factor.strength == WHOLE:
            return Apply(function, Brackets((of,)))
        case Product(left, right, dot):
            return Product(left, _closed(right), dot)
        case Integral() | Sum():
            return Brackets((factor,))
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
