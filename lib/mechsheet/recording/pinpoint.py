"""Where in a worksheet an operation of its recording is written: the line, the part of it, and what it reads."""

import ast
from collections.abc import Iterable, Iterator, Mapping
from functools import cached_property
from itertools import pairwise
from typing import NamedTuple, TypeGuard

from mechsheet.worksheet import source
from mechsheet.worksheet.cells import Worksheet
from mechsheet.worksheet.errors import as_written
from mechsheet.worksheet.lines import Formula
from mechsheet.worksheet.numbers import scientific
from mechsheet.worksheet.source import bound

_SIGNS: dict[str, tuple[type[ast.AST], ...]] = {
    "add": (ast.Add, ast.Sub), "sub": (ast.Add, ast.Sub), "pow": (ast.Pow,), "mod": (ast.Mod,),
    **dict.fromkeys(("lt", "le", "gt", "ge", "eq", "ne"), (ast.cmpop,)),
}  # fmt: skip
# The functions that do one operation each, but for those that may do any.
_OWN: dict[str, tuple[str, ...]] = {
    "sin": ("sin",), "cos": ("cos",), "tan": ("tan",), "exp": ("exp", "sin", "cos"), "log": ("log",),
    **dict.fromkeys(("sqrt", "range", "len", "enumerate", "zip", "append", "extend", "insert"), ()),
}  # fmt: skip
_LIKE = 0.5  # more than this part of the names are the same
_BLOCKS = (ast.For, ast.While, ast.If, ast.With, ast.Try, ast.TryStar, ast.Match)  # statements with lines within
_DOING = (ast.BinOp, ast.AugAssign, ast.Compare, ast.Call)  # parts that do operations
_SIGN = 0.25  # so much likelier is what has the very sign
_LONGEST = 60  # characters of a part that is told


class Mistake(NamedTuple):
    """A part of a line whose dimensions do not fit, and why, in words."""

    line: int  # of the worksheet
    part: str
    why: str

    def __str__(self) -> str:
        return f"line {self.line}, {self.part}: {self.why}" if self.line else f"{self.part}: {self.why}"


class Part(NamedTuple):
    """A part of a worksheet that does an operation: its line and its text."""

    line: int
    text: str
    literals: tuple[tuple[str, int, float], ...] = ()  # factors without a unit, of which operand, to what power


class Places:
    """The statements of a worksheet by their lines, with the functions that they call."""

    def __init__(self, sheet: Worksheet, known: Mapping[str, Formula]) -> None:
        self.sheet, self.known = sheet, known
        self.statements = {line.lineno: line for cell in sheet.cells for line in cell.lines}

    @cached_property
    def functions(self) -> dict[str, ast.stmt]:
        """The worksheet's functions by their names, written with ``def`` or as a lambda."""
        found = dict[str, ast.stmt]()
        for line in self.statements.values():
            match line:
                case ast.FunctionDef(name) | ast.Assign([ast.Name(name)], ast.Lambda()):
                    found[name] = line
        return found

    @cached_property
    def lines(self) -> dict[str, int]:
        """Lines of the statements that bind names."""
        return {name: number for number, line in self.statements.items() for name in bound(line)}

    def line_of(self, formula: Formula) -> int:
        """The line of a formula; of a function that of what it returns."""
        match self.functions.get(formula.name):
            case ast.FunctionDef(body=[*_, last]) if formula.arguments:
                return last.lineno
        return self.lines.get(formula.name, formula.expression.lineno)

    def function_called(self, expression: ast.expr) -> Formula | None:
        """The function with a unit that an expression calls and is no more than that."""
        match expression:
            case ast.Call(ast.Name(name)) if name in self.known and name in self.functions:
                return self.known[name] if self.known[name].arguments else None
        return None

    def function_solved(self, line: int) -> Formula | None:
        """The function with a unit that a Find of a line solves."""
        for node in source.nodes(self.statements[line]) if line in self.statements else ():
            match node:
                case ast.Call(ast.Name("find"), [ast.Name() as f, *_]):
                    return self.function_called(ast.Call(f, [], []))
                case ast.Call(ast.Name("find"), [ast.Lambda(body=body), *_]):
                    return self.function_called(body)
        return None

    def is_erratum(self, line: int) -> bool:
        """Whether the statement of a line is marked as one that the document prints and that is wrong."""
        around = (s for s in self.statements.values() if s.lineno <= line <= (s.end_lineno or s.lineno))
        names = (name for statement in around for name in bound(statement))
        return any("erratum" in self.known[name].meaning for name in names if name in self.known)

    def of_check(self, name: str, lines: Iterable[int]) -> int:
        """The line where a check of this name is made, by a statement of one of some lines, else by any."""
        lines = [line for line in lines if line in self.statements]
        for line in (*lines, *self.statements):  # what compares inputs alone has no line of its own
            for node in source.nodes(self.statements[line]):
                if isinstance(node, ast.Constant) and node.value == name:
                    return node.lineno
        return max(lines, default=0)

    def parts(self, line: int) -> list[ast.stmt]:
        """The statement of a line, then the functions of the worksheet that it calls, those that these call too."""
        found = [self.statements[line]] if line in self.statements else []
        for part in found:
            called = (self.functions[name] for name in _names(part) if name in self.functions)
            found += [function for function in dict.fromkeys(called) if function not in found]
        return found

    def literals(self, expression: ast.expr) -> list[str]:
        """The numbers of several digits that a formula has, as they are written."""
        numbers = [n for n in source.nodes(expression) if isinstance(n, ast.Constant)]
        ordered = (n.value for n in sorted(numbers, key=lambda n: (n.lineno, n.col_offset)))
        return [repr(x) for x in ordered if isinstance(x, int | float) and scientific(x, 1)[2] != "0"]

    @cached_property
    def undeclared(self) -> set[str]:
        """Names of lines that no operand is known by: they have no unit."""
        return self.lines.keys() - {name for name, line in self.known.items() if line.has_value}

    def find(self, line: int, op: str, operands: list[set[str]]) -> Part:
        """The part of the statement of a line that does an operation on what is made of the names of its operands."""
        owns = [(part, self.undeclared | _locals(part)) for part in self.parts(line)]
        doing = [(node, own) for part, own in owns for node in source.nodes(part) if isinstance(node, _DOING)]
        rated = [(node, _likeness(node, op, operands, own)) for node, own in doing]
        rated = [(node, likeness + _SIGN * _is_sign(node, op)) for node, likeness in rated if likeness > _LIKE]
        likest = max(rated, key=lambda each: each[1])[0] if rated else None
        statement = self.statements.get(line)
        able = [n for n in source.nodes(statement) if _does(n, op)] if statement else []
        if not likest and statement and able and (len(able) == 1 or isinstance(statement, _BLOCKS)):
            own = self.undeclared | _locals(statement)
            ranks = [(_is_sign(n, op), _likeness(n, op, operands, own)) for n in able]
            first = able[ranks.index(max(ranks))]
            if ranks.count(max(ranks)) == 1 or not isinstance(first, ast.Compare):  # of two conditions it may be either
                likest = first
        if likest:
            return Part(likest.lineno, _short(ast.unparse(likest)), tuple(self.literal_factors(likest)))
        match statement:
            case ast.Assign(value=value) | ast.AugAssign(value=value) | ast.Expr(value):
                return Part(line, _short(ast.unparse(value)))
            case ast.stmt():
                return Part(line, _short(ast.unparse(statement).partition("\n")[0].removesuffix(":")))
        return Part(line, "its statement")

    def literal_factors(self, part: ast.AST) -> Iterator[tuple[str, int, float]]:
        """Numbers without a unit, or names of such, by which an operand of a sum is multiplied."""
        match part:
            case ast.BinOp(left, ast.Add() | ast.Sub(), right) | ast.AugAssign(left, ast.Add() | ast.Sub(), right):
                for n, operand in enumerate((left, right)):
                    for factor, power in _factors(operand, 1.0):
                        if self.is_literal(factor):
                            yield _short(ast.unparse(factor)), n, power

    def is_literal(self, factor: ast.expr) -> bool:
        """Whether a factor is a number of several digits, or a name that one line binds to a number without a unit."""
        match factor:
            case ast.Name(name) if name in self.undeclared:
                bind = [s for s in self.statements.values() if name in bound(s)]
                match bind:
                    case [ast.Assign([ast.Name()], ast.Constant(float()))]:
                        return True
        return bool(self.literals(factor)) if isinstance(factor, ast.Constant) else False


def _short(text: str) -> str:
    text = as_written(text)
    return text if len(text) <= _LONGEST else text[: _LONGEST - 2] + " …"


def _factors(part: ast.expr, power: float) -> Iterator[tuple[ast.expr, float]]:
    """What a product is made of, and to what power."""
    match part:
        case ast.BinOp(left, ast.Mult() | ast.Div() as sign, right):
            yield from _factors(left, power)
            yield from _factors(right, power if isinstance(sign, ast.Mult) else -power)
        case ast.UnaryOp(_, operand):
            yield from _factors(operand, power)
        case _:
            yield part, power


def _does(node: ast.AST, op: str) -> TypeGuard[ast.BinOp | ast.AugAssign | ast.Compare]:
    """Whether a part is written with the sign of an operation."""
    match node:
        case ast.BinOp(op=sign) | ast.AugAssign(op=sign) | ast.Compare(ops=[sign, *_]):
            return isinstance(sign, _SIGNS.get(op, ()))
    return False


def _is_sign(node: ast.AST, op: str) -> bool:
    """Whether a part has the very sign of an operation: another one may be recorded as it."""
    return isinstance(node, ast.BinOp | ast.AugAssign) and type(node.op).__name__.lower() == op


def _likeness(node: ast.AST, op: str, operands: list[set[str]], own: set[str]) -> float:
    """How well the names in the operands of a part are those of an operation, from 0 to 1."""
    match node:
        case ast.BinOp(left, sign, right) | ast.AugAssign(left, sign, right) if isinstance(sign, _SIGNS.get(op, ())):
            return _alike([left], operands[0], own) / 2 + _alike([right], operands[1], own) / 2
        case ast.Compare(left, _, others) if _does(node, op):
            pairs = pairwise([left, *others])
            return max(_alike([a], operands[0], own) / 2 + _alike([b], operands[1], own) / 2 for a, b in pairs)
        case ast.Call(f, args, keywords):
            if (name := next(_names(f), "")) in _OWN and op not in _OWN[name]:
                return 0.0
            given = [*args, *(keyword.value for keyword in keywords)]
            return 0.9 * _alike(given, set().union(*operands), own)  # an operator is told rather than a function
    return 0.0


def _alike(parts: list[ast.expr], names: set[str], own: set[str]) -> float:
    """Names that both have, of those that either has; what a function calls its own may be any."""
    read = {name for part in parts for name in _names(part)} - _CALLED
    if read & own:
        return (0.6 + len((read - own) & names)) / (1 + len(read - own))
    return len(read & names) / len(read | names) if read or names else 1.0


def _locals(part: ast.stmt) -> set[str]:
    """Names that functions in a statement call their own, and those that it binds in the lines within it."""
    functions = [f for f in source.nodes(part) if isinstance(f, ast.FunctionDef | ast.Lambda)]
    arguments = {a.arg for f in functions for a in source.nodes(f.args) if isinstance(a, ast.arg)}
    within = (bound(s) for f in functions if not isinstance(f, ast.Lambda) for s in f.body)
    return arguments.union(*within, bound(part) if isinstance(part, _BLOCKS) else ())


_CALLED = frozenset(["g", "np", "pi", "abs", "sqrt", "sin", "cos", "tan", "exp", "real", "imag"])


def _names(node: ast.AST) -> Iterator[str]:
    for part in source.nodes(node):
        if isinstance(part, ast.Name):
            yield part.id
        elif isinstance(part, ast.Attribute):
            yield part.attr
