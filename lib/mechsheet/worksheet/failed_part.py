"""The part of a line that Python could not compute, and the values of what it is made of."""

import ast
import builtins
import dis
import linecache
import math
import re
import sys
import sysconfig
import warnings
from collections.abc import Collection, Iterator, Mapping, Sequence
from functools import cache, lru_cache
from itertools import chain
from pathlib import Path
from types import FrameType, ModuleType, TracebackType
from typing import Any, NamedTuple

import numpy as np

from mechsheet.worksheet import numbers
from mechsheet.worksheet.errors import as_written, cut

UNKNOWN = object()  # the value of what only the line itself would compute


class Part(NamedTuple):
    """Something that a line computes with: its text in the line, its value, and how an error names it with that."""

    text: str
    value: Any
    says: str = ""

    @property
    def shape(self) -> Sequence[int] | None:
        """Of an array, or a list; None of anything else."""
        if isinstance(self.value, np.ndarray):
            return [*self.value.shape]
        return [len(self.value)] if isinstance(self.value, list | tuple) else None

    @property
    def size(self) -> int:
        """Of how many values it is; 1 of a number, and -1 of what is neither that nor an array or a list."""
        return math.prod(self.shape or ()) if self.shape is not None or is_number(self.value) else -1


def is_number(value: object) -> bool:
    return isinstance(value, int | float | complex | np.number)


class Failed:
    """The part of a worksheet, or of what it imports from beside it, in which an error was raised."""

    def __init__(self, node: ast.AST, above: ast.AST, text: str, frame: FrameType, gone: Collection[str] = ()) -> None:
        """The names that are ``gone`` had values there which nobody knows any more."""
        self.node, self.above, self._text, code = node, above, text, frame.f_code
        called = {as_written(name): name for name in (*code.co_names, *code.co_varnames, *code.co_freevars)}
        self._names = vars(builtins) | frame.f_globals | frame.f_locals
        self._names |= {own: self._names[name] for own, name in called.items() if name in self._names}
        for name in gone:
            self._names.pop(name, None)
        self._own = {*code.co_varnames, *code.co_freevars}

    def part(self, node: ast.AST) -> Part:
        """An expression with its value, where that can be told without what a function of the worksheet does."""
        text = cut(" ".join((ast.get_source_segment(self._text, node) or ast.unparse(node)).split()))
        value = self._value(node)
        return Part(text, value, self._says(node, text, value))

    def parts(self) -> list[Part]:
        """What the failed part computes with."""
        return [self.part(node) for node in self._operands()]

    def members(self) -> list[Part]:
        """The same, and instead of a list that is written there what stands in it."""
        nodes = self._operands()
        written = ((node.elts if isinstance(node, ast.List | ast.Tuple) else [node]) for node in nodes)
        return [self.part(each) for each in chain.from_iterable(written)]

    def stored(self) -> list[Part]:
        """The elements that a line gives values, and these; none where it does something else."""
        if (
            isinstance(self.above, ast.Assign)
            and isinstance(self.node, ast.Subscript)
            and self.node in self.above.targets
        ):
            return [self.part(self.node), self.part(self.above.value)]
        return []

    @property
    def function(self) -> str:
        """Name of the function that is called there; "" where none is."""
        return ast.unparse(self.node.func) if isinstance(self.node, ast.Call) else ""

    @property
    def is_of_numbers(self) -> bool:
        """Whether the failed part is an operation, or a function of Python's or numpy's: one that takes no texts."""
        if not isinstance(self.node, ast.Call):
            return True
        of = getattr(self._value(self.node.func), "__module__", "") or ""
        method = isinstance(self.node.func, ast.Attribute) and isinstance(self._value(self.node.func.value), np.ndarray)
        ufunc = isinstance(self._value(self.node.func), np.ufunc)
        return method or ufunc or of in ("math", "builtins") or of.partition(".")[0] in ("numpy", "scipy")

    def _operands(self) -> Sequence[ast.expr]:
        match self.node:
            case ast.Call(ast.Attribute(value), given, named):
                own = [] if isinstance(self._value(value), ModuleType | type) else [value]
                return [*own, *given, *(each.value for each in named)]
            case ast.Call(_, given, named):
                return [*given, *(each.value for each in named)]
            case ast.Subscript(value, place):
                return [value, *(place.elts if isinstance(place, ast.Tuple) else [place])]
            case ast.BinOp(left, _, right) | ast.AugAssign(left, _, right):
                return [left, right]
            case ast.Compare(left, _, others):
                return [left, *others]
            case ast.UnaryOp(_, x) | ast.Attribute(x):
                return [x]
            case ast.For(_, x) | ast.comprehension(_, x) | ast.While(x):
                return [x]
            case ast.BoolOp(_, several):
                return several
            case ast.GeneratorExp(_, [of, *_]) | ast.ListComp(_, [of, *_]) | ast.SetComp(_, [of, *_]):
                return [of.iter]
            case ast.DictComp(_, _, [of, *_]):
                return [of.iter]
            case ast.Tuple(ctx=ast.Store()) | ast.List(ctx=ast.Store()):
                match self.above:
                    case ast.Assign(_, value):
                        return [value]
            case ast.Name() as name:
                return [name]
        return []

    def _says(self, node: ast.AST, text: str, value: Any) -> str:
        if isinstance(value, str):
            return repr(cut(value)) if isinstance(node, ast.Constant) else f"{text} = {cut(value)!r}"
        if not is_number(value) or _constant(node):
            return text
        match node:
            case ast.Attribute(ast.Name(of), name):
                for field in getattr(type(self._names.get(of)), "__inputs__", ()):
                    if field.name == name and not isinstance(value, bool):
                        return f"{field.meaning} {name} = {numbers.amount(value, field.unit, 6)}".strip()
            case ast.Name(name) if isinstance(value, float) and name not in self._own and np.isfinite(value):
                if unit := re.search(rf"(?m)^\s*{name}\s*(?::[^=\n]*)?=[^=\n][^#\n]*#\s*\[([^]\n]+)\]", self._text):
                    try:
                        return f"{text} = {numbers.amount(value, unit[1], 6)}"
                    except ValueError:  # it is not known
                        pass
        return f"{text} = {_written(value)}"

    def _value(self, node: ast.AST) -> Any:
        for each in ast.walk(node):
            if isinstance(each, ast.expr) and not isinstance(each, _READ):
                return UNKNOWN
            if isinstance(each, ast.Call) and (each.keywords or not _only_computes(self._value(each.func))):
                return UNKNOWN
        try:
            with np.errstate(all="ignore"), warnings.catch_warnings():
                warnings.simplefilter("ignore")
                return eval(ast.unparse(node), self._names)
        except Exception:
            return UNKNOWN


_READ = (
    ast.Name, ast.Constant, ast.Attribute, ast.Subscript, ast.Slice, ast.BinOp, ast.UnaryOp, ast.Compare,
    ast.Tuple, ast.List, ast.Dict, ast.Call,
)  # fmt: skip


_COMPUTE = (abs, float, int, len, max, min, round, sum, np.array, np.arange, np.linspace, np.zeros, np.ones)


def _only_computes(function: Any) -> bool:
    """Whether a function may be called again: it does nothing else, and at once."""
    known = any(function is each for each in _COMPUTE) or getattr(function, "__module__", "") == "math"
    return known or isinstance(function, np.ufunc)


def _constant(node: ast.AST) -> bool:
    return not any(isinstance(each, ast.Name) for each in ast.walk(node))


def _written(x: Any) -> str:
    return numbers.significant(float(x), 6) if isinstance(x, float | np.floating) else cut(str(x))


def of(error: BaseException) -> Failed:
    """Where an error was raised: the innermost part that is no library's.

    Without a part where its text cannot be read, and where this package raised it: by what that makes of its parts.
    """
    places = list[TracebackType]()
    for each in _walked(error):
        if each.tb_frame.f_code.co_filename.startswith(_OWN):
            places.clear()
        elif not each.tb_frame.f_code.co_filename.startswith(_libraries()):
            places.append(each)
    if not places:
        return Failed(ast.Pass(), ast.Pass(), "", sys._getframe())
    frame, at = places[-1].tb_frame, places[-1].tb_lasti // 2
    linecache.checkcache(frame.f_code.co_filename)
    text = "".join(linecache.getlines(frame.f_code.co_filename))
    own, line = [*frame.f_code.co_positions()], places[-1].tb_lineno
    above, indented = dict[ast.AST, ast.AST](), 0
    for statement in _parsed(text).body:
        if statement.lineno <= line <= (statement.end_lineno or 0):
            above = {part: node for node in ast.walk(statement) for part in ast.iter_child_nodes(node)}
            indented = getattr(statement, "body", [statement])[0].col_offset
    nodes = {_span(part): part for part in above}
    # The columns are those of the file, or of a cell that marimo has compiled without its indentation.
    right = max((0, indented), key=lambda n: sum(_moved(span, n) in nodes for span in own))
    found = nodes.get(_moved(own[at], right), ast.Pass())
    gone = () if frame.f_code.co_name.endswith("comp>") else {*_of_comprehensions(found, above)}
    if isinstance(found, ast.Assert):  # which Python 3.12 names instead of what does not hold
        found = found.test
    elif dis.opname[frame.f_code.co_code[2 * at]] == "GET_ITER" and getattr(above.get(found), "iter", None) is found:
        found = above[found]  # from Python 3.13 on what is gone through is named, not what goes through it
    return Failed(found, above.get(found, ast.Pass()), text, frame, gone)


def _of_comprehensions(part: ast.AST, above: Mapping[ast.AST, ast.AST]) -> Iterator[str]:
    """Names of the comprehensions around a part.

    From Python 3.12 on these run in the frame of what they stand in, where their names have no value any more when an
    error has left them; what stands around a function or a generator has another frame.
    """
    before = part
    while part in above:
        of = above[part]
        if isinstance(of, ast.Lambda) and part is of.body:
            return
        generators = getattr(of, "generators", ())
        if generators and (part is not generators[0] or before is not part.iter):
            if isinstance(of, ast.GeneratorExp):
                return
            yield from (n.id for each in generators for n in ast.walk(each.target) if isinstance(n, ast.Name))
        before, part = part, of


def _span(node: ast.AST) -> tuple[Any, ...]:
    """First and last line, first and last column; None where a node has no place."""
    return tuple(getattr(node, each, None) for each in ("lineno", "end_lineno", "col_offset", "end_col_offset"))


def _moved(span: tuple[Any, ...], right: int) -> tuple[Any, ...]:
    return *span[:2], *(column if column is None else column + right for column in span[2:])


def _walked(error: BaseException) -> Iterator[TracebackType]:
    trace = error.__traceback__
    while trace:
        yield trace
        trace = trace.tb_next


_OWN = str(Path(__file__).parents[1])


@cache
def _libraries() -> tuple[str, ...]:
    paths = sysconfig.get_paths()
    return ("<", *(paths[name] for name in ("stdlib", "purelib", "platlib")))


@lru_cache(maxsize=8)
def _parsed(text: str) -> ast.Module:
    try:
        return ast.parse(text)
    except SyntaxError:  # it has been changed
        return ast.Module([], [])
